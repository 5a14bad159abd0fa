// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include <gauge/teach_command.hpp>
#include <support/commands.hpp>
#include <support/teaching.hpp>
#include <support/test_io.hpp>

namespace fovea::test {
namespace {

using namespace shapes;
using apps::ExitCode;
using apps::Picture;
using apps::RecipeFile;
using Words = std::vector<std::string>;

class TeachCommand : public ::testing::Test {
protected:
    TeachCommand() {
        io.put("good.pgm", pgm_of(lying(plate(), 12, 701)));
        io.put("other.pgm", pgm_of(lying(plate(), 100, 702)));
        Picture<Gray8> white({50, 40});
        std::fill(white.pixels.begin(), white.pixels.end(), Gray8{200});
        io.put("white.pgm", pgm_of(white));
    }
    ExitCode run(const Words& words) {
        io.hush();
        return apps::teach_command(io, words);
    }
    /// Runs and expects exit code 2 with these complaints, nothing on the standard output, and no new file.
    void refuses(const Words& words, const std::string& complaints) {
        const auto before = io.files.files;
        EXPECT_EQ(run(words), apps::exit_failed);
        EXPECT_EQ(io.errors(), complaints + "\n");
        EXPECT_EQ(io.out, "");
        EXPECT_TRUE(io.files.files == before);
    }
    /// The recipe that the words teach into r.toml.
    Recipe taught_by(Words words) {
        words.insert(words.begin(), {"--out", "r.toml"});
        EXPECT_EQ(run(words), apps::exit_ok) << io.errors();
        const RecipeFile file = apps::read_recipe(io.text("r.toml"));
        EXPECT_EQ(file.problem, "");
        return file.recipe;
    }

    TestIo io;
};

TEST_F(TeachCommand, WritesARecipeThatTheGaugeAcceptsThePicturesWith) {
    EXPECT_EQ(run({"--out", "r.toml", "good.pgm", "other.pgm"}), apps::exit_ok);
    EXPECT_EQ(io.errors(), "");
    const std::vector<std::string> lines = lines_of(io.out);
    ASSERT_EQ(lines.size(), 11u) << io.out;
    EXPECT_EQ(lines[0], "2 good parts, dark on bright, with ends that can be told apart");
    EXPECT_EQ(lines[1].compare(0, 26, "  length              180."), 0) << lines[1];
    EXPECT_EQ(lines[1].substr(28), " px  -0.50 +0.50");
    EXPECT_EQ(lines[5], "  holes               2  -0 +0");
    EXPECT_EQ(lines[10], "wrote r.toml");
    io.hush();
    EXPECT_EQ(apps::gauge_command(io, Words{"--job", "r.toml", "good.pgm", "other.pgm"}), apps::exit_ok)
        << io.out;
}

TEST_F(TeachCommand, WritesTheRecipeAloneToTheStandardOutput) {
    EXPECT_EQ(run({"--out", "r.toml", "good.pgm"}), apps::exit_ok);
    EXPECT_EQ(run({"--out", "-", "good.pgm"}), apps::exit_ok);
    EXPECT_EQ(io.out, "");
    EXPECT_EQ(io.errors(), "");
    EXPECT_EQ(io.text("-"), io.text("r.toml"));
}

TEST_F(TeachCommand, KeepsTheRecipeThatItReplaces) {
    EXPECT_EQ(run({"--out", "r.toml", "good.pgm"}), apps::exit_ok);
    const std::string taught = io.text("r.toml");
    // The same again replaces nothing.
    EXPECT_EQ(run({"--out", "r.toml", "good.pgm"}), apps::exit_ok);
    EXPECT_EQ(io.files.files.count("r.toml~"), 0u);
    io.put("r.toml", "# mine\n" + taught);
    EXPECT_EQ(run({"--out", "r.toml", "good.pgm"}), apps::exit_ok);
    EXPECT_EQ(io.text("r.toml"), taught);
    EXPECT_EQ(io.text("r.toml~"), "# mine\n" + taught);
    EXPECT_EQ(lines_of(io.out).back(), "the recipe before is r.toml~");
}

TEST_F(TeachCommand, NeverWritesOverAPicture) {
    // As a shell makes it of --out *.pgm when the recipe's name is forgotten.
    refuses({"--out", "good.pgm", "other.pgm"},
            "fovea teach: --out would overwrite the picture good.pgm; give the recipe another name");
}

TEST_F(TeachCommand, TeachesFromThePictureOnTheStandardInput) {
    io.put("-", io.text("good.pgm"));
    EXPECT_EQ(run({"--out", "r.toml", "-"}), apps::exit_ok) << io.errors();
}

TEST_F(TeachCommand, WritesTheSameFromTheSamePictures) {
    taught_by({"good.pgm", "other.pgm"});
    const std::string once = io.text("r.toml");
    taught_by({"good.pgm", "other.pgm"});
    EXPECT_EQ(io.text("r.toml"), once);
}

TEST_F(TeachCommand, SaysWhatItFoundOutAboutTheEndsOfThePart) {
    io.put("bar.pgm", pgm_of(lying(rectangle(160, 60), 12, 703, front_light())));
    taught_by({"bar.pgm"});
    EXPECT_EQ(lines_of(io.out)[0], "1 good part, bright on dark, the same when turned by half");
    io.put("disc.pgm", pgm_of(lying(disc(60), 12, 704)));
    taught_by({"disc.pgm"});
    EXPECT_EQ(lines_of(io.out)[0], "1 good part, dark on bright, without a direction");
    io.put("nut.pgm", pgm_of(lying(polygon(6, 60), 12, 706)));
    taught_by({"nut.pgm"});
    EXPECT_EQ(lines_of(io.out)[0], "1 good part, dark on bright, the same in 6 directions");
    EXPECT_NE(io.text("r.toml").find("\nsymmetry_order = 6"), std::string::npos);
}

TEST_F(TeachCommand, DrawsTheProposalIntoTheFirstPicture) {
    EXPECT_EQ(run({"--out", "r.toml", "--explain", "e.ppm", "good.pgm", "other.pgm"}), apps::exit_ok);
    // Small pictures are magnified.
    EXPECT_EQ(io.text("e.ppm").compare(0, 10, "P6\n750 750"), 0) << io.text("e.ppm").substr(0, 20);
}

TEST_F(TeachCommand, PassesNotesOn) {
    io.put("bare.pgm", pgm_of(lying(plate_without_its_small_hole(), 0, 705)));
    EXPECT_EQ(run({"--out", "r.toml", "good.pgm", "bare.pgm", "white.pgm"}), apps::exit_ok);
    EXPECT_EQ(io.errors(),
              "note: white.pgm: no part found: all pixels are alike\n"
              "note: holes are not counted: the good parts have from 1 to 2\n"
              "note: hole_1 is not found on every part\n");
}

// ---- Options -----------------------------------------------------------------------------------

TEST_F(TeachCommand, NamesThePart) {
    EXPECT_EQ(name_text(taught_by({"--name", "bracket \"A\" \xc3\x98 12", "good.pgm"}).name),
              "bracket \"A\" \xc3\x98 12");
    EXPECT_EQ(name_text(taught_by({"good.pgm"}).name), "");
    const std::string wrong = "fovea teach: --name takes 1 to 31 bytes without control characters";
    refuses({"--out", "x", "--name", std::string(32, 'n'), "good.pgm"}, wrong);
    refuses({"--out", "x", "--name", "a\nb", "good.pgm"}, wrong);
    refuses({"--out", "x", "--name=", "good.pgm"}, wrong);
    refuses({"--out", "x", "--name", "\xff", "good.pgm"}, wrong);
}

TEST_F(TeachCommand, TakesTheBrightnessItIsTold) {
    EXPECT_TRUE(taught_by({"--part", "dark", "good.pgm"}).locate.dark_part);
    io.put("bright.pgm", pgm_of(lying(plate(), 12, 706, front_light())));
    EXPECT_FALSE(taught_by({"--part", "bright", "bright.pgm"}).locate.dark_part);
    refuses({"--out", "x", "--part", "grey", "good.pgm"},
            "fovea teach: --part is dark or bright, not 'grey'");
    refuses({"--out", "x", "--part=", "good.pgm"}, "fovea teach: --part is dark or bright, not ''");
    // Bright within the dark plate are its holes, which are round.
    EXPECT_EQ(feature_names(taught_by({"--part", "bright", "good.pgm"}))[0], "diameter");
}

TEST_F(TeachCommand, TakesAScaleAndATolerance) {
    const Recipe given = taught_by({"--mm-per-px", "0.05", "--tolerance", "0.125", "good.pgm"});
    EXPECT_EQ(given.scale.x_per_pixel, 50000);
    EXPECT_EQ(feature_named(given, "length")->tolerance.plus, Decimal{125000});
    EXPECT_EQ(lines_of(io.out)[1], "a pixel is 0.05 mm wide and 0.05 mm high");
    const Recipe known = taught_by({"--known-length", "8.9", "good.pgm"});
    EXPECT_NEAR(static_cast<double>(known.scale.x_per_pixel), 8900000.0 / 180, 20);
    EXPECT_EQ(lines_of(io.out)[2].compare(0, 24, "  length              8."), 0) << io.out;
}

TEST_F(TeachCommand, RefusesScalesAndTolerancesThatAreNone) {
    for (const char* option : {"--known-length", "--mm-per-px", "--tolerance"})
        for (const char* value : {"0", "-1", "1e3", "", "x", "100000.000001", "0.0000001", "5mm", "nan"})
            refuses({"--out", "x", std::string(option) + "=" + value, "good.pgm"},
                    std::string("fovea teach: ") + option +
                        " takes a positive number up to 100000 such as 12.5, not '" + value + "'");
    refuses({"--out", "x", "--mm-per-px", "100.000001", "good.pgm"},
            "fovea teach: --mm-per-px is from 0.00001 to 100");
    refuses({"--out", "x", "--mm-per-px", "0.000009", "good.pgm"},
            "fovea teach: --mm-per-px is from 0.00001 to 100");
    refuses({"--out", "x", "--mm-per-px", "1", "--known-length", "9", "good.pgm"},
            "fovea teach: --known-length and --mm-per-px both give the scale; give one");
    refuses(
        {"--out", "x", "--known-length", "0.0001", "good.pgm"},
        "fovea teach: --known-length gives no scale: a pixel would be below 10 nm or above 100 mm, or four "
        "times as long one way as the other");
}

// ---- Refusals ----------------------------------------------------------------------------------

TEST_F(TeachCommand, AsksForWhatIsMissing) {
    refuses({}, "fovea teach: where to? give --out RECIPE");
    refuses({"good.pgm"}, "fovea teach: where to? give --out RECIPE");
    refuses({"--out", "x"}, "fovea teach: which picture? give at least one GOOD part");
    refuses({"--out"}, "fovea teach: --out needs a value: --out RECIPE");
    refuses({"--ou", "x", "good.pgm"}, "fovea teach: unknown option --ou; did you mean --out?");
}

TEST_F(TeachCommand, ShowsItsHelp) {
    EXPECT_EQ(run({"--out", "x", "-h"}), apps::exit_ok);
    EXPECT_EQ(io.out, apps::help_of(apps::teach_help()));
    EXPECT_FALSE(io.has("x"));
    for (const std::string& line : lines_of(io.out)) EXPECT_LE(line.size(), 100u) << line;
}

TEST_F(TeachCommand, SaysWhyThereIsNoPart) {
    const std::string nothing =
        "fovea teach: no part found: it must lie whole in the picture, on a ground of another brightness";
    refuses({"--out", "x", "white.pgm"}, "note: white.pgm: no part found: all pixels are alike\n" + nothing);
    io.put("cut.pgm",
           pgm_of(picture_of(one_part_size, {{rectangle(180, 70), 60, 120, 5}}, back_light(), 707)));
    refuses(
        {"--out", "x", "cut.pgm"},
        "note: cut.pgm: no part found: nothing in it is large enough and away from its border\n" + nothing);
}

TEST_F(TeachCommand, SaysThatNothingOnThePartCanBeMeasured) {
    // One pixel of ground is too little for any probe.
    Picture<Gray8> tight({80, 40});
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 80; ++x)
            tight.view()(x, y) = x >= 1 && x < 79 && y >= 1 && y < 39 ? Gray8{20} : Gray8{220};
    io.put("tight.pgm", pgm_of(tight));
    EXPECT_EQ(run({"--out", "x", "tight.pgm"}), apps::exit_failed);
    EXPECT_EQ(
        io.complaints.back(),
        "fovea teach: a part was found, but no edge on it can be measured: is it sharp, with 8 pixels of "
        "ground around it?");
    EXPECT_FALSE(io.has("x"));
    EXPECT_EQ(run({"--out", "x", "tight.pgm", "tight.pgm"}), apps::exit_failed);
    EXPECT_EQ(
        io.complaints.back(),
        "fovea teach: 2 parts were found, but no edge can be measured on all of them: are they of one kind, "
        "sharp, with 8 pixels of ground around each?");
}

TEST_F(TeachCommand, ReadsEveryPictureOrNone) {
    io.put("text.png", "hello");
    io.put("empty.png", "");
    refuses({"--out", "x", "good.pgm", "no.pgm"}, "no.pgm: simulated fault");
    refuses({"--out", "x", "good.pgm", "text.png"},
            "text.png: not a picture that fovea reads: PGM, PPM, BMP, PNG or baseline JPEG");
    refuses({"--out", "x", "empty.png"}, "empty.png: the file is empty");
    std::string cut = io.text("good.pgm");
    cut.resize(cut.size() / 2);
    io.put("half.pgm", cut);
    refuses({"--out", "x", "half.pgm"}, "half.pgm: the data end too early (PGM/PPM)");
}

TEST_F(TeachCommand, DoesNotOverwriteWhatItReads) {
    refuses({"--out", "good.pgm", "good.pgm"},
            "fovea teach: --out would overwrite the picture good.pgm; give another name");
    refuses({"--out", "x", "--explain", "other.pgm", "good.pgm", "other.pgm"},
            "fovea teach: --explain would overwrite the picture other.pgm; give another name");
    refuses({"--out", "x", "--explain", "x", "good.pgm"},
            "fovea teach: --explain would overwrite the recipe x; give another name");
    refuses({"--out", "x", "--explain", "-", "good.pgm"},
            "fovea teach: --explain writes a file; give it a name");
}

TEST_F(TeachCommand, EndsWithTwoWhenAFileCannotBeWritten) {
    io.files.refused = "x";
    refuses({"--out", "x", "good.pgm"}, "x: simulated fault");
    EXPECT_EQ(run({"--out", "r.toml", "--explain", "x", "good.pgm"}), apps::exit_failed);
    EXPECT_EQ(io.errors(), "x: simulated fault\n");
    EXPECT_TRUE(io.has("r.toml"));
}

TEST_F(TeachCommand, RefusesANameOfAnotherFormatBeforeItTeaches) {
    refuses({"--out", "new.toml", "--explain", "e.jpg", "good.pgm"},
            "fovea teach: --explain e.jpg: fovea writes PNG, PGM and PPM; name it .png");
    EXPECT_FALSE(io.has("new.toml"));
}

}  // namespace
}  // namespace fovea::test
