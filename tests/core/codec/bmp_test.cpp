// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/codec/bmp.hpp>
#include <support/guarded_image.hpp>
#include <support/picture.hpp>

#include "lossless_files.hpp"

namespace fovea::test {
namespace {

/// The fields of a BMP file; bytes() puts them together.
struct BmpFile {
    int width = 2;
    int height = 2;
    int bits = 24;
    std::uint32_t info_bytes = 40;
    std::uint32_t compression = 0;
    std::uint32_t colours = 0;
    std::uint32_t planes = 1;
    Bytes behind_info;  ///< masks and palette
    int gap = 0;        ///< between them and the pixels
    Bytes raster;

    Bytes bytes() const {
        Bytes file = {'B', 'M'};
        const std::size_t offset = 14 + info_bytes + behind_info.size() + static_cast<std::size_t>(gap);
        append_little(file, static_cast<std::uint32_t>(offset + raster.size()), 4);
        append_little(file, 0, 4);
        append_little(file, static_cast<std::uint32_t>(offset), 4);
        append_little(file, info_bytes, 4);
        const int side_bytes = info_bytes == 12 ? 2 : 4;
        append_little(file, static_cast<std::uint32_t>(width), side_bytes);
        append_little(file, static_cast<std::uint32_t>(height), side_bytes);
        append_little(file, planes, 2);
        append_little(file, static_cast<std::uint32_t>(bits), 2);
        for (const std::uint32_t field : {compression, 0u, 2835u, 2835u, colours, 0u})
            if (info_bytes >= 40) append_little(file, field, 4);
        file.resize(14 + info_bytes);
        append(file, behind_info);
        file.resize(offset);
        append(file, raster);
        return file;
    }
};

/// Blue, green and red of 3x1 pixels and the padding of their row.
const Bytes three_pixels = {10, 20, 30, 40, 50, 60, 70, 80, 90, 0, 0, 0};

template <class Pixel>
Status status_of(const Bytes& file, Size size) {
    GuardedImage<Pixel> dst(size);
    fill_bytes(dst.view(), 77);
    const Status status = decode_bmp(view_of(file), dst.view());
    EXPECT_TRUE(status == Status::ok || all_bytes_are(dst.view(), 77)) << describe(status);
    return status;
}

TEST(BmpReader, ReadsTwentyFourBitsFromTheBottomUp) {
    BmpFile file;
    file.raster = {1, 2, 3, 4, 5, 6, 0, 0, 11, 12, 13, 14, 15, 16, 0, 0};
    const Result<PictureInfo> info = inspect_bmp(view_of(file.bytes()));
    ASSERT_TRUE(info.ok());
    EXPECT_EQ(info->size, (Size{2, 2}));
    EXPECT_EQ(info->content, PictureContent::rgb888);
    EXPECT_EQ(info->scratch_bytes, 0);
    GuardedImage<Rgb888> dst({2, 2});
    ASSERT_EQ(decode_bmp(view_of(file.bytes()), dst.view()), Status::ok);
    EXPECT_EQ(dst(0, 1), (Rgb888{3, 2, 1}));
    EXPECT_EQ(dst(1, 1), (Rgb888{6, 5, 4}));
    EXPECT_EQ(dst(0, 0), (Rgb888{13, 12, 11}));
    EXPECT_EQ(dst(1, 0), (Rgb888{16, 15, 14}));
    file.height = -2;
    ASSERT_EQ(decode_bmp(view_of(file.bytes()), dst.view()), Status::ok);
    EXPECT_EQ(dst(0, 0), (Rgb888{3, 2, 1}));
    EXPECT_EQ(dst(1, 1), (Rgb888{16, 15, 14}));
}

TEST(BmpReader, AColourPaletteDoesNotSwapRedAndBlue) {
    // The original toolkit did: its palette reader took blue for red.
    BmpFile file;
    file.bits = 8;
    file.colours = 2;
    file.behind_info = {0, 0, 255, 0, 255, 128, 0, 0};  // red; then blue with half green
    file.raster = {0, 1, 0, 0, 1, 0, 0, 0};
    EXPECT_EQ(inspect_bmp(view_of(file.bytes()))->content, PictureContent::rgb888);
    GuardedImage<Rgb888> dst({2, 2});
    ASSERT_EQ(decode_bmp(view_of(file.bytes()), dst.view()), Status::ok);
    EXPECT_EQ(dst(0, 0), (Rgb888{0, 128, 255}));
    EXPECT_EQ(dst(1, 0), (Rgb888{255, 0, 0}));
    EXPECT_EQ(dst(0, 1), (Rgb888{255, 0, 0}));
    GuardedImage<Gray8> gray({2, 2});
    ASSERT_EQ(decode_bmp(view_of(file.bytes()), gray.view()), Status::ok);
    EXPECT_EQ(gray(0, 1), gray_of({255, 0, 0}));
    GuardedImage<Gray16> wide({2, 2});
    ASSERT_EQ(decode_bmp(view_of(file.bytes()), wide.view()), Status::ok);
    EXPECT_EQ(wide(0, 1), 257 * gray_of({255, 0, 0}));
}

TEST(BmpReader, ATopDownGrayPaletteIsLookedUpRightAndInsideItsBounds) {
    // The original toolkit read such files beyond the end of their pixels. The palette runs backwards here.
    BmpFile file;
    file.width = 3;
    file.height = -2;
    file.bits = 8;
    for (int i = 0; i < 256; ++i)
        append_little(file.behind_info, 0x010101u * static_cast<std::uint32_t>(255 - i), 4);
    file.raster = {0, 1, 2, 99, 253, 254, 255, 99};
    EXPECT_EQ(inspect_bmp(view_of(file.bytes()))->content, PictureContent::gray8);
    GuardedImage<Gray8> dst({3, 2});
    ASSERT_EQ(decode_bmp(view_of(file.bytes()), dst.view()), Status::ok);
    for (int x = 0; x < 3; ++x) {
        EXPECT_EQ(dst(x, 0), 255 - x);
        EXPECT_EQ(dst(x, 1), 2 - x);
    }
}

TEST(BmpReader, RefusesAHostilePalette) {
    BmpFile file;
    file.bits = 8;
    file.behind_info = Bytes(4 * 256);
    file.raster = Bytes(8);
    EXPECT_EQ(status_of<Gray8>(file.bytes(), {2, 2}), Status::ok);
    for (const std::uint32_t colours : {257u, 65536u, 0x40000000u, 0xffffffffu}) {
        file.colours = colours;
        EXPECT_EQ(inspect_bmp(view_of(file.bytes())).status(), Status::malformed);
        EXPECT_EQ(status_of<Gray8>(file.bytes(), {2, 2}), Status::malformed);
    }
    // One colour more than an index can name, with room for it in the file.
    file.colours = 257;
    file.gap = 4;
    EXPECT_EQ(status_of<Gray8>(file.bytes(), {2, 2}), Status::malformed);
    file.gap = 0;
    // 256 colours that reach into the pixels.
    file.colours = 0;
    file.behind_info.resize(4 * 256 - 1);
    EXPECT_EQ(status_of<Gray8>(file.bytes(), {2, 2}), Status::malformed);
}

TEST(BmpReader, RefusesAPixelWithoutAColourBeforeItWritesAny) {
    BmpFile file;
    file.bits = 8;
    file.colours = 3;
    file.behind_info = Bytes(4 * 3);
    // 99 stands in the padding, where it means nothing.
    file.raster = {0, 1, 99, 99, 1, 2, 99, 99};
    EXPECT_EQ(status_of<Gray8>(file.bytes(), {2, 2}), Status::ok);
    file.raster[5] = 3;
    EXPECT_EQ(status_of<Gray8>(file.bytes(), {2, 2}), Status::malformed);
    EXPECT_TRUE(inspect_bmp(view_of(file.bytes())).ok());
}

TEST(BmpReader, ReadsThirtyTwoBitsAndTheirMasks) {
    BmpFile file;
    file.width = 1;
    file.height = 1;
    file.bits = 32;
    file.raster = {1, 2, 3, 99};
    GuardedImage<Rgb888> dst({1, 1});
    ASSERT_EQ(decode_bmp(view_of(file.bytes()), dst.view()), Status::ok);
    EXPECT_EQ(dst(0, 0), (Rgb888{3, 2, 1}));

    // The lowest byte is red here, the highest green.
    file.compression = 3;
    append_little(file.behind_info, 0x000000ff, 4);
    append_little(file.behind_info, 0xff000000, 4);
    append_little(file.behind_info, 0x0000ff00, 4);
    ASSERT_EQ(decode_bmp(view_of(file.bytes()), dst.view()), Status::ok);
    EXPECT_EQ(dst(0, 0), (Rgb888{1, 99, 2}));
    for (const std::uint32_t mask : {0u, 0x7fu, 0x1ffu, 0xff01u, 0x3fc000ffu, 0xf0f0u}) {
        BmpFile other = file;
        other.behind_info = {};
        append_little(other.behind_info, mask, 4);
        append(other.behind_info, Bytes(8, 0xff));
        EXPECT_EQ(status_of<Rgb888>(other.bytes(), {1, 1}), Status::unsupported) << mask;
    }
    // Pixels that begin inside the masks, where they make a right one; and masks that end behind the file.
    file.behind_info.resize(8);
    file.raster = {0, 0xff, 0, 0};
    EXPECT_EQ(status_of<Rgb888>(file.bytes(), {1, 1}), Status::malformed);
    file.behind_info.clear();
    EXPECT_EQ(status_of<Rgb888>(first_bytes(file.bytes(), 60), {1, 1}), Status::truncated);
}

TEST(BmpReader, ReadsEveryLengthOfHeader) {
    for (const std::uint32_t length : {12u, 16u, 40u, 52u, 56u, 64u, 108u, 124u}) {
        BmpFile file;
        file.width = 3;
        file.height = 1;
        file.info_bytes = length;
        file.gap = 5;
        file.raster = three_pixels;
        GuardedImage<Rgb888> dst({3, 1});
        ASSERT_EQ(decode_bmp(view_of(file.bytes()), dst.view()), Status::ok) << length;
        EXPECT_EQ(dst(2, 0), (Rgb888{90, 80, 70}));
    }
    for (const std::uint32_t length : {0u, 11u}) {
        Bytes bytes = BmpFile().bytes();
        bytes[14] = static_cast<std::uint8_t>(length);
        EXPECT_EQ(inspect_bmp(view_of(bytes)).status(), Status::malformed);
    }
    for (const std::uint32_t length : {13u, 41u, 125u, 200u}) {
        Bytes bytes = BmpFile().bytes();
        bytes[14] = static_cast<std::uint8_t>(length);
        EXPECT_EQ(inspect_bmp(view_of(bytes)).status(), Status::unsupported) << length;
    }
}

TEST(BmpReader, ReadsThePaletteOfOs2WithThreeBytesAColour) {
    BmpFile file;
    file.info_bytes = 12;
    file.bits = 8;
    file.behind_info = Bytes(3 * 256);
    for (std::size_t i = 0; i < 256; ++i) file.behind_info[3 * i + 2] = static_cast<std::uint8_t>(i);
    file.raster = {1, 2, 0, 0, 3, 255, 0, 0};
    GuardedImage<Rgb888> dst({2, 2});
    ASSERT_EQ(decode_bmp(view_of(file.bytes()), dst.view()), Status::ok);
    EXPECT_EQ(dst(0, 0), (Rgb888{3, 0, 0}));
    EXPECT_EQ(dst(1, 0), (Rgb888{255, 0, 0}));
}

TEST(BmpReader, SaysWhyItRefusesAHeader) {
    const auto status = [](auto change) {
        BmpFile file;
        file.raster = Bytes(16);
        change(file);
        return inspect_bmp(view_of(file.bytes())).status();
    };
    EXPECT_EQ(status([](BmpFile& file) { file.width = 0; }), Status::malformed);
    EXPECT_EQ(status([](BmpFile& file) { file.width = -2; }), Status::malformed);
    EXPECT_EQ(status([](BmpFile& file) { file.height = 0; }), Status::malformed);
    EXPECT_EQ(status([](BmpFile& file) { file.planes = 2; }), Status::malformed);
    EXPECT_EQ(status([](BmpFile& file) { file.width = 32768; }), Status::image_too_large);
    EXPECT_EQ(status([](BmpFile& file) { file.height = -32768; }), Status::image_too_large);
    EXPECT_EQ(status([](BmpFile& file) { file.height = std::numeric_limits<int>::min(); }),
              Status::image_too_large);
    for (const int bits : {0, 1, 2, 4, 16, 25, 64})
        EXPECT_EQ(status([&](BmpFile& file) { file.bits = bits; }), Status::unsupported) << bits;
    for (const std::uint32_t compression : {1u, 2u, 3u, 4u, 5u, 6u, 0xffffffffu})
        EXPECT_EQ(status([&](BmpFile& file) { file.compression = compression; }), Status::unsupported)
            << compression;
    Bytes bytes = BmpFile().bytes();
    bytes[10] = 53;
    EXPECT_EQ(inspect_bmp(view_of(bytes)).status(), Status::malformed);
    EXPECT_EQ(inspect_bmp(view_of(bytes_of("BA"))).status(), Status::malformed);
    EXPECT_EQ(inspect_bmp(view_of(bytes_of("MB"))).status(), Status::malformed);
}

TEST(BmpReader, LeavesTheOutputWhenAnythingIsMissing) {
    BmpFile colour;
    colour.raster = Bytes(16, 5);
    BmpFile palette = colour;
    palette.bits = 8;
    palette.colours = 9;
    palette.behind_info = Bytes(4 * 9);
    palette.raster.resize(8);
    BmpFile masks = colour;
    masks.bits = 32;
    masks.info_bytes = 56;
    for (const Bytes& file : {colour.bytes(), palette.bytes(), masks.bytes()}) {
        for (std::size_t length = 0; length < file.size(); ++length)
            ASSERT_EQ(status_of<Rgb888>(first_bytes(file, length), {2, 2}), Status::truncated) << length;
        EXPECT_EQ(status_of<Rgb888>(file, {2, 2}), Status::ok);
        EXPECT_EQ(status_of<Rgb888>(file, {2, 1}), Status::size_mismatch);
        EXPECT_EQ(decode_bmp(view_of(file), ImageView<Gray8>()), Status::empty_image);
    }
    // An offset that 32 bits hold and a pointer on a small machine does not.
    Bytes far = colour.bytes();
    for (std::size_t i = 10; i < 14; ++i) far[i] = 0xff;
    EXPECT_EQ(status_of<Rgb888>(far, {2, 2}), Status::truncated);
}

template <class Pixel>
void expect_round_trip(Random& random, Size size) {
    GuardedImage<Pixel> src(size);
    src.fill(random);
    const std::int64_t length = encoded_bmp_bytes<Pixel>(size);
    Bytes file = zeros(length);
    const Result<std::ptrdiff_t> written = encode_bmp(src.view(), room_in(file));
    ASSERT_TRUE(written.ok());
    EXPECT_EQ(*written, length);
    const Result<PictureInfo> info = inspect_bmp(view_of(file));
    EXPECT_EQ(info->size, size);
    EXPECT_EQ(info->content, sizeof(Pixel) == 1 ? PictureContent::gray8 : PictureContent::rgb888);
    GuardedImage<Pixel> dst(size);
    ASSERT_EQ(decode_bmp(view_of(file), dst.view()), Status::ok);
    EXPECT_TRUE(equal(src.view(), dst.view())) << size.width << "x" << size.height;

    Bytes little(static_cast<std::size_t>(length) - 1, 77);
    EXPECT_EQ(encode_bmp(src.view(), room_in(little)).status(), Status::buffer_too_small);
    EXPECT_EQ(little, Bytes(little.size(), 77));
}

TEST(BmpWriter, IsReadBackInEverySizeFromAFileOfExactlyItsLength) {
    Random random(1);
    for (const Size size : test_sizes()) {
        expect_round_trip<Gray8>(random, size);
        expect_round_trip<Rgb888>(random, size);
    }
}

TEST(BmpWriter, WritesBlueFirstAndTheLowestRowFirst) {
    GuardedImage<Rgb888> src({1, 2});
    src(0, 0) = {1, 2, 3};
    src(0, 1) = {4, 5, 6};
    Bytes file = zeros(encoded_bmp_bytes<Rgb888>({1, 2}));
    ASSERT_TRUE(encode_bmp(src.view(), room_in(file)).ok());
    Bytes expected = {'B', 'M', 62, 0, 0, 0, 0, 0, 0, 0, 54, 0, 0, 0,  40,
                      0,   0,   0,  1, 0, 0, 0, 2, 0, 0, 0,  1, 0, 24, 0};
    expected.resize(54);
    append(expected, {6, 5, 4, 0, 3, 2, 1, 0});
    EXPECT_EQ(file, expected);
}

TEST(BmpWriter, SaysWhatIsWrong) {
    Bytes file(100);
    EXPECT_EQ(encode_bmp(ImageView<const Gray8>(), room_in(file)).status(), Status::empty_image);
    const ImageView<const Gray8> high(file.data(), {1, 32768}, 1);
    EXPECT_EQ(encode_bmp(high, room_in(file)).status(), Status::image_too_large);
    EXPECT_EQ(encoded_bmp_bytes<Rgb888>({32767, 32767}), 54 + std::int64_t{98304} * 32767);
}

// ---- Bmpsuite ---------------------------------------------------------------------

TEST(BmpSuite, VariantsOfOnePictureAreEqual) {
    const auto folder = data_folder() / "decoders" / "bmp";
    FOVEA_NEED_PICTURE(folder);
    const auto read = [&](const std::string& name) {
        const Bytes file = read_file(folder / (name + ".bmp"));
        GuardedImage<Rgb888> dst({127, 64});
        EXPECT_EQ(decode_bmp(view_of(file), dst.view()), Status::ok) << name;
        EXPECT_EQ(inspect_bmp(view_of(file))->content, PictureContent::rgb888) << name;
        return dst;
    };
    const GuardedImage<Rgb888> pal8 = read("pal8");
    for (const char* name : {"pal8-0", "pal8os2", "pal8topdown", "pal8v4", "pal8v5"})
        EXPECT_TRUE(equal(read(name).view(), pal8.view())) << name;
    const GuardedImage<Rgb888> rgb24 = read("rgb24");
    for (const char* name : {"rgb24pal", "rgb32"})
        EXPECT_TRUE(equal(read(name).view(), rgb24.view())) << name;
    // Its masks are 8 bits wide, though not on bytes.
    EXPECT_TRUE(equal(read("rgb32bf").view(), rgb24.view()));
}

TEST(BmpSuite, WidthsOfAllRemaindersAreRead) {
    const auto folder = data_folder() / "decoders" / "bmp";
    FOVEA_NEED_PICTURE(folder);
    for (const auto& [name, size] : {std::pair<const char*, Size>{"pal8w124.bmp", {124, 61}},
                                     {"pal8w125.bmp", {125, 62}},
                                     {"pal8w126.bmp", {126, 63}},
                                     {"pal8nonsquare.bmp", {127, 32}}})
        EXPECT_EQ(status_of<Rgb888>(read_file(folder / name), size), Status::ok) << name;
}

TEST(BmpSuite, WhatIsNotReadIsUnsupported) {
    const auto folder = data_folder() / "decoders" / "bmp";
    FOVEA_NEED_PICTURE(folder);
    for (const char* name :
         {"pal1", "pal1bg", "pal1wb", "pal4", "pal4rle", "pal8rle", "rgb16", "rgb16-565", "rgb16-565pal"})
        EXPECT_EQ(inspect_bmp(view_of(read_file(folder / (std::string(name) + ".bmp")))).status(),
                  Status::unsupported)
            << name;
}

}  // namespace
}  // namespace fovea::test
