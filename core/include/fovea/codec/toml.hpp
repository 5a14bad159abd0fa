// SPDX-License-Identifier: MIT
//
// TomlReader: recipes and settings in a strict subset of TOML 1.0, read item by item without memory of its
// own.
//
// The subset: [table] and [[array of tables]] with bare names; bare keys; basic strings, integers, decimals,
// true / false, and one-line arrays of these; comments. Every file it accepts is valid TOML, but for what
// only a schema can see: a name that comes twice.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/number/decimal.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Where something stands in a text, both from 1; a column counts bytes.
struct TextPlace {
    int line = 1;
    int column = 1;
};

enum class TomlType : std::uint8_t { string, integer, decimal, boolean, array };

/// A value as it stands in the text. Numbers and truth values are already understood.
struct TomlValue {
    TomlType type = TomlType::integer;
    TextPlace place;
    Span<const char>
        text;        ///< a string without its quotes, escapes still in place; an array without its brackets
    Decimal number;  ///< of an integer or a decimal
    bool truth = false;
};

enum class TomlKind : std::uint8_t { end, table, array_table, pair };

struct TomlItem {
    TomlKind kind = TomlKind::end;
    TextPlace place;
    Span<const char> name;  ///< of the table or the key
    TomlValue value;        ///< of a pair
};

/// How numbers are read.
enum class TomlNumbers : std::uint8_t {
    decimals,    ///< as Decimal; anything that it cannot hold is refused
    as_written,  ///< text alone, number stays 0: for parse_real(); an exponent is allowed
};

/// Reads a text item by item.
///
/// next() answers the items in order, then kind end for ever. After malformed or out_of_range, place() and
/// problem() say where and what; the reader must not be asked again.
///
/// Errors  malformed for anything outside the subset; out_of_range for a number parse_decimal() refuses
class TomlReader {
public:
    explicit constexpr TomlReader(Span<const char> text, TomlNumbers numbers = TomlNumbers::decimals)
        : text_(text), numbers_(numbers) {}

    constexpr Result<TomlItem> next();
    constexpr TextPlace place() const { return place_; }
    /// A phrase that names what is wrong, "" while nothing is.
    constexpr const char* problem() const { return problem_; }

private:
    friend class TomlArrayReader;
    constexpr TomlReader(Span<const char> text, TomlNumbers numbers, TextPlace place)
        : text_(text), numbers_(numbers), line_(place.line), line_start_(1 - place.column) {}

    constexpr bool at_end() const { return at_ >= text_.size(); }
    constexpr char peek() const { return at_end() ? '\0' : text_[at_]; }
    constexpr TextPlace here() const { return {line_, static_cast<int>(at_ - line_start_) + 1}; }
    constexpr Status fail(const char* problem) { return fail(problem, here()); }
    constexpr Status fail(const char* problem, TextPlace place, Status status = Status::malformed) {
        problem_ = problem;
        place_ = place;
        return status;
    }

    constexpr void skip_blanks();
    constexpr Status skip_line_end();
    constexpr Result<Span<const char>> bare_name();
    constexpr Result<TomlItem> table();
    constexpr Result<TomlItem> pair();
    constexpr Result<TomlValue> value();
    constexpr Result<TomlValue> string();
    constexpr Result<TomlValue> word();
    constexpr Result<TomlValue> number_of(TomlValue value);
    constexpr Result<TomlValue> array();

    Span<const char> text_;
    TomlNumbers numbers_ = TomlNumbers::decimals;
    std::ptrdiff_t at_ = 0;
    int line_ = 1;
    std::ptrdiff_t line_start_ = 0;
    TextPlace place_;
    const char* problem_ = "";
};

/// Walks the elements of a value of type array; not_found after the last one. The array was checked when it
/// was read, with the same way of reading numbers, so nothing else can go wrong.
class TomlArrayReader {
public:
    explicit constexpr TomlArrayReader(const TomlValue& array, TomlNumbers numbers = TomlNumbers::decimals)
        : reader_(array.text, numbers, {array.place.line, array.place.column + 1}) {}
    constexpr Result<TomlValue> next();

private:
    TomlReader reader_;
};

/// Copies a string value with its escapes (\" \\ \b \t \n \f \r) resolved; answers the length.
///
/// Errors  bad_argument if the value is no string, buffer_too_small
constexpr Result<int> toml_string(const TomlValue& value, Span<char> buffer);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

constexpr bool is_name_character(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
}
constexpr char toml_escape(char c) {
    switch (c) {
        case '"': return '"';
        case '\\': return '\\';
        case 'b': return '\b';
        case 't': return '\t';
        case 'n': return '\n';
        case 'f': return '\f';
        case 'r': return '\r';
        default: return '\0';
    }
}
/// [+-]digits[.digits][e[+-]digits], all of the text.
constexpr bool is_toml_number(Span<const char> text) {
    std::ptrdiff_t at = 0;
    const auto sign = [&] {
        if (at < text.size() && (text[at] == '+' || text[at] == '-')) ++at;
    };
    const auto digits = [&] {
        const std::ptrdiff_t start = at;
        while (at < text.size() && text[at] >= '0' && text[at] <= '9') ++at;
        return at > start;
    };
    sign();
    if (!digits()) return false;
    if (at < text.size() && text[at] == '.') {
        ++at;
        if (!digits()) return false;
    }
    if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
        ++at;
        sign();
        if (!digits()) return false;
    }
    return at == text.size();
}
/// Control characters that TOML forbids in comments and strings.
constexpr bool is_forbidden(char c) {
    const auto code = static_cast<unsigned char>(c);
    return (code < 0x20 && c != '\t') || code == 0x7f;
}

}  // namespace detail

constexpr void TomlReader::skip_blanks() {
    while (peek() == ' ' || peek() == '\t') ++at_;
}

constexpr Status TomlReader::skip_line_end() {
    skip_blanks();
    if (peek() == '#')
        while (!at_end() && peek() != '\n' && peek() != '\r') {
            if (detail::is_forbidden(peek())) return fail("a control character in a comment");
            ++at_;
        }
    if (at_end()) return Status::ok;
    if (peek() == '\r') ++at_;
    if (peek() != '\n') return fail("something stands behind the value or name");
    ++at_;
    ++line_;
    line_start_ = at_;
    return Status::ok;
}

constexpr Result<TomlItem> TomlReader::next() {
    for (;;) {
        skip_blanks();
        if (at_end()) {
            TomlItem end;
            end.place = here();
            return end;
        }
        if (peek() == '[') return table();
        if (detail::is_name_character(peek())) return pair();
        if (peek() != '#' && peek() != '\n' && peek() != '\r')
            return fail("expected a key, a [table] or a comment");
        if (Status s = skip_line_end(); s != Status::ok) return s;
    }
}

constexpr Result<Span<const char>> TomlReader::bare_name() {
    const std::ptrdiff_t start = at_;
    while (!at_end() && detail::is_name_character(peek())) ++at_;
    if (at_ == start) return fail("expected a name of letters, digits, _ and -");
    return text_.from(start).first(at_ - start);
}

constexpr Result<TomlItem> TomlReader::table() {
    TomlItem item;
    item.kind = TomlKind::table;
    ++at_;
    if (peek() == '[') {
        item.kind = TomlKind::array_table;
        ++at_;
    }
    skip_blanks();
    item.place = here();
    const Result<Span<const char>> name = bare_name();
    if (!name) return name.status();
    item.name = *name;
    skip_blanks();
    for (int i = item.kind == TomlKind::array_table ? 2 : 1; i > 0; --i) {
        if (peek() != ']') return fail("expected ] behind the table's name");
        ++at_;
    }
    if (Status s = skip_line_end(); s != Status::ok) return s;
    return item;
}

constexpr Result<TomlItem> TomlReader::pair() {
    TomlItem item;
    item.kind = TomlKind::pair;
    item.place = here();
    const Result<Span<const char>> name = bare_name();
    if (!name) return name.status();
    item.name = *name;
    skip_blanks();
    if (peek() != '=') return fail("expected = behind the key");
    ++at_;
    skip_blanks();
    const Result<TomlValue> read = peek() == '[' ? array() : value();
    if (!read) return read.status();
    item.value = *read;
    if (peek() == ',' && (read->type == TomlType::integer || read->type == TomlType::decimal))
        return fail("something stands behind the number; it has a point, not a comma");
    if (Status s = skip_line_end(); s != Status::ok) return s;
    return item;
}

constexpr Result<TomlValue> TomlReader::value() { return peek() == '"' ? string() : word(); }

constexpr Result<TomlValue> TomlReader::string() {
    TomlValue value;
    value.type = TomlType::string;
    value.place = here();
    const std::ptrdiff_t start = ++at_;
    while (peek() != '"') {
        if (at_end() || detail::is_forbidden(peek()))
            return fail("expected \" at the end of the string", value.place);
        if (peek() == '\\') {
            ++at_;
            if (detail::toml_escape(peek()) == '\0') return fail("unknown escape in a string");
        }
        ++at_;
    }
    value.text = text_.from(start).first(at_ - start);
    ++at_;
    return value;
}

constexpr Result<TomlValue> TomlReader::word() {
    TomlValue value;
    value.place = here();
    const std::ptrdiff_t start = at_;
    while (detail::is_name_character(peek()) || peek() == '.' || peek() == '+') ++at_;
    value.text = text_.from(start).first(at_ - start);
    const auto is = [&](const char* expected) {
        std::ptrdiff_t i = 0;
        for (; i < value.text.size() && expected[i] != '\0'; ++i)
            if (value.text[i] != expected[i]) return false;
        return i == value.text.size() && expected[i] == '\0';
    };
    if (is("true") || is("false")) {
        value.type = TomlType::boolean;
        value.truth = is("true");
        return value;
    }
    if (value.text.empty())
        return fail("expected a value: a \"string\", a number, true, false or an [array]");
    return number_of(value);
}

constexpr Result<TomlValue> TomlReader::number_of(TomlValue value) {
    const char first = value.text[0];
    const bool begins_so = first == '+' || first == '-' || (first >= '0' && first <= '9');
    value.type = TomlType::integer;
    if (numbers_ == TomlNumbers::decimals) {
        const Result<Decimal> number = parse_decimal(value.text);
        if (number.status() == Status::out_of_range)
            return fail("a number with more than six places or beyond a hundred million", value.place,
                        Status::out_of_range);
        if (!number && begins_so)
            return fail("expected a number such as 25 or -2.5, without exponent or unit", value.place);
        if (!number)
            return fail("expected a value: a \"string\", a number, true, false or an [array]", value.place);
        value.number = *number;
    } else if (!begins_so) {
        return fail("expected a value: a \"string\", a number, true, false or an [array]", value.place);
    } else if (!detail::is_toml_number(value.text)) {
        return fail("expected a number such as 25, -2.5 or 1.5e-7", value.place);
    }
    const std::ptrdiff_t digits = first == '+' || first == '-' ? 1 : 0;
    for (std::ptrdiff_t i = 0; i < value.text.size(); ++i)
        if (value.text[i] == '.' || value.text[i] == 'e' || value.text[i] == 'E')
            value.type = TomlType::decimal;
    if (value.text[digits] == '0' && digits + 1 < value.text.size() && value.text[digits + 1] >= '0' &&
        value.text[digits + 1] <= '9')
        return fail("a number must not begin with 0", value.place);
    return value;
}

constexpr Result<TomlValue> TomlReader::array() {
    TomlValue value;
    value.type = TomlType::array;
    value.place = here();
    const std::ptrdiff_t start = ++at_;
    skip_blanks();
    while (peek() != ']') {
        if (peek() == '[') return fail("an array inside an array");
        const Result<TomlValue> element = this->value();
        if (!element) return element.status();
        skip_blanks();
        if (peek() == ',') {
            ++at_;
            skip_blanks();
        } else if (peek() != ']') {
            return fail("expected , or ] on the same line");
        }
    }
    value.text = text_.from(start).first(at_ - start);
    ++at_;
    return value;
}

constexpr Result<TomlValue> TomlArrayReader::next() {
    reader_.skip_blanks();
    if (reader_.peek() == ',') ++reader_.at_;
    reader_.skip_blanks();
    if (reader_.at_end()) return Status::not_found;
    return reader_.value();
}

constexpr Result<int> toml_string(const TomlValue& value, Span<char> buffer) {
    if (value.type != TomlType::string) return Status::bad_argument;
    int length = 0;
    for (std::ptrdiff_t i = 0; i < value.text.size(); ++i, ++length) {
        if (length >= buffer.size()) return Status::buffer_too_small;
        buffer[length] = value.text[i] == '\\' ? detail::toml_escape(value.text[++i]) : value.text[i];
    }
    return length;
}

}  // namespace fovea
