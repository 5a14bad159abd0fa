// SPDX-License-Identifier: MIT
//
// Cameras from a storage, whatever the format, with a word on what is wrong with them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/camera/packed_camera.hpp>
#include <fovea/codec/any_picture.hpp>

#include <camera/camera_file.hpp>
#include <camera/chip_camera.hpp>
#include <camera/ivt_camera.hpp>
#include <camera/opencv_camera.hpp>
#include <camera/toml_camera.hpp>
#include <common/io.hpp>
#include <common/text.hpp>

namespace fovea::apps {

/// Which format a text has, by what it begins with or holds.
inline CameraFormat camera_format(const std::string& text) {
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first == std::string::npos) return CameraFormat::unknown;
    if (text.compare(0, 5, "%YAML") == 0) return CameraFormat::opencv;
    if (text.compare(0, 4, "FVCM") == 0) return CameraFormat::chip;
    // A number, and behind it another one: nothing of the kind begins TOML or YAML.
    const std::size_t behind = text.find_first_of(" \t\r\n", first);
    const std::size_t second =
        behind == std::string::npos ? behind : text.find_first_not_of(" \t\r\n", behind);
    const auto figure = [&](std::size_t at) {
        return at != std::string::npos && text[at] >= '0' && text[at] <= '9';
    };
    if (figure(first) && figure(second)) return CameraFormat::ivt;
    for (const std::string& line : split(text, '\n')) {
        if (line.compare(0, 10, "[[camera]]") == 0 || line.compare(0, 6, "format") == 0)
            return CameraFormat::toml;
        if (line.compare(0, 14, "camera_matrix:") == 0 || line.compare(0, 3, "M1:") == 0)
            return CameraFormat::opencv;
    }
    return CameraFormat::unknown;
}

/// Reads a calibration from a text in any of the formats.
inline CameraFile read_camera(const std::string& text) {
    switch (camera_format(text)) {
        case CameraFormat::toml: return read_camera_toml(text);
        case CameraFormat::ivt: return read_camera_ivt(text);
        case CameraFormat::opencv: return read_camera_opencv(text);
        case CameraFormat::chip: return read_camera_chip(text);
        case CameraFormat::unknown: break;
    }
    CameraFile file;
    if (text.empty())
        file.problem = "the file is empty";
    else if (text.find("<opencv_storage>") != std::string::npos)
        file.problem = "OpenCV's XML, which fovea does not read; write the calibration to a .yml";
    else
        file.problem =
            "not a calibration that fovea reads: a camera.toml, the toolkit's text, or OpenCV's YAML";
    return file;
}

/// Reads a calibration by its name, or from two files with a comma between their names. False, and complained
/// about, if there is none.
template <class Io>
bool load_camera(Io& io, const std::string& name, CameraFile& file) {
    std::string text;
    // Lines of the file that a problem stands in.
    std::string problem_name = name;
    std::vector<std::pair<std::string, int>> parts;
    int lines = 0;
    for (const std::string& part : split(name, ',')) {
        const Result<Span<const std::uint8_t>> bytes = io.storage().load(part.c_str());
        if (!bytes) {
            io.complain(file_problem(part, bytes.status(), io.storage()));
            return false;
        }
        if (picture_format(*bytes) != PictureFormat::unknown) {
            io.complain(part +
                        ": a picture, not a calibration; --camera takes a camera.toml, the toolkit's text, "
                        "or OpenCV's YAML");
            return false;
        }
        parts.emplace_back(part, lines);
        std::string content(bytes->begin(), bytes->end());
        if (!content.empty() && content.back() != '\n' && parts.size() < split(name, ',').size())
            content += '\n';
        for (const char c : content) lines += c == '\n' ? 1 : 0;
        text += content;
    }
    file = read_camera(text);
    if (file.problem.empty()) return true;
    int line = file.place.line;
    for (const auto& [part, before] : parts)
        if (file.place.line > before) {
            problem_name = part;
            line = file.place.line - before;
        }
    const bool placed = file.format != CameraFormat::unknown && file.format != CameraFormat::chip;
    io.complain(problem_name +
                (placed ? ":" + std::to_string(line) + ":" + std::to_string(file.place.column) : "") + ": " +
                file.problem);
    return false;
}

}  // namespace fovea::apps
