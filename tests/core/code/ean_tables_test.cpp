// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fovea/code/ean_tables.hpp>

namespace fovea {
namespace {

TEST(EanTables, EveryDigitHasSevenModulesAndAnOddNumberOfDarkOnesInSetA) {
    for (const auto& widths : ean_widths) {
        EXPECT_EQ(widths[0] + widths[1] + widths[2] + widths[3], 7);
        EXPECT_EQ((widths[1] + widths[3]) % 2, 1);
    }
}

TEST(EanTables, ParitiesAreDifferentAndOfThreeSignsInSetB) {
    for (int i = 0; i < 10; ++i) {
        EXPECT_EQ(__builtin_popcount(ean_13_parity[i]), i == 0 ? 0 : 3);
        EXPECT_EQ(__builtin_popcount(upc_e_parity[i]), 3);
        EXPECT_EQ(__builtin_popcount(add_on_5_parity[i]), 2);
        for (int k = 0; k < i; ++k) {
            EXPECT_NE(ean_13_parity[i], ean_13_parity[k]);
            EXPECT_NE(upc_e_parity[i], upc_e_parity[k]);
            EXPECT_NE(add_on_5_parity[i], add_on_5_parity[k]);
        }
    }
}

TEST(EanTables, CheckDigitOfTheBooksIsbn) {
    const std::uint8_t digits[] = {9, 7, 8, 0, 9, 0, 5, 7, 0, 5, 7, 1};
    EXPECT_EQ(ean_check_digit(digits), 2);
}

TEST(EanTables, CheckValueOfAnAddOn) {
    // 3 * (5 + 4 + 5) + 9 * (2 + 9) = 141
    const std::uint8_t digits[] = {5, 2, 4, 9, 5};
    EXPECT_EQ(add_on_5_check(digits), 1);
}

void expect_upc_a(const std::uint8_t (&upc_e)[8], const std::uint8_t (&expected)[12]) {
    std::uint8_t upc_a[12] = {};
    upc_a_of_upc_e(upc_e, upc_a);
    for (int i = 0; i < 12; ++i) EXPECT_EQ(upc_a[i], expected[i]) << i;
}

TEST(EanTables, LastDigitOfUpcETellsWhereItsZerosStood) {
    expect_upc_a({0, 1, 2, 3, 4, 5, 2, 9}, {0, 1, 2, 2, 0, 0, 0, 0, 3, 4, 5, 9});
    expect_upc_a({0, 1, 2, 3, 4, 5, 3, 9}, {0, 1, 2, 3, 0, 0, 0, 0, 0, 4, 5, 9});
    expect_upc_a({0, 1, 2, 3, 4, 5, 4, 9}, {0, 1, 2, 3, 4, 0, 0, 0, 0, 0, 5, 9});
    expect_upc_a({1, 1, 2, 3, 4, 5, 6, 9}, {1, 1, 2, 3, 4, 5, 0, 0, 0, 0, 6, 9});
}

}  // namespace
}  // namespace fovea
