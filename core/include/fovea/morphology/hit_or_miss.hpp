// SPDX-License-Identifier: MIT
//
// Hit or miss: where a pattern of set and unset pixels lies. Serra, "Image Analysis and Mathematical
// Morphology".
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/bit_view.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/morphology/bit_morphology.hpp>
#include <fovea/morphology/shaped_morphology.hpp>
#include <fovea/morphology/structuring_element.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/simd/bits.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>

namespace fovea {
inline namespace FOVEA_ISA {

// ---- Interface --------------------------------------------------------------------

/// Scratch bytes of hit_or_miss(): a frame, and what an erosion with one of the elements needs.
constexpr std::int64_t hit_or_miss_scratch(Size size, const StructuringElement& hit,
                                           const StructuringElement& miss);

/// 255 where all places of hit are not 0 and all places of miss are 0, 0 elsewhere.
///
/// Shapes   src and dst equal, 1x1 or larger; the elements of any two sizes, one of them may be empty
/// Border   only pixels of the image count: the rest of a pattern may lie outside
/// Overlap  none: dst must not share pixels with src
/// Scratch  hit_or_miss_scratch(src.size(), hit, miss) bytes, undefined afterwards
/// Errors   empty_image, size_mismatch, bad_argument if both elements are empty, scratch_too_small
/// Source   the erosion with hit and that of the inverse image with miss, both as erode()
inline Status hit_or_miss(ImageView<const Gray8> src, const StructuringElement& hit,
                          const StructuringElement& miss, Span<std::uint8_t> scratch, ImageView<Gray8> dst);

/// Scratch words of hit_or_miss() of bits: a row with room at its ends.
constexpr std::int64_t bit_hit_or_miss_scratch(Size size) { return bit_words(size.width) + 2; }

/// The same with one bit a pixel and elements of up to 3x3.
///
/// Scratch  bit_hit_or_miss_scratch(src.size()) words, undefined afterwards
/// Errors   bad_argument also for an element with a side above 3
/// Others   as hit_or_miss() of bytes, which finds the same
inline Status hit_or_miss(BitView<const BitWord> src, const StructuringElement& hit,
                          const StructuringElement& miss, Span<BitWord> scratch, BitView<BitWord> dst);

// ---- Implementation ---------------------------------------------------------------

constexpr std::int64_t hit_or_miss_scratch(Size size, const StructuringElement& hit,
                                           const StructuringElement& miss) {
    return size.area() + maximum(erode_scratch(size, hit), dilate_scratch(size, miss));
}

namespace kernels {

/// to = 255 where it is not 0 and other is 0, else 0.
inline void hits_of_row(const Gray8* other, int width, Gray8* to) {
    using simd::Bytes;
    const Bytes one = Bytes::all(1);
    const auto hits = [one](Bytes hit, Bytes miss) { return at_least(hit, one) & ~at_least(miss, one); };
    int x = 0;
    for (; x + simd::lanes <= width; x += simd::lanes)
        hits(Bytes::load(to + x), Bytes::load(other + x)).store(to + x);
    if (x < width)
        hits(Bytes::load(to + x, width - x), Bytes::load(other + x, width - x)).store(to + x, width - x);
}

/// Those of nine pixels around a word's pixels that a row of a pattern asks for must be set in a line of
/// bits.
inline void match_bits(const BitWord* line, std::uint32_t places, int middle, int words, BitWord* to) {
    const auto match = [&](auto moved) {
        simd::make_words(0, words, to, [&](int i, auto kind) {
            return simd::load_piece<decltype(kind)>(to + i) & moved(line + i, kind);
        });
    };
    for (int x = 0; x < 3; ++x) {
        if ((places >> x & 1) == 0) continue;
        if (x < middle)
            match([](const BitWord* at, auto kind) { return earlier_bits<decltype(kind)>(at, 1); });
        else if (x == middle)
            match([](const BitWord* at, auto kind) { return simd::load_piece<decltype(kind)>(at); });
        else
            match([](const BitWord* at, auto kind) { return later_bits<decltype(kind)>(at, 1); });
    }
}

/// Matches one element against the rows around y; inverse: all of its places must be unset.
inline void match_element(BitView<const BitWord> src, int y, const StructuringElement& element,
                          BitWord inverse, BitWord* line, BitWord* to) {
    const int words = bit_words(src.width());
    for (int k = 0; k < element.size().height; ++k) {
        const int from = y + k - element.size().height / 2;
        if (element.row(k) == 0 || from < 0 || from >= src.height()) continue;
        const BitWord* row = src.row(from);
        for (int i = 0; i < words; ++i) line[i] = row[i] ^ inverse;
        // What is no pixel hinders nothing.
        line[words - 1] |= ~last_bits(src.width());
        match_bits(line, element.row(k), element.size().width / 2, words, to);
    }
}

}  // namespace kernels

inline Status hit_or_miss(ImageView<const Gray8> src, const StructuringElement& hit,
                          const StructuringElement& miss, Span<std::uint8_t> scratch, ImageView<Gray8> dst) {
    if (src.empty() || dst.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    if (hit.empty() && miss.empty()) return Status::bad_argument;
    if (scratch.size() < hit_or_miss_scratch(src.size(), hit, miss)) return Status::scratch_too_small;
    const ImageView<Gray8> found(scratch.data(), src.size(), src.width());
    const Span<std::uint8_t> rest = scratch.from(static_cast<std::ptrdiff_t>(src.size().area()));
    for (int y = 0; y < src.height() && hit.empty(); ++y)
        std::memset(dst.row(y), 255, static_cast<std::size_t>(src.width()));
    for (int y = 0; y < src.height() && miss.empty(); ++y)
        std::memset(found.row(y), 0, static_cast<std::size_t>(src.width()));
    // Neither can fail after the checks above. A dilation takes the reflected element, so reflected twice.
    Status s = hit.empty() ? Status::ok : erode(src, hit, rest, dst);
    if (s == Status::ok && !miss.empty()) s = dilate(src, miss.reflected(), rest, found);
    if (s != Status::ok) return s;
    for (int y = 0; y < src.height(); ++y) kernels::hits_of_row(found.row(y), src.width(), dst.row(y));
    return Status::ok;
}

inline Status hit_or_miss(BitView<const BitWord> src, const StructuringElement& hit,
                          const StructuringElement& miss, Span<BitWord> scratch, BitView<BitWord> dst) {
    if (src.empty() || dst.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    if (hit.empty() && miss.empty()) return Status::bad_argument;
    for (const Size size : {hit.size(), miss.size()})
        if (size.width > 3 || size.height > 3) return Status::bad_argument;
    if (scratch.size() < bit_hit_or_miss_scratch(src.size())) return Status::scratch_too_small;
    const int words = bit_words(src.width());
    BitWord* line = scratch.data() + 1;
    line[-1] = ~BitWord{0};
    line[words] = ~BitWord{0};
    for (int y = 0; y < src.height(); ++y) {
        BitWord* to = dst.row(y);
        for (int i = 0; i < words; ++i) to[i] = ~BitWord{0};
        kernels::match_element(src, y, hit, 0, line, to);
        kernels::match_element(src, y, miss, ~BitWord{0}, line, to);
        to[words - 1] &= last_bits(src.width());
    }
    return Status::ok;
}

}  // namespace FOVEA_ISA
}  // namespace fovea
