// SPDX-License-Identifier: MIT
//
// Which three finder patterns belong to one QR code.
#pragma once

#include <cstdint>

#include <fovea/base/list.hpp>
#include <fovea/code/finder_patterns.hpp>
#include <fovea/code/module_plane.hpp>
#include <fovea/number/integer.hpp>

namespace fovea::detail {

/// The threes of finder patterns that may be the corners of a square seen in perspective, the best first.
class FinderTriples {
public:
    static constexpr int most_patterns = 24;
    static constexpr int most_triples = 16;

    explicit FinderTriples(ListView<FinderPattern> patterns) : patterns_(patterns) {
        strongest_first();
        const int count = minimum(patterns.size(), most_patterns);
        for (int i = 0; i < count; ++i)
            for (int j = i + 1; j < count; ++j)
                for (int k = j + 1; k < count; ++k) judge(i, j, k);
    }

    int size() const { return triples_.size(); }
    const FinderPattern& corner(int index) const { return patterns_[triples_[index].pattern[0]]; }
    const FinderPattern& right(int index) const { return patterns_[triples_[index].pattern[1]]; }
    const FinderPattern& below(int index) const { return patterns_[triples_[index].pattern[2]]; }
    /// Whether none of its patterns belongs to a code that was read.
    bool usable(int index) const {
        for (const int pattern : triples_[index].pattern)
            if (used_[pattern]) return false;
        return true;
    }
    void use(int index) {
        for (const int pattern : triples_[index].pattern) used_[pattern] = true;
    }

private:
    struct Triple {
        int pattern[3] = {};
        std::int64_t penalty = 0;
    };

    void strongest_first() {
        for (int i = 1; i < patterns_.size(); ++i) {
            const FinderPattern moved = patterns_[i];
            int j = i;
            for (; j > 0 && stronger(moved, patterns_[j - 1]); --j) patterns_[j] = patterns_[j - 1];
            patterns_[j] = moved;
        }
    }
    void judge(int a, int b, int c) {
        const FinderPattern& first = patterns_[a];
        if (patterns_[b].inverted != first.inverted || patterns_[c].inverted != first.inverted) return;
        const std::int64_t small = minimum(first.module, minimum(patterns_[b].module, patterns_[c].module));
        const std::int64_t large = maximum(first.module, maximum(patterns_[b].module, patterns_[c].module));
        if (large > 3 * small) return;
        // The corner is opposite of the longest side.
        const std::int64_t ab = squared(a, b);
        const std::int64_t bc = squared(b, c);
        const std::int64_t ca = squared(c, a);
        Triple triple;
        if (bc >= ab && bc >= ca)
            set(triple, a, b, c);
        else if (ca >= ab && ca >= bc)
            set(triple, b, c, a);
        else
            set(triple, c, a, b);
        const ModulePoint u = patterns_[triple.pattern[1]].centre - patterns_[triple.pattern[0]].centre;
        const ModulePoint v = patterns_[triple.pattern[2]].centre - patterns_[triple.pattern[0]].centre;
        const std::int64_t across = length(u);
        const std::int64_t along = length(v);
        const std::int64_t shorter = minimum(across, along);
        const std::int64_t longer = maximum(across, along);
        // At least the 14 modules of version 1, measured along a row that may cross a finder askew; at most
        // the 170 of version 40.
        if (shorter < 8 * small || longer > 200 * large || longer > 2 * shorter) return;
        // In 1/1024: sine of what the angle is off a right one, ratio of the sides, ratio of the modules.
        const std::int64_t askew = static_cast<std::int64_t>(magnitude(dot(u, v))) * 1024 / across / along;
        if (askew > 600) return;
        triple.penalty = askew + (longer - shorter) * 1024 / longer + (large - small) * 1024 / large;
        insert(triple);
    }
    /// right and below in the order of one who reads: what turns from right to below turns clockwise.
    void set(Triple& triple, int corner, int one, int other) const {
        const ModulePoint u = patterns_[one].centre - patterns_[corner].centre;
        const ModulePoint v = patterns_[other].centre - patterns_[corner].centre;
        const bool clockwise = cross_product(u, v) > 0;
        triple.pattern[0] = corner;
        triple.pattern[1] = clockwise ? one : other;
        triple.pattern[2] = clockwise ? other : one;
    }
    void insert(const Triple& triple) {
        if (triples_.size() == most_triples && triples_[most_triples - 1].penalty <= triple.penalty) return;
        if (triples_.size() == most_triples) triples_.view().shrink(most_triples - 1);
        static_cast<void>(triples_.push(triple));
        for (int i = triples_.size() - 1; i > 0 && triples_[i].penalty < triples_[i - 1].penalty; --i) {
            const Triple moved = triples_[i];
            triples_[i] = triples_[i - 1];
            triples_[i - 1] = moved;
        }
    }
    std::int64_t squared(int a, int b) const {
        const ModulePoint way = patterns_[a].centre - patterns_[b].centre;
        return dot(way, way);
    }

    ListView<FinderPattern> patterns_;
    List<Triple, most_triples> triples_;
    bool used_[max_finder_patterns] = {};
};

}  // namespace fovea::detail
