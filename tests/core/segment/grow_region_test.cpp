// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vector>

#include <core/segment/contour_pictures.hpp>
#include <fovea/segment/grow_region.hpp>

namespace fovea::test {
namespace {

struct Grown {
    Result<RegionOf<FirstMoments>> region = Status::not_found;
    GuardedImage<Gray8> mask;
};

Grown grow(const GuardedImage<Gray8>& src, Point seed, Connectivity connectivity, int runs = 100,
           Gray8 low = 1, Gray8 high = 255) {
    Grown grown{Status::not_found, GuardedImage<Gray8>(src.view().size())};
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(grow_region_scratch(runs)));
    grown.region =
        grow_region(src.view(), seed, low, high, connectivity,
                    {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}, grown.mask.view());
    return grown;
}

/// Spreads from pixel to pixel until nothing changes.
GuardedImage<Gray8> naive(const GuardedImage<Gray8>& src, Point seed, Connectivity connectivity) {
    GuardedImage<Gray8> mask(src.view().size());
    mask.fill(Gray8{0});
    std::vector<Point> open = {seed};
    mask(seed.x, seed.y) = 255;
    while (!open.empty()) {
        const Point p = open.back();
        open.pop_back();
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx) {
                const Point q{p.x + dx, p.y + dy};
                if ((dx != 0 && dy != 0 && connectivity == Connectivity::four) || !src.view().contains(q))
                    continue;
                if (src(q.x, q.y) == 0 || mask(q.x, q.y) != 0) continue;
                mask(q.x, q.y) = 255;
                open.push_back(q);
            }
    }
    return mask;
}

TEST(GrowRegion, FillsWhatHoldsTogetherByHand) {
    const auto image = drawn({"##...", ".#.#.", "..#..", "....."});
    const Grown eight = grow(image, {0, 0}, Connectivity::eight);
    ASSERT_TRUE(eight.region);
    EXPECT_EQ(eight.region->moments.area(), 5);
    EXPECT_EQ(eight.region->box, (Rectangle{0, 0, 4, 3}));
    EXPECT_EQ(eight.region->first, (Point{0, 0}));
    EXPECT_TRUE(eight.region->at_border);
    const Grown four = grow(image, {1, 1}, Connectivity::four);
    ASSERT_TRUE(four.region);
    EXPECT_EQ(four.region->moments.area(), 3);
    EXPECT_EQ(four.mask(3, 1), 0);
}

TEST(GrowRegion, ASeedInTheBackgroundIsNotFoundAndNoRegionOfOnePixel) {
    const auto image = drawn({"#.", ".."});
    const Grown none = grow(image, {1, 1}, Connectivity::eight);
    EXPECT_EQ(none.region.status(), Status::not_found);
    for (int i = 0; i < 4; ++i) EXPECT_EQ(none.mask(i % 2, i / 2), 0);
}

TEST(GrowRegion, TheCentroidOfALargeRegionIsInItsMiddle) {
    GuardedImage<Gray8> image({3000, 2000});
    image.fill(Gray8{255});
    const Grown all = grow(image, {17, 1999}, Connectivity::four);
    ASSERT_TRUE(all.region);
    EXPECT_EQ(all.region->moments.area(), 6000000);
    EXPECT_EQ(all.region->moments.centroid(),
              (FinePoint{FinePixel::from_ratio(2999, 2), FinePixel::from_ratio(1999, 2)}));
}

TEST(GrowRegion, EqualsTheReferenceWithAnyStack) {
    Random random(31);
    for (int round = 0; round < 150; ++round) {
        auto image = random_blocks({random.between(1, 40), random.between(1, 30)}, random);
        const Point seed{random.between(0, image.view().width() - 1),
                         random.between(0, image.view().height() - 1)};
        image(seed.x, seed.y) = 7;
        const auto connectivity = round % 2 == 0 ? Connectivity::eight : Connectivity::four;
        const auto expected = naive(image, seed, connectivity);
        FirstMoments sums;
        Point first{-1, -1};
        for (int y = 0; y < image.view().height(); ++y)
            for (int x = 0; x < image.view().width(); ++x)
                if (expected(x, y) != 0) {
                    if (first.x < 0) first = {x, y};
                    sums.add_run(x, x + 1, y);
                }
        for (const int runs : {1, 2, 5, 1000}) {
            const Grown grown = grow(image, seed, connectivity, runs);
            ASSERT_TRUE(grown.region);
            ASSERT_TRUE(equal(grown.mask.view(), expected.view())) << "round " << round << " runs " << runs;
            ASSERT_EQ(grown.region->moments.m00, sums.m00);
            ASSERT_EQ(grown.region->moments.m10, sums.m10);
            ASSERT_EQ(grown.region->moments.m01, sums.m01);
            ASSERT_EQ(grown.region->first, first);
        }
    }
}

TEST(GrowRegion, EndsOnSpiralsCombsAndTheWholeImageWithAStackOfOne) {
    for (const auto& image : {spiral(61), comb({81, 31})}) {
        const Point seed{0, 0};
        const Grown small = grow(image, seed, Connectivity::four, 1);
        ASSERT_TRUE(small.region);
        EXPECT_TRUE(equal(small.mask.view(), image.view()));
    }
    GuardedImage<Gray8> full({100, 80});
    full.fill(Gray8{255});
    EXPECT_EQ(grow(full, {50, 40}, Connectivity::eight, 1).region->moments.area(), 8000);
}

TEST(GrowRegion, TakesARangeOfLevels) {
    GuardedImage<Gray8> image({256, 1});
    for (int x = 0; x < 256; ++x) image(x, 0) = static_cast<Gray8>(x);
    const Grown grown = grow(image, {100, 0}, Connectivity::four, 4, 90, 120);
    ASSERT_TRUE(grown.region);
    EXPECT_EQ(grown.region->box, (Rectangle{90, 0, 31, 1}));
}

TEST(FloodFill, ChangesWhatIsLikeTheSeedAlone) {
    GuardedImage<Gray8> image({5, 3});
    image.fill(Gray8{10});
    for (int y = 0; y < 3; ++y) image(2, y) = 20;
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(flood_fill_scratch({5, 3}, 1)));
    const Span<std::uint8_t> bytes{scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())};
    const auto left = flood_fill(image.view(), {0, 1}, 20, Connectivity::four, bytes);
    ASSERT_TRUE(left);
    EXPECT_EQ(left->moments.area(), 6);
    for (int x = 0; x < 5; ++x) EXPECT_EQ(image(x, 1), x < 3 ? 20 : 10);
    EXPECT_EQ(flood_fill(image.view(), {0, 1}, 20, Connectivity::four, bytes)->moments.area(), 9);
}

TEST(GrowRegion, SaysWhatIsWrong) {
    GuardedImage<Gray8> image({4, 4}), mask({4, 4}), other({4, 3});
    image.fill(Gray8{1});
    mask.fill(Gray8{77});
    std::uint8_t scratch[64];
    const auto run = [&](ImageView<const Gray8> src, Point seed, int low, int high, int room,
                         ImageView<Gray8> dst) {
        return grow_region(src, seed, static_cast<Gray8>(low), static_cast<Gray8>(high), Connectivity::four,
                           Span<std::uint8_t>(scratch).first(room), dst)
            .status();
    };
    EXPECT_EQ(run({}, {0, 0}, 1, 2, 64, mask.view()), Status::empty_image);
    EXPECT_EQ(run(image.view(), {0, 0}, 1, 2, 64, other.view()), Status::size_mismatch);
    EXPECT_EQ(run(image.view(), {0, 0}, 2, 1, 64, mask.view()), Status::bad_argument);
    EXPECT_EQ(run(image.view(), {4, 0}, 1, 2, 64, mask.view()), Status::out_of_range);
    EXPECT_EQ(run(image.view(), {0, 0}, 1, 2, static_cast<int>(grow_region_scratch(1)) - 1, mask.view()),
              Status::scratch_too_small);
    EXPECT_EQ(mask(0, 0), 77);
    EXPECT_EQ(flood_fill({}, {0, 0}, 1, Connectivity::four, scratch).status(), Status::empty_image);
    EXPECT_EQ(flood_fill(image.view(), {0, 4}, 1, Connectivity::four, scratch).status(),
              Status::out_of_range);
    EXPECT_EQ(flood_fill(image.view(), {0, 0}, 1, Connectivity::four, Span<std::uint8_t>(scratch).first(20))
                  .status(),
              Status::scratch_too_small);
}

}  // namespace
}  // namespace fovea::test
