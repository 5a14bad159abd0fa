// SPDX-License-Identifier: MIT
//
// Frames of a camera that sends MJPEG: whole ones become images, all others an error.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include <core/codec/jpeg_pictures.hpp>
#include <fovea/base/random.hpp>
#include <fovea/codec/jpeg.hpp>

#include <daemon/gray_frame.hpp>

#if defined(FOVEA_HAVE_LIBJPEG)
#include <jpeglib.h>
#endif

namespace fovea::apps {
namespace {

using hal::PixelFormat;
using test::Bytes;
using test::span_of;

hal::FrameInfo frame_of(const Bytes& file, Size size) {
    hal::FrameInfo info;
    info.format = PixelFormat::mjpeg;
    info.size = size;
    info.planes[0] = {span_of(file), 0};
    return info;
}

/// What becomes of a frame, with exactly the scratch that is asked for.
Status status_of(const Bytes& file, Size size) {
    Bytes scratch(static_cast<std::size_t>(gray_frame_scratch(PixelFormat::mjpeg, size)));
    return gray_frame(frame_of(file, size), span_of(scratch)).status();
}

/// Where a marker stands.
std::size_t place_of(const Bytes& file, int marker) {
    for (std::size_t i = 0; i + 1 < file.size(); ++i)
        if (file[i] == 0xff && file[i + 1] == marker) return i;
    ADD_FAILURE() << "no marker " << marker;
    return 0;
}

/// The file with another size in its frame header.
Bytes resized(Bytes file, int width, int height) {
    const std::size_t at = place_of(file, 0xc0) + 5;
    file[at] = static_cast<std::uint8_t>(height >> 8);
    file[at + 1] = static_cast<std::uint8_t>(height);
    file[at + 2] = static_cast<std::uint8_t>(width >> 8);
    file[at + 3] = static_cast<std::uint8_t>(width);
    return file;
}

/// A picture as webcams send it: colour at half the columns, and no codes of its own.
Bytes without_codes(Size size, int restart = 0) {
    Random random(86);
    return test::RandomPicture(random, size, 3, {2, 1}, {1, 1}, restart).file.bytes;
}

TEST(GrayFrameOfMjpeg, IsTheLumaOfAPictureWithoutCodes) {
    Random random(86);
    test::RandomPicture picture(random, {37, 21}, 3, {2, 1}, {1, 1}, 0);
    Bytes scratch(static_cast<std::size_t>(gray_frame_scratch(PixelFormat::mjpeg, picture.size)));
    const auto gray = gray_frame(frame_of(picture.file.bytes, picture.size), span_of(scratch));
    ASSERT_TRUE(gray.ok()) << describe(gray.status());
    for (int y = 0; y < 21; ++y)
        for (int x = 0; x < 37; ++x) ASSERT_NEAR((*gray)(x, y), picture.at(0, x, y), 1);

    Bytes colour_scratch(static_cast<std::size_t>(colour_frame_scratch(PixelFormat::mjpeg, picture.size)));
    EXPECT_TRUE(colour_frame(frame_of(picture.file.bytes, picture.size), span_of(colour_scratch)).ok());
}

TEST(GrayFrameOfMjpeg, IsAnErrorForEveryTruncation) {
    for (const int restart : {0, 1}) {
        const Bytes whole = without_codes({37, 21}, restart);
        ASSERT_EQ(status_of(whole, {37, 21}), Status::ok);
        for (std::size_t length = 0; length < whole.size(); ++length) {
            const Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
            const Status status = status_of(cut, {37, 21});
            ASSERT_TRUE(status == Status::truncated || status == Status::malformed) << length;
        }
    }
}

TEST(GrayFrameOfMjpeg, MayHavePaddingBehindTheEndOfThePicture) {
    Bytes file = without_codes({37, 21});
    file.resize(file.size() + 100);
    EXPECT_EQ(status_of(file, {37, 21}), Status::ok);
}

TEST(GrayFrameOfMjpeg, OfAnotherSizeIsAnError) {
    const Bytes file = without_codes({37, 21});
    EXPECT_EQ(status_of(file, {37, 20}), Status::size_mismatch);
    EXPECT_EQ(status_of(file, {640, 480}), Status::size_mismatch);
    EXPECT_EQ(status_of(resized(file, 36, 21), {37, 21}), Status::size_mismatch);
    EXPECT_NE(status_of(resized(file, 65535, 65535), {37, 21}), Status::ok);
    Bytes scratch(100000);
    const Bytes largest = resized(file, 65535, 65535);
    EXPECT_EQ(gray_frame(frame_of(largest, {65535, 65535}), span_of(scratch)).status(),
              Status::image_too_large);
    EXPECT_NE(status_of(resized(file, 0, 21), {37, 21}), Status::ok);
    // The size is right, and there is less or more behind it than it needs.
    EXPECT_NE(status_of(resized(file, 37, 29), {37, 29}), Status::ok);
    EXPECT_NE(status_of(resized(file, 37, 8), {37, 8}), Status::ok);
}

TEST(GrayFrameOfMjpeg, NeedsRestartMarkersInTheirOrder) {
    Bytes file = without_codes({48, 8}, 1);
    ASSERT_EQ(status_of(file, {48, 8}), Status::ok);
    const std::size_t first = place_of(file, 0xd0);
    const std::size_t second = place_of(file, 0xd1);
    file[first + 1] = 0xd1;
    file[second + 1] = 0xd0;
    EXPECT_EQ(status_of(file, {48, 8}), Status::malformed);
}

/// Damage is an error or a whole picture, and in memory of exact size nobody writes beside it.
TEST(GrayFrameOfMjpeg, WithFlippedBitsIsAnErrorOrAnImage) {
    const Bytes whole = without_codes({37, 21}, 1);
    Random random(87);
    int errors = 0;
    for (int round = 0; round < 1500; ++round) {
        Bytes file = whole;
        for (int flips = random.between(1, 3); flips > 0; --flips)
            file[random.below(static_cast<std::uint32_t>(file.size()))] ^=
                static_cast<std::uint8_t>(1u << random.below(8));
        errors += status_of(file, {37, 21}) == Status::ok ? 0 : 1;
    }
    EXPECT_GT(errors, 150);
}

#if defined(FOVEA_HAVE_LIBJPEG)

/// A picture by libjpeg, with the codes it writes.
Bytes by_libjpeg(Size size) {
    jpeg_error_mgr errors;
    jpeg_compress_struct encoder;
    encoder.err = jpeg_std_error(&errors);
    jpeg_create_compress(&encoder);
    unsigned char* memory = nullptr;
    unsigned long length = 0;
    jpeg_mem_dest(&encoder, &memory, &length);
    encoder.image_width = static_cast<JDIMENSION>(size.width);
    encoder.image_height = static_cast<JDIMENSION>(size.height);
    encoder.input_components = 3;
    encoder.in_color_space = JCS_RGB;
    jpeg_set_defaults(&encoder);
    encoder.comp_info[0].h_samp_factor = 2;
    encoder.comp_info[0].v_samp_factor = 1;
    jpeg_start_compress(&encoder, TRUE);
    for (int y = 0; y < size.height; ++y) {
        Bytes row;
        for (int x = 0; x < size.width; ++x)
            for (const int level : {7 * x, 5 * y, 3 * (x ^ y)})
                row.push_back(static_cast<std::uint8_t>(level));
        JSAMPROW start = row.data();
        jpeg_write_scanlines(&encoder, &start, 1);
    }
    jpeg_finish_compress(&encoder);
    Bytes file(memory, memory + length);
    std::free(memory);
    jpeg_destroy_compress(&encoder);
    return file;
}

TEST(GrayFrameOfMjpeg, ByLibjpegIsTheSameWithoutItsCodes) {
    const Size size{50, 34};
    const Bytes whole = by_libjpeg(size);
    Bytes without = whole;
    int removed = 0;
    for (std::size_t at = 2; without[at + 1] != 0xda;) {
        const std::size_t length = 2 + static_cast<std::size_t>(without[at + 2] << 8 | without[at + 3]);
        if (without[at + 1] != 0xc4) {
            at += length;
            continue;
        }
        const auto from = without.begin() + static_cast<std::ptrdiff_t>(at);
        without.erase(from, from + static_cast<std::ptrdiff_t>(length));
        ++removed;
    }
    EXPECT_EQ(removed, 4);
    const auto bytes = static_cast<std::size_t>(gray_frame_scratch(PixelFormat::mjpeg, size));
    Bytes one(bytes);
    Bytes other(bytes);
    const auto with_codes = gray_frame(frame_of(whole, size), span_of(one));
    const auto standard = gray_frame(frame_of(without, size), span_of(other));
    ASSERT_TRUE(with_codes.ok() && standard.ok());
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) ASSERT_EQ((*with_codes)(x, y), (*standard)(x, y));
}

TEST(GrayFrameOfMjpeg, ByLibjpegIsAnErrorForEveryTruncation) {
    const Size size{50, 34};
    const Bytes whole = by_libjpeg(size);
    ASSERT_EQ(status_of(whole, size), Status::ok);
    for (std::size_t length = 0; length < whole.size(); ++length) {
        const Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
        const Status status = status_of(cut, size);
        ASSERT_TRUE(status == Status::truncated || status == Status::malformed) << length;
    }
}

#endif

}  // namespace
}  // namespace fovea::apps
