// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vector>

#include <core/filter/filter_check.hpp>
#include <fovea/filter/box.hpp>

namespace fovea::test {
namespace {

int naive_mean(ImageView<const Gray8> src, Border border, Size element, int x, int y) {
    int sum = 0;
    for (const Gray8 pixel : naive_window(src, border, element, x, y)) sum += pixel;
    const int count = element.width * element.height;
    return (2 * sum + count) / (2 * count);
}

TEST(Box3x3, SpreadsASpikeOverNinePixels) {
    GuardedImage<Gray8> src({5, 5}), dst({5, 5});
    src.fill(Gray8{0});
    src(2, 2) = 90;
    run_filter(box_3x3, box_3x3_scratch({5, 5}), src, Border::replicate, dst);
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 5; ++x) EXPECT_EQ(dst(x, y), x >= 1 && x <= 3 && y >= 1 && y <= 3 ? 10 : 0);
}

TEST(Box3x3, RoundsEverySumToTheNearest) {
    // Sums 0 to 2295 as the first column; all others are zeros.
    for (int sum = 0; sum <= 3 * 255; ++sum) {
        GuardedImage<Gray8> src({3, 3}), dst({3, 3});
        src.fill(Gray8{0});
        int rest = sum;
        for (int i = 0; i < 3; ++i) {
            src(1, i) = static_cast<Gray8>(rest > 255 ? 255 : rest);
            rest -= src(1, i);
        }
        run_filter(box_3x3, box_3x3_scratch({3, 3}), src, Border::zero, dst);
        ASSERT_EQ(dst(1, 1), (2 * sum + 9) / 18);
    }
}

TEST(Box3x3, EqualsTheReferenceOnEverySizeAndBorder) {
    expect_filter<Gray8>(box_3x3, box_3x3_scratch, [](auto src, Border border, int x, int y) {
        return naive_mean(src, border, {3, 3}, x, y);
    });
}

TEST(Box5x5, EqualsTheReferenceOnEverySizeAndBorder) {
    expect_filter<Gray8>(box_5x5, box_5x5_scratch, [](auto src, Border border, int x, int y) {
        return naive_mean(src, border, {5, 5}, x, y);
    });
}

TEST(Box, DividesEverySumExactly) {
    // 9 and 25 by the reciprocals of the fixed sizes.
    for (std::uint32_t sum = 0; sum <= 9 * 255; ++sum) ASSERT_EQ((sum + 4) * 7282 >> 16, (sum + 4) / 9);
    for (std::uint32_t sum = 0; sum <= 25 * 255; ++sum) ASSERT_EQ((sum + 12) * 10486 >> 18, (sum + 12) / 25);
    // Every area up to 255: the quotient by the reciprocal rounded down is right or one too small.
    for (std::uint32_t area = 3; area <= 255; area += 2)
        for (std::uint32_t sum = area / 2; sum <= area * 255 + area / 2; ++sum) {
            const std::uint32_t quotient = sum * (65536 / area) >> 16;
            ASSERT_EQ(quotient + (sum - quotient * area >= area ? 1 : 0), sum / area) << area;
        }
    // Every larger one: the same of the sum in 16ths. A quotient errs most just below and at a multiple of
    // the area.
    for (std::uint32_t width = 1; width <= 63; width += 2)
        for (std::uint32_t height = 1; height <= 63; height += 2)
            for (std::uint32_t mean = 1; mean <= 256; ++mean)
                for (const std::uint32_t sum : {mean * width * height - 1, mean * width * height}) {
                    const std::uint32_t area = width * height;
                    if (area <= 255 || sum > area * 255 + area / 2) continue;
                    const std::uint32_t quotient = (sum >> 4) * ((1 << 20) / area) >> 16;
                    ASSERT_LE((sum >> 4), 65535u);
                    ASSERT_EQ(quotient + (sum - quotient * area >= area), sum / area) << area << " " << sum;
                }
}

TEST(Box, EqualsTheReferenceForEveryElement) {
    for (const Size element :
         {Size{1, 1}, Size{3, 1}, Size{1, 3}, Size{7, 5}, Size{15, 15}, Size{17, 15}, Size{63, 3},
          Size{3, 63}, Size{1, 63}, Size{63, 1}, Size{21, 21}, Size{63, 63}})
        for (const Size size : {Size{1, 1}, Size{1, 9}, Size{9, 1}, Size{5, 4}, Size{33, 7}, Size{131, 17}})
            for (const Border border : all_borders) {
                Random random(43);
                GuardedImage<Gray8> src(size), dst(size);
                src.fill(random);
                if (element.width == 15) src.fill(Gray8{255});
                run_filter([&](auto from, Border b, Span<std::uint8_t> scratch,
                               auto to) { return box(from, element, b, scratch, to); },
                           box_scratch(size), src, border, dst);
                for (int y = 0; y < size.height; ++y)
                    for (int x = 0; x < size.width; ++x)
                        ASSERT_EQ(dst(x, y), naive_mean(src.view(), border, element, x, y))
                            << element.width << "x" << element.height << " at " << x << "," << y << " of "
                            << size.width << "x" << size.height;
            }
}

TEST(Box, KeepsTheFirstRowAndColumnAndDoesNotRoundDown) {
    // The toolkit's AverageFilter left them black for larger windows, and was half a level too dark on
    // average.
    GuardedImage<Gray8> src({16, 16}), dst({16, 16});
    src.fill(Gray8{100});
    src(0, 0) = 125;
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(box_scratch({16, 16})));
    ASSERT_EQ(box(src.view(), {5, 5}, Border::replicate, {scratch.data(), box_scratch({16, 16})}, dst.view()),
              Status::ok);
    EXPECT_EQ(dst(0, 0), 109);  // 9 of 25 pixels are the corner
    EXPECT_EQ(dst(2, 2), 101);  // 1 of them
    EXPECT_EQ(dst(15, 15), 100);
}

}  // namespace
}  // namespace fovea::test
