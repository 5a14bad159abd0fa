// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/simd/sums.hpp>

namespace fovea::test {
namespace {

TEST(Sums, AreThoseOfOneByteAfterTheOtherAtEveryLength) {
    Random random(641);
    for (std::size_t count = 0; count <= 200; ++count) {
        std::vector<std::uint8_t> row(count);
        std::uint64_t sum = 0;
        std::uint64_t squares = 0;
        for (std::uint8_t& byte : row) {
            byte = static_cast<std::uint8_t>(random.next() >> 11);
            sum += byte;
            squares += static_cast<std::uint64_t>(byte) * byte;
        }
        EXPECT_EQ(simd::sum_of_bytes(row.data(), static_cast<int>(count)), sum) << count;
        const simd::ByteSums sums = simd::square_sums_of_bytes(row.data(), static_cast<int>(count));
        EXPECT_EQ(sums.sum, sum) << count;
        EXPECT_EQ(sums.squares, squares) << count;
    }
}

TEST(Sums, OfLongWhiteRowsDoNotOverflow) {
    for (const int count :
         {simd::sums_a_stretch - 1, simd::sums_a_stretch, simd::sums_a_stretch + 1, 1 << 22}) {
        const std::vector<std::uint8_t> row(static_cast<std::size_t>(count), 255);
        const auto n = static_cast<std::uint64_t>(count);
        EXPECT_EQ(simd::sum_of_bytes(row.data(), count), n * 255);
        const simd::ByteSums sums = simd::square_sums_of_bytes(row.data(), count);
        EXPECT_EQ(sums.sum, n * 255);
        EXPECT_EQ(sums.squares, n * 65025);
    }
}

}  // namespace
}  // namespace fovea::test
