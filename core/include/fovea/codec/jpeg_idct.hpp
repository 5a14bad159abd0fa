// SPDX-License-Identifier: MIT
//
// The inverse discrete cosine transform of 8 x 8 blocks, in integers. ITU-T T.81 A.3.3.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include <fovea/codec/jpeg_block.hpp>
#include <fovea/number/integer.hpp>

namespace fovea::jpeg {

// ---- Interface --------------------------------------------------------------------

/// Turns coefficients into 8 rows of 8 samples, stride_bytes apart, 128 added and held at 0..255.
///
/// Rounding  to the nearest after the columns, at 1/4 of their unit, and after the rows; ties up. The
///           samples meet the bounds of IEEE 1180-1990
/// Source    T.81 A.3.3. The factors are those of Loeffler, Ligtenberg and Moschytz, "Practical Fast 1-D DCT
///           Algorithms with 11 Multiplications", 1989, at 13 bits and multiplied out, so that the samples
///           equal those of the widespread decoders that take the algorithm in its factored form
inline void inverse_dct(const Block& block, std::uint8_t* dst, std::ptrdiff_t stride_bytes);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

// The share of every frequency in the halves of a sample, in 1/2^13: dct_odd[i][j] that of frequency 2 j + 1
// in the odd half of sample i, dct_even those of the frequencies 2 and 6 in the even halves. They are the
// cosines sqrt(2) cos(k pi / 16), up to a unit beside the nearest number, because the factored algorithm
// rounds its factors and these are sums of them.
inline constexpr int dct_bits = 13;
inline constexpr std::int16_t dct_odd[4][4] = {{11363, 9633, 6437, 2260},
                                               {9633, -2259, -11362, -6436},
                                               {6437, -11362, 2261, 9633},
                                               {2260, -6436, 9633, -11363}};
inline constexpr std::int16_t dct_even[2][2] = {{10703, 4433}, {4433, -10704}};

/// The halves of eight samples from Inputs frequencies, the others being 0: sample i < 4 is even[i] + odd[i],
/// sample 7 - i is even[i] - odd[i]. All times 2^13, bias added.
///
/// No sum leaves 32 bits, whatever the inputs of 16 bits: see dct_largest.
template <int Inputs, int Step>
[[gnu::always_inline]] inline void dct_halves(const std::int16_t* in, std::int32_t bias, std::int32_t* even,
                                              std::int32_t* odd) {
    static_assert(Inputs == 4 || Inputs == 8, "half or all of the frequencies");
    const auto at = [&](int i) -> std::int32_t { return i < Inputs ? in[i * Step] : 0; };
    const std::int32_t sum = ((at(0) + at(4)) * (1 << dct_bits)) + bias;
    const std::int32_t difference = ((at(0) - at(4)) * (1 << dct_bits)) + bias;
    const std::int32_t outer = dct_even[0][0] * at(2) + dct_even[0][1] * at(6);
    const std::int32_t inner = dct_even[1][0] * at(2) + dct_even[1][1] * at(6);
    even[0] = sum + outer;
    even[1] = difference + inner;
    even[2] = difference - inner;
    even[3] = sum - outer;
    for (int i = 0; i < 4; ++i) {
        odd[i] = dct_odd[i][0] * at(1) + dct_odd[i][1] * at(3);
        if (Inputs == 8) odd[i] += dct_odd[i][2] * at(5) + dct_odd[i][3] * at(7);
    }
}

inline constexpr int column_shift = dct_bits - 2;  // two bits more than a sample survive the columns
inline constexpr int row_shift = dct_bits + 2 + 3;
inline constexpr std::int32_t row_bias = (128 << row_shift) + (1 << (row_shift - 1));

// Two frequencies of factor 2^13, and the largest of the others, all times -2^15; then the bias.
inline constexpr std::int64_t dct_largest =
    (2 * 8192 + 10703 + 4433 + 11363 + 9633 + 6437 + 2260) * std::int64_t{32768} + row_bias;
static_assert(dct_largest <= std::numeric_limits<std::int32_t>::max(), "the sums of a row fit 32 bits");

/// The columns of a block with coefficients in its first Rows rows and Columns columns only.
template <int Rows, int Columns>
inline void dct_columns(const std::int16_t* coefficient, std::int16_t* work) {
    for (int x = 0; x < Columns; ++x) {
        std::int32_t even[4];
        std::int32_t odd[4];
        dct_halves<Rows, 8>(coefficient + x, 1 << (column_shift - 1), even, odd);
        // No encoder makes a block whose columns leave 16 bits; of one that does, the value wraps.
        for (int i = 0; i < 4; ++i) {
            work[8 * i + x] = static_cast<std::int16_t>((even[i] + odd[i]) >> column_shift);
            work[8 * (7 - i) + x] = static_cast<std::int16_t>((even[i] - odd[i]) >> column_shift);
        }
    }
}

/// The rows, in place: samples before they are held at 0..255, below 2^31 / 2^row_shift = 2^13 in magnitude.
/// Inlined because GCC 12 for s390x at -O2 takes it for a function that stores nothing, and drops the call.
template <int Columns>
[[gnu::always_inline]] inline void dct_rows(std::int16_t* work) {
    for (int y = 0; y < 8; ++y, work += 8) {
        std::int32_t even[4];
        std::int32_t odd[4];
        dct_halves<Columns, 1>(work, row_bias, even, odd);
        for (int i = 0; i < 4; ++i) {
            work[i] = static_cast<std::int16_t>((even[i] + odd[i]) >> row_shift);
            work[7 - i] = static_cast<std::int16_t>((even[i] - odd[i]) >> row_shift);
        }
    }
}

}  // namespace detail

inline void inverse_dct(const Block& block, std::uint8_t* dst, std::ptrdiff_t stride_bytes) {
    // Positions are 8 * row + column, so these bits are set in block.used by the high rows and columns.
    constexpr int high_rows = 32;
    constexpr int high_columns = 4;
    std::int16_t work[64];
    if (block.used == 0) {
        const auto sample = saturate_cast<std::uint8_t>(round_shift(block.coefficient[0] + 8 * 128, 3));
        for (int y = 0; y < 8; ++y, dst += stride_bytes)
            for (int x = 0; x < 8; ++x) dst[x] = sample;
        return;
    }
    if ((block.used & (high_rows | high_columns)) == 0)
        detail::dct_columns<4, 4>(block.coefficient, work);
    else if ((block.used & high_columns) == 0)
        detail::dct_columns<8, 4>(block.coefficient, work);
    else if ((block.used & high_rows) == 0)
        detail::dct_columns<4, 8>(block.coefficient, work);
    else
        detail::dct_columns<8, 8>(block.coefficient, work);
    if ((block.used & high_columns) == 0)
        detail::dct_rows<4>(work);
    else
        detail::dct_rows<8>(work);
    for (int y = 0; y < 8; ++y, dst += stride_bytes)
        for (int x = 0; x < 8; ++x)
            dst[x] = static_cast<std::uint8_t>(clamp<std::int16_t>(work[8 * y + x], 0, 255));
}

}  // namespace fovea::jpeg
