// SPDX-License-Identifier: MIT
#include <cstdlib>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/camera/checkerboard.hpp>
#include <fovea/camera/circle_grid.hpp>
#include <fovea/camera/saddle_point.hpp>

#include <bench/operators.hpp>
#include <support/board_scene.hpp>

#if defined(FOVEA_HAVE_OPENCV_BOARDS)
#include <opencv2/calib3d.hpp>
#endif

namespace fovea::bench {
namespace {

/// A board as a hand holds it, nearly as high as the image.
test::BoardPicture board_in(Size size, test::BoardPattern pattern) {
    test::BoardScene scene;
    scene.picture = size;
    scene.pattern = pattern;
    const bool asymmetric = pattern == test::BoardPattern::asymmetric_circles;
    if (asymmetric) scene.board = {4, 11};
    scene.step = size.height / (asymmetric ? 15.0 : 11.0);
    scene.radius = asymmetric ? 0.45 : 0.3;
    scene.tilt = 30;
    scene.roll = 10;
    scene.noise = 2;
    Random random(1);
    return test::BoardView(scene).render(random);
}

/// What is timed has found its board.
void must_be_ok(Status status) {
    if (status != Status::ok) std::abort();
}

/// Where the board is there, with corners to a fraction of a pixel; and where none is.
bool add_checkerboard(int place, const char* name, bool there) {
    return add(place, name, Sizes::vga_and_full_hd, [there](Row& row) {
        auto& corners = row.keep(std::vector<SubPixelPoint>(54));
        auto& scratch = row.keep(bytes(find_checkerboard_scratch(row.size(), {9, 6}, {})));
        auto& board = row.keep(board_in(row.size(), test::BoardPattern::checkerboard));
        auto& none = row.keep(part(row.size()));
        const ImageView<const Gray8> src = there ? board.view() : none.view();
        row.ours([&, src, there] {
            const Status status = find_checkerboard(src, {9, 6}, {}, span_of(scratch), {corners.data(), 54});
            if (there) must_be_ok(status);
            consume(status);
        });
#if defined(FOVEA_HAVE_OPENCV_BOARDS)
        row.peer("OpenCV", [src, found = std::vector<cv::Point2f>()]() mutable {
            const cv::Mat image(src.height(), src.width(), CV_8UC1, const_cast<Gray8*>(src.first()),
                                static_cast<std::size_t>(src.stride_bytes()));
            if (cv::findChessboardCorners(image, {9, 6}, found))
                cv::cornerSubPix(image, found, {11, 11}, {-1, -1},
                                 {cv::TermCriteria::EPS + cv::TermCriteria::COUNT, 30, 0.01});
        });
#endif
    });
}
const bool boards_added[] = {add_checkerboard(2070, "find_checkerboard, 9x6", true),
                             add_checkerboard(2071, "find_checkerboard, where none is", false)};

const bool grid_added = add(2072, "find_circle_grid, 4x11", Sizes::vga_and_full_hd, [](Row& row) {
    auto& centres = row.keep(std::vector<SubPixelPoint>(44));
    CircleGridOptions options;
    options.pattern = CircleGridPattern::asymmetric;
    auto& scratch = row.keep(bytes(find_circle_grid_scratch(row.size(), {4, 11}, options)));
    auto& board = row.keep(board_in(row.size(), test::BoardPattern::asymmetric_circles));
    row.ours([&, options] {
        must_be_ok(find_circle_grid(board.view(), {4, 11}, options, span_of(scratch), {centres.data(), 44}));
    });
#if defined(FOVEA_HAVE_OPENCV_BOARDS)
    row.peer("OpenCV", [&board, found = std::vector<cv::Point2f>()]() mutable {
        const cv::Mat image(board.size.height, board.size.width, CV_8UC1, board.pixels.data());
        cv::findCirclesGrid(image, {4, 11}, found, cv::CALIB_CB_ASYMMETRIC_GRID);
    });
#endif
});

const bool saddle_added = add(2073, "refine_saddle_point, 12 px", Sizes::vga_and_full_hd, [](Row& row) {
    auto& board = row.keep(board_in(row.size(), test::BoardPattern::checkerboard));
    // The middle of the board is between corners; nine by six has a corner half a step beside it.
    const SubPixelPoint start{SubPixel::from_int(row.size().width / 2),
                              SubPixel::from_int(row.size().height / 2 - row.size().height / 22)};
    row.ours([&board, start] {
        consume(refine_saddle_point(board.view(), start, SubPixel::from_int(12)).status());
    });
});

}  // namespace
}  // namespace fovea::bench
