// SPDX-License-Identifier: MIT
//
// Histogram of an 8-bit image, and the thresholds that follow from it: quantiles and Otsu's. Book sec. 2.5.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/simd/count_bytes.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// How often each grey level occurs. An accumulator: it takes rows in any number of calls, also at the end of
/// a stream; merge() joins those of strips.
///
/// Units   counts of pixels; at most 2^32 - 1 in all, so every image up to 65535 x 65535 fits
/// Memory  1 KiB a table
/// Source  book sec. 2.5.1
template <int Tables>
class HistogramOf {
    static_assert(Tables == 1 || Tables == 4, "one table, or four that take turns");

public:
    using Input = Gray8;
    static constexpr int levels = 256;

    /// Begins an image: no pixel is counted. Errors: empty_image, with the counts untouched.
    constexpr Status begin(Size size) {
        if (size.empty()) return Status::empty_image;
        clear();
        return Status::ok;
    }
    constexpr void add_row(const Gray8* row, int width, int) { add_row(row, width); }
    /// Adds the counts of another one.
    constexpr void merge(const HistogramOf& other) {
        for (int level = 0; level < levels; ++level) counts_[0][level] += other[level];
    }
    /// Adds the pixels of a row.
    constexpr void add_row(const Gray8* row, int width) {
        int x = 0;
        if constexpr (Tables == 4 && simd::counts_four_bytes)
            if (!__builtin_is_constant_evaluated()) x = simd::count_bytes(row, width, counts_);
        for (; x + 8 <= width; x += 8) {
            add_four(row + x);
            add_four(row + x + 4);
        }
        for (; x < width; ++x) ++counts_[0][row[x]];
    }
    /// Adds the pixels of a row whose mask is not 0.
    constexpr void add_row(const Gray8* row, const Gray8* mask, int width) {
        // A mask is as often set as not: added, so that no branch is guessed wrong.
        for (int x = 0; x < width; ++x) counts_[x % Tables][row[x]] += mask[x] != 0 ? 1u : 0u;
    }
    constexpr int size() const { return levels; }
    constexpr std::uint32_t operator[](int level) const {
        FOVEA_ASSERT(level >= 0 && level < levels);
        std::uint32_t sum = 0;
        for (const auto& table : counts_) sum += table[level];
        return sum;
    }
    /// The 256 counts, for who reads or changes them more than once: the tables are joined to one.
    constexpr std::uint32_t* counts() {
        if constexpr (Tables == 4)
            for (int level = 0; level < levels; ++level) {
                counts_[0][level] += counts_[1][level] + counts_[2][level] + counts_[3][level];
                counts_[1][level] = 0;
                counts_[2][level] = 0;
                counts_[3][level] = 0;
            }
        return counts_[0];
    }
    constexpr std::uint32_t total() const {
        std::uint32_t sum = 0;
        for (int level = 0; level < levels; ++level) sum += (*this)[level];
        return sum;
    }
    constexpr void clear() {
        for (auto& table : counts_)
            for (std::uint32_t& count : table) count = 0;
    }

private:
    constexpr void add_four(const Gray8* pixels) {
        // All four are read before one is written: a count need not wait for a store before it. One table
        // takes them one after the other.
        std::uint32_t* const first = &counts_[0][pixels[0]];
        std::uint32_t* const second = &counts_[1 % Tables][pixels[1]];
        std::uint32_t* const third = &counts_[2 % Tables][pixels[2]];
        std::uint32_t* const fourth = &counts_[3 % Tables][pixels[3]];
        if constexpr (Tables == 4) {
            const std::uint32_t counts[] = {*first + 1, *second + 1, *third + 1, *fourth + 1};
            *first = counts[0];
            *second = counts[1];
            *third = counts[2];
            *fourth = counts[3];
        } else {
            ++*first;
            ++*second;
            ++*third;
            ++*fourth;
        }
    }

    std::uint32_t counts_[static_cast<std::size_t>(Tables)][levels]{};
};

/// On processors with a long pipeline four tables take turns, so that a pixel does not wait until its like
/// before it is counted; Helium fills them side by side. On other chips one is enough.
using Histogram = HistogramOf<sizeof(void*) >= 8 || simd::counts_four_bytes ? 4 : 1>;

/// The histogram of a whole image.
///
/// Shapes  src 1x1 or larger
/// Errors  empty_image, with histogram untouched
/// Source  book sec. 2.5.1
constexpr Status histogram_of(ImageView<const Gray8> src, Histogram& histogram);

/// The histogram of the pixels whose mask is not 0. For a rectangle take the crop of the view.
///
/// Shapes  src and mask equal, 1x1 or larger
/// Errors  empty_image, size_mismatch, with histogram untouched
/// Source  book sec. 2.5.1
constexpr Status histogram_of(ImageView<const Gray8> src, ImageView<const Gray8> mask, Histogram& histogram);

/// A share of all pixels: share / 65536.
inline constexpr std::uint32_t whole_share = 65536;

/// The smallest grey level such that at least share / 65536 of all pixels are not brighter.
///
/// Errors  empty_image without a pixel, bad_argument for a share above whole_share
/// Source  book sec. 2.5.3
constexpr Result<Gray8> quantile(const Histogram& histogram, std::uint32_t share);

/// The level for threshold() that splits the pixels into the two classes whose means differ most, weighed by
/// their sizes: the dark class is below it.
///
/// Rounding  where several levels are equally good, as in an empty gap between two classes, their middle,
///           rounded down
/// Errors    empty_image without a pixel, degenerate if all pixels have one level
/// Source    Otsu, "A Threshold Selection Method from Gray-Level Histograms", IEEE Trans. SMC 9(1), 1979, eq.
///           14 and 18; Otsu's k is one less. The variances are compared as square roots of 31 bits; of more
///           than 2^26 pixels the counts are halved until they fit
constexpr Result<Gray8> otsu(const Histogram& histogram);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// A cleared histogram in scratch. As its words: a whole one made on the stack would be 1 KiB of it.
inline Histogram& take_histogram(Arena& arena) {
    static_assert(
        sizeof(Histogram) % sizeof(std::uint32_t) == 0 && alignof(Histogram) == alignof(std::uint32_t),
        "a histogram is made of words");
    return *reinterpret_cast<Histogram*>(
        arena.take<std::uint32_t>(sizeof(Histogram) / sizeof(std::uint32_t)).data());
}

}  // namespace detail

constexpr Status histogram_of(ImageView<const Gray8> src, Histogram& histogram) {
    if (src.empty()) return Status::empty_image;
    histogram.clear();
    for (int y = 0; y < src.height(); ++y) histogram.add_row(src.row(y), src.width());
    return Status::ok;
}

constexpr Status histogram_of(ImageView<const Gray8> src, ImageView<const Gray8> mask, Histogram& histogram) {
    if (src.empty() || mask.empty()) return Status::empty_image;
    if (mask.size() != src.size()) return Status::size_mismatch;
    histogram.clear();
    for (int y = 0; y < src.height(); ++y) histogram.add_row(src.row(y), mask.row(y), src.width());
    return Status::ok;
}

constexpr Result<Gray8> quantile(const Histogram& histogram, std::uint32_t share) {
    const std::uint64_t total = histogram.total();
    if (total == 0) return Status::empty_image;
    if (share > whole_share) return Status::bad_argument;
    std::uint64_t below = 0;
    for (int level = 0; level < Histogram::levels; ++level) {
        below += histogram[level];
        if (below > 0 && below * whole_share >= share * total) return static_cast<Gray8>(level);
    }
    return Gray8{255};
}

constexpr Result<Gray8> otsu(const Histogram& histogram) {
    const std::uint32_t pixels = histogram.total();
    if (pixels == 0) return Status::empty_image;
    const int drop = maximum(6 - leading_zeros(pixels), 0);
    const int length = 32 - leading_zeros(pixels >> drop);

    std::int64_t total = 0;
    std::int64_t total_sum = 0;
    for (int level = 0; level < Histogram::levels; ++level) {
        total += histogram[level] >> drop;
        total_sum += static_cast<std::int64_t>(histogram[level] >> drop) * level;
    }

    // The between-class variance is d^2 / (dark * bright) with d = dark_sum * bright - bright_sum * dark; its
    // root |d| / sqrt(dark * bright) orders alike. With totals below 2^length, |d| < 2^(2 length + 6) and
    // dark * bright <= 2^(2 length - 2): raised by these shifts they fill 63 and 60 bits, and the root 33.
    const int raise_d = 57 - 2 * length;
    const int raise_spread = 62 - 2 * length;
    std::int64_t dark = 0;
    std::int64_t dark_sum = 0;
    std::uint64_t best = 0;
    int first = 0;
    int last = 0;
    for (int level = 1; level < Histogram::levels; ++level) {
        dark += histogram[level - 1] >> drop;
        dark_sum += static_cast<std::int64_t>(histogram[level - 1] >> drop) * (level - 1);
        const std::int64_t bright = total - dark;
        if (dark == 0 || bright == 0) continue;
        const std::int64_t d = dark_sum * bright - (total_sum - dark_sum) * dark;
        const std::uint64_t spread = static_cast<std::uint64_t>(dark * bright) << raise_spread;
        const std::uint64_t root = (magnitude(d) << raise_d) / isqrt(spread);
        if (root > best) {
            best = root;
            first = level;
            last = level;
        } else if (root == best && last == level - 1) {
            last = level;
        }
    }
    if (best == 0) return Status::degenerate;
    return static_cast<Gray8>((first + last) / 2);
}

}  // namespace fovea
