// SPDX-License-Identifier: MIT
//
// Slope: an exact walk along a straight line in integers, for lines and for the edges of polygons.
#pragma once

#include <cstdint>

#include <fovea/number/integer.hpp>

namespace fovea {

/// start + floor((rise * t + bias) / run) for t = first, first + 1, ...: two divisions to begin, one addition
/// and one comparison a step.
///
/// Shapes    0 <= t <= run, 0 < run <= 2^31, 0 <= bias < run, |rise| <= 2^31, start and start + rise within
///           -2^30..2^30
/// Rounding  a bias of run / 2 is to the nearest with ties toward plus infinity, run - 1 is up, 0 is down
/// Overflow  the largest product is 2^31 * 2^31; the remainder before its correction stays below 2 * run
/// Errors    none
/// Source    J. E. Bresenham, "Algorithm for computer control of a digital plotter", IBM Systems Journal 4,
///           1965, no. 1; here with a start anywhere on the line
class Slope {
public:
    constexpr Slope() = default;
    constexpr Slope(int start, std::int64_t rise, std::int64_t run, std::int64_t bias, std::int64_t first) {
        const std::int64_t whole = floor_divide(rise, run);
        const std::int64_t there = rise * first + bias;
        const std::int64_t passed = floor_divide(there, run);
        value_ = static_cast<std::int32_t>(start + passed);
        // Only a rise of 2^31 in a run of 1 saturates, and that line has no second step inside it.
        whole_ = saturate_cast<std::int32_t>(whole);
        part_ = static_cast<std::uint32_t>(rise - whole * run);
        remainder_ = static_cast<std::uint32_t>(there - passed * run);
        run_ = static_cast<std::uint32_t>(run);
    }

    constexpr int value() const { return static_cast<int>(value_); }

    /// One t further; from the last one, run, only when |rise| <= run.
    constexpr void step() {
        value_ += whole_;
        remainder_ += part_;
        if (remainder_ >= run_) {
            remainder_ -= run_;
            ++value_;
        }
    }

private:
    std::int32_t value_ = 0;
    std::int32_t whole_ = 0;
    std::uint32_t part_ = 0;
    std::uint32_t remainder_ = 0;
    std::uint32_t run_ = 1;
};

}  // namespace fovea
