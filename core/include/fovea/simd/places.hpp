// SPDX-License-Identifier: MIT
//
// Places in a source image for a run of output pixels: along a straight line, along a slight curve, or from a
// map.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include <fovea/simd/backend.hpp>
#include <fovea/simd/isa.hpp>

namespace fovea {
inline namespace FOVEA_ISA {
namespace simd {

/// The output pixels of one run.
inline constexpr int run_length = 64;
/// The columns that curve_places() fills.
inline constexpr int curve_length = 16;

/// As x: there is no such place.
inline constexpr std::int32_t no_place = std::numeric_limits<std::int32_t>::min();

/// Places in 1/256 px. Whoever fills count of them may write up to the next multiple of 16.
struct PlaceRun {
    std::int32_t x[run_length];
    std::int32_t y[run_length];
};

/// How the places of a run lie.
enum class PlaceOrder : std::uint8_t {
    anywhere,
    along_a_line,  ///< one after the other on a straight line, to within half a pixel
};

#if FOVEA_BYTES >= 16
/// All bits of the lanes whose number has that bit.
template <class Wide>
[[gnu::always_inline]] inline Wide pair_marks(int bit) {
    constexpr std::uint64_t all = ~std::uint64_t{0};
    constexpr int pairs = sizeof(Wide) / 8;
    Wide marks{};
    for (int i = 0; i < pairs; ++i) marks[i] = (i & bit) != 0 ? all : 0;
    return marks;
}
#endif

/// The high words of start, start + step, ... rounded to the nearest, ties up; all of them must fit 64 bits.
inline void straight_places(std::int64_t start, std::int64_t step, int count, std::int32_t* to) {
    const std::uint64_t first = static_cast<std::uint64_t>(start) + (std::uint64_t{1} << 31);
    const auto by = static_cast<std::uint64_t>(step);
#if FOVEA_BYTES >= 16
    using Wide [[gnu::vector_size(FOVEA_BYTES)]] = std::uint64_t;
    constexpr int pairs = FOVEA_BYTES / 8;
    constexpr bool big_endian = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__;
    // Doubled up rather than written one by one and loaded, which would wait for the memory.
    Wide even = Wide{} + first;
    for (int i = 1; i < pairs; i *= 2) even += pair_marks<Wide>(i) & (by * static_cast<std::uint64_t>(2 * i));
    const Wide advance = Wide{} + by * (2 * pairs);
    const Wide high = Wide{} + (~std::uint64_t{0} << 32);
    for (int i = 0; i < count; i += 2 * pairs) {
        const Wide odd = even + by;
        // Two neighbours in one lane, the first one where memory begins.
        const Wide both = big_endian ? ((even & high) | (odd >> 32)) : ((even >> 32) | (odd & high));
        std::memcpy(to + i, &both, sizeof both);
        even += advance;
    }
#else
    std::uint64_t place = first;
    for (int i = 0; i < count; ++i, place += by)
        to[i] = static_cast<std::int32_t>(static_cast<std::uint32_t>(place >> 32));
#endif
}

inline constexpr std::int32_t count_up[curve_length] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

/// base + ((start + slope * i + bend * i * (16 - i)) >> bits) for i = 0..15; all must fit 32 bits.
inline void curve_places(std::int32_t base, std::int32_t start, std::int32_t slope, std::int32_t bend,
                         int bits, std::int32_t* to) {
#if FOVEA_BYTES >= 16
    using Ints [[gnu::vector_size(FOVEA_BYTES)]] = std::int32_t;
    constexpr int step = FOVEA_BYTES / 4;
    auto at = load_raw<Ints>(count_up);
    for (int i = 0; i < curve_length; i += step) {
        Ints sum = at * slope + start;
        // i * (16 - i) has 7 bits; a straight line spares the products.
        if (bend != 0) sum += at * (curve_length - at) * bend;
        const Ints place = base + (sum >> bits);
        std::memcpy(to + i, &place, sizeof place);
        at += step;
    }
#else
    for (int i = 0; i < curve_length; ++i)
        to[i] = base + ((start + slope * i + bend * (i * (curve_length - i))) >> bits);
#endif
}

/// x and y of count places that lie as pairs.
inline void split_places(const std::int32_t* pairs, int count, PlaceRun& run) {
    int i = 0;
#if FOVEA_BYTES >= 16
    using Ints [[gnu::vector_size(16)]] = std::int32_t;
    for (; i + 4 <= count; i += 4) {
        const auto a = load_raw<Ints>(pairs + 2 * i);
        const auto b = load_raw<Ints>(pairs + 2 * i + 4);
        const Ints x = __builtin_shufflevector(a, b, 0, 2, 4, 6);
        const Ints y = __builtin_shufflevector(a, b, 1, 3, 5, 7);
        std::memcpy(run.x + i, &x, sizeof x);
        std::memcpy(run.y + i, &y, sizeof y);
    }
#endif
    for (; i < count; ++i) {
        run.x[i] = pairs[2 * i];
        run.y[i] = pairs[2 * i + 1];
    }
}

/// The places x, x + 256, ... of count pixels of a row, each moved by a pair of offsets in units of 2^bits.
inline void offset_places(std::int32_t x, std::int32_t y, const std::int16_t* pairs, int bits, int count,
                          PlaceRun& run) {
    int i = 0;
#if FOVEA_BYTES >= 16
    using Ints [[gnu::vector_size(16)]] = std::int32_t;
    constexpr bool big_endian = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__;
    Ints column = {x, x + 256, x + 512, x + 768};
    for (; i + 4 <= count; i += 4) {
        const auto both = load_raw<Ints>(pairs + 2 * i);
        const Ints low = (both << 16) >> 16;
        const Ints high = both >> 16;
        const Ints to_x = column + ((big_endian ? high : low) << bits);
        const Ints to_y = y + ((big_endian ? low : high) << bits);
        std::memcpy(run.x + i, &to_x, sizeof to_x);
        std::memcpy(run.y + i, &to_y, sizeof to_y);
        column += 4 * 256;
    }
#endif
    for (; i < count; ++i) {
        run.x[i] = x + 256 * i + pairs[2 * i] * (1 << bits);
        run.y[i] = y + pairs[2 * i + 1] * (1 << bits);
    }
}

}  // namespace simd
}  // namespace FOVEA_ISA
}  // namespace fovea
