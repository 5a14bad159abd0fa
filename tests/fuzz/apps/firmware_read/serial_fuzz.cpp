// SPDX-License-Identifier: MIT
//
// Anything on the serial line of firmware_read, at any time: it goes on, never says OK and not OK at once,
// and has a pin active only behind a frame that it judged. One board reads bars, the other QR codes.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <fovea/codec/packet.hpp>
#include <fovea/simulated/byte_pipe.hpp>
#include <fovea/simulated/pins.hpp>
#include <fovea/simulated/watchdog.hpp>

#include <firmware_read/bar_job.hpp>
#include <firmware_read/qr_job.hpp>

namespace {

using namespace fovea;
using Bytes = std::vector<std::uint8_t>;

void require(bool claim) {
    if (!claim) __builtin_trap();
}

using Ports = apps::FirmwarePorts<simulated::BytePipe, simulated::Pin, simulated::Pin, simulated::Clock,
                                  simulated::Watchdog>;

void put_packet(simulated::BytePipe& serial, const Bytes& content) {
    Bytes line(static_cast<std::size_t>(packet_bytes(static_cast<std::ptrdiff_t>(content.size()))));
    const Result<std::ptrdiff_t> size =
        encode_packet({content.data(), static_cast<std::ptrdiff_t>(content.size())},
                      {line.data(), static_cast<std::ptrdiff_t>(line.size())});
    if (size) serial.arriving.insert(serial.arriving.end(), line.begin(), line.begin() + *size);
}

template <class Job>
void drive(Job job, const std::uint8_t* data, std::size_t size) {
    simulated::BytePipe serial;
    simulated::Pin trigger, ok, not_ok;
    simulated::Clock clock;
    simulated::Watchdog watchdog(clock, 5000000);
    apps::FrameFirmware<Ports, Job> firmware({serial, trigger, ok, not_ok, clock, watchdog}, job, "fuzz");
    const std::uint8_t allowed[] = {'1', '2', '\n', '0', '0', '0', '0', '0', '0', '1', '7'};
    if (size % 2 == 0)
        firmware.start(allowed);
    else
        firmware.start();
    const auto turn = [&] {
        do {
            firmware.turn();
            require(!(*ok.active() && *not_ok.active()));
        } while (!serial.arriving.empty());
        const std::string said(serial.sent.begin(), serial.sent.end());
        require(said.empty() || said.back() == '\n');
        if (!*ok.active() && !*not_ok.active()) return;
        // The last thing said of a frame is its verdict.
        const std::size_t judged = said.rfind("\"codes\":[");
        require(judged != std::string::npos);
        for (const char* other : {"\"error\"", "\"ready\""}) {
            const std::size_t place = said.rfind(other);
            require(place == std::string::npos || place < judged);
        }
    };
    turn();
    // Of each step the first byte says what, and how many of the next bytes belong to it.
    for (std::size_t at = 0; at < size;) {
        const std::uint8_t what = data[at++];
        const std::size_t count = std::min<std::size_t>(what >> 3, size - at);
        const Bytes some(data + at, data + at + count);
        at += count;
        switch (what & 7) {
            case 0: serial.arriving.insert(serial.arriving.end(), some.begin(), some.end()); break;
            case 1: put_packet(serial, some); break;
            case 2: require(trigger.set(true) == Status::ok && trigger.set(false) == Status::ok); break;
            case 3: clock.now += count * 200000; break;
            case 4:
                put_packet(serial, {'T'});
                put_packet(serial, {'F', static_cast<std::uint8_t>(32 + 2 * count), 0,
                                    static_cast<std::uint8_t>(count), 0});
                break;
            case 5: {
                // A whole frame of 96x6 whose bytes are runs of pixels, the same in every line.
                put_packet(serial, {'T'});
                put_packet(serial, {'F', 96, 0, 6, 0});
                for (std::uint8_t y = 0; y < 6; ++y) {
                    Bytes line = {'L', y, 0};
                    for (std::size_t i = 0; i < some.size(); ++i)
                        line.insert(line.end(), 1U + (some[i] & 3U), i % 2 == 0 ? 20 : 220);
                    line.resize(99, 230);
                    put_packet(serial, line);
                }
                break;
            }
            case 6: put_packet(serial, {'T'}); break;
            case 7: {
                Bytes line = {'L', static_cast<std::uint8_t>(count), 0};
                line.insert(line.end(), some.begin(), some.end());
                line.resize(99, 200);
                put_packet(serial, line);
                break;
            }
        }
        turn();
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    // A few frames say what a hundred do.
    size = std::min<std::size_t>(size, 100);
    static apps::BarMemory<120> bar_memory;
    static apps::QrMemory<100, 40, 1, 30> qr_memory;
    bar_memory = {};
    qr_memory = {};
    if (size > 0 && data[0] % 4 == 0)
        drive(apps::QrJob(qr_memory), data + 1, size - 1);
    else
        drive(apps::BarJob(bar_memory, bar_symbologies()), data, size);
    return 0;
}
