// SPDX-License-Identifier: MIT
//
// Texts of codes on one line. What stands in a code is foreign: it may end a line, a record or a frame.
#pragma once

#include <cstdint>
#include <string>

#include <fovea/base/span.hpp>
#include <fovea/draw/utf8.hpp>

namespace fovea::apps {

/// Bytes at the begin of a text that end or disturb a line; 0 if none do: a control character of ASCII or of
/// Latin 1, a separator of lines or paragraphs (U+2028, U+2029), or bytes that are no UTF-8.
inline int disturbing_bytes(Span<const char> text) {
    const CodePoint read = first_code_point(text);
    const bool separates = read.value == 0x2028 || read.value == 0x2029;
    return is_control(read.value) || separates || is_no_utf8(read, text) ? read.bytes : 0;
}

/// Puts a byte as \n, \r, \t or \xNN, letter by letter.
template <class Put>
void put_escaped(char letter, Put put) {
    const auto byte = static_cast<std::uint8_t>(letter);
    put('\\');
    if (letter == '\n') return put('n');
    if (letter == '\r') return put('r');
    if (letter == '\t') return put('t');
    put('x');
    put("0123456789abcdef"[byte >> 4]);
    put("0123456789abcdef"[byte & 15]);
}

/// -1 for what is no hexadecimal digit.
constexpr int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

/// Reads what follows a backslash: n, r, t, xNN, or one of the letters that stand for themselves. at is
/// behind it then. False if it is none of them.
inline bool take_escape(const std::string& text, std::size_t& at, const std::string& themselves,
                        char& letter) {
    const char kind = at < text.size() ? text[at] : '\0';
    if (kind == 'x') {
        const int high = at + 1 < text.size() ? hex_digit(text[at + 1]) : -1;
        const int low = at + 2 < text.size() ? hex_digit(text[at + 2]) : -1;
        if (high < 0 || low < 0) return false;
        letter = static_cast<char>(16 * high + low);
        at += 3;
        return true;
    }
    if (kind == 'n' || kind == 'r' || kind == 't')
        letter = kind == 'n' ? '\n' : kind == 'r' ? '\r' : '\t';
    else if (kind != '\0' && themselves.find(kind) != std::string::npos)
        letter = kind;
    else
        return false;
    ++at;
    return true;
}

}  // namespace fovea::apps
