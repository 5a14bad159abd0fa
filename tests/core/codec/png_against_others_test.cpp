// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include <fovea/base/random.hpp>
#include <fovea/codec/bmp.hpp>
#include <support/picture.hpp>

#include "lossless_files.hpp"
#include "png_decoding.hpp"

#if defined(FOVEA_HAVE_LIBPNG)
#include "libpng_oracle.hpp"
#endif

namespace fovea::test {
namespace {

// ---- PngSuite and its twins -------------------------------------------------------

TEST(PngSuite, EveryPictureEqualsItsTwinInBmp) {
    const auto folder = data_folder() / "decoders" / "pngsuite";
    FOVEA_NEED_PICTURE(folder);
    int compared = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "png")) {
        const std::string name = entry.path().stem().string();
        // Twins know nothing of alpha, and that of tbbn0g04 is black where the picture is transparent.
        if (name[0] == 'x' || name[3] == 'i' || name[5] == 'a' || name == "tbbn0g04") continue;
        const Bytes png = read_file(entry.path());
        const Bytes bmp = read_file(folder / "bmp" / (name + ".bmp"));
        const Size size = inspect_png(view_of(png))->size;
        ASSERT_EQ(inspect_bmp(view_of(bmp))->size, size) << name;
        const GuardedImage<Rgb888> ours = decoded_png<Rgb888>(png, size);
        GuardedImage<Rgb888> twin(size);
        ASSERT_EQ(decode_bmp(view_of(bmp), twin.view()), Status::ok) << name;
        // Of 16 bits the twins hold the higher byte. v / 257 is at most 255 / 257 below v / 256, so that the
        // nearest integer to the one and the next below the other are at most 1 apart.
        const int tolerance = name.substr(name.size() - 2) == "16" ? 1 : 0;
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
                ASSERT_LE(std::abs(ours(x, y).red - twin(x, y).red), tolerance) << name;
                ASSERT_LE(std::abs(ours(x, y).green - twin(x, y).green), tolerance) << name;
                ASSERT_LE(std::abs(ours(x, y).blue - twin(x, y).blue), tolerance) << name;
            }
        ++compared;
    }
    EXPECT_EQ(compared, 114);
}

#if defined(FOVEA_HAVE_LIBPNG)

// ---- Against libpng ---------------------------------------------------------------

/// Compares all three pixels with what libpng reads.
void expect_as_libpng(const Bytes& file, const std::string& name) {
    const LibpngPicture expected = libpng_read(file);
    ASSERT_TRUE(expected.read) << name;
    const Result<PictureInfo> info = inspect_png(view_of(file));
    ASSERT_TRUE(info.ok()) << name << ": " << describe(info.status());
    ASSERT_EQ(info->size, expected.size) << name;
    const bool gray = info->content == PictureContent::gray8 || info->content == PictureContent::gray16;
    ASSERT_EQ(gray, expected.gray) << name;
    const GuardedImage<Rgb888> colour = decoded_png<Rgb888>(file, info->size);
    const GuardedImage<Gray8> level = decoded_png<Gray8>(file, info->size);
    const GuardedImage<Gray16> wide = decoded_png<Gray16>(file, info->size);
    const std::uint8_t* sample = expected.samples.data();
    for (int y = 0; y < info->size.height; ++y)
        for (int x = 0; x < info->size.width; ++x, sample += gray ? 1 : 3) {
            const Rgb888 right =
                gray ? Rgb888{sample[0], sample[0], sample[0]} : Rgb888{sample[0], sample[1], sample[2]};
            ASSERT_EQ(colour(x, y), right) << name << " at " << x << "," << y;
            ASSERT_EQ(level(x, y), gray ? sample[0] : gray_of(right)) << name;
            if (expected.file_depth < 16 || !gray) {
                ASSERT_EQ(wide(x, y), 257 * level(x, y)) << name;
            } else {
                // Their 16 bits were rounded to 8, and these must round to the same.
                ASSERT_EQ((wide(x, y) + 128) / 257, sample[0]) << name;
            }
        }
}

TEST(PngSuite, EveryPictureIsReadAsLibpngReadsItOrRefusedByName) {
    const auto folder = data_folder() / "decoders" / "pngsuite" / "png";
    FOVEA_NEED_PICTURE(folder);
    int read = 0;
    int refused = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        const Bytes file = read_file(entry.path());
        if (name[0] == 'x') {
            // Corrupt: signature, header, checksum or data. What they have of a header may say their size.
            const Result<PictureInfo> info = inspect_png(view_of(file));
            EXPECT_EQ(png_refusal(file, info ? info->size : Size{32, 32}), Status::malformed) << name;
            ++refused;
        } else if (name[3] == 'i') {
            EXPECT_EQ(png_refusal(file, {32, 32}), Status::unsupported) << name;
            ++refused;
        } else {
            expect_as_libpng(file, name);
            ++read;
        }
    }
    // Of 175 files 14 are corrupt and 35 interlaced.
    EXPECT_EQ(read, 126);
    EXPECT_EQ(refused, 49);
}

TEST(PngReader, ReadsThePicturesOfOpencvAsLibpngReadsThem) {
    FOVEA_NEED_PICTURE(opencv_doc_folder());
    int read = 0;
    for (const auto& entry : std::filesystem::directory_iterator(opencv_doc_folder())) {
        if (entry.path().extension() != ".png") continue;
        expect_as_libpng(read_file(entry.path()), entry.path().filename().string());
        ++read;
    }
    EXPECT_GE(read, 30);
}

TEST(PngReader, ReadsWhatLibpngWritesInEverySizeWithEveryFilter) {
    Random random(1);
    for (const Size size : test_sizes())
        for (const bool gray : {true, false})
            for (const int filters : {PNG_FILTER_NONE, PNG_FILTER_SUB, PNG_FILTER_UP, PNG_FILTER_AVG,
                                      PNG_FILTER_PAETH, PNG_ALL_FILTERS}) {
                Bytes samples = zeros(size.area() * (gray ? 1 : 3));
                // Smooth with a little noise, so that all filters and matches come up.
                for (std::size_t i = 0; i < samples.size(); ++i)
                    samples[i] = static_cast<std::uint8_t>(i / 7 + random.below(4));
                expect_as_libpng(libpng_write(samples, size, gray, filters), "made here");
            }
}

TEST(PngReader, EveryChangedByteIsRefusedOrChangesNothing) {
    Random random(2);
    const Size size{13, 7};
    Bytes samples = zeros(size.area() * 3);
    for (std::uint8_t& sample : samples) sample = static_cast<std::uint8_t>(random.below(40));
    const Bytes file = libpng_write(samples, size, false);
    const GuardedImage<Rgb888> expected = decoded_png<Rgb888>(file, size);
    for (std::size_t at = 0; at < file.size(); ++at)
        for (int bit = 0; bit < 8; ++bit) {
            Bytes changed = file;
            changed[at] ^= static_cast<std::uint8_t>(1 << bit);
            GuardedImage<Rgb888> dst(size);
            ASSERT_TRUE(decode_with_scratch(changed, dst.view()) != Status::ok ||
                        equal(dst.view(), expected.view()))
                << at;
        }
    for (std::size_t length = 0; length < file.size(); ++length)
        ASSERT_EQ(png_refusal(first_bytes(file, length), size), Status::truncated) << length;
}

#endif

}  // namespace
}  // namespace fovea::test
