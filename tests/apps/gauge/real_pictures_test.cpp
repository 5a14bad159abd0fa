// SPDX-License-Identifier: MIT
//
// The gauge on pictures that nobody here made.
#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <string>
#include <vector>

#include <fovea/simulated/memory_storage.hpp>

#include <gauge/teach.hpp>
#include <support/picture.hpp>
#include <support/render.hpp>
#include <support/teaching.hpp>

namespace fovea::test {
namespace {

using apps::Picture;

Picture<Gray8> load(const std::filesystem::path& path) {
    simulated::MemoryStorage storage;
    storage.files["picture"] = read_file(path);
    Picture<Gray8> picture;
    std::string problem;
    EXPECT_TRUE(apps::load_gray(storage, "picture", picture, problem)) << path << problem;
    return picture;
}

/// A dark region: its pixels by flooding, all else in double precision.
struct DarkRegion {
    double area = 0, x = 0, y = 0, axis_deg = 0;
    bool at_border = false;
};

std::vector<DarkRegion> naive_dark_regions(const Picture<Gray8>& picture, int level, double least_area) {
    const int w = picture.size.width;
    const int h = picture.size.height;
    const auto view = picture.view();
    std::vector<bool> seen(picture.pixels.size());
    std::vector<DarkRegion> regions;
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x) {
            const auto at = [w](int u, int v) {
                return static_cast<std::size_t>(v) * static_cast<std::size_t>(w) +
                       static_cast<std::size_t>(u);
            };
            if (seen[at(x, y)] || view(x, y) >= level) continue;
            std::deque<Point> open = {{x, y}};
            std::vector<Point> pixels;
            seen[at(x, y)] = true;
            DarkRegion region;
            while (!open.empty()) {
                const Point p = open.front();
                open.pop_front();
                pixels.push_back(p);
                if (p.x == 0 || p.y == 0 || p.x == w - 1 || p.y == h - 1) region.at_border = true;
                for (int dy = -1; dy <= 1; ++dy)
                    for (int dx = -1; dx <= 1; ++dx) {
                        const Point q{p.x + dx, p.y + dy};
                        if (!view.contains(q) || seen[at(q.x, q.y)] || view(q.x, q.y) >= level) continue;
                        seen[at(q.x, q.y)] = true;
                        open.push_back(q);
                    }
            }
            region.area = static_cast<double>(pixels.size());
            for (const Point& p : pixels) {
                region.x += p.x / region.area;
                region.y += p.y / region.area;
            }
            double uu = 0, uv = 0, vv = 0;
            for (const Point& p : pixels) {
                uu += (p.x - region.x) * (p.x - region.x);
                uv += (p.x - region.x) * (p.y - region.y);
                vv += (p.y - region.y) * (p.y - region.y);
            }
            region.axis_deg = 0.5 * std::atan2(2 * uv, uu - vv) * 180 / pi;
            if (region.area >= least_area) regions.push_back(region);
        }
    return regions;
}

/// The threshold that maximises the between-class variance, in double precision: dark is below it.
int naive_otsu(const Picture<Gray8>& picture) {
    std::vector<double> counts(256);
    for (const Gray8 pixel : picture.pixels) ++counts[pixel];
    int best = 0;
    double most = -1;
    for (int level = 1; level < 256; ++level) {
        double n[2] = {0, 0};
        double sum[2] = {0, 0};
        for (int i = 0; i < 256; ++i) {
            n[i >= level] += counts[static_cast<std::size_t>(i)];
            sum[i >= level] += i * counts[static_cast<std::size_t>(i)];
        }
        if (n[0] == 0 || n[1] == 0) continue;
        const double step = sum[1] / n[1] - sum[0] / n[0];
        if (n[0] * n[1] * step * step > most) {
            most = n[0] * n[1] * step * step;
            best = level;
        }
    }
    return best;
}

TEST(PcaTest, SixBladesAreFoundAndNothingElseWhereADoublePrecisionComputationFindsThem) {
    const std::filesystem::path path = opencv_doc_folder() / "pca_test1.jpg";
    FOVEA_NEED_PICTURE(path);
    const Picture<Gray8> picture = load(path);
    const apps::Taught taught = taught_from({picture});
    ASSERT_EQ(taught.problem, "");
    std::vector<PartResult> parts;
    ASSERT_EQ(gauge_parts(picture, taught.recipe, parts), Status::ok);
    ASSERT_EQ(parts.size(), 6u);

    std::vector<DarkRegion> expected;
    for (const DarkRegion& region : naive_dark_regions(picture, naive_otsu(picture), 5000))
        if (!region.at_border) expected.push_back(region);
    ASSERT_EQ(expected.size(), 6u);
    double farthest = 0;
    double widest = 0;
    for (std::size_t i = 0; i < 6; ++i) {
        const PartFrame& frame = parts[i].pose.frame;
        const double distance =
            std::hypot(real(frame.origin().x) - expected[i].x, real(frame.origin().y) - expected[i].y);
        double angle = frame.angle().microdegrees() * 1e-6 - expected[i].axis_deg;
        angle -= 180 * std::round(angle / 180);
        farthest = std::max(farthest, distance);
        widest = std::max(widest, std::abs(angle));
        EXPECT_LT(distance, 0.5);
        EXPECT_LT(std::abs(angle), 0.2);
        EXPECT_EQ(parts[i].verdict, Verdict::ok);
    }
    std::printf("[ MEASURED ] six blades: at most %.3f px and %.3f deg from double precision\n", farthest,
                widest);
}

TEST(GeometricScene, HolesOfTheFlangeAreWhereTheToolkitMeasuredThem) {
    const std::filesystem::path path = data_folder() / "ivt" / "geometric_scene.bmp";
    FOVEA_NEED_PICTURE(path);
    const Picture<Gray8> picture = load(path);
    // Golden values of the toolkit: fitted circles of four large and four small holes of a bright flange.
    const struct {
        double x, y, radius;
    } holes[] = {{278.66, 226.08, 9.16}, {132.92, 185.50, 9.07}, {184.90, 278.41, 9.27},
                 {226.36, 132.39, 9.08}, {251.27, 287.91, 7.45}, {287.87, 159.14, 7.55},
                 {124.45, 251.29, 7.70}, {160.85, 124.71, 7.34}};
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(measure_feature_scratch(picture.size)));
    for (const auto& hole : holes) {
        Feature feature;
        feature.kind = FeatureKind::diameter;
        feature.centre = {std::llround(hole.x * 1e6), std::llround(hole.y * 1e6)};
        feature.radius = std::llround(hole.radius * 1e6);
        feature.search = 4000000;
        feature.outliers = 25;  // of a thick part seen from aside, the wall of a hole shows
        PartView view;
        view.image = picture.view();
        view.threshold.contrast = GrayLevel::from_int(60);
        const Result<Measurement> found =
            measure_feature(view, feature, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())});
        ASSERT_TRUE(found.ok()) << hole.x << " " << describe(found.status());
        // The toolkit fits whole pixels of an edge image, good to 0.2 px.
        EXPECT_NEAR(real(found->marks[0].x), hole.x, 0.2);
        EXPECT_NEAR(real(found->marks[0].y), hole.y, 0.2);
        EXPECT_NEAR(static_cast<double>(found->value.millionths) * 5e-7, hole.radius, 0.2);
        std::printf("[ MEASURED ] hole at (%.2f, %.2f) r %.2f; the toolkit has (%.2f, %.2f) r %.2f\n",
                    real(found->marks[0].x), real(found->marks[0].y),
                    static_cast<double>(found->value.millionths) * 5e-7, hole.x, hole.y, hole.radius);
    }
}

TEST(ToolkitScenes, GreySumsAndOtsuThresholdsAreTheToolkits) {
    const struct {
        const char* name;
        std::uint64_t sum;
        int otsu;  ///< of class 0, which is one below the level for threshold()
    } scenes[] = {{"distorted_left", 40004439, 154},  {"distorted_right", 42247238, 161},
                  {"geometric_scene", 37976403, 114}, {"scene_left", 33020739, 130},
                  {"scene_right", 34036786, 130},     {"tool_scene", 10368564, 90},
                  {"training_image", 45084770, 137}};
    FOVEA_NEED_PICTURE(data_folder() / "ivt");
    for (const auto& scene : scenes) {
        const Picture<Gray8> picture = load(data_folder() / "ivt" / (std::string(scene.name) + ".bmp"));
        std::uint64_t sum = 0;
        for (const Gray8 pixel : picture.pixels) sum += pixel;
        EXPECT_EQ(sum, scene.sum) << scene.name;
        Histogram histogram;
        ASSERT_EQ(histogram_of(picture.view(), histogram), Status::ok);
        EXPECT_EQ(*otsu(histogram), scene.otsu + 1) << scene.name;
    }
}

}  // namespace
}  // namespace fovea::test
