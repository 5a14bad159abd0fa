// SPDX-License-Identifier: MIT
//
// What reading and writing the zlib format share: its checksum, the tables of deflate, and 16-bit numbers in
// plain bytes.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/assert.hpp>
#include <fovea/base/span.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Running Adler-32. Feed bytes in any number of pieces, then ask for the value.
///
/// Units   "Wikipedia" gives 0x11E60398
/// Source  RFC 1950 sec. 8.2
class Adler32 {
public:
    constexpr void add(Span<const std::uint8_t> bytes);
    constexpr std::uint32_t value() const { return second_ << 16 | first_; }

private:
    std::uint32_t first_ = 1;
    std::uint32_t second_ = 0;
};

/// 16-bit numbers in bytes of any alignment, the lower byte first.
class PackedNumbers {
public:
    constexpr PackedNumbers() = default;
    constexpr explicit PackedNumbers(std::uint8_t* bytes) : bytes_(bytes) {}

    constexpr std::uint32_t operator[](std::ptrdiff_t index) const {
        const std::uint8_t* at = bytes_ + 2 * index;
        return static_cast<std::uint32_t>(at[0] | at[1] << 8);
    }
    constexpr void put(std::ptrdiff_t index, std::uint32_t number) const {
        std::uint8_t* at = bytes_ + 2 * index;
        at[0] = static_cast<std::uint8_t>(number & 0xff);
        at[1] = static_cast<std::uint8_t>(number >> 8 & 0xff);
    }
    constexpr std::uint8_t* bytes() const { return bytes_; }

private:
    std::uint8_t* bytes_ = nullptr;
};

/// The alphabets and limits of deflate.
///
/// Source  RFC 1951 sec. 3.2.5 to 3.2.7
struct Deflate {
    static constexpr int window_bytes = 32768;
    static constexpr int shortest_match = 3;
    static constexpr int longest_match = 258;
    static constexpr int longest_code = 15;

    static constexpr int end_of_block = 256;
    static constexpr int literals = 286;        ///< symbols of bytes, end of block and lengths
    static constexpr int fixed_literals = 288;  ///< the same in the fixed code, two of them never used
    static constexpr int distances = 30;
    static constexpr int fixed_distances = 32;
    static constexpr int length_codes = 29;   ///< symbols above end_of_block, each a range of match lengths
    static constexpr int order_symbols = 19;  ///< of the code that sends code lengths

    /// The least length less shortest_match, the least distance less 1, and how many bits tell the rest.
    static constexpr std::uint8_t length_base[29] = {0,  1,  2,  3,   4,   5,   6,   7,   8,  10,
                                                     12, 14, 16, 20,  24,  28,  32,  40,  48, 56,
                                                     64, 80, 96, 112, 128, 160, 192, 224, 255};
    static constexpr std::uint8_t length_bits[29] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2,
                                                     2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0};
    static constexpr std::uint16_t distance_base[30] = {
        0,   1,   2,   3,   4,   6,    8,    12,   16,   24,   32,   48,   64,    96,    128,
        192, 256, 384, 512, 768, 1024, 1536, 2048, 3072, 4096, 6144, 8192, 12288, 16384, 24576};
    static constexpr int distance_bits(int symbol) { return symbol < 2 ? 0 : symbol / 2 - 1; }

    /// Of a length less shortest_match, and of a distance less 1: the symbol whose range it falls into,
    /// counted from 0.
    static constexpr int length_symbol(int length) {
        if (length < 8) return length;
        if (length == longest_match - shortest_match) return length_codes - 1;
        const int power = 31 - leading_zeros(static_cast<std::uint32_t>(length));
        return 4 * (power - 1) + (length >> (power - 2) & 3);
    }
    static constexpr int distance_symbol(int distance) {
        if (distance < 2) return distance;
        const int power = 31 - leading_zeros(static_cast<std::uint32_t>(distance));
        return 2 * power + (distance >> (power - 1) & 1);
    }

    /// The order in which the lengths of the code for code lengths are sent.
    static constexpr std::uint8_t order[19] = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                               11, 4,  12, 3, 13, 2, 14, 1, 15};

    static constexpr int fixed_literal_length(int symbol) {
        return symbol < 144 ? 8 : symbol < 256 ? 9 : symbol < 280 ? 7 : 8;
    }
    static constexpr int fixed_distance_length = 5;
};

// ---- Implementation ---------------------------------------------------------------

constexpr void Adler32::add(Span<const std::uint8_t> bytes) {
    constexpr std::uint32_t modulus = 65521;
    // The longest run whose second sum, 255 * n * (n + 1) / 2 + (n + 1) * 65520, still fits 32 bits.
    constexpr std::ptrdiff_t longest_run = 5552;
    std::uint32_t first = first_;
    std::uint32_t second = second_;
    for (std::ptrdiff_t at = 0; at < bytes.size();) {
        const std::ptrdiff_t end = minimum(bytes.size(), at + longest_run);
        for (; at < end; ++at) {
            first += bytes[at];
            second += first;
        }
        first %= modulus;
        second %= modulus;
    }
    first_ = first;
    second_ = second;
}

}  // namespace fovea
