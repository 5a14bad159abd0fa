// SPDX-License-Identifier: MIT
//
// Golden vectors of stereo/.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/random.hpp>
#include <fovea/stereo/eight_point.hpp>
#include <fovea/stereo/epipolar.hpp>
#include <fovea/stereo/essential.hpp>
#include <fovea/stereo/ransac_epipolar.hpp>
#include <fovea/stereo/rectify.hpp>
#include <fovea/stereo/rectify_uncalibrated.hpp>
#include <fovea/stereo/stereo_camera.hpp>
#include <fovea/stereo/triangulate.hpp>
#include <golden/camera_vectors.hpp>
#include <golden/digest.hpp>
#include <golden/number_vectors.hpp>
#include <golden/workspace.hpp>

namespace fovea::golden {

inline void put(Digest& digest, const StereoCamera<>& pair) {
    for (const Camera<>* camera : {&pair.left, &pair.right})
        digest.add(camera->fx, camera->fy, camera->cx, camera->cy, camera->k1, camera->k2, camera->k3,
                   camera->p1, camera->p2);
    digest.add(pair.right_from_left);
}
inline void put(Digest& digest, const LineEnds& ends) { digest.add(ends.from, ends.to); }
inline void put(Digest& digest, const Epipoles<>& ends) { digest.add(ends.left, ends.right); }
inline void put(Digest& digest, const PixelPair<>& pair) { digest.add(pair.left, pair.right); }
inline void put(Digest& digest, const RayMeeting<>& meeting) {
    digest.add(meeting.place, meeting.on_left, meeting.on_right, meeting.gap);
}
inline void put(Digest& digest, const RansacFit<Matrix<3, 3>>& fit) {
    digest.add(fit.transform, static_cast<std::int64_t>(fit.agreeing), fit.samples, fit.certain);
}
inline void put(Digest& digest, const EssentialPoses<>& found) {
    for (const Pose<>& pose : found.poses) digest.add(pose);
}
inline void put(Digest& digest, const RecoveredPose<>& found) {
    digest.add(found.right_from_left, static_cast<std::int64_t>(found.in_front));
}
inline void put(Digest& digest, const RectifyingHomographies<>& found) {
    digest.add(found.left, found.right, found.axis);
}
inline void put(Digest& digest, const Rectification<>& found) {
    digest.add(found.left, found.right, found.size, found.axis, found.baseline, found.cameras());
}

/// A pair with lenses or without, and pixels of places that both see.
struct StereoView {
    static constexpr std::ptrdiff_t count = 12;
    StereoCamera<> pair;
    SubPixelPoint left[std::size_t{count}];
    SubPixelPoint right[std::size_t{count}];

    StereoView(Random& random, bool with_lens) {
        pair.left = random_camera(random);
        pair.right = random_camera(random);
        for (Camera<>* camera : {&pair.left, &pair.right}) {
            if (with_lens) continue;
            camera->k1 = camera->k2 = camera->k3 = Real();
            camera->p1 = camera->p2 = Real();
        }
        pair.right_from_left.rotation = rotation_about(random_matrix<3, 1>(random) * Real::from_int(1, -4));
        pair.right_from_left.translation = random_matrix<3, 1>(random) * Real::from_int(20);
        pair.right_from_left.translation[0] -= Real::from_int(120);
        const auto near = [](const Vector<2>& pixel) {
            return SubPixelPoint{pixel[0].to_fixed<SubPixel>(), pixel[1].to_fixed<SubPixel>()};
        };
        for (std::ptrdiff_t i = 0; i < count; ++i) {
            const Real x = Real::from_int(random.between(-200, 250));
            const Real y = Real::from_int(random.between(-200, 200));
            const Real z = Real::from_int(random.between(700, 1400));
            const Vector<3> place(x, y, z);
            left[i] = near(*project(pair.left, place));
            right[i] = near(*project(pair.right, pair.right_from_left, place));
        }
    }
};

inline void stereo_epipolar(Workspace&, Digest& digest) {
    Random random(81);
    const StereoView view(random, false);
    const StereoCamera<>& pair = view.pair;
    digest.add(pair, swapped(pair), essential_matrix(pair.right_from_left), fundamental_matrix(pair),
               projection_matrix(pair.right, pair.right_from_left),
               right_from_left(inverse(pair.right_from_left), pair.right_from_left));
    const Matrix<3, 3> f = *fundamental_matrix(pair);
    digest.add(epipoles(f));
    for (int i = 0; i < 6; ++i) {
        const auto left = vector_of(view.left[i]);
        const auto right = vector_of(view.right[(i + i / 4) % 12]);
        const Result<Vector<3>> line = epipolar_line(f, left);
        digest.add(line, distance_from_line(*line, right), sampson_distance(f, left, right),
                   clip_line(*line, Rectangle{0, 0, 640, 480}), nearest_matching(f, left, right));
    }
}

inline void stereo_triangulate(Workspace&, Digest& digest) {
    Random random(82);
    const StereoView view(random, true);
    const Triangulator<> eyes(view.pair);
    digest.add(eyes.cameras());
    for (int i = 0; i < 4; ++i) {
        const auto left = vector_of(view.left[i]);
        const auto right = vector_of(view.right[i]);
        const auto a = random_matrix<3, 1>(random);
        const auto b = random_matrix<3, 1>(random);
        digest.add(eyes.midpoint(left, right), eyes.optimal(left, right),
                   triangulate_rays(view.pair.right_from_left, a, b),
                   depth_of_disparity(a[0].absolute(), b[0].absolute(), a[1]),
                   depth_deviation(a[0].absolute(), b[0].absolute(), a[1].absolute(), b[1]));
    }
}

inline void stereo_fundamental(Workspace&, Digest& digest) {
    Random random(83);
    const StereoView view(random, false);
    const Span<const SubPixelPoint> left(view.left);
    const Span<const SubPixelPoint> right(view.right);
    const Result<Matrix<3, 3>> f = fit_fundamental(left, right);
    digest.add(f);
    if (f) digest.add(rectify_uncalibrated(*f, left, right, Size{640, 480}));
}

inline RansacOptions few_samples() {
    RansacOptions options;
    options.most_samples = 5;
    return options;
}

inline void stereo_ransac(Workspace&, Digest& digest) {
    Random random(83);
    StereoView view(random, false);
    view.right[3].y = view.right[3].y + SubPixel::from_int(40);
    std::uint8_t agrees[std::size_t{StereoView::count}] = {};
    digest.add(fit_fundamental_ransac(Span<const SubPixelPoint>(view.left),
                                      Span<const SubPixelPoint>(view.right), SubPixel::from_int(1),
                                      few_samples(), Span<std::uint8_t>(agrees)));
    for (const std::uint8_t flag : agrees) digest.add(flag);
}

/// The rays of a view without lenses.
struct StereoRays {
    Vector<2> left[std::size_t{StereoView::count}];
    Vector<2> right[std::size_t{StereoView::count}];

    explicit StereoRays(const StereoView& view) {
        for (std::ptrdiff_t i = 0; i < StereoView::count; ++i) {
            left[i] = point_of(view.pair.left, vector_of(view.left[i]));
            right[i] = point_of(view.pair.right, vector_of(view.right[i]));
        }
    }
};

inline void stereo_essential(Workspace&, Digest& digest) {
    Random random(84);
    const StereoView view(random, false);
    const StereoRays rays(view);
    const Span<const Vector<2>> from(rays.left);
    const Span<const Vector<2>> to(rays.right);
    const Result<Matrix<3, 3>> e = fit_essential(from, to);
    digest.add(e);
    Vector<2> again[std::size_t{StereoView::count}];
    const LensInverse<> lens(view.pair.left);
    digest.add(rays_of(lens, Span<const SubPixelPoint>(view.left), Span<Vector<2>>(again)));
    for (const Vector<2>& ray : again) digest.add(ray);
    if (e) digest.add(nearest_essential(*e), decompose_essential(*e), recover_pose(*e, from, to));
}

inline void stereo_essential_ransac(Workspace&, Digest& digest) {
    Random random(84);
    const StereoView view(random, false);
    const StereoRays rays(view);
    std::uint8_t agrees[std::size_t{StereoView::count}] = {};
    digest.add(fit_essential_ransac(Span<const Vector<2>>(rays.left), Span<const Vector<2>>(rays.right),
                                    Real::from_int(1, -9), few_samples(), Span<std::uint8_t>(agrees)));
}

inline void stereo_rectify(Workspace&, Digest& digest) {
    Random random(85);
    const StereoView lens(random, true);
    RectifyOptions options;
    options.method = RectifyOptions::Method::fusiello;
    const Result<Rectification<>> found = rectify(lens.pair, Size{640, 480}, options);
    digest.add(found);
    if (found)
        digest.add(found->depth_matrix(), found->place(vector_of(lens.left[0]), Real::from_int(100)),
                   rectifying_homography(lens.pair.left, found->left, found->camera));
}

inline void stereo_rectify_zoom(Workspace&, Digest& digest) {
    Random random(86);
    const StereoView view(random, false);
    RectifyOptions options;
    options.new_size = Size{320, 200};
    options.zoom = RectifyOptions::Zoom::valid;
    digest.add(rectify(view.pair, Size{640, 480}, options));
}

}  // namespace fovea::golden
