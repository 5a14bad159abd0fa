// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <string>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/segment/connected_components.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

struct Found {
    Status status = Status::ok;
    std::vector<Region> regions;
    std::vector<Hole> holes;
};

Found find(ImageView<const Gray8> binary, const ComponentOptions& options = {}, int capacity = 4096,
           std::int64_t scratch_bytes = -1) {
    if (scratch_bytes < 0) scratch_bytes = connected_components_scratch(std::max(binary.width(), 1));
    // A block of its own, so that the address sanitizer sees every step beyond it.
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(scratch_bytes));
    Found found;
    found.regions.resize(static_cast<std::size_t>(capacity));
    found.holes.resize(static_cast<std::size_t>(capacity));
    int regions = 0;
    int holes = 0;
    found.status =
        connected_components(binary, options, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())},
                             ListView<Region>(found.regions.data(), capacity, &regions),
                             ListView<Hole>(found.holes.data(), capacity, &holes));
    found.regions.resize(static_cast<std::size_t>(regions));
    found.holes.resize(static_cast<std::size_t>(holes));
    return found;
}

GuardedImage<Gray8> drawn(const std::vector<std::string>& rows) {
    GuardedImage<Gray8> image({static_cast<int>(rows[0].size()), static_cast<int>(rows.size())});
    for (int y = 0; y < image.view().height(); ++y)
        for (int x = 0; x < image.view().width(); ++x)
            image(x, y) = rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] == '#' ? 255 : 0;
    return image;
}

/// The slow obvious version: floods from every pixel that has no number yet.
Found naive(ImageView<const Gray8> image, const ComponentOptions& options) {
    const int w = image.width();
    const int h = image.height();
    std::vector<int> number(static_cast<std::size_t>(w * h), -1);
    const auto at = [&](int x, int y) -> int& { return number[static_cast<std::size_t>(y * w + x)]; };
    struct Flood {
        Region region;
        bool is_region;
    };
    std::vector<Flood> floods;
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x) {
            if (at(x, y) >= 0) continue;
            const bool is_region = image(x, y) != 0;
            const bool corners = is_region == (options.connectivity == Connectivity::eight);
            Flood flood{Region(), is_region};
            int box[4] = {x, y, x, y};
            flood.region.first = {x, y};
            std::deque<Point> open = {{x, y}};
            at(x, y) = static_cast<int>(floods.size());
            while (!open.empty()) {
                const Point p = open.front();
                open.pop_front();
                flood.region.moments.add_run(p.x, p.x + 1, p.y);
                box[0] = std::min(box[0], p.x);
                box[1] = std::min(box[1], p.y);
                box[2] = std::max(box[2], p.x);
                box[3] = std::max(box[3], p.y);
                if (p.x == 0 || p.y == 0 || p.x == w - 1 || p.y == h - 1) flood.region.at_border = true;
                for (int dy = -1; dy <= 1; ++dy)
                    for (int dx = -1; dx <= 1; ++dx) {
                        const Point q{p.x + dx, p.y + dy};
                        if (!image.contains(q) || (dx != 0 && dy != 0 && !corners)) continue;
                        if (at(q.x, q.y) >= 0 || (image(q.x, q.y) != 0) != is_region) continue;
                        at(q.x, q.y) = static_cast<int>(floods.size());
                        open.push_back(q);
                    }
            }
            flood.region.box = {box[0], box[1], box[2] - box[0] + 1, box[3] - box[1] + 1};
            floods.push_back(flood);
        }
    // The pixel left of a hole's first pixel belongs to the region around it.
    Found found;
    std::vector<int> place(floods.size(), -1);
    std::vector<std::pair<std::size_t, int>> holes;
    for (std::size_t i = 0; i < floods.size(); ++i) {
        const Region& hole = floods[i].region;
        if (floods[i].is_region || hole.at_border || hole.moments.area() < options.hole_area_min) continue;
        const int owner = at(hole.first.x - 1, hole.first.y);
        holes.push_back({i, owner});
        ++floods[static_cast<std::size_t>(owner)].region.holes;
        floods[static_cast<std::size_t>(owner)].region.hole_area += hole.moments.area();
    }
    for (std::size_t i = 0; i < floods.size(); ++i) {
        Region& region = floods[i].region;
        if (!floods[i].is_region || region.moments.area() < options.area_min ||
            region.moments.area() > options.area_max ||
            (region.at_border && options.at_border == BorderRegions::drop))
            continue;
        place[i] = static_cast<int>(found.regions.size());
        region.number = place[i];
        found.regions.push_back(region);
    }
    for (const auto& [i, owner] : holes)
        if (place[static_cast<std::size_t>(owner)] >= 0)
            found.holes.push_back({floods[i].region.moments, floods[i].region.box, floods[i].region.first,
                                   place[static_cast<std::size_t>(owner)]});
    return found;
}

bool same(const Moments& a, const Moments& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

void expect_same(const Found& a, const Found& b) {
    ASSERT_EQ(a.regions.size(), b.regions.size());
    ASSERT_EQ(a.holes.size(), b.holes.size());
    for (std::size_t i = 0; i < a.regions.size(); ++i) {
        const Region& p = a.regions[i];
        const Region& q = b.regions[i];
        ASSERT_TRUE(same(p.moments, q.moments));
        ASSERT_EQ(p.box, q.box);
        ASSERT_EQ(p.first, q.first);
        ASSERT_EQ(p.at_border, q.at_border);
        ASSERT_EQ(p.holes, q.holes);
        ASSERT_EQ(p.hole_area, q.hole_area);
        ASSERT_EQ(p.number, q.number);
    }
    for (std::size_t i = 0; i < a.holes.size(); ++i) {
        ASSERT_TRUE(same(a.holes[i].moments, b.holes[i].moments));
        ASSERT_EQ(a.holes[i].box, b.holes[i].box);
        ASSERT_EQ(a.holes[i].region, b.holes[i].region);
    }
}

TEST(ConnectedComponents, CountsRegionsAndHolesByHand) {
    const auto image = drawn(
        {"..........", ".#####.##.", ".#...#....", ".#.#.#..#.", ".#...#.#..", ".#####.#..", ".........."});
    const Found found = find(image.view());
    ASSERT_EQ(found.status, Status::ok);
    ASSERT_EQ(found.regions.size(), 4u);
    EXPECT_EQ(found.regions[0].moments.area(), 16);
    EXPECT_EQ(found.regions[0].holes, 1);
    EXPECT_EQ(found.regions[0].hole_area, 8);
    EXPECT_EQ(found.regions[0].box, (Rectangle{1, 1, 5, 5}));
    EXPECT_EQ(found.regions[1].first, (Point{7, 1}));
    EXPECT_EQ(found.regions[2].first, (Point{3, 3}));
    EXPECT_EQ(found.regions[3].moments.area(), 3);
    ASSERT_EQ(found.holes.size(), 1u);
    EXPECT_EQ(found.holes[0].region, 0);

    ComponentOptions four;
    four.connectivity = Connectivity::four;
    EXPECT_EQ(find(image.view(), four).regions.size(), 5u);
}

TEST(ConnectedComponents, AHoleBehindACornerDependsOnTheConnectivity) {
    const auto image = drawn({".....", ".###.", ".#.#.", ".##..", "....."});
    EXPECT_EQ(find(image.view()).holes.size(), 1u);
    ComponentOptions four;
    four.connectivity = Connectivity::four;
    EXPECT_EQ(find(image.view(), four).holes.size(), 0u);
}

TEST(ConnectedComponents, EqualTheReferenceOnRandomImages) {
    Random random(71);
    for (int round = 0; round < 300; ++round) {
        const Size size{random.between(1, 70), random.between(1, 40)};
        GuardedImage<Gray8> image(size);
        // From sparse to dense noise, and blocks that give long runs, rings and nested holes.
        const int density = random.between(5, 95);
        const int block = random.between(1, 6);
        std::vector<bool> cells(71 * 41);
        for (std::size_t i = 0; i < cells.size(); ++i) cells[i] = random.between(0, 99) < density;
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x)
                image(x, y) = cells[static_cast<std::size_t>(y / block * 71 + x / block)]
                                  ? static_cast<Gray8>(round % 3 == 0 ? 1 + x % 255 : 255)
                                  : Gray8{0};
        ComponentOptions options;
        options.connectivity = round % 2 == 0 ? Connectivity::eight : Connectivity::four;
        if (round % 5 == 1) options.at_border = BorderRegions::drop;
        if (round % 7 == 2) options.area_min = 5;
        if (round % 7 == 3) options.area_max = 30;
        if (round % 7 == 4) options.hole_area_min = 4;
        const Found found = find(image.view(), options);
        ASSERT_EQ(found.status, Status::ok);
        expect_same(found, naive(image.view(), options));
        ASSERT_FALSE(HasFatalFailure()) << "round " << round;
    }
}

TEST(ConnectedComponents, WithoutHolesAreTheSameRegions) {
    Random random(72);
    for (int round = 0; round < 100; ++round) {
        GuardedImage<Gray8> image({random.between(1, 70), random.between(1, 40)});
        const int density = random.between(5, 95);
        for (int y = 0; y < image.view().height(); ++y)
            for (int x = 0; x < image.view().width(); ++x)
                image(x, y) = random.between(0, 99) < density ? 255 : 0;
        ComponentOptions options;
        options.connectivity = round % 2 == 0 ? Connectivity::eight : Connectivity::four;
        Found with = find(image.view(), options);
        options.find_holes = false;
        const Found without = find(image.view(), options);
        ASSERT_EQ(without.status, Status::ok);
        EXPECT_TRUE(without.holes.empty());
        for (Region& region : with.regions) {
            region.holes = 0;
            region.hole_area = 0;
        }
        with.holes.clear();
        expect_same(without, with);
        ASSERT_FALSE(HasFatalFailure()) << "round " << round;
    }
}

TEST(ConnectedComponents, FullListsHoldTheLargestHolesAndTheirRegions) {
    Random random(73);
    for (int round = 0; round < 200; ++round) {
        GuardedImage<Gray8> image({random.between(20, 70), random.between(20, 40)});
        const int density = random.between(45, 75);
        for (int y = 0; y < image.view().height(); ++y)
            for (int x = 0; x < image.view().width(); ++x)
                image(x, y) = random.between(0, 99) < density ? 255 : 0;
        ComponentOptions options;
        options.connectivity = round % 2 == 0 ? Connectivity::eight : Connectivity::four;
        const Found all = find(image.view(), options);
        const auto room = static_cast<std::size_t>(random.between(1, 12));
        // Room for every region, and for the largest holes.
        List<Hole, 12> few;
        std::vector<std::uint8_t> scratch(
            static_cast<std::size_t>(connected_components_scratch(image.view().width())));
        List<Region, 3000> regions;
        int count = 0;
        const ListView<Hole> holes(few.begin(), static_cast<int>(room), &count);
        const Status status = connected_components(
            image.view(), options, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())},
            regions.view(), holes);
        ASSERT_EQ(status, all.holes.size() > room ? Status::capacity_exceeded : Status::ok);
        ASSERT_EQ(static_cast<std::size_t>(regions.size()), all.regions.size());
        std::vector<std::int64_t> areas;
        for (const Hole& hole : all.holes) areas.push_back(hole.moments.area());
        std::sort(areas.rbegin(), areas.rend());
        std::vector<std::int64_t> kept;
        for (const Hole& hole : holes) {
            kept.push_back(hole.moments.area());
            const auto same = std::find_if(all.holes.begin(), all.holes.end(), [&](const Hole& other) {
                return other.first.x == hole.first.x && other.first.y == hole.first.y;
            });
            ASSERT_NE(same, all.holes.end());
            EXPECT_EQ(hole.region, same->region) << round;
            EXPECT_EQ(hole.moments.m11, same->moments.m11);
        }
        std::sort(kept.rbegin(), kept.rend());
        areas.resize(std::min(areas.size(), room));
        EXPECT_EQ(kept, areas) << round;
    }
}

TEST(ConnectedComponents, NestRingsOfAnyDepth) {
    const int side = 41;
    GuardedImage<Gray8> image({side, side});
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const int ring = std::min({x, y, side - 1 - x, side - 1 - y});
            image(x, y) = ring % 2 == 1 ? 255 : 0;
        }
    const Found found = find(image.view());
    ASSERT_EQ(found.regions.size(), 10u);
    ASSERT_EQ(found.holes.size(), 10u);
    for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(found.holes[i].region, static_cast<int>(i));
}

TEST(ConnectedComponents, NeedNoMoreLabelsThanTheScratchFunctionSays) {
    // The most open labels: single pixels above single pixels, all apart.
    GuardedImage<Gray8> image({64, 9});
    image.fill(Gray8{0});
    for (int y = 0; y < 9; ++y)
        for (int x = y % 2; x < 64; x += 2) image(x, y) = 255;
    ComponentOptions four;
    four.connectivity = Connectivity::four;
    const Found found = find(image.view(), four);
    EXPECT_EQ(found.status, Status::ok);
    EXPECT_EQ(found.regions.size(), 9u * 32u);
}

TEST(ConnectedComponents, SayWhenLabelsRunOutAndGiveNothing) {
    GuardedImage<Gray8> image({64, 3});
    image.fill(Gray8{0});
    for (int x = 0; x < 64; x += 2) image(x, 1) = 255;
    const Found few = find(image.view(), {}, 100, connected_components_scratch(64, 20));
    EXPECT_EQ(few.status, Status::scratch_too_small);
    EXPECT_TRUE(few.regions.empty());
    EXPECT_EQ(find(image.view(), {}, 100, connected_components_scratch(64, 35)).status, Status::ok);
}

TEST(ConnectedComponents, AFullListKeepsTheLargest) {
    // Columns of height 1..8 with gaps.
    GuardedImage<Gray8> image({17, 10});
    image.fill(Gray8{0});
    for (int i = 1; i <= 8; ++i)
        for (int y = 1; y <= i; ++y) image(2 * i - 1, y) = 255;
    const Found found = find(image.view(), {}, 3);
    EXPECT_EQ(found.status, Status::capacity_exceeded);
    ASSERT_EQ(found.regions.size(), 3u);
    for (const Region& region : found.regions) EXPECT_GE(region.moments.area(), 6);
}

TEST(ConnectedComponents, AFullListDropsTheHolesOfWhatItDrops) {
    const auto image =
        drawn({"###......", "#.#......", "###......", ".........", "....#####", "....#...#", "....#####"});
    const Found found = find(image.view(), {}, 1);
    EXPECT_EQ(found.status, Status::capacity_exceeded);
    ASSERT_EQ(found.regions.size(), 1u);
    EXPECT_EQ(found.regions[0].moments.area(), 12);
    ASSERT_EQ(found.holes.size(), 1u);
    EXPECT_EQ(found.holes[0].region, 0);
    EXPECT_EQ(found.holes[0].moments.area(), 3);
}

TEST(ConnectedComponents, SayWhatIsWrong) {
    GuardedImage<Gray8> image({8, 8});
    image.fill(Gray8{0});
    ComponentOptions crossed;
    crossed.area_min = 10;
    crossed.area_max = 9;
    ComponentOptions negative;
    negative.hole_area_min = -1;
    EXPECT_EQ(find(ImageView<const Gray8>()).status, Status::empty_image);
    EXPECT_EQ(find(image.view(), crossed).status, Status::bad_argument);
    EXPECT_EQ(find(image.view(), negative).status, Status::bad_argument);
    EXPECT_EQ(find(image.view(), {}, 8, connected_components_scratch(8, 1) - 1).status,
              Status::scratch_too_small);
    EXPECT_EQ(find(image.view(), {}, 8, 0).status, Status::scratch_too_small);
    std::vector<Gray8> wide(8192);
    EXPECT_EQ(find(ImageView<const Gray8>(wide.data(), {8192, 1}, 8192)).status, Status::image_too_large);
    EXPECT_EQ(find(ImageView<const Gray8>(wide.data(), {1, 8192}, 1)).status, Status::image_too_large);
}

}  // namespace
}  // namespace fovea::test
