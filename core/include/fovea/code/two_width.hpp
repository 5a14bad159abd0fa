// SPDX-License-Identifier: MIT
//
// Bars and spaces that are either narrow or wide: Code 39, Interleaved 2 of 5 and Codabar.
#pragma once

#include <cstdint>

#include <fovea/code/bar_reading.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Which of some runs are wide.
struct TwoWidths {
    unsigned wide = 0;        ///< a bit a run, the first in the highest
    std::int64_t narrow = 0;  ///< mean width of the narrow ones, in 1/256 px
    std::int64_t broad = 0;   ///< that of the wide ones
    int error = 0;            ///< mean distance of the runs from their own kind, in 1/256 of the narrow width
};

/// Sorts `count` runs of which the given number is wide. The first begins at edge `first`, each next one
/// `step` runs behind; every run between an odd edge and the next is a bar and is too wide by gain.
///
/// Errors  false where the wide ones are not clearly wider: by `gap` sixteenths at least
constexpr bool sort_widths(BarEdges edges, int first, int step, int count, int wide, std::int64_t gain,
                           int gap, TwoWidths& sorted);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Code 39 has nine elements a character, the most of all.
inline constexpr int most_two_width_runs = 9;

}  // namespace detail

constexpr bool sort_widths(BarEdges edges, int first, int step, int count, int wide, std::int64_t gain,
                           int gap, TwoWidths& sorted) {
    FOVEA_ASSERT(count <= detail::most_two_width_runs && wide < count);
    std::int64_t widths[detail::most_two_width_runs] = {};
    for (int i = 0; i < count; ++i) {
        const int at = first + i * step;
        widths[i] = std::int64_t{edges[at + 1]} - edges[at] + (at % 2 == 1 ? -gain : gain);
        if (widths[i] <= 0) return false;
    }
    unsigned mask = 0;
    for (int taken = 0; taken < wide; ++taken) {
        int widest = -1;
        for (int i = 0; i < count; ++i) {
            if ((mask >> (count - 1 - i) & 1U) != 0) continue;
            if (widest < 0 || widths[i] > widths[widest]) widest = i;
        }
        mask |= 1U << (count - 1 - widest);
    }
    std::int64_t narrowest_wide = 0;
    std::int64_t widest_narrow = 0;
    std::int64_t sums[2] = {};
    for (int i = 0; i < count; ++i) {
        const bool is_wide = (mask >> (count - 1 - i) & 1U) != 0;
        sums[is_wide ? 1 : 0] += widths[i];
        if (is_wide) {
            narrowest_wide = narrowest_wide == 0 ? widths[i] : minimum(narrowest_wide, widths[i]);
        } else {
            widest_narrow = maximum(widest_narrow, widths[i]);
        }
    }
    if (wide > 0 && narrowest_wide * 16 < widest_narrow * (16 + gap)) return false;
    const std::int64_t narrow_mean = sums[0] / (count - wide);
    const std::int64_t wide_mean = wide > 0 ? sums[1] / wide : 0;
    if (narrow_mean <= 0 || widest_narrow > 2 * narrow_mean) return false;
    if (wide > 0 && (wide_mean * 2 < narrow_mean * 3 || wide_mean > narrow_mean * 5)) return false;
    std::int64_t off = 0;
    for (int i = 0; i < count; ++i) {
        const bool is_wide = (mask >> (count - 1 - i) & 1U) != 0;
        const std::int64_t from = widths[i] - (is_wide ? wide_mean : narrow_mean);
        off += from < 0 ? -from : from;
    }
    sorted.wide = mask;
    sorted.narrow = narrow_mean;
    sorted.broad = wide_mean;
    sorted.error = static_cast<int>(minimum<std::int64_t>(off * 256 / (narrow_mean * count), 4096));
    return true;
}

}  // namespace fovea
