// SPDX-License-Identifier: MIT
//
// Bar codes in an image, at any angle. Book ch. 5.
#pragma once

#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/base/list.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/code/bar_fields.hpp>
#include <fovea/code/bar_grade.hpp>
#include <fovea/code/bar_line.hpp>
#include <fovea/code/bar_line_reader.hpp>
#include <fovea/code/bar_reading.hpp>
#include <fovea/code/bar_votes.hpp>
#include <fovea/code/code.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

struct ReadBarsOptions {
    BarRules rules;
    int most_codes = 1;  ///< codes after which the search ends: more take longer, as the whole image is seen
    int effort = 2;      ///< 0 rows and columns, 1 and tilted lines, 2 and every way to see weak edges
    int agreeing_lines = 2;  ///< that a code needs at least; some need more, see bar_lines_needed(). 1..12
};

/// Work for each pixel of an image's width and height: samples of lines, a unit each, and edges, eight each,
/// once for every way to see them. Photos without a code take 3000, and would take 13000 at most; those that
/// are read take 9300 at most.
inline constexpr int bar_work = 10240;
/// The least of it: codes of modules of one pixel are small, and want every way to see them.
inline constexpr std::int64_t least_bar_work = std::int64_t{5} << 20;

/// Scratch bytes that read_bars() needs.
constexpr std::int64_t read_bars_scratch(Size size);

/// Reads bar codes in an image: any angle, dark on light and light on dark, from either side.
///
/// Rows and columns come first, from the middle outwards, then lines across the fields of parallel edges,
/// then all of it with other rules for what an edge is. Where a line reads a code its neighbours are asked. A
/// code is told when enough lines agree on it; codes that contradict each other at one place are not told.
///
/// Shapes  any; codes with modules of a pixel or more, and quiet zones
/// Errors  empty_image; bad_argument; scratch_too_small; not_found; undecided where lines read something on
///         which not enough of them agree; buffer_too_small, capacity_exceeded with the first codes in the
///         list. Text and list are appended to, and untouched where nothing was read
/// Time    bounded: at most about a thousand lines, and bar_work units of work for each pixel of width and
///         height, and least_bar_work for small images; what is read with these is told
inline Status read_bars(ImageView<const Gray8> src, const ReadBarsOptions& options,
                        Span<std::uint8_t> scratch, CodeText& text, ListView<Code> codes);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

inline constexpr int most_bar_candidates = 16;
inline constexpr int most_bar_fields = 12;
inline constexpr int field_lines = 13;       ///< across a field
inline constexpr int second_look_lines = 5;  ///< those of them that look_twice() takes

class BarSearch {
public:
    BarSearch(ImageView<const Gray8> src, const ReadBarsOptions& options, Span<std::uint8_t> scratch)
        : BarSearch(src, options, Arena(scratch)) {}
    static constexpr std::int64_t most_samples(Size size) { return std::int64_t{size.width} + size.height; }
    static constexpr std::int64_t scratch_bytes(Size size) {
        return BarLineReader::scratch_bytes(most_samples(size), most_bar_candidates) +
               arena_bytes<std::int16_t>(most_samples(size)) + bar_fields_scratch(size);
    }

    /// seen: effort 1 was tried before, and nothing was read on any line of it.
    void run(bool seen) {
        if (!seen) search_grid(8, 0, 1);
        if (options_.effort >= 1 && !done()) {
            // not_found leaves none, and of more than there is room for the weightiest are kept.
            static_cast<void>(find_bar_fields(src_, fields_scratch_, fields_.view()));
            if (!seen) search_fields(1);
            if (options_.effort == 1 && looks_twice() && !done()) look_twice();
        }
        if (options_.effort >= 2) {
            search_fields(2, seen && looks_twice());
            if (!done()) search_grid(32, 2, 3);
        }
        reader_.settle_rest();
    }
    int settled() const { return reader_.settled(); }
    Span<const BarCandidate> candidates() const { return reader_.candidates(); }

    /// The grade of a settled candidate, along its first line.
    CodeGrade grade(const BarCandidate& candidate) {
        const BarLine line = bar_line_through(src_.size(), candidate.span.from, candidate.span.to, 4);
        if (line.samples < fewest_bar_edges) return CodeGrade();
        const Span<std::int16_t> profile = reader_.profile(line.samples);
        sample_bar_line(src_, line, 1, profile);
        const std::int32_t from = place_on(line, candidate.span.from);
        const std::int32_t to = place_on(line, candidate.span.to);
        return grade_bars(profile, reader_.turns_of(profile), from, to, candidate.reading);
    }

private:
    BarSearch(ImageView<const Gray8> src, const ReadBarsOptions& options, Arena arena)
        : src_(src),
          options_(options),
          reader_(options.rules, options.agreeing_lines, arena, most_samples(src.size()),
                  most_bar_candidates) {
        sharp_ = arena.take_unset<std::int16_t>(most_samples(src.size()));
        fields_scratch_ = arena.take_unset<std::uint8_t>(bar_fields_scratch(src.size()));
        reader_.limit(WorkBudget(maximum(most_samples(src.size()) * bar_work, least_bar_work)));
    }
    bool done() const { return reader_.settled() >= options_.most_codes || reader_.spent(); }
    bool is_settled(int which) const { return reader_.candidates()[which].settled; }
    /// The sample of a line that lies nearest to a point of it.
    static std::int32_t place_on(const BarLine& line, SubPixelPoint point) {
        const std::int64_t x = std::int64_t{point.x.raw()} * 256 - line.from.x.raw();
        const std::int64_t y = std::int64_t{point.y.raw()} * 256 - line.from.y.raw();
        return static_cast<std::int32_t>(
            round_shift(round_shift(x * line.step.x.raw() + y * line.step.y.raw(), 16), 16));
    }

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

    /// twice: look_twice() has read nothing.
    void search_fields(int level, bool twice = false) {
        const int sight = first_sight(level);
        for (int i = 0; i < fields_.size(); ++i) {
            for (int breadth = 1; breadth <= 5 && !done(); breadth += 4) {
                const int first = twice && i == 0 && breadth == 1 ? second_look_lines : 0;
                search_field(fields_[i], level, minimum(breadth, fields_[i].height / 4 | 1), sight, first,
                             field_lines);
            }
            if (done()) return;
        }
    }
    /// Level 2 has the lines of level 1: where none of them read anything, only what is new is tried.
    int first_sight(int level) const {
        return level == 2 && reader_.candidates().empty() ? bar_sight_counts[1] : 0;
    }

    /// Where one code is looked for. With more the whole search follows in any case, and says better how high
    /// they are.
    bool looks_twice() const { return options_.most_codes == 1; }
    /// What some lines read and others did not confirm is asked for with all means, and so are some lines
    /// in the middle of the weightiest field. Of 18 photos that level 1 reads nothing from and level 2
    /// does, this reads 13.
    void look_twice() {
        const auto count = static_cast<int>(reader_.candidates().size());
        for (int which = 0; which < count && !done(); ++which) {
            const BarSpan span = reader_.candidates()[which].span;  // the lines that follow may change it
            ask_with_all_means(which, span);
        }
        if (!done() && !fields_.empty()) {
            search_field(fields_[0], 2, 1, first_sight(2), 0, second_look_lines);
        }
    }

    /// The lines first..end - 1 of a field, from its middle outwards.
    void search_field(const BarField& field, int level, int breadth, int sight, int first, int end) {
        const UnitVector along = unit_vector(field.across);
        const auto at = [&](std::int64_t u, std::int64_t v) {  // in 1/256 px
            return SubPixelPoint{
                SubPixel::from_raw(static_cast<std::int32_t>(
                    field.centre.x.raw() + ((u * along.x.raw() - v * along.y.raw()) >> 30))),
                SubPixel::from_raw(static_cast<std::int32_t>(
                    field.centre.y.raw() + ((u * along.y.raw() + v * along.x.raw()) >> 30)))};
        };
        const std::int64_t half = std::int64_t{field.length} * 128;
        for (int i = first; i < end && !done(); ++i) {
            const int step = (i + 1) / 2 * (i % 2 == 0 ? 1 : -1);
            const std::int64_t v = std::int64_t{field.height} * 256 * step / field_lines;
            scan_and_ask(bar_line_through(src_.size(), at(-half, v), at(half, v), 6), level, breadth, sight);
        }
    }

    BarLine row_line(int y) const {
        return {{FinePixel(), FinePixel::from_int(y)}, {FinePixel::from_int(1), FinePixel()}, src_.width()};
    }
    BarLine column_line(int x) const {
        return {{FinePixel::from_int(x), FinePixel()}, {FinePixel(), FinePixel::from_int(1)}, src_.height()};
    }

    /// Scans a line, and the neighbours of what it reads: as it was read first, then with all means.
    void scan_and_ask(const BarLine& line, int level, int breadth, int first_sight = 0) {
        reader_.forget_fresh();
        scan(line, level, breadth, first_sight);
        if (reader_.fresh() < 0 || done()) return;
        const int which = reader_.fresh();
        const BarSpan span = reader_.fresh_span();
        ask_neighbours(which, span, level, breadth, 0);
        if (options_.effort >= 2 || level == 2) ask_with_all_means(which, span);
    }
    void ask_with_all_means(int which, const BarSpan& span) {
        for (int wide = 1; wide <= 5 && !is_settled(which); wide += 2) {
            ask_neighbours(which, span, 2, wide, wide);
        }
    }
    /// Sixteen lines to both sides of a span; shift moves them, in 1/8 of their distance.
    void ask_neighbours(int which, const BarSpan& span, int level, int breadth, int shift) {
        const std::int64_t x = std::int64_t{span.to.x.raw()} - span.from.x.raw();
        const std::int64_t y = std::int64_t{span.to.y.raw()} - span.from.y.raw();
        const std::int64_t length = maximum<std::int64_t>(hypotenuse(x, y), 256);
        const std::int64_t pace = maximum<std::int64_t>(512, length / 64);
        // Quiet zones of a quarter; an add-on is more than half as long as its code.
        const int beyond = options_.rules.add_on == AddOn::appended ? 12 : 4;
        for (int i = 0; i < 16 && !is_settled(which); ++i) {
            const std::int64_t away = pace * (i / 2 + 1) * (i % 2 == 0 ? 1 : -1) + pace * shift / 8;
            const auto moved = [&](SubPixelPoint p) {
                p.x += SubPixel::from_raw(static_cast<std::int32_t>(-y * away / length));
                p.y += SubPixel::from_raw(static_cast<std::int32_t>(x * away / length));
                return p;
            };
            scan(bar_line_through(src_.size(), moved(span.from), moved(span.to), beyond), level, breadth);
        }
    }

    void scan(const BarLine& line, int level, int breadth, int first_sight = 0) {
        if (line.samples < fewest_bar_edges) return;
        sample_bar_line(src_, line, breadth, reader_.profile(line.samples));
        reader_.read(line, level, sharp_, first_sight);
    }

    ImageView<const Gray8> src_;
    const ReadBarsOptions& options_;
    BarLineReader reader_;
    Span<std::int16_t> sharp_;
    Span<std::uint8_t> fields_scratch_;
    List<BarField, most_bar_fields> fields_;
};

/// As read_bars(). seen: effort 1 was tried on this image with options that are the same but for that, and
/// answered not_found; what it looked at is left out.
inline Status read_bars(ImageView<const Gray8> src, const ReadBarsOptions& options, bool seen,
                        Span<std::uint8_t> scratch, CodeText& text, ListView<Code> codes) {
    if (src.empty()) return Status::empty_image;
    if (!is_valid(options.rules) || options.most_codes < 1 || options.effort < 0 || options.effort > 2 ||
        options.agreeing_lines < 1 || options.agreeing_lines > BarCandidate::most_offsets) {
        return Status::bad_argument;
    }
    if (scratch.size() < BarSearch::scratch_bytes(src.size())) return Status::scratch_too_small;
    BarSearch search(src, options, scratch);
    search.run(seen);
    bool doubtful = false;
    for (const BarCandidate& candidate : search.candidates()) {
        if (!candidate.settled) {
            doubtful = true;
            continue;
        }
        Code code = code_of(candidate);
        code.grade = search.grade(candidate);
        const Status status = append_code(candidate, code, text, codes);
        if (status != Status::ok) return status;
    }
    if (search.settled() > 0) return Status::ok;
    return doubtful ? Status::undecided : Status::not_found;
}

}  // namespace detail

constexpr std::int64_t read_bars_scratch(Size size) { return detail::BarSearch::scratch_bytes(size); }

inline Status read_bars(ImageView<const Gray8> src, const ReadBarsOptions& options,
                        Span<std::uint8_t> scratch, CodeText& text, ListView<Code> codes) {
    return detail::read_bars(src, options, false, scratch, text, codes);
}

}  // namespace fovea
