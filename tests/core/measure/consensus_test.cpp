// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/measure/consensus.hpp>
#include <support/render.hpp>

namespace fovea::test {
namespace {

/// The simplest model: a column, through one point.
Result<FinePixel> column_through(Span<const FinePoint> one) { return one[0].x; }
FinePixel distance_from_column(FinePixel column, FinePoint point) {
    return detail::without_sign(point.x - column);
}

Result<Consensus<FinePixel>> consensus(const std::vector<FinePoint>& points, std::ptrdiff_t room) {
    std::vector<FinePixel> scratch(static_cast<std::size_t>(room));
    return least_median<1, FinePixel>({points.data(), static_cast<std::ptrdiff_t>(points.size())},
                                      column_through, distance_from_column, {scratch.data(), room});
}
Result<Consensus<FinePixel>> consensus(const std::vector<FinePoint>& points) {
    return consensus(points, static_cast<std::ptrdiff_t>(points.size()));
}

TEST(LeastMedian, KeepsTheModelOfTheLargerHalf) {
    const auto best = consensus({fine(7, 0), fine(7, 5), fine(90, 1), fine(7, 2), fine(-300, 4)});
    ASSERT_TRUE(best.ok());
    EXPECT_EQ(best->model, FinePixel::from_int(7));
    EXPECT_EQ(best->limit, FinePixel::from_ratio(1, 32)) << "the least limit there is";
}

TEST(LeastMedian, LimitsWhatAgreesByTheMedian) {
    // From 10 the distances are 0, 1, 1, 2, 2: the median is 1, of 5 points and 1 parameter.
    const auto best = consensus({fine(8, 0), fine(9, 0), fine(10, 0), fine(11, 0), fine(12, 0)});
    ASSERT_TRUE(best.ok());
    EXPECT_EQ(best->model, FinePixel::from_int(10));
    EXPECT_NEAR(real(best->limit), 2.5 * 1.4826 * (1 + 5 / 4.0), 1e-4);
}

TEST(LeastMedian, IsNotMovedByFortyOfAHundredWrongPoints) {
    Random random(691);
    for (int round = 0; round < 50; ++round) {
        std::vector<FinePoint> points;
        for (int i = 0; i < 60; ++i) points.push_back(fine(100 + 0.1 * normal(random), i));
        for (int i = 0; i < 40; ++i) points.push_back(fine(uniform(random, 101, 200), i));
        const auto best = consensus(points);
        ASSERT_TRUE(best.ok());
        EXPECT_NEAR(real(best->model), 100, 0.5);
        EXPECT_LT(real(best->limit), 2);
    }
}

TEST(LeastMedian, SaysWhatIsWrong) {
    EXPECT_EQ(consensus({}).status(), Status::degenerate);
    EXPECT_EQ(consensus({fine(1, 1), fine(2, 2)}, 1).status(), Status::scratch_too_small);
    const std::vector<FinePoint> two = {fine(1, 1), fine(2, 2)};
    FinePixel scratch[2];
    const auto never = [](Span<const FinePoint>) -> Result<FinePixel> { return Status::degenerate; };
    const auto best = least_median<1, FinePixel>({two.data(), 2}, never, distance_from_column, {scratch, 2});
    EXPECT_EQ(best.status(), Status::degenerate) << "no sample makes a model";
}

TEST(DrawDifferent, DrawsEveryPairEquallyOften) {
    Random random(692);
    int count[5][5] = {};
    constexpr int draws = 10000;
    for (int i = 0; i < draws; ++i) {
        std::ptrdiff_t chosen[2] = {};
        draw_different(random, 5, chosen);
        ASSERT_TRUE(chosen[0] >= 0 && chosen[0] < chosen[1] && chosen[1] < 5);
        ++count[chosen[0]][chosen[1]];
    }
    // 1000 of each of the ten pairs, deviation 30; five of these.
    for (int a = 0; a < 5; ++a)
        for (int b = a + 1; b < 5; ++b) EXPECT_NEAR(count[a][b], draws / 10, 150) << a << " " << b;
}

}  // namespace
}  // namespace fovea::test
