// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/code/finder_frame.hpp>
#include <fovea/code/finder_patterns.hpp>
#include <fovea/code/finder_triples.hpp>
#include <support/render.hpp>

namespace fovea::test {
namespace {

using namespace fovea::detail;

/// Finder patterns in a binary image.
class Finders {
public:
    Finders(int width, int height)
        : width_(width), height_(height), bits_(static_cast<std::size_t>(bit_words(width) * height)) {}

    BitView<BitWord> view() { return {bits_.data(), {width_, height_}, bit_words(width_)}; }
    void draw(double cx, double cy, double module, double angle) {
        for (int y = 0; y < height_; ++y) {
            for (int x = 0; x < width_; ++x) {
                const double u = (std::cos(angle) * (x - cx) + std::sin(angle) * (y - cy)) / module;
                const double v = (-std::sin(angle) * (x - cx) + std::cos(angle) * (y - cy)) / module;
                const double away = std::max(std::abs(u), std::abs(v));
                if (away < 4.5) view().set(x, y, away < 1.5 || (away >= 2.5 && away < 3.5));
            }
        }
    }
    std::vector<FinderPattern> find(int step = 1) {
        FinderPattern room[max_finder_patterns];
        int count = 0;
        FinderSearch(view(), ListView<FinderPattern>(room, max_finder_patterns, &count)).rows(0, step);
        return {room, room + count};
    }

private:
    int width_;
    int height_;
    std::vector<BitWord> bits_;
};

TEST(FiveRuns, AreAsOneOneThreeOneOne) {
    const auto fits = [](int a, int b, int c, int d, int e) { return FiveRuns{{a, b, c, d, e}}.fits(14); };
    EXPECT_TRUE(fits(1, 1, 3, 1, 1));
    EXPECT_TRUE(fits(10, 10, 30, 10, 10));
    // Ink that spreads by a third of a module.
    EXPECT_TRUE(fits(13, 7, 33, 7, 13));
    EXPECT_TRUE(fits(7, 13, 27, 13, 7));
    EXPECT_FALSE(fits(10, 10, 10, 10, 10));
    EXPECT_FALSE(fits(10, 30, 10, 30, 10));
    EXPECT_FALSE(fits(30, 10, 30, 10, 10));
    EXPECT_FALSE(fits(1, 1, 2, 1, 1));
}

TEST(FiveRuns, AnOuterRunThatGoesOnIsCutShort) {
    FiveRuns runs{{90, 10, 30, 10, 10}};
    runs.clip();
    EXPECT_EQ(runs.run[0], 10);
    EXPECT_TRUE(runs.fits(14));
    FiveRuns both{{90, 10, 30, 10, 90}};
    both.clip();
    EXPECT_FALSE(both.fits(14));
}

TEST(FinderSearch, FindsAPatternAtEveryAngleAndSize) {
    for (int round = 0; round < 60; ++round) {
        const double module = 1.5 + round * 0.2;
        const double angle = round * 0.37;
        Finders finders(160, 150);
        finders.draw(80.3, 70.6, module, angle);
        const std::vector<FinderPattern> found = finders.find();
        ASSERT_EQ(found.size(), 1U) << round;
        // A slanting square's middle along a row or a column is a little off its own.
        const double most = 0.6 + module * 0.2;
        EXPECT_NEAR(static_cast<double>(found[0].centre.x) / 256, 80.3, most) << round;
        EXPECT_NEAR(static_cast<double>(found[0].centre.y) / 256, 70.6, most) << round;
        // A turn of 22.5 degrees is measured an eleventh too large.
        EXPECT_NEAR(static_cast<double>(found[0].module) / 256 / module, 1.04, 0.12) << round;
        EXPECT_FALSE(found[0].inverted);
    }
}

TEST(FinderSearch, FindsTheSmallestInACornerAndLightOnes) {
    Finders finders(21, 21);
    finders.draw(3, 3, 1, 0);
    finders.draw(17, 3, 1, 0);
    finders.draw(3, 17, 1, 0);
    EXPECT_EQ(finders.find().size(), 3U);
    for (int y = 0; y < 21; ++y)
        for (int x = 0; x < 21; ++x) finders.view().set(x, y, !finders.view()(x, y));
    const std::vector<FinderPattern> light = finders.find();
    ASSERT_EQ(light.size(), 3U);
    for (const FinderPattern& pattern : light) EXPECT_TRUE(pattern.inverted);
}

TEST(FinderSearch, EveryOtherRowIsEnough) {
    Finders finders(60, 60);
    finders.draw(20, 20, 1, 0);
    finders.draw(40, 35, 2, 0.3);
    EXPECT_EQ(finders.find(2).size(), 2U);
}

TEST(FinderSearch, KeepsTheBestOfMoreThanItHasRoomFor) {
    Random random(171);
    Finders finders(640, 480);
    for (int y = 0; y < 480; ++y)
        for (int x = 0; x < 640; ++x) finders.view().set(x, y, random.between(0, 1) != 0);
    for (int i = 0; i < 3; ++i) finders.draw(600 - 40 * i, 460, 2, 0);
    const std::vector<FinderPattern> found = finders.find();
    ASSERT_LE(found.size(), static_cast<std::size_t>(max_finder_patterns));
    int right = 0;
    for (const FinderPattern& pattern : found)
        for (int i = 0; i < 3; ++i)
            right += length(pattern.centre - pixel_place(600 - 40 * i, 460)) < 256 ? 1 : 0;
    EXPECT_EQ(right, 3);
}

TEST(FinderTriples, TakesThreeCornersOfASquareInTheirOrder) {
    std::vector<FinderPattern> patterns(5);
    const int places[5][2] = {{200, 100}, {300, 290}, {100, 100}, {40, 20}, {100, 200}};
    for (std::size_t i = 0; i < 5; ++i) {
        patterns[i].centre = pixel_place(places[i][0], places[i][1]);
        patterns[i].module = 4 * 256;
        patterns[i].rings = most_finder_rings;
    }
    int count = 5;
    FinderTriples triples(ListView<FinderPattern>(patterns.data(), 5, &count));
    ASSERT_GE(triples.size(), 1);
    EXPECT_EQ(triples.corner(0).centre.x, 100 * 256);
    EXPECT_EQ(triples.corner(0).centre.y, 100 * 256);
    EXPECT_EQ(triples.right(0).centre.x, 200 * 256);
    EXPECT_EQ(triples.below(0).centre.y, 200 * 256);
    EXPECT_TRUE(triples.usable(0));
    triples.use(0);
    for (int i = 0; i < triples.size(); ++i) EXPECT_FALSE(triples.usable(i)) << i;
}

TEST(FinderTriples, WantsOneColourAndSizesThatGoTogether) {
    std::vector<FinderPattern> patterns(3);
    const int places[3][2] = {{100, 100}, {200, 100}, {100, 200}};
    for (std::size_t i = 0; i < 3; ++i) {
        patterns[i].centre = pixel_place(places[i][0], places[i][1]);
        patterns[i].module = 4 * 256;
    }
    int count = 3;
    const ListView<FinderPattern> list(patterns.data(), 3, &count);
    EXPECT_EQ(FinderTriples(list).size(), 1);
    patterns[1].inverted = true;
    EXPECT_EQ(FinderTriples(list).size(), 0);
    patterns[1].inverted = false;
    patterns[2].module = 13 * 256;
    EXPECT_EQ(FinderTriples(list).size(), 0);
    patterns[2].module = 4 * 256;
    patterns[2].centre = pixel_place(300, 110);
    EXPECT_EQ(FinderTriples(list).size(), 0);
}

TEST(FinderFrame, MeasuresModulesAndEdges) {
    for (int round = 0; round < 40; ++round) {
        const double angle = round * 0.16;
        const double module = 3 + round % 7;
        Finders finders(160, 160);
        finders.draw(80, 80, module, angle);
        FinderFrame frame;
        const ModulePoint right{std::llround(25600 * std::cos(angle)), std::llround(25600 * std::sin(angle))};
        const ModulePoint down{-right.y, right.x};
        ASSERT_TRUE(frame.measure({finders.view(), false}, pixel_place(80, 80), std::llround(module * 256),
                                  right, down))
            << round;
        EXPECT_LT(length(frame.centre() - pixel_place(80, 80)), 128) << round;
        EXPECT_NEAR(static_cast<double>(length(frame.u())) / 256, module, 0.3) << round;
        EXPECT_NEAR(static_cast<double>(length(frame.v())) / 256, module, 0.3) << round;
        PlaceLine edge;
        ASSERT_TRUE(frame.edge(frame.u(), frame.v(), edge)) << round;
        // Half of seven modules away.
        const ModulePoint along = edge.to - edge.from;
        const double away = static_cast<double>(cross_product(along, frame.centre() - edge.from)) /
                            static_cast<double>(length(along)) / 256;
        EXPECT_NEAR(std::abs(away), 3.5 * module, 0.6) << round;
    }
}

TEST(FinderFrame, RefusesWhatIsNoFinder) {
    Finders finders(100, 100);
    FinderFrame frame;
    const ModulePoint right{25600, 0};
    const ModulePoint down{0, 25600};
    EXPECT_FALSE(frame.measure({finders.view(), false}, pixel_place(50, 50), 1024, right, down));
    EXPECT_FALSE(frame.measure({finders.view(), false}, pixel_place(-500, 50), 1024, right, down));
    EXPECT_FALSE(frame.measure({finders.view(), false}, pixel_place(50, 50), 1024, {0, 0}, down));
}

/// A pattern of modules of one width and another height, its upper left corner at a place.
void draw_upright(Finders& finders, int left, int top, int width, int height) {
    for (int y = 0; y < 7 * height; ++y)
        for (int x = 0; x < 7 * width; ++x) {
            const int u = x / width < 3 ? 3 - x / width : x / width - 3;
            const int v = y / height < 3 ? 3 - y / height : y / height - 3;
            finders.view().set(left + x, top + y, std::max(u, v) != 2);
        }
}

TEST(FinderSearch, ARowThatIsNoPatternDoesNotHideTheNext) {
    // Steps of three from the ring into the middle, over the light: in the ring a row of the same five runs.
    Finders leap(60, 60);
    draw_upright(leap, 20, 20, 2, 2);
    for (const int x : {22, 23, 30, 31}) leap.view().set(x, 21, false);
    EXPECT_EQ(leap.find(3).size(), 1U);
    // A tiny row in the last but one row of the middle, of which its column goes on for too long.
    Finders tiny(60, 60);
    draw_upright(tiny, 10, 10, 4, 4);
    const int row = 10 + 4 * 5 - 2;
    for (int x = 18; x < 30; ++x) tiny.view().set(x, row, x == 20 || (x > 21 && x < 25) || x == 26);
    tiny.view().set(23, row, true);
    FinderPattern room[max_finder_patterns];
    int count = 0;
    FinderSearch(tiny.view(), ListView<FinderPattern>(room, max_finder_patterns, &count)).rows(row, 1);
    EXPECT_EQ(count, 1);
    // Much higher than wide: from its first rows the middle goes on for longer than the pattern is wide.
    Finders high(60, 90);
    draw_upright(high, 10, 10, 3, 8);
    EXPECT_EQ(high.find().size(), 1U);
}

TEST(FinderSearch, WhatIsKnownOfTheRowBeforeChangesNothing) {
    Random random(53);
    for (int round = 0; round < 60; ++round) {
        const int module = 1 + round % 5;
        const int step = 1 + round % 3;
        Finders finders(130, 120);
        // Modules at random have many rows that look like a pattern's.
        std::vector<bool> dark(130 * 120);
        for (std::size_t i = 0; i < dark.size(); ++i) dark[i] = random.between(0, 1) != 0;
        for (int y = 0; y < 120; ++y)
            for (int x = 0; x < 130; ++x)
                finders.view().set(x, y, dark[static_cast<std::size_t>(y / module * 130 + x / module)]);
        finders.draw(60.2, 50.7, 2.2, round * 0.3);
        FinderPattern room[max_finder_patterns];
        int count = 0;
        // Each row with a search of its own.
        for (int y = 0; y < 120; y += step)
            FinderSearch(finders.view(), ListView<FinderPattern>(room, max_finder_patterns, &count))
                .rows(y, 120);
        const std::vector<FinderPattern> found = finders.find(step);
        ASSERT_EQ(found.size(), static_cast<std::size_t>(count)) << round;
        for (std::size_t i = 0; i < found.size(); ++i) {
            EXPECT_EQ(found[i].centre.x, room[i].centre.x) << round;
            EXPECT_EQ(found[i].centre.y, room[i].centre.y) << round;
            EXPECT_EQ(found[i].lines, room[i].lines) << round;
            EXPECT_EQ(found[i].rings, room[i].rings) << round;
        }
    }
}

}  // namespace
}  // namespace fovea::test
