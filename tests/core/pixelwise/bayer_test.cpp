// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdlib>

#include <fovea/base/random.hpp>
#include <fovea/pixelwise/bayer.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

constexpr BayerPattern patterns[] = {BayerPattern::rggb, BayerPattern::grbg, BayerPattern::gbrg,
                                     BayerPattern::bggr};

/// The letter of the colour that the sensor sees at a place.
char seen(BayerPattern pattern, int x, int y) {
    const char* letters[] = {"rggb", "grbg", "gbrg", "bggr"};
    return letters[static_cast<int>(pattern)][2 * (y & 1) + (x & 1)];
}

int mirrored(int index, int count) {
    return index < 0 ? -index : index >= count ? 2 * count - 2 - index : index;
}

/// The mean of the nearest pixels of a colour: itself, those beside, or those at the corners.
int naive_channel(ImageView<const Gray8> src, BayerPattern pattern, int x, int y, char colour) {
    for (const int distance : {0, 1, 2}) {
        int sum = 0;
        int count = 0;
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx)
                if (std::abs(dx) + std::abs(dy) == distance &&
                    seen(pattern, x + dx + 2, y + dy + 2) == colour) {
                    sum += src(mirrored(x + dx, src.width()), mirrored(y + dy, src.height()));
                    ++count;
                }
        if (count > 0) return (2 * sum + count) / (2 * count);
    }
    return -1;
}

TEST(Demosaic, MeansTheNearestPixelsByHand) {
    // R G R    10 20 30
    // G B G    40 50 60
    // R G R    70 80 90
    GuardedImage<Gray8> src({3, 3});
    GuardedImage<Rgb888> dst({3, 3});
    for (int i = 0; i < 9; ++i) src(i % 3, i / 3) = static_cast<Gray8>(10 * (i + 1));
    ASSERT_EQ(demosaic(src.view(), BayerPattern::rggb, dst.view()), Status::ok);
    EXPECT_EQ(dst(1, 1), (Rgb888{50, 50, 50}));
    EXPECT_EQ(dst(1, 0), (Rgb888{20, 20, 50}));
    EXPECT_EQ(dst(0, 1), (Rgb888{40, 40, 50}));
    // Mirrored: green 20 + 20 + 40 + 40 over 4, blue 4 times 50.
    EXPECT_EQ(dst(0, 0), (Rgb888{10, 30, 50}));
    EXPECT_EQ(dst(2, 2), (Rgb888{90, 70, 50}));
}

TEST(Demosaic, EqualsTheReferenceForEveryPatternAndSize) {
    Random random(341);
    for (const BayerPattern pattern : patterns)
        for (const Size size : test_sizes()) {
            if (size.width < 2 || size.height < 2) continue;
            GuardedImage<Gray8> src(size);
            GuardedImage<Rgb888> dst(size);
            src.fill(random);
            ASSERT_EQ(demosaic(src.view(), pattern, dst.view()), Status::ok);
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x) {
                    ASSERT_EQ(dst(x, y).red, naive_channel(src.view(), pattern, x, y, 'r')) << x << " " << y;
                    ASSERT_EQ(dst(x, y).green, naive_channel(src.view(), pattern, x, y, 'g'))
                        << x << " " << y;
                    ASSERT_EQ(dst(x, y).blue, naive_channel(src.view(), pattern, x, y, 'b')) << x << " " << y;
                }
        }
}

TEST(Demosaic, KeepsWhatTheSensorSawAlsoAtTheBorder) {
    Random random(342);
    GuardedImage<Gray8> src({40, 6});
    GuardedImage<Rgb888> dst({40, 6});
    src.fill(random);
    for (const BayerPattern pattern : patterns) {
        ASSERT_EQ(demosaic(src.view(), pattern, dst.view()), Status::ok);
        for (int y = 0; y < 6; ++y)
            for (int x = 0; x < 40; ++x) {
                const char colour = seen(pattern, x, y);
                ASSERT_EQ(colour == 'r'   ? dst(x, y).red
                          : colour == 'g' ? dst(x, y).green
                                          : dst(x, y).blue,
                          src(x, y));
            }
    }
}

TEST(Demosaic, GivesAnEvenColourEverywhere) {
    GuardedImage<Gray8> src({37, 9});
    GuardedImage<Rgb888> dst({37, 9}), half({18, 4});
    for (const BayerPattern pattern : patterns) {
        for (int y = 0; y < 9; ++y)
            for (int x = 0; x < 37; ++x) {
                const char colour = seen(pattern, x, y);
                src(x, y) = colour == 'r' ? 200 : colour == 'g' ? 100 : 255;
            }
        ASSERT_EQ(demosaic(src.view(), pattern, dst.view()), Status::ok);
        for (int y = 0; y < 9; ++y)
            for (int x = 0; x < 37; ++x) ASSERT_EQ(dst(x, y), (Rgb888{200, 100, 255}));
        ASSERT_EQ(demosaic_half(src.view(), pattern, half.view()), Status::ok);
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 18; ++x) ASSERT_EQ(half(x, y), (Rgb888{200, 100, 255}));
    }
}

TEST(DemosaicHalf, EqualsTheReferenceForEveryPatternAndSize) {
    Random random(343);
    for (const BayerPattern pattern : patterns)
        for (const Size size : test_sizes()) {
            if (size.width < 2 || size.height < 2) continue;
            GuardedImage<Gray8> src(size);
            GuardedImage<Rgb888> dst(half_size(size));
            src.fill(random);
            ASSERT_EQ(demosaic_half(src.view(), pattern, dst.view()), Status::ok);
            for (int y = 0; y < size.height / 2; ++y)
                for (int x = 0; x < size.width / 2; ++x) {
                    int sum[256] = {};
                    for (const int i : {0, 1, 2, 3})
                        sum[static_cast<unsigned char>(seen(pattern, i % 2, i / 2))] +=
                            src(2 * x + i % 2, 2 * y + i / 2);
                    ASSERT_EQ(dst(x, y).red, sum[static_cast<unsigned char>('r')]);
                    ASSERT_EQ(dst(x, y).green, (sum[static_cast<unsigned char>('g')] + 1) / 2);
                    ASSERT_EQ(dst(x, y).blue, sum[static_cast<unsigned char>('b')]);
                }
        }
}

TEST(Demosaic, RefusesOneColumnAndOneRow) {
    GuardedImage<Gray8> column({1, 4}), row({4, 1});
    GuardedImage<Rgb888> dst_column({1, 4}), dst_row({4, 1});
    EXPECT_EQ(demosaic(column.view(), BayerPattern::rggb, dst_column.view()), Status::bad_argument);
    EXPECT_EQ(demosaic(row.view(), BayerPattern::rggb, dst_row.view()), Status::bad_argument);
    GuardedImage<Gray8> src({5, 4});
    GuardedImage<Rgb888> wrong({3, 2});
    EXPECT_EQ(demosaic_half(src.view(), BayerPattern::rggb, wrong.view()), Status::size_mismatch);
}

}  // namespace
}  // namespace fovea::test
