// SPDX-License-Identifier: MIT
//
// A synthetic part, drawn in integers alone: a stamped plate with a cut corner and two round holes, as a lens
// would show it. Its true geometry is known, and every machine draws the same pixels.
#pragma once

#include <cstdint>

#include <fovea/base/random.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/integer.hpp>

namespace fovea::golden {

/// A plate in its own coordinates, in units of `scale` pixels about the middle of its rectangle, and where it
/// lies. The direction of its length is (cosine, sine) / hypotenuse, so that its corners are rational.
struct Plate {
    static constexpr int half_length = 40;
    static constexpr int half_height = 18;
    /// The corner at the end of both axes is cut off from (cut_x, half_height) to (half_length, cut_y).
    static constexpr int cut_x = 28;
    static constexpr int cut_y = 9;
    struct RoundHole {
        int x, y, radius;
    };
    static constexpr RoundHole holes[2] = {{20, -2, 8}, {-22, 3, 5}};

    int scale = 1;
    int centre_x = 56 * 8 + 3;  ///< in 1/8 px
    int centre_y = 38 * 8 - 2;
    int cosine = 12, sine = 5, hypotenuse = 13;
    std::uint8_t dark = 30;
    std::uint8_t bright = 220;
    int noise = 3;  ///< grey levels up and down
    bool dark_part = true;

    /// A place of the plate in the image.
    constexpr FinePoint to_image(std::int64_t x, std::int64_t y) const {
        const auto turned = [&](std::int64_t value, int centre) {
            return FinePixel::from_ratio(centre, 8) + FinePixel::from_ratio(value * scale, hypotenuse);
        };
        return {turned(cosine * x - sine * y, centre_x), turned(sine * x + cosine * y, centre_y)};
    }
    /// Whether the plate covers a place of the image, in 1/16 px.
    constexpr bool covers(std::int64_t x, std::int64_t y) const {
        const std::int64_t u = x - 2 * centre_x;
        const std::int64_t v = y - 2 * centre_y;
        const std::int64_t s = cosine * u + sine * v;
        const std::int64_t t = cosine * v - sine * u;
        const std::int64_t one = std::int64_t{16} * scale * hypotenuse;
        if (s < -half_length * one || s > half_length * one) return false;
        if (t < -half_height * one || t > half_height * one) return false;
        if ((s - cut_x * one) * (half_height - cut_y) + (t - cut_y * one) * (half_length - cut_x) >
            (half_length - cut_x) * (half_height - cut_y) * one)
            return false;
        for (const RoundHole& hole : holes) {
            const std::int64_t a = s - hole.x * one;
            const std::int64_t b = t - hole.y * one;
            const std::int64_t r = hole.radius * one;
            if (a * a + b * b < r * r) return false;
        }
        return true;
    }
};

/// How much of the light at a pixel the plate takes, of 64 * 64: a lens with a triangle of 4 px in both
/// directions, sampled every quarter of a pixel.
inline int plate_shade(const Plate& plate, int x, int y) {
    // Where corners, sides and middle of the lens's field agree, so does all between them: what is drawn is
    // larger than that.
    int around = 0;
    for (int i = 0; i < 9; ++i)
        around += plate.covers(16 * x + (i % 3 - 1) * 32, 16 * y + (i / 3 - 1) * 32) ? 1 : 0;
    if (around == 0 || around == 9) return around == 0 ? 0 : 64 * 64;

    int shade = 0;
    for (int j = 0; j < 16; ++j)
        for (int i = 0; i < 16; ++i)
            if (plate.covers(16 * x + 4 * i - 30, 16 * y + 4 * j - 30))
                shade += minimum(2 * i + 1, 31 - 2 * i) * minimum(2 * j + 1, 31 - 2 * j);
    // The weights 1, 3, ... 15, 15, ... 1 sum to 128 a direction.
    return shade / 4;
}

inline void draw_plate(ImageView<Gray8> image, const Plate& plate) {
    Random random(7);
    const int ground = plate.dark_part ? plate.bright : plate.dark;
    const int part = plate.dark_part ? plate.dark : plate.bright;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) {
            const int level = ground + round_shift((part - ground) * plate_shade(plate, x, y), 12);
            image(x, y) = saturate_cast<Gray8>(level + random.between(-plate.noise, plate.noise));
        }
}

}  // namespace fovea::golden
