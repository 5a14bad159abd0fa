// SPDX-License-Identifier: MIT
//
// Integral images (summed area tables): the sum over any rectangle from four numbers.
#pragma once

#include <cstdint>
#include <type_traits>

#include <fovea/base/status.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/prefix.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The size of the integral image: a row and a column of zeros come first, so that no rectangle is a special
/// case.
constexpr Size integral_size(Size size) { return {size.width + 1, size.height + 1}; }

inline namespace FOVEA_ISA {

/// dst(x, y) is the sum of all pixels of src left of x and above y.
///
/// Shapes   dst integral_size(src.size())
/// Units    sums modulo 2^32: up to 16.8 million pixels none is reduced, and beyond that rectangle_sum() is
///          still right for every rectangle of up to 16.8 million pixels
/// Overlap  none
/// Errors   empty_image, size_mismatch
/// Source   the toolkit's CalculateSummedAreaTable, with the zeros that its GetAreaSum had to imagine
inline Status integral_image(ImageView<const Gray8> src, ImageView<Sum32> dst);

}  // namespace FOVEA_ISA

/// The same over 1 for every pixel that is not 0: counts instead of sums.
///
/// Source  the toolkit's CalculateBinarizedSummedAreaTable
/// Others  as integral_image()
inline Status integral_of_binary(ImageView<const Gray8> src, ImageView<Sum32> dst);

/// The same over the squares of the pixels: with integral_image() the variance in any rectangle.
///
/// Others  as integral_image(), but sums of 64 bits are never reduced
inline Status integral_of_squares(ImageView<const Gray8> src, ImageView<Sum64> dst);

/// The image that an integral image was made from.
///
/// Shapes   integral one column and one row larger than dst
/// Units    what is above 255, as no image of bytes gives it, becomes 255
/// Overlap  none
/// Errors   empty_image, also for an integral without a pixel; size_mismatch
/// Source   the toolkit's CalculateReverseSummedAreaTable
inline Status image_of_integral(ImageView<const Sum32> integral, ImageView<Gray8> dst);

/// The sum over area, columns and rows of the image that the integral was made from.
///
/// Errors  empty_image for an integral or an area without a pixel, out_of_range if area is not wholly inside
/// Source  the toolkit's GetAreaSum
inline Result<std::uint32_t> rectangle_sum(ImageView<const Sum32> integral, Rectangle area);
inline Result<std::uint64_t> rectangle_sum(ImageView<const Sum64> integral, Rectangle area);

/// The same for an area that is known to be inside.
template <class Sum>
std::remove_const_t<Sum> rectangle_sum_unchecked(ImageView<Sum> integral, Rectangle area);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Integral rows one by one, of what value(pixel) says.
template <class Sum, class Value>
Status integral_by_rows(ImageView<const Gray8> src, Value value, ImageView<Sum> dst) {
    if (src.empty()) return Status::empty_image;
    if (dst.size() != integral_size(src.size())) return Status::size_mismatch;
    for (int x = 0; x < dst.width(); ++x) dst(x, 0) = 0;
    for (int y = 0; y < src.height(); ++y) {
        const Gray8* from = src.row(y);
        const Sum* above = dst.row(y);
        Sum* to = dst.row(y + 1);
        Sum sum = 0;
        to[0] = 0;
        for (int x = 0; x < src.width(); ++x) {
            sum = static_cast<Sum>(sum + static_cast<Sum>(value(from[x])));
            to[x + 1] = static_cast<Sum>(above[x + 1] + sum);
        }
    }
    return Status::ok;
}

template <class Sum>
Result<Sum> checked_rectangle_sum(ImageView<const Sum> integral, Rectangle area) {
    if (integral.width() < 2 || integral.height() < 2 || area.empty()) return Status::empty_image;
    if (area.x < 0 || area.y < 0 || area.width > integral.width() - 1 - area.x ||
        area.height > integral.height() - 1 - area.y)
        return Status::out_of_range;
    return rectangle_sum_unchecked(integral, area);
}

}  // namespace detail

inline namespace FOVEA_ISA {

inline Status integral_image(ImageView<const Gray8> src, ImageView<Sum32> dst) {
    if (src.empty()) return Status::empty_image;
    if (dst.size() != integral_size(src.size())) return Status::size_mismatch;
    for (int x = 0; x < dst.width(); ++x) dst(x, 0) = 0;
    for (int y = 1; y < dst.height(); ++y) dst(0, y) = 0;
    for (int y = 0; y < src.height(); ++y)
        simd::integral_row(src.row(y), src.width(), dst.row(y) + 1, dst.row(y + 1) + 1);
    return Status::ok;
}

}  // namespace FOVEA_ISA

inline Status integral_of_binary(ImageView<const Gray8> src, ImageView<Sum32> dst) {
    return detail::integral_by_rows(
        src, [](Gray8 pixel) { return pixel != 0 ? 1 : 0; }, dst);
}

inline Status integral_of_squares(ImageView<const Gray8> src, ImageView<Sum64> dst) {
    return detail::integral_by_rows(
        src, [](Gray8 pixel) { return pixel * pixel; }, dst);
}

inline Status image_of_integral(ImageView<const Sum32> integral, ImageView<Gray8> dst) {
    if (integral.width() < 2 || integral.height() < 2) return Status::empty_image;
    if (integral_size(dst.size()) != integral.size()) return Status::size_mismatch;
    for (int y = 0; y < dst.height(); ++y) {
        const Sum32* above = integral.row(y);
        const Sum32* below = integral.row(y + 1);
        Gray8* to = dst.row(y);
        for (int x = 0; x < dst.width(); ++x)
            to[x] =
                static_cast<Gray8>(minimum<Sum32>(below[x + 1] - below[x] - (above[x + 1] - above[x]), 255));
    }
    return Status::ok;
}

template <class Sum>
std::remove_const_t<Sum> rectangle_sum_unchecked(ImageView<Sum> integral, Rectangle area) {
    const Sum* above = integral.row(area.y);
    const Sum* below = integral.row(area.y + area.height);
    const int end = area.x + area.width;
    return static_cast<std::remove_const_t<Sum>>(below[end] - below[area.x] - (above[end] - above[area.x]));
}

inline Result<std::uint32_t> rectangle_sum(ImageView<const Sum32> integral, Rectangle area) {
    return detail::checked_rectangle_sum(integral, area);
}
inline Result<std::uint64_t> rectangle_sum(ImageView<const Sum64> integral, Rectangle area) {
    return detail::checked_rectangle_sum(integral, area);
}

}  // namespace fovea
