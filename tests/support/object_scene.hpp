// SPDX-License-Identifier: MIT
//
// Objects before cameras: points in space, and the pixels in which they are seen, with noise.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/camera/camera.hpp>
#include <fovea/camera/pose.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/match/point_pair.hpp>
#include <fovea/match/point_spread.hpp>
#include <support/random_matrix.hpp>
#include <support/scalars.hpp>

namespace fovea::test {

inline double plain(Real number) { return static_cast<double>(value_of(number)); }

template <class T>
Span<const T> span_of(const std::vector<T>& all) {
    return {all.data(), static_cast<std::ptrdiff_t>(all.size())};
}

/// Nearly normal, with deviation 1: the sum of twelve numbers from 0 to 1, less 6.
inline double random_normal(Random& random) {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += random.next() * 0x1p-32;
    return sum;
}

/// A pixel with noise, to 1/256.
inline SubPixelPoint noisy(const Vector<2>& pixel, double noise, Random& random) {
    const double u = plain(pixel[0]) + noise * random_normal(random);
    const double v = plain(pixel[1]) + noise * random_normal(random);
    return {SubPixel::from_raw(static_cast<std::int32_t>(std::lround(u * 256))),
            SubPixel::from_raw(static_cast<std::int32_t>(std::lround(v * 256)))};
}

/// Points up to size away from the origin on every axis.
inline std::vector<SpacePoint> random_object(Random& random, int count, int size) {
    std::vector<SpacePoint> points;
    for (int i = 0; i < count; ++i) {
        SpacePoint point;
        point.x = random.between(-size, size);
        point.y = random.between(-size, size);
        point.z = random.between(-size, size);
        points.push_back(point);
    }
    return points;
}

/// Any rotation, and a translation of up to a quarter of the distance across.
inline Pose<> random_pose(Random& random, int distance) {
    Pose<> pose;
    pose.rotation = rotation_about(random_matrix<3, 1>(random) * Real::from_int(6));
    pose.translation[0] = Real::from_int(random.between(-distance / 4, distance / 4));
    pose.translation[1] = Real::from_int(random.between(-distance / 5, distance / 5));
    pose.translation[2] = Real::from_int(distance);
    return pose;
}

/// A camera of 640 x 480 with a lens of 6 mm or so.
inline Camera<> usual_camera(bool with_lens) {
    Camera<> camera;
    camera.fx = real_of(864.7);
    camera.fy = real_of(861.3);
    camera.cx = real_of(331.25);
    camera.cy = real_of(236.5);
    if (!with_lens) return camera;
    camera.k1 = real_of(-0.28);
    camera.k2 = real_of(0.11);
    camera.p1 = real_of(0.0007);
    camera.p2 = real_of(-0.0011);
    return camera;
}

/// Where points are seen; all of them must be in front of the camera.
template <class Point>
std::vector<SubPixelPoint> seen_by(const Camera<>& camera, const Pose<>& pose,
                                   const std::vector<Point>& points, double noise, Random& random) {
    std::vector<SubPixelPoint> pixels;
    for (const Point point : points)
        pixels.push_back(noisy(project(camera, pose, vector_of(in_space(point))).value(), noise, random));
    return pixels;
}

/// The directions of points from the camera, exact to the last digits.
inline std::vector<Vector<3>> rays_to(const Pose<>& pose, const std::vector<SpacePoint>& points) {
    std::vector<Vector<3>> rays;
    for (const SpacePoint point : points) rays.push_back(pose(vector_of(point)));
    return rays;
}

/// The largest difference of two poses: of the rotation's elements, and of the translation in parts of it.
inline double difference(const Pose<>& a, const Pose<>& b) {
    double most = plain(length_of(a.translation - b.translation) / length_of(b.translation));
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
            most = std::fmax(most, std::fabs(plain(a.rotation(r, c) - b.rotation(r, c))));
    return most;
}

/// The same pose in another scalar's digits, rounded.
template <class Scalar>
Pose<Scalar> pose_in(const Pose<>& pose) {
    Pose<Scalar> result;
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c)
            result.rotation(r, c) = static_cast<Scalar>(value_of(pose.rotation(r, c)));
        result.translation[r] = static_cast<Scalar>(value_of(pose.translation[r]));
    }
    return result;
}
template <class Scalar>
Camera<Scalar> camera_in(const Camera<>& camera) {
    const auto in = [](Real number) { return static_cast<Scalar>(value_of(number)); };
    return {in(camera.fx), in(camera.fy), in(camera.cx), in(camera.cy), in(camera.k1),
            in(camera.k2), in(camera.k3), in(camera.p1), in(camera.p2)};
}

}  // namespace fovea::test
