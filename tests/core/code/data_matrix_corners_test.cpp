// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/code/data_matrix_corners.hpp>

namespace fovea::test {
namespace {

using detail::BorderCorner;
using detail::CodeField;
using detail::PassedSides;

/// The corners that a row of an image meets.
std::vector<BorderCorner> corners_of(ImageView<const Gray8> image, bool inverted, int y) {
    std::vector<BitWord> words(static_cast<std::size_t>(PassedSides::words(image.size())));
    const PassedSides passed({words.data(), static_cast<std::ptrdiff_t>(words.size())}, image.size());
    std::vector<BorderCorner> room(64);
    int count = 0;
    const std::int64_t steps =
        scan_row_for_corners(CodeField(image, inverted), y, 0, image.width() - 1, 24, 1 << 20, passed,
                             ListView<BorderCorner>(room.data(), 64, &count));
    EXPECT_GE(steps, image.width());
    room.resize(static_cast<std::size_t>(count));
    return room;
}

TEST(DataMatrixCorners, AreThoseOfADarkRectangle) {
    std::vector<std::uint8_t> pixels(60 * 40, 200);
    const ImageView<Gray8> image(pixels.data(), {60, 40}, 60);
    for (int y = 10; y < 30; ++y)
        for (int x = 10; x < 50; ++x) image(x, y) = 40;
    const auto corners = corners_of(image, false, 20);
    ASSERT_EQ(corners.size(), 4U);
    for (const BorderCorner& corner : corners) {
        EXPECT_NEAR(corner.threshold, 120, 1);
        // The way turns clockwise, and both pieces come near a corner.
        EXPECT_GT(corner.in.x() * corner.out.y() - corner.in.y() * corner.out.x(), 0);
        const Point p = corner.in.last;
        EXPECT_TRUE(p.x < 13 || p.x > 46);
        EXPECT_TRUE(p.y < 13 || p.y > 26);
    }
    EXPECT_TRUE(corners_of(image, false, 5).empty());
    // Seen as light on dark the same border turns the other way, but for the image's own.
    for (std::uint8_t& pixel : pixels) pixel = static_cast<std::uint8_t>(255 - pixel);
    EXPECT_EQ(corners_of(image, true, 20).size(), 4U);
}

TEST(DataMatrixCorners, StepsAreBoundedInNoise) {
    Random random(3);
    std::vector<std::uint8_t> pixels(100 * 80);
    for (std::uint8_t& pixel : pixels) pixel = static_cast<std::uint8_t>(random.between(0, 255));
    EXPECT_LE(corners_of({pixels.data(), {100, 80}, 100}, false, 40).size(), 64U);
    EXPECT_TRUE(corners_of({pixels.data(), {1, 1}, 1}, false, 0).empty());
    // No border is begun when as many steps were walked as may be.
    const ImageView<const Gray8> image(pixels.data(), {100, 80}, 100);
    std::vector<BitWord> words(static_cast<std::size_t>(PassedSides::words(image.size())));
    const PassedSides passed({words.data(), static_cast<std::ptrdiff_t>(words.size())}, image.size());
    std::vector<BorderCorner> room(64);
    int count = 0;
    const ListView<BorderCorner> list(room.data(), 64, &count);
    EXPECT_EQ(scan_row_for_corners(CodeField(image, false), 40, 0, 99, 24, 100, passed, list), 100);
    EXPECT_EQ(count, 0);
}

}  // namespace
}  // namespace fovea::test
