// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/simd/triples.hpp>

namespace fovea::test {
namespace {

constexpr simd::TripleWeights luma{9798, 19235, 3735};
static_assert(luma.first + luma.second + luma.third == 32768);

/// The means of the triples, written into memory without a byte to spare.
std::vector<std::uint8_t> weighed(const std::vector<std::uint8_t>& triples, simd::TripleWeights weights) {
    std::vector<std::uint8_t> means(triples.size() / 3);
    simd::weigh_triples(triples.data(), static_cast<int>(means.size()), weights, means.data());
    return means;
}
std::vector<std::uint8_t> one_by_one(const std::vector<std::uint8_t>& triples, simd::TripleWeights weights) {
    std::vector<std::uint8_t> means;
    for (std::size_t i = 0; i + 2 < triples.size(); i += 3) {
        const double sum = static_cast<double>(weights.first) * triples[i] +
                           static_cast<double>(weights.second) * triples[i + 1] +
                           static_cast<double>(weights.third) * triples[i + 2];
        means.push_back(static_cast<std::uint8_t>(sum / 32768 + 0.5));
    }
    return means;
}

TEST(Triples, AreWeighedByHand) {
    constexpr simd::TripleWeights halves{16384, 8192, 8192};
    static_assert(halves.mean(100, 40, 20) == 65);
    EXPECT_EQ(weighed({100, 40, 20, 1, 0, 0, 0, 1, 0}, halves), (std::vector<std::uint8_t>{65, 1, 0}))
        << "a half is rounded up, a quarter down";
}

TEST(Triples, AreTheSameOneByOneAtEveryLength) {
    Random random(621);
    const simd::TripleWeights every[] = {
        luma, {32767, 1, 0}, {0, 32767, 1}, {1, 0, 32767}, {10923, 10923, 10922}};
    for (const simd::TripleWeights weights : every)
        for (std::size_t count = 0; count <= 70; ++count) {
            std::vector<std::uint8_t> triples(3 * count);
            for (std::uint8_t& byte : triples) byte = static_cast<std::uint8_t>(random.next() >> 11);
            EXPECT_EQ(weighed(triples, weights), one_by_one(triples, weights)) << count;
        }
}

TEST(Triples, OfEqualBytesGiveThemselves) {
    for (int level = 0; level < 256; ++level) {
        const std::vector<std::uint8_t> grey(3 * 17, static_cast<std::uint8_t>(level));
        EXPECT_EQ(weighed(grey, luma), std::vector<std::uint8_t>(17, static_cast<std::uint8_t>(level)));
    }
}

TEST(Triples, StayInOrderFromTheFirstLaneToTheLast) {
    std::vector<std::uint8_t> triples;
    std::vector<std::uint8_t> expected;
    for (int i = 0; i < 48; ++i) {
        const auto level = static_cast<std::uint8_t>(5 * i);
        triples.insert(triples.end(), {level, level, level});
        expected.push_back(level);
    }
    EXPECT_EQ(weighed(triples, luma), expected);
}

}  // namespace
}  // namespace fovea::test
