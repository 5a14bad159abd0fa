// SPDX-License-Identifier: MIT
//
// The frame of a Data Matrix: from a corner to its two solid lines, its two dashed ones, and its modules.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/code/data_matrix_corners.hpp>
#include <fovea/code/data_matrix_dashes.hpp>
#include <fovea/code/data_matrix_lines.hpp>
#include <fovea/code/data_matrix_sizes.hpp>
#include <fovea/code/work_budget.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/number/integer.hpp>

namespace fovea::detail {

/// Four corners, where the solid lines meet, where they end, and opposite; and how many modules lie between.
struct DataMatrixFrame {
    EdgePlace corner;
    EdgePlace upper;  ///< the end of the line that stands left of a symbol seen from the front
    EdgePlace right;  ///< the end of the line below it
    EdgePlace opposite;
    int rows = 0;
    int columns = 0;
};

/// At how many of 15 places along a piece light lies behind the dark, nearer than a third of its length:
/// beside the solid line of a symbol that is so for about half of the modules. A unit of work for four
/// pixels, as nothing is done between them.
inline int thin_places(const CodeField& field, const BorderPiece& piece, int threshold, WorkBudget& budget) {
    constexpr int places = 16;
    constexpr int most_depths = 16;
    const int reach = piece.length / 3;
    const int step = maximum(reach / 8, 1);
    // Images have 2^15 px a side: all products stay below 2^31.
    const int along_x = piece.last.x - piece.first.x;
    const int along_y = piece.last.y - piece.first.y;
    Point inward[most_depths];
    int depths = 0;
    for (int depth = 1; depth <= reach; depth += step)
        inward[depths++] = {-(along_y * depth / piece.length), along_x * depth / piece.length};
    int light = 0;
    int looks = 0;
    for (int i = 1; i < places; ++i) {
        const int x = piece.first.x + along_x * i / places;
        const int y = piece.first.y + along_y * i / places;
        int k = 0;
        for (; k < depths; ++k) {
            if (field.pixel(x + inward[k].x, y + inward[k].y) < threshold) continue;
            ++light;
            break;
        }
        looks += minimum(k + 1, depths);
    }
    budget.spend(looks / 4);
    return light;
}

/// Scratch of FrameFinder.
struct FrameScratch {
    DashScratch dash;
    DashedLine& above;   ///< from the end of the line on the left
    DashedLine& beside;  ///< from the end of the line below
};

/// Finds the frame that begins at a corner; its parts share the levels and the size of a module.
class FrameFinder {
public:
    FrameFinder(const CodeField& field, const BorderCorner& corner, const FrameScratch& scratch)
        : field_(field),
          scratch_(scratch),
          threshold_(16 * corner.threshold - 8),
          largest_(256 * (field.size().width + field.size().height)) {}

    /// The two solid lines. not_found where they are none.
    Status find_arms(const BorderCorner& corner);
    /// The rest, with modules of that share of the solid lines' thickness, in 1/256.
    Result<DataMatrixFrame> find(int share);

private:
    static constexpr int probes = 24;
    static constexpr int gap_share = 205;  ///< of a module, in 1/256: light that ends a solid line

    int value(EdgePlace p) const { return field_.sample(p.x, p.y); }
    bool refine(const EdgeLine& chord, Direction outward, std::int32_t from, std::int32_t to, int most_places,
                EdgeLine& line) const;
    std::int32_t thickness(const SolidLine& arm, std::int32_t from, std::int32_t to) const;
    std::int32_t walk(const SolidLine& arm) const;
    /// Both begin where they meet.
    static bool settle(SolidLine& first, SolidLine& second);

    CodeField field_;
    FrameScratch scratch_;
    int threshold_;  ///< in 1/16 grey levels
    int hysteresis_ = 64;
    std::int32_t largest_;
    std::int32_t module_ = 0;
    std::int32_t thickness_ = 0;
    SolidLine first_;  ///< along the way into the corner: below a symbol seen from the front
    SolidLine second_;
};

/// The edge near a chord that dark pixels' centres gave, between two ways along it.
inline bool FrameFinder::refine(const EdgeLine& chord, Direction outward, std::int32_t from, std::int32_t to,
                                int most_places, EdgeLine& line) const {
    constexpr int steps = 10;
    EdgePlace offsets[probes];
    int count = 0;
    const std::int32_t margin = (to - from) / 16;
    const int places = static_cast<int>(clamp<std::int32_t>((to - from) >> 9, 6, most_places));
    for (int i = 0; i < places; ++i) {
        const std::int32_t along =
            from + margin +
            static_cast<std::int32_t>(std::int64_t{to - from - 2 * margin} * i / (places - 1));
        const EdgePlace middle = chord.at + chord.direction.times(along);
        int levels[steps];
        int low = 4080;
        int high = 0;
        FieldSteps across = steps_along(field_, middle, outward, -448, 128);
        for (int k = 0; k < steps; ++k) {
            levels[k] = across.next();
            low = minimum(low, levels[k]);
            high = maximum(high, levels[k]);
        }
        // The middle of what is here, unless that is too little.
        const int between = high - low > 192 ? (high + low) / 2 : threshold_;
        std::int32_t best = 1 << 20;
        for (int k = 1; k < steps; ++k) {
            if (levels[k - 1] >= between || levels[k] < between) continue;
            const std::int32_t place =
                128 * k - 448 - 128 * (levels[k] - between) / (levels[k] - levels[k - 1]);
            if (magnitude(place - 128) < magnitude(best - 128)) best = place;
        }
        if (best < 1 << 20) offsets[count++] = {along, best};
    }
    scratch_.dash.budget.spend(steps * std::int64_t{places});
    return 2 * count >= places && fit_edge({offsets, count}, chord, outward, line);
}

/// A quarter of the dark runs from the edge inward are shorter: about one module, as data there are light
/// half of the time.
inline std::int32_t FrameFinder::thickness(const SolidLine& arm, std::int32_t from, std::int32_t to) const {
    constexpr int quarter = probes / 4;
    std::int32_t shortest[quarter + 1];  // in order
    int looks = 0;
    std::int32_t most = maximum<std::int32_t>((to - from) / 4, 512);
    const std::int32_t step = clamp<std::int32_t>(most / 32, 64, 512);
    for (int i = 0; i < probes; ++i) {
        const std::int32_t along =
            from + static_cast<std::int32_t>(std::int64_t{to - from} * (2 * i + 1) / (2 * probes));
        const EdgePlace edge = arm.line.at + arm.line.direction.times(along);
        const int dark = minimum(value(edge + arm.inward.times(192)), value(edge + arm.inward.times(320)));
        const int light = value(edge - arm.inward.times(384));
        const int between = light - dark > 128 ? (light + dark) / 2 : threshold_;
        std::int32_t depth = 96;
        int before = between - 1;
        FieldSteps inward = steps_along(field_, edge, arm.inward, depth, step);
        for (; depth < most; depth += step, ++looks) {
            const int now = inward.next();
            if (now >= between) {
                depth -= step * (now - between) / maximum(now - before, 1);
                break;
            }
            before = now;
        }
        int place = minimum(i, quarter);
        if (i > quarter && depth >= shortest[quarter]) continue;
        for (; place > 0 && shortest[place - 1] > depth; --place) shortest[place] = shortest[place - 1];
        shortest[place] = depth;
        // What is longer than these does not count; the last look is up to a step behind the light.
        if (i >= quarter) most = minimum(most, shortest[quarter] + step);
    }
    scratch_.dash.budget.spend(3 * probes + looks);
    return shortest[quarter];
}

/// How far a solid line goes from the corner.
inline std::int32_t FrameFinder::walk(const SolidLine& arm) const {
    const std::int32_t depth = module_ / 2;
    const std::int32_t step = maximum<std::int32_t>(module_ / 8, 64);
    const std::int32_t gap =
        maximum<std::int32_t>(static_cast<std::int32_t>(std::int64_t{module_} * gap_share >> 8), 256);
    const EdgePlace start = arm.line.at + arm.inward.times(depth);
    const EdgePlace outside = arm.line.at - arm.inward.times(maximum<std::int32_t>(depth, 320));
    // Levels on both sides of the edge, which follow the light along it.
    int dark = value(start + arm.line.direction.times(module_));
    int light = value(outside + arm.line.direction.times(module_));
    std::int32_t end = 0;
    int before = dark;
    bool in_dark = true;
    std::int64_t looks = 0;
    FieldSteps inside = steps_along(field_, start, arm.line.direction, module_ / 2, step);
    FieldSteps beside = steps_along(field_, outside, arm.line.direction, module_ / 2, step);
    for (std::int32_t along = module_ / 2; along < largest_; along += step) {
        const int now = inside.next();
        light = (7 * light + beside.next()) >> 3;
        looks += 2;
        const int between = (light + dark) >> 1;
        if (now < between) {
            in_dark = true;
            end = along;
            dark = (7 * dark + now) >> 3;
        } else {
            if (in_dark) end = along - (before < between ? step * (now - between) / (now - before) : step);
            in_dark = false;
            if (along - end > gap) break;
        }
        before = now;
    }
    scratch_.dash.budget.spend(looks);
    return end;
}

inline bool FrameFinder::settle(SolidLine& first, SolidLine& second) {
    const Result<EdgePlace> met = crossing(first.line, second.line);
    if (!met) return false;
    first.line.at = *met;
    second.line.at = *met;
    return true;
}

inline Status FrameFinder::find_arms(const BorderCorner& corner) {
    const auto chord_of = [](const BorderPiece& piece) {
        return EdgeLine{{256 * piece.first.x, 256 * piece.first.y}, direction_of(piece.x(), piece.y())};
    };
    const EdgeLine in = chord_of(corner.in);
    const EdgeLine out = chord_of(corner.out);
    SolidLine& first = first_;
    SolidLine& second = second_;
    if (!refine(in, in.direction.right().reversed(), 0, 256 * corner.in.length, 10, first.line))
        return Status::not_found;
    if (!refine(out, out.direction.right().reversed(), 0, 256 * corner.out.length, 10, second.line))
        return Status::not_found;
    first.inward = first.line.direction.right();
    first.line.direction = first.line.direction.reversed();
    second.inward = second.line.direction.right();
    if (!settle(first, second)) return Status::not_found;
    const auto way_to = [](const SolidLine& arm, Point p) {
        return arm.line.direction.along(EdgePlace{256 * p.x, 256 * p.y} - arm.line.at);
    };
    // The thinner of the two: beside one of them the data may be dark by chance.
    const std::int32_t thick_first = thickness(first, 0, way_to(first, corner.in.first));
    const std::int32_t thick_second = thickness(second, 0, way_to(second, corner.out.last));
    module_ = maximum<std::int32_t>(minimum(thick_first, thick_second), 200);
    for (int round = 0; round < 2; ++round) {
        first.length = walk(first);
        second.length = walk(second);
        // Eight modules at least, printed up to half as thick again.
        if (2 * first.length < 9 * module_ || 2 * second.length < 9 * module_) return Status::not_found;
        if (first.length > 200 * module_ || second.length > 200 * module_) return Status::not_found;
        if (round == 1) break;
        // Once more along the whole of both.
        const SolidLine short_first = first;
        const SolidLine short_second = second;
        const Direction outward_first = first.inward.reversed();
        const Direction outward_second = second.inward.reversed();
        const EdgeLine chord_first{first.line.at + first.inward.times(128), first.line.direction};
        const EdgeLine chord_second{second.line.at + second.inward.times(128), second.line.direction};
        if (!refine(chord_first, outward_first, 0, first.length, probes, first.line)) first = short_first;
        if (!refine(chord_second, outward_second, 0, second.length, probes, second.line))
            second = short_second;
        if (!settle(first, second)) return Status::not_found;
    }
    // Levels on both sides of the edges.
    std::int64_t dark = 0;
    std::int64_t light = 0;
    const SolidLine* const arms[2] = {&first, &second};
    for (const SolidLine* arm : arms) {
        for (int i = 1; i < 8; ++i) {
            const EdgePlace edge = arm->line.at + arm->line.direction.times(arm->length / 8 * i);
            dark += value(edge + arm->inward.times(module_ / 2));
            light += value(edge - arm->inward.times(maximum<std::int32_t>(module_ / 2, 384)));
        }
    }
    if (light <= dark) return Status::not_found;
    hysteresis_ = maximum(static_cast<int>((light - dark) / 14 / 5), 64);
    thickness_ = module_;
    return Status::ok;
}

inline Result<DataMatrixFrame> FrameFinder::find(int share) {
    SolidLine first = first_;
    SolidLine second = second_;
    module_ = maximum<std::int32_t>(static_cast<std::int32_t>(std::int64_t{thickness_} * share >> 8), 200);
    DataMatrixFrame frame;
    DashedLine& beside = scratch_.beside;
    DashedLine& above = scratch_.above;
    EdgeLine right;
    EdgeLine upper;
    const auto with = [](int other) {
        return [other](int n) {
            return data_matrix_size(n, other) != nullptr || data_matrix_size(other, n) != nullptr;
        };
    };
    const DashFinder dashes(field_, module_, hysteresis_, scratch_.dash);
    if (!dashes.find(first, second, is_side, beside, right)) return Status::not_found;
    if (!dashes.find(second, first, with(beside.modules()), above, upper)) {
        if (!dashes.find(second, first, is_side, above, upper)) return Status::not_found;
        if (!dashes.find(first, second, with(above.modules()), beside, right)) return Status::not_found;
    }
    // Print grows on all sides alike, and the grid does not.
    const std::int32_t growth = (growth_of(beside) + growth_of(above)) / 2;
    first.line.at = first.line.at + first.inward.times(growth);
    second.line.at = second.line.at + second.inward.times(growth);
    right.at = right.at - first.line.direction.times(growth);
    upper.at = upper.at - second.line.direction.times(growth);
    if (!settle(first, second)) return Status::not_found;
    const Result<EdgePlace> a = crossing(right, first.line);
    const Result<EdgePlace> b = crossing(upper, second.line);
    const Result<EdgePlace> d = crossing(right, upper);
    if (!a || !b || !d) return Status::not_found;
    frame.corner = first.line.at;
    frame.right = *a;
    frame.upper = *b;
    frame.opposite = *d;
    frame.columns = above.modules();
    frame.rows = beside.modules();
    return frame;
}

}  // namespace fovea::detail
