// SPDX-License-Identifier: MIT
//
// FailingSystem: the calls of the Linux ports with one of them failing, and an account of what was not given
// back.
#pragma once

#include <linux/gpio.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <set>
#include <string>

#include <fovea/linux/kernel.hpp>

namespace fovea::test {

/// What a FailingSystem is to do, and what it saw. Lives longer than the handles to it.
struct SystemScript {
    /// The call to fail, counted from 1; 0 for none.
    int fail_at = 0;
    int error = EIO;
    /// Every call from that one on fails, as when a device is gone.
    bool for_ever = false;

    int calls = 0;
    /// The call that failed first.
    std::string failed;
    std::set<int> open_files;
    std::map<std::uint8_t*, std::size_t> mappings;
    /// Files closed and memory unmapped that were not open or mapped: a second time, or never.
    int returned_twice = 0;

    bool all_given_back() const { return open_files.empty() && mappings.empty() && returned_twice == 0; }
};

/// A handle to the calls of Inner, as a script has them. close() and unmap() do their work even where they
/// answer an error, as a kernel does.
template <class Inner = linux_port::Kernel>
class FailingSystem {
public:
    explicit FailingSystem(SystemScript& script, Inner inner = {}) : script_(&script), inner_(inner) {}

    int open(const char* path, int flags, unsigned mode = 0) {
        if (fails("open")) return -script_->error;
        const int file = inner_.open(path, flags, mode);
        if (file >= 0) script_->open_files.insert(file);
        return file;
    }
    int close(int file) {
        const bool failing = fails("close");
        if (script_->open_files.erase(file) == 0) ++script_->returned_twice;
        const int got = inner_.close(file);
        return failing ? -script_->error : got;
    }
    int stop_waiting(int file) { return fails("stop_waiting") ? -script_->error : inner_.stop_waiting(file); }
    int lock(int file) { return fails("lock") ? -script_->error : inner_.lock(file); }
    std::ptrdiff_t read(int file, Span<std::uint8_t> into) {
        return fails("read") ? -script_->error : inner_.read(file, into);
    }
    std::ptrdiff_t write(int file, Span<const std::uint8_t> bytes) {
        return fails("write") ? -script_->error : inner_.write(file, bytes);
    }
    int ioctl(int file, unsigned long request, void* argument) {
        if (fails("ioctl")) return -script_->error;
        const int got = inner_.ioctl(file, request, argument);
        // This one opens a file.
        if (request == GPIO_V2_GET_LINE_IOCTL && got >= 0)
            script_->open_files.insert(static_cast<gpio_v2_line_request*>(argument)->fd);
        return got;
    }
    int poll(Span<pollfd> files, std::int64_t patience_us) {
        return fails("poll") ? -script_->error : inner_.poll(files, patience_us);
    }
    std::ptrdiff_t map(int file, std::int64_t offset, std::size_t length, std::uint8_t*& memory) {
        if (fails("map")) return -script_->error;
        const std::ptrdiff_t got = inner_.map(file, offset, length, memory);
        if (got == 0) script_->mappings[memory] = length;
        return got;
    }
    int unmap(std::uint8_t* memory, std::size_t length) {
        const bool failing = fails("unmap");
        const auto found = script_->mappings.find(memory);
        if (found == script_->mappings.end() || found->second != length)
            ++script_->returned_twice;
        else
            script_->mappings.erase(found);
        const int got = inner_.unmap(memory, length);
        return failing ? -script_->error : got;
    }
    int sync(int file) { return fails("sync") ? -script_->error : inner_.sync(file); }
    int rename(const char* from, const char* to) {
        return fails("rename") ? -script_->error : inner_.rename(from, to);
    }
    int make_folder(const char* path, unsigned mode) {
        return fails("make_folder") ? -script_->error : inner_.make_folder(path, mode);
    }
    int remove(const char* path) { return fails("remove") ? -script_->error : inner_.remove(path); }
    int about(const char* path, struct stat& what) {
        return fails("about") ? -script_->error : inner_.about(path, what);
    }
    int about(int file, struct stat& what) {
        return fails("about") ? -script_->error : inner_.about(file, what);
    }
    std::ptrdiff_t read_link(const char* path, Span<char> into) {
        return fails("read_link") ? -script_->error : inner_.read_link(path, into);
    }
    std::ptrdiff_t entries(int folder, Span<std::uint8_t> into) {
        return fails("entries") ? -script_->error : inner_.entries(folder, into);
    }
    int begin_watch() {
        if (fails("begin_watch")) return -script_->error;
        const int file = inner_.begin_watch();
        if (file >= 0) script_->open_files.insert(file);
        return file;
    }
    int watch(int file, const char* folder, std::uint32_t what) {
        return fails("watch") ? -script_->error : inner_.watch(file, folder, what);
    }
    int socket(int family, int type) {
        if (fails("socket")) return -script_->error;
        const int file = inner_.socket(family, type);
        if (file >= 0) script_->open_files.insert(file);
        return file;
    }
    std::ptrdiff_t send_to(int file, Span<const std::uint8_t> bytes, const sockaddr_un& to,
                           unsigned to_bytes) {
        return fails("send_to") ? -script_->error : inner_.send_to(file, bytes, to, to_bytes);
    }
    int processors() { return fails("processors") ? -script_->error : inner_.processors(); }
    /// These two never fail, and are not counted.
    int process_id() { return inner_.process_id(); }
    std::int64_t monotonic_us() { return inner_.monotonic_us(); }

private:
    bool fails(const char* name) {
        ++script_->calls;
        if (script_->fail_at == 0 || script_->calls < script_->fail_at) return false;
        if (script_->calls == script_->fail_at) script_->failed = name;
        return script_->for_ever || script_->calls == script_->fail_at;
    }

    SystemScript* script_;
    Inner inner_;
};

/// Runs a scenario with its n-th call failing, for every n and every errno given, until a run has fewer calls
/// than n. scenario(FailingSystem<Inner>) does its work and lets all die that it made; after(script) is asked
/// whether the run was as it must be. No signal interrupts for ever, so EINTR comes once a run. The number of
/// runs.
template <class Inner, class Scenario, class After>
int sweep(Inner inner, std::initializer_list<int> errors, Scenario scenario, After after) {
    int runs = 0;
    for (const bool for_ever : {false, true})
        for (const int error : errors)
            // A signal that never ends is none.
            for (int n = 1; !(for_ever && error == EINTR); ++n) {
                SystemScript script;
                script.fail_at = n;
                script.error = error;
                script.for_ever = for_ever;
                scenario(FailingSystem<Inner>(script, inner));
                if (script.calls < n) break;
                after(script);
                ++runs;
            }
    return runs;
}

}  // namespace fovea::test
