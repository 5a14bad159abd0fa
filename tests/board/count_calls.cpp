// SPDX-License-Identifier: MIT
//
// Counts the system calls that a program makes, each one, while it goes on as it would:
//   count_calls PROCESS MILLISECONDS
// prints "calls N turns N us N": all calls, those of them that wait in ppoll, and the time. To read the clock
// is none.
#include <sys/ptrace.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <set>
#include <string>

namespace {

volatile std::sig_atomic_t over = 0;

long long now_us() {
    timespec now{};
    ::clock_gettime(CLOCK_MONOTONIC, &now);
    return static_cast<long long>(now.tv_sec) * 1000000 + now.tv_nsec / 1000;
}

struct Count {
    long calls = 0;
    long turns = 0;

    /// The thread has stopped: where it begins a call, that is one.
    void take(pid_t thread) {
        __ptrace_syscall_info info{};
        if (::ptrace(PTRACE_GET_SYSCALL_INFO, thread, sizeof info, &info) <= 0) return;
        if (info.op != PTRACE_SYSCALL_INFO_ENTRY) return;
        ++calls;
        if (info.entry.nr == SYS_ppoll) ++turns;
    }
};

}  // namespace

int main(int count, char** words) {
    if (count != 3) return std::puts("usage: count_calls PROCESS MILLISECONDS"), 2;
    std::set<pid_t> threads;
    for (const auto& entry : std::filesystem::directory_iterator("/proc/" + std::string(words[1]) + "/task"))
        threads.insert(std::atoi(entry.path().filename().c_str()));
    for (const pid_t thread : threads)
        if (::ptrace(PTRACE_SEIZE, thread, 0, PTRACE_O_TRACESYSGOOD) != 0 ||
            ::ptrace(PTRACE_INTERRUPT, thread, 0, 0) != 0)
            return std::perror("count_calls: ptrace"), 1;

    // Without SA_RESTART: it ends the wait for a thread that sleeps.
    struct sigaction action {};
    action.sa_handler = [](int) { over = 1; };
    ::sigaction(SIGALRM, &action, nullptr);
    const int milliseconds = std::atoi(words[2]);
    const itimerval end = {{0, 10000}, {milliseconds / 1000, milliseconds % 1000 * 1000}};
    const long long begin_us = now_us();
    ::setitimer(ITIMER_REAL, &end, nullptr);
    Count seen;
    while (over == 0) {
        int status = 0;
        const pid_t thread = ::waitpid(-1, &status, __WALL);
        if (thread < 0 && errno == EINTR) continue;
        if (thread < 0 || !WIFSTOPPED(status)) return std::puts("count_calls: the program has ended"), 1;
        const int signal = WSTOPSIG(status);
        if (signal == (SIGTRAP | 0x80)) seen.take(thread);
        // A signal of its own is passed on; a stop of ours is none.
        const bool ours = signal == (SIGTRAP | 0x80) || status >> 16 != 0;
        ::ptrace(PTRACE_SYSCALL, thread, 0, ours ? 0L : static_cast<long>(signal));
    }
    std::printf("calls %ld turns %ld us %lld\n", seen.calls, seen.turns, now_us() - begin_us);
    // The end of this program lets them go.
    return 0;
}
