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
#include <fovea/statistics/moments.hpp>

namespace fovea {

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

    struct Label {
        Accumulated moments;
        Point first;
        std::int16_t left = 0, right = 0, bottom = 0;
        std::int16_t seen_row = -1;  ///< the last row it has a run in
        LabelIndex link = none;      ///< itself, or the label it was merged into, or the next free one
        LabelIndex outer = none;     ///< of ground: the region on its left
        std::uint16_t hole_count = 0;
        std::int64_t hole_area = 0;
        detail::HoleChain holes;
        bool used = false;
        bool is_region = false;
        bool at_border = false;
    };
    bool label_run(int index, int& above_from);
    LabelIndex new_label(bool is_region, Point first);
    LabelIndex find(LabelIndex label);
    LabelIndex merge(LabelIndex a, LabelIndex b);
    void add_to_label(int index, int end);
    void settle_row();
    void close_labels();
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
    return 2 * arena_bytes<Run>(std::int64_t{width} + 1) +
           arena_bytes<typename ConnectedComponentsOf<Accumulated>::Label>(labels);
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
        above_ = RunRow(arena.take<Run>(width + 1));
        here_ = RunRow(arena.take<Run>(width + 1));
        const auto room = (arena.rest().size() - static_cast<std::ptrdiff_t>(alignof(Label)) + 1) /
                          static_cast<std::ptrdiff_t>(sizeof(Label));
        labels_ = arena.take<Label>(minimum<std::ptrdiff_t>(room, 2 * width + 2));
        for (std::ptrdiff_t i = labels_.size() - 1; i >= 0; --i) free_label(static_cast<LabelIndex>(i));
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
    int above_from = 0;
    const int step = options_.find_holes ? 1 : 2;
    for (int i = options_.find_holes || here_.is_region(0) ? 0 : 1; i < here_.count(); i += step)
        if (!label_run(i, above_from)) return fail(Status::scratch_too_small);
    if (merged_) settle_row();
    if (merged_ || seen_labels_ < open_labels_) close_labels();
    swap_values(above_, here_);
    ++y_;
    return Status::ok;
}

/// Gives a run the label of the runs above that it touches, merging them, or a new one.
template <class Accumulated>
bool ConnectedComponentsOf<Accumulated>::label_run(int index, int& above_from) {
    Run& run = here_[index];
    const int first = run.first;
    const int end = here_.end(index);
    const bool region = here_.is_region(index);
    const int reach = region == (options_.connectivity == Connectivity::eight) ? 1 : 0;
    while (above_from < above_.count() && above_.end(above_from) + 1 <= first) ++above_from;
    // Regions and ground take turns.
    int k = above_from;
    if (k < above_.count() && (above_.is_region(k) != region || above_.end(k) + reach <= first))
        k += above_.is_region(k) != region ? 1 : 2;
    LabelIndex label = none;
    for (; k < above_.count() && above_[k].first < end + reach; k += 2) {
        const LabelIndex touched = find(above_[k].label);
        label = label == none ? touched : merge(label, touched);
    }
    if (label == none) label = new_label(region, {first, y_});
    if (label == none) return false;
    run.label = label;
    add_to_label(index, end);
    return true;
}

template <class Accumulated>
auto ConnectedComponentsOf<Accumulated>::new_label(bool is_region, Point first) -> LabelIndex {
    const LabelIndex label = free_;
    if (label == none) return none;
    free_ = labels_[label].link;
    Label fresh;
    fresh.link = label;
    fresh.used = true;
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

/// Adds a run to its label, and tells a piece of ground which region is on its left: at its leftmost run that
/// is the region around it, if it is a hole.
template <class Accumulated>
void ConnectedComponentsOf<Accumulated>::add_to_label(int index, int end) {
    const int first = here_[index].first;
    Label& label = labels_[here_[index].label];
    label.left = minimum(label.left, static_cast<std::int16_t>(first));
    label.right = maximum(label.right, static_cast<std::int16_t>(end - 1));
    label.bottom = static_cast<std::int16_t>(y_);
    label.at_border = label.at_border || y_ == 0 || first == 0 || end == width_;
    // Ground at the border is never a hole, so nobody asks for its moments.
    if (label.is_region || !label.at_border) label.moments.add_run(first, end, y_);
    if (label.seen_row == y_) return;
    label.seen_row = static_cast<std::int16_t>(y_);
    ++seen_labels_;
    if (!label.is_region && index > 0) label.outer = here_[index - 1].label;
}

/// After labels were merged: makes the labels of this row final, and what is on the left of the ground, whose
/// leftmost run comes last.
template <class Accumulated>
void ConnectedComponentsOf<Accumulated>::settle_row() {
    for (int i = here_.count() - 1; i >= 0; --i) {
        Run& run = here_[i];
        if (run.label == none) continue;
        run.label = find(run.label);
        Label& label = labels_[run.label];
        label.seen_row = static_cast<std::int16_t>(y_);
        if (!label.is_region && i > 0) label.outer = find(here_[i - 1].label);
    }
}

/// Lists what has no run in this row, then frees those labels and the ones that were merged.
template <class Accumulated>
void ConnectedComponentsOf<Accumulated>::close_labels() {
    for (int i = 0; i < above_.count(); ++i) {
        const LabelIndex index = above_[i].label;
        if (index == none) continue;
        Label& label = labels_[index];
        if (label.link != index || label.seen_row == y_ || label.bottom < 0) continue;
        if (label.is_region)
            close_region(label);
        else if (!label.at_border && label.moments.area() >= options_.hole_area_min)
            close_hole(label);
        label.bottom = -1;
        --open_labels_;
    }
    for (int i = 0; i < above_.count(); ++i) {
        const LabelIndex index = above_[i].label;
        if (index == none) continue;
        const Label& label = labels_[index];
        if (label.used && (label.link != index || label.seen_row != y_)) free_label(index);
    }
}

template <class Accumulated>
void ConnectedComponentsOf<Accumulated>::free_label(LabelIndex label) {
    labels_[label].used = false;
    labels_[label].link = free_;
    free_ = label;
}

template <class Accumulated>
void ConnectedComponentsOf<Accumulated>::close_hole(const Label& hole) {
    const Rectangle box{hole.left, hole.first.y, hole.right - hole.left + 1, hole.bottom - hole.first.y + 1};
    Label& region = labels_[find(hole.outer)];
    ++region.hole_count;
    region.hole_area += hole.moments.area();
    lists_.add_hole({hole.moments, box, hole.first, 0}, region.holes, labels_);
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

}  // namespace fovea
