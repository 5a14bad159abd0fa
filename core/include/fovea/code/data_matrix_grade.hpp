// SPDX-License-Identifier: MIT
//
// How well a Data Matrix is printed and seen.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/code/code.hpp>
#include <fovea/code/data_matrix_corners.hpp>
#include <fovea/code/data_matrix_grid.hpp>
#include <fovea/code/data_matrix_lines.hpp>
#include <fovea/code/data_matrix_sizes.hpp>
#include <fovea/number/integer.hpp>

namespace fovea::detail {

/// Grades of a symbol from the brightness of its modules, 0 to 255, and of the ring of a module around it.
///
/// Source  ISO/IEC 15415, 7.8, tables 3 to 6. Modulation by modules, of which a twentieth may be worse, in
///         place of codewords; the quiet zone by how much of its ring is light
inline CodeGrade grade_data_matrix(const CodeField& field, const SquareToQuad& map,
                                   const DataMatrixSize& size, Span<const std::uint8_t> values,
                                   int unused_correction);

constexpr std::int8_t step_grade(int value, int a, int b, int c, int d) {
    return static_cast<std::int8_t>(value >= a ? 4 : value >= b ? 3 : value >= c ? 2 : value >= d ? 1 : 0);
}
/// By how much of the ring of a module around the symbol is light.
inline std::int8_t quiet_zone_grade(const CodeField& field, const SquareToQuad& map,
                                    const DataMatrixSize& size, int threshold) {
    int light = 0;
    int all = 0;
    const auto look = [&](int x, int y) {
        const EdgePlace p = map(module_middle(x, size.columns), module_middle(y, size.rows));
        ++all;
        light += field.sample(p.x, p.y) > 16 * threshold ? 1 : 0;
    };
    for (int x = -1; x <= size.columns; ++x) {
        look(x, -1);
        look(x, size.rows);
    }
    for (int y = 0; y < size.rows; ++y) {
        look(-1, y);
        look(size.columns, y);
    }
    return step_grade(100 * light / all, 98, 95, 90, 80);
}

inline CodeGrade grade_data_matrix(const CodeField& field, const SquareToQuad& map,
                                   const DataMatrixSize& size, Span<const std::uint8_t> values,
                                   int unused_correction) {
    CodeGrade grade;
    const int count = size.rows * size.columns;
    int low = 255;
    int high = 0;
    for (int i = 0; i < count; ++i) {
        low = minimum<int>(low, values[i]);
        high = maximum<int>(high, values[i]);
    }
    const int contrast = maximum(high - low, 1);
    grade.symbol_contrast = step_grade(100 * contrast / 255, 70, 55, 40, 20);
    // Twice the way from the threshold, of the contrast; a twentieth of the modules may be worse.
    const int threshold = (high + low) / 2;
    int worse[4] = {};
    for (int i = 0; i < count; ++i) {
        const int way =
            200 * (values[i] > threshold ? values[i] - threshold : threshold - values[i]) / contrast;
        const int modulated = int{step_grade(way, 50, 40, 30, 20)};
        for (int k = modulated; k < 4; ++k) ++worse[k];
    }
    int modulation = 4;
    while (modulation > 0 && worse[modulation - 1] * 20 > count) --modulation;
    grade.modulation = static_cast<std::int8_t>(modulation);
    grade.unused_error_correction = step_grade(unused_correction, 62, 50, 37, 25);
    grade.quiet_zone = quiet_zone_grade(field, map, size, threshold);
    grade.overall = minimum(minimum(grade.symbol_contrast, grade.modulation),
                            minimum(grade.unused_error_correction, grade.quiet_zone));
    return grade;
}

}  // namespace fovea::detail
