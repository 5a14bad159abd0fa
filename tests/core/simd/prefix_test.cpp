// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/simd/prefix.hpp>

namespace fovea::test {
namespace {

TEST(Prefix, AddsUpARowOfBytesOnWhatIsAbove) {
    Random random(651);
    for (std::size_t count = 0; count <= 120; ++count)
        for (const bool bright : {false, true}) {
            std::vector<std::uint8_t> src(count);
            std::vector<std::uint32_t> above(count);
            std::vector<std::uint32_t> expected;
            std::uint32_t sum = 0;
            for (std::size_t x = 0; x < count; ++x) {
                src[x] = static_cast<std::uint8_t>(bright ? 255 : random.next() >> 11);
                // Close to 2^32, so that some sums begin again at 0.
                above[x] = 0xffffff00u + random.below(512);
                sum += src[x];
                expected.push_back(above[x] + sum);
            }
            std::vector<std::uint32_t> dst(count);
            simd::integral_row(src.data(), static_cast<int>(count), above.data(), dst.data());
            ASSERT_EQ(dst, expected) << count;
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
