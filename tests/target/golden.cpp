// SPDX-License-Identifier: MIT
//
// The golden vectors as a chip computes them: the lines of tests/golden/golden.txt on its serial line, and how deep the
// stack was.
#include <cstdint>

#include <board.hpp>
#include <fovea/base/span.hpp>
#include <fovea/bare_metal/memory_layout.hpp>
#include <golden/vectors.hpp>
#include <target/print.hpp>

namespace {
fovea::golden::Workspace workspace;
}  // namespace

int main() {
    using namespace fovea;
    auto serial = board::start_serial();
    golden::for_each_vector([&](const golden::Vector& vector) {
        target::print(serial, vector.name);
        target::print(serial, " ");
        target::print_hexadecimal(serial, golden::checksum(vector, workspace));
        target::print(serial, "\n");
    });
    target::print(serial, "# bytes of stack ");
    target::print_number(serial, static_cast<std::uint32_t>(bare_metal::deepest_stack()));
    target::print(serial, "\n");
    return 0;
}
