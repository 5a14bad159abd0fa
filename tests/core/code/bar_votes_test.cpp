// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fovea/code/bar_votes.hpp>
#include <support/bars.hpp>

namespace fovea::test {
namespace {

BarReading reading_of(const std::string& text, Symbology symbology = Symbology::ean_13) {
    BarReading reading;
    reading.symbology = symbology;
    reading.quiet = 256;
    reading.size = reading.base = static_cast<int>(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) reading.text[i] = static_cast<std::uint8_t>(text[i]);
    return reading;
}
BarSpan row(int y, int x = 100) {
    return {{SubPixel::from_int(x), SubPixel::from_int(y)},
            {SubPixel::from_int(x + 200), SubPixel::from_int(y)}};
}

class BarVotesTest : public testing::Test {
protected:
    BarVote vote(const std::string& text, const BarSpan& span) {
        return votes.take(reading_of(text), span, false, which);
    }
    List<BarCandidate, 3> candidates;
    BarVotes votes{candidates.view()};
    int which = -1;
};

TEST_F(BarVotesTest, TwoLinesThatAgreeAreEnoughForAGoodReading) {
    EXPECT_EQ(vote("9780905705712", row(50)), BarVote::counted);
    EXPECT_FALSE(votes.is_certain(which));
    EXPECT_EQ(vote("9780905705712", row(54)), BarVote::counted);
    EXPECT_TRUE(votes.is_certain(which));
    EXPECT_EQ(candidates[0].highest.from.y.floor(), 54);
    EXPECT_EQ(candidates[0].lowest.from.y.floor(), 50);
}

TEST_F(BarVotesTest, TheSameLineSaysNothingNew) {
    vote("9780905705712", row(50));
    EXPECT_EQ(vote("9780905705712", row(50)), BarVote::repeated);
    EXPECT_EQ(vote("9780905705712", row(51)), BarVote::repeated);
    EXPECT_EQ(candidates[0].lines, 1);
}

TEST_F(BarVotesTest, AContradictionAtTheSamePlaceMakesItUndecided) {
    vote("9780905705712", row(50));
    vote("9780905705729", row(52));
    vote("9780905705712", row(54));
    EXPECT_FALSE(votes.is_certain(0));
    EXPECT_FALSE(votes.is_certain(1));
    for (int y = 56; y < 60; y += 2) vote("9780905705712", row(y));
    EXPECT_FALSE(votes.is_certain(0));
    vote("9780905705712", row(60));
    EXPECT_TRUE(votes.is_certain(0));  // five against one
}

TEST_F(BarVotesTest, TheSameTextElsewhereIsAnotherCode) {
    vote("9780905705712", row(50));
    vote("9780905705712", row(50, 400));
    EXPECT_EQ(candidates.size(), 2);
}

TEST_F(BarVotesTest, NothingSpeaksAgainstASettledCode) {
    vote("9780905705712", row(50));
    candidates[0].settled = true;
    EXPECT_EQ(vote("9780905705729", row(52)), BarVote::ignored);
    EXPECT_EQ(candidates.size(), 1);
}

TEST_F(BarVotesTest, AFullListIgnoresTheRest) {
    for (int i = 0; i < 3; ++i) EXPECT_EQ(vote("9780905705712", row(50, 400 * i)), BarVote::counted);
    EXPECT_EQ(vote("9780905705712", row(50, 1200)), BarVote::ignored);
}

TEST_F(BarVotesTest, ReadingsFromBothEndsAreOnTheSameSide) {
    // Upside down: the second line lies to the left of the first, as one reads.
    const auto turned = [](BarSpan span) { return BarSpan{span.to, span.from}; };
    vote("9780905705712", turned(row(50)));
    vote("9780905705712", turned(row(54)));
    EXPECT_EQ(candidates[0].lowest.from.y.floor(), 54);
}

TEST_F(BarVotesTest, Interleaved2Of5MustBeSeenInLinesApart) {
    const BarReading reading = reading_of("30712345000010", Symbology::interleaved_2_of_5);
    for (int y = 50; y < 74; y += 2) votes.take(reading, row(y), false, which);
    EXPECT_FALSE(votes.is_certain(which));  // 22 of 200 px
    votes.take(reading, row(75), false, which);
    EXPECT_TRUE(votes.is_certain(which));
}

// The left half of 4828599153336, whose right half was covered along a slanted edge, was told as 18285994.
TEST_F(BarVotesTest, UpcEOfNumberSystem1MustBeSeenInLinesApart) {
    const BarReading reading = reading_of("18285994", Symbology::upc_e);
    for (int y = 50; y < 74; y += 2) votes.take(reading, row(y), false, which);
    EXPECT_FALSE(votes.is_certain(which));  // 22 of 200 px
    votes.take(reading, row(75), false, which);
    EXPECT_TRUE(votes.is_certain(which));
}
TEST_F(BarVotesTest, UpcEOfNumberSystem0NeedsNoLinesApart) {
    const BarReading reading = reading_of("01234565", Symbology::upc_e);
    for (int y = 50; y < 58; y += 2) votes.take(reading, row(y), false, which);
    EXPECT_TRUE(votes.is_certain(which));
}

TEST(BarLinesNeeded, FewDigitsPoorFitAndNarrowQuietZonesWantMore) {
    BarReading reading = reading_of("9780905705712");
    EXPECT_EQ(bar_lines_needed(reading), 2);
    reading.error = 60;
    EXPECT_EQ(bar_lines_needed(reading), 3);
    reading.quiet = 80;
    EXPECT_EQ(bar_lines_needed(reading), 4);
    EXPECT_EQ(bar_lines_needed(reading_of("55123457", Symbology::ean_8)), 3);
    EXPECT_EQ(bar_lines_needed(reading_of("AB", Symbology::code_128)), 3);
}

}  // namespace
}  // namespace fovea::test
