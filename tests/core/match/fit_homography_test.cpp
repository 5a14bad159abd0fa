// SPDX-License-Identifier: MIT
#include <fovea/match/fit_homography.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <fovea/base/random.hpp>
#include <support/scalars.hpp>

namespace fovea {
namespace {

using test::value_of;

SubPixelPoint sub_pixel(double x, double y) {
    return {SubPixel::from_raw(static_cast<std::int32_t>(std::lround(x * 256))),
            SubPixel::from_raw(static_cast<std::int32_t>(std::lround(y * 256)))};
}

struct Pairs {
    std::vector<PlanePoint> plane;
    std::vector<SubPixelPoint> image;

    void add(int x, int y, double u, double v) {
        plane.push_back({x, y});
        image.push_back(sub_pixel(u, v));
    }
    Span<const PlanePoint> from() const { return {plane.data(), static_cast<std::ptrdiff_t>(plane.size())}; }
    Span<const SubPixelPoint> to() const { return {image.data(), static_cast<std::ptrdiff_t>(image.size())}; }
};

/// A board of 54 corners, seen as a random homography does, with noise.
Pairs random_view(Random& random, int noise) {
    double h[9];
    for (int i = 0; i < 9; ++i) h[i] = random.between(-1000, 1000) / 1000.0;
    Pairs pairs;
    for (int y = 0; y < 6; ++y) {
        for (int x = 0; x < 9; ++x) {
            const double weight = 1 + 0.01 * (h[6] * x + h[7] * y);
            const double u = 300 + 30 * ((1 + 0.3 * h[0]) * x + 0.5 * h[1] * y) / weight;
            const double v = 100 + 30 * (0.5 * h[3] * x + (1 + 0.3 * h[4]) * y) / weight;
            const double du = random.between(-noise, noise) / 256.0;
            const double dv = random.between(-noise, noise) / 256.0;
            pairs.add(x * 25, y * 25, u + du, v + dv);
        }
    }
    return pairs;
}

TEST(FitHomographyTest, FourCornersOfASquareGoWhereTheyShould) {
    // (0, 0) (1, 0) (1, 1) (0, 1) to a trapezium: by hand, the divisor is 1 + y.
    Pairs pairs;
    pairs.add(0, 0, 0, 0);
    pairs.add(2, 0, 8, 0);
    pairs.add(2, 2, 4, 2);
    pairs.add(0, 2, 0, 2);
    const auto h = fit_homography(pairs.from(), pairs.to());
    ASSERT_TRUE(h);
    // At the mean, (1, 1), the divisor 1 + y / 2 is 3 / 2.
    const double expected[9] = {4, 0, 0, 0, 2, 0, 0, 0.5, 1};
    for (int i = 0; i < 9; ++i)
        EXPECT_NEAR(static_cast<double>(value_of((*h)(i / 3, i % 3))), expected[i] / 1.5, 1e-15) << i;
    const auto place = map_point(*h, Vector<2>(Real::from_int(2), Real::from_int(2)));
    ASSERT_TRUE(place);
    EXPECT_NEAR(static_cast<double>(value_of((*place)[0])), 4, 1e-15);
    EXPECT_NEAR(static_cast<double>(value_of((*place)[1])), 2, 1e-15);
    EXPECT_EQ(map_point(*h, Vector<2>(Real::from_int(0), Real::from_int(-3))).status(), Status::out_of_range);
}

TEST(FitHomographyTest, WithinADoublesErrorOfTheSameInDouble) {
    Random random(31);
    double worst = 0;
    for (int k = 0; k < 30; ++k) {
        const Pairs pairs = random_view(random, 100);
        const auto h = fit_homography(pairs.from(), pairs.to());
        const auto d = fit_homography<double>(pairs.from(), pairs.to());
        ASSERT_TRUE(h && d);
        for (const PlanePoint place : pairs.plane) {
            const auto a = map_point(*h, Vector<2>(Real::from_int(place.x), Real::from_int(place.y)));
            const auto b = map_point(*d, Vector<2, double>(double(place.x), double(place.y)));
            for (int i = 0; i < 2; ++i)
                worst = std::max(worst, std::abs(static_cast<double>(value_of((*a)[i]) - (*b)[i])));
        }
    }
    EXPECT_LT(worst, 1e-11);
    EXPECT_GT(worst, 0);
}

TEST(FitHomographyTest, NoSmallStepFitsBetter) {
    // The sum of (u w - h0 x - h1 y - h2)^2 has its minimum there, with w = 1 at the mean.
    Random random(32);
    const Pairs pairs = random_view(random, 200);
    const auto h = fit_homography<double>(pairs.from(), pairs.to());
    ASSERT_TRUE(h);
    double middle[2] = {0, 0};
    for (const PlanePoint place : pairs.plane) {
        middle[0] += place.x;
        middle[1] += place.y;
    }
    for (double& side : middle) side = std::floor(side / 54);
    const auto error = [&](const Matrix<3, 3, double>& map) {
        const double unit = map(2, 0) * middle[0] + map(2, 1) * middle[1] + map(2, 2);
        // The fit takes pixels from their mean.
        double mean[2] = {0, 0};
        for (const SubPixelPoint seen : pairs.image) {
            mean[0] += seen.x.raw();
            mean[1] += seen.y.raw();
        }
        double sum = 0;
        for (std::size_t i = 0; i < pairs.plane.size(); ++i) {
            const Vector<3, double> image =
                map * Vector<3, double>(double(pairs.plane[i].x), double(pairs.plane[i].y), 1.0);
            for (int a = 0; a < 2; ++a) {
                const double seen = a == 0 ? pairs.image[i].x.raw() : pairs.image[i].y.raw();
                const double rest = (seen / 256 * image[2] - image[a]) / unit;
                sum += rest * rest;
            }
        }
        return sum;
    };
    const double least = error(*h);
    for (int i = 0; i < 8; ++i) {
        for (const double step : {1e-4, -1e-4}) {
            Matrix<3, 3, double> other = *h;
            other(i / 3, i % 3) *= 1 + step;
            EXPECT_GT(error(other), least) << i;
        }
    }
}

TEST(FitHomographyTest, FromPixelsAsFromPlane) {
    Random random(33);
    Pairs pairs = random_view(random, 100);
    std::vector<SubPixelPoint> from;
    for (const PlanePoint place : pairs.plane) from.push_back(sub_pixel(place.x, place.y));
    const Span<const SubPixelPoint> span(from.data(), static_cast<std::ptrdiff_t>(from.size()));
    const auto a = fit_homography(pairs.from(), pairs.to());
    const auto b = fit_homography(span, pairs.to());
    const auto c = fit_affine(pairs.from(), pairs.to());
    const auto d = fit_affine(span, pairs.to());
    ASSERT_TRUE(a && b && c && d);
    // The means differ by what is less than a whole unit: the same transforms to a factor, nearly.
    for (int i = 0; i < 9; ++i) {
        const Real difference = (*a)(i / 3, i % 3) / (*a)(2, 2) - (*b)(i / 3, i % 3) / (*b)(2, 2);
        EXPECT_LT(value_of(difference.absolute()), 1e-2) << i;
    }
    for (int i = 0; i < 6; ++i)
        EXPECT_LT(value_of(((*c)(i / 3, i % 3) - (*d)(i / 3, i % 3)).absolute()), 1e-15) << i;
}

TEST(FitAffineTest, ThreePlacesByHand) {
    Pairs pairs;
    pairs.add(1000, 0, 10, 20);
    pairs.add(1010, 0, 15, 20);
    pairs.add(1000, 10, 10, 10);
    const auto a = fit_affine(pairs.from(), pairs.to());
    ASSERT_TRUE(a);
    const double expected[6] = {0.5, 0, -490, 0, -1, 20};
    for (int i = 0; i < 6; ++i)
        EXPECT_NEAR(static_cast<double>(value_of((*a)(i / 3, i % 3))), expected[i], 1e-13) << i;
}

TEST(FitHomographyTest, RefusesWhatDeterminesNone) {
    Pairs pairs;
    for (int i = 0; i < 3; ++i) pairs.add(i * i, i, i * 10, i * i * 7);
    EXPECT_EQ(fit_homography(pairs.from(), pairs.to()).status(), Status::bad_argument);
    EXPECT_EQ(fit_homography(pairs.from(), pairs.to().first(2)).status(), Status::size_mismatch);
    EXPECT_EQ(fit_homography(Span<const PlanePoint>(), Span<const SubPixelPoint>()).status(),
              Status::bad_argument);
    EXPECT_TRUE(fit_affine(pairs.from(), pairs.to()));
    EXPECT_EQ(fit_affine(pairs.from().first(2), pairs.to().first(2)).status(), Status::bad_argument);

    // All but one on a line, there and in the picture.
    Pairs line;
    for (int i = 0; i < 9; ++i) line.add(i * 7, i * 3, i * 31 % 17, i * i);
    EXPECT_EQ(fit_homography(line.from(), line.to()).status(), Status::degenerate);
    EXPECT_EQ(fit_affine(line.from(), line.to()).status(), Status::degenerate);
    Pairs both;
    for (int i = 0; i < 9; ++i) both.add(i * 7, i * 3, 5 + i * 2, 9 + i * 4);
    both.add(0, 100, 3, 4);
    EXPECT_EQ(fit_homography(both.from(), both.to()).status(), Status::degenerate);
    EXPECT_TRUE(fit_affine(both.from(), both.to()));
    Pairs same;
    for (int i = 0; i < 9; ++i) same.add(i, i * i, 5, 5);
    EXPECT_EQ(fit_homography(same.from(), same.to()).status(), Status::degenerate);

    // The divisor 1 - x / 10 is above 0 at the mean of the places and below at the third.
    Pairs beyond;
    beyond.add(0, 0, 0, 0);
    beyond.add(8, 0, 40, 0);
    beyond.add(12, 8, -60, -40);
    beyond.add(0, 8, 0, 8);
    EXPECT_EQ(fit_homography(beyond.from(), beyond.to()).status(), Status::degenerate);

    Pairs far;
    const int most = std::numeric_limits<std::int32_t>::max();
    far.add(-most - 1, 0, 0, 0);
    far.add(most, 0, 10, 0);
    far.add(most, most, 10, 10);
    far.add(0, most, 0, 10);
    EXPECT_EQ(fit_homography(far.from(), far.to()).status(), Status::out_of_range);
    EXPECT_EQ(fit_affine(far.from(), far.to()).status(), Status::out_of_range);
}

TEST(FitHomographyTest, TakesTheEndsOfItsRange) {
    Pairs pairs;
    const int most = 1 << 26;
    pairs.add(-most, -most, -262144, -262144);
    pairs.add(most, -most, 262144, -262144);
    pairs.add(most, most, 262144, 262144);
    pairs.add(-most, most, -262144, 262144);
    const auto h = fit_homography(pairs.from(), pairs.to());
    ASSERT_TRUE(h);
    for (int i = 0; i < 9; ++i)
        EXPECT_NEAR(static_cast<double>(value_of((*h)(i / 3, i % 3))),
                    i == 8       ? 1
                    : i % 4 == 0 ? 1 / 256.0
                                 : 0,
                    1e-15);
}

}  // namespace
}  // namespace fovea
