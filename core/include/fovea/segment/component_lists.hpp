// SPDX-License-Identifier: MIT
//
// The lists that connected components fill: full ones keep the largest, and holes find their region although
// it is listed after them.
#pragma once

#include <cstdint>

#include <fovea/base/list.hpp>
#include <fovea/base/order.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/segment/region.hpp>

namespace fovea {

namespace detail {

/// The holes of an open region: places in the list, each of which names the next.
struct HoleChain {
    static constexpr int none = -1;
    int first = none;
    int last = none;
};

template <class Accumulated>
class ComponentLists {
public:
    using Region = RegionOf<Accumulated>;
    using Hole = HoleOf<Accumulated>;

    ComponentLists(ListView<Region> regions, ListView<Hole> holes) : regions_(regions), holes_(holes) {}

    void clear() {
        regions_.clear();
        holes_.clear();
    }
    /// True if something had no room.
    bool overflow() const { return overflow_; }

    /// Lists a hole of an open region. A full list gives the place of its smallest hole; owners, all with a
    /// chain called holes, are where that may hang.
    template <class Owner>
    void add_hole(const Hole& hole, HoleChain& chain, Span<Owner> owners) {
        int place = holes_.size();
        if (holes_.full()) {
            overflow_ = true;
            place = smallest(holes_, smallest_hole_);
            if (place == unknown || holes_[place].moments.area() >= hole.moments.area()) return;
            unchain(place, owners);
            holes_[place] = hole;
            smallest_hole_ = unknown;
        } else {
            static_cast<void>(holes_.push(hole));
        }
        holes_[place].region = last_of_chain;
        join(chain, {place, place});
    }
    /// Hangs the holes of gone behind those of kept.
    void join(HoleChain& kept, const HoleChain& gone) {
        if (gone.first == HoleChain::none) return;
        if (kept.first == HoleChain::none)
            kept.first = gone.first;
        else
            holes_[kept.last].region = link_to(gone.first);
        kept.last = gone.last;
    }
    /// Lists a region whose holes all are known. A full list gives the place of its smallest region.
    void add_region(const Region& region, const HoleChain& chain) {
        int place = regions_.size();
        if (regions_.full()) {
            overflow_ = true;
            place = smallest(regions_, smallest_region_);
            if (place == unknown || regions_[place].moments.area() >= region.moments.area()) {
                drop_holes(chain);
                return;
            }
            if (regions_[place].holes > 0)
                for (Hole& hole : holes_)
                    if (hole.region == place) hole.region = dropped;
            regions_[place] = region;
            smallest_region_ = unknown;
        } else {
            static_cast<void>(regions_.push(region));
        }
        regions_[place].number = place;
        settle(chain, place);
    }
    /// The same for a region that is not wanted.
    void drop_holes(const HoleChain& chain) { settle(chain, dropped); }

    /// Drops the holes of regions that are not listed, and puts both lists in order.
    void order() {
        const auto before = [](Point a, Point b) { return a.y != b.y ? a.y < b.y : a.x < b.x; };
        int kept = 0;
        for (const Hole& hole : holes_)
            if (hole.region != dropped) holes_[kept++] = hole;
        holes_.shrink(kept);
        sort_nearly_ordered(regions_.span(),
                            [&](const Region& a, const Region& b) { return before(a.first, b.first); });
        invert_numbers();
        for (Hole& hole : holes_) hole.region = -1 - regions_[hole.region].number;
        for (int i = 0; i < regions_.size(); ++i) regions_[i].number = i;
        sort_nearly_ordered(holes_.span(),
                            [&](const Hole& a, const Hole& b) { return before(a.first, b.first); });
    }

private:
    /// What a hole's region number says before order(): a place in the list, that the region is not listed,
    /// or, while the region is open, which hole of its is the next.
    static constexpr int dropped = -1;
    static constexpr int last_of_chain = -2;
    static constexpr int link_to(int hole) { return -3 - hole; }
    static constexpr int next_hole(int number) {
        return number < last_of_chain ? -3 - number : HoleChain::none;
    }
    static constexpr int unknown = -1;

    /// The place of the smallest element, the first of equals, if it is not known yet.
    template <class Element>
    static int smallest(ListView<Element> list, int& known) {
        if (known == unknown && !list.empty()) {
            known = 0;
            for (int i = 1; i < list.size(); ++i)
                if (list[i].moments.area() < list[known].moments.area()) known = i;
        }
        return known;
    }
    void settle(const HoleChain& chain, int number) {
        for (int hole = chain.first; hole != HoleChain::none;) {
            const int next = next_hole(holes_[hole].region);
            holes_[hole].region = number;
            hole = next;
        }
    }
    /// Takes a hole out of the chain of its region if that is still open.
    template <class Owner>
    void unchain(int hole, Span<Owner> owners) {
        const int after = holes_[hole].region;
        if (after >= dropped) return;
        int before = HoleChain::none;
        for (int i = 0; i < holes_.size(); ++i)
            if (holes_[i].region == link_to(hole)) before = i;
        if (before != HoleChain::none) holes_[before].region = after;
        for (Owner& owner : owners) {
            if (owner.holes.first == hole) owner.holes.first = next_hole(after);
            if (owner.holes.last == hole) owner.holes.last = before;
        }
    }
    /// The numbers of sorted regions say where each was: a permutation. Its inverse, where the region that
    /// was there has gone, takes its place cycle by cycle; numbers that are turned already are negative, -1
    /// less the place.
    void invert_numbers() {
        for (int i = 0; i < regions_.size(); ++i) {
            int from = i;
            for (int to = regions_[i].number; to >= 0;) {
                const int next = regions_[to].number;
                regions_[to].number = -1 - from;
                from = to;
                to = next;
            }
        }
    }

    ListView<Region> regions_;
    ListView<Hole> holes_;
    bool overflow_ = false;
    /// In full lists, once asked for.
    int smallest_hole_ = unknown;
    int smallest_region_ = unknown;
};

}  // namespace detail

}  // namespace fovea
