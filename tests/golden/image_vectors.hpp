// SPDX-License-Identifier: MIT
//
// Golden vectors of image/, simd/, pixelwise/, statistics/, morphology/ and warp/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>

#include <fovea/image/border.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/row_kernel.hpp>
#include <fovea/morphology/morphology.hpp>
#include <fovea/pixelwise/threshold.hpp>
#include <fovea/pixelwise/to_gray.hpp>
#include <fovea/simd/lanes.hpp>
#include <fovea/simd/lines.hpp>
#include <fovea/statistics/histogram.hpp>
#include <fovea/statistics/moments.hpp>
#include <fovea/statistics/polygon_moments.hpp>
#include <fovea/statistics/polygon_symmetry.hpp>
#include <fovea/warp/bilinear.hpp>
#include <golden/digest.hpp>
#include <golden/workspace.hpp>

namespace fovea::golden {

inline void put(Digest& digest, const Moments& m) {
    digest.add(m.m00, m.m10, m.m01, m.m20, m.m11, m.m02, m.m30, m.m21, m.m12, m.m03);
}
inline void put(Digest& digest, const CentralMoments& c) {
    digest.add(c.area, c.centroid, c.mu20, c.mu11, c.mu02, c.mu30, c.mu21, c.mu12, c.mu03);
}
inline void put(Digest& digest, const RotationalAxis& found) { digest.add(found.axis, found.strength); }
inline void put(Digest& digest, const Orientation& orientation) {
    digest.add(orientation.axis, orientation.elongation);
}

// ---- image, simd --------------------------------------------------------------------------

inline void image_views(Workspace& work, Digest& digest) {
    for (const Border border : {Border::replicate, Border::reflect_101})
        for (int count = 1; count <= 4; ++count)
            for (int index = -9; index <= 12; ++index) digest.add(border_index(border, index, count));
    const Span<std::uint8_t> bytes = work.scratch_span().first(60);
    for (const Size size : {Size{0, 3}, Size{5, 4}, Size{6, 10}, Size{6, 11}, Size{40000, 1}})
        for (const std::ptrdiff_t stride : {5, 6, 7}) {
            digest.add(view_over<const Gray8>(bytes, size, stride).status());
            digest.add(view_over<Gray16>(bytes, size, 2 * stride).status());
            digest.add(view_over<Gray16>(bytes.from(1), size, 2 * stride).status());
        }
    const ImageView<Gray8> image = part_picture(work, 0);
    for (const Rectangle area : {Rectangle{0, 0, 112, 76}, Rectangle{50, 30, 7, 5}, Rectangle{111, 75, 1, 1},
                                 Rectangle{-1, 0, 2, 2}, Rectangle{105, 0, 8, 1}, Rectangle{3, 3, 0, 1}}) {
        const Result<ImageView<Gray8>> part = image.crop(area);
        digest.add(part, area.contains({50, 30}), area.right(), area.bottom(), area.size());
    }
    digest.add(image.contains({111, 75}), image.contains({112, 75}), image.stride_bytes(), image);
}

/// The middle row less its neighbours: a window whose border rows show.
struct RowDifference {
    using Input = Gray8;
    using Output = Gray8;
    static constexpr int rows() { return 5; }
    void operator()(const RowWindow<Gray8>& window, Gray8* dst) const {
        for (int x = 0; x < window.width(); ++x) {
            int sum = 0;
            for (int i = 0; i < window.count(); ++i) sum += (i + 1) * window[i][x];
            dst[x] = static_cast<Gray8>(sum / 15);
        }
    }
};

inline void image_row_kernel(Workspace& work, Digest& digest) {
    RowDifference kernel;
    for_each_picture(work, [&](ImageView<const Gray8> src, ImageView<Gray8> dst) {
        for_each_row(src, Border::reflect_101, kernel, dst);
        digest.add(dst);
        const int first = src.height() / 3;
        const ImageView<Gray8> strip = *dst.crop({0, 0, dst.width(), dst.height() - first});
        for_each_row(src, Border::replicate, first, src.height() - 1, kernel, strip);
        digest.add(strip);
    });
}

/// Every operation of Bytes and Words, on rows of whole vectors at every width.
inline void simd_lanes(Workspace& work, Digest& digest) {
    constexpr int width = 192;
    static_assert(width % simd::lanes == 0, "whole vectors");
    Random random(11);
    const ImageView<Gray8> src = work.view<Gray8>(0, {width, 2});
    const ImageView<Gray8> dst = work.view<Gray8>(1, {width, 17});
    fill(src, Filling::random, random);
    for (int x = 0; x < width; x += simd::lanes) {
        const auto a = simd::Bytes::load(src.row(0) + x);
        const auto b = simd::Bytes::load(src.row(1) + x);
        lower(a, b).store(dst.row(0) + x);
        higher(a, b).store(dst.row(1) + x);
        at_least(a, b).store(dst.row(2) + x);
        ((a & b) | (~a ^ simd::Bytes::all(90))).store(dst.row(3) + x);
        const simd::Words p(a);
        const simd::Words q(b);
        (p + q).saturate().store(dst.row(4) + x);
        ((p + q + simd::Words::all(1)) >> 1).narrow().store(dst.row(5) + x);
        absolute(p - q).narrow().store(dst.row(6) + x);
        (((p << 3) + q * 7) >> 4).narrow().store(dst.row(7) + x);
        absolute((p - q) - (q - p)).saturate().store(dst.row(8) + x);
        simd::Bytes::load(src.row(0) + x, simd::lanes / 2).store(dst.row(9) + x);
        (p * 255 >> 8).narrow().store(dst.row(10) + x);
        a.store(dst.row(11) + x, simd::lanes - 1);
        dst(x + simd::lanes - 1, 11) = 1;
        (a + b).store(dst.row(12) + x);
        (a - b).store(dst.row(13) + x);
        add_saturated(a, b).store(dst.row(14) + x);
        subtract_saturated(a, b).store(dst.row(15) + x);
        average(a, b).store(dst.row(16) + x);
    }
    // Half a vector, and all but its last pixel, differ by width.
    digest.add(*dst.crop({0, 0, width, 9}), *dst.crop({0, 10, width, 1}), *dst.crop({0, 12, width, 5}));
    for (int x = 0; x < width; x += simd::lanes)
        for (int i = 0; i < simd::lanes; ++i) {
            FOVEA_ASSERT(dst(x + i, 9) == (i < simd::lanes / 2 ? src(x + i, 0) : 0));
            FOVEA_ASSERT(dst(x + i, 11) == (i < simd::lanes - 1 ? src(x + i, 0) : 1));
        }
    simd::ByteLine line(work.scratch_span().first(byte_line_scratch(70)), 70);
    simd::for_each_vector(70,
                          [&](int x, int count) { line.put(x, simd::Bytes::load(src.row(0) + x, count)); });
    line.replicate(70, max_reach);
    FOVEA_ASSERT(line.pixels()[69] == src(69, 0));
    constexpr int widest = 64;
    for (int x = -max_reach; x + widest <= 70 + max_reach; ++x) {
        std::uint8_t pixels[simd::lanes];
        line.at(x).store(pixels);
        digest.add(pixels[0]);
    }
}

/// What Words does with numbers of 16 bits, and their line.
inline void simd_words(Workspace& work, Digest& digest) {
    constexpr int width = 192;
    Random random(12);
    const ImageView<Gray16> src = work.view<Gray16>(0, {width, 2});
    const ImageView<Gray16> dst = work.view<Gray16>(1, {width, 6});
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < width; ++x) src(x, y) = static_cast<Gray16>(random.next() >> 16);
    simd::WordLine line(work.scratch_span().first(word_line_scratch(width)), width);
    for (int x = -max_reach; x < width + max_reach; ++x) line.set(x, static_cast<Gray16>(7 * x * x + x));
    for (int x = 0; x < width; x += simd::lanes) {
        const auto a = simd::Words::load(src.row(0) + x);
        const auto b = simd::Words::load(src.row(1) + x);
        lower(a, b).store(dst.row(0) + x);
        higher(a, b).store(dst.row(1) + x);
        ((at_least(a, b) & a) | ~b).store(dst.row(2) + x);
        times_high(a, 10486).store(dst.row(3) + x);
        (line.at<-3>(x) - line.at<2>(x)).store(dst.row(4) + x);
        (line.at(x, 7) - line.at(x, -8)).store(dst.row(5) + x);
    }
    digest.add(dst);
}

// ---- pixelwise ----------------------------------------------------------------------------

inline void pixelwise_threshold(Workspace& work, Digest& digest) {
    for_each_picture(work, [&](ImageView<const Gray8> src, ImageView<Gray8> dst) {
        for (const int level : {0, 1, 100, 128, 255}) {
            const auto limit = static_cast<Gray8>(level);
            digest.add(threshold(src, limit, dst), dst);
            digest.add(threshold_inverse(src, limit, dst), dst);
            digest.add(threshold_range(src, 64, limit, dst));
            if (limit >= 64) digest.add(dst);
        }
    });
}

inline void pixelwise_to_gray(Workspace& work, Digest& digest) {
    for (const Size size : sizes) {
        Random random(12);
        const ImageView<Rgb888> colour = work.view<Rgb888>(0, size);
        const ImageView<Yuyv> video = work.view<Yuyv>(1, size);
        const ImageView<Gray8> dst = work.view<Gray8>(2, size);
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
                colour(x, y) = {random_byte(random), random_byte(random), random_byte(random)};
                video(x, y) = {random_byte(random), random_byte(random)};
                digest.add(gray_of(colour(x, y)));
            }
        digest.add(to_gray(colour, dst), dst);
        digest.add(to_gray(video, dst), dst);
    }
    for (int level = 0; level < 256; ++level) {
        const auto k = static_cast<Gray8>(level);
        digest.add(gray_of({k, k, k}), gray_of({k, 0, 0}), gray_of({0, k, 0}), gray_of({0, 0, k}));
    }
}

// ---- statistics ---------------------------------------------------------------------------

inline void statistics_histogram(Workspace& work, Digest& digest) {
    constexpr std::uint32_t shares[] = {0, 1, 1311, 32768, 64225, whole_share, whole_share + 1};
    Histogram histogram;
    for_each_picture(work, [&](ImageView<const Gray8> src, ImageView<Gray8>) {
        digest.add(histogram_of(src, histogram));
        digest.add(histogram.total());
        for (int level = 0; level < Histogram::levels; ++level) digest.add(histogram[level]);
        for (const std::uint32_t share : shares) digest.add(quantile(histogram, share));
        digest.add(otsu(histogram));
        // Counts of more than 2^26 pixels.
        for (int i = 0; i < 30; ++i) histogram.add_row(src.row(0), src.width());
        digest.add(otsu(histogram));
    });
    histogram.clear();
    digest.add(quantile(histogram, 0), otsu(histogram));
}

inline void statistics_moments(Workspace&, Digest& digest) {
    Random random(13);
    for (int i = 0; i < 60; ++i) {
        Moments moments;
        const int top = random.between(0, 8000);
        const int rows = random.between(1, 150);
        for (int y = top; y < top + rows; ++y) {
            const int first = random.between(0, 8000);
            moments.add_run(first, random.between(first, 8191), y);
        }
        Moments twice = moments;
        twice.add(moments);
        digest.add(moments, twice, twice.area(), twice.empty());
        const Result<CentralMoments> central = central_moments(moments);
        digest.add(central);
        if (!central) continue;
        digest.add(orientation(*central));
        for (const int quarters : {1, 3, 4, 9, 16}) {
            const CentralMoments tall = stretched(*central, PixelAspect::from_ratio(quarters, 4));
            digest.add(tall, orientation(tall));
        }
    }
    digest.add(central_moments(Moments()));
    Moments square;
    for (int y = 3; y < 8; ++y) square.add_run(3, 8, y);
    digest.add(orientation(*central_moments(square)));
}

inline void statistics_polygon_moments(Workspace&, Digest& digest) {
    Random random(14);
    for (int i = 0; i < 100; ++i) {
        FinePoint corners[7];
        const int reach = 1 << (random.below(11) + 1);
        for (FinePoint& corner : corners) {
            corner.x = FinePixel::from_raw(random.between(-reach * 65536, reach * 65536));
            corner.y = FinePixel::from_raw(random.between(-reach * 65536, reach * 65536));
        }
        PolygonMoments forward({random.between(-9, 9), random.between(-9, 9)});
        PolygonMoments backward({0, 0});
        for (int k = 0; k < 7; ++k) {
            forward.add_edge(corners[k], corners[(k + 1) % 7]);
            backward.add_edge(corners[k], corners[(k + 1) % 7], -1);
        }
        digest.add(forward.central(), backward.central());
    }
}

inline void statistics_polygon_symmetry(Workspace&, Digest& digest) {
    Random random(17);
    for (int i = 0; i < 200; ++i) {
        FinePoint corners[9];
        const int reach = 1 << (random.below(12) + 1);
        for (FinePoint& corner : corners) {
            corner.x = FinePixel::from_raw(random.between(-reach * 65536, reach * 65536));
            corner.y = FinePixel::from_raw(random.between(-reach * 65536, reach * 65536));
        }
        const PixelAspect aspect = PixelAspect::from_ratio(random.between(1, 16), 4);
        PolygonSymmetry symmetry(corners[8], random.between(min_symmetry_order - 1, max_symmetry_order + 1),
                                 aspect);
        const int sign = i % 2 == 0 ? 1 : -1;
        for (int k = 0; k < 7; ++k) symmetry.add_edge(corners[k], corners[(k + 1) % 7], sign);
        digest.add(symmetry.axis());
    }
}

// ---- morphology ---------------------------------------------------------------------------

inline void morphology_rectangles(Workspace& work, Digest& digest) {
    const auto run = [&](ImageView<const Gray8> src, ImageView<Gray8> dst, Size element) {
        const Span<std::uint8_t> scratch = work.scratch_span();
        digest.add(erode(src, element, scratch.first(erode_scratch(src.size())), dst), dst);
        digest.add(dilate(src, element, scratch.first(dilate_scratch(src.size())), dst), dst);
        digest.add(opening(src, element, scratch.first(opening_scratch(src.size())), dst), dst);
        digest.add(closing(src, element, scratch.first(closing_scratch(src.size())), dst), dst);
    };
    for_each_picture(work, [&](ImageView<const Gray8> src, ImageView<Gray8> dst) {
        for (const Size element : {Size{3, 3}, Size{7, 5}, Size{15, 15}}) run(src, dst, element);
    });
    const ImageView<Gray8> part = part_picture(work, 0);
    for (const Size element : {Size{1, 1}, Size{1, 3}, Size{3, 1}, Size{5, 5}, Size{1, 63}, Size{63, 1},
                               Size{31, 9}, Size{63, 63}})
        run(part, work.view<Gray8>(1, part.size()), element);
    for (const Size element : {Size{2, 3}, Size{3, 0}, Size{65, 1}})
        digest.add(erode(part, element, work.scratch_span(), work.view<Gray8>(1, part.size())));
}

// ---- warp ---------------------------------------------------------------------------------

inline void warp_bilinear(Workspace& work, Digest& digest) {
    for_each_picture(work, [&](ImageView<const Gray8> src, ImageView<Gray8>) {
        Random random(15);
        for (int i = 0; i < 60; ++i) {
            const FinePoint place{FinePixel::from_raw(random.between(-65536, src.width() * 65536)),
                                  FinePixel::from_raw(random.between(-65536, src.height() * 65536))};
            const FinePoint nearest = nearest_sample(src.size(), place);
            digest.add(can_sample(src.size(), place), sample_bilinear(src, place), nearest,
                       sample_bilinear_unchecked(src, nearest));
        }
    });
}

}  // namespace fovea::golden
