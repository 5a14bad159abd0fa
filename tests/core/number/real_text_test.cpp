// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>

#include <fovea/base/random.hpp>
#include <fovea/number/real_text.hpp>
#include <support/scalars.hpp>

namespace fovea::test {
namespace {

Result<Real> parsed(const std::string& text) {
    return parse_real({text.data(), static_cast<std::ptrdiff_t>(text.size())});
}
std::string printed(Real value, int digits) {
    char buffer[8 + whole_real_digits];
    const Result<int> length = print_real(value, digits, Span<char>(buffer, 8 + digits));
    return length ? std::string(buffer, static_cast<std::size_t>(*length)) : describe(length.status());
}

TEST(ParseReal, ReadsNumbersAsTheyAreWritten) {
    EXPECT_EQ(*parsed("0"), Real());
    EXPECT_EQ(*parsed("-0.000e40"), Real());
    EXPECT_EQ(*parsed("+12"), Real::from_int(12));
    EXPECT_EQ(*parsed("-12.5"), Real::from_ratio(-25, 2));
    EXPECT_EQ(*parsed("00012.5000"), Real::from_ratio(25, 2));
    EXPECT_EQ(*parsed("1e3"), Real::from_int(1000));
    EXPECT_EQ(*parsed("1250E-2"), Real::from_ratio(25, 2));
    EXPECT_EQ(*parsed("9223372036854775807"), Real::from_int(9223372036854775807));
    // Both are 1.0101... in binary digits, which are cut before a 1: the nearest is one more.
    EXPECT_EQ(*parsed("0.3333333333333333333333333333333333333333"),
              Real::from_ratio(1, 3) + Real::from_int(1, -65));
    EXPECT_EQ(*parsed("0.6666666666666666666666666666666666666667"),
              Real::from_ratio(2, 3) + Real::from_int(1, -64));
    EXPECT_EQ(*parsed("18446744073709551616.5"), Real::from_int(1, 64));
    EXPECT_EQ(*parsed("36893488147419103233"), Real::from_int(1, 65) + Real::from_int(2));
}

TEST(ParseReal, IsAsNearAsLongDouble) {
    if (std::numeric_limits<long double>::digits < 64) GTEST_SKIP() << "long double has no 64 digits here";
    Random random(1);
    for (int i = 0; i < 20000; ++i) {
        std::string text = random.below(2) == 0 ? "-" : "";
        const int digits = random.between(1, 30);
        const int point = random.between(1, digits);
        for (int k = 0; k < digits; ++k) {
            text += static_cast<char>('0' + random.below(10));
            if (k + 1 == point && k + 1 < digits) text += '.';
        }
        text += "e" + std::to_string(random.between(-40, 29));
        const Result<Real> number = parsed(text);
        ASSERT_TRUE(number) << text;
        // Both round to the nearest of 64 digits, and ties to even.
        ASSERT_EQ(value_of(*number), std::strtold(text.c_str(), nullptr)) << text;
    }
}

TEST(ParseReal, RefusesEverythingElse) {
    for (const char* text : {"",   "-",     "+",   ".",    ".5",  "5.",  "1e",  "1e+",   "e5",    "1 ",
                             " 1", "1.2.3", "--1", "0x10", "inf", "nan", "1,5", "1e5.0", "1e--5", "1_000"})
        EXPECT_EQ(parsed(text).status(), Status::malformed) << text;
    EXPECT_EQ(parsed(std::string("1\0", 2)).status(), Status::malformed);
    for (const std::string& text :
         {std::string(41, '1'), std::string("1e60"), std::string("1e-61"), std::string("1e99999999999"),
          "0." + std::string(1001, '0') + "1e1001", std::string(3000, '9') + "e-2990"})
        EXPECT_EQ(parsed(text).status(), Status::out_of_range) << text;
    EXPECT_TRUE(parsed(std::string(500, '0') + "1"));
    EXPECT_EQ(*parsed("0." + std::string(200000, '0') + "e7"), Real());
    EXPECT_TRUE(parsed("1e-60"));
    EXPECT_TRUE(parsed("9.99e59"));
    EXPECT_TRUE(parsed(std::string(40, '9')));
}

TEST(PrintReal, WritesWhatAPersonReads) {
    EXPECT_EQ(printed(Real(), 6), "0");
    EXPECT_EQ(printed(Real::from_ratio(-1, 4), 6), "-0.25");
    EXPECT_EQ(printed(Real::from_int(1200), 6), "1200");
    EXPECT_EQ(printed(Real::from_int(123456), 3), "1.23e+05");
    EXPECT_EQ(printed(Real::from_int(999999), 3), "1e+06");
    EXPECT_EQ(printed(Real::from_ratio(1, 3), 4), "0.3333");
    EXPECT_EQ(printed(Real::from_ratio(2, 3), 4), "0.6667");
    EXPECT_EQ(printed(Real::from_ratio(5, 2), 1), "2");
    EXPECT_EQ(printed(Real::from_ratio(7, 2), 1), "4");
    EXPECT_EQ(printed(*parsed("0.00012"), 5), "0.00012");
    EXPECT_EQ(printed(*parsed("0.000012"), 5), "1.2e-05");
    EXPECT_EQ(printed(*parsed("-1e-58"), 3), "-1e-58");
    EXPECT_EQ(printed(*parsed("536.454766207"), 12), "536.454766207");
    EXPECT_EQ(printed(Real::from_int(100), 3), "100");
    EXPECT_EQ(printed(Real::from_int(1, 180), 21), "1.53249554086588885836e+54");
}

TEST(PrintReal, IsAsNearAsPrintfOfLongDouble) {
    if (std::numeric_limits<long double>::digits < 64) GTEST_SKIP() << "long double has no 64 digits here";
    Random random(2);
    for (int i = 0; i < 20000; ++i) {
        const std::uint64_t high = random.next();
        const Real value =
            Real::from_int(static_cast<std::int64_t>(high << 32 | random.next()), random.between(-200, 100));
        const int digits = random.between(1, whole_real_digits);
        char expected[64];
        std::snprintf(expected, sizeof expected, "%.*Lg", digits, value_of(value));
        ASSERT_EQ(printed(value, digits), expected) << digits;
    }
}

TEST(PrintReal, WhatIsWrittenWholeIsReadAsTheSame) {
    Random random(3);
    for (int i = 0; i < 20000; ++i) {
        const std::uint64_t high = random.next();
        const Real value =
            Real::from_int(static_cast<std::int64_t>(high << 32 | random.next()), random.between(-240, 130));
        const std::string text = printed(value, whole_real_digits);
        ASSERT_EQ(*parsed(text), value) << text;
    }
}

TEST(PrintReal, ItsErrors) {
    char buffer[14];
    const Span<char> room(buffer);
    EXPECT_EQ(print_real(Real::one(), 0, room).status(), Status::bad_argument);
    EXPECT_EQ(print_real(Real::one(), 22, room).status(), Status::bad_argument);
    EXPECT_EQ(print_real(Real::one(), 7, room).status(), Status::buffer_too_small);
    EXPECT_EQ(print_real(Real(), 7, room).status(), Status::buffer_too_small);
    EXPECT_EQ(*print_real(Real::one(), 6, room), 1);
    EXPECT_EQ(*print_real(-*parsed("1.23456e-50"), 6, room), 12);
    for (const int exponent : {200, 10000, -200, -10000})
        EXPECT_EQ(print_real(Real::from_int(1, exponent), 3, room).status(), Status::out_of_range);
}

}  // namespace
}  // namespace fovea::test
