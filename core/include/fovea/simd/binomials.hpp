// SPDX-License-Identifier: MIT
//
// Sums of three or five neighbours with the binomial coefficients, 1 2 1 and 1 4 6 4 1: of the rows at a
// column, and of the columns of a line.
#pragma once

#include <cstdint>

#include <fovea/simd/backend.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>
#include <fovea/simd/lines.hpp>

#if FOVEA_BYTES == 32 && defined(__AVX2__)
#include <immintrin.h>
#endif

namespace fovea {
inline namespace FOVEA_ISA {
namespace simd {

#if FOVEA_BYTES == 32 && defined(__AVX2__)

/// Pixels times 1..127: one instruction widens and multiplies.
template <int Factor>
[[gnu::always_inline]] inline Words products(Bytes bytes) {
    static_assert(Factor >= 1 && Factor <= 127, "factors are signed bytes");
    const auto pixels = bits_as<__m256i>(bytes.raw);
    return {bits_as<RawWords>(_mm256_maddubs_epi16(pixels, _mm256_set1_epi16(Factor))),
            bits_as<RawWords>(_mm256_maddubs_epi16(pixels, _mm256_set1_epi16(Factor << 8)))};
}
[[gnu::always_inline]] inline Words binomial(Bytes a, Bytes b, Bytes c) {
    return Words(a) + Words(c) + products<2>(b);
}
[[gnu::always_inline]] inline Words binomial(Bytes a, Bytes b, Bytes c, Bytes d, Bytes e) {
    return Words(a) + Words(e) + products<4>(b) + products<4>(d) + products<6>(c);
}

#else

/// a + 2 b + c, at most 4 * 255.
[[gnu::always_inline]] inline Words binomial(Bytes a, Bytes b, Bytes c) {
    return Words(a) + Words(c) + (Words(b) << 1);
}
/// a + 4 b + 6 c + 4 d + e, at most 16 * 255.
[[gnu::always_inline]] inline Words binomial(Bytes a, Bytes b, Bytes c, Bytes d, Bytes e) {
    return Words(a) + Words(e) + ((Words(b) + Words(c) + Words(d)) << 2) + (Words(c) << 1);
}

#endif

// Sums of two neighbours, of two such sums and so on have these coefficients; even and odd columns share
// those in the middle. All stay below 2^16.

/// 1 2 1 of a line's columns around each from x on, x even, and something added.
[[gnu::always_inline]] inline Words binomial_3(const WordLine& line, int x, std::uint16_t added) {
    const Words left = line.at<-1>(x);
    const Words here = line.at<0>(x);
    const Words right = line.at<1>(x);
    const RawWords middle = plus(plus(here.even, here.odd), all_words(added));
    return {plus(plus(left.even, here.even), middle), plus(plus(here.odd, right.odd), middle)};
}
/// 1 4 6 4 1 likewise.
[[gnu::always_inline]] inline Words binomial_5(const WordLine& line, int x, std::uint16_t added) {
    const Words left = line.at<-2>(x);
    const Words here = line.at<0>(x);
    const Words right = line.at<2>(x);
    const RawWords pair_1 = plus(left.even, left.odd);
    const RawWords pair_2 = plus(left.odd, here.even);
    const RawWords pair_3 = plus(here.even, here.odd);
    const RawWords pair_4 = plus(here.odd, right.even);
    const RawWords pair_5 = plus(right.even, right.odd);
    const RawWords triple_2 = plus(pair_2, pair_3);
    const RawWords triple_3 = plus(pair_3, pair_4);
    const RawWords middle = plus(plus(triple_2, triple_3), all_words(added));
    return {plus(plus(plus(pair_1, pair_2), triple_2), middle),
            plus(plus(triple_3, plus(pair_4, pair_5)), middle)};
}

}  // namespace simd
}  // namespace FOVEA_ISA
}  // namespace fovea
