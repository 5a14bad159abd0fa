// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <camera/load_camera.hpp>
#include <support/command_calibrate.hpp>
#include <support/json.hpp>
#include <support/picture.hpp>
#include <support/test_io.hpp>

#include "board_pictures.hpp"

namespace fovea::test {
namespace {

using apps::CameraFile;
using apps::ExitCode;
using apps::Picture;
using Words = std::vector<std::string>;

/// left0.pgm ... and right0.pgm ...: ten places by the left camera, and by one 15 mm to its right.
const TestIo& pictures() {
    static const TestIo all = [] {
        TestIo io;
        for (std::size_t i = 0; i < good_places().size(); ++i) {
            BoardPlace place = good_places()[i];
            put_picture(io, "left" + std::to_string(i) + ".pgm", render_board({}, place));
            place.x -= 15;
            put_picture(io, "right" + std::to_string(i) + ".pgm", render_board({}, place));
        }
        return io;
    }();
    return all;
}

Words operator+(Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

class CalibrateCommand : public ::testing::Test {
protected:
    CalibrateCommand() {
        for (std::size_t i = 0; i < good_places().size(); ++i) {
            left.push_back("left" + std::to_string(i) + ".pgm");
            right.push_back("right" + std::to_string(i) + ".pgm");
        }
    }
    ExitCode run(const Words& words) {
        io.hush();
        return apps::calibrate_command(io, words);
    }
    /// Runs and expects exit code 2 with one line of complaint and nothing else.
    void refuses(const Words& words, const std::string& complaint) {
        EXPECT_EQ(run(words), apps::exit_failed);
        EXPECT_EQ(io.errors(), "fovea calibrate: " + complaint + "\n");
        EXPECT_EQ(io.out, "");
    }
    /// The last complaint, where others tell of each picture.
    std::string last_complaint() const { return io.complaints.empty() ? "" : io.complaints.back(); }
    /// The lines of JSON that the words print.
    std::vector<Json> json_of(const Words& words, ExitCode expected = apps::exit_ok) {
        EXPECT_EQ(run(words + Words{"--json"}), expected) << io.errors();
        std::vector<Json> objects;
        for (const std::string& line : lines_of(io.out)) {
            const auto json = parse_json(line);
            EXPECT_TRUE(json.has_value()) << line;
            objects.push_back(json.value_or(Json()));
        }
        if (objects.empty()) objects.emplace_back();
        return objects;
    }
    static bool warns(const Json& result, const std::string& code) {
        const std::vector<Json>& all = result["warnings"].items;
        return std::any_of(all.begin(), all.end(),
                           [&](const Json& warning) { return warning["code"].text == code; });
    }
    /// The first so many pictures.
    Words some(std::size_t count) const {
        return Words(left.begin(), left.begin() + static_cast<std::ptrdiff_t>(count));
    }

    TestIo io = pictures();
    Words left, right;
    const Words board = {"--board", "7x6", "--square", "12"};
};

TEST_F(CalibrateCommand, FindsTheCameraThatRenderedThePictures) {
    const std::vector<Json> lines = json_of(board + left);
    ASSERT_EQ(lines.size(), 11u);
    for (std::size_t i = 0; i < 10; ++i) {
        EXPECT_EQ(lines[i]["image"].text, left[i]);
        EXPECT_EQ(lines[i]["used"].text, "true");
        EXPECT_EQ(lines[i]["corners"].text, "42");
        EXPECT_LT(lines[i]["residual_px"].number(), 0.2);
        EXPECT_GT(lines[i]["worst_px"].number(), lines[i]["residual_px"].number());
        EXPECT_LT(lines[i]["worst_px"].number(), 0.5);
    }
    // The first board faces the camera 190 mm away; its middle is nearly where the camera looks.
    EXPECT_LT(lines[0]["tilt_deg"].number(), 1);
    EXPECT_NEAR(lines[0]["distance_mm"].number(), 190, 1.5);
    EXPECT_NEAR(lines[5]["tilt_deg"].number(), 36, 1);
    const Json& result = lines.back();
    EXPECT_LT(result["rms_px"].number(), 0.15);
    EXPECT_EQ(result["views_used"].text, "10");
    EXPECT_EQ(result["warnings"].items.size(), 0u);
    EXPECT_EQ(result["doubtful"].text, "false");
    const Pinhole truth;
    const struct {
        const char* name;
        double value;
    } terms[] = {{"fx", truth.fx}, {"fy", truth.fy}, {"cx", truth.cx}, {"cy", truth.cy},
                 {"k1", 0},        {"k2", 0},        {"p1", 0},        {"p2", 0}};
    for (const auto& term : terms) {
        const double deviation = result["deviations"][term.name].number();
        EXPECT_GT(deviation, 0);
        // Five standard deviations: one run in a million is outside, were the errors of corners random.
        EXPECT_LT(std::abs(result["camera"][term.name].number() - term.value), 5 * deviation) << term.name;
    }
    EXPECT_EQ(result["camera"]["k3"].text, "0");
    // 320 px at 320 px focal length see 53.13 degrees.
    EXPECT_NEAR(result["field_of_view_deg"].items[0].number(), 53.13, 0.5);
}

TEST_F(CalibrateCommand, TellsPeopleWhatItFoundAndHowSureItIs) {
    EXPECT_EQ(run(board + left), apps::exit_ok);
    ASSERT_EQ(io.complaints.size(), 10u);
    EXPECT_EQ(io.complaints[3], "left3.pgm: 42 corners");
    const std::vector<std::string> lines = lines_of(io.out);
    ASSERT_EQ(lines.size(), 25u) << io.out;
    EXPECT_EQ(lines[0], "camera of 320x240 px, from 10 of 10 views with 420 corners");
    EXPECT_EQ(lines[1].compare(0, 7, "  fx  3"), 0) << lines[1];
    EXPECT_NE(lines[1].find(" +- "), std::string::npos);
    EXPECT_EQ(lines[9].compare(0, 8, "  sees 5"), 0) << lines[9];
    EXPECT_EQ(lines[13].compare(0, 11, "  left0.pgm"), 0) << lines[13];
    EXPECT_EQ(lines[24], "good: nothing speaks against this calibration");
}

TEST_F(CalibrateCommand, WritesWhatItFoundInEveryFormat) {
    const Json result = json_of(board + left + Words{"-o", "camera.toml"}).back();
    const CameraFile file = apps::read_camera(io.text("camera.toml"));
    ASSERT_EQ(file.problem, "");
    ASSERT_EQ(file.cameras.size(), 1u);
    EXPECT_EQ(file.cameras[0].size, (Size{320, 240}));
    EXPECT_EQ(apps::json_number(file.cameras[0].camera.fx), result["camera"]["fx"].text);
    EXPECT_EQ(apps::json_number(*file.cameras[0].rms_px), result["rms_px"].text);
    ASSERT_TRUE(file.cameras[0].deviations.has_value());
    EXPECT_EQ(apps::json_rough(file.cameras[0].deviations->cx), result["deviations"]["cx"].text);

    for (const Words& words : {Words{"--out", "camera.yml"}, Words{"-o", "camera.txt"},
                               Words{"-o", "camera.bin"}, Words{"-o", "c", "--format", "opencv"}}) {
        EXPECT_EQ(run(board + left + words), apps::exit_ok) << io.errors();
        EXPECT_NE(io.out.find("\nwrote " + words[1] + "\n"), std::string::npos);
        const CameraFile other = apps::read_camera(io.text(words[1]));
        EXPECT_EQ(other.problem, "");
        EXPECT_NE(other.format, apps::CameraFormat::toml);
        ASSERT_EQ(other.cameras.size(), 1u);
        EXPECT_EQ(other.cameras[0].camera.fx.rounded(20), file.cameras[0].camera.fx.rounded(20));
    }
    EXPECT_EQ(run(board + left + Words{"-o", "-"}), apps::exit_ok);
    EXPECT_EQ(io.out, "");
    EXPECT_EQ(io.text("-"), io.text("camera.toml"));
    for (const char* const option : {"--out", "--coverage", "--explain"}) {
        io.files.refused = option == std::string("--explain") ? "full-0.png" : "full.png";
        EXPECT_EQ(run(board + left + Words{option, "full.png"}), apps::exit_failed);
        EXPECT_NE(io.errors().find(io.files.refused + ": simulated fault\n"), std::string::npos) << option;
        EXPECT_EQ(io.out.find("wrote"), std::string::npos);
    }
}

TEST_F(CalibrateCommand, EstimatesNoMoreThanIsAskedFor) {
    const Json held =
        json_of(board + left + Words{"--lens", "none", "--fixed-centre", "--fixed-aspect"}).back();
    EXPECT_EQ(held["camera"]["cx"].number(), 159.5);
    EXPECT_EQ(held["camera"]["cy"].number(), 119.5);
    EXPECT_EQ(held["camera"]["fx"].text, held["camera"]["fy"].text);
    EXPECT_EQ(held["camera"]["k1"].text, "0");
    EXPECT_EQ(held["deviations"]["cx"].text, "0");
    const Json more = json_of(board + left + Words{"--lens", "k1k2k3p1p2"}).back();
    EXPECT_NE(more["camera"]["k3"].text, "0");
    EXPECT_LE(more["rms_px"].number(), held["rms_px"].number());
}

TEST_F(CalibrateCommand, PassesOverPicturesWithoutABoardWhateverTheirSize) {
    Picture<Gray8> wall({200, 100});
    std::fill(wall.pixels.begin(), wall.pixels.end(), Gray8{90});
    put_picture(io, "left.png", wall);
    const std::vector<Json> lines = json_of(board + left + Words{"left.png"});
    ASSERT_EQ(lines.size(), 12u);
    EXPECT_EQ(lines[10]["found"].text, "false");
    EXPECT_EQ(lines[10]["reason"].text, "no board of 7x6 corners");
    EXPECT_EQ(lines[11]["views"].text, "11");
    EXPECT_EQ(lines[11]["views_used"].text, "10");
    EXPECT_EQ(last_complaint(), "left.png: no board of 7x6 corners");
}

TEST_F(CalibrateCommand, RefusesPicturesOfSeveralSizes) {
    Pinhole small;
    small.picture = {300, 240};
    put_picture(io, "small.pgm", render_board(small, good_places()[5]));
    EXPECT_EQ(run(board + left + Words{"small.pgm"}), apps::exit_failed);
    EXPECT_EQ(
        last_complaint(),
        "fovea calibrate: small.pgm has 300x240 px, left0.pgm 320x240; all pictures are of one camera at one "
        "resolution");
    small.picture = {240, 320};
    put_picture(io, "small.pgm", render_board(small, {-20, 0, 210, 20, 0, 90}));
    EXPECT_EQ(run(board + left + Words{"small.pgm"}), apps::exit_failed);
    EXPECT_EQ(last_complaint(),
              "fovea calibrate: small.pgm has 240x320 px, left0.pgm 320x240; one of them is "
              "turned: take all the same way up");
    EXPECT_EQ(io.out, "");
}

TEST_F(CalibrateCommand, CountsAPictureOnceThatIsGivenTwice) {
    const Json once = json_of(board + left).back();
    io.put("again.pgm", pictures().files.files.at("left3.pgm"));
    const std::vector<Json> lines = json_of(board + left + Words{"again.pgm"});
    EXPECT_EQ(lines[10]["used"].text, "false");
    EXPECT_EQ(lines[10]["reason"].text, "the same picture as left3.pgm");
    EXPECT_EQ(lines.back()["rms_px"].text, once["rms_px"].text);
    EXPECT_TRUE(warns(lines.back(), "same_picture"));
    EXPECT_EQ(last_complaint(), "warning: again.pgm is the same picture as left3.pgm; counted once");
}

TEST_F(CalibrateCommand, SaysWhichBoardIsSeenInPlaceOfAnother) {
    // The squares were counted, and the first picture is of something else.
    put_picture(io, "wall.png", Picture<Gray8>({200, 100}));
    EXPECT_EQ(run(Words{"--board", "8x7", "--square", "12", "wall.png"} + some(3)), apps::exit_failed);
    EXPECT_EQ(last_complaint(),
              "fovea calibrate: no picture shows the whole board; a board of 7x6 is seen: give "
              "--board 7x6");
    EXPECT_EQ(run(Words{"--board", "11x3", "--square", "12"} + some(3)), apps::exit_failed);
    EXPECT_EQ(
        last_complaint(),
        "fovea calibrate: no picture shows the whole board; --board counts inner corners, so that 10x7 "
        "squares are 9x6; is the board whole in the pictures, with a bright rim, sharp and evenly lit?");
    const Json result =
        json_of(Words{"--board", "8x7", "--square", "12"} + some(3), apps::exit_failed).back();
    EXPECT_EQ(result["rms_px"].kind, Json::Kind::null);
    EXPECT_EQ(result["error"].text,
              "no picture shows the whole board; a board of 7x6 is seen: give --board 7x6");
}

TEST_F(CalibrateCommand, RefusesViewsThatLeaveTheCameraOpen) {
    EXPECT_EQ(run(board + some(1)), apps::exit_failed);
    EXPECT_EQ(
        last_complaint(),
        "fovea calibrate: no calibration: too few views for what is estimated; take more pictures, ten or "
        "more, with the board tilted to different sides; or hold the principal point with --fixed-centre");
    for (int i = 0; i < 3; ++i)
        put_picture(io, "flat" + std::to_string(i) + ".png", render_board({}, {20.0 * i - 20, 5.0 * i, 230}));
    EXPECT_EQ(run(board + Words{"flat0.png", "flat1.png", "flat2.png"}), apps::exit_failed);
    EXPECT_EQ(last_complaint(),
              "fovea calibrate: no calibration: the views are too much alike; tilt the board by 20 degrees "
              "and more, "
              "to different sides, and take the pictures again");
}

TEST_F(CalibrateCommand, WarnsOfFewViewsAndOfPlacesWithoutABoard) {
    const Json few = json_of(board + Words{left[5], left[6], left[7]}, apps::exit_not_ok).back();
    EXPECT_TRUE(warns(few, "few_views"));
    EXPECT_TRUE(warns(few, "empty_places"));
    EXPECT_FALSE(warns(few, "few_tilts"));
    EXPECT_EQ(few["doubtful"].text, "true");
    EXPECT_EQ(run(board + Words{left[5], left[6], left[7]}), apps::exit_not_ok);
    EXPECT_NE(io.errors().find("warning: only 3 views; take 10 to 20"), std::string::npos) << io.errors();
    EXPECT_NE(io.errors().find("parts of the picture: upper left corner"), std::string::npos) << io.errors();
    EXPECT_EQ(lines_of(io.out).back(), "doubtful: mind the warnings before you measure with it");
}

TEST_F(CalibrateCommand, WarnsOfAViewThatDoesNotFit) {
    // The board moved to the right while the rows were read.
    BoardPlace place = good_places()[6];
    place.about_z += 10;
    Picture<Gray8> bent = render_board({}, place);
    place.x += 2;
    const Picture<Gray8> later = render_board({}, place);
    std::copy(later.pixels.begin() + 110 * 320, later.pixels.end(), bent.pixels.begin() + 110 * 320);
    put_picture(io, "bent.pgm", bent);
    const Json result = json_of(board + left + Words{"bent.pgm"}, apps::exit_not_ok).back();
    EXPECT_TRUE(warns(result, "bad_view")) << io.errors();
    EXPECT_NE(io.errors().find("warning: bent.pgm fits badly, "), std::string::npos) << io.errors();
}

TEST_F(CalibrateCommand, DrawsCornersAndCoverage) {
    EXPECT_EQ(run(board + left + Words{"--coverage", "all.png", "--explain", "seen.png"}), apps::exit_ok);
    Picture<Rgb888> all, seen;
    std::string problem;
    ASSERT_TRUE(apps::load_picture(io.storage(), "all.png", 8191, all, problem)) << problem;
    ASSERT_TRUE(apps::load_picture(io.storage(), "seen-9.png", 8191, seen, problem)) << problem;
    EXPECT_EQ(seen.size, (Size{640, 480}));
    const auto count = [](const Picture<Rgb888>& picture, Rgb888 colour) {
        return std::count(picture.pixels.begin(), picture.pixels.end(), colour);
    };
    const Rgb888 hatching{240, 150, 110};
    const Rgb888 ring{255, 240, 120};
    EXPECT_EQ(count(all, hatching), 0);
    EXPECT_GT(count(seen, ring), 50);
    EXPECT_EQ(run(board + Words{left[5], left[6], left[7], left[0]} + Words{"--coverage", "some.png"}),
              apps::exit_ok)
        << io.errors();
    Picture<Rgb888> some_places;
    ASSERT_TRUE(apps::load_picture(io.storage(), "some.png", 8191, some_places, problem)) << problem;
    EXPECT_GT(count(some_places, hatching), 1000);
}

TEST_F(CalibrateCommand, CalibratesAPairAndTellsHowItsCamerasStand) {
    const Words lists = Words{"--left"} + left + Words{"--right"} + right;
    const std::vector<Json> lines = json_of(board + lists + Words{"--out", "pair.toml"});
    ASSERT_EQ(lines.size(), 21u);
    EXPECT_EQ(lines[0]["camera"].text, "left");
    EXPECT_EQ(lines[10]["camera"].text, "right");
    EXPECT_EQ(lines[10]["image"].text, "right0.pgm");
    const Json& result = lines.back();
    EXPECT_LT(result["rms_px"].number(), 0.15);
    EXPECT_LT(result["left"]["rms_px"].number(), 0.15);
    const double truth[] = {-15, 0, 0};
    for (std::size_t i = 0; i < 3; ++i) {
        const double deviation = result["translation_deviation_mm"].items[i].number();
        EXPECT_GT(deviation, 0);
        // Held cameras bring their own errors: that of the focal length moves boards, which are 300 mm away,
        // by its share of their distance, in each of both.
        double held = 0;
        for (const char* side : {"left", "right"})
            held += 300 * result[side]["deviations"]["fx"].number() / result[side]["camera"]["fx"].number();
        EXPECT_LT(held, 1.5);
        EXPECT_NEAR(result["translation_mm"].items[i].number(), truth[i], 5 * deviation + held) << i;
    }
    EXPECT_NEAR(result["rotation"].items[0].number(), 1, 1e-4);
    const CameraFile file = apps::read_camera(io.text("pair.toml"));
    ASSERT_EQ(file.problem, "");
    ASSERT_EQ(file.cameras.size(), 2u);
    EXPECT_EQ(apps::json_number(file.right_from_left().translation[0]),
              result["translation_mm"].items[0].text);

    const Json freed = json_of(board + lists + Words{"--free"}).back();
    EXPECT_LT(freed["rms_px"].number(), result["rms_px"].number());
    EXPECT_NE(freed["left"]["camera"]["fx"].text, result["left"]["camera"]["fx"].text);

    EXPECT_EQ(run(board + lists), apps::exit_ok);
    EXPECT_NE(io.out.find("\nboth, from "), std::string::npos) << io.out;
    EXPECT_NE(io.out.find("  the right camera is 1"), std::string::npos) << io.out;
}

TEST_F(CalibrateCommand, KnowsWhichEndOfABoardIsSeenThatLooksTheSameTurned) {
    // The right camera is turned by 2 degrees, so that it sees boards the other way up that lie across.
    const RenderedBoard alike{7, 5, 12};
    Words lists[2];
    for (std::size_t i = 0; i < 8; ++i) {
        BoardPlace place = good_places()[i];
        place.about_z = i % 2 == 0 ? 89 : 20;
        for (const char* side : {"l", "r"}) {
            lists[side[0] == 'r' ? 1 : 0].push_back(side + std::to_string(i));
            put_picture(io, side + std::to_string(i), render_board({}, place, alike));
            const double turn = 2 * 3.14159265358979323846 / 180;
            const double x = place.x * std::cos(turn) - place.y * std::sin(turn);
            place.y = place.x * std::sin(turn) + place.y * std::cos(turn);
            place.x = x;
            place.about_z += 2;
        }
    }
    run(Words{"--board", "7x5", "--square", "12", "--json", "--left"} + lists[0] + Words{"--right"} +
        lists[1]);
    const Json result = parse_json(lines_of(io.out).back()).value_or(Json());
    EXPECT_EQ(result["views_used"].text, "8");
    EXPECT_LT(result["rms_px"].number(), 0.2) << io.errors();
    EXPECT_NEAR(result["rotation"].items[3].number(), std::sin(2 * 3.14159265358979323846 / 180), 0.002);
}

TEST_F(CalibrateCommand, CalibratesWithGridsOfCirclesToo) {
    const struct {
        const char* name;
        RenderedBoard board;
    } grids[] = {{"circles", {7, 6, 12, RenderedBoard::Pattern::circles}},
                 {"asymmetric-circles", {4, 7, 10, RenderedBoard::Pattern::asymmetric}}};
    for (const auto& grid : grids) {
        Words words = {"--pattern", grid.name,
                       "--square",  grid.board.columns == 7 ? "12" : "10",
                       "--board",   apps::board_text({grid.board.columns, grid.board.rows})};
        for (std::size_t i = 0; i < good_places().size(); ++i) {
            words.push_back("c" + std::to_string(i));
            put_picture(io, words.back(), render_board({}, good_places()[i], grid.board));
        }
        run(words + Words{"--json"});
        const Json result = parse_json(lines_of(io.out).back()).value_or(Json());
        EXPECT_EQ(result["views_used"].text, "10") << grid.name << "\n" << io.errors();
        EXPECT_LT(result["rms_px"].number(), 0.2) << grid.name;
        // Centres of circles that are seen askew are off by some hundredths of a pixel, all to one side.
        EXPECT_NEAR(result["camera"]["fx"].number(), 320, 3) << grid.name;
    }
}

TEST_F(CalibrateCommand, TakesListsOfAPairInManyForms) {
    const std::string commas = left[0] + "," + left[5] + "," + left[6];
    const Words others = {right[0], right[5], right[6]};
    const Words forms[] = {Words{"--left", commas, "--right"} + others,
                           Words{"--left=" + commas, "--right=" + right[0]} + Words{right[5], right[6]},
                           Words{"--left", left[0], "--left", left[5], left[6], "--right"} + others};
    std::string first;
    for (const Words& form : forms) {
        const Json result = json_of(form + board, apps::exit_not_ok).back();
        if (first.empty()) first = result["rms_px"].text;
        EXPECT_EQ(result["rms_px"].text, first) << io.errors();
        EXPECT_TRUE(warns(result, "few_pairs"));
        EXPECT_FALSE(warns(result, "pair_names"));
    }
}

TEST_F(CalibrateCommand, WarnsOfPairsThatAreNone) {
    // Two pictures of the right camera exchanged.
    Words exchanged = right;
    std::swap(exchanged[5], exchanged[6]);
    const Json result =
        json_of(board + Words{"--left"} + left + Words{"--right"} + exchanged, apps::exit_not_ok).back();
    EXPECT_TRUE(warns(result, "pair_names"));
    EXPECT_TRUE(warns(result, "bad_pair") || warns(result, "pairs_disagree")) << io.errors();
    EXPECT_NE(io.errors().find("left5.pgm is paired with right6.pgm"), std::string::npos);
}

TEST_F(CalibrateCommand, RefusesAPairWithoutACommonView) {
    Picture<Gray8> wall({320, 240});
    put_picture(io, "wall.png", wall);
    const Words some_left = Words(left.begin(), left.begin() + 4) + Words(4, "wall.png");
    const Words some_right = Words(4, "wall.png") + Words(right.begin() + 4, right.begin() + 8);
    EXPECT_EQ(run(board + Words{"--left"} + some_left + Words{"--right"} + some_right), apps::exit_failed);
    EXPECT_EQ(
        last_complaint(),
        "fovea calibrate: no pair shows the board in both pictures; stand where both cameras see all of it");
    EXPECT_EQ(run(board + Words{"--left", left[0], "--right", right[0]}), apps::exit_failed);
    EXPECT_EQ(last_complaint().compare(0, 56, "fovea calibrate: no calibration of the left camera: too "), 0)
        << last_complaint();
}

TEST_F(CalibrateCommand, EndsWithTwoWhereAPictureCannotBeRead) {
    io.put("text.png", "no picture");
    const Json result = json_of(board + left + Words{"text.png", "none.png"}, apps::exit_failed).back();
    EXPECT_EQ(result["error"].text, "a picture could not be read, or one not be written");
    EXPECT_EQ(io.complaints.size(), 12u);
    EXPECT_EQ(io.complaints[10],
              "text.png: not a picture that fovea reads: PGM, PPM, BMP, PNG or baseline JPEG");
    EXPECT_EQ(io.complaints[11].compare(0, 10, "none.png: "), 0);
}

TEST_F(CalibrateCommand, SaysWhatIsWrongWithItsWords) {
    const Words one = {"left0.pgm"};
    refuses(one, "which board? give --board 9x6: its columns x rows of inner corners");
    refuses(Words{"--board", "9x6"} + one, "how large is a square? give --square MM, measured on the board");
    refuses(board, "which pictures? give IMAGE..., or --left IMAGE... --right IMAGE...");
    for (const char* wrong : {"9", "9x", "9x2", "65x6", "9x6x3", "9.5x6", "axb", "-9x6"})
        refuses(
            Words{"--square", "1", std::string("--board=") + wrong} + one,
            std::string("--board takes columns x rows of inner corners, 3 to 64 each, such as 9x6, not '") +
                wrong + "'");
    for (const char* wrong : {"0", "-1", "10001", "0.001", "1e3", "mm"})
        refuses(Words{"--board", "7x6", std::string("--square=") + wrong} + one,
                std::string(
                    "--square takes the side of a square in mm, 0.01 to 10000, such as 25 or 30.5, not '") +
                    wrong + "'");
    refuses(Words{"--board", "7x6", "--square", "12.0001"} + one,
            "--square has whole micrometres: at most three places, such as 24.985");
    refuses(board + one + Words{"--pattern", "circle"},
            "--pattern is checkerboard, circles or asymmetric-circles, not 'circle'; did you mean circles?");
    refuses(board + one + Words{"--lens", "k1"}, "--lens is none, k1k2, k1k2p1p2 or k1k2k3p1p2, not 'k1'");
    refuses(board + one + Words{"-o", "c", "--format", "yml"},
            "--format is toml, ivt, opencv or chip, not 'yml'");
    refuses(board + one + Words{"--format", "ivt"}, "--format is of a file to write; give -o FILE too");
    refuses(board + one + Words{"-o", "c.xml"}, "OpenCV's XML is not written; name it .yml");
    refuses(board + one + Words{"--free"}, "--free is of a pair; give --left IMAGE... and --right IMAGE...");
    refuses(board + one + Words{"-o", "-", "--json"},
            "--json and -o - both write to the standard output; give -o a name");
    refuses(board + one + Words{"--left", "left1.pgm", "--right", "right1.pgm"},
            "IMAGE... are of one camera, --left and --right of two; give the one or the other");
    refuses(board + Words{"--left", "left1.pgm"},
            "--right is missing or has no picture; a pair has --left IMAGE... and --right IMAGE...");
    refuses(board + Words{"--left", "--right", "right1.pgm"},
            "--left is missing or has no picture; a pair has --left IMAGE... and --right IMAGE...");
    refuses(
        board + Words{"--left", "left1.pgm", "left2.pgm", "--right", "right1.pgm"},
        "--left has 2 pictures and --right 1; each needs its partner at the same place of the other list");
    refuses(board + one + Words{"-o", "left0.pgm"},
            "--out would overwrite the picture left0.pgm; give another name");
    refuses(board + one + Words{"--explain", "a.png", "--coverage", "a.png"},
            "--explain would overwrite a.png; give another name");
    refuses(board + one + Words{"--coverage", "-"}, "--coverage writes a file; give it a name");
    refuses(board + one + Words{"--coverage", "a.jpg"},
            "--coverage a.jpg: fovea writes PNG, PGM and PPM; name it .png");
    refuses(board + one + Words{"--bord", "7x6"}, "unknown option --bord; did you mean --board?");
    EXPECT_EQ(run({"--help"}), apps::exit_ok);
    EXPECT_EQ(io.out.compare(0, 37, "usage: fovea calibrate [options] --bo"), 0);
}

TEST(CalibrationBoard, HasItsPointsRowByRow) {
    apps::Board board;
    board.size = {3, 2};
    board.square_um = 10;
    EXPECT_EQ(board.points(),
              (std::vector<PlanePoint>{{0, 0}, {10, 0}, {20, 0}, {0, 10}, {10, 10}, {20, 10}}));
    EXPECT_FALSE(board.symmetric());
    board.pattern = apps::BoardPattern::circles;
    EXPECT_TRUE(board.symmetric());
    board.pattern = apps::BoardPattern::asymmetric_circles;
    EXPECT_EQ(board.points(),
              (std::vector<PlanePoint>{{0, 0}, {20, 0}, {40, 0}, {10, 10}, {30, 10}, {50, 10}}));
}

/// The board of OpenCV's pictures, with corners of our own: at or below the rms of OpenCV's.
TEST(CalibratePhotos, FitCloserThanWithOpenCvsCorners) {
    const std::filesystem::path folder = opencv_doc_folder();
    FOVEA_NEED_PICTURE(folder / "left01.jpg");
    TestIo io;
    Words words = {"--board", "9x6", "--square", "25", "--json", "--left"};
    for (const char* side : {"left", "right"}) {
        if (side[0] == 'r') words.push_back("--right");
        for (int i = 1; i <= 14; ++i) {
            if (i == 10) continue;
            const std::string name = std::string(side) + (i < 10 ? "0" : "") + std::to_string(i) + ".jpg";
            io.put(name, read_file(folder / name));
            words.push_back(name);
        }
    }
    EXPECT_EQ(apps::calibrate_command(io, words), apps::exit_ok) << io.errors();
    const Json result = parse_json(lines_of(io.out).back()).value_or(Json());
    EXPECT_EQ(result["views_used"].text, "13");
    EXPECT_LE(result["left"]["rms_px"].number(), 0.4083);
    EXPECT_LE(result["right"]["rms_px"].number(), 0.4579);
    EXPECT_LE(result["rms_px"].number(), 0.4468);
}

}  // namespace
}  // namespace fovea::test
