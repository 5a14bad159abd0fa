// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/codec/any_picture.hpp>
#include <fovea/codec/png_writer.hpp>
#include <support/guarded_image.hpp>
#include <support/picture.hpp>

namespace fovea::test {
namespace {

using FileBytes = std::vector<std::uint8_t>;

Span<const std::uint8_t> span_of(const FileBytes& bytes) {
    return {bytes.data(), static_cast<std::ptrdiff_t>(bytes.size())};
}
PictureFormat format_of(const std::string& start) {
    return picture_format(span_of({start.begin(), start.end()}));
}

/// A picture of noise, and the files that hold it without loss.
class AnyPicture : public testing::Test {
protected:
    AnyPicture() : original_({13, 7}) {
        Random random(671);
        original_.fill(random);
    }

    template <class Encode>
    FileBytes file(Encode encode) const {
        FileBytes bytes(4096);
        FileBytes scratch(static_cast<std::size_t>(png_writer_scratch({13, 7})));
        const Result<std::ptrdiff_t> length = encode(
            original_.view(), Span<std::uint8_t>(scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())),
            Span<std::uint8_t>(bytes.data(), static_cast<std::ptrdiff_t>(bytes.size())));
        EXPECT_TRUE(length.ok());
        bytes.resize(static_cast<std::size_t>(length ? *length : 0));
        return bytes;
    }
    FileBytes pnm() const {
        return file([](auto src, auto, auto out) { return encode_pnm(src, out); });
    }
    FileBytes bmp() const {
        return file([](auto src, auto, auto out) { return encode_bmp(src, out); });
    }
    FileBytes png() const {
        return file([](auto src, auto scratch, auto out) { return encode_png(src, scratch, out); });
    }
    static FileBytes jpeg() {
        return read_file(std::filesystem::path(FOVEA_SOURCE_DIR) / "tests/fuzz/codec/jpeg_corpus/gray.jpg");
    }

    GuardedImage<Gray8> original_;
};

TEST_F(AnyPicture, IsToldByItsFirstTwoBytes) {
    EXPECT_EQ(format_of("P1"), PictureFormat::pnm);
    EXPECT_EQ(format_of("P7"), PictureFormat::pnm);
    EXPECT_EQ(format_of("P0"), PictureFormat::unknown);
    EXPECT_EQ(format_of("P8"), PictureFormat::unknown);
    EXPECT_EQ(format_of("BM"), PictureFormat::bmp);
    EXPECT_EQ(format_of("\x89P"), PictureFormat::png);
    EXPECT_EQ(format_of("\xff\xd8"), PictureFormat::jpeg);
    EXPECT_EQ(format_of("\xff\xd9"), PictureFormat::unknown);
    EXPECT_EQ(format_of("GIF89a"), PictureFormat::unknown);
    EXPECT_EQ(format_of("P"), PictureFormat::unknown);
    EXPECT_EQ(format_of(""), PictureFormat::unknown);
}

TEST_F(AnyPicture, HasANameForEveryFormat) {
    EXPECT_STREQ(describe(PictureFormat::pnm), "PGM/PPM");
    EXPECT_STREQ(describe(PictureFormat::bmp), "BMP");
    EXPECT_STREQ(describe(PictureFormat::png), "PNG");
    EXPECT_STREQ(describe(PictureFormat::jpeg), "JPEG");
    EXPECT_STREQ(describe(PictureFormat::unknown), "unknown");
    EXPECT_STREQ(describe(static_cast<PictureFormat>(99)), "unknown");
}

TEST_F(AnyPicture, IsTheSameFromEveryFormatWithoutLoss) {
    for (const FileBytes& bytes : {pnm(), bmp(), png()}) {
        const Result<PictureInfo> info = inspect_picture(span_of(bytes));
        ASSERT_TRUE(info.ok()) << describe(info.status());
        EXPECT_EQ(info->size, (Size{13, 7}));
        FileBytes scratch(static_cast<std::size_t>(info->scratch_bytes));
        GuardedImage<Gray8> decoded(info->size);
        EXPECT_EQ(
            decode_picture(span_of(bytes), {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())},
                           decoded.view()),
            Status::ok);
        EXPECT_TRUE(equal(decoded.view(), original_.view())) << describe(picture_format(span_of(bytes)));
    }
}

TEST_F(AnyPicture, OfJpegIsThatOfTheJpegDecoder) {
    const FileBytes bytes = jpeg();
    const Result<PictureInfo> info = inspect_picture(span_of(bytes));
    ASSERT_TRUE(info.ok()) << describe(info.status());
    FileBytes scratch(static_cast<std::size_t>(info->scratch_bytes));
    const Span<std::uint8_t> room(scratch.data(), static_cast<std::ptrdiff_t>(scratch.size()));
    GuardedImage<Rgb888> any(info->size);
    GuardedImage<Rgb888> known(info->size);
    EXPECT_EQ(decode_picture(span_of(bytes), room, any.view()), Status::ok);
    EXPECT_EQ(decode_jpeg(span_of(bytes), room, known.view()), Status::ok);
    EXPECT_TRUE(equal(any.view(), known.view()));
}

TEST_F(AnyPicture, PassesOnWhatItsDecoderSays) {
    GuardedImage<Gray8> wrong({12, 7});
    wrong.fill(Gray8{7});
    for (const FileBytes& bytes : {pnm(), bmp(), png(), jpeg()}) {
        const char* const format = describe(picture_format(span_of(bytes)));
        FileBytes scratch(static_cast<std::size_t>(inspect_picture(span_of(bytes))->scratch_bytes));
        EXPECT_EQ(decode_picture(span_of(bytes),
                                 {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}, wrong.view()),
                  Status::size_mismatch)
            << format;
        const FileBytes start(bytes.begin(), bytes.begin() + 2);
        EXPECT_FALSE(inspect_picture(span_of(start)).ok()) << format;
        EXPECT_NE(decode_picture(span_of(start), {}, wrong.view()), Status::ok) << format;
    }
    const FileBytes gif = {'G', 'I', 'F', '8'};
    EXPECT_EQ(inspect_picture(span_of(gif)).status(), Status::unsupported);
    EXPECT_EQ(decode_picture(span_of(gif), {}, wrong.view()), Status::unsupported);
    EXPECT_EQ(wrong(0, 0), 7);
}

}  // namespace
}  // namespace fovea::test
