// SPDX-License-Identifier: MIT
//
// BitView: a binary image of one bit a pixel, an eighth of the memory that bytes take. 640x480 fit 38 KB.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <fovea/base/assert.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>

namespace fovea {

/// 32 pixels of a row: pixel x is bit x % 32 of word x / 32, counted from the lowest, on every machine.
using BitWord = std::uint32_t;
inline constexpr int bits_a_word = 32;

/// Words that a row of bits takes.
constexpr int bit_words(int width) { return width / bits_a_word + (width % bits_a_word != 0 ? 1 : 0); }
/// The bits of a row's last word that are pixels.
constexpr BitWord last_bits(int width) {
    return width % bits_a_word == 0 ? ~BitWord{0} : (BitWord{1} << (width % bits_a_word)) - 1;
}

/// Pointer, size and distance of rows in words. Bits behind the last pixel of a row: every operator writes
/// zeros there and minds nothing that it finds.
template <class Word>
class BitView {
    static_assert(std::is_same_v<std::remove_const_t<Word>, BitWord>, "bits are made of BitWord");

public:
    constexpr BitView() = default;
    /// For memory that is known to fit. Foreign memory goes through bit_view_over().
    constexpr BitView(Word* first, Size size, std::ptrdiff_t stride_words)
        : first_(first), size_(size), stride_words_(stride_words) {
        FOVEA_ASSERT(size.width >= 0 && size.height >= 0);
    }
    template <class Other, class = std::enable_if_t<std::is_same_v<const Other, Word>>>
    constexpr BitView(BitView<Other> other)
        : first_(other.first()), size_(other.size()), stride_words_(other.stride_words()) {}

    constexpr Word* first() const { return first_; }
    constexpr Size size() const { return size_; }
    constexpr int width() const { return size_.width; }
    constexpr int height() const { return size_.height; }
    constexpr std::ptrdiff_t stride_words() const { return stride_words_; }
    constexpr bool empty() const { return size_.empty(); }

    constexpr Word* row(int y) const {
        FOVEA_ASSERT(y >= 0 && y < height());
        return first_ + y * stride_words_;
    }
    constexpr bool operator()(int x, int y) const {
        FOVEA_ASSERT(x >= 0 && x < width());
        return (row(y)[x / bits_a_word] >> (x % bits_a_word) & 1) != 0;
    }
    constexpr void set(int x, int y, bool value) const {
        FOVEA_ASSERT(x >= 0 && x < width());
        BitWord& word = row(y)[x / bits_a_word];
        const BitWord bit = BitWord{1} << (x % bits_a_word);
        word = value ? word | bit : word & ~bit;
    }

private:
    Word* first_ = nullptr;
    Size size_;
    std::ptrdiff_t stride_words_ = 0;
};

/// Foreign words as a binary image.
///
/// Shapes  height rows of bit_words(width), stride_words apart; the last row needs only its own
/// Errors  empty_image; image_too_large above max_image_side; bad_argument for a stride shorter than a row;
///         truncated if words are too few
template <class Word>
constexpr Result<BitView<Word>> bit_view_over(Span<Word> words, Size size, std::ptrdiff_t stride_words) {
    if (size.empty()) return Status::empty_image;
    if (size.width > max_image_side || size.height > max_image_side) return Status::image_too_large;
    const std::int64_t row = bit_words(size.width);
    const std::int64_t stride = stride_words;
    if (stride < row) return Status::bad_argument;
    // Compared by division, so that no stride overflows the product.
    const std::int64_t room = words.size() - row;
    if (room < 0 || (size.height > 1 && stride > room / (size.height - 1))) return Status::truncated;
    return BitView<Word>(words.data(), size, stride_words);
}

/// Owns a binary image, zero at first, rows without gaps.
template <int Width, int Height>
class BitStorage {
public:
    static_assert(Width > 0 && Height > 0, "an image has at least one pixel");
    static_assert(Width <= max_image_side && Height <= max_image_side,
                  "an image side is at most max_image_side");

    constexpr BitView<BitWord> view() { return {words_, {Width, Height}, bit_words(Width)}; }
    constexpr BitView<const BitWord> view() const { return {words_, {Width, Height}, bit_words(Width)}; }

private:
    BitWord words_[static_cast<std::size_t>(bit_words(Width)) * Height]{};
};

}  // namespace fovea
