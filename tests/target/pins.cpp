// SPDX-License-Identifier: MIT
//
// The pins, the clock and the serial line of a board, driven from outside by pins.py: an edge on the trigger
// is answered by a pulse of the OK pin and a line of text, bytes are echoed, and q ends it.
#include <cstdint>

#include <board.hpp>
#include <fovea/hal/clock.hpp>
#include <target/print.hpp>

int main() {
    using namespace fovea;
    auto serial = board::start_serial();
    auto clock = board::start_clock();
    auto trigger = board::trigger_pin();
#if FOVEA_OUTPUTS
    auto ok = board::ok_pin();
    auto not_ok = board::not_ok_pin();
    static_cast<void>(not_ok.set(true));
#endif
    const std::int64_t begin = clock.microseconds();
    target::print(serial, "ready\n");
    for (std::int64_t last = begin;;) {
        const std::int64_t now = clock.microseconds();
        if (now < last) return 4;
        last = now;
        if (*trigger.take_edge()) {
#if FOVEA_OUTPUTS
            static_cast<void>(ok.set(true));
            static_cast<void>(not_ok.set(false));
            target::print(serial, *trigger.active() ? "edge, active\n" : "edge, gone\n");
#else
            target::print(serial, "edge\n");
#endif
        }
        std::uint8_t byte = 0;
        if (*serial.read({&byte, 1}) == 0) continue;
        if (byte == 'q') break;
        if (byte == 't') {
            target::print_long(serial, clock.microseconds() - begin);
            target::print(serial, "\n");
            continue;
        }
        const char text[] = {static_cast<char>(byte), '\n', '\0'};
        target::print(serial, text);
    }
    return 0;
}
