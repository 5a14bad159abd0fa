// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <camera/camera_command.hpp>
#include <camera/load_camera.hpp>
#include <support/picture.hpp>
#include <support/test_io.hpp>

namespace fovea::test {
namespace {

using apps::CameraFile;
using apps::CameraFormat;
using apps::CameraRecord;

Real real(const std::string& text) {
    const Result<Real> read = parse_real(apps::span_of(text));
    EXPECT_TRUE(read.ok()) << text;
    return read ? *read : Real();
}

void expect_same(const CameraRecord& a, const CameraRecord& b) {
    EXPECT_EQ(a.size, b.size);
    for (const apps::CameraParameter& parameter : apps::camera_parameters)
        EXPECT_EQ(a.camera.*parameter.member, b.camera.*parameter.member) << parameter.name;
    EXPECT_EQ(a.pose.rotation, b.pose.rotation);
    EXPECT_EQ(a.pose.translation, b.pose.translation);
    EXPECT_EQ(a.rms_px.has_value(), b.rms_px.has_value());
    if (a.rms_px && b.rms_px) {
        EXPECT_EQ(*a.rms_px, *b.rms_px);
    }
    ASSERT_EQ(a.deviations.has_value(), b.deviations.has_value());
    if (!a.deviations) return;
    for (const apps::CameraParameter& parameter : apps::camera_parameters)
        EXPECT_EQ((*a.deviations).*parameter.member, (*b.deviations).*parameter.member);
}
void expect_same(const CameraFile& a, const CameraFile& b) {
    EXPECT_EQ(b.problem, "");
    ASSERT_EQ(a.cameras.size(), b.cameras.size());
    for (std::size_t i = 0; i < a.cameras.size(); ++i) expect_same(a.cameras[i], b.cameras[i]);
}

const std::string one_toml =
    "format = 1\n"
    "[[camera]]\n"
    "size = [640, 480]\n"
    "fx = 536.454766207\n"
    "fy = 536.406519322\n"
    "cx = 342.367759491  # px\n"
    "cy = 235\n"
    "k1 = -0.2786528930\n"
    "p2 = -3.4478546e-4\n";

/// A pair with all that a file may hold.
CameraFile full_pair() {
    CameraFile file = apps::read_camera(one_toml);
    EXPECT_EQ(file.problem, "");
    file.cameras.push_back(file.cameras[0]);
    CameraRecord& right = file.cameras[1];
    right.camera.fx = real("542.251824475");
    right.pose.rotation = rotation_about(Vector<3>(real("0.01"), real("-0.02"), real("0.005")));
    right.pose.translation = Vector<3>(real("-83.4"), real("1e-3"), real("0.25"));
    right.rms_px = real("0.457804055179");
    right.deviations = Camera<>();
    right.deviations->k3 = real("4.7e-03");
    file.stereo_rms_px = real("0.446846697");
    return file;
}

TEST(CameraToml, ReadsNumbersToTheLastDigit) {
    const CameraFile file = apps::read_camera(one_toml);
    ASSERT_EQ(file.problem, "");
    EXPECT_EQ(file.format, CameraFormat::toml);
    ASSERT_EQ(file.cameras.size(), 1u);
    const CameraRecord& record = file.cameras[0];
    EXPECT_EQ(record.size, (Size{640, 480}));
    EXPECT_EQ(record.camera.fx, real("536.454766207"));
    EXPECT_EQ(record.camera.cy, Real::from_int(235));
    EXPECT_EQ(record.camera.k1, real("-0.278652893"));
    EXPECT_EQ(record.camera.p2, real("-0.00034478546"));
    EXPECT_TRUE(record.camera.k2.zero());
    EXPECT_FALSE(record.rms_px.has_value());
    EXPECT_FALSE(file.stereo());
}

TEST(CameraToml, IsTheSameWhenItIsWrittenAndRead) {
    const CameraFile file = full_pair();
    const CameraFile again = apps::read_camera(apps::camera_toml(file));
    expect_same(file, again);
    ASSERT_TRUE(again.stereo_rms_px.has_value());
    EXPECT_EQ(*again.stereo_rms_px, real("0.446846697"));
    // As short as can be.
    EXPECT_NE(apps::camera_toml(file).find("fx = 542.251824475\n"), std::string::npos);
}

TEST(CameraToml, SaysWhatIsWrongAndWhere) {
    const auto problem = [](const std::string& text) {
        const CameraFile file = apps::read_camera(text);
        return std::to_string(file.place.line) + ":" + std::to_string(file.place.column) + " " + file.problem;
    };
    const std::string top = "format = 1\n[[camera]]\n";
    const std::string good = top + "fx = 1\nfy = 1\ncx = 1\ncy = 1\n";
    EXPECT_EQ(apps::read_camera(good).problem, "");
    EXPECT_EQ(problem("format = 1\n"), "1:1 the file has no [[camera]]");
    EXPECT_EQ(problem("[[camera]]\nfx = 1\n"), "1:1 the file lacks format = 1");
    EXPECT_EQ(problem("format = 2\n"), "1:10 format: expected 1");
    EXPECT_EQ(problem("format = 1\nformat = 1\n"), "2:1 format stands twice");
    EXPECT_EQ(problem("format = 1\nstereo_rms_pix = 1\n"),
              "2:1 unknown key stereo_rms_pix before the first [[camera]]; did you mean stereo_rms_px?");
    EXPECT_EQ(problem("format = 1\nstereo_rms_px = -1\n"), "2:17 stereo_rms_px is not below 0");
    EXPECT_EQ(problem("format = 1\n[camera]\n"), "2:2 cameras are written as [[camera]]");
    EXPECT_EQ(problem("format = 1\n[[lens]]\n"), "2:3 unknown table [lens]; there is [[camera]]");
    EXPECT_EQ(problem(top + "fx = 1\n"), "2:3 [[camera]] lacks fy: focal length down, in px");
    EXPECT_EQ(problem(good + "k4 = 1\n"), "7:1 unknown key k4 in [[camera]]; did you mean k1?");
    EXPECT_EQ(problem(good + "cx = 1\n"), "7:1 cx stands twice");
    EXPECT_EQ(problem(good + "k1 = \"1\"\n"), "7:6 k1: expected a number such as 532.25");
    EXPECT_EQ(problem(good + "k1 = 1e99\n"), "7:6 k1: a number has at most 40 digits and is below 1e60");
    EXPECT_EQ(problem(good + "k1 = 1e9.\n"), "7:6 expected a number such as 25, -2.5 or 1.5e-7");
    EXPECT_EQ(problem(good + "k1 = 1e20\n"), "2:3 k1 is 1e+20: absurd");
    EXPECT_EQ(problem(top + "fx = 0\nfy = 1\ncx = 1\ncy = 1\n"), "2:3 fx is not above 0");
    EXPECT_EQ(problem(good + "size = 640\n"), "7:8 size: expected an array of 2 numbers");
    EXPECT_EQ(problem(good + "size = [640]\n"), "7:8 size: expected an array of 2 numbers, not 1");
    EXPECT_EQ(problem(good + "size = [640, 0]\n"),
              "7:8 size: expected [width, height] in px, whole numbers up to 32767");
    EXPECT_EQ(problem(good + "size = [640, 4.5]\n"),
              "7:8 size: expected [width, height] in px, whole numbers up to 32767");
    EXPECT_EQ(problem(good + "rotation = [1, 0, 0, 0, 1, 0, 0, 0, 2]\n"),
              "7:12 rotation is none: its rows are not at right angles and of length 1");
    EXPECT_EQ(problem(good + "translation = [1e10, 0, 0]\n"), "2:3 the translation has 1e+10: absurd");
    EXPECT_EQ(problem(good + "fx_deviation = -1\n"), "7:16 fx_deviation is not below 0");
    EXPECT_EQ(problem(good + good.substr(11) + good.substr(11)), "12:3 more than two cameras");
}

std::string ivt_text(const std::string& changed = "", const std::string& to = "") {
    std::string text =
        "2\n\n 640.0 480.0 532.25 0.0 338.5 0.0 530.5 238.75 0.0 0.0 1.0 -0.4175 0.1892 0.0004 -0.0012"
        "  1 0 0 0 1 0 0 0 1  0 0 1000\n"
        " 320 240 266.5 0 160.25 0 265.5 118.5 0 0 1 -0.41 0.17 0.0006 -0.0009 1 0 0 0 1 0 0 0 1 -80.5 0 "
        "1000\n";
    for (int i = 0; i < 34; ++i) text += (i % 8 == 0 ? "\n " : " ") + std::to_string(i) + ".5";
    if (!changed.empty()) text.replace(text.find(changed), changed.size(), to);
    return text;
}

TEST(CameraIvt, ReadsThePairWithItsOwnSizes) {
    const CameraFile file = apps::read_camera(ivt_text());
    ASSERT_EQ(file.problem, "");
    EXPECT_EQ(file.format, CameraFormat::ivt);
    ASSERT_TRUE(file.stereo());
    EXPECT_EQ(file.cameras[0].size, (Size{640, 480}));
    EXPECT_EQ(file.cameras[1].size, (Size{320, 240}));
    EXPECT_EQ(file.cameras[0].camera.fx, real("532.25"));
    EXPECT_EQ(file.cameras[0].camera.cx, real("338.5"));
    EXPECT_EQ(file.cameras[0].camera.fy, real("530.5"));
    EXPECT_EQ(file.cameras[0].camera.cy, real("238.75"));
    EXPECT_EQ(file.cameras[1].camera.k1, real("-0.41"));
    EXPECT_EQ(file.cameras[1].camera.k2, real("0.17"));
    EXPECT_EQ(file.cameras[1].camera.p1, real("0.0006"));
    EXPECT_EQ(file.cameras[1].camera.p2, real("-0.0009"));
    EXPECT_EQ(file.cameras[1].pose.translation[0], real("-80.5"));
    const Vector<3> way = file.right_from_left().translation;
    EXPECT_EQ(way, Vector<3>(real("-80.5"), Real(), Real()));
}

TEST(CameraIvt, SaysWhatIsWrongAndWhere) {
    const auto problem = [](const std::string& text) {
        const CameraFile file = apps::read_camera_ivt(text);
        return std::to_string(file.place.line) + ":" + std::to_string(file.place.column) + " " + file.problem;
    };
    EXPECT_EQ(problem(""), "1:1 the file ends before the number of cameras");
    EXPECT_EQ(problem("3 4"), "1:1 the number of cameras is 1 or 2");
    EXPECT_EQ(problem("1\n640 480 500"), "2:12 the file ends within the first camera");
    EXPECT_EQ(problem(ivt_text("640.0", "640.5")),
              "3:2 a side of a picture is a whole number from 1 to 32767; of the first camera");
    EXPECT_EQ(problem(ivt_text("266.5", "2x")), "4:10 '2x' is no number; of the second camera");
    EXPECT_EQ(problem(ivt_text("0.0 0.0 1.0", "0.0 0.0 2.0")),
              "3:56 the matrix is not fx 0 cx, 0 fy cy, 0 0 1; of the first camera");
    EXPECT_EQ(problem(ivt_text("532.25", "0")), "3:109 the first camera: fx is not above 0");
    EXPECT_EQ(problem(ivt_text(" 33.5", "")), "10:6 the file ends within the homographies");
    EXPECT_EQ(problem(ivt_text() + " 1"), "10:12 something stands behind the last number");
}

TEST(CameraIvt, WritesTheSizesAndTheCornersThatTheToolkitForgot) {
    CameraFile file = full_pair();
    std::string text;
    ASSERT_EQ(apps::detail::written_camera(file, "c.toml", CameraFormat::ivt, text), "");
    const CameraFile again = apps::read_camera(text);
    EXPECT_EQ(again.format, CameraFormat::ivt);
    for (std::size_t i = 0; i < 2; ++i) {
        file.cameras[i].rms_px.reset();
        file.cameras[i].deviations.reset();
    }
    expect_same(file, again);
    // Corners are where the homographies put (0, 0), (640, 0), (640, 480) and (0, 480).
    std::vector<Real> numbers;
    for (const std::string& line : lines_of(text))
        for (const std::string& word : apps::split(line, ' '))
            if (!word.empty()) numbers.push_back(real(word));
    ASSERT_EQ(numbers.size(), 1u + 2 * 27 + 2 * 8 + 2 * 9);
    for (std::size_t camera = 0; camera < 2; ++camera) {
        const Real* const corner = &numbers[55 + 8 * camera];
        const Real* const h = &numbers[71 + 9 * camera];
        const int sides[4][2] = {{0, 0}, {640, 0}, {640, 480}, {0, 480}};
        for (int i = 0; i < 4; ++i) {
            const Real x = Real::from_int(sides[i][0]), y = Real::from_int(sides[i][1]);
            const Real depth = h[6] * x + h[7] * y + h[8];
            const Real off_x = (h[0] * x + h[1] * y + h[2]) / depth - corner[2 * i];
            const Real off_y = (h[3] * x + h[4] * y + h[5]) / depth - corner[2 * i + 1];
            EXPECT_LT(off_x.absolute(), Real::from_int(1, -40));
            EXPECT_LT(off_y.absolute(), Real::from_int(1, -40));
        }
        EXPECT_EQ(h[8], Real::one());
    }
    file.cameras[1].camera.k3 = real("0.1");
    EXPECT_EQ(apps::detail::written_camera(file, "c.toml", CameraFormat::ivt, text),
              "c.toml: the toolkit's format has no k3; calibrate without it");
    file = full_pair();
    file.cameras[1].size = {};
    EXPECT_EQ(
        apps::detail::written_camera(file, "c.toml", CameraFormat::ivt, text),
        "c.toml: the toolkit's format wants the size of the pictures; write size = [width, height] into a "
        "camera.toml");
}

const std::string intrinsics =
    "%YAML:1.0\n"
    "M1: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
    "   data: [ 5.3480326845051309e+02, 0., 3.3568643204394891e+02, 0.,\n"
    "       5.3480326845051309e+02, 2.4066183054066337e+02, 0., 0., 1. ]\n"
    "D1: !!opencv-matrix\n   rows: 1\n   cols: 5\n   dt: d\n"
    "   data: [ 2.9589439552724328e-01, -1.0354662043042675e+00, 0., 0., .5 ]\n"
    "M2: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
    "   data: [ 535, 0, 334.5, 0, 534.5, 242, 0, 0, 1 ]\n"
    "D2: !!opencv-matrix\n   rows: 1\n   cols: 4\n   dt: d\n   data: [ -0.17, -0.11, 0.001, 0. ]\n";
const std::string extrinsics =
    "%YAML:1.0\n---\n"
    "R: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: [ 1., 0., 0., 0., 1., 0., 0., 0., 1. ]\n"
    "T: !!opencv-matrix\n   rows: 3\n   cols: 1\n   dt: d\n   data: [ -3.25, 0., 1.0e-02 ]\n"
    "Q: !!opencv-matrix\n   rows: 4\n   cols: 4\n   dt: d\n   data: [ .Nan ]\n";

TEST(CameraOpencv, ReadsThePairOfItsTwoFiles) {
    const CameraFile file = apps::read_camera(intrinsics + extrinsics);
    ASSERT_EQ(file.problem, "");
    EXPECT_EQ(file.format, CameraFormat::opencv);
    ASSERT_TRUE(file.stereo() && file.related);
    EXPECT_TRUE(file.cameras[0].size.empty());
    EXPECT_EQ(file.cameras[0].camera.fx, real("534.80326845051309"));
    EXPECT_EQ(file.cameras[0].camera.cx, real("335.68643204394891"));
    EXPECT_EQ(file.cameras[0].camera.k2, real("-1.0354662043042675"));
    EXPECT_EQ(file.cameras[0].camera.k3, real("0.5"));
    EXPECT_EQ(file.cameras[1].camera.fy, real("534.5"));
    EXPECT_EQ(file.cameras[1].camera.cy, real("242"));
    EXPECT_EQ(file.cameras[1].camera.p1, real("0.001"));
    EXPECT_EQ(file.right_from_left().translation, Vector<3>(real("-3.25"), Real(), real("0.01")));
    // The first file alone has the cameras.
    EXPECT_FALSE(apps::read_camera(intrinsics).related);
}

TEST(CameraOpencv, ReadsOneCameraOfItsSampleAndOfRos) {
    const std::string one =
        "%YAML:1.0\n---\nnframes: 13\nimage_width: 640\nimage_height: 480\n"
        "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
        "   data: [ 535.5, 0., 342.25, 0., 535.25, 235.5, 0., 0., 1. ]\n"
        "distortion_coefficients: !!opencv-matrix\n   rows: 5\n   cols: 1\n   dt: d\n"
        "   data: [ -2.5e-01, -3.0e-02, 1.75e-03, -2.5e-04, 2.25e-01 ]\n"
        "avg_reprojection_error: 3.9259098975581364e-01\n"
        "grid_points:\n   - 1\nimages:\n  - left01.jpg\n";
    const CameraFile file = apps::read_camera(one);
    ASSERT_EQ(file.problem, "");
    ASSERT_EQ(file.cameras.size(), 1u);
    EXPECT_EQ(file.cameras[0].size, (Size{640, 480}));
    EXPECT_EQ(file.cameras[0].camera.p2, real("-0.00025"));
    EXPECT_EQ(file.cameras[0].camera.k3, real("0.225"));
    ASSERT_TRUE(file.cameras[0].rms_px.has_value());
    EXPECT_EQ(*file.cameras[0].rms_px, real("0.39259098975581364"));

    const CameraFile ros = apps::read_camera(
        "image_width: 640\nimage_height: 480\ncamera_name: narrow\ncamera_matrix:\n  rows: 3\n  cols: 3\n"
        "  data: [535, 0, 342, 0, 536, 235, 0, 0, 1]\ndistortion_model: plumb_bob\ndistortion_coefficients:\n"
        "  rows: 1\n  cols: 5\n  data: [-0.25, 0.5, 0, 0, 0]\n");
    ASSERT_EQ(ros.problem, "");
    EXPECT_EQ(ros.cameras[0].camera.fy, real("536"));
    EXPECT_EQ(ros.cameras[0].camera.k2, real("0.5"));
}

TEST(CameraOpencv, IsTheSameWhenItIsWrittenAndRead) {
    CameraFile file = full_pair();
    for (CameraRecord& record : file.cameras) {
        record.rms_px.reset();
        record.deviations.reset();
    }
    expect_same(file, apps::read_camera(apps::camera_opencv(file)));
    file.cameras.pop_back();
    file.cameras[0].rms_px = real("0.25");
    expect_same(file, apps::read_camera(apps::camera_opencv(file)));
}

TEST(CameraOpencv, SaysWhatIsWrongAndWhere) {
    const auto problem = [](std::string text, const std::string& changed, const std::string& to) {
        if (!changed.empty()) text.replace(text.find(changed), changed.size(), to);
        const CameraFile file = apps::read_camera_opencv(text);
        return std::to_string(file.place.line) + " " + file.problem;
    };
    EXPECT_EQ(problem("%YAML:1.0\n", "", ""), "1 it holds no camera_matrix, and no M1 and M2");
    EXPECT_EQ(problem(extrinsics, "", ""),
              "1 it holds R and T but no camera; give both files: --camera INTRINSICS,EXTRINSICS");
    EXPECT_EQ(problem(intrinsics, "M2", "M3"), "2 of M1 and M2 one is missing");
    EXPECT_EQ(problem(intrinsics, "0., 0., 1. ]", "0., 1. ]"), "2 M1: expected 9 numbers as data");
    EXPECT_EQ(problem(intrinsics, "535, 0, 334.5", "535, x, 334.5"), "13 M2: 'x' is no number");
    EXPECT_EQ(problem(intrinsics, "535, 0, 334.5", "535, 1, 334.5"), "13 M2 is not fx 0 cx, 0 fy cy, 0 0 1");
    EXPECT_EQ(problem(intrinsics, "data: [ -0.17", "dada: [ -0.17"),
              "18 D2: expected an opencv-matrix with rows, cols and data");
    EXPECT_EQ(
        problem(intrinsics, "-0.17, -0.11, 0.001, 0.", "1,1,1,1,1,1,0,0"),
        "18 D2 has more than k1, k2, p1, p2 and k3; calibrate without CALIB_RATIONAL_MODEL and the like");
    EXPECT_EQ(problem(intrinsics + extrinsics, "[ 1., 0., 0.", "[ 2., 0., 0."),
              "25 R and T: the rotation is none: its rows are not at right angles and of length 1");
    EXPECT_EQ(problem(intrinsics + "image_width: 0\nimage_height: 1\n", "", ""),
              "23 image_width is from 1 to 32767");
    EXPECT_EQ(problem(intrinsics + "distortion_model: equidistant\n", "", ""),
              "23 the lens model equidistant is not one that fovea reads: plumb_bob");
    EXPECT_EQ(problem(intrinsics + "fisheye_model: 1\n", "", ""),
              "23 a fisheye model, which fovea does not read");
}

TEST(CameraChip, IsTheSameWhenItIsWrittenAndRead) {
    CameraFile file = full_pair();
    for (CameraRecord& record : file.cameras) {
        record.rms_px.reset();
        record.deviations.reset();
    }
    const std::string bytes = apps::camera_chip(file);
    EXPECT_EQ(bytes.size(), 320u);
    expect_same(file, apps::read_camera(bytes));
    EXPECT_EQ(apps::read_camera(bytes.substr(0, 100)).problem,
              "bytes of a calibration, but the data end too early");
}

TEST(CameraFormat, IsSeenFromWhatAFileHolds) {
    EXPECT_EQ(apps::read_camera("").problem, "the file is empty");
    EXPECT_EQ(apps::read_camera("<?xml version=\"1.0\"?>\n<opencv_storage>\n").problem,
              "OpenCV's XML, which fovea does not read; write the calibration to a .yml");
    EXPECT_EQ(apps::read_camera("Dear Sirs,\n").problem,
              "not a calibration that fovea reads: a camera.toml, the toolkit's text, or OpenCV's YAML");
    EXPECT_EQ(apps::camera_format("  \n\t"), CameraFormat::unknown);
    EXPECT_EQ(apps::camera_format("# of May\nformat = 1\n"), CameraFormat::toml);
    EXPECT_EQ(apps::camera_format("1\r\n640 480"), CameraFormat::ivt);
}

TEST(OpencvSamples, AreReadAsTheyAre) {
    const auto folder = opencv_doc_folder();
    FOVEA_NEED_PICTURE(folder / "left_intrinsics.yml");
    const auto text = [&](const char* name) {
        const std::vector<std::uint8_t> bytes = read_file(folder / name);
        return std::string(bytes.begin(), bytes.end());
    };
    const CameraFile left = apps::read_camera(text("left_intrinsics.yml"));
    ASSERT_EQ(left.problem, "");
    EXPECT_EQ(left.cameras[0].size, (Size{640, 480}));
    EXPECT_EQ(left.cameras[0].camera.k3, real("2.3839153080878486e-01"));
    const CameraFile pair = apps::read_camera(text("intrinsics.yml"));
    ASSERT_EQ(pair.problem, "");
    EXPECT_TRUE(pair.stereo() && !pair.related);
    EXPECT_EQ(apps::read_camera(text("calibration.yml")).problem,
              "it holds no camera_matrix, and no M1 and M2");
}

}  // namespace
}  // namespace fovea::test
