// SPDX-License-Identifier: MIT
//
// The frame of a Data Matrix: from a corner to its two solid lines, its two dashed ones, and its modules.
#pragma once

#include <cstdint>

#include <fovea/base/order.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/code/data_matrix_corners.hpp>
#include <fovea/code/data_matrix_sizes.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/number/integer.hpp>

namespace fovea::detail {

// ---- Interface --------------------------------------------------------------------

/// A place or a way in 1/256 px. Images reach 2^23, ways between their places 2^24.
struct Place {
    std::int32_t x = 0;
    std::int32_t y = 0;

    friend constexpr Place operator+(Place a, Place b) { return {a.x + b.x, a.y + b.y}; }
    friend constexpr Place operator-(Place a, Place b) { return {a.x - b.x, a.y - b.y}; }
};

/// A direction of length 2^14.
struct Direction {
    std::int32_t x = 1 << 14;
    std::int32_t y = 0;

    constexpr Direction reversed() const { return {-x, -y}; }
    constexpr Direction right() const { return {-y, x}; }
    constexpr Place times(std::int32_t length) const {
        return {static_cast<std::int32_t>(std::int64_t{x} * length >> 14),
                static_cast<std::int32_t>(std::int64_t{y} * length >> 14)};
    }
    constexpr std::int32_t along(Place way) const {
        return static_cast<std::int32_t>((std::int64_t{x} * way.x + std::int64_t{y} * way.y) >> 14);
    }
};
constexpr Direction direction_of(std::int64_t x, std::int64_t y) {
    const std::int64_t length = hypotenuse(x, y);
    if (length == 0) return {};
    return {static_cast<std::int32_t>(x * (1 << 14) / length),
            static_cast<std::int32_t>(y * (1 << 14) / length)};
}

struct EdgeLine {
    Place at;
    Direction direction;
};

/// Where two lines cross; not_found where they hardly do, or far outside of any image.
constexpr Result<Place> crossing(const EdgeLine& a, const EdgeLine& b);

/// How a dashed line went on from its beginning in the middle of a dark module.
struct DashedLine {
    static constexpr int most_changes = 2 * max_data_matrix_side;

    int changes = 0;                ///< between dark and light; the first and the last is to light
    int bad = 0;                    ///< periods that are not like the others
    bool even = false;              ///< nothing speaks against it
    int score = 0;                  ///< eight for every good period, less for what is uneven
    std::int32_t at[most_changes];  ///< from the outer edge of the solid line, 1/256 px

    int dashes() const { return (changes + 1) / 2; }
    int modules() const { return 2 * dashes(); }
};

/// Four corners, where the solid lines meet, where they end, and opposite; and how many modules lie between.
struct DataMatrixFrame {
    Place corner;
    Place upper;  ///< the end of the line that stands left of a symbol seen from the front
    Place right;  ///< the end of the line below it
    Place opposite;
    int rows = 0;
    int columns = 0;
    int bad = 0;             ///< periods of the dashed lines that are not like the others
    std::int32_t pitch = 0;  ///< about the side of a module
};

struct FrameScratch {
    Span<std::int16_t> samples;  ///< of a profile: frame_samples
    DashedLine& trial;
    DashedLine& above;
    DashedLine& beside;
};
inline constexpr int frame_samples = 1536;

struct FrameOptions {
    int gap = 205;  ///< of light that ends a solid line, in 1/256 of its thickness
};

// ---- Implementation ---------------------------------------------------------------

constexpr Result<Place> crossing(const EdgeLine& a, const EdgeLine& b) {
    const std::int64_t turn =
        std::int64_t{a.direction.x} * b.direction.y - std::int64_t{a.direction.y} * b.direction.x;
    // Sine below 1/8.
    if (turn < (1 << 25) && turn > -(1 << 25)) return Status::not_found;
    const Place way = b.at - a.at;
    // Up to 2^40 times 2^14 below.
    const std::int64_t along = (std::int64_t{way.x} * b.direction.y - std::int64_t{way.y} * b.direction.x);
    const std::int64_t length = (along << 14) / turn;
    if (length > (1 << 24) || length < -(1 << 24)) return Status::not_found;
    return a.at + a.direction.times(static_cast<std::int32_t>(length));
}

/// By how much dark modules are printed too large, on each side, 1/256 px.
inline std::int32_t growth_of(const DashedLine& dashed) {
    std::int64_t dark = 0;
    std::int64_t light = 0;
    const int pairs = (dashed.changes - 1) / 2;
    for (int k = 0; k < pairs; ++k) {
        light += dashed.at[2 * k + 1] - dashed.at[2 * k];
        dark += dashed.at[2 * k + 2] - dashed.at[2 * k + 1];
    }
    return pairs == 0 ? 0 : static_cast<std::int32_t>((dark - light) / (4 * pairs));
}

/// Whether symbols have a side of that many modules.
constexpr bool is_side(int modules) {
    for (const DataMatrixSize& size : data_matrix_sizes)
        if (size.rows == modules || size.columns == modules) return true;
    return false;
}

/// Finds the frame that begins at a corner; its parts share the levels and the size of a module.
class FrameFinder {
public:
    FrameFinder(const CodeField& field, const BorderCorner& corner, const FrameOptions& options,
                const FrameScratch& scratch)
        : field_(field),
          options_(options),
          scratch_(scratch),
          threshold_(16 * corner.threshold - 8),
          largest_(256 * (field.size().width + field.size().height)) {}

    /// The two solid lines. not_found where they are none.
    Status find_arms(const BorderCorner& corner);
    /// The rest, with modules of that share of the solid lines' thickness, in 1/256.
    Result<DataMatrixFrame> find(int share);

private:
    /// A solid line, away from the corner.
    struct Arm {
        EdgeLine line;  ///< of its outer edge
        Direction inward;
        std::int32_t length = 0;
    };
    static constexpr int probes = 24;
    static constexpr int least_score = 16;  ///< two good periods, and nothing bad
    static constexpr int most_tries = 200;  ///< of the way of a dashed line, to each side

    int value(Place p) const { return field_.sample(p.x, p.y); }
    bool refine(const EdgeLine& chord, Direction outward, std::int32_t from, std::int32_t to, int most_places,
                EdgeLine& line) const;
    std::int32_t thickness(const Arm& arm, std::int32_t from, std::int32_t to) const;
    std::int32_t walk(const Arm& arm) const;
    void follow_dashes(Place start, Direction way, std::int32_t beside, DashedLine& dashed) const;
    template <class Allowed>
    bool find_dashes(const Arm& from, const Arm& beside, Allowed allowed, DashedLine& dashed,
                     EdgeLine& edge) const;
    EdgeLine edge_of(const EdgeLine& centre, Direction outward, const DashedLine& dashed) const;
    /// Both begin where they meet.
    static bool settle(Arm& first, Arm& second);
    static bool fit(Span<const Place> offsets, const EdgeLine& about, Direction aside, EdgeLine& line);

    CodeField field_;
    FrameOptions options_;
    FrameScratch scratch_;
    int threshold_;
    int hysteresis_ = 64;
    std::int32_t largest_;
    std::int32_t module_ = 0;
    std::int32_t thickness_ = 0;
    Arm first_;  ///< along the way into the corner: left of a symbol seen from the front
    Arm second_;
};

/// The line through places told by their way along a line (x) and aside of it (y); twice, the second time
/// without those that lie farther off than the others.
inline bool FrameFinder::fit(Span<const Place> offsets, const EdgeLine& about, Direction aside,
                             EdgeLine& line) {
    std::int64_t slope = 0;  // 2^-14
    std::int64_t zero = 0;   // 1/256 px
    std::int64_t limit = std::int64_t{1} << 30;
    for (int round = 0; round < 3; ++round) {
        std::int64_t n = 0;
        std::int64_t su = 0;
        std::int64_t sv = 0;
        std::int64_t suu = 0;
        std::int64_t suv = 0;
        for (const Place p : offsets) {
            const std::int64_t off = p.y - zero - (slope * p.x >> 14);
            if (off > limit || off < -limit) continue;
            ++n;
            su += p.x;
            sv += p.y;
            suu += std::int64_t{p.x} * p.x;
            suv += std::int64_t{p.x} * p.y;
        }
        if (n < 3) return false;
        // Ways of at most 2^24 and 200 places: sums below 2^56, and n times them below 2^63.
        const std::int64_t spread = (n * suu - su * su) >> 14;
        if (spread <= 0) return false;
        slope = clamp<std::int64_t>((n * suv - su * sv) / spread, -(1 << 13), 1 << 13);
        zero = (sv - (slope * su >> 14)) / n;
        std::int64_t sum = 0;
        for (const Place p : offsets) {
            const std::int64_t off = p.y - zero - (slope * p.x >> 14);
            sum += minimum<std::int64_t>(off < 0 ? -off : off, limit);
        }
        limit = maximum<std::int64_t>(64, 2 * sum / static_cast<std::int64_t>(offsets.size()));
    }
    line.at = about.at + aside.times(static_cast<std::int32_t>(zero));
    line.direction = direction_of(about.direction.x + (slope * aside.x >> 14),
                                  about.direction.y + (slope * aside.y >> 14));
    return true;
}

/// The edge near a chord that dark pixels' centres gave, between two ways along it.
inline bool FrameFinder::refine(const EdgeLine& chord, Direction outward, std::int32_t from, std::int32_t to,
                                int most_places, EdgeLine& line) const {
    constexpr int steps = 10;
    Place offsets[probes];
    int count = 0;
    const std::int32_t margin = (to - from) / 16;
    const int places = clamp((to - from) >> 9, 6, most_places);
    for (int i = 0; i < places; ++i) {
        const std::int32_t along =
            from + margin +
            static_cast<std::int32_t>(std::int64_t{to - from - 2 * margin} * i / (places - 1));
        const Place middle = chord.at + chord.direction.times(along);
        int levels[steps];
        int low = 4080;
        int high = 0;
        for (int k = 0; k < steps; ++k) {
            levels[k] = value(middle + outward.times(128 * k - 448));
            low = minimum(low, levels[k]);
            high = maximum(high, levels[k]);
        }
        // The middle of what is here, unless that is too little.
        const int between = high - low > 192 ? (high + low) / 2 : threshold_;
        std::int32_t best = 1 << 20;
        for (int k = 1; k < steps; ++k) {
            if (levels[k - 1] >= between || levels[k] < between) continue;
            const std::int32_t place =
                128 * k - 448 - 128 * (levels[k] - between) / (levels[k] - levels[k - 1]);
            if (magnitude(place - 128) < magnitude(best - 128)) best = place;
        }
        if (best < 1 << 20) offsets[count++] = {along, best};
    }
    return 2 * count >= places && fit({offsets, count}, chord, outward, line);
}

/// A quarter of the dark runs from the edge inward are shorter: about one module, as data there are light half
/// of the time.
inline std::int32_t FrameFinder::thickness(const Arm& arm, std::int32_t from, std::int32_t to) const {
    std::int32_t runs[probes];
    const std::int32_t most = maximum((to - from) / 4, 512);
    const std::int32_t step = clamp(most / 32, 64, 512);
    for (int i = 0; i < probes; ++i) {
        const std::int32_t along =
            from + static_cast<std::int32_t>(std::int64_t{to - from} * (2 * i + 1) / (2 * probes));
        const Place edge = arm.line.at + arm.line.direction.times(along);
        const int dark = minimum(value(edge + arm.inward.times(192)), value(edge + arm.inward.times(320)));
        const int light = value(edge - arm.inward.times(384));
        const int between = light - dark > 128 ? (light + dark) / 2 : threshold_;
        std::int32_t depth = 96;
        int before = between - 1;
        for (; depth < most; depth += step) {
            const int now = value(edge + arm.inward.times(depth));
            if (now >= between) {
                depth -= step * (now - between) / maximum(now - before, 1);
                break;
            }
            before = now;
        }
        runs[i] = depth;
    }
    return nth_smallest(Span<std::int32_t>(runs), probes / 4);
}

/// How far a solid line goes from the corner.
inline std::int32_t FrameFinder::walk(const Arm& arm) const {
    const std::int32_t depth = module_ / 2;
    const std::int32_t step = maximum(module_ / 8, 64);
    const std::int32_t gap =
        maximum(static_cast<std::int32_t>(std::int64_t{module_} * options_.gap >> 8), 256);
    const Place start = arm.line.at + arm.inward.times(depth);
    const Place outside = arm.line.at - arm.inward.times(maximum(depth, 320));
    // Levels on both sides of the edge, which follow the light along it.
    int dark = value(start + arm.line.direction.times(module_));
    int light = value(outside + arm.line.direction.times(module_));
    std::int32_t end = 0;
    int before = dark;
    bool in_dark = true;
    for (std::int32_t along = module_ / 2; along < largest_; along += step) {
        const int now = value(start + arm.line.direction.times(along));
        light = (7 * light + value(outside + arm.line.direction.times(along))) / 8;
        const int between = (light + dark) / 2;
        if (now < between) {
            in_dark = true;
            end = along;
            dark = (7 * dark + now) / 8;
        } else {
            if (in_dark) end = along - (before < between ? step * (now - between) / (now - before) : step);
            in_dark = false;
            if (along - end > gap) break;
        }
        before = now;
    }
    return end;
}

/// Where neighbouring extremes of a profile are, in turn, and the profile goes through the middle of them.
inline void FrameFinder::follow_dashes(Place start, Direction way, std::int32_t beside,
                                       DashedLine& dashed) const {
    const std::int32_t longest = minimum(beside + beside / 2, largest_);
    const Span<std::int16_t> samples = scratch_.samples;
    const std::int32_t step =
        maximum(maximum(module_ / 4, 64), longest / (static_cast<std::int32_t>(samples.size()) - 1) + 1);
    const std::int32_t begin = module_ / 2;
    dashed.changes = 0;
    dashed.bad = 0;
    dashed.score = -1000;
    dashed.even = false;
    std::int32_t pitch = module_;
    const auto change = [&](int from, int to) {
        if (dashed.changes == DashedLine::most_changes) return;
        const int middle = (samples[from] + samples[to]) / 2;
        const bool up = samples[to] > samples[from];
        int i = from + 1;
        while (i < to && (samples[i] >= middle) != up) ++i;
        const int a = samples[i - 1];
        const int b = samples[i];
        const std::int32_t back = a == b ? 0 : clamp(step * (b - middle) / (b - a), 0, step);
        const std::int32_t at = begin + step * i - back;
        dashed.at[dashed.changes++] = at;
        const int n = dashed.changes;
        if (n >= 5) pitch = (at - dashed.at[n - 5]) / 4;
        if (n == 2 || n == 4) pitch = at / n;
        pitch = clamp(pitch, module_ / 2, 2 * module_);
    };
    bool rising = false;  // from the last extreme, a dark one, up
    int low = 0;
    int high = 0;
    int turned = 0;
    bool ended = false;
    for (int i = 0; begin + step * i <= longest; ++i) {
        const int now = value(start + way.times(begin + step * i));
        samples[i] = static_cast<std::int16_t>(now);
        if (!rising) {
            if (now < samples[low]) low = i;
            if (now > samples[low] + hysteresis_) {
                if (high > 0) change(high, low);
                rising = true;
                high = i;
                turned = i;
            } else if (step * (i - turned) > 5 * pitch / 2) {
                break;
            }
        } else {
            if (now > samples[high]) high = i;
            if (now < samples[high] - hysteresis_) {
                change(low, high);
                rising = false;
                low = i;
                turned = i;
            } else if (step * (i - turned) > (dashed.changes < 2 ? 3 * module_ : 7 * pitch / 4)) {
                change(low, high);
                ended = true;
                break;
            }
        }
    }
    if (!ended) {
        // The image or the longest way ended first.
        if (rising) change(low, high);
        dashed.bad += 1;
    }
    if (dashed.changes % 2 == 0 && dashed.changes > 0) --dashed.changes;
    if (dashed.changes < 7) return;
    std::int32_t usual = 2 * dashed.at[dashed.changes - 1] / dashed.changes;
    int score = -16 * dashed.bad;
    for (int k = 0; k + 2 < dashed.changes; ++k) {
        const std::int32_t period = dashed.at[k + 2] - dashed.at[k];
        const int uneven = static_cast<int>(32 * magnitude(period - usual) / magnitude(usual));
        if (uneven < 12) {
            score += 8 - uneven;
            usual = (3 * usual + period) / 4;
        } else {
            score -= 16;
            ++dashed.bad;
        }
    }
    // Sides that face each other are alike but for the tilt: a module for an eighth of difference.
    const std::int32_t length = dashed.at[dashed.changes - 1] + usual / 2;
    const int other = static_cast<int>(64 * magnitude(length - beside) / magnitude(beside));
    dashed.score = score - maximum(other - 6, 0);
    dashed.even = dashed.bad == 0 && other < 10;
}

/// The dashed line that begins where a solid one ends and goes about the way of the other.
template <class Allowed>
bool FrameFinder::find_dashes(const Arm& from, const Arm& beside, Allowed allowed, DashedLine& dashed,
                              EdgeLine& edge) const {
    const Place end = from.line.at + from.line.direction.times(from.length);
    const Place start = end - from.line.direction.times(module_ / 2);
    // A third of a module at the far end for every try.
    const std::int32_t step = maximum<std::int32_t>(
        static_cast<std::int32_t>((std::int64_t{module_} << 14) / (3 * std::int64_t{beside.length})), 16);
    const int tries = minimum<int>((1 << 14) * 2 / 5 / step, most_tries);
    const auto way_of = [&](int j) {
        return direction_of(beside.line.direction.x - (std::int64_t{from.line.direction.x} * j * step >> 14),
                            beside.line.direction.y - (std::int64_t{from.line.direction.y} * j * step >> 14));
    };
    DashedLine& now = scratch_.trial;
    const auto follow = [&](int j) {
        follow_dashes(start, way_of(j), beside.length, now);
        // A slight tilt is likelier than a strong one.
        now.score -= (j < 0 ? -j : j) / 4;
        return now.score >= least_score && allowed(now.modules());
    };
    // The first dashes are met at any tilt.
    bool any = false;
    for (int j = -tries / 2; j <= tries / 2 && !any; j += maximum(tries / 2, 1)) {
        static_cast<void>(follow(j));
        any = now.changes >= 3;
    }
    if (!any) return false;
    int best = 0;
    int best_j = 0;
    bool even = false;
    // 0, 1, -1, 2, -2, or twice that where dashes are large enough to be met off their middle.
    const int stride = module_ < 4 * 256 ? 1 : 2;
    for (int n = 0; n * stride <= 2 * tries; ++n) {
        const int j = stride * (n % 2 == 0 ? -n / 2 : (n + 1) / 2);
        if (even && (j < 0 ? -j : j) > (best_j < 0 ? -best_j : best_j) + 2) break;
        if (!follow(j) || now.score <= best) continue;
        best = now.score;
        best_j = j;
        even = now.even;
    }
    if (best == 0) return false;
    // The middle of all ways that say the same.
    static_cast<void>(follow(best_j));
    const int modules = now.modules();
    int ends[2] = {best_j, best_j};
    for (int side = 0; side < 2; ++side) {
        const int move = side == 0 ? -1 : 1;
        for (int j = best_j + move; (j - best_j) * move <= 6; j += move) {
            if (!follow(j) || now.modules() != modules || now.score < best - 6) break;
            ends[side] = j;
        }
    }
    const int middle_2 = ends[0] + ends[1];
    const auto half = [&](std::int32_t direction, std::int32_t aside) {
        return direction - (std::int64_t{aside} * middle_2 * step >> 15);
    };
    Direction way = direction_of(half(beside.line.direction.x, from.line.direction.x),
                                 half(beside.line.direction.y, from.line.direction.y));
    follow_dashes(start, way, beside.length, dashed);
    if (dashed.modules() != modules || dashed.score < best - 12) {
        way = way_of(best_j);
        follow_dashes(start, way, beside.length, dashed);
    }
    edge = edge_of({start, way}, from.line.direction, dashed);
    return true;
}

/// The outer edge of a dashed line from the edges of its dashes.
inline EdgeLine FrameFinder::edge_of(const EdgeLine& centre, Direction outward,
                                     const DashedLine& dashed) const {
    Place offsets[max_data_matrix_side / 2];
    int count = 0;
    const std::int32_t step = maximum(module_ / 8, 48);
    for (int i = 0; i < dashed.dashes() && count < max_data_matrix_side / 2; ++i) {
        const std::int32_t along = i == 0 ? dashed.at[0] / 2 : (dashed.at[2 * i - 1] + dashed.at[2 * i]) / 2;
        const Place middle = centre.at + centre.direction.times(along);
        const int dark = value(middle);
        const int light = value(middle + outward.times(module_));
        const int between = (dark + light) / 2;
        if (light - dark < 2 * hysteresis_) continue;
        int before = dark;
        for (std::int32_t aside = step; aside <= module_ + module_ / 4; aside += step) {
            const int now = value(middle + outward.times(aside));
            if (now >= between) {
                offsets[count++] = {along, aside - step * (now - between) / maximum(now - before, 1)};
                break;
            }
            before = now;
        }
    }
    EdgeLine edge{centre.at + outward.times(module_ / 2), centre.direction};
    fit({offsets, count}, centre, outward, edge);
    return edge;
}

inline bool FrameFinder::settle(Arm& first, Arm& second) {
    const Result<Place> met = crossing(first.line, second.line);
    if (!met) return false;
    first.line.at = *met;
    second.line.at = *met;
    return true;
}

inline Status FrameFinder::find_arms(const BorderCorner& corner) {
    const auto chord_of = [](const BorderPiece& piece) {
        return EdgeLine{{256 * piece.first.x, 256 * piece.first.y}, direction_of(piece.x(), piece.y())};
    };
    const EdgeLine in = chord_of(corner.in);
    const EdgeLine out = chord_of(corner.out);
    Arm& first = first_;
    Arm& second = second_;
    if (!refine(in, in.direction.right().reversed(), 0, 256 * corner.in.length, 10, first.line))
        return Status::not_found;
    if (!refine(out, out.direction.right().reversed(), 0, 256 * corner.out.length, 10, second.line))
        return Status::not_found;
    first.inward = first.line.direction.right();
    first.line.direction = first.line.direction.reversed();
    second.inward = second.line.direction.right();
    if (!settle(first, second)) return Status::not_found;
    const auto way_to = [](const Arm& arm, Point p) {
        return arm.line.direction.along(Place{256 * p.x, 256 * p.y} - arm.line.at);
    };
    // The thinner of the two: beside one of them the data may be dark by chance.
    const std::int32_t thick_first = thickness(first, 0, way_to(first, corner.in.first));
    const std::int32_t thick_second = thickness(second, 0, way_to(second, corner.out.last));
    module_ = maximum(minimum(thick_first, thick_second), 200);
    for (int round = 0; round < 2; ++round) {
        first.length = walk(first);
        second.length = walk(second);
        // Eight modules at least, printed up to half as thick again.
        if (2 * first.length < 9 * module_ || 2 * second.length < 9 * module_) return Status::not_found;
        if (first.length > 200 * module_ || second.length > 200 * module_) return Status::not_found;
        if (round == 1) break;
        // Once more along the whole of both.
        const Arm short_first = first;
        const Arm short_second = second;
        const Direction outward_first = first.inward.reversed();
        const Direction outward_second = second.inward.reversed();
        const EdgeLine chord_first{first.line.at + first.inward.times(128), first.line.direction};
        const EdgeLine chord_second{second.line.at + second.inward.times(128), second.line.direction};
        if (!refine(chord_first, outward_first, 0, first.length, probes, first.line)) first = short_first;
        if (!refine(chord_second, outward_second, 0, second.length, probes, second.line))
            second = short_second;
        if (!settle(first, second)) return Status::not_found;
    }
    // Levels on both sides of the edges.
    std::int64_t dark = 0;
    std::int64_t light = 0;
    const Arm* const arms[2] = {&first, &second};
    for (const Arm* arm : arms) {
        for (int i = 1; i < 8; ++i) {
            const Place edge = arm->line.at + arm->line.direction.times(arm->length / 8 * i);
            dark += value(edge + arm->inward.times(module_ / 2));
            light += value(edge - arm->inward.times(maximum(module_ / 2, 384)));
        }
    }
    if (light <= dark) return Status::not_found;
    hysteresis_ = maximum(static_cast<int>((light - dark) / 14 / 5), 64);
    thickness_ = module_;
    return Status::ok;
}

inline Result<DataMatrixFrame> FrameFinder::find(int share) {
    Arm first = first_;
    Arm second = second_;
    module_ = maximum(static_cast<std::int32_t>(std::int64_t{thickness_} * share >> 8), 200);
    DataMatrixFrame frame;
    DashedLine& above = scratch_.above;
    DashedLine& beside = scratch_.beside;
    EdgeLine upper;
    EdgeLine right;
    const auto with = [](int other) {
        return [other](int n) {
            return data_matrix_size(n, other) != nullptr || data_matrix_size(other, n) != nullptr;
        };
    };
    if (!find_dashes(first, second, is_side, above, upper)) return Status::not_found;
    if (!find_dashes(second, first, with(above.modules()), beside, right)) {
        if (!find_dashes(second, first, is_side, beside, right)) return Status::not_found;
        if (!find_dashes(first, second, with(beside.modules()), above, upper)) return Status::not_found;
    }
    // Print grows on all sides alike, and the grid does not.
    const std::int32_t growth = (growth_of(above) + growth_of(beside)) / 2;
    first.line.at = first.line.at + first.inward.times(growth);
    second.line.at = second.line.at + second.inward.times(growth);
    upper.at = upper.at - first.line.direction.times(growth);
    right.at = right.at - second.line.direction.times(growth);
    if (!settle(first, second)) return Status::not_found;
    const Result<Place> a = crossing(upper, first.line);
    const Result<Place> b = crossing(right, second.line);
    const Result<Place> d = crossing(upper, right);
    if (!a || !b || !d) return Status::not_found;
    frame.corner = first.line.at;
    frame.upper = *a;
    frame.right = *b;
    frame.opposite = *d;
    frame.columns = above.modules();
    frame.rows = beside.modules();
    frame.bad = above.bad + beside.bad;
    frame.pitch = module_;
    return frame;
}

}  // namespace fovea::detail
