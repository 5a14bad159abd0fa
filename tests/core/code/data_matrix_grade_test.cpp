// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vector>

#include <fovea/code/data_matrix_grade.hpp>

namespace fovea::test {
namespace {

/// The grade of modules of 4 px whose values are given, with the ring around them as the image shows it.
CodeGrade grade_of(int dark, int light, int unused, std::uint8_t around) {
    const DataMatrixSize& size = data_matrix_sizes[0];
    std::vector<std::uint8_t> values(100);
    for (std::size_t i = 0; i < 100; ++i) values[i] = static_cast<std::uint8_t>(i % 3 == 0 ? dark : light);
    const std::vector<std::uint8_t> pixels(60 * 60, around);
    const detail::CodeField field(ImageView<const Gray8>(pixels.data(), {60, 60}, 60), false);
    const detail::SquareToQuad map({2560, 2560}, {12800, 2560}, {12800, 12800}, {2560, 12800});
    return detail::grade_data_matrix(field, map, size, {values.data(), 100}, unused);
}

TEST(DataMatrixGrade, FollowsTheTables) {
    const CodeGrade best = grade_of(0, 255, 100, 255);
    EXPECT_EQ(best.overall, 4);
    EXPECT_EQ(grade_of(0, 178, 100, 255).symbol_contrast, 3);  // 69 %
    EXPECT_EQ(grade_of(0, 140, 100, 255).symbol_contrast, 2);  // 54 %
    EXPECT_EQ(grade_of(0, 50, 100, 255).symbol_contrast, 0);   // 19 %
    EXPECT_EQ(grade_of(0, 255, 61, 255).unused_error_correction, 3);
    EXPECT_EQ(grade_of(0, 255, 24, 255).unused_error_correction, 0);
    EXPECT_EQ(grade_of(0, 255, 100, 0).quiet_zone, 0);
    EXPECT_EQ(grade_of(0, 255, 100, 0).overall, 0);
    EXPECT_EQ(best.decodability, CodeGrade::not_graded);
}

TEST(DataMatrixGrade, ModulesOfOneBrightnessAreNoContrast) {
    EXPECT_EQ(grade_of(80, 80, 100, 255).symbol_contrast, 0);
    EXPECT_EQ(grade_of(80, 80, 100, 255).modulation, 0);
}

}  // namespace
}  // namespace fovea::test
