// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include <core/segment/contour_pictures.hpp>
#include <fovea/segment/connected_components.hpp>
#include <fovea/segment/find_contours.hpp>

namespace fovea::test {
namespace {

struct Found {
    Status status = Status::ok;
    std::vector<std::vector<int>> borders;  ///< hole, then x and y of every point
    int points = 0;
};

std::vector<int> border_of(const Contour& contour, const std::vector<Point>& points) {
    std::vector<int> numbers = {contour.hole ? 1 : 0};
    for (int i = contour.first; i < contour.first + contour.count; ++i) {
        numbers.push_back(points[static_cast<std::size_t>(i)].x);
        numbers.push_back(points[static_cast<std::size_t>(i)].y);
    }
    return numbers;
}

Found found(const GuardedImage<Gray8>& image, Connectivity connectivity, ContourPoints wanted,
            int point_room = 30000, int contour_room = 3000) {
    std::vector<Point> points(static_cast<std::size_t>(point_room));
    std::vector<Contour> contours(static_cast<std::size_t>(contour_room));
    int point_count = 0, contour_count = 0;
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(find_contours_scratch(image.view().size())),
                                      0xee);
    Found answer;
    answer.status = find_contours(image.view(), connectivity, wanted,
                                  {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())},
                                  ListView<Point>(points.data(), point_room, &point_count),
                                  ListView<Contour>(contours.data(), contour_room, &contour_count));
    answer.points = point_count;
    for (int i = 0; i < contour_count; ++i)
        answer.borders.push_back(border_of(contours[static_cast<std::size_t>(i)], points));
    return answer;
}

/// The same by regions and holes.
std::vector<std::vector<int>> by_regions(const GuardedImage<Gray8>& image, Connectivity connectivity,
                                         ContourPoints wanted) {
    std::vector<Region> regions(3000);
    std::vector<Hole> holes(3000);
    std::vector<Point> points(30000);
    std::vector<Contour> contours(6000);
    int region_count = 0, hole_count = 0, point_count = 0, contour_count = 0;
    std::vector<std::uint8_t> scratch(
        static_cast<std::size_t>(connected_components_scratch(image.view().width())));
    ComponentOptions options;
    options.connectivity = connectivity;
    EXPECT_EQ(connected_components(image.view(), options,
                                   {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())},
                                   ListView<Region>(regions.data(), 3000, &region_count),
                                   ListView<Hole>(holes.data(), 3000, &hole_count)),
              Status::ok);
    EXPECT_EQ(trace_contours(image.view(), connectivity, wanted, {regions.data(), region_count},
                             {holes.data(), hole_count}, ListView<Point>(points.data(), 30000, &point_count),
                             ListView<Contour>(contours.data(), 6000, &contour_count)),
              Status::ok);
    std::vector<std::vector<int>> borders;
    for (int i = 0; i < contour_count; ++i)
        borders.push_back(border_of(contours[static_cast<std::size_t>(i)], points));
    return borders;
}

TEST(FindContours, FindsARingAndWhatLiesInIt) {
    const Found answer = found(drawn({"#####", "#...#", "#.#.#", "#...#", "#####"}), Connectivity::eight,
                               ContourPoints::corners);
    ASSERT_EQ(answer.borders.size(), 3u);
    EXPECT_EQ(answer.borders[0], (std::vector<int>{0, 0, 0, 4, 0, 4, 4, 0, 4}));
    EXPECT_EQ(answer.borders[1][0], 1);
    EXPECT_EQ(answer.borders[2], (std::vector<int>{0, 2, 2}));
}

TEST(FindContours, EqualsTheContoursOfRegionsAndHoles) {
    Random random(53);
    for (int round = 0; round < 200; ++round) {
        const auto image = random_blocks({random.between(1, 40), random.between(1, 30)}, random);
        const auto connectivity = round % 2 == 0 ? Connectivity::eight : Connectivity::four;
        const auto wanted = round % 3 == 0 ? ContourPoints::corners : ContourPoints::all;
        Found answer = found(image, connectivity, wanted);
        ASSERT_EQ(answer.status, Status::ok);
        auto expected = by_regions(image, connectivity, wanted);
        std::sort(answer.borders.begin(), answer.borders.end());
        std::sort(expected.begin(), expected.end());
        ASSERT_EQ(answer.borders, expected) << "round " << round;
    }
}

TEST(FindContours, GoesThroughSpiralsCombsAndFullImages) {
    EXPECT_EQ(found(spiral(61), Connectivity::eight, ContourPoints::all).borders.size(), 1u);
    EXPECT_EQ(found(comb({81, 31}), Connectivity::eight, ContourPoints::all).borders.size(), 1u);
    GuardedImage<Gray8> full({9, 7});
    full.fill(Gray8{255});
    EXPECT_EQ(found(full, Connectivity::four, ContourPoints::corners).borders,
              (std::vector<std::vector<int>>{{0, 0, 0, 8, 0, 8, 6, 0, 6}}));
    EXPECT_EQ(found(drawn({"#"}), Connectivity::four, ContourPoints::all).borders,
              (std::vector<std::vector<int>>{{0, 0, 0}}));
    EXPECT_TRUE(found(drawn({"...", "..."}), Connectivity::four, ContourPoints::all).borders.empty());
}

TEST(FindContours, KeepsWholeContoursWhenAListIsFull) {
    const auto image = drawn({"##.##.##", "##.##.##"});
    const Found few_points = found(image, Connectivity::eight, ContourPoints::all, 10);
    EXPECT_EQ(few_points.status, Status::capacity_exceeded);
    EXPECT_EQ(few_points.borders.size(), 2u);
    EXPECT_EQ(few_points.points, 8);
    const Found few_contours = found(image, Connectivity::eight, ContourPoints::all, 100, 1);
    EXPECT_EQ(few_contours.status, Status::capacity_exceeded);
    EXPECT_EQ(few_contours.points, 4);
}

TEST(FindContours, SaysWhatIsWrong) {
    GuardedImage<Gray8> image({4, 4});
    image.fill(Gray8{0});
    List<Point, 4> points;
    List<Contour, 4> contours;
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(find_contours_scratch({4, 4}) - 1));
    const Span<std::uint8_t> bytes{scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())};
    EXPECT_EQ(find_contours({}, Connectivity::eight, ContourPoints::all, bytes, points, contours),
              Status::empty_image);
    EXPECT_EQ(find_contours(ImageView<const Gray8>(image.view().first(), {40000, 1}, 40000),
                            Connectivity::eight, ContourPoints::all, bytes, points, contours),
              Status::image_too_large);
    EXPECT_EQ(find_contours(image.view(), Connectivity::eight, ContourPoints::all, bytes, points, contours),
              Status::scratch_too_small);
}

}  // namespace
}  // namespace fovea::test
