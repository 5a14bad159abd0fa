// SPDX-License-Identifier: MIT
//
// Random cameras, and what they see of a board in random poses.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/base/span.hpp>
#include <fovea/camera/calibrate_planar.hpp>
#include <fovea/stereo/calibrate_stereo.hpp>
#include <support/scalars.hpp>

namespace fovea::test {

/// Numbers between two, and of a normal distribution. One draw a statement: compilers agree.
class Noise {
public:
    explicit Noise(std::uint64_t seed) : random_(seed) {}
    double between(double low, double high) { return low + (high - low) * (random_.next() / 4294967296.0); }
    int between(int low, int high) { return random_.between(low, high); }
    double normal() {
        double sum = 0;
        for (int i = 0; i < 12; ++i) sum += between(0.0, 1.0);
        return sum - 6;
    }

private:
    Random random_;
};

/// A turn by Euler's angles, in double.
inline Matrix<3, 3, double> turn(double a, double b, double c) {
    const Matrix<3, 3, double> x(1.0, 0.0, 0.0, 0.0, std::cos(a), -std::sin(a), 0.0, std::sin(a),
                                 std::cos(a));
    const Matrix<3, 3, double> y(std::cos(b), 0.0, std::sin(b), 0.0, 1.0, 0.0, -std::sin(b), 0.0,
                                 std::cos(b));
    const Matrix<3, 3, double> z(std::cos(c), -std::sin(c), 0.0, std::sin(c), std::cos(c), 0.0, 0.0, 0.0,
                                 1.0);
    return x * y * z;
}

/// The places of a board with this many columns and rows of points.
inline std::vector<PlanePoint> board_of(int columns, int rows, int square) {
    std::vector<PlanePoint> board;
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) board.push_back({x * square, y * square});
    return board;
}

/// What a camera sees of a board, with noise in pixels; empty if not all of it is in the picture, before the
/// fold of the lens.
inline std::vector<SubPixelPoint> seen_by(const Camera<double>& camera, Size picture,
                                          const Pose<double>& pose, const std::vector<PlanePoint>& board,
                                          double noise, Noise& random) {
    std::vector<SubPixelPoint> seen;
    for (const PlanePoint point : board) {
        const Vector<3, double> place = pose(Vector<3, double>(double(point.x), double(point.y), 0.0));
        if (place[2] <= 0) return {};
        const double square = (place[0] * place[0] + place[1] * place[1]) / (place[2] * place[2]);
        const double slope = 1 + square * (3 * camera.k1 + square * (5 * camera.k2 + square * 7 * camera.k3));
        const Vector<2, double> pixel = *project(camera, place);
        const double u = pixel[0] + noise * random.normal();
        const double v = pixel[1] + noise * random.normal();
        if (slope < 0.2 || u < 1 || v < 1 || u > picture.width - 2 || v > picture.height - 2) return {};
        seen.push_back({SubPixel::from_raw(static_cast<std::int32_t>(std::lround(u * 256))),
                        SubPixel::from_raw(static_cast<std::int32_t>(std::lround(v * 256)))});
    }
    return seen;
}

/// A camera, and views of a board by it.
struct CameraScene {
    Size picture;
    Camera<double> camera;
    double noise = 0;
    std::vector<PlanePoint> board = board_of(9, 6, 25);
    std::vector<std::vector<SubPixelPoint>> seen;
    std::vector<PlanarView> views;

    Span<const PlanarView> span() const { return {views.data(), static_cast<std::ptrdiff_t>(views.size())}; }
    void add(std::vector<SubPixelPoint> points) { seen.push_back(std::move(points)); }
    void collect() {
        views.clear();
        for (const auto& points : seen)
            views.push_back({{board.data(), static_cast<std::ptrdiff_t>(board.size())},
                             {points.data(), static_cast<std::ptrdiff_t>(points.size())}});
    }
};

/// 320 to 1280 px wide, of all focal lengths and lenses that are usual.
inline void draw_camera(CameraScene& scene, Noise& random) {
    scene.picture.width = 320 << random.between(0, 2);
    scene.picture.height = scene.picture.width * 3 / 4;
    const double width = scene.picture.width;
    Camera<double>& camera = scene.camera;
    camera.fx = width * random.between(0.6, 2.0);
    camera.fy = camera.fx * random.between(0.98, 1.02);
    camera.cx = width * random.between(0.45, 0.55);
    camera.cy = scene.picture.height * random.between(0.45, 0.55);
    camera.k1 = random.between(-0.35, 0.15);
    camera.k2 = random.between(-0.1, 0.2);
    camera.k3 = 0;
    camera.p1 = random.between(-2e-3, 2e-3);
    camera.p2 = random.between(-2e-3, 2e-3);
    scene.noise = random.between(0.02, 0.3);
}
/// A board in front of the camera, tilted by up to 34 degrees about both axes.
inline Pose<double> draw_pose(const CameraScene& scene, Noise& random) {
    const double a = random.between(-0.6, 0.6);
    const double b = random.between(-0.6, 0.6);
    const double c = random.between(-1.5, 1.5);
    const double z = 25 * scene.camera.fx / scene.picture.width * random.between(11.0, 22.0);
    const double x = z * scene.picture.width / scene.camera.fx * random.between(-0.25, 0.25);
    const double y = z * scene.picture.height / scene.camera.fy * random.between(-0.25, 0.25);
    Pose<double> pose;
    pose.rotation = turn(a, b, c);
    // About the board's middle.
    pose.translation = Vector<3, double>(x, y, z) - pose.rotation * Vector<3, double>(100.0, 62.5, 0.0);
    return pose;
}
inline CameraScene random_scene(std::uint64_t seed) {
    Noise random(seed);
    CameraScene scene;
    draw_camera(scene, random);
    const std::size_t views = static_cast<std::size_t>(random.between(5, 14));
    while (scene.seen.size() < views) {
        const Pose<double> pose = draw_pose(scene, random);
        auto points = seen_by(scene.camera, scene.picture, pose, scene.board, scene.noise, random);
        if (!points.empty()) scene.add(std::move(points));
    }
    scene.collect();
    return scene;
}

/// Two cameras, and views of a board by both.
struct StereoScene {
    CameraScene left;
    CameraScene right;
    Pose<double> right_from_left;
    std::vector<StereoView> views;

    Span<const StereoView> span() const { return {views.data(), static_cast<std::ptrdiff_t>(views.size())}; }
};
inline StereoScene random_rig(std::uint64_t seed) {
    Noise random(seed);
    StereoScene scene;
    draw_camera(scene.left, random);
    // The same kind of camera, a little different.
    scene.right.picture = scene.left.picture;
    scene.right.camera = scene.left.camera;
    scene.right.noise = scene.left.noise;
    scene.right.camera.fx *= random.between(0.95, 1.05);
    scene.right.camera.fy *= random.between(0.95, 1.05);
    scene.right.camera.cx += scene.left.picture.width * random.between(-0.02, 0.02);
    scene.right.camera.k1 += random.between(-0.03, 0.03);
    const double a = random.between(-0.1, 0.1);
    const double b = random.between(-0.2, 0.2);
    const double c = random.between(-0.1, 0.1);
    const Matrix<3, 3, double> rotation = turn(a, b, c);
    const double distance = 25 * 15 * scene.left.camera.fx / scene.left.picture.width;
    // The right camera looks about where the left one does.
    const double side = distance * random.between(0.05, 0.2);
    const double up = distance * random.between(-0.03, 0.03);
    const double ahead = distance * random.between(-0.03, 0.03);
    const Vector<3, double> middle(0.0, 0.0, distance);
    scene.right_from_left.rotation = rotation;
    scene.right_from_left.translation = middle - rotation * middle + Vector<3, double>(-side, up, ahead);
    const std::size_t views = static_cast<std::size_t>(random.between(5, 14));
    while (scene.left.seen.size() < views) {
        const Pose<double> pose = draw_pose(scene.left, random);
        auto left =
            seen_by(scene.left.camera, scene.left.picture, pose, scene.left.board, scene.left.noise, random);
        if (left.empty()) continue;
        auto right = seen_by(scene.right.camera, scene.right.picture, compose(scene.right_from_left, pose),
                             scene.right.board, scene.right.noise, random);
        if (right.empty()) continue;
        scene.left.add(std::move(left));
        scene.right.add(std::move(right));
    }
    scene.left.collect();
    scene.right.collect();
    for (std::size_t view = 0; view < views; ++view)
        scene.views.push_back(
            {scene.left.views[view].board, scene.left.views[view].seen, scene.right.views[view].seen});
    return scene;
}

/// calibrate_planar() with memory of its own.
template <class Scalar>
struct PlanarRun {
    CalibrationVerdict verdict;
    PlanarCalibration<Scalar> calibration;
    std::vector<CalibratedView<Scalar>> fits;

    PlanarRun(Span<const PlanarView> views, Size picture, const IntrinsicsOptions& options = {})
        : fits(static_cast<std::size_t>(views.size())) {
        const std::int64_t bytes = calibrate_planar_scratch<Scalar>(static_cast<int>(views.size()));
        std::vector<std::uint8_t> scratch(static_cast<std::size_t>(bytes));
        verdict = calibrate_planar<Scalar>(views, picture, options,
                                           {scratch.data(), static_cast<std::ptrdiff_t>(bytes)},
                                           {fits.data(), views.size()}, calibration);
    }
};

/// calibrate_stereo() the same.
template <class Scalar>
struct StereoRun {
    CalibrationVerdict verdict;
    StereoCalibration<Scalar> calibration;
    std::vector<CalibratedView<Scalar>> fits;

    StereoRun(Span<const StereoView> views, const CalibratedCamera<Scalar>& left,
              const CalibratedCamera<Scalar>& right, const StereoOptions& options = {})
        : fits(static_cast<std::size_t>(views.size())) {
        const std::int64_t bytes = calibrate_stereo_scratch<Scalar>(static_cast<int>(views.size()));
        std::vector<std::uint8_t> scratch(static_cast<std::size_t>(bytes));
        verdict = calibrate_stereo<Scalar>(views, left, right, options,
                                           {scratch.data(), static_cast<std::ptrdiff_t>(bytes)},
                                           {fits.data(), views.size()}, calibration);
    }
};

/// The largest difference between two cameras, in standard deviations of the estimated terms.
template <class Scalar, class Other>
double deviations_between(const Camera<Scalar>& a, const Camera<Other>& b, const Camera<Scalar>& deviation) {
    double most = 0;
    for (int i = 0; i < camera_terms; ++i) {
        const auto term = static_cast<CameraTerm>(i);
        const long double difference = value_of(term_of(a, term)) - value_of(term_of(b, term));
        const long double one = value_of(term_of(deviation, term));
        if (one != 0) most = std::max(most, static_cast<double>(std::abs(difference) / one));
    }
    return most;
}

}  // namespace fovea::test
