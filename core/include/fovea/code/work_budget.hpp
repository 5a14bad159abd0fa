// SPDX-License-Identifier: MIT
//
// A bound on what a reader of codes does to an image, counted and not timed: it ends at the same place on
// every machine.
#pragma once

#include <cstdint>

#include <fovea/image/geometry.hpp>

namespace fovea::detail {

/// Units of work that are left, each about one pixel that is looked at. What is begun is finished, so that a
/// budget may be overspent by the dearest thing that is done between two looks at it.
class WorkBudget {
public:
    constexpr WorkBudget() = default;
    explicit constexpr WorkBudget(std::int64_t units) : left_(units) {}
    /// So many units a pixel, and some for an image of few pixels.
    constexpr WorkBudget(Size size, int a_pixel, int least)
        : left_(size.area() * a_pixel > least ? size.area() * a_pixel : std::int64_t{least}) {}

    constexpr void spend(std::int64_t units) { left_ -= units; }
    /// So many units more, for what was begun and must come to an end.
    constexpr void extend(std::int64_t units) { left_ += units; }
    constexpr bool spent() const { return left_ <= 0; }
    constexpr std::int64_t left() const { return left_; }

private:
    std::int64_t left_ = 0;
};

}  // namespace fovea::detail
