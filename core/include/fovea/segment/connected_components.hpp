// SPDX-License-Identifier: MIT
//
// Connected components of a binary image with their holes and moments, found row by row from runs. Book sec.
// 2.8.3.
#pragma once

#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/base/list.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/segment/component_lists.hpp>
#include <fovea/segment/region.hpp>
#include <fovea/segment/runs.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/statistics/moments.hpp>

namespace fovea {
inline namespace FOVEA_ISA {

// ---- Interface --------------------------------------------------------------------

/// Scratch bytes for images of this width, for regions with Moments or other sums. With fewer labels than the
/// default, for chips, a restless image may run out of them: then the answer is scratch_too_small.
template <class Accumulated = Moments>
constexpr std::int64_t connected_components_scratch(int width, int labels);
template <class Accumulated = Moments>
constexpr std::int64_t connected_components_scratch(int width) {
    return connected_components_scratch<Accumulated>(width, 2 * width + 2);
}

/// Finds the components of an image whose rows come one after another.
///
/// Every open region and hole has a label, which the next one may use when it is closed: the memory depends
/// on the width of the image alone.
///
/// Shapes   rows of width pixels, any number up to max_moment_side; zero is ground, all else belongs
/// Order    regions and holes by their first pixel, row by row
/// Scratch  connected_components_scratch() bytes, in use until finish()
/// Errors   of add_row() and finish(): image_too_large above max_moment_side; bad_argument for area limits
///          that are negative or crossed; scratch_too_small when labels run out, with both lists empty;
///          capacity_exceeded when a list is full: it holds the largest, the earlier ones of equals
/// Source   book sec. 2.8.3; runs and union-find after Rosenfeld and Pfaltz, "Sequential Operations in
///          Digital Picture Processing", JACM 13(4), 1966
template <class Accumulated>
class ConnectedComponentsOf {
public:
    using Region = RegionOf<Accumulated>;
    using Hole = HoleOf<Accumulated>;

    ConnectedComponentsOf(int width, const ComponentOptions& options, Span<std::uint8_t> scratch,
                          ListView<Region> regions, ListView<Hole> holes);

    Status add_row(const std::uint8_t* row);
    /// Closes what is open and orders the lists. Nothing may be added afterwards.
    Status finish();
    /// What the parameters were refused with, and what stopped the work.
    Status status() const { return status_; }

private:
    template <class>
    friend constexpr std::int64_t connected_components_scratch(int width, int labels);

    using LabelIndex = RunLabel;
    static constexpr LabelIndex none = no_label;
    static constexpr std::int16_t freed = -2;

    struct Label {
        Accumulated moments;
        Point first;
        std::int16_t left = 0, right = 0;
        std::int16_t bottom = -1;  ///< the last row it has a run in
        LabelIndex link = none;    ///< itself, or the label it was merged into, or the next free one
        LabelIndex outer = none;   ///< of ground: the region on its left
        std::uint16_t hole_count = 0;
        std::int32_t hole_area = 0;  ///< at most all pixels of the largest image
        detail::HoleChain holes;
        bool is_region = false;
        bool at_border = false;
    };
    bool label_runs(bool regions);
    void add_runs(bool regions);
    LabelIndex new_label(bool is_region, Point first);
    LabelIndex find(LabelIndex label);
    LabelIndex merge(LabelIndex a, LabelIndex b);
    void close_labels();
    void close_labels_of(bool regions);
    void close_region(const Label& label);
    void close_hole(const Label& hole);
    void free_label(LabelIndex label);
    Status fail(Status status);

    int width_;
    int y_ = 0;
    ComponentOptions options_;
    RunRow above_;
    RunRow here_;
    Span<Label> labels_;
    LabelIndex free_ = none;
    int used_labels_ = 0;  ///< the others have never been
    detail::ComponentLists<Accumulated> lists_;
    Status status_ = Status::ok;  ///< what stopped the work
    bool merged_ = false;         ///< labels of this row
    int open_labels_ = 0;         ///< in use and not merged into others
    int seen_labels_ = 0;         ///< of those, with a run in this row, as long as none were merged
};

using ConnectedComponents = ConnectedComponentsOf<Moments>;

/// The same for a whole image. Other sums than Moments are asked for by name:
/// connected_components<FirstMoments>(...).
///
/// Shapes  binary 1x1 up to max_moment_side squared
/// Errors  also empty_image; after an error other than capacity_exceeded the lists are as before or empty
template <class Accumulated>
Status connected_components(ImageView<const std::uint8_t> binary, const ComponentOptions& options,
                            Span<std::uint8_t> scratch, NonDeduced<ListView<RegionOf<Accumulated>>> regions,
                            NonDeduced<ListView<HoleOf<Accumulated>>> holes);
inline Status connected_components(ImageView<const std::uint8_t> binary, const ComponentOptions& options,
                                   Span<std::uint8_t> scratch, ListView<Region> regions,
                                   ListView<Hole> holes) {
    return connected_components<Moments>(binary, options, scratch, regions, holes);
}

// ---- Implementation ---------------------------------------------------------------

template <class Accumulated>
constexpr std::int64_t connected_components_scratch(int width, int labels) {
    return 2 * run_row_bytes(width) + arena_bytes<typename ConnectedComponentsOf<Accumulated>::Label>(labels);
}

template <class Accumulated>
ConnectedComponentsOf<Accumulated>::ConnectedComponentsOf(int width, const ComponentOptions& options,
                                                          Span<std::uint8_t> scratch,
                                                          ListView<Region> regions, ListView<Hole> holes)
    : width_(width), options_(options), lists_(regions, holes) {
    if (width <= 0) {
        status_ = Status::empty_image;
    } else if (width > max_moment_side) {
        status_ = Status::image_too_large;
    } else if (options.area_min < 0 || options.area_min > options.area_max || options.hole_area_min < 0) {
        status_ = Status::bad_argument;
    } else if (scratch.size() < connected_components_scratch<Accumulated>(width, 1)) {
        status_ = Status::scratch_too_small;
    } else {
        Arena arena(scratch);
        above_ = RunRow(arena, width);
        here_ = RunRow(arena, width);
        const auto room = (arena.rest().size() - static_cast<std::ptrdiff_t>(alignof(Label)) + 1) /
                          static_cast<std::ptrdiff_t>(sizeof(Label));
        labels_ = arena.take_unset<Label>(minimum<std::ptrdiff_t>(room, 2 * width + 2));
        lists_.clear();
    }
}

template <class Accumulated>
Status ConnectedComponentsOf<Accumulated>::fail(Status status) {
    status_ = status;
    lists_.clear();
    return status;
}

template <class Accumulated>
Status ConnectedComponentsOf<Accumulated>::add_row(const std::uint8_t* row) {
    if (status_ != Status::ok) return status_;
    if (y_ >= max_moment_side) return fail(Status::image_too_large);
    if (here_.split(row, width_) != Status::ok) return fail(Status::scratch_too_small);
    seen_labels_ = 0;
    merged_ = false;
    if (!label_runs(true)) return fail(Status::scratch_too_small);
    if (options_.find_holes && !label_runs(false)) return fail(Status::scratch_too_small);
    add_runs(true);
    if (options_.find_holes) add_runs(false);
    if (merged_ || seen_labels_ < open_labels_) close_labels();
    swap_values(above_, here_);
    ++y_;
    return Status::ok;
}

/// Gives the runs of regions, or those of the ground, their labels. False if there is no label left.
template <class Accumulated>
bool ConnectedComponentsOf<Accumulated>::label_runs(bool regions) {
    struct Labels {
        ConnectedComponentsOf& of;
        bool regions;
        LabelIndex find(LabelIndex label) { return of.find(label); }
        LabelIndex merge(LabelIndex a, LabelIndex b) { return of.merge(a, b); }
        LabelIndex add(int x) { return of.new_label(regions, {x, of.y_}); }
    };
    const int reach = regions == (options_.connectivity == Connectivity::eight) ? 1 : 0;
    return fovea::label_runs(above_, here_, regions, reach, Labels{*this, regions});
}

/// Adds the runs of regions, or those of the ground, to their labels, which become final. The leftmost run of
/// a piece of ground has the region around it, if it is a hole, on its left.
template <class Accumulated>
void ConnectedComponentsOf<Accumulated>::add_runs(bool regions) {
    const RunRow here = here_;
    for (int i = here.first_of(regions); i < here.count(); i += 2) {
        if (merged_) here[i].label = find(here[i].label);
        const int first = here[i].first;
        const int end = here.end(i);
        Label& label = labels_[here[i].label];
        label.left = minimum(label.left, static_cast<std::int16_t>(first));
        label.right = maximum(label.right, static_cast<std::int16_t>(end - 1));
        label.at_border = label.at_border || y_ == 0 || first == 0 || end == width_;
        // Ground at the border is never a hole, so nobody asks for its moments.
        if (regions || !label.at_border) label.moments.add_run(first, end, y_);
        if (label.bottom == y_) continue;
        label.bottom = static_cast<std::int16_t>(y_);
        ++seen_labels_;
        if (!regions && i > 0) label.outer = here[i - 1].label;
    }
}

template <class Accumulated>
auto ConnectedComponentsOf<Accumulated>::new_label(bool is_region, Point first) -> LabelIndex {
    LabelIndex label = free_;
    if (label != none)
        free_ = labels_[label].link;
    else if (used_labels_ < labels_.size())
        label = static_cast<LabelIndex>(used_labels_++);
    else
        return none;
    Label fresh;
    fresh.link = label;
    fresh.is_region = is_region;
    fresh.first = first;
    fresh.left = fresh.right = static_cast<std::int16_t>(first.x);
    labels_[label] = fresh;
    ++open_labels_;
    return label;
}

template <class Accumulated>
auto ConnectedComponentsOf<Accumulated>::find(LabelIndex label) -> LabelIndex {
    while (labels_[label].link != label) {
        labels_[label].link = labels_[labels_[label].link].link;
        label = labels_[label].link;
    }
    return label;
}

/// Merges b into a or a into b: the one that began first stays.
template <class Accumulated>
auto ConnectedComponentsOf<Accumulated>::merge(LabelIndex a, LabelIndex b) -> LabelIndex {
    if (a == b) return a;
    const Point p = labels_[a].first;
    const Point q = labels_[b].first;
    if (q.y < p.y || (q.y == p.y && q.x < p.x)) swap_values(a, b);
    Label& kept = labels_[a];
    Label& gone = labels_[b];
    gone.link = a;
    merged_ = true;
    --open_labels_;
    kept.moments.add(gone.moments);
    kept.left = minimum(kept.left, gone.left);
    kept.right = maximum(kept.right, gone.right);
    kept.bottom = maximum(kept.bottom, gone.bottom);
    kept.at_border = kept.at_border || gone.at_border;
    kept.hole_area += gone.hole_area;
    kept.hole_count = static_cast<std::uint16_t>(kept.hole_count + gone.hole_count);
    lists_.join(kept.holes, gone.holes);
    return a;
}

/// Lists what has no run in this row and frees its labels, and those that were merged into others. Holes go
/// first: they look for their regions.
template <class Accumulated>
void ConnectedComponentsOf<Accumulated>::close_labels() {
    if (options_.find_holes) close_labels_of(false);
    close_labels_of(true);
}

template <class Accumulated>
void ConnectedComponentsOf<Accumulated>::close_labels_of(bool regions) {
    for (int i = above_.first_of(regions); i < above_.count(); i += 2) {
        const LabelIndex index = above_[i].label;
        Label& label = labels_[index];
        if (((label.bottom ^ y_) | (label.link ^ index)) == 0) continue;  // One question: it is often random.
        if (label.bottom == freed) continue;                              // By another run of the same label.
        if (label.link == index) {
            if (regions)
                close_region(label);
            else if (!label.at_border && label.moments.area() >= options_.hole_area_min)
                close_hole(label);
            --open_labels_;
        }
        free_label(index);
    }
}

template <class Accumulated>
void ConnectedComponentsOf<Accumulated>::free_label(LabelIndex label) {
    labels_[label].bottom = freed;
    labels_[label].link = free_;
    free_ = label;
}

template <class Accumulated>
void ConnectedComponentsOf<Accumulated>::close_hole(const Label& hole) {
    const Rectangle box{hole.left, hole.first.y, hole.right - hole.left + 1, hole.bottom - hole.first.y + 1};
    Label& region = labels_[find(hole.outer)];
    ++region.hole_count;
    region.hole_area += static_cast<std::int32_t>(hole.moments.area());
    lists_.add_hole({hole.moments, box, hole.first, 0}, region.holes, labels_.first(used_labels_));
}

template <class Accumulated>
void ConnectedComponentsOf<Accumulated>::close_region(const Label& label) {
    const std::int64_t area = label.moments.area();
    if (area < options_.area_min || area > options_.area_max ||
        (label.at_border && options_.at_border == BorderRegions::drop)) {
        lists_.drop_holes(label.holes);
        return;
    }
    Region region;
    region.moments = label.moments;
    region.box = {label.left, label.first.y, label.right - label.left + 1, label.bottom - label.first.y + 1};
    region.first = label.first;
    region.at_border = label.at_border;
    region.holes = label.hole_count;
    region.hole_area = label.hole_area;
    lists_.add_region(region, label.holes);
}

template <class Accumulated>
Status ConnectedComponentsOf<Accumulated>::finish() {
    if (status_ != Status::ok) return status_;
    if (y_ == 0) return fail(Status::empty_image);
    for (int i = 0; i < above_.count(); ++i)
        if (above_[i].label != none) labels_[above_[i].label].at_border = true;
    close_labels();
    lists_.order();
    status_ = lists_.overflow() ? Status::capacity_exceeded : Status::ok;
    return status_;
}

template <class Accumulated>
Status connected_components(ImageView<const std::uint8_t> binary, const ComponentOptions& options,
                            Span<std::uint8_t> scratch, NonDeduced<ListView<RegionOf<Accumulated>>> regions,
                            NonDeduced<ListView<HoleOf<Accumulated>>> holes) {
    if (binary.empty()) return Status::empty_image;
    if (binary.height() > max_moment_side) return Status::image_too_large;
    ConnectedComponentsOf<Accumulated> components(binary.width(), options, scratch, regions, holes);
    for (int y = 0; y < binary.height(); ++y)
        if (Status s = components.add_row(binary.row(y)); s != Status::ok) return s;
    return components.finish();
}

}  // namespace FOVEA_ISA
}  // namespace fovea
