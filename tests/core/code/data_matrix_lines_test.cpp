// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fovea/base/random.hpp>
#include <fovea/code/data_matrix_lines.hpp>

namespace fovea::test {
namespace {

using detail::direction_of;
using detail::EdgeLine;
using detail::EdgePlace;

TEST(DataMatrixLines, DirectionsHaveOneLength) {
    EXPECT_EQ(direction_of(300, 400).x, 9830);
    EXPECT_EQ(direction_of(300, 400).y, 13107);
    EXPECT_EQ(direction_of(0, -7).y, -(1 << 14));
    EXPECT_EQ(direction_of(0, 0).x, 1 << 14);
    EXPECT_EQ(direction_of(5, 0).right().y, 1 << 14);
}

TEST(DataMatrixLines, CrossWhereBothAre) {
    const EdgeLine level{{1000, 2000}, direction_of(1, 0)};
    const EdgeLine upright{{-500, 99}, direction_of(0, -1)};
    const auto met = crossing(level, upright);
    ASSERT_TRUE(met.ok());
    EXPECT_EQ(met->x, -500);
    EXPECT_EQ(met->y, 2000);
    EXPECT_EQ(crossing(level, level).status(), Status::not_found);
    EXPECT_EQ(crossing(level, {{0, 0}, direction_of(20, 1)}).status(), Status::not_found);
}

TEST(DataMatrixLines, AFitLeavesOutWhatLiesFarOff) {
    // Places on v = 10 + u / 16 and one that is not.
    EdgePlace offsets[9];
    for (int i = 0; i < 9; ++i) offsets[i] = {256 * i, 10 + 16 * i};
    offsets[4].y += 5000;
    const EdgeLine about{{0, 0}, direction_of(1, 0)};
    EdgeLine line;
    ASSERT_TRUE(detail::fit_edge(offsets, about, direction_of(0, 1), line));
    EXPECT_NEAR(line.at.y, 10, 2);
    EXPECT_NEAR(line.direction.y * 16, line.direction.x, 64);
    EXPECT_FALSE(detail::fit_edge(Span<const EdgePlace>(offsets, 2), about, direction_of(0, 1), line));
}

TEST(DataMatrixLines, StepsAlongThemLieWhereTheirMultiplesDo) {
    Random random(47);
    std::uint8_t pixels[40 * 30];
    for (std::uint8_t& pixel : pixels) pixel = static_cast<std::uint8_t>(random.between(0, 255));
    const detail::CodeField field(ImageView<const Gray8>(pixels, {40, 30}, 40), false);
    for (int round = 0; round < 200; ++round) {
        const EdgePlace start{random.between(-2000, 12000), random.between(-2000, 9000)};
        const detail::Direction way = direction_of(random.between(-99, 99), random.between(-99, 99));
        const int first = random.between(-500, 500);
        const int step = random.between(1, 400);
        detail::FieldSteps steps = steps_along(field, start, way, first, step);
        for (int i = 0; i < 40; ++i) {
            const EdgePlace p = start + way.times(first + i * step);
            ASSERT_EQ(steps.next(), field.sample(p.x, p.y)) << round << ' ' << i;
        }
    }
}

}  // namespace
}  // namespace fovea::test
