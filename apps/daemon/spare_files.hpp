// SPDX-License-Identifier: MIT
//
// Whether a process may open more files: those that it opens later.
#pragma once

#include <fcntl.h>

#include <fovea/base/status.hpp>
#include <fovea/linux/fault.hpp>
#include <fovea/linux/kernel.hpp>

namespace fovea::apps {

/// What is opened while the daemon runs finds room below the limit of its process: a camera or a port that
/// comes back, the folders in which it is looked for, and a picture that is kept meanwhile.
///
/// Errors  those of opening /dev/null; the fault tells
template <class System>
Status find_spare_files(System system, linux_port::Fault& fault) {
    constexpr int wanted = 4;
    int spare[wanted];
    int count = 0;
    int got = 0;
    while (count < wanted && (got = system.open("/dev/null", O_RDONLY | O_CLOEXEC)) >= 0)
        spare[count++] = got;
    for (int k = 0; k < count; ++k) static_cast<void>(linux_port::close_file(system, spare[k]));
    return count == wanted ? Status::ok : linux_port::refused(fault, "open", got);
}

}  // namespace fovea::apps
