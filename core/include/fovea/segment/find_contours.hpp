// SPDX-License-Identifier: MIT
//
// All contours of a binary image in one scan, without regions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/base/arena.hpp>
#include <fovea/base/list.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/segment/contour.hpp>
#include <fovea/segment/region.hpp>
#include <fovea/segment/runs.hpp>
#include <fovea/simd/isa.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Scratch bytes that find_contours() needs: one a pixel, and a row of runs.
constexpr std::int64_t find_contours_scratch(Size size) {
    return size.area() + arena_bytes<Run>(std::int64_t{size.width} + 1);
}

inline namespace FOVEA_ISA {

/// The contours of all regions and holes. It does not say which hole lies in which region: where that is
/// asked for, or areas are, take connected_components() and trace_contours().
///
/// Shapes   binary 1x1 or larger; zero is ground, all else belongs
/// Order    by the first pixel of the region, or the pixel to the left of the hole's first one, row by row;
///          region and parent are -1
/// Scratch  find_contours_scratch(binary.size()) bytes, undefined afterwards
/// Cost     a look at every run, and the length of the contours; the same for spirals and combs
/// Errors   empty_image; image_too_large above max_image_side; scratch_too_small; capacity_exceeded when
///          either list is full: all contours in the list are whole
/// Source   Suzuki and Abe, "Topological Structural Analysis of Digitized Binary Images by Border Following",
///          1985, with a mark for the left and one for the right side of a pixel in place of numbers
inline Status find_contours(ImageView<const std::uint8_t> binary, Connectivity connectivity,
                            ContourPoints wanted, Span<std::uint8_t> scratch, ListView<Point> points,
                            ListView<Contour> contours);

}  // namespace FOVEA_ISA

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Marks which sides of pixels the borders that were walked have on them.
class SideMarks {
public:
    static constexpr std::uint8_t left = 1;
    static constexpr std::uint8_t right = 2;

    SideMarks(std::uint8_t* marks, Size size) : marks_(marks), size_(size) {
        std::memset(marks, 0, static_cast<std::size_t>(size.area()));
    }
    bool has(int x, int y, std::uint8_t side) const { return (at(x, y) & side) != 0; }
    template <class Walk>
    void note(const Walk& walk) {
        const int sides = (walk.passed(4) ? left : 0) | (walk.passed(0) ? right : 0);
        if (sides != 0) at(walk.at().x, walk.at().y) |= static_cast<std::uint8_t>(sides);
    }

private:
    std::uint8_t& at(int x, int y) const { return marks_[std::ptrdiff_t{y} * size_.width + x]; }

    std::uint8_t* marks_;
    Size size_;
};

}  // namespace detail

inline namespace FOVEA_ISA {

inline Status find_contours(ImageView<const std::uint8_t> binary, Connectivity connectivity,
                            ContourPoints wanted, Span<std::uint8_t> scratch, ListView<Point> points,
                            ListView<Contour> contours) {
    if (binary.empty()) return Status::empty_image;
    if (binary.width() > max_image_side || binary.height() > max_image_side) return Status::image_too_large;
    if (scratch.size() < find_contours_scratch(binary.size())) return Status::scratch_too_small;
    const auto pixels = static_cast<std::ptrdiff_t>(binary.size().area());
    detail::SideMarks marks(scratch.data(), binary.size());
    Arena arena(scratch.from(pixels));
    RunRow runs(arena.take_unset<Run>(binary.width() + 1));
    points.clear();
    contours.clear();
    detail::ContourWriter writer(points, wanted);
    const auto walk = [&](Point start, bool hole) {
        writer.begin();
        detail::follow_border(
            binary, connectivity, start, hole ? 0 : 4, [&](Point p) { writer(p); },
            [&](const auto& at) { marks.note(at); });
        writer.end();
        Contour contour;
        contour.first = writer.first();
        contour.count = points.size() - writer.first();
        contour.region = -1;
        contour.hole = hole;
        if (!writer.full() && contours.push(contour) == Status::ok) return true;
        writer.undo();
        return false;
    };
    for (int y = 0; y < binary.height(); ++y) {
        static_cast<void>(runs.split(binary.row(y), binary.width()));
        for (int i = runs.first_of(true); i < runs.count(); i += 2) {
            const int first = runs[i].first;
            const int last = runs.end(i) - 1;
            // A side that no walk has passed begins a border: a left one that of a region, as no pixel of it
            // came before; a right one that of a hole.
            if (!marks.has(first, y, detail::SideMarks::left) && !walk({first, y}, false))
                return Status::capacity_exceeded;
            if (!marks.has(last, y, detail::SideMarks::right) && !walk({last, y}, true))
                return Status::capacity_exceeded;
        }
    }
    return Status::ok;
}

}  // namespace FOVEA_ISA
}  // namespace fovea
