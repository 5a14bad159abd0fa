// SPDX-License-Identifier: MIT
//
// fovea camera: what a calibration says, and the same in another format.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <fovea/base/status.hpp>
#include <fovea/stereo/rectify.hpp>

#include <camera/load_camera.hpp>
#include <camera/rectified_pair.hpp>
#include <common/arguments.hpp>
#include <common/io.hpp>
#include <common/text.hpp>

namespace fovea::apps {

inline Command camera_help() {
    return {
        "camera",
        "FILE",
        "Tells what a calibration says, or writes it in another format.",
        {{"to", "toml|ivt|opencv|chip", "the format to write"},
         {"out", "FILE", "where to, also -o; - for the standard output"},
         {"json", "", "one line of JSON"}},
        "FILE is a camera.toml, the toolkit's text, OpenCV's YAML, or the bytes of a chip; which one is "
        "seen\n"
        "from what it holds. OpenCV's two files of a pair are given with a comma between their names.\n"
        "\n"
        "camera.toml begins with format = 1. Each [[camera]], one or two, has\n"
        "  fx fy cx cy          focal lengths and principal point in px; the first pixel's centre is 0\n"
        "  k1 k2 k3 p1 p2       the lens; 0 if left out\n"
        "  size                 [width, height] of its pictures in px\n"
        "  rotation translation into its coordinates, rows of the rotation; of a pair from the first\n"
        "                       camera's to the second's if the first has none\n"
        "  rms_px               of the calibration; stereo_rms_px stands in front of the cameras\n"
        "  fx_deviation ...     one standard deviation of each parameter\n"
        "The toolkit's text holds no k3. `chip` is 106 bytes for a camera, 320 for a pair, with a checksum:\n"
        "`unpack_cameras()` reads them.\n"};
}

namespace detail {

/// Why a file cannot be written so, and if it can, its text.
inline std::string written_camera(const CameraFile& file, const std::string& name, CameraFormat format,
                                  std::string& text) {
    if (format == CameraFormat::toml) {
        text = camera_toml(file);
        return "";
    }
    if (file.stereo() && !file.related)
        return name + " does not say how its cameras stand to each other; give the file with R and T too";
    if (format == CameraFormat::opencv) {
        const std::string refusal = opencv_refusal(file);
        if (refusal.empty()) text = camera_opencv(file);
        return refusal.empty() ? "" : name + ": " + refusal;
    }
    if (format == CameraFormat::chip) {
        text = camera_chip(file);
        return text.empty() ? name + ": numbers too small for the bytes of a chip" : "";
    }
    if (const std::string refusal = ivt_refusal(file); !refusal.empty()) return name + ": " + refusal;
    Matrix<3, 3> rectified[2];
    if (file.stereo()) {
        if (file.cameras[0].size != file.cameras[1].size)
            return name + ": its cameras have pictures of two sizes, which are not rectified";
        std::string problem;
        const Result<Rectification<>> pair =
            rectified_pair(file, name, file.cameras[0].size, RectifyOptions::Zoom::focal_length, problem);
        if (!pair) return problem;
        for (std::size_t i = 0; i < 2; ++i) {
            const Result<Matrix<3, 3>> homography = rectifying_homography(
                file.cameras[i].camera, i == 0 ? pair->left : pair->right, pair->camera);
            if (!homography || (*homography)(2, 2).zero()) return name + ": the pair cannot be rectified";
            rectified[i] = *homography;
        }
    }
    text = camera_ivt(file, rectified);
    return "";
}

inline std::string camera_line(const CameraRecord& record) {
    const Camera<>& c = record.camera;
    std::string text = (record.size.empty() ? "size unknown" : size_text(record.size)) + ", " + view_text(c) +
                       "; k1 " + real_text(c.k1, 5) + ", k2 " + real_text(c.k2, 5) + ", k3 " +
                       real_text(c.k3, 5) + ", p1 " + real_text(c.p1, 5) + ", p2 " + real_text(c.p2, 5);
    if (record.rms_px) text += "; rms " + real_text(*record.rms_px, 5) + " px";
    return text;
}

inline std::string camera_json(const CameraRecord& record) {
    std::string text = "{";
    if (!record.size.empty())
        text += "\"width_px\":" + std::to_string(record.size.width) +
                ",\"height_px\":" + std::to_string(record.size.height) + ",";
    const auto parameters = [&](const Camera<>& camera) {
        std::string list;
        for (const CameraParameter& parameter : camera_parameters)
            list += std::string(list.empty() ? "" : ",") + "\"" + parameter.name +
                    (parameter.required ? "_px" : "") + "\":" + real_text(camera.*parameter.member, 17);
        return list;
    };
    text += parameters(record.camera);
    if (record.rms_px) text += ",\"rms_px\":" + real_text(*record.rms_px, 17);
    if (record.deviations) text += ",\"deviations\":{" + parameters(*record.deviations) + "}";
    return text + "}";
}

inline std::string camera_summary(const CameraFile& file, const std::string& name, bool json) {
    std::string text;
    if (json) {
        text = "{\"schema\":1,\"file\":" + json_string(name) +
               ",\"format\":" + json_string(describe(file.format)) + ",\"cameras\":[";
        for (std::size_t i = 0; i < file.cameras.size(); ++i)
            text += (i > 0 ? "," : "") + camera_json(file.cameras[i]);
        text += "]";
        if (file.stereo_rms_px) text += ",\"stereo_rms_px\":" + real_text(*file.stereo_rms_px, 17);
        if (file.stereo() && file.related) {
            const Pose<> pose = file.right_from_left();
            for (int i = 0; i < 9; ++i)
                text += (i == 0 ? ",\"rotation\":[" : ",") + real_text(pose.rotation(i / 3, i % 3), 17);
            for (int i = 0; i < 3; ++i)
                text += (i == 0 ? "],\"translation\":[" : ",") + real_text(pose.translation[i], 17);
            text += "]";
        }
        return text + "}\n";
    }
    text = name + ": " + describe(file.format) + ", " + (file.stereo() ? "a pair" : "one camera") + "\n";
    for (const CameraRecord& record : file.cameras) text += "  " + camera_line(record) + "\n";
    if (file.stereo() && file.related) {
        const Vector<3> t = file.right_from_left().translation;
        text += "  from the first to the second: translation " + real_text(t[0], 6) + ", " +
                real_text(t[1], 6) + ", " + real_text(t[2], 6);
        if (file.stereo_rms_px) text += "; rms " + real_text(*file.stereo_rms_px, 5) + " px";
        text += "\n";
    }
    return text;
}

}  // namespace detail

/// Runs the command with the words behind its name.
template <class Io>
ExitCode camera_command(Io& io, const std::vector<std::string>& words) {
    const Arguments arguments(camera_help(), words);
    if (arguments.has("help")) {
        io.print(help_of(camera_help()));
        return exit_ok;
    }
    std::string problem = arguments.problem();
    const std::string to = arguments.value("to");
    const std::string out = arguments.value("out");
    const std::vector<std::string> formats = {"toml", "ivt", "opencv", "chip"};
    const auto chosen = std::find(formats.begin(), formats.end(), to);
    if (problem.empty() && arguments.operands().size() != 1) problem = "which calibration? give one FILE";
    if (problem.empty() && arguments.has("to") && chosen == formats.end())
        problem = "--to takes " + listed(formats, "or") + ", not '" + one_line(to) + "'";
    if (problem.empty() && arguments.has("to") != arguments.has("out"))
        problem = arguments.has("to") ? "where to? give --out FILE"
                                      : "--out wants the format: --to " + listed(formats, "or");
    if (problem.empty() && arguments.has("to") && arguments.has("json"))
        problem = "--json tells, --to writes; give one of them";
    if (!problem.empty()) {
        io.complain("fovea camera: " + problem);
        return exit_failed;
    }
    const std::string name = arguments.operands()[0];
    CameraFile file;
    if (!load_camera(io, name, file)) return exit_failed;
    if (!arguments.has("to")) {
        io.print(detail::camera_summary(file, name, arguments.has("json")));
        return exit_ok;
    }
    const CameraFormat kinds[] = {CameraFormat::toml, CameraFormat::ivt, CameraFormat::opencv,
                                  CameraFormat::chip};
    std::string text;
    problem = detail::written_camera(file, name, kinds[chosen - formats.begin()], text);
    if (problem.empty())
        if (const Status status = io.storage().save(out.c_str(), bytes_of(text)); status != Status::ok)
            problem = file_problem(out, status, io.storage());
    if (!problem.empty()) {
        io.complain(problem);
        return exit_failed;
    }
    if (out != "-") io.print("wrote " + out + "\n");
    return exit_ok;
}

}  // namespace fovea::apps
