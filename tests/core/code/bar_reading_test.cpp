// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fovea/code/bar_reading.hpp>

namespace fovea {
namespace {

TEST(BarReading, MatrixCodesAreNoBars) {
    EXPECT_TRUE(bar_symbologies().contains(Symbology::codabar));
    EXPECT_FALSE(bar_symbologies().contains(Symbology::qr));
    EXPECT_FALSE(bar_symbologies().contains(Symbology::data_matrix));
}

TEST(BarReading, LengthsOfInterleavedAreEvenAndInOrder) {
    const auto valid = [](int shortest, int longest) {
        BarRules rules;
        rules.interleaved_shortest = shortest;
        rules.interleaved_longest = longest;
        return is_valid(rules);
    };
    EXPECT_TRUE(is_valid(BarRules()));
    EXPECT_TRUE(valid(2, most_bar_text));
    EXPECT_TRUE(valid(14, 14));
    EXPECT_FALSE(valid(0, 8));
    EXPECT_FALSE(valid(5, 8));
    EXPECT_FALSE(valid(6, 7));
    EXPECT_FALSE(valid(8, 6));
    EXPECT_FALSE(valid(8, most_bar_text + 2));
}

}  // namespace
}  // namespace fovea
