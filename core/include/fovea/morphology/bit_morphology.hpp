// SPDX-License-Identifier: MIT
//
// Erosion and dilation of binary images of one bit a pixel: 32 pixels a word. Book sec. 2.7.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/bit_view.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/morphology/morphology.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/simd/bits.hpp>
#include <fovea/simd/isa.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Scratch words of erode() and dilate() of bits: a row with room at its ends.
constexpr std::int64_t bit_erode_scratch(Size size) { return bit_words(size.width) + 2; }
constexpr std::int64_t bit_dilate_scratch(Size size) { return bit_erode_scratch(size); }

inline namespace FOVEA_ISA {

/// Sets the pixels all of whose rectangle is set.
///
/// Shapes   src and dst equal, 1x1 or larger; element odd by odd, 1x1 to 63x63
/// Border   only pixels of the image count, as in erode() of bytes, which does the same
/// Overlap  none: dst must not share words with src
/// Scratch  bit_erode_scratch(src.size()) words, undefined afterwards
/// Errors   empty_image, size_mismatch, bad_argument for an even, too small or too large element,
///          scratch_too_small
/// Source   book sec. 2.7.2: the rectangle's rows, then its columns by windows of 1, 2, 4 ... pixels
inline Status erode(BitView<const BitWord> src, Size element, Span<BitWord> scratch, BitView<BitWord> dst);
/// Sets the pixels that have one in their rectangle. All else as erode().
inline Status dilate(BitView<const BitWord> src, Size element, Span<BitWord> scratch, BitView<BitWord> dst);

/// The same with a cross, the middle row and the middle column of the rectangle.
inline Status erode_cross(BitView<const BitWord> src, Size element, Span<BitWord> scratch,
                          BitView<BitWord> dst);
inline Status dilate_cross(BitView<const BitWord> src, Size element, Span<BitWord> scratch,
                           BitView<BitWord> dst);

// ---- Implementation ---------------------------------------------------------------

namespace kernels {

/// What all pixels of a window have; pixels that do not count are set. Of one word or of many.
struct AllBits {
    static constexpr BitWord neutral = ~BitWord{0};
    template <class Piece>
    [[gnu::always_inline]] static Piece of(Piece a, Piece b) {
        return a & b;
    }
};
/// What one of them has.
struct AnyBit {
    static constexpr BitWord neutral = 0;
    template <class Piece>
    [[gnu::always_inline]] static Piece of(Piece a, Piece b) {
        return a | b;
    }
};

/// Words of a line moved to the right and to the left by 1 to 31 pixels: those before and behind come in.
template <class Piece>
[[gnu::always_inline]] inline Piece earlier_bits(const BitWord* at, int by) {
    return simd::load_piece<Piece>(at) << by | simd::load_piece<Piece>(at - 1) >> (bits_a_word - by);
}
template <class Piece>
[[gnu::always_inline]] inline Piece later_bits(const BitWord* at, int by) {
    return simd::load_piece<Piece>(at) >> by | simd::load_piece<Piece>(at + 1) << (bits_a_word - by);
}

/// A row of bits with a word in front of it and one behind it that do not count.
template <class Of>
class BitLine {
public:
    BitLine(Span<BitWord> scratch, int width)
        : words_(scratch.data() + 1),
          count_(bit_words(width)),
          ground_(~last_bits(width) & Of::neutral),
          last_(last_bits(width)) {}

    BitWord* words() { return words_; }
    /// Says that the words are written: what is behind the last pixel does not count.
    void close() {
        words_[-1] = Of::neutral;
        words_[count_ - 1] = (words_[count_ - 1] & last_) | ground_;
        words_[count_] = Of::neutral;
    }

    /// dst = the windows of width pixels around each pixel; uses the line up.
    void across(int width, BitWord* dst) {
        BitWord* const line = words_;
        const auto word = [line](int i, auto kind) { return simd::load_piece<decltype(kind)>(line + i); };
        const auto earlier = [line](int i, int by, auto kind) {
            return earlier_bits<decltype(kind)>(line + i, by);
        };
        const auto later = [line](int i, int by, auto kind) {
            return later_bits<decltype(kind)>(line + i, by);
        };
        const auto make = [&](auto make_one) { simd::make_words(0, count_, dst, make_one); };
        if (width == 1) make(word);
        if (width == 3)
            make([=](int i, auto kind) {
                return Of::of(word(i, kind), Of::of(earlier(i, 1, kind), later(i, 1, kind)));
            });
        if (width > 3) {
            // A word comes to hold the windows that begin at its pixels: of one pixel, then of twice as many.
            // Those that begin up to a word before the row are held too.
            int length = 1;
            for (; 2 * length <= width; length *= 2)
                simd::make_words(-1, count_, line, [=](int i, auto kind) {
                    return Of::of(word(i, kind), later(i, length, kind));
                });
            // Two such windows, which meet or overlap, are the one around a pixel: they begin so many pixels
            // before it.
            const int reach = width / 2;
            const int second = length - 1 - reach;
            if (second == 0)
                make([=](int i, auto kind) { return Of::of(earlier(i, reach, kind), word(i, kind)); });
            else
                make([=](int i, auto kind) {
                    return Of::of(earlier(i, reach, kind), earlier(i, second, kind));
                });
        }
        dst[count_ - 1] &= last_;
    }

private:
    BitWord* words_;
    int count_;
    BitWord ground_;
    BitWord last_;
};

/// to = what the rows of a column of a height around row y have.
template <class Of>
void bits_down(BitView<const BitWord> src, int y, int height, BitWord* to) {
    const int words = bit_words(src.width());
    const int first = maximum(y - height / 2, 0);
    const int last = minimum(y + height / 2, src.height() - 1);
    // A row twice is that row: near the end of the image and of the column the last one fills up.
    const auto row = [&](int k) { return src.row(minimum(k, last)); };
    const BitWord* a = row(first);
    const BitWord* b = row(first + 1);
    const BitWord* c = row(first + 2);
    simd::make_words(0, words, to, [=](int i, auto kind) {
        using Piece = decltype(kind);
        return Of::of(simd::load_piece<Piece>(a + i),
                      Of::of(simd::load_piece<Piece>(b + i), simd::load_piece<Piece>(c + i)));
    });
    for (int k = first + 3; k <= last; k += 2) {
        a = row(k);
        b = row(k + 1);
        simd::make_words(0, words, to, [=](int i, auto kind) {
            using Piece = decltype(kind);
            return Of::of(simd::load_piece<Piece>(to + i),
                          Of::of(simd::load_piece<Piece>(a + i), simd::load_piece<Piece>(b + i)));
        });
    }
}

inline Status check_bit_morphology(BitView<const BitWord> src, Size element, Span<BitWord> scratch,
                                   BitView<const BitWord> dst) {
    if (src.empty() || dst.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    if (!is_rectangle(element)) return Status::bad_argument;
    if (scratch.size() < bit_erode_scratch(src.size())) return Status::scratch_too_small;
    return Status::ok;
}

template <class Of>
Status bit_rectangle(BitView<const BitWord> src, Size element, Span<BitWord> scratch, BitView<BitWord> dst) {
    if (Status s = check_bit_morphology(src, element, scratch, dst); s != Status::ok) return s;
    BitLine<Of> line(scratch, src.width());
    for (int y = 0; y < src.height(); ++y) {
        bits_down<Of>(src, y, element.height, line.words());
        line.close();
        line.across(element.width, dst.row(y));
    }
    return Status::ok;
}

template <class Of>
Status bit_cross(BitView<const BitWord> src, Size element, Span<BitWord> scratch, BitView<BitWord> dst) {
    if (Status s = check_bit_morphology(src, element, scratch, dst); s != Status::ok) return s;
    BitLine<Of> line(scratch, src.width());
    const int words = bit_words(src.width());
    const BitWord last = last_bits(src.width());
    for (int y = 0; y < src.height(); ++y) {
        std::memcpy(line.words(), src.row(y), sizeof(BitWord) * static_cast<std::size_t>(words));
        line.close();
        BitWord* to = dst.row(y);
        line.across(element.width, to);
        bits_down<Of>(src, y, element.height, line.words());
        const BitWord* column = line.words();
        simd::make_words(0, words, to, [=](int i, auto kind) {
            using Piece = decltype(kind);
            return Of::of(simd::load_piece<Piece>(to + i), simd::load_piece<Piece>(column + i));
        });
        to[words - 1] &= last;
    }
    return Status::ok;
}

}  // namespace kernels

inline Status erode(BitView<const BitWord> src, Size element, Span<BitWord> scratch, BitView<BitWord> dst) {
    return kernels::bit_rectangle<kernels::AllBits>(src, element, scratch, dst);
}
inline Status dilate(BitView<const BitWord> src, Size element, Span<BitWord> scratch, BitView<BitWord> dst) {
    return kernels::bit_rectangle<kernels::AnyBit>(src, element, scratch, dst);
}
inline Status erode_cross(BitView<const BitWord> src, Size element, Span<BitWord> scratch,
                          BitView<BitWord> dst) {
    return kernels::bit_cross<kernels::AllBits>(src, element, scratch, dst);
}
inline Status dilate_cross(BitView<const BitWord> src, Size element, Span<BitWord> scratch,
                           BitView<BitWord> dst) {
    return kernels::bit_cross<kernels::AnyBit>(src, element, scratch, dst);
}

}  // namespace FOVEA_ISA
}  // namespace fovea
