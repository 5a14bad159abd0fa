// SPDX-License-Identifier: MIT
//
// Region growing from a seed and flood filling, with a stack of runs that may be small. Book sec. 2.8.3.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>

#include <fovea/base/arena.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/segment/region.hpp>
#include <fovea/segment/runs.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// A run that waits for its neighbours to be looked at.
struct WaitingRun {
    std::int16_t first = 0;
    std::int16_t last = 0;
    std::int16_t y = 0;
};

/// Scratch bytes for a stack of so many runs. One is enough for any image: what finds no room is found again
/// by looking over what has grown so far, which costs time. 64 serve calm images without that.
constexpr std::int64_t grow_region_scratch(int runs) { return arena_bytes<WaitingRun>(runs); }
constexpr std::int64_t grow_region_scratch() { return grow_region_scratch(1024); }

/// Grows a region from a seed over all pixels of a range of grey levels that hold together.
///
/// Shapes   src and mask equal, 1x1 up to max_moment_side squared; seed inside
/// Units    mask holds 255 where the region is and 0 elsewhere; pixels low to high belong
/// Order    the answer does not depend on the size of the stack. first is the first pixel, row by row;
///          holes and hole_area are not counted
/// Overlap  none
/// Scratch  grow_region_scratch(runs) bytes, any number of runs from 1 on
/// Errors   empty_image, size_mismatch, image_too_large; bad_argument if low is above high; out_of_range if
///          the seed is outside the image; scratch_too_small; not_found if the seed does not belong, with an
///          empty mask
/// Source   book sec. 2.8.3; scan-line filling after Smith, "Tint fill", 1979
inline Result<RegionOf<FirstMoments>> grow_region(ImageView<const Gray8> src, Point seed, Gray8 low,
                                                  Gray8 high, Connectivity connectivity,
                                                  Span<std::uint8_t> scratch, ImageView<Gray8> mask);

/// Scratch bytes that flood_fill() needs: one a pixel, and a stack of so many runs.
constexpr std::int64_t flood_fill_scratch(Size size, int runs = 1024) {
    return size.area() + grow_region_scratch(runs);
}

/// Gives all pixels that hold together with the seed and are like it another value, in place.
///
/// Scratch  flood_fill_scratch(image.size(), runs) bytes, any number of runs from 1 on
/// Errors   empty_image, image_too_large, out_of_range, scratch_too_small
/// Others   as grow_region()
inline Result<RegionOf<FirstMoments>> flood_fill(ImageView<Gray8> image, Point seed, Gray8 value,
                                                 Connectivity connectivity, Span<std::uint8_t> scratch);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// The top bit of every byte of a that is at least that of b.
inline PixelWord bytes_at_least(PixelWord a, PixelWord b) {
    // Of seven bits no difference borrows; the eighth ones decide where they differ.
    const PixelWord lower = (a | ~low_bits) - (b & low_bits);
    return ((a & ~b) | (~(a ^ b) & lower)) & ~low_bits;
}
inline PixelWord all_pixels(Gray8 level) { return (~PixelWord{0} / 255) * level; }

/// value where a mask of 0 and 255 is 255, from pixel first up to end.
inline void fill_where(const Gray8* mask, Gray8 value, int first, int end, Gray8* row) {
    int x = first;
    for (; x + word_pixels <= end; x += word_pixels) {
        const PixelWord filled = load_pixels(mask + x);
        const PixelWord pixels = (load_pixels(row + x) & ~filled) | (all_pixels(value) & filled);
        std::memcpy(row + x, &pixels, sizeof pixels);
    }
    for (; x < end; ++x)
        if (mask[x] != 0) row[x] = value;
}

/// A row of the image and of the mask of what is filled, and the levels that belong.
struct GrowingRow {
    const Gray8* src;
    Gray8* mask;
    Gray8 low;
    Gray8 high;

    bool filled(int x) const { return mask[x] != 0; }
    bool belongs(int x) const { return src[x] >= low && src[x] <= high && mask[x] == 0; }
    /// True if all of word_pixels pixels from x on belong.
    bool word_belongs(int x) const {
        const PixelWord levels = load_pixels(src + x);
        const PixelWord inside =
            bytes_at_least(levels, all_pixels(low)) & bytes_at_least(all_pixels(high), levels);
        return inside == ~low_bits && load_pixels(mask + x) == 0;
    }
};

/// Fills run after run; row_at(y) is a GrowingRow.
template <class RowAt>
class RunFiller {
public:
    RunFiller(Size size, Connectivity connectivity, Span<WaitingRun> stack, RowAt row_at)
        : size_(size), reach_(connectivity == Connectivity::eight ? 1 : 0), stack_(stack), row_at_(row_at) {}

    RegionOf<FirstMoments> grow(Point seed) {
        left_ = right_ = seed.x;
        top_ = bottom_ = seed.y;
        fill_run(row_at_(seed.y), seed.x, seed.y);
        empty_stack();
        // Runs that found no room on the stack have neighbours that are not filled: the box is looked over
        // until there are none. Every look fills at least one run, or is the last.
        while (lost_) {
            lost_ = false;
            for (int y = top_; y <= bottom_; ++y) {
                const GrowingRow row = row_at_(y);
                for (int x = left_; x <= right_; ++x) {
                    if (!row.filled(x)) continue;
                    const int first = x;
                    while (x < right_ && row.filled(x + 1)) ++x;
                    look_beside(first, x, y);
                    empty_stack();
                }
            }
        }
        RegionOf<FirstMoments> region;
        region.moments = moments_;
        region.box = {left_, top_, right_ - left_ + 1, bottom_ - top_ + 1};
        region.first = first_;
        region.at_border =
            left_ == 0 || top_ == 0 || right_ == size_.width - 1 || bottom_ == size_.height - 1;
        return region;
    }

private:
    /// Fills the run around x and answers its last pixel.
    int fill_run(GrowingRow row, int x, int y) {
        int first = x;
        int last = x;
        while (first >= word_pixels && row.word_belongs(first - word_pixels)) first -= word_pixels;
        while (first > 0 && row.belongs(first - 1)) --first;
        while (last + word_pixels < size_.width && row.word_belongs(last + 1)) last += word_pixels;
        while (last + 1 < size_.width && row.belongs(last + 1)) ++last;
        std::memset(row.mask + first, 255, static_cast<std::size_t>(last - first) + 1);
        moments_.add_run(first, last + 1, y);
        if (moments_.area() == last - first + 1 || y < first_.y || (y == first_.y && first < first_.x))
            first_ = {first, y};
        left_ = minimum(left_, first);
        right_ = maximum(right_, last);
        top_ = minimum(top_, y);
        bottom_ = maximum(bottom_, y);
        if (count_ < stack_.size())
            stack_[count_++] = {static_cast<std::int16_t>(first), static_cast<std::int16_t>(last),
                                static_cast<std::int16_t>(y)};
        else
            lost_ = true;
        return last;
    }
    void look_beside(int first, int last, int y) {
        const int from = maximum(first - reach_, 0);
        const int to = minimum(last + reach_, size_.width - 1);
        for (const int beside : {y - 1, y + 1}) {
            if (beside < 0 || beside >= size_.height) continue;
            const GrowingRow row = row_at_(beside);
            for (int x = from; x <= to; ++x) {
                // What is filled already, as the row that this one was found from, goes by in words.
                while (x + word_pixels <= to && pixels_alike(row.mask + x, true) == word_pixels)
                    x += word_pixels;
                if (row.belongs(x)) x = fill_run(row, x, beside);
            }
        }
    }
    void empty_stack() {
        while (count_ > 0) {
            const WaitingRun run = stack_[--count_];
            look_beside(run.first, run.last, run.y);
        }
    }

    Size size_;
    int reach_;
    Span<WaitingRun> stack_;
    RowAt row_at_;
    std::ptrdiff_t count_ = 0;
    bool lost_ = false;
    FirstMoments moments_;
    Point first_;
    int left_ = 0, top_ = 0, right_ = 0, bottom_ = 0;
};

/// All of the scratch as a stack; empty if there is no room for one run.
inline Span<WaitingRun> stack_in(Span<std::uint8_t> scratch) {
    if (scratch.size() < grow_region_scratch(1)) return {};
    const auto room = (scratch.size() - static_cast<std::ptrdiff_t>(alignof(WaitingRun)) + 1) /
                      static_cast<std::ptrdiff_t>(sizeof(WaitingRun));
    return Arena(scratch).take<WaitingRun>(room);
}

}  // namespace detail

inline Result<RegionOf<FirstMoments>> grow_region(ImageView<const Gray8> src, Point seed, Gray8 low,
                                                  Gray8 high, Connectivity connectivity,
                                                  Span<std::uint8_t> scratch, ImageView<Gray8> mask) {
    if (src.empty()) return Status::empty_image;
    if (mask.size() != src.size()) return Status::size_mismatch;
    if (src.width() > max_moment_side || src.height() > max_moment_side) return Status::image_too_large;
    if (low > high) return Status::bad_argument;
    if (!src.contains(seed)) return Status::out_of_range;
    const Span<WaitingRun> stack = detail::stack_in(scratch);
    if (stack.empty()) return Status::scratch_too_small;
    for (int y = 0; y < mask.height(); ++y)
        std::memset(mask.row(y), 0, static_cast<std::size_t>(mask.width()));
    const auto row_at = [&](int y) { return detail::GrowingRow{src.row(y), mask.row(y), low, high}; };
    if (!row_at(seed.y).belongs(seed.x)) return Status::not_found;
    return detail::RunFiller(src.size(), connectivity, stack, row_at).grow(seed);
}

inline Result<RegionOf<FirstMoments>> flood_fill(ImageView<Gray8> image, Point seed, Gray8 value,
                                                 Connectivity connectivity, Span<std::uint8_t> scratch) {
    if (image.empty()) return Status::empty_image;
    if (image.width() > max_moment_side || image.height() > max_moment_side) return Status::image_too_large;
    if (!image.contains(seed)) return Status::out_of_range;
    if (scratch.size() < flood_fill_scratch(image.size(), 1)) return Status::scratch_too_small;
    const ImageView<Gray8> mask(scratch.data(), image.size(), image.width());
    const Span<std::uint8_t> rest = scratch.from(static_cast<std::ptrdiff_t>(image.size().area()));
    const Gray8 old = image(seed.x, seed.y);
    const auto region = grow_region(image, seed, old, old, connectivity, rest, mask);
    if (!region) return region;
    for (int y = region->box.y; y <= region->box.bottom(); ++y)
        detail::fill_where(mask.row(y), value, region->box.x, region->box.right() + 1, image.row(y));
    return region;
}

}  // namespace fovea
