// SPDX-License-Identifier: MIT
//
// The pixels of an edge image as points: where the edge passes to a fraction of a pixel, and which way the
// brightness rises. Book sec. 2.8.4.
#pragma once

#include <cstdint>

#include <fovea/base/list.hpp>
#include <fovea/base/order.hpp>
#include <fovea/base/status.hpp>
#include <fovea/feature/edge_pixels.hpp>
#include <fovea/feature/strongest.hpp>
#include <fovea/image/border.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/number/angle.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/number/trigonometry.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// A pixel of an edge.
struct EdgePoint {
    SubPixelPoint place;
    Angle gradient;              ///< where the brightness rises
    std::uint16_t strength = 0;  ///< |x| + |y| of Sobel's derivatives, 0..2040
    Point pixel;
};

/// A point for every pixel that is not 0 in edges, which canny() made of src: the summit of the bell curve
/// through the strengths of the pixel and its two neighbours along the gradient, as canny() chooses them. A
/// lens turns a step into such a curve.
///
/// Shapes    src and edges equal, 1x1 or larger
/// Units     places in 1/256 px, at most 1/2 px from the pixel's centre in x and in y; a neighbour on a
///           diagonal is one step away in both
/// Rounding  nearest; the angle to 1/65536 turn
/// Border    of the picture as border says, the same as for canny(). Where a neighbour lies outside, or is
///           stronger than the pixel, the place is the pixel's centre
/// Order     row by row
/// Errors    empty_image, size_mismatch; capacity_exceeded: points holds the strongest, of equal ones the
///           first
/// Source    book sec. 2.8.4. The curve is a parabola through the logarithms: a mean error of 0.01 px across
///           a blurred edge, where the toolkit's parabola through the strengths has up to 0.1 px on
///           diagonals. The toolkit divided the step on diagonals by the root of 2 once too often besides
inline Status canny_points(ImageView<const Gray8> src, ImageView<const Gray8> edges, Border border,
                           ListView<EdgePoint> points);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

constexpr int distance_from_0(int value) { return maximum(value, -value); }

struct Gradient {
    int x = 0;
    int y = 0;

    int strength() const { return distance_from_0(x) + distance_from_0(y); }
};

/// Sobel's derivatives at single pixels.
class SobelProbe {
public:
    SobelProbe(ImageView<const Gray8> src, Border border) : src_(src), border_(border) {}

    Gradient at(int x, int y) const {
        const bool inside = x > 0 && y > 0 && x + 1 < src_.width() && y + 1 < src_.height();
        return inside ? interior(x, y) : at_rim(x, y);
    }

private:
    Gradient interior(int x, int y) const {
        const Gray8* a = src_.row(y - 1) + x;
        const Gray8* b = src_.row(y) + x;
        const Gray8* c = src_.row(y + 1) + x;
        return {a[1] + 2 * b[1] + c[1] - a[-1] - 2 * b[-1] - c[-1],
                c[-1] + 2 * c[0] + c[1] - a[-1] - 2 * a[0] - a[1]};
    }
    Gradient at_rim(int x, int y) const {
        Gradient sum;
        for (int j = -1; j <= 1; ++j)
            for (int i = -1; i <= 1; ++i) {
                const int column = border_index(border_, x + i, src_.width());
                const int row = border_index(border_, y + j, src_.height());
                if (column == no_index || row == no_index) continue;
                const int level = src_.row(row)[column];
                sum.x += i * (2 - distance_from_0(j)) * level;
                sum.y += j * (2 - distance_from_0(i)) * level;
            }
        return sum;
    }

    ImageView<const Gray8> src_;
    Border border_;
};

/// Logarithms of 1 to 2, 128 steps, in 2^-16: the exponent is doubled by squaring, bit by bit.
struct LogarithmTable {
    std::uint32_t at[129];
};
constexpr LogarithmTable logarithm_table() {
    LogarithmTable table{};
    for (std::uint32_t i = 0; i < 128; ++i) {
        std::uint64_t value = std::uint64_t{128 + i} << 24;  // in 2^-31
        std::uint32_t bits = 0;
        for (int bit = 0; bit < 17; ++bit) {
            value = value * value >> 31;
            const bool above = value >> 32 != 0;
            bits = 2 * bits + (above ? 1 : 0);
            value >>= above ? 1 : 0;
        }
        table.at[i] = (bits + 1) >> 1;
    }
    table.at[128] = 1u << 16;
    return table;
}
inline constexpr LogarithmTable logarithms = logarithm_table();

/// The logarithm to base 2 in 2^-16 of a strength, 1 to 2047. Between the steps a straight line, which is off
/// by 2^-16 at most.
constexpr int logarithm(int strength) {
    const int exponent = 31 - leading_zeros(static_cast<std::uint32_t>(strength));
    const int place = (strength << (11 - exponent)) - 2048;
    const auto low = static_cast<int>(logarithms.at[place / 16]);
    const auto high = static_cast<int>(logarithms.at[place / 16 + 1]);
    return (exponent << 16) + low + round_shift((high - low) * (place % 16), 4);
}

/// The step to the neighbour behind, as canny() takes it: the tangent of 22.5 degrees is 13573 / 32768.
constexpr Point step_along(int gradient_x, int gradient_y) {
    const int x = distance_from_0(gradient_x);  // at most 1020, so that all fits 32 bits
    const int y = distance_from_0(gradient_y);
    if (y * 32768 < x * 13573) return {1, 0};
    if (y * 32768 > x * (13573 + 65536)) return {0, 1};
    return {(gradient_x < 0) == (gradient_y < 0) ? 1 : -1, 1};
}

inline EdgePoint edge_point(const SobelProbe& probe, Size size, int x, int y) {
    const Gradient here = probe.at(x, y);
    const Point step = step_along(here.x, here.y);
    EdgePoint point;
    point.pixel = {x, y};
    point.gradient = angle_of(std::int32_t{here.x}, std::int32_t{here.y}).coarse();
    point.strength = static_cast<std::uint16_t>(here.strength());
    int shift = 0;
    const bool inside = x - distance_from_0(step.x) >= 0 && x + distance_from_0(step.x) < size.width &&
                        y - step.y >= 0 && y + step.y < size.height;
    if (inside) {
        const int before = probe.at(x - step.x, y - step.y).strength();
        const int behind = probe.at(x + step.x, y + step.y).strength();
        if (maximum(before, behind) <= point.strength) {
            const int first = logarithm(maximum(before, 1));
            const int last = logarithm(maximum(behind, 1));
            const int bend = 2 * logarithm(maximum<int>(point.strength, 1)) - first - last;
            if (bend > 0) shift = round_divide(128 * (last - first), bend);
        }
    }
    point.place = {SubPixel::from_raw(x * 256 + step.x * shift),
                   SubPixel::from_raw(y * 256 + step.y * shift)};
    return point;
}

/// Whether a is to leave a full list before b.
constexpr bool leaves_first(const EdgePoint& a, const EdgePoint& b) {
    if (a.strength != b.strength) return a.strength < b.strength;
    return a.pixel.y != b.pixel.y ? a.pixel.y > b.pixel.y : a.pixel.x > b.pixel.x;
}

}  // namespace detail

inline Status canny_points(ImageView<const Gray8> src, ImageView<const Gray8> edges, Border border,
                           ListView<EdgePoint> points) {
    if (src.empty()) return Status::empty_image;
    if (edges.size() != src.size()) return Status::size_mismatch;

    const detail::SobelProbe probe(src, border);
    detail::Strongest strongest(points, detail::leaves_first);
    detail::for_each_edge(edges,
                          [&](int x, int y) { strongest.add(detail::edge_point(probe, src.size(), x, y)); });
    if (strongest.status() != Status::ok)
        sort(points.span(), [](const EdgePoint& a, const EdgePoint& b) {
            return a.pixel.y != b.pixel.y ? a.pixel.y < b.pixel.y : a.pixel.x < b.pixel.x;
        });
    return strongest.status();
}

}  // namespace fovea
