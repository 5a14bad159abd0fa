// SPDX-License-Identifier: MIT
//
// EAN and UPC codes of an image out of focus: profiles across fields of parallel edges, each fitted by the
// picture of blurred letters, and believed when they agree. Book ch. 5.
#pragma once

#include <cstdint>
#include <initializer_list>

#include <fovea/base/arena.hpp>
#include <fovea/base/list.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/code/bar_fields.hpp>
#include <fovea/code/bar_line.hpp>
#include <fovea/code/blurred_ean.hpp>
#include <fovea/code/blurred_votes.hpp>
#include <fovea/code/code.hpp>
#include <fovea/code/profile_spans.hpp>
#include <fovea/code/symbology.hpp>
#include <fovea/image/image_view.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Scenes that are looked at, of 64 samples each, whatever the size of the image. Photos take 500, and 8500
/// at most.
inline constexpr int blurred_work = 9000;

/// Scratch bytes that read_blurred_bars() needs.
constexpr std::int64_t read_blurred_bars_scratch(Size size);

/// Reads EAN-13, UPC-A and EAN-8 codes that are too blurred for read_bars().
///
/// Shapes   any; modules of 1 to 12 px, blur of at most 3.5 modules to each side, dark bars between quiet
///          zones
/// Time     bounded: at most 4 fields of 9 profiles, 6 stretches of each, and blurred_work; what is read with
///          it is told
/// Scratch  read_blurred_bars_scratch(src.size()) bytes, undefined afterwards
/// Errors   empty_image; bad_argument for most_codes below 1; scratch_too_small; not_found; buffer_too_small
///          and capacity_exceeded with the codes that had room. Text and codes are appended to
/// Source   see read_blurred_ean()
inline Status read_blurred_bars(ImageView<const Gray8> src, SymbologySet symbologies, int most_codes,
                                Span<std::uint8_t> scratch, CodeText& text, ListView<Code> codes);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

inline constexpr int most_blurred_fields = 4;
inline constexpr int blurred_lines = 9;    ///< across a field
inline constexpr int blurred_misses = 5;   ///< lines without any reading after which a field is left
inline constexpr int blurred_breadth = 5;  ///< rows of which a profile is the mean

class BlurredSearch {
public:
    BlurredSearch(ImageView<const Gray8> src, SymbologySet symbologies, Span<std::uint8_t> scratch)
        : src_(src), symbologies_(symbologies) {
        Arena arena(scratch);
        samples_ = arena.take_unset<std::int16_t>(most_samples(src.size()));
        profile_ = arena.take_unset<std::uint16_t>(most_samples(src.size()));
        reader_ = arena.take_unset<BlurredEanScratch>(1).data();
        fields_scratch_ = arena.take_unset<std::uint8_t>(bar_fields_scratch(src.size()));
    }
    static constexpr std::int64_t most_samples(Size size) { return std::int64_t{size.width} + size.height; }
    static constexpr std::int64_t scratch_bytes(Size size) {
        return arena_bytes<std::int16_t>(most_samples(size)) +
               arena_bytes<std::uint16_t>(most_samples(size)) + arena_bytes<BlurredEanScratch>(1) +
               bar_fields_scratch(size);
    }

    /// The fields of the image, the weightiest first.
    void find_fields() {
        // not_found leaves none, and of more than there is room for the weightiest are kept.
        static_cast<void>(find_bar_fields(src_, fields_scratch_, fields_.view()));
    }
    int fields() const { return fields_.size(); }

    /// Reads the code of a field; not_found if no digits are certain.
    Status read_field(int index, BlurredEan& ean, Code& code) {
        BlurredVotes votes;
        Seen first;
        Seen last;
        int misses = 0;
        for (int i = 0; i < blurred_lines && misses < blurred_misses && !votes.decided() && !spent(); ++i) {
            // From the middle outwards.
            const int offset = (i + 1) / 2 * (i % 2 == 0 ? 1 : -1);
            BlurredEan reading;
            BarLine line;
            if (!read_line(fields_[index], offset, reading, line)) {
                ++misses;
                continue;
            }
            if (votes.take(reading) == 0) continue;
            const Seen seen{point_of(line, (reading.start.raw() + 128) >> 8),
                            point_of(line, (reading.end.raw() + 128) >> 8), offset};
            if (votes.votes() == 1 || (seen.offset < first.offset)) first = seen;
            if (votes.votes() == 1 || (seen.offset > last.offset)) last = seen;
        }
        if (!votes.decided()) return Status::not_found;
        ean = votes.best();
        code.agreeing_lines = votes.votes();
        // Offsets grow to the left of reading where a code is read against the line.
        const bool turned = ean.reversed;
        const Seen& above = turned ? last : first;
        const Seen& below = turned ? first : last;
        code.corners[0] = above.from;
        code.corners[1] = above.to;
        code.corners[2] = below.to;
        code.corners[3] = below.from;
        return Status::ok;
    }

    /// The best reading of the stretches around the middle of a profile; false if there is none.
    bool read_profile(Span<const std::uint16_t> profile, int middle, BlurredEan& best) {
        List<ProfileSpan, 6> spans;
        // capacity_exceeded keeps the widest.
        if (find_profile_spans(profile, middle, spans.view()) == Status::not_found) return false;
        bool found = false;
        for (const ProfileSpan& span : spans) {
            for (const Symbology symbology : {Symbology::ean_13, Symbology::ean_8}) {
                if (!wanted(symbology)) continue;
                if (spent()) return found;
                const Result<BlurredEan> reading =
                    detail::read_blurred_ean(profile, span, symbology, *reader_, work_);
                if (!reading || (found && !is_clearer_reading(*reading, best))) continue;
                best = *reading;
                found = true;
                if (is_clear_reading(best)) return true;
            }
        }
        return found;
    }

private:
    /// Where a line saw a code, in the direction of reading.
    struct Seen {
        SubPixelPoint from;
        SubPixelPoint to;
        int offset = 0;
    };

    bool read_line(const BarField& field, int offset, BlurredEan& best, BarLine& line) {
        const UnitVector along = unit_vector(field.across);
        const auto at = [&](std::int64_t u, std::int64_t v) {  // 1/256 px along and across
            return SubPixelPoint{
                SubPixel::from_raw(static_cast<std::int32_t>(
                    field.centre.x.raw() + ((u * along.x.raw() - v * along.y.raw()) >> 30))),
                SubPixel::from_raw(static_cast<std::int32_t>(
                    field.centre.y.raw() + ((u * along.y.raw() + v * along.x.raw()) >> 30)))};
        };
        const std::int64_t half = std::int64_t{field.length} * 128;
        const std::int64_t away = std::int64_t{field.height} * 256 * offset / (blurred_lines + 1);
        const SubPixelPoint from = at(-half, away);
        // Six sixteenths beyond both ends: a field of blocks ends where edges end, the quiet zones lie
        // outside.
        line = bar_line_through(src_.size(), from, at(half, away), 6);
        if (line.samples < 64) return false;
        sample_bar_line(src_, line, blurred_breadth, samples_.first(line.samples));
        for (int i = 0; i < line.samples; ++i) profile_[i] = static_cast<std::uint16_t>(samples_[i] * 16);
        return read_profile(profile_.first(line.samples), middle_of(line, at(0, away)), best);
    }
    static int middle_of(const BarLine& line, SubPixelPoint centre) {
        const std::int64_t x = std::int64_t{centre.x.raw()} * 256 - line.from.x.raw();
        const std::int64_t y = std::int64_t{centre.y.raw()} * 256 - line.from.y.raw();
        const std::int64_t place = (x * line.step.x.raw() + y * line.step.y.raw()) >> 32;
        return static_cast<int>(clamp<std::int64_t>(place, 0, line.samples - 1));
    }
    bool spent() const { return work_ >= blurred_work; }
    bool wanted(Symbology symbology) const {
        return symbologies_.contains(symbology) ||
               (symbology == Symbology::ean_13 && symbologies_.contains(Symbology::upc_a));
    }

    ImageView<const Gray8> src_;
    SymbologySet symbologies_;
    Span<std::int16_t> samples_;
    Span<std::uint16_t> profile_;
    BlurredEanScratch* reader_ = nullptr;
    Span<std::uint8_t> fields_scratch_;
    List<BarField, most_blurred_fields> fields_;
    int work_ = 0;
};

/// Writes a reading as a code: an EAN-13 that begins with 0 is a UPC-A, where that is wanted.
inline Status tell_blurred(const BlurredEan& ean, SymbologySet symbologies, Code& code, CodeText& text) {
    const bool upc_a =
        ean.symbology == Symbology::ean_13 && ean.digits[0] == 0 && symbologies.contains(Symbology::upc_a);
    code.symbology = upc_a ? Symbology::upc_a : ean.symbology;
    code.aim_digit = ean.symbology == Symbology::ean_8 ? '4' : '0';
    code.text_first = text.size();
    for (int i = upc_a ? 1 : 0; i < ean.digit_count; ++i) {
        if (Status s = text.push(static_cast<std::uint8_t>('0' + ean.digits[i])); s != Status::ok) {
            text.shrink(code.text_first);
            return s;
        }
    }
    code.text_size = text.size() - code.text_first;
    return Status::ok;
}

}  // namespace detail

constexpr std::int64_t read_blurred_bars_scratch(Size size) {
    return detail::BlurredSearch::scratch_bytes(size);
}

inline Status read_blurred_bars(ImageView<const Gray8> src, SymbologySet symbologies, int most_codes,
                                Span<std::uint8_t> scratch, CodeText& text, ListView<Code> codes) {
    if (src.empty()) return Status::empty_image;
    if (most_codes < 1) return Status::bad_argument;
    if (scratch.size() < read_blurred_bars_scratch(src.size())) return Status::scratch_too_small;
    detail::BlurredSearch search(src, symbologies, scratch);
    search.find_fields();
    int read = 0;
    for (int i = 0; i < search.fields() && read < most_codes; ++i) {
        BlurredEan ean;
        Code code;
        if (search.read_field(i, ean, code) != Status::ok) continue;
        // An EAN-13 with another first digit than 0 is no UPC-A.
        const bool only_upc = !symbologies.contains(Symbology::ean_13) && ean.symbology == Symbology::ean_13;
        if (only_upc && ean.digits[0] != 0) continue;
        if (Status s = detail::tell_blurred(ean, symbologies, code, text); s != Status::ok) return s;
        if (Status s = codes.push(code); s != Status::ok) {
            text.shrink(code.text_first);
            return s;
        }
        ++read;
    }
    return read > 0 ? Status::ok : Status::not_found;
}

}  // namespace fovea
