// SPDX-License-Identifier: MIT
//
// Fields of a template that tell of codes. What stands in a code is foreign, and ends no field, record or
// frame: it is written so that the machine behind can tell it from the template.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/code/symbology.hpp>

#include <daemon/text_buffer.hpp>
#include <read/code_escape.hpp>
#include <read/code_readings.hpp>

namespace fovea::apps {

/// {code} {code.2} {code.2.hex}: what is told of the first, or of another code.
struct CodeField {
    enum class Part : std::uint8_t { text, hex, symbology, aim, grade };
    Part part = Part::text;
    /// From 0.
    std::uint8_t index = 0;

    /// Its length is that of what a code says.
    constexpr bool is_long() const { return part == Part::text || part == Part::hex; }
};

/// Reads the name of such a field; false if it is none.
constexpr bool read_code_field(Span<const char> name, CodeField& field) {
    const auto takes = [&](const char* word) {
        std::ptrdiff_t k = 0;
        while (k < name.size() && word[k] != '\0' && name[k] == word[k]) ++k;
        if (word[k] != '\0') return false;
        name = name.from(k);
        return true;
    };
    if (!takes("code")) return false;
    field = {};
    if (name.size() >= 2 && name[0] == '.' && name[1] >= '1' && name[1] < '1' + CodeReadings::most) {
        field.index = static_cast<std::uint8_t>(name[1] - '1');
        name = name.from(2);
    }
    if (takes(".hex"))
        field.part = CodeField::Part::hex;
    else if (takes(".symbology"))
        field.part = CodeField::Part::symbology;
    else if (takes(".aim"))
        field.part = CodeField::Part::aim;
    else if (takes(".grade"))
        field.part = CodeField::Part::grade;
    return name.empty();
}

/// What a template itself has between its fields, but for letters and digits: what a machine may part them
/// by.
class TemplateMarks {
public:
    void add(char literal) {
        const auto byte = static_cast<std::uint8_t>(literal);
        const bool word = (literal >= '0' && literal <= '9') || (literal >= 'A' && literal <= 'Z') ||
                          (literal >= 'a' && literal <= 'z');
        if (!word) marks_[byte / 32] |= 1u << byte % 32;
    }
    bool contains(char letter) const {
        const auto byte = static_cast<std::uint8_t>(letter);
        return (marks_[byte / 32] >> byte % 32 & 1) != 0;
    }

private:
    std::uint32_t marks_[8] = {};
};

/// Puts a text letter by letter: marks and what disturbs a line as \n, \r, \t or \xNN, \ as \\.
template <class Put>
void put_code_text(Span<const char> text, const TemplateMarks& marks, Put put) {
    while (!text.empty()) {
        const Span<const char> character = text.first(first_code_point(text).bytes);
        bool escaped = disturbing_bytes(text) > 0;
        // Of a character with a mark among its bytes all are: half of it would be no UTF-8.
        for (const char letter : character) escaped = escaped || (marks.contains(letter) && letter != '\\');
        for (const char letter : character) {
            if (escaped) {
                put_escaped(letter, put);
                continue;
            }
            if (letter == '\\') put('\\');
            put(letter);
        }
        text = text.from(character.size());
    }
}

/// Puts what a field says of a code letter by letter.
template <class Put>
void put_code_field(const CodeReading& reading, CodeField field, const TemplateMarks& marks, Put put) {
    const Code& code = reading.code;
    switch (field.part) {
        case CodeField::Part::text: return put_code_text(reading.text, marks, put);
        case CodeField::Part::hex:
            for (const std::uint8_t byte : reading.bytes) {
                put("0123456789abcdef"[byte >> 4]);
                put("0123456789abcdef"[byte & 15]);
            }
            return;
        case CodeField::Part::symbology:
            for (const char letter : letters_of(name(code.symbology))) put(letter);
            return;
        case CodeField::Part::aim:
            put(']');
            put(aim_letter(code.symbology));
            put(code.aim_digit);
            return;
        case CodeField::Part::grade: put(code.grade.overall < 0 ? '-' : "FDCBA"[code.grade.overall]); return;
    }
}

}  // namespace fovea::apps
