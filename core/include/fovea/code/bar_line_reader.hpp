// SPDX-License-Identifier: MIT
//
// One scan line from brightness to votes: every way to see its edges, both directions, both polarities.
#pragma once

#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/base/list.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/code/bar_edges.hpp>
#include <fovea/code/bar_line.hpp>
#include <fovea/code/bar_reading.hpp>
#include <fovea/code/bar_votes.hpp>
#include <fovea/code/code.hpp>
#include <fovea/code/decode_bars.hpp>
#include <fovea/code/work_budget.hpp>

namespace fovea {

namespace detail {

/// A way to see the edges of a line.
struct BarSight {
    int share;
    BarEdgeRule rule;
    int sharpness;
};
/// The likely ones first. Each was the only one to read some photograph or rendered code.
inline constexpr BarSight bar_sights[] = {{4, BarEdgeRule::steepest, 0},  {4, BarEdgeRule::halfway, 0},
                                          {4, BarEdgeRule::level, 0},     {10, BarEdgeRule::level, 0},
                                          {10, BarEdgeRule::steepest, 0}, {6, BarEdgeRule::halfway, 0},
                                          {5, BarEdgeRule::halfway, 1},   {5, BarEdgeRule::level, 1},
                                          {5, BarEdgeRule::halfway, 2},   {5, BarEdgeRule::level, 2}};
/// How many of them are tried at each level of effort; the sharpened ones only at the last.
inline constexpr int bar_sight_counts[] = {2, 3, 10};

/// Memory for a line of so many samples and for what is voted for.
class BarLineReader {
public:
    BarLineReader(const BarRules& rules, int agreeing_lines, Arena& arena, std::int64_t samples,
                  int most_codes)
        : rules_(rules), agreeing_lines_(agreeing_lines) {
        if (samples == 0) return;
        profile_ = arena.take_unset<std::int16_t>(samples);
        ranges_ = arena.take_unset<std::int16_t>(bar_ranges(samples));
        turns_ = arena.take_unset<BarTurn>(samples);
        edges_ = arena.take_unset<std::int32_t>(samples + 4);
        reversed_ = arena.take_unset<std::int32_t>(samples + 5);
        candidates_ = arena.take<BarCandidate>(most_codes);
    }
    static constexpr std::int64_t scratch_bytes(std::int64_t samples, int most_codes) {
        return arena_bytes<std::int16_t>(samples) + arena_bytes<std::int16_t>(bar_ranges(samples)) +
               arena_bytes<BarTurn>(samples) + arena_bytes<std::int32_t>(samples + 4) +
               arena_bytes<std::int32_t>(samples + 5) + arena_bytes<BarCandidate>(most_codes);
    }

    /// Without it every line is read; with it no more lines once it is spent, of a unit a sample and eight an
    /// edge for each way to see them.
    void limit(const WorkBudget& budget) {
        budget_ = budget;
        limited_ = true;
    }
    bool spent() const { return limited_ && budget_.spent(); }

    /// Where the brightness of the next line goes.
    Span<std::int16_t> profile(int samples) const { return profile_.first(samples); }

    /// Memory in which nothing is kept from line to line, apart from the profile.
    Span<std::uint8_t> idle() const {
        return {reinterpret_cast<std::uint8_t*>(turns_.data()),
                turns_.size() * static_cast<std::ptrdiff_t>(sizeof(BarTurn))};
    }

    /// Reads a line whose profile was set. sharp, as long as the profile, is needed at level 2 only. The
    /// sights before first_sight are left out: nothing was seen with them before.
    void read(const BarLine& line, int level, Span<std::int16_t> sharp, int first_sight = 0) {
        if (line.samples < fewest_bar_edges || spent()) return;
        const Span<std::int16_t> plain = profile(line.samples);
        Span<std::int16_t> profile = plain;
        int share = 0;
        int sharpness = 0;
        int turns = 0;
        std::int32_t contrast = find_bar_ranges(plain, ranges_);
        for (int i = first_sight; i < bar_sight_counts[level]; ++i) {
            const BarSight sight = bar_sights[i];
            if (sight.sharpness != sharpness) {
                profile = sharp.first(line.samples);
                sharpen_bar_profile(plain, sight.sharpness, profile);
                contrast = find_bar_ranges(profile, ranges_);
                share = 0;
            }
            sharpness = sight.sharpness;
            budget_.spend(line.samples);
            if (sight.share != share)
                turns = find_turns_in_ranges(profile, sight.share, ranges_, contrast, turns_);
            share = sight.share;
            if (turns < fewest_bar_edges) continue;
            int count = find_bar_edges(profile, turns_.first(turns), sight.rule, edges_);
            if (read_both_ways(line, count, false)) return;
            if (level == 0) continue;
            count = invert_bar_edges(edges_, count);
            if (read_both_ways(line, count, true)) return;
        }
    }

    /// The turning points of the profile that was set, as fine as they are looked for.
    Span<const BarTurn> turns_of(BarProfile profile) {
        return turns_.first(find_bar_turns(profile, bar_sights[3].share, ranges_, turns_));
    }

    /// Tells the codes that lines agree on. Called once, after the last line.
    void settle_rest() {
        for (int which = 0; which < candidate_count_; ++which) {
            if (!candidates_[which].settled && is_enough(which)) settle(which);
        }
    }
    int settled() const { return settled_; }
    Span<BarCandidate> candidates() const { return candidates_.first(candidate_count_); }
    /// The candidate for which the last line voted and which is not settled, with where it saw it; -1 if
    /// there is none.
    int fresh() const { return fresh_; }
    const BarSpan& fresh_span() const { return fresh_span_; }
    void forget_fresh() { fresh_ = -1; }

private:
    bool read_both_ways(const BarLine& line, int count, bool inverted) {
        const BarEdges edges(edges_.data(), count);
        budget_.spend(std::int64_t{2 * edge_work} * count);
        bool found = read_one_way(line, edges, false, 0, inverted);
        const int reversed = reverse_bar_edges(edges, reversed_);
        found = read_one_way(line, {reversed_.data(), reversed}, true, edges[count - 1], inverted) || found;
        return found;
    }
    bool read_one_way(const BarLine& line, BarEdges edges, bool reversed, std::int32_t end, bool inverted) {
        BarReading reading;
        bool found = false;
        for (int first = 0; decode_bars(edges, first, rules_, reading) == Status::ok;) {
            found = true;
            first = reading.last;
            const auto place = [&](int edge) {
                return point_of(line, reversed ? end - edges[edge] : edges[edge]);
            };
            vote(reading, {place(reading.first), place(reading.last)}, inverted);
        }
        return found;
    }
    ListView<BarCandidate> list() {
        return {candidates_.data(), static_cast<int>(candidates_.size()), &candidate_count_};
    }
    bool is_enough(int which) {
        return candidates_[which].lines >= agreeing_lines_ && BarVotes(list()).is_certain(which);
    }
    void settle(int which) {
        candidates_[which].settled = true;
        ++settled_;
    }
    void vote(const BarReading& reading, const BarSpan& span, bool inverted) {
        int which = -1;
        if (BarVotes(list()).take(reading, span, inverted, which) != BarVote::counted) return;
        const BarCandidate& candidate = candidates_[which];
        if (candidate.settled) return;
        // An add-on deserves some more lines, as not each of them reaches it.
        const bool waits = rules_.add_on == AddOn::appended && candidate.add_on_lines < 2 &&
                           candidate.lines < bar_lines_needed(candidate.reading) + 4;
        if (!waits && is_enough(which)) {
            settle(which);
            return;
        }
        fresh_ = which;
        fresh_span_ = span;
    }

    static constexpr int edge_work = 8;

    BarRules rules_;
    int agreeing_lines_;
    bool limited_ = false;
    WorkBudget budget_;
    Span<std::int16_t> profile_;
    Span<std::int16_t> ranges_;
    Span<BarTurn> turns_;
    Span<std::int32_t> edges_;
    Span<std::int32_t> reversed_;
    Span<BarCandidate> candidates_;
    int candidate_count_ = 0;
    int settled_ = 0;
    int fresh_ = -1;
    BarSpan fresh_span_;
};

/// The code of a candidate, but for its text and its grade.
inline Code code_of(const BarCandidate& candidate) {
    Code code;
    const BarReading& reading = candidate.reading;
    const bool with_add_on =
        candidate.add_on_lines >= 2 && candidate.add_on_lines >= 4 * candidate.add_on_doubts;
    code.symbology = reading.symbology;
    code.text_size = with_add_on ? reading.size : reading.base;
    code.aim_digit = with_add_on || reading.size == reading.base ? reading.aim_digit : '0';
    // Offsets grow to the right of the direction of reading: downwards as one reads.
    code.corners[0] = candidate.lowest.from;
    code.corners[1] = candidate.lowest.to;
    code.corners[2] = candidate.highest.to;
    code.corners[3] = candidate.highest.from;
    code.agreeing_lines = candidate.lines;
    code.inverted = candidate.inverted;
    return code;
}

/// Appends a code and its text. buffer_too_small or capacity_exceeded, with both as they were.
inline Status append_code(const BarCandidate& candidate, Code code, CodeText& text, ListView<Code> codes) {
    code.text_first = text.size();
    if (codes.full()) return Status::capacity_exceeded;
    for (int i = 0; i < code.text_size; ++i) {
        if (text.push(candidate.reading.text[i]) != Status::ok) {
            text.shrink(code.text_first);
            return Status::buffer_too_small;
        }
    }
    return codes.push(code);
}

}  // namespace detail

}  // namespace fovea
