// SPDX-License-Identifier: MIT
//
// Golden vectors of calibrations, and of the least squares that they are made of.
#pragma once

#include <cstdint>

#include <fovea/base/random.hpp>
#include <fovea/base/span.hpp>
#include <fovea/camera/calibrate_planar.hpp>
#include <fovea/camera/planar_start.hpp>
#include <fovea/camera/projection_derivatives.hpp>
#include <fovea/linear/block_equations.hpp>
#include <fovea/linear/levenberg_marquardt.hpp>
#include <fovea/stereo/calibrate_stereo.hpp>
#include <golden/camera_vectors.hpp>
#include <golden/digest.hpp>
#include <golden/number_vectors.hpp>
#include <golden/workspace.hpp>

namespace fovea::golden {

inline void put(Digest& digest, const Refinement<>& refinement) {
    digest.add(refinement.cost, refinement.linearisations, refinement.costs, refinement.converged);
}
inline void put(Digest& digest, CalibrationVerdict verdict) {
    digest.add(verdict.problem, verdict.view, verdict.ok(), status_of(verdict.problem));
}
inline void put(Digest& digest, const CalibratedView<>& fit) {
    digest.add(fit.pose, fit.rotation_deviation, fit.translation_deviation, fit.rms);
}

/// Some points of a board before a camera.
struct SmallBoard {
    static constexpr int points = 6;
    PlanePoint board[points] = {{0, 0}, {40, 0}, {80, 5}, {0, 60}, {45, 55}, {80, 60}};
    Camera<> camera;

    SmallBoard() {
        camera.fx = camera.fy = Real::from_int(600);
        camera.cx = Real::from_ratio(639, 2);
        camera.cy = Real::from_ratio(479, 2);
        camera.k1 = Real::from_ratio(-1, 10);
    }
    static Pose<> pose(int number) {
        const Vector<3> axis(Real::from_ratio(number * 5 - 4, 8), Real::from_ratio(3 - number * 2, 6),
                             Real::from_ratio(number, 9));
        return {rotation_about(axis),
                Vector<3>(Real::from_int(-40), Real::from_int(-30 + 8 * number), Real::from_int(140))};
    }
    /// With noise of half a pixel.
    void see(const Pose<>& from, Random& random, SubPixelPoint (&seen)[points]) const {
        for (int i = 0; i < points; ++i) {
            const auto pixel = *project(
                camera, from, Vector<3>(Real::from_int(board[i].x), Real::from_int(board[i].y), Real()));
            const std::int32_t x = random.between(-128, 128);
            const std::int32_t y = random.between(-128, 128);
            seen[i] = {pixel[0].to_fixed<SubPixel>() + SubPixel::from_raw(x),
                       pixel[1].to_fixed<SubPixel>() + SubPixel::from_raw(y)};
        }
    }
};

/// sqrt(a x + b) through some points: two unknowns.
struct RootProblem {
    Real right[5];

    Status linearise(const Vector<2>& at, NormalEquations<2>& equations) const {
        for (int i = 0; i < 5; ++i) {
            const Real square = at[0] * Real::from_int(i) + at[1];
            if (!square.positive()) return Status::out_of_range;
            const Real root = square.square_root();
            const Real slope = Real::from_ratio(1, 2) / root;
            equations.add(Vector<2>(slope * Real::from_int(i), slope), root - right[i]);
        }
        return Status::ok;
    }
    Result<Real> cost(const Vector<2>& at) const {
        NormalEquations<2> equations;
        const Status status = linearise(at, equations);
        if (status != Status::ok) return status;
        return equations.cost;
    }
    Vector<2> moved(const Vector<2>& at, const Vector<2>& step) const { return at + step; }
};

inline void linear_levenberg_marquardt(Workspace&, Digest& digest) {
    Random random(91);
    for (int k = 0; k < 3; ++k) {
        RootProblem problem;
        for (int i = 0; i < 5; ++i)
            problem.right[i] = Real::from_int(random.between(1000, 1600) + 400 * i, -10);
        Vector<2> state(Real::from_int(3), Real::from_int(2));
        const auto done = levenberg_marquardt<2, Real>(problem, state);
        digest.add(done, state);
        NormalEquations<2> equations;
        digest.add(problem.linearise(state, equations));
        digest.add(equations.inverse());
    }
}

inline void linear_block_equations(Workspace& work, Digest& digest) {
    constexpr int views = 2;
    constexpr int shared = 3;
    Random random(92);
    Arena arena(work.scratch_span());
    const auto words = arena.take<std::int64_t>(block_equations_words<2>(shared));
    BlockEquations<2> equations(shared, views, arena.take<Real>(block_equations_scratch<2>(shared, views)),
                                words);
    equations.clear();
    for (int view = 0; view < views; ++view)
        for (int i = 0; i < 20; ++i) {
            auto row = random_matrix<shared, 1>(random);
            if (i % 3 == 0) row[1] = Real();
            const auto own = random_matrix<2, 1>(random);
            const auto residual = random_matrix<1, 1>(random);
            equations.add(view, Span<const Real>(&row[0], shared), own, residual[0]);
        }
    equations.finish();
    Real gain;
    for (const int damping : {-2, detail::undamped}) {
        digest.add(equations.solve(damping, gain));
        digest.add(gain, equations.cost(), equations.shared_step(), equations.own_step(0),
                   equations.own_step(1));
    }
    equations.invert();
    for (int i = 0; i < equations.shared(); ++i) digest.add(equations.shared_variance(i));
    for (int view = 0; view < equations.views(); ++view) digest.add(equations.own_variances(view));
}

inline void camera_projection_derivatives(Workspace&, Digest& digest) {
    Random random(93);
    for (int i = 0; i < 6; ++i) {
        const Camera<> camera = random_camera(random);
        const auto place = random_matrix<3, 1>(random);
        ProjectionDerivatives<> derivatives;
        digest.add(project_derivatives(camera, place, derivatives));
        digest.add(derivatives.pixel, derivatives.by_camera, derivatives.by_point,
                   by_pose(derivatives.by_point.row(1), place));
        const auto step = random_matrix<6, 1>(random);
        digest.add(moved(Pose<>(), step));
    }
}

inline void camera_calibrate_planar(Workspace& work, Digest& digest) {
    for (int i = 0; i < camera_terms; ++i)
        digest.add(term_of(SmallBoard().camera, static_cast<CameraTerm>(i)));
    constexpr int views = 3;
    const SmallBoard board;
    Random random(94);
    SubPixelPoint seen[views][SmallBoard::points];
    PlanarView all[views];
    FocalStart<> start(Size{640, 480});
    for (int view = 0; view < views; ++view) {
        board.see(SmallBoard::pose(view), random, seen[view]);
        all[view] = {board.board, seen[view]};
        if (view != 1) continue;
        const auto homography = fit_homography(all[view].board, all[view].seen);
        digest.add(homography);
        start.add(*homography);
        digest.add(pose_of_plane(board.camera, *homography));
    }
    digest.add(start.camera());
    IntrinsicsOptions options;
    options.lens = LensTerms::k1_k2;
    options.principal_point = PrincipalPoint::held;
    options.pixels = PixelShape::square;
    CalibratedView<> fits[views];
    PlanarCalibration<> calibration;
    digest.add(calibrate_planar<Real>(Span<const PlanarView>(all), Size{640, 480}, options,
                                      work.scratch_span(), Span<CalibratedView<>>(fits), calibration));
    digest.add(calibration.camera, calibration.deviation, calibration.rms, calibration.refinement);
    digest.add(Span<const CalibratedView<>>(fits));
    // One view leaves the principal point open.
    digest.add(calibrate_planar<Real>(Span<const PlanarView>(all, 1), Size{640, 480}, {}, work.scratch_span(),
                                      Span<CalibratedView<>>(fits), calibration));
    put_text(digest, describe(CalibrationProblem::too_few_views));
}

inline void stereo_calibrate_stereo(Workspace& work, Digest& digest) {
    constexpr int views = 1;
    const SmallBoard board;
    const Pose<> way{rotation_about(Vector<3>(Real::from_ratio(1, 50), Real::from_ratio(1, 9), Real())),
                     Vector<3>(Real::from_int(-20), Real::from_int(1), Real::from_int(2))};
    Random random(95);
    SubPixelPoint left[views][SmallBoard::points];
    SubPixelPoint right[views][SmallBoard::points];
    StereoView all[views];
    for (int view = 0; view < views; ++view) {
        const Pose<> pose = SmallBoard::pose(view);
        board.see(pose, random, left[view]);
        board.see(compose(way, pose), random, right[view]);
        all[view] = {board.board, left[view], right[view]};
    }
    CalibratedView<> fits[views];
    StereoCalibration<> calibration;
    const CalibratedCamera<> camera{board.camera, Size{640, 480}};
    digest.add(calibrate_stereo<Real>(Span<const StereoView>(all), camera, camera, {}, work.scratch_span(),
                                      Span<CalibratedView<>>(fits), calibration));
    digest.add(calibration.right_from_left, calibration.rotation_deviation, calibration.translation_deviation,
               calibration.left, calibration.right_deviation, calibration.rms, calibration.refinement);
    digest.add(Span<const CalibratedView<>>(fits));
}

}  // namespace fovea::golden
