// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <camera/camera_command.hpp>
#include <camera/rectify_command.hpp>
#include <camera/undistort_command.hpp>
#include <support/test_io.hpp>

namespace fovea::test {
namespace {

using apps::ExitCode;
using apps::Picture;
using Words = std::vector<std::string>;

const std::string barrel_toml =
    "format = 1\n[[camera]]\nsize = [120, 90]\nfx = 100\nfy = 100\ncx = 59.5\ncy = 44.5\nk1 = -0.2\n";
const std::string pair_toml =
    barrel_toml +
    "[[camera]]\nsize = [120, 90]\nfx = 100\nfy = 100\ncx = 59.5\ncy = 44.5\nk1 = -0.2\n"
    "translation = [-50, 2, 0]\n";

class CameraCommands : public ::testing::Test {
protected:
    void SetUp() override {
        io.put("c.toml", barrel_toml);
        io.put("pair.toml", pair_toml);
        Picture<Gray8> gray({120, 90});
        Picture<Rgb888> colour({120, 90});
        for (int y = 0; y < 90; ++y)
            for (int x = 0; x < 120; ++x) {
                gray.view()(x, y) = static_cast<Gray8>(x + y);
                colour.view()(x, y) = {static_cast<Gray8>(x), static_cast<Gray8>(y), 7};
            }
        std::string problem;
        ASSERT_TRUE(apps::save_picture(io.storage(), "gray.pgm", gray, problem));
        ASSERT_TRUE(apps::save_picture(io.storage(), "colour.ppm", colour, problem));
        Picture<Gray8> small({12, 9});
        ASSERT_TRUE(apps::save_picture(io.storage(), "small.pgm", small, problem));
    }
    ExitCode undistort(const Words& words) {
        io.hush();
        return apps::undistort_command(io, words);
    }
    ExitCode rectify(const Words& words) {
        io.hush();
        return apps::rectify_command(io, words);
    }
    ExitCode camera(const Words& words) {
        io.hush();
        return apps::camera_command(io, words);
    }
    /// Of a call that fails.
    std::string complaint(ExitCode code) {
        EXPECT_EQ(code, apps::exit_failed);
        EXPECT_EQ(io.out, "");
        EXPECT_EQ(io.complaints.size(), 1u);
        return io.complaints.empty() ? "" : io.complaints[0];
    }
    template <class Pixel>
    Picture<Pixel> loaded(const std::string& name) {
        Picture<Pixel> picture;
        std::string problem;
        EXPECT_TRUE(apps::load_picture(io.storage(), name, 1000, picture, problem)) << problem;
        return picture;
    }

    TestIo io;
};

TEST_F(CameraCommands, UndistortTakesEachPixelFromWhereTheLensPutIt) {
    EXPECT_EQ(undistort({"gray.pgm", "colour.ppm", "--camera", "c.toml", "-o", "u.png"}), apps::exit_ok);
    EXPECT_EQ(io.errors(), "");
    EXPECT_EQ(lines_of(io.out)[0],
              "wrote u.png: fx 100, fy 100, cx 59.5, cy 44.5 px; 0 pixels were not seen");
    const Picture<Gray8> gray = loaded<Gray8>("u.png");
    const Picture<Rgb888> colour = loaded<Rgb888>("u-2.png");
    for (int y = 0; y < 90; ++y)
        for (int x = 0; x < 120; ++x) {
            const double u = (x - 59.5) / 100, v = (y - 44.5) / 100;
            const double r = 1 - 0.2 * (u * u + v * v);
            const double from_x = 59.5 + 100 * u * r, from_y = 44.5 + 100 * v * r;
            // The pictures are ramps, so that bilinear mixing gives the place itself; 0.5 for its rounding
            // and as much for that of the level.
            ASSERT_NEAR(gray.view()(x, y), from_x + from_y, 0.52);
            ASSERT_NEAR(colour.view()(x, y).red, from_x, 0.52);
            ASSERT_NEAR(colour.view()(x, y).green, from_y, 0.52);
            ASSERT_EQ(colour.view()(x, y).blue, 7);
        }
}

TEST_F(CameraCommands, UndistortZoomsUntilAllIsSeenOrNothingIsEmpty) {
    const auto empty = [&](const char* zoom) {
        EXPECT_EQ(undistort({"gray.pgm", "--camera", "c.toml", "--zoom", zoom, "--json", "--out", "z.png"}),
                  apps::exit_ok);
        EXPECT_EQ(io.errors(), "");
        const std::size_t at = io.out.find("\"empty_pixels\":");
        return std::stoi(io.out.substr(at + 15));
    };
    EXPECT_EQ(empty("valid"), 0);
    EXPECT_EQ(empty("same"), 0);
    EXPECT_GT(empty("all"), 100);
    EXPECT_EQ(io.out.find("{\"schema\":1,\"picture\":\"gray.pgm\",\"out\":\"z.png\",\"width_px\":120,"
                          "\"height_px\":90,\"fx_px\":"),
              0u);
}

TEST_F(CameraCommands, UndistortNamesItsPicturesAndTakesTheCameraOfThePair) {
    EXPECT_EQ(undistort({"gray.pgm", "--camera", "pair.toml", "--right"}), apps::exit_ok);
    EXPECT_TRUE(io.has("gray-undistorted.png"));
    EXPECT_EQ(complaint(undistort({"gray.pgm", "--camera", "c.toml", "--right"})),
              "fovea undistort: --right is for pairs, and c.toml has one camera");
}

TEST_F(CameraCommands, UndistortSaysWhatIsWrong) {
    EXPECT_EQ(complaint(undistort({})), "fovea undistort: which picture?");
    EXPECT_EQ(complaint(undistort({"gray.pgm"})), "fovea undistort: which camera? give --camera FILE");
    EXPECT_EQ(complaint(undistort({"gray.pgm", "--camera", "c.toml", "--zoom", "most"})),
              "fovea undistort: --zoom takes all, valid or same, not 'most'");
    EXPECT_EQ(complaint(undistort({"gray.pgm", "--camera", "c.toml", "-o", "u.jpg"})),
              "fovea undistort: u.jpg: fovea writes PNG, PGM and PPM; name it .png");
    EXPECT_EQ(complaint(undistort({"gray.pgm", "--camera", "c.toml", "-o", "-", "--json"})),
              "fovea undistort: --out - is for one picture without --json");
    EXPECT_EQ(complaint(undistort({"gray.pgm", "--camera", "gray.pgm"})),
              "gray.pgm: a picture, not a calibration; --camera takes a camera.toml, the toolkit's text, or "
              "OpenCV's YAML");
    EXPECT_NE(complaint(undistort({"gray.pgm", "--camera", "none.toml"})).find("none.toml: "),
              std::string::npos);
    EXPECT_EQ(complaint(undistort({"small.pgm", "--camera", "c.toml"})),
              "small.pgm is 12x9, the pictures of c.toml are 120x90; give pictures of that size");
    io.put("bad.toml", barrel_toml + "k1 = 2\n");
    EXPECT_EQ(complaint(undistort({"gray.pgm", "--camera", "bad.toml"})), "bad.toml:9:1: k1 stands twice");
    io.put("fold.toml", "format = 1\n[[camera]]\nfx = 50\nfy = 50\ncx = 59.5\ncy = 44.5\nk1 = -0.5\n");
    EXPECT_EQ(
        complaint(undistort({"gray.pgm", "--camera", "fold.toml", "--zoom", "valid"})),
        "fold.toml: the lens's model ends inside of the picture; take --zoom same, or calibrate with corners "
        "of the board near those of the picture");
    io.put("far.toml", "format = 1\n[[camera]]\nfx = 50\nfy = 50\ncx = 99999\ncy = 44.5\n");
    EXPECT_EQ(complaint(undistort({"gray.pgm", "--camera", "far.toml"})),
              "far.toml: no picture can be made with this camera: its numbers are absurd");
    // The second picture is still made.
    EXPECT_EQ(undistort({"small.pgm", "gray.pgm", "--camera", "c.toml", "-o", "w.png"}), apps::exit_failed);
    EXPECT_TRUE(io.has("w-2.png"));
}

TEST_F(CameraCommands, RectifyPutsAThingIntoOneRowOfBothPictures) {
    // A dot 1000 in front of the pair, 30 to the right and 20 down, as each camera sees it.
    // The right one looks 2.9 degrees further down.
    io.put("turned.toml",
           pair_toml + "rotation = [1, 0, 0, 0, 0.99875078, -0.04996877, 0, 0.04996877, 0.99875078]\n");
    const auto dotted = [&](const char* name, double x_at, double y_at, double depth) {
        Picture<Gray8> picture({120, 90});
        std::fill(picture.pixels.begin(), picture.pixels.end(), Gray8{255});
        const double u = x_at / depth, v = y_at / depth;
        const double r = 1 - 0.2 * (u * u + v * v);
        const double cx = 59.5 + 100 * u * r, cy = 44.5 + 100 * v * r;
        for (int y = 0; y < 90; ++y)
            for (int x = 0; x < 120; ++x)
                picture.view()(x, y) = static_cast<Gray8>(
                    255 - std::lround(200 * std::exp(-((x - cx) * (x - cx) + (y - cy) * (y - cy)) / 8)));
        std::string problem;
        ASSERT_TRUE(apps::save_picture(io.storage(), name, picture, problem));
    };
    dotted("l.pgm", 300, 200, 1000);
    dotted("r.pgm", 250, 2 + 0.99875078 * 200 - 0.04996877 * 1000, 0.04996877 * 200 + 0.99875078 * 1000);
    ASSERT_EQ(rectify({"l.pgm", "r.pgm", "--camera", "turned.toml", "-o", "lo.png,ro.png", "--picture",
                       "both.png"}),
              apps::exit_ok);
    EXPECT_EQ(io.errors(), "");
    EXPECT_NE(io.out.find("a thing is in one row of both"), std::string::npos);
    const auto middle = [&](const char* name) {
        const Picture<Gray8> picture = loaded<Gray8>(name);
        double sum = 0, sum_x = 0, sum_y = 0;
        for (int y = 40; y < 80; ++y)
            for (int x = 40; x < 120; ++x) {
                const double dark = std::max(0, 235 - picture.view()(x, y));
                const double weight = picture.view()(x, y) < 30 ? 0 : dark;
                sum += weight;
                sum_x += weight * x;
                sum_y += weight * y;
            }
        return std::pair<double, double>(sum_x / sum, sum_y / sum);
    };
    const auto left = middle("lo.png"), right = middle("ro.png");
    EXPECT_NEAR(left.second, right.second, 0.1);
    // 100 px times 50.04 over 1000.
    EXPECT_NEAR(left.first - right.first, 5, 0.2);
    EXPECT_EQ(loaded<Rgb888>("both.png").size, (Size{240, 90}));

    ASSERT_EQ(rectify({"l.pgm", "r.pgm", "--camera", "pair.toml", "--json", "--zoom", "valid"}),
              apps::exit_ok);
    EXPECT_EQ(
        io.out.find(
            "{\"schema\":1,\"left\":\"l-rectified.png\",\"right\":\"r-rectified.png\",\"width_px\":120,"),
        0u);
    EXPECT_NE(io.out.find("\"axis\":\"x\",\"empty_pixels\":[0,0]}"), std::string::npos) << io.out;
}

TEST_F(CameraCommands, RectifySaysWhatIsWrong) {
    const Words good = {"gray.pgm", "gray.pgm", "--camera", "pair.toml", "-o", "a.png,b.png"};
    EXPECT_EQ(rectify(good), apps::exit_ok);
    EXPECT_EQ(complaint(rectify({"gray.pgm", "--camera", "pair.toml"})),
              "fovea rectify: needs two pictures: LEFT RIGHT");
    EXPECT_EQ(complaint(rectify({"a", "b"})), "fovea rectify: which cameras? give --camera FILE");
    EXPECT_EQ(complaint(rectify({"a", "b", "--camera", "pair.toml", "-o", "a.png"})),
              "fovea rectify: --out takes two names with a comma between them: LEFT,RIGHT");
    EXPECT_EQ(complaint(rectify({"a", "b", "--camera", "pair.toml", "-o", "a.png,a.png"})),
              "fovea rectify: a.png would be written twice");
    EXPECT_EQ(complaint(rectify({"a", "b", "--camera", "pair.toml", "--picture", "-"})),
              "fovea rectify: pictures are written to files; give names");
    EXPECT_EQ(complaint(rectify({"gray.pgm", "gray.pgm", "--camera", "c.toml", "-o", "a.png,b.png"})),
              "c.toml has one camera; a pair is calibrated with `fovea calibrate --left ... --right ...`");
    EXPECT_EQ(complaint(rectify({"gray.pgm", "small.pgm", "--camera", "pair.toml"})),
              "small.pgm is 12x9, expected 120x90; give pictures of the size that pair.toml was made with");
    io.put("one_place.toml", barrel_toml + barrel_toml.substr(11));
    EXPECT_EQ(complaint(rectify({"gray.pgm", "gray.pgm", "--camera", "one_place.toml", "-o", "a.png,b.png"})),
              "one_place.toml: the pair cannot be rectified: its cameras are at one place, or one looks at "
              "the other");
}

TEST_F(CameraCommands, CameraTellsAndConverts) {
    ASSERT_EQ(camera({"pair.toml"}), apps::exit_ok);
    EXPECT_EQ(io.out,
              "pair.toml: fovea's TOML, a pair\n"
              "  120x90, fx 100, fy 100, cx 59.5, cy 44.5 px; k1 -0.2, k2 0, k3 0, p1 0, p2 0\n"
              "  120x90, fx 100, fy 100, cx 59.5, cy 44.5 px; k1 -0.2, k2 0, k3 0, p1 0, p2 0\n"
              "  from the first to the second: translation -50, 2, 0\n");
    for (const std::string to : {"toml", "ivt", "opencv", "chip"}) {
        ASSERT_EQ(camera({"pair.toml", "--to", to, "-o", "to." + to}), apps::exit_ok) << io.errors();
        EXPECT_EQ(io.out, "wrote to." + to + "\n");
        ASSERT_EQ(camera({"to." + to, "--json"}), apps::exit_ok) << io.errors();
        EXPECT_EQ(
            io.out.substr(io.out.find(",\"cameras\"")),
            ",\"cameras\":[{\"width_px\":120,\"height_px\":90,\"fx_px\":100,\"fy_px\":100,\"cx_px\":59.5,"
            "\"cy_px\":44.5,\"k1\":-0.2,\"k2\":0,\"k3\":0,\"p1\":0,\"p2\":0},{\"width_px\":120,\"height_px\":"
            "90,"
            "\"fx_px\":100,\"fy_px\":100,\"cx_px\":59.5,\"cy_px\":44.5,\"k1\":-0.2,\"k2\":0,\"k3\":0,\"p1\":"
            "0,"
            "\"p2\":0}],\"rotation\":[1,0,0,0,1,0,0,0,1],\"translation\":[-50,2,0]}\n");
    }
}

TEST_F(CameraCommands, CameraSaysWhatIsWrong) {
    EXPECT_EQ(complaint(camera({})), "fovea camera: which calibration? give one FILE");
    EXPECT_EQ(complaint(camera({"c.toml", "--to", "xml", "-o", "c.xml"})),
              "fovea camera: --to takes toml, ivt, opencv or chip, not 'xml'");
    EXPECT_EQ(complaint(camera({"c.toml", "--to", "ivt"})), "fovea camera: where to? give --out FILE");
    EXPECT_EQ(complaint(camera({"c.toml", "-o", "c.yml"})),
              "fovea camera: --out wants the format: --to toml, ivt, opencv or chip");
    EXPECT_EQ(complaint(camera({"c.toml", "--to", "ivt", "-o", "c", "--json"})),
              "fovea camera: --json tells, --to writes; give one of them");
    // Of two files in one, the line is that of its own.
    io.put("a.yml", "%YAML:1.0\nM1: 1\nM2: 2\n");
    io.put("b.yml", "%YAML:1.0\nR: 1\nT: 1\nfisheye_model: 1\n");
    EXPECT_EQ(complaint(camera({"a.yml,b.yml"})), "b.yml:4:1: a fisheye model, which fovea does not read");
    EXPECT_EQ(complaint(camera({"a.yml,c.yml"})).substr(0, 6), "c.yml:");
}

TEST_F(CameraCommands, ShowTheirHelp) {
    EXPECT_EQ(undistort({"--help"}), apps::exit_ok);
    EXPECT_EQ(io.out.find("usage: fovea undistort "), 0u);
    EXPECT_EQ(rectify({"--help"}), apps::exit_ok);
    EXPECT_EQ(io.out.find("usage: fovea rectify "), 0u);
    EXPECT_EQ(camera({"--help"}), apps::exit_ok);
    EXPECT_EQ(io.out.find("usage: fovea camera "), 0u);
}

}  // namespace
}  // namespace fovea::test
