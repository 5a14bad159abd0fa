// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <core/codec/jpeg_file.hpp>
#include <fovea/base/random.hpp>
#include <fovea/codec/jpeg.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

/// Decodes with exactly the scratch the file asks for.
template <class Pixel>
Status decode(const Bytes& file, GuardedImage<Pixel>& dst) {
    const Result<PictureInfo> info = inspect_jpeg(span_of(file));
    Bytes scratch(info ? static_cast<std::size_t>(info->scratch_bytes) : 0);
    return decode_jpeg(span_of(file), span_of(scratch), dst.view());
}
template <class Pixel = Gray8>
Status status_of(const Bytes& file, Size size) {
    GuardedImage<Pixel> dst(size);
    return decode(file, dst);
}

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
    ASSERT_EQ(decode(file, gray), Status::ok);
    ASSERT_EQ(decode(file, rgb), Status::ok);
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
    ASSERT_EQ(decode(file.bytes, dst), Status::ok);
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
    ASSERT_EQ(decode(file.bytes, rgb), Status::ok);
    GuardedImage<Gray8> gray({16, 16});
    ASSERT_EQ(decode(file.bytes, gray), Status::ok);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            ASSERT_EQ(rgb(x, y), (Rgb888{72, 111, 118}));
            ASSERT_EQ(gray(x, y), 100);
        }
}

// ---- Against the slow obvious version ---------------------------------------------

/// A file of random coefficients, and the samples of its components by the definition of the transform.
struct RandomPicture {
    JpegFile file;
    Size size;
    int components = 1;
    Sampling luma, chroma;
    std::vector<std::vector<int>> samples;  // by component, in whole blocks
    std::vector<int> width;

    const Sampling& factors(int component) const { return component == 0 ? luma : chroma; }

    RandomPicture(Random& random, Size picture, int count, Sampling luma_factors, Sampling chroma_factors,
                  int restart, bool rgb = false)
        : size(picture), components(count), luma(luma_factors), chroma(chroma_factors) {
        const int mcus_across = (size.width + 8 * luma.across - 1) / (8 * luma.across);
        const int mcus_down = (size.height + 8 * luma.down - 1) / (8 * luma.down);
        for (int c = 0; c < components; ++c) {
            width.push_back(8 * mcus_across * factors(c).across);
            samples.emplace_back(static_cast<std::size_t>(width.back() * 8 * mcus_down * factors(c).down));
        }
        const int step = random.between(1, 4);
        if (rgb) file.segment(0xee, {'A', 'd', 'o', 'b', 'e', 0, 100, 0, 0, 0, 0, 0});
        file.quantiser(0, step).frame(size, components, luma, chroma);
        if (restart > 0) file.restart_interval(restart);
        file.scan(components);
        std::vector<int> previous(3);
        for (int mcu = 0; mcu < mcus_across * mcus_down; ++mcu) {
            if (restart > 0 && mcu > 0 && mcu % restart == 0) {
                file.pad().marker(0xd0 + (mcu / restart - 1) % 8);
                previous.assign(3, 0);
            }
            for (int c = 0; c < components; ++c)
                for (int block = 0; block < factors(c).across * factors(c).down; ++block)
                    add_block(random, c, step, previous[static_cast<std::size_t>(c)],
                              8 * (mcu % mcus_across * factors(c).across + block % factors(c).across),
                              8 * (mcu / mcus_across * factors(c).down + block / factors(c).across));
        }
        file.pad().marker(0xd9);
    }

    void add_block(Random& random, int c, int step, int& previous, int x0, int y0) {
        Coefficients quantised(64);
        quantised[0] = random.between(-900, 900) / step;
        const int used = random.between(0, 63) >> random.below(6);
        for (int k = 1; k <= used; ++k)
            if (random.below(2) == 0)
                quantised[static_cast<std::size_t>(k)] = random.between(-120, 120) / step >> random.below(7);
        file.block(quantised, previous, c == 0 ? 0 : 1);
        previous = quantised[0];
        std::vector<double> coefficients(64);
        for (std::size_t k = 0; k < 64; ++k) coefficients[jpeg::zigzag[k]] = quantised[k] * step;
        const std::vector<double> block = naive_inverse(coefficients);
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 8; ++x)
                at(c, x0 + x, y0 + y) = std::clamp(
                    static_cast<int>(std::floor(block[static_cast<std::size_t>(8 * y + x)] + 0.5)) + 128, 0,
                    255);
    }
    int& at(int c, int x, int y) {
        const auto component = static_cast<std::size_t>(c);
        return samples[component][static_cast<std::size_t>(y * width[component] + x)];
    }

    /// A sample of a component at a pixel, between its own samples if they are fewer.
    double full_size(int c, int x, int y) {
        const int across = luma.across / factors(c).across;
        const int down = luma.down / factors(c).down;
        const Size own = {(size.width + across - 1) / across, (size.height + down - 1) / down};
        const auto place = [](int pixel, int ratio, int count) {
            return std::clamp(ratio == 2 ? pixel / 2.0 - 0.25 : pixel, 0.0, count - 1.0);
        };
        double u = place(x, across, own.width);
        double v = place(y, down, own.height);
        if (across == 2 && own.width <= 2) {
            u = x / 2;
            if (down == 2) v = y / 2;
        }
        const int left = static_cast<int>(u);
        const int above = static_cast<int>(v);
        const int right = std::min(left + 1, own.width - 1);
        const int below = std::min(above + 1, own.height - 1);
        const double row_above = at(c, left, above) * (left + 1 - u) + at(c, right, above) * (u - left);
        const double row_below = at(c, left, below) * (left + 1 - u) + at(c, right, below) * (u - left);
        return row_above * (above + 1 - v) + row_below * (v - above);
    }
};

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
    ASSERT_EQ(decode(picture.file.bytes, gray), Status::ok);
    ASSERT_EQ(decode(picture.file.bytes, rgb), Status::ok);
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
    ASSERT_EQ(decode(picture.file.bytes, rgb), Status::ok);
    ASSERT_EQ(decode(picture.file.bytes, gray), Status::ok);
    for (int y = 0; y < 13; ++y)
        for (int x = 0; x < 21; ++x) {
            ASSERT_NEAR(rgb(x, y).red, picture.at(0, x, y), 1);
            ASSERT_NEAR(rgb(x, y).green, picture.at(1, x, y), 1);
            ASSERT_NEAR(rgb(x, y).blue, picture.at(2, x, y), 1);
            ASSERT_EQ(gray(x, y), gray_of(rgb(x, y)));
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
    ASSERT_EQ(decode(file, whole), Status::ok);
    part.fill(Gray8{9});
    // The third restart marker out of turn.
    const std::uint8_t third[2] = {0xff, 0xd2};
    *(std::search(file.begin(), file.end(), third, third + 2) + 1) = 0xd3;
    EXPECT_EQ(decode(file, part), Status::malformed);
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

TEST(DecodeJpeg, WrapsTheNumbersOfRestartMarkers) {
    Random random(56);
    RandomPicture picture(random, {8 * 19, 8}, 1, {1, 1}, {1, 1}, 1);
    ASSERT_NO_FATAL_FAILURE(expect_equal_to_reference(picture));
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
    ASSERT_EQ(decode(picture.file.bytes, expected), Status::ok);
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
