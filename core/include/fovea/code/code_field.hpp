// SPDX-License-Identifier: MIT
//
// A gray image as the reader of Data Matrix sees it, and which borders in it were walked.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/image/bit_view.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>

namespace fovea::detail {

/// A gray image, turned about where light modules stand on dark ground. Beyond its sides all is light.
class CodeField {
public:
    CodeField() = default;
    CodeField(ImageView<const Gray8> image, bool inverted)
        : image_(image), flip_(inverted ? Gray8{255} : Gray8{0}) {}

    Size size() const { return image_.size(); }
    bool inverted() const { return flip_ != 0; }
    const Gray8* row(int y) const { return image_.row(y); }
    Gray8 flip() const { return flip_; }
    std::ptrdiff_t stride() const { return image_.stride_bytes(); }
    int pixel(int x, int y) const {
        if (x < 0 || y < 0 || x >= image_.width() || y >= image_.height()) return 255;
        return image_.row(y)[x] ^ flip_;
    }
    /// Between pixels, in 1/256 px; 1/16 levels: 0 to 4080.
    int sample(std::int32_t x, std::int32_t y) const {
        const int left = x >> 8;
        const int top = y >> 8;
        // As unsigned numbers those below 0 are too large.
        if (static_cast<unsigned>(left) >= static_cast<unsigned>(image_.width() - 1) ||
            static_cast<unsigned>(top) >= static_cast<unsigned>(image_.height() - 1))
            return sample_at_side(x, y);
        const Gray8* upper = image_.row(top) + left;
        const Gray8* lower = upper + image_.stride_bytes();
        return between(upper[0], upper[1], lower[0], lower[1], x & 255, y & 255);
    }

private:
    int between(int p00, int p10, int p01, int p11, int a, int b) const {
        const int upper = 256 * p00 + (p10 - p00) * a;
        const int lower = 256 * p01 + (p11 - p01) * a;
        const int value = (256 * upper + (lower - upper) * b) >> 12;
        return flip_ != 0 ? 4080 - value : value;
    }
    int sample_at_side(std::int32_t x, std::int32_t y) const {
        const auto raw = [&](int i, int j) { return pixel(i, j) ^ flip_; };
        const int left = x >> 8;
        const int top = y >> 8;
        return between(raw(left, top), raw(left + 1, top), raw(left, top + 1), raw(left + 1, top + 1),
                       x & 255, y & 255);
    }

    ImageView<const Gray8> image_;
    Gray8 flip_ = 0;
};

/// What sample() says at equal steps along a line.
class FieldSteps {
public:
    /// The first place and the way to the next in 2^-22 px, below 2^40: 14 bits finer than sample() takes
    /// them.
    FieldSteps(const CodeField& field, std::int64_t x, std::int64_t y, std::int64_t step_x,
               std::int64_t step_y)
        : field_(field), x_(x), y_(y), step_x_(step_x), step_y_(step_y) {}

    /// The sample at the place, which moves on.
    int next() {
        const int value =
            field_.sample(static_cast<std::int32_t>(x_ >> 14), static_cast<std::int32_t>(y_ >> 14));
        x_ += step_x_;
        y_ += step_y_;
        return value;
    }

private:
    CodeField field_;
    std::int64_t x_;
    std::int64_t y_;
    std::int64_t step_x_;
    std::int64_t step_y_;
};

/// Which sides of pixels borders have passed: two bits a pixel.
class PassedSides {
public:
    static constexpr std::int64_t words(Size size) {
        return 2 * std::int64_t{bit_words(size.width)} * size.height;
    }

    PassedSides(Span<BitWord> words, Size size)
        : words_(words),
          left_(words.data(), size, bit_words(size.width)),
          right_(words.data() + words.size() / 2, size, bit_words(size.width)) {}
    void clear() const {
        for (BitWord& word : words_) word = 0;
    }
    bool left(int x, int y) const { return left_(x, y); }
    bool right(int x, int y) const { return right_(x, y); }
    void pass_left(int x, int y) const { pass(left_, x, y); }
    void pass_right(int x, int y) const { pass(right_, x, y); }

private:
    static void pass(BitView<BitWord> sides, int x, int y) {
        const auto place = static_cast<unsigned>(x);
        sides.row(y)[place / bits_a_word] |= BitWord{1} << (place % bits_a_word);
    }

    Span<BitWord> words_;
    BitView<BitWord> left_;
    BitView<BitWord> right_;
};

}  // namespace fovea::detail
