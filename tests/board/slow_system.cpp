// SPDX-License-Identifier: MIT
//
// Linked into the daemon with --wrap=write and --wrap=fsync: its standard output takes 200 ms for each result
// while /tmp/slow_output is there, and its disk hangs while /tmp/disk_hangs is.
#include <unistd.h>

#include <cstring>
#include <ctime>

namespace {

bool there(const char* path) { return ::access(path, F_OK) == 0; }

void sleep_ms(long milliseconds) {
    const timespec time = {0, milliseconds * 1000000};
    ::nanosleep(&time, nullptr);
}

}  // namespace

extern "C" {
ssize_t __real_write(int file, const void* bytes, size_t count);
int __real_fsync(int file);

ssize_t __wrap_write(int file, const void* bytes, size_t count) {
    const char result[] = "\"ev\":\"result\"";
    if (file == 1 && ::memmem(bytes, count, result, sizeof result - 1) != nullptr &&
        there("/tmp/slow_output"))
        sleep_ms(200);
    return __real_write(file, bytes, count);
}
int __wrap_fsync(int file) {
    while (there("/tmp/disk_hangs")) sleep_ms(5);
    return __real_fsync(file);
}
}
