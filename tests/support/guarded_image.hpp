// SPDX-License-Identifier: MIT
//
// GuardedImage: an image on the heap whose margins and row padding must survive every operator. Host tests
// only.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/image/image_view.hpp>

namespace fovea::test {

/// Pixels with guard bytes before, after and between the rows.
template <class Pixel>
class GuardedImage {
public:
    explicit GuardedImage(Size size, int padding_pixels = 3)
        : size_(size),
          stride_((size.width + padding_pixels) * static_cast<std::ptrdiff_t>(sizeof(Pixel))),
          bytes_(static_cast<std::size_t>(2 * margin + stride_ * size.height), guard) {}

    ~GuardedImage() { EXPECT_TRUE(intact()) << "an operator wrote outside its image"; }
    GuardedImage(const GuardedImage&) = default;

    ImageView<Pixel> view() { return {reinterpret_cast<Pixel*>(bytes_.data() + margin), size_, stride_}; }
    ImageView<const Pixel> view() const {
        return {reinterpret_cast<const Pixel*>(bytes_.data() + margin), size_, stride_};
    }
    Pixel& operator()(int x, int y) { return view()(x, y); }
    const Pixel& operator()(int x, int y) const { return view()(x, y); }

    void fill(Pixel value) {
        for (int y = 0; y < size_.height; ++y)
            for (int x = 0; x < size_.width; ++x) (*this)(x, y) = value;
    }
    /// Random bytes in every pixel.
    void fill(Random& random) {
        for (int y = 0; y < size_.height; ++y) {
            auto* row = reinterpret_cast<std::uint8_t*>(view().row(y));
            for (std::size_t i = 0; i < sizeof(Pixel) * static_cast<std::size_t>(size_.width); ++i)
                row[i] = static_cast<std::uint8_t>(random.next() >> 13);
        }
    }
    bool intact() const {
        std::vector<std::uint8_t> copy = bytes_;
        for (int y = 0; y < size_.height; ++y)
            std::memset(copy.data() + margin + y * stride_, guard,
                        sizeof(Pixel) * static_cast<std::size_t>(size_.width));
        for (std::uint8_t byte : copy)
            if (byte != guard) return false;
        return true;
    }

private:
    static constexpr std::ptrdiff_t margin = 64;
    static constexpr std::uint8_t guard = 0xa5;
    Size size_;
    std::ptrdiff_t stride_;
    std::vector<std::uint8_t> bytes_;
};

/// True when both views have the same size and pixels.
template <class A, class B>
bool equal(ImageView<A> a, ImageView<B> b) {
    if (a.size() != b.size()) return false;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x)
            if (!(a(x, y) == b(x, y))) return false;
    return true;
}

/// The sizes every operator is tried on: 1x1, a row, a column, odd, even, around one to three vectors of 32.
inline const std::vector<Size>& test_sizes() {
    static const std::vector<Size> sizes = {{1, 1},  {1, 9},  {9, 1},   {2, 2},    {3, 3},
                                            {5, 4},  {7, 13}, {31, 5},  {32, 6},   {33, 7},
                                            {64, 3}, {65, 8}, {97, 10}, {131, 17}, {640, 4}};
    return sizes;
}

}  // namespace fovea::test
