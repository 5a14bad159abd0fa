// SPDX-License-Identifier: MIT
//
// The templates of the core, instantiated as a program for a chip or a board would. The build includes all
// headers of the core in front of it, so that the object holds the rest too: tests/checks/binary.py and
// stack.py read it. tests/checks/memory.py links each function of the second part alone, for its size in
// flash.
#include <cstdint>

#include <fovea/base/order.hpp>
#include <fovea/codec/any_picture.hpp>
#include <fovea/codec/bmp.hpp>
#include <fovea/codec/jpeg.hpp>
#include <fovea/codec/png_reader.hpp>
#include <fovea/codec/png_writer.hpp>
#include <fovea/codec/pnm.hpp>
#include <fovea/codec/toml.hpp>
#include <fovea/decision/gauge.hpp>
#include <fovea/draw/arrow.hpp>
#include <fovea/draw/circle.hpp>
#include <fovea/draw/cross.hpp>
#include <fovea/draw/line.hpp>
#include <fovea/draw/polygon.hpp>
#include <fovea/draw/rectangle.hpp>
#include <fovea/draw/run.hpp>
#include <fovea/draw/text.hpp>
#include <fovea/image/image_storage.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/measure/consensus.hpp>
#include <fovea/pixelwise/to_gray.hpp>

namespace fovea {

// ---- Templates ----------------------------------------------------------------------------

template class Span<std::uint8_t>;
template class ListView<PartResult>;
template class List<Feature, Recipe::max_features>;
template class ImageView<Gray8>;
template class ImageView<const Gray8>;
template class ImageView<Rgb888>;
template class ImageStorage<Gray8, 16, 8>;
template class Fixed<std::int32_t, 8>;
template class Fixed<std::int32_t, 16>;
template class Fixed<std::int64_t, 8>;
template class Inflater<OnePiece>;
template class ZlibReader<OnePiece>;

template Result<ImageView<Gray8>> view_over(Span<std::uint8_t>, Size, std::ptrdiff_t);
template Result<ImageView<const Rgb888>> view_over(Span<const std::uint8_t>, Size, std::ptrdiff_t);
template void sort(Span<std::int32_t>);
template std::int32_t& nth_smallest(Span<std::int32_t>, std::ptrdiff_t);

template Status decode_pnm(Span<const std::uint8_t>, ImageView<Gray8>);
template Status decode_pnm(Span<const std::uint8_t>, ImageView<Gray16>);
template Status decode_pnm(Span<const std::uint8_t>, ImageView<Rgb888>);
template Status decode_bmp(Span<const std::uint8_t>, ImageView<Gray8>);
template Status decode_bmp(Span<const std::uint8_t>, ImageView<Rgb888>);
template Status decode_png(Span<const std::uint8_t>, Span<std::uint8_t>, ImageView<Gray8>);
template Status decode_png(Span<const std::uint8_t>, Span<std::uint8_t>, ImageView<Gray16>);
template Status decode_png(Span<const std::uint8_t>, Span<std::uint8_t>, ImageView<Rgb888>);
template Status decode_jpeg(Span<const std::uint8_t>, Span<std::uint8_t>, ImageView<Gray8>);
template Status decode_jpeg(Span<const std::uint8_t>, Span<std::uint8_t>, ImageView<Rgb888>);
template Status decode_picture(Span<const std::uint8_t>, Span<std::uint8_t>, ImageView<Gray8>);
template Status decode_picture(Span<const std::uint8_t>, Span<std::uint8_t>, ImageView<Rgb888>);

template Status draw_point(ImageView<Gray8>, Point, Gray8);
template Status draw_line(ImageView<Gray8>, Point, Point, Gray8, int);
template Status draw_polyline(ImageView<Gray8>, Span<const Point>, Gray8, int);
template Status draw_arrow(ImageView<Gray8>, Point, Point, Gray8, int, int);
template Status draw_cross(ImageView<Gray8>, Point, int, Gray8, int);
template Status draw_diagonal_cross(ImageView<Gray8>, Point, int, Gray8, int);
template Status draw_rectangle(ImageView<Gray8>, Rectangle, Gray8, int);
template Status fill_rectangle(ImageView<Gray8>, Rectangle, Gray8);
template Status draw_circle(ImageView<Gray8>, Point, int, Gray8, int);
template Status fill_circle(ImageView<Gray8>, Point, int, Gray8);
template Status draw_polygon(ImageView<Gray8>, Span<const Point>, Gray8, int);
template Status fill_polygon(ImageView<Gray8>, Span<const Point>, Gray8, Span<PolygonEdge>);
template Status draw_text(ImageView<Gray8>, Point, Span<const char>, Gray8, int);
template Status draw_label(ImageView<Gray8>, Point, Span<const char>, Gray8, Gray8, int);
template Status draw_point(ImageView<Rgb888>, Point, Rgb888);
template Status draw_line(ImageView<Rgb888>, Point, Point, Rgb888, int);
template Status draw_polyline(ImageView<Rgb888>, Span<const Point>, Rgb888, int);
template Status draw_arrow(ImageView<Rgb888>, Point, Point, Rgb888, int, int);
template Status draw_cross(ImageView<Rgb888>, Point, int, Rgb888, int);
template Status draw_diagonal_cross(ImageView<Rgb888>, Point, int, Rgb888, int);
template Status draw_rectangle(ImageView<Rgb888>, Rectangle, Rgb888, int);
template Status fill_rectangle(ImageView<Rgb888>, Rectangle, Rgb888);
template Status draw_circle(ImageView<Rgb888>, Point, int, Rgb888, int);
template Status fill_circle(ImageView<Rgb888>, Point, int, Rgb888);
template Status draw_polygon(ImageView<Rgb888>, Span<const Point>, Rgb888, int);
template Status fill_polygon(ImageView<Rgb888>, Span<const Point>, Rgb888, Span<PolygonEdge>);
template Status draw_text(ImageView<Rgb888>, Point, Span<const char>, Rgb888, int);
template Status draw_label(ImageView<Rgb888>, Point, Span<const char>, Rgb888, Rgb888, int);

// ---- Whole tasks --------------------------------------------------------------------------

/// Entry points that call what a program for this task calls, and nothing else.
namespace task {

Status gauge_part(ImageView<const Gray8> image, const Recipe& recipe, Span<std::uint8_t> scratch,
                  ListView<PartResult> parts) {
    return gauge(image, recipe, scratch, parts);
}
Status find(ImageView<const Gray8> image, const LocateRule& rule, Span<std::uint8_t> scratch,
            Threshold& threshold, ListView<Region> parts, ListView<Hole> holes) {
    return find_parts(image, rule, scratch, threshold, parts, holes);
}
Status label(ImageView<const Gray8> binary, const ComponentOptions& options, Span<std::uint8_t> scratch,
             ListView<Region> regions, ListView<Hole> holes) {
    return connected_components(binary, options, scratch, regions, holes);
}
Status probe(ImageView<const Gray8> image, const EdgeProbe& line, GrayLevel least,
             Span<std::uint16_t> scratch, ListView<Edge> edges) {
    return edge_probe(image, line, least, scratch, edges);
}
Result<LineFit> line(Span<const FinePoint> points, Span<FinePixel> scratch) {
    return fit_line_robust(points, scratch);
}
Result<CircleFit> circle(Span<const FinePoint> points, Span<FinePixel> scratch) {
    return fit_circle_robust(points, scratch);
}
Status binarise(ImageView<const Gray8> src, Gray8 level, ImageView<Gray8> dst) {
    return threshold(src, level, dst);
}
Result<Gray8> level_of(ImageView<const Gray8> src, Histogram& histogram) {
    if (Status s = histogram_of(src, histogram); s != Status::ok) return s;
    return otsu(histogram);
}
Status erode_image(ImageView<const Gray8> src, Size element, Span<std::uint8_t> scratch,
                   ImageView<Gray8> dst) {
    return erode(src, element, scratch, dst);
}
Status open_image(ImageView<const Gray8> src, Size element, Span<std::uint8_t> scratch,
                  ImageView<Gray8> dst) {
    return opening(src, element, scratch, dst);
}
Status close_image(ImageView<const Gray8> src, Size element, Span<std::uint8_t> scratch,
                   ImageView<Gray8> dst) {
    return closing(src, element, scratch, dst);
}
Status jpeg_to_gray(Span<const std::uint8_t> file, Span<std::uint8_t> scratch, ImageView<Gray8> dst) {
    return decode_jpeg(file, scratch, dst);
}
Status jpeg_to_rgb(Span<const std::uint8_t> file, Span<std::uint8_t> scratch, ImageView<Rgb888> dst) {
    return decode_jpeg(file, scratch, dst);
}
Status png_to_gray(Span<const std::uint8_t> file, Span<std::uint8_t> scratch, ImageView<Gray8> dst) {
    return decode_png(file, scratch, dst);
}
Result<std::ptrdiff_t> gray_to_png(ImageView<const Gray8> src, Span<std::uint8_t> scratch,
                                   Span<std::uint8_t> out) {
    return encode_png(src, scratch, out);
}
Result<std::ptrdiff_t> gray_to_bmp(ImageView<const Gray8> src, Span<std::uint8_t> out) {
    return encode_bmp(src, out);
}
Result<TomlItem> read_recipe(TomlReader& reader) { return reader.next(); }
Status write_label(ImageView<Gray8> image, Point corner, Span<const char> text) {
    return draw_label(image, corner, text, Gray8{255}, Gray8{0}, 1);
}
Status outline(ImageView<Gray8> image, Point a, Point b) { return draw_line(image, a, b, Gray8{255}, 2); }

}  // namespace task
}  // namespace fovea
