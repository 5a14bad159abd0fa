// SPDX-License-Identifier: MIT
//
// A camera and poses to start from, out of homographies between a board and its pictures.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/camera/calibration.hpp>
#include <fovea/camera/camera.hpp>
#include <fovea/camera/pose.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/linear/levenberg_marquardt.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/match/fit_homography.hpp>
#include <fovea/match/point_pair.hpp>
#include <fovea/number/int128.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/number/scalar.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The focal lengths that homographies tell, with the principal point in the centre of the picture and no
/// lens: to some percent, where boards are tilted.
///
/// The two axes of a board are square to each other and of one length, and so are its diagonals: two
/// equations a homography, linear in 1 / fx^2 and 1 / fy^2.
///
/// Source  Zhang, "A flexible new technique for camera calibration", IEEE PAMI 22(11), 2000, eq. 3 and 4,
///         with the principal point held: five unknowns from real views may be far off, two are not
template <class Scalar = Real>
class FocalStart {
public:
    constexpr explicit FocalStart(Size picture);

    constexpr void add(const Matrix<3, 3, Scalar>& homography);
    /// Where the homographies leave the two open, or tell pixels that are twice as wide as high, one for
    /// both; where they leave that open too, the longer side of the picture.
    constexpr Camera<Scalar> camera() const;

private:
    Size picture_;
    /// Sums for the equations a / fx^2 + b / fy^2 + c = 0.
    Scalar aa_ = scalar_of<Scalar>(0);
    Scalar ab_ = scalar_of<Scalar>(0);
    Scalar bb_ = scalar_of<Scalar>(0);
    Scalar ac_ = scalar_of<Scalar>(0);
    Scalar bc_ = scalar_of<Scalar>(0);
};

/// The pose of a plane that a camera without lens sees by a homography with a divisor above 0, which places
/// it in front of the camera.
///
/// Errors  degenerate where the homography has no two axes
/// Source  as above, section 3.1; the axes are made square to each other by turning both as far
template <class Scalar>
constexpr Result<Pose<Scalar>> pose_of_plane(const Camera<Scalar>& camera,
                                             const Matrix<3, 3, Scalar>& homography);

// ---- Implementation ---------------------------------------------------------------

template <class Scalar>
constexpr FocalStart<Scalar>::FocalStart(Size picture) : picture_(picture) {}

template <class Scalar>
constexpr void FocalStart<Scalar>::add(const Matrix<3, 3, Scalar>& homography) {
    const Scalar cx = scalar_of<Scalar>(picture_.width - 1, -1);
    const Scalar cy = scalar_of<Scalar>(picture_.height - 1, -1);
    Vector<3, Scalar> axes[2];
    for (int c = 0; c < 2; ++c)
        axes[c] = Vector<3, Scalar>(homography(0, c) - cx * homography(2, c),
                                    homography(1, c) - cy * homography(2, c), homography(2, c));
    const auto equation = [&](const Vector<3, Scalar>& p, const Vector<3, Scalar>& q) {
        const Scalar size = square_root(dot(p, p) * dot(q, q));
        if (size == scalar_of<Scalar>(0)) return;
        const Scalar share = scalar_of<Scalar>(1) / size;
        const Scalar a = p[0] * q[0] * share;
        const Scalar b = p[1] * q[1] * share;
        const Scalar c = p[2] * q[2] * share;
        aa_ = aa_ + a * a;
        ab_ = ab_ + a * b;
        bb_ = bb_ + b * b;
        ac_ = ac_ - a * c;
        bc_ = bc_ - b * c;
    };
    equation(axes[0], axes[1]);
    equation(axes[0] + axes[1], axes[0] - axes[1]);
}

template <class Scalar>
constexpr Camera<Scalar> FocalStart<Scalar>::camera() const {
    const Scalar zero = scalar_of<Scalar>(0);
    Camera<Scalar> result;
    result.cx = scalar_of<Scalar>(picture_.width - 1, -1);
    result.cy = scalar_of<Scalar>(picture_.height - 1, -1);
    const Scalar size = aa_ * bb_ - ab_ * ab_;
    // 1 / fx^2 and 1 / fy^2 times size.
    const Scalar x = ac_ * bb_ - bc_ * ab_;
    const Scalar y = bc_ * aa_ - ac_ * ab_;
    const Scalar side = scalar_of<Scalar>(maximum(picture_.width, picture_.height));
    // Between an eighth and 16 times the longer side.
    const auto sane = [&](Scalar focal) { return scale(side, -3) < focal && focal < scale(side, 4); };
    if (scale(aa_ * bb_, -20) < size && zero < x && zero < y && x < scale(y, 2) && y < scale(x, 2)) {
        result.fx = square_root(size / x);
        result.fy = square_root(size / y);
        if (sane(result.fx) && sane(result.fy)) return result;
    }
    const Scalar sum = aa_ + bb_ + scale(ab_, 1);
    const Scalar both = ac_ + bc_;
    result.fx = side;
    if (zero < both && zero < sum) {
        const Scalar focal = square_root(sum / both);
        if (sane(focal)) result.fx = focal;
    }
    result.fy = result.fx;
    return result;
}

template <class Scalar>
constexpr Result<Pose<Scalar>> pose_of_plane(const Camera<Scalar>& camera,
                                             const Matrix<3, 3, Scalar>& homography) {
    Vector<3, Scalar> h[3];
    for (int c = 0; c < 3; ++c)
        h[c] = Vector<3, Scalar>((homography(0, c) - camera.cx * homography(2, c)) / camera.fx,
                                 (homography(1, c) - camera.cy * homography(2, c)) / camera.fy,
                                 homography(2, c));
    const Scalar both = length_of(h[0]) + length_of(h[1]);
    if (both == scalar_of<Scalar>(0)) return Status::degenerate;
    const Scalar share = scalar_of<Scalar>(2) / both;
    // The diagonals of the two axes are square to each other when these are of one length.
    const Result<Vector<3, Scalar>> sum = normalized(h[0] + h[1]);
    if (!sum) return sum.status();
    const Vector<3, Scalar> rest = h[0] - h[1];
    const Result<Vector<3, Scalar>> difference = normalized(rest - *sum * dot(*sum, rest));
    if (!difference) return difference.status();
    const Scalar half_root = square_root(scalar_of<Scalar>(1, -1));
    const Vector<3, Scalar> x = (*sum + *difference) * half_root;
    const Vector<3, Scalar> y = (*sum - *difference) * half_root;
    const Vector<3, Scalar> z = cross(x, y);
    return Pose<Scalar>{Matrix<3, 3, Scalar>(x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2]),
                        h[2] * share};
}

namespace detail {

/// Whether all points but one at most lie on the line through two of them.
constexpr bool on_a_line(Span<const PlanePoint> board, std::ptrdiff_t first, std::ptrdiff_t second) {
    const std::int64_t x = std::int64_t{board[second].x} - board[first].x;
    const std::int64_t y = std::int64_t{board[second].y} - board[first].y;
    if (x == 0 && y == 0) return false;
    int beside = 0;
    for (const PlanePoint point : board) {
        const std::int64_t dx = std::int64_t{point.x} - board[first].x;
        const std::int64_t dy = std::int64_t{point.y} - board[first].y;
        if (Int128::product(x, dy) != Int128::product(y, dx)) ++beside;
    }
    return beside <= 1;
}

/// Why a board has no homography to its picture.
constexpr CalibrationProblem problem_of_homography(Status status, Span<const PlanePoint> board) {
    if (status != Status::degenerate) return CalibrationProblem::bad_argument;
    // Three points, two of which are on any line that all but one are on; equal ones are not asked for more.
    std::ptrdiff_t other = 1;
    while (other < board.size() && board[other] == board[0]) ++other;
    if (other == board.size()) return CalibrationProblem::collinear_points;
    std::ptrdiff_t third = other + 1;
    while (third < board.size() && (board[third] == board[0] || board[third] == board[other])) ++third;
    if (third == board.size() || on_a_line(board, 0, other) || on_a_line(board, 0, third) ||
        on_a_line(board, other, third))
        return CalibrationProblem::collinear_points;
    return CalibrationProblem::board_behind;
}

/// Whether no board is tilted to the first: the sine of the angle between their normals is below 1/16.
template <class Scalar>
constexpr bool all_parallel(Span<const Pose<Scalar>> poses) {
    for (std::ptrdiff_t view = 1; view < poses.size(); ++view) {
        const Vector<3, Scalar> across = cross(poses[0].rotation.column(2), poses[view].rotation.column(2));
        if (scalar_of<Scalar>(1, -8) < dot(across, across)) return false;
    }
    return true;
}

/// The way down of a calibration, and the last equations solved without damping. Where boards that are
/// parallel leave the camera open the way has no end: that is looked for early.
template <class Scalar, class System>
constexpr CalibrationProblem refine(System& system, const FreeTerms& terms, Span<const Pose<Scalar>> poses,
                                    Refinement<Scalar>& refinement) {
    const bool tilted = terms.of_pinhole() > 2;
    LevenbergMarquardtOptions options;
    const int most = options.most_linearisations;
    options.most_linearisations = 25;
    Status status = descend(system, options, refinement);
    if (status == Status::ok && !refinement.converged) {
        if (tilted && all_parallel(poses)) return CalibrationProblem::parallel_views;
        const Refinement<Scalar> before = refinement;
        options.most_linearisations = most - before.linearisations;
        status = descend(system, options, refinement);
        refinement.linearisations += before.linearisations;
        refinement.costs += before.costs;
    }
    Scalar gain = scalar_of<Scalar>(0);
    if (status == Status::ok) status = system.solve(undamped, gain);
    // What leaves an unknown open, or leads behind the camera.
    const bool open = status != Status::ok || (tilted && all_parallel(poses));
    return open ? CalibrationProblem::parallel_views : CalibrationProblem::none;
}

}  // namespace detail
}  // namespace fovea
