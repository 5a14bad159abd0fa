// SPDX-License-Identifier: MIT
//
// CRC-32 of ISO 3309: of PNG chunks, of recipes in flash, and of every golden vector.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>

namespace fovea {

/// Running CRC-32. Feed bytes in any number of pieces, then ask for the value.
///
/// Units   reflected polynomial 0xEDB88320, start and end value all ones; "123456789" gives 0xCBF43926
/// Memory  a table of 16 words: half a byte a step, for chips that cannot spare 1 KiB
/// Source  ISO 3309 / ITU-T V.42 8.1.1.6.2
class Crc32 {
public:
    constexpr void add(std::uint8_t byte) {
        state_ ^= byte;
        state_ = table[state_ & 15] ^ state_ >> 4;
        state_ = table[state_ & 15] ^ state_ >> 4;
    }
    constexpr void add(Span<const std::uint8_t> bytes) {
        for (const std::uint8_t byte : bytes) add(byte);
    }
    constexpr std::uint32_t value() const { return ~state_; }

private:
    static constexpr std::uint32_t table[16] = {
        0x00000000, 0x1db71064, 0x3b6e20c8, 0x26d930ac, 0x76dc4190, 0x6b6b51f4, 0x4db26158, 0x5005713c,
        0xedb88320, 0xf00f9344, 0xd6d6a3e8, 0xcb61b38c, 0x9b64c2b0, 0x86d3d2d4, 0xa00ae278, 0xbdbdf21c};
    std::uint32_t state_ = 0xffffffff;
};

constexpr std::uint32_t crc32(Span<const std::uint8_t> bytes) {
    Crc32 crc;
    crc.add(bytes);
    return crc.value();
}

}  // namespace fovea
