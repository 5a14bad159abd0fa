// SPDX-License-Identifier: MIT
//
// ImageView: pixels somebody else owns. The only way foreign memory becomes one is view_over().
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <fovea/base/assert.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/pixel.hpp>

namespace fovea {

/// Pointer, size and distance of rows in bytes. Copying is free; an empty view has no pixels.
template <class Pixel>
class ImageView {
    using Byte = std::conditional_t<std::is_const_v<Pixel>, const std::uint8_t, std::uint8_t>;

public:
    using value_type = std::remove_const_t<Pixel>;

    constexpr ImageView() = default;
    /// For memory that is known to fit. Foreign memory goes through view_over().
    constexpr ImageView(Pixel* first, Size size, std::ptrdiff_t stride_bytes)
        : first_(first), size_(size), stride_bytes_(stride_bytes) {
        FOVEA_ASSERT(size.width >= 0 && size.height >= 0);
    }
    template <class Other, class = std::enable_if_t<std::is_same_v<const Other, Pixel>>>
    constexpr ImageView(ImageView<Other> other)
        : first_(other.first()), size_(other.size()), stride_bytes_(other.stride_bytes()) {}

    constexpr Pixel* first() const { return first_; }
    constexpr Size size() const { return size_; }
    constexpr int width() const { return size_.width; }
    constexpr int height() const { return size_.height; }
    constexpr std::ptrdiff_t stride_bytes() const { return stride_bytes_; }
    constexpr bool empty() const { return size_.empty(); }
    constexpr bool contains(Point p) const { return p.x >= 0 && p.x < width() && p.y >= 0 && p.y < height(); }

    Pixel* row(int y) const {
        FOVEA_ASSERT(y >= 0 && y < height());
        return reinterpret_cast<Pixel*>(reinterpret_cast<Byte*>(first_) + y * stride_bytes_);
    }
    Pixel& operator()(int x, int y) const {
        FOVEA_ASSERT(x >= 0 && x < width());
        return row(y)[x];
    }

    /// The pixels of area as a view of its own, or out_of_range when area is not wholly inside. An area
    /// without pixels is empty_image.
    Result<ImageView> crop(Rectangle area) const {
        if (area.empty()) return Status::empty_image;
        if (area.x < 0 || area.y < 0 || area.width > width() - area.x || area.height > height() - area.y)
            return Status::out_of_range;
        return ImageView(row(area.y) + area.x, area.size(), stride_bytes_);
    }

private:
    Pixel* first_ = nullptr;
    Size size_;
    std::ptrdiff_t stride_bytes_ = 0;
};

/// Foreign memory as an image.
///
/// Shapes  height rows of width pixels, stride_bytes apart; the last row needs only its pixels
/// Errors  empty_image; image_too_large above max_image_side; bad_argument for a stride shorter than a row or
///         not a multiple of the pixel's alignment; misaligned; truncated if bytes are too few
template <class Pixel, class Byte>
Result<ImageView<Pixel>> view_over(Span<Byte> bytes, Size size, std::ptrdiff_t stride_bytes) {
    static_assert(std::is_same_v<std::remove_const_t<Byte>, std::uint8_t>, "foreign memory comes as bytes");
    static_assert(std::is_const_v<Pixel> || !std::is_const_v<Byte>,
                  "read-only memory needs a read-only pixel");
    if (size.empty()) return Status::empty_image;
    if (size.width > max_image_side || size.height > max_image_side) return Status::image_too_large;
    const std::int64_t row_bytes = std::int64_t{size.width} * static_cast<std::int64_t>(sizeof(Pixel));
    const std::int64_t stride = stride_bytes;
    if (stride < row_bytes || stride % static_cast<std::int64_t>(alignof(Pixel)) != 0)
        return Status::bad_argument;
    if (reinterpret_cast<std::uintptr_t>(bytes.data()) % alignof(Pixel) != 0) return Status::misaligned;
    // Compared by division, so that no stride overflows the product.
    const std::int64_t room = bytes.size() - row_bytes;
    if (room < 0 || (size.height > 1 && stride > room / (size.height - 1))) return Status::truncated;
    return ImageView<Pixel>(reinterpret_cast<Pixel*>(bytes.data()), size, stride_bytes);
}

}  // namespace fovea
