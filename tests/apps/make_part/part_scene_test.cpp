// SPDX-License-Identifier: MIT
//
// The scene that is asked for is the scene that is rendered: against moments computed in double precision.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include <fovea/base/crc32.hpp>
#include <make_part/part_scene.hpp>
#include <support/render.hpp>

namespace fovea::test {
namespace {

using apps::PartScene;
using apps::Picture;
using apps::render;

/// Area, centroid and central second moments of a shape or a picture.
struct Moments {
    double area = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;
};

/// Of a picture: every pixel weighs as much as the part covers of it. Without noise.
Moments moments_of(const Picture<Gray8>& picture, const PartScene& scene) {
    Moments m;
    const auto weight = [&](int x, int y) {
        return (scene.ground_level - picture.view()(x, y)) /
               static_cast<double>(scene.ground_level - scene.part_level);
    };
    for (int y = 0; y < picture.size.height; ++y)
        for (int x = 0; x < picture.size.width; ++x) {
            m.area += weight(x, y);
            m.x += weight(x, y) * x;
            m.y += weight(x, y) * y;
        }
    m.x /= m.area;
    m.y /= m.area;
    for (int y = 0; y < picture.size.height; ++y)
        for (int x = 0; x < picture.size.width; ++x) {
            m.xx += weight(x, y) * (x - m.x) * (x - m.x) / m.area;
            m.yy += weight(x, y) * (y - m.y) * (y - m.y) / m.area;
            m.xy += weight(x, y) * (x - m.x) * (y - m.y) / m.area;
        }
    return m;
}

/// Of a scene: a rectangle without a triangle and discs, each by its formula.
Moments true_moments(const PartScene& scene) {
    struct Piece {
        double area, x, y;
    };
    const double length = real(scene.length), height = real(scene.height);
    const double cut_x = real(scene.cut_x), cut_y = real(scene.cut_y);
    std::vector<Piece> pieces = {{length * height, 0, 0},
                                 {-cut_x * cut_y / 2, length / 2 - cut_x / 3, height / 2 - cut_y / 3}};
    for (const apps::RoundHole& hole : scene.holes)
        pieces.push_back({-pi * real(hole.radius) * real(hole.radius), real(hole.x), real(hole.y)});
    Moments m;
    double s = 0, t = 0;
    for (const Piece& piece : pieces) {
        m.area += piece.area;
        s += piece.area * piece.x;
        t += piece.area * piece.y;
    }
    const double turn = static_cast<double>(scene.angle.microdegrees()) * 1e-6 * pi / 180;
    m.x = real(scene.middle.x) + (s * std::cos(turn) - t * std::sin(turn)) / m.area;
    m.y = real(scene.middle.y) + (s * std::sin(turn) + t * std::cos(turn)) / m.area;
    return m;
}

PartScene without_noise() {
    PartScene scene;
    scene.noise = 0;
    return scene;
}
/// A bare rectangle in the middle of a small picture.
PartScene bare(int length, int height) {
    PartScene scene = without_noise();
    scene.size = {120, 100};
    scene.middle = fine(59.3, 48.8);
    scene.length = FinePixel::from_int(length);
    scene.height = FinePixel::from_int(height);
    scene.cut_x = scene.cut_y = FinePixel();
    scene.holes.clear();
    scene.angle = FineAngle();
    scene.blur = 0;
    return scene;
}

/// Half a grey level of 185 in every pixel of the outline and its blur would be 0.0027 px of it: a hundredth
/// of a pixel all along the outline is more than rounding and 16 x 16 samples can be wrong.
double area_error(const PartScene& scene) {
    double outline = 2 * (real(scene.length) + real(scene.height));
    for (const apps::RoundHole& hole : scene.holes) outline += 2 * pi * real(hole.radius);
    return outline / 100;
}

void shows_what_was_asked_for(const PartScene& scene) {
    const Moments found = moments_of(render(scene), scene);
    const Moments expected = true_moments(scene);
    EXPECT_NEAR(found.area, expected.area, area_error(scene));
    EXPECT_NEAR(found.x, expected.x, 0.01);
    EXPECT_NEAR(found.y, expected.y, 0.01);
}

TEST(PartScene, ShowsThePlateOfTheDefaults) { shows_what_was_asked_for(without_noise()); }

TEST(PartScene, ShowsThePlateAtAnyPlaceAndAngle) {
    Random random(901);
    for (int i = 0; i < 8; ++i) {
        PartScene scene = without_noise();
        scene.size = {300, 260};
        scene.length = fine(uniform(random, 100, 180));
        scene.height = fine(uniform(random, 40, 90));
        scene.cut_x = fine(uniform(random, 0, 40));
        scene.cut_y = fine(uniform(random, 0, 30));
        scene.holes = {
            {fine(uniform(random, 20, 25)), fine(uniform(random, -5, 5)), fine(uniform(random, 3, 9))},
            {fine(uniform(random, -25, -20)), fine(uniform(random, -5, 5)), fine(4.5)}};
        scene.middle = fine(uniform(random, 140, 160), uniform(random, 120, 140));
        scene.angle = FineAngle::from_microdegrees(static_cast<std::int64_t>(random.below(360000000)));
        scene.blur = random.below(3000000);
        if (i % 2 == 1) std::swap(scene.part_level, scene.ground_level);
        SCOPED_TRACE(i);
        shows_what_was_asked_for(scene);
    }
}

TEST(PartScene, IsAsLongAndAsHighAsItWasAskedFor) {
    // The second moments of a rectangle are those of its sides and of a pixel: (side^2 + 1) / 12.
    const PartScene scene = bare(60, 25);
    const Moments found = moments_of(render(scene), scene);
    EXPECT_NEAR(std::sqrt(12 * found.xx - 1), 60, 0.05);
    EXPECT_NEAR(std::sqrt(12 * found.yy - 1), 25, 0.05);
    EXPECT_NEAR(found.xy, 0, 0.1);
}

TEST(PartScene, TurnsClockwiseOnTheScreen) {
    PartScene scene = bare(60, 20);
    scene.angle = FineAngle::from_microdegrees(30000000);
    const Moments found = moments_of(render(scene), scene);
    // y grows downwards: what turns clockwise has a positive xy.
    EXPECT_NEAR(0.5 * std::atan2(2 * found.xy, found.xx - found.yy) * 180 / pi, 30, 0.05);
}

TEST(PartScene, CutsTheCornerAtTheEndAndBelow) {
    PartScene scene = bare(60, 40);
    scene.cut_x = FinePixel::from_int(20);
    scene.cut_y = FinePixel::from_int(12);
    const Picture<Gray8> picture = render(scene);
    EXPECT_EQ(picture.view()(59 + 28, 48 + 18), scene.ground_level);
    EXPECT_EQ(picture.view()(59 + 28, 48 - 17), scene.part_level);
    EXPECT_EQ(picture.view()(59 - 28, 48 + 18), scene.part_level);
    EXPECT_EQ(picture.view()(59 - 28, 48 - 17), scene.part_level);
}

// ---- Lens and sensor ---------------------------------------------------------------------------

TEST(PartScene, IsBlurredByTheStandardDeviationThatWasAskedFor) {
    // A lens adds its variance to the second moments of the part, in every direction, and moves no light.
    // What is below half a level, far out, is rounded away: two hundredths of the variance.
    const Moments sharp = moments_of(render(bare(20, 12)), bare(20, 12));
    for (const double deviation : {0.3, 0.5, 1.0, 2.0, 4.0}) {
        PartScene scene = bare(20, 12);
        scene.blur = static_cast<std::int64_t>(std::llround(deviation * 1e6));
        const Moments blurred = moments_of(render(scene), scene);
        EXPECT_NEAR(blurred.area, sharp.area, area_error(scene)) << deviation;
        EXPECT_NEAR(blurred.xx - sharp.xx, deviation * deviation, 0.03 + 0.02 * deviation * deviation)
            << deviation;
        EXPECT_NEAR(blurred.yy - sharp.yy, deviation * deviation, 0.03 + 0.02 * deviation * deviation)
            << deviation;
    }
}

TEST(PartScene, HasAnEdgeThatIsTheIntegralOfAGaussian) {
    PartScene scene = bare(60, 60);
    scene.blur = 2000000;
    const Picture<Gray8> picture = render(scene);
    const double edge = 59.3 - 30;
    for (int x = 20; x < 40; ++x) {
        // Over the pixel, by its middle and its ends.
        const auto share = [&](double at) { return 0.5 * std::erfc((edge - at) / (2 * std::sqrt(2.0))); };
        const double covered = (share(x - 0.5) + 4 * share(x) + share(x + 0.5)) / 6;
        const double level = scene.ground_level + covered * (scene.part_level - scene.ground_level);
        EXPECT_NEAR(picture.view()(x, 49), level, 1.5) << x;
    }
}

TEST(PartScene, HasNoiseOfTheStandardDeviationThatWasAskedFor) {
    for (const double deviation : {1.0, 4.0, 10.0}) {
        PartScene scene = bare(1, 1);
        scene.size = {200, 200};
        scene.ground_level = 128;
        scene.middle = fine(-50, -50);
        scene.noise = static_cast<std::int64_t>(deviation * 1000000);
        const Picture<Gray8> picture = render(scene);
        double sum = 0, squares = 0, neighbours = 0;
        for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
            const double off = picture.pixels[i] - 128.0;
            sum += off;
            squares += off * off;
            if (i > 0) neighbours += off * (picture.pixels[i - 1] - 128.0);
        }
        const double count = 200 * 200;
        // Five standard errors of the mean, the variance and the covariance of 40000 normal numbers; rounding
        // to whole levels adds a twelfth to the variance.
        const double variance = deviation * deviation + 1.0 / 12;
        EXPECT_NEAR(sum / count, 0, 5 * std::sqrt(variance) / 200);
        EXPECT_NEAR(squares / count, variance, 5 * variance * std::sqrt(2.0) / 200);
        EXPECT_NEAR(neighbours / count, 0, 5 * variance / 200);
    }
}

TEST(PartScene, StaysWithinTheLevelsOfAPixel) {
    PartScene scene = bare(60, 60);
    scene.part_level = 0;
    scene.ground_level = 255;
    scene.noise = 40000000;
    const Picture<Gray8> picture = render(scene);
    // Half of the noise is cut off, on both sides: a value that wrapped would be far from its level.
    std::vector<int> wrapped;
    for (int y = 30; y < 70; ++y)
        for (int x = 40; x < 80; ++x)
            if (picture.view()(x, y) > 245) wrapped.push_back(picture.view()(x, y));
    EXPECT_EQ(wrapped, std::vector<int>());
}

// ---- The same everywhere -----------------------------------------------------------------------

TEST(PartScene, IsTheSameForASeedAndAnotherForAnother) {
    PartScene scene = bare(60, 60);
    scene.noise = 4000000;
    const Picture<Gray8> first = render(scene);
    EXPECT_EQ(render(scene).pixels, first.pixels);
    scene.seed = 2;
    EXPECT_NE(render(scene).pixels, first.pixels);
}

TEST(PartScene, IsTheSameOnEveryMachineToTheLastPixel) {
    const Picture<Gray8> picture = render(PartScene());
    EXPECT_EQ(crc32({picture.pixels.data(), static_cast<std::ptrdiff_t>(picture.pixels.size())}),
              0xc1dbf23au);
}

TEST(PartScene, MayLieOutsideThePicture) {
    PartScene scene = bare(60, 60);
    scene.middle = fine(-100, 300);
    for (const Gray8 level : render(scene).pixels) ASSERT_EQ(level, scene.ground_level);
    scene.middle = fine(60, 50);
    scene.length = scene.height = FinePixel::from_int(20000);
    for (const Gray8 level : render(scene).pixels) ASSERT_EQ(level, scene.part_level);
}

}  // namespace
}  // namespace fovea::test
