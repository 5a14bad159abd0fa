// SPDX-License-Identifier: MIT
//
// What the fuzz programs of the picture formats share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/codec/picture.hpp>
#include <fovea/image/image_view.hpp>

namespace fovea::fuzz {

/// Stops the program, so that the fuzzer keeps the input.
inline void require(bool claim) {
    if (!claim) __builtin_trap();
}

/// An image on the heap of exactly its size, so that a sanitizer sees whoever writes beside it.
template <class Pixel>
class HeapImage {
public:
    explicit HeapImage(Size size) : size_(size), pixels_(static_cast<std::size_t>(size.area())) {}
    ImageView<Pixel> view() {
        return {pixels_.data(), size_, static_cast<std::ptrdiff_t>(sizeof(Pixel)) * size_.width};
    }
    bool operator==(const HeapImage& other) const { return size_ == other.size_ && pixels_ == other.pixels_; }

private:
    Size size_;
    std::vector<Pixel> pixels_;
};

inline Span<std::uint8_t> room_in(std::vector<std::uint8_t>& bytes) {
    return {bytes.data(), static_cast<std::ptrdiff_t>(bytes.size())};
}

/// Decodes a file of a moderate size into all three pixels.
template <class Decode>
void decode_into_every_pixel(Span<const std::uint8_t> bytes, const Result<PictureInfo>& info, Decode decode) {
    // What cannot be inspected cannot be decoded either, and both say the same.
    const Size size = info ? info->size : Size{1, 1};
    require(!size.empty() && size.width <= max_image_side && size.height <= max_image_side);
    if (size.width > 512 || size.height > 512) return;
    HeapImage<Gray8> gray(size);
    HeapImage<Gray16> wide(size);
    HeapImage<Rgb888> colour(size);
    const Status status = decode(bytes, colour.view());
    require(decode(bytes, gray.view()) == status && decode(bytes, wide.view()) == status);
    require(info.ok() || status == info.status());
}

/// Takes the bytes as samples of an image, writes it into exactly the room it may need, and reads it back.
template <class Pixel, class Bound, class Encode, class Decode>
void read_back(Span<const std::uint8_t> bytes, Bound bound, Encode encode, Decode decode) {
    if (bytes.size() < 3) return;
    const Size size{1 + bytes[0] % 32, 1 + bytes[1] % 32};
    HeapImage<Pixel> src(size);
    auto* samples = reinterpret_cast<std::uint8_t*>(src.view().first());
    const auto count = static_cast<std::ptrdiff_t>(sizeof(Pixel)) * static_cast<std::ptrdiff_t>(size.area());
    for (std::ptrdiff_t i = 0; i < count; ++i) samples[i] = bytes[2 + i % (bytes.size() - 2)];
    std::vector<std::uint8_t> file(static_cast<std::size_t>(bound(size)));
    const Result<std::ptrdiff_t> length = encode(ImageView<const Pixel>(src.view()), room_in(file));
    require(length.ok());
    file.resize(static_cast<std::size_t>(*length));
    file.shrink_to_fit();
    HeapImage<Pixel> dst(size);
    require(decode(Span<const std::uint8_t>(room_in(file)), dst.view()) == Status::ok);
    require(src == dst);
}

}  // namespace fovea::fuzz
