// SPDX-License-Identifier: MIT
//
// Calibrations as the bytes that a chip reads: camera/packed_camera.hpp of the core.
#pragma once

#include <cstddef>
#include <string>

#include <fovea/base/status.hpp>
#include <fovea/camera/packed_camera.hpp>

#include <camera/camera_file.hpp>
#include <common/text.hpp>

namespace fovea::apps {

/// Reads what pack_cameras() wrote.
inline CameraFile read_camera_chip(const std::string& text) {
    CameraFile file;
    file.format = CameraFormat::chip;
    CameraSet set;
    const Status status = unpack_cameras(bytes_of(text), set);
    if (status != Status::ok) {
        file.problem = std::string("bytes of a calibration, but ") + describe(status);
        if (status == Status::unsupported) file.problem = "bytes of a calibration of another version";
        return file;
    }
    file.cameras.resize(static_cast<std::size_t>(set.count));
    for (std::size_t i = 0; i < file.cameras.size(); ++i) {
        file.cameras[i].size = set.sizes[i];
        file.cameras[i].camera = set.cameras[i];
    }
    if (file.stereo()) file.cameras[1].pose = set.right_from_left;
    for (const CameraRecord& record : file.cameras)
        if (file.problem.empty()) file.problem = camera_problem(record);
    return file;
}

/// The bytes.
inline std::string camera_chip(const CameraFile& file) {
    CameraSet set;
    set.count = file.stereo() ? 2 : 1;
    for (int i = 0; i < set.count; ++i) {
        const CameraRecord& record = file.cameras[static_cast<std::size_t>(i)];
        set.sizes[i] = record.size;
        set.cameras[i] = record.camera;
    }
    if (file.stereo()) set.right_from_left = file.right_from_left();
    std::uint8_t bytes[packed_camera_bytes(2)];
    // Only numbers that are 0 but for their name are refused: below 2^-200.
    const Result<std::ptrdiff_t> size = pack_cameras(set, bytes);
    return size ? std::string(bytes, bytes + *size) : "";
}

}  // namespace fovea::apps
