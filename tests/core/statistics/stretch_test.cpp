// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/statistics/stretch.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

std::vector<std::uint8_t> scratch_bytes() {
    return std::vector<std::uint8_t>(static_cast<std::size_t>(histogram_stretching_scratch()));
}
Span<std::uint8_t> span_of(std::vector<std::uint8_t>& bytes) {
    return {bytes.data(), static_cast<std::ptrdiff_t>(bytes.size())};
}

TEST(Spread, UsesTheWholeRangeAndKeepsTheOrder) {
    Random random(121);
    for (const Size size : test_sizes()) {
        GuardedImage<Gray8> src(size), dst(size);
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) src(x, y) = static_cast<Gray8>(random.between(90, 130));
        ASSERT_EQ(spread(src.view(), dst.view()), Status::ok);
        const Extremes<Gray8> from = *extremes_of(src.view());
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
                const int range = std::max(from.highest - from.lowest, 1);
                ASSERT_EQ(dst(x, y), (510 * (src(x, y) - from.lowest) + range) / (2 * range));
            }
    }
}

// The toolkit promised zeros and left the output as it was.
TEST(Spread, MakesAnImageOfOneLevelBlack) {
    GuardedImage<Gray8> src({9, 4}), dst({9, 4});
    src.fill(Gray8{120});
    dst.fill(Gray8{77});
    ASSERT_EQ(spread(src.view(), dst.view()), Status::ok);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 9; ++x) EXPECT_EQ(dst(x, y), 0);
}

TEST(HistogramStretching, HoldsWhatIsBeyondTheQuantiles) {
    // Ten levels, one pixel each: the tenth is level 10, nine tenths are level 90.
    GuardedImage<Gray8> src({10, 1}), dst({10, 1});
    for (int x = 0; x < 10; ++x) src(x, 0) = static_cast<Gray8>(10 * (x + 1));
    std::vector<std::uint8_t> scratch = scratch_bytes();
    ASSERT_EQ(histogram_stretching(src.view(), 6553, 58982, span_of(scratch), dst.view()), Status::ok);
    const int expected[] = {0, 32, 64, 96, 128, 159, 191, 223, 255, 255};
    for (int x = 0; x < 10; ++x) EXPECT_EQ(dst(x, 0), expected[x]) << x;
}

TEST(HistogramStretching, OfEverythingIsSpread) {
    Random random(122);
    const Size size{51, 9};
    GuardedImage<Gray8> src(size), stretched(size), spreaded(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) src(x, y) = static_cast<Gray8>(random.between(30, 99));
    std::vector<std::uint8_t> scratch = scratch_bytes();
    ASSERT_EQ(histogram_stretching(src.view(), 0, whole_share, span_of(scratch), stretched.view()),
              Status::ok);
    ASSERT_EQ(spread(src.view(), spreaded.view()), Status::ok);
    EXPECT_TRUE(equal(stretched.view(), spreaded.view()));
}

TEST(HistogramStretching, RefusesSharesOutOfOrder) {
    GuardedImage<Gray8> src({4, 4}), dst({4, 4});
    src.fill(Gray8{1});
    dst.fill(Gray8{77});
    std::vector<std::uint8_t> scratch = scratch_bytes();
    EXPECT_EQ(histogram_stretching(src.view(), 2, 1, span_of(scratch), dst.view()), Status::bad_argument);
    EXPECT_EQ(histogram_stretching(src.view(), 0, whole_share + 1, span_of(scratch), dst.view()),
              Status::bad_argument);
    EXPECT_EQ(dst(0, 0), 77);
}

template <class Wide>
void compare_with_wide_integers(std::uint64_t seed, std::int64_t low, std::int64_t high) {
    Random random(seed);
    for (const Size size : test_sizes()) {
        GuardedImage<Wide> src(size);
        GuardedImage<Gray8> dst(size);
        std::int64_t lowest = high;
        std::int64_t highest = low;
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
                const auto draw = static_cast<std::int64_t>(random.next());
                const std::int64_t value =
                    low + (random.below(9) == 0 ? high - low : draw % (high - low + 1));
                src(x, y) = static_cast<Wide>(value);
                lowest = std::min(lowest, value);
                highest = std::max(highest, value);
            }
        ASSERT_EQ(auto_scale(ImageView<const Wide>(src.view()), dst.view()), Status::ok);
        const std::int64_t range = std::max<std::int64_t>(highest - lowest, 1);
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x)
                ASSERT_EQ(dst(x, y), (510 * (src(x, y) - lowest) + range) / (2 * range)) << range;
    }
}

// The toolkit's products overflowed where the range was above 32767, and above 8.4 million for 32 bits.
TEST(AutoScale, TakesEveryRangeOf16And32Bits) {
    compare_with_wide_integers<Gray16>(123, 0, 65535);
    compare_with_wide_integers<Gray16>(124, 700, 801);
    compare_with_wide_integers<Gradient16>(125, -32768, 32767);
    compare_with_wide_integers<Gradient16>(126, -4080, 4080);
    compare_with_wide_integers<Sum32>(127, 0, std::numeric_limits<std::uint32_t>::max());
    compare_with_wide_integers<Sum32>(128, 4000000000, 4000000009);
}

TEST(AutoScale, IsExactForEveryValueOfManyRanges) {
    // Every range up to 1100, and one in 331 of those above.
    for (int range = 1; range <= 65535; range += range < 1100 ? 1 : 331) {
        GuardedImage<Gray16> src({range + 1, 1});
        GuardedImage<Gray8> dst({range + 1, 1});
        for (int x = 0; x <= range; ++x) src(x, 0) = static_cast<Gray16>(65535 - range + x);
        ASSERT_EQ(auto_scale(ImageView<const Gray16>(src.view()), dst.view()), Status::ok);
        for (int x = 0; x <= range; ++x)
            ASSERT_EQ(dst(x, 0), (510 * x + range) / (2 * range)) << x << " " << range;
    }
}

// The toolkit's formula for real pixels lacked parentheses: 10, 20, 30, 110 became 0, 180, 103, 0.
TEST(AutoScale, MapsTenTwentyThirtyAndAHundredAndTen) {
    GuardedImage<Gray16> src({4, 1});
    GuardedImage<Gray8> dst({4, 1});
    const Gray16 values[] = {10, 20, 30, 110};
    for (int x = 0; x < 4; ++x) src(x, 0) = values[x];
    ASSERT_EQ(auto_scale(ImageView<const Gray16>(src.view()), dst.view()), Status::ok);
    const int expected[] = {0, 26, 51, 255};
    for (int x = 0; x < 4; ++x) EXPECT_EQ(dst(x, 0), expected[x]);
}

TEST(AutoScale, MakesAnImageOfOneValueBlack) {
    GuardedImage<Gradient16> src({5, 2});
    GuardedImage<Gray8> dst({5, 2});
    src.fill(Gradient16{-900});
    ASSERT_EQ(auto_scale(ImageView<const Gradient16>(src.view()), dst.view()), Status::ok);
    for (int x = 0; x < 5; ++x) EXPECT_EQ(dst(x, 1), 0);
}

}  // namespace
}  // namespace fovea::test
