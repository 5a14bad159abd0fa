// SPDX-License-Identifier: MIT
//
// Places of objects, in whole units of the user's choice: what is seen at a place of an image.
#pragma once

#include <cstddef>
#include <cstdint>

namespace fovea {

/// A place on a plane: a corner of a board, a hole of a plate.
struct PlanePoint {
    std::int32_t x = 0;
    std::int32_t y = 0;

    friend constexpr bool operator==(PlanePoint a, PlanePoint b) { return a.x == b.x && a.y == b.y; }
    friend constexpr bool operator!=(PlanePoint a, PlanePoint b) { return !(a == b); }
};

/// A place in space.
struct SpacePoint {
    std::int32_t x = 0;
    std::int32_t y = 0;
    std::int32_t z = 0;

    friend constexpr bool operator==(SpacePoint a, SpacePoint b) {
        return a.x == b.x && a.y == b.y && a.z == b.z;
    }
    friend constexpr bool operator!=(SpacePoint a, SpacePoint b) { return !(a == b); }
};

namespace detail {

/// Of places that a fit takes: bounds its sums.
inline constexpr std::ptrdiff_t most_pairs = std::ptrdiff_t{1} << 20;

}  // namespace detail
}  // namespace fovea
