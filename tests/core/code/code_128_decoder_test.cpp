// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fovea/code/code_128_decoder.hpp>
#include <support/bars.hpp>

namespace fovea::test {
namespace {

std::string read(const Bars& bars, int module = 512, int gain = 0) {
    const std::vector<std::int32_t> edges = edges_of(bars, module, 12, gain);
    BarReading reading;
    const Status status = decode_code_128(span_of(edges), 1, reading);
    if (status != Status::ok) return describe(status);
    return std::string("C") + reading.aim_digit + " " + text_of(reading);
}
std::string read(const std::string& text, Code128Kind kind, int module = 512, int gain = 0) {
    Bars bars;
    EXPECT_EQ(encode_code_128(bytes_of(text), kind, bars.view()), Status::ok);
    return read(bars, module, gain);
}
/// The bars of values, with the check character.
Bars bars_of_values(std::initializer_list<int> values) {
    Bars bars;
    detail::BarWriter writer(bars.view());
    const auto add = [&](int value) {
        for (int run = 0; run < 6; ++run)
            writer.add(static_cast<int>(code_128_widths[value] >> (20 - 4 * run) & 7U));
    };
    int sum = 0;
    int place = 0;
    for (const int value : values) {
        add(value);
        sum += place == 0 ? value : place * value;
        ++place;
    }
    add(sum % 103);
    for (int run = 0; run < 7; ++run)
        writer.add(static_cast<int>(code_128_stop_widths >> (24 - 4 * run) & 7U));
    return bars;
}

TEST(Code128Decoder, ReadsOneCharacterWithoutAnError) {
    const std::vector<std::int32_t> edges = edges_of(bars_of(Symbology::code_128, "A"), 512);
    BarReading reading;
    ASSERT_EQ(decode_code_128(span_of(edges), 1, reading), Status::ok);
    EXPECT_EQ(text_of(reading), "A");
    EXPECT_EQ(reading.error, 0);
    EXPECT_EQ(reading.quiet, 256);
    EXPECT_EQ(reading.last - reading.first, 6 * 3 + 7);
}

TEST(Code128Decoder, ReadsWhatTheEncoderDraws) {
    Random random(3111);
    for (int round = 0; round < 600; ++round) {
        std::string text;
        const auto size = 1 + random.below(40);
        const auto kind = random.below(4);
        while (text.size() < size) {
            const auto byte = kind == 0   ? random.below(256)
                              : kind == 1 ? '0' + random.below(10)
                              : kind == 2
                                  ? 32 + random.below(95)
                                  : (random.below(3) != 0 ? '0' + random.below(10) : random.below(128));
            text += static_cast<char>(byte);
        }
        const int module = 200 + static_cast<int>(random.below(2000));
        EXPECT_EQ(read(text, Code128Kind::plain, module, random.between(-module / 3, module / 3)),
                  "C0 " + text);
    }
}

TEST(Code128Decoder, FirstFunctionTellsTheKindOfContents) {
    EXPECT_EQ(read("0109876543210987\x1d"
                   "10AB",
                   Code128Kind::gs1),
              "C1 0109876543210987\x1d"
              "10AB");
    EXPECT_EQ(read(bars_of_values({code_128::start_b, 33, code_128::fnc_1, 34})), "C2 AB");
    EXPECT_EQ(read(bars_of_values({code_128::start_c, 33, code_128::fnc_1, 34})), "C2 3334");
    EXPECT_EQ(read(bars_of_values({code_128::start_b, 33, 34, code_128::fnc_1, 35})),
              "C0 AB\x1d"
              "C");
}

TEST(Code128Decoder, ShiftIsForOneCharacterAndFunctionFourForOneOrAll) {
    EXPECT_EQ(read(bars_of_values({code_128::start_b, 65, code_128::shift, 65, 66})),
              "C0 a\x01"
              "b");
    EXPECT_EQ(read(bars_of_values({code_128::start_b, code_128::code_b, 65, 66})),
              "C0 \xe1"
              "b");
    EXPECT_EQ(read(bars_of_values(
                  {code_128::start_b, code_128::code_b, code_128::code_b, 65, 66, code_128::code_b, 67})),
              "C0 \xe1\xe2"
              "c");
    EXPECT_EQ(read(bars_of_values({code_128::start_a, code_128::fnc_2, 33, code_128::fnc_3})), "C0 A");
}

TEST(Code128Decoder, WrongCheckCharacterIsNoCode) {
    Random random(3112);
    for (int round = 0; round < 300; ++round) {
        Bars bars = bars_of(Symbology::code_128, "FOVEA 42");
        const int place = 1 + static_cast<int>(random.below(9));
        const auto value = random.below(103);
        bool same = true;
        for (int run = 0; run < 6; ++run) {
            const auto width = static_cast<std::uint8_t>(code_128_widths[value] >> (20 - 4 * run) & 7U);
            same = same && bars.widths[6 * place + run] == width;
            bars.widths[6 * place + run] = width;
        }
        if (!same) {
            EXPECT_EQ(read(bars), "nothing found");
        }
    }
}

TEST(Code128Decoder, WantsHalfAQuietZoneAndLeavesTheReadingOnErrors) {
    const Bars bars = bars_of(Symbology::code_128, "FOVEA");
    const std::vector<std::int32_t> edges = edges_of(bars, 512, 3);
    BarReading reading;
    reading.size = 77;
    EXPECT_EQ(decode_code_128(span_of(edges), 1, reading), Status::not_found);
    EXPECT_EQ(decode_code_128(span_of(edges), 0, reading), Status::out_of_range);
    EXPECT_EQ(decode_code_128({}, 1, reading), Status::out_of_range);
    const std::vector<std::int32_t> still(60, 5);  // runs of no width
    for (int first = 1; first < 60; first += 2) {
        EXPECT_EQ(decode_code_128(span_of(still), first, reading), Status::not_found);
    }
    EXPECT_EQ(reading.size, 77);
}

}  // namespace
}  // namespace fovea::test
