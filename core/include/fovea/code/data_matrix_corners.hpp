// SPDX-License-Identifier: MIT
//
// Corners that may be those of a Data Matrix: two straight edges that meet, the dark inside.
#pragma once

#include <cstdint>

#include <fovea/base/list.hpp>
#include <fovea/base/order.hpp>
#include <fovea/code/code_field.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/number/integer.hpp>

namespace fovea::detail {

/// A straight piece of a border, between centres of dark pixels, the dark on its right.
struct BorderPiece {
    Point first;
    Point last;
    int length = 0;

    constexpr std::int64_t x() const { return last.x - first.x; }
    constexpr std::int64_t y() const { return last.y - first.y; }
};

/// Two pieces of a border that turn around the dark: into the corner, and out of it.
struct BorderCorner {
    BorderPiece in;
    BorderPiece out;
    int threshold = 0;  ///< what is below it is dark
    std::int64_t weight = 0;
};

/// Splits a walk of points into straight pieces and pairs those that meet.
class CornerFinder {
public:
    /// Pieces shorter than that do not count.
    static constexpr int shortest = 6;

    CornerFinder(ListView<BorderCorner> corners, Size size, int threshold)
        : corners_(corners), size_(size), threshold_(threshold) {}

    void begin(Point p) { restart(p); }
    void add(Point p);
    void end(bool closed);

private:
    /// In quarters of a pixel.
    struct Vector {
        std::int32_t x;
        std::int32_t y;
    };
    /// Within 7 % of it.
    static int about_length(int x, int y) {
        const int a = x < 0 ? -x : x;
        const int b = y < 0 ? -y : y;
        return maximum(a, b) + 3 * minimum(a, b) / 8;
    }
    static std::int64_t cross(Vector a, Vector b) {
        return std::int64_t{a.x} * b.y - std::int64_t{a.y} * b.x;
    }

    void restart(Point p) {
        start_ = p;
        far_ = p;
        reach_ = 0;
        open_ = true;
    }
    void finish_piece();
    void pair(const BorderPiece& in, const BorderPiece& out);

    static constexpr int kept = 4;

    bool at_side(const BorderPiece& piece) const {
        const auto both = [](int a, int b, int last) {
            return (a <= 1 && b <= 1) || (a >= last - 1 && b >= last - 1);
        };
        return both(piece.first.x, piece.last.x, size_.width - 1) ||
               both(piece.first.y, piece.last.y, size_.height - 1);
    }

    ListView<BorderCorner> corners_;
    Size size_;
    int threshold_;
    Point start_;
    Point far_;
    std::int32_t reach_ = 0;
    bool open_ = true;  ///< no direction yet
    Vector low_{};
    Vector high_{};
    BorderPiece ring_[kept];
    BorderPiece begun_[kept];
    int count_ = 0;
};

/// Follows the border of the dark around a pixel that has light on the side of `from` (0 right, 4 left).
/// Answers the steps that were walked.
inline int follow_corners(const CodeField& field, Point start, int from, int threshold, int most_steps,
                          const PassedSides& passed, ListView<BorderCorner> corners);

/// Follows the borders that a row crosses between two of its pixels, until they have so many steps.
/// Answers the pixels of the row and the steps that were walked.
inline std::int64_t scan_row_for_corners(const CodeField& field, int y, int first, int last, int contrast,
                                         std::int64_t most, const PassedSides& passed,
                                         ListView<BorderCorner> corners);

inline void CornerFinder::add(Point p) {
    const Vector v{4 * (p.x - start_.x), 4 * (p.y - start_.y)};
    const std::int32_t ax = v.x < 0 ? -v.x : v.x;
    const std::int32_t ay = v.y < 0 ? -v.y : v.y;
    const std::int32_t distance = ax > ay ? ax : ay;
    if (distance < 8) {
        if (reach_ >= 16) finish_piece();
        return;
    }
    const std::int64_t from_low = open_ ? 0 : cross(low_, v);
    const std::int64_t to_high = open_ ? 0 : cross(v, high_);
    if (distance + 12 < reach_ || from_low < 0 || to_high < 0) {
        const Point corner = far_;
        finish_piece();
        restart(corner);
        // What follows the corner begins a new piece; the points between lie within a pixel or two of it.
        return;
    }
    // A pixel and a quarter aside, more on a long way: lenses bend lines. At a distance of 8 that is 32
    // degrees, so that no direction between low and high points back.
    const std::int32_t aside = 5 + (distance < 4 * 128 ? distance / 128 : 4);
    const bool flat = ax >= ay;
    const std::int32_t turned = (flat ? v.x : v.y) > 0 ? aside : -aside;
    // cross() of what was left and of v turned by that, on both sides.
    if (open_ || from_low > std::int64_t{flat ? low_.x : low_.y} * turned)
        low_ = flat ? Vector{v.x, v.y - turned} : Vector{v.x + turned, v.y};
    if (open_ || to_high > std::int64_t{flat ? high_.x : high_.y} * turned)
        high_ = flat ? Vector{v.x, v.y + turned} : Vector{v.x - turned, v.y};
    open_ = false;
    if (distance >= reach_) {
        reach_ = distance;
        far_ = p;
    }
}

inline void CornerFinder::finish_piece() {
    BorderPiece piece;
    piece.first = start_;
    piece.last = far_;
    const Point corner = far_;
    restart(corner);
    piece.length = about_length(piece.last.x - piece.first.x, piece.last.y - piece.first.y);
    if (piece.length < shortest) return;
    for (int i = 0; i < minimum(count_, kept); ++i) pair(ring_[i], piece);
    if (count_ < kept) begun_[count_] = piece;
    ring_[count_ % kept] = piece;
    ++count_;
}

inline void CornerFinder::end(bool closed) {
    finish_piece();
    if (!closed) return;
    for (int i = 0; i < minimum(count_, kept); ++i)
        for (int k = 0; k < minimum(count_, 2); ++k) pair(ring_[i], begun_[k]);
}

inline void CornerFinder::pair(const BorderPiece& in, const BorderPiece& out) {
    const std::int64_t turn = in.x() * out.y() - in.y() * out.x();
    // The sine of the corner's angle is at least a half.
    if (2 * turn < std::int64_t{in.length} * out.length) return;
    const int gap = about_length(out.first.x - in.last.x, out.first.y - in.last.y);
    if (gap > 4 + minimum(in.length, out.length) / 4) return;
    BorderCorner corner;
    corner.in = in;
    corner.out = out;
    corner.threshold = threshold_;
    const std::int64_t shorter = minimum(in.length, out.length);
    corner.weight = shorter * minimum<std::int64_t>(maximum(in.length, out.length), 4 * shorter);
    // Seldom a symbol: its corner cut off by the image.
    if (at_side(in) || at_side(out)) corner.weight /= 8;
    // The same one at nearly the same threshold.
    const auto near = [](Point a, Point b) {
        return a.x - b.x <= 3 && b.x - a.x <= 3 && a.y - b.y <= 3 && b.y - a.y <= 3;
    };
    for (BorderCorner& other : corners_) {
        if (!near(other.in.last, in.last) || !near(other.out.first, out.first) ||
            magnitude(std::int64_t{other.threshold} - threshold_) > 12)
            continue;
        if (corner.weight > other.weight) other = corner;
        return;
    }
    if (corners_.push(corner) == Status::ok) return;
    int weakest = 0;
    for (int i = 1; i < corners_.size(); ++i)
        if (corners_[i].weight < corners_[weakest].weight) weakest = i;
    if (corners_[weakest].weight < corner.weight) corners_[weakest] = corner;
}

inline int follow_corners(const CodeField& field, Point start, int from, int threshold, int most_steps,
                          const PassedSides& passed, ListView<BorderCorner> corners) {
    constexpr int step_x[8] = {1, 1, 0, -1, -1, -1, 0, 1};
    constexpr int step_y[8] = {0, 1, 1, 1, 0, -1, -1, -1};
    const int width = field.size().width;
    const int height = field.size().height;
    const Gray8 flip = field.flip();
    const std::ptrdiff_t stride = field.stride();
    const std::ptrdiff_t offset[8] = {1,  stride + 1,  stride,  stride - 1,
                                      -1, -stride - 1, -stride, 1 - stride};
    // The light neighbour from which the next turn begins.
    constexpr std::uint8_t next_light[8] = {6, 6, 0, 0, 2, 2, 4, 4};
    CornerFinder finder(corners, field.size(), threshold);
    finder.begin(start);
    Point at = start;
    const Gray8* here = field.row(at.y) + at.x;
    int light = from;
    for (int step = 0; step < most_steps; ++step) {
        // Clockwise from a light neighbour to the next dark one. As unsigned numbers those below 0 are too
        // large.
        const bool inside = static_cast<unsigned>(at.x - 1) < static_cast<unsigned>(width - 2) &&
                            static_cast<unsigned>(at.y - 1) < static_cast<unsigned>(height - 2);
        int way = light;
        int turned = 0;
        while (true) {
            if ((way & 3) == 0) {
                if (way == 0)
                    passed.pass_right(at.x, at.y);
                else
                    passed.pass_left(at.x, at.y);
            }
            way = (way + 1) & 7;
            ++turned;
            if (inside || (static_cast<unsigned>(at.x + step_x[way]) < static_cast<unsigned>(width) &&
                           static_cast<unsigned>(at.y + step_y[way]) < static_cast<unsigned>(height))) {
                if ((here[offset[way]] ^ flip) < threshold) break;
            }
            if (turned == 8) return step;
        }
        at = {at.x + step_x[way], at.y + step_y[way]};
        here += offset[way];
        light = next_light[way];
        finder.add(at);
        // Closed, also when it comes to the start from another side.
        if (at == start && ((from - light) & 7) < 3) {
            finder.end(true);
            return step;
        }
    }
    finder.end(false);
    return most_steps;
}

inline std::int64_t scan_row_for_corners(const CodeField& field, int y, int first, int last, int contrast,
                                         std::int64_t most, const PassedSides& passed,
                                         ListView<BorderCorner> corners) {
    const Gray8* row = field.row(y);
    const Gray8 flip = field.flip();
    const int most_steps = 8 * (field.size().width + field.size().height) + 256;
    std::int64_t steps = last - first + 1;
    // Extremes in turn; between two of them that differ enough lies an edge.
    int low = row[first] ^ flip;
    int high = low;
    int low_at = first;
    int high_at = first;
    int way = 0;
    const auto edge = [&](int from, int to, bool falling) {
        if (steps >= most) return;
        // The steepest step and those beside it that are at least a sixth of it: not the slope of the light.
        const auto level = [&](int x) { return falling ? 255 - (row[x] ^ flip) : row[x] ^ flip; };
        int steepest = 0;
        int at = from;
        for (int x = from; x < to; ++x) {
            const int step = level(x + 1) - level(x);
            if (step <= steepest) continue;
            steepest = step;
            at = x;
        }
        int begin = at;
        int end = at + 1;
        while (begin > from && 6 * (level(begin) - level(begin - 1)) >= steepest) --begin;
        while (end < to && 6 * (level(end + 1) - level(end)) >= steepest) ++end;
        if (level(end) - level(begin) < contrast) {
            // Noise cuts an edge short; a long slope is none.
            if (to - from > 16) return;
            begin = from;
            end = to;
        }
        const int middle = (level(begin) + level(end) + 1) / 2;
        const int threshold = falling ? 256 - middle : middle;
        int x = begin + 1;
        while (x < end && ((row[x] ^ flip) < threshold) != falling) ++x;
        const int dark_at = falling ? x : x - 1;
        if (falling ? passed.left(dark_at, y) : passed.right(dark_at, y)) return;
        steps += follow_corners(field, {dark_at, y}, falling ? 4 : 0, threshold, most_steps, passed, corners);
    };
    for (int x = first + 1; x <= last; ++x) {
        const int value = row[x] ^ flip;
        if (way >= 0) {
            if (value > high) {
                high = value;
                high_at = x;
            } else if (value < high - contrast) {
                if (way > 0) edge(low_at, high_at, false);
                way = -1;
                low = value;
                low_at = x;
                continue;
            }
        }
        if (way <= 0) {
            if (value < low) {
                low = value;
                low_at = x;
            } else if (value > low + contrast) {
                if (way < 0) edge(high_at, low_at, true);
                way = 1;
                high = value;
                high_at = x;
            }
        }
    }
    if (way > 0) edge(low_at, high_at, false);
    if (way < 0) edge(high_at, low_at, true);
    return steps;
}

}  // namespace fovea::detail
