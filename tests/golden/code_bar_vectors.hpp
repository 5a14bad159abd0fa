// SPDX-License-Identifier: MIT
//
// Golden vectors of the bar codes in code/.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/base/random.hpp>
#include <fovea/code/bar_stream.hpp>
#include <fovea/code/code_128_encoder.hpp>
#include <fovea/code/read_bars.hpp>
#include <fovea/code/two_width_encoder.hpp>
#include <golden/code_qr_vectors.hpp>
#include <golden/digest.hpp>
#include <golden/workspace.hpp>

namespace fovea::golden {

inline void put(Digest& digest, SymbologySet set) {
    for (int i = 0; i < symbology_count; ++i) digest.add(set.contains(static_cast<Symbology>(i)));
}
inline void put(Digest& digest, const BarReading& reading) {
    digest.add(reading.symbology, reading.aim_digit, reading.first, reading.last, reading.error);
    digest.add(reading.quiet, reading.base, Span<const std::uint8_t>(reading.text, reading.size));
}
inline void put(Digest& digest, const BarTurn& turn) { digest.add(turn.place, turn.level); }
inline void put(Digest& digest, const BarLine& line) { digest.add(line.from, line.step, line.samples); }
inline void put(Digest& digest, const BarSpan& span) { digest.add(span.from, span.to); }
inline void put(Digest& digest, const BarCandidate& candidate) {
    digest.add(candidate.reading, candidate.span, candidate.lowest, candidate.highest, candidate.lines);
}
inline void put(Digest& digest, const BarField& field) {
    digest.add(field.centre, field.across, field.length, field.height, field.weight);
}
inline void put(Digest& digest, const TwoWidths& widths) {
    digest.add(widths.wide, widths.narrow, widths.error);
}
inline void put_bar_code(Digest& digest, const Code& code) {
    digest.add(code.symbology, aim_letter(code.symbology), code.aim_digit, code.text_first, code.text_size);
    for (const SubPixelPoint corner : code.corners) digest.add(corner);
    digest.add(code.agreeing_lines, code.inverted, code.grade);
}

// ---- what is drawn ------------------------------------------------------------------------

inline constexpr int bar_kinds = 10;

/// The bars of one of the texts, of every symbology.
inline Status encode_sample(int kind, BarWidths widths) {
    static constexpr char texts[bar_kinds][20] = {
        "9780905705712",    "55123457", "023942431015", "01234565", "1123453",
        "Fovea 26\x1d\x01", "LOT-42",   "307123450010", "31117",    "a~B"};
    std::uint8_t bytes[20] = {};
    int size = 0;
    while (texts[kind][size] != 0) {
        bytes[size] = static_cast<std::uint8_t>(texts[kind][size]);
        ++size;
    }
    const Span<const std::uint8_t> text(bytes, size);
    TwoWidthOptions two;
    two.wide = 2 + kind % 2;
    two.with_check = kind > 7;
    switch (kind) {
        case 0: return encode_ean_13(text, widths);
        case 1: return encode_ean_8(text, widths);
        case 2: return encode_upc_a(text, widths);
        case 3:
        case 4: return encode_upc_e(text, widths);
        case 5: return encode_code_128(text, Code128Kind::gs1, widths);
        case 6: return encode_code_39(text, Code39Text::plain, two, widths);
        case 7: return encode_interleaved(text, two, widths);
        case 8: return encode_codabar(text, two, widths);
        default: return encode_code_39(text, Code39Text::full_ascii, two, widths);
    }
}

/// The edges of bars, each moved by up to `noise` / 256 px, with quiet zones of twelve modules.
inline int edges_of_bars(BarWidths widths, int module, int noise, Random& random, Span<std::int32_t> edges) {
    int count = 0;
    std::int32_t at = 12 * module;
    edges[count++] = 0;
    edges[count++] = at;
    for (const std::uint8_t width : widths) {
        at += width * module;
        edges[count++] = at + random.between(-noise, noise);
    }
    edges[count++] = at + 12 * module;
    return count;
}

/// Draws edges as rows, each moved to the right by slant / 256 px against the one above, with noise.
inline void draw_edges(ImageView<Gray8> image, BarEdges edges, int slant, Random& random) {
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) {
            const std::int32_t left = x * 256 - y * slant;
            std::int32_t dark = 0;
            for (std::ptrdiff_t i = 1; i + 1 < edges.size(); i += 2) {
                const std::int32_t from = maximum(edges[i], left);
                const std::int32_t to = minimum(edges[i + 1], left + 256);
                dark += maximum<std::int32_t>(to - from, 0);
            }
            image(x, y) = static_cast<Gray8>(190 - (dark * 130 >> 8) + random.between(-6, 6));
        }
}

// ---- vectors ------------------------------------------------------------------------------

inline void code_bar_tables(Workspace&, Digest& digest) {
    const std::uint8_t upc_e[10][8] = {{0, 1, 2, 3, 4, 5, 0}, {0, 1, 2, 3, 4, 5, 1}, {0, 1, 2, 3, 4, 5, 2},
                                       {0, 1, 2, 3, 4, 5, 3}, {0, 1, 2, 3, 4, 5, 4}, {1, 1, 2, 3, 4, 5, 5},
                                       {1, 9, 8, 7, 4, 5, 6}, {1, 1, 2, 3, 4, 5, 7}, {1, 0, 2, 3, 4, 5, 8},
                                       {1, 1, 2, 3, 4, 5, 9}};
    for (const auto& digits : upc_e) {
        std::uint8_t upc_a[12] = {};
        upc_a_of_upc_e(digits, upc_a);
        digest.add(Span<const std::uint8_t>(upc_a), ean_check_digit({upc_a, 11}), add_on_5_check({upc_a, 5}));
    }
    for (int sign = 0; sign < 128; ++sign) {
        const Code39Pair pair = code_39_pair(sign);
        digest.add(pair.first, pair.second, code_39_ascii(pair.first, pair.second));
        digest.add(code_39_value(sign), codabar_value(sign));
    }
    std::uint8_t room[4] = {};
    CodeText text{Span<std::uint8_t>(room)};
    digest.add(text.begin_segment(3));
    digest.add(text.push(65));
    digest.add(text.begin_segment(26));
    digest.add(text.segments().size());
    BarRules rules;
    digest.add(bar_symbologies(), retail_symbologies(), SymbologySet(), SymbologySet(Symbology::qr),
               is_valid(rules));
    rules.interleaved_shortest = 7;
    digest.add(is_valid(rules));
}

inline void code_bar_encoders(Workspace& work, Digest& digest) {
    const Span<std::uint8_t> room = work.scratch_span().first(1024);
    for (int kind = 0; kind < bar_kinds; ++kind) {
        int count = 0;
        digest.add(encode_sample(kind, {room.data(), 1024, &count}));
        digest.add(Span<const std::uint8_t>(room.data(), count));
        count = 0;
        digest.add(encode_sample(kind, {room.data(), 20, &count}), count);
    }
    for (const int size : {2, 5, 3}) {
        const std::uint8_t digits[] = {'5', '2', '4', '9', '5'};
        int count = 0;
        digest.add(encode_add_on({digits, size}, {room.data(), 1024, &count}));
        digest.add(Span<const std::uint8_t>(room.data(), count));
    }
}

inline void code_bar_decoders(Workspace& work, Digest& digest) {
    Arena arena(work.scratch_span());
    const auto room = arena.take<std::uint8_t>(1024);
    const auto edges = arena.take<std::int32_t>(1100);
    const auto reversed = arena.take<std::int32_t>(1101);
    Random random(4101);
    for (int kind = 0; kind < bar_kinds; ++kind)
        for (const int noise : {0, 60, 120, 200}) {
            int count = 0;
            const BarWidths widths(room.data(), 1024, &count);
            digest.add(encode_sample(kind, widths));
            const int edge_count = edges_of_bars(widths, 512, noise, random, edges);
            const BarEdges line(edges.data(), edge_count);
            BarRules rules;
            rules.add_on = AddOn::appended;
            if (kind == 9) rules.code_39_text = Code39Text::full_ascii;
            if (kind > 7) rules.code_39_check = rules.codabar_check = CheckCharacter::removed;
            BarReading reading;
            digest.add(decode_bars(line, 0, rules, reading));
            digest.add(reading);
            // One a statement: the order of arguments is the compiler's.
            digest.add(decode_ean(line, 1, rules, reading));
            digest.add(decode_code_128(line, 1, reading));
            digest.add(decode_code_39(line, 1, rules, reading));
            digest.add(decode_interleaved(line, 1, rules, reading));
            digest.add(decode_codabar(line, 1, rules, reading));
            digest.add(reading);
            TwoWidths sorted;
            digest.add(sort_widths(line, 1, 1, 9, 3, noise / 4, 4, sorted), sorted);
            const int back = reverse_bar_edges(line, reversed);
            digest.add(Span<const std::int32_t>(reversed.data(), back));
            digest.add(decode_bars({reversed.data(), back}, 0, rules, reading));
            digest.add(invert_bar_edges(edges, edge_count));
            digest.add(edges.first(edge_count + 1));
        }
}

/// visit(image) for a slanted code of each kind that fits a row.
template <class Visit>
void for_each_code(Workspace& work, Visit visit) {
    Random random(4102);
    for (const int kind : {0, 1, 3, 8}) {
        for (const int slant : {0, 90}) {
            Arena arena(work.scratch_span());
            const auto room = arena.take<std::uint8_t>(256);
            const auto edges = arena.take<std::int32_t>(260);
            int count = 0;
            const BarWidths widths(room.data(), 256, &count);
            static_cast<void>(encode_sample(kind, widths));
            const int edge_count = edges_of_bars(widths, kind == 0 ? 400 : 450, 0, random, edges);
            const ImageView<Gray8> image = work.view<Gray8>(0, {212, 38});
            draw_edges(image, {edges.data(), edge_count}, slant, random);
            visit(image);
        }
    }
}

inline void code_bar_lines(Workspace& work, Digest& digest) {
    for_each_code(work, [&](ImageView<const Gray8> image) {
        Arena arena(work.scratch_span());
        const auto profile = arena.take<std::int16_t>(256);
        const auto sharp = arena.take<std::int16_t>(256);
        const auto ranges = arena.take<std::int16_t>(bar_ranges(256));
        const auto turns = arena.take<BarTurn>(256);
        const auto edges = arena.take<std::int32_t>(260);
        for (const int tilt : {0, 7})
            for (const int breadth : {1, 3}) {
                const SubPixelPoint from{SubPixel::from_int(20), SubPixel::from_int(10)};
                const SubPixelPoint to{SubPixel::from_int(180), SubPixel::from_int(10 + tilt)};
                const BarLine line = bar_line_through(image.size(), from, to, 3);
                sample_bar_line(image, line, breadth, profile);
                const BarProfile seen = profile.first(line.samples);
                digest.add(line, point_of(line, 12345), seen);
                sharpen_bar_profile(seen, breadth, sharp);
                digest.add(sharp.first(line.samples));
                for (const int share : {4, 10}) {
                    const int found = find_bar_turns(seen, share, ranges, turns);
                    digest.add(turns.first(found));
                    for (int rule = 0; rule < 3; ++rule) {
                        const int count =
                            find_bar_edges(seen, turns.first(found), static_cast<BarEdgeRule>(rule), edges);
                        digest.add(edges.first(count));
                    }
                    BarReading reading;
                    reading.error = 30;
                    reading.quiet = 200;
                    digest.add(grade_bars(seen, turns.first(found), 20, 190, reading));
                }
            }
    });
}

inline void code_bar_votes(Workspace&, Digest& digest) {
    List<BarCandidate, 4> list;
    BarVotes votes(list.view());
    Random random(4103);
    for (int i = 0; i < 60; ++i) {
        BarReading reading;
        reading.symbology = i % 20 == 7 ? Symbology::interleaved_2_of_5 : Symbology::ean_8;
        reading.base = 8;
        reading.size = i % 3 == 0 ? 10 : 8;
        reading.text[0] = static_cast<std::uint8_t>('0' + (random.below(6) == 0 ? 1 : 0));
        reading.error = random.between(0, 60);
        reading.quiet = random.between(60, 256);
        const int x = random.below(4) == 0 ? 300 : 20;
        const int y = random.between(0, 60);
        int which = -1;
        digest.add(votes.take(reading,
                              {{SubPixel::from_int(x), SubPixel::from_int(y)},
                               {SubPixel::from_int(x + 90), SubPixel::from_int(y + 5)}},
                              false, which));
        digest.add(which, which >= 0 && votes.is_certain(which), bar_lines_needed(reading));
    }
    digest.add(votes.candidates());
}

inline void code_read_bars(Workspace& work, Digest& digest) {
    for_each_code(work, [&](ImageView<const Gray8> image) {
        std::uint8_t room[64] = {};
        List<BarField, 4> fields;
        digest.add(bar_fields_scratch(image.size()));
        digest.add(find_bar_fields(image, work.scratch_span(), fields));
        digest.add(fields.span());
        for (int effort = 0; effort < 3; ++effort) {
            ReadBarsOptions options;
            options.effort = effort;
            options.most_codes = 1 + effort;
            CodeText text{Span<std::uint8_t>(room)};
            List<Code, 2> codes;
            FOVEA_ASSERT(read_bars_scratch(image.size()) <= work.scratch_span().size());
            digest.add(read_bars(image, options, work.scratch_span(), text, codes));
            digest.add(text.bytes());
            for (const Code& code : codes) put_bar_code(digest, code);
        }
        FOVEA_ASSERT(bar_stream_scratch(image.width()) <= work.scratch_span().size());
        BarStream stream(image.width(), {}, work.scratch_span());
        for (int y = 0; y < image.height(); ++y) digest.add(stream.take({image.row(y), image.width()}));
        digest.add(stream.idle_scratch().size());
        CodeText text{Span<std::uint8_t>(room)};
        List<Code, 2> codes;
        digest.add(stream.finish(text, codes));
        digest.add(text.bytes());
        for (const Code& code : codes) put_bar_code(digest, code);
    });
}

}  // namespace fovea::golden
