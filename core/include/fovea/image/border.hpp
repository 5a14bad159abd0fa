// SPDX-License-Identifier: MIT
//
// Border: what a window sees beyond the image.
#pragma once

#include <cstdint>

namespace fovea {

/// What stands outside the image. Handled by the choice of row pointers and by filling the ends of a line,
/// never by a branch in a pixel loop.
enum class Border : std::uint8_t {
    replicate,    ///< the outermost pixels repeat:  a a | a b c | c c
    reflect_101,  ///< mirrored about the outermost pixel:  c b | a b c | b a
    zero,         ///< black:  0 0 | a b c | 0 0
};

/// What border_index() answers where Border::zero has no row or column.
inline constexpr int no_index = -1;

/// The row or column that stands for index in a side of count pixels, for windows of any size; no_index for a
/// zero outside.
constexpr int border_index(Border border, int index, int count) {
    if (index >= 0 && index < count) return index;
    if (border == Border::zero) return no_index;
    if (border == Border::replicate || count == 1) return index < 0 ? 0 : count - 1;
    const int period = 2 * (count - 1);
    const int phase = (index % period + period) % period;
    return phase < count ? phase : period - phase;
}

}  // namespace fovea
