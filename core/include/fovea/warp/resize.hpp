// SPDX-License-Identifier: MIT
//
// Resize: an image at another size, by the nearest pixel or by interpolation. To make one much smaller take
// resize_area() or pyramid_down(), which leave no pixel out. Book sec. 2.9.
#pragma once

#include <cstdint>
#include <cstring>

#include <fovea/base/arena.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/taps.hpp>
#include <fovea/warp/halve_row.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Scratch bytes of the three, for a source and an output of these sizes.
constexpr std::int64_t resize_nearest_scratch(Size src, Size dst);
constexpr std::int64_t resize_bilinear_scratch(Size src, Size dst);
constexpr std::int64_t resize_bicubic_scratch(Size src, Size dst);

inline namespace FOVEA_ISA {

/// Each pixel of dst is the pixel of src that lies under its centre when both images cover the same area.
///
/// Shapes   any sizes, 1x1 to 32767x32767; pixels of any type
/// Rounding none; a centre between two pixels takes the one on the right or below
/// Border   none is needed
/// Overlap  none
/// Scratch  resize_nearest_scratch(src.size(), dst.size()) bytes, undefined afterwards
/// Errors   empty_image, image_too_large, scratch_too_small
/// Source   the definition. Source rows an output row needs: 1
template <class Pixel>
Status resize_nearest(NonDeduced<ImageView<const Pixel>> src, Span<std::uint8_t> scratch,
                      ImageView<Pixel> dst);

/// Each pixel of dst is the brightness of src under its centre, between four pixels.
///
/// Shapes    any sizes, 1x1 to 32767x32767
/// Units     any 8-bit values
/// Rounding  places to 1/256 px, then the exact mean with 8-bit weights to the nearest, ties up. The largest
///           sum is 255 * 2^16 + 2^15
/// Border    the outermost pixels repeat
/// Overlap   none
/// Scratch   resize_bilinear_scratch(src.size(), dst.size()) bytes, undefined afterwards
/// Errors    empty_image, image_too_large, scratch_too_small
/// Source    book sec. 2.9.2. The centre of pixel x of w' comes from (x + 1/2) w / w' - 1/2, so that both
///           images cover the same area. Source rows an output row needs: 2
inline Status resize_bilinear(ImageView<const Gray8> src, Span<std::uint8_t> scratch, ImageView<Gray8> dst);

/// The same between sixteen pixels: the cubic of Catmull and Rom (a = -1/2), which is sharper and may
/// overshoot by an eighth of a step.
///
/// Rounding  places to 1/4096 px, weights to 2^-11; the sums over columns of pixels to 1/64 level, those over
///           rows to the nearest, ties up, and held at 0 and 255. All sums stay below 2^26
/// Scratch   resize_bicubic_scratch(src.size(), dst.size()) bytes, undefined afterwards
/// Source    Keys' cubic convolution with a = -1/2. Source rows an output row needs: 4
/// Others    as resize_bilinear()
inline Status resize_bicubic(ImageView<const Gray8> src, Span<std::uint8_t> scratch, ImageView<Gray8> dst);

}  // namespace FOVEA_ISA

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// The columns by which a line is longer than its row, for the taps beyond its ends.
inline constexpr int line_margin = 4;

/// (x + 1/2) w / w' - 1/2 in 2^-bits px, to the nearest, ties up.
constexpr std::int64_t resized_place(int x, int from, int to, int bits) {
    return round_divide(((2 * std::int64_t{x} + 1) * from - to) * (1 << (bits - 1)), std::int64_t{to});
}

/// Pixel under the centre of x.
constexpr int resized_pixel(int x, int from, int to) {
    return static_cast<int>((2 * std::int64_t{x} + 1) * from / (2 * std::int64_t{to}));
}

/// A place between two pixels: the first one, and the second one's share in 1/256.
struct Between {
    int first;
    int share;
};
constexpr Between between_pixels(int x, int from, int to) {
    const auto last = std::int64_t{from - 1} * 256;
    const std::int64_t place = clamp<std::int64_t>(resized_place(x, from, to, 8), 0, last);
    const auto first = static_cast<int>(minimum<std::int64_t>(place >> 8, maximum(from - 2, 0)));
    return {first, static_cast<int>(place - std::int64_t{first} * 256)};
}

/// A place among four pixels: the first one, which may be -2, and the weights in 2^-11.
struct Among {
    int first;
    std::int16_t weights[4];
};
constexpr Among among_pixels(int x, int from, int to) {
    const std::int64_t place = resized_place(x, from, to, 12);
    const std::int64_t t = place & 4095;
    const std::int64_t square = t * t;
    const std::int64_t cube = square * t;  // 2^-36
    // Half of -t^3 + 2 t^2 - t, of -3 t^3 + 4 t^2 + t, and of t^3 - t^2; the second weight is the rest of 1.
    const auto weight = [](std::int64_t sum) { return static_cast<std::int16_t>(round_shift(sum, 26)); };
    Among among{static_cast<int>(place >> 12) - 1, {}};
    among.weights[0] = weight(-cube + 2 * (square << 12) - (t << 24));
    among.weights[2] = weight(-3 * cube + 4 * (square << 12) + (t << 24));
    among.weights[3] = weight(cube - (square << 12));
    among.weights[1] =
        static_cast<std::int16_t>(2048 - among.weights[0] - among.weights[2] - among.weights[3]);
    return among;
}

template <class Pixel>
Status check_resize(ImageView<const Pixel> src, std::int64_t needed, Span<std::uint8_t> scratch,
                    ImageView<const Pixel> dst) {
    if (src.empty() || dst.empty()) return Status::empty_image;
    if (src.width() > max_image_side || src.height() > max_image_side || dst.width() > max_image_side ||
        dst.height() > max_image_side)
        return Status::image_too_large;
    if (scratch.size() < needed) return Status::scratch_too_small;
    return Status::ok;
}

}  // namespace detail

constexpr std::int64_t resize_nearest_scratch(Size /*src*/, Size dst) {
    return arena_bytes<std::int32_t>(dst.width);
}
constexpr std::int64_t resize_bilinear_scratch(Size src, Size dst) {
    return arena_bytes<std::int16_t>(std::int64_t{src.width} + 2 * detail::line_margin) +
           2 * arena_bytes<std::int32_t>(dst.width);
}
constexpr std::int64_t resize_bicubic_scratch(Size src, Size dst) {
    return resize_bilinear_scratch(src, dst) + arena_bytes<std::int32_t>(dst.width);
}

inline namespace FOVEA_ISA {
namespace kernels {

/// Calls visit(x, count) until a row is covered, by taps_length pixels each time; the last ones may be done
/// twice.
template <class Visit>
void for_each_taps(int width, Visit visit) {
    constexpr int length = simd::taps_length;
    if (width < length)
        visit(0, width);
    else
        for (int x = 0; x < width; x += length) visit(minimum(x, width - length), length);
}

/// Makes output rows of resize_bilinear() from two source rows each.
class BilinearRows {
public:
    BilinearRows(Size src, Size dst, Span<std::uint8_t> scratch) : src_(src), dst_(dst) {
        Arena arena(scratch);
        at_ = arena.take<std::int32_t>(dst.width);
        weights_ = arena.take<simd::Pair>(dst.width);
        line_ = arena.take<std::int16_t>(src.width + detail::line_margin);
        for (int x = 0; x < dst.width; ++x) {
            const detail::Between place = detail::between_pixels(x, src.width, dst.width);
            at_[x] = place.first;
            weights_[x] = {static_cast<std::int16_t>(256 - place.share),
                           static_cast<std::int16_t>(place.share)};
        }
    }

    /// The first of the two source rows that output row y needs.
    int first_row(int y) const { return detail::between_pixels(y, src_.height, dst_.height).first; }

    /// Output row y from its two source rows; where the source has one row, both are that one.
    void operator()(int y, const Gray8* upper, const Gray8* lower, Gray8* dst) {
        const int share = detail::between_pixels(y, src_.height, dst_.height).share;
        simd::blend_rows(upper, lower, share, src_.width, line_.data());
        for_each_taps(dst_.width, [&](int x, int count) {
            simd::blend_pairs(line_.data(), at_.data() + x, weights_.data() + x, count, dst + x);
        });
    }

private:
    Size src_;
    Size dst_;
    Span<std::int32_t> at_;
    Span<simd::Pair> weights_;
    Span<std::int16_t> line_;
};

/// Makes output rows of resize_bicubic() from four source rows each.
class BicubicRows {
public:
    BicubicRows(Size src, Size dst, Span<std::uint8_t> scratch) : src_(src), dst_(dst) {
        Arena arena(scratch);
        at_ = arena.take<std::int32_t>(dst.width);
        first_weights_ = arena.take<simd::Pair>(dst.width);
        last_weights_ = arena.take<simd::Pair>(dst.width);
        line_ = arena.take<std::int16_t>(src.width + 2 * detail::line_margin);
        for (int x = 0; x < dst.width; ++x) {
            const detail::Among place = detail::among_pixels(x, src.width, dst.width);
            // Pixels up to -2 and width + 1 are asked for.
            at_[x] = place.first + detail::line_margin;
            first_weights_[x] = {place.weights[0], place.weights[1]};
            last_weights_[x] = {place.weights[2], place.weights[3]};
        }
    }

    /// The first of the four source rows that output row y needs; beyond the image the outermost repeat.
    int first_row(int y) const { return detail::among_pixels(y, src_.height, dst_.height).first; }

    void operator()(int y, const Gray8* const (&rows)[4], Gray8* dst) {
        constexpr int margin = detail::line_margin;
        const detail::Among place = detail::among_pixels(y, src_.height, dst_.height);
        std::int16_t* line = line_.data() + margin;
        simd::weigh_rows(rows, place.weights, src_.width, line);
        for (int i = 1; i <= margin; ++i) {
            line[-i] = line[0];
            line[src_.width - 1 + i] = line[src_.width - 1];
        }
        for_each_taps(dst_.width, [&](int x, int count) {
            simd::weigh_fours(line_.data(), at_.data() + x, first_weights_.data() + x,
                              last_weights_.data() + x, count, dst + x);
        });
    }

private:
    Size src_;
    Size dst_;
    Span<std::int32_t> at_;
    Span<simd::Pair> first_weights_;
    Span<simd::Pair> last_weights_;
    Span<std::int16_t> line_;
};

}  // namespace kernels

template <class Pixel>
Status resize_nearest(NonDeduced<ImageView<const Pixel>> src, Span<std::uint8_t> scratch,
                      ImageView<Pixel> dst) {
    const std::int64_t needed = resize_nearest_scratch(src.size(), dst.size());
    if (Status s = detail::check_resize<Pixel>(src, needed, scratch, dst); s != Status::ok) return s;
    const Span<std::int32_t> at = Arena(scratch).take<std::int32_t>(dst.width());
    for (int x = 0; x < dst.width(); ++x) at[x] = detail::resized_pixel(x, src.width(), dst.width());
    for (int y = 0; y < dst.height(); ++y) {
        const Pixel* from = src.row(detail::resized_pixel(y, src.height(), dst.height()));
        const std::int32_t* columns = at.data();
        Pixel* to = dst.row(y);
        int x = 0;
        for (; x + 4 <= dst.width(); x += 4) {
            const Pixel a = from[columns[x]];
            const Pixel b = from[columns[x + 1]];
            const Pixel c = from[columns[x + 2]];
            const Pixel d = from[columns[x + 3]];
            to[x] = a;
            to[x + 1] = b;
            to[x + 2] = c;
            to[x + 3] = d;
        }
        for (; x < dst.width(); ++x) to[x] = from[columns[x]];
    }
    return Status::ok;
}

inline Status resize_bilinear(ImageView<const Gray8> src, Span<std::uint8_t> scratch, ImageView<Gray8> dst) {
    const std::int64_t needed = resize_bilinear_scratch(src.size(), dst.size());
    if (Status s = detail::check_resize<Gray8>(src, needed, scratch, dst); s != Status::ok) return s;
    if (src.size() == Size{2 * dst.width(), 2 * dst.height()}) {
        // Every centre lies in the middle of four pixels.
        for (int y = 0; y < dst.height(); ++y)
            kernels::halve_row(src.row(2 * y), src.row(2 * y + 1), dst.width(), dst.row(y));
        return Status::ok;
    }
    kernels::BilinearRows rows(src.size(), dst.size(), scratch);
    for (int y = 0; y < dst.height(); ++y) {
        const int upper = rows.first_row(y);
        rows(y, src.row(upper), src.row(minimum(upper + 1, src.height() - 1)), dst.row(y));
    }
    return Status::ok;
}

inline Status resize_bicubic(ImageView<const Gray8> src, Span<std::uint8_t> scratch, ImageView<Gray8> dst) {
    const std::int64_t needed = resize_bicubic_scratch(src.size(), dst.size());
    if (Status s = detail::check_resize<Gray8>(src, needed, scratch, dst); s != Status::ok) return s;
    kernels::BicubicRows rows(src.size(), dst.size(), scratch);
    const auto row = [&](int y) -> const Gray8* { return src.row(clamp(y, 0, src.height() - 1)); };
    for (int y = 0; y < dst.height(); ++y) {
        const int first = rows.first_row(y);
        rows(y, {row(first), row(first + 1), row(first + 2), row(first + 3)}, dst.row(y));
    }
    return Status::ok;
}

}  // namespace FOVEA_ISA
}  // namespace fovea
