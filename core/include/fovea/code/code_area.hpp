// SPDX-License-Identifier: MIT
//
// What of an image a code covers that was read in it.
#pragma once

#include <cstdint>

#include <fovea/code/code.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/number/integer.hpp>

namespace fovea::detail {

struct CodeColumns {
    int first = 1 << 30;
    int last = -1;  ///< before first: none
};
/// The columns that a code covers in a row, and a pixel on both sides.
inline CodeColumns code_columns(const Code& code, int y) {
    CodeColumns covered;
    for (int k = 0; k < 4; ++k) {
        const SubPixelPoint a = code.corners[k];
        const SubPixelPoint b = code.corners[(k + 1) % 4];
        const std::int64_t from = std::int64_t{256} * y - a.y.raw();
        const std::int64_t height = std::int64_t{b.y.raw()} - a.y.raw();
        if (height == 0 || (height > 0 ? from < 0 || from > height : from > 0 || from < height)) continue;
        const std::int64_t x = a.x.raw() + (std::int64_t{b.x.raw()} - a.x.raw()) * from / height;
        covered.first = minimum(covered.first, static_cast<int>(x >> 8) - 1);
        covered.last = maximum(covered.last, static_cast<int>(x >> 8) + 2);
    }
    return covered;
}
/// Whether a place lies in a code, or two pixels beside it.
inline bool code_covers(const Code& code, Point p) {
    bool positive = true;
    bool negative = true;
    for (int k = 0; k < 4; ++k) {
        const SubPixelPoint a = code.corners[k];
        const SubPixelPoint b = code.corners[(k + 1) % 4];
        const std::int64_t turn = std::int64_t{b.x.raw() - a.x.raw()} * (256 * p.y - a.y.raw()) -
                                  std::int64_t{b.y.raw() - a.y.raw()} * (256 * p.x - a.x.raw());
        const std::int64_t grace = 512 * hypotenuse(b.x.raw() - a.x.raw(), b.y.raw() - a.y.raw());
        positive = positive && turn > -grace;
        negative = negative && turn < grace;
    }
    return positive || negative;
}

}  // namespace fovea::detail
