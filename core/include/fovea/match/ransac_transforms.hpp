// SPDX-License-Identifier: MIT
//
// The homography and the affine transform that most of many doubtful pairs of places agree with.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/match/fit_homography.hpp>
#include <fovea/match/point_pair.hpp>
#include <fovea/match/ransac.hpp>
#include <fovea/number/scalar.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// A transform with the number of pairs that it rests on.
template <class Transform>
struct RansacFit {
    Transform transform;
    std::ptrdiff_t agreeing = 0;
    int samples = 0;       ///< drawn
    bool certain = false;  ///< as in RansacResult
};

/// fit_homography() of the pairs that agree with the best sample of four: those whose pixel is at most
/// tolerance from where the homography puts it. The fit is repeated with those that agree with it, while
/// their number grows.
///
/// agrees   1 for each pair that agrees with the answer and 0 for the others; as long as from
/// Errors   those of fit_homography() for sizes; bad_argument for a tolerance that is not above 0 or options
///          out of range; not_found if fewer than options.enough agree; degenerate if no four pairs make a
///          homography
template <class Scalar = Real, class From>
constexpr Result<RansacFit<Matrix<3, 3, Scalar>>> fit_homography_ransac(Span<const From> from,
                                                                        Span<const SubPixelPoint> to,
                                                                        SubPixel tolerance,
                                                                        const RansacOptions& options,
                                                                        Span<std::uint8_t> agrees);

/// The same for the affine transform, with samples of three.
template <class Scalar = Real, class From>
constexpr Result<RansacFit<Matrix<2, 3, Scalar>>> fit_affine_ransac(Span<const From> from,
                                                                    Span<const SubPixelPoint> to,
                                                                    SubPixel tolerance,
                                                                    const RansacOptions& options,
                                                                    Span<std::uint8_t> agrees);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Whether a transform puts a place to within a tolerance of a pixel.
template <class Scalar, class From, int Rows>
constexpr bool maps_near(const Matrix<Rows, 3, Scalar>& map, From from, SubPixelPoint to, Scalar square) {
    const WholePlace place = whole_place(from);
    const int bits = -fraction_bits_of(from);
    const Scalar x = scalar_of<Scalar>(place.x, bits);
    const Scalar y = scalar_of<Scalar>(place.y, bits);
    const auto row = [&](int r) { return map(r, 0) * x + map(r, 1) * y + map(r, 2); };
    constexpr int out = -SubPixel::fraction_bits;
    const Scalar u = scalar_of<Scalar>(to.x.raw(), out);
    const Scalar v = scalar_of<Scalar>(to.y.raw(), out);
    if constexpr (Rows == 3) {
        const Scalar weight = row(Rows - 1);
        if (!(scalar_of<Scalar>(0) < weight)) return false;
        const Scalar du = row(0) - u * weight;
        const Scalar dv = row(1) - v * weight;
        return du * du + dv * dv <= square * (weight * weight);
    } else {
        const Scalar du = row(0) - u;
        const Scalar dv = row(1) - v;
        return du * du + dv * dv <= square;
    }
}

/// fit makes a transform of the pairs for which its last argument holds.
template <int SampleSize, class Transform, class Scalar, class From, class Fit>
constexpr Result<RansacFit<Transform>> fit_transform_ransac(Span<const From> from,
                                                            Span<const SubPixelPoint> to, SubPixel tolerance,
                                                            const RansacOptions& options,
                                                            Span<std::uint8_t> agrees, Fit fit) {
    if (from.size() != to.size() || agrees.size() != from.size()) return Status::size_mismatch;
    if (tolerance.raw() <= 0 || from.size() > most_pairs) return Status::bad_argument;
    const Scalar side = scalar_of<Scalar>(tolerance.raw(), -SubPixel::fraction_bits);
    const Scalar square = side * side;
    const auto near = [&](const Transform& map, std::ptrdiff_t i) {
        return maps_near(map, from[i], to[i], square);
    };
    const auto best = ransac<SampleSize, Transform>(
        from.size(), options,
        [&](const std::ptrdiff_t(&chosen)[static_cast<std::size_t>(SampleSize)]) {
            From places[static_cast<std::size_t>(SampleSize)] = {};
            SubPixelPoint pixels[static_cast<std::size_t>(SampleSize)] = {};
            for (std::size_t i = 0; i < static_cast<std::size_t>(SampleSize); ++i) {
                places[i] = from[chosen[i]];
                pixels[i] = to[chosen[i]];
            }
            return fit(Span<const From>(places), Span<const SubPixelPoint>(pixels), EachPair());
        },
        near);
    if (!best) return best.status();
    RansacFit<Transform> found{best->model, best->agreeing, best->samples, best->certain};
    for (int round = 0; round < 8; ++round) {
        for (std::ptrdiff_t i = 0; i < from.size(); ++i) agrees[i] = near(found.transform, i) ? 1 : 0;
        const Result<Transform> better = fit(from, to, [&](std::ptrdiff_t i) { return agrees[i] != 0; });
        if (!better) break;
        std::ptrdiff_t agreeing = 0;
        for (std::ptrdiff_t i = 0; i < from.size(); ++i) agreeing += near(*better, i) ? 1 : 0;
        if (agreeing < found.agreeing) break;
        const bool more = agreeing > found.agreeing;
        found.transform = *better;
        found.agreeing = agreeing;
        if (!more) break;
    }
    for (std::ptrdiff_t i = 0; i < from.size(); ++i) agrees[i] = near(found.transform, i) ? 1 : 0;
    return found;
}

}  // namespace detail

template <class Scalar, class From>
constexpr Result<RansacFit<Matrix<3, 3, Scalar>>> fit_homography_ransac(Span<const From> from,
                                                                        Span<const SubPixelPoint> to,
                                                                        SubPixel tolerance,
                                                                        const RansacOptions& options,
                                                                        Span<std::uint8_t> agrees) {
    return detail::fit_transform_ransac<4, Matrix<3, 3, Scalar>, Scalar>(
        from, to, tolerance, options, agrees, [](auto places, auto pixels, auto use) {
            return detail::fit_homography_to<Scalar>(places, pixels, use);
        });
}

template <class Scalar, class From>
constexpr Result<RansacFit<Matrix<2, 3, Scalar>>> fit_affine_ransac(Span<const From> from,
                                                                    Span<const SubPixelPoint> to,
                                                                    SubPixel tolerance,
                                                                    const RansacOptions& options,
                                                                    Span<std::uint8_t> agrees) {
    return detail::fit_transform_ransac<3, Matrix<2, 3, Scalar>, Scalar>(
        from, to, tolerance, options, agrees, [](auto places, auto pixels, auto use) {
            return detail::fit_affine_to<Scalar>(places, pixels, use);
        });
}

}  // namespace fovea
