// SPDX-License-Identifier: MIT
//
// Pixels fetched from any places of a gray image: the nearest one, or the four around a place weighed by
// distance. Gathers where the processor has them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include <fovea/number/integer.hpp>
#include <fovea/simd/backend.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/places.hpp>

#if FOVEA_BYTES == 32 && defined(__AVX2__)
#include <immintrin.h>
#elif FOVEA_BYTES == 16 && defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace fovea {
inline namespace FOVEA_ISA {
namespace simd {

/// A gray image with what a fetch from it needs. Places outside are moved to the nearest pixel, or give level
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

#if FOVEA_BYTES >= 16

using Ints [[gnu::vector_size(FOVEA_BYTES)]] = std::int32_t;
using Unsigned [[gnu::vector_size(FOVEA_BYTES)]] = std::uint32_t;
/// Places in one vector.
inline constexpr int places = FOVEA_BYTES / 4;

[[gnu::always_inline]] inline Ints all_ints(std::int32_t k) { return Ints{} + k; }
[[gnu::always_inline]] inline Ints load_ints(const std::int32_t* from) {
    Ints ints;
    std::memcpy(&ints, from, sizeof ints);
    return ints;
}
[[gnu::always_inline]] inline void store_ints(Ints ints, std::int32_t* to) {
    std::memcpy(to, &ints, sizeof ints);
}
[[gnu::always_inline]] inline Ints held(Ints a, Ints last) {
    a = a > 0 ? a : Ints{};
    return a < last ? a : last;
}

/// All bits of a lane where CellSource::outside().
[[gnu::always_inline]] inline Ints outside_lanes(const CellSource& src, Ints x, Ints y) {
    const Unsigned bias = Unsigned{} + src.bias;
    return (bits_as<Ints>(bits_as<Unsigned>(x) + bias) > all_ints(src.limit_x)) |
           (bits_as<Ints>(bits_as<Unsigned>(y) + bias) > all_ints(src.limit_y));
}

/// In each lane of 32 bits the sum of the two products of its halves, which are signed.
[[gnu::always_inline]] inline Ints pair_sums(Ints a, Ints b) {
#if FOVEA_BYTES == 32 && defined(__AVX2__)
    return bits_as<Ints>(_mm256_madd_epi16(bits_as<__m256i>(a), bits_as<__m256i>(b)));
#elif FOVEA_BYTES == 16 && defined(__SSE2__)
    return bits_as<Ints>(_mm_madd_epi16(bits_as<__m128i>(a), bits_as<__m128i>(b)));
#else
    return ((a << 16) >> 16) * ((b << 16) >> 16) + (a >> 16) * (b >> 16);
#endif
}

/// The lowest bytes of the lanes of four vectors, in order.
[[gnu::always_inline]] inline RawBytes lowest_bytes(Ints a, Ints b, Ints c, Ints d) {
#if FOVEA_BYTES == 32 && defined(__AVX2__)
    const __m256i ab = _mm256_packus_epi32(bits_as<__m256i>(a), bits_as<__m256i>(b));
    const __m256i cd = _mm256_packus_epi32(bits_as<__m256i>(c), bits_as<__m256i>(d));
    return bits_as<RawBytes>(
        _mm256_permutevar8x32_epi32(_mm256_packus_epi16(ab, cd), _mm256_setr_epi32(0, 4, 1, 5, 2, 6, 3, 7)));
#elif FOVEA_BYTES == 16 && defined(__SSE2__)
    const __m128i ab = _mm_packs_epi32(bits_as<__m128i>(a), bits_as<__m128i>(b));
    const __m128i cd = _mm_packs_epi32(bits_as<__m128i>(c), bits_as<__m128i>(d));
    return bits_as<RawBytes>(_mm_packus_epi16(ab, cd));
#else
    std::int32_t lanes_of[FOVEA_BYTES];
    store_ints(a, lanes_of);
    store_ints(b, lanes_of + places);
    store_ints(c, lanes_of + 2 * places);
    store_ints(d, lanes_of + 3 * places);
    RawBytes bytes{};
    for (int i = 0; i < FOVEA_BYTES; ++i) bytes[i] = static_cast<std::uint8_t>(lanes_of[i]);
    return bytes;
#endif
}

/// The bytes at p and p + 1, the first one lowest.
[[gnu::always_inline]] inline std::uint32_t pair_at(const std::uint8_t* p) {
    std::uint16_t pair;
    std::memcpy(&pair, p, sizeof pair);
    return __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__ ? static_cast<std::uint32_t>(pair >> 8 | (pair & 255) << 8)
                                                  : pair;
}

/// Turns the places of a run into offsets of the upper left pixel (x) and weights (y): right in the lower
/// half, down in the upper one, both 0..256, and the sign set where the place is outside.
inline void weigh_places(const CellSource& src, int count, PlaceRun& run) {
    const Ints last_x = all_ints(256 * (src.width - 1));
    const Ints last_y = all_ints(256 * (src.height - 1));
    const Ints last_left = all_ints(src.width - 2);
    const Ints last_top = all_ints(src.height - 2);
    const Ints stride = all_ints(static_cast<std::int32_t>(src.stride));
    for (int i = 0; i < count; i += places) {
        const Ints x = load_ints(run.x + i);
        const Ints y = load_ints(run.y + i);
        const Ints held_x = held(x, last_x);
        const Ints held_y = held(y, last_y);
        Ints left = held_x >> 8;
        Ints top = held_y >> 8;
        left = left < last_left ? left : last_left;
        top = top < last_top ? top : last_top;
        const Ints outside = outside_lanes(src, x, y);
        store_ints(pair_sums(top, stride) + left, run.x + i);
        store_ints((held_x - (left << 8)) | ((held_y - (top << 8)) << 16) | (outside & no_place), run.y + i);
    }
}

/// The same for places that all have a pixel on their right and one below.
inline void weigh_inside(const CellSource& src, int count, PlaceRun& run) {
    const Ints stride = all_ints(static_cast<std::int32_t>(src.stride));
    for (int i = 0; i < count; i += places) {
        const Ints x = load_ints(run.x + i);
        const Ints y = load_ints(run.y + i);
        store_ints(pair_sums(y >> 8, stride) + (x >> 8), run.x + i);
        store_ints((x & 255) | ((y & 255) << 16), run.y + i);
    }
}

/// Whether CellSource::well_inside() for all places of a run.
[[gnu::always_inline]] inline bool all_inside(const CellSource& src, int count, const PlaceRun& run) {
    const Unsigned last_x = Unsigned{} + static_cast<std::uint32_t>(256 * (src.width - 2) - 1);
    const Unsigned last_y = Unsigned{} + static_cast<std::uint32_t>(256 * (src.height - 2) - 1);
    // The sign of a difference tells; where it wraps, the sign of the place does.
    Unsigned signs{};
    for (int i = 0; i < count; i += places) {
        const auto x = bits_as<Unsigned>(load_ints(run.x + i));
        const auto y = bits_as<Unsigned>(load_ints(run.y + i));
        signs |= (x - 256) | (last_x - x) | x | (y - 256) | (last_y - y) | y;
    }
    std::int32_t lanes_of[places];
    store_ints(bits_as<Ints>(signs), lanes_of);
    std::int32_t sign = 0;
    for (const std::int32_t one : lanes_of) sign |= one;
    return sign >= 0;
}

/// Eight, four, ... pixels in lanes of 32 bits, from cells and weights.
[[gnu::always_inline]] inline Ints blend_lanes(Ints cell, Ints weights) {
    // The row above in the lower halves, the row below in the upper ones; at most 255 * 256, modulo 2^16.
    const RawWords a = bits_as<RawWords>(cell) & 255;
    const RawWords b = bits_as<RawWords>(cell) >> 8;
    const Ints right = weights & 0x1ff;
    const RawWords across = bits_as<RawWords>(right | (right << 16));
    const RawWords rows = (a << 8) + (b - a) * across;
    // Signed products: 32768 is taken from both rows, and 32768 * 256 given back with the rounding.
    const Ints down = (weights >> 16) & 0x1ff;
    const Ints both = (256 - down) | (down << 16);
    return (pair_sums(bits_as<Ints>(rows ^ 0x8000), both) + 32768 * 257) >> 16;
}
[[gnu::always_inline]] inline Ints blend_lanes(Ints cell, Ints weights, Ints level) {
    const Ints outside = weights >> 31;
    return (outside & level) | (~outside & blend_lanes(cell, weights));
}

/// dst[i] = blend(cell, weights) for a run whose cells were fetched.
template <class Blend>
[[gnu::always_inline]] inline void blend_fetched(const PlaceRun& run, int count, Blend blend,
                                                 std::uint8_t* dst) {
    for (int i = 0; i < count; i += FOVEA_BYTES) {
        const auto lanes_from = [&](int k) { return blend(load_ints(run.x + k), load_ints(run.y + k)); };
        const RawBytes pixels = lowest_bytes(lanes_from(i), lanes_from(i + places),
                                             lanes_from(i + 2 * places), lanes_from(i + 3 * places));
        if (count - i >= FOVEA_BYTES)
            std::memcpy(dst + i, &pixels, sizeof pixels);
        else
            std::memcpy(dst + i, &pixels, static_cast<std::size_t>(count - i));
    }
}

/// The cells at the offsets of a run, in their place.
inline void fetch_cells(const CellSource& src, int count, PlaceRun& run) {
    const std::uint8_t* above = src.first;
    const std::uint8_t* below = src.first + src.stride;
    for (int i = 0; i < count; ++i) {
        const std::ptrdiff_t at = run.x[i];
        run.x[i] = static_cast<std::int32_t>(pair_at(above + at) | pair_at(below + at) << 16);
    }
}

inline void blend_cells(const CellSource& src, PlaceRun& run, int count, PlaceOrder order,
                        std::uint8_t* dst) {
    if (!src.fits_vectors) {
        for (int i = 0; i < count; ++i) dst[i] = blend_cell(src, run.x[i], run.y[i]);
        return;
    }
    // What fills up the last vector lies like the last place.
    const int last = count - 1;
    for (int i = count; i % FOVEA_BYTES != 0; ++i) {
        run.x[i] = run.x[last];
        run.y[i] = run.y[last];
    }
    const bool inside = order == PlaceOrder::along_a_line
                            ? src.well_inside(run.x[0], run.y[0]) && src.well_inside(run.x[last], run.y[last])
                            : all_inside(src, count, run);
    if (inside) {
        weigh_inside(src, count, run);
        fetch_cells(src, count, run);
        blend_fetched(
            run, count, [](Ints cell, Ints weights) { return blend_lanes(cell, weights); }, dst);
    } else {
        weigh_places(src, count, run);
        fetch_cells(src, count, run);
        const Ints level = all_ints(src.level);
        blend_fetched(
            run, count, [=](Ints cell, Ints weights) { return blend_lanes(cell, weights, level); }, dst);
    }
}

/// nearest_cell() at the first count places of a run, which is used up.
inline void nearest_cells(const CellSource& src, PlaceRun& run, int count, std::uint8_t* dst) {
    if (!src.fits_vectors) {
        for (int i = 0; i < count; ++i) dst[i] = nearest_cell(src, run.x[i], run.y[i]);
        return;
    }
    for (int i = count; i % places != 0; ++i) run.x[i] = run.y[i] = 0;
    const Ints last_x = all_ints(256 * (src.width - 1));
    const Ints last_y = all_ints(256 * (src.height - 1));
    const Ints stride = all_ints(static_cast<std::int32_t>(src.stride));
    for (int i = 0; i < count; i += places) {
        const Ints x = load_ints(run.x + i);
        const Ints y = load_ints(run.y + i);
        const Ints column = (held(x, last_x) + 128) >> 8;
        const Ints row = (held(y, last_y) + 128) >> 8;
        store_ints(pair_sums(row, stride) + column, run.x + i);
        store_ints(outside_lanes(src, x, y), run.y + i);
    }
    const std::uint8_t* first = src.first;
    const std::uint8_t level = src.level;
    for (int i = 0; i < count; ++i) {
        const std::uint8_t pixel = first[run.x[i]];
        dst[i] = run.y[i] != 0 ? level : pixel;
    }
}

#else

/// blend_cell() at the first count places of a run, which is used up.
inline void blend_cells(const CellSource& src, PlaceRun& run, int count, PlaceOrder /*order*/,
                        std::uint8_t* dst) {
    for (int i = 0; i < count; ++i) dst[i] = blend_cell(src, run.x[i], run.y[i]);
}

/// nearest_cell() at the first count places of a run.
inline void nearest_cells(const CellSource& src, PlaceRun& run, int count, std::uint8_t* dst) {
    for (int i = 0; i < count; ++i) dst[i] = nearest_cell(src, run.x[i], run.y[i]);
}

#endif

}  // namespace simd
}  // namespace FOVEA_ISA
}  // namespace fovea
