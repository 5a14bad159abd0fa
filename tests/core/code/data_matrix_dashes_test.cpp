// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

#include <fovea/code/data_matrix_dashes.hpp>

namespace fovea::test {
namespace {

/// A row of modules of 5 px between solid lines: "#.#.".
struct DashScene {
    std::vector<std::uint8_t> pixels = std::vector<std::uint8_t>(100 * 70, 220);
    ImageView<Gray8> image{pixels.data(), {100, 70}, 100};
    std::vector<std::int16_t> samples = std::vector<std::int16_t>(detail::dash_samples);
    std::vector<detail::DashedLine> lines = std::vector<detail::DashedLine>(2);
    detail::EdgeLine edge;

    void fill(int x, int y, int width, int height) {
        for (int j = y; j < y + height; ++j)
            for (int i = x; i < x + width; ++i) image(i, j) = 30;
    }
    /// From the upper end of a line at x = 9.5 to the right, 16 modules of 5 px.
    bool find(int work = 1 << 20) {
        detail::SolidLine from;
        from.line = {{2432, 15232}, detail::direction_of(0, -1)};
        from.inward = detail::direction_of(1, 0);
        from.length = 12800;
        detail::SolidLine beside;
        beside.line = {{2432, 15232}, detail::direction_of(1, 0)};
        beside.inward = detail::direction_of(0, -1);
        beside.length = 80 * 256;
        detail::WorkBudget budget(work);
        const detail::DashFinder finder(detail::CodeField(image, false), 1280, 600,
                                        {{samples.data(), detail::dash_samples}, lines[0], budget});
        return finder.find(from, beside, detail::is_side, lines[1], edge);
    }
};

TEST(DataMatrixDashes, AreCountedAndTheirEdgeIsFound) {
    DashScene scene;
    for (int i = 0; i < 16; i += 2) scene.fill(10 + 5 * i, 10, 5, 5);
    ASSERT_TRUE(scene.find());
    EXPECT_EQ(scene.lines[1].modules(), 16);
    EXPECT_EQ(scene.lines[1].bad, 0);
    EXPECT_LE(std::abs(growth_of(scene.lines[1])), 20);
    EXPECT_NEAR(scene.edge.at.y, 2432, 40);
    EXPECT_NEAR(scene.edge.direction.y, 0, 200);
    // Nothing is found without work that may be done.
    EXPECT_FALSE(scene.find(100));
}

TEST(DataMatrixDashes, TellHowMuchPrintHasGrown) {
    DashScene scene;
    for (int i = 0; i < 16; i += 2) scene.fill(9 + 5 * i, 9, 7, 7);
    ASSERT_TRUE(scene.find());
    EXPECT_EQ(scene.lines[1].modules(), 16);
    // 7 px dark and 3 px light: a pixel on each side. Samples are 1.25 px apart, so that sharp edges are
    // placed to a quarter of a pixel.
    EXPECT_NEAR(growth_of(scene.lines[1]), 256, 64);
}

TEST(DataMatrixDashes, AreNotInWhatIsSolidOrEmpty) {
    DashScene empty;
    EXPECT_FALSE(empty.find());
    DashScene solid;
    solid.fill(10, 10, 80, 5);
    EXPECT_FALSE(solid.find());
}

}  // namespace
}  // namespace fovea::test
