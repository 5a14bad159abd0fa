// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>

#include "qr_scene.hpp"

namespace fovea::test {
namespace {

CodeGrade grade_of_scene(const QrScene& scene) {
    const QrAnswer answer = read_scene(scene);
    EXPECT_EQ(answer.codes.size(), 1U);
    return answer.codes.empty() ? CodeGrade() : answer.codes[0].grade;
}

TEST(QrGrade, ContrastFallsInTheStepsOfTheStandard) {
    const int contrast[5] = {30, 75, 120, 160, 200};
    for (int grade = 0; grade < 5; ++grade) {
        QrScene scene(150, 150, 30 + contrast[grade]);
        scene.draw(DrawnQr("contrast"), {75, 75, 5, 0, 0, 0, false}, 30);
        EXPECT_EQ(grade_of_scene(scene).symbol_contrast, grade);
    }
}

TEST(QrGrade, ABlurTakesModulation) {
    int last = 4;
    for (const double sigma : {0.5, 1.5, 2.5}) {
        QrScene scene(160, 160);
        scene.draw(DrawnQr("modulation"), {80, 80, 5, 0, 0, 0, false});
        scene.blur(sigma);
        const CodeGrade grade = grade_of_scene(scene);
        EXPECT_LE(grade.modulation, last);
        last = grade.modulation;
        EXPECT_LE(grade.overall, grade.modulation);
    }
    EXPECT_LT(last, 4);
}

TEST(QrGrade, TheQuietZoneCountsItsModules) {
    for (int modules = 0; modules <= 4; ++modules) {
        const double side = 21 * 5 + 2 * 5 * modules;
        QrScene scene(200, 200, 220);
        scene.for_each([&](int x, int y, double& value) {
            const double away = std::max(std::abs(x - 99.5), std::abs(y - 99.5));
            if (away > side / 2) value = (x / 3 + y / 3) % 2 == 0 ? 30 : 220;
        });
        scene.draw(DrawnQr("quiet"), {99.5, 99.5, 5, 0, 0, 0, false});
        EXPECT_EQ(grade_of_scene(scene).quiet_zone, modules);
    }
}

TEST(QrGrade, LimitsAreAtLeast) {
    EXPECT_EQ(detail::grade_of(70, 70, 55, 40, 20), 4);
    EXPECT_EQ(detail::grade_of(69, 70, 55, 40, 20), 3);
    EXPECT_EQ(detail::grade_of(19, 70, 55, 40, 20), 0);
}

}  // namespace
}  // namespace fovea::test
