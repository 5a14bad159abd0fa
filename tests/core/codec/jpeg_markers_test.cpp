// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <utility>
#include <vector>

#include <core/codec/jpeg_file.hpp>
#include <fovea/codec/jpeg_markers.hpp>
#include <fovea/codec/jpeg_tables.hpp>

namespace fovea::test {
namespace {

/// Bytes enough for the blocks of any picture here.
const Bytes enough_entropy(4096, 0x55);

JpegFile gray(Size size = {8, 8}) {
    JpegFile file;
    file.quantiser(0, 1).frame(size, 1);
    return file;
}
Result<jpeg::Header> read(JpegFile file) {
    file.bytes.insert(file.bytes.end(), enough_entropy.begin(), enough_entropy.end());
    static Bytes kept;  // the header points into the file
    kept = file.bytes;
    return jpeg::read_header(span_of(const_cast<const Bytes&>(kept)));
}
Status status_of(const JpegFile& file) { return read(file).status(); }

TEST(JpegHeader, TellsWhatTheFileSays) {
    JpegFile file;
    file.segment(0xe0, {'J', 'F', 'I', 'F', 0, 1, 1, 0, 0, 1, 0, 1, 0, 0});
    file.segment(0xfe, {'a', ' ', 'c', 'o', 'm', 'm', 'e', 'n', 't'});
    file.quantiser(0, 3).restart_interval(300).frame({33, 17}, 3, {2, 2}, {1, 1}).scan(3);
    const Result<jpeg::Header> header = read(file);
    ASSERT_TRUE(header);
    EXPECT_EQ(header->size, (Size{33, 17}));
    EXPECT_EQ(header->components, 3);
    EXPECT_EQ(header->mcus_across(), 3);
    EXPECT_EQ(header->mcus_down(), 2);
    EXPECT_EQ(header->blocks_per_mcu(), 6);
    EXPECT_EQ(header->samples(header->component[0]), (Size{33, 17}));
    EXPECT_EQ(header->samples(header->component[2]), (Size{17, 9}));
    EXPECT_EQ(header->restart_interval, 300);
    EXPECT_EQ(header->component[1].dc_code, 1);
    EXPECT_EQ(header->quantiser[0][63], 3);
    EXPECT_FALSE(header->rgb);
    EXPECT_EQ(header->entropy.size(), 4096);
    EXPECT_EQ(header->entropy[0], 0x55);
}

TEST(JpegHeader, TakesTheStandardCodesWhereNoneAreDefined) {
    const Result<jpeg::Header> header = read(gray().scan(1));
    ASSERT_TRUE(header);
    EXPECT_EQ(header->dc_code[0].data(), jpeg::standard_luma_dc);
    EXPECT_EQ(header->ac_code[1].data(), jpeg::standard_chroma_ac);
}

TEST(JpegHeader, TakesTheLastCodeThatIsDefined) {
    Bytes first(1 + 16 + 1), second(1 + 16 + 2);
    first[0] = second[0] = 0x11;
    first[1] = 1;
    second[2] = 2;
    JpegFile file = gray();
    file.segment(0xc4, first).segment(0xc4, second).scan(1);
    const Result<jpeg::Header> header = read(file);
    ASSERT_TRUE(header);
    EXPECT_EQ(header->ac_code[1].size(), 18);
    EXPECT_EQ(header->ac_code[0].data(), jpeg::standard_luma_ac);
}

TEST(JpegHeader, PassesOverFillBytesAndUnknownApplicationSegments) {
    JpegFile file;
    file.bytes.insert(file.bytes.end(), {0xff, 0xff, 0xff});
    file.quantiser(0, 1).segment(0xed, {}).segment(0xef, Bytes(300)).frame({8, 8}, 1);
    file.bytes.push_back(0xff);
    EXPECT_EQ(status_of(file.scan(1)), Status::ok);
}

TEST(JpegHeader, ReadsStepsOfTwoBytes) {
    Bytes wide(129);
    wide[0] = 0x10;
    for (std::size_t k = 0; k < 64; ++k) wide[1 + 2 * k] = 1;
    JpegFile file;
    const Result<jpeg::Header> header = read(file.segment(0xdb, wide).frame({8, 8}, 1, {}, {}, 0xc1).scan(1));
    ASSERT_TRUE(header);
    EXPECT_EQ(header->quantiser[0].size(), 128);
}

TEST(JpegHeader, ReadsSeveralTablesOfASegment) {
    Bytes both(2 * 65, 9);
    both[0] = 0;
    both[65] = 3;
    JpegFile file;
    const Result<jpeg::Header> header = read(file.segment(0xdb, both).frame({8, 8}, 1).scan(1));
    ASSERT_TRUE(header);
    EXPECT_EQ(header->quantiser[3][0], 9);
    EXPECT_TRUE(header->quantiser[1].empty());
}

TEST(JpegHeader, LooksAtAdobeAndJfifForTheColours) {
    const Bytes jfif = {'J', 'F', 'I', 'F', 0, 1, 1, 0, 0, 1, 0, 1, 0, 0};
    const auto adobe = [](int transform) {
        return Bytes{'A', 'd', 'o', 'b', 'e', 0, 100, 0, 0, 0, 0, static_cast<std::uint8_t>(transform)};
    };
    const auto rgb = [&](std::vector<std::pair<int, Bytes>> segments, int components = 3) {
        JpegFile file;
        for (const auto& [code, data] : segments) file.segment(code, data);
        return read(file.quantiser(0, 1).frame({8, 8}, components).scan(components))->rgb;
    };
    EXPECT_FALSE(rgb({}));
    EXPECT_TRUE(rgb({{0xee, adobe(0)}}));
    EXPECT_FALSE(rgb({{0xee, adobe(0)}}, 1));
    EXPECT_FALSE(rgb({{0xee, adobe(1)}}));
    EXPECT_FALSE(rgb({{0xe0, jfif}, {0xee, adobe(0)}}));
    EXPECT_FALSE(rgb({{0xee, {'A', 'd', 'o', 'b', 'e'}}}));
    EXPECT_FALSE(rgb({{0xe0, adobe(0)}}));
}

TEST(JpegHeader, LooksAtTheIdentifiersForTheColours) {
    JpegFile file;
    file.quantiser(0, 1);
    file.segment(0xc0, {8, 0, 8, 0, 8, 3, 'R', 0x11, 0, 'G', 0x11, 0, 'B', 0x11, 0});
    file.segment(0xda, {3, 'R', 0, 'G', 0, 'B', 0, 0, 63, 0});
    const Result<jpeg::Header> header = read(file);
    ASSERT_TRUE(header);
    EXPECT_TRUE(header->rgb);
}

TEST(JpegHeader, TakesEverySamplingOfOneAndTwo) {
    int taken = 0;
    for (int luma_across = 1; luma_across <= 4; ++luma_across)
        for (int luma_down = 1; luma_down <= 4; ++luma_down)
            for (int across = 1; across <= 4; ++across)
                for (int down = 1; down <= 4; ++down) {
                    JpegFile file;
                    file.quantiser(0, 1).frame({50, 50}, 3, {luma_across, luma_down}, {across, down}).scan(3);
                    const bool known = luma_across <= 2 && luma_down <= 2 && across <= luma_across &&
                                       down <= luma_down && luma_across * luma_down + 2 * across * down <= 10;
                    const Status status = status_of(file);
                    EXPECT_EQ(status == Status::ok, known);
                    const bool all_two = luma_across * luma_down * across * down == 16 && luma_across == 2 &&
                                         luma_down == 2 && across == 2;
                    if (!known) {
                        EXPECT_EQ(status, all_two ? Status::malformed : Status::unsupported);
                    }
                    taken += known ? 1 : 0;
                }
    EXPECT_EQ(taken, 8);
}

TEST(JpegHeader, IgnoresTheFactorsOfASingleComponent) {
    JpegFile file;
    const Result<jpeg::Header> header = read(file.quantiser(0, 1).frame({20, 20}, 1, {4, 3}).scan(1));
    ASSERT_TRUE(header);
    EXPECT_EQ(header->mcus_across(), 3);
    EXPECT_EQ(header->blocks_per_mcu(), 1);
}

TEST(JpegHeader, DoesNotLookAtTheSpectralSelection) {
    // A sequential scan does not use it, and some cameras write zeros.
    JpegFile file = gray();
    EXPECT_EQ(status_of(file.segment(0xda, {1, 1, 0, 0, 0, 0})), Status::ok);
}

TEST(JpegHeader, RefusesOtherProcessesByName) {
    for (const int code :
         {0xc2, 0xc3, 0xc5, 0xc6, 0xc7, 0xc8, 0xc9, 0xca, 0xcb, 0xcc, 0xcd, 0xce, 0xcf, 0xde, 0xdf, 0xf7}) {
        JpegFile file;
        file.quantiser(0, 1).frame({8, 8}, 1, {}, {}, code).scan(1);
        EXPECT_EQ(status_of(file), Status::unsupported) << std::hex << code;
    }
    EXPECT_EQ(status_of(gray().scan(1)), Status::ok);
    JpegFile extended;
    EXPECT_EQ(status_of(extended.quantiser(0, 1).frame({8, 8}, 1, {}, {}, 0xc1).scan(1)), Status::ok);
}

TEST(JpegHeader, RefusesWhatItDoesNotRead) {
    const auto frame = [](Size size, int components, int bits) {
        JpegFile file;
        return status_of(file.quantiser(0, 1).frame(size, components, {}, {}, 0xc1, bits).scan(components));
    };
    EXPECT_EQ(frame({8, 8}, 1, 12), Status::unsupported);
    EXPECT_EQ(frame({8, 8}, 1, 7), Status::malformed);
    EXPECT_EQ(frame({8, 8}, 2, 8), Status::unsupported);
    EXPECT_EQ(frame({8, 8}, 4, 8), Status::unsupported);
    EXPECT_EQ(frame({8, 0}, 1, 8), Status::unsupported) << "the height follows the scan";
    EXPECT_EQ(frame({0, 8}, 1, 8), Status::malformed);
    EXPECT_EQ(frame({32768, 8}, 1, 8), Status::image_too_large);
    EXPECT_EQ(frame({8, 32768}, 1, 8), Status::image_too_large);
    EXPECT_EQ(frame({65535, 65535}, 3, 8), Status::image_too_large);
    EXPECT_EQ(frame({32767, 8}, 1, 8), Status::ok);

    JpegFile separate;
    separate.quantiser(0, 1).frame({8, 8}, 3).scan(1);
    EXPECT_EQ(status_of(separate), Status::unsupported) << "one component a scan";

    for (const int id : {2, 3, 4, 15}) {
        Bytes code(1 + 16 + 1);
        code[0] = static_cast<std::uint8_t>(id);
        code[1] = 1;
        EXPECT_EQ(status_of(gray().segment(0xc4, code).scan(1)),
                  id <= 3 ? Status::unsupported : Status::malformed);
        const auto codes = static_cast<std::uint8_t>(id << 4);
        EXPECT_EQ(status_of(gray().segment(0xda, {1, 1, codes, 0, 63, 0})),
                  id <= 3 ? Status::unsupported : Status::malformed);
    }
}

TEST(JpegHeader, RefusesWhatContradictsTheFormat) {
    EXPECT_EQ(jpeg::read_header(span_of(Bytes{0x12, 0x34})).status(), Status::malformed);
    EXPECT_EQ(jpeg::read_header(span_of(Bytes{0xff, 0xc0})).status(), Status::malformed);
    EXPECT_EQ(status_of(JpegFile().marker(0xd9)), Status::malformed);
    EXPECT_EQ(status_of(JpegFile().marker(0xd8)), Status::malformed);
    EXPECT_EQ(status_of(JpegFile().marker(0xd0)), Status::malformed);
    EXPECT_EQ(status_of(JpegFile().marker(0x01)), Status::malformed);
    EXPECT_EQ(status_of(JpegFile().marker(0x00)), Status::malformed);
    EXPECT_EQ(status_of(gray().bits("00010010").scan(1)), Status::malformed) << "a byte between segments";
    EXPECT_EQ(status_of(JpegFile().quantiser(0, 1).scan(1)), Status::malformed) << "no frame";
    EXPECT_EQ(status_of(gray().frame({8, 8}, 1).scan(1)), Status::malformed) << "two frames";
    EXPECT_EQ(status_of(JpegFile().frame({8, 8}, 1).scan(1)), Status::malformed) << "no quantiser";
    EXPECT_EQ(status_of(JpegFile().quantiser(0, 0).frame({8, 8}, 1).scan(1)), Status::malformed) << "step 0";
    EXPECT_EQ(status_of(JpegFile().quantiser(4, 1)), Status::malformed);
    EXPECT_EQ(status_of(JpegFile().quantiser(0x20, 1)), Status::malformed);
    EXPECT_EQ(status_of(JpegFile().segment(0xdb, Bytes(64))), Status::malformed);
    EXPECT_EQ(status_of(JpegFile().segment(0xc4, Bytes(16))), Status::malformed);
    EXPECT_EQ(status_of(JpegFile().segment(0xc4, {0x20, 0, 0})), Status::malformed);
    for (const int symbol : {15, 16}) {
        Bytes dc_code(1 + 16 + 1);
        dc_code[1] = 1;
        dc_code[17] = static_cast<std::uint8_t>(symbol);
        EXPECT_EQ(status_of(gray().segment(0xc4, dc_code).scan(1)),
                  symbol <= 15 ? Status::ok : Status::malformed);
    }
    EXPECT_EQ(status_of(JpegFile().segment(0xdd, {0})), Status::malformed);
    EXPECT_EQ(status_of(JpegFile().segment(0xc0, {8, 0, 8, 0, 8})), Status::malformed);
    EXPECT_EQ(status_of(JpegFile().segment(0xc0, {8, 0, 8, 0, 8, 0})), Status::malformed);
    EXPECT_EQ(status_of(JpegFile().segment(0xc0, {8, 0, 8, 0, 8, 1, 1, 0x11})), Status::malformed);
    EXPECT_EQ(status_of(JpegFile().segment(0xc0, {8, 0, 8, 0, 8, 1, 1, 0x01, 0})), Status::malformed);
    EXPECT_EQ(status_of(JpegFile().segment(0xc0, {8, 0, 8, 0, 8, 1, 1, 0x15, 0})), Status::malformed);
    EXPECT_EQ(status_of(JpegFile().segment(0xc0, {8, 0, 8, 0, 8, 1, 1, 0x11, 4})), Status::malformed);
    EXPECT_EQ(status_of(JpegFile().segment(0xc0, {8, 0, 8, 0, 8, 3, 1, 0x11, 0, 2, 0x11, 0, 1, 0x11, 0})),
              Status::malformed)
        << "an identifier that comes twice";
    EXPECT_EQ(status_of(gray().segment(0xda, {})), Status::malformed);
    EXPECT_EQ(status_of(gray().segment(0xda, {0, 0, 63, 0})), Status::malformed);
    EXPECT_EQ(status_of(gray().segment(0xda, {1, 2, 0, 0, 63, 0})), Status::malformed) << "no such component";
    EXPECT_EQ(status_of(gray().segment(0xda, {1, 1, 0, 0, 63})), Status::malformed);
    EXPECT_EQ(status_of(gray().scan(3)), Status::malformed);
    JpegFile short_length;
    short_length.marker(0xe0).put(1, 16);
    EXPECT_EQ(status_of(short_length), Status::malformed);
}

TEST(JpegHeader, SaysTruncatedForEveryLengthThatEndsInFrontOfTheScan) {
    JpegFile file;
    file.segment(0xe0, Bytes(9)).quantiser(0, 1).restart_interval(3).frame({16, 16}, 3, {2, 2}).scan(3);
    for (std::size_t length = 0; length < file.bytes.size(); ++length) {
        const Bytes cut(file.bytes.begin(), file.bytes.begin() + static_cast<std::ptrdiff_t>(length));
        EXPECT_EQ(jpeg::read_header(span_of(cut)).status(), Status::truncated) << length;
    }
}

TEST(JpegHeader, SaysTruncatedForFewerThanTwoBitsABlock) {
    // 32767 x 32767: 4096 * 4096 blocks of two bits are four million bytes.
    EXPECT_EQ(status_of(gray({32767, 32767}).scan(1)), Status::truncated);
    // 128 x 1024: 16 * 128 blocks, 512 bytes.
    JpegFile file = gray({128, 1024}).scan(1);
    const std::size_t start = file.bytes.size();
    file.bytes.resize(start + 511);
    EXPECT_EQ(jpeg::read_header(span_of(const_cast<const Bytes&>(file.bytes))).status(), Status::truncated);
    file.bytes.resize(start + 512);
    EXPECT_EQ(jpeg::read_header(span_of(const_cast<const Bytes&>(file.bytes))).status(), Status::ok);
}

}  // namespace
}  // namespace fovea::test
