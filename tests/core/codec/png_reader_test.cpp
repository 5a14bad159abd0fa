// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "lossless_files.hpp"
#include "png_decoding.hpp"

namespace fovea::test {
namespace {

// ---- Files by hand ----------------------------------------------------------------

TEST(PngReader, ReadsGrayAsItStands) {
    const Bytes file = PngFile().header(3, 2, 8, 0).rows({0, 1, 2, 3, 0, 253, 254, 255}).end().bytes;
    const Result<PictureInfo> info = inspect_png(view_of(file));
    ASSERT_TRUE(info.ok());
    EXPECT_EQ(info->size, (Size{3, 2}));
    EXPECT_EQ(info->content, PictureContent::gray8);
    EXPECT_EQ(info->scratch_bytes, inflate_scratch() + 2 * (8 + 3));
    const GuardedImage<Gray8> dst = decoded_png<Gray8>(file, {3, 2});
    for (int x = 0; x < 3; ++x) {
        EXPECT_EQ(dst(x, 0), 1 + x);
        EXPECT_EQ(dst(x, 1), 253 + x);
    }
}

TEST(PngReader, ReadsEveryFilterInTheFirstRowAndBelow) {
    // The samples are 10 20 40 / 12 25 80. Left of the first and above the first row stand zeros.
    const std::vector<std::pair<int, Bytes>> first = {
        {0, {10, 20, 40}}, {1, {10, 10, 20}}, {2, {10, 20, 40}}, {3, {10, 15, 30}}, {4, {10, 10, 20}}};
    // Paeth in the second row: above is 10; nearest to 12 + 20 - 10 is 20; nearest to 25 + 40 - 20 is 40.
    const std::vector<std::pair<int, Bytes>> second = {
        {0, {12, 25, 80}}, {1, {12, 13, 55}}, {2, {2, 5, 40}}, {3, {7, 9, 48}}, {4, {2, 5, 40}}};
    for (const auto& [filter, above] : first)
        for (const auto& [other_filter, below] : second) {
            Bytes rows = {static_cast<std::uint8_t>(filter)};
            append(rows, above);
            rows.push_back(static_cast<std::uint8_t>(other_filter));
            append(rows, below);
            const GuardedImage<Gray8> dst =
                decoded_png<Gray8>(PngFile().header(3, 2, 8, 0).rows(rows).end().bytes, {3, 2});
            const int expected[] = {10, 20, 40, 12, 25, 80};
            for (int i = 0; i < 6; ++i)
                ASSERT_EQ(dst(i % 3, i / 3), expected[i]) << filter << " " << other_filter;
        }
    EXPECT_EQ(decode_with_scratch(PngFile().header(1, 1, 8, 0).rows({5, 0}).end().bytes,
                                  GuardedImage<Gray8>({1, 1}).view()),
              Status::malformed);
}

TEST(PngReader, ThePaethPredictorTakesLeftBeforeAboveBeforeTheCorner) {
    EXPECT_EQ(paeth_predictor(10, 20, 15), 15);
    EXPECT_EQ(paeth_predictor(10, 10, 10), 10);
    EXPECT_EQ(paeth_predictor(1, 3, 2), 2);  // left + above - corner is 2
    EXPECT_EQ(paeth_predictor(0, 4, 2), 2);
    EXPECT_EQ(paeth_predictor(4, 0, 1), 4);  // 3 is as far from 4 as no other
    EXPECT_EQ(paeth_predictor(0, 1, 0), 1);
    EXPECT_EQ(paeth_predictor(5, 9, 6), 9);  // 8 is nearest to 9
    for (int left = 0; left < 256; left += 5)
        for (int above = 0; above < 256; above += 3)
            for (int corner = 0; corner < 256; ++corner) {
                const int sum = left + above - corner;
                int nearest = left;
                if (std::abs(sum - above) < std::abs(sum - nearest)) nearest = above;
                if (std::abs(sum - corner) < std::abs(sum - nearest)) nearest = corner;
                ASSERT_EQ(paeth_predictor(left, above, corner), nearest);
            }
}

TEST(PngReader, SpreadsSmallDepthsOverTheWholeRange) {
    // Nine pixels of one bit: 1 0 1 1 0 0 1 0, 1; the bits behind them mean nothing.
    const Bytes one = PngFile().header(9, 1, 1, 0).rows({0, 0b10110010, 0b11111111}).end().bytes;
    EXPECT_EQ(inspect_png(view_of(one))->content, PictureContent::gray8);
    const GuardedImage<Gray8> bits = decoded_png<Gray8>(one, {9, 1});
    const int expected[] = {255, 0, 255, 255, 0, 0, 255, 0, 255};
    for (int x = 0; x < 9; ++x) EXPECT_EQ(bits(x, 0), expected[x]);

    const GuardedImage<Gray8> two =
        decoded_png<Gray8>(PngFile().header(4, 1, 2, 0).rows({0, 0b00011011}).end().bytes, {4, 1});
    for (int x = 0; x < 4; ++x) EXPECT_EQ(two(x, 0), 85 * x);
    const Bytes four = PngFile().header(3, 1, 4, 0).rows({0, 0x0f, 0x80}).end().bytes;
    const GuardedImage<Gray8> nibbles = decoded_png<Gray8>(four, {3, 1});
    EXPECT_EQ(nibbles(0, 0), 0);
    EXPECT_EQ(nibbles(1, 0), 255);
    EXPECT_EQ(nibbles(2, 0), 8 * 17);
    EXPECT_EQ(decoded_png<Gray16>(four, {3, 1})(2, 0), 8 * 0x1111);
    EXPECT_EQ(decoded_png<Rgb888>(four, {3, 1})(2, 0), (Rgb888{136, 136, 136}));
}

TEST(PngReader, ReadsSixteenBitsIntoSixteenAndRoundsThemIntoEight) {
    const Bytes file =
        PngFile().header(3, 1, 16, 0).rows({0, 0x12, 0x34, 0x00, 0x80, 0x00, 0x81}).end().bytes;
    EXPECT_EQ(inspect_png(view_of(file))->content, PictureContent::gray16);
    const GuardedImage<Gray16> wide = decoded_png<Gray16>(file, {3, 1});
    EXPECT_EQ(wide(0, 0), 0x1234);
    EXPECT_EQ(wide(1, 0), 0x80);
    const GuardedImage<Gray8> narrow = decoded_png<Gray8>(file, {3, 1});
    EXPECT_EQ(narrow(0, 0), 0x12);
    // 128 / 257 is below a half, 129 / 257 above.
    EXPECT_EQ(narrow(1, 0), 0);
    EXPECT_EQ(narrow(2, 0), 1);
}

TEST(PngReader, ReadsColoursAndShowsThemOnWhite) {
    const Bytes rgb = PngFile().header(2, 1, 8, 2).rows({0, 1, 2, 3, 4, 5, 6}).end().bytes;
    EXPECT_EQ(inspect_png(view_of(rgb))->content, PictureContent::rgb888);
    EXPECT_EQ(decoded_png<Rgb888>(rgb, {2, 1})(1, 0), (Rgb888{4, 5, 6}));
    EXPECT_EQ(decoded_png<Gray8>(rgb, {2, 1})(1, 0), gray_of({4, 5, 6}));
    EXPECT_EQ(decoded_png<Gray16>(rgb, {2, 1})(1, 0), 257 * gray_of({4, 5, 6}));
    const Bytes rgba = PngFile().header(2, 1, 8, 6).rows({0, 1, 2, 3, 0, 4, 5, 6, 128}).end().bytes;
    EXPECT_EQ(decoded_png<Rgb888>(rgba, {2, 1})(0, 0), (Rgb888{255, 255, 255}));
    // 255 - 251 * 128 / 255 = 129.004, and so on.
    EXPECT_EQ(decoded_png<Rgb888>(rgba, {2, 1})(1, 0), (Rgb888{129, 130, 130}));
    const Bytes gray_alpha = PngFile().header(2, 1, 8, 4).rows({0, 7, 0, 8, 255}).end().bytes;
    EXPECT_EQ(inspect_png(view_of(gray_alpha))->content, PictureContent::gray8);
    EXPECT_EQ(decoded_png<Gray8>(gray_alpha, {2, 1})(0, 0), 255);
    EXPECT_EQ(decoded_png<Gray8>(gray_alpha, {2, 1})(1, 0), 8);
    const Bytes deep =
        PngFile().header(1, 1, 16, 6).rows({0, 255, 255, 0x80, 0x80, 0, 0, 255, 255}).end().bytes;
    EXPECT_EQ(inspect_png(view_of(deep))->content, PictureContent::rgb48);
    EXPECT_EQ(inspect_png(view_of(deep))->scratch_bytes, png_reader_scratch({1, 1}));
    EXPECT_EQ(decoded_png<Rgb888>(deep, {1, 1})(0, 0), (Rgb888{255, 128, 0}));
    const Bytes deep_gray = PngFile().header(1, 1, 16, 4).rows({0, 0x12, 0x34, 0, 1}).end().bytes;
    EXPECT_EQ(decoded_png<Gray16>(deep_gray, {1, 1})(0, 0), 65534);  // 65535 - 60875 / 65535
}

TEST(PngReader, LooksColoursUpInThePalette) {
    const Bytes palette = {255, 0, 0, 0, 255, 0, 0, 0, 255};
    const Bytes file = PngFile().header(4, 1, 2, 3).chunk("PLTE", palette).rows({0, 0b00011000}).end().bytes;
    EXPECT_EQ(inspect_png(view_of(file))->content, PictureContent::rgb888);
    const GuardedImage<Rgb888> dst = decoded_png<Rgb888>(file, {4, 1});
    EXPECT_EQ(dst(0, 0), (Rgb888{255, 0, 0}));
    EXPECT_EQ(dst(1, 0), (Rgb888{0, 255, 0}));
    EXPECT_EQ(dst(2, 0), (Rgb888{0, 0, 255}));
    EXPECT_EQ(decoded_png<Gray8>(file, {4, 1})(1, 0), gray_of({0, 255, 0}));
    // The fourth index has no colour.
    const Bytes beyond =
        PngFile().header(4, 1, 2, 3).chunk("PLTE", palette).rows({0, 0b00011011}).end().bytes;
    EXPECT_EQ(decode_with_scratch(beyond, GuardedImage<Rgb888>({4, 1}).view()), Status::malformed);
}

TEST(PngReader, JoinsDataOfSeveralChunksAndSkipsWhatItMaySkip) {
    const Bytes data = zlib_stored({0, 1, 2, 3, 0, 4, 5, 6});
    PngFile file;
    file.header(3, 2, 8, 0).chunk("gAMA", {0, 0, 1, 0}).chunk("teXt", bytes_of("a text")).chunk("IDAT", {});
    for (const std::uint8_t byte : data) file.chunk("IDAT", {byte});
    file.chunk("IDAT", {}).chunk("tIME", Bytes(7)).end();
    EXPECT_EQ(decoded_png<Gray8>(file.bytes, {3, 2})(2, 1), 6);
    append(file.bytes, bytes_of("whatever follows"));
    EXPECT_EQ(decoded_png<Gray8>(file.bytes, {3, 2})(2, 1), 6);
}

// ---- Refusals ---------------------------------------------------------------------

TEST(PngReader, SaysWhyItRefusesAHeader) {
    const auto status = [](const PngFile& file) { return inspect_png(view_of(file.bytes)).status(); };
    EXPECT_EQ(status(PngFile().header(1, 1, 8, 0, 0, 0, 1)), Status::unsupported);
    EXPECT_EQ(status(PngFile().header(32768, 1, 8, 0)), Status::image_too_large);
    EXPECT_EQ(status(PngFile().header(1, 32768, 8, 0)), Status::image_too_large);
    EXPECT_EQ(status(PngFile().header(0x7fffffff, 1, 8, 0)), Status::image_too_large);
    EXPECT_EQ(status(PngFile().header(0, 1, 8, 0)), Status::malformed);
    EXPECT_EQ(status(PngFile().header(1, 0, 8, 0)), Status::malformed);
    EXPECT_EQ(status(PngFile().header(0x80000000, 1, 8, 0)), Status::malformed);
    EXPECT_EQ(status(PngFile().header(1, 1, 8, 0, 1)), Status::malformed);
    EXPECT_EQ(status(PngFile().header(1, 1, 8, 0, 0, 1)), Status::malformed);
    EXPECT_EQ(status(PngFile().header(1, 1, 8, 0, 0, 0, 2)), Status::malformed);
    EXPECT_EQ(status(PngFile().chunk("IHDR", Bytes(12))), Status::malformed);
    EXPECT_EQ(status(PngFile().chunk("IDAT", Bytes(13))), Status::malformed);
    EXPECT_TRUE(inspect_png(view_of(PngFile().header(32767, 32767, 16, 6).bytes)).ok());
    for (int colour = 0; colour < 256; ++colour)
        for (int depth = 0; depth < 256; ++depth) {
            const bool power = depth == 1 || depth == 2 || depth == 4;
            const bool right = (colour == 0 && (power || depth == 8 || depth == 16)) ||
                               (colour == 3 && (power || depth == 8)) ||
                               ((colour == 2 || colour == 4 || colour == 6) && (depth == 8 || depth == 16));
            ASSERT_EQ(inspect_png(view_of(PngFile().header(1, 1, depth, colour).bytes)).ok(), right);
        }
}

TEST(PngReader, RefusesChunksOutOfOrderBeforeItWritesAPixel) {
    const Bytes row = {0, 9};
    const Bytes palette(6);
    const auto file = [] { return PngFile().header(1, 1, 8, 0); };
    const auto indexed = [] { return PngFile().header(1, 1, 1, 3); };
    EXPECT_EQ(png_refusal(file().end().bytes), Status::malformed);
    EXPECT_EQ(png_refusal(file().rows(row).chunk("IEND", {0}).bytes), Status::malformed);
    EXPECT_EQ(png_refusal(file().rows(row).header(1, 1, 8, 0).end().bytes), Status::malformed);
    EXPECT_EQ(png_refusal(file().rows(row).chunk("tIME", {}).rows(row).end().bytes), Status::malformed);
    EXPECT_EQ(png_refusal(file().chunk("PLTE", palette).rows(row).end().bytes), Status::malformed);
    EXPECT_EQ(png_refusal(indexed().rows(row).end().bytes), Status::malformed);
    EXPECT_EQ(png_refusal(indexed().rows(row).chunk("PLTE", palette).end().bytes), Status::malformed);
    EXPECT_EQ(png_refusal(indexed().chunk("PLTE", palette).chunk("PLTE", palette).rows(row).end().bytes),
              Status::malformed);
    for (const std::size_t bytes : {0u, 1u, 5u, 9u})
        EXPECT_EQ(png_refusal(indexed().chunk("PLTE", Bytes(bytes)).rows(row).end().bytes), Status::malformed)
            << bytes;
    EXPECT_EQ(png_refusal(
                  PngFile().header(1, 1, 8, 2).chunk("PLTE", Bytes(3 * 257)).rows({0, 1, 2, 3}).end().bytes),
              Status::malformed);
    EXPECT_EQ(decode_with_scratch(
                  PngFile().header(1, 1, 8, 2).chunk("PLTE", palette).rows({0, 1, 2, 3}).end().bytes,
                  GuardedImage<Gray8>({1, 1}).view()),
              Status::ok);
}

TEST(PngReader, RefusesUnknownChunksThatMustNotBeSkipped) {
    const auto status = [](const std::string& name) {
        return png_refusal(PngFile().header(1, 1, 8, 0).chunk(name, {}).rows({0, 9}).chunk("zzZz", {}).bytes);
    };
    EXPECT_EQ(status("ABCD"), Status::unsupported);
    EXPECT_EQ(status("CgBI"), Status::unsupported);
    EXPECT_EQ(status("abCD"), Status::truncated);  // skipped: what is missing is IEND
    for (const char* name : {"ab1D", "@bCD", "abC[", "ab`D", "abC{"})
        EXPECT_EQ(status(name), Status::malformed) << name;
}

TEST(PngReader, RefusesWrongChecksumsBeforeItWritesAPixel) {
    const Bytes file = PngFile().header(1, 1, 8, 0).chunk("tEXt", {1, 2, 3}).rows({0, 9}).end().bytes;
    EXPECT_EQ(decode_with_scratch(file, GuardedImage<Gray8>({1, 1}).view()), Status::ok);
    for (std::size_t at = 0; at < file.size(); ++at)
        for (const int change : {1, 0x20, 0x80, 0xff}) {
            Bytes changed = file;
            changed[at] ^= static_cast<std::uint8_t>(change);
            ASSERT_NE(png_refusal(changed), Status::ok) << at;
        }
}

TEST(PngReader, LeavesTheOutputOfATruncatedFile) {
    const Bytes file = PngFile().header(1, 1, 8, 0).chunk("tEXt", {1, 2, 3}).rows({0, 9}).end().bytes;
    for (std::size_t length = 0; length < file.size(); ++length) {
        ASSERT_EQ(png_refusal(first_bytes(file, length)), Status::truncated) << length;
        EXPECT_EQ(inspect_png(view_of(first_bytes(file, length))).status(),
                  length < 8 + 25 ? Status::truncated : Status::ok);
    }
}

TEST(PngReader, KeepsTheRowsBeforeAFaultInDataWithRightChecksums) {
    // The second row has no such filter; the third is missing.
    for (const Bytes& rows :
         {Bytes{0, 1, 2, 9, 3, 4, 0, 5, 6}, Bytes{0, 1, 2}, Bytes{0, 1, 2, 0}, Bytes{0, 1, 2, 0, 3}}) {
        GuardedImage<Gray8> dst({2, 3});
        fill_bytes(dst.view(), 77);
        const Status status =
            decode_with_scratch(PngFile().header(2, 3, 8, 0).rows(rows).end().bytes, dst.view());
        EXPECT_EQ(status, rows.size() == 9 ? Status::malformed : Status::truncated);
        EXPECT_EQ(dst(0, 0), 1);
        EXPECT_EQ(dst(1, 0), 2);
        for (int y = 1; y < 3; ++y)
            for (int x = 0; x < 2; ++x) EXPECT_EQ(dst(x, y), 77);
    }
}

TEST(PngReader, RefusesMoreDataThanThePictureHas) {
    const auto status = [](const Bytes& data) {
        GuardedImage<Gray8> dst({1, 1});
        return decode_with_scratch(PngFile().header(1, 1, 8, 0).chunk("IDAT", data).end().bytes, dst.view());
    };
    const Bytes right = zlib_stored({0, 9});
    EXPECT_EQ(status(right), Status::ok);
    EXPECT_EQ(status(zlib_stored({0, 9, 0})), Status::malformed);
    Bytes wrong = right;
    wrong.push_back(0);
    EXPECT_EQ(status(wrong), Status::malformed);
    wrong = right;
    wrong.back() ^= 1;
    EXPECT_EQ(status(wrong), Status::malformed);
    for (std::size_t length = 0; length < right.size(); ++length)
        EXPECT_EQ(status(first_bytes(right, length)), Status::truncated) << length;
}

TEST(PngReader, ChecksTheOutputThenTheScratch) {
    const Bytes file = PngFile().header(3, 2, 8, 0).rows({0, 1, 2, 3, 0, 4, 5, 6}).end().bytes;
    Bytes scratch = zeros(png_reader_scratch({3, 2}, 8));
    EXPECT_EQ(decode_png(view_of(file), room_in(scratch), ImageView<Gray8>()), Status::empty_image);
    GuardedImage<Gray8> dst({3, 2});
    GuardedImage<Gray8> other({2, 3});
    fill_bytes(dst.view(), 77);
    fill_bytes(other.view(), 77);
    EXPECT_EQ(decode_png(view_of(file), Span<std::uint8_t>(), other.view()), Status::size_mismatch);
    for (const std::ptrdiff_t less : {std::ptrdiff_t{1}, room_in(scratch).size()}) {
        const Span<std::uint8_t> little = room_in(scratch).first(room_in(scratch).size() - less);
        EXPECT_EQ(decode_png(view_of(file), little, dst.view()), Status::scratch_too_small);
    }
    EXPECT_TRUE(all_bytes_are(dst.view(), 77) && all_bytes_are(other.view(), 77));
    EXPECT_EQ(decode_png(view_of(file), room_in(scratch), dst.view()), Status::ok);
}

TEST(PngReader, NeedsNoMoreScratchThanItsBoundForAnyDepth) {
    for (const int width : {1, 7, 640, 32767})
        for (const auto& [depth, colour] : {std::pair{1, 0}, {2, 3}, {16, 0}, {16, 2}, {8, 6}, {16, 6}}) {
            const Bytes header = PngFile().header(static_cast<std::uint32_t>(width), 1, depth, colour).bytes;
            EXPECT_LE(inspect_png(view_of(header))->scratch_bytes, png_reader_scratch({width, 1}));
        }
}

}  // namespace
}  // namespace fovea::test
