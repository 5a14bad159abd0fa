// SPDX-License-Identifier: MIT
//
// Who has a device, and who may have it: what to tell a person whose program was refused.
#pragma once

#include <sys/stat.h>

#include <string>
#include <vector>

#include <fovea/linux/kernel.hpp>

#include <common/text.hpp>
#include <probe/machine.hpp>

namespace fovea::apps {

/// The programs that have a file open.
struct Holders {
    struct Program {
        int id = 0;
        std::string name;
    };
    std::vector<Program> programs;
    /// Of some programs this user may not see what they have open.
    bool some_hidden = false;

    /// "mpv (process 312) and fovead (process 7)"; empty if none is known.
    std::string words() const {
        std::vector<std::string> all;
        for (const Program& each : programs)
            all.push_back(each.name + " (process " + std::to_string(each.id) + ")");
        return listed(all);
    }
    /// What to do about them.
    std::string advice() const {
        if (programs.empty()) return some_hidden ? "run this as root to see which program has it" : "";
        for (const Program& each : programs)
            if (each.name == "fovead") return "sudo systemctl stop fovead, and look again";
        return "kill " + std::to_string(programs[0].id) + ", if it may end";
    }
};

namespace detail {

inline bool same_file(const struct stat& a, const struct stat& b) {
    if (S_ISCHR(a.st_mode) && S_ISCHR(b.st_mode)) return a.st_rdev == b.st_rdev;
    return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

}  // namespace detail

/// Looks through the open files of all programs but this one.
template <class System>
Holders holders_of(System& system, const MachineFolders& folders, const std::string& path) {
    Holders holders;
    struct stat wanted {};
    if (system.about(path.c_str(), wanted) < 0) return holders;
    std::vector<std::string> processes, files;
    linux_port::Fault fault;
    static_cast<void>(names_in(system, folders.proc, "", processes, fault));
    for (const std::string& process : processes) {
        std::uint64_t id = 0;
        if (!linux_port::parse_number(process.c_str(), 1u << 30, id)) continue;
        if (static_cast<int>(id) == system.process_id()) continue;
        const std::string folder = std::string(folders.proc) + "/" + process;
        fault = {};
        if (names_in(system, folder + "/fd", "", files, fault) != Status::ok) {
            if (fault.error == EACCES || fault.error == EPERM) holders.some_hidden = true;
            continue;
        }
        for (const std::string& file : files) {
            struct stat what {};
            if (system.about((folder + "/fd/" + file).c_str(), what) < 0) continue;
            if (!detail::same_file(what, wanted)) continue;
            holders.programs.push_back({static_cast<int>(id), first_line(system, folder + "/comm")});
            break;
        }
    }
    return holders;
}

/// Why a program was denied a file, and what would help.
struct Denial {
    std::string what;
    std::string next;
};

namespace detail {

/// The numbers behind "Groups:" and the like in /proc/self/status.
inline std::vector<unsigned> numbers_of(const std::string& status, const std::string& word) {
    std::vector<unsigned> numbers;
    const std::size_t start = ("\n" + status).find("\n" + word + ":");
    if (start == std::string::npos) return numbers;
    std::size_t at = start + word.size() + 1;
    for (bool digit_before = false; at < status.size() && status[at] != '\n'; ++at) {
        const bool digit = status[at] >= '0' && status[at] <= '9';
        if (digit && !digit_before) numbers.push_back(0);
        if (digit) numbers.back() = numbers.back() * 10 + static_cast<unsigned>(status[at] - '0');
        digit_before = digit;
    }
    return numbers;
}

/// The name of a group in a file as /etc/group is; its number if it has none there.
inline std::string group_name(const std::string& groups, unsigned number) {
    for (const std::string& line : split(groups, '\n')) {
        const std::vector<std::string> fields = split(line, ':');
        if (fields.size() >= 3 && fields[2] == std::to_string(number)) return fields[0];
    }
    return std::to_string(number);
}

}  // namespace detail

/// Of a device that could not be opened for EACCES.
template <class System>
Denial denial_of(System& system, const MachineFolders& folders, const std::string& path) {
    struct stat file {};
    if (system.about(path.c_str(), file) < 0)
        return {path + " cannot be looked at: a folder above it is closed to this user", "run this as root"};
    const std::string status = read_text(system, std::string(folders.proc) + "/self/status");
    std::vector<unsigned> groups = detail::numbers_of(status, "Groups");
    const std::vector<unsigned> own = detail::numbers_of(status, "Gid");
    groups.insert(groups.end(), own.begin(), own.end());
    const std::string group = detail::group_name(read_text(system, folders.groups), file.st_gid);
    const bool member = std::find(groups.begin(), groups.end(), file.st_gid) != groups.end();
    const bool open_to_group = (file.st_mode & 0060) == 0060;
    if (open_to_group && !member)
        return {path + " is for the group " + group + ", and this user is not in it",
                "sudo usermod -aG " + group + " $USER, then log in again; a service has " + group +
                    " in its SupplementaryGroups="};
    if (!open_to_group)
        return {path + " may not be read and written by its group " + group,
                "a udev rule with GROUP=\"" + group + "\", MODE=\"0660\" opens it"};
    return {path + " is for the group " + group + ", in which this user is, and yet it is refused",
            "a sandbox forbids it: see DeviceAllow= of the unit, or the rules of the container"};
}

}  // namespace fovea::apps
