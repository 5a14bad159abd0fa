// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include <fovea/base/random.hpp>
#include <fovea/pixelwise/colour_class.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

const ColourClass& named(const std::string& name) {
    for (const ColourClass& colour : colour_classes)
        if (name == colour.name) return colour;
    std::abort();
}

TEST(HsvRange, HasInclusiveBounds) {
    const HsvRange range{10, 20, 30, 40, 50, 60};
    EXPECT_TRUE(range.contains({10, 30, 50}));
    EXPECT_TRUE(range.contains({20, 40, 60}));
    EXPECT_FALSE(range.contains({9, 30, 50}));
    EXPECT_FALSE(range.contains({21, 30, 50}));
    EXPECT_FALSE(range.contains({10, 29, 50}));
    EXPECT_FALSE(range.contains({10, 41, 50}));
    EXPECT_FALSE(range.contains({10, 30, 49}));
    EXPECT_FALSE(range.contains({10, 30, 61}));
}

TEST(HsvRange, GoesRoundThroughRedWhereTheFirstHueIsAboveTheLast) {
    const HsvRange red{170, 10};
    EXPECT_TRUE(red.contains({170, 0, 0}));
    EXPECT_TRUE(red.contains({179, 0, 0}));
    EXPECT_TRUE(red.contains({0, 0, 0}));
    EXPECT_TRUE(red.contains({10, 0, 0}));
    EXPECT_FALSE(red.contains({11, 0, 0}));
    EXPECT_FALSE(red.contains({169, 0, 0}));
    EXPECT_FALSE(red.contains({200, 0, 0})) << "no such hue";
}

TEST(ColourClass, ReachesAsFarAsItsToleranceRoundTheCircle) {
    for (int hue = 0; hue < 180; hue += 7)
        for (int tolerance = 0; tolerance < 100; ++tolerance) {
            const HsvRange range = ColourClass{"", hue, tolerance, 0, 255, 0, 255}.range();
            ASSERT_TRUE(range.valid());
            for (int other = 0; other < 180; ++other) {
                const int apart = std::abs(hue - other);
                const int distance = apart < 90 ? apart : 180 - apart;
                ASSERT_EQ(range.contains({static_cast<std::uint8_t>(other), 0, 0}), distance <= tolerance)
                    << hue << " " << tolerance << " " << other;
            }
        }
}

TEST(ColourClass, OfEachNameHasItsColourAndNotTheOthers) {
    const struct {
        const char* name;
        Rgb888 colour;
    } samples[] = {{"yellow", {230, 200, 20}}, {"orange", {240, 140, 20}}, {"red", {200, 20, 30}},
                   {"blue", {20, 40, 160}},    {"green", {20, 150, 40}},   {"white", {250, 250, 245}},
                   {"skin", {220, 160, 140}}};
    for (const auto& sample : samples)
        EXPECT_TRUE(named(sample.name).range().contains(hsv_of(sample.colour))) << sample.name;
    EXPECT_FALSE(named("red").range().contains(hsv_of({20, 150, 40})));
    EXPECT_FALSE(named("green").range().contains(hsv_of({20, 40, 160})));
    EXPECT_FALSE(named("blue").range().contains(hsv_of({200, 20, 30})));
    EXPECT_FALSE(named("white").range().contains(hsv_of({20, 20, 20})));
}

TEST(HsvRange, OfImagesEqualsTheReferenceStraightFromColourToo) {
    Random random(351);
    for (const Size size : test_sizes())
        for (int round = 0; round < 12; ++round) {
            GuardedImage<Rgb888> colour(size);
            GuardedImage<Hsv888> hsv(size);
            GuardedImage<Gray8> dst(size), straight(size);
            colour.fill(random);
            const auto byte = [&](std::uint32_t bound) {
                return static_cast<std::uint8_t>(random.below(bound));
            };
            HsvRange range{byte(180), byte(180),
                           byte(100), static_cast<std::uint8_t>(100 + byte(156)),
                           byte(100), static_cast<std::uint8_t>(100 + byte(156))};
            if (round == 0) range = named("red").range();
            ASSERT_EQ(to_hsv(colour.view(), hsv.view()), Status::ok);
            ASSERT_EQ(hsv_range(colour.view(), range, straight.view()), Status::ok);
            if (round % 2 == 1) hsv.fill(random);
            ASSERT_EQ(hsv_range(hsv.view(), range, dst.view()), Status::ok);
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x) {
                    ASSERT_EQ(dst(x, y), range.contains(hsv(x, y)) ? 255 : 0);
                    ASSERT_EQ(straight(x, y), range.contains(hsv_of(colour(x, y))) ? 255 : 0);
                }
        }
}

TEST(HsvRange, RefusesBoundsThatAreNoneAndLeavesTheOutput) {
    GuardedImage<Hsv888> hsv({3, 2});
    GuardedImage<Rgb888> colour({3, 2});
    GuardedImage<Gray8> dst({3, 2});
    dst.fill(Gray8{77});
    for (const HsvRange& wrong :
         {HsvRange{180, 0}, HsvRange{0, 180}, HsvRange{0, 0, 9, 8}, HsvRange{0, 0, 0, 0, 200, 199}}) {
        EXPECT_EQ(hsv_range(hsv.view(), wrong, dst.view()), Status::bad_argument);
        EXPECT_EQ(hsv_range(colour.view(), wrong, dst.view()), Status::bad_argument);
    }
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 3; ++x) EXPECT_EQ(dst(x, y), 77);
}

}  // namespace
}  // namespace fovea::test
