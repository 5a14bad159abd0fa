// SPDX-License-Identifier: MIT
//
// The 64 coefficients of one block, from entropy-coded bits. ITU-T T.81 F.2.2.
#pragma once

#include <cstdint>
#include <cstring>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/codec/jpeg_huffman.hpp>
#include <fovea/codec/jpeg_tables.hpp>

namespace fovea::jpeg {

// ---- Interface --------------------------------------------------------------------

/// Dequantised coefficients of a block, those of one vertical frequency in a row: the DCT coefficient of
/// horizontal frequency u and vertical frequency v is coefficient[8 * v + u].
struct Block {
    /// Those of 8-bit samples lie in -1024..1024. Rounded to whole steps they at most double, for half a step
    /// is the least that is rounded up.
    static constexpr int least = -2048;
    static constexpr int most = 2047;

    std::int16_t coefficient[64];
    int used;  ///< the positions of all coefficients that are not 0, joined by OR
};

/// The 64 steps of a component, in zigzag order.
struct Quantiser {
    std::uint16_t step[64];

    /// steps holds 64 bytes, or 128 for steps of two bytes.
    void build(Span<const std::uint8_t> steps);
};

/// Decodes and dequantises one block. dc is the quantised DC coefficient of the block before, and becomes
/// that of this one.
///
/// Errors  truncated or malformed as BitReader says if the bits end early; malformed for a word that is not
///         in the code, a coefficient behind the 63rd, one of more bits than 8-bit samples give, and one
///         beyond Block::least..most, which no picture of 8 bits has. The block is then undefined
/// Source  T.81 F.2.2.1, F.2.2.2, Tables F.1 and F.2
inline Status decode_block(BitReader& reader, const HuffmanTable& dc_code, const HuffmanTable& ac_code,
                           const Quantiser& quantiser, int& dc, Block& block);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// The longest values of 8-bit samples. T.81 Tables F.1 and F.2.
inline constexpr int max_dc_bits = 11;
inline constexpr int max_ac_bits = 10;

/// The value of 1 to 16 further bits: those below half of their range stand for negative numbers. T.81
/// figure F.12.
[[gnu::always_inline]] inline int extend(std::uint32_t further, int bits) {
    const int value = static_cast<int>(further);
    const int half = 1 << (bits - 1);
    // All ones for a negative difference: a branch here would be taken or not at random.
    return value + (((value - half) >> 31) & (1 - 2 * half));
}

/// How far a coefficient is above the least: joined by OR, these numbers tell without a branch for each
/// whether all coefficients are in range.
[[gnu::always_inline]] inline std::uint32_t above_least(int value) {
    return static_cast<std::uint32_t>(value - Block::least);
}
inline constexpr std::uint32_t full_range = Block::most - Block::least;
static_assert((full_range & (full_range + 1)) == 0, "an OR stays within a range of full bits");

}  // namespace detail

inline void Quantiser::build(Span<const std::uint8_t> steps) {
    const bool wide = steps.size() == 128;
    for (int k = 0; k < 64; ++k)
        step[k] = static_cast<std::uint16_t>(wide ? steps[2 * k] << 8 | steps[2 * k + 1] : steps[k]);
}

inline Status decode_block(BitReader& reader, const HuffmanTable& dc_code, const HuffmanTable& ac_code,
                           const Quantiser& quantiser, int& dc, Block& block) {
    BitReader bits = reader;  // a copy can live in registers
    const auto fault = [&] { return bits.overrun() ? bits.overrun_status() : Status::malformed; };
    std::memset(block.coefficient, 0, sizeof block.coefficient);

    bits.fill(max_code_bits);
    const int dc_bits = dc_code.decode(bits);
    if (dc_bits < 0 || dc_bits > detail::max_dc_bits) return fault();
    if (dc_bits > 0) {
        bits.fill(detail::max_dc_bits);
        dc += detail::extend(bits.peek(dc_bits), dc_bits);
        bits.skip(dc_bits);
    }
    // |dc| is below 2^12 after every block that passed, so the product is below 2^29.
    const int mean = dc * quantiser.step[0];
    block.coefficient[0] = static_cast<std::int16_t>(mean);
    std::uint32_t seen = detail::above_least(mean);
    int used = 0;

    for (int k = 1; k < 64; ++k) {
        bits.fill(max_code_bits);
        const int symbol = ac_code.decode(bits);
        if (symbol < 0) return fault();
        const int ac_bits = symbol & 15;
        k += symbol >> 4;
        if (ac_bits == 0) {
            if (symbol == 0) break;  // end of block
            // Sixteen zeros are the only other run without a value, and one must follow them.
            if (symbol != 0xf0 || k >= 63) return fault();
            continue;
        }
        if (k > 63 || ac_bits > detail::max_ac_bits) return fault();
        bits.fill(detail::max_ac_bits);
        const int value = detail::extend(bits.peek(ac_bits), ac_bits) * quantiser.step[k];
        bits.skip(ac_bits);
        const int position = zigzag[k];
        block.coefficient[position] = static_cast<std::int16_t>(value);
        used |= position;
        seen |= detail::above_least(value);
    }
    reader = bits;
    block.used = used;
    if (bits.overrun()) return bits.overrun_status();
    return seen <= detail::full_range ? Status::ok : Status::malformed;
}

}  // namespace fovea::jpeg
