// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include <core/codec/jpeg_file.hpp>
#include <fovea/base/random.hpp>
#include <fovea/codec/jpeg.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {

/// Decodes with exactly the scratch the file asks for.
template <class Pixel>
Status decode_with_scratch(const Bytes& file, GuardedImage<Pixel>& dst) {
    const Result<PictureInfo> info = inspect_jpeg(span_of(file));
    Bytes scratch(info ? static_cast<std::size_t>(info->scratch_bytes) : 0);
    return decode_jpeg(span_of(file), span_of(scratch), dst.view());
}
template <class Pixel = Gray8>
Status status_of(const Bytes& file, Size size) {
    GuardedImage<Pixel> dst(size);
    return decode_with_scratch(file, dst);
}

/// A file of random coefficients, and the samples of its components by the definition of the transform.
struct RandomPicture {
    JpegFile file;
    Size size;
    int components = 1;
    Sampling luma, chroma;
    std::vector<std::vector<int>> samples;  // by component, in whole blocks
    std::vector<int> width;

    const Sampling& factors(int component) const { return component == 0 ? luma : chroma; }

    RandomPicture(Random& random, Size picture, int count, Sampling luma_factors, Sampling chroma_factors,
                  int restart, bool rgb = false)
        : size(picture), components(count), luma(luma_factors), chroma(chroma_factors) {
        const int mcus_across = (size.width + 8 * luma.across - 1) / (8 * luma.across);
        const int mcus_down = (size.height + 8 * luma.down - 1) / (8 * luma.down);
        for (int c = 0; c < components; ++c) {
            width.push_back(8 * mcus_across * factors(c).across);
            samples.emplace_back(static_cast<std::size_t>(width.back() * 8 * mcus_down * factors(c).down));
        }
        const int step = random.between(1, 4);
        if (rgb) file.segment(0xee, {'A', 'd', 'o', 'b', 'e', 0, 100, 0, 0, 0, 0, 0});
        file.quantiser(0, step).frame(size, components, luma, chroma);
        if (restart > 0) file.restart_interval(restart);
        file.scan(components);
        std::vector<int> previous(3);
        for (int mcu = 0; mcu < mcus_across * mcus_down; ++mcu) {
            if (restart > 0 && mcu > 0 && mcu % restart == 0) {
                file.pad().marker(0xd0 + (mcu / restart - 1) % 8);
                previous.assign(3, 0);
            }
            for (int c = 0; c < components; ++c)
                for (int block = 0; block < factors(c).across * factors(c).down; ++block)
                    add_block(random, c, step, previous[static_cast<std::size_t>(c)],
                              8 * (mcu % mcus_across * factors(c).across + block % factors(c).across),
                              8 * (mcu / mcus_across * factors(c).down + block / factors(c).across));
        }
        file.pad().marker(0xd9);
    }

    void add_block(Random& random, int c, int step, int& previous, int x0, int y0) {
        Coefficients quantised(64);
        quantised[0] = random.between(-900, 900) / step;
        const int used = random.between(0, 63) >> random.below(6);
        for (int k = 1; k <= used; ++k)
            if (random.below(2) == 0)
                quantised[static_cast<std::size_t>(k)] = random.between(-120, 120) / step >> random.below(7);
        file.block(quantised, previous, c == 0 ? 0 : 1);
        previous = quantised[0];
        std::vector<double> coefficients(64);
        for (std::size_t k = 0; k < 64; ++k) coefficients[jpeg::zigzag[k]] = quantised[k] * step;
        const std::vector<double> block = naive_inverse(coefficients);
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 8; ++x)
                at(c, x0 + x, y0 + y) = std::clamp(
                    static_cast<int>(std::floor(block[static_cast<std::size_t>(8 * y + x)] + 0.5)) + 128, 0,
                    255);
    }
    int& at(int c, int x, int y) {
        const auto component = static_cast<std::size_t>(c);
        return samples[component][static_cast<std::size_t>(y * width[component] + x)];
    }

    /// A sample of a component at a pixel, between its own samples if they are fewer.
    double full_size(int c, int x, int y) {
        const int across = luma.across / factors(c).across;
        const int down = luma.down / factors(c).down;
        const Size own = {(size.width + across - 1) / across, (size.height + down - 1) / down};
        const auto place = [](int pixel, int ratio, int count) {
            return std::clamp(ratio == 2 ? pixel / 2.0 - 0.25 : pixel, 0.0, count - 1.0);
        };
        double u = place(x, across, own.width);
        double v = place(y, down, own.height);
        if (across == 2 && own.width <= 2) {
            u = x / 2;
            if (down == 2) v = y / 2;
        }
        const int left = static_cast<int>(u);
        const int above = static_cast<int>(v);
        const int right = std::min(left + 1, own.width - 1);
        const int below = std::min(above + 1, own.height - 1);
        const double row_above = at(c, left, above) * (left + 1 - u) + at(c, right, above) * (u - left);
        const double row_below = at(c, left, below) * (left + 1 - u) + at(c, right, below) * (u - left);
        return row_above * (above + 1 - v) + row_below * (v - above);
    }
};

}  // namespace fovea::test
