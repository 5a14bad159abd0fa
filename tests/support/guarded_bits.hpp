// SPDX-License-Identifier: MIT
//
// GuardedBits: a binary image of bits on the heap whose margins and row padding must survive, and whose bits
// behind the last pixel of a row are noise until an operator clears them. Host tests only.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/image/bit_view.hpp>
#include <fovea/image/image_view.hpp>

namespace fovea::test {

class GuardedBits {
public:
    explicit GuardedBits(Size size)
        : size_(size),
          stride_(bit_words(size.width) + 2),
          words_(static_cast<std::size_t>(2 * margin + stride_ * size.height), guard) {}
    ~GuardedBits() { EXPECT_TRUE(intact()) << "an operator wrote outside its bits"; }
    GuardedBits(const GuardedBits&) = default;

    BitView<BitWord> view() { return {words_.data() + margin, size_, stride_}; }
    BitView<const BitWord> view() const { return {words_.data() + margin, size_, stride_}; }
    bool operator()(int x, int y) const { return view()(x, y); }
    void set(int x, int y, bool value) { view().set(x, y, value); }

    /// Every pixel with a chance of share / 256, and noise behind the last one.
    void fill(Random& random, std::uint32_t share) {
        for (int y = 0; y < size_.height; ++y) {
            view().row(y)[bit_words(size_.width) - 1] = random.next();
            for (int x = 0; x < size_.width; ++x) set(x, y, random.below(256) < share);
        }
    }
    /// Whether all bits behind the last pixels are 0.
    bool clear_behind() const {
        for (int y = 0; y < size_.height; ++y)
            if ((view().row(y)[bit_words(size_.width) - 1] & ~last_bits(size_.width)) != 0) return false;
        return true;
    }
    bool intact() const {
        std::vector<BitWord> copy = words_;
        for (int y = 0; y < size_.height; ++y)
            for (int i = 0; i < bit_words(size_.width); ++i)
                copy[static_cast<std::size_t>(margin + y * stride_ + i)] = guard;
        for (const BitWord word : copy)
            if (word != guard) return false;
        return true;
    }
    friend bool operator==(const GuardedBits& a, const GuardedBits& b) { return a.words_ == b.words_; }

private:
    static constexpr std::ptrdiff_t margin = 16;
    static constexpr BitWord guard = 0xa55aa5c3u;
    Size size_;
    std::ptrdiff_t stride_;
    std::vector<BitWord> words_;
};

/// True when the bits are those pixels of an image that are not 0.
inline bool equal(const GuardedBits& bits, ImageView<const Gray8> image) {
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            if (bits(x, y) != (image(x, y) != 0)) return false;
    return bits.clear_behind();
}

/// The sizes of bits: around the ends of words besides.
inline std::vector<Size> bit_sizes() {
    return {{1, 1},  {1, 9},  {9, 1},  {2, 2},   {31, 5},   {32, 6},  {33, 7},
            {63, 4}, {64, 3}, {65, 8}, {97, 10}, {131, 70}, {300, 9}, {640, 4}};
}

}  // namespace fovea::test
