// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/simd/lookup.hpp>

namespace fovea::test {
namespace {

std::vector<std::uint8_t> random_bytes(Random& random, std::size_t count) {
    std::vector<std::uint8_t> bytes(count);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.next() >> 11);
    return bytes;
}

TEST(Lookup, FindsEveryLevelInEveryLane) {
    Random random(631);
    const std::vector<std::uint8_t> table = random_bytes(random, 256);
    const simd::Lookup lookup(table.data());
    for (int shift = 0; shift < 256; ++shift) {
        std::vector<std::uint8_t> pixels(256);
        for (int i = 0; i < 256; ++i)
            pixels[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(i + shift);
        std::vector<std::uint8_t> found(256);
        lookup.row(pixels.data(), 256, found.data());
        for (std::size_t i = 0; i < 256; ++i) ASSERT_EQ(found[i], table[pixels[i]]) << i << " " << shift;
    }
}

TEST(Lookup, IsTheSameAtEveryLengthAndInPlace) {
    Random random(632);
    for (std::size_t count = 0; count <= 300; ++count) {
        const std::vector<std::uint8_t> table = random_bytes(random, 256);
        // Of exactly the size, so that the address sanitizer sees a byte too many.
        std::vector<std::uint8_t> pixels = random_bytes(random, count);
        std::vector<std::uint8_t> expected;
        for (const std::uint8_t pixel : pixels) expected.push_back(table[pixel]);
        const simd::Lookup lookup(table.data());
        lookup.row(pixels.data(), static_cast<int>(count), pixels.data());
        ASSERT_EQ(pixels, expected) << count;
    }
}

}  // namespace
}  // namespace fovea::test
