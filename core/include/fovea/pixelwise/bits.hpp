// SPDX-License-Identifier: MIT
//
// Binary images of one bit a pixel: made of bytes, turned into bytes, combined, counted.
#pragma once

#include <cstdint>
#include <cstring>

#include <fovea/base/status.hpp>
#include <fovea/image/bit_view.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/simd/bits.hpp>
#include <fovea/simd/isa.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

inline namespace FOVEA_ISA {

/// Sets the bits of the pixels that are level or brighter; those that are not 0 unless told.
///
/// Shapes   src and dst equal, 1x1 or larger
/// Overlap  none
/// Errors   empty_image, size_mismatch
inline Status pack_bits(ImageView<const Gray8> src, Gray8 level, BitView<BitWord> dst);
inline Status pack_bits(ImageView<const Gray8> src, BitView<BitWord> dst) { return pack_bits(src, 1, dst); }

/// 255 for every bit that is set, 0 for the others. All else as pack_bits().
inline Status unpack_bits(BitView<const BitWord> src, ImageView<Gray8> dst);

/// Bit by bit; dst = a and not b of the last one.
///
/// Shapes   all equal, 1x1 or larger
/// Overlap  dst may be a or b
/// Errors   empty_image, size_mismatch
inline Status bitwise_and(BitView<const BitWord> a, BitView<const BitWord> b, BitView<BitWord> dst);
inline Status bitwise_or(BitView<const BitWord> a, BitView<const BitWord> b, BitView<BitWord> dst);
inline Status bitwise_xor(BitView<const BitWord> a, BitView<const BitWord> b, BitView<BitWord> dst);
inline Status bitwise_and_not(BitView<const BitWord> a, BitView<const BitWord> b, BitView<BitWord> dst);

/// The other value of every pixel. All else as bitwise_and().
inline Status invert(BitView<const BitWord> src, BitView<BitWord> dst);

/// How many pixels are set.
///
/// Errors  empty_image
inline Result<std::int64_t> count_bits(BitView<const BitWord> src);

}  // namespace FOVEA_ISA

// ---- Implementation ---------------------------------------------------------------

inline namespace FOVEA_ISA {
namespace kernels {

inline void pack_row(const Gray8* src, int width, Gray8 level, BitWord* dst) {
    int x = 0;
    for (; x + bits_a_word <= width; x += bits_a_word)
        dst[x / bits_a_word] = simd::bits_at_least(src + x, level);
    if (x == width) return;
    Gray8 rest[bits_a_word] = {};
    std::memcpy(rest, src + x, static_cast<std::size_t>(width - x));
    dst[x / bits_a_word] = simd::bits_at_least(rest, level) & last_bits(width);
}

inline void unpack_row(const BitWord* src, int width, Gray8* dst) {
    int x = 0;
    for (; x + bits_a_word <= width; x += bits_a_word) simd::spread_bits(src[x / bits_a_word], dst + x);
    if (x == width) return;
    Gray8 rest[bits_a_word];
    simd::spread_bits(src[x / bits_a_word], rest);
    std::memcpy(dst + x, rest, static_cast<std::size_t>(width - x));
}

/// dst = of(a, b), word by word; zeros behind the last pixel.
template <class Of>
Status combine_bits(BitView<const BitWord> a, BitView<const BitWord> b, Of of, BitView<BitWord> dst) {
    if (a.empty() || b.empty() || dst.empty()) return Status::empty_image;
    if (b.size() != a.size() || dst.size() != a.size()) return Status::size_mismatch;
    const int words = bit_words(a.width());
    const BitWord last = last_bits(a.width());
    for (int y = 0; y < a.height(); ++y) {
        const BitWord* from = a.row(y);
        const BitWord* other = b.row(y);
        BitWord* to = dst.row(y);
        for (int i = 0; i < words; ++i) to[i] = of(from[i], other[i]);
        to[words - 1] &= last;
    }
    return Status::ok;
}

/// The bits that are set, by sums of ever longer fields.
constexpr std::uint32_t bits_set(BitWord word) {
    word -= word >> 1 & 0x55555555u;
    word = (word & 0x33333333u) + (word >> 2 & 0x33333333u);
    word = (word + (word >> 4)) & 0x0f0f0f0fu;
    return word * 0x01010101u >> 24;
}

}  // namespace kernels

inline Status pack_bits(ImageView<const Gray8> src, Gray8 level, BitView<BitWord> dst) {
    if (src.empty() || dst.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    for (int y = 0; y < src.height(); ++y) kernels::pack_row(src.row(y), src.width(), level, dst.row(y));
    return Status::ok;
}

inline Status unpack_bits(BitView<const BitWord> src, ImageView<Gray8> dst) {
    if (src.empty() || dst.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    for (int y = 0; y < src.height(); ++y) kernels::unpack_row(src.row(y), src.width(), dst.row(y));
    return Status::ok;
}

inline Status bitwise_and(BitView<const BitWord> a, BitView<const BitWord> b, BitView<BitWord> dst) {
    return kernels::combine_bits(
        a, b, [](BitWord p, BitWord q) { return p & q; }, dst);
}
inline Status bitwise_or(BitView<const BitWord> a, BitView<const BitWord> b, BitView<BitWord> dst) {
    return kernels::combine_bits(
        a, b, [](BitWord p, BitWord q) { return p | q; }, dst);
}
inline Status bitwise_xor(BitView<const BitWord> a, BitView<const BitWord> b, BitView<BitWord> dst) {
    return kernels::combine_bits(
        a, b, [](BitWord p, BitWord q) { return p ^ q; }, dst);
}
inline Status bitwise_and_not(BitView<const BitWord> a, BitView<const BitWord> b, BitView<BitWord> dst) {
    return kernels::combine_bits(
        a, b, [](BitWord p, BitWord q) { return p & ~q; }, dst);
}
inline Status invert(BitView<const BitWord> src, BitView<BitWord> dst) {
    return kernels::combine_bits(
        src, src, [](BitWord p, BitWord) { return ~p; }, dst);
}

inline Result<std::int64_t> count_bits(BitView<const BitWord> src) {
    if (src.empty()) return Status::empty_image;
    const int whole = bit_words(src.width()) - 1;
    const BitWord last = last_bits(src.width());
    std::int64_t count = 0;
    for (int y = 0; y < src.height(); ++y) {
        const BitWord* row = src.row(y);
        std::uint32_t in_row = kernels::bits_set(row[whole] & last);
        for (int i = 0; i < whole; ++i) in_row += kernels::bits_set(row[i]);
        count += in_row;
    }
    return count;
}

}  // namespace FOVEA_ISA
}  // namespace fovea
