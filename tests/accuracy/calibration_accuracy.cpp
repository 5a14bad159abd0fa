// SPDX-License-Identifier: MIT
//
// Random calibrations and random stereo rigs, many of each: how far Real is from the same in long double, and
// how far both are from the truth. Run by hand; its figures are in docs/operators/calibration.md.
//   calibration_accuracy [COUNT]     200 of each without a number
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <support/camera_scene.hpp>

namespace {

using namespace fovea;
using namespace fovea::test;

/// What a campaign saw.
struct Figures {
    int count = 0;
    int failures = 0;
    int most_linearisations = 0;
    int linearisations = 0;
    double most_apart = 0;
    double most_open = 0;
    double most_from_truth = 0;
    double squares = 0;
    int terms = 0;
    double lowest_rms = 10;
    double highest_rms = 0;

    void refinement(const Refinement<>& done) {
        most_linearisations = std::max(most_linearisations, done.linearisations);
        linearisations += done.linearisations;
    }
    void off(double error, double deviation) {
        const double in_deviations = error / deviation;
        most_from_truth = std::max(most_from_truth, std::abs(in_deviations));
        squares += in_deviations * in_deviations;
        ++terms;
    }
    void camera(const Camera<>& found, const Camera<>& deviation, const Camera<double>& truth) {
        for (int i = 0; i < camera_terms; ++i) {
            const auto term = static_cast<CameraTerm>(i);
            const auto one = static_cast<double>(value_of(term_of(deviation, term)));
            if (one == 0) continue;
            off(static_cast<double>(value_of(term_of(found, term))) - term_of(truth, term), one);
        }
        most_open = std::max(most_open, static_cast<double>(value_of(deviation.fx / found.fx)));
        most_open = std::max(most_open, static_cast<double>(value_of(deviation.cx / found.fx)));
        most_open = std::max(most_open, static_cast<double>(value_of(deviation.cy / found.fx)));
    }
    void rms(double found, double expected) {
        lowest_rms = std::min(lowest_rms, found / expected);
        highest_rms = std::max(highest_rms, found / expected);
    }
    void row(const char* name) const {
        std::printf("| %s | %d | %d | %.1e | ", name, count, failures, most_apart);
        if (terms > 0)
            std::printf("%.2f, %.1f", std::sqrt(squares / terms), most_from_truth);
        else
            std::printf("-");
        std::printf(" | %.2f to %.2f | %.1f, %d | ", lowest_rms, highest_rms,
                    static_cast<double>(linearisations) / count, most_linearisations);
        if (most_open > 0)
            std::printf("%.3f |\n", most_open);
        else
            std::printf("- |\n");
    }
};

Figures cameras(int count) {
    Figures figures;
    for (int i = 0; i < count; ++i) {
        ++figures.count;
        const CameraScene scene = random_scene(1000 + static_cast<unsigned>(i));
        const PlanarRun<Real> found(scene.span(), scene.picture);
        const PlanarRun<long double> same(scene.span(), scene.picture);
        if (!found.verdict.ok() || !same.verdict.ok()) {
            ++figures.failures;
            std::printf("camera %d: %s, %s\n", i, describe(found.verdict.problem),
                        describe(same.verdict.problem));
            continue;
        }
        const PlanarCalibration<>& c = found.calibration;
        const double apart = deviations_between(c.camera, same.calibration.camera, c.deviation);
        figures.most_apart = std::max(figures.most_apart, apart);
        figures.refinement(c.refinement);
        figures.camera(c.camera, c.deviation, scene.camera);
        const double points = 54.0 * double(scene.views.size());
        const double unknowns = 8 + 6.0 * double(scene.views.size());
        const double rms = scene.noise * std::sqrt((2 * points - unknowns) / points);
        const auto share = static_cast<double>(value_of(c.rms));
        figures.rms(share, rms);
        if (apart > 1e-9 || std::abs(share / rms - 1) > 0.2) {
            ++figures.failures;
            std::printf("camera %d: %g deviations apart, rms %g of %g\n", i, apart, share, rms);
        }
    }
    return figures;
}

Figures rigs(int count, StereoOptions::Intrinsics intrinsics) {
    Figures figures;
    for (int i = 0; i < count; ++i) {
        ++figures.count;
        const StereoScene scene = random_rig(5000 + static_cast<unsigned>(i));
        const PlanarRun<Real> left(scene.left.span(), scene.left.picture);
        const PlanarRun<Real> right(scene.right.span(), scene.right.picture);
        StereoOptions options;
        options.intrinsics = intrinsics;
        const StereoRun<Real> found(scene.span(), {left.calibration.camera, scene.left.picture},
                                    {right.calibration.camera, scene.right.picture}, options);
        const PlanarRun<long double> left_same(scene.left.span(), scene.left.picture);
        const PlanarRun<long double> right_same(scene.right.span(), scene.right.picture);
        const StereoRun<long double> same(scene.span(), {left_same.calibration.camera, scene.left.picture},
                                          {right_same.calibration.camera, scene.right.picture}, options);
        if (!left.verdict.ok() || !right.verdict.ok() || !found.verdict.ok() || !same.verdict.ok()) {
            ++figures.failures;
            std::printf("rig %d: %s, %s, %s\n", i, describe(left.verdict.problem),
                        describe(right.verdict.problem), describe(found.verdict.problem));
            continue;
        }
        const StereoCalibration<>& c = found.calibration;
        double apart = 0;
        for (int k = 0; k < 3; ++k) {
            const long double difference =
                value_of(c.right_from_left.translation[k]) - same.calibration.right_from_left.translation[k];
            apart = std::max(apart, double(std::abs(difference) / value_of(c.translation_deviation[k])));
            // With held cameras the deviation does not know of theirs.
            if (intrinsics == StereoOptions::Intrinsics::estimated)
                figures.off(
                    double(value_of(c.right_from_left.translation[k])) - scene.right_from_left.translation[k],
                    double(value_of(c.translation_deviation[k])));
        }
        figures.most_apart = std::max(figures.most_apart, apart);
        figures.refinement(c.refinement);
        if (intrinsics == StereoOptions::Intrinsics::estimated) {
            figures.camera(c.left, c.left_deviation, scene.left.camera);
            figures.camera(c.right, c.right_deviation, scene.right.camera);
        }
        const double points = 108.0 * double(scene.views.size());
        const double unknowns = 22 + 6.0 * double(scene.views.size());
        const double rms = scene.left.noise * std::sqrt((2 * points - unknowns) / points);
        const auto share = static_cast<double>(value_of(c.rms));
        figures.rms(share, rms);
        // Cameras that are held keep what is wrong with them.
        const double most = intrinsics == StereoOptions::Intrinsics::held ? 1.5 : 1.2;
        if (apart > 1e-9 || share / rms > most || share / rms < 0.8) {
            ++figures.failures;
            std::printf("rig %d: %g deviations apart, rms %g of %g\n", i, apart, share, rms);
        }
    }
    return figures;
}

}  // namespace

int main(int argc, char** argv) {
    const int count = argc > 1 ? std::atoi(argv[1]) : 200;
    std::printf(
        "| random | calibrations | failures | Real from long double | from the truth, rms and most | rms of "
        "what "
        "is expected | equations, mean and most | largest deviation of fx, cx, cy by fx |\n"
        "|---|---|---|---|---|---|---|---|\n");
    const Figures one = cameras(count);
    one.row("cameras");
    const Figures held = rigs(count, StereoOptions::Intrinsics::held);
    held.row("rigs, cameras held");
    const Figures free = rigs(count, StereoOptions::Intrinsics::estimated);
    free.row("rigs, cameras estimated");
    return one.failures + held.failures + free.failures == 0 ? 0 : 1;
}
