// SPDX-License-Identifier: MIT
//
// Votes of scan lines: a code is read when enough of them say the same, and none of weight says otherwise.
#pragma once

#include <cstdint>

#include <fovea/base/list.hpp>
#include <fovea/base/span.hpp>
#include <fovea/code/bar_reading.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Where along a line a code begins and ends, in the direction in which it reads.
struct BarSpan {
    SubPixelPoint from;
    SubPixelPoint to;
};

/// A code for which lines have voted.
struct BarCandidate {
    static constexpr int most_offsets = 12;

    BarReading reading;  ///< the one with the smallest error
    BarSpan span;        ///< of its first line
    BarSpan lowest;      ///< of the line farthest to one side
    BarSpan highest;     ///< and to the other
    std::int32_t lowest_offset = 0;
    std::int32_t highest_offset = 0;
    std::int32_t offsets[most_offsets] = {};  ///< of the lines that voted from the first one, in 1/256 px
    int lines = 0;
    int add_on_lines = 0;   ///< those of them that saw an add-on
    int add_on_doubts = 0;  ///< those that saw another one
    bool inverted = false;
    bool settled = false;  ///< told already: the lines that follow only complete it
};

/// What became of a vote.
enum class BarVote : std::uint8_t {
    counted,
    repeated,  ///< a line as near to one that voted already says nothing new
    ignored,   ///< against a settled code, or there is no room
};

class BarVotes {
public:
    /// Codes that are kept in mind at a time.
    explicit constexpr BarVotes(ListView<BarCandidate> candidates) : candidates_(candidates) {}

    inline BarVote take(const BarReading& reading, const BarSpan& span, bool inverted, int& which);
    /// True if the candidate has the lines that it needs, and four times as many as speak against it.
    inline bool is_certain(int which) const;
    constexpr ListView<BarCandidate> candidates() const { return candidates_; }

private:
    ListView<BarCandidate> candidates_;
};

/// Lines that must agree before a code is told. Few digits and no check character need more of them, and so
/// do a poor fit and a narrow quiet zone.
constexpr int bar_lines_needed(const BarReading& reading);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Of lines that are nearer than this each sees what the other sees: 1.25 px.
inline constexpr std::int32_t nearest_bar_lines = 320;

struct BarOffset {
    std::int64_t along = 0;   ///< from the middle of one span to that of another, along the first
    std::int64_t across = 0;  ///< and across it
    std::int64_t length = 0;  ///< of the first
};
constexpr BarOffset bar_offset(const BarSpan& from, const BarSpan& to) {
    const std::int64_t x = std::int64_t{from.to.x.raw()} - from.from.x.raw();
    const std::int64_t y = std::int64_t{from.to.y.raw()} - from.from.y.raw();
    BarOffset offset;
    offset.length = maximum<std::int64_t>(hypotenuse(x, y), 1);
    const std::int64_t to_x =
        (std::int64_t{to.from.x.raw()} + to.to.x.raw() - from.from.x.raw() - from.to.x.raw()) / 2;
    const std::int64_t to_y =
        (std::int64_t{to.from.y.raw()} + to.to.y.raw() - from.from.y.raw() - from.to.y.raw()) / 2;
    offset.along = (to_x * x + to_y * y) / offset.length;
    offset.across = (to_y * x - to_x * y) / offset.length;
    return offset;
}

/// True if a span lies where a candidate's lines are, or beside them by 1/reach of its length at most.
constexpr bool is_same_place(const BarCandidate& candidate, const BarSpan& span, int reach) {
    const BarOffset offset = bar_offset(candidate.span, span);
    const std::int64_t along = offset.along < 0 ? -offset.along : offset.along;
    const std::int64_t beside = offset.length / reach;
    return along * 2 < offset.length && offset.across > candidate.lowest_offset - beside &&
           offset.across < candidate.highest_offset + beside;
}
/// Lines of the same text are of one code as far as its length apart; other texts may be those of another
/// code above or below.
inline constexpr int same_text_reach = 1;
inline constexpr int other_text_reach = 4;

constexpr bool same_text(const BarReading& a, const BarReading& b) {
    if (a.symbology != b.symbology || a.base != b.base) return false;
    for (int i = 0; i < a.base; ++i)
        if (a.text[i] != b.text[i]) return false;
    return true;
}

/// Adds what a further line saw of an add-on.
constexpr void vote_for_add_on(BarCandidate& candidate, const BarReading& reading) {
    if (reading.size == reading.base) return;
    BarReading& best = candidate.reading;
    if (candidate.add_on_lines == 0) {
        best.size = reading.size;
        for (int i = reading.base; i < reading.size; ++i) best.text[i] = reading.text[i];
        best.aim_digit = reading.aim_digit;
    }
    bool same = best.size == reading.size;
    for (int i = reading.base; same && i < reading.size; ++i) same = best.text[i] == reading.text[i];
    (same ? candidate.add_on_lines : candidate.add_on_doubts) += 1;
}

}  // namespace detail

constexpr int bar_lines_needed(const BarReading& reading) {
    int lines = 3;
    const bool strong = reading.symbology == Symbology::ean_13 || reading.symbology == Symbology::upc_a ||
                        (reading.symbology == Symbology::code_128 && reading.size >= 4);
    if (strong) lines = 2;
    // A tenth of a module is what a sharp picture with modules of two pixels gives.
    if (reading.error > 28) ++lines;
    if (reading.quiet < 110) ++lines;
    return lines;
}

inline BarVote BarVotes::take(const BarReading& reading, const BarSpan& span, bool inverted, int& which) {
    for (int i = 0; i < candidates_.size(); ++i) {
        BarCandidate& known = candidates_[i];
        if (!detail::same_text(known.reading, reading)) {
            if (known.settled && detail::is_same_place(known, span, detail::other_text_reach)) {
                return BarVote::ignored;
            }
            continue;
        }
        if (!detail::is_same_place(known, span, detail::same_text_reach)) continue;
        which = i;
        const auto offset = static_cast<std::int32_t>(detail::bar_offset(known.span, span).across);
        for (int k = 0; k < minimum(known.lines, BarCandidate::most_offsets); ++k) {
            const std::int32_t distance = offset - known.offsets[k];
            if (distance < detail::nearest_bar_lines && -distance < detail::nearest_bar_lines) {
                return BarVote::repeated;
            }
        }
        if (known.lines < BarCandidate::most_offsets) known.offsets[known.lines] = offset;
        ++known.lines;
        if (offset < known.lowest_offset) {
            known.lowest_offset = offset;
            known.lowest = span;
        }
        if (offset > known.highest_offset) {
            known.highest_offset = offset;
            known.highest = span;
        }
        detail::vote_for_add_on(known, reading);
        known.reading.error = minimum(known.reading.error, reading.error);
        known.reading.quiet = maximum(known.reading.quiet, reading.quiet);
        return BarVote::counted;
    }
    BarCandidate* fresh = candidates_.append();
    if (fresh == nullptr) return BarVote::ignored;
    *fresh = BarCandidate();
    fresh->reading = reading;
    fresh->span = fresh->lowest = fresh->highest = span;
    fresh->lines = 1;
    fresh->add_on_lines = reading.size > reading.base ? 1 : 0;
    fresh->inverted = inverted;
    which = candidates_.size() - 1;
    return BarVote::counted;
}

inline bool BarVotes::is_certain(int which) const {
    const BarCandidate& candidate = candidates_[which];
    int against = 0;
    for (int i = 0; i < candidates_.size(); ++i) {
        if (i != which && detail::is_same_place(candidates_[i], candidate.span, detail::other_text_reach))
            against += candidates_[i].lines;
    }
    if (candidate.lines < bar_lines_needed(candidate.reading) + 3 * against) return false;
    const BarReading& reading = candidate.reading;
    const bool part_of_more = reading.symbology == Symbology::interleaved_2_of_5 ||
                              (reading.symbology == Symbology::upc_e && reading.text[0] == '1');
    if (!part_of_more) return true;
    // A slanted line that enters through the side of a code reads the rest of it, and where a slanted edge
    // covers the right half of an EAN-13 some lines see a UPC-E of number system 1. Where lines an eighth of
    // the length apart read the same, they came in by the front.
    const std::int64_t spread = std::int64_t{candidate.highest_offset} - candidate.lowest_offset;
    return spread * 8 >= detail::bar_offset(candidate.span, candidate.span).length;
}

}  // namespace fovea
