// SPDX-License-Identifier: MIT
//
// CRC-32 of ISO 3309: of PNG chunks, of recipes in flash, and of every golden vector.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>

namespace fovea {

namespace detail {

inline constexpr std::uint32_t crc_of_half_byte[16] = {
    0x00000000, 0x1db71064, 0x3b6e20c8, 0x26d930ac, 0x76dc4190, 0x6b6b51f4, 0x4db26158, 0x5005713c,
    0xedb88320, 0xf00f9344, 0xd6d6a3e8, 0xcb61b38c, 0x9b64c2b0, 0x86d3d2d4, 0xa00ae278, 0xbdbdf21c};

constexpr std::uint32_t crc_after_byte(std::uint32_t state) {
    state = crc_of_half_byte[state & 15] ^ state >> 4;
    return crc_of_half_byte[state & 15] ^ state >> 4;
}

/// followed_by[k][b]: what a byte b does to the state when k other bytes follow it.
struct CrcTables {
    std::uint32_t followed_by[4][256];
};
constexpr CrcTables make_crc_tables() {
    CrcTables tables{};
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
        std::uint32_t state = byte;
        for (auto& table : tables.followed_by) {
            state = crc_after_byte(state);
            table[byte] = state;
        }
    }
    return tables;
}
inline constexpr CrcTables crc_tables = make_crc_tables();

}  // namespace detail

/// Running CRC-32. Feed bytes in any number of pieces, then ask for the value.
///
/// Units   reflected polynomial 0xEDB88320, start and end value all ones; "123456789" gives 0xCBF43926
/// Memory  constant: a table of 16 words, half a byte a step, for chips that cannot spare 1 KiB; on 64-bit
///         processors four of 256 words, four bytes a step
/// Source  ISO 3309 / ITU-T V.42 8.1.1.6.2
class Crc32 {
public:
    constexpr void add(std::uint8_t byte) { state_ = detail::crc_after_byte(state_ ^ byte); }
    constexpr void add(Span<const std::uint8_t> bytes) {
        std::ptrdiff_t i = 0;
        if constexpr (sizeof(void*) >= 8)
            for (; i + 4 <= bytes.size(); i += 4) add_four(bytes.data() + i);
        for (; i < bytes.size(); ++i) add(bytes[i]);
    }
    constexpr std::uint32_t value() const { return ~state_; }

private:
    constexpr void add_four(const std::uint8_t* bytes) {
        const auto& tables = detail::crc_tables.followed_by;
        state_ = tables[3][(state_ ^ bytes[0]) & 255] ^ tables[2][(state_ >> 8 ^ bytes[1]) & 255] ^
                 tables[1][(state_ >> 16 ^ bytes[2]) & 255] ^ tables[0][state_ >> 24 ^ bytes[3]];
    }

    std::uint32_t state_ = 0xffffffff;
};

constexpr std::uint32_t crc32(Span<const std::uint8_t> bytes) {
    Crc32 crc;
    crc.add(bytes);
    return crc.value();
}

}  // namespace fovea
