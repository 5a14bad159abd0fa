// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>

#include <fovea/code/blurred_votes.hpp>

namespace fovea {
namespace {

BlurredEan reading(const std::string& digits, int hundredths) {
    BlurredEan ean;
    ean.digit_count = static_cast<int>(digits.size());
    for (std::size_t i = 0; i < digits.size(); ++i)
        ean.digits[i] = static_cast<std::uint8_t>(digits[i] - '0');
    ean.margin = Ratio::from_ratio(hundredths, 100);
    return ean;
}

TEST(BlurredVotes, DecideWhenTwoProfilesAgreeClearly) {
    BlurredVotes votes;
    EXPECT_EQ(votes.take(reading("9780905705712", 160)), 1);
    EXPECT_FALSE(votes.decided());
    EXPECT_EQ(votes.take(reading("9780905705712", 130)), 2);
    EXPECT_TRUE(votes.decided());
    EXPECT_EQ(votes.best().margin, Ratio::from_ratio(160, 100));
}

TEST(BlurredVotes, DoNotCountWhatIsNotClear) {
    BlurredVotes votes;
    for (int i = 0; i < 9; ++i) EXPECT_EQ(votes.take(reading("5110011111420", 115 + i)), 0);
    EXPECT_FALSE(votes.decided());
    EXPECT_EQ(votes.take(reading("5110011111420", 114)), 0);
}

TEST(BlurredVotes, AreHeldUpByOtherDigits) {
    BlurredVotes votes;
    EXPECT_EQ(votes.take(reading("6780515460950", 126)), 1);
    EXPECT_EQ(votes.take(reading("9780345460950", 200)), 1);
    EXPECT_EQ(votes.take(reading("9780345460950", 200)), 2);
    // One profile speaks for others: two are not more than twice as many.
    EXPECT_FALSE(votes.decided());
    EXPECT_EQ(votes.take(reading("9780345460950", 200)), 3);
    EXPECT_TRUE(votes.decided());
    EXPECT_EQ(votes.best().digits[0], 9);
}

TEST(BlurredVotes, WhatIsClearIsBelievedBeforeALargerMarginThatIsNot) {
    const BlurredEan ean_13 = reading("9780905705712", 130);
    BlurredEan ean_8 = reading("36536559", 140);
    ean_8.symbology = Symbology::ean_8;
    EXPECT_TRUE(detail::is_clearer_reading(ean_13, ean_8));
    EXPECT_FALSE(detail::is_clearer_reading(ean_8, ean_13));
    ean_8.margin = Ratio::from_ratio(150, 100);
    EXPECT_TRUE(detail::is_clearer_reading(ean_8, ean_13));
    EXPECT_FALSE(detail::is_clearer_reading(ean_13, ean_8));
    // Neither is clear, then both are.
    for (const int margin : {110, 126}) {
        const BlurredEan less = reading("9780905705712", margin), more = reading("9780345460950", margin + 9);
        EXPECT_TRUE(detail::is_clearer_reading(more, less));
        EXPECT_FALSE(detail::is_clearer_reading(less, more));
        EXPECT_FALSE(detail::is_clearer_reading(less, less));
    }
}

// A UPC-E with modules of 1.5 px and a blur of 1.2 modules was told as 36536559.
TEST(BlurredVotes, WantMoreOfTheFewDigitsOfAnEan8) {
    BlurredVotes votes;
    BlurredEan ean_8 = reading("36536559", 131);
    ean_8.symbology = Symbology::ean_8;
    for (int i = 0; i < 9; ++i) EXPECT_EQ(votes.take(ean_8), 0);
    EXPECT_FALSE(votes.decided());
    ean_8.margin = Ratio::from_ratio(150, 100);
    EXPECT_EQ(votes.take(ean_8), 1);
    EXPECT_EQ(votes.take(ean_8), 2);
    EXPECT_TRUE(votes.decided());
}

TEST(BlurredVotes, ManyDifferentReadingsDecideNothing) {
    BlurredVotes votes;
    for (int i = 0; i < 20; ++i) {
        std::string digits = "9780345460950";
        digits[4] = static_cast<char>('0' + i % 7);
        EXPECT_GE(votes.take(reading(digits, 130)), 0);
    }
    EXPECT_FALSE(votes.decided());
}

}  // namespace
}  // namespace fovea
