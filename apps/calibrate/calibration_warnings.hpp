// SPDX-License-Identifier: MIT
//
// What speaks against a calibration, and what to do about it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include <fovea/camera/calibration.hpp>
#include <fovea/number/real.hpp>

#include <calibrate/camera_estimate.hpp>
#include <calibrate/coverage.hpp>
#include <calibrate/figures.hpp>
#include <calibrate/seen_board.hpp>

namespace fovea::apps {

struct CalibrationWarning {
    const char* code;
    /// Whether it makes the calibration doubtful; else it says how it could be better.
    bool doubtful;
    std::string text;
};
using CalibrationWarnings = std::vector<CalibrationWarning>;

inline bool doubtful(const CalibrationWarnings& warnings) {
    return std::any_of(warnings.begin(), warnings.end(),
                       [](const CalibrationWarning& warning) { return warning.doubtful; });
}

namespace detail {

// Limits of what is told. With eight views deviations are about what they say; boards tilted by 20 degrees
// tell the focal length; half a percent of it is half a percent of every distance.
inline constexpr int enough_views = 8;
inline constexpr int fewest_views = 4;
inline constexpr Decimal enough_tilt = Decimal::from_int(20);

inline Vector<3> normal_of(const ViewFit& view) { return view.fit.pose.rotation.column(2); }

/// The largest angle between two boards.
inline Decimal tilt_of(const std::vector<ViewFit>& views) {
    Decimal most;
    for (std::size_t i = 0; i < views.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            most = std::max(most, degrees_between(normal_of(views[i]), normal_of(views[j])));
    return most;
}

inline Real median_rms(const std::vector<ViewFit>& views) {
    std::vector<Real> all;
    for (const ViewFit& view : views) all.push_back(view.fit.rms);
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    std::nth_element(all.begin(), middle, all.end());
    return *middle;
}

/// Views that fit much worse than the others: 2.5 times the median and half a pixel.
inline std::vector<const ViewFit*> bad_views(const std::vector<ViewFit>& views) {
    std::vector<const ViewFit*> bad;
    if (views.size() < 3) return bad;
    const Real limit = std::max(median_rms(views) * Real::from_ratio(5, 2), Real::from_ratio(1, 2));
    for (const ViewFit& view : views)
        if (limit < view.fit.rms) bad.push_back(&view);
    return bad;
}

/// How far apart two boards are seen, on average, in 1/256 px.
inline std::int64_t mean_distance(const SeenBoard& a, const SeenBoard& b) {
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < a.corners.size(); ++i) {
        const std::int64_t x = a.corners[i].x.raw() - std::int64_t{b.corners[i].x.raw()};
        const std::int64_t y = a.corners[i].y.raw() - std::int64_t{b.corners[i].y.raw()};
        sum += std::max(x < 0 ? -x : x, y < 0 ? -y : y);
    }
    return sum / std::max<std::int64_t>(static_cast<std::int64_t>(a.corners.size()), 1);
}

class CameraJudge {
public:
    CameraJudge(const std::vector<SeenBoard>& boards, const CameraEstimate& estimate, const std::string& who,
                CalibrationWarnings& warnings)
        : boards_(boards),
          estimate_(estimate),
          camera_(estimate.calibration.camera),
          deviation_(estimate.calibration.deviation),
          who_(who.empty() ? "" : who + ": "),
          warnings_(warnings) {}

    void judge() {
        look_at_views();
        look_at_places();
        look_at_residuals();
        look_at_terms();
    }

private:
    void warn(const char* code, bool doubtful, const std::string& text) {
        warnings_.push_back({code, doubtful, who_ + text});
    }

    void look_at_views() {
        const int views = static_cast<int>(estimate_.views.size());
        if (views < enough_views)
            warn("few_views", views < fewest_views,
                 std::string(views == 1 ? "only 1 view" : "only " + std::to_string(views) + " views") +
                     "; take 10 to 20, and the deviations become smaller and sure");
        const Decimal tilt = tilt_of(estimate_.views);
        if (views > 1 && tilt < enough_tilt)
            warn("few_tilts", false,
                 "all boards lie within " + number(tilt, 0) +
                     " degrees of each other; tilt the board by 20 to 45 degrees, to the left, the right, up "
                     "and down: tilts tell the focal length");
    }

    void look_at_places() {
        Coverage coverage(estimate_.picture);
        for (const ViewFit& view : estimate_.views) coverage.add(boards_[view.seen].span());
        if (coverage.empty_cells() > 0)
            warn("empty_places", false,
                 "no corner was seen in these parts of the picture: " + listed(coverage.empty_places()) +
                     "; the lens is not known there: take views with the board there");
        for (std::size_t i = 0; i < estimate_.views.size(); ++i)
            for (std::size_t j = 0; j < i; ++j) {
                const SeenBoard& a = boards_[estimate_.views[j].seen];
                const SeenBoard& b = boards_[estimate_.views[i].seen];
                // A board that was not moved jitters by less than a pixel.
                if (mean_distance(a, b) > 256) continue;
                warn("same_place", false,
                     b.name + " shows the board where " + a.name +
                         " does, and tells nothing new; move the board between pictures");
                return;
            }
    }

    void look_at_residuals() {
        for (const ViewFit* view : bad_views(estimate_.views))
            warn("bad_view", true,
                 boards_[view->seen].name + " fits badly, " + number(view->fit.rms, 2) +
                     " px rms where half of the views are below " + number(median_rms(estimate_.views), 2) +
                     ": blurred, moved, or corners at wrong places; look at it with --explain, and leave it "
                     "out");
        const Real limit = std::max(Real::one(), Real::from_ratio(estimate_.picture.width, 2000));
        if (limit < estimate_.calibration.rms)
            warn("high_rms", true,
                 "corners are " + number(estimate_.calibration.rms, 2) +
                     " px off on average; is the board flat and stiff, was it still, does --lens have the "
                     "terms that the lens needs?");
    }

    void look_at_terms() {
        const Real worst = std::max(deviation_.fx / camera_.fx, deviation_.fy / camera_.fy);
        if (Real::from_ratio(1, 200) < worst)
            warn("focal_length_uncertain", true,
                 "the focal length is uncertain by " + number(worst * Real::from_int(100), 1) +
                     " percent; take more views with the board tilted by 20 to 45 degrees and large in the "
                     "picture");
        const auto off = [](Real centre, int length) {
            return (centre - Real::from_int(length - 1, -1)).absolute() / Real::from_int(length);
        };
        const Real share =
            std::max(off(camera_.cx, estimate_.picture.width), off(camera_.cy, estimate_.picture.height));
        if (Real::from_ratio(1, 10) < share)
            warn("centre_far", false,
                 "the principal point (" + number(camera_.cx, 1) + ", " + number(camera_.cy, 1) +
                     ") is far from the middle of the picture; right if the pictures are cut out of larger "
                     "ones, else take more tilted views, or give --fixed-centre");
        const std::string open = open_terms();
        if (!open.empty())
            warn("lens_uncertain", false,
                 open +
                     " not told by these views: the deviation is larger than the value, and moves the "
                     "picture's corners by more than half a pixel; take views with the board in the "
                     "corners of the picture, or give --lens fewer terms");
    }

    /// Terms of the lens that are uncertain, and matter.
    std::string open_terms() const {
        const Real x =
            std::max(camera_.cx, Real::from_int(estimate_.picture.width) - camera_.cx) / camera_.fx;
        const Real y =
            std::max(camera_.cy, Real::from_int(estimate_.picture.height) - camera_.cy) / camera_.fy;
        const Real square = x * x + y * y;
        const Real radius = square.square_root();
        const Real pixels = std::max(camera_.fx, camera_.fy);
        // How far a unit of each term moves the corner.
        const struct {
            const char* name;
            Real Camera<>::*member;
            Real effect;
        } terms[] = {{"k1", &Camera<>::k1, pixels * radius * square},
                     {"k2", &Camera<>::k2, pixels * radius * square * square},
                     {"k3", &Camera<>::k3, pixels * radius * square * square * square},
                     {"p1", &Camera<>::p1, pixels * square * Real::from_int(3)},
                     {"p2", &Camera<>::p2, pixels * square * Real::from_int(3)}};
        std::vector<std::string> open;
        for (const auto& term : terms)
            if ((camera_.*term.member).absolute() < deviation_.*term.member &&
                Real::from_ratio(1, 2) < deviation_.*term.member * term.effect)
                open.push_back(term.name);
        return open.empty() ? "" : listed(open) + (open.size() == 1 ? " is" : " are");
    }

    const std::vector<SeenBoard>& boards_;
    const CameraEstimate& estimate_;
    const Camera<>& camera_;
    const Camera<>& deviation_;
    std::string who_;
    CalibrationWarnings& warnings_;
};

}  // namespace detail

/// What speaks against the calibration of one camera; who is its name if there are two.
inline void judge_camera(const std::vector<SeenBoard>& boards, const CameraEstimate& estimate,
                         const std::string& who, CalibrationWarnings& warnings) {
    for (const SeenBoard& board : boards)
        if (board.found && !board.used)
            warnings.push_back(
                {"same_picture", false, board.name + " is " + board.reason + "; counted once"});
    const auto missed =
        std::count_if(boards.begin(), boards.end(), [](const SeenBoard& board) { return !board.found; });
    if (3 * static_cast<std::size_t>(missed) > boards.size())
        warnings.push_back({"boards_missed", false,
                            (who.empty() ? "" : who + ": ") + std::to_string(missed) + " of " +
                                std::to_string(boards.size()) +
                                " pictures show no whole board; is it in the picture with its rim, sharp and "
                                "evenly lit?"});
    detail::CameraJudge(boards, estimate, who, warnings).judge();
}

/// The last number in the name of a picture, "" if it has none.
inline std::string number_in(const std::string& name) {
    const std::string digits = "0123456789";
    const std::size_t slash = name.rfind('/');
    const std::string file = slash == std::string::npos ? name : name.substr(slash + 1);
    const std::size_t last = file.find_last_of(digits);
    if (last == std::string::npos) return "";
    const std::size_t before = file.find_last_not_of(digits, last);
    return file.substr(before == std::string::npos ? 0 : before + 1, last - before);
}

/// What speaks against the calibration of a pair.
inline void judge_pair(const std::vector<SeenBoard>& left, const std::vector<SeenBoard>& right,
                       const CameraEstimate& left_alone, const CameraEstimate& right_alone,
                       const PairEstimate& pair, CalibrationWarnings& warnings) {
    for (std::size_t i = 0; i < left.size(); ++i)
        if (number_in(left[i].name) != number_in(right[i].name)) {
            warnings.push_back({"pair_names", false,
                                left[i].name + " is paired with " + right[i].name +
                                    ", as the lists have them; give both lists in the same order"});
            break;
        }
    if (static_cast<int>(pair.views.size()) < detail::fewest_views)
        warnings.push_back(
            {"few_pairs", true,
             "only " + std::to_string(pair.views.size()) +
                 (pair.views.size() == 1 ? " pair shows" : " pairs show") +
                 " the board in both pictures; take 10 to 20 where both cameras see all of it"});
    const Real alone = std::max(left_alone.calibration.rms, right_alone.calibration.rms);
    const std::vector<const ViewFit*> bad = detail::bad_views(pair.views);
    for (const ViewFit* view : bad)
        warnings.push_back({"bad_pair", true,
                            left[view->seen].name + " and " + right[view->seen].name +
                                " do not fit the other pairs, " + number(view->fit.rms, 2) +
                                " px rms: were they taken at the same moment?"});
    const Real limit = std::max(alone * Real::from_int(2), Real::from_ratio(1, 2));
    if (bad.empty() && limit < pair.calibration.rms)
        warnings.push_back(
            {"pairs_disagree", true,
             "each camera fits alone to " + number(alone, 2) + " px, both together only to " +
                 number(pair.calibration.rms, 2) +
                 " px: pictures of a pair must be of one moment, and the cameras must not move "
                 "against each other"});
}

}  // namespace fovea::apps
