// SPDX-License-Identifier: MIT
//
// Runs: a row of a binary image as stretches of equal pixels.
#pragma once

#include <cstdint>
#include <cstring>
#include <type_traits>

#include <fovea/base/arena.hpp>
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
inline constexpr int word_pixels = sizeof(PixelWord);
inline constexpr int bits_pixels = 8 * word_pixels;

}  // namespace detail

// ---- Interface --------------------------------------------------------------------

using RunLabel = std::uint16_t;
inline constexpr RunLabel no_label = 0xffff;

/// Pixels from first up to the next run's first, and the number of the component they belong to.
struct Run {
    std::uint16_t first = 0;
    RunLabel label = no_label;
};

/// Bytes of an arena that RunRow(arena, width) takes.
constexpr std::int64_t run_row_bytes(int width) {
    return arena_bytes<Run>(std::int64_t{width} + 1) +
           arena_bytes<detail::PixelWord>(width / detail::bits_pixels + 1);
}

inline namespace FOVEA_ISA {

/// The runs of one row, region and ground in turn. Holds no memory of its own.
class RunRow {
public:
    RunRow() = default;
    explicit RunRow(Span<Run> room) : runs_(room) {}
    /// With room for the runs of any row of this width and for its bits, with which label_runs() is faster.
    RunRow(Arena& arena, int width)
        : runs_(arena.take_unset<Run>(width + 1)),
          bits_(arena.take_unset<detail::PixelWord>(width / detail::bits_pixels + 1)) {}

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
    /// Whether bits() are there: of a restless row, with runs of fewer than 8 pixels in the mean.
    bool has_bits() const { return has_bits_; }
    /// Which pixels belong to regions, from the lowest bit on. Bits behind the last pixel are as its own.
    Span<detail::PixelWord> bits() const { return bits_; }

private:
    Status find_runs(const std::uint8_t* row, int width);
    void keep_bits(const std::uint8_t* row, int width);
    /// Behind the last run stands where it ends.
    Status close(int width);
    bool add_changes(detail::PixelWord changes, int x);

    Span<Run> runs_;
    Span<detail::PixelWord> bits_;
    int count_ = 0;
    bool starts_with_region_ = false;
    bool has_bits_ = false;
};

/// Gives every run of regions, or of the ground, the label of the runs above that it touches, or a new one.
/// reach is 1 where corners touch too, else 0. False if there is no label left.
///
/// Both rows are of one width; an empty row is above the first.
///
/// labels  find(label) answers what stands for a label today, merge(a, b) what stands from now on for two of
///         those, or for one; add(x) is a new label for a run that begins at x, or no_label
template <class Labels>
bool label_runs(const RunRow& above, const RunRow& here, bool regions, int reach, Labels&& labels);

}  // namespace FOVEA_ISA

// ---- Implementation ---------------------------------------------------------------

namespace detail {

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
    const Status status = find_runs(row, width);
    has_bits_ = status == Status::ok && count_ > width / 8 && !bits_.empty();
    if (has_bits_) keep_bits(row, width);
    return status;
}

inline Status RunRow::find_runs(const std::uint8_t* row, int width) {
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

// Not inline, so that calm rows pay nothing for it.
[[gnu::noinline]] inline void RunRow::keep_bits(const std::uint8_t* row, int width) {
    using namespace detail;
    PixelWord* bits = bits_.data();
    int x = 0;
    for (; x + bits_pixels <= width; x += bits_pixels) *bits++ = bits_of_pixels(row + x);
    if (x == width) return;
    const PixelWord behind = static_cast<PixelWord>(-1) << (width - x);
    *bits = bits_of_last(row, width, width - x) | (row[width - 1] != 0 ? behind : 0);
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

namespace detail {
inline namespace FOVEA_ISA {

/// From run to run: best where long ones meet as those of the row before did.
template <class Labels>
bool label_long_runs(const RunRow& above, const RunRow& here, bool regions, int reach, Labels& labels) {
    // Of the runs above, the first that may touch the next run here.
    int touched = above.first_of(regions);
    for (int i = here.first_of(regions); i < here.count(); i += 2) {
        const int first = here[i].first - reach;
        const int end = here.end(i) + reach;
        while (touched < above.count() && above.end(touched) <= first) touched += 2;
        RunLabel label = no_label;
        if (touched < above.count() && above[touched].first < end) {
            label = labels.find(above[touched].label);
            for (; touched + 2 < above.count() && above[touched + 2].first < end; touched += 2)
                label = labels.merge(label, labels.find(above[touched + 2].label));
        } else {
            label = labels.add(here[i].first);
            if (label == no_label) return false;
        }
        here[i].label = label;
    }
    return true;
}

/// Two runs that touch, by their numbers.
struct TouchingRuns {
    std::uint16_t above;
    std::uint16_t here;
};

/// Some pixels of a row: where runs begin, and where one that begins in the other row touches.
struct RunBits {
    PixelWord starts;
    PixelWord touched;
};
/// before is the last of the bits before, and becomes that of these.
inline RunBits run_bits(PixelWord bits, int reach, PixelWord& before) {
    const PixelWord shifted = bits << 1 | before;
    before = bits >> (bits_pixels - 1);
    return {bits & ~shifted, bits | (shifted & (0 - static_cast<PixelWord>(reach)))};
}

/// With bits: how short runs meet is random, and a processor that guesses wrong at every second question
/// loses more time than all else takes. What is still asked is rarely true. Not inline, so that calm rows pay
/// nothing for it.
template <class Labels>
[[gnu::noinline]] bool label_short_runs(const RunRow& above, const RunRow& here, bool regions, int reach,
                                        Labels& labels) {
    const PixelWord other = regions ? 0 : static_cast<PixelWord>(-1);
    PixelWord upper_before = 0;
    PixelWord lower_before = 0;
    unsigned upper_run = static_cast<unsigned>(above.first_of(regions) - 2);
    unsigned lower_run = static_cast<unsigned>(here.first_of(regions) - 2);
    const int words = (here.end(here.count() - 1) + bits_pixels - 1) / bits_pixels;
    for (int word = 0; word < words; ++word) {
        const RunBits upper = run_bits(above.bits()[word] ^ other, reach, upper_before);
        const RunBits lower = run_bits(here.bits()[word] ^ other, reach, lower_before);
        // Two runs touch where the later one begins.
        const PixelWord touching = (upper.starts & lower.touched) | (lower.starts & upper.touched);
        TouchingRuns found[bits_pixels];
        unsigned count = 0;
        for (PixelWord starts = upper.starts | lower.starts; starts != 0; starts &= starts - 1) {
            const int x = trailing_zeros(starts);
            upper_run += 2 * static_cast<unsigned>(upper.starts >> x & 1);
            lower_run += 2 * static_cast<unsigned>(lower.starts >> x & 1);
            found[count] = {static_cast<std::uint16_t>(upper_run), static_cast<std::uint16_t>(lower_run)};
            count += static_cast<unsigned>(touching >> x & 1);
        }
        for (unsigned i = 0; i < count; ++i) {
            const unsigned root = labels.find(above[found[i].above].label);
            RunLabel& label = here[found[i].here].label;
            // root in place of no_label, the largest number. Compilers make a branch of the plain question.
            const unsigned missing = 0 - ((label + 1u) >> 16);
            const unsigned own = label ^ ((label ^ root) & missing);
            label = static_cast<RunLabel>(own);
            if (own != root) label = labels.merge(label, static_cast<RunLabel>(root));
        }
    }
    for (int i = here.first_of(regions); i < here.count(); i += 2) {
        if (here[i].label != no_label) continue;
        here[i].label = labels.add(here[i].first);
        if (here[i].label == no_label) return false;
    }
    return true;
}

}  // namespace FOVEA_ISA
}  // namespace detail

inline namespace FOVEA_ISA {

template <class Labels>
bool label_runs(const RunRow& above, const RunRow& here, bool regions, int reach, Labels&& labels) {
    return above.has_bits() && here.has_bits() ? detail::label_short_runs(above, here, regions, reach, labels)
                                               : detail::label_long_runs(above, here, regions, reach, labels);
}

}  // namespace FOVEA_ISA
}  // namespace fovea
