// SPDX-License-Identifier: MIT
//
// What a calibration says: for people, and as JSON.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include <fovea/camera/calibration.hpp>

#include <calibrate/calibration_warnings.hpp>
#include <calibrate/camera_estimate.hpp>
#include <calibrate/figures.hpp>
#include <calibrate/seen_board.hpp>
#include <camera/camera_file.hpp>

namespace fovea::apps {

// ---- For people -------------------------------------------------------------------

namespace detail {

inline std::string padded(std::string text, std::size_t width) {
    if (text.size() < width) text += std::string(width - text.size(), ' ');
    return text;
}
inline std::string right_aligned(const std::string& text, std::size_t width) {
    return text.size() < width ? std::string(width - text.size(), ' ') + text : text;
}

/// A length of micrometres in mm.
inline Real millimetres(const Real& micrometres) { return micrometres / Real::from_int(1000); }

/// Between the normal of a board and the way the camera looks.
inline Decimal tilt_of(const ViewFit& view) {
    const Decimal angle = degrees_between(normal_of(view), Vector<3>(Real(), Real(), Real::one()));
    const Decimal other = Decimal::from_int(180) - angle;
    return std::min(angle, other);
}
/// Of the board's middle.
inline Real distance_of(const ViewFit& view) { return millimetres(length_of(view.middle)); }

/// Names without their folders, where that leaves them different.
inline std::vector<std::string> short_names(const std::vector<SeenBoard>& boards) {
    std::vector<std::string> names;
    for (const SeenBoard& board : boards) names.push_back(board.name.substr(board.name.rfind('/') + 1));
    std::vector<std::string> sorted = names;
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end()) return names;
    for (std::size_t i = 0; i < boards.size(); ++i) names[i] = boards[i].name;
    return names;
}

inline std::string table_of_views(const std::vector<SeenBoard>& boards, const std::vector<ViewFit>& views) {
    std::size_t width = 4;
    const std::vector<std::string> names = short_names(boards);
    for (const ViewFit& view : views) width = std::max(width, names[view.seen].size());
    std::string text = "  " + padded("view", width) + "  rms px  worst px  tilt deg  distance mm\n";
    for (const ViewFit& view : views)
        text += "  " + padded(names[view.seen], width) + right_aligned(number(view.fit.rms, 3), 8) +
                right_aligned(number(view.worst, 2), 10) + right_aligned(number(tilt_of(view), 0), 10) +
                right_aligned(number(distance_of(view), 0), 13) + "\n";
    return text;
}

}  // namespace detail

/// A camera with its deviations.
inline std::string human_camera(const Camera<>& camera, const Camera<>& deviation, Size picture,
                                LensTerms lens) {
    std::string text;
    for (const CameraParameter& parameter : camera_parameters) {
        const std::string name = parameter.name;
        const bool pixels = parameter.required;
        // What is neither estimated nor there.
        if (!pixels && (deviation.*parameter.member).zero() && (camera.*parameter.member).zero()) continue;
        const std::string value = with_deviation(camera.*parameter.member, deviation.*parameter.member);
        text += "  " + name + "  " + value + (pixels ? " px" : "") + "\n";
    }
    if (lens == LensTerms::none) text += "  lens without distortion, as asked for\n";
    const FieldOfView field = field_of_view(camera, picture);
    return text + "  sees " + number(field.across, 1) + " x " + number(field.down, 1) + " degrees, " +
           number(field.diagonal, 1) + " from corner to corner\n";
}

/// One camera, its views, and what the rms means.
inline std::string human_estimate(const std::string& who, const std::vector<SeenBoard>& boards,
                                  const CameraEstimate& estimate, LensTerms lens) {
    std::size_t points = 0;
    for (const ViewFit& view : estimate.views) points += view.residuals.size();
    const PlanarCalibration<>& found = estimate.calibration;
    return who + " of " + board_text(estimate.picture) + " px, from " +
           std::to_string(estimate.views.size()) + " of " + std::to_string(boards.size()) + " views with " +
           std::to_string(points) + " corners\n" +
           human_camera(found.camera, found.deviation, estimate.picture, lens) + "  rms " +
           number(found.rms, 3) +
           " px: how far corners are, on average, from where this camera would see them\n\n" +
           detail::table_of_views(boards, estimate.views);
}

/// How the cameras of a pair stand to each other.
inline std::string human_pair(const PairEstimate& pair, const std::vector<SeenBoard>& left,
                              const StereoOptions& options, Size left_picture, Size right_picture) {
    const StereoCalibration<>& found = pair.calibration;
    const Vector<3>& t = found.right_from_left.translation;
    const auto mm = [&](int axis) {
        return with_deviation(detail::millimetres(t[axis]),
                              detail::millimetres(found.translation_deviation[axis]));
    };
    std::string text =
        "both, from " + std::to_string(pair.views.size()) + " of " + std::to_string(left.size()) + " pairs\n";
    if (options.intrinsics == StereoOptions::Intrinsics::estimated)
        text += " left\n" +
                human_camera(found.left, found.left_deviation, left_picture, options.estimated.lens) +
                " right\n" +
                human_camera(found.right, found.right_deviation, right_picture, options.estimated.lens);
    text += "  the right camera is " + number(detail::millimetres(length_of(t)), 2) +
            " mm from the left one, and turned by " + number(degrees_of(found.right_from_left.rotation), 2) +
            " degrees\n";
    text += "  from left to right coordinates: x " + mm(0) + ", y " + mm(1) + ", z " + mm(2) + " mm\n";
    text += "  rms " + number(found.rms, 3) + " px over the corners of both\n\n";
    return text + detail::table_of_views(left, pair.views);
}

/// The last line: whether to rely on it.
inline std::string human_judgement(const CalibrationWarnings& warnings) {
    if (doubtful(warnings)) return "doubtful: mind the warnings before you measure with it\n";
    return warnings.empty() ? "good: nothing speaks against this calibration\n"
                            : "usable; the warnings say how it becomes better\n";
}

// ---- For machines -----------------------------------------------------------------

namespace detail {

inline std::string json_camera(const Camera<>& camera, bool rough) {
    std::string text;
    for (const CameraParameter& parameter : camera_parameters)
        text += std::string(text.empty() ? "{" : ",") + "\"" + parameter.name + "\":" +
                (rough ? json_rough(camera.*parameter.member) : json_number(camera.*parameter.member));
    return text + "}";
}
template <int Count>
std::string json_vector(const Vector<Count>& vector, bool rough) {
    std::string text = "[";
    for (int i = 0; i < Count; ++i)
        text += (i > 0 ? "," : "") + (rough ? json_rough(vector[i]) : json_number(vector[i]));
    return text + "]";
}
inline Vector<3> in_millimetres(Vector<3> vector) {
    for (int i = 0; i < 3; ++i) vector[i] = millimetres(vector[i]);
    return vector;
}
inline std::string json_rotation(const Matrix<3, 3>& r) {
    std::string text = "[";
    for (int i = 0; i < 9; ++i) text += (i > 0 ? "," : "") + json_number(r(i / 3, i % 3));
    return text + "]";
}
inline std::string json_pose(const ViewFit& view) {
    return ",\"residual_px\":" + json_number(view.fit.rms) + ",\"worst_px\":" + json_rough(view.worst) +
           ",\"tilt_deg\":" + number(tilt_of(view), 2) + ",\"distance_mm\":" + json_rough(distance_of(view)) +
           ",\"rotation\":" + json_rotation(view.fit.pose.rotation) +
           ",\"translation_mm\":" + json_vector(in_millimetres(view.fit.pose.translation), false);
}
inline const ViewFit* fit_of(const std::vector<ViewFit>& views, std::size_t seen) {
    for (const ViewFit& view : views)
        if (view.seen == seen) return &view;
    return nullptr;
}

}  // namespace detail

/// A line a picture. camera is "left" or "right", "" if there is one alone.
inline std::string json_views(const std::string& camera, const std::vector<SeenBoard>& boards,
                              const std::vector<ViewFit>& views) {
    std::string text;
    for (std::size_t i = 0; i < boards.size(); ++i) {
        const SeenBoard& board = boards[i];
        text += "{\"view\":" + std::to_string(i) +
                (camera.empty() ? "" : ",\"camera\":" + json_string(camera)) +
                ",\"image\":" + json_string(board.name) + ",\"found\":" + (board.found ? "true" : "false") +
                ",\"used\":" + (board.used ? "true" : "false") +
                ",\"corners\":" + std::to_string(board.corners.size());
        if (!board.reason.empty()) text += ",\"reason\":" + json_string(board.reason);
        const ViewFit* const fit = detail::fit_of(views, i);
        if (fit != nullptr && !fit->residuals.empty()) text += detail::json_pose(*fit);
        text += "}\n";
    }
    return text;
}

/// The keys of one camera, without braces.
inline std::string json_estimate(const std::vector<SeenBoard>& boards, const CameraEstimate& estimate,
                                 const Camera<>& camera, const Camera<>& deviation) {
    const FieldOfView field = field_of_view(camera, estimate.picture);
    return "\"rms_px\":" + json_number(estimate.calibration.rms) +
           ",\"views\":" + std::to_string(boards.size()) +
           ",\"views_used\":" + std::to_string(estimate.views.size()) +
           ",\"width_px\":" + std::to_string(estimate.picture.width) +
           ",\"height_px\":" + std::to_string(estimate.picture.height) +
           ",\"camera\":" + detail::json_camera(camera, false) +
           ",\"deviations\":" + detail::json_camera(deviation, true) + ",\"field_of_view_deg\":[" +
           number(field.across, 3) + "," + number(field.down, 3) + "," + number(field.diagonal, 3) + "]";
}

inline std::string json_warnings(const CalibrationWarnings& warnings) {
    std::string text = "\"warnings\":[";
    for (const CalibrationWarning& warning : warnings)
        text += std::string(text.back() == '[' ? "" : ",") + "{\"code\":" + json_string(warning.code) +
                ",\"doubtful\":" + (warning.doubtful ? "true" : "false") +
                ",\"text\":" + json_string(warning.text) + "}";
    return text + "],\"doubtful\":" + (doubtful(warnings) ? "true" : "false");
}

/// The last line of a pair.
inline std::string json_pair(const std::vector<SeenBoard>& left_boards,
                             const std::vector<SeenBoard>& right_boards, const CameraEstimate& left,
                             const CameraEstimate& right, const PairEstimate& pair, bool held,
                             const CalibrationWarnings& warnings) {
    const StereoCalibration<>& found = pair.calibration;
    const auto one = [&](const std::vector<SeenBoard>& boards, const CameraEstimate& alone,
                         const Camera<>& camera, const Camera<>& deviation) {
        return "{" + json_estimate(boards, alone, camera, held ? alone.calibration.deviation : deviation) +
               "}";
    };
    return "{\"rms_px\":" + json_number(found.rms) + ",\"views\":" + std::to_string(left_boards.size()) +
           ",\"views_used\":" + std::to_string(pair.views.size()) +
           ",\"rotation\":" + detail::json_rotation(found.right_from_left.rotation) + ",\"translation_mm\":" +
           detail::json_vector(detail::in_millimetres(found.right_from_left.translation), false) +
           ",\"rotation_deviation_rad\":" + detail::json_vector(found.rotation_deviation, true) +
           ",\"translation_deviation_mm\":" +
           detail::json_vector(detail::in_millimetres(found.translation_deviation), true) +
           ",\"left\":" + one(left_boards, left, found.left, found.left_deviation) +
           ",\"right\":" + one(right_boards, right, found.right, found.right_deviation) + "," +
           json_warnings(warnings) + "}\n";
}

}  // namespace fovea::apps
