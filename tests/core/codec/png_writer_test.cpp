// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/codec/png_reader.hpp>
#include <fovea/codec/png_writer.hpp>
#include <support/guarded_image.hpp>
#include <support/picture.hpp>

#include "lossless_files.hpp"

#if defined(FOVEA_HAVE_LIBPNG)
#include "libpng_oracle.hpp"
#endif

namespace fovea::test {
namespace {

/// The file of a picture, written with exactly the scratch it asks for, at an odd address.
template <class Pixel>
Bytes encoded(ImageView<const Pixel> src) {
    Bytes scratch(static_cast<std::size_t>(png_writer_scratch(src.size())) + 1, 0xa5);
    Bytes file = zeros(encoded_png_bytes<Pixel>(src.size()));
    const Result<std::ptrdiff_t> length = encode_png(src, room_in(scratch).from(1), room_in(file));
    EXPECT_TRUE(length.ok()) << describe(length.status());
    file.resize(length ? static_cast<std::size_t>(*length) : 0);
    return file;
}

template <class Pixel>
void expect_read_back(ImageView<const Pixel> src, const std::string& name) {
    const Bytes file = encoded(src);
    const Result<PictureInfo> info = inspect_png(view_of(file));
    ASSERT_TRUE(info.ok()) << name;
    EXPECT_EQ(info->size, src.size());
    EXPECT_EQ(info->content, sizeof(Pixel) == 1 ? PictureContent::gray8 : PictureContent::rgb888);
    GuardedImage<Pixel> dst(src.size());
    Bytes scratch = zeros(info->scratch_bytes);
    ASSERT_EQ(decode_png(view_of(file), room_in(scratch), dst.view()), Status::ok) << name;
    EXPECT_TRUE(equal(src, dst.view())) << name;
#if defined(FOVEA_HAVE_LIBPNG)
    const LibpngPicture theirs = libpng_read(file);
    ASSERT_TRUE(theirs.read) << name;
    ASSERT_EQ(theirs.size, src.size());
    const std::size_t row_bytes = sizeof(Pixel) * static_cast<std::size_t>(src.width());
    for (int y = 0; y < src.height(); ++y)
        ASSERT_EQ(std::memcmp(src.row(y), theirs.samples.data() + static_cast<std::size_t>(y) * row_bytes,
                              row_bytes),
                  0)
            << name;
#endif
}

/// Pictures that ask for different filters, codes and matches.
template <class Pixel>
void fill_with(int kind, Random& random, GuardedImage<Pixel>& image) {
    const ImageView<Pixel> view = image.view();
    for (int y = 0; y < view.height(); ++y) {
        auto* row = reinterpret_cast<std::uint8_t*>(view.row(y));
        for (int i = 0; i < view.width() * static_cast<int>(sizeof(Pixel)); ++i) {
            const int values[] = {0,
                                  255,
                                  (i + y) % 2 * 255,
                                  i + 3 * y,
                                  i * y / 9,
                                  static_cast<int>(random.below(3)) + i,
                                  static_cast<int>(random.below(256)),
                                  static_cast<int>(random.below(2)) * 255};
            row[i] = static_cast<std::uint8_t>(values[kind]);
        }
    }
}
constexpr int kinds = 8;

TEST(PngWriter, WritesTheSmallestPictureAsWorkedByHand) {
    GuardedImage<Gray8> src({1, 1});
    src(0, 0) = 'a';
    // Filter 0 and 'a': the fixed code's 00110000, 10010001 and 0000000 behind 1, 1, 0.
    const Bytes data = {0x58, 0x09, 0x63, 0x48, 0x04, 0x00, 0x00, 0x63, 0x00, 0x62};
    EXPECT_EQ(encoded(ImageView<const Gray8>(src.view())),
              PngFile().header(1, 1, 8, 0).chunk("IDAT", data).end().bytes);
}

TEST(PngWriter, IsReadBackInEverySizeWhateverThePicture) {
    Random random(1);
    for (const Size size : test_sizes())
        for (int kind = 0; kind < kinds; ++kind) {
            GuardedImage<Gray8> gray(size);
            fill_with(kind, random, gray);
            expect_read_back(ImageView<const Gray8>(gray.view()), "gray " + std::to_string(kind));
            GuardedImage<Rgb888> colour(size);
            fill_with(kind, random, colour);
            expect_read_back(ImageView<const Rgb888>(colour.view()), "colour " + std::to_string(kind));
        }
}

TEST(PngWriter, CutsRowsWhereverABlockEnds) {
    Random random(2);
    for (const Size size : {Size{8191, 3}, Size{8192, 3}, Size{2730, 3}, Size{32767, 2}}) {
        GuardedImage<Rgb888> src(size);
        fill_with(5, random, src);
        expect_read_back(ImageView<const Rgb888>(src.view()), std::to_string(size.width));
    }
}

TEST(PngWriter, ChoosesTheFilterThatLeavesLeast) {
    // A column of steep steps goes up, a row of them goes left, a slope is for the mean or Paeth.
    const auto filter_of = [](auto value) {
        GuardedImage<Gray8> src({40, 2});
        for (int y = 0; y < 2; ++y)
            for (int x = 0; x < 40; ++x) src(x, y) = static_cast<Gray8>(value(x, y));
        return detail::PngRow<1>{src.view().row(1), src.view().row(0), 40}.best_filter();
    };
    EXPECT_EQ(filter_of([](int, int) { return 0; }), Png::none);
    EXPECT_EQ(filter_of([](int x, int y) { return y == 0 ? x * 37 : 100 + x; }), Png::sub);
    EXPECT_EQ(filter_of([](int x, int y) { return x * 37 + y; }), Png::up);
    EXPECT_EQ(filter_of([](int x, int y) { return y == 0 ? 40 + 4 * x : 20 + 2 * x; }), Png::sub);
    EXPECT_EQ(filter_of([](int x, int y) { return x < 20 ? 10 + 90 * y : 200; }), Png::paeth);
}

TEST(PngWriter, StaysWithinItsBoundOnNoise) {
    Random random(3);
    for (const Size size : {Size{1, 1}, Size{100, 100}, Size{333, 77}}) {
        GuardedImage<Rgb888> src(size);
        fill_with(6, random, src);
        const Bytes file = encoded(ImageView<const Rgb888>(src.view()));
        EXPECT_GE(static_cast<std::int64_t>(file.size()), 3 * size.area());
        EXPECT_LE(static_cast<std::int64_t>(file.size()), encoded_png_bytes<Rgb888>(size));
    }
    EXPECT_EQ(encoded_png_bytes<Gray8>({1, 1}), 8 + 25 + 12 + (6 + 5 + 2) + 12);
}

TEST(PngWriter, FitsIntoExactlyItsLengthAndNotIntoLess) {
    Random random(4);
    for (const int kind : {0, 5, 6}) {
        GuardedImage<Gray8> src({50, 9});
        fill_with(kind, random, src);
        const ImageView<const Gray8> view = src.view();
        const Bytes file = encoded(view);
        Bytes scratch = zeros(png_writer_scratch(view.size()));
        for (std::size_t length = 0; length < file.size(); ++length) {
            Bytes little(length);
            ASSERT_EQ(encode_png(view, room_in(scratch), room_in(little)).status(), Status::buffer_too_small)
                << length;
        }
        Bytes exact(file.size());
        ASSERT_TRUE(encode_png(view, room_in(scratch), room_in(exact)).ok());
        EXPECT_EQ(exact, file);
    }
}

TEST(PngWriter, SaysWhatIsWrongAndLeavesTheOutput) {
    GuardedImage<Gray8> src({4, 4});
    src.fill(Gray8{1});
    Bytes scratch = zeros(png_writer_scratch({4, 4}));
    Bytes out(1000, 77);
    EXPECT_EQ(encode_png(ImageView<const Gray8>(), room_in(scratch), room_in(out)).status(),
              Status::empty_image);
    const ImageView<const Gray8> wide(out.data(), {32768, 1}, 32768);
    EXPECT_EQ(encode_png(wide, room_in(scratch), room_in(out)).status(), Status::image_too_large);
    // Of 3 * 32767 * 32767 bytes the length does not fit one chunk.
    const ImageView<const Rgb888> huge(reinterpret_cast<const Rgb888*>(out.data()), {32767, 32767}, 98301);
    EXPECT_EQ(encode_png(huge, room_in(scratch), room_in(out)).status(), Status::image_too_large);
    const Span<std::uint8_t> little = room_in(scratch).first(room_in(scratch).size() - 1);
    EXPECT_EQ(encode_png(src.view(), little, room_in(out)).status(), Status::scratch_too_small);
    EXPECT_EQ(out, Bytes(1000, 77));
}

#if defined(FOVEA_HAVE_LIBPNG)

TEST(PngWriter, IsCloseToLibpngOnRealPictures) {
    FOVEA_NEED_PICTURE(opencv_doc_folder());
    std::size_t ours = 0;
    std::size_t theirs = 0;
    for (const char* name : {"basketball1.png", "box.png", "cards.png", "rubberwhale1.png", "smarties.png"}) {
        const LibpngPicture picture = libpng_read(read_file(opencv_doc_folder() / name));
        ASSERT_TRUE(picture.read) << name;
        theirs += libpng_write(picture.samples, picture.size, picture.gray).size();
        if (picture.gray) {
            const ImageView<const Gray8> src(picture.samples.data(), picture.size, picture.size.width);
            ours += encoded(src).size();
            expect_read_back(src, name);
        } else {
            const ImageView<const Rgb888> src(reinterpret_cast<const Rgb888*>(picture.samples.data()),
                                              picture.size, std::ptrdiff_t{3} * picture.size.width);
            ours += encoded(src).size();
            expect_read_back(src, name);
        }
    }
    // 4.0 % more than libpng with its level 6 and its window of 32 KiB.
    EXPECT_LT(100 * ours, 105 * theirs);
}

#endif

}  // namespace
}  // namespace fovea::test
