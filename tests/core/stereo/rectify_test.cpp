// SPDX-License-Identifier: MIT
//
// Rectification of cameras that are known, and of pictures whose cameras are not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <fovea/stereo/rectify.hpp>
#include <fovea/stereo/rectify_uncalibrated.hpp>
#include <fovea/stereo/triangulate.hpp>
#include <support/stereo_rigs.hpp>

namespace fovea::test {
namespace {

using Method = RectifyOptions::Method;
using Zoom = RectifyOptions::Zoom;
constexpr Size picture{640, 480};

RectifyOptions with(Zoom zoom, Method method = Method::bouguet) {
    RectifyOptions options;
    options.zoom = zoom;
    options.method = method;
    return options;
}
double plain(const Real& value) { return plain_number(value); }

/// Where a place in left camera coordinates is seen in the rectified pair.
struct RectifiedPixels {
    double left[2], right[2];
};
RectifiedPixels seen_in(const Rectification<>& found, const StereoCamera<>& pair, const Vector<3>& place) {
    const Vector<2> left = *project(found.camera, found.left * place);
    const Vector<2> right = *project(found.camera, found.right * pair.right_from_left(place));
    return {{plain(left[0]), plain(left[1])}, {plain(right[0]), plain(right[1])}};
}

void expect_rectified(const Rectification<>& found, const StereoCamera<>& pair, Random& random) {
    for (const Matrix<3, 3>& rotation : {found.left, found.right}) {
        ASSERT_LE(largest_difference(rotation * rotation.transposed(), Matrix<3, 3>::identity()), 1e-17);
        ASSERT_GT(plain(rotation(2, 2)), 0.8);
    }
    const int axis = found.axis == StereoAxis::x ? 0 : 1;
    const Triangulator<> eyes(found.cameras());
    for (int i = 0; i < 6; ++i) {
        const int x = random.between(-300, 300);
        const int y = random.between(-300, 300);
        const int z = random.between(800, 3000);
        const Vector<3> place = place_of<Real>(x, y, z);
        const RectifiedPixels seen = seen_in(found, pair, place);
        // The rotation of a random pair is square to 2^-60.
        ASSERT_NEAR(seen.left[1 - axis], seen.right[1 - axis], 1e-13);
        const double disparity = seen.left[axis] - seen.right[axis];
        ASSERT_GT(disparity * plain(found.baseline), 0);
        // Back by the disparity, by Q, and by the rays of the rectified pair.
        const Vector<3> turned = found.left * place;
        const Vector<2> at = place_of<Real>(seen.left[0], seen.left[1]);
        const Vector<3> again = *found.place(at, real_of(disparity));
        ASSERT_LE(largest_difference(again, turned), 1e-9);
        ASSERT_EQ(found.place(at, -real_of(disparity)).status(), Status::out_of_range);
        ASSERT_EQ(found.place(at, Real()).status(), Status::out_of_range);
        const Vector<4> whole =
            found.depth_matrix() * Vector<4>(at[0], at[1], real_of(disparity), Real::one());
        for (int k = 0; k < 3; ++k) ASSERT_NEAR(plain(whole[k] / whole[3]), plain(again[k]), 1e-12);
        if (plain(found.baseline) > 0) {
            ASSERT_NEAR(plain(*depth_of_disparity(found.camera.fx, found.baseline, real_of(disparity))),
                        plain(again[2]), 1e-12);
        }
        const RayMeeting<> meeting = *eyes.midpoint(at, place_of<Real>(seen.right[0], seen.right[1]));
        ASSERT_LE(largest_difference(meeting.place, turned), 1e-9);
    }
}

TEST(Rectify, RowsAgreeAndDepthComesBack) {
    Random random(1);
    for (int i = 0; i < 16; ++i) {
        const RandomRig rig(random, i % 2 == 0 ? RandomRig::Kind::side_by_side : RandomRig::Kind::one_above);
        const StereoCamera<> pair = rig.cameras<Real>();
        const Rectification<> found = *rectify(
            pair, picture, with(Zoom::focal_length, i / 2 % 2 == 0 ? Method::bouguet : Method::fusiello));
        EXPECT_EQ(found.axis, i % 2 == 0 ? StereoAxis::x : StereoAxis::y);
        EXPECT_NEAR(std::abs(plain(found.baseline)), plain(length_of(pair.right_from_left.translation)),
                    1e-15);
        expect_rectified(found, pair, random);
        // The left and the right camera exchanged: the baseline runs the other way.
        const Rectification<> back = *rectify(swapped(pair), picture);
        EXPECT_NEAR(plain(back.baseline), -plain(found.baseline), 1e-15);
        expect_rectified(back, swapped(pair), random);
    }
}

TEST(Rectify, IsTheSameInDouble) {
    Random random(8);
    for (int i = 0; i < 10; ++i) {
        // Without lens, whose inverse is nearer than double can be.
        const RandomRig rig(random, i % 2 == 0 ? RandomRig::Kind::side_by_side : RandomRig::Kind::one_above,
                            false);
        for (const Method method : {Method::bouguet, Method::fusiello})
            for (const Zoom zoom : {Zoom::focal_length, Zoom::valid, Zoom::all}) {
                const Rectification<> found = *rectify(rig.cameras<Real>(), picture, with(zoom, method));
                const Rectification<double> same =
                    *rectify(rig.cameras<double>(), picture, with(zoom, method));
                // The demand is 1e-12; double keeps 1e-15.
                EXPECT_LE(largest_difference(found.left, same.left), 1e-14);
                EXPECT_LE(largest_difference(found.right, same.right), 1e-14);
                EXPECT_NEAR(plain(found.camera.fx), same.camera.fx, 1e-10);
                EXPECT_NEAR(plain(found.camera.cx), same.camera.cx, 1e-10);
                EXPECT_NEAR(plain(found.camera.cy), same.camera.cy, 1e-10);
                EXPECT_NEAR(plain(found.baseline), same.baseline, 1e-12);
            }
    }
}

/// What cv::stereoRectify of OpenCV 4.6 says, with CALIB_ZERO_DISPARITY.
struct PeerRectification {
    double left[9], right[9];
    double focal_length, cx, cy, baseline;
    double all;  ///< the focal length with alpha 1
};

TEST(Rectify, AgreesWithOpenCv) {
    const struct {
        const ToolkitRig& rig;
        PeerRectification peer;
    } cases[] = {
        {scene_rig,
         {{9.9951088844846703e-01, 2.6844522395018680e-02, -1.6042303149464646e-02, -2.6831601761805535e-02,
           9.9963944723037246e-01, 1.0201410938096942e-03, 1.6063904253071755e-02, -5.8920144156790911e-04,
           9.9987079356375319e-01},
          {9.999512236275552e-01, 8.418129160697266e-03, -5.165797826952798e-03, -8.422283762767291e-03,
           9.999642253640794e-01, -7.830250547416735e-04, 5.159021416369423e-03, 8.264946767796680e-04,
           9.999863506091344e-01},
          870.81881713865,
          355.92375564575195,
          256.42913818359375,
          97086.58405526842 / 870.81881713865,
          782.6072484071084}},
        {wide_rig,
         {{0.9971234096039449, 0.06813227301906193, -0.03320992913361423, -0.06852575073156271,
           0.9975902777051302, -0.0108563030022597, 0.03239023782684231, 0.01310080919092966,
           0.9993894342507648},
          {0.9979659785440844, 0.04280497717854335, -0.04724023282428407, -0.0422353332188834,
           0.9990232165394355, 0.01299189913330762, 0.04775020729209528, -0.01097026635704609,
           0.9987990643565989},
          529.39682006835,
          363.4880256652832,
          229.41166305541992,
          44338.34819371428 / 529.39682006835,
          357.2917658696697}},
    };
    for (const auto& one : cases) {
        const StereoCamera<> pair = one.rig.cameras<Real>();
        const Rectification<> found = *rectify(pair, picture);
        Matrix<3, 3, double> left;
        Matrix<3, 3, double> right;
        for (int i = 0; i < 9; ++i) {
            left(i / 3, i % 3) = one.peer.left[i];
            right(i / 3, i % 3) = one.peer.right[i];
        }
        EXPECT_LE(largest_difference(found.left, left), 1e-12);
        EXPECT_LE(largest_difference(found.right, right), 1e-12);
        EXPECT_NEAR(plain(found.camera.fx), one.peer.focal_length, 1e-11);
        EXPECT_NEAR(plain(found.baseline), one.peer.baseline, 1e-11);
        // The peer's corners are floats, and its inverse of the lens stops after five steps: 0.01 px for the
        // corners of the wide lenses, 1e-5 for those of the others.
        const double corners = &one.rig == &scene_rig ? 1e-4 : 0.02;
        EXPECT_NEAR(plain(found.camera.cx), one.peer.cx, corners);
        EXPECT_NEAR(plain(found.camera.cy), one.peer.cy, corners);
        const Rectification<> all = *rectify(pair, picture, with(Zoom::all));
        EXPECT_NEAR(plain(all.camera.fx), one.peer.all, 2 * corners);
    }
}

TEST(Rectify, TurnedByAQuarterItIsTheSame) {
    // The same pair with both cameras turned by 90 degrees about their axes: x and y exchange.
    const StereoCamera<> pair = scene_rig.cameras<Real>();
    StereoCamera<> turned = pair;
    const Real zero;
    const Matrix<3, 3> quarter(zero, -Real::one(), zero, Real::one(), zero, zero, zero, zero, Real::one());
    for (Camera<>* camera : {&turned.left, &turned.right}) {
        std::swap(camera->fx, camera->fy);
        std::swap(camera->cx, camera->cy);
        camera->cx = Real::from_int(479) - camera->cx;
        const Real p1 = camera->p1;
        camera->p1 = camera->p2;
        camera->p2 = -p1;
    }
    turned.right_from_left.rotation = quarter * pair.right_from_left.rotation * quarter.transposed();
    turned.right_from_left.translation = quarter * pair.right_from_left.translation;
    for (const Zoom zoom : {Zoom::focal_length, Zoom::valid, Zoom::all}) {
        const Rectification<> lying = *rectify(pair, picture, with(zoom));
        const Rectification<> standing = *rectify(turned, Size{480, 640}, with(zoom));
        EXPECT_EQ(standing.axis, StereoAxis::y);
        EXPECT_LE(largest_difference(standing.left, quarter * lying.left * quarter.transposed()), 1e-17);
        EXPECT_LE(largest_difference(standing.right, quarter * lying.right * quarter.transposed()), 1e-17);
        EXPECT_NEAR(plain(standing.baseline), plain(lying.baseline), 1e-15);
        EXPECT_NEAR(plain(standing.camera.fx), plain(lying.camera.fx), 1e-12);
        EXPECT_NEAR(plain(standing.camera.cy), plain(lying.camera.cx), 1e-12);
        EXPECT_NEAR(plain(standing.camera.cx), 479 - plain(lying.camera.cy), 1e-12);
    }
}

/// The pixel of a camera from which a pixel of its rectified picture comes.
Vector<2, double> source_of(const Camera<>& camera, const Matrix<3, 3>& rotation,
                            const Rectification<>& found, double u, double v) {
    const Vector<2> at = point_of(found.camera, place_of<Real>(u, v));
    const Vector<2> pixel = *project(camera, rotation.transposed() * Vector<3>(at[0], at[1], Real::one()));
    return Vector<2, double>(plain(pixel[0]), plain(pixel[1]));
}

TEST(Rectify, ZoomsSoThatAllIsValidOrAllIsKept) {
    for (const ToolkitRig* rig : {&scene_rig, &wide_rig}) {
        const StereoCamera<> pair = rig->cameras<Real>();
        const LensInverse<> left_lens(pair.left);
        const LensInverse<> right_lens(pair.right);
        for (const Size size : {picture, Size{320, 200}, Size{900, 480}}) {
            RectifyOptions options = with(Zoom::valid);
            options.new_size = size;
            const Rectification<> valid = *rectify(pair, picture, options);
            options.zoom = Zoom::all;
            const Rectification<> all = *rectify(pair, picture, options);
            EXPECT_EQ(valid.size, size);
            EXPECT_LT(plain(all.camera.fx), plain(valid.camera.fx));
            // Of the new picture's border, nothing is outside by more than 1/20 px, and something is at it.
            double outside = -1e9;
            for (const bool left : {true, false})
                for (int i = 0; i < 4 * 40; ++i) {
                    const double part = i % 40 / 40.0;
                    const double u = (size.width - 1) * (i / 40 == 0   ? part
                                                         : i / 40 == 2 ? 1 - part
                                                                       : i / 40 == 1);
                    const double v = (size.height - 1) * (i / 40 == 1   ? part
                                                          : i / 40 == 3 ? 1 - part
                                                                        : i / 40 == 2);
                    const Vector<2, double> from = source_of(left ? pair.left : pair.right,
                                                             left ? valid.left : valid.right, valid, u, v);
                    outside = std::max({outside, -from[0], -from[1], from[0] - 639, from[1] - 479});
                }
            EXPECT_LE(outside, 0.05);
            EXPECT_GE(outside, -1.5);
            // Of the old pictures' corners, which are farthest, none is outside of the new one.
            double beyond = -1e9;
            for (const bool left : {true, false})
                for (int i = 0; i < 4; ++i) {
                    const LensInverse<>& lens = left ? left_lens : right_lens;
                    const Vector<3> ray = *lens.ray(place_of<Real>(i % 2 * 639, i / 2 * 479));
                    const Vector<2> to = *project(all.camera, (left ? all.left : all.right) * ray);
                    beyond = std::max({beyond, -plain(to[0]), -plain(to[1]), plain(to[0]) - (size.width - 1),
                                       plain(to[1]) - (size.height - 1)});
                }
            EXPECT_LE(beyond, 1e-12);
            EXPECT_GE(beyond, -1e-12);
        }
    }
}

TEST(Rectify, LeavesOutWhatALensCannotSee) {
    // A lens whose model folds back before the corners: the field ends at a radius of 1/3.
    StereoCamera<> pair = scene_rig.cameras<Real>();
    for (Camera<>* camera : {&pair.left, &pair.right}) {
        camera->k1 = Real::from_int(-3);
        camera->k2 = Real();
    }
    EXPECT_TRUE(rectify(pair, picture));
    const Rectification<> valid = *rectify(pair, picture, with(Zoom::valid));
    double farthest = 0;
    for (int i = 0; i < 8; ++i) {
        const bool left = i < 4;
        const LensInverse<> lens(left ? pair.left : pair.right);
        const Vector<2> at = point_of(valid.camera, place_of<Real>(i % 2 * 639, i / 2 % 2 * 479));
        const Matrix<3, 3>& rotation = left ? valid.left : valid.right;
        const Vector<3> ray = rotation.transposed() * Vector<3>(at[0], at[1], Real::one());
        const double radius = std::hypot(plain(ray[0] / ray[2]), plain(ray[1] / ray[2]));
        EXPECT_LE(radius, plain(lens.radius()));
        farthest = std::max(farthest, radius / plain(lens.radius()));
    }
    // Its border is found to 1/32 of a picture's half diagonal, which is where a lens bends most.
    EXPECT_GE(farthest, 0.8) << farthest;
}

TEST(RectifyingHomography, OfTheToolkitsFileKeepsTheRowsOfTheCameras) {
    // Whatever is in one row of the rectified pictures fits the fundamental matrix of the cameras. The file's
    // homographies are of another method and view, and keep rows to 1 px for the disparities of the scene, 0
    // to 130 px, as the toolkit's matches show; for others they are off by up to 8 px.
    for (const ToolkitRig* rig : {&scene_rig, &wide_rig}) {
        const StereoCamera<> pair = rig->cameras<Real>();
        const Matrix<3, 3> f = *fundamental_matrix(pair);
        const Rectification<> found = *rectify(pair, picture);
        const Matrix<3, 3> our_left = *rectifying_homography(pair.left, found.left, found.camera);
        const Matrix<3, 3> our_right = *rectifying_homography(pair.right, found.right, found.camera);
        Matrix<3, 3> file_left;
        Matrix<3, 3> file_right;
        for (int i = 0; i < 9; ++i) {
            file_left(i / 3, i % 3) = real_of(rig->left_homography[i]);
            file_right(i / 3, i % 3) = real_of(rig->right_homography[i]);
        }
        double file = 0;
        double ours = 0;
        for (int i = 0; i < 48; ++i) {
            const int v = i / 8 * 90;
            const int u = 140 + i % 8 * 70;
            const Vector<3> left = place_of<Real>(u, v, 1);
            const auto off = [&](const Matrix<3, 3>& a, const Matrix<3, 3>& b, int disparity) {
                const Vector<3> x = a * left;
                const Vector<3> y = b * place_of<Real>(u - disparity, v, 1);
                return plain(*sampson_distance(f, Vector<2>(x[0] / x[2], x[1] / x[2]),
                                               Vector<2>(y[0] / y[2], y[1] / y[2])));
            };
            for (const int disparity : {0, 65, 130})
                file = std::max(file, off(file_left, file_right, disparity));
            for (const int disparity : {-639, 130, 639})
                ours = std::max(ours, off(our_left, our_right, disparity));
        }
        if (rig == &scene_rig) {
            EXPECT_LE(file, 1);
        }
        // Sums of squares of pixels' coordinates cancel to this.
        EXPECT_LE(ours, 1e-13);
        EXPECT_EQ(rectifying_homography(pair.left, found.left, Camera<>{Real(), Real()}).status(),
                  Status::bad_argument);
    }
}

TEST(Rectify, ProjectionMatricesOfTheRectifiedPair) {
    const StereoCamera<> pair = scene_rig.cameras<Real>();
    const Rectification<> found = *rectify(pair, picture);
    const StereoCamera<> rectified = found.cameras();
    const Matrix<3, 4> right = projection_matrix(rectified.right, rectified.right_from_left);
    // K [I | (-b, 0, 0)], which is the peer's P2.
    EXPECT_NEAR(plain(right(0, 3)), -97086.58405526842, 1e-8);
    EXPECT_EQ(right(1, 3), Real());
    EXPECT_EQ(right(0, 0), found.camera.fx);
    EXPECT_EQ(right(0, 1), Real());
    EXPECT_EQ(rectified.left.cx, rectified.right.cx);
}

TEST(Rectify, RefusesWhatCannotBeRectified) {
    const StereoCamera<> pair = scene_rig.cameras<Real>();
    EXPECT_EQ(rectify(pair, Size{0, 480}).status(), Status::empty_image);
    EXPECT_EQ(rectify(pair, Size{640, 40000}).status(), Status::image_too_large);
    RectifyOptions options;
    options.new_size = {40000, 480};
    EXPECT_EQ(rectify(pair, picture, options).status(), Status::image_too_large);
    for (const Method method : {Method::bouguet, Method::fusiello}) {
        const auto status = [&](const StereoCamera<>& cameras, Zoom zoom = Zoom::focal_length) {
            return rectify(cameras, picture, with(zoom, method)).status();
        };
        StereoCamera<> other = pair;
        other.left.fx = Real();
        EXPECT_EQ(status(other), Status::bad_argument);
        other = pair;
        other.right.fy = -other.right.fy;
        EXPECT_EQ(status(other), Status::bad_argument);
        other = pair;
        other.right_from_left.rotation(1, 1) = Real::from_ratio(9, 10);
        EXPECT_EQ(status(other), Status::bad_argument);
        other.right_from_left.rotation = Matrix<3, 3>();
        EXPECT_EQ(status(other), Status::bad_argument);
        other = pair;
        other.right_from_left.translation = Vector<3>();
        EXPECT_EQ(status(other), Status::degenerate);
        other.right_from_left.translation = place_of<Real>(10, 10, -100);
        EXPECT_EQ(status(other), Status::degenerate);
        // Back to back.
        other = pair;
        const Real one = Real::one();
        other.right_from_left.rotation =
            Matrix<3, 3>(-one, Real(), Real(), Real(), one, Real(), Real(), Real(), -one);
        EXPECT_EQ(status(other), method == Method::bouguet ? Status::degenerate : Status::out_of_range);
        // Cameras that look away from each other, by 25 degrees each: what is between them neither sees.
        other = pair;
        other.right_from_left.rotation = rotation_about(place_of<Real>(0, -0.9326, 0));
        other.right_from_left.translation =
            rotation_about(place_of<Real>(0, -0.4434, 0)) * pair.right_from_left.translation;
        EXPECT_EQ(status(other), Status::ok);
        EXPECT_EQ(status(other, Zoom::valid), Status::out_of_range);
        // One by 40 degrees: straight ahead is beside the picture.
        other = pair;
        other.right_from_left.rotation = rotation_about(place_of<Real>(0, -0.728, 0));
        EXPECT_EQ(status(other, Zoom::all), Status::out_of_range);
    }
}

// ---- Without cameras -----------------------------------------------------------------------

Vector<2, double> mapped(const Matrix<3, 3>& h, SubPixelPoint pixel) {
    const Vector<2> at = vector_of<Real>(pixel);
    const Vector<3> image = h * Vector<3>(at[0], at[1], Real::one());
    return Vector<2, double>(plain(image[0] / image[2]), plain(image[1] / image[2]));
}

TEST(RectifyUncalibrated, RowsAgreeForAllThatFitsTheMatrix) {
    Random random(2);
    for (int i = 0; i < 12; ++i) {
        const RandomRig rig(random, i % 2 == 0 ? RandomRig::Kind::side_by_side : RandomRig::Kind::one_above,
                            false);
        const SeenPlaces seen = look_at(rig.cameras<double>(), random, 30);
        const Matrix<3, 3> f = *fundamental_matrix(rig.cameras<Real>());
        const RectifyingHomographies<> found =
            *rectify_uncalibrated(f, seen.left_span(), seen.right_span(), picture);
        EXPECT_EQ(found.axis, i % 2 == 0 ? StereoAxis::x : StereoAxis::y);
        const int axis = i % 2 == 0 ? 0 : 1;
        double mean = 0;
        for (std::size_t k = 0; k < 30; ++k) {
            const Vector<2, double> left = mapped(found.left, seen.left[k]);
            const Vector<2, double> right = mapped(found.right, seen.right[k]);
            // Pixels are rounded to 1/256.
            ASSERT_NEAR(left[1 - axis], right[1 - axis], 0.02);
            mean += left[axis] - right[axis];
        }
        EXPECT_NEAR(mean / 30, 0, 1);
        // Pixels that fit exactly agree exactly: where the left one's line crosses a column, or a row.
        for (std::size_t k = 0; k < 10; ++k) {
            const Vector<2> left = vector_of<Real>(seen.left[k]);
            const Vector<3> line = *epipolar_line(f, left);
            Vector<3> right(Real::from_int(100 + 40 * static_cast<int>(k)), Real(), Real::one());
            right[1] = -(line[0] * right[0] + line[2]) / line[1];
            if (axis == 1) {
                right[1] = right[0];
                right[0] = -(line[1] * right[1] + line[2]) / line[0];
            }
            const Vector<3> a = found.left * Vector<3>(left[0], left[1], Real::one());
            const Vector<3> b = found.right * right;
            ASSERT_NEAR(plain(a[1 - axis] / a[2]), plain(b[1 - axis] / b[2]), 1e-12);
        }
        // The middle of the right picture stays, and nothing is mirrored.
        const Vector<3> middle = found.right * place_of<Real>(319.5, 239.5, 1);
        EXPECT_NEAR(plain(middle[0] / middle[2]), 319.5, 1e-12);
        EXPECT_NEAR(plain(middle[1] / middle[2]), 239.5, 1e-12);
        EXPECT_GT(plain(determinant(found.left)), 0);
        EXPECT_GT(plain(determinant(found.right)), 0);
    }
}

TEST(RectifyUncalibrated, LeavesWhatIsRectified) {
    // Side by side with nothing between them but a shift: homographies are shifts.
    Matrix<3, 3> f;
    f(1, 2) = Real::one();
    f(2, 1) = -Real::one();
    Random random(3);
    std::vector<SubPixelPoint> left;
    std::vector<SubPixelPoint> right;
    for (int i = 0; i < 10; ++i) {
        const int x = random.between(50, 600);
        const int y = random.between(0, 479);
        left.push_back(pixel_near(x, y));
        right.push_back(pixel_near(x - 30, y));
    }
    const RectifyingHomographies<> found = *rectify_uncalibrated(
        f, Span<const SubPixelPoint>(left.data(), 10), Span<const SubPixelPoint>(right.data(), 10), picture);
    EXPECT_LE(largest_difference(found.right, Matrix<3, 3>::identity()), 1e-17);
    Matrix<3, 3> shift = Matrix<3, 3>::identity();
    shift(0, 2) = Real::from_int(-30);
    EXPECT_LE(largest_difference(found.left, shift), 1e-12);
}

TEST(RectifyUncalibrated, RefusesWhatCannotBeRectified) {
    Random random(4);
    const RandomRig rig(random, RandomRig::Kind::side_by_side, false);
    const SeenPlaces seen = look_at(rig.cameras<double>(), random, 10);
    const Matrix<3, 3> f = *fundamental_matrix(rig.cameras<Real>());
    const Span<const SubPixelPoint> left = seen.left_span();
    const Span<const SubPixelPoint> right = seen.right_span();
    EXPECT_EQ(rectify_uncalibrated(f, left, right, Size{640, 0}).status(), Status::empty_image);
    EXPECT_EQ(rectify_uncalibrated(f, left, right.first(9), picture).status(), Status::size_mismatch);
    EXPECT_EQ(rectify_uncalibrated(f, left, right, Size{640, 40000}).status(), Status::image_too_large);
    EXPECT_EQ(rectify_uncalibrated(f, left.first(2), right.first(2), picture).status(), Status::bad_argument);
    EXPECT_EQ(rectify_uncalibrated(Matrix<3, 3>(), left, right, picture).status(), Status::degenerate);
    std::vector<SubPixelPoint> other = seen.left;
    other[4].x = SubPixel::from_raw(2147483647);
    EXPECT_EQ(rectify_uncalibrated(f, Span<const SubPixelPoint>(other.data(), 10), right, picture).status(),
              Status::out_of_range);
    for (std::size_t i = 0; i < 10; ++i)
        other[i] = pixel_near(20.3 * static_cast<double>(i), 100 + 10.7 * static_cast<double>(i));
    EXPECT_EQ(rectify_uncalibrated(f, Span<const SubPixelPoint>(other.data(), 10), right, picture).status(),
              Status::degenerate);
    // The epipole is in the picture, though no pair is beyond it.
    StereoCamera<> forward;
    forward.left.fx = forward.left.fy = Real::from_int(600);
    forward.left.cx = Real::from_int(320);
    forward.left.cy = Real::from_int(240);
    forward.right = forward.left;
    forward.right_from_left.translation = place_of<Real>(28, 0, 60);
    std::vector<SubPixelPoint> near_left;
    std::vector<SubPixelPoint> near_right;
    for (int i = 0; i < 10; ++i) {
        const Vector<3> place = place_of<Real>(-400 + 30 * i, -200 + 40 * (i * 7 % 10), 1200 + 50 * (i % 3));
        const Vector<2> a = *project(forward.left, place);
        const Vector<2> b = *project(forward.right, forward.right_from_left, place);
        near_left.push_back(pixel_near(plain(a[0]), plain(a[1])));
        near_right.push_back(pixel_near(plain(b[0]), plain(b[1])));
    }
    const auto beside = [&](Size size) {
        return rectify_uncalibrated(*fundamental_matrix(forward),
                                    Span<const SubPixelPoint>(near_left.data(), 10),
                                    Span<const SubPixelPoint>(near_right.data(), 10), size)
            .status();
    };
    EXPECT_EQ(beside(picture), Status::degenerate);
    EXPECT_EQ(beside(Size{400, 480}), Status::ok);
    // Forward: the epipole is among the pairs, or in the very middle.
    StereoCamera<> pair = rig.cameras<Real>();
    pair.right_from_left.translation = place_of<Real>(1, 2, -100);
    EXPECT_EQ(rectify_uncalibrated(*fundamental_matrix(pair), left, right, picture).status(),
              Status::degenerate);
    pair.right_from_left.translation = place_of<Real>(0, 0, -100);
    for (Camera<>* camera : {&pair.left, &pair.right}) {
        camera->cx = Real::from_int(639, -1);
        camera->cy = Real::from_int(479, -1);
    }
    EXPECT_EQ(rectify_uncalibrated(*fundamental_matrix(pair), left, right, picture).status(),
              Status::degenerate);
}

}  // namespace
}  // namespace fovea::test
