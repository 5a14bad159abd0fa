// SPDX-License-Identifier: MIT
//
// Fundamental and essential matrix of pairs that mostly do not belong together: RANSAC.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/match/ransac.hpp>
#include <fovea/match/ransac_transforms.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/scalar.hpp>
#include <fovea/stereo/eight_point.hpp>
#include <fovea/stereo/essential.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// fit_fundamental() of the pairs that agree with the best sample of eight: those whose sampson_distance() is
/// at most a tolerance. The fit is repeated with those that agree with it, while their number grows.
///
/// agrees  1 for each pair that agrees with the answer and 0 for the others; as long as left
/// Errors  those of fit_fundamental(); size_mismatch also for agrees; bad_argument for a tolerance that is not
///         above 0 or options out of range; not_found if fewer than options.enough agree; degenerate if no
///         sample makes a matrix, or those that agree with the best leave more than one open: a plane
template <class Scalar = Real>
constexpr Result<RansacFit<Matrix<3, 3, Scalar>>> fit_fundamental_ransac(Span<const SubPixelPoint> left,
                                                                         Span<const SubPixelPoint> right,
                                                                         SubPixel tolerance,
                                                                         const RansacOptions& options,
                                                                         Span<std::uint8_t> agrees);

/// The same for fit_essential(): places at distance 1, and a tolerance in their unit, which is that in pixels
/// divided by the focal length.
template <class Scalar>
constexpr Result<RansacFit<Matrix<3, 3, Scalar>>> fit_essential_ransac(Span<const Vector<2, Scalar>> left,
                                                                       Span<const Vector<2, Scalar>> right,
                                                                       const Scalar& tolerance,
                                                                       const RansacOptions& options,
                                                                       Span<std::uint8_t> agrees);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// The matrix that eight equations have as their solution; degenerate if the square of the last pivot is no
/// more than a limit.
template <class Scalar>
constexpr Result<Matrix<3, 3, Scalar>> solve_eight(Matrix<8, 9, Scalar>& a, Scalar limit) {
    int place[9] = {0, 1, 2, 3, 4, 5, 6, 7, 8};
    for (int k = 0; k < 8; ++k) {
        int row = k;
        int column = k;
        for (int r = k; r < 8; ++r)
            for (int c = k; c < 9; ++c)
                if (absolute(a(row, column)) < absolute(a(r, c))) {
                    row = r;
                    column = c;
                }
        if (!(limit < a(row, column) * a(row, column))) return Status::degenerate;
        swap_columns(a.view(), k, column);
        const int kept = place[k];
        place[k] = place[column];
        place[column] = kept;
        for (int c = k; c < 9; ++c) {
            const Scalar element = a(k, c);
            a(k, c) = a(row, c);
            a(row, c) = element;
        }
        for (int r = k + 1; r < 8; ++r) {
            const Scalar share = a(r, k) / a(k, k);
            for (int c = k + 1; c < 9; ++c) a(r, c) = a(r, c) - share * a(k, c);
        }
    }
    Vector<9, Scalar> x;
    x[8] = scalar_of<Scalar>(1);
    Matrix<3, 3, Scalar> f;
    for (int k = 8; k >= 0; --k) {
        for (int c = k + 1; k < 8 && c < 9; ++c) x[k] = x[k] - a(k, c) * x[c];
        if (k < 8) x[k] = x[k] / a(k, k);
        f(place[k] / 3, place[k] % 3) = x[k];
    }
    return f;
}

/// Whether sampson_distance() is at most the root of a square.
template <class Scalar>
constexpr bool fits_epipolar(const Matrix<3, 3, Scalar>& f, const Vector<2, Scalar>& left,
                             const Vector<2, Scalar>& right, const Scalar& square) {
    const auto row = [&](int r) { return f(r, 0) * left[0] + f(r, 1) * left[1] + f(r, 2); };
    const auto column = [&](int c) { return f(0, c) * right[0] + f(1, c) * right[1] + f(2, c); };
    const Scalar line[2] = {row(0), row(1)};
    const Scalar back[2] = {column(0), column(1)};
    const Scalar error = right[0] * line[0] + right[1] * line[1] + row(2);
    return !(square * (line[0] * line[0] + line[1] * line[1] + back[0] * back[0] + back[1] * back[1]) <
             error * error);
}

/// RANSAC over places left(index) and right(index); finish makes the wanted matrix of one of rank 2.
template <class Scalar, class Left, class Right, class Finish>
constexpr Result<RansacFit<Matrix<3, 3, Scalar>>> epipolar_ransac(std::ptrdiff_t count, Left left,
                                                                  Right right, int fraction_bits,
                                                                  Scalar error, Scalar tolerance,
                                                                  const RansacOptions& options,
                                                                  Span<std::uint8_t> agrees, Finish finish) {
    using Model = Matrix<3, 3, Scalar>;
    const auto all = [](std::ptrdiff_t) { return true; };
    const PlaceFrame<Scalar> from = frame_of_places<Scalar>(count, left, all, fraction_bits);
    const PlaceFrame<Scalar> to = frame_of_places<Scalar>(count, right, all, fraction_bits);
    const Scalar first = scale(error, -from.bits);
    const Scalar second = scale(error, -to.bits);
    const Scalar limit = scale(first * first + second * second, 3);
    const Scalar square = tolerance * tolerance;
    const auto near = [&](const Model& f, std::ptrdiff_t i) {
        return fits_epipolar(f, left(i), right(i), square);
    };
    const auto best = ransac<8, Model>(
        count, options,
        [&](const std::ptrdiff_t(&chosen)[std::size_t{8}]) -> Result<Model> {
            Matrix<8, 9, Scalar> equations;
            for (int r = 0; r < 8; ++r) {
                const Vector<9, Scalar> row = epipolar_equation(from(left(chosen[r])), to(right(chosen[r])));
                for (int c = 0; c < 9; ++c) equations(r, c) = row[c];
            }
            const Result<Model> full = solve_eight(equations, limit);
            if (!full) return full;
            const Result<Model> f = nearest_of_rank_two(*full);
            return f ? finish(without_frames(*f, from, to)) : f;
        },
        near);
    if (!best) return best.status();
    const auto fit = [&](auto use) -> Result<Model> {
        const Result<Model> f = eight_point<Scalar>(count, left, right, use, fraction_bits, error);
        return f ? finish(*f) : f;
    };
    RansacFit<Model> found{best->model, best->agreeing, best->samples, best->certain};
    Result<Model> better = fit([&](std::ptrdiff_t i) { return near(best->model, i); });
    if (better.status() == Status::degenerate) return Status::degenerate;
    for (int round = 0; round < 8 && better; ++round) {
        std::ptrdiff_t agreeing = 0;
        for (std::ptrdiff_t i = 0; i < count; ++i) agreeing += near(*better, i) ? 1 : 0;
        if (agreeing < found.agreeing) break;
        const bool more = agreeing > found.agreeing;
        found.transform = *better;
        found.agreeing = agreeing;
        if (!more) break;
        const Model last = *better;
        better = fit([&](std::ptrdiff_t i) { return near(last, i); });
    }
    for (std::ptrdiff_t i = 0; i < count; ++i) agrees[i] = near(found.transform, i) ? 1 : 0;
    return found;
}

}  // namespace detail

template <class Scalar>
constexpr Result<RansacFit<Matrix<3, 3, Scalar>>> fit_fundamental_ransac(Span<const SubPixelPoint> left,
                                                                         Span<const SubPixelPoint> right,
                                                                         SubPixel tolerance,
                                                                         const RansacOptions& options,
                                                                         Span<std::uint8_t> agrees) {
    if (agrees.size() != left.size()) return Status::size_mismatch;
    const Status status = detail::check_stereo_pairs(left, right);
    if (status != Status::ok) return status;
    if (tolerance.raw() <= 0) return Status::bad_argument;
    return detail::epipolar_ransac<Scalar>(
        left.size(), [&](std::ptrdiff_t i) { return vector_of<Scalar>(left[i]); },
        [&](std::ptrdiff_t i) { return vector_of<Scalar>(right[i]); }, SubPixel::fraction_bits,
        detail::pixel_error<Scalar>(), scalar_of<Scalar>(tolerance.raw(), -SubPixel::fraction_bits), options,
        agrees, [](const Matrix<3, 3, Scalar>& f) { return detail::of_length_one(f); });
}

template <class Scalar>
constexpr Result<RansacFit<Matrix<3, 3, Scalar>>> fit_essential_ransac(Span<const Vector<2, Scalar>> left,
                                                                       Span<const Vector<2, Scalar>> right,
                                                                       const Scalar& tolerance,
                                                                       const RansacOptions& options,
                                                                       Span<std::uint8_t> agrees) {
    if (agrees.size() != left.size()) return Status::size_mismatch;
    const Status status = detail::check_ray_pairs(left, right);
    if (status != Status::ok) return status;
    if (!(scalar_of<Scalar>(0) < tolerance)) return Status::bad_argument;
    return detail::epipolar_ransac<Scalar>(
        left.size(), [&](std::ptrdiff_t i) { return left[i]; }, [&](std::ptrdiff_t i) { return right[i]; },
        detail::ray_bits, detail::ray_error<Scalar>(), tolerance, options, agrees,
        [](const Matrix<3, 3, Scalar>& e) { return nearest_essential(e); });
}

}  // namespace fovea
