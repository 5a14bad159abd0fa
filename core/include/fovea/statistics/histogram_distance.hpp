// SPDX-License-Identifier: MIT
//
// How alike two histograms are, whatever the count of pixels behind them. Book ch. 7.
#pragma once

#include <cstdint>

#include <fovea/base/status.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------
//
// p and q are the shares of the bins: counts divided by their sum. A histogram is anything with size() and
// [bin] that answers a count below 2^32: Histogram, HueSaturationHistogram, Span<const std::uint32_t>.

/// The most bins of a histogram that is compared.
inline constexpr int max_compared_bins = 65536;

/// The sum of min(p, q): 1 for equal shares, 0 where no bin is in both.
///
/// Rounding  shares to 2^-40, the result to the nearest of 1/65536, ties up: with 256 bins off by a unit only
///           where the true value is within 2^-16 of a unit of a half
/// Errors    empty_image if one has no pixel, size_mismatch for different bins, bad_argument above
///           max_compared_bins
/// Source    Swain, Ballard, "Color Indexing", IJCV 7(1), 1991
template <class First, class Second>
constexpr Result<Ratio> histogram_intersection(const First& a, const Second& b);

/// The sum of |p - q|: 0 for equal shares, 2 where no bin is in both. All else as histogram_intersection().
template <class First, class Second>
constexpr Result<Ratio> histogram_difference(const First& a, const Second& b);

/// The sum of (p - q)^2 / (p + q): 0 for equal shares, 2 where no bin is in both; a bin counts more the fewer
/// pixels it has. All else as histogram_intersection(), but shares are rounded to 2^-31.
template <class First, class Second>
constexpr Result<Ratio> chi_square_distance(const First& a, const Second& b);

/// sqrt(1 - sum of sqrt(p q)), the distance of Bhattacharyya in the form of Hellinger: 0 for equal shares, 1
/// where no bin is in both.
///
/// Rounding  shares and their roots to 2^-30, the result down to 1/65536: within 2 units of the true value
/// Others    as histogram_intersection()
/// Source    1 - sum of sqrt(p q) is half the sum of (sqrt p - sqrt q)^2, which is exactly 0 for equal shares
template <class First, class Second>
constexpr Result<Ratio> bhattacharyya_distance(const First& a, const Second& b);

/// How far the pixels of one must be moved on the average to give the other, in bins: the sum of the
/// differences of the shares up to each bin. For bins in a row, as of grey levels.
///
/// Rounding  shares up to a bin to 2^-40, the result to the nearest of 1/65536, ties up
/// Errors    also bad_argument above 32768 bins, where the distance could exceed its format
/// Others    as histogram_intersection()
/// Source    Rubner, Tomasi, Guibas, "The Earth Mover's Distance as a Metric for Image Retrieval", IJCV
///           40(2), 2000; in one dimension it is this sum
template <class First, class Second>
constexpr Result<GrayLevel> earth_movers_distance(const First& a, const Second& b);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Shares of count / total in 2^-bits to the nearest, total up to 2^48, count <= total, bits up to 40.
constexpr std::int64_t share_of(std::uint64_t count, std::uint64_t total, int bits) {
    // In two steps, so that no shift overflows: total is brought below 2^32 first where it is not.
    const int drop = maximum(32 - leading_zeros(total), 0);
    const std::uint64_t divisor = total >> drop;
    const std::uint64_t first = ((count >> drop) << 20) / divisor;
    const std::uint64_t left = ((count >> drop) << 20) % divisor;
    const int more = bits - 20;
    return static_cast<std::int64_t>((first << more) + ((left << more) + divisor / 2) / divisor);
}

template <class Bins>
constexpr std::uint64_t total_of(const Bins& histogram) {
    std::uint64_t total = 0;
    const auto size = static_cast<int>(histogram.size());
    for (int i = 0; i < size; ++i) total += histogram[i];
    return total;
}

template <class First, class Second>
constexpr Status check_histograms(const First& a, const Second& b, int most_bins) {
    if (total_of(a) == 0 || total_of(b) == 0) return Status::empty_image;
    if (a.size() != b.size()) return Status::size_mismatch;
    return a.size() > most_bins ? Status::bad_argument : Status::ok;
}

/// visit(p, q) for every bin, shares in 2^-bits.
template <class First, class Second, class Visit>
constexpr Status for_each_share(const First& a, const Second& b, int bits, Visit visit) {
    if (const Status s = check_histograms(a, b, max_compared_bins); s != Status::ok) return s;
    const std::uint64_t total_a = total_of(a);
    const std::uint64_t total_b = total_of(b);
    const auto size = static_cast<int>(a.size());
    for (int i = 0; i < size; ++i) visit(share_of(a[i], total_a, bits), share_of(b[i], total_b, bits));
    return Status::ok;
}

constexpr Ratio ratio_of(std::int64_t sum, int bits) {
    return Ratio::from_raw(static_cast<std::int32_t>(round_shift(sum, bits - 16)));
}

}  // namespace detail

template <class First, class Second>
constexpr Result<Ratio> histogram_intersection(const First& a, const Second& b) {
    std::int64_t sum = 0;
    const Status s =
        detail::for_each_share(a, b, 40, [&](std::int64_t p, std::int64_t q) { sum += minimum(p, q); });
    if (s != Status::ok) return s;
    return detail::ratio_of(sum, 40);
}

template <class First, class Second>
constexpr Result<Ratio> histogram_difference(const First& a, const Second& b) {
    std::int64_t sum = 0;
    const Status s = detail::for_each_share(
        a, b, 40, [&](std::int64_t p, std::int64_t q) { sum += maximum(p, q) - minimum(p, q); });
    if (s != Status::ok) return s;
    return detail::ratio_of(sum, 40);
}

template <class First, class Second>
constexpr Result<Ratio> chi_square_distance(const First& a, const Second& b) {
    std::int64_t sum = 0;
    const Status s = detail::for_each_share(a, b, 31, [&](std::int64_t p, std::int64_t q) {
        // At most (2^31)^2, which fits.
        if (p + q > 0) sum += round_divide((p - q) * (p - q), p + q);
    });
    if (s != Status::ok) return s;
    return detail::ratio_of(sum, 31);
}

template <class First, class Second>
constexpr Result<Ratio> bhattacharyya_distance(const First& a, const Second& b) {
    // Squares of differences of roots, each up to 2^60; with the shares they add up to at most 2^61.
    std::uint64_t sum = 0;
    const Status s = detail::for_each_share(a, b, 30, [&](std::int64_t p, std::int64_t q) {
        const std::int64_t step = std::int64_t{isqrt(static_cast<std::uint64_t>(p) << 30)} -
                                  std::int64_t{isqrt(static_cast<std::uint64_t>(q) << 30)};
        sum += static_cast<std::uint64_t>(step * step);
    });
    if (s != Status::ok) return s;
    return Ratio::from_raw(static_cast<std::int32_t>(isqrt(sum / 2) >> 14));
}

template <class First, class Second>
constexpr Result<GrayLevel> earth_movers_distance(const First& a, const Second& b) {
    constexpr int most_bins = 32768;
    if (const Status s = detail::check_histograms(a, b, most_bins); s != Status::ok) return s;
    // The counts up to each bin, so that roundings do not add up. 2^15 bins of 2^40 are 2^55.
    const std::uint64_t total_a = detail::total_of(a);
    const std::uint64_t total_b = detail::total_of(b);
    std::uint64_t up_to_a = 0;
    std::uint64_t up_to_b = 0;
    std::int64_t sum = 0;
    const auto size = static_cast<int>(a.size());
    for (int i = 0; i < size; ++i) {
        up_to_a += a[i];
        up_to_b += b[i];
        const std::int64_t p = detail::share_of(up_to_a, total_a, 40);
        const std::int64_t q = detail::share_of(up_to_b, total_b, 40);
        sum += maximum(p, q) - minimum(p, q);
    }
    return GrayLevel::from_raw(static_cast<std::int32_t>(round_shift(sum, 24)));
}

}  // namespace fovea
