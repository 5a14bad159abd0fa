// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/codec/packet.hpp>

namespace fovea::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

Span<const std::uint8_t> span(const Bytes& bytes) {
    return {bytes.data(), static_cast<std::ptrdiff_t>(bytes.size())};
}

Bytes packed(const Bytes& content) {
    Bytes line(static_cast<std::size_t>(packet_bytes(static_cast<std::ptrdiff_t>(content.size()))));
    const Result<std::ptrdiff_t> size =
        encode_packet(span(content), {line.data(), static_cast<std::ptrdiff_t>(line.size())});
    EXPECT_TRUE(size.ok());
    line.resize(static_cast<std::size_t>(size.ok() ? *size : 0));
    return line;
}

/// What a reader with so much room makes of bytes: contents of packets, and an empty one for an error.
struct Heard {
    std::vector<Bytes> packets;
    std::vector<Status> errors;
};
Heard read(const Bytes& line, std::size_t room_bytes = 64) {
    Bytes room(room_bytes);
    PacketReader reader({room.data(), static_cast<std::ptrdiff_t>(room.size())});
    Heard heard;
    for (const std::uint8_t byte : line) {
        const Result<bool> whole = reader.add(byte);
        if (!whole) heard.errors.push_back(whole.status());
        if (whole && *whole) heard.packets.emplace_back(reader.content().begin(), reader.content().end());
    }
    return heard;
}

Bytes operator+(Bytes a, const Bytes& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

/// The same by the words of RFC 1055 and of ISO 3309, bit by bit.
Bytes packed_slowly(Bytes content) {
    std::uint32_t crc = 0xffffffff;
    for (const std::uint8_t byte : content)
        for (int bit = 0; bit < 8; ++bit) {
            const bool one = ((crc ^ static_cast<std::uint32_t>(byte >> bit)) & 1) != 0;
            crc = crc >> 1 ^ (one ? 0xedb88320u : 0);
        }
    for (int i = 0; i < 4; ++i) content.push_back(static_cast<std::uint8_t>(~crc >> 8 * i));
    Bytes line = {0xC0};
    for (const std::uint8_t byte : content) {
        if (byte == 0xC0)
            line = line + Bytes{0xDB, 0xDC};
        else if (byte == 0xDB)
            line = line + Bytes{0xDB, 0xDD};
        else
            line.push_back(byte);
    }
    line.push_back(0xC0);
    return line;
}

TEST(Packet, IsWrittenAsByHand) {
    // CRC-32 of "123456789" is CBF43926.
    EXPECT_EQ(packed({'1', '2', '3', '4', '5', '6', '7', '8', '9'}),
              (Bytes{0xC0, '1', '2', '3', '4', '5', '6', '7', '8', '9', 0x26, 0x39, 0xF4, 0xCB, 0xC0}));
}

TEST(Packet, EqualsTheReferenceAndComesBack) {
    Random random(901);
    for (int i = 0; i < 2000; ++i) {
        Bytes content(static_cast<std::size_t>(random.between(1, 60)));
        for (std::uint8_t& byte : content)
            byte = static_cast<std::uint8_t>(random.below(3) == 0 ? 0xC0 + 0x1B * random.below(2)
                                                                  : random.below(256));
        const Bytes line = packed(content);
        ASSERT_EQ(line, packed_slowly(content));
        const Heard heard = read(line);
        ASSERT_EQ(heard.packets, std::vector<Bytes>{content});
        ASSERT_TRUE(heard.errors.empty());
    }
}

TEST(Packet, EveryChangeOfABitIsSeenAndTheNextPacketIsRead) {
    const Bytes content = {'L', 5, 0, 0xC0, 0xDB, 7, 0xDC, 255};
    const Bytes good = packed(content);
    const Bytes next = packed({'?'});
    for (std::size_t i = 1; i + 1 < good.size(); ++i)
        for (int bit = 0; bit < 8; ++bit) {
            Bytes line = good;
            line[i] = static_cast<std::uint8_t>(line[i] ^ 1 << bit);
            const Heard heard = read(line + next);
            EXPECT_EQ(heard.packets, std::vector<Bytes>{{'?'}}) << i << " " << bit;
            EXPECT_FALSE(heard.errors.empty()) << i << " " << bit;
        }
}

TEST(Packet, CutOffAnywhereLeavesTheNextOneWhole) {
    const Bytes good = packed({'L', 1, 2, 0xDB, 4, 5});
    const Bytes next = packed({'?'});
    // With all but its last mark it is whole, for the next one begins with a mark.
    for (std::size_t size = 0; size + 1 < good.size(); ++size) {
        const Heard heard =
            read(Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size)) + next);
        EXPECT_EQ(heard.packets, std::vector<Bytes>{{'?'}}) << size;
        EXPECT_EQ(heard.errors.size(), size > 1 ? 1u : 0u) << size;
    }
}

TEST(Packet, ThatIsTooLongIsToldOfOnce) {
    const Bytes content(21, 9);
    EXPECT_EQ(read(packed(content), 25).packets.size(), 1u);
    const Heard heard = read(packed(content) + packed({'?'}), 24);
    EXPECT_EQ(heard.errors, std::vector<Status>{Status::capacity_exceeded});
    EXPECT_EQ(heard.packets, std::vector<Bytes>{{'?'}});
    Bytes room(24);
    PacketReader reader({room.data(), 24});
    for (int kind = 1; kind < 3; ++kind) {
        Bytes other = content;
        other[0] = static_cast<std::uint8_t>(kind);
        for (const std::uint8_t byte : packed(other)) {
            if (reader.add(byte).status() != Status::capacity_exceeded) continue;
            // 21 bytes of content and 3 of the checksum.
            ASSERT_EQ(reader.beginning().size(), 24);
            EXPECT_EQ(reader.beginning()[0], kind);
            EXPECT_EQ(reader.beginning()[20], 9);
        }
    }
    const Heard endless = read(Bytes{0xC0} + Bytes(100000, 1));
    EXPECT_EQ(endless.errors, std::vector<Status>{Status::capacity_exceeded});
}

TEST(Packet, BetweenMarksThereMayBeNothing) {
    EXPECT_TRUE(read(Bytes(50, 0xC0)).errors.empty());
    EXPECT_EQ(read({0xC0, 1, 2, 3, 4, 0xC0}).errors, std::vector<Status>{Status::malformed});
    EXPECT_EQ(read({0xC0, 0xDB, 0xC0}).errors, std::vector<Status>{Status::malformed});
}

TEST(Packet, ADroppedOneEndsAtTheNextMark) {
    Bytes room(16);
    PacketReader reader({room.data(), 16});
    EXPECT_FALSE(reader.in_packet());
    for (const std::uint8_t byte : Bytes{0xC0, 1, 2}) EXPECT_FALSE(*reader.add(byte));
    EXPECT_TRUE(reader.in_packet());
    reader.drop();
    // It has been told of: who waits for its end would wait for ever.
    EXPECT_FALSE(reader.in_packet());
    EXPECT_FALSE(*reader.add(3));
    EXPECT_FALSE(reader.in_packet());
    EXPECT_FALSE(*reader.add(0xC0));
    EXPECT_FALSE(*reader.add(0xDB));
    EXPECT_TRUE(reader.in_packet());
}

TEST(Packet, WritesNothingItHasNoRoomFor) {
    Bytes line(12, 0x77);
    const Bytes content = {1, 2};
    EXPECT_EQ(encode_packet(span(content), {line.data(), 13}).status(), Status::buffer_too_small);
    EXPECT_EQ(encode_packet({}, {line.data(), 12}).status(), Status::bad_argument);
    EXPECT_EQ(line, Bytes(12, 0x77));
}

}  // namespace
}  // namespace fovea::test
