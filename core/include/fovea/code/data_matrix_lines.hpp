// SPDX-License-Identifier: MIT
//
// Edges in an image as lines, in 1/256 px, for symbols of modules.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/code/code_field.hpp>
#include <fovea/number/integer.hpp>

namespace fovea::detail {

/// A place or a way in 1/256 px. Images reach 2^23, ways between their places 2^24.
struct EdgePlace {
    std::int32_t x = 0;
    std::int32_t y = 0;

    friend constexpr EdgePlace operator+(EdgePlace a, EdgePlace b) { return {a.x + b.x, a.y + b.y}; }
    friend constexpr EdgePlace operator-(EdgePlace a, EdgePlace b) { return {a.x - b.x, a.y - b.y}; }
};

/// A direction of length 2^14.
struct Direction {
    std::int32_t x = 1 << 14;
    std::int32_t y = 0;

    constexpr Direction reversed() const { return {-x, -y}; }
    constexpr Direction right() const { return {-y, x}; }
    constexpr EdgePlace times(std::int32_t length) const {
        return {static_cast<std::int32_t>(std::int64_t{x} * length >> 14),
                static_cast<std::int32_t>(std::int64_t{y} * length >> 14)};
    }
    constexpr std::int32_t along(EdgePlace way) const {
        return static_cast<std::int32_t>((std::int64_t{x} * way.x + std::int64_t{y} * way.y) >> 14);
    }
};
constexpr Direction direction_of(std::int64_t x, std::int64_t y) {
    const std::int64_t length = hypotenuse(x, y);
    if (length == 0) return {};
    return {static_cast<std::int32_t>(x * (1 << 14) / length),
            static_cast<std::int32_t>(y * (1 << 14) / length)};
}

struct EdgeLine {
    EdgePlace at;
    Direction direction;
};

/// Samples at start + direction.times(first + n * step), n from 0 on.
inline FieldSteps steps_along(const CodeField& field, EdgePlace start, Direction direction,
                              std::int32_t first, std::int32_t step) {
    constexpr std::int64_t unit = 1 << 14;
    return FieldSteps(field, start.x * unit + std::int64_t{direction.x} * first,
                      start.y * unit + std::int64_t{direction.y} * first, std::int64_t{direction.x} * step,
                      std::int64_t{direction.y} * step);
}

/// Where two lines cross; not_found where they hardly do, or far outside of any image.
constexpr Result<EdgePlace> crossing(const EdgeLine& a, const EdgeLine& b);

/// The line through places told by their way along a line (x) and aside of it (y); twice, the second time
/// without those that lie farther off than the others. False for fewer than three places, or all alike.
inline bool fit_edge(Span<const EdgePlace> offsets, const EdgeLine& about, Direction aside, EdgeLine& line);

constexpr Result<EdgePlace> crossing(const EdgeLine& a, const EdgeLine& b) {
    const std::int64_t turn =
        std::int64_t{a.direction.x} * b.direction.y - std::int64_t{a.direction.y} * b.direction.x;
    // Sine below 1/8.
    if (turn < (1 << 25) && turn > -(1 << 25)) return Status::not_found;
    const EdgePlace way = b.at - a.at;
    // Up to 2^40 times 2^14 below.
    const std::int64_t along = (std::int64_t{way.x} * b.direction.y - std::int64_t{way.y} * b.direction.x);
    const std::int64_t length = along * (1 << 14) / turn;
    if (length > (1 << 24) || length < -(1 << 24)) return Status::not_found;
    return a.at + a.direction.times(static_cast<std::int32_t>(length));
}

inline bool fit_edge(Span<const EdgePlace> offsets, const EdgeLine& about, Direction aside, EdgeLine& line) {
    std::int64_t slope = 0;  // 2^-14
    std::int64_t zero = 0;   // 1/256 px
    std::int64_t limit = std::int64_t{1} << 30;
    for (int round = 0; round < 3; ++round) {
        std::int64_t n = 0;
        std::int64_t su = 0;
        std::int64_t sv = 0;
        std::int64_t suu = 0;
        std::int64_t suv = 0;
        for (const EdgePlace p : offsets) {
            const std::int64_t off = p.y - zero - (slope * p.x >> 14);
            if (off > limit || off < -limit) continue;
            ++n;
            su += p.x;
            sv += p.y;
            suu += std::int64_t{p.x} * p.x;
            suv += std::int64_t{p.x} * p.y;
        }
        if (n < 3) return false;
        // Ways of at most 2^24 and 200 places: sums below 2^56, and n times them below 2^63.
        const std::int64_t spread = (n * suu - su * su) >> 14;
        if (spread <= 0) return false;
        slope = clamp<std::int64_t>((n * suv - su * sv) / spread, -(1 << 13), 1 << 13);
        zero = (sv - (slope * su >> 14)) / n;
        std::int64_t sum = 0;
        for (const EdgePlace p : offsets) {
            const std::int64_t off = p.y - zero - (slope * p.x >> 14);
            sum += minimum<std::int64_t>(off < 0 ? -off : off, limit);
        }
        limit = maximum<std::int64_t>(64, 2 * sum / static_cast<std::int64_t>(offsets.size()));
    }
    line.at = about.at + aside.times(static_cast<std::int32_t>(zero));
    line.direction = direction_of(about.direction.x + (slope * aside.x >> 14),
                                  about.direction.y + (slope * aside.y >> 14));
    return true;
}

}  // namespace fovea::detail
