// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <core/codec/jpeg_file.hpp>
#include <fovea/codec/bmp.hpp>
#include <fovea/codec/png_writer.hpp>
#include <fovea/codec/pnm.hpp>
#include <gauge/gauge_command.hpp>
#include <make_part/part_scene.hpp>
#include <support/json.hpp>
#include <support/parts.hpp>
#include <support/plate_scene.hpp>
#include <support/test_io.hpp>

namespace fovea::test {
namespace {

using apps::ExitCode;
using apps::gauge_command;
using apps::Picture;
using Words = std::vector<std::string>;

/// A plate that lies aslant in 260 x 160.
apps::PartScene scene() {
    apps::PartScene scene = small_plate({260, 160});
    scene.angle = FineAngle::from_microdegrees(9000000);
    scene.noise = 2000000;
    return scene;
}

/// Measures the plate: its length, where the hole count stands in line 12.
const std::string recipe =
    "format = 1\n"
    "[locate]\n"
    "area_min = 2000\n"
    "orientation = \"symmetric\"\n"
    "[[feature]]\n"
    "name = \"height\"\n"
    "kind = \"width\"\n"
    "from = [0, -60]\n"
    "to = [0, 60]\n"
    "nominal = 70\nminus = 0.5\nplus = 0.5\n"
    "[[feature]]\n"
    "name = \"holes\"\n"
    "kind = \"hole_count\"\n"
    "nominal = 2\nminus = 0\nplus = 0\n";

/// A JPEG file of the finest steps, which changes grey levels by rounding alone.
std::vector<std::uint8_t> jpeg_of(const Picture<Gray8>& picture) {
    JpegFile file;
    file.quantiser(0, 1).frame(picture.size, 1).scan(1);
    int previous = 0;
    for (int top = 0; top < picture.size.height; top += 8)
        for (int left = 0; left < picture.size.width; left += 8) {
            std::vector<double> samples;
            for (int i = 0; i < 64; ++i)
                samples.push_back(picture.view()(std::min(left + i % 8, picture.size.width - 1),
                                                 std::min(top + i / 8, picture.size.height - 1)) -
                                  128.0);
            const std::vector<double> coefficients = naive_forward(samples);
            Coefficients quantised(64);
            for (std::size_t k = 0; k < 64; ++k)
                quantised[k] = static_cast<int>(std::lround(coefficients[jpeg::zigzag[k]]));
            file.block(quantised, previous, 0);
            previous = quantised[0];
        }
    file.pad().marker(0xd9);
    return file.bytes;
}

class GaugeCommand : public ::testing::Test {
protected:
    GaugeCommand() {
        io.put("r.toml", recipe);
        io.put("good.pgm", pgm_of(render(scene())));
        apps::PartScene other = scene();
        other.holes.clear();
        io.put("bad.pgm", pgm_of(render(other)));
        Picture<Gray8> white({50, 40});
        std::fill(white.pixels.begin(), white.pixels.end(), Gray8{200});
        io.put("white.pgm", pgm_of(white));
    }
    ExitCode run(const Words& words) {
        io.hush();
        return gauge_command(io, words);
    }
    /// Runs and expects exit code 2 with one line of complaint and nothing else.
    void refuses(const Words& words, const std::string& complaint) {
        EXPECT_EQ(run(words), apps::exit_failed);
        EXPECT_EQ(io.errors(), complaint + "\n");
        EXPECT_EQ(io.out, "");
    }
    std::vector<Json> json_of(const Words& words) {
        run(words);
        std::vector<Json> objects;
        for (const std::string& line : lines_of(io.out)) {
            const auto json = parse_json(line);
            EXPECT_TRUE(json.has_value()) << line;
            objects.push_back(json.value_or(Json()));
        }
        return objects;
    }

    TestIo io;
};

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
    EXPECT_EQ(io.errors(),
              "good.pgm part 0: which end of the part is which is undecided; it may be dirty, turned over or "
              "another part, or "
              "orientation = \"symmetric\" suits it\n");
    EXPECT_EQ(io.out.compare(0, 45, "good.pgm part 0: NOT JUDGED (ends undecided) "), 0);
    io.put("disc.pgm", pgm_of(picture_of({160, 120}, {{shapes::disc(40), 80, 60}}, {}, 5)));
    EXPECT_EQ(run({"--job", "r.toml", "disc.pgm"}), apps::exit_failed);
    EXPECT_EQ(io.errors(),
              "disc.pgm part 0: the part has no clear axis; orientation = \"none\" measures it as it lies, "
              "\"rotational\" by its symmetry\n");
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

TEST_F(GaugeCommand, WritesTheAnnotatedPicture) {
    EXPECT_EQ(run({"--job", "r.toml", "--explain", "out.png", "good.pgm"}), apps::exit_ok);
    EXPECT_EQ(io.text("out.png").compare(0, 4, "\x89PNG"), 0);
    EXPECT_EQ(run({"--job", "r.toml", "--explain", "out.ppm", "good.pgm"}), apps::exit_ok);
    EXPECT_EQ(io.text("out.ppm").compare(0, 2, "P6"), 0);
}

TEST_F(GaugeCommand, NumbersTheAnnotatedPicturesOfSeveralImages) {
    EXPECT_EQ(run({"--job", "r.toml", "--explain", "a.b/out.png", "good.pgm", "bad.pgm", "white.pgm"}),
              apps::exit_failed);
    EXPECT_TRUE(io.has("a.b/out-0.png") && io.has("a.b/out-1.png") && io.has("a.b/out-2.png"));
    EXPECT_FALSE(io.has("a.b/out.png"));
    run({"--job", "r.toml", "--explain", "a.b/out", "good.pgm", "bad.pgm"});
    EXPECT_TRUE(io.has("a.b/out-0") && io.has("a.b/out-1"));
    run({"--job", "r.toml", "--explain", ".hidden", "good.pgm", "bad.pgm"});
    EXPECT_TRUE(io.has(".hidden-1"));
    run({"--job", "r.toml", "--explain", "x/.hidden", "good.pgm", "bad.pgm"});
    EXPECT_TRUE(io.has("x/.hidden-1"));
}

TEST_F(GaugeCommand, WritesNoAnnotatedPictureOfWhatItCouldNotRead) {
    std::string cut = io.text("good.pgm");
    cut.resize(cut.size() / 2);
    io.put("cut.pgm", cut);
    EXPECT_EQ(run({"--job", "r.toml", "--explain", "out.png", "cut.pgm"}), apps::exit_failed);
    EXPECT_EQ(io.errors(), "cut.pgm: the data end too early (PGM/PPM)\n");
    EXPECT_FALSE(io.has("out.png"));
}

TEST_F(GaugeCommand, DoesNotOverwriteWhatItReads) {
    refuses({"--job", "r.toml", "--explain", "good.pgm", "good.pgm"},
            "fovea gauge: --explain would overwrite good.pgm; give another name");
    refuses({"--job", "r.toml", "--explain", "r.toml", "good.pgm"},
            "fovea gauge: --explain would overwrite r.toml; give another name");
    io.put("x-1.pgm", io.text("good.pgm"));
    refuses({"--job", "r.toml", "--explain", "x.pgm", "good.pgm", "x-1.pgm"},
            "fovea gauge: --explain would overwrite x-1.pgm; give another name");
    refuses({"--job", "r.toml", "--explain", "-", "good.pgm"},
            "fovea gauge: --explain writes a file; the standard output has the results");
}

TEST_F(GaugeCommand, EndsWithTwoWhenTheAnnotatedPictureCannotBeWritten) {
    io.files.refused = "out.png";
    EXPECT_EQ(run({"--job", "r.toml", "--explain", "out.png", "good.pgm"}), apps::exit_failed);
    EXPECT_EQ(io.errors(), "out.png: simulated fault\n");
    EXPECT_EQ(lines_of(io.out).size(), 1u);
}

TEST_F(GaugeCommand, RefusesANameOfAnotherFormatBeforeItMeasures) {
    refuses({"--job", "r.toml", "--explain", "out.jpg", "good.pgm"},
            "fovea gauge: --explain out.jpg: fovea writes PNG, PGM and PPM; name it .png");
    refuses({"--job", "r.toml", "--explain", "nodir/x.TIFF", "good.pgm", "bad.pgm"},
            "fovea gauge: --explain nodir/x.TIFF: fovea writes PNG, PGM and PPM; name it .png");
}

// ---- Formats -----------------------------------------------------------------------------------

TEST_F(GaugeCommand, MeasuresTheSameInEveryLosslessFormatAndFromTheStandardInput) {
    const Picture<Gray8> gray = render(scene());
    Picture<Rgb888> colour(gray.size);
    for (std::size_t i = 0; i < gray.pixels.size(); ++i)
        colour.pixels[i] = {gray.pixels[i], gray.pixels[i], gray.pixels[i]};
    const auto put = [&](const char* name, std::int64_t room, auto encode) {
        std::vector<std::uint8_t> bytes(static_cast<std::size_t>(room));
        const Result<std::ptrdiff_t> length =
            encode(Span<std::uint8_t>(bytes.data(), static_cast<std::ptrdiff_t>(room)));
        ASSERT_TRUE(length.ok()) << name;
        bytes.resize(static_cast<std::size_t>(*length));
        io.put(name, bytes);
    };
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(png_writer_scratch(gray.size)));
    const Span<std::uint8_t> room(scratch.data(), static_cast<std::ptrdiff_t>(scratch.size()));
    put("a.pgm", encoded_pnm_bytes<Gray8>(gray.size), [&](auto out) { return encode_pnm(gray.view(), out); });
    put("-", encoded_pnm_bytes<Rgb888>(gray.size), [&](auto out) { return encode_pnm(colour.view(), out); });
    put("a.ppm", encoded_pnm_bytes<Rgb888>(gray.size),
        [&](auto out) { return encode_pnm(colour.view(), out); });
    put("gray.bmp", encoded_bmp_bytes<Gray8>(gray.size),
        [&](auto out) { return encode_bmp(gray.view(), out); });
    put("colour.bmp", encoded_bmp_bytes<Rgb888>(gray.size),
        [&](auto out) { return encode_bmp(colour.view(), out); });
    put("gray.png", encoded_png_bytes<Gray8>(gray.size),
        [&](auto out) { return encode_png(gray.view(), room, out); });
    put("colour.png", encoded_png_bytes<Rgb888>(gray.size),
        [&](auto out) { return encode_png(colour.view(), room, out); });
    std::string first;
    for (const char* name : {"a.pgm", "-", "a.ppm", "gray.bmp", "colour.bmp", "gray.png", "colour.png"}) {
        ASSERT_EQ(run({"--json", "--job", "r.toml", name}), apps::exit_ok) << name << io.errors();
        std::string line = io.out;
        line.erase(0, line.find(",\"part\""));
        if (first.empty()) first = line;
        EXPECT_EQ(line, first) << name;
    }
}

TEST_F(GaugeCommand, MeasuresAJpegPictureToAHundredthOfAPixelTheSame) {
    io.put("good.jpg", jpeg_of(render(scene())));
    const std::vector<Json> objects = json_of({"--json", "--job", "r.toml", "good.pgm", "good.jpg"});
    ASSERT_EQ(objects.size(), 2u) << io.errors();
    EXPECT_EQ(objects[1]["verdict"].text, "ok");
    EXPECT_NEAR(objects[1]["x"].number(), objects[0]["x"].number(), 0.01);
    EXPECT_NEAR(objects[1]["y"].number(), objects[0]["y"].number(), 0.01);
    EXPECT_NEAR(objects[1]["features"].items[0]["value"].number(),
                objects[0]["features"].items[0]["value"].number(), 0.02);
}

TEST_F(GaugeCommand, ReadsTheRecipeFromTheStandardInput) {
    io.put("-", recipe);
    EXPECT_EQ(run({"--job", "-", "good.pgm"}), apps::exit_ok) << io.errors();
}

TEST_F(GaugeCommand, MeasuresInMillimetres) {
    std::string text = recipe;
    text.insert(text.find("[locate]"), "[scale]\nunit = \"mm\"\nper_pixel_x = 0.1\nper_pixel_y = 0.1\n");
    for (const auto& [from, to] :
         {std::pair("[0, -60]", "[0, -6]"), std::pair("[0, 60]", "[0, 6]"),
          std::pair("nominal = 70\nminus = 0.5\nplus = 0.5", "nominal = 7\nminus = 0.05\nplus = 0.05")})
        text.replace(text.find(from), std::string(from).size(), to);
    io.put("x.toml", text);
    EXPECT_EQ(run({"--job", "x.toml", "good.pgm"}), apps::exit_ok) << io.out << io.errors();
    const std::vector<Json> objects = json_of({"--json", "--job", "x.toml", "good.pgm"});
    EXPECT_EQ(objects.at(0)["features"].items.at(0)["unit"].text, "mm");
    EXPECT_NEAR(objects.at(0)["features"].items.at(0)["value"].number(), 7, 0.01);
}

TEST_F(GaugeCommand, SurvivesPicturesThatAreDamagedAnywhere) {
    // Small enough for many rounds; what is read is gauged, what is not is said, and nothing is OK by
    // accident of a crash.
    apps::PartScene small = scene();
    small.size = {96, 64};
    small.length = FinePixel::from_int(60);
    small.height = FinePixel::from_int(24);
    small.cut_x = small.cut_y = FinePixel::from_int(8);
    small.holes.resize(1);
    small.holes[0] = {FinePixel::from_int(15), FinePixel(), FinePixel::from_int(5)};
    small.middle = {FinePixel::from_int(48), FinePixel::from_int(32)};
    const Picture<Gray8> picture = render(small);
    std::string problem;
    ASSERT_TRUE(save_picture(io.storage(), "s.png", picture, problem));
    ASSERT_TRUE(save_picture(io.storage(), "s.pgm", picture, problem));
    std::vector<std::uint8_t> bmp(static_cast<std::size_t>(encoded_bmp_bytes<Gray8>(picture.size)));
    ASSERT_TRUE(encode_bmp(picture.view(), {bmp.data(), static_cast<std::ptrdiff_t>(bmp.size())}).ok());
    io.put("s.bmp", bmp);
    io.put("s.jpg", jpeg_of(picture));
    Random random(301);
    for (const char* name : {"s.png", "s.pgm", "s.bmp", "s.jpg"}) {
        const std::string whole = io.text(name);
        for (int i = 0; i < 60; ++i) {
            std::string damaged = whole;
            for (int k = random.between(1, 4); k > 0; --k) {
                const std::size_t at =
                    random.below(static_cast<std::uint32_t>(random.below(2) == 0 ? 60 : whole.size()));
                damaged[std::min(at, whole.size() - 1)] = static_cast<char>(random.below(256));
            }
            if (i % 4 == 0) damaged.resize(random.below(static_cast<std::uint32_t>(whole.size())));
            io.put("d", damaged);
            const ExitCode code = run({"--json", "--job", "r.toml", "d"});
            ASSERT_TRUE(code == apps::exit_ok || code == apps::exit_not_ok || !io.complaints.empty());
            for (const std::string& line : lines_of(io.out))
                ASSERT_TRUE(parse_json(line).has_value()) << line;
        }
    }
}

}  // namespace
}  // namespace fovea::test
