// SPDX-License-Identifier: MIT
//
// Anything on the serial line of firmware_gauge, at any time, with any edges: it goes on, never says OK and
// not OK at once, and has a pin active only behind a frame that it judged.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <fovea/codec/packet.hpp>
#include <fovea/decision/compiled_recipe.hpp>
#include <fovea/simulated/byte_pipe.hpp>
#include <fovea/simulated/pins.hpp>
#include <fovea/simulated/watchdog.hpp>

#include <firmware_gauge/firmware_gauge.hpp>

namespace {

using namespace fovea;
using Bytes = std::vector<std::uint8_t>;

void require(bool claim) {
    if (!claim) __builtin_trap();
}

using Ports = apps::FirmwarePorts<simulated::BytePipe, simulated::Pin, simulated::Pin, simulated::Clock,
                                  simulated::Watchdog>;
using Memory = apps::GaugeMemory<400, 12000, 120, 2, 2>;

Bytes good_recipe() {
    RecipeOf<2> recipe;
    recipe.locate.area_min = 10;
    recipe.locate.orientation = OrientationRule::none;
    Feature width;
    width.name[0] = 'w';
    width.from = {-7000000, 0};
    width.to = {7000000, 0};
    width.lines = 3;
    width.tolerance = {Decimal::from_int(10), Decimal::from_int(1), Decimal::from_int(1)};
    require(recipe.features.push(width) == Status::ok);
    Bytes bytes(1000);
    const Result<std::ptrdiff_t> size = encode_recipe(recipe, {bytes.data(), 1000});
    bytes.resize(static_cast<std::size_t>(*size));
    bytes.insert(bytes.begin(), 'R');
    return bytes;
}

void put_packet(simulated::BytePipe& serial, const Bytes& content) {
    Bytes line(static_cast<std::size_t>(packet_bytes(static_cast<std::ptrdiff_t>(content.size()))));
    const Result<std::ptrdiff_t> size =
        encode_packet({content.data(), static_cast<std::ptrdiff_t>(content.size())},
                      {line.data(), static_cast<std::ptrdiff_t>(line.size())});
    if (size) serial.arriving.insert(serial.arriving.end(), line.begin(), line.begin() + *size);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    // A few frames say what a hundred do.
    size = std::min<std::size_t>(size, 100);
    simulated::BytePipe serial;
    simulated::Pin trigger, ok, not_ok;
    simulated::Clock clock;
    simulated::Watchdog watchdog(clock, 5000000);
    static Memory memory;
    memory = {};
    apps::GaugeJob<Memory> job(memory);
    apps::FrameFirmware<Ports, apps::GaugeJob<Memory>> firmware(
        {serial, trigger, ok, not_ok, clock, watchdog}, job, "fuzz");
    firmware.start();
    put_packet(serial, good_recipe());
    const auto turn = [&] {
        do {
            firmware.turn();
            require(!(*ok.active() && *not_ok.active()));
        } while (!serial.arriving.empty());
        const std::string said(serial.sent.begin(), serial.sent.end());
        require(said.empty() || said.back() == '\n');
        if (!*ok.active() && !*not_ok.active()) return;
        // The last thing said of a frame is its verdict.
        const std::size_t judged = said.rfind("\"parts\":[");
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
                put_packet(serial,
                           {'F', static_cast<std::uint8_t>(16), 0, static_cast<std::uint8_t>(count), 0});
                break;
            case 5: {
                // A whole frame of 16x8 with a part as wide as the bytes say.
                put_packet(serial, {'T'});
                put_packet(serial, {'F', 16, 0, 8, 0});
                for (std::uint8_t y = 0; y < 8; ++y) {
                    Bytes line = {'L', y, 0};
                    for (std::size_t x = 0; x < 16; ++x)
                        line.push_back(y > 1 && y < 6 && x > 2 && x < 4 + count ? 20 : 220);
                    if (y < some.size()) line[3 + some[y] % 16] = some[y];
                    put_packet(serial, line);
                }
                break;
            }
            case 6: put_packet(serial, {'T'}); break;
            case 7: {
                Bytes line = {'L', static_cast<std::uint8_t>(count), 0};
                line.insert(line.end(), some.begin(), some.end());
                line.resize(19, 200);
                put_packet(serial, line);
                break;
            }
        }
        turn();
    }
    return 0;
}
