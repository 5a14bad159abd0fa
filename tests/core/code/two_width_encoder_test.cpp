// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fovea/code/two_width_encoder.hpp>
#include <support/bars.hpp>

namespace fovea::test {
namespace {

TEST(TwoWidthEncoder, DrawsCode39) {
    // *A*: each character of nine elements with three wide ones of two modules, and a gap of one.
    TwoWidthOptions two;
    two.wide = 2;
    EXPECT_EQ(bars_of(Symbology::code_39, "A", two).modules(),
              "100101101101"
              "0"
              "110101001011"
              "0"
              "100101101101");
}

TEST(TwoWidthEncoder, DrawsInterleaved2Of5) {
    TwoWidthOptions two;
    two.wide = 2;
    // Start, 1 in bars and 2 in spaces, stop.
    EXPECT_EQ(bars_of(Symbology::interleaved_2_of_5, "12", two).modules(),
              "1010"
              "11010010101100"
              "1101");
    EXPECT_EQ(bars_of(Symbology::interleaved_2_of_5, "2", two).modules(),
              bars_of(Symbology::interleaved_2_of_5, "02", two).modules());
}

TEST(TwoWidthEncoder, DrawsCodabar) {
    TwoWidthOptions two;
    two.wide = 2;
    EXPECT_EQ(bars_of(Symbology::codabar, "A1B", two).modules(),
              "1011001001"
              "0"
              "101011001"
              "0"
              "1001001011");
    EXPECT_EQ(bars_of(Symbology::codabar, "1", two).modules(),
              bars_of(Symbology::codabar, "A1A", two).modules());
}

TEST(TwoWidthEncoder, RefusesWhatIsNoTextAndLeavesTheList) {
    Bars bars;
    TwoWidthOptions four;
    four.wide = 4;
    EXPECT_EQ(encode_code_39(bytes_of("A"), Code39Text::plain, four, bars.view()), Status::bad_argument);
    EXPECT_EQ(encode_code_39(bytes_of("a"), Code39Text::plain, {}, bars.view()), Status::bad_argument);
    EXPECT_EQ(encode_code_39(bytes_of("\xe9"), Code39Text::full_ascii, {}, bars.view()),
              Status::bad_argument);
    EXPECT_EQ(encode_code_39({}, Code39Text::plain, {}, bars.view()), Status::bad_argument);
    const std::string longer(most_bar_text + 1, '1');
    EXPECT_EQ(encode_code_39(bytes_of(longer), Code39Text::plain, {}, bars.view()), Status::bad_argument);
    EXPECT_EQ(encode_interleaved(bytes_of("1"), four, bars.view()), Status::bad_argument);
    EXPECT_EQ(encode_interleaved(bytes_of("1A"), {}, bars.view()), Status::bad_argument);
    EXPECT_EQ(encode_interleaved({}, {}, bars.view()), Status::bad_argument);
    EXPECT_EQ(encode_interleaved(bytes_of(longer), {}, bars.view()), Status::bad_argument);
    EXPECT_EQ(encode_codabar(bytes_of("1"), four, bars.view()), Status::bad_argument);
    EXPECT_EQ(encode_codabar(bytes_of("1A2"), {}, bars.view()), Status::bad_argument);
    EXPECT_EQ(encode_codabar({}, {}, bars.view()), Status::bad_argument);
    EXPECT_EQ(encode_codabar(bytes_of(longer), {}, bars.view()), Status::bad_argument);
    std::uint8_t room[8] = {};
    int count = 0;
    EXPECT_EQ(encode_code_39(bytes_of("1"), Code39Text::plain, {}, {room, 8, &count}),
              Status::buffer_too_small);
    EXPECT_EQ(encode_interleaved(bytes_of("1"), {}, {room, 8, &count}), Status::buffer_too_small);
    EXPECT_EQ(encode_codabar(bytes_of("1"), {}, {room, 8, &count}), Status::buffer_too_small);
    EXPECT_EQ(bars.count + count, 0);
}

}  // namespace
}  // namespace fovea::test
