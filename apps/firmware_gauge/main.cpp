// SPDX-License-Identifier: MIT
//
// The gauge on a board: wires the firmware to the board's own serial line, pins, clock and watchdog.
#include <board.hpp>
#include <fovea/bare_metal/restart.hpp>

#include <firmware/flash_file.hpp>
#include <firmware_gauge/firmware_gauge.hpp>

namespace {

using namespace fovea;

apps::GaugeMemory<FOVEA_FRAME_BYTES, FOVEA_SCRATCH_BYTES, FOVEA_LINE_BYTES, FOVEA_FEATURES, FOVEA_PARTS>
    memory;

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
    using Ports = apps::FirmwarePorts<board::Serial, board::TriggerPin, board::OutputPin, board::Clock,
                                      board::Watchdog>;
    apps::GaugeJob job(memory);
    apps::FrameFirmware<Ports, decltype(job)> firmware(Ports{serial, trigger, ok, not_ok, clock, watchdog},
                                                       job, board::name);
    if (apps::has_flash_file())
        firmware.start(apps::flash_file());
    else
        firmware.start();
    for (;;) firmware.turn();
}
