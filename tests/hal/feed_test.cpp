// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/filter/gaussian.hpp>
#include <fovea/hal/feed.hpp>
#include <fovea/pixelwise/point_stages.hpp>
#include <fovea/simulated/lines.hpp>
#include <fovea/statistics/projection.hpp>
#include <fovea/stream/stream.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

/// Says whatever a test wants it to say.
struct Scripted {
    Span<const std::uint8_t> line;
    static Size size() { return {4, 2}; }
    static Status start() { return Status::ok; }
    Result<Span<const std::uint8_t>> next() const { return line; }
};
static_assert(hal::is_line_source_v<Scripted>);
static_assert(!hal::is_line_source_v<int>);

struct Feeding : testing::Test {
    std::vector<std::uint8_t> memory = std::vector<std::uint8_t>(1 << 13);
    Span<std::uint8_t> scratch{memory.data(), 1 << 13};
};

TEST_F(Feeding, GivesTheBitsOfTheFrame) {
    Random random(7);
    for (const Size size : test_sizes())
        for (const int pause : {0, 1, 3}) {
            GuardedImage<Gray8> image(size), expected(size), dst(size);
            image.fill(random);
            auto whole = stream(stages::gaussian_5x5, into(expected.view()));
            ASSERT_EQ(whole.run(image.view(), Border::reflect_101, scratch), Status::ok);
            simulated::Lines lines(image.view());
            lines.pause = pause;
            auto program = stream(stages::gaussian_5x5, into(dst.view()));
            ASSERT_EQ(hal::begin_frame(lines, program, Border::reflect_101, scratch), Status::ok);
            int calls = 1;
            Result<bool> complete = hal::pump(lines, program);
            for (; complete && !*complete; complete = hal::pump(lines, program)) ++calls;
            ASSERT_TRUE(complete.ok());
            EXPECT_EQ(calls, pause * size.height + 1);
            EXPECT_TRUE(equal(dst.view(), expected.view()));
            EXPECT_TRUE(*hal::pump(lines, program)) << "a complete frame stays complete";
        }
}

TEST_F(Feeding, BeginsAnewAfterALostLine) {
    GuardedImage<Gray8> image({9, 5});
    Random random(8);
    image.fill(random);
    std::uint32_t sums[5] = {};
    std::uint32_t expected[5] = {};
    ASSERT_EQ(project_rows(image.view(), expected), Status::ok);
    simulated::Lines lines(image.view());
    lines.lost = 3;
    auto program = stream(RowProjection(sums));
    ASSERT_EQ(hal::begin_frame(lines, program, Border::replicate, scratch), Status::ok);
    EXPECT_EQ(hal::pump(lines, program).status(), Status::truncated);
    EXPECT_FALSE(program.complete());
    lines.lost = -1;
    ASSERT_EQ(hal::begin_frame(lines, program, Border::replicate, scratch), Status::ok);
    EXPECT_TRUE(*hal::pump(lines, program));
    for (int y = 0; y < 5; ++y) EXPECT_EQ(sums[y], expected[y]);
}

TEST_F(Feeding, PassesOnWhatSourceAndStreamSay) {
    GuardedImage<Gray8> image({9, 5});
    std::uint32_t sums[5] = {};
    simulated::Lines lines(image.view());
    auto program = stream(RowProjection(Span<std::uint32_t>(sums).first(4)));
    EXPECT_EQ(hal::begin_frame(lines, program, Border::replicate, scratch), Status::size_mismatch);
    EXPECT_EQ(hal::begin_frame(lines, program, Border::replicate, scratch.first(3)),
              Status::scratch_too_small);
    auto fitting = stream(RowProjection(sums));
    lines.broken = true;
    EXPECT_EQ(hal::begin_frame(lines, fitting, Border::replicate, scratch), Status::io_error);
    EXPECT_EQ(hal::pump(lines, fitting).status(), Status::io_error);
}

TEST_F(Feeding, TakesNoLineOfAnotherLength) {
    const std::uint8_t bytes[5] = {};
    std::uint32_t sums[2] = {};
    auto program = stream(RowProjection(sums));
    Scripted source{Span<const std::uint8_t>(bytes).first(3)};
    ASSERT_EQ(hal::begin_frame(source, program, Border::replicate, scratch), Status::ok);
    EXPECT_EQ(hal::pump(source, program).status(), Status::size_mismatch);
    source.line = bytes;
    EXPECT_EQ(hal::pump(source, program).status(), Status::size_mismatch);
    source.line = {};
    EXPECT_FALSE(*hal::pump(source, program));
}

TEST_F(Feeding, CountsTheBytesOfWiderPixels) {
    const std::uint8_t bytes[8] = {10, 128, 20, 128, 30, 128, 40, 128};
    std::uint32_t sums[2] = {};
    auto program = stream(stages::gray_from_yuyv, RowProjection(sums));
    Scripted source{bytes};
    ASSERT_EQ(hal::begin_frame(source, program, Border::replicate, scratch), Status::ok);
    EXPECT_TRUE(*hal::pump(source, program));
    EXPECT_EQ(sums[1], 100u);
}

}  // namespace
}  // namespace fovea::test
