// SPDX-License-Identifier: MIT
//
// Which letters a blurred EAN or UPC shows: the row of letters whose picture comes closest to what is seen,
// of all that there are, by dynamic programming over neighbours. Book ch. 5; ISO/IEC 15420, 4.2 and annex A.
#pragma once

#include <cstdint>
#include <limits>

#include <fovea/base/assert.hpp>
#include <fovea/code/blur_letters.hpp>
#include <fovea/code/ean_tables.hpp>

namespace fovea::detail {

/// What each letter costs at each place: |T|^2 - 2 zT.
struct LetterCosts {
    std::int32_t of[most_blur_letters][first_c];
    std::int32_t nothing;  ///< |z|^2, what no letter at all costs
};

/// Costs of the letters for the darkness seen, without that of the guards, within +-2 full_darkness.
///
/// Bounds  a letter has at most 5 dark modules, whose response is full_darkness in sum a sample: |2 zT| <= 2
///         * 2048 * 10240 < 2^26, |T|^2 and 2 TT' < 2^25; |z|^2 < 204 * 2^22; so 12 letters with all of
///         theirs stay below 2^31
inline void cost_letters(const BlurPlan& plan, const BlurLetters& letters, const std::int32_t* darkness,
                         LetterCosts& costs) {
    // Of 16 bits, which vectors multiply and add at once.
    std::int16_t seen[most_blur_samples];
    std::int16_t module[module_response_size];
    costs.nothing = 0;
    for (int j = 0; j < plan.samples(); ++j) {
        seen[j] = static_cast<std::int16_t>(darkness[j]);
        costs.nothing += darkness[j] * darkness[j];
    }
    for (int i = 0; i < module_response_size; ++i)
        module[i] = static_cast<std::int16_t>(letters.module.at[i]);
    for (int place = 0; place < plan.letters; ++place) {
        // A letter is the sum of its modules, so that zT is one over its dark modules: for each of two bars
        // that of all before its end less that of all before its beginning.
        std::int32_t before[8] = {};
        for (int k = 0; k < 7; ++k) {
            const std::int16_t* at = seen + blur_samples * (plan.first(place) + k);
            std::int32_t sum = 0;
            for (int i = 0; i < module_response_size; ++i) sum += at[i] * module[i];
            before[k + 1] = before[k] + sum;
        }
        for (int i = 0; i < plan.alphabet_size(place); ++i) {
            const int letter = plan.alphabet(place) + i;
            const LetterBars bars = letter_bars[letter];
            const std::int32_t sum =
                before[bars.at[1]] - before[bars.at[0]] + before[bars.at[3]] - before[bars.at[2]];
            costs.of[place][i] = letters.energy[letter] - 2 * sum;
        }
    }
}

/// What two letters cost more together, one at place and one behind it; both as indices into the alphabets
/// there.
constexpr std::int32_t pair_cost(const BlurPlan& plan, const BlurLetters& letters, int place, int left,
                                 int right) {
    if (place + 1 == plan.left) {
        FOVEA_ASSERT(right < 10);
        return letters.across[left][right % 10];
    }
    const int alphabet = plan.alphabet(place);
    return letters.beside[alphabet + left][alphabet + right];
}

/// What it costs to come to each letter at each place, by the cheapest letters before it.
struct LetterPaths {
    std::int32_t to[most_blur_letters][first_c];
};

/// The cost of the cheapest row of letters, whatever parity and check digit say: what a place in the image, a
/// size and a blur are compared by. Never above the cost of the cheapest digits.
inline std::int32_t cheapest_letters(const BlurPlan& plan, const BlurLetters& letters,
                                     const LetterCosts& costs, LetterPaths& paths) {
    for (int i = 0; i < plan.alphabet_size(0); ++i) paths.to[0][i] = costs.of[0][i];
    for (int place = 1; place < plan.letters; ++place) {
        const int count = plan.alphabet_size(place);
        const int first = plan.alphabet(place);
        std::int32_t* to = paths.to[place];
        for (int right = 0; right < count; ++right) to[right] = std::numeric_limits<std::int32_t>::max();
        std::int32_t cheapest = paths.to[place - 1][0];
        for (int left = 1; left < plan.alphabet_size(place - 1); ++left) {
            cheapest = minimum(cheapest, paths.to[place - 1][left]);
        }
        for (int left = 0; left < plan.alphabet_size(place - 1); ++left) {
            const std::int32_t before = paths.to[place - 1][left];
            // Not better than the cheapest letter before, whatever these have in common.
            if (before > cheapest + letters.most_beside) continue;
            const std::int32_t* both = place == plan.left
                                           ? letters.across[left]
                                           : letters.beside[plan.alphabet(place - 1) + left] + first;
            for (int right = 0; right < count; ++right) to[right] = minimum(to[right], before + both[right]);
        }
        for (int right = 0; right < count; ++right) to[right] += costs.of[place][right];
    }
    const std::int32_t* last = paths.to[plan.letters - 1];
    std::int32_t best = last[0];
    for (int i = 1; i < plan.alphabet_size(plan.letters - 1); ++i) best = minimum(best, last[i]);
    return costs.nothing + best;
}
/// The most that cheapest_letters() surely is not below: what letters have in common is no less than 0.
inline std::int32_t least_letters(const BlurPlan& plan, const LetterCosts& costs) {
    std::int32_t sum = costs.nothing;
    for (int place = 0; place < plan.letters; ++place) {
        std::int32_t least = costs.of[place][0];
        for (int i = 1; i < plan.alphabet_size(place); ++i) least = minimum(least, costs.of[place][i]);
        sum += least;
    }
    return sum;
}
/// The row of letters that cheapest_letters() found.
inline void trace_letters(const BlurPlan& plan, const BlurLetters& letters, const LetterPaths& paths,
                          std::uint8_t (&row)[most_blur_letters]) {
    int right = -1;
    for (int place = plan.letters - 1; place >= 0; --place) {
        const auto cost = [&](int left) {
            return paths.to[place][left] + (right < 0 ? 0 : pair_cost(plan, letters, place, left, right));
        };
        int best = 0;
        for (int left = 1; left < plan.alphabet_size(place); ++left) {
            if (cost(left) < cost(best)) best = left;
        }
        row[place] = static_cast<std::uint8_t>(plan.alphabet(place) + best);
        right = best;
    }
}

/// The digits that come closest, and how much closer they are than any others whose check digit is right.
struct CheapestDigits {
    std::int32_t cost = 0;
    std::int32_t second = 0;                          ///< the cost of the next best
    std::uint8_t digits[1 + most_blur_letters] = {};  ///< with the first of EAN-13 in front, else 0
};

/// Memory of cheapest_digits(): what it costs to come to a digit with a sum of all before, and to end from
/// there.
struct DigitPaths {
    std::int32_t to[most_blur_letters][10][10];
    std::int32_t from[most_blur_letters][10][10];
};

/// A sum that no digits lead to.
inline constexpr std::int32_t no_path = std::numeric_limits<std::int32_t>::max();

/// The digits of one first digit: ten at each place.
class DigitSearch {
public:
    DigitSearch(const BlurPlan& plan, const BlurLetters& letters, const LetterCosts& costs, DigitPaths& paths)
        : plan_(plan), letters_(letters), costs_(costs), paths_(paths) {}

    void choose(int first_digit) { first_digit_ = first_digit; }

    /// The cost of the cheapest digits, whatever their check digit: not above that of forward().
    std::int32_t least() const {
        std::int32_t to[10];
        for (int digit = 0; digit < 10; ++digit) to[digit] = own(0, digit);
        for (int place = 1; place < plan_.letters; ++place) {
            std::int32_t next[10];
            for (std::int32_t& cost : next) cost = no_path;
            for (int before = 0; before < 10; ++before) {
                const std::int32_t* both = pairs(place - 1, before);
                for (int digit = 0; digit < 10; ++digit)
                    next[digit] = minimum(next[digit], to[before] + both[digit]);
            }
            for (int digit = 0; digit < 10; ++digit) to[digit] = next[digit] + own(place, digit);
        }
        std::int32_t best = to[0];
        for (const std::int32_t cost : to) best = minimum(best, cost);
        return best;
    }

    /// The cost of the cheapest digits that end with a right check digit.
    std::int32_t forward() {
        for (int digit = 0; digit < 10; ++digit) {
            for (std::int32_t& cost : paths_.to[0][digit]) cost = no_path;
            paths_.to[0][digit][(first_digit_ + weight(0) * digit) % 10] = own(0, digit);
        }
        for (int place = 1; place < plan_.letters; ++place) {
            for (int digit = 0; digit < 10; ++digit) reach(place, digit);
        }
        std::int32_t best = no_path;
        for (int digit = 0; digit < 10; ++digit) best = minimum(best, paths_.to[last()][digit][0]);
        return best;
    }
    /// The digits that forward() found.
    void trace(std::uint8_t (&digits)[1 + most_blur_letters]) const {
        digits[0] = static_cast<std::uint8_t>(first_digit_);
        int digit = 0;
        for (int other = 1; other < 10; ++other) {
            if (paths_.to[last()][other][0] < paths_.to[last()][digit][0]) digit = other;
        }
        int sum = 0;
        for (int place = last(); place > 0; --place) {
            digits[place + 1] = static_cast<std::uint8_t>(digit);
            sum = floor_modulo(sum - weight(place) * digit, 10);
            int best = 0;
            for (int before = 1; before < 10; ++before) {
                if (step(place, before, digit, sum) < step(place, best, digit, sum)) best = before;
            }
            digit = best;
        }
        digits[1] = static_cast<std::uint8_t>(digit);
    }
    /// The cost of the cheapest digits of which at least one is another than those given, after forward().
    std::int32_t second_to(const std::uint8_t (&digits)[1 + most_blur_letters]) {
        backward();
        std::int32_t best = no_path;
        for (int place = 0; place < plan_.letters; ++place) {
            for (int digit = 0; digit < 10; ++digit) {
                if (digit == digits[place + 1]) continue;
                for (int sum = 0; sum < 10; ++sum) {
                    const std::int32_t to = paths_.to[place][digit][sum];
                    const std::int32_t from = paths_.from[place][digit][sum];
                    if (to != no_path && from != no_path) best = minimum(best, to + from);
                }
            }
        }
        return best;
    }

private:
    int last() const { return plan_.letters - 1; }
    /// Of the check digit: the last digit counts once, from there 3 and 1 in turn; the first of EAN-13 once.
    static constexpr int weight(int place) { return place % 2 == 0 ? 3 : 1; }
    /// A digit as an index into the alphabet of its place.
    int letter(int place, int digit) const {
        if (place >= plan_.left || !plan_.has_parity) return digit;
        return (ean_13_parity[first_digit_] >> (plan_.left - 1 - place) & 1) != 0 ? 10 + digit : digit;
    }
    std::int32_t own(int place, int digit) const { return costs_.of[place][letter(place, digit)]; }
    std::int32_t pair(int place, int left, int right) const {
        return pair_cost(plan_, letters_, place, letter(place, left), letter(place + 1, right));
    }
    /// pair() of a digit with each of the ten that may follow it.
    const std::int32_t* pairs(int place, int left) const {
        const int own = letter(place, left);
        if (place + 1 == plan_.left) return letters_.across[own];
        const int alphabet = plan_.alphabet(place);
        return letters_.beside[alphabet + own] + alphabet + letter(place + 1, 0);
    }
    std::int32_t step(int place, int before, int digit, int sum_before) const {
        const std::int32_t to = paths_.to[place - 1][before][sum_before];
        return to == no_path ? no_path : to + pair(place - 1, before, digit);
    }
    void reach(int place, int digit) {
        std::int32_t best[10];
        for (std::int32_t& cost : best) cost = no_path;
        for (int before = 0; before < 10; ++before) {
            const std::int32_t both = pair(place - 1, before, digit);
            for (int sum = 0; sum < 10; ++sum) {
                const std::int32_t to = paths_.to[place - 1][before][sum];
                if (to != no_path) best[sum] = minimum(best[sum], to + both);
            }
        }
        for (int sum = 0; sum < 10; ++sum) {
            const int with = (sum + weight(place) * digit) % 10;
            paths_.to[place][digit][with] = best[sum] == no_path ? no_path : best[sum] + own(place, digit);
        }
    }
    void backward() {
        for (int digit = 0; digit < 10; ++digit) {
            for (int sum = 0; sum < 10; ++sum) paths_.from[last()][digit][sum] = sum == 0 ? 0 : no_path;
        }
        for (int place = last() - 1; place >= 0; --place) {
            for (int digit = 0; digit < 10; ++digit) {
                for (int sum = 0; sum < 10; ++sum)
                    paths_.from[place][digit][sum] = end_from(place, digit, sum);
            }
        }
    }
    std::int32_t end_from(int place, int digit, int sum) const {
        std::int32_t best = no_path;
        for (int next = 0; next < 10; ++next) {
            const std::int32_t from = paths_.from[place + 1][next][(sum + weight(place + 1) * next) % 10];
            if (from != no_path) best = minimum(best, pair(place, digit, next) + own(place + 1, next) + from);
        }
        return best;
    }

    const BlurPlan& plan_;
    const BlurLetters& letters_;
    const LetterCosts& costs_;
    DigitPaths& paths_;
    int first_digit_ = 0;
};

/// The cheapest digits of all whose parity and check digit are right; exact.
inline CheapestDigits cheapest_digits(const BlurPlan& plan, const BlurLetters& letters,
                                      const LetterCosts& costs, DigitPaths& paths) {
    DigitSearch search(plan, letters, costs, paths);
    const int first_digits = plan.has_parity ? 10 : 1;
    // The likeliest first digit comes first: of the others those are left out that are surely worse than the
    // next best.
    std::int32_t best[10];
    std::int32_t least[10];
    for (int first = 0; first < first_digits; ++first) {
        search.choose(first);
        least[first] = search.least();
        best[first] = no_path;
    }
    std::int32_t cheapest = no_path;
    std::int32_t next = no_path;
    for (int tried = 0; tried < first_digits; ++tried) {
        int first = 0;
        for (int other = 1; other < first_digits; ++other)
            if (least[other] < least[first]) first = other;
        if (least[first] > next) break;
        search.choose(first);
        best[first] = search.forward();
        least[first] = no_path;
        next = minimum(next, maximum(cheapest, best[first]));
        cheapest = minimum(cheapest, best[first]);
    }
    int chosen = 0;
    for (int first = 1; first < first_digits; ++first)
        if (best[first] < best[chosen]) chosen = first;
    search.choose(chosen);
    CheapestDigits found;
    found.cost = costs.nothing + search.forward();
    search.trace(found.digits);
    std::int32_t second = search.second_to(found.digits);
    for (int first = 0; first < first_digits; ++first) {
        if (first != chosen) second = minimum(second, best[first]);
    }
    found.second = costs.nothing + second;
    return found;
}

}  // namespace fovea::detail
