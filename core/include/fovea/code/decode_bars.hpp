// SPDX-License-Identifier: MIT
//
// All bar codes along one scan line.
#pragma once

#include <cstdint>

#include <fovea/base/status.hpp>
#include <fovea/code/bar_reading.hpp>
#include <fovea/code/codabar.hpp>
#include <fovea/code/code_128_decoder.hpp>
#include <fovea/code/code_39_decoder.hpp>
#include <fovea/code/ean_decoder.hpp>
#include <fovea/code/interleaved_2_of_5.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Reads the first code that begins at or behind edge `first`, of the symbologies of the rules, in the
/// direction of the edges. The next one is looked for from reading.last on.
///
/// Errors  out_of_range where first is not 0..edges.size(); bad_argument for lengths of Interleaved 2 of 5
///         that are odd or outside 2..most_bar_text; not_found, with the reading untouched
inline Status decode_bars(BarEdges edges, int first, const BarRules& rules, BarReading& reading);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Six runs or more lie behind `first`. At most edges the space before is too narrow for any quiet zone, so
/// that is looked at for all decoders at once, each of which asks for as much or more.
inline Status decode_bars_at(BarEdges edges, int first, const BarRules& rules, BarReading& reading) {
    const SymbologySet wanted = rules.symbologies;
    const auto behind = [&](int runs) { return std::int64_t{edges[first + runs]} - edges[first]; };
    const std::int64_t quiet = std::int64_t{edges[first]} - edges[first - 1];
    const std::int64_t three = behind(3);
    // The least that any of them asks for is half of what EAN does: a third of three runs.
    if (quiet * 3 < three) return Status::not_found;
    Status status = Status::not_found;
    if (quiet * 3 >= three * 2) status = decode_ean(edges, first, rules, reading);
    // Code 128 asks for 5/11 of six runs, Code 39 for a third of nine, Codabar for a third of seven.
    const bool wide = quiet * 3 >= behind(6);
    if (wide && status != Status::ok && wanted.contains(Symbology::code_128)) {
        status = decode_code_128(edges, first, reading);
    }
    if (wide && status != Status::ok && wanted.contains(Symbology::code_39)) {
        status = decode_code_39(edges, first, rules, reading);
    }
    if (quiet * 4 >= behind(4) * 5 && status != Status::ok &&
        wanted.contains(Symbology::interleaved_2_of_5)) {
        status = decode_interleaved(edges, first, rules, reading);
    }
    if (wide && status != Status::ok && wanted.contains(Symbology::codabar)) {
        status = decode_codabar(edges, first, rules, reading);
    }
    return status;
}

/// No code has fewer edges behind its first one.
inline constexpr int fewest_bar_edges = 4 + 10 + 3;

}  // namespace detail

inline Status decode_bars(BarEdges edges, int first, const BarRules& rules, BarReading& reading) {
    if (first < 0 || first > edges.size()) return Status::out_of_range;
    if (!is_valid(rules)) return Status::bad_argument;
    for (int at = first | 1; at + detail::fewest_bar_edges < edges.size(); at += 2) {
        if (detail::decode_bars_at(edges, at, rules, reading) == Status::ok) return Status::ok;
    }
    return Status::not_found;
}

}  // namespace fovea
