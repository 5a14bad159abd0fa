// SPDX-License-Identifier: MIT
//
// The modules of a Data Matrix in an image: where they are, how bright, and which of them are dark.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/code/data_matrix_corners.hpp>
#include <fovea/code/data_matrix_lines.hpp>
#include <fovea/code/data_matrix_placement.hpp>
#include <fovea/code/data_matrix_sizes.hpp>
#include <fovea/image/bit_view.hpp>
#include <fovea/number/integer.hpp>

namespace fovea::detail {

/// The unit square, x right and y down, onto a quadrilateral.
///
/// Source  Heckbert, Fundamentals of Texture Mapping, 1989
class SquareToQuad {
public:
    /// Corners in the order (0, 0), (1, 0), (1, 1), (0, 1). there() tells whether it is convex.
    SquareToQuad(EdgePlace p0, EdgePlace p1, EdgePlace p2, EdgePlace p3);

    bool there() const { return there_; }
    /// u and v in 1/65536, from -1/2 to 3/2.
    EdgePlace operator()(std::int32_t u, std::int32_t v) const { return place(sums(u, v)); }

    /// Places at the same distance from others: operator()(u + aside.u, v + aside.v) is place(sums(u, v) +
    /// sums(aside.u, aside.v)).
    struct Sums {
        std::int64_t x;
        std::int64_t y;
        std::int64_t divisor;

        friend Sums operator+(const Sums& a, const Sums& b) {
            return {a.x + b.x, a.y + b.y, a.divisor + b.divisor};
        }
    };
    Sums sums(std::int32_t u, std::int32_t v) const {
        return {ax_ * u + bx_ * v, ay_ * u + by_ * v, g_ * u + h_ * v};
    }
    EdgePlace place(const Sums& sums) const;

private:
    EdgePlace origin_;
    // In 1/65536 px, and 2^-20 for the divisor: |g| and |h| are below 4.
    std::int64_t ax_ = 0;
    std::int64_t bx_ = 0;
    std::int64_t ay_ = 0;
    std::int64_t by_ = 0;
    std::int64_t g_ = 0;
    std::int64_t h_ = 0;
    bool there_ = false;
};

/// Where in the unit square the middle of a module is, in 1/65536, rounded towards 0.
constexpr std::int32_t module_middle(std::int32_t module, std::int32_t modules) {
    return (2 * module + 1) * 32768 / modules;
}

/// Brightness of every module, 0 to 255, row by row.
inline void sample_modules(const CodeField& field, const SquareToQuad& map, int rows, int columns,
                           std::int32_t pitch, Span<std::uint8_t> values);

/// How modules become dark or light.
enum class ModuleRule : std::uint8_t {
    one_level,    ///< between the mean dark and the mean light module of the borders
    near_levels,  ///< between the darkest and the lightest module near by
    sharpened,    ///< the same, a share of the four neighbours taken off
};
inline constexpr int module_rules = 3;

inline void classify_modules(Span<const std::uint8_t> values, const DataMatrixSize& size, ModuleRule rule,
                             Span<std::uint8_t> scratch, BitView<BitWord> modules);

inline SquareToQuad::SquareToQuad(EdgePlace p0, EdgePlace p1, EdgePlace p2, EdgePlace p3) : origin_(p0) {
    const EdgePlace d1 = p1 - p2;
    const EdgePlace d2 = p3 - p2;
    const EdgePlace s = p0 - p1 + p2 - p3;
    const auto cross = [](EdgePlace a, EdgePlace b) {
        return std::int64_t{a.x} * b.y - std::int64_t{a.y} * b.x;
    };
    // Sides of 2^25 make products of 2^51, and 2^12 more before the division.
    const std::int64_t w = cross(d1, d2);
    const std::int64_t turns[3] = {cross(p1 - p0, p3 - p0), cross(p2 - p1, p0 - p1), cross(p0 - p3, p2 - p3)};
    for (const std::int64_t turn : turns)
        if (turn == 0 || (turn > 0) == (w > 0)) return;
    if (w == 0) return;
    const auto ratio = [w](std::int64_t n) {
        // To 2^-20, the numerator of 42 bits at most.
        const int drop = maximum(22 - leading_zeros(magnitude(n)), 0);
        const std::int64_t divisor = w >> drop;
        if (divisor == 0) return std::int64_t{1} << 30;
        return (n >> drop) * (std::int64_t{1} << 20) / divisor;
    };
    g_ = ratio(cross(s, d2));
    h_ = ratio(cross(d1, s));
    constexpr std::int64_t most = std::int64_t{4} << 20;
    if (g_ > most || g_ < -(most * 3 / 16) || h_ > most || h_ < -(most * 3 / 16)) return;
    // The divisor is at least 1/4 at every corner, and 1/8 half a square beyond: see operator().
    if ((1 << 20) + g_ + h_ < (1 << 18)) return;
    const auto scaled = [](std::int64_t way, std::int64_t far, std::int64_t k) {
        return way * 256 + (far * k >> 12);
    };
    ax_ = scaled(p1.x - p0.x, p1.x - p0.x, g_);
    ay_ = scaled(p1.y - p0.y, p1.y - p0.y, g_);
    bx_ = scaled(p3.x - p0.x, p3.x - p0.x, h_);
    by_ = scaled(p3.y - p0.y, p3.y - p0.y, h_);
    there_ = true;
}

inline EdgePlace SquareToQuad::place(const Sums& sums) const {
    // Numerators of 2^35 and 17 bits, then shifted to 2^36 + 12.
    const std::int64_t x = sums.x >> 16;
    const std::int64_t y = sums.y >> 16;
    const std::int64_t divisor = (std::int64_t{1} << 20) + (sums.divisor >> 16);
    if (divisor == 1 << 20)
        return origin_ + EdgePlace{static_cast<std::int32_t>(x >> 8), static_cast<std::int32_t>(y >> 8)};
    const std::int64_t by = maximum<std::int64_t>(divisor, 1 << 16);
    constexpr std::int64_t most = std::int64_t{1} << 24;
    return origin_ + EdgePlace{static_cast<std::int32_t>(clamp(x * 4096 / by, -most, most)),
                               static_cast<std::int32_t>(clamp(y * 4096 / by, -most, most))};
}

inline void sample_modules(const CodeField& field, const SquareToQuad& map, int rows, int columns,
                           std::int32_t pitch, Span<std::uint8_t> values) {
    // Where a module has room for it, five places an eighth of a module apart.
    const bool wide = pitch >= 3 * 256;
    const std::int32_t aside_u = 65536 / (6 * columns);
    const std::int32_t aside_v = 65536 / (6 * rows);
    const SquareToQuad::Sums asides[4] = {map.sums(-aside_u, -aside_v), map.sums(aside_u, -aside_v),
                                          map.sums(-aside_u, aside_v), map.sums(aside_u, aside_v)};
    for (int y = 0; y < rows; ++y) {
        const SquareToQuad::Sums row = map.sums(0, module_middle(y, rows));
        for (int x = 0; x < columns; ++x) {
            const SquareToQuad::Sums middle = row + map.sums(module_middle(x, columns), 0);
            const EdgePlace p = map.place(middle);
            int sum = field.sample(p.x, p.y);
            if (wide) {
                for (const SquareToQuad::Sums& aside : asides) {
                    const EdgePlace q = map.place(middle + aside);
                    sum += field.sample(q.x, q.y);
                }
                sum /= 5;
            }
            values[std::ptrdiff_t{y} * columns + x] = static_cast<std::uint8_t>(sum >> 4);
        }
    }
}

/// Mean brightness of the border's dark and light modules.
struct BorderLevels {
    int dark = 0;
    int light = 0;
};
inline BorderLevels border_levels(Span<const std::uint8_t> values, const DataMatrixSize& size) {
    int sums[2] = {};
    int counts[2] = {};
    const auto take = [&](int x, int y) {
        const int light = data_matrix_border(size, x, y) == DataMatrixModule::light ? 1 : 0;
        sums[light] += values[std::ptrdiff_t{y} * size.columns + x];
        ++counts[light];
    };
    for (int x = 0; x < size.columns; ++x) {
        take(x, 0);
        take(x, size.rows - 1);
    }
    for (int y = 1; y + 1 < size.rows; ++y) {
        take(0, y);
        take(size.columns - 1, y);
    }
    return {sums[0] / counts[0], sums[1] / counts[1]};
}

inline void classify_modules(Span<const std::uint8_t> values, const DataMatrixSize& size, ModuleRule rule,
                             Span<std::uint8_t> scratch, BitView<BitWord> modules) {
    const int columns = size.columns;
    const int rows = size.rows;
    const auto at = [&](Span<const std::uint8_t> from, int x, int y) {
        return int{from[std::ptrdiff_t{clamp(y, 0, rows - 1)} * columns + clamp(x, 0, columns - 1)]};
    };
    const BorderLevels levels = border_levels(values, size);
    const int level = (levels.dark + levels.light + 1) / 2;
    if (rule == ModuleRule::one_level) {
        const std::uint8_t* value = values.data();
        for (int y = 0; y < rows; ++y)
            for (int x = 0; x < columns; ++x) modules.set(x, y, *value++ < level);
        return;
    }
    Span<const std::uint8_t> from = values;
    if (rule == ModuleRule::sharpened) {
        for (int y = 0; y < rows; ++y)
            for (int x = 0; x < columns; ++x) {
                const int near =
                    at(values, x - 1, y) + at(values, x + 1, y) + at(values, x, y - 1) + at(values, x, y + 1);
                // 5/3 of itself less 1/6 of each neighbour.
                scratch[std::ptrdiff_t{y} * columns + x] =
                    static_cast<std::uint8_t>(clamp((10 * at(values, x, y) - near) / 6, 0, 255));
            }
        from = scratch;
    }
    const int spread = maximum(levels.light - levels.dark, 1);
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            int low = 255;
            int high = 0;
            for (int j = -3; j <= 3; ++j)
                for (int i = -3; i <= 3; ++i) {
                    const int value = at(from, x + i, y + j);
                    low = minimum(low, value);
                    high = maximum(high, value);
                }
            const int threshold = 2 * (high - low) < spread ? level : (low + high + 1) / 2;
            modules.set(x, y, at(from, x, y) < threshold);
        }
}

}  // namespace fovea::detail
