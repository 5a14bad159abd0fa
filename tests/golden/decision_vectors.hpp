// SPDX-License-Identifier: MIT
//
// Golden vectors of decision/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>

#include <fovea/base/crc32.hpp>
#include <fovea/decision/compiled_recipe.hpp>
#include <fovea/decision/gauge.hpp>
#include <fovea/decision/locate.hpp>
#include <fovea/decision/measure_feature.hpp>
#include <fovea/decision/part_frame.hpp>
#include <fovea/decision/recipe.hpp>
#include <fovea/decision/tolerance.hpp>
#include <fovea/image/workers.hpp>
#include <golden/digest.hpp>
#include <golden/measure_vectors.hpp>
#include <golden/plate_recipe.hpp>
#include <golden/workspace.hpp>

namespace fovea::golden {

inline void put(Digest& digest, PartPoint point) { digest.add(point.x, point.y); }
inline void put(Digest& digest, const Threshold& threshold) {
    digest.add(threshold.part.level, threshold.part.below, threshold.contrast);
}
inline void put(Digest& digest, const PartMoments& moments) {
    digest.add(moments.frame, moments.region, moments.symmetry);
}
inline void put(Digest& digest, const PartPose& pose) {
    digest.add(pose.frame.origin(), pose.frame.angle(), pose.orientation, pose.ends_certain, pose.margin,
               pose.elongation);
}
inline void put(Digest& digest, const Measurement& measurement) {
    digest.add(measurement.value, Span<const FinePoint>(measurement.marks).first(measurement.mark_count));
}
inline void put(Digest& digest, const FeatureResult& result) {
    digest.add(result.status, result.verdict);
    if (result.status == Status::ok) digest.add(result.measurement);
}
inline void put(Digest& digest, const PartResult& part) {
    digest.add(part.pose, part.area, part.box, part.holes, part.verdict);
    digest.add(Span<const FeatureResult>(part.features).first(part.feature_count));
}

inline void decision_tolerance(Workspace&, Digest& digest) {
    const Tolerance tolerance{Decimal::from_int(10), Decimal{500000}, Decimal{250000}};
    for (std::int64_t value = 9400000; value <= 10300000; value += 50000) {
        const Verdict verdict = judge(Decimal{value}, tolerance);
        digest.add(verdict);
        for (const Verdict part : {Verdict::ok, Verdict::not_ok, Verdict::unmeasured})
            digest.add(combine(part, verdict), combine(part, Verdict::unmeasured));
    }
    const Feature feature = named_feature("a name of as many letters as fit", FeatureKind::width);
    digest.add(name_of(feature.name), name_of(Feature().name));
    for (const std::int64_t x : {0, 9, 10, 12500, 100000000, 100000001})
        for (const std::int64_t y : {10, 50000, 50001}) {
            const Scale scale{LengthUnit::millimetre, x, y};
            digest.add(scale_in_range(scale));
            if (scale_in_range(scale)) digest.add(aspect_of(scale));
        }
}

inline void decision_part_frame(Workspace&, Digest& digest) {
    Random random(41);
    for (int i = 0; i < 100; ++i) {
        const FinePoint origin{FinePixel::from_int(random.between(0, 640)),
                               FinePixel::from_raw(random.between(0, 1 << 24))};
        Scale scale;
        scale.x_per_pixel = random.between(10, 1000000);
        scale.y_per_pixel = scale.x_per_pixel * random.between(1, 4);
        const PartFrame frame(origin, FineAngle::from_raw(random.next()), scale);
        const PartPoint place{random.between(-1000000000, 1000000000), random.between(-1000000, 1000000)};
        const Result<FinePoint> there = frame.to_image(place);
        digest.add(frame.origin(), frame.angle(), there);
        if (there) digest.add(frame.to_part(*there));
        const PartPoint other{i * std::int64_t{12345678}, -i * std::int64_t{7654321}};
        digest.add(place + other, place - other, length_of(place), square_to(place, 1000000 * i),
                   point_between(place, other, i, 100));
    }
}

/// find_parts(), threshold_of(), moments_of() and pose_of() under every rule.
inline void decision_locate(Workspace& work, Digest& digest) {
    const ImageView<Gray8> image = part_picture(work, 0);
    const auto run = [&](const LocateRule& rule, const Scale& scale) {
        Threshold threshold;
        const auto bytes = minimum<std::int64_t>(find_parts_scratch(image.size(), rule), sizeof work.scratch);
        const Status found =
            find_parts(image, rule, work.scratch_span().first(static_cast<std::ptrdiff_t>(bytes)), threshold,
                       work.regions, work.holes);
        digest.add(found);
        if (found != Status::ok) return;
        digest.add(threshold, work.regions.view(), work.holes.view());
        for (const Region& region : work.regions) {
            const Result<PartMoments> moments =
                moments_of(image, rule, threshold.part, region, work.holes.span(), scale);
            digest.add(moments);
            if (moments) digest.add(pose_of(*moments, rule, scale), needs_outline(rule));
        }
    };
    Histogram histogram;
    digest.add(histogram_of(image, histogram));
    for (const ThresholdRule kind : {ThresholdRule::fixed, ThresholdRule::otsu, ThresholdRule::quantile})
        for (const OrientationRule orientation : {OrientationRule::full, OrientationRule::symmetric,
                                                  OrientationRule::rotational, OrientationRule::none})
            for (const bool dark : {true, false}) {
                LocateRule rule;
                rule.threshold = kind;
                rule.orientation = orientation;
                rule.dark_part = dark;
                rule.at_border = !dark;
                rule.pose = orientation == OrientationRule::symmetric ? PoseRule::outline : PoseRule::region;
                digest.add(threshold_of(histogram, rule));
                run(rule, {LengthUnit::millimetre, 20000, dark ? 20000 : 30000});
            }
    LocateRule rule;
    rule.opening = 3;
    rule.area_min = 1;
    rule.hole_area_min = 1;
    run(rule, {});
    rule.opening = 2;
    run(rule, {});
    rule.opening = 1;
    rule.threshold = ThresholdRule::fixed;
    rule.level = 255;
    run(rule, {});
}

inline void decision_measure_feature(Workspace& work, Digest& digest) {
    const ImageView<Gray8> image = part_picture(work, 0);
    const PlateRecipe made = plate_recipe(image, Plate{}, work.scratch_span(), work.regions, work.holes);
    digest.add(made.status);
    if (made.status != Status::ok) return;
    PartView view{image,          made.pose.frame,  &work.regions[0], work.holes.span(), made.recipe.locate,
                  made.threshold, made.recipe.scale};
    for (const Feature& feature : made.recipe.features) {
        digest.add(measure_feature(view, feature, work.scratch_span()));
        Feature other = feature;
        other.probes = 5;
        other.lines = 2;
        other.contrast_min = 60;
        other.second_edge = -2;
        digest.add(measure_feature(view, other, work.scratch_span()));
        other.from.x *= 40;
        other.centre.y += 7000000;
        other.radius = other.search = 0;
        digest.add(measure_feature(view, other, work.scratch_span()));
        other.probes = 2;
        digest.add(measure_feature(view, other, work.scratch_span()));
        const auto enough = static_cast<std::ptrdiff_t>(measure_feature_scratch(image.size()));
        digest.add(measure_feature(view, feature, work.scratch_span().first(enough)));
        digest.add(measure_feature(view, feature, work.scratch_span().first(enough - 1)));
    }
}

/// The recipe of the plate on the plate in several poses.
inline void decision_gauge(Workspace& work, Digest& digest) {
    PlateRecipe made =
        plate_recipe(part_picture(work, 0), Plate{}, work.scratch_span(), work.regions, work.holes);
    digest.add(made.status);
    List<PartResult, 3> parts;
    const auto run = [&](ImageView<const Gray8> image) {
        digest.add(gauge(image, made.recipe, work.scratch_span(), parts), parts.view());
    };
    constexpr int ways[][3] = {{12, 5, 13}, {-12, -5, 13}, {15, -8, 17}, {1, 0, 1}, {24, 7, 25}};
    for (const auto& way : ways) {
        Plate plate;
        plate.cosine = way[0];
        plate.sine = way[1];
        plate.hypotenuse = way[2];
        plate.centre_x += way[1];
        const ImageView<Gray8> image = work.view<Gray8>(0, Workspace::picture_size);
        draw_plate(image, plate);
        run(image);
    }
    made.recipe.scale = {LengthUnit::millimetre, 1000000, 1100000};
    run(part_picture(work, 0));
    made.recipe.scale = {};
    made.recipe.locate.opening = 3;
    run(part_picture(work, 0));
    made.recipe.locate.opening = 1;
    made.recipe.locate.orientation = OrientationRule::none;
    made.recipe.locate.area_min = 1;
    for_each_picture(work, [&](ImageView<const Gray8> src, ImageView<Gray8>) { run(src); });
    digest.add(gauge_scratch({112, 76}, made.recipe.locate, 3) > 0);
}

/// Three workers in turn, who begin with the last piece.
struct WorkersInTurn {
    static constexpr int count() { return 3; }
    template <class Piece>
    void run(int pieces, const Piece& piece) const {
        for (int index = pieces - 1; index >= 0; --index) piece(index, index % 3);
    }
};

/// The plate by several workers, opened and not, and the pieces that rows are cut in.
inline void decision_gauge_by_workers(Workspace& work, Digest& digest) {
    PlateRecipe made =
        plate_recipe(part_picture(work, 0), Plate{}, work.scratch_span(), work.regions, work.holes);
    List<PartResult, 3> parts;
    for (const int opening : {1, 3}) {
        made.recipe.locate.opening = opening;
        digest.add(gauge(part_picture(work, 0), made.recipe, work.scratch_span(), parts, WorkersInTurn()),
                   parts.view());
    }
    for (const int workers : {1, 2, 3, 16})
        for (const int rows : {1, 16, 17, 100, 1080}) {
            const int pieces = piece_count(rows, workers);
            digest.add(pieces);
            for (int index = 0; index < pieces; ++index) {
                const RowRange piece = piece_rows(rows, pieces, index);
                digest.add(piece.first, piece.end);
            }
        }
    std::int64_t sum = 0;
    digest.add(run_rows(OneWorker(), 40, [&](RowRange rows, int worker) {
        sum += rows.count() + worker;
        return Status::ok;
    }));
    digest.add(sum);
}

/// The recipe of the plate as bytes and back, whole and with every byte changed.
inline void decision_compiled_recipe(Workspace& work, Digest& digest) {
    const PlateRecipe made =
        plate_recipe(part_picture(work, 0), Plate{}, work.scratch_span(), work.regions, work.holes);
    const Span<std::uint8_t> out = work.image[2];
    const Result<std::ptrdiff_t> length = encode_recipe(made.recipe, out);
    digest.add(compiled_recipe_bytes(8), length);
    if (!length) return;
    const Span<std::uint8_t> bytes = out.first(*length);
    digest.add(bytes, encode_recipe(made.recipe, bytes.first(*length - 1)));
    RecipeOf<8> recipe;
    RecipeOf<7> small;
    const auto add_decoded = [&](Span<const std::uint8_t> from) {
        digest.add(decode_recipe(from, recipe));
        digest.add(recipe.features.size());
        digest.add(decode_recipe(from, small));
    };
    add_decoded(bytes);
    digest.add(encode_recipe(recipe, work.image[1]));
    for (std::ptrdiff_t i = 0; i < *length; ++i) {
        add_decoded(bytes.first(i));
        bytes[i] ^= static_cast<std::uint8_t>(1 << i % 8);
        add_decoded(bytes);
        // The same with a checksum that is right: what a value out of its range does.
        const std::uint32_t sum = crc32(bytes.first(*length - 4));
        std::uint8_t before[4];
        for (int k = 0; k < 4; ++k) {
            before[k] = bytes[*length - 4 + k];
            bytes[*length - 4 + k] = static_cast<std::uint8_t>(sum >> 8 * k);
        }
        add_decoded(bytes);
        for (int k = 0; k < 4; ++k) bytes[*length - 4 + k] = before[k];
        bytes[i] ^= static_cast<std::uint8_t>(1 << i % 8);
    }
}

}  // namespace fovea::golden
