// SPDX-License-Identifier: MIT
//
// Corners of rendered checkerboards against the truth, under one disturbance after the other: prints a
// table. By hand; docs/operators/board.md tells of it.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/camera/checkerboard.hpp>
#include <support/board_scene.hpp>

namespace {

using namespace fovea;
using test::BoardScene;

constexpr int pictures = 25;

double share(Random& random, double low, double high) {
    return low + (high - low) * (random.next() / 4294967296.0);
}

void measure(const char* name, BoardScene scene, double most_tilt) {
    Random random(1);
    int found = 0;
    int wrong = 0;
    double sum = 0;
    double worst = 0;
    for (int n = 0; n < pictures; ++n) {
        if (most_tilt >= 0) scene.tilt = share(random, 0, most_tilt);
        scene.direction = share(random, 0, 360);
        scene.roll = share(random, -180, 180);
        const test::BoardView view(scene);
        const test::BoardPicture picture = view.render(random);
        const CheckerboardOptions options;
        std::vector<std::uint8_t> scratch(
            static_cast<std::size_t>(find_checkerboard_scratch(picture.size, scene.board, options)));
        std::vector<SubPixelPoint> corners(static_cast<std::size_t>(scene.board.area()));
        if (find_checkerboard(picture.view(), scene.board, options,
                              {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())},
                              {corners.data(), static_cast<std::ptrdiff_t>(corners.size())}) != Status::ok)
            continue;
        ++found;
        double largest = 0;
        for (int k = 0; k < scene.board.area(); ++k) {
            const test::Seen seen = view(k % scene.board.width, k / scene.board.width);
            const SubPixelPoint p = corners[static_cast<std::size_t>(k)];
            const double error = std::hypot(p.x.raw() / 256.0 - seen.x, p.y.raw() / 256.0 - seen.y);
            sum += error;
            largest = std::max(largest, error);
        }
        worst = std::max(worst, largest);
        if (largest > 2) ++wrong;
    }
    const double mean = found > 0 ? sum / (found * static_cast<double>(scene.board.area())) : 0;
    std::printf("| %s | %d of %d | %d | %.4f | %.3f |\n", name, found, pictures, wrong, mean, worst);
    std::fflush(stdout);
}

}  // namespace

int main() {
    std::printf("| pictures | found | wrong | mean | worst |\n|---|---|---|---|---|\n");
    BoardScene plain;
    for (const int tilt : {0, 20, 40, 50, 60, 70}) {
        BoardScene scene = plain;
        scene.tilt = tilt;
        char name[40];
        std::snprintf(name, sizeof name, "tilt %d", tilt);
        measure(name, scene, -1);
    }
    const auto each = [&](const char* what, double BoardScene::*field, const std::vector<double>& values) {
        for (const double value : values) {
            BoardScene scene = plain;
            scene.noise = 2;
            scene.*field = value;
            char name[40];
            std::snprintf(name, sizeof name, "%s %g", what, value);
            measure(name, scene, 45);
        }
    };
    each("noise", &BoardScene::noise, {0, 5, 10, 20, 30});
    each("blur", &BoardScene::blur, {0.3, 1.5, 2, 3, 4, 5});
    each("light", &BoardScene::light, {0.3, 0.1, 0.05});
    each("bright", &BoardScene::bright, {100, 70, 56});
    each("margin", &BoardScene::margin, {0, 0.2, 2});
    plain.picture = {160, 120};
    each("160x120, step", &BoardScene::step, {10, 8, 7, 6, 5});
}
