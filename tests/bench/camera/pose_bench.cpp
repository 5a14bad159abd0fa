// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>
#include <vector>

#include <fovea/camera/find_pose.hpp>
#include <fovea/camera/fit_projection.hpp>
#include <fovea/camera/p3p.hpp>
#include <fovea/camera/planar_pose.hpp>

#include <bench/harness.hpp>

#if defined(FOVEA_HAVE_OPENCV_CALIB3D)
#include <opencv2/calib3d.hpp>
#endif

namespace fovea::bench {
namespace {

Camera<> seeing_camera() {
    Camera<> camera;
    camera.fx = camera.fy = Real::from_int(865);
    camera.cx = Real::from_int(320);
    camera.cy = Real::from_int(240);
    camera.k1 = Real::from_ratio(-1, 4);
    camera.k2 = Real::from_ratio(1, 11);
    return camera;
}

/// Points of a cube or of a plane as seeing_camera() sees them, every third at a wrong pixel if wanted.
struct Object {
    std::vector<SpacePoint> points;
    std::vector<PlanePoint> flat;
    std::vector<SubPixelPoint> pixels, scratch;
    std::vector<Vector<3>> rays;
    std::vector<std::uint8_t> agrees;

    Object(int count, bool plane, bool wrong) {
        const Pose<> pose{
            rotation_about(Vector<3>(Real::from_ratio(1, 2), Real::from_ratio(1, 3), Real::from_ratio(1, 9))),
            Vector<3>(Real::from_int(100), Real::from_int(-200), Real::from_int(5000))};
        Random random(1);
        for (int i = 0; i < count; ++i) {
            const int x = random.between(-1000, 1000);
            const int y = random.between(-1000, 1000);
            const int z = random.between(-1000, 1000);
            const int row = random.between(0, 479);
            points.push_back({x, y, plane ? 0 : z});
            flat.push_back({x, y});
            rays.push_back(pose(vector_of(points.back())));
            const Vector<2> pixel = *project(seeing_camera(), rays.back());
            pixels.push_back({pixel[0].to_fixed<SubPixel>(), pixel[1].to_fixed<SubPixel>()});
            if (wrong && i % 3 == 0) pixels.back().y = SubPixel::from_int(row);
        }
        scratch.resize(pixels.size());
        agrees.resize(pixels.size());
    }
    std::ptrdiff_t size() const { return static_cast<std::ptrdiff_t>(points.size()); }
    Span<const SpacePoint> from() const { return {points.data(), size()}; }
    Span<const SubPixelPoint> to() const { return {pixels.data(), size()}; }
    Span<const Vector<3>> directions() const { return {rays.data(), size()}; }
};

#if defined(FOVEA_HAVE_OPENCV_CALIB3D)
/// What OpenCV's functions take.
struct Peer {
    std::vector<cv::Point3d> points;
    std::vector<cv::Point2d> pixels;
    cv::Mat camera = (cv::Mat_<double>(3, 3) << 865, 0, 320, 0, 865, 240, 0, 0, 1);
    cv::Mat lens = (cv::Mat_<double>(1, 4) << -0.25, 1.0 / 11, 0, 0);

    explicit Peer(const Object& object) {
        for (std::size_t i = 0; i < object.points.size(); ++i) {
            const SpacePoint point = object.points[i];
            points.emplace_back(point.x, point.y, point.z);
            pixels.emplace_back(object.pixels[i].x.raw() / 256.0, object.pixels[i].y.raw() / 256.0);
        }
    }
};
#endif

const bool projection_added = add(55, "fit_projection, 192 points", Sizes::vga, [](Row& row) {
    row.not_per_pixel();
    auto& object = row.keep(Object(192, false, false));
    row.ours([&] { consume(fit_projection(object.from(), object.to())); });
});
const bool three_added = add(55, "p3p", Sizes::vga, [](Row& row) {
    row.not_per_pixel();
    auto& object = row.keep(Object(3, false, false));
    row.ours([&] { consume(p3p(object.from(), object.directions())); });
#if defined(FOVEA_HAVE_OPENCV_CALIB3D)
    auto& peer = row.keep(Peer(object));
    row.peer("OpenCV", [&] {
        std::vector<cv::Mat> rotations;
        std::vector<cv::Mat> translations;
        consume(cv::solveP3P(peer.points, peer.pixels, peer.camera, peer.lens, rotations, translations,
                             cv::SOLVEPNP_P3P));
    });
#endif
});
const bool plane_added = add(55, "planar_pose, 54 points, both poses refined", Sizes::vga, [](Row& row) {
    row.not_per_pixel();
    auto& object = row.keep(Object(54, true, false));
    row.ours([&, camera = seeing_camera()] {
        consume(planar_pose(Span<const PlanePoint>(object.flat.data(), object.size()), object.to(), camera,
                            Span<SubPixelPoint>(object.scratch.data(), object.size())));
    });
#if defined(FOVEA_HAVE_OPENCV_CALIB3D)
    auto& peer = row.keep(Peer(object));
    row.peer("OpenCV", [&] {
        cv::Mat rotation;
        cv::Mat translation;
        consume(cv::solvePnP(peer.points, peer.pixels, peer.camera, peer.lens, rotation, translation, false,
                             cv::SOLVEPNP_ITERATIVE));
    });
#endif
});
const bool doubtful_added = add(55, "find_pose, 100 pairs, a third wrong", Sizes::vga, [](Row& row) {
    row.not_per_pixel();
    auto& object = row.keep(Object(100, false, true));
    auto& room = row.keep(std::vector<Vector<3>>(100));
    row.ours([&, camera = seeing_camera()] {
        consume(find_pose(object.from(), object.to(), camera, SubPixel::from_int(2), RansacOptions(),
                          Span<Vector<3>>(room.data(), 100), Span<std::uint8_t>(object.agrees.data(), 100)));
    });
#if defined(FOVEA_HAVE_OPENCV_CALIB3D)
    auto& peer = row.keep(Peer(object));
    row.peer("OpenCV", [&] {
        cv::Mat rotation;
        cv::Mat translation;
        consume(cv::solvePnPRansac(peer.points, peer.pixels, peer.camera, peer.lens, rotation, translation,
                                   false, 2000, 2.0f, 0.999, cv::noArray(), cv::SOLVEPNP_P3P));
    });
#endif
});

}  // namespace
}  // namespace fovea::bench
