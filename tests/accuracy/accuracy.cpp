// SPDX-License-Identifier: MIT
//
// How exact the gauge is on rendered plates of known size, and where it breaks: prints docs/accuracy.md. The
// plates are rendered in integers, so every machine measures the same.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <gauge/gauge_command.hpp>
#include <gauge/teach.hpp>
#include <make_part/part_scene.hpp>
#include <support/plate_scene.hpp>

namespace {

using namespace fovea;
using apps::PartScene;
using apps::Picture;

constexpr double pi = 3.14159265358979323846;
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
    std::string row() const {
        if (count_ == 0) return "- | - | -";
        const double mean = sum_ / count_;
        const double deviation = std::sqrt(std::max(squares_ / count_ - mean * mean, 0.0));
        char text[96];
        std::snprintf(text, sizeof text, "%+.3f | %.3f | %.3f", mean, deviation, largest_);
        return text;
    }
    /// Of distances, which have no sign: mean and largest.
    std::string distance_row() const {
        if (count_ == 0) return "- | -";
        char text[64];
        std::snprintf(text, sizeof text, "%.3f | %.3f", sum_ / count_, largest_);
        return text;
    }
    double largest() const { return largest_; }
    int count() const { return count_; }

private:
    double sum_ = 0, squares_ = 0, largest_ = 0;
    int count_ = 0;
};

/// The plate of the study.
PartScene plate() { return test::small_plate({260, 240}); }

// ---- What is true, from the numbers of the scene alone ---------------------------------------

struct Place {
    double x, y;
};

double real(FinePixel value) { return value.raw() / 65536.0; }
double degrees(FineAngle angle) { return angle.microdegrees() * 1e-6; }

Place turned(Place place, double angle_degrees) {
    const double angle = angle_degrees * pi / 180;
    return {place.x * std::cos(angle) - place.y * std::sin(angle),
            place.x * std::sin(angle) + place.y * std::cos(angle)};
}

/// The nearest angle to zero that differs by whole turns.
double within_half_turn(double angle_degrees) { return std::remainder(angle_degrees, 360.0); }

/// Centroid and axis of what the outline of a plate encloses, seen from the middle of its rectangle: the
/// integrals over a polygon.
struct TrueFrame {
    Place origin;
    double axis;  ///< degrees

    explicit TrueFrame(const PartScene& scene) {
        const double right = real(scene.length) / 2;
        const double bottom = real(scene.height) / 2;
        const Place corners[] = {{-right, -bottom},
                                 {right, -bottom},
                                 {right, bottom - real(scene.cut_y)},
                                 {right - real(scene.cut_x), bottom},
                                 {-right, bottom}};
        double area = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
        for (int i = 0; i < 5; ++i) {
            const Place a = corners[i];
            const Place b = corners[(i + 1) % 5];
            const double cross = a.x * b.y - b.x * a.y;
            area += cross / 2;
            x += cross * (a.x + b.x) / 6;
            y += cross * (a.y + b.y) / 6;
            xx += cross * (a.x * a.x + a.x * b.x + b.x * b.x) / 12;
            yy += cross * (a.y * a.y + a.y * b.y + b.y * b.y) / 12;
            xy += cross * (2 * a.x * a.y + a.x * b.y + b.x * a.y + 2 * b.x * b.y) / 24;
        }
        origin = {x / area, y / area};
        axis = std::atan2(2 * (xy - area * origin.x * origin.y),
                          xx - yy - area * (origin.x * origin.x - origin.y * origin.y)) *
               90 / pi;
    }

    /// A place of the plate in its frame.
    Place to_frame(Place place) const { return turned({place.x - origin.x, place.y - origin.y}, -axis); }
    /// The origin in the picture.
    Place in_picture(const PartScene& scene) const {
        const Place off = turned(origin, degrees(scene.angle));
        return {real(scene.middle.x) + off.x, real(scene.middle.y) + off.y};
    }
};

/// The angle between two edges of the plate that is nearest to a measured one.
double true_angle(const PartScene& scene, double measured) {
    const double cut = std::atan2(real(scene.cut_x), real(scene.cut_y)) * 180 / pi;
    double nearest = 90;
    for (const double angle : {cut, 90 - cut, 90 + cut, 180 - cut})
        if (std::abs(angle - measured) < std::abs(nearest - measured)) nearest = angle;
    return nearest;
}

// ---- What the gauge says ------------------------------------------------------------------

struct Study {
    Errors width, hole;       ///< px
    Errors origin, position;  ///< distances from where they truly are, px
    Errors axis, angle;       ///< degrees
    int found = 0, measured = 0, certain = 0, wrong = 0;
};

double value_of(const FeatureResult& result) {
    return static_cast<double>(result.measurement.value.millionths) * 1e-6;
}

double value_of(const PartResult& part, const Recipe& recipe, const char* name) {
    for (int i = 0; i < part.feature_count; ++i)
        if (std::string(recipe.features[i].name) == name && part.features[i].status == Status::ok)
            return value_of(part.features[i]);
    return NAN;
}

/// The light falls off to the left and rises to the right by a share of itself; then the sensor adds its
/// noise.
Picture<Gray8> seen(PartScene scene, double uneven) {
    if (uneven == 0) return render(scene);
    const std::int64_t noise = scene.noise;
    scene.noise = 0;
    Picture<Gray8> picture = render(scene);
    Random random(scene.seed);
    const auto share = std::llround(uneven * 65536);
    std::size_t at = 0;
    for (int y = 0; y < scene.size.height; ++y)
        for (int x = 0; x < scene.size.width; ++x, ++at) {
            const std::int64_t light = 65536 + share * (2 * x - scene.size.width + 1) / scene.size.width;
            std::int64_t sum = -6 * 65536;  // the sum of twelve has the variance 1
            for (int k = 0; k < 12; ++k) sum += random.next() >> 16;
            picture.pixels[at] = saturate_cast<Gray8>(
                round_shift(light * picture.pixels[at] + multiply_divide(sum, noise, 1000000), 16));
        }
    return picture;
}

/// Adds the errors of what was measured.
void judge_part(const PartResult& part, const Recipe& recipe, const PartScene& scene, Study& result) {
    for (int i = 0; i < part.feature_count; ++i) {
        if (part.features[i].status != Status::ok) continue;
        const double value = value_of(part.features[i]);
        if (recipe.features[i].kind == FeatureKind::position) result.position.add(value);
        if (recipe.features[i].kind == FeatureKind::angle) result.angle.add(value - true_angle(scene, value));
    }
    const double length = value_of(part, recipe, "length");
    const double width = value_of(part, recipe, "width_1");
    const double large = value_of(part, recipe, "hole_1");
    const double small = value_of(part, recipe, "hole_2");
    if (std::isnan(length) || std::isnan(width) || std::isnan(large) || std::isnan(small)) return;
    ++result.measured;
    result.width.add(length - 180);
    result.width.add(width - 70);
    result.hole.add(std::max(large, small) - 30);
    result.hole.add(std::min(large, small) - 18);
}

/// Sets the places of the holes in a recipe to where they truly are in the frame.
void place_holes(const PartScene& scene, const TrueFrame& frame, double turn, Recipe& recipe) {
    for (Feature& feature : recipe.features) {
        if (feature.kind != FeatureKind::position) continue;
        double least = INFINITY;
        PartPoint nearest;
        for (const apps::RoundHole& hole : scene.holes) {
            const Place place = turned(frame.to_frame({real(hole.x), real(hole.y)}), -turn);
            const double distance = std::hypot(place.x - static_cast<double>(feature.centre.x) * 1e-6,
                                               place.y - static_cast<double>(feature.centre.y) * 1e-6);
            if (distance >= least) continue;
            least = distance;
            nearest = {std::llround(place.x * 1e6), std::llround(place.y * 1e6)};
        }
        feature.centre = nearest;
    }
}

/// Teaches on a picture under the conditions that `change` makes and measures others under the same.
Study study(const std::function<void(PartScene&)>& change, int count = poses, double uneven = 0) {
    PartScene good = plate();
    good.angle = FineAngle();
    change(good);
    apps::TeachOptions options;
    const Picture<Gray8> good_picture = seen(good, uneven);
    const apps::Taught taught = apps::teach({good_picture}, {"good"}, options);
    std::vector<PartResult> parts;
    static_cast<void>(apps::gauge_picture(good_picture, taught.recipe, parts));
    if (parts.empty()) return {};
    // Teaching decides which end of the axis is the front: the true frame follows it.
    const TrueFrame frame(good);
    const double turn =
        std::abs(within_half_turn(degrees(parts.at(0).pose.frame.angle()) - frame.axis)) > 90 ? 180 : 0;
    Recipe recipe = taught.recipe;
    recipe.locate.area_min = 3000;
    recipe.locate.area_max = 30000;
    place_holes(good, frame, turn, recipe);

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
        if (apps::gauge_picture(seen(scene, uneven), recipe, parts) != Status::ok || parts.size() != 1)
            continue;
        ++result.found;
        const PartResult& part = parts[0];
        const Place truth = frame.in_picture(scene);
        const FinePoint origin = part.pose.frame.origin();
        result.origin.add(std::hypot(real(origin.x) - truth.x, real(origin.y) - truth.y));
        const double off =
            within_half_turn(degrees(part.pose.frame.angle()) - degrees(scene.angle) - frame.axis - turn);
        if (part.pose.ends_certain) {
            ++result.certain;
            if (std::abs(off) > 90) {
                ++result.wrong;
                continue;
            }
            result.axis.add(off);
        }
        judge_part(part, recipe, scene, result);
    }
    return result;
}

// ---- The page -----------------------------------------------------------------------------

struct Row {
    std::string name;
    Study study;
};

void print_tables(const char* what, const std::vector<Row>& rows) {
    std::printf(
        "\n| %s | width: mean | dev. | max | diameter: mean | dev. | max | found | measured | ends told | "
        "wrongly |\n|---|---|---|---|---|---|---|---|---|---|---|\n",
        what);
    for (const auto& [name, s] : rows)
        std::printf("| %s | %s | %s | %d | %d | %d | %d |\n", name.c_str(), s.width.row().c_str(),
                    s.hole.row().c_str(), s.found, s.measured, s.certain, s.wrong);
    std::printf(
        "\n| %s | origin: mean | max | axis: mean | dev. | max | position: mean | max | number | angle: mean "
        "| dev. | max | number |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
        what);
    for (const auto& [name, s] : rows)
        std::printf("| %s | %s | %s | %s | %d | %s | %d |\n", name.c_str(), s.origin.distance_row().c_str(),
                    s.axis.row().c_str(), s.position.distance_row().c_str(), s.position.count(),
                    s.angle.row().c_str(), s.angle.count());
}

std::string decimal(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return text;
}

Row uneven_row(const std::string& name, int percent, std::int64_t blur) {
    const auto change = [&](PartScene& s) {
        s.blur = blur;
        s.noise = 3000000;
        // Not so bright that the brightest place reaches 255.
        (s.part_level < s.ground_level ? s.ground_level : s.part_level) = 195;
    };
    return {name, study(change, poses, percent / 100.0)};
}

void print_introduction() {
    std::printf(
        "# Accuracy of the gauge\n\n"
        "Made by the program `accuracy` (tests/accuracy), which the tests run and compare with this page: "
        "every number is\na measurement, and the same on every machine.\n\n"
        "A plate of 180 x 70 px with a cut corner and holes of 30 and 18 px is rendered in %d poses: any "
        "angle, any\nfraction of a pixel, every second one bright on dark, by a recipe taught on one more of "
        "them. Blur is the standard\ndeviation of the lens in px, noise that of the sensor in grey levels, "
        "contrast the difference between part and ground.\nUnless a table says otherwise: blur 1, noise 4, "
        "contrast 185, even light.\n\n"
        "Every condition has two tables. What is true follows from the numbers of the scene, not from a "
        "measurement.\n\n"
        "- Errors of widths and diameters are in px: mean, standard deviation, largest. `found` counts the "
        "pictures with\n  exactly one part, `measured` those in which all four lengths have a value, `ends "
        "told` those in which the gauge\n  says which end is which, and `wrongly` those of them where it is "
        "the other one.\n"
        "- `origin` is the distance in px from where the origin of the part truly is, `axis` the error of "
        "its "
        "direction in\n  degrees. `position` is how far from its true place in the frame of the part a hole "
        "is seen, in px: the value of a\n  feature of that kind. `angle` is the error of an angle between "
        "two "
        "edges in degrees; the shortest of these edges is\n  36 px long. `number` counts the values.\n",
        poses);
}

void print_uneven_light() {
    std::vector<Row> rows;
    for (const int percent : {0, 5, 10, 15, 25})
        rows.push_back(uneven_row(decimal(percent) + " %", percent, 1000000));
    const Study& even = rows[0].study;
    const Study& uneven = rows[3].study;
    const auto largest = [](const Study& s) { return std::max(s.width.largest(), s.hole.largest()); };
    std::printf(
        "\n## Uneven light\n\n"
        "The light falls by that share of itself to the left border of the picture and rises by it to the "
        "right one. Noise 3,\nthe brighter level 195.\n\n"
        "One threshold holds for the whole picture. Where the light is strong, it lies nearer to the dark "
        "level, and the line\non which brightness crosses it moves into the dark side; where the light is "
        "weak, it moves out of it. The frame rests\non that line, so the origin moves, and with it every "
        "place. Edges of widths, diameters and angles are where brightness\nchanges most, which the light "
        "does not move.\n\n"
        "- Widths and diameters do not suffer: %.2f px at most with 15 %%, %.2f px in even light. Neither do "
        "angles.\n"
        "- Positions do: up to %.2f px with 15 %%, up to %.2f px in even light.\n"
        "- Light evenly. Compare the grey levels of the ground near opposite borders of a picture: they "
        "differ by "
        "twice the share\n  of the table. Give the tolerance of a position at least the largest value of "
        "that "
        "row.\n"
        "- Focus sharply: the line moves by a share of the blur, as the last two rows show.\n"
        "- A part that always lies the same way at the same place is moved alike every time, and a recipe "
        "taught there holds\n  that shift.\n",
        largest(uneven), largest(even), uneven.position.largest(), even.position.largest());
    rows.push_back(uneven_row("15 %, blur 0.5", 15, 500000));
    rows.push_back(uneven_row("15 %, blur 2", 15, 2000000));
    print_tables("light", rows);
}

}  // namespace

int main() {
    print_introduction();

    std::printf("\n## Blur\n");
    std::vector<Row> rows;
    for (const double blur : {0.4, 0.7, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0})
        rows.push_back({decimal(blur), study([&](PartScene& s) { s.blur = std::llround(blur * 1e6); })});
    print_tables("blur", rows);

    std::printf("\n## Noise\n");
    rows.clear();
    for (const double noise : {0.0, 2.0, 4.0, 8.0, 16.0, 24.0, 32.0})
        rows.push_back({decimal(noise), study([&](PartScene& s) { s.noise = std::llround(noise * 1e6); })});
    print_tables("noise", rows);

    std::printf("\n## Blur and noise together\n");
    rows.clear();
    for (const auto& [blur, noise] : {std::pair{1.5, 8.0}, {2.0, 8.0}, {3.0, 8.0}, {2.0, 16.0}})
        rows.push_back({decimal(blur) + ", " + decimal(noise), study([&, b = blur, n = noise](PartScene& s) {
                            s.blur = std::llround(b * 1e6);
                            s.noise = std::llround(n * 1e6);
                        })});
    print_tables("blur, noise", rows);

    std::printf("\n## Contrast\n");
    rows.clear();
    for (const int contrast : {160, 80, 40, 30, 20, 10})
        rows.push_back({std::to_string(contrast), study([&](PartScene& s) {
                            const bool dark = s.part_level < s.ground_level;
                            s.part_level = static_cast<Gray8>(120 - (dark ? contrast / 2 : -contrast / 2));
                            s.ground_level = static_cast<Gray8>(120 + (dark ? contrast / 2 : -contrast / 2));
                        })});
    print_tables("contrast", rows);

    print_uneven_light();

    std::printf("\n## Blur 0.7 to 1.5 with noise 4: the range that the gauge is made for, %d poses\n",
                poses_in_range);
    int round = 0;
    const auto in_range = [&](PartScene& s) { s.blur = 700000 + 4000 * (round++ % 201); };
    print_tables("blur", {{"0.7 to 1.5", study(in_range, poses_in_range)}});
    return 0;
}
