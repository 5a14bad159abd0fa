// SPDX-License-Identifier: MIT
//
// Straight lines, thin and thick, and chains of them.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/draw/run.hpp>
#include <fovea/draw/slope.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The thickest line.
inline constexpr int max_line_thickness = 255;

/// The line from a to b, both ends included; the same pixels from b to a.
///
/// Shapes    any image; ends within max_draw_coordinate; thickness 1..max_line_thickness
/// Units     thickness in px. 1: one pixel for each step along the longer axis. From 2: every pixel whose
///           centre is at most thickness / 2 from the line, so ends are round and joints closed; an even
///           thickness lies half a pixel further left and up, so that a level line has exactly that many rows
/// Rounding  thin: nearest along the shorter axis, ties right or down. Thick: exact
/// Time      grows with the pixels (thin) or rows (thick) inside the image, however far the ends are
/// Errors    empty_image, bad_argument
/// Source    thin: J. E. Bresenham, IBM Systems Journal 4, 1965, no. 1; its first and last visible step
///           are solved for, not searched, so clipping moves no pixel. Thick: own
template <class Pixel>
Status draw_line(ImageView<Pixel> image, Point a, Point b, NonDeduced<Pixel> colour, int thickness = 1);

/// Lines from each point to the next. A single point is a line to itself; no points draw nothing.
///
/// Shapes  as draw_line()
/// Errors  empty_image, bad_argument; every point is checked before the first line is drawn
/// Source  as draw_line()
template <class Pixel>
Status draw_polyline(ImageView<Pixel> image, Span<const Point> points, NonDeduced<Pixel> colour,
                     int thickness = 1);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Quotient toward plus infinity. divisor > 0.
constexpr std::int64_t divide_up(std::int64_t value, std::int64_t divisor) {
    return -floor_divide(-value, divisor);
}

/// The steps or columns low..high that are drawn, none if high is below low.
struct DrawnRange {
    std::int64_t low;
    std::int64_t high;

    constexpr void keep_at_least(std::int64_t bound) { low = maximum(low, bound); }
    constexpr void keep_at_most(std::int64_t bound) { high = minimum(high, bound); }
    constexpr void clear() { high = low - 1; }

    /// Keeps what satisfies factor * value <= limit.
    constexpr void keep(std::int64_t factor, std::int64_t limit) {
        if (factor > 0)
            keep_at_most(floor_divide(limit, factor));
        else if (factor < 0)
            keep_at_least(-floor_divide(limit, -factor));
        else if (limit < 0)
            clear();
    }
    /// Takes another in; what lies between the two is taken too.
    constexpr void join(DrawnRange other) {
        if (other.high < other.low) return;
        *this = high < low ? other : DrawnRange{minimum(low, other.low), maximum(high, other.high)};
    }
};

/// The steps t = 0..run whose pixel (u + t, v + floor((rise * t + run / 2) / run)) is inside a frame of
/// u_size by v_size.
constexpr DrawnRange visible_steps(std::int64_t u, std::int64_t v, std::int64_t run, std::int64_t rise,
                                   int u_size, int v_size) {
    DrawnRange steps{maximum<std::int64_t>(0, -u), minimum(run, u_size - 1 - u)};
    // The pixel is at row w or below when rise * t >= (w - v) * run - run / 2: at most 2^31 * (2^30 + 2^15).
    const std::int64_t enter = -v * run - run / 2;
    const std::int64_t leave = (v_size - v) * run - run / 2;
    if (rise > 0) {
        steps.keep_at_least(divide_up(enter, rise));
        steps.keep_at_most(divide_up(leave, rise) - 1);
    } else if (rise < 0) {
        steps.keep_at_least(floor_divide(-leave, -rise) + 1);
        steps.keep_at_most(floor_divide(-enter, -rise));
    } else if (v < 0 || v >= v_size) {
        steps.clear();
    }
    return steps;
}

template <class Pixel>
void draw_thin_line(ImageView<Pixel> image, Point a, Point b, Pixel colour) {
    if (a.y == b.y) return fill_run(image, a.y, minimum(a.x, b.x), maximum(a.x, b.x), colour);
    const bool steep =
        magnitude(std::int64_t{b.y} - a.y) > magnitude(std::int64_t{b.x} - a.x);  // u is y, v is x
    // Always walked toward growing u, so that both directions meet the same ties.
    const bool swap = steep ? b.y < a.y : b.x < a.x;
    const Point from = swap ? b : a;
    const Point to = swap ? a : b;
    const int u = steep ? from.y : from.x;
    const int v = steep ? from.x : from.y;
    const std::int64_t run = std::int64_t{steep ? to.y : to.x} - u;
    const std::int64_t rise = std::int64_t{steep ? to.x : to.y} - v;

    const DrawnRange steps = visible_steps(u, v, run, rise, steep ? image.height() : image.width(),
                                           steep ? image.width() : image.height());
    if (steps.high < steps.low) return;
    Slope slope(v, rise, run, run / 2, steps.low);
    const auto last = static_cast<int>(u + steps.high);
    for (int at = static_cast<int>(u + steps.low); at <= last; ++at, slope.step()) {
        if (steep)
            image(slope.value(), at) = colour;
        else
            image(at, slope.value()) = colour;
    }
}

/// A thick line in half pixels: a pixel (x, y) is 2 * (x - end.x) + shift to the right of an end and
/// correspondingly below it, and belongs when it is within thickness of the line between the ends.
class ThickLine {
public:
    ThickLine(Point a, Point b, int thickness)
        : a_(a),
          b_(b),
          dx_(std::int64_t{b.x} - a.x),
          dy_(std::int64_t{b.y} - a.y),
          thickness_(thickness),
          shift_(1 - thickness % 2),
          reach_(reach(magnitude(dx_), magnitude(dy_), static_cast<std::uint64_t>(thickness))) {}

    std::int64_t top() const { return std::int64_t{minimum(a_.y, b_.y)} - thickness_ / 2; }
    std::int64_t bottom() const { return std::int64_t{maximum(a_.y, b_.y)} + (thickness_ - 1) / 2; }

    /// The columns of row y. The shape is convex, so the gap-free union of its three parts is one run.
    DrawnRange columns(int y) const {
        DrawnRange run = cap(a_, y);
        run.join(cap(b_, y));
        if (dx_ != 0 || dy_ != 0) run.join(body(y));
        return run;
    }

private:
    /// floor(thickness * length), exactly: with length^2 = root^2 + rest it is thickness * root + more for
    /// the largest more with (thickness * root + more)^2 <= thickness^2 * (root^2 + rest). rest <= 2 * root,
    /// so more <= thickness, and no term reaches 2^50.
    static std::int64_t reach(std::uint64_t dx, std::uint64_t dy, std::uint64_t thickness) {
        const std::uint64_t square = dx * dx + dy * dy;  // at most 2^63
        const std::uint64_t root = isqrt(square);
        const std::uint64_t room = thickness * thickness * (square - root * root);
        std::uint64_t more = 0;
        while (2 * thickness * root * (more + 1) + (more + 1) * (more + 1) <= room) ++more;
        return static_cast<std::int64_t>(thickness * root + more);
    }

    std::int64_t below(Point end, int y) const { return 2 * (std::int64_t{y} - end.y) + shift_; }

    /// Half pixels right of an end as columns of the image.
    DrawnRange to_columns(Point end, DrawnRange right) const {
        return {end.x + divide_up(right.low - shift_, 2),
                end.x + floor_divide(right.high - shift_, std::int64_t{2})};
    }
    DrawnRange cap(Point end, int y) const {
        const std::int64_t down = below(end, y);
        if (down < -thickness_ || down > thickness_) return {0, -1};
        const std::int64_t half = isqrt(static_cast<std::uint64_t>(thickness_ * thickness_ - down * down));
        return to_columns(end, {-half, half});
    }
    /// Between the two long sides, |dx * down - dy * right| <= reach, and between the ends. Every product is
    /// at most 2^31 * (2^31 + 2^16 + 1).
    DrawnRange body(int y) const {
        const std::int64_t down = below(a_, y);
        DrawnRange right{-everywhere, everywhere};  // of a
        right.keep(-dy_, reach_ - dx_ * down);
        right.keep(dy_, reach_ + dx_ * down);
        right.keep(-dx_, dy_ * down);
        DrawnRange right_of_b{-everywhere, everywhere};
        right_of_b.keep(dx_, -dy_ * below(b_, y));
        right.keep_at_least(right_of_b.low + 2 * dx_);
        right.keep_at_most(right_of_b.high + 2 * dx_);
        return to_columns(a_, right);
    }

    static constexpr std::int64_t everywhere = std::int64_t{1} << 40;

    Point a_;
    Point b_;
    std::int64_t dx_;
    std::int64_t dy_;
    std::int64_t thickness_;
    std::int64_t shift_;
    std::int64_t reach_;
};

template <class Pixel>
void draw_thick_line(ImageView<Pixel> image, Point a, Point b, int thickness, Pixel colour) {
    const ThickLine line(a, b, thickness);
    const std::int64_t last = minimum<std::int64_t>(line.bottom(), image.height() - 1);
    for (std::int64_t y = maximum<std::int64_t>(line.top(), 0); y <= last; ++y) {
        const DrawnRange columns = line.columns(static_cast<int>(y));
        fill_run(image, y, columns.low, columns.high, colour);
    }
}

}  // namespace detail

template <class Pixel>
Status draw_line(ImageView<Pixel> image, Point a, Point b, NonDeduced<Pixel> colour, int thickness) {
    if (image.empty()) return Status::empty_image;
    if (!drawable(a) || !drawable(b)) return Status::bad_argument;
    if (thickness < 1 || thickness > max_line_thickness) return Status::bad_argument;
    if (thickness == 1)
        detail::draw_thin_line(image, a, b, colour);
    else
        detail::draw_thick_line(image, a, b, thickness, colour);
    return Status::ok;
}

template <class Pixel>
Status draw_polyline(ImageView<Pixel> image, Span<const Point> points, NonDeduced<Pixel> colour,
                     int thickness) {
    if (image.empty()) return Status::empty_image;
    if (thickness < 1 || thickness > max_line_thickness) return Status::bad_argument;
    for (const Point p : points)
        if (!drawable(p)) return Status::bad_argument;

    if (points.size() == 1) return draw_line(image, points[0], points[0], colour, thickness);
    for (std::ptrdiff_t i = 1; i < points.size(); ++i)
        if (Status s = draw_line(image, points[i - 1], points[i], colour, thickness); s != Status::ok)
            return s;
    return Status::ok;
}

}  // namespace fovea
