// SPDX-License-Identifier: MIT
#include <cstdlib>
#include <vector>

#include <fovea/draw/arrow.hpp>
#include <fovea/draw/circle.hpp>
#include <fovea/draw/cross.hpp>
#include <fovea/draw/line.hpp>
#include <fovea/draw/polygon.hpp>
#include <fovea/draw/rectangle.hpp>
#include <fovea/draw/text.hpp>

#include <bench/harness.hpp>
#include <bench/opencv.hpp>
#include <bench/pictures.hpp>

namespace fovea::bench {
namespace {

constexpr Rgb888 orange{255, 160, 30};
constexpr char words[] = "hole_2 10.299 mm HIGH (most 10.085)";

/// 64 points all over an image.
struct Points {
    explicit Points(Size size) {
        Random random(7);
        for (Point& point : at)
            point = {random.between(0, size.width - 1), random.between(0, size.height - 1)};
    }
    Point at[64];
};

/// draw(image, i) for every i of 0..63. Answers the picture, for a peer to draw into.
template <class Draw>
Picture<Rgb888>& time_drawing(Row& row, Draw draw) {
    row.not_per_pixel();
    auto& picture = row.keep(coloured_part(row.size()));
    row.ours([&picture, draw] {
        for (int i = 0; i < 64; ++i)
            if (draw(picture.view(), i) != Status::ok) std::abort();
        consume(picture);
    });
    return picture;
}

#if defined(FOVEA_HAVE_OPENCV)
/// The same by OpenCV.
template <class Draw>
void time_opencv(Row& row, Picture<Rgb888>& picture, Draw draw) {
    row.peer("OpenCV", [image = mat(picture), draw]() mutable {
        for (int i = 0; i < 64; ++i) draw(image, i);
    });
}
const cv::Scalar cv_orange(255, 160, 30);
cv::Point cv_point(Point point) { return {point.x, point.y}; }
#endif

const bool lines_added = add(54, "64 lines", Sizes::vga, [](Row& row) {
    const auto& at = row.keep(Points(row.size())).at;
    [[maybe_unused]] auto& picture =
        time_drawing(row, [&](auto image, int i) { return draw_line(image, at[i], at[63 - i], orange); });
#if defined(FOVEA_HAVE_OPENCV)
    time_opencv(row, picture, [&](cv::Mat& image, int i) {
        cv::line(image, cv_point(at[i]), cv_point(at[63 - i]), cv_orange);
    });
#endif
});

const bool thick_lines_added = add(55, "64 lines of 3 px, with arrow heads", Sizes::vga, [](Row& row) {
    const auto& at = row.keep(Points(row.size())).at;
    [[maybe_unused]] auto& picture = time_drawing(
        row, [&](auto image, int i) { return draw_arrow(image, at[i], at[63 - i], orange, 9, 3); });
#if defined(FOVEA_HAVE_OPENCV)
    time_opencv(row, picture, [&](cv::Mat& image, int i) {
        cv::arrowedLine(image, cv_point(at[i]), cv_point(at[63 - i]), cv_orange, 3);
    });
#endif
});

const bool marks_added = add(56, "64 crosses and rectangles", Sizes::vga, [](Row& row) {
    const auto& at = row.keep(Points(row.size())).at;
    [[maybe_unused]] auto& picture = time_drawing(row, [&](auto image, int i) {
        if (const Status crossed = draw_cross(image, at[i], 5, orange); crossed != Status::ok) return crossed;
        if (const Status crossed = draw_diagonal_cross(image, at[i], 5, orange); crossed != Status::ok)
            return crossed;
        return draw_rectangle(image, {at[i].x, at[i].y, 60, 30}, orange);
    });
#if defined(FOVEA_HAVE_OPENCV)
    time_opencv(row, picture, [&](cv::Mat& image, int i) {
        cv::drawMarker(image, cv_point(at[i]), cv_orange, cv::MARKER_CROSS, 11);
        cv::drawMarker(image, cv_point(at[i]), cv_orange, cv::MARKER_TILTED_CROSS, 11);
        cv::rectangle(image, cv_point(at[i]), cv::Point(at[i].x + 59, at[i].y + 29), cv_orange);
    });
#endif
});

const bool circles_added = add(57, "64 circles of radius 40", Sizes::vga, [](Row& row) {
    const auto& at = row.keep(Points(row.size())).at;
    [[maybe_unused]] auto& picture =
        time_drawing(row, [&](auto image, int i) { return draw_circle(image, at[i], 40, orange); });
#if defined(FOVEA_HAVE_OPENCV)
    time_opencv(row, picture,
                [&](cv::Mat& image, int i) { cv::circle(image, cv_point(at[i]), 40, cv_orange); });
#endif
});

const bool discs_added = add(58, "64 discs of radius 40 and filled rectangles", Sizes::vga, [](Row& row) {
    const auto& at = row.keep(Points(row.size())).at;
    [[maybe_unused]] auto& picture = time_drawing(row, [&](auto image, int i) {
        if (const Status filled = fill_circle(image, at[i], 40, orange); filled != Status::ok) return filled;
        return fill_rectangle(image, {at[i].x, at[i].y, 60, 30}, orange);
    });
#if defined(FOVEA_HAVE_OPENCV)
    time_opencv(row, picture, [&](cv::Mat& image, int i) {
        cv::circle(image, cv_point(at[i]), 40, cv_orange, cv::FILLED);
        cv::rectangle(image, cv_point(at[i]), cv::Point(at[i].x + 59, at[i].y + 29), cv_orange, cv::FILLED);
    });
#endif
});

const bool polygons_added =
    add(59, "64 polygons of 5 corners, filled and outlined", Sizes::vga, [](Row& row) {
        const auto& at = row.keep(Points(row.size())).at;
        auto& scratch = row.keep(std::vector<PolygonEdge>(fill_polygon_scratch(5)));
        [[maybe_unused]] auto& picture = time_drawing(row, [&](auto image, int i) {
            const Span<const Point> corners(&at[i % 60], 5);
            if (const Status filled = fill_polygon(image, corners, orange, {scratch.data(), 5});
                filled != Status::ok)
                return filled;
            return draw_polygon(image, corners, orange);
        });
#if defined(FOVEA_HAVE_OPENCV)
        time_opencv(row, picture, [&](cv::Mat& image, int i) {
            std::vector<std::vector<cv::Point>> corners(1);
            for (int k = 0; k < 5; ++k) corners[0].push_back(cv_point(at[i % 60 + k]));
            cv::fillPoly(image, corners, cv_orange);
            cv::polylines(image, corners, true, cv_orange);
        });
#endif
    });

const bool labels_added = add(60, "64 labels of 35 letters", Sizes::vga, [](Row& row) {
    const auto& at = row.keep(Points(row.size())).at;
    time_drawing(row, [&](auto image, int i) { return draw_label(image, at[i], words, orange, Rgb888{}); });
});

}  // namespace
}  // namespace fovea::bench
