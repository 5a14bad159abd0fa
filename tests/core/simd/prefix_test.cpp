// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/simd/prefix.hpp>

namespace fovea::test {
namespace {

constexpr int rows = simd::integral_rows_a_step;

TEST(Prefix, AddsUpRowsOfBytesOnWhatIsAbove) {
    Random random(651);
    for (int count = 0; count <= 120; ++count) {
        const auto n = static_cast<std::size_t>(count);
        std::vector<std::vector<std::uint8_t>> src(rows, std::vector<std::uint8_t>(n));
        std::vector<std::vector<std::uint32_t>> dst(rows, std::vector<std::uint32_t>(n));
        // Close to 2^32, so that some sums begin again at 0.
        std::vector<std::uint32_t> above(n);
        for (std::uint32_t& sum : above) sum = 0xffffff00u + random.below(512);
        std::vector<std::uint32_t> expected = above;
        const std::uint8_t* from[rows];
        std::uint32_t* to[rows];
        std::vector<std::vector<std::uint32_t>> all;
        for (int r = 0; r < rows; ++r) {
            auto& row = src[static_cast<std::size_t>(r)];
            std::uint32_t sum = 0;
            for (std::size_t x = 0; x < n; ++x) {
                row[x] = static_cast<std::uint8_t>(r == 0 ? 255 : random.next() >> 11);
                sum += row[x];
                expected[x] += sum;
            }
            all.push_back(expected);
            from[r] = row.data();
            to[r] = dst[static_cast<std::size_t>(r)].data();
        }
        simd::integral_rows(from, count, above.data(), to);
        ASSERT_EQ(dst, all) << count;
        std::vector<std::uint32_t> one(n);
        simd::integral_row(src[0].data(), count, above.data(), one.data());
        ASSERT_EQ(one, all[0]) << count;
    }
}

TEST(Prefix, AddsUpARowOfWords) {
    Random random(652);
    for (std::size_t count = 0; count <= 100; ++count) {
        std::vector<std::uint16_t> src(count);
        std::vector<std::uint32_t> expected;
        std::uint32_t sum = 0;
        for (std::uint16_t& word : src) {
            word = static_cast<std::uint16_t>(random.below(4) == 0 ? 65535 : random.next() >> 7);
            sum += word;
            expected.push_back(sum);
        }
        std::vector<std::uint32_t> dst(count);
        simd::prefix_row(src.data(), static_cast<int>(count), dst.data());
        ASSERT_EQ(dst, expected) << count;
    }
}

}  // namespace
}  // namespace fovea::test
