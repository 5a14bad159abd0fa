// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/statistics/integral_image.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

/// The sum of value(pixel) over the pixels left of x and above y.
template <class Value>
std::uint64_t naive_sum(const GuardedImage<Gray8>& src, int x, int y, Value value) {
    std::uint64_t sum = 0;
    for (int j = 0; j < y; ++j)
        for (int i = 0; i < x; ++i) sum += value(src(i, j));
    return sum;
}

TEST(IntegralImage, OfTwoByTwoPixelsByHand) {
    GuardedImage<Gray8> src({2, 2});
    GuardedImage<Sum32> dst({3, 3});
    src(0, 0) = 1;
    src(1, 0) = 2;
    src(0, 1) = 30;
    src(1, 1) = 0;
    ASSERT_EQ(integral_image(src.view(), dst.view()), Status::ok);
    const Sum32 expected[3][3] = {{0, 0, 0}, {0, 1, 3}, {0, 31, 33}};
    const Sum32 counts[3][3] = {{0, 0, 0}, {0, 1, 2}, {0, 2, 3}};
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 3; ++x) EXPECT_EQ(dst(x, y), expected[y][x]);
    ASSERT_EQ(integral_of_binary(src.view(), dst.view()), Status::ok);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 3; ++x) EXPECT_EQ(dst(x, y), counts[y][x]);
}

TEST(IntegralImage, EqualsTheSlowSumsOnEverySize) {
    Random random(151);
    for (const Size size : {Size{1, 1}, Size{1, 9}, Size{9, 1}, Size{5, 4}, Size{16, 8}, Size{17, 9},
                            Size{33, 17}, Size{70, 23}}) {
        GuardedImage<Gray8> src(size);
        GuardedImage<Sum32> sums(integral_size(size)), counts(integral_size(size));
        GuardedImage<Sum64> squares(integral_size(size));
        src.fill(random);
        for (int x = 0; x < size.width; x += 3) src(x, 0) = 0;
        ASSERT_EQ(integral_image(src.view(), sums.view()), Status::ok);
        ASSERT_EQ(integral_of_binary(src.view(), counts.view()), Status::ok);
        ASSERT_EQ(integral_of_squares(src.view(), squares.view()), Status::ok);
        for (int y = 0; y <= size.height; ++y)
            for (int x = 0; x <= size.width; ++x) {
                ASSERT_EQ(sums(x, y),
                          naive_sum(src, x, y, [](int v) { return static_cast<std::uint64_t>(v); }));
                ASSERT_EQ(counts(x, y), naive_sum(src, x, y, [](int v) { return std::uint64_t{v != 0}; }));
                ASSERT_EQ(squares(x, y),
                          naive_sum(src, x, y, [](int v) { return static_cast<std::uint64_t>(v * v); }));
            }
    }
}

TEST(IntegralImage, GivesItsImageBack) {
    Random random(152);
    for (const Size size : test_sizes()) {
        GuardedImage<Gray8> src(size), back(size);
        GuardedImage<Sum32> sums(integral_size(size));
        src.fill(random);
        ASSERT_EQ(integral_image(src.view(), sums.view()), Status::ok);
        ASSERT_EQ(image_of_integral(sums.view(), back.view()), Status::ok);
        EXPECT_TRUE(equal(src.view(), back.view()));
    }
}

TEST(RectangleSum, IsThatOfEveryRectangle) {
    Random random(153);
    const Size size{9, 6};
    GuardedImage<Gray8> src(size);
    GuardedImage<Sum32> sums(integral_size(size));
    GuardedImage<Sum64> squares(integral_size(size));
    src.fill(random);
    ASSERT_EQ(integral_image(src.view(), sums.view()), Status::ok);
    ASSERT_EQ(integral_of_squares(src.view(), squares.view()), Status::ok);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            for (int height = 1; height <= size.height - y; ++height)
                for (int width = 1; width <= size.width - x; ++width) {
                    std::uint32_t sum = 0;
                    std::uint64_t square_sum = 0;
                    for (int j = y; j < y + height; ++j)
                        for (int i = x; i < x + width; ++i) {
                            sum += src(i, j);
                            square_sum += static_cast<std::uint64_t>(src(i, j) * src(i, j));
                        }
                    const Rectangle area{x, y, width, height};
                    ASSERT_EQ(*rectangle_sum(ImageView<const Sum32>(sums.view()), area), sum);
                    ASSERT_EQ(*rectangle_sum(ImageView<const Sum64>(squares.view()), area), square_sum);
                    ASSERT_EQ(rectangle_sum_unchecked(sums.view(), area), sum);
                }
}

TEST(RectangleSum, RefusesWhatIsNotInside) {
    GuardedImage<Sum32> sums({5, 4});
    sums.fill(Sum32{0});
    const ImageView<const Sum32> view = sums.view();
    EXPECT_EQ(rectangle_sum(ImageView<const Sum32>(), {0, 0, 1, 1}).status(), Status::empty_image);
    EXPECT_EQ(rectangle_sum(view, {0, 0, 0, 1}).status(), Status::empty_image);
    EXPECT_TRUE(rectangle_sum(view, {0, 0, 4, 3}).ok());
    constexpr int huge = 2147483647;
    for (const Rectangle area :
         {Rectangle{-1, 0, 1, 1}, Rectangle{0, -1, 1, 1}, Rectangle{0, 0, 5, 1}, Rectangle{0, 0, 1, 4},
          Rectangle{4, 0, 1, 1}, Rectangle{1, 1, huge, 1}, Rectangle{huge, huge, huge, huge}})
        EXPECT_EQ(rectangle_sum(view, area).status(), Status::out_of_range);
}

// The toolkit's sums of 32 bits with a sign overflowed above 8.4 million pixels.
TEST(RectangleSum, IsRightThoughTheSumsBeginAgainAtZero) {
    const Size size{32767, 520};
    std::vector<Gray8> pixels(static_cast<std::size_t>(size.area()), 255);
    std::vector<Sum32> sums(static_cast<std::size_t>(integral_size(size).area()));
    const ImageView<const Gray8> src(pixels.data(), size, size.width);
    const ImageView<Sum32> integral(sums.data(), integral_size(size),
                                    static_cast<std::ptrdiff_t>(sizeof(Sum32)) * (size.width + 1));
    ASSERT_EQ(integral_image(src, integral), Status::ok);
    const ImageView<const Sum32> view = integral;
    EXPECT_EQ(*rectangle_sum(view, {100, 100, 32000, 400}), 32000u * 400u * 255u);
    EXPECT_EQ(*rectangle_sum(view, {32766, 519, 1, 1}), 255u);
}

TEST(IntegralImage, SaysWhatIsWrongForSquaresToo) {
    GuardedImage<Gray8> src({4, 4});
    GuardedImage<Sum64> same({4, 4});
    src.fill(Gray8{1});
    EXPECT_EQ(integral_of_squares(src.view(), same.view()), Status::size_mismatch);
    EXPECT_EQ(integral_of_squares(ImageView<const Gray8>(), same.view()), Status::empty_image);
    GuardedImage<Sum32> line({1, 5});
    line.fill(Sum32{0});
    EXPECT_EQ(image_of_integral(line.view(), src.view()), Status::empty_image);
}

}  // namespace
}  // namespace fovea::test
