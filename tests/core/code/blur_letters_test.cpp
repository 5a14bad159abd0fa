// SPDX-License-Identifier: MIT
#include <cmath>
#include <string>

#include <gtest/gtest.h>
#include <fovea/code/blur_letters.hpp>

#include "support/blurred_bars.hpp"

namespace fovea::detail {
namespace {

TEST(DiscShare, IsTheAreaOfADiscLeftOfALine) {
    for (int raw = -70000; raw <= 70000; raw += 7) {
        const double u = std::fmin(1, std::fmax(-1, raw / 65536.0));
        const double share = 0.5 + (u * std::sqrt(1 - u * u) + std::asin(u)) / std::acos(-1.0);
        // The chords of the table lie up to (1/64)^2 / 8 times the curvature off, which is large at the rim:
        // 10 of 32768.
        ASSERT_NEAR(disc_share(Ratio::from_raw(raw)), share * 32768, 10) << raw;
    }
    EXPECT_EQ(disc_share(Ratio::from_raw(0)), 16384);
    EXPECT_EQ(disc_share(Ratio::from_int(-1)), 0);
    EXPECT_EQ(disc_share(Ratio::from_int(1)), 32768);
}

TEST(LetterModules, AreThoseOfTheStandard) {
    EXPECT_EQ(letter_modules(0), 0x0DU);            // A 0: 0001101
    EXPECT_EQ(letter_modules(10), 0x27U);           // B 0: 0100111
    EXPECT_EQ(letter_modules(first_c), 0x72U);      // C 0: 1110010
    EXPECT_EQ(letter_modules(first_c + 9), 0x74U);  // C 9: 1110100
    // Set A, printed as modules.
    const unsigned set_a[10] = {0b0001101, 0b0011001, 0b0010011, 0b0111101, 0b0100011,
                                0b0110001, 0b0101111, 0b0111011, 0b0110111, 0b0001011};
    for (int digit = 0; digit < 10; ++digit) {
        EXPECT_EQ(letter_modules(digit), set_a[digit]) << digit;
        EXPECT_EQ(letter_modules(first_c + digit), set_a[digit] ^ 0x7FU) << digit;
        unsigned reversed = 0;
        for (int k = 0; k < 7; ++k) reversed = reversed << 1 | (letter_modules(first_c + digit) >> k & 1);
        EXPECT_EQ(letter_modules(10 + digit), reversed) << digit;
    }
    for (int letter = 0; letter < letter_count; ++letter) {
        int dark = 0;
        for (int k = 0; k < 7; ++k) dark += static_cast<int>(letter_modules(letter) >> k & 1);
        EXPECT_EQ(dark % 2, letter < 10 ? 1 : 0) << letter;
        EXPECT_LE(dark, 5);
    }
}

TEST(BlurPlan, HasItsLettersAndGuardsWhereTheModulesAre) {
    const std::string modules = test::ean_modules("9780905705712");
    // The book's own number, as it is printed there.
    EXPECT_EQ(
        modules,
        "10101110110001001010011100010110100111011000101010100010011100101001110100010011001101101100101");
    EXPECT_EQ(static_cast<int>(modules.size()), ean_13_plan.modules);
    EXPECT_EQ(static_cast<int>(test::ean_modules("96385074").size()), ean_8_plan.modules);
    for (const BlurPlan& plan : {ean_13_plan, ean_8_plan}) {
        EXPECT_EQ(plan.first(plan.left) - plan.first(plan.left - 1), 12);
        EXPECT_EQ(plan.first(plan.letters - 1) + 7, plan.modules - 3);
        EXPECT_EQ(plan.guard(2), plan.centre() + 1);
    }
    for (int i = 0; i < BlurPlan::guards; ++i) {
        EXPECT_EQ(modules[static_cast<std::size_t>(ean_13_plan.guard(i))], '1');
    }
}

TEST(ModuleResponse, IsAModuleOfDarknessHoweverItIsSpread) {
    for (int tenths = 3; tenths <= 35; ++tenths) {
        const ModuleResponse response = module_response(Ratio::from_ratio(tenths, 10));
        int sum = 0;
        for (const std::int32_t at : response.at) {
            EXPECT_GE(at, 0);
            EXPECT_LE(at, full_darkness);
            sum += at;
        }
        // Two samples a module; what lies between them is told to a hundredth where blur is wider than their
        // distance.
        EXPECT_NEAR(sum, blur_samples * full_darkness, tenths < 6 ? 40 : 25) << tenths;
        for (int i = 0; i < module_response_size; ++i) {
            EXPECT_EQ(response.at[i], response.at[module_response_size - 1 - i]) << tenths << ' ' << i;
        }
    }
}

/// Twice what two letters have in common that lie so many modules apart, sample by sample.
std::int32_t twice_common(const ModuleResponse& module, int left, int right, int apart) {
    std::int32_t seen[2][letter_response_size + 24] = {};
    for (int which = 0; which < 2; ++which) {
        const unsigned modules = letter_modules(which == 0 ? left : right);
        for (int k = 0; k < 7; ++k) {
            const int at = blur_samples * (k + which * apart);
            if ((modules >> (6 - k) & 1) == 0) continue;
            for (int i = 0; i < module_response_size; ++i) seen[which][at + i] += module.at[i];
        }
    }
    std::int32_t sum = 0;
    for (int j = 0; j < letter_response_size + 24; ++j) sum += seen[0][j] * seen[1][j];
    return 2 * sum;
}

TEST(SeeLetters, SquaresOfARowComeApartIntoLettersAndPairs) {
    static BlurLetters letters;
    for (const int tenths : {3, 6, 15, 27, 35}) {
        see_letters(Ratio::from_ratio(tenths, 10), letters);
        std::int32_t most = 0;
        for (int left = 0; left < letter_count; ++left) {
            EXPECT_EQ(2 * letters.energy[left], twice_common(letters.module, left, left, 0)) << left;
            for (int right = left < first_c ? 0 : first_c; right < (left < first_c ? first_c : letter_count);
                 ++right) {
                EXPECT_EQ(letters.beside[left][right], twice_common(letters.module, left, right, 7))
                    << left << ' ' << right;
                most = maximum(most, letters.beside[left][right]);
            }
            for (int right = 0; left < first_c && right < 10; ++right) {
                EXPECT_EQ(letters.across[left][right],
                          twice_common(letters.module, left, first_c + right, 12))
                    << left << ' ' << right;
                most = maximum(most, letters.across[left][right]);
            }
        }
        EXPECT_EQ(letters.most_beside, most) << tenths;
    }
}

TEST(LetterBars, AreTheDarkModules) {
    for (int letter = 0; letter < letter_count; ++letter) {
        const LetterBars bars = letter_bars[letter];
        unsigned modules = 0;
        for (int k = 0; k < 7; ++k) {
            const bool dark = (k >= bars.at[0] && k < bars.at[1]) || (k >= bars.at[2] && k < bars.at[3]);
            modules = modules << 1 | (dark ? 1U : 0U);
        }
        EXPECT_EQ(modules, letter_modules(letter)) << letter;
    }
}

}  // namespace
}  // namespace fovea::detail
