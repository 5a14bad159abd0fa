// SPDX-License-Identifier: MIT
//
// Golden vectors of camera/.
#pragma once

#include <fovea/base/random.hpp>
#include <fovea/camera/camera.hpp>
#include <fovea/camera/lens_inverse.hpp>
#include <fovea/camera/pose.hpp>
#include <golden/digest.hpp>
#include <golden/number_vectors.hpp>
#include <golden/workspace.hpp>

namespace fovea::golden {

inline void put(Digest& digest, const Pose<>& pose) { digest.add(pose.rotation, pose.translation); }

inline Camera<> random_camera(Random& random) {
    const auto part = [&](int most) { return Real::from_int(random.between(-most, most), -16); };
    Camera<> camera;
    camera.fx = Real::from_int(random.between(30000000, 60000000), -16);
    camera.fy = camera.fx + part(300000);
    camera.cx = Real::from_int(320) + part(1000000);
    camera.cy = Real::from_int(240) + part(1000000);
    camera.k1 = part(25000);
    camera.k2 = part(15000);
    camera.k3 = part(5000);
    camera.p1 = part(200);
    camera.p2 = part(200);
    return camera;
}

inline void camera_poses(Workspace&, Digest& digest) {
    Random random(71);
    for (int i = 0; i < 10; ++i) {
        const Pose<> a{rotation_about(random_matrix<3, 1>(random)), random_matrix<3, 1>(random)};
        const Pose<> b{rotation_about(random_matrix<3, 1>(random)), random_matrix<3, 1>(random)};
        digest.add(a, compose(a, b), inverse(a), a(b.translation));
    }
}

inline void camera_lens(Workspace&, Digest& digest) {
    Random random(72);
    for (int i = 0; i < 6; ++i) {
        const Camera<> camera = random_camera(random);
        const LensInverse<> lens(camera);
        digest.add(lens.radius());
        const Pose<> pose{rotation_about(random_matrix<3, 1>(random)), random_matrix<3, 1>(random)};
        for (int k = 0; k < 8; ++k) {
            const auto place = random_matrix<3, 1>(random);
            const Real u = Real::from_int(random.between(-100, 740));
            const Real v = Real::from_int(random.between(-100, 580));
            const Vector<2> pixel(u, v);
            digest.add(project(camera, place), project(camera, pose, place));
            const Vector<2> point = point_of(camera, pixel);
            digest.add(distort(camera, point), pixel_of(camera, point), lens.undistort(point),
                       lens.ray(pixel));
        }
    }
}

}  // namespace fovea::golden
