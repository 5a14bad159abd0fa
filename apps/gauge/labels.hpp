// SPDX-License-Identifier: MIT
//
// Labels over a drawing: each finds a free place near what it tells of, away from other labels and, where it
// can, from the lines of the drawing.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <fovea/draw/line.hpp>
#include <fovea/draw/text.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/number/integer.hpp>

#include <common/picture_file.hpp>
#include <common/text.hpp>

namespace fovea::apps {

/// A text broken at its spaces into lines of at most so many characters, where a word is not longer.
std::string wrapped(const std::string& text, std::size_t characters);

/// One line of a label, or several that are one text with '\n' in it.
struct LabelLine {
    std::string text;
    Rgb888 colour;
};

/// The labels of one picture. First come, first served: place the important ones first.
class Labels {
public:
    /// Over a drawing of colours on grey, whose coloured pixels are better not covered. paper is what the
    /// labels are filled with, scale the magnification of their text.
    Labels(const Picture<Rgb888>& drawing, int scale, Rgb888 paper);

    /// Puts lines below each other with their lower left corner there, or as near as it can. Answers where
    /// they are; empty if there was no room, and then they are not shown.
    Rectangle put_above(Point corner, const std::vector<LabelLine>& lines);

    /// Puts a label beside a point, and ties it to the point with a line if it has to be farther away.
    Rectangle put_beside(Point anchor, const LabelLine& line);

    /// Draws them all, so that no line crosses a text.
    void draw(Picture<Rgb888>& picture) const;

private:
    struct Label {
        Rectangle box;
        Point anchor;
        bool tied;
        LabelLine line;
    };
    struct Candidate {
        Rectangle box;
        std::int64_t cost;
    };

    static constexpr int rings = 60;
    static constexpr std::int64_t impossible = std::int64_t{1} << 40;

    std::int64_t cost_of(const Rectangle& box) const;
    void consider(const Rectangle& box, std::int64_t distance, Candidate& best) const;
    bool take(const Candidate& best);

    template <class Visit>
    void visit_cells(const Rectangle& box, const Visit& visit) const {
        for (int y = box.y / cell_; y <= box.bottom() / cell_; ++y)
            for (int x = box.x / cell_; x <= box.right() / cell_; ++x)
                visit(static_cast<std::size_t>(y) * static_cast<std::size_t>(cells_.width) +
                      static_cast<std::size_t>(x));
    }

    Size size_;
    int scale_;
    Rgb888 paper_;
    int cell_;  ///< pixels a side: what is free and what is drawn on is known in such squares
    Size cells_;
    std::vector<std::uint8_t> taken_;
    std::vector<std::uint8_t> drawn_on_;
    std::vector<Label> labels_;
};

// ---- Implementation ---------------------------------------------------------------

inline std::string wrapped(const std::string& text, std::size_t characters) {
    std::string lines;
    std::size_t length = 0;
    for (const std::string& word : split(text, ' ')) {
        const bool fits = length + 1 + word.size() <= characters;
        if (!lines.empty()) lines += fits ? ' ' : '\n';
        length = (fits && !lines.empty() ? length + 1 : 0) + word.size();
        lines += word;
    }
    return lines;
}

inline Labels::Labels(const Picture<Rgb888>& drawing, int scale, Rgb888 paper)
    : size_(drawing.size),
      scale_(scale),
      paper_(paper),
      cell_(3 * scale),
      cells_{(size_.width + cell_ - 1) / cell_, (size_.height + cell_ - 1) / cell_} {
    taken_.resize(static_cast<std::size_t>(cells_.area()));
    drawn_on_.resize(taken_.size());
    const auto view = drawing.view();
    for (int y = 0; y < size_.height; ++y)
        for (int x = 0; x < size_.width; ++x) {
            const Rgb888 pixel = view(x, y);
            if (pixel.red != pixel.green || pixel.green != pixel.blue)
                visit_cells({x, y, 1, 1}, [&](std::size_t i) { drawn_on_[i] = 1; });
        }
}

/// What it costs to cover what is below, in pixels of distance: a line that is crossed is worth going a
/// label's height away.
inline std::int64_t Labels::cost_of(const Rectangle& box) const {
    std::int64_t cost = 0;
    visit_cells(box, [&](std::size_t i) { cost += taken_[i] != 0 ? impossible : drawn_on_[i] * scale_; });
    return cost;
}

inline void Labels::consider(const Rectangle& box, std::int64_t distance, Candidate& best) const {
    if (box.x < 0 || box.y < 0 || box.right() >= size_.width || box.bottom() >= size_.height) return;
    const std::int64_t cost = cost_of(box) + distance;
    if (cost < best.cost) best = {box, cost};
}

inline bool Labels::take(const Candidate& best) {
    if (best.cost >= impossible) return false;
    visit_cells(best.box, [&](std::size_t i) { taken_[i] = 1; });
    return true;
}

inline Rectangle Labels::put_above(Point corner, const std::vector<LabelLine>& lines) {
    Size size{0, -scale_};
    for (const LabelLine& line : lines) {
        const Size one = label_size(span_of(line.text), scale_);
        size = {maximum(size.width, one.width), size.height + one.height + scale_};
    }
    // A text that is wider than the picture is cut off on its right.
    size = {minimum(size.width, size_.width), minimum(size.height, size_.height)};
    const Rectangle wanted{clamp(corner.x, 0, size_.width - size.width),
                           clamp(corner.y - size.height, 0, size_.height - size.height), size.width,
                           size.height};
    if (wanted.empty()) return {};
    Candidate best{{}, impossible};
    if (cost_of(wanted) < impossible) best = {wanted, 0};
    for (int ring = 1; ring < rings && best.cost > 0; ++ring) {
        const int step = ring * cell_;
        if (best.cost <= step) break;
        for (const int side : {1, -1}) {
            consider({wanted.x, wanted.y + side * step, size.width, size.height}, step, best);
            consider({wanted.x + side * step, wanted.y, size.width, size.height}, step, best);
        }
    }
    if (!take(best)) return {};
    int y = best.box.y;
    for (const LabelLine& line : lines) {
        const Size one = label_size(span_of(line.text), scale_);
        labels_.push_back({{best.box.x, y, one.width, one.height}, {}, false, line});
        y += one.height + scale_;
    }
    return best.box;
}

inline Rectangle Labels::put_beside(Point anchor, const LabelLine& line) {
    const Size size = label_size(span_of(line.text), scale_);
    const Point seen{clamp(anchor.x, 0, size_.width - 1), clamp(anchor.y, 0, size_.height - 1)};
    Candidate best{{}, impossible};
    for (int ring = 0; ring < rings; ++ring) {
        const int away = 7 * scale_ + ring * 2 * cell_;
        if (best.cost <= away) break;
        // To the right and left of the point, then above and below it, at several heights and offsets.
        for (const int part : {2, 1, 3, 0, 4}) {
            const int y = seen.y - size.height - away / 2 + (size.height + away) * part / 4;
            const int x = seen.x - size.width - away / 2 + (size.width + away) * part / 4;
            const std::int64_t distance = away + (part == 2 ? 0 : scale_);
            consider({seen.x + away, y, size.width, size.height}, distance, best);
            consider({seen.x - away - size.width, y, size.width, size.height}, distance + scale_, best);
            consider({x, seen.y + away, size.width, size.height}, distance + scale_, best);
            consider({x, seen.y - away - size.height, size.width, size.height}, distance + scale_, best);
        }
    }
    if (!take(best)) return {};
    labels_.push_back({best.box, seen, true, line});
    return best.box;
}

inline void Labels::draw(Picture<Rgb888>& picture) const {
    for (const Label& label : labels_) {
        const Rectangle& box = label.box;
        const Point end{clamp(label.anchor.x, box.x, box.right()),
                        clamp(label.anchor.y, box.y, box.bottom())};
        const int distance =
            maximum(end.x > label.anchor.x ? end.x - label.anchor.x : label.anchor.x - end.x,
                    end.y > label.anchor.y ? end.y - label.anchor.y : label.anchor.y - end.y);
        if (label.tied && distance > 8 * scale_)
            static_cast<void>(draw_line(picture.view(), label.anchor, end, label.line.colour, scale_));
    }
    for (const Label& label : labels_)
        static_cast<void>(draw_label(picture.view(), {label.box.x, label.box.y}, span_of(label.line.text),
                                     label.line.colour, paper_, scale_));
}

}  // namespace fovea::apps
