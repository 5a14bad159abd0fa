// SPDX-License-Identifier: MIT
//
// Text for people and for machines: numbers without binary floating point, JSON strings, and the nearest
// right name for a wrong one.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <fovea/base/span.hpp>
#include <fovea/draw/utf8.hpp>
#include <fovea/number/angle.hpp>
#include <fovea/number/decimal.hpp>
#include <fovea/number/fixed.hpp>

#include <common/decimals.hpp>

namespace fovea::apps {

inline Span<const char> span_of(const std::string& text) {
    return {text.data(), static_cast<std::ptrdiff_t>(text.size())};
}
inline std::string string_of(Span<const char> text) {
    return {text.data(), static_cast<std::size_t>(text.size())};
}
inline Span<const std::uint8_t> bytes_of(const std::string& text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), static_cast<std::ptrdiff_t>(text.size())};
}

/// A number with so many places.
inline std::string number(Decimal value, int places) {
    char buffer[32];
    const Result<int> length = print_decimal(value, places, buffer);
    return length ? std::string(buffer, static_cast<std::size_t>(*length)) : "?";
}
/// The shortest form that reads back as the same number: no zeros at the end, at least a whole number.
inline std::string shortest(Decimal value) {
    std::string text = number(value, 6);
    while (text.back() == '0') text.pop_back();
    if (text.back() == '.') text.pop_back();
    return text;
}

/// True for UTF-8 without control characters: a name that stays on its line.
inline bool printable(const std::string& text) { return is_printable(span_of(text)); }

/// A text with question marks for its control characters and for what is no UTF-8, so that it is printable.
inline std::string one_line(const std::string& text) {
    std::string line;
    for (Span<const char> rest = span_of(text); !rest.empty();) {
        const CodePoint read = first_code_point(rest);
        line += is_no_utf8(read, rest) || is_control(read.value) ? "?" : string_of(rest.first(read.bytes));
        rest = rest.from(read.bytes);
    }
    return line;
}

/// At most so many bytes of a text, whole characters, with dots for the rest.
inline std::string shortened(const std::string& text, std::size_t most) {
    if (text.size() <= most) return text;
    while (most > 0 && (static_cast<unsigned char>(text[most]) & 0xc0) == 0x80) --most;
    return text.substr(0, most) + "...";
}

/// A text as a JSON string with its quotes. What is not UTF-8 becomes the replacement character. What some
/// readers take for the end of a line, though JSON does not, is escaped with the control characters.
inline std::string json_string(const std::string& text) {
    static const char* digits = "0123456789abcdef";
    std::string json = "\"";
    for (Span<const char> rest = span_of(text); !rest.empty();) {
        const CodePoint read = first_code_point(rest);
        if (is_no_utf8(read, rest)) {
            json += "\\ufffd";
        } else if (is_control(read.value) || read.value == 0x2028 || read.value == 0x2029) {
            json += "\\u";
            for (int shift = 12; shift >= 0; shift -= 4) json += digits[read.value >> shift & 15];
        } else {
            if (rest[0] == '"' || rest[0] == '\\') json += '\\';
            json += string_of(rest.first(read.bytes));
        }
        rest = rest.from(read.bytes);
    }
    return json + '"';
}

/// Insertions, deletions and exchanges of characters from one word to the other. Levenshtein, 1966.
inline std::size_t edit_distance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t exchanged = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, exchanged});
        }
    }
    return row[b.size()];
}

/// ASCII capitals as small letters.
inline std::string small_letters(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return text;
}

/// The name that was probably meant, "" if none is near: at most half of its characters differ. Capitals do
/// not count.
inline std::string nearest_name(const std::string& word, const std::vector<std::string>& names) {
    std::string best;
    std::size_t least = word.size() / 2 + 1;
    for (const std::string& name : names) {
        const std::size_t distance = edit_distance(small_letters(word), small_letters(name));
        if (distance < least) {
            least = distance;
            best = name;
        }
    }
    return best;
}
/// "; did you mean X?", or nothing.
inline std::string hint(const std::string& name) {
    return name.empty() ? "" : "; did you mean " + name + "?";
}

/// "a, b and c".
inline std::string listed(const std::vector<std::string>& words, const std::string& last = "and") {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i)
        text += (i == 0 ? "" : i + 1 == words.size() ? " " + last + " " : ", ") + words[i];
    return text;
}

/// The words of "a|b|c".
inline std::vector<std::string> split(const std::string& text, char at) {
    std::vector<std::string> words;
    std::size_t start = 0;
    for (std::size_t i = 0; i <= text.size(); ++i)
        if (i == text.size() || text[i] == at) {
            words.push_back(text.substr(start, i - start));
            start = i + 1;
        }
    return words;
}

}  // namespace fovea::apps
