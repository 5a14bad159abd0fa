// SPDX-License-Identifier: MIT
//
// StructuringElement: the neighbourhood of a morphological operator, of any shape. Book sec. 2.7.1.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/image/geometry.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

/// The longest side of an element of any shape.
inline constexpr int max_shape_side = 31;

/// A set of places around a pixel, which is in the middle: odd by odd, 1x1 to 31x31. The makers answer an
/// element of size 0x0, which every operator refuses, where theirs does not fit.
class StructuringElement {
public:
    constexpr StructuringElement() = default;

    static constexpr StructuringElement rectangle(Size size);
    /// The middle row and the middle column.
    static constexpr StructuringElement cross(Size size);
    /// The places nearer to the middle than half a pixel more than half the side: a square for 3.
    static constexpr StructuringElement disc(int side);
    /// A line through the middle, to `end` and as far to the other side.
    static constexpr StructuringElement line(Point end);
    /// Rows of '#' for places that belong and '.' for others, with '\n' between them.
    static constexpr StructuringElement from_text(const char* text);

    constexpr Size size() const { return size_; }
    constexpr bool empty() const { return count() == 0; }
    /// The places of a row: bit x for column x, from the left.
    constexpr std::uint32_t row(int y) const { return rows_[y]; }
    constexpr bool contains(int x, int y) const { return (rows_[y] >> x & 1) != 0; }
    constexpr int count() const {
        int places = 0;
        for (const std::uint32_t row : rows_)
            for (std::uint32_t rest = row; rest != 0; rest &= rest - 1) ++places;
        return places;
    }
    /// Turned by half a turn: x and y away from the middle become -x and -y.
    constexpr StructuringElement reflected() const;

private:
    static constexpr bool fits(Size size) {
        return size.width % 2 == 1 && size.height % 2 == 1 && size.width >= 1 && size.height >= 1 &&
               size.width <= max_shape_side && size.height <= max_shape_side;
    }
    template <class Belongs>
    static constexpr StructuringElement of(Size size, Belongs belongs) {
        StructuringElement element;
        if (!fits(size)) return element;
        element.size_ = size;
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x)
                if (belongs(x - size.width / 2, y - size.height / 2)) element.add(x, y);
        return element;
    }
    constexpr void add(int x, int y) { rows_[y] |= std::uint32_t{1} << x; }

    Size size_;
    std::uint32_t rows_[max_shape_side] = {};
};

constexpr StructuringElement StructuringElement::rectangle(Size size) {
    return of(size, [](int, int) { return true; });
}

constexpr StructuringElement StructuringElement::cross(Size size) {
    return of(size, [](int x, int y) { return x == 0 || y == 0; });
}

constexpr StructuringElement StructuringElement::disc(int side) {
    const int radius = side / 2;
    return of({side, side}, [=](int x, int y) { return x * x + y * y <= radius * (radius + 1); });
}

constexpr StructuringElement StructuringElement::line(Point end) {
    StructuringElement element;
    const std::uint32_t reach = maximum(magnitude(std::int32_t{end.x}), magnitude(std::int32_t{end.y}));
    if (reach > max_shape_side / 2) return element;
    const int width = static_cast<int>(magnitude(std::int32_t{end.x}));
    const int height = static_cast<int>(magnitude(std::int32_t{end.y}));
    element.size_ = {2 * width + 1, 2 * height + 1};
    element.add(width, height);
    const int steps = static_cast<int>(reach);
    for (int i = 1; i <= steps; ++i) {
        const int x = round_divide(i * end.x, steps);
        const int y = round_divide(i * end.y, steps);
        element.add(width + x, height + y);
        element.add(width - x, height - y);
    }
    return element;
}

constexpr StructuringElement StructuringElement::from_text(const char* text) {
    StructuringElement element;
    Size size{0, 1};
    int x = 0;
    for (const char* c = text; *c != '\0'; ++c) {
        if (*c == '\n') {
            if (size.height == 1) size.width = x;
            if (x != size.width || size.height == max_shape_side) return {};
            ++size.height;
            x = 0;
        } else {
            if ((*c != '#' && *c != '.') || x == max_shape_side) return {};
            if (*c == '#') element.add(x, size.height - 1);
            ++x;
        }
    }
    if (size.height == 1) size.width = x;
    if (x != size.width || !fits(size)) return {};
    element.size_ = size;
    return element;
}

constexpr StructuringElement StructuringElement::reflected() const {
    StructuringElement element;
    element.size_ = size_;
    for (int y = 0; y < size_.height; ++y)
        for (int x = 0; x < size_.width; ++x)
            if (contains(x, y)) element.add(size_.width - 1 - x, size_.height - 1 - y);
    return element;
}

}  // namespace fovea
