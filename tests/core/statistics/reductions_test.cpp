// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/statistics/reductions.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

template <class Pixel>
void compare_with_one_by_one(std::uint64_t seed) {
    Random random(seed);
    for (const Size size : test_sizes())
        for (const int padding : {0, 3}) {
            GuardedImage<Pixel> src(size, padding);
            src.fill(random);
            Pixel lowest = src(0, 0);
            Pixel highest = src(0, 0);
            std::int64_t sum = 0;
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x) {
                    lowest = std::min(lowest, src(x, y));
                    highest = std::max(highest, src(x, y));
                    sum += src(x, y);
                }
            const auto extremes = extremes_of(src.view());
            ASSERT_TRUE(extremes.ok());
            ASSERT_EQ(extremes->lowest, lowest);
            ASSERT_EQ(extremes->highest, highest);
            ASSERT_EQ(*sum_of(src.view()), sum);
        }
    EXPECT_EQ(extremes_of(ImageView<Pixel>()).status(), Status::empty_image);
    EXPECT_EQ(sum_of(ImageView<Pixel>()).status(), Status::empty_image);
}

TEST(Reductions, AreThoseOfOnePixelAfterTheOther) {
    compare_with_one_by_one<Gray8>(111);
    compare_with_one_by_one<Gray16>(112);
    compare_with_one_by_one<Gradient16>(113);
    compare_with_one_by_one<Sum32>(114);
}

TEST(ExtremesOf, FindsASingleExtremePixelWhereverItIs) {
    const Size size{70, 3};
    for (int place = 0; place < size.width * size.height; ++place) {
        GuardedImage<Gray8> src(size);
        src.fill(Gray8{100});
        src(place % size.width, place / size.width) = place % 2 == 0 ? 101 : 99;
        const Extremes<Gray8> extremes = *extremes_of(src.view());
        ASSERT_EQ(extremes.highest - extremes.lowest, 1) << place;
    }
}

// The toolkit summed in 32 bits, which 16.8 million white pixels overflow.
TEST(SumOf, HoldsMoreThan32Bits) {
    const Size size{32767, 600};
    std::vector<Gray8> pixels(static_cast<std::size_t>(size.area()), 255);
    const ImageView<const Gray8> src(pixels.data(), size, size.width);
    EXPECT_EQ(*sum_of(src), size.area() * 255);
    const MeanAndVariance white = *mean_and_variance(src);
    EXPECT_EQ(white.mean, GrayLevel::from_int(255));
    EXPECT_EQ(white.variance, GrayVariance::from_int(0));
}

TEST(MeanAndVariance, AreKnownForTwoLevels) {
    GuardedImage<Gray8> src({2, 2});
    src(0, 0) = src(1, 0) = 0;
    src(0, 1) = src(1, 1) = 255;
    const MeanAndVariance found = *mean_and_variance(src.view());
    EXPECT_EQ(found.mean, GrayLevel::from_ratio(255, 2));
    EXPECT_EQ(found.variance, GrayVariance::from_ratio(255 * 255, 4)) << "the largest that there is";
}

TEST(MeanAndVariance, AreTheRealOnesRounded) {
    Random random(115);
    for (const Size size : test_sizes())
        for (const int spread : {1, 3, 255}) {
            GuardedImage<Gray8> src(size);
            const int base = random.between(0, 255 - spread);
            long double sum = 0;
            long double squares = 0;
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x) {
                    src(x, y) = static_cast<Gray8>(base + random.between(0, spread));
                    sum += src(x, y);
                    squares += static_cast<long double>(src(x, y)) * src(x, y);
                }
            const auto count = static_cast<long double>(size.area());
            const MeanAndVariance found = *mean_and_variance(src.view());
            EXPECT_EQ(found.mean.raw(), static_cast<int>(std::floor(sum / count * 65536 + 0.5L)));
            // Half a unit of rounding and 2^-31 of the computation.
            const long double variance = (squares - sum * sum / count) / count;
            EXPECT_NEAR(static_cast<double>(found.variance.raw()), static_cast<double>(variance * 65536),
                        0.51);
        }
}

TEST(Reductions, RefuseSidesThatAreTooLong) {
    std::vector<Gray8> pixels(40000, 1);
    const ImageView<const Gray8> wide(pixels.data(), {40000, 1}, 40000);
    EXPECT_EQ(sum_of(wide).status(), Status::image_too_large);
    EXPECT_EQ(mean_and_variance(wide).status(), Status::image_too_large);
    EXPECT_EQ(mean_and_variance(ImageView<const Gray8>()).status(), Status::empty_image);
}

template <class Pixel>
void expect_same_of_rows(std::uint32_t seed) {
    Random random(seed);
    for (const Size size : test_sizes()) {
        GuardedImage<Pixel> image(size);
        image.fill(random);
        ExtremesAccumulator<Pixel> extremes[2];
        SumAccumulator<Pixel> sums[2];
        for (int i = 0; i < 2; ++i) {
            // What was gathered before is forgotten.
            extremes[i].add_row(image.view().row(0), size.width, 0);
            sums[i].add_row(image.view().row(0), size.width, 0);
            ASSERT_EQ(extremes[i].begin(size), Status::ok);
            ASSERT_EQ(sums[i].begin(size), Status::ok);
            EXPECT_EQ(extremes[i].result().status(), Status::empty_image);
            EXPECT_EQ(sums[i].result().status(), Status::empty_image);
        }
        for (int y = 0; y < size.height; ++y) {
            const int strip = y < size.height / 2 ? 0 : 1;
            extremes[strip].add_row(image.view().row(y), size.width, y);
            sums[strip].add_row(image.view().row(y), size.width, y);
        }
        extremes[0].merge(extremes[1]);
        sums[0].merge(sums[1]);
        extremes[0].merge(ExtremesAccumulator<Pixel>());
        EXPECT_EQ(extremes[0].result()->lowest, extremes_of(image.view())->lowest);
        EXPECT_EQ(extremes[0].result()->highest, extremes_of(image.view())->highest);
        EXPECT_EQ(*sums[0].result(), *sum_of(image.view()));
    }
}

TEST(ReductionAccumulators, GiveTheSameOfRowsInStrips) {
    expect_same_of_rows<Gray8>(1);
    expect_same_of_rows<Gray16>(2);
    expect_same_of_rows<Gradient16>(3);
    expect_same_of_rows<Sum32>(4);
    Random random(5);
    for (const Size size : test_sizes()) {
        GuardedImage<Gray8> image(size);
        image.fill(random);
        MeanAndVarianceAccumulator upper, lower;
        ASSERT_EQ(upper.begin(size), Status::ok);
        EXPECT_EQ(upper.result().status(), Status::empty_image);
        for (int y = 0; y < size.height; ++y)
            (y < size.height / 2 ? upper : lower).add_row(image.view().row(y), size.width, y);
        upper.merge(lower);
        const Result<MeanAndVariance> made = upper.result();
        const Result<MeanAndVariance> expected = mean_and_variance(image.view());
        EXPECT_EQ(made->mean, expected->mean);
        EXPECT_EQ(made->variance, expected->variance);
    }
}

TEST(ReductionAccumulators, RefuseSidesThatAreTooLong) {
    EXPECT_EQ(SumAccumulator<Gray8>().begin({1, 40000}), Status::image_too_large);
    EXPECT_EQ(MeanAndVarianceAccumulator().begin({40000, 1}), Status::image_too_large);
}

}  // namespace
}  // namespace fovea::test
