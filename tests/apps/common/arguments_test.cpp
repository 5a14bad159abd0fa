// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <common/arguments.hpp>

namespace fovea::test {
namespace {

using apps::Arguments;
using apps::Command;

Command bake() {
    return {"bake",
            "CAKE...",
            "Bakes cakes.",
            {{"out", "FILE", "where to"},
             {"heat", "DEG", "of the oven;\n180 if not given"},
             {"dark", "", "longer"}},
            "Mind the oven.\n"};
}
Arguments parse(const std::vector<std::string>& words) { return {bake(), words}; }
using Words = std::vector<std::string>;

TEST(Arguments, AreEmptyWithoutWords) {
    const Arguments none = parse({});
    EXPECT_EQ(none.problem(), "");
    EXPECT_TRUE(none.operands().empty());
    EXPECT_FALSE(none.has("out"));
    EXPECT_FALSE(none.has("help"));
    EXPECT_EQ(none.value("out"), "");
    EXPECT_EQ(none.value("out", "cake.txt"), "cake.txt");
}

TEST(Arguments, TakeAValueBehindASpaceOrAnEqualsSign) {
    for (const Words& words : {Words{"--out", "a=b"}, Words{"--out=a=b"}}) {
        const Arguments read = parse(words);
        EXPECT_EQ(read.problem(), "");
        EXPECT_TRUE(read.has("out"));
        EXPECT_EQ(read.value("out", "other"), "a=b");
        EXPECT_TRUE(read.operands().empty());
    }
    // An empty value is a value.
    for (const Words& words : {Words{"--out="}, Words{"--out", ""}}) {
        EXPECT_EQ(parse(words).problem(), "");
        EXPECT_TRUE(parse(words).has("out"));
        EXPECT_EQ(parse(words).value("out", "other"), "");
    }
}

TEST(Arguments, TakeValuesThatLookLikeShortOptions) {
    EXPECT_EQ(parse({"--heat", "-128"}).value("heat"), "-128");
    EXPECT_EQ(parse({"--out", "-"}).value("out"), "-");
    EXPECT_EQ(parse({"--heat", "-128"}).problem(), "");
}

TEST(Arguments, DoNotTakeAnotherOptionForAForgottenValue) {
    EXPECT_EQ(parse({"--out", "--dark", "cake"}).problem(), "--out needs a value: --out FILE");
    EXPECT_EQ(parse({"--out", "--"}).problem(), "--out needs a value: --out FILE");
    // With = even such a name can be given.
    EXPECT_EQ(parse({"--out=--dark"}).value("out"), "--dark");
}

TEST(Arguments, SayWhichValueIsMissing) {
    EXPECT_EQ(parse({"cake", "--out"}).problem(), "--out needs a value: --out FILE");
}

TEST(Arguments, TakeASwitchAndRefuseItsValue) {
    EXPECT_TRUE(parse({"--dark"}).has("dark"));
    EXPECT_EQ(parse({"--dark"}).problem(), "");
    EXPECT_EQ(parse({"--dark=yes"}).problem(), "--dark takes no value");
    EXPECT_EQ(parse({"--dark="}).problem(), "--dark takes no value");
    // What follows a switch is an operand.
    EXPECT_EQ(parse({"--dark", "yes"}).operands(), Words{"yes"});
}

TEST(Arguments, KeepOperandsInTheirOrderBetweenOptions) {
    const Arguments read = parse({"one", "--out", "x", "two", "--dark", "three"});
    EXPECT_EQ(read.problem(), "");
    EXPECT_EQ(read.operands(), (Words{"one", "two", "three"}));
}

TEST(Arguments, TakeALonelyDashAndAnEmptyWordForOperands) {
    EXPECT_EQ(parse({"-", "", "-"}).operands(), (Words{"-", "", "-"}));
}

TEST(Arguments, TakeEverythingBehindTwoDashesForOperands) {
    const Arguments read = parse({"--dark", "--", "--out", "-x", "--help", "--"});
    EXPECT_EQ(read.problem(), "");
    EXPECT_EQ(read.operands(), (Words{"--out", "-x", "--help", "--"}));
    EXPECT_FALSE(read.has("help"));
    EXPECT_FALSE(read.has("out"));
}

TEST(Arguments, HintAtTheNearestOption) {
    EXPECT_EQ(parse({"--haet", "3"}).problem(), "unknown option --haet; did you mean --heat?");
    EXPECT_EQ(parse({"--oven=3"}).problem(), "unknown option --oven");
    EXPECT_EQ(parse({"--hlep"}).problem(), "unknown option --hlep; did you mean --help?");
    EXPECT_EQ(parse({"-d"}).problem(), "unknown option -d");
    EXPECT_EQ(parse({"-heat"}).problem(), "unknown option -heat; did you mean --heat?");
    EXPECT_EQ(parse({"--=3"}).problem(), "unknown option --");
}

TEST(Arguments, DoNotTakeAPrefixForAnOption) {
    EXPECT_EQ(parse({"--hea", "3"}).problem(), "unknown option --hea; did you mean --heat?");
    EXPECT_EQ(parse({"--he", "3"}).problem(), "unknown option --he");
    EXPECT_EQ(parse({"--outer", "3"}).problem(), "unknown option --outer; did you mean --out?");
}

TEST(Arguments, RefuseAnOptionThatIsGivenTwice) {
    EXPECT_EQ(parse({"--out", "a", "--out=b"}).problem(), "--out is given twice");
    EXPECT_EQ(parse({"--out=a", "--dark", "--out", "a"}).problem(), "--out is given twice");
    EXPECT_EQ(parse({"--dark", "cake", "--dark"}).problem(), "--dark is given twice");
    EXPECT_EQ(parse({"--out", "a", "--", "--out", "b"}).problem(), "");
    // Help may be called for as often as one likes.
    EXPECT_EQ(parse({"--help", "-h"}).problem(), "");
}

TEST(Arguments, ReportTheFirstProblem) {
    EXPECT_EQ(parse({"--dark=1", "--nothing"}).problem(), "--dark takes no value");
}

TEST(Arguments, FindTheCallForHelpAnywhere) {
    for (const Words& words :
         {Words{"--help"}, Words{"-h"}, Words{"cake", "--help"}, Words{"--out", "x", "--dark", "--help"},
          Words{"--nothing", "--help"}, Words{"--dark=1", "-h"}, Words{"--out", "--help"}})
        EXPECT_TRUE(parse(words).has("help")) << words.front();
    EXPECT_TRUE(parse({"--help=out"}).has("help"));
    EXPECT_FALSE(parse({"--", "--help"}).has("help"));
    EXPECT_FALSE(parse({"--out=--help"}).has("help"));
}

TEST(HelpOf, TellsUsageOptionsAndNotesWithinEightyColumns) {
    EXPECT_EQ(apps::help_of(bake()),
              "usage: fovea bake [options] CAKE...\n"
              "\n"
              "Bakes cakes.\n"
              "\n"
              "options:\n"
              "  --out FILE              where to\n"
              "  --heat DEG              of the oven;\n"
              "                          180 if not given\n"
              "  --dark                  longer\n"
              "  --help                  show this\n"
              "\n"
              "Mind the oven.\n");
}

TEST(HelpOf, LeavesOutNotesThatThereAreNot) {
    Command command = bake();
    command.notes = "";
    const std::string help = apps::help_of(command);
    EXPECT_EQ(help.substr(help.size() - 10), "show this\n");
}

TEST(HelpOf, PutsALongOptionBeforeItsTextWithASpace) {
    const Command command{"x", "Y", "Z.", {{"an-option-with", "a very long value", "text"}}, ""};
    EXPECT_NE(apps::help_of(command).find("  --an-option-with a very long value text\n"), std::string::npos);
}

}  // namespace
}  // namespace fovea::test
