// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include <fovea/base/random.hpp>

#include <daemon/gray_frame.hpp>
#include <support/scattered_workers.hpp>

namespace fovea::apps {
namespace {

using hal::PixelFormat;
using Bytes = std::vector<std::uint8_t>;

constexpr PixelFormat with_rows[] = {
    PixelFormat::gray8,      PixelFormat::gray10,     PixelFormat::gray12,     PixelFormat::gray16,
    PixelFormat::yuyv,       PixelFormat::uyvy,       PixelFormat::nv12,       PixelFormat::rgb24,
    PixelFormat::bgr24,      PixelFormat::rgb565,     PixelFormat::bayer_rggb, PixelFormat::bayer_grbg,
    PixelFormat::bayer_gbrg, PixelFormat::bayer_bggr,
};

/// A frame of random bytes. Each plane lies in memory of exactly its length, shifted by some bytes, so that
/// rows begin anywhere and a sanitizer sees who reads behind them.
struct RandomFrame {
    hal::FrameInfo info;
    Bytes memory[hal::max_planes];

    RandomFrame(PixelFormat format, Size size, int padding, int shift, Random& random) {
        info.format = format;
        info.size = size;
        for (int p = 0; p < hal::plane_count(format); ++p) {
            const int row = hal::row_bytes(format, p, size.width);
            const int stride = row + padding;
            const int bytes = stride * (hal::plane_rows(format, p, size.height) - 1) + row;
            memory[p].resize(static_cast<std::size_t>(shift + bytes));
            for (std::uint8_t& byte : memory[p]) byte = static_cast<std::uint8_t>(random.next());
            info.planes[p] = {{memory[p].data() + shift, bytes}, stride};
        }
    }
    int byte(int plane, int x, int y) const {
        return info.planes[plane].bytes[y * info.planes[plane].stride_bytes + x];
    }
};

Span<std::uint8_t> span(Bytes& bytes) { return {bytes.data(), static_cast<std::ptrdiff_t>(bytes.size())}; }

/// 219 levels become 255, by a factor in 1/256 as rgb_of() has it.
int widened(int luma, bool narrow) {
    return narrow ? std::clamp((298 * (luma - 16) + 128) >> 8, 0, 255) : luma;
}
int gray(int red, int green, int blue) {
    const auto byte = [](int value) { return static_cast<std::uint8_t>(value); };
    return gray_of({byte(red), byte(green), byte(blue)});
}
int five_bits(int value) { return value << 3 | value >> 2; }
int six_bits(int value) { return value << 2 | value >> 4; }

/// Which colour a place of a mosaic has seen: 0 red, 1 green, 2 blue.
int mosaic_colour(PixelFormat format, int x, int y) {
    const char* const patterns[] = {"RGGB", "GRBG", "GBRG", "BGGR"};
    const int pattern = static_cast<int>(format) - static_cast<int>(PixelFormat::bayer_rggb);
    const char letter = patterns[pattern][2 * (y & 1) + (x & 1)];
    return letter == 'R' ? 0 : letter == 'G' ? 1 : 2;
}
/// The mean of those among the nine places about a pixel that have seen a colour and are nearest to it; the
/// image goes on as in a mirror that stands in its outermost pixels.
int mosaic_sample(const RandomFrame& frame, int colour, int x, int y) {
    if (mosaic_colour(frame.info.format, x, y) == colour) return frame.byte(0, x, y);
    const auto mirrored = [](int at, int size) { return at < 0 ? -at : at >= size ? 2 * size - 2 - at : at; };
    for (const int distance : {1, 2}) {
        int sum = 0;
        int count = 0;
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx) {
                if (std::abs(dx) + std::abs(dy) != distance) continue;
                if (mosaic_colour(frame.info.format, x + dx + 2, y + dy + 2) != colour) continue;
                sum += frame.byte(0, mirrored(x + dx, frame.info.size.width),
                                  mirrored(y + dy, frame.info.size.height));
                ++count;
            }
        if (count > 0) return (2 * sum + count) / (2 * count);
    }
    return -1;
}

/// The brightness of a pixel, from the bytes of the frame one by one.
int reference(const RandomFrame& frame, int x, int y) {
    const bool narrow = frame.info.narrow_range;
    const auto word = [&] { return frame.byte(0, 2 * x, y) + 256 * frame.byte(0, 2 * x + 1, y); };
    const auto shifted = [&](int bits) { return std::min((word() + (1 << (bits - 1))) / (1 << bits), 255); };
    switch (frame.info.format) {
        case PixelFormat::gray8:
        case PixelFormat::nv12: return widened(frame.byte(0, x, y), narrow);
        case PixelFormat::gray10: return shifted(2);
        case PixelFormat::gray12: return shifted(4);
        case PixelFormat::gray16: return shifted(8);
        case PixelFormat::yuyv: return widened(frame.byte(0, 2 * x, y), narrow);
        case PixelFormat::uyvy: return widened(frame.byte(0, 2 * x + 1, y), narrow);
        case PixelFormat::rgb24:
            return gray(frame.byte(0, 3 * x, y), frame.byte(0, 3 * x + 1, y), frame.byte(0, 3 * x + 2, y));
        case PixelFormat::bgr24:
            return gray(frame.byte(0, 3 * x + 2, y), frame.byte(0, 3 * x + 1, y), frame.byte(0, 3 * x, y));
        case PixelFormat::rgb565:
            return gray(five_bits(word() >> 11), six_bits(word() >> 5 & 63), five_bits(word() & 31));
        default:
            return gray(mosaic_sample(frame, 0, x, y), mosaic_sample(frame, 1, x, y),
                        mosaic_sample(frame, 2, x, y));
    }
}

TEST(GrayFrame, EqualsTheReferenceForEveryFormatSizeStrideAndAddress) {
    Random random(81);
    const Size sizes[] = {{1, 1},  {1, 5},   {5, 1},   {2, 2},   {3, 3},
                          {7, 16}, {16, 17}, {17, 18}, {33, 35}, {64, 50}};
    int compared = 0;
    for (const PixelFormat format : with_rows)
        for (const Size size : sizes)
            for (const int padding : {0, 1, 5})
                for (const bool narrow : {false, true}) {
                    RandomFrame frame(format, size, padding, random.between(0, 3), random);
                    const bool differs = format == PixelFormat::gray8 || format == PixelFormat::yuyv ||
                                         format == PixelFormat::uyvy || format == PixelFormat::nv12;
                    frame.info.narrow_range = narrow && differs;
                    Bytes scratch(static_cast<std::size_t>(gray_frame_scratch(format, size)));
                    const auto made = gray_frame(frame.info, span(scratch));
                    if (detail::is_bayer(format) && (size.width < 2 || size.height < 2)) {
                        EXPECT_EQ(made.status(), Status::bad_argument);
                        continue;
                    }
                    ASSERT_TRUE(made.ok()) << describe(format) << ": " << describe(made.status());
                    ASSERT_EQ(made->size(), size);
                    for (int y = 0; y < size.height; ++y)
                        for (int x = 0; x < size.width; ++x)
                            ASSERT_EQ((*made)(x, y), reference(frame, x, y))
                                << describe(format) << " " << size.width << "x" << size.height << " at " << x
                                << ", " << y;
                    ++compared;
                }
    EXPECT_GT(compared, 700);
}

TEST(GrayFrame, BySeveralWorkersIsTheSame) {
    Random random(85);
    for (const PixelFormat format : with_rows)
        for (const Size size : {Size{1, 1}, Size{5, 33}, Size{18, 100}, Size{64, 47}})
            for (const int count : {2, 5}) {
                RandomFrame frame(format, size, 3, random.between(0, 3), random);
                frame.info.narrow_range = format == PixelFormat::yuyv || format == PixelFormat::gray8;
                const test::ScatteredWorkers workers(count, 7);
                Bytes one(static_cast<std::size_t>(gray_frame_scratch(format, size)));
                Bytes many(static_cast<std::size_t>(gray_frame_scratch(format, size, count)));
                const auto wanted = gray_frame(frame.info, span(one));
                const auto made = gray_frame(frame.info, span(many), workers);
                ASSERT_EQ(made.status(), wanted.status()) << describe(format);
                if (!made) continue;
                for (int y = 0; y < size.height; ++y)
                    for (int x = 0; x < size.width; ++x)
                        ASSERT_EQ((*made)(x, y), (*wanted)(x, y))
                            << describe(format) << " " << size.width << "x" << size.height << " at " << x
                            << ", " << y;
                // What is short is refused whoever would come to the missing row.
                const Span<const std::uint8_t> bytes = frame.info.planes[0].bytes;
                frame.info.planes[0].bytes =
                    bytes.first(bytes.size() - hal::row_bytes(format, 0, size.width));
                EXPECT_EQ(gray_frame(frame.info, span(many), workers).status(), Status::truncated);
                if (many.empty()) continue;
                many.pop_back();
                EXPECT_FALSE(gray_frame(frame.info, span(many), workers).ok());
            }
}

TEST(GrayFrame, LeavesLumaOfTheFullRangeWhereItIs) {
    Random random(82);
    for (const PixelFormat format : {PixelFormat::gray8, PixelFormat::nv12}) {
        const RandomFrame frame(format, {9, 7}, 3, 1, random);
        const auto made = gray_frame(frame.info, {});
        ASSERT_TRUE(made.ok());
        EXPECT_EQ(made->first(), frame.info.planes[0].bytes.data());
        EXPECT_EQ(made->stride_bytes(), 12);
    }
}

TEST(ColourFrame, OfEveryFormatHasTheBrightnessOfItsGray) {
    Random random(83);
    for (const PixelFormat format : with_rows)
        for (const Size size : {Size{2, 2}, Size{7, 5}, Size{33, 35}}) {
            const RandomFrame frame(format, size, 2, 1, random);
            Bytes scratch(static_cast<std::size_t>(colour_frame_scratch(format, size)));
            const auto colour = colour_frame(frame.info, span(scratch));
            ASSERT_TRUE(colour.ok()) << describe(format);
            const bool video =
                format == PixelFormat::yuyv || format == PixelFormat::uyvy || format == PixelFormat::nv12;
            Bytes gray_scratch(static_cast<std::size_t>(gray_frame_scratch(format, size)));
            const auto gray = gray_frame(frame.info, span(gray_scratch));
            ASSERT_TRUE(gray.ok());
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x) {
                    const Rgb888 pixel = (*colour)(x, y);
                    if (!video) {
                        ASSERT_EQ(gray_of(pixel), (*gray)(x, y)) << describe(format);
                        continue;
                    }
                    const int pair = x / 2;
                    int u = 0, v = 0;
                    if (format == PixelFormat::nv12) {
                        u = frame.byte(1, 2 * pair, y / 2);
                        v = frame.byte(1, 2 * pair + 1, y / 2);
                    } else {
                        const int first = format == PixelFormat::yuyv ? 1 : 0;
                        // The last column of an odd width takes its v from the pair before.
                        const int v_pair = x == size.width - 1 && size.width % 2 == 1 ? pair - 1 : pair;
                        u = frame.byte(0, 4 * pair + first, y);
                        v = frame.byte(0, 4 * v_pair + 2 + first, y);
                    }
                    const auto byte = [](int value) { return static_cast<std::uint8_t>(value); };
                    ASSERT_EQ(pixel, rgb_of((*gray)(x, y), byte(u), byte(v), YuvRange::full))
                        << describe(format) << " at " << x << ", " << y;
                }
        }
}

TEST(ColourFrame, LeavesRgbWhereItIs) {
    Random random(84);
    const RandomFrame frame(PixelFormat::rgb24, {9, 7}, 3, 1, random);
    const auto made = colour_frame(frame.info, {});
    ASSERT_TRUE(made.ok());
    EXPECT_EQ(reinterpret_cast<const std::uint8_t*>(made->first()), frame.info.planes[0].bytes.data());
}

TEST(GrayFrame, RefusesWhatDoesNotFit) {
    Random random(85);
    for (const PixelFormat format : with_rows) {
        const RandomFrame whole(format, {6, 20}, 0, 0, random);
        Bytes scratch(static_cast<std::size_t>(gray_frame_scratch(format, {6, 20})));
        const bool lies_in_frame = format == PixelFormat::gray8 || format == PixelFormat::nv12;

        hal::FrameInfo frame = whole.info;
        if (!lies_in_frame) {
            EXPECT_EQ(gray_frame(frame, span(scratch).first(span(scratch).size() - 1)).status(),
                      Status::scratch_too_small)
                << describe(format);
        }
        frame.planes[0].bytes = frame.planes[0].bytes.first(frame.planes[0].bytes.size() - 1);
        EXPECT_EQ(gray_frame(frame, span(scratch)).status(), Status::truncated) << describe(format);
        frame = whole.info;
        frame.planes[0].stride_bytes = hal::row_bytes(format, 0, 6) - 1;
        EXPECT_EQ(gray_frame(frame, span(scratch)).status(), Status::bad_argument) << describe(format);
        frame = whole.info;
        frame.size = {0, 20};
        EXPECT_EQ(gray_frame(frame, span(scratch)).status(), Status::empty_image) << describe(format);
        frame.size = {40000, 1};
        EXPECT_EQ(gray_frame(frame, span(scratch)).status(), Status::image_too_large) << describe(format);
    }
    hal::FrameInfo none;
    none.size = {6, 20};
    Bytes scratch(1000);
    EXPECT_EQ(gray_frame(none, span(scratch)).status(), Status::unsupported);
    EXPECT_EQ(colour_frame(none, span(scratch)).status(), Status::unsupported);
    RandomFrame nv12(PixelFormat::nv12, {6, 20}, 0, 0, random);
    nv12.info.planes[1].bytes = nv12.info.planes[1].bytes.first(5);
    EXPECT_EQ(colour_frame(nv12.info, span(scratch)).status(), Status::truncated);
}

static_assert(gray_frame_scratch(PixelFormat::gray8, {640, 480}) == 640 * 480);
static_assert(gray_frame_scratch(PixelFormat::bayer_rggb, {640, 480}) == 640 * 480 + 3 * 640 * 19);
static_assert(colour_frame_scratch(PixelFormat::rgb24, {640, 480}) == 0);
static_assert(gray_frame_scratch(PixelFormat::none, {640, 480}) == 0);

}  // namespace
}  // namespace fovea::apps
