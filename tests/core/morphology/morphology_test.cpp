// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/morphology/morphology.hpp>
#include <support/guarded_image.hpp>
#include <support/naive_reference.hpp>

namespace fovea::test {
namespace {

std::vector<std::uint8_t> scratch_of(std::int64_t bytes) {
    return std::vector<std::uint8_t>(static_cast<std::size_t>(bytes));
}
Span<std::uint8_t> span_of(std::vector<std::uint8_t>& bytes) {
    return {bytes.data(), static_cast<std::ptrdiff_t>(bytes.size())};
}

using Operator = Status (*)(ImageView<const Gray8>, Size, Span<std::uint8_t>, ImageView<Gray8>);

/// Runs an operator with exactly the scratch it asks for.
void run(Operator op, std::int64_t scratch_bytes, GuardedImage<Gray8>& src, Size element,
         GuardedImage<Gray8>& dst) {
    std::vector<std::uint8_t> scratch = scratch_of(scratch_bytes);
    ASSERT_EQ(op(src.view(), element, span_of(scratch), dst.view()), Status::ok);
}

TEST(Erode, ShrinksASquareByItsRim) {
    GuardedImage<Gray8> src({7, 7});
    src.fill(Gray8{0});
    for (int y = 2; y <= 4; ++y)
        for (int x = 2; x <= 4; ++x) src(x, y) = 255;
    GuardedImage<Gray8> dst({7, 7});
    run(erode, erode_scratch({7, 7}), src, {3, 3}, dst);
    for (int y = 0; y < 7; ++y)
        for (int x = 0; x < 7; ++x) EXPECT_EQ(dst(x, y), x == 3 && y == 3 ? 255 : 0);
}

TEST(Dilate, SpreadsAPixelOfTheFirstRow) {
    GuardedImage<Gray8> src({5, 4});
    src.fill(Gray8{0});
    src(2, 0) = 255;
    GuardedImage<Gray8> dst({5, 4});
    run(dilate, dilate_scratch({5, 4}), src, {3, 3}, dst);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 5; ++x) EXPECT_EQ(dst(x, y), x >= 1 && x <= 3 && y <= 1 ? 255 : 0);
}

TEST(Morphology, EqualsTheReferenceOnEverySizeAndElement) {
    Random random(7);
    const std::vector<Size> elements = {{1, 1}, {3, 3}, {3, 1}, {1, 3}, {5, 5}, {7, 3}, {63, 63}};
    for (const Size size : test_sizes())
        for (const Size element : elements) {
            GuardedImage<Gray8> src(size);
            src.fill(random);
            GuardedImage<Gray8> low(size);
            GuardedImage<Gray8> high(size);
            run(erode, erode_scratch(size), src, element, low);
            run(dilate, dilate_scratch(size), src, element, high);
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x) {
                    ASSERT_EQ(low(x, y), naive_extreme(src.view(), element, x, y, true))
                        << size.width << "x" << size.height << " element " << element.width << " at " << x
                        << "," << y;
                    ASSERT_EQ(high(x, y), naive_extreme(src.view(), element, x, y, false));
                }
        }
}

TEST(Morphology, ErosionIsBelowTheSourceAndDilationAbove) {
    Random random(8);
    const Size size{65, 9};
    GuardedImage<Gray8> src(size), low(size), high(size), open(size), close(size);
    src.fill(random);
    run(erode, erode_scratch(size), src, {5, 3}, low);
    run(dilate, dilate_scratch(size), src, {5, 3}, high);
    run(opening, opening_scratch(size), src, {5, 3}, open);
    run(closing, closing_scratch(size), src, {5, 3}, close);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            EXPECT_LE(low(x, y), open(x, y));
            EXPECT_LE(open(x, y), src(x, y));
            EXPECT_LE(src(x, y), close(x, y));
            EXPECT_LE(close(x, y), high(x, y));
        }
}

TEST(Opening, TwiceIsTheSameAsOnceAndWorksInPlace) {
    Random random(9);
    const Size size{97, 21};
    GuardedImage<Gray8> src(size), once(size);
    src.fill(random);
    run(opening, opening_scratch(size), src, {3, 5}, once);
    GuardedImage<Gray8> twice = once;
    run(opening, opening_scratch(size), twice, {3, 5}, twice);
    EXPECT_TRUE(equal(once.view(), twice.view()));
}

TEST(Closing, FillsAHoleSmallerThanTheElement) {
    GuardedImage<Gray8> src({9, 9});
    src.fill(Gray8{255});
    src(4, 4) = 0;
    GuardedImage<Gray8> dst({9, 9});
    run(closing, closing_scratch({9, 9}), src, {3, 3}, dst);
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 9; ++x) EXPECT_EQ(dst(x, y), 255);
}

TEST(Opening, KeepsItsRowsThroughATallImage) {
    // More rows than are kept between the two steps, with elements of every height.
    Random random(10);
    const Size size{19, 170};
    for (const Size element : {Size{1, 1}, Size{3, 3}, Size{5, 15}, Size{3, 61}, Size{63, 63}}) {
        GuardedImage<Gray8> src(size), low(size), expected(size), dst(size);
        src.fill(random);
        run(erode, erode_scratch(size), src, element, low);
        run(dilate, dilate_scratch(size), low, element, expected);
        run(opening, opening_scratch(size), src, element, dst);
        EXPECT_TRUE(equal(expected.view(), dst.view())) << element.height;
        run(opening, opening_scratch(size), src, element, src);
        EXPECT_TRUE(equal(expected.view(), src.view())) << element.height;
    }
}

TEST(Dilate, RefusesEvenElementsInsteadOfShrinkingThem) {
    GuardedImage<Gray8> src({9, 9}), dst({9, 9});
    src.fill(Gray8{1});
    std::vector<std::uint8_t> scratch = scratch_of(dilate_scratch({9, 9}));
    for (const int side : {2, 4, 62})
        EXPECT_EQ(dilate(src.view(), {side, side}, span_of(scratch), dst.view()), Status::bad_argument);
}

TEST(Dilate, SaysOkForAnElementOfThree) {
    GuardedImage<Gray8> src({9, 9}), dst({9, 9});
    src.fill(Gray8{1});
    std::vector<std::uint8_t> scratch = scratch_of(dilate_scratch({9, 9}));
    EXPECT_EQ(dilate(src.view(), {3, 3}, span_of(scratch), dst.view()), Status::ok);
    EXPECT_EQ(erode(src.view(), {3, 3}, span_of(scratch), dst.view()), Status::ok);
}

TEST(Morphology, SaysWhatIsWrongAndLeavesTheOutput) {
    GuardedImage<Gray8> src({8, 8}), dst({8, 8}), other({7, 8});
    src.fill(Gray8{1});
    dst.fill(Gray8{77});
    other.fill(Gray8{77});
    for (const auto op : {Operator(erode), Operator(dilate), Operator(opening), Operator(closing)}) {
        std::vector<std::uint8_t> scratch = scratch_of(opening_scratch({8, 8}));
        EXPECT_EQ(op(ImageView<const Gray8>(), {3, 3}, span_of(scratch), dst.view()), Status::empty_image);
        EXPECT_EQ(op(src.view(), {3, 3}, span_of(scratch), other.view()), Status::size_mismatch);
        for (const Size element : {Size{2, 3}, Size{3, 0}, Size{-1, 3}, Size{65, 3}, Size{3, 65}})
            EXPECT_EQ(op(src.view(), element, span_of(scratch), dst.view()), Status::bad_argument);
        std::vector<std::uint8_t> little = scratch_of(erode_scratch({8, 8}) - 1);
        EXPECT_EQ(op(src.view(), {3, 3}, span_of(little), dst.view()), Status::scratch_too_small);
    }
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) EXPECT_EQ(dst(x, y), 77);
}

}  // namespace
}  // namespace fovea::test
