// SPDX-License-Identifier: MIT
//
// Circles in an image, from its pixels to the list: smoothing, Canny's edges, their points, the Hough
// transform. Book sec. 2.8.4.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/base/list.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/feature/canny.hpp>
#include <fovea/feature/canny_points.hpp>
#include <fovea/feature/circle_centres.hpp>
#include <fovea/feature/hough_circles.hpp>
#include <fovea/filter/gaussian.hpp>
#include <fovea/image/border.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/simd/isa.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// What is done to an image before its derivatives are taken.
enum class EdgeSmoothing : std::uint8_t {
    none,          ///< for images that are smooth already
    gaussian_3x3,  ///< sigma 0.71 px
    gaussian_5x5,  ///< sigma 1 px
};

struct FindCirclesOptions {
    /// More of it finds less in noise, and costs a frame.
    EdgeSmoothing smoothing = EdgeSmoothing::gaussian_3x3;
    int low = 60;    ///< of canny(): |x| + |y| that goes on with an edge, 0..2040
    int high = 120;  ///< that begins one, low..2040
    /// Room for points of edges, 20 bytes each, 1 or more: 1 to 3 % of the pixels suffice.
    int max_points = 8000;
    HoughCircleOptions circles;
};

inline namespace FOVEA_ISA {

/// Scratch bytes that find_circles() needs; 0 if it refuses the size or the options. Two frames of bytes, or
/// one without smoothing, the points, and what hough_circles() wants of so many.
constexpr std::int64_t find_circles_scratch(Size size, const FindCirclesOptions& options);

/// The circles that an image shows, the one with most votes first.
///
/// Shapes    1x1 to 32767x32767
/// Units     pixels
/// Rounding  centre and radius to 1/256 px; within 0.1 px of the truth where a clean circle of a radius of 8
///           px or more is seen whole
/// Border    the outermost pixels repeat
/// Scratch   find_circles_scratch(src.size(), options) bytes, undefined afterwards
/// Errors    empty_image; image_too_large above max_image_side; bad_argument; scratch_too_small;
///           capacity_exceeded: circles holds the strongest of those that were found, and if there were more
///           than max_points points, of those that the strongest of these make
/// Others    as gaussian_3x3() or gaussian_5x5(), canny(), canny_points() and hough_circles(), one after the
///           other
/// Source    book sec. 2.8.4
inline Status find_circles(ImageView<const Gray8> src, const FindCirclesOptions& options,
                           Span<std::uint8_t> scratch, ListView<HoughCircle> circles);

}  // namespace FOVEA_ISA

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// More than the edges of any image have; their bytes fit 32 bits.
inline constexpr int most_edge_points = 1 << 24;

constexpr bool allowed(const FindCirclesOptions& o) {
    return o.low >= 0 && o.low <= o.high && o.high <= max_gradient_strength && o.max_points >= 1 &&
           o.max_points <= most_edge_points && o.smoothing <= EdgeSmoothing::gaussian_5x5 &&
           allowed(o.circles);
}

}  // namespace detail

inline namespace FOVEA_ISA {

namespace kernels {

constexpr std::int64_t smoothing_scratch(Size size, EdgeSmoothing smoothing) {
    if (smoothing == EdgeSmoothing::none) return 0;
    return smoothing == EdgeSmoothing::gaussian_3x3 ? gaussian_3x3_scratch(size) : gaussian_5x5_scratch(size);
}
constexpr int frames_of(EdgeSmoothing smoothing) { return smoothing == EdgeSmoothing::none ? 1 : 2; }

}  // namespace kernels

constexpr std::int64_t find_circles_scratch(Size size, const FindCirclesOptions& options) {
    if (size.empty() || size.width > max_image_side || size.height > max_image_side ||
        !detail::allowed(options))
        return 0;
    // The steps take turns in the last of it.
    const std::int64_t before =
        maximum(kernels::smoothing_scratch(size, options.smoothing), canny_scratch(size));
    return kernels::frames_of(options.smoothing) * size.area() + arena_bytes<EdgePoint>(options.max_points) +
           maximum(before, hough_circles_scratch(size, options.max_points, options.circles));
}

inline Status find_circles(ImageView<const Gray8> src, const FindCirclesOptions& options,
                           Span<std::uint8_t> scratch, ListView<HoughCircle> circles) {
    if (src.empty()) return Status::empty_image;
    const Size size = src.size();
    if (size.width > max_image_side || size.height > max_image_side) return Status::image_too_large;
    if (!detail::allowed(options)) return Status::bad_argument;
    if (scratch.size() < find_circles_scratch(size, options)) return Status::scratch_too_small;

    // Nothing below can fail but for want of room in a list.
    const auto pixels = static_cast<std::ptrdiff_t>(size.area());
    const ImageView<Gray8> edges(scratch.data(), size, size.width);
    const ImageView<Gray8> smooth(scratch.data() + pixels, size, size.width);
    Arena arena(scratch.from(kernels::frames_of(options.smoothing) * pixels));
    const Span<EdgePoint> room = arena.take<EdgePoint>(options.max_points);
    int count = 0;
    const ListView<EdgePoint> points(room.data(), options.max_points, &count);
    const Span<std::uint8_t> rest = arena.rest();

    Status s = Status::ok;
    if (options.smoothing == EdgeSmoothing::gaussian_3x3)
        s = gaussian_3x3(src, Border::replicate, rest, smooth);
    else if (options.smoothing == EdgeSmoothing::gaussian_5x5)
        s = gaussian_5x5(src, Border::replicate, rest, smooth);
    const ImageView<const Gray8> seen = options.smoothing == EdgeSmoothing::none ? src : smooth;
    if (s == Status::ok) s = canny(seen, options.low, options.high, Border::replicate, rest, edges);
    if (s != Status::ok) return s;
    const Status all_points = canny_points(seen, edges, Border::replicate, points);
    s = hough_circles({room.data(), count}, size, options.circles, rest, circles);
    return s != Status::ok ? s : all_points;
}

}  // namespace FOVEA_ISA
}  // namespace fovea
