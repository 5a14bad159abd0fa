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

inline constexpr PixelWord low_bits = static_cast<PixelWord>(0x7f7f7f7f7f7f7f7f);
inline constexpr bool first_pixel_is_lowest = __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__;

inline PixelWord load_pixels(const std::uint8_t* first) {
    PixelWord word = 0;
    std::memcpy(&word, first, sizeof word);
    return word;
}
/// The top bit of every byte that is not zero.
inline PixelWord pixels_set(PixelWord word) { return (((word & low_bits) + low_bits) | word) & ~low_bits; }
/// The place of the first pixel with its top bit set. There must be one.
inline int first_pixel_of(PixelWord set) {
    return (first_pixel_is_lowest ? 8 * word_pixels - 1 - leading_zeros(set & (0 - set))
                                  : leading_zeros(set)) /
           8;
}

/// True if 4 * word_pixels pixels are all zero, or all 255: long runs are passed by with one question. Other
/// pixels of a region may answer false.
inline bool block_alike(const std::uint8_t* first, bool region) {
    const PixelWord a = load_pixels(first);
    const PixelWord b = load_pixels(first + word_pixels);
    const PixelWord c = load_pixels(first + 2 * word_pixels);
    const PixelWord d = load_pixels(first + 3 * word_pixels);
    return region ? ((a & b) & (c & d)) == static_cast<PixelWord>(-1) : ((a | b) | (c | d)) == 0;
}

/// How many of the first word_pixels pixels are like the first one: zero, or not zero.
inline int pixels_alike(const std::uint8_t* first, bool region) {
    const PixelWord set = pixels_set(load_pixels(first));
    const PixelWord other = region ? set ^ ~low_bits : set;
    return other == 0 ? word_pixels : first_pixel_of(other);
}

/// The pixels of a word that differ from the one before them, as their top bits; before is what stands before
/// the first, and becomes what the last one is.
inline PixelWord pixels_changed(const std::uint8_t* first, bool& before) {
    constexpr int last = 8 * (word_pixels - 1);
    const PixelWord set = pixels_set(load_pixels(first));
    const PixelWord edge = before ? 0x80 : 0;
    if constexpr (first_pixel_is_lowest) {
        before = set >> (last + 7) != 0;
        return set ^ (set << 8 | edge);
    }
    before = (set & 0x80) != 0;
    return set ^ (set >> 8 | edge << last);
}

}  // namespace detail

inline Status RunRow::split(const std::uint8_t* row, int width) {
    using detail::word_pixels;
    count_ = 0;
    width_ = width;
    starts_with_region_ = row[0] != 0;
    if (runs_.empty()) return Status::capacity_exceeded;
    runs_[count_++] = {0, no_label};
    bool region = starts_with_region_;
    bool calm = true;
    int x = 0;
    while (x + word_pixels <= width) {
        if (calm && x + 4 * word_pixels <= width && detail::block_alike(row + x, region)) {
            x += 4 * word_pixels;
            continue;
        }
        detail::PixelWord changed = detail::pixels_changed(row + x, region);
        calm = changed == 0;
        while (changed != 0) {
            if (count_ >= runs_.size()) return Status::capacity_exceeded;
            const int place = detail::first_pixel_of(changed);
            runs_[count_++] = {static_cast<std::uint16_t>(x + place), no_label};
            changed &= detail::first_pixel_is_lowest
                           ? changed - 1
                           : ~(detail::PixelWord{0x80} << (8 * (word_pixels - 1 - place)));
        }
        x += word_pixels;
    }
    for (; x < width; ++x) {
        if ((row[x] != 0) == region) continue;
        if (count_ >= runs_.size()) return Status::capacity_exceeded;
        runs_[count_++] = {static_cast<std::uint16_t>(x), no_label};
        region = !region;
    }
    return Status::ok;
}

}  // namespace fovea
