// SPDX-License-Identifier: MIT
//
// A rendered back-lit part of known size: a plate with a cut corner and round holes, anti-aliased, blurred,
// noisy and turned. Integers alone, so that the picture is the same on every machine.
#pragma once

#include <cstdint>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/number/angle.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/int128.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/number/trigonometry.hpp>

#include <common/picture_file.hpp>

namespace fovea::apps {

/// A round hole in the frame of a plate.
struct RoundHole {
    FinePixel x, y, radius;
};

/// A plate about the middle of its rectangle, x along it, and the picture it is shown in.
struct PartScene {
    Size size{640, 480};
    FinePixel length = FinePixel::from_int(360);
    FinePixel height = FinePixel::from_int(140);
    FinePixel cut_x = FinePixel::from_int(60);  ///< of the corner at +x, +y
    FinePixel cut_y = FinePixel::from_int(40);
    std::vector<RoundHole> holes = {
        {FinePixel::from_int(100), FinePixel::from_int(-4), FinePixel::from_int(30)},
        {FinePixel::from_int(-96), FinePixel::from_int(8), FinePixel::from_int(18)}};
    FinePoint middle{FinePixel::from_int(320), FinePixel::from_int(240)};
    FineAngle angle = FineAngle::from_microdegrees(17000000);
    Gray8 part_level = 30;
    Gray8 ground_level = 215;
    std::int64_t blur = 1000000;   ///< standard deviation of the lens in millionths of a pixel
    std::int64_t noise = 4000000;  ///< of the sensor in millionths of a grey level
    std::uint64_t seed = 1;
};

/// Renders a scene.
///
/// Every pixel near an edge is sampled at 16 x 16 points; the lens is a row of three-point averages, which
/// tends to a Gaussian; the noise of a pixel is the sum of twelve random numbers.
Picture<Gray8> render(const PartScene& scene);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// True if a place of the picture, in 1/65536 px, lies on the plate.
inline bool on_plate(const PartScene& scene, UnitVector axis, std::int64_t x, std::int64_t y) {
    const std::int64_t u = x - scene.middle.x.raw();
    const std::int64_t v = y - scene.middle.y.raw();
    // Offsets of 32 bits times 31 fit.
    const std::int64_t s = (u * axis.x.raw() + v * axis.y.raw()) >> Unit::fraction_bits;
    const std::int64_t t = (v * axis.x.raw() - u * axis.y.raw()) >> Unit::fraction_bits;
    if (2 * std::abs(s) > scene.length.raw() || 2 * std::abs(t) > scene.height.raw()) return false;
    const std::int64_t in_s = scene.length.raw() / 2 - s;
    const std::int64_t in_t = scene.height.raw() / 2 - t;
    if (in_s * scene.cut_y.raw() + in_t * scene.cut_x.raw() <
        std::int64_t{scene.cut_x.raw()} * scene.cut_y.raw())
        return false;
    for (const RoundHole& hole : scene.holes) {
        const std::int64_t a = s - hole.x.raw();
        const std::int64_t b = t - hole.y.raw();
        if (a * a + b * b < std::int64_t{hole.radius.raw()} * hole.radius.raw()) return false;
    }
    return true;
}

/// The covered part of a pixel, 0 to 65536.
inline std::int32_t coverage(const PartScene& scene, UnitVector axis, int x, int y) {
    constexpr int over = 16;
    constexpr std::int64_t one = FinePixel::one;
    const std::int64_t left = x * one - one / 2;
    const std::int64_t top = y * one - one / 2;
    int corners = 0;
    for (int i = 0; i < 9; ++i)
        corners += on_plate(scene, axis, left + i % 3 * one / 2, top + i / 3 * one / 2) ? 1 : 0;
    if (corners == 0 || corners == 9) return corners == 0 ? 0 : FinePixel::one;
    int hits = 0;
    for (int i = 0; i < over * over; ++i)
        hits += on_plate(scene, axis, left + (2 * (i % over) + 1) * one / (2 * over),
                         top + (2 * (i / over) + 1) * one / (2 * over))
                    ? 1
                    : 0;
    return hits * (FinePixel::one / (over * over));
}

/// One three-point average along a line of values: v + share (left - 2 v + right), the ends repeated.
inline void average_three(std::int32_t* values, int count, std::ptrdiff_t step, std::int64_t share) {
    std::int32_t before = values[0];
    for (int i = 0; i < count; ++i) {
        const std::int32_t here = values[i * step];
        const std::int32_t behind = values[(i + 1 < count ? i + 1 : i) * step];
        const std::int64_t bend = std::int64_t{before} - 2 * std::int64_t{here} + behind;
        values[i * step] = static_cast<std::int32_t>(here + round_shift(bend * share, 16));
        before = here;
    }
}

/// A Gaussian of that standard deviation: each average adds twice its share to the variance.
inline void blur(std::vector<std::int32_t>& values, Size size, std::int64_t deviation) {
    const std::int64_t variance = multiply_divide(deviation, deviation, 1000000);  // in millionths
    if (variance == 0) return;
    const auto rounds = static_cast<int>(variance / 400000) + 4;
    const std::int64_t share = multiply_divide(variance, 65536, std::int64_t{2000000} * rounds);
    for (int round = 0; round < rounds; ++round) {
        for (int y = 0; y < size.height; ++y)
            average_three(values.data() + std::ptrdiff_t{y} * size.width, size.width, 1, share);
        for (int x = 0; x < size.width; ++x) average_three(values.data() + x, size.height, size.width, share);
    }
}

}  // namespace detail

inline Picture<Gray8> render(const PartScene& scene) {
    const UnitVector axis = unit_vector(scene.angle);
    std::vector<std::int32_t> covered(static_cast<std::size_t>(scene.size.area()));
    std::size_t at = 0;
    for (int y = 0; y < scene.size.height; ++y)
        for (int x = 0; x < scene.size.width; ++x) covered[at++] = detail::coverage(scene, axis, x, y);
    detail::blur(covered, scene.size, scene.blur);

    Picture<Gray8> picture(scene.size);
    Random random(scene.seed);
    for (std::size_t i = 0; i < covered.size(); ++i) {
        std::int64_t noise = -6 * 65536;  // the sum of twelve has the variance 1
        for (int k = 0; k < 12 && scene.noise > 0; ++k) noise += random.next() >> 16;
        const std::int64_t level = std::int64_t{scene.ground_level} * 65536 +
                                   std::int64_t{covered[i]} * (scene.part_level - scene.ground_level) +
                                   multiply_divide(noise, scene.noise, 1000000);
        picture.pixels[i] = saturate_cast<Gray8>(round_shift(level, 16));
    }
    return picture;
}

}  // namespace fovea::apps
