// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

#include <fovea/base/random.hpp>
#include <fovea/simd/interleave.hpp>

namespace fovea::test {
namespace {

constexpr std::size_t lanes = static_cast<std::size_t>(simd::lanes);

std::array<std::uint8_t, lanes> stored(simd::Bytes bytes) {
    std::array<std::uint8_t, lanes> pixels{};
    bytes.store(pixels.data());
    return pixels;
}

/// Of exactly the size, so that the address sanitizer sees a byte too many.
std::unique_ptr<std::uint8_t[]> drawn(std::size_t count, Random& random) {
    auto bytes = std::make_unique<std::uint8_t[]>(count);
    for (std::size_t i = 0; i < count; ++i) bytes[i] = static_cast<std::uint8_t>(random.below(256));
    return bytes;
}

TEST(Interleave, DealsPairsByTheirPlace) {
    Random random(71);
    const auto from = drawn(2 * lanes, random);
    const simd::BytePairs pairs = simd::load_pairs(from.get());
    const auto first = stored(pairs.first);
    const auto second = stored(pairs.second);
    for (std::size_t i = 0; i < lanes; ++i) {
        ASSERT_EQ(first[i], from[2 * i]) << i;
        ASSERT_EQ(second[i], from[2 * i + 1]) << i;
    }
}

TEST(Interleave, DealsTriplesByTheirPlace) {
    Random random(72);
    const auto from = drawn(3 * lanes, random);
    const simd::ByteTriples triples = simd::load_triples(from.get());
    const auto first = stored(triples.first);
    const auto second = stored(triples.second);
    const auto third = stored(triples.third);
    for (std::size_t i = 0; i < lanes; ++i) {
        ASSERT_EQ(first[i], from[3 * i]) << i;
        ASSERT_EQ(second[i], from[3 * i + 1]) << i;
        ASSERT_EQ(third[i], from[3 * i + 2]) << i;
    }
}

TEST(Interleave, PutsTriplesTogetherAgain) {
    Random random(73);
    const auto from = drawn(3 * lanes, random);
    const auto to = drawn(3 * lanes, random);
    simd::store_triples(simd::load_triples(from.get()), to.get());
    for (std::size_t i = 0; i < 3 * lanes; ++i) ASSERT_EQ(to[i], from[i]) << i;
}

TEST(Interleave, StepsThroughRowsOfEveryLength) {
    Random random(74);
    for (std::size_t width = 0; width <= 3 * lanes + 1; ++width) {
        const auto from = drawn(3 * width, random);
        const auto to = drawn(width, random);
        simd::for_each_step<3, 1>(
            from.get(), static_cast<int>(width), to.get(),
            [](const std::uint8_t* in, std::uint8_t* out) { simd::load_triples(in).second.store(out); });
        for (std::size_t i = 0; i < width; ++i) ASSERT_EQ(to[i], from[3 * i + 1]) << width << " " << i;
    }
}

}  // namespace
}  // namespace fovea::test
