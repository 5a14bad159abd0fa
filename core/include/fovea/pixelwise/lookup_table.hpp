// SPDX-License-Identifier: MIT
//
// Look-up tables: any function of a grey level, made when the program is compiled or at run time. Book
// sec. 2.4, 2.12.7.
#pragma once

#include <cstdint>

#include <fovea/base/assert.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/pixelwise/point_rows.hpp>
#include <fovea/simd/backend.hpp>
#include <fovea/simd/halves.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>
#include <fovea/simd/lookup.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// A grey level for each of the 256 grey levels.
struct LookupTable {
    Gray8 levels[256] = {};

    constexpr Gray8 operator[](int level) const {
        FOVEA_ASSERT(level >= 0 && level < 256);
        return levels[level];
    }
};

/// scale x + offset, held at 0 and 255.
///
/// Rounding  nearest, ties up; 64 bits inside, so that no scale overflows
/// Source    book sec. 2.4; the toolkit's affine point operation
constexpr LookupTable affine_table(Ratio scale, GrayLevel offset);

/// The map that takes low to 0 and high to 255, in a straight line between them. Of low and below it is 0, of
/// high and above 255; where low is not below high, 0 up to low and 255 above it.
///
/// Rounding  nearest, ties up
constexpr LookupTable stretch_table(Gray8 low, Gray8 high);

/// The exponents that gamma_table() knows, in 1/100.
inline constexpr int min_gamma = 1;
inline constexpr int max_gamma = 1000;

/// 255 (x / 255)^(gamma / 100): below 100 dark levels are spread, above 100 bright ones. 0 and 255 stay.
///
/// Units     gamma in 1/100, held at min_gamma and max_gamma
/// Rounding  nearest, of logarithms to 2^-24: a level can differ from the rounded real value only where that
///           is within gamma / 10^6 of a half. All tables were compared with real powers and none differs
/// Source    book sec. 2.12.7 recommends tables
constexpr LookupTable gamma_table(int gamma);

/// 255 log(1 + x) / log 256: spreads dark levels most. 0 and 255 stay.
///
/// Rounding  nearest, as gamma_table()
constexpr LookupTable logarithm_table();

/// The bounds of affine() and amplify(): with the offset any level can be brought to 0 or 255 at the largest
/// scale.
inline constexpr int max_affine_scale = 100;
inline constexpr int max_affine_offset = 255 * max_affine_scale;

inline namespace FOVEA_ISA {

/// The level that the table has for each pixel.
///
/// Shapes   src and dst equal, 1x1 or larger
/// Overlap  dst may be src; neither may hold the table
/// Errors   empty_image, size_mismatch
/// Source   book sec. 2.12.7
inline Status apply_lut(ImageView<const Gray8> src, const LookupTable& table, ImageView<Gray8> dst);

/// affine_table() applied: scale x + offset, held at 0 and 255. All else as apply_lut().
///
/// Errors  also bad_argument for a scale beyond max_affine_scale or an offset beyond max_affine_offset to
///         either side
inline Status affine(ImageView<const Gray8> src, Ratio scale, GrayLevel offset, ImageView<Gray8> dst);

/// scale x, held at 0 and 255. All else as affine().
inline Status amplify(ImageView<const Gray8> src, Ratio scale, ImageView<Gray8> dst);

/// gamma_table() applied. All else as apply_lut().
///
/// Errors  also bad_argument for a gamma out of range
inline Status gamma(ImageView<const Gray8> src, int gamma, ImageView<Gray8> dst);

/// logarithm_table() applied. All else as apply_lut().
inline Status logarithm(ImageView<const Gray8> src, ImageView<Gray8> dst);

}  // namespace FOVEA_ISA

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// log2(n) in 2^-26, n > 0: the leading bit, then one bit of the fraction a squaring. The mantissa has 31
/// bits and loses less than 2^-31 of itself a squaring, which the halving weights of the bits add up to less
/// than 2^-26.
constexpr std::uint32_t log2_of(std::uint32_t n) {
    const int whole = 31 - leading_zeros(n);
    std::uint64_t mantissa = std::uint64_t{n} << (31 - whole);  // 2^31 up to 2^32
    auto log = static_cast<std::uint32_t>(whole);
    for (int i = 0; i < 26; ++i) {
        mantissa = mantissa * mantissa >> 31;
        const bool carried = mantissa >> 32 != 0;
        mantissa >>= carried ? 1 : 0;
        log = log << 1 | (carried ? 1u : 0u);
    }
    return log;
}

/// Logarithms of 0 to 510, the first one unused: of levels and of the halves between them.
struct Log2Table {
    std::uint32_t of[511] = {};
};
constexpr Log2Table make_log2_table() {
    Log2Table table;
    for (std::uint32_t n = 1; n <= 510; ++n) table.of[n] = log2_of(n);
    return table;
}
inline constexpr Log2Table log2_table = make_log2_table();

/// The largest scale whose products and offsets fit 32 bits: 2 (60 + 1) 2^16 255 is below 2^31.
inline constexpr Ratio max_product_scale = Ratio::from_int(60);

/// (scale x + offset) / 2^16, held at 0 and 255.
inline void affine_row(const Gray8* src, int width, std::int32_t scale, std::int32_t offset, Gray8* dst) {
    for (int x = 0; x < width; ++x)
        dst[x] = static_cast<Gray8>(clamp<std::int32_t>((scale * src[x] + offset) >> 16, 0, 255));
}

}  // namespace detail

constexpr LookupTable affine_table(Ratio scale, GrayLevel offset) {
    LookupTable table;
    for (int x = 0; x < 256; ++x)
        table.levels[x] = saturate_cast<Gray8>(
            round_shift(std::int64_t{scale.raw()} * x + offset.raw(), Ratio::fraction_bits));
    return table;
}

constexpr LookupTable stretch_table(Gray8 low, Gray8 high) {
    LookupTable table;
    for (int x = 0; x < 256; ++x)
        table.levels[x] = x <= low    ? Gray8{0}
                          : x >= high ? Gray8{255}
                                      : static_cast<Gray8>(round_divide(255 * (x - low), high - low));
    return table;
}

constexpr LookupTable gamma_table(int gamma) {
    const int power = clamp(gamma, min_gamma, max_gamma);
    // A level is at least y if log(2 y - 1) - log(510) <= power / 100 (log(2 x) - log(510)).
    const auto& log = detail::log2_table.of;
    LookupTable table;
    int y = 0;
    for (int x = 1; x < 256; ++x) {
        const std::int64_t depth = std::int64_t{power} * (log[510] - log[2 * x]);
        while (y < 255 && std::int64_t{100} * (log[510] - log[2 * y + 1]) >= depth) ++y;
        table.levels[x] = static_cast<Gray8>(y);
    }
    return table;
}

constexpr LookupTable logarithm_table() {
    LookupTable table;
    // log2(256) = 8, so that 255 / 8 of the logarithm is wanted.
    for (int x = 0; x < 256; ++x)
        table.levels[x] =
            static_cast<Gray8>(round_shift(std::int64_t{255} * detail::log2_table.of[x + 1], 26 + 3));
    return table;
}

inline namespace FOVEA_ISA {

inline Status apply_lut(ImageView<const Gray8> src, const LookupTable& table, ImageView<Gray8> dst) {
    if (src.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    const simd::Lookup lookup(table.levels);
    const Size rows = detail::rows_of(src.size(), src, dst);
    for (int y = 0; y < rows.height; ++y) lookup.row(src.row(y), rows.width, dst.row(y));
    return Status::ok;
}

namespace kernels {

/// affine_row() in vectors, faster than a table: whole and part are the numbers above and below 2^16. Nothing
/// leaves 16 bits with a sign: 60 * 255 of the scale, and of the offset not 3 * 255 more.
struct Affine {
    std::int16_t scale_whole;
    std::uint16_t scale_part;
    std::uint16_t offset_whole;
    std::uint16_t offset_part;

    Affine(std::int32_t scale, std::int32_t offset)
        : scale_whole(static_cast<std::int16_t>(scale >> 16)),
          scale_part(static_cast<std::uint16_t>(scale & 0xffff)),
          offset_whole(static_cast<std::uint16_t>(offset >> 16)),
          offset_part(static_cast<std::uint16_t>(offset & 0xffff)) {}

    [[gnu::always_inline]] simd::Bytes operator()(simd::Bytes pixels) const {
        const simd::SplitWords x = simd::split(pixels);
        return simd::joined_held({of_words(x.first), of_words(x.second)});
    }
    [[gnu::always_inline]] simd::RawWords of_words(simd::RawWords x) const {
        const simd::RawWords below = simd::times(x, scale_part);
        // One more, and one less where the parts do not carry.
        const simd::RawWords no_carry =
            simd::at_least_words(simd::plus(below, simd::all_words(offset_part)), below);
        const simd::RawWords parts = simd::plus(simd::times_high(x, scale_part), no_carry);
        const auto offset = static_cast<std::uint16_t>(offset_whole + 1);
        return simd::plus(simd::plus(simd::times_signed(x, scale_whole), parts), simd::all_words(offset));
    }
};

}  // namespace kernels

inline Status affine(ImageView<const Gray8> src, Ratio scale, GrayLevel offset, ImageView<Gray8> dst) {
    constexpr Ratio most = Ratio::from_int(max_affine_scale);
    constexpr GrayLevel farthest = GrayLevel::from_int(max_affine_offset);
    if (src.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    if (scale > most || scale < -most || offset > farthest || offset < -farthest) return Status::bad_argument;
    if (scale > detail::max_product_scale || scale < -detail::max_product_scale)
        return apply_lut(src, affine_table(scale, offset), dst);
    // Beyond this the offset alone makes every level 0 or 255.
    const std::int32_t enough = (maximum(scale.raw(), -scale.raw()) + (2 << 16)) * 255;
    const std::int32_t rounded = clamp(offset.raw() + (1 << 15), -enough, enough);
    if constexpr (simd::lanes > 4)
        return kernels::point_frame(src, kernels::Affine(scale.raw(), rounded), dst);
    for (int y = 0; y < src.height(); ++y)
        detail::affine_row(src.row(y), src.width(), scale.raw(), rounded, dst.row(y));
    return Status::ok;
}

inline Status amplify(ImageView<const Gray8> src, Ratio scale, ImageView<Gray8> dst) {
    return affine(src, scale, GrayLevel(), dst);
}

inline Status gamma(ImageView<const Gray8> src, int gamma, ImageView<Gray8> dst) {
    if (src.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    if (gamma < min_gamma || gamma > max_gamma) return Status::bad_argument;
    return apply_lut(src, gamma_table(gamma), dst);
}

inline Status logarithm(ImageView<const Gray8> src, ImageView<Gray8> dst) {
    static constexpr LookupTable table = logarithm_table();
    return apply_lut(src, table, dst);
}

}  // namespace FOVEA_ISA
}  // namespace fovea
