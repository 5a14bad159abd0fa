// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/segment/fine_moments.hpp>
#include <support/render.hpp>

namespace fovea::test {
namespace {

struct Components {
    List<Region, 4> regions;
    List<Hole, 4> holes;
};

Components components_of(ImageView<const Gray8> image, LevelSet set, std::int64_t hole_area_min = 1) {
    GuardedImage<Gray8> binary(image.size());
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) binary(x, y) = set.contains(image(x, y)) ? 255 : 0;
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(connected_components_scratch(image.width())));
    ComponentOptions options;
    options.hole_area_min = hole_area_min;
    Components found;
    EXPECT_EQ(connected_components(binary.view(), options,
                                   {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())},
                                   found.regions, found.holes),
              Status::ok);
    return found;
}

constexpr LevelSet dark{125, true};

/// A disc of radius 20 around (x, y) with a hole of radius 7 at 6 px to the right.
GuardedImage<Gray8> ring(double x, double y, Random& random) {
    return render({56, 56}, Scene(), random, [&](double u, double v) {
        return std::hypot(u - x, v - y) < 20 && std::hypot(u - x - 6, v - y) > 7;
    });
}

TEST(FineMoments, AreThoseOfAWholePixelByHand) {
    GuardedImage<Gray8> image({5, 5});
    image.fill(Gray8{200});
    image(2, 3) = 49;
    const Components found = components_of(image.view(), dark);
    // From 49 to 200 the level 124.5 is crossed half way: a diamond of half a square pixel.
    const Result<CentralMoments> moments =
        fine_moments(image.view(), dark, found.regions[0], found.holes.span());
    ASSERT_TRUE(moments.ok());
    EXPECT_EQ(moments->centroid, fine(2, 3));
    EXPECT_EQ(moments->area, 1) << "rounded up";
    image(2, 3) = 51;
    EXPECT_EQ(fine_moments(image.view(), dark, found.regions[0], found.holes.span()).status(),
              Status::empty_image)
        << "less than half a pixel";
}

TEST(FineMoments, FollowTheEdgeWithinPixels) {
    Random random(681);
    for (int i = 0; i < 40; ++i) {
        const double x = uniform(random, 27, 29);
        const double y = uniform(random, 27, 29);
        const GuardedImage<Gray8> image = ring(x, y, random);
        const Components found = components_of(image.view(), dark);
        ASSERT_EQ(found.regions.size(), 1);
        ASSERT_EQ(found.holes.size(), 1);
        const auto filled = fine_moments(image.view(), dark, found.regions[0], {});
        const auto hole = fine_moments(image.view(), dark, found.holes[0]);
        const auto whole = fine_moments(image.view(), dark, found.regions[0], found.holes.span());
        ASSERT_TRUE(filled.ok() && hole.ok() && whole.ok());
        EXPECT_NEAR(real(filled->centroid.x), x, 0.02);
        EXPECT_NEAR(real(filled->centroid.y), y, 0.02);
        EXPECT_NEAR(real(hole->centroid.x), x + 6, 0.03);
        EXPECT_NEAR(real(hole->centroid.y), y, 0.03);
        // The law: the parts make the whole.
        EXPECT_NEAR(static_cast<double>(whole->area), static_cast<double>(filled->area - hole->area), 1);
        const double balanced = (static_cast<double>(filled->area) * (real(filled->centroid.x) - x) -
                                 static_cast<double>(hole->area) * (real(hole->centroid.x) - x)) /
                                static_cast<double>(whole->area);
        EXPECT_NEAR(real(whole->centroid.x) - x, balanced, 0.01);
    }
}

TEST(FineMoments, CountAHoleThatIsNotListedAsFilled) {
    Random random(682);
    const GuardedImage<Gray8> image = ring(28, 28, random);
    const Components found = components_of(image.view(), dark, 500);
    ASSERT_EQ(found.holes.size(), 0);
    const auto moments = fine_moments(image.view(), dark, found.regions[0], found.holes.span());
    EXPECT_NEAR(real(moments->centroid.x), 28, 0.02);
    EXPECT_NEAR(static_cast<double>(moments->area), pi * 400, 8) << "a blurred disc is seen s^2 / 2R smaller";
}

TEST(FineMoments, LeaveOutTheHolesOfOtherRegions) {
    Random random(683);
    const GuardedImage<Gray8> image = ring(28, 28, random);
    Components found = components_of(image.view(), dark);
    const auto filled = fine_moments(image.view(), dark, found.regions[0], {});
    found.holes[0].region = 1;
    const auto moments = fine_moments(image.view(), dark, found.regions[0], found.holes.span());
    EXPECT_EQ(moments->area, filled->area);
    EXPECT_EQ(moments->centroid, filled->centroid);
}

TEST(FineMoments, SayThatRegionAndImageDoNotBelongTogether) {
    Random random(684);
    const GuardedImage<Gray8> image = ring(28, 28, random);
    Components found = components_of(image.view(), dark);
    Region region = found.regions[0];
    region.first = {28, 56};
    EXPECT_EQ(fine_moments(image.view(), dark, region, {}).status(), Status::out_of_range);
    region.first = {0, 0};
    EXPECT_EQ(fine_moments(image.view(), dark, region, {}).status(), Status::bad_argument) << "ground";
    found.holes[0].first = {0, 28};
    EXPECT_EQ(fine_moments(image.view(), dark, found.regions[0], found.holes.span()).status(),
              Status::bad_argument)
        << "the ground goes on above";
    EXPECT_EQ(fine_moments({}, dark, found.holes[0]).status(), Status::empty_image);
}

TEST(FineMoments, OfTheLargestRegionsAreThoseOfTheirPixels) {
    GuardedImage<Gray8> image({4200, 3});
    image.fill(Gray8{200});
    for (int x = 50; x < 50 + 4096; ++x) image(x, 1) = 40;
    const Components found = components_of(image.view(), dark);
    const auto moments = fine_moments(image.view(), dark, found.regions[0], {});
    ASSERT_TRUE(moments.ok());
    EXPECT_EQ(moments->area, 4096);
    EXPECT_EQ(moments->centroid, fine(50 + 4095 / 2.0, 1));
}

TEST(FineSymmetry, GivesANutItsDirection) {
    Random random(683);
    for (int i = 0; i < 40; ++i) {
        const double x = uniform(random, 27, 29);
        const double y = uniform(random, 27, 29);
        const double turn = uniform(random, -pi, pi);
        Scene scene;
        scene.noise = 4;
        const GuardedImage<Gray8> image = render({56, 56}, scene, random, [&](double u, double v) {
            const double radius = std::hypot(u - x, v - y);
            const double angle = std::remainder(std::atan2(v - y, u - x) - turn, pi / 3);
            return radius * std::cos(angle) < 20 && radius > 9;
        });
        const Components found = components_of(image.view(), dark);
        ASSERT_EQ(found.regions.size(), 1);
        const Region& nut = found.regions[0];
        const CentralMoments moments = *fine_moments(image.view(), dark, nut, {});
        const auto symmetry = [&](Span<const Hole> holes, int order) {
            return fine_symmetry(image.view(), dark, nut, holes, moments.centroid, order,
                                 PixelAspect::from_int(1));
        };
        const Result<RotationalAxis> axis = symmetry({}, 6);
        ASSERT_TRUE(axis.ok());
        // The corners are rounded by the lens and cut by the contour: less than the 0.059 of a hexagon.
        EXPECT_NEAR(axis->strength.raw() / 65536.0, 0.055, 0.004);
        const double degrees = axis->axis.microdegrees() * 1e-6;
        EXPECT_LT(std::abs(std::remainder(degrees - turn * 180 / pi, 60)), 0.5) << i;
        // The hole is not part of the whole: the same harmonic has less area.
        const Result<RotationalAxis> with_hole = symmetry(found.holes.span(), 6);
        ASSERT_TRUE(with_hole.ok());
        EXPECT_GT(with_hole->strength.raw() * 100, axis->strength.raw() * 115);
        const Result<RotationalAxis> other = symmetry({}, 5);
        EXPECT_TRUE(!other || other->strength.raw() * 8 < axis->strength.raw());
    }
}

TEST(FineSymmetry, RefusesARegionOfAnotherImage) {
    GuardedImage<Gray8> image({9, 9});
    image.fill(Gray8{200});
    Region region;
    region.first = {4, 4};
    const auto status = [&] {
        return fine_symmetry(image.view(), dark, region, {}, fine(4, 4), 4, PixelAspect::from_int(1))
            .status();
    };
    EXPECT_EQ(status(), Status::bad_argument);
    region.first = {9, 4};
    EXPECT_EQ(status(), Status::out_of_range);
}

}  // namespace
}  // namespace fovea::test
