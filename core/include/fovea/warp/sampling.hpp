// SPDX-License-Identifier: MIT
//
// Sampling: how the warps read a source image at places that are given in 1/256 px. Book sec. 2.9.
#pragma once

#include <cstdint>

#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/simd/cells.hpp>
#include <fovea/simd/colour_cells.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/places.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// What is made of the pixels around a place.
enum class Interpolation : std::uint8_t {
    nearest,   ///< the nearest one, ties to the right and down
    bilinear,  ///< the four around it, weighed by distance
};

/// What stands where the source image does not reach: at places whose nearest pixel would lie outside. Up to
/// half a pixel beyond the centres of the outermost pixels belongs to the image, and there these pixels stand
/// alone, so that no outside value is ever mixed in.
enum class Outside : std::uint8_t {
    replicate,  ///< the nearest pixel of the image
    constant,   ///< the level
};

/// How a warp reads its source.
template <class Pixel>
struct Sampling {
    Interpolation interpolation = Interpolation::bilinear;  ///< nearest is faster and keeps labels whole
    Outside outside = Outside::constant;
    /// For Outside::constant, and in both cases where there is no place at all: beyond the horizon of a
    /// homography, and where a map says so.
    Pixel level{};
};

/// The columns that a warp makes of all rows before it goes on: what it reads for them stays in the cache
/// even when the source is read at a slant.
inline constexpr int warp_strip = 128;
/// The same with a map that has a point for every pixel: it is the larger of the two, and read best in order.
inline constexpr int map_strip = 2048;

// ---- Implementation ---------------------------------------------------------------

inline namespace FOVEA_ISA {
namespace kernels {

/// Reads one source image at runs of places.
template <class Pixel>
class Sampler;

template <>
class Sampler<Gray8> {
public:
    Sampler(ImageView<const Gray8> src, const Sampling<Gray8>& sampling)
        : source_(src.first(), src.width(), src.height(), src.stride_bytes(),
                  sampling.outside == Outside::replicate, sampling.level),
          interpolation_(sampling.interpolation) {}

    void read(simd::PlaceRun& run, int count, simd::PlaceOrder order, Gray8* dst) const {
        if (interpolation_ == Interpolation::bilinear)
            simd::blend_cells(source_, run, count, order, dst);
        else
            simd::nearest_cells(source_, run, count, dst);
    }

private:
    simd::CellSource source_;
    Interpolation interpolation_;
};

/// The same with three channels, in vectors where it can be, else by the pixel.
template <>
class Sampler<Rgb888> {
public:
    Sampler(ImageView<const Rgb888> src, const Sampling<Rgb888>& sampling)
        : src_(src),
          source_(&src.first()->red, src.width(), src.height(), src.stride_bytes(),
                  sampling.outside == Outside::replicate, 0),
          sampling_(sampling) {}

    void read(simd::PlaceRun& run, int count, simd::PlaceOrder order, Rgb888* dst) const {
        const int last = count - 1;
        if (order == simd::PlaceOrder::along_a_line && count > 0 &&
            source_.all_outside(run.x[0], run.y[0], run.x[last], run.y[last])) {
            for (int i = 0; i < count; ++i) dst[i] = sampling_.level;
            return;
        }
        const Rgb888 level = sampling_.level;
        if (sampling_.interpolation == Interpolation::nearest ||
            !simd::blend_colour_cells(source_, run, count, level.red | level.green << 8 | level.blue << 16,
                                      &dst->red))
            read_one_by_one(run, count, dst);
    }

private:
    void read_one_by_one(const simd::PlaceRun& run, int count, Rgb888* dst) const {
        for (int i = 0; i < count; ++i) {
            if (source_.outside(run.x[i], run.y[i])) {
                dst[i] = sampling_.level;
                continue;
            }
            const std::int32_t x = clamp<std::int32_t>(run.x[i], 0, 256 * (src_.width() - 1));
            const std::int32_t y = clamp<std::int32_t>(run.y[i], 0, 256 * (src_.height() - 1));
            if (sampling_.interpolation == Interpolation::nearest)
                dst[i] = src_.row((y + 128) >> 8)[(x + 128) >> 8];
            else
                dst[i] = blended(x, y);
        }
    }
    Rgb888 blended(std::int32_t x, std::int32_t y) const {
        const auto right = static_cast<std::uint32_t>(x & 255);
        const auto down = static_cast<std::uint32_t>(y & 255);
        const Rgb888* above = src_.row(y >> 8) + (x >> 8);
        const Rgb888* below = down == 0 ? above : src_.row((y >> 8) + 1) + (x >> 8);
        const int next = right == 0 ? 0 : 1;
        const std::uint64_t upper = spread(above[0]) * (256 - right) + spread(above[next]) * right;
        const std::uint64_t lower = spread(below[0]) * (256 - right) + spread(below[next]) * right;
        // The sums of 24 bits as their high bytes and their low ones; no lane of 16 bits passes 65408.
        const std::uint64_t high = (upper >> 8 & bytes) * (256 - down) + (lower >> 8 & bytes) * down;
        const std::uint64_t low = (upper & bytes) * (256 - down) + (lower & bytes) * down;
        const std::uint64_t sum = high + 0x008000800080u + (low >> 8 & bytes);
        return {static_cast<std::uint8_t>(sum >> 8 & 255), static_cast<std::uint8_t>(sum >> 24 & 255),
                static_cast<std::uint8_t>(sum >> 40 & 255)};
    }
    /// The channels in lanes of 16 bits.
    static std::uint64_t spread(Rgb888 pixel) {
        return static_cast<std::uint64_t>(pixel.blue) << 32 |
               (static_cast<std::uint32_t>(pixel.green) << 16 | pixel.red);
    }
    static constexpr std::uint64_t bytes = 0x00ff00ff00ffu;

    ImageView<const Rgb888> src_;
    simd::CellSource source_;
    Sampling<Rgb888> sampling_;
};

/// One output row: places(x, y, count, run) fills in where the pixels from (x, y) on come from.
template <class Pixel, class Places>
void warp_row(const Sampler<Pixel>& source, const Places& places, int y, int first, int end, Pixel* dst) {
    for (int x = first; x < end; x += simd::run_length) {
        simd::PlaceRun run;
        const int count = minimum(end - x, simd::run_length);
        places(x, y, count, run);
        source.read(run, count, Places::order, dst + x);
    }
}

template <class Pixel, class Places>
void warp_frame(ImageView<const Pixel> src, const Places& places, const Sampling<Pixel>& sampling,
                ImageView<Pixel> dst) {
    const Sampler<Pixel> source(src, sampling);
    for (int first = 0; first < dst.width(); first += Places::strip) {
        const int end = minimum(dst.width(), first + Places::strip);
        for (int y = 0; y < dst.height(); ++y) warp_row(source, places, y, first, end, dst.row(y));
    }
}

template <class Pixel>
Status check_warp(ImageView<const Pixel> src, ImageView<const Pixel> dst) {
    if (src.empty() || dst.empty()) return Status::empty_image;
    if (src.width() > max_image_side || src.height() > max_image_side || dst.width() > max_image_side ||
        dst.height() > max_image_side)
        return Status::image_too_large;
    return Status::ok;
}

}  // namespace kernels
}  // namespace FOVEA_ISA
}  // namespace fovea
