// SPDX-License-Identifier: MIT
//
// Packets on a serial line: a mark between any two, a checksum in each. Whatever is lost or disturbed, the
// next whole packet is read.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/crc32.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The most bytes that a packet with so many bytes of content takes on the line.
constexpr std::ptrdiff_t packet_bytes(std::ptrdiff_t content) { return 2 * (content + 4) + 2; }

/// Writes a packet, and answers how many bytes it took.
///
/// Format  content and its CRC-32, low byte first, between two bytes 0xC0; in them 0xC0 is written as 0xDB
///         0xDC and 0xDB as 0xDB 0xDD
/// Errors  bad_argument without content; buffer_too_small below packet_bytes()
/// Source  framing of RFC 1055 (SLIP)
constexpr Result<std::ptrdiff_t> encode_packet(Span<const std::uint8_t> content, Span<std::uint8_t> out);

/// Finds the packets in what arrives, a byte at a time.
class PacketReader {
public:
    /// room for the longest content and 4 bytes more. It must outlive the reader.
    constexpr explicit PacketReader(Span<std::uint8_t> room) : room_(room) {}

    /// Takes a byte: true if it ends a packet, whose content() then holds until the next call.
    ///
    /// Errors  capacity_exceeded once for a packet that is too long for the room; malformed for one with a
    ///         wrong checksum, a wrong escape or fewer than 5 bytes. It is dropped, and the next one is read
    constexpr Result<bool> add(std::uint8_t byte);

    /// The last packet.
    constexpr Span<const std::uint8_t> content() const { return {room_.data(), content_}; }
    /// Right after capacity_exceeded: of the packet that is too long what had room, which no checksum proves.
    constexpr Span<const std::uint8_t> beginning() const { return room_; }
    /// True while a packet has begun that may still end well or be told of; not while one is skipped.
    constexpr bool in_packet() const { return size_ > 0 || escaped_ || wrong_; }
    /// Drops what has begun; until the next mark all is skipped.
    constexpr void drop();

private:
    constexpr Result<bool> end_packet();

    Span<std::uint8_t> room_;
    std::ptrdiff_t size_ = 0;
    std::ptrdiff_t content_ = 0;
    bool escaped_ = false;
    bool wrong_ = false;
    bool skipping_ = false;
};

// ---- Implementation ---------------------------------------------------------------

namespace detail {

inline constexpr std::uint8_t packet_mark = 0xC0, packet_escape = 0xDB, escaped_mark = 0xDC,
                              escaped_escape = 0xDD;
inline constexpr std::ptrdiff_t packet_sum = 4;

}  // namespace detail

constexpr Result<std::ptrdiff_t> encode_packet(Span<const std::uint8_t> content, Span<std::uint8_t> out) {
    if (content.empty()) return Status::bad_argument;
    if (out.size() < packet_bytes(content.size())) return Status::buffer_too_small;
    std::ptrdiff_t size = 0;
    const auto put = [&](std::uint8_t byte) {
        if (byte != detail::packet_mark && byte != detail::packet_escape) {
            out[size++] = byte;
            return;
        }
        out[size++] = detail::packet_escape;
        out[size++] = byte == detail::packet_mark ? detail::escaped_mark : detail::escaped_escape;
    };
    out[size++] = detail::packet_mark;
    const std::uint32_t sum = crc32(content);
    for (std::ptrdiff_t i = 0; i < content.size(); ++i) put(content[i]);
    for (int i = 0; i < 4; ++i) put(static_cast<std::uint8_t>(sum >> 8 * i));
    out[size++] = detail::packet_mark;
    return size;
}

constexpr void PacketReader::drop() {
    size_ = 0;
    escaped_ = wrong_ = false;
    skipping_ = true;
}

constexpr Result<bool> PacketReader::end_packet() {
    const std::ptrdiff_t size = size_;
    const bool wrong = wrong_ || escaped_;
    size_ = 0;
    escaped_ = wrong_ = skipping_ = false;
    if (size <= detail::packet_sum || wrong) return Status::malformed;
    content_ = size - detail::packet_sum;
    std::uint32_t sum = 0;
    for (int i = 0; i < 4; ++i) sum |= std::uint32_t{room_[content_ + i]} << 8 * i;
    if (crc32(content()) == sum) return true;
    content_ = 0;
    return Status::malformed;
}

constexpr Result<bool> PacketReader::add(std::uint8_t byte) {
    if (byte == detail::packet_mark) {
        // Between packets there may be any number of marks.
        if (in_packet()) return end_packet();
        skipping_ = false;
        return false;
    }
    if (skipping_) return false;
    if (byte == detail::packet_escape && !escaped_) {
        escaped_ = true;
        return false;
    }
    if (escaped_) {
        escaped_ = false;
        wrong_ = wrong_ || (byte != detail::escaped_mark && byte != detail::escaped_escape);
        byte = byte == detail::escaped_mark ? detail::packet_mark : detail::packet_escape;
    }
    if (size_ == room_.size()) {
        drop();
        return Status::capacity_exceeded;
    }
    // The packet before is no longer there.
    content_ = 0;
    room_[size_++] = byte;
    return false;
}

}  // namespace fovea
