// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include <core/filter/filter_check.hpp>
#include <fovea/base/list.hpp>
#include <fovea/draw/rectangle.hpp>
#include <fovea/feature/harris_points.hpp>

namespace fovea::test {
namespace {

struct Found {
    Status status;
    std::vector<HarrisPoint> points;
};

Found find(const GuardedImage<Gray8>& src, const HarrisPointOptions& options, int capacity = 2000,
           Border border = Border::replicate) {
    std::vector<std::uint8_t> scratch(
        static_cast<std::size_t>(harris_points_scratch(src.view().size(), options)), 0xee);
    Found found;
    found.points.resize(static_cast<std::size_t>(capacity));
    int count = 0;
    found.status = harris_points(src.view(), options, border,
                                 {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())},
                                 {found.points.data(), capacity, &count});
    found.points.resize(static_cast<std::size_t>(count));
    return found;
}

/// All maxima that reach their share, the strongest first, and greedily thinned.
std::vector<HarrisPoint> naive_points(const GuardedImage<Gray8>& src, const HarrisPointOptions& options) {
    const Size size = src.view().size();
    GuardedImage<Response32> map(size);
    run_filter(harris_response, harris_scratch(size), src, Border::replicate, map);
    std::int64_t highest = 0;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) highest = std::max<std::int64_t>(highest, map(x, y));
    std::vector<HarrisPoint> maxima;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const std::int64_t response = map(x, y);
            if (response <= 0 || response * 65536 < highest * options.quality.raw()) continue;
            bool strongest = true;
            for (int k = std::max(0, y - 1); k <= std::min(size.height - 1, y + 1); ++k)
                for (int i = std::max(0, x - 1); i <= std::min(size.width - 1, x + 1); ++i) {
                    const bool earlier = k < y || (k == y && i < x);
                    if (map(i, k) > response || (earlier && map(i, k) == response)) strongest = false;
                }
            if (strongest) maxima.push_back({{x, y}, map(x, y)});
        }
    std::stable_sort(maxima.begin(), maxima.end(),
                     [](const HarrisPoint& a, const HarrisPoint& b) { return a.response > b.response; });
    std::vector<HarrisPoint> kept;
    for (const HarrisPoint& point : maxima) {
        const bool free = std::none_of(kept.begin(), kept.end(), [&](const HarrisPoint& other) {
            const int dx = other.place.x - point.place.x, dy = other.place.y - point.place.y;
            return dx * dx + dy * dy < options.min_distance * options.min_distance;
        });
        if (free) kept.push_back(point);
    }
    return kept;
}

void expect_same(const std::vector<HarrisPoint>& found, const std::vector<HarrisPoint>& expected) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_EQ(found[i].place, expected[i].place) << i;
        EXPECT_EQ(found[i].response, expected[i].response) << i;
    }
}

TEST(HarrisPoints, AreTheFourCornersOfARectangle) {
    GuardedImage<Gray8> src({60, 40});
    src.fill(Gray8{30});
    ASSERT_EQ(fill_rectangle(src.view(), {15, 10, 30, 20}, Gray8{200}), Status::ok);
    const Found found = find(src, {});
    ASSERT_EQ(found.status, Status::ok);
    ASSERT_EQ(found.points.size(), 4u);
    for (const Point corner : {Point{15, 10}, Point{44, 10}, Point{15, 29}, Point{44, 29}})
        EXPECT_TRUE(std::any_of(found.points.begin(), found.points.end(),
                                [&](const HarrisPoint& p) {
                                    return std::abs(p.place.x - corner.x) <= 1 &&
                                           std::abs(p.place.y - corner.y) <= 1;
                                }))
            << corner.x << "," << corner.y;
}

TEST(HarrisPoints, OfAFlatImageAreNoneWhereTheToolkitFound80) {
    GuardedImage<Gray8> src({64, 48});
    for (const int level : {0, 128, 255}) {
        src.fill(static_cast<Gray8>(level));
        HarrisPointOptions options;
        options.quality = Ratio::from_raw(0);
        const Found found = find(src, options);
        EXPECT_EQ(found.status, Status::ok);
        EXPECT_TRUE(found.points.empty());
    }
}

TEST(HarrisPoints, EqualTheReferenceForAllOptions) {
    Random random(100);
    std::vector<Size> sizes = test_sizes();
    sizes.push_back({90, 70});
    for (const Size size : sizes)
        for (const int block : {1, 7}) {
            GuardedImage<Gray8> src(size), noise(size);
            noise.fill(random);
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x) src(x, y) = noise(x / block, y / block);
            for (const int quality : {0, 100, 9000, 65536})
                for (const int distance : {0, 1, 2, 5, 40, 32767}) {
                    HarrisPointOptions options;
                    options.quality = Ratio::from_raw(quality);
                    options.min_distance = distance;
                    options.candidates = 2000;
                    const Found found = find(src, options);
                    ASSERT_EQ(found.status, Status::ok);
                    expect_same(found.points, naive_points(src, options));
                }
        }
}

TEST(HarrisPoints, OfEqualResponsesTakeTheFirstOfThePicture) {
    // Four equal spots, too close to each other for more than one.
    GuardedImage<Gray8> src({40, 30});
    src.fill(Gray8{0});
    for (const Point spot : {Point{14, 12}, Point{22, 12}, Point{14, 20}, Point{22, 20}})
        src(spot.x, spot.y) = 200;
    HarrisPointOptions options;
    options.min_distance = 20;
    const Found found = find(src, options);
    ASSERT_EQ(found.points.size(), 1u);
    EXPECT_LE(found.points[0].place.y, 12);
    EXPECT_LE(found.points[0].place.x, 15);
}

TEST(HarrisPoints, KeepADistanceInAStraightLine) {
    GuardedImage<Gray8> src({40, 30});
    src.fill(Gray8{0});
    src(10, 10) = 250;
    src(16, 16) = 200;  // 6 by 6 is 8.49 away
    HarrisPointOptions options;
    options.quality = Ratio::from_raw(20000);
    const auto count = [&](int distance) {
        options.min_distance = distance;
        std::size_t near_spots = 0;
        for (const HarrisPoint& p : find(src, options).points)
            near_spots += (p.place == Point{10, 10} || p.place == Point{16, 16}) ? 1u : 0u;
        return near_spots;
    };
    EXPECT_EQ(count(8), 2u);
    EXPECT_EQ(count(9), 1u);
}

TEST(HarrisPoints, FillTheListWithTheStrongest) {
    Random random(101);
    GuardedImage<Gray8> src({90, 70});
    src.fill(random);
    HarrisPointOptions options;
    options.candidates = 5000;
    const Found all = find(src, options);
    ASSERT_EQ(all.status, Status::ok);
    ASSERT_GT(all.points.size(), 40u);
    const Found some = find(src, options, 17);
    EXPECT_EQ(some.status, Status::capacity_exceeded);
    expect_same(some.points, {all.points.begin(), all.points.begin() + 17});
    EXPECT_EQ(find(src, options, static_cast<int>(all.points.size())).status, Status::ok);
    // Too few candidates are told of, and what they give is what comes first.
    options.candidates = 20;
    const Found few = find(src, options);
    EXPECT_EQ(few.status, Status::capacity_exceeded);
    ASSERT_LE(few.points.size(), 20u);
    expect_same(few.points,
                {all.points.begin(), all.points.begin() + static_cast<std::ptrdiff_t>(few.points.size())});
}

TEST(HarrisPoints, SayWhatIsWrong) {
    GuardedImage<Gray8> src({40, 8});
    src.fill(Gray8{1});
    std::vector<std::uint8_t> bytes(100000);
    const Span<std::uint8_t> scratch(bytes.data(), 100000);
    List<HarrisPoint, 4> points;
    ASSERT_EQ(points.push({{1, 2}, 3}), Status::ok);
    const auto answer = [&](const HarrisPointOptions& options) {
        EXPECT_EQ(harris_points_scratch({40, 8}, options), 0);
        return harris_points(src.view(), options, Border::zero, scratch, points);
    };
    HarrisPointOptions wrong;
    wrong.quality = Ratio::from_raw(-1);
    EXPECT_EQ(answer(wrong), Status::bad_argument);
    wrong.quality = Ratio::from_raw(65537);
    EXPECT_EQ(answer(wrong), Status::bad_argument);
    wrong = {};
    wrong.min_distance = -1;
    EXPECT_EQ(answer(wrong), Status::bad_argument);
    wrong.min_distance = 32768;
    EXPECT_EQ(answer(wrong), Status::bad_argument);
    wrong = {};
    wrong.candidates = 0;
    EXPECT_EQ(answer(wrong), Status::bad_argument);
    wrong.candidates = 65536;
    EXPECT_EQ(answer(wrong), Status::bad_argument);
    EXPECT_EQ(harris_points({}, {}, Border::zero, scratch, points), Status::empty_image);
    const auto needed = static_cast<std::ptrdiff_t>(harris_points_scratch({40, 8}, {}));
    EXPECT_EQ(harris_points(src.view(), {}, Border::zero, scratch.first(needed - 1), points),
              Status::scratch_too_small);
    EXPECT_EQ(points.size(), 1);
    EXPECT_EQ(harris_points(src.view(), {}, Border::zero, scratch.first(needed), points), Status::ok);
    EXPECT_EQ(points.size(), 0);
}

}  // namespace
}  // namespace fovea::test
