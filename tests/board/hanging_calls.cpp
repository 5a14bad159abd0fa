// SPDX-License-Identifier: MIT
//
// A call into the kernel that never comes back: linked to the daemon's own object file with
// -Wl,--wrap=ioctl,--wrap=write, which leads its calls through here.
//
// FOVEA_HANG="KIND N MARK" makes the N-th call of a kind hang, in the first life alone, which leaves the file
// MARK. Kinds are frame (a frame is asked for), line (a line is set) and serial (something is written that is
// not the output). What hangs is told on standard error, with the time in microseconds that frames and edges
// have too.
#include <fcntl.h>
#include <linux/gpio.h>
#include <linux/videodev2.h>
#include <time.h>
#include <unistd.h>

#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

extern "C" {
int __real_ioctl(int file, unsigned long request, ...);
ssize_t __real_write(int file, const void* bytes, size_t size);
}

namespace {

/// What is asked for; nothing where the variable is not set.
struct Plan {
    Plan() {
        const char* const text = std::getenv("FOVEA_HANG");
        if (text != nullptr && std::sscanf(text, "%15s %d %199s", kind, &at, mark) != 3) std::abort();
    }
    char kind[16] = "";
    int at = 0;
    char mark[200] = "";
    int calls = 0;
};

void hang_at(const char* kind) {
    static Plan plan;
    if (std::strcmp(kind, plan.kind) != 0 || ++plan.calls != plan.at) return;
    const int file = ::open(plan.mark, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (file < 0) return;  // not the first life
    timespec now{};
    ::clock_gettime(CLOCK_MONOTONIC, &now);
    std::fprintf(stderr, "{\"ev\":\"hangs\",\"kind\":\"%s\",\"t_mono_us\":%lld}\n", kind,
                 now.tv_sec * 1000000LL + now.tv_nsec / 1000);
    // Signals come and go, as in a driver that waits for its device.
    for (;;) ::pause();
}

}  // namespace

extern "C" {
int __wrap_ioctl(int file, unsigned long request, ...) {
    std::va_list list;
    va_start(list, request);
    void* const argument = va_arg(list, void*);
    va_end(list);
    if (request == VIDIOC_DQBUF) hang_at("frame");
    if (request == GPIO_V2_LINE_SET_VALUES_IOCTL) hang_at("line");
    return __real_ioctl(file, request, argument);
}
ssize_t __wrap_write(int file, const void* bytes, size_t size) {
    if (file > STDERR_FILENO) hang_at("serial");
    return __real_write(file, bytes, size);
}
}
