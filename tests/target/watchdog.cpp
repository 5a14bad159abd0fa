// SPDX-License-Identifier: MIT
//
// The watchdog of a board: a program that feeds it goes on, one that hangs starts anew. watchdog.py looks on.
#include <cstdint>

#include <board.hpp>
#include <fovea/bare_metal/restart.hpp>
#include <target/print.hpp>

// Some watchdogs warn by an interrupt first, which comes here.
extern "C" [[noreturn]] void fovea_fault() { fovea::bare_metal::restart(); }

int main() {
    using namespace fovea;
    auto serial = board::start_serial();
    auto clock = board::start_clock();
    target::print(serial, "start\n");
    auto watchdog = board::start_watchdog();
    // Longer than any patience of a board.
    while (clock.microseconds() < 4000000) watchdog.feed();
    target::print(serial, "fed\n");
    for (;;) __asm volatile("");
}
