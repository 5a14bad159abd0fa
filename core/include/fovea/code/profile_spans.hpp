// SPDX-License-Identifier: MIT
//
// Where bars may begin and end in a profile: between two places as light as all that lies between them.
#pragma once

#include <cstdint>

#include <fovea/base/list.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/code/blurred_ean.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Stretches that may hold all bars of a code, around the middle of a profile.
///
/// A quiet zone is lighter than any space between blurred bars. From the middle outwards every top of the
/// profile that is within an eighth of the lightest so far may be one; all pairs of the outermost four to
/// both sides are told, the widest first.
///
/// Shapes  profile of 64 places or more; middle in it
/// Errors  empty_image; out_of_range for the middle; not_found; capacity_exceeded with the widest in the list
/// Source  ISO/IEC 15420, 4.3.4 (quiet zones)
inline Status find_profile_spans(Span<const std::uint16_t> profile, int middle, ListView<ProfileSpan> spans);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

inline constexpr int most_span_ends = 4;
/// From the middle to either end: half of the narrowest code that is read.
inline constexpr int least_half_span = 32;

/// The outermost tops to one side, the farthest first: places whose next step inwards falls.
inline int outermost_tops(Span<const std::uint16_t> profile, int middle, int step,
                          int (&ends)[most_span_ends]) {
    std::int32_t lightest = 0;
    int count = 0;
    for (int x = middle; x >= 2 && x < profile.size() - 2; x += step) {
        const std::int32_t level = profile[x];
        const bool top = level > profile[x - step] && level >= profile[x + step];
        lightest = maximum(lightest, level);
        const int away = step * (x - middle);
        if (!top || away < least_half_span || level < lightest - lightest / 8) continue;
        for (int i = minimum(count, most_span_ends - 1); i > 0; --i) ends[i] = ends[i - 1];
        ends[0] = x;
        count = minimum(count + 1, most_span_ends);
    }
    return count;
}

}  // namespace detail

inline Status find_profile_spans(Span<const std::uint16_t> profile, int middle, ListView<ProfileSpan> spans) {
    if (profile.empty()) return Status::empty_image;
    if (middle < 0 || middle >= profile.size()) return Status::out_of_range;
    int left[detail::most_span_ends] = {};
    int right[detail::most_span_ends] = {};
    const int lefts = detail::outermost_tops(profile, middle, -1, left);
    const int rights = detail::outermost_tops(profile, middle, 1, right);
    if (lefts == 0 || rights == 0) return Status::not_found;
    for (int both = 0; both <= lefts + rights - 2; ++both) {
        for (int i = maximum(0, both - rights + 1); i <= minimum(both, lefts - 1); ++i) {
            if (Status s = spans.push({left[i], right[both - i]}); s != Status::ok) return s;
        }
    }
    return Status::ok;
}

}  // namespace fovea
