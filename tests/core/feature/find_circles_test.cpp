// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/feature/find_circles.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

struct Disc {
    double x, y, radius;
    int level;
};

/// Discs as a camera sees them: the share of each pixel that they cover, from 16 x 16 places in it.
GuardedImage<Gray8> picture(Size size, const std::vector<Disc>& discs, int ground) {
    GuardedImage<Gray8> image(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            double level = ground;
            for (const Disc& disc : discs) {
                int covered = 0;
                if (std::abs(std::hypot(x - disc.x, y - disc.y) - disc.radius) > 1) {
                    covered = std::hypot(x - disc.x, y - disc.y) < disc.radius ? 256 : 0;
                } else {
                    for (int j = 0; j < 16; ++j)
                        for (int i = 0; i < 16; ++i)
                            covered += std::hypot(x + (i - 7.5) / 16 - disc.x, y + (j - 7.5) / 16 - disc.y) <
                                               disc.radius
                                           ? 1
                                           : 0;
                }
                level += (disc.level - level) * covered / 256;
            }
            image(x, y) = static_cast<Gray8>(std::lround(level));
        }
    return image;
}

struct Finder {
    std::vector<HoughCircle> room;
    int count = 0;

    explicit Finder(int capacity) : room(static_cast<std::size_t>(capacity)) {}
    ListView<HoughCircle> list() { return {room.data(), static_cast<int>(room.size()), &count}; }
    Status find(ImageView<const Gray8> src, const FindCirclesOptions& options) {
        // Room behind the scratch must survive.
        const std::int64_t bytes = find_circles_scratch(src.size(), options);
        std::vector<std::uint8_t> scratch(static_cast<std::size_t>(bytes) + 8, 0xee);
        const Status s =
            find_circles(src, options, {scratch.data(), static_cast<std::ptrdiff_t>(bytes)}, list());
        for (int i = 0; i < 8; ++i) EXPECT_EQ(scratch[static_cast<std::size_t>(bytes + i)], 0xee);
        return s;
    }
    const HoughCircle& operator[](int index) const { return room[static_cast<std::size_t>(index)]; }
};

/// The largest of the errors in centre and radius against the disc; far off where it was not found.
double error_of(const Finder& found, const Disc& disc) {
    double best = 1000;
    for (int i = 0; i < found.count; ++i)
        best = std::min(best, std::max({std::abs(found[i].centre.x.raw() / 256.0 - disc.x),
                                        std::abs(found[i].centre.y.raw() / 256.0 - disc.y),
                                        std::abs(found[i].radius.raw() / 256.0 - disc.radius)}));
    return best;
}

FindCirclesOptions options_for(int least, int most) {
    FindCirclesOptions options;
    options.circles.min_radius = least;
    options.circles.max_radius = most;
    options.circles.min_share = Ratio::from_ratio(1, 2);
    options.circles.min_votes = 20;
    return options;
}

TEST(FindCircles, FindsThreeDiscs) {
    const std::vector<Disc> discs = {{60.3, 50.7, 31.4, 220}, {150.5, 61, 20, 20}, {120, 130.25, 25.6, 240}};
    const GuardedImage<Gray8> src = picture({200, 170}, discs, 120);
    Finder found(8);
    ASSERT_EQ(found.find(src.view(), options_for(10, 60)), Status::ok);
    ASSERT_EQ(found.count, 3);
    for (const Disc& disc : discs) EXPECT_LE(error_of(found, disc), 0.1);
    FindCirclesOptions dark = options_for(10, 60);
    dark.circles.tone = CircleTone::dark;
    ASSERT_EQ(found.find(src.view(), dark), Status::ok);
    ASSERT_EQ(found.count, 1);
    EXPECT_LE(error_of(found, discs[1]), 0.1);
}

TEST(FindCircles, IsRightToATenthOfAPixelForCleanDiscs) {
    Random random(411);
    double worst = 0;
    for (int round = 0; round < 120; ++round) {
        const double radius = random.between(800, 4500) / 100.0;
        const Disc disc{random.between(5000, 7000) / 100.0, random.between(5000, 7000) / 100.0, radius,
                        round % 2 == 0 ? 200 : 30};
        const GuardedImage<Gray8> src = picture({120, 121}, {disc}, 110);
        for (const EdgeSmoothing smoothing : {EdgeSmoothing::none, EdgeSmoothing::gaussian_3x3}) {
            FindCirclesOptions options = options_for(6, 50);
            options.smoothing = smoothing;
            Finder found(8);
            ASSERT_EQ(found.find(src.view(), options), Status::ok);
            ASSERT_EQ(found.count, 1) << radius;
            worst = std::max(worst, error_of(found, disc));
        }
    }
    RecordProperty("worst", std::to_string(worst));
    EXPECT_LE(worst, 0.1);
}

TEST(FindCircles, HoldsInNoise) {
    Random random(412);
    for (int round = 0; round < 20; ++round) {
        const Disc disc{random.between(5000, 7000) / 100.0, random.between(5000, 7000) / 100.0,
                        random.between(1500, 4000) / 100.0, 180};
        GuardedImage<Gray8> src = picture({120, 120}, {disc}, 80);
        for (int y = 0; y < 120; ++y)
            for (int x = 0; x < 120; ++x) src(x, y) = static_cast<Gray8>(src(x, y) + random.between(-12, 12));
        FindCirclesOptions options = options_for(10, 50);
        options.smoothing = EdgeSmoothing::gaussian_5x5;
        options.low = 80;
        options.high = 160;
        Finder found(8);
        ASSERT_EQ(found.find(src.view(), options), Status::ok);
        ASSERT_EQ(found.count, 1);
        EXPECT_LE(error_of(found, disc), 0.3);
    }
}

TEST(FindCircles, IsItsStepsOneAfterTheOther) {
    const GuardedImage<Gray8> src = picture({130, 90}, {{40, 40, 20, 220}, {90.3, 44.4, 31, 20}}, 120);
    const Size size = src.view().size();
    const FindCirclesOptions options = options_for(10, 40);
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(1 << 20));
    const Span<std::uint8_t> scratch(bytes.data(), static_cast<std::ptrdiff_t>(bytes.size()));
    GuardedImage<Gray8> smooth(size), edges(size);
    std::vector<EdgePoint> room(8000);
    int points = 0;
    Finder expected(8), found(8);
    ASSERT_EQ(gaussian_3x3(src.view(), Border::replicate, scratch, smooth.view()), Status::ok);
    ASSERT_EQ(canny(smooth.view(), options.low, options.high, Border::replicate, scratch, edges.view()),
              Status::ok);
    ASSERT_EQ(canny_points(smooth.view(), edges.view(), Border::replicate, {room.data(), 8000, &points}),
              Status::ok);
    ASSERT_EQ(hough_circles({room.data(), points}, size, options.circles, scratch, expected.list()),
              Status::ok);
    ASSERT_EQ(found.find(src.view(), options), Status::ok);
    ASSERT_EQ(found.count, expected.count);
    ASSERT_EQ(found.count, 2);
    for (int i = 0; i < found.count; ++i) {
        EXPECT_EQ(found[i].centre.x, expected[i].centre.x);
        EXPECT_EQ(found[i].centre.y, expected[i].centre.y);
        EXPECT_EQ(found[i].radius, expected[i].radius);
        EXPECT_EQ(found[i].votes, expected[i].votes);
    }
}

TEST(FindCircles, MovesWithThePicture) {
    const std::vector<Disc> discs = {{40.2, 40.7, 18, 220}, {85.5, 42, 14.3, 20}};
    std::vector<Disc> moved = discs;
    for (Disc& disc : moved)
        disc = {disc.x + 21, disc.y + 15, disc.radius, disc.level};  // whole cells of 3 px
    Finder a(4), b(4);
    ASSERT_EQ(a.find(picture({140, 110}, discs, 120).view(), options_for(8, 30)), Status::ok);
    ASSERT_EQ(b.find(picture({140, 110}, moved, 120).view(), options_for(8, 30)), Status::ok);
    ASSERT_EQ(a.count, 2);
    ASSERT_EQ(b.count, 2);
    for (int i = 0; i < 2; ++i) {
        EXPECT_EQ(b[i].centre.x - a[i].centre.x, SubPixel::from_int(21));
        EXPECT_EQ(b[i].centre.y - a[i].centre.y, SubPixel::from_int(15));
        EXPECT_EQ(b[i].radius, a[i].radius);
    }
}

TEST(FindCircles, KeepsTheStrongestWhereThereIsNoRoom) {
    const std::vector<Disc> discs = {{40, 40, 18, 220}, {110, 45, 30, 220}, {180, 40, 24, 220}};
    const GuardedImage<Gray8> src = picture({220, 90}, discs, 120);
    Finder one(1);
    ASSERT_EQ(one.find(src.view(), options_for(8, 50)), Status::capacity_exceeded);
    ASSERT_EQ(one.count, 1);
    EXPECT_LE(error_of(one, discs[1]), 0.1);
    // Points of the brightest disc alone.
    const std::vector<Disc> unlike = {{40, 40, 18, 250}, {110, 45, 30, 170}};
    FindCirclesOptions few = options_for(8, 50);
    few.max_points = 90;
    Finder found(4);
    ASSERT_EQ(found.find(picture({220, 90}, unlike, 60).view(), few), Status::capacity_exceeded);
    ASSERT_EQ(found.count, 1);
    EXPECT_LE(error_of(found, unlike[0]), 0.2);
}

TEST(FindCircles, OfTheSmallestImagesAreNone) {
    Random random(413);
    for (const Size size : test_sizes()) {
        GuardedImage<Gray8> src(size);
        src.fill(random);
        for (const EdgeSmoothing smoothing :
             {EdgeSmoothing::none, EdgeSmoothing::gaussian_3x3, EdgeSmoothing::gaussian_5x5}) {
            FindCirclesOptions options = options_for(10, 50);
            options.smoothing = smoothing;
            options.circles.min_votes = 60;
            Finder found(4);
            ASSERT_EQ(found.find(src.view(), options), Status::ok);
            EXPECT_EQ(found.count, 0);
        }
    }
}

TEST(FindCircles, LeavesTheListWhenItCannotRun) {
    GuardedImage<Gray8> src({20, 10});
    src.fill(0);
    Finder found(3);
    found.count = 2;
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(find_circles_scratch({20, 10}, {})));
    const Span<std::uint8_t> scratch(bytes.data(), static_cast<std::ptrdiff_t>(bytes.size()));
    EXPECT_EQ(find_circles({}, {}, scratch, found.list()), Status::empty_image);
    const ImageView<const Gray8> wide(bytes.data(), {65535, 1}, 65535);
    EXPECT_EQ(find_circles(wide, {}, scratch, found.list()), Status::image_too_large);
    EXPECT_EQ(find_circles_scratch({65535, 1}, {}), 0);
    EXPECT_EQ(find_circles_scratch({0, 1}, {}), 0);
    EXPECT_EQ(find_circles(src.view(), {}, scratch.first(scratch.size() - 1), found.list()),
              Status::scratch_too_small);
    std::vector<FindCirclesOptions> bad(8);
    bad[0].low = -1;
    bad[1].high = 2041;
    bad[2].low = 121;
    bad[3].max_points = 0;
    bad[4].max_points = detail::most_edge_points + 1;
    bad[5].smoothing = static_cast<EdgeSmoothing>(3);
    bad[6].circles.min_radius = 1;
    bad[7].circles.cell = 17;
    for (const FindCirclesOptions& options : bad) {
        EXPECT_EQ(find_circles_scratch({20, 10}, options), 0);
        EXPECT_EQ(find_circles(src.view(), options, scratch, found.list()), Status::bad_argument);
    }
    EXPECT_EQ(found.count, 2);
}

}  // namespace
}  // namespace fovea::test
