// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vector>

#include <core/segment/contour_pictures.hpp>
#include <fovea/segment/connected_components.hpp>
#include <fovea/segment/region.hpp>

namespace fovea::test {
namespace {

TEST(FilterRegion, AcceptsWhatIsCompactByHand) {
    const RegionFilter filter;
    EXPECT_EQ(*filter_region(30, {0, 0, 10, 10}, filter), Compactness::compact);
    EXPECT_EQ(*filter_region(29, {0, 0, 10, 10}, filter), Compactness::not_compact);
    EXPECT_EQ(*filter_region(14, {0, 0, 7, 2}, filter), Compactness::compact);
    EXPECT_EQ(*filter_region(16, {0, 0, 2, 8}, filter), Compactness::not_compact);
    EXPECT_EQ(*filter_region(1, {5, 5, 1, 1}, filter), Compactness::compact);
}

TEST(FilterRegion, AreaLimitsAreInclusive) {
    RegionFilter filter;
    filter.area_min = 50;
    filter.area_max = 60;
    for (const int area : {49, 50, 60, 61})
        EXPECT_EQ(*filter_region(area, {0, 0, 10, 10}, filter),
                  area >= 50 && area <= 60 ? Compactness::compact : Compactness::not_compact);
}

TEST(FilterRegion, RefusesLimitsThatMakeNoSense) {
    const Rectangle box{0, 0, 5, 5};
    RegionFilter crossed, negative, below_one, above_one, side;
    crossed.area_min = crossed.area_max + 1;
    negative.area_min = -1;
    below_one.aspect_max = Ratio::from_ratio(1, 2);
    above_one.fill_min = Ratio::from_ratio(3, 2);
    side.side_min = -1;
    for (const RegionFilter& filter : {crossed, negative, below_one, above_one, side})
        EXPECT_EQ(filter_region(10, box, filter).status(), Status::bad_argument);
    EXPECT_EQ(filter_region(10, {0, 0, 0, 5}, RegionFilter()).status(), Status::bad_argument);
}

TEST(FirstMoments, AreThoseOfMoments) {
    Random random(21);
    for (int round = 0; round < 60; ++round) {
        const auto image = random_blocks({random.between(1, 50), random.between(1, 40)}, random);
        const int width = image.view().width();
        std::vector<std::uint8_t> a(static_cast<std::size_t>(connected_components_scratch(width)));
        std::vector<std::uint8_t> b(
            static_cast<std::size_t>(connected_components_scratch<FirstMoments>(width)));
        std::vector<Region> full(2000);
        std::vector<Hole> full_holes(2000);
        std::vector<RegionOf<FirstMoments>> light(2000);
        std::vector<HoleOf<FirstMoments>> light_holes(2000);
        int full_count = 0, full_hole_count = 0, light_count = 0, light_hole_count = 0;
        ASSERT_EQ(connected_components(image.view(), {}, {a.data(), static_cast<std::ptrdiff_t>(a.size())},
                                       ListView<Region>(full.data(), 2000, &full_count),
                                       ListView<Hole>(full_holes.data(), 2000, &full_hole_count)),
                  Status::ok);
        ASSERT_EQ(connected_components<FirstMoments>(
                      image.view(), {}, {b.data(), static_cast<std::ptrdiff_t>(b.size())},
                      {light.data(), 2000, &light_count}, {light_holes.data(), 2000, &light_hole_count}),
                  Status::ok);
        ASSERT_EQ(light_count, full_count);
        ASSERT_EQ(light_hole_count, full_hole_count);
        for (int i = 0; i < full_count; ++i) {
            const Region& p = full[static_cast<std::size_t>(i)];
            const auto& q = light[static_cast<std::size_t>(i)];
            ASSERT_EQ(q.moments.m00, p.moments.m00);
            ASSERT_EQ(q.moments.m10, p.moments.m10);
            ASSERT_EQ(q.moments.m01, p.moments.m01);
            ASSERT_EQ(q.box, p.box);
            ASSERT_EQ(q.first, p.first);
            ASSERT_EQ(q.holes, p.holes);
            ASSERT_EQ(q.hole_area, p.hole_area);
            ASSERT_EQ(q.moments.centroid(), central_moments(p.moments)->centroid);
        }
    }
}

}  // namespace
}  // namespace fovea::test
