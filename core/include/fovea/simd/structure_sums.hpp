// SPDX-License-Identifier: MIT
//
// StructureSums: the structure tensor of a row of 8-bit pixels: sums over 3x3 places of the squares and the
// product of the differences across and down.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

#include <fovea/base/span.hpp>
#include <fovea/simd/backend.hpp>
#include <fovea/simd/cells.hpp>
#include <fovea/simd/halves.hpp>
#include <fovea/simd/isa.hpp>

namespace fovea {
inline namespace FOVEA_ISA {
namespace simd {

// ---- Interface --------------------------------------------------------------------

/// With p the pixel to the right less that to the left and q that below less that above, the sums of p * p, q
/// * q and p * q over 3x3 places, of 32 bits: at most 9 * 255 * 255.
class StructureSums {
public:
    /// Numbers of 32 bits that it works in.
    static constexpr std::int64_t room(int width);

    StructureSums() = default;
    /// room holds room(width) numbers that are 0.
    StructureSums(Span<std::int32_t> room, int width);

    /// Joins five rows, each of which may be read from column -3 to width + lanes.
    void down(const std::uint8_t* const (&rows)[5]);
    /// dst[x] = formula(pp, qq, pq) for every column, with numbers or vectors of them.
    template <class Formula>
    void across(Formula formula, std::int32_t* dst) const;

private:
    static constexpr int quantities = 3;

#if FOVEA_BYTES >= 16
    /// Columns -2, 0, 2 ... of a quantity, and columns -1, 1, 3 ...
    static constexpr int planes = 2;
    static constexpr std::int64_t plane(int width) { return width / 2 + 2 + 2 * places; }
#else
    /// Columns -1, 0, 1 ...
    static constexpr int planes = 1;
    static constexpr std::int64_t plane(int width) { return width + 2; }
#endif
    std::int32_t* even(int quantity) const { return first_ + quantity * planes * plane(width_); }
    std::int32_t* odd(int quantity) const { return even(quantity) + plane(width_); }

    std::int32_t* first_ = nullptr;
    int width_ = 0;
};

// ---- Implementation ---------------------------------------------------------------

constexpr std::int64_t StructureSums::room(int width) { return quantities * planes * plane(width); }

inline StructureSums::StructureSums(Span<std::int32_t> room, int width)
    : first_(room.data()), width_(width) {}

#if FOVEA_BYTES >= 16

/// Words a of one row and b of the next as pairs: those of even columns, those of odd ones.
struct RowPairs {
    Ints even;
    Ints odd;

    [[gnu::always_inline]] static RowPairs of(RawWords a, RawWords b) {
        const auto x = bits_as<Unsigned>(a);
        const auto y = bits_as<Unsigned>(b);
        const auto low = bits_as<Ints>((x & 0xffff) | (y << 16));
        const auto high = bits_as<Ints>((x >> 16) | (y & 0xffff0000u));
        constexpr bool big_endian = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__;
        return big_endian ? RowPairs{high, low} : RowPairs{low, high};
    }
};

template <int... I>
[[gnu::always_inline]] inline void store_alternating(Ints even, Ints odd, std::int32_t* to,
                                                     std::integer_sequence<int, I...>) {
    constexpr int count = static_cast<int>(sizeof...(I));
    store_ints(__builtin_shufflevector(even, odd, (I / 2 + I % 2 * count)...), to);
    store_ints(__builtin_shufflevector(even, odd, (count / 2 + I / 2 + I % 2 * count)...), to + count);
}

inline void StructureSums::down(const std::uint8_t* const (&rows)[5]) {
    std::int32_t* const to[2 * quantities] = {even(0), odd(0), even(1), odd(1), even(2), odd(2)};
    const std::uint8_t* const from[5] = {rows[0], rows[1], rows[2], rows[3], rows[4]};
    const RawWords none{};
    for (int x = -2; x <= width_; x += half_lanes) {
        const auto right = [&](int row) { return widened(from[row] + x + 1) - widened(from[row] + x - 1); };
        const RawWords middle[5] = {widened(from[0] + x), widened(from[1] + x), widened(from[2] + x),
                                    widened(from[3] + x), widened(from[4] + x)};
        const RowPairs p = RowPairs::of(right(1), right(2));
        const RowPairs q = RowPairs::of(middle[2] - middle[0], middle[3] - middle[1]);
        const RowPairs last_p = RowPairs::of(right(3), none);
        const RowPairs last_q = RowPairs::of(middle[4] - middle[2], none);
        const int at = (x + 2) / 2;
        const auto put = [&](int number, const RowPairs& a, const RowPairs& b, const RowPairs& c,
                             const RowPairs& d) {
            store_ints(pair_sums(a.even, b.even) + pair_sums(c.even, d.even), to[number] + at);
            store_ints(pair_sums(a.odd, b.odd) + pair_sums(c.odd, d.odd), to[number + 1] + at);
        };
        put(0, p, p, last_p, last_p);
        put(2, q, q, last_q, last_q);
        put(4, p, q, last_p, last_q);
    }
}

template <class Formula>
void StructureSums::across(Formula formula, std::int32_t* dst) const {
    const std::int32_t* const from[2 * quantities] = {even(0), odd(0), even(1), odd(1), even(2), odd(2)};
    constexpr auto lanes_of = std::make_integer_sequence<int, places>();
    for (int m = 0; 2 * m < width_; m += places) {
        Ints even_sums[quantities];
        Ints odd_sums[quantities];
        for (int i = 0; i < quantities; ++i) {
            const std::int32_t* evens = from[2 * i] + m;
            const std::int32_t* odds = from[2 * i + 1] + m;
            const Ints both = load_ints(evens + 1) + load_ints(odds + 1);
            even_sums[i] = load_ints(odds) + both;
            odd_sums[i] = both + load_ints(evens + 2);
        }
        const Ints even_result = formula(even_sums[0], even_sums[1], even_sums[2]);
        const Ints odd_result = formula(odd_sums[0], odd_sums[1], odd_sums[2]);
        if (2 * (m + places) <= width_) {
            store_alternating(even_result, odd_result, dst + 2 * m, lanes_of);
        } else {
            std::int32_t results[2 * places];
            store_alternating(even_result, odd_result, results, lanes_of);
            std::memcpy(dst + 2 * m, results,
                        sizeof(std::int32_t) * static_cast<std::size_t>(width_ - 2 * m));
        }
    }
}

#else

inline void StructureSums::down(const std::uint8_t* const (&rows)[5]) {
    std::int32_t* const to[quantities] = {even(0), even(1), even(2)};
    for (int x = -1; x <= width_; ++x) {
        std::int32_t sums[quantities] = {};
        for (int row = 1; row <= 3; ++row) {
            const int p = rows[row][x + 1] - rows[row][x - 1];
            const int q = rows[row + 1][x] - rows[row - 1][x];
            sums[0] += p * p;
            sums[1] += q * q;
            sums[2] += p * q;
        }
        for (int i = 0; i < quantities; ++i) to[i][x + 1] = sums[i];
    }
}

template <class Formula>
void StructureSums::across(Formula formula, std::int32_t* dst) const {
    const std::int32_t* const from[quantities] = {even(0), even(1), even(2)};
    for (int x = 0; x < width_; ++x) {
        const auto sum = [&](int i) { return from[i][x] + from[i][x + 1] + from[i][x + 2]; };
        dst[x] = formula(sum(0), sum(1), sum(2));
    }
}

#endif

}  // namespace simd
}  // namespace FOVEA_ISA
}  // namespace fovea
