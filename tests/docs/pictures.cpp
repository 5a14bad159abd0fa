// SPDX-License-Identifier: MIT
//
// The pictures of docs/operators and of docs/calibrate.md, made with fovea's own operators; the same bytes on
// every machine. After a change: build/host/tests/pictures docs/pictures

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include <fovea/base/list.hpp>
#include <fovea/draw/arrow.hpp>
#include <fovea/draw/circle.hpp>
#include <fovea/draw/cross.hpp>
#include <fovea/draw/line.hpp>
#include <fovea/draw/polygon.hpp>
#include <fovea/draw/rectangle.hpp>
#include <fovea/draw/text.hpp>
#include <fovea/measure/edge_probe.hpp>
#include <fovea/measure/fit_circle.hpp>
#include <fovea/number/trigonometry.hpp>
#include <fovea/pixelwise/threshold.hpp>
#include <fovea/segment/connected_components.hpp>
#include <fovea/segment/level_contour.hpp>
#include <fovea/statistics/histogram.hpp>
#include <fovea/warp/bilinear.hpp>

#include "calibration.hpp"
#include "paper.hpp"
#include "scene.hpp"

namespace {

using namespace fovea;
using namespace fovea::test;

/// A gray picture, and its regions with their holes.
void components(const std::string& name) {
    constexpr Size size{150, 110};
    const Picture<Gray8> image = render(size, 40, 205, 1, 10, [](int x, int y) {
        const bool washer = in_circle(x, y, 480, 480, 336) && !in_circle(x, y, 480, 480, 150);
        const bool plate = in_rectangle(x, y, 1096, 200, 2152, 824) && !in_circle(x, y, 1350, 510, 140) &&
                           !in_circle(x, y, 1850, 510, 190);
        const bool angle =
            in_rectangle(x, y, 280, 1080, 488, 1608) || in_rectangle(x, y, 280, 1416, 1256, 1608);
        const bool cut_off = in_circle(x, y, 2100, 1760, 420);
        const bool speck = in_circle(x, y, 820, 960, 30) || in_circle(x, y, 912, 1008, 24);
        return washer || plate || angle || cut_off || speck;
    });

    Histogram histogram;
    must(histogram_of(image.view(), histogram));
    Picture<Gray8> binary(size);
    must(threshold(image.view(), must(otsu(histogram)), binary.view()));
    ComponentOptions options;
    options.area_min = 60;
    options.at_border = BorderRegions::drop;
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(connected_components_scratch(size.width)));
    List<Region, 8> regions;
    List<Hole, 8> holes;
    must(connected_components(binary.view(), options, span_of(scratch), regions, holes));

    constexpr int zoom = 2;
    Canvas canvas({2 * zoom * size.width + 30, zoom * size.height + 34});
    Enlarged gray(canvas, {10, 24}, zoom);
    gray.put(image.view());
    canvas.text({10, 8}, "the picture");

    Enlarged found(canvas, {20 + zoom * size.width, 24}, zoom);
    canvas.text({20 + zoom * size.width, 8}, "its regions and holes");
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            found.colour(x, y, binary.view()(x, y) != 0 ? Rgb888{150, 150, 150} : Rgb888{60, 60, 60});
    constexpr Rgb888 colours[] = {{110, 170, 230}, {140, 200, 130}, {235, 190, 100}};
    for (const Region& region : regions) {
        // Here a box holds nothing but its own region.
        for (int y = region.box.y; y <= region.box.bottom(); ++y)
            for (int x = region.box.x; x <= region.box.right(); ++x)
                if (binary.view()(x, y) != 0) found.colour(x, y, colours[region.number % 3]);
    }
    for (const Hole& hole : holes) must(draw_rectangle(canvas.view(), found.box(hole.box), orange));
    for (const Region& region : regions) {
        const Rectangle box = found.box(region.box);
        must(draw_rectangle(canvas.view(), box, white));
        const CentralMoments moments = must(central_moments(region.moments));
        must(draw_cross(canvas.view(), found.at(moments.centroid), 5, red, 2));
        std::string words = std::to_string(region.moments.area()) + " px";
        if (region.holes > 0)
            words += ", " + std::to_string(region.holes) + (region.holes > 1 ? " holes" : " hole");
        canvas.label({box.x, box.bottom() + 2}, words, ink);
    }
    canvas.text(found.at(place(62, 58, 1)), "too small", white);
    canvas.text(found.at(place(109, 102, 1)), "at the border", white);
    canvas.save(name);
}

/// A probe across a bar, the brightness along it, and the edges.
void edge_probe_picture(const std::string& name) {
    constexpr Size size{44, 15};
    const Picture<Gray8> image =
        render(size, 45, 205, 3, 6, [](int x, int y) { return in_rectangle(x, y, 197, -100, 478, 400); });
    EdgeProbe probe;
    probe.from = place(4, 7, 1);
    probe.to = place(39, 7, 1);
    probe.across = place(0, 1, 1);
    probe.lines = 7;
    List<Edge, 8> edges;
    std::vector<std::uint16_t> scratch(static_cast<std::size_t>(edge_probe_scratch(size)));
    must(edge_probe(image.view(), probe, GrayLevel::from_int(30), span_of(scratch), edges));

    constexpr int zoom = 14;
    constexpr int top = 10;
    constexpr int profile_top = top + size.height * zoom + 20;
    constexpr int profile_height = 128;
    Canvas canvas({size.width * zoom + 20, profile_top + profile_height + 26});
    Enlarged enlarged(canvas, {10, top}, zoom);
    enlarged.put(image.view());

    for (int line = -3; line <= 3; ++line)
        must(draw_line(canvas.view(), enlarged.at(place(4, 7 + line, 1)), enlarged.at(place(39, 7 + line, 1)),
                       line == 0 ? blue : Rgb888{120, 170, 225}, line == 0 ? 2 : 1));
    must(draw_arrow(canvas.view(), enlarged.at(probe.from), enlarged.at(probe.to), blue, 12, 2));

    // Mean brightness over the lines, four times a pixel, from 0 at the bottom to 255 at the top.
    const Rectangle frame{10, profile_top, size.width * zoom, profile_height};
    must(fill_rectangle(canvas.view(), frame, white));
    must(draw_rectangle(canvas.view(), frame, faint));
    std::vector<std::int32_t> levels;
    for (int step = 0; step <= 140; ++step) {
        int sum = 0;
        for (int line = -3; line <= 3; ++line)
            sum += must(sample_bilinear(image.view(), place(16 + step, 28 + 4 * line, 4))).raw() / 7;
        levels.push_back(sum);
    }
    const int middle = profile_top + profile_height / 2;
    std::vector<Point> profile, slope;
    for (int step = 4; step <= 136; ++step) {
        const auto level = [&](int at) { return levels[static_cast<std::size_t>(at)]; };
        const int x = enlarged.at(place(16 + step, 28, 4)).x;
        profile.push_back({x, frame.bottom() - 8 - round_shift(level(step) * 7 / 16, 16)});
        // The difference of two samples that are two pixels apart.
        slope.push_back({x, middle - round_shift((level(step + 4) - level(step - 4)) / 2, 16)});
    }
    must(draw_line(canvas.view(), {frame.x, middle}, {frame.right(), middle}, faint));
    must(draw_polyline(canvas.view(), span_of(slope), orange, 2));
    must(draw_polyline(canvas.view(), span_of(profile), ink, 2));
    for (const Edge& edge : edges) {
        const Point at = enlarged.at(edge.place);
        must(draw_line(canvas.view(), at, {at.x, frame.bottom()}, red));
        must(draw_diagonal_cross(canvas.view(), at, 5, red, 3));
        const std::string words = "x = " + pixels(edge.place.x);
        canvas.label({at.x - label_size(span_of(words)).width / 2, frame.bottom() + 6}, words, red);
    }
    canvas.text({frame.x + 8, profile_top + 6}, "brightness");
    canvas.text({frame.x + 8, profile_top + 18}, "its derivative", orange);
    canvas.save(name);
}

/// A small region: its pixels, and the line on which brightness crosses the level.
void level_contour(const std::string& name) {
    constexpr Size size{26, 16};
    const Picture<Gray8> image = render(size, 60, 210, 1, 0, [](int x, int y) {
        // A plate turned by about 17 degrees, with a round end.
        const int u = (306 * (x - 180) + 95 * (y - 120)) / 320;
        const int v = (306 * (y - 120) - 95 * (x - 180)) / 320;
        return in_rectangle(u, v, -110, -64, 90, 64) || in_circle(u, v, 90, 0, 64);
    });
    const LevelSet set{must([&] {
                           Histogram histogram;
                           must(histogram_of(image.view(), histogram));
                           return otsu(histogram);
                       }()),
                       false};
    Picture<Gray8> binary(size);
    must(threshold(image.view(), set.level, binary.view()));
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(connected_components_scratch(size.width)));
    List<Region, 1> regions;
    List<Hole, 1> holes;
    must(connected_components(binary.view(), {}, span_of(scratch), regions, holes));

    constexpr int zoom = 22;
    Canvas canvas({size.width * zoom + 20, size.height * zoom + 20});
    Enlarged enlarged(canvas, {10, 10}, zoom);
    enlarged.put(image.view());
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const Rectangle square = enlarged.box({x, y, 1, 1});
            if (!set.contains(image.view()(x, y))) continue;
            // The outline of the pixels: their sides towards pixels that do not belong.
            const auto side = [&](int dx, int dy, Point a, Point b) {
                const Point next{x + dx, y + dy};
                if (!image.view().contains(next) || !set.contains(image.view()(next.x, next.y)))
                    must(draw_line(canvas.view(), a, b, blue, 2));
            };
            const Point corner{square.x, square.y};
            const Point far{square.x + zoom, square.y + zoom};
            side(0, -1, corner, {far.x, corner.y});
            side(0, 1, {corner.x, far.y}, far);
            side(-1, 0, corner, {corner.x, far.y});
            side(1, 0, {far.x, corner.y}, far);
        }
    std::vector<Point> contour;
    must(trace_level_contour(image.view(), set, Connectivity::eight, regions[0].first,
                             [&](FinePoint point) { contour.push_back(enlarged.at(point)); }));
    must(draw_polygon(canvas.view(), {contour.data(), static_cast<std::ptrdiff_t>(contour.size())}, orange,
                      3));
    for (const Point point : contour) must(fill_circle(canvas.view(), point, 3, red));
    canvas.save(name);
}

/// A disc with a bite and a hair, probes around it, and the circle that most of them agree on.
void circle_fit(const std::string& name) {
    constexpr Size size{46, 46};
    const Picture<Gray8> image = render(size, 205, 45, 2, 6, [](int x, int y) {
        const bool disc = in_circle(x, y, 365, 358, 228) && !in_circle(x, y, 560, 200, 92);
        const bool dirt = in_circle(x, y, 165, 520, 50) || in_circle(x, y, 225, 548, 42);
        return disc || dirt;
    });
    constexpr int zoom = 9;
    Canvas canvas({size.width * zoom + 20, size.height * zoom + 20});
    Enlarged enlarged(canvas, {10, 10}, zoom);
    enlarged.put(image.view());

    constexpr int probes = 32;
    std::vector<FinePoint> points;
    std::vector<std::uint16_t> scratch(static_cast<std::size_t>(edge_probe_scratch(size)));
    for (int i = 0; i < probes; ++i) {
        const UnitVector way =
            unit_vector(FineAngle(Angle::from_raw(static_cast<std::uint16_t>(65536 / probes * i))));
        const auto on_ray = [&](int radius) {
            const auto along = [radius](Unit part) {
                return FinePixel::from_raw(
                    static_cast<std::int32_t>(round_shift(std::int64_t{part.raw()} * radius, 14)));
            };
            return FinePoint{FinePixel::from_int(23) + along(way.x), FinePixel::from_int(22) + along(way.y)};
        };
        EdgeProbe probe;
        probe.from = on_ray(7);
        probe.to = on_ray(21);
        List<Edge, 16> edges;
        must(edge_probe(image.view(), probe, GrayLevel::from_int(30), span_of(scratch), edges));
        must(draw_line(canvas.view(), enlarged.at(probe.from), enlarged.at(probe.to), {120, 170, 225}));
        const Edge* strongest = nullptr;
        for (const Edge& edge : edges)
            if (strongest == nullptr || edge.strength > strongest->strength) strongest = &edge;
        if (strongest != nullptr) points.push_back(strongest->place);
    }
    std::vector<FinePixel> fit_scratch(points.size());
    const Span<const FinePoint> all = span_of(points);
    const CircleFit fit = must(fit_circle_robust(all, span_of(fit_scratch)));

    must(draw_circle(canvas.view(), enlarged.at(fit.circle.centre), (fit.circle.radius * zoom).round(), green,
                     3));
    must(draw_cross(canvas.view(), enlarged.at(fit.circle.centre), 9, green, 3));
    for (const FinePoint point : points) {
        const bool agrees = magnitude(distance_from(fit.circle, point).raw()) < magnitude(FinePixel::one / 2);
        if (agrees)
            must(fill_circle(canvas.view(), enlarged.at(point), 4, green));
        else
            must(draw_diagonal_cross(canvas.view(), enlarged.at(point), 5, red, 3));
    }
    canvas.label({16, 16},
                 "radius " + pixels(fit.circle.radius) + " px from " + std::to_string(fit.used) + " of " +
                     std::to_string(points.size()) + " points",
                 ink);
    canvas.save(name);
}

/// What the drawing functions draw, and the font.
void drawing(const std::string& name) {
    constexpr int cell = 120;
    constexpr int rows = 3;
    Canvas canvas({5 * cell + 10, rows * 100 + 92});
    const ImageView<Rgb888> view = canvas.view();
    int next = 0;
    const auto begin = [&](const char* function) {
        const Point corner{10 + next % 5 * cell, 10 + next / 5 * 100};
        ++next;
        canvas.text({corner.x, corner.y + 78}, function);
        return corner;
    };
    const auto moved = [](Point a, int x, int y) { return Point{a.x + x, a.y + y}; };

    Point c = begin("draw_line");
    for (int i = 0; i < 4; ++i)
        must(draw_line(view, moved(c, 6, 8 + 16 * i), moved(c, 86, 20 + 16 * i), blue, 2 * i + 1));
    c = begin("draw_polyline");
    const Point zigzag[] = {moved(c, 6, 60), moved(c, 26, 14), moved(c, 46, 60), moved(c, 66, 14),
                            moved(c, 90, 60)};
    must(draw_polyline(view, zigzag, blue, 3));
    c = begin("draw_rectangle");
    must(draw_rectangle(view, {c.x + 6, c.y + 8, 84, 56}, blue, 3));
    must(draw_rectangle(view, {c.x + 20, c.y + 22, 56, 28}, orange));
    c = begin("fill_rectangle");
    must(fill_rectangle(view, {c.x + 6, c.y + 8, 84, 56}, blue));
    c = begin("draw_circle");
    for (const int radius : {4, 12, 20}) must(draw_circle(view, moved(c, 48, 36), radius, orange));
    must(draw_circle(view, moved(c, 48, 36), 29, blue, 5));

    c = begin("fill_circle");
    must(fill_circle(view, moved(c, 48, 36), 31, blue));
    const auto star = [&](Point middle, int radius, Point(&corners)[5]) {
        for (int i = 0; i < 5; ++i) {
            const UnitVector way = unit_vector(FineAngle::from_microdegrees(-90000000 + 144000000 * i));
            const auto along = [radius](Unit part) {
                return static_cast<int>(round_shift(std::int64_t{part.raw()} * radius, 30));
            };
            corners[i] = moved(middle, along(way.x), along(way.y));
        }
    };
    Point corners[5];
    PolygonEdge scratch[5];
    c = begin("draw_polygon");
    star(moved(c, 48, 38), 36, corners);
    must(draw_polygon(view, corners, blue, 2));
    c = begin("fill_polygon");
    star(moved(c, 48, 38), 36, corners);
    must(fill_polygon(view, corners, blue, scratch));
    c = begin("draw_cross");
    must(draw_cross(view, moved(c, 30, 36), 20, blue));
    must(draw_cross(view, moved(c, 74, 36), 12, orange, 5));
    c = begin("draw_diagonal_cross");
    must(draw_diagonal_cross(view, moved(c, 30, 36), 20, blue));
    must(draw_diagonal_cross(view, moved(c, 74, 36), 12, orange, 5));

    c = begin("draw_arrow");
    must(draw_arrow(view, moved(c, 8, 60), moved(c, 88, 12), blue, 16, 3));
    must(draw_arrow(view, moved(c, 8, 16), moved(c, 52, 10), orange, 8));
    c = begin("draw_text");
    for (int scale = 1; scale <= 3; ++scale)
        canvas.text(moved(c, 6, scale * scale * 4), "12.5", scale == 2 ? orange : blue, scale);
    c = begin("draw_label");
    for (int x = 0; x < 16; ++x) must(fill_rectangle(view, {c.x + 6 * x, c.y + 8, 3, 56}, faint));
    canvas.label(moved(c, 8, 16), "length OK", green);
    canvas.label(moved(c, 8, 42), "width HIGH", red);
    c = begin("clipped at the edge");
    const Rectangle window{c.x + 6, c.y + 8, 84, 56};
    const ImageView<Rgb888> part = must(view.crop(window));
    must(fill_rectangle(part, {0, 0, 84, 56}, white));
    must(draw_circle(part, {10, 66}, 50, blue, 3));
    must(draw_line(part, {-500, -200}, {600, 250}, orange, 3));
    must(draw_rectangle(view, window, faint));

    std::string all;
    for (int i = 33; i < 127; ++i) all += static_cast<char>(i);
    canvas.text({10, rows * 100 + 14}, all.substr(0, 47), ink, 2);
    canvas.text({10, rows * 100 + 36}, all.substr(47), ink, 2);
    canvas.text({10, rows * 100 + 62},
                "\u00b0 \u00b1 \u00b2 \u00b3 \u00b5 \u00d8  \u00d84.20 mm \u00b10.05  12.5\u00b0  37 \u00b5m "
                " 8 px\u00b2",
                ink, 2);
    canvas.save(name);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: pictures FOLDER\n");
        return 2;
    }
    const std::string folder = std::string(argv[1]) + "/";
    components(folder + "components.png");
    edge_probe_picture(folder + "edge_probe.png");
    level_contour(folder + "level_contour.png");
    circle_fit(folder + "fit_circle.png");
    drawing(folder + "draw.png");
    scene(folder + "scene.png");
    coverage(folder + "coverage.png");
    return 0;
}
