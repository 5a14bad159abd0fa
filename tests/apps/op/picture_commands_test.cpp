// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <op/picture_commands.hpp>
#include <support/test_io.hpp>

namespace fovea::test {
namespace {

using apps::ExitCode;
using Words = std::vector<std::string>;

class PictureCommands : public ::testing::Test {
protected:
    PictureCommands() {
        io.put("a.pgm", "P5\n3 2\n255\n" + std::string("\x0a\x14\x1e\x0a\x14\xc8"));
        io.put("b.pgm", "P5\n3 2\n255\n" + std::string("\x0a\x17\x1e\x0a\x14\xc9"));
        io.put("flat.pgm", "P5\n2 1\n255\n" + std::string("\x05\x05"));
        io.put("colour.ppm",
               "P6\n3 2\n255\n" +
                   std::string("\x0a\x0a\x0a\x14\x14\x14\x1e\x1e\x28\x0a\x0a\x0a\x14\x14\x14\xc8\xc8\xc8"));
    }
    ExitCode info(const Words& words) {
        io.hush();
        return apps::info_command(io, words);
    }
    ExitCode compare(const Words& words) {
        io.hush();
        return apps::compare_command(io, words);
    }
    TestIo io;
};

TEST_F(PictureCommands, InfoTellsSizeAndLevels) {
    EXPECT_EQ(info({"a.pgm"}), apps::exit_ok);
    // (10 + 20 + 30 + 10 + 20 + 200) / 6 = 48.333; Otsu splits 200 from the rest, in the middle of 31 to 200.
    EXPECT_EQ(io.out, "a.pgm: PGM/PPM, 3x2, 17 bytes; levels 10 to 200, mean 48.333, otsu 115\n");
    EXPECT_EQ(info({"--json", "a.pgm"}), apps::exit_ok);
    EXPECT_EQ(io.out,
              "{\"schema\":1,\"picture\":\"a.pgm\",\"format\":\"PGM/"
              "PPM\",\"width_px\":3,\"height_px\":2,\"file_bytes\":17,"
              "\"least_level\":10,\"greatest_level\":200,\"mean_level\":48.333,\"otsu_level\":115}\n");
}

TEST_F(PictureCommands, InfoTellsOfAllPicturesAndFailsIfOneIsNone) {
    EXPECT_EQ(info({"none.png", "flat.pgm"}), apps::exit_failed);
    EXPECT_EQ(io.out, "flat.pgm: PGM/PPM, 2x1, 13 bytes; levels 5 to 5, mean 5.000, otsu none\n");
    EXPECT_EQ(io.errors().substr(0, 10), "none.png: ");
    EXPECT_EQ(info({}), apps::exit_failed);
    EXPECT_EQ(io.errors(), "fovea info: which picture?\n");
}

TEST_F(PictureCommands, CompareFindsTheFirstDifference) {
    EXPECT_EQ(compare({"a.pgm", "a.pgm"}), apps::exit_ok);
    EXPECT_EQ(io.out, "the pixels are the same\n");
    EXPECT_EQ(compare({"a.pgm", "b.pgm"}), apps::exit_not_ok);
    // Levels differ by 3 and 1: 4 in 6 pixels.
    EXPECT_EQ(io.out,
              "2 of 6 pixels differ by more than 0, the first at 1,0; greatest difference 3, mean 0.667\n");
    EXPECT_EQ(compare({"--json", "a.pgm", "b.pgm"}), apps::exit_not_ok);
    EXPECT_EQ(io.out,
              "{\"schema\":1,\"differing_pixels\":2,\"greatest_difference\":3,\"mean_difference\":0.667,"
              "\"first_x_px\":1,\"first_y_px\":0}\n");
}

TEST_F(PictureCommands, CompareAllowsWhatItIsToldTo) {
    EXPECT_EQ(compare({"--tolerance", "3", "a.pgm", "b.pgm"}), apps::exit_ok);
    EXPECT_EQ(io.out, "no pixel differs by more than 3; greatest difference 3, mean 0.667\n");
    EXPECT_EQ(compare({"--tolerance", "2", "a.pgm", "b.pgm"}), apps::exit_not_ok);
    for (const char* wrong : {"-1", "256", "1.5", "x"}) {
        EXPECT_EQ(compare({"--tolerance=" + std::string(wrong), "a.pgm", "b.pgm"}), apps::exit_failed);
        EXPECT_EQ(io.errors(), "fovea compare: --tolerance takes a whole number from 0 to 255, not '" +
                                   std::string(wrong) + "'\n");
    }
}

TEST_F(PictureCommands, CompareSeesColour) {
    EXPECT_EQ(compare({"a.pgm", "colour.ppm"}), apps::exit_not_ok);
    EXPECT_EQ(io.out,
              "1 of 6 pixels differ by more than 0, the first at 2,0; greatest difference 10, mean 0.556\n");
}

TEST_F(PictureCommands, CompareRefusesPicturesOfDifferentSize) {
    EXPECT_EQ(compare({"a.pgm", "flat.pgm"}), apps::exit_failed);
    EXPECT_EQ(io.errors(), "fovea compare: a.pgm is 3x2, flat.pgm is 2x1\n");
    EXPECT_EQ(compare({"a.pgm"}), apps::exit_failed);
    EXPECT_EQ(io.errors(), "fovea compare: needs two pictures\n");
    EXPECT_EQ(compare({"a.pgm", "none.pgm"}), apps::exit_failed);
    EXPECT_EQ(io.errors().substr(0, 10), "none.pgm: ");
}

}  // namespace
}  // namespace fovea::test
