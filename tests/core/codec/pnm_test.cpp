// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/codec/png_reader.hpp>
#include <fovea/codec/pnm.hpp>
#include <support/guarded_image.hpp>
#include <support/picture.hpp>

#include "lossless_files.hpp"

namespace fovea::test {
namespace {

/// A header and samples behind it.
Bytes pnm(const std::string& header, const Bytes& samples) {
    Bytes file = bytes_of(header);
    append(file, samples);
    return file;
}

template <class Pixel>
Status status_of(const Bytes& file, Size size) {
    GuardedImage<Pixel> dst(size);
    return decode_pnm(view_of(file), dst.view());
}

TEST(PnmReader, ReadsAGrayPictureWithCommentsAndAnyWhiteSpace) {
    const Bytes file =
        pnm("P5\n# made by hand\n# twice\r 3\t2 # width, height\n255\n", {0, 1, 2, 253, 254, 255});
    const Result<PictureInfo> info = inspect_pnm(view_of(file));
    ASSERT_TRUE(info.ok());
    EXPECT_EQ(info->size, (Size{3, 2}));
    EXPECT_EQ(info->content, PictureContent::gray8);
    EXPECT_EQ(info->scratch_bytes, 0);
    GuardedImage<Gray8> dst({3, 2});
    ASSERT_EQ(decode_pnm(view_of(file), dst.view()), Status::ok);
    for (int x = 0; x < 3; ++x) {
        EXPECT_EQ(dst(x, 0), x);
        EXPECT_EQ(dst(x, 1), 253 + x);
    }
}

TEST(PnmReader, ReadsColoursInTheOrderRedGreenBlue) {
    const Bytes file = pnm("P6 2 1 255\n", {10, 20, 30, 40, 50, 60});
    EXPECT_EQ(inspect_pnm(view_of(file))->content, PictureContent::rgb888);
    GuardedImage<Rgb888> dst({2, 1});
    ASSERT_EQ(decode_pnm(view_of(file), dst.view()), Status::ok);
    EXPECT_EQ(dst(0, 0), (Rgb888{10, 20, 30}));
    EXPECT_EQ(dst(1, 0), (Rgb888{40, 50, 60}));
}

TEST(PnmReader, ReadsTheHigherByteFirst) {
    const Bytes file = pnm("P5 2 1 65535\n", {0x12, 0x34, 0xff, 0xff});
    EXPECT_EQ(inspect_pnm(view_of(file))->content, PictureContent::gray16);
    GuardedImage<Gray16> dst({2, 1});
    ASSERT_EQ(decode_pnm(view_of(file), dst.view()), Status::ok);
    EXPECT_EQ(dst(0, 0), 0x1234);
    EXPECT_EQ(dst(1, 0), 0xffff);
}

TEST(PnmReader, ScalesMaxvalToTheBrightestLevel) {
    const Bytes file = pnm("P5 4 1 100\n", {0, 1, 50, 100});
    GuardedImage<Gray8> gray({4, 1});
    ASSERT_EQ(decode_pnm(view_of(file), gray.view()), Status::ok);
    // 2.55 is nearest to 3, 127.5 goes up.
    const int expected[] = {0, 3, 128, 255};
    for (int x = 0; x < 4; ++x) EXPECT_EQ(gray(x, 0), expected[x]);
    GuardedImage<Gray16> wide({4, 1});
    ASSERT_EQ(decode_pnm(view_of(file), wide.view()), Status::ok);
    // 655.35 and 32767.5.
    const int expected_wide[] = {0, 655, 32768, 65535};
    for (int x = 0; x < 4; ++x) EXPECT_EQ(wide(x, 0), expected_wide[x]);
}

TEST(PnmReader, RefusesSamplesAboveMaxvalBeforeItWritesAPixel) {
    for (const Bytes& file : {pnm("P5 2 1 100\n", {0, 101}), pnm("P5 2 1 300\n", {0, 1, 1, 45}),
                              pnm("P6 1 1 7\n", {7, 8, 7}), pnm("P5 2 1 254\n", {0, 255})}) {
        GuardedImage<Gray8> dst(inspect_pnm(view_of(file))->size);
        fill_bytes(dst.view(), 77);
        EXPECT_EQ(decode_pnm(view_of(file), dst.view()), Status::malformed);
        EXPECT_TRUE(all_bytes_are(dst.view(), 77));
    }
    GuardedImage<Gray8> most({2, 1});
    EXPECT_EQ(decode_pnm(view_of(pnm("P5 2 1 300\n", {0, 1, 1, 44})), most.view()), Status::ok);
}

TEST(PnmReader, TurnsEveryContentIntoEveryPixel) {
    GuardedImage<Rgb888> colour({1, 1});
    ASSERT_EQ(decode_pnm(view_of(pnm("P5 1 1 255\n", {77})), colour.view()), Status::ok);
    EXPECT_EQ(colour(0, 0), (Rgb888{77, 77, 77}));
    const Bytes deep = pnm("P6 1 1 65535\n", {0xff, 0xff, 0x80, 0x80, 0, 0});
    EXPECT_EQ(inspect_pnm(view_of(deep))->content, PictureContent::rgb48);
    ASSERT_EQ(decode_pnm(view_of(deep), colour.view()), Status::ok);
    EXPECT_EQ(colour(0, 0), (Rgb888{255, 128, 0}));
    GuardedImage<Gray8> gray({1, 1});
    ASSERT_EQ(decode_pnm(view_of(deep), gray.view()), Status::ok);
    EXPECT_EQ(gray(0, 0), gray_of({255, 128, 0}));
    GuardedImage<Gray16> wide({1, 1});
    ASSERT_EQ(decode_pnm(view_of(deep), wide.view()), Status::ok);
    EXPECT_EQ(wide(0, 0), 257 * gray_of({255, 128, 0}));
}

TEST(PnmReader, TakesOneByteOfWhiteSpaceBehindMaxvalAndNoMore) {
    // The samples themselves look like white space.
    const Bytes file = pnm("P5 2 1 255\n", {'\n', ' '});
    GuardedImage<Gray8> dst({2, 1});
    ASSERT_EQ(decode_pnm(view_of(file), dst.view()), Status::ok);
    EXPECT_EQ(dst(0, 0), '\n');
    EXPECT_EQ(dst(1, 0), ' ');
}

TEST(PnmReader, ReadsTheFirstOfSeveralPictures) {
    GuardedImage<Gray8> dst({1, 1});
    ASSERT_EQ(decode_pnm(view_of(bytes_of("P5 1 1 255\nAP5 1 1 255\nB")), dst.view()), Status::ok);
    EXPECT_EQ(dst(0, 0), 'A');
}

TEST(PnmReader, StopsAtTheEndOfTheFileInsteadOfReadingForEver) {
    for (const char* text :
         {"", "P", "P5", "P5 ", "P5 # a comment without an end", "P5 12", "P5 12 ", "P5 12 3 255"}) {
        EXPECT_EQ(inspect_pnm(view_of(bytes_of(text))).status(), Status::truncated) << text;
        EXPECT_EQ(status_of<Gray8>(bytes_of(text), {12, 3}), Status::truncated) << text;
    }
}

TEST(PnmReader, SaysWhyItRefusesAHeader) {
    for (const char* kind : {"P1", "P2", "P3", "P4", "P7"})
        EXPECT_EQ(inspect_pnm(view_of(bytes_of(std::string(kind) + " 1 1 255\nA"))).status(),
                  Status::unsupported);
    for (const char* text :
         {"Q5 1 1 255\nA", "P8 1 1 255\nA", "P51 1 255\nA", "P5# touches\n1 1 255\nA", "P5 0 1 255\nA",
          "P5 1 0 255\nA", "P5 1 1 0\nA", "P5 1 1 65536\nAA", "P5 -1 1 255\nA", "P5 1x 1 255\nA",
          "P5 1 1 255#no white space\nA", "P5 1 1 255A", "P5 1# touches\n1 255\nA", "P5 a"})
        EXPECT_EQ(inspect_pnm(view_of(bytes_of(text))).status(), Status::malformed) << text;
    for (const char* text : {"P5 32768 1 255\nA", "P5 1 32768 255\nA", "P6 4294967297 1 255\nA",
                             "P5 99999999999999999999999999999999 1 255\nA"})
        EXPECT_EQ(inspect_pnm(view_of(bytes_of(text))).status(), Status::image_too_large) << text;
    EXPECT_EQ(inspect_pnm(view_of(bytes_of("P6 32767 32767 65535\n")))->size, (Size{32767, 32767}));
}

TEST(PnmReader, LeavesTheOutputWhenAnythingIsMissing) {
    for (const Bytes& file :
         {pnm("P5 3 2 255\n", {1, 2, 3, 4, 5, 6}), pnm("P5 3 1 2000\n", {1, 2, 3, 4, 5, 6}),
          pnm("P6 1 2 255\n", {1, 2, 3, 4, 5, 6})}) {
        const Size size = inspect_pnm(view_of(file))->size;
        for (std::size_t length = 0; length < file.size(); ++length) {
            GuardedImage<Rgb888> dst(size);
            fill_bytes(dst.view(), 77);
            ASSERT_EQ(decode_pnm(view_of(first_bytes(file, length)), dst.view()), Status::truncated)
                << length;
            ASSERT_TRUE(all_bytes_are(dst.view(), 77));
        }
        EXPECT_EQ(status_of<Rgb888>(file, size), Status::ok);
        GuardedImage<Gray8> other({4, 4});
        fill_bytes(other.view(), 77);
        EXPECT_EQ(decode_pnm(view_of(file), other.view()), Status::size_mismatch);
        EXPECT_TRUE(all_bytes_are(other.view(), 77));
        EXPECT_EQ(decode_pnm(view_of(file), ImageView<Gray8>()), Status::empty_image);
    }
}

template <class Pixel>
void expect_round_trip(Random& random, Size size) {
    GuardedImage<Pixel> src(size);
    src.fill(random);
    const std::int64_t length = encoded_pnm_bytes<Pixel>(size);
    Bytes file = zeros(length);
    const Result<std::ptrdiff_t> written = encode_pnm(src.view(), room_in(file));
    ASSERT_TRUE(written.ok());
    EXPECT_EQ(*written, length);
    EXPECT_EQ(inspect_pnm(view_of(file))->size, size);
    GuardedImage<Pixel> dst(size);
    ASSERT_EQ(decode_pnm(view_of(file), dst.view()), Status::ok);
    EXPECT_TRUE(equal(src.view(), dst.view())) << size.width << "x" << size.height;

    Bytes little(static_cast<std::size_t>(length) - 1, 77);
    EXPECT_EQ(encode_pnm(src.view(), room_in(little)).status(), Status::buffer_too_small);
    EXPECT_EQ(little, Bytes(little.size(), 77));
}

TEST(PnmWriter, IsReadBackInEverySizeFromAFileOfExactlyItsLength) {
    Random random(1);
    for (const Size size : test_sizes()) {
        expect_round_trip<Gray8>(random, size);
        expect_round_trip<Gray16>(random, size);
        expect_round_trip<Rgb888>(random, size);
    }
}

TEST(PnmWriter, WritesTheShortestHeader) {
    GuardedImage<Gray8> gray({2, 1});
    gray(0, 0) = 'A';
    gray(1, 0) = 'B';
    Bytes file = zeros(encoded_pnm_bytes<Gray8>({2, 1}));
    ASSERT_TRUE(encode_pnm(gray.view(), room_in(file)).ok());
    EXPECT_EQ(file, bytes_of("P5\n2 1\n255\nAB"));
    GuardedImage<Gray16> wide({1, 1});
    wide(0, 0) = 0x4142;
    file = zeros(encoded_pnm_bytes<Gray16>({1, 1}));
    ASSERT_TRUE(encode_pnm(wide.view(), room_in(file)).ok());
    EXPECT_EQ(file, bytes_of("P5\n1 1\n65535\nAB"));
}

TEST(PnmWriter, APictureOf768RowsIsNotReadAs7684) {
    // In the original toolkit the number's buffer had no end: a digit of the width was read behind 768.
    GuardedImage<Gray8> src({1024, 768});
    Random random(2);
    src.fill(random);
    Bytes file = zeros(encoded_pnm_bytes<Gray8>({1024, 768}));
    ASSERT_TRUE(encode_pnm(src.view(), room_in(file)).ok());
    EXPECT_EQ(first_bytes(file, 16), bytes_of("P5\n1024 768\n255\n"));
    EXPECT_EQ(inspect_pnm(view_of(file))->size, (Size{1024, 768}));
    GuardedImage<Gray8> dst({1024, 768});
    ASSERT_EQ(decode_pnm(view_of(file), dst.view()), Status::ok);
    EXPECT_TRUE(equal(src.view(), dst.view()));
}

TEST(PnmWriter, SaysWhatIsWrong) {
    Bytes file(100);
    EXPECT_EQ(encode_pnm(ImageView<const Gray8>(), room_in(file)).status(), Status::empty_image);
    const ImageView<const Gray8> wide(file.data(), {32768, 1}, 32768);
    EXPECT_EQ(encode_pnm(wide, room_in(file)).status(), Status::image_too_large);
    EXPECT_EQ(encoded_pnm_bytes<Rgb888>({32767, 32767}), 2 + 3 + 4 + 5 + 5 + 3 * std::int64_t{32767} * 32767);
}

TEST(PnmReader, AgreesWithThePngFilesOfTheSamePictures) {
    const auto folder = data_folder() / "decoders";
    FOVEA_NEED_PICTURE(folder);
    const std::pair<const char*, const char*> pairs[] = {{"basi0g16.pgm", "basn0g16.png"},
                                                         {"basi2c16.ppm", "basn2c16.png"},
                                                         {"cdfn2c08.ppm", "cdfn2c08.png"},
                                                         {"cdun2c08.ppm", "cdun2c08.png"},
                                                         {"ctfn0g04.pgm", "ctfn0g04.png"}};
    for (const auto& [pnm_name, png_name] : pairs) {
        const Bytes plain = read_file(folder / "pnm" / pnm_name);
        const Bytes packed = read_file(folder / "pngsuite" / "png" / png_name);
        const Result<PictureInfo> info = inspect_pnm(view_of(plain));
        ASSERT_TRUE(info.ok()) << pnm_name;
        GuardedImage<Rgb888> from_pnm(info->size);
        GuardedImage<Rgb888> from_png(info->size);
        Bytes scratch = zeros(inspect_png(view_of(packed))->scratch_bytes);
        ASSERT_EQ(decode_pnm(view_of(plain), from_pnm.view()), Status::ok) << pnm_name;
        ASSERT_EQ(decode_png(view_of(packed), room_in(scratch), from_png.view()), Status::ok);
        EXPECT_TRUE(equal(from_pnm.view(), from_png.view())) << pnm_name;
    }
    EXPECT_EQ(status_of<Gray8>(read_file(folder / "pnm" / "comment.pgm"), {32, 32}), Status::ok);
}

}  // namespace
}  // namespace fovea::test
