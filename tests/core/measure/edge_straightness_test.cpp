// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/measure/edge_straightness.hpp>
#include <support/guarded_image.hpp>
#include <support/render.hpp>

namespace fovea::test {
namespace {

/// A dark part whose right border lies at border(y) in every row, blurred along the row by 1 px.
template <class Border>
GuardedImage<Gray8> with_border(Size size, double noise, Border border) {
    GuardedImage<Gray8> image(size);
    Random random(77);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const double level = 30 + 95 * std::erfc((border(y) - x) / std::sqrt(2.0));
            image(x, y) =
                static_cast<Gray8>(std::clamp(std::lround(level + noise * normal(random)), 0L, 255L));
        }
    return image;
}

/// A probe along row `y` of an image, with lines a row apart.
EdgeProbe along_row(int from, int to, int y, int lines) {
    return {fine(from, y), fine(to, y), fine(0, 1), lines};
}

struct Straightness {
    Status status = Status::ok;
    double stray = 0;
};

/// Of the strongest edge that the probe finds.
Straightness straightness(ImageView<const Gray8> image, const EdgeProbe& probe) {
    std::vector<std::uint16_t> scratch(static_cast<std::size_t>(edge_probe_scratch(image.size())));
    const Span<std::uint16_t> profile(scratch.data(), static_cast<std::ptrdiff_t>(scratch.size()));
    List<Edge, 32> edges;
    if (Status s = edge_probe(image, probe, GrayLevel::from_int(20), profile, edges); s != Status::ok)
        return {s};
    Edge best;
    for (const Edge& edge : edges)
        if (magnitude(edge.strength.raw()) > magnitude(best.strength.raw())) best = edge;
    const Result<FinePixel> stray = edge_straightness(image, probe, best, profile, edges);
    if (!stray) return {stray.status()};
    return {Status::ok, static_cast<double>(stray->raw()) / 65536};
}

/// The largest distance from the least-squares line through the mean borders of groups of rows.
template <class Border>
double stray_of(Border border, int y, int lines) {
    const int groups = std::clamp(lines / 4, std::min(lines, 3), 16);
    std::vector<double> t, p;
    for (int i = 0; i < groups; ++i) {
        double sum = 0;
        const int first = lines * i / groups;
        const int end = lines * (i + 1) / groups;
        for (int line = first; line < end; ++line) sum += border(y - (lines - 1) / 2 + line);
        t.push_back((first + end - 1) / 2.0 - (lines - 1) / 2.0);
        p.push_back(sum / (end - first));
    }
    double mt = 0, mp = 0, tt = 0, tp = 0;
    for (std::size_t i = 0; i < t.size(); ++i) {
        mt += t[i] / groups;
        mp += p[i] / groups;
    }
    for (std::size_t i = 0; i < t.size(); ++i) {
        tt += (t[i] - mt) * (t[i] - mt);
        tp += (t[i] - mt) * (p[i] - mp);
    }
    double most = 0;
    for (std::size_t i = 0; i < t.size(); ++i)
        most = std::max(most, std::abs(p[i] - mp - tp / tt * (t[i] - mt)));
    return most;
}

TEST(EdgeStraightness, IsAThirdOfTheStepOfOneOfThreeLinesByHand) {
    // Lines at 20, 20 and 24: the straight line through them is 19.33, 21.33, 23.33.
    const auto image = with_border({48, 9}, 0, [](int y) { return y == 5 ? 24.0 : 20.0; });
    const Straightness found = straightness(image.view(), along_row(6, 40, 4, 3));
    EXPECT_EQ(found.status, Status::ok);
    EXPECT_NEAR(found.stray, 4.0 / 3, 0.01);
}

TEST(EdgeStraightness, IsZeroOfFewerThanThreeLines) {
    const auto image = with_border({48, 9}, 0, [](int y) { return y == 4 ? 24.0 : 20.0; });
    for (const int lines : {1, 2})
        EXPECT_EQ(straightness(image.view(), along_row(6, 40, 4, lines)).stray, 0) << lines;
}

TEST(EdgeStraightness, EqualsTheReferenceOnRoundEdges) {
    for (const double radius : {12.0, 25.0, 60.0, 300.0})
        for (const int lines : {3, 5, 9, 15, 17}) {
            if (lines > 1.4 * radius) continue;
            const auto border = [&](int y) {
                return 30 - radius + std::sqrt(std::max(radius * radius - (y - 20.0) * (y - 20.0), 0.0));
            };
            const auto image = with_border({64, 41}, 0, border);
            const Straightness found = straightness(image.view(), along_row(8, 56, 20, lines));
            const double expected = stray_of(border, 20, lines);
            EXPECT_NEAR(found.stray, expected, 0.02 + expected / 30) << radius << " " << lines;
        }
}

TEST(EdgeStraightness, TakesAStraightEdgeForStraightHoweverItLies) {
    for (const double slope : {0.0, 0.02, -0.3, 0.8}) {
        const auto image = with_border({80, 41}, 4, [&](int y) { return 40.3 + slope * (y - 20); });
        for (const int lines : {3, 9, 15, 25}) {
            const Straightness found = straightness(image.view(), along_row(8, 72, 20, lines));
            EXPECT_EQ(found.status, Status::ok);
            EXPECT_LT(found.stray, 0.25) << slope << " " << lines;
        }
    }
}

TEST(EdgeStraightness, SeesABurrAndANickOfFourPixelsUnderAThirdOfTheLines) {
    for (const double step : {-4.0, 4.0, 7.0})
        for (int first = 8; first <= 24; ++first) {
            const auto image = with_border(
                {80, 41}, 4, [&](int y) { return y >= first && y < first + 8 ? 40.0 + step : 40.0; });
            EXPECT_GT(straightness(image.view(), along_row(8, 72, 20, 23)).stray, 1) << step << " " << first;
        }
}

TEST(EdgeStraightness, AnswersItsReachWhereThereIsNoEdge) {
    // The part ends in the middle of the lines: behind that there is only ground.
    const auto image = with_border({80, 41}, 0, [](int y) { return y < 21 ? 40.0 : -100.0; });
    const Straightness found = straightness(image.view(), along_row(8, 72, 20, 25));
    EXPECT_EQ(found.status, Status::ok);
    EXPECT_GT(found.stray, 2);
    EXPECT_LT(found.stray, static_cast<double>(straightness_reach(1).raw()) / 65536);
}

TEST(EdgeStraightness, LooksNoFartherThanTheProbeAndTheImage) {
    // Everything that may be read is there; the sanitizers see what else is.
    const auto image = with_border({21, 9}, 0, [](int) { return 2.0; });
    for (int y = 1; y < 8; ++y) {
        const Straightness found = straightness(image.view(), along_row(0, 20, y, y == 4 ? 9 : 3));
        EXPECT_EQ(found.status, Status::ok) << y;
        EXPECT_LT(found.stray, 0.05) << y;
    }
    // Lines half a pixel apart that end at the border of the image, where roundings must not lead out of it.
    EdgeProbe skew{fine(1, 1), fine(17, 5), fine(-0.25, 0.9), 4};
    skew.across = {FinePixel::from_raw(-12345), FinePixel::from_raw(43690)};
    EXPECT_EQ(straightness(image.view(), skew).status, Status::ok);
}

TEST(EdgeStraightness, SaysWhatIsWrongAsAProbeDoes) {
    const auto image = with_border({48, 9}, 0, [](int) { return 20.0; });
    List<Edge, 4> edges;
    std::uint16_t profile[512];
    Edge edge;
    const auto status = [&](ImageView<const Gray8> src, const EdgeProbe& probe, std::ptrdiff_t room) {
        return edge_straightness(src, probe, edge, Span<std::uint16_t>(profile).first(room), edges).status();
    };
    const EdgeProbe probe = along_row(6, 40, 4, 3);
    EXPECT_EQ(status(ImageView<const Gray8>(), probe, 512), Status::empty_image);
    EXPECT_EQ(status(image.view(), along_row(6, 40, 4, 0), 512), Status::bad_argument);
    EXPECT_EQ(status(image.view(), along_row(6, 6, 4, 3), 512), Status::bad_argument);
    EXPECT_EQ(status(image.view(), along_row(6, 60, 4, 3), 512), Status::out_of_range);
    EXPECT_EQ(status(image.view(), along_row(6, 40, 4, 13), 512), Status::out_of_range);
    EXPECT_EQ(status(image.view(), probe, 100), Status::scratch_too_small);
    // Where the list holds one edge alone it is the strongest.
    List<Edge, 1> one;
    ASSERT_EQ(edge_probe(image.view(), probe, GrayLevel::from_int(20), profile, one), Status::ok);
    edge = one[0];
    const Result<FinePixel> stray = edge_straightness(image.view(), probe, edge, profile, one);
    ASSERT_TRUE(stray);
    EXPECT_LT(stray->raw(), 65536 / 50);
}

}  // namespace
}  // namespace fovea::test
