// SPDX-License-Identifier: MIT
//
// The slow obvious versions that every operator must equal.
#pragma once

#include <algorithm>

#include <fovea/image/image_view.hpp>

namespace fovea::test {

/// Pixel with the outermost ones repeated.
inline Gray8 replicated(ImageView<const Gray8> image, int x, int y) {
    return image(std::clamp(x, 0, image.width() - 1), std::clamp(y, 0, image.height() - 1));
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
