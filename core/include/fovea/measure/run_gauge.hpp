// SPDX-License-Identifier: MIT
//
// Run gauge: how wide an object is in the rows that it lies across - wire, strip, thread, a bead of glue.
#pragma once

#include <cstdint>

#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/scan.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Widths in pixels, of the longest run in each row that holds the object.
struct RunWidths {
    int rows = 0;       ///< that hold the object
    int first_row = 0;  ///< the topmost of them
    int last_row = 0;
    int narrowest = 0;
    int widest = 0;
    FinePixel mean;
};

inline namespace FOVEA_ISA {

/// The length of the longest run of pixels that are not zero; 0 where there is none.
inline int longest_run(const Gray8* row, int width);

/// The widths of the object in a binary image: zero is ground, all else belongs. A row holds the object where
/// its longest run has width_min pixels, so that specks do not count.
///
/// Shapes    src 1x1 or larger, sides up to max_image_side
/// Units     pixels; width_min 1 or more
/// Rounding  the mean to the nearest 1/65536 px, ties up; the sum of all widths is below 2^30
/// Errors    empty_image, image_too_large, bad_argument; not_found where no row holds the object
/// Source    own: a projection counts all pixels of a row, this the longest run alone
inline Result<RunWidths> run_widths(ImageView<const Gray8> src, int width_min);

/// run_widths() of rows that come one at a time: an accumulator for streams. What strips of a frame gave is
/// joined by merge().
///
/// Errors  of begin(): image_too_large, bad_argument. Of result(): not_found
class RunWidthAccumulator {
public:
    using Input = Gray8;
    explicit RunWidthAccumulator(int width_min) : width_min_(width_min) {}

    Status begin(Size size);
    void add_row(const Gray8* row, int width, int y);
    /// Adds the rows of another strip of the same image.
    void merge(const RunWidthAccumulator& other);
    Result<RunWidths> result() const;

private:
    int width_min_;
    RunWidths widths_;
    int sum_ = 0;
};

}  // namespace FOVEA_ISA

// ---- Implementation ---------------------------------------------------------------

inline namespace FOVEA_ISA {

inline int longest_run(const Gray8* row, int width) {
    int longest = 0;
    for (int x = simd::find_at_least(row, 0, width, 1); x < width;) {
        const int end = simd::find_below(row, x, width, 1);
        longest = maximum(longest, end - x);
        x = simd::find_at_least(row, end, width, 1);
    }
    return longest;
}

inline Status RunWidthAccumulator::begin(Size size) {
    if (size.width > max_image_side || size.height > max_image_side) return Status::image_too_large;
    if (width_min_ < 1) return Status::bad_argument;
    widths_ = {};
    sum_ = 0;
    return Status::ok;
}

inline void RunWidthAccumulator::add_row(const Gray8* row, int width, int y) {
    const int longest = longest_run(row, width);
    if (longest < width_min_) return;
    RunWidthAccumulator one(width_min_);
    one.widths_ = {1, y, y, longest, longest, {}};
    one.sum_ = longest;
    merge(one);
}

inline void RunWidthAccumulator::merge(const RunWidthAccumulator& other) {
    if (other.widths_.rows == 0) return;
    if (widths_.rows == 0) widths_ = {0, other.widths_.first_row, 0, other.widths_.narrowest, 0, {}};
    widths_.rows += other.widths_.rows;
    widths_.first_row = minimum(widths_.first_row, other.widths_.first_row);
    widths_.last_row = maximum(widths_.last_row, other.widths_.last_row);
    widths_.narrowest = minimum(widths_.narrowest, other.widths_.narrowest);
    widths_.widest = maximum(widths_.widest, other.widths_.widest);
    sum_ += other.sum_;
}

inline Result<RunWidths> RunWidthAccumulator::result() const {
    if (widths_.rows == 0) return Status::not_found;
    RunWidths widths = widths_;
    widths.mean = FinePixel::from_ratio(sum_, widths.rows);
    return widths;
}

inline Result<RunWidths> run_widths(ImageView<const Gray8> src, int width_min) {
    if (src.empty()) return Status::empty_image;
    RunWidthAccumulator accumulator(width_min);
    if (const Status s = accumulator.begin(src.size()); s != Status::ok) return s;
    for (int y = 0; y < src.height(); ++y) accumulator.add_row(src.row(y), src.width(), y);
    return accumulator.result();
}

}  // namespace FOVEA_ISA
}  // namespace fovea
