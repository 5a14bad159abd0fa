// SPDX-License-Identifier: MIT
//
// What a machine checks a record by.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>

#include <daemon/text_buffer.hpp>

namespace fovea::apps {

/// What a PLC checks: all bytes in front, without the STX that begins a frame.
inline Span<const std::uint8_t> checked_bytes(const TextBuffer& line) {
    const Span<const std::uint8_t> bytes = line.bytes();
    return !bytes.empty() && bytes[0] == 2 ? bytes.from(1) : bytes;
}

/// CRC-16/CCITT-FALSE: polynomial 0x1021, begun with ones, most significant bit first.
constexpr std::uint32_t crc16_of(Span<const std::uint8_t> bytes) {
    std::uint32_t crc = 0xffff;
    for (const std::uint8_t byte : bytes) {
        crc ^= std::uint32_t{byte} << 8;
        for (int bit = 0; bit < 8; ++bit)
            crc = (crc & 0x8000u) != 0 ? (crc << 1 ^ 0x1021u) & 0xffffu : crc << 1;
    }
    return crc;
}

}  // namespace fovea::apps
