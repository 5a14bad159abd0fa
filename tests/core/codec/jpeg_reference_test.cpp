// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include <fovea/base/random.hpp>

#include "jpeg_pictures.hpp"

namespace fovea::test {
namespace {

void expect_near(int actual, double expected, double tolerance) {
    ASSERT_NEAR(actual, std::clamp(expected, 0.0, 255.0), tolerance);
}

/// Samples differ from the definition by 1 at most, chroma between samples by 1/2 more, and a level by the
/// rounding of 1/2: 1 for gray, 1 + 1.772 * 1.5 + 0.5 for the colour with the largest factor.
constexpr double gray_tolerance = 1;
constexpr double colour_tolerance = 4.2;

void expect_equal_to_reference(RandomPicture& picture) {
    GuardedImage<Gray8> gray(picture.size);
    GuardedImage<Rgb888> rgb(picture.size);
    ASSERT_EQ(decode_with_scratch(picture.file.bytes, gray), Status::ok);
    ASSERT_EQ(decode_with_scratch(picture.file.bytes, rgb), Status::ok);
    for (int y = 0; y < picture.size.height; ++y)
        for (int x = 0; x < picture.size.width; ++x) {
            SCOPED_TRACE(testing::Message() << "at " << x << "," << y);
            ASSERT_NO_FATAL_FAILURE(expect_near(gray(x, y), picture.at(0, x, y), gray_tolerance));
            if (picture.components == 1) {
                ASSERT_EQ(rgb(x, y), (Rgb888{gray(x, y), gray(x, y), gray(x, y)}));
                continue;
            }
            const double blue = picture.full_size(1, x, y) - 128;
            const double red = picture.full_size(2, x, y) - 128;
            const int luma = picture.at(0, x, y);
            ASSERT_NO_FATAL_FAILURE(expect_near(rgb(x, y).red, luma + 1.402 * red, colour_tolerance));
            ASSERT_NO_FATAL_FAILURE(
                expect_near(rgb(x, y).green, luma - 0.344136 * blue - 0.714136 * red, colour_tolerance));
            ASSERT_NO_FATAL_FAILURE(expect_near(rgb(x, y).blue, luma + 1.772 * blue, colour_tolerance));
        }
}

struct Samplings {
    Sampling luma, chroma;
};
const std::vector<Samplings> all_samplings = {{{1, 1}, {1, 1}}, {{2, 1}, {1, 1}}, {{1, 2}, {1, 1}},
                                              {{2, 2}, {1, 1}}, {{2, 2}, {1, 2}}, {{2, 2}, {2, 1}},
                                              {{2, 1}, {2, 1}}, {{1, 2}, {1, 2}}};
const std::vector<Size> sizes = {{1, 1},   {2, 1},   {1, 2},   {3, 3},   {4, 5},   {5, 4},
                                 {7, 8},   {8, 7},   {9, 9},   {15, 16}, {16, 15}, {17, 17},
                                 {23, 40}, {31, 33}, {32, 32}, {47, 18}, {65, 33}};

TEST(DecodeJpeg, EqualsTheReferenceInGray) {
    Random random(50);
    for (const Size size : sizes)
        for (const int restart : {0, 1, 3}) {
            SCOPED_TRACE(testing::Message() << size.width << "x" << size.height << " restart " << restart);
            RandomPicture picture(random, size, 1, {1, 1}, {1, 1}, restart);
            ASSERT_NO_FATAL_FAILURE(expect_equal_to_reference(picture));
        }
}

TEST(DecodeJpeg, EqualsTheReferenceAtEverySamplingAndSize) {
    Random random(51);
    for (const Samplings& factors : all_samplings)
        for (const Size size : sizes)
            for (const int restart : {0, 2}) {
                SCOPED_TRACE(testing::Message()
                             << factors.luma.across << "x" << factors.luma.down << " over "
                             << factors.chroma.across << "x" << factors.chroma.down << ", " << size.width
                             << "x" << size.height << " restart " << restart);
                RandomPicture picture(random, size, 3, factors.luma, factors.chroma, restart);
                ASSERT_NO_FATAL_FAILURE(expect_equal_to_reference(picture));
            }
}

TEST(DecodeJpeg, LeavesRedGreenAndBlueAsTheyAre) {
    Random random(52);
    RandomPicture picture(random, {21, 13}, 3, {1, 1}, {1, 1}, 0, true);
    GuardedImage<Rgb888> rgb({21, 13});
    GuardedImage<Gray8> gray({21, 13});
    ASSERT_EQ(decode_with_scratch(picture.file.bytes, rgb), Status::ok);
    ASSERT_EQ(decode_with_scratch(picture.file.bytes, gray), Status::ok);
    for (int y = 0; y < 13; ++y)
        for (int x = 0; x < 21; ++x) {
            ASSERT_NEAR(rgb(x, y).red, picture.at(0, x, y), 1);
            ASSERT_NEAR(rgb(x, y).green, picture.at(1, x, y), 1);
            ASSERT_NEAR(rgb(x, y).blue, picture.at(2, x, y), 1);
            ASSERT_EQ(gray(x, y), gray_of(rgb(x, y)));
        }
}

TEST(DecodeJpeg, WrapsTheNumbersOfRestartMarkers) {
    Random random(56);
    RandomPicture picture(random, {8 * 19, 8}, 1, {1, 1}, {1, 1}, 1);
    ASSERT_NO_FATAL_FAILURE(expect_equal_to_reference(picture));
}

TEST(JpegScratch, SufficesForEverySampling) {
    for (const Samplings& factors : all_samplings)
        for (const Size size : {Size{1, 1}, Size{16, 16}, Size{17, 9}, Size{640, 480}}) {
            JpegFile file;
            file.quantiser(0, 1).frame(size, 3, factors.luma, factors.chroma).scan(3);
            file.bytes.resize(file.bytes.size() + 10000);
            const Result<PictureInfo> info = inspect_jpeg(span_of(const_cast<const Bytes&>(file.bytes)));
            ASSERT_TRUE(info);
            EXPECT_LE(info->scratch_bytes, jpeg_scratch(size));
            EXPECT_EQ(info->content, PictureContent::rgb888);
        }
    // The largest case has no slack: three components of two blocks below each other.
    static_assert(jpeg_scratch({640, 480}) == jpeg_gray_scratch + 53 * 640,
                  "three times 17 rows and two lines");
    static_assert(jpeg_scratch({640, 480}) < 40000, "VGA takes some tens of kilobytes");
}

}  // namespace
}  // namespace fovea::test
