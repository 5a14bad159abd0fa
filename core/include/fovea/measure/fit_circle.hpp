// SPDX-License-Identifier: MIT
//
// Circles through measured points.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/measure/consensus.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/int128.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

struct Circle {
    FinePoint centre;
    FinePixel radius;
};

/// How far a point is from a circle: positive outside.
constexpr FinePixel distance_from(const Circle& circle, FinePoint point);

/// The circle through three points.
///
/// Rounding  centre and radius to the nearest 1/65536 px
/// Errors    degenerate for points on one line, or a centre or radius beyond 32767 px
constexpr Result<Circle> circle_through(FinePoint a, FinePoint b, FinePoint c);

/// A fitted circle, the root of the mean squared distance, and how many points it rests on.
struct CircleFit {
    Circle circle;
    FinePixel rms;
    int used = 0;
};

/// The circle with the least sum of squared distances from the points: the geometric fit, which unlike the
/// algebraic one does not shrink short arcs.
///
/// Shapes    3..max_fit_points points
/// Rounding  centre and radius to within 2^-16 px of the minimum, times 1 / (1 - cos(arc / 2)) on an arc
/// Errors    degenerate for fewer than three points, points on a line or on an arc of less than about a
///           degree, a centre beyond 32767 px, or when 30 steps do not reach the minimum; bad_argument above
///           max_fit_points
/// Source    Gauss-Newton on the distances; Gander, Golub, Strebel, "Least-Squares Fitting of Circles and
///           Ellipses", BIT 34, 1994, sec. 4
constexpr Result<CircleFit> fit_circle(Span<const FinePoint> points);

/// The same for the points that a circle through most of them agrees with, whatever the others are.
///
/// limit_min  up to this distance a point agrees, however near the others are. If all points are so near to
///            the circle through all, it is that one: with more than the noise, points that are not quite
///            round have the circle of all of them and not of some
/// Scratch    one element a point, undefined afterwards
/// Errors     also scratch_too_small
/// Source     least_median(), then two fits to the points within its limit
inline Result<CircleFit> fit_circle_robust(Span<const FinePoint> points, Span<FinePixel> scratch,
                                           FinePixel limit_min = FinePixel());

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// From one point to another, without overflow.
struct Offset {
    std::int64_t x, y;

    constexpr Offset(FinePoint from, FinePoint to)
        : x(std::int64_t{to.x.raw()} - from.x.raw()), y(std::int64_t{to.y.raw()} - from.y.raw()) {}
    constexpr std::int64_t length() const { return hypotenuse(x, y); }
    constexpr Int128 square() const { return Int128::product(x, x) + Int128::product(y, y); }
    friend constexpr Int128 cross(Offset a, Offset b) {
        return Int128::product(a.x, b.y) - Int128::product(a.y, b.x);
    }
};

}  // namespace detail

constexpr FinePixel distance_from(const Circle& circle, FinePoint point) {
    const std::int64_t length = detail::Offset(circle.centre, point).length();
    return FinePixel::from_raw(saturate_cast<std::int32_t>(length - circle.radius.raw()));
}

constexpr Result<Circle> circle_through(FinePoint a, FinePoint b, FinePoint c) {
    const detail::Offset to_b(a, b);
    const detail::Offset to_c(a, c);
    // Sides are below 2^32, so squares are below 2^65 and the products below 2^98.
    const Int128 divisor = cross(to_b, to_c) << 1;
    if (divisor == Int128(0)) return Status::degenerate;
    const std::int64_t x = round_divide(to_b.square() * to_c.y - to_c.square() * to_b.y, divisor);
    const std::int64_t y = round_divide(to_c.square() * to_b.x - to_b.square() * to_c.x, divisor);
    constexpr std::int64_t most = FinePixel::from_int(max_image_side).raw();
    if (magnitude(x) > static_cast<std::uint64_t>(most) || magnitude(y) > static_cast<std::uint64_t>(most))
        return Status::degenerate;
    const std::int64_t centre_x = x + a.x.raw();
    const std::int64_t centre_y = y + a.y.raw();
    if (magnitude(centre_x) > static_cast<std::uint64_t>(most) ||
        magnitude(centre_y) > static_cast<std::uint64_t>(most))
        return Status::degenerate;
    const std::int64_t radius = hypotenuse(x, y);
    if (radius > most || radius == 0) return Status::degenerate;
    return Circle{{FinePixel::from_raw(static_cast<std::int32_t>(centre_x)),
                   FinePixel::from_raw(static_cast<std::int32_t>(centre_y))},
                  FinePixel::from_raw(static_cast<std::int32_t>(radius))};
}

namespace detail {

/// The sums of one Gauss-Newton step: e are the distances, c and s cosine and sine of the direction of a
/// point from the centre. Distances have 22 fraction bits here, so that on short arcs, where centre and
/// radius move together, the last step still ends.
struct CircleSums {
    static constexpr int finer = 6;

    std::int64_t count = 0;
    std::int64_t c = 0, s = 0;            // 2^-30, below 2^41
    std::int64_t cc = 0, cs = 0, ss = 0;  // 2^-28, below 2^39
    std::int64_t e = 0;                   // 2^-22, below 2^48
    std::int64_t ce = 0, se = 0;          // 2^-32, below 2^58
    std::int64_t squares = 0;             // of e up to 32768 px in 2^-16 px^2, below 2^58

    constexpr void add(const Circle& circle, FinePoint point) {
        const Offset offset(circle.centre, point);
        const std::int64_t length = hypotenuse(offset.x * (1 << finer), offset.y * (1 << finer));
        const std::int64_t whole = maximum<std::int64_t>(length >> finer, 1);
        const std::int64_t cosine = offset.x * Unit::one / whole;
        const std::int64_t sine = offset.y * Unit::one / whole;
        const std::int64_t distance = length - std::int64_t{circle.radius.raw()} * (1 << finer);
        ++count;
        c += cosine;
        s += sine;
        cc += cosine * cosine >> 32;
        cs += cosine * sine >> 32;
        ss += sine * sine >> 32;
        e += distance;
        // |distance| is below 2^39; with 22 bits of the direction the product fits.
        ce += (cosine >> 8) * distance >> 12;
        se += (sine >> 8) * distance >> 12;
        const std::int64_t held = saturate_cast<std::int32_t>(distance >> finer);
        squares += held * held >> 16;
    }
};

/// The step that the normal equations ask for, in 2^-16 px.
struct CircleStep {
    std::int64_t x = 0, y = 0, radius = 0;
};

constexpr Result<CircleStep> solve(const CircleSums& sums) {
    // The radius is eliminated first: what is left are the sums about the means.
    const std::int64_t n = sums.count;
    const auto mean_product = [n](std::int64_t a, std::int64_t b, int drop) {
        return round_divide(Int128::product(a, b) >> drop, Int128(n));
    };
    const std::int64_t cc = sums.cc - mean_product(sums.c, sums.c, 32);
    const std::int64_t cs = sums.cs - mean_product(sums.c, sums.s, 32);
    const std::int64_t ss = sums.ss - mean_product(sums.s, sums.s, 32);
    const std::int64_t ce = sums.ce - mean_product(sums.c, sums.e, 20);
    const std::int64_t se = sums.se - mean_product(sums.s, sums.e, 20);
    const Int128 determinant = Int128::product(cc, ss) - Int128::product(cs, cs);
    const std::int64_t trace = cc + ss;
    // The smaller eigenvalue must be more than 2^-20 of the larger.
    if (!((Int128::product(trace, trace) >> 20) < determinant)) return Status::degenerate;
    CircleStep step;
    // 2^-32 * 2^-28 over 2^-56 is 2^-4: 12 bits more give 2^-16. The terms stay below 2^58+39+12.
    step.x = round_divide((Int128::product(ce, ss) - Int128::product(se, cs)) << 12, determinant);
    step.y = round_divide((Int128::product(se, cc) - Int128::product(ce, cs)) << 12, determinant);
    constexpr std::int64_t finer = 1 << CircleSums::finer;
    const std::int64_t moved = multiply_divide(sums.c, step.x * finer, Unit::one) +
                               multiply_divide(sums.s, step.y * finer, Unit::one);
    step.radius = round_divide(sums.e - moved, n * finer);
    return step;
}

/// fit_circle() over the points for which keep(point) holds, from a start that is not far off.
template <class Keep>
constexpr Result<CircleFit> fit_circle_to(Span<const FinePoint> points, const Circle& start, Keep keep) {
    constexpr std::int64_t most = FinePixel::from_int(max_image_side).raw();
    CircleFit fit;
    fit.circle = start;
    for (int round = 0; round < 30; ++round) {
        CircleSums sums;
        for (const FinePoint point : points)
            if (keep(point)) sums.add(fit.circle, point);
        if (sums.count < 3) return Status::degenerate;
        const Result<CircleStep> step = solve(sums);
        if (!step) return step.status();
        const std::int64_t x = fit.circle.centre.x.raw() + step->x;
        const std::int64_t y = fit.circle.centre.y.raw() + step->y;
        const std::int64_t radius = fit.circle.radius.raw() + step->radius;
        if (x < -most || x > most || y < -most || y > most || radius <= 0 || radius > most)
            return Status::degenerate;
        fit.circle = {{FinePixel::from_raw(static_cast<std::int32_t>(x)),
                       FinePixel::from_raw(static_cast<std::int32_t>(y))},
                      FinePixel::from_raw(static_cast<std::int32_t>(radius))};
        if (magnitude(step->x) <= 1 && magnitude(step->y) <= 1 && magnitude(step->radius) <= 1) {
            fit.used = static_cast<int>(sums.count);
            fit.rms = FinePixel::from_raw(saturate_cast<std::int32_t>(static_cast<std::int64_t>(
                isqrt(static_cast<std::uint64_t>(sums.squares / sums.count) << 16))));
            return fit;
        }
    }
    return Status::degenerate;
}

}  // namespace detail

constexpr Result<CircleFit> fit_circle(Span<const FinePoint> points) {
    if (points.size() > max_fit_points) return Status::bad_argument;
    if (points.size() < 3) return Status::degenerate;
    // A start through the first point, the one farthest from it, and the one farthest from their line.
    const FinePoint a = points[0];
    FinePoint b = a;
    for (const FinePoint point : points)
        if (detail::Offset(a, point).length() > detail::Offset(a, b).length()) b = point;
    FinePoint c = a;
    Int128 widest;
    for (const FinePoint point : points) {
        const Int128 area = cross(detail::Offset(a, b), detail::Offset(a, point));
        const Int128 size = area.negative() ? -area : area;
        if (!(widest < size)) continue;
        widest = size;
        c = point;
    }
    const Result<Circle> start = circle_through(a, b, c);
    if (!start) return start.status();
    return detail::fit_circle_to(points, *start, [](FinePoint) { return true; });
}

inline Result<CircleFit> fit_circle_robust(Span<const FinePoint> points, Span<FinePixel> scratch,
                                           FinePixel limit_min) {
    if (points.size() > max_fit_points) return Status::bad_argument;
    if (scratch.size() < points.size()) return Status::scratch_too_small;
    const auto through = [](Span<const FinePoint> three) {
        return circle_through(three[0], three[1], three[2]);
    };
    const auto distance = [](const Circle& circle, FinePoint point) {
        return detail::without_sign(distance_from(circle, point));
    };
    if (limit_min.raw() > 0) {
        const Result<CircleFit> all = fit_circle(points);
        bool agree = all.ok();
        for (const FinePoint point : points) agree = agree && distance(all->circle, point) <= limit_min;
        if (agree) return all;
    }
    const auto start = least_median<3, Circle>(points, through, distance, scratch);
    if (!start) return start.status();
    const FinePixel limit = maximum(start->limit, limit_min);
    Result<CircleFit> fit = CircleFit{start->model, FinePixel(), 0};
    for (int round = 0; round < 2 && fit; ++round) {
        const Circle circle = fit->circle;
        fit = detail::fit_circle_to(points, circle,
                                    [&](FinePoint point) { return distance(circle, point) <= limit; });
    }
    return fit;
}

}  // namespace fovea
