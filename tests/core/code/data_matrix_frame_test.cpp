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

}  // namespace
}  // namespace fovea::test
