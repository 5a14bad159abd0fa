// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cerrno>
#include <cstdint>
#include <string>

#include <fovea/linux/v4l2_camera.hpp>

#include "support/failing_system.hpp"
#include "support/simulated_camera.hpp"

namespace fovea::linux_port {
namespace {

using test::camera_byte;
using test::SimulatedCamera;
using test::SimulatedVideo;
using Camera = V4l2Camera<SimulatedVideo>;

constexpr std::int64_t second = 1000000;

/// Opens and starts with the first mode that is offered.
template <class AnyCamera>
Status begin(AnyCamera& camera, int buffers = 4) {
    if (const Status s = camera.open("/dev/video0"); s != Status::ok) return s;
    List<CameraMode, 16> modes;
    if (const Status s = camera.modes(modes.view()); s != Status::ok) return s;
    if (modes.empty()) return Status::not_found;
    if (const Status s = camera.configure(modes[0].code, modes[0].largest, modes[0].interval_us);
        s != Status::ok)
        return s;
    return camera.start(buffers);
}

/// How many bytes of the frame's rows are not those that the camera made. The planes lie in memory one after
/// another.
int wrong_bytes(const hal::FrameInfo& info) {
    int wrong = 0;
    std::size_t begin = 0;
    for (int p = 0; p < hal::plane_count(info.format); ++p) {
        const int rows = hal::plane_rows(info.format, p, info.size.height);
        const int bytes = hal::row_bytes(info.format, p, info.size.width);
        const auto stride = static_cast<std::size_t>(info.planes[p].stride_bytes);
        for (int y = 0; y < rows; ++y)
            for (int x = 0; x < bytes; ++x) {
                const std::size_t at = static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x);
                wrong += info.planes[p].bytes.data()[at] != camera_byte(info.sequence, begin + at) ? 1 : 0;
            }
        begin += stride * static_cast<std::size_t>(rows);
    }
    return wrong;
}

TEST(V4l2Camera, LendsEveryFrameInOrderAndWhole) {
    SimulatedCamera device;
    Camera camera{SimulatedVideo(device)};
    ASSERT_EQ(begin(camera), Status::ok);
    Camera::Frame frame;
    for (std::uint32_t k = 0; k < 20; ++k) {
        ASSERT_EQ(camera.next(second, frame), Status::ok);
        EXPECT_EQ(frame.info().sequence, k);
        EXPECT_EQ(frame.info().size, (Size{64, 48}));
        EXPECT_EQ(frame.info().format, hal::PixelFormat::gray8);
        EXPECT_EQ(frame.info().time_us, 1000000 + 40000 * (std::int64_t{k} + 1));
        EXPECT_EQ(wrong_bytes(frame.info()), 0);
    }
    EXPECT_EQ(camera.counters().lent, 20u);
    EXPECT_EQ(camera.counters().missed, 0u);
    frame.give_back();
}

TEST(V4l2Camera, ReadsRowsWithPadding) {
    for (const std::uint32_t code :
         {V4L2_PIX_FMT_GREY, V4L2_PIX_FMT_YUYV, V4L2_PIX_FMT_NV12, V4L2_PIX_FMT_RGB24, V4L2_PIX_FMT_Y16}) {
        SimulatedCamera device;
        device.offered = {{code, 50, 21, 40000}};
        device.padding = 14;
        Camera camera{SimulatedVideo(device)};
        ASSERT_EQ(begin(camera), Status::ok);
        Camera::Frame frame;
        ASSERT_EQ(camera.next(second, frame), Status::ok);
        EXPECT_EQ(frame.info().planes[0].stride_bytes, device.stride());
        EXPECT_EQ(wrong_bytes(frame.info()), 0);
    }
}

TEST(V4l2Camera, ReadsMultiPlanarDrivers) {
    for (const bool apart : {false, true}) {
        SimulatedCamera device;
        device.device_caps = V4L2_CAP_VIDEO_CAPTURE_MPLANE | V4L2_CAP_STREAMING;
        device.offered = {{apart ? V4L2_PIX_FMT_NV12M : V4L2_PIX_FMT_NV12, 64, 48, 40000}};
        device.memory_planes = apart ? 2 : 1;
        device.data_offset = 32;
        Camera camera{SimulatedVideo(device)};
        ASSERT_EQ(begin(camera), Status::ok) << camera.fault().call << ": " << reason(camera.fault());
        Camera::Frame frame;
        for (int k = 0; k < 6; ++k) {
            ASSERT_EQ(camera.next(second, frame), Status::ok);
            EXPECT_EQ(wrong_bytes(frame.info()), 0) << apart;
        }
    }
}

TEST(V4l2Camera, NeverLendsAFrameThatIsMarkedOrShort) {
    SimulatedCamera device;
    device.damaged = {1, 2, 5};
    device.cut_short = {3, 8};
    Camera camera{SimulatedVideo(device)};
    ASSERT_EQ(begin(camera), Status::ok);
    Camera::Frame frame;
    for (const std::uint32_t wanted : {0u, 4u, 6u, 7u, 9u}) {
        ASSERT_EQ(camera.next(second, frame), Status::ok);
        EXPECT_EQ(frame.info().sequence, wanted);
    }
    EXPECT_EQ(camera.counters().damaged, 5u);
    EXPECT_EQ(camera.counters().missed, 0u);
}

TEST(V4l2Camera, CountsFramesThatTheDriverLost) {
    SimulatedCamera device;
    device.first_sequence = 0xfffffffeu;
    device.dropped = {1, 4, 5};
    Camera camera{SimulatedVideo(device)};
    ASSERT_EQ(begin(camera), Status::ok);
    Camera::Frame frame;
    for (int k = 0; k < 5; ++k) ASSERT_EQ(camera.next(second, frame), Status::ok);
    EXPECT_EQ(camera.counters().missed, 3u);
}

TEST(V4l2Camera, LatestIsTheNewestAndNeverOld) {
    SimulatedCamera device;
    Camera camera{SimulatedVideo(device)};
    ASSERT_EQ(begin(camera), Status::ok);
    Camera::Frame frame;
    std::uint64_t seen = 0;
    for (int k = 0; k < 30; ++k) {
        ASSERT_EQ(camera.latest(60000, second, frame), Status::ok);
        EXPECT_LE(device.now_us - frame.info().time_us, 60000);
        EXPECT_EQ(wrong_bytes(frame.info()), 0);
        ++seen;
        device.run_until(device.now_us + 200000);  // the time that a job takes
    }
    const hal::FrameCounters& counters = camera.counters();
    EXPECT_EQ(counters.lent, seen);
    EXPECT_GT(counters.passed_over, 30u);
    EXPECT_EQ(counters.lent + counters.passed_over + counters.missed, frame.info().sequence + 1u);
}

TEST(V4l2Camera, LatestTakesTheNewestOfThoseThatWait) {
    SimulatedCamera device;
    Camera camera{SimulatedVideo(device)};
    ASSERT_EQ(begin(camera), Status::ok);
    device.run_until(device.now_us + 130000);
    Camera::Frame frame;
    ASSERT_EQ(camera.latest(60000, 0, frame), Status::ok);
    EXPECT_EQ(frame.info().sequence, 2u);
    EXPECT_EQ(camera.counters().passed_over, 2u);
}

TEST(V4l2Camera, AfterATriggerComesAFrameThatBeganAfterIt) {
    SimulatedCamera device;
    Camera camera{SimulatedVideo(device)};
    ASSERT_EQ(begin(camera), Status::ok);
    device.run_until(device.now_us + 100000);  // frames 0 and 1 wait
    const std::int64_t trigger_us = device.now_us;
    Camera::Frame frame;
    ASSERT_EQ(camera.after(trigger_us, second, frame), Status::ok);
    // Stamped at its end: frame 2 began before the trigger.
    EXPECT_EQ(frame.info().sequence, 3u);
    EXPECT_EQ(camera.counters().passed_over, 3u);

    device.stamp_flags |= V4L2_BUF_FLAG_TSTAMP_SRC_SOE;
    ASSERT_EQ(camera.after(device.now_us, second, frame), Status::ok);
    ASSERT_EQ(camera.after(device.now_us + 1, second, frame), Status::ok);
    EXPECT_EQ(frame.info().sequence, 5u);
}

TEST(V4l2Camera, StampsOfTheFutureAgeFromZero) {
    SimulatedCamera device;
    device.stamp_ahead_us = 180000;
    Camera camera{SimulatedVideo(device)};
    ASSERT_EQ(begin(camera), Status::ok);
    Camera::Frame frame;
    for (int k = 0; k < 10; ++k) {
        ASSERT_EQ(camera.latest(60000, second, frame), Status::ok);
        EXPECT_LE(frame.info().time_us, device.now_us);
        EXPECT_LE(device.now_us - frame.info().time_us, 60000);
        device.run_until(device.now_us + 200000);
    }
}

TEST(V4l2Camera, LatestLendsFramesThatWereLongOnTheirWay) {
    SimulatedCamera device;
    device.stamp_ahead_us = -100000;  // as long as two intervals and a half
    Camera camera{SimulatedVideo(device)};
    ASSERT_EQ(begin(camera), Status::ok);
    device.run_until(device.now_us + 400000);
    Camera::Frame frame;
    int lent = 0;
    for (int k = 0; k < 20; ++k) {
        // As who is woken by each frame.
        device.run_until(device.now_us + 40000);
        if (camera.latest(60000, 0, frame) == Status::ok) ++lent;
    }
    EXPECT_GE(lent, 18);
    EXPECT_GT(device.now_us - frame.info().time_us, 60000);
    // What has waited is passed over all the same.
    device.run_until(device.now_us + 130000);
    EXPECT_EQ(camera.latest(60000, 0, frame), Status::timeout);
    device.run_until(device.now_us + 40000);
    EXPECT_EQ(camera.latest(60000, 0, frame), Status::ok);
}

TEST(V4l2Camera, SaysThatNothingCame) {
    SimulatedCamera device;
    device.silent = true;
    Camera camera{SimulatedVideo(device)};
    ASSERT_EQ(begin(camera), Status::ok);
    Camera::Frame frame;
    const std::int64_t before = device.now_us;
    EXPECT_EQ(camera.next(500000, frame), Status::timeout);
    EXPECT_EQ(device.now_us, before + 500000);
    EXPECT_EQ(camera.latest(60000, 500000, frame), Status::timeout);
    EXPECT_LE(device.polls, 4);
    EXPECT_TRUE(frame.empty());
}

TEST(V4l2Camera, DamagedFramesAloneEndWithThePatience) {
    SimulatedCamera device;
    for (std::uint32_t k = 0; k < 1000; ++k) device.damaged.insert(k);
    Camera camera{SimulatedVideo(device)};
    ASSERT_EQ(begin(camera), Status::ok);
    Camera::Frame frame;
    EXPECT_EQ(camera.next(second, frame), Status::timeout);
    EXPECT_EQ(camera.counters().damaged, 25u);
    EXPECT_EQ(camera.latest(60000, second, frame), Status::timeout);
    EXPECT_EQ(camera.counters().lent, 0u);
}

TEST(V4l2Camera, ABrokenStreamStartsAgain) {
    SimulatedCamera device;
    Camera camera{SimulatedVideo(device)};
    ASSERT_EQ(begin(camera), Status::ok);
    Camera::Frame frame;
    ASSERT_EQ(camera.next(second, frame), Status::ok);
    device.fatal = true;
    EXPECT_EQ(camera.next(second, frame), Status::io_error);
    EXPECT_EQ(camera.fault().error, EIO);
    frame.give_back();
    camera.stop();
    ASSERT_EQ(camera.start(), Status::ok);
    EXPECT_EQ(camera.next(second, frame), Status::ok);
    EXPECT_EQ(device.opened, 1);
}

TEST(V4l2Camera, AnUnpluggedCameraIsLostAndComesBack) {
    test::SystemScript script;
    SimulatedCamera device;
    {
        V4l2Camera camera{test::FailingSystem<SimulatedVideo>(script, SimulatedVideo(device))};
        decltype(camera)::Frame frame;
        for (int cycle = 0; cycle < 100; ++cycle) {
            ASSERT_EQ(begin(camera), Status::ok);
            ASSERT_EQ(camera.next(second, frame), Status::ok);
            device.unplugged = true;
            EXPECT_EQ(cycle % 2 == 0 ? camera.next(second, frame) : camera.latest(60000, second, frame),
                      Status::device_lost);
            EXPECT_TRUE(frame.empty());
            camera.close();
            EXPECT_TRUE(script.all_given_back());
            EXPECT_EQ(camera.open("/dev/video0"), Status::device_lost);
            device.unplugged = false;
        }
    }
    EXPECT_TRUE(script.all_given_back());
}

TEST(V4l2Camera, LendsNothingWhileTheSensorHasNoSignal) {
    SimulatedCamera device;
    device.has_timings = true;
    Camera camera{SimulatedVideo(device)};
    ASSERT_EQ(begin(camera), Status::ok);
    Camera::Frame frame;
    ASSERT_EQ(camera.next(second, frame), Status::ok);
    device.set_signal(false);
    const int polls = device.polls;
    EXPECT_EQ(camera.next(second, frame), Status::no_signal);
    EXPECT_EQ(camera.latest(60000, second, frame), Status::no_signal);
    EXPECT_LE(device.polls - polls, 6);
    EXPECT_EQ(camera.counters().lent, 1u);
    device.set_signal(true);
    EXPECT_EQ(camera.next(second, frame), Status::ok);
    device.timings_width = 128;
    device.set_signal(true);
    EXPECT_EQ(camera.next(second, frame), Status::size_mismatch);
}

TEST(V4l2Camera, TellsThatNothingIsPluggedIn) {
    SimulatedCamera device;
    device.silent = true;
    device.signal = false;
    Camera camera{SimulatedVideo(device)};
    ASSERT_EQ(begin(camera), Status::ok);
    Camera::Frame frame;
    EXPECT_EQ(camera.next(second, frame), Status::no_signal);
    EXPECT_STREQ(reason(camera.fault()), "nothing is plugged in, or it is off");
}

TEST(V4l2Camera, RefusesWhatIsNoCamera) {
    SimulatedCamera device;
    Camera camera{SimulatedVideo(device)};
    EXPECT_EQ(camera.open("/dev/video7"), Status::not_found);
    device.device_caps = V4L2_CAP_META_CAPTURE | V4L2_CAP_STREAMING;
    EXPECT_EQ(camera.open("/dev/video0"), Status::unsupported);
    EXPECT_NE(std::string(reason(camera.fault())).find("other node"), std::string::npos);
    device.device_caps = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_READWRITE;
    EXPECT_EQ(camera.open("/dev/video0"), Status::unsupported);
    device.device_caps = V4L2_CAP_VIDEO_OUTPUT | V4L2_CAP_STREAMING;
    EXPECT_EQ(camera.open("/dev/video0"), Status::unsupported);
    EXPECT_EQ(device.open_handles, 0);
}

TEST(V4l2Camera, RefusesAFormatThatIsNotTheOneAskedFor) {
    SimulatedCamera device;
    Camera camera{SimulatedVideo(device)};
    ASSERT_EQ(camera.open("/dev/video0"), Status::ok);
    EXPECT_EQ(camera.configure(V4L2_PIX_FMT_YUYV, {64, 48}, 0), Status::unsupported);
    device.wrong_width = 2;
    EXPECT_EQ(camera.configure(V4L2_PIX_FMT_GREY, {64, 48}, 0), Status::size_mismatch);
    device.wrong_width = 0;
    device.field = V4L2_FIELD_INTERLACED;
    EXPECT_EQ(camera.configure(V4L2_PIX_FMT_GREY, {64, 48}, 0), Status::unsupported);
    device.field = V4L2_FIELD_NONE;
    device.padding = -1;
    EXPECT_EQ(camera.configure(V4L2_PIX_FMT_GREY, {64, 48}, 0), Status::malformed);
    EXPECT_EQ(camera.start(), Status::bad_argument);
    EXPECT_EQ(camera.configure(V4L2_PIX_FMT_H264, {64, 48}, 0), Status::bad_argument);
    EXPECT_EQ(camera.configure(V4L2_PIX_FMT_GREY, {0, 48}, 0), Status::bad_argument);
}

TEST(V4l2Camera, LetsTheDriverFillTheWholeFrame) {
    SimulatedCamera device;
    device.compose_width = 32;  // as another program left it
    Camera camera{SimulatedVideo(device)};
    ASSERT_EQ(camera.open("/dev/video0"), Status::ok);
    EXPECT_EQ(camera.configure(V4L2_PIX_FMT_GREY, {64, 48}, 0), Status::ok);
    EXPECT_EQ(device.compose_width, 64);
    device.compose_width = 32;
    device.compose_can_be_set = false;
    EXPECT_EQ(camera.configure(V4L2_PIX_FMT_GREY, {64, 48}, 0), Status::size_mismatch);
    EXPECT_STREQ(camera.fault().call, "VIDIOC_S_SELECTION");
}

TEST(V4l2Camera, WantsTwoBuffers) {
    SimulatedCamera device;
    device.most_buffers = 1;
    Camera camera{SimulatedVideo(device)};
    EXPECT_EQ(begin(camera), Status::io_error);
    device.most_buffers = 2;
    EXPECT_EQ(begin(camera), Status::ok);
    Camera::Frame frame;
    for (int k = 0; k < 5; ++k) EXPECT_EQ(camera.next(second, frame), Status::ok);
}

TEST(V4l2Camera, OneRefusalOfACallIsNotTheEnd) {
    for (const unsigned long request : {VIDIOC_REQBUFS, VIDIOC_QUERYBUF, VIDIOC_STREAMON}) {
        SimulatedCamera device;
        Camera camera{SimulatedVideo(device)};
        device.refused_once[request] = EINVAL;
        EXPECT_EQ(begin(camera), Status::io_error);
        EXPECT_EQ(camera.fault().error, EINVAL);
        ASSERT_EQ(camera.start(), Status::ok);
        Camera::Frame frame;
        EXPECT_EQ(camera.next(second, frame), Status::ok);
    }
    SimulatedCamera device;
    Camera camera{SimulatedVideo(device)};
    ASSERT_EQ(begin(camera), Status::ok);
    device.refused_once[VIDIOC_QBUF] = EINVAL;
    Camera::Frame frame;
    for (int k = 0; k < 10; ++k) EXPECT_EQ(camera.next(second, frame), Status::ok);
    EXPECT_TRUE(device.refused_once.empty());
    frame.give_back();
    EXPECT_EQ(camera.next(second, frame), Status::ok);
}

TEST(V4l2Camera, ListsWhatItCanSend) {
    SimulatedCamera device;
    device.offered = {{V4L2_PIX_FMT_H264, 64, 48, 1000},
                      {V4L2_PIX_FMT_YUYV, 640, 480, 33333},
                      {V4L2_PIX_FMT_MJPEG, 640, 480, 33333},
                      {V4L2_PIX_FMT_MJPEG, 1280, 720, 33333}};
    Camera camera{SimulatedVideo(device)};
    ASSERT_EQ(camera.open("/dev/video0"), Status::ok);
    List<CameraMode, 3> modes;
    ASSERT_EQ(camera.modes(modes.view()), Status::ok);
    ASSERT_EQ(modes.size(), 3);
    EXPECT_EQ(modes[0].format, hal::PixelFormat::yuyv);
    EXPECT_EQ(modes[2].largest, (Size{1280, 720}));
    EXPECT_EQ(modes[2].interval_us, 33333);
    List<CameraMode, 2> few;
    EXPECT_EQ(camera.modes(few.view()), Status::capacity_exceeded);
    EXPECT_EQ(few.size(), 2);
    device.lists_sizes = false;
    ASSERT_EQ(camera.modes(modes.view()), Status::ok);
    EXPECT_EQ(modes.size(), 2);
    EXPECT_EQ(modes[0].largest, (Size{64, 48}));
}

TEST(V4l2Camera, ClosedGivesNothing) {
    SimulatedCamera device;
    Camera camera{SimulatedVideo(device)};
    Camera::Frame frame;
    List<CameraMode, 2> modes;
    EXPECT_EQ(camera.next(0, frame), Status::device_lost);
    EXPECT_EQ(camera.start(), Status::device_lost);
    EXPECT_EQ(camera.modes(modes.view()), Status::device_lost);
    ASSERT_EQ(camera.open("/dev/video0"), Status::ok);
    EXPECT_EQ(camera.next(0, frame), Status::bad_argument);
    EXPECT_EQ(camera.latest(0, 0, frame), Status::bad_argument);
}

TEST(V4l2Camera, GivesAllBackWhicheverCallFails) {
    SimulatedCamera device;
    device.has_timings = true;
    int frames = 0;
    const int runs = test::sweep(
        SimulatedVideo(device), {EINTR, EIO, EINVAL, ENODEV, ENOMEM, EBUSY, ENOSPC, EAGAIN, EMFILE},
        [&](auto system) {
            V4l2Camera camera(system);
            typename decltype(camera)::Frame frame;
            if (begin(camera) != Status::ok) return;
            for (int k = 0; k < 4; ++k) {
                const Status s =
                    k % 2 == 0 ? camera.next(second, frame) : camera.latest(60000, second, frame);
                EXPECT_EQ(s == Status::ok, !frame.empty());
                if (s == Status::ok) {
                    ++frames;
                    EXPECT_EQ(wrong_bytes(frame.info()), 0);
                } else {
                    EXPECT_TRUE(s == Status::timeout || s == camera.fault().status) << describe(s);
                }
                if (s == Status::io_error) {
                    frame.give_back();
                    camera.stop();
                    if (camera.start() != Status::ok) return;
                }
            }
        },
        [&](const test::SystemScript& script) {
            EXPECT_TRUE(script.all_given_back())
                << script.failed << " " << script.fail_at << " with " << script.error;
            EXPECT_EQ(device.open_handles, 0);
            device.events.clear();
        });
    EXPECT_GT(runs, 500);
    EXPECT_GT(frames, 500);
}

}  // namespace
}  // namespace fovea::linux_port
