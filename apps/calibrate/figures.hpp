// SPDX-License-Identifier: MIT
//
// Figures of calibrations as text: values with their deviations, angles.
#pragma once

#include <cstdint>
#include <string>

#include <fovea/camera/lens_inverse.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/number/real.hpp>
#include <fovea/number/trigonometry.hpp>

#include <camera/camera_file.hpp>
#include <common/text.hpp>

namespace fovea::apps {

inline Decimal decimal_of(const Real& value) { return {(value * Real::from_int(1000000)).rounded(0)}; }
inline std::string number(const Real& value, int places) { return number(decimal_of(value), places); }

/// Places behind the point at which a deviation has two digits; 0 to 6.
inline int places_for(const Real& deviation) {
    int places = 0;
    for (Real scaled = deviation; places < 6 && scaled < Real::from_int(10); ++places)
        scaled *= Real::from_int(10);
    return places;
}
/// "536.07 +- 0.85"; without a deviation, "536.07 held".
inline std::string with_deviation(const Real& value, const Real& deviation) {
    if (deviation.zero()) return number(value, 3) + " held";
    const int places = places_for(deviation);
    return number(value, places) + " +- " + number(deviation, places);
}

/// A number for JSON.
inline std::string json_number(const Real& value) { return real_text(value, 17); }
/// A number that is known to few digits.
inline std::string json_rough(const Real& value) { return real_text(value, 6); }

/// An angle from 0 to half a turn, which is -1/2 of one too.
inline Decimal degrees_of(FineAngle angle) {
    const std::int64_t millionths = angle.microdegrees();
    return {millionths < 0 ? -millionths : millionths};
}
/// The angle between two directions, 0 to 180 degrees.
inline Decimal degrees_between(const Vector<3>& a, const Vector<3>& b) {
    const Real length = length_of(a) * length_of(b);
    if (length.zero()) return {};
    const Real along = dot(a, b) / length;
    const Real across = length_of(cross(a, b)) / length;
    return degrees_of(angle_of(along.rounded(60), across.rounded(60)));
}
/// The angle by which a rotation turns.
inline Decimal degrees_of(const Matrix<3, 3>& r) {
    const Vector<3> axis(r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1));
    const Real twice_cosine = r(0, 0) + r(1, 1) + r(2, 2) - Real::one();
    return degrees_of(angle_of(twice_cosine.rounded(59), length_of(axis).rounded(59)));
}

/// What a camera sees, in degrees: along the row and the column through the principal point, and from corner
/// to corner.
struct FieldOfView {
    Decimal across, down, diagonal;
};
inline FieldOfView field_of_view(const Camera<>& camera, Size picture) {
    const LensInverse<> lens(camera);
    const auto ray = [&](Vector<2> pixel) {
        const Result<Vector<3>> seen = lens.ray(pixel);
        if (seen) return *seen;
        // Where the lens has no inverse, the pinhole.
        const Vector<2> point = point_of(camera, pixel);
        return Vector<3>(point[0], point[1], Real::one());
    };
    const Real left = Real::from_ratio(-1, 2);
    const Real right = Real::from_int(2 * picture.width - 1, -1);
    const Real bottom = Real::from_int(2 * picture.height - 1, -1);
    const auto between = [&](Real x, Real y, Real u, Real v) {
        return degrees_between(ray(Vector<2>(x, y)), ray(Vector<2>(u, v)));
    };
    return {between(left, camera.cy, right, camera.cy), between(camera.cx, left, camera.cx, bottom),
            between(left, left, right, bottom)};
}

}  // namespace fovea::apps
