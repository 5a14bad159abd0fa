// SPDX-License-Identifier: MIT
//
// Undistortion maps: for each pixel of a pinhole's picture the place in the picture of a real camera. Made
// row by row in integers. Book sec. 2.2.4, 2.9.2 and 2.10.3.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/camera/camera.hpp>
#include <fovea/camera/lens_inverse.hpp>
#include <fovea/camera/pose.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/number/scalar.hpp>
#include <fovea/warp/remap.hpp>
#include <fovea/warp/remap_curved.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// In a row of places: there is no such place.
inline constexpr FinePoint no_fine_point{FinePixel::from_raw(simd::no_place), FinePixel()};

namespace detail {

/// A divisor of ratios whose magnitude is below 1.
struct Divisor;

}  // namespace detail

/// What undistortion_map() makes: the numbers from which rows of places are calculated.
class UndistortionMap {
public:
    /// The size of the output.
    constexpr Size size() const { return size_; }

    /// Where the pixels (0, y), (1, y), ... of the output come from; no_fine_point where the lens says
    /// nothing, and beyond 32767 px.
    ///
    /// Shapes    y and places.size() may go up to 15 px beyond the output, as grids do
    /// Rounding  within 1e-4 px of the real place, for pictures up to 3840x2160 whose view is less than 120
    ///           degrees wide; tests/core/camera measures 3e-5
    /// Errors    empty_image, size_mismatch for a map without content or too many places; out_of_range for y
    /// Source    book eq. 2.8 and 2.9 in integers: rays grow by steps of 2^-44, coordinates have 30 bits of
    ///           their largest, the lens 28
    constexpr Status row(int y, Span<FinePoint> places) const;
    /// The same to 1/256 px, as remap() takes it.
    constexpr Status row(int y, Span<MapPoint> places) const;
    /// One of them.
    constexpr FinePoint place(int x, int y) const;

private:
    template <class Scalar>
    friend constexpr Result<UndistortionMap> undistortion_map(const LensInverse<Scalar>& lens,
                                                              const Matrix<3, 3, Scalar>& rotation,
                                                              const Camera<Scalar>& view, Size output);
    /// Where the ray (x, y, depth) meets the image.
    constexpr FinePoint along(std::int64_t x, std::int64_t y, std::int64_t depth,
                              const detail::Divisor& divisor) const;
    template <class Place>
    constexpr Status walk(int y, Span<Place> places) const;

    Size size_;
    // Ray of the pixel (u, v): step_u_ u + step_v_ v + first_, as parts of 2^44. x and y are parts of radius
    // times the largest depth, depth is a part of the largest.
    std::int64_t step_u_[3] = {};
    std::int64_t step_v_[3] = {};
    std::int64_t first_[3] = {};
    // The lens for coordinates that are parts of the radius: of 2^28.
    std::int32_t k1_ = 0, k2_ = 0, k3_ = 0, p1_ = 0, p2_ = 0;
    // Focal lengths times the radius, of 2^16; principal points, of 2^44 and half a place more.
    std::int32_t fx_ = 0, fy_ = 0;
    std::int64_t cx_ = 0, cy_ = 0;
};

/// A map for the picture that a pinhole would take in place of a camera.
///
/// Shapes    output 1x1 to 32767x32767
/// Units     rotation leads from the camera's coordinates to those of the view; the identity undistorts. Of
///           the view focal lengths and principal point count, its lens does not
/// Range     the map ends where the lens's field does, and before that where its terms add up to 6 or a focal
///           length times the radius is 32768 px: far outside of what was calibrated
/// Errors    empty_image, image_too_large; bad_argument for focal lengths that are not above 0, and for a
///           rotation that is none to 2^-20; out_of_range where the view sees nothing of the lens's field,
///           and for absurd numbers: principal points beyond 32768 px, rays of a pixel beyond 2^16 of that
///           field
/// Source    book eq. 2.8, 2.9 and sec. 2.10.3. The toolkit keeps 20 bytes a pixel, this 128 in all
template <class Scalar>
constexpr Result<UndistortionMap> undistortion_map(const LensInverse<Scalar>& lens,
                                                   const Matrix<3, 3, Scalar>& rotation,
                                                   const Camera<Scalar>& view, Size output);

/// The map for remap(): a place for every pixel, 8 bytes.
///
/// Shapes    points map.size()
/// Rounding  to 1/256 px
/// Errors    empty_image, size_mismatch
/// Source    UndistortionMap
constexpr Status undistortion_points(const UndistortionMap& map, ImageView<MapPoint> points);

/// The map for remap_curved_grid(): a place for every 16th column and row.
///
/// Shapes    grid map_grid_size(map.size())
/// Rounding  to 1/256 px. With lenses of 4 mm at 640x480 remap_curved_grid() meets the map within 1/100 px
///           and remap_grid() within 1/8; undistortion_grid_error() measures it
/// Errors    empty_image, size_mismatch
/// Source    UndistortionMap
constexpr Status undistortion_grid(const UndistortionMap& map, ImageView<MapPoint> grid);

/// The greatest difference, in x or y, between a map and what remap_curved_grid() makes of its grid, over all
/// pixels that have a place in both.
///
/// Shapes    grid map_grid_size(map.size()); places and points as long as a row of the output
/// Scratch   places and points, undefined afterwards
/// Errors    empty_image, size_mismatch, scratch_too_small; not_found if no pixel has a place
/// Source    UndistortionMap
inline Result<FinePixel> undistortion_grid_error(const UndistortionMap& map, ImageView<const MapPoint> grid,
                                                 Span<FinePoint> places, Span<MapPoint> points);

/// The camera whose undistortion is p + (1 + d r^2) (p - centre), r in pixels from the centre of the image: a
/// lens by one number, for cameras that were never calibrated. The view that it takes is the camera itself.
///
/// Source  the toolkit's CUndistortionSimple
template <class Scalar>
constexpr Camera<Scalar> camera_of_one_term(Size size, Scalar d);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// a b / 2^30, to the nearest.
constexpr std::int32_t part_of(std::int32_t a, std::int32_t b) {
    return static_cast<std::int32_t>(round_shift(std::int64_t{a} * b, 30));
}

struct Divisor {
    int raise = 0;
    std::int32_t inverse = 0;

    /// Of a value above 0; of others nothing is divided.
    static constexpr Divisor of(std::int64_t value) {
        if (value <= 0) return {};
        const int raise = leading_zeros(static_cast<std::uint64_t>(value));
        const auto d = static_cast<std::int64_t>(static_cast<std::uint64_t>(value) << raise >> 32);
        // 2^62 / d by Newton's steps, from the line 48/17 - 32/17 d, which is off by 1/17 at most.
        std::int64_t inverse = 3031741620 - round_shift(d * 2021161080, 32);
        for (int i = 0; i < 3; ++i)
            inverse += inverse * (((std::int64_t{1} << 62) - d * inverse) >> 30) >> 32;
        return {raise, static_cast<std::int32_t>(minimum<std::int64_t>(inverse, 0x7fffffff))};
    }
    /// value over the divisor, as a part of 2^30.
    constexpr std::int32_t share(std::int64_t value) const {
        const std::int64_t high = value * (std::int64_t{1} << (raise - 1)) >> 32;
        return static_cast<std::int32_t>(high * inverse >> 31);
    }
};

constexpr void put_place(FinePoint place, FinePoint& to) { to = place; }
constexpr void put_place(FinePoint place, MapPoint& to) {
    to = place == no_fine_point ? no_map_point
                                : MapPoint{place.x.convert<SubPixel>(), place.y.convert<SubPixel>()};
}

}  // namespace detail

constexpr FinePoint UndistortionMap::along(std::int64_t x, std::int64_t y, std::int64_t depth,
                                           const detail::Divisor& divisor) const {
    if (depth <= 0 || x >= depth || x <= -depth || y >= depth || y <= -depth) return no_fine_point;
    const std::int32_t u = divisor.share(x);
    const std::int32_t v = divisor.share(y);
    const std::int32_t uu = detail::part_of(u, u);
    const std::int32_t vv = detail::part_of(v, v);
    constexpr std::int32_t one = 1 << 30;
    if (uu >= one - vv) return no_fine_point;
    const std::int32_t square = uu + vv;
    // 2 u v is at most the square.
    const auto uv = static_cast<std::int32_t>(round_shift(std::int64_t{u} * v, 29));
    const std::int32_t radial =
        (one >> 2) +
        detail::part_of(square, k1_ + detail::part_of(square, k2_ + detail::part_of(square, k3_)));
    const auto tangential = [&](std::int32_t p, std::int32_t own) {
        return static_cast<std::int32_t>(round_shift(std::int64_t{p} * ((square >> 1) + own), 29));
    };
    const std::int32_t to_x = detail::part_of(u, radial) + detail::part_of(p1_, uv) + tangential(p2_, uu);
    const std::int32_t to_y = detail::part_of(v, radial) + detail::part_of(p2_, uv) + tangential(p1_, vv);
    // Below 2^62 + 2^59.
    const std::int64_t at_x = (std::int64_t{fx_} * to_x + cx_) >> 28;
    const std::int64_t at_y = (std::int64_t{fy_} * to_y + cy_) >> 28;
    constexpr std::int64_t last = std::int64_t{max_image_side} << 16;
    if (at_x < -last || at_x > last || at_y < -last || at_y > last) return no_fine_point;
    return {FinePixel::from_raw(static_cast<std::int32_t>(at_x)),
            FinePixel::from_raw(static_cast<std::int32_t>(at_y))};
}

constexpr FinePoint UndistortionMap::place(int x, int y) const {
    std::int64_t ray[3] = {};
    for (int i = 0; i < 3; ++i) ray[i] = first_[i] + step_v_[i] * y + step_u_[i] * x;
    return along(ray[0], ray[1], ray[2], detail::Divisor::of(ray[2]));
}

template <class Place>
constexpr Status UndistortionMap::walk(int y, Span<Place> places) const {
    if (size_.empty() || places.empty()) return Status::empty_image;
    if (places.size() > size_.width + (map_grid_step - 1)) return Status::size_mismatch;
    if (y < 0 || y >= size_.height + (map_grid_step - 1)) return Status::out_of_range;
    std::int64_t ray[3] = {};
    for (int i = 0; i < 3; ++i) ray[i] = first_[i] + step_v_[i] * y;
    // Without rotation all of a row is at one depth.
    const bool level = step_u_[2] == 0;
    detail::Divisor divisor = detail::Divisor::of(ray[2]);
    for (std::ptrdiff_t x = 0; x < places.size(); ++x) {
        if (!level) divisor = detail::Divisor::of(ray[2]);
        detail::put_place(along(ray[0], ray[1], ray[2], divisor), places[x]);
        for (int i = 0; i < 3; ++i) ray[i] += step_u_[i];
    }
    return Status::ok;
}

constexpr Status UndistortionMap::row(int y, Span<FinePoint> places) const { return walk(y, places); }
constexpr Status UndistortionMap::row(int y, Span<MapPoint> places) const { return walk(y, places); }

template <class Scalar>
constexpr Result<UndistortionMap> undistortion_map(const LensInverse<Scalar>& lens,
                                                   const Matrix<3, 3, Scalar>& rotation,
                                                   const Camera<Scalar>& view, Size output) {
    const Scalar zero = scalar_of<Scalar>(0);
    const Scalar one = scalar_of<Scalar>(1);
    const Camera<Scalar>& camera = lens.camera();
    if (output.empty()) return Status::empty_image;
    if (output.width > max_image_side || output.height > max_image_side) return Status::image_too_large;
    if (!(zero < camera.fx && zero < camera.fy && zero < view.fx && zero < view.fy) || !is_rotation(rotation))
        return Status::bad_argument;
    if (!(zero < lens.radius())) return Status::out_of_range;

    // The ray of a pixel in the camera's coordinates: columns for u, v and 1.
    const Matrix<3, 3, Scalar> back = rotation.transposed();
    Vector<3, Scalar> columns[3];
    columns[0] = back.column(0) * (one / view.fx);
    columns[1] = back.column(1) * (one / view.fy);
    columns[2] = back.column(2) - columns[0] * view.cx - columns[1] * view.cy;

    // What is seen is largest at a corner, if all of them are in front of the camera.
    Scalar depth = zero;
    Scalar radius = zero;
    bool in_front = true;
    Vector<3, Scalar> corners[4];
    for (int i = 0; i < 4; ++i) {
        const int beyond = map_grid_step - 1;
        const Scalar u = scalar_of<Scalar>((i & 1) != 0 ? output.width + beyond : 0);
        const Scalar v = scalar_of<Scalar>((i & 2) != 0 ? output.height + beyond : 0);
        const Vector<3, Scalar> ray = columns[0] * u + columns[1] * v + columns[2];
        corners[i] = ray;
        if (depth < ray[2]) depth = ray[2];
        in_front = in_front && zero < ray[2];
        if (!(zero < ray[2])) continue;
        const Scalar away = square_root(ray[0] * ray[0] + ray[1] * ray[1]) / ray[2];
        if (radius < away) radius = away;
    }
    if (depth == zero) return Status::out_of_range;
    // A little more, so that no rounding puts a corner outside.
    radius = radius + scale(radius, -12) + scalar_of<Scalar>(1, -12);
    if (!in_front || lens.radius() < radius) radius = lens.radius();
    // What is seen of the lens must fit the formats.
    const Scalar far = scalar_of<Scalar>(1, 15);
    Scalar terms[5];
    bool fits = false;
    for (int i = 0; i < 400 && !fits; ++i) {
        if (i > 0) radius = radius * scalar_of<Scalar>(15, -4);
        const Scalar square = radius * radius;
        terms[0] = camera.k1 * square;
        terms[1] = camera.k2 * square * square;
        terms[2] = camera.k3 * square * square * square;
        terms[3] = camera.p1 * radius;
        terms[4] = camera.p2 * radius;
        Scalar sum = zero;
        for (int k = 0; k < 5; ++k) sum = sum + absolute(k < 3 ? terms[k] : scale(terms[k], 2));
        fits = sum < scalar_of<Scalar>(6) && camera.fx * radius < far && camera.fy * radius < far;
    }
    if (!fits || !(absolute(camera.cx) < far) || !(absolute(camera.cy) < far)) return Status::out_of_range;
    const Scalar width = one / (depth * radius);
    const Scalar most = scalar_of<Scalar>(1, 16);
    for (const Vector<3, Scalar>& ray : corners)
        if (!(absolute(ray[0] * width) < most && absolute(ray[1] * width) < most &&
              absolute(ray[2]) < depth * most))
            return Status::out_of_range;

    const auto raw = [](Scalar value, int bits) { return ScalarTraits<Scalar>::rounded(value, bits); };
    UndistortionMap map;
    const auto put = [&](const Vector<3, Scalar>& column, std::int64_t(&to)[3]) {
        to[0] = raw(column[0] * width, 44);
        to[1] = raw(column[1] * width, 44);
        to[2] = raw(column[2] / depth, 44);
    };
    put(columns[0], map.step_u_);
    put(columns[1], map.step_v_);
    put(columns[2], map.first_);

    std::int32_t* const to[5] = {&map.k1_, &map.k2_, &map.k3_, &map.p1_, &map.p2_};
    for (int i = 0; i < 5; ++i) *to[i] = static_cast<std::int32_t>(raw(terms[i], 28));
    map.fx_ = saturate_cast<std::int32_t>(raw(camera.fx * radius, 16));
    map.fy_ = saturate_cast<std::int32_t>(raw(camera.fy * radius, 16));
    map.cx_ = raw(camera.cx, 44) + (1 << 27);
    map.cy_ = raw(camera.cy, 44) + (1 << 27);
    map.size_ = output;
    return map;
}

constexpr Status undistortion_points(const UndistortionMap& map, ImageView<MapPoint> points) {
    if (map.size().empty() || points.empty()) return Status::empty_image;
    if (points.size() != map.size()) return Status::size_mismatch;
    for (int y = 0; y < points.height(); ++y)
        if (Status s = map.row(y, Span<MapPoint>(points.row(y), points.width())); s != Status::ok) return s;
    return Status::ok;
}

constexpr Status undistortion_grid(const UndistortionMap& map, ImageView<MapPoint> grid) {
    if (map.size().empty() || grid.empty()) return Status::empty_image;
    if (grid.size() != map_grid_size(map.size())) return Status::size_mismatch;
    for (int y = 0; y < grid.height(); ++y)
        for (int x = 0; x < grid.width(); ++x)
            detail::put_place(map.place(x * map_grid_step, y * map_grid_step), grid(x, y));
    return Status::ok;
}

inline Result<FinePixel> undistortion_grid_error(const UndistortionMap& map, ImageView<const MapPoint> grid,
                                                 Span<FinePoint> places, Span<MapPoint> points) {
    const Size size = map.size();
    if (size.empty() || grid.empty()) return Status::empty_image;
    if (grid.size() != map_grid_size(size)) return Status::size_mismatch;
    if (places.size() < size.width || points.size() < size.width) return Status::scratch_too_small;
    const Span<FinePoint> exact = places.first(size.width);
    const Span<MapPoint> made = points.first(size.width);
    std::int64_t most = -1;
    for (int y = 0; y < size.height; ++y) {
        if (Status s = map.row(y, exact); s != Status::ok) return s;
        if (Status s = expand_curved_map_grid(grid, y, made); s != Status::ok) return s;
        for (int x = 0; x < size.width; ++x) {
            if (exact[x] == no_fine_point || made[x].x == no_map_point.x) continue;
            for (const std::int64_t off : {std::int64_t{made[x].x.raw()} * 256 - exact[x].x.raw(),
                                           std::int64_t{made[x].y.raw()} * 256 - exact[x].y.raw()})
                most = maximum(most, off < 0 ? -off : off);
        }
    }
    if (most < 0) return Status::not_found;
    return FinePixel::from_raw(saturate_cast<std::int32_t>(most));
}

template <class Scalar>
constexpr Camera<Scalar> camera_of_one_term(Size size, Scalar d) {
    Camera<Scalar> camera;
    // A focal length of a power of two, so that the image ends within a radius of 1.
    int bits = 0;
    while (bits < 16 && (1 << bits) < maximum(size.width, size.height)) ++bits;
    camera.fx = camera.fy = scalar_of<Scalar>(1, bits);
    camera.cx = scalar_of<Scalar>(size.width - 1, -1);
    camera.cy = scalar_of<Scalar>(size.height - 1, -1);
    camera.k1 = scale(d, 2 * bits);
    return camera;
}

}  // namespace fovea
