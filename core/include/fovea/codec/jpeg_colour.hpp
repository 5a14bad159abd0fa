// SPDX-License-Identifier: MIT
//
// Rows of samples of a JPEG picture to rows of pixels: chroma brought to full size, and YCbCr to RGB.
#pragma once

#include <cstdint>

#include <fovea/image/pixel.hpp>
#include <fovea/number/integer.hpp>

namespace fovea::jpeg {

// ---- Interface --------------------------------------------------------------------

/// The triangle filter for twice as many columns: every new sample is 3/4 of the nearer and 1/4 of the
/// farther old one. Writes 2 * width samples.
///
/// Rounding  to the nearest; ties down in even columns, up in odd ones
/// Border    the outermost samples repeat; one or two columns are only repeated, as the widespread decoders
///           do
/// Source    linear interpolation between samples that stand as in ITU-T T.871: centred on the pixels
///           they cover
inline void upsample_across(const std::uint8_t* src, int width, std::uint8_t* dst);

/// On which side of the nearer old row the farther one is.
enum class Farther : std::uint8_t { above, below };

/// The triangle filter for twice as many rows: one row, 3/4 of the nearer and 1/4 of the farther old one.
///
/// Rounding  to the nearest; ties down if the farther row is above, else up
inline void upsample_down(const std::uint8_t* nearer, const std::uint8_t* farther, Farther side, int width,
                          std::uint8_t* dst);

/// Both filters in one: a row of 2 * width samples.
///
/// Rounding  once, to the nearest; ties up in even columns, down in odd ones
/// Border    as upsample_across(); of one or two columns the nearer row alone is repeated
inline void upsample_both(const std::uint8_t* nearer, const std::uint8_t* farther, int width,
                          std::uint8_t* dst);

/// YCbCr to RGB: red = Y + 1.402 Cr, green = Y - 0.344136 Cb - 0.714136 Cr, blue = Y + 1.772 Cb, with 128
/// taken off both chromas, held at 0..255.
///
/// Rounding  to the nearest, ties up; the factors are rounded to 1/65536
/// Source    ITU-T T.871 clause 7
inline void colour_row(const std::uint8_t* luma, const std::uint8_t* blue, const std::uint8_t* red, int width,
                       Rgb888* dst);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Sources no wider than this are repeated instead of filtered.
inline constexpr int repeated_width = 2;

inline void repeat_across(const std::uint8_t* src, int width, std::uint8_t* dst) {
    for (int i = 0; i < width; ++i) dst[2 * i] = dst[2 * i + 1] = src[i];
}

}  // namespace detail

inline void upsample_across(const std::uint8_t* src, int width, std::uint8_t* dst) {
    const auto put = [&](int i, int left, int right) {
        dst[2 * i] = static_cast<std::uint8_t>((3 * src[i] + src[left] + 1) >> 2);
        dst[2 * i + 1] = static_cast<std::uint8_t>((3 * src[i] + src[right] + 2) >> 2);
    };
    if (width <= detail::repeated_width) return detail::repeat_across(src, width, dst);
    put(0, 0, 1);
    for (int i = 1; i < width - 1; ++i) put(i, i - 1, i + 1);
    put(width - 1, width - 2, width - 1);
}

inline void upsample_down(const std::uint8_t* nearer, const std::uint8_t* farther, Farther side, int width,
                          std::uint8_t* dst) {
    const int half = side == Farther::above ? 1 : 2;
    for (int i = 0; i < width; ++i)
        dst[i] = static_cast<std::uint8_t>((3 * nearer[i] + farther[i] + half) >> 2);
}

inline void upsample_both(const std::uint8_t* nearer, const std::uint8_t* farther, int width,
                          std::uint8_t* dst) {
    const auto sum = [&](int i) { return 3 * nearer[i] + farther[i]; };
    const auto put = [&](int i, int left, int right) {
        dst[2 * i] = static_cast<std::uint8_t>((3 * sum(i) + sum(left) + 8) >> 4);
        dst[2 * i + 1] = static_cast<std::uint8_t>((3 * sum(i) + sum(right) + 7) >> 4);
    };
    if (width <= detail::repeated_width) return detail::repeat_across(nearer, width, dst);
    put(0, 0, 1);
    for (int i = 1; i < width - 1; ++i) put(i, i - 1, i + 1);
    put(width - 1, width - 2, width - 1);
}

namespace detail {

inline constexpr int colour_bits = 16;
inline constexpr std::int32_t one = 1 << colour_bits;
// 1.402, 0.344136, 0.714136 and 1.772 in 1/65536.
inline constexpr std::int32_t red_from_red = 91881;
inline constexpr std::int32_t green_from_blue = 22554;
inline constexpr std::int32_t green_from_red = 46802;
inline constexpr std::int32_t blue_from_blue = 116130;

/// Whole multiples of a chroma are added apart, so that what is left to multiply has 16 bits.
[[gnu::always_inline]] inline Rgb888 colour_of(std::uint8_t luma, std::uint8_t blue, std::uint8_t red) {
    const auto b = static_cast<std::int16_t>(blue - 128);
    const auto r = static_cast<std::int16_t>(red - 128);
    const auto rounded = [](std::int32_t sum) {
        return static_cast<std::int16_t>(round_shift(sum, colour_bits));
    };
    // In 16 bits and not in int, so that twice as many fit a vector; -255 - 255 to 3 * 255 at most.
    const auto held = [](std::int32_t level) {
        return static_cast<std::uint8_t>(clamp<std::int16_t>(static_cast<std::int16_t>(level), 0, 255));
    };
    return {held(luma + r + rounded((red_from_red - one) * r)),
            held(luma - r + rounded((one - green_from_red) * r - green_from_blue * b)),
            held(luma + 2 * b + rounded((blue_from_blue - 2 * one) * b))};
}

}  // namespace detail

inline void colour_row(const std::uint8_t* luma, const std::uint8_t* blue, const std::uint8_t* red, int width,
                       Rgb888* dst) {
    // First the colours in planes and then their bytes in turn: compilers turn the former into vectors.
    constexpr int chunk = 32;
    std::uint8_t level[3][chunk];
    int x = 0;
    for (; x + chunk <= width; x += chunk) {
        for (int i = 0; i < chunk; ++i) {
            const Rgb888 colour = detail::colour_of(luma[x + i], blue[x + i], red[x + i]);
            level[0][i] = colour.red;
            level[1][i] = colour.green;
            level[2][i] = colour.blue;
        }
        for (int i = 0; i < chunk; ++i) dst[x + i] = {level[0][i], level[1][i], level[2][i]};
    }
    for (; x < width; ++x) dst[x] = detail::colour_of(luma[x], blue[x], red[x]);
}

}  // namespace fovea::jpeg
