// SPDX-License-Identifier: MIT
//
// The frame of a Data Matrix moved to where its borders are clearest.
#pragma once

#include <cstdint>

#include <fovea/code/data_matrix_corners.hpp>
#include <fovea/code/data_matrix_frame.hpp>
#include <fovea/code/data_matrix_grid.hpp>
#include <fovea/code/data_matrix_lines.hpp>
#include <fovea/code/data_matrix_placement.hpp>
#include <fovea/code/data_matrix_sizes.hpp>
#include <fovea/code/work_budget.hpp>
#include <fovea/number/integer.hpp>

namespace fovea::detail {

inline SquareToQuad map_of(const DataMatrixFrame& frame);
/// The side of a module along the lower line, 1/256 px.
inline std::int32_t module_of(const DataMatrixFrame& frame, const DataMatrixSize& size);

/// Moves corners by parts of a module while that makes the borders clearer; false if it never did.
///
/// Time  at most two rounds a step and three steps, of 16 looks at all modules of the borders; it ends with
///       the budget, of a unit a module
inline bool make_clearer(const CodeField& field, const DataMatrixSize& size, DataMatrixFrame& frame,
                         WorkBudget& budget);

inline SquareToQuad map_of(const DataMatrixFrame& frame) {
    return SquareToQuad(frame.upper, frame.opposite, frame.right, frame.corner);
}

inline std::int32_t module_of(const DataMatrixFrame& frame, const DataMatrixSize& size) {
    const EdgePlace across = frame.right - frame.corner;
    return static_cast<std::int32_t>(hypotenuse(across.x, across.y) / size.columns);
}

/// How well the borders stand out: light less dark ones, per module.
inline int clarity(const CodeField& field, const DataMatrixFrame& frame, const DataMatrixSize& size) {
    const SquareToQuad map = map_of(frame);
    if (!map.there()) return -5000;
    std::int64_t sum = 0;
    int count = 0;
    visit_borders(size, [&](int x, int y, bool dark) {
        const EdgePlace p = map(module_middle(x, size.columns), module_middle(y, size.rows));
        const int value = field.sample(p.x, p.y);
        sum += dark ? -value : value;
        ++count;
    });
    return static_cast<int>(sum / count);
}

/// Modules of the borders, about.
constexpr int border_modules(const DataMatrixSize& size) {
    return 2 * (size.rows * (size.columns / (size.region_columns() + 2)) +
                size.columns * (size.rows / (size.region_rows() + 2)));
}

inline bool make_clearer(const CodeField& field, const DataMatrixSize& size, DataMatrixFrame& frame,
                         WorkBudget& budget) {
    const std::int32_t module = module_of(frame, size);
    const int looks = border_modules(size);
    budget.spend(looks);
    int best = clarity(field, frame, size);
    const int begin = best;
    EdgePlace* const corners[4] = {&frame.opposite, &frame.upper, &frame.right, &frame.corner};
    for (std::int32_t move = module / 2; move >= maximum<std::int32_t>(module / 8, 24); move /= 2) {
        const EdgePlace ways[4] = {{move, 0}, {-move, 0}, {0, move}, {0, -move}};
        for (int round = 0; round < 2; ++round) {
            const int before = best;
            for (EdgePlace* corner : corners) {
                for (const EdgePlace way : ways) {
                    if (budget.spent()) return best > begin;
                    const EdgePlace was = *corner;
                    *corner = was + way;
                    const int now = clarity(field, frame, size);
                    budget.spend(looks);
                    if (now > best) {
                        best = now;
                    } else {
                        *corner = was;
                    }
                }
            }
            if (best == before) break;
        }
    }
    return best > begin;
}

}  // namespace fovea::detail
