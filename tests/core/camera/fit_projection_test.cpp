// SPDX-License-Identifier: MIT
//
// The direct linear transform, what it is taken apart into, the rays of its pixels, and the fit of camera,
// lens and pose that follows it.
#include <fovea/camera/fit_projection.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include <fovea/camera/projection_matrix.hpp>
#include <fovea/camera/refine_view.hpp>
#include <support/object_scene.hpp>

namespace fovea::test {
namespace {

SubPixelPoint whole_pixel(int u, int v) { return {SubPixel::from_int(u), SubPixel::from_int(v)}; }
Vector<3> whole(int x, int y, int z) {
    return Vector<3>(Real::from_int(x), Real::from_int(y), Real::from_int(z));
}

/// Points at depths 512, 1024 and 2048 before a camera of f = 512 whose pixels are whole.
struct ExactView {
    std::vector<SpacePoint> points;
    std::vector<SubPixelPoint> pixels;

    void add(int x, int y, int depth) {
        points.push_back({x, y, depth - 1024});
        pixels.push_back(whole_pixel(512 * x / depth + 320, 512 * y / depth + 240));
    }
    ExactView() {
        add(0, 0, 512);
        add(64, -32, 512);
        add(-128, 40, 512);
        add(100, 200, 1024);
        add(-60, -20, 1024);
        add(8, -128, 1024);
        add(-400, 64, 2048);
        add(512, -256, 2048);
    }
};

/// Three plates of 8 x 8 points, 60 mm apart, at 1.7 m: in 1/16 mm.
std::vector<SpacePoint> three_plates() {
    std::vector<SpacePoint> points;
    for (int z = -1; z <= 1; ++z)
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 8; ++x) points.push_back({(x * 60 - 210) * 16, (y * 60 - 210) * 16, z * 960});
    return points;
}
Pose<> before_the_plates() {
    return {rotation_about(Vector<3>(real_of(0.3), real_of(-0.4), real_of(0.1))), whole(900, -700, 27200)};
}

/// The largest distance between where two matrices put points.
template <class Scalar>
double pixels_apart(const Matrix<3, 4>& a, const Matrix<3, 4, Scalar>& b,
                    const std::vector<SpacePoint>& points) {
    double most = 0;
    for (const SpacePoint point : points) {
        const auto first = project(a, vector_of(point));
        const auto second = project(b, vector_of<Scalar>(point));
        for (int r = 0; r < 2; ++r)
            most = std::fmax(most, std::fabs(static_cast<double>(value_of((*first)[r]) -
                                                                 static_cast<long double>((*second)[r]))));
    }
    return most;
}

TEST(FitProjection, OfPixelsThatAreExactIsTheCamera) {
    const ExactView view;
    const auto matrix = fit_projection(span_of(view.points), span_of(view.pixels));
    ASSERT_TRUE(matrix);
    const auto found = decompose(*matrix);
    ASSERT_TRUE(found);
    EXPECT_NEAR(plain(found->camera.fx), 512, 1e-13);
    EXPECT_NEAR(plain(found->camera.fy), 512, 1e-13);
    EXPECT_NEAR(plain(found->camera.cx), 320, 1e-13);
    EXPECT_NEAR(plain(found->camera.cy), 240, 1e-13);
    EXPECT_NEAR(plain(found->skew), 0, 1e-16);
    EXPECT_LE(difference(found->pose, {Matrix<3, 3>::identity(), whole(0, 0, 1024)}), 1e-15);
    // The third row tells distances.
    EXPECT_NEAR(plain((*matrix)(2, 2)), 1, 1e-16);
    EXPECT_NEAR(plain((*matrix)(2, 3)), 1024, 1e-12);
}

TEST(FitProjection, IsThatOfLongDouble) {
    Random random(61);
    for (int i = 0; i < 12; ++i) {
        const std::vector<SpacePoint> points =
            i == 0 ? three_plates() : random_object(random, 8 + 4 * i, 900);
        const Pose<> pose = i == 0 ? before_the_plates() : random_pose(random, 4000);
        const auto pixels = seen_by(usual_camera(i % 2 == 1), pose, points, 0.2, random);
        const auto matrix = fit_projection(span_of(points), span_of(pixels));
        const auto wide = fit_projection<long double>(span_of(points), span_of(pixels));
        ASSERT_TRUE(matrix && wide) << i;
        EXPECT_LE(pixels_apart(*matrix, *wide, points), 1e-13) << i;
        const auto near = decompose(*matrix);
        const auto far = decompose(*wide);
        ASSERT_TRUE(near && far);
        EXPECT_NEAR(plain(near->camera.fx), static_cast<double>(far->camera.fx), 1e-11) << i;
    }
}

TEST(FitProjection, OfThreePlatesKnowsTheCameraAsWellAsNoiseLets) {
    // numerics: 0.2 px of noise move fx by some px; without noise, 1/256 px remain.
    Random random(62);
    const auto points = three_plates();
    const auto pixels = seen_by(usual_camera(false), before_the_plates(), points, 0, random);
    const auto matrix = fit_projection(span_of(points), span_of(pixels));
    ASSERT_TRUE(matrix);
    const auto view = decompose(*matrix);
    ASSERT_TRUE(view);
    EXPECT_NEAR(plain(view->camera.fx), 864.7, 0.2);
    EXPECT_NEAR(plain(view->camera.cx), 331.25, 0.5);
    EXPECT_LE(difference(view->pose, before_the_plates()), 1e-3);
}

TEST(FitProjection, DoesNotDependOnWhereTheWorldHasItsOrigin) {
    // The book's L12 = 1 fails for an origin in the plane of the camera: here it is moved there.
    Random random(63);
    const auto points = random_object(random, 20, 500);
    const Pose<> pose{Matrix<3, 3>::identity(), whole(0, 0, 3000)};
    const auto pixels = seen_by(usual_camera(false), pose, points, 0.3, random);
    const auto matrix = fit_projection(span_of(points), span_of(pixels));
    std::vector<SpacePoint> shifted = points;
    for (SpacePoint& point : shifted) point.z += 3000;
    const auto moved = fit_projection(span_of(shifted), span_of(pixels));
    ASSERT_TRUE(matrix && moved);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto a = project(*matrix, vector_of(points[i]));
        const auto b = project(*moved, vector_of(shifted[i]));
        EXPECT_LE((exponent_of_difference<2, 1>(*a, *b)), -40);
    }
    EXPECT_NEAR(plain((*moved)(2, 3)), plain((*matrix)(2, 3)) - 3000, 200);
}

TEST(FitProjection, RefusesByName) {
    Random random(64);
    const Camera<> camera = usual_camera(false);
    const auto status_of_points = [&](const std::vector<SpacePoint>& points) {
        Random quiet(1);
        const Pose<> pose{rotation_about(Vector<3>(real_of(0.3), real_of(0.5), Real())), whole(0, 0, 5000)};
        const auto pixels = seen_by(camera, pose, points, 0.1, quiet);
        return fit_projection(span_of(points), span_of(pixels)).status();
    };
    auto points = random_object(random, 30, 800);
    EXPECT_EQ(status_of_points(points), Status::ok);
    EXPECT_EQ(status_of_points({points.begin(), points.begin() + 5}), Status::bad_argument);
    EXPECT_EQ(fit_projection(span_of(points), Span<const SubPixelPoint>()).status(), Status::size_mismatch);
    // A plane that leans, with noise; then one point beside it, which leaves the matrix open still.
    for (SpacePoint& point : points) point.z = point.x + 2 * point.y;
    EXPECT_EQ(*spread_of(span_of(points)), PointSpread::plane);
    EXPECT_EQ(status_of_points(points), Status::degenerate);
    points[7].z += 500;
    EXPECT_EQ(*spread_of(span_of(points)), PointSpread::space);
    EXPECT_EQ(status_of_points(points), Status::degenerate);
    // A sheet a million times as wide as thick tells nothing, though its equations have a solution.
    for (std::size_t i = 0; i < points.size(); ++i)
        points[i] = {random.between(-1000000, 1000000), random.between(-1000000, 1000000),
                     static_cast<std::int32_t>(i % 2)};
    EXPECT_EQ(*spread_of(span_of(points)), PointSpread::plane);
    const Pose<> far{rotation_about(Vector<3>(real_of(0.3), real_of(0.5), Real())), whole(0, 0, 5000000)};
    const auto sheet = seen_by(camera, far, points, 0.1, random);
    EXPECT_EQ(fit_projection(span_of(points), span_of(sheet)).status(), Status::degenerate);
    for (SpacePoint& point : points) point.y = point.z = 3 * point.x;
    EXPECT_EQ(*spread_of(span_of(points)), PointSpread::line);
    EXPECT_EQ(status_of_points(points), Status::degenerate);
    for (SpacePoint& point : points) point = {5, 6, 7};
    EXPECT_EQ(*spread_of(span_of(points)), PointSpread::point);
    EXPECT_EQ(status_of_points(points), Status::degenerate);
    EXPECT_EQ(spread_of(Span<const SpacePoint>()).status(), Status::bad_argument);
}

TEST(FitProjection, RefusesMirrorsAndPlacesBeyondTheRange) {
    ExactView view;
    for (SubPixelPoint& pixel : view.pixels) pixel.x = SubPixel::from_int(640) - pixel.x;
    EXPECT_EQ(fit_projection(span_of(view.points), span_of(view.pixels)).status(), Status::irregular);
    ExactView far;
    far.points[3].x = 2147483647;
    EXPECT_EQ(fit_projection(span_of(far.points), span_of(far.pixels)).status(), Status::out_of_range);
    ExactView wide;
    wide.pixels[3].y = SubPixel::from_raw(-2147483647 - 1);
    EXPECT_EQ(fit_projection(span_of(wide.points), span_of(wide.pixels)).status(), Status::out_of_range);
}

TEST(Decompose, TakesApartWhatProjectionMatrixMade) {
    Random random(65);
    for (int i = 0; i < 30; ++i) {
        Camera<> camera = usual_camera(false);
        camera.cx = camera.cx * random_part(random);
        const Pose<> pose{rotation_about(random_matrix<3, 1>(random) * Real::from_int(5)),
                          random_matrix<3, 1>(random) * Real::from_int(9)};
        const auto matrix = projection_matrix(camera, pose) * real_of(0.37);
        const auto view = decompose(matrix);
        ASSERT_TRUE(view);
        ASSERT_LE(difference(view->pose, pose), 1e-16);
        ASSERT_LE((exponent_of_difference<3, 3>(view->pose.rotation * view->pose.rotation.transposed(),
                                                Matrix<3, 3>::identity())),
                  -60);
        ASSERT_NEAR(plain(view->camera.fx), 864.7, 1e-12);
        ASSERT_NEAR(plain(view->camera.cx), plain(camera.cx), 1e-12);
        ASSERT_NEAR(plain(view->skew), 0, 1e-16);
        ASSERT_EQ(decompose(-matrix).status(), Status::irregular);
    }
    EXPECT_EQ(decompose(Matrix<3, 4>()).status(), Status::degenerate);
}

TEST(Decompose, SharesTheSkewBetweenTheAxes) {
    // Rows r1 and r2 with a product of 0.6, from the centre (1, 2, 3).
    Matrix<3, 4> matrix;
    matrix(0, 0) = Real::one();
    matrix(1, 0) = real_of(0.6);
    matrix(1, 1) = real_of(0.8);
    matrix(2, 2) = Real::one();
    for (int r = 0; r < 3; ++r) {
        Real sum;
        for (int c = 0; c < 3; ++c) sum += matrix(r, c) * Real::from_int(c + 1);
        matrix(r, 3) = -sum;
    }
    const auto view = decompose(matrix);
    ASSERT_TRUE(view);
    EXPECT_NEAR(plain(view->skew), 0.6, 1e-16);
    // Both have turned by half of what their angle lacks to 90 degrees.
    const double half = std::asin(0.6) / 2;
    EXPECT_NEAR(plain(view->pose.rotation(0, 0)), std::cos(half), 1e-15);
    EXPECT_NEAR(plain(view->pose.rotation(0, 1)), -std::sin(half), 1e-15);
    EXPECT_LE((exponent_of_difference<3, 1>(view->pose(whole(1, 2, 3)), Vector<3>())), -58);
}

TEST(RayOf, LeadsThroughThePointOfItsPixel) {
    Random random(66);
    for (int i = 0; i < 40; ++i) {
        const Pose<> pose = random_pose(random, 2000);
        const auto matrix = projection_matrix(usual_camera(false), pose);
        const SpacePoint point = random_object(random, 1, 900)[0];
        const auto pixel = project(matrix, vector_of(point));
        ASSERT_TRUE(pixel);
        const auto ray = ray_of(matrix, *pixel);
        ASSERT_TRUE(ray);
        const Vector<3> off = cross(vector_of(point) - ray->point, ray->direction);
        ASSERT_LE(plain(length_of(off)), 1e-12);
        ASSERT_NEAR(plain(length_of(ray->direction)), 1, 1e-17);
        // Away from the camera; also from one that mirrors.
        const Vector<3> centre = inverse(pose)(Vector<3>());
        ASSERT_TRUE(dot(ray->direction, vector_of(point) - centre).positive());
        Matrix<3, 4> mirror = matrix;
        for (int c = 0; c < 4; ++c) mirror(0, c) = -mirror(0, c);
        const auto mirrored = ray_of(mirror, Vector<2>(-(*pixel)[0], (*pixel)[1]));
        ASSERT_TRUE(mirrored);
        ASSERT_LE((exponent_of_difference<3, 1>(mirrored->direction, ray->direction)), -55);
    }
}

TEST(RayOf, HasAPivotWhereTheBookDividesByZero) {
    // The book's a = L9 u - L1 is 0 for a pixel of the column cx of a camera that looks along an axis, and r
    // in the centre of the image: straight ahead, to the side, and from above.
    const Real zero;
    const Real one = Real::one();
    const Camera<> camera = usual_camera(false);
    const Matrix<3, 3> views[3] = {Matrix<3, 3>::identity(),
                                   Matrix<3, 3>(zero, one, zero, zero, zero, one, one, zero, zero),
                                   Matrix<3, 3>(one, zero, zero, zero, zero, -one, zero, one, zero)};
    for (const Matrix<3, 3>& rotation : views) {
        const Pose<> pose{rotation, whole(3, -4, 100)};
        const auto matrix = projection_matrix(camera, pose);
        const Vector<2> pixels[3] = {Vector<2>(camera.cx, camera.cy), Vector<2>(camera.cx, real_of(11)),
                                     Vector<2>(real_of(7), camera.cy)};
        for (const Vector<2>& pixel : pixels) {
            const auto ray = ray_of(matrix, pixel);
            ASSERT_TRUE(ray);
            const Vector<3> far = ray->point + ray->direction * Real::from_int(100000);
            const auto seen = project(matrix, far);
            ASSERT_TRUE(seen);
            ASSERT_LE((exponent_of_difference<2, 1>(*seen, pixel)), -45);
        }
    }
    EXPECT_EQ(ray_of(Matrix<3, 4>(), Vector<2>()).status(), Status::degenerate);
}

TEST(FitView, FindsTheLensOfThreePlates) {
    Random random(67);
    const auto points = three_plates();
    const Camera<> camera = usual_camera(true);
    const Pose<> pose{rotation_about(Vector<3>(real_of(0.5), real_of(-0.6), real_of(0.1))),
                      whole(900, -700, 9600)};
    for (const double noise : {0.0, 0.1}) {
        const auto pixels = seen_by(camera, pose, points, noise, random);
        const auto fit = fit_view(span_of(points), span_of(pixels), IntrinsicsOptions());
        ASSERT_TRUE(fit);
        // Pixels are rounded to 1/256: deviations are 1/256 / sqrt(12) an axis, or the noise.
        const double axis = std::sqrt(noise * noise + 1.0 / (256 * 256 * 12));
        EXPECT_NEAR(plain(fit->rms), axis * std::sqrt(2), 0.15 * axis);
        double squares = 0;
        for (int i = 0; i < camera_terms; ++i) {
            const auto term = static_cast<CameraTerm>(i);
            const double off = plain(term_of(fit->camera, term) - term_of(camera, term));
            const double deviation = plain(term_of(fit->deviation, term));
            // Four standard deviations; k3 is held at 0.
            EXPECT_LE(std::fabs(off), 4 * deviation) << i << " " << noise;
            if (deviation > 0) squares += off * off / (deviation * deviation);
        }
        // Deviations are no larger than they need be: the sum of eight squares whose mean is 1 each, of
        // which some go together.
        EXPECT_GT(squares, 0.8) << noise;
        EXPECT_EQ(fit->deviation.k3, Real());
        // Without the lens the fit is worse, and the linear start is not better than the fit.
        IntrinsicsOptions bare;
        bare.lens = LensTerms::none;
        const auto pinhole = fit_view(span_of(points), span_of(pixels), bare);
        ASSERT_TRUE(pinhole);
        EXPECT_GT(plain(pinhole->rms), 5 * plain(fit->rms));
        EXPECT_EQ(pinhole->camera.k1, Real());
    }
}

TEST(FitView, IsTheFitOfLongDoubleAndRefusesByName) {
    Random random(68);
    const auto points = three_plates();
    const auto pixels = seen_by(usual_camera(true), before_the_plates(), points, 0.2, random);
    IntrinsicsOptions options;
    options.lens = LensTerms::k1_k2;
    const auto fit = fit_view(span_of(points), span_of(pixels), options);
    const auto wide = fit_view<long double>(span_of(points), span_of(pixels), options);
    ASSERT_TRUE(fit && wide);
    EXPECT_NEAR(plain(fit->camera.fx), static_cast<double>(wide->camera.fx), 1e-9 * plain(fit->deviation.fx));
    EXPECT_NEAR(plain(fit->camera.k2), static_cast<double>(wide->camera.k2), 1e-9 * plain(fit->deviation.k2));
    EXPECT_NEAR(plain(fit->rms), static_cast<double>(wide->rms), 1e-15);

    std::vector<SpacePoint> flat = points;
    for (SpacePoint& point : flat) point.z = 0;
    const Camera<> camera = usual_camera(false);
    EXPECT_EQ(refine_view(span_of(flat), span_of(pixels), camera, before_the_plates(), options).status(),
              Status::degenerate);
    const Pose<> behind{Matrix<3, 3>::identity(), whole(0, 0, -9000)};
    EXPECT_EQ(refine_view(span_of(points), span_of(pixels), camera, behind, options).status(),
              Status::out_of_range);
    EXPECT_EQ(
        refine_view(span_of(points).first(6), span_of(pixels).first(6), camera, behind, IntrinsicsOptions())
            .status(),
        Status::bad_argument);
    EXPECT_EQ(refine_view(span_of(points), span_of(pixels).first(9), camera, behind, options).status(),
              Status::size_mismatch);
}

}  // namespace
}  // namespace fovea::test
