// SPDX-License-Identifier: MIT
//
// What calibrations have in common: what is estimated, why there is no answer, and what is answered.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/camera/camera.hpp>
#include <fovea/camera/pose.hpp>
#include <fovea/camera/projection_derivatives.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/match/point_pair.hpp>
#include <fovea/number/real.hpp>
#include <fovea/number/scalar.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Which terms of a lens are estimated. The others stay what they were: 0 where there was no camera before.
enum class LensTerms : std::uint8_t { none, k1_k2, k1_k2_p1_p2, k1_k2_k3_p1_p2 };
/// Whether the principal point is estimated, or stays: in the centre of the picture where there was no camera
/// before. Few views, or views with little tilt, leave it uncertain.
enum class PrincipalPoint : std::uint8_t { estimated, held };
/// Whether fx and fy are two unknowns, or one of square pixels.
enum class PixelShape : std::uint8_t { any, square };

struct IntrinsicsOptions {
    /// More terms fit closer, and say less outside of where the board was.
    LensTerms lens = LensTerms::k1_k2_p1_p2;
    PrincipalPoint principal_point = PrincipalPoint::estimated;
    PixelShape pixels = PixelShape::any;
};

/// Why there is no calibration.
enum class CalibrationProblem : std::uint8_t {
    none,
    bad_argument,  ///< an empty or too large picture, more than 4096 views, a camera without focal lengths
    scratch_too_small,  ///< less scratch, or room for fewer views, than is asked for
    too_few_views,      ///< fewer views than the intrinsics need: one with a free principal point, or none
    size_mismatch,      ///< not as many points of the board as are seen
    too_few_points,     ///< fewer than 4 points in a view, or no more equations than unknowns
    outside_picture,    ///< a point is seen where there is no picture
    collinear_points,   ///< the points of a view lie on a line, on the board or in the picture
    board_behind,       ///< a part of a board would lie behind the camera
    parallel_views,     ///< the boards lie too much alike: the intrinsics remain open
    no_convergence,     ///< no bottom was found: points are given to the wrong places of the board
};

/// One lower-case phrase for messages, without a full stop.
constexpr const char* describe(CalibrationProblem problem);
/// The nearest that there is.
constexpr Status status_of(CalibrationProblem problem);

/// ok(), or what is wrong, and in which view; -1 if not in one alone.
struct [[nodiscard]] CalibrationVerdict {
    CalibrationProblem problem = CalibrationProblem::none;
    int view = -1;

    constexpr bool ok() const { return problem == CalibrationProblem::none; }
    friend constexpr bool operator==(CalibrationVerdict a, CalibrationVerdict b) {
        return a.problem == b.problem && a.view == b.view;
    }
};

/// Where a board stands in a view.
///
/// Units  of the board's coordinates; deviations are standard deviations, those of the rotation in radians
///        about the axes of the camera; rms in pixels over the view's points
template <class Scalar = Real>
struct CalibratedView {
    Pose<Scalar> pose;
    Vector<3, Scalar> rotation_deviation;
    Vector<3, Scalar> translation_deviation;
    Scalar rms = scalar_of<Scalar>(0);
};

// ---- Implementation ---------------------------------------------------------------

constexpr const char* describe(CalibrationProblem problem) {
    switch (problem) {
        case CalibrationProblem::none: return "calibrated";
        case CalibrationProblem::bad_argument: return "a parameter is out of its range";
        case CalibrationProblem::scratch_too_small: return "scratch memory is too small";
        case CalibrationProblem::too_few_views: return "too few views for what is estimated";
        case CalibrationProblem::size_mismatch: return "not as many points of the board as are seen";
        case CalibrationProblem::too_few_points: return "too few points";
        case CalibrationProblem::outside_picture: return "a point lies outside the picture";
        case CalibrationProblem::collinear_points: return "the points of a view lie on a line";
        case CalibrationProblem::board_behind: return "a part of the board would be behind the camera";
        case CalibrationProblem::parallel_views: return "the views are too much alike";
        case CalibrationProblem::no_convergence: return "no camera fits the points";
    }
    return "unknown problem";
}

constexpr Status status_of(CalibrationProblem problem) {
    switch (problem) {
        case CalibrationProblem::none: return Status::ok;
        case CalibrationProblem::bad_argument: return Status::bad_argument;
        case CalibrationProblem::scratch_too_small: return Status::scratch_too_small;
        case CalibrationProblem::size_mismatch: return Status::size_mismatch;
        case CalibrationProblem::outside_picture:
        case CalibrationProblem::board_behind: return Status::out_of_range;
        case CalibrationProblem::no_convergence: return Status::undecided;
        case CalibrationProblem::too_few_views:
        case CalibrationProblem::too_few_points:
        case CalibrationProblem::collinear_points:
        case CalibrationProblem::parallel_views: break;
    }
    return Status::degenerate;
}

namespace detail {

inline constexpr std::ptrdiff_t most_calibration_views = 4096;

/// The unknowns of a camera that are estimated, in the order of its terms. Of square pixels fx stands for
/// both.
class FreeTerms {
public:
    constexpr FreeTerms() = default;
    constexpr explicit FreeTerms(const IntrinsicsOptions& options)
        : square_(options.pixels == PixelShape::square) {
        const auto lens = options.lens;
        const bool centre = options.principal_point == PrincipalPoint::estimated;
        const bool tangential = lens == LensTerms::k1_k2_p1_p2 || lens == LensTerms::k1_k2_k3_p1_p2;
        const bool wanted[camera_terms] = {true,
                                           !square_,
                                           centre,
                                           centre,
                                           lens != LensTerms::none,
                                           lens != LensTerms::none,
                                           lens == LensTerms::k1_k2_k3_p1_p2,
                                           tangential,
                                           tangential};
        for (int i = 0; i < camera_terms; ++i)
            if (wanted[i]) terms_[count_++] = static_cast<CameraTerm>(i);
    }

    constexpr int count() const { return count_; }
    constexpr bool square() const { return square_; }
    constexpr CameraTerm term(int index) const { return terms_[index]; }
    /// Focal lengths and principal point among them.
    constexpr int of_pinhole() const {
        int result = 0;
        for (int i = 0; i < count_; ++i)
            if (terms_[i] <= CameraTerm::cy) ++result;
        return result;
    }
    /// A row of derivatives by them.
    template <class Scalar>
    constexpr void put(const ProjectionDerivatives<Scalar>& from, int row, Scalar* to) const {
        for (int i = 0; i < count_; ++i) to[i] = from.by_camera(row, static_cast<int>(terms_[i]));
        if (square_ && row == 1) to[0] = from.by_camera(1, static_cast<int>(CameraTerm::fy));
    }
    template <class Scalar>
    constexpr Camera<Scalar> moved(Camera<Scalar> camera, const Scalar* step) const {
        for (int i = 0; i < count_; ++i) {
            Scalar& value = term_of(camera, terms_[i]);
            value = value + step[i];
        }
        if (square_) camera.fy = camera.fx;
        return camera;
    }
    /// A camera of standard deviations: 0 for what is held.
    template <class Scalar, class Variance>
    constexpr Camera<Scalar> deviations(Variance variance) const {
        const Scalar zero = scalar_of<Scalar>(0);
        Camera<Scalar> result{zero, zero, zero, zero, zero, zero, zero, zero, zero};
        for (int i = 0; i < count_; ++i) term_of(result, terms_[i]) = square_root(variance(i));
        if (square_) result.fy = result.fx;
        return result;
    }
    /// Whether focal lengths and principal point are known at all: to an eighth of the focal length.
    template <class Scalar>
    static constexpr bool determined(const Camera<Scalar>& camera, const Camera<Scalar>& deviation) {
        const Scalar limit = scale(camera.fx < camera.fy ? camera.fx : camera.fy, -3);
        return deviation.fx < limit && deviation.fy < limit && deviation.cx < limit && deviation.cy < limit;
    }

private:
    CameraTerm terms_[camera_terms] = {};
    int count_ = 0;
    bool square_ = false;
};

constexpr bool inside(SubPixelPoint point, Size picture) {
    const std::int32_t half = SubPixel::one / 2;
    const std::int32_t right = picture.width * SubPixel::one - half;
    const std::int32_t bottom = picture.height * SubPixel::one - half;
    return point.x.raw() >= -half && point.y.raw() >= -half && point.x.raw() <= right &&
           point.y.raw() <= bottom;
}

/// Whether points are those of a board that is seen from its edge: less than 1/128 as wide as long.
constexpr bool flat(Span<const SubPixelPoint> seen) {
    Real x;
    Real y;
    for (const SubPixelPoint point : seen) {
        x += Real::from_fixed(point.x);
        y += Real::from_fixed(point.y);
    }
    const Real share = Real::from_ratio(1, seen.size());
    Real xx;
    Real xy;
    Real yy;
    for (const SubPixelPoint point : seen) {
        const Real dx = Real::from_fixed(point.x) - x * share;
        const Real dy = Real::from_fixed(point.y) - y * share;
        xx += dx * dx;
        xy += dx * dy;
        yy += dy * dy;
    }
    const Real size = xx + yy;
    return !((size * size).scaled(-14) < xx * yy - xy * xy);
}

/// What is wrong with the points of one view.
constexpr CalibrationProblem problem_of_points(Span<const PlanePoint> board, Span<const SubPixelPoint> seen,
                                               Size picture) {
    if (board.size() != seen.size()) return CalibrationProblem::size_mismatch;
    if (board.size() < 4) return CalibrationProblem::too_few_points;
    for (const SubPixelPoint point : seen)
        if (!inside(point, picture)) return CalibrationProblem::outside_picture;
    return flat(seen) ? CalibrationProblem::collinear_points : CalibrationProblem::none;
}

/// A point of a board whose z is 0, turned by a rotation.
template <class Scalar>
constexpr Vector<3, Scalar> turned(const Matrix<3, 3, Scalar>& rotation, PlanePoint point) {
    const Scalar x = scalar_of<Scalar>(point.x);
    const Scalar y = scalar_of<Scalar>(point.y);
    return Vector<3, Scalar>(rotation(0, 0) * x + rotation(0, 1) * y, rotation(1, 0) * x + rotation(1, 1) * y,
                             rotation(2, 0) * x + rotation(2, 1) * y);
}

/// Where a point was seen, in pixels.
template <class Scalar>
constexpr Vector<2, Scalar> pixel_seen(SubPixelPoint point) {
    return Vector<2, Scalar>(scalar_of<Scalar>(point.x.raw(), -SubPixel::fraction_bits),
                             scalar_of<Scalar>(point.y.raw(), -SubPixel::fraction_bits));
}

/// The sum of squares of what a camera that sees a board misses, in pixels.
///
/// Errors  out_of_range for a point that is not in front of the camera
template <class Scalar>
constexpr Result<Scalar> cost_of_view(const Camera<Scalar>& camera, const Pose<Scalar>& pose,
                                      Span<const PlanePoint> board, Span<const SubPixelPoint> seen) {
    Scalar cost = scalar_of<Scalar>(0);
    for (std::ptrdiff_t i = 0; i < board.size(); ++i) {
        const Result<Vector<2, Scalar>> pixel =
            project(camera, turned(pose.rotation, board[i]) + pose.translation);
        if (!pixel) return pixel.status();
        const Vector<2, Scalar> off = *pixel - pixel_seen<Scalar>(seen[i]);
        cost = cost + off[0] * off[0];
        cost = cost + off[1] * off[1];
    }
    return cost;
}

}  // namespace detail
}  // namespace fovea
