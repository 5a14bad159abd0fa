// SPDX-License-Identifier: MIT
//
// SerialOpening: opens the serial port that the settings name, wherever it is plugged in today.
#pragma once

#include <cstdint>

#include <fovea/base/status.hpp>
#include <fovea/linux/device_identity.hpp>
#include <fovea/linux/fault.hpp>
#include <fovea/linux/serial_port.hpp>

#include <daemon/settings.hpp>

namespace fovea::apps {

template <class System>
class SerialOpening {
public:
    SerialOpening(const Settings::Serial& settings, System system) : settings_(settings), finder_(system) {}

    Status operator()(linux_port::SerialPort<System>& port) {
        linux_port::DevicePath path;
        if (const Status s = finder_.resolve("tty", settings_.device.c_str(), path); s != Status::ok) {
            fault_ = finder_.fault();
            return s;
        }
        linux_port::SerialOptions options;
        options.baud = static_cast<std::uint32_t>(settings_.baud);
        options.rs485 = settings_.rs485 ? linux_port::Rs485::on : linux_port::Rs485::as_found;
        const Status got = port.open(path.c_str(), options);
        fault_ = port.fault();
        return got;
    }

    const linux_port::Fault& fault() const { return fault_; }

private:
    Settings::Serial settings_;
    linux_port::DeviceFinder<System> finder_;
    linux_port::Fault fault_;
};

}  // namespace fovea::apps
