// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <fovea/decision/measure_feature.hpp>
#include <support/render.hpp>

namespace fovea::test {
namespace {

constexpr std::int64_t px = 1000000;
constexpr PartPoint at(double x, double y) {
    return {static_cast<std::int64_t>(x * px), static_cast<std::int64_t>(y * px)};
}
/// The renderer samples 16 places a pixel, so that a row of an upright edge is off by up to 1/32 px,
/// deviation 0.018 px. Over 9 lines and two edges that leaves 0.0085 px; three of these.
constexpr double sampling = 0.026;

double value_of(const Measurement& measurement) {
    return static_cast<double>(measurement.value.millionths) * 1e-6;
}

/// An upright plate of 80 x 40 px with a hole of radius 8 at (20, 0) from its middle, which is the origin.
class OnAPlate : public testing::Test {
protected:
    static constexpr double middle_x = 55.3;
    static constexpr double middle_y = 40.2;

    OnAPlate() : picture_(plate(1)) {
        locate(picture_.view());
        view_.frame = PartFrame(fine(middle_x, middle_y), FineAngle(), Scale());
    }

    /// The plate where rows are `aspect` times as far apart as columns.
    static GuardedImage<Gray8> plate(double aspect, const Scene& scene = Scene()) {
        Random random(641);
        const Size size{112, static_cast<int>(84 / aspect)};
        return render(size, scene, random, [aspect](double x, double y) {
            const double s = x - middle_x;
            const double t = y * aspect - middle_y;
            return std::abs(s) < 40 && std::abs(t) < 20 && std::hypot(s - 20, t) > 8;
        });
    }
    void locate(ImageView<const Gray8> image) {
        std::vector<std::uint8_t> scratch(
            static_cast<std::size_t>(find_parts_scratch(image.size(), view_.rule)));
        ASSERT_EQ(find_parts(image, view_.rule, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())},
                             view_.threshold, regions_, holes_),
                  Status::ok);
        ASSERT_EQ(regions_.size(), 1);
        view_.image = image;
        view_.region = &regions_[0];
        view_.holes = holes_.span();
    }
    Result<Measurement> measure(const Feature& feature) const {
        std::vector<std::uint8_t> scratch(
            static_cast<std::size_t>(measure_feature_scratch(view_.image.size())));
        return measure_feature(view_, feature, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())});
    }
    /// What is measured; the test fails if nothing is.
    double measured(const Feature& feature) const {
        const Result<Measurement> measurement = measure(feature);
        EXPECT_TRUE(measurement.ok()) << describe(measurement.status());
        return measurement ? value_of(*measurement) : std::nan("");
    }

    static Feature probe(FeatureKind kind, PartPoint from, PartPoint to) {
        Feature feature;
        feature.kind = kind;
        feature.from = from;
        feature.to = to;
        feature.lines = 9;
        return feature;
    }
    static Feature around(FeatureKind kind, PartPoint centre) {
        Feature feature;
        feature.kind = kind;
        feature.centre = centre;
        feature.radius = 8 * px;
        feature.search = 4 * px;
        return feature;
    }
    /// Between the upper edge, from left to right, and the right edge downwards.
    static Feature corner() {
        Feature feature;
        feature.kind = FeatureKind::angle;
        feature.from = at(-30, -20);
        feature.to = at(30, -20);
        feature.second_from = at(40, -15);
        feature.second_to = at(40, 15);
        feature.search = 4 * px;
        feature.probes = 16;
        return feature;
    }

    /// Makes the pixels around a place of the part as dark as it is.
    void darken(double x, double y, int half_width, int half_height) {
        const int column = static_cast<int>(std::lround(middle_x + x));
        const int row = static_cast<int>(std::lround(middle_y + y));
        for (int j = -half_height; j <= half_height; ++j)
            for (int i = -half_width; i <= half_width; ++i) picture_(column + i, row + j) = 30;
    }

    GuardedImage<Gray8> picture_;
    List<Region, 2> regions_;
    List<Hole, 4> holes_;
    PartView view_;
};

using MeasureFeature = OnAPlate;

TEST_F(MeasureFeature, GivesTheDistanceOfTwoEdgesByTheirNumbers) {
    Feature across = probe(FeatureKind::distance, at(-54, 0), at(55, 0));
    EXPECT_NEAR(measured(across), 80, sampling);
    // Edges at -40, 12, 28 and 40. On one line alone, because the hole's lie on a curve, they are off by
    // 0.018 px, and the hole's by s^2 / 2R = 0.08 px.
    across.lines = 1;
    across.second_edge = 2;
    EXPECT_NEAR(measured(across), 52, 0.2);
    across.first_edge = -2;
    across.second_edge = -1;
    EXPECT_NEAR(measured(across), 12, 0.2);
    across.first_edge = -1;
    across.second_edge = -2;
    EXPECT_NEAR(measured(across), 12, 0.2) << "in any order";
}

TEST_F(MeasureFeature, GivesTheWidthOfTheMaterialAcrossItsHoles) {
    EXPECT_NEAR(measured(probe(FeatureKind::width, at(-54, 0), at(55, 0))), 80, sampling);
    EXPECT_NEAR(measured(probe(FeatureKind::width, at(-10, -35), at(-10, 35))), 40, sampling);
    const Result<Measurement> width = measure(probe(FeatureKind::width, at(-10, -35), at(-10, 35)));
    ASSERT_EQ(width->mark_count, 2);
    EXPECT_NEAR(real(width->marks[0].x), middle_x - 10, 1e-4);
    EXPECT_NEAR(real(width->marks[0].y), middle_y - 20, sampling);
    EXPECT_NEAR(real(width->marks[1].y), middle_y + 20, sampling);
}

TEST_F(MeasureFeature, GivesTheDiameterOfACircleFromARoughPlace) {
    Feature circle = around(FeatureKind::diameter, at(21, -1));
    EXPECT_NEAR(measured(circle), 16, 0.03);
    circle.radius = 9 * px;
    EXPECT_NEAR(measured(circle), 16, 0.03);
    const Result<Measurement> found = measure(circle);
    ASSERT_EQ(found->mark_count, 1);
    EXPECT_NEAR(real(found->marks[0].x), middle_x + 20, 0.02);
    EXPECT_NEAR(real(found->marks[0].y), middle_y, 0.02);
}

TEST_F(MeasureFeature, GivesWhatIsAskedOfTheNearestHole) {
    EXPECT_NEAR(measured(around(FeatureKind::hole_diameter, at(20, 0))), 16, 0.03);
    EXPECT_NEAR(measured(around(FeatureKind::position, at(20, 0))), 0, 0.02);
    Feature beside = around(FeatureKind::position, at(23, 4));
    beside.search = 6 * px;
    EXPECT_NEAR(measured(beside), 5, 0.02);
    EXPECT_EQ(measured(around(FeatureKind::hole_count, at(0, 0))), 1);
}

TEST_F(MeasureFeature, GivesTheAngleBetweenTwoEdgesAsTheyPoint) {
    // 16 points of 0.018 px on 60 and on 30 px give 0.015 and 0.03 degrees; three of both together.
    constexpr double slope = 0.1;
    EXPECT_NEAR(measured(corner()), 90, slope);
    Feature straight = corner();
    straight.second_from = at(30, 20);
    straight.second_to = at(-30, 20);
    EXPECT_NEAR(measured(straight), 180, slope) << "the lower edge from right to left";
    std::swap(straight.second_from, straight.second_to);
    EXPECT_NEAR(measured(straight), 0, slope);
}

TEST_F(MeasureFeature, FollowsTheScaleOfTheImage) {
    const double columns = 0.02;
    const double rows = 0.03;
    const GuardedImage<Gray8> picture = plate(rows / columns);
    locate(picture.view());
    view_.scale = {LengthUnit::millimetre, std::llround(columns * 1e6), std::llround(rows * 1e6)};
    view_.frame = PartFrame(fine(middle_x, middle_y * columns / rows), FineAngle(), view_.scale);
    const auto mm = [&](PartPoint p) { return PartPoint{p.x / 50, p.y / 50}; };
    // A row is half as high again as a column is wide, and so are the errors of the renderer along y.
    EXPECT_NEAR(measured(probe(FeatureKind::width, mm(at(-54, -14)), mm(at(55, -14)))), 80 * columns,
                1.5 * sampling * columns);
    EXPECT_NEAR(measured(probe(FeatureKind::width, mm(at(-10, -33)), mm(at(-10, 33)))), 40 * columns,
                1.5 * sampling * columns);
    Feature circle = around(FeatureKind::diameter, mm(at(20, 0)));
    circle.radius /= 50;
    circle.search /= 50;
    EXPECT_NEAR(measured(circle), 16 * columns, 0.1 * columns);
    Feature angle = corner();
    for (PartPoint* p : {&angle.from, &angle.to, &angle.second_from, &angle.second_to}) *p = mm(*p);
    angle.search /= 50;
    EXPECT_NEAR(measured(angle), 90, 0.2);
}

TEST_F(MeasureFeature, SaysThatAnEdgeIsNotStraightUnderTheLinesOfItsProbe) {
    Feature across = probe(FeatureKind::width, at(-54, 0), at(55, 0));
    across.lines = 15;
    EXPECT_TRUE(measure(across)->regular);
    darken(42, 4, 4, 3);  // a burr of 6 px on the right edge, under 7 of 15 lines
    for (const FeatureKind kind : {FeatureKind::width, FeatureKind::distance}) {
        across.kind = kind;
        EXPECT_FALSE(measure(across)->regular);
    }
    across.from = at(-54, -12);
    across.to = at(55, -12);
    EXPECT_TRUE(measure(across)->regular) << "beside the burr";
    across.from = at(-54, 19);
    across.to = at(55, 19);
    EXPECT_FALSE(measure(across)->regular) << "half of the lines miss the part";
    across.smoothing = 8;
    EXPECT_TRUE(measure(probe(FeatureKind::width, at(-10, -35), at(-10, 35)))->regular);
}

TEST_F(MeasureFeature, SaysThatACircleIsNotRoundAllAround) {
    Feature circle = around(FeatureKind::diameter, at(20, 0));
    EXPECT_TRUE(measure(circle)->regular);
    circle.outliers = 0;
    EXPECT_TRUE(measure(circle)->regular);
    darken(12, 0, 3, 3);  // a burr of 3 px, 7 px wide, in the hole: 6.7 of 48 probes
    EXPECT_EQ(measure(circle).status(), Status::irregular);
    circle.outliers = 5;
    EXPECT_EQ(measure(circle).status(), Status::irregular);
    circle.outliers = 25;
    EXPECT_NEAR(measured(circle), 16, 0.2) << "of the rest, as before";
    circle.outliers = 51;
    EXPECT_EQ(measure(circle).status(), Status::bad_argument);
}

TEST_F(MeasureFeature, TakesNoiseForNoOtherShape) {
    // The noise moves every edge by 0.7 px, see position_noise() in edge_probe_test.cpp: one of six is off by
    // more than the smoothing.
    Scene scene;
    scene.blur = 2;
    scene.noise = 10;
    const GuardedImage<Gray8> noisy = plate(1, scene);
    view_.image = noisy.view();
    EXPECT_NEAR(measured(around(FeatureKind::diameter, at(20, 0))), 16, 0.9) << "four deviations of the mean";
}

TEST_F(MeasureFeature, SaysThatAProbeOrAPlaceLeavesTheImage) {
    EXPECT_EQ(measure(probe(FeatureKind::width, at(-56, 0), at(50, 0))).status(), Status::out_of_range);
    EXPECT_EQ(measure(probe(FeatureKind::distance, at(0, -30), at(0, 50))).status(), Status::out_of_range);
    EXPECT_EQ(measure(probe(FeatureKind::distance, at(0, 0), at(0, 50000))).status(), Status::out_of_range);
    Feature circle = around(FeatureKind::diameter, at(50, 0));
    EXPECT_EQ(measure(circle).status(), Status::out_of_range);
    Feature far = around(FeatureKind::position, at(90000, 0));
    far.search = max_part_coordinate;
    EXPECT_EQ(measure(far).status(), Status::out_of_range);
}

TEST_F(MeasureFeature, SaysThatNothingIsThere) {
    Feature edges = probe(FeatureKind::distance, at(-10, -35), at(-10, 35));
    edges.second_edge = 3;
    EXPECT_EQ(measure(edges).status(), Status::not_found) << "there are two";
    edges.second_edge = -3;
    EXPECT_EQ(measure(edges).status(), Status::not_found);
    edges.second_edge = -2;
    EXPECT_EQ(measure(edges).status(), Status::not_found) << "both are the first";
    EXPECT_EQ(measure(probe(FeatureKind::width, at(-30, -10), at(0, 10))).status(), Status::not_found);
    EXPECT_EQ(measure(around(FeatureKind::diameter, at(-20, 0))).status(), Status::not_found);
    EXPECT_EQ(measure(around(FeatureKind::hole_diameter, at(15, 0))).status(), Status::not_found);
    EXPECT_EQ(measure(around(FeatureKind::position, at(15, 0))).status(), Status::not_found);
    Feature beside = corner();
    beside.from.x = at(-54, 0).x;
    beside.to.x = at(-30, 0).x;
    EXPECT_EQ(measure(beside).status(), Status::not_found) << "less than half of the probes see the edge";
}

TEST_F(MeasureFeature, SaysThatTheEdgesGiveNoLine) {
    Feature point = corner();
    point.to = {point.from.x + 1, point.from.y};
    EXPECT_EQ(measure(point).status(), Status::degenerate);
}

TEST_F(MeasureFeature, RefusesFieldsThatItsKindCannotUse) {
    Feature edges = probe(FeatureKind::distance, at(-10, -35), at(-10, 500));
    edges.first_edge = 0;
    EXPECT_EQ(measure(edges).status(), Status::bad_argument) << "before the probe leaves the image";
    edges.first_edge = 1;
    edges.second_edge = 0;
    EXPECT_EQ(measure(edges).status(), Status::bad_argument);
    EXPECT_EQ(measure(probe(FeatureKind::width, at(1, 1), at(1, 1))).status(), Status::bad_argument);
    Feature circle = around(FeatureKind::diameter, at(20, 0));
    circle.radius = 0;
    EXPECT_EQ(measure(circle).status(), Status::bad_argument);
    circle = around(FeatureKind::diameter, at(20, 0));
    circle.search = 0;
    EXPECT_EQ(measure(circle).status(), Status::bad_argument);
    Feature angle = corner();
    angle.search = 0;
    EXPECT_EQ(measure(angle).status(), Status::bad_argument);
    EXPECT_EQ(measure(around(static_cast<FeatureKind>(7), at(20, 0))).status(), Status::bad_argument);
    Feature hostile = probe(FeatureKind::distance, at(-10, -35), at(-10, 35));
    hostile.contrast_min = 2147483647;
    EXPECT_EQ(measure(hostile).status(), Status::bad_argument);
    hostile = corner();
    hostile.second_to.x = -9223372036854775807 - 1;
    EXPECT_EQ(measure(hostile).status(), Status::bad_argument);
}

TEST_F(MeasureFeature, SaysThatAProbeMeetsTooManyEdges) {
    GuardedImage<Gray8> stripes({400, 9});
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 400; ++x) stripes(x, y) = x / 3 % 2 == 0 ? 30 : 220;
    view_.image = stripes.view();
    view_.frame = PartFrame(fine(200, 4), FineAngle(), Scale());
    // An edge every 3 px: 65 or 66 of them in 198 px, and 61 in 183.
    EXPECT_EQ(measure(probe(FeatureKind::distance, at(-100, 0), at(98, 0))).status(),
              Status::capacity_exceeded);
    EXPECT_EQ(measure(probe(FeatureKind::distance, at(-100, 0), at(83, 0))).status(), Status::ok);
}

TEST_F(MeasureFeature, NeedsAnImageAndItsScratchToTheByte) {
    const Feature feature = probe(FeatureKind::width, at(-54, -14), at(55, -14));
    const auto enough = static_cast<std::ptrdiff_t>(measure_feature_scratch(view_.image.size()));
    // From an odd address, where alignment costs most.
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(enough) + 1);
    EXPECT_EQ(measure_feature(view_, feature, {bytes.data() + 1, enough}).status(), Status::ok);
    EXPECT_EQ(measure_feature(view_, feature, {bytes.data() + 1, enough - 1}).status(),
              Status::scratch_too_small);
    EXPECT_EQ(measure_feature(view_, feature, {}).status(), Status::scratch_too_small);
    view_.image = ImageView<const Gray8>();
    EXPECT_EQ(measure_feature(view_, feature, {bytes.data(), enough}).status(), Status::empty_image);
}

}  // namespace
}  // namespace fovea::test
