// SPDX-License-Identifier: MIT
//
// Where a pixel of one camera can be seen by the other: on a line. Book sec. 2.10.2.
#pragma once

#include <cstdint>

#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/number/scalar.hpp>
#include <fovea/stereo/stereo_camera.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// E = [t]x R, with r'^T E r = 0 for rays r of the left and r' of the right camera to one place.
///
/// Source  book sec. 2.10.2; Hartley and Zisserman, "Multiple View Geometry", sec. 9.6
template <class Scalar>
constexpr Matrix<3, 3, Scalar> essential_matrix(const Pose<Scalar>& right_from_left) {
    return cross_matrix(right_from_left.translation) * right_from_left.rotation;
}

/// F = Kr^-T E Kl^-1, with x'^T F x = 0 for pixels x of the left and x' of the right camera that see one
/// place, as far as the lens is none. The squares of its elements sum up to 1. That of swapped() cameras is
/// the transpose, but for the sign.
///
/// Errors  bad_argument for a camera without focal lengths; degenerate for cameras at one place
/// Source  book sec. 2.10.2
template <class Scalar>
constexpr Result<Matrix<3, 3, Scalar>> fundamental_matrix(const StereoCamera<Scalar>& cameras);

/// A pixel as a vector.
template <class Scalar = Real>
constexpr Vector<2, Scalar> vector_of(SubPixelPoint pixel) {
    return Vector<2, Scalar>(scalar_of<Scalar>(pixel.x.raw(), -SubPixel::fraction_bits),
                             scalar_of<Scalar>(pixel.y.raw(), -SubPixel::fraction_bits));
}

/// The line (a, b, c) of the right image, a u + b v + c = 0 with a^2 + b^2 = 1, on which the place that is
/// seen at a pixel of the left image is seen. With F transposed it is the line of the left image of a pixel
/// of the right one. Lines of every direction are told alike.
///
/// Errors  degenerate for the epipole, the pixel at which the other camera is seen: no more than 2^-50 of
///         what is summed up is left
/// Source  book sec. 2.10.2. The toolkit's v = m u + c has no vertical lines
template <class Scalar>
constexpr Result<Vector<3, Scalar>> epipolar_line(const Matrix<3, 3, Scalar>& fundamental,
                                                  const Vector<2, Scalar>& pixel);

/// How far a pixel is from a line of epipolar_line(), in pixels; negative on one side.
template <class Scalar>
constexpr Scalar distance_from_line(const Vector<3, Scalar>& line, const Vector<2, Scalar>& pixel) {
    return line[0] * pixel[0] + line[1] * pixel[1] + line[2];
}

/// How far two pixels are from fitting a fundamental matrix, in pixels: about the root of the least sum of
/// squares by which both would have to be moved.
///
/// Errors  degenerate where both are epipoles
/// Source  Sampson's approximation; Hartley and Zisserman, eq. 11.9
template <class Scalar>
constexpr Result<Scalar> sampson_distance(const Matrix<3, 3, Scalar>& fundamental,
                                          const Vector<2, Scalar>& left, const Vector<2, Scalar>& right);

/// Where a line begins and ends.
struct LineEnds {
    SubPixelPoint from;
    SubPixelPoint to;
};

/// The part of a line that is in a rectangle, from the middle of its outermost pixels to that of the ones
/// across.
///
/// Rounding  ends to the nearest, ties away from 0
/// Errors    empty_image; out_of_range for a rectangle beyond 2^22 px; degenerate for a = b = 0; not_found if
///           the line passes by
/// Source    Liang and Barsky, "A New Concept and Method for Line Clipping", ACM Transactions on Graphics 3(1),
///           1984, from the foot of the perpendicular on the middle
template <class Scalar>
constexpr Result<LineEnds> clip_line(const Vector<3, Scalar>& line, Rectangle area);

/// Where the cameras see each other: F left = 0 and F^T right = 0. Both are homogeneous and of length 1: the
/// pixel is (x / z, y / z), and infinitely far away where z is 0.
template <class Scalar = Real>
struct Epipoles {
    Vector<3, Scalar> left;
    Vector<3, Scalar> right;
};

/// Rounding  each is the cross product of two rows or columns, of those the longest
/// Errors    degenerate for a matrix whose rank is less than 2: no more than 2^-40 of its length is left
template <class Scalar>
constexpr Result<Epipoles<Scalar>> epipoles(const Matrix<3, 3, Scalar>& fundamental);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// The matrix with a sum of squares of 1.
template <class Scalar>
constexpr Result<Matrix<3, 3, Scalar>> of_length_one(const Matrix<3, 3, Scalar>& a) {
    Scalar square = scalar_of<Scalar>(0);
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) square = square + a(r, c) * a(r, c);
    if (!(scalar_of<Scalar>(0) < square)) return Status::degenerate;
    return a * (scalar_of<Scalar>(1) / square_root(square));
}

/// F of an E whose rays have been replaced by pixels.
template <class Scalar>
constexpr Matrix<3, 3, Scalar> in_pixels(const Matrix<3, 3, Scalar>& essential, const Camera<Scalar>& left,
                                         const Camera<Scalar>& right) {
    Matrix<3, 3, Scalar> f = essential;
    for (int r = 0; r < 3; ++r) {
        f(r, 0) = f(r, 0) / left.fx;
        f(r, 1) = f(r, 1) / left.fy;
        f(r, 2) = f(r, 2) - f(r, 0) * left.cx - f(r, 1) * left.cy;
    }
    for (int c = 0; c < 3; ++c) {
        f(0, c) = f(0, c) / right.fx;
        f(1, c) = f(1, c) / right.fy;
        f(2, c) = f(2, c) - f(0, c) * right.cx - f(1, c) * right.cy;
    }
    return f;
}

/// The longest cross product of two rows, at length 1: what all rows are square to.
template <class Scalar>
constexpr Result<Vector<3, Scalar>> square_to_rows(const Matrix<3, 3, Scalar>& a) {
    Scalar whole = scalar_of<Scalar>(0);
    for (int r = 0; r < 3; ++r) whole = whole + dot(a.row(r), a.row(r));
    Vector<3, Scalar> best;
    Scalar most = scalar_of<Scalar>(0);
    for (int r = 0; r < 3; ++r) {
        const Vector<3, Scalar> one = cross(a.row(r), a.row((r + 1) % 3));
        const Scalar square = dot(one, one);
        if (!(most < square)) continue;
        most = square;
        best = one;
    }
    if (!(scale(whole * whole, -80) < most)) return Status::degenerate;
    return normalized(best);
}

}  // namespace detail

template <class Scalar>
constexpr Result<Matrix<3, 3, Scalar>> fundamental_matrix(const StereoCamera<Scalar>& cameras) {
    const Scalar zero = scalar_of<Scalar>(0);
    if (cameras.left.fx == zero || cameras.left.fy == zero || cameras.right.fx == zero ||
        cameras.right.fy == zero)
        return Status::bad_argument;
    return detail::of_length_one(
        detail::in_pixels(essential_matrix(cameras.right_from_left), cameras.left, cameras.right));
}

template <class Scalar>
constexpr Result<Vector<3, Scalar>> epipolar_line(const Matrix<3, 3, Scalar>& fundamental,
                                                  const Vector<2, Scalar>& pixel) {
    const Vector<3, Scalar> line = fundamental * Vector<3, Scalar>(pixel[0], pixel[1], scalar_of<Scalar>(1));
    Scalar summed = scalar_of<Scalar>(0);
    for (int r = 0; r < 2; ++r)
        summed = summed + absolute(fundamental(r, 0) * pixel[0]) + absolute(fundamental(r, 1) * pixel[1]) +
                 absolute(fundamental(r, 2));
    const Scalar length = square_root(line[0] * line[0] + line[1] * line[1]);
    if (!(scale(summed, -50) < length)) return Status::degenerate;
    return line * (scalar_of<Scalar>(1) / length);
}

template <class Scalar>
constexpr Result<Scalar> sampson_distance(const Matrix<3, 3, Scalar>& fundamental,
                                          const Vector<2, Scalar>& left, const Vector<2, Scalar>& right) {
    const Scalar one = scalar_of<Scalar>(1);
    const Vector<3, Scalar> x(left[0], left[1], one);
    const Vector<3, Scalar> y(right[0], right[1], one);
    const Vector<3, Scalar> line = fundamental * x;
    const Vector<3, Scalar> back = fundamental.transposed() * y;
    const Scalar slopes = line[0] * line[0] + line[1] * line[1] + back[0] * back[0] + back[1] * back[1];
    if (!(scalar_of<Scalar>(0) < slopes)) return Status::degenerate;
    return absolute(dot(y, line)) / square_root(slopes);
}

template <class Scalar>
constexpr Result<LineEnds> clip_line(const Vector<3, Scalar>& line, Rectangle area) {
    constexpr std::int64_t far = std::int64_t{1} << 22;
    if (area.empty()) return Status::empty_image;
    const std::int64_t right = std::int64_t{area.x} + area.width - 1;
    const std::int64_t bottom = std::int64_t{area.y} + area.height - 1;
    if (area.x < -far || area.y < -far || right > far || bottom > far) return Status::out_of_range;
    const Scalar zero = scalar_of<Scalar>(0);
    const Scalar square = line[0] * line[0] + line[1] * line[1];
    if (!(zero < square)) return Status::degenerate;

    // From the middle: sides at +-half, foot of the perpendicular on the line, and the way along it.
    const Vector<2, Scalar> middle(scalar_of<Scalar>(area.x + right, -1),
                                   scalar_of<Scalar>(area.y + bottom, -1));
    const Scalar half[2] = {scalar_of<Scalar>(area.width - 1, -1), scalar_of<Scalar>(area.height - 1, -1)};
    const Scalar share = -distance_from_line(line, middle) / square;
    const Scalar foot[2] = {line[0] * share, line[1] * share};
    const Scalar way[2] = {-line[1], line[0]};
    Scalar from = zero;
    Scalar to = zero;
    bool bounded = false;
    for (int side = 0; side < 2; ++side) {
        if (way[side] == zero) {
            if (half[side] < absolute(foot[side])) return Status::not_found;
            continue;
        }
        const Scalar reach = absolute(half[side] / way[side]);
        const Scalar centre = -foot[side] / way[side];
        from = bounded && centre - reach < from ? from : centre - reach;
        to = bounded && to < centre + reach ? to : centre + reach;
        bounded = true;
    }
    if (to < from) return Status::not_found;
    const auto end = [&](Scalar along) {
        const auto raw = [&](int side) {
            const Scalar value = middle[side] + foot[side] + way[side] * along;
            return SubPixel::from_raw(
                saturate_cast<std::int32_t>(ScalarTraits<Scalar>::rounded(value, SubPixel::fraction_bits)));
        };
        return SubPixelPoint{raw(0), raw(1)};
    };
    const SubPixelPoint first = end(from);
    return LineEnds{first, end(to)};
}

template <class Scalar>
constexpr Result<Epipoles<Scalar>> epipoles(const Matrix<3, 3, Scalar>& fundamental) {
    const Result<Vector<3, Scalar>> left = detail::square_to_rows(fundamental);
    const Result<Vector<3, Scalar>> right = detail::square_to_rows(fundamental.transposed());
    if (!left || !right) return Status::degenerate;
    return Epipoles<Scalar>{*left, *right};
}

}  // namespace fovea
