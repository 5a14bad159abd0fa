// SPDX-License-Identifier: MIT
#include <fovea/pixelwise/threshold.hpp>
#include <fovea/segment/approximate_polygon.hpp>
#include <fovea/segment/connected_components.hpp>
#include <fovea/segment/contour.hpp>
#include <fovea/segment/convex_hull.hpp>
#include <fovea/segment/find_contours.hpp>
#include <fovea/segment/minimum_rectangle.hpp>
#include <fovea/segment/polygon.hpp>

#include <bench/harness.hpp>
#include <bench/opencv.hpp>
#include <bench/pictures.hpp>

namespace fovea::bench {
namespace {

/// A list of its own memory, of any length.
template <class T>
struct Room {
    explicit Room(int capacity) : elements(static_cast<std::size_t>(capacity)) {}
    ListView<T> list() { return {elements.data(), static_cast<int>(elements.size()), &count}; }
    std::vector<T> elements;
    int count = 0;
};

struct Found {
    Room<RegionOf<FirstMoments>> regions{2000};
    Room<HoleOf<FirstMoments>> holes{2000};
    Room<Point> points{400000};
    Room<Contour> contours{4000};
};

void find(ImageView<const Gray8> binary, Span<std::uint8_t> scratch, Found& found) {
    consume(
        connected_components<FirstMoments>(binary, {}, scratch, found.regions.list(), found.holes.list()));
    consume(trace_contours<FirstMoments>(binary, Connectivity::eight, ContourPoints::all,
                                         found.regions.list().span(), found.holes.list().span(),
                                         found.points.list(), found.contours.list()));
}

Picture<Gray8> dark_part(Size size) {
    Picture<Gray8> picture = part(size);
    consume(threshold_inverse(picture.view(), 128, picture.view()));
    return picture;
}

void time_contours(Row& row, Picture<Gray8> picture) {
    auto& src = row.keep(std::move(picture));
    auto& found = row.keep(Found());
    auto& scratch = row.keep(bytes(connected_components_scratch<FirstMoments>(row.size().width)));
    row.ours([&] { find(src.view(), span_of(scratch), found); });
#if defined(FOVEA_HAVE_OPENCV)
    auto& contours = row.keep(std::vector<std::vector<cv::Point>>());
    row.peer("OpenCV", [a = mat(src), &contours] {
        cv::findContours(a, contours, cv::RETR_CCOMP, cv::CHAIN_APPROX_NONE);
    });
#endif
}

const bool discs_added = add(1820, "trace_contours, 400 discs", Sizes::vga_and_full_hd,
                             [](Row& row) { time_contours(row, blobs(row.size())); });
const bool part_added = add(1821, "trace_contours, one part", Sizes::vga_and_full_hd,
                            [](Row& row) { time_contours(row, dark_part(row.size())); });

void time_scan(Row& row, Picture<Gray8> picture) {
    auto& src = row.keep(std::move(picture));
    auto& found = row.keep(Found());
    auto& scratch = row.keep(bytes(find_contours_scratch(row.size())));
    row.ours([&] {
        consume(find_contours(src.view(), Connectivity::eight, ContourPoints::all, span_of(scratch),
                              found.points.list(), found.contours.list()));
    });
#if defined(FOVEA_HAVE_OPENCV)
    auto& contours = row.keep(std::vector<std::vector<cv::Point>>());
    row.peer("OpenCV", [a = mat(src), &contours] {
        cv::findContours(a, contours, cv::RETR_LIST, cv::CHAIN_APPROX_NONE);
    });
#endif
}

const bool scan_discs_added = add(1818, "find_contours, 400 discs", Sizes::vga_and_full_hd,
                                  [](Row& row) { time_scan(row, blobs(row.size())); });
const bool scan_part_added = add(1819, "find_contours, one part", Sizes::vga_and_full_hd,
                                 [](Row& row) { time_scan(row, dark_part(row.size())); });

/// The longest contour of the part.
Span<const Point> outline(Row& row, Found& found) {
    auto& src = row.keep(dark_part(row.size()));
    auto& scratch = row.keep(bytes(connected_components_scratch<FirstMoments>(row.size().width)));
    find(src.view(), span_of(scratch), found);
    Contour longest;
    for (const Contour& contour : found.contours.list())
        if (contour.count > longest.count) longest = contour;
    return {found.points.elements.data() + longest.first, longest.count};
}

[[maybe_unused]] auto opencv_points(Span<const Point> points) {
#if defined(FOVEA_HAVE_OPENCV)
    std::vector<cv::Point> all;
    for (const Point p : points) all.emplace_back(p.x, p.y);
    return all;
#else
    return points;
#endif
}

const bool hull_added = add(1822, "convex_hull, a contour", Sizes::vga, [](Row& row) {
    row.not_per_pixel();
    auto& found = row.keep(Found());
    const Span<const Point> points = outline(row, found);
    auto& scratch = row.keep(bytes(convex_hull_scratch(points.size())));
    auto& hull = row.keep(Room<Point>(static_cast<int>(points.size())));
    row.ours([points, &scratch, &hull] { consume(convex_hull(points, span_of(scratch), hull.list())); });
#if defined(FOVEA_HAVE_OPENCV)
    row.peer("OpenCV", [all = opencv_points(points), out = std::vector<cv::Point>()]() mutable {
        cv::convexHull(all, out);
    });
#endif
});

const bool rectangle_added = add(1823, "minimum_area_rectangle, a contour", Sizes::vga, [](Row& row) {
    row.not_per_pixel();
    auto& found = row.keep(Found());
    const Span<const Point> points = outline(row, found);
    auto& scratch = row.keep(bytes(convex_hull_scratch(points.size())));
    auto& hull = row.keep(Room<Point>(static_cast<int>(points.size())));
    row.ours([points, &scratch, &hull] {
        consume(convex_hull(points, span_of(scratch), hull.list()));
        consume(minimum_area_rectangle(hull.list().span()));
    });
#if defined(FOVEA_HAVE_OPENCV)
    row.peer("OpenCV", [all = opencv_points(points)] { consume(cv::minAreaRect(all)); });
#endif
});

const bool approximation_added = add(1824, "approximate_polygon, a contour", Sizes::vga, [](Row& row) {
    row.not_per_pixel();
    auto& found = row.keep(Found());
    const Span<const Point> points = outline(row, found);
    auto& scratch = row.keep(bytes(approximate_polygon_scratch(points.size())));
    auto& corners = row.keep(Room<Point>(static_cast<int>(points.size())));
    row.ours([points, &scratch, &corners] {
        consume(approximate_polygon(points, Closure::closed, SubPixel::from_int(2), span_of(scratch),
                                    corners.list()));
    });
#if defined(FOVEA_HAVE_OPENCV)
    row.peer("OpenCV", [all = opencv_points(points), out = std::vector<cv::Point>()]() mutable {
        cv::approxPolyDP(all, out, 2, true);
    });
#endif
});

const bool length_added = add(1825, "polygon_length and doubled_area, a contour", Sizes::vga, [](Row& row) {
    row.not_per_pixel();
    auto& found = row.keep(Found());
    const Span<const Point> points = outline(row, found);
    row.ours([points] {
        consume(polygon_length(points, Closure::closed));
        consume(doubled_area(points));
    });
#if defined(FOVEA_HAVE_OPENCV)
    row.peer("OpenCV", [all = opencv_points(points)] {
        consume(cv::arcLength(all, true));
        consume(cv::contourArea(all));
    });
#endif
});

}  // namespace
}  // namespace fovea::bench
