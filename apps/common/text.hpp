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
#include <fovea/number/angle.hpp>
#include <fovea/number/decimal.hpp>
#include <fovea/number/fixed.hpp>

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
inline Decimal decimal_of(FinePixel value) {
    return {round_shift(std::int64_t{value.raw()} * 1000000, FinePixel::fraction_bits)};
}
inline Decimal decimal_of(FineAngle angle) { return {angle.microdegrees()}; }
/// The shortest form that reads back as the same number: no zeros at the end, at least a whole number.
inline std::string shortest(Decimal value) {
    std::string text = number(value, 6);
    while (text.back() == '0') text.pop_back();
    if (text.back() == '.') text.pop_back();
    return text;
}

/// A text as a JSON string with its quotes. What is not UTF-8 becomes the replacement character.
inline std::string json_string(const std::string& text) {
    static const char* digits = "0123456789abcdef";
    std::string json = "\"";
    for (std::size_t i = 0; i < text.size();) {
        const auto c = static_cast<unsigned char>(text[i]);
        // How many bytes follow, by the first one, and whether they are there and make no overlong form.
        const std::size_t more = c < 0x80                 ? 0
                                 : c >= 0xc2 && c <= 0xdf ? 1
                                 : c >= 0xe0 && c <= 0xef ? 2
                                 : c >= 0xf0 && c <= 0xf4 ? 3
                                                          : 4;
        bool whole = more < 4 && i + more < text.size();
        for (std::size_t k = 1; whole && k <= more; ++k) {
            const auto next = static_cast<unsigned char>(text[i + k]);
            const unsigned low = k > 1 ? 0x80u : c == 0xe0 ? 0xa0u : c == 0xf0 ? 0x90u : 0x80u;
            const unsigned high = k > 1 ? 0xbfu : c == 0xed ? 0x9fu : c == 0xf4 ? 0x8fu : 0xbfu;
            whole = next >= low && next <= high;
        }
        if (!whole) {
            json += "\\ufffd";
            ++i;
            continue;
        }
        if (c == '"' || c == '\\') {
            json += '\\';
            json += static_cast<char>(c);
        } else if (c < 0x20 || c == 0x7f) {
            json += "\\u00";
            json += digits[c >> 4];
            json += digits[c & 15];
        } else {
            json.append(text, i, more + 1);
        }
        i += more + 1;
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

/// The name that was probably meant, "" if none is near: at most half of its characters differ.
inline std::string nearest_name(const std::string& word, const std::vector<std::string>& names) {
    std::string best;
    std::size_t least = word.size() / 2 + 1;
    for (const std::string& name : names) {
        const std::size_t distance = edit_distance(word, name);
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
inline std::string listed(const std::vector<std::string>& words) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i)
        text += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
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
