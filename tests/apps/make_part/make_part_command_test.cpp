// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <make_part/make_part_command.hpp>
#include <support/commands.hpp>
#include <support/test_io.hpp>

namespace fovea::test {
namespace {

using apps::ExitCode;
using apps::PartScene;
using apps::Picture;
using Words = std::vector<std::string>;

class MakePartCommand : public ::testing::Test {
protected:
    ExitCode run(const Words& words) {
        io.hush();
        return apps::make_part_command(io, words);
    }
    void refuses(const Words& words, const std::string& problem) {
        EXPECT_EQ(run(words), apps::exit_failed);
        EXPECT_EQ(io.errors(), "fovea make-part: " + problem + "\n");
        EXPECT_EQ(io.out, "");
        EXPECT_TRUE(io.files.files.empty());
    }
    /// The picture that the words render.
    Picture<Gray8> rendered(Words words) {
        words.insert(words.begin(), {"--out", "p.pgm"});
        EXPECT_EQ(run(words), apps::exit_ok);
        EXPECT_EQ(io.errors(), "");
        EXPECT_EQ(io.out, "wrote p.pgm\n");
        Picture<Gray8> picture;
        std::string problem;
        EXPECT_TRUE(apps::load_gray(io.storage(), "p.pgm", picture, problem)) << problem;
        return picture;
    }
    /// Expects the picture of the scene of the defaults but for a change, small and without noise.
    void renders(Words words, const std::function<void(PartScene&)>& change) {
        PartScene scene;
        scene.size = {120, 90};
        scene.middle = {FinePixel::from_int(60), FinePixel::from_int(45)};
        scene.length = FinePixel::from_int(80);
        scene.height = FinePixel::from_int(40);
        scene.holes.clear();
        scene.noise = 0;
        change(scene);
        const Words small = {"--size", "120x90", "--plate", "80x40", "--holes", "none", "--noise", "0"};
        for (std::size_t i = 0; i < small.size(); i += 2)
            if (std::none_of(words.begin(), words.end(), [&](const std::string& word) {
                    return word == small[i] || word.rfind(small[i] + "=", 0) == 0;
                }))
                words.insert(words.end(), {small[i], small[i + 1]});
        const Picture<Gray8> picture = rendered(words);
        EXPECT_EQ(picture.size, scene.size);
        EXPECT_TRUE(picture.pixels == render(scene).pixels) << words.back();
    }

    TestIo io;
};

TEST_F(MakePartCommand, RendersTheDefaults) {
    EXPECT_TRUE(rendered({}).pixels == render(PartScene()).pixels);
}

TEST_F(MakePartCommand, RendersWhatEachOptionAsksFor) {
    const auto px = [](int value) { return FinePixel::from_int(value); };
    renders({}, [](PartScene&) {});
    renders({"--size", "100x80"}, [&](PartScene& scene) {
        scene.size = {100, 80};
        scene.middle = {px(50), px(40)};
    });
    renders({"--plate", "50.5x21"}, [&](PartScene& scene) {
        scene.length = FinePixel::from_ratio(101, 2);
        scene.height = px(21);
    });
    renders({"--cut", "0x0"}, [&](PartScene& scene) { scene.cut_x = scene.cut_y = FinePixel(); });
    renders({"--cut", "10x5"}, [&](PartScene& scene) {
        scene.cut_x = px(10);
        scene.cut_y = px(5);
    });
    renders({"--holes", "-20,3,6.25;20,-3,4"}, [&](PartScene& scene) {
        scene.holes = {{px(-20), px(3), FinePixel::from_ratio(25, 4)}, {px(20), px(-3), px(4)}};
    });
    renders({"--holes="}, [](PartScene&) {});
    renders({"--at", "50.25,-3"}, [&](PartScene& scene) {
        scene.middle = {FinePixel::from_ratio(201, 4), px(-3)};
    });
    renders({"--angle", "-120.5"},
            [](PartScene& scene) { scene.angle = FineAngle::from_microdegrees(-120500000); });
    renders({"--blur", "0"}, [](PartScene& scene) { scene.blur = 0; });
    renders({"--blur", "2.5"}, [](PartScene& scene) { scene.blur = 2500000; });
    renders({"--noise", "3.5"}, [](PartScene& scene) { scene.noise = 3500000; });
    renders({"--noise", "3", "--seed", "77"}, [](PartScene& scene) {
        scene.noise = 3000000;
        scene.seed = 77;
    });
    renders({"--bright"}, [](PartScene& scene) { std::swap(scene.part_level, scene.ground_level); });
}

TEST_F(MakePartCommand, PutsThePlateInTheMiddleOfAPictureOfAnySize) {
    renders({"--size", "101x81"}, [](PartScene& scene) {
        scene.size = {101, 81};
        scene.middle = {FinePixel::from_int(50), FinePixel::from_int(40)};
    });
    // An earlier --at stands whatever the order.
    renders({"--at", "30,20", "--size", "100x80"}, [](PartScene& scene) {
        scene.size = {100, 80};
        scene.middle = {FinePixel::from_int(30), FinePixel::from_int(20)};
    });
}

TEST_F(MakePartCommand, WritesThePictureAloneToTheStandardOutput) {
    EXPECT_EQ(run({"--out", "-", "--size", "60x40"}), apps::exit_ok);
    EXPECT_EQ(io.out, "");
    EXPECT_EQ(io.errors(), "");
    EXPECT_EQ(io.text("-").compare(0, 4, "\x89PNG"), 0);
}

TEST_F(MakePartCommand, SurvivesTheLargestNumbersOfEveryOption) {
    for (const char* at : {"20000,20000", "-20000,20000", "20000,-20000", "4,4"})
        for (const char* angle : {"20000", "-20000", "45"})
            EXPECT_EQ(run({"--out",   "x.pgm",
                           "--size",  "8x8",
                           "--at",    at,
                           "--angle", angle,
                           "--plate", "20000x20000",
                           "--cut",   "20000x20000",
                           "--holes", "20000,20000,20000;-20000,-20000,20000;20000,-20000,0.000001",
                           "--blur",  "20",
                           "--noise", "100",
                           "--seed",  "20000"}),
                      apps::exit_ok);
}

// ---- Refusals ----------------------------------------------------------------------------------

TEST_F(MakePartCommand, AsksForWhatIsMissing) {
    refuses({}, "where to? give --out PICTURE");
    refuses({"--out="}, "where to? give --out PICTURE");
    refuses({"good.png"}, "what is good.png? the picture is named by --out");
    refuses({"--out", "x", "--hole", "1,2,3"}, "unknown option --hole; did you mean --holes?");
    refuses({"--out", "x", "--bright=1"}, "--bright takes no value");
    refuses({"--out", "x", "--angle"}, "--angle needs a value: --angle DEG");
}

TEST_F(MakePartCommand, RefusesValuesThatAreNone) {
    struct Wrong {
        const char* option;
        const char* takes;
        Words values;
    };
    const Wrong all[] = {
        {"size",
         "two sides of 8 to 8191 such as 640x480",
         {"", "640", "640x", "7x480", "640x8192", "640x480x1", "-640x480", "640,480", "640.5x480", "axb"}},
        {"plate", "two lengths such as 360x140", {"", "0x140", "360x-1", "360", "360x140x1", "20000.1x1"}},
        {"cut", "two lengths such as 60x40", {"", "-1x40", "60x-1", "60", "60x20001"}},
        {"holes", "X,Y,R;X,Y,R... or none", {"1,2", "1,2,3;", ";", "1,2,0", "1,2,-3", "1,2,3,4", "None"}},
        {"at", "a place such as 320,240", {"", "320", "320,240,1", "320x240", "20001,0"}},
        {"angle", "degrees such as 17", {"", "17deg", "1e1", "20001", "1 2"}},
        {"blur", "a number from 0 to 20", {"", "-0.1", "20.000001", "x"}},
        {"noise", "a number from 0 to 100", {"", "-1", "100.1", "x"}},
        {"seed", "a whole number from 0 to 20000", {"", "-1", "1.5", "20001", "x"}}};
    for (const Wrong& wrong : all)
        for (const std::string& value : wrong.values)
            refuses({"--out", "x", std::string("--") + wrong.option + "=" + value},
                    std::string("--") + wrong.option + " takes " + wrong.takes + ", not '" + value + "'");
}

TEST_F(MakePartCommand, EndsWithTwoWhenThePictureCannotBeWritten) {
    io.files.refused = "x.png";
    EXPECT_EQ(run({"--out", "x.png", "--size", "60x40"}), apps::exit_failed);
    EXPECT_EQ(io.errors(), "x.png: simulated fault\n");
    EXPECT_EQ(io.out, "");
    EXPECT_EQ(run({"--out", "x.jpeg", "--size", "60x40"}), apps::exit_failed);
    EXPECT_EQ(io.errors(), "x.jpeg: fovea writes PNG, PGM and PPM; name it .png\n");
}

TEST_F(MakePartCommand, ShowsItsHelp) {
    EXPECT_EQ(run({"--help"}), apps::exit_ok);
    EXPECT_EQ(io.out, apps::help_of(apps::make_part_help()));
    EXPECT_TRUE(io.files.files.empty());
    for (const std::string& line : lines_of(io.out)) EXPECT_LE(line.size(), 90u) << line;
}

}  // namespace
}  // namespace fovea::test
