// SPDX-License-Identifier: MIT
//
// Moments of all pixels of a binary image that are not 0, up to the third order, in exact integers: of an
// image, or row by row at the end of a stream. Book sec. 6.2.1, eq. 6.1.
#pragma once

#include <cstdint>
#include <cstring>

#include <fovea/base/assert.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/simd/dots.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>
#include <fovea/statistics/moments.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

inline namespace FOVEA_ISA {

/// Adds up the moments of the pixels that are not 0. An accumulator: it takes the rows of an image in any
/// order, a strip of an image its rows alone; merge() joins strips.
///
/// Units   pixels of the whole image, sides up to max_moment_side
/// Errors  of begin(): empty_image, image_too_large, with the sums untouched
/// Source  book eq. 6.1
class BinaryMoments {
public:
    using Input = Gray8;

    /// Begins anew.
    Status begin(Size size);
    /// Adds row y of width pixels.
    void add_row(const Gray8* row, int width, int y);
    /// Adds what another one found in other rows of the same image.
    void merge(const BinaryMoments& other) { moments_.add(other.moments_); }
    const Moments& moments() const { return moments_; }

private:
    Moments moments_;
};

/// The moments of the pixels of an image that are not 0. An image without such pixels has moments of 0.
///
/// Shapes    src 1x1 or larger, sides up to max_moment_side
/// Rounding  none
/// Errors    empty_image, image_too_large
/// Source    book eq. 6.1
inline Result<Moments> moments_of(ImageView<const Gray8> src);

}  // namespace FOVEA_ISA

// ---- Implementation ---------------------------------------------------------------

inline namespace FOVEA_ISA {
namespace kernels {

/// Sums of x^0, x^1, x^2 and x^3 over the pixels of a row that are not 0.
struct RowPowers {
    std::int64_t sum[4] = {};
};

/// Vectors of a row that are summed up in one go: 22 * 23 / 2 fits a byte.
inline constexpr int moment_vectors = 22;

/// The columns c of a vector raised to a power, as Words holds them.
struct ColumnPowers {
    std::uint16_t of[3][simd::lanes];
};
constexpr ColumnPowers column_powers() {
    ColumnPowers powers{};
    for (int i = 0; i < simd::lanes; ++i) {
        const int column = i < simd::lanes / 2 ? 2 * i : 2 * (i - simd::lanes / 2) + 1;
        powers.of[0][i] = 1;
        powers.of[1][i] = static_cast<std::uint16_t>(column);
        powers.of[2][i] = static_cast<std::uint16_t>(column * column);
    }
    return powers;
}
inline constexpr ColumnPowers moment_columns = column_powers();

[[gnu::always_inline]] inline simd::Words column_weights(int power) {
    simd::Words words;
    std::memcpy(&words.even, moment_columns.of[power], sizeof words.even);
    std::memcpy(&words.odd, moment_columns.of[power] + simd::lanes / 2, sizeof words.odd);
    return words;
}
[[gnu::always_inline]] inline simd::RawSums products(simd::Words a, simd::Words b) {
    return simd::pair_products(a.even, b.even) + simd::pair_products(a.odd, b.odd);
}

/// Adds the pixels of count vectors, the last of them rest pixels long, from column x on.
inline void add_vectors(const Gray8* row, int x, int count, int rest, RowPowers& powers) {
    using simd::Bytes;
    using simd::Words;
    // From right to left every vector is added to the first sum, that to the second, and so on. So a pixel of
    // vector r = 1, 2, ... counts 1, r, r (r + 1) / 2 and r (r + 1) (r + 2) / 6 times: at most 22, 253, 2024
    // and 12650 in all. That multiplies by r without a product.
    const Bytes one = Bytes::all(1);
    Bytes zeroth = lower(Bytes::load(row + (count - 1) * simd::lanes, rest), one);
    Bytes first = zeroth;
    Words second(first);
    Words third = second;
    for (int i = count - 2; i >= 0; --i) {
        zeroth = zeroth + lower(Bytes::load(row + i * simd::lanes), one);
        first = first + zeroth;
        second = second + Words(first);
        third = third + second;
    }

    // Then over the columns c of a vector, c < 64: sums of c^i r^k, all below 2^27.
    const Words ones = column_weights(0);
    const Words c = column_weights(1);
    const Words cc = column_weights(2);
    const Words n_of(zeroth);
    const Words c_of = n_of * c;
    const Words r_of(first);
    std::uint32_t totals[12];
    const simd::RawSums none{};
    simd::totals_of(products(n_of, ones), products(c_of, ones), products(c_of, c), products(c_of, cc),
                    totals);
    simd::totals_of(products(r_of, ones), products(r_of, c), products(r_of, cc), products(second, ones),
                    totals + 4);
    simd::totals_of(products(second, c), products(third, ones), none, none, totals + 8);
    const std::int64_t n = totals[0];
    const std::int64_t c1 = totals[1];
    const std::int64_t c2 = totals[2];
    const std::int64_t c3 = totals[3];
    const std::int64_t r1 = totals[4];
    const std::int64_t r1_c1 = totals[5];
    const std::int64_t r1_c2 = totals[6];
    const std::int64_t r2 = std::int64_t{2} * totals[7] - r1;
    const std::int64_t r2_c1 = std::int64_t{2} * totals[8] - r1_c1;
    const std::int64_t r3 = 6 * (std::int64_t{totals[9]} - totals[7]) + r1;

    // The column within the row is origin + lanes r + c.
    constexpr std::int64_t lanes = simd::lanes;
    const std::int64_t origin = x - lanes;
    const std::int64_t u1 = lanes * r1 + c1;
    const std::int64_t u2 = lanes * (lanes * r2 + 2 * r1_c1) + c2;
    const std::int64_t u3 = lanes * (lanes * (lanes * r3 + 3 * r2_c1) + 3 * r1_c2) + c3;
    powers.sum[0] += n;
    powers.sum[1] += u1 + origin * n;
    powers.sum[2] += u2 + origin * (2 * u1 + origin * n);
    powers.sum[3] += u3 + origin * (3 * u2 + origin * (3 * u1 + origin * n));
}

inline RowPowers row_powers(const Gray8* row, int width) {
    RowPowers powers;
    constexpr int stretch = moment_vectors * simd::lanes;
    for (int x = 0; x < width; x += stretch) {
        const int pixels = minimum(width - x, stretch);
        const int vectors = (pixels + simd::lanes - 1) / simd::lanes;
        add_vectors(row + x, x, vectors, pixels - (vectors - 1) * simd::lanes, powers);
    }
    return powers;
}

}  // namespace kernels

inline Status BinaryMoments::begin(Size size) {
    if (size.empty()) return Status::empty_image;
    if (size.width > max_moment_side || size.height > max_moment_side) return Status::image_too_large;
    moments_ = {};
    return Status::ok;
}

inline void BinaryMoments::add_row(const Gray8* row, int width, int y) {
    FOVEA_ASSERT(width <= max_moment_side && y >= 0 && y < max_moment_side);
    const kernels::RowPowers x = kernels::row_powers(row, width);
    const std::int64_t v = y;
    Moments& m = moments_;
    m.m00 += x.sum[0];
    m.m10 += x.sum[1];
    m.m20 += x.sum[2];
    m.m30 += x.sum[3];
    m.m01 += v * x.sum[0];
    m.m11 += v * x.sum[1];
    m.m21 += v * x.sum[2];
    m.m02 += v * v * x.sum[0];
    m.m12 += v * v * x.sum[1];
    m.m03 += v * v * v * x.sum[0];
}

inline Result<Moments> moments_of(ImageView<const Gray8> src) {
    BinaryMoments sums;
    if (const Status s = sums.begin(src.size()); s != Status::ok) return s;
    for (int y = 0; y < src.height(); ++y) sums.add_row(src.row(y), src.width(), y);
    return sums.moments();
}

}  // namespace FOVEA_ISA

}  // namespace fovea
