// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fovea/code/code_39.hpp>

namespace fovea {
namespace {

TEST(Code39, EveryCharacterHasThreeWideElements) {
    EXPECT_EQ(__builtin_popcount(code_39_asterisk), 3);
    for (int i = 0; i < code_39_count; ++i) {
        EXPECT_EQ(__builtin_popcount(code_39_wide[i]), 3);
        EXPECT_NE(code_39_wide[i], code_39_asterisk);
        for (int k = 0; k < i; ++k) EXPECT_NE(code_39_wide[i], code_39_wide[k]);
    }
}

TEST(Code39, ValuesAndCharactersAreInverse) {
    for (int i = 0; i < code_39_count; ++i) EXPECT_EQ(code_39_value(code_39_characters[i]), i);
    EXPECT_EQ(code_39_value('*'), -1);
    EXPECT_EQ(code_39_value('a'), -1);
}

TEST(Code39, PairsStandForAllOfAscii) {
    for (int ascii = 0; ascii < 128; ++ascii) {
        const Code39Pair pair = code_39_pair(ascii);
        EXPECT_GE(code_39_value(pair.second), 0) << ascii;
        EXPECT_EQ(pair.first == 0 ? pair.second : code_39_ascii(pair.first, pair.second), ascii);
    }
    EXPECT_EQ(code_39_ascii('+', 'A'), 'a');
    EXPECT_EQ(code_39_ascii('$', 'M'), 13);
    EXPECT_EQ(code_39_ascii('%', 'T'), 127);
    EXPECT_EQ(code_39_ascii('%', 'Z'), 127);
    EXPECT_EQ(code_39_ascii('/', 'P'), -1);
}

}  // namespace
}  // namespace fovea
