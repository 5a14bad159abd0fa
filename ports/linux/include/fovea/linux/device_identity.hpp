// SPDX-License-Identifier: MIT
//
// Which node a device has today: what a user writes of it - a path, a USB identity, a place - and the nodes
// that fit.
#pragma once

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/base/list.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/linux/fault.hpp>
#include <fovea/linux/folder.hpp>
#include <fovea/linux/kernel.hpp>
#include <fovea/linux/text.hpp>

namespace fovea::linux_port {

// ---- Interface --------------------------------------------------------------------

/// Where a device can be opened.
using DevicePath = Text<191>;

/// Where the system shows its devices.
struct DeviceFolders {
    const char* sysfs = "/sys";
    const char* nodes = "/dev";
};

/// Looks for devices anew with every call, for a device that was plugged in again may have another number.
///
/// An identity is one of
///   /dev/ttyUSB0            the node, or a link to it, as those of /dev/serial/by-id
///   usb:0403:6001[:SERIAL]  vendor and product of a USB device in four hexadecimal digits each, and what it
///                           says of itself as its serial number
///   path:NAME               a name of /dev/serial/by-path or /dev/v4l/by-path; or parts of its place in /sys
///                           that follow each other, as 1-1.2:1.0 or fe801000.csi
///   auto                    all of the class that have a device behind them
template <class System = Kernel>
class DeviceFinder {
public:
    explicit DeviceFinder(System system = {}, DeviceFolders folders = {})
        : system_(system), folders_(folders) {}

    /// All nodes of a class of /sys/class ("tty", "video4linux") that fit, those with the lowest number
    /// first. A path is one node, whether it is there or not. After an error the list is empty.
    ///
    /// Errors  bad_argument for what is no identity; not_found; capacity_exceeded, with the list full of the
    ///         first; others of the system
    Status find(const char* class_name, const char* identity, ListView<DevicePath> paths);

    /// The one node that fits.
    ///
    /// Errors  as find(), and undecided where several fit: which of them may change from one day to the next
    Status resolve(const char* class_name, const char* identity, DevicePath& path);

    const Fault& fault() const { return fault_; }

private:
    using SysPath = Text<511>;
    /// Above the device of a node lies its interface, and above that what has the identity.
    static constexpr int most_steps_up = 2;

    Status fail(const char* call, int error, Status status, const char* about) {
        fault_ = {call, error, status, about};
        return status;
    }
    /// A device may go while we look, and not all have what we look for.
    static bool absent(int answer) {
        return answer == -ENOENT || answer == -ENODEV || answer == -ENXIO || answer == -ENOTDIR ||
               answer == -EINVAL;
    }
    SysPath entry(const char* class_name, const char* node) const {
        return SysPath(folders_.sysfs).add("/class/").add(class_name).add("/").add(node);
    }
    Status fits(const char* class_name, const char* node, const char* identity, bool& answer);
    enum class Attribute : std::uint8_t { absent, other, same };
    Status compare(const SysPath& folder, const char* file, Span<const char> expected, Attribute& what);
    Status fits_usb(const SysPath& device, const char* identity, bool& answer);
    Status fits_place(const SysPath& node, const char* part, bool& answer);
    Status find_by_path(const char* class_name, const char* name, ListView<DevicePath> paths);

    System system_;
    DeviceFolders folders_;
    Fault fault_;
};

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Of "0403:6001" and the like: false if it does not begin so.
inline bool is_usb_number(const char* text) {
    for (int i = 0; i < 9; ++i) {
        const char byte = text[i];
        const bool hexadecimal =
            (byte >= '0' && byte <= '9') || (byte >= 'a' && byte <= 'f') || (byte >= 'A' && byte <= 'F');
        if (i == 4 ? byte != ':' : !hexadecimal) return false;
    }
    return text[9] == '\0' || (text[9] == ':' && text[10] != '\0');
}

/// ttyUSB2 before ttyUSB10.
inline bool is_before(const DevicePath& a, const DevicePath& b) {
    return a.size() != b.size() ? a.size() < b.size() : std::strcmp(a.c_str(), b.c_str()) < 0;
}

/// Into its place. A list that is full loses its last.
inline Status insert_sorted(const DevicePath& path, ListView<DevicePath> paths) {
    const bool full = paths.full();
    if (full && (paths.empty() || !is_before(path, paths[paths.size() - 1])))
        return Status::capacity_exceeded;
    if (!full) static_cast<void>(paths.append());
    int place = paths.size() - 1;
    for (; place > 0 && is_before(path, paths[place - 1]); --place) paths[place] = paths[place - 1];
    paths[place] = path;
    return full ? Status::capacity_exceeded : Status::ok;
}

}  // namespace detail

template <class System>
Status DeviceFinder<System>::find(const char* class_name, const char* identity, ListView<DevicePath> paths) {
    fault_ = {};
    paths.clear();
    const bool usb = begins_with(identity, "usb:"), place = begins_with(identity, "path:");
    if (usb && !detail::is_usb_number(identity + 4))
        return fail("find", 0, Status::bad_argument,
                    "usb: is followed by VENDOR:PRODUCT or VENDOR:PRODUCT:SERIAL");
    if (place && identity[5] == '\0')
        return fail("find", 0, Status::bad_argument, "path: is followed by a place");
    if (!usb && !place && std::strcmp(identity, "auto") != 0) {
        const DevicePath path(identity);
        if (identity[0] != '/' || !path.fits())
            return fail("find", 0, Status::bad_argument, "a device is a path from / on, usb:, path: or auto");
        return paths.push(path);
    }
    if (place)
        if (const Status s = find_by_path(class_name, identity + 5, paths); s != Status::not_found) return s;

    bool more = false;
    const Status status = each_entry(
        system_, SysPath(folders_.sysfs).add("/class/").add(class_name).c_str(), fault_,
        [&](const char* node) {
            bool answer = false;
            if (const Status s = fits(class_name, node, identity, answer); s != Status::ok || !answer)
                return s;
            const DevicePath path = DevicePath(folders_.nodes).add("/").add(node);
            if (path.fits() && detail::insert_sorted(path, paths) != Status::ok) more = true;
            return Status::ok;
        });
    if (status != Status::ok) {
        paths.clear();
        return status;
    }
    if (more) return fail("find", 0, Status::capacity_exceeded, "more devices than places for them");
    return paths.empty() ? fail("find", 0, Status::not_found, "no device is like that") : Status::ok;
}

template <class System>
Status DeviceFinder<System>::resolve(const char* class_name, const char* identity, DevicePath& path) {
    List<DevicePath, 1> one;
    const Status status = find(class_name, identity, one);
    if (status == Status::capacity_exceeded)
        return fail("find", 0, Status::undecided,
                    "several devices are like that: add the serial number, or write path:");
    if (status == Status::ok) path = one[0];
    return status;
}

template <class System>
Status DeviceFinder<System>::fits(const char* class_name, const char* node, const char* identity,
                                  bool& answer) {
    SysPath path = entry(class_name, node);
    if (begins_with(identity, "path:")) return fits_place(path, identity + 5, answer);
    path.add("/device");
    char target[512];
    const std::ptrdiff_t got = uninterrupted([&] { return system_.read_link(path.c_str(), target); });
    if (got < 0)
        return absent(static_cast<int>(got)) ? Status::ok
                                             : fail("readlink", static_cast<int>(-got),
                                                    status_of(static_cast<int>(-got)), "a device of /sys");
    answer = true;
    return begins_with(identity, "usb:") ? fits_usb(path, identity + 4, answer) : Status::ok;
}

template <class System>
Status DeviceFinder<System>::compare(const SysPath& folder, const char* file, Span<const char> expected,
                                     Attribute& what) {
    char text[256];
    const int got = read_line(system_, SysPath(folder).add(file).c_str(), text);
    what = Attribute::absent;
    if (absent(got)) return Status::ok;
    if (got < 0) return fail("read", -got, status_of(-got), "the identity of a USB device");
    const std::size_t size = static_cast<std::size_t>(expected.size());
    const bool same = std::strlen(text) == size && std::memcmp(text, expected.data(), size) == 0;
    what = same ? Attribute::same : Attribute::other;
    return Status::ok;
}

template <class System>
Status DeviceFinder<System>::fits_usb(const SysPath& device, const char* identity, bool& answer) {
    char numbers[9];
    for (int i = 0; i < 9; ++i)
        numbers[i] =
            identity[i] >= 'A' && identity[i] <= 'F' ? static_cast<char>(identity[i] + 32) : identity[i];
    answer = false;
    SysPath folder = device;
    for (int step = 0; step <= most_steps_up; ++step, folder.add("/..")) {
        Attribute what = Attribute::absent;
        Status status = compare(folder, "/idVendor", {numbers, 4}, what);
        if (status == Status::ok && what == Attribute::absent) continue;
        if (status == Status::ok && what == Attribute::same)
            status = compare(folder, "/idProduct", {numbers + 5, 4}, what);
        if (status == Status::ok && what == Attribute::same && identity[9] == ':') {
            const char* const serial = identity + 10;
            status =
                compare(folder, "/serial", {serial, static_cast<std::ptrdiff_t>(std::strlen(serial))}, what);
        }
        answer = status == Status::ok && what == Attribute::same;
        return status;
    }
    return Status::ok;
}

template <class System>
Status DeviceFinder<System>::fits_place(const SysPath& node, const char* part, bool& answer) {
    char target[512];
    const Span<char> most(target, static_cast<std::ptrdiff_t>(sizeof target) - 1);
    const std::ptrdiff_t got = uninterrupted([&] { return system_.read_link(node.c_str(), most); });
    if (got < 0)
        return absent(static_cast<int>(got)) ? Status::ok
                                             : fail("readlink", static_cast<int>(-got),
                                                    status_of(static_cast<int>(-got)), "a device of /sys");
    target[got] = '\0';
    const std::size_t size = std::strlen(part);
    for (const char* found = std::strstr(target, part); found != nullptr;
         found = std::strstr(found + 1, part)) {
        const bool whole =
            (found == target || found[-1] == '/') && (found[size] == '/' || found[size] == '\0');
        if (whole) answer = true;
    }
    return Status::ok;
}

template <class System>
Status DeviceFinder<System>::find_by_path(const char* class_name, const char* name,
                                          ListView<DevicePath> paths) {
    const char* const kind = std::strcmp(class_name, "video4linux") == 0 ? "v4l"
                             : std::strcmp(class_name, "tty") == 0       ? "serial"
                                                                         : class_name;
    const DevicePath path = DevicePath(folders_.nodes).add("/").add(kind).add("/by-path/").add(name);
    if (!path.fits() || std::strchr(name, '/') != nullptr) return Status::not_found;
    struct stat what {};
    const int got = uninterrupted([&] { return system_.about(path.c_str(), what); });
    if (absent(got)) return Status::not_found;
    if (got < 0) return fail("stat", -got, status_of(-got), "a link of /dev");
    return paths.push(path);
}

}  // namespace fovea::linux_port
