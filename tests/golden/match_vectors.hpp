// SPDX-License-Identifier: MIT
//
// Golden vectors of match/, and of the fits of measure/ that are made of it.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/random.hpp>
#include <fovea/match/fit_homography.hpp>
#include <fovea/match/ransac.hpp>
#include <fovea/match/ransac_transforms.hpp>
#include <fovea/measure/fit_plane.hpp>
#include <fovea/measure/ransac_fits.hpp>
#include <golden/digest.hpp>
#include <golden/number_vectors.hpp>
#include <golden/workspace.hpp>

namespace fovea::golden {

inline constexpr int match_pairs = 24;

/// Pairs that are moved, turned and tilted a little; every third may be anything.
struct MatchPairs {
    PlanePoint plane[match_pairs] = {};
    SubPixelPoint from[match_pairs] = {};
    SubPixelPoint to[match_pairs] = {};
    std::uint8_t agrees[match_pairs] = {};

    MatchPairs(Random& random, bool all_right) {
        const std::int64_t turn = random.between(-200, 200);
        const std::int64_t tilt = random.between(-60, 60);
        for (int i = 0; i < match_pairs; ++i) {
            const int x = random.between(0, 640);
            const int y = random.between(0, 480);
            const std::int64_t weight = 100000 + tilt * x / 8 + y * 5;
            std::int64_t u = (x * 1000 - y * turn + 3000) * 25600 / weight;
            std::int64_t v = (y * 1000 + x * turn) * 25600 / weight;
            u += random.between(-60, 60);
            v += random.between(-60, 60);
            if (!all_right && i % 3 == 0) u = random.between(0, 160000);
            plane[i] = {x, y};
            from[i] = {SubPixel::from_int(x), SubPixel::from_int(y)};
            to[i] = {SubPixel::from_raw(static_cast<std::int32_t>(u)),
                     SubPixel::from_raw(static_cast<std::int32_t>(v))};
        }
    }
};

inline void match_fits(Workspace&, Digest& digest) {
    Random random(81);
    for (int k = 0; k < 3; ++k) {
        const MatchPairs pairs(random, true);
        const Span<const PlanePoint> plane(pairs.plane);
        const Span<const SubPixelPoint> from(pairs.from);
        const Span<const SubPixelPoint> to(pairs.to);
        const auto homography = fit_homography(plane, to);
        digest.add(homography, fit_homography(from, to), fit_affine(plane, to), fit_affine(from, to));
        if (homography) digest.add(map_point(*homography, random_matrix<2, 1>(random)));
    }
}

inline void match_ransac(Workspace&, Digest& digest) {
    Random random(82);
    for (const int agreeing : {3, 7, 20, 24}) digest.add(ransac_samples(agreeing, 24, 4, 10, 2000));
    const int numbers[8] = {5, 90, 88, 3, 91, 70, 89, 12};
    const auto some = ransac<1, int>(
        8, {}, [&](const std::ptrdiff_t(&chosen)[1]) { return Result<int>(numbers[chosen[0]]); },
        [&](int model, std::ptrdiff_t i) { return numbers[i] - model <= 1 && model - numbers[i] <= 1; });
    if (some) digest.add(some->model, static_cast<int>(some->agreeing), some->samples);
    RansacOptions options;
    options.most_samples = 24;
    MatchPairs pairs(random, false);
    const Span<const SubPixelPoint> to(pairs.to);
    const SubPixel tolerance = SubPixel::from_int(1);
    const auto homography =
        fit_homography_ransac(Span<const PlanePoint>(pairs.plane), to, tolerance, options, pairs.agrees);
    if (homography) digest.add(homography->transform, homography->samples);
    for (const std::uint8_t flag : pairs.agrees) digest.add(flag);
    const auto affine = fit_affine_ransac(Span<const SubPixelPoint>(pairs.from), to, SubPixel::from_int(20),
                                          options, pairs.agrees);
    if (affine) digest.add(affine->transform, affine->samples);
    for (const std::uint8_t flag : pairs.agrees) digest.add(flag);
}

inline void measure_ransac(Workspace&, Digest& digest) {
    Random random(83);
    FinePoint line[match_pairs];
    FinePoint ring[match_pairs];
    SpacePoint plane[match_pairs];
    for (int i = 0; i < match_pairs; ++i) {
        const int noise = random.between(-3000, 3000);
        const bool other = random.below(3) == 0;
        const int far = random.between(-100, 100);
        line[i] = {FinePixel::from_int(10 * i),
                   FinePixel::from_raw((4 * i + (other ? far : 0)) * 65536 + noise)};
        const UnitVector along = unit_vector(FineAngle::from_raw(static_cast<std::uint32_t>(i) * 178956970u));
        const int radius = 60 + (other ? far / 2 : 0);
        ring[i] = {
            FinePixel::from_raw(static_cast<std::int32_t>((std::int64_t{along.x.raw()} * radius) >> 14)),
            FinePixel::from_raw(static_cast<std::int32_t>((std::int64_t{along.y.raw()} * radius) >> 14) +
                                noise)};
        const int x = random.between(-500, 500);
        plane[i] = {x, 40 * i, x / 3 - 7 * i + (other ? far : 0) + noise / 1000};
    }
    RansacOptions options;
    options.most_samples = 30;
    const auto along = fit_line_ransac(line, FinePixel::from_int(1), options);
    if (along) digest.add(along->line.point, along->line.direction.raw(), along->used);
    const auto round = fit_circle_ransac(ring, FinePixel::from_int(1), options);
    if (round) digest.add(round->circle.centre, round->circle.radius.raw(), round->used);
    const auto all = fit_plane(Span<const SpacePoint>(plane));
    if (all) digest.add(all->plane.normal, all->plane.offset, all->rms);
    const auto most = fit_plane_ransac(Span<const SpacePoint>(plane), Real::from_int(6), options);
    if (most) digest.add(most->plane.normal, most->plane.offset, most->rms);
    if (most) digest.add(distance_from(most->plane, vector_of<Real>(plane[0])));
}

}  // namespace fovea::golden
