// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <fovea/code/bar_fields.hpp>
#include <support/bars.hpp>

namespace fovea::test {
namespace {

Status find(const BarPicture& picture, ListView<BarField> fields) {
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(bar_fields_scratch(picture.size)));
    return find_bar_fields(picture.view(), {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())},
                           fields);
}

TEST(BarFields, TellsWhereACodeLiesAndHow) {
    Random random(3171);
    for (int degrees = -80; degrees <= 80; degrees += 20) {
        BarPicture picture({400, 400});
        BarScene scene;
        scene.degrees = degrees;
        scene.height = 100;
        draw_bars(picture, bars_of(Symbology::ean_13, "9780905705712"), scene, random);
        List<BarField, 4> fields;
        ASSERT_EQ(find(picture, fields), Status::ok);
        EXPECT_NEAR(fields[0].across.microdegrees() / 1e6, degrees, 1.5);
        EXPECT_NEAR(fields[0].centre.x.raw() / 256.0, 200, 12);
        EXPECT_NEAR(fields[0].centre.y.raw() / 256.0, 200, 12);
        EXPECT_NEAR(fields[0].length, 95 * 2.5, 40);
        EXPECT_NEAR(fields[0].height, 100, 40);
    }
}

TEST(BarFields, KeepsTheWeightiestFirst) {
    Random random(3172);
    BarPicture picture({640, 480});
    for (int i = 0; i < 4; ++i) {
        BarScene scene;
        scene.module = 1.5;
        scene.x = i % 2 == 0 ? -150 : 150;
        scene.y = i < 2 ? -120 : 120;
        scene.dark = 50 + 30 * i;
        draw_bars(picture, bars_of(Symbology::ean_13, "9780905705712"), scene, random);
    }
    List<BarField, 2> fields;
    ASSERT_EQ(find(picture, fields), Status::ok);
    ASSERT_EQ(fields.size(), 2);
    EXPECT_GT(fields[0].weight, fields[1].weight);
    EXPECT_LT(fields[0].centre.x.floor(), 320);
    EXPECT_GT(fields[1].centre.x.floor(), 320);
}

TEST(BarFields, FlatAndTinyImagesHaveNone) {
    List<BarField, 2> fields;
    for (const Size size : {Size{1, 1}, Size{1, 40}, Size{40, 1}, Size{17, 33}, Size{200, 100}}) {
        EXPECT_EQ(find(BarPicture(size), fields), Status::not_found);
    }
    EXPECT_TRUE(fields.empty());
}

TEST(BarFields, ChecksItsArguments) {
    List<BarField, 2> fields;
    EXPECT_EQ(find_bar_fields({}, {}, fields), Status::empty_image);
    EXPECT_EQ(find_bar_fields(BarPicture({40, 40}).view(), {}, fields), Status::scratch_too_small);
}

}  // namespace
}  // namespace fovea::test
