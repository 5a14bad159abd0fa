// SPDX-License-Identifier: MIT
#include <cstdint>
#include <vector>

#include <fovea/camera/calibrate_planar.hpp>
#include <fovea/stereo/calibrate_stereo.hpp>

#include <bench/harness.hpp>
#include <support/board_corners.hpp>

#if defined(FOVEA_HAVE_OPENCV_CALIB3D)
#include <opencv2/calib3d.hpp>
#endif

namespace fovea::bench {
namespace {

constexpr test::BoardCorners corners = test::board_corners();

/// What a calibration of all views works on.
struct Work {
    std::vector<PlanarView> left;
    std::vector<StereoView> pairs;
    std::vector<std::uint8_t> scratch;
    std::vector<CalibratedView<>> fits{test::board_views};
    PlanarCalibration<> camera;
    StereoCalibration<> rig;

    Work() : scratch(static_cast<std::size_t>(calibrate_stereo_scratch(test::board_views))) {
        for (int view = 0; view < test::board_views; ++view) {
            left.push_back({corners.board, corners.left[view]});
            pairs.push_back({corners.board, corners.left[view], corners.right[view]});
        }
    }
    Span<std::uint8_t> room() { return {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}; }
    bool calibrate() {
        return calibrate_planar<Real>({left.data(), test::board_views}, test::board_picture, {}, room(),
                                      {fits.data(), test::board_views}, camera)
            .ok();
    }
    /// With the left camera for both: the work is the same.
    bool calibrate_pair() {
        const CalibratedCamera<> one{camera.camera, test::board_picture};
        return calibrate_stereo<Real>({pairs.data(), test::board_views}, one, one, {}, room(),
                                      {fits.data(), test::board_views}, rig)
            .ok();
    }
};

#if defined(FOVEA_HAVE_OPENCV_CALIB3D)
void compare_with_opencv(Row& row) {
    using Boards = std::vector<std::vector<cv::Point3f>>;
    using Pictures = std::vector<std::vector<cv::Point2f>>;
    auto& boards = row.keep(Boards(test::board_views));
    auto& seen = row.keep(Pictures(test::board_views));
    for (std::size_t view = 0; view < test::board_views; ++view)
        for (int i = 0; i < test::board_points; ++i) {
            const SubPixelPoint point = corners.left[view][i];
            boards[view].emplace_back(static_cast<float>(i % 9), static_cast<float>(i / 9), 0.0f);
            seen[view].emplace_back(static_cast<float>(point.x.raw()) / 256,
                                    static_cast<float>(point.y.raw()) / 256);
        }
    row.peer("OpenCV", [&] {
        cv::Mat camera;
        cv::Mat lens;
        std::vector<cv::Mat> rotations;
        std::vector<cv::Mat> translations;
        consume(cv::calibrateCamera(boards, seen, cv::Size(640, 480), camera, lens, rotations, translations,
                                    cv::CALIB_FIX_K3));
    });
}
#endif

const bool planar_added = add(54, "calibrate_planar, 13 views of 54 corners", Sizes::vga, [](Row& row) {
    auto& work = row.keep(Work());
    row.not_per_pixel();
    row.ours([&] { consume(work.calibrate()); });
#if defined(FOVEA_HAVE_OPENCV_CALIB3D)
    compare_with_opencv(row);
#endif
});
const bool stereo_added = add(54, "calibrate_stereo, 13 pairs, cameras held", Sizes::vga, [](Row& row) {
    auto& work = row.keep(Work());
    consume(work.calibrate());
    row.not_per_pixel();
    row.ours([&] { consume(work.calibrate_pair()); });
});

}  // namespace
}  // namespace fovea::bench
