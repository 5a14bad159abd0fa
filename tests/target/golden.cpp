// SPDX-License-Identifier: MIT
//
// The golden vectors as a chip computes them, and what operators cost it, on its serial line:
//   NAME CHECKSUM    as in tests/golden/golden.txt
//   = NAME           a cost, in the order in which count_instructions.cpp has counted
//   # TEXT           what else is worth knowing
#include <cstdint>

#include <board.hpp>
#include <fovea/bare_metal/memory_layout.hpp>
#include <golden/vectors.hpp>
#include <target/costs.hpp>
#include <target/print.hpp>

namespace {

fovea::golden::Workspace workspace;
decltype(fovea::board::start_serial())* line = nullptr;
bool all_done = true;

void tell_cost(const char* name, bool done) {
    fovea::target::print(*line, done ? "= " : "# refused: ");
    fovea::target::print(*line, name);
    fovea::target::print(*line, "\n");
    all_done = all_done && done;
}

}  // namespace

int main() {
    using namespace fovea;
    auto serial = board::start_serial();
    line = &serial;
    golden::for_each_vector([&](const golden::Vector& vector) {
        target::print(serial, vector.name);
        target::print(serial, " ");
        target::print_hexadecimal(serial, golden::checksum(vector, workspace));
        target::print(serial, "\n");
    });
    target::for_each_cost(tell_cost);
    target::print(serial, "# bytes of stack ");
    target::print_long(serial, bare_metal::deepest_stack());
    target::print(serial, "\n");
    return all_done ? 0 : 1;
}
