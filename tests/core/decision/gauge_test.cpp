// SPDX-License-Identifier: MIT
//
// Accuracy of the whole measurement on rendered parts of known size: what docs/accuracy.md states.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include <fovea/decision/gauge.hpp>
#include <support/render.hpp>

namespace fovea::test {
namespace {

constexpr std::int64_t px = 1000000;

/// A stamped plate, in px about the middle of its rectangle: 180 x 70, one corner cut off by 30 x 20 (so that
/// its ends differ and it has an edge that is not parallel to the others), and two round holes.
constexpr double plate_length = 180;
constexpr double plate_height = 70;
struct RoundHole {
    double x, y, radius;
};
constexpr RoundHole holes[] = {{50, -2, 15}, {-48, 4, 9}};

bool plate(double s, double t) {
    if (std::abs(s) > plate_length / 2 || std::abs(t) > plate_height / 2) return false;
    if ((s - 60) / 30 + (t - 15) / 20 > 1) return false;
    for (const RoundHole& hole : holes)
        if (std::hypot(s - hole.x, t - hole.y) < hole.radius) return false;
    return true;
}

struct Pose {
    double x, y, angle;
};

GuardedImage<Gray8> picture(const Pose& pose, const Scene& scene, Random& random, Size size = {260, 240}) {
    const double c = std::cos(pose.angle);
    const double s = std::sin(pose.angle);
    return render(size, scene, random, [&](double x, double y) {
        const double u = x - pose.x;
        const double v = y - pose.y;
        return plate(u * c + v * s, v * c - u * s);
    });
}

PartPoint part_point(double x, double y) { return {std::llround(x * 1e6), std::llround(y * 1e6)}; }

Feature named(const char* name, FeatureKind kind) {
    Feature feature;
    for (int i = 0; name[i] != '\0'; ++i) feature.name[i] = name[i];
    feature.kind = kind;
    return feature;
}

std::vector<PartResult> run(ImageView<const Gray8> image, const Recipe& recipe, Status expected = Status::ok,
                            int capacity = 16) {
    std::vector<std::uint8_t> scratch(
        static_cast<std::size_t>(gauge_scratch(image.size(), recipe.locate, capacity)));
    std::vector<PartResult> parts(static_cast<std::size_t>(capacity));
    int count = 0;
    EXPECT_EQ(gauge(image, recipe, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())},
                    ListView<PartResult>(parts.data(), capacity, &count)),
              expected);
    parts.resize(static_cast<std::size_t>(count));
    return parts;
}

double degrees(FineAngle angle) { return angle.microdegrees() * 1e-6; }
double value_of(const FeatureResult& result) {
    return static_cast<double>(result.measurement.value.millionths) * 1e-6;
}

/// The offset of the plate's frame (centroid and axis) from the middle and side of its rectangle, from the
/// pixels of a perfect picture.
struct PlateFrame {
    double x, y, angle;
    PartPoint operator()(double s, double t) const {
        const double u = s - x;
        const double v = t - y;
        return part_point(u * std::cos(angle) + v * std::sin(angle),
                          v * std::cos(angle) - u * std::sin(angle));
    }
};
struct Taught {
    PlateFrame frame;
    Asymmetry ends;
};

Taught taught_plate() {
    Moments moments;
    constexpr int fine_steps = 8;
    for (int y = 0; y < 120 * fine_steps; ++y)
        for (int x = 0; x < 240 * fine_steps; ++x)
            if (plate((x + 0.5) / fine_steps - 120, (y + 0.5) / fine_steps - 60))
                moments.add_run(x, x + 1, y);
    const CentralMoments central = *central_moments(moments);
    const Orientation axis = *orientation(central);
    const double x = (real(central.centroid.x) + 0.5) / fine_steps - 120;
    const double y = (real(central.centroid.y) + 0.5) / fine_steps - 60;
    return {{x, y, degrees(axis.axis) * pi / 180}, *asymmetry(central, axis.axis)};
}

Recipe plate_recipe(const Taught& taught) {
    const PlateFrame& at = taught.frame;
    Recipe recipe;
    recipe.locate.ends = taught.ends;
    Feature length = named("length", FeatureKind::width);
    length.from = at(-100, -25);
    length.to = at(100, -25);
    Feature height = named("height", FeatureKind::distance);
    height.from = at(0, -45);
    height.to = at(0, 45);
    Feature large = named("large hole", FeatureKind::hole_diameter);
    large.centre = at(holes[0].x, holes[0].y);
    large.search = 5 * px;
    Feature small = large;
    small = named("small hole", FeatureKind::hole_diameter);
    small.centre = at(holes[1].x, holes[1].y);
    small.search = 5 * px;
    Feature around = named("large circle", FeatureKind::diameter);
    around.centre = at(holes[0].x + 1, holes[0].y - 1);
    around.radius = 15 * px;
    around.search = 6 * px;
    Feature corner = named("corner", FeatureKind::angle);
    corner.from = at(-80, 35);
    corner.to = at(50, 35);
    corner.second_from = at(64, 32.33);
    corner.second_to = at(86, 17.67);
    corner.search = 5 * px;
    Feature count = named("holes", FeatureKind::hole_count);
    Feature place = named("place", FeatureKind::position);
    place.centre = at(holes[0].x, holes[0].y);
    place.search = 5 * px;
    for (const Feature& feature : {length, height, large, small, around, corner, count, place})
        EXPECT_EQ(recipe.features.push(feature), Status::ok);
    return recipe;
}

/// Mean and standard deviation of what was collected.
struct Spread {
    double sum = 0, squares = 0, largest = 0;
    int count = 0;
    void add(double value) {
        largest = std::max(largest, std::abs(value));
        sum += value;
        squares += value * value;
        ++count;
    }
    double mean() const { return sum / count; }
    double deviation() const { return std::sqrt(std::max(squares / count - mean() * mean(), 0.0)); }
};

TEST(Gauge, TellsItsScratchWhenTheProgramIsCompiled) {
    // A chip sizes a static array with it.
    static_assert(gauge_scratch({160, 120}, LocateRule(), 4) > find_parts_scratch({160, 120}, LocateRule()));
    static_assert(find_parts_scratch({160, 120}, LocateRule()) > connected_components_scratch(160));
}

TEST(Gauge, MeasuresAPlateInTwoHundredPosesToASmallFractionOfAPixel) {
    Random random(111);
    const Taught taught = taught_plate();
    Recipe recipe = plate_recipe(taught);
    const double expected[] = {plate_length, plate_height, 30, 18, 30, std::atan2(20, 30) * 180 / pi, 2, 0};
    Spread errors[8];
    Spread angles;
    Spread centres;
    int certain = 0;
    for (int i = 0; i < 200; ++i) {
        Scene scene;
        scene.blur = uniform(random, 0.7, 1.5);
        scene.noise = 4;
        recipe.locate.dark_part = i % 2 == 0;
        if (!recipe.locate.dark_part) std::swap(scene.dark, scene.bright);
        const Pose pose{uniform(random, 125, 135), uniform(random, 115, 125), uniform(random, -pi, pi)};
        const GuardedImage<Gray8> image = picture(pose, scene, random);
        const std::vector<PartResult> parts = run(image.view(), recipe);
        ASSERT_EQ(parts.size(), 1u) << i;
        const PartResult& part = parts[0];
        ASSERT_EQ(part.pose.orientation, Status::ok) << i;
        certain += part.pose.ends_certain ? 1 : 0;
        double off = degrees(part.pose.frame.angle()) - (pose.angle + taught.frame.angle) * 180 / pi;
        off -= 360 * std::round(off / 360);
        angles.add(off);
        EXPECT_LT(std::abs(off), 90) << "the ends were exchanged in pose " << i;
        const double c = std::cos(pose.angle);
        const double s = std::sin(pose.angle);
        centres.add(std::hypot(
            real(part.pose.frame.origin().x) - (pose.x + taught.frame.x * c - taught.frame.y * s),
            real(part.pose.frame.origin().y) - (pose.y + taught.frame.x * s + taught.frame.y * c)));
        for (int k = 0; k < 8; ++k) {
            ASSERT_EQ(part.features[k].status, Status::ok) << i << " " << recipe.features[k].name;
            errors[k].add(value_of(part.features[k]) - expected[k]);
        }
    }
    EXPECT_EQ(certain, 200);
    for (int k = 0; k < 5; ++k) {
        EXPECT_LT(std::abs(errors[k].mean()), 0.02) << recipe.features[k].name;
        EXPECT_LT(errors[k].deviation(), 0.05) << recipe.features[k].name;
    }
    EXPECT_LT(std::abs(errors[5].mean()), 0.02);
    EXPECT_LT(errors[5].deviation(), 0.15);
    EXPECT_EQ(errors[6].deviation(), 0);
    EXPECT_LT(errors[7].mean(), 0.05);
    EXPECT_LT(angles.largest, 0.05);
    EXPECT_LT(centres.largest, 0.1);
    for (int k = 0; k < 8; ++k)
        std::printf("[ MEASURED ] %-12s mean error %+.4f, deviation %.4f\n", recipe.features[k].name,
                    errors[k].mean(), errors[k].deviation());
    std::printf("[ MEASURED ] %-12s mean error %+.4f deg, deviation %.4f deg, largest %.4f deg\n", "axis",
                angles.mean(), angles.deviation(), angles.largest);
    std::printf("[ MEASURED ] %-12s mean distance %.4f px, largest %.4f px\n", "centroid", centres.mean(),
                centres.largest);
}

}  // namespace
}  // namespace fovea::test
