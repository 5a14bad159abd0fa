// SPDX-License-Identifier: MIT
//
// Golden vectors of pixelwise/ and statistics/ beyond the catalogue: numbers, tables and lists instead of
// images.
#pragma once

#include <cstdint>

#include <fovea/pixelwise/copy.hpp>
#include <fovea/pixelwise/lookup_table.hpp>
#include <fovea/statistics/binary_moments.hpp>
#include <fovea/statistics/clahe.hpp>
#include <fovea/statistics/colour_histogram.hpp>
#include <fovea/statistics/equalize.hpp>
#include <fovea/statistics/histogram.hpp>
#include <fovea/statistics/histogram_distance.hpp>
#include <fovea/statistics/hu_moments.hpp>
#include <fovea/statistics/integral_image.hpp>
#include <fovea/statistics/projection.hpp>
#include <fovea/statistics/reductions.hpp>
#include <golden/digest.hpp>
#include <golden/workspace.hpp>

namespace fovea::golden {

inline void put(Digest& digest, const LookupTable& table) { digest.add(Span<const Gray8>(table.levels)); }
template <class Pixel>
void put(Digest& digest, const Extremes<Pixel>& extremes) {
    digest.add(extremes.lowest, extremes.highest);
}
inline void put(Digest& digest, const MeanAndVariance& found) { digest.add(found.mean, found.variance); }

/// Random numbers of the machine in every pixel.
template <class Pixel>
ImageView<Pixel> random_numbers(Workspace& work, int number, Size size, Random& random) {
    const ImageView<Pixel> image = work.view<Pixel>(number, size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) image(x, y) = static_cast<Pixel>(random.next() >> (x & 15));
    return image;
}

// ---- pixelwise ----------------------------------------------------------------------------

inline void pixelwise_tables(Workspace& work, Digest& digest) {
    for (int gamma = min_gamma - 1; gamma <= max_gamma + 1; gamma += 13) digest.add(gamma_table(gamma));
    digest.add(logarithm_table());
    Random random(31);
    for (int i = 0; i < 50; ++i) {
        const Ratio scale = Ratio::from_raw(random.between(-9000000, 9000000));
        digest.add(affine_table(scale, GrayLevel::from_raw(random.between(-90000000, 90000000))));
        const Gray8 low = random_byte(random);
        const Gray8 high = random_byte(random);
        digest.add(stretch_table(low, high));
    }
    const LookupTable table = gamma_table(45);
    digest.add(table[100]);
    for_each_picture(work, [&](ImageView<const Gray8> src, ImageView<Gray8> dst) {
        digest.add(apply_lut(src, table, dst), dst);
    });
}

inline void pixelwise_frames(Workspace& work, Digest& digest) {
    for (const Size size : sizes) {
        Random random(32);
        const ImageView<Gray16> src = random_numbers<Gray16>(work, 0, size, random);
        const ImageView<Gray16> dst = random_numbers<Gray16>(work, 1, size, random);
        for (const int thickness : {0, 1, 3}) {
            digest.add(fill_frame(Gray16{517}, thickness, dst), dst);
            digest.add(copy_frame(ImageView<const Gray16>(src), thickness, dst), dst);
            digest.add(replicate_frame(ImageView<const Gray16>(src), thickness, dst), dst);
        }
        digest.add(copy(ImageView<const Gray16>(src), dst), dst);
        digest.add(fill(Gray16{40000}, dst), dst);
    }
}

// ---- statistics ---------------------------------------------------------------------------

inline void statistics_reductions(Workspace& work, Digest& digest) {
    for_each_picture(work, [&](ImageView<const Gray8> src, ImageView<Gray8>) {
        digest.add(extremes_of(src), sum_of(src), mean_and_variance(src));
    });
    for (const Size size : sizes) {
        Random random(33);
        const ImageView<Gray16> gray = random_numbers<Gray16>(work, 0, size, random);
        const ImageView<Gradient16> gradient = random_numbers<Gradient16>(work, 1, size, random);
        const ImageView<Sum32> sums = random_numbers<Sum32>(work, 2, size, random);
        digest.add(extremes_of(gray), extremes_of(gradient), extremes_of(sums));
        digest.add(sum_of(gray), sum_of(gradient), sum_of(sums));
    }
    digest.add(mean_and_variance(ImageView<const Gray8>()));
}

inline void statistics_binary_moments(Workspace& work, Digest& digest) {
    BinaryMoments sums;
    Random random(37);
    for (const Size size : {Size{1, 1}, Size{3, 70}, Size{97, 40}, Size{1600, 5}, Size{max_moment_side, 1}}) {
        const ImageView<Gray8> src = work.view<Gray8>(0, size);
        fill_clumps(src, random);
        const Result<Moments> found = moments_of(src);
        digest.add(found);
        digest.add(sums.begin(size));
        sums.add_row(src.row(0), size.width, max_moment_side - 1);
        digest.add(sums.moments());
        BinaryMoments twice = sums;
        twice.merge(sums);
        digest.add(twice.moments());
    }
    for (const Size size : {Size{0, 1}, Size{max_moment_side + 1, 1}, Size{1, max_moment_side + 1}})
        digest.add(sums.begin(size));
    digest.add(moments_of(ImageView<const Gray8>()));
    Histogram part;
    Histogram whole;
    for_each_picture(work, [&](ImageView<const Gray8> src, ImageView<Gray8>) {
        digest.add(part.begin(src.size()), whole.begin({1, 1}));
        for (int y = 0; y < src.height(); ++y) part.add_row(src.row(y), src.width(), y);
        whole.merge(part);
        whole.merge(part);
        for (int level = 0; level < whole.size(); ++level) digest.add(whole[level]);
    });
    digest.add(part.begin({}));
}

inline void statistics_hu_moments(Workspace& work, Digest& digest) {
    Random random(38);
    for (const Size size : {Size{1, 1}, Size{3, 70}, Size{97, 40}, Size{1600, 5}}) {
        const ImageView<Gray8> src = work.view<Gray8>(0, size);
        fill_clumps(src, random);
        const Result<Moments> found = moments_of(src);
        const Result<HuMoments> hu = hu_moments(*found);
        digest.add(hu.status());
        if (hu)
            for (const Real& number : hu->h) digest.add(number);
        const Result<NormalizedMoments> n = normalized_moments(*found);
        digest.add(n.status());
        if (n) digest.add(n->eta20, n->eta11, n->eta02, n->eta30, n->eta21, n->eta12, n->eta03);
    }
}

inline void statistics_projection(Workspace& work, Digest& digest) {
    for_each_picture(work, [&](ImageView<const Gray8> src, ImageView<Gray8>) {
        std::uint32_t sums[211] = {};
        const Span<std::uint32_t> all(sums);
        digest.add(project_columns(src, all.first(src.width())), all.first(src.width()));
        digest.add(project_rows(src, all.first(src.height())), all.first(src.height()));
        digest.add(project_rows(src, all));
    });
}

inline void statistics_integral(Workspace& work, Digest& digest) {
    for (const Size size : {Size{1, 1}, Size{1, 9}, Size{9, 1}, Size{33, 27}, Size{40, 21}}) {
        Random random(34);
        const ImageView<Gray8> src = work.view<Gray8>(0, size);
        fill(src, Filling::random, random);
        const ImageView<Sum32> sums = work.view<Sum32>(1, integral_size(size));
        const ImageView<Sum64> squares = work.view<Sum64>(2, integral_size(size));
        digest.add(integral_image(src, sums), integral_of_squares(src, squares), squares);
        for (int i = 0; i < 40; ++i) {
            const Rectangle area{random.between(-1, size.width), random.between(-1, size.height),
                                 random.between(0, size.width), random.between(0, size.height)};
            digest.add(rectangle_sum(ImageView<const Sum32>(sums), area));
            digest.add(rectangle_sum(ImageView<const Sum64>(squares), area));
        }
        digest.add(rectangle_sum_unchecked(sums, {0, 0, size.width, size.height}));
    }
}

inline void statistics_distances(Workspace& work, Digest& digest) {
    Random random(35);
    std::uint32_t a[128];
    std::uint32_t b[128];
    const auto compare = [&](const auto& first, const auto& second) {
        digest.add(histogram_intersection(first, second), histogram_difference(first, second),
                   chi_square_distance(first, second), bhattacharyya_distance(first, second),
                   earth_movers_distance(first, second));
    };
    for (int round = 0; round < 40; ++round) {
        const int bits = random.between(1, 31);
        for (int i = 0; i < 128; ++i) {
            a[i] = random.below(4) == 0 ? 0 : random.next() >> (32 - bits);
            b[i] = random.below(4) == 0 ? 0 : random.next() >> (32 - bits);
        }
        compare(Span<const std::uint32_t>(a, 128), Span<const std::uint32_t>(b, 128));
    }
    compare(Span<const std::uint32_t>(a, 128), Span<const std::uint32_t>(b, 127));
    HueSaturationHistogram<> histogram;
    HueSaturationHistogram<> part({200, 100});
    for (const Size size : sizes) {
        const ImageView<Hsv888> colours = work.view<Hsv888>(0, size);
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x)
                colours(x, y) = {random_byte(random), random_byte(random), random_byte(random)};
        digest.add(histogram_of(ImageView<const Hsv888>(colours), histogram));
        digest.add(histogram_of(ImageView<const Hsv888>(colours), part));
        digest.add(histogram.total(), part.total());
        for (int i = 0; i < histogram.size(); ++i) digest.add(histogram[i], part[i]);
        digest.add(histogram.at(3, 2), histogram.hue_bin(100), histogram.saturation_bin(100));
        compare(histogram, part);
        histogram.clear();
        part.clear();
        part.add_row(colours.row(0), size.width);
    }
}

inline void statistics_masked_histogram(Workspace& work, Digest& digest) {
    Histogram histogram;
    for_each_picture(work, [&](ImageView<const Gray8> src, ImageView<Gray8> mask) {
        Random random(36);
        fill_clumps(mask, random);
        digest.add(histogram_of(src, ImageView<const Gray8>(mask), histogram));
        for (int level = 0; level < histogram.size(); ++level) digest.add(histogram[level]);
        digest.add(equalize_table(histogram), equalize_by_share_table(histogram));
    });
}

}  // namespace fovea::golden
