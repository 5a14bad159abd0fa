// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <fovea/base/random.hpp>
#include <fovea/pixelwise/depth.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

int held(double value) { return static_cast<int>(std::clamp(std::floor(value + 0.5), 0.0, 255.0)); }

/// Every shift on random pixels and on the ends of the format, against real numbers; 33 bits are exact in
/// them.
template <class Wide>
void compare_with_real_numbers(std::uint64_t seed) {
    Random random(seed);
    const Size size{67, 5};
    GuardedImage<Wide> src(size);
    GuardedImage<Gray8> dst(size);
    for (int shift = 0; shift < static_cast<int>(8 * sizeof(Wide)); ++shift) {
        src.fill(random);
        src(0, 0) = std::numeric_limits<Wide>::max();
        src(1, 0) = std::numeric_limits<Wide>::min();
        ASSERT_EQ(narrow(ImageView<const Wide>(src.view()), shift, dst.view()), Status::ok);
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x)
                ASSERT_EQ(dst(x, y), held(std::ldexp(src(x, y), -shift))) << shift << " " << src(x, y);
    }
}

TEST(Narrow, DividesRoundsAndHoldsBothEnds) {
    compare_with_real_numbers<Gray16>(101);
    compare_with_real_numbers<Gradient16>(102);
    compare_with_real_numbers<Sum32>(103);
}

TEST(NarrowAbout128, PutsZeroIntoTheMiddle) {
    GuardedImage<Gradient16> src({5, 1});
    GuardedImage<Gray8> dst({5, 1});
    const Gradient16 values[] = {0, 8, -8, 32767, -32768};
    const int expected[] = {128, 129, 128, 255, 0};
    for (int x = 0; x < 5; ++x) src(x, 0) = values[x];
    ASSERT_EQ(narrow_about_128(src.view(), 4, dst.view()), Status::ok);
    for (int x = 0; x < 5; ++x) EXPECT_EQ(dst(x, 0), expected[x]) << values[x];
}

TEST(Widen, KeepsTheNumbersAndComesBack) {
    Random random(104);
    for (const Size size : test_sizes()) {
        GuardedImage<Gray8> src(size), back(size);
        GuardedImage<Gray16> wide(size);
        GuardedImage<Gradient16> signed_wide(size);
        GuardedImage<Sum32> sums(size);
        src.fill(random);
        ASSERT_EQ(widen(src.view(), wide.view()), Status::ok);
        ASSERT_EQ(widen(src.view(), signed_wide.view()), Status::ok);
        ASSERT_EQ(widen(src.view(), sums.view()), Status::ok);
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
                ASSERT_EQ(wide(x, y), src(x, y));
                ASSERT_EQ(signed_wide(x, y), src(x, y));
                ASSERT_EQ(sums(x, y), src(x, y));
            }
        ASSERT_EQ(narrow(ImageView<const Gray16>(wide.view()), 0, back.view()), Status::ok);
        EXPECT_TRUE(equal(src.view(), back.view()));
    }
}

}  // namespace
}  // namespace fovea::test
