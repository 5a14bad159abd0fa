// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/camera/undistortion_map.hpp>
#include <support/guarded_image.hpp>
#include <support/random_matrix.hpp>

namespace fovea::test {
namespace {

struct Numbers {
    double fx, fy, cx, cy, k1, k2, k3, p1, p2;
};
constexpr Numbers toolkit{
    532.4691162109, 530.2947998047, 338.1228942871, 238.8942871094, -0.4175221026, 0.1891709864, 0,
    0.0003914383,   -0.0011864222};
constexpr Numbers opencv_left{536.4547662,  536.4065193, 342.3677595,   235.5426585,   -0.2786528930,
                              0.0672480489, 0,           0.00182148412, -0.00034478546};

Camera<> camera_of(const Numbers& n) {
    return {real_of(n.fx), real_of(n.fy), real_of(n.cx), real_of(n.cy), real_of(n.k1),
            real_of(n.k2), real_of(n.k3), real_of(n.p1), real_of(n.p2)};
}
Camera<> pinhole(double f, double cx, double cy) { return camera_of({f, f, cx, cy, 0, 0, 0, 0, 0}); }

/// Book eq. 2.8 and 2.9 with floats: where a pixel of the view comes from. False behind the camera.
bool reference(const Numbers& n, const Matrix<3, 3>& rotation, const Camera<>& view, int u, int v,
               long double (&place)[2], long double& radius) {
    const auto f = [](Real r) { return value_of(r); };
    const long double p[3] = {(u - f(view.cx)) / f(view.fx), (v - f(view.cy)) / f(view.fy), 1};
    long double ray[3] = {};
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) ray[i] += f(rotation(k, i)) * p[k];
    if (ray[2] <= 0) return false;
    const long double x = ray[0] / ray[2], y = ray[1] / ray[2];
    const long double s = x * x + y * y;
    radius = std::sqrt(s);
    const long double r = 1 + s * (n.k1 + s * (n.k2 + s * n.k3));
    place[0] = n.cx + n.fx * (x * r + 2 * n.p1 * x * y + n.p2 * (s + 2 * x * x));
    place[1] = n.cy + n.fy * (y * r + n.p1 * (s + 2 * y * y) + 2 * n.p2 * x * y);
    return true;
}

/// The greatest error of rows of a map, every one that step reaches and the last; places that are not there
/// must be out of the field.
double error_of(const Numbers& n, const Matrix<3, 3>& rotation, const Camera<>& view, Size size, int step) {
    const LensInverse<> lens(camera_of(n));
    const auto map = undistortion_map(lens, rotation, view, size);
    EXPECT_TRUE(map.ok());
    if (!map) return 1e9;
    const long double field = value_of(lens.radius());
    std::vector<FinePoint> row(static_cast<std::size_t>(size.width));
    long double worst = 0;
    for (int y = 0; y < size.height;
         y = std::min(y + step, y == size.height - 1 ? size.height : size.height - 1)) {
        EXPECT_EQ(map->row(y, {row.data(), size.width}), Status::ok);
        for (int x = 0; x < size.width; ++x) {
            const FinePoint point = row[static_cast<std::size_t>(x)];
            EXPECT_TRUE(point == map->place(x, y));
            long double place[2] = {}, radius = 0;
            const bool seen = reference(n, rotation, view, x, y, place, radius);
            if (point == no_fine_point) {
                if (seen && radius < field * (1 - 1e-6L)) ADD_FAILURE() << x << "," << y;
                continue;
            }
            if (!seen || radius > field * (1 + 1e-6L)) ADD_FAILURE() << x << "," << y;
            worst = std::max({worst, std::abs(point.x.raw() / 65536.0L - place[0]),
                              std::abs(point.y.raw() / 65536.0L - place[1])});
        }
    }
    return static_cast<double>(worst);
}

const Matrix<3, 3> straight = Matrix<3, 3>::identity();
/// About three, six and one degrees.
const Matrix<3, 3> turned = rotation_about(Vector<3>(real_of(0.05), real_of(-0.1), real_of(0.02)));

TEST(UndistortionMap, TakesTheCornerOfTheToolkitsCamera) {
    // The toolkit's own function says 61.30, 43.71.
    const Camera<> camera = camera_of(toolkit);
    const auto map = undistortion_map(LensInverse<>(camera), straight, camera, {640, 480});
    ASSERT_TRUE(map.ok());
    const FinePoint corner = map->place(0, 0);
    EXPECT_NEAR(corner.x.raw() / 65536.0, 61.30, 0.01);
    EXPECT_NEAR(corner.y.raw() / 65536.0, 43.71, 0.01);
}

TEST(UndistortionMap, LeavesAPinholeAsItIs) {
    const Camera<> camera = pinhole(600, 320, 240);
    const auto map = undistortion_map(LensInverse<>(camera), straight, camera, {641, 481});
    ASSERT_TRUE(map.ok());
    for (int y = 0; y <= 480; y += 7)
        for (int x = 0; x <= 640; x += 5) {
            ASSERT_NEAR(map->place(x, y).x.raw(), 65536 * x, 1);
            ASSERT_NEAR(map->place(x, y).y.raw(), 65536 * y, 1);
        }
}

TEST(UndistortionMap, IsWithinATenThousandthOfAPixel) {
    // The demand of the project's numerics, for its cases.
    const Numbers hd{1400, 1400, 960, 540, -0.30, 0.10, 0, 0.001, -0.0005};
    const Numbers wide{1100, 1100, 960, 540, -0.18, 0.02, 0, 0.001, -0.0005};
    const Numbers uhd{2600, 2600, 1920, 1080, -0.25, 0.08, 0, 0.001, -0.0005};
    const Numbers third{2600, 2590, 1920, 1080, -0.31, 0.15, -0.04, 0.001, -0.0005};
    EXPECT_LT(error_of(toolkit, straight, camera_of(toolkit), {640, 480}, 3), 2e-5);
    EXPECT_LT(error_of(opencv_left, straight, camera_of(opencv_left), {640, 480}, 3), 2e-5);
    EXPECT_LT(error_of(opencv_left, turned, pinhole(521.16, 355.59, 242.78), {640, 480}, 3), 2e-5);
    EXPECT_LT(error_of(hd, turned, pinhole(1300, 960, 540), {1920, 1080}, 20), 1e-4);
    EXPECT_LT(error_of(wide, turned, pinhole(700, 960, 540), {1920, 1080}, 20), 1e-4);
    EXPECT_LT(error_of(uhd, straight, pinhole(2500, 1920, 1080), {3840, 2160}, 80), 1e-4);
    EXPECT_LT(error_of(third, turned, pinhole(2500, 1920, 1080), {3840, 2160}, 80), 1e-4);
}

TEST(UndistortionMap, EndsWhereTheFieldEnds) {
    // The lens folds back beyond 42 degrees; the view looks 70 degrees to each side. The other view looks
    // past its own horizon.
    const Camera<> wide = pinhole(120, 320, 240);
    const Numbers folding{500, 500, 320, 240, -0.4, 0, 0, 0, 0};
    EXPECT_LT(error_of(folding, straight, wide, {640, 480}, 5), 1e-4);
    // The toolkit's lens does not fold back, but at 70 degrees its terms have lost all measure.
    const auto map = undistortion_map(LensInverse<>(camera_of(toolkit)), straight, wide, {640, 480});
    ASSERT_TRUE(map.ok());
    EXPECT_TRUE(map->place(0, 240) == no_fine_point);
    EXPECT_FALSE(map->place(200, 240) == no_fine_point);
    EXPECT_LT(error_of({500, 500, 320, 240, 0, 0, 0, 0, 0},
                       rotation_about(Vector<3>(Real(), real_of(1.4), Real())), wide, {640, 480}, 5),
              1e-3);
}

TEST(UndistortionMap, HoldsItsErrorForRandomCameras) {
    Random random(5);
    const auto between = [&](double low, double high) {
        return low + (high - low) * random.between(0, 1 << 20) / (1 << 20);
    };
    for (int i = 0; i < 40; ++i) {
        Numbers n{};
        const int width = random.between(60, 900);
        const Size size{width, width * 3 / 4};
        n.fx = width * between(0.6, 2);
        n.fy = n.fx * between(0.98, 1.02);
        n.cx = width * between(0.4, 0.6);
        n.cy = width * between(0.3, 0.45);
        n.k1 = between(-0.35, 0.15);
        n.k2 = between(-0.1, 0.2);
        n.k3 = between(-0.05, 0.05);
        n.p1 = between(-0.002, 0.002);
        n.p2 = between(-0.002, 0.002);
        const double x = between(-0.2, 0.2);
        const double y = between(-0.2, 0.2);
        const Matrix<3, 3> rotation = rotation_about(Vector<3>(real_of(x), real_of(y), real_of(0.1)));
        ASSERT_LT(error_of(n, rotation, pinhole(n.fx * 0.9, n.cx, n.cy), size, 97), 2e-5) << i;
    }
}

TEST(UndistortionMap, FillsMapsAndGrids) {
    const Size size{101, 50};
    const Camera<> camera = camera_of({90, 90, 50, 25, -0.3, 0.1, 0, 0, 0});
    const auto map = undistortion_map(LensInverse<>(camera), turned, camera, size);
    ASSERT_TRUE(map.ok());
    GuardedImage<MapPoint> points(size), grid(map_grid_size(size));
    ASSERT_EQ(undistortion_points(*map, points.view()), Status::ok);
    ASSERT_EQ(undistortion_grid(*map, grid.view()), Status::ok);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const FinePoint place = map->place(x, y);
            ASSERT_EQ(points(x, y).x.raw(), (place.x.raw() + 128) >> 8);
            ASSERT_EQ(points(x, y).y.raw(), (place.y.raw() + 128) >> 8);
            if (x % 16 == 0 && y % 16 == 0) {
                ASSERT_TRUE(grid(x / 16, y / 16) == points(x, y));
            }
        }
    EXPECT_TRUE(points.intact());
    EXPECT_TRUE(grid.intact());
}

TEST(UndistortionGrid, MeetsItsMapWithinASixtyFourthOfAPixel) {
    const Size size{640, 480};
    GuardedImage<MapPoint> grid(map_grid_size(size));
    std::vector<FinePoint> places(640);
    std::vector<MapPoint> points(640);
    for (const Numbers& n : {toolkit, opencv_left}) {
        const auto map = undistortion_map(LensInverse<>(camera_of(n)), turned, camera_of(n), size);
        ASSERT_TRUE(map.ok());
        ASSERT_EQ(undistortion_grid(*map, grid.view()), Status::ok);
        const auto error =
            undistortion_grid_error(*map, grid.view(), {places.data(), 640}, {points.data(), 640});
        ASSERT_TRUE(error.ok());
        EXPECT_LT(error->raw(), 65536 / 100);
        EXPECT_GT(error->raw(), 65536 / 512);
        // A point that is a pixel off is seen.
        grid(7, 9).y = grid(7, 9).y + SubPixel::from_int(1);
        const auto off =
            undistortion_grid_error(*map, grid.view(), {places.data(), 640}, {points.data(), 640});
        ASSERT_TRUE(off.ok());
        EXPECT_NEAR(off->raw(), 65536, 600);
    }
}

TEST(CameraOfOneTerm, IsTheToolkitsSimpleModel) {
    // p + (1 + d r^2) (p - centre), in pixels.
    const Size size{320, 240};
    const double d = -3.5e-7;
    const Camera<> camera = camera_of_one_term(size, real_of(d));
    const auto map = undistortion_map(LensInverse<>(camera), straight, camera, size);
    ASSERT_TRUE(map.ok());
    for (int y = 0; y < 240; y += 13)
        for (int x = 0; x < 320; x += 11) {
            const double u = x - 159.5, v = y - 119.5;
            const double r = 1 + d * (u * u + v * v);
            ASSERT_NEAR(map->place(x, y).x.raw() / 65536.0, 159.5 + u * r, 2e-5);
            ASSERT_NEAR(map->place(x, y).y.raw() / 65536.0, 119.5 + v * r, 2e-5);
        }
}

TEST(UndistortionMap, RefusesWhatIsNoCameraOrNoView) {
    const Camera<> good = camera_of(toolkit);
    const auto status = [&](const Camera<>& camera, const Matrix<3, 3>& rotation, const Camera<>& view,
                            Size size) {
        return undistortion_map(LensInverse<>(camera), rotation, view, size).status();
    };
    EXPECT_EQ(status(good, straight, good, {640, 480}), Status::ok);
    EXPECT_EQ(status(good, straight, good, {1, 1}), Status::ok);
    EXPECT_EQ(status(good, straight, good, {0, 480}), Status::empty_image);
    EXPECT_EQ(status(good, straight, good, {640, -1}), Status::empty_image);
    EXPECT_EQ(status(good, straight, good, {32768, 1}), Status::image_too_large);
    const auto changed = [&](Real Camera<>::*member, double value) {
        Camera<> camera = good;
        camera.*member = real_of(value);
        return camera;
    };
    for (const double f : {0.0, -500.0}) {
        EXPECT_EQ(status(changed(&Camera<>::fx, f), straight, good, {640, 480}), Status::bad_argument);
        EXPECT_EQ(status(good, straight, changed(&Camera<>::fy, f), {640, 480}), Status::bad_argument);
    }
    Matrix<3, 3> mirrored = straight;
    mirrored(0, 0) = -Real::one();
    EXPECT_EQ(status(good, mirrored, good, {640, 480}), Status::bad_argument);
    EXPECT_EQ(status(good, straight * real_of(1.001), good, {640, 480}), Status::bad_argument);
    EXPECT_EQ(status(good, Matrix<3, 3>(), good, {640, 480}), Status::bad_argument);
    // Looks the other way.
    const Matrix<3, 3> behind(-Real::one(), Real(), Real(), Real(), Real::one(), Real(), Real(), Real(),
                              -Real::one());
    EXPECT_EQ(status(good, behind, good, {640, 480}), Status::out_of_range);
    EXPECT_EQ(status(changed(&Camera<>::cx, 40000), straight, good, {640, 480}), Status::out_of_range);
    EXPECT_EQ(status(changed(&Camera<>::fx, 1e12), straight, good, {640, 480}), Status::out_of_range);
    EXPECT_EQ(status(good, straight, changed(&Camera<>::fx, 1e-9), {640, 480}), Status::out_of_range);
    for (const double size : {1e-59, 1e59, -1e59})
        for (Real Camera<>::*member :
             {&Camera<>::fx, &Camera<>::cx, &Camera<>::k1, &Camera<>::k3, &Camera<>::p1}) {
            const Status lens = status(changed(member, size), straight, good, {640, 480});
            EXPECT_TRUE(lens == Status::ok || lens == Status::out_of_range || lens == Status::bad_argument);
            const Status view = status(good, straight, changed(member, size), {640, 480});
            EXPECT_TRUE(view == Status::ok || view == Status::out_of_range || view == Status::bad_argument);
        }
}

TEST(UndistortionMap, SaysWhichRowsAndGridsDoNotFit) {
    const Camera<> camera = camera_of(opencv_left);
    const auto map = undistortion_map(LensInverse<>(camera), straight, camera, {64, 48});
    ASSERT_TRUE(map.ok());
    EXPECT_EQ(map->size(), (Size{64, 48}));
    std::vector<FinePoint> row(100);
    EXPECT_EQ(map->row(0, {row.data(), 0}), Status::empty_image);
    EXPECT_EQ(map->row(0, {row.data(), 80}), Status::size_mismatch);
    EXPECT_EQ(map->row(-1, {row.data(), 64}), Status::out_of_range);
    EXPECT_EQ(map->row(63, {row.data(), 64}), Status::out_of_range);
    EXPECT_EQ(map->row(62, {row.data(), 79}), Status::ok);
    EXPECT_EQ(UndistortionMap().row(0, {row.data(), 64}), Status::empty_image);
    GuardedImage<MapPoint> wrong({6, 4}), grid({5, 4});
    EXPECT_EQ(undistortion_points(*map, wrong.view()), Status::size_mismatch);
    EXPECT_EQ(undistortion_grid(*map, wrong.view()), Status::size_mismatch);
    EXPECT_EQ(undistortion_grid(*map, {}), Status::empty_image);
    EXPECT_EQ(undistortion_points(UndistortionMap(), wrong.view()), Status::empty_image);
    std::vector<MapPoint> points(64);
    EXPECT_EQ(undistortion_grid_error(*map, {}, {row.data(), 64}, {points.data(), 64}).status(),
              Status::empty_image);
    EXPECT_EQ(undistortion_grid_error(*map, wrong.view(), {row.data(), 64}, {points.data(), 64}).status(),
              Status::size_mismatch);
    EXPECT_EQ(undistortion_grid_error(*map, grid.view(), {row.data(), 63}, {points.data(), 64}).status(),
              Status::scratch_too_small);
    EXPECT_EQ(undistortion_grid_error(*map, grid.view(), {row.data(), 64}, {points.data(), 63}).status(),
              Status::scratch_too_small);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 5; ++x) grid(x, y) = no_map_point;
    EXPECT_EQ(undistortion_grid_error(*map, grid.view(), {row.data(), 64}, {points.data(), 64}).status(),
              Status::not_found);
    EXPECT_TRUE(wrong.intact());
}

}  // namespace
}  // namespace fovea::test
