// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fovea/code/ean_encoder.hpp>
#include <support/bars.hpp>

namespace fovea::test {
namespace {

constexpr char isbn_modules[] =
    "10101110110001001010011100010110100111011000101010100010011100101001110100010011001101101100101";

TEST(EanEncoder, DrawsTheBooksIsbn) {
    EXPECT_EQ(bars_of(Symbology::ean_13, "9780905705712").modules(), isbn_modules);
}

TEST(EanEncoder, AddsTheCheckDigit) {
    EXPECT_EQ(bars_of(Symbology::ean_13, "978090570571").modules(), isbn_modules);
    EXPECT_EQ(bars_of(Symbology::ean_8, "5512345").modules(),
              bars_of(Symbology::ean_8, "55123457").modules());
    EXPECT_EQ(bars_of(Symbology::upc_a, "02394243101").modules(),
              bars_of(Symbology::upc_a, "023942431015").modules());
    EXPECT_EQ(bars_of(Symbology::upc_e, "0123456").modules(),
              bars_of(Symbology::upc_e, "01234565").modules());
}

TEST(EanEncoder, CodesHaveTheModulesOfTheStandard) {
    EXPECT_EQ(bars_of(Symbology::ean_8, "55123457").modules().size(), std::size_t{ean_8_modules});
    EXPECT_EQ(bars_of(Symbology::upc_a, "023942431015").modules().size(), std::size_t{ean_13_modules});
    EXPECT_EQ(bars_of(Symbology::upc_e, "01234565").modules().size(), std::size_t{upc_e_modules});
    Bars two;
    EXPECT_EQ(encode_add_on(bytes_of("90"), two.view()), Status::ok);
    EXPECT_EQ(two.modules().size(), std::size_t{add_on_2_modules});
    Bars five;
    EXPECT_EQ(encode_add_on(bytes_of("52495"), five.view()), Status::ok);
    EXPECT_EQ(five.modules().size(), std::size_t{add_on_5_modules});
}

TEST(EanEncoder, UpcAIsAnEan13ThatBeginsWithZero) {
    EXPECT_EQ(bars_of(Symbology::upc_a, "023942431015").modules(),
              bars_of(Symbology::ean_13, "0023942431015").modules());
}

TEST(EanEncoder, RefusesWhatIsNoCodeAndLeavesTheList) {
    Bars bars;
    EXPECT_EQ(encode_ean_13(bytes_of("9780905705713"), bars.view()), Status::bad_argument);
    EXPECT_EQ(encode_ean_13(bytes_of("97809057057"), bars.view()), Status::bad_argument);
    EXPECT_EQ(encode_ean_13(bytes_of("97809057057A"), bars.view()), Status::bad_argument);
    EXPECT_EQ(encode_ean_8(bytes_of("55123458"), bars.view()), Status::bad_argument);
    EXPECT_EQ(encode_upc_a(bytes_of("1"), bars.view()), Status::bad_argument);
    EXPECT_EQ(encode_upc_e(bytes_of("2123456"), bars.view()), Status::bad_argument);
    EXPECT_EQ(encode_add_on(bytes_of("123"), bars.view()), Status::bad_argument);
    EXPECT_EQ(encode_add_on(bytes_of("1x"), bars.view()), Status::bad_argument);
    EXPECT_EQ(bars.count, 0);
    std::uint8_t room[58] = {};
    int count = 0;
    EXPECT_EQ(encode_ean_13(bytes_of("978090570571"), {room, 58, &count}), Status::buffer_too_small);
    EXPECT_EQ(count, 0);
}

}  // namespace
}  // namespace fovea::test
