// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <fovea/pixelwise/threshold.hpp>

#include <op/sheet_command.hpp>
#include <support/picture_tool.hpp>

namespace fovea::test {
namespace {

using apps::Picture;

class SheetCommand : public PictureTool {
protected:
    SheetCommand()
        : PictureTool(apps::sheet_command<TestIo>, {60, 40},
                      [](int x, int y) { return x < 30 ? 20 + y : 200 - y; }) {}
};

TEST_F(SheetCommand, ShowsThePictureAndWhatPipelinesMakeOfIt) {
    ASSERT_EQ(run({"in.png", "out.png", "threshold:100", "invert | invert"}), apps::exit_ok);
    EXPECT_EQ(io.out, "wrote out.png, 3 pictures\n");
    const Picture<Gray8> sheet = written("out.png");
    // Tiles are as wide as half of what a tile may be, 120, with 8 between them; 4, a line of 10 and 8 below.
    EXPECT_EQ(sheet.size, (Size{8 + 3 * 128, 8 + 40 + 4 + 10 + 8}));
    Picture<Gray8> binary(source.size);
    ASSERT_EQ(threshold(source.view(), 100, binary.view()), Status::ok);
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 60; ++x) {
            ASSERT_EQ(sheet.view()(8 + x, 8 + y), source.view()(x, y));
            ASSERT_EQ(sheet.view()(136 + x, 8 + y), binary.view()(x, y));
            ASSERT_EQ(sheet.view()(264 + x, 8 + y), source.view()(x, y));
        }
    // There is a text below each tile.
    for (const int left : {8, 136, 264}) {
        int dark = 0;
        for (int y = 52; y < 62; ++y)
            for (int x = left; x < left + 60; ++x) dark += sheet.view()(x, y) < 100;
        EXPECT_GT(dark, 20);
    }
}

TEST_F(SheetCommand, ShrinksAndBreaksRows) {
    ASSERT_EQ(run({"--tile", "32", "--columns=2", "in.png", "out.png", "invert", "pyramid_down"}),
              apps::exit_ok);
    const Picture<Gray8> sheet = written("out.png");
    EXPECT_EQ(sheet.size.width, 8 + 2 * 40);
    // "the picture" and "pyramid_down" take three lines of five letters; pictures are 32x21 and 30x20.
    EXPECT_EQ(sheet.size.height, 8 + 21 + 4 + 30 + 8 + 20 + 4 + 30 + 8);
    // Brightness survives.
    EXPECT_NEAR(sheet.view()(8 + 2, 8 + 10), 40, 3);
    EXPECT_NEAR(sheet.view()(48 + 2, 8 + 10), 215, 3);
}

TEST_F(SheetCommand, BreaksTextsWhereThereIsASpace) {
    using Lines = std::vector<std::string>;
    EXPECT_EQ(apps::detail::lines_of("", 60), Lines{""});
    EXPECT_EQ(apps::detail::lines_of("0123456789", 60), Lines{"0123456789"});
    EXPECT_EQ(apps::detail::lines_of("0123456789a", 60), (Lines{"0123456789", "a"}));
    EXPECT_EQ(apps::detail::lines_of("box:3 | invert", 60), (Lines{"box:3 | ", "invert"}));
    EXPECT_EQ(apps::detail::lines_of("range:1,22,333", 60), (Lines{"range:1,", "22,333"}));
    EXPECT_EQ(apps::detail::lines_of("ab", 1), (Lines{"a", "b"}));
}

TEST_F(SheetCommand, ColourStaysColour) {
    Picture<Rgb888> coloured(Size{40, 40});
    for (Rgb888& pixel : coloured.pixels) pixel = {200, 40, 10};
    std::string problem;
    ASSERT_TRUE(apps::save_picture(io.storage(), "colour.png", coloured, problem)) << problem;
    ASSERT_EQ(run({"--second", "in.png", "colour.png", "out.png", "flip_x_rgb", "to_gray"}), apps::exit_ok);
    Picture<Rgb888> sheet;
    ASSERT_TRUE(apps::load_picture(io.storage(), "out.png", max_image_side, sheet, problem)) << problem;
    EXPECT_EQ(sheet.view()(20, 20), (Rgb888{200, 40, 10}));
    EXPECT_EQ(sheet.view()(148, 20), (Rgb888{200, 40, 10}));
    EXPECT_EQ(sheet.view()(276, 20).red, sheet.view()(276, 20).blue);
}

TEST_F(SheetCommand, SaysWhatIsWrong) {
    refuses({"in.png", "out.png"},
            "fovea sheet: needs a picture, the picture to write and a pipeline, such as: fovea sheet in.jpg "
            "sheet.png box:5");
    refuses({"in.png", "out.jpg", "invert"},
            "fovea sheet: out.jpg: fovea writes PNG, PGM and PPM; name it .png");
    refuses({"in.png", "out.png", "erode:4"}, "fovea sheet: erode: width is 1, 3 ... 63, not '4'");
    refuses({"in.png", "out.png", "absolute_difference"},
            "fovea sheet: absolute_difference takes two pictures: name the other one with --second");
    refuses({"--tile=20", "in.png", "out.png", "invert"},
            "fovea sheet: --tile takes a whole number from 32 to 1024, not '20'");
    refuses({"--columns", "two", "in.png", "out.png", "invert"},
            "fovea sheet: --columns takes a whole number from 1 to 16, not 'two'");
    refuses({"in.png", "out.png", "threshold_range:9,3"},
            "fovea sheet: threshold_range: a parameter is out of its range (60x40)");
    refuses({"none.png", "out.png", "invert"}, "none.png: simulated fault");
}

}  // namespace
}  // namespace fovea::test
