// SPDX-License-Identifier: MIT
//
// The files of the daemon: its settings, and the jobs beside them.
#pragma once

#include <cerrno>
#include <string>
#include <vector>

#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/linux/fault.hpp>
#include <fovea/linux/file_storage.hpp>
#include <fovea/linux/folder.hpp>
#include <fovea/linux/kernel.hpp>

#include <common/io.hpp>
#include <daemon/jobs.hpp>
#include <daemon/settings.hpp>
#include <daemon/settings_reader.hpp>

namespace fovea::apps {

/// Settings with their jobs, as they stand in files; problem is one line for a person.
struct DaemonFiles {
    Settings settings;
    JobList jobs;
    int job = 0;
    std::string problem;
    /// The settings could be read, whatever became of the jobs.
    bool settings_good = false;
    /// They could not be read for want of a file to open them with: they may be good.
    bool no_file_left = false;
};

/// A path below the folder of another file, if it is not absolute.
inline std::string beside(const std::string& file, const std::string& path) {
    const std::size_t slash = file.rfind('/');
    if (path.empty() || path[0] == '/' || slash == std::string::npos) return path;
    return file.substr(0, slash + 1) + path;
}

/// Reads the settings and all jobs.
inline DaemonFiles read_daemon_files(const std::string& path) {
    DaemonFiles files;
    const auto starved = [](const linux_port::Fault& fault) {
        return fault.error == EMFILE || fault.error == ENFILE;
    };
    linux_port::FileStorage<> storage({}, std::size_t{1} << 20);
    const Result<Span<const std::uint8_t>> text = storage.load(path.c_str());
    if (!text) {
        files.problem = file_problem(path, text.status(), storage);
        files.no_file_left = starved(storage.fault());
        return files;
    }
    const SettingsProblem found = read_settings(std::string(text->begin(), text->end()), files.settings);
    if (!found.problem.empty()) {
        files.problem = path + ":" + std::to_string(found.place.line) + ":" +
                        std::to_string(found.place.column) + ": " + found.problem;
        return files;
    }
    files.settings_good = true;
    const std::string folder = beside(path, files.settings.jobs.folder.c_str());
    std::vector<std::string> names;
    linux_port::Kernel kernel;
    linux_port::Fault fault;
    const Status listed = linux_port::each_entry(kernel, folder.c_str(), fault, [&](const char* name) {
        names.push_back(name);
        return Status::ok;
    });
    if (listed != Status::ok) {
        files.problem =
            folder + ": " + linux_port::reason(fault) + "; the folder of the jobs is set in [jobs]";
        files.no_file_left = starved(fault);
        return files;
    }
    files.problem = files.jobs.read(storage, folder, job_names(names));
    if (!files.problem.empty()) {
        files.no_file_left = starved(storage.fault());
        return files;
    }
    const Size picture{static_cast<int>(files.settings.camera.width),
                       static_cast<int>(files.settings.camera.height)};
    // Of a camera that is asked for its size no more is known here.
    if (picture.width > 0 && picture.height > 0) files.problem = files.jobs.fit(folder, picture);
    if (!files.problem.empty()) return files;
    const Text<63>& start = files.settings.jobs.start;
    files.job = start.empty() ? 1 : files.jobs.find({start.c_str(), start.size()}, 0);
    if (files.job == 0) files.problem = path + ": [jobs] start: no job " + start.c_str() + " in " + folder;
    return files;
}

}  // namespace fovea::apps
