// SPDX-License-Identifier: MIT
//
// A colour learned from samples: mean and covariance of red, green and blue, and the pixels that are near in
// units of that spread. Book sec. 2.8.2.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/pixelwise/convert_frame.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The most samples that ColourModelSums takes, so that the products of its sums fit 64 bits.
inline constexpr std::int64_t max_colour_samples = 1 << 20;

/// A Gaussian in red, green and blue.
struct ColourModel {
    static constexpr int mean_bits = 4;      ///< the means are in 1/16 level
    static constexpr int inverse_bits = 24;  ///< the inverse covariance is in 2^-24 of 1/level^2

    std::int16_t mean[3];
    /// Of the symmetric inverse: red red, green green, blue blue, red green, red blue, green blue.
    std::int32_t inverse[6];

    /// The squared distance from the mean in standard deviations (Mahalanobis), in 1/65536; at most 2^32 - 1.
    constexpr std::uint32_t distance_squared(Rgb888 colour) const;
};

/// The sums that a ColourModel is learned from.
class ColourModelSums {
public:
    /// Takes a sample, up to max_colour_samples; more are left out.
    constexpr void add(Rgb888 colour);
    constexpr std::int64_t count() const { return count_; }

    /// Mean and inverse covariance of the samples. A spread of less than a level counts as a level: a
    /// variance of 1 is added to each colour, so that samples of one colour, or on a line, have an inverse
    /// too.
    ///
    /// Rounding  nearest, ties up
    /// Errors    not_found for fewer than two samples
    /// Source    the toolkit's CRGBColorModel, whose covariance divides by count - 1 too but whose inverse
    ///           does not exist for such samples
    constexpr Result<ColourModel> model() const;

private:
    std::int64_t count_ = 0;
    std::int64_t sum_[3] = {};
    std::int64_t product_[6] = {};
};

/// A model of all pixels of an image; crop() tells which.
///
/// Shapes  1x1 or larger
/// Errors  empty_image, image_too_large above max_colour_samples pixels, not_found for one pixel
/// Source  as ColourModelSums
inline Result<ColourModel> learn_colour(ImageView<const Rgb888> samples);

/// 255 where a pixel's squared distance from the model is at most the given one, else 0.
///
/// Shapes   src and dst equal, 1x1 or larger
/// Units    the limit in 1/65536: 9 << 16 for three standard deviations. -2 ln p of the toolkit's limit p
/// Overlap  none: dst must not share pixels with src
/// Errors   empty_image, size_mismatch
/// Source   book sec. 2.8.2; the toolkit's FilterRGB() takes an exponential for every pixel
inline Status colour_model_range(ImageView<const Rgb888> src, const ColourModel& model, std::uint32_t limit,
                                 ImageView<Gray8> dst);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

// Which two colours each entry of a symmetric matrix belongs to.
inline constexpr int first_of_six[6] = {0, 1, 2, 0, 0, 1};
inline constexpr int second_of_six[6] = {0, 1, 2, 1, 2, 2};

/// Covariances are in 1/64 level^2: at most 255^2 / 2, of two samples, and 1.
inline constexpr int covariance_bits = 6;

/// Of a covariance whose smallest spread is about a level: its inverse in 2^-24 of 1/level^2.
///
/// A cofactor has 43 bits and a sign. The determinant is at most the product of the variances, which is below
/// 2^63; on the way its sum may leave 63 bits, so it is taken modulo 2^64. No entry of the inverse is above
/// 1.1 of 1/level^2, so a cofactor times 2^(24 + 6) fits once the determinant has 38 bits.
constexpr void invert_covariance(const std::int64_t (&c)[6], std::int32_t (&inverse)[6]) {
    const std::int64_t cofactor[6] = {c[1] * c[2] - c[5] * c[5], c[0] * c[2] - c[4] * c[4],
                                      c[0] * c[1] - c[3] * c[3], c[4] * c[5] - c[3] * c[2],
                                      c[3] * c[5] - c[4] * c[1], c[3] * c[4] - c[5] * c[0]};
    const auto product = [](std::int64_t a, std::int64_t b) {
        return static_cast<std::uint64_t>(a) * static_cast<std::uint64_t>(b);
    };
    const std::uint64_t determinant =
        product(c[0], cofactor[0]) + product(c[3], cofactor[3]) + product(c[4], cofactor[4]);
    const int shift = maximum(0, 64 - leading_zeros(determinant) - 38);
    const auto whole = static_cast<std::int64_t>(determinant >> shift);
    for (int i = 0; i < 6; ++i) {
        constexpr std::int64_t unit = std::int64_t{1} << (ColourModel::inverse_bits + covariance_bits);
        inverse[i] = static_cast<std::int32_t>(round_divide(round_shift(cofactor[i], shift) * unit, whole));
    }
}

}  // namespace detail

constexpr std::uint32_t ColourModel::distance_squared(Rgb888 colour) const {
    // Differences of 13 bits, a sum of 9 products below 2^(25 + 26), never negative but by rounding.
    const std::int64_t d[3] = {colour.red * (1 << mean_bits) - mean[0],
                               colour.green * (1 << mean_bits) - mean[1],
                               colour.blue * (1 << mean_bits) - mean[2]};
    const std::int64_t sum = d[0] * (inverse[0] * d[0] + 2 * (inverse[3] * d[1] + inverse[4] * d[2])) +
                             d[1] * (inverse[1] * d[1] + 2 * inverse[5] * d[2]) + inverse[2] * d[2] * d[2];
    return saturate_cast<std::uint32_t>(round_shift(sum, 2 * mean_bits + inverse_bits - 16));
}

constexpr void ColourModelSums::add(Rgb888 colour) {
    if (count_ == max_colour_samples) return;
    const std::int64_t level[3] = {colour.red, colour.green, colour.blue};
    ++count_;
    for (int i = 0; i < 3; ++i) sum_[i] += level[i];
    for (int i = 0; i < 6; ++i)
        product_[i] += level[detail::first_of_six[i]] * level[detail::second_of_six[i]];
}

constexpr Result<ColourModel> ColourModelSums::model() const {
    if (count_ < 2) return Status::not_found;
    ColourModel model{};
    for (int i = 0; i < 3; ++i)
        model.mean[i] = static_cast<std::int16_t>(
            round_divide(sum_[i] * (std::int64_t{1} << ColourModel::mean_bits), count_));
    std::int64_t covariance[6] = {};
    constexpr std::int64_t level = std::int64_t{1} << detail::covariance_bits;
    for (int i = 0; i < 6; ++i) {
        // The count has 21 bits, a sum of products 36, their difference 55 and with the unit 61.
        const std::int64_t spread =
            count_ * product_[i] - sum_[detail::first_of_six[i]] * sum_[detail::second_of_six[i]];
        covariance[i] = round_divide(spread * level, count_ * (count_ - 1)) + (i < 3 ? level : 0);
    }
    detail::invert_covariance(covariance, model.inverse);
    return model;
}

inline Result<ColourModel> learn_colour(ImageView<const Rgb888> samples) {
    if (samples.empty()) return Status::empty_image;
    if (samples.size().area() > max_colour_samples) return Status::image_too_large;
    ColourModelSums sums;
    for (int y = 0; y < samples.height(); ++y)
        for (int x = 0; x < samples.width(); ++x) sums.add(samples(x, y));
    return sums.model();
}

inline Status colour_model_range(ImageView<const Rgb888> src, const ColourModel& model, std::uint32_t limit,
                                 ImageView<Gray8> dst) {
    return detail::convert_frame(src, dst, [&](const Rgb888* from, int width, Gray8* to) {
        for (int x = 0; x < width; ++x) to[x] = model.distance_squared(from[x]) <= limit ? 255 : 0;
    });
}

}  // namespace fovea
