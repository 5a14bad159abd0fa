// SPDX-License-Identifier: MIT
//
// Teaching: proposes a recipe from pictures of good parts. What it proposes is what it could measure on every
// one of them.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <fovea/decision/gauge.hpp>
#include <fovea/decision/recipe.hpp>

#include <common/picture_file.hpp>
#include <gauge/proposer.hpp>
#include <gauge/sample_rule.hpp>
#include <gauge/samples.hpp>

namespace fovea::apps {

/// A proposal, and what there is to say about it.
struct Taught {
    Recipe recipe;
    Samples samples;
    std::vector<std::string> notes;
    std::string problem;  ///< "" if there is a recipe
};

/// Proposes a recipe from pictures. names are for the notes.
Taught teach(const std::vector<Picture<Gray8>>& images, const std::vector<std::string>& names,
             const TeachOptions& options);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// The scale that makes lengths in pixels the known one: along rows and columns apart where they were
/// measured in different directions, one for both where they were not.
inline std::optional<Scale> scale_from(const std::vector<std::int64_t>& lengths,
                                       const std::vector<FineAngle>& directions, std::int64_t known_length) {
    // (known / length)^2 = x^2 cos^2 + y^2 sin^2, linear in x^2 and y^2: normal equations in 2^-14.
    constexpr std::int64_t one = 1 << 14;
    std::int64_t cc = 0;
    std::int64_t cs = 0;
    std::int64_t ss = 0;
    Int128 qc;
    Int128 qs;
    Int128 q_sum;
    for (std::size_t i = 0; i < lengths.size(); ++i) {
        const std::int64_t per_pixel = multiply_divide(known_length, 1000000, lengths[i]);
        if (per_pixel < min_units_per_pixel || per_pixel > max_units_per_pixel) return {};
        const std::int64_t cosine = unit_vector(directions[i]).x.raw() >> 16;
        const std::int64_t c = cosine * cosine >> 14;
        const std::int64_t s = one - c;
        cc += c * c;
        cs += c * s;
        ss += s * s;
        qc += Int128::product(per_pixel * per_pixel, c);
        qs += Int128::product(per_pixel * per_pixel, s);
        q_sum += Int128::product(per_pixel, per_pixel);
    }
    const auto count = static_cast<std::int64_t>(lengths.size());
    const Int128 determinant = Int128::product(cc, ss) - Int128::product(cs, cs);
    const auto root = [](std::int64_t square) {
        return static_cast<std::int64_t>(
            isqrt(static_cast<std::uint64_t>(std::max<std::int64_t>(square, 1))));
    };
    Scale scale;
    scale.unit = LengthUnit::millimetre;
    // Apart only if the determinant is a twentieth of what two directions at right angles have.
    const Int128 full = Int128::product(one * one * count / 2, one * one * count / 2);
    if (determinant * 20 < full) {
        scale.x_per_pixel = scale.y_per_pixel = root(round_divide(q_sum, Int128(count)));
    } else {
        scale.x_per_pixel = root(round_divide((qc * ss - qs * cs) << 14, determinant));
        scale.y_per_pixel = root(round_divide((qs * cc - qc * cs) << 14, determinant));
    }
    if (!scale_in_range(scale)) return {};
    return scale;
}

/// True if a scale makes every length the known one, to a hundredth and to the last place of a scale.
inline bool explains(const Scale& scale, const std::vector<std::int64_t>& lengths,
                     const std::vector<FineAngle>& directions, std::int64_t known_length) {
    for (std::size_t i = 0; i < lengths.size(); ++i) {
        const UnitVector way = unit_vector(directions[i]);
        const std::int64_t per_pixel = hypotenuse(multiply_divide(scale.x_per_pixel, way.x.raw(), Unit::one),
                                                  multiply_divide(scale.y_per_pixel, way.y.raw(), Unit::one));
        const std::int64_t wanted = multiply_divide(known_length, 1000000, lengths[i]);
        if (std::abs(per_pixel - wanted) > wanted / 100 + 1) return false;
    }
    return true;
}

inline constexpr const char* lengths_disagree =
    "--known-length gives no scale: the part is not equally long in all pictures, or its axis lies "
    "otherwise; "
    "give --mm-per-px";

/// By how much a scale must grow along rows and columns for the samples to have their known length; problem
/// says why that is not known.
inline std::optional<Scale> growth_to_known_length(const Samples& samples, const TeachOptions& options,
                                                   const Scale& scale, std::string& problem) {
    Proposer proposer(samples, rule_from(samples, scale), scale, options);
    proposer.keep_all();
    const Recipe recipe = proposer.propose();
    for (const Feature& feature : recipe.features) {
        const bool round = text_of(feature.name) == "diameter";
        if (!round && text_of(feature.name) != "length") continue;
        const std::vector<std::int64_t> lengths = proposer.meter().values_of(feature);
        // A diameter has no direction: with the same one everywhere there is one scale for rows and columns.
        const std::vector<FineAngle> directions =
            round ? std::vector<FineAngle>(lengths.size()) : proposer.meter().directions_of(feature);
        const std::optional<Scale> growth = scale_from(lengths, directions, *options.known_length);
        if (!growth)
            problem =
                "--known-length gives no scale: a pixel would be below 10 nm or above 100 mm, or four times "
                "as long one way as the other";
        if (growth && !explains(*growth, lengths, directions, *options.known_length)) {
            problem = lengths_disagree;
            return {};
        }
        return growth;
    }
    problem =
        "--known-length gives no scale: no two edges are as far apart as the part is long; give --mm-per-px";
    return {};
}

/// The scale that follows from the known length of the samples; problem says why there is none.
///
/// Where rows and columns differ, the axis of a part is that of its squeezed picture until the scale is
/// known, and with it what its length is: it is measured again with every scale that was found, until that
/// stays.
inline std::optional<Scale> scale_of_known_length(const Samples& samples, const TeachOptions& options,
                                                  std::string& problem) {
    constexpr int most_rounds = 6;
    Scale scale;
    for (int round = 0; round < most_rounds; ++round) {
        const std::optional<Scale> growth = growth_to_known_length(samples, options, scale, problem);
        if (!growth) return {};
        scale.unit = growth->unit;
        scale.x_per_pixel = multiply_divide(scale.x_per_pixel, growth->x_per_pixel, 1000000);
        scale.y_per_pixel = multiply_divide(scale.y_per_pixel, growth->y_per_pixel, 1000000);
        const auto small = [](std::int64_t millionths) { return std::abs(millionths - 1000000) < 500; };
        if (scale.x_per_pixel == scale.y_per_pixel) return scale;
        if (small(growth->x_per_pixel) && small(growth->y_per_pixel)) return scale;
        if (!scale_in_range(scale)) break;
    }
    problem =
        "--known-length gives no scale: the axis of the part lies otherwise in every picture; give "
        "--mm-per-px";
    return {};
}

}  // namespace detail

inline Taught teach(const std::vector<Picture<Gray8>>& images, const std::vector<std::string>& names,
                    const TeachOptions& options) {
    Taught taught;
    taught.samples = find_samples(images, names, options.dark);
    taught.notes = taught.samples.notes;
    taught.problem = taught.samples.problem;
    if (taught.samples.parts.empty()) return taught;
    Scale scale = options.scale.value_or(Scale());
    if (options.known_length) {
        const std::optional<Scale> found =
            detail::scale_of_known_length(taught.samples, options, taught.problem);
        if (!found) return taught;
        scale = *found;
    }
    const LocateRule rule = rule_from(taught.samples, scale);
    const std::vector<std::int64_t>& others = taught.samples.other_areas;
    if (std::any_of(others.begin(), others.end(),
                    [&](std::int64_t area) { return area >= rule.area_min && area <= rule.area_max; }))
        taught.notes.push_back(
            "something in the pictures is as large as the part, but for holes, and will be taken for one");
    if (ends_disagree(taught.samples, rule, scale))
        taught.notes.push_back(
            "the ends of the good parts differ and are not told apart: is one of another kind, or turned "
            "over?");
    detail::Proposer proposer(taught.samples, rule, scale, options);
    taught.recipe = proposer.propose();
    taught.notes.insert(taught.notes.end(), proposer.notes().begin(), proposer.notes().end());
    if (taught.recipe.features.size() < 2) {
        const std::size_t count = taught.samples.parts.size();
        taught.problem =
            count == 1 ? "a part was found, but no edge on it can be measured: is it sharp, with 8 pixels of "
                         "ground around it?"
                       : std::to_string(count) +
                             " parts were found, but no edge can be measured on all of them: are they of one "
                             "kind, sharp, with 8 pixels of ground around each?";
    }
    return taught;
}

}  // namespace fovea::apps
