// SPDX-License-Identifier: MIT
//
// The modules of a QR code taken from an image.
#pragma once

#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/base/span.hpp>
#include <fovea/code/finder_patterns.hpp>
#include <fovea/code/qr_locate.hpp>
#include <fovea/code/qr_tables.hpp>
#include <fovea/image/bit_view.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>

namespace fovea::detail {

/// Brightness at a place, between the four pixels around it; the outermost repeat. In 1/256 level, rounded
/// down.
inline int brightness(ImageView<const Gray8> image, ModulePoint place) {
    const std::int64_t x = clamp<std::int64_t>(place.x, 0, std::int64_t{image.width() - 1} * 256);
    const std::int64_t y = clamp<std::int64_t>(place.y, 0, std::int64_t{image.height() - 1} * 256);
    const int left = static_cast<int>(x >> 8);
    const int top = static_cast<int>(y >> 8);
    const int right = minimum(left + 1, image.width() - 1);
    const int bottom = minimum(top + 1, image.height() - 1);
    const int fx = static_cast<int>(x & 255);
    const int fy = static_cast<int>(y & 255);
    const int above = image(left, top) * (256 - fx) + image(right, top) * fx;
    const int below = image(left, bottom) * (256 - fx) + image(right, bottom) * fx;
    return (above * (256 - fy) + below * fy) >> 8;
}

/// Whether the middles of the outermost modules are in the image, and a pixel more.
inline bool grid_inside(const QrGrid& grid, int size, Size image) {
    for (int i = 0; i < 4; ++i) {
        const int x = i % 2 == 0 ? 0 : size - 1;
        const int y = i / 2 == 0 ? 0 : size - 1;
        const ModulePoint place = grid.plane(module_centre(x, y));
        if (place.x < -384 || place.y < -384 || place.x > std::int64_t{image.width} * 256 + 128 ||
            place.y > std::int64_t{image.height} * 256 + 128)
            return false;
    }
    return true;
}

/// visit(x, y, place) for the middle of every module.
template <class Visit>
void for_each_module(const QrGrid& grid, int size, Visit visit) {
    for (int y = 0; y < size; ++y) {
        ModulePlane::Walk walk(grid.plane, module_centre(0, y), module_units);
        for (int x = 0; x < size; ++x) visit(x, y, walk.next() + grid.departure_at(x, y));
    }
}

/// As the binary image has them.
inline void sample_bits(const FinderImage& image, const QrGrid& grid, BitView<BitWord> modules) {
    for_each_module(grid, modules.width(),
                    [&](int x, int y, ModulePoint place) { modules.set(x, y, image.dark(place)); });
}

/// Modules by their brightness: each compared with the middle between dark and light of those around.
class GrayModules {
public:
    /// Room for symbols of up to most modules a side.
    GrayModules(Span<std::int16_t> room, int most) : level_(room), most_(most) {}

    /// Brightness in 1/16 level.
    void sample(ImageView<const Gray8> image, const QrGrid& grid, int size) {
        size_ = size;
        for_each_module(grid, size, [&](int x, int y, ModulePoint place) {
            at(x, y) = static_cast<std::int16_t>(brightness(image, place) >> 4);
        });
    }
    /// In 1/16 level.
    int level(int x, int y) const { return at(x, y); }
    /// sharpen in 1/8: how much of a module's difference from its four neighbours is added to it, against the
    /// light that a blur carries over.
    void decide(int sharpen, bool inverted, BitView<BitWord> modules) const {
        for (int y = 0; y < size_; ++y) {
            for (int x = 0; x < size_; ++x) {
                const int own = at(x, y);
                const int four = at(clamp_side(x - 1), y) + at(clamp_side(x + 1), y) +
                                 at(x, clamp_side(y - 1)) + at(x, clamp_side(y + 1));
                const int value = own + (4 * own - four) * sharpen / 32;
                modules.set(x, y, (value < middle(x, y)) != inverted);
            }
        }
    }

private:
    static constexpr int reach = 4;

    int clamp_side(int x) const { return clamp(x, 0, size_ - 1); }
    int middle(int x, int y) const {
        int low = 32767;
        int high = 0;
        for (int j = clamp_side(y - reach); j <= clamp_side(y + reach); ++j) {
            for (int i = clamp_side(x - reach); i <= clamp_side(x + reach); ++i) {
                low = minimum<int>(low, at(i, j));
                high = maximum<int>(high, at(i, j));
            }
        }
        return (low + high) / 2;
    }
    std::int16_t& at(int x, int y) const { return level_[std::ptrdiff_t{y} * most_ + x]; }

    Span<std::int16_t> level_;
    int most_;
    int size_ = 0;
};

}  // namespace fovea::detail
