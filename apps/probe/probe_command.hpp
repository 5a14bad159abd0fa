// SPDX-License-Identifier: MIT
//
// fovea probe: the cameras, serial ports and GPIO chips of this machine, and what settings call them.
#pragma once

#include <linux/gpio.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <fovea/linux/camera_mode.hpp>
#include <fovea/linux/gpio_chip.hpp>

#include <common/arguments.hpp>
#include <common/io.hpp>
#include <probe/camera_facts.hpp>
#include <probe/machine.hpp>

namespace fovea::apps {

inline Command probe_help() {
    return {
        "probe",
        "",
        "Lists the cameras, serial ports and GPIO chips of this machine, as settings of fovead name them.",
        {{"size", "WxH", "which mode would be chosen for frames of this size; the largest"},
         {"rate", "N", "and so many frames a second at least; 10"},
         {"format", "FORMAT", "and this format, as gray8, yuyv or mjpeg; any"},
         {"colour", "", "and in colour"},
         {"json", "", "one line of JSON for each device"}},
        "Nothing is changed. Serial ports are not opened, for some devices restart when one does so.\n"
        "Ends with 0 if there is a camera, with 1 if there is none, with 2 if it could not look.\n"};
}

namespace detail {

/// A wish out of the words. False if they are wrong, and problem says so.
inline bool read_wish(const Arguments& arguments, linux_port::CameraWish& wish, std::string& problem) {
    int rate = 10;
    if (!whole_option(arguments, "rate", 1, 10000, rate, problem)) return false;
    wish.interval_us = 1000000 / rate;
    wish.colour = arguments.has("colour");
    if (arguments.has("size")) {
        const std::vector<std::string> sides = split(arguments.value("size"), 'x');
        std::uint64_t width = 0, height = 0;
        if (sides.size() != 2 || !linux_port::parse_number(sides[0].c_str(), max_image_side, width) ||
            !linux_port::parse_number(sides[1].c_str(), max_image_side, height) || width == 0 ||
            height == 0) {
            problem = "--size takes WIDTHxHEIGHT, not '" + one_line(arguments.value("size")) + "'";
            return false;
        }
        wish.size = {static_cast<int>(width), static_cast<int>(height)};
    }
    if (!arguments.has("format")) return true;
    std::vector<std::string> names;
    for (int k = 1; k < hal::pixel_formats; ++k) {
        names.push_back(hal::describe(static_cast<hal::PixelFormat>(k)));
        if (arguments.value("format") == names.back()) wish.format = static_cast<hal::PixelFormat>(k);
    }
    if (wish.format == hal::PixelFormat::none)
        problem = "--format takes " + listed(names, "or") + ", not '" + one_line(arguments.value("format")) +
                  "'" + hint(nearest_name(arguments.value("format"), names));
    return problem.empty();
}

/// Words in columns, each as wide as its widest; the last is left as it is.
inline std::string columns(const std::vector<std::vector<std::string>>& rows) {
    std::vector<std::size_t> widths;
    for (const auto& row : rows)
        for (std::size_t k = 0; k < row.size(); ++k) {
            if (k == widths.size()) widths.push_back(0);
            widths[k] = std::max(widths[k], row[k].size());
        }
    std::string text;
    for (const auto& row : rows) {
        std::string line = " ";
        for (std::size_t k = 0; k < row.size(); ++k)
            line += " " + row[k] + std::string(widths[k] + 1 - row[k].size(), ' ');
        line.erase(line.find_last_not_of(' ') + 1);
        text += line + "\n";
    }
    return text;
}

inline std::string describe_mode(const linux_port::CameraMode& mode, Size size) {
    return std::string(hal::describe(mode.format)) + " (" + code_text(mode.code) + ") " +
           std::to_string(size.width) + "x" + std::to_string(size.height) + " at " +
           rate_text(mode.interval_us) + " frames/s";
}

inline linux_port::CameraChoice choose(const CameraFacts& facts, const linux_port::CameraWish& wish) {
    return linux_port::choose_mode({facts.modes.data(), static_cast<std::ptrdiff_t>(facts.modes.size())},
                                   wish);
}

inline std::string camera_text(const CameraFacts& facts, const linux_port::CameraWish& wish) {
    std::string text = facts.node.path + ": ";
    const std::string who =
        facts.card + (facts.driver.empty() ? "" : " (" + facts.driver + ", " + facts.bus + ")");
    if (!facts.camera) {
        text += who.empty() ? "" : who + ": ";
        return text + "no pictures: " + facts.problem + (facts.advice.empty() ? "" : "; " + facts.advice) +
               "\n";
    }
    text += who + "\n  device = \"" + facts.node.identity + "\"" +
            (facts.node.by_number ? "   a number that may change when something is plugged in\n" : "\n");
    std::vector<std::vector<std::string>> rows = {{"format", "code", "size", "frames/s"}};
    for (const linux_port::CameraMode& mode : facts.modes)
        rows.push_back(
            {hal::describe(mode.format), code_text(mode.code), size_text(mode), rate_text(mode.interval_us)});
    text += columns(rows);
    if (!facts.unread.empty()) {
        // Some drivers have dozens: their codes tell enough.
        std::vector<std::string> names = facts.unread;
        for (std::string& name : names)
            if (names.size() > 4) name = name.substr(0, name.find(' '));
        text += "  not read: " + listed(names) + "\n";
    }
    const linux_port::CameraChoice choice = choose(facts, wish);
    const std::string why = describe(choice.reason);
    text +=
        choice.index < 0
            ? "  chosen: none: " + why + "\n"
            : "  chosen: " + describe_mode(facts.modes[static_cast<std::size_t>(choice.index)], choice.size) +
                  ": " + why + "\n";
    if (facts.controls.empty()) return text + "  no controls\n";
    rows = {{"control", "from", "to", "step", "default", "now"}};
    for (const ControlFacts& control : facts.controls) {
        std::string now = control.readable ? std::to_string(control.now) : "-";
        if (!control.choices.empty()) now += "   " + listed(control.choices);
        if (!control.settable) now += "   cannot be set";
        if (control.inactive) now += "   inactive: an automatic mode has the say";
        rows.push_back({control.name, std::to_string(control.smallest), std::to_string(control.largest),
                        std::to_string(control.step), std::to_string(control.otherwise), now});
    }
    return text + columns(rows);
}

inline std::string camera_json(const CameraFacts& facts, const linux_port::CameraWish& wish) {
    std::string json = "{\"schema\":1,\"device\":\"camera\",\"node\":" + json_string(facts.node.path) +
                       ",\"pictures\":" + (facts.camera ? "true" : "false") +
                       ",\"card\":" + json_string(facts.card) + ",\"driver\":" + json_string(facts.driver) +
                       ",\"bus\":" + json_string(facts.bus) +
                       ",\"identity\":" + json_string(facts.node.identity);
    if (!facts.camera)
        return json + ",\"reason\":" + json_string(facts.problem) + ",\"try\":" + json_string(facts.advice) +
               "}\n";
    json += ",\"modes\":[";
    for (const linux_port::CameraMode& mode : facts.modes)
        json += std::string(json.back() == '[' ? "" : ",") + "{\"format\":\"" + hal::describe(mode.format) +
                "\",\"code\":" + json_string(code_text(mode.code)) +
                ",\"width\":" + std::to_string(mode.largest.width) +
                ",\"height\":" + std::to_string(mode.largest.height) +
                (mode.smallest == mode.largest
                     ? ""
                     : ",\"least_width\":" + std::to_string(mode.smallest.width) +
                           ",\"least_height\":" + std::to_string(mode.smallest.height)) +
                ",\"interval_us\":" + std::to_string(mode.interval_us) + "}";
    json += "],\"not_read\":[";
    for (const std::string& format : facts.unread)
        json += (json.back() == '[' ? "" : ",") + json_string(format);
    const linux_port::CameraChoice choice = choose(facts, wish);
    json += "],\"choice\":";
    if (choice.index < 0)
        json += "null";
    else
        json += std::to_string(choice.index);
    json += ",\"why\":" + json_string(describe(choice.reason)) + ",\"controls\":[";
    for (const ControlFacts& control : facts.controls)
        json += std::string(json.back() == '[' ? "" : ",") + "{\"name\":" + json_string(control.name) +
                ",\"from\":" + std::to_string(control.smallest) +
                ",\"to\":" + std::to_string(control.largest) + ",\"step\":" + std::to_string(control.step) +
                ",\"default\":" + std::to_string(control.otherwise) +
                ",\"now\":" + (control.readable ? std::to_string(control.now) : "null") +
                ",\"settable\":" + (control.settable ? "true" : "false") +
                ",\"inactive\":" + (control.inactive ? "true" : "false") + "}";
    return json + "]}\n";
}

/// Serial ports that have hardware behind them.
template <class System>
std::vector<DeviceNode> serial_ports(System& system, const MachineFolders& folders) {
    std::vector<DeviceNode> all, ports;
    linux_port::Fault ignored;
    static_cast<void>(device_nodes(system, folders, "tty", "tty", all, ignored));
    for (const DeviceNode& node : all) {
        const std::string entry = std::string(folders.sysfs) + "/class/tty/" + node.name;
        char target[512];
        if (system.read_link((entry + "/device").c_str(), Span<char>(target)) < 0) continue;
        // Places that a PC keeps for UARTs say that there is none.
        if (first_line(system, entry + "/type") != "0") ports.push_back(node);
    }
    name_nodes(system, folders, "tty", ports);
    return ports;
}

template <class Io, class System>
void tell_chip(Io& io, System& system, const MachineFolders& folders, const std::string& name, bool json) {
    linux_port::GpioChip<System> chip(system, folders.nodes);
    const std::string path = std::string(folders.nodes) + "/" + name;
    if (chip.open(path.c_str()) != Status::ok) {
        const std::string problem = std::string(chip.fault().call) + ": " + linux_port::reason(chip.fault());
        io.print(json ? "{\"schema\":1,\"device\":\"gpio\",\"node\":" + json_string(path) +
                            ",\"reason\":" + json_string(problem) +
                            ",\"try\":" + json_string(linux_port::advice(chip.fault())) + "}\n"
                      : path + ": " + problem + "; " + linux_port::advice(chip.fault()) + "\n");
        return;
    }
    std::string out = json ? "{\"schema\":1,\"device\":\"gpio\",\"node\":" + json_string(path) +
                                 ",\"label\":" + json_string(chip.label()) + ",\"lines\":["
                           : path + ": " + one_line(chip.label()) + ", " + std::to_string(chip.lines()) +
                                 " lines\n  chip = \"" + one_line(chip.label()) + "\"\n";
    std::vector<std::vector<std::string>> rows = {{"line", "name", "direction", "held by"}};
    for (std::uint32_t k = 0; k < chip.lines(); ++k) {
        gpio_v2_line_info line{};
        line.offset = k;
        if (linux_port::uninterrupted(
                [&] { return system.ioctl(chip.file(), GPIO_V2_GET_LINEINFO_IOCTL, &line); }) < 0)
            break;
        line.name[sizeof line.name - 1] = line.consumer[sizeof line.consumer - 1] = '\0';
        const bool used = (line.flags & GPIO_V2_LINE_FLAG_USED) != 0;
        const char* const way = (line.flags & GPIO_V2_LINE_FLAG_OUTPUT) != 0 ? "output" : "input";
        const std::string holder = !used                      ? ""
                                   : line.consumer[0] != '\0' ? one_line(line.consumer)
                                                              : "the kernel";
        if (json)
            out += std::string(out.back() == '[' ? "" : ",") + "{\"line\":" + std::to_string(k) +
                   ",\"name\":" + json_string(line.name) + ",\"direction\":\"" + way +
                   "\",\"held_by\":" + (used ? json_string(holder) : "null") + "}";
        else
            rows.push_back(
                {std::to_string(k), line.name[0] != '\0' ? one_line(line.name) : "-", way, holder});
    }
    io.print(out + (json ? "]}\n" : columns(rows)));
}

}  // namespace detail

/// All cameras, with the nodes that give no pictures.
///
/// Errors  what the system says of the folder where they are listed
template <class System>
Status list_cameras(System& system, const MachineFolders& folders, std::vector<CameraFacts>& cameras,
                    linux_port::Fault& fault) {
    std::vector<DeviceNode> nodes;
    const Status status = device_nodes(system, folders, "video4linux", "video", nodes, fault);
    cameras.clear();
    for (DeviceNode& node : nodes) {
        CameraFacts facts;
        facts.node = node;
        ask_camera(system, facts);
        node.answers = facts.camera;
        cameras.push_back(facts);
    }
    name_nodes(system, folders, "video4linux", nodes);
    for (std::size_t k = 0; k < nodes.size(); ++k) cameras[k].node = nodes[k];
    return status;
}

/// Runs `fovea probe` with the words behind its name, on the machine that Io stands for.
template <class Io>
ExitCode probe_command(Io& io, const std::vector<std::string>& words) {
    const Arguments arguments(probe_help(), words);
    if (arguments.has("help")) {
        io.print(help_of(probe_help()));
        return exit_ok;
    }
    std::string problem = arguments.problem();
    linux_port::CameraWish wish;
    if (problem.empty() && !arguments.operands().empty())
        problem = "it takes no words, not '" + one_line(arguments.operands()[0]) + "'";
    if (problem.empty()) detail::read_wish(arguments, wish, problem);
    if (!problem.empty()) {
        io.complain("fovea probe: " + problem);
        return exit_failed;
    }
    auto system = io.system();
    const MachineFolders folders = io.machine();
    const bool json = arguments.has("json");
    std::vector<CameraFacts> cameras;
    linux_port::Fault fault;
    if (list_cameras(system, folders, cameras, fault) != Status::ok) {
        io.complain("fovea probe: " + std::string(folders.sysfs) + "/class/video4linux: " + fault.call +
                    ": " + linux_port::reason(fault));
        return exit_failed;
    }
    bool found = false;
    for (const CameraFacts& facts : cameras) {
        found = found || facts.camera;
        io.print(json ? detail::camera_json(facts, wish) : detail::camera_text(facts, wish));
    }
    if (!found && !json) io.print("no camera: plug one in, and look whether dmesg tells of it\n");
    for (const DeviceNode& port : detail::serial_ports(system, folders))
        io.print(json ? "{\"schema\":1,\"device\":\"serial\",\"node\":" + json_string(port.path) +
                            ",\"identity\":" + json_string(port.identity) + "}\n"
                      : port.path + ": serial port\n  device = \"" + port.identity + "\"\n");
    std::vector<std::string> chips;
    static_cast<void>(names_in(system, folders.nodes, "gpiochip", chips, fault));
    for (const std::string& chip : chips) detail::tell_chip(io, system, folders, chip, json);
    return found ? exit_ok : exit_not_ok;
}

}  // namespace fovea::apps
