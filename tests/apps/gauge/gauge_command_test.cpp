// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include <make_part/part_scene.hpp>
#include <support/parts.hpp>
#include <support/plate_scene.hpp>

#include "gauge_command_fixture.hpp"

namespace fovea::test {
namespace {

TEST_F(GaugeCommand, EndsWithZeroWhenEveryPartIsOk) {
    EXPECT_EQ(run({"--job", "r.toml", "good.pgm"}), apps::exit_ok);
    EXPECT_EQ(io.errors(), "");
    ASSERT_EQ(lines_of(io.out).size(), 1u);
    EXPECT_EQ(io.out.compare(0, 30, "good.pgm part 0: OK  height 70"), 0) << io.out;
    EXPECT_NE(io.out.find(", holes 2  [x 126."), std::string::npos) << io.out;
}

TEST_F(GaugeCommand, EndsWithOneWhenAPartIsNotOk) {
    EXPECT_EQ(run({"--job=r.toml", "good.pgm", "bad.pgm"}), apps::exit_not_ok);
    EXPECT_EQ(io.errors(), "");
    ASSERT_EQ(lines_of(io.out).size(), 2u);
    EXPECT_NE(io.out.find("bad.pgm part 0: NOT OK  holes 0 LOW (least 2), height "), std::string::npos);
}

TEST_F(GaugeCommand, EndsWithTwoWhenSomethingIsNotJudgedWhateverElseIsWrong) {
    EXPECT_EQ(run({"--job", "r.toml", "bad.pgm", "white.pgm", "good.pgm"}), apps::exit_failed);
    EXPECT_EQ(io.errors(), "white.pgm: part and ground cannot be told apart: all pixels are alike\n");
    EXPECT_EQ(lines_of(io.out).size(), 2u);
}

TEST_F(GaugeCommand, AsksForWhatIsMissing) {
    refuses({}, "fovea gauge: which recipe? give --job RECIPE; `fovea teach` makes one");
    refuses({"good.pgm"}, "fovea gauge: which recipe? give --job RECIPE; `fovea teach` makes one");
    refuses({"--job="}, "fovea gauge: which recipe? give --job RECIPE; `fovea teach` makes one");
    refuses({"--job", "r.toml"}, "fovea gauge: which picture? give at least one IMAGE");
    refuses({"--jop", "r.toml", "good.pgm"}, "fovea gauge: unknown option --jop; did you mean --job?");
    refuses({"--job"}, "fovea gauge: --job needs a value: --job RECIPE");
}

TEST_F(GaugeCommand, ShowsItsHelpAndTheKeysOfRecipes) {
    EXPECT_EQ(run({"--help"}), apps::exit_ok);
    EXPECT_EQ(io.out, apps::help_of(apps::gauge_help()));
    EXPECT_EQ(run({"--bogus", "-h"}), apps::exit_ok);
    EXPECT_EQ(run({"--recipe-keys"}), apps::exit_ok);
    EXPECT_EQ(io.out, apps::recipe_help());
    for (const std::string& line : lines_of(apps::help_of(apps::gauge_help())))
        EXPECT_LE(line.size(), 90u) << line;
}

TEST_F(GaugeCommand, SaysWhereTheRecipeIsWrong) {
    io.put("r.toml", recipe + "plsu = 3\n");
    refuses({"--job", "r.toml", "good.pgm"},
            "r.toml:19:1: unknown key plsu in [[feature]]; did you mean plus?");
    refuses({"--job", "no.toml", "good.pgm"}, "no.toml: simulated fault");
    io.put("empty.toml", "");
    refuses({"--job", "empty.toml", "good.pgm"},
            "empty.toml:1:1: the file lacks format: version of this file format, always 1");
}

TEST_F(GaugeCommand, SaysThatAPictureIsNoRecipe) {
    refuses({"--job", "good.pgm", "good.pgm"},
            "good.pgm: a picture, not a recipe; --job takes the file that `fovea teach` wrote");
}

TEST_F(GaugeCommand, GoesOnWithOtherPicturesWhenOneCannotBeRead) {
    io.put("text.png", "hello");
    EXPECT_EQ(run({"--job", "r.toml", "no.pgm", "text.png", "good.pgm"}), apps::exit_failed);
    EXPECT_EQ(io.errors(),
              "no.pgm: simulated fault\n"
              "text.png: not a picture that fovea reads: PGM, PPM, BMP, PNG or baseline JPEG\n");
    EXPECT_EQ(lines_of(io.out).size(), 1u);
}

TEST_F(GaugeCommand, PrintsAnObjectForEveryPartAndForPicturesWithout) {
    const std::vector<Json> objects =
        json_of({"--json", "--job", "r.toml", "good.pgm", "no.pgm", "white.pgm", "bad.pgm"});
    ASSERT_EQ(objects.size(), 4u);
    EXPECT_EQ(objects[0]["image"].text, "good.pgm");
    EXPECT_EQ(objects[0]["verdict"].text, "ok");
    EXPECT_EQ(objects[1]["part"].kind, Json::Kind::null);
    // The image has a key of its own.
    EXPECT_EQ(objects[1]["error"].text, "simulated fault");
    EXPECT_EQ(objects[2]["error"].text, "part and ground cannot be told apart: all pixels are alike");
    EXPECT_EQ(objects[2]["verdict"].text, "unmeasured");
    EXPECT_EQ(objects[3]["verdict"].text, "not_ok");
    EXPECT_EQ(objects[3]["features"].items[1]["verdict"].text, "low");
    // The complaints are the same as for people.
    EXPECT_EQ(io.complaints.size(), 2u);
}

// ---- Parts that are not there -----------------------------------------------------------------

TEST_F(GaugeCommand, TellsWhatIsThereInsteadOfAPart) {
    const auto complaint = [&](const std::string& from, const std::string& to) {
        std::string text = recipe;
        text.replace(text.find(from), from.size(), to);
        io.put("x.toml", text);
        EXPECT_EQ(run({"--job", "x.toml", "good.pgm"}), apps::exit_failed);
        return io.errors();
    };
    const std::string area = (*parse_json([&] {
                                 run({"--json", "--job", "r.toml", "good.pgm"});
                                 return io.out;
                             }()))["area_px"]
                                 .text;
    EXPECT_EQ(
        complaint("area_min = 2000", "area_min = 20000"),
        "good.pgm: no part found: the largest dark region has " + area + " px, and `area_min` is 20000\n");
    EXPECT_EQ(
        complaint("area_min = 2000", "area_max = 2000"),
        "good.pgm: no part found: the largest dark region has " + area + " px, and `area_max` is 2000\n");
    const std::string bright = complaint("area_min = 2000", "area_min = 2000\npart = \"bright\"");
    EXPECT_EQ(bright.compare(0, 53, "good.pgm: no part found: the largest bright region, 2"), 0) << bright;
    EXPECT_NE(bright.find(" px, touches the border; does the part lie whole in the picture, is `part` right, "
                          "is the light even?\n"),
              std::string::npos);
    EXPECT_EQ(
        complaint("area_min = 2000", "threshold = \"fixed\"\nlevel = 1"),
        "good.pgm: part and ground cannot be told apart: all pixels are on one side of the threshold\n");
    EXPECT_EQ(complaint("area_min = 2000", "threshold = \"fixed\"\nlevel = 28\nopening = 63"),
              "good.pgm: no part found: `opening` clears everything that is dark\n");
}

TEST_F(GaugeCommand, MeasuresAPartAtTheBorderOnlyIfTheRecipeSaysSo) {
    apps::PartScene cut = scene();
    cut.middle.x = FinePixel::from_int(85);
    io.put("cut.pgm", pgm_of(render(cut)));
    EXPECT_EQ(run({"--job", "r.toml", "cut.pgm"}), apps::exit_failed);
    EXPECT_NE(io.errors().find("touches the border"), std::string::npos) << io.errors();
    std::string text = recipe;
    text.insert(text.find("area_min"), "at_border = true\n");
    io.put("x.toml", text);
    EXPECT_EQ(run({"--job", "x.toml", "cut.pgm"}), apps::exit_ok) << io.errors();
}

// ---- Features without a value ------------------------------------------------------------------

TEST_F(GaugeCommand, SaysWhereTheRecipeAsksForAProbeOutsideThePicture) {
    std::string text = recipe;
    text.replace(text.find("from = [0, -60]"), 15, "from = [0, -90]");
    io.put("x.toml", text);
    EXPECT_EQ(run({"--job", "x.toml", "good.pgm"}), apps::exit_failed);
    EXPECT_EQ(io.errors(), "x.toml:5:3: height: the probe leaves the image (good.pgm part 0)\n");
    EXPECT_EQ(io.out.compare(0, 60, "good.pgm part 0: NOT JUDGED  height NOT MEASURED, holes 2  ["), 0)
        << io.out;
    const std::vector<Json> objects = json_of({"--json", "--job", "x.toml", "good.pgm"});
    EXPECT_EQ(objects.at(0)["features"].items.at(0)["reason"].text, "the probe leaves the image");
    EXPECT_EQ(objects.at(0)["verdict"].text, "unmeasured");
}

TEST_F(GaugeCommand, SaysEachFeatureThatHasNoValueAndWhy) {
    io.put(
        "x.toml",
        recipe +
            "[[feature]]\nname = \"w\"\nkind = \"width\"\nfrom = [0, -60]\nto = [0, -50]\n"
            "nominal = 1\nminus = 0\nplus = 0\n"
            "[[feature]]\nname = \"d\"\nkind = \"distance\"\nfrom = [0, -60]\nto = [0, 60]\nfirst_edge = 3\n"
            "nominal = 1\nminus = 0\nplus = 0\n"
            "[[feature]]\nname = \"h\"\nkind = \"hole_diameter\"\ncentre = [0, 0]\nsearch = 2\n"
            "nominal = 1\nminus = 0\nplus = 0\n"
            "[[feature]]\nname = \"p\"\nkind = \"position\"\ncentre = [0, 0]\nsearch = 2\n"
            "nominal = 1\nminus = 0\nplus = 0\n"
            "[[feature]]\nname = \"c\"\nkind = \"diameter\"\ncentre = [0, 0]\nradius = 10\nsearch = 3\n"
            "nominal = 1\nminus = 0\nplus = 0\n"
            "[[feature]]\nname = \"a\"\nkind = \"angle\"\nfrom = [-9, 0]\nto = [9, 0]\nsecond_from = [0, "
            "-9]\n"
            "second_to = [0, 9]\nsearch = 3\nnominal = 1\nminus = 0\nplus = 0\n"
            "[[feature]]\nname = \"s\"\nkind = \"width\"\nfrom = [0, 0]\nto = [0.5, 0]\n"
            "nominal = 1\nminus = 0\nplus = 0\n");
    EXPECT_EQ(run({"--job", "x.toml", "good.pgm"}), apps::exit_failed);
    EXPECT_EQ(
        io.errors(),
        "x.toml:19:3: w: no edge strong enough along the probe: is it out of focus, or does it not cross "
        "the part? (good.pgm part 0)\n"
        "x.toml:27:3: d: fewer edges than asked for along the probe (good.pgm part 0)\n"
        "x.toml:36:3: h: no round hole within `search` of `centre` (good.pgm part 0)\n"
        "x.toml:44:3: p: no hole within `search` of `centre` (good.pgm part 0)\n"
        "x.toml:52:3: c: less than half of the probes agree on an edge (good.pgm part 0)\n"
        "x.toml:61:3: a: less than half of the probes agree on an edge (good.pgm part 0)\n"
        "x.toml:72:3: s: the probe is shorter than a pixel (good.pgm part 0)\n");
}

TEST_F(GaugeCommand, AsksOfAVeryBlurredPictureWhetherItIsOutOfFocus) {
    apps::PartScene blurred = scene();
    blurred.blur = 12000000;
    io.put("blurred.pgm", pgm_of(render(blurred)));
    EXPECT_NE(run({"--job", "r.toml", "blurred.pgm"}), apps::exit_ok);
    EXPECT_NE(
        io.errors().find("r.toml:5:3: height: no edge strong enough along the probe: is it out of focus"),
        std::string::npos)
        << io.errors();
}

TEST_F(GaugeCommand, SaysOnceThatThePartHasNoDirectionAndWhatToDo) {
    std::string text = recipe;
    text.replace(text.find("\"symmetric\""), 11, "\"full\"\nends = [0, 0, 0, 0.5]");
    io.put("x.toml", text);
    EXPECT_EQ(run({"--job", "x.toml", "good.pgm"}), apps::exit_failed);
    EXPECT_EQ(
        io.errors(),
        "good.pgm part 0: which end of the part is which is undecided; it may be damaged, dirty, turned "
        "over or another part; if the ends of all parts are alike, orientation = \"symmetric\" measures "
        "it\n");
    EXPECT_EQ(io.out.find("good.pgm part 0: NOT JUDGED (ends undecided)  holes 2  ["), 0u) << io.out;
    io.put("disc.pgm", pgm_of(picture_of({160, 120}, {{shapes::disc(40), 80, 60}}, {}, 5)));
    EXPECT_EQ(run({"--job", "r.toml", "disc.pgm"}), apps::exit_not_ok);
    EXPECT_EQ(io.errors(),
              "disc.pgm part 0: the part has no clear axis; orientation = \"none\" measures it as it lies, "
              "\"rotational\" by its symmetry\n");
    // Holes can be counted however it lies.
    EXPECT_EQ(io.out.find("disc.pgm part 0: NOT OK (no clear axis)  holes 0 LOW (least 2)  ["), 0u) << io.out;
}

// ---- Several parts and pictures ----------------------------------------------------------------

TEST_F(GaugeCommand, MeasuresEveryPartOfAPictureInTheOrderOfItsRows) {
    using namespace shapes;
    Scene light;
    light.noise = 2;
    io.put("four.pgm", pgm_of(picture_of({460, 320},
                                         {{plate(), 340, 90, 3},
                                          {plate(), 115, 80, -5},
                                          {without(rectangle(180, 70), disc(15), 50, 0), 115, 230, 4},
                                          {plate(), 340, 230, 180}},
                                         light, 6)));
    const std::vector<Json> objects = json_of({"--json", "--job", "r.toml", "four.pgm"});
    ASSERT_EQ(objects.size(), 4u);
    std::vector<std::string> verdicts;
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(objects[i]["part"].text, std::to_string(i));
        verdicts.push_back(objects[i]["verdict"].text);
    }
    EXPECT_EQ(verdicts, (std::vector<std::string>{"ok", "ok", "not_ok", "ok"}));
    EXPECT_NEAR(objects[0]["x"].number(), 115, 5);
    EXPECT_NEAR(objects[1]["x"].number(), 340, 5);
    EXPECT_EQ(run({"--job", "r.toml", "four.pgm"}), apps::exit_not_ok);
}

TEST_F(GaugeCommand, DoesNotCallAPictureOkThatHasMorePartsThanItCanMeasure) {
    // 17 x 17 rectangles of 12 x 6 px, each of them good.
    Picture<Gray8> picture({300, 200});
    std::fill(picture.pixels.begin(), picture.pixels.end(), Gray8{200});
    for (int i = 0; i < 17 * 17; ++i)
        for (int y = 0; y < 6; ++y)
            for (int x = 0; x < 12; ++x) picture.view()(4 + i % 17 * 17 + x, 4 + i / 17 * 11 + y) = 20;
    io.put("many.pgm", pgm_of(picture));
    io.put("x.toml",
           "format = 1\n[locate]\narea_min = 50\norientation = \"symmetric\"\n[[feature]]\nname = "
           "\"n\"\nkind = \"hole_count\"\n"
           "nominal = 0\nminus = 0\nplus = 0\n");
    EXPECT_EQ(run({"--job", "x.toml", "many.pgm"}), apps::exit_failed);
    EXPECT_EQ(io.errors(), "many.pgm: more than 256 parts; the largest are measured\n");
    EXPECT_EQ(lines_of(io.out).size(), 256u);
}

TEST_F(GaugeCommand, DoesNotCallAPictureOkThatHasMoreHolesThanItCanHold) {
    // A sieve of 100 x 60 holes, 3 x 3 px each: more than 256 * 16.
    Picture<Gray8> picture({620, 380});
    std::fill(picture.pixels.begin(), picture.pixels.end(), Gray8{200});
    for (int y = 5; y < 375; ++y)
        for (int x = 5; x < 615; ++x)
            picture.view()(x, y) =
                (x - 8) % 6 < 3 && x >= 8 && x < 608 && (y - 8) % 6 < 3 && y >= 8 && y < 368 ? 200 : 20;
    io.put("sieve.pgm", pgm_of(picture));
    io.put("x.toml",
           "format = 1\n[locate]\nhole_area_min = 4\norientation = \"symmetric\"\n[[feature]]\nname = "
           "\"n\"\nkind = "
           "\"hole_count\"\nnominal = 6000\nminus = 0\nplus = 0\n");
    EXPECT_EQ(run({"--job", "x.toml", "sieve.pgm"}), apps::exit_failed);
    EXPECT_EQ(io.errors(), "sieve.pgm: more holes than there is room for; raise `hole_area_min`\n");
    EXPECT_NE(io.out.find("holes") == std::string::npos ? io.out.find("n 6000") : 0, std::string::npos)
        << io.out;
}

}  // namespace
}  // namespace fovea::test
