// SPDX-License-Identifier: MIT
//
// The dashed lines of a Data Matrix: which way they go, how many modules they have, where their outer edge
// is.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/code/data_matrix_corners.hpp>
#include <fovea/code/data_matrix_lines.hpp>
#include <fovea/code/data_matrix_sizes.hpp>
#include <fovea/code/work_budget.hpp>
#include <fovea/number/integer.hpp>

namespace fovea::detail {

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

/// A solid line, away from the corner.
struct SolidLine {
    EdgeLine line;  ///< of its outer edge
    Direction inward;
    std::int32_t length = 0;
};

struct DashScratch {
    Span<std::int16_t> samples;  ///< of a profile: dash_samples
    DashedLine& trial;
    WorkBudget& budget;  ///< a unit a sample; where it is spent no dashed line is found
};
inline constexpr int dash_samples = 1536;

/// Finds dashed lines of modules of about one size.
class DashFinder {
public:
    DashFinder(const CodeField& field, std::int32_t module, int hysteresis, const DashScratch& scratch)
        : field_(field),
          scratch_(scratch),
          module_(module),
          hysteresis_(hysteresis),
          largest_(256 * (field.size().width + field.size().height)) {}

    /// The dashed line that begins where `from` ends and goes about the way of `beside`; with a count of
    /// modules that is allowed.
    template <class Allowed>
    bool find(const SolidLine& from, const SolidLine& beside, Allowed allowed, DashedLine& dashed,
              EdgeLine& edge) const;

private:
    static constexpr int least_score = 16;  ///< two good periods, and nothing bad
    static constexpr int most_tries = 200;  ///< of the way of a dashed line, to each side

    /// What was found on a way, of which j is the tilt.
    struct Trial {
        int j = 1 << 30;
        int score = 0;
        int modules = 0;
        bool met = false;  ///< the first dashes
        bool even = false;
        bool good = false;  ///< a dashed line
    };
    static constexpr int known_trials = 16;  ///< a power of two

    int value(EdgePlace p) const { return field_.sample(p.x, p.y); }
    void follow_dashes(EdgePlace start, Direction way, std::int32_t beside, DashedLine& dashed) const;
    EdgeLine edge_of(const EdgeLine& centre, Direction outward, const DashedLine& dashed) const;

    CodeField field_;
    DashScratch scratch_;
    std::int32_t module_;
    int hysteresis_;
    std::int32_t largest_;
};

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

/// Where neighbouring extremes of a profile are, in turn, and the profile goes through the middle of them.
inline void DashFinder::follow_dashes(EdgePlace start, Direction way, std::int32_t beside,
                                      DashedLine& dashed) const {
    const std::int32_t longest = minimum(beside + beside / 2, largest_);
    const Span<std::int16_t> samples = scratch_.samples;
    const std::int32_t step =
        maximum<std::int32_t>(maximum<std::int32_t>(module_ / 4, 64),
                              longest / (static_cast<std::int32_t>(samples.size()) - 1) + 1);
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
        const std::int32_t back = a == b ? 0 : clamp<std::int32_t>(step * (b - middle) / (b - a), 0, step);
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
    int extreme = 4081;                 // the sample at low, or at high where it rises; above all at first
    std::int32_t since = 0;             // the way from where it turned
    std::int32_t most = 5 * pitch / 2;  // of that way
    bool ended = false;
    const int count = longest < begin ? 0 : static_cast<int>((longest - begin) / step) + 1;
    FieldSteps steps = steps_along(field_, start, way, begin, step);
    int i = 0;
    for (; i < count; ++i, since += step) {
        const int now = steps.next();
        samples[i] = static_cast<std::int16_t>(now);
        if (!rising) {
            if (now < extreme) {
                extreme = now;
                low = i;
            }
            if (now > extreme + hysteresis_) {
                if (high > 0) change(high, low);
                rising = true;
                extreme = now;
                high = i;
                since = 0;
                most = dashed.changes < 2 ? 3 * module_ : 7 * pitch / 4;
            } else if (since > most) {
                break;
            }
        } else {
            if (now > extreme) {
                extreme = now;
                high = i;
            }
            if (now < extreme - hysteresis_) {
                change(low, high);
                rising = false;
                extreme = now;
                low = i;
                since = 0;
                most = 5 * pitch / 2;
            } else if (since > most) {
                change(low, high);
                ended = true;
                break;
            }
        }
    }
    scratch_.budget.spend(minimum(i + 1, count));
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
bool DashFinder::find(const SolidLine& from, const SolidLine& beside, Allowed allowed, DashedLine& dashed,
                      EdgeLine& edge) const {
    const EdgePlace end = from.line.at + from.line.direction.times(from.length);
    const EdgePlace start = end - from.line.direction.times(module_ / 2);
    // A third of a module at the far end for every try.
    const std::int32_t step = maximum<std::int32_t>(
        static_cast<std::int32_t>((std::int64_t{module_} << 14) / (3 * std::int64_t{beside.length})), 16);
    const int tries = minimum<int>((1 << 14) * 2 / 5 / step, most_tries);
    const auto way_of = [&](int j) {
        return direction_of(beside.line.direction.x - (std::int64_t{from.line.direction.x} * j * step >> 14),
                            beside.line.direction.y - (std::int64_t{from.line.direction.y} * j * step >> 14));
    };
    DashedLine& now = scratch_.trial;
    // Of the last ways what was found on them, so that none of these is followed again.
    Trial trials[known_trials];
    const auto follow = [&](int j) {
        Trial& trial = trials[j & (known_trials - 1)];
        if (trial.j == j) return trial;
        follow_dashes(start, way_of(j), beside.length, now);
        trial.j = j;
        trial.met = now.changes >= 3;
        trial.even = now.even;
        trial.modules = now.modules();
        // A slight tilt is likelier than a strong one.
        trial.score = now.score - (j < 0 ? -j : j) / 4;
        trial.good = trial.score >= least_score && allowed(trial.modules);
        return trial;
    };
    // The first dashes are met at any tilt.
    if (!follow(0).met && !follow(-tries / 2).met && !follow(tries / 2).met) return false;
    Trial best;
    best.j = 0;
    // 0, 1, -1, 2, -2, or twice that where dashes are large enough to be met off their middle.
    const int stride = module_ < 4 * 256 ? 1 : 2;
    for (int n = 0; n * stride <= 2 * tries; ++n) {
        const int j = stride * (n % 2 == 0 ? -n / 2 : (n + 1) / 2);
        if (scratch_.budget.spent()) return false;
        if (best.even && (j < 0 ? -j : j) > (best.j < 0 ? -best.j : best.j) + 2) break;
        const Trial trial = follow(j);
        if (trial.good && trial.score > best.score) best = trial;
    }
    if (best.score == 0) return false;
    // The middle of all ways that say the same.
    int ends[2] = {best.j, best.j};
    for (int side = 0; side < 2; ++side) {
        const int move = side == 0 ? -1 : 1;
        for (int j = best.j + move; (j - best.j) * move <= 6; j += move) {
            const Trial trial = follow(j);
            if (!trial.good || trial.modules != best.modules || trial.score < best.score - 6) break;
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
    if (dashed.modules() != best.modules || dashed.score < best.score - 12) {
        way = way_of(best.j);
        follow_dashes(start, way, beside.length, dashed);
    }
    edge = edge_of({start, way}, from.line.direction, dashed);
    return true;
}

/// The outer edge of a dashed line from the edges of its dashes.
inline EdgeLine DashFinder::edge_of(const EdgeLine& centre, Direction outward,
                                    const DashedLine& dashed) const {
    EdgePlace offsets[max_data_matrix_side / 2];
    int count = 0;
    const std::int32_t step = maximum<std::int32_t>(module_ / 8, 48);
    for (int i = 0; i < dashed.dashes() && count < max_data_matrix_side / 2; ++i) {
        const std::int32_t along = i == 0 ? dashed.at[0] / 2 : (dashed.at[2 * i - 1] + dashed.at[2 * i]) / 2;
        const EdgePlace middle = centre.at + centre.direction.times(along);
        const int dark = value(middle);
        const int light = value(middle + outward.times(module_));
        const int between = (dark + light) / 2;
        if (light - dark < 2 * hysteresis_) continue;
        int before = dark;
        FieldSteps across = steps_along(field_, middle, outward, step, step);
        for (std::int32_t aside = step; aside <= module_ + module_ / 4; aside += step) {
            const int now = across.next();
            if (now >= between) {
                offsets[count++] = {along, aside - step * (now - between) / maximum(now - before, 1)};
                break;
            }
            before = now;
        }
    }
    EdgeLine edge{centre.at + outward.times(module_ / 2), centre.direction};
    static_cast<void>(fit_edge({offsets, count}, centre, outward, edge));
    return edge;
}

}  // namespace fovea::detail
