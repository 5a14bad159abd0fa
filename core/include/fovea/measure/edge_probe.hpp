// SPDX-License-Identifier: MIT
//
// Edge probes: where the brightness changes along a line, to a fraction of a pixel. Book sec. 6.2.2.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/list.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/warp/bilinear.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// A line across an edge, and its parallel copies.
struct EdgeProbe {
    FinePoint from;
    FinePoint to;
    FinePoint across;   ///< from one parallel line to the next, in the image
    int lines = 1;      ///< how many are averaged, half of them on either side; 1..max_probe_lines
    int smoothing = 1;  ///< along the probe, in pixels: more for a blurred or noisy image, less where edges
                        ///< lie close together; 1..max_probe_smoothing
};

/// A squared length in square pixels.
using SquarePixels = Fixed<std::int32_t, 16>;

/// A place where brightness changes fastest.
struct Edge {
    FinePoint place;     ///< on the middle line
    Unit share;          ///< of the way from `from` to `to`, 0 to 1
    GrayLevel strength;  ///< grey levels from before to behind, of an ideally sharp edge that is as steep
                         ///< after the probe's own smoothing: positive where it gets brighter
    SquarePixels blur;   ///< variance of the blur of the image across the edge, up to 64 smoothing^2 px^2
};

inline constexpr int max_probe_lines = 255;
inline constexpr int max_probe_smoothing = 16;

/// The largest number of samples of a probe in an image of this size, beyond its ends too: scratch for
/// edge_probe().
constexpr int edge_probe_scratch(Size size);

/// Finds the edges along a probe, in their order from `from` to `to`.
///
/// The brightness is sampled bilinearly, four times in the length of the smoothing, averaged over the
/// parallel lines, and differentiated with the derivative of a Gaussian of about that length. The extremes of
/// the derivative are the edges; a parabola through three samples gives the fraction.
///
/// Shapes    src 1x1 or larger; the probe as long as the smoothing or longer
/// Units     strength_min in grey levels, more than 0: an edge below it is noise
/// Rounding  place to 1/65536 px; the error of the parabola is below 0.002 times the smoothing
/// Border    samples up to 4 times the smoothing beyond the ends are used; outside the image the outermost
///           ones repeat
/// Scratch   samples of 1/256 grey level, undefined afterwards
/// Errors    empty_image; bad_argument for a probe shorter than its smoothing, lines, smoothing or
///           strength_min out of range; out_of_range if an end of any of the lines is outside the image;
///           scratch_too_small; capacity_exceeded with the strongest edges in the list
/// Source    book eq. 6.9, applied to the derivative; Canny, "A Computational Approach to Edge Detection",
///           PAMI 8(6), 1986. blur follows from the curvature of a Gaussian's logarithm at the extreme
inline Status edge_probe(ImageView<const Gray8> src, const EdgeProbe& probe, GrayLevel strength_min,
                         Span<std::uint16_t> scratch, ListView<Edge> edges);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Samples in the length of the smoothing.
inline constexpr int probe_samples = 4;
/// Samples beyond either end of a probe: the reach of the derivative, and of the blur that looks 1 px
/// farther.
inline constexpr int probe_reach = 12;
inline constexpr int probe_margin = probe_reach + probe_samples;

/// k exp(-k^2 / 32) for k = 1..12, scaled to the sum 4096: the derivative of a Gaussian of 4 samples. A step
/// of height h at the middle gives h.
inline constexpr std::int32_t derivative_weights[probe_reach] = {251, 457, 587, 629, 593, 505,
                                                                 392, 281, 186, 114, 65,  36};
inline constexpr int derivative_bits = 12;
constexpr std::int32_t derivative_sum() {
    std::int32_t sum = 0;
    for (const std::int32_t weight : derivative_weights) sum += weight;
    return sum;
}
static_assert(derivative_sum() == 1 << derivative_bits, "a step must keep its height");

/// The variance of that Gaussian in samples^2, in 1/65536. Near its extreme, where the blur is read off, the
/// response is that of the whole Gaussian, though its weights end at three deviations.
inline constexpr std::int64_t derivative_variance = std::int64_t{probe_samples * probe_samples} << 16;

/// The sampled brightness along a probe, in 1/256 grey level; element 0 lies probe_margin before `from`.
class Profile {
public:
    Profile(Span<const std::uint16_t> samples, int steps) : samples_(samples), steps_(steps) {}

    int steps() const { return steps_; }
    /// The smoothed derivative at a sample, in 1/65536 grey level; -probe_samples to steps() +
    /// probe_samples.
    std::int32_t derivative(int at) const {
        const std::uint16_t* middle = samples_.data() + at + probe_margin;
        std::int32_t sum = 0;  // at most 65280 * 4096 < 2^28
        for (int k = 1; k <= probe_reach; ++k) sum += derivative_weights[k - 1] * (middle[k] - middle[-k]);
        return round_shift(sum, derivative_bits - 8);
    }

private:
    Span<const std::uint16_t> samples_;
    int steps_;
};

/// Length of a probe in samples, or 0 if it is shorter than its smoothing.
inline int probe_steps(const EdgeProbe& probe) {
    const std::int64_t dx = std::int64_t{probe.to.x.raw()} - probe.from.x.raw();
    const std::int64_t dy = std::int64_t{probe.to.y.raw()} - probe.from.y.raw();
    const std::int64_t length = isqrt(magnitude(dx * dx + dy * dy));
    if (length < std::int64_t{FinePixel::one} * probe.smoothing) return 0;
    return static_cast<int>(round_shift(length * probe_samples / probe.smoothing, FinePixel::fraction_bits));
}

/// The shift of line number `line` from the middle one.
constexpr FinePoint line_offset(const EdgeProbe& probe, int line) {
    const int halves = 2 * line - (probe.lines - 1);
    return {FinePixel::from_raw(static_cast<std::int32_t>(std::int64_t{probe.across.x.raw()} * halves / 2)),
            FinePixel::from_raw(static_cast<std::int32_t>(std::int64_t{probe.across.y.raw()} * halves / 2))};
}

inline bool probe_fits(Size size, const EdgeProbe& probe) {
    const std::int64_t reach = FinePixel::from_int(max_image_side).raw() / probe.lines;
    if (magnitude(probe.across.x.raw()) > magnitude(reach) ||
        magnitude(probe.across.y.raw()) > magnitude(reach))
        return false;
    const FinePoint ends[] = {probe.from, probe.to};
    for (const FinePoint end : ends) {
        if (!can_sample(size, end)) return false;
        const FinePoint shift = line_offset(probe, 0);
        const auto moved = [&](int way) {
            const auto sum = [way](FinePixel a, FinePixel b) {
                return FinePixel::from_raw(
                    saturate_cast<std::int32_t>(std::int64_t{a.raw()} + std::int64_t{b.raw()} * way));
            };
            return FinePoint{sum(end.x, shift.x), sum(end.y, shift.y)};
        };
        // The lines lie between the two outermost ones, and the image is convex.
        if (!can_sample(size, moved(1)) || !can_sample(size, moved(-1))) return false;
    }
    return true;
}

/// Samples of a probe with those beyond its ends.
constexpr int probe_samples_of(int steps) { return steps + 2 * probe_margin + 1; }

/// What edge_probe() asks of its arguments.
inline Status check_edge_probe(ImageView<const Gray8> src, const EdgeProbe& probe, GrayLevel strength_min,
                               Span<std::uint16_t> scratch) {
    if (src.empty()) return Status::empty_image;
    if (probe.lines < 1 || probe.lines > max_probe_lines || strength_min.raw() <= 0)
        return Status::bad_argument;
    if (probe.smoothing < 1 || probe.smoothing > max_probe_smoothing) return Status::bad_argument;
    if (!probe_fits(src.size(), probe)) return Status::out_of_range;
    const int steps = probe_steps(probe);
    if (steps == 0) return Status::bad_argument;
    return scratch.size() < probe_samples_of(steps) ? Status::scratch_too_small : Status::ok;
}

inline void sample_probe(ImageView<const Gray8> src, const EdgeProbe& probe, int steps,
                         Span<std::uint16_t> samples) {
    // 1/2^32 px a step, so that the sum over all steps stays below 1/65536 px of error.
    const std::int64_t step_x = (std::int64_t{probe.to.x.raw()} - probe.from.x.raw()) * 65536 / steps;
    const std::int64_t step_y = (std::int64_t{probe.to.y.raw()} - probe.from.y.raw()) * 65536 / steps;
    for (int i = 0; i < probe_samples_of(steps); ++i) {
        const std::int64_t along_x = round_shift(step_x * (i - probe_margin), 16);
        const std::int64_t along_y = round_shift(step_y * (i - probe_margin), 16);
        std::uint32_t sum = 0;  // 255 lines of 255 levels with 16 fraction bits fit
        for (int line = 0; line < probe.lines; ++line) {
            const FinePoint shift = line_offset(probe, line);
            const FinePoint place{FinePixel::from_raw(saturate_cast<std::int32_t>(probe.from.x.raw() +
                                                                                  shift.x.raw() + along_x)),
                                  FinePixel::from_raw(saturate_cast<std::int32_t>(probe.from.y.raw() +
                                                                                  shift.y.raw() + along_y))};
            sum += static_cast<std::uint32_t>(
                sample_bilinear_unchecked(src, nearest_sample(src.size(), place)).raw());
        }
        const std::uint32_t divisor = static_cast<std::uint32_t>(probe.lines) * 256;
        samples[i] = static_cast<std::uint16_t>(sum / divisor + (sum % divisor >= divisor / 2 ? 1 : 0));
    }
}

/// The variance of a Gaussian that falls from `peak` to the mean of its neighbours probe_samples away, in
/// samples^2 and 1/65536: h^2 / (2 u) with u = -ln(neighbours / peak), the logarithm by the series of the
/// inverse hyperbolic tangent.
inline std::int64_t gaussian_variance(std::int64_t peak, std::int64_t neighbours) {
    constexpr std::int64_t most = std::int64_t{1} << 26;  // 1024 samples^2
    if (neighbours >= peak) return most;
    if (neighbours <= 0) return 0;
    const std::int64_t z = ((peak - neighbours) << 16) / (peak + neighbours);
    const std::int64_t zz = z * z >> 16;
    const std::int64_t u =
        2 * (z + (z * (zz / 3 + (zz * zz >> 16) / 5 + (zz * zz >> 16) * zz / (7 * 65536)) >> 16));
    if (u == 0) return most;
    constexpr std::int64_t square = probe_samples * probe_samples;
    return minimum((square << 31) / u, most);
}

/// The edge at an extreme of the derivative.
inline Edge edge_at(const EdgeProbe& probe, const Profile& profile, int at) {
    const std::int64_t before = profile.derivative(at - 1);
    const std::int64_t here = profile.derivative(at);
    const std::int64_t behind = profile.derivative(at + 1);
    // Book eq. 6.9; the denominator is not zero at a strict extreme. The fraction is within half a sample.
    const std::int64_t bend = 2 * (before - 2 * here + behind);
    const std::int64_t fraction =
        bend < 0 ? round_divide((before - behind) * 65536, bend * -1) * -1
                 : round_divide((before - behind) * 65536, maximum<std::int64_t>(bend, 1));
    const std::int64_t position =
        clamp<std::int64_t>(std::int64_t{at} * 65536 + fraction, 0, std::int64_t{profile.steps()} * 65536);

    Edge edge;
    constexpr std::int64_t unit = Unit::one / 65536;
    edge.share = Unit::from_raw(static_cast<std::int32_t>(position * unit / profile.steps()));
    const auto along = [&](FinePixel from, FinePixel to) {
        return from + FinePixel::from_raw(static_cast<std::int32_t>(
                          round_shift((std::int64_t{to.raw()} - from.raw()) * edge.share.raw(), 30)));
    };
    edge.place = {along(probe.from.x, probe.to.x), along(probe.from.y, probe.to.y)};
    edge.strength = GrayLevel::from_raw(static_cast<std::int32_t>(here));

    const int away = probe_samples;
    const std::int64_t sign = here < 0 ? -1 : 1;
    const std::int64_t around = (profile.derivative(at - away) + profile.derivative(at + away)) * sign / 2;
    const std::int64_t variance = gaussian_variance(here * sign, around) - derivative_variance;
    // A sample is smoothing / probe_samples pixels.
    const std::int64_t square = std::int64_t{probe.smoothing} * probe.smoothing;
    edge.blur = SquarePixels::from_raw(static_cast<std::int32_t>(maximum<std::int64_t>(variance, 0) * square /
                                                                 (probe_samples * probe_samples)));
    return edge;
}

/// Adds an edge behind the others; into a full list in place of the weakest, if that is weaker.
inline Status add_edge(const Edge& edge, ListView<Edge> edges) {
    if (edges.push(edge) == Status::ok) return Status::ok;
    int weakest = -1;
    for (int i = 0; i < edges.size(); ++i)
        if (weakest < 0 || magnitude(edges[i].strength.raw()) < magnitude(edges[weakest].strength.raw()))
            weakest = i;
    if (weakest >= 0 && magnitude(edges[weakest].strength.raw()) < magnitude(edge.strength.raw())) {
        for (int i = weakest; i + 1 < edges.size(); ++i) edges[i] = edges[i + 1];
        edges[edges.size() - 1] = edge;
    }
    return Status::capacity_exceeded;
}

}  // namespace detail

constexpr int edge_probe_scratch(Size size) {
    // A line in the image is shorter than width + height.
    return (size.width + size.height) * detail::probe_samples + 2 * detail::probe_margin + 2;
}

inline Status edge_probe(ImageView<const Gray8> src, const EdgeProbe& probe, GrayLevel strength_min,
                         Span<std::uint16_t> scratch, ListView<Edge> edges) {
    if (Status s = detail::check_edge_probe(src, probe, strength_min, scratch); s != Status::ok) return s;
    const int steps = detail::probe_steps(probe);
    const int samples = detail::probe_samples_of(steps);

    detail::sample_probe(src, probe, steps, scratch);
    const detail::Profile profile(scratch.first(samples), steps);
    edges.clear();
    Status status = Status::ok;
    std::int32_t before = profile.derivative(-1);
    std::int32_t here = profile.derivative(0);
    for (int at = 0; at <= steps; ++at) {
        const std::int32_t behind = profile.derivative(at + 1);
        const bool rising = here > before && here >= behind && here >= strength_min.raw();
        const bool falling = here < before && here <= behind && -here >= strength_min.raw();
        if (rising || falling)
            if (Status s = detail::add_edge(detail::edge_at(probe, profile, at), edges); s != Status::ok)
                status = s;
        before = here;
        here = behind;
    }
    return status;
}

}  // namespace fovea
