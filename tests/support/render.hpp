// SPDX-License-Identifier: MIT
//
// Rendered pictures of known geometry, in double precision: the ground truth of the measuring tests. Host
// tests only.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/image/image_view.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {

inline constexpr double pi = 3.14159265358979323846;

/// A normal random number: the sum of twelve uniform ones, variance 1.
inline double normal(Random& random) {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += random.next() / 4294967296.0;
    return sum;
}

/// A number low..high.
inline double uniform(Random& random, double low, double high) {
    return low + (high - low) * (random.next() / 4294967296.0);
}

/// Light and lens of a rendered picture.
struct Scene {
    double dark = 30;     ///< grey level of the part
    double bright = 220;  ///< grey level of the ground
    double blur = 1;      ///< standard deviation of the lens, in pixels
    double noise = 0;     ///< standard deviation of the sensor, in grey levels
};

/// Renders the set of all (x, y) for which inside() holds, as bright on dark scene values exchanged by the
/// caller: a pixel is the mean of the blurred picture over its square. Exact up to the sampling of 8 x 8
/// points a pixel, which are jittered once per pixel so that edges along the axes are not favoured.
inline GuardedImage<Gray8> render(Size size, const Scene& scene, Random& random,
                                  const std::function<bool(double, double)>& inside) {
    constexpr int over = 16;
    const int margin = static_cast<int>(std::ceil(4 * scene.blur)) + 1;
    const int w = size.width + 2 * margin;
    const int h = size.height + 2 * margin;
    std::vector<double> cover(static_cast<std::size_t>(w) * static_cast<std::size_t>(h));
    const auto at = [w](std::vector<double>& v, int x, int y) -> double& {
        return v[static_cast<std::size_t>(y) * static_cast<std::size_t>(w) + static_cast<std::size_t>(x)];
    };
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x) {
            const double px = x - margin - 0.5;
            const double py = y - margin - 0.5;
            // Pixels whose corners and centre agree are taken as uniform: shapes are larger than that.
            int corners = 0;
            for (int i = 0; i < 9; ++i) corners += inside(px + i % 3 * 0.5, py + i / 3 * 0.5) ? 1 : 0;
            if (corners == 0 || corners == 9) {
                at(cover, x, y) = corners == 0 ? 0 : 1;
                continue;
            }
            int hits = 0;
            const double jx = uniform(random, 0, 1);
            const double jy = uniform(random, 0, 1);
            for (int i = 0; i < over * over; ++i)
                hits += inside(px + (i % over + jx) / over, py + (i / over + jy) / over) ? 1 : 0;
            at(cover, x, y) = hits / static_cast<double>(over * over);
        }

    // The lens: a Gaussian, row by row and then column by column.
    const int reach = margin - 1;
    std::vector<double> taps(static_cast<std::size_t>(2 * reach + 1));
    double sum = 0;
    for (int i = -reach; i <= reach; ++i)
        sum += taps[static_cast<std::size_t>(i + reach)] =
            scene.blur > 0 ? std::exp(-i * i / (2 * scene.blur * scene.blur)) : (i == 0 ? 1.0 : 0.0);
    std::vector<double> half = cover;
    for (int y = 0; y < h; ++y)
        for (int x = reach; x < w - reach; ++x) {
            double total = 0;
            for (int i = -reach; i <= reach; ++i)
                total += taps[static_cast<std::size_t>(i + reach)] * at(cover, x + i, y);
            at(half, x, y) = total / sum;
        }
    GuardedImage<Gray8> image(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            double total = 0;
            for (int i = -reach; i <= reach; ++i)
                total += taps[static_cast<std::size_t>(i + reach)] * at(half, x + margin, y + margin + i);
            const double level = scene.bright + (scene.dark - scene.bright) * total / sum;
            image(x, y) =
                static_cast<Gray8>(std::clamp(std::lround(level + scene.noise * normal(random)), 0L, 255L));
        }
    return image;
}

inline FinePixel fine(double value) {
    return FinePixel::from_raw(static_cast<std::int32_t>(std::lround(value * 65536)));
}
inline FinePoint fine(double x, double y) { return {fine(x), fine(y)}; }
inline double real(FinePixel value) { return value.raw() / 65536.0; }

}  // namespace fovea::test
