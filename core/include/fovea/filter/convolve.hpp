// SPDX-License-Identifier: MIT
//
// Convolution with weights of the caller's. Book sec. 2.6.1.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/filter/weighted_sums.hpp>
#include <fovea/image/border.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/row_kernel.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>
#include <fovea/simd/lines.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The largest sides of a kernel of convolve(), and the largest divisor and offset.
inline constexpr int max_convolution_side = 15;
inline constexpr int max_convolution_divisor = 65535;
inline constexpr int max_convolution_offset = 255;

/// What convolve() makes of a window.
struct ConvolutionKernel {
    Span<const std::int16_t> weights;  ///< row by row from the top, as many as the size has pixels
    Size size{3, 3};                   ///< odd by odd, 1x1 to 15x15
    int divisor = 1;                   ///< 1..65535, by which the sum of the products is divided
    int offset = 0;                    ///< -255..255, added to the quotient
};

inline namespace FOVEA_ISA {

/// Scratch bytes that convolve() needs; 0 if it refuses a kernel of that size.
constexpr std::int64_t convolve_scratch(Size size, Size kernel);

/// The sum of every pixel's neighbours, each times the weight that stands where the neighbour does, divided
/// and moved by the offset. The kernel is not turned round (this is the correlation): weights[0] goes with
/// the pixel above on the left.
///
/// Shapes    src and dst equal, 1x1 or larger, smaller than the kernel too
/// Units     grey levels in; out what the weights make of them
/// Rounding  the sum is exact (at most 225 * 32768 * 255); the quotient goes to the nearest, ties up, once.
///           What then is outside the values of a pixel becomes the nearest of them
/// Border    as border says
/// Overlap   none: dst must not share pixels with src
/// Scratch   convolve_scratch(src.size(), kernel.size) bytes, undefined afterwards: a line for each row of
///           the kernel
/// Cost      grows with the pixels of the kernel. In vectors of 16 bits where no sum can leave them, with
///           32 bits elsewhere; in Gray8, 255 times the positive and the negative weights together must stay
///           below about 65000
/// Errors    empty_image, size_mismatch; bad_argument for a kernel that is even, too small or too large, has
///           not as many weights as pixels, or a divisor or an offset out of their range; scratch_too_small
/// Source    book sec. 2.6.1; the toolkit's GeneralFilter wrapped bytes modulo 256, cut quotients, and left a
///           frame of zeros
inline Status convolve(ImageView<const Gray8> src, const ConvolutionKernel& kernel, Border border,
                       Span<std::uint8_t> scratch, ImageView<Gray8> dst);
inline Status convolve(ImageView<const Gray8> src, const ConvolutionKernel& kernel, Border border,
                       Span<std::uint8_t> scratch, ImageView<Gradient16> dst);

// ---- Implementation ---------------------------------------------------------------

namespace kernels {

constexpr bool is_convolution_size(Size size) {
    return size.width % 2 == 1 && size.height % 2 == 1 && !size.empty() &&
           size.width <= max_convolution_side && size.height <= max_convolution_side;
}
constexpr bool is_convolution(const ConvolutionKernel& kernel) {
    return is_convolution_size(kernel.size) && kernel.weights.size() == kernel.size.area() &&
           kernel.divisor >= 1 && kernel.divisor <= max_convolution_divisor &&
           kernel.offset >= -max_convolution_offset && kernel.offset <= max_convolution_offset;
}

/// The row kernel of convolve(). The weights outlive it.
template <class Pixel>
class ConvolveRow {
public:
    using Input = Gray8;
    using Output = Pixel;

    static constexpr std::int64_t scratch(int width, int rows) {
        return rows * std::int64_t{word_line_scratch(width)};
    }

    ConvolveRow() = default;
    ConvolveRow(const ConvolutionKernel& kernel, Border border, Span<std::uint8_t> scratch, int width)
        : sums_(kernel.weights, kernel.divisor, kernel.offset),
          size_(kernel.size),
          border_(border),
          first_(scratch.data()),
          bytes_(word_line_scratch(width)) {
        // As in FilterRow: no column beyond the end may carry into one that counts.
        std::memset(scratch.data(), 0, static_cast<std::size_t>(ConvolveRow::scratch(width, rows())));
    }

    int rows() const { return size_.height; }

    void operator()(const RowWindow<Gray8>& window, bool follows, Pixel* dst) {
        if (sums_.narrow())
            narrow_row(window, dst);
        else
            wide_row(window, follows, dst);
    }

private:
    void narrow_row(const RowWindow<Gray8>& window, Pixel* dst) {
        const int width = window.width();
        const auto line = [first = first_, bytes = bytes_, width](int i) {
            return simd::WordLine({first + i * bytes, bytes}, width);
        };
        for (int i = 0; i < rows(); ++i) {
            simd::WordLine to = line(i);
            simd::for_each_vector(
                width, [&](int x, int count) { to.put(x, simd::Words(load(window[i] + x, count))); });
            continue_ends(window[i], width, [&](int x, std::uint16_t pixel) { to.set(x, pixel); });
        }
        sums_.narrow_row(line, size_, width, dst);
    }
    /// All rows of a window that follows stand in lines but the last one, which takes that of the row above
    /// the window.
    void wide_row(const RowWindow<Gray8>& window, bool follows, Pixel* dst) {
        const int width = window.width();
        top_ = follows && top_ + 1 < rows() ? top_ + 1 : 0;
        const auto line = [first = first_ + simd::column_bytes * max_reach, bytes = bytes_, top = top_,
                           rows = rows()](int i) {
            return first + (top + i < rows ? top + i : top + i - rows) * bytes;
        };
        for (int i = follows ? rows() - 1 : 0; i < rows(); ++i) {
            std::uint8_t* to = line(i);
            simd::for_each_vector(width, [&](int x, int count) {
                std::uint16_t pixels[simd::lanes];
                simd::Words(load(window[i] + x, count)).store(pixels);
                std::memcpy(to + simd::column_bytes * x, pixels, sizeof pixels);
            });
            continue_ends(window[i], width, [&](int x, std::uint16_t pixel) {
                std::memcpy(to + simd::column_bytes * x, &pixel, sizeof pixel);
            });
        }
        sums_.wide_row(line, size_, width, dst);
    }
    [[gnu::always_inline]] static simd::Bytes load(const Gray8* from, int count) {
        return count == simd::lanes ? simd::Bytes::load(from) : simd::Bytes::load(from, count);
    }
    template <class Set>
    void continue_ends(const Gray8* row, int width, Set set) const {
        for (int i = 1; i <= size_.width / 2; ++i) {
            const int left = border_index(border_, -i, width);
            const int right = border_index(border_, width - 1 + i, width);
            set(-i, left == no_index ? std::uint16_t{0} : row[left]);
            set(width - 1 + i, right == no_index ? std::uint16_t{0} : row[right]);
        }
    }

    WeightedSums<Pixel> sums_;
    Size size_{1, 1};
    Border border_ = Border::replicate;
    std::uint8_t* first_ = nullptr;
    std::ptrdiff_t bytes_ = 0;
    int top_ = 0;  ///< which line has the topmost row, if sums are wide
};

template <class Pixel>
Status convolve_frame(ImageView<const Gray8> src, const ConvolutionKernel& kernel, Border border,
                      Span<std::uint8_t> scratch, ImageView<Pixel> dst) {
    if (src.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    if (!is_convolution(kernel)) return Status::bad_argument;
    if (scratch.size() < convolve_scratch(src.size(), kernel.size)) return Status::scratch_too_small;
    std::memset(scratch.data(), 0, static_cast<std::size_t>(src.width()));
    ConvolveRow<Pixel> row(kernel, border, scratch.from(src.width()), src.width());
    for_each_row(src, border, row, dst, scratch.data());
    return Status::ok;
}

}  // namespace kernels

constexpr std::int64_t convolve_scratch(Size size, Size kernel) {
    if (!kernels::is_convolution_size(kernel)) return 0;
    return size.width + kernels::ConvolveRow<Gray8>::scratch(size.width, kernel.height);
}

inline Status convolve(ImageView<const Gray8> src, const ConvolutionKernel& kernel, Border border,
                       Span<std::uint8_t> scratch, ImageView<Gray8> dst) {
    return kernels::convolve_frame(src, kernel, border, scratch, dst);
}
inline Status convolve(ImageView<const Gray8> src, const ConvolutionKernel& kernel, Border border,
                       Span<std::uint8_t> scratch, ImageView<Gradient16> dst) {
    return kernels::convolve_frame(src, kernel, border, scratch, dst);
}

namespace stages {

/// convolve() to a pixel; the weights of the kernel outlive the stream.
template <class Pixel>
struct convolve {
    using Kernel = kernels::ConvolveRow<Pixel>;
    using Input = Gray8;
    using Output = Pixel;
    ConvolutionKernel weights;

    constexpr bool valid() const { return kernels::is_convolution(weights); }
    constexpr int rows() const { return weights.size.height; }
    constexpr std::int64_t scratch(int width) const { return Kernel::scratch(width, rows()); }
    Kernel kernel(Border border, Span<std::uint8_t> bytes, int width) const {
        return Kernel(weights, border, bytes, width);
    }
};

}  // namespace stages

}  // namespace FOVEA_ISA
}  // namespace fovea
