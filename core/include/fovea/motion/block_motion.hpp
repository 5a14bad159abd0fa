// SPDX-License-Identifier: MIT
//
// Block motion: in which blocks of the image the mean brightness left that of a background which follows
// slowly. A few kilobytes watch a frame of any size.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/short_sums.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

struct BlockMotionOptions {
    int block = 16;  ///< side of a block in pixels: 4, 8, 16, 32, 64 or 128; small ones see small things
    int difference_min = 8;  ///< grey levels, 1..255, by which the mean of a changed block differs at least
    int follow = 4;          ///< 0..8: of every difference the background takes over 1/2^follow a frame
};

/// What moved.
struct BlockMotion {
    int changed = 0;  ///< blocks
    Rectangle box;    ///< around them, counted in blocks; empty without any
    GrayLevel light;  ///< by how much all became brighter; not counted as motion
};

/// Blocks of an image; those at the right and at the bottom may be narrower and lower than the others.
constexpr Size blocks_of(Size size, int block) {
    return {(size.width + block - 1) / block, (size.height + block - 1) / block};
}
/// Bytes of scratch for an image: a sum for each column of blocks, a mean for each block.
constexpr std::int64_t block_motion_scratch(Size size, int block) {
    return arena_bytes<std::uint32_t>(blocks_of(size, block).width) +
           arena_bytes<std::uint16_t>(blocks_of(size, block).area());
}

inline namespace FOVEA_ISA {

/// Compares every frame with those before: an accumulator for streams, whose finish() answers. It keeps the
/// background from frame to frame; the first frame, or the first of another size, is the background.
///
/// Every block has the mean m of its pixels and its background b. light is the median of all m - b, the lower
/// one of two in the middle, so that a lamp that is switched on is no motion while less than half of the
/// blocks change otherwise. A block is changed where |m - b - light| reaches difference_min. Afterwards b
/// takes over its share of m - b, changed or not: what stays becomes background.
///
/// Shapes    whole frames, sides up to max_image_side, with memory for a number in each of blocks_of()
/// Units     means and background in 1/256 grey level; sums are below 2^22, times 256 below 2^30
/// Rounding  means to the nearest, ties up; of the background's step too, so that it stops within half of
///           2^follow / 256 levels of what it follows
/// Scratch   block_motion_scratch(), in use until finish(); free between frames
/// Errors    of begin(): image_too_large, bad_argument, size_mismatch for a background of another count than
///           blocks, scratch_too_small. Of finish(): out_of_range if a row is missing, with the
///           background as it was; undecided of the first frame
/// Source    own; running average and median as is usual
class BlockMotionAccumulator {
public:
    using Input = Gray8;
    BlockMotionAccumulator(const BlockMotionOptions& options, Span<std::uint16_t> background,
                           Span<std::uint8_t> scratch)
        : options_(options), background_(background), scratch_(scratch) {}

    Status begin(Size size);
    void add_row(const Gray8* row, int width, int y);
    /// What moved since the frames before, once the last row has come.
    Result<BlockMotion> finish();
    /// Makes the next frame the background.
    void forget() { learned_ = {}; }

private:
    void close_blocks(int width, int y);
    void learn();
    int median_difference() const;
    int difference(std::ptrdiff_t i) const { return int{means_[i]} - int{background_[i]}; }

    BlockMotionOptions options_;
    Span<std::uint16_t> background_;
    Span<std::uint8_t> scratch_;
    Span<std::uint32_t> sums_;
    Span<std::uint16_t> means_;
    Size size_;
    Size learned_;
    int next_ = 0;
    bool in_order_ = false;
};

/// What moved in a frame at hand.
///
/// Shapes  src 1x1 or larger
/// Others  as BlockMotionAccumulator
/// Errors  empty_image, and what begin() and finish() say
inline Result<BlockMotion> block_motion(ImageView<const Gray8> src, BlockMotionAccumulator& accumulator);

}  // namespace FOVEA_ISA

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Largest sum of a block in 1/256 levels, and half of the count for its rounding.
inline constexpr int most_block = 128;
static_assert(most_block <= simd::most_stretch);
static_assert(std::int64_t{most_block} * most_block * (255 * 256 + 1) < std::int64_t{1} << 31);

constexpr bool in_range(const BlockMotionOptions& options) {
    return options.block >= 4 && options.block <= most_block && (options.block & (options.block - 1)) == 0 &&
           options.difference_min >= 1 && options.difference_min <= 255 && options.follow >= 0 &&
           options.follow <= 8;
}

}  // namespace detail

inline namespace FOVEA_ISA {

inline Status BlockMotionAccumulator::begin(Size size) {
    in_order_ = false;
    if (size.width > max_image_side || size.height > max_image_side) return Status::image_too_large;
    if (!detail::in_range(options_)) return Status::bad_argument;
    const Size blocks = blocks_of(size, options_.block);
    if (background_.size() != blocks.area()) return Status::size_mismatch;
    if (scratch_.size() < block_motion_scratch(size, options_.block)) return Status::scratch_too_small;
    Arena arena(scratch_);
    sums_ = arena.take<std::uint32_t>(blocks.width);
    means_ = arena.take_unset<std::uint16_t>(blocks.area());
    size_ = size;
    next_ = 0;
    in_order_ = true;
    return Status::ok;
}

inline void BlockMotionAccumulator::add_row(const Gray8* row, int width, int y) {
    in_order_ = in_order_ && y == next_ && y < size_.height;
    ++next_;
    if (!in_order_) return;
    simd::add_stretches(row, width, options_.block, sums_.data());
    if (next_ % options_.block == 0 || next_ == size_.height) close_blocks(width, y);
}

/// Row y is the last of its blocks.
inline void BlockMotionAccumulator::close_blocks(int width, int y) {
    const int block = options_.block;
    std::uint16_t* mean = means_.data() + y / block * sums_.size();
    int x = 0;
    for (std::uint32_t& sum : sums_) {
        const int pixels = (y % block + 1) * minimum(block, width - x);
        *mean++ = static_cast<std::uint16_t>(round_divide(static_cast<int>(sum << 8), pixels));
        sum = 0;
        x += block;
    }
}

/// By halving what it may be: that wants no memory for the differences.
inline int BlockMotionAccumulator::median_difference() const {
    int low = -255 * 256;
    int high = 255 * 256;
    while (low < high) {
        const int middle = (low + high) >> 1;
        std::ptrdiff_t below = 0;  // differences up to the middle
        for (std::ptrdiff_t i = 0; i < means_.size(); ++i) below += difference(i) <= middle ? 1 : 0;
        if (2 * below >= means_.size())
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

inline void BlockMotionAccumulator::learn() {
    for (std::ptrdiff_t i = 0; i < means_.size(); ++i)
        background_[i] =
            static_cast<std::uint16_t>(background_[i] + round_shift(difference(i), options_.follow));
}

inline Result<BlockMotion> BlockMotionAccumulator::finish() {
    if (!in_order_ || next_ != size_.height) return Status::out_of_range;
    in_order_ = false;
    if (learned_ != size_) {
        learned_ = size_;
        for (std::ptrdiff_t i = 0; i < means_.size(); ++i) background_[i] = means_[i];
        return Status::undecided;
    }
    const int light = median_difference();
    const int least = options_.difference_min << 8;
    BlockMotion motion;
    motion.light = GrayLevel::from_raw(light * 256);
    const Size blocks = blocks_of(size_, options_.block);
    Point first{blocks.width, blocks.height};
    Point last{-1, -1};
    std::ptrdiff_t i = 0;
    for (int y = 0; y < blocks.height; ++y)
        for (int x = 0; x < blocks.width; ++x, ++i) {
            const int change = difference(i) - light;
            if (change < least && change > -least) continue;
            ++motion.changed;
            first = {minimum(first.x, x), minimum(first.y, y)};
            last = {maximum(last.x, x), y};
        }
    if (motion.changed > 0) motion.box = {first.x, first.y, last.x - first.x + 1, last.y - first.y + 1};
    learn();
    return motion;
}

inline Result<BlockMotion> block_motion(ImageView<const Gray8> src, BlockMotionAccumulator& accumulator) {
    if (src.empty()) return Status::empty_image;
    if (const Status s = accumulator.begin(src.size()); s != Status::ok) return s;
    for (int y = 0; y < src.height(); ++y) accumulator.add_row(src.row(y), src.width(), y);
    return accumulator.finish();
}

}  // namespace FOVEA_ISA
}  // namespace fovea
