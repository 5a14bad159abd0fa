// SPDX-License-Identifier: MIT
//
// ResultTemplate: how a PLC wants its results, as a string with fields.
//
//     {name}            a field                    {name:6}    at least 6 wide: numbers with zeros in front,
//     {name|NOREAD}     with a text where the                  words with blanks behind
//                       field has no value         {name:+7}   a number with its sign
//     {xor} {crc16}     of all bytes in front, as hexadecimal digits; a first \x02 does not count
//     \xNN \r \n \t     bytes; \\ \{ \} themselves
//
// Fields: seq, verdict (OK NG ERROR), pass (P F E), why, job, job.number, parts, frame, age_us, took_us,
// triggers, ok, ng, error, missed; f.NAME the value of a feature, which is a word here, f.NAME.milli its
// thousandths, a whole number, f.NAME.verdict (ok low high unmeasured); codes how many codes were read, code
// the text of the first, code.hex its bytes, code.symbology, code.aim, code.grade (A B C D F -), and code.2,
// code.2.hex and so on of the others. A number or a code that is wider than its width becomes asterisks, so
// that fields that follow stay in their places; what has no value, question marks.
//
// In the text of a code all that ends or disturbs a line is written \n, \r, \t or \xNN, and so is each byte
// that stands in the template itself and is no letter or digit: a separator in a code parts nothing. \ is \\.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/number/integer.hpp>

#include <daemon/inspection.hpp>
#include <daemon/record_checks.hpp>
#include <daemon/tally.hpp>
#include <daemon/template_codes.hpp>
#include <daemon/text_buffer.hpp>
#include <read/code_escape.hpp>

namespace fovea::apps {

/// A template that was read once, and is filled in for every result. Holds no memory but itself.
class ResultTemplate {
public:
    static constexpr int longest = 256;
    static constexpr int most_pieces = 48;
    /// Fields with the text of the same code, so that no code is too long for a line of longest_line.
    static constexpr int most_long_fields = 3;
    /// Bytes of the longest line there can be: texts of all codes with four letters a byte as often as they
    /// may come, 48 fields of 64 letters, and the template itself.
    static constexpr int longest_line =
        most_long_fields * 4 * CodeReadings::most_text + most_pieces * 64 + longest;

    /// Reads a template; after an error it is as it was, and problem() and place() say what and at which
    /// letter.
    ///
    /// Errors  malformed for what is no template, not_found for an unknown field, capacity_exceeded
    Status read(Span<const char> text);
    const char* problem() const { return problem_; }
    /// From 1.
    int place() const { return place_; }

    /// Writes a result.
    void write(const Inspection& inspection, const Tally& tally, TextBuffer& line) const;

private:
    enum class Field : std::uint8_t {
        literal,
        seq,
        verdict,
        pass,
        why,
        job,
        job_number,
        parts,
        frame,
        age_us,
        took_us,
        triggers,
        ok,
        not_ok,
        error,
        missed,
        codes,
        code,
        feature,
        feature_milli,
        feature_verdict,
        exclusive_or,
        crc16
    };
    struct Piece {
        Field field = Field::literal;
        /// Letters of the literal, or of the feature's name; then those of the text without a value.
        std::int16_t begin = 0;
        std::int16_t length = 0;
        std::int16_t otherwise = 0;
        std::int16_t otherwise_length = 0;
        std::uint8_t width = 0;
        bool sign = false;
        CodeField code;
    };

    Status fail(Status status, const char* problem, std::ptrdiff_t at) {
        problem_ = problem;
        place_ = static_cast<int>(at) + 1;
        return status;
    }
    Status read_escape(Span<const char> text, std::ptrdiff_t& at, char& letter);
    Status read_field(Span<const char> text, std::ptrdiff_t& at, ResultTemplate& into);
    bool keep(char letter) {
        if (letters_used_ >= longest) return false;
        letters_[letters_used_++] = letter;
        return true;
    }
    Span<const char> kept(std::int16_t begin, std::int16_t length) const {
        return {letters_ + begin, length};
    }
    static void write_number(std::int64_t value, const Piece& piece, TextBuffer& line);
    static void write_word(Span<const char> word, const Piece& piece, TextBuffer& line);
    void write_feature(const Inspection& inspection, const Piece& piece, TextBuffer& line) const;
    void write_code(const Inspection& inspection, const Piece& piece, TextBuffer& line) const;
    void write_otherwise(const Piece& piece, TextBuffer& line) const;

    char letters_[longest] = {};
    std::int16_t letters_used_ = 0;
    Piece pieces_[most_pieces];
    int piece_count_ = 0;
    TemplateMarks marks_;
    /// Fields that are as long as a code.
    std::uint8_t long_fields_[CodeReadings::most] = {};
    const char* problem_ = "";
    int place_ = 0;
};

// ---- Implementation ---------------------------------------------------------------

inline Status ResultTemplate::read_escape(Span<const char> text, std::ptrdiff_t& at, char& letter) {
    const char kind = at + 1 < text.size() ? text[at + 1] : '\0';
    switch (kind) {
        case 'r': letter = '\r'; break;
        case 'n': letter = '\n'; break;
        case 't': letter = '\t'; break;
        case '\\':
        case '{':
        case '}': letter = kind; break;
        case 'x': {
            const int high = at + 2 < text.size() ? hex_digit(text[at + 2]) : -1;
            const int low = at + 3 < text.size() ? hex_digit(text[at + 3]) : -1;
            if (high < 0 || low < 0) return fail(Status::malformed, "\\x wants two hexadecimal digits", at);
            letter = static_cast<char>(16 * high + low);
            at += 2;
            break;
        }
        default: return fail(Status::malformed, "after \\ comes one of r n t x \\ { }", at);
    }
    at += 2;
    return Status::ok;
}

/// Reads "{name:width|otherwise}" from its brace on.
inline Status ResultTemplate::read_field(Span<const char> text, std::ptrdiff_t& at, ResultTemplate& into) {
    struct Known {
        const char* name;
        Field field;
    };
    static constexpr Known known[] = {
        {"seq", Field::seq},          {"verdict", Field::verdict},   {"pass", Field::pass},
        {"why", Field::why},          {"job", Field::job},           {"job.number", Field::job_number},
        {"parts", Field::parts},      {"frame", Field::frame},       {"age_us", Field::age_us},
        {"took_us", Field::took_us},  {"triggers", Field::triggers}, {"ok", Field::ok},
        {"ng", Field::not_ok},        {"error", Field::error},       {"missed", Field::missed},
        {"xor", Field::exclusive_or}, {"crc16", Field::crc16},       {"codes", Field::codes},
    };
    const std::ptrdiff_t begin = at++;
    std::ptrdiff_t end = at;
    while (end < text.size() && text[end] != '}' && text[end] != ':' && text[end] != '|') ++end;
    Span<const char> name = text.from(at).first(end - at);
    Piece piece;
    bool found = false;
    for (const Known& each : known) {
        const Span<const char> word = letters_of(each.name);
        bool same = word.size() == name.size();
        for (std::ptrdiff_t k = 0; same && k < name.size(); ++k) same = word[k] == name[k];
        if (same) piece.field = each.field;
        found = found || same;
    }
    if (!found && name.size() > 2 && name[0] == 'f' && name[1] == '.') {
        name = name.from(2);
        const auto ends_with = [&](const char* tail) {
            const Span<const char> word = letters_of(tail);
            if (word.size() >= name.size()) return false;
            for (std::ptrdiff_t k = 0; k < word.size(); ++k)
                if (name[name.size() - word.size() + k] != word[k]) return false;
            name = name.first(name.size() - word.size());
            return true;
        };
        piece.field = ends_with(".milli")     ? Field::feature_milli
                      : ends_with(".verdict") ? Field::feature_verdict
                                              : Field::feature;
        piece.begin = into.letters_used_;
        piece.length = static_cast<std::int16_t>(name.size());
        for (const char c : name)
            if (!into.keep(c)) return fail(Status::capacity_exceeded, "the template is too long", begin);
        found = true;
    }
    if (!found && read_code_field(name, piece.code)) {
        piece.field = Field::code;
        found = true;
        if (piece.code.is_long() && ++into.long_fields_[piece.code.index] > most_long_fields)
            return fail(Status::capacity_exceeded, "the same code more than three times", begin + 1);
    }
    if (!found) return fail(Status::not_found, "no such field", begin + 1);
    at = end;
    if (at < text.size() && text[at] == ':') {
        ++at;
        if (at < text.size() && text[at] == '+') {
            piece.sign = true;
            ++at;
        }
        int width = 0;
        const std::ptrdiff_t digits = at;
        for (; at < text.size() && text[at] >= '0' && text[at] <= '9' && width < 100; ++at)
            width = 10 * width + (text[at] - '0');
        if (at == digits || width < 1 || width > 64)
            return fail(Status::malformed, "a width is 1 to 64", digits);
        piece.width = static_cast<std::uint8_t>(width);
    }
    if (at < text.size() && text[at] == '|') {
        ++at;
        piece.otherwise = into.letters_used_;
        for (; at < text.size() && text[at] != '}'; ++at) {
            if (text[at] < ' ' || text[at] > '~' || text[at] == '{' || text[at] == '\\')
                return fail(Status::malformed, "this letter cannot stand there", at);
            if (!into.keep(text[at]))
                return fail(Status::capacity_exceeded, "the template is too long", begin);
        }
        piece.otherwise_length = static_cast<std::int16_t>(into.letters_used_ - piece.otherwise);
    }
    if (at >= text.size() || text[at] != '}') return fail(Status::malformed, "a field without its }", begin);
    ++at;
    if (into.piece_count_ == most_pieces) return fail(Status::capacity_exceeded, "too many fields", begin);
    into.pieces_[into.piece_count_++] = piece;
    return Status::ok;
}

inline Status ResultTemplate::read(Span<const char> text) {
    ResultTemplate fresh;
    for (std::ptrdiff_t at = 0; at < text.size();) {
        if (text[at] == '{') {
            if (const Status s = read_field(text, at, fresh); s != Status::ok) return s;
            continue;
        }
        if (text[at] == '}') return fail(Status::malformed, "a } without its field", at);
        char letter = text[at];
        const std::ptrdiff_t here = at;
        if (letter == '\\') {
            if (const Status s = read_escape(text, at, letter); s != Status::ok) return s;
        } else if (letter < ' ' || letter > '~') {
            return fail(Status::malformed, "bytes that are no ASCII are written \\xNN", at);
        } else {
            ++at;
        }
        const bool goes_on =
            fresh.piece_count_ > 0 && fresh.pieces_[fresh.piece_count_ - 1].field == Field::literal;
        if (!goes_on) {
            if (fresh.piece_count_ == most_pieces)
                return fail(Status::capacity_exceeded, "too many fields", here);
            Piece literal;
            literal.begin = fresh.letters_used_;
            fresh.pieces_[fresh.piece_count_++] = literal;
        }
        if (!fresh.keep(letter)) return fail(Status::capacity_exceeded, "the template is too long", here);
        fresh.marks_.add(letter);
        ++fresh.pieces_[fresh.piece_count_ - 1].length;
    }
    *this = fresh;
    return Status::ok;
}

inline void ResultTemplate::write_number(std::int64_t value, const Piece& piece, TextBuffer& line) {
    char room[24];
    TextBuffer digits(room);
    const bool negative = value < 0;
    digits.number(value);
    const Span<const char> magnitude = digits.letters().from(negative ? 1 : 0);
    const int signs = negative || piece.sign ? 1 : 0;
    const std::ptrdiff_t wide = magnitude.size() + signs;
    if (piece.width != 0 && wide > piece.width) {
        for (int k = 0; k < piece.width; ++k) line.put('*');
        return;
    }
    if (signs != 0) line.put(negative ? '-' : '+');
    for (std::ptrdiff_t k = wide; k < piece.width; ++k) line.put('0');
    line.text(magnitude);
}

inline void ResultTemplate::write_word(Span<const char> word, const Piece& piece, TextBuffer& line) {
    // A name that came from outside must not end a frame: names are printable, and stay so here.
    for (const char c : word) line.put(static_cast<std::uint8_t>(c) < ' ' || c == '\x7f' ? '?' : c);
    for (std::ptrdiff_t k = word.size(); k < piece.width; ++k) line.put(' ');
}

inline void ResultTemplate::write_otherwise(const Piece& piece, TextBuffer& line) const {
    const Span<const char> otherwise = kept(piece.otherwise, piece.otherwise_length);
    if (!otherwise.empty()) return write_word(otherwise, piece, line);
    for (int k = 0; k < (piece.width == 0 ? 1 : piece.width); ++k) line.put('?');
}

inline void ResultTemplate::write_code(const Inspection& inspection, const Piece& piece,
                                       TextBuffer& line) const {
    if (piece.code.index >= inspection.codes.size()) return write_otherwise(piece, line);
    const CodeReading& reading = inspection.codes[piece.code.index];
    int wide = 0;
    put_code_field(reading, piece.code, marks_, [&](char) { ++wide; });
    // Half a code would be another one.
    const bool fits = piece.width == 0 || wide <= piece.width;
    if (fits) put_code_field(reading, piece.code, marks_, [&](char letter) { line.put(letter); });
    for (int k = fits ? wide : 0; k < piece.width; ++k) line.put(fits ? ' ' : '*');
}

inline void ResultTemplate::write_feature(const Inspection& inspection, const Piece& piece,
                                          TextBuffer& line) const {
    const Span<const char> name = kept(piece.begin, piece.length);
    for (int k = 0; k < inspection.values; ++k) {
        const InspectedValue& value = inspection.value[k];
        bool same = value.name.size() == name.size();
        for (std::ptrdiff_t i = 0; same && i < name.size(); ++i) same = value.name[i] == name[i];
        if (!same) continue;
        if (piece.field == Field::feature_verdict)
            return write_word(letters_of(word_of(value.verdict)), piece, line);
        if (value.status != Status::ok) break;
        if (piece.field == Field::feature_milli)
            return write_number(round_divide(value.value.millionths, std::int64_t{1000}), piece, line);
        char room[40];
        TextBuffer digits(room);
        if (piece.sign && value.value.millionths >= 0) digits.put('+');
        digits.decimal(value.value, value.places);
        return write_word(digits.letters(), piece, line);
    }
    write_otherwise(piece, line);
}

inline void ResultTemplate::write(const Inspection& inspection, const Tally& tally, TextBuffer& line) const {
    const auto whole = [](std::uint64_t value) { return static_cast<std::int64_t>(value); };
    for (int k = 0; k < piece_count_; ++k) {
        const Piece& piece = pieces_[k];
        switch (piece.field) {
            case Field::literal: line.text(kept(piece.begin, piece.length)); break;
            case Field::seq: write_number(whole(inspection.number), piece, line); break;
            case Field::verdict: write_word(letters_of(word_of(inspection.answer)), piece, line); break;
            case Field::pass:
                write_word(letters_of(inspection.answer == Answer::ok       ? "P"
                                      : inspection.answer == Answer::not_ok ? "F"
                                                                            : "E"),
                           piece, line);
                break;
            case Field::why:
                if (inspection.reason[0] == '\0')
                    write_word(kept(piece.otherwise, piece.otherwise_length), piece, line);
                else
                    write_word(letters_of(inspection.reason), piece, line);
                break;
            case Field::job: write_word(inspection.job, piece, line); break;
            case Field::job_number: write_number(inspection.job_number, piece, line); break;
            case Field::parts: write_number(inspection.parts, piece, line); break;
            case Field::frame:
            case Field::age_us:
                if (!inspection.has_frame)
                    write_otherwise(piece, line);
                else
                    write_number(piece.field == Field::frame ? inspection.frame : inspection.age_us, piece,
                                 line);
                break;
            case Field::took_us: write_number(inspection.took_us, piece, line); break;
            case Field::triggers: write_number(whole(tally.triggers), piece, line); break;
            case Field::ok: write_number(whole(tally.ok), piece, line); break;
            case Field::not_ok: write_number(whole(tally.not_ok), piece, line); break;
            case Field::error: write_number(whole(tally.error), piece, line); break;
            case Field::missed: write_number(whole(tally.missed), piece, line); break;
            case Field::codes: write_number(inspection.codes.size(), piece, line); break;
            case Field::code: write_code(inspection, piece, line); break;
            case Field::feature:
            case Field::feature_milli:
            case Field::feature_verdict: write_feature(inspection, piece, line); break;
            case Field::exclusive_or: {
                std::uint32_t all = 0;
                for (const std::uint8_t byte : checked_bytes(line)) all ^= byte;
                line.hex(all, 2);
                break;
            }
            case Field::crc16: line.hex(crc16_of(checked_bytes(line)), 4); break;
        }
    }
}

}  // namespace fovea::apps
