// SPDX-License-Identifier: MIT
//
// Thinning: regions become lines of one pixel that keep their connections.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/base/order.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

enum class ThinningRule : std::uint8_t {
    zhang_suen,  ///< keeps more spurs; diagonal lines may stay two pixels wide
    guo_hall,    ///< thinner: one pixel wherever the connection allows
};

/// The most passes: half the longest side of an image, as a region loses a pixel on either side in each.
inline constexpr int most_thinning_passes = max_image_side / 2 + 1;

/// Scratch bytes that thin() needs: two rows with a pixel on either side.
constexpr std::int64_t thin_scratch(Size size) { return 2 * (std::int64_t{size.width} + 2); }

/// Takes pixels off the rims of regions until only lines are left.
///
/// A pass has two halves; each looks at all pixels first and then takes those that its rule names, so that
/// the result does not depend on the order of the pixels. The first half takes from the lower right, the
/// second from the upper left, with zhang_suen; with guo_hall from above and right first.
///
/// Shapes   src and dst equal, 1x1 or larger; passes 1 to most_thinning_passes: a region is one pixel thinner
///          all around after each. Zero is ground, all else belongs
/// Units    255 where something is left, 0 elsewhere
/// Border   beyond the image is ground
/// Overlap  dst may be src
/// Scratch  thin_scratch(src.size()) bytes, undefined afterwards
/// Cost     passes times the image, as many as the thickest region is wide by half
/// Errors   empty_image, size_mismatch, bad_argument for passes out of range, scratch_too_small
/// Source   Zhang and Suen, "A fast parallel algorithm for thinning digital patterns", 1984; Guo and Hall,
///          "Parallel thinning with two-subiteration algorithms", 1989, first of the two
inline Status thin(ImageView<const Gray8> src, ThinningRule rule, int passes, Span<std::uint8_t> scratch,
                   ImageView<Gray8> dst);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Whether a pixel goes, by its eight neighbours: bit 0 above, then clockwise, bit 7 to the upper left.
constexpr bool zhang_suen_takes(unsigned around, int half) {
    const auto p = [&](int i) { return static_cast<int>(around >> (i & 7) & 1); };
    int neighbours = 0;
    int rises = 0;
    for (int i = 0; i < 8; ++i) {
        neighbours += p(i);
        rises += p(i) == 0 && p(i + 1) == 1 ? 1 : 0;
    }
    if (neighbours < 2 || neighbours > 6 || rises != 1) return false;
    return half == 0 ? p(0) * p(2) * p(4) == 0 && p(2) * p(4) * p(6) == 0
                     : p(0) * p(2) * p(6) == 0 && p(0) * p(4) * p(6) == 0;
}

constexpr bool guo_hall_takes(unsigned around, int half) {
    const auto p = [&](int i) { return static_cast<int>(around >> (i & 7) & 1); };
    int pieces = 0;
    int pairs_from_corners = 0;
    int pairs_from_sides = 0;
    for (int i = 0; i < 8; i += 2) {
        pieces += p(i) == 0 && (p(i + 1) | p(i + 2)) != 0 ? 1 : 0;
        pairs_from_corners += p(i + 7) | p(i);
        pairs_from_sides += p(i) | p(i + 1);
    }
    const int pairs = minimum(pairs_from_corners, pairs_from_sides);
    if (pieces != 1 || pairs < 2 || pairs > 3) return false;
    return half == 0 ? ((p(0) | p(1) | (1 - p(3))) & p(2)) == 0 : ((p(4) | p(5) | (1 - p(7))) & p(6)) == 0;
}

struct ThinningTable {
    std::uint8_t takes[2][256];  ///< by half of a pass and neighbours
};
constexpr ThinningTable thinning_table(ThinningRule rule) {
    ThinningTable table{};
    for (int half = 0; half < 2; ++half)
        for (unsigned around = 0; around < 256; ++around)
            table.takes[half][around] = rule == ThinningRule::zhang_suen ? zhang_suen_takes(around, half)
                                                                         : guo_hall_takes(around, half);
    return table;
}
inline constexpr ThinningTable zhang_suen_table = thinning_table(ThinningRule::zhang_suen);
inline constexpr ThinningTable guo_hall_table = thinning_table(ThinningRule::guo_hall);

/// Zero pixels from x on, up to width, by words where there are many.
inline int skip_ground(const Gray8* row, int x, int width) {
    for (; x + 8 <= width; x += 8) {
        std::uint64_t word;
        std::memcpy(&word, row + x, sizeof word);
        if (word != 0) break;
    }
    while (x < width && row[x] == 0) ++x;
    return x;
}

/// True if eight pixels from each of these on are set: the six in the middle of the middle row are inside.
inline bool all_set(const Gray8* above, const Gray8* here, const Gray8* below) {
    std::uint64_t a, b, c;
    std::memcpy(&a, above, sizeof a);
    std::memcpy(&b, here, sizeof b);
    std::memcpy(&c, below, sizeof c);
    return (a & b & c) == ~std::uint64_t{0};
}

/// One half of a pass, in place: above and here are rows as they were before, with a zero at either side.
/// Answers whether a pixel went.
inline bool thin_half(ImageView<Gray8> image, const std::uint8_t (&takes)[256], Gray8* above, Gray8* here) {
    const int width = image.width();
    const auto bytes = static_cast<std::size_t>(width);
    std::memset(above, 0, bytes + 2);
    std::memset(here, 0, bytes + 2);
    bool changed = false;
    for (int y = 0; y < image.height(); ++y) {
        Gray8* row = image.row(y);
        const Gray8* below = y + 1 < image.height() ? image.row(y + 1) : nullptr;
        std::memcpy(here + 1, row, bytes);
        const auto lower = [&](int x) -> unsigned {
            return below != nullptr && x >= 0 && x < width && below[x] != 0 ? 1 : 0;
        };
        const auto bit = [](const Gray8* pixels, int x) -> unsigned { return pixels[x + 1] != 0 ? 1 : 0; };
        for (int x = skip_ground(row, 0, width); x < width; x = skip_ground(row, x + 1, width)) {
            if (below != nullptr && x > 0)
                while (x + 7 <= width && all_set(above + x, here + x, below + x - 1)) x += 6;
            if (x == width) break;
            const unsigned around = bit(above, x) | bit(above, x + 1) << 1 | bit(here, x + 1) << 2 |
                                    lower(x + 1) << 3 | lower(x) << 4 | lower(x - 1) << 5 |
                                    bit(here, x - 1) << 6 | bit(above, x - 1) << 7;
            if (row[x] == 0 || takes[around] == 0) continue;
            row[x] = 0;
            changed = true;
        }
        swap_values(above, here);
    }
    return changed;
}

}  // namespace detail

inline Status thin(ImageView<const Gray8> src, ThinningRule rule, int passes, Span<std::uint8_t> scratch,
                   ImageView<Gray8> dst) {
    if (src.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    if (passes < 1 || passes > most_thinning_passes) return Status::bad_argument;
    if (scratch.size() < thin_scratch(src.size())) return Status::scratch_too_small;
    for (int y = 0; y < src.height(); ++y)
        for (int x = 0; x < src.width(); ++x) dst(x, y) = src(x, y) != 0 ? 255 : 0;
    const detail::ThinningTable& table =
        rule == ThinningRule::zhang_suen ? detail::zhang_suen_table : detail::guo_hall_table;
    Gray8* above = scratch.data();
    Gray8* here = above + src.width() + 2;
    for (int pass = 0; pass < passes; ++pass) {
        const bool first = detail::thin_half(dst, table.takes[0], above, here);
        const bool second = detail::thin_half(dst, table.takes[1], above, here);
        if (!first && !second) break;
    }
    return Status::ok;
}

}  // namespace fovea
