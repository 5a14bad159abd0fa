// SPDX-License-Identifier: MIT
//
// Line peaks: where a line of light crosses every row, to a fraction of a pixel.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/scan.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// What of a row may be the line. A pixel belongs from `level` on and weighs its grey level less level - 1,
/// so that one at the level weighs 1 and the foot of the line moves its centre little.
struct LinePeakOptions {
    int level = 128;                 ///< grey level, 1..255; above the ground with its noise
    int width_min = 1;               ///< pixels, 1 or more; a dead pixel is 1 wide
    int width_max = max_image_side;  ///< pixels; reflections and daylight are wider than the line
    int strength_min = 1;            ///< sum of weights, 1 or more
};

/// The line in one row.
struct LinePeak {
    SubPixel x;               ///< centre of gravity of the weights
    int strength = 0;         ///< sum of the weights
    std::uint16_t width = 0;  ///< pixels; 0 where no run is fit to be the line
    std::uint16_t runs = 0;   ///< how many are; where there are several, the strongest may be a reflection

    constexpr bool empty() const { return width == 0; }
};

inline namespace FOVEA_ISA {

/// The strongest run of bright pixels in a row, of equal ones the first; an empty() one where none has the
/// width and the strength that are asked for. The options must be right: line_peaks() looks at them.
///
/// Units     1/256 px, and pixels; strengths up to 255 * 32767, moments below 2^37 in 64 bits
/// Rounding  x to the nearest, ties up
inline LinePeak line_peak(const Gray8* row, int width, const LinePeakOptions& options);

/// The line in every row, from top to bottom.
///
/// Shapes    src 1x1 or larger, sides up to max_image_side; one peak for each row
/// Rounding  as line_peak()
/// Errors    empty_image, size_mismatch for another count of peaks than rows, image_too_large, bad_argument
///           for options out of their ranges
/// Source    centre of gravity after Naidu and Fisher, "A Comparative Analysis of Algorithms for Determining
///           the Peak Position of a Stripe to Sub-pixel Accuracy", BMVC 1991; of the run alone instead of a
///           window of fixed width, and with weights above the threshold
inline Status line_peaks(ImageView<const Gray8> src, const LinePeakOptions& options, Span<LinePeak> peaks);

/// line_peaks() of rows that come one at a time: an accumulator for streams. Strips of a frame write the
/// peaks of their own rows, and may share one span.
///
/// Errors  of begin(): as line_peaks()
class LinePeakAccumulator {
public:
    using Input = Gray8;
    LinePeakAccumulator(const LinePeakOptions& options, Span<LinePeak> peaks)
        : options_(options), peaks_(peaks) {}

    Status begin(Size size) const;
    void add_row(const Gray8* row, int width, int y) const { peaks_[y] = line_peak(row, width, options_); }

private:
    LinePeakOptions options_;
    Span<LinePeak> peaks_;
};

}  // namespace FOVEA_ISA

// ---- Implementation ---------------------------------------------------------------

namespace detail {

constexpr bool in_range(const LinePeakOptions& options) {
    return options.level >= 1 && options.level <= 255 && options.width_min >= 1 &&
           options.width_max >= options.width_min && options.strength_min >= 1;
}

}  // namespace detail

inline namespace FOVEA_ISA {

inline LinePeak line_peak(const Gray8* row, int width, const LinePeakOptions& options) {
    LinePeak peak;
    std::int64_t moment = 0;  // of the peak's weights, about its first pixel
    int first = 0;
    int x = simd::find_at_least(row, 0, width, options.level);
    while (x < width) {
        const int start = x;
        int strength = 0;
        std::int64_t sum = 0;
        for (; x < width && row[x] >= options.level; ++x) {
            const int weight = row[x] - options.level + 1;
            strength += weight;
            sum += weight * (x - start);
        }
        const int run = x - start;
        if (run >= options.width_min && run <= options.width_max && strength >= options.strength_min) {
            ++peak.runs;
            if (strength > peak.strength) {
                peak.strength = strength;
                peak.width = static_cast<std::uint16_t>(run);
                moment = sum;
                first = start;
            }
        }
        x = simd::find_at_least(row, x, width, options.level);
    }
    if (!peak.empty()) peak.x = SubPixel::from_int(first) + SubPixel::from_ratio(moment, peak.strength);
    return peak;
}

inline Status LinePeakAccumulator::begin(Size size) const {
    if (peaks_.size() != size.height) return Status::size_mismatch;
    if (size.width > max_image_side || size.height > max_image_side) return Status::image_too_large;
    return detail::in_range(options_) ? Status::ok : Status::bad_argument;
}

inline Status line_peaks(ImageView<const Gray8> src, const LinePeakOptions& options, Span<LinePeak> peaks) {
    if (src.empty()) return Status::empty_image;
    const LinePeakAccumulator accumulator(options, peaks);
    if (const Status s = accumulator.begin(src.size()); s != Status::ok) return s;
    for (int y = 0; y < src.height(); ++y) accumulator.add_row(src.row(y), src.width(), y);
    return Status::ok;
}

}  // namespace FOVEA_ISA
}  // namespace fovea
