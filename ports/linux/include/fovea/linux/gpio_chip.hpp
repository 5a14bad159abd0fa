// SPDX-License-Identifier: MIT
//
// GpioChip: a chip with lines that can be high or low, found by its path or its label, and its lines by their
// names.
#pragma once

#include <linux/gpio.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/base/status.hpp>
#include <fovea/linux/fault.hpp>
#include <fovea/linux/folder.hpp>
#include <fovea/linux/kernel.hpp>
#include <fovea/linux/text.hpp>

namespace fovea::linux_port {

// ---- Interface --------------------------------------------------------------------

/// The character device of a chip (kernel 5.10 and later). Its lines may outlive it.
template <class System = Kernel>
class GpioChip {
public:
    explicit GpioChip(System system = {}, const char* nodes = "/dev") : system_(system), nodes_(nodes) {}
    ~GpioChip() { close(); }
    GpioChip(const GpioChip&) = delete;
    GpioChip& operator=(const GpioChip&) = delete;

    /// A path, the label of a chip, its name ("gpiochip0"), or a part of its label ("pl061" of
    /// "9030000.pl061").
    ///
    /// Errors  bad_argument for no text; not_found; undecided where several labels have that part;
    ///         unsupported for what is no such chip; others of the system
    Status open(const char* chip);
    void close() { static_cast<void>(close_file(system_, file_)); }

    /// The number of a line that is given by its number or its name.
    ///
    /// Errors  not_found; undecided where several lines have that name; others of the system
    Result<std::uint32_t> line(const char* name_or_number);

    /// Of the chip that was opened last.
    const char* name() const { return info_.name; }
    const char* label() const { return info_.label; }
    std::uint32_t lines() const { return info_.lines; }
    int file() const { return file_; }
    System& system() { return system_; }
    const Fault& fault() const { return fault_; }

private:
    Status fail(const char* call, int error, Status status, const char* about) {
        fault_ = {call, error, status, about};
        return status;
    }
    Status open_path(const char* path);
    Status find(const char* label);

    System system_;
    const char* nodes_;
    int file_ = -1;
    gpiochip_info info_{};
    Fault fault_;
};

// ---- Implementation ---------------------------------------------------------------

template <class System>
Status GpioChip<System>::open(const char* chip) {
    close();
    fault_ = {};
    if (chip[0] == '\0') return fail("open", 0, Status::bad_argument, "a chip has a path or a label");
    return chip[0] == '/' ? open_path(chip) : find(chip);
}

template <class System>
Status GpioChip<System>::open_path(const char* path) {
    close();
    file_ = uninterrupted([&] { return system_.open(path, O_RDWR | O_CLOEXEC); });
    if (file_ < 0) return fail("open", -file_, status_of(-file_), "a GPIO chip");
    gpiochip_info info{};
    const int got = uninterrupted([&] { return system_.ioctl(file_, GPIO_GET_CHIPINFO_IOCTL, &info); });
    if (got < 0) {
        close();
        // What is no chip does not know the call; other devices say so in another way.
        const Status status = got == -EINVAL ? Status::unsupported : status_of(-got);
        return fail("GPIO_GET_CHIPINFO", -got, status, "a GPIO chip");
    }
    info.name[sizeof info.name - 1] = info.label[sizeof info.label - 1] = '\0';
    info_ = info;
    return Status::ok;
}

template <class System>
Status GpioChip<System>::find(const char* label) {
    using Path = Text<255>;
    // The label as a whole comes before the name, and that before a part of a label.
    enum { fits_not, fits_part, fits_name, fits_whole };
    int best = fits_not, count = 0;
    Path found;
    const Status status = each_entry(system_, nodes_, fault_, [&](const char* node) {
        if (!begins_with(node, "gpiochip")) return Status::ok;
        const Path path = Path(nodes_).add("/").add(node);
        const Status s = path.fits() ? open_path(path.c_str()) : Status::not_found;
        // A chip may go while we look, and others may not be for this user.
        if (s == Status::not_found || s == Status::device_lost || fault_.error == EACCES) {
            fault_ = {};
            return Status::ok;
        }
        if (s != Status::ok) return s;
        const int fits = std::strcmp(info_.label, label) == 0         ? fits_whole
                         : std::strcmp(info_.name, label) == 0        ? fits_name
                         : std::strstr(info_.label, label) != nullptr ? fits_part
                                                                      : fits_not;
        if (fits == fits_not || fits < best) return Status::ok;
        count = fits > best ? 1 : count + 1;
        best = fits;
        found = path;
        return Status::ok;
    });
    close();
    if (status != Status::ok) return status;
    if (count == 0) return fail("open", 0, Status::not_found, "no GPIO chip has this label");
    if (count > 1) return fail("open", 0, Status::undecided, "several GPIO chips have this in their labels");
    return open_path(found.c_str());
}

template <class System>
Result<std::uint32_t> GpioChip<System>::line(const char* name_or_number) {
    fault_ = {};
    if (file_ < 0) return fail("GPIO_V2_GET_LINEINFO", 0, Status::device_lost, "the chip is not open");
    std::uint64_t number = 0;
    if (parse_number(name_or_number, 0xffffffffu, number)) {
        if (number < info_.lines) return static_cast<std::uint32_t>(number);
        return fail("GPIO_V2_GET_LINEINFO", 0, Status::not_found, "the chip has no line of this number");
    }
    std::uint32_t found = 0;
    int count = 0;
    for (std::uint32_t i = 0; i < info_.lines && name_or_number[0] != '\0'; ++i) {
        gpio_v2_line_info line{};
        line.offset = i;
        const int got =
            uninterrupted([&] { return system_.ioctl(file_, GPIO_V2_GET_LINEINFO_IOCTL, &line); });
        if (got < 0) return fail("GPIO_V2_GET_LINEINFO", -got, status_of(-got), "a line of a GPIO chip");
        line.name[sizeof line.name - 1] = '\0';
        if (std::strcmp(line.name, name_or_number) != 0) continue;
        found = i;
        ++count;
    }
    if (count == 0)
        return fail("GPIO_V2_GET_LINEINFO", 0, Status::not_found, "the chip has no line of this name");
    if (count > 1) return fail("GPIO_V2_GET_LINEINFO", 0, Status::undecided, "several lines have this name");
    return found;
}

}  // namespace fovea::linux_port
