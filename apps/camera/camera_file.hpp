// SPDX-License-Identifier: MIT
//
// CameraFile: what a calibration says of one camera or of a pair, whatever the format of its file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <fovea/camera/camera.hpp>
#include <fovea/camera/pose.hpp>
#include <fovea/codec/toml.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/number/real.hpp>
#include <fovea/number/real_text.hpp>
#include <fovea/stereo/stereo_camera.hpp>

#include <common/text.hpp>

namespace fovea::apps {

/// One camera of a file.
struct CameraRecord {
    /// Of its pictures; 0x0 if the file does not say.
    Size size;
    Camera<> camera;
    /// From the world to the camera. Of a pair whose file has no world, the first has none and the second
    /// leads from the first camera's coordinates to its own.
    Pose<> pose;
    /// One standard deviation of each parameter, where the calibration told them.
    std::optional<Camera<>> deviations;
    /// Root of the mean squared distance of the calibration's points, in pixels.
    std::optional<Real> rms_px;
};

enum class CameraFormat : std::uint8_t { unknown, toml, ivt, opencv, chip };

struct CameraFile {
    CameraFormat format = CameraFormat::unknown;
    /// One or two.
    std::vector<CameraRecord> cameras;
    std::optional<Real> stereo_rms_px;
    /// The file says how two cameras stand to each other.
    bool related = true;
    TextPlace place;      ///< of the problem
    std::string problem;  ///< "" if the file is good

    bool stereo() const { return cameras.size() == 2; }
    /// From the first camera's coordinates to the second's, to the last digit of the file if it says just
    ///      that.
    Pose<> right_from_left() const {
        const Pose<>& left = cameras[0].pose;
        if (left.rotation == Matrix<3, 3>::identity() && left.translation == Vector<3>())
            return cameras[1].pose;
        // Both are rotations, and so is their product.
        const Result<Pose<>> pose = fovea::right_from_left(left, cameras[1].pose);
        return pose ? *pose : Pose<>();
    }
    StereoCamera<> pair() const { return {cameras[0].camera, cameras[1].camera, right_from_left()}; }
};

inline const char* describe(CameraFormat format) {
    switch (format) {
        case CameraFormat::toml: return "fovea's TOML";
        case CameraFormat::ivt: return "the toolkit's text";
        case CameraFormat::opencv: return "OpenCV's YAML";
        case CameraFormat::chip: return "bytes for a chip";
        case CameraFormat::unknown: break;
    }
    return "unknown";
}

/// A parameter of a camera, as formats call it.
struct CameraParameter {
    const char* name;
    Real Camera<>::*member;
    bool required;
    const char* text;
};

inline constexpr CameraParameter camera_parameters[] = {
    {"fx", &Camera<>::fx, true, "focal length across, in px"},
    {"fy", &Camera<>::fy, true, "focal length down, in px"},
    {"cx", &Camera<>::cx, true, "principal point, in px; the first pixel's centre is 0"},
    {"cy", &Camera<>::cy, true, "principal point, in px"},
    {"k1", &Camera<>::k1, false, "radial term with r^2"},
    {"k2", &Camera<>::k2, false, "radial term with r^4"},
    {"k3", &Camera<>::k3, false, "radial term with r^6"},
    {"p1", &Camera<>::p1, false, "first tangential term"},
    {"p2", &Camera<>::p2, false, "second tangential term"},
};

/// A number with so many digits.
inline std::string real_text(Real value, int digits) {
    char buffer[8 + whole_real_digits];
    const Result<int> length = print_real(value, digits, buffer);
    return length ? std::string(buffer, static_cast<std::size_t>(*length)) : "0";
}
/// The shortest text that is read as the same number.
inline std::string exact_text(Real value) {
    for (int digits = 1; digits < whole_real_digits; ++digits) {
        std::string text = real_text(value, digits);
        const Result<Real> read = parse_real(span_of(text));
        if (read && *read == value) return text;
    }
    return real_text(value, whole_real_digits);
}

/// What is wrong with a camera that was read, "" if it can be worked with: numbers are of a size that cameras
/// have, a rotation is one.
inline std::string camera_problem(const CameraRecord& record) {
    const Real most = Real::from_int(1000000000);
    for (const CameraParameter& parameter : camera_parameters) {
        const Real value = record.camera.*parameter.member;
        if (parameter.required && parameter.name[0] == 'f' && !value.positive())
            return std::string(parameter.name) + " is not above 0";
        if (most < value.absolute())
            return std::string(parameter.name) + " is " + real_text(value, 6) + ": absurd";
    }
    if (!is_rotation(record.pose.rotation))
        return "the rotation is none: its rows are not at right angles and of length 1";
    for (int i = 0; i < 3; ++i)
        if (most < record.pose.translation[i].absolute())
            return "the translation has " + real_text(record.pose.translation[i], 6) + ": absurd";
    return "";
}

}  // namespace fovea::apps
