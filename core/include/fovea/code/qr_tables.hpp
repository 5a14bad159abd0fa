// SPDX-License-Identifier: MIT
//
// Tables of QR codes, model 2: sizes, blocks, alignment patterns, and the two protected words that tell the
// format and the version. ISO/IEC 18004.
#pragma once

#include <cstdint>

#include <fovea/base/assert.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

inline constexpr int min_qr_version = 1;
inline constexpr int max_qr_version = 40;

/// Modules of a side: 21 to 177. Clause 6.3.1.
constexpr int qr_size(int version) { return 17 + 4 * version; }
inline constexpr int max_qr_size = qr_size(max_qr_version);

/// How much is repaired: about 7, 15, 25 and 30 % of the codewords.
enum class QrLevel : std::uint8_t { low, medium, quartile, high };

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Parity codewords of every block, and blocks, of versions 1 to 40. Clause 7.5.1, table 9.
inline constexpr std::uint8_t qr_block_parity[4][max_qr_version] = {
    {7,  10, 15, 20, 26, 18, 20, 24, 30, 18, 20, 24, 26, 30, 22, 24, 28, 30, 28, 28,
     28, 28, 30, 30, 26, 28, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30},
    {10, 16, 26, 18, 24, 16, 18, 22, 22, 26, 30, 22, 22, 24, 24, 28, 28, 26, 26, 26,
     26, 28, 28, 28, 28, 28, 28, 28, 28, 28, 28, 28, 28, 28, 28, 28, 28, 28, 28, 28},
    {13, 22, 18, 26, 18, 24, 18, 22, 20, 24, 28, 26, 24, 20, 30, 24, 28, 28, 26, 30,
     28, 30, 30, 30, 30, 28, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30},
    {17, 28, 22, 16, 22, 28, 26, 26, 24, 28, 24, 28, 22, 24, 24, 30, 28, 28, 26, 28,
     30, 24, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30},
};
inline constexpr std::uint8_t qr_block_count[4][max_qr_version] = {
    {1, 1, 1, 1,  1,  2,  2,  2,  2,  4,  4,  4,  4,  4,  6,  6,  6,  6,  7,  8,
     8, 9, 9, 10, 12, 12, 12, 13, 14, 15, 16, 17, 18, 19, 19, 20, 21, 22, 24, 25},
    {1,  1,  1,  2,  2,  4,  4,  4,  5,  5,  5,  8,  9,  9,  10, 10, 11, 13, 14, 16,
     17, 17, 18, 20, 21, 23, 25, 26, 28, 29, 31, 33, 35, 37, 38, 40, 43, 45, 47, 49},
    {1,  1,  2,  2,  4,  4,  6,  6,  8,  8,  8,  10, 12, 16, 12, 17, 16, 18, 21, 20,
     23, 23, 25, 27, 29, 34, 34, 35, 38, 40, 43, 45, 48, 51, 53, 56, 59, 62, 65, 68},
    {1,  1,  2,  4,  4,  4,  5,  6,  8,  8,  11, 11, 16, 16, 18, 16, 19, 21, 25, 25,
     25, 34, 30, 32, 35, 37, 40, 42, 45, 48, 51, 54, 57, 60, 63, 66, 70, 74, 77, 81},
};

/// Alignment patterns stand where two of these lines cross. Annex E, whose table follows from: the first line
/// 6, the last 7 before the edge, the others as far apart as even steps allow, which 32 alone departs from.
constexpr int qr_alignment_lines(int version) { return version == 1 ? 0 : version / 7 + 2; }
constexpr int qr_alignment_line(int version, int index) {
    const int lines = qr_alignment_lines(version);
    FOVEA_ASSERT(index >= 0 && index < lines);
    if (index == 0) return 6;
    const int step = version == 32 ? 26 : (version * 4 + lines * 2 + 1) / (lines * 2 - 2) * 2;
    return qr_size(version) - 7 - (lines - 1 - index) * step;
}
inline constexpr int max_qr_alignment_lines = qr_alignment_lines(max_qr_version);

/// Codewords of a symbol: 26 to 3706. The modules less those of the patterns and protected words, table 1.
constexpr int qr_codewords(int version) {
    const int lines = qr_alignment_lines(version);
    int modules = (16 * version + 128) * version + 64;
    if (lines > 0) modules -= (25 * lines - 10) * lines - 55;
    if (version >= 7) modules -= 36;
    return modules / 8;
}
inline constexpr int max_qr_codewords = qr_codewords(max_qr_version);

/// The blocks of a symbol: the first short_blocks hold short_data codewords of data, the others one more.
struct QrBlocks {
    int blocks;
    int short_blocks;
    int short_data;
    int parity;

    constexpr int data(int block) const { return short_data + (block < short_blocks ? 0 : 1); }
    constexpr int data_codewords() const { return blocks * short_data + (blocks - short_blocks); }
    /// Where a codeword of a block stands in the interleaved sequence. Clause 7.6.
    constexpr int place(int block, int index) const {
        if (index < short_data) return index * blocks + block;
        if (index < data(block)) return short_data * blocks + block - short_blocks;
        return data_codewords() + (index - data(block)) * blocks + block;
    }
};
constexpr QrBlocks qr_blocks(int version, QrLevel level) {
    const int row = static_cast<int>(level);
    const int blocks = qr_block_count[row][version - 1];
    const int parity = qr_block_parity[row][version - 1];
    const int codewords = qr_codewords(version);
    return {blocks, blocks - codewords % blocks, codewords / blocks - parity, parity};
}

/// Parity codewords that tell a wrong repair instead of repairing. Table 9, p.
constexpr int qr_misdecode_reserve(int version, QrLevel level) {
    if (version == 1) return level == QrLevel::low ? 3 : level == QrLevel::medium ? 2 : 1;
    if (level != QrLevel::low) return 0;
    return version == 2 ? 2 : version == 3 ? 1 : 0;
}

/// Bits that tell how many characters follow. Table 3; the columns are versions to 9, to 26, to 40.
enum class QrMode : std::uint8_t { numeric, alphanumeric, bytes, kanji };
inline constexpr std::uint8_t qr_count_bits[4][3] = {{10, 12, 14}, {9, 11, 13}, {8, 16, 16}, {8, 10, 12}};
constexpr int qr_version_class(int version) { return version <= 9 ? 0 : version <= 26 ? 1 : 2; }
constexpr int qr_count_bits_of(QrMode mode, int version) {
    return qr_count_bits[static_cast<int>(mode)][qr_version_class(version)];
}

/// The 45 characters of the alphanumeric mode in their order. Table 5.
inline constexpr char qr_alphanumeric[] = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ $%*+-./:";

constexpr int bit_count(unsigned bits) { return __builtin_popcount(bits); }

/// data with the remainder of its division by the generator behind it. Annexes C and D.
constexpr unsigned with_bch_parity(unsigned data, unsigned generator, int parity_bits) {
    unsigned rest = data << parity_bits;
    for (int bit = 31; bit >= parity_bits; --bit) {
        if ((rest >> bit & 1) != 0) rest ^= generator << (bit - parity_bits);
    }
    return data << parity_bits | rest;
}

/// The 15 bits of the format: two of the level, three of the mask, ten of parity, and a pattern over all, so
/// that they are never all light. Clause 7.9.1, table 12.
struct QrFormat {
    QrLevel level = QrLevel::low;
    int mask = 0;
};
constexpr unsigned qr_format_word(QrFormat format) {
    constexpr unsigned level_bits[4] = {1, 0, 3, 2};
    const unsigned data =
        level_bits[static_cast<int>(format.level)] << 3 | static_cast<unsigned>(format.mask);
    return with_bch_parity(data, 0x537, 10) ^ 0x5412;
}
/// Formats differ in 7 bits, versions in 8: three wrong bits are mended.
inline constexpr int most_wrong_word_bits = 3;

/// The nearest format, or -1 if more than three bits are wrong: level * 8 + mask.
constexpr int nearest_qr_format(unsigned word) {
    for (int i = 0; i < 32; ++i) {
        if (bit_count(qr_format_word({static_cast<QrLevel>(i / 8), i % 8}) ^ word) <= most_wrong_word_bits)
            return i;
    }
    return -1;
}
/// The 18 bits that versions 7 to 40 tell their number in. Clause 7.10.
constexpr unsigned qr_version_word(int version) {
    return with_bch_parity(static_cast<unsigned>(version), 0x1F25, 12);
}
inline constexpr int min_told_qr_version = 7;
/// The nearest version, or 0 if more than three bits are wrong.
constexpr int nearest_qr_version(unsigned word) {
    for (int version = min_told_qr_version; version <= max_qr_version; ++version) {
        if (bit_count(qr_version_word(version) ^ word) <= most_wrong_word_bits) return version;
    }
    return 0;
}

}  // namespace detail

}  // namespace fovea
