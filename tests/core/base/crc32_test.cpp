// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include <fovea/base/crc32.hpp>
#include <fovea/base/random.hpp>

namespace fovea::test {
namespace {

constexpr std::uint8_t check_text[] = {'1', '2', '3', '4', '5', '6', '7', '8', '9'};

/// A bit at a time, as the polynomial is written.
std::uint32_t slow_crc32(const std::vector<std::uint8_t>& bytes) {
    std::uint32_t state = 0xffffffff;
    for (const std::uint8_t byte : bytes)
        for (int bit = 0; bit < 8; ++bit) {
            const bool odd = ((state ^ static_cast<std::uint32_t>(byte >> bit)) & 1) != 0;
            state = (state >> 1) ^ (odd ? 0xedb88320u : 0u);
        }
    return ~state;
}

std::vector<std::uint8_t> random_bytes(Random& random, int count) {
    std::vector<std::uint8_t> bytes;
    for (int i = 0; i < count; ++i) bytes.push_back(static_cast<std::uint8_t>(random.below(256)));
    return bytes;
}

Span<const std::uint8_t> span_of(const std::vector<std::uint8_t>& bytes) {
    return {bytes.data(), static_cast<std::ptrdiff_t>(bytes.size())};
}

TEST(Crc32, GivesTheCheckValueOfTheStandardAndZeroForNothing) {
    static_assert(crc32(check_text) == 0xcbf43926);
    EXPECT_EQ(crc32({}), 0u);
    EXPECT_EQ(Crc32().value(), 0u);
    // The trailer of every PNG file: the CRC of the name of its last chunk.
    constexpr std::uint8_t end[] = {'I', 'E', 'N', 'D'};
    EXPECT_EQ(crc32(end), 0xae426082u);
}

TEST(Crc32, EqualsTheDivisionBitByBit) {
    Random random(41);
    for (int count = 0; count < 200; ++count) {
        const std::vector<std::uint8_t> bytes = random_bytes(random, count);
        ASSERT_EQ(crc32(span_of(bytes)), slow_crc32(bytes)) << count;
    }
}

TEST(Crc32, OfPiecesIsThatOfTheWhole) {
    Random random(42);
    const std::vector<std::uint8_t> bytes = random_bytes(random, 300);
    const std::uint32_t whole = crc32(span_of(bytes));
    for (std::ptrdiff_t cut = 0; cut <= 300; ++cut) {
        Crc32 crc;
        crc.add(span_of(bytes).first(cut));
        static_cast<void>(crc.value());  // asking in between changes nothing
        crc.add(span_of(bytes).from(cut));
        ASSERT_EQ(crc.value(), whole) << cut;
    }
    Crc32 single;
    for (const std::uint8_t byte : bytes) single.add(byte);
    EXPECT_EQ(single.value(), whole);
}

TEST(Crc32, SeesEveryFlippedBit) {
    Random random(43);
    std::vector<std::uint8_t> bytes = random_bytes(random, 64);
    const std::uint32_t before = crc32(span_of(bytes));
    for (std::size_t i = 0; i < 8 * bytes.size(); ++i) {
        const auto bit = static_cast<std::uint8_t>(1 << i % 8);
        bytes[i / 8] ^= bit;
        EXPECT_NE(crc32(span_of(bytes)), before) << i;
        bytes[i / 8] ^= bit;
    }
}

}  // namespace
}  // namespace fovea::test
