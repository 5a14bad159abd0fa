// SPDX-License-Identifier: MIT
//
// Golden vectors of cameras and poses that are found from points, of the fisheye camera, and of what they
// need.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/random.hpp>
#include <fovea/camera/align_points.hpp>
#include <fovea/camera/find_pose.hpp>
#include <fovea/camera/fisheye.hpp>
#include <fovea/camera/fit_projection.hpp>
#include <fovea/camera/p3p.hpp>
#include <fovea/camera/planar_pose.hpp>
#include <fovea/camera/posit.hpp>
#include <fovea/camera/projection_matrix.hpp>
#include <fovea/camera/rays.hpp>
#include <fovea/camera/refine_pose.hpp>
#include <fovea/camera/refine_view.hpp>
#include <fovea/linear/cubic.hpp>
#include <fovea/match/point_spread.hpp>
#include <fovea/number/arctangent.hpp>
#include <golden/calibration_vectors.hpp>
#include <golden/camera_vectors.hpp>
#include <golden/digest.hpp>
#include <golden/number_vectors.hpp>
#include <golden/workspace.hpp>

namespace fovea::golden {

inline void put(Digest& digest, const CameraView<>& view) { digest.add(view.camera, view.pose, view.skew); }
inline void put(Digest& digest, const Ray<>& ray) { digest.add(ray.point, ray.direction); }
inline void put(Digest& digest, const ViewFit<>& fit) {
    digest.add(fit.camera, fit.pose, fit.rms, fit.deviation);
}
inline void put(Digest& digest, const PoseFit<>& fit) {
    digest.add(fit.pose, fit.rms, fit.turn_deviation, fit.place_deviation, fit.used);
}
inline void put(Digest& digest, const PoseCandidates<>& found) {
    digest.add(found.count);
    for (int i = 0; i < found.count; ++i) digest.add(found.poses[i]);
}
inline void put(Digest& digest, const PlaneTilts<>& tilts) { digest.add(tilts.poses[0], tilts.poses[1]); }
inline void put(Digest& digest, const PlanarPoses<>& found) {
    digest.add(found.count);
    for (int i = 0; i < found.count; ++i) digest.add(found.fits[i]);
}
inline void put(Digest& digest, const FoundPose<>& found) {
    digest.add(found.fit, found.samples, found.certain);
}
inline void put(Digest& digest, const Alignment<>& found) {
    digest.add(found.pose, found.size, found.rms, found(found.pose.translation));
}

/// Points in a cube, and where a camera sees them, a little off.
template <int Count>
struct SeenObject {
    SpacePoint points[static_cast<std::size_t>(Count)];
    SubPixelPoint pixels[static_cast<std::size_t>(Count)];
    Camera<> camera;
    Pose<> pose;

    explicit SeenObject(Random& random, bool flat = false) : camera(random_camera(random)) {
        const auto axis = random_matrix<3, 1>(random);
        pose.rotation = rotation_about(axis);
        pose.translation[0] = Real::from_int(random.between(-500, 500));
        pose.translation[1] = Real::from_int(random.between(-400, 400));
        pose.translation[2] = Real::from_int(random.between(5000, 6000));
        for (std::ptrdiff_t i = 0; i < Count; ++i) {
            SpacePoint& point = points[i];
            point.x = random.between(-1000, 1000);
            point.y = random.between(-1000, 1000);
            point.z = flat ? 0 : random.between(-1000, 1000);
            const auto seen = project(camera, pose, vector_of(point));
            if (!seen) continue;
            const int right = random.between(-60, 60);
            const int down = random.between(-60, 60);
            pixels[i].x = (*seen)[0].to_fixed<SubPixel>() + SubPixel::from_raw(right);
            pixels[i].y = (*seen)[1].to_fixed<SubPixel>() + SubPixel::from_raw(down);
        }
    }
    Span<const SpacePoint> from() const { return {points, Count}; }
    Span<const SubPixelPoint> to() const { return {pixels, Count}; }
};

inline void number_arctangent(Workspace&, Digest& digest) {
    Random random(111);
    digest.add(pi<Real>(), pi<Real>(1));
    for (int i = 0; i < 40; ++i) {
        const Real y = random_real(random, 3);
        const Real x = random_real(random, 3);
        const Real angle = arctangent(y, x);
        const CosineAndSine<Real> turn(angle);
        digest.add(angle, turn.cosine, turn.sine);
    }
}

inline void linear_cubic(Workspace&, Digest& digest) {
    Random random(112);
    for (int i = 0; i < 30; ++i) {
        const Real a = random_real(random, i);
        const Real b = random_real(random, i);
        const Real c = random_real(random, i);
        digest.add(cubic_root_alone(a, b, c));
    }
}

inline void camera_projection(Workspace&, Digest& digest) {
    Random random(113);
    const SeenObject<12> view(random);
    const auto matrix = fit_projection(view.from(), view.to());
    digest.add(matrix, spread_of(view.from()));
    if (matrix) digest.add(decompose(*matrix), project(*matrix, vector_of(view.points[0])));
    const Matrix<3, 4> exact = projection_matrix(view.camera, view.pose);
    digest.add(exact, decompose(exact), decompose(-exact));
    for (int i = 0; i < 4; ++i) {
        const Real u = Real::from_int(random.between(0, 640));
        const Real v = Real::from_int(random.between(0, 480));
        digest.add(ray_of(exact, Vector<2>(u, v)));
    }
    const SeenObject<7> flat(random, true);
    digest.add(fit_projection(flat.from(), flat.to()), spread_of(flat.from()));
}

inline void camera_view_fit(Workspace&, Digest& digest) {
    Random random(114);
    const SeenObject<7> view(random);
    IntrinsicsOptions options;
    options.lens = LensTerms::none;
    options.principal_point = PrincipalPoint::held;
    digest.add(refine_view(view.from(), view.to(), view.camera, view.pose, options));
    digest.add(fit_view(view.from().first(6), view.to().first(5), options));
}

inline void camera_object_pose(Workspace&, Digest& digest) {
    Random random(115);
    const SeenObject<5> object(random);
    const LensInverse<> lens(object.camera);
    Vector<3> rays[5];
    digest.add(rays_of(lens, object.to(), Span<Vector<3>>(rays)), Span<const Vector<3>>(rays));
    digest.add(posit(object.from(), Span<const Vector<3>>(rays)));
    for (int i = 0; i < 3; ++i)
        digest.add(p3p(object.from().from(i).first(3), Span<const Vector<3>>(rays).from(i).first(3)));
    digest.add(refine_pose(object.from(), object.to(), object.camera, object.pose));
}

inline void camera_planar_pose(Workspace&, Digest& digest) {
    Random random(116);
    const SeenObject<5> object(random, true);
    PlanePoint points[5];
    SubPixelPoint scratch[planar_pose_scratch(5)];
    for (std::size_t i = 0; i < 5; ++i) points[i] = {object.points[i].x, object.points[i].y};
    digest.add(planar_pose(Span<const PlanePoint>(points), object.to(), object.camera,
                           Span<SubPixelPoint>(scratch)));
    digest.add(poses_of_plane(random_matrix<3, 3>(random) + Matrix<3, 3>::identity(), Vector<2>()));
    digest.add(in_space(points[2]).x, in_space(object.points[2]).y);
}

inline void camera_find_pose(Workspace&, Digest& digest) {
    Random random(117);
    SeenObject<8> object(random);
    object.pixels[3].x = SubPixel::from_int(17);
    Vector<3> rays[find_pose_scratch(8)];
    std::uint8_t agrees[8] = {};
    RansacOptions options;
    options.most_samples = 6;
    digest.add(find_pose(object.from(), object.to(), object.camera, SubPixel::from_int(2), options,
                         Span<Vector<3>>(rays), Span<std::uint8_t>(agrees)));
    digest.add(Span<const std::uint8_t>(agrees));
}

inline void camera_alignment(Workspace&, Digest& digest) {
    Random random(118);
    Vector<3> from[6];
    Vector<3> to[6];
    for (std::size_t i = 0; i < 6; ++i) {
        from[i] = random_matrix<3, 1>(random);
        to[i] = random_matrix<3, 1>(random);
    }
    const Span<const Vector<3>> start(from);
    const Span<const Vector<3>> end(to);
    digest.add(align_points(start, end), align_points_with_size(start, end),
               align_points(start, end.first(2)));
}

inline void camera_fisheye(Workspace&, Digest& digest) {
    Random random(119);
    const auto part = [&](int most) { return Real::from_int(random.between(-most, most), -16); };
    FisheyeCamera<> camera;
    camera.fx = camera.fy = Real::from_int(300);
    camera.cx = camera.cy = Real::from_int(250);
    camera.k1 = part(6000);
    camera.k2 = part(3000);
    camera.k3 = part(1000);
    camera.k4 = part(500);
    const FisheyeLens<> lens(camera);
    digest.add(lens.field(), camera.radius(lens.field()), camera.slope(lens.field()), lens.camera().k4);
    SubPixelPoint pixels[6];
    for (SubPixelPoint& pixel : pixels) {
        pixel.x = SubPixel::from_raw(random.between(0, 128000));
        pixel.y = SubPixel::from_raw(random.between(0, 128000));
        digest.add(lens.project(random_matrix<3, 1>(random)));
        digest.add(lens.ray(Vector<2>(Real::from_fixed(pixel.x), Real::from_fixed(pixel.y))));
    }
    Vector<3> rays[6];
    digest.add(rays_of(lens, Span<const SubPixelPoint>(pixels), Span<Vector<3>>(rays)));
    digest.add(Span<const Vector<3>>(rays));
}

}  // namespace fovea::golden
