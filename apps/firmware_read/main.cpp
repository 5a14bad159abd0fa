// SPDX-License-Identifier: MIT
//
// A reader of codes on a board: wires the firmware to the board's own serial line, pins, clock and watchdog.
// With FOVEA_HEIGHT it reads QR codes in frames, without it bar codes in lines.
#include <board.hpp>
#include <fovea/bare_metal/restart.hpp>

#include <firmware/flash_file.hpp>
#include <firmware/frame_firmware.hpp>
#ifdef FOVEA_HEIGHT
#include <firmware_read/qr_job.hpp>
#else
#include <firmware_read/bar_job.hpp>
#endif

namespace {

using namespace fovea;

#ifdef FOVEA_HEIGHT
apps::QrMemory<FOVEA_WIDTH, FOVEA_HEIGHT, FOVEA_LARGEST_VERSION, FOVEA_TEXT_BYTES> memory;
apps::QrJob<decltype(memory)> make_job() { return apps::QrJob<decltype(memory)>(memory); }
// Noise, which takes longest, takes 80 million instructions, in which no watchdog is fed.
board::Watchdog start_watchdog() { return board::start_watchdog(10); }
#else
apps::BarMemory<FOVEA_WIDTH> memory;
apps::BarJob<decltype(memory)> make_job() { return {memory, FOVEA_SYMBOLOGIES}; }
board::Watchdog start_watchdog() { return board::start_watchdog(); }
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
    board::Watchdog watchdog = start_watchdog();
    board::Serial serial = board::start_serial();
    board::Clock clock = board::start_clock();
    board::TriggerPin trigger = board::trigger_pin();
    using Ports = apps::FirmwarePorts<board::Serial, board::TriggerPin, board::OutputPin, board::Clock,
                                      board::Watchdog>;
    auto job = make_job();
    apps::FrameFirmware<Ports, decltype(job)> firmware(Ports{serial, trigger, ok, not_ok, clock, watchdog},
                                                       job, board::name);
    if (apps::has_flash_file())
        firmware.start(apps::flash_file());
    else
        firmware.start();
    for (;;) firmware.turn();
}
