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
#include <fovea/statistics/histogram.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The most tiles of clahe() along a side.
inline constexpr int max_clahe_tiles = 32;

/// The bounds of the clip limit of clahe(), in 1/100; at the upper one nothing is clipped.
inline constexpr int min_clahe_clip = 100;
inline constexpr int max_clahe_clip = 25600;

/// Scratch bytes that clahe() needs: a table for each tile, a row of tiles joined, a weight for each column,
/// and a histogram.
constexpr std::int64_t clahe_scratch(Size size, Size tiles) {
    return arena_bytes<Histogram>(1) + arena_bytes<std::uint32_t>(std::int64_t{256} * tiles.width) +
           arena_bytes<std::uint16_t>(size.width) + std::int64_t{256} * tiles.width * tiles.height;
}

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

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Tiles along a side of count pixels.
struct ClaheAxis {
    int count;
    int tiles;

    constexpr int first(int tile) const { return tile * count / tiles; }
    /// Twice the place of the centre of a tile.
    constexpr int centre2(int tile) const { return first(tile) + first(tile + 1) - 1; }
    /// The last tile whose centre is not beyond a place; the first if there is none.
    constexpr int tile_before(int place) const {
        // A guess that the rounding of first() leaves at most one off.
        int tile = clamp(place * tiles / count, 0, tiles - 1);
        while (tile > 0 && centre2(tile) > 2 * place) --tile;
        while (tile < tiles - 1 && centre2(tile + 1) <= 2 * place) ++tile;
        return tile;
    }
    /// The weight of the tile behind tile_before() in 1/256; 0 beyond the outermost centres.
    constexpr int weight(int place, int tile) const {
        if (tile == tiles - 1 || 2 * place <= centre2(tile)) return 0;
        return round_divide(256 * (2 * place - centre2(tile)), centre2(tile + 1) - centre2(tile));
    }
};

/// Holds a share of every level below a limit and makes the table of a tile.
inline void clahe_table(const Histogram& histogram, std::uint32_t area, int clip, Gray8* table) {
    const auto mean = std::uint64_t{area} * static_cast<std::uint64_t>(clip);
    const auto limit = maximum<std::uint32_t>(static_cast<std::uint32_t>(mean / (256 * 100)), 1);
    std::uint32_t excess = 0;
    for (int level = 0; level < 256; ++level) {
        const std::uint32_t count = histogram[level];
        excess += count > limit ? count - limit : 0;
    }
    // What cannot be dealt out to all goes to levels as far apart as there are pixels left.
    const std::uint32_t share = excess / 256;
    std::uint32_t rest = excess % 256;
    const std::uint32_t step = rest == 0 ? 256 : 256 / rest;
    std::uint64_t below = 0;
    std::uint32_t next = 0;
    for (std::uint32_t level = 0; level < 256; ++level) {
        below += minimum(histogram[static_cast<int>(level)], limit) + share;
        if (rest > 0 && level == next) {
            ++below;
            --rest;
            next += step;
        }
        table[level] = static_cast<Gray8>((510 * below + area) / (2 * std::uint64_t{area}));
    }
}

/// The levels of the tiles above and below, in the low and high half of a word.
inline void join_clahe_tables(const Gray8* above, const Gray8* below, int count, std::uint32_t* joined) {
    for (int i = 0; i < count; ++i) joined[i] = std::uint32_t{above[i]} | std::uint32_t{below[i]} << 16;
}

}  // namespace detail

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
    std::uint32_t* joined = arena.take<std::uint32_t>(256 * std::ptrdiff_t{across.tiles}).data();
    std::uint16_t* weights = arena.take<std::uint16_t>(src.width()).data();
    Gray8* tables = arena.rest().data();

    for (int j = 0; j < down.tiles; ++j)
        for (int i = 0; i < across.tiles; ++i) {
            const int width = across.first(i + 1) - across.first(i);
            const int height = down.first(j + 1) - down.first(j);
            histogram.clear();
            for (int y = down.first(j); y < down.first(j + 1); ++y)
                histogram.add_row(src.row(y) + across.first(i), width);
            detail::clahe_table(histogram, static_cast<std::uint32_t>(width * height), clip,
                                tables + 256 * (j * across.tiles + i));
        }
    for (int x = 0; x < src.width(); ++x)
        weights[x] = static_cast<std::uint16_t>(across.weight(x, across.tile_before(x)));

    int band = -1;
    for (int y = 0; y < src.height(); ++y) {
        const int tile = down.tile_before(y);
        const auto lower_weight = static_cast<std::uint32_t>(down.weight(y, tile));
        if (tile != band) {
            band = tile;
            const Gray8* above = tables + 256 * (tile * across.tiles);
            const Gray8* below = tile + 1 < down.tiles ? above + 256 * across.tiles : above;
            detail::join_clahe_tables(above, below, 256 * across.tiles, joined);
        }
        const Gray8* from = src.row(y);
        Gray8* to = dst.row(y);
        int x = 0;
        while (x < src.width()) {
            const int i = across.tile_before(x);
            const std::uint32_t* left = joined + 256 * i;
            const std::uint32_t* right = i + 1 < across.tiles ? left + 256 : left;
            // Up to the centre of the next tile.
            const int end = i + 1 < across.tiles ? (across.centre2(i + 1) + 1) / 2 : src.width();
            for (; x < end; ++x) {
                // Both halves at once: each stays below 255 * 256 + 1.
                const std::uint32_t weight = weights[x];
                const std::uint32_t both = left[from[x]] * (256 - weight) + right[from[x]] * weight;
                const std::uint32_t sum =
                    (both & 0xffff) * (256 - lower_weight) + (both >> 16) * lower_weight;
                to[x] = static_cast<Gray8>((sum + (1u << 15)) >> 16);
            }
        }
    }
    return Status::ok;
}

}  // namespace fovea
