// SPDX-License-Identifier: MIT
//
// Codabar: its characters, and how it is read along one scan line. EN 798.
#pragma once

#include <cstdint>

#include <fovea/base/status.hpp>
#include <fovea/code/bar_reading.hpp>
#include <fovea/code/two_width.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

inline constexpr int codabar_count = 20;
/// The characters by their value; the last four start and stop. EN 798, 4.2 and annex A.
inline constexpr char codabar_characters[codabar_count + 1] = "0123456789-$:/.+ABCD";
/// Which of the four bars and three spaces are wide, the first in the highest bit. EN 798, 4.2, table 1.
inline constexpr std::uint8_t codabar_wide[codabar_count] = {0x03, 0x06, 0x09, 0x60, 0x12, 0x42, 0x21,
                                                             0x24, 0x30, 0x48, 0x0C, 0x18, 0x45, 0x51,
                                                             0x54, 0x15, 0x1A, 0x29, 0x0B, 0x0E};

/// The value of a sign, -1 if it is none of them.
constexpr int codabar_value(int sign) {
    for (int value = 0; value < codabar_count; ++value)
        if (codabar_characters[value] == sign) return value;
    return -1;
}

/// Reads the Codabar that begins with the bar behind edge `first`, without its start and stop characters. The
/// identifier is ]F0, ]F2 with a check character that was verified, ]F4 with one that was verified and
/// removed.
///
/// Shapes    `first` odd. Quiet zones of at least half of what the standard asks; at least three characters
///           between start and stop, as fewer are found in too many pictures
/// Errors    out_of_range; not_found for what is none, and for texts above most_bar_text, with the reading
///           untouched
/// Source    EN 798
inline Status decode_codabar(BarEdges edges, int first, const BarRules& rules, BarReading& reading);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Sixteenths by which the narrowest wide run is wider than the widest narrow one.
inline constexpr int codabar_gap = 4;

/// The value of the seven runs from edge `at`, -1 if they are none. Two or three of them are wide.
constexpr int read_codabar_character(BarEdges edges, int at, std::int64_t gain, TwoWidths& sorted) {
    int best = -1;
    TwoWidths trial;
    for (int wide = 2; wide <= 3; ++wide) {
        if (!sort_widths(edges, at, 1, 7, wide, gain, codabar_gap, trial)) continue;
        if (best >= 0 && trial.error >= sorted.error) continue;
        for (int value = 0; value < codabar_count; ++value) {
            if (codabar_wide[value] == trial.wide) {
                best = value;
                sorted = trial;
            }
        }
    }
    return best;
}

/// The gain that a start character shows: three of its bars and one of its spaces are narrow.
constexpr std::int64_t codabar_gain(BarEdges edges, int at) {
    const auto run = [&](int i) { return std::int64_t{edges[at + i + 1]} - edges[at + i]; };
    const std::int64_t widest = maximum(maximum(run(0), run(2)), maximum(run(4), run(6)));
    const std::int64_t space = minimum(minimum(run(1), run(3)), run(5));
    return ((run(0) + run(2) + run(4) + run(6) - widest) / 3 - space) / 2;
}

constexpr bool finish_codabar(const BarRules& rules, int start, int stop, BarReading& reading) {
    if (rules.codabar_check == CheckCharacter::unknown) return reading.size >= 3;
    int sum = start + stop;
    for (int i = 0; i < reading.size; ++i) sum += codabar_value(reading.text[i]);
    if (sum % 16 != 0) return false;
    reading.aim_digit = '2';
    if (rules.codabar_check == CheckCharacter::removed) {
        --reading.size;
        reading.aim_digit = '4';
    }
    return reading.size >= 3;
}

}  // namespace detail

inline Status decode_codabar(BarEdges edges, int first, const BarRules& rules, BarReading& reading) {
    if (first < 1 || first % 2 == 0 || first >= edges.size()) return Status::out_of_range;
    if (first + 8 * 5 >= edges.size()) return Status::not_found;
    const std::int64_t left = std::int64_t{edges[first]} - edges[first - 1];
    const std::int64_t start_width = std::int64_t{edges[first + 7]} - edges[first];
    if (left * 3 < start_width || start_width < 10 * 128) return Status::not_found;
    const std::int64_t gain = detail::codabar_gain(edges, first);
    TwoWidths sorted;
    const int start = detail::read_codabar_character(edges, first, gain, sorted);
    if (start < 16) return Status::not_found;
    std::int64_t narrow = sorted.narrow;
    const std::int64_t first_narrow = narrow;
    std::int64_t before = start_width;

    BarReading found;
    found.symbology = Symbology::codabar;
    std::int64_t error = sorted.error;
    int value = start;
    int characters = 1;
    int at = first + 8;
    for (;; at += 8) {
        if (at + 8 >= edges.size()) return Status::not_found;
        const std::int64_t gap = std::int64_t{edges[at]} - edges[at - 1];
        const std::int64_t width = std::int64_t{edges[at + 7]} - edges[at];
        if (gap > 4 * narrow || !detail::is_about(width, before, 128, 512)) return Status::not_found;
        value = detail::read_codabar_character(edges, at, gain, sorted);
        if (value < 0 || !detail::is_about(sorted.narrow, narrow, 140, 440)) return Status::not_found;
        before = width;
        narrow = sorted.narrow;
        error += sorted.error;
        ++characters;
        if (value >= 16) break;
        if (found.size >= most_bar_text) return Status::not_found;
        found.text[found.size++] = static_cast<std::uint8_t>(codabar_characters[value]);
    }
    if (!detail::finish_codabar(rules, start, value, found)) return Status::not_found;
    const std::int64_t right = std::int64_t{edges[at + 8]} - edges[at + 7];
    found.first = first;
    found.last = at + 7;
    found.base = found.size;
    found.error = static_cast<int>(error / characters);
    found.quiet =
        minimum(detail::quiet_share(left, first_narrow, 1, 10), detail::quiet_share(right, narrow, 1, 10));
    if (found.quiet < 256 / 2) return Status::not_found;
    reading = found;
    return Status::ok;
}

}  // namespace fovea
