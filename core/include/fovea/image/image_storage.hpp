// SPDX-License-Identifier: MIT
//
// ImageStorage: room for an image, sized when the program is compiled.
#pragma once

#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>

namespace fovea {

/// Owns Width x Height pixels, zero at first, rows without gaps.
template <class Pixel, int Width, int Height>
class ImageStorage {
public:
    static_assert(Width > 0 && Height > 0, "an image has at least one pixel");
    static_assert(Width <= max_image_side && Height <= max_image_side,
                  "an image side is at most max_image_side");

    constexpr ImageView<Pixel> view() { return {pixels_, {Width, Height}, stride}; }
    constexpr ImageView<const Pixel> view() const { return {pixels_, {Width, Height}, stride}; }

private:
    static constexpr std::ptrdiff_t stride = static_cast<std::ptrdiff_t>(sizeof(Pixel)) * Width;
    Pixel pixels_[static_cast<std::size_t>(Width) * Height]{};
};

}  // namespace fovea
