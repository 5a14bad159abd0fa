// SPDX-License-Identifier: MIT
#include <cmath>

#include <fovea/warp/homography.hpp>
#include <fovea/warp/remap.hpp>
#include <fovea/warp/remap_curved.hpp>

#include <bench/operators.hpp>

namespace fovea::bench {
namespace {

// Values of the catalogue's interpolation and outside: bilinear, constant.
constexpr int bilinear = 1;
constexpr int constant = 1;

/// OpenCV's turn about the middle of an image, from the output to the source.
Peer turn([[maybe_unused]] double degrees, [[maybe_unused]] bool smooth) {
    return FOVEA_OPENCV_KEEPING(=, {
        const double angle = degrees * 3.14159265358979323846 / 180;
        const double c = std::cos(angle);
        const double s = std::sin(angle);
        const double x = (in[0].cols - 1) / 2.0;
        const double y = (in[0].rows - 1) / 2.0;
        const cv::Matx23d matrix(c, -s, x - c * x + s * y, s, c, y - s * x - c * y);
        cv::warpAffine(in[0], out, matrix, out.size(),
                       (smooth ? cv::INTER_LINEAR : cv::INTER_NEAREST) | cv::WARP_INVERSE_MAP);
    });
}
Peer flipped([[maybe_unused]] int how) { return FOVEA_OPENCV_KEEPING(=, cv::flip(in[0], out, how)); }
Peer resized([[maybe_unused]] int how) {
    return FOVEA_OPENCV_KEEPING(=, cv::resize(in[0], out, out.size(), 0, 0, how));
}
Peer transposed() { return FOVEA_OPENCV(cv::transpose(in[0], out)); }
/// By OpenCV's numbers: 0 clockwise, 2 counterclockwise.
Peer quarter([[maybe_unused]] int how) { return FOVEA_OPENCV_KEEPING(=, cv::rotate(in[0], out, how)); }
/// With the values of the lines below.
Peer affine() {
    return FOVEA_OPENCV({
        const cv::Matx23d matrix(900 / 1024.0, 200 / 1024.0, 2, -100 / 1024.0, 1100 / 1024.0, 2);
        cv::warpAffine(in[0], out, matrix, out.size(), cv::INTER_LINEAR | cv::WARP_INVERSE_MAP);
    });
}
Peer projective() {
    return FOVEA_OPENCV({
        const cv::Matx33d matrix(1, 100 / 1024.0, 2, -50 / 1024.0, 1, 2, 150 / 1048576.0, -120 / 1048576.0,
                                 1);
        cv::warpPerspective(in[0], out, matrix, out.size(), cv::INTER_LINEAR | cv::WARP_INVERSE_MAP);
    });
}
/// As in the lines below; OpenCV's radii are exp(k x) - 1 where ours begin at the inner one.
Peer polar([[maybe_unused]] int how) {
    return FOVEA_OPENCV_KEEPING(
        =, cv::warpPolar(in[0], out, out.size(),
                         cv::Point2f(static_cast<float>(in[0].cols) / 2, static_cast<float>(in[0].rows) / 2),
                         240, how));
}
Peer smaller() { return FOVEA_OPENCV(cv::pyrDown(in[0], out, out.size(), cv::BORDER_REPLICATE)); }
Peer larger() { return FOVEA_OPENCV(cv::pyrUp(in[0], out)); }
[[maybe_unused]] constexpr int nearest_pixel = 0, linear = 1, cubic = 2, area = 3, logarithmic = 256;

const bool lines[] = {
    add_operator(1600, "flip_x", Sizes::vga_and_full_hd, {}, flipped(1)),
    add_operator(1601, "flip_x_rgb", Sizes::vga, {}, flipped(1), "flip_x, colour"),
    add_operator(1602, "flip_y", Sizes::vga, {}, flipped(0)),
    add_operator(1603, "rotate_180", Sizes::vga, {}, flipped(-1)),
    add_operator(1604, "transpose", Sizes::vga_and_full_hd, {}, transposed()),
    add_operator(1605, "transpose_rgb", Sizes::vga, {}, transposed(), "transpose, colour"),
    add_operator(1606, "rotate_90_clockwise", Sizes::vga, {}, quarter(0)),
    add_operator(1607, "rotate_90_counterclockwise", Sizes::vga, {}, quarter(2)),
    add_operator(1610, "rotate", Sizes::vga_and_full_hd, {30, bilinear, constant}, turn(30, true),
                 "rotate by 30 degrees"),
    add_operator(1611, "rotate", Sizes::vga, {30, 0, constant}, turn(30, false), "rotate, nearest pixel"),
    add_operator(1612, "rotate_rgb", Sizes::vga, {30, bilinear, constant}, turn(30, true), "rotate, colour"),
    add_operator(1613, "warp_affine", Sizes::vga_and_full_hd,
                 {900, 200, -100, 1100, 2, 2, bilinear, constant}, affine()),
    add_operator(1614, "warp_homography", Sizes::vga_and_full_hd,
                 {150, -120, 100, -50, 2, 2, bilinear, constant}, projective()),
    add_operator(1615, "polar", Sizes::vga, {640, 480, 1, 240, bilinear, constant, 0}, polar(linear),
                 "polar"),
    add_operator(1616, "log_polar", Sizes::vga, {640, 480, 1, 240, bilinear, constant, 0},
                 polar(linear | logarithmic), "log_polar"),
    add_operator(1630, "resize_nearest", Sizes::vga, {467, 350}, resized(nearest_pixel),
                 "resize_nearest to 467x350"),
    add_operator(1631, "resize_bilinear", Sizes::vga, {467, 350}, resized(linear),
                 "resize_bilinear to 467x350"),
    add_operator(1632, "resize_bilinear", Sizes::vga, {1024, 768}, resized(linear),
                 "resize_bilinear to 1024x768"),
    add_operator(1633, "resize_bicubic", Sizes::vga, {467, 350}, resized(cubic), "resize_bicubic to 467x350"),
    add_operator(1634, "resize_area", Sizes::vga, {320, 240}, resized(area), "resize_area to 320x240"),
    add_operator(1635, "resize_area", Sizes::vga, {160, 120}, resized(area), "resize_area to 160x120"),
    add_operator(1636, "resize_area", Sizes::vga, {256, 192}, resized(area), "resize_area to 256x192"),
    add_operator(1637, "pyramid_down", Sizes::vga_and_full_hd, {}, smaller()),
    add_operator(1638, "pyramid_up", Sizes::vga, {}, larger()),
};

/// A map that takes the barrel distortion out of an image.
struct Lens {
    double cx;
    double cy;

    explicit Lens(Size size) : cx((size.width - 1) / 2.0), cy((size.height - 1) / 2.0) {}
    double scale(int x, int y) const {
        const double radius = ((x - cx) * (x - cx) + (y - cy) * (y - cy)) / (cx * cx);
        return 1 - 0.2 * radius + 0.05 * radius * radius;
    }
    double x_of(int x, int y) const { return cx + (x - cx) * scale(x, y); }
    double y_of(int x, int y) const { return cy + (y - cy) * scale(x, y); }
    MapPoint point(int x, int y) const {
        return {SubPixel::from_raw(static_cast<std::int32_t>(std::lround(256 * x_of(x, y)))),
                SubPixel::from_raw(static_cast<std::int32_t>(std::lround(256 * y_of(x, y))))};
    }
    MapOffset offset(int x, int y) const {
        return {static_cast<std::int16_t>(std::lround(32 * (x_of(x, y) - x))),
                static_cast<std::int16_t>(std::lround(32 * (y_of(x, y) - y)))};
    }
};

/// The peer of the three forms of a map: OpenCV's fastest, places of 16 bits with 5 more in a second map.
void add_remap_peer([[maybe_unused]] Row& row, [[maybe_unused]] Picture<Gray8>& src,
                    [[maybe_unused]] Picture<Gray8>& dst) {
#if defined(FOVEA_HAVE_OPENCV)
    const Lens lens(row.size());
    cv::Mat map_x(row.size().height, row.size().width, CV_32F);
    cv::Mat map_y(row.size().height, row.size().width, CV_32F);
    for (int y = 0; y < row.size().height; ++y)
        for (int x = 0; x < row.size().width; ++x) {
            map_x.at<float>(y, x) = static_cast<float>(lens.x_of(x, y));
            map_y.at<float>(y, x) = static_cast<float>(lens.y_of(x, y));
        }
    cv::Mat places, parts;
    cv::convertMaps(map_x, map_y, places, parts, CV_16SC2);
    row.peer("OpenCV", [a = mat(src), b = mat(dst), places, parts]() mutable {
        cv::remap(a, b, places, parts, cv::INTER_LINEAR);
    });
#endif
}

template <class Point, class Fill, class Run>
void remap_line(Row& row, Size map_size, Fill fill, Run run) {
    auto& src = row.keep(part(row.size()));
    auto& dst = row.keep(Picture<Gray8>(row.size()));
    auto& map = row.keep(Picture<Point>(map_size));
    for (int y = 0; y < map_size.height; ++y)
        for (int x = 0; x < map_size.width; ++x) map.view()(x, y) = fill(x, y);
    row.ours([&src, &dst, &map, run] { consume(run(src.view(), map.view(), dst.view())); });
    add_remap_peer(row, src, dst);
}

const bool dense_added = add(1620, "remap", Sizes::vga_and_full_hd, [](Row& row) {
    const Lens lens(row.size());
    remap_line<MapPoint>(
        row, row.size(), [=](int x, int y) { return lens.point(x, y); },
        [](ImageView<const Gray8> src, ImageView<const MapPoint> map, ImageView<Gray8> dst) {
            return remap<Gray8>(src, map, {}, dst);
        });
});
const bool offsets_added = add(1621, "remap_offsets", Sizes::vga_and_full_hd, [](Row& row) {
    const Lens lens(row.size());
    remap_line<MapOffset>(
        row, row.size(), [=](int x, int y) { return lens.offset(x, y); },
        [](ImageView<const Gray8> src, ImageView<const MapOffset> map, ImageView<Gray8> dst) {
            return remap_offsets<Gray8>(src, map, {}, dst);
        });
});
const bool grid_added = add(1622, "remap_grid", Sizes::vga_and_full_hd, [](Row& row) {
    const Lens lens(row.size());
    remap_line<MapPoint>(
        row, map_grid_size(row.size()), [=](int x, int y) { return lens.point(16 * x, 16 * y); },
        [](ImageView<const Gray8> src, ImageView<const MapPoint> map, ImageView<Gray8> dst) {
            return remap_grid<Gray8>(src, map, {}, dst);
        });
});
const bool curved_added = add(1623, "remap_curved_grid", Sizes::vga_and_full_hd, [](Row& row) {
    const Lens lens(row.size());
    remap_line<MapPoint>(
        row, map_grid_size(row.size()), [=](int x, int y) { return lens.point(16 * x, 16 * y); },
        [](ImageView<const Gray8> src, ImageView<const MapPoint> map, ImageView<Gray8> dst) {
            return remap_curved_grid<Gray8>(src, map, {}, dst);
        });
});

}  // namespace
}  // namespace fovea::bench
