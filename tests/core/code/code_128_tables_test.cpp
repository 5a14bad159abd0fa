// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fovea/code/code_128_tables.hpp>

namespace fovea {
namespace {

TEST(Code128Tables, CharactersHaveElevenModulesAnEvenNumberOfThemDark) {
    for (const std::uint32_t widths : code_128_widths) {
        std::uint32_t all = 0;
        std::uint32_t dark = 0;
        for (int run = 0; run < 6; ++run) {
            const std::uint32_t width = widths >> (20 - 4 * run) & 15U;
            EXPECT_TRUE(width >= 1 && width <= 4);
            all += width;
            if (run % 2 == 0) dark += width;
        }
        EXPECT_EQ(all, 11U);
        EXPECT_EQ(dark % 2, 0U);
    }
}

TEST(Code128Tables, CharactersAreDifferent) {
    for (int i = 0; i < 106; ++i)
        for (int k = 0; k < i; ++k) EXPECT_NE(code_128_widths[i], code_128_widths[k]);
}

}  // namespace
}  // namespace fovea
