// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vector>

#include <fovea/code/data_matrix_frame.hpp>
#include <support/data_matrix_scene.hpp>

namespace fovea::test {
namespace {

TEST(DataMatrixFrame, HasTheCornersAndTheModulesOfTheSymbol) {
    DataMatrixScene scene;
    scene.size = {36, 12};
    DrawnImage image = draw(scene);
    const auto frame = frame_of(image.view());
    ASSERT_TRUE(frame.ok());
    EXPECT_EQ(frame->columns, 36);
    EXPECT_EQ(frame->rows, 12);
    const double left = (image.size.width - 144) / 2.0 - 0.5;
    const double top = (image.size.height - 48) / 2.0 - 0.5;
    EXPECT_NEAR(frame->upper.x / 256.0, left, 0.3);
    EXPECT_NEAR(frame->upper.y / 256.0, top, 0.3);
    EXPECT_NEAR(frame->corner.y / 256.0, top + 48, 0.3);
    EXPECT_NEAR(frame->right.x / 256.0, left + 144, 0.3);
    EXPECT_NEAR(frame->opposite.x / 256.0, left + 144, 0.3);
    EXPECT_NEAR(frame->opposite.y / 256.0, top, 0.3);
}

TEST(DataMatrixFrame, IsNotInASolidRectangleNorInAnLWithoutDashes) {
    std::vector<std::uint8_t> pixels(80 * 80, 230);
    const ImageView<Gray8> image(pixels.data(), {80, 80}, 80);
    for (int y = 10; y < 70; ++y)
        for (int x = 10; x < 70; ++x) image(x, y) = 20;
    EXPECT_EQ(frame_of(image).status(), Status::not_found);
    for (int y = 10; y < 65; ++y)
        for (int x = 15; x < 70; ++x) image(x, y) = 230;
    EXPECT_EQ(frame_of(image).status(), Status::not_found);
}

TEST(DataMatrixFrame, ThinPlacesHaveLightBehindThemAndAreWork) {
    std::vector<std::uint8_t> pixels(100 * 40, 20);
    const ImageView<Gray8> image(pixels.data(), {100, 40}, 100);
    // Dark below row 10, and light again from row 14 on in the right half. The piece goes right along row 10,
    // the dark on its right.
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 100; ++x)
            if (y < 10 || (x >= 50 && y >= 14)) image(x, y) = 230;
    const detail::BorderPiece piece{{2, 10}, {98, 10}, 96};
    detail::WorkBudget budget(1000);
    // Of 15 places, 6 px apart from x = 8 on, 8 are at 50 and more; the depths are 1, 5, 9 and so on to 29.
    EXPECT_EQ(detail::thin_places(detail::CodeField(image, false), piece, 125, budget), 8);
    EXPECT_EQ(budget.left(), 1000 - (8 * 2 + 7 * 8) / 4);
}

}  // namespace
}  // namespace fovea::test
