// SPDX-License-Identifier: MIT
//
// From 8 bits to more and back by a fixed scale. By the picture's own range: statistics/stretch.hpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/simd/backend.hpp>
#include <fovea/simd/halves.hpp>
#include <fovea/simd/isa.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

inline namespace FOVEA_ISA {

/// The same numbers in wider pixels: Gray16, Gradient16 or Sum32.
///
/// Shapes   src and dst equal, 1x1 or larger
/// Overlap  none
/// Errors   empty_image, size_mismatch
/// Source   the toolkit's ConvertImage from byte
template <class Wide>
Status widen(ImageView<const Gray8> src, ImageView<Wide> dst);

/// Gray16, Gradient16 or Sum32 divided by 2^shift, held at 0 and 255. A scale that is the same for every
/// picture, so that brightness does not flicker.
///
/// Shapes    src and dst equal, 1x1 or larger
/// Units     shift 0 to one less than the bits of a pixel
/// Rounding  nearest, ties up
/// Overlap   none
/// Errors    empty_image, size_mismatch, bad_argument for a shift out of range
/// Source    in place of the toolkit's scaling by the range of each picture
template <class Wide>
Status narrow(ImageView<const Wide> src, int shift, ImageView<Gray8> dst);

/// 128 + src / 2^shift, held at 0 and 255: a derivative for the eye, with 128 where there is none. All else
/// as narrow().
inline Status narrow_about_128(ImageView<const Gradient16> src, int shift, ImageView<Gray8> dst);

// ---- Implementation ---------------------------------------------------------------

namespace kernels {

template <class Pixel>
inline constexpr bool is_wide_pixel =
    std::is_same_v<Pixel, Gray16> || std::is_same_v<Pixel, Gradient16> || std::is_same_v<Pixel, Sum32>;

/// value / 2^shift, to the nearest, ties up, held at low and high, then moved by offset. In the bits of the
/// pixel, so that as many as possible are done at once: the half that decides is the highest bit shifted out,
/// and only a shift of at least 1 adds it.
template <class Wide>
Gray8 narrowed(Wide value, int shift, Wide low, Wide high, Wide offset) {
    const auto half = static_cast<Wide>(shift == 0 ? 0 : 1);
    const auto below = static_cast<Wide>(static_cast<Wide>(value >> (shift == 0 ? 0 : shift - 1)) & half);
    const auto quotient = static_cast<Wide>(static_cast<Wide>(value >> shift) + below);
    return static_cast<Gray8>(static_cast<Wide>(clamp(quotient, low, high) + offset));
}

#if FOVEA_BYTES >= 16
template <class Pixel>
using VectorOf = std::conditional_t<std::is_signed_v<Pixel>, simd::RawSigned, simd::RawWords>;

/// narrowed() of a vector of pixels of 16 bits.
template <class Wide>
[[gnu::always_inline]] inline simd::RawWords narrowed_words(const Wide* from, int shift, Wide low, Wide high,
                                                            Wide offset) {
    using Vector = VectorOf<Wide>;
    const Vector least = Vector{} + low;
    const Vector most = Vector{} + high;
    Vector values;
    std::memcpy(&values, from, sizeof values);
    Vector quotient = values >> shift;
    if (shift > 0) quotient += (values >> (shift - 1)) & static_cast<Wide>(1);
    quotient = quotient > least ? quotient : least;
    quotient = quotient < most ? quotient : most;
    return simd::bits_as<simd::RawWords>(quotient + offset);
}
#endif

/// Narrows what vectors can of a row, and answers how much that was.
template <class Wide>
int narrow_in_vectors([[maybe_unused]] const Wide* from, [[maybe_unused]] int width,
                      [[maybe_unused]] int shift, [[maybe_unused]] Wide low, [[maybe_unused]] Wide high,
                      [[maybe_unused]] Wide offset, [[maybe_unused]] Gray8* to) {
    int x = 0;
#if FOVEA_BYTES >= 16
    if constexpr (sizeof(Wide) == 2)
        for (; x + simd::lanes <= width; x += simd::lanes)
            simd::narrowed(narrowed_words(from + x, shift, low, high, offset),
                           narrowed_words(from + x + simd::half_lanes, shift, low, high, offset))
                .store(to + x);
#endif
    return x;
}

constexpr bool is_narrowing(int shift, std::size_t bytes) {
    return shift >= 0 && shift < static_cast<int>(8 * bytes);
}

/// offset + src / 2^shift of one row. An offset comes with pixels that have a sign alone.
template <class Wide>
void narrow_row(const Wide* src, int width, int shift, int offset, Gray8* dst) {
    const auto low = static_cast<Wide>(-offset);
    const auto high = static_cast<Wide>(255 - offset);
    for (int x = narrow_in_vectors(src, width, shift, low, high, static_cast<Wide>(offset), dst); x < width;
         ++x)
        dst[x] = narrowed(src[x], shift, low, high, static_cast<Wide>(offset));
}

template <class Wide>
void widen_row(const Gray8* src, int width, Wide* dst) {
    for (int x = 0; x < width; ++x) dst[x] = static_cast<Wide>(src[x]);
}

template <class Wide>
Status narrow_frame(ImageView<const Wide> src, int shift, int offset, ImageView<Gray8> dst) {
    static_assert(is_wide_pixel<Wide>, "narrow() takes Gray16, Gradient16 and Sum32");
    if (src.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    if (!is_narrowing(shift, sizeof(Wide))) return Status::bad_argument;
    for (int y = 0; y < src.height(); ++y) narrow_row(src.row(y), src.width(), shift, offset, dst.row(y));
    return Status::ok;
}

}  // namespace kernels

template <class Wide>
Status widen(ImageView<const Gray8> src, ImageView<Wide> dst) {
    static_assert(kernels::is_wide_pixel<Wide>, "widen() makes Gray16, Gradient16 and Sum32");
    if (src.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    for (int y = 0; y < src.height(); ++y) kernels::widen_row(src.row(y), src.width(), dst.row(y));
    return Status::ok;
}

template <class Wide>
Status narrow(ImageView<const Wide> src, int shift, ImageView<Gray8> dst) {
    return kernels::narrow_frame(src, shift, 0, dst);
}

inline Status narrow_about_128(ImageView<const Gradient16> src, int shift, ImageView<Gray8> dst) {
    return kernels::narrow_frame(src, shift, 128, dst);
}

}  // namespace FOVEA_ISA
}  // namespace fovea
