// SPDX-License-Identifier: MIT
//
// Colour in 16 bits, as small cameras and displays have it.
#pragma once

#include <cstdint>
#include <cstring>

#include <fovea/base/status.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/pixelwise/convert_frame.hpp>
#include <fovea/pixelwise/to_gray.hpp>
#include <fovea/simd/backend.hpp>
#include <fovea/simd/halves.hpp>
#include <fovea/simd/interleave.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>
#include <fovea/simd/unroll.hpp>
#include <fovea/simd/weighed_words.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The colour of a 16-bit pixel: the 5 or 6 bits of each part, and its highest bits once more below them, so
/// that 0 stays 0 and all ones become 255.
///
/// Rounding  less than a level from 255 / 31 or 255 / 63 of a part
/// Source    the definition of the format; the low bits as displays make them
constexpr Rgb888 rgb_of_rgb565(Rgb565 colour);

inline namespace FOVEA_ISA {

/// rgb_of_rgb565() of every pixel. A sensor that sends the high byte first to a machine that has the low one
/// first must be told to swap.
///
/// Shapes   src and dst equal, 1x1 or larger
/// Overlap  none: dst must not share pixels with src
/// Errors   empty_image, size_mismatch
/// Source   the definition of the format
inline Status rgb565_to_rgb(ImageView<const Rgb565> src, ImageView<Rgb888> dst);

/// The brightness of every pixel: gray_of() of rgb_of_rgb565(). All else as above.
inline Status rgb565_to_gray(ImageView<const Rgb565> src, ImageView<Gray8> dst);

}  // namespace FOVEA_ISA

// ---- Implementation ---------------------------------------------------------------

constexpr Rgb888 rgb_of_rgb565(Rgb565 colour) {
    const auto five = [](int part) { return static_cast<std::uint8_t>(part << 3 | part >> 2); };
    const int green = colour >> 5 & 63;
    return {five(colour >> 11), static_cast<std::uint8_t>(green << 2 | green >> 4), five(colour & 31)};
}

inline namespace FOVEA_ISA {

namespace kernels {

/// The colours of lanes 16-bit pixels.
[[gnu::always_inline]] inline simd::ByteTriples rgb565_lanes(const std::uint8_t* from) {
    using simd::Bytes;
    constexpr bool big_endian = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__;
    const simd::BytePairs pairs = simd::load_pairs(from);
    const Bytes high = big_endian ? pairs.first : pairs.second;
    const Bytes low = big_endian ? pairs.second : pairs.first;
    const Bytes red = high & Bytes::all(0xf8);
    const Bytes green = (high << 5) | ((low >> 3) & Bytes::all(0x1c));
    const Bytes blue = low << 3;
    return {red | (red >> 5), green | (green >> 6), blue | (blue >> 5)};
}

/// rgb565_to_rgb() of one row.
inline void rgb_from_rgb565_row(const Rgb565* src, int width, Rgb888* dst) {
    simd::for_each_step<2, 3>(
        reinterpret_cast<const std::uint8_t*>(src), width, &dst->red,
        [](const std::uint8_t* from, std::uint8_t* to) { simd::store_triples(rgb565_lanes(from), to); });
}

#if FOVEA_BYTES >= 16
/// The brightness of half a vector. 33 / 4 of 5 bits and 65 / 16 of 6, rounded down, are the bits and their
/// highest once more.
[[gnu::always_inline]] inline simd::RawWords gray_of_rgb565(simd::RawWords colour) {
    const simd::RawWords red = simd::times_high(colour & 0xf800, 33 << 3);
    const simd::RawWords green = simd::times_high(colour & 0x07e0, 65 << 7);
    const simd::RawWords blue = simd::times_high(colour << 11, 33 << 3);
    return simd::weigh_words(red, green, blue, detail::gray_weights);
}
#else
/// What the two bytes of a colour add to its brightness, times 2^15 and with half of that: the parts of green
/// in each are independent of one another.
struct GrayOfHalves {
    std::uint32_t high[256];
    std::uint32_t low[256];
};
constexpr GrayOfHalves make_gray_of_halves() {
    GrayOfHalves halves{};
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
        const Rgb888 high = rgb_of_rgb565(static_cast<Rgb565>(byte << 8));
        const Rgb888 low = rgb_of_rgb565(static_cast<Rgb565>(byte));
        const auto sum = [](Rgb888 colour) {
            constexpr simd::TripleWeights weights = detail::gray_weights;
            return static_cast<std::uint32_t>(weights.first * colour.red + weights.second * colour.green +
                                              weights.third * colour.blue);
        };
        halves.high[byte] = sum(high) + (1u << 14);
        halves.low[byte] = sum(low);
    }
    return halves;
}
inline constexpr GrayOfHalves gray_of_halves = make_gray_of_halves();
#endif

/// rgb565_to_gray() of one row.
inline void gray_from_rgb565_row(const Rgb565* src, int width, Gray8* dst) {
#if FOVEA_BYTES >= 16
    simd::for_each_step<2, 1>(reinterpret_cast<const std::uint8_t*>(src), width, dst,
                              [](const std::uint8_t* from, std::uint8_t* to) {
                                  simd::RawWords first;
                                  simd::RawWords second;
                                  std::memcpy(&first, from, sizeof first);
                                  std::memcpy(&second, from + sizeof first, sizeof second);
                                  simd::narrowed(gray_of_rgb565(first), gray_of_rgb565(second)).store(to);
                              });
#else
    const auto gray = [](Rgb565 colour) {
        return static_cast<Gray8>((gray_of_halves.high[colour >> 8] + gray_of_halves.low[colour & 255]) >>
                                  15);
    };
    int x = 0;
    for (; x + 4 <= width; x += 4) simd::unroll<4>([&](auto i) { dst[x + i] = gray(src[x + i]); });
    for (; x < width; ++x) dst[x] = gray(src[x]);
#endif
}

}  // namespace kernels

inline Status rgb565_to_rgb(ImageView<const Rgb565> src, ImageView<Rgb888> dst) {
    return detail::convert_frame(src, dst, kernels::rgb_from_rgb565_row);
}

inline Status rgb565_to_gray(ImageView<const Rgb565> src, ImageView<Gray8> dst) {
    return detail::convert_frame(src, dst, kernels::gray_from_rgb565_row);
}

}  // namespace FOVEA_ISA
}  // namespace fovea
