// SPDX-License-Identifier: MIT
//
// How exact the gauge is on rendered plates of known size, and where it breaks: prints docs/accuracy.md. The
// plates are rendered in integers, so every machine measures the same.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include <gauge/gauge_command.hpp>
#include <gauge/teach.hpp>
#include <make_part/part_scene.hpp>

namespace {

using namespace fovea;
using apps::PartScene;
using apps::Picture;

constexpr int poses = 100;
constexpr int poses_in_range = 200;

/// Mean and standard deviation of errors, and the largest.
class Errors {
public:
    void add(double error) {
        sum_ += error;
        squares_ += error * error;
        largest_ = std::max(largest_, std::abs(error));
        ++count_;
    }
    std::string row(int places) const {
        if (count_ == 0) return "- | - | -";
        const double mean = sum_ / count_;
        const double deviation = std::sqrt(std::max(squares_ / count_ - mean * mean, 0.0));
        char text[96];
        std::snprintf(text, sizeof text, "%+.*f | %.*f | %.*f", places, mean, places, deviation, places,
                      largest_);
        return text;
    }

private:
    double sum_ = 0, squares_ = 0, largest_ = 0;
    int count_ = 0;
};

/// The plate of the study: 180 x 70 px with a cut corner and two holes, 30 and 18 px wide.
PartScene plate() {
    PartScene scene;
    scene.size = {260, 240};
    scene.length = FinePixel::from_int(180);
    scene.height = FinePixel::from_int(70);
    scene.cut_x = FinePixel::from_int(30);
    scene.cut_y = FinePixel::from_int(20);
    scene.holes = {{FinePixel::from_int(50), FinePixel::from_int(-2), FinePixel::from_int(15)},
                   {FinePixel::from_int(-48), FinePixel::from_int(4), FinePixel::from_int(9)}};
    scene.middle = {FinePixel::from_int(130), FinePixel::from_int(120)};
    return scene;
}

struct Study {
    Errors width, hole, axis;
    int found = 0, measured = 0, certain = 0, wrong = 0;
};

double value_of(const PartResult& part, const Recipe& recipe, const char* name) {
    for (int i = 0; i < part.feature_count; ++i)
        if (std::string(recipe.features[i].name) == name && part.features[i].status == Status::ok)
            return static_cast<double>(part.features[i].measurement.value.millionths) * 1e-6;
    return NAN;
}

/// Teaches on a picture under the conditions that `change` makes and measures `poses` others under the same.
Study study(const std::function<void(PartScene&)>& change, int count = poses) {
    PartScene good = plate();
    good.angle = FineAngle();
    change(good);
    apps::TeachOptions options;
    const Picture<Gray8> good_picture = render(good);
    const apps::Taught taught = apps::teach({good_picture}, {"good"}, options);
    std::vector<PartResult> parts;
    static_cast<void>(apps::gauge_picture(good_picture, taught.recipe, parts));
    if (parts.empty()) return {};
    const FineAngle zero = parts.at(0).pose.frame.angle();
    Recipe recipe = taught.recipe;
    recipe.locate.area_min = 3000;
    recipe.locate.area_max = 30000;

    Study result;
    Random random(2024);
    for (int i = 0; i < count; ++i) {
        PartScene scene = plate();
        scene.angle = FineAngle::from_raw(random.next());
        scene.middle.x += FinePixel::from_raw(random.between(-5 * 65536, 5 * 65536));
        scene.middle.y += FinePixel::from_raw(random.between(-5 * 65536, 5 * 65536));
        scene.seed = random.next();
        if (i % 2 == 1) std::swap(scene.part_level, scene.ground_level);
        change(scene);
        recipe.locate.dark_part = scene.part_level < scene.ground_level;
        if (apps::gauge_picture(render(scene), recipe, parts) != Status::ok || parts.size() != 1) continue;
        ++result.found;
        const PartResult& part = parts[0];
        const double turned = (part.pose.frame.angle() - zero - scene.angle).microdegrees() * 1e-6;
        if (part.pose.ends_certain) {
            ++result.certain;
            if (std::abs(turned) > 90) {
                ++result.wrong;
                continue;
            }
            result.axis.add(turned);
        }
        const double length = value_of(part, recipe, "length");
        const double width = value_of(part, recipe, "width_1");
        const double large = value_of(part, recipe, "hole_1");
        const double small = value_of(part, recipe, "hole_2");
        if (std::isnan(length) || std::isnan(width) || std::isnan(large) || std::isnan(small)) continue;
        ++result.measured;
        result.width.add(length - 180);
        result.width.add(width - 70);
        result.hole.add(std::max(large, small) - 30);
        result.hole.add(std::min(large, small) - 18);
    }
    return result;
}

void print_row(const std::string& name, const Study& s) {
    std::printf("| %s | %s | %s | %s | %d | %d | %d | %d |\n", name.c_str(), s.width.row(3).c_str(),
                s.hole.row(3).c_str(), s.axis.row(3).c_str(), s.found, s.measured, s.certain, s.wrong);
}

void print_head(const char* what) {
    std::printf(
        "\n| %s | width: mean | dev. | max | diameter: mean | dev. | max | axis: mean | dev. | max | found | "
        "measured | ends told | wrongly |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
        what);
}

std::string decimal(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return text;
}

}  // namespace

int main() {
    std::printf(
        "# Accuracy of the gauge\n\n"
        "Made by the program `accuracy` (tests/accuracy), which the tests run and compare with this page: "
        "every number is\n"
        "a measurement, and the same on every machine.\n\n"
        "A plate of 180 x 70 px with a cut corner and holes of 30 and 18 px is rendered in %d poses: any "
        "angle, any\n"
        "fraction of a pixel, every second one bright on dark, by a recipe taught on one more of them. Blur "
        "is the standard deviation of the lens in px, noise\n"
        "that of the sensor in grey levels, contrast the difference between part and ground. Errors of "
        "widths and\n"
        "diameters are in px, of the axis in degrees: mean, standard deviation, largest. `found` counts the "
        "pictures\n"
        "with exactly one part, `measured` those in which all four lengths have a value, `ends told` those "
        "in which the\n"
        "gauge says which end is which, and `wrongly` those of them where it is the other one.\n\n"
        "Unless a table says otherwise: blur 1, noise 4, contrast 185.\n\n## Blur\n",
        poses);
    print_head("blur");
    for (const double blur : {0.4, 0.7, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0})
        print_row(decimal(blur), study([&](PartScene& s) { s.blur = std::llround(blur * 1e6); }));
    std::printf("\n## Noise\n");
    print_head("noise");
    for (const double noise : {0.0, 2.0, 4.0, 8.0, 16.0, 24.0, 32.0})
        print_row(decimal(noise), study([&](PartScene& s) { s.noise = std::llround(noise * 1e6); }));
    std::printf("\n## Contrast\n");
    print_head("contrast");
    for (const int contrast : {160, 80, 40, 30, 20, 10})
        print_row(std::to_string(contrast), study([&](PartScene& s) {
                      const bool dark = s.part_level < s.ground_level;
                      s.part_level = static_cast<Gray8>(120 - (dark ? contrast / 2 : -contrast / 2));
                      s.ground_level = static_cast<Gray8>(120 + (dark ? contrast / 2 : -contrast / 2));
                  }));
    std::printf("\n## Blur 0.7 to 1.5 with noise 4: the range that the gauge is made for, %d poses\n",
                poses_in_range);
    print_head("blur");
    int round = 0;
    print_row("0.7 to 1.5",
              study([&](PartScene& s) { s.blur = 700000 + 4000 * (round++ % 201); }, poses_in_range));
    return 0;
}
