// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <utility>

#include <fovea/base/random.hpp>
#include <fovea/statistics/colour_histogram.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

TEST(HueSaturationHistogram, LeavesPaleAndDarkPixelsOut) {
    HueSaturationHistogram<18, 8> histogram({100, 50});
    const Hsv888 row[] = {{0, 100, 50},    {0, 99, 200},   {0, 255, 49},
                          {179, 255, 255}, {10, 128, 255}, {255, 255, 255}};
    histogram.add_row(row, 6);
    EXPECT_EQ(histogram.total(), 4u);
    EXPECT_EQ(histogram.at(0, 3), 1u);
    EXPECT_EQ(histogram.at(1, 4), 1u);
    EXPECT_EQ(histogram.at(17, 7), 2u) << "a hue above 179 counts as 179";
    histogram.clear();
    EXPECT_EQ(histogram.total(), 0u);
    histogram.add_row(row, 1);
    EXPECT_EQ(histogram.total(), 1u) << "the floors stay";
}

template <int Hues, int Saturations>
void compare_with_a_map(std::uint64_t seed) {
    Random random(seed);
    for (const Size size : test_sizes()) {
        GuardedImage<Hsv888> src(size);
        src.fill(random);
        HueSaturationHistogram<Hues, Saturations> histogram;
        ASSERT_EQ(histogram_of(src.view(), histogram), Status::ok);
        std::map<std::pair<int, int>, std::uint32_t> expected;
        std::uint32_t total = 0;
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
                const Hsv888 pixel = src(x, y);
                if (pixel.saturation < 32 || pixel.value < 32) continue;
                const int hue = pixel.hue > 179 ? 179 : pixel.hue;
                ++expected[{hue * Hues / 180, pixel.saturation * Saturations / 256}];
                ++total;
            }
        ASSERT_EQ(histogram.total(), total);
        ASSERT_EQ(histogram.size(), Hues * Saturations);
        for (int hue = 0; hue < Hues; ++hue)
            for (int saturation = 0; saturation < Saturations; ++saturation) {
                const std::uint32_t count = expected[std::make_pair(hue, saturation)];
                ASSERT_EQ(histogram.at(hue, saturation), count);
                ASSERT_EQ(histogram[hue * Saturations + saturation], count);
            }
    }
}

TEST(HueSaturationHistogram, CountsEveryColourOnceAtAnyCountOfBins) {
    compare_with_a_map<18, 8>(171);
    compare_with_a_map<16, 16>(172);
    compare_with_a_map<180, 1>(173);
    compare_with_a_map<1, 256>(174);
    compare_with_a_map<7, 5>(175);
}

TEST(HueSaturationHistogram, StaysWhenThereIsNoImage) {
    HueSaturationHistogram<> histogram;
    const Hsv888 pixel{20, 200, 200};
    histogram.add_row(&pixel, 1);
    EXPECT_EQ(histogram_of(ImageView<const Hsv888>(), histogram), Status::empty_image);
    EXPECT_EQ(histogram.total(), 1u);
}

TEST(HueSaturationHistogram, OfRowsAndStripsCountsTheSame) {
    Random random(9);
    GuardedImage<Hsv888> src({37, 9});
    src.fill(random);
    HueSaturationHistogram<18, 8> whole, upper, lower;
    ASSERT_EQ(histogram_of(src.view(), whole), Status::ok);
    upper.add_row(src.view().row(0), 37);
    ASSERT_EQ(upper.begin({37, 9}), Status::ok);
    EXPECT_EQ(upper.total(), 0u);
    for (int y = 0; y < 9; ++y) (y < 4 ? upper : lower).add_row(src.view().row(y), 37, y);
    upper.merge(lower);
    for (int bin = 0; bin < whole.size(); ++bin) ASSERT_EQ(upper[bin], whole[bin]);
}

}  // namespace
}  // namespace fovea::test
