// SPDX-License-Identifier: MIT
//
// Grades of bar codes along a scan line. ISO/IEC 15416, as far as a camera allows.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/code/bar_edges.hpp>
#include <fovea/code/bar_reading.hpp>
#include <fovea/code/code.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Grades the code that lies between two samples of a profile, of its turning points and of what was read.
///
/// Units   from and to in samples, in any order
/// Answer  not_graded in all parts where no turns lie between them
/// Source  ISO/IEC 15416, 5.4 and table 3. Departures: grey levels of 255 stand for reflectance, the
///         decodability is that of the mean edge instead of the worst one, and a quiet zone that is narrower
///         than asked is graded by its width, where the standard gives 4 or 0
inline CodeGrade grade_bars(BarProfile profile, Span<const BarTurn> turns, std::int32_t from, std::int32_t to,
                            const BarReading& reading);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// The grade of value / whole: 4 from the first of four percentages on, 3 from the second ...
constexpr std::int8_t grade_of(std::int64_t value, std::int64_t whole, const std::int8_t (&percent)[4]) {
    for (int i = 0; i < 4; ++i)
        if (value * 100 >= whole * percent[i]) return static_cast<std::int8_t>(4 - i);
    return 0;
}

}  // namespace detail

inline CodeGrade grade_bars(BarProfile profile, Span<const BarTurn> turns, std::int32_t from, std::int32_t to,
                            const BarReading& reading) {
    CodeGrade grade;
    const std::int32_t first = maximum<std::int32_t>(minimum(from, to), 0);
    const std::int32_t last = minimum(maximum(from, to), static_cast<std::int32_t>(profile.size()) - 1);
    std::int32_t darkest = 4096;
    std::int32_t brightest = -1;
    std::int32_t least_edge = 4096;
    for (std::ptrdiff_t i = 0; i + 1 < turns.size(); ++i) {
        // An edge belongs to the code where its middle does.
        const std::int32_t middle = (turns[i].place + turns[i + 1].place) / 2;
        if (middle < first - 1 || middle > last + 1) continue;
        const std::int32_t low = minimum(turns[i].level, turns[i + 1].level);
        const std::int32_t high = maximum(turns[i].level, turns[i + 1].level);
        darkest = minimum(darkest, low);
        brightest = maximum(brightest, high);
        least_edge = minimum(least_edge, high - low);
    }
    const std::int32_t contrast = brightest - darkest;
    if (contrast <= 0) return grade;
    grade.symbol_contrast = detail::grade_of(contrast, 255 << bar_profile_bits, {70, 55, 40, 20});
    grade.modulation = detail::grade_of(least_edge, contrast, {70, 60, 50, 40});
    // An edge that is half a module off is the other digit's.
    grade.decodability = detail::grade_of(128 - minimum(reading.error, 128), 128, {62, 50, 37, 25});
    grade.quiet_zone = detail::grade_of(reading.quiet, 256, {94, 75, 50, 33});
    grade.overall = minimum(minimum(grade.symbol_contrast, grade.modulation),
                            minimum(grade.decodability, grade.quiet_zone));
    return grade;
}

}  // namespace fovea
