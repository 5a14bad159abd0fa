// SPDX-License-Identifier: MIT
//
// Golden vectors of stream/: a frame, its strips, and rows that come one at a time.
#pragma once

#include <cstdint>

#include <fovea/base/list.hpp>
#include <fovea/filter/gaussian.hpp>
#include <fovea/filter/sobel.hpp>
#include <fovea/image/border.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/morphology/morphology_stages.hpp>
#include <fovea/morphology/structuring_element.hpp>
#include <fovea/pixelwise/colour_stages.hpp>
#include <fovea/pixelwise/point_stages.hpp>
#include <fovea/segment/adaptive_threshold.hpp>
#include <fovea/segment/components_accumulator.hpp>
#include <fovea/statistics/colour_histogram.hpp>
#include <fovea/statistics/projection.hpp>
#include <fovea/statistics/reductions.hpp>
#include <fovea/stream/stage.hpp>
#include <fovea/stream/stream.hpp>
#include <golden/digest.hpp>
#include <golden/statistics_vectors.hpp>
#include <golden/workspace.hpp>

namespace fovea::golden {

/// The sum of every row.
struct RowSums {
    using Input = Gray8;
    List<std::int32_t, 100> sums;

    Status begin(Size size) {
        sums.clear();
        return size.height <= 100 ? Status::ok : Status::image_too_large;
    }
    void add_row(const Gray8* row, int width, int y) {
        std::int32_t sum = y;
        for (int x = 0; x < width; ++x) sum += row[x];
        static_cast<void>(sums.push(sum));
    }
};

inline void stream_filters(Workspace& work, Digest& digest) {
    RowSums seen;
    for (const Size size : sizes)
        for (const Border border : {Border::replicate, Border::reflect_101, Border::zero}) {
            Random random(31);
            const ImageView<Gray8> src = work.view<Gray8>(0, size);
            fill(src, Filling::random, random);
            const ImageView<Gray8> dst = work.view<Gray8>(1, size);
            auto program = stream(stages::gaussian_5x5, tap(seen), stages::sobel_magnitude,
                                  stages::threshold{60}, into(dst));
            // One statement a call: the order of arguments is the compiler's.
            digest.add(program.run(src, border, work.scratch_span()));
            digest.add(dst, seen.sums.span(), program.complete());
            digest.add(program.run_strip(src, border, size.height / 2, size.height - 1, work.scratch_span()));
            digest.add(dst, seen.sums.span());
            auto sums = stream(stages::sobel_magnitude, RowSums());
            digest.add(sums.start(size, border, work.scratch_span()));
            for (int y = 0; y < size.height; ++y) digest.add(sums.push(src.row(y)));
            digest.add(sums.push(src.row(0)));
            digest.add(sums.accumulator().sums.span());
        }
}

/// What a stage makes of a picture that it is not too small for, at every border rule.
template <class Pixel, class... Stages>
void stream_stages(Workspace& work, Digest& digest, ImageView<const Pixel> src, const Stages&... stages) {
    const ImageView<Gray8> dst = work.view<Gray8>(1, src.size());
    for (const Border border : {Border::replicate, Border::reflect_101, Border::zero}) {
        auto program = stream(stages..., into(dst));
        digest.add(program.run(src, border, work.scratch_span()));
        digest.add(dst);
    }
}

inline void stream_morphology(Workspace& work, Digest& digest) {
    for (const Size size : sizes) {
        Random random(32);
        const ImageView<Gray8> image = work.view<Gray8>(0, size);
        fill(image, Filling::random, random);
        const ImageView<const Gray8> src = image;
        stream_stages(work, digest, src, stages::gaussian_3x3, stages::opening{{3, 5}});
        stream_stages(work, digest, src, stages::closing{{7, 3}}, stages::erode{{1, 3}});
        stream_stages(work, digest, src, stages::top_hat{{5, 3}}, stages::dilate{{3, 1}});
        stream_stages(work, digest, src, stages::gaussian_3x3, stages::black_hat{{3, 7}});
        stream_stages(work, digest, src, stages::morphological_gradient{{3, 3}});
        stream_stages(work, digest, src, stages::opening_shaped{StructuringElement::disc(7)});
        stream_stages(work, digest, src, stages::closing_shaped{StructuringElement::line({2, 1})});
        stream_stages(work, digest, src, stages::adaptive_threshold{5, 3});
        stream_stages(work, digest, src, stages::adaptive_threshold_inverse{9, -20});
        stream_stages(work, digest, src, stages::erode{{2, 3}});
    }
}

inline void fill_colours(ImageView<Rgb888> image, Random& random) {
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) {
            Rgb888& pixel = image(x, y);
            pixel.red = random_byte(random);
            pixel.green = random_byte(random);
            pixel.blue = random_byte(random);
        }
}

inline void stream_points(Workspace& work, Digest& digest) {
    const LookupTable table = gamma_table(60);
    HsvRange range;
    range.hue_first = 120;
    range.hue_last = 40;
    range.saturation_low = 50;
    for (const Size size : sizes) {
        Random random(33);
        const ImageView<Gray8> image = work.view<Gray8>(0, size);
        const ImageView<Gray8> second = work.view<Gray8>(2, size);
        fill(image, Filling::random, random);
        fill(second, Filling::random, random);
        const ImageView<const Gray8> src = image;
        const ImageView<const Gray8> other = second;
        stream_stages(work, digest, src, stages::absolute_difference{other}, stages::threshold{60},
                      stages::opening{{3, 3}});
        stream_stages(work, digest, src, stages::gaussian_3x3, stages::subtract_saturated{other},
                      stages::invert, stages::apply_lut(table));
        stream_stages(work, digest, src, stages::blend{other, 77}, stages::threshold_range{40, 200});
        stream_stages(work, digest, src, stages::sobel_x, stages::narrow_about_128{2},
                      stages::threshold_filter{100});
        stream_stages(work, digest, src, stages::widen<Sum32>(), stages::narrow<Sum32>{1});
        stream_stages(work, digest, src, stages::gray_from_luma{YuvRange::narrow},
                      stages::threshold_filter_inverse{90});
        const ImageView<Rgb888> colours = work.view<Rgb888>(0, size);
        fill_colours(colours, random);
        const ImageView<const Rgb888> colour = colours;
        stream_stages(work, digest, colour, stages::hsv_from_rgb, stages::rgb_from_hsv,
                      stages::hsv_range<Rgb888>{range});
        stream_stages(work, digest, colour, stages::extract_plane{ColourChannel::green},
                      stages::rgb_from_gray, stages::fast_gray_from_rgb);
        stream_stages(work, digest, colour, stages::saturation_from_rgb, stages::bitwise_xor{other});
    }
}

inline void stream_accumulators(Workspace& work, Digest& digest) {
    // Sums of 211 columns and of 9 rows.
    auto* columns = reinterpret_cast<std::uint32_t*>(work.image[1]);
    auto* part = reinterpret_cast<std::uint32_t*>(work.image[2]);
    auto* rows = part + 256;
    for (const Size size : sizes) {
        Random random(34);
        const ImageView<Gray8> image = work.view<Gray8>(0, size);
        fill(image, Filling::random, random);
        const ImageView<const Gray8> src = image;
        const Span<std::uint32_t> column_sums(columns, size.width);
        RowProjection of_rows({rows, size.height});
        ExtremesAccumulator<Gray8> extremes;
        SumAccumulator<Gray8> sum;
        MeanAndVarianceAccumulator mean;
        auto upper = stream(stages::gaussian_3x3, tap(of_rows), tap(extremes), tap(sum), tap(mean),
                            ColumnProjection(column_sums));
        digest.add(upper.run_strip(src, Border::zero, 0, size.height / 2, work.scratch_span()));
        digest.add(extremes.result(), sum.result(), mean.result());
        ExtremesAccumulator<Gray8> other_extremes;
        SumAccumulator<Gray8> other_sum;
        MeanAndVarianceAccumulator other_mean;
        auto lower = stream(stages::gaussian_3x3, tap(of_rows), tap(other_extremes), tap(other_sum),
                            tap(other_mean), ColumnProjection({part, size.width}));
        digest.add(lower.run_strip(src, Border::zero, size.height / 2, size.height - 1, work.scratch_span()));
        extremes.merge(other_extremes);
        sum.merge(other_sum);
        mean.merge(other_mean);
        digest.add(upper.accumulator().merge(lower.accumulator()));
        digest.add(extremes.result(), sum.result(), mean.result());
        digest.add(column_sums, Span<std::uint32_t>(rows, size.height));
    }
    HueSaturationHistogram<9, 4> hues;
    HueSaturationHistogram<9, 4> others;
    const Size size{45, 9};
    Random random(35);
    const ImageView<Rgb888> colours = work.view<Rgb888>(0, size);
    fill_colours(colours, random);
    auto upper = stream(stages::hsv_from_rgb, into(hues));
    digest.add(upper.run_strip(colours, Border::zero, 0, 3, work.scratch_span()));
    auto lower = stream(stages::hsv_from_rgb, into(others));
    digest.add(lower.run_strip(colours, Border::zero, 4, 8, work.scratch_span()));
    hues.merge(others);
    for (int i = 0; i < hues.size(); ++i) digest.add(hues[i], others[i]);
}

/// Components at the end of a stream.
inline void stream_components(Workspace& work, Digest& digest) {
    const ImageView<const Gray8> src = part_picture(work, 0);
    const auto bytes = static_cast<std::ptrdiff_t>(connected_components_scratch(src.width()));
    ComponentsAccumulator components({}, work.scratch_span().first(bytes), work.regions, work.holes);
    auto program = stream(stages::gaussian_3x3, stages::threshold_inverse{128}, into(components));
    digest.add(program.run(src, Border::replicate, work.scratch_span().from(bytes)));
    digest.add(components.finish());
    for (const Region& region : work.regions.view()) {
        digest.add(region.box, region.first, region.moments.m00, region.moments.m11, region.holes);
    }
    digest.add(program.run_strip(src, Border::replicate, 3, 9, work.scratch_span().from(bytes)));
    digest.add(components.finish());
}

}  // namespace fovea::golden
