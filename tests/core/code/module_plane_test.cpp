// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include <fovea/base/random.hpp>
#include <fovea/code/finder_frame.hpp>
#include <fovea/code/module_plane.hpp>
#include <support/render.hpp>

namespace fovea::test {
namespace {

using namespace fovea::detail;

constexpr ModulePoint corners[4] = {{0, 0}, {21 * 16, 0}, {21 * 16, 21 * 16}, {0, 21 * 16}};

TEST(ModulePlane, MapsASquareUpright) {
    const ModulePoint places[4] = {
        {1000, 2000}, {1000 + 21 * 512, 2000}, {1000 + 21 * 512, 2000 + 21 * 512}, {1000, 2000 + 21 * 512}};
    const Result<ModulePlane> plane = ModulePlane::through(corners, places);
    ASSERT_TRUE(plane.ok());
    const ModulePoint middle = (*plane)({21 * 8, 21 * 8});
    EXPECT_NEAR(static_cast<double>(middle.x), 1000 + 21 * 256, 1);
    EXPECT_NEAR(static_cast<double>(middle.y), 2000 + 21 * 256, 1);
}

TEST(ModulePlane, EqualsAHomographyInRealNumbers) {
    Random random(161);
    for (int round = 0; round < 300; ++round) {
        const int size = random.between(21, 177);
        const ModulePoint modules[4] = {
            {56, 56}, {size * 16 - 56, 56}, {size * 16 - 104, size * 16 - 104}, {56, size * 16 - 56}};
        const double scale = uniform(random, 40, 8000);
        ModulePoint places[4];
        Eigen::Matrix<double, 8, 8> rows;
        Eigen::Matrix<double, 8, 1> right;
        for (int i = 0; i < 4; ++i) {
            places[i] = {
                std::llround((i == 1 || i == 2 ? 1 : 0) * 21 * scale + uniform(random, -2, 2) * scale +
                             90000),
                std::llround((i >= 2 ? 1 : 0) * 21 * scale + uniform(random, -2, 2) * scale + 90000)};
            const auto u = static_cast<double>(modules[i].x);
            const auto v = static_cast<double>(modules[i].y);
            const auto x = static_cast<double>(places[i].x);
            const auto y = static_cast<double>(places[i].y);
            rows.row(2 * i) << u, v, 1, 0, 0, 0, -u * x, -v * x;
            rows.row(2 * i + 1) << 0, 0, 0, u, v, 1, -u * y, -v * y;
            right(2 * i) = x;
            right(2 * i + 1) = y;
        }
        const Result<ModulePlane> plane = ModulePlane::through(modules, places);
        ASSERT_TRUE(plane.ok());
        const Eigen::Matrix<double, 8, 1> h = rows.fullPivLu().solve(right);
        ModulePlane::Walk walk(*plane, {8, 200}, 16);
        for (int i = 0; i < size; ++i) {
            const double u = 8 + 16 * i;
            const double w = h(6) * u + h(7) * 200 + 1;
            const ModulePoint place = walk.next();
            // Rounded toward zero, and coefficients to 2^-28 of themselves.
            EXPECT_NEAR(static_cast<double>(place.x), (h(0) * u + h(1) * 200 + h(2)) / w, 3);
            EXPECT_NEAR(static_cast<double>(place.y), (h(3) * u + h(4) * 200 + h(5)) / w, 3);
            const ModulePoint alone = (*plane)({8 + 16 * i, 200});
            EXPECT_EQ(place.x, alone.x);
            EXPECT_EQ(place.y, alone.y);
        }
    }
}

TEST(ModulePlane, RefusesWhatIsNoPlaneInFrontOfACamera) {
    const auto status = [](ModulePoint a, ModulePoint b, ModulePoint c, ModulePoint d) {
        const ModulePoint places[4] = {a, b, c, d};
        return ModulePlane::through(corners, places).status();
    };
    EXPECT_EQ(status({0, 0}, {100, 0}, {200, 0}, {300, 0}), Status::degenerate);
    EXPECT_EQ(status({0, 0}, {0, 0}, {0, 0}, {0, 0}), Status::degenerate);
    // One corner inside of the triangle of the others: the horizon passes between them.
    EXPECT_EQ(status({0, 0}, {9000, 0}, {1000, 1000}, {0, 9000}), Status::degenerate);
    EXPECT_EQ(status({0, 0}, {std::int64_t{1} << 24, 0}, {9000, 9000}, {0, 9000}), Status::degenerate);
}

TEST(ModulePlane, LinesMeetWhereTheyCross) {
    ModulePoint place;
    ASSERT_TRUE(meet({{0, 0}, {1000, 1000}}, {{0, 1000}, {1000, 0}}, place));
    EXPECT_EQ(place.x, 500);
    EXPECT_EQ(place.y, 500);
    EXPECT_FALSE(meet({{0, 0}, {10, 10}}, {{5, 0}, {15, 10}}, place));
}

}  // namespace
}  // namespace fovea::test
