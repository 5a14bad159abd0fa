// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <gauge/left_out.hpp>
#include <gauge/recipe_file.hpp>
#include <support/commands.hpp>
#include <support/json.hpp>
#include <support/teaching.hpp>
#include <support/test_io.hpp>

namespace fovea::test {
namespace {

using namespace shapes;
using apps::ExitCode;
using apps::LeftOut;
using apps::Picture;
using Words = std::vector<std::string>;

/// Of parts between 5000 and 12000 px.
LocateRule rule_of_plates() {
    LocateRule rule;
    rule.area_min = 5000;
    rule.area_max = 12000;
    return rule;
}

/// A good plate beside something else.
Picture<Gray8> beside_a_plate(const Shape& other, double x) {
    return picture_of({560, 250}, {{plate(), 120, 125, 0}, {other, x, 125, 0}}, back_light(), 801);
}

TEST(LeftOut, HoldsWhatIsNeitherAPartNorDirt) {
    const Picture<Gray8> cut = beside_a_plate(rectangle(180, 60), 550);
    const LeftOut at_border = apps::left_out_of(cut, rule_of_plates());
    ASSERT_EQ(at_border.at_border.size(), 1u);
    EXPECT_EQ(at_border.count(), 1u);
    const LeftOut large = apps::left_out_of(beside_a_plate(rectangle(200, 150), 400), rule_of_plates());
    ASSERT_EQ(large.too_large.size(), 1u);
    EXPECT_EQ(large.count(), 1u);
    const LeftOut small = apps::left_out_of(beside_a_plate(rectangle(40, 40), 400), rule_of_plates());
    ASSERT_EQ(small.too_small.size(), 1u);
    EXPECT_EQ(small.count(), 1u);
    EXPECT_EQ(apps::left_out_of(beside_a_plate(rectangle(30, 30), 400), rule_of_plates()).count(), 0u);
    EXPECT_EQ(apps::left_out_of(beside_a_plate(plate(), 400), rule_of_plates()).count(), 0u);
}

TEST(LeftOut, TakesTheBorderWhereTheRuleDoes) {
    LocateRule rule = rule_of_plates();
    rule.at_border = true;
    EXPECT_EQ(apps::left_out_of(beside_a_plate(rectangle(180, 60), 530), rule).count(), 0u);
}

class LeftOutCommand : public ::testing::Test {
protected:
    LeftOutCommand() {
        io.put("r.toml", apps::write_recipe(taught_from({lying(plate(), 0, 802)}).recipe));
        io.put("cut.pgm", pgm_of(beside_a_plate(plate(), 540)));
        io.put("two.pgm", pgm_of(beside_a_plate(plate(), 400)));
    }
    ExitCode run(const Words& words) {
        io.hush();
        return apps::gauge_command(io, words);
    }
    TestIo io;
};

TEST_F(LeftOutCommand, IsToldOfToPeopleAndMachines) {
    EXPECT_EQ(run({"--job", "r.toml", "--json", "cut.pgm"}), apps::exit_ok);
    EXPECT_EQ(io.errors().compare(0, 45, "cut.pgm: note: not measured: 1 dark region of"), 0) << io.errors();
    EXPECT_NE(io.errors().find("px at the border"), std::string::npos);
    const auto json = parse_json(io.out);
    ASSERT_TRUE(json.has_value());
    EXPECT_EQ((*json)["left_out"].text, "1");
    EXPECT_EQ(run({"--job", "r.toml", "two.pgm"}), apps::exit_ok);
    EXPECT_EQ(io.errors(), "");
}

TEST_F(LeftOutCommand, FailsWhereAnotherNumberOfPartsIsAskedFor) {
    EXPECT_EQ(run({"--job", "r.toml", "--parts", "2", "two.pgm"}), apps::exit_ok);
    EXPECT_EQ(run({"--job", "r.toml", "--parts", "2", "cut.pgm"}), apps::exit_failed);
    EXPECT_NE(io.errors().find("cut.pgm: 1 part measured, and --parts asks for 2\n"), std::string::npos);
    for (const char* wrong : {"0", "1.5", "257", "-1", "two"}) {
        EXPECT_EQ(run({"--job", "r.toml", "--parts", wrong, "two.pgm"}), apps::exit_failed) << wrong;
        EXPECT_EQ(io.out, "");
    }
}

}  // namespace
}  // namespace fovea::test
