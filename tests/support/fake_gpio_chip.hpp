// SPDX-License-Identifier: MIT
//
// FakeGpio: GPIO chips in memory that answer as the kernel's documentation of its second interface says
// (userspace-api/gpio). Host tests only.
#pragma once

#include <fcntl.h>
#include <linux/gpio.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <deque>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <fovea/base/span.hpp>

namespace fovea::test {

/// Chips /dev/<name>, with lines that a test drives and looks at by their physical level.
struct FakeGpio {
    struct Line {
        std::string name, consumer;
        bool high = false;
        std::uint64_t flags = 0;
        std::uint32_t debounce_us = 0, kept = 0, number = 0;
        std::deque<gpio_v2_line_event> events;
    };
    struct Chip {
        std::string name, label;
        std::vector<Line> lines;
        bool gone = false;
    };
    /// An open chip has line -1.
    struct File {
        std::size_t chip;
        int line;
        bool waits = true;
    };

    std::vector<Chip> chips;
    std::map<int, File> files;
    int last_file = 2;
    std::uint64_t now_ns = 5000000000;
    /// The folder of the chips has been read.
    bool listed = false;

    Line& line(std::size_t chip, std::size_t number) { return chips[chip].lines[number]; }
    void drive(std::size_t chip, std::size_t number, bool high) {
        Line& one = line(chip, number);
        if (one.high == high) return;
        one.high = high;
        const bool rising = high != ((one.flags & GPIO_V2_LINE_FLAG_ACTIVE_LOW) != 0);
        const std::uint64_t wanted = rising ? GPIO_V2_LINE_FLAG_EDGE_RISING : GPIO_V2_LINE_FLAG_EDGE_FALLING;
        if ((one.flags & wanted) == 0) return;
        gpio_v2_line_event event{};
        event.timestamp_ns = now_ns;
        event.id = rising ? GPIO_V2_LINE_EVENT_RISING_EDGE : GPIO_V2_LINE_EVENT_FALLING_EDGE;
        event.offset = static_cast<std::uint32_t>(number);
        event.seqno = event.line_seqno = ++one.number;
        // What does not fit pushes out the oldest.
        if (one.events.size() == one.kept) one.events.pop_front();
        one.events.push_back(event);
    }
    void pulse(std::size_t chip, std::size_t number) {
        drive(chip, number, true);
        drive(chip, number, false);
    }
};

/// The fake as a system of the Linux ports; it outlives the handles.
struct FakeGpioSystem {
    FakeGpio* fake = nullptr;

    int open(const char* path, int flags, unsigned = 0) {
        if ((flags & O_DIRECTORY) != 0) {
            fake->listed = false;
            return number_of({0, -2});
        }
        for (std::size_t i = 0; i < fake->chips.size(); ++i)
            if (path == "/dev/" + fake->chips[i].name)
                return fake->chips[i].gone ? -ENODEV : number_of({i, -1});
        return -ENOENT;
    }
    int close(int file) {
        const FakeGpio::File& one = fake->files.at(file);
        if (one.line >= 0) {
            FakeGpio::Line& line = fake->line(one.chip, static_cast<std::size_t>(one.line));
            line.consumer.clear();
            line.flags = 0;
        }
        fake->files.erase(file);
        return 0;
    }
    int stop_waiting(int file) {
        fake->files.at(file).waits = false;
        return 0;
    }
    std::ptrdiff_t entries(int, Span<std::uint8_t> into) {
        if (fake->listed) return 0;
        fake->listed = true;
        std::ptrdiff_t size = 0;
        std::vector<std::string> names = {".", "..", "null", "gpio"};
        for (const FakeGpio::Chip& chip : fake->chips) names.push_back(chip.name);
        for (const std::string& name : names) {
            const std::uint16_t length = static_cast<std::uint16_t>((19 + name.size() + 8) / 8 * 8);
            std::uint8_t* const record = into.data() + size;
            std::memset(record, 0xa5, length);
            std::memcpy(record + 16, &length, 2);
            std::memcpy(record + 19, name.c_str(), name.size() + 1);
            size += length;
        }
        return size;
    }
    std::ptrdiff_t read(int file, Span<std::uint8_t> into) {
        const FakeGpio::File& one = fake->files.at(file);
        if (fake->chips[one.chip].gone) return -ENODEV;
        auto& events = fake->line(one.chip, static_cast<std::size_t>(one.line)).events;
        if (into.size() < static_cast<std::ptrdiff_t>(sizeof(gpio_v2_line_event))) return -EINVAL;
        // Without an event it would wait for ever.
        if (events.empty()) return one.waits ? -EDEADLK : -EAGAIN;
        std::memcpy(into.data(), &events.front(), sizeof(gpio_v2_line_event));
        events.pop_front();
        return static_cast<std::ptrdiff_t>(sizeof(gpio_v2_line_event));
    }
    int ioctl(int file, unsigned long request, void* argument) {
        const FakeGpio::File one = fake->files.at(file);
        FakeGpio::Chip& chip = fake->chips[one.chip];
        if (chip.gone) return -ENODEV;
        if (one.line < 0) {
            if (request == GPIO_GET_CHIPINFO_IOCTL) return tell(chip, *static_cast<gpiochip_info*>(argument));
            if (request == GPIO_V2_GET_LINEINFO_IOCTL)
                return tell(chip, *static_cast<gpio_v2_line_info*>(argument));
            if (request == GPIO_V2_GET_LINE_IOCTL)
                return lend(one.chip, *static_cast<gpio_v2_line_request*>(argument));
            return -EINVAL;
        }
        FakeGpio::Line& line = chip.lines[static_cast<std::size_t>(one.line)];
        gpio_v2_line_values& values = *static_cast<gpio_v2_line_values*>(argument);
        const bool low = (line.flags & GPIO_V2_LINE_FLAG_ACTIVE_LOW) != 0;
        if ((values.mask & 1) == 0) return -EINVAL;
        if (request == GPIO_V2_LINE_GET_VALUES_IOCTL) {
            values.bits = line.high != low ? 1 : 0;
        } else if (request == GPIO_V2_LINE_SET_VALUES_IOCTL) {
            if ((line.flags & GPIO_V2_LINE_FLAG_OUTPUT) == 0) return -EPERM;
            line.high = ((values.bits & 1) != 0) != low;
        } else {
            return -EINVAL;
        }
        return 0;
    }
    std::int64_t monotonic_us() { return static_cast<std::int64_t>(fake->now_ns / 1000); }
    int process_id() { return 1; }

private:
    int number_of(FakeGpio::File file) {
        fake->files[++fake->last_file] = file;
        return fake->last_file;
    }
    static void write(const std::string& text, char (&into)[GPIO_MAX_NAME_SIZE]) {
        std::memset(into, 0, sizeof into);
        std::memcpy(into, text.data(), std::min(text.size(), sizeof into - 1));
    }
    static int tell(const FakeGpio::Chip& chip, gpiochip_info& info) {
        write(chip.name, info.name);
        write(chip.label, info.label);
        info.lines = static_cast<std::uint32_t>(chip.lines.size());
        return 0;
    }
    static int tell(const FakeGpio::Chip& chip, gpio_v2_line_info& info) {
        if (info.offset >= chip.lines.size()) return -EINVAL;
        const FakeGpio::Line& line = chip.lines[info.offset];
        write(line.name, info.name);
        write(line.consumer, info.consumer);
        info.flags = line.flags;
        return 0;
    }
    static bool at_most_one(std::uint64_t flags, std::uint64_t of) {
        return ((flags & of) & ((flags & of) - 1)) == 0;
    }
    static bool valid(std::uint64_t flags) {
        const bool in = (flags & GPIO_V2_LINE_FLAG_INPUT) != 0, out = (flags & GPIO_V2_LINE_FLAG_OUTPUT) != 0;
        const std::uint64_t edges = GPIO_V2_LINE_FLAG_EDGE_RISING | GPIO_V2_LINE_FLAG_EDGE_FALLING;
        const std::uint64_t drives = GPIO_V2_LINE_FLAG_OPEN_DRAIN | GPIO_V2_LINE_FLAG_OPEN_SOURCE;
        const std::uint64_t biases = GPIO_V2_LINE_FLAG_BIAS_PULL_UP | GPIO_V2_LINE_FLAG_BIAS_PULL_DOWN |
                                     GPIO_V2_LINE_FLAG_BIAS_DISABLED;
        return (flags & GPIO_V2_LINE_FLAG_USED) == 0 && in != out && ((flags & edges) == 0 || in) &&
               ((flags & drives) == 0 || out) && at_most_one(flags, drives) && at_most_one(flags, biases);
    }
    int lend(std::size_t chip, gpio_v2_line_request& request) {
        std::vector<FakeGpio::Line>& lines = fake->chips[chip].lines;
        if (request.num_lines != 1 || request.offsets[0] >= lines.size()) return -EINVAL;
        if (!valid(request.config.flags) || request.config.num_attrs > GPIO_V2_LINE_NUM_ATTRS_MAX)
            return -EINVAL;
        FakeGpio::Line& line = lines[request.offsets[0]];
        if ((line.flags & GPIO_V2_LINE_FLAG_USED) != 0) return -EBUSY;
        line.flags = request.config.flags | GPIO_V2_LINE_FLAG_USED;
        line.consumer = std::string(request.consumer, ::strnlen(request.consumer, GPIO_MAX_NAME_SIZE - 1));
        line.kept = request.event_buffer_size == 0 ? 16 : request.event_buffer_size;
        line.number = 0;
        line.debounce_us = 0;
        line.events.clear();
        bool active = false;
        for (std::uint32_t i = 0; i < request.config.num_attrs; ++i) {
            const gpio_v2_line_config_attribute& one = request.config.attrs[i];
            if ((one.mask & 1) == 0) continue;
            if (one.attr.id == GPIO_V2_LINE_ATTR_ID_DEBOUNCE) line.debounce_us = one.attr.debounce_period_us;
            if (one.attr.id == GPIO_V2_LINE_ATTR_ID_OUTPUT_VALUES) active = (one.attr.values & 1) != 0;
        }
        if ((line.flags & GPIO_V2_LINE_FLAG_OUTPUT) != 0)
            line.high = active != ((line.flags & GPIO_V2_LINE_FLAG_ACTIVE_LOW) != 0);
        request.fd = number_of({chip, static_cast<int>(request.offsets[0])});
        return 0;
    }
};

}  // namespace fovea::test
