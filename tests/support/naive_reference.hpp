// SPDX-License-Identifier: MIT
//
// The slow obvious versions that every operator must equal.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <fovea/image/border.hpp>
#include <fovea/image/image_view.hpp>

namespace fovea::test {

/// Pixel with the outermost ones repeated.
inline Gray8 replicated(ImageView<const Gray8> image, int x, int y) {
    return image(std::clamp(x, 0, image.width() - 1), std::clamp(y, 0, image.height() - 1));
}

/// Pixel of an image that continues as border says.
inline Gray8 bordered(ImageView<const Gray8> image, Border border, int x, int y) {
    const int column = border_index(border, x, image.width());
    const int row = border_index(border, y, image.height());
    return column == no_index || row == no_index ? Gray8{0} : image(column, row);
}

/// The sum of weights times pixels; weights are width by height, row by row, and centred.
inline int naive_correlation(ImageView<const Gray8> image, Border border, Size size,
                             const std::vector<int>& weights, int x, int y) {
    int sum = 0;
    for (int j = 0; j < size.height; ++j)
        for (int i = 0; i < size.width; ++i)
            sum += weights[static_cast<std::size_t>(j * size.width + i)] *
                   bordered(image, border, x + i - size.width / 2, y + j - size.height / 2);
    return sum;
}

/// All pixels of a window.
inline std::vector<Gray8> naive_window(ImageView<const Gray8> image, Border border, Size size, int x, int y) {
    std::vector<Gray8> pixels;
    for (int j = 0; j < size.height; ++j)
        for (int i = 0; i < size.width; ++i)
            pixels.push_back(bordered(image, border, x + i - size.width / 2, y + j - size.height / 2));
    return pixels;
}

inline Gray8 naive_extreme(ImageView<const Gray8> src, Size element, int x, int y, bool lowest) {
    Gray8 extreme = lowest ? 255 : 0;
    for (int dy = -(element.height / 2); dy <= element.height / 2; ++dy)
        for (int dx = -(element.width / 2); dx <= element.width / 2; ++dx) {
            const Gray8 value = replicated(src, x + dx, y + dy);
            extreme = lowest ? std::min(extreme, value) : std::max(extreme, value);
        }
    return extreme;
}

}  // namespace fovea::test
