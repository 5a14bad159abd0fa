// SPDX-License-Identifier: MIT
//
// The JPEG decoder against libjpeg-turbo: real photographs, pictures at every sampling, and damaged files.
// Built where the library is at hand.
#if defined(FOVEA_HAVE_LIBJPEG)

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include <jpeglib.h>

#include <core/codec/jpeg_file.hpp>
#include <fovea/base/random.hpp>
#include <fovea/codec/jpeg.hpp>
#include <support/guarded_image.hpp>
#include <support/picture.hpp>

namespace fovea::test {
namespace {

/// libjpeg's errors by a jump, its warnings counted.
struct Errors {
    jpeg_error_mgr manager;
    std::jmp_buf jump;
};
void install(Errors& errors) {
    jpeg_std_error(&errors.manager);
    errors.manager.error_exit = [](j_common_ptr common) {
        std::longjmp(reinterpret_cast<Errors*>(common->err)->jump, 1);
    };
    errors.manager.output_message = [](j_common_ptr) {};
}

/// What libjpeg makes of a file.
struct Decoded {
    bool ok = false;
    bool known_process = false;  ///< neither progressive nor arithmetic
    long warnings = 0;
    Size size;
    Bytes pixels;
};

void decode_into(jpeg_decompress_struct& decoder, const Bytes& file, J_COLOR_SPACE colours,
                 Decoded& decoded) {
    jpeg_mem_src(&decoder, file.data(), file.size());
    jpeg_read_header(&decoder, TRUE);
    decoded.known_process = decoder.progressive_mode == FALSE && decoder.arith_code == FALSE;
    if (colours != JCS_UNKNOWN) decoder.out_color_space = colours;
    jpeg_start_decompress(&decoder);
    decoded.size = {static_cast<int>(decoder.output_width), static_cast<int>(decoder.output_height)};
    const std::size_t row_bytes =
        std::size_t{decoder.output_width} * static_cast<std::size_t>(decoder.output_components);
    decoded.pixels.resize(row_bytes * decoder.output_height);
    while (decoder.output_scanline < decoder.output_height) {
        JSAMPROW row = decoded.pixels.data() + decoder.output_scanline * row_bytes;
        jpeg_read_scanlines(&decoder, &row, 1);
    }
    jpeg_finish_decompress(&decoder);
    decoded.ok = true;
}
Decoded reference(const Bytes& file, J_COLOR_SPACE colours) {
    Decoded decoded;
    Errors errors;
    install(errors);
    jpeg_decompress_struct decoder;
    decoder.err = &errors.manager;
    jpeg_create_decompress(&decoder);
    if (setjmp(errors.jump) == 0) decode_into(decoder, file, colours, decoded);
    decoded.warnings = errors.manager.num_warnings;
    jpeg_destroy_decompress(&decoder);
    return decoded;
}

/// How a picture is to be coded.
struct Coding {
    int quality = 90;
    int components = 3;
    int across = 1;
    int down = 1;
    unsigned restart_interval = 0;
    bool standard_codes = true;
    bool progressive = false;
    bool arithmetic = false;
    J_COLOR_SPACE stored = JCS_UNKNOWN;
};

/// Codes pixels of as many bytes as the coding has components.
Bytes encode(const Bytes& pixels, Size size, const Coding& coding) {
    Errors errors;
    install(errors);
    jpeg_compress_struct encoder;
    encoder.err = &errors.manager;
    jpeg_create_compress(&encoder);
    unsigned char* memory = nullptr;
    unsigned long bytes = 0;
    Bytes file;
    if (setjmp(errors.jump) == 0) {
        jpeg_mem_dest(&encoder, &memory, &bytes);
        encoder.image_width = static_cast<JDIMENSION>(size.width);
        encoder.image_height = static_cast<JDIMENSION>(size.height);
        encoder.input_components = coding.components;
        encoder.in_color_space = coding.components == 1   ? JCS_GRAYSCALE
                                 : coding.components == 3 ? JCS_RGB
                                                          : JCS_CMYK;
        jpeg_set_defaults(&encoder);
        jpeg_set_quality(&encoder, coding.quality, FALSE);
        if (coding.stored != JCS_UNKNOWN) jpeg_set_colorspace(&encoder, coding.stored);
        encoder.comp_info[0].h_samp_factor = coding.across;
        encoder.comp_info[0].v_samp_factor = coding.down;
        encoder.restart_interval = coding.restart_interval;
        encoder.optimize_coding = coding.standard_codes ? FALSE : TRUE;
        encoder.arith_code = coding.arithmetic ? TRUE : FALSE;
        if (coding.progressive) jpeg_simple_progression(&encoder);
        jpeg_start_compress(&encoder, TRUE);
        while (encoder.next_scanline < encoder.image_height) {
            const std::size_t row_bytes = static_cast<std::size_t>(size.width * coding.components);
            JSAMPROW row = const_cast<JSAMPROW>(pixels.data() + encoder.next_scanline * row_bytes);
            jpeg_write_scanlines(&encoder, &row, 1);
        }
        jpeg_finish_compress(&encoder);
        file.assign(memory, memory + bytes);
    }
    jpeg_destroy_compress(&encoder);
    std::free(memory);
    return file;
}

/// Waves and edges with some noise, so that blocks have few and many coefficients.
Bytes drawing(Random& random, Size size, int components) {
    Bytes pixels;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            for (int c = 0; c < components; ++c) {
                const double wave =
                    128 + 90 * std::sin(x * 0.13 * (c + 1) + y * 0.07) + (x / 11 + y / 7) % 2 * 40;
                const int noise = x > size.width / 2 ? random.between(-30, 30) : 0;
                pixels.push_back(
                    static_cast<std::uint8_t>(std::clamp(static_cast<int>(wave) + noise, 0, 255)));
            }
    return pixels;
}

template <class Pixel>
Status decode(const Bytes& file, GuardedImage<Pixel>& dst) {
    const Result<PictureInfo> info = inspect_jpeg(span_of(file));
    Bytes scratch(info ? static_cast<std::size_t>(info->scratch_bytes) : 0);
    return decode_jpeg(span_of(file), span_of(scratch), dst.view());
}

/// The largest difference to libjpeg's pixels.
template <class Pixel>
int difference(const GuardedImage<Pixel>& actual, const Decoded& expected) {
    int largest = 0;
    const Size size = actual.view().size();
    if (size != expected.size) return 256;
    const std::size_t row_bytes = sizeof(Pixel) * static_cast<std::size_t>(size.width);
    for (int y = 0; y < size.height; ++y) {
        const auto* row = reinterpret_cast<const std::uint8_t*>(actual.view().row(y));
        for (std::size_t i = 0; i < row_bytes; ++i)
            largest = std::max(
                largest, std::abs(row[i] - expected.pixels[static_cast<std::size_t>(y) * row_bytes + i]));
    }
    return largest;
}

/// Both pixels of a good file, which must be libjpeg's to the last bit.
void expect_equal_to_libjpeg(const Bytes& file) {
    const Decoded gray = reference(file, JCS_GRAYSCALE);
    const Decoded rgb = reference(file, JCS_RGB);
    ASSERT_TRUE(gray.ok && rgb.ok);
    GuardedImage<Gray8> our_gray(gray.size);
    GuardedImage<Rgb888> our_rgb(rgb.size);
    ASSERT_EQ(decode(file, our_gray), Status::ok);
    ASSERT_EQ(decode(file, our_rgb), Status::ok);
    EXPECT_EQ(difference(our_gray, gray), 0);
    EXPECT_EQ(difference(our_rgb, rgb), 0);
}

TEST(JpegAgainstLibjpeg, IsEqualAtEverySamplingSizeAndQuality) {
    Random random(60);
    const std::vector<Size> sizes = {{1, 1},   {1, 9},   {2, 2},   {3, 5},   {4, 4},
                                     {5, 3},   {7, 16},  {8, 8},   {15, 17}, {16, 16},
                                     {17, 15}, {31, 33}, {32, 16}, {33, 65}, {65, 33}};
    for (const Size size : sizes)
        for (int across = 1; across <= 2; ++across)
            for (int down = 1; down <= 2; ++down)
                for (const int quality : {10, 50, 95, 100})
                    for (const unsigned restart : {0u, 1u, 3u}) {
                        SCOPED_TRACE(testing::Message()
                                     << size.width << "x" << size.height << " sampled " << across << "x"
                                     << down << " quality " << quality << " restart " << restart);
                        Coding coding;
                        coding.quality = quality;
                        coding.across = across;
                        coding.down = down;
                        coding.restart_interval = restart;
                        coding.standard_codes = restart != 1;
                        ASSERT_NO_FATAL_FAILURE(
                            expect_equal_to_libjpeg(encode(drawing(random, size, 3), size, coding)));
                    }
}

TEST(JpegAgainstLibjpeg, IsEqualInGray) {
    Random random(61);
    for (const Size size : test_sizes())
        for (const int quality : {1, 10, 50, 95, 100}) {
            SCOPED_TRACE(testing::Message() << size.width << "x" << size.height << " quality " << quality);
            Coding coding;
            coding.components = 1;
            coding.quality = quality;
            ASSERT_NO_FATAL_FAILURE(expect_equal_to_libjpeg(encode(drawing(random, size, 1), size, coding)));
        }
}

TEST(JpegAgainstLibjpeg, IsEqualOnNoiseOfFullContrast) {
    Random random(62);
    const Size size{48, 40};
    for (const int quality : {1, 5, 20, 60, 100})
        for (int sampling = 1; sampling <= 2; ++sampling) {
            Bytes pixels(static_cast<std::size_t>(3 * size.area()));
            for (std::uint8_t& sample : pixels) sample = random.below(2) == 0 ? 0 : 255;
            Coding coding;
            coding.quality = quality;
            coding.across = coding.down = sampling;
            ASSERT_NO_FATAL_FAILURE(expect_equal_to_libjpeg(encode(pixels, size, coding)));
        }
}

TEST(JpegAgainstLibjpeg, LeavesRedGreenAndBlueAsTheyAre) {
    Random random(63);
    const Size size{45, 29};
    Coding coding;
    coding.stored = JCS_RGB;
    const Bytes file = encode(drawing(random, size, 3), size, coding);
    const Decoded rgb = reference(file, JCS_RGB);
    GuardedImage<Rgb888> our_rgb(size);
    GuardedImage<Gray8> our_gray(size);
    ASSERT_EQ(decode(file, our_rgb), Status::ok);
    ASSERT_EQ(decode(file, our_gray), Status::ok);
    EXPECT_EQ(difference(our_rgb, rgb), 0);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) ASSERT_EQ(our_gray(x, y), gray_of(our_rgb(x, y)));
}

/// The file without its DHT segments.
Bytes without_codes(const Bytes& file) {
    Bytes stripped(file.begin(), file.begin() + 2);
    std::size_t at = 2;
    while (file[at + 1] != 0xda) {
        const std::size_t length = 2u + static_cast<std::size_t>(file[at + 2] << 8 | file[at + 3]);
        if (file[at + 1] != 0xc4)
            stripped.insert(stripped.end(), file.begin() + static_cast<std::ptrdiff_t>(at),
                            file.begin() + static_cast<std::ptrdiff_t>(at + length));
        at += length;
    }
    stripped.insert(stripped.end(), file.begin() + static_cast<std::ptrdiff_t>(at), file.end());
    return stripped;
}

TEST(JpegAgainstLibjpeg, NeedsNoStandardCodesInTheFile) {
    Random random(64);
    const Size size{50, 30};
    Coding coding;
    coding.across = 2;
    const Bytes file = encode(drawing(random, size, 3), size, coding);
    const Bytes stripped = without_codes(file);
    ASSERT_EQ(stripped.size(), file.size() - 4 * 4 - (4 * 17 + 2 * 12 + 2 * 162) + 4 * 2 - 4 * 2);
    GuardedImage<Rgb888> with(size), without(size);
    ASSERT_EQ(decode(file, with), Status::ok);
    ASSERT_EQ(decode(stripped, without), Status::ok);
    EXPECT_TRUE(equal(with.view(), without.view()));
}

TEST(JpegAgainstLibjpeg, RefusesOtherProcessesAndFourColours) {
    Random random(65);
    const Size size{20, 20};
    const auto status = [&](const Coding& coding) {
        const Bytes file = encode(drawing(random, size, coding.components), size, coding);
        EXPECT_FALSE(file.empty());
        GuardedImage<Gray8> dst(size);
        return decode(file, dst);
    };
    Coding progressive;
    progressive.progressive = true;
    EXPECT_EQ(status(progressive), Status::unsupported);
    Coding arithmetic;
    arithmetic.arithmetic = true;
    EXPECT_EQ(status(arithmetic), Status::unsupported);
    Coding cmyk;
    cmyk.components = 4;
    EXPECT_EQ(status(cmyk), Status::unsupported);
}

TEST(JpegAgainstLibjpeg, RefusesEveryDamagedFileThatLibjpegWarnsOf) {
    Random random(66);
    const Size size{40, 32};
    int passed = 0;
    for (const int down : {1, 2}) {
        Coding coding;
        coding.across = 2;
        coding.down = down;
        coding.quality = 75;
        coding.restart_interval = down == 1 ? 2 : 0;
        const Bytes good = encode(drawing(random, size, 3), size, coding);
        const std::uint8_t marker[2] = {0xff, 0xda};
        const auto scan = static_cast<std::uint32_t>(
            std::search(good.begin(), good.end(), marker, marker + 2) - good.begin());
        for (int round = 0; round < 5000; ++round) {
            Bytes file = good;
            const auto place = random.below(static_cast<std::uint32_t>(file.size()));
            file[place] ^= static_cast<std::uint8_t>(1 << random.below(8));
            // Ss, Se, Ah and Al of the scan and the version of JFIF, of which libjpeg warns and at which we
            // do not look.
            if ((place >= scan + 11 && place <= scan + 13) || place == 11) continue;
            GuardedImage<Rgb888> ours(size);
            if (decode(file, ours) != Status::ok) continue;
            ++passed;
            const Decoded theirs = reference(file, JCS_RGB);
            ASSERT_TRUE(theirs.ok) << "round " << round;
            ASSERT_EQ(theirs.warnings, 0) << "round " << round;
            ASSERT_EQ(difference(ours, theirs), 0) << "round " << round;
        }
    }
    // A flip of a value or a step makes another good file; one of a code word or a marker does not.
    EXPECT_LT(passed, 8000);
}

// ---- Photographs ------------------------------------------------------------------

std::vector<std::filesystem::path> pictures_in(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> found;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".jpg") found.push_back(entry.path());
    std::sort(found.begin(), found.end());
    return found;
}

/// Equal, or refused where libjpeg says that the file is no baseline picture.
void expect_photographs_equal(const std::filesystem::path& folder) {
    int compared = 0;
    for (const std::filesystem::path& path : pictures_in(folder)) {
        SCOPED_TRACE(path.filename().string());
        const Bytes file = read_file(path);
        const Decoded theirs = reference(file, JCS_RGB);
        if (!theirs.ok || !theirs.known_process) {
            EXPECT_EQ(inspect_jpeg(span_of(file)).status(), Status::unsupported);
            continue;
        }
        ASSERT_NO_FATAL_FAILURE(expect_equal_to_libjpeg(file));
        ++compared;
    }
    EXPECT_GT(compared, 0);
}

TEST(JpegAgainstLibjpeg, IsEqualOnThePhotographsOfOpenCv) {
    FOVEA_NEED_PICTURE(opencv_doc_folder() / "board.jpg");
    expect_photographs_equal(opencv_doc_folder());
    // Two of them by name: a progressive picture, and one with restart markers.
    EXPECT_EQ(inspect_jpeg(
                  span_of(static_cast<const Bytes&>(read_file(opencv_doc_folder() / "Blender_Suzanne1.jpg"))))
                  .status(),
              Status::unsupported);
    EXPECT_TRUE(
        inspect_jpeg(span_of(static_cast<const Bytes&>(read_file(opencv_doc_folder() / "ellipses.jpg")))));
}

TEST(JpegAgainstLibjpeg, IsEqualOnTheTestPicturesOfDecoders) {
    FOVEA_NEED_PICTURE(data_folder() / "decoders" / "jpeg");
    expect_photographs_equal(data_folder() / "decoders" / "jpeg");
}

TEST(JpegAgainstLibjpeg, IsEqualOnTheLaserPictures) {
    FOVEA_NEED_PICTURE(data_folder() / "laser");
    expect_photographs_equal(data_folder() / "laser");
}

}  // namespace
}  // namespace fovea::test

#endif
