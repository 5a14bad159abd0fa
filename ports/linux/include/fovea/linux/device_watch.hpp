// SPDX-License-Identifier: MIT
//
// DeviceWatch: tells that a device may have come, so that nobody has to look for it all the time.
#pragma once

#include <sys/inotify.h>

#include <cstdint>

#include <fovea/base/status.hpp>
#include <fovea/linux/fault.hpp>
#include <fovea/linux/kernel.hpp>

namespace fovea::linux_port {

/// Watches the folder of the nodes: one that is made, or whose rights change, which is what follows.
///
/// Source  inotify(7)
template <class System = Kernel>
class DeviceWatch {
public:
    explicit DeviceWatch(System system = {}) : system_(system) {}
    DeviceWatch(const DeviceWatch&) = delete;
    DeviceWatch& operator=(const DeviceWatch&) = delete;
    ~DeviceWatch() { close(); }

    /// Errors  as the calls say; it can be done without
    Status open(const char* folder = "/dev") {
        close();
        const int got = system_.begin_watch();
        if (got < 0) return refused(fault_, "inotify_init1", got);
        file_ = got;
        const int watched = system_.watch(file_, folder, IN_CREATE | IN_ATTRIB | IN_MOVED_TO);
        if (watched >= 0) return Status::ok;
        close();
        return refused(fault_, "inotify_add_watch", watched);
    }
    void close() { static_cast<void>(close_file(system_, file_)); }

    /// True if something has happened since the last call.
    bool take() {
        bool happened = false;
        alignas(8) std::uint8_t events[4096];
        // What a folder tells in a moment fits a few times.
        for (int most = 16; file_ >= 0 && most > 0; --most) {
            if (system_.read(file_, events) <= 0) break;
            happened = true;
        }
        return happened;
    }

    /// For poll; -1 where nothing is watched.
    int file() const { return file_; }
    const Fault& fault() const { return fault_; }

private:
    System system_;
    int file_ = -1;
    Fault fault_;
};

}  // namespace fovea::linux_port
