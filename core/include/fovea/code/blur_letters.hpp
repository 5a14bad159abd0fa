// SPDX-License-Identifier: MIT
//
// The letters of EAN and UPC as a blurred picture shows them: what one sees of a letter, and of one beside
// another, where the light of every module reaches over its neighbours. Book ch. 5; ISO/IEC 15420, 4.2.
#pragma once

#include <cstdint>

#include <fovea/base/assert.hpp>
#include <fovea/code/ean_tables.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/integer.hpp>

namespace fovea::detail {

/// A module is seen in two samples, at a quarter and three quarters of it.
inline constexpr int blur_samples = 2;
/// Samples that light reaches beyond its module: blur is at most 3.5 modules to each side, so that a letter
/// of seven meets none but its neighbours.
inline constexpr int blur_reach = 7;
inline constexpr int module_response_size = blur_samples + 2 * blur_reach;
inline constexpr int letter_response_size = 7 * blur_samples + 2 * blur_reach;
/// Darkness 1, a bar without end.
inline constexpr std::int32_t full_darkness = 1024;

/// The share of a lens's disc that lies left of a place, 0 at -1 and 32768 at 1: 1/2 + (u sqrt(1 - u^2) +
/// asin u) / pi, at the 64ths from 0 to 1. It is how an edge looks that is out of focus.
inline constexpr std::uint16_t disc_shares[65] = {
    16384, 16710, 17036, 17361, 17687, 18012, 18337, 18661, 18985, 19308, 19630, 19952, 20272,
    20592, 20911, 21228, 21544, 21859, 22173, 22485, 22795, 23104, 23411, 23716, 24019, 24320,
    24619, 24916, 25210, 25502, 25792, 26078, 26362, 26643, 26920, 27195, 27466, 27734, 27998,
    28258, 28515, 28767, 29015, 29259, 29498, 29732, 29962, 30185, 30404, 30617, 30823, 31023,
    31217, 31403, 31582, 31753, 31915, 32068, 32211, 32344, 32464, 32570, 32660, 32730, 32768,
};

/// disc_shares at any place, linear between.
constexpr std::int32_t disc_share(Ratio place) {
    const std::int32_t far = place.raw() < 0 ? -place.raw() : place.raw();
    std::int32_t share = 32768;
    if (far < Ratio::one) {
        const int step = far >> 10;
        share = disc_shares[step] + ((disc_shares[step + 1] - disc_shares[step]) * (far & 1023) >> 10);
    }
    return place.raw() < 0 ? 32768 - share : share;
}

/// The three sets of ten letters: A and B left of the centre, C right of it. ISO/IEC 15420, table 1.
inline constexpr int letter_count = 30;
inline constexpr int first_c = 20;

/// ean_widths as modules. B is C from behind, C is A with its colours exchanged.
struct LetterModules {
    std::uint8_t of[letter_count];
};
constexpr LetterModules modules_of_letters() {
    LetterModules modules{};
    for (int digit = 0; digit < 10; ++digit) {
        unsigned a = 0;
        for (int run = 0; run < 4; ++run) {
            for (int i = 0; i < ean_widths[digit][run]; ++i) a = a << 1 | (run % 2 == 1 ? 1U : 0U);
        }
        const unsigned c = ~a & 0x7F;
        unsigned b = 0;
        for (int k = 0; k < 7; ++k) b |= (c >> k & 1) << (6 - k);
        modules.of[digit] = static_cast<std::uint8_t>(a);
        modules.of[10 + digit] = static_cast<std::uint8_t>(b);
        modules.of[first_c + digit] = static_cast<std::uint8_t>(c);
    }
    return modules;
}
inline constexpr LetterModules all_letter_modules = modules_of_letters();

/// Dark modules of a letter, its first module in bit 6.
constexpr unsigned letter_modules(int letter) {
    FOVEA_ASSERT(letter >= 0 && letter < letter_count);
    return all_letter_modules.of[letter];
}

/// Where the two bars of a letter begin and end, in its modules.
struct LetterBars {
    std::uint8_t at[4];
};
constexpr LetterBars bars_of_letter(int letter) {
    LetterBars bars{};
    unsigned before = 0;
    int found = 0;
    for (int k = 0; k <= 7; ++k) {
        const unsigned own = k < 7 ? letter_modules(letter) >> (6 - k) & 1 : 0;
        if (own != before) bars.at[found++] = static_cast<std::uint8_t>(k);
        before = own;
    }
    return bars;
}
struct LetterBarTable {
    LetterBars of[letter_count];
    constexpr LetterBars operator[](int letter) const { return of[letter]; }
};
inline constexpr LetterBarTable letter_bars = [] {
    LetterBarTable table{};
    for (int letter = 0; letter < letter_count; ++letter) table.of[letter] = bars_of_letter(letter);
    return table;
}();

/// Where the letters of a symbol stand.
struct BlurPlan {
    int modules;
    int letters;
    int left;         ///< letters left of the centre
    bool has_parity;  ///< these are of A or B, which tells a digit more; else of A

    constexpr int samples() const { return blur_samples * modules + 2 * blur_reach; }
    constexpr int centre() const { return 3 + 7 * left; }
    /// The first module of a letter.
    constexpr int first(int letter) const {
        return letter < left ? 3 + 7 * letter : centre() + 5 + 7 * (letter - left);
    }
    /// Letters that may stand at a place, and the first of them.
    constexpr int alphabet_size(int place) const { return place < left && has_parity ? 20 : 10; }
    constexpr int alphabet(int place) const { return place < left ? 0 : first_c; }
    /// The dark modules of the guards.
    constexpr int guard(int index) const {
        const int dark[6] = {0, 2, centre() + 1, centre() + 3, modules - 3, modules - 1};
        return dark[index];
    }
    static constexpr int guards = 6;
};
inline constexpr BlurPlan ean_13_plan{95, 12, 6, true};
inline constexpr BlurPlan ean_8_plan{67, 8, 4, false};
inline constexpr int most_blur_letters = 12;
inline constexpr int most_blur_samples = ean_13_plan.samples();

/// Darkness that a single dark module leaves in the samples from blur_reach before it.
struct ModuleResponse {
    std::int32_t at[module_response_size];
};

/// blur is the half of the width over which an edge is spread, in modules: 0.3 to 3.5.
inline ModuleResponse module_response(Ratio blur) {
    FOVEA_ASSERT(blur.raw() >= Ratio::one * 3 / 10 && blur.raw() <= Ratio::one * 7 / 2);
    ModuleResponse response{};
    const auto share = [blur](std::int64_t place) {
        const std::int64_t in_blurs = place * Ratio::one / blur.raw();
        return disc_share(Ratio::from_raw(
            static_cast<std::int32_t>(clamp<std::int64_t>(in_blurs, -Ratio::one, Ratio::one))));
    };
    for (int i = 0; i < module_response_size; ++i) {
        const std::int64_t place = std::int64_t{2 * (i - blur_reach) + 1} * Ratio::one / (2 * blur_samples);
        response.at[i] = round_shift(share(place) - share(place - Ratio::one), 5);
    }
    return response;
}

/// What is seen of each letter, and what two letters that meet have in common.
///
/// Darkness is a sum, so the squares between what is seen and what a row of letters would show come apart
/// into a part for each letter and one for each pair of neighbours: |z - sum T|^2 = |z|^2 + sum (|T|^2 - 2
/// zT) + sum 2 T T'.
struct BlurLetters {
    ModuleResponse module;
    std::int32_t energy[letter_count];                ///< |T|^2
    std::int32_t beside[letter_count][letter_count];  ///< 2 T T' of a letter and the next of its side
    std::int32_t across[first_c][10];                 ///< the same across the centre; the right one is of C
    std::int32_t most_beside;                         ///< the most of both
};

/// What is common of two single modules that lie so many modules apart: none beyond seven.
struct ModuleOverlaps {
    std::int32_t at[blur_reach + 1];
};
inline ModuleOverlaps module_overlaps(const ModuleResponse& module) {
    ModuleOverlaps overlaps{};
    for (int apart = 0; apart <= blur_reach; ++apart) {
        for (int i = blur_samples * apart; i < module_response_size; ++i)
            overlaps.at[apart] += module.at[i] * module.at[i - blur_samples * apart];
    }
    return overlaps;
}

/// T T' of a letter and any that begins so many modules behind it: before each module of that one, what is
/// common with those before it, in sum.
struct CommonDarkness {
    std::int32_t before[8];

    CommonDarkness(const ModuleOverlaps& overlaps, int letter, int distance) : before{} {
        const unsigned modules = letter_modules(letter);
        for (int l = 0; l < 7; ++l) {
            std::int32_t sum = 0;
            for (int k = 0; k < 7; ++k) {
                const int apart = distance + l - k < 0 ? k - l - distance : distance + l - k;
                if ((modules >> (6 - k) & 1) != 0 && apart <= blur_reach) sum += overlaps.at[apart];
            }
            before[l + 1] = before[l] + sum;
        }
    }
    std::int32_t with(int other) const {
        const LetterBars bars = letter_bars[other];
        return before[bars.at[1]] - before[bars.at[0]] + before[bars.at[3]] - before[bars.at[2]];
    }
};

inline void see_letters(Ratio blur, BlurLetters& letters) {
    letters.module = module_response(blur);
    letters.most_beside = 0;
    const ModuleOverlaps overlaps = module_overlaps(letters.module);
    for (int left = 0; left < letter_count; ++left) {
        letters.energy[left] = CommonDarkness(overlaps, left, 0).with(left);
        const CommonDarkness beside(overlaps, left, 7);
        const int first = left < first_c ? 0 : first_c;
        for (int right = first; right < (left < first_c ? first_c : letter_count); ++right) {
            letters.beside[left][right] = 2 * beside.with(right);
            letters.most_beside = maximum(letters.most_beside, letters.beside[left][right]);
        }
        if (left >= first_c) continue;
        const CommonDarkness across(overlaps, left, 7 + 5);
        for (int right = 0; right < 10; ++right) {
            letters.across[left][right] = 2 * across.with(first_c + right);
            letters.most_beside = maximum(letters.most_beside, letters.across[left][right]);
        }
    }
}

}  // namespace fovea::detail
