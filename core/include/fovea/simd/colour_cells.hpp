// SPDX-License-Identifier: MIT
//
// Pixels of a colour image at sub-pixel places: the four around a place weighed by distance, a pixel in every
// lane of 32 bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/simd/cell_source.hpp>
#include <fovea/simd/cells.hpp>
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

#if FOVEA_BYTES >= 16

/// Four pixels around each place, the first channel lowest; the highest bytes are anything.
struct ColourCells {
    Ints left_above;
    Ints right_above;
    Ints left_below;
    Ints right_below;
};

/// Eight bytes from p on, the first one lowest.
[[gnu::always_inline]] inline std::uint64_t eight_at(const std::uint8_t* p) {
    std::uint64_t eight;
    std::memcpy(&eight, p, sizeof eight);
    return __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__ ? __builtin_bswap64(eight) : eight;
}

/// The cells whose upper left pixels begin at offsets. Of eight bytes each two are in vain: those after the
/// pair above, and those before the pair below. The image has all of them, since it has two columns and rows.
[[gnu::always_inline]] inline ColourCells colour_cells_at(const std::uint8_t* first, std::ptrdiff_t stride,
                                                          Ints offsets) {
    const std::uint8_t* below = first + stride - 2;
#if FOVEA_BYTES == 32 && defined(__AVX2__)
    const __m256i all = _mm256_set1_epi32(-1);
    const auto fetched = [&](const std::uint8_t* from, __m128i at) {
        return _mm256_mask_i32gather_epi64(_mm256_setzero_si256(), reinterpret_cast<const long long*>(from),
                                           at, all, 1);
    };
    // Such that the lower halves of both vectors lie as the places do.
    const __m256i at = _mm256_permute4x64_epi64(bits_as<__m256i>(offsets), 0xd8);
    const __m128i even = _mm256_castsi256_si128(at);
    const __m128i odd = _mm256_extracti128_si256(at, 1);
    const auto lower_halves = [](__m256i a, __m256i b) {
        return bits_as<Ints>(_mm256_shuffle_ps(bits_as<__m256>(a), bits_as<__m256>(b), 0x88));
    };
    const __m256i a = fetched(first, even);
    const __m256i b = fetched(first, odd);
    const __m256i c = fetched(below, even);
    const __m256i d = fetched(below, odd);
    return {lower_halves(a, b), lower_halves(_mm256_srli_epi64(a, 24), _mm256_srli_epi64(b, 24)),
            lower_halves(_mm256_srli_epi64(c, 16), _mm256_srli_epi64(d, 16)),
            lower_halves(_mm256_srli_epi64(c, 40), _mm256_srli_epi64(d, 40))};
#elif FOVEA_BYTES == 16 && defined(__SSE2__)
    std::uint32_t at[places];
    std::memcpy(at, &offsets, sizeof at);
    const auto fetched = [&](const std::uint8_t* from, int i) {
        const __m128i low = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(from + at[i]));
        const __m128i high = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(from + at[i + 1]));
        return _mm_unpacklo_epi64(low, high);
    };
    const auto lower_halves = [](__m128i a, __m128i b) {
        return bits_as<Ints>(_mm_shuffle_ps(_mm_castsi128_ps(a), _mm_castsi128_ps(b), 0x88));
    };
    const __m128i a = fetched(first, 0);
    const __m128i b = fetched(first, 2);
    const __m128i c = fetched(below, 0);
    const __m128i d = fetched(below, 2);
    return {lower_halves(a, b), lower_halves(_mm_srli_epi64(a, 24), _mm_srli_epi64(b, 24)),
            lower_halves(_mm_srli_epi64(c, 16), _mm_srli_epi64(d, 16)),
            lower_halves(_mm_srli_epi64(c, 40), _mm_srli_epi64(d, 40))};
#else
    std::int32_t at[places];
    store_ints(offsets, at);
    ColourCells cells{};
    for (int i = 0; i < places; ++i) {
        const std::uint64_t upper = eight_at(first + at[i]);
        const std::uint64_t lower = eight_at(below + at[i]);
        cells.left_above[i] = static_cast<std::int32_t>(upper & 0xffffffff);
        cells.right_above[i] = static_cast<std::int32_t>(upper >> 24 & 0xffffffff);
        cells.left_below[i] = static_cast<std::int32_t>(lower >> 16 & 0xffffffff);
        cells.right_below[i] = static_cast<std::int32_t>(lower >> 40);
    }
    return cells;
#endif
}

/// Cells weighed by right and down, 0..256; the highest bytes are 0.
[[gnu::always_inline]] inline Ints blend_colours(const ColourCells& cells, Ints right, Ints down) {
    const RawWords across = bits_as<RawWords>(right | (right << 16));
    // Two channels in the halves of a lane, at most 255 * 256, modulo 2^16.
    const auto row = [across](Ints left, Ints next) {
        const RawWords a = bits_as<RawWords>(left) & 255;
        const RawWords b = bits_as<RawWords>(next) & 255;
        return bits_as<Ints>(((a << 8) + (b - a) * across) ^ 0x8000);
    };
    const Ints both = (256 - down) | (down << 16);
    // Signed products: 32768 was taken from both rows. At most 255 * 2^16 + 2^15.
    const auto column = [both](Ints upper, Ints lower) {
        return pair_sums((upper & 0xffff) | (lower << 16), both) + 32768 * 257;
    };
    const Ints upper = row(cells.left_above, cells.right_above);
    const Ints lower = row(cells.left_below, cells.right_below);
    const Ints green_upper = row(cells.left_above >> 8, cells.right_above >> 8);
    const Ints green_lower = row(cells.left_below >> 8, cells.right_below >> 8);
    const Ints red = column(upper, lower) >> 16;
    const Ints green = (column(green_upper, green_lower) >> 8) & 0xff00;
    const Ints blue = column(upper >> 16, lower >> 16) & 0xff0000;
    return red | green | blue;
}

/// The colours at any places.
struct BlendColours {
    const CellSource src;
    Ints last_x = all_ints(256 * (src.width - 1));
    Ints last_y = all_ints(256 * (src.height - 1));
    Ints last_left = all_ints(src.width - 2);
    Ints last_top = all_ints(src.height - 2);
    Ints stride = all_ints(static_cast<std::int32_t>(src.stride));
    Ints level;

    [[gnu::always_inline]] Ints operator()(Ints x, Ints y) const {
        const Ints held_x = held(x, last_x);
        const Ints held_y = held(y, last_y);
        Ints left = held_x >> 8;
        Ints top = held_y >> 8;
        left = left < last_left ? left : last_left;
        top = top < last_top ? top : last_top;
        const Ints at = pair_sums(top, stride) + left + left + left;
        const Ints blended = blend_colours(colour_cells_at(src.first, src.stride, at), held_x - (left << 8),
                                           held_y - (top << 8));
        const Ints outside = outside_lanes(src, x, y);
        return (outside & level) | (~outside & blended);
    }
};

/// The colours at the first count places of a run, which is used up; outside the three bytes of level. False
/// if it cannot be done this way: then nothing is.
inline bool blend_colour_cells(const CellSource& src, PlaceRun& run, int count, std::int32_t level,
                               std::uint8_t* dst) {
    if (!src.fits_vectors) return false;
    for (int i = count; i % places != 0; ++i) {
        run.x[i] = run.x[count - 1];
        run.y[i] = run.y[count - 1];
    }
    const BlendColours blend{src,
                             all_ints(256 * (src.width - 1)),
                             all_ints(256 * (src.height - 1)),
                             all_ints(src.width - 2),
                             all_ints(src.height - 2),
                             all_ints(static_cast<std::int32_t>(src.stride)),
                             all_ints(level)};
    for (int i = 0; i < count; i += places)
        store_ints(blend(load_ints(run.x + i), load_ints(run.y + i)), run.x + i);
    // Four bytes each, the next pixel over the last of them.
    for (int i = 0; i < count - 1; ++i) {
        const auto colour = static_cast<std::uint32_t>(run.x[i]);
        const std::uint32_t bytes =
            __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__ ? __builtin_bswap32(colour) : colour;
        std::memcpy(dst + std::ptrdiff_t{3} * i, &bytes, sizeof bytes);
    }
    for (int k = 0; k < 3; ++k)
        dst[3 * (count - 1) + k] = static_cast<std::uint8_t>(run.x[count - 1] >> (8 * k) & 255);
    return true;
}

#else

/// Never this way without vectors.
inline bool blend_colour_cells(const CellSource& /*src*/, const PlaceRun& /*run*/, int /*count*/,
                               std::int32_t /*level*/, std::uint8_t* /*dst*/) {
    return false;
}

#endif

}  // namespace simd
}  // namespace FOVEA_ISA
}  // namespace fovea
