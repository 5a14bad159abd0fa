// SPDX-License-Identifier: MIT
//
// Text in the built-in font, plain and as a label on a box of its own.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/draw/font.hpp>
#include <fovea/draw/rectangle.hpp>
#include <fovea/draw/run.hpp>
#include <fovea/draw/utf8.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The largest magnification of the font.
inline constexpr int max_text_scale = 8;

/// The room that draw_text() needs: as wide as the longest line, as high as from the top of the first line to
/// what hangs below the last. A text without characters and a scale outside 1..max_text_scale need none.
constexpr Size text_size(Span<const char> utf8, int scale = 1);

/// Writes a text, its first line's upper left corner at top_left. '\n' begins a new line.
///
/// Shapes  any image, any place; a zero byte ends the text, so a string literal can be passed as it is
/// Units   scale 1..max_text_scale: each pixel of a glyph is scale by scale pixels. A character is 6 * scale
///         wide, a line 10 * scale high
/// Errors  empty_image; bad_argument for the scale. What the font lacks and what is not UTF-8 is no error, it
///         shows the replacement glyph
/// Source  font and layout own; UTF-8 as first_code_point()
template <class Pixel>
Status draw_text(ImageView<Pixel> image, Point top_left, Span<const char> utf8, NonDeduced<Pixel> colour,
                 int scale = 1);

/// The box of draw_label(): text_size() and 2 * scale on each side. Empty where text_size() is.
constexpr Size label_size(Span<const char> utf8, int scale = 1);

/// A text on a filled box, readable over any picture. top_left is the corner of the box. A text without
/// characters has no box.
///
/// Shapes  as draw_text()
/// Errors  empty_image; bad_argument for the scale
/// Source  as draw_text()
template <class Pixel>
Status draw_label(ImageView<Pixel> image, Point top_left, Span<const char> utf8, NonDeduced<Pixel> colour,
                  NonDeduced<Pixel> background, int scale = 1);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

inline constexpr int label_padding = 2;

constexpr bool text_scale_valid(int scale) { return scale >= 1 && scale <= max_text_scale; }

/// Goes through a text: each next() is a glyph and its place in columns and lines.
class TextWalk {
public:
    explicit constexpr TextWalk(Span<const char> utf8) : rest_(utf8) {}

    /// Finds the next glyph; false at the end of the text.
    constexpr bool next() {
        ++column_;
        while (!rest_.empty() && rest_[0] != '\0') {
            const CodePoint read = first_code_point(rest_);
            rest_ = rest_.from(read.bytes);
            if (read.value != '\n') {
                glyph_ = glyph_of(read.value);
                return true;
            }
            column_ = 0;
            ++line_;
        }
        return false;
    }
    constexpr int glyph() const { return glyph_; }
    constexpr std::int64_t column() const { return column_; }
    constexpr std::int64_t line() const { return line_; }

private:
    Span<const char> rest_;
    std::int64_t column_ = -1;
    std::int64_t line_ = 0;
    int glyph_ = 0;
};

template <class Pixel>
void draw_glyph(ImageView<Pixel> image, std::int64_t left, std::int64_t top, int glyph, int scale,
                Pixel colour) {
    if (left >= image.width() || left + glyph_width * scale <= 0) return;
    if (top >= image.height() || top + glyph_height * scale <= 0) return;
    for (int row = 0; row < glyph_height; ++row) {
        const std::uint32_t bits = glyph_row(glyph, row);
        for (int first = 0; first < glyph_width; ++first) {
            if ((bits >> (glyph_width - 1 - first) & 1) == 0) continue;
            int last = first;
            while (last + 1 < glyph_width && (bits >> (glyph_width - 2 - last) & 1) != 0) ++last;
            for (int i = 0; i < scale; ++i)
                fill_run(image, top + row * scale + i, left + first * scale, left + (last + 1) * scale - 1,
                         colour);
            first = last;
        }
    }
}

}  // namespace detail

constexpr Size text_size(Span<const char> utf8, int scale) {
    if (!detail::text_scale_valid(scale)) return {};
    detail::TextWalk walk(utf8);
    std::int64_t columns = 0;
    while (walk.next()) columns = maximum(columns, walk.column() + 1);
    if (columns == 0) return {};
    return {saturate_cast<int>((columns * glyph_advance - 1) * scale),
            saturate_cast<int>(((walk.line() + 1) * line_advance - 1) * scale)};
}

template <class Pixel>
Status draw_text(ImageView<Pixel> image, Point top_left, Span<const char> utf8, NonDeduced<Pixel> colour,
                 int scale) {
    if (image.empty()) return Status::empty_image;
    if (!detail::text_scale_valid(scale)) return Status::bad_argument;
    detail::TextWalk walk(utf8);
    while (walk.next())
        detail::draw_glyph<Pixel>(image, top_left.x + walk.column() * glyph_advance * scale,
                                  top_left.y + walk.line() * line_advance * scale, walk.glyph(), scale,
                                  colour);
    return Status::ok;
}

constexpr Size label_size(Span<const char> utf8, int scale) {
    const Size text = text_size(utf8, scale);
    if (text.empty()) return {};
    const std::int64_t padding = 2 * detail::label_padding * scale;
    return {saturate_cast<int>(text.width + padding), saturate_cast<int>(text.height + padding)};
}

template <class Pixel>
Status draw_label(ImageView<Pixel> image, Point top_left, Span<const char> utf8, NonDeduced<Pixel> colour,
                  NonDeduced<Pixel> background, int scale) {
    if (image.empty()) return Status::empty_image;
    if (!detail::text_scale_valid(scale)) return Status::bad_argument;
    const Size box = label_size(utf8, scale);
    if (Status s = fill_rectangle(image, {top_left.x, top_left.y, box.width, box.height}, background);
        s != Status::ok)
        return s;
    const int padding = detail::label_padding * scale;
    // A box that begins at the end of int has no room for text in any image.
    const Point corner{saturate_cast<int>(std::int64_t{top_left.x} + padding),
                       saturate_cast<int>(std::int64_t{top_left.y} + padding)};
    return draw_text(image, corner, utf8, colour, scale);
}

}  // namespace fovea
