// SPDX-License-Identifier: MIT
#include <fovea/measure/edge_probe.hpp>
#include <fovea/measure/edge_straightness.hpp>
#include <fovea/measure/fit_circle.hpp>
#include <fovea/measure/fit_line.hpp>
#include <fovea/number/trigonometry.hpp>

#include <bench/harness.hpp>
#include <bench/pictures.hpp>

namespace fovea::bench {
namespace {

/// Straight through the plate's outline and back out, 100 px, slanted.
EdgeProbe probe_in(Size size, int lines) {
    const golden::Plate plate = plate_in(size);
    const FinePoint edge = plate.to_image(0, golden::Plate::half_height);
    const auto shifted = [](FinePoint place, int x, int y) {
        return FinePoint{place.x + FinePixel::from_int(x), place.y + FinePixel::from_int(y)};
    };
    return {shifted(edge, 15, -48),
            shifted(edge, -15, 48),
            {FinePixel::from_ratio(95, 100), FinePixel::from_ratio(31, 100)},
            lines};
}

struct Probing {
    std::vector<std::uint16_t> scratch;
    List<Edge, 32> edges;

    explicit Probing(Size size) : scratch(static_cast<std::size_t>(edge_probe_scratch(size))) {}
    Span<std::uint16_t> profile() { return {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}; }
};

void time_probe(Row& row, int lines) {
    row.not_per_pixel();
    auto& src = row.keep(part(row.size()));
    auto& room = row.keep(Probing(row.size()));
    row.ours([&, probe = probe_in(row.size(), lines)] {
        consume(edge_probe(src.view(), probe, GrayLevel::from_int(20), room.profile(), room.edges));
    });
}

const bool one_line_added =
    add(50, "edge probe, 100 px, 1 line", Sizes::vga, [](Row& row) { time_probe(row, 1); });
const bool many_lines_added =
    add(51, "edge probe, 100 px, 15 lines", Sizes::vga, [](Row& row) { time_probe(row, 15); });
const bool straightness_added = add(51, "edge straightness, 15 lines", Sizes::vga, [](Row& row) {
    row.not_per_pixel();
    auto& src = row.keep(part(row.size()));
    auto& room = row.keep(Probing(row.size()));
    const EdgeProbe probe = probe_in(row.size(), 15);
    consume(edge_probe(src.view(), probe, GrayLevel::from_int(20), room.profile(), room.edges));
    row.ours([&, probe, edge = room.edges.empty() ? Edge() : room.edges[0]] {
        consume(edge_straightness(src.view(), probe, edge, room.profile(), room.edges));
    });
});

struct Points {
    std::vector<FinePoint> points;
    std::vector<FinePixel> distances;
};

/// 48 points on a circle or a line, a tenth of them far off.
Points points_on(bool circle) {
    Random random(5);
    Points made;
    made.distances.resize(48);
    for (int i = 0; i < 48; ++i) {
        const UnitVector way = unit_vector(FineAngle::from_raw(static_cast<std::uint32_t>(i) * 89478485u));
        const std::int32_t off = i % 10 == 3 ? 1000000 : random.between(-3000, 3000);
        if (circle)
            made.points.push_back(
                {FinePixel::from_raw((way.x.raw() >> 9) + off), FinePixel::from_raw(way.y.raw() >> 9)});
        else
            made.points.push_back({FinePixel::from_int(3 * i), FinePixel::from_raw(70000 * i + off)});
    }
    return made;
}

const bool circle_added = add(52, "robust circle, 48 points", Sizes::vga, [](Row& row) {
    row.not_per_pixel();
    auto& made = row.keep(points_on(true));
    row.ours([&] { consume(fit_circle_robust({made.points.data(), 48}, {made.distances.data(), 48})); });
});
const bool line_added = add(53, "robust line, 48 points", Sizes::vga, [](Row& row) {
    row.not_per_pixel();
    auto& made = row.keep(points_on(false));
    row.ours([&] { consume(fit_line_robust({made.points.data(), 48}, {made.distances.data(), 48})); });
});

}  // namespace
}  // namespace fovea::bench
