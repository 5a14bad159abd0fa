// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <support/board_corners.hpp>
#include <support/camera_scene.hpp>

namespace fovea::test {
namespace {

constexpr BoardCorners corners = board_corners();

double plain(Real number) { return static_cast<double>(value_of(number)); }

/// The pairs of photos of the chessboard, and its two cameras.
template <class Scalar>
struct Chessboard {
    std::vector<StereoView> views;
    CalibratedCamera<Scalar> left;
    CalibratedCamera<Scalar> right;

    Chessboard() {
        std::vector<PlanarView> lefts;
        std::vector<PlanarView> rights;
        for (int view = 0; view < board_views; ++view) {
            views.push_back({corners.board, corners.left[view], corners.right[view]});
            lefts.push_back({corners.board, corners.left[view]});
            rights.push_back({corners.board, corners.right[view]});
        }
        left = {PlanarRun<Scalar>({lefts.data(), board_views}, board_picture).calibration.camera,
                board_picture};
        right = {PlanarRun<Scalar>({rights.data(), board_views}, board_picture).calibration.camera,
                 board_picture};
    }
    Span<const StereoView> span() const { return {views.data(), static_cast<std::ptrdiff_t>(views.size())}; }
};

StereoOptions estimated() {
    StereoOptions options;
    options.intrinsics = StereoOptions::Intrinsics::estimated;
    return options;
}

TEST(CalibrateStereo, OfTheChessboardIsTheReference) {
    const Chessboard<Real> board;
    const StereoRun<Real> held(board.span(), board.left, board.right);
    ASSERT_TRUE(held.verdict.ok()) << describe(held.verdict.problem);
    const StereoCalibration<>& c = held.calibration;
    // By OpenCV 4.6 from the same corners and its cameras, which end 1e-9 before ours.
    EXPECT_NEAR(plain(c.rms), 0.446846696655, 1e-9);
    EXPECT_NEAR(plain(c.right_from_left.translation[0]), -3.34408158, 1e-8);
    EXPECT_NEAR(plain(c.right_from_left.translation[1]), 0.04158920, 1e-8);
    EXPECT_NEAR(plain(c.right_from_left.rotation(0, 1)), 0.00412096585, 1e-10);
    EXPECT_NEAR(plain(c.right_from_left.rotation(2, 0)), -0.00352015, 1e-8);
    EXPECT_EQ(c.left.fx, board.left.camera.fx);
    EXPECT_EQ(c.right.p2, board.right.camera.p2);
    EXPECT_TRUE(c.left_deviation.fx.zero());
    EXPECT_TRUE(c.refinement.converged);
    EXPECT_LE(c.refinement.linearisations, 8);
    double squares = 0;
    for (const auto& fit : held.fits) squares += plain(fit.rms) * plain(fit.rms) / board_views;
    EXPECT_NEAR(std::sqrt(squares), plain(c.rms), 1e-12);

    const StereoRun<Real> all(board.span(), board.left, board.right, estimated());
    ASSERT_TRUE(all.verdict.ok());
    EXPECT_NEAR(plain(all.calibration.rms), 0.444004723277, 1e-11);
    EXPECT_NEAR(plain(all.calibration.right_from_left.translation[0]), -3.337905719, 1e-8);
    EXPECT_NEAR(plain(all.calibration.left.fx), 536.041045607, 1e-7);
    EXPECT_NEAR(plain(all.calibration.right.fx), 539.613917826, 1e-7);
    EXPECT_LE(all.calibration.refinement.linearisations, 11);
}

TEST(CalibrateStereo, IsTheSameInLongDouble) {
    const Chessboard<Real> board;
    const Chessboard<long double> other;
    for (const StereoOptions& options : {StereoOptions(), estimated()}) {
        const StereoRun<Real> run(board.span(), board.left, board.right, options);
        const StereoRun<long double> same(other.span(), other.left, other.right, options);
        ASSERT_TRUE(run.verdict.ok() && same.verdict.ok());
        const StereoCalibration<>& c = run.calibration;
        const StereoCalibration<long double>& d = same.calibration;
        for (int i = 0; i < 3; ++i) {
            const long double deviation = value_of(c.translation_deviation[i]);
            EXPECT_LE(std::abs(value_of(c.right_from_left.translation[i]) - d.right_from_left.translation[i]),
                      1e-12L * deviation);
            EXPECT_LE(std::abs(deviation - d.translation_deviation[i]), 1e-12L * deviation);
            for (int k = 0; k < 3; ++k)
                EXPECT_LE(
                    std::abs(value_of(c.right_from_left.rotation(i, k)) - d.right_from_left.rotation(i, k)),
                    1e-15L);
        }
        EXPECT_LE(deviations_between(c.left, d.left, c.left_deviation), 1e-11);
        EXPECT_LE(deviations_between(c.right, d.right, c.right_deviation), 1e-11);
    }
}

TEST(CalibrateStereo, TheOtherWayRoundIsTheInverse) {
    // The same sum of squares, so the same bottom.
    const Chessboard<Real> board;
    std::vector<StereoView> swapped;
    for (const StereoView& view : board.views) swapped.push_back({view.board, view.right, view.left});
    const StereoRun<Real> run(board.span(), board.left, board.right, estimated());
    const StereoRun<Real> other({swapped.data(), board_views}, board.right, board.left, estimated());
    ASSERT_TRUE(run.verdict.ok() && other.verdict.ok());
    EXPECT_NEAR(plain(run.calibration.rms), plain(other.calibration.rms), 1e-15);
    const Pose<> back = inverse(other.calibration.right_from_left);
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(plain(run.calibration.right_from_left.translation[i]), plain(back.translation[i]),
                    1e-9 * plain(run.calibration.translation_deviation[i]));
    EXPECT_LE(
        deviations_between(run.calibration.left, other.calibration.right, run.calibration.left_deviation),
        1e-9);
}

TEST(CalibrateStereo, FindsRandomRigs) {
    for (unsigned i = 0; i < 12; ++i) {
        const StereoScene scene = random_rig(5000 + i);
        // From cameras that are some percent off.
        Noise random(i);
        const auto about = [&](const Camera<double>& camera) {
            Camera<> result;
            const double scale = random.between(0.97, 1.03);
            result.fx = real_of(camera.fx * scale);
            result.fy = real_of(camera.fy * scale);
            result.cx = real_of(camera.cx + random.between(-5.0, 5.0));
            result.cy = real_of(camera.cy + random.between(-5.0, 5.0));
            return result;
        };
        const CalibratedCamera<> left{about(scene.left.camera), scene.left.picture};
        const CalibratedCamera<> right{about(scene.right.camera), scene.right.picture};
        const StereoRun<Real> run(scene.span(), left, right, estimated());
        ASSERT_TRUE(run.verdict.ok()) << i << describe(run.verdict.problem);
        const StereoCalibration<>& c = run.calibration;
        EXPECT_LE(deviations_between(c.left, scene.left.camera, c.left_deviation), 4.5) << i;
        EXPECT_LE(deviations_between(c.right, scene.right.camera, c.right_deviation), 4.5) << i;
        for (int k = 0; k < 3; ++k)
            EXPECT_LE(
                std::abs(plain(c.right_from_left.translation[k]) - scene.right_from_left.translation[k]),
                4.5 * plain(c.translation_deviation[k]));
        const double points = 2 * board_points * static_cast<double>(scene.views.size());
        const double spare = 2 * points - 22 - 6 * static_cast<double>(scene.views.size());
        EXPECT_NEAR(plain(c.rms) / (scene.left.noise * std::sqrt(spare / points)), 1,
                    4 / std::sqrt(2 * spare));
    }
}

// ---- What is refused ----------------------------------------------------------------------

void expect_refused(Span<const StereoView> views, const Chessboard<Real>& board, CalibrationProblem problem,
                    int view, const StereoOptions& options = {}) {
    std::vector<std::uint8_t> scratch(
        static_cast<std::size_t>(calibrate_stereo_scratch(static_cast<int>(views.size()))));
    std::vector<CalibratedView<>> fits(static_cast<std::size_t>(views.size()));
    StereoCalibration<> calibration;
    calibration.rms = Real::from_int(77);
    const CalibrationVerdict verdict =
        calibrate_stereo<Real>(views, board.left, board.right, options,
                               {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())},
                               {fits.data(), views.size()}, calibration);
    EXPECT_EQ(verdict.problem, problem) << describe(verdict.problem);
    EXPECT_EQ(verdict.view, view);
    EXPECT_EQ(calibration.rms, Real::from_int(77));
}

TEST(CalibrateStereo, RefusesByName) {
    using Problem = CalibrationProblem;
    const Chessboard<Real> board;
    expect_refused({}, board, Problem::too_few_views, -1);
    expect_refused(board.span().first(1), board, Problem::too_few_views, -1, estimated());
    EXPECT_TRUE(StereoRun<Real>(board.span().first(1), board.left, board.right).verdict.ok());
    const StereoView again[] = {board.views[0], board.views[0], board.views[0]};
    expect_refused(again, board, Problem::parallel_views, -1, estimated());

    auto views = board.views;
    const Span<const StereoView> span(views.data(), board_views);
    views[5].right = views[5].right.first(53);
    expect_refused(span, board, Problem::size_mismatch, 5);
    views[5] = {views[5].board.first(3), views[5].left.first(3), views[5].right.first(3)};
    expect_refused(span, board, Problem::too_few_points, 5);
    views[5] = {corners.board, corners.left[5], corners.right[5]};
    views[8] = {views[8].board.first(9), views[8].left.first(9), views[8].right.first(9)};
    expect_refused(span, board, Problem::collinear_points, 8);
    views = board.views;
    std::vector<SubPixelPoint> moved(corners.right[2], corners.right[2] + board_points);
    moved[3].y = SubPixel::from_int(-2);
    views[2].right = {moved.data(), board_points};
    expect_refused(span, board, Problem::outside_picture, 2);
    const PlanePoint square[] = {{0, 0}, {8, 0}, {8, 8}, {0, 8}};
    const auto at = [](int x, int y) { return SubPixelPoint{SubPixel::from_int(x), SubPixel::from_int(y)}; };
    const SubPixelPoint crossed[] = {at(100, 100), at(300, 100), at(100, 320), at(300, 300)};
    const SubPixelPoint seen[] = {at(100, 100), at(300, 100), at(300, 300), at(100, 300)};
    views[2] = {square, seen, crossed};
    expect_refused(span, board, Problem::board_behind, 2);

    Chessboard<Real> wrong = board;
    wrong.right.picture.height = 0;
    expect_refused(board.span(), wrong, Problem::bad_argument, -1);
    wrong = board;
    wrong.left.camera.fy = Real();
    expect_refused(board.span(), wrong, Problem::bad_argument, -1);
}

TEST(CalibrateStereo, RefusesScratchThatIsTooSmall) {
    const Chessboard<Real> board;
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(calibrate_stereo_scratch(board_views)));
    std::vector<CalibratedView<>> fits(board_views);
    StereoCalibration<> calibration;
    const auto bytes = static_cast<std::ptrdiff_t>(scratch.size());
    const auto call = [&](std::ptrdiff_t room, std::ptrdiff_t count) {
        return calibrate_stereo<Real>(board.span(), board.left, board.right, estimated(),
                                      {scratch.data(), room}, {fits.data(), count}, calibration);
    };
    const CalibrationVerdict refused{CalibrationProblem::scratch_too_small, -1};
    EXPECT_EQ(call(bytes - 1, board_views), refused);
    EXPECT_EQ(call(bytes, board_views - 1), refused);
    EXPECT_EQ(call(bytes, board_views), CalibrationVerdict());
}

}  // namespace
}  // namespace fovea::test
