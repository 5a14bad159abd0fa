// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <vector>

#include <fovea/decision/locate.hpp>
#include <support/render.hpp>

namespace fovea::test {
namespace {

struct Found {
    Status status = Status::ok;
    Threshold threshold;
    List<Region, 8> parts;
    List<Hole, 8> holes;
};

Found find(ImageView<const Gray8> image, const LocateRule& rule, std::ptrdiff_t less = 0) {
    const auto bytes = static_cast<std::ptrdiff_t>(find_parts_scratch(image.size(), rule)) - less;
    // From an odd address, where alignment costs most.
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(bytes) + 1);
    Found found;
    EXPECT_EQ(found.parts.push(Region()), Status::ok);
    found.status =
        find_parts(image, rule, {scratch.data() + 1, bytes}, found.threshold, found.parts, found.holes);
    return found;
}
PartPose pose_in(ImageView<const Gray8> image, const LocateRule& rule) {
    const Found found = find(image, rule);
    EXPECT_EQ(found.status, Status::ok);
    EXPECT_EQ(found.parts.size(), 1);
    if (found.parts.empty()) return PartPose();
    const Result<PartMoments> moments =
        moments_of(image, rule, found.threshold.part, found.parts[0], found.holes.span(), Scale());
    EXPECT_TRUE(moments.ok());
    return moments ? pose_of(*moments, rule, Scale()) : PartPose();
}

void fill(GuardedImage<Gray8>& image, Rectangle area, Gray8 level) {
    for (int y = area.y; y <= area.bottom(); ++y)
        for (int x = area.x; x <= area.right(); ++x) image(x, y) = level;
}
/// Bright ground with a plate of 200 px that has a hole of 12, a bar of 60 px, and a bar of 40 at the border.
GuardedImage<Gray8> three_parts() {
    GuardedImage<Gray8> image({64, 40});
    image.fill(Gray8{200});
    fill(image, {30, 4, 20, 10}, 40);
    fill(image, {35, 7, 4, 3}, 200);
    fill(image, {6, 20, 3, 20}, 40);
    fill(image, {20, 25, 10, 4}, 40);
    return image;
}

TEST(FindParts, ListsPartsAndHolesWithinTheGates) {
    const GuardedImage<Gray8> image = three_parts();
    LocateRule rule;
    rule.area_min = 30;
    rule.hole_area_min = 12;
    const Found found = find(image.view(), rule);
    ASSERT_EQ(found.status, Status::ok);
    ASSERT_EQ(found.parts.size(), 2) << "one touches the border";
    EXPECT_EQ(found.parts[0].box, (Rectangle{30, 4, 20, 10}));
    EXPECT_EQ(found.parts[0].moments.area(), 188);
    EXPECT_EQ(found.parts[0].holes, 1);
    EXPECT_EQ(found.parts[1].moments.area(), 40);
    ASSERT_EQ(found.holes.size(), 1);
    EXPECT_EQ(found.holes[0].region, 0);
    EXPECT_EQ(found.threshold.contrast, GrayLevel::from_int(160));

    rule.at_border = true;
    EXPECT_EQ(find(image.view(), rule).parts.size(), 3);
    rule.area_min = 41;
    rule.area_max = 187;
    EXPECT_EQ(find(image.view(), rule).parts.size(), 1) << "the bar at the border";
    rule.area_max = 188;
    rule.hole_area_min = 13;
    const Found large = find(image.view(), rule);
    EXPECT_EQ(large.parts.size(), 2);
    EXPECT_EQ(large.holes.size(), 0);
    EXPECT_EQ(large.parts[0].holes, 0);
}

TEST(FindParts, FindsTheSameInTheNegative) {
    GuardedImage<Gray8> image = three_parts();
    LocateRule rule;
    rule.area_min = 30;
    const Found dark = find(image.view(), rule);
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 64; ++x) image(x, y) = static_cast<Gray8>(255 - image(x, y));
    EXPECT_EQ(find(image.view(), rule).parts.size(), 0) << "the ground touches the border, the hole is small";
    rule.dark_part = false;
    const Found bright = find(image.view(), rule);
    ASSERT_EQ(bright.parts.size(), dark.parts.size());
    for (int i = 0; i < dark.parts.size(); ++i) EXPECT_EQ(bright.parts[i].box, dark.parts[i].box);
}

TEST(FindParts, ClearsHairsByOpening) {
    GuardedImage<Gray8> image = three_parts();
    fill(image, {40, 13, 1, 20}, 40);
    LocateRule rule;
    rule.area_min = 30;
    EXPECT_EQ(find(image.view(), rule).parts[0].box, (Rectangle{30, 4, 20, 29}));
    rule.opening = 3;
    EXPECT_EQ(find(image.view(), rule).parts[0].box, (Rectangle{30, 4, 20, 10}));
}

TEST(FindParts, SaysWhatIsWrongAndLeavesTheLists) {
    const GuardedImage<Gray8> image = three_parts();
    GuardedImage<Gray8> even({20, 20});
    even.fill(Gray8{9});
    const Gray8 pixel = 0;
    const LocateRule good;
    LocateRule bad;
    bad.opening = 2;
    const auto refused = [](const Found& found) {
        EXPECT_EQ(found.parts.size(), 1) << "what was in the list before";
        return found.status;
    };
    EXPECT_EQ(refused(find({}, good)), Status::empty_image);
    EXPECT_EQ(refused(find({&pixel, {max_moment_side + 1, 1}, 0}, bad)), Status::image_too_large);
    EXPECT_EQ(refused(find(image.view(), bad)), Status::bad_argument);
    EXPECT_EQ(refused(find(even.view(), good)), Status::degenerate);
    for (const int opening : {1, 3}) {
        LocateRule rule;
        rule.opening = opening;
        EXPECT_EQ(find(image.view(), rule).status, Status::ok);
        const auto all = static_cast<std::ptrdiff_t>(find_parts_scratch(image.view().size(), rule));
        EXPECT_EQ(refused(find(image.view(), rule, all)), Status::scratch_too_small);
    }
}

TEST(ThresholdOf, FollowsTheRuleByHand) {
    Histogram histogram;
    std::vector<Gray8> row(60, Gray8{40});
    row.insert(row.end(), 40, Gray8{200});
    histogram.add_row(row.data(), 100);
    LocateRule rule;
    // All levels 41..200 split alike; their middle, rounded down.
    EXPECT_EQ(threshold_of(histogram, rule)->part.level, 120);
    EXPECT_EQ(threshold_of(histogram, rule)->contrast, GrayLevel::from_int(160));
    rule.threshold = ThresholdRule::fixed;
    rule.level = 41;
    EXPECT_EQ(threshold_of(histogram, rule)->part.level, 41);
    rule.threshold = ThresholdRule::quantile;
    EXPECT_EQ(threshold_of(histogram, rule)->part.level, 120);
    rule.dark_part = false;
    EXPECT_FALSE(threshold_of(histogram, rule)->part.below);
}

TEST(ThresholdOf, IsDegenerateWhenAClassIsEmpty) {
    LocateRule rule;
    EXPECT_EQ(threshold_of(Histogram(), rule).status(), Status::empty_image);
    Histogram histogram;
    const Gray8 row[] = {40, 40, 200};
    histogram.add_row(row, 3);
    rule.threshold = ThresholdRule::fixed;
    rule.level = 40;
    EXPECT_EQ(threshold_of(histogram, rule).status(), Status::degenerate);
    rule.level = 201;
    EXPECT_EQ(threshold_of(histogram, rule).status(), Status::degenerate);
    rule.threshold = ThresholdRule::quantile;
    rule.bright_quantile = rule.dark_quantile;
    EXPECT_EQ(threshold_of(histogram, rule).status(), Status::degenerate);
}

using Inside = std::function<bool(double, double)>;

/// A part that lies at (48, 48), turned.
GuardedImage<Gray8> turned(const Inside& inside, double angle, Random& random, double noise = 3) {
    Scene scene;
    scene.noise = noise;
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return render({96, 96}, scene, random, [&](double x, double y) {
        return inside((x - 48) * c + (y - 48) * s, (y - 48) * c - (x - 48) * s);
    });
}
bool bar(double s, double t) { return std::abs(s) < 36 && std::abs(t) < 14; }
bool disc(double s, double t) { return std::hypot(s, t) < 30; }
/// A bar whose one end has a hole of that radius.
Inside holed_bar(double radius) {
    return [radius](double s, double t) { return bar(s, t) && std::hypot(s - 26, t) > radius; };
}

TEST(PoseOf, HasNoDirectionOfADisc) {
    Random random(661);
    const GuardedImage<Gray8> image = turned(disc, 0, random);
    LocateRule rule;
    EXPECT_EQ(pose_in(image.view(), rule).orientation, Status::degenerate);
    rule.orientation = OrientationRule::symmetric;
    EXPECT_EQ(pose_in(image.view(), rule).orientation, Status::degenerate);
    rule.orientation = OrientationRule::none;
    const PartPose pose = pose_in(image.view(), rule);
    EXPECT_EQ(pose.orientation, Status::ok);
    EXPECT_EQ(pose.frame.angle(), FineAngle());
    EXPECT_NEAR(real(pose.frame.origin().x), 48, 0.05);
    EXPECT_NEAR(real(pose.frame.origin().y), 48, 0.05);
}

TEST(PoseOf, DoesNotTellTheEndsOfABarApart) {
    Random random(662);
    const GuardedImage<Gray8> image = turned(bar, 0.5, random);
    LocateRule rule;
    EXPECT_EQ(pose_in(image.view(), rule).orientation, Status::undecided);
    rule.orientation = OrientationRule::symmetric;
    const PartPose pose = pose_in(image.view(), rule);
    EXPECT_EQ(pose.orientation, Status::ok);
    EXPECT_FALSE(pose.ends_certain);
    EXPECT_NEAR(pose.frame.angle().microdegrees() * 1e-6, 0.5 * 180 / pi, 0.1);
}

TEST(PoseOf, TurnsWithASquareWhenItsSymmetryIsTold) {
    Random random(665);
    const auto square = [](double s, double t) { return std::abs(s) < 25 && std::abs(t) < 25; };
    LocateRule rule;
    rule.orientation = OrientationRule::rotational;
    rule.symmetry_order = 4;
    for (const int opening : {1, 3}) {
        rule.opening = opening;
        rule.pose = opening == 1 ? PoseRule::region : PoseRule::outline;
        for (int i = 0; i < 20; ++i) {
            const double angle = uniform(random, -pi, pi);
            const PartPose pose = pose_in(turned(square, angle, random).view(), rule);
            EXPECT_EQ(pose.orientation, Status::ok);
            EXPECT_FALSE(pose.ends_certain);
            const double off = pose.frame.angle().microdegrees() * 1e-6 - angle * 180 / pi;
            EXPECT_LT(std::abs(std::remainder(off, 90)), 0.1) << opening << " " << i;
        }
    }
    rule.symmetry_order = 3;
    EXPECT_EQ(pose_in(turned(square, 0.5, random).view(), rule).orientation, Status::degenerate);
    EXPECT_EQ(pose_in(turned(disc, 0, random).view(), rule).orientation, Status::degenerate);
}

TEST(PoseOf, HasNoSymmetryWhereTheContourGoesAroundTwoPartsThatAnOpeningCutApart) {
    Random random(667);
    const auto pair = [](double s, double t) {
        const bool square = std::abs(std::abs(s) - 20) < 11 && std::abs(t) < 11;
        return square || (std::abs(s) < 20 && std::abs(t) < 1);
    };
    LocateRule rule;
    rule.orientation = OrientationRule::rotational;
    rule.opening = 5;
    rule.pose = PoseRule::outline;
    const GuardedImage<Gray8> image = turned(pair, 0.5, random);
    const Found found = find(image.view(), rule);
    ASSERT_EQ(found.parts.size(), 2);
    for (const Region& region : found.parts) {
        const Result<PartMoments> moments =
            moments_of(image.view(), rule, found.threshold.part, region, found.holes.span(), Scale());
        ASSERT_TRUE(moments.ok());
        EXPECT_EQ(pose_of(*moments, rule, Scale()).orientation, Status::degenerate);
    }
}

TEST(PoseOf, TurnsWithTheHolesOfAFlange) {
    Random random(666);
    const auto flange = [](double s, double t) {
        if (std::hypot(s, t) > 34) return false;
        for (int i = 0; i < 4; ++i)
            if (std::hypot(s - 22 * std::cos(i * pi / 2), t - 22 * std::sin(i * pi / 2)) < 5) return false;
        return true;
    };
    LocateRule rule;
    rule.orientation = OrientationRule::rotational;
    for (int i = 0; i < 20; ++i) {
        const double angle = uniform(random, -pi, pi);
        const GuardedImage<Gray8> image = turned(flange, angle, random);
        rule.pose = PoseRule::region;
        const PartPose pose = pose_in(image.view(), rule);
        EXPECT_EQ(pose.orientation, Status::ok);
        const double off = pose.frame.angle().microdegrees() * 1e-6 - angle * 180 / pi;
        EXPECT_LT(std::abs(std::remainder(off, 90)), 0.3) << i;
        rule.pose = PoseRule::outline;
        EXPECT_EQ(pose_in(image.view(), rule).orientation, Status::degenerate);
    }
}

TEST(PoseOf, RestsOnTheOutlineWhenAskedTo) {
    Random random(663);
    LocateRule rule;
    rule.orientation = OrientationRule::none;
    const GuardedImage<Gray8> small = turned(holed_bar(4), 0.5, random, 0);
    const GuardedImage<Gray8> large = turned(holed_bar(6), 0.5, random, 0);
    const auto moved = [&] {
        const FinePoint a = pose_in(small.view(), rule).frame.origin();
        const FinePoint b = pose_in(large.view(), rule).frame.origin();
        return std::hypot(real(a.x) - real(b.x), real(a.y) - real(b.y));
    };
    // The hole takes pi r^2 of 2016 px at 26 px from the middle: 0.66 px with r = 4, 1.55 px with r = 6.
    EXPECT_NEAR(moved(), 0.88, 0.1);
    rule.pose = PoseRule::outline;
    EXPECT_LT(moved(), 0.01);
    rule.opening = 3;
    EXPECT_LT(moved(), 0.2) << "by whole pixels";
}

TEST(PoseOf, IsNeverWrongAboutTheEndsWhenItIsCertain) {
    Random random(664);
    for (const double radius : {2.0, 3.4, 3.8, 6.0}) {
        const Inside shape = holed_bar(radius);
        LocateRule rule;
        rule.hole_area_min = 4;
        const GuardedImage<Gray8> model = turned(shape, 0, random, 0);
        const Found found = find(model.view(), rule);
        ASSERT_EQ(found.parts.size(), 1);
        const Result<PartMoments> moments =
            moments_of(model.view(), rule, found.threshold.part, found.parts[0], found.holes.span(), Scale());
        ASSERT_TRUE(moments.ok());
        rule.ends = *asymmetry(moments->region, FineAngle());
        int certain = 0;
        constexpr int poses = 50;
        for (int i = 0; i < poses; ++i) {
            const double angle = uniform(random, -pi, pi);
            const GuardedImage<Gray8> image = turned(shape, angle, random, 6);
            const PartPose pose = pose_in(image.view(), rule);
            EXPECT_EQ(pose.ends_certain, pose.orientation == Status::ok);
            if (!pose.ends_certain) continue;
            ++certain;
            const double off = pose.frame.angle().microdegrees() * 1e-6 * pi / 180 - angle;
            EXPECT_GT(std::cos(off), 0.99) << "radius " << radius << ", pose " << i;
        }
        EXPECT_TRUE(certain == poses || radius < 4) << radius;
        std::printf("[ MEASURED ] a hole of radius %.1f px: %d of %d certain\n", radius, certain, poses);
    }
}

}  // namespace
}  // namespace fovea::test
