// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>
#include <random>
#include <string>

#include <gtest/gtest.h>
#include <fovea/code/blur_paths.hpp>
#include <fovea/code/blur_scene.hpp>

#include "support/blurred_bars.hpp"

namespace fovea::detail {
namespace {

struct Seen {
    BlurLetters letters;
    LetterCosts costs;
    DigitPaths paths;
    LetterPaths letter_paths;
    std::int32_t darkness[most_blur_samples];
};
Seen& seen() {
    static Seen memory;
    return memory;
}

/// What digits look like, without their guards, and with noise.
void look(const BlurPlan& plan, const std::string& digits, Ratio blur, int noise, unsigned seed) {
    std::mt19937 random(seed);
    see_letters(blur, seen().letters);
    std::uint8_t values[1 + most_blur_letters] = {};
    for (std::size_t i = 0; i < digits.size(); ++i) {
        values[i + (plan.has_parity ? 0 : 1)] = static_cast<std::uint8_t>(digits[i] - '0');
    }
    std::uint8_t row[most_blur_letters];
    for (int i = 0; i < plan.letters; ++i) row[i] = static_cast<std::uint8_t>(letter_of(plan, values, i));
    darkness_of_letters(plan, seen().letters.module, row, seen().darkness);
    take_guards(plan, seen().letters.module, seen().darkness);
    for (int j = 0; j < plan.samples(); ++j) {
        if (noise > 0)
            seen().darkness[j] += static_cast<int>(random() % static_cast<unsigned>(2 * noise + 1)) - noise;
    }
    cost_letters(plan, seen().letters, seen().darkness, seen().costs);
}
std::string text(const BlurPlan& plan, const CheapestDigits& found) {
    std::string digits;
    for (int i = plan.has_parity ? 0 : 1; i <= plan.letters; ++i)
        digits += static_cast<char>('0' + found.digits[i]);
    return digits;
}

TEST(CheapestDigits, AreThoseThatAreSeenAndCostNothing) {
    std::mt19937 random(7);
    for (int i = 0; i < 40; ++i) {
        const std::string digits = test::with_check_digit(test::random_digits(random, 12));
        look(ean_13_plan, digits, Ratio::from_ratio(5 + i % 30, 10), 0, 1);
        const CheapestDigits found = cheapest_digits(ean_13_plan, seen().letters, seen().costs, seen().paths);
        EXPECT_EQ(text(ean_13_plan, found), digits);
        EXPECT_EQ(found.cost, 0);
        EXPECT_GT(found.second, 0);
        EXPECT_EQ(cheapest_letters(ean_13_plan, seen().letters, seen().costs, seen().letter_paths), 0);
        std::uint8_t row[most_blur_letters];
        trace_letters(ean_13_plan, seen().letters, seen().letter_paths, row);
        for (int place = 0; place < 12; ++place)
            EXPECT_EQ(row[place], letter_of(ean_13_plan, found.digits, place));
    }
}

TEST(CheapestDigits, AreTheCheapestOfAllTenMillion) {
    look(ean_8_plan, "96385074", Ratio::from_ratio(31, 10), 700, 3);
    const CheapestDigits found = cheapest_digits(ean_8_plan, seen().letters, seen().costs, seen().paths);
    // Every row of seven digits with its check digit, the first two on the outside so that their sum is made
    // once.
    std::int32_t best = no_path;
    std::int32_t second = no_path;
    const auto own = [&](int place, int digit) { return seen().costs.of[place][digit]; };
    const auto both = [&](int place, int left, int right) {
        return pair_cost(ean_8_plan, seen().letters, place, left, right);
    };
    for (int number = 0; number < 10000000; ++number) {
        int digit[8];
        int rest = number;
        int sum = 0;
        for (int i = 6; i >= 0; --i) {
            digit[i] = rest % 10;
            rest /= 10;
            sum += digit[i] * (i % 2 == 0 ? 3 : 1);
        }
        digit[7] = (10 - sum % 10) % 10;
        std::int32_t cost = seen().costs.nothing + own(0, digit[0]);
        for (int i = 1; i < 8; ++i) cost += own(i, digit[i]) + both(i - 1, digit[i - 1], digit[i]);
        if (cost < best) {
            second = best;
            best = cost;
        } else {
            second = std::min(second, cost);
        }
    }
    EXPECT_EQ(found.cost, best);
    EXPECT_EQ(found.second, second);
}

TEST(CheapestLetters, NeverCostMoreThanTheCheapestDigits) {
    std::mt19937 random(11);
    for (int i = 0; i < 60; ++i) {
        look(ean_13_plan, test::with_check_digit(test::random_digits(random, 12)), Ratio::from_ratio(20, 10),
             900, static_cast<unsigned>(random()));
        const std::int32_t least =
            cheapest_letters(ean_13_plan, seen().letters, seen().costs, seen().letter_paths);
        const CheapestDigits found = cheapest_digits(ean_13_plan, seen().letters, seen().costs, seen().paths);
        EXPECT_LE(least, found.cost);
        EXPECT_LT(found.cost, found.second);
        int sum = found.digits[0];
        for (int k = 0; k < 12; ++k) sum += found.digits[k + 1] * (k % 2 == 0 ? 3 : 1);
        EXPECT_EQ(sum % 10, 0);
    }
}

TEST(CostLetters, BearTheMostThatDarknessMayBe) {
    see_letters(Ratio::from_ratio(3, 10), seen().letters);
    for (const std::int32_t extreme : {-2 * full_darkness, 2 * full_darkness}) {
        std::fill_n(seen().darkness, most_blur_samples, extreme);
        cost_letters(ean_13_plan, seen().letters, seen().darkness, seen().costs);
        const CheapestDigits found = cheapest_digits(ean_13_plan, seen().letters, seen().costs, seen().paths);
        EXPECT_GT(found.cost, 0);
        EXPECT_GE(found.second, found.cost);
    }
}

}  // namespace
}  // namespace fovea::detail
