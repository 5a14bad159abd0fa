// SPDX-License-Identifier: MIT
//
// Code 39, Interleaved 2 of 5 and Codabar as bars and spaces. ISO/IEC 16388, ISO/IEC 16390, EN 798.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/code/bar_reading.hpp>
#include <fovea/code/codabar.hpp>
#include <fovea/code/code_39.hpp>
#include <fovea/code/ean_encoder.hpp>
#include <fovea/code/interleaved_2_of_5.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// How they are drawn.
struct TwoWidthOptions {
    int wide = 3;             ///< modules of a wide bar or space: 2 is shorter, 3 survives more blur
    bool with_check = false;  ///< a check character or digit is added
};

/// The bars of a code.
///
/// Shapes  1..most_bar_text bytes, for Code 39 after pairs were made of what is not one of its characters;
///         digits for Interleaved 2 of 5, which gets a leading 0 where their number is odd; for Codabar start
///         and stop are A unless the text begins and ends with one of ABCD
/// Errors  bad_argument for other bytes and for a wide other than 2 and 3; buffer_too_small, with the list
///         untouched. The list is appended to
/// Source  ISO/IEC 16388, 4.3; ISO/IEC 16390, 4.3; EN 798
constexpr Status encode_code_39(Span<const std::uint8_t> text, Code39Text kind,
                                const TwoWidthOptions& options, BarWidths widths);
constexpr Status encode_interleaved(Span<const std::uint8_t> text, const TwoWidthOptions& options,
                                    BarWidths widths);
constexpr Status encode_codabar(Span<const std::uint8_t> text, const TwoWidthOptions& options,
                                BarWidths widths);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Adds runs that are wide where the mask, the first run in its highest bit, says so.
constexpr void add_two_width(BarWriter& writer, unsigned mask, int runs, int wide) {
    for (int i = runs; i-- > 0;) writer.add((mask >> i & 1U) != 0 ? wide : 1);
}

/// The values of Code 39 that a text makes. False where it does not fit them.
constexpr bool take_code_39(Span<const std::uint8_t> text, Code39Text kind,
                            std::uint8_t (&values)[most_bar_text + 1], int& count) {
    count = 0;
    for (const std::uint8_t sign : text) {
        Code39Pair pair{0, static_cast<char>(sign & 127)};
        if (sign > 127) return false;
        if (kind == Code39Text::full_ascii) pair = code_39_pair(sign);
        for (int half = pair.first == 0 ? 1 : 0; half < 2; ++half) {
            const int value = code_39_value(half == 0 ? pair.first : pair.second);
            if (value < 0 || count >= most_bar_text) return false;
            values[count++] = static_cast<std::uint8_t>(value);
        }
    }
    return count > 0;
}

}  // namespace detail

constexpr Status encode_code_39(Span<const std::uint8_t> text, Code39Text kind,
                                const TwoWidthOptions& options, BarWidths widths) {
    std::uint8_t values[most_bar_text + 1] = {};
    int count = 0;
    if (options.wide < 2 || options.wide > 3) return Status::bad_argument;
    if (!detail::take_code_39(text, kind, values, count)) return Status::bad_argument;
    if (options.with_check) {
        int sum = 0;
        for (int i = 0; i < count; ++i) sum += values[i];
        values[count++] = static_cast<std::uint8_t>(sum % code_39_count);
    }
    if (!detail::has_room(widths, (count + 2) * 10 - 1)) return Status::buffer_too_small;
    detail::BarWriter writer(widths);
    detail::add_two_width(writer, code_39_asterisk, 9, options.wide);
    for (int i = 0; i < count; ++i) {
        writer.add(1);
        detail::add_two_width(writer, code_39_wide[values[i]], 9, options.wide);
    }
    writer.add(1);
    detail::add_two_width(writer, code_39_asterisk, 9, options.wide);
    return Status::ok;
}

constexpr Status encode_interleaved(Span<const std::uint8_t> text, const TwoWidthOptions& options,
                                    BarWidths widths) {
    if (options.wide < 2 || options.wide > 3 || text.empty()) return Status::bad_argument;
    const auto given = static_cast<int>(text.size()) + (options.with_check ? 1 : 0);
    const int count = given + given % 2;
    if (count > most_bar_text) return Status::bad_argument;
    std::uint8_t digits[most_bar_text] = {};
    for (int i = 0; i < static_cast<int>(text.size()); ++i) {
        if (text[i] < '0' || text[i] > '9') return Status::bad_argument;
        digits[count - given + i] = static_cast<std::uint8_t>(text[i] - '0');
    }
    if (options.with_check) {
        digits[count - 1] = static_cast<std::uint8_t>(ean_check_digit({digits, count - 1}));
    }
    if (!detail::has_room(widths, 4 + 5 * count + 3)) return Status::buffer_too_small;
    detail::BarWriter writer(widths);
    writer.guard(4);
    for (int i = 0; i < count; i += 2) {
        for (int run = 4; run >= 0; --run) {
            writer.add((interleaved_wide[digits[i]] >> run & 1) != 0 ? options.wide : 1);
            writer.add((interleaved_wide[digits[i + 1]] >> run & 1) != 0 ? options.wide : 1);
        }
    }
    writer.add(options.wide);
    writer.guard(2);
    return Status::ok;
}

constexpr Status encode_codabar(Span<const std::uint8_t> text, const TwoWidthOptions& options,
                                BarWidths widths) {
    if (options.wide < 2 || options.wide > 3 || text.empty()) return Status::bad_argument;
    const auto is_end = [](int sign) { return sign >= 'A' && sign <= 'D'; };
    const bool has_ends = text.size() > 2 && is_end(text[0]) && is_end(text[text.size() - 1]);
    const Span<const std::uint8_t> data =
        has_ends ? Span<const std::uint8_t>(text.data() + 1, text.size() - 2) : text;
    const int start = codabar_value(has_ends ? text[0] : 'A');
    const int stop = codabar_value(has_ends ? text[text.size() - 1] : 'A');
    int sum = start + stop;
    for (const std::uint8_t sign : data) {
        const int value = codabar_value(sign);
        if (value < 0 || value >= 16) return Status::bad_argument;
        sum += value;
    }
    const std::int64_t characters = std::int64_t{data.size()} + (options.with_check ? 3 : 2);
    if (characters > most_bar_text + 2) return Status::bad_argument;
    if (!detail::has_room(widths, static_cast<int>(characters) * 8 - 1)) return Status::buffer_too_small;
    detail::BarWriter writer(widths);
    const auto add = [&](int value) { detail::add_two_width(writer, codabar_wide[value], 7, options.wide); };
    add(start);
    for (const std::uint8_t sign : data) {
        writer.add(1);
        add(codabar_value(sign));
    }
    if (options.with_check) {
        writer.add(1);
        add((16 - sum % 16) % 16);
    }
    writer.add(1);
    add(stop);
    return Status::ok;
}

}  // namespace fovea
