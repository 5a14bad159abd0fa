// SPDX-License-Identifier: MIT
//
// Cameras and replays as sources of frames and of lines.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include <fovea/hal/feed.hpp>
#include <fovea/hal/frame_lines.hpp>
#include <fovea/linux/replay_source.hpp>
#include <fovea/linux/v4l2_camera.hpp>
#include <fovea/statistics/projection.hpp>
#include <fovea/stream/stream.hpp>

#include "support/frame_source_contract.hpp"
#include "support/simulated_camera.hpp"
#include "support/temporary_folder.hpp"
#include "support/timed_kernel.hpp"

namespace fovea::linux_port {
namespace {

static_assert(hal::is_line_source_v<hal::FrameLines<V4l2Camera<>>>);
static_assert(hal::is_line_source_v<hal::FrameLines<ReplaySource<>>>);

using Camera = V4l2Camera<test::SimulatedVideo>;
using Replay = ReplaySource<test::TimedKernel>;

struct CameraRig {
    CameraRig() {
        EXPECT_EQ(camera.open("/dev/video0"), Status::ok);
        EXPECT_EQ(camera.configure(V4L2_PIX_FMT_GREY, {64, 48}, 40000), Status::ok);
        EXPECT_EQ(camera.start(), Status::ok);
    }
    Camera& source() { return camera; }
    std::int64_t now_us() const { return device.now_us; }
    std::int64_t interval_us() const { return 40000; }
    void pass(std::int64_t us) { device.run_until(device.now_us + us); }

    test::SimulatedCamera device;
    Camera camera{test::SimulatedVideo(device)};
};

struct ReplayRig {
    ReplayRig() {
        for (int k = 0; k < 3; ++k)
            folder.write(std::to_string(k) + ".pgm",
                         "P5\n4 3\n255\n" + std::string(12, static_cast<char>('a' + k)));
        ReplayOptions options;
        options.interval_us = 40000;
        options.end = ReplayEnd::repeat;
        EXPECT_EQ(replay.open(folder.path(), options, {span(file), span(picture)}), Status::ok);
        EXPECT_EQ(replay.start(), Status::ok);
        // Its first picture is due at once.
        Replay::Frame first;
        EXPECT_EQ(replay.next(0, first), Status::ok);
    }
    static Span<std::uint8_t> span(std::vector<std::uint8_t>& bytes) {
        return {bytes.data(), static_cast<std::ptrdiff_t>(bytes.size())};
    }
    Replay& source() { return replay; }
    std::int64_t now_us() const { return time.now_us; }
    std::int64_t interval_us() const { return 40000; }
    void pass(std::int64_t us) { time.now_us += us; }

    test::TemporaryFolder folder;
    test::TestTime time;
    std::vector<std::uint8_t> file = std::vector<std::uint8_t>(1 << 20);
    std::vector<std::uint8_t> picture = std::vector<std::uint8_t>(1 << 16);
    Replay replay{test::TimedKernel(time)};
};

TEST(FrameSources, LendFramesInTheirOrder) {
    CameraRig camera;
    test::expect_frames_in_their_order(camera);
    ReplayRig replay;
    test::expect_frames_in_their_order(replay);
}

TEST(FrameSources, LendTheNewestOfThoseThatWait) {
    CameraRig camera;
    test::expect_the_newest_of_those_that_wait(camera);
    ReplayRig replay;
    test::expect_the_newest_of_those_that_wait(replay);
}

TEST(FrameSources, LendAFrameFromBehindAMoment) {
    CameraRig camera;
    test::expect_a_frame_from_behind_a_moment(camera);
    ReplayRig replay;
    test::expect_a_frame_from_behind_a_moment(replay);
}

/// The sums of the rows of the next frame, line by line.
template <class Source, class Pass>
std::vector<std::uint32_t> row_sums(hal::FrameLines<Source>& lines, Pass pass) {
    std::vector<std::uint32_t> sums(static_cast<std::size_t>(lines.size().height));
    auto program = stream(RowProjection({sums.data(), lines.size().height}));
    std::vector<std::uint8_t> scratch(1 << 12);
    EXPECT_EQ(hal::begin_frame(lines, program, Border::replicate,
                               {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}),
              Status::ok);
    EXPECT_FALSE(*hal::pump(lines, program)) << "it has not been taken yet";
    pass();
    EXPECT_TRUE(*hal::pump(lines, program));
    return sums;
}

TEST(LinesOfCameras, AreMeasuredWhereTheDriverPutThem) {
    CameraRig rig;
    hal::FrameLines<Camera> lines(rig.camera, hal::PixelFormat::gray8, {64, 48}, 60000);
    for (std::uint32_t frame = 0; frame < 10; ++frame) {
        const auto sums = row_sums(lines, [&] { rig.pass(40000); });
        for (std::size_t y = 0; y < sums.size(); ++y) {
            std::uint32_t expected = 0;
            for (std::size_t x = 0; x < 64; ++x) expected += test::camera_byte(frame, 64 * y + x);
            ASSERT_EQ(sums[y], expected) << "frame " << frame << " row " << y;
        }
    }
    rig.device.unplugged = true;
    ASSERT_EQ(lines.start(), Status::ok);
    EXPECT_EQ(lines.next().status(), Status::io_error);
    EXPECT_EQ(lines.source_status(), Status::device_lost);
}

TEST(LinesOfCameras, AreThoseOfPicturesInAFolderToo) {
    ReplayRig rig;
    hal::FrameLines<Replay> lines(rig.replay, hal::PixelFormat::gray8, {4, 3}, 60000);
    for (std::uint32_t frame = 1; frame < 8; ++frame)
        EXPECT_EQ(row_sums(lines, [&] { rig.pass(40000); }),
                  std::vector<std::uint32_t>(3, 4 * ('a' + frame % 3)));
}

}  // namespace
}  // namespace fovea::linux_port
