// SPDX-License-Identifier: MIT
//
// Interleaved 2 of 5: its digits, and how it is read along one scan line. ISO/IEC 16390.
#pragma once

#include <cstdint>

#include <fovea/base/status.hpp>
#include <fovea/code/bar_reading.hpp>
#include <fovea/code/ean_tables.hpp>
#include <fovea/code/two_width.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Which of the five bars, or spaces, of a digit are wide, the first in the highest bit. ISO/IEC 16390,
/// 4.3.1, table 1.
inline constexpr std::uint8_t interleaved_wide[10] = {0b00110, 0b10001, 0b01001, 0b11000, 0b00101,
                                                      0b10100, 0b01100, 0b00011, 0b10010, 0b01010};

/// Reads the Interleaved 2 of 5 that begins with the bar behind edge `first`: ]I0, ]I1 with a check digit
/// that was verified, ]I3 with one that was verified and removed.
///
/// Nothing but the quiet zones tells a short code from a part of a longer one: they must be there, and the
/// lengths are limited by the rules.
///
/// Shapes    `first` odd. Quiet zones of at least three quarters of what the standard asks: in a blurred code
///         two wide spaces and the narrow bar between them look like more than half of one
/// Errors    out_of_range; not_found for what is none, with the reading untouched
/// Source    ISO/IEC 16390, 4.3, 4.4 and annex A
inline Status decode_interleaved(BarEdges edges, int first, const BarRules& rules, BarReading& reading);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Sixteenths by which the narrowest wide run is wider than the widest narrow one. Any two of five are a
/// digit, so that it must be clear which.
inline constexpr int interleaved_gap = 5;
/// The worst mean error, in 1/256 of a narrow width: true codes have 13, nine of ten of them up to 24; a
/// blurred Code 39 read as six digits with 40 and more.
inline constexpr int short_interleaved_worst = 36;
inline constexpr int interleaved_worst = 56;

/// The digit of five bars or spaces, every second run from edge `at`; -1 if they are none.
constexpr int read_interleaved_digit(BarEdges edges, int at, TwoWidths& sorted) {
    if (!sort_widths(edges, at, 2, 5, 2, 0, interleaved_gap, sorted)) return -1;
    for (int digit = 0; digit < 10; ++digit)
        if (interleaved_wide[digit] == sorted.wide) return digit;
    return -1;
}

/// True if the wide runs of a pair are as wide as those of the pair before, and its narrow ones as narrow,
/// by some more than pairs may differ in perspective. Of bars that are no code and pass every other test
/// thirteen in fourteen fail this one.
constexpr bool are_interleaved_alike(const TwoWidths& one, const TwoWidths& before) {
    return is_about(one.broad, before.broad, 192, 341) && is_about(one.narrow, before.narrow, 154, 427);
}

constexpr bool finish_interleaved(const BarRules& rules, BarReading& reading) {
    if (reading.size < rules.interleaved_shortest || reading.size > rules.interleaved_longest) return false;
    if (rules.interleaved_check == CheckCharacter::unknown) return true;
    std::uint8_t digits[most_bar_text] = {};
    for (int i = 0; i < reading.size; ++i) digits[i] = static_cast<std::uint8_t>(reading.text[i] - '0');
    if (ean_check_digit({digits, reading.size - 1}) != digits[reading.size - 1]) return false;
    reading.aim_digit = '1';
    if (rules.interleaved_check == CheckCharacter::removed) {
        --reading.size;
        reading.aim_digit = '3';
    }
    return true;
}

}  // namespace detail

inline Status decode_interleaved(BarEdges edges, int first, const BarRules& rules, BarReading& reading) {
    if (first < 1 || first % 2 == 0 || first >= edges.size()) return Status::out_of_range;
    const auto run = [&](int at) { return std::int64_t{edges[at + 1]} - edges[at]; };
    if (first + 4 + 10 + 3 + 1 >= edges.size()) return Status::not_found;
    // Four narrow runs: pairs of a bar and a space are alike whatever the gain is.
    const std::int64_t start = std::int64_t{edges[first + 4]} - edges[first];
    const std::int64_t left = run(first - 1);
    if (left * 4 < start * 5 || start < 4 * 128) return Status::not_found;
    for (int i = 0; i < 4; ++i)
        if (run(first + i) * 2 > start) return Status::not_found;
    if (!detail::is_about(run(first) + run(first + 1), run(first + 2) + run(first + 3), 170, 384)) {
        return Status::not_found;
    }
    BarReading found;
    found.symbology = Symbology::interleaved_2_of_5;
    std::int64_t error = 0;
    std::int64_t narrow = start / 4;
    std::int64_t before = 0;
    TwoWidths bars;
    TwoWidths spaces;
    int at = first + 4;
    for (;; at += 10) {
        if (at + 4 >= edges.size()) return Status::not_found;
        // The stop pattern is a wide bar, a narrow space, a narrow bar and the quiet zone.
        if (found.size > 0 && run(at) * 3 >= run(at + 2) * 4 && run(at + 3) >= 7 * narrow &&
            run(at) <= 5 * narrow && run(at + 1) * 2 <= 5 * narrow && run(at + 2) * 2 <= 5 * narrow) {
            break;
        }
        if (at + 10 + 4 >= edges.size() || found.size + 2 > most_bar_text) return Status::not_found;
        const std::int64_t width = std::int64_t{edges[at + 10]} - edges[at];
        if (before != 0 && !detail::is_about(width, before, 205, 320)) return Status::not_found;
        before = width;
        const TwoWidths bars_before = bars;
        const TwoWidths spaces_before = spaces;
        const int bar_digit = detail::read_interleaved_digit(edges, at, bars);
        const int space_digit = detail::read_interleaved_digit(edges, at + 1, spaces);
        if (bar_digit < 0 || space_digit < 0) return Status::not_found;
        const std::int64_t own = (bars.narrow + spaces.narrow) / 2;
        if (!detail::is_about(own, narrow, 150, 440)) return Status::not_found;
        if (found.size > 0 && (!detail::are_interleaved_alike(bars, bars_before) ||
                               !detail::are_interleaved_alike(spaces, spaces_before))) {
            return Status::not_found;
        }
        narrow = own;
        error += (bars.error + spaces.error) / 2;
        found.text[found.size++] = static_cast<std::uint8_t>('0' + bar_digit);
        found.text[found.size++] = static_cast<std::uint8_t>('0' + space_digit);
    }
    const int pairs = found.size / 2;
    if (!detail::finish_interleaved(rules, found)) return Status::not_found;
    found.first = first;
    found.last = at + 3;
    found.base = found.size;
    found.error = static_cast<int>(error / pairs);
    found.quiet =
        minimum(detail::quiet_share(left, start, 4, 10), detail::quiet_share(run(at + 3), narrow, 1, 10));
    if (found.quiet < 256 * 3 / 4) return Status::not_found;
    if (found.error > (pairs <= 5 ? detail::short_interleaved_worst : detail::interleaved_worst)) {
        return Status::not_found;
    }
    reading = found;
    return Status::ok;
}

}  // namespace fovea
