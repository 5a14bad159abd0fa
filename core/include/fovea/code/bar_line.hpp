// SPDX-License-Identifier: MIT
//
// Scan lines: the brightness along a line at any angle, averaged over some parallel ones.
#pragma once

#include <cstdint>

#include <fovea/base/assert.hpp>
#include <fovea/base/span.hpp>
#include <fovea/code/bar_edges.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Samples along a line, a pixel or less apart.
struct BarLine {
    FinePoint from;
    FinePoint step;  ///< from one sample to the next
    int samples = 0;
};

/// The point at a place in 1/256 sample.
constexpr SubPixelPoint point_of(const BarLine& line, std::int32_t place);

/// The part of a line through two points that lies in the image and reaches beyond either end by `beyond` /
/// 16 of their distance. No samples if they are one.
inline BarLine bar_line_through(Size size, SubPixelPoint from, SubPixelPoint to, int beyond);

/// Samples a line inside the image, each the mean of `breadth` parallel lines a pixel apart, breadth odd and
/// at most 127.
/// What lies outside the image is what its border shows.
inline void sample_bar_line(ImageView<const Gray8> src, const BarLine& line, int breadth,
                            Span<std::int16_t> profile);

// ---- Implementation ---------------------------------------------------------------

constexpr SubPixelPoint point_of(const BarLine& line, std::int32_t place) {
    const auto at = [&](FinePixel from, FinePixel step) {
        return SubPixel::from_raw(
            static_cast<std::int32_t>(round_shift(from.raw() + (std::int64_t{step.raw()} * place >> 8), 8)));
    };
    return {at(line.from.x, line.step.x), at(line.from.y, line.step.y)};
}

namespace detail {

/// Narrows the samples low..high to those for which 0 <= from + step * sample <= most.
constexpr void clip_samples(std::int64_t from, std::int64_t step, std::int64_t most, std::int64_t& low,
                            std::int64_t& high) {
    if (step == 0) {
        if (from < 0 || from > most) high = low - 1;
        return;
    }
    const std::int64_t a = step > 0 ? -from : from - most;
    const std::int64_t b = step > 0 ? most - from : from;
    const std::int64_t pace = step > 0 ? step : -step;
    low = maximum(low, -floor_divide(-a, pace));
    high = minimum(high, floor_divide(b, pace));
}

}  // namespace detail

inline BarLine bar_line_through(Size size, SubPixelPoint from, SubPixelPoint to, int beyond) {
    const std::int64_t x = std::int64_t{to.x.raw()} - from.x.raw();
    const std::int64_t y = std::int64_t{to.y.raw()} - from.y.raw();
    const std::int64_t length = hypotenuse(x, y);
    BarLine line;
    if (length < 256) return line;
    const std::int64_t step_x = round_divide(x * 65536, length);
    const std::int64_t step_y = round_divide(y * 65536, length);
    const std::int64_t samples = length / 256;
    std::int64_t low = -samples * beyond / 16;
    std::int64_t high = samples + samples * beyond / 16;
    const std::int64_t from_x = std::int64_t{from.x.raw()} * 256;
    const std::int64_t from_y = std::int64_t{from.y.raw()} * 256;
    detail::clip_samples(from_x, step_x, (std::int64_t{size.width} - 1) * 65536, low, high);
    detail::clip_samples(from_y, step_y, (std::int64_t{size.height} - 1) * 65536, low, high);
    if (high <= low) return line;
    const auto raw = [](std::int64_t value) { return FinePixel::from_raw(static_cast<std::int32_t>(value)); };
    line.from = {raw(from_x + low * step_x), raw(from_y + low * step_y)};
    line.step = {raw(step_x), raw(step_y)};
    line.samples = static_cast<int>(minimum<std::int64_t>(high - low + 1, size.width + size.height));
    return line;
}

namespace detail {

/// The mean of `breadth` rows or columns beside each other: sums of at most 127 * 255 fit 16 bits.
inline void sample_on_grid(ImageView<const Gray8> src, Point from, bool is_row, int samples, int breadth,
                           Span<std::int16_t> profile) {
    const int last = (is_row ? src.height() : src.width()) - 1;
    for (int i = 0; i < samples; ++i) profile[i] = 0;
    for (int k = -(breadth / 2); k <= breadth / 2; ++k) {
        if (is_row) {
            const Gray8* row = src.row(clamp(from.y + k, 0, last)) + from.x;
            for (int i = 0; i < samples; ++i) profile[i] = static_cast<std::int16_t>(profile[i] + row[i]);
        } else {
            const int x = clamp(from.x + k, 0, last);
            for (int i = 0; i < samples; ++i)
                profile[i] = static_cast<std::int16_t>(profile[i] + src(x, from.y + i));
        }
    }
    const std::int32_t reciprocal = 65536 / breadth;
    for (int i = 0; i < samples; ++i)
        profile[i] = static_cast<std::int16_t>((profile[i] * 16 * reciprocal + 32768) >> 16);
}

/// Brightness between the pixels at, right of, below and below right of a place, in 1/16 grey level. Of x and
/// y the lower 16 bits count, in 1/65536 px.
constexpr std::int32_t brightness_between(const Gray8* upper, const Gray8* lower, int left, int right,
                                          std::int32_t x, std::int32_t y) {
    const std::int32_t right_share = x >> 8 & 255;
    const std::int32_t a = upper[left] * 256 + (upper[right] - upper[left]) * right_share;
    const std::int32_t b = lower[left] * 256 + (lower[right] - lower[left]) * right_share;
    return (a * 256 + (b - a) * (y >> 8 & 255)) >> 12;
}

/// At a place in 1/65536 px; beyond the image is what its border shows.
inline std::int32_t brightness_at(ImageView<const Gray8> src, std::int64_t x, std::int64_t y) {
    const int last_x = src.width() - 1;
    const int last_y = src.height() - 1;
    const auto in_x = static_cast<std::int32_t>(clamp<std::int64_t>(x, 0, std::int64_t{last_x} * 65536));
    const auto in_y = static_cast<std::int32_t>(clamp<std::int64_t>(y, 0, std::int64_t{last_y} * 65536));
    const int left = in_x >> 16;
    const int top = in_y >> 16;
    return brightness_between(src.row(top), src.row(minimum(top + 1, last_y)), left,
                              minimum(left + 1, last_x), in_x, in_y);
}
/// The same where the right and the lower neighbour are in the image.
inline std::int32_t brightness_inside(ImageView<const Gray8> src, std::int64_t x, std::int64_t y) {
    const auto left = static_cast<int>(x >> 16);
    const auto top = static_cast<int>(y >> 16);
    return brightness_between(src.row(top), src.row(top + 1), left, left + 1, static_cast<std::int32_t>(x),
                              static_cast<std::int32_t>(y));
}

}  // namespace detail

inline void sample_bar_line(ImageView<const Gray8> src, const BarLine& line, int breadth,
                            Span<std::int16_t> profile) {
    FOVEA_ASSERT(breadth >= 1 && breadth <= 127);
    const std::int32_t from_x = line.from.x.raw();
    const std::int32_t from_y = line.from.y.raw();
    const std::int32_t step_x = line.step.x.raw();
    const std::int32_t step_y = line.step.y.raw();
    const bool on_grid = (from_x & 0xffff) == 0 && (from_y & 0xffff) == 0;
    const bool is_row = on_grid && step_x == 65536 && step_y == 0;
    const bool is_column = on_grid && step_x == 0 && step_y == 65536;
    if (is_row && breadth == 1) {
        const Gray8* row = src.row(from_y >> 16) + (from_x >> 16);
        for (int i = 0; i < line.samples; ++i) profile[i] = static_cast<std::int16_t>(row[i] * 16);
        return;
    }
    if (is_row || is_column) {
        const Point from{from_x >> 16, from_y >> 16};
        detail::sample_on_grid(src, from, is_row, line.samples, breadth, profile);
        return;
    }
    // Of most lines all samples lie in the image, as those at their ends do.
    const int half = breadth / 2;
    const auto is_inside = [&](std::int64_t i, std::int64_t k) {
        const std::int64_t x = (from_x + step_x * i - step_y * k) >> 16;
        const std::int64_t y = (from_y + step_y * i + step_x * k) >> 16;
        return x >= 0 && x + 1 < src.width() && y >= 0 && y + 1 < src.height();
    };
    const int end = line.samples - 1;
    const bool inside =
        is_inside(0, -half) && is_inside(0, half) && is_inside(end, -half) && is_inside(end, half);
    const std::int32_t reciprocal = 65536 / breadth;
    const auto sample = [&](auto brightness) {
        for (int i = 0; i < line.samples; ++i) {
            // Across the line: the step turned by a quarter.
            std::int64_t x = from_x + std::int64_t{step_x} * i + std::int64_t{step_y} * half;
            std::int64_t y = from_y + std::int64_t{step_y} * i - std::int64_t{step_x} * half;
            std::int32_t sum = 0;
            for (int k = -half; k <= half; ++k, x -= step_y, y += step_x) sum += brightness(src, x, y);
            profile[i] = static_cast<std::int16_t>((std::int64_t{sum} * reciprocal + 32768) >> 16);
        }
    };
    if (inside) {
        sample([](ImageView<const Gray8> image, std::int64_t x, std::int64_t y) {
            return detail::brightness_inside(image, x, y);
        });
    } else {
        sample([](ImageView<const Gray8> image, std::int64_t x, std::int64_t y) {
            return detail::brightness_at(image, x, y);
        });
    }
}

}  // namespace fovea
