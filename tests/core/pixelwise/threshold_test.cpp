// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fovea/base/random.hpp>
#include <fovea/pixelwise/threshold.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

TEST(Threshold, TakesTheLevelItself) {
    GuardedImage<Gray8> src({3, 1}), dst({3, 1});
    src(0, 0) = 99;
    src(1, 0) = 100;
    src(2, 0) = 101;
    ASSERT_EQ(threshold(src.view(), 100, dst.view()), Status::ok);
    EXPECT_EQ(dst(0, 0), 0);
    EXPECT_EQ(dst(1, 0), 255);
    EXPECT_EQ(dst(2, 0), 255);
    ASSERT_EQ(threshold_range(src.view(), 100, 100, dst.view()), Status::ok);
    EXPECT_EQ(dst(0, 0), 0);
    EXPECT_EQ(dst(1, 0), 255);
    EXPECT_EQ(dst(2, 0), 0);
}

TEST(Threshold, EqualsTheReferenceAtEveryLevel) {
    Random random(43);
    for (const Size size : test_sizes()) {
        GuardedImage<Gray8> src(size), over(size), under(size), within(size);
        src.fill(random);
        for (const int level : {0, 1, 100, 128, 254, 255}) {
            const auto bound = static_cast<Gray8>(level);
            const auto high = static_cast<Gray8>(level + (255 - level) / 3);
            ASSERT_EQ(threshold(src.view(), bound, over.view()), Status::ok);
            ASSERT_EQ(threshold_inverse(src.view(), bound, under.view()), Status::ok);
            ASSERT_EQ(threshold_range(src.view(), bound, high, within.view()), Status::ok);
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x) {
                    ASSERT_EQ(over(x, y), src(x, y) >= bound ? 255 : 0);
                    ASSERT_EQ(within(x, y), src(x, y) >= bound && src(x, y) <= high ? 255 : 0);
                }
        }
    }
}

TEST(ThresholdInverse, IsTheExactComplementSoThatNoPixelBelongsToBoth) {
    Random random(44);
    GuardedImage<Gray8> src({97, 5}), over({97, 5}), under({97, 5});
    src.fill(random);
    for (int level = 0; level < 256; ++level) {
        ASSERT_EQ(threshold(src.view(), static_cast<Gray8>(level), over.view()), Status::ok);
        ASSERT_EQ(threshold_inverse(src.view(), static_cast<Gray8>(level), under.view()), Status::ok);
        for (int y = 0; y < 5; ++y)
            for (int x = 0; x < 97; ++x) ASSERT_EQ(over(x, y) ^ under(x, y), 255);
    }
}

TEST(Threshold, WorksInPlace) {
    Random random(45);
    GuardedImage<Gray8> src({70, 6}), dst({70, 6});
    src.fill(random);
    ASSERT_EQ(threshold(src.view(), 100, dst.view()), Status::ok);
    ASSERT_EQ(threshold(src.view(), 100, src.view()), Status::ok);
    EXPECT_TRUE(equal(src.view(), dst.view()));
}

TEST(ThresholdFilter, KeepsWhatIsAtLeastTheLevelAndTheInverseTheRest) {
    Random random(33);
    for (const Size size : test_sizes())
        for (const int level : {0, 1, 100, 128, 255}) {
            GuardedImage<Gray8> src(size), kept(size), rest(size);
            src.fill(random);
            ASSERT_EQ(threshold_filter(src.view(), static_cast<Gray8>(level), kept.view()), Status::ok);
            ASSERT_EQ(threshold_filter_inverse(src.view(), static_cast<Gray8>(level), rest.view()),
                      Status::ok);
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x) {
                    ASSERT_EQ(kept(x, y), src(x, y) >= level ? src(x, y) : 0);
                    ASSERT_EQ(kept(x, y) + rest(x, y), src(x, y)) << "no pixel is in both or in none";
                }
        }
}

TEST(Threshold, IsTheSameWithAndWithoutGapsBetweenTheRows) {
    Random random(34);
    const Size size{37, 9};
    GuardedImage<Gray8> apart(size, 3), joined(size, 0), out_apart(size, 3), out_joined(size, 0),
        mixed(size, 0);
    apart.fill(random);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) joined(x, y) = apart(x, y);
    ASSERT_EQ(threshold(apart.view(), 90, out_apart.view()), Status::ok);
    ASSERT_EQ(threshold(joined.view(), 90, out_joined.view()), Status::ok);
    ASSERT_EQ(threshold(apart.view(), 90, mixed.view()), Status::ok);
    EXPECT_TRUE(equal(out_apart.view(), out_joined.view()));
    EXPECT_TRUE(equal(out_apart.view(), mixed.view()));
}

TEST(Threshold, SaysWhatIsWrongAndLeavesTheOutput) {
    GuardedImage<Gray8> src({4, 4}), dst({4, 4}), other({4, 5});
    src.fill(Gray8{1});
    dst.fill(Gray8{77});
    other.fill(Gray8{77});
    EXPECT_EQ(threshold(ImageView<const Gray8>(), 1, dst.view()), Status::empty_image);
    EXPECT_EQ(threshold(src.view(), 1, other.view()), Status::size_mismatch);
    EXPECT_EQ(threshold_inverse(ImageView<const Gray8>(), 1, dst.view()), Status::empty_image);
    EXPECT_EQ(threshold_inverse(src.view(), 1, other.view()), Status::size_mismatch);
    EXPECT_EQ(threshold_range(ImageView<const Gray8>(), 1, 2, dst.view()), Status::empty_image);
    EXPECT_EQ(threshold_range(src.view(), 1, 2, other.view()), Status::size_mismatch);
    EXPECT_EQ(threshold_range(src.view(), 2, 1, dst.view()), Status::bad_argument);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) EXPECT_EQ(dst(x, y), 77);
}

}  // namespace
}  // namespace fovea::test
