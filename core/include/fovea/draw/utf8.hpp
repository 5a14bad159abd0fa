// SPDX-License-Identifier: MIT
//
// UTF-8, read strictly.
#pragma once

#include <cstdint>

#include <fovea/base/assert.hpp>
#include <fovea/base/span.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Stands for bytes that are no character: U+FFFD.
inline constexpr std::uint32_t replacement_character = 0xfffd;

struct CodePoint {
    std::uint32_t value;
    int bytes;  ///< how many of the text it took, 1..4
};

/// The first code point of a text that is not empty.
///
/// Errors  none: replacement_character for overlong forms, surrogates, values above U+10FFFF, and stray or
///         missing bytes. It takes the bytes that could have begun a character, at least one, so that the
///         next character is never swallowed
/// Source  The Unicode Standard, version 15.0, sec. 3.9: table 3-7 and "Substitution of Maximal Subparts"
constexpr CodePoint first_code_point(Span<const char> text);

/// True if the first code point of a text was read from bytes that are no UTF-8.
constexpr bool is_no_utf8(CodePoint read, Span<const char> text);

/// True for the control characters of ASCII and of Latin 1, which terminals may obey.
constexpr bool is_control(std::uint32_t code_point) {
    return code_point < 0x20 || (code_point >= 0x7f && code_point < 0xa0);
}

/// True for UTF-8 without control characters, also for no text at all: a name that stays on its line.
constexpr bool is_printable(Span<const char> text);

// ---- Implementation ---------------------------------------------------------------

constexpr CodePoint first_code_point(Span<const char> text) {
    FOVEA_ASSERT(!text.empty());
    const std::uint32_t lead = static_cast<unsigned char>(text[0]);
    if (lead < 0x80) return {lead, 1};

    const int more = lead >= 0xc2 && lead <= 0xdf   ? 1
                     : lead >= 0xe0 && lead <= 0xef ? 2
                     : lead >= 0xf0 && lead <= 0xf4 ? 3
                                                    : 0;
    if (more == 0) return {replacement_character, 1};

    // The second byte alone decides about overlong forms, surrogates and the end of the code space.
    std::uint32_t low = lead == 0xe0 ? 0xa0 : lead == 0xf0 ? 0x90 : 0x80;
    std::uint32_t high = lead == 0xed ? 0x9f : lead == 0xf4 ? 0x8f : 0xbf;
    std::uint32_t value = lead & (0x3fu >> more);
    for (int i = 1; i <= more; ++i) {
        if (i >= text.size()) return {replacement_character, i};
        const std::uint32_t byte = static_cast<unsigned char>(text[i]);
        if (byte < low || byte > high) return {replacement_character, i};
        value = value << 6 | (byte & 0x3f);
        low = 0x80;
        high = 0xbf;
    }
    return {value, more + 1};
}

constexpr bool is_no_utf8(CodePoint read, Span<const char> text) {
    if (read.value != replacement_character) return false;
    // U+FFFD itself is written so.
    return read.bytes != 3 || text[0] != '\xef' || text[1] != '\xbf' || text[2] != '\xbd';
}

constexpr bool is_printable(Span<const char> text) {
    for (Span<const char> rest = text; !rest.empty();) {
        const CodePoint read = first_code_point(rest);
        if (is_no_utf8(read, rest) || is_control(read.value)) return false;
        rest = rest.from(read.bytes);
    }
    return true;
}

}  // namespace fovea
