// SPDX-License-Identifier: MIT
//
// EAN symbols as a camera out of focus shows them: digits to a profile, by the integral of a disc over each
// module.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace fovea::test {

/// The modules of an EAN-13 or EAN-8, '1' dark, from its digits.
inline std::string ean_modules(const std::string& digits) {
    static const char* const set_a[10] = {"0001101", "0011001", "0010011", "0111101", "0100011",
                                          "0110001", "0101111", "0111011", "0110111", "0001011"};
    static const char* const parity[10] = {"AAAAAA", "AABABB", "AABBAB", "AABBBA", "ABAABB",
                                           "ABBAAB", "ABBBAA", "ABABAB", "ABABBA", "ABBABA"};
    const auto of_c = [](char digit) {
        std::string letter = set_a[digit - '0'];
        for (char& module : letter) module = module == '0' ? '1' : '0';
        return letter;
    };
    const bool of_13 = digits.size() == 13;
    const std::string tail = of_13 ? digits.substr(1) : digits;
    const std::size_t half = tail.size() / 2;
    std::string modules = "101";
    for (std::size_t i = 0; i < half; ++i) {
        const std::string c = of_c(tail[i]);
        const bool of_b = of_13 && parity[digits[0] - '0'][i] == 'B';
        modules += of_b ? std::string(c.rbegin(), c.rend()) : std::string(set_a[tail[i] - '0']);
    }
    modules += "01010";
    for (std::size_t i = half; i < tail.size(); ++i) modules += of_c(tail[i]);
    return modules + "101";
}

/// Digits with their check digit behind them.
inline std::string with_check_digit(const std::string& digits) {
    int sum = 0;
    for (std::size_t i = 0; i < digits.size(); ++i) {
        sum += (digits[digits.size() - 1 - i] - '0') * (i % 2 == 0 ? 3 : 1);
    }
    return digits + static_cast<char>('0' + (10 - sum % 10) % 10);
}
inline std::string random_digits(std::mt19937& random, int count) {
    std::string digits;
    for (int i = 0; i < count; ++i) digits += static_cast<char>('0' + random() % 10);
    return digits;
}

/// A camera over bars.
struct BarCamera {
    double module = 2;        ///< px
    double blur = 3;          ///< half of the width that an edge is spread over, px
    double margin = 20;       ///< px on both sides
    double bend = 0;          ///< perspective
    double white_left = 200;  ///< gray levels
    double white_right = 200;
    double dark = 0.7;  ///< the share of light that bars take
    double noise = 0;   ///< gray levels, standard deviation
    unsigned seed = 1;
};

/// The profile across modules, in 1/256 gray level.
inline std::vector<std::uint16_t> bar_profile(const std::string& modules, const BarCamera& camera) {
    const double length = camera.module * static_cast<double>(modules.size());
    const int size = static_cast<int>(std::ceil(length + 2 * camera.margin));
    std::mt19937 random(camera.seed);
    std::normal_distribution<double> noise(0, camera.noise > 0 ? camera.noise : 1);
    const auto left_of = [&](double place) {
        const double u = std::fmin(1, std::fmax(-1, place / camera.blur));
        return 0.5 + (u * std::sqrt(1 - u * u) + std::asin(u)) / std::acos(-1.0);
    };
    std::vector<std::uint16_t> profile;
    for (int x = 0; x < size; ++x) {
        double dark = 0;
        for (std::size_t k = 0; k < modules.size(); ++k) {
            if (modules[k] == '0') continue;
            const auto edge = [&](std::size_t at) {
                const double t = static_cast<double>(at) / static_cast<double>(modules.size());
                return camera.margin + length * (t + camera.bend * t * (t - 1));
            };
            dark += left_of(x - edge(k)) - left_of(x - edge(k + 1));
        }
        const double white = camera.white_left + (camera.white_right - camera.white_left) * x / size;
        const double level = white * (1 - camera.dark * dark) + (camera.noise > 0 ? noise(random) : 0);
        profile.push_back(static_cast<std::uint16_t>(std::fmin(255, std::fmax(0, level)) * 256));
    }
    return profile;
}

}  // namespace fovea::test
