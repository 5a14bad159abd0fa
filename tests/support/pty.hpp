// SPDX-License-Identifier: MIT
//
// Pty: a pseudo-terminal, whose far end is in the hands of a test. Host tests only.
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <unistd.h>

#include <cstddef>
#include <string>

namespace fovea::test {

/// The far end does not wait, either.
class Pty {
public:
    Pty() : file_(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)) {
        char name[64] = "";
        if (file_ >= 0 && ::grantpt(file_) == 0 && ::unlockpt(file_) == 0 &&
            ::ptsname_r(file_, name, sizeof name) == 0)
            path_ = name;
    }
    ~Pty() { hang_up(); }
    Pty(const Pty&) = delete;
    Pty& operator=(const Pty&) = delete;

    /// What is to be opened as a serial port.
    const char* path() const { return path_.c_str(); }
    int file() const { return file_; }
    /// False if not all of it went.
    bool say(const std::string& text) {
        return ::write(file_, text.data(), text.size()) == static_cast<ssize_t>(text.size());
    }
    /// What has arrived: all there is, and as many bytes at least as a test expects. They go through a queue
    /// of the kernel, for which it waits up to two seconds; where nothing is expected, a little.
    std::string heard(std::size_t expected = 0) {
        std::string all;
        char some[4096];
        const auto patience_ms = [&] { return all.size() < expected ? 2000 : expected == 0 ? 20 : 0; };
        for (pollfd one = {file_, POLLIN, 0}; ::poll(&one, 1, patience_ms()) > 0;) {
            const ssize_t got = ::read(file_, some, sizeof some);
            if (got <= 0) break;
            all.append(some, static_cast<std::size_t>(got));
        }
        return all;
    }
    void hang_up() {
        if (file_ >= 0) ::close(file_);
        file_ = -1;
    }

private:
    int file_;
    std::string path_;
};

}  // namespace fovea::test
