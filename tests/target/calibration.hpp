// SPDX-License-Identifier: MIT
//
// The left camera of the chessboard's 13 views, calibrated: the whole work, for chips and for the host.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/camera/calibrate_planar.hpp>
#include <golden/digest.hpp>
#include <support/board_corners.hpp>

namespace fovea::target {

class BoardCalibration {
public:
    static constexpr int views = test::board_views;

    bool calibrate() {
        prepare();
        return calibrate_planar<Real>(Span<const PlanarView>(views_), test::board_picture, {},
                                      Span<std::uint8_t>(scratch_), Span<CalibratedView<>>(fits_),
                                      calibration_)
            .ok();
    }
    /// Over all digits of what was calculated.
    std::uint32_t digest() const {
        golden::Digest digest;
        for (int i = 0; i < camera_terms; ++i) {
            const auto term = static_cast<CameraTerm>(i);
            digest.add(term_of(calibration_.camera, term), term_of(calibration_.deviation, term));
        }
        const Refinement<>& refinement = calibration_.refinement;
        digest.add(calibration_.rms, refinement.cost, refinement.linearisations, refinement.costs);
        for (const CalibratedView<>& fit : fits_) {
            digest.add(fit.rms);
            for (int r = 0; r < 3; ++r) {
                for (int c = 0; c < 3; ++c) digest.add(fit.pose.rotation(r, c));
                digest.add(fit.pose.translation[r], fit.rotation_deviation[r], fit.translation_deviation[r]);
            }
        }
        return digest.value();
    }
    int linearisations() const { return calibration_.refinement.linearisations; }

    /// The equations of all corners set up between two calls, from the start of a calibration.
    template <class Begin, class End>
    bool set_up(Begin begin, End end) {
        prepare();
        const detail::FreeTerms terms{IntrinsicsOptions()};
        Arena arena{Span<std::uint8_t>(scratch_)};
        const auto poses = arena.take<Pose<>>(views);
        const auto row = arena.take<Real>(camera_terms);
        const auto words = arena.take<std::int64_t>(block_equations_words<6>(terms.count()));
        const auto room = arena.take<Real>(block_equations_scratch<6>(terms.count(), views));
        detail::PlanarSystem<Real> system(Span<const PlanarView>(views_), {}, poses, row, room, words);
        bool good = system.start(test::board_picture).ok();
        begin();
        good = system.linearise() == Status::ok && good;
        end();
        return good;
    }

private:
    void prepare() {
        for (int view = 0; view < views; ++view) views_[view] = {corners_.board, corners_.left[view]};
    }

    static constexpr test::BoardCorners corners_ = test::board_corners();

    PlanarView views_[views];
    alignas(8) std::uint8_t scratch_[calibrate_planar_scratch(views)] = {};
    CalibratedView<> fits_[views];
    PlanarCalibration<> calibration_;
};

}  // namespace fovea::target
