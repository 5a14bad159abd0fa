// SPDX-License-Identifier: MIT
//
// The pose of an object that a known camera sees, from doubtful pairs of points and pixels.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/camera/calibration.hpp>
#include <fovea/camera/camera.hpp>
#include <fovea/camera/lens_inverse.hpp>
#include <fovea/camera/p3p.hpp>
#include <fovea/camera/pose.hpp>
#include <fovea/camera/refine_pose.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/match/point_pair.hpp>
#include <fovea/match/point_spread.hpp>
#include <fovea/match/ransac.hpp>
#include <fovea/number/scalar.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// A pose that most pairs agree with.
template <class Scalar = Real>
struct FoundPose {
    PoseFit<Scalar> fit;   ///< of the pairs that agree
    int samples = 0;       ///< drawn
    bool certain = false;  ///< as in RansacResult
};

/// Scratch elements that find_pose() needs.
constexpr std::ptrdiff_t find_pose_scratch(std::ptrdiff_t points) { return points; }

/// The pose that most points agree with: they are seen at most tolerance from their pixels. Objects may be
/// flat or not. A pixel that no ray of the lens leads to agrees with none.
///
/// agrees 1 for each pair that the fit rests on and 0 for the others
/// Shapes   as many points as pixels: 4 to 2^20; agrees as long
/// Scratch  find_pose_scratch(points.size()) rays, undefined afterwards
/// Rounding as refine_pose()
/// Time     a sample is p3p() and one projection a point
/// Errors   size_mismatch; bad_argument for fewer than 4 pairs or more than 2^20, a tolerance that is not
///          above 0, a camera without focal lengths or options out of range; scratch_too_small; not_found if
///          fewer than options.enough agree; degenerate if no sample makes a pose, as where all points lie on
///          a line; undecided if the fit to those that agree does not settle
/// Source   ransac() over samples of four: three make up to four poses, the fourth tells which; then
///          refine_pose() of those that agree, repeated while their number grows
template <class Scalar = Real>
constexpr Result<FoundPose<Scalar>> find_pose(Span<const SpacePoint> points, Span<const SubPixelPoint> pixels,
                                              const Camera<Scalar>& camera, SubPixel tolerance,
                                              const RansacOptions& options,
                                              NonDeduced<Span<Vector<3, Scalar>>> scratch,
                                              Span<std::uint8_t> agrees);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// The square of the distance in pixels between where a point is seen and where it should be.
template <class Scalar>
constexpr Result<Scalar> square_off(const Camera<Scalar>& camera, const Pose<Scalar>& pose, SpacePoint point,
                                    SubPixelPoint pixel) {
    const auto seen = project(camera, pose, vector_of<Scalar>(point));
    if (!seen) return seen.status();
    const Vector<2, Scalar> off = *seen - pixel_seen<Scalar>(pixel);
    return dot(off, off);
}

/// Of the poses of three points that with which the fourth is seen nearest to where it should be.
template <class Scalar>
constexpr Result<Pose<Scalar>> pose_of_four(const SpacePoint (&points)[4], const SubPixelPoint (&pixels)[4],
                                            const Vector<3, Scalar> (&rays)[4],
                                            const Camera<Scalar>& camera) {
    const auto candidates =
        p3p<Scalar>(Span<const SpacePoint>(points).first(3), Span<const Vector<3, Scalar>>(rays).first(3));
    if (!candidates) return candidates.status();
    int best = -1;
    Scalar least = scalar_of<Scalar>(0);
    for (int i = 0; i < candidates->count; ++i) {
        const Result<Scalar> off = square_off(camera, candidates->poses[i], points[3], pixels[3]);
        if (!off || (best >= 0 && !(*off < least))) continue;
        best = i;
        least = *off;
    }
    if (best < 0) return Status::not_found;
    return candidates->poses[best];
}

}  // namespace detail

template <class Scalar>
constexpr Result<FoundPose<Scalar>> find_pose(Span<const SpacePoint> points, Span<const SubPixelPoint> pixels,
                                              const Camera<Scalar>& camera, SubPixel tolerance,
                                              const RansacOptions& options,
                                              NonDeduced<Span<Vector<3, Scalar>>> scratch,
                                              Span<std::uint8_t> agrees) {
    const Scalar zero = scalar_of<Scalar>(0);
    if (points.size() != pixels.size() || agrees.size() != points.size()) return Status::size_mismatch;
    if (points.size() < 4 || points.size() > std::ptrdiff_t{1} << 20 || tolerance.raw() <= 0)
        return Status::bad_argument;
    if (camera.fx == zero || camera.fy == zero) return Status::bad_argument;
    if (scratch.size() < find_pose_scratch(points.size())) return Status::scratch_too_small;
    const LensInverse<Scalar> lens(camera);
    for (std::ptrdiff_t i = 0; i < points.size(); ++i) {
        const Result<Vector<3, Scalar>> ray = lens.ray(detail::pixel_seen<Scalar>(pixels[i]));
        scratch[i] = ray ? *ray : Vector<3, Scalar>();
    }
    const Scalar side = scalar_of<Scalar>(tolerance.raw(), -SubPixel::fraction_bits);
    const Scalar square = side * side;
    const auto near = [&](const Pose<Scalar>& pose, std::ptrdiff_t i) {
        if (scratch[i][2] == zero) return false;
        const Result<Scalar> off = detail::square_off(camera, pose, points[i], pixels[i]);
        return off.ok() && !(square < *off);
    };
    const auto best = ransac<4, Pose<Scalar>>(
        points.size(), options,
        [&](const std::ptrdiff_t(&chosen)[4]) {
            SpacePoint places[4];
            SubPixelPoint seen[4];
            Vector<3, Scalar> rays[4];
            for (int i = 0; i < 4; ++i) {
                places[i] = points[chosen[i]];
                seen[i] = pixels[chosen[i]];
                rays[i] = scratch[chosen[i]];
            }
            return detail::pose_of_four(places, seen, rays, camera);
        },
        near);
    if (!best) return best.status();

    FoundPose<Scalar> found;
    found.samples = best->samples;
    found.certain = best->certain;
    Pose<Scalar> pose = best->model;
    std::ptrdiff_t agreeing = best->agreeing;
    // Rays are not needed any more: their first coordinate tells who agrees.
    const auto use = [&](std::ptrdiff_t i) { return zero < scratch[i][0]; };
    for (int round = 0; round < 8; ++round) {
        for (std::ptrdiff_t i = 0; i < points.size(); ++i)
            scratch[i][0] = scalar_of<Scalar>(near(pose, i) ? 1 : 0);
        const Result<PoseFit<Scalar>> fit = detail::refine_pose_to(points, pixels, camera, pose, use);
        if (!fit) {
            if (round == 0) return fit.status();
            break;
        }
        for (std::ptrdiff_t i = 0; i < points.size(); ++i) agrees[i] = use(i) ? 1 : 0;
        found.fit = *fit;
        std::ptrdiff_t with_fit = 0;
        for (std::ptrdiff_t i = 0; i < points.size(); ++i) with_fit += near(fit->pose, i) ? 1 : 0;
        if (with_fit <= agreeing) break;
        pose = fit->pose;
        agreeing = with_fit;
    }
    return found;
}

}  // namespace fovea
