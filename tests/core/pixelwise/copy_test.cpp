// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include <fovea/base/random.hpp>
#include <fovea/pixelwise/copy.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

bool in_frame(Size size, int thickness, int x, int y) {
    return x < thickness || y < thickness || x >= size.width - thickness || y >= size.height - thickness;
}

TEST(Copy, CopiesAnyPixel) {
    Random random(91);
    for (const Size size : test_sizes()) {
        GuardedImage<Rgb888> src(size), dst(size, 0);
        src.fill(random);
        ASSERT_EQ(copy(src.view(), dst.view()), Status::ok);
        EXPECT_TRUE(equal(src.view(), dst.view()));
        GuardedImage<Sum32> sums(size, 0), others(size, 0);
        sums.fill(random);
        ASSERT_EQ(copy(sums.view(), others.view()), Status::ok);
        EXPECT_TRUE(equal(sums.view(), others.view()));
    }
}

TEST(Copy, TakesACropToACropAndNothingElse) {
    Random random(92);
    GuardedImage<Gray8> src({20, 12}), dst({9, 9});
    src.fill(random);
    dst.fill(Gray8{7});
    ASSERT_EQ(copy(*src.view().crop({3, 4, 5, 6}), *dst.view().crop({2, 1, 5, 6})), Status::ok);
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 9; ++x) {
            const bool inside = x >= 2 && x < 7 && y >= 1 && y < 7;
            ASSERT_EQ(dst(x, y), inside ? src(x + 1, y + 3) : 7);
        }
}

TEST(Fill, SetsEveryPixelOfAnyKind) {
    for (const Size size : test_sizes()) {
        GuardedImage<Gray8> gray(size);
        GuardedImage<Rgb888> colour(size);
        ASSERT_EQ(fill(Gray8{9}, gray.view()), Status::ok);
        ASSERT_EQ(fill({1, 2, 3}, colour.view()), Status::ok);
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
                ASSERT_EQ(gray(x, y), 9);
                ASSERT_EQ(colour(x, y), (Rgb888{1, 2, 3}));
            }
    }
    EXPECT_EQ(fill(Gray8{1}, ImageView<Gray8>()), Status::empty_image);
}

// The toolkit cleared the first bytes of a colour image, whatever the region.
TEST(Fill, ClearsTheBytesOfAColourRegionAndNoOthers) {
    GuardedImage<Rgb888> image({8, 6});
    image.fill({200, 150, 100});
    ASSERT_EQ(fill({0, 0, 0}, *image.view().crop({5, 3, 2, 2})), Status::ok);
    for (int y = 0; y < 6; ++y)
        for (int x = 0; x < 8; ++x) {
            const bool inside = x >= 5 && x < 7 && y >= 3 && y < 5;
            EXPECT_EQ(image(x, y), (inside ? Rgb888{0, 0, 0} : Rgb888{200, 150, 100}));
        }
}

TEST(Frame, IsWhatIsNearerToTheBorderThanItsThickness) {
    Random random(93);
    for (const Size size : test_sizes())
        for (const int thickness : {1, 2, 5, 1000000000}) {
            GuardedImage<Gray16> src(size), before(size);
            src.fill(random);
            before.fill(random);
            GuardedImage<Gray16> filled = before;
            GuardedImage<Gray16> copied = before;
            ASSERT_EQ(fill_frame(Gray16{5}, thickness, filled.view()), Status::ok);
            ASSERT_EQ(copy_frame(src.view(), thickness, copied.view()), Status::ok);
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x) {
                    const bool inside = in_frame(size, thickness, x, y);
                    ASSERT_EQ(filled(x, y), inside ? 5 : before(x, y));
                    ASSERT_EQ(copied(x, y), inside ? src(x, y) : before(x, y));
                }
        }
}

// The toolkit read a wrong pixel for the bottom right corner when it did not work in place.
TEST(ReplicateFrame, TakesEveryCornerFromTheNearestInnerPixelInPlaceAndApart) {
    Random random(94);
    for (const Size size : test_sizes())
        for (const int thickness : {1, 2, 4}) {
            if (std::min(size.width, size.height) <= 2 * thickness) continue;
            GuardedImage<Gray8> src(size), dst(size);
            src.fill(random);
            ASSERT_EQ(replicate_frame(src.view(), thickness, dst.view()), Status::ok);
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x)
                    ASSERT_EQ(dst(x, y), src(std::clamp(x, thickness, size.width - 1 - thickness),
                                             std::clamp(y, thickness, size.height - 1 - thickness)));
            ASSERT_EQ(replicate_frame(src.view(), thickness, src.view()), Status::ok);
            EXPECT_TRUE(equal(src.view(), dst.view()));
        }
}

TEST(Frame, SaysWhatIsWrong) {
    GuardedImage<Gray8> src({6, 4}), dst({6, 4}), other({6, 5});
    src.fill(Gray8{1});
    dst.fill(Gray8{7});
    const ImageView<const Gray8> none;
    EXPECT_EQ(copy(none, dst.view()), Status::empty_image);
    EXPECT_EQ(copy(src.view(), other.view()), Status::size_mismatch);
    EXPECT_EQ(fill_frame(Gray8{0}, 1, ImageView<Gray8>()), Status::empty_image);
    EXPECT_EQ(fill_frame(Gray8{0}, 0, dst.view()), Status::bad_argument);
    EXPECT_EQ(copy_frame(none, 1, dst.view()), Status::empty_image);
    EXPECT_EQ(copy_frame(src.view(), 1, other.view()), Status::size_mismatch);
    EXPECT_EQ(copy_frame(src.view(), -1, dst.view()), Status::bad_argument);
    EXPECT_EQ(replicate_frame(none, 1, dst.view()), Status::empty_image);
    EXPECT_EQ(replicate_frame(src.view(), 1, other.view()), Status::size_mismatch);
    EXPECT_EQ(replicate_frame(src.view(), 0, dst.view()), Status::bad_argument);
    EXPECT_EQ(replicate_frame(src.view(), 2, dst.view()), Status::bad_argument);
    for (int x = 0; x < 6; ++x) EXPECT_EQ(dst(x, 0), 7);
}

}  // namespace
}  // namespace fovea::test
