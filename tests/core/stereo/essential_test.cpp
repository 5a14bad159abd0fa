// SPDX-License-Identifier: MIT
//
// Fundamental and essential matrices of pairs of pixels.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <fovea/stereo/eight_point.hpp>
#include <fovea/stereo/essential.hpp>
#include <fovea/stereo/ransac_epipolar.hpp>
#include <support/stereo_rigs.hpp>

namespace fovea::test {
namespace {

using Pixels = std::vector<SubPixelPoint>;
using Rays = std::vector<Vector<2>>;

template <class T>
Span<const T> span_of(const std::vector<T>& elements) {
    return {elements.data(), static_cast<std::ptrdiff_t>(elements.size())};
}
Rays rays_of_pixels(const LensInverse<>& lens, const Pixels& pixels) {
    Rays rays(pixels.size());
    EXPECT_EQ(rays_of(lens, span_of(pixels), Span<Vector<2>>(rays.data(), span_of(rays).size())), Status::ok);
    return rays;
}

/// The largest distance of pixels from the lines of each other.
double worst_distance(const Matrix<3, 3>& f, const Pixels& left, const Pixels& right) {
    double worst = 0;
    for (std::size_t i = 0; i < left.size(); ++i) {
        const Vector<2> x = vector_of<Real>(left[i]);
        const Vector<2> y = vector_of<Real>(right[i]);
        worst = std::max(worst, std::abs(plain_number(distance_from_line(*epipolar_line(f, x), y))));
    }
    return worst;
}
/// How far two matrices lead apart: the largest difference of the distances that their lines have from
/// pixels.
template <class Scalar>
double apart(const Matrix<3, 3>& f, const Matrix<3, 3, Scalar>& g, const Pixels& left, const Pixels& right) {
    double most = 0;
    for (std::size_t i = 0; i < left.size(); ++i) {
        const auto a =
            distance_from_line(*epipolar_line(f, vector_of<Real>(left[i])), vector_of<Real>(right[i]));
        const auto b =
            distance_from_line(*epipolar_line(g, vector_of<Scalar>(left[i])), vector_of<Scalar>(right[i]));
        most = std::max(most, std::abs(std::abs(plain_number(a)) - std::abs(plain_number(b))));
    }
    return most;
}

TEST(FitFundamental, FindsTheCameras) {
    Random random(1);
    for (int i = 0; i < 12; ++i) {
        const RandomRig rig(random, i % 2 == 0 ? RandomRig::Kind::side_by_side : RandomRig::Kind::one_above,
                            false);
        const SeenPlaces seen = look_at(rig.cameras<double>(), random, 40);
        ASSERT_EQ(seen.places.size(), 40u);
        const Matrix<3, 3> f = *fit_fundamental(seen.left_span(), seen.right_span());
        // Pixels are rounded to 1/256, which moves lines by a few of those.
        ASSERT_LE(worst_distance(f, seen.left, seen.right), 0.02);
        ASSERT_LE(apart(f, *fundamental_matrix(rig.cameras<Real>()), seen.left, seen.right), 0.02);
        ASSERT_LE(std::abs(plain_number(determinant(f))), 1e-19);
        // Of the same pairs the other way round it is the transpose.
        const Matrix<3, 3> back = *fit_fundamental(seen.right_span(), seen.left_span());
        ASSERT_LE(
            std::min(largest_difference(back, f.transposed()), largest_difference(-back, f.transposed())),
            1e-15);
        // The demand is 1e-12 px, of which double itself takes a part.
        const Matrix<3, 3, double> same = *fit_fundamental<double>(seen.left_span(), seen.right_span());
        ASSERT_LE(apart(f, same, seen.left, seen.right), 1e-11);
    }
}

TEST(FitFundamental, EightPairsByHand) {
    // Side by side with 500 px. The corners of a box do not do, wherever the cameras stand: quadrics through
    // seven of them pass through the eighth.
    const int box[8][3] = {{-2, -2, 10}, {2, -2, 10}, {-2, 2, 10}, {2, 2, 10},
                           {-2, -2, 14}, {2, -2, 14}, {-2, 2, 14}, {2, 2, 14}};
    const int other[8][3] = {{-2, -2, 10}, {2, -1, 14}, {-1, 2, 8},  {2, 2, 11},
                             {0, -2, 13},  {3, 1, 9},   {-3, 1, 12}, {1, 0, 7}};
    for (const auto& corners : {box, other}) {
        Pixels left;
        Pixels right;
        for (int i = 0; i < 8; ++i) {
            const double x = corners[i][0];
            const double y = corners[i][1];
            const double z = corners[i][2];
            left.push_back(pixel_near(320 + 500 * x / z, 240 + 500 * y / z));
            right.push_back(pixel_near(320 + 500 * (x - 1) / z, 240 + 500 * y / z));
        }
        const Result<Matrix<3, 3>> f = fit_fundamental(span_of(left), span_of(right));
        if (corners == box) {
            EXPECT_EQ(f.status(), Status::degenerate);
            continue;
        }
        ASSERT_TRUE(f);
        // With as many equations as unknowns they hold exactly, but for the rank and the pixels' rounding.
        EXPECT_LE(worst_distance(*f, left, right), 0.01);
        const double sign = plain_number((*f)(1, 2)) > 0 ? 1 : -1;
        EXPECT_NEAR(sign * plain_number((*f)(1, 2)), std::sqrt(0.5), 0.01);
        EXPECT_NEAR(sign * plain_number((*f)(2, 1)), -std::sqrt(0.5), 0.01);
    }
}

TEST(FitFundamental, RefusesPlanesLinesAndPoints) {
    Random random(2);
    int flat = 0;
    for (int i = 0; i < 12; ++i) {
        const RandomRig rig(random, RandomRig::Kind::side_by_side, false);
        const StereoCamera<double> pair = rig.cameras<double>();
        // Noise wants more pairs.
        const int count = i % 3 == 0 ? 8 : i % 3 == 1 ? 30 : 60;
        const SeenPlaces plane = look_at(pair, random, count, i % 3 == 2 ? 0.5 : 0, true);
        const auto found = fit_fundamental(plane.left_span(), plane.right_span());
        flat += found.status() == Status::degenerate ? 1 : 0;
        // Cameras at one place: whatever is seen, a homography fits.
        StereoCamera<double> turned = pair;
        turned.right_from_left.translation = Vector<3, double>();
        const SeenPlaces same = look_at(turned, random, count);
        ASSERT_EQ(fit_fundamental(same.left_span(), same.right_span()).status(), Status::degenerate);
    }
    EXPECT_EQ(flat, 12);
    Pixels line;
    Pixels other;
    for (int i = 0; i < 20; ++i) {
        line.push_back(pixel_near(10 + 17 * i, 20 + 11 * i));
        other.push_back(pixel_near(5 + 19 * i + i * i % 7, 20 + 11 * i));
    }
    EXPECT_EQ(fit_fundamental(span_of(line), span_of(other)).status(), Status::degenerate);
    EXPECT_EQ(fit_fundamental(span_of(line), span_of(line)).status(), Status::degenerate);
    const Pixels one(20, pixel_near(100, 100));
    EXPECT_EQ(fit_fundamental(span_of(one), span_of(one)).status(), Status::degenerate);
    EXPECT_EQ(fit_fundamental(span_of(one), span_of(line)).status(), Status::degenerate);
    EXPECT_EQ(fit_fundamental(span_of(line), span_of(one)).status(), Status::degenerate);
}

TEST(FitFundamental, WantsEigenvaluesThatAreApart) {
    // Of 64 pairs: the least, the one before, and the one before that.
    const auto status = [](double least, double second, double third) {
        Matrix<9, 9> sums;
        for (int i = 0; i < 9; ++i) sums(i, i) = Real::from_int(1000);
        sums(2, 2) = real_of(least);
        sums(5, 5) = real_of(second);
        sums(7, 7) = real_of(third);
        const Result<Matrix<3, 3>> f = detail::least_direction(sums, Real::from_ratio(1, 2), 64);
        EXPECT_TRUE(!f || (*f)(0, 2).absolute() == Real::one());
        return f.status();
    };
    EXPECT_EQ(status(1, 1.26, 25), Status::ok);
    EXPECT_EQ(status(1, 1.24, 25), Status::degenerate);
    EXPECT_EQ(status(1, 1.26, 23), Status::degenerate);
    EXPECT_EQ(status(0, 0.51, 25), Status::ok);
    EXPECT_EQ(status(0, 0.49, 25), Status::degenerate);
}

TEST(FitFundamental, RefusesWrongInput) {
    Pixels left(20);
    Pixels right(19);
    EXPECT_EQ(fit_fundamental(span_of(left), span_of(right)).status(), Status::size_mismatch);
    EXPECT_EQ(fit_fundamental(Span<const SubPixelPoint>(), Span<const SubPixelPoint>()).status(),
              Status::bad_argument);
    left.resize(7);
    right.resize(7);
    EXPECT_EQ(fit_fundamental(span_of(left), span_of(right)).status(), Status::bad_argument);
    left.resize(8);
    right.resize(8);
    for (const std::int32_t raw : {std::int32_t{2147483647}, std::int32_t{-2147483647 - 1}, (1 << 24) + 1}) {
        left[3].y = SubPixel::from_raw(raw);
        EXPECT_EQ(fit_fundamental(span_of(left), span_of(right)).status(), Status::out_of_range);
        EXPECT_EQ(fit_fundamental(span_of(right), span_of(left)).status(), Status::out_of_range);
    }
}

TEST(FitFundamentalRansac, FindsTheOnesThatBelongTogether) {
    Random random(3);
    for (int i = 0; i < 4; ++i) {
        const RandomRig rig(random, RandomRig::Kind::side_by_side, false);
        SeenPlaces seen = look_at(rig.cameras<double>(), random, 60, 0.2);
        ASSERT_EQ(seen.places.size(), 60u);
        const Pixels left = seen.left;
        // A third of the pairs are of nothing.
        for (std::size_t k = 0; k < 20; ++k) {
            const int x = random.between(0, 639);
            const int y = random.between(0, 479);
            seen.right[3 * k] = pixel_near(x, y);
        }
        std::vector<std::uint8_t> agrees(60, 7);
        const Span<std::uint8_t> flags(agrees.data(), 60);
        const auto found =
            fit_fundamental_ransac(seen.left_span(), seen.right_span(), SubPixel::from_int(1), {}, flags);
        ASSERT_TRUE(found) << i;
        EXPECT_TRUE(found->certain);
        EXPECT_GE(found->agreeing, 38);
        const Matrix<3, 3> truth = *fundamental_matrix(rig.cameras<Real>());
        int counted = 0;
        for (std::size_t k = 0; k < 60; ++k) {
            const double distance = plain_number(*sampson_distance(found->transform, vector_of<Real>(left[k]),
                                                                   vector_of<Real>(seen.right[k])));
            EXPECT_EQ(agrees[k], distance <= 1 ? 1 : 0) << k;
            counted += agrees[k];
            EXPECT_TRUE(k % 3 == 0 || agrees[k] == 1) << k;
        }
        EXPECT_EQ(counted, found->agreeing);
        Pixels good_left;
        Pixels good_right;
        for (std::size_t k = 0; k < 60; ++k)
            if (k % 3 != 0) {
                good_left.push_back(left[k]);
                good_right.push_back(seen.right[k]);
            }
        // Noise of 0.2 px in each of four coordinates.
        EXPECT_LE(worst_distance(truth, good_left, good_right), 1.2);
        EXPECT_LE(worst_distance(found->transform, good_left, good_right), 1.2);
        // The same seed, the same answer; another, nearly.
        std::vector<std::uint8_t> again(60, 7);
        const Span<std::uint8_t> other(again.data(), 60);
        const auto same =
            fit_fundamental_ransac(seen.left_span(), seen.right_span(), SubPixel::from_int(1), {}, other);
        EXPECT_EQ(same->transform, found->transform);
        EXPECT_EQ(again, agrees);
    }
}

TEST(FitFundamentalRansac, APlaneWithALittleBesideItIsFoundWhole) {
    // Samples from the plane alone would agree with all of it, and with nothing else.
    Random random(8);
    const RandomRig rig(random, RandomRig::Kind::side_by_side, false);
    const StereoCamera<double> pair = rig.cameras<double>();
    SeenPlaces seen = look_at(pair, random, 100, 0, true);
    const SeenPlaces beside = look_at(pair, random, 4);
    seen.left.insert(seen.left.end(), beside.left.begin(), beside.left.end());
    seen.right.insert(seen.right.end(), beside.right.begin(), beside.right.end());
    std::vector<std::uint8_t> agrees(104, 7);
    const auto found = fit_fundamental_ransac(seen.left_span(), seen.right_span(), SubPixel::from_ratio(1, 8),
                                              {}, Span<std::uint8_t>(agrees.data(), 104));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->agreeing, 104);
    EXPECT_LE(apart(found->transform, *fundamental_matrix(rig.cameras<Real>()), seen.left, seen.right), 0.02);
}

TEST(FitFundamentalRansac, ItsToleranceIsOfSampsonsDistance) {
    // Side by side, an offset of a row by d is a distance of d over the root of 2.
    Random random(9);
    Pixels left;
    Pixels right;
    for (int i = 0; i < 60; ++i) {
        const int x = random.between(100, 600);
        const int y = random.between(0, 479);
        const int disparity = random.between(20, 90);
        left.push_back(pixel_near(x, y));
        right.push_back(pixel_near(x - disparity, y));
    }
    right[10].y += SubPixel::from_ratio(13, 10);
    right[20].y += SubPixel::from_ratio(-155, 100);
    std::vector<std::uint8_t> agrees(60, 7);
    const auto found = fit_fundamental_ransac(span_of(left), span_of(right), SubPixel::from_int(1), {},
                                              Span<std::uint8_t>(agrees.data(), 60));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->agreeing, 59);
    EXPECT_EQ(agrees[10], 1);
    EXPECT_EQ(agrees[20], 0);
}

TEST(FitFundamentalRansac, RefusesWhatItCannotFind) {
    Random random(4);
    const RandomRig rig(random, RandomRig::Kind::side_by_side, false);
    const StereoCamera<double> pair = rig.cameras<double>();
    const SeenPlaces plane = look_at(pair, random, 30, 0, true);
    const SeenPlaces seen = look_at(pair, random, 30);
    std::vector<std::uint8_t> agrees(30, 7);
    const Span<std::uint8_t> flags(agrees.data(), 30);
    const SubPixel one = SubPixel::from_int(1);
    RansacOptions options;
    options.most_samples = 50;
    const auto call = [&](const SeenPlaces& places, SubPixel tolerance) {
        return fit_fundamental_ransac(places.left_span(), places.right_span(), tolerance, options, flags)
            .status();
    };
    EXPECT_EQ(call(plane, one), Status::degenerate);
    // With noise some samples of a plane make a matrix; what agrees with it is seen to be one.
    const SeenPlaces noisy = look_at(pair, random, 60, 0.5, true);
    std::vector<std::uint8_t> others(60, 7);
    EXPECT_EQ(fit_fundamental_ransac(noisy.left_span(), noisy.right_span(), one, {},
                                     Span<std::uint8_t>(others.data(), 60))
                  .status(),
              Status::degenerate);
    EXPECT_EQ(others, std::vector<std::uint8_t>(60, 7));
    EXPECT_EQ(call(seen, SubPixel()), Status::bad_argument);
    options.enough = 31;
    EXPECT_EQ(call(seen, one), Status::not_found);
    options.most_samples = 0;
    EXPECT_EQ(call(seen, one), Status::bad_argument);
    options = {};
    EXPECT_EQ(
        fit_fundamental_ransac(seen.left_span(), seen.right_span(), one, options, flags.first(29)).status(),
        Status::size_mismatch);
    EXPECT_EQ(
        fit_fundamental_ransac(seen.left_span(), seen.right_span().first(29), one, options, flags).status(),
        Status::size_mismatch);
    EXPECT_EQ(fit_fundamental_ransac(seen.left_span().first(7), seen.right_span().first(7), one, options,
                                     flags.first(7))
                  .status(),
              Status::bad_argument);
    EXPECT_EQ(agrees, std::vector<std::uint8_t>(30, 7));
}

// ---- Rays ----------------------------------------------------------------------------------

TEST(FitEssential, FindsThePoseThroughTheLenses) {
    Random random(5);
    for (int i = 0; i < 6; ++i) {
        const RandomRig rig(random, i % 2 == 0 ? RandomRig::Kind::side_by_side : RandomRig::Kind::one_above);
        const StereoCamera<> pair = rig.cameras<Real>();
        const SeenPlaces seen = look_at(rig.cameras<double>(), random, 30);
        const Rays left = rays_of_pixels(LensInverse<>(pair.left), seen.left);
        const Rays right = rays_of_pixels(LensInverse<>(pair.right), seen.right);
        const Matrix<3, 3> e = *fit_essential(span_of(left), span_of(right));
        const Result<RecoveredPose<>> found = recover_pose(e, span_of(left), span_of(right));
        ASSERT_TRUE(found) << i;
        EXPECT_EQ(found->in_front, 30);
        const Pose<>& truth = pair.right_from_left;
        EXPECT_LE(largest_difference(found->right_from_left.rotation, truth.rotation), 2e-3);
        EXPECT_LE(largest_difference(found->right_from_left.translation, *normalized(truth.translation)),
                  2e-2);
        // Wrong pairs among them.
        Rays wrong = right;
        for (std::size_t k = 0; k < 6; ++k) wrong[5 * k] = place_of<Real>(0.1 * static_cast<double>(k), -0.2);
        std::vector<std::uint8_t> agrees(30, 7);
        const auto robust = fit_essential_ransac(span_of(left), span_of(wrong), Real::from_ratio(1, 500), {},
                                                 Span<std::uint8_t>(agrees.data(), 30));
        ASSERT_TRUE(robust) << i;
        EXPECT_GE(robust->agreeing, 24);
        for (std::size_t k = 0; k < 30; ++k) EXPECT_TRUE(k % 5 == 0 || agrees[k] == 1) << k;
    }
}

TEST(DecomposeEssential, TheTruePoseIsOneOfFour) {
    Random random(6);
    for (int i = 0; i < 20; ++i) {
        Pose<> pose;
        const auto part = [&] { return Real::from_int(random.between(-1000, 1000), -10); };
        const Real x = part();
        const Real y = part();
        const Real z = part();
        pose.rotation = rotation_about(Vector<3>(x, y, z));
        const Real u = part();
        const Real v = part();
        pose.translation = *normalized(Vector<3>(u, v, Real::one()));
        const Matrix<3, 3> e = essential_matrix(pose) * Real::from_int(i % 2 == 0 ? 7 : -3);
        const EssentialPoses<> four = *decompose_essential(e);
        int same = 0;
        for (int k = 0; k < 4; ++k) {
            const Pose<>& one = four.poses[k];
            EXPECT_LE(largest_difference(one.rotation * one.rotation.transposed(), Matrix<3, 3>::identity()),
                      1e-17);
            EXPECT_NEAR(plain_number(determinant(one.rotation)), 1, 1e-17);
            const Matrix<3, 3> again = essential_matrix(one);
            const Matrix<3, 3> unit = *nearest_essential(e);
            EXPECT_LE(std::min(largest_difference(again, unit), largest_difference(-again, unit)), 1e-17);
            same += largest_difference(one.rotation, pose.rotation) < 1e-16 &&
                            largest_difference(one.translation, pose.translation) < 1e-16
                        ? 1
                        : 0;
        }
        EXPECT_EQ(same, 1);
        EXPECT_EQ(four.poses[0].translation, -four.poses[1].translation);
        EXPECT_EQ(four.poses[2].rotation, four.poses[3].rotation);
    }
}

TEST(NearestEssential, HasSingularValuesOneOneZero) {
    Random random(7);
    Matrix<3, 3> a;
    for (int i = 0; i < 9; ++i) a(i / 3, i % 3) = Real::from_int(random.between(-1000, 1000));
    const Matrix<3, 3> e = *nearest_essential(a);
    // E E^T has the eigenvalues 1, 1, 0.
    const Matrix<3, 3> square = e * e.transposed();
    EXPECT_NEAR(plain_number(square(0, 0) + square(1, 1) + square(2, 2)), 2, 1e-17);
    EXPECT_LE(largest_difference(square * square, square), 1e-17);
    EXPECT_LE(largest_difference(*nearest_essential(e), e), 1e-17);
    EXPECT_EQ(nearest_essential(Matrix<3, 3>()).status(), Status::degenerate);
    Matrix<3, 3> one;
    one(0, 0) = Real::one();
    EXPECT_EQ(nearest_essential(one).status(), Status::degenerate);
    EXPECT_EQ(decompose_essential(one).status(), Status::degenerate);
    EXPECT_EQ(recover_pose(one, Span<const Vector<2>>(), Span<const Vector<2>>()).status(),
              Status::bad_argument);
}

TEST(RecoverPose, RefusesWhatFitsSeveralPoses) {
    // Places on the rays of infinity: with either baseline they are neither in front nor behind.
    Pose<> pose;
    pose.translation[0] = -Real::one();
    Rays far;
    for (int i = 0; i < 12; ++i) far.push_back(place_of<Real>(0.05 * i, 0.3 - 0.04 * i));
    const Matrix<3, 3> e = essential_matrix(pose);
    EXPECT_EQ(recover_pose(e, span_of(far), span_of(far)).status(), Status::undecided);
    // Half in front, half behind.
    Rays shifted = far;
    for (std::size_t i = 0; i < 12; ++i) shifted[i][0] += Real::from_ratio(i % 2 == 0 ? -1 : 1, 10);
    EXPECT_EQ(recover_pose(e, span_of(far), span_of(shifted)).status(), Status::undecided);
    for (std::size_t i = 0; i < 12; ++i) shifted[i][0] = far[i][0] - Real::from_ratio(1, 10);
    const RecoveredPose<> found = *recover_pose(e, span_of(far), span_of(shifted));
    EXPECT_EQ(found.in_front, 12);
    EXPECT_LE(largest_difference(found.right_from_left.translation, pose.translation), 1e-18);
    EXPECT_EQ(recover_pose(e, span_of(far), span_of(shifted).first(5)).status(), Status::size_mismatch);
    EXPECT_EQ(recover_pose(Matrix<3, 3>(), span_of(far), span_of(shifted)).status(), Status::degenerate);
}

TEST(FitEssential, RefusesWrongInput) {
    Rays left(8);
    Rays right(7);
    EXPECT_EQ(fit_essential(span_of(left), span_of(right)).status(), Status::size_mismatch);
    left.resize(7);
    EXPECT_EQ(fit_essential(span_of(left), span_of(right)).status(), Status::bad_argument);
    left.resize(8);
    right.resize(8);
    EXPECT_EQ(fit_essential(span_of(left), span_of(right)).status(), Status::degenerate);
    std::vector<std::uint8_t> agrees(8, 7);
    const Span<std::uint8_t> flags(agrees.data(), 8);
    const Real tolerance = Real::from_int(1, -9);
    const auto call = [&](const Real& most, Span<std::uint8_t> to) {
        return fit_essential_ransac(span_of(left), span_of(right), most, {}, to).status();
    };
    EXPECT_EQ(call(tolerance, flags), Status::degenerate);
    EXPECT_EQ(call(tolerance, flags.first(7)), Status::size_mismatch);
    EXPECT_EQ(call(Real(), flags), Status::bad_argument);
    right[2][1] = Real::from_int(17);
    EXPECT_EQ(call(tolerance, flags), Status::out_of_range);
    EXPECT_EQ(fit_essential(span_of(left), span_of(right)).status(), Status::out_of_range);
    EXPECT_EQ(agrees, std::vector<std::uint8_t>(8, 7));
}

TEST(RaysOf, AreThoseOfTheLens) {
    const Camera<> camera = camera_of<Real>(wide_rig.left);
    const LensInverse<> lens(camera);
    const Pixels pixels = {pixel_near(320.25, 240), pixel_near(0, 0), pixel_near(639, 479)};
    const Rays rays = rays_of_pixels(lens, pixels);
    for (std::size_t i = 0; i < 3; ++i) {
        const Vector<3> ray = *lens.ray(vector_of<Real>(pixels[i]));
        EXPECT_EQ(rays[i], (Vector<2>(ray[0], ray[1])));
    }
    Camera<> bent = camera;
    bent.k1 = Real::from_int(-3);
    Rays kept = rays;
    const Span<Vector<2>> out(kept.data(), 3);
    EXPECT_EQ(rays_of(LensInverse<>(bent), span_of(pixels), out), Status::out_of_range);
    EXPECT_EQ(rays_of(lens, span_of(pixels), out.first(2)), Status::size_mismatch);
    EXPECT_EQ(kept, rays);
}

}  // namespace
}  // namespace fovea::test
