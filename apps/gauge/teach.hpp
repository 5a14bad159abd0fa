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
#include <gauge/outline.hpp>
#include <gauge/report.hpp>
#include <gauge/samples.hpp>

namespace fovea::apps {

struct TeachOptions {
    std::string name;
    std::optional<bool> dark;                  ///< brightness of the part; found out if not given
    std::optional<std::int64_t> known_length;  ///< of the part along its axis, in nm
    std::optional<Scale> scale;                ///< in mm; pixels if not given
    std::optional<std::int64_t> tolerance;     ///< of every length, in millionths of the unit
};

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

/// Makes the features of a recipe, from the first sample, with nominal values from all.
class Proposer {
public:
    Proposer(Samples& samples, const LocateRule& rule, const Scale& scale, const TeachOptions& options)
        : samples_(samples), options_(options) {
        recipe_.locate = rule;
        recipe_.scale = scale;
        copy_name(recipe_.name, options.name);
        pixel_ = std::max(scale.x_per_pixel, scale.y_per_pixel);
    }

    /// Proposes twice: the first time finds out how blurred the edges are.
    Recipe propose() {
        for (const int start : {1, 4, 8}) {
            propose_with(start);
            if (blur_of_features().raw() > 0) break;
        }
        blur_ = blur_of_features();
        propose_with(1);
        return recipe_;
    }
    const std::vector<std::string>& notes() const { return notes_; }

    /// The values of a feature on every sample; empty if one of them has none.
    std::vector<std::int64_t> values_of(const Feature& feature) const {
        std::vector<std::int64_t> values;
        for (const Sample& sample : samples_.parts) {
            const Result<Measurement> found = measure(sample, feature);
            if (!found) return {};
            values.push_back(found->value.millionths);
        }
        return values;
    }

private:
    void propose_with(int smoothing) {
        recipe_.features.clear();
        notes_.clear();
        start_ = smoothing;
        propose_all();
    }
    /// The middle one of the blurs at the features of the first sample.
    SquarePixels blur_of_features() const {
        std::vector<SquarePixels> found;
        for (const Feature& feature : recipe_.features) {
            const Result<Measurement> measured = measure(samples_.parts.front(), feature);
            if (measured && measured->blur.raw() > 0) found.push_back(measured->blur);
        }
        if (found.empty()) return {};
        return median(Span<SquarePixels>(found.data(), static_cast<std::ptrdiff_t>(found.size())));
    }
    /// The largest power of two up to one and a half times the blur, and to an eighth of the length: the
    /// noise falls with it, but edges must not reach into each other.
    int smoothing_for(std::int64_t length) const {
        int smoothing = start_;
        while (smoothing < 8 &&
               blur_.raw() * 9 / 4 > SquarePixels::from_int(4 * smoothing * smoothing).raw() &&
               length > 16 * smoothing * pixel_)
            smoothing *= 2;
        return smoothing;
    }

    void propose_all() {
        const Sample& first = samples_.parts.front();
        outline_ = outline_of(first, frame_of(first));
        // No sample may reach beyond a probe that the first one sets.
        for (const Sample& sample : samples_.parts) {
            const Extent other = outline_of(sample, frame_of(sample)).extent;
            extent_.left = std::min(extent_.left, other.left);
            extent_.right = std::max(extent_.right, other.right);
            extent_.top = std::min(extent_.top, other.top);
            extent_.bottom = std::max(extent_.bottom, other.bottom);
        }
        edges_ = straight_edges(outline_, recipe_.scale);
        if (!propose_round()) {
            propose_parallel();
            if (!has_feature("length")) propose_length();
            if (!has_feature("width_1")) propose_widths();
            propose_angles();
        }
        propose_holes();
    }

    PartFrame frame_of(const Sample& sample) const {
        return pose_of(sample.moments, recipe_.locate, recipe_.scale).frame;
    }
    Result<Measurement> measure(const Sample& sample, const Feature& feature) const {
        std::vector<std::uint8_t> scratch(
            static_cast<std::size_t>(measure_feature_scratch(sample.image->size)));
        const PartView view{
            sample.image->view(), frame_of(sample),
            &sample.region,       {sample.holes.data(), static_cast<std::ptrdiff_t>(sample.holes.size())},
            recipe_.locate,       sample.threshold,
            recipe_.scale};
        return measure_feature(view, feature, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())});
    }

    /// The length between the edges of a feature, as far as it is known before it is measured.
    std::int64_t length_in(const Feature& feature) const {
        switch (feature.kind) {
            case FeatureKind::distance:
            case FeatureKind::width: return length_of(feature.to - feature.from) - 12 * pixel_;
            case FeatureKind::diameter: return 2 * feature.radius;
            case FeatureKind::hole_diameter: return 2 * feature.search;
            case FeatureKind::angle: return 4 * feature.search;
            case FeatureKind::hole_count:
            case FeatureKind::position: break;
        }
        return 0;
    }

    /// Adds a feature with its nominal value and tolerances, unless a sample refuses it.
    bool add(Feature feature, const std::string& name) {
        copy_name(feature.name, name);
        feature.smoothing = smoothing_for(length_in(feature));
        const std::vector<std::int64_t> values = values_of(feature);
        if (values.empty()) return false;
        std::int64_t sum = 0;
        for (const std::int64_t value : values) sum += value;
        const std::int64_t mean = round_divide(sum, static_cast<std::int64_t>(values.size()));
        std::int64_t spread = 0;
        for (const std::int64_t value : values) spread = std::max(spread, std::abs(value - mean));
        feature.tolerance = tolerance_of(feature, mean, spread);
        if (spread > 2 * pixel_ && feature.kind != FeatureKind::angle &&
            feature.kind != FeatureKind::hole_count)
            notes_.push_back(name + " differs by up to " +
                             number(Decimal{spread}, places_of(feature, recipe_.scale)) +
                             " from the mean of the good parts; its tolerance is three times that");
        return recipe_.features.push(feature) == Status::ok;
    }

    /// Half a pixel, or three times what the samples differ by; half a degree; none for a count.
    Tolerance tolerance_of(const Feature& feature, std::int64_t mean, std::int64_t spread) const {
        std::int64_t step = 1;
        for (int i = places_of(feature, recipe_.scale); i < 6; ++i) step *= 10;
        const auto up = [&](std::int64_t value) { return (value + step - 1) / step * step; };
        const std::int64_t least =
            feature.kind == FeatureKind::angle ? 500000 : options_.tolerance.value_or(pixel_ / 2);
        const std::int64_t wide = up(std::max(least, 3 * spread));
        Tolerance tolerance;
        if (feature.kind == FeatureKind::hole_count) return {{mean}, {}, {}};
        if (feature.kind == FeatureKind::position) return {{}, {}, {up(mean) + wide}};
        tolerance.nominal.millionths = round_divide(mean, step) * step;
        tolerance.minus.millionths = tolerance.plus.millionths = wide;
        return tolerance;
    }

    bool propose_round() {
        const Result<CircleFit> fit = circle_of(outline_, recipe_.scale);
        // Round: the contour stays within a fiftieth of the radius, two pixels at most.
        if (!fit || fit->rms > std::min(fine_ratio(fit->circle.radius, 50), FinePixel::from_int(2)))
            return false;
        Feature feature;
        feature.kind = FeatureKind::diameter;
        feature.centre = part_point(fit->circle.centre, recipe_.scale);
        feature.radius = multiply_divide(fit->circle.radius.raw(), recipe_.scale.x_per_pixel, FinePixel::one);
        feature.search = std::min(feature.radius / 3, 8 * pixel_);
        return add(feature, "diameter");
    }

    bool has_feature(const std::string& name) const {
        for (const Feature& feature : recipe_.features)
            if (text_of(feature.name) == name) return true;
        return false;
    }

    /// The probe square to two edges that face away from each other, in the middle of where they face;
    /// nothing if they do not.
    std::optional<Feature> between_parallel(const Stretch& one, const Stretch& two) const {
        const FineAngle along = one.direction();
        const std::int32_t off = (two.direction() - along - FineAngle::half_turn()).signed_raw();
        if (magnitude(off) > 0x00b60b61u) return {};  // one degree
        const UnitVector way = unit_vector(along);
        // Places along and across the first edge.
        const auto along_of = [&](PartPoint p) { return dot(p - one.from, way.x, way.y); };
        const auto across_of = [&](PartPoint p) { return dot(p - one.from, -way.y, way.x); };
        const std::int64_t first = std::max<std::int64_t>(0, along_of(two.to));
        const std::int64_t last = std::min(along_of(one.to), along_of(two.from));
        // The part lies to the right of its outline, clockwise on screen.
        const std::int64_t far_side = across_of(point_between(two.from, two.to, 1, 2));
        if (last - first < 20 * pixel_ || far_side < 4 * pixel_) return {};
        const auto place = [&](std::int64_t s, std::int64_t t) {
            return one.from + PartPoint{multiply_divide(s, way.x.raw(), Unit::one) -
                                            multiply_divide(t, way.y.raw(), Unit::one),
                                        multiply_divide(s, way.y.raw(), Unit::one) +
                                            multiply_divide(t, way.x.raw(), Unit::one)};
        };
        const std::int64_t margin = 6 * pixel_;
        Feature feature;
        feature.kind = FeatureKind::width;
        feature.from = place((first + last) / 2, -margin);
        feature.to = place((first + last) / 2, far_side + margin);
        feature.lines = static_cast<int>(std::clamp<std::int64_t>((last - first) / pixel_ / 2, 1, 25));
        feature.smoothing = smoothing_for(length_in(feature));
        return feature;
    }
    static std::int64_t dot(PartPoint vector, Unit x, Unit y) {
        return multiply_divide(vector.x, x.raw(), Unit::one) + multiply_divide(vector.y, y.raw(), Unit::one);
    }

    /// Distances between parallel edges: the longest within 45 degrees of the axis is the length, up to three
    /// others that differ are widths.
    void propose_parallel() {
        struct Found {
            Feature feature;
            std::int64_t value;
        };
        std::vector<Found> found;
        for (std::size_t i = 0; i < edges_.size(); ++i)
            for (std::size_t k = i + 1; k < edges_.size(); ++k) {
                const std::optional<Feature> feature = between_parallel(edges_[i], edges_[k]);
                const std::vector<std::int64_t> values =
                    feature ? values_of(*feature) : std::vector<std::int64_t>();
                if (!values.empty()) found.push_back({*feature, values[0]});
            }
        std::stable_sort(found.begin(), found.end(),
                         [](const Found& a, const Found& b) { return a.value > b.value; });
        int widths = 0;
        std::int64_t last = 0;
        for (const Found& each : found) {
            const PartPoint way = each.feature.to - each.feature.from;
            const bool along = std::abs(way.x) >= std::abs(way.y);
            if (along && !has_feature("length")) {
                add(each.feature, "length");
            } else if (widths < 3 && (widths == 0 || last - each.value > std::max(each.value / 50, pixel_))) {
                if (add(each.feature, "width_" + std::to_string(widths + 1))) ++widths;
                last = each.value;
            }
        }
    }

    /// A probe across the part at a share of its extent, along its axis or across it.
    Feature across_at(bool along_axis, int eighths) const {
        const Extent& box = extent_;
        const std::int64_t margin = 6 * pixel_;
        const std::int64_t x = (box.left + box.right) / 2 + (box.right - box.left) / 16 * eighths;
        const std::int64_t y = (box.top + box.bottom) / 2 + (box.bottom - box.top) / 16 * eighths;
        Feature feature;
        feature.kind = FeatureKind::width;
        feature.from = along_axis ? PartPoint{box.left - margin, y} : PartPoint{x, box.top - margin};
        feature.to = along_axis ? PartPoint{box.right + margin, y} : PartPoint{x, box.bottom + margin};
        feature.lines = 9;
        feature.smoothing = smoothing_for(length_in(feature));
        return feature;
    }
    /// How much the value changes when the probe moves two pixels sideways: 0 where both edges are square to
    /// it.
    std::optional<std::int64_t> slope_of(const Feature& feature) const {
        const PartPoint side = square_to(feature.to - feature.from, 2 * pixel_);
        Feature moved = feature;
        moved.from = feature.from + side;
        moved.to = feature.to + side;
        const Sample& first = samples_.parts.front();
        const Result<Measurement> here = measure(first, feature);
        const Result<Measurement> there = measure(first, moved);
        if (!here || !there) return {};
        return std::abs(here->value.millionths - there->value.millionths);
    }
    /// The candidates of a direction, the steadiest first; near the middle where they are alike.
    std::vector<Feature> candidates(bool along_axis) const {
        struct Rated {
            Feature feature;
            std::int64_t rating;
        };
        std::vector<Rated> rated;
        for (const int eighths : {0, -1, 1, -2, 2, -3, 3, -4, 4, -5, 5, -6, 6}) {
            const Feature feature = across_at(along_axis, eighths);
            const std::optional<std::int64_t> slope = slope_of(feature);
            if (slope) rated.push_back({feature, *slope + std::abs(eighths) * pixel_ / 40});
        }
        std::stable_sort(rated.begin(), rated.end(),
                         [](const Rated& a, const Rated& b) { return a.rating < b.rating; });
        std::vector<Feature> features;
        for (const Rated& each : rated) features.push_back(each.feature);
        return features;
    }

    void propose_length() {
        for (const Feature& feature : candidates(true))
            if (add(feature, "length")) return;
        notes_.push_back("no length: no probe along the axis meets an edge at both ends of every part");
    }

    /// Up to three widths that differ by a twentieth.
    void propose_widths() {
        std::vector<std::int64_t> taken;
        for (const Feature& feature : candidates(false)) {
            if (taken.size() == 3) break;
            const std::vector<std::int64_t> values = values_of(feature);
            if (values.empty()) continue;
            const bool known = std::any_of(taken.begin(), taken.end(), [&](std::int64_t other) {
                return std::abs(other - values[0]) < std::max(other, values[0]) / 20;
            });
            if (known || *slope_of(feature) > pixel_ / 4) continue;
            if (add(feature, "width_" + std::to_string(taken.size() + 1))) taken.push_back(values[0]);
        }
    }

    /// The first two corners between long straight edges.
    void propose_angles() {
        const std::vector<Stretch>& edges = edges_;
        int count = 0;
        for (std::size_t i = 0; i < edges.size() && count < 2; ++i) {
            const Stretch& one = edges[i];
            const Stretch& two = edges[(i + 1) % edges.size()];
            const std::int32_t corner = (two.direction() - one.direction()).signed_raw();
            // Between 15 and 165 degrees.
            if (magnitude(corner) < 0x0aaaaaaau || magnitude(corner) > 0x75555555u) continue;
            Feature feature;
            feature.kind = FeatureKind::angle;
            feature.from = one.from;
            feature.to = one.to;
            feature.second_from = two.from;
            feature.second_to = two.to;
            feature.search = 5 * pixel_;
            if (add(feature, "angle_" + std::to_string(count + 1))) ++count;
        }
    }

    void propose_holes() {
        const Sample& first = samples_.parts.front();
        Feature count;
        count.kind = FeatureKind::hole_count;
        add(count, "holes");
        int number = 0;
        for (const Hole& hole : first.holes) {
            if (number == 6) break;
            const Result<CentralMoments> moments =
                fine_moments(first.image->view(), first.threshold.part, hole);
            if (!moments) continue;
            ++number;
            Feature feature;
            feature.centre = frame_of(first).to_part(moments->centroid);
            feature.search =
                std::max<std::int64_t>(pixel_ * std::max(hole.box.width, hole.box.height) / 2, pixel_);
            feature.kind = FeatureKind::hole_diameter;
            const std::string name = "hole_" + std::to_string(number);
            const bool measured = !is_round(*moments) || add(feature, name);
            feature.kind = FeatureKind::position;
            if (!add(feature, name + "_position") || !measured)
                notes_.push_back(name + " is not found on every part");
        }
    }
    /// A disc of area A has second moments of A^2 / 2 pi together; any other shape has more.
    static bool is_round(const CentralMoments& moments) {
        const std::int64_t sum = (moments.mu20 + moments.mu02).raw() / SecondMoment::one;
        return Int128::product(sum, 710) < Int128::product(moments.area * 119 / 100, moments.area * 113);
    }

    Samples& samples_;
    const TeachOptions& options_;
    Recipe recipe_;
    Outline outline_;
    Extent extent_;  ///< of all samples
    std::vector<Stretch> edges_;
    std::int64_t pixel_ = 0;
    SquarePixels blur_;  ///< of the edges, once it is known
    int start_ = 1;      ///< the least smoothing
    std::vector<std::string> notes_;
};

/// The scale that makes the length of every sample the known one: along rows and columns apart where the
/// samples lie in different directions, one for both where they do not.
inline std::optional<Scale> scale_from(const Samples& samples, const std::vector<std::int64_t>& lengths,
                                       std::int64_t known_length) {
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
        const std::int64_t cosine = unit_vector(samples.parts[i].axis).x.raw() >> 16;
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

}  // namespace detail

inline Taught teach(const std::vector<Picture<Gray8>>& images, const std::vector<std::string>& names,
                    const TeachOptions& options) {
    Taught taught;
    taught.samples = find_samples(images, names, options.dark);
    if (taught.samples.parts.empty()) {
        taught.problem = taught.samples.problem;
        return taught;
    }
    taught.notes = taught.samples.notes;
    Scale scale = options.scale.value_or(Scale());
    LocateRule rule = rule_from(taught.samples, scale);
    if (options.known_length) {
        detail::Proposer in_pixels(taught.samples, rule, Scale(), options);
        const Recipe recipe = in_pixels.propose();
        const Feature* length = recipe.features.empty() ? nullptr : &recipe.features[0];
        const bool usable = length != nullptr &&
                            (length->kind == FeatureKind::width || length->kind == FeatureKind::diameter);
        const std::vector<std::int64_t> lengths =
            usable ? in_pixels.values_of(*length) : std::vector<std::int64_t>();
        const std::optional<Scale> found =
            lengths.empty() ? std::nullopt
                            : detail::scale_from(taught.samples, lengths, *options.known_length);
        if (!found) {
            taught.problem =
                "the known length gives no scale: the part's length cannot be measured, or a pixel would "
                "be below 10 nm or above 100 mm";
            return taught;
        }
        scale = *found;
        rule = rule_from(taught.samples, scale);
    }
    detail::Proposer proposer(taught.samples, rule, scale, options);
    taught.recipe = proposer.propose();
    taught.notes.insert(taught.notes.end(), proposer.notes().begin(), proposer.notes().end());
    return taught;
}

}  // namespace fovea::apps
