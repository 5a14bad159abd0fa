// SPDX-License-Identifier: MIT
//
// Locating parts: which regions of an image are parts, where they are and how they are turned. Book
// sec. 6.2.1.
#pragma once

#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/base/list.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/decision/part_frame.hpp>
#include <fovea/decision/recipe.hpp>
#include <fovea/decision/recipe_range.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/workers.hpp>
#include <fovea/measure/half_turn.hpp>
#include <fovea/morphology/morphology.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/pixelwise/threshold.hpp>
#include <fovea/segment/connected_components.hpp>
#include <fovea/segment/fine_moments.hpp>
#include <fovea/segment/level_contour.hpp>
#include <fovea/statistics/histogram.hpp>
#include <fovea/statistics/moments.hpp>
#include <fovea/statistics/polygon_symmetry.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// How a part lies.
struct PartPose {
    PartFrame frame;
    Status orientation = Status::undecided;  ///< ok, or why frame.angle() means nothing: degenerate without
                                             ///< an axis, undecided when either end could be the front
    bool ends_certain = false;               ///< the front was told from the back
    Ratio margin;                            ///< how clearly, see HalfTurn
    Ratio elongation;                        ///< how clear the axis is, see Orientation
};

/// The moments that say how a part lies: origin and axis follow from those of the frame, which end is the
/// front from those of the region. Of the rotational rule alone, the symmetry of the frame.
struct PartMoments {
    CentralMoments frame;
    CentralMoments region;
    Result<RotationalAxis> symmetry = Status::degenerate;
};

/// The pose of a part with these moments under the rule of a recipe.
///
/// Source  book eq. 6.1-6.8; an axis of less than least_elongation, or of a symmetry weaker than
///         least_symmetry, is none
constexpr PartPose pose_of(const PartMoments& moments, const LocateRule& rule, const Scale& scale);
inline constexpr Ratio least_elongation = Ratio::from_ratio(1, 50);
inline constexpr Ratio least_symmetry = Ratio::from_ratio(1, 200);

/// What tells part from ground in an image.
struct Threshold {
    LevelSet part;       ///< the pixels of parts
    GrayLevel contrast;  ///< mean brightness at and above the level minus mean below
};

/// The moments of a part that find_parts() found: from its contour, or from its pixels where the rule opened
/// the image first and the contour in the image is another. Symmetry is always that of the contour: an opened
/// part needs PoseRule::outline for it, because its holes are others there, and has none (degenerate) if the
/// contour encloses a twentieth more or less than the part.
///
/// Errors  as fine_moments()
inline Result<PartMoments> moments_of(ImageView<const Gray8> image, const LocateRule& rule, LevelSet part,
                                      const Region& region, Span<const Hole> holes, const Scale& scale);

/// The threshold that a rule asks for.
///
/// Errors  empty_image; degenerate when all pixels are alike or, for the fixed and the quantile rule, one
///         class is empty
inline Result<Threshold> threshold_of(const Histogram& histogram, const LocateRule& rule);

/// Scratch bytes for find_parts() with so many workers. With fewer, down to about a fifth, it works for
/// images that are calm.
constexpr std::int64_t find_parts_scratch(Size size, const LocateRule& rule, int workers = 1);

/// Finds the regions that a rule takes for parts, and their holes.
///
/// Shapes    image 1x1 to max_moment_side squared
/// Order     by their first pixel, row by row
/// Scratch   find_parts_scratch(), undefined afterwards
/// Errors    empty_image, image_too_large; bad_argument for a rule out of its range; degenerate as
///           threshold_of(); scratch_too_small and capacity_exceeded as connected_components()
/// Source    book sec. 6.2.1, with a threshold that follows the light, and an area gate
inline Status find_parts(ImageView<const Gray8> image, const LocateRule& rule, Span<std::uint8_t> scratch,
                         Threshold& threshold, ListView<Region> parts, ListView<Hole> holes);
/// The same by several workers, see OneWorker: the scratch is more, the result the same.
template <class Workers>
Status find_parts(ImageView<const Gray8> image, const LocateRule& rule, Span<std::uint8_t> scratch,
                  Threshold& threshold, ListView<Region> parts, ListView<Hole> holes, const Workers& workers);

// ---- Implementation ---------------------------------------------------------------

constexpr PartPose pose_of(const PartMoments& moments, const LocateRule& rule, const Scale& scale) {
    const CentralMoments square = stretched(moments.frame, aspect_of(scale));
    const FinePoint origin = moments.frame.centroid;
    PartPose pose;
    pose.frame = PartFrame(origin, FineAngle(), scale);
    const Result<Orientation> axis = orientation(square);
    if (axis) pose.elongation = axis->elongation;
    if (rule.orientation == OrientationRule::none) {
        pose.orientation = Status::ok;
        return pose;
    }
    if (rule.orientation == OrientationRule::rotational) {
        if (!moments.symmetry || moments.symmetry->strength < least_symmetry) {
            pose.orientation = Status::degenerate;
            return pose;
        }
        pose.orientation = Status::ok;
        pose.frame = PartFrame(origin, moments.symmetry->axis, scale);
        return pose;
    }
    if (!axis || axis->elongation < least_elongation) {
        pose.orientation = Status::degenerate;
        return pose;
    }
    pose.frame = PartFrame(origin, axis->axis, scale);
    if (rule.orientation == OrientationRule::symmetric) {
        pose.orientation = Status::ok;
        return pose;
    }
    const Result<Asymmetry> ends = asymmetry(stretched(moments.region, aspect_of(scale)), axis->axis);
    if (!ends) return pose;
    const Result<HalfTurn> turn = rule.ends == Asymmetry{} ? half_turn(*ends) : half_turn(*ends, rule.ends);
    pose.orientation = turn.status();
    if (!turn) return pose;
    pose.ends_certain = true;
    pose.margin = turn->margin;
    if (turn->turned) pose.frame = PartFrame(origin, axis->axis + FineAngle::half_turn(), scale);
    return pose;
}

inline Result<Threshold> threshold_of(const Histogram& histogram, const LocateRule& rule) {
    if (histogram.total() == 0) return Status::empty_image;
    Threshold result;
    result.part = {rule.level, rule.dark_part};
    if (rule.threshold == ThresholdRule::otsu) {
        const Result<Gray8> level = otsu(histogram);
        if (!level) return level.status();
        result.part.level = *level;
    } else if (rule.threshold == ThresholdRule::quantile) {
        const auto share = [](std::int64_t millionths) {
            return static_cast<std::uint32_t>(round_divide(millionths * whole_share, std::int64_t{1000000}));
        };
        const Result<Gray8> dark = quantile(histogram, share(rule.dark_quantile));
        const Result<Gray8> bright = quantile(histogram, share(rule.bright_quantile));
        if (!dark || !bright) return Status::bad_argument;
        result.part.level = static_cast<Gray8>((*dark + *bright + 1) / 2);
    }
    std::int64_t count[2] = {0, 0};
    std::int64_t sum[2] = {0, 0};
    for (int i = 0; i < Histogram::levels; ++i) {
        const int side = i >= result.part.level ? 1 : 0;
        count[side] += histogram[i];
        sum[side] += std::int64_t{histogram[i]} * i;
    }
    if (count[0] == 0 || count[1] == 0) return Status::degenerate;
    result.contrast = GrayLevel::from_ratio(sum[1], count[1]) - GrayLevel::from_ratio(sum[0], count[0]);
    return result;
}

namespace detail {

/// The symmetry that the rotational rule asks for, about the origin of the frame.
inline Result<RotationalAxis> symmetry_of(ImageView<const Gray8> image, const LocateRule& rule, LevelSet part,
                                          const Region& region, Span<const Hole> holes, FinePoint origin,
                                          const Scale& scale) {
    if (rule.orientation != OrientationRule::rotational) return Status::degenerate;
    Region traced = region;
    if (!image.contains(traced.first)) return Status::out_of_range;
    // In an image that was opened the region began lower.
    while (traced.first.y > 0 && part.contains(image(traced.first.x, traced.first.y - 1))) --traced.first.y;
    // The contour must be that of the part, and not go around others that the opening cut off.
    if (rule.opening > 1) {
        const Result<CentralMoments> whole = fine_moments(image, part, traced, {});
        if (!whole) return whole.status();
        const std::int64_t filled = region.moments.area() + region.hole_area;
        if (whole->area * 20 > filled * 21 || whole->area * 21 < filled * 20) return Status::degenerate;
    }
    return fine_symmetry(image, part, traced, rule.pose == PoseRule::region ? holes : Span<const Hole>(),
                         origin, rule.symmetry_order, aspect_of(scale));
}

}  // namespace detail

inline Result<PartMoments> moments_of(ImageView<const Gray8> image, const LocateRule& rule, LevelSet part,
                                      const Region& region, Span<const Hole> holes, const Scale& scale) {
    const bool by_pixels = rule.opening > 1;
    const Result<CentralMoments> whole =
        by_pixels ? central_moments(region.moments) : fine_moments(image, part, region, holes);
    if (!whole) return whole.status();
    const auto with_symmetry = [&](const CentralMoments& frame) {
        return PartMoments{frame, *whole,
                           detail::symmetry_of(image, rule, part, region, holes, frame.centroid, scale)};
    };
    if (rule.pose == PoseRule::region) return with_symmetry(*whole);
    Moments filled = region.moments;
    for (const Hole& hole : holes)
        if (hole.region == region.number) filled.add(hole.moments);
    const Result<CentralMoments> outline =
        by_pixels ? central_moments(filled) : fine_moments(image, part, region, {});
    if (!outline) return outline.status();
    return with_symmetry(*outline);
}

constexpr std::int64_t find_parts_scratch(Size size, const LocateRule& rule, int workers) {
    const bool opened = rule.opening > 1;
    std::int64_t images = opened ? size.area() + opening_scratch(size) : 0;
    if (workers > 1) images = opened ? 2 * size.area() + workers * erode_scratch(size) : size.area();
    return arena_bytes<Histogram>(workers) + arena_bytes<std::uint8_t>(size.width) + images +
           connected_components_scratch(size.width);
}

namespace detail {

/// What find_parts() checks before its scratch.
inline Status check_find_parts(ImageView<const Gray8> image, const LocateRule& rule) {
    if (image.empty()) return Status::empty_image;
    if (image.width() > max_moment_side || image.height() > max_moment_side) return Status::image_too_large;
    return rule_in_range(rule) ? Status::ok : Status::bad_argument;
}

/// An opening in place, by one worker strip by strip, by several in two steps through an image between them.
template <class Workers>
Status open_parts(ImageView<Gray8> binary, Size element, Arena& arena, const Workers& workers) {
    const Size size = binary.size();
    if (workers.count() == 1) {
        const auto between = arena.take<std::uint8_t>(opening_scratch(size));
        return opening(binary, element, between, binary);
    }
    const ImageView<Gray8> eroded(arena.take_unset<std::uint8_t>(size.area()).data(), size, size.width);
    const auto lines = arena.take_unset<std::uint8_t>(workers.count() * erode_scratch(size));
    const auto step = [&](auto extreme, ImageView<const Gray8> src, ImageView<Gray8> dst) {
        run_rows(workers, size.height, [&](RowRange rows, int worker) {
            const ImageView<Gray8> out(dst.row(rows.first), {size.width, rows.count()}, dst.stride_bytes());
            kernels::extreme_rows<decltype(extreme)>(src, element, rows.first, rows.end - 1,
                                                     lines.from(worker * erode_scratch(size)), out);
        });
    };
    step(kernels::Lowest(), binary, eroded);
    step(kernels::Highest(), eroded, binary);
    return Status::ok;
}

/// Thresholds rows and feeds them to the components; through a whole binary image where it is opened first,
/// or where several work on it.
template <class Workers>
Status components_of(ImageView<const Gray8> image, const LocateRule& rule, Gray8 level, Arena& arena,
                     ListView<Region> parts, ListView<Hole> holes, const Workers& workers) {
    ComponentOptions options;
    options.at_border = rule.at_border ? BorderRegions::keep : BorderRegions::drop;
    options.area_min = rule.area_min;
    options.area_max = rule.area_max;
    options.hole_area_min = rule.hole_area_min;
    const auto classify = rule.dark_part ? kernels::threshold_inverse_row : kernels::threshold_row;
    if (rule.opening > 1 || workers.count() > 1) {
        const Size size = image.size();
        const auto pixels = arena.take_unset<std::uint8_t>(size.area());
        const ImageView<Gray8> binary(pixels.data(), size, size.width);
        run_rows(workers, size.height, [&](RowRange rows, int) {
            for (int y = rows.first; y < rows.end; ++y)
                classify(image.row(y), size.width, level, binary.row(y));
        });
        if (rule.opening > 1)
            if (Status s = open_parts(binary, {rule.opening, rule.opening}, arena, workers); s != Status::ok)
                return s;
        return connected_components(binary, options, arena.rest(), parts, holes);
    }
    const Span<std::uint8_t> row = arena.take<std::uint8_t>(image.width());
    ConnectedComponents components(image.width(), options, arena.rest(), parts, holes);
    for (int y = 0; y < image.height(); ++y) {
        classify(image.row(y), image.width(), level, row.data());
        if (Status s = components.add_row(row.data()); s != Status::ok) return s;
    }
    return components.finish();
}

}  // namespace detail

// Not inlined: gauge() goes on when this has given its stack back.
template <class Workers>
[[gnu::noinline]] Status find_parts(ImageView<const Gray8> image, const LocateRule& rule,
                                    Span<std::uint8_t> scratch, Threshold& threshold, ListView<Region> parts,
                                    ListView<Hole> holes, const Workers& workers) {
    if (Status s = detail::check_find_parts(image, rule); s != Status::ok) return s;
    const std::int64_t labels = connected_components_scratch(image.width());
    if (scratch.size() < find_parts_scratch(image.size(), rule, workers.count()) - labels)
        return Status::scratch_too_small;
    Arena arena(scratch);
    const Span<Histogram> histograms = arena.take<Histogram>(workers.count());
    run_rows(workers, image.height(), [&](RowRange rows, int worker) {
        Histogram& histogram = histograms[worker];
        for (int y = rows.first; y < rows.end; ++y) histogram.add_row(image.row(y), image.width());
    });
    Histogram& histogram = histograms[0];
    for (int k = 1; k < workers.count(); ++k) histogram.merge(histograms[k]);
    const Result<Threshold> chosen = threshold_of(histogram, rule);
    if (!chosen) return chosen.status();
    threshold = *chosen;
    return detail::components_of(image, rule, chosen->part.level, arena, parts, holes, workers);
}

inline Status find_parts(ImageView<const Gray8> image, const LocateRule& rule, Span<std::uint8_t> scratch,
                         Threshold& threshold, ListView<Region> parts, ListView<Hole> holes) {
    return find_parts(image, rule, scratch, threshold, parts, holes, OneWorker());
}

}  // namespace fovea
