// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <gauge/report.hpp>
#include <support/json.hpp>
#include <support/recipes.hpp>

namespace fovea::test {
namespace {

using apps::human_feature;
using apps::human_part;
using apps::json_no_part;
using apps::json_part;

Feature feature_of(const std::string& name, FeatureKind kind, std::int64_t nominal, std::int64_t minus,
                   std::int64_t plus) {
    Feature feature;
    set_name(feature.name, name);
    feature.kind = kind;
    feature.tolerance = {{nominal}, {minus}, {plus}};
    return feature;
}

FeatureResult measured(const Feature& feature, std::int64_t value) {
    FeatureResult result;
    result.status = Status::ok;
    result.measurement.value = {value};
    result.verdict = judge({value}, feature.tolerance);
    return result;
}
FeatureResult unmeasured(Status status) {
    FeatureResult result;
    result.status = status;
    return result;
}

constexpr Scale fine_mm{LengthUnit::millimetre, 50000, 50000};

/// A part with one feature of every verdict.
struct Judged {
    Recipe recipe;
    PartResult part;
};
Judged judged() {
    Judged j;
    j.recipe.scale = fine_mm;
    const Feature features[] = {feature_of("length", FeatureKind::width, 40000000, 50000, 100000),
                                feature_of("bore", FeatureKind::hole_diameter, 12000000, 20000, 20000),
                                feature_of("slope", FeatureKind::angle, 90000000, 500000, 500000),
                                feature_of("holes", FeatureKind::hole_count, 2000000, 0, 0),
                                feature_of("gap \"x\"", FeatureKind::distance, 3000000, 100000, 100000)};
    for (const Feature& feature : features) EXPECT_EQ(j.recipe.features.push(feature), Status::ok);
    PartResult& part = j.part;
    part.pose.frame = PartFrame({FinePixel::from_ratio(641, 2), FinePixel::from_ratio(-1, 4)},
                                FineAngle::from_microdegrees(-170250000), fine_mm);
    part.pose.orientation = Status::ok;
    part.pose.ends_certain = true;
    part.pose.margin = Ratio::from_ratio(5, 4);
    part.area = 45201;
    part.holes = 2;
    part.feature_count = 5;
    part.features[0] = measured(features[0], 40003412);
    part.features[0].measurement.blur = SquarePixels::from_ratio(9, 4);
    part.features[1] = measured(features[1], 12020001);
    part.features[2] = measured(features[2], 89400000);
    part.features[3] = measured(features[3], 2000000);
    part.features[4] = unmeasured(Status::not_found);
    part.verdict = Verdict::unmeasured;
    return j;
}

TEST(Report, TellsAPersonEveryFeatureAndWhatIsWrongWithIt) {
    const Judged j = judged();
    EXPECT_EQ(human_part("a/b.png", 3, j.part, j.recipe),
              "a/b.png part 3: NOT JUDGED  bore 12.020001 mm HIGH (most 12.020000), slope 89.40 deg LOW "
              "(least 89.50), gap \"x\" NOT MEASURED, length 40.0034 mm, holes 2  [x 320.50, y -0.25 px, "
              "-170.25 deg]\n");
}

TEST(Report, PutsTheOneOfTwelveFeaturesThatIsHighFirst) {
    Judged j = judged();
    j.recipe.features.clear();
    for (int i = 0; i < 12; ++i) {
        const Feature feature = feature_of("f" + std::to_string(i), FeatureKind::width, 1000000, 0, 0);
        ASSERT_EQ(j.recipe.features.push(feature), Status::ok);
        j.part.features[i] = measured(feature, i == 6 ? 2000000 : 1000000);
    }
    j.part.feature_count = 12;
    j.part.verdict = Verdict::not_ok;
    const std::string line = human_part("x", 0, j.part, j.recipe);
    EXPECT_EQ(line.substr(0, 100),
              "x part 0: NOT OK  f6 2.0000 mm HIGH (most 1.0000), f0 1.0000 mm, f1 1.0000 mm, f2 1.0000 mm, "
              "f3 1.00");
    EXPECT_NE(line.find("f5 1.0000 mm, f7 1.0000 mm"), std::string::npos) << line;
    // A machine looks for a name.
    const auto json = parse_json(json_part("x", 0, 2, j.part, j.recipe));
    for (std::size_t i = 0; i < 12; ++i)
        EXPECT_EQ((*json)["features"].items.at(i)["name"].text, "f" + std::to_string(i));
}

TEST(Report, SaysOkOrNotOkFirst) {
    Judged j = judged();
    j.part.feature_count = 1;
    j.part.verdict = Verdict::ok;
    EXPECT_EQ(human_part("x", 0, j.part, j.recipe),
              "x part 0: OK  length 40.0034 mm  [x 320.50, y -0.25 px, -170.25 deg]\n");
    j.part.verdict = Verdict::not_ok;
    EXPECT_EQ(human_part("x", 0, j.part, j.recipe).substr(0, 16), "x part 0: NOT OK");
}

TEST(Report, SaysOnceThatAPartHasNoDirection) {
    Judged j = judged();
    j.part.pose.orientation = Status::undecided;
    for (FeatureResult& feature : j.part.features) feature = unmeasured(Status::undecided);
    EXPECT_EQ(human_part("x", 0, j.part, j.recipe),
              "x part 0: NOT JUDGED (ends undecided)  [x 320.50, y -0.25 px, -170.25 deg]\n");
    const auto json = parse_json(json_part("x", 0, 2, j.part, j.recipe));
    ASSERT_TRUE(json.has_value());
    for (const Json& feature : (*json)["features"].items)
        EXPECT_EQ(feature["reason"].text, "which end of the part is which is undecided");
    j.part.pose.orientation = Status::degenerate;
    EXPECT_EQ(human_part("x", 0, j.part, j.recipe).substr(0, 40), "x part 0: NOT JUDGED (no clear axis)  [x");
}

TEST(Report, StaysOnOneLineWhateverTheFileIsCalled) {
    const Judged j = judged();
    const std::string line = human_part("a\nb\x1b.png", 0, j.part, j.recipe);
    EXPECT_EQ(line.find('\n'), line.size() - 1);
    EXPECT_EQ(line.compare(0, 8, "a?b?.png"), 0);
    const std::string json = json_part("a\nb\x1b.png", 0, 2, j.part, j.recipe);
    EXPECT_EQ(json.find('\n'), json.size() - 1);
    EXPECT_EQ((*parse_json(json))["image"].text, "a\nb\x1b.png");
}

TEST(Report, ShowsAsManyPlacesAsItTakesToSeeThatAValueIsOut) {
    Scale px;
    const Feature length = feature_of("l", FeatureKind::width, 10000000, 100000, 100000);
    EXPECT_EQ(human_feature(measured(length, 10100000), length, px), "l 10.10 px");
    EXPECT_EQ(human_feature(measured(length, 10100001), length, px), "l 10.100001 px HIGH (most 10.100000)");
    EXPECT_EQ(human_feature(measured(length, 10104000), length, px), "l 10.104 px HIGH (most 10.100)");
    EXPECT_EQ(human_feature(measured(length, 10110000), length, px), "l 10.11 px HIGH (most 10.10)");
    EXPECT_EQ(human_feature(measured(length, 9899999), length, px), "l 9.899999 px LOW (least 9.900000)");
}

TEST(Report, ShowsTheLimitsOfACountAsTheyWereGiven) {
    const Feature holes = feature_of("n", FeatureKind::hole_count, 2500000, 500000, 500000);
    EXPECT_EQ(human_feature(measured(holes, 1000000), holes, {}), "n 1 LOW (least 2)");
    EXPECT_EQ(human_feature(measured(holes, 4000000), holes, {}), "n 4 HIGH (most 3)");
    Judged j = judged();
    j.recipe.features[3] = holes;
    const auto json = parse_json(json_part("x", 0, 2, j.part, j.recipe));
    EXPECT_EQ((*json)["features"].items[3]["nominal"].text, "2.5");
    EXPECT_EQ((*json)["features"].items[3]["minus"].text, "0.5");
    EXPECT_EQ((*json)["features"].items[3]["value"].text, "2");
}

TEST(Report, ShowsAHundredthOfAPixelInEveryUnit) {
    const Feature length = feature_of("l", FeatureKind::width, 1000000, 1000000, 1000000);
    const auto places = [&](std::int64_t per_pixel) {
        return apps::places_of(length, {LengthUnit::millimetre, per_pixel, per_pixel});
    };
    EXPECT_EQ(apps::places_of(length, Scale()), 2);
    EXPECT_EQ(places(100000000), 0);
    EXPECT_EQ(places(50000), 4);
    EXPECT_EQ(places(100000), 3);
    EXPECT_EQ(places(99999), 4);
    EXPECT_EQ(places(10), 6);
    EXPECT_EQ(apps::places_of(feature_of("a", FeatureKind::angle, 0, 0, 0), fine_mm), 2);
    EXPECT_EQ(apps::places_of(feature_of("n", FeatureKind::hole_count, 0, 0, 0), fine_mm), 0);
}

TEST(Report, TellsAMachineTheSameInAFixedOrder) {
    const Judged j = judged();
    EXPECT_EQ(
        json_part("a/b.png", 3, 2, j.part, j.recipe),
        "{\"image\":\"a/"
        "b.png\",\"part\":3,\"x\":320.500,\"y\":-0.250,\"angle_deg\":-170.2500,\"flip_confident\":true,"
        "\"flip_margin\":1.250,\"area_px\":45201,\"holes\":2,\"left_out\":2,\"features\":["
        "{\"name\":\"length\",\"value\":40.003412,\"unit\":\"mm\",\"nominal\":40.000000,\"minus\":0.050000,"
        "\"plus\":"
        "0.100000,\"verdict\":\"ok\",\"blur_px\":1.50},"
        "{\"name\":\"bore\",\"value\":12.020001,\"unit\":\"mm\",\"nominal\":12.000000,\"minus\":0.020000,"
        "\"plus\":"
        "0.020000,\"verdict\":\"high\"},"
        "{\"name\":\"slope\",\"value\":89.400000,\"unit\":\"deg\",\"nominal\":90.000000,\"minus\":0.500000,"
        "\"plus\":"
        "0.500000,\"verdict\":\"low\"},"
        "{\"name\":\"holes\",\"value\":2,\"unit\":\"\",\"nominal\":2,\"minus\":0,\"plus\":0,\"verdict\":"
        "\"ok\"},"
        "{\"name\":\"gap "
        "\\\"x\\\"\",\"value\":null,\"unit\":\"mm\",\"nominal\":3.000000,\"minus\":0.100000,\"plus\":"
        "0.100000,\"verdict\":\"unmeasured\",\"reason\":\"fewer edges than asked for along the probe\"}],"
        "\"verdict\":\"unmeasured\"}\n");
}

TEST(Report, IsJsonWithTheSameKeysForEveryVerdict) {
    const std::vector<std::string> keys = {"image",     "part",           "x",           "y",
                                           "angle_deg", "flip_confident", "flip_margin", "area_px",
                                           "holes",     "left_out",       "features",    "verdict"};
    Judged j = judged();
    for (const Verdict verdict : {Verdict::ok, Verdict::not_ok, Verdict::unmeasured}) {
        j.part.verdict = verdict;
        for (const int features : {0, 1, 5}) {
            j.part.feature_count = features;
            const auto json = parse_json(json_part("\xff\"\\.png", 0, 2, j.part, j.recipe));
            ASSERT_TRUE(json.has_value());
            EXPECT_EQ(json->keys, keys);
            EXPECT_EQ((*json)["verdict"].text, apps::word_of(verdict));
            ASSERT_EQ((*json)["features"].items.size(), static_cast<std::size_t>(features));
            for (const Json& feature : (*json)["features"].items) {
                const std::vector<std::string> first(feature.keys.begin(), feature.keys.begin() + 7);
                EXPECT_EQ(first, (std::vector<std::string>{"name", "value", "unit", "nominal", "minus",
                                                           "plus", "verdict"}));
            }
        }
    }
}

TEST(Report, TellsAMachineOfAnImageWithoutParts) {
    EXPECT_EQ(json_no_part("a.png", 0, "no part"),
              "{\"image\":\"a.png\",\"part\":null,\"left_out\":0,\"error\":\"no "
              "part\",\"verdict\":\"unmeasured\"}\n");
    EXPECT_TRUE(parse_json(json_no_part("\xff\n", 0, "\"\x01")).has_value());
}

TEST(Report, NamesEveryVerdict) {
    EXPECT_STREQ(apps::word_of(Verdict::ok), "ok");
    EXPECT_STREQ(apps::word_of(Verdict::low), "low");
    EXPECT_STREQ(apps::word_of(Verdict::high), "high");
    EXPECT_STREQ(apps::word_of(Verdict::not_ok), "not_ok");
    EXPECT_STREQ(apps::word_of(Verdict::unmeasured), "unmeasured");
}

TEST(Report, HasAReasonOnOneLineForEveryStatusOfEveryKind) {
    for (int kind = 0; kind < 7; ++kind)
        for (const Status status : {Status::empty_image, Status::bad_argument, Status::out_of_range,
                                    Status::scratch_too_small, Status::capacity_exceeded, Status::not_found,
                                    Status::undecided, Status::degenerate, Status::io_error}) {
            const Feature feature = feature_of("f", static_cast<FeatureKind>(kind), 0, 0, 0);
            const std::string reason = apps::reason_of(unmeasured(status), feature);
            EXPECT_NE(reason, "");
            EXPECT_TRUE(apps::printable(reason));
            EXPECT_EQ(human_feature(unmeasured(status), feature, {}), "f NOT MEASURED");
        }
}

TEST(Report, KnowsTheUnitOfEveryKind) {
    const auto unit = [](FeatureKind kind, LengthUnit length) {
        return apps::unit_of(feature_of("f", kind, 0, 0, 0), {length, 1000000, 1000000});
    };
    EXPECT_EQ(unit(FeatureKind::angle, LengthUnit::millimetre), "deg");
    EXPECT_EQ(unit(FeatureKind::hole_count, LengthUnit::millimetre), "");
    EXPECT_EQ(unit(FeatureKind::position, LengthUnit::millimetre), "mm");
    EXPECT_EQ(unit(FeatureKind::width, LengthUnit::pixel), "px");
}

}  // namespace
}  // namespace fovea::test
