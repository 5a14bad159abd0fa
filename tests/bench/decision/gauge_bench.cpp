// SPDX-License-Identifier: MIT
#include <cstdlib>
#include <vector>

#include <fovea/decision/gauge.hpp>

#include <bench/harness.hpp>
#include <bench/pictures.hpp>
#include <golden/plate_recipe.hpp>

namespace fovea::bench {
namespace {

struct Gauging {
    Picture<Gray8> image;
    Bytes scratch;
    Recipe recipe;
    List<PartResult, 8> parts;
};

Gauging taught(Size size) {
    Gauging made{part(size), {}, {}, {}};
    List<Region, 8> regions;
    List<Hole, 8> holes;
    made.scratch = bytes(gauge_scratch(size, {}, 8));
    const golden::PlateRecipe plate =
        golden::plate_recipe(made.image.view(), plate_in(size), span_of(made.scratch), regions, holes);
    if (plate.status != Status::ok) std::abort();
    made.recipe = plate.recipe;
    return made;
}

const bool gauge_added = add(80, "gauge, one part, 8 features", Sizes::vga_and_full_hd, [](Row& row) {
    auto& made = row.keep(taught(row.size()));
    row.ours([&] {
        if (gauge(made.image.view(), made.recipe, span_of(made.scratch), made.parts) != Status::ok)
            std::abort();
    });
});

const bool find_added = add(81, "find_parts alone", Sizes::vga_and_full_hd, [](Row& row) {
    auto& made = row.keep(taught(row.size()));
    auto& regions = row.keep(List<Region, 8>());
    auto& holes = row.keep(List<Hole, 8>());
    row.ours([&] {
        Threshold threshold;
        consume(find_parts(made.image.view(), made.recipe.locate, span_of(made.scratch), threshold, regions,
                           holes));
    });
});

}  // namespace
}  // namespace fovea::bench
