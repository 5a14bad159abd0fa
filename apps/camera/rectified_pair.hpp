// SPDX-License-Identifier: MIT
//
// The rectification of a pair that a file describes, with a word on why there is none.
#pragma once

#include <string>

#include <fovea/base/status.hpp>
#include <fovea/stereo/rectify.hpp>

#include <camera/camera_file.hpp>
#include <camera/new_picture.hpp>

namespace fovea::apps {

/// Rectifies the pair of a file for pictures of a size. If that cannot be, problem says why.
inline Result<Rectification<>> rectified_pair(const CameraFile& file, const std::string& name, Size size,
                                              RectifyOptions::Zoom zoom, std::string& problem) {
    if (!file.stereo()) {
        problem =
            name + " has one camera; a pair is calibrated with `fovea calibrate --left ... --right ...`";
        return Status::bad_argument;
    }
    if (!file.related) {
        problem = name +
                  " does not say how the cameras stand to each other; give the file with R and T too: "
                  "--camera INTRINSICS,EXTRINSICS";
        return Status::bad_argument;
    }
    RectifyOptions options;
    options.zoom = zoom;
    const Result<Rectification<>> pair = rectify(file.pair(), size, options);
    if (pair) return pair;
    problem = name + ": the pair cannot be rectified: ";
    if (pair.status() == Status::degenerate)
        problem += "its cameras are at one place, or one looks at the other";
    else if (pair.status() == Status::out_of_range)
        problem +=
            "the lens's model ends inside of the pictures, or the cameras look apart; calibrate with corners "
            "of the board near those of the pictures";
    else
        problem += describe(pair.status());
    return pair.status();
}

}  // namespace fovea::apps
