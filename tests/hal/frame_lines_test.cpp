// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/hal/feed.hpp>
#include <fovea/hal/frame_lines.hpp>
#include <fovea/simulated/frames.hpp>
#include <fovea/statistics/projection.hpp>
#include <fovea/stream/stream.hpp>
#include <support/guarded_image.hpp>

namespace fovea::hal {
namespace {

constexpr std::int64_t any_age = 1000000000;

static_assert(is_line_source_v<FrameLines<simulated::Frames>>);

test::GuardedImage<Gray8> picture(Size size, std::uint64_t seed) {
    Random random(seed);
    test::GuardedImage<Gray8> image(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) image(x, y) = static_cast<Gray8>(random.next());
    return image;
}

TEST(FrameLines, AreTheRowsWhereTheyLie) {
    const auto image = picture({7, 5}, 1);
    simulated::Clock clock;
    simulated::Frames frames({image.view()}, clock);
    FrameLines<simulated::Frames> lines(frames, PixelFormat::gray8, {7, 5}, any_age);
    EXPECT_EQ(lines.size(), (Size{7, 5}));
    EXPECT_TRUE(lines.next()->empty()) << "no frame was begun";
    for (int round = 0; round < 3; ++round) {
        ASSERT_EQ(lines.start(), Status::ok);
        EXPECT_TRUE(lines.next()->empty()) << "it has not been taken yet";
        clock.now += frames.interval_us();
        for (int y = 0; y < 5; ++y) {
            const auto line = lines.next();
            ASSERT_TRUE(line.ok());
            EXPECT_EQ(line->data(), image.view().row(y));
            EXPECT_EQ(line->size(), 7);
            EXPECT_EQ(frames.lent(), 1);
        }
        EXPECT_TRUE(lines.next()->empty());
        EXPECT_EQ(frames.lent(), 0) << "the driver has it back";
        EXPECT_TRUE(lines.next()->empty()) << "until the next is begun";
    }
}

TEST(FrameLines, GiveUpAFrameThatIsBegunAnew) {
    const auto image = picture({4, 4}, 2);
    simulated::Clock clock;
    simulated::Frames frames({image.view()}, clock);
    FrameLines<simulated::Frames> lines(frames, PixelFormat::gray8, {4, 4}, any_age);
    ASSERT_EQ(lines.start(), Status::ok);
    clock.now += frames.interval_us();
    EXPECT_EQ(lines.next()->size(), 4);
    ASSERT_EQ(lines.start(), Status::ok);
    EXPECT_EQ(frames.lent(), 0);
    clock.now += frames.interval_us();
    EXPECT_EQ(lines.next()->data(), image.view().row(0)) << "of the next frame, from its top";
}

TEST(FrameLines, SayWhatIsWrong) {
    const auto image = picture({4, 4}, 3);
    simulated::Clock clock;
    simulated::Frames frames({image.view()}, clock);
    FrameLines<simulated::Frames> other(frames, PixelFormat::gray8, {4, 5}, any_age);
    ASSERT_EQ(other.start(), Status::ok);
    clock.now += frames.interval_us();
    EXPECT_EQ(other.next().status(), Status::truncated);
    EXPECT_TRUE(other.next()->empty());
    EXPECT_EQ(frames.lent(), 0);
    FrameLines<simulated::Frames> lines(frames, PixelFormat::gray8, {4, 4}, any_age);
    frames.gone = true;
    ASSERT_EQ(lines.start(), Status::ok);
    EXPECT_EQ(lines.next().status(), Status::io_error);
    EXPECT_EQ(lines.source_status(), Status::device_lost);
    frames.gone = false;
    ASSERT_EQ(lines.start(), Status::ok);
    clock.now += frames.interval_us();
    EXPECT_EQ(lines.next()->size(), 4);
}

TEST(FrameLines, FeedAStreamWithTheFrame) {
    const auto image = picture({9, 6}, 4);
    simulated::Clock clock;
    simulated::Frames frames({image.view()}, clock);
    FrameLines<simulated::Frames> lines(frames, PixelFormat::gray8, {9, 6}, any_age);
    std::uint32_t sums[6] = {};
    std::uint32_t expected[6] = {};
    ASSERT_EQ(project_rows(image.view(), expected), Status::ok);
    auto program = stream(RowProjection(sums));
    std::vector<std::uint8_t> scratch(1 << 12);
    ASSERT_EQ(begin_frame(lines, program, Border::replicate,
                          {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}),
              Status::ok);
    EXPECT_FALSE(*pump(lines, program));
    clock.now += frames.interval_us();
    EXPECT_TRUE(*pump(lines, program));
    for (int y = 0; y < 6; ++y) EXPECT_EQ(sums[y], expected[y]);
}

}  // namespace
}  // namespace fovea::hal
