// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include <calibrate/calibration_report.hpp>
#include <calibrate/calibration_warnings.hpp>

namespace fovea::test {
namespace {

using apps::CalibrationWarnings;
using apps::CameraEstimate;
using apps::PairEstimate;
using apps::SeenBoard;

bool begins(const std::string& text, const std::string& start) {
    return text.compare(0, start.size(), start) == 0;
}
Real hundredths(int value) { return Real::from_ratio(value, 100); }

/// Ten views of 640 x 480 that nothing is said against. Boards are tilted to and fro by 30 degrees, and have
/// one corner in every cell of the picture.
struct Calibrated {
    std::vector<SeenBoard> boards;
    CameraEstimate estimate;

    Calibrated() {
        estimate.picture = {640, 480};
        Camera<>& camera = estimate.calibration.camera;
        Camera<>& deviation = estimate.calibration.deviation;
        camera.fx = camera.fy = Real::from_int(600);
        camera.cx = Real::from_int(320);
        camera.cy = Real::from_int(240);
        camera.k1 = hundredths(-30);
        deviation.fx = deviation.fy = Real::one();
        deviation.k1 = hundredths(1);
        estimate.calibration.rms = hundredths(20);
        for (int i = 0; i < 10; ++i) {
            SeenBoard board;
            board.name = "a" + std::to_string(i) + ".png";
            board.picture = {640, 480};
            board.found = board.used = true;
            for (int cell = 0; cell < 16; ++cell)
                board.corners.push_back({SubPixel::from_int(cell % 4 * 160 + 20 + 10 * i),
                                         SubPixel::from_int(cell / 4 * 120 + 20)});
            boards.push_back(board);
            apps::ViewFit view;
            view.seen = static_cast<std::size_t>(i);
            view.fit.rms = hundredths(20);
            // Half of it is the tangent of half the angle: 0.268 for 15 degrees.
            view.fit.pose.rotation =
                rotation_about(Vector<3>(hundredths(i % 2 == 0 ? 54 : -54), Real(), Real()));
            estimate.views.push_back(view);
        }
    }
    CalibrationWarnings judged(const std::string& who = "") const {
        CalibrationWarnings warnings;
        apps::judge_camera(boards, estimate, who, warnings);
        return warnings;
    }
    std::multiset<std::string> codes() const {
        std::multiset<std::string> all;
        for (const apps::CalibrationWarning& warning : judged()) all.insert(warning.code);
        return all;
    }
};
using Codes = std::multiset<std::string>;

TEST(CalibrationWarnings, HaveNothingToSayOfAGoodCalibration) {
    EXPECT_EQ(Calibrated().codes(), Codes());
    EXPECT_FALSE(apps::doubtful(Calibrated().judged()));
    EXPECT_EQ(apps::human_judgement({}), "good: nothing speaks against this calibration\n");
}

TEST(CalibrationWarnings, TellOfFewViews) {
    Calibrated seven;
    seven.estimate.views.resize(7);
    EXPECT_EQ(seven.codes(), Codes{"few_views"});
    EXPECT_FALSE(apps::doubtful(seven.judged()));
    EXPECT_EQ(apps::human_judgement(seven.judged()), "usable; the warnings say how it becomes better\n");
    seven.estimate.views.resize(3);
    EXPECT_TRUE(apps::doubtful(seven.judged()));
    EXPECT_EQ(seven.judged("left")[0].text,
              "left: only 3 views; take 10 to 20, and the deviations become smaller and sure");
    Calibrated eight;
    eight.estimate.views.resize(8);
    EXPECT_EQ(eight.codes(), Codes());
}

TEST(CalibrationWarnings, TellOfBoardsThatLieAlike) {
    Calibrated alike;
    for (apps::ViewFit& view : alike.estimate.views)
        view.fit.pose.rotation =
            rotation_about(Vector<3>(hundredths(view.seen % 2 == 0 ? 20 : -14), Real(), Real()));
    EXPECT_EQ(alike.codes(), Codes{"few_tilts"});
    // 2 atan 0.1 + 2 atan 0.07.
    EXPECT_TRUE(begins(alike.judged()[0].text, "all boards lie within 19 degrees of each other; tilt"))
        << alike.judged()[0].text;
}

TEST(CalibrationWarnings, TellWhereNoCornerWasSeen) {
    Calibrated some;
    for (SeenBoard& board : some.boards) {
        board.corners[0] = board.corners[1] = board.corners[2] = board.corners[3];
        board.corners[5] = board.corners[6];
        board.corners[8] = board.corners[4];
        board.corners[15] = board.corners[14];
    }
    EXPECT_EQ(some.codes(), Codes{"empty_places"});
    EXPECT_TRUE(begins(some.judged()[0].text,
                       "no corner was seen in these parts of the picture: upper left "
                       "corner, upper edge, middle, left edge "
                       "and lower right corner; the "))
        << some.judged()[0].text;
}

TEST(CalibrationWarnings, TellOfABoardThatWasNotMoved) {
    Calibrated twice;
    twice.boards[6].corners = twice.boards[2].corners;
    twice.boards[6].corners[3].x = SubPixel::from_raw(twice.boards[6].corners[3].x.raw() + 300);
    EXPECT_EQ(twice.codes(), Codes{"same_place"});
    EXPECT_TRUE(begins(twice.judged()[0].text, "a6.png shows the board where a2.png does, and "));
}

TEST(CalibrationWarnings, TellOfViewsMuchWorseThanTheOthers) {
    Calibrated blurred;
    blurred.estimate.views[4].fit.rms = hundredths(50);
    EXPECT_EQ(blurred.codes(), Codes());
    blurred.estimate.views[4].fit.rms = hundredths(51);
    EXPECT_EQ(blurred.codes(), Codes{"bad_view"});
    EXPECT_TRUE(apps::doubtful(blurred.judged()));
    EXPECT_TRUE(begins(blurred.judged()[0].text,
                       "a4.png fits badly, 0.51 px rms where half of the views are below "
                       "0.20: blurred"))
        << blurred.judged()[0].text;
    for (apps::ViewFit& view : blurred.estimate.views) view.fit.rms = hundredths(40);
    blurred.estimate.views[4].fit.rms = hundredths(99);
    EXPECT_EQ(blurred.codes(), Codes());
}

TEST(CalibrationWarnings, TellOfAFitThatIsBadThroughout) {
    Calibrated bad;
    bad.estimate.calibration.rms = hundredths(101);
    EXPECT_EQ(bad.codes(), Codes{"high_rms"});
    EXPECT_TRUE(apps::doubtful(bad.judged()));
}

TEST(CalibrationWarnings, TellOfAnUncertainFocalLength) {
    Calibrated open;
    open.estimate.calibration.deviation.fy = Real::from_ratio(31, 10);
    EXPECT_EQ(open.codes(), Codes{"focal_length_uncertain"});
    EXPECT_TRUE(apps::doubtful(open.judged()));
    EXPECT_TRUE(begins(open.judged()[0].text, "the focal length is uncertain by 0.5 percent; "));
    open.estimate.calibration.deviation.fy = Real::from_ratio(29, 10);
    EXPECT_EQ(open.codes(), Codes());
}

TEST(CalibrationWarnings, TellOfAPrincipalPointFarOff) {
    Calibrated cut;
    cut.estimate.calibration.camera.cy = Real::from_int(190);
    EXPECT_EQ(cut.codes(), Codes{"centre_far"});
    cut.estimate.calibration.camera.cy = Real::from_int(193);
    EXPECT_EQ(cut.codes(), Codes());
}

TEST(CalibrationWarnings, TellOfTermsOfTheLensThatAreOpen) {
    Calibrated open;
    Camera<>& deviation = open.estimate.calibration.deviation;
    // The corner is at radius 0.667: 600 * 0.667^5 moves by 79 px for a unit of k2.
    deviation.k2 = hundredths(1);
    EXPECT_EQ(open.codes(), Codes{"lens_uncertain"});
    EXPECT_TRUE(begins(open.judged()[0].text, "k2 is not told by these views: "));
    deviation.k2 = Real::from_ratio(5, 1000);
    EXPECT_EQ(open.codes(), Codes()) << "moves the corner by less than half a pixel";
    deviation.k2 = hundredths(1);
    deviation.p1 = hundredths(1);
    EXPECT_TRUE(begins(open.judged()[0].text, "k2 and p1 are not told by these views: "));
}

TEST(CalibrationWarnings, TellOfPicturesThatAreCopies) {
    Calibrated copies;
    copies.boards[9].used = false;
    copies.boards[9].reason = "the same picture as a1.png";
    copies.estimate.views.pop_back();
    EXPECT_EQ(copies.codes(), Codes{"same_picture"});
    EXPECT_EQ(copies.judged()[0].text, "a9.png is the same picture as a1.png; counted once");
}

TEST(CalibrationWarnings, TellOfManyPicturesWithoutABoard) {
    Calibrated missed;
    SeenBoard none;
    missed.boards.resize(15, none);
    EXPECT_EQ(missed.codes(), Codes());
    missed.boards.resize(16, none);
    EXPECT_EQ(missed.codes(), Codes{"boards_missed"});
    EXPECT_TRUE(begins(missed.judged("right")[0].text, "right: 6 of 16 pictures show no whole board; "));
}

/// The codes of a pair of two good cameras.
Codes codes_of(const PairEstimate& pair, const std::string& right_name = "b0.png") {
    const Calibrated camera;
    std::vector<SeenBoard> right = camera.boards;
    for (std::size_t i = 0; i < right.size(); ++i) right[i].name = "b" + std::to_string(i) + ".png";
    right[0].name = right_name;
    CalibrationWarnings warnings;
    apps::judge_pair(camera.boards, right, camera.estimate, camera.estimate, pair, warnings);
    Codes all;
    for (const apps::CalibrationWarning& warning : warnings) all.insert(warning.code);
    return all;
}

TEST(CalibrationWarnings, TellOfPairsThatDoNotFit) {
    PairEstimate pair;
    pair.views = Calibrated().estimate.views;
    pair.calibration.rms = hundredths(22);
    EXPECT_EQ(codes_of(pair), Codes());
    EXPECT_EQ(codes_of(pair, "right00.png"), Codes{"pair_names"});
    EXPECT_EQ(codes_of(pair, "7/right0.png"), Codes());
    pair.calibration.rms = hundredths(51);
    EXPECT_EQ(codes_of(pair), Codes{"pairs_disagree"});
    pair.views[3].fit.rms = hundredths(90);
    EXPECT_EQ(codes_of(pair), Codes{"bad_pair"});
    pair.views.resize(2);
    pair.calibration.rms = hundredths(22);
    EXPECT_EQ(codes_of(pair), Codes{"few_pairs"});
}

TEST(CalibrationWarnings, AreLinesOfJson) {
    const CalibrationWarnings warnings = {{"bad_view", true, "a \"b\""}, {"few_views", false, "c"}};
    EXPECT_EQ(apps::json_warnings(warnings),
              "\"warnings\":[{\"code\":\"bad_view\",\"doubtful\":true,\"text\":\"a \\\"b\\\"\"},"
              "{\"code\":\"few_views\",\"doubtful\":false,\"text\":\"c\"}],\"doubtful\":true");
    EXPECT_EQ(apps::json_warnings({}), "\"warnings\":[],\"doubtful\":false");
}

TEST(CalibrationProblems, EachSayWhatFailedWhereAndWhatToTry) {
    for (int i = 1; i <= static_cast<int>(CalibrationProblem::no_convergence); ++i) {
        const auto problem = static_cast<CalibrationProblem>(i);
        const std::string line = apps::no_calibration("no calibration", "a.png", problem);
        EXPECT_TRUE(begins(line, "no calibration: "));
        EXPECT_NE(line.find(describe(problem)), std::string::npos) << line;
        EXPECT_NE(line.find(" (a.png); "), std::string::npos) << line;
        EXPECT_EQ(line.find('\n'), std::string::npos);
    }
    EXPECT_EQ(
        apps::no_calibration("no calibration", "", CalibrationProblem::board_behind),
        "no calibration: a part of the board would be behind the camera; look at the corners with --explain, "
        "and leave out a picture where they are wrong");
}

TEST(CalibrationFigures, ShowTwoDigitsOfTheDeviation) {
    EXPECT_EQ(apps::with_deviation(Real::from_ratio(53607, 100), hundredths(85)), "536.07 +- 0.85");
    EXPECT_EQ(apps::with_deviation(Real::from_ratio(-2653, 10000), Real::from_ratio(51, 10000)),
              "-0.2653 +- 0.0051");
    EXPECT_EQ(apps::with_deviation(Real::from_int(536), Real::from_int(12)), "536 +- 12");
    EXPECT_EQ(apps::with_deviation(Real::from_ratio(319, 2), Real()), "159.500 held");
    EXPECT_EQ(apps::with_deviation(Real::one(), Real::from_ratio(1, 1000000000)), "1.000000 +- 0.000000");
}

TEST(CalibrationFigures, MeasureAnglesAndFieldsOfView) {
    const Vector<3> x(Real::one(), Real(), Real());
    const Vector<3> y(Real(), Real::from_int(5), Real());
    EXPECT_EQ(apps::degrees_between(x, y), Decimal::from_int(90));
    EXPECT_EQ(apps::degrees_between(x, -x), Decimal::from_int(180));
    EXPECT_EQ(apps::degrees_between(x, Vector<3>()), Decimal());
    EXPECT_EQ(apps::degrees_of(Matrix<3, 3>::identity()), Decimal());
    // The tangent of half of it is 1/2.
    EXPECT_EQ(apps::number(apps::degrees_of(rotation_about(Vector<3>(Real(), Real::one(), Real()))), 4),
              "53.1301");
    Camera<> camera;
    camera.fx = camera.fy = Real::from_int(320);
    camera.cx = Real::from_int(639, -1);
    camera.cy = Real::from_int(479, -1);
    const apps::FieldOfView field = apps::field_of_view(camera, {640, 480});
    EXPECT_EQ(apps::number(field.across, 3), "90.000");
    EXPECT_EQ(apps::number(field.down, 3), "73.740");
    EXPECT_EQ(apps::number(field.diagonal, 3), "102.680");
}

TEST(NumberInAName, IsTheLastOne) {
    EXPECT_EQ(apps::number_in("left07.jpg"), "07");
    EXPECT_EQ(apps::number_in("2026/left.jpg"), "");
    EXPECT_EQ(apps::number_in("cam2_0113a.png"), "0113");
    EXPECT_EQ(apps::number_in("12"), "12");
}

}  // namespace
}  // namespace fovea::test
