// SPDX-License-Identifier: MIT
//
// Recipes taught from rendered parts, and what they say of others. Host tests only.
//
// What teaches, gauges or looks for parts is compiled once, in commands_*.cpp.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fovea/base/random.hpp>
#include <gauge/teach.hpp>
#include <support/commands.hpp>
#include <support/parts.hpp>
#include <support/recipes.hpp>

namespace fovea::test {

/// A picture that shapes::plate() and its like fit into, however they are turned.
inline constexpr Size one_part_size{250, 250};

inline Scene back_light() {
    Scene light;
    light.noise = 2;
    return light;
}
inline Scene front_light() {
    Scene light = back_light();
    std::swap(light.dark, light.bright);
    return light;
}

namespace shapes {

/// plate() that is longer, or shorter, at the end with the smaller hole.
inline Shape longer_plate(double by) {
    const Shape extended = with(plate(), rectangle(20, 70), -80 - by, 0);
    return [=](double s, double t) { return s >= -90 - by && extended(s, t); };
}
inline Shape plate_without_its_small_hole() { return with(plate(), disc(11), -48, 4); }

}  // namespace shapes

/// One part near the middle of a picture.
inline apps::Picture<Gray8> lying(const Shape& shape, double degrees, std::uint64_t seed,
                                  const Scene& light = back_light()) {
    return picture_of(one_part_size, {{shape, 124.3, 125.8, degrees}}, light, seed);
}

apps::Taught taught_from(const std::vector<apps::Picture<Gray8>>& pictures,
                         const apps::TeachOptions& options = {});

/// The samples of a picture, which is kept for them.
apps::Samples samples_of(const apps::Picture<Gray8>& picture, std::optional<bool> dark = {});
/// Those of pictures with these names.
apps::Samples samples_in(const std::vector<apps::Picture<Gray8>>& pictures,
                         const std::vector<std::string>& names);
inline std::int64_t pixels_of(const apps::Sample& part) { return part.region.moments.area(); }

/// A picture for two parts, and the plate in one beside another object.
inline constexpr Size wide{460, 250};
inline apps::Picture<Gray8> plate_beside(const Shape& other) {
    return picture_of(wide, {{shapes::plate(), 115, 120, 5}, {other, 350, 120, 0}}, back_light(), 501);
}

/// "ok not_ok length:high": the verdicts of the parts in a picture, each with the features that are not OK.
inline std::string verdicts_of(const apps::Picture<Gray8>& picture, const Recipe& recipe) {
    std::vector<PartResult> parts;
    const Status status = gauge_parts(picture, recipe, parts);
    if (status != Status::ok) return describe(status);
    std::string text;
    for (const PartResult& part : parts) {
        text += (text.empty() ? "" : " ") + std::string(apps::word_of(part.verdict));
        for (int i = 0; i < part.feature_count; ++i)
            if (part.features[i].verdict != Verdict::ok)
                text +=
                    " " + name_text(recipe.features[i].name) + ":" + apps::word_of(part.features[i].verdict);
    }
    return text;
}

/// The names of the features in their order.
inline std::vector<std::string> feature_names(const Recipe& recipe) {
    std::vector<std::string> names;
    for (const Feature& feature : recipe.features) names.push_back(name_text(feature.name));
    return names;
}

/// A recipe that must be there.
inline Recipe recipe_of(const apps::Taught& taught) {
    EXPECT_EQ(taught.problem, "");
    EXPECT_EQ(taught.notes, std::vector<std::string>());
    return taught.recipe;
}

/// Sanitizers look for other faults than a wrong verdict, and take ten times as long: a few poses will do.
#if defined(__has_feature)
#define FOVEA_TEST_SANITIZED __has_feature(address_sanitizer)
#else
#define FOVEA_TEST_SANITIZED 0
#endif
inline constexpr int accepted_poses = FOVEA_TEST_SANITIZED ? 5 : 20;

/// Renders the part twenty times (accepted_poses), turned up to so far to each side, and expects that it is
/// always OK.
inline void accepts_in_twenty_poses(const Recipe& recipe, const Shape& shape, double most_degrees,
                                    std::uint64_t seed, const Scene& light = back_light(),
                                    double stretch_y = 1) {
    Random random(seed);
    for (int i = 0; i < 20; i += 20 / accepted_poses) {
        const Lying part{shape, 125 + uniform(random, -6, 6), 125 + uniform(random, -6, 6),
                         uniform(random, -most_degrees, most_degrees), stretch_y};
        EXPECT_EQ(verdicts_of(picture_of(one_part_size, {part}, light, random.next()), recipe), "ok")
            << "seed " << seed << ", pose " << i << ": " << part.x << ", " << part.y << ", " << part.degrees;
    }
}

}  // namespace fovea::test
