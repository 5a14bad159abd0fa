// SPDX-License-Identifier: MIT
#include <cstdlib>

#include <fovea/feature/canny.hpp>
#include <fovea/feature/canny_points.hpp>
#include <fovea/feature/find_circles.hpp>
#include <fovea/feature/hough_circles.hpp>
#include <fovea/feature/hough_lines.hpp>
#include <fovea/feature/line_segments.hpp>

#include <bench/harness.hpp>
#include <bench/opencv.hpp>
#include <bench/pictures.hpp>

namespace fovea::bench {
namespace {

/// Lists and scratch for everything here.
struct Found {
    std::vector<EdgePoint> points = std::vector<EdgePoint>(40000);
    std::vector<PolarLine> lines = std::vector<PolarLine>(100);
    std::vector<LineSegment> segments = std::vector<LineSegment>(1000);
    Bytes scratch;
    int point_count = 0;
    int line_count = 0;
    int segment_count = 0;

    template <class T>
    static ListView<T> list(std::vector<T>& room, int& count) {
        return {room.data(), static_cast<int>(room.size()), &count};
    }
    ListView<EdgePoint> point_list() { return list(points, point_count); }
    ListView<PolarLine> line_list() { return list(lines, line_count); }
    ListView<LineSegment> segment_list() { return list(segments, segment_count); }
    Span<const EdgePoint> point_span() const { return {points.data(), point_count}; }
    Span<const PolarLine> line_span() const { return {lines.data(), line_count}; }
};

void must_be_ok(Status s) {
    if (s != Status::ok) std::abort();
}

/// The plate's outline and holes, and how many pixels they are.
Picture<Gray8> edges_of(Picture<Gray8>& src, Size size) {
    Picture<Gray8> edges(size);
    Bytes scratch = bytes(canny_scratch(size));
    must_be_ok(canny(src.view(), 60, 150, Border::replicate, span_of(scratch), edges.view()));
    return edges;
}

const bool points_added = add(2001, "points of Canny's edges", Sizes::vga, [](Row& row) {
    auto& src = row.keep(part(row.size()));
    auto& edges = row.keep(edges_of(src, row.size()));
    auto& found = row.keep(Found());
    row.ours([&] { consume(canny_points(src.view(), edges.view(), Border::replicate, found.point_list())); });
});

HoughLineOptions line_options() {
    HoughLineOptions options;
    options.min_votes = 60;
    return options;
}

#if defined(FOVEA_HAVE_OPENCV)
void opencv_lines(Row& row, Picture<Gray8>& edges) {
    row.peer("OpenCV", [a = mat(edges), lines = std::vector<cv::Vec2f>()]() mutable {
        cv::HoughLines(a, lines, 1, CV_PI / 180, 60);
    });
}
#else
void opencv_lines(Row&, Picture<Gray8>&) {}
#endif

const bool lines_added = add(2010, "Hough lines", Sizes::vga_and_full_hd, [](Row& row) {
    auto& src = row.keep(part(row.size()));
    auto& edges = row.keep(edges_of(src, row.size()));
    auto& found = row.keep(Found());
    found.scratch = bytes(hough_lines_scratch(row.size(), line_options()));
    row.ours([&] {
        consume(hough_lines(edges.view(), line_options(), span_of(found.scratch), found.line_list()));
    });
    opencv_lines(row, edges);
});

const bool directed_added = add(2011, "Hough lines, directed", Sizes::vga_and_full_hd, [](Row& row) {
    auto& src = row.keep(part(row.size()));
    auto& edges = row.keep(edges_of(src, row.size()));
    auto& found = row.keep(Found());
    found.scratch = bytes(hough_lines_scratch(row.size(), line_options()));
    must_be_ok(canny_points(src.view(), edges.view(), Border::replicate, found.point_list()));
    row.ours([&, size = row.size()] {
        consume(hough_lines_directed(found.point_span(), size, line_options(), span_of(found.scratch),
                                     found.line_list()));
    });
    opencv_lines(row, edges);
});

const bool segments_added = add(2012, "line segments", Sizes::vga, [](Row& row) {
    auto& src = row.keep(part(row.size()));
    auto& edges = row.keep(edges_of(src, row.size()));
    auto& found = row.keep(Found());
    found.scratch = bytes(hough_lines_scratch(row.size(), line_options()));
    row.ours([&] {
        consume(hough_lines(edges.view(), line_options(), span_of(found.scratch), found.line_list()));
        consume(line_segments(edges.view(), found.line_span(), {}, found.segment_list()));
    });
#if defined(FOVEA_HAVE_OPENCV)
    row.peer("OpenCV", [a = mat(edges), lines = std::vector<cv::Vec4i>()]() mutable {
        cv::HoughLinesP(a, lines, 1, CV_PI / 180, 60, 20, 2);
    });
#endif
});

/// From the picture to the circles, as OpenCV's function does it.
const bool circles_added = add(2020, "Hough circles of 10..100 px, with Canny", Sizes::vga, [](Row& row) {
    auto& src = row.keep(part(row.size()));
    auto& edges = row.keep(Picture<Gray8>(row.size()));
    auto& found = row.keep(Found());
    auto& circles = row.keep(std::vector<HoughCircle>(100));
    auto& count = row.keep(0);
    HoughCircleOptions options;
    options.min_share = Ratio::from_ratio(1, 2);
    const auto room = static_cast<std::int64_t>(found.points.size());
    found.scratch = bytes(hough_circles_scratch(row.size(), room, options) + canny_scratch(row.size()));
    row.ours([&, options, size = row.size()] {
        consume(canny(src.view(), 75, 150, Border::replicate, span_of(found.scratch), edges.view()));
        consume(canny_points(src.view(), edges.view(), Border::replicate, found.point_list()));
        consume(hough_circles(found.point_span(), size, options, span_of(found.scratch),
                              Found::list(circles, count)));
    });
#if defined(FOVEA_HAVE_OPENCV)
    row.peer("OpenCV", [a = mat(src), found = std::vector<cv::Vec3f>()]() mutable {
        cv::HoughCircles(a, found, cv::HOUGH_GRADIENT, 2, 10, 150, 60, 10, 100);
    });
#endif
});

/// The same in one call, without smoothing, which OpenCV's function does not do either.
const bool finder_added = add(2021, "find_circles, 10..100 px", Sizes::vga_and_full_hd, [](Row& row) {
    auto& src = row.keep(part(row.size()));
    auto& circles = row.keep(std::vector<HoughCircle>(100));
    auto& count = row.keep(0);
    FindCirclesOptions options;
    options.smoothing = EdgeSmoothing::none;
    options.low = 75;
    options.high = 150;
    options.max_points = 40000;
    options.circles.min_share = Ratio::from_ratio(1, 2);
    auto& scratch = row.keep(bytes(find_circles_scratch(row.size(), options)));
    row.ours([&, options] {
        must_be_ok(find_circles(src.view(), options, span_of(scratch), Found::list(circles, count)));
    });
#if defined(FOVEA_HAVE_OPENCV)
    row.peer("OpenCV", [a = mat(src), found = std::vector<cv::Vec3f>()]() mutable {
        cv::HoughCircles(a, found, cv::HOUGH_GRADIENT, 2, 10, 150, 60, 10, 100);
    });
#endif
});

}  // namespace
}  // namespace fovea::bench
