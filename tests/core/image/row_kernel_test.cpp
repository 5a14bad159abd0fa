// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/image/row_kernel.hpp>
#include <fovea/morphology/morphology.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

/// Sums the middle column of a 3-row window: shows which rows a kernel sees.
struct ColumnSum {
    using Input = Gray8;
    using Output = Gray16;
    int rows() const { return 3; }
    void operator()(const RowWindow<Gray8>& window, Gray16* dst) {
        for (int x = 0; x < window.width(); ++x)
            dst[x] = static_cast<Gray16>(window[0][x] * 100 + window[1][x] * 10 + window[2][x]);
    }
};

TEST(ForEachRow, ReplacesRowsBeyondTheImage) {
    GuardedImage<Gray8> src({1, 3});
    for (int y = 0; y < 3; ++y) src(0, y) = static_cast<Gray8>(y + 1);
    GuardedImage<Gray16> dst({1, 3});
    ColumnSum kernel;
    for_each_row(src.view(), Border::replicate, kernel, dst.view());
    EXPECT_EQ(dst(0, 0), 112);
    EXPECT_EQ(dst(0, 1), 123);
    EXPECT_EQ(dst(0, 2), 233);
    for_each_row(src.view(), Border::reflect_101, kernel, dst.view());
    EXPECT_EQ(dst(0, 0), 212);
    EXPECT_EQ(dst(0, 2), 232);
}

TEST(BorderIndex, ReflectsWindowsLargerThanTheImage) {
    EXPECT_EQ(border_index(Border::reflect_101, -3, 3), 1);
    EXPECT_EQ(border_index(Border::reflect_101, -4, 3), 0);
    EXPECT_EQ(border_index(Border::reflect_101, 7, 3), 1);
    EXPECT_EQ(border_index(Border::reflect_101, 5, 1), 0);
    EXPECT_EQ(border_index(Border::replicate, -9, 3), 0);
    EXPECT_EQ(border_index(Border::replicate, 9, 3), 2);
}

/// One kernel, three ways: the frame, strips of it, and a stream that holds no more than the window.
TEST(RowKernel, GivesTheSameBitsForFramesStripsAndStreams) {
    Random random(11);
    const Size size{131, 40};
    const Size element{5, 7};
    GuardedImage<Gray8> src(size), frame(size), strips(size), stream(size);
    src.fill(random);
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(erode_scratch(size)));
    kernels::ExtremeRow<kernels::Lowest> kernel(
        element, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}, size.width);
    for_each_row(src.view(), Border::replicate, kernel, frame.view());

    for (int first = 0; first < size.height; first += 9) {
        const int last = std::min(first + 8, size.height - 1);
        const auto strip = strips.view().crop({0, first, size.width, last - first + 1});
        for_each_row(src.view(), Border::replicate, first, last, kernel, *strip);
    }
    EXPECT_TRUE(equal(frame.view(), strips.view()));

    // A ring of seven rows; row y is made as soon as row y + 3 has come.
    std::vector<Gray8> ring(static_cast<std::size_t>(element.height * size.width));
    const auto slot = [&](int y) { return ring.data() + (y % element.height) * size.width; };
    for (int arrived = 0; arrived < size.height + 3; ++arrived) {
        if (arrived < size.height) std::copy_n(src.view().row(arrived), size.width, slot(arrived));
        const int y = arrived - 3;
        if (y < 0) continue;
        const Gray8* window[7];
        for (int i = 0; i < 7; ++i) window[i] = slot(border_index(Border::replicate, y - 3 + i, size.height));
        kernel(RowWindow<Gray8>(window, 7, size.width), stream.view().row(y));
    }
    EXPECT_TRUE(equal(frame.view(), stream.view()));
}

}  // namespace
}  // namespace fovea::test
