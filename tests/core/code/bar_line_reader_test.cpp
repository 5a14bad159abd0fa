// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vector>

#include <fovea/code/bar_line_reader.hpp>
#include <support/bars.hpp>

namespace fovea::test {
namespace {

/// A reader that is given the same bars at several heights.
class BarLineReaderTest : public testing::Test {
protected:
    static constexpr int width = 400;

    BarLineReaderTest() : scratch(static_cast<std::size_t>(detail::BarLineReader::scratch_bytes(width, 4))) {}
    detail::BarLineReader reader(const BarRules& rules) {
        Arena arena({scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())});
        return detail::BarLineReader(rules, 2, arena, width, 4);
    }
    void read(detail::BarLineReader& reader, const BarPicture& picture, int y) {
        const BarLine line = {
            {FinePixel(), FinePixel::from_int(y)}, {FinePixel::from_int(1), FinePixel()}, width};
        sample_bar_line(picture.view(), line, 1, reader.profile(width));
        reader.read(line, 1, {});
    }
    BarPicture isbn() {
        BarPicture picture({width, 60});
        draw_bars(picture, bars_of(Symbology::ean_13, "9780905705712"), {}, random);
        return picture;
    }
    Random random{3211};
    std::vector<std::uint8_t> scratch;
};

TEST_F(BarLineReaderTest, SettlesWhatLinesAgreeOn) {
    const BarPicture picture = isbn();
    detail::BarLineReader lines = reader({});
    read(lines, picture, 20);
    EXPECT_EQ(lines.settled(), 0);
    EXPECT_EQ(lines.fresh(), 0);
    EXPECT_EQ(lines.fresh_span().from.y, SubPixel::from_int(20));
    for (int y = 22; y < 30; y += 2) read(lines, picture, y);
    EXPECT_EQ(lines.settled(), 1);
    EXPECT_EQ(lines.candidates()[0].lines, 5);
}

TEST_F(BarLineReaderTest, WaitsForAnAddOnUntilTheRestIsSettled) {
    BarRules rules;
    rules.add_on = AddOn::appended;
    const BarPicture picture = isbn();
    detail::BarLineReader lines = reader(rules);
    for (int y = 20; y < 28; y += 2) read(lines, picture, y);
    EXPECT_EQ(lines.settled(), 0);
    lines.settle_rest();
    EXPECT_EQ(lines.settled(), 1);
    EXPECT_EQ(detail::code_of(lines.candidates()[0]).text_size, 13);
}

TEST(CodeOf, AnAddOnThatOnlyOneLineSawIsLeftOut) {
    BarCandidate candidate;
    candidate.reading.base = 13;
    candidate.reading.size = 15;
    candidate.reading.aim_digit = '3';
    candidate.add_on_lines = 1;
    EXPECT_EQ(detail::code_of(candidate).text_size, 13);
    EXPECT_EQ(detail::code_of(candidate).aim_digit, '0');
    candidate.add_on_lines = 2;
    EXPECT_EQ(detail::code_of(candidate).text_size, 15);
    EXPECT_EQ(detail::code_of(candidate).aim_digit, '3');
    candidate.add_on_doubts = 1;
    EXPECT_EQ(detail::code_of(candidate).text_size, 13);
}

}  // namespace
}  // namespace fovea::test
