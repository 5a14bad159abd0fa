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
    Place from;
    Place to;
};
/// Where two lines meet; false for parallel ones. Places below 2^24 give cross products below 2^50.
constexpr bool meet(const PlaceLine& a, const PlaceLine& b, Place& place) {
    const Place along = a.to - a.from;
    const Place other = b.to - b.from;
    const std::int64_t divisor = cross(along, other);
    if (divisor == 0) return false;
    const std::int64_t share = cross(b.from - a.from, other);
    // The share of the way to 2^-12, held at 64 times the way.
    const std::int64_t scaled = clamp<std::int64_t>(share * 4096 / divisor, -64 * 4096, 64 * 4096);
    place = a.from + along * scaled / 4096;
    return true;
}

/// A finder pattern seen along the sides of the symbol: u to the right, v down as one reads it.
class FinderFrame {
public:
    /// Measures along two ways that lead to other finders. False where it does not look like one.
    bool measure(const FinderImage& image, Place centre, std::int64_t module, Place towards_u,
                 Place towards_v) {
        image_ = image;
        centre_ = centre;
        for (int round = 0; round < 2; ++round) {
            if (!measure_axis(towards_u, module, u_) || !measure_axis(towards_v, module, v_)) return false;
            if (round == 0 && !recentre()) break;
        }
        return true;
    }

    Place centre() const { return centre_; }
    /// A module's way to the right and down.
    Place u() const { return u_; }
    Place v() const { return v_; }
    Place at(std::int64_t half_modules_u, std::int64_t half_modules_v) const {
        return centre_ + (u_ * half_modules_u + v_ * half_modules_v) / 2;
    }
    /// The outer edge on the side of a way, u() or v() or against one of them. False where it is not seen.
    bool edge(Place outward, Place along, PlaceLine& line) const {
        std::int64_t sum_t = 0, sum_s = 0, sum_tt = 0, sum_ts = 0, count = 0;
        std::int64_t seen[2 * reach + 1] = {};
        bool valid[2 * reach + 1] = {};
        for (int t = -reach; t <= reach; ++t) {
            // Seven lines, 0.9 modules apart.
            const Place start = centre_ + along * (t * 9) / 10;
            valid[t + reach] = crossing(start, outward, seen[t + reach]);
        }
        const std::int64_t middle = median_of(seen, valid);
        if (middle < 0) return false;
        for (int t = -reach; t <= reach; ++t) {
            const std::int64_t s = seen[t + reach];
            // A third of a module beside the others is damage or another code's print.
            if (!valid[t + reach] || magnitude(s - middle) > 85) continue;
            sum_t += t;
            sum_s += s;
            sum_tt += t * t;
            sum_ts += t * s;
            ++count;
        }
        const std::int64_t spread = count * sum_tt - sum_t * sum_t;
        if (count < 4 || spread == 0) return false;
        // s = offset + slope t, both in 1/256 module, times spread.
        const std::int64_t slope = count * sum_ts - sum_t * sum_s;
        const std::int64_t offset = sum_s * sum_tt - sum_t * sum_ts;
        const auto place = [&](std::int64_t t) {
            return centre_ + along * (t * 9) / 10 + outward * ((offset + slope * t) / spread) / 256;
        };
        line = {place(-reach), place(reach)};
        return true;
    }

private:
    static constexpr int reach = 3;

    /// The median of what is valid, or -1 if less than four are.
    static std::int64_t median_of(const std::int64_t (&seen)[2 * reach + 1],
                                  const bool (&valid)[2 * reach + 1]) {
        std::int64_t sorted[2 * reach + 1] = {};
        int count = 0;
        for (int i = 0; i <= 2 * reach; ++i) {
            if (!valid[i]) continue;
            int j = count++;
            for (; j > 0 && sorted[j - 1] > seen[i]; --j) sorted[j] = sorted[j - 1];
            sorted[j] = seen[i];
        }
        return count < 4 ? -1 : sorted[count / 2];
    }
    /// How far the outer edge is from the centre along a way of a known length, in 1/256 px; 0 if there is none
    /// within seven modules. Where it is farther than the inner edge of the ring allows, or not there, that one
    /// tells.
    std::int64_t extent(Place way, std::int64_t way_length, std::int64_t module) const {
        const std::int64_t step = maximum<std::int64_t>(module / 8, 48);
        bool dark = true;
        int changes = 0;
        std::int64_t inner = 0;
        for (std::int64_t s = 0; s < 7 * module; s += step) {
            const Place place = centre_ + way * s / way_length;
            if (image_.dark(place) == dark) continue;
            dark = !dark;
            ++changes;
            if (changes == 2) inner = s - step / 2;
            if (changes == 3) return s * 5 > inner * 8 ? inner * 7 / 5 : s - step / 2;
        }
        return inner * 7 / 5;
    }
    bool measure_axis(Place towards, std::int64_t module, Place& axis) {
        const std::int64_t way = length(towards);
        if (way == 0) return false;
        const std::int64_t forward = extent(towards, way, module);
        const std::int64_t back = extent(towards * -1, way, module);
        if (forward == 0 || back == 0 || forward > 3 * back || back > 3 * forward) return false;
        axis = towards * (forward + back) / (7 * way);
        return true;
    }
    /// Takes the middle of the four edges for the centre. False if they are not all seen or tell another place.
    bool recentre() {
        PlaceLine right, left, below, above;
        if (!edge(u_, v_, right) || !edge(u_ * -1, v_, left) || !edge(v_, u_, below) ||
            !edge(v_ * -1, u_, above))
            return false;
        Place corner[4];
        if (!meet(above, left, corner[0]) || !meet(above, right, corner[1]) ||
            !meet(below, right, corner[2]) || !meet(below, left, corner[3]))
            return false;
        Place middle;
        if (!meet({corner[0], corner[2]}, {corner[1], corner[3]}, middle)) return false;
        if (length(middle - centre_) * 4 > 3 * maximum(length(u_), length(v_))) return false;
        centre_ = middle;
        return true;
    }
    /// Where a line outward from a place beside the centre leaves the dark ring, in 1/256 of outward.
    bool crossing(Place start, Place outward, std::int64_t& place) const {
        const auto dark = [&](std::int64_t s) { return image_.dark(start + outward * s / 256); };
        constexpr std::int64_t ring = 3 * 256;
        constexpr std::int64_t step = 48;
        std::int64_t inner = ring;
        std::int64_t outer = ring;
        if (dark(ring)) {
            for (outer += step; dark(outer); outer += step)
                if (outer > 5 * 256) return false;
            inner = outer - step;
        } else {
            for (inner -= step; !dark(inner); inner -= step)
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
    Place centre_;
    Place u_;
    Place v_;
};

}  // namespace fovea::detail
