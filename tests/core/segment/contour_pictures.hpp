// SPDX-License-Identifier: MIT
//
// Pictures and points for the tests of contours and of what is made of them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/base/span.hpp>
#include <fovea/image/geometry.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {

inline GuardedImage<Gray8> drawn(const std::vector<std::string>& rows) {
    GuardedImage<Gray8> image({static_cast<int>(rows[0].size()), static_cast<int>(rows.size())});
    for (int y = 0; y < image.view().height(); ++y)
        for (int x = 0; x < image.view().width(); ++x)
            image(x, y) = rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] == '#' ? 255 : 0;
    return image;
}

/// Blocks of random size, so that regions are thin and thick and have holes.
inline GuardedImage<Gray8> random_blocks(Size size, Random& random) {
    GuardedImage<Gray8> image(size);
    const int density = random.between(10, 90);
    const int block = random.between(1, 4);
    std::vector<bool> cells(static_cast<std::size_t>(size.area()));
    for (std::size_t i = 0; i < cells.size(); ++i) cells[i] = random.between(0, 99) < density;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            image(x, y) = cells[static_cast<std::size_t>(y / block * size.width + x / block)] ? 255 : 0;
    return image;
}

/// A line of one pixel that winds inwards around itself.
inline GuardedImage<Gray8> spiral(int side) {
    GuardedImage<Gray8> image({side, side});
    image.fill(Gray8{0});
    int left = 0, top = 0, right = side - 1, bottom = side - 1;
    Point p{0, 0};
    const auto go = [&](Point to) {
        while (p != to) {
            image(p.x, p.y) = 255;
            p.x += (to.x > p.x) - (to.x < p.x);
            p.y += (to.y > p.y) - (to.y < p.y);
        }
        image(p.x, p.y) = 255;
    };
    while (left < right && top < bottom) {
        go({right, top});
        go({right, bottom});
        go({left, bottom});
        top += 2;
        go({left, top});
        left += 2;
        right -= 2;
        bottom -= 2;
        if (left < right) go({left, top});
    }
    return image;
}

/// Teeth of one pixel on a back of one.
inline GuardedImage<Gray8> comb(Size size) {
    GuardedImage<Gray8> image(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) image(x, y) = y == size.height - 1 || x % 2 == 0 ? 255 : 0;
    return image;
}

inline std::vector<Point> random_points(Random& random, int count, int reach) {
    std::vector<Point> points;
    for (int i = 0; i < count; ++i)
        points.push_back({random.between(-reach, reach), random.between(-reach, reach)});
    return points;
}

inline Span<const Point> span_of(const std::vector<Point>& points) {
    return {points.data(), static_cast<std::ptrdiff_t>(points.size())};
}

}  // namespace fovea::test
