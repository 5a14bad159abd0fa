// SPDX-License-Identifier: MIT
//
// What the system shows of its devices: the nodes of a class, and the identity by which settings name each.
#pragma once

#include <sys/stat.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include <fovea/base/list.hpp>
#include <fovea/base/status.hpp>
#include <fovea/linux/device_identity.hpp>
#include <fovea/linux/fault.hpp>
#include <fovea/linux/folder.hpp>
#include <fovea/linux/kernel.hpp>

#include <common/text.hpp>

namespace fovea::apps {

/// Where the system shows what it has.
struct MachineFolders {
    const char* sysfs = "/sys";
    const char* nodes = "/dev";
    const char* proc = "/proc";
    const char* groups = "/etc/group";
};

/// A node of a device.
struct DeviceNode {
    std::string name;  ///< "video0"
    std::string path;  ///< "/dev/video0"
    /// The device that it belongs to: of USB all of its interfaces are one.
    std::string device;
    std::string place;     ///< the part of it that "path:" takes; empty if there is none
    std::string usb;       ///< "046d:0825", empty if it is not of USB
    std::string serial;    ///< what it says of itself
    bool answers = true;   ///< it gives what is looked for; settings get the first node of a device that does
    std::string identity;  ///< what settings call it, see name_nodes()
    bool by_number = false;  ///< it has no other name than its number, which may change
};

/// A file as text, at most 64 KiB of it; empty if it cannot be read.
template <class System>
std::string read_text(System& system, const std::string& path) {
    int file = linux_port::uninterrupted([&] { return system.open(path.c_str(), O_RDONLY | O_CLOEXEC); });
    std::string text;
    std::uint8_t bytes[4096];
    while (file >= 0 && text.size() < 65536) {
        const std::ptrdiff_t got = linux_port::uninterrupted([&] { return system.read(file, bytes); });
        if (got <= 0) break;
        text.append(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(got));
    }
    static_cast<void>(linux_port::close_file(system, file));
    return text;
}

/// The first line of a small file; empty if it cannot be read.
template <class System>
std::string first_line(System& system, const std::string& path) {
    char line[256];
    return linux_port::read_line(system, path.c_str(), line) == 0 ? line : "";
}

/// The names in a folder that begin so, those with the lowest number first.
///
/// Errors  as each_entry()
template <class System>
Status names_in(System& system, const std::string& folder, const char* begin, std::vector<std::string>& names,
                linux_port::Fault& fault) {
    names.clear();
    const Status status = linux_port::each_entry(system, folder.c_str(), fault, [&](const char* name) {
        if (linux_port::begins_with(name, begin)) names.push_back(name);
        return Status::ok;
    });
    std::sort(names.begin(), names.end(), [](const std::string& a, const std::string& b) {
        return a.size() != b.size() ? a.size() < b.size() : a < b;
    });
    return status;
}

namespace detail {

/// Fills in where a node is plugged in and what its USB device says of itself.
template <class System>
void look_up(System& system, const MachineFolders& folders, const char* class_name, DeviceNode& node) {
    const std::string entry = std::string(folders.sysfs) + "/class/" + class_name + "/" + node.name;
    char target[512];
    const std::ptrdiff_t got =
        linux_port::uninterrupted([&] { return system.read_link(entry.c_str(), Span<char>(target)); });
    std::string place(target, got > 0 ? static_cast<std::size_t>(got) : 0);
    place = place.substr(0, place.find(std::string("/") + class_name + "/" + node.name));
    const auto last = [](const std::string& path) { return path.substr(path.rfind('/') + 1); };
    // A port of a USB adapter is called by its number, which may change: its interface is above it.
    if (last(place) == node.name) place = place.substr(0, place.rfind('/'));
    if (last(place) != "virtual" && last(place) != "platform") node.place = last(place);
    node.device = place;
    std::string folder = entry + "/device";
    for (int up = 0; up <= 2 && !node.place.empty(); ++up, folder += "/..") {
        const std::string vendor = first_line(system, folder + "/idVendor");
        if (vendor.empty()) continue;
        node.usb = vendor + ":" + first_line(system, folder + "/idProduct");
        node.serial = first_line(system, folder + "/serial");
        const std::size_t colon = place.rfind(':');
        if (colon != std::string::npos) node.device = place.substr(0, colon);
        break;
    }
}

}  // namespace detail

/// The nodes of a class of /sys/class whose names begin so. Without the class there are none.
///
/// Errors  what the system says of the folder
template <class System>
Status device_nodes(System& system, const MachineFolders& folders, const char* class_name, const char* begin,
                    std::vector<DeviceNode>& nodes, linux_port::Fault& fault) {
    nodes.clear();
    std::vector<std::string> names;
    const Status status =
        names_in(system, std::string(folders.sysfs) + "/class/" + class_name, begin, names, fault);
    if (status == Status::not_found) return Status::ok;
    for (const std::string& name : names) {
        DeviceNode node;
        node.name = name;
        node.path = std::string(folders.nodes) + "/" + name;
        detail::look_up(system, folders, class_name, node);
        nodes.push_back(node);
    }
    return status;
}

/// Gives each node the identity that settings are to have: one that finds it, and no other device, wherever
/// it is plugged in; if there is none, one that finds it at its place; at last its number. Two devices of one
/// kind without serial numbers are told apart by their places.
template <class System>
void name_nodes(System& system, const MachineFolders& folders, const char* class_name,
                std::vector<DeviceNode>& nodes) {
    linux_port::DeviceFinder<System> finder(system, {folders.sysfs, folders.nodes});
    const bool alone = std::strcmp(class_name, "tty") == 0;  // there the first of several is not taken
    const auto finds = [&](const std::string& identity, const DeviceNode& wanted) {
        List<linux_port::DevicePath, 32> found;
        if (identity.size() > 191 || !printable(identity)) return false;
        if (finder.find(class_name, identity.c_str(), found) != Status::ok) return false;
        const DeviceNode* first = nullptr;
        for (const linux_port::DevicePath& path : found)
            for (const DeviceNode& node : nodes) {
                if (node.path != path.c_str()) continue;
                if (node.device != wanted.device || (alone && node.path != wanted.path)) return false;
                if (first == nullptr && node.answers) first = &node;
            }
        return first == &wanted;
    };
    for (DeviceNode& node : nodes) {
        std::vector<std::string> names;
        if (!node.usb.empty())
            names.push_back("usb:" + node.usb + (node.serial.empty() ? "" : ":" + node.serial));
        if (!node.place.empty()) names.push_back("path:" + node.place);
        for (const std::string& name : names)
            if (node.identity.empty() && finds(name, node)) node.identity = name;
        node.by_number = node.identity.empty();
        if (node.by_number) node.identity = node.path;
    }
}

}  // namespace fovea::apps
