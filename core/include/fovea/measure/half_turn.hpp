// SPDX-License-Identifier: MIT
//
// Which end is which: the axis of a region has two directions, and its third moments tell them apart. Book
// sec. 6.2.1, whose rule by four rays leaves cases open.
#pragma once

#include <cstdint>

#include <fovea/base/status.hpp>
#include <fovea/number/angle.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/int128.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/number/trigonometry.hpp>
#include <fovea/statistics/moments.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The third central moments in a frame that is turned by an angle, without dimension: the sum of s^p t^q
/// over area times the cube of the radius of gyration. s runs along the angle, t a quarter turn clockwise
/// from it. All of them change sign when the frame turns by half, and all are zero for a region that looks
/// the same then.
struct Asymmetry {
    Ratio sss, sst, stt, ttt;

    friend constexpr bool operator==(const Asymmetry& a, const Asymmetry& b) {
        return a.sss == b.sss && a.sst == b.sst && a.stt == b.stt && a.ttt == b.ttt;
    }
};

/// Rounding  to about 2^-15
/// Errors    degenerate for a region of a single pixel
constexpr Result<Asymmetry> asymmetry(const CentralMoments& moments, FineAngle angle);

/// Whether a region lies turned by half.
///
/// margin  how clear the answer is: 1 is as clear as the taught part, 0 a tossed coin
struct HalfTurn {
    bool turned = false;
    Ratio margin;
};

/// Compares with what was taught of a part of this kind: +1 times it fits better, or -1 times it.
///
/// Errors  undecided if the margin is below 1/2, if the rest that neither explains is as large as that, or if
///         the taught part has no clear ends (sum of squares below the square of least_asymmetry)
constexpr Result<HalfTurn> half_turn(const Asymmetry& measured, const Asymmetry& taught);

/// Without a taught part: what is far from the centre lies more along +s, or where that is even along +t.
///
/// margin  the sum of r^2 s (or r^2 t) that decided, on the scale of Asymmetry
/// Errors  undecided if both are below 1/10
constexpr Result<HalfTurn> half_turn(const Asymmetry& measured);

/// The least length of a taught asymmetry that can decide: noise of the outline of a part of some hundred
/// pixels stays below half of it.
inline constexpr Ratio least_asymmetry = Ratio::from_ratio(1, 50);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// a * b * c of numbers with 30 fraction bits.
constexpr std::int64_t cube(std::int64_t a, std::int64_t b, std::int64_t c) {
    return round_shift(round_shift(a * b, 30) * c, 30);
}

/// Parts of an asymmetry along a taught one, both as vectors of four.
constexpr std::int64_t inner_product(const Asymmetry& a, const Asymmetry& b) {
    const auto product = [](Ratio x, Ratio y) { return std::int64_t{x.raw()} * y.raw(); };
    return product(a.sss, b.sss) + product(a.sst, b.sst) + product(a.stt, b.stt) + product(a.ttt, b.ttt);
}

}  // namespace detail

constexpr Result<Asymmetry> asymmetry(const CentralMoments& moments, FineAngle angle) {
    // The radius of gyration in 2^-16 px: second moments have 8 fraction bits, so 24 more make 32 of its
    // square.
    const std::int64_t spread = (moments.mu20 + moments.mu02).raw();
    if (spread <= 0 || moments.area <= 0) return Status::degenerate;
    const std::int64_t gyration =
        isqrt(static_cast<std::uint64_t>(multiply_divide(spread, std::int64_t{1} << 24, moments.area)));
    if (gyration == 0) return Status::degenerate;

    // Cut to 28 bits, so that four products with 30-bit factors, two of them threefold, fit.
    const std::uint64_t widest =
        magnitude(moments.mu30) | magnitude(moments.mu21) | magnitude(moments.mu12) | magnitude(moments.mu03);
    const int drop = maximum(36 - leading_zeros(widest), 0);
    const std::int64_t xxx = moments.mu30 >> drop;
    const std::int64_t xxy = moments.mu21 >> drop;
    const std::int64_t xyy = moments.mu12 >> drop;
    const std::int64_t yyy = moments.mu03 >> drop;
    const UnitVector direction = unit_vector(angle);
    const std::int64_t c = direction.x.raw();
    const std::int64_t s = direction.y.raw();
    const std::int64_t ccc = detail::cube(c, c, c);
    const std::int64_t ccs = detail::cube(c, c, s);
    const std::int64_t css = detail::cube(c, s, s);
    const std::int64_t sss = detail::cube(s, s, s);
    // The cubes of s = c x + s y and t = c y - s x, multiplied out.
    const std::int64_t turned[4] = {ccc * xxx + 3 * ccs * xxy + 3 * css * xyy + sss * yyy,
                                    -ccs * xxx + (ccc - 2 * css) * xxy + (2 * ccs - sss) * xyy + css * yyy,
                                    css * xxx + (sss - 2 * ccs) * xxy + (ccc - 2 * css) * xyy + ccs * yyy,
                                    -sss * xxx + 3 * css * xxy - 3 * ccs * xyy + ccc * yyy};
    // Third moment / (second moment * radius of gyration), in two steps.
    const auto share = [&](std::int64_t moment) {
        const std::int64_t value = round_shift(moment, 30) * (std::int64_t{1} << drop);
        const std::int64_t length = multiply_divide(value, std::int64_t{1} << 24, spread);
        return Ratio::from_raw(saturate_cast<std::int32_t>(multiply_divide(length, 65536, gyration)));
    };
    return Asymmetry{share(turned[0]), share(turned[1]), share(turned[2]), share(turned[3])};
}

constexpr Result<HalfTurn> half_turn(const Asymmetry& measured, const Asymmetry& taught) {
    const std::int64_t size = detail::inner_product(taught, taught);
    if (size < std::int64_t{least_asymmetry.raw()} * least_asymmetry.raw()) return Status::undecided;
    const std::int64_t along = detail::inner_product(measured, taught);
    HalfTurn result;
    result.turned = along < 0;
    const std::int64_t margin = multiply_divide(along < 0 ? -along : along, Ratio::one, size);
    result.margin = Ratio::from_raw(saturate_cast<std::int32_t>(margin));
    // The rest: |measured|^2 - (part along taught)^2, against (|taught| / 2)^2.
    const std::int64_t rest = detail::inner_product(measured, measured) - multiply_divide(along, along, size);
    if (result.margin.raw() < Ratio::one / 2 || rest > size / 4) return Status::undecided;
    return result;
}

constexpr Result<HalfTurn> half_turn(const Asymmetry& measured) {
    constexpr std::uint32_t least = Ratio::from_ratio(1, 10).raw();
    const Ratio along = measured.sss + measured.stt;
    const Ratio across = measured.sst + measured.ttt;
    const Ratio deciding = magnitude(along.raw()) >= least ? along : across;
    if (magnitude(deciding.raw()) < least) return Status::undecided;
    return HalfTurn{deciding.raw() < 0, deciding.raw() < 0 ? -deciding : deciding};
}

}  // namespace fovea
