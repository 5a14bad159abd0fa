// SPDX-License-Identifier: MIT
//
// What the golden vectors work on: static memory that a chip has too, the sizes, and the pictures.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/list.hpp>
#include <fovea/base/random.hpp>
#include <fovea/base/span.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/segment/connected_components.hpp>
#include <golden/digest.hpp>
#include <golden/plate.hpp>

namespace fovea::golden {

/// All memory of the vectors, used by one after the other.
struct Workspace {
    static constexpr Size picture_size{112, 76};
    static constexpr int image_bytes = picture_size.width * picture_size.height;
    static constexpr int images = 3;

    alignas(8) std::uint8_t image[images][image_bytes];
    /// The PNG encoder asks for the most.
    alignas(8) std::uint8_t scratch[54 * 1024];
    /// The picture of a part, once it was drawn: that takes longer than most of the vectors.
    std::uint8_t part[image_bytes];
    bool part_drawn = false;
    List<Region, 32> regions;
    List<Hole, 32> holes;

    Span<std::uint8_t> scratch_span() { return scratch; }
    /// One of the images as a view of any pixel; its rows are a few bytes apart where there is room.
    template <class Pixel>
    ImageView<Pixel> view(int number, Size size) {
        const std::int64_t packed = std::int64_t{size.width} * static_cast<int>(sizeof(Pixel));
        const std::int64_t padded = packed + 3 * static_cast<int>(sizeof(Pixel));
        const std::int64_t stride = padded * size.height <= image_bytes ? padded : packed;
        FOVEA_ASSERT(stride * size.height <= image_bytes);
        return {reinterpret_cast<Pixel*>(image[number]), size, static_cast<std::ptrdiff_t>(stride)};
    }
};
static_assert(sizeof(Workspace) <= 108 * 1024, "the vectors must fit a chip");

/// A pixel, a column, a row, narrower than any window, odd, and longer than three of the widest vectors.
inline constexpr Size sizes[] = {{1, 1}, {1, 9}, {9, 1}, {2, 2}, {5, 4}, {33, 7}, {64, 3}, {211, 5}};

enum class Filling : std::uint8_t { random, black, white, checkerboard };
inline constexpr Filling fillings[] = {Filling::random, Filling::black, Filling::white,
                                       Filling::checkerboard};

inline std::uint8_t random_byte(Random& random) { return static_cast<std::uint8_t>(random.next() >> 24); }

inline void fill(ImageView<Gray8> image, Filling filling, Random& random) {
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) switch (filling) {
                case Filling::random: image(x, y) = random_byte(random); break;
                case Filling::black: image(x, y) = 0; break;
                case Filling::white: image(x, y) = 255; break;
                case Filling::checkerboard: image(x, y) = (x + y) % 2 == 0 ? 255 : 0; break;
            }
}

/// 0 and 255 in clumps, so that regions have holes and these have islands.
inline void fill_clumps(ImageView<Gray8> image, Random& random) {
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) {
            const bool follow = random.below(4) != 0;
            const bool left = x > 0 && image(x - 1, y) != 0;
            const bool above = y > 0 && image(x, y - 1) != 0;
            const bool set = follow ? (random.below(2) != 0 ? left : above) : random.below(2) != 0;
            image(x, y) = set ? 255 : 0;
        }
}

/// The synthetic part, dark on a bright ground, turned by about 23 degrees.
inline void put_part(Workspace& work, ImageView<Gray8> image) {
    const ImageView<Gray8> part(work.part, Workspace::picture_size, Workspace::picture_size.width);
    if (!work.part_drawn) draw_plate(part, Plate{});
    work.part_drawn = true;
    for (int y = 0; y < part.height(); ++y)
        for (int x = 0; x < part.width(); ++x) image(x, y) = part(x, y);
}
inline ImageView<Gray8> part_picture(Workspace& work, int number) {
    const ImageView<Gray8> image = work.view<Gray8>(number, Workspace::picture_size);
    put_part(work, image);
    return image;
}

/// visit(src, dst) for every size and filling, and for the picture of a part.
template <class Visit>
void for_each_picture(Workspace& work, Visit visit) {
    for (const Size size : sizes)
        for (const Filling filling : fillings) {
            Random random(2026);
            const ImageView<Gray8> src = work.view<Gray8>(0, size);
            fill(src, filling, random);
            visit(src, work.view<Gray8>(1, size));
        }
    visit(part_picture(work, 0), work.view<Gray8>(1, Workspace::picture_size));
}

}  // namespace fovea::golden
