// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/morphology/top_hat.hpp>
#include <support/guarded_image.hpp>
#include <support/naive_reference.hpp>

namespace fovea::test {
namespace {

using Operator = Status (*)(ImageView<const Gray8>, Size, Span<std::uint8_t>, ImageView<Gray8>);

void run(Operator op, std::int64_t scratch_bytes, const GuardedImage<Gray8>& src, Size element,
         GuardedImage<Gray8>& dst) {
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(scratch_bytes));
    ASSERT_EQ(
        op(src.view(), element, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}, dst.view()),
        Status::ok);
}

GuardedImage<Gray8> naive(const GuardedImage<Gray8>& src, Size element, bool lowest) {
    GuardedImage<Gray8> dst(src.view().size());
    for (int y = 0; y < dst.view().height(); ++y)
        for (int x = 0; x < dst.view().width(); ++x)
            dst(x, y) = naive_extreme(src.view(), element, x, y, lowest);
    return dst;
}

TEST(TopHat, KeepsASpeckAndDropsTheSlopeBelowIt) {
    // A ground that rises by 4 a column; the speck of 50 stays, the slope goes but for its upper end.
    GuardedImage<Gray8> src({12, 7}), dst({12, 7});
    for (int y = 0; y < 7; ++y)
        for (int x = 0; x < 12; ++x) src(x, y) = static_cast<Gray8>(4 * x + (x == 5 && y == 3 ? 50 : 0));
    run(top_hat, top_hat_scratch({12, 7}), src, {3, 3}, dst);
    for (int y = 0; y < 7; ++y)
        for (int x = 0; x < 12; ++x)
            EXPECT_EQ(dst(x, y), x == 5 && y == 3 ? 50 : x == 11 ? 4 : 0) << x << "," << y;
}

TEST(BlackHat, KeepsADarkScratch) {
    GuardedImage<Gray8> src({9, 9}), dst({9, 9});
    src.fill(Gray8{200});
    for (int x = 1; x < 8; ++x) src(x, 4) = 120;
    run(black_hat, black_hat_scratch({9, 9}), src, {3, 3}, dst);
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 9; ++x) EXPECT_EQ(dst(x, y), y == 4 && x >= 1 && x < 8 ? 80 : 0);
}

TEST(MorphologicalGradient, IsTheRimOfASquare) {
    GuardedImage<Gray8> src({9, 9}), dst({9, 9});
    src.fill(Gray8{10});
    for (int y = 3; y <= 5; ++y)
        for (int x = 3; x <= 5; ++x) src(x, y) = 110;
    run(morphological_gradient, morphological_gradient_scratch({9, 9}), src, {3, 3}, dst);
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 9; ++x) {
            const bool near = x >= 2 && x <= 6 && y >= 2 && y <= 6;
            EXPECT_EQ(dst(x, y), near && (x != 4 || y != 4) ? 100 : 0);
        }
}

TEST(TopHat, AndItsKinEqualTheReferenceOnEverySizeAndElement) {
    Random random(41);
    std::vector<Size> sizes = test_sizes();
    sizes.push_back({21, 150});  // more rows than are kept between two steps
    for (const Size size : sizes)
        for (const Size element : {Size{1, 1}, Size{3, 3}, Size{5, 7}, Size{63, 63}, Size{1, 15}}) {
            GuardedImage<Gray8> src(size), top(size), black(size), rim(size);
            src.fill(random);
            run(top_hat, top_hat_scratch(size), src, element, top);
            run(black_hat, black_hat_scratch(size), src, element, black);
            run(morphological_gradient, morphological_gradient_scratch(size), src, element, rim);
            const auto low = naive(src, element, true);
            const auto high = naive(src, element, false);
            const auto open = naive(low, element, false);
            const auto close = naive(high, element, true);
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x) {
                    ASSERT_EQ(top(x, y), src(x, y) - open(x, y)) << size.width << "x" << size.height;
                    ASSERT_EQ(black(x, y), close(x, y) - src(x, y));
                    ASSERT_EQ(rim(x, y), high(x, y) - low(x, y));
                }
        }
}

TEST(TopHat, OfATopHatIsItself) {
    Random random(42);
    const Size size{60, 90};
    GuardedImage<Gray8> src(size), once(size), twice(size);
    src.fill(random);
    run(top_hat, top_hat_scratch(size), src, {5, 5}, once);
    run(top_hat, top_hat_scratch(size), once, {5, 5}, twice);
    EXPECT_TRUE(equal(once.view(), twice.view()));
}

TEST(TopHat, RefusesElementsThatHaveNoMiddle) {
    GuardedImage<Gray8> src({8, 8}), dst({8, 8});
    src.fill(Gray8{1});
    dst.fill(Gray8{77});
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(top_hat_scratch({8, 8})));
    for (const auto op : {Operator(top_hat), Operator(black_hat), Operator(morphological_gradient)})
        for (const Size element : {Size{2, 3}, Size{3, 0}, Size{-1, 3}, Size{65, 3}})
            EXPECT_EQ(op(src.view(), element, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())},
                         dst.view()),
                      Status::bad_argument);
    for (int x = 0; x < 8; ++x) EXPECT_EQ(dst(x, 0), 77);
}

}  // namespace
}  // namespace fovea::test
