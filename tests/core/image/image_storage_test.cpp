// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <type_traits>

#include <fovea/image/image_storage.hpp>

namespace fovea::test {
namespace {

TEST(ImageStorage, IsZeroAtFirstWithRowsWithoutGaps) {
    static ImageStorage<Gray16, 5, 3> storage;
    const ImageView<Gray16> view = storage.view();
    EXPECT_EQ(view.size(), (Size{5, 3}));
    EXPECT_EQ(view.stride_bytes(), 10);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 5; ++x) EXPECT_EQ(view(x, y), 0);
    EXPECT_EQ(view.row(1), view.row(0) + 5);
    static_assert(sizeof(storage) == 30);
}

TEST(ImageStorage, IsChangedThroughItsView) {
    ImageStorage<Rgb888, 2, 2> storage;
    storage.view()(1, 1) = {1, 2, 3};
    const ImageStorage<Rgb888, 2, 2>& constant = storage;
    static_assert(std::is_same_v<decltype(constant.view()), ImageView<const Rgb888>>);
    EXPECT_EQ(constant.view()(1, 1), (Rgb888{1, 2, 3}));
    EXPECT_EQ(constant.view()(0, 1), (Rgb888{0, 0, 0}));
    EXPECT_EQ(constant.view().first(), storage.view().first());
}

TEST(ImageStorage, IsACopyWhenCopied) {
    ImageStorage<Gray8, 2, 1> storage;
    storage.view()(0, 0) = 7;
    ImageStorage<Gray8, 2, 1> copy = storage;
    storage.view()(0, 0) = 9;
    EXPECT_EQ(copy.view()(0, 0), 7);
}

TEST(ImageStorage, MayBeOneRowOfTheLongestSide) {
    static ImageStorage<Gray8, max_image_side, 1> row;
    row.view()(max_image_side - 1, 0) = 1;
    EXPECT_EQ(row.view().row(0)[max_image_side - 1], 1);
}

}  // namespace
}  // namespace fovea::test
