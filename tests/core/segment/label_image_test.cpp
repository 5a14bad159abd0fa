// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vector>

#include <core/segment/contour_pictures.hpp>
#include <fovea/segment/label_image.hpp>

namespace fovea::test {
namespace {

Result<int> label(const GuardedImage<Gray8>& src, Connectivity connectivity, GuardedImage<Label16>& dst,
                  int pieces = -1) {
    const Size size = src.view().size();
    std::vector<std::uint8_t> scratch(
        static_cast<std::size_t>(pieces < 0 ? label_image_scratch(size) : label_image_scratch(size, pieces)));
    return label_image(src.view(), connectivity,
                       {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}, dst.view());
}

TEST(LabelImage, NumbersRegionsByTheirFirstPixel) {
    // The U is met as two pieces and is one region.
    const auto src = drawn({"#.#.#", "#.#..", "###..", "....#"});
    GuardedImage<Label16> dst({5, 4});
    ASSERT_EQ(*label(src, Connectivity::eight, dst), 3);
    const int expected[4][5] = {{1, 0, 1, 0, 2}, {1, 0, 1, 0, 0}, {1, 1, 1, 0, 0}, {0, 0, 0, 0, 3}};
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 5; ++x) EXPECT_EQ(dst(x, y), expected[y][x]);
}

TEST(LabelImage, EqualsFloodingFromEveryPixel) {
    Random random(35);
    for (int round = 0; round < 200; ++round) {
        const auto src = random_blocks({random.between(1, 60), random.between(1, 40)}, random);
        const Size size = src.view().size();
        const auto connectivity = round % 2 == 0 ? Connectivity::eight : Connectivity::four;
        GuardedImage<Label16> dst(size), expected(size);
        expected.fill(Label16{0});
        int count = 0;
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
                if (src(x, y) == 0 || expected(x, y) != 0) continue;
                std::vector<Point> open = {{x, y}};
                expected(x, y) = static_cast<Label16>(++count);
                while (!open.empty()) {
                    const Point p = open.back();
                    open.pop_back();
                    for (int dy = -1; dy <= 1; ++dy)
                        for (int dx = -1; dx <= 1; ++dx) {
                            const Point q{p.x + dx, p.y + dy};
                            if ((dx != 0 && dy != 0 && connectivity == Connectivity::four) ||
                                !src.view().contains(q))
                                continue;
                            if (src(q.x, q.y) == 0 || expected(q.x, q.y) != 0) continue;
                            expected(q.x, q.y) = static_cast<Label16>(count);
                            open.push_back(q);
                        }
                }
            }
        ASSERT_EQ(*label(src, connectivity, dst), count);
        ASSERT_TRUE(equal(dst.view(), expected.view())) << "round " << round;
    }
}

TEST(LabelImage, GoesThroughSpiralsAndCombs) {
    GuardedImage<Label16> wound({61, 61}), teeth({81, 31});
    EXPECT_EQ(*label(spiral(61), Connectivity::four, wound), 1);
    EXPECT_EQ(*label(comb({81, 31}), Connectivity::four, teeth), 1);
    EXPECT_EQ(label(comb({81, 31}), Connectivity::four, teeth, 41).value(), 1);
    EXPECT_EQ(label(comb({81, 31}), Connectivity::four, teeth, 30).status(), Status::capacity_exceeded);
}

TEST(LabelImage, SaysWhatIsWrong) {
    GuardedImage<Gray8> src({4, 4});
    src.fill(Gray8{1});
    GuardedImage<Label16> dst({4, 4}), other({3, 4});
    dst.fill(Label16{77});
    std::uint8_t scratch[128];
    EXPECT_EQ(label_image({}, Connectivity::four, scratch, dst.view()).status(), Status::empty_image);
    EXPECT_EQ(label_image(src.view(), Connectivity::four, scratch, other.view()).status(),
              Status::size_mismatch);
    EXPECT_EQ(label_image(src.view(), Connectivity::four, Span<std::uint8_t>(scratch).first(10), dst.view())
                  .status(),
              Status::scratch_too_small);
    EXPECT_EQ(dst(0, 0), 77);
}

}  // namespace
}  // namespace fovea::test
