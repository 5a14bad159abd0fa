// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/codec/toml.hpp>

namespace fovea::test {
namespace {

Span<const char> span_of(const std::string& text) {
    return {text.data(), static_cast<std::ptrdiff_t>(text.size())};
}
Span<const char> span_of(std::string&&) = delete;  // it would not live
std::string string_of(Span<const char> text) { return {text.data(), static_cast<std::size_t>(text.size())}; }

std::string resolved(const TomlValue& value) {
    std::vector<char> buffer(static_cast<std::size_t>(value.text.size()) + 1);
    const Result<int> length =
        toml_string(value, {buffer.data(), static_cast<std::ptrdiff_t>(buffer.size())});
    return length ? std::string(buffer.data(), static_cast<std::size_t>(*length)) : describe(length.status());
}

/// A value as a line of text: its type and what was understood of it.
std::string shown(const TomlValue& value) {
    switch (value.type) {
        case TomlType::string: return "string " + resolved(value);
        case TomlType::integer: return "integer " + std::to_string(value.number.millionths);
        case TomlType::decimal: return "decimal " + std::to_string(value.number.millionths);
        case TomlType::boolean: return value.truth ? "true" : "false";
        case TomlType::array: break;
    }
    std::string text = "[";
    TomlArrayReader elements(value);
    for (Result<TomlValue> element = elements.next(); element; element = elements.next())
        text += (text.size() > 1 ? ", " : "") + shown(*element);
    return text + "]";
}

/// Everything that a reader says about a text, one item after another: tables as [name] and [[name]], pairs
/// as name = value, and the problem that stopped it with its place.
std::vector<std::string> read_all(const std::string& text) {
    std::vector<std::string> items;
    TomlReader reader(span_of(text));
    for (;;) {
        const Result<TomlItem> item = reader.next();
        if (!item) {
            items.push_back(std::to_string(reader.place().line) + ":" +
                            std::to_string(reader.place().column) + " " + reader.problem());
            EXPECT_TRUE(item.status() == Status::malformed || item.status() == Status::out_of_range);
            return items;
        }
        EXPECT_STREQ(reader.problem(), "");
        if (item->kind == TomlKind::end) return items;
        const std::string name = string_of(item->name);
        items.push_back(item->kind == TomlKind::table         ? "[" + name + "]"
                        : item->kind == TomlKind::array_table ? "[[" + name + "]]"
                                                              : name + " = " + shown(item->value));
    }
}
using Items = std::vector<std::string>;

/// The only value of a text "k = VALUE", or the problem.
std::string value_of(const std::string& value) {
    const Items items = read_all("k = " + value);
    return items.size() == 1 ? items[0] : "not one item";
}

TEST(TomlReader, ReadsEveryKindOfItem) {
    EXPECT_EQ(read_all("# a recipe\n"
                       "format = 1\n"
                       "name = \"lever\"   # behind a value\n"
                       "\n"
                       "[scale]\n"
                       "per_pixel = 0.0125\n"
                       "\t[ locate ]  # blanks around a name\n"
                       "at_border = true\n"
                       "dark=false\n"
                       "[[feature]]\n"
                       "from = [-1.5, 2]\n"
                       "[[ feature ]]\n"),
              (Items{"format = integer 1000000", "name = string lever", "[scale]",
                     "per_pixel = decimal 12500", "[locate]", "at_border = true", "dark = false",
                     "[[feature]]", "from = [decimal -1500000, integer 2000000]", "[[feature]]"}));
}

TEST(TomlReader, ReadsNothingFromNothing) {
    EXPECT_EQ(read_all(""), Items{});
    EXPECT_EQ(read_all("\n\n"), Items{});
    EXPECT_EQ(read_all(" \t"), Items{});
    EXPECT_EQ(read_all("# a comment alone"), Items{});
    EXPECT_EQ(read_all("#"), Items{});
}

TEST(TomlReader, SaysEndForEver) {
    const std::string text = "a = 1";
    TomlReader reader(span_of(text));
    ASSERT_TRUE(reader.next().ok());
    for (int i = 0; i < 3; ++i) {
        const Result<TomlItem> end = reader.next();
        ASSERT_TRUE(end.ok());
        EXPECT_EQ(end->kind, TomlKind::end);
        EXPECT_EQ(end->place.line, 1);
        EXPECT_EQ(end->place.column, 6);
    }
}

TEST(TomlReader, TakesLinesOfUnixAndWindowsAndALastLineWithoutAnEnd) {
    const Items expected = {"a = integer 1000000", "[t]", "b = string x"};
    EXPECT_EQ(read_all("a = 1\n[t]\nb = \"x\"\n"), expected);
    EXPECT_EQ(read_all("a = 1\r\n[t]\r\nb = \"x\"\r\n"), expected);
    EXPECT_EQ(read_all("a = 1\r\n# c\r\n\r\n[t]\nb = \"x\""), expected);
    EXPECT_EQ(read_all("a = 1\r[t]"), (Items{"1:7 something stands behind the value or name"}));
    EXPECT_EQ(read_all("\r"), (Items{"1:2 something stands behind the value or name"}));
}

TEST(TomlReader, NamesArePlainWords) {
    EXPECT_EQ(read_all("A-z_09 = 1\n-=2\n1 = 3\n[_]\n"),
              (Items{"A-z_09 = integer 1000000", "- = integer 2000000", "1 = integer 3000000", "[_]"}));
    EXPECT_EQ(read_all("a.b = 1"), (Items{"1:2 expected = behind the key"}));
    EXPECT_EQ(read_all("\"a\" = 1"), (Items{"1:1 expected a key, a [table] or a comment"}));
    EXPECT_EQ(read_all("caf\xc3\xa9 = 1"), (Items{"1:4 expected = behind the key"}));
}

TEST(TomlReader, SaysWhereEverythingStands) {
    const std::string text = "\n  key =\t \"x\"\n[ table ]\n [[ row ]]\nk = [1, 2]";
    TomlReader reader(span_of(text));
    const auto expect_place = [](TextPlace place, int line, int column) {
        EXPECT_EQ(place.line, line);
        EXPECT_EQ(place.column, column);
    };
    Result<TomlItem> item = reader.next();
    ASSERT_TRUE(item.ok());
    expect_place(item->place, 2, 3);
    expect_place(item->value.place, 2, 10);
    item = reader.next();
    ASSERT_TRUE(item.ok());
    expect_place(item->place, 3, 3);
    item = reader.next();
    ASSERT_TRUE(item.ok());
    expect_place(item->place, 4, 5);
    item = reader.next();
    ASSERT_TRUE(item.ok());
    expect_place(item->value.place, 5, 5);
    TomlArrayReader elements(item->value);
    const Result<TomlValue> first = elements.next();
    const Result<TomlValue> second = elements.next();
    ASSERT_TRUE(first.ok() && second.ok());
    expect_place(first->place, 5, 6);
    expect_place(second->place, 5, 9);
}

TEST(TomlReader, ReadsNumbersAsTomlWritesThem) {
    EXPECT_EQ(value_of("0"), "k = integer 0");
    EXPECT_EQ(value_of("+1"), "k = integer 1000000");
    EXPECT_EQ(value_of("-17"), "k = integer -17000000");
    EXPECT_EQ(value_of("-0"), "k = integer 0");
    EXPECT_EQ(value_of("0.5"), "k = decimal 500000");
    EXPECT_EQ(value_of("-0.000001"), "k = decimal -1");
    EXPECT_EQ(value_of("+0.0"), "k = decimal 0");
    EXPECT_EQ(value_of("1.0"), "k = decimal 1000000");
    EXPECT_EQ(value_of("10"), "k = integer 10000000");
    EXPECT_EQ(value_of(std::to_string(max_decimal_units)),
              "k = integer " + std::to_string(max_decimal_units * 1000000));
}

TEST(TomlReader, RefusesOtherFormsOfNumbers) {
    for (const char* number : {"1.",   ".5",    "1e5", "1E5", "1e+5", "1_000",      "0x1f", "0b1",  "inf",
                               "-nan", "1.2.3", "+-1", "--1", "1+1",  "1979-05-27", "True", "TRUE", "truee",
                               "tru",  "yes",   "'x'", "{}",  "x",    "+true",      "-",    "+"})
        EXPECT_EQ(value_of(number).substr(0, 15), "1:5 expected a ") << number;
    const std::string as_number = "1:5 expected a number such as 25 or -2.5, without exponent or unit";
    for (const char* number : {"1e5", "12mm", "-1.", "+x", "0x1f"})
        EXPECT_EQ(value_of(number), as_number) << number;
    for (const char* word : {".5", "inf", "yes", "'x'"})
        EXPECT_EQ(value_of(word).substr(0, 20), "1:5 expected a value") << word;
    for (const char* number : {"01", "-01", "+007", "00", "00.5", "-00"})
        EXPECT_EQ(value_of(number), "1:5 a number must not begin with 0") << number;
}

TEST(TomlReader, LeavesNumbersAsTheyAreWrittenIfAsked) {
    const auto number = [](const std::string& word) {
        const std::string text = "a = " + word + "\nb = [" + word + ", " + word + "]";
        TomlReader reader({text.data(), static_cast<std::ptrdiff_t>(text.size())}, TomlNumbers::as_written);
        const Result<TomlItem> item = reader.next();
        if (!item) return std::string("! ") + reader.problem();
        const Result<TomlItem> array = reader.next();
        EXPECT_TRUE(array.ok());
        TomlArrayReader elements(array->value, TomlNumbers::as_written);
        for (int i = 0; i < 2; ++i) {
            const Result<TomlValue> element = elements.next();
            EXPECT_TRUE(element.ok() && element->type == item->value.type);
        }
        EXPECT_EQ(elements.next().status(), Status::not_found);
        const Span<const char> found = item->value.text;
        return std::string(found.data(), static_cast<std::size_t>(found.size())) +
               (item->value.type == TomlType::integer ? " integer" : " decimal");
    };
    EXPECT_EQ(number("25"), "25 integer");
    EXPECT_EQ(number("-0"), "-0 integer");
    EXPECT_EQ(number("536.454766207123456789"), "536.454766207123456789 decimal");
    EXPECT_EQ(number("+1.5e-09"), "+1.5e-09 decimal");
    EXPECT_EQ(number("1E400"), "1E400 decimal");
    EXPECT_EQ(number("0e0"), "0e0 decimal");
    for (const char* word : {"1.", "1.e5", "1e", "1e+", "1_000", "0x10", "1.5mm", "1e5.5", "-", "+", "1.2.3"})
        EXPECT_EQ(number(word), "! expected a number such as 25, -2.5 or 1.5e-7") << word;
    for (const char* word : {"01", "-00.5", "00e1"})
        EXPECT_EQ(number(word), "! a number must not begin with 0") << word;
    for (const char* word : {".5", "inf", "nan", "e5"})
        EXPECT_EQ(number(word), "! expected a value: a \"string\", a number, true, false or an [array]")
            << word;
}

TEST(TomlReader, SaysOutOfRangeOfNumbersItCannotHold) {
    for (const std::string& number :
         {std::to_string(max_decimal_units + 1), "-" + std::to_string(max_decimal_units) + ".000001",
          std::string("0.0000001"), std::string(300, '9')}) {
        const std::string text = "a = 1\nk = " + number;
        TomlReader reader(span_of(text));
        ASSERT_TRUE(reader.next().ok());
        EXPECT_EQ(reader.next().status(), Status::out_of_range) << number;
        EXPECT_EQ(reader.place().line, 2);
        EXPECT_EQ(reader.place().column, 5);
        EXPECT_EQ(std::string(reader.problem()).substr(0, 40), "a number with more than six places or be");
    }
    EXPECT_EQ(value_of("0.1000000"), "k = decimal 100000") << "zeros say nothing";
}

TEST(TomlReader, ReadsStringsWithTheirEscapes) {
    EXPECT_EQ(value_of("\"\""), "k = string ");
    EXPECT_EQ(value_of("\"a # b = [c]\""), "k = string a # b = [c]");
    EXPECT_EQ(value_of(R"("\" \\ \b\t\n\f\r")"), "k = string \" \\ \b\t\n\f\r");
    EXPECT_EQ(value_of("\"a\tb\""), "k = string a\tb") << "a tab may stand as it is";
    EXPECT_EQ(value_of("\"\xc3\xa9\xe2\x8c\x80\""), "k = string \xc3\xa9\xe2\x8c\x80");
    EXPECT_EQ(value_of(R"("\\")"), "k = string \\");
}

TEST(TomlReader, RefusesStringsThatTomlOrTheSubsetForbids) {
    EXPECT_EQ(value_of("\"a"), "1:5 expected \" at the end of the string");
    EXPECT_EQ(value_of("\""), "1:5 expected \" at the end of the string");
    EXPECT_EQ(value_of("\"a\nb\""), "1:5 expected \" at the end of the string");
    EXPECT_EQ(value_of("\"a\r\""), "1:5 expected \" at the end of the string");
    EXPECT_EQ(value_of("\"a\x7f\""), "1:5 expected \" at the end of the string");
    EXPECT_EQ(value_of(std::string("\"a\0b\"", 5)), "1:5 expected \" at the end of the string");
    EXPECT_EQ(value_of("\"a\\\""), "1:5 expected \" at the end of the string");
    EXPECT_EQ(value_of("\"a\\"), "1:8 unknown escape in a string");
    EXPECT_EQ(value_of("\"\\x41\""), "1:7 unknown escape in a string");
    EXPECT_EQ(value_of("\"\\u0041\""), "1:7 unknown escape in a string");
    EXPECT_EQ(value_of(std::string("\"\\\0\"", 4)), "1:7 unknown escape in a string");
    EXPECT_EQ(value_of("\"\"\"x\"\"\""), "1:7 something stands behind the value or name");
}

TEST(TomlReader, ReadsArraysOfOneLine) {
    EXPECT_EQ(value_of("[]"), "k = []");
    EXPECT_EQ(value_of("[ \t]"), "k = []");
    EXPECT_EQ(value_of("[1]"), "k = [integer 1000000]");
    EXPECT_EQ(value_of("[ 1 ,2.5,\t\"a]b\" , true ]"),
              "k = [integer 1000000, decimal 2500000, string a]b, true]");
    EXPECT_EQ(value_of("[1, 2,]"), "k = [integer 1000000, integer 2000000]") << "a comma may follow the last";
    EXPECT_EQ(value_of("[1,]  # note"), "k = [integer 1000000]");
}

TEST(TomlReader, RefusesOtherArrays) {
    EXPECT_EQ(value_of("[[1]]"), "1:6 an array inside an array");
    EXPECT_EQ(value_of("[1, [2]]"), "1:9 an array inside an array");
    EXPECT_EQ(value_of("[1 2]"), "1:8 expected , or ] on the same line");
    EXPECT_EQ(value_of("[1"), "1:7 expected , or ] on the same line");
    EXPECT_EQ(value_of("[1\n]"), "1:7 expected , or ] on the same line");
    EXPECT_EQ(value_of("[1 # one\n]"), "1:8 expected , or ] on the same line");
    EXPECT_EQ(value_of("[").substr(0, 20), "1:6 expected a value");
    EXPECT_EQ(value_of("[,]").substr(0, 20), "1:6 expected a value");
    EXPECT_EQ(value_of("[1,,2]").substr(0, 20), "1:8 expected a value");
    EXPECT_EQ(value_of("[\n1]").substr(0, 20), "1:6 expected a value");
    EXPECT_EQ(value_of("[1, 02]"), "1:9 a number must not begin with 0");
    EXPECT_EQ(value_of("[\"a]"), "1:6 expected \" at the end of the string");
    EXPECT_EQ(value_of(std::string("[1\0]", 4)), "1:7 expected , or ] on the same line");
    EXPECT_EQ(value_of("[]]"), "1:7 something stands behind the value or name");
}

TEST(TomlReader, NamesEveryOtherProblemWithItsPlace) {
    const struct {
        std::string text;
        Items items;
    } cases[] = {
        {"= 1", {"1:1 expected a key, a [table] or a comment"}},
        {"]", {"1:1 expected a key, a [table] or a comment"}},
        {"\n \xef\xbb\xbf", {"2:2 expected a key, a [table] or a comment"}},
        {std::string("\0", 1), {"1:1 expected a key, a [table] or a comment"}},
        {std::string("a = 1\n\0", 7), {"a = integer 1000000", "2:1 expected a key, a [table] or a comment"}},
        {"a", {"1:2 expected = behind the key"}},
        {"a\n= 1", {"1:2 expected = behind the key"}},
        {"a b = 1", {"1:3 expected = behind the key"}},
        {"a: 1", {"1:2 expected = behind the key"}},
        {"a =", {"1:4 expected a value: a \"string\", a number, true, false or an [array]"}},
        {"a =\nb = 1", {"1:4 expected a value: a \"string\", a number, true, false or an [array]"}},
        {"a = # c", {"1:5 expected a value: a \"string\", a number, true, false or an [array]"}},
        {"a = 1 b = 2", {"1:7 something stands behind the value or name"}},
        {"a = 1,", {"1:6 something stands behind the number; it has a point, not a comma"}},
        {"a = 1,5", {"1:6 something stands behind the number; it has a point, not a comma"}},
        {"a = true,", {"1:9 something stands behind the value or name"}},
        {"a = true false", {"1:10 something stands behind the value or name"}},
        {"a = \"x\" y", {"1:9 something stands behind the value or name"}},
        {std::string("a = 1\0", 6), {"1:6 something stands behind the value or name"}},
        {"[a] b = 1", {"1:5 something stands behind the value or name"}},
        {"[]", {"1:2 expected a name of letters, digits, _ and -"}},
        {"[", {"1:2 expected a name of letters, digits, _ and -"}},
        {"[[]]", {"1:3 expected a name of letters, digits, _ and -"}},
        {"[ [a] ]", {"1:3 expected a name of letters, digits, _ and -"}},
        {"[\"a\"]", {"1:2 expected a name of letters, digits, _ and -"}},
        {"[a", {"1:3 expected ] behind the table's name"}},
        {"[a.b]", {"1:3 expected ] behind the table's name"}},
        {"[a b]", {"1:4 expected ] behind the table's name"}},
        {"[[a]", {"1:5 expected ] behind the table's name"}},
        {"[[a] ]", {"1:5 expected ] behind the table's name"}},
        {"[a]]", {"1:4 something stands behind the value or name"}},
        {"# bell \a", {"1:8 a control character in a comment"}},
        {"a = 1 # \x7f", {"1:9 a control character in a comment"}},
        {std::string("# \0", 3), {"1:3 a control character in a comment"}},
        {"# tab \t is fine\nb = 1", {"b = integer 1000000"}},
        {"# text\r", {"1:8 something stands behind the value or name"}},
    };
    for (const auto& expected : cases) EXPECT_EQ(read_all(expected.text), expected.items) << expected.text;
}

TEST(TomlReader, CountsLinesAndColumnsOverManyLines) {
    std::string text;
    for (int i = 0; i < 1000; ++i)
        text += i % 3 == 0 ? "# c\r\n" : i % 3 == 1 ? "\n" : "k = [1, \"x\"] # d\n";
    text += "  k = ?";
    EXPECT_EQ(read_all(text).back().substr(0, 23), "1001:7 expected a value");
}

TEST(TomlString, NeedsAStringAndRoom) {
    const std::string text = "a = \"x\\\"yz\"\nb = 1";
    TomlReader reader(span_of(text));
    const Result<TomlItem> item = reader.next();
    ASSERT_TRUE(item.ok());
    EXPECT_EQ(string_of(item->value.text), "x\\\"yz") << "escapes are still in place";
    char buffer[4] = {};
    const Result<int> length = toml_string(item->value, buffer);
    ASSERT_TRUE(length.ok());
    EXPECT_EQ(std::string(buffer, static_cast<std::size_t>(*length)), "x\"yz");
    EXPECT_EQ(toml_string(item->value, Span<char>(buffer).first(3)).status(), Status::buffer_too_small);
    EXPECT_EQ(toml_string(item->value, {}).status(), Status::buffer_too_small);
    const Result<TomlItem> number = reader.next();
    ASSERT_TRUE(number.ok());
    EXPECT_EQ(toml_string(number->value, buffer).status(), Status::bad_argument);
}

TEST(TomlArrayReader, SaysNotFoundForEver) {
    const std::string text = "a = [1, ]";
    TomlReader reader(span_of(text));
    const Result<TomlItem> item = reader.next();
    ASSERT_TRUE(item.ok());
    TomlArrayReader elements(item->value);
    EXPECT_TRUE(elements.next().ok());
    for (int i = 0; i < 3; ++i) EXPECT_EQ(elements.next().status(), Status::not_found);
}

TEST(TomlReader, WorksInConstants) {
    static constexpr char text[] = {'a', '=', '1', '2'};
    static_assert([] {
        TomlReader reader(text);
        return reader.next()->value.number;
    }() == Decimal::from_int(12));
}

/// Whatever stands in a text, a reader comes to its end or to a problem: every item takes at least one byte.
TEST(TomlReader, EndsOnEveryMutationOfAFile) {
    const std::string whole =
        "# c\nformat = 1\nname = \"a \\\"b\\\" \\\\\"\r\n[scale]\nx = -0.0125\n[[feature]]\nfrom = [1.5, 2, "
        "\"x\", true,]\n"
        "caf = \"\xc3\xa9\" # d\n";
    const std::string bytes = "\n\r\"\\[]=#,.+-019tf_ \t{}'\x01\x7f\xff\x80";
    Random random(92);
    int accepted = 0;
    for (int i = 0; i < 30000; ++i) {
        std::string text = whole;
        const int changes = random.between(1, 4);
        for (int k = 0; k < changes; ++k) {
            const auto at =
                static_cast<std::size_t>(random.below(static_cast<std::uint32_t>(text.size()) + 1));
            const char byte =
                random.below(8) == 0 ? '\0' : bytes[random.below(static_cast<std::uint32_t>(bytes.size()))];
            switch (random.below(4)) {
                case 0: text.insert(at, 1, byte); break;
                case 1: text.erase(at, 1 + random.below(5)); break;
                case 2: text.resize(at); break;
                default:
                    if (at < text.size()) text[at] = byte;
            }
        }
        TomlReader reader(span_of(text));
        std::size_t items = 0;
        for (;;) {
            const Result<TomlItem> item = reader.next();
            if (!item) {
                // The problem lies on a line that is there, at most one column behind its end.
                ASSERT_STRNE(reader.problem(), "");
                ASSERT_GE(reader.place().column, 1);
                ASSERT_LE(static_cast<std::size_t>(reader.place().column), text.size() + 2);
                ASSERT_LE(reader.place().line, 1 + std::count(text.begin(), text.end(), '\n'));
                break;
            }
            if (item->kind == TomlKind::end) {
                ++accepted;
                break;
            }
            ASSERT_LE(++items, text.size());
            if (item->kind == TomlKind::pair) static_cast<void>(shown(item->value));
        }
    }
    EXPECT_GT(accepted, 1000) << "most of the mutations must not be refused at once";
}

}  // namespace
}  // namespace fovea::test
