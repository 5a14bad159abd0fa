// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include <common/picture_file.hpp>
#include <fovea/base/random.hpp>
#include <fovea/codec/bmp.hpp>
#include <support/test_io.hpp>

namespace fovea::test {
namespace {

using apps::load_gray;
using apps::Picture;
using apps::save_picture;

Picture<Gray8> noise(Size size, std::uint64_t seed) {
    Random random(seed);
    Picture<Gray8> picture(size);
    for (Gray8& pixel : picture.pixels) pixel = static_cast<Gray8>(random.below(256));
    return picture;
}

TEST(Picture, HasAViewOfItsSize) {
    Picture<Rgb888> picture({7, 3});
    EXPECT_EQ(picture.view().size(), (Size{7, 3}));
    EXPECT_EQ(picture.view().stride_bytes(), 21);
    EXPECT_TRUE(Picture<Gray8>().view().empty());
}

TEST(LoadGray, ReadsBackWhatWasSavedInEveryFormat) {
    for (const char* name : {"a.png", "a.pgm", "a.ppm", "a.PGM", "noending", "-", "dir.pgm/picture"})
        for (const Size size : {Size{1, 1}, Size{33, 17}, Size{640, 3}}) {
            TestIo io;
            std::string problem;
            const Picture<Gray8> saved = noise(size, 3);
            ASSERT_TRUE(save_picture(io.storage(), name, saved, problem)) << problem;
            Picture<Gray8> loaded;
            ASSERT_TRUE(load_gray(io.storage(), name, loaded, problem)) << problem;
            EXPECT_EQ(loaded.size, size);
            EXPECT_EQ(loaded.pixels, saved.pixels) << name;
        }
}

TEST(SavePicture, ChoosesTheFormatByTheEndingWhateverItsCase) {
    TestIo io;
    std::string problem;
    const Picture<Gray8> gray = noise({5, 4}, 4);
    const Picture<Rgb888> colour({5, 4});
    const auto starts = [&](const std::string& name, const std::string& bytes) {
        return io.text(name).compare(0, bytes.size(), bytes) == 0;
    };
    for (const char* name : {"a.pgm", "a.ppm", "a.pnm", "A.PGM"}) {
        ASSERT_TRUE(save_picture(io.storage(), name, gray, problem));
        EXPECT_TRUE(starts(name, "P5")) << name;
        ASSERT_TRUE(save_picture(io.storage(), name, colour, problem));
        EXPECT_TRUE(starts(name, "P6")) << name;
    }
    for (const char* name : {"a.png", "a.PNG", "a", "-", "pgm"}) {
        ASSERT_TRUE(save_picture(io.storage(), name, gray, problem));
        EXPECT_TRUE(starts(name, "\x89PNG")) << name;
    }
}

TEST(SavePicture, RefusesEndingsOfFormatsThatItDoesNotWrite) {
    TestIo io;
    for (const char* name : {"a.jpg", "a.JPEG", "a.bmp", "x/a.tif", "a.gif", "a.webp"}) {
        std::string problem;
        EXPECT_FALSE(save_picture(io.storage(), name, noise({5, 4}, 5), problem));
        EXPECT_EQ(problem, std::string(name) + ": fovea writes PNG, PGM and PPM; name it .png");
        EXPECT_FALSE(io.has(name));
    }
}

TEST(SavePicture, SaysWhatTheStorageSaid) {
    TestIo io;
    io.files.refused = "a.png";
    std::string problem;
    EXPECT_FALSE(save_picture(io.storage(), "a.png", noise({5, 4}, 6), problem));
    EXPECT_EQ(problem, "a.png: simulated fault");
}

TEST(LoadGray, NamesTheFileThatIsMissingOrRefused) {
    TestIo io;
    Picture<Gray8> picture;
    std::string problem;
    EXPECT_FALSE(load_gray(io.storage(), "no.png", picture, problem));
    EXPECT_EQ(problem, "no.png: simulated fault");
    io.put("yes.png", "x");
    io.files.refused = "yes.png";
    EXPECT_FALSE(load_gray(io.storage(), "yes.png", picture, problem));
    EXPECT_EQ(problem, "yes.png: simulated fault");
}

TEST(LoadGray, SaysWhatItReadsWhenItCannotReadAFile) {
    for (const std::string& bytes :
         {std::string(), std::string("P"), std::string("hello, world"), std::string("GIF89a"),
          std::string("%PDF-1.4"), std::string("P8\n1 1\n255\n.")}) {
        TestIo io;
        io.put("a", bytes);
        Picture<Gray8> picture;
        std::string problem;
        EXPECT_FALSE(load_gray(io.storage(), "a", picture, problem));
        EXPECT_EQ(problem, bytes.empty()
                               ? "a: the file is empty"
                               : "a: not a picture that fovea reads: PGM, PPM, BMP, PNG or baseline JPEG");
    }
}

TEST(LoadGray, TellsWhichFormatADamagedPictureHasAndLeavesNoPicture) {
    TestIo io;
    std::string problem;
    ASSERT_TRUE(save_picture(io.storage(), "a.png", noise({40, 30}, 7), problem));
    ASSERT_TRUE(save_picture(io.storage(), "a.pgm", noise({40, 30}, 7), problem));
    std::vector<std::uint8_t> bmp(static_cast<std::size_t>(encoded_bmp_bytes<Gray8>({40, 30})));
    const Picture<Gray8> picture = noise({40, 30}, 7);
    ASSERT_TRUE(encode_bmp(picture.view(), {bmp.data(), static_cast<std::ptrdiff_t>(bmp.size())}).ok());
    io.put("a.bmp", bmp);
    for (const char* name : {"a.png", "a.pgm", "a.bmp"}) {
        const std::string whole = io.text(name);
        io.put("cut", whole.substr(0, whole.size() - 100));
        Picture<Gray8> loaded = noise({3, 3}, 8);
        problem.clear();
        EXPECT_FALSE(load_gray(io.storage(), "cut", loaded, problem));
        EXPECT_NE(problem.find("cut: the data end too early ("), std::string::npos) << problem;
        EXPECT_TRUE(loaded.size.empty()) << name;
        EXPECT_TRUE(loaded.pixels.empty()) << name;
    }
    // One wrong bit in the middle of a PNG.
    std::string damaged = io.text("a.png");
    damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 1);
    io.put("damaged", damaged);
    Picture<Gray8> loaded;
    EXPECT_FALSE(load_gray(io.storage(), "damaged", loaded, problem));
    EXPECT_EQ(problem, "damaged: the data contradict their format (PNG)");
    EXPECT_TRUE(loaded.size.empty());
}

TEST(LoadGray, SaysHowToSaveAVariantThatItDoesNotRead) {
    TestIo io;
    io.put("a.jpg", std::vector<std::uint8_t>{0xff, 0xd8, 0xff, 0xc2, 0, 11, 8, 0, 8, 0, 8, 1, 1, 0x11, 0});
    io.put("a.pgm", "P2\n1 1\n255\n7\n");
    Picture<Gray8> picture;
    std::string problem;
    EXPECT_FALSE(load_gray(io.storage(), "a.jpg", picture, problem));
    EXPECT_EQ(
        problem,
        "a.jpg: this variant of the format is not supported (JPEG); save it as PNG or as baseline JPEG");
    EXPECT_FALSE(load_gray(io.storage(), "a.pgm", picture, problem));
    EXPECT_EQ(problem, "a.pgm: this variant of the format is not supported (PGM/PPM); save it as PNG");
}

TEST(LoadGray, SurvivesAPictureCutAnywhereAndDamagedAnywhere) {
    TestIo io;
    std::string problem;
    ASSERT_TRUE(save_picture(io.storage(), "a.png", noise({9, 8}, 9), problem));
    ASSERT_TRUE(save_picture(io.storage(), "a.pgm", noise({9, 8}, 9), problem));
    Random random(10);
    for (const char* name : {"a.png", "a.pgm"}) {
        const std::string whole = io.text(name);
        for (std::size_t length = 0; length < whole.size(); ++length) {
            io.put("cut", whole.substr(0, length));
            Picture<Gray8> loaded;
            problem.clear();
            ASSERT_FALSE(load_gray(io.storage(), "cut", loaded, problem)) << name << length;
            ASSERT_EQ(problem.compare(0, 5, "cut: "), 0) << problem;
        }
        for (int i = 0; i < 2000; ++i) {
            std::string damaged = whole;
            for (int k = 0; k < 3; ++k)
                damaged[random.below(static_cast<std::uint32_t>(whole.size()))] =
                    static_cast<char>(random.below(256));
            io.put("damaged", damaged);
            Picture<Gray8> loaded;
            problem.clear();
            if (load_gray(io.storage(), "damaged", loaded, problem))
                EXPECT_EQ(loaded.pixels.size(), static_cast<std::size_t>(loaded.size.area()));
            else
                EXPECT_NE(problem, "");
        }
    }
}

}  // namespace
}  // namespace fovea::test
