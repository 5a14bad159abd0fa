// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include <fovea/base/random.hpp>
#include <fovea/number/decimal.hpp>

namespace fovea::test {
namespace {

__extension__ using Native = __int128;

Result<Decimal> parse(const std::string& text) {
    return parse_decimal({text.data(), static_cast<std::ptrdiff_t>(text.size())});
}
/// The number in millionths; a number that none of the tests expects if there is none.
std::int64_t parsed(const std::string& text) {
    const Result<Decimal> number = parse(text);
    EXPECT_TRUE(number.ok()) << text << ": " << describe(number.status());
    return number ? number->millionths : INT64_MIN;
}
std::string printed(std::int64_t millionths, int places) {
    char buffer[40];
    const Result<int> length = print_decimal({millionths}, places, buffer);
    return length ? std::string(buffer, static_cast<std::size_t>(*length)) : describe(length.status());
}

/// Any number that parse_decimal() takes, small and large ones equally likely.
std::int64_t any(Random& random) {
    const auto high = static_cast<std::uint64_t>(random.next());
    const auto bits = static_cast<std::int64_t>(high << 32 | random.next());
    return (bits >> random.between(0, 62)) % (max_decimal_units * 1000000 + 1);
}

/// |value| over 10^(6 - places) to the nearest, ties up, written with a sign unless it is zero.
std::string slowly_printed(std::int64_t value, int places) {
    Native drop = 1;
    for (int i = places; i < 6; ++i) drop *= 10;
    const Native size = value < 0 ? -Native{value} : Native{value};
    Native rest = (2 * size + drop) / (2 * drop);
    const bool zero = rest == 0;
    std::string text;
    for (int i = 0; i < places || rest != 0 || i == places; ++i, rest /= 10) {
        if (i == places && places > 0) text.insert(text.begin(), '.');
        text.insert(text.begin(), static_cast<char>('0' + static_cast<int>(rest % 10)));
    }
    return (value < 0 && !zero ? "-" : "") + text;
}

TEST(Decimal, IsComparedAndAddedExactly) {
    constexpr Decimal one = Decimal::from_int(1);
    constexpr Decimal tenth{100000};
    static_assert(one + tenth == Decimal{1100000} && one - tenth == Decimal{900000} &&
                  -one == Decimal{-1000000});
    static_assert(tenth < one && one > tenth && tenth <= one && one >= one && one <= one && tenth != one);
    static_assert(!(one < one) && !(one > one) && !(tenth == one));
    EXPECT_EQ(Decimal::from_int(-12).millionths, -12000000);
}

TEST(ParseDecimal, ReadsWhatPeopleWrite) {
    EXPECT_EQ(parsed("0"), 0);
    EXPECT_EQ(parsed("12"), 12000000);
    EXPECT_EQ(parsed("12.5"), 12500000);
    EXPECT_EQ(parsed("+12.5"), 12500000);
    EXPECT_EQ(parsed("-0.000001"), -1);
    EXPECT_EQ(parsed("-0"), 0);
    EXPECT_EQ(parsed("0.1"), 100000);
    EXPECT_EQ(parsed("007.250"), 7250000);
    EXPECT_EQ(parsed("3.14159200000000"), 3141592);
}

TEST(ParseDecimal, ReadsUpToItsBoundAndNotBeyond) {
    const std::string most = std::to_string(max_decimal_units);
    EXPECT_EQ(parsed(most), max_decimal_units * 1000000);
    EXPECT_EQ(parsed("-" + most), -max_decimal_units * 1000000);
    EXPECT_EQ(parsed("000000000000000000000000" + most + ".000000000"), max_decimal_units * 1000000);
    EXPECT_EQ(parsed(std::to_string(max_decimal_units - 1) + ".999999"), max_decimal_units * 1000000 - 1);
    for (const std::string& beyond :
         {most + ".000001", "-" + most + ".000001", std::to_string(max_decimal_units + 1), most + "0",
          std::string(400, '9'), "-" + std::string(400, '9')})
        EXPECT_EQ(parse(beyond).status(), Status::out_of_range) << beyond;
}

TEST(ParseDecimal, RefusesPlacesThatItCannotHold) {
    EXPECT_EQ(parsed("0.0000010"), 1);
    EXPECT_EQ(parse("0.0000001").status(), Status::out_of_range);
    EXPECT_EQ(parse("1.12345600000000000009").status(), Status::out_of_range);
}

TEST(ParseDecimal, RefusesWhatIsNoNumber) {
    for (const char* text :
         {"",   "+",  "-",   ".",   "-.", "1.", "+1.",   ".5",   "-.5", "1e5", "1.5e1", "1_000", "1,5",
          " 1", "1 ", "--1", "+-1", "1-", "1+", "1.2.3", "0x10", "inf", "nan", "1.-5",  "ten",   "\n1"})
        EXPECT_EQ(parse(text).status(), Status::malformed) << "\"" << text << "\"";
    EXPECT_EQ(parse(std::string("1\0", 2)).status(), Status::malformed);
    EXPECT_EQ(parse(std::string("\xd9\xa1", 2)).status(), Status::malformed) << "an Arabic digit";
}

TEST(PrintDecimal, RoundsToItsPlacesWithTiesAwayFromZero) {
    EXPECT_EQ(printed(12500000, 6), "12.500000");
    EXPECT_EQ(printed(12500000, 3), "12.500");
    EXPECT_EQ(printed(12500000, 0), "13");
    EXPECT_EQ(printed(-12500000, 0), "-13");
    EXPECT_EQ(printed(12499999, 0), "12");
    EXPECT_EQ(printed(999999, 5), "1.00000");
    EXPECT_EQ(printed(-1, 6), "-0.000001");
    EXPECT_EQ(printed(5, 5), "0.00001");
    EXPECT_EQ(printed(4, 5), "0.00000");
    EXPECT_EQ(printed(0, 0), "0");
}

TEST(PrintDecimal, WritesNoMinusBeforeZero) {
    EXPECT_EQ(printed(-499, 3), "0.000");
    EXPECT_EQ(printed(-500, 3), "-0.001");
    EXPECT_EQ(printed(-499999, 0), "0");
    EXPECT_EQ(printed(-500000, 0), "-1");
    EXPECT_EQ(printed(-100000, 1), "-0.1");
}

TEST(PrintDecimal, TakesEveryNumberOf64Bits) {
    EXPECT_EQ(printed(INT64_MAX, 6), "9223372036854.775807");
    EXPECT_EQ(printed(INT64_MIN, 6), "-9223372036854.775808");
    EXPECT_EQ(printed(INT64_MAX, 0), "9223372036855");
    EXPECT_EQ(printed(INT64_MIN, 0), "-9223372036855");
    Random random(63);
    for (int i = 0; i < 20000; ++i) {
        const auto high = static_cast<std::uint64_t>(random.next());
        const auto bits = static_cast<std::int64_t>(high << 32 | random.next());
        const std::int64_t value = bits >> random.between(0, 63);
        const int places = random.between(0, 6);
        ASSERT_EQ(printed(value, places), slowly_printed(value, places)) << value << " " << places;
    }
}

TEST(PrintDecimal, RefusesPlacesAndBuffersOutsideItsContract) {
    char buffer[40];
    EXPECT_EQ(print_decimal({1}, -1, buffer).status(), Status::bad_argument);
    EXPECT_EQ(print_decimal({1}, 7, buffer).status(), Status::bad_argument);
    for (int places = 0; places <= 6; ++places) {
        for (char& c : buffer) c = '#';
        const Span<char> room(buffer);
        EXPECT_EQ(print_decimal({INT64_MIN}, places, room.first(21 + places)).status(),
                  Status::buffer_too_small);
        EXPECT_EQ(print_decimal({INT64_MIN}, places, {}).status(), Status::buffer_too_small);
        for (const char c : buffer) EXPECT_EQ(c, '#');
        EXPECT_TRUE(print_decimal({INT64_MIN}, places, room.first(22 + places)).ok());
        for (const char c : room.from(22 + places)) EXPECT_EQ(c, '#');
    }
}

TEST(Decimal, ReadsBackWhatItWrote) {
    Random random(64);
    for (int i = 0; i < 20000; ++i) {
        const std::int64_t value = any(random);
        ASSERT_EQ(parsed(printed(value, 6)), value);
        // Fewer places lose at most half of the last one.
        const int places = random.between(0, 5);
        std::int64_t unit = 1;
        for (int k = places; k < 6; ++k) unit *= 10;
        const Result<Decimal> rounded = parse(printed(value, places));
        if (!rounded) continue;  // rounded up beyond the bound
        ASSERT_LE(
            2 * (rounded->millionths > value ? rounded->millionths - value : value - rounded->millionths),
            unit);
        ASSERT_EQ(rounded->millionths % unit, 0);
    }
}

TEST(Decimal, ReadsInConstants) {
    static constexpr char text[] = {'-', '1', '.', '5'};
    static_assert(parse_decimal(text)->millionths == -1500000);
}

}  // namespace
}  // namespace fovea::test
