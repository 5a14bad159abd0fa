// SPDX-License-Identifier: MIT
//
// fovead: wires the daemon to the process - its words, its environment and its signals.
#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <string>
#include <vector>

#include <fovea/linux/kernel.hpp>

#include <daemon/fovead.hpp>

#ifndef FOVEA_VERSION
#define FOVEA_VERSION "unknown"
#endif

namespace {

volatile std::sig_atomic_t wants_end = 0;
volatile std::sig_atomic_t wants_reload = 0;
/// Written to by signals, so that who waits for a camera wakes for them.
int pipe_ends[2] = {-1, -1};

void on_signal(int number) {
    if (number == SIGHUP)
        wants_reload = 1;
    else
        wants_end = 1;
    const int kept = errno;
    const char byte = 0;
    // A pipe that is full has woken the program already.
    if (::write(pipe_ends[1], &byte, 1) < 0) errno = kept;
}

fovea::apps::DaemonSignals take_signals() {
    char bytes[64];
    while (::read(pipe_ends[0], bytes, sizeof bytes) > 0) {
    }
    fovea::apps::DaemonSignals signals;
    signals.end = wants_end != 0;
    signals.reload = wants_reload != 0;
    wants_reload = 0;
    return signals;
}

/// The process's own streams.
struct Streams {
    void print(const std::string& text) { std::fwrite(text.data(), 1, text.size(), stdout); }
    void complain(const std::string& text) { std::fprintf(stderr, "%s\n", text.c_str()); }
};

}  // namespace

int main(int count, char** words) {
    if (::pipe2(pipe_ends, O_NONBLOCK | O_CLOEXEC) != 0) {
        std::perror("fovead: pipe");
        return 71;
    }
    struct sigaction action {};
    action.sa_handler = on_signal;
    for (const int number : {SIGTERM, SIGINT, SIGHUP}) ::sigaction(number, &action, nullptr);
    // Who does not read any more, and a file that may not grow, are told by the calls themselves.
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
    Streams streams;
    const fovea::linux_port::NotifyEnvironment environment = {
        std::getenv("NOTIFY_SOCKET"), std::getenv("WATCHDOG_USEC"), std::getenv("WATCHDOG_PID")};
    try {
        return fovea::apps::fovead(std::vector<std::string>(words + 1, words + count), streams,
                                   fovea::linux_port::Kernel(), environment, pipe_ends[0], take_signals,
                                   FOVEA_VERSION);
    } catch (const std::bad_alloc&) {
        // In front of READY, or while settings are read anew.
        std::fputs("fovead: out of memory: give it more, or take a smaller picture\n", stderr);
        return fovea::apps::daemon_no_memory;
    }
}
