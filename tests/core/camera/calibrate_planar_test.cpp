// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

#include <support/board_corners.hpp>
#include <support/camera_scene.hpp>

namespace fovea::test {
namespace {

constexpr BoardCorners corners = board_corners();

double plain(Real number) { return static_cast<double>(value_of(number)); }

/// The views of one of the two cameras that saw the chessboard.
std::vector<PlanarView> chessboard(const SubPixelPoint (&seen)[board_views][board_points],
                                   const PlanePoint (&board)[board_points] = corners.board) {
    std::vector<PlanarView> views;
    for (const auto& points : seen) views.push_back({board, points});
    return views;
}
Span<const PlanarView> span_of(const std::vector<PlanarView>& views) {
    return {views.data(), static_cast<std::ptrdiff_t>(views.size())};
}

/// What the chessboard's cameras are by the same least squares in __float128, and by OpenCV 4.6 to what its
/// steps leave; the standard deviations.
struct Reference {
    double rms;
    double terms[camera_terms];
    double deviations[camera_terms];
};
constexpr Reference left_reference = {0.408256475887,
                                      {536.454766207, 536.406519322, 342.367759491, 235.542658456,
                                       -0.2786528930, 0.0672480489, 0, 0.00182148412, -0.00034478546},
                                      {0.876, 0.920, 0.972, 1.07, 4.74e-3, 1.69e-2, 0, 2.35e-4, 2.97e-4}};
constexpr Reference right_reference = {0.457804055179,
                                       {542.251824475, 541.519034898, 328.319345858, 246.995155923,
                                        -0.2776968443, 0.0886215320, 0, -0.00056296950, 0.00128721792},
                                       {1.07, 1.04, 1.17, 1.17, 4.20e-3, 7.51e-3, 0, 2.38e-4, 5.57e-4}};

void expect_reference(const PlanarRun<Real>& run, const Reference& reference) {
    ASSERT_EQ(run.verdict, CalibrationVerdict());
    EXPECT_NEAR(plain(run.calibration.rms), reference.rms, 1e-12);
    for (int i = 0; i < camera_terms; ++i) {
        const auto term = static_cast<CameraTerm>(i);
        // Ten digits are told.
        EXPECT_NEAR(plain(term_of(run.calibration.camera, term)), reference.terms[i],
                    1e-9 * std::abs(reference.terms[i]) + 1e-11);
        EXPECT_NEAR(plain(term_of(run.calibration.deviation, term)), reference.deviations[i],
                    5e-3 * reference.deviations[i]);
    }
    EXPECT_TRUE(run.calibration.refinement.converged);
    EXPECT_LE(run.calibration.refinement.linearisations, 12);
    // The views' squares are those of all.
    double squares = 0;
    for (const auto& fit : run.fits) squares += plain(fit.rms) * plain(fit.rms) / board_views;
    EXPECT_NEAR(std::sqrt(squares), reference.rms, 1e-12);
}

TEST(CalibratePlanar, OfTheChessboardIsTheReference) {
    const PlanarRun<Real> left(span_of(chessboard(corners.left)), board_picture);
    expect_reference(left, left_reference);
    // By OpenCV too.
    EXPECT_NEAR(plain(left.fits[0].rms), 0.192365, 1e-6);
    expect_reference(PlanarRun<Real>(span_of(chessboard(corners.right)), board_picture), right_reference);
}

TEST(CalibratePlanar, IsTheSameInDoubleAndLongDouble) {
    const auto views = chessboard(corners.left);
    const PlanarRun<Real> run(span_of(views), board_picture);
    const PlanarRun<double> in_double(span_of(views), board_picture);
    const PlanarRun<long double> in_long(span_of(views), board_picture);
    ASSERT_TRUE(run.verdict.ok() && in_double.verdict.ok() && in_long.verdict.ok());
    const PlanarCalibration<>& c = run.calibration;
    EXPECT_LE(deviations_between(c.camera, in_double.calibration.camera, c.deviation), 1e-9);
    // Both have 64 digits.
    EXPECT_LE(deviations_between(c.camera, in_long.calibration.camera, c.deviation), 1e-13);
    EXPECT_LE(deviations_between(c.deviation, in_long.calibration.deviation, c.deviation), 1e-13);
    for (std::size_t view = 0; view < board_views; ++view)
        for (int i = 0; i < 3; ++i) {
            const auto& fit = run.fits[view];
            const auto& other = in_long.fits[view];
            const long double deviation = value_of(fit.translation_deviation[i]);
            EXPECT_LE(std::abs(value_of(fit.pose.translation[i]) - other.pose.translation[i]),
                      1e-12L * deviation);
            EXPECT_LE(std::abs(deviation - other.translation_deviation[i]), 1e-12L * deviation);
            EXPECT_LE(std::abs(value_of(fit.rotation_deviation[i]) - other.rotation_deviation[i]), 1e-14L);
        }
}

TEST(CalibratePlanar, KnowsNoUnitsOfTheBoard) {
    // Squares of 2, so that the middle of the board is whole.
    constexpr BoardCorners small = board_corners(2);
    constexpr BoardCorners wide = board_corners(128);
    const PlanarRun<Real> one(span_of(chessboard(corners.right, small.board)), board_picture);
    const PlanarRun<Real> other(span_of(chessboard(corners.right, wide.board)), board_picture);
    ASSERT_TRUE(one.verdict.ok() && other.verdict.ok());
    // A power of two rounds nothing.
    for (int i = 0; i < camera_terms; ++i) {
        const auto term = static_cast<CameraTerm>(i);
        EXPECT_EQ(term_of(one.calibration.camera, term), term_of(other.calibration.camera, term));
        EXPECT_EQ(term_of(one.calibration.deviation, term), term_of(other.calibration.deviation, term));
    }
    for (std::size_t view = 0; view < board_views; ++view) {
        EXPECT_EQ(one.fits[view].pose.rotation, other.fits[view].pose.rotation);
        for (int i = 0; i < 3; ++i) {
            EXPECT_EQ(one.fits[view].pose.translation[i].scaled(6), other.fits[view].pose.translation[i]);
            EXPECT_EQ(one.fits[view].translation_deviation[i].scaled(6),
                      other.fits[view].translation_deviation[i]);
        }
    }
}

TEST(CalibratePlanar, EstimatesWhatIsAskedFor) {
    const auto views = chessboard(corners.left);
    double last = 10;
    for (const LensTerms lens :
         {LensTerms::none, LensTerms::k1_k2, LensTerms::k1_k2_p1_p2, LensTerms::k1_k2_k3_p1_p2}) {
        IntrinsicsOptions options;
        options.lens = lens;
        const PlanarRun<Real> run(span_of(views), board_picture, options);
        ASSERT_TRUE(run.verdict.ok());
        const Camera<>& camera = run.calibration.camera;
        const Camera<>& deviation = run.calibration.deviation;
        EXPECT_EQ(camera.k1.zero(), lens == LensTerms::none);
        EXPECT_EQ(deviation.k2.zero(), lens == LensTerms::none);
        EXPECT_EQ(camera.p1.zero(), lens == LensTerms::none || lens == LensTerms::k1_k2);
        EXPECT_EQ(deviation.p2.zero(), camera.p1.zero());
        EXPECT_EQ(camera.k3.zero(), lens != LensTerms::k1_k2_k3_p1_p2);
        EXPECT_EQ(deviation.k3.zero(), camera.k3.zero());
        // More terms fit closer. By OpenCV 4.6 from these corners too.
        EXPECT_LT(plain(run.calibration.rms), last);
        last = plain(run.calibration.rms);
        if (lens == LensTerms::k1_k2_k3_p1_p2) {
            EXPECT_NEAR(last, 0.408003335015, 1e-11);
        }
        if (lens == LensTerms::k1_k2) {
            EXPECT_NEAR(last, 0.417496545339, 1e-11);
        }
    }
    IntrinsicsOptions options;
    options.pixels = PixelShape::square;
    options.principal_point = PrincipalPoint::held;
    const PlanarRun<Real> run(span_of(views), board_picture, options);
    ASSERT_TRUE(run.verdict.ok());
    EXPECT_EQ(run.calibration.camera.fx, run.calibration.camera.fy);
    EXPECT_EQ(run.calibration.deviation.fx, run.calibration.deviation.fy);
    EXPECT_EQ(run.calibration.camera.cx, Real::from_ratio(639, 2));
    EXPECT_EQ(run.calibration.camera.cy, Real::from_ratio(479, 2));
    EXPECT_TRUE(run.calibration.deviation.cx.zero() && run.calibration.deviation.cy.zero());
    // One view is enough then.
    const PlanarRun<Real> alone(span_of(views).first(1), board_picture, options);
    ASSERT_TRUE(alone.verdict.ok());
    EXPECT_LT(std::abs(plain(alone.calibration.camera.fx - run.calibration.camera.fx)),
              5 * plain(alone.calibration.deviation.fx));
}

TEST(CalibratePlanar, FindsRandomCameras) {
    for (unsigned i = 0; i < 12; ++i) {
        const CameraScene scene = random_scene(1000 + i);
        const PlanarRun<Real> run(scene.span(), scene.picture);
        const PlanarRun<long double> same(scene.span(), scene.picture);
        ASSERT_TRUE(run.verdict.ok() && same.verdict.ok()) << i << describe(run.verdict.problem);
        const PlanarCalibration<>& c = run.calibration;
        EXPECT_LE(deviations_between(c.camera, same.calibration.camera, c.deviation), 1e-9) << i;
        // Of 12 x 8 normal numbers none is beyond 4.5 but in one of 1000 runs.
        EXPECT_LE(deviations_between(c.camera, scene.camera, c.deviation), 4.5) << i;
        const double points = board_points * static_cast<double>(scene.views.size());
        const double spare = 2 * points - 8 - 6 * static_cast<double>(scene.views.size());
        // The deviation of a mean of `spare` squares, four times.
        EXPECT_NEAR(plain(c.rms) / (scene.noise * std::sqrt(spare / points)), 1, 4 / std::sqrt(2 * spare));
    }
}

// ---- What is refused ----------------------------------------------------------------------

/// Calibrates and expects to be refused, with nothing written.
void expect_refused(Span<const PlanarView> views, CalibrationProblem problem, int view,
                    Size picture = board_picture, const IntrinsicsOptions& options = {}) {
    const std::size_t bytes =
        static_cast<std::size_t>(calibrate_planar_scratch(static_cast<int>(views.size())));
    std::vector<std::uint8_t> scratch(bytes);
    std::vector<CalibratedView<>> fits(static_cast<std::size_t>(views.size()));
    PlanarCalibration<> calibration;
    calibration.rms = Real::from_int(77);
    for (auto& fit : fits) fit.rms = Real::from_int(78);
    const CalibrationVerdict verdict =
        calibrate_planar<Real>(views, picture, options, {scratch.data(), static_cast<std::ptrdiff_t>(bytes)},
                               {fits.data(), views.size()}, calibration);
    EXPECT_EQ(verdict.problem, problem) << describe(verdict.problem);
    EXPECT_EQ(verdict.view, view);
    EXPECT_EQ(calibration.rms, Real::from_int(77));
    for (const auto& fit : fits) EXPECT_EQ(fit.rms, Real::from_int(78));
}

TEST(CalibratePlanar, RefusesTooLittle) {
    auto views = chessboard(corners.left);
    using Problem = CalibrationProblem;
    expect_refused(span_of(views).first(1), Problem::too_few_views, -1);
    expect_refused({}, Problem::too_few_views, -1);
    IntrinsicsOptions held;
    held.principal_point = PrincipalPoint::held;
    expect_refused({}, Problem::too_few_views, -1, board_picture, held);
    // The square of four corners in two views: 16 equations, 20 unknowns.
    const PlanePoint square[] = {{0, 0}, {8, 0}, {0, 5}, {8, 5}};
    const auto corner = [&](std::size_t view) {
        const SubPixelPoint* seen = corners.left[view];
        return std::vector<SubPixelPoint>{seen[0], seen[8], seen[45], seen[53]};
    };
    const std::vector<SubPixelPoint> seen[] = {corner(0), corner(5)};
    const PlanarView two[] = {{square, {seen[0].data(), 4}}, {square, {seen[1].data(), 4}}};
    expect_refused(two, Problem::too_few_points, -1);
    views[3].board = views[3].board.first(3);
    views[3].seen = views[3].seen.first(3);
    expect_refused(span_of(views), Problem::too_few_points, 3);
    views[3].seen = corners.left[3];
    expect_refused(span_of(views), Problem::size_mismatch, 3);
}

TEST(CalibratePlanar, RefusesPointsThatAreNotOfAPicture) {
    using Problem = CalibrationProblem;
    const auto views = chessboard(corners.left);
    expect_refused(span_of(views), Problem::bad_argument, -1, Size{0, 480});
    expect_refused(span_of(views), Problem::bad_argument, -1, Size{640, 40000});
    expect_refused(span_of(views), Problem::outside_picture, 0, Size{320, 240});
    std::vector<SubPixelPoint> seen(corners.left[7], corners.left[7] + board_points);
    for (const int raw : {-129, 640 * 256 - 127, 2147483647, -2147483647 - 1}) {
        auto moved = seen;
        moved[20].x = SubPixel::from_raw(raw);
        auto changed = views;
        changed[7].seen = {moved.data(), board_points};
        expect_refused(span_of(changed), Problem::outside_picture, 7);
    }
}

TEST(CalibratePlanar, RefusesViewsThatTellNothing) {
    using Problem = CalibrationProblem;
    auto views = chessboard(corners.left);
    // One row of the board; points of a line in the picture; one place alone.
    views[2].board = views[2].board.first(9);
    views[2].seen = views[2].seen.first(9);
    expect_refused(span_of(views), Problem::collinear_points, 2);
    views = chessboard(corners.left);
    std::vector<SubPixelPoint> line(board_points);
    for (int i = 0; i < board_points; ++i)
        line[static_cast<std::size_t>(i)] = {SubPixel::from_int(100 + 3 * i), SubPixel::from_int(80 + 4 * i)};
    views[4].seen = {line.data(), board_points};
    expect_refused(span_of(views), Problem::collinear_points, 4);
    const std::vector<PlanePoint> same(board_points);
    views[4] = {{same.data(), board_points}, corners.left[4]};
    expect_refused(span_of(views), Problem::collinear_points, 4);
    // Places that would be on both sides of the horizon: a square that is crossed.
    views = chessboard(corners.left);
    const PlanePoint square[] = {{0, 0}, {8, 0}, {8, 8}, {0, 8}};
    const auto at = [](int x, int y) { return SubPixelPoint{SubPixel::from_int(x), SubPixel::from_int(y)}; };
    const SubPixelPoint crossed[] = {at(100, 100), at(300, 100), at(100, 320), at(300, 300)};
    views[6] = {square, crossed};
    expect_refused(span_of(views), Problem::board_behind, 6);
}

TEST(CalibratePlanar, RefusesParallelViews) {
    // Turned about the normal, moved, with and without a lens, tilted or not: always parallel.
    for (const double tilt : {0.0, 0.3, 0.6})
        for (const double lens : {0.0, 1.0}) {
            if (tilt == 0.3 && lens == 0.0) continue;
            Noise random(40);
            CameraScene scene;
            draw_camera(scene, random);
            scene.camera.k1 *= lens;
            scene.camera.k2 *= lens;
            while (scene.seen.size() < 6) {
                Pose<double> pose = draw_pose(scene, random);
                const Vector<3, double> middle(100.0, 62.5, 0.0);
                const Vector<3, double> place = pose(middle);
                pose.rotation = turn(tilt, tilt / 2, 0) * turn(0, 0, random.between(-1.5, 1.5));
                pose.translation = place - pose.rotation * middle;
                auto seen = seen_by(scene.camera, scene.picture, pose, scene.board, scene.noise, random);
                if (!seen.empty()) scene.add(std::move(seen));
            }
            scene.collect();
            expect_refused(scene.span(), CalibrationProblem::parallel_views, -1, scene.picture);
            if (tilt > 0) continue;
            // From the front not even a focal length is told.
            IntrinsicsOptions held;
            held.principal_point = PrincipalPoint::held;
            expect_refused(scene.span(), CalibrationProblem::parallel_views, -1, scene.picture, held);
        }
    // The same photo again and again.
    const auto views = chessboard(corners.left);
    const PlanarView again[] = {views[0], views[0], views[0]};
    expect_refused(again, CalibrationProblem::parallel_views, -1);
}

TEST(CalibratePlanar, RefusesScratchThatIsTooSmall) {
    const auto views = chessboard(corners.left);
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(calibrate_planar_scratch(board_views)));
    std::vector<CalibratedView<>> fits(board_views);
    PlanarCalibration<> calibration;
    const auto bytes = static_cast<std::ptrdiff_t>(scratch.size());
    const auto call = [&](std::ptrdiff_t room, std::ptrdiff_t count) {
        return calibrate_planar<Real>(span_of(views), board_picture, {}, {scratch.data(), room},
                                      {fits.data(), count}, calibration);
    };
    const CalibrationVerdict refused{CalibrationProblem::scratch_too_small, -1};
    EXPECT_EQ(call(bytes - 1, board_views), refused);
    EXPECT_EQ(call(bytes, board_views - 1), refused);
    EXPECT_EQ(call(bytes, board_views), CalibrationVerdict());
}

TEST(CalibrationProblem, HasPhrasesAndStatus) {
    for (int i = 0; i <= static_cast<int>(CalibrationProblem::no_convergence); ++i) {
        const auto problem = static_cast<CalibrationProblem>(i);
        EXPECT_STRNE(describe(problem), "unknown problem");
        EXPECT_EQ(status_of(problem) == Status::ok, i == 0);
    }
    EXPECT_STREQ(describe(static_cast<CalibrationProblem>(200)), "unknown problem");
}

}  // namespace
}  // namespace fovea::test
