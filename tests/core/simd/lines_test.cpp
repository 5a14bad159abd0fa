// SPDX-License-Identifier: MIT
//
// Lines at whatever width this program is compiled for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/simd/lines.hpp>

namespace fovea::test {
namespace {

using simd::ByteLine;
using simd::Bytes;

TEST(ForEachVector, VisitsEveryColumnOnceAndOnlyTheLastVectorIsPartial) {
    for (int width = 0; width <= 4 * simd::lanes + 3; ++width) {
        std::vector<std::pair<int, int>> visits;
        simd::for_each_vector(width, [&](int x, int count) { visits.push_back({x, count}); });
        int next = 0;
        for (std::size_t i = 0; i < visits.size(); ++i) {
            ASSERT_EQ(visits[i].first, next);
            ASSERT_GE(visits[i].second, 1);
            ASSERT_LE(visits[i].second, simd::lanes);
            ASSERT_TRUE(visits[i].second == simd::lanes || i + 1 == visits.size());
            next += visits[i].second;
        }
        ASSERT_EQ(next, width);
    }
}

TEST(ByteLine, GivesBackWhatWasPutAndItsEndsWithinItsScratch) {
    Random random(91);
    for (int width = 1; width <= 3 * simd::lanes + 1; ++width)
        for (const int reach : {0, 1, 5, max_reach}) {
            // Of exactly the size, so that the address sanitizer sees a byte too many.
            const int bytes = byte_line_scratch(width);
            const auto scratch = std::make_unique<std::uint8_t[]>(static_cast<std::size_t>(bytes));
            std::vector<std::uint8_t> row(static_cast<std::size_t>(width));
            for (std::uint8_t& pixel : row) pixel = static_cast<std::uint8_t>(random.below(256));
            ByteLine line({scratch.get(), bytes}, width);
            simd::for_each_vector(width,
                                  [&](int x, int count) { line.put(x, Bytes::load(row.data() + x, count)); });
            line.replicate(width, reach);
            for (int x = -reach; x < width + reach; ++x) {
                std::vector<std::uint8_t> seen(static_cast<std::size_t>(simd::lanes));
                line.at(x).store(seen.data());
                for (int i = 0; i < simd::lanes && x + i < width + reach; ++i)
                    ASSERT_EQ(seen[static_cast<std::size_t>(i)],
                              row[static_cast<std::size_t>(std::clamp(x + i, 0, width - 1))])
                        << width << " wide, column " << x + i;
            }
            // The outermost columns that may be asked for.
            static_cast<void>(line.at(-max_reach));
            static_cast<void>(line.at(width - 1 + max_reach));
        }
}

TEST(ByteLine, NeedsScratchForTheRowBothReachesAndAVector) {
    static_assert(byte_line_scratch(100) == 100 + 2 * max_reach + simd::lanes);
}

#if !defined(NDEBUG)
TEST(ByteLineDeathTest, StopsAtTooLittleScratchWhileDebugging) {
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(byte_line_scratch(10)));
    EXPECT_DEATH(ByteLine({scratch.data(), byte_line_scratch(10) - 1}, 10), "");
}
#endif

}  // namespace
}  // namespace fovea::test
