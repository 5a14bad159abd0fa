// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fovea/code/data_matrix_clarity.hpp>
#include <support/data_matrix_scene.hpp>

namespace fovea::test {
namespace {

TEST(DataMatrixClarity, BringsAMovedCornerBack) {
    DataMatrixScene scene;
    DrawnImage image = draw(scene);
    const auto frame = frame_of(image.view());
    ASSERT_TRUE(frame.ok());
    const detail::CodeField field(image.view(), false);
    const DataMatrixSize& size = *data_matrix_size(16, 16);
    detail::DataMatrixFrame moved = *frame;
    moved.opposite.x += 700;
    moved.opposite.y -= 500;
    detail::WorkBudget budget(image.view().size(), 4, 1 << 20);
    EXPECT_TRUE(detail::make_clearer(field, size, moved, budget));
    EXPECT_LT(magnitude(moved.opposite.x - frame->opposite.x), 512U);
    EXPECT_LT(magnitude(moved.opposite.y - frame->opposite.y), 512U);
    EXPECT_NEAR(detail::module_of(*frame, size), 1024, 8);
}

TEST(DataMatrixClarity, EndsWithTheWorkThatMayBeDone) {
    DataMatrixScene scene;
    DrawnImage image = draw(scene);
    const auto frame = frame_of(image.view());
    ASSERT_TRUE(frame.ok());
    const detail::CodeField field(image.view(), false);
    const DataMatrixSize& size = *data_matrix_size(16, 16);
    const int look = detail::border_modules(size);
    detail::DataMatrixFrame moved = *frame;
    moved.corner.x += 700;
    // The corner comes last. Two looks are done, and a third that is begun.
    detail::WorkBudget budget(2 * look + 1);
    EXPECT_FALSE(detail::make_clearer(field, size, moved, budget));
    EXPECT_EQ(budget.left(), 1 - look);
    EXPECT_EQ(moved.corner.x, frame->corner.x + 700);
    // The first move would make it clearer; the work is spent with the look at where it is.
    moved = *frame;
    moved.opposite.x -= 700;
    detail::WorkBudget least(1);
    EXPECT_FALSE(detail::make_clearer(field, size, moved, least));
    EXPECT_EQ(moved.opposite.x, frame->opposite.x - 700);
    least = detail::WorkBudget(look + 1);
    EXPECT_TRUE(detail::make_clearer(field, size, moved, least));
    EXPECT_GT(moved.opposite.x, frame->opposite.x - 700);
}

}  // namespace
}  // namespace fovea::test
