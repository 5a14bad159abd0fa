// SPDX-License-Identifier: MIT
//
// Bar codes in an image, at any angle. Book ch. 5.
#pragma once

#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/base/list.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/code/bar_edges.hpp>
#include <fovea/code/bar_fields.hpp>
#include <fovea/code/bar_line.hpp>
#include <fovea/code/bar_reading.hpp>
#include <fovea/code/bar_votes.hpp>
#include <fovea/code/code.hpp>
#include <fovea/code/decode_bars.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

struct BarOptions {
    BarRules rules;
    int enough = 1;  ///< codes after which the search ends: more take longer, as the whole image is seen
    int effort = 2;  ///< 0 rows and columns, 1 and tilted lines, 2 and every way to see weak edges
    int agreeing_lines = 2;  ///< that a code needs at least; some need more, see bar_lines_needed(). 1..12
};

/// Scratch bytes that read_bars() needs.
constexpr std::int64_t read_bars_scratch(Size size);

/// Reads bar codes in an image: any angle, dark on light and light on dark, from either side.
///
/// Rows and columns come first, from the middle outwards, then lines across the fields of parallel edges, then
/// all of it with other rules for what an edge is. Where a line reads a code its neighbours are asked. A code
/// is told when enough lines agree on it; codes that contradict each other at one place are not told.
///
/// Shapes  any; codes with modules of a pixel or more, and quiet zones
/// Errors  empty_image; bad_argument; scratch_too_small; not_found; undecided where lines read something on
///         which not enough of them agree; buffer_too_small, capacity_exceeded with the first codes in the
///         list. Text and list are appended to, and untouched where nothing was read
/// Time    bounded: at most about a thousand lines
inline Status read_bars(ImageView<const Gray8> src, const BarOptions& options, Span<std::uint8_t> scratch,
                        CodeText& text, ListView<Code> codes);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

inline constexpr int most_bar_candidates = 16;
inline constexpr int most_bar_fields = 12;

/// A way to see the edges of a line.
struct BarSight {
    int share;
    BarEdgeRule rule;
    int sharpness;
};

class BarSearch {
public:
    BarSearch(ImageView<const Gray8> src, const BarOptions& options, Span<std::uint8_t> scratch)
        : src_(src), options_(options), votes_(ListView<BarCandidate>(nullptr, 0, nullptr)) {
        Arena arena(scratch);
        const std::int64_t samples = most_samples(src.size());
        profile_ = arena.take_unset<std::int16_t>(samples);
        sharp_profile_ = arena.take_unset<std::int16_t>(samples);
        ranges_ = arena.take_unset<std::int16_t>(bar_ranges(samples));
        turns_ = arena.take_unset<BarTurn>(samples);
        for (Span<std::int32_t>& edges : edges_) edges = arena.take_unset<std::int32_t>(samples + 6);
        candidates_ = arena.take<BarCandidate>(most_bar_candidates);
        votes_ = BarVotes(ListView<BarCandidate>(candidates_.data(), most_bar_candidates, &candidate_count_));
        fields_scratch_ = arena.take_unset<std::uint8_t>(bar_fields_scratch(src.size()));
    }
    static constexpr std::int64_t most_samples(Size size) { return std::int64_t{size.width} + size.height; }
    static constexpr std::int64_t scratch_bytes(Size size) {
        const std::int64_t samples = most_samples(size);
        return 2 * arena_bytes<std::int16_t>(samples) + arena_bytes<std::int16_t>(bar_ranges(samples)) +
               arena_bytes<BarTurn>(samples) + 3 * arena_bytes<std::int32_t>(samples + 6) +
               arena_bytes<BarCandidate>(most_bar_candidates) + bar_fields_scratch(size);
    }

    void run() {
        search_grid(8, 0, 1);
        if (!done() && options_.effort >= 1) search_fields();
        if (!done() && options_.effort >= 2) search_grid(32, 2, 3);
    }
    int settled() const { return settled_; }
    ListView<BarCandidate> candidates() const { return votes_.candidates(); }

private:
    bool done() const { return settled_ >= options_.enough; }

    /// Rows and columns in turn, from the middle outwards, `lines` of each to either side.
    void search_grid(int lines, int level, int breadth) {
        for (int i = 0; i < 2 * lines && !done(); ++i) {
            const int step = (i + 1) / 2 * (i % 2 == 0 ? 1 : -1);
            const int y = src_.height() / 2 + step * src_.height() / (2 * lines + 1);
            const int x = src_.width() / 2 + step * src_.width() / (2 * lines + 1);
            if (y >= 0 && y < src_.height()) scan_and_ask(row_line(y), level, breadth);
            if (done()) return;
            if (x >= 0 && x < src_.width()) scan_and_ask(column_line(x), level, breadth);
        }
    }

    void search_fields() {
        List<BarField, most_bar_fields> fields;
        if (find_bar_fields(src_, fields_scratch_, fields.view()) != Status::ok) return;
        for (int level = 1; level <= options_.effort; ++level) {
            for (const BarField& field : fields) {
                for (int breadth = 1; breadth <= 5 && !done(); breadth += 4) {
                    search_field(field, level, minimum(breadth, field.height / 4 | 1));
                }
                if (done()) return;
            }
        }
    }

    void search_field(const BarField& field, int level, int breadth) {
        constexpr int lines = 6;
        const UnitVector along = unit_vector(field.across);
        const auto at = [&](std::int64_t u, std::int64_t v) {  // in 1/256 px
            return SubPixelPoint{
                SubPixel::from_raw(static_cast<std::int32_t>(
                    field.centre.x.raw() + ((u * along.x.raw() - v * along.y.raw()) >> 30))),
                SubPixel::from_raw(static_cast<std::int32_t>(
                    field.centre.y.raw() + ((u * along.y.raw() + v * along.x.raw()) >> 30)))};
        };
        const std::int64_t half = std::int64_t{field.length} * 128;
        for (int i = 0; i < 2 * lines + 1 && !done(); ++i) {
            const int step = (i + 1) / 2 * (i % 2 == 0 ? 1 : -1);
            const std::int64_t v = std::int64_t{field.height} * 256 * step / (2 * lines + 1);
            scan_and_ask(bar_line_through(src_.size(), at(-half, v), at(half, v), 6), level, breadth);
        }
    }

    BarLine row_line(int y) const {
        return {{FinePixel(), FinePixel::from_int(y)}, {FinePixel::from_int(1), FinePixel()}, src_.width()};
    }
    BarLine column_line(int x) const {
        return {{FinePixel::from_int(x), FinePixel()}, {FinePixel(), FinePixel::from_int(1)}, src_.height()};
    }

    /// Scans a line, and the neighbours of what it reads: as it was read first, then with all means.
    void scan_and_ask(const BarLine& line, int level, int breadth) {
        fresh_ = -1;
        scan(line, level, breadth);
        if (fresh_ < 0 || done()) return;
        const int which = fresh_;
        const BarSpan span = fresh_span_;
        ask_neighbours(which, span, level, breadth, 0);
        if (options_.effort < 2) return;
        for (int wide = 1; wide <= 5 && !candidates_[which].settled; wide += 2) {
            ask_neighbours(which, span, 2, wide, wide);
        }
    }
    /// Sixteen lines to both sides of a span; shift moves them, in 1/8 of their distance.
    void ask_neighbours(int which, const BarSpan& span, int level, int breadth, int shift) {
        const std::int64_t x = std::int64_t{span.to.x.raw()} - span.from.x.raw();
        const std::int64_t y = std::int64_t{span.to.y.raw()} - span.from.y.raw();
        const std::int64_t length = maximum<std::int64_t>(hypotenuse(x, y), 256);
        const std::int64_t pace = maximum<std::int64_t>(512, length / 64);
        for (int i = 0; i < 16 && !candidates_[which].settled; ++i) {
            const std::int64_t away = pace * (i / 2 + 1) * (i % 2 == 0 ? 1 : -1) + pace * shift / 8;
            const auto moved = [&](SubPixelPoint p) {
                p.x += SubPixel::from_raw(static_cast<std::int32_t>(-y * away / length));
                p.y += SubPixel::from_raw(static_cast<std::int32_t>(x * away / length));
                return p;
            };
            scan(bar_line_through(src_.size(), moved(span.from), moved(span.to), 4), level, breadth);
        }
    }

    void scan(const BarLine& line, int level, int breadth) {
        constexpr BarSight sights[] = {{4, BarEdgeRule::steepest, 0},  {4, BarEdgeRule::halfway, 0},
                                       {4, BarEdgeRule::level, 0},     {10, BarEdgeRule::level, 0},
                                       {10, BarEdgeRule::steepest, 0}, {6, BarEdgeRule::halfway, 0},
                                       {5, BarEdgeRule::halfway, 1},   {5, BarEdgeRule::level, 1},
                                       {5, BarEdgeRule::halfway, 2},   {5, BarEdgeRule::level, 2}};
        constexpr int counts[] = {2, 3, 10};
        if (line.samples < fewest_bar_edges) return;
        const Span<std::int16_t> plain = profile_.first(line.samples);
        sample_bar_line(src_, line, breadth, plain);
        Span<std::int16_t> profile = plain;
        int share = 0;
        int sharpness = 0;
        int turns = 0;
        for (int i = 0; i < counts[level]; ++i) {
            const BarSight sight = sights[i];
            if (sight.sharpness != sharpness) {
                profile = sharp_profile_.first(line.samples);
                sharpen_bar_profile(plain, sight.sharpness, profile);
                share = 0;
            }
            sharpness = sight.sharpness;
            if (sight.share != share) turns = find_bar_turns(profile, sight.share, ranges_, turns_);
            share = sight.share;
            if (turns < fewest_bar_edges) continue;
            const int count = find_bar_edges(profile, turns_.first(turns), sight.rule, edges_[0]);
            if (read(line, {edges_[0].data(), count}, level)) return;
        }
    }

    /// Reads edges in both directions, and with colours exchanged where nothing was found.
    bool read(const BarLine& line, BarEdges edges, int level) {
        bool found = read_both_ways(line, edges, false);
        if (found || level == 0) return found;
        const int count = invert_bar_edges(edges, edges_[2]);
        return read_both_ways(line, {edges_[2].data(), count}, true);
    }
    bool read_both_ways(const BarLine& line, BarEdges edges, bool inverted) {
        bool found = read_one_way(line, edges, false, 0, inverted);
        const std::int32_t end = edges[edges.size() - 1];
        const int count = reverse_bar_edges(edges, edges_[1]);
        found = read_one_way(line, {edges_[1].data(), count}, true, end, inverted) || found;
        return found;
    }
    bool read_one_way(const BarLine& line, BarEdges edges, bool reversed, std::int32_t end, bool inverted) {
        BarReading reading;
        bool found = false;
        for (int first = 0; decode_bars(edges, first, options_.rules, reading) == Status::ok;) {
            found = true;
            first = reading.last;
            const auto place = [&](int edge) {
                return point_of(line, reversed ? end - edges[edge] : edges[edge]);
            };
            vote(reading, {place(reading.first), place(reading.last)}, inverted);
        }
        return found;
    }
    void vote(const BarReading& reading, const BarSpan& span, bool inverted) {
        int which = -1;
        if (votes_.take(reading, span, inverted, which) != BarVote::counted) return;
        BarCandidate& candidate = candidates_[which];
        if (candidate.settled) return;
        if (votes_.is_certain(which) && candidate.lines >= options_.agreeing_lines) {
            candidate.settled = true;
            ++settled_;
            return;
        }
        fresh_ = which;
        fresh_span_ = span;
    }

    ImageView<const Gray8> src_;
    const BarOptions& options_;
    Span<std::int16_t> profile_;
    Span<std::int16_t> sharp_profile_;
    Span<std::int16_t> ranges_;
    Span<BarTurn> turns_;
    Span<std::int32_t> edges_[3];  ///< forward, backward, inverted
    Span<BarCandidate> candidates_;
    Span<std::uint8_t> fields_scratch_;
    int candidate_count_ = 0;
    BarVotes votes_;
    int settled_ = 0;
    int fresh_ = -1;  ///< the candidate that the last line voted for
    BarSpan fresh_span_;
};

/// The code of a candidate.
inline Code code_of(const BarCandidate& candidate) {
    Code code;
    code.symbology = candidate.reading.symbology;
    code.aim_digit = candidate.reading.aim_digit;
    code.text_size = candidate.reading.size;
    // Offsets grow to the right of the direction of reading: downwards as one reads.
    code.corners[0] = candidate.lowest.from;
    code.corners[1] = candidate.lowest.to;
    code.corners[2] = candidate.highest.to;
    code.corners[3] = candidate.highest.from;
    code.agreeing_lines = candidate.lines;
    code.inverted = candidate.inverted;
    return code;
}

}  // namespace detail

constexpr std::int64_t read_bars_scratch(Size size) { return detail::BarSearch::scratch_bytes(size); }

inline Status read_bars(ImageView<const Gray8> src, const BarOptions& options, Span<std::uint8_t> scratch,
                        CodeText& text, ListView<Code> codes) {
    if (src.empty()) return Status::empty_image;
    if (options.enough < 1 || options.effort < 0 || options.effort > 2 || options.agreeing_lines < 1 ||
        options.agreeing_lines > BarCandidate::most_offsets) {
        return Status::bad_argument;
    }
    if (scratch.size() < read_bars_scratch(src.size())) return Status::scratch_too_small;
    detail::BarSearch search(src, options, scratch);
    search.run();
    bool doubtful = false;
    for (const BarCandidate& candidate : search.candidates()) {
        if (!candidate.settled) {
            doubtful = true;
            continue;
        }
        Code code = detail::code_of(candidate);
        code.text_first = text.size();
        for (int i = 0; i < candidate.reading.size; ++i) {
            if (text.push(candidate.reading.text[i]) != Status::ok) {
                text.shrink(code.text_first);
                return Status::buffer_too_small;
            }
        }
        if (codes.push(code) != Status::ok) {
            text.shrink(code.text_first);
            return Status::capacity_exceeded;
        }
    }
    if (search.settled() > 0) return Status::ok;
    return doubtful ? Status::undecided : Status::not_found;
}

}  // namespace fovea
