// SPDX-License-Identifier: MIT
//
// Erosion, dilation, opening and closing with a rectangle, for gray and binary images. Book sec. 2.7.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/morphology/rectangle_kernels.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lines.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

inline namespace FOVEA_ISA {

/// Scratch bytes that erode() and dilate() need: two lines.
constexpr std::int64_t erode_scratch(Size size) { return 2 * byte_line_scratch(size.width); }
constexpr std::int64_t dilate_scratch(Size size) { return erode_scratch(size); }

/// Scratch bytes that opening() and closing() need: the rows of the step between that are in use at a time,
/// and two lines.
constexpr std::int64_t opening_scratch(Size size) {
    return std::int64_t{size.width} * kernels::between_rows(size.height) + erode_scratch(size);
}
constexpr std::int64_t closing_scratch(Size size) { return opening_scratch(size); }

/// The smallest value under a rectangle centred on every pixel.
///
/// Shapes   src and dst equal, 1x1 or larger; element odd by odd, 1x1 to 63x63
/// Units    any 8-bit values; a binary image stays binary
/// Border   the outermost pixels repeat, which for a rectangle means that only pixels of the image count
/// Overlap  none: dst must not share pixels with src
/// Scratch  erode_scratch(src.size()) bytes, undefined afterwards
/// Errors   empty_image, size_mismatch, bad_argument for an even, too small or too large element,
///          scratch_too_small
/// Source   book sec. 2.7.2. The outermost rows and columns are eroded like all others
inline Status erode(ImageView<const Gray8> src, Size element, Span<std::uint8_t> scratch,
                    ImageView<Gray8> dst);

/// The largest value under a rectangle centred on every pixel. All else as erode().
inline Status dilate(ImageView<const Gray8> src, Size element, Span<std::uint8_t> scratch,
                     ImageView<Gray8> dst);

/// Erosion, then dilation: removes what is bright and smaller than the element.
///
/// Overlap  dst may be src
/// Scratch  opening_scratch(src.size()) bytes, undefined afterwards
/// Others   as erode()
/// Source   book sec. 2.7.3
inline Status opening(ImageView<const Gray8> src, Size element, Span<std::uint8_t> scratch,
                      ImageView<Gray8> dst);

/// Dilation, then erosion: removes what is dark and smaller than the element. All else as opening().
inline Status closing(ImageView<const Gray8> src, Size element, Span<std::uint8_t> scratch,
                      ImageView<Gray8> dst);

// ---- Implementation ---------------------------------------------------------------

namespace kernels {

constexpr bool is_rectangle(Size element) {
    return element.width % 2 == 1 && element.height % 2 == 1 && !element.empty() &&
           element.width <= max_element_side && element.height <= max_element_side;
}

inline Status check_morphology(ImageView<const Gray8> src, Size element, std::int64_t scratch_needed,
                               Span<std::uint8_t> scratch, ImageView<const Gray8> dst) {
    if (src.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    if (!is_rectangle(element)) return Status::bad_argument;
    if (scratch.size() < scratch_needed) return Status::scratch_too_small;
    return Status::ok;
}

template <class Extreme>
void extreme_frame(ImageView<const Gray8> src, Size element, Span<std::uint8_t> scratch,
                   ImageView<Gray8> dst) {
    extreme_rows<Extreme>(src, element, 0, src.height() - 1, scratch, dst);
}

template <class First, class Second>
void two_frames(ImageView<const Gray8> src, Size element, Span<std::uint8_t> scratch, ImageView<Gray8> dst) {
    two_steps<First>(src, element, scratch, [&](ImageView<const Gray8> between, int first, int last, int y) {
        const ImageView<Gray8> strip(dst.row(y), {dst.width(), last - first + 1}, dst.stride_bytes());
        extreme_rows<Second>(between, element, first, last, scratch, strip);
    });
}

}  // namespace kernels

inline Status erode(ImageView<const Gray8> src, Size element, Span<std::uint8_t> scratch,
                    ImageView<Gray8> dst) {
    if (Status s = kernels::check_morphology(src, element, erode_scratch(src.size()), scratch, dst);
        s != Status::ok)
        return s;
    kernels::extreme_frame<kernels::Lowest>(src, element, scratch, dst);
    return Status::ok;
}

inline Status dilate(ImageView<const Gray8> src, Size element, Span<std::uint8_t> scratch,
                     ImageView<Gray8> dst) {
    if (Status s = kernels::check_morphology(src, element, dilate_scratch(src.size()), scratch, dst);
        s != Status::ok)
        return s;
    kernels::extreme_frame<kernels::Highest>(src, element, scratch, dst);
    return Status::ok;
}

inline Status opening(ImageView<const Gray8> src, Size element, Span<std::uint8_t> scratch,
                      ImageView<Gray8> dst) {
    if (Status s = kernels::check_morphology(src, element, opening_scratch(src.size()), scratch, dst);
        s != Status::ok)
        return s;
    kernels::two_frames<kernels::Lowest, kernels::Highest>(src, element, scratch, dst);
    return Status::ok;
}

inline Status closing(ImageView<const Gray8> src, Size element, Span<std::uint8_t> scratch,
                      ImageView<Gray8> dst) {
    if (Status s = kernels::check_morphology(src, element, closing_scratch(src.size()), scratch, dst);
        s != Status::ok)
        return s;
    kernels::two_frames<kernels::Highest, kernels::Lowest>(src, element, scratch, dst);
    return Status::ok;
}

}  // namespace FOVEA_ISA
}  // namespace fovea
