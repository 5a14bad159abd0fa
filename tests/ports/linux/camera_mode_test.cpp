// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <linux/videodev2.h>

#include <initializer_list>
#include <vector>

#include <fovea/linux/camera_mode.hpp>
#include <fovea/linux/video_format.hpp>

namespace fovea::linux_port {
namespace {

using hal::PixelFormat;

CameraMode mode(PixelFormat format, Size size, int interval_us) {
    CameraMode made;
    made.format = format;
    made.smallest = made.largest = size;
    made.interval_us = interval_us;
    return made;
}

CameraChoice choose(const std::vector<CameraMode>& modes, const CameraWish& wish) {
    return choose_mode({modes.data(), static_cast<std::ptrdiff_t>(modes.size())}, wish);
}

/// A common webcam: raw pictures that are slow when they are large, and MJPEG.
const std::vector<CameraMode> webcam = {
    mode(PixelFormat::yuyv, {640, 480}, 33333),    mode(PixelFormat::yuyv, {1280, 720}, 100000),
    mode(PixelFormat::yuyv, {1920, 1080}, 200000), mode(PixelFormat::mjpeg, {640, 480}, 33333),
    mode(PixelFormat::mjpeg, {1280, 720}, 33333),  mode(PixelFormat::mjpeg, {1920, 1080}, 33333),
};

TEST(ChooseMode, TakesTheLargestThatIsFastEnough) {
    CameraWish wish;
    wish.interval_us = 40000;
    const CameraChoice choice = choose(webcam, wish);
    EXPECT_EQ(choice.index, 5);
    EXPECT_EQ(choice.size, (Size{1920, 1080}));
    EXPECT_EQ(choice.reason, CameraReason::best);
}

TEST(ChooseMode, TakesRawPixelsBeforeMjpegWhereTheyAreFastEnough) {
    CameraWish wish;
    wish.size = {1280, 720};
    wish.interval_us = 100000;
    EXPECT_EQ(choose(webcam, wish).index, 1);
    wish.interval_us = 99999;
    EXPECT_EQ(choose(webcam, wish).index, 4);
}

TEST(ChooseMode, NeverTakesAnotherSizeOrFormatThanWishedFor) {
    CameraWish wish;
    wish.size = {800, 600};
    EXPECT_EQ(choose(webcam, wish).index, -1);
    EXPECT_EQ(choose(webcam, wish).reason, CameraReason::no_such_size);
    wish = {};
    wish.format = PixelFormat::gray8;
    EXPECT_EQ(choose(webcam, wish).index, -1);
    EXPECT_EQ(choose(webcam, wish).reason, CameraReason::no_format);
    EXPECT_EQ(choose({}, {}).reason, CameraReason::no_modes);
}

TEST(ChooseMode, TakesTheFastestWhereNoneIsFastEnough) {
    CameraWish wish;
    wish.interval_us = 10000;
    wish.format = PixelFormat::yuyv;
    const CameraChoice choice = choose(webcam, wish);
    EXPECT_EQ(choice.index, 0);
    EXPECT_EQ(choice.reason, CameraReason::slow);
}

TEST(ChooseMode, TakesGrayBeforeLumaBeforeColour) {
    const std::initializer_list<PixelFormat> by_work = {
        PixelFormat::gray8, PixelFormat::nv12,   PixelFormat::yuyv,       PixelFormat::gray10,
        PixelFormat::rgb24, PixelFormat::rgb565, PixelFormat::bayer_rggb, PixelFormat::mjpeg,
    };
    std::vector<CameraMode> modes;
    for (const PixelFormat format : by_work) modes.insert(modes.begin(), mode(format, {640, 480}, 33333));
    while (!modes.empty()) {
        EXPECT_EQ(choose(modes, {}).index, static_cast<int>(modes.size()) - 1);
        modes.pop_back();
    }
}

TEST(ChooseMode, WantsColourWhereColourIsWanted) {
    const std::vector<CameraMode> modes = {mode(PixelFormat::gray8, {640, 480}, 33333),
                                           mode(PixelFormat::nv12, {640, 480}, 33333),
                                           mode(PixelFormat::rgb24, {640, 480}, 33333)};
    CameraWish wish;
    wish.colour = true;
    EXPECT_EQ(choose(modes, wish).index, 2);
    wish.format = PixelFormat::gray8;
    EXPECT_EQ(choose(modes, wish).reason, CameraReason::no_format);
}

TEST(ChooseMode, KnowsRangesOfSizes) {
    CameraMode range = mode(PixelFormat::gray8, {1280, 720}, 16667);
    range.smallest = {320, 180};
    range.step = {8, 2};
    CameraWish wish;
    wish.size = {328, 182};
    EXPECT_EQ(choose({range}, wish).index, 0);
    EXPECT_EQ(choose({range}, wish).size, (Size{328, 182}));
    for (const Size size :
         {Size{330, 182}, Size{328, 183}, Size{312, 182}, Size{1288, 720}, Size{328, 0}, Size{-8, 182}}) {
        wish.size = size;
        EXPECT_EQ(choose({range}, wish).index, -1) << size.width << "x" << size.height;
    }
    wish.size = {};
    EXPECT_EQ(choose({range}, wish).size, (Size{1280, 720}));
}

TEST(ChooseMode, TakesAnUnknownRateForFastEnough) {
    EXPECT_EQ(choose({mode(PixelFormat::gray8, {640, 480}, 0)}, {}).reason, CameraReason::best);
}

TEST(VideoFormat, KnowsEachCodeOnceAndEachFormat) {
    for (int k = 1; k < hal::pixel_formats; ++k) {
        int found = 0;
        for (const VideoFormat& known : video_formats)
            found += known.format == static_cast<PixelFormat>(k) ? 1 : 0;
        EXPECT_GE(found, 1) << hal::describe(static_cast<PixelFormat>(k));
    }
    for (const VideoFormat& known : video_formats) EXPECT_EQ(find_video_format(known.code), &known);
    EXPECT_EQ(find_video_format(V4L2_PIX_FMT_H264), nullptr);
}

TEST(VideoFormat, SettlesTheRangeOfLumaAsTheKernelDoes) {
    EXPECT_TRUE(narrow_range(PixelFormat::yuyv, V4L2_QUANTIZATION_DEFAULT, V4L2_COLORSPACE_SRGB));
    EXPECT_FALSE(narrow_range(PixelFormat::yuyv, V4L2_QUANTIZATION_DEFAULT, V4L2_COLORSPACE_JPEG));
    EXPECT_FALSE(narrow_range(PixelFormat::nv12, V4L2_QUANTIZATION_FULL_RANGE, V4L2_COLORSPACE_REC709));
    EXPECT_TRUE(narrow_range(PixelFormat::nv12, V4L2_QUANTIZATION_LIM_RANGE, V4L2_COLORSPACE_JPEG));
    EXPECT_FALSE(narrow_range(PixelFormat::gray8, V4L2_QUANTIZATION_DEFAULT, V4L2_COLORSPACE_REC709));
}

}  // namespace
}  // namespace fovea::linux_port
