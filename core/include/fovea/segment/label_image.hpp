// SPDX-License-Identifier: MIT
//
// An image of labels: the number of its region in every pixel. Book sec. 2.8.3.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/base/arena.hpp>
#include <fovea/base/order.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/segment/region.hpp>
#include <fovea/segment/runs.hpp>
#include <fovea/simd/isa.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The most pieces of regions that label_image() tells apart.
inline constexpr int max_image_labels = 65534;

/// Scratch bytes for so many pieces of regions; without them, for any image of this size. A piece is what
/// looks like a region of its own when it is met from above: a U is two.
constexpr std::int64_t label_image_scratch(Size size, int pieces) {
    return 2 * run_row_bytes(size.width) + arena_bytes<Label16>(std::int64_t{pieces} + 1);
}
constexpr std::int64_t label_image_scratch(Size size) {
    return label_image_scratch(
        size, static_cast<int>(minimum<std::int64_t>((size.area() + 1) / 2, max_image_labels)));
}

inline namespace FOVEA_ISA {

/// Numbers the regions of a binary image from 1 on, by their first pixels row by row, as
/// connected_components() lists them; the ground is 0. Answers how many there are.
///
/// Shapes   src and dst equal, 1x1 up to max_image_side squared; zero is ground, all else belongs
/// Overlap  none
/// Scratch  label_image_scratch(src.size(), pieces) bytes, undefined afterwards
/// Errors   empty_image, size_mismatch, image_too_large; scratch_too_small; capacity_exceeded if there are
///          more pieces than max_image_labels or the scratch has room for, with dst undefined
/// Source   book sec. 2.8.3; runs and union-find after Rosenfeld and Pfaltz, JACM 13(4), 1966
inline Result<int> label_image(ImageView<const std::uint8_t> src, Connectivity connectivity,
                               Span<std::uint8_t> scratch, ImageView<Label16> dst);

}  // namespace FOVEA_ISA

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Pieces that were found to be one: each points to one with a smaller number, or to itself.
class LabelTable {
public:
    explicit LabelTable(Span<Label16> parents) : parents_(parents) {}

    /// A new piece, wherever it begins, or no_label if there is no room.
    Label16 add(int) {
        if (count_ + 1 >= parents_.size()) return no_label;
        ++count_;
        return parents_[count_] = static_cast<Label16>(count_);
    }
    Label16 find(Label16 label) {
        while (parents_[label] != label) label = parents_[label] = parents_[parents_[label]];
        return label;
    }
    /// Of two that find() answered.
    Label16 merge(Label16 a, Label16 b) { return parents_[maximum(a, b)] = minimum(a, b); }
    /// Gives every piece the number of its region, and answers how many there are.
    int number() {
        int regions = 0;
        for (std::ptrdiff_t i = 1; i <= count_; ++i)
            parents_[i] = parents_[i] == i ? static_cast<Label16>(++regions) : parents_[parents_[i]];
        return regions;
    }
    Label16 operator[](Label16 label) const { return parents_[label]; }

private:
    Span<Label16> parents_;
    std::ptrdiff_t count_ = 0;
};

/// Writes first to end - 1, and perhaps some pixels behind them, which are written later.
inline void write_label(int first, int end, int width, Label16 label, Label16* out) {
    constexpr int step = 8;
    Label16 block[step];
    for (Label16& one : block) one = label;
    int x = first;
    for (; x < end && x + step <= width; x += step) std::memcpy(out + x, block, sizeof block);
    for (; x < end; ++x) out[x] = label;
}

}  // namespace detail

inline namespace FOVEA_ISA {

inline Result<int> label_image(ImageView<const std::uint8_t> src, Connectivity connectivity,
                               Span<std::uint8_t> scratch, ImageView<Label16> dst) {
    if (src.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    if (src.width() > max_image_side || src.height() > max_image_side) return Status::image_too_large;
    if (scratch.size() < label_image_scratch(src.size(), 1)) return Status::scratch_too_small;
    const int width = src.width();
    Arena arena(scratch);
    RunRow above(arena, width);
    RunRow here(arena, width);
    const auto room = (arena.rest().size() - static_cast<std::ptrdiff_t>(alignof(Label16)) + 1) /
                      static_cast<std::ptrdiff_t>(sizeof(Label16));
    detail::LabelTable table(arena.take_unset<Label16>(minimum<std::ptrdiff_t>(room, max_image_labels + 1)));

    const int reach = connectivity == Connectivity::eight ? 1 : 0;
    for (int y = 0; y < src.height(); ++y) {
        static_cast<void>(here.split(src.row(y), width));
        if (!label_runs(above, here, true, reach, table)) return Status::capacity_exceeded;
        // The first pixel of a run remembers its piece until all are known.
        Label16* out = dst.row(y);
        for (int i = here.first_of(true); i < here.count(); i += 2) out[here[i].first] = here[i].label;
        swap_values(above, here);
    }
    const int regions = table.number();
    for (int y = 0; y < src.height(); ++y) {
        static_cast<void>(here.split(src.row(y), width));
        Label16* out = dst.row(y);
        for (int i = 0; i < here.count(); ++i)
            here[i].label = here.is_region(i) ? table[out[here[i].first]] : Label16{0};
        for (int i = 0; i < here.count(); ++i)
            detail::write_label(here[i].first, here.end(i), width, here[i].label, out);
    }
    return regions;
}

}  // namespace FOVEA_ISA
}  // namespace fovea
