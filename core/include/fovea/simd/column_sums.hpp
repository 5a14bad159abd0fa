// SPDX-License-Identifier: MIT
//
// Sums of the columns of a window that goes down row by row, and means of neighbouring sums that run along a
// row: box() without wide vectors.
#pragma once

#include <cstdint>
#include <cstring>

#include <fovea/simd/backend.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>

namespace fovea {
inline namespace FOVEA_ISA {
namespace simd {

// ---- Interface --------------------------------------------------------------------

/// remaining are the sums without the last row: makes those with it, and then remaining without the first.
inline void sum_columns(const std::uint8_t* first, const std::uint8_t* last, int width,
                        std::uint16_t* remaining, std::uint16_t* sums);

/// dst[x] is sum * reciprocal / 2^32, where sum gains entering[x] and loses leaving[x] before. Numbers are
/// below 2^15.
inline void running_means(const std::uint16_t* entering, const std::uint16_t* leaving, int width,
                          std::uint32_t sum, std::uint32_t reciprocal, std::uint8_t* dst);

// ---- Implementation ---------------------------------------------------------------

inline void sum_columns(const std::uint8_t* first, const std::uint8_t* last, int width,
                        std::uint16_t* remaining, std::uint16_t* sums) {
    int x = 0;
#if FOVEA_BYTES == 4 && defined(__ARM_FEATURE_SIMD32)
    for (; x + 4 <= width; x += 4) {
        const Words in(Bytes::load(last + x));
        const Words out(Bytes::load(first + x));
        const RawWords a = load_raw<RawWords>(remaining + x) + interleave_first(in.even, in.odd);
        const RawWords b = load_raw<RawWords>(remaining + x + 2) + interleave_second(in.even, in.odd);
        const RawWords with[2] = {a, b};
        const RawWords without[2] = {a - interleave_first(out.even, out.odd),
                                     b - interleave_second(out.even, out.odd)};
        std::memcpy(sums + x, with, sizeof with);
        std::memcpy(remaining + x, without, sizeof without);
    }
#endif
    for (; x < width; ++x) {
        const auto sum = static_cast<std::uint16_t>(remaining[x] + last[x]);
        sums[x] = sum;
        remaining[x] = static_cast<std::uint16_t>(sum - first[x]);
    }
}

inline void running_means(const std::uint16_t* entering, const std::uint16_t* leaving, int width,
                          std::uint32_t sum, std::uint32_t reciprocal, std::uint8_t* dst) {
    const auto mean = [&] { return static_cast<std::uint8_t>(std::uint64_t{sum} * reciprocal >> 32); };
    int x = 0;
#if FOVEA_BYTES == 4 && defined(__ARM_FEATURE_SIMD32)
    // Two columns in a word; their differences have 16 bits with the sign.
    const auto gain = [&](int at) {
        return static_cast<std::int32_t>(
            minus(load_raw<RawWords>(entering + at), load_raw<RawWords>(leaving + at)));
    };
    const auto lower = [](std::int32_t pair) {
        return static_cast<std::uint32_t>(static_cast<std::int16_t>(pair));
    };
    const auto upper = [](std::int32_t pair) { return static_cast<std::uint32_t>(pair >> 16); };
    for (; x + 4 <= width; x += 4) {
        const std::int32_t first = gain(x);
        const std::int32_t second = gain(x + 2);
        sum += big_endian_words ? upper(first) : lower(first);
        dst[x] = mean();
        sum += big_endian_words ? lower(first) : upper(first);
        dst[x + 1] = mean();
        sum += big_endian_words ? upper(second) : lower(second);
        dst[x + 2] = mean();
        sum += big_endian_words ? lower(second) : upper(second);
        dst[x + 3] = mean();
    }
#endif
    for (; x < width; ++x) {
        sum += entering[x];
        sum -= leaving[x];
        dst[x] = mean();
    }
}

}  // namespace simd
}  // namespace FOVEA_ISA
}  // namespace fovea
