// SPDX-License-Identifier: MIT
//
// A chip that measures in frames it could not hold, on its serial line: tests/target/lines.txt.
#include <cstdint>

#include <board.hpp>
#include <fovea/bare_metal/memory_layout.hpp>
#include <target/lines.hpp>
#include <target/print.hpp>

namespace {
fovea::target::LineGauge gauge;
fovea::Gray8 line[fovea::target::LineScene::size.width];

struct Printer {
    fovea::board::Serial& serial;

    void operator()(const char* text) const { fovea::target::print(serial, text); }
    void operator()(std::int64_t number) const {
        fovea::target::print(serial, " ");
        fovea::target::print_long(serial, number);
    }
};
}  // namespace

int main() {
    using namespace fovea;
    auto serial = board::start_serial();
    for (int frame = 0; frame < target::LineScene::frames; ++frame)
        gauge.measure(
            [frame](auto& program, Span<std::uint8_t> scratch) {
                target::LineScene scene(frame);
                if (Status s = program.start(scene.size, Border::replicate, scratch); s != Status::ok)
                    return s;
                while (!program.complete()) {
                    scene.take(line);
                    if (Status s = program.push(line); s != Status::ok) return s;
                }
                return Status::ok;
            },
            Printer{serial});
    target::print(serial, "# bytes of stack ");
    target::print_long(serial, bare_metal::deepest_stack());
    target::print(serial, " of ");
    target::print_long(serial, 4 * (fovea_stack_top - fovea_stack_limit));
    target::print(serial, ", of memory ");
    target::print_long(serial, 4 * (fovea_bss_end - fovea_stack_limit));
    target::print(serial, "\n");
    return 0;
}
