// SPDX-License-Identifier: MIT
//
// Lines: scratch rows with a border on both sides, where a filter keeps what down() made for across().
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/base/assert.hpp>
#include <fovea/base/span.hpp>
#include <fovea/simd/backend.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>
#include <fovea/simd/unroll.hpp>

namespace fovea {

/// The farthest a filter may look to either side in its lines.
inline constexpr int max_reach = 32;

inline namespace FOVEA_ISA {

/// Bytes of scratch that one line of byte pixels needs: the row, the reach on both sides, and a vector's
/// overhang.
constexpr int byte_line_scratch(int width) { return width + 2 * max_reach + simd::lanes; }

/// The same for a line of 16-bit numbers: two planes of half the columns.
constexpr int word_line_scratch(int width) {
    return 2 * ((width + 2 * max_reach + 2 * simd::lanes + 1) / 2 * 2);
}

namespace simd {

/// One row of pixels in the caller's scratch. at(x) may be asked for columns -max_reach to width - 1 +
/// max_reach.
class ByteLine {
public:
    ByteLine() = default;
    /// scratch holds byte_line_scratch(width) bytes.
    ByteLine(Span<std::uint8_t> scratch, int width) : first_(scratch.data() + max_reach) {
        FOVEA_ASSERT(scratch.size() >= byte_line_scratch(width));
        static_cast<void>(width);
    }
    [[gnu::always_inline]] void put(int x, Bytes pixels) { pixels.store(first_ + x); }
    [[gnu::always_inline]] Bytes at(int x) const { return Bytes::load(first_ + x); }

    std::uint8_t value(int x) const { return first_[x]; }
    void set(int x, std::uint8_t value) { first_[x] = value; }

    /// Repeats the outermost of width pixels reach times on either side.
    void replicate(int width, int reach) {
        std::memset(first_ - reach, first_[0], static_cast<std::size_t>(reach));
        std::memset(first_ + width, first_[width - 1], static_cast<std::size_t>(reach));
    }
    /// The pixel of column 0; as far as at() reaches, its neighbours may be read and written too.
    std::uint8_t* pixels() const { return first_; }

private:
    std::uint8_t* first_ = nullptr;
};

/// One row of numbers of 16 bits, even and odd columns in a plane each. at(x + s) is wanted for even x alone,
/// s from -max_reach to max_reach.
class WordLine {
public:
    WordLine() = default;
    /// scratch holds word_line_scratch(width) bytes, of any alignment.
    WordLine(Span<std::uint8_t> scratch, int width) {
        FOVEA_ASSERT(scratch.size() >= word_line_scratch(width));
        even_ = scratch.data() + max_reach;
        odd_ = even_ + word_line_scratch(width) / 2;
    }
    [[gnu::always_inline]] void put(int x, Words words) {
        std::memcpy(even_ + x, &words.even, sizeof words.even);
        std::memcpy(odd_ + x, &words.odd, sizeof words.odd);
    }
    /// The numbers from column x + shift on; x even.
    template <int Shift>
    [[gnu::always_inline]] Words at(int x) const {
        if constexpr (Shift % 2 == 0)
            return {raw(even_ + x + Shift), raw(odd_ + x + Shift)};
        else
            return {raw(odd_ + x + Shift - 1), raw(even_ + x + Shift + 1)};
    }
    /// The same where the shift is not a constant.
    [[gnu::always_inline]] Words at(int x, int shift) const {
        if ((shift & 1) == 0) return {raw(even_ + x + shift), raw(odd_ + x + shift)};
        return {raw(odd_ + x + shift - 1), raw(even_ + x + shift + 1)};
    }
    std::uint16_t value(int x) const {
        std::uint16_t value;
        std::memcpy(&value, place(x), sizeof value);
        return value;
    }
    void set(int x, std::uint16_t value) { std::memcpy(place(x), &value, sizeof value); }

private:
    // Column x of its plane lies at byte 2 * (x / 2), which is x or x - 1.
    [[gnu::always_inline]] static RawWords raw(const std::uint8_t* from) { return load_raw<RawWords>(from); }
    std::uint8_t* place(int x) const { return (x & 1 ? odd_ - 1 : even_) + x; }

    std::uint8_t* even_ = nullptr;
    std::uint8_t* odd_ = nullptr;
};

/// Calls visit(x, count) for every vector of a row from column x on: count is lanes but for the last, partial
/// one.
template <class Visit>
[[gnu::always_inline]] inline void for_each_vector(int width, Visit visit, int x = 0) {
    for (; x + lanes <= width; x += lanes) visit(x, lanes);
    if (x < width) visit(x, width - x);
}

/// Makes words of a row from those of another where one instruction takes two of them, which lie at multiples
/// of 4, and returns the columns done: up to 63 are left; all on other processors, and where size matters.
template <class Operation>
[[gnu::always_inline]] inline int make_pairs([[maybe_unused]] const std::uint8_t* src,
                                             [[maybe_unused]] int width, [[maybe_unused]] Operation op,
                                             [[maybe_unused]] std::uint8_t* dst) {
    int x = 0;
#if FOVEA_BYTES == 4 && defined(__thumb2__) && !defined(__OPTIMIZE_SIZE__)
    using Word [[gnu::may_alias]] = std::uint32_t;
    if (((reinterpret_cast<std::uintptr_t>(src) | reinterpret_cast<std::uintptr_t>(dst)) & 3) != 0) return 0;
    for (; x + 64 <= width; x += 64)
        unroll<8>([&](auto i) {
            const Word* from = reinterpret_cast<const Word*>(src + x) + 2 * i;
            Word* to = reinterpret_cast<Word*>(dst + x) + 2 * i;
            const Bytes first{from[0]};
            const Bytes second{from[1]};
            to[0] = op(first).raw;
            to[1] = op(second).raw;
        });
#endif
    return x;
}

}  // namespace simd
}  // namespace FOVEA_ISA
}  // namespace fovea
