// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <fovea/code/read_data_matrix.hpp>
#include <support/data_matrix_scene.hpp>

namespace fovea::test {
namespace {

constexpr double degree = 3.14159265358979 / 180;

TEST(ReadDataMatrix, ReadsEverySizeAtTwoPixelsAModule) {
    for (const DataMatrixSize& size : data_matrix_sizes) {
        DataMatrixScene scene;
        scene.size = {size.columns, size.rows};
        scene.text = std::string(static_cast<std::size_t>(size.data), 'x').substr(0, 40);
        for (std::size_t i = 0; i < scene.text.size(); ++i)
            scene.text[i] = static_cast<char>('0' + i * 7 % 10);
        scene.module = 2;
        scene.quiet = 1;
        DrawnImage image = draw(scene);
        const DataMatrixFinds finds = find_data_matrix(image.view());
        ASSERT_EQ(finds.status, Status::ok) << int{size.rows} << "x" << int{size.columns};
        EXPECT_EQ(finds.texts, std::vector<std::string>{scene.text});
    }
}

TEST(ReadDataMatrix, ReadsAtAnyAngle) {
    for (int angle = 0; angle < 360; angle += 7) {
        DataMatrixScene scene;
        scene.turn = angle * degree;
        scene.module = 2.5;
        scene.noise = 10;
        DrawnImage image = draw(scene);
        const DataMatrixFinds finds = find_data_matrix(image.view());
        ASSERT_EQ(finds.texts, std::vector<std::string>{scene.text}) << angle;
        EXPECT_FALSE(finds.codes[0].mirrored);
        EXPECT_FALSE(finds.codes[0].inverted);
    }
}

TEST(ReadDataMatrix, ReadsTiltedMirroredPaleAndLightOnDark) {
    DataMatrixScene tilted;
    tilted.tilt = 0.3;
    tilted.turn = 20 * degree;
    DataMatrixScene mirrored;
    mirrored.mirrored = true;
    DataMatrixScene long_mirrored;
    long_mirrored.mirrored = true;
    long_mirrored.size = {26, 12};
    DataMatrixScene pale;
    pale.dark = 110;
    pale.light = 150;
    DataMatrixScene turned_about;
    turned_about.dark = 220;
    turned_about.light = 30;
    for (const DataMatrixScene& scene : {tilted, mirrored, long_mirrored, pale, turned_about}) {
        DrawnImage image = draw(scene);
        const DataMatrixFinds finds = find_data_matrix(image.view());
        ASSERT_EQ(finds.texts, std::vector<std::string>{scene.text});
        EXPECT_EQ(finds.codes[0].mirrored, scene.mirrored);
        EXPECT_EQ(finds.codes[0].inverted, scene.dark > scene.light);
    }
}

TEST(ReadDataMatrix, TellsCornersInTheOrderOfReading) {
    DataMatrixScene scene;
    DrawnImage image = draw(scene);
    const DataMatrixFinds finds = find_data_matrix(image.view());
    ASSERT_EQ(finds.codes.size(), 1U);
    // 64 px in the middle of the image; pixel centres are at whole numbers, edges at halves.
    const double first = (image.size.width - 64) / 2.0 - 0.5;
    const double last = first + 64;
    const double expected[4][2] = {{first, first}, {last, first}, {last, last}, {first, last}};
    for (int i = 0; i < 4; ++i) {
        EXPECT_NEAR(finds.codes[0].corners[i].x.raw() / 256.0, expected[i][0], 0.3) << i;
        EXPECT_NEAR(finds.codes[0].corners[i].y.raw() / 256.0, expected[i][1], 0.3) << i;
    }
}

TEST(ReadDataMatrix, ReadsSeveralSymbolsOfAnImage) {
    DataMatrixScene scene;
    DrawnImage one = draw(scene);
    DrawnImage four;
    four.size = {2 * one.size.width, 2 * one.size.height};
    four.pixels.resize(static_cast<std::size_t>(four.size.area()));
    for (int k = 0; k < 4; ++k) {
        scene.text = "part " + std::to_string(k);
        one = draw(scene);
        for (int y = 0; y < one.size.height; ++y)
            for (int x = 0; x < one.size.width; ++x)
                four.view()(x + k % 2 * one.size.width, y + k / 2 * one.size.height) = one.view()(x, y);
    }
    EXPECT_EQ(find_data_matrix(four.view()).texts.size(), 4U);
    ReadDataMatrixOptions options;
    options.most_codes = 2;
    EXPECT_EQ(find_data_matrix(four.view(), options).texts.size(), 2U);
}

TEST(ReadDataMatrix, FindsNothingInNoiseAndEvenImages) {
    Random random(7);
    DrawnImage image;
    image.size = {160, 120};
    image.pixels.resize(static_cast<std::size_t>(image.size.area()));
    for (int round = 0; round < 20; ++round) {
        const int least = round == 0 ? 255 : 0;
        for (std::uint8_t& pixel : image.pixels)
            pixel = static_cast<std::uint8_t>(round % 2 == 0 ? random.between(least, 255)
                                                             : random.between(0, 1) * 255);
        EXPECT_EQ(find_data_matrix(image.view()).status, Status::not_found) << round;
    }
    for (int width = 1; width < 12; ++width) {
        const ImageView<const Gray8> small(image.pixels.data(), {width, 13 - width}, 160);
        EXPECT_EQ(find_data_matrix(small).status, Status::not_found);
    }
}

TEST(ReadDataMatrix, SaysWhatIsWrongAndLeavesTheListsAsTheyWere) {
    DataMatrixScene scene;
    DrawnImage image = draw(scene);
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(read_data_matrix_scratch(image.size)));
    const Span<std::uint8_t> all(scratch.data(), static_cast<std::ptrdiff_t>(scratch.size()));
    std::uint8_t room[3] = {};
    CodeText text(room);
    List<Code, 1> codes;
    ListView<Code> list = codes;
    ReadDataMatrixOptions options;
    EXPECT_EQ(read_data_matrix({}, options, all, text, list), Status::empty_image);
    options.least_contrast = 3;
    EXPECT_EQ(read_data_matrix(image.view(), options, all, text, list), Status::bad_argument);
    options = {};
    options.most_codes = 0;
    EXPECT_EQ(read_data_matrix(image.view(), options, all, text, list), Status::bad_argument);
    options = {};
    EXPECT_EQ(read_data_matrix(image.view(), options, all.first(100), text, list), Status::scratch_too_small);
    EXPECT_EQ(read_data_matrix(image.view(), options, all, text, list), Status::buffer_too_small);
    EXPECT_EQ(text.size(), 0);
    EXPECT_TRUE(codes.empty());
    std::uint8_t more[100] = {};
    CodeText long_text(more);
    ASSERT_EQ(codes.push(Code()), Status::ok);
    EXPECT_EQ(read_data_matrix(image.view(), options, all, long_text, list), Status::capacity_exceeded);
    EXPECT_EQ(long_text.size(), 0);
    EXPECT_EQ(codes.size(), 1);
}

TEST(ReadDataMatrix, GradesACleanSymbolBestAndAPaleOneLower) {
    DataMatrixScene scene;
    scene.dark = 0;
    scene.light = 255;
    DrawnImage clean = draw(scene);
    EXPECT_EQ(find_data_matrix(clean.view()).codes.at(0).grade.overall, 4);
    scene.dark = 110;
    scene.light = 200;
    DrawnImage pale = draw(scene);
    const CodeGrade grade = find_data_matrix(pale.view()).codes.at(0).grade;
    EXPECT_EQ(grade.symbol_contrast, 1);  // 35 %
    EXPECT_EQ(grade.overall, 1);
    EXPECT_EQ(grade.decodability, CodeGrade::not_graded);
}

TEST(ReadDataMatrix, TriesTheCornersOfTheRowInWhichTheWorkEnds) {
    DataMatrixScene scene;
    scene.size = {10, 10};
    scene.text = "42";
    scene.module = 2;
    DrawnImage symbol = draw(scene);
    DrawnImage image;
    image.size = {320, 240};
    ReadDataMatrixOptions options;
    options.effort = ReadDataMatrixOptions::Effort::quick;
    options.polarity = CodePolarity::dark_on_light;
    // Between two eighths of the image, so that it is met in a batch of rows, with noise beside it. From
    // there on, and so dark, its borders take the work that was left to the batch.
    const int scenes[5][2] = {{80, 40}, {100, 45}, {120, 45}, {200, 40}, {220, 30}};
    for (const auto& [left, percent] : scenes) {
        Random random(5);
        image.pixels.assign(static_cast<std::size_t>(image.size.area()), 220);
        for (int y = 0; y < symbol.size.height; ++y)
            for (int x = 0; x < symbol.size.width; ++x) image.view()(20 + x, 31 + y) = symbol.view()(x, y);
        for (int y = 0; y < 70; ++y)
            for (int x = left; x < 320; ++x) image.view()(x, y) = random.between(0, 99) < percent ? 20 : 220;
        EXPECT_EQ(find_data_matrix(image.view(), options).texts, std::vector<std::string>{"42"}) << left;
    }
}

}  // namespace
}  // namespace fovea::test
