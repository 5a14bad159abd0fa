// SPDX-License-Identifier: MIT
//
// What gauge() does with what it cannot measure: hostile recipes, odd images, too little room.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <fovea/decision/gauge.hpp>
#include <support/recipes.hpp>
#include <support/render.hpp>

namespace fovea::test {
namespace {

constexpr std::int64_t px = 1000000;
constexpr PartPoint at(std::int64_t x, std::int64_t y) { return {x * px, y * px}; }

struct Gauged {
    Status status = Status::ok;
    std::vector<PartResult> parts;
};

/// The list holds a part of this area before the call: that of the picture before.
constexpr std::int64_t old_area = -5;

Gauged gauge_in(ImageView<const Gray8> image, const Recipe& recipe, Span<std::uint8_t> scratch,
                int capacity) {
    Gauged gauged;
    gauged.parts.resize(static_cast<std::size_t>(capacity));
    if (capacity > 0) gauged.parts[0].area = old_area;
    int count = capacity > 0 ? 1 : 0;
    gauged.status =
        gauge(image, recipe, scratch, ListView<PartResult>(gauged.parts.data(), capacity, &count));
    gauged.parts.resize(static_cast<std::size_t>(count));
    return gauged;
}
Gauged run(ImageView<const Gray8> image, const Recipe& recipe, int capacity = 4) {
    std::vector<std::uint8_t> scratch(
        static_cast<std::size_t>(gauge_scratch(image.size(), recipe.locate, capacity)));
    return gauge_in(image, recipe, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}, capacity);
}
/// What gauge() refuses, the list being as it was.
Status refusal(ImageView<const Gray8> image, const Recipe& recipe) {
    const Gauged gauged = run(image, recipe);
    EXPECT_TRUE(gauged.parts.size() == 1 && gauged.parts[0].area == old_area);
    return gauged.status;
}

/// A dark upright plate of 40 x 20 px in an image of 64 x 48, with its middle at (x, 24).
void draw_plate(GuardedImage<Gray8>& image, int x) {
    for (int v = 14; v < 34; ++v)
        for (int u = x - 20; u < x + 20; ++u) image(u, v) = 30;
}
GuardedImage<Gray8> plate_picture() {
    GuardedImage<Gray8> image({64, 48});
    image.fill(Gray8{220});
    draw_plate(image, 32);
    return image;
}
/// Its length and height, 40 and 20 px, the height with a tolerance that it misses.
Recipe plate_recipe() {
    Recipe recipe;
    recipe.locate.orientation = OrientationRule::symmetric;
    Feature length;
    length.kind = FeatureKind::width;
    length.from = at(-28, 0);
    length.to = at(28, 0);
    length.lines = 5;
    length.tolerance = {Decimal::from_int(40), Decimal{10000}, Decimal{10000}};
    EXPECT_EQ(recipe.features.push(length), Status::ok);
    Feature height = length;
    height.from = at(0, -20);
    height.to = at(0, 20);
    height.tolerance.nominal = Decimal::from_int(21);
    EXPECT_EQ(recipe.features.push(height), Status::ok);
    return recipe;
}

TEST(GaugeVerdict, FollowsFromTheTolerances) {
    const GuardedImage<Gray8> image = plate_picture();
    Recipe recipe = plate_recipe();
    const Gauged gauged = run(image.view(), recipe);
    ASSERT_EQ(gauged.status, Status::ok);
    ASSERT_EQ(gauged.parts.size(), 1u);
    const PartResult& part = gauged.parts[0];
    EXPECT_EQ(part.area, 800);
    EXPECT_EQ(part.box, (Rectangle{12, 14, 40, 20}));
    EXPECT_EQ(part.features[0].measurement.value, Decimal::from_int(40));
    EXPECT_EQ(part.features[0].verdict, Verdict::ok);
    EXPECT_EQ(part.features[1].measurement.value, Decimal::from_int(20));
    EXPECT_EQ(part.features[1].verdict, Verdict::low);
    EXPECT_EQ(part.verdict, Verdict::not_ok);
}

TEST(GaugeVerdict, IsUnmeasuredWhenOneFeatureIs) {
    const GuardedImage<Gray8> image = plate_picture();
    Recipe recipe = plate_recipe();
    recipe.features[1].to = at(0, 200);
    const PartResult part = run(image.view(), recipe).parts.at(0);
    EXPECT_EQ(part.features[0].verdict, Verdict::ok);
    EXPECT_EQ(part.features[1].status, Status::out_of_range);
    EXPECT_EQ(part.features[1].verdict, Verdict::unmeasured);
    EXPECT_EQ(part.verdict, Verdict::unmeasured);
}

TEST(GaugeVerdict, IsUnmeasuredWhileTheOrientationIsNotCertain) {
    const GuardedImage<Gray8> image = plate_picture();
    Recipe recipe = plate_recipe();
    recipe.locate.orientation = OrientationRule::full;
    const PartResult part = run(image.view(), recipe).parts.at(0);
    EXPECT_EQ(part.pose.orientation, Status::undecided) << "a rectangle looks the same when turned by half";
    EXPECT_EQ(part.verdict, Verdict::unmeasured);
    ASSERT_EQ(part.feature_count, 2);
    for (const FeatureResult& result : {part.features[0], part.features[1]}) {
        EXPECT_EQ(result.status, Status::undecided);
        EXPECT_EQ(result.verdict, Verdict::unmeasured);
    }
}

TEST(GaugeVerdict, CountsHolesHoweverThePartLies) {
    const GuardedImage<Gray8> image = plate_picture();
    Recipe recipe = plate_recipe();
    recipe.locate.orientation = OrientationRule::full;
    Feature holes;
    holes.kind = FeatureKind::hole_count;
    ASSERT_EQ(recipe.features.push(holes), Status::ok);
    const PartResult part = run(image.view(), recipe).parts.at(0);
    EXPECT_EQ(part.features[2].verdict, Verdict::ok);
    EXPECT_EQ(part.verdict, Verdict::unmeasured) << "the rest is not measured";
    recipe.features[2].tolerance.nominal = Decimal::from_int(1);
    const PartResult lacking = run(image.view(), recipe).parts.at(0);
    EXPECT_EQ(lacking.pose.orientation, Status::undecided);
    EXPECT_EQ(lacking.features[2].verdict, Verdict::low);
    EXPECT_EQ(lacking.verdict, Verdict::not_ok);
}

TEST(GaugeVerdict, IsNotOkByAnEdgeThatIsNotStraight) {
    GuardedImage<Gray8> image = plate_picture();
    Recipe recipe = plate_recipe();
    recipe.features[0].tolerance = {Decimal::from_int(40), Decimal::from_int(9), Decimal::from_int(9)};
    recipe.features[1].tolerance = recipe.features[0].tolerance;
    recipe.features[1].tolerance.nominal = Decimal::from_int(20);
    EXPECT_EQ(run(image.view(), recipe).parts.at(0).verdict, Verdict::ok);
    // A burr of 5 px under some of the lines.
    for (int y = 24; y < 28; ++y)
        for (int x = 52; x < 57; ++x) image(x, y) = image(30, 24);
    const PartResult part = run(image.view(), recipe).parts.at(0);
    EXPECT_EQ(part.features[0].status, Status::irregular);
    EXPECT_EQ(part.features[0].verdict, Verdict::unmeasured);
    EXPECT_EQ(part.verdict, Verdict::unmeasured);
    recipe.features[0].tolerance.nominal = Decimal::from_int(60);
    const PartResult small = run(image.view(), recipe).parts.at(0);
    EXPECT_EQ(small.features[0].verdict, Verdict::low) << "what is bad as well says more";
    EXPECT_EQ(small.features[0].status, Status::ok);
}

TEST(GaugeErrors, LeaveTheListAsItWas) {
    const GuardedImage<Gray8> image = plate_picture();
    EXPECT_EQ(refusal({}, plate_recipe()), Status::empty_image);
    GuardedImage<Gray8> even({9, 9});
    even.fill(Gray8{77});
    EXPECT_EQ(refusal(even.view(), plate_recipe()), Status::degenerate);
    const std::vector<Gray8> row(max_moment_side + 1);
    EXPECT_EQ(refusal({row.data(), {max_moment_side + 1, 1}, 0}, plate_recipe()), Status::image_too_large);
    EXPECT_EQ(refusal({row.data(), {1, max_moment_side + 1}, 1}, plate_recipe()), Status::image_too_large);
    for (const std::int64_t bad :
         {std::int64_t{0}, min_units_per_pixel - 1, max_units_per_pixel + 1, 4 * px + 1,
          std::numeric_limits<std::int64_t>::max(), std::numeric_limits<std::int64_t>::min()}) {
        Recipe recipe = plate_recipe();
        recipe.scale.x_per_pixel = bad;
        EXPECT_EQ(refusal(image.view(), recipe), Status::bad_argument) << bad;
        recipe.scale = {LengthUnit::pixel, px, bad};
        EXPECT_EQ(refusal(image.view(), recipe), Status::bad_argument) << bad;
    }
    Recipe recipe = plate_recipe();
    recipe.locate.ends.sst = Ratio::from_raw(2147483647);
    EXPECT_EQ(refusal(image.view(), recipe), Status::bad_argument);
}

TEST(GaugeErrors, NameTheImageAndTheRuleBeforeTheScratch) {
    const std::vector<Gray8> row(max_moment_side + 1);
    EXPECT_EQ(gauge_in({row.data(), {max_moment_side + 1, 1}, 0}, plate_recipe(), {}, 4).status,
              Status::image_too_large);
    const GuardedImage<Gray8> image = plate_picture();
    Recipe recipe = plate_recipe();
    recipe.locate.opening = 4;
    EXPECT_EQ(gauge_in(image.view(), recipe, {}, 4).status, Status::bad_argument);
    EXPECT_EQ(gauge_in(image.view(), plate_recipe(), {}, 4).status, Status::scratch_too_small);
}

TEST(GaugeErrors, ScratchIsEnoughToTheByteOrRefused) {
    const GuardedImage<Gray8> image = plate_picture();
    for (const int opening : {1, 3}) {
        Recipe recipe = plate_recipe();
        recipe.locate.opening = opening;
        const auto enough = static_cast<std::ptrdiff_t>(gauge_scratch(image.view().size(), recipe.locate, 4));
        bool measured = true;
        for (std::ptrdiff_t bytes = enough; bytes >= 0; bytes -= bytes > enough - 40 ? 1 : 97) {
            // On the heap without a byte to spare, and from an odd address.
            std::vector<std::uint8_t> scratch(static_cast<std::size_t>(bytes) + 1);
            const Gauged gauged = gauge_in(image.view(), recipe, {scratch.data() + 1, bytes}, 4);
            EXPECT_TRUE(gauged.status == Status::ok || bytes < enough);
            if (gauged.status == Status::ok) {
                EXPECT_TRUE(measured) << "it worked with less";
                EXPECT_EQ(gauged.parts.at(0).features[0].measurement.value, Decimal::from_int(40));
            } else {
                measured = false;
                EXPECT_EQ(gauged.status, Status::scratch_too_small) << bytes;
                EXPECT_EQ(gauged.parts.at(0).area, old_area);
            }
        }
        EXPECT_FALSE(measured);
    }
}

TEST(GaugeErrors, MorePartsThanRoomLeaveTheLargestMeasured) {
    GuardedImage<Gray8> image({230, 48});
    image.fill(Gray8{220});
    for (const int x : {32, 92, 152}) draw_plate(image, x);
    image(92, 14) = image(93, 14) = image(94, 14) = 220;
    for (int v = 20; v < 31; ++v)
        for (int u = 190; u < 215; ++u) image(u, v) = 30;
    const Recipe recipe = plate_recipe();
    const Gauged all = run(image.view(), recipe, 4);
    ASSERT_EQ(all.status, Status::ok);
    ASSERT_EQ(all.parts.size(), 4u);
    const Gauged two = run(image.view(), recipe, 2);
    EXPECT_EQ(two.status, Status::capacity_exceeded);
    ASSERT_EQ(two.parts.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(two.parts[i].area, 800);
        EXPECT_EQ(two.parts[i].box.x, i == 0 ? 12 : 132);
        EXPECT_EQ(two.parts[i].features[0].measurement.value, Decimal::from_int(40));
    }
    const Gauged none = run(image.view(), recipe, 0);
    EXPECT_EQ(none.status, Status::capacity_exceeded);
}

TEST(GaugeImages, OfAFewPixelsHoldNoPart) {
    Recipe recipe = plate_recipe();
    recipe.locate.threshold = ThresholdRule::fixed;
    for (const bool at_border : {false, true}) {
        recipe.locate.at_border = at_border;
        recipe.locate.area_min = 1;
        const Gray8 one[] = {7};
        EXPECT_EQ(refusal({one, {1, 1}, 1}, recipe), Status::degenerate);
        const Gray8 three[] = {220, 30, 220};
        for (const Size size : {Size{3, 1}, Size{1, 3}}) {
            const Gauged gauged = run({three, size, size.width}, recipe);
            EXPECT_EQ(gauged.status, Status::ok);
            EXPECT_EQ(gauged.parts.size(), at_border ? 1u : 0u);
            for (const PartResult& part : gauged.parts) EXPECT_EQ(part.verdict, Verdict::unmeasured);
        }
    }
}

TEST(GaugeImages, MayHaveAnyStride) {
    const GuardedImage<Gray8> image = plate_picture();
    const ImageView<const Gray8> view = image.view();
    // Bottom up, as BMP files are: the plate is its own mirror image.
    const ImageView<const Gray8> bottom_up(view.row(47), view.size(), -view.stride_bytes());
    const PartResult part = run(bottom_up, plate_recipe()).parts.at(0);
    EXPECT_EQ(part.features[0].measurement.value, Decimal::from_int(40));
    // Every row the same one.
    const ImageView<const Gray8> flat(view.row(20), view.size(), 0);
    EXPECT_EQ(run(flat, plate_recipe()).status, Status::ok);
    // One row needs no stride at all.
    const ImageView<const Gray8> row(view.row(20), {64, 1}, std::numeric_limits<std::ptrdiff_t>::max());
    EXPECT_EQ(run(row, plate_recipe()).status, Status::ok);
}

TEST(GaugeImages, OfNegativesGiveTheSame) {
    Random random(651);
    for (int round = 0; round < 10; ++round) {
        const double angle = uniform(random, 0, pi);
        const double c = std::cos(angle);
        const double s = std::sin(angle);
        Scene scene;
        scene.noise = 4;
        GuardedImage<Gray8> image = render({80, 80}, scene, random, [&](double x, double y) {
            const double u = (x - 40) * c + (y - 40) * s;
            const double v = (y - 40) * c - (x - 40) * s;
            return std::abs(u) < 20 && std::abs(v) < 10;
        });
        Recipe recipe = plate_recipe();
        recipe.locate.threshold = ThresholdRule::fixed;
        recipe.locate.level = 120;
        const PartResult dark = run(image.view(), recipe).parts.at(0);
        for (int y = 0; y < 80; ++y)
            for (int x = 0; x < 80; ++x) image(x, y) = static_cast<Gray8>(255 - image(x, y));
        recipe.locate.dark_part = false;
        recipe.locate.level = 256 - 120;
        const PartResult bright = run(image.view(), recipe).parts.at(0);
        EXPECT_EQ(dark.area, bright.area);
        EXPECT_EQ(dark.box, bright.box);
        EXPECT_EQ(dark.pose.frame.origin(), bright.pose.frame.origin());
        EXPECT_EQ(dark.pose.frame.angle(), bright.pose.frame.angle());
        for (int i = 0; i < 2; ++i) {
            ASSERT_EQ(dark.features[i].status, Status::ok);
            // Ties are rounded up in both, so a sample differs by at most 1/256 level from the other's
            // negative: of a slope of about 70 levels a pixel that is less than 1/10000 px for each of the
            // two edges.
            EXPECT_NEAR(static_cast<double>(dark.features[i].measurement.value.millionths),
                        static_cast<double>(bright.features[i].measurement.value.millionths), 200);
        }
    }
}

TEST(GaugeImages, TurnedByQuartersGiveTheSame) {
    const GuardedImage<Gray8> upright = plate_picture();
    GuardedImage<Gray8> turned({48, 64});
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x) turned(47 - y, x) = upright(x, y);
    const PartResult a = run(upright.view(), plate_recipe()).parts.at(0);
    const PartResult b = run(turned.view(), plate_recipe()).parts.at(0);
    EXPECT_EQ(a.area, b.area);
    EXPECT_EQ(b.pose.frame.angle() - a.pose.frame.angle(), FineAngle::quarter_turn());
    for (int i = 0; i < 2; ++i) EXPECT_EQ(a.features[i].measurement.value, b.features[i].measurement.value);
}

/// Any number, the ends of all types more often than others.
std::int64_t hostile(Random& random) {
    constexpr std::int64_t ends[] = {std::numeric_limits<std::int64_t>::min(),
                                     std::numeric_limits<std::int64_t>::max(),
                                     std::numeric_limits<std::int32_t>::min(),
                                     std::numeric_limits<std::int32_t>::max(),
                                     max_part_coordinate,
                                     -max_part_coordinate,
                                     0,
                                     -1};
    return ends[random.below(8)];
}
int hostile_int(Random& random) { return saturate_cast<int>(hostile(random)); }

/// A recipe of the plate with one to three fields that hold anything.
Recipe hostile_recipe(Random& random) {
    Recipe recipe = plate_recipe();
    LocateRule& rule = recipe.locate;
    for (int i = random.between(1, 3); i > 0; --i) {
        Feature& feature = recipe.features[random.between(0, 1)];
        feature.kind = static_cast<FeatureKind>(random.below(8));
        PartPoint* const places[] = {&feature.from, &feature.to, &feature.second_from, &feature.second_to,
                                     &feature.centre};
        std::int64_t* const lengths[] = {&feature.radius,
                                         &feature.search,
                                         &feature.tolerance.nominal.millionths,
                                         &feature.tolerance.minus.millionths,
                                         &feature.tolerance.plus.millionths,
                                         &recipe.scale.x_per_pixel,
                                         &recipe.scale.y_per_pixel,
                                         &rule.dark_quantile,
                                         &rule.bright_quantile,
                                         &rule.area_min,
                                         &rule.area_max,
                                         &rule.hole_area_min};
        int* const counts[] = {&feature.lines,        &feature.probes,     &feature.smoothing,
                               &feature.contrast_min, &feature.first_edge, &feature.second_edge,
                               &rule.opening,         &rule.symmetry_order};
        switch (random.below(5)) {
            case 0: places[random.below(5)]->x = hostile(random); break;
            case 1: places[random.below(5)]->y = hostile(random); break;
            case 2: *lengths[random.below(12)] = hostile(random); break;
            case 3: *counts[random.below(8)] = hostile_int(random); break;
            default:
                rule.ends.sss = Ratio::from_raw(hostile_int(random));
                rule.ends.ttt = Ratio::from_raw(hostile_int(random));
                rule.orientation = static_cast<OrientationRule>(random.below(5));
                rule.threshold = static_cast<ThresholdRule>(random.below(4));
                rule.pose = static_cast<PoseRule>(random.below(3));
                break;
        }
    }
    return recipe;
}

TEST(GaugeErrors, AnyRecipeGivesAStatusAndNoVerdictOnWhatIsNotMeasured) {
    Random random(652);
    const GuardedImage<Gray8> image = plate_picture();
    int refused = 0;
    int unmeasured = 0;
    for (int i = 0; i < 4000; ++i) {
        const Recipe recipe = hostile_recipe(random);
        const Gauged gauged = run(image.view(), recipe);
        if (gauged.status != Status::ok) {
            EXPECT_TRUE(gauged.status == Status::bad_argument || gauged.status == Status::degenerate);
            EXPECT_EQ(gauged.parts.at(0).area, old_area);
            ++refused;
            continue;
        }
        for (const PartResult& part : gauged.parts)
            for (int k = 0; k < part.feature_count; ++k) {
                const FeatureResult& result = part.features[k];
                unmeasured += result.status != Status::ok ? 1 : 0;
                EXPECT_EQ(result.status != Status::ok, result.verdict == Verdict::unmeasured);
                EXPECT_TRUE(result.status == Status::ok || part.verdict != Verdict::ok);
            }
    }
    EXPECT_GT(refused, 100);
    EXPECT_GT(unmeasured, 100);
}

}  // namespace
}  // namespace fovea::test
