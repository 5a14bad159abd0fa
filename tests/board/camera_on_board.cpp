// SPDX-License-Identifier: MIT
//
// The camera port on the kernel's own driver vivid, whose faults are provoked by its controls.
// usage: camera_on_board negotiation|faults|sweep|latest|recovery|press BUTTON|set CONTROL NUMBER...
//                                                            with vivid as a webcam at /dev/video0
//        camera_on_board signal                              with vivid as an input for video signals
#include <linux/videodev2.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include <fovea/linux/v4l2_camera.hpp>
#include <fovea/linux/video_controls.hpp>

#include "board/proof.hpp"
#include "support/failing_system.hpp"

namespace fovea::board {
namespace {

using linux_port::CameraMode;
using linux_port::ControlSetting;
using linux_port::Kernel;
using linux_port::V4l2Camera;
using Camera = V4l2Camera<>;

constexpr const char* device = "/dev/video0";
constexpr std::int64_t second = 1000000;

template <class AnyCamera>
std::string fault_of(const AnyCamera& camera) {
    return std::string(camera.fault().call) + ": " + reason(camera.fault());
}

/// Sets a control of the driver.
bool provoke(int file, const char* name, std::int64_t value) {
    Kernel kernel;
    ControlSetting setting;
    setting.name = name;
    setting.value = value;
    linux_port::Fault fault;
    return linux_port::set_controls(kernel, file, {&setting, 1}, fault) == Status::ok;
}

/// Presses a button of the driver.
bool press(int file, const char* name) {
    Kernel kernel;
    linux_port::Fault fault;
    v4l2_query_ext_ctrl found{};
    for (std::uint32_t id = 0; linux_port::next_control(kernel, file, id, found, fault) == Status::ok;
         id = found.id) {
        if (!linux_port::names_control(name, found.name)) continue;
        v4l2_control control{found.id, 0};
        return kernel.ioctl(file, VIDIOC_S_CTRL, &control) >= 0;
    }
    return false;
}

template <class AnyCamera>
Status open_and_configure(AnyCamera& camera, const linux_port::CameraWish& wish) {
    if (const Status s = camera.open(device); s != Status::ok) return s;
    List<CameraMode, 256> modes;
    if (const Status s = camera.modes(modes.view()); s != Status::ok) return s;
    const linux_port::CameraChoice choice = choose_mode(modes.span(), wish);
    if (choice.index < 0) return Status::not_found;
    return camera.configure(modes[choice.index].code, choice.size, wish.interval_us);
}

linux_port::CameraWish small_wish() {
    linux_port::CameraWish wish;
    wish.size = {320, 180};
    wish.interval_us = 33333;
    return wish;
}

template <class AnyCamera>
Status begin(AnyCamera& camera) {
    if (const Status s = open_and_configure(camera, small_wish()); s != Status::ok) return s;
    return camera.start();
}

void negotiation(Proof& proof) {
    Camera camera;
    proof.status(camera.open("/dev/video63"), Status::not_found, "a camera that is not there");
    proof.status(camera.open("/dev/null"), Status::unsupported, "a file that is no camera");
    if (!proof.status(camera.open(device), Status::ok, "open")) return;
    List<CameraMode, 256> modes;
    proof.status(camera.modes(modes.view()), Status::ok, "list of modes");
    proof.figure("modes of vivid that fovea reads", modes.size(), "");
    std::vector<hal::PixelFormat> formats;
    for (const CameraMode& mode : modes)
        if (std::find(formats.begin(), formats.end(), mode.format) == formats.end())
            formats.push_back(mode.format);
    proof.equal(formats.size(), std::size_t{14}, "formats: all but MJPEG, which vivid does not have");
    for (const hal::PixelFormat format : formats) {
        linux_port::CameraWish wish = small_wish();
        wish.format = format;
        const linux_port::CameraChoice choice = choose_mode(modes.span(), wish);
        const std::string name = describe(format);
        if (!proof.check(choice.index >= 0, "a mode of " + name)) continue;
        Status status = camera.configure(modes[choice.index].code, choice.size, wish.interval_us);
        if (status == Status::ok) status = camera.start();
        Camera::Frame frame;
        for (int k = 0; k < 3 && status == Status::ok; ++k) status = camera.next(second, frame);
        proof.check(status == Status::ok && frame.info().format == format, "frames of " + name,
                    fault_of(camera));
        frame.give_back();
        camera.stop();
    }
}

/// Takes frames for as long as that, and gives back how many came.
int watch(Camera& camera, std::int64_t duration_us, Status* last = nullptr) {
    Kernel kernel;
    const std::int64_t until = kernel.monotonic_us() + duration_us;
    int frames = 0;
    while (kernel.monotonic_us() < until) {
        Camera::Frame frame;
        const Status got = camera.next(100000, frame);
        if (got == Status::ok) ++frames;
        if (last != nullptr) *last = got;
        if (got != Status::ok && got != Status::timeout) break;
    }
    return frames;
}

/// Starts anew until a frame comes: the microseconds that this took.
template <class Again>
std::int64_t recovery_us(Camera& camera, Again again) {
    Kernel kernel;
    const std::int64_t begin_us = kernel.monotonic_us();
    for (int tries = 0; tries < 50; ++tries) {
        Camera::Frame frame;
        if (again() == Status::ok && camera.next(second, frame) == Status::ok) break;
        static_cast<void>(kernel.poll({nullptr, 0}, 10000));
    }
    return kernel.monotonic_us() - begin_us;
}

void flagged_frames(Proof& proof, Camera& camera) {
    const std::uint64_t before = camera.counters().damaged;
    int pressed = 0;
    for (int k = 0; k < 20; ++k) {
        pressed += press(camera.file(), "Inject V4L2_BUF_FLAG_ERROR") ? 1 : 0;
        // Until that one has come, so that no two fall together.
        for (int tries = 0; tries < 20 && camera.counters().damaged == before + static_cast<std::uint64_t>(k);
             ++tries) {
            Camera::Frame frame;
            static_cast<void>(camera.next(second, frame));
        }
    }
    proof.equal(pressed, 20, "F4: 20 frames are marked damaged");
    proof.equal(camera.counters().damaged - before, 20u, "F4: 20 are counted, none lent");
}

void dropped_frames(Proof& proof, Camera& camera) {
    const hal::FrameCounters before = camera.counters();
    provoke(camera.file(), "Percentage of Dropped Buffers", 40);
    const int came = watch(camera, 2 * second);
    provoke(camera.file(), "Percentage of Dropped Buffers", 0);
    Camera::Frame first;
    static_cast<void>(camera.next(second, first));
    const std::uint64_t missed = camera.counters().missed - before.missed;
    proof.figure("F5: frames that came of those while 40 % were dropped", came, "");
    proof.figure("F5: frames counted as missed", static_cast<std::int64_t>(missed), "");
    proof.check(missed > 0 && came > 0, "F5: dropped frames are counted");
    provoke(camera.file(), "Percentage of Dropped Buffers", 100);
    Status last = Status::ok;
    watch(camera, second / 2, &last);
    proof.status(last, Status::timeout, "F6: a silent camera is a timeout");
    provoke(camera.file(), "Percentage of Dropped Buffers", 0);
    proof.status(camera.next(second, first), Status::ok, "F6: and it speaks again");
}

void wrapped_numbers(Proof& proof, Camera& camera) {
    for (const char* name : {"Wrap Sequence Number", "Wrap Timestamp"}) {
        camera.stop();
        // 64-bit: from 16 seconds in front of the end of time.
        proof.check(provoke(camera.file(), name, std::strcmp(name, "Wrap Timestamp") == 0 ? 2 : 1), name);
        proof.status(camera.start(), Status::ok, std::string(name) + ": start");
        const std::uint64_t before = camera.counters().missed;
        Kernel kernel;
        bool future = false;
        bool ran_over = false;
        std::uint32_t last = 0;
        const std::int64_t until =
            kernel.monotonic_us() + (std::strcmp(name, "Wrap Timestamp") == 0 ? 17 : 6) * second;
        while (kernel.monotonic_us() < until) {
            Camera::Frame frame;
            if (camera.next(second, frame) != Status::ok) break;
            future = future || frame.info().time_us > kernel.monotonic_us();
            ran_over = ran_over || frame.info().sequence < last;
            last = frame.info().sequence;
        }
        proof.check(!future, std::string("F8: no frame is of the future: ") + name);
        if (std::strcmp(name, "Wrap Sequence Number") == 0) {
            proof.check(ran_over, "F7: the numbers ran over");
            // That would be one of billions; a busy machine loses some.
            proof.at_most(camera.counters().missed - before, 1000u, "F7: without a false gap");
        }
        camera.stop();
        provoke(camera.file(), name, 0);
        proof.status(camera.start(), Status::ok, std::string(name) + ": start after it");
    }
}

void refused_calls(Proof& proof, Camera& camera) {
    for (const char* name : {"Inject VIDIOC_REQBUFS Error", "Inject VIDIOC_STREAMON Error"}) {
        camera.stop();
        const Holdings before = holdings();
        proof.check(press(camera.file(), name), std::string("F9: ") + name);
        proof.status(camera.start(), Status::io_error, "F9: is a fault with a name");
        proof.equal(camera.fault().error, EINVAL, "F9: and an errno");
        proof.equal(holdings().mappings, before.mappings, "F9: and leaves nothing mapped");
        proof.status(camera.start(), Status::ok, "F9: the next start succeeds");
    }
    proof.check(press(camera.file(), "Inject VIDIOC_QBUF Error"), "F9: Inject VIDIOC_QBUF Error");
    int frames = 0;
    for (int k = 0; k < 12; ++k) {
        Camera::Frame frame;
        frames += camera.next(second, frame) == Status::ok ? 1 : 0;
    }
    proof.equal(frames, 12, "F9: a buffer that was refused once is given again");
}

void fatal_errors(Proof& proof, Camera& camera) {
    int told = 0;
    std::vector<std::int64_t> recoveries;
    for (int k = 0; k < 20; ++k) {
        press(camera.file(), "Inject Fatal Streaming Error");
        Status last = Status::ok;
        watch(camera, second, &last);
        told += last == Status::io_error ? 1 : 0;
        recoveries.push_back(recovery_us(camera, [&] {
            camera.stop();
            return camera.start();
        }));
    }
    proof.equal(told, 20, "F3: a broken stream is told each time");
    proof.spread("F3: from a broken stream to the next frame", recoveries);
    proof.at_most(median(recoveries), 200000, "F3: back within 200 ms");
}

/// again() opens and starts the camera when it has come back, within that time.
template <class Again>
void unplugging(Proof& proof, Camera& camera, int cycles, std::int64_t limit_us, Again again) {
    camera.close();
    const Holdings before = holdings();
    std::vector<std::int64_t> losses;
    std::vector<std::int64_t> recoveries;
    std::vector<std::int64_t> from_plug;
    bool lost = true;
    Kernel kernel;
    if (!proof.check(begin(camera) == Status::ok, "F2: begin", fault_of(camera))) return;
    for (int k = 0; k < cycles; ++k) {
        Camera::Frame frame;
        static_cast<void>(camera.next(second, frame));
        const std::int64_t pulled = kernel.monotonic_us();
        press(camera.file(), "Disconnect");
        Status got = Status::ok;
        while (got == Status::ok || got == Status::timeout) got = camera.next(second, frame);
        losses.push_back(kernel.monotonic_us() - pulled);
        lost = lost && got == Status::device_lost && frame.empty();
        camera.close();
        recoveries.push_back(recovery_us(camera, again));
        from_plug.push_back(kernel.monotonic_us() - pulled);
        if (!camera.streaming()) break;
    }
    camera.close();
    const Holdings after = holdings();
    proof.equal(recoveries.size(), static_cast<std::size_t>(cycles), "F2: each time it comes back");
    proof.check(lost, "F1: each time the camera is lost, and no frame is lent");
    proof.spread("F1: from the plug pulled to the loss", losses);
    proof.spread("F2: from the loss to the next frame", recoveries);
    proof.spread("F2: from the plug pulled to the next frame", from_plug);
    // The machine below the board may be busy with something else now and then.
    proof.at_most(median(recoveries), limit_us, "F2: back within " + std::to_string(limit_us / 1000) + " ms");
    proof.equal(after.files, before.files, "I4: as many files are open as before");
    proof.equal(after.mappings, before.mappings, "I4: as much is mapped as before");
    proof.at_most(after.resident_kib, before.resident_kib + 64, "I4: as much memory is in use");
}

void faults(Proof& proof) {
    Camera camera;
    if (!proof.status(begin(camera), Status::ok, "begin")) return;
    flagged_frames(proof, camera);
    dropped_frames(proof, camera);
    wrapped_numbers(proof, camera);
    refused_calls(proof, camera);
    fatal_errors(proof, camera);
    Camera second_one;
    proof.status(begin(second_one), Status::io_error, "F30: a second program");
    proof.check(std::strlen(advice(second_one.fault())) > 0, "F30: is told what to try",
                fault_of(second_one));
    second_one.close();
    // To list the 84 modes of vivid takes longer than all else together, on an emulated board 0.1 s.
    unplugging(proof, camera, 100, second, [&] { return begin(camera); });
}

/// What the recovery of another program is compared with, which is told the mode and lists none.
void recovery(Proof& proof) {
    Camera camera;
    if (!proof.status(begin(camera), Status::ok, "begin")) return;
    fatal_errors(proof, camera);
    unplugging(proof, camera, 20, 250000, [&] {
        if (const Status s = camera.open(device); s != Status::ok) return s;
        if (const Status s = camera.configure(V4L2_PIX_FMT_YUYV, {320, 180}, 33333); s != Status::ok)
            return s;
        return camera.start();
    });
}

/// Presses a button of the driver, for another program to see what comes of it; tells when.
void press_button(Proof& proof, const char* name) {
    Kernel kernel;
    int file = kernel.open(device, O_RDWR | O_CLOEXEC);
    const std::int64_t pressed = kernel.monotonic_us();
    proof.check(file >= 0 && press(file, name), name);
    std::printf("pressed at %lld us\n", static_cast<long long>(pressed));
    static_cast<void>(close_file(kernel, file));
}

/// Sets a control of the driver, for the same.
void set_control(Proof& proof, const char* name, const char* value) {
    Kernel kernel;
    int file = kernel.open(device, O_RDWR | O_CLOEXEC);
    proof.check(file >= 0 && provoke(file, name, std::atoi(value)), name);
    static_cast<void>(close_file(kernel, file));
}

void sweep(Proof& proof) {
    const Holdings before = holdings();
    int typed = 0;
    int leaks = 0;
    int frames = 0;
    const int runs = test::sweep(
        Kernel(), {EINTR, EIO, EINVAL, ENODEV, ENOMEM, EBUSY, ENOSPC, EAGAIN},
        [&](auto system) {
            V4l2Camera camera(system);
            typename decltype(camera)::Frame frame;
            Status got = camera.open(device);
            if (got == Status::ok) got = camera.configure(V4L2_PIX_FMT_GREY, {320, 180}, 16667);
            if (got == Status::ok) got = camera.start(2);
            for (int k = 0; k < 2 && got == Status::ok; ++k) {
                got = camera.next(100000, frame);
                if (got == Status::ok) ++frames;
                if (got != Status::io_error) continue;
                frame.give_back();
                camera.stop();
                got = camera.start(2);
            }
            if (got == Status::ok || got == Status::timeout || got == camera.fault().status) ++typed;
        },
        [&](const test::SystemScript& script) {
            if (!script.all_given_back()) ++leaks;
        });
    proof.figure("n-th-call sweep of the camera on vivid: runs", runs, "");
    proof.figure("n-th-call sweep of the camera on vivid: frames that came all the same", frames, "");
    proof.check(runs > 250 && frames > 100, "the sweep reaches every call");
    proof.check(typed >= runs, "each fault has its status");
    proof.equal(leaks, 0, "no file and no memory is left");
    proof.equal(holdings().files, before.files, "by the count of the kernel too: files");
    proof.equal(holdings().mappings, before.mappings, "and mappings");
}

void latest(Proof& proof) {
    Camera camera;
    if (!proof.status(begin(camera), Status::ok, "begin")) return;
    Kernel kernel;
    const std::int64_t limit = camera.interval_us() * 3 / 2;
    std::vector<std::int64_t> ages;
    std::vector<std::int64_t> waits;
    for (int k = 0; k < 50; ++k) {
        Camera::Frame frame;
        const std::int64_t asked = kernel.monotonic_us();
        if (camera.latest(limit, second, frame) != Status::ok) continue;
        const std::int64_t now = kernel.monotonic_us();
        waits.push_back(now - asked);
        ages.push_back(now - frame.info().time_us);
        static_cast<void>(kernel.poll({nullptr, 0}, 200000));  // the time that a job takes
    }
    proof.equal(ages.size(), std::size_t{50}, "50 frames under a load of 200 ms each");
    if (ages.empty()) return;
    proof.figure("interval between frames", camera.interval_us() / 1000, "ms");
    proof.spread("age of the frame lent under a load of 200 ms", ages);
    proof.spread("wait for the frame lent under a load of 200 ms", waits);
    proof.at_most(*std::max_element(ages.begin(), ages.end()), limit,
                  "none is older than one and a half intervals");
}

void signal(Proof& proof) {
    Camera camera;
    Status got = camera.open(device);
    if (got == Status::ok) got = camera.configure(V4L2_PIX_FMT_GREY, {640, 360}, 0);
    if (got == Status::ok) got = camera.start();
    Camera::Frame frame;
    if (got == Status::ok) got = camera.next(second, frame);
    proof.check(got == Status::ok, "frames of an input for video signals", fault_of(camera));
    proof.check(provoke(camera.file(), "DV Timings Signal Mode", 1), "the signal is taken away");
    const std::uint64_t before = camera.counters().lent;
    for (int k = 0; k < 3; ++k)
        proof.status(camera.next(300000, frame), Status::no_signal, "no signal is told");
    proof.equal(camera.counters().lent, before, "and no frame lent");
    provoke(camera.file(), "DV Timings Signal Mode", 0);
    proof.status(camera.next(second, frame), Status::ok, "the signal is back, and so are frames");
}

}  // namespace
}  // namespace fovea::board

int main(int count, char** words) {
    using namespace fovea::board;
    Proof proof;
    for (int k = 1; k < count; ++k) {
        const std::string part = words[k];
        if (part == "negotiation")
            negotiation(proof);
        else if (part == "faults")
            faults(proof);
        else if (part == "sweep")
            sweep(proof);
        else if (part == "latest")
            latest(proof);
        else if (part == "signal")
            signal(proof);
        else if (part == "recovery")
            recovery(proof);
        else if (part == "press" && k + 1 < count)
            press_button(proof, words[++k]);
        else if (part == "set" && k + 2 < count)
            set_control(proof, words[k + 1], words[k + 2]), k += 2;
        else
            proof.check(false, "a part named " + part);
    }
    return proof.end();
}
