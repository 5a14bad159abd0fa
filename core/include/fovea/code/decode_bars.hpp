// SPDX-License-Identifier: MIT
//
// All bar codes along one scan line.
#pragma once

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

inline Status decode_bars_at(BarEdges edges, int first, const BarRules& rules, BarReading& reading) {
    const SymbologySet wanted = rules.symbologies;
    Status status = decode_ean(edges, first, rules, reading);
    if (status != Status::ok && wanted.contains(Symbology::code_128)) {
        status = decode_code_128(edges, first, reading);
    }
    if (status != Status::ok && wanted.contains(Symbology::code_39)) {
        status = decode_code_39(edges, first, rules, reading);
    }
    if (status != Status::ok && wanted.contains(Symbology::interleaved_2_of_5)) {
        status = decode_interleaved(edges, first, rules, reading);
    }
    if (status != Status::ok && wanted.contains(Symbology::codabar)) {
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
