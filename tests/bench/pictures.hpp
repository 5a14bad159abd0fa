// SPDX-License-Identifier: MIT
//
// Pictures to time operators on, in memory of their own.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/random.hpp>
#include <fovea/base/span.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>

#include <bench/memory.hpp>
#include <golden/plate.hpp>

namespace fovea::bench {

inline Span<std::uint8_t> span_of(Bytes& bytes) {
    return {bytes.data(), static_cast<std::ptrdiff_t>(bytes.size())};
}
inline Bytes bytes(std::int64_t count) { return Bytes(static_cast<std::size_t>(count)); }

/// An image that owns its pixels.
template <class Pixel>
class Picture {
public:
    explicit Picture(Size size) : size_(size), pixels_(static_cast<std::size_t>(size.area())) {}

    ImageView<Pixel> view() {
        return {pixels_.data(), size_, size_.width * static_cast<std::ptrdiff_t>(sizeof(Pixel))};
    }
    Pixel* data() { return pixels_.data(); }

private:
    Size size_;
    Memory<Pixel> pixels_;
};

/// The plate in the middle of an image, as large as fits well.
inline golden::Plate plate_in(Size size) {
    golden::Plate plate;
    plate.scale = size.height / 96;
    plate.centre_x = size.width * 4 + 3;
    plate.centre_y = size.height * 4 - 2;
    return plate;
}

/// The part on a bright ground with a little noise, as a camera sees it.
inline Picture<Gray8> part(Size size) {
    Picture<Gray8> picture(size);
    golden::draw_plate(picture.view(), plate_in(size));
    return picture;
}

/// The same with a colour cast.
inline Picture<Rgb888> coloured_part(Size size) {
    Picture<Gray8> gray = part(size);
    Picture<Rgb888> picture(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const Gray8 level = gray.view()(x, y);
            picture.view()(x, y) = {level, static_cast<Gray8>(level * 7 / 8),
                                    static_cast<Gray8>(255 - level / 2)};
        }
    return picture;
}

/// Some hundred discs, 255 on 0.
inline Picture<Gray8> blobs(Size size) {
    Picture<Gray8> picture(size);
    Random random(99);
    for (int i = 0; i < 400; ++i) {
        const int cx = random.between(0, size.width - 1);
        const int cy = random.between(0, size.height - 1);
        const int radius = random.between(2, size.height / 30);
        for (int y = cy - radius; y <= cy + radius; ++y)
            for (int x = cx - radius; x <= cx + radius; ++x)
                if (picture.view().contains({x, y}) &&
                    (x - cx) * (x - cx) + (y - cy) * (y - cy) < radius * radius)
                    picture.view()(x, y) = 255;
    }
    return picture;
}

}  // namespace fovea::bench
