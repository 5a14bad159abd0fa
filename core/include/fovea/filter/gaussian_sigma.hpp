// SPDX-License-Identifier: MIT
//
// The Gaussian filter of any sigma. Book sec. 2.6.2.
#pragma once

#include <cstdint>
#include <cstring>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/border.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/row_kernel.hpp>
#include <fovea/number/exponential.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>
#include <fovea/simd/lines.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The least and the greatest sigma of gaussian(), in pixels.
inline constexpr SubPixel min_gaussian_sigma = SubPixel::from_ratio(3, 10);
inline constexpr SubPixel max_gaussian_sigma = SubPixel::from_int(10);

/// The weights of a Gaussian: weight[0] in the middle, weight[i] for both pixels at a distance of i.
///
/// Units  1/65536; all of them, those beside the middle twice, sum to 65536
struct GaussianTaps {
    int reach = 0;
    std::uint16_t weight[max_reach]{};
};

/// The taps of a sigma, out to three times of it.
///
/// Rounding  each to the nearest; the middle takes what is missing to the sum
/// Errors    bad_argument for a sigma below min_gaussian_sigma or above max_gaussian_sigma
constexpr Result<GaussianTaps> gaussian_taps(SubPixel sigma);

inline namespace FOVEA_ISA {

/// Scratch bytes that gaussian() needs: a line, and a row of zeros.
constexpr std::int64_t gaussian_scratch(Size size);

/// Every pixel as the mean of its neighbourhood, weighed by a Gaussian of sigma pixels in both directions.
///
/// Shapes    src and dst equal, 1x1 or larger
/// Units     grey levels in and out; sigma in pixels
/// Rounding  to the nearest of a value that is within 1/4 of what the taps give: both directions are summed
///           in 1/128 of a level, each product rounded down and half of that put back. A flat image stays
///           what it is
/// Border    as border says
/// Overlap   none: dst must not share pixels with src
/// Scratch   gaussian_scratch(src.size()) bytes, undefined afterwards
/// Errors    empty_image, size_mismatch, bad_argument as gaussian_taps(), scratch_too_small
/// Source    book sec. 2.6.2; the toolkit's GaussianSmooth left out the last tap at the bottom, which
///           darkened the last rows
inline Status gaussian(ImageView<const Gray8> src, SubPixel sigma, Border border, Span<std::uint8_t> scratch,
                       ImageView<Gray8> dst);

// ---- Implementation ---------------------------------------------------------------

}  // namespace FOVEA_ISA

constexpr Result<GaussianTaps> gaussian_taps(SubPixel sigma) {
    if (sigma < min_gaussian_sigma || sigma > max_gaussian_sigma) return Status::bad_argument;
    const auto raw = static_cast<std::uint64_t>(sigma.raw());
    GaussianTaps taps;
    taps.reach = static_cast<int>((3 * raw + 255) / 256);
    std::uint64_t values[max_reach] = {};
    std::uint64_t sum = 0;
    for (int i = 0; i <= taps.reach; ++i) {
        // i^2 / (2 sigma^2) in 1/2^32; i^2 is below 2^10, and sigma in 1/256.
        const auto distance = static_cast<std::uint64_t>(i);
        const std::uint64_t square = distance * distance;
        values[i] = exponential_of_minus((square << 47) / (raw * raw));
        sum += i == 0 ? values[i] : 2 * values[i];
    }
    std::uint32_t outside = 0;
    for (int i = 1; i <= taps.reach; ++i) {
        taps.weight[i] = static_cast<std::uint16_t>((values[i] * 65536 + sum / 2) / sum);
        outside += 2u * taps.weight[i];
    }
    taps.weight[0] = static_cast<std::uint16_t>(65536 - outside);
    return taps;
}

inline namespace FOVEA_ISA {

namespace kernels {

/// The row kernel of gaussian().
class GaussianRow {
public:
    using Input = Gray8;
    using Output = Gray8;

    static constexpr std::int64_t scratch(int width) { return word_line_scratch(width); }

    GaussianRow() = default;
    GaussianRow(const GaussianTaps& taps, Border border, Span<std::uint8_t> scratch, int width)
        : taps_(taps), border_(border), line_(scratch.first(word_line_scratch(width)), width) {
        // As in FilterRow: no column beyond the end may carry into one that counts.
        std::memset(scratch.data(), 0, static_cast<std::size_t>(GaussianRow::scratch(width)));
    }

    int rows() const { return 2 * taps_.reach + 1; }

    void operator()(const RowWindow<Gray8>& window, Gray8* dst) {
        const int width = window.width();
        simd::for_each_vector(width, [&](int x, int count) {
            if (count == simd::lanes)
                down(window, x, [](const Gray8* row) { return simd::Bytes::load(row); });
            else
                down(window, x, [=](const Gray8* row) { return simd::Bytes::load(row, count); });
        });
        for (int i = 1; i <= taps_.reach; ++i) {
            const int left = border_index(border_, -i, width);
            const int right = border_index(border_, width - 1 + i, width);
            line_.set(-i, left == no_index ? std::uint16_t{0} : line_.value(left));
            line_.set(width - 1 + i, right == no_index ? std::uint16_t{0} : line_.value(right));
        }
        simd::for_each_vector(width, [&](int x, int count) {
            simd::Words sum = rest() + times_high(line_.at(x, 0), taps_.weight[0]);
            for (int i = 1; i <= taps_.reach; ++i)
                sum = sum + times_high(line_.at(x, -i) + line_.at(x, i), taps_.weight[i]);
            ((sum + simd::Words::all(64)) >> 7).narrow().store(dst + x, count);
        });
    }

private:
    /// Half of what the products of a sum lose by rounding down.
    simd::Words rest() const { return simd::Words::all(static_cast<std::uint16_t>((taps_.reach + 1) / 2)); }

    /// The sum of the rows in 1/128: at most 255 * 128 and rest(). Two pixels in 1/128 fit 16 bits.
    template <class Load>
    [[gnu::always_inline]] void down(const RowWindow<Gray8>& window, int x, Load load) {
        const int reach = taps_.reach;
        simd::Words sum = rest() + times_high(simd::Words(load(window[reach] + x)) << 7, taps_.weight[0]);
        for (int i = 1; i <= reach; ++i) {
            const simd::Words pair =
                simd::Words(load(window[reach - i] + x)) + simd::Words(load(window[reach + i] + x));
            sum = sum + times_high(pair << 7, taps_.weight[i]);
        }
        line_.put(x, sum);
    }

    GaussianTaps taps_;
    Border border_ = Border::replicate;
    simd::WordLine line_;
};

}  // namespace kernels

constexpr std::int64_t gaussian_scratch(Size size) {
    return size.width + kernels::GaussianRow::scratch(size.width);
}

inline Status gaussian(ImageView<const Gray8> src, SubPixel sigma, Border border, Span<std::uint8_t> scratch,
                       ImageView<Gray8> dst) {
    if (src.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    const Result<GaussianTaps> taps = gaussian_taps(sigma);
    if (!taps) return taps.status();
    if (scratch.size() < gaussian_scratch(src.size())) return Status::scratch_too_small;
    std::memset(scratch.data(), 0, static_cast<std::size_t>(src.width()));
    kernels::GaussianRow kernel(*taps, border, scratch.from(src.width()), src.width());
    for_each_row(src, border, kernel, dst, scratch.data());
    return Status::ok;
}

namespace stages {

/// gaussian() of the taps of a sigma.
struct gaussian {
    using Kernel = kernels::GaussianRow;
    using Input = Gray8;
    using Output = Gray8;
    GaussianTaps taps;

    constexpr bool valid() const { return taps.reach >= 0 && taps.reach < max_reach; }
    constexpr int rows() const { return 2 * taps.reach + 1; }
    static constexpr std::int64_t scratch(int width) { return Kernel::scratch(width); }
    Kernel kernel(Border border, Span<std::uint8_t> bytes, int width) const {
        return Kernel(taps, border, bytes, width);
    }
};

}  // namespace stages

}  // namespace FOVEA_ISA
}  // namespace fovea
