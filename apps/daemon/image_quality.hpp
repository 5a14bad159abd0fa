// SPDX-License-Identifier: MIT
//
// Image quality: whether a picture can be judged at all - a dead lamp, a covered lens or a lens out of focus
// is a fault of the machine, not a bad part.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/image/workers.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/statistics/histogram.hpp>

namespace fovea::apps {

// ---- Interface --------------------------------------------------------------------

/// In the order in which they are looked for: a dark picture has no contrast either, and one without contrast
/// no edges.
enum class ImageVerdict : std::uint8_t {
    fine,
    dark,       ///< nothing in it is bright: the lamp is dead, or the shutter closed
    saturated,  ///< too much of it is as bright as the sensor can tell
    covered,    ///< it shows nothing
    defocused,  ///< no edge in it is sharp
};

constexpr const char* word_of(ImageVerdict verdict) {
    switch (verdict) {
        case ImageVerdict::fine: return "none";
        case ImageVerdict::dark: return "image_dark";
        case ImageVerdict::saturated: return "image_saturated";
        case ImageVerdict::covered: return "image_covered";
        case ImageVerdict::defocused: return "image_defocused";
    }
    return "none";
}

/// What a picture must be like. The defaults are wide: they tell what no recipe could be judged in.
struct ImageQualityLimits {
    /// Pixels below this level are dark.
    int dark_below = 32;
    /// Most dark pixels, in thousandths. A part may hide much of the light, but not all of it: a picture of a
    /// bad part has a bright ground still, so this tells a dead lamp apart. 1000 turns it off.
    int most_dark = 990;
    /// Pixels from this level on are saturated.
    int saturated_from = 250;
    /// Most saturated pixels, in thousandths; a back light may be so by intention. 1000 turns it off.
    int most_saturated = 950;
    /// Least contrast, in grey levels; 0 turns it off, for a view that is empty between the parts. Noise of 4
    /// levels has a contrast of 22.
    int least_contrast = 30;
    /// Least sharpness, in thousandths; 0 turns it off. Edges blurred by a standard deviation of 1, 2 and 3
    /// px have 250, 165 and 140.
    int least_sharpness = 150;
    /// Contrast below which sharpness says nothing, as of an empty view that is lit unevenly.
    int focus_contrast = 64;
};

/// What a picture is like.
struct ImageQuality {
    /// Of all pixels that were looked at, in thousandths, rounded to the nearest.
    int dark = 0;
    int saturated = 0;
    /// Grey levels, nearest.
    int mean = 0;
    /// Grey levels between the darkest 1/256 of the pixels and the brightest.
    int contrast = 0;
    /// Thousandths: 1000 where brightness changes from one pixel to the next, 125 where it does so evenly
    /// over 8 px or more, 0 without an edge. 1000 too for an image in which no place can be looked at.
    int sharpness = 0;
};

/// Measures a picture.
///
/// The levels are those of every n-th row, and edges are looked for at every n-th pixel of these, n being the
/// least so that it is done at 76800 places at most. An edge is a place from which brightness changes by half
/// of the contrast or more within 8 px across or down. Of all edges, sharpness is the sum of the squares of
/// the changes from pixel to pixel in these 8 px, less what flat places have of them, which is noise, divided
/// by the sum of the squares of the whole changes. So contrast cancels.
///
/// Shapes  src 1x1 or larger
/// Units   limits tell what is dark and saturated
/// Errors  empty_image; bad_argument for levels outside 0..256
/// Source  our own; the sum of squared differences is the measure of focus of Brenner et al., J. Histochem.
///         Cytochem. 24, 1976, here in relation to the edges it stands on
inline Result<ImageQuality> image_quality(ImageView<const Gray8> src, const ImageQualityLimits& limits);
/// The same by several workers, see OneWorker.
///
/// Scratch  image_quality_scratch(), any alignment
/// Errors   also scratch_too_small
template <class Workers>
Result<ImageQuality> image_quality(ImageView<const Gray8> src, const ImageQualityLimits& limits,
                                   Span<std::uint8_t> scratch, const Workers& workers);
constexpr std::int64_t image_quality_scratch(int workers);

/// Judges a picture by itself: the same picture is judged alike whatever came before it, without hysteresis.
constexpr ImageVerdict judge(const ImageQuality& quality, const ImageQualityLimits& limits);

/// Tells of trouble when it begins and when it ends. Here is the hysteresis, so that a lamp that flickers, or
/// a picture at the limit, is one event and not many: trouble begins with the first picture that is not fine,
/// for then nothing is judged, and ends with the last of five in a row that are.
class ImageTrouble {
public:
    static constexpr int fine_in_a_row = 5;

    /// True if the trouble is another after this verdict; trouble() is then the event.
    bool changed_by(ImageVerdict verdict) {
        if (verdict != ImageVerdict::fine) {
            fine_ = 0;
            const bool other = verdict != trouble_;
            trouble_ = verdict;
            return other;
        }
        if (trouble_ == ImageVerdict::fine || ++fine_ < fine_in_a_row) return false;
        trouble_ = ImageVerdict::fine;
        fine_ = 0;
        return true;
    }
    ImageVerdict trouble() const { return trouble_; }

private:
    ImageVerdict trouble_ = ImageVerdict::fine;
    int fine_ = 0;
};

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Brightness changes over so many pixels at an edge.
inline constexpr int edge_reach = 8;

/// Sums over edges, and over flat places, where changes from pixel to pixel are noise. Of 153600 places at
/// most, so below 2^37.
struct EdgeSums {
    int contrast = 0;
    std::uint64_t steps = 0;
    std::uint64_t wholes = 0;
    std::uint64_t edges = 0;
    std::uint64_t flat_steps = 0;
    std::uint64_t flats = 0;
    bool looked = false;

    /// Adds the place at first, step bytes from pixel to pixel.
    void add(const Gray8* first, std::ptrdiff_t step) {
        looked = true;
        const int whole = first[edge_reach * step] - first[0];
        const int size = whole < 0 ? -whole : whole;
        const bool edge = 2 * size >= contrast && size > 0;
        const bool flat = 8 * size < contrast;
        if (!edge && !flat) return;
        std::uint32_t steps_here = 0;
        for (int k = 0; k < edge_reach; ++k) {
            const int change = first[(k + 1) * step] - first[k * step];
            steps_here += static_cast<std::uint32_t>(change * change);
        }
        (edge ? steps : flat_steps) += steps_here;
        ++(edge ? edges : flats);
        if (edge) wholes += static_cast<std::uint32_t>(size * size);
    }
    void merge(const EdgeSums& other) {
        steps += other.steps;
        wholes += other.wholes;
        edges += other.edges;
        flat_steps += other.flat_steps;
        flats += other.flats;
        looked = looked || other.looked;
    }
    int sharpness() const {
        if (!looked) return 1000;
        if (wholes == 0) return 0;
        // Noise of more than a sixteenth of the contrast is none: the surface has a pattern.
        const auto most = static_cast<std::uint64_t>(contrast * contrast / 16) * edges;
        const std::uint64_t noise = flats == 0 ? 0 : minimum(flat_steps * edges / flats, most);
        return static_cast<int>((1000 * (steps - minimum(steps, noise)) + wholes / 2) / wholes);
    }
};

constexpr int sample_step(Size size) {
    constexpr std::int64_t most_places = 76800;
    int step = 1;
    while (((std::int64_t{size.width} + step - 1) / step) * ((size.height + step - 1) / step) > most_places)
        ++step;
    return step;
}

constexpr int in_thousandths(std::int64_t part, std::int64_t whole) {
    return static_cast<int>((2000 * part + whole) / (2 * whole));
}

}  // namespace detail

constexpr std::int64_t image_quality_scratch(int workers) {
    return arena_bytes<Histogram>(workers) + arena_bytes<detail::EdgeSums>(workers);
}

template <class Workers>
Result<ImageQuality> image_quality(ImageView<const Gray8> src, const ImageQualityLimits& limits,
                                   Span<std::uint8_t> scratch, const Workers& workers) {
    if (src.empty()) return Status::empty_image;
    if (limits.dark_below < 0 || limits.dark_below > 256 || limits.saturated_from < 0 ||
        limits.saturated_from > 256)
        return Status::bad_argument;
    if (scratch.size() < image_quality_scratch(workers.count())) return Status::scratch_too_small;
    Arena arena(scratch);
    const Span<Histogram> histograms = arena.take<Histogram>(workers.count());
    const Span<detail::EdgeSums> sums = arena.take<detail::EdgeSums>(workers.count());
    const int step = detail::sample_step(src.size());
    // Of the rows that are looked at.
    const int rows = (src.height() + step - 1) / step;
    run_rows(workers, rows, [&](RowRange piece, int worker) {
        for (int k = piece.first; k < piece.end; ++k)
            histograms[worker].add_row(src.row(k * step), src.width());
    });
    Histogram& histogram = histograms[0];
    for (int k = 1; k < workers.count(); ++k) histogram.merge(histograms[k]);

    const std::uint32_t* const counts = histogram.counts();
    std::int64_t all = 0, sum = 0, dark = 0, saturated = 0;
    for (int level = 0; level < Histogram::levels; ++level) {
        all += counts[level];
        sum += std::int64_t{counts[level]} * level;
        if (level < limits.dark_below) dark += counts[level];
        if (level >= limits.saturated_from) saturated += counts[level];
    }
    ImageQuality quality;
    quality.dark = detail::in_thousandths(dark, all);
    quality.saturated = detail::in_thousandths(saturated, all);
    quality.mean = static_cast<int>((2 * sum + all) / (2 * all));
    constexpr std::uint32_t outermost = whole_share / 256;
    const Result<Gray8> low = quantile(histogram, outermost);
    const Result<Gray8> high = quantile(histogram, whole_share - outermost);
    if (!low || !high) return Status::bad_argument;
    quality.contrast = *high - *low;

    run_rows(workers, rows, [&](RowRange piece, int worker) {
        detail::EdgeSums edges = sums[worker];
        edges.contrast = quality.contrast;
        for (int y = piece.first * step; y < minimum(piece.end * step, src.height()); y += step)
            for (int x = 0; x < src.width(); x += step) {
                const Gray8* const place = src.row(y) + x;
                if (x + detail::edge_reach < src.width()) edges.add(place, 1);
                if (y + detail::edge_reach < src.height()) edges.add(place, src.stride_bytes());
            }
        sums[worker] = edges;
    });
    detail::EdgeSums edges;
    edges.contrast = quality.contrast;
    for (const detail::EdgeSums& of_worker : sums) edges.merge(of_worker);
    quality.sharpness = edges.sharpness();
    return quality;
}

inline Result<ImageQuality> image_quality(ImageView<const Gray8> src, const ImageQualityLimits& limits) {
    std::uint8_t scratch[image_quality_scratch(1)];
    return image_quality(src, limits, scratch, OneWorker());
}

constexpr ImageVerdict judge(const ImageQuality& quality, const ImageQualityLimits& limits) {
    if (quality.dark > limits.most_dark) return ImageVerdict::dark;
    if (quality.saturated > limits.most_saturated) return ImageVerdict::saturated;
    if (quality.contrast < limits.least_contrast) return ImageVerdict::covered;
    if (quality.contrast >= limits.focus_contrast && quality.sharpness < limits.least_sharpness)
        return ImageVerdict::defocused;
    return ImageVerdict::fine;
}

}  // namespace fovea::apps
