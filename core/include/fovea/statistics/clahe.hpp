// SPDX-License-Identifier: MIT
//
// Histogram equalization tile by tile, with bounded contrast (CLAHE).
#pragma once

#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/table_blend.hpp>
#include <fovea/statistics/histogram.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The most tiles of clahe() along a side.
inline constexpr int max_clahe_tiles = 32;

/// The bounds of the clip limit of clahe(), in 1/100; at the upper one nothing is clipped.
inline constexpr int min_clahe_clip = 100;
inline constexpr int max_clahe_clip = 25600;

/// Scratch bytes that clahe() needs: a table for each tile, four tables joined, a weight for each column and
/// row, and a histogram.
constexpr std::int64_t clahe_scratch(Size size, Size tiles) {
    return arena_bytes<Histogram>(1) + arena_bytes<std::uint32_t>(2 * 256) +
           arena_bytes<std::uint16_t>(size.width) + arena_bytes<std::uint16_t>(size.height) +
           std::int64_t{256} * tiles.width * tiles.height;
}

inline namespace FOVEA_ISA {

/// Each pixel by the equalization tables of the four tiles around it, blended by its distance from their
/// centres. In a table no level counts for more than clip / 100 times the mean of the 256 levels; what is
/// above that is dealt out to all levels alike, so that noise in flat places is not stretched without bound.
///
/// Shapes    src and dst equal, 1x1 or larger; tiles 1x1 to 32x32, and never more than pixels: tile i of n
///           covers the columns from i width / n to (i + 1) width / n - 1
/// Units     clip in 1/100, min_clahe_clip to max_clahe_clip
/// Rounding  tables to the nearest, ties up; weights to the nearest of 1/256, the blend to the nearest, ties
///           up. The largest sum is 255 * 2^16 + 2^15
/// Border    beyond the centres of the outermost tiles their tables alone count
/// Overlap   dst may be src
/// Scratch   clahe_scratch(src.size(), tiles) bytes, undefined afterwards
/// Errors    empty_image, size_mismatch, bad_argument, scratch_too_small
/// Source    Zuiderveld, "Contrast Limited Adaptive Histogram Equalization", Graphics Gems IV, 1994. OpenCV
///           pads the image to whole tiles of one size with mirrored pixels, puts the centre of a tile half a
///           pixel further right and down, and blends with real weights
inline Status clahe(ImageView<const Gray8> src, Size tiles, int clip, Span<std::uint8_t> scratch,
                    ImageView<Gray8> dst);

}  // namespace FOVEA_ISA

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Tiles along a side of count pixels.
struct ClaheAxis {
    int count;
    int tiles;

    constexpr int first(int tile) const { return tile * count / tiles; }
    /// Twice the place of the centre of a tile.
    constexpr int centre2(int tile) const { return first(tile) + first(tile + 1) - 1; }
    /// The first place that blends a tile with the one behind it: at its centre, but for the first tile.
    constexpr int begin(int tile) const {
        return tile == 0 ? 0 : tile == tiles ? count : (centre2(tile) + 1) / 2;
    }
    /// The weight of the tile behind in 1/256, for places from begin(tile) on; 0 beyond the outermost
    /// centres.
    constexpr int weight(int place, int tile) const {
        if (tile == tiles - 1 || 2 * place <= centre2(tile)) return 0;
        return round_divide(256 * (2 * place - centre2(tile)), centre2(tile + 1) - centre2(tile));
    }
    void weigh(std::uint16_t* weights) const {
        for (int i = 0; i < tiles; ++i)
            for (int x = begin(i); x < begin(i + 1); ++x)
                weights[x] = static_cast<std::uint16_t>(weight(x, i));
    }
};

/// Holds the count of every level below a limit and makes the table of a tile; no count is left. Word holds
/// 512 area.
template <class Word>
void clahe_table(std::uint32_t* counts, std::uint32_t area, int clip, Gray8* table) {
    const auto mean = std::uint64_t{area} * static_cast<std::uint64_t>(clip);
    const auto limit = maximum<std::uint32_t>(static_cast<std::uint32_t>(mean / (256 * 100)), 1);
    std::uint32_t held = 0;
    for (int level = 0; level < 256; ++level) {
        counts[level] = minimum(counts[level], limit);
        held += counts[level];
    }
    // What cannot be dealt out to all goes to levels as far apart as there are pixels left.
    const std::uint32_t excess = area - held;
    const auto rest = static_cast<int>(excess % 256);
    const int step = rest == 0 ? 256 : 256 / rest;
    std::uint32_t* dealt = counts;
    for (int i = 0; i < rest; ++i, dealt += step) ++*dealt;
    const Word share = Word{510} * (excess / 256);
    Word below = area;  // 510 times the pixels up to a level, and half of the divisor
    for (int level = 0; level < 256; ++level) {
        below += Word{510} * counts[level] + share;
        counts[level] = 0;
        table[level] = static_cast<Gray8>(below / (Word{2} * area));
    }
}
inline void clahe_table(std::uint32_t* counts, std::uint32_t area, int clip, Gray8* table) {
    if (area < 1u << 23)
        clahe_table<std::uint32_t>(counts, area, clip, table);
    else
        clahe_table<std::uint64_t>(counts, area, clip, table);
}

}  // namespace detail

inline namespace FOVEA_ISA {

inline Status clahe(ImageView<const Gray8> src, Size tiles, int clip, Span<std::uint8_t> scratch,
                    ImageView<Gray8> dst) {
    if (src.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    if (tiles.empty() || tiles.width > max_clahe_tiles || tiles.height > max_clahe_tiles ||
        clip < min_clahe_clip || clip > max_clahe_clip)
        return Status::bad_argument;
    if (scratch.size() < clahe_scratch(src.size(), tiles)) return Status::scratch_too_small;

    const detail::ClaheAxis across{src.width(), minimum(tiles.width, src.width())};
    const detail::ClaheAxis down{src.height(), minimum(tiles.height, src.height())};
    Arena arena(scratch);
    Histogram& histogram = detail::take_histogram(arena);
    simd::TableBlend& joined = *arena.take<simd::TableBlend>(1).data();
    std::uint16_t* weights = arena.take<std::uint16_t>(src.width()).data();
    std::uint16_t* row_weights = arena.take<std::uint16_t>(src.height()).data();
    Gray8* tables = arena.rest().data();

    for (int j = 0; j < down.tiles; ++j)
        for (int i = 0; i < across.tiles; ++i) {
            const int width = across.first(i + 1) - across.first(i);
            const int height = down.first(j + 1) - down.first(j);
            for (int y = down.first(j); y < down.first(j + 1); ++y)
                histogram.add_row(src.row(y) + across.first(i), width);
            detail::clahe_table(histogram.counts(), static_cast<std::uint32_t>(width * height), clip,
                                tables + 256 * (j * across.tiles + i));
        }
    across.weigh(weights);
    down.weigh(row_weights);

    for (int j = 0; j < down.tiles; ++j)
        for (int i = 0; i < across.tiles; ++i) {
            const Gray8* table = tables + 256 * (j * across.tiles + i);
            const Gray8* below = j + 1 < down.tiles ? table + 256 * across.tiles : table;
            joined.join(table, below, i + 1 < across.tiles ? 256 : 0);
            const int x = across.begin(i);
            const int count = across.begin(i + 1) - x;
            for (int y = down.begin(j); y < down.begin(j + 1); ++y)
                simd::blend_row(src.row(y) + x, weights + x, count, joined, row_weights[y], dst.row(y) + x);
        }
    return Status::ok;
}

}  // namespace FOVEA_ISA
}  // namespace fovea
