// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/pixelwise/threshold.hpp>
#include <fovea/statistics/histogram.hpp>
#include <fovea/statistics/otsu_threshold.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

std::vector<std::uint8_t> room() {
    return std::vector<std::uint8_t>(static_cast<std::size_t>(otsu_threshold_scratch()), 0xee);
}
Span<std::uint8_t> span_of(std::vector<std::uint8_t>& bytes) {
    return {bytes.data(), static_cast<std::ptrdiff_t>(bytes.size())};
}

TEST(OtsuThreshold, SplitsTwoClassesWhereverTheyAre) {
    GuardedImage<Gray8> src({4, 1}), dst({4, 1});
    src(0, 0) = 100;
    src(1, 0) = 101;
    src(2, 0) = 110;
    src(3, 0) = 111;
    std::vector<std::uint8_t> scratch = room();
    ASSERT_EQ(otsu_threshold(src.view(), span_of(scratch), dst.view()), Status::ok);
    for (int x = 0; x < 4; ++x) EXPECT_EQ(dst(x, 0), x < 2 ? 0 : 255);
    ASSERT_EQ(otsu_threshold_inverse(src.view(), span_of(scratch), dst.view()), Status::ok);
    for (int x = 0; x < 4; ++x) EXPECT_EQ(dst(x, 0), x < 2 ? 255 : 0);
}

TEST(OtsuThreshold, IsHistogramOtsuAndThreshold) {
    Random random(3);
    for (const Size size : test_sizes()) {
        GuardedImage<Gray8> src(size), dst(size), expected(size);
        src.fill(random);
        Histogram histogram;
        ASSERT_EQ(histogram_of(src.view(), histogram), Status::ok);
        const Result<Gray8> level = otsu(histogram);
        std::vector<std::uint8_t> scratch = room();
        const Status status = otsu_threshold(src.view(), span_of(scratch), dst.view());
        ASSERT_EQ(status, level.status());
        if (status != Status::ok) continue;
        ASSERT_EQ(threshold(src.view(), *level, expected.view()), Status::ok);
        EXPECT_TRUE(equal(dst.view(), expected.view()));
        ASSERT_EQ(otsu_threshold(src.view(), span_of(scratch), src.view()), Status::ok);
        EXPECT_TRUE(equal(src.view(), expected.view())) << "in place";
    }
}

TEST(OtsuThreshold, SaysWhatIsWrongAndLeavesTheOutput) {
    GuardedImage<Gray8> src({9, 3}), dst({9, 3}), other({8, 3});
    src.fill(Gray8{40});
    dst.fill(Gray8{77});
    std::vector<std::uint8_t> scratch = room();
    EXPECT_EQ(otsu_threshold(src.view(), span_of(scratch), dst.view()), Status::degenerate);
    EXPECT_EQ(otsu_threshold_inverse(src.view(), span_of(scratch), dst.view()), Status::degenerate);
    src(4, 1) = 41;
    EXPECT_EQ(otsu_threshold(ImageView<const Gray8>(), span_of(scratch), dst.view()), Status::empty_image);
    EXPECT_EQ(otsu_threshold(src.view(), span_of(scratch), other.view()), Status::size_mismatch);
    EXPECT_EQ(otsu_threshold(src.view(), span_of(scratch).first(span_of(scratch).size() - 1), dst.view()),
              Status::scratch_too_small);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 9; ++x) EXPECT_EQ(dst(x, y), 77);
}

}  // namespace
}  // namespace fovea::test
