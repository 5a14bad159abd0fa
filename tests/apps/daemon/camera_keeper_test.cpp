// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <linux/videodev2.h>

#include <cstdint>
#include <string>
#include <vector>

#include <fovea/linux/v4l2_camera.hpp>

#include <daemon/camera_keeper.hpp>

#include "support/failing_system.hpp"
#include "support/simulated_camera.hpp"

namespace fovea::apps {
namespace {

using linux_port::V4l2Camera;
using test::SimulatedCamera;
using test::SimulatedVideo;
using System = test::FailingSystem<SimulatedVideo>;
using Camera = V4l2Camera<System>;

/// The time of the simulated device.
struct DeviceClock {
    SimulatedCamera& device;
    std::int64_t microseconds() { return device.now_us; }
};

struct Opening {
    int* calls;
    Status operator()(Camera& camera) const {
        ++*calls;
        if (const Status s = camera.open("/dev/video0"); s != Status::ok) return s;
        if (const Status s = camera.configure(V4L2_PIX_FMT_GREY, {64, 48}, 40000); s != Status::ok) return s;
        return camera.start();
    }
};

struct Bench {
    test::SystemScript script;
    SimulatedCamera device;
    Camera camera{System(script, SimulatedVideo(device))};
    DeviceClock clock{device};
    int opens = 0;
    CameraKeeper<Camera, DeviceClock, Opening> keeper{camera, clock, Opening{&opens}};
    Camera::Frame frame;
    std::vector<std::string> events;
    int frames = 0;

    /// Lets that time pass in turns of 5 ms. The frames that came.
    int run(std::int64_t duration_us) {
        const std::int64_t until_us = device.now_us + duration_us;
        const int before = frames;
        while (device.now_us < until_us) {
            frames += keeper.fetch(FramePolicy::every, 0, frame) == Status::ok ? 1 : 0;
            CameraEvent event;
            if (keeper.take_event(event)) events.push_back(word_of(event.trouble));
            device.run_until(device.now_us + 5000);
        }
        return frames - before;
    }
};

using Words = std::vector<std::string>;

TEST(CameraKeeper, OpensAndLends) {
    Bench bench;
    EXPECT_EQ(bench.run(1000000), 24);
    EXPECT_EQ(bench.events, Words());
    EXPECT_EQ(bench.opens, 1);
}

TEST(CameraKeeper, LooksForALostCameraMoreAndMoreSeldom) {
    Bench bench;
    bench.run(200000);
    bench.device.unplugged = true;
    bench.run(20000);
    EXPECT_FALSE(bench.keeper.streaming());
    EXPECT_TRUE(bench.script.all_given_back());
    bench.opens = 0;
    bench.run(3700000);
    // At once, which was before; 0.025, 0.1, 0.3, 0.8, 1.8 and 3.8 s after the first.
    EXPECT_EQ(bench.opens, 5);
    bench.run(20000000);
    EXPECT_EQ(bench.opens, 15);
    EXPECT_EQ(bench.events, Words({"camera_lost"}));
    bench.device.unplugged = false;
    EXPECT_GT(bench.run(3000000), 20);
    EXPECT_EQ(bench.events, Words({"camera_lost", "none"}));
}

TEST(CameraKeeper, HurriesWhereSomethingWasPluggedIn) {
    Bench bench;
    bench.run(200000);
    bench.device.unplugged = true;
    bench.run(20000000);
    bench.opens = 0;
    bench.keeper.hurry();
    bench.run(5000);
    EXPECT_EQ(bench.opens, 1);
    bench.run(350000);  // the schedule from its beginning
    EXPECT_EQ(bench.opens, 4);
    bench.device.unplugged = false;
    bench.keeper.hurry();
    EXPECT_GE(bench.run(100000), 1);
    bench.keeper.hurry();  // nothing to a camera that streams
    EXPECT_GE(bench.run(100000), 2);
    EXPECT_EQ(bench.opens, 5);
}

TEST(CameraKeeper, FindsACameraThatIsBackAtOnce) {
    Bench bench;
    bench.run(200000);
    for (int k = 0; k < 100; ++k) {
        bench.device.unplugged = true;
        bench.run(15000);
        bench.device.unplugged = false;
        EXPECT_GE(bench.run(300000), 3) << k;
    }
    EXPECT_EQ(bench.events.size(), 200u);
    EXPECT_EQ(bench.keeper.recoveries(), 100u);
    bench.frame.give_back();
    bench.camera.close();
    EXPECT_TRUE(bench.script.all_given_back());
}

TEST(CameraKeeper, StartsABrokenStreamAgainWithoutOpening) {
    Bench bench;
    bench.run(200000);
    bench.device.fatal = true;
    EXPECT_GE(bench.run(200000), 3);
    EXPECT_EQ(bench.opens, 1);
    EXPECT_EQ(bench.events, Words({"camera_broken", "none"}));
}

TEST(CameraKeeper, OpensAgainWhereAStartDoesNotHelp) {
    Bench bench;
    bench.run(200000);
    bench.device.fatal = true;
    bench.device.refused_once[VIDIOC_STREAMON] = EINVAL;
    EXPECT_GE(bench.run(300000), 3);
    EXPECT_EQ(bench.opens, 2);
    EXPECT_EQ(bench.events, Words({"camera_broken", "none"}));
}

TEST(CameraKeeper, BreaksSilenceByAStartThenByOpening) {
    Bench bench;
    bench.run(200000);
    bench.device.silent = true;
    bench.run(1300000);
    EXPECT_EQ(bench.opens, 1);
    EXPECT_EQ(bench.keeper.recoveries(), 1u);
    EXPECT_EQ(bench.events, Words({"camera_silent"}));
    bench.run(1000000);
    EXPECT_EQ(bench.opens, 2);
    bench.run(20000000);
    EXPECT_LE(bench.opens, 9);  // a second of silence and two of waiting each
    EXPECT_GE(bench.opens, 7);
    EXPECT_EQ(bench.events, Words({"camera_silent"}));
    bench.device.silent = false;
    bench.run(4000000);
    EXPECT_EQ(bench.events, Words({"camera_silent", "none"}));
}

TEST(CameraKeeper, TakesNoCameraForSilentWhereWhoAsksIsSlow) {
    Bench bench;
    bench.run(200000);
    bench.events.clear();
    for (int slow = 0; slow < 10; ++slow) {
        // Longer than a silence; the frames of meanwhile fill all buffers, and are too old for the latest.
        bench.device.run_until(bench.device.now_us + 1500000);
        EXPECT_EQ(bench.keeper.fetch(FramePolicy::latest, 60000, bench.frame), Status::timeout);
        CameraEvent event;
        EXPECT_FALSE(bench.keeper.take_event(event)) << word_of(event.trouble);
    }
    EXPECT_EQ(bench.keeper.recoveries(), 0u);
    EXPECT_EQ(bench.keeper.trouble(), CameraTrouble::none);
}

TEST(CameraKeeper, WaitsForASignalWithoutOpening) {
    Bench bench;
    bench.device.has_timings = true;
    bench.run(200000);
    bench.device.set_signal(false);
    EXPECT_EQ(bench.run(10000000), 0);
    EXPECT_EQ(bench.opens, 1);
    bench.device.set_signal(true);
    EXPECT_GE(bench.run(200000), 3);
    EXPECT_EQ(bench.events, Words({"camera_no_signal", "none"}));
}

TEST(CameraKeeper, StaysAwayFromACameraOfAnotherSize) {
    Bench bench;
    bench.run(200000);
    bench.device.unplugged = true;
    bench.run(20000);
    bench.device.unplugged = false;
    bench.device.offered = {{V4L2_PIX_FMT_GREY, 32, 24, 40000}};
    EXPECT_EQ(bench.run(5000000), 0);
    EXPECT_EQ(bench.events, Words({"camera_lost", "camera_refused"}));
    EXPECT_EQ(bench.keeper.fetch(FramePolicy::every, 0, bench.frame), Status::size_mismatch);
}

TEST(CameraKeeper, TellsTheEndOnceWithItsDuration) {
    Bench bench;
    bench.run(200000);
    bench.device.unplugged = true;
    EXPECT_EQ(bench.keeper.fetch(FramePolicy::latest, 60000, bench.frame), Status::device_lost);
    CameraEvent event;
    ASSERT_TRUE(bench.keeper.take_event(event));
    EXPECT_EQ(event.status, Status::device_lost);
    EXPECT_FALSE(bench.keeper.take_event(event));
    bench.device.unplugged = false;
    bench.device.run_until(bench.device.now_us + 30000);
    for (int k = 0; k < 20 && bench.keeper.trouble() != CameraTrouble::none; ++k) {
        static_cast<void>(bench.keeper.fetch(FramePolicy::latest, 60000, bench.frame));
        bench.device.run_until(bench.device.now_us + 10000);
    }
    ASSERT_TRUE(bench.keeper.take_event(event));
    EXPECT_EQ(event.trouble, CameraTrouble::none);
    EXPECT_EQ(event.lasted_us, 70000);  // 30 until it was plugged in, 40 until its first frame
}

}  // namespace
}  // namespace fovea::apps
