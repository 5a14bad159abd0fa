// SPDX-License-Identifier: MIT
//
// What resizing and turning are made of, at whatever width this program is compiled for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/simd/halves.hpp>
#include <fovea/simd/taps.hpp>

namespace fovea::test {
namespace {

std::vector<std::uint8_t> random_bytes(Random& random, int count) {
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(count));
    for (std::uint8_t& byte : bytes)
        byte = random.below(4) == 0 ? static_cast<std::uint8_t>(255 * random.below(2))
                                    : static_cast<std::uint8_t>(random.below(256));
    return bytes;
}

TEST(Halves, WidenAndNarrowInOrder) {
    Random random(921);
    const std::vector<std::uint8_t> from = random_bytes(random, simd::lanes);
    std::vector<std::uint8_t> to(from.size());
    simd::narrowed(simd::widened(from.data()), simd::widened(from.data() + simd::half_lanes))
        .store(to.data());
    EXPECT_EQ(from, to);
    std::vector<std::uint16_t> values(static_cast<std::size_t>(simd::half_lanes));
    const simd::RawWords words = simd::widened(from.data());
    std::memcpy(values.data(), &words, sizeof words);
    for (std::size_t i = 0; i < values.size(); ++i) EXPECT_EQ(values[i], from[i]);
}

TEST(Halves, TurnRoundAndTranspose) {
    Random random(922);
    std::vector<std::uint8_t> from = random_bytes(random, simd::lanes);
    std::vector<std::uint8_t> to(from.size());
    simd::reversed(simd::Bytes::load(from.data())).store(to.data());
    std::reverse(to.begin(), to.end());
    EXPECT_EQ(from, to);

    constexpr int side = simd::square_side;
    from = random_bytes(random, side * (side + 3));
    to.assign(static_cast<std::size_t>(side * (side + 5)), 0);
    simd::transpose_square(from.data(), side + 3, to.data(), side + 5);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            ASSERT_EQ(to[static_cast<std::size_t>(x * (side + 5) + y)],
                      from[static_cast<std::size_t>(y * (side + 3) + x)]);
}

TEST(Taps, WeighRowsOfEveryLength) {
    Random random(923);
    for (int width = 1; width <= 3 * simd::lanes + 1; ++width) {
        std::vector<std::vector<std::uint8_t>> rows;
        for (int i = 0; i < 4; ++i) rows.push_back(random_bytes(random, width));
        std::vector<std::int16_t> line(static_cast<std::size_t>(width));
        const int weight = random.between(0, 256);
        simd::blend_rows(rows[0].data(), rows[1].data(), weight, width, line.data());
        for (std::size_t x = 0; x < line.size(); ++x)
            ASSERT_EQ(line[x], rows[0][x] * (256 - weight) + rows[1][x] * weight - 32768);
        const std::int16_t weights[4] = {-128, 1152, 1152, -128};
        simd::weigh_rows({rows[0].data(), rows[1].data(), rows[2].data(), rows[3].data()}, weights, width,
                         line.data());
        for (std::size_t x = 0; x < line.size(); ++x)
            ASSERT_EQ(line[x],
                      (1152 * (rows[1][x] + rows[2][x]) - 128 * (rows[0][x] + rows[3][x]) + 16) >> 5);
    }
}

TEST(Taps, WeighNeighboursOfEveryCount) {
    Random random(924);
    std::vector<std::int16_t> line(200);
    for (int count = 1; count <= simd::taps_length; ++count) {
        std::vector<std::int32_t> at(static_cast<std::size_t>(count));
        std::vector<simd::Pair> first(at.size()), last(at.size());
        std::vector<std::uint8_t> pixels(at.size());
        for (std::int16_t& value : line)
            value = static_cast<std::int16_t>(random.between(-32768, 65280 - 32768));
        for (std::size_t i = 0; i < at.size(); ++i) {
            at[i] = random.between(0, 196);
            const int share = random.between(0, 256);
            first[i] = {static_cast<std::int16_t>(256 - share), static_cast<std::int16_t>(share)};
        }
        simd::blend_pairs(line.data(), at.data(), first.data(), count, pixels.data());
        for (std::size_t i = 0; i < at.size(); ++i) {
            const std::int16_t* from = line.data() + at[i];
            const int sum = (from[0] + 32768) * first[i].first + (from[1] + 32768) * first[i].second;
            ASSERT_EQ(pixels[i], (sum + 32768) >> 16) << count;
        }
        for (std::int16_t& value : line) value = static_cast<std::int16_t>(random.between(-2040, 18360));
        for (std::size_t i = 0; i < at.size(); ++i) {
            first[i] = {static_cast<std::int16_t>(random.between(-128, 0)),
                        static_cast<std::int16_t>(random.between(0, 2048))};
            last[i] = {static_cast<std::int16_t>(random.between(0, 2048)),
                       static_cast<std::int16_t>(random.between(-128, 0))};
        }
        simd::weigh_fours(line.data(), at.data(), first.data(), last.data(), count, pixels.data());
        for (std::size_t i = 0; i < at.size(); ++i) {
            const std::int16_t* from = line.data() + at[i];
            const int sum = from[0] * first[i].first + from[1] * first[i].second + from[2] * last[i].first +
                            from[3] * last[i].second;
            ASSERT_EQ(pixels[i], std::clamp((sum + 65536) >> 17, 0, 255)) << count;
        }
    }
}

}  // namespace
}  // namespace fovea::test
