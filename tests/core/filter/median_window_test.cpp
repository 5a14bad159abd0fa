// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include <core/filter/filter_check.hpp>
#include <fovea/filter/median_window.hpp>

namespace fovea::test {
namespace {

Gray8 naive_median(ImageView<const Gray8> src, Border border, Size size, int x, int y) {
    std::vector<Gray8> pixels = naive_window(src, border, size, x, y);
    const auto middle = pixels.begin() + static_cast<std::ptrdiff_t>(pixels.size() / 2);
    std::nth_element(pixels.begin(), middle, pixels.end());
    return *middle;
}

Status run_median(const GuardedImage<Gray8>& src, Size window, Border border, GuardedImage<Gray8>& dst) {
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(median_scratch(src.view().size(), window)),
                                      0xee);
    return median(src.view(), window, border, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())},
                  dst.view());
}

TEST(Median, OfAColumnOfThreeIsTheMiddleOne) {
    GuardedImage<Gray8> src({2, 3}), dst({2, 3});
    const Gray8 pixels[3][2] = {{9, 200}, {4, 100}, {7, 17}};
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 2; ++x) src(x, y) = pixels[y][x];
    ASSERT_EQ(run_median(src, {1, 3}, Border::replicate, dst), Status::ok);
    const Gray8 expected[3][2] = {{9, 200}, {7, 100}, {7, 17}};
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 2; ++x) EXPECT_EQ(dst(x, y), expected[y][x]);
}

TEST(Median, EqualsTheReferenceForWindowsOfEveryKind) {
    Random random(81);
    for (const Size window : {Size{1, 1}, Size{7, 7}, Size{1, 5}, Size{5, 1}, Size{9, 3}, Size{3, 3},
                              Size{5, 5}, Size{15, 15}, Size{63, 1}, Size{1, 63}, Size{31, 31}})
        for (const Size size : test_sizes())
            for (const Border border : all_borders)
                for (const int filling : {0, 1, 2}) {
                    if (window.area() > 100 && size.area() > 1200) continue;
                    GuardedImage<Gray8> src(size), dst(size);
                    src.fill(random);
                    for (int y = 0; y < size.height; ++y)
                        for (int x = 0; x < size.width; ++x) {
                            if (filling == 1) src(x, y) = static_cast<Gray8>(x * 3 + y + src(x, y) % 9);
                            if (filling == 2) src(x, y) = src(x, y) < 128 ? 0 : 255;
                        }
                    ASSERT_EQ(run_median(src, window, border, dst), Status::ok);
                    for (int y = 0; y < size.height; ++y)
                        for (int x = 0; x < size.width; ++x)
                            ASSERT_EQ(int{dst(x, y)}, int{naive_median(src.view(), border, window, x, y)})
                                << size.width << "x" << size.height << " window " << window.width << "x"
                                << window.height << " border " << static_cast<int>(border) << " at " << x
                                << "," << y;
                }
}

TEST(Median, EqualsTheReferenceAcrossStripes) {
    Random random(82);
    const Size size{150, 21};
    for (const Size window : {Size{63, 63}, Size{31, 7}, Size{7, 31}}) {
        GuardedImage<Gray8> src(size), dst(size);
        src.fill(random);
        ASSERT_EQ(run_median(src, window, Border::reflect_101, dst), Status::ok);
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x)
                ASSERT_EQ(int{dst(x, y)}, int{naive_median(src.view(), Border::reflect_101, window, x, y)});
    }
}

TEST(Median, OfAnInvertedImageIsTheInvertedMedian) {
    Random random(83);
    const Size size{130, 20};
    GuardedImage<Gray8> src(size), inverse(size), dst(size), other(size);
    src.fill(random);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) inverse(x, y) = static_cast<Gray8>(255 - src(x, y));
    ASSERT_EQ(run_median(src, {11, 9}, Border::replicate, dst), Status::ok);
    ASSERT_EQ(run_median(inverse, {11, 9}, Border::replicate, other), Status::ok);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) ASSERT_EQ(dst(x, y), 255 - other(x, y));
}

TEST(Median, KeepsALineOfALaserAndTakesOutTheSpecksBesideIt) {
    const Size size{40, 9};
    GuardedImage<Gray8> src(size), dst(size);
    src.fill(Gray8{10});
    for (int x = 0; x < size.width; ++x) src(x, 4) = 250;
    src(7, 2) = 255;
    src(20, 4) = 0;
    ASSERT_EQ(run_median(src, {5, 1}, Border::replicate, dst), Status::ok);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) EXPECT_EQ(dst(x, y), y == 4 ? 250 : 10);
}

TEST(Median, SaysWhatIsWrong) {
    std::vector<std::uint8_t> bytes(100000);
    const Span<std::uint8_t> scratch(bytes.data(), 100000);
    GuardedImage<Gray8> src({40, 8}), dst({40, 8}), small({39, 8});
    dst.fill(Gray8{3});
    EXPECT_EQ(median({}, {7, 7}, Border::zero, scratch, dst.view()), Status::empty_image);
    EXPECT_EQ(median(src.view(), {7, 7}, Border::zero, scratch, small.view()), Status::size_mismatch);
    for (const Size window :
         {Size{0, 7}, Size{7, 0}, Size{-1, 7}, Size{6, 7}, Size{7, 8}, Size{65, 7}, Size{7, 65}}) {
        EXPECT_EQ(median(src.view(), window, Border::zero, scratch, dst.view()), Status::bad_argument);
        EXPECT_EQ(median_scratch({40, 8}, window), 0);
    }
    for (const Size window : {Size{3, 3}, Size{5, 5}, Size{7, 9}}) {
        const std::int64_t needed = median_scratch({40, 8}, window);
        EXPECT_EQ(median(src.view(), window, Border::zero,
                         scratch.first(static_cast<std::ptrdiff_t>(needed - 1)), dst.view()),
                  Status::scratch_too_small);
    }
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 40; ++x) EXPECT_EQ(dst(x, y), 3);
}

}  // namespace
}  // namespace fovea::test
