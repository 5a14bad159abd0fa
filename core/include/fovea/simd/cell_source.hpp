// SPDX-License-Identifier: MIT
//
// The image that warps read, and single pixels at its sub-pixel places: what the vectors must equal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include <fovea/number/integer.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/places.hpp>

namespace fovea {
inline namespace FOVEA_ISA {
namespace simd {

/// An image with what a fetch from it needs. Places outside are moved to the nearest pixel, or give level
/// where no pixel is the nearest; no_place gives level always.
struct CellSource {
    const std::uint8_t* first;
    std::ptrdiff_t stride;
    std::int32_t width;
    std::int32_t height;
    /// place + bias, with wrap-around, is above limit where level stands; for no_place it always is.
    std::uint32_t bias;
    std::int32_t limit_x;
    std::int32_t limit_y;
    std::uint8_t level;
    /// Rows and columns are such that the vectors' offsets fit 16 by 16 bits.
    bool fits_vectors;

    /// replicate: the nearest pixel for all places; else level for those farther than half a pixel out.
    CellSource(const std::uint8_t* pixels, int columns, int rows, std::ptrdiff_t stride_bytes, bool replicate,
               std::uint8_t outside)
        : first(pixels),
          stride(stride_bytes),
          width(columns),
          height(rows),
          bias(replicate ? ~0u : 0x80000080u),
          limit_x(replicate ? most - 1 : least + 256 * columns - 1),
          limit_y(replicate ? most - 1 : least + 256 * rows - 1),
          level(outside),
          fits_vectors(columns >= 2 && rows >= 2 && stride_bytes >= columns && stride_bytes <= 32767 &&
                       rows <= 32767) {}

    /// True if level stands at a place.
    [[gnu::always_inline]] bool outside(std::int32_t x, std::int32_t y) const {
        return static_cast<std::int32_t>(static_cast<std::uint32_t>(x) + bias) > limit_x ||
               static_cast<std::int32_t>(static_cast<std::uint32_t>(y) + bias) > limit_y;
    }

    /// True if a place has a pixel on its right and one below, by at least a pixel more.
    bool well_inside(std::int32_t x, std::int32_t y) const {
        return x >= 256 && y >= 256 && x < 256 * (width - 2) && y < 256 * (height - 2);
    }

    /// True if level stands at all places between two that are less than a pixel from a straight line.
    bool all_outside(std::int32_t x, std::int32_t y, std::int32_t last_x, std::int32_t last_y) const {
        if (bias == ~0u || x == no_place || last_x == no_place) return false;
        const auto beyond = [](std::int32_t a, std::int32_t b, std::int32_t side) {
            const std::int32_t end = 256 * (side + 1);
            return (a < -512 && b < -512) || (a > end && b > end);
        };
        return beyond(x, last_x, width) || beyond(y, last_y, height);
    }

private:
    static constexpr std::int32_t least = std::numeric_limits<std::int32_t>::min();
    static constexpr std::int32_t most = std::numeric_limits<std::int32_t>::max();
};

/// The four pixels around a place, weighed; to the nearest, ties up. Every sum is at most 255 * 2^16 + 2^15.
[[gnu::always_inline]] inline std::uint8_t blend_cell(const CellSource& src, std::int32_t x, std::int32_t y) {
    if (src.outside(x, y)) return src.level;
    x = clamp<std::int32_t>(x, 0, 256 * (src.width - 1));
    y = clamp<std::int32_t>(y, 0, 256 * (src.height - 1));
    const int left = x >> 8;
    const int top = y >> 8;
    const auto right = static_cast<std::uint32_t>(x & 255);
    const auto down = static_cast<std::uint32_t>(y & 255);
    const std::uint8_t* above = src.first + top * src.stride + left;
    const std::uint8_t* below = down == 0 ? above : above + src.stride;
    const int next = right == 0 ? 0 : 1;
    const std::uint32_t upper = above[0] * (256 - right) + above[next] * right;
    const std::uint32_t lower = below[0] * (256 - right) + below[next] * right;
    return static_cast<std::uint8_t>((upper * (256 - down) + lower * down + 32768) >> 16);
}

/// The pixel nearest to a place, ties to the right and down.
[[gnu::always_inline]] inline std::uint8_t nearest_cell(const CellSource& src, std::int32_t x,
                                                        std::int32_t y) {
    if (src.outside(x, y)) return src.level;
    x = clamp<std::int32_t>(x, 0, 256 * (src.width - 1));
    y = clamp<std::int32_t>(y, 0, 256 * (src.height - 1));
    return src.first[((y + 128) >> 8) * src.stride + ((x + 128) >> 8)];
}

}  // namespace simd
}  // namespace FOVEA_ISA
}  // namespace fovea
