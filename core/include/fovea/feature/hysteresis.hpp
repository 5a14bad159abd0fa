// SPDX-License-Identifier: MIT
//
// The second half of Canny's edges: from the strong ones on along the weak ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/base/span.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// What a pixel is while edges grow; 0 is neither.
inline constexpr Gray8 candidate_mark = 1;
inline constexpr Gray8 edge_mark = 2;
inline constexpr Gray8 either_mark = candidate_mark | edge_mark;

struct PixelPlace {
    std::uint16_t x = 0;
    std::uint16_t y = 0;
};

/// Places on the stack of EdgeGrowth. Edges are thin, so that few branches wait at a time.
constexpr int hysteresis_places(Size size) { return size.width + size.height; }

/// Makes edges of the candidates that are joined to edges, row after row as they come. A stack that is full
/// costs passes over the whole image in the end, and never an edge.
class EdgeGrowth {
public:
    /// The stack holds one place at least.
    EdgeGrowth(ImageView<Gray8> marks, Span<PixelPlace> stack) : marks_(marks), stack_(stack) {}

    /// Row y has its marks, as those above have.
    void take_row(int y) {
        last_ = y;
        const int width = marks_.width();
        take(0, y);
        int x = 1;
        while (x + 9 <= width) {
            if (x + 32 <= width && empty(x, y)) {
                x += 32;
                continue;
            }
            if (load_eight(x, y) != 0 && joined(x, y) != 0)
                for (int i = 0; i < 8; ++i) take(x + i, y);
            x += 8;
        }
        for (; x < width; ++x) take(x, y);
    }
    /// All rows were taken.
    void finish() {
        while (!complete_) {
            complete_ = true;
            for (int y = 0; y < marks_.height(); ++y)
                for (int x = 0; x < marks_.width(); ++x) take(x, y);
        }
    }

private:
    void take(int x, int y) {
        const Gray8 mark = marks_.row(y)[x];
        if (mark == 0 || !touches(x, y, static_cast<Gray8>(either_mark ^ mark))) return;
        marks_.row(y)[x] = edge_mark;
        grow({static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)});
    }
    std::uint64_t load_eight(int x, int y) const {
        std::uint64_t eight = 0;
        std::memcpy(&eight, marks_.row(y) + x, sizeof eight);
        return eight;
    }
    /// No marks in 32 pixels.
    bool empty(int x, int y) const {
        std::uint64_t pixels[4];
        std::memcpy(pixels, marks_.row(y) + x, sizeof pixels);
        return (pixels[0] | pixels[1] | pixels[2] | pixels[3]) == 0;
    }
    /// Where in eight pixels of the last row a candidate and an edge are neighbours, 1 in the pixel's byte.
    std::uint64_t joined(int x, int y) const {
        const std::uint64_t here = load_eight(x, y);
        std::uint64_t around = load_eight(x - 1, y) | load_eight(x + 1, y);
        if (y > 0) around |= load_eight(x - 1, y - 1) | load_eight(x, y - 1) | load_eight(x + 1, y - 1);
        static_assert(candidate_mark << 1 == edge_mark, "one shift compares the two");
        return ((here >> 1 & around) | (here & around >> 1)) & 0x0101010101010101u;
    }
    /// Whether one of the eight neighbours in the rows that were taken has the mark.
    bool touches(int x, int y, Gray8 mark) const {
        const int top = y > 0 ? y - 1 : 0;
        const int bottom = y < last_ ? y + 1 : last_;
        if (x > 0 && x + 2 < marks_.width()) {
            // Three pixels and one more of each row at a time.
            const std::uint8_t three[4] = {mark, mark, mark, 0};
            std::uint32_t wanted = 0;
            std::uint32_t joined = 0;
            std::memcpy(&wanted, three, sizeof wanted);
            for (int row = top; row <= bottom; ++row) {
                std::uint32_t four = 0;
                std::memcpy(&four, marks_.row(row) + x - 1, sizeof four);
                joined |= four;
            }
            return (joined & wanted) != 0;
        }
        for (int row = top; row <= bottom; ++row)
            for (int column = maximum(x - 1, 0); column <= minimum(x + 1, marks_.width() - 1); ++column)
                if (marks_.row(row)[column] == mark) return true;
        return false;
    }
    /// Edges that were not put on the stack are found again by finish().
    void grow(PixelPlace start) {
        std::ptrdiff_t count = 0;
        stack_[count++] = start;
        while (count > 0) {
            const PixelPlace at = stack_[--count];
            if (!touches(at.x, at.y, candidate_mark)) continue;
            for (int y = maximum(at.y - 1, 0); y <= minimum(at.y + 1, last_); ++y) {
                Gray8* row = marks_.row(y);
                for (int x = maximum(at.x - 1, 0); x <= minimum(at.x + 1, marks_.width() - 1); ++x) {
                    if (row[x] != candidate_mark) continue;
                    row[x] = edge_mark;
                    if (count < stack_.size())
                        stack_[count++] = {static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)};
                    else
                        complete_ = false;
                }
            }
        }
    }

    ImageView<Gray8> marks_;
    Span<PixelPlace> stack_;
    int last_ = 0;
    bool complete_ = true;
};

}  // namespace detail

}  // namespace fovea
