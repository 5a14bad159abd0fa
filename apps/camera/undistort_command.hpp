// SPDX-License-Identifier: MIT
//
// fovea undistort: pictures without the distortion of their lens.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <fovea/camera/fitted_view.hpp>
#include <fovea/camera/lens_inverse.hpp>

#include <camera/load_camera.hpp>
#include <camera/new_picture.hpp>
#include <common/arguments.hpp>
#include <common/io.hpp>

namespace fovea::apps {

inline Command undistort_help() {
    return {
        "undistort",
        "--camera FILE IMAGE...",
        "Takes the distortion of the lens out of pictures.",
        {{"camera", "FILE",
          "the calibration: a camera.toml, the toolkit's text, or OpenCV's\nYAML; required"},
         {"out", "PICTURE",
          "where to, also -o; of several the second becomes PICTURE-2.\nNot given: IMAGE-undistorted.png"},
         {"zoom", "all|valid|same",
          "all keeps every pixel, valid leaves no pixel empty, same has\nthe camera's focal length; same"},
         {"right", "", "the second camera of a pair"},
         {"json", "", "one line of JSON for each picture"}},
        "Pictures must have the size that the calibration was made with. What the camera did not see is\n"
        "black.\n"};
}

enum class Zoom : std::uint8_t { same, valid, all };

/// Reads --zoom. False, with a problem, for another word.
inline bool zoom_option(const Arguments& arguments, Zoom& zoom, std::string& problem) {
    const std::string word = arguments.value("zoom", "same");
    if (word == "same") zoom = Zoom::same;
    if (word == "valid") zoom = Zoom::valid;
    if (word == "all") zoom = Zoom::all;
    if (word == "same" || word == "valid" || word == "all") return true;
    problem = "--zoom takes all, valid or same, not '" + one_line(word) + "'";
    return false;
}

namespace detail {

/// The view of a zoom; the status says why there is none.
inline Result<Camera<>> zoomed_view(const LensInverse<>& lens, Zoom zoom, Size size) {
    Camera<> view;
    view.fx = lens.camera().fx;
    view.fy = lens.camera().fy;
    view.cx = lens.camera().cx;
    view.cy = lens.camera().cy;
    if (zoom == Zoom::same) return view;
    const auto bounds = visible_bounds(lens, Matrix<3, 3>::identity(), size);
    if (!bounds) return bounds.status();
    return zoom == Zoom::valid ? view_that_fills(bounds->inner, view, size)
                               : view_that_holds(bounds->outer, view, size);
}

/// Undistorts the pictures of one command.
template <class Io>
class Undistorter {
public:
    Undistorter(Io& io, const CameraRecord& record, const std::string& camera_name, Zoom zoom, bool json)
        : io_(io),
          record_(record),
          camera_name_(camera_name),
          zoom_(zoom),
          json_(json),
          lens_(record.camera) {}

    ExitCode undistort(const std::string& name, const std::string& out) {
        FilePicture picture;
        std::string problem;
        if (!load_file_picture(io_.storage(), name, picture, problem)) return failed(problem);
        const Size size = picture.size();
        if (!record_.size.empty() && size != record_.size)
            return failed(name + " is " + size_text(size) + ", the pictures of " + camera_name_ + " are " +
                          size_text(record_.size) + "; give pictures of that size");
        if (!prepare(size, problem)) return failed(problem);
        if (!save_file_picture(io_.storage(), out, mapped(picture, map_), problem)) return failed(problem);
        const std::string empty = std::to_string(map_.empty_pixels);
        if (json_)
            io_.print("{\"schema\":1,\"picture\":" + json_string(name) + ",\"out\":" + json_string(out) +
                      ",\"width_px\":" + std::to_string(size.width) +
                      ",\"height_px\":" + std::to_string(size.height) + "," + view_json(*view_) +
                      ",\"empty_pixels\":" + empty + "}\n");
        else if (out != "-")
            io_.print("wrote " + out + ": " + view_text(*view_) + "; " + empty + " pixels were not seen\n");
        return exit_ok;
    }

private:
    ExitCode failed(const std::string& problem) {
        io_.complain(problem);
        return exit_failed;
    }
    /// Makes the map, once for a size.
    bool prepare(Size size, std::string& problem) {
        if (view_ && map_.size == size) return true;
        const Result<Camera<>> view = zoomed_view(lens_, zoom_, size);
        if (view.status() == Status::out_of_range) {
            problem = camera_name_ +
                      ": the lens's model ends inside of the picture; take --zoom same, or calibrate with "
                      "corners of the board near those of the picture";
            return false;
        }
        const Status status =
            view ? make_map(lens_, Matrix<3, 3>::identity(), *view, size, size, map_) : view.status();
        if (status != Status::ok) {
            problem = camera_name_ + ": no picture can be made with this camera: " +
                      (status == Status::out_of_range ? "its numbers are absurd" : describe(status));
            return false;
        }
        view_ = *view;
        return true;
    }

    Io& io_;
    const CameraRecord& record_;
    std::string camera_name_;
    Zoom zoom_;
    bool json_;
    LensInverse<> lens_;
    std::optional<Camera<>> view_;
    PictureMap map_;
};

}  // namespace detail

/// Runs the command with the words behind its name.
template <class Io>
ExitCode undistort_command(Io& io, const std::vector<std::string>& words) {
    const Arguments arguments(undistort_help(), words);
    if (arguments.has("help")) {
        io.print(help_of(undistort_help()));
        return exit_ok;
    }
    const std::vector<std::string>& names = arguments.operands();
    const std::string out = arguments.value("out");
    std::string problem = arguments.problem();
    Zoom zoom = Zoom::same;
    if (problem.empty() && names.empty()) problem = "which picture?";
    if (problem.empty() && !arguments.has("camera")) problem = "which camera? give --camera FILE";
    if (problem.empty()) zoom_option(arguments, zoom, problem);
    if (problem.empty()) problem = picture_name_problem(out);
    if (problem.empty() && out == "-" && (names.size() > 1 || arguments.has("json")))
        problem = "--out - is for one picture without --json";
    if (!problem.empty()) {
        io.complain("fovea undistort: " + problem);
        return exit_failed;
    }
    CameraFile file;
    if (!load_camera(io, arguments.value("camera"), file)) return exit_failed;
    if (arguments.has("right") && !file.stereo()) {
        io.complain("fovea undistort: --right is for pairs, and " + arguments.value("camera") +
                    " has one camera");
        return exit_failed;
    }
    detail::Undistorter<Io> undistorter(io, file.cameras[arguments.has("right") ? 1 : 0],
                                        arguments.value("camera"), zoom, arguments.has("json"));
    ExitCode worst = exit_ok;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::string to = out.empty() ? named_after(names[i], "undistorted")
                               : i == 0    ? out
                                           : numbered(out, i + 1);
        worst = worse(worst, undistorter.undistort(names[i], to));
    }
    return worst;
}

}  // namespace fovea::apps
