// SPDX-License-Identifier: MIT
//
// Rays of many pixels: what poses are found from.
#pragma once

#include <cstddef>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/camera/calibration.hpp>
#include <fovea/camera/fisheye.hpp>
#include <fovea/camera/lens_inverse.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/number/scalar.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The directions from which pixels are seen, as the lens has them: at z = 1 for a LensInverse, at length 1
/// for a FisheyeLens.
///
/// Shapes  as many pixels as rays
/// Errors  size_mismatch; bad_argument for a camera without focal lengths; out_of_range for a pixel that no
///         place of the lens' field is seen in. Then rays before it are written
template <class Scalar>
constexpr Status rays_of(const LensInverse<Scalar>& lens, Span<const SubPixelPoint> pixels,
                         Span<Vector<3, NonDeduced<Scalar>>> rays);
template <class Scalar>
constexpr Status rays_of(const FisheyeLens<Scalar>& lens, Span<const SubPixelPoint> pixels,
                         Span<Vector<3, NonDeduced<Scalar>>> rays);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

template <class Scalar, class Lens>
constexpr Status rays_by(const Lens& lens, Span<const SubPixelPoint> pixels,
                         Span<Vector<3, NonDeduced<Scalar>>> rays) {
    if (pixels.size() != rays.size()) return Status::size_mismatch;
    for (std::ptrdiff_t i = 0; i < pixels.size(); ++i) {
        const Result<Vector<3, Scalar>> ray = lens.ray(pixel_seen<Scalar>(pixels[i]));
        if (!ray) return ray.status();
        rays[i] = *ray;
    }
    return Status::ok;
}

}  // namespace detail

template <class Scalar>
constexpr Status rays_of(const LensInverse<Scalar>& lens, Span<const SubPixelPoint> pixels,
                         Span<Vector<3, NonDeduced<Scalar>>> rays) {
    return detail::rays_by<Scalar>(lens, pixels, rays);
}
template <class Scalar>
constexpr Status rays_of(const FisheyeLens<Scalar>& lens, Span<const SubPixelPoint> pixels,
                         Span<Vector<3, NonDeduced<Scalar>>> rays) {
    return detail::rays_by<Scalar>(lens, pixels, rays);
}

}  // namespace fovea
