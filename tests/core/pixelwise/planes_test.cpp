// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fovea/base/random.hpp>
#include <fovea/pixelwise/planes.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

TEST(Planes, HoldOneColourEach) {
    GuardedImage<Rgb888> src({2, 1});
    GuardedImage<Gray8> red({2, 1}), green({2, 1}), blue({2, 1});
    src(0, 0) = {1, 2, 3};
    src(1, 0) = {40, 50, 60};
    ASSERT_EQ(split_planes(src.view(), red.view(), green.view(), blue.view()), Status::ok);
    EXPECT_EQ(red(0, 0), 1);
    EXPECT_EQ(green(0, 0), 2);
    EXPECT_EQ(blue(0, 0), 3);
    EXPECT_EQ(red(1, 0), 40);
    EXPECT_EQ(green(1, 0), 50);
    EXPECT_EQ(blue(1, 0), 60);
}

TEST(Planes, SplitAndMergedAreTheImageAtEverySizeWithAndWithoutGaps) {
    Random random(311);
    for (const int padding : {0, 3})
        for (const Size size : test_sizes()) {
            GuardedImage<Rgb888> src(size, padding), back(size, padding);
            GuardedImage<Gray8> red(size, padding), green(size, padding), blue(size, padding);
            src.fill(random);
            ASSERT_EQ(split_planes(src.view(), red.view(), green.view(), blue.view()), Status::ok);
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x)
                    ASSERT_EQ((Rgb888{red(x, y), green(x, y), blue(x, y)}), src(x, y));
            ASSERT_EQ(merge_planes(red.view(), green.view(), blue.view(), back.view()), Status::ok);
            ASSERT_TRUE(equal(src.view(), back.view()));
            GuardedImage<Gray8> one(size, padding);
            ASSERT_EQ(extract_plane(src.view(), ColourChannel::red, one.view()), Status::ok);
            ASSERT_TRUE(equal(one.view(), red.view()));
            ASSERT_EQ(extract_plane(src.view(), ColourChannel::green, one.view()), Status::ok);
            ASSERT_TRUE(equal(one.view(), green.view()));
            ASSERT_EQ(extract_plane(src.view(), ColourChannel::blue, one.view()), Status::ok);
            ASSERT_TRUE(equal(one.view(), blue.view()));
            ASSERT_EQ(to_rgb(red.view(), back.view()), Status::ok);
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x)
                    ASSERT_EQ(back(x, y), (Rgb888{red(x, y), red(x, y), red(x, y)}));
        }
}

// The toolkit's copy of a part of a planar image gave all three planes the red.
TEST(Planes, OfAPartKeepTheirOwnColours) {
    Random random(312);
    GuardedImage<Rgb888> src({20, 9});
    src.fill(random);
    const Rectangle part{3, 2, 11, 5};
    GuardedImage<Gray8> red({20, 9}), green({20, 9}), blue({20, 9});
    const auto untouched = Gray8{7};
    red.fill(untouched);
    green.fill(untouched);
    blue.fill(untouched);
    ASSERT_EQ(split_planes(*src.view().crop(part), *red.view().crop(part), *green.view().crop(part),
                           *blue.view().crop(part)),
              Status::ok);
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 20; ++x) {
            const bool inside = part.contains({x, y});
            ASSERT_EQ(red(x, y), inside ? src(x, y).red : untouched);
            ASSERT_EQ(green(x, y), inside ? src(x, y).green : untouched);
            ASSERT_EQ(blue(x, y), inside ? src(x, y).blue : untouched);
        }
}

TEST(Planes, SayWhatIsWrongAndLeaveTheOutputs) {
    GuardedImage<Rgb888> colour({4, 4});
    GuardedImage<Gray8> a({4, 4}), b({4, 4}), other({4, 5});
    colour.fill(Rgb888{1, 2, 3});
    a.fill(Gray8{77});
    b.fill(Gray8{77});
    other.fill(Gray8{77});
    EXPECT_EQ(split_planes(ImageView<const Rgb888>(), a.view(), b.view(), b.view()), Status::empty_image);
    EXPECT_EQ(split_planes(colour.view(), other.view(), a.view(), b.view()), Status::size_mismatch);
    EXPECT_EQ(split_planes(colour.view(), a.view(), other.view(), b.view()), Status::size_mismatch);
    EXPECT_EQ(split_planes(colour.view(), a.view(), b.view(), other.view()), Status::size_mismatch);
    EXPECT_EQ(merge_planes(ImageView<const Gray8>(), a.view(), b.view(), colour.view()), Status::empty_image);
    EXPECT_EQ(merge_planes(other.view(), a.view(), b.view(), colour.view()), Status::size_mismatch);
    EXPECT_EQ(merge_planes(a.view(), other.view(), b.view(), colour.view()), Status::size_mismatch);
    EXPECT_EQ(merge_planes(a.view(), b.view(), other.view(), colour.view()), Status::size_mismatch);
    EXPECT_EQ(merge_planes(other.view(), other.view(), other.view(), colour.view()), Status::size_mismatch);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) {
            EXPECT_EQ(a(x, y), 77);
            EXPECT_EQ(b(x, y), 77);
            EXPECT_EQ(colour(x, y), (Rgb888{1, 2, 3}));
        }
}

}  // namespace
}  // namespace fovea::test
