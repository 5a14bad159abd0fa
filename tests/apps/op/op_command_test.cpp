// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include <fovea/filter/gaussian.hpp>
#include <fovea/filter/sobel.hpp>
#include <fovea/morphology/morphology.hpp>
#include <fovea/pixelwise/threshold.hpp>
#include <fovea/statistics/otsu_threshold.hpp>

#include <op/op_command.hpp>
#include <op/ops_command.hpp>
#include <support/json.hpp>
#include <support/picture_tool.hpp>

namespace fovea::test {
namespace {

using apps::ExitCode;
using apps::Picture;
using Words = std::vector<std::string>;

class OpCommand : public PictureTool {
protected:
    OpCommand()
        : PictureTool(apps::op_command<TestIo>, {23, 11},
                      [](int x, int y) { return x > 6 && y > 3 ? 180 + x : 20 + 3 * y; }) {}

    std::vector<std::uint8_t> scratch = std::vector<std::uint8_t>(100000);
    Span<std::uint8_t> memory() { return {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}; }
};

TEST_F(OpCommand, AppliesAnOperator) {
    ASSERT_EQ(run({"sobel_magnitude", "in.png", "out.png"}), apps::exit_ok);
    EXPECT_EQ(io.out, "wrote out.png\n");
    EXPECT_EQ(io.errors(), "");
    Picture<Gray8> expected(source.size);
    ASSERT_EQ(sobel_magnitude(source.view(), Border::replicate, memory(), expected.view()), Status::ok);
    EXPECT_EQ(written("out.png").pixels, expected.pixels);
}

TEST_F(OpCommand, AppliesAPipelineWithValuesByPlaceAndByName) {
    ASSERT_EQ(run({"threshold : 100 |erode:height=5, width=3|open:3", "in.png", "out.pgm"}), apps::exit_ok);
    Picture<Gray8> a(source.size), b(source.size);
    ASSERT_EQ(threshold(source.view(), 100, a.view()), Status::ok);
    ASSERT_EQ(erode(a.view(), {3, 5}, memory(), b.view()), Status::ok);
    ASSERT_EQ(opening(b.view(), {3, 3}, memory(), b.view()), Status::ok);
    EXPECT_EQ(written("out.pgm").pixels, b.pixels);
}

TEST_F(OpCommand, KnowsShortNames) {
    ASSERT_EQ(run({"gaussian_5x5 | otsu | open:3 | close:5,3", "in.png", "out.png"}), apps::exit_ok);
    Picture<Gray8> a(source.size), b(source.size);
    ASSERT_EQ(gaussian_5x5(source.view(), Border::replicate, memory(), a.view()), Status::ok);
    ASSERT_EQ(otsu_threshold(a.view(), memory(), b.view()), Status::ok);
    ASSERT_EQ(opening(b.view(), {3, 3}, memory(), b.view()), Status::ok);
    ASSERT_EQ(closing(b.view(), {5, 3}, memory(), b.view()), Status::ok);
    EXPECT_EQ(written("out.png").pixels, b.pixels);
}

TEST_F(OpCommand, SaysThatAPictureHasOneLevelAlone) {
    refuses({"threshold:255 | otsu", "in.png", "out.png"},
            "fovea op: otsu_threshold: the data do not determine an answer (23x11)");
}

TEST_F(OpCommand, TakesTheWidthForTheHeightWhereNoneIsGiven) {
    ASSERT_EQ(run({"erode:7", "in.png", "out.png"}), apps::exit_ok);
    Picture<Gray8> expected(source.size);
    ASSERT_EQ(erode(source.view(), {7, 7}, memory(), expected.view()), Status::ok);
    EXPECT_EQ(written("out.png").pixels, expected.pixels);
}

TEST_F(OpCommand, ShowsDerivativesAboutTheMiddleGrey) {
    ASSERT_EQ(run({"sobel_x", "in.png", "out.png"}), apps::exit_ok);
    const Picture<Gray8> shown = written("out.png");
    // The highest number is where the part is brightest less where the ground is darkest: 4 * (188 - 35).
    EXPECT_EQ(io.out, "wrote out.png, which shows numbers from 0 to 612\n");
    EXPECT_EQ(shown.view()(0, 0), 0);
    EXPECT_EQ(shown.view()(7, 5), 255);
    ASSERT_EQ(run({"sobel_y:zero", "in.png", "out2.png"}), apps::exit_ok);
    // From the last row down to black: -(200 + 2 * 201 + 202).
    EXPECT_EQ(written("out2.png").view()(3, 2), 128 + (24 * 127 + 402) / 804);
    EXPECT_EQ(io.out, "wrote out2.png, which shows numbers from -804 to 700\n");
}

TEST_F(OpCommand, TellsEveryStepInJson) {
    ASSERT_EQ(run({"--json", "box:5,border=zero | threshold:90", "in.png", "out.png"}), apps::exit_ok);
    const std::vector<std::string> lines = lines_of(io.out);
    ASSERT_EQ(lines.size(), 2u);
    EXPECT_EQ(lines[0].substr(0, lines[0].find(",\"scratch")),
              "{\"schema\":1,\"op\":\"box\",\"values\":{\"width\":5,\"height\":5,\"border\":\"zero\"},"
              "\"pixel\":\"gray8\",\"width_px\":23,\"height_px\":11");
    EXPECT_EQ(
        lines[1],
        "{\"schema\":1,\"op\":\"threshold\",\"values\":{\"level\":90},\"pixel\":\"gray8\",\"width_px\":23,"
        "\"height_px\":11,\"scratch_bytes\":0}");
}

TEST_F(OpCommand, SaysWhatIsWrongWithAPipeline) {
    refuses({"sobel_magnitud_", "in.png", "out.png"},
            "fovea op: no operator is called 'sobel_magnitud_'; did you mean sobel_magnitude?; `fovea ops` "
            "lists them");
    refuses({"", "in.png", "out.png"}, "fovea op: no operator is called ''; `fovea ops` lists them");
    refuses({"erode|", "in.png", "out.png"}, "fovea op: no operator is called ''; `fovea ops` lists them");
    refuses({"median_", "in.png", "out.png"}, "fovea op: 'median_' may be median_3x3 or median_5x5");
    refuses({"erode:4", "in.png", "out.png"}, "fovea op: erode: width is 1, 3 ... 63, not '4'");
    refuses({"erode:3.5", "in.png", "out.png"}, "fovea op: erode: width is 1, 3 ... 63, not '3.5'");
    refuses({"erode:99999999999999999999", "in.png", "out.png"},
            "fovea op: erode: width is 1, 3 ... 63, not '99999999999999999999'");
    refuses({"erode:3,3,3", "in.png", "out.png"}, "fovea op: erode takes no more than width and height");
    refuses({"erode:widht=3", "in.png", "out.png"},
            "fovea op: erode has no parameter 'widht'; did you mean width?");
    refuses({"to_gray:1", "in.png", "out.png"}, "fovea op: to_gray takes no value");
    refuses({"gaussian_3x3:black", "in.png", "out.png"},
            "fovea op: gaussian_3x3: border is replicate, reflect_101 or zero, not 'black'");
    refuses({"sobel_x | erode", "in.png", "out.png"},
            "fovea op: sobel_x makes gradient16, but erode takes gray8");
    refuses({"threshold_range:200,100", "in.png", "out.png"},
            "fovea op: threshold_range: a parameter is out of its range (23x11)");
}

TEST_F(OpCommand, SaysWhatIsWrongWithTheFiles) {
    refuses({"erode", "in.png"},
            "fovea op: needs a pipeline, a picture and the picture to write, such as: fovea op "
            "sobel_magnitude in.jpg "
            "out.png");
    refuses({"erode", "in.png", "b.png", "out.png"},
            "fovea op: what is out.png? the pipeline takes one picture");
    refuses({"erode", "in.png", "out.jpg"}, "fovea op: out.jpg: fovea writes PNG, PGM and PPM; name it .png");
    refuses({"gray_from_yuyv", "in.png", "out.png"}, "a picture file cannot give yuyv");
    EXPECT_EQ(run({"erode", "none.png", "out.png"}), apps::exit_failed);
    EXPECT_EQ(io.errors().substr(0, 10), "none.png: ");
}

class OpsCommand : public ::testing::Test {
protected:
    ExitCode run(const Words& words) {
        io.hush();
        return apps::ops_command(io, words);
    }
    TestIo io;
};

TEST_F(OpsCommand, ListsEveryOperatorWithItsSummary) {
    ASSERT_EQ(run({}), apps::exit_ok);
    std::size_t count = 0;
    for (const OperatorFamily& family : apps::all_operators())
        for (const Operator& op : family.operators) {
            ++count;
            EXPECT_NE(io.out.find(std::string("  ") + op.name + " "), std::string::npos) << op.name;
            EXPECT_NE(io.out.find(std::string(op.summary) + "\n"), std::string::npos) << op.name;
        }
    EXPECT_EQ(lines_of(io.out).size(), count + static_cast<std::size_t>(apps::all_operators().size()));
    ASSERT_EQ(run({"--json"}), apps::exit_ok);
    EXPECT_EQ(lines_of(io.out).size(), count);
}

TEST_F(OpsCommand, TellsOfOneOperator) {
    ASSERT_EQ(run({"erode"}), apps::exit_ok);
    EXPECT_EQ(io.out,
              "erode: the smallest value under a rectangle: bright things shrink\n"
              "  gray8 to gray8; book 2.7.2\n"
              "  width: columns of the element, odd; 1, 3 ... 63; 3 if not given\n"
              "  height: rows of the element, odd; 1, 3 ... 63; as width if not given\n");
    ASSERT_EQ(run({"close"}), apps::exit_ok);
    EXPECT_EQ(io.out.substr(0, io.out.find('\n')),
              "closing (close): dilation, then erosion: removes what is dark and smaller than the rectangle");
    ASSERT_EQ(run({"--json", "otsu"}), apps::exit_ok);
    EXPECT_NE(io.out.find(R"("op":"otsu_threshold","family":"statistics","alias":"otsu",)"),
              std::string::npos);
    EXPECT_EQ(run({"erod_"}), apps::exit_failed);
    EXPECT_EQ(io.errors(),
              "fovea ops: no operator is called 'erod_'; did you mean erode?; `fovea ops` lists them\n");
}

}  // namespace
}  // namespace fovea::test
