// SPDX-License-Identifier: MIT
//
// What is told of a code: a line for people, a line of JSON.
#pragma once

#include <string>
#include <vector>

#include <fovea/code/code.hpp>
#include <fovea/code/text_utf8.hpp>

#include <common/decimals.hpp>
#include <common/text.hpp>
#include <read/code_escape.hpp>

namespace fovea::apps {

/// A code of an image with its text in UTF-8.
struct ReadCode {
    Code code;
    std::string text;
    std::string bytes;  ///< as they stand in the code
};

/// The identifier of its symbology, "]E0". ISO/IEC 15424.
inline std::string aim_of(const Code& code) { return {']', aim_letter(code.symbology), code.aim_digit}; }

/// A text on one line: what would end or disturb it becomes \n, \r, \t or \xNN.
inline std::string escaped(const std::string& text) {
    std::string line;
    const auto put = [&](char letter) { line += letter; };
    for (Span<const char> rest = span_of(text); !rest.empty();) {
        const Span<const char> character = rest.first(first_code_point(rest).bytes);
        const bool disturbing = disturbing_bytes(rest) > 0;
        for (const char letter : character) disturbing ? put_escaped(letter, put) : put(letter);
        rest = rest.from(character.size());
    }
    return line;
}

/// "EAN-13 9780905705712".
inline std::string human_code(const ReadCode& read) {
    return std::string(name(read.code.symbology)) + " " + escaped(read.text);
}

namespace detail {

inline std::string json_grade(std::int8_t grade) {
    if (grade < 0) return "null";
    return {'"', "FDCBA"[grade], '"'};
}
inline std::string hexadecimal(const std::string& bytes) {
    static const char* const digits = "0123456789abcdef";
    std::string text;
    for (const char c : bytes) {
        text += digits[static_cast<unsigned char>(c) >> 4];
        text += digits[static_cast<unsigned char>(c) & 15];
    }
    return text;
}

}  // namespace detail

/// One JSON object on a line, its keys always in this order. verdict is "" where nothing is asked of the
/// text.
inline std::string json_code(const std::string& image, int index, const ReadCode& read,
                             const std::string& verdict) {
    const Code& code = read.code;
    std::string text = "{\"schema\":1,\"image\":" + json_string(image) +
                       ",\"code\":" + std::to_string(index) + ",\"symbology\":\"" + name(code.symbology) +
                       "\",\"text\":" + json_string(read.text) + ",\"bytes_hex\":\"" +
                       detail::hexadecimal(read.bytes) + "\",\"aim\":\"" + aim_of(code) +
                       "\",\"corners_px\":[";
    for (int i = 0; i < 4; ++i)
        text += std::string(i == 0 ? "" : ",") + "[" + number(decimal_of(code.corners[i].x), 2) + "," +
                number(decimal_of(code.corners[i].y), 2) + "]";
    text += "]";
    if (code.agreeing_lines > 0)
        text += ",\"agreeing_lines\":" + std::to_string(code.agreeing_lines);
    else
        text += ",\"corrected_errors\":" + std::to_string(code.corrected_errors);
    text += std::string(",\"inverted\":") + (code.inverted ? "true" : "false") +
            ",\"mirrored\":" + (code.mirrored ? "true" : "false") +
            ",\"grade\":{\"overall\":" + detail::json_grade(code.grade.overall) +
            ",\"symbol_contrast\":" + detail::json_grade(code.grade.symbol_contrast) +
            ",\"modulation\":" + detail::json_grade(code.grade.modulation) +
            ",\"decodability\":" + detail::json_grade(code.grade.decodability) +
            ",\"quiet_zone\":" + detail::json_grade(code.grade.quiet_zone) +
            ",\"unused_error_correction\":" + detail::json_grade(code.grade.unused_error_correction) + "}";
    if (!verdict.empty()) text += ",\"verdict\":\"" + verdict + "\"";
    return text + "}\n";
}
/// The line of an image in which nothing was read.
inline std::string json_no_code(const std::string& image, const std::string& problem) {
    return "{\"schema\":1,\"image\":" + json_string(image) +
           ",\"code\":null,\"error\":" + json_string(problem) + "}\n";
}

}  // namespace fovea::apps
