// SPDX-License-Identifier: MIT
//
// A threshold that follows the light across a picture of print, for the readers of matrix codes. Book sec.
// 2.8.1.
#pragma once

#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/bit_view.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/simd/bits.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

struct LocalThresholdOptions {
    int block = 8;  ///< px, 4 to 64: small ones follow shadows, large ones bridge broad bars and modules
    int min_contrast = 24;  ///< grey levels, 1 to 255, between the extremes of a block that holds an edge
};

/// Scratch bytes that local_threshold() needs.
constexpr std::int64_t local_threshold_scratch(Size size, int block);

inline namespace FOVEA_ISA {

/// Sets the bits of the pixels that are darker than the middle between dark and light around them.
///
/// Shapes    src and dst equal, 1x1 or larger
/// Rounding  a block's middle is that of its darkest and lightest pixel, down; a block without contrast takes
///           the mean of its neighbours above and left, or else below and right; the threshold of a block is
///           the mean of the middles of the 5x5 around it, up, those outside of the image left out
/// Scratch   local_threshold_scratch(src.size(), block) bytes, undefined afterwards
/// Errors    empty_image, size_mismatch, bad_argument, scratch_too_small; not_found, with dst untouched,
///           where no block has contrast
/// Source    the idea of blocks and their neighbours is that of the hybrid binarizer of ZXing; the middle
///           instead of the mean does not mind how much of a block is print
inline Status local_threshold(ImageView<const Gray8> src, const LocalThresholdOptions& options,
                              Span<std::uint8_t> scratch, BitView<BitWord> dst);

}  // namespace FOVEA_ISA

// ---- Implementation ---------------------------------------------------------------

namespace detail {

constexpr Size threshold_blocks(Size size, int block) {
    return {(size.width + block - 1) / block, (size.height + block - 1) / block};
}
/// A row of bytes and a vector more, so that the last vector is a whole one.
constexpr std::int64_t padded_row(int width) { return std::int64_t{width} + 2 * bits_a_word; }

/// The middles of blocks, 0 for one without contrast.
class BlockMiddles {
public:
    BlockMiddles(Span<std::uint8_t> middles, Size size) : middles_(middles), size_(size) {}

    std::uint8_t& operator()(int x, int y) const { return middles_[std::ptrdiff_t{y} * size_.width + x]; }

    /// Gives every block a middle; false where no block has one.
    bool fill() const {
        for (int y = 0; y < size_.height; ++y)
            for (int x = 0; x < size_.width; ++x) take_from(x, y, -1);
        for (int y = size_.height - 1; y >= 0; --y)
            for (int x = size_.width - 1; x >= 0; --x) take_from(x, y, 1);
        return (*this)(0, 0) != 0;
    }
    /// The mean of the middles around each block of a row, from the sums of columns.
    void smooth_row(int y, Span<std::uint16_t> columns, Span<std::uint8_t> thresholds) const {
        const int top = maximum(y - reach, 0);
        const int bottom = minimum(y + reach, size_.height - 1);
        for (int x = 0; x < size_.width; ++x) columns[x] = 0;
        for (int row = top; row <= bottom; ++row) {
            for (int x = 0; x < size_.width; ++x) {
                columns[x] = static_cast<std::uint16_t>(columns[x] + (*this)(x, row));
            }
        }
        int sum = 0;
        for (int x = 0; x < minimum(reach, size_.width); ++x) sum += columns[x];
        for (int x = 0; x < size_.width; ++x) {
            if (x + reach < size_.width) sum += columns[x + reach];
            const int first = maximum(x - reach, 0);
            const int last = minimum(x + reach, size_.width - 1);
            const int count = (last - first + 1) * (bottom - top + 1);
            thresholds[x] = static_cast<std::uint8_t>(minimum((sum + count - 1) / count, 255));
            if (x >= reach) sum -= columns[x - reach];
        }
    }

private:
    static constexpr int reach = 2;

    void take_from(int x, int y, int side) const {
        if ((*this)(x, y) != 0) return;
        const bool beside = x + side >= 0 && x + side < size_.width;
        const bool along = y + side >= 0 && y + side < size_.height;
        const int row = beside ? (*this)(x + side, y) : 0;
        const int column = along ? (*this)(x, y + side) : 0;
        const int both = row != 0 && column != 0 ? 2 : 1;
        (*this)(x, y) = static_cast<std::uint8_t>((row + column) / both);
    }

    Span<std::uint8_t> middles_;
    Size size_;
};

}  // namespace detail

constexpr std::int64_t local_threshold_scratch(Size size, int block) {
    const Size blocks = detail::threshold_blocks(size, block);
    return arena_bytes<std::uint8_t>(blocks.area()) + arena_bytes<std::uint16_t>(blocks.width) +
           arena_bytes<std::uint8_t>(blocks.width) +
           2 * arena_bytes<std::uint8_t>(detail::padded_row(size.width));
}

inline namespace FOVEA_ISA {
namespace kernels {

/// The darkest and lightest of rows first to end, column by column.
inline void column_extremes(ImageView<const Gray8> src, int first, int end, Gray8* low, Gray8* high) {
    const int width = src.width();
    for (int x = 0; x < width; x += simd::lanes) {
        const int count = minimum(simd::lanes, width - x);
        const bool whole = count == simd::lanes;
        const auto at = [&](int y) {
            return whole ? simd::Bytes::load(src.row(y) + x) : simd::Bytes::load(src.row(y) + x, count);
        };
        simd::Bytes least = at(first);
        simd::Bytes most = least;
        for (int y = first + 1; y < end; ++y) {
            const simd::Bytes row = at(y);
            least = lower(least, row);
            most = higher(most, row);
        }
        if (whole) {
            least.store(low + x);
            most.store(high + x);
        } else {
            least.store(low + x, count);
            most.store(high + x, count);
        }
    }
}

/// Bits of the pixels below their thresholds.
inline void darker_than(const Gray8* row, const Gray8* thresholds, Gray8* marks, int width, BitWord* dst) {
    for (int x = 0; x < width; x += simd::lanes) {
        const int count = minimum(simd::lanes, width - x);
        if (count == simd::lanes) {
            at_least(simd::Bytes::load(row + x), simd::Bytes::load(thresholds + x)).store(marks + x);
        } else {
            at_least(simd::Bytes::load(row + x, count), simd::Bytes::load(thresholds + x, count))
                .store(marks + x, count);
        }
    }
    const int words = bit_words(width);
    for (int i = 0; i < words; ++i) dst[i] = ~simd::bits_at_least(marks + i * bits_a_word, 1);
    dst[words - 1] &= last_bits(width);
}

}  // namespace kernels

inline Status local_threshold(ImageView<const Gray8> src, const LocalThresholdOptions& options,
                              Span<std::uint8_t> scratch, BitView<BitWord> dst) {
    if (src.empty() || dst.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    const int block = options.block;
    if (block < 4 || block > 64 || options.min_contrast < 1 || options.min_contrast > 255)
        return Status::bad_argument;
    if (scratch.size() < local_threshold_scratch(src.size(), block)) return Status::scratch_too_small;
    const int width = src.width();
    const Size blocks = detail::threshold_blocks(src.size(), block);
    Arena arena(scratch);
    const detail::BlockMiddles middles(arena.take_unset<std::uint8_t>(blocks.area()), blocks);
    const Span<std::uint16_t> columns = arena.take_unset<std::uint16_t>(blocks.width);
    const Span<std::uint8_t> smooth = arena.take_unset<std::uint8_t>(blocks.width);
    Gray8* low = arena.take_unset<std::uint8_t>(detail::padded_row(width)).data();
    Gray8* high = arena.take<std::uint8_t>(detail::padded_row(width)).data();

    for (int by = 0; by < blocks.height; ++by) {
        const int first = by * block;
        kernels::column_extremes(src, first, minimum(first + block, src.height()), low, high);
        for (int bx = 0; bx < blocks.width; ++bx) {
            int darkest = 255;
            int lightest = 0;
            for (int x = bx * block; x < minimum((bx + 1) * block, width); ++x) {
                darkest = minimum<int>(darkest, low[x]);
                lightest = maximum<int>(lightest, high[x]);
            }
            const bool edge = lightest - darkest >= options.min_contrast;
            // Not 0: at least 1 with a contrast of 2, and one level of contrast is none to speak of.
            middles(bx, by) = static_cast<std::uint8_t>(edge ? maximum((darkest + lightest) / 2, 1) : 0);
        }
    }
    if (!middles.fill()) return Status::not_found;
    for (int by = 0; by < blocks.height; ++by) {
        middles.smooth_row(by, columns, smooth);
        for (int x = 0; x < width; ++x) low[x] = smooth[x / block];
        for (int y = by * block; y < minimum((by + 1) * block, src.height()); ++y) {
            kernels::darker_than(src.row(y), low, high, width, dst.row(y));
        }
    }
    return Status::ok;
}

}  // namespace FOVEA_ISA

}  // namespace fovea
