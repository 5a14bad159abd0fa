// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/measure/edge_probe.hpp>
#include <support/guarded_image.hpp>
#include <support/render.hpp>

namespace fovea::test {
namespace {

struct Probed {
    Status status = Status::ok;
    std::vector<Edge> edges;
};

Probed probe(ImageView<const Gray8> image, const EdgeProbe& line, int strength_min = 20, int capacity = 64) {
    std::vector<std::uint16_t> scratch(
        static_cast<std::size_t>(std::max(edge_probe_scratch(image.size()), 0)));
    Probed probed;
    probed.edges.resize(static_cast<std::size_t>(capacity));
    int count = 0;
    probed.status = edge_probe(image, line, GrayLevel::from_int(strength_min),
                               {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())},
                               ListView<Edge>(probed.edges.data(), capacity, &count));
    probed.edges.resize(static_cast<std::size_t>(count));
    return probed;
}

/// A probe along a line with parallels one pixel apart.
EdgeProbe along(double x0, double y0, double x1, double y1, int lines = 1) {
    const double length = std::hypot(x1 - x0, y1 - y0);
    return {fine(x0, y0), fine(x1, y1), fine(-(y1 - y0) / length, (x1 - x0) / length), lines};
}

/// A straight edge with its normal at an angle, `offset` from (32, 32) along it: 30 before and 220 behind,
/// blurred by a Gaussian and integrated over every pixel.
GuardedImage<Gray8> straight_edge(double angle, double offset, double blur, double noise, Random& random) {
    GuardedImage<Gray8> image({64, 64});
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            double level = 0;
            for (int i = 0; i < 64; ++i) {
                const double u = x - 32.0 - 0.5 + (i % 8 + 0.5) / 8;
                const double v = y - 32.0 - 0.5 + (i / 8 + 0.5) / 8;
                level += 30 + 95 * std::erfc((offset - u * c - v * s) / (blur * std::sqrt(2.0)));
            }
            const double noisy = level / 64 + noise * normal(random);
            image(x, y) = static_cast<Gray8>(std::clamp(std::lround(noisy), 0L, 255L));
        }
    return image;
}

/// The same edge in every row, at column 32 + offset.
GuardedImage<Gray8> upright_edge(double offset, double blur) {
    Random random(1);
    return straight_edge(0, offset, blur, 0, random);
}

/// The standard deviation of the position of an edge of 190 levels that noise leaves, in px: the noise of the
/// second derivative of a Gaussian of 1 px, 0.46 per unit of noise a pixel, over the curvature of the first
/// at its extreme, 190 / (sqrt(2 pi) s^3), where s^2 is the sum of all variances along the edge.
double position_noise(double noise, double blur) {
    const double s = std::sqrt(blur * blur + 1 / 12.0 + 1 / 6.0 + 1);
    return noise * 0.46 * std::sqrt(2 * pi) * s * s * s / 190;
}
/// What rounding to whole grey levels adds, as noise of 1/sqrt(12) levels.
constexpr double rounding_noise = 0.2887;

TEST(EdgeProbe, FindsAnEdgeNearTheEndOfTheLongestDiagonal) {
    // Every row of the view is the same one.
    std::vector<Gray8> row(8191, Gray8{30});
    std::fill(row.begin() + 8000, row.end(), Gray8{220});
    const ImageView<const Gray8> image(row.data(), {8191, 8191}, 0);
    const Probed found = probe(image, along(0, 0, 8190, 8190));
    ASSERT_EQ(found.edges.size(), 1u);
    EXPECT_NEAR(real(found.edges[0].place.x), 7999.5, 0.01);
    EXPECT_NEAR(real(found.edges[0].place.y), 7999.5, 0.01);
}

TEST(EdgeProbe, FindsAStepBetweenTwoPixelsByHand) {
    GuardedImage<Gray8> image({20, 5});
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 20; ++x) image(x, y) = x < 10 ? 50 : 150;
    const Probed rising = probe(image.view(), along(2, 2, 17, 2));
    ASSERT_EQ(rising.status, Status::ok);
    ASSERT_EQ(rising.edges.size(), 1u);
    // The brightness is the same seen from both sides of 9.5, so the parabola has its top there.
    EXPECT_EQ(rising.edges[0].place, fine(9.5, 2));
    EXPECT_EQ(rising.edges[0].share.raw(), Unit::one / 2);
    EXPECT_GT(rising.edges[0].strength, GrayLevel::from_int(90));
    EXPECT_LE(rising.edges[0].strength, GrayLevel::from_int(100));
    const Probed falling = probe(image.view(), along(17, 2, 2, 2));
    ASSERT_EQ(falling.edges.size(), 1u);
    EXPECT_EQ(falling.edges[0].place, fine(9.5, 2));
    EXPECT_EQ(falling.edges[0].strength, -rising.edges[0].strength);
}

TEST(EdgeProbe, IsRightToTheRoundingOfGreyLevelsAtEveryFraction) {
    for (const double blur : {0.7, 1.0, 1.5, 2.0})
        for (int i = 0; i < 32; ++i) {
            const double offset = i / 32.0;
            const GuardedImage<Gray8> image = upright_edge(offset, blur);
            const Probed probed = probe(image.view(), along(15, 32, 50, 32));
            ASSERT_EQ(probed.edges.size(), 1u);
            EXPECT_NEAR(real(probed.edges[0].place.x), 32 + offset,
                        0.003 + 3 * position_noise(rounding_noise, blur))
                << "blur " << blur;
        }
}

TEST(EdgeProbe, AveragesNoiseOverParallelLines) {
    Random random(84);
    for (const double blur : {0.7, 1.0, 1.5}) {
        double sum = 0;
        double squares = 0;
        const int rounds = 200;
        for (int i = 0; i < rounds; ++i) {
            const double angle = uniform(random, 0, 2 * pi);
            const double offset = uniform(random, -4, 4);
            const GuardedImage<Gray8> image = straight_edge(angle, offset, blur, 4, random);
            const double c = std::cos(angle);
            const double s = std::sin(angle);
            const Probed probed =
                probe(image.view(), along(32 - 18 * c, 32 - 18 * s, 32 + 18 * c, 32 + 18 * s, 15));
            ASSERT_EQ(probed.edges.size(), 1u);
            const Edge& edge = probed.edges[0];
            const double error = (real(edge.place.x) - 32) * c + (real(edge.place.y) - 32) * s - offset;
            sum += error / rounds;
            squares += error * error / rounds;
        }
        const double expected = position_noise(std::hypot(4, rounding_noise), blur) / std::sqrt(15.0);
        // The mean of 200 is within 4 of its own deviations; the deviation itself within a quarter.
        EXPECT_NEAR(sum, 0, 4 * expected / std::sqrt(200.0)) << "blur " << blur;
        EXPECT_LT(std::sqrt(squares - sum * sum), 1.25 * expected) << "blur " << blur;
    }
}

TEST(EdgeProbe, SmoothingSteadiesABlurredEdge) {
    Random random(85);
    for (const int smoothing : {1, 2, 4}) {
        double squares = 0;
        for (int i = 0; i < 100; ++i) {
            const double offset = uniform(random, -1, 1);
            const GuardedImage<Gray8> image = straight_edge(0.3, offset, 3, 4, random);
            const double c = std::cos(0.3);
            const double s = std::sin(0.3);
            EdgeProbe line = along(32 - 26 * c, 32 - 26 * s, 32 + 26 * c, 32 + 26 * s, 9);
            line.smoothing = smoothing;
            const Probed probed = probe(image.view(), line, 20);
            ASSERT_EQ(probed.edges.size(), 1u) << smoothing;
            const Edge& edge = probed.edges[0];
            const double error = (real(edge.place.x) - 32) * c + (real(edge.place.y) - 32) * s - offset;
            squares += error * error / 100;
        }
        // As position_noise(), with the smoothing s for 1 px: s^(-5/2) of the noise, and s^2 in the variance.
        // From 4 samples in the smoothing the pixels are used less evenly: a third more.
        const double spread = std::sqrt(9 + 1 / 12.0 + 1 / 6.0 + smoothing * smoothing);
        const double expected = 4 * 0.46 * std::pow(smoothing, -2.5) * std::sqrt(2 * pi) *
                                std::pow(spread, 3) / 190 / std::sqrt(9.0);
        EXPECT_LT(std::sqrt(squares), 1.33 * expected) << "smoothing " << smoothing;
    }
}

TEST(EdgeProbe, TellsTheBlurOfTheImageToATenth) {
    for (const double blur : {0.7, 1.0, 1.5, 2.0, 3.0}) {
        double mean = 0;
        for (int i = 0; i < 16; ++i) {
            const GuardedImage<Gray8> image = upright_edge(i / 16.0, blur);
            mean += probe(image.view(), along(15, 32, 50, 32)).edges.at(0).blur.raw() / 65536.0 / 16;
        }
        // Lens, the square of a pixel (1/12) and bilinear sampling (1/6 on average). The last two are no
        // Gaussians.
        const double expected = blur * blur + 1 / 12.0 + 1 / 6.0;
        EXPECT_NEAR(mean, expected, 0.1 * expected) << "blur " << blur;
    }
}

TEST(EdgeProbe, GivesAllEdgesInOrderWithTheirSigns) {
    GuardedImage<Gray8> image({60, 9});
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 60; ++x) image(x, y) = (x / 12) % 2 == 0 ? 40 : 200;
    const Probed probed = probe(image.view(), along(2, 4, 57, 4, 5));
    ASSERT_EQ(probed.edges.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(real(probed.edges[i].place.x), 12 * static_cast<double>(i + 1) - 0.5, 1e-4);
        EXPECT_EQ(probed.edges[i].strength.raw() > 0, i % 2 == 0);
    }
    const Probed few = probe(image.view(), along(2, 4, 57, 4, 5), 20, 2);
    EXPECT_EQ(few.status, Status::capacity_exceeded);
    EXPECT_EQ(few.edges.size(), 2u);
    EXPECT_EQ(probe(image.view(), along(2, 4, 57, 4), 20, 4).status, Status::ok);
}

TEST(EdgeProbe, ShareAndPlaceAgreeAndFollowTheProbe) {
    Random random(83);
    for (int i = 0; i < 60; ++i) {
        const double angle = uniform(random, 0, 2 * pi);
        const double c = std::cos(angle);
        const double s = std::sin(angle);
        const double offset = uniform(random, -4, 4);
        const GuardedImage<Gray8> image = straight_edge(angle, offset, 1, 0, random);
        const Probed probed =
            probe(image.view(), along(32 - 20 * c, 32 - 20 * s, 32 + 20 * c, 32 + 20 * s, 9));
        ASSERT_EQ(probed.edges.size(), 1u);
        EXPECT_GT(probed.edges[0].strength.raw(), 0);
        const double found =
            (real(probed.edges[0].place.x) - 32) * c + (real(probed.edges[0].place.y) - 32) * s;
        EXPECT_NEAR(found, offset, 0.005);
        // Three roundings to 1/65536 px.
        EXPECT_NEAR(probed.edges[0].share.raw() / 1073741824.0 * 40 - 20, found, 3 / 65536.0);
    }
}

TEST(EdgeProbe, MovesWithTheImage) {
    const GuardedImage<Gray8> image = upright_edge(0.3, 1);
    const double here = real(probe(image.view(), along(15, 32, 50, 32)).edges.at(0).place.x);
    const auto cut = image.view().crop({5, 20, 50, 30});
    const double there = real(probe(*cut, along(10, 12, 45, 12)).edges.at(0).place.x);
    EXPECT_EQ(here, there + 5);
}

TEST(EdgeProbe, SeesEdgesCloseToItsEnds) {
    const GuardedImage<Gray8> image = upright_edge(0.3, 1);
    const Probed close = probe(image.view(), along(31.8, 32, 50, 32));
    ASSERT_EQ(close.edges.size(), 1u);
    EXPECT_NEAR(real(close.edges[0].place.x), 32.3, 0.01);
    EXPECT_TRUE(probe(image.view(), along(33.2, 32, 50, 32)).edges.empty());
}

TEST(EdgeProbe, WorksInTheSmallestImages) {
    GuardedImage<Gray8> row({2, 1});
    row(0, 0) = 0;
    row(1, 0) = 200;
    const Probed probed = probe(row.view(), along(0, 0, 1, 0));
    ASSERT_EQ(probed.edges.size(), 1u);
    EXPECT_EQ(probed.edges[0].place, fine(0.5, 0));
}

TEST(EdgeProbe, RefusesParallelsBeyondTheCoordinatesOfTheLongestRow) {
    GuardedImage<Gray8> row({max_image_side, 1});
    row.fill(Gray8{9});
    EdgeProbe line = along(32000, 0, 32010, 0, 255);
    line.across = fine(100, 0);
    EXPECT_EQ(probe(row.view(), line).status, Status::out_of_range);
    line.across = fine(-100, 0);
    EXPECT_EQ(probe(row.view(), line).status, Status::out_of_range);
}

TEST(EdgeProbe, SaysWhatIsWrongAndLeavesTheList) {
    GuardedImage<Gray8> image({20, 10});
    image.fill(Gray8{9});
    std::vector<std::uint16_t> scratch(static_cast<std::size_t>(edge_probe_scratch({20, 10})));
    const Span<std::uint16_t> enough(scratch.data(), static_cast<std::ptrdiff_t>(scratch.size()));
    List<Edge, 4> edges;
    ASSERT_EQ(edges.push(Edge()), Status::ok);
    const GrayLevel strong = GrayLevel::from_int(20);
    const EdgeProbe good = along(2, 5, 17, 5, 3);
    const auto with = [&](auto change) {
        EdgeProbe changed = good;
        change(changed);
        return edge_probe(image.view(), changed, strong, enough, edges);
    };
    EXPECT_EQ(edge_probe(ImageView<const Gray8>(), good, strong, enough, edges), Status::empty_image);
    EXPECT_EQ(edge_probe(image.view(), good, GrayLevel(), enough, edges), Status::bad_argument);
    EXPECT_EQ(with([](EdgeProbe& p) { p.lines = 0; }), Status::bad_argument);
    EXPECT_EQ(with([](EdgeProbe& p) { p.lines = 256; }), Status::bad_argument);
    EXPECT_EQ(with([](EdgeProbe& p) { p.smoothing = 0; }), Status::bad_argument);
    EXPECT_EQ(with([](EdgeProbe& p) { p.smoothing = 17; }), Status::bad_argument);
    EXPECT_EQ(with([](EdgeProbe& p) { p.smoothing = 16; }), Status::bad_argument) << "longer than the probe";
    EXPECT_EQ(with([](EdgeProbe& p) { p.to = p.from; }), Status::bad_argument);
    EXPECT_EQ(with([](EdgeProbe& p) { p.to.x = fine(19.1); }), Status::out_of_range);
    EXPECT_EQ(with([](EdgeProbe& p) { p.from.y = fine(-1); }), Status::out_of_range);
    EXPECT_EQ(with([](EdgeProbe& p) { p.lines = 11; }), Status::out_of_range);
    EXPECT_EQ(with([](EdgeProbe& p) { p.across.y = FinePixel::from_raw(2147483647); }), Status::out_of_range);
    EXPECT_EQ(with([](EdgeProbe& p) { p.from.x = FinePixel::from_raw(-2147483647 - 1); }),
              Status::out_of_range);
    EXPECT_EQ(edge_probe(image.view(), good, strong, enough.first(60), edges), Status::scratch_too_small);
    EXPECT_EQ(edges.size(), 1);
    EXPECT_EQ(edge_probe(image.view(), good, strong, enough, edges), Status::ok);
    EXPECT_EQ(edges.size(), 0);
}

}  // namespace
}  // namespace fovea::test
