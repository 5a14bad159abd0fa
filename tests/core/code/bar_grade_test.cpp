// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vector>

#include <fovea/code/bar_grade.hpp>

namespace fovea {
namespace {

/// Ten bars of two samples and spaces of three, of the levels given.
CodeGrade grade(int dark, int light, int shallow, int error, int quiet) {
    std::vector<std::int16_t> profile;
    std::vector<BarTurn> turns;
    const auto add = [&](int level, int samples) {
        turns.push_back({static_cast<std::int32_t>(profile.size()) + samples / 2, level * 16});
        for (int i = 0; i < samples; ++i) profile.push_back(static_cast<std::int16_t>(level * 16));
    };
    add(light, 20);
    for (int i = 0; i < 10; ++i) {
        add(i == 5 ? shallow : dark, 2);
        add(light, i == 9 ? 20 : 3);
    }
    BarReading reading;
    reading.error = error;
    reading.quiet = quiet;
    return grade_bars({profile.data(), static_cast<std::ptrdiff_t>(profile.size())},
                      {turns.data(), static_cast<std::ptrdiff_t>(turns.size())}, 20, 67, reading);
}

TEST(BarGrade, APerfectCodeIsAnA) {
    const CodeGrade perfect = grade(10, 240, 10, 10, 256);
    EXPECT_EQ(perfect.overall, 4);
    EXPECT_EQ(perfect.symbol_contrast, 4);
    EXPECT_EQ(perfect.modulation, 4);
    EXPECT_EQ(perfect.decodability, 4);
    EXPECT_EQ(perfect.quiet_zone, 4);
    EXPECT_EQ(perfect.unused_error_correction, CodeGrade::not_graded);
}

TEST(BarGrade, EachPartHasTheLimitsOfTheStandard) {
    EXPECT_EQ(grade(0, 179, 0, 0, 256).symbol_contrast, 4);      // 70.2 %
    EXPECT_EQ(grade(0, 178, 0, 0, 256).symbol_contrast, 3);      // 69.8 %
    EXPECT_EQ(grade(100, 150, 100, 0, 256).symbol_contrast, 0);  // 19.6 %
    EXPECT_EQ(grade(0, 200, 60, 0, 256).modulation, 4);
    EXPECT_EQ(grade(0, 200, 61, 0, 256).modulation, 3);
    EXPECT_EQ(grade(0, 200, 121, 0, 256).modulation, 0);
    EXPECT_EQ(grade(0, 200, 0, 64, 256).decodability, 3);
    EXPECT_EQ(grade(0, 200, 0, 200, 256).decodability, 0);
    EXPECT_EQ(grade(0, 200, 0, 0, 128).quiet_zone, 2);
    EXPECT_EQ(grade(0, 200, 0, 0, 128).overall, 2);
}

TEST(BarGrade, WithoutTurnsThereIsNone) {
    EXPECT_EQ(grade_bars({}, {}, 0, 100, {}).overall, CodeGrade::not_graded);
}

}  // namespace
}  // namespace fovea
