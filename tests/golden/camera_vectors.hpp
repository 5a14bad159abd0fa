// SPDX-License-Identifier: MIT
//
// Golden vectors of camera/.
#pragma once

#include <fovea/base/random.hpp>
#include <fovea/camera/camera.hpp>
#include <fovea/camera/fitted_view.hpp>
#include <fovea/camera/lens_inverse.hpp>
#include <fovea/camera/packed_camera.hpp>
#include <fovea/camera/pose.hpp>
#include <fovea/camera/undistortion_map.hpp>
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

inline void put(Digest& digest, const Camera<>& camera) {
    digest.add(camera.fx, camera.fy, camera.cx, camera.cy, camera.k1, camera.k2, camera.k3, camera.p1,
               camera.p2);
}

inline void camera_undistortion(Workspace& work, Digest& digest) {
    Random random(73);
    const Size size{60, 40};
    FinePoint places[75];
    MapPoint points[60];
    Camera<> camera = random_camera(random);
    const auto shrink = [](Camera<>& large) {
        for (Real Camera<>::*member : {&Camera<>::fx, &Camera<>::fy, &Camera<>::cx, &Camera<>::cy})
            large.*member = (large.*member).scaled(-3);
    };
    shrink(camera);
    const LensInverse<> lens(camera);
    digest.add(lens.camera());
    // As it is, turned, and so wide that the field ends in it.
    for (int i = 0; i < 3; ++i) {
        Camera<> view = random_camera(random);
        shrink(view);
        if (i == 2) view.fx = view.fy = Real::from_int(8);
        const auto axis = random_matrix<3, 1>(random);
        const Matrix<3, 3> rotation =
            i == 0 ? Matrix<3, 3>::identity() : rotation_about(axis * Real::from_int(1, -2));
        digest.add(is_rotation(rotation));
        const Result<UndistortionMap> map = undistortion_map(lens, rotation, view, size);
        digest.add(map.status());
        if (!map) continue;
        digest.add(map->size());
        for (int y = 0; y < 55; y += 6) {
            const Span<FinePoint> row(places, y % 4 == 0 ? 75 : 60);
            digest.add(map->row(y, row), row, map->place(y, y));
        }
        const ImageView<MapPoint> dense = work.view<MapPoint>(0, {20, 15});
        const Result<UndistortionMap> small = undistortion_map(lens, rotation, view, dense.size());
        if (small) digest.add(undistortion_points(*small, dense), dense);
        const ImageView<MapPoint> grid = work.view<MapPoint>(1, map_grid_size(size));
        digest.add(undistortion_grid(*map, grid), grid);
        digest.add(undistortion_grid_error(*map, grid, places, points));
    }
    digest.add(camera_of_one_term({320, 240}, Real::from_ratio(-1, 3000000)));
}

inline void camera_views(Workspace&, Digest& digest) {
    Random random(74);
    // Without distortion, whose inverse would take long on a chip.
    Camera<> camera = random_camera(random);
    camera.k1 = camera.k2 = camera.k3 = camera.p1 = camera.p2 = Real();
    const Matrix<3, 3> rotation = rotation_about(random_matrix<3, 1>(random) * Real::from_int(1, -3));
    const auto bounds = visible_bounds(LensInverse<>(camera), rotation, {640, 480});
    digest.add(bounds.status());
    if (!bounds) return;
    for (const ViewBounds<>& part : {bounds->inner, bounds->outer}) {
        digest.add(part.left, part.top, part.right, part.bottom);
        digest.add(view_that_fills(part, camera, {320, 240}), view_that_holds(part, camera, {800, 480}));
    }
}

inline void camera_packed(Workspace&, Digest& digest) {
    Random random(75);
    std::uint8_t bytes[packed_camera_bytes(2)];
    for (int count = 1; count <= 2; ++count) {
        CameraSet set;
        set.count = count;
        for (int i = 0; i < count; ++i) {
            set.sizes[i] = {640, 480 + i};
            set.cameras[i] = random_camera(random);
        }
        if (count == 2) {
            set.right_from_left.rotation = rotation_about(random_matrix<3, 1>(random));
            set.right_from_left.translation = random_matrix<3, 1>(random);
        }
        const Result<std::ptrdiff_t> size = pack_cameras(set, bytes);
        digest.add(size.status());
        if (!size) continue;
        const Span<const std::uint8_t> packed(bytes, *size);
        digest.add(packed);
        CameraSet read;
        digest.add(unpack_cameras(packed, read), read.count);
        for (int i = 0; i < count; ++i) digest.add(read.sizes[i], read.cameras[i]);
        digest.add(read.right_from_left);
        bytes[20] ^= 4;
        digest.add(unpack_cameras(packed, read), unpack_cameras(packed.first(30), read));
    }
}

}  // namespace fovea::golden
