// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include <fovea/base/random.hpp>

#include "jpeg_pictures.hpp"

namespace fovea::test {
namespace {

// ---- Worked by hand ---------------------------------------------------------------

TEST(DecodeJpeg, ReadsAFlatBlockWorkedByHand) {
    Bytes file = {0xff, 0xd8, 0xff, 0xdb, 0, 67, 0};
    file.insert(file.end(), 64, 8);  // all steps are 8, so a DC coefficient of d is a level of 128 + d
    const Bytes rest = {
        0xff, 0xc0, 0, 11, 8, 0, 8, 0, 8, 1, 1, 0x11, 0,  // 8 x 8, one component
        0xff, 0xda, 0, 8, 1, 1, 0, 0, 63, 0,
        // The level 100 is -28: 110 for five bits, 00011 for -28; 1010 for no more; ones to fill.
        0b11000011, 0b10101111, 0xff, 0xd9};
    file.insert(file.end(), rest.begin(), rest.end());
    const Result<PictureInfo> info = inspect_jpeg(span_of(file));
    ASSERT_TRUE(info);
    EXPECT_EQ(info->size, (Size{8, 8}));
    EXPECT_EQ(info->content, PictureContent::gray8);
    GuardedImage<Gray8> gray({8, 8});
    GuardedImage<Rgb888> rgb({8, 8});
    ASSERT_EQ(decode_with_scratch(file, gray), Status::ok);
    ASSERT_EQ(decode_with_scratch(file, rgb), Status::ok);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
            EXPECT_EQ(gray(x, y), 100);
            EXPECT_EQ(rgb(x, y), (Rgb888{100, 100, 100}));
        }
}

TEST(DecodeJpeg, PredictsTheMeanFromTheBlockBeforeAndCutsTheLast) {
    JpegFile file;
    file.quantiser(0, 8).frame({11, 3}, 1).scan(1);
    file.bits("110 00011 1010").bits("100 110 1010").pad().marker(0xd9);  // -28, then 6 more
    GuardedImage<Gray8> dst({11, 3});
    ASSERT_EQ(decode_with_scratch(file.bytes, dst), Status::ok);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 11; ++x) EXPECT_EQ(dst(x, y), x < 8 ? 100 : 106);
}

TEST(DecodeJpeg, ReadsFlatColourWorkedByHand) {
    // Y 100 in four blocks, Cb 138, Cr 108: red 100 - 28, green 100 - 3.44 + 14.28, blue 100 + 17.72.
    JpegFile file;
    file.quantiser(0, 8).frame({16, 16}, 3, {2, 2}).scan(3);
    file.bits("110 00011 1010").bits("00 1010").bits("00 1010").bits("00 1010");
    file.bits("1110 1010 00").bits("11110 01011 00").pad().marker(0xd9);  // K.4: 10 and -20; K.6: 00 ends
    GuardedImage<Rgb888> rgb({16, 16});
    ASSERT_EQ(decode_with_scratch(file.bytes, rgb), Status::ok);
    GuardedImage<Gray8> gray({16, 16});
    ASSERT_EQ(decode_with_scratch(file.bytes, gray), Status::ok);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            ASSERT_EQ(rgb(x, y), (Rgb888{72, 111, 118}));
            ASSERT_EQ(gray(x, y), 100);
        }
}

// ---- Damage -----------------------------------------------------------------------

TEST(DecodeJpeg, SaysTruncatedForEveryLengthThatIsNotWhole) {
    Random random(53);
    for (const int restart : {0, 2}) {
        const RandomPicture picture(random, {40, 24}, 3, {2, 2}, {1, 1}, restart);
        const Bytes& whole = picture.file.bytes;
        for (std::size_t length = 0; length < whole.size(); ++length) {
            const Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
            ASSERT_EQ(status_of<Gray8>(cut, picture.size), Status::truncated) << length;
            ASSERT_EQ(status_of<Rgb888>(cut, picture.size), Status::truncated) << length;
        }
        EXPECT_EQ(status_of<Gray8>(whole, picture.size), Status::ok);
    }
}

TEST(DecodeJpeg, SurvivesAHundredThousandBitFlips) {
    Random random(54);
    const std::vector<RandomPicture> pictures = {{random, {24, 16}, 3, {2, 2}, {1, 1}, 0},
                                                 {random, {17, 20}, 3, {2, 1}, {1, 1}, 1},
                                                 {random, {9, 25}, 3, {1, 2}, {1, 1}, 2},
                                                 {random, {26, 11}, 1, {1, 1}, {1, 1}, 3}};
    int passed = 0;
    for (const RandomPicture& picture : pictures) {
        GuardedImage<Gray8> gray(picture.size);
        GuardedImage<Rgb888> rgb(picture.size);
        const Result<PictureInfo> info = inspect_jpeg(span_of(picture.file.bytes));
        ASSERT_TRUE(info);
        for (int round = 0; round < 25000; ++round) {
            Bytes file = picture.file.bytes;
            for (std::uint32_t flips = random.below(3) + 1; flips > 0; --flips)
                file[random.below(static_cast<std::uint32_t>(file.size()))] ^=
                    static_cast<std::uint8_t>(1 << random.below(8));
            // A flip in the header may ask for other scratch than this.
            Bytes scratch(static_cast<std::size_t>(info->scratch_bytes));
            const Status gray_status =
                decode_jpeg(span_of(const_cast<const Bytes&>(file)), span_of(scratch), gray.view());
            const Status rgb_status =
                decode_jpeg(span_of(const_cast<const Bytes&>(file)), span_of(scratch), rgb.view());
            if (gray_status != Status::scratch_too_small && rgb_status != Status::scratch_too_small) {
                ASSERT_EQ(gray_status, rgb_status) << "round " << round;
            }
            passed += gray_status == Status::ok ? 1 : 0;
        }
        ASSERT_TRUE(gray.intact() && rgb.intact());
    }
    // Values of coefficients carry no check, so flips there go unseen, and pictures of random coefficients
    // hold little else.
    EXPECT_LT(passed, 80000);
}

TEST(DecodeJpeg, KeepsTheRowsInFrontOfTheFault) {
    Random random(55);
    const RandomPicture picture(random, {16, 64}, 3, {2, 2}, {1, 1}, 1);
    Bytes file = picture.file.bytes;
    GuardedImage<Gray8> whole({16, 64}), part({16, 64});
    ASSERT_EQ(decode_with_scratch(file, whole), Status::ok);
    part.fill(Gray8{9});
    // The third restart marker out of turn.
    const std::uint8_t third[2] = {0xff, 0xd2};
    *(std::search(file.begin(), file.end(), third, third + 2) + 1) = 0xd3;
    EXPECT_EQ(decode_with_scratch(file, part), Status::malformed);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 16; ++x) ASSERT_EQ(part(x, y), y < 48 ? whole(x, y) : 9);
}

/// Four flat blocks of 8 x 8, each in its own interval of restart.
JpegFile four_intervals(std::vector<int> markers, const char* extra = "") {
    JpegFile file;
    file.quantiser(0, 8).restart_interval(1).frame({32, 8}, 1).scan(1);
    for (std::size_t i = 0; i < 4; ++i) {
        file.bits("110 00011 1010");
        if (i == 1) file.bits(extra);
        file.pad();
        if (i < 3 && markers[i] >= 0) file.marker(markers[i]);
    }
    return file;
}

TEST(DecodeJpeg, WantsRestartMarkersInTurn) {
    const auto status = [](JpegFile file) { return status_of(file.marker(0xd9).bytes, {32, 8}); };
    EXPECT_EQ(status(four_intervals({0xd0, 0xd1, 0xd2})), Status::ok);
    EXPECT_EQ(status(four_intervals({0xd1, 0xd2, 0xd3})), Status::malformed);
    EXPECT_EQ(status(four_intervals({0xd0, 0xd0, 0xd1})), Status::malformed);
    EXPECT_EQ(status(four_intervals({0xd0, 0xd2, 0xd1})), Status::malformed);
    EXPECT_EQ(status(four_intervals({0xd0, -1, 0xd1})), Status::malformed);
    EXPECT_EQ(status(four_intervals({-1, -1, -1})), Status::malformed);
    EXPECT_EQ(status(four_intervals({0xd0, 0xd9, 0xd2})), Status::malformed);
    EXPECT_EQ(status(four_intervals({0xd0, 0xd1, 0xd2}, "00000000")), Status::malformed) << "a byte too many";
    EXPECT_EQ(status(four_intervals({0xd0, 0xd1, 0xd2}, "0000")), Status::ok) << "padding of zeros";
    JpegFile early = four_intervals({0xd0, 0xd1, 0xd2}).marker(0xd9);
    early.bytes.erase(early.bytes.end() - 8);  // the second byte of the third block
    EXPECT_EQ(status_of(early.bytes, {32, 8}), Status::malformed);
}

TEST(DecodeJpeg, WantsTheEndOfTheImageBehindTheLastBlock) {
    const auto flat = [] {
        JpegFile file;
        file.quantiser(0, 8).frame({8, 8}, 1).scan(1).bits("110 00011 1010").pad();
        return file;
    };
    const auto status = [](const JpegFile& file) { return status_of(file.bytes, {8, 8}); };
    EXPECT_EQ(status(flat().marker(0xd9)), Status::ok);
    EXPECT_EQ(status(flat().marker(0xd9).bits("11111111 00000000")), Status::ok) << "bytes behind the end";
    EXPECT_EQ(status(flat().bits("11111111").marker(0xd9)), Status::malformed) << "a stuffed byte unused";
    EXPECT_EQ(status(flat().bits("00000000").marker(0xd9)), Status::malformed);
    EXPECT_EQ(status(flat().marker(0xd0).marker(0xd9)), Status::ok) << "one restart marker too many";
    EXPECT_EQ(status(flat().marker(0xd0).marker(0xd1).marker(0xd9)), Status::malformed);
    EXPECT_EQ(status(flat().marker(0xd0).bits("00000000").marker(0xd9)), Status::malformed);
    EXPECT_EQ(status(flat().marker(0xd0)), Status::truncated);
    EXPECT_EQ(status(flat().marker(0xd8)), Status::malformed);
    EXPECT_EQ(status(flat().scan(1)), Status::malformed) << "a second scan";
    EXPECT_EQ(status(flat()), Status::truncated);
    JpegFile filled = flat();
    filled.bytes.insert(filled.bytes.end(), 5, 0xff);
    EXPECT_EQ(status(filled), Status::truncated);
    EXPECT_EQ(status(filled.marker(0xd9)), Status::ok) << "fill bytes";
    EXPECT_EQ(status(JpegFile(flat()).marker(0x00)), Status::malformed);
}

TEST(DecodeJpeg, RefusesHugeSizesOfSmallFilesAtOnce) {
    for (const Size size : {Size{65535, 65535}, Size{32767, 32767}, Size{32767, 1}, Size{1, 32767}}) {
        JpegFile file;
        file.quantiser(0, 1).frame(size, 3, {2, 2}).scan(3).bits("01010101 01010101").marker(0xd9);
        ASSERT_LT(file.bytes.size(), 130u);
        const Status status = inspect_jpeg(span_of(const_cast<const Bytes&>(file.bytes))).status();
        EXPECT_EQ(status, size.width > max_image_side ? Status::image_too_large : Status::truncated);
    }
}

// ---- Calls ------------------------------------------------------------------------

TEST(DecodeJpeg, SaysWhatIsWrongInOrderAndLeavesTheOutput) {
    Random random(57);
    const RandomPicture picture(random, {20, 12}, 3, {2, 2}, {1, 1}, 0);
    const Bytes& good = picture.file.bytes;
    const Bytes bad = {1, 2, 3};
    Bytes scratch(static_cast<std::size_t>(jpeg_scratch({20, 12})));
    Bytes none;
    GuardedImage<Rgb888> dst({20, 12}), other({20, 13});
    GuardedImage<Gray8> gray({20, 12});
    dst.fill(Rgb888{7, 8, 9});
    other.fill(Rgb888{7, 8, 9});
    gray.fill(Gray8{7});
    EXPECT_EQ(decode_jpeg(span_of(bad), span_of(none), ImageView<Rgb888>()), Status::empty_image);
    EXPECT_EQ(decode_jpeg(span_of(bad), span_of(none), other.view()), Status::malformed);
    EXPECT_EQ(decode_jpeg(span_of(good), span_of(none), other.view()), Status::size_mismatch);
    EXPECT_EQ(decode_jpeg(span_of(good), span_of(none), dst.view()), Status::scratch_too_small);
    EXPECT_EQ(decode_jpeg(span_of(good), span_of(none), gray.view()), Status::scratch_too_small);
    EXPECT_EQ(decode_jpeg(Span<const std::uint8_t>(), span_of(scratch), dst.view()), Status::truncated);
    const std::int64_t needed = inspect_jpeg(span_of(good))->scratch_bytes;
    EXPECT_EQ(decode_jpeg(span_of(good), span_of(scratch).first(static_cast<std::ptrdiff_t>(needed) - 1),
                          dst.view()),
              Status::scratch_too_small);
    EXPECT_EQ(
        decode_jpeg(span_of(good), span_of(scratch).first(static_cast<std::ptrdiff_t>(jpeg_gray_scratch) - 1),
                    gray.view()),
        Status::scratch_too_small);
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 20; ++x) {
            EXPECT_EQ(dst(x, y), (Rgb888{7, 8, 9}));
            EXPECT_EQ(other(x, y), (Rgb888{7, 8, 9}));
            EXPECT_EQ(gray(x, y), 7);
        }
    EXPECT_EQ(
        decode_jpeg(span_of(good), span_of(scratch).first(static_cast<std::ptrdiff_t>(jpeg_gray_scratch)),
                    gray.view()),
        Status::ok);
}

TEST(DecodeJpeg, GivesTheSameBitsAtEveryAlignmentOfItsScratch) {
    Random random(58);
    const RandomPicture picture(random, {33, 19}, 3, {2, 2}, {1, 1}, 0);
    const auto needed = static_cast<std::ptrdiff_t>(inspect_jpeg(span_of(picture.file.bytes))->scratch_bytes);
    GuardedImage<Rgb888> expected({33, 19});
    ASSERT_EQ(decode_with_scratch(picture.file.bytes, expected), Status::ok);
    for (std::ptrdiff_t shift = 0; shift < 64; ++shift) {
        Bytes memory(static_cast<std::size_t>(needed + 128), 0xa5);
        GuardedImage<Rgb888> dst({33, 19});
        GuardedImage<Gray8> gray({33, 19});
        ASSERT_EQ(
            decode_jpeg(span_of(picture.file.bytes), span_of(memory).from(shift).first(needed), dst.view()),
            Status::ok);
        ASSERT_TRUE(equal(dst.view(), expected.view()));
        ASSERT_EQ(
            decode_jpeg(span_of(picture.file.bytes), span_of(memory).from(shift).first(needed), gray.view()),
            Status::ok);
        for (std::ptrdiff_t i = 0; i < needed + 128; ++i) {
            if (i >= shift && i < shift + needed) continue;
            ASSERT_EQ(memory[static_cast<std::size_t>(i)], 0xa5) << "outside the scratch at " << i - shift;
        }
    }
}

}  // namespace
}  // namespace fovea::test
