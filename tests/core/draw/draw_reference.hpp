// SPDX-License-Identifier: MIT
//
// The slow obvious versions of drawing: whether a pixel belongs to a shape, asked for every pixel of an image
// in 128-bit integers. Host tests only.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/base/span.hpp>
#include <fovea/image/image_view.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {

__extension__ using Wide = __int128;

inline Wide floor_of(Wide value, Wide divisor) {
    const Wide quotient = value / divisor;
    return value % divisor < 0 ? quotient - 1 : quotient;
}

/// Rows of an image as text: '#' for 255, '.' for 0, '?' for the rest.
using Picture = std::vector<std::string>;
inline Picture picture(ImageView<const Gray8> image) {
    Picture rows;
    for (int y = 0; y < image.height(); ++y) {
        rows.emplace_back();
        for (int x = 0; x < image.width(); ++x)
            rows.back() += image(x, y) == 255 ? '#' : image(x, y) == 0 ? '.' : '?';
    }
    return rows;
}
inline Picture picture(const GuardedImage<Gray8>& image) { return picture(image.view()); }

/// An image of zeros.
inline GuardedImage<Gray8> black(Size size) {
    GuardedImage<Gray8> image(size);
    image.fill(Gray8{0});
    return image;
}

/// 255 in every pixel for which belongs(x, y) is true, 0 elsewhere.
template <class Belongs>
GuardedImage<Gray8> naive_shape(Size size, Belongs belongs) {
    GuardedImage<Gray8> image(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) image(x, y) = belongs(x, y) ? 255 : 0;
    return image;
}

/// The nearest pixel for every step along the longer axis, ties right or down.
inline bool on_thin_line(Point a, Point b, Point p) {
    Wide dx = Wide{b.x} - a.x;
    Wide dy = Wide{b.y} - a.y;
    Wide u = Wide{p.x} - a.x;
    Wide v = Wide{p.y} - a.y;
    if ((dx < 0 ? -dx : dx) < (dy < 0 ? -dy : dy)) {
        std::swap(dx, dy);
        std::swap(u, v);
    }
    if (dx == 0) return u == 0 && v == 0;
    // floor(dy * u / dx + 1/2), with a positive denominator.
    const Wide sign = dx < 0 ? -1 : 1;
    if (u * sign < 0 || u * sign > dx * sign) return false;
    return v == floor_of(sign * (2 * dy * u + dx), 2 * dx * sign);
}

/// Within thickness half pixels of the line, in half pixels; even thicknesses half a pixel left and up.
inline bool on_thick_line(Point a, Point b, int thickness, Point p) {
    const Wide shift = thickness % 2 == 0 ? 1 : 0;
    const Wide dx = Wide{b.x} - a.x;
    const Wide dy = Wide{b.y} - a.y;
    const Wide ax = 2 * (Wide{p.x} - a.x) + shift;
    const Wide ay = 2 * (Wide{p.y} - a.y) + shift;
    const Wide bx = 2 * (Wide{p.x} - b.x) + shift;
    const Wide by = 2 * (Wide{p.y} - b.y) + shift;
    const Wide square = Wide{thickness} * thickness;
    if (dx * ax + dy * ay <= 0) return ax * ax + ay * ay <= square;
    if (dx * bx + dy * by >= 0) return bx * bx + by * by <= square;
    const Wide cross = dx * ay - dy * ax;
    return cross * cross <= square * (dx * dx + dy * dy);
}

/// Inside the outline of a circle or on it.
inline bool in_disc(Point centre, std::int64_t radius, Point p) {
    Wide far = Wide{p.x} - centre.x;
    Wide near = Wide{p.y} - centre.y;
    if (far < 0) far = -far;
    if (near < 0) near = -near;
    if (far < near) std::swap(far, near);
    if (radius == 0) return far == 0;
    // (far - 1/2)^2 + near^2 < radius^2, times 4
    return (2 * far - 1) * (2 * far - 1) + 4 * near * near < 4 * Wide{radius} * radius || far == 0;
}

/// Inside the outline of a circle and not on it.
inline bool enclosed_by_circle(Point centre, std::int64_t radius, Point p) {
    Wide far = Wide{p.x} - centre.x;
    Wide near = Wide{p.y} - centre.y;
    if (far < 0) far = -far;
    if (near < 0) near = -near;
    if (far < near) std::swap(far, near);
    return radius > 0 && (2 * far + 1) * (2 * far + 1) + 4 * near * near < 4 * Wide{radius} * radius;
}

/// Even-odd rule at the pixel centre: how many edges cross its row at or left of it.
inline bool in_polygon(Span<const Point> vertices, Point p) {
    bool inside = false;
    for (std::ptrdiff_t i = 0; i < vertices.size(); ++i) {
        Point upper = vertices[i];
        Point lower = vertices[(i + 1) % vertices.size()];
        if (lower.y < upper.y) std::swap(upper, lower);
        if (p.y < upper.y || p.y >= lower.y) continue;
        const Wide right_of_edge = (Wide{p.x} - upper.x) * (Wide{lower.y} - upper.y) -
                                   (Wide{p.y} - upper.y) * (Wide{lower.x} - upper.x);
        if (right_of_edge >= 0) inside = !inside;
    }
    return inside;
}

/// How far from an image a random shape lies: inside, around it, far away, almost at the end of the range.
inline const std::vector<int>& distances() {
    static const std::vector<int> reaches = {0, 20, 300, 70000, 1 << 24, (1 << 30) - 64};
    return reaches;
}

/// A point of the image, or half of the time one at most reach beyond its sides.
inline Point random_point(Random& random, Size size, int reach) {
    const int beyond = random.below(2) == 0 ? reach : 0;
    const int x = random.between(-beyond, size.width - 1 + beyond);
    const int y = random.between(-beyond, size.height - 1 + beyond);
    return {x, y};
}

inline std::vector<Size> drawing_sizes() { return {{1, 1}, {1, 9}, {9, 1}, {2, 2}, {7, 13}, {40, 25}}; }

}  // namespace fovea::test
