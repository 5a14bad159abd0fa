// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <core/codec/jpeg_file.hpp>
#include <fovea/codec/bmp.hpp>
#include <fovea/codec/png_writer.hpp>
#include <fovea/codec/pnm.hpp>
#include <make_part/part_scene.hpp>
#include <support/plate_scene.hpp>

#include "gauge_command_fixture.hpp"

namespace fovea::test {
namespace {

/// A JPEG file of the finest steps, which changes grey levels by rounding alone.
std::vector<std::uint8_t> jpeg_of(const Picture<Gray8>& picture) {
    JpegFile file;
    file.quantiser(0, 1).frame(picture.size, 1).scan(1);
    int previous = 0;
    for (int top = 0; top < picture.size.height; top += 8)
        for (int left = 0; left < picture.size.width; left += 8) {
            std::vector<double> samples;
            for (int i = 0; i < 64; ++i)
                samples.push_back(picture.view()(std::min(left + i % 8, picture.size.width - 1),
                                                 std::min(top + i / 8, picture.size.height - 1)) -
                                  128.0);
            const std::vector<double> coefficients = naive_forward(samples);
            Coefficients quantised(64);
            for (std::size_t k = 0; k < 64; ++k)
                quantised[k] = static_cast<int>(std::lround(coefficients[jpeg::zigzag[k]]));
            file.block(quantised, previous, 0);
            previous = quantised[0];
        }
    file.pad().marker(0xd9);
    return file.bytes;
}

TEST_F(GaugeCommand, WritesTheAnnotatedPicture) {
    EXPECT_EQ(run({"--job", "r.toml", "--explain", "out.png", "good.pgm"}), apps::exit_ok);
    EXPECT_EQ(io.text("out.png").compare(0, 4, "\x89PNG"), 0);
    EXPECT_EQ(run({"--job", "r.toml", "--explain", "out.ppm", "good.pgm"}), apps::exit_ok);
    EXPECT_EQ(io.text("out.ppm").compare(0, 2, "P6"), 0);
}

TEST_F(GaugeCommand, NumbersTheAnnotatedPicturesOfSeveralImages) {
    EXPECT_EQ(run({"--job", "r.toml", "--explain", "a.b/out.png", "good.pgm", "bad.pgm", "white.pgm"}),
              apps::exit_failed);
    EXPECT_TRUE(io.has("a.b/out-0.png") && io.has("a.b/out-1.png") && io.has("a.b/out-2.png"));
    EXPECT_FALSE(io.has("a.b/out.png"));
    run({"--job", "r.toml", "--explain", "a.b/out", "good.pgm", "bad.pgm"});
    EXPECT_TRUE(io.has("a.b/out-0") && io.has("a.b/out-1"));
    run({"--job", "r.toml", "--explain", ".hidden", "good.pgm", "bad.pgm"});
    EXPECT_TRUE(io.has(".hidden-1"));
    run({"--job", "r.toml", "--explain", "x/.hidden", "good.pgm", "bad.pgm"});
    EXPECT_TRUE(io.has("x/.hidden-1"));
}

TEST_F(GaugeCommand, WritesNoAnnotatedPictureOfWhatItCouldNotRead) {
    std::string cut = io.text("good.pgm");
    cut.resize(cut.size() / 2);
    io.put("cut.pgm", cut);
    EXPECT_EQ(run({"--job", "r.toml", "--explain", "out.png", "cut.pgm"}), apps::exit_failed);
    EXPECT_EQ(io.errors(), "cut.pgm: the data end too early (PGM/PPM)\n");
    EXPECT_FALSE(io.has("out.png"));
}

TEST_F(GaugeCommand, DoesNotOverwriteWhatItReads) {
    refuses({"--job", "r.toml", "--explain", "good.pgm", "good.pgm"},
            "fovea gauge: --explain would overwrite good.pgm; give another name");
    refuses({"--job", "r.toml", "--explain", "r.toml", "good.pgm"},
            "fovea gauge: --explain would overwrite r.toml; give another name");
    io.put("x-1.pgm", io.text("good.pgm"));
    refuses({"--job", "r.toml", "--explain", "x.pgm", "good.pgm", "x-1.pgm"},
            "fovea gauge: --explain would overwrite x-1.pgm; give another name");
    refuses({"--job", "r.toml", "--explain", "-", "good.pgm"},
            "fovea gauge: --explain writes a file; the standard output has the results");
}

TEST_F(GaugeCommand, EndsWithTwoWhenTheAnnotatedPictureCannotBeWritten) {
    io.files.refused = "out.png";
    EXPECT_EQ(run({"--job", "r.toml", "--explain", "out.png", "good.pgm"}), apps::exit_failed);
    EXPECT_EQ(io.errors(), "out.png: simulated fault\n");
    EXPECT_EQ(lines_of(io.out).size(), 1u);
}

TEST_F(GaugeCommand, RefusesANameOfAnotherFormatBeforeItMeasures) {
    refuses({"--job", "r.toml", "--explain", "out.jpg", "good.pgm"},
            "fovea gauge: --explain out.jpg: fovea writes PNG, PGM and PPM; name it .png");
    refuses({"--job", "r.toml", "--explain", "nodir/x.TIFF", "good.pgm", "bad.pgm"},
            "fovea gauge: --explain nodir/x.TIFF: fovea writes PNG, PGM and PPM; name it .png");
}

// ---- Formats -----------------------------------------------------------------------------------

TEST_F(GaugeCommand, MeasuresTheSameInEveryLosslessFormatAndFromTheStandardInput) {
    const Picture<Gray8> gray = render(scene());
    Picture<Rgb888> colour(gray.size);
    for (std::size_t i = 0; i < gray.pixels.size(); ++i)
        colour.pixels[i] = {gray.pixels[i], gray.pixels[i], gray.pixels[i]};
    const auto put = [&](const char* name, std::int64_t room, auto encode) {
        std::vector<std::uint8_t> bytes(static_cast<std::size_t>(room));
        const Result<std::ptrdiff_t> length =
            encode(Span<std::uint8_t>(bytes.data(), static_cast<std::ptrdiff_t>(room)));
        ASSERT_TRUE(length.ok()) << name;
        bytes.resize(static_cast<std::size_t>(*length));
        io.put(name, bytes);
    };
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(png_writer_scratch(gray.size)));
    const Span<std::uint8_t> room(scratch.data(), static_cast<std::ptrdiff_t>(scratch.size()));
    put("a.pgm", encoded_pnm_bytes<Gray8>(gray.size), [&](auto out) { return encode_pnm(gray.view(), out); });
    put("-", encoded_pnm_bytes<Rgb888>(gray.size), [&](auto out) { return encode_pnm(colour.view(), out); });
    put("a.ppm", encoded_pnm_bytes<Rgb888>(gray.size),
        [&](auto out) { return encode_pnm(colour.view(), out); });
    put("gray.bmp", encoded_bmp_bytes<Gray8>(gray.size),
        [&](auto out) { return encode_bmp(gray.view(), out); });
    put("colour.bmp", encoded_bmp_bytes<Rgb888>(gray.size),
        [&](auto out) { return encode_bmp(colour.view(), out); });
    put("gray.png", encoded_png_bytes<Gray8>(gray.size),
        [&](auto out) { return encode_png(gray.view(), room, out); });
    put("colour.png", encoded_png_bytes<Rgb888>(gray.size),
        [&](auto out) { return encode_png(colour.view(), room, out); });
    std::string first;
    for (const char* name : {"a.pgm", "-", "a.ppm", "gray.bmp", "colour.bmp", "gray.png", "colour.png"}) {
        ASSERT_EQ(run({"--json", "--job", "r.toml", name}), apps::exit_ok) << name << io.errors();
        std::string line = io.out;
        line.erase(0, line.find(",\"part\""));
        if (first.empty()) first = line;
        EXPECT_EQ(line, first) << name;
    }
}

TEST_F(GaugeCommand, MeasuresAJpegPictureToAHundredthOfAPixelTheSame) {
    io.put("good.jpg", jpeg_of(render(scene())));
    const std::vector<Json> objects = json_of({"--json", "--job", "r.toml", "good.pgm", "good.jpg"});
    ASSERT_EQ(objects.size(), 2u) << io.errors();
    EXPECT_EQ(objects[1]["verdict"].text, "ok");
    EXPECT_NEAR(objects[1]["x"].number(), objects[0]["x"].number(), 0.01);
    EXPECT_NEAR(objects[1]["y"].number(), objects[0]["y"].number(), 0.01);
    EXPECT_NEAR(objects[1]["features"].items[0]["value"].number(),
                objects[0]["features"].items[0]["value"].number(), 0.02);
}

TEST_F(GaugeCommand, ReadsTheRecipeFromTheStandardInput) {
    io.put("-", recipe);
    EXPECT_EQ(run({"--job", "-", "good.pgm"}), apps::exit_ok) << io.errors();
}

TEST_F(GaugeCommand, MeasuresInMillimetres) {
    std::string text = recipe;
    text.insert(text.find("[locate]"), "[scale]\nunit = \"mm\"\nper_pixel_x = 0.1\nper_pixel_y = 0.1\n");
    for (const auto& [from, to] :
         {std::pair("[0, -60]", "[0, -6]"), std::pair("[0, 60]", "[0, 6]"),
          std::pair("nominal = 70\nminus = 0.5\nplus = 0.5", "nominal = 7\nminus = 0.05\nplus = 0.05")})
        text.replace(text.find(from), std::string(from).size(), to);
    io.put("x.toml", text);
    EXPECT_EQ(run({"--job", "x.toml", "good.pgm"}), apps::exit_ok) << io.out << io.errors();
    const std::vector<Json> objects = json_of({"--json", "--job", "x.toml", "good.pgm"});
    EXPECT_EQ(objects.at(0)["features"].items.at(0)["unit"].text, "mm");
    EXPECT_NEAR(objects.at(0)["features"].items.at(0)["value"].number(), 7, 0.01);
}

TEST_F(GaugeCommand, SurvivesPicturesThatAreDamagedAnywhere) {
    // Small enough for many rounds; what is read is gauged, what is not is said, and nothing is OK by
    // accident of a crash.
    apps::PartScene small = scene();
    small.size = {96, 64};
    small.length = FinePixel::from_int(60);
    small.height = FinePixel::from_int(24);
    small.cut_x = small.cut_y = FinePixel::from_int(8);
    small.holes.resize(1);
    small.holes[0] = {FinePixel::from_int(15), FinePixel(), FinePixel::from_int(5)};
    small.middle = {FinePixel::from_int(48), FinePixel::from_int(32)};
    const Picture<Gray8> picture = render(small);
    std::string problem;
    ASSERT_TRUE(save_picture(io.storage(), "s.png", picture, problem));
    ASSERT_TRUE(save_picture(io.storage(), "s.pgm", picture, problem));
    std::vector<std::uint8_t> bmp(static_cast<std::size_t>(encoded_bmp_bytes<Gray8>(picture.size)));
    ASSERT_TRUE(encode_bmp(picture.view(), {bmp.data(), static_cast<std::ptrdiff_t>(bmp.size())}).ok());
    io.put("s.bmp", bmp);
    io.put("s.jpg", jpeg_of(picture));
    Random random(301);
    for (const char* name : {"s.png", "s.pgm", "s.bmp", "s.jpg"}) {
        const std::string whole = io.text(name);
        for (int i = 0; i < 60; ++i) {
            std::string damaged = whole;
            for (int k = random.between(1, 4); k > 0; --k) {
                const std::size_t at =
                    random.below(static_cast<std::uint32_t>(random.below(2) == 0 ? 60 : whole.size()));
                damaged[std::min(at, whole.size() - 1)] = static_cast<char>(random.below(256));
            }
            if (i % 4 == 0) damaged.resize(random.below(static_cast<std::uint32_t>(whole.size())));
            io.put("d", damaged);
            const ExitCode code = run({"--json", "--job", "r.toml", "d"});
            ASSERT_TRUE(code == apps::exit_ok || code == apps::exit_not_ok || !io.complaints.empty());
            for (const std::string& line : lines_of(io.out))
                ASSERT_TRUE(parse_json(line).has_value()) << line;
        }
    }
}

}  // namespace
}  // namespace fovea::test
