// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/simd/window_means.hpp>

namespace fovea::test {
namespace {

TEST(WindowMeans, ColumnsGainOneRowAndLoseAnother) {
    Random random(655);
    for (std::size_t width = 0; width <= 40; ++width) {
        std::vector<std::uint8_t> entering(width);
        std::vector<std::uint8_t> leaving(width);
        std::vector<std::uint16_t> columns(width);
        std::vector<std::uint16_t> expected;
        for (std::size_t x = 0; x < width; ++x) {
            entering[x] = static_cast<std::uint8_t>(random.next() >> 9);
            leaving[x] = static_cast<std::uint8_t>(random.next() >> 9);
            columns[x] = static_cast<std::uint16_t>(255 + random.below(16000));
            expected.push_back(static_cast<std::uint16_t>(columns[x] + entering[x] - leaving[x]));
        }
        simd::slide_columns(entering.data(), leaving.data(), static_cast<int>(width), columns.data());
        ASSERT_EQ(columns, expected);
    }
}

TEST(WindowMeans, PixelsAreAsBrightAsTheMeanOrNot) {
    Random random(656);
    for (int width = 0; width <= 40; ++width)
        for (const int side : {1, 3, 63})
            for (const int offset : {-255, -3, 0, 7, 255}) {
                const std::int32_t area = side * side;
                std::vector<std::uint32_t> sums{random.next()};
                for (int x = 1; x < width + side; ++x)
                    sums.push_back(sums.back() + random.below(static_cast<std::uint32_t>(255 * side + 1)));
                const std::uint8_t flip = width % 2 == 0 ? 0 : 255;
                std::vector<std::uint8_t> src(static_cast<std::size_t>(width));
                std::vector<std::uint8_t> dst(src.size());
                std::vector<std::uint8_t> expected;
                for (std::size_t x = 0; x < src.size(); ++x) {
                    const std::uint32_t sum = sums[x + static_cast<std::size_t>(side)] - sums[x];
                    // Often right at the mean, where the answer turns.
                    const auto mean =
                        static_cast<std::int32_t>(sum) / area - offset + (random.below(2) == 0 ? 0 : 1);
                    src[x] = static_cast<std::uint8_t>(mean < 0 ? 0 : mean > 255 ? 255 : mean);
                    const bool bright = (src[x] + offset) * area >= static_cast<std::int32_t>(sum);
                    expected.push_back(static_cast<std::uint8_t>((bright ? 255 : 0) ^ flip));
                }
                simd::compare_with_means(src.data(), sums.data(), width, side, offset, flip, dst.data());
                ASSERT_EQ(dst, expected) << width << " pixels, side " << side << ", offset " << offset;
            }
}

}  // namespace
}  // namespace fovea::test
