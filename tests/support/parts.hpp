// SPDX-License-Identifier: MIT
//
// Pictures of parts of many shapes for the tests of the applications. Host tests only.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/codec/pnm.hpp>

#include <common/picture_file.hpp>
#include <gauge/recipe_file.hpp>
#include <support/render.hpp>

namespace fovea::test {

/// True for the points of a part, in pixels about a middle of its own.
using Shape = std::function<bool(double, double)>;

/// A part that lies somewhere. stretch_y is the height of the picture over that of the world: below 1 where
/// rows are farther apart than columns.
struct Lying {
    Shape shape;
    double x = 0, y = 0, degrees = 0;
    double stretch_y = 1;
};

namespace shapes {

inline Shape rectangle(double length, double height) {
    return [=](double s, double t) { return std::abs(s) <= length / 2 && std::abs(t) <= height / 2; };
}
inline Shape disc(double radius) {
    return [=](double s, double t) { return std::hypot(s, t) <= radius; };
}
inline Shape ring(double outer, double inner) {
    return [=](double s, double t) { return std::hypot(s, t) <= outer && std::hypot(s, t) >= inner; };
}
inline Shape without(const Shape& shape, const Shape& hole, double x, double y) {
    return [=](double s, double t) { return shape(s, t) && !hole(s - x, t - y); };
}
inline Shape with(const Shape& shape, const Shape& more, double x, double y) {
    return [=](double s, double t) { return shape(s, t) || more(s - x, t - y); };
}
/// 180 x 70 with a corner cut off by 30 x 20 and two round holes of the radii 15 and 9.
inline Shape plate() {
    const Shape cut = [](double s, double t) {
        return std::abs(s) <= 90 && std::abs(t) <= 35 && (s - 60) / 30 + (t - 15) / 20 <= 1;
    };
    return without(without(cut, disc(15), 50, -2), disc(9), -48, 4);
}
/// A rectangle between two half discs.
inline Shape stadium(double length, double height) {
    return [=](double s, double t) {
        return std::hypot(std::max(std::abs(s) - (length - height) / 2, 0.0), t) <= height / 2;
    };
}
/// 180 long and 80 wide at its left end.
inline Shape triangle() {
    return [](double s, double t) { return std::abs(s) <= 90 && std::abs(t) <= 40 * (90 - s) / 180; };
}
inline Shape l_shape() { return with(rectangle(120, 36), rectangle(36, 90), -42, -45); }
inline Shape t_shape() { return with(rectangle(120, 30), rectangle(30, 80), 0, 50); }
inline Shape wave(double radius, double depth, int waves) {
    return [=](double s, double t) {
        return std::hypot(s, t) <= radius + depth * std::cos(waves * std::atan2(t, s));
    };
}
inline Shape star() {
    return [](double s, double t) {
        const double turn = std::atan2(t, s) / (2 * pi) * 5;
        const double part = std::abs(turn - std::round(turn));
        return std::hypot(s, t) <= 75 - 85 * part;
    };
}
/// A regular polygon with the middle of a side to the right, that far from the centre.
inline Shape polygon(int sides, double apothem) {
    return [=](double s, double t) {
        const double angle = std::remainder(std::atan2(t, s), 2 * pi / sides);
        return std::hypot(s, t) * std::cos(angle) <= apothem;
    };
}
/// A shape with round holes in a circle around its middle, the first to the right.
inline Shape drilled(const Shape& shape, int holes, double distance, double radius) {
    return [=](double s, double t) {
        const double angle = std::remainder(std::atan2(t, s), 2 * pi / holes);
        const double from_middle = std::hypot(s, t);
        return shape(s, t) &&
               std::hypot(from_middle * std::cos(angle) - distance, from_middle * std::sin(angle)) >= radius;
    };
}
inline Shape flange(int holes) { return drilled(disc(80), holes, 55, 9); }
inline Shape gear() {
    return [](double s, double t) {
        const double radius = std::hypot(s, t);
        const double turn = std::atan2(t, s) / (2 * pi) * 18;
        return radius >= 18 && radius <= (turn - std::floor(turn) < 0.5 ? 80 : 70);
    };
}
inline Shape crescent() {
    return [](double s, double t) { return std::hypot(s, t) <= 70 && std::hypot(s - 35, t) >= 62; };
}
inline Shape sieve() {
    return [](double s, double t) {
        if (std::abs(s) > 130 || std::abs(t) > 80) return false;
        const double u = s + 112.5 - 25 * std::round((s + 112.5) / 25);
        const double v = t + 45 - 30 * std::round((t + 45) / 30);
        return std::abs(s) > 125 || std::abs(t) > 60 || std::hypot(u, v) > 7;
    };
}

}  // namespace shapes

/// Renders parts; scene.dark is the level of the parts, scene.bright that of the ground.
inline apps::Picture<Gray8> picture_of(Size size, const std::vector<Lying>& parts, const Scene& scene,
                                       std::uint64_t seed) {
    Random random(seed);
    const GuardedImage<Gray8> image = render(size, scene, random, [&](double x, double y) {
        for (const Lying& part : parts) {
            const double u = x - part.x;
            const double v = (y - part.y) / part.stretch_y;
            const double c = std::cos(part.degrees * pi / 180);
            const double s = std::sin(part.degrees * pi / 180);
            if (part.shape(u * c + v * s, v * c - u * s)) return true;
        }
        return false;
    });
    apps::Picture<Gray8> picture(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) picture.view()(x, y) = image(x, y);
    return picture;
}

/// The bytes of a PGM file.
inline std::vector<std::uint8_t> pgm_of(const apps::Picture<Gray8>& picture) {
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(encoded_pnm_bytes<Gray8>(picture.size)));
    EXPECT_TRUE(encode_pnm(picture.view(), {bytes.data(), static_cast<std::ptrdiff_t>(bytes.size())}).ok());
    return bytes;
}

/// A feature of a recipe by its name; null if there is none.
inline const Feature* feature_named(const Recipe& recipe, const std::string& name) {
    for (const Feature& feature : recipe.features) {
        const Span<const char> text = name_of(feature.name);
        if (std::string(text.data(), static_cast<std::size_t>(text.size())) == name) return &feature;
    }
    return nullptr;
}
/// Its nominal value; a number that equals none if there is no such feature.
inline double nominal_of(const Recipe& recipe, const std::string& name) {
    const Feature* feature = feature_named(recipe, name);
    return feature == nullptr ? std::nan("")
                              : static_cast<double>(feature->tolerance.nominal.millionths) * 1e-6;
}

}  // namespace fovea::test
