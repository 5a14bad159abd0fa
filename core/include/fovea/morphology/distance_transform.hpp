// SPDX-License-Identifier: MIT
//
// Distance transforms: how far every pixel is from the nearest ground.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// What a pixel holds if there is no ground in the image.
inline constexpr Sum32 no_ground_squared = 0xffffffff;
/// What a pixel of chamfer_distance() holds if the nearest ground is that far or farther, or there is none.
inline constexpr Gray16 farthest_chamfer = 0xffff;

/// Scratch bytes that squared_distance() needs: two numbers a column, and two more.
constexpr std::int64_t squared_distance_scratch(Size size) {
    return arena_bytes<int>(size.width) + arena_bytes<int>(2 * std::int64_t{size.width} + 2);
}

/// Scratch bytes that chamfer_distance() needs: none but for a row of steps.
constexpr std::int64_t chamfer_distance_scratch(Size size) { return arena_bytes<int>(size.width); }

/// The square of the distance from every pixel to the nearest zero pixel, exactly.
///
/// Shapes    src and dst equal, 1x1 up to max_image_side squared
/// Units     square pixels, centre to centre; zero pixels hold 0, their neighbours 1 or 2
/// Rounding  none: the largest value is 2 * 32766^2, below 2^31; no_ground_squared if nothing is zero
/// Border    beyond the image there is no ground
/// Overlap   none
/// Scratch   squared_distance_scratch(src.size()) bytes, undefined afterwards
/// Errors    empty_image, size_mismatch, image_too_large, scratch_too_small
/// Source    Meijster, Roerdink and Hesselink, "A general algorithm for computing distance transforms in
///           linear time", 2000; lower envelopes as Felzenszwalb and Huttenlocher, 2012
inline Status squared_distance(ImageView<const Gray8> src, Span<std::uint8_t> scratch, ImageView<Sum32> dst);

/// The length of the shortest way to a zero pixel in steps of 3 to a neighbour and 4 across a corner: about
/// three times the distance, at most 8 % off.
///
/// Units     thirds of a pixel, roughly; held at farthest_chamfer, which is reached 21845 px away
/// Scratch   chamfer_distance_scratch(src.size()) bytes, undefined afterwards
/// Others    as squared_distance()
/// Source    Borgefors, "Distance transformations in digital images", 1986
inline Status chamfer_distance(ImageView<const Gray8> src, Span<std::uint8_t> scratch, ImageView<Gray16> dst);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// A column without ground: farther than any.
inline constexpr int no_ground_in_column = 1 << 20;

/// The lower envelope of the parabolas (x - i)^2 + down[i]^2 of one row.
class DistanceRow {
public:
    /// room for 2 * width + 2 numbers.
    DistanceRow(Span<int> room, int width) : tops_(room.data()), starts_(room.data() + width + 1) {}

    /// The values of columns first..last, where only these and what is around them counts.
    void operator()(const int* down, int first, int last, int width, Sum32* dst) {
        count_ = 0;
        const int from = maximum(first - 1, 0);
        const int to = minimum(last + 1, width - 1);
        for (int i = from; i <= to; ++i)
            if (down[i] < no_ground_in_column) add(down, i, to);
        if (count_ == 0) {
            for (int x = first; x <= last; ++x) dst[x] = no_ground_squared;
            return;
        }
        int x = to;
        for (int k = count_ - 1; k >= 0; --k) {
            const int top = tops_[k];
            const int square = down[top] * down[top];
            const int lowest = maximum(starts_[k], first);
            for (x = minimum(x, last); x >= lowest; --x)
                dst[x] = static_cast<Sum32>((x - top) * (x - top) + square);
        }
    }

private:
    static std::int64_t value(const int* down, int top, int x) {
        return std::int64_t{x - top} * (x - top) + std::int64_t{down[top]} * down[top];
    }
    void add(const int* down, int i, int last) {
        while (count_ > 0 &&
               value(down, tops_[count_ - 1], starts_[count_ - 1]) > value(down, i, starts_[count_ - 1]))
            --count_;
        int start = 0;
        if (count_ > 0) {
            // The first column where parabola i is strictly lower than the one before it. Squares are below
            // 2^30, their sums below 2^31 in magnitude.
            const int top = tops_[count_ - 1];
            const int numerator = i * i - top * top + down[i] * down[i] - down[top] * down[top];
            start = floor_divide(numerator, 2 * (i - top)) + 1;
            if (start > last) return;
        }
        tops_[count_] = i;
        starts_[count_] = start;
        ++count_;
    }

    int* tops_;
    int* starts_;
    int count_ = 0;
};

template <class Pixel>
Status check_distance(ImageView<const Gray8> src, std::int64_t needed, Span<std::uint8_t> scratch,
                      ImageView<Pixel> dst) {
    if (src.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    if (src.width() > max_image_side || src.height() > max_image_side) return Status::image_too_large;
    return scratch.size() < needed ? Status::scratch_too_small : Status::ok;
}

}  // namespace detail

inline Status squared_distance(ImageView<const Gray8> src, Span<std::uint8_t> scratch, ImageView<Sum32> dst) {
    if (Status s = detail::check_distance(src, squared_distance_scratch(src.size()), scratch, dst);
        s != Status::ok)
        return s;
    const int width = src.width();
    constexpr int none = detail::no_ground_in_column;
    Arena arena(scratch);
    int* down = arena.take<int>(width).data();
    detail::DistanceRow envelope(arena.take<int>(2 * std::ptrdiff_t{width} + 2), width);
    // Downwards: rows to the nearest zero pixel above, kept in dst.
    for (int y = 0; y < src.height(); ++y) {
        const Gray8* row = src.row(y);
        Sum32* out = dst.row(y);
        const Sum32* above = dst.row(maximum(y - 1, 0));
        if (y == 0)
            for (int x = 0; x < width; ++x) out[x] = row[x] == 0 ? 0 : static_cast<Sum32>(none);
        else
            for (int x = 0; x < width; ++x)
                out[x] = row[x] == 0 ? 0 : minimum<Sum32>(above[x] + 1, static_cast<Sum32>(none));
    }
    // Upwards: to the nearest one below or above, then along the row between zero pixels.
    for (int y = src.height() - 1; y >= 0; --y) {
        Sum32* out = dst.row(y);
        if (y == src.height() - 1)
            for (int x = 0; x < width; ++x) down[x] = static_cast<int>(out[x]);
        else
            for (int x = 0; x < width; ++x) down[x] = minimum(down[x] + 1, static_cast<int>(out[x]));
        for (int x = 0; x < width;) {
            if (down[x] == 0) {
                out[x++] = 0;
                continue;
            }
            int last = x;
            while (last + 1 < width && down[last + 1] != 0) ++last;
            envelope(down, x, last, width, out);
            x = last + 1;
        }
    }
    return Status::ok;
}

inline Status chamfer_distance(ImageView<const Gray8> src, Span<std::uint8_t> scratch,
                               ImageView<Gray16> dst) {
    if (Status s = detail::check_distance(src, chamfer_distance_scratch(src.size()), scratch, dst);
        s != Status::ok)
        return s;
    const int width = src.width();
    const int height = src.height();
    constexpr int most = farthest_chamfer;
    int* steps = Arena(scratch).take<int>(width).data();
    /// steps[x] = the best way over the three neighbours in a row that is done.
    const auto over = [&](const Gray16* done) {
        for (int x = 1; x + 1 < width; ++x)
            steps[x] = minimum(minimum(done[x - 1], done[x + 1]) + 4, done[x] + 3);
        const auto end = [&](int x, int beside) {
            steps[x] = minimum(beside >= 0 && beside < width ? done[beside] + 4 : most, done[x] + 3);
        };
        end(0, 1);
        if (width > 1) end(width - 1, width - 2);
    };
    for (int y = 0; y < height; ++y) {
        const Gray8* row = src.row(y);
        Gray16* out = dst.row(y);
        if (y > 0)
            over(dst.row(y - 1));
        else
            for (int x = 0; x < width; ++x) steps[x] = most;
        int way = most;
        for (int x = 0; x < width; ++x) {
            way = minimum(way + 3, minimum(steps[x], most));
            way = row[x] == 0 ? 0 : way;
            out[x] = static_cast<Gray16>(way);
        }
    }
    for (int y = height - 1; y >= 0; --y) {
        Gray16* out = dst.row(y);
        if (y + 1 < height)
            over(dst.row(y + 1));
        else
            for (int x = 0; x < width; ++x) steps[x] = most;
        int way = most;
        for (int x = width - 1; x >= 0; --x) {
            way = minimum(way + 3, minimum<int>(steps[x], out[x]));
            out[x] = static_cast<Gray16>(way);
        }
    }
    return Status::ok;
}

}  // namespace fovea
