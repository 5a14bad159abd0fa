// SPDX-License-Identifier: MIT
//
// Thresholds that follow the brightness around each pixel, for uneven light. Book sec. 2.8.1.
#pragma once

#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/border.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/image/row_kernel.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/prefix.hpp>
#include <fovea/simd/window_means.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The largest side of the window of an adaptive threshold: its column sums are at most 255 * 255 and fit 16
/// bits.
inline constexpr int max_adaptive_side = 255;

/// Of the deviation in sauvola_threshold(), 1/256 each.
inline constexpr int max_sauvola_weight = 256;

/// Scratch bytes that adaptive_threshold() and its inverse need: a row of column sums and of their prefix
/// sums.
constexpr std::int64_t adaptive_threshold_scratch(Size size, int side) {
    return arena_bytes<std::uint16_t>(std::int64_t{size.width} + side) +
           arena_bytes<std::uint32_t>(std::int64_t{size.width} + side + 1);
}

/// Scratch bytes that sauvola_threshold() needs: column sums of the pixels and of their squares.
constexpr std::int64_t sauvola_threshold_scratch(Size size, int side) {
    return 2 * arena_bytes<std::uint32_t>(std::int64_t{size.width} + side);
}

inline namespace FOVEA_ISA {

/// 255 where a pixel is at least the mean of the window around it less offset, else 0. For bright things with
/// offset below 0, for a bright ground under dark things with offset above 0.
///
/// Shapes    src and dst equal, 1x1 or larger; side odd, 1 to max_adaptive_side
/// Units     offset in grey levels, -255 to 255
/// Rounding  none: the mean is compared as a fraction; the largest sum is 255^3 and fits 32 bits
/// Border    the outermost pixels repeat
/// Overlap   none
/// Scratch   adaptive_threshold_scratch(src.size(), side) bytes, undefined afterwards
/// Errors    empty_image, size_mismatch, bad_argument, scratch_too_small
/// Source    book sec. 2.8.1. OpenCV rounds the mean to a whole level and wants the pixel above it
inline Status adaptive_threshold(ImageView<const Gray8> src, int side, int offset, Span<std::uint8_t> scratch,
                                 ImageView<Gray8> dst);

/// 255 where adaptive_threshold() gives 0 and the other way round. All else as there.
inline Status adaptive_threshold_inverse(ImageView<const Gray8> src, int side, int offset,
                                         Span<std::uint8_t> scratch, ImageView<Gray8> dst);

}  // namespace FOVEA_ISA

/// 255 where a pixel is at least mean (1 + weight (deviation / 128 - 1)), else 0: the threshold falls below
/// the mean where the window is of one brightness, so that a ground without print stays white. For dark print
/// on a bright ground.
///
/// Shapes    as adaptive_threshold()
/// Units     weight in 1/256, 0 to max_sauvola_weight; 51 to 128 (0.2 to 0.5) are usual
/// Rounding  the deviation down to 1 / side^2 of a level; then none, in 64 bits: the largest product is below
///           2^57
/// Border    the outermost pixels repeat
/// Overlap   none
/// Scratch   sauvola_threshold_scratch(src.size(), side) bytes, undefined afterwards
/// Errors    empty_image, size_mismatch, bad_argument, scratch_too_small
/// Source    Sauvola, Pietikainen, "Adaptive document image binarization", Pattern Recognition 33, 2000, eq.
///           5
inline Status sauvola_threshold(ImageView<const Gray8> src, int side, int weight, Span<std::uint8_t> scratch,
                                ImageView<Gray8> dst);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

constexpr Status check_adaptive(ImageView<const Gray8> src, int side, bool parameter_fits,
                                ImageView<Gray8> dst) {
    if (src.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    const bool fits = side >= 1 && side <= max_adaptive_side && side % 2 == 1 && parameter_fits;
    return fits ? Status::ok : Status::bad_argument;
}

/// The rows that enter and leave a window of side rows, the outermost repeated: enter(row, times) for the
/// first window, then step(entering, leaving) and row_done(y) in turn.
template <class Enter, class Step, class RowDone>
void slide_down(ImageView<const Gray8> src, int side, Enter enter, Step step, RowDone row_done) {
    const int reach = side / 2;
    const int last = src.height() - 1;
    for (int y = -reach; y <= reach; ++y) enter(src.row(clamp(y, 0, last)));
    for (int y = 0; y <= last; ++y) {
        if (y > 0) step(src.row(minimum(y + reach, last)), src.row(maximum(y - 1 - reach, 0)));
        row_done(y);
    }
}

/// Repeats the outermost sums of a line; the row begins behind reach of them.
template <class Sum>
void replicate_sums(int width, int reach, Sum* line) {
    for (int i = 0; i < reach; ++i) {
        line[i] = line[reach];
        line[reach + width + i] = line[reach + width - 1];
    }
}

}  // namespace detail

inline namespace FOVEA_ISA {
namespace kernels {

inline Status adaptive_frame(ImageView<const Gray8> src, int side, int offset, Gray8 flip,
                             Span<std::uint8_t> scratch, ImageView<Gray8> dst) {
    if (const Status s = detail::check_adaptive(src, side, offset >= -255 && offset <= 255, dst);
        s != Status::ok)
        return s;
    if (scratch.size() < adaptive_threshold_scratch(src.size(), side)) return Status::scratch_too_small;
    const int width = src.width();
    const int reach = side / 2;
    Arena arena(scratch);
    std::uint16_t* line = arena.take<std::uint16_t>(std::ptrdiff_t{width} + side).data();
    std::uint32_t* prefix = arena.take<std::uint32_t>(std::ptrdiff_t{width} + side + 1).data();
    std::uint16_t* columns = line + reach;
    detail::slide_down(
        src, side,
        [&](const Gray8* row) {
            for (int x = 0; x < width; ++x) columns[x] = static_cast<std::uint16_t>(columns[x] + row[x]);
        },
        [&](const Gray8* entering, const Gray8* leaving) {
            simd::slide_columns(entering, leaving, width, columns);
        },
        [&](int y) {
            detail::replicate_sums(width, reach, line);
            prefix[0] = 0;
            simd::prefix_row(line, width + side - 1, prefix + 1);
            simd::compare_with_means(src.row(y), prefix, width, side, offset, flip, dst.row(y));
        });
    return Status::ok;
}

/// The row kernel of adaptive_threshold() and its inverse, for windows up to max_window_rows. Its column sums
/// are made anew for every row.
class AdaptiveRow {
public:
    using Input = Gray8;
    using Output = Gray8;

    static constexpr std::int64_t scratch(int width, int side) {
        return adaptive_threshold_scratch({width, 1}, side);
    }

    AdaptiveRow() = default;
    AdaptiveRow(int side, int offset, Gray8 flip, Span<std::uint8_t> bytes, int width)
        : side_(side), offset_(offset), flip_(flip) {
        Arena arena(bytes);
        line_ = arena.take<std::uint16_t>(std::ptrdiff_t{width} + side).data();
        prefix_ = arena.take<std::uint32_t>(std::ptrdiff_t{width} + side + 1).data();
    }

    int rows() const { return side_; }

    void operator()(const RowWindow<Gray8>& window, Gray8* dst) {
        const int width = window.width();
        const int reach = side_ / 2;
        std::uint16_t* columns = line_ + reach;
        for (int x = 0; x < width; ++x) columns[x] = window[0][x];
        for (int i = 1; i < side_; ++i) {
            const Gray8* row = window[i];
            for (int x = 0; x < width; ++x) columns[x] = static_cast<std::uint16_t>(columns[x] + row[x]);
        }
        detail::replicate_sums(width, reach, line_);
        prefix_[0] = 0;
        simd::prefix_row(line_, width + side_ - 1, prefix_ + 1);
        simd::compare_with_means(window[reach], prefix_, width, side_, offset_, flip_, dst);
    }

private:
    int side_ = 1;
    int offset_ = 0;
    Gray8 flip_ = 0;
    std::uint16_t* line_ = nullptr;
    std::uint32_t* prefix_ = nullptr;
};

}  // namespace kernels

inline Status adaptive_threshold(ImageView<const Gray8> src, int side, int offset, Span<std::uint8_t> scratch,
                                 ImageView<Gray8> dst) {
    return kernels::adaptive_frame(src, side, offset, 0, scratch, dst);
}

inline Status adaptive_threshold_inverse(ImageView<const Gray8> src, int side, int offset,
                                         Span<std::uint8_t> scratch, ImageView<Gray8> dst) {
    return kernels::adaptive_frame(src, side, offset, 255, scratch, dst);
}

namespace stages {

/// adaptive_threshold() and its inverse, with a side up to max_window_rows. The outermost pixels repeat
/// whatever the stream's border is.
template <int Flip>
struct AdaptiveStage {
    using Kernel = kernels::AdaptiveRow;
    using Input = Gray8;
    using Output = Gray8;
    int side;
    int offset;

    constexpr bool valid() const {
        return side >= 1 && side <= max_window_rows && side % 2 == 1 && offset >= -255 && offset <= 255;
    }
    constexpr int rows() const { return side; }
    constexpr std::int64_t scratch(int width) const { return Kernel::scratch(width, side); }
    static constexpr Border border(Border) { return Border::replicate; }
    Kernel kernel(Border, Span<std::uint8_t> bytes, int width) const {
        return Kernel(side, offset, Flip, bytes, width);
    }
};
using adaptive_threshold = AdaptiveStage<0>;
using adaptive_threshold_inverse = AdaptiveStage<255>;

}  // namespace stages

}  // namespace FOVEA_ISA

inline Status sauvola_threshold(ImageView<const Gray8> src, int side, int weight, Span<std::uint8_t> scratch,
                                ImageView<Gray8> dst) {
    if (const Status s = detail::check_adaptive(src, side, weight >= 0 && weight <= max_sauvola_weight, dst);
        s != Status::ok)
        return s;
    if (scratch.size() < sauvola_threshold_scratch(src.size(), side)) return Status::scratch_too_small;
    const int width = src.width();
    const int reach = side / 2;
    Arena arena(scratch);
    std::uint32_t* line = arena.take<std::uint32_t>(std::ptrdiff_t{width} + side).data();
    std::uint32_t* square_line = arena.take<std::uint32_t>(std::ptrdiff_t{width} + side).data();
    std::uint32_t* columns = line + reach;
    std::uint32_t* squares = square_line + reach;
    const std::int64_t area = std::int64_t{side} * side;
    const auto row_of_thresholds = [&](int y) {
        detail::replicate_sums(width, reach, line);
        detail::replicate_sums(width, reach, square_line);
        // Windows of sums up to 255^3 and of squares up to 255^4, which still fit 32 bits.
        std::uint32_t sum = 0;
        std::uint32_t square_sum = 0;
        for (int i = 0; i < side - 1; ++i) {
            sum += line[i];
            square_sum += square_line[i];
        }
        const Gray8* from = src.row(y);
        Gray8* to = dst.row(y);
        for (int x = 0; x < width; ++x) {
            sum += line[x + side - 1];
            square_sum += square_line[x + side - 1];
            // side^4 times the variance: not negative by the inequality of the means. Its root D rounded down
            // is side^2 times the deviation.
            const auto spread = static_cast<std::uint64_t>(area * std::int64_t{square_sum} -
                                                           std::int64_t{sum} * std::int64_t{sum});
            // pixel >= (S / A) (1 + w / 256 (D / (128 A) - 1)), times 256 * 128 A^2: room for w S D. The root
            // is not taken but its bound squared; D itself is below 2^24.
            const std::int64_t room =
                from[x] * (area * area << 15) - (area * (256 - weight) * std::int64_t{sum} << 7);
            const std::int64_t factor = std::int64_t{sum} * weight;
            const std::int64_t bound = factor == 0 ? 1 << 24 : minimum<std::int64_t>(room / factor, 1 << 24);
            const bool bright = room >= 0 && spread < static_cast<std::uint64_t>((bound + 1) * (bound + 1));
            to[x] = bright ? 255 : 0;
            sum -= line[x];
            square_sum -= square_line[x];
        }
    };
    detail::slide_down(
        src, side,
        [&](const Gray8* row) {
            for (int x = 0; x < width; ++x) {
                const std::uint32_t value = row[x];
                columns[x] += value;
                squares[x] += value * value;
            }
        },
        [&](const Gray8* entering, const Gray8* leaving) {
            for (int x = 0; x < width; ++x) {
                const std::uint32_t more = entering[x];
                const std::uint32_t less = leaving[x];
                columns[x] += more - less;
                squares[x] += more * more - less * less;
            }
        },
        row_of_thresholds);
    return Status::ok;
}

}  // namespace fovea
