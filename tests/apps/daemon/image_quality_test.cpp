// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <fovea/base/random.hpp>

#include <daemon/image_quality.hpp>
#include <make_part/part_scene.hpp>

#include "support/guarded_image.hpp"
#include "support/plate_scene.hpp"
#include "support/render.hpp"
#include "support/scattered_workers.hpp"

namespace fovea::apps {
namespace {

ImageQuality measured(ImageView<const Gray8> image, const ImageQualityLimits& limits = {}) {
    const Result<ImageQuality> quality = image_quality(image, limits);
    EXPECT_TRUE(quality.ok());
    return quality ? *quality : ImageQuality{};
}
ImageVerdict verdict(const Picture<Gray8>& picture) { return judge(measured(picture.view()), {}); }

/// The picture in other light: brightness times share / 256.
Picture<Gray8> in_light(const Picture<Gray8>& picture, int share) {
    Picture<Gray8> other = picture;
    for (Gray8& level : other.pixels) level = static_cast<Gray8>(std::min(level * share / 256, 255));
    return other;
}

TEST(ImageQuality, IsAsWorkedByHand) {
    test::GuardedImage<Gray8> image({20, 4});
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 20; ++x)
            image(x, y) = static_cast<Gray8>(x < 5 ? 10 : x < 10 ? 100 : x < 18 ? 200 : 250);
    ImageQuality quality = measured(image.view());
    EXPECT_EQ(quality.dark, 250);
    EXPECT_EQ(quality.saturated, 100);
    EXPECT_EQ(quality.mean, 133);  // (50 + 500 + 1600 + 500) / 20, a tie
    EXPECT_EQ(quality.contrast, 240);
    // Of places 0 to 11 those are edges that change by 120 or more: 2 to 4, by 90 and then by 100. None is
    // flat.
    EXPECT_EQ(quality.sharpness, (1000 * (90 * 90 + 100 * 100) + 190 * 190 / 2) / (190 * 190));

    test::GuardedImage<Gray8> even({16, 4});
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 16; ++x) even(x, y) = static_cast<Gray8>(10 * x);
    EXPECT_EQ(measured(even.view()).sharpness, 125) << "eight even steps, half of the contrast";
}

TEST(ImageQuality, TakesAPatternForSharpAndNoiseForNothing) {
    Random random(91);
    test::GuardedImage<Gray8> image({100, 100});
    for (int y = 0; y < 100; ++y)
        for (int x = 0; x < 100; ++x) image(x, y) = static_cast<Gray8>(random.next());
    EXPECT_GT(measured(image.view()).sharpness, 1000);
}

TEST(ImageQuality, FindsASceneFine) {
    for (const std::int64_t blur : {0, 500000, 1000000, 1500000})
        for (const std::int64_t noise : {0, 4000000}) {
            PartScene scene = test::small_plate({240, 160});
            scene.blur = blur;
            scene.noise = noise;
            EXPECT_EQ(verdict(render(scene)), ImageVerdict::fine) << blur << " " << noise;
        }
}

TEST(ImageQuality, TellsADeadLampFromABadPart) {
    PartScene scene = test::small_plate({240, 160});
    const Picture<Gray8> good = render(scene);
    // As bad as a part can be: it hides all but the corners of the picture.
    scene.length = FinePixel::from_int(235);
    scene.height = FinePixel::from_int(155);
    scene.angle = FineAngle::from_microdegrees(0);
    scene.holes.clear();
    scene.part_level = 5;
    const Picture<Gray8> large = render(scene);
    EXPECT_GT(measured(large.view()).dark, 900);
    EXPECT_EQ(verdict(large), ImageVerdict::fine);
    EXPECT_EQ(verdict(in_light(large, 30)), ImageVerdict::dark);
    EXPECT_EQ(verdict(in_light(good, 25)), ImageVerdict::dark);
    EXPECT_EQ(verdict(in_light(good, 0)), ImageVerdict::dark);
    // Nothing but noise, of a sensor in the dark.
    scene.part_level = scene.ground_level = 8;
    EXPECT_EQ(verdict(render(scene)), ImageVerdict::dark);
}

TEST(ImageQuality, TellsASaturatedAndACoveredPicture) {
    const Picture<Gray8> good = render(test::small_plate({240, 160}));
    EXPECT_EQ(verdict(in_light(good, 256 * 20)), ImageVerdict::saturated);
    for (const Gray8 level : {Gray8{60}, Gray8{128}, Gray8{215}}) {
        PartScene scene = test::small_plate({240, 160});
        scene.part_level = scene.ground_level = level;
        EXPECT_EQ(verdict(render(scene)), ImageVerdict::covered) << int{level};
    }
}

TEST(ImageQuality, FallsAsTheBlurGrows) {
    for (const double noise : {0.0, 3.0, 6.0}) {
        int before = 2000;
        for (const double blur : {0.0, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0}) {
            Random random(89);
            test::Scene scene;
            scene.blur = blur;
            scene.noise = noise;
            const auto disc = [](double x, double y) { return std::hypot(x - 60, y - 50) < 30; };
            auto image = test::render({120, 100}, scene, random, disc);
            const ImageQuality quality = measured(image.view());
            EXPECT_LT(quality.sharpness, before) << blur;
            before = quality.sharpness;
            EXPECT_EQ(judge(quality, {}), blur < 2.5 ? ImageVerdict::fine : ImageVerdict::defocused)
                << blur << ": " << quality.sharpness;
        }
    }
    // So wide that there is no edge left.
    test::GuardedImage<Gray8> slope({256, 20});
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 256; ++x) slope(x, y) = static_cast<Gray8>(x);
    EXPECT_EQ(measured(slope.view()).sharpness, 0);
    EXPECT_EQ(judge(measured(slope.view()), {}), ImageVerdict::defocused);
}

TEST(ImageQuality, SeesEdgesInBothDirections) {
    for (const bool across : {false, true}) {
        test::GuardedImage<Gray8> image({40, 40});
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < 40; ++x) image(x, y) = static_cast<Gray8>((across ? x : y) < 20 ? 30 : 220);
        EXPECT_EQ(measured(image.view()).sharpness, 1000);
    }
}

TEST(ImageQuality, SaysNothingOfTheFocusOfAnEmptyView) {
    test::GuardedImage<Gray8> slope({256, 20});
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 256; ++x) slope(x, y) = static_cast<Gray8>(150 + x / 5);
    const ImageQuality quality = measured(slope.view());
    EXPECT_EQ(quality.sharpness, 0);
    EXPECT_EQ(judge(quality, {}), ImageVerdict::fine);
}

/// With less light a picture is never less dark, more saturated or brighter, and what is too dark stays so.
TEST(ImageQuality, FollowsTheLight) {
    const Picture<Gray8> good = render(test::small_plate({240, 160}));
    ImageQuality before;
    before.saturated = before.mean = 1001;
    bool was_dark = false;
    for (int share = 2000; share >= 0; share -= 40) {
        const ImageQuality quality = measured(in_light(good, share).view());
        EXPECT_GE(quality.dark, before.dark);
        EXPECT_LE(quality.saturated, before.saturated);
        EXPECT_LE(quality.mean, before.mean);
        const bool dark = judge(quality, {}) == ImageVerdict::dark;
        EXPECT_TRUE(dark || !was_dark) << share;
        was_dark = dark;
        before = quality;
    }
    EXPECT_TRUE(was_dark);
}

TEST(ImageQuality, LooksAtAPartOfALargePicture) {
    EXPECT_EQ(detail::sample_step({320, 240}), 1);
    EXPECT_EQ(detail::sample_step({321, 240}), 2);
    EXPECT_EQ(detail::sample_step({1920, 1080}), 6);
    EXPECT_EQ(detail::sample_step({max_image_side, max_image_side}), 119);
    PartScene scene;
    const ImageQuality large = measured(render(scene).view());
    EXPECT_EQ(judge(large, {}), ImageVerdict::fine);
    scene.blur = 4000000;
    EXPECT_EQ(verdict(render(scene)), ImageVerdict::defocused);
}

TEST(ImageQuality, OfAnySizeStaysInItsImage) {
    Random random(90);
    for (const Size size : {Size{1, 1}, Size{8, 8}, Size{9, 1}, Size{1, 9}, Size{9, 9}, Size{17, 30}}) {
        test::GuardedImage<Gray8> image(size);
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) image(x, y) = static_cast<Gray8>(random.next());
        const ImageQuality quality = measured(image.view());
        const bool looked = size.width >= 9 || size.height >= 9;
        if (!looked) {
            EXPECT_EQ(quality.sharpness, 1000);
        }
    }
    EXPECT_EQ(image_quality({}, {}).status(), Status::empty_image);
    test::GuardedImage<Gray8> image({4, 4});
    ImageQualityLimits limits;
    limits.dark_below = 257;
    EXPECT_EQ(image_quality(image.view(), limits).status(), Status::bad_argument);
}

TEST(ImageQuality, BySeveralWorkersIsTheSame) {
    Random random(91);
    for (const Size size : {Size{1, 1}, Size{9, 40}, Size{100, 75}, Size{400, 333}})
        for (const int count : {2, 3, 16}) {
            test::GuardedImage<Gray8> image(size);
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x)
                    image(x, y) = static_cast<Gray8>((x / 7 + y / 9) % 2 * 120 + random.between(0, 90));
            std::vector<std::uint8_t> room(static_cast<std::size_t>(image_quality_scratch(count)));
            const Span<std::uint8_t> scratch(room.data(), static_cast<std::ptrdiff_t>(room.size()));
            const test::ScatteredWorkers workers(count, 3);
            const Result<ImageQuality> made = image_quality(image.view(), {}, scratch, workers);
            const ImageQuality wanted = measured(image.view());
            ASSERT_TRUE(made.ok());
            EXPECT_EQ(made->dark, wanted.dark);
            EXPECT_EQ(made->saturated, wanted.saturated);
            EXPECT_EQ(made->mean, wanted.mean);
            EXPECT_EQ(made->contrast, wanted.contrast);
            EXPECT_EQ(made->sharpness, wanted.sharpness);
            EXPECT_EQ(image_quality(image.view(), {}, scratch.first(scratch.size() - 1), workers).status(),
                      Status::scratch_too_small);
        }
}

TEST(ImageTrouble, IsOneEventWhileALampFlickers) {
    ImageTrouble trouble;
    EXPECT_FALSE(trouble.changed_by(ImageVerdict::fine));
    EXPECT_TRUE(trouble.changed_by(ImageVerdict::dark));
    for (int k = 0; k < 50; ++k)
        EXPECT_FALSE(trouble.changed_by(k % 5 == 4 ? ImageVerdict::dark : ImageVerdict::fine));
    EXPECT_EQ(trouble.trouble(), ImageVerdict::dark);
    EXPECT_TRUE(trouble.changed_by(ImageVerdict::covered));
    for (int k = 0; k < 4; ++k) EXPECT_FALSE(trouble.changed_by(ImageVerdict::fine));
    EXPECT_TRUE(trouble.changed_by(ImageVerdict::fine));
    EXPECT_EQ(trouble.trouble(), ImageVerdict::fine);
    EXPECT_FALSE(trouble.changed_by(ImageVerdict::fine));
}

}  // namespace
}  // namespace fovea::apps
