// SPDX-License-Identifier: MIT
//
// Code 39 along one scan line. ISO/IEC 16388.
#pragma once

#include <cstdint>

#include <fovea/base/status.hpp>
#include <fovea/code/bar_reading.hpp>
#include <fovea/code/code_39.hpp>
#include <fovea/code/two_width.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Reads the Code 39 that begins with the bar behind edge `first`, without its asterisks. The identifier is
/// ]A0, ]A1 with a check character that was verified, ]A3 with one that was verified and removed, and 4 more
/// with full ASCII.
///
/// Shapes    `first` odd. Quiet zones of at least half of what the standard asks
/// Errors    out_of_range; not_found for what is none, and for texts above most_bar_text, with the reading
///           untouched
/// Source    ISO/IEC 16388, 4.3 to 4.5 and annex B
inline Status decode_code_39(BarEdges edges, int first, const BarRules& rules, BarReading& reading);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Sixteenths by which the narrowest wide run is wider than the widest narrow one. Half of the ways to choose
/// three runs of nine are no character, which makes up for a small gap.
inline constexpr int code_39_gap = 4;

/// Spreads pairs into ASCII, within the reading. False if a pair has no meaning.
constexpr bool spread_code_39(BarReading& reading) {
    int size = 0;
    for (int i = 0; i < reading.size; ++i) {
        int sign = reading.text[i];
        if (sign == '$' || sign == '%' || sign == '/' || sign == '+') {
            if (++i >= reading.size) return false;
            sign = code_39_ascii(sign, reading.text[i]);
            if (sign < 0) return false;
        }
        reading.text[size++] = static_cast<std::uint8_t>(sign);
    }
    reading.size = size;
    return true;
}

/// Verifies and removes the check character as asked, and spreads.
constexpr bool finish_code_39(const BarRules& rules, BarReading& reading) {
    if (rules.code_39_check != CheckCharacter::unknown) {
        if (reading.size < 2) return false;
        int sum = 0;
        for (int i = 0; i + 1 < reading.size; ++i) sum += code_39_value(reading.text[i]);
        if (sum % code_39_count != code_39_value(reading.text[reading.size - 1])) return false;
        reading.aim_digit = '1';
        if (rules.code_39_check == CheckCharacter::removed) {
            --reading.size;
            reading.aim_digit = '3';
        }
    }
    if (rules.code_39_text == Code39Text::full_ascii) {
        if (!spread_code_39(reading)) return false;
        reading.aim_digit = static_cast<char>(reading.aim_digit + 4);
    }
    return reading.size > 0;
}

}  // namespace detail

inline Status decode_code_39(BarEdges edges, int first, const BarRules& rules, BarReading& reading) {
    if (first < 1 || first % 2 == 0 || first >= edges.size()) return Status::out_of_range;
    if (first + 29 + 1 >= edges.size()) return Status::not_found;
    const std::int64_t left = std::int64_t{edges[first]} - edges[first - 1];
    const std::int64_t start_width = std::int64_t{edges[first + 9]} - edges[first];
    // A character is of 12 to 16 narrow widths, a quiet zone of ten.
    if (left * 3 < start_width || start_width < 12 * 128) return Status::not_found;
    // If this is an asterisk, narrow bars stand at 0, 2 and 8 of it and narrow spaces at 3, 5 and 7.
    const auto run = [&](int at) { return std::int64_t{edges[first + at + 1]} - edges[first + at]; };
    const std::int64_t gain = (run(0) + run(2) + run(8) - run(3) - run(5) - run(7)) / 6;
    TwoWidths sorted;
    if (!sort_widths(edges, first, 1, 9, 3, gain, detail::code_39_gap, sorted) ||
        sorted.wide != code_39_asterisk) {
        return Status::not_found;
    }

    BarReading found;
    found.symbology = Symbology::code_39;
    std::int64_t error = sorted.error;
    std::int64_t before = start_width;
    int characters = 1;
    int at = first + 10;
    for (;; at += 10) {
        if (at + 10 >= edges.size()) return Status::not_found;
        const std::int64_t width = std::int64_t{edges[at + 9]} - edges[at];
        const std::int64_t gap = std::int64_t{edges[at]} - edges[at - 1];
        // Characters are equally wide; the gap between them is at most 5.3 narrow widths.
        if (!detail::is_about(width, before, 205, 320) || gap * 12 > width * 6) return Status::not_found;
        before = width;
        if (!sort_widths(edges, at, 1, 9, 3, gain, detail::code_39_gap, sorted)) return Status::not_found;
        error += sorted.error;
        ++characters;
        if (sorted.wide == code_39_asterisk) break;
        int value = 0;
        while (value < code_39_count && code_39_wide[value] != sorted.wide) ++value;
        if (value == code_39_count || found.size >= most_bar_text) return Status::not_found;
        found.text[found.size++] = static_cast<std::uint8_t>(code_39_characters[value]);
    }
    if (!detail::finish_code_39(rules, found)) return Status::not_found;
    const std::int64_t right = std::int64_t{edges[at + 10]} - edges[at + 9];
    found.first = first;
    found.last = at + 9;
    found.base = found.size;
    found.error = static_cast<int>(error / characters);
    found.quiet = minimum(detail::quiet_share(left, sorted.narrow, 1, 10),
                          detail::quiet_share(right, sorted.narrow, 1, 10));
    if (found.quiet < 256 / 2) return Status::not_found;
    reading = found;
    return Status::ok;
}

}  // namespace fovea
