// SPDX-License-Identifier: MIT
//
// Erosion, dilation, opening and closing with a rectangle, for gray and binary images. Book sec. 2.7.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/border.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/row_kernel.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>
#include <fovea/simd/lines.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The largest side of a structuring rectangle.
inline constexpr int max_element_side = max_window_rows;

inline namespace FOVEA_ISA {

/// Scratch bytes that erode() and dilate() need: one line.
constexpr std::int64_t erode_scratch(Size size) { return byte_line_scratch(size.width); }
constexpr std::int64_t dilate_scratch(Size size) { return byte_line_scratch(size.width); }

/// Scratch bytes that opening() and closing() need: one frame for the step between, and one line.
constexpr std::int64_t opening_scratch(Size size) { return size.area() + byte_line_scratch(size.width); }
constexpr std::int64_t closing_scratch(Size size) { return size.area() + byte_line_scratch(size.width); }

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

struct Lowest {
    [[gnu::always_inline]] static simd::Bytes of(simd::Bytes a, simd::Bytes b) { return lower(a, b); }
};
struct Highest {
    [[gnu::always_inline]] static simd::Bytes of(simd::Bytes a, simd::Bytes b) { return higher(a, b); }
};

/// The row kernel of erosion and dilation: down() over the rows of the window, across() within the line.
template <class Extreme>
class ExtremeRow {
public:
    using Input = Gray8;
    using Output = Gray8;

    ExtremeRow() = default;
    ExtremeRow(Size element, Span<std::uint8_t> scratch, int width)
        : element_(element), line_(scratch, width) {}

    int rows() const { return element_.height; }

    void operator()(const RowWindow<Gray8>& window, Gray8* dst) {
        const int width = window.width();
        if (window.count() == 3)
            down_three(window[0], window[1], window[2], width);
        else
            down(window, width);
        line_.replicate(width, element_.width / 2);
        if (element_.width == 3)
            simd::for_each_vector(width, [&](int x, int count) {
                Extreme::of(Extreme::of(line_.at(x - 1), line_.at(x)), line_.at(x + 1)).store(dst + x, count);
            });
        else
            across(width, dst);
    }

private:
    /// Four vectors abreast as far as they go, so that a row's address is fetched once for all of them.
    void down(const RowWindow<Gray8>& window, int width) {
        constexpr int lanes = simd::lanes;
        int x = 0;
        for (; x + 4 * lanes <= width; x += 4 * lanes) {
            simd::Bytes a = simd::Bytes::load(window[0] + x);
            simd::Bytes b = simd::Bytes::load(window[0] + x + lanes);
            simd::Bytes c = simd::Bytes::load(window[0] + x + 2 * lanes);
            simd::Bytes d = simd::Bytes::load(window[0] + x + 3 * lanes);
            for (int i = 1; i < window.count(); ++i) {
                const Gray8* row = window[i] + x;
                a = Extreme::of(a, simd::Bytes::load(row));
                b = Extreme::of(b, simd::Bytes::load(row + lanes));
                c = Extreme::of(c, simd::Bytes::load(row + 2 * lanes));
                d = Extreme::of(d, simd::Bytes::load(row + 3 * lanes));
            }
            line_.put(x, a);
            line_.put(x + lanes, b);
            line_.put(x + 2 * lanes, c);
            line_.put(x + 3 * lanes, d);
        }
        for (; x < width; x += lanes) {
            const int count = minimum(lanes, width - x);
            simd::Bytes extreme = simd::Bytes::load(window[0] + x, count);
            for (int i = 1; i < window.count(); ++i)
                extreme = Extreme::of(extreme, simd::Bytes::load(window[i] + x, count));
            line_.put(x, extreme);
        }
    }
    void down_three(const Gray8* above, const Gray8* here, const Gray8* below, int width) {
        int x = 0;
        for (; x + simd::lanes <= width; x += simd::lanes)
            line_.put(x, Extreme::of(Extreme::of(simd::Bytes::load(above + x), simd::Bytes::load(here + x)),
                                     simd::Bytes::load(below + x)));
        if (x < width)
            line_.put(x, Extreme::of(Extreme::of(simd::Bytes::load(above + x, width - x),
                                                 simd::Bytes::load(here + x, width - x)),
                                     simd::Bytes::load(below + x, width - x)));
    }
    /// The extremes of 2, 4, 8 ... columns from each column on, in place, until two of them cover the
    /// element.
    void across(int width, Gray8* dst) {
        const int reach = element_.width / 2;
        int covered = 1;
        for (; 2 * covered <= element_.width; covered *= 2)
            for (int x = -reach; x <= width + reach - 2 * covered; x += simd::lanes)
                line_.put(x, Extreme::of(line_.at(x), line_.at(x + covered)));
        simd::for_each_vector(width, [&](int x, int count) {
            Extreme::of(line_.at(x - reach), line_.at(x + reach + 1 - covered)).store(dst + x, count);
        });
    }

    Size element_{1, 1};
    simd::ByteLine line_;
};

inline Status check_morphology(ImageView<const Gray8> src, Size element, std::int64_t scratch_needed,
                               Span<std::uint8_t> scratch, ImageView<const Gray8> dst) {
    if (src.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    const bool odd = element.width % 2 == 1 && element.height % 2 == 1;
    if (!odd || element.empty() || element.width > max_element_side || element.height > max_element_side)
        return Status::bad_argument;
    if (scratch.size() < scratch_needed) return Status::scratch_too_small;
    return Status::ok;
}

template <class Extreme>
void extreme_frame(ImageView<const Gray8> src, Size element, Span<std::uint8_t> scratch,
                   ImageView<Gray8> dst) {
    ExtremeRow<Extreme> kernel(element, scratch, src.width());
    for_each_row(src, Border::replicate, kernel, dst);
}

template <class First, class Second>
void two_frames(ImageView<const Gray8> src, Size element, Span<std::uint8_t> scratch, ImageView<Gray8> dst) {
    const auto pixels = static_cast<std::ptrdiff_t>(src.size().area());
    const ImageView<Gray8> between(scratch.data(), src.size(), src.width());
    extreme_frame<First>(src, element, scratch.from(pixels), between);
    extreme_frame<Second>(between, element, scratch.from(pixels), dst);
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
