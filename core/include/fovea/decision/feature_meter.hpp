// SPDX-License-Identifier: MIT
//
// FeatureMeter: the probes of one feature, the points they find, and what is made of these.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/base/list.hpp>
#include <fovea/base/order.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/decision/locate.hpp>
#include <fovea/decision/part_frame.hpp>
#include <fovea/decision/recipe.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/measure/edge_probe.hpp>
#include <fovea/measure/edge_straightness.hpp>
#include <fovea/measure/fit_circle.hpp>
#include <fovea/measure/fit_line.hpp>
#include <fovea/number/angle.hpp>
#include <fovea/number/decimal.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/int128.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/number/trigonometry.hpp>
#include <fovea/segment/connected_components.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// What was measured, and where in the image: the two edges of a distance or width; centre and nothing more
/// of a circle; the ends of both lines of an angle; the hole and the expected place of a position.
struct Measurement {
    static constexpr int max_marks = 4;

    Decimal value;      ///< in the unit of the recipe; degrees of an angle; a number of holes
    SquarePixels blur;  ///< variance of the blur across the edges that were used; 0 where there are none
    FinePoint marks[max_marks];
    std::uint8_t mark_count = 0;
    bool regular =
        true;  ///< the edges are as straight or as round as what is measured, see measure_feature()
};

/// A located part in its image.
struct PartView {
    ImageView<const Gray8> image;
    PartFrame frame;
    const Region* region = nullptr;
    Span<const Hole> holes;  ///< of all parts
    LocateRule rule;
    Threshold threshold;
    Scale scale;
};

// ---- Implementation ---------------------------------------------------------------

namespace detail {

inline constexpr int max_probe_edges = 64;

/// One feature of one part: the probes, the points they find, and what is made of these.
class FeatureMeter {
public:
    FeatureMeter(const PartView& part, const Feature& feature, Span<std::uint8_t> scratch)
        : part_(part), feature_(feature), aspect_(aspect_of(part.scale)) {
        Arena arena(scratch);
        profile_ = arena.take<std::uint16_t>(edge_probe_scratch(part.image.size()));
        edges_ = arena.take<Edge>(max_probe_edges);
        points_ = arena.take<FinePoint>(Feature::max_probes);
        residuals_ = arena.take<FinePixel>(Feature::max_probes);
        blurs_ = arena.take<SquarePixels>(Feature::max_probes);
    }

    Result<Measurement> distance();
    Result<Measurement> width();
    Result<Measurement> circle(PartPoint centre, std::int64_t radius, std::int64_t reach);
    Result<Measurement> hole_diameter();
    Result<Measurement> position();
    Result<Measurement> angle();
    Result<Measurement> hole_count();

private:
    GrayLevel strength_min() const;
    Result<Span<const Edge>> probe(PartPoint from, PartPoint to, int lines);
    Result<const Edge*> strongest(PartPoint from, PartPoint to);
    Result<EdgeProbe> line_probe(PartPoint from, PartPoint to, int lines) const;
    Result<Measurement> between_edges(const Edge& first, const Edge& second);
    Result<bool> is_straight(const Edge& edge);
    FinePixel most_stray() const { return FinePixel::from_int(feature_.smoothing); }
    FinePixel most_off_circle();
    Status collect_point(const Edge& edge, PartPoint from, PartPoint to);
    Result<CircleFit> probe_circle(PartPoint centre, std::int64_t radius, std::int64_t reach);
    Result<FineAngle> probe_line(PartPoint from, PartPoint to, Measurement& marks);
    Result<CentralMoments> nearest_hole() const;
    /// In an image whose rows are as far apart as its columns, and back.
    FinePoint squared(FinePoint place) const {
        return {place.x, FinePixel::from_raw(saturate_cast<std::int32_t>(
                             multiply_divide(place.y.raw(), aspect_.raw(), PixelAspect::one)))};
    }
    FinePoint unsquared(FinePoint place) const {
        return {place.x, FinePixel::from_raw(saturate_cast<std::int32_t>(
                             multiply_divide(place.y.raw(), PixelAspect::one, aspect_.raw())))};
    }

    const PartView& part_;
    const Feature& feature_;
    PixelAspect aspect_;
    Span<std::uint16_t> profile_;
    Span<Edge> edges_;
    int edge_count_ = 0;
    Span<FinePoint> points_;
    Span<FinePixel> residuals_;
    Span<SquarePixels> blurs_;
    int point_count_ = 0;
    bool round_ = true;  ///< no more probes than allowed meet something else than the last circle
};

inline GrayLevel FeatureMeter::strength_min() const {
    if (feature_.contrast_min > 0) return GrayLevel::from_int(feature_.contrast_min);
    return maximum(GrayLevel::from_raw(part_.threshold.contrast.raw() / 4), GrayLevel::from_int(8));
}

inline Result<EdgeProbe> FeatureMeter::line_probe(PartPoint from, PartPoint to, int lines) const {
    const Result<FinePoint> start = part_.frame.to_image(from);
    const Result<FinePoint> end = part_.frame.to_image(to);
    // Parallel lines are as far apart as two columns.
    const Result<FinePoint> beside =
        part_.frame.to_image(from + square_to(to - from, part_.scale.x_per_pixel));
    if (!start || !end || !beside) return Status::out_of_range;
    return EdgeProbe{*start, *end, {beside->x - start->x, beside->y - start->y}, lines, feature_.smoothing};
}

inline Result<Span<const Edge>> FeatureMeter::probe(PartPoint from, PartPoint to, int lines) {
    const Result<EdgeProbe> line = line_probe(from, to, lines);
    if (!line) return line.status();
    ListView<Edge> edges(edges_.data(), max_probe_edges, &edge_count_);
    if (Status s = edge_probe(part_.image, *line, strength_min(), profile_, edges); s != Status::ok) return s;
    return Span<const Edge>(edges.span());
}

inline Result<const Edge*> FeatureMeter::strongest(PartPoint from, PartPoint to) {
    const Result<Span<const Edge>> edges = probe(from, to, 1);
    if (!edges) return edges.status();
    const Edge* best = nullptr;
    for (const Edge& edge : *edges)
        if (best == nullptr || magnitude(edge.strength.raw()) > magnitude(best->strength.raw())) best = &edge;
    if (best == nullptr) return Status::not_found;
    return best;
}

/// True if the lines of the probe all meet a straight edge. Overwrites the list of edges.
inline Result<bool> FeatureMeter::is_straight(const Edge& edge) {
    const Result<EdgeProbe> line = line_probe(feature_.from, feature_.to, feature_.lines);
    if (!line) return line.status();
    const ListView<Edge> edges(edges_.data(), max_probe_edges, &edge_count_);
    const Result<FinePixel> stray = edge_straightness(part_.image, *line, edge, profile_, edges);
    if (!stray) return stray.status();
    return *stray <= most_stray();
}

inline Result<Measurement> FeatureMeter::between_edges(const Edge& first, const Edge& second) {
    Measurement result;
    const std::int64_t share = std::int64_t{second.share.raw()} - first.share.raw();
    const std::int64_t length = length_of(feature_.to - feature_.from);
    result.value.millionths = multiply_divide(length, share < 0 ? -share : share, Unit::one);
    result.blur = SquarePixels::from_raw(first.blur.raw() / 2 + second.blur.raw() / 2);
    result.marks[0] = first.place;
    result.marks[1] = second.place;
    result.mark_count = 2;
    const Edge pair[] = {first, second};
    for (const Edge& edge : pair) {
        const Result<bool> straight = is_straight(edge);
        if (!straight) return straight.status();
        result.regular = result.regular && *straight;
    }
    return result;
}

inline Result<Measurement> FeatureMeter::distance() {
    if (feature_.first_edge == 0 || feature_.second_edge == 0) return Status::bad_argument;
    const Result<Span<const Edge>> edges = probe(feature_.from, feature_.to, feature_.lines);
    if (!edges) return edges.status();
    const auto place = [&](int number) { return number > 0 ? number - 1 : edges->size() + number; };
    const std::ptrdiff_t first = place(feature_.first_edge);
    const std::ptrdiff_t second = place(feature_.second_edge);
    if (first < 0 || second < 0 || first >= edges->size() || second >= edges->size() || first == second)
        return Status::not_found;
    return between_edges((*edges)[first], (*edges)[second]);
}

inline Result<Measurement> FeatureMeter::width() {
    const Result<Span<const Edge>> edges = probe(feature_.from, feature_.to, feature_.lines);
    if (!edges) return edges.status();
    const auto enters = [&](const Edge& edge) { return (edge.strength.raw() < 0) == part_.rule.dark_part; };
    const Edge* first = nullptr;
    const Edge* last = nullptr;
    for (const Edge& edge : *edges) {
        if (first == nullptr && enters(edge)) first = &edge;
        if (first != nullptr && !enters(edge)) last = &edge;
    }
    if (first == nullptr || last == nullptr) return Status::not_found;
    return between_edges(*first, *last);
}

/// Keeps the place of an edge for a fit, and its blur in the lengths of the fit.
inline Status FeatureMeter::collect_point(const Edge& edge, PartPoint from, PartPoint to) {
    if (point_count_ >= Feature::max_probes) return Status::capacity_exceeded;
    const Result<FinePoint> start = part_.frame.to_image(from);
    const Result<FinePoint> end = part_.frame.to_image(to);
    if (!start || !end) return Status::out_of_range;
    const std::int64_t in_image = Offset(*start, *end).length();
    const std::int64_t in_fit = Offset(squared(*start), squared(*end)).length();
    std::int64_t blur = multiply_divide(edge.blur.raw(), in_fit, maximum<std::int64_t>(in_image, 1));
    blur = multiply_divide(blur, in_fit, maximum<std::int64_t>(in_image, 1));
    points_[point_count_] = squared(edge.place);
    blurs_[point_count_] = SquarePixels::from_raw(saturate_cast<std::int32_t>(blur));
    ++point_count_;
    return Status::ok;
}

/// How far a point may be off its circle: `smoothing` pixels, and up to three times as much where four
/// deviations of the noise are more. The noise follows from the differences of neighbours, which do not see
/// what changes slowly along the edge: 4 * 1.4826 / sqrt(2) times their median.
inline FinePixel FeatureMeter::most_off_circle() {
    const Span<const FinePoint> points = points_.first(point_count_);
    const Result<CircleFit> all = fit_circle(points);
    if (!all) return most_stray();
    std::int64_t last = distance_from(all->circle, points[0]).raw();
    for (int i = 1; i < point_count_; ++i) {
        const std::int64_t here = distance_from(all->circle, points[i]).raw();
        const std::int64_t differs = here < last ? last - here : here - last;
        residuals_[i - 1] = FinePixel::from_raw(saturate_cast<std::int32_t>(differs));
        last = here;
    }
    const std::int64_t noise = std::int64_t{median(residuals_.first(point_count_ - 1)).raw()} * 419 / 100;
    const std::int64_t least = most_stray().raw();
    return FinePixel::from_raw(static_cast<std::int32_t>(clamp(noise, least, 3 * least)));
}

/// The circle through the strongest edges of radial probes, corrected for the blur.
inline Result<CircleFit> FeatureMeter::probe_circle(PartPoint centre, std::int64_t radius,
                                                    std::int64_t reach) {
    point_count_ = 0;
    const std::int64_t inner = maximum(radius - reach, radius / 4);
    for (int i = 0; i < feature_.probes; ++i) {
        const std::int64_t turn = (std::int64_t{1} << 32) * i / feature_.probes;
        const UnitVector way = unit_vector(FineAngle::from_raw(static_cast<std::uint32_t>(turn)));
        const auto at = [&](std::int64_t r) {
            return centre + PartPoint{multiply_divide(r, way.x.raw(), Unit::one),
                                      multiply_divide(r, way.y.raw(), Unit::one)};
        };
        const Result<const Edge*> edge = strongest(at(inner), at(radius + reach));
        if (edge.status() == Status::not_found) continue;
        if (!edge) return edge.status();
        if (Status s = collect_point(**edge, at(inner), at(radius + reach)); s != Status::ok) return s;
    }
    if (point_count_ < maximum(3, feature_.probes / 2)) return Status::not_found;
    const FinePixel most_off = most_off_circle();
    Result<CircleFit> fit =
        fit_circle_robust(points_.first(point_count_), residuals_.first(point_count_), most_off);
    if (!fit) return fit.status();
    if (fit->used < maximum(3, feature_.probes / 2)) return Status::not_found;
    int elsewhere = feature_.probes - point_count_;
    for (const FinePoint point : points_.first(point_count_))
        if (without_sign(distance_from(fit->circle, point)) > most_off) ++elsewhere;
    round_ = elsewhere * 100 <= feature_.outliers * feature_.probes;
    CircleFit corrected = *fit;
    const SquarePixels blur = median(blurs_.first(point_count_));
    const std::int64_t more = round_divide(std::int64_t{blur.raw()} * FinePixel::one / 2,
                                           maximum<std::int64_t>(fit->circle.radius.raw(), 1));
    corrected.circle.radius += FinePixel::from_raw(saturate_cast<std::int32_t>(more));
    return corrected;
}

inline Result<Measurement> FeatureMeter::circle(PartPoint centre, std::int64_t radius, std::int64_t reach) {
    if (radius <= 0 || reach <= 0) return Status::bad_argument;
    Measurement result;
    // The second round stands on the centre of the first, so that its probes meet the edge at right angles.
    for (int round = 0; round < 2; ++round) {
        const Result<CircleFit> fit = probe_circle(centre, radius, reach);
        if (!fit) return fit.status();
        const FinePoint place = unsquared(fit->circle.centre);
        centre = part_.frame.to_part(place);
        radius = multiply_divide(fit->circle.radius.raw(), part_.scale.x_per_pixel, FinePixel::one);
        result.value.millionths = multiply_divide(2 * std::int64_t{fit->circle.radius.raw()},
                                                  part_.scale.x_per_pixel, FinePixel::one);
        result.blur = median(blurs_.first(point_count_));
        result.marks[0] = place;
        result.mark_count = 1;
    }
    if (!round_) return Status::irregular;
    return result;
}

/// The hole of this part that is nearest to the place of the feature, within its search.
inline Result<CentralMoments> FeatureMeter::nearest_hole() const {
    Result<CentralMoments> nearest = Status::not_found;
    std::int64_t least = feature_.search;
    for (const Hole& hole : part_.holes) {
        if (part_.region == nullptr || hole.region != part_.region->number) continue;
        const Result<CentralMoments> moments = part_.rule.opening > 1
                                                   ? central_moments(hole.moments)
                                                   : fine_moments(part_.image, part_.threshold.part, hole);
        if (!moments) continue;
        const std::int64_t distance = length_of(part_.frame.to_part(moments->centroid) - feature_.centre);
        if (distance > least) continue;
        least = distance;
        nearest = moments;
    }
    return nearest;
}

inline Result<Measurement> FeatureMeter::hole_diameter() {
    const Result<CentralMoments> hole = nearest_hole();
    if (!hole) return hole.status();
    // The radius of a disc of that area: the root of area / pi, in 2^-16 px, with pi = 355 / 113.
    const std::int64_t square = multiply_divide(hole->area, (std::int64_t{1} << 32) * 113, 355);
    const std::int64_t pixels = isqrt(static_cast<std::uint64_t>(square));
    const std::int64_t per_pixel =
        isqrt(static_cast<std::uint64_t>(part_.scale.x_per_pixel * part_.scale.y_per_pixel));
    const std::int64_t radius = multiply_divide(pixels, per_pixel, FinePixel::one);
    const std::int64_t reach = maximum(radius / 2, 3 * part_.scale.x_per_pixel);
    return circle(part_.frame.to_part(hole->centroid), radius, reach);
}

inline Result<Measurement> FeatureMeter::position() {
    const Result<CentralMoments> hole = nearest_hole();
    if (!hole) return hole.status();
    const Result<FinePoint> expected = part_.frame.to_image(feature_.centre);
    if (!expected) return expected.status();
    Measurement result;
    result.value.millionths = length_of(part_.frame.to_part(hole->centroid) - feature_.centre);
    result.marks[0] = hole->centroid;
    result.marks[1] = *expected;
    result.mark_count = 2;
    return result;
}

/// The direction of an edge near the line from `from` to `to`, pointing the same way, in the squared image.
inline Result<FineAngle> FeatureMeter::probe_line(PartPoint from, PartPoint to, Measurement& marks) {
    if (feature_.search <= 0) return Status::bad_argument;
    point_count_ = 0;
    const PartPoint side = square_to(to - from, feature_.search);
    for (int i = 0; i < feature_.probes; ++i) {
        const PartPoint middle = point_between(from, to, 2 * i + 1, 2 * feature_.probes);
        const Result<const Edge*> edge = strongest(middle - side, middle + side);
        if (edge.status() == Status::not_found) continue;
        if (!edge) return edge.status();
        if (Status s = collect_point(**edge, middle - side, middle + side); s != Status::ok) return s;
    }
    if (point_count_ < maximum(3, feature_.probes / 2)) return Status::not_found;
    const Result<LineFit> fit = fit_line_robust(points_.first(point_count_), residuals_.first(point_count_));
    if (!fit) return fit.status();
    if (fit->used < maximum(3, feature_.probes / 2)) return Status::not_found;
    marks.blur = median(blurs_.first(point_count_));
    marks.marks[marks.mark_count++] = unsquared(points_[0]);
    marks.marks[marks.mark_count++] = unsquared(points_[point_count_ - 1]);
    const PartPoint way = to - from;
    const FineAngle expected = part_.frame.angle() + angle_of(way.x, way.y);
    const std::int32_t off = (fit->line.direction - expected).signed_raw();
    return magnitude(off) > FineAngle::quarter_turn().raw() ? fit->line.direction + FineAngle::half_turn()
                                                            : fit->line.direction;
}

inline Result<Measurement> FeatureMeter::angle() {
    Measurement result;
    const Result<FineAngle> first = probe_line(feature_.from, feature_.to, result);
    if (!first) return first.status();
    const Result<FineAngle> second = probe_line(feature_.second_from, feature_.second_to, result);
    if (!second) return second.status();
    const std::int64_t degrees = (*second - *first).microdegrees();
    result.value.millionths = degrees < 0 ? -degrees : degrees;
    return result;
}

inline Result<Measurement> FeatureMeter::hole_count() {
    Measurement result;
    result.value = Decimal::from_int(part_.region == nullptr ? 0 : part_.region->holes);
    return result;
}

}  // namespace detail

}  // namespace fovea
