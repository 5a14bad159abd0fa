// SPDX-License-Identifier: MIT
//
// Times of undistortion maps.
#include <fovea/camera/undistortion_map.hpp>

#include <bench/harness.hpp>
#include <bench/opencv.hpp>
#include <bench/pictures.hpp>

#if defined(FOVEA_HAVE_OPENCV_CALIB3D)
#include <opencv2/calib3d.hpp>
#endif

namespace fovea::bench {
namespace {

/// The left camera of OpenCV's pictures, for pictures of any width.
Camera<> lens_of(Size size) {
    const auto px = [&](int value) { return Real::from_ratio(std::int64_t{value} * size.width, 640000); };
    Camera<> camera;
    camera.fx = px(536455);
    camera.fy = px(536407);
    camera.cx = px(342368);
    camera.cy = px(235543);
    camera.k1 = Real::from_ratio(-278653, 1000000);
    camera.k2 = Real::from_ratio(67248, 1000000);
    camera.p1 = Real::from_ratio(1821, 1000000);
    camera.p2 = Real::from_ratio(-345, 1000000);
    return camera;
}
/// Some degrees about each axis.
Matrix<3, 3> turn() {
    return rotation_about(
        Vector<3>(Real::from_ratio(1, 50), Real::from_ratio(-1, 30), Real::from_ratio(1, 90)));
}

void map_line(Row& row, const Matrix<3, 3>& rotation) {
    const Camera<> camera = lens_of(row.size());
    auto& points = row.keep(Picture<MapPoint>(row.size()));
    auto& map = row.keep(*undistortion_map(LensInverse<>(camera), rotation, camera, row.size()));
    row.ours([&points, &map] { consume(undistortion_points(map, points.view())); });
#if defined(FOVEA_HAVE_OPENCV_CALIB3D)
    // The same numbers, to 2^-30.
    const auto plain = [](Real number) { return static_cast<double>(number.rounded(30)) / (1 << 30); };
    cv::Mat matrix = cv::Mat::eye(3, 3, CV_64F);
    matrix.at<double>(0, 0) = plain(camera.fx);
    matrix.at<double>(1, 1) = plain(camera.fy);
    matrix.at<double>(0, 2) = plain(camera.cx);
    matrix.at<double>(1, 2) = plain(camera.cy);
    cv::Mat turned(3, 3, CV_64F);
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) turned.at<double>(r, c) = plain(rotation(r, c));
    const cv::Mat lens = (cv::Mat_<double>(1, 5) << plain(camera.k1), plain(camera.k2), plain(camera.p1),
                          plain(camera.p2), plain(camera.k3));
    const cv::Size size(row.size().width, row.size().height);
    row.peer("OpenCV, initUndistortRectifyMap", [=] {
        cv::Mat places, parts;
        cv::initUndistortRectifyMap(matrix, lens, turned, matrix, size, CV_16SC2, places, parts);
    });
#endif
}

const bool straight_added = add(1630, "undistortion_points", Sizes::vga_and_full_hd,
                                [](Row& row) { map_line(row, Matrix<3, 3>::identity()); });
const bool turned_added = add(1631, "undistortion_points, rectified", Sizes::vga_and_full_hd,
                              [](Row& row) { map_line(row, turn()); });

}  // namespace
}  // namespace fovea::bench
