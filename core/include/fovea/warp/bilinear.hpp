// SPDX-License-Identifier: MIT
//
// Bilinear sampling: the brightness between the pixels. Book sec. 2.9.2.
#pragma once

#include <cstdint>

#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// True if a place lies on the image: from the centre of the first pixel to that of the last, both included.
constexpr bool can_sample(Size size, FinePoint place);

/// The place on the image that is nearest to any place. The image must not be empty.
constexpr FinePoint nearest_sample(Size size, FinePoint place);

/// The brightness at a place between four pixels, weighed by its distance from them.
///
/// Units     place in pixels, answer in grey levels 0..255 with 16 fraction bits
/// Rounding  the place to 1/4096 px, the answer to 2^-16, nearest, ties up; all sums fit 32 bits
/// Errors    out_of_range unless can_sample()
/// Source    book sec. 2.9.2
inline Result<GrayLevel> sample_bilinear(ImageView<const Gray8> src, FinePoint place);

/// The same for a place that is known to lie on the image.
inline GrayLevel sample_bilinear_unchecked(ImageView<const Gray8> src, FinePoint place);

// ---- Implementation ---------------------------------------------------------------

constexpr bool can_sample(Size size, FinePoint place) {
    return place.x.raw() >= 0 && place.y.raw() >= 0 && !size.empty() &&
           place.x <= FinePixel::from_int(size.width - 1) && place.y <= FinePixel::from_int(size.height - 1);
}

constexpr FinePoint nearest_sample(Size size, FinePoint place) {
    return {
        FinePixel::from_raw(clamp<std::int32_t>(place.x.raw(), 0, FinePixel::from_int(size.width - 1).raw())),
        FinePixel::from_raw(
            clamp<std::int32_t>(place.y.raw(), 0, FinePixel::from_int(size.height - 1).raw()))};
}

inline GrayLevel sample_bilinear_unchecked(ImageView<const Gray8> src, FinePoint place) {
    FOVEA_ASSERT(can_sample(src.size(), place));
    constexpr int bits = 12;
    constexpr std::uint32_t one = 1u << bits;
    const std::int32_t x = round_shift(place.x.raw(), FinePixel::fraction_bits - bits);
    const std::int32_t y = round_shift(place.y.raw(), FinePixel::fraction_bits - bits);
    const std::uint32_t right = static_cast<std::uint32_t>(x) & (one - 1);
    const std::uint32_t down = static_cast<std::uint32_t>(y) & (one - 1);
    // On the last column and row the far weight is 0, so any pixel may stand there.
    const int left = x >> bits;
    const int top = y >> bits;
    const int next = right == 0 ? left : left + 1;
    const Gray8* above = src.row(top);
    const Gray8* below = src.row(down == 0 ? top : top + 1);
    const std::uint32_t upper = above[left] * (one - right) + above[next] * right;
    const std::uint32_t lower = below[left] * (one - right) + below[next] * right;
    const std::uint32_t value = upper * (one - down) + lower * down;  // at most 255 * 2^24
    constexpr int drop = 2 * bits - GrayLevel::fraction_bits;
    return GrayLevel::from_raw(static_cast<std::int32_t>((value + (1u << (drop - 1))) >> drop));
}

inline Result<GrayLevel> sample_bilinear(ImageView<const Gray8> src, FinePoint place) {
    if (!can_sample(src.size(), place)) return Status::out_of_range;
    return sample_bilinear_unchecked(src, place);
}

}  // namespace fovea
