// SPDX-License-Identifier: MIT
//
// Pixels fetched from any places of a gray image: the nearest one, or the four around a place weighed by
// distance. Gathers where the processor has them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/simd/backend.hpp>
#include <fovea/simd/cell_source.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/places.hpp>

#if FOVEA_BYTES == 32 && defined(__AVX2__)
#include <immintrin.h>
#elif FOVEA_BYTES == 16 && defined(__SSE2__)
#include <emmintrin.h>
#elif FOVEA_BYTES == 16 && defined(__ARM_FEATURE_MVE)
#include <arm_mve.h>
#endif

namespace fovea {
inline namespace FOVEA_ISA {
namespace simd {

#if FOVEA_BYTES >= 16

using Ints [[gnu::vector_size(FOVEA_BYTES)]] = std::int32_t;
using Unsigned [[gnu::vector_size(FOVEA_BYTES)]] = std::uint32_t;
/// Places in one vector.
inline constexpr int places = FOVEA_BYTES / 4;

[[gnu::always_inline]] inline Ints all_ints(std::int32_t k) { return Ints{} + k; }
[[gnu::always_inline]] inline Ints load_ints(const std::int32_t* from) { return load_raw<Ints>(from); }
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
#elif FOVEA_BYTES == 16 && defined(__ARM_FEATURE_MVE)
    const auto x = bits_as<int16x8_t>(a);
    const auto y = bits_as<int16x8_t>(b);
    return bits_as<Ints>(vaddq_s32(vmullbq_int_s16(x, y), vmulltq_int_s16(x, y)));
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
#elif FOVEA_BYTES == 16 && defined(__ARM_FEATURE_MVE)
    std::uint8_t bytes[FOVEA_BYTES];
    vstrbq_s32(reinterpret_cast<std::int8_t*>(bytes), bits_as<int32x4_t>(a));
    vstrbq_s32(reinterpret_cast<std::int8_t*>(bytes + places), bits_as<int32x4_t>(b));
    vstrbq_s32(reinterpret_cast<std::int8_t*>(bytes + 2 * places), bits_as<int32x4_t>(c));
    vstrbq_s32(reinterpret_cast<std::int8_t*>(bytes + 3 * places), bits_as<int32x4_t>(d));
    return load_raw<RawBytes>(bytes);
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

#if FOVEA_BYTES == 32 && defined(__AVX2__)
/// Four bytes from each offset on.
[[gnu::always_inline]] inline Ints gather(const std::uint8_t* first, Ints offsets) {
    // With a mask and zeros, since GCC lets the plain form wait for the register's former value.
    return bits_as<Ints>(_mm256_mask_i32gather_epi32(_mm256_setzero_si256(),
                                                     reinterpret_cast<const int*>(first),
                                                     bits_as<__m256i>(offsets), _mm256_set1_epi32(-1), 1));
}
#endif

/// The cells whose upper left pixels lie at offsets: the two pixels of the row above in the lower half of a
/// lane, those of the row below in the upper one.
[[gnu::always_inline]] inline Ints cells_at(const std::uint8_t* first, std::ptrdiff_t stride, Ints offsets) {
#if FOVEA_BYTES == 32 && defined(__AVX2__)
    // Of four bytes each two are in vain: those after the pair above, and those before the pair below. The
    // image has all of them, since it has two columns and two rows.
    const Ints upper = gather(first, offsets);
    const Ints lower = gather(first + stride - 2, offsets);
    return bits_as<Ints>(_mm256_blend_epi16(bits_as<__m256i>(upper), bits_as<__m256i>(lower), 0xaa));
#elif FOVEA_BYTES == 16 && defined(__SSE2__)
    std::uint64_t pairs[2];
    std::memcpy(pairs, &offsets, sizeof pairs);
    const auto low = [](std::uint64_t pair) { return static_cast<std::uint32_t>(pair); };
    const auto high = [](std::uint64_t pair) { return pair >> 32; };
    const auto word = [](const std::uint8_t* p) { return static_cast<std::int16_t>(pair_at(p)); };
    const std::uint8_t* below = first + stride;
    __m128i cells = _mm_cvtsi32_si128(word(first + low(pairs[0])));
    cells = _mm_insert_epi16(cells, word(below + low(pairs[0])), 1);
    cells = _mm_insert_epi16(cells, word(first + high(pairs[0])), 2);
    cells = _mm_insert_epi16(cells, word(below + high(pairs[0])), 3);
    cells = _mm_insert_epi16(cells, word(first + low(pairs[1])), 4);
    cells = _mm_insert_epi16(cells, word(below + low(pairs[1])), 5);
    cells = _mm_insert_epi16(cells, word(first + high(pairs[1])), 6);
    cells = _mm_insert_epi16(cells, word(below + high(pairs[1])), 7);
    return bits_as<Ints>(cells);
#elif FOVEA_BYTES == 16 && defined(__ARM_FEATURE_MVE)
    // Byte by byte: a pair may begin at any address.
    const auto at = bits_as<uint32x4_t>(offsets);
    const auto pixels = [&](const std::uint8_t* from) { return vldrbq_gather_offset_u32(from, at); };
    uint32x4_t cells = vsliq_n_u32(pixels(first), pixels(first + 1), 8);
    cells = vsliq_n_u32(cells, pixels(first + stride), 16);
    return bits_as<Ints>(vsliq_n_u32(cells, pixels(first + stride + 1), 24));
#else
    std::int32_t at[places];
    std::int32_t cells[places];
    store_ints(offsets, at);
    for (int i = 0; i < places; ++i) {
        const std::uint8_t* above = first + at[i];
        cells[i] = static_cast<std::int32_t>(pair_at(above) | pair_at(above + stride) << 16);
    }
    return load_ints(cells);
#endif
}

/// The pixels at offsets.
[[gnu::always_inline]] inline Ints pixels_at(const std::uint8_t* first, Ints offsets) {
#if FOVEA_BYTES == 32 && defined(__AVX2__)
    // Four bytes that end at the pixel, or the first four of the image, which has as many.
    const Ints start = offsets > 3 ? offsets - 3 : Ints{};
    const Ints fours = gather(first, start);
    const Ints drop = (offsets - start) << 3;
    return bits_as<Ints>(_mm256_srlv_epi32(bits_as<__m256i>(fours), bits_as<__m256i>(drop))) & 255;
#elif FOVEA_BYTES == 16 && defined(__ARM_FEATURE_MVE)
    return bits_as<Ints>(vldrbq_gather_offset_u32(first, bits_as<uint32x4_t>(offsets)));
#else
    std::int32_t at[places];
    std::int32_t pixels[places];
    store_ints(offsets, at);
    for (int i = 0; i < places; ++i) pixels[i] = first[at[i]];
    return load_ints(pixels);
#endif
}

/// Cells weighed by right and down, 0..256.
[[gnu::always_inline]] inline Ints blend_lanes(Ints cell, Ints right, Ints down) {
    // The row above in the lower halves, the row below in the upper ones; at most 255 * 256, modulo 2^16.
    const RawWords a = bits_as<RawWords>(cell) & 255;
    const RawWords b = bits_as<RawWords>(cell) >> 8;
    const RawWords across = bits_as<RawWords>(right | (right << 16));
    const RawWords rows = (a << 8) + (b - a) * across;
    // Signed products: 32768 is taken from both rows, and 32768 * 256 given back with the rounding.
    const Ints both = (256 - down) | (down << 16);
    return (pair_sums(bits_as<Ints>(rows ^ 0x8000), both) + 32768 * 257) >> 16;
}

/// Cells weighed by the low bytes of x and y.
[[gnu::always_inline]] inline Ints blend_parts(Ints cell, Ints x, Ints y) {
#if FOVEA_BYTES == 32 && defined(__AVX2__)
    const __m256i four_times =
        _mm256_set_epi32(0x0c0c0c0c, 0x08080808, 0x04040404, 0, 0x0c0c0c0c, 0x08080808, 0x04040404, 0);
    const __m256i twice = _mm256_or_si256(four_times, _mm256_set1_epi16(-0x8000));
    const __m256i low = _mm256_set1_epi16(255);
    const __m256i cells = bits_as<__m256i>(cell);
    // 255 - right and right, times pixels less 128; then the 256th part of the left pixel.
    const __m256i across = _mm256_xor_si256(_mm256_shuffle_epi8(bits_as<__m256i>(x), four_times), low);
    const __m256i products = _mm256_maddubs_epi16(across, _mm256_xor_si256(cells, _mm256_set1_epi8(-128)));
    const __m256i rows = _mm256_add_epi16(products, _mm256_and_si256(cells, low));
    // 256 - down as -1 - down + 257, and down.
    const __m256i down = _mm256_shuffle_epi8(bits_as<__m256i>(y), twice);
    const __m256i both =
        _mm256_add_epi16(_mm256_xor_si256(down, _mm256_set1_epi32(0xffff)), _mm256_set1_epi32(257));
    // 32640 was taken from both rows.
    return (pair_sums(bits_as<Ints>(rows), bits_as<Ints>(both)) + (32640 * 256 + 32768)) >> 16;
#else
    return blend_lanes(cell, x & 255, y & 255);
#endif
}

/// The pixels at places that all have a pixel on their right and one below.
struct BlendInside {
    const std::uint8_t* first;
    std::ptrdiff_t step;
    Ints stride;

    [[gnu::always_inline]] explicit BlendInside(const CellSource& src)
        : first(src.first), step(src.stride), stride(all_ints(static_cast<std::int32_t>(src.stride))) {}
    [[gnu::always_inline]] Ints operator()(Ints x, Ints y) const {
        const Ints cells = cells_at(first, step, pair_sums(y >> 8, stride) + (x >> 8));
        return blend_parts(cells, x, y);
    }
};

/// The pixels at any places.
struct BlendAnywhere {
    const CellSource src;
    Ints last_x = all_ints(256 * (src.width - 1));
    Ints last_y = all_ints(256 * (src.height - 1));
    Ints last_left = all_ints(src.width - 2);
    Ints last_top = all_ints(src.height - 2);
    Ints stride = all_ints(static_cast<std::int32_t>(src.stride));
    Ints level = all_ints(src.level);

    [[gnu::always_inline]] Ints operator()(Ints x, Ints y) const {
        const Ints held_x = held(x, last_x);
        const Ints held_y = held(y, last_y);
        Ints left = held_x >> 8;
        Ints top = held_y >> 8;
        left = left < last_left ? left : last_left;
        top = top < last_top ? top : last_top;
        const Ints cells = cells_at(src.first, src.stride, pair_sums(top, stride) + left);
        const Ints blended = blend_lanes(cells, held_x - (left << 8), held_y - (top << 8));
        const Ints outside = outside_lanes(src, x, y);
        return (outside & level) | (~outside & blended);
    }
};

/// dst[i] = sample(x, y) at the first count places of a run.
template <class Sample>
[[gnu::always_inline]] inline void sample_run(const PlaceRun& run, int count, Sample sample,
                                              std::uint8_t* dst) {
    // Whole vectors beside dst where they would reach beyond it.
    std::uint8_t beside[run_length];
    std::uint8_t* to = count % FOVEA_BYTES == 0 ? dst : beside;
    for (int i = 0; i < count; i += FOVEA_BYTES) {
        const auto lanes_from = [&](int k) { return sample(load_ints(run.x + k), load_ints(run.y + k)); };
        const RawBytes pixels = lowest_bytes(lanes_from(i), lanes_from(i + places),
                                             lanes_from(i + 2 * places), lanes_from(i + 3 * places));
        std::memcpy(to + i, &pixels, sizeof pixels);
    }
    if (to != dst) std::memcpy(dst, beside, static_cast<std::size_t>(count));
}

/// Whether CellSource::well_inside() for all places of a run.
[[gnu::always_inline]] inline bool all_inside(const CellSource& src, int count, const PlaceRun& run) {
    if (src.width < 3 || src.height < 3) return false;
    const Unsigned last_x = Unsigned{} + static_cast<std::uint32_t>(256 * (src.width - 2) - 1);
    const Unsigned last_y = Unsigned{} + static_cast<std::uint32_t>(256 * (src.height - 2) - 1);
    // The sign of one of the two differences tells, also where the other one wraps.
    Unsigned signs_x{};
    Unsigned signs_y{};
    for (int i = 0; i < count; i += places) {
        const auto x = bits_as<Unsigned>(load_ints(run.x + i));
        const auto y = bits_as<Unsigned>(load_ints(run.y + i));
        signs_x |= (x - 256) | (last_x - x);
        signs_y |= (y - 256) | (last_y - y);
    }
    std::int32_t lanes_of[places];
    store_ints(bits_as<Ints>(signs_x | signs_y), lanes_of);
    std::int32_t sign = 0;
    for (const std::int32_t one : lanes_of) sign |= one;
    return sign >= 0;
}

/// blend_cell() at the first count places of a run, which is filled up.
inline void blend_cells(const CellSource& src, PlaceRun& run, int count, PlaceOrder order,
                        std::uint8_t* dst) {
    if (!src.fits_vectors) {
        for (int i = 0; i < count; ++i) dst[i] = blend_cell(src, run.x[i], run.y[i]);
        return;
    }
    const int last = count - 1;
    if (order == PlaceOrder::along_a_line && src.all_outside(run.x[0], run.y[0], run.x[last], run.y[last])) {
        std::memset(dst, src.level, static_cast<std::size_t>(count));
        return;
    }
    // What fills up the last vector lies like the last place.
    for (int i = count; i % FOVEA_BYTES != 0; ++i) {
        run.x[i] = run.x[last];
        run.y[i] = run.y[last];
    }
    const bool inside = order == PlaceOrder::along_a_line
                            ? src.well_inside(run.x[0], run.y[0]) && src.well_inside(run.x[last], run.y[last])
                            : all_inside(src, count, run);
    if (inside)
        sample_run(run, count, BlendInside{src}, dst);
    else
        sample_run(run, count, BlendAnywhere{src}, dst);
}

/// The pixels nearest to any places.
struct NearestAnywhere {
    const CellSource src;
    Ints last_x = all_ints(256 * (src.width - 1));
    Ints last_y = all_ints(256 * (src.height - 1));
    Ints stride = all_ints(static_cast<std::int32_t>(src.stride));
    Ints level = all_ints(src.level);

    [[gnu::always_inline]] Ints operator()(Ints x, Ints y) const {
        const Ints column = (held(x, last_x) + 128) >> 8;
        const Ints row = (held(y, last_y) + 128) >> 8;
        const Ints pixels = pixels_at(src.first, pair_sums(row, stride) + column);
        const Ints outside = outside_lanes(src, x, y);
        return (outside & level) | (~outside & pixels);
    }
};

/// nearest_cell() at the first count places of a run, which is filled up.
inline void nearest_cells(const CellSource& src, PlaceRun& run, int count, std::uint8_t* dst) {
    if (!src.fits_vectors) {
        for (int i = 0; i < count; ++i) dst[i] = nearest_cell(src, run.x[i], run.y[i]);
        return;
    }
    for (int i = count; i % FOVEA_BYTES != 0; ++i) run.x[i] = run.y[i] = 0;
    sample_run(run, count, NearestAnywhere{src}, dst);
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
