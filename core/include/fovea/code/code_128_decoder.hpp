// SPDX-License-Identifier: MIT
//
// Code 128 along one scan line. ISO/IEC 15417.
#pragma once

#include <cstdint>

#include <fovea/base/status.hpp>
#include <fovea/code/bar_reading.hpp>
#include <fovea/code/code_128_tables.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Reads the Code 128 that begins with the bar behind edge `first`. FNC1 at the beginning makes the
/// identifier ]C1 (GS1-128), behind one letter or two digits ]C2; anywhere else it is the byte GS (29). FNC2
/// and FNC3 are left out, FNC4 adds 128.
///
/// Shapes    `first` odd. Quiet zones of at least half of what the standard asks
/// Rounding  each character is the nearest one, and must be nearer than the next by a clear margin
/// Errors    out_of_range; not_found for what is none and for texts above most_bar_text, with the reading
///           untouched
/// Source    ISO/IEC 15417, 4.3 and annex B, the reference decoding algorithm
inline Status decode_code_128(BarEdges edges, int first, BarReading& reading);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// How far a character may lie from the ideal one, and how much farther the next one must be: squares of
/// 1/64 module.
inline constexpr int code_128_farthest = 4500;
inline constexpr int code_128_margin = 1500;
inline constexpr int most_code_128_characters = most_bar_text + 32;

struct Code128Character {
    int value = 0;
    int distance = 0;
};

constexpr int code_128_width(int value, int run) {
    const std::uint32_t widths = value == code_128::stop ? code_128_stop_widths >> 4 : code_128_widths[value];
    return static_cast<int>(widths >> (20 - 4 * run) & 7U);
}

/// Half the sum by which the bars of a character are too wide, in 1/64 module: three bars' gain.
constexpr int code_128_bars(BarEdges edges, int at) {
    const std::int64_t width = std::int64_t{edges[at + 6]} - edges[at];
    std::int64_t bars = 0;
    for (int run = 0; run < 6; run += 2) bars += std::int64_t{edges[at + run + 1]} - edges[at + run];
    return static_cast<int>(round_divide(bars * (11 * 64), width));
}
constexpr int code_128_dark(int value) {
    return code_128_width(value, 0) + code_128_width(value, 2) + code_128_width(value, 4);
}

/// The character between edges `at` and at + 6: a start character, or any other one. gain is what
/// code_128_bars() is above what it should be, which a start character tells first.
enum class Code128Place : std::uint8_t { start, inside };
constexpr bool read_code_128_character(BarEdges edges, int at, Code128Place place, int gain,
                                       Code128Character& character) {
    const std::int64_t width = std::int64_t{edges[at + 6]} - edges[at];
    if (width <= 0) return false;
    int similar[4] = {};
    for (int i = 0; i < 4; ++i) {
        similar[i] = static_cast<int>(
            round_divide((std::int64_t{edges[at + i + 2]} - edges[at + i]) * (11 * 64), width));
    }
    const int bars = code_128_bars(edges, at) - gain;
    int best = code_128_farthest * 4;
    int next = best;
    const bool starts = place == Code128Place::start;
    const int last = starts ? code_128::start_c : code_128::stop;
    for (int value = starts ? code_128::start_a : 0; value <= last; ++value) {
        if (!starts && value == code_128::start_a) value = code_128::stop;
        int distance = 0;
        for (int i = 0; i < 4 && distance < next; ++i) {
            const int off = similar[i] - 64 * (code_128_width(value, i) + code_128_width(value, i + 1));
            distance += off * off;
        }
        if (!starts) {
            const int off = bars - 64 * code_128_dark(value);
            distance += off * off / 2;
        }
        if (distance < best) {
            next = best;
            best = distance;
            character.value = value;
        } else if (distance < next) {
            next = distance;
        }
    }
    character.distance = best;
    return best <= code_128_farthest && next - best >= code_128_margin;
}

/// True if the bar behind the first six runs of a stop character is of two modules.
constexpr bool ends_code_128(BarEdges edges, int at) {
    const std::int64_t width = std::int64_t{edges[at + 6]} - edges[at];
    const std::int64_t bar = std::int64_t{edges[at + 7]} - edges[at + 6];
    return is_about(bar * 11, width * 2, 128, 400);
}

/// What the characters between start and check say.
class Code128Text {
public:
    constexpr Code128Text(int start, BarReading& reading)
        : reading_(reading), set_(start - code_128::start_a) {
        reading_.size = 0;
        reading_.aim_digit = '0';
    }

    /// False where a character is none of its set or there is no room.
    constexpr bool take(int value) {
        const int place = place_++;
        if (value == code_128::fnc_1) return function_1(place);
        if (set_ == set_c) {
            if (value < 100) return push('0' + value / 10) && push('0' + value % 10);
            set_ = value == code_128::code_b ? set_b : set_a;
            return value <= code_128::code_a;
        }
        const int set = shifted_ ? set_a + set_b - set_ : set_;
        const bool was_shifted = shifted_;
        shifted_ = false;
        if (value < 96) {
            const int sign = set == set_b || value < 64 ? value + 32 : value - 64;
            return push(upper() ? sign + 128 : sign);
        }
        if (was_shifted) return false;
        if (value == code_128::shift) {
            shifted_ = true;
        } else if (value == code_128::code_c) {
            set_ = set_c;
        } else if (value == (set_ == set_b ? code_128::code_b : code_128::code_a)) {
            function_4();
        } else if (value == code_128::code_a) {
            set_ = set_a;
        } else if (value == code_128::code_b) {
            set_ = set_b;
        }
        return true;
    }

private:
    static constexpr int set_a = 0;
    static constexpr int set_b = 1;
    static constexpr int set_c = 2;

    constexpr bool push(int sign) {
        if (reading_.size >= most_bar_text) return false;
        reading_.text[reading_.size++] = static_cast<std::uint8_t>(sign);
        return true;
    }
    constexpr bool function_1(int place) {
        if (place == 0) {
            reading_.aim_digit = '1';
            return true;
        }
        const bool letter = reading_.size == 1 && ((reading_.text[0] >= 'A' && reading_.text[0] <= 'Z') ||
                                                   (reading_.text[0] >= 'a' && reading_.text[0] <= 'z'));
        const bool digits = reading_.size == 2 && place == 1 && set_ == set_c;
        if (reading_.aim_digit == '0' && (letter || digits)) {
            reading_.aim_digit = '2';
            return true;
        }
        return push(29);
    }
    /// One is for one character, two of them latch or unlatch.
    constexpr void function_4() {
        if (next_upper_) latched_ = !latched_;
        next_upper_ = !next_upper_;
    }
    constexpr bool upper() {
        const bool is = latched_ != next_upper_;
        next_upper_ = false;
        return is;
    }

    BarReading& reading_;
    int set_;
    int place_ = 0;
    bool shifted_ = false;
    bool next_upper_ = false;
    bool latched_ = false;
};

}  // namespace detail

inline Status decode_code_128(BarEdges edges, int first, BarReading& reading) {
    if (first < 1 || first % 2 == 0 || first >= edges.size()) return Status::out_of_range;
    // Start, one character, check, stop.
    if (first + 6 * 3 + 7 + 1 >= edges.size()) return Status::not_found;
    const std::int64_t start_width = std::int64_t{edges[first + 6]} - edges[first];
    const std::int64_t left = std::int64_t{edges[first]} - edges[first - 1];
    if (left * 11 < start_width * 5 || start_width < 11 * 128) return Status::not_found;
    detail::Code128Character character;
    if (!detail::read_code_128_character(edges, first, detail::Code128Place::start, 0, character)) {
        return Status::not_found;
    }
    BarReading found;
    found.symbology = Symbology::code_128;
    detail::Code128Text text(character.value, found);
    // The gain in eighths, so that it can follow slowly.
    int gain = 8 * (detail::code_128_bars(edges, first) - 64 * detail::code_128_dark(character.value));
    int sum = character.value;
    int previous = -1;
    std::int64_t error = static_cast<std::int64_t>(isqrt(static_cast<std::uint32_t>(character.distance)));
    std::int64_t before = start_width;
    int at = first + 6;
    for (int place = 1;; ++place, at += 6) {
        if (place > detail::most_code_128_characters || at + 8 >= edges.size()) return Status::not_found;
        const std::int64_t width = std::int64_t{edges[at + 6]} - edges[at];
        if (!detail::is_about(width, before, 205, 320)) return Status::not_found;
        before = width;
        if (!detail::read_code_128_character(edges, at, detail::Code128Place::inside,
                                             static_cast<int>(round_shift(gain, 3)), character)) {
            return Status::not_found;
        }
        if (character.value == code_128::stop) {
            if (previous < 0 || !detail::ends_code_128(edges, at)) return Status::not_found;
            break;
        }
        gain += detail::code_128_bars(edges, at) - 64 * detail::code_128_dark(character.value) -
                static_cast<int>(round_shift(gain, 3));
        error += static_cast<std::int64_t>(isqrt(static_cast<std::uint32_t>(character.distance)));
        // One behind, as the last one is the check character.
        if (previous >= 0) {
            if (!text.take(previous)) return Status::not_found;
            sum = (sum + (place - 1) * previous) % 103;
        }
        previous = character.value;
    }
    if (sum != previous || found.size == 0) return Status::not_found;
    const std::int64_t right = std::int64_t{edges[at + 8]} - edges[at + 7];
    const std::int64_t stop_width = std::int64_t{edges[at + 7]} - edges[at];
    found.first = first;
    found.last = at + 7;
    found.base = found.size;
    found.error = static_cast<int>(error * 4 * 6 / (at - first));
    found.quiet = minimum(detail::quiet_share(left, start_width, 11, 10),
                          detail::quiet_share(right, stop_width, 13, 10));
    if (found.quiet < 256 * 2 / 5) return Status::not_found;
    reading = found;
    return Status::ok;
}

}  // namespace fovea
