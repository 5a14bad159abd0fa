// SPDX-License-Identifier: MIT
//
// Runs: a row of a binary image as stretches of equal pixels.
#pragma once

#include <cstdint>
#include <cstring>
#include <type_traits>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

using RunLabel = std::uint16_t;
inline constexpr RunLabel no_label = 0xffff;

/// Pixels from first up to the next run's first, and the number of the component they belong to.
struct Run {
    std::uint16_t first = 0;
    RunLabel label = no_label;
};

/// The runs of one row, region and ground in turn. Holds no memory of its own.
class RunRow {
public:
    RunRow() = default;
    explicit RunRow(Span<Run> room) : runs_(room) {}

    /// Cuts a row of width pixels (1..65535) into runs: zero is ground, all else region.
    ///
    /// Errors  capacity_exceeded if there are more runs than room; width + 1 is always enough
    Status split(const std::uint8_t* row, int width);

    int count() const { return count_; }
    Run& operator[](int index) const { return runs_[index]; }
    bool is_region(int index) const { return (index % 2 == 0) == starts_with_region_; }
    int end(int index) const { return index + 1 < count_ ? runs_[index + 1].first : width_; }

private:
    Span<Run> runs_;
    int count_ = 0;
    int width_ = 0;
    bool starts_with_region_ = false;
};

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// As many pixels as the processor reads at once.
using PixelWord = std::conditional_t<(sizeof(void*) >= 8), std::uint64_t, std::uint32_t>;
inline constexpr int word_pixels = sizeof(PixelWord);

/// True if 4 * word_pixels pixels are all zero, or all 255: long runs are passed by with one question. Other
/// pixels of a region may answer false.
inline bool block_alike(const std::uint8_t* first, bool region) {
    PixelWord words[4];
    std::memcpy(words, first, sizeof words);
    if (region) return (words[0] & words[1] & words[2] & words[3]) == static_cast<PixelWord>(-1);
    return (words[0] | words[1] | words[2] | words[3]) == 0;
}

/// How many of the first word_pixels pixels are like the first one: zero, or not zero.
inline int pixels_alike(const std::uint8_t* first, bool region) {
    constexpr PixelWord low = static_cast<PixelWord>(0x7f7f7f7f7f7f7f7f);
    PixelWord word = 0;
    std::memcpy(&word, first, sizeof word);
    const PixelWord set = (((word & low) + low) | word) & ~low;  // the top bit of every byte that is not zero
    const PixelWord other = region ? set ^ ~low : set;
    if (other == 0) return word_pixels;
    constexpr bool first_is_lowest = __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__;
    return (first_is_lowest ? 8 * word_pixels - 1 - leading_zeros(other & (0 - other))
                            : leading_zeros(other)) /
           8;
}

}  // namespace detail

inline Status RunRow::split(const std::uint8_t* row, int width) {
    count_ = 0;
    width_ = width;
    starts_with_region_ = row[0] != 0;
    bool region = starts_with_region_;
    for (int x = 0; x < width;) {
        if (count_ >= runs_.size()) return Status::capacity_exceeded;
        runs_[count_++] = {static_cast<std::uint16_t>(x), no_label};
        while (x + 4 * detail::word_pixels <= width && detail::block_alike(row + x, region))
            x += 4 * detail::word_pixels;
        int alike = detail::word_pixels;
        while (alike == detail::word_pixels && x + detail::word_pixels <= width) {
            alike = detail::pixels_alike(row + x, region);
            x += alike;
        }
        // What is left of the row is shorter than a word.
        if (alike == detail::word_pixels)
            while (x < width && (row[x] != 0) == region) ++x;
        region = !region;
    }
    return Status::ok;
}

}  // namespace fovea
