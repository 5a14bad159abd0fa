// SPDX-License-Identifier: MIT
//
// Where two rays meet: a place in space from its pixels in two cameras. Book sec. 2.10.1.
#pragma once

#include <fovea/base/status.hpp>
#include <fovea/camera/lens_inverse.hpp>
#include <fovea/camera/pose.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/number/scalar.hpp>
#include <fovea/stereo/epipolar.hpp>
#include <fovea/stereo/stereo_camera.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// A place in left camera coordinates, and where the rays are nearest to each other: it is the middle.
template <class Scalar = Real>
struct RayMeeting {
    Vector<3, Scalar> place;
    Vector<3, Scalar> on_left;   ///< of the left ray, the place nearest to the right one
    Vector<3, Scalar> on_right;  ///< of the right ray
    Scalar gap;                  ///< between the two; what is wrong with pixels or cameras shows here
};

/// The closest places of two rays.
///
/// Shapes    directions of any length, each in its camera's coordinates
/// Rounding  sines of the angle between the rays lose as many digits as they are small
/// Errors    degenerate where the rays are parallel, which is a sine below 2^-30, or the cameras at one
///           place; out_of_range where they meet behind a camera
/// Source    book sec. 2.10.1, which solves for both lengths; here by cross products, that keep more digits
template <class Scalar>
constexpr Result<RayMeeting<Scalar>> triangulate_rays(const Pose<Scalar>& right_from_left,
                                                      const Vector<3, Scalar>& left,
                                                      const Vector<3, Scalar>& right);

/// The pair of pixels nearest to a seen one that fits a fundamental matrix.
template <class Scalar = Real>
struct PixelPair {
    Vector<2, Scalar> left;
    Vector<2, Scalar> right;
};

/// Moves both pixels by the least sum of squares so that right^T F left = 0.
///
/// Rounding  to 2^-48 of how far they are moved
/// Time      at most 60 steps; two or three for pixels that nearly fit, ten where they are moved by a tenth of
///           the way to the epipole
/// Errors    degenerate where the steps do not settle: pixels at the epipoles
/// Source    Lindstrom, "Triangulation made easy", CVPR 2010, listing 2, repeated until it settles, where it is
///           the optimum of Hartley and Sturm, "Triangulation", CVIU 68(2), 1997
template <class Scalar>
constexpr Result<PixelPair<Scalar>> nearest_matching(const Matrix<3, 3, Scalar>& fundamental,
                                                     const Vector<2, Scalar>& left,
                                                     const Vector<2, Scalar>& right);

/// Two cameras, prepared for triangulation.
template <class Scalar = Real>
class Triangulator {
public:
    /// Looks for the fields of both lenses.
    constexpr explicit Triangulator(const StereoCamera<Scalar>& cameras)
        : cameras_(cameras), left_(cameras.left), right_(cameras.right) {}

    constexpr const StereoCamera<Scalar>& cameras() const { return cameras_; }

    /// The middle of where the rays of two pixels are nearest to each other.
    ///
    /// Errors  bad_argument for a camera without focal lengths; out_of_range for a pixel outside of the
    ///         field of its lens; those of triangulate_rays()
    /// Source  book sec. 2.10.1
    constexpr Result<RayMeeting<Scalar>> midpoint(const Vector<2, Scalar>& left,
                                                  const Vector<2, Scalar>& right) const;

    /// The place whose pixels are nearest to the seen ones: the sum of the squares of both distances, of
    /// pixels as they were without lens, is least. The gap is the root of that sum, in pixels; places on the
    /// rays are those of the pixels that were moved.
    ///
    /// Errors  as midpoint(), and those of nearest_matching()
    constexpr Result<RayMeeting<Scalar>> optimal(const Vector<2, Scalar>& left,
                                                 const Vector<2, Scalar>& right) const;

private:
    StereoCamera<Scalar> cameras_;
    LensInverse<Scalar> left_;
    LensInverse<Scalar> right_;
};

/// z = f b / d: the depth at which a disparity is seen in a rectified pair.
///
/// Units   focal length and disparity in pixels; the baseline's unit is that of the depth
/// Errors  out_of_range for a disparity or a product that is not above 0: at infinity or behind
/// Source  book sec. 2.10.3
template <class Scalar>
constexpr Result<Scalar> depth_of_disparity(const Scalar& focal_length, const Scalar& baseline,
                                            const Scalar& disparity);

/// z^2 / (f b) times the deviation of the disparity: the standard deviation of that depth.
///
/// Errors  out_of_range as above
template <class Scalar>
constexpr Result<Scalar> depth_deviation(const Scalar& focal_length, const Scalar& baseline,
                                         const Scalar& disparity, const Scalar& deviation);

// ---- Implementation ---------------------------------------------------------------

template <class Scalar>
constexpr Result<RayMeeting<Scalar>> triangulate_rays(const Pose<Scalar>& right_from_left,
                                                      const Vector<3, Scalar>& left,
                                                      const Vector<3, Scalar>& right) {
    const Scalar zero = scalar_of<Scalar>(0);
    const Matrix<3, 3, Scalar> back = right_from_left.rotation.transposed();
    const Vector<3, Scalar> other = back * right;
    const Vector<3, Scalar> centre = -(back * right_from_left.translation);
    const Vector<3, Scalar> normal = cross(left, other);
    const Scalar square = dot(normal, normal);
    if (!(scale(dot(left, left) * dot(other, other), -60) < square) || dot(centre, centre) == zero)
        return Status::degenerate;
    // s left - t other + u normal = centre.
    const Scalar s = dot(cross(centre, other), normal) / square;
    const Scalar t = dot(cross(centre, left), normal) / square;
    if (!(zero < s) || !(zero < t)) return Status::out_of_range;
    RayMeeting<Scalar> meeting;
    meeting.on_left = left * s;
    meeting.on_right = centre + other * t;
    meeting.place = (meeting.on_left + meeting.on_right) * scalar_of<Scalar>(1, -1);
    meeting.gap = absolute(dot(centre, normal)) / square_root(square);
    return meeting;
}

template <class Scalar>
constexpr Result<PixelPair<Scalar>> nearest_matching(const Matrix<3, 3, Scalar>& fundamental,
                                                     const Vector<2, Scalar>& left,
                                                     const Vector<2, Scalar>& right) {
    const Scalar zero = scalar_of<Scalar>(0);
    const Scalar one = scalar_of<Scalar>(1);
    const Matrix<3, 3, Scalar>& f = fundamental;
    const auto slope = [](const Matrix<3, 3, Scalar>& a, const Vector<2, Scalar>& place) {
        return Vector<2, Scalar>(a(0, 0) * place[0] + a(0, 1) * place[1] + a(0, 2),
                                 a(1, 0) * place[0] + a(1, 1) * place[1] + a(1, 2));
    };
    const Matrix<3, 3, Scalar> back = f.transposed();
    const Scalar error =
        dot(Vector<3, Scalar>(right[0], right[1], one), f * Vector<3, Scalar>(left[0], left[1], one));
    const Vector<2, Scalar> first_n = slope(back, right);
    const Vector<2, Scalar> first_m = slope(f, left);
    Vector<2, Scalar> left_move;
    Vector<2, Scalar> right_move;
    for (int i = 0; i < 60; ++i) {
        // Both are moved square to the lines of each other where they are now; the quadratic equation says how
        // far from where they were seen.
        const Vector<2, Scalar> n = slope(back, right + right_move);
        const Vector<2, Scalar> m = slope(f, left + left_move);
        const Scalar a = m[0] * (f(0, 0) * n[0] + f(0, 1) * n[1]) + m[1] * (f(1, 0) * n[0] + f(1, 1) * n[1]);
        const Scalar b = scale(dot(n, first_n) + dot(m, first_m), -1);
        const Scalar rest = b * b - a * error;
        if (!(zero < b) || rest < zero) return Status::degenerate;
        const Scalar share = -error / (b + square_root(rest));
        const Vector<2, Scalar> next = n * share;
        const Vector<2, Scalar> right_next = m * share;
        const Scalar change = length_of(next - left_move) + length_of(right_next - right_move);
        const Scalar size = length_of(next) + length_of(right_next);
        left_move = next;
        right_move = right_next;
        if (!(scale(size, -48) < change)) return PixelPair<Scalar>{left + left_move, right + right_move};
    }
    return Status::degenerate;
}

template <class Scalar>
constexpr Result<RayMeeting<Scalar>> Triangulator<Scalar>::midpoint(const Vector<2, Scalar>& left,
                                                                    const Vector<2, Scalar>& right) const {
    const Result<Vector<3, Scalar>> first = left_.ray(left);
    if (!first) return first.status();
    const Result<Vector<3, Scalar>> second = right_.ray(right);
    if (!second) return second.status();
    return triangulate_rays(cameras_.right_from_left, *first, *second);
}

template <class Scalar>
constexpr Result<RayMeeting<Scalar>> Triangulator<Scalar>::optimal(const Vector<2, Scalar>& left,
                                                                   const Vector<2, Scalar>& right) const {
    const Result<Vector<3, Scalar>> first = left_.ray(left);
    if (!first) return first.status();
    const Result<Vector<3, Scalar>> second = right_.ray(right);
    if (!second) return second.status();
    // Pixels from the principal point, in which the numbers are smaller.
    Camera<Scalar> from;
    from.fx = cameras_.left.fx;
    from.fy = cameras_.left.fy;
    Camera<Scalar> to;
    to.fx = cameras_.right.fx;
    to.fy = cameras_.right.fy;
    const Result<Matrix<3, 3, Scalar>> f =
        fundamental_matrix(StereoCamera<Scalar>{from, to, cameras_.right_from_left});
    if (!f) return f.status();
    const Vector<2, Scalar> seen = pixel_of(from, Vector<2, Scalar>((*first)[0], (*first)[1]));
    const Vector<2, Scalar> also = pixel_of(to, Vector<2, Scalar>((*second)[0], (*second)[1]));
    const Result<PixelPair<Scalar>> pair = nearest_matching(*f, seen, also);
    if (!pair) return pair.status();
    const Scalar one = scalar_of<Scalar>(1);
    const Vector<2, Scalar> a = point_of(from, pair->left);
    const Vector<2, Scalar> b = point_of(to, pair->right);
    const Result<RayMeeting<Scalar>> found = triangulate_rays(
        cameras_.right_from_left, Vector<3, Scalar>(a[0], a[1], one), Vector<3, Scalar>(b[0], b[1], one));
    if (!found) return found;
    RayMeeting<Scalar> meeting = *found;
    const Vector<2, Scalar> moved = pair->left - seen;
    const Vector<2, Scalar> moved_too = pair->right - also;
    meeting.gap = square_root(dot(moved, moved) + dot(moved_too, moved_too));
    return meeting;
}

template <class Scalar>
constexpr Result<Scalar> depth_of_disparity(const Scalar& focal_length, const Scalar& baseline,
                                            const Scalar& disparity) {
    const Scalar zero = scalar_of<Scalar>(0);
    const Scalar product = focal_length * baseline;
    if (!(zero < disparity) || !(zero < product)) return Status::out_of_range;
    return product / disparity;
}

template <class Scalar>
constexpr Result<Scalar> depth_deviation(const Scalar& focal_length, const Scalar& baseline,
                                         const Scalar& disparity, const Scalar& deviation) {
    const Result<Scalar> depth = depth_of_disparity(focal_length, baseline, disparity);
    if (!depth) return depth;
    return *depth / disparity * absolute(deviation);
}

}  // namespace fovea
