// SPDX-License-Identifier: MIT
//
// What every picture format has in common: what a file holds before it is decoded, and how its samples become
// the caller's pixels.
#pragma once

#include <cstdint>

#include <fovea/image/geometry.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/pixelwise/to_gray.hpp>

namespace fovea {

/// The pixel type that holds a picture without loss.
enum class PictureContent : std::uint8_t { gray8, gray16, rgb888, rgb48 };

/// What a picture file says about itself. scratch_bytes is what its decoder needs for this file.
struct PictureInfo {
    Size size;
    PictureContent content = PictureContent::gray8;
    std::int64_t scratch_bytes = 0;
};

/// A brightness sample 0..most as a pixel: scaled to 0..255 for Gray8, to 0..65535 for Gray16, and the same
/// in three channels for Rgb888. most is 1..65535; larger samples count as most.
///
/// Rounding  nearest, ties up
template <class Pixel>
constexpr Pixel pixel_of_gray(std::uint32_t sample, std::uint32_t most);

/// A colour 0..255 a channel as a pixel: its brightness for Gray8, that times 257 for Gray16.
template <class Pixel>
constexpr Pixel pixel_of_colour(Rgb888 colour);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

constexpr std::uint32_t scale_sample(std::uint32_t sample, std::uint32_t most, std::uint32_t full) {
    const std::uint32_t held = minimum(sample, most);
    if (most == full) return held;
    // At most 65535 * 65535 + 32767, which fits 32 bits.
    return (held * full + most / 2) / most;
}

}  // namespace detail

template <class Pixel>
constexpr Pixel pixel_of_gray(std::uint32_t sample, std::uint32_t most) {
    if constexpr (sizeof(Pixel) == sizeof(Rgb888)) {
        const auto level = static_cast<std::uint8_t>(detail::scale_sample(sample, most, 255));
        return Rgb888{level, level, level};
    } else {
        return static_cast<Pixel>(detail::scale_sample(sample, most, sizeof(Pixel) == 1 ? 255 : 65535));
    }
}

template <class Pixel>
constexpr Pixel pixel_of_colour(Rgb888 colour) {
    if constexpr (sizeof(Pixel) == sizeof(Rgb888))
        return colour;
    else
        return static_cast<Pixel>(gray_of(colour) * (sizeof(Pixel) == 1 ? 1 : 257));
}

}  // namespace fovea
