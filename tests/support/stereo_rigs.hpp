// SPDX-License-Identifier: MIT
//
// Pairs of cameras for tests: those of the toolkit's files, and random ones.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/camera/camera.hpp>
#include <fovea/camera/pose.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/stereo/stereo_camera.hpp>
#include <support/scalars.hpp>

namespace fovea::test {

/// A double as a scalar, exact.
template <class Scalar>
Scalar number(double value) {
    if constexpr (std::is_same_v<Scalar, Real>)
        return real_of(value);
    else
        return static_cast<Scalar>(value);
}
template <class Scalar>
double plain_number(const Scalar& value) {
    return static_cast<double>(value_of(value));
}
template <class Scalar>
Vector<2, Scalar> place_of(double x, double y) {
    return Vector<2, Scalar>(number<Scalar>(x), number<Scalar>(y));
}
template <class Scalar>
Vector<3, Scalar> place_of(double x, double y, double z) {
    return Vector<3, Scalar>(number<Scalar>(x), number<Scalar>(y), number<Scalar>(z));
}
/// The largest difference of elements of a matrix of any scalar from numbers.
template <int Rows, int Columns, class Scalar, class Other>
double largest_difference(const Matrix<Rows, Columns, Scalar>& a, const Matrix<Rows, Columns, Other>& b) {
    double most = 0;
    for (int r = 0; r < Rows; ++r)
        for (int c = 0; c < Columns; ++c)
            most =
                std::fmax(most, static_cast<double>(std::fabs(static_cast<long double>(value_of(a(r, c))) -
                                                              static_cast<long double>(value_of(b(r, c))))));
    return most;
}

/// A camera of the toolkit's text files: focal lengths, principal point, d1 to d4; rotation and translation.
struct ToolkitCamera {
    double fx, cx, fy, cy;
    double lens[4];
    double rotation[9];
    double translation[3];
};
template <class Scalar>
Camera<Scalar> camera_of(const ToolkitCamera& file) {
    Camera<Scalar> camera;
    camera.fx = number<Scalar>(file.fx);
    camera.fy = number<Scalar>(file.fy);
    camera.cx = number<Scalar>(file.cx);
    camera.cy = number<Scalar>(file.cy);
    camera.k1 = number<Scalar>(file.lens[0]);
    camera.k2 = number<Scalar>(file.lens[1]);
    camera.p1 = number<Scalar>(file.lens[2]);
    camera.p2 = number<Scalar>(file.lens[3]);
    return camera;
}
template <class Scalar>
Pose<Scalar> pose_of(const ToolkitCamera& file) {
    Pose<Scalar> pose;
    for (int i = 0; i < 9; ++i) pose.rotation(i / 3, i % 3) = number<Scalar>(file.rotation[i]);
    for (int i = 0; i < 3; ++i) pose.translation[i] = number<Scalar>(file.translation[i]);
    return pose;
}

/// The stereo head with which the toolkit's scene of cups was taken, and its lenses of 4 mm.
struct ToolkitRig {
    ToolkitCamera left, right;
    double left_homography[9], right_homography[9];  ///< from rectified pixels to those without lens

    template <class Scalar>
    StereoCamera<Scalar> cameras() const {
        return {camera_of<Scalar>(left), camera_of<Scalar>(right),
                *right_from_left(pose_of<Scalar>(left), pose_of<Scalar>(right))};
    }
};
inline constexpr ToolkitRig scene_rig = {
    {864.7131347656,
     357.7168273926,
     861.7809448242,
     254.2458190918,
     {-0.2096963078, 0.3698274791, 0.0005397799, 0.0017906505},
     {-0.0130104953, -0.9998106360, -0.0144703137, 0.9995056987, -0.0125895832, -0.0288082622, 0.0286206324,
      -0.0148379710, 0.9994801879},
     {204.6762695312, -190.1337738037, 1704.9564208984}},
    {883.1638793945,
     328.6622924805,
     879.8566894531,
     258.8947143555,
     {-0.1880456656, 0.1204812601, -0.0020200859, 0.0008498499},
     {0.0050925752, -0.9996519685, -0.0258837715, 0.9996233582, 0.0057870420, -0.0268264823, 0.0269669369,
      -0.0257374067, 0.9993049502},
     {71.0735778809, -191.8886108398, 1707.9512939453}},
    {1.0575360080, -0.0189814540, 0.1622854322, 0.0201168831, 0.9803420603, -8.3816146851, -0.0000015814,
     0.0000011569, 1.0},
    {1.0886017311, -0.0012118846, -51.7980651860, 0.0037075854, 1.0046473190, -2.3676743513, 0.0000107483,
     -0.0000002512, 1.0}};
inline constexpr ToolkitRig wide_rig = {
    {532.4691162109,
     338.1228942871,
     530.2947998047,
     238.8942871094,
     {-0.4175221026, 0.1891709864, 0.0003914383, -0.0011864222},
     {-0.9760110974, -0.1374343038, 0.1688613445, -0.1323296279, 0.9903501868, 0.0411752313, -0.1728907526,
      0.0178421214, -0.9847794175},
     {-310.0098571777, 136.0222320557, 1672.5866699219}},
    {530.4125976562,
     317.4682006836,
     528.4988403320,
     227.5575103760,
     {-0.4129818976, 0.1751222312, 0.0006295592, -0.0009067627},
     {-0.9816629291, -0.1108721346, 0.1550652385, -0.1027268991, 0.9929215908, 0.0596145466, -0.1605772227,
      0.0425920188, -0.9861038923},
     {-364.6946105957, 101.5997467041, 1683.8571777344}},
    {1.0389637757, -0.0285015049, 0.0, 0.0375740921, 0.9690506547, 13.5405960083, 0.0000284847, 0.0, 1.0},
    {1.0185510749, 0.0112792542, -12.5248060235, 0.0013698049, 0.9732389150, -0.8691467057, -0.0000129721,
     0.0000457240, 1.0}};

/// A random pair for pictures of 640 x 480, and places that both see. All of it exact in any scalar.
class RandomRig {
public:
    enum class Kind { side_by_side, one_above };

    explicit RandomRig(Random& random, Kind kind = Kind::side_by_side, bool with_lens = true) {
        const auto part = [&](double most) { return most * random.between(-4096, 4096) / 4096; };
        for (int i = 0; i < 2; ++i) {
            double* camera = cameras_[i];
            camera[0] = 600 + part(150);
            camera[1] = camera[0] + part(4);
            camera[2] = 319.5 + part(20);
            camera[3] = 239.5 + part(20);
            const double lens[4] = {part(0.25), part(0.125), part(0.001), part(0.001)};
            for (int k = 0; k < 4; ++k) camera[4 + k] = with_lens ? lens[k] : 0;
        }
        for (double& turn : axis_) turn = part(0.125);
        const double along = 100 + part(40);
        const double across = part(20);
        const double forward = part(20);
        const bool x = kind == Kind::side_by_side;
        translation_[0] = x ? -along : across;
        translation_[1] = x ? across : -along;
        translation_[2] = forward;
    }

    template <class Scalar>
    StereoCamera<Scalar> cameras() const {
        StereoCamera<Scalar> pair;
        Camera<Scalar>* both[2] = {&pair.left, &pair.right};
        for (int i = 0; i < 2; ++i) {
            Camera<Scalar>& camera = *both[i];
            Scalar* fields[8] = {&camera.fx, &camera.fy, &camera.cx, &camera.cy,
                                 &camera.k1, &camera.k2, &camera.p1, &camera.p2};
            for (int k = 0; k < 8; ++k) *fields[k] = number<Scalar>(cameras_[i][k]);
        }
        pair.right_from_left.rotation = rotation_about(place_of<Scalar>(axis_[0], axis_[1], axis_[2]));
        pair.right_from_left.translation =
            place_of<Scalar>(translation_[0], translation_[1], translation_[2]);
        return pair;
    }

private:
    double cameras_[2][8];
    double axis_[3];
    double translation_[3];
};

/// Places in front of a pair and the pixels that see them, rounded to 1/256 px.
struct SeenPlaces {
    std::vector<Vector<3, double>> places;
    std::vector<SubPixelPoint> left, right;

    Span<const SubPixelPoint> left_span() const {
        return {left.data(), static_cast<std::ptrdiff_t>(left.size())};
    }
    Span<const SubPixelPoint> right_span() const {
        return {right.data(), static_cast<std::ptrdiff_t>(right.size())};
    }
};

inline SubPixelPoint pixel_near(double x, double y) {
    return {SubPixel::from_raw(static_cast<std::int32_t>(std::lround(256 * x))),
            SubPixel::from_raw(static_cast<std::int32_t>(std::lround(256 * y)))};
}

/// A number that is nearly normal, with deviation 1: the sum of twelve.
inline double normal_number(Random& random) {
    double sum = 0;
    for (int i = 0; i < 12; ++i) sum += random.between(-32768, 32767) / 65536.0;
    return sum;
}

/// Places that both cameras see in 640 x 480, between two depths; on a plane if wanted.
inline SeenPlaces look_at(const StereoCamera<double>& cameras, Random& random, int count, double noise = 0,
                          bool plane = false, double near = 600, double far = 1600) {
    SeenPlaces seen;
    for (int tries = 0; tries < 100 * count && static_cast<int>(seen.places.size()) < count; ++tries) {
        const double x = random.between(-600, 600) / 1000.0;
        const double y = random.between(-500, 500) / 1000.0;
        const double part = random.between(0, 65536) / 65536.0;
        const double z = plane ? near / (1 - 0.4 * x - 0.3 * y) : near + (far - near) * part;
        const Vector<3, double> place(x * z, y * z, z);
        const Result<Vector<2, double>> left = project(cameras.left, place);
        const Result<Vector<2, double>> right = project(cameras.right, cameras.right_from_left, place);
        if (!left || !right) continue;
        bool inside = true;
        for (const Vector<2, double>& pixel : {*left, *right})
            inside &= pixel[0] >= 0 && pixel[0] <= 639 && pixel[1] >= 0 && pixel[1] <= 479;
        if (!inside) continue;
        double off[4];
        for (double& one : off) one = noise * normal_number(random);
        seen.places.push_back(place);
        seen.left.push_back(pixel_near((*left)[0] + off[0], (*left)[1] + off[1]));
        seen.right.push_back(pixel_near((*right)[0] + off[2], (*right)[1] + off[3]));
    }
    return seen;
}

}  // namespace fovea::test
