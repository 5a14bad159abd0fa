// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/code/data_matrix_grid.hpp>

namespace fovea::test {
namespace {

using detail::EdgePlace;
using detail::SquareToQuad;

TEST(DataMatrixGrid, TheSquareMeetsTheFourCorners) {
    Random random(8);
    for (int round = 0; round < 1000; ++round) {
        const auto near = [&](int x, int y) {
            return EdgePlace{x + random.between(-8000, 8000), y + random.between(-8000, 8000)};
        };
        const EdgePlace corners[4] = {near(0, 0), near(60000, 0), near(60000, 40000), near(0, 40000)};
        const SquareToQuad map(corners[0], corners[1], corners[2], corners[3]);
        ASSERT_TRUE(map.there());
        const std::int32_t places[4][2] = {{0, 0}, {65536, 0}, {65536, 65536}, {0, 65536}};
        for (int i = 0; i < 4; ++i) {
            const EdgePlace p = map(places[i][0], places[i][1]);
            EXPECT_NEAR(p.x, corners[i].x, 2);
            EXPECT_NEAR(p.y, corners[i].y, 2);
        }
        // Straight lines stay straight: the middle of the square is where the diagonals cross.
        const EdgePlace m = map(32768, 32768);
        const auto off = [&](EdgePlace a, EdgePlace b) {
            const double x = b.x - a.x;
            const double y = b.y - a.y;
            return (x * (m.y - a.y) - y * (m.x - a.x)) / (x * x + y * y);
        };
        EXPECT_NEAR(off(corners[0], corners[2]), 0, 1e-4);
        EXPECT_NEAR(off(corners[1], corners[3]), 0, 1e-4);
    }
}

TEST(DataMatrixGrid, ThereIsNoMapOntoWhatIsNotConvex) {
    EXPECT_FALSE(SquareToQuad({0, 0}, {100, 0}, {10, 10}, {0, 100}).there());
    EXPECT_FALSE(SquareToQuad({0, 0}, {100, 0}, {0, 100}, {100, 100}).there());
    EXPECT_FALSE(SquareToQuad({0, 0}, {0, 0}, {0, 0}, {0, 0}).there());
    EXPECT_FALSE(SquareToQuad({0, 0}, {100, 0}, {200, 0}, {300, 0}).there());
    constexpr std::int32_t far = 1 << 24;
    EXPECT_TRUE(SquareToQuad({-far, -far}, {far, -far}, {far, far}, {-far, far}).there());
}

TEST(DataMatrixGrid, RulesTellDarkFromLight) {
    // 10x10: borders as they are to be, one level for light and one for dark; the lower half in shadow.
    const DataMatrixSize& size = data_matrix_sizes[0];
    std::vector<std::uint8_t> values(100);
    std::vector<std::uint8_t> scratch(100);
    BitStorage<10, 10> modules;
    const auto at = [&](int x, int y) -> std::uint8_t& {
        return values[static_cast<std::size_t>(10 * y + x)];
    };
    const auto dark = [&](int x, int y) {
        const DataMatrixModule module = data_matrix_border(size, x, y);
        return module == DataMatrixModule::data ? (x + y) % 3 == 0 : module == DataMatrixModule::dark;
    };
    const auto classify = [&](detail::ModuleRule rule) {
        detail::classify_modules({values.data(), 100}, size, rule, {scratch.data(), 100}, modules.view());
        int wrong = 0;
        for (int y = 0; y < 10; ++y)
            for (int x = 0; x < 10; ++x) wrong += modules.view()(x, y) != dark(x, y) ? 1 : 0;
        return wrong;
    };
    for (int y = 0; y < 10; ++y)
        for (int x = 0; x < 10; ++x) at(x, y) = dark(x, y) ? 20 : 200;
    EXPECT_EQ(classify(detail::ModuleRule::one_level), 0);
    EXPECT_EQ(classify(detail::ModuleRule::near_levels), 0);
    EXPECT_EQ(classify(detail::ModuleRule::sharpened), 0);
    for (int y = 0; y < 10; ++y)
        for (int x = 0; x < 10; ++x) at(x, y) = static_cast<std::uint8_t>((dark(x, y) ? 20 : 80) + 12 * y);
    EXPECT_GT(classify(detail::ModuleRule::one_level), 0);
    EXPECT_EQ(classify(detail::ModuleRule::near_levels), 0);
}

}  // namespace
}  // namespace fovea::test
