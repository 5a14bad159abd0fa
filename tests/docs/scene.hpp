// SPDX-License-Identifier: MIT
//
// The picture that the operators of docs/operators are shown on.
#pragma once

#include <cstdint>
#include <string>

#include <fovea/base/random.hpp>
#include <fovea/draw/circle.hpp>
#include <fovea/draw/line.hpp>
#include <fovea/draw/polygon.hpp>
#include <fovea/draw/rectangle.hpp>
#include <fovea/draw/text.hpp>

#include "paper.hpp"

namespace fovea::test {

/// A plate with holes, coloured discs, letters and thin lines under light that fades to the right, with some
/// noise and dead pixels: something for every operator.
inline void scene(const std::string& name) {
    constexpr Size size{160, 120};
    constexpr int zoom = 4;
    constexpr Rgb888 ground{196, 200, 198};
    Canvas large({zoom * size.width, zoom * size.height});
    const ImageView<Rgb888> view = large.view();
    must(fill_rectangle(view, {0, 0, zoom * size.width, zoom * size.height}, ground));

    PolygonEdge edges[4];
    const Point plate[] = {{70, 60}, {330, 120}, {296, 268}, {36, 208}};
    must(fill_polygon(view, plate, Rgb888{52, 56, 60}, edges));
    must(fill_circle(view, {108, 138}, 26, ground));
    must(fill_circle(view, {250, 186}, 38, ground));
    must(fill_circle(view, {420, 110}, 46, Rgb888{196, 44, 40}));
    must(fill_circle(view, {540, 84}, 40, Rgb888{40, 120, 64}));
    must(fill_circle(view, {500, 190}, 44, Rgb888{36, 76, 190}));
    must(draw_circle(view, {600, 180}, 26, Rgb888{210, 170, 30}, 12));
    large.text({60, 330}, "fovea", {30, 30, 34}, 8);
    large.text({60, 424}, "8.25 mm", {90, 90, 94}, 4);
    for (int i = 0; i < 5; ++i)
        must(draw_line(view, {380 + 50 * i, 290}, {350 + 50 * i, 450}, Rgb888{60, 60, 64}, 4 + 5 * i));

    Picture<Rgb888> small(size);
    Random random(3);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            int sums[3] = {};
            for (int i = 0; i < zoom * zoom; ++i) {
                const Rgb888 pixel = view(zoom * x + i % zoom, zoom * y + i / zoom);
                sums[0] += pixel.red;
                sums[1] += pixel.green;
                sums[2] += pixel.blue;
            }
            // Light falls from 125 to 45 parts of 100.
            const int light = 125 - 80 * x / size.width;
            const int noise = random.between(-3, 3);
            const auto seen = [&](int sum) {
                return saturate_cast<std::uint8_t>(sum * light / (100 * zoom * zoom) + noise);
            };
            small.view()(x, y) = {seen(sums[0]), seen(sums[1]), seen(sums[2])};
            if (random.below(300) == 0) small.view()(x, y) = random.below(2) == 0 ? white : Rgb888{0, 0, 0};
        }
    Canvas canvas(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) canvas.view()(x, y) = small.view()(x, y);
    canvas.save(name);
}

}  // namespace fovea::test
