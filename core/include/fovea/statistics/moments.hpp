// SPDX-License-Identifier: MIT
//
// Moments of regions up to the third order, in exact integers, and the axis that follows from them. Book sec.
// 6.2.1, eq. 6.1-6.8.
#pragma once

#include <cstdint>

#include <fovea/base/assert.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/number/angle.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/int128.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/number/trigonometry.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The longest image side whose third-order sums fit 63 bits: 8191 * 8191^4 / 4 < 2^63.
inline constexpr int max_moment_side = 8191;

/// The sums of x^p y^q over the pixels of a region.
///
/// Units   pixels; coordinates 0..max_moment_side - 1
/// Source  book eq. 6.1
struct Moments {
    std::int64_t m00 = 0;
    std::int64_t m10 = 0, m01 = 0;
    std::int64_t m20 = 0, m11 = 0, m02 = 0;
    std::int64_t m30 = 0, m21 = 0, m12 = 0, m03 = 0;

    std::int64_t area() const { return m00; }
    bool empty() const { return m00 == 0; }

    /// Adds the pixels first..end-1 of row y: closed sums, no work per pixel.
    constexpr void add_run(int first, int end, int y);
    constexpr void add(const Moments& other);
};

/// A second central moment: 1/256, so that the axis of a region of two pixels is right too.
using SecondMoment = Fixed<std::int64_t, 8>;

/// The same sums about the centroid.
///
/// Rounding  centroid and second moments to the nearest; third moments to within 2 of the true value
/// Source    book eq. 6.2-6.5
struct CentralMoments {
    std::int64_t area = 0;
    FinePoint centroid;
    SecondMoment mu20, mu11, mu02;
    std::int64_t mu30 = 0, mu21 = 0, mu12 = 0, mu03 = 0;
};

/// Errors  empty_image for a region without pixels
constexpr Result<CentralMoments> central_moments(const Moments& moments);

/// The height of a pixel in widths of one; 1 for square pixels.
using PixelAspect = Fixed<std::int32_t, 28>;

/// The same moments in an image whose rows are aspect times as far apart as its columns, in units of a
/// column's distance (area and centroid stay those of the image). aspect 1/4 to 4.
///
/// Rounding  to a relative 2^-27; third moments are held at 2^61
constexpr CentralMoments stretched(const CentralMoments& moments, PixelAspect aspect);

/// The direction in which a region is longest.
///
/// axis        more than -90 up to 90 degrees: a region exactly along y has 90, where the book's table gives
///             -90
/// elongation  how clear the axis is: (greatest - least) / (greatest + least) second moment, 0 for a disc or
///             a square, towards 1 for a line
struct Orientation {
    FineAngle axis;
    Ratio elongation;
};

/// Errors  degenerate if all axes are alike (a disc, a square)
/// Source  book eq. 6.6-6.8
constexpr Result<Orientation> orientation(const CentralMoments& moments);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Sums of i, i^2, i^3 for i = 0..count-1.
struct PowerSums {
    std::int64_t first;
    std::int64_t second;
    std::int64_t third;
};
constexpr PowerSums power_sums(std::int64_t count) {
    const std::int64_t first = count * (count - 1) / 2;
    return {first, first * (2 * count - 1) / 3, first * first};
}

/// (a + b) mod 2^64 as signed: a sum whose true value fits comes out right, whatever it passed through.
constexpr std::int64_t wrap_add(std::int64_t a, std::int64_t b) {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) + static_cast<std::uint64_t>(b));
}
constexpr std::int64_t wrap_multiply(std::int64_t a, std::int64_t b) {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) * static_cast<std::uint64_t>(b));
}

/// The moments about (x, y). Exact: the true values fit, so sums modulo 2^64 give them.
constexpr Moments shifted(const Moments& m, std::int64_t x, std::int64_t y) {
    const auto less = [](std::int64_t value, std::int64_t a, std::int64_t b) {
        return wrap_add(value, -wrap_multiply(a, b));
    };
    Moments s;
    s.m00 = m.m00;
    s.m10 = less(m.m10, x, m.m00);
    s.m01 = less(m.m01, y, m.m00);
    s.m20 = less(less(m.m20, x, m.m10), x, s.m10);
    s.m11 = less(less(m.m11, y, m.m10), x, s.m01);
    s.m02 = less(less(m.m02, y, m.m01), y, s.m01);
    // One factor at a time: sum of (u - x) p = sum of u p - x sum of p.
    const std::int64_t m20_at_x = less(m.m20, x, m.m10);
    const std::int64_t m11_at_x = less(m.m11, x, m.m01);
    const std::int64_t m02_at_y = less(m.m02, y, m.m01);
    const std::int64_t m30_at_x = less(less(m.m30, x, m.m20), x, m20_at_x);
    s.m30 = less(m30_at_x, x, s.m20);
    const std::int64_t m21_at_x = less(less(m.m21, x, m.m11), x, m11_at_x);
    s.m21 = less(m21_at_x, y, s.m20);
    const std::int64_t m12_at_y = less(less(m.m12, y, m.m11), y, less(m.m11, y, m.m10));
    s.m12 = less(m12_at_y, x, s.m02);
    const std::int64_t m03_at_y = less(less(m.m03, y, m.m02), y, m02_at_y);
    s.m03 = less(m03_at_y, y, s.m02);
    return s;
}

/// value * aspect^power, rounded.
constexpr std::int64_t stretch(std::int64_t value, PixelAspect aspect, int power) {
    for (int i = 0; i < power; ++i) value = multiply_divide(value, aspect.raw(), PixelAspect::one);
    return clamp(value, -(std::int64_t{1} << 61), std::int64_t{1} << 61);
}

}  // namespace detail

constexpr void Moments::add_run(int first, int end, int y) {
    FOVEA_ASSERT(first >= 0 && first <= end && end <= max_moment_side && y >= 0 && y < max_moment_side);
    const detail::PowerSums before = detail::power_sums(first);
    const detail::PowerSums after = detail::power_sums(end);
    const std::int64_t count = end - first;
    const std::int64_t sum_x = after.first - before.first;
    const std::int64_t sum_xx = after.second - before.second;
    const std::int64_t row = y;
    m00 += count;
    m10 += sum_x;
    m01 += row * count;
    m20 += sum_xx;
    m11 += row * sum_x;
    m02 += row * row * count;
    m30 += after.third - before.third;
    m21 += row * sum_xx;
    m12 += row * row * sum_x;
    m03 += row * row * row * count;
}

constexpr void Moments::add(const Moments& other) {
    m00 += other.m00;
    m10 += other.m10;
    m01 += other.m01;
    m20 += other.m20;
    m11 += other.m11;
    m02 += other.m02;
    m30 += other.m30;
    m21 += other.m21;
    m12 += other.m12;
    m03 += other.m03;
}

constexpr Result<CentralMoments> central_moments(const Moments& moments) {
    const std::int64_t area = moments.m00;
    if (area <= 0) return Status::empty_image;
    // First about the nearest whole pixel, exactly; what is left of the shift is below half a pixel.
    const std::int64_t x = round_divide(moments.m10, area);
    const std::int64_t y = round_divide(moments.m01, area);
    const Moments m = detail::shifted(moments, x, y);
    const std::int64_t u = m.m10;  // at most area / 2 in magnitude, as is v
    const std::int64_t v = m.m01;

    CentralMoments c;
    c.area = area;
    c.centroid.x = FinePixel::from_ratio(x * area + u, area);
    c.centroid.y = FinePixel::from_ratio(y * area + v, area);
    const std::int64_t uu = multiply_divide(u, u, area);
    const std::int64_t vv = multiply_divide(v, v, area);
    constexpr std::int64_t one = SecondMoment::one;
    c.mu20 = SecondMoment::from_raw(m.m20 * one - multiply_divide(u * one, u, area));
    c.mu11 = SecondMoment::from_raw(m.m11 * one - multiply_divide(u * one, v, area));
    c.mu02 = SecondMoment::from_raw(m.m02 * one - multiply_divide(v * one, v, area));
    // mu30 = m30 - 3 u/A m20 + 2 u^3/A^2, and so on.
    c.mu30 = m.m30 - multiply_divide(3 * u, m.m20, area) + multiply_divide(2 * u, uu, area);
    c.mu21 = m.m21 - multiply_divide(v, m.m20, area) - multiply_divide(2 * u, m.m11, area) +
             multiply_divide(2 * v, uu, area);
    c.mu12 = m.m12 - multiply_divide(u, m.m02, area) - multiply_divide(2 * v, m.m11, area) +
             multiply_divide(2 * u, vv, area);
    c.mu03 = m.m03 - multiply_divide(3 * v, m.m02, area) + multiply_divide(2 * v, vv, area);
    return c;
}

constexpr CentralMoments stretched(const CentralMoments& moments, PixelAspect aspect) {
    CentralMoments s = moments;
    s.mu11 = SecondMoment::from_raw(detail::stretch(moments.mu11.raw(), aspect, 1));
    s.mu02 = SecondMoment::from_raw(detail::stretch(moments.mu02.raw(), aspect, 2));
    s.mu21 = detail::stretch(moments.mu21, aspect, 1);
    s.mu12 = detail::stretch(moments.mu12, aspect, 2);
    s.mu03 = detail::stretch(moments.mu03, aspect, 3);
    return s;
}

constexpr Result<Orientation> orientation(const CentralMoments& moments) {
    // At most 2^49 px^2 for 8191 x 8191 pixels, 2^61 as raw values when stretched by 4.
    const std::int64_t along = (moments.mu20 - moments.mu02).raw();
    const std::int64_t across = 2 * moments.mu11.raw();
    if (along == 0 && across == 0) return Status::degenerate;
    Orientation result;
    const std::uint32_t half = angle_of(along, across).raw() >> 1;  // 0 up to 180 degrees
    result.axis = FineAngle::from_raw(half > FineAngle::quarter_turn().raw() ? half + 0x80000000u : half);

    // Cut to 31 bits, so that the squares fit.
    const int drop = maximum(33 - leading_zeros(magnitude(along) | magnitude(across)), 0);
    const std::int64_t a = along >> drop;
    const std::int64_t b = across >> drop;
    const std::int64_t difference = static_cast<std::int64_t>(isqrt(magnitude(a * a + b * b))) << drop;
    const std::int64_t sum = maximum<std::int64_t>((moments.mu20 + moments.mu02).raw(), 1);
    result.elongation =
        Ratio::from_raw(saturate_cast<std::int32_t>(multiply_divide(difference, Ratio::one, sum)));
    return result;
}

}  // namespace fovea
