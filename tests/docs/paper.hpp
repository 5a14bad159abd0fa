// SPDX-License-Identifier: MIT
//
// What the pictures of docs/operators are drawn on: scenes as a camera sees them, and paper.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/codec/png_writer.hpp>
#include <fovea/draw/rectangle.hpp>
#include <fovea/draw/text.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/number/decimal.hpp>
#include <fovea/number/fixed.hpp>

#include <common/picture_file.hpp>

namespace fovea::test {

using apps::Picture;

inline constexpr Rgb888 paper{250, 250, 248};
inline constexpr Rgb888 ink{40, 44, 52};
inline constexpr Rgb888 faint{214, 214, 210};
inline constexpr Rgb888 blue{31, 110, 190};
inline constexpr Rgb888 orange{232, 120, 20};
inline constexpr Rgb888 green{24, 150, 70};
inline constexpr Rgb888 red{208, 40, 48};
inline constexpr Rgb888 white{255, 255, 255};

inline void must(Status status) {
    if (status == Status::ok) return;
    std::fprintf(stderr, "pictures: %s\n", describe(status));
    std::exit(1);
}
template <class T>
T must(const Result<T>& result) {
    must(result.status());
    return *result;
}

template <class T>
Span<T> span_of(std::vector<T>& elements) {
    return {elements.data(), static_cast<std::ptrdiff_t>(elements.size())};
}
inline Span<const char> span_of(const std::string& text) {
    return {text.data(), static_cast<std::ptrdiff_t>(text.size())};
}

/// A number of pixels with two places.
inline std::string pixels(FinePixel length) {
    char text[32];
    const std::int64_t millionths = round_shift(std::int64_t{length.raw()} * 1000000, 16);
    const int size = must(print_decimal({millionths}, 2, text));
    return std::string(text, static_cast<std::size_t>(size));
}

inline FinePoint place(std::int64_t numerator_x, std::int64_t numerator_y, std::int64_t denominator) {
    return {FinePixel::from_ratio(numerator_x, denominator), FinePixel::from_ratio(numerator_y, denominator)};
}

// ---- What a camera sees ---------------------------------------------------------------

/// Points of a pixel along one side; shapes are given in them.
inline constexpr int grain = 16;

/// The picture of all places for which inside(x, y) holds, in 1/16 px: each pixel is the mean over its
/// square, blurred by the binomial filter (variance 1/2 px^2 a pass), with noise of up to +-noise grey
/// levels.
template <class Inside>
Picture<Gray8> render(Size size, int outside_level, int inside_level, int passes, int noise, Inside inside) {
    Picture<Gray8> picture(size);
    std::vector<int> sums(static_cast<std::size_t>(size.area()));
    const auto at = [&](std::vector<int>& values, int x, int y) -> int& {
        return values[static_cast<std::size_t>(clamp(y, 0, size.height - 1) * size.width +
                                               clamp(x, 0, size.width - 1))];
    };
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            int count = 0;
            for (int i = 0; i < grain * grain; ++i)
                count += inside(grain * x + i % grain - grain / 2, grain * y + i / grain - grain / 2) ? 1 : 0;
            at(sums, x, y) = 256 * outside_level + count * (inside_level - outside_level);
        }
    for (int pass = 0; pass < passes; ++pass)
        for (const Point step : {Point{1, 0}, Point{0, 1}}) {
            std::vector<int> old = sums;
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x)
                    at(sums, x, y) = round_shift(
                        at(old, x - step.x, y - step.y) + 2 * at(old, x, y) + at(old, x + step.x, y + step.y),
                        2);
        }
    Random random(1);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const int level = round_shift(at(sums, x, y), 8) + random.between(-noise, noise);
            picture.view()(x, y) = saturate_cast<Gray8>(level);
        }
    return picture;
}

inline bool in_circle(int x, int y, int centre_x, int centre_y, int radius) {
    return (x - centre_x) * (x - centre_x) + (y - centre_y) * (y - centre_y) < radius * radius;
}
inline bool in_rectangle(int x, int y, int left, int top, int right, int bottom) {
    return x >= left && x < right && y >= top && y < bottom;
}

// ---- Paper ----------------------------------------------------------------------------

class Canvas {
public:
    explicit Canvas(Size size) : picture_(size) {
        must(fill_rectangle(view(), {0, 0, size.width, size.height}, paper));
    }

    ImageView<Rgb888> view() { return picture_.view(); }

    void text(Point corner, const std::string& words, Rgb888 colour = ink, int scale = 1) {
        must(draw_text(view(), corner, span_of(words), colour, scale));
    }
    void label(Point corner, const std::string& words, Rgb888 colour) {
        must(draw_label(view(), corner, span_of(words), white, colour));
    }

    void save(const std::string& name) {
        std::vector<std::uint8_t> scratch(static_cast<std::size_t>(png_writer_scratch(picture_.size)));
        std::vector<std::uint8_t> file(static_cast<std::size_t>(encoded_png_bytes<Rgb888>(picture_.size)));
        const std::ptrdiff_t length = must(encode_png(view(), span_of(scratch), span_of(file)));
        std::FILE* out = std::fopen(name.c_str(), "wb");
        const auto bytes = static_cast<std::size_t>(length);
        if (out == nullptr || std::fwrite(file.data(), 1, bytes, out) != bytes || std::fclose(out) != 0)
            must(Status::io_error);
        std::printf("%s: %d bytes\n", name.c_str(), static_cast<int>(length));
    }

private:
    Picture<Rgb888> picture_;
};

/// A picture on paper, every pixel of it a square of zoom x zoom.
class Enlarged {
public:
    Enlarged(Canvas& canvas, Point corner, int zoom) : canvas_(canvas), corner_(corner), zoom_(zoom) {}

    void put(ImageView<const Gray8> image) {
        for (int y = 0; y < image.height(); ++y)
            for (int x = 0; x < image.width(); ++x) {
                const Gray8 level = image(x, y);
                colour(x, y, {level, level, level});
            }
    }
    void colour(int x, int y, Rgb888 colour) {
        must(fill_rectangle(canvas_.view(), box({x, y, 1, 1}), colour));
    }
    Rectangle box(Rectangle area) const {
        return {corner_.x + area.x * zoom_, corner_.y + area.y * zoom_, area.width * zoom_,
                area.height * zoom_};
    }
    /// Where a place of the picture is on paper: the centre of a pixel is in the middle of its square.
    Point at(FinePoint where) const { return {corner_.x + along(where.x), corner_.y + along(where.y)}; }

private:
    int along(FinePixel where) const {
        return static_cast<int>((2 * std::int64_t{where.raw()} + FinePixel::one) * zoom_ / 2 >> 16);
    }

    Canvas& canvas_;
    Point corner_;
    int zoom_;
};

}  // namespace fovea::test
