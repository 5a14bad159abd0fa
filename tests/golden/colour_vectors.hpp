// SPDX-License-Identifier: MIT
//
// Golden vectors of the colour conversions that are not from one image to one image, and of the lanes they
// run on.
#pragma once

#include <cstdint>

#include <fovea/pixelwise/bayer.hpp>
#include <fovea/pixelwise/colour_class.hpp>
#include <fovea/pixelwise/colour_model.hpp>
#include <fovea/pixelwise/hsv.hpp>
#include <fovea/pixelwise/lab.hpp>
#include <fovea/pixelwise/planes.hpp>
#include <fovea/pixelwise/rgb565.hpp>
#include <fovea/pixelwise/yuv.hpp>
#include <fovea/simd/interleave.hpp>
#include <fovea/simd/lanes.hpp>
#include <fovea/simd/ratio.hpp>
#include <golden/digest.hpp>
#include <golden/workspace.hpp>

namespace fovea::golden {

inline void put(Digest& digest, Hsv888 colour) {
    digest.add_byte(colour.hue);
    digest.add_byte(colour.saturation);
    digest.add_byte(colour.value);
}

inline void put(Digest& digest, Lab888 colour) {
    digest.add_byte(colour.lightness);
    digest.add_byte(colour.a);
    digest.add_byte(colour.b);
}

inline Rgb888 random_colour(Random& random) {
    const std::uint8_t red = random_byte(random);
    const std::uint8_t green = random_byte(random);
    return {red, green, random_byte(random)};
}

/// Pairs, triples, quotients, and the operations of Bytes and Words that only colours need.
inline void simd_interleave(Workspace& work, Digest& digest) {
    constexpr int width = 192;
    static_assert(width % simd::lanes == 0, "whole vectors");
    Random random(13);
    const ImageView<Gray8> src = work.view<Gray8>(0, {3 * width, 2});
    const ImageView<Gray8> dst = work.view<Gray8>(1, {width, 14});
    const ImageView<Gray8> back = work.view<Gray8>(2, {3 * width, 1});
    fill(src, Filling::random, random);
    for (int x = 0; x < width; x += simd::lanes) {
        const simd::ByteTriples triples = simd::load_triples(src.row(0) + 3 * x);
        const simd::BytePairs pairs = simd::load_pairs(src.row(1) + 2 * x);
        const simd::Bytes a = triples.first;
        const simd::Bytes b = triples.second;
        a.store(dst.row(0) + x);
        b.store(dst.row(1) + x);
        triples.third.store(dst.row(2) + x);
        pairs.first.store(dst.row(3) + x);
        pairs.second.store(dst.row(4) + x);
        simd::store_triples({triples.third, a, b}, back.row(0) + 3 * x);
        (a + b).store(dst.row(5) + x);
        (a - b).store(dst.row(6) + x);
        const simd::Words p(a);
        const simd::Words q(b);
        ((p << 1) - q - simd::Words::all(100)).held().store(dst.row(7) + x);
        ((p * q) >> 8).narrow().store(dst.row(8) + x);
        const simd::Ratio ratio = simd::ratio_of<7>(lower(a, b), higher(a, b));
        ratio.quotient.store(dst.row(9) + x);
        ratio.rest.store(dst.row(10) + x);
        const simd::Ratio doubled = twice(ratio, higher(a, b));
        doubled.quotient.store(dst.row(11) + x);
        doubled.rest.store(dst.row(12) + x);
    }
    simd::for_each_step<3, 1>(
        src.row(0), width - 1, dst.row(13),
        [](const std::uint8_t* from, std::uint8_t* to) { simd::load_triples(from).second.store(to); });
    dst(width - 1, 13) = 0;
    digest.add(dst, back);
}

inline void pixelwise_planes(Workspace& work, Digest& digest) {
    for (const Size size : sizes) {
        Random random(14);
        const ImageView<Rgb888> colour = work.view<Rgb888>(0, size);
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) colour(x, y) = random_colour(random);
        // Three planes of one image, one below the other.
        const ImageView<Gray8> planes = work.view<Gray8>(1, {size.width, 3 * size.height});
        const auto plane = [&](int number) {
            return *planes.crop({0, number * size.height, size.width, size.height});
        };
        digest.add(split_planes(colour, plane(0), plane(1), plane(2)), planes);
        digest.add(merge_planes(plane(2), plane(0), plane(1), colour), colour);
    }
}

inline void pixelwise_hsv(Workspace&, Digest& digest) {
    Random random(15);
    for (int i = 0; i < 4096; ++i) {
        const Rgb888 colour = random_colour(random);
        const Hsv888 hsv = hsv_of(colour);
        digest.add(hsv, rgb_of(hsv), rgb_of(Hsv888{colour.red, colour.green, colour.blue}));
    }
}

inline void pixelwise_lab(Workspace&, Digest& digest) {
    Random random(20);
    for (int i = 0; i < 4096; ++i) {
        const Rgb888 colour = random_colour(random);
        digest.add(lab_of(colour), rgb_of(Lab888{colour.red, colour.green, colour.blue}));
    }
    for (int level = 0; level < 256; ++level) {
        const auto k = static_cast<std::uint8_t>(level);
        digest.add(lab_of({k, 0, 0}), lab_of({0, k, 0}), lab_of({0, 0, k}), lab_of({k, k, k}));
    }
}

inline void pixelwise_video(Workspace& work, Digest& digest) {
    Random random(16);
    for (const YuvRange range : {YuvRange::full, YuvRange::narrow}) {
        for (int i = 0; i < 2048; ++i) {
            const Rgb888 yuv = random_colour(random);
            digest.add(rgb_of(yuv.red, yuv.green, yuv.blue, range));
        }
        for (const Size size : sizes) {
            const ImageView<Gray8> luma = work.view<Gray8>(0, size);
            const ImageView<ChromaPair> chroma = work.view<ChromaPair>(1, chroma_size(size));
            const ImageView<Rgb888> dst = work.view<Rgb888>(2, size);
            fill(luma, Filling::random, random);
            for (int y = 0; y < chroma.height(); ++y)
                for (int x = 0; x < chroma.width(); ++x)
                    chroma(x, y) = {random_byte(random), random_byte(random)};
            digest.add(to_rgb(luma, chroma, range, dst), dst);
        }
    }
    for (int colour = 0; colour < 65536; colour += 13) digest.add(rgb_of_rgb565(static_cast<Rgb565>(colour)));
}

inline void pixelwise_colour_class(Workspace&, Digest& digest) {
    Random random(18);
    for (int i = 0; i < 256; ++i) {
        const Hsv888 hsv = hsv_of(random_colour(random));
        for (const ColourClass& colour : colour_classes) digest.add(colour.range().contains(hsv));
    }
    for (const ColourClass& colour : colour_classes) {
        const HsvRange range = colour.range();
        digest.add(range.valid(), range.hue_first, range.hue_last, range.saturation_low,
                   range.saturation_high, range.value_low, range.value_high);
    }
}

inline void put(Digest& digest, const ColourModel& model) {
    digest.add(Span<const std::int16_t>(model.mean), Span<const std::int32_t>(model.inverse));
}

inline void pixelwise_colour_model(Workspace& work, Digest& digest) {
    Random random(19);
    const ImageView<Rgb888> samples = work.view<Rgb888>(0, {40, 20});
    const ImageView<Gray8> dst = work.view<Gray8>(1, {40, 20});
    for (const int spread : {0, 1, 7, 60, 255}) {
        ColourModelSums sums;
        for (int y = 0; y < 20; ++y)
            for (int x = 0; x < 40; ++x) {
                const int t = random.between(0, spread);
                samples(x, y) = {static_cast<std::uint8_t>(t), static_cast<std::uint8_t>(255 - t / 2),
                                 static_cast<std::uint8_t>(random.between(0, spread))};
                sums.add(samples(x, y));
            }
        digest.add(sums.count(), sums.model(), learn_colour(samples));
        const ColourModel model = *sums.model();
        for (int i = 0; i < 100; ++i) digest.add(model.distance_squared(random_colour(random)));
        for (const std::uint32_t limit : {0u, 1u << 16, 9u << 16}) {
            digest.add(colour_model_range(samples, model, limit, dst), dst);
        }
    }
}

}  // namespace fovea::golden
