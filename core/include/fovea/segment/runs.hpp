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
#include <fovea/simd/bits.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>

namespace fovea {

namespace detail {

/// As many pixels as the processor reads at once, and as many bits.
using PixelWord = std::conditional_t<(sizeof(void*) >= 8), std::uint64_t, std::uint32_t>;

}  // namespace detail

// ---- Interface --------------------------------------------------------------------

using RunLabel = std::uint16_t;
inline constexpr RunLabel no_label = 0xffff;

/// Pixels from first up to the next run's first, and the number of the component they belong to.
struct Run {
    std::uint16_t first = 0;
    RunLabel label = no_label;
};

inline namespace FOVEA_ISA {

/// The runs of one row, region and ground in turn. Holds no memory of its own.
class RunRow {
public:
    RunRow() = default;
    explicit RunRow(Span<Run> room) : runs_(room) {}

    /// Cuts a row of width pixels (1..65535) into runs: zero is ground, all else region.
    ///
    /// Errors  capacity_exceeded if there is no room for the runs and one more; width + 1 is always enough
    Status split(const std::uint8_t* row, int width);

    int count() const { return count_; }
    Run& operator[](int index) const { return runs_[index]; }
    bool is_region(int index) const { return (index % 2 == 0) == starts_with_region_; }
    /// The first run of a region, or of the ground; it may be count(). The others are every second behind.
    int first_of(bool regions) const { return starts_with_region_ == regions ? 0 : 1; }
    int end(int index) const { return runs_[index + 1].first; }

private:
    /// Behind the last run stands where it ends.
    Status close(int width);
    bool add_changes(detail::PixelWord changes, int x);

    Span<Run> runs_;
    int count_ = 0;
    bool starts_with_region_ = false;
};

}  // namespace FOVEA_ISA

// ---- Implementation ---------------------------------------------------------------

namespace detail {

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

/// How many pixels fit a word at one bit each, the first pixel at the lowest.
inline constexpr int bits_pixels = 8 * word_pixels;

inline namespace FOVEA_ISA {

/// Which of bits_pixels pixels are not zero.
[[gnu::always_inline]] inline PixelWord bits_of_pixels(const std::uint8_t* first) {
    PixelWord bits = simd::bits_at_least(first, 1);
    if constexpr (bits_pixels == 64) bits |= std::uint64_t{simd::bits_at_least(first + 32, 1)} << 32;
    return bits;
}
/// The same for fewer, 1 or more, the last ones of a row of width; no bits behind them.
inline PixelWord bits_of_last(const std::uint8_t* row, int width, int count) {
    if (width >= bits_pixels) return bits_of_pixels(row + width - bits_pixels) >> (bits_pixels - count);
    std::uint8_t block[bits_pixels] = {};
    std::memcpy(block, row, static_cast<std::size_t>(width));
    return bits_of_pixels(block);
}
/// True if bits_pixels pixels are seen at a glance to be like those before them. Narrow vectors take longer
/// for their bits than words for this question; wide ones do not.
[[gnu::always_inline]] inline bool plainly_alike(const std::uint8_t* first, PixelWord before) {
    if constexpr (simd::lanes > 8) return false;
    for (int x = 0; x < bits_pixels; x += 4 * word_pixels)
        if (!block_alike(first + x, before != 0)) return false;
    return true;
}

}  // namespace FOVEA_ISA

}  // namespace detail

inline namespace FOVEA_ISA {

inline Status RunRow::split(const std::uint8_t* row, int width) {
    using namespace detail;
    count_ = 0;
    starts_with_region_ = row[0] != 0;
    if (runs_.empty()) return Status::capacity_exceeded;
    runs_[count_++] = {0, no_label};
    PixelWord before = starts_with_region_ ? 1 : 0;
    int x = 0;
    for (; x + bits_pixels <= width; x += bits_pixels) {
        if (plainly_alike(row + x, before)) continue;
        const PixelWord bits = bits_of_pixels(row + x);
        if (!add_changes(bits ^ (bits << 1 | before), x)) return Status::capacity_exceeded;
        before = bits >> (bits_pixels - 1);
    }
    if (x == width) return close(width);
    const PixelWord bits = bits_of_last(row, width, width - x);
    const PixelWord inside = (PixelWord{1} << (width - x)) - 1;
    if (!add_changes((bits ^ (bits << 1 | before)) & inside, x)) return Status::capacity_exceeded;
    return close(width);
}

inline Status RunRow::close(int width) {
    if (count_ >= runs_.size()) return Status::capacity_exceeded;
    runs_[count_] = {static_cast<std::uint16_t>(width), no_label};
    return Status::ok;
}

/// Begins a run at every pixel from x on whose bit is set. False if there was no room.
inline bool RunRow::add_changes(detail::PixelWord changes, int x) {
    if (runs_.size() - count_ >= detail::bits_pixels) {
        // No question of room for each.
        Run* next = runs_.data() + count_;
        for (; changes != 0; changes &= changes - 1)
            *next++ = {static_cast<std::uint16_t>(x + trailing_zeros(changes)), no_label};
        count_ = static_cast<int>(next - runs_.data());
        return true;
    }
    for (; changes != 0; changes &= changes - 1) {
        if (count_ >= runs_.size()) return false;
        runs_[count_++] = {static_cast<std::uint16_t>(x + trailing_zeros(changes)), no_label};
    }
    return true;
}

}  // namespace FOVEA_ISA
}  // namespace fovea
