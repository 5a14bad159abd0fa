// SPDX-License-Identifier: MIT
//
// The golden vectors as a chip computes them, and what operators cost it, on its serial line:
//   NAME CHECKSUM    as in tests/golden/golden.txt
//   = NAME           a cost, in the order in which count_instructions.cpp has counted
//   # TEXT           what else is worth knowing
#include <cstdint>

#include <board.hpp>
#include <fovea/bare_metal/memory_layout.hpp>
#include <fovea/base/span.hpp>
#include <golden/vectors.hpp>
#include <target/costs.hpp>
#include <target/print.hpp>

extern "C" {
[[gnu::noinline]] void fovea_region_begin() { __asm volatile(""); }
[[gnu::noinline]] void fovea_region_end() { __asm volatile(""); }
}

namespace {
fovea::golden::Workspace workspace;
fovea::target::CostRoom room;
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
    bool all_done = true;
    target::for_each_cost(room, [&](const char* name, bool done) {
        target::print(serial, done ? "= " : "# refused: ");
        target::print(serial, name);
        target::print(serial, "\n");
        all_done = all_done && done;
    });
    target::print(serial, "# bytes of stack ");
    target::print_long(serial, bare_metal::deepest_stack());
    target::print(serial, "\n");
    return all_done ? 0 : 1;
}
