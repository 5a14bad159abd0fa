// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include <support/command_calibrate.hpp>
#include <support/commands.hpp>
#include <support/test_io.hpp>
#include <tool/commands.hpp>

namespace fovea::test {
namespace {

using apps::ExitCode;
using Words = std::vector<std::string>;

class Tool : public ::testing::Test {
protected:
    ExitCode run(const Words& words) {
        io.hush();
        return apps::run_command(io, words);
    }
    void refuses(const Words& words, const std::string& complaint) {
        EXPECT_EQ(run(words), apps::exit_failed);
        EXPECT_EQ(io.errors(), complaint + "\n");
        EXPECT_EQ(io.out, "");
    }

    TestIo io;
};

const Words names = {"gauge",  "teach", "compile", "make-part", "calibrate", "undistort", "rectify",
                     "camera", "op",    "ops",     "info",      "compare",   "probe",     "doctor"};

TEST_F(Tool, ListsItsCommandsWhenAskedForHelp) {
    for (const char* word : {"--help", "-h", "help"}) {
        EXPECT_EQ(run({word}), apps::exit_ok);
        EXPECT_EQ(io.errors(), "");
        const std::vector<std::string> lines = lines_of(io.out);
        ASSERT_FALSE(lines.empty());
        EXPECT_EQ(lines[0], "usage: fovea COMMAND [options] ...");
        for (const std::string& name : names)
            EXPECT_EQ(std::count_if(lines.begin(), lines.end(),
                                    [&](const std::string& line) {
                                        return line.compare(0, name.size() + 3, "  " + name + " ") == 0;
                                    }),
                      1)
                << name;
    }
}

TEST_F(Tool, ShowsTheSameWithoutACommandButFails) {
    run({"--help"});
    const std::string help = io.out;
    EXPECT_EQ(run({}), apps::exit_failed);
    EXPECT_EQ(io.out, help);
}

TEST_F(Tool, TellsItsVersion) {
    EXPECT_EQ(run({"--version"}), apps::exit_ok);
    EXPECT_EQ(io.out, "fovea unknown\n");
}

TEST_F(Tool, PrintsAManualPageWithAllCommandsAndOptions) {
    EXPECT_EQ(run({"--manual"}), apps::exit_ok);
    for (const std::string& name : names)
        EXPECT_NE(io.out.find("\n.SS fovea " + apps::manual_text(name)), std::string::npos) << name;
    EXPECT_NE(io.out.find("\n.B \\-\\-size WxH\n"), std::string::npos);
    EXPECT_EQ(apps::manual_text(".a-b\n'c.d\\"), "\\&.a\\-b\n\\&'c.d\\e");
}

TEST_F(Tool, SuggestsTheNearestCommandForAnUnknownOne) {
    refuses({"gaug"}, "fovea: unknown command gaug; did you mean gauge? `fovea --help` lists them");
    refuses({"Teach", "x"}, "fovea: unknown command Teach; did you mean teach? `fovea --help` lists them");
    refuses({"make_part"},
            "fovea: unknown command make_part; did you mean make-part? `fovea --help` lists them");
    refuses({"banana"}, "fovea: unknown command banana; `fovea --help` lists them");
    refuses({"--verbose"}, "fovea: unknown command --verbose; `fovea --help` lists them");
    refuses({""}, "fovea: unknown command ; `fovea --help` lists them");
    refuses({"a\nb\x1b[2J"}, "fovea: unknown command a?b?[2J; `fovea --help` lists them");
}

TEST_F(Tool, ShowsTheHelpOfEveryCommand) {
    for (const std::string& name : names) {
        EXPECT_EQ(run({name, "--help"}), apps::exit_ok) << name;
        EXPECT_EQ(io.errors(), "");
        EXPECT_EQ(io.out.compare(0, 14 + name.size(), "usage: fovea " + name + " "), 0) << io.out;
        EXPECT_NE(io.out.find("\n  --help  "), std::string::npos);
    }
}

TEST_F(Tool, EndsWithTwoWhenACommandIsMisused) {
    for (const std::string& name : names)
        for (const Words& rest : {Words{}, Words{"--bogus"}, Words{"--out"}, Words{"-"}}) {
            // The list of operators is what somebody wants who says no more, and - is a picture or a camera.
            if ((name == "ops" && rest.empty()) ||
                ((name == "info" || name == "camera") && rest == Words{"-"}))
                continue;
            // These two look at the machine.
            if ((name == "probe" || name == "doctor") && rest.empty()) continue;
            Words words = {name};
            words.insert(words.end(), rest.begin(), rest.end());
            EXPECT_EQ(run(words), apps::exit_failed) << name;
            ASSERT_EQ(io.complaints.size(), 1u) << name;
            EXPECT_EQ(io.complaints[0].compare(0, 8 + name.size(), "fovea " + name + ": "), 0)
                << io.complaints[0];
            EXPECT_EQ(io.out, "");
        }
}

TEST_F(Tool, MakesTeachesAndGauges) {
    EXPECT_EQ(run({"make-part", "--out", "good.png", "--size", "320x240", "--plate", "180x70", "--cut",
                   "30x20", "--holes", "50,-2,15;-48,4,9"}),
              apps::exit_ok);
    EXPECT_EQ(run({"make-part", "--out", "bad.png", "--size", "320x240", "--plate", "180x70", "--cut",
                   "30x20", "--holes", "50,-2,16;-48,4,9", "--angle", "200"}),
              apps::exit_ok);
    EXPECT_EQ(run({"teach", "--out", "r.toml", "--known-length", "60", "good.png"}), apps::exit_ok);
    EXPECT_EQ(run({"gauge", "--job", "r.toml", "good.png"}), apps::exit_ok) << io.out;
    EXPECT_EQ(run({"gauge", "--job", "r.toml", "good.png", "bad.png"}), apps::exit_not_ok) << io.out;
    EXPECT_EQ(io.errors(), "");
}

}  // namespace
}  // namespace fovea::test
