// SPDX-License-Identifier: MIT
//
// Points, sizes and rectangles of an image. x right, y down, pixel (0, 0) has its centre at (0, 0).
#pragma once

#include <cstdint>

#include <fovea/number/fixed.hpp>

namespace fovea {

/// The longest side an image may have; coordinates in SubPixel and sums of the operators are bounded by it.
inline constexpr int max_image_side = 32767;

struct Size {
    int width = 0;
    int height = 0;

    constexpr bool empty() const { return width <= 0 || height <= 0; }
    constexpr std::int64_t area() const { return std::int64_t{width} * height; }
    friend constexpr bool operator==(Size a, Size b) { return a.width == b.width && a.height == b.height; }
    friend constexpr bool operator!=(Size a, Size b) { return !(a == b); }
};

struct Point {
    int x = 0;
    int y = 0;

    friend constexpr bool operator==(Point a, Point b) { return a.x == b.x && a.y == b.y; }
    friend constexpr bool operator!=(Point a, Point b) { return !(a == b); }
};

/// A place between pixels, in 1/256 px.
struct SubPixelPoint {
    SubPixel x;
    SubPixel y;

    friend constexpr bool operator==(SubPixelPoint a, SubPixelPoint b) { return a.x == b.x && a.y == b.y; }
    friend constexpr bool operator!=(SubPixelPoint a, SubPixelPoint b) { return !(a == b); }
};

/// A place that was measured, in 1/65536 px.
struct FinePoint {
    FinePixel x;
    FinePixel y;

    friend constexpr bool operator==(FinePoint a, FinePoint b) { return a.x == b.x && a.y == b.y; }
    friend constexpr bool operator!=(FinePoint a, FinePoint b) { return !(a == b); }
};

/// Columns x..x+width-1 and rows y..y+height-1.
struct Rectangle {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;

    constexpr bool empty() const { return width <= 0 || height <= 0; }
    constexpr Size size() const { return {width, height}; }
    constexpr int right() const { return x + (width - 1); }
    constexpr int bottom() const { return y + (height - 1); }
    constexpr bool contains(Point p) const {
        return p.x >= x && std::int64_t{p.x} - x < width && p.y >= y && std::int64_t{p.y} - y < height;
    }
    friend constexpr bool operator==(Rectangle a, Rectangle b) {
        return a.x == b.x && a.y == b.y && a.width == b.width && a.height == b.height;
    }
};

}  // namespace fovea
