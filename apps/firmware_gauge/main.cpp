// SPDX-License-Identifier: MIT
//
// The gauge on a board: wires the firmware to the board's own serial line, pins, clock and watchdog.
#include <cstdint>

#include <board.hpp>
#include <fovea/bare_metal/restart.hpp>
#include <fovea/base/span.hpp>

#include <firmware_gauge/firmware_gauge.hpp>

namespace {

using namespace fovea;

apps::GaugeMemory<FOVEA_FRAME_BYTES, FOVEA_SCRATCH_BYTES, FOVEA_LINE_BYTES, FOVEA_FEATURES, FOVEA_PARTS>
    memory;

#ifdef FOVEA_RECIPE
// The recipe that the build was given, in flash.
extern "C" const std::uint8_t fovea_recipe[], fovea_recipe_end[];
__asm(
    ".section .rodata.fovea_recipe, \"a\"\n"
    ".global fovea_recipe, fovea_recipe_end\n"
    "fovea_recipe: .incbin \"" FOVEA_RECIPE
    "\"\n"
    "fovea_recipe_end:\n"
    ".balign 4\n"
    ".text\n");
Span<const std::uint8_t> recipe() { return {fovea_recipe, fovea_recipe_end - fovea_recipe}; }
#else
Span<const std::uint8_t> recipe() { return {}; }
#endif

}  // namespace

/// A fault ends with both verdicts inactive and a new start.
extern "C" [[noreturn]] void fovea_fault() {
    static_cast<void>(fovea::board::ok_pin());
    static_cast<void>(fovea::board::not_ok_pin());
    fovea::bare_metal::restart();
}

int main() {
    board::OutputPin ok = board::ok_pin();
    board::OutputPin not_ok = board::not_ok_pin();
    board::Watchdog watchdog = board::start_watchdog();
    board::Serial serial = board::start_serial();
    board::Clock clock = board::start_clock();
    board::TriggerPin trigger = board::trigger_pin();
    using Ports =
        apps::GaugePorts<board::Serial, board::TriggerPin, board::OutputPin, board::Clock, board::Watchdog>;
    apps::FirmwareGauge<Ports, decltype(memory)> firmware(Ports{serial, trigger, ok, not_ok, clock, watchdog},
                                                          memory, board::name);
    firmware.start(recipe());
    for (;;) firmware.turn();
}
