// SPDX-License-Identifier: MIT
//
// Bar edges: where the brightness along a scan line passes from bars to spaces.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/code/bar_reading.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Brightness along a line, in 1/16 grey level: 0..4080.
using BarProfile = Span<const std::int16_t>;
inline constexpr int bar_profile_bits = 4;

/// Where between a bright and a dark turning point the edge is put. Each blur has its own best rule.
enum class BarEdgeRule : std::uint8_t {
    steepest,  ///< where the brightness changes fastest: right where bars are wider than the blur
    halfway,   ///< in the middle between the two: right for printing that is unevenly lit
    level,     ///< between that and the middle of the neighbourhood: narrow bars that blur has made shallow
};

/// A turning point of the brightness along a line.
struct BarTurn {
    std::int32_t place = 0;  ///< its sample
    std::int32_t level = 0;  ///< its brightness
};

/// Raises a profile over the mean of the samples `reach` to either side of it, which undoes some blur: twice
/// the profile less that mean. The answer is in -4080..8160.
inline void sharpen_bar_profile(BarProfile profile, int reach, Span<std::int16_t> sharp);

/// Finds the bright and dark turning points in turn, as far as they stand out by 1/share of the contrast near
/// them, 4 levels and 1/32 of the contrast of the line. The first sample and the last turn count as such.
///
/// Shapes  turns as long as the profile, or longer; ranges of bar_ranges() elements
/// Answer  how many there are; 0 for a profile of fewer than two samples
inline int find_bar_turns(BarProfile profile, int share, Span<std::int16_t> ranges, Span<BarTurn> turns);
constexpr std::int64_t bar_ranges(std::int64_t samples) { return samples / 16 + 1; }

/// The edges between the turns, as the decoders take them: in 1/256 sample, the first space first. Room for
/// turns.size() + 3.
///
/// Answer  how many there are
inline int find_bar_edges(BarProfile profile, Span<const BarTurn> turns, BarEdgeRule rule,
                          Span<std::int32_t> edges);

/// The same line seen from its other end: edges of it in the other order, the first run a space again. Room
/// for edges.size() + 1.
inline int reverse_bar_edges(BarEdges edges, Span<std::int32_t> reversed);

/// Makes of `count` edges the same line with bars taken as spaces, in place: room for one more.
///
/// Answer  how many there are then
inline int invert_bar_edges(Span<std::int32_t> edges, int count);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

inline constexpr int bar_block = 16;  ///< samples over which contrast is taken
inline constexpr int bar_reach = 2;   ///< blocks to either side that share it
inline constexpr std::int32_t least_bar_contrast = 4 << bar_profile_bits;

/// The contrast about every block of samples: the range of the block and of its neighbours. Answers that of
/// the whole line.
inline std::int32_t find_bar_ranges(BarProfile profile, Span<std::int16_t> ranges) {
    const auto length = static_cast<int>(profile.size());
    const int blocks = (length + bar_block - 1) / bar_block;
    std::int16_t low[2 * bar_reach + 1] = {};
    std::int16_t high[2 * bar_reach + 1] = {};
    constexpr int window = 2 * bar_reach + 1;
    std::int16_t lowest = profile[0];
    std::int16_t highest = profile[0];
    for (int block = 0; block < blocks + bar_reach; ++block) {
        const int slot = block % window;
        if (block < blocks) {
            const std::int16_t* own = profile.data() + block * bar_block;
            const int samples = minimum(length - block * bar_block, bar_block);
            std::int16_t least = own[0];
            std::int16_t most = own[0];
            for (int i = 1; i < samples; ++i) {
                least = minimum(least, own[i]);
                most = maximum(most, own[i]);
            }
            low[slot] = least;
            high[slot] = most;
            lowest = minimum(lowest, least);
            highest = maximum(highest, most);
        }
        const int centre = block - bar_reach;
        if (centre < 0) continue;
        std::int16_t least = low[centre % window];
        std::int16_t most = high[centre % window];
        for (int near = maximum(centre - bar_reach, 0); near <= minimum(centre + bar_reach, blocks - 1);
             ++near) {
            least = minimum(least, low[near % window]);
            most = maximum(most, high[near % window]);
        }
        ranges[centre] = static_cast<std::int16_t>(most - least);
    }
    return highest - lowest;
}

/// The middle of the brightness about turn i and the next one: of the highest and the lowest turns near them.
/// Bright turns and dark ones alternate, so that half of them can be the highest.
inline std::int32_t middle_level(Span<const BarTurn> turns, int i) {
    const auto count = static_cast<int>(turns.size());
    const bool dark = turns[i].level < turns[i + 1].level;
    std::int32_t least = turns[dark ? i : i + 1].level;
    std::int32_t most = turns[dark ? i + 1 : i].level;
    const int first = maximum(i - 4, 0);
    const int last = minimum(i + 5, count - 1);
    const int dark_parity = dark ? i : i + 1;
    for (int near = first + ((first ^ dark_parity) & 1); near <= last; near += 2)
        least = minimum(least, turns[near].level);
    for (int near = first + 1 - ((first ^ dark_parity) & 1); near <= last; near += 2)
        most = maximum(most, turns[near].level);
    return (least + most) / 2;
}

/// Where the profile passes a level on its way from one turn to the next, in 1/256 sample.
inline std::int32_t crossing(BarProfile profile, BarTurn from, BarTurn to, std::int32_t level) {
    const bool rising = to.level > from.level;
    std::int32_t at = from.place;
    // From the steep middle outwards would find the same on clean lines; the first crossing from each side is
    // averaged where noise makes several.
    while (at + 1 < to.place && (rising ? profile[at + 1] < level : profile[at + 1] > level)) ++at;
    std::int32_t back = to.place;
    while (back - 1 > from.place && (rising ? profile[back - 1] > level : profile[back - 1] < level)) --back;
    const auto between = [&](std::int32_t left) {
        const std::int32_t a = profile[left];
        const std::int32_t b = profile[left + 1];
        if (a == b) return left * 256 + 128;
        return left * 256 + clamp<std::int32_t>((level - a) * 256 / (b - a), 0, 256);
    };
    return at == back - 1 ? between(at) : (between(at) + between(back - 1)) / 2;
}

/// Where the profile is steepest between two turns, in 1/256 sample.
inline std::int32_t steepest(BarProfile profile, BarTurn from, BarTurn to) {
    const std::int32_t sign = to.level > from.level ? 1 : -1;
    const auto last = static_cast<std::int32_t>(profile.size()) - 2;
    const auto slope = [&](std::int32_t at) {
        return at < 0 || at > last ? 0 : sign * (profile[at + 1] - profile[at]);
    };
    std::int32_t best = from.place;
    std::int32_t end = best;  // of the samples that are equally steep
    std::int32_t steep = slope(best);
    std::int32_t level = profile[minimum(best + 1, last + 1)];
    for (std::int32_t at = from.place + 1; at < to.place; ++at) {
        const std::int32_t next = profile[at + 1];
        const std::int32_t own = sign * (next - level);
        level = next;
        if (own > steep) {
            steep = own;
            best = end = at;
        } else if (own == steep && end == at - 1) {
            end = at;
        }
    }
    if (end > best) return (best + end) * 128 + 128;
    const std::int32_t before = maximum<std::int32_t>(slope(best - 1), 0);
    const std::int32_t behind = maximum<std::int32_t>(slope(best + 1), 0);
    const std::int32_t bend = 2 * steep - before - behind;
    const std::int32_t shift = bend > 0 ? (behind - before) * 128 / bend : 0;
    return best * 256 + 128 + clamp<std::int32_t>(shift, -128, 128);
}

}  // namespace detail

inline void sharpen_bar_profile(BarProfile profile, int reach, Span<std::int16_t> sharp) {
    const auto last = static_cast<int>(profile.size()) - 1;
    const auto at_border = [&](int i) {
        const std::int32_t mean = (profile[maximum(i - reach, 0)] + profile[minimum(i + reach, last)]) / 2;
        sharp[i] = static_cast<std::int16_t>(2 * profile[i] - mean);
    };
    int i = 0;
    for (; i < minimum(reach, last + 1); ++i) at_border(i);
    for (; i + reach <= last; ++i) {
        sharp[i] = static_cast<std::int16_t>(2 * profile[i] - (profile[i - reach] + profile[i + reach]) / 2);
    }
    for (; i <= last; ++i) at_border(i);
}

namespace detail {

/// As find_bar_turns(), for the ranges that find_bar_ranges() found and the whole contrast that it answered.
inline int find_turns_in_ranges(BarProfile profile, int share, Span<const std::int16_t> ranges,
                                std::int32_t whole, Span<BarTurn> turns) {
    const auto length = static_cast<int>(profile.size());
    const std::int32_t floor = maximum(detail::least_bar_contrast, whole / 32);
    int count = 0;
    std::int32_t high = profile[0];
    std::int32_t low = high;
    std::int32_t high_at = 0;
    std::int32_t low_at = 0;
    int heading = 0;  // 1 where the last turn was dark, -1 where it was bright
    for (int block = 0; block * detail::bar_block < length; ++block) {
        const std::int32_t step = maximum<std::int32_t>(floor, ranges[block] / share);
        const int end = minimum(length, (block + 1) * detail::bar_block);
        for (int at = block * detail::bar_block; at < end; ++at) {
            const std::int32_t level = profile[at];
            // Before the first turn it is not known which of both it will be.
            if (heading >= 0 && level > high) {
                high = level;
                high_at = at;
            }
            if (heading <= 0 && level < low) {
                low = level;
                low_at = at;
            }
            if (heading >= 0 && high - level >= step) {
                turns[count++] = {high_at, high};
                heading = -1;
                low = level;
                low_at = at;
            } else if (heading <= 0 && level - low >= step) {
                turns[count++] = {low_at, low};
                heading = 1;
                high = level;
                high_at = at;
            }
        }
    }
    if (heading == 1) turns[count++] = {high_at, high};
    if (heading == -1) turns[count++] = {low_at, low};
    return count;
}

}  // namespace detail

inline int find_bar_turns(BarProfile profile, int share, Span<std::int16_t> ranges, Span<BarTurn> turns) {
    if (profile.size() < 2) return 0;
    const std::int32_t whole = detail::find_bar_ranges(profile, ranges);
    return detail::find_turns_in_ranges(profile, share, ranges, whole, turns);
}

inline int find_bar_edges(BarProfile profile, Span<const BarTurn> turns, BarEdgeRule rule,
                          Span<std::int32_t> edges) {
    const auto count = static_cast<int>(turns.size());
    if (count < 2) return 0;
    int found = 0;
    edges[found++] = 0;
    // A line that begins with a bar begins with a space of no width.
    if (turns[0].level < turns[1].level) edges[found++] = 0;
    std::int32_t previous = 0;
    for (int i = 0; i + 1 < count; ++i) {
        const BarTurn from = turns[i];
        const BarTurn to = turns[i + 1];
        std::int32_t place = 0;
        if (rule == BarEdgeRule::steepest) {
            place = detail::steepest(profile, from, to);
        } else {
            std::int32_t level = (from.level + to.level) / 2;
            if (rule == BarEdgeRule::level) {
                const std::int32_t middle = detail::middle_level(turns, i);
                const std::int32_t least = minimum(from.level, to.level);
                const std::int32_t most = maximum(from.level, to.level);
                // Kept within the middle three quarters, where the flank is steep enough to be found.
                level = clamp((level + middle) / 2, least + (most - least) / 8, most - (most - least) / 8);
            }
            place = detail::crossing(profile, from, to, level);
        }
        previous = maximum(previous + 1, place);
        edges[found++] = previous;
    }
    edges[found++] = maximum(previous + 1, (static_cast<std::int32_t>(profile.size()) - 1) * 256);
    return found;
}

inline int reverse_bar_edges(BarEdges edges, Span<std::int32_t> reversed) {
    const auto count = static_cast<int>(edges.size());
    if (count < 2) return 0;
    const std::int32_t end = edges[count - 1];
    int found = 0;
    // Runs lie between edges: with an even number of edges the last run is a space already.
    if (count % 2 == 1) reversed[found++] = 0;
    for (int i = count - 1; i >= 0; --i) reversed[found++] = end - edges[i];
    return found;
}

inline int invert_bar_edges(Span<std::int32_t> edges, int count) {
    if (count == 0) return 0;
    // A space of no width comes before the first run.
    for (int i = count; i > 0; --i) edges[i] = edges[i - 1];
    return count + 1;
}

}  // namespace fovea
