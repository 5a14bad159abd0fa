// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>
#include <limits>
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

/// Darkness of no letters at all, as much of it as the most that is seen.
void look_at_noise(const BlurPlan& plan, Ratio blur, std::int32_t most, std::mt19937& random) {
    see_letters(blur, seen().letters);
    std::uniform_int_distribution<std::int32_t> at(-most, most);
    for (std::int32_t& darkness : seen().darkness) darkness = at(random);
    cost_letters(plan, seen().letters, seen().darkness, seen().costs);
}

TEST(CheapestLetters, AreTheCheapestOfAllRowsInAnyBlur) {
    std::mt19937 random(12);
    for (const BlurPlan& plan : {ean_13_plan, ean_8_plan}) {
        for (int i = 0; i < 60; ++i) {
            look_at_noise(plan, Ratio::from_ratio(3 + i % 33, 10), i % 2 == 0 ? 300 : 2 * full_darkness,
                          random);
            // Without leaving anything out.
            std::int32_t to[2][first_c] = {};
            for (int own = 0; own < plan.alphabet_size(0); ++own) to[0][own] = seen().costs.of[0][own];
            for (int place = 1; place < plan.letters; ++place) {
                for (int own = 0; own < plan.alphabet_size(place); ++own) {
                    std::int32_t best = std::numeric_limits<std::int32_t>::max();
                    for (int before = 0; before < plan.alphabet_size(place - 1); ++before) {
                        best = std::min(best, to[(place - 1) % 2][before] +
                                                  pair_cost(plan, seen().letters, place - 1, before, own));
                    }
                    to[place % 2][own] = best + seen().costs.of[place][own];
                }
            }
            const std::int32_t* last = to[(plan.letters - 1) % 2];
            const std::int32_t least =
                *std::min_element(last, last + plan.alphabet_size(plan.letters - 1)) + seen().costs.nothing;
            EXPECT_EQ(cheapest_letters(plan, seen().letters, seen().costs, seen().letter_paths), least) << i;
            EXPECT_LE(least_letters(plan, seen().costs), least) << i;
        }
    }
}

TEST(CheapestDigits, AreThoseOfTheCheapestFirstDigit) {
    std::mt19937 random(13);
    for (int i = 0; i < 60; ++i) {
        look_at_noise(ean_13_plan, Ratio::from_ratio(3 + i % 33, 10), i % 2 == 0 ? 300 : 2 * full_darkness,
                      random);
        const CheapestDigits found = cheapest_digits(ean_13_plan, seen().letters, seen().costs, seen().paths);
        std::int32_t best[10];
        DigitSearch search(ean_13_plan, seen().letters, seen().costs, seen().paths);
        for (int first = 0; first < 10; ++first) {
            search.choose(first);
            best[first] = search.forward() + seen().costs.nothing;
            EXPECT_LE(search.least() + seen().costs.nothing, best[first]) << i << ' ' << first;
        }
        EXPECT_EQ(found.cost, *std::min_element(best, best + 10)) << i;
        EXPECT_EQ(found.cost, best[found.digits[0]]) << i;
        search.choose(found.digits[0]);
        EXPECT_EQ(search.forward() + seen().costs.nothing, found.cost) << i;
        std::int32_t second = search.second_to(found.digits) + seen().costs.nothing;
        for (int first = 0; first < 10; ++first)
            if (first != found.digits[0]) second = std::min(second, best[first]);
        EXPECT_EQ(found.second, second) << i;
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
