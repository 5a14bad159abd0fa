// SPDX-License-Identifier: MIT
//
// Golden vectors of draw/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>

#include <fovea/base/arena.hpp>
#include <fovea/draw/arrow.hpp>
#include <fovea/draw/circle.hpp>
#include <fovea/draw/cross.hpp>
#include <fovea/draw/font.hpp>
#include <fovea/draw/line.hpp>
#include <fovea/draw/polygon.hpp>
#include <fovea/draw/rectangle.hpp>
#include <fovea/draw/run.hpp>
#include <fovea/draw/slope.hpp>
#include <fovea/draw/text.hpp>
#include <fovea/draw/utf8.hpp>
#include <golden/digest.hpp>
#include <golden/workspace.hpp>

namespace fovea::golden {

/// Draws with draw(image, colour, random) into small and large images of both pixels, some of it outside.
template <class Draw>
void for_each_canvas(Workspace& work, Digest& digest, Draw draw) {
    for (const Size size : {Size{1, 1}, Size{9, 1}, Size{1, 9}, Size{31, 17}, Size{61, 40}}) {
        Random random(23);
        const ImageView<Gray8> gray = work.view<Gray8>(0, size);
        const ImageView<Rgb888> colour = work.view<Rgb888>(1, size);
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
                gray(x, y) = 0;
                colour(x, y) = {1, 2, 3};
            }
        for (int i = 0; i < 12; ++i) {
            const auto level = static_cast<Gray8>(20 * i + 20);
            Random same = random;
            digest.add(draw(gray, level, random));
            digest.add(draw(colour, Rgb888{level, 7, static_cast<std::uint8_t>(255 - level)}, same), gray);
        }
        digest.add(colour);
    }
}
/// A place in or near an image, now and then far away.
inline Point place_near(Random& random, Size size) {
    if (random.below(12) == 0)
        return {random.between(-max_draw_coordinate, max_draw_coordinate),
                random.between(-max_draw_coordinate, max_draw_coordinate)};
    return {random.between(-9, size.width + 9), random.between(-9, size.height + 9)};
}

inline void draw_lines(Workspace& work, Digest& digest) {
    for_each_canvas(work, digest, [](auto image, auto colour, Random& random) {
        const Point a = place_near(random, image.size());
        const Point b = place_near(random, image.size());
        const auto thickness = static_cast<int>(random.below(5));
        return draw_line(image, a, b, colour, thickness);
    });
    for_each_canvas(work, digest, [](auto image, auto colour, Random& random) {
        Point points[4];
        for (Point& point : points) point = place_near(random, image.size());
        const Span<const Point> some = Span<const Point>(points).first(random.below(5));
        return draw_polyline(image, some, colour, random.between(1, 3));
    });
    for_each_canvas(work, digest, [](auto image, auto colour, Random& random) {
        const Point tail = place_near(random, image.size());
        const Point tip = place_near(random, image.size());
        const int head = random.between(-1, 12);
        return draw_arrow(image, tail, tip, colour, head, random.between(1, 3));
    });
}

inline void draw_marks(Workspace& work, Digest& digest) {
    for_each_canvas(work, digest, [](auto image, auto colour, Random& random) {
        const Point centre = place_near(random, image.size());
        const int arm = random.between(-1, 12);
        if (arm % 2 == 0) return draw_cross(image, centre, arm, colour, random.between(1, 3));
        return draw_diagonal_cross(image, centre, arm, colour, random.between(1, 3));
    });
    for_each_canvas(work, digest, [](auto image, auto colour, Random& random) {
        const Point centre = place_near(random, image.size());
        fill_run(image, centre.y, centre.x, std::int64_t{centre.x} + 4, colour);
        return draw_point(image, place_near(random, image.size()), colour);
    });
    for (const std::int64_t x : {std::int64_t{0}, std::int64_t{1} << 30, -(std::int64_t{1} << 30) - 1})
        digest.add(drawable(x, 0), drawable(0, x), drawable({static_cast<int>(x), 5}));
}

inline void draw_circles(Workspace& work, Digest& digest) {
    for_each_canvas(work, digest, [](auto image, auto colour, Random& random) {
        const Point centre = place_near(random, image.size());
        const int radius = random.below(9) == 0 ? random.between(1000, 1 << 30) : random.between(-1, 30);
        if (random.below(3) == 0) return fill_circle(image, centre, radius, colour);
        return draw_circle(image, centre, radius, colour, random.between(1, 6));
    });
}

inline void draw_rectangles(Workspace& work, Digest& digest) {
    for_each_canvas(work, digest, [](auto image, auto colour, Random& random) {
        const Point corner = place_near(random, image.size());
        const int width = random.between(-1, 40);
        const Rectangle area{corner.x, corner.y, width, random.between(0, 30)};
        if (random.below(3) == 0) return fill_rectangle(image, area, colour);
        return draw_rectangle(image, area, colour, random.between(0, 4));
    });
}

inline void draw_polygons(Workspace& work, Digest& digest) {
    Arena arena(work.scratch_span());
    const Span<PolygonEdge> edges = arena.take<PolygonEdge>(fill_polygon_scratch(7));
    for_each_canvas(work, digest, [&](auto image, auto colour, Random& random) {
        Point corners[7];
        for (Point& corner : corners) corner = place_near(random, image.size());
        const Span<const Point> some = Span<const Point>(corners).first(random.below(8));
        if (random.below(3) == 0) return draw_polygon(image, some, colour, random.between(1, 3));
        return fill_polygon(image, some, colour, random.below(5) == 0 ? edges.first(3) : edges);
    });
    for (int run = 1; run < 40; run += 6)
        for (int rise = -50; rise <= 50; rise += 7) {
            Slope slope(3, rise, run, run / 2, run / 3);
            for (int t = run / 3; t < run; ++t, slope.step()) digest.add(slope.value());
        }
}

inline void draw_texts(Workspace& work, Digest& digest) {
    const Span<const char> texts[] = {"12.500 mm \xc2\xb1 0.05", "\xc3\x98 8 \xc2\xb0\nNG", "",
                                      "\xff\xe2\x82", "ag\n\njq"};
    for (const Span<const char> text : texts) {
        for (int scale = 0; scale <= 9; ++scale) digest.add(text_size(text, scale), label_size(text, scale));
        for (Span<const char> rest = text; !rest.empty();) {
            const CodePoint read = first_code_point(rest);
            digest.add(read.value, read.bytes, glyph_of(read.value));
            rest = rest.from(read.bytes);
        }
        for_each_canvas(work, digest, [&](auto image, auto colour, Random& random) {
            const Point corner = place_near(random, image.size());
            const int scale = random.between(0, 3);
            if (random.below(2) == 0) return draw_text(image, corner, text, colour, scale);
            return draw_label(image, corner, text, colour, {}, scale);
        });
    }
    for (int glyph = 0; glyph < glyph_count; ++glyph)
        for (int row = 0; row < glyph_height; ++row) digest.add(glyph_row(glyph, row));
}

inline void draw_utf8(Workspace&, Digest& digest) {
    Random random(78);
    for (int i = 0; i < 2000; ++i) {
        constexpr unsigned char some[] = {0x00, 0x1f, 0x20, 0x7f, 0x80, 0x9f, 0xa0,
                                          0xbd, 0xbf, 0xc2, 0xe2, 0xef, 0xf0, 0xff};
        char text[6];
        for (char& letter : text) letter = static_cast<char>(some[random.below(sizeof some)]);
        const Span<const char> span(text, random.between(1, 6));
        digest.add(is_no_utf8(first_code_point(span), span), is_printable(span));
    }
    for (std::uint32_t value = 0; value < 300; ++value) digest.add(is_control(value));
}

}  // namespace fovea::golden
