// SPDX-License-Identifier: MIT
//
// Colour from a sensor with a Bayer mosaic, where each pixel sees red, green or blue alone.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/status.hpp>
#include <fovea/image/border.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/simd/interleave.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>
#include <fovea/simd/mosaic.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The colours of the first two pixels of the first row, then of the second.
enum class BayerPattern : std::uint8_t { rggb, grbg, gbrg, bggr };

/// The size of an image that demosaic_half() makes.
constexpr Size half_size(Size size) { return {size.width / 2, size.height / 2}; }

inline namespace FOVEA_ISA {

/// The two colours that a pixel did not see, as the means of the nearest pixels that saw them: green of the
/// four beside a red or blue pixel, red and blue of the two beside a green one, blue of the four at the
/// corners of a red one and the other way round.
///
/// Shapes    src and dst equal, 2x2 or larger
/// Rounding  nearest, ties up; the largest sum is 4 * 255 + 2
/// Border    mirrored about the outermost pixels, which is where the nearest pixel of the same colour is; so
///           what the sensor saw at the border is kept
/// Overlap   none: dst must not share pixels with src
/// Errors    empty_image, size_mismatch, bad_argument for one column or one row, which lack a colour
/// Source    bilinear interpolation. The toolkit copies the border from the pixels next to it
inline Status demosaic(ImageView<const Gray8> src, BayerPattern pattern, ImageView<Rgb888> dst);

/// One colour of each 2x2 pixels: their red, the mean of their greens, their blue. A quarter of the memory of
/// demosaic(), and nothing is made up. A last odd column or row is left out.
///
/// Shapes    src 2x2 or larger, dst of half_size(src.size())
/// Rounding  nearest, ties up
/// Border    none
/// Others    as demosaic()
inline Status demosaic_half(ImageView<const Gray8> src, BayerPattern pattern, ImageView<Rgb888> dst);

// ---- Implementation ---------------------------------------------------------------

namespace kernels {

/// Which pixels of a row are not green, and which colour they are.
struct BayerRow {
    int coloured;  ///< 0 for even columns, 1 for odd ones
    bool red;
};

constexpr BayerRow bayer_row(BayerPattern pattern, int y) {
    const int red_column = pattern == BayerPattern::grbg || pattern == BayerPattern::bggr ? 1 : 0;
    const int red_row = pattern == BayerPattern::gbrg || pattern == BayerPattern::bggr ? 1 : 0;
    const bool red = y % 2 == red_row;
    return {red ? red_column : 1 - red_column, red};
}

/// A row of the mosaic between its neighbours.
struct BayerRows {
    const Gray8* above;
    const Gray8* here;
    const Gray8* below;
};

/// One pixel whose neighbours stand in the given columns.
inline Rgb888 demosaic_pixel(const BayerRows& rows, int left, int x, int right, BayerRow row) {
    const auto half = [](int a, int b) { return static_cast<std::uint8_t>((a + b + 1) >> 1); };
    const auto quarter = [](int sum) { return static_cast<std::uint8_t>((sum + 2) >> 2); };
    const std::uint8_t here = rows.here[x];
    std::uint8_t own = here;
    std::uint8_t green = here;
    std::uint8_t other = 0;
    if (x % 2 == row.coloured) {
        green = quarter(rows.here[left] + rows.here[right] + rows.above[x] + rows.below[x]);
        other = quarter(rows.above[left] + rows.above[right] + rows.below[left] + rows.below[right]);
    } else {
        own = half(rows.here[left], rows.here[right]);
        other = half(rows.above[x], rows.below[x]);
    }
    return row.red ? Rgb888{own, green, other} : Rgb888{other, green, own};
}

/// lanes pixels from column x on. All sums are written for all columns; of each, half is used, and compilers
/// leave the other half out.
template <bool EvenAreColoured, bool Red>
[[gnu::always_inline]] inline void demosaic_step(const BayerRows& rows, int x, Rgb888* dst) {
    using simd::Words;
    const auto at = [](const Gray8* row, int column) { return Words(simd::Bytes::load(row + column)); };
    const Words here = at(rows.here, x);
    const Words beside = at(rows.here, x - 1) + at(rows.here, x + 1);
    const Words upright = at(rows.above, x) + at(rows.below, x);
    const Words corners =
        at(rows.above, x - 1) + at(rows.above, x + 1) + at(rows.below, x - 1) + at(rows.below, x + 1);
    const Words cross = (beside + upright + Words::all(2)) >> 2;
    const Words diagonal = (corners + Words::all(2)) >> 2;
    const Words across = (beside + Words::all(1)) >> 1;
    const Words along = (upright + Words::all(1)) >> 1;
    const auto mix = [](const Words& coloured, const Words& green) {
        return (EvenAreColoured ? Words(coloured.even, green.odd) : Words(green.even, coloured.odd)).narrow();
    };
    const simd::Bytes own = mix(here, across);
    const simd::Bytes green = mix(cross, here);
    const simd::Bytes other = mix(diagonal, along);
    simd::store_triples(Red ? simd::ByteTriples{own, green, other} : simd::ByteTriples{other, green, own},
                        &dst[x].red);
}

/// All columns but the outermost two.
template <bool Red>
void demosaic_inside(const BayerRows& rows, int width, BayerRow row, Rgb888* dst) {
    constexpr int lanes = simd::lanes;
    int x = 1;
    if constexpr (simd::mosaic_runs) {
        const auto run = [&](int from, int count) {
            simd::demosaic_run<Red>({rows.above + from, rows.here + from, rows.below + from}, count,
                                    &dst[from].red);
            x = from + count;
        };
        // From a coloured pixel on.
        for (; x < width - 1 && x % 2 != row.coloured; ++x)
            dst[x] = demosaic_pixel(rows, x - 1, x, x + 1, row);
        const int first = x;
        run(first, (width - 1 - first) / lanes * lanes);
        // The last vector again, as far to the right as it goes.
        if (x > first && x < width - 2) run(width - 1 - lanes - (width - 1 - first) % 2, lanes);
    } else {
        if (row.coloured == 1)
            for (; x + lanes < width; x += lanes) demosaic_step<true, Red>(rows, x, dst);
        else
            for (; x + lanes < width; x += lanes) demosaic_step<false, Red>(rows, x, dst);
        if (x == width - 1) return;
        // The last vector again, as far to the right as it goes.
        if (width - 2 >= lanes) {
            x = width - 1 - lanes;
            if (x % 2 == row.coloured)
                demosaic_step<true, Red>(rows, x, dst);
            else
                demosaic_step<false, Red>(rows, x, dst);
            return;
        }
    }
    for (; x < width - 1; ++x) dst[x] = demosaic_pixel(rows, x - 1, x, x + 1, row);
}

/// demosaic() of one row, for rows that come one at a time.
inline void demosaic_row(const BayerRows& rows, int width, BayerRow row, Rgb888* dst) {
    dst[0] = demosaic_pixel(rows, 1, 0, 1, row);
    if (row.red)
        demosaic_inside<true>(rows, width, row, dst);
    else
        demosaic_inside<false>(rows, width, row, dst);
    dst[width - 1] = demosaic_pixel(rows, width - 2, width - 1, width - 2, row);
}

/// demosaic_half() of one row of dst. The rows of red and of blue; green is beside both.
inline void demosaic_half_row(const Gray8* red_row, const Gray8* blue_row, int width, int red_column,
                              Rgb888* dst) {
    constexpr int lanes = simd::lanes;
    const int blue_column = 1 - red_column;
    int x = 0;
    for (; x + lanes <= width; x += lanes) {
        const simd::BytePairs reds = simd::load_pairs(red_row + 2 * x);
        const simd::BytePairs blues = simd::load_pairs(blue_row + 2 * x);
        const simd::Bytes red = red_column == 0 ? reds.first : reds.second;
        const simd::Bytes blue = red_column == 0 ? blues.second : blues.first;
        const simd::Words greens = simd::Words(red_column == 0 ? reds.second : reds.first) +
                                   simd::Words(red_column == 0 ? blues.first : blues.second);
        simd::store_triples({red, ((greens + simd::Words::all(1)) >> 1).narrow(), blue}, &dst[x].red);
    }
    for (; x < width; ++x)
        dst[x] = {
            red_row[2 * x + red_column],
            static_cast<std::uint8_t>((red_row[2 * x + blue_column] + blue_row[2 * x + red_column] + 1) >> 1),
            blue_row[2 * x + blue_column]};
}

inline Status check_mosaic(ImageView<const Gray8> src, Size wanted, ImageView<const Rgb888> dst) {
    if (src.empty()) return Status::empty_image;
    if (dst.size() != wanted) return Status::size_mismatch;
    if (src.width() < 2 || src.height() < 2) return Status::bad_argument;
    return Status::ok;
}

}  // namespace kernels

inline Status demosaic(ImageView<const Gray8> src, BayerPattern pattern, ImageView<Rgb888> dst) {
    if (Status s = kernels::check_mosaic(src, src.size(), dst); s != Status::ok) return s;
    for (int y = 0; y < src.height(); ++y) {
        const auto row = [&](int number) {
            return src.row(border_index(Border::reflect_101, number, src.height()));
        };
        kernels::demosaic_row({row(y - 1), row(y), row(y + 1)}, src.width(), kernels::bayer_row(pattern, y),
                              dst.row(y));
    }
    return Status::ok;
}

inline Status demosaic_half(ImageView<const Gray8> src, BayerPattern pattern, ImageView<Rgb888> dst) {
    if (Status s = kernels::check_mosaic(src, half_size(src.size()), dst); s != Status::ok) return s;
    const kernels::BayerRow first = kernels::bayer_row(pattern, 0);
    for (int y = 0; y < dst.height(); ++y) {
        const Gray8* upper = src.row(2 * y);
        const Gray8* lower = src.row(2 * y + 1);
        kernels::demosaic_half_row(first.red ? upper : lower, first.red ? lower : upper, dst.width(),
                                   first.red ? first.coloured : 1 - first.coloured, dst.row(y));
    }
    return Status::ok;
}

}  // namespace FOVEA_ISA
}  // namespace fovea
