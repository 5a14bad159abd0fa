// SPDX-License-Identifier: MIT
//
// What the gauge says of a part: one line for people, one JSON object for machines.
#pragma once

#include <string>

#include <fovea/decision/gauge.hpp>
#include <fovea/decision/recipe.hpp>

#include <common/text.hpp>
#include <common/verdicts.hpp>
#include <gauge/recipe_schema.hpp>

namespace fovea::apps {

/// The unit of a feature's value; "" for a number.
inline std::string unit_of(const Feature& feature, const Scale& scale) {
    if (feature.kind == FeatureKind::angle) return "deg";
    if (feature.kind == FeatureKind::hole_count) return "";
    return scale.unit == LengthUnit::millimetre ? "mm" : "px";
}

/// Places that show a hundredth of a pixel, and two of an angle.
inline int places_of(const Feature& feature, const Scale& scale) {
    if (feature.kind == FeatureKind::hole_count) return 0;
    if (feature.kind == FeatureKind::angle) return 2;
    int places = 0;
    for (std::int64_t step = 1000000; step > scale.x_per_pixel / 100 && places < 6; step /= 10) ++places;
    return places;
}

/// The standard deviation of a variance.
inline FinePixel root_of(SquarePixels variance) {
    return FinePixel::from_raw(
        static_cast<std::int32_t>(isqrt(static_cast<std::uint64_t>(variance.raw()) << 16)));
}

/// "OK", "NOT OK" or "NOT JUDGED".
inline const char* human_verdict(Verdict part) {
    return part == Verdict::ok ? "OK" : part == Verdict::unmeasured ? "NOT JUDGED" : "NOT OK";
}

/// A limit of a tolerance; that of a count is shown as it was given.
inline std::string shown_limit(Decimal value, const Feature& feature, int places) {
    return feature.kind == FeatureKind::hole_count ? shortest(value) : number(value, places);
}

/// Why a part has no direction, and so no value for any of its features; "" if it has one.
inline std::string orientation_problem(Status orientation) {
    switch (orientation) {
        case Status::ok: return "";
        case Status::undecided: return "which end of the part is which is undecided";
        case Status::degenerate: return "the part has no clear axis";
        default: return describe(orientation);
    }
}

/// The same for a line that has little room.
inline const char* short_orientation_problem(Status orientation) {
    return orientation == Status::ok          ? ""
           : orientation == Status::undecided ? "ends undecided"
                                              : "no clear axis";
}

/// Why a feature has no value, for people.
inline std::string reason_of(const FeatureResult& result, const Feature& feature) {
    switch (result.status) {
        case Status::undecided: return "which end of the part is which is undecided";
        case Status::out_of_range: return "the probe leaves the image";
        case Status::degenerate: return "no line or circle follows from the edges that were found";
        case Status::capacity_exceeded: return "too many edges along the probe";
        case Status::bad_argument: return "the probe is shorter than a pixel";
        case Status::irregular:
            return feature.kind == FeatureKind::diameter || feature.kind == FeatureKind::hole_diameter
                       ? "the edge is not round: more probes than `outliers` allows miss the circle"
                       : "the edge is not straight over the `lines` of the probe: a burr, a nick or a curve?";
        case Status::not_found: break;
        default: return describe(result.status);
    }
    switch (feature.kind) {
        case FeatureKind::distance: return "fewer edges than asked for along the probe";
        case FeatureKind::width:
            return "no edge strong enough along the probe: is it out of focus, or does it not cross the "
                   "part?";
        case FeatureKind::diameter:
        case FeatureKind::angle: return "less than half of the probes agree on an edge";
        case FeatureKind::hole_diameter: return "no round hole within `search` of `centre`";
        case FeatureKind::position: return "no hole within `search` of `centre`";
        case FeatureKind::hole_count: break;
    }
    return "nothing found";
}

/// The same of a feature of a part, whose direction may be the reason.
inline std::string reason_of(const PartResult& part, int feature, const Recipe& recipe) {
    const std::string problem = orientation_problem(part.pose.orientation);
    return problem.empty() ? reason_of(part.features[feature], recipe.features[feature]) : problem;
}

/// "length 40.003 mm", with what is wrong behind it. Why something was not measured stands elsewhere.
inline std::string human_feature(const FeatureResult& result, const Feature& feature, const Scale& scale) {
    const std::string name = detail::text_of(feature.name);
    if (result.status != Status::ok) return name + " NOT MEASURED";
    const Decimal value = result.measurement.value;
    const Tolerance& tolerance = feature.tolerance;
    const bool low = result.verdict == Verdict::low;
    const bool high = result.verdict == Verdict::high;
    const Decimal bound = low ? tolerance.nominal - tolerance.minus : tolerance.nominal + tolerance.plus;
    int places = places_of(feature, scale);
    // As many more as it takes to see that it is out.
    while ((low || high) && places < 6 && number(value, places) == shown_limit(bound, feature, places))
        ++places;
    const std::string unit = unit_of(feature, scale);
    std::string text = name + " " + number(value, places) + (unit.empty() ? "" : " ") + unit;
    if (low) text += " LOW (least " + shown_limit(bound, feature, places) + ")";
    if (high) text += " HIGH (most " + shown_limit(bound, feature, places) + ")";
    return text;
}

/// The line of a part: first the features that are not OK, then the others, both in the order of the recipe.
inline std::string human_part(const std::string& image, int index, const PartResult& part,
                              const Recipe& recipe) {
    std::string text =
        one_line(image) + " part " + std::to_string(index) + ": " + human_verdict(part.verdict);
    const Status orientation = part.pose.orientation;
    if (orientation != Status::ok) text += std::string(" (") + short_orientation_problem(orientation) + ")";
    const char* before = "  ";
    for (const bool ok : {false, true})
        for (int i = 0; i < part.feature_count; ++i) {
            // Without direction only what has none is measured, and the reason stands in front.
            if (orientation != Status::ok && part.features[i].status != Status::ok) continue;
            if ((part.features[i].verdict == Verdict::ok) != ok) continue;
            text += before + human_feature(part.features[i], recipe.features[i], recipe.scale);
            before = ", ";
        }
    const PartFrame& frame = part.pose.frame;
    text += "  [x " + number(decimal_of(frame.origin().x), 2) + ", y " +
            number(decimal_of(frame.origin().y), 2) + " px, " + number(decimal_of(frame.angle()), 2) +
            " deg]";
    return text + "\n";
}

/// One JSON object on a line, its keys always in this order. left_out counts the regions of the image that
/// were not measured.
inline std::string json_part(const std::string& image, int index, std::size_t left_out,
                             const PartResult& part, const Recipe& recipe) {
    const PartFrame& frame = part.pose.frame;
    std::string text = "{\"image\":" + json_string(image) + ",\"part\":" + std::to_string(index) +
                       ",\"x\":" + number(decimal_of(frame.origin().x), 3) +
                       ",\"y\":" + number(decimal_of(frame.origin().y), 3) +
                       ",\"angle_deg\":" + number(decimal_of(frame.angle()), 4) +
                       ",\"flip_confident\":" + (part.pose.ends_certain ? "true" : "false") +
                       ",\"flip_margin\":" + number(decimal_of(part.pose.margin), 3) +
                       ",\"area_px\":" + std::to_string(part.area) +
                       ",\"holes\":" + std::to_string(part.holes) +
                       ",\"left_out\":" + std::to_string(left_out) + ",\"features\":[";
    for (int i = 0; i < part.feature_count; ++i) {
        const Feature& feature = recipe.features[i];
        const FeatureResult& result = part.features[i];
        const int places = feature.kind == FeatureKind::hole_count ? 0 : 6;
        const bool measured = result.status == Status::ok;
        text += (i == 0 ? "{\"name\":" : ",{\"name\":") + json_string(detail::text_of(feature.name)) +
                ",\"value\":" + (measured ? number(result.measurement.value, places) : "null") +
                ",\"unit\":" + json_string(unit_of(feature, recipe.scale)) +
                ",\"nominal\":" + shown_limit(feature.tolerance.nominal, feature, places) +
                ",\"minus\":" + shown_limit(feature.tolerance.minus, feature, places) +
                ",\"plus\":" + shown_limit(feature.tolerance.plus, feature, places) + ",\"verdict\":\"" +
                word_of(result.verdict) + "\"";
        if (measured && result.measurement.blur.raw() > 0)
            text += ",\"blur_px\":" + number(decimal_of(root_of(result.measurement.blur)), 2);
        if (!measured) text += ",\"reason\":" + json_string(reason_of(part, i, recipe));
        text += "}";
    }
    return text + "],\"verdict\":\"" + word_of(part.verdict) + "\"}\n";
}

/// The line of an image in which no part was judged; the problem does not name the image again.
inline std::string json_no_part(const std::string& image, std::size_t left_out, const std::string& problem) {
    return "{\"image\":" + json_string(image) + ",\"part\":null,\"left_out\":" + std::to_string(left_out) +
           ",\"error\":" + json_string(problem) + ",\"verdict\":\"unmeasured\"}\n";
}

}  // namespace fovea::apps
