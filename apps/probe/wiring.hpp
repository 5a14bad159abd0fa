// SPDX-License-Identifier: MIT
//
// The checks of the serial port and of the lines that settings name.
#pragma once

#include <linux/gpio.h>

#include <cerrno>
#include <string>

#include <fovea/base/status.hpp>
#include <fovea/linux/device_identity.hpp>
#include <fovea/linux/fault.hpp>
#include <fovea/linux/gpio_chip.hpp>
#include <fovea/linux/serial_port.hpp>

#include <daemon/settings.hpp>
#include <probe/check.hpp>
#include <probe/holders.hpp>
#include <probe/machine.hpp>

namespace fovea::apps {

/// Opens the serial port and closes it again; nothing is sent.
template <class System>
void check_serial(System system, const MachineFolders& folders, const Settings::Serial& settings,
                  CheckList& checks) {
    if (settings.device.empty()) return;
    linux_port::DeviceFinder<System> finder(system, {folders.sysfs, folders.nodes});
    linux_port::DevicePath path;
    if (finder.resolve("tty", settings.device.c_str(), path) != Status::ok)
        return checks.fail(
            "serial",
            std::string("\"") + settings.device.c_str() + "\": " + linux_port::reason(finder.fault()),
            "fovea probe lists the ports that are there");
    linux_port::SerialPort<System> port(system);
    linux_port::SerialOptions options;
    options.baud = static_cast<std::uint32_t>(settings.baud);
    options.rs485 = settings.rs485 ? linux_port::Rs485::on : linux_port::Rs485::as_found;
    if (port.open(path.c_str(), options) == Status::ok)
        return checks.ok("serial", std::string(path.c_str()) + ": opens with " + std::to_string(port.baud()) +
                                       " bits a second");
    const linux_port::Fault fault = port.fault();
    const std::string what = std::string(path.c_str()) + ": " + fault.call + ": " + linux_port::reason(fault);
    if (fault.error == EACCES) {
        const Denial denial = denial_of(system, folders, path.c_str());
        return checks.fail("serial", denial.what, denial.next);
    }
    const bool taken = fault.error == EBUSY || fault.error == EAGAIN;
    const Holders holders = taken ? holders_of(system, folders, path.c_str()) : Holders();
    if (!holders.programs.empty())
        return checks.fail("serial", what + ": " + holders.words() + " has it",
                           "end it first: " + holders.advice());
    checks.fail("serial", what, linux_port::advice(fault));
}

/// Looks whether each line is there and free. None is taken, for the machine behind it would see it change.
template <class System>
void check_lines(System system, const MachineFolders& folders, const Settings& settings, CheckList& checks) {
    const Settings::Lines& names = settings.lines;
    const bool triggered = settings.trigger.source == TriggerSource::line;
    if (names.chip.empty()) return;
    linux_port::GpioChip<System> chip(system, folders.nodes);
    if (chip.open(names.chip.c_str()) != Status::ok) {
        const linux_port::Fault& fault = chip.fault();
        const bool denied = fault.error == EACCES && names.chip.c_str()[0] == '/';
        const Denial denial = denied ? denial_of(system, folders, names.chip.c_str()) : Denial();
        if (denied) return checks.fail("lines", denial.what, denial.next);
        return checks.fail("lines",
                           std::string(names.chip.c_str()) + ": " +
                               (fault.error != 0 ? linux_port::reason(fault) : fault.about),
                           "fovea probe lists the chips; without rights to them none is seen");
    }
    const struct {
        const char* role;
        const Text<63>& name;
    } lines[] = {{"ready", names.ready},
                 {"busy", names.busy},
                 {"valid", names.valid},
                 {"ok", names.ok},
                 {"ng", names.not_ok},
                 {"alarm", names.alarm},
                 {"trigger", settings.trigger.line}};
    int good = 0, bad = 0;
    for (const auto& each : lines) {
        const std::string role = each.role;
        if (role == "trigger" && !triggered) continue;
        if (each.name.empty() && role != "trigger") continue;
        const std::string line = role + " = \"" + each.name.c_str() + "\"";
        const Result<std::uint32_t> number = chip.line(each.name.c_str());
        gpio_v2_line_info info{};
        if (number) info.offset = *number;
        if (!number) {
            ++bad;
            checks.fail("lines", line + ": " + linux_port::reason(chip.fault()),
                        "fovea probe lists the lines of the chip");
        } else if (const int got = linux_port::uninterrupted(
                       [&] { return system.ioctl(chip.file(), GPIO_V2_GET_LINEINFO_IOCTL, &info); });
                   got < 0) {
            ++bad;
            checks.fail("lines", line + ": " + std::strerror(-got), "look at dmesg");
        } else if ((info.flags & GPIO_V2_LINE_FLAG_USED) != 0) {
            ++bad;
            info.consumer[sizeof info.consumer - 1] = '\0';
            const std::string holder = info.consumer[0] != '\0' ? info.consumer : "the kernel";
            checks.fail("lines", line + " is held by " + holder,
                        linux_port::begins_with(info.consumer, "fovea")
                            ? "fovead has it: sudo systemctl stop fovead, and look again"
                            : "take another line, or end what holds it");
        } else {
            ++good;
        }
    }
    if (bad == 0)
        checks.ok("lines",
                  std::string(chip.label()) + ": " + std::to_string(good) + " lines are there and free");
}

}  // namespace fovea::apps
