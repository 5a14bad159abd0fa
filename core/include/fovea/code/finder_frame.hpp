// SPDX-License-Identifier: MIT
//
// A finder pattern measured along the sides of its symbol: how large a module is there, and where its outer
// edges run.
#pragma once

#include <cstdint>

#include <fovea/code/finder_patterns.hpp>
#include <fovea/code/module_plane.hpp>

namespace fovea::detail {

/// A straight line through two places in 1/256 px.
struct PlaceLine {
    ModulePoint from;
    ModulePoint to;
};
/// Where two lines meet; false for parallel ones. Places below 2^24 give cross products below 2^50.
constexpr bool meet(const PlaceLine& a, const PlaceLine& b, ModulePoint& place) {
    const ModulePoint along = a.to - a.from;
    const ModulePoint other = b.to - b.from;
    const std::int64_t divisor = cross_product(along, other);
    if (divisor == 0) return false;
    const std::int64_t share = cross_product(b.from - a.from, other);
    // The share of the way to 2^-12, held at 64 times the way.
    const std::int64_t scaled = clamp<std::int64_t>(share * 4096 / divisor, -64 * 4096, 64 * 4096);
    place = a.from + along * scaled / 4096;
    return true;
}

/// A finder pattern seen along the sides of the symbol: u to the right, v down as one reads it.
class FinderFrame {
public:
    /// Measures along two ways that lead to other finders. False where it does not look like one.
    bool measure(const FinderImage& image, ModulePoint centre, std::int64_t module, ModulePoint towards_u,
                 ModulePoint towards_v) {
        image_ = image;
        centre_ = centre;
        if (!measure_axis(towards_u, module, u_) || !measure_axis(towards_v, module, v_)) return false;
        // The second time along its own sides.
        if (measure_edges()) measure_edges();
        return true;
    }

    ModulePoint centre() const { return centre_; }
    /// A module's way to the right and down.
    ModulePoint u() const { return u_; }
    ModulePoint v() const { return v_; }
    ModulePoint at(std::int64_t half_modules_u, std::int64_t half_modules_v) const {
        return centre_ + (u_ * half_modules_u + v_ * half_modules_v) / 2;
    }
    /// The outer edge on the side of a way, u() or v() or against one of them. False where it is not seen.
    bool edge(ModulePoint outward, ModulePoint along, PlaceLine& line) const {
        Crossing seen[lines];
        int count = 0;
        for (int t = -reach; t <= reach; ++t) {
            // Seven lines, 0.9 modules apart.
            seen[count].t = t;
            if (crossing(centre_ + along * (t * 9) / 10, outward, seen[count].s)) ++count;
        }
        // The straight line through two of them that most agree with: others see damage or other print.
        int best = 3;
        Crossing from, to;
        for (int i = 0; i < count; ++i) {
            for (int j = i + 2; j < count; ++j) {
                const int agreeing = agree(seen, count, seen[i], seen[j]);
                if (agreeing <= best) continue;
                best = agreeing;
                from = seen[i];
                to = seen[j];
            }
        }
        if (best == 3) return false;
        std::int64_t sum_t = 0, sum_s = 0, sum_tt = 0, sum_ts = 0, used = 0;
        for (int i = 0; i < count; ++i) {
            if (!agrees(seen[i], from, to)) continue;
            sum_t += seen[i].t;
            sum_s += seen[i].s;
            sum_tt += seen[i].t * seen[i].t;
            sum_ts += seen[i].t * seen[i].s;
            ++used;
        }
        // s = offset + slope t by least squares, both in 1/256 module, times spread; spread is not 0, as no
        // two of four or more t are equal.
        const std::int64_t spread = used * sum_tt - sum_t * sum_t;
        const std::int64_t slope = used * sum_ts - sum_t * sum_s;
        const std::int64_t offset = sum_s * sum_tt - sum_t * sum_ts;
        const auto place = [&](std::int64_t t) {
            return centre_ + along * (t * 9) / 10 + outward * ((offset + slope * t) / spread) / 256;
        };
        line = {place(-reach), place(reach)};
        return true;
    }

private:
    static constexpr int reach = 3;

    static constexpr int lines = 2 * reach + 1;

    /// Where line t crosses the edge, in 1/256 module outward.
    struct Crossing {
        std::int64_t t = 0;
        std::int64_t s = 0;
    };
    /// Within a fifth of a module of the line through two.
    static bool agrees(Crossing c, Crossing from, Crossing to) {
        const std::int64_t off = (c.s - from.s) * (to.t - from.t) - (to.s - from.s) * (c.t - from.t);
        return off <= 51 * (to.t - from.t) && -off <= 51 * (to.t - from.t);
    }
    static int agree(const Crossing (&seen)[lines], int count, Crossing from, Crossing to) {
        int agreeing = 0;
        for (int i = 0; i < count; ++i) agreeing += agrees(seen[i], from, to) ? 1 : 0;
        return agreeing;
    }
    /// How far the outer edge is from the centre along a way of a known length, in 1/256 px; 0 if there is
    /// none within seven modules. Where it is farther than the inner edge of the ring allows, or not there,
    /// that one tells.
    std::int64_t extent(ModulePoint way, std::int64_t way_length, std::int64_t module) const {
        const std::int64_t step = maximum<std::int64_t>(module / 8, 48);
        bool dark = true;
        int changes = 0;
        std::int64_t inner = 0;
        for (std::int64_t s = 0; s < 7 * module; s += step) {
            const ModulePoint place = centre_ + way * s / way_length;
            if (image_.dark(place) == dark) continue;
            dark = !dark;
            ++changes;
            if (changes == 2) inner = s - step / 2;
            if (changes == 3) return s * 5 > inner * 8 ? inner * 7 / 5 : s - step / 2;
        }
        return inner * 7 / 5;
    }
    bool measure_axis(ModulePoint towards, std::int64_t module, ModulePoint& axis) {
        const std::int64_t way = length(towards);
        if (way == 0) return false;
        const std::int64_t forward = extent(towards, way, module);
        const std::int64_t back = extent(towards * -1, way, module);
        if (forward == 0 || back == 0 || forward > 3 * back || back > 3 * forward) return false;
        axis = towards * (forward + back) / (7 * way);
        return true;
    }
    /// Takes centre and ways from the four edges. False if they are not all seen or tell another place.
    bool measure_edges() {
        PlaceLine right, left, below, above;
        if (!edge(u_, v_, right) || !edge(u_ * -1, v_, left) || !edge(v_, u_, below) ||
            !edge(v_ * -1, u_, above))
            return false;
        ModulePoint corner[4];
        if (!meet(above, left, corner[0]) || !meet(above, right, corner[1]) ||
            !meet(below, right, corner[2]) || !meet(below, left, corner[3]))
            return false;
        ModulePoint middle;
        if (!meet({corner[0], corner[2]}, {corner[1], corner[3]}, middle)) return false;
        const std::int64_t module = maximum(length(u_), length(v_));
        if (length(middle - centre_) * 4 > 3 * module) return false;
        const ModulePoint u = (corner[1] - corner[0] + corner[2] - corner[3]) / 14;
        const ModulePoint v = (corner[3] - corner[0] + corner[2] - corner[1]) / 14;
        if (length(u - u_) * 2 > module || length(v - v_) * 2 > module) return false;
        centre_ = middle;
        u_ = u;
        v_ = v;
        return true;
    }
    /// Where a line outward from a place beside the centre leaves the dark ring, in 1/256 of outward.
    bool crossing(ModulePoint start, ModulePoint outward, std::int64_t& place) const {
        const auto dark = [&](std::int64_t s) { return image_.dark(start + outward * s / 256); };
        constexpr std::int64_t ring = 3 * 256;
        constexpr std::int64_t step = 48;
        std::int64_t inner = ring;
        std::int64_t outer = ring;
        // A slanting ring may begin farther out.
        while (!dark(inner) && inner < ring + 192) inner += step;
        if (dark(inner)) {
            for (outer = inner + step; dark(outer); outer += step)
                if (outer > 5 * 256) return false;
            inner = outer - step;
        } else {
            for (inner = ring - step; !dark(inner); inner -= step)
                if (inner < 2 * 256) return false;
            outer = inner + step;
        }
        for (int round = 0; round < 4; ++round) {
            const std::int64_t middle = (inner + outer) / 2;
            (dark(middle) ? inner : outer) = middle;
        }
        place = (inner + outer) / 2;
        return true;
    }

    FinderImage image_;
    ModulePoint centre_;
    ModulePoint u_;
    ModulePoint v_;
};

}  // namespace fovea::detail
