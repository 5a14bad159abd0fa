// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include <fovea/base/random.hpp>
#include <fovea/warp/bilinear.hpp>
#include <support/guarded_image.hpp>
#include <support/render.hpp>

namespace fovea::test {
namespace {

TEST(SampleBilinear, WeighsFourPixelsByDistance) {
    GuardedImage<Gray8> src({2, 2});
    src(0, 0) = 10;
    src(1, 0) = 20;
    src(0, 1) = 30;
    src(1, 1) = 60;
    EXPECT_EQ(sample_bilinear(src.view(), fine(0, 0))->raw(), 10 << 16);
    EXPECT_EQ(sample_bilinear(src.view(), fine(1, 1))->raw(), 60 << 16);
    EXPECT_EQ(sample_bilinear(src.view(), fine(0.5, 0))->raw(), 15 << 16);
    EXPECT_EQ(sample_bilinear(src.view(), fine(0.5, 0.5))->raw(), 30 << 16);
    EXPECT_EQ(sample_bilinear(src.view(), fine(0.25, 0.75))->raw(), 31 * 65536 + 16384);
}

TEST(SampleBilinear, EqualsTheReferenceToTheStatedRounding) {
    Random random(81);
    for (const Size size : test_sizes()) {
        GuardedImage<Gray8> src(size);
        src.fill(random);
        for (int i = 0; i < 400; ++i) {
            const FinePoint place{FinePixel::from_raw(static_cast<std::int32_t>(
                                      random.below(static_cast<std::uint32_t>(size.width - 1) * 65536 + 1))),
                                  FinePixel::from_raw(static_cast<std::int32_t>(random.below(
                                      static_cast<std::uint32_t>(size.height - 1) * 65536 + 1)))};
            const double x = std::floor(place.x.raw() / 16.0 + 0.5) / 4096;
            const double y = std::floor(place.y.raw() / 16.0 + 0.5) / 4096;
            const int left = std::min(static_cast<int>(x), size.width - 1);
            const int top = std::min(static_cast<int>(y), size.height - 1);
            const int right = std::min(left + 1, size.width - 1);
            const int below = std::min(top + 1, size.height - 1);
            const double upper = src(left, top) + (x - left) * (src(right, top) - src(left, top));
            const double lower = src(left, below) + (x - left) * (src(right, below) - src(left, below));
            const double exact = (upper + (y - top) * (lower - upper)) * 65536;
            ASSERT_EQ(sample_bilinear(src.view(), place)->raw(),
                      static_cast<std::int32_t>(std::floor(exact + 0.5)));
        }
    }
}

TEST(SampleBilinear, IsExactOnARamp) {
    GuardedImage<Gray8> src({64, 64});
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) src(x, y) = static_cast<Gray8>(2 * x + y);
    Random random(82);
    for (int i = 0; i < 1000; ++i) {
        const double x = random.between(0, 63 * 4096) / 4096.0;
        const double y = random.between(0, 63 * 4096) / 4096.0;
        EXPECT_EQ(sample_bilinear(src.view(), fine(x, y))->raw(), std::lround((2 * x + y) * 65536));
    }
}

TEST(SampleBilinear, RefusesPlacesOutside) {
    GuardedImage<Gray8> src({5, 4});
    src.fill(Gray8{9});
    const double step = 1 / 65536.0;
    EXPECT_TRUE(sample_bilinear(src.view(), fine(4, 3)).ok());
    EXPECT_EQ(sample_bilinear(src.view(), fine(4 + step, 3)).status(), Status::out_of_range);
    EXPECT_EQ(sample_bilinear(src.view(), fine(4, 3 + step)).status(), Status::out_of_range);
    EXPECT_EQ(sample_bilinear(src.view(), fine(-step, 0)).status(), Status::out_of_range);
    EXPECT_EQ(sample_bilinear(src.view(), fine(0, -step)).status(), Status::out_of_range);
    EXPECT_EQ(sample_bilinear(ImageView<const Gray8>(), fine(0, 0)).status(), Status::out_of_range);
    EXPECT_EQ(nearest_sample({5, 4}, fine(9, -2)), fine(4, 0));
}

}  // namespace
}  // namespace fovea::test
