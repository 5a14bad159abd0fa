// SPDX-License-Identifier: MIT
//
// fovea rectify: a pair of pictures turned so that what one shows in a row, the other shows in the same row.
#pragma once

#include <string>
#include <vector>

#include <fovea/draw/line.hpp>
#include <fovea/stereo/rectify.hpp>

#include <camera/load_camera.hpp>
#include <camera/new_picture.hpp>
#include <camera/rectified_pair.hpp>
#include <camera/undistort_command.hpp>
#include <common/arguments.hpp>
#include <common/io.hpp>

namespace fovea::apps {

inline Command rectify_help() {
    return {
        "rectify",
        "--camera FILE LEFT RIGHT",
        "Turns a pair of pictures so that both show a thing in one row.",
        {{"camera", "FILE",
          "the calibration of the pair; two files with a comma between\nthem are read as one; required"},
         {"out", "LEFT,RIGHT", "where to, also -o.\nNot given: LEFT-rectified.png and RIGHT-rectified.png"},
         {"zoom", "all|valid|same",
          "all keeps every pixel, valid leaves no pixel empty, same has\nthe cameras' focal length; same"},
         {"picture", "PICTURE", "both beside each other with lines along the rows, to look at"},
         {"json", "", "one line of JSON"}},
        "The lens's distortion is taken out on the way. Cameras above each other are turned so that\n"
        "columns agree.\n"};
}

namespace detail {

inline Picture<Rgb888> in_colour(const FilePicture& picture) {
    if (picture.colour) return picture.rgb;
    Picture<Rgb888> result(picture.gray.size);
    for (std::size_t i = 0; i < result.pixels.size(); ++i) {
        const Gray8 level = picture.gray.pixels[i];
        result.pixels[i] = {level, level, level};
    }
    return result;
}

/// Both pictures side by side, or above each other, with lines along what agrees.
inline Picture<Rgb888> side_by_side(const FilePicture& left, const FilePicture& right, StereoAxis axis) {
    const Size size = left.size();
    const bool rows = axis == StereoAxis::x;
    Picture<Rgb888> sheet(rows ? Size{2 * size.width, size.height} : Size{size.width, 2 * size.height});
    const Picture<Rgb888> halves[2] = {in_colour(left), in_colour(right)};
    for (int y = 0; y < sheet.size.height; ++y)
        for (int x = 0; x < sheet.size.width; ++x)
            sheet.view()(x, y) =
                halves[rows ? x / size.width : y / size.height].view()(x % size.width, y % size.height);
    const Rgb888 colours[2] = {{255, 220, 0}, {0, 220, 255}};
    const int length = rows ? size.height : size.width;
    const int step = maximum(length / 16, 8);
    for (int at = step / 2, i = 0; at < length; at += step, ++i) {
        const Point from = rows ? Point{0, at} : Point{at, 0};
        const Point to = rows ? Point{sheet.size.width - 1, at} : Point{at, sheet.size.height - 1};
        static_cast<void>(draw_line(sheet.view(), from, to, colours[i % 2]));
    }
    return sheet;
}

inline std::string rectify_problem(const Arguments& arguments, std::vector<std::string>& outs, Zoom& zoom) {
    const std::vector<std::string>& names = arguments.operands();
    std::string problem = arguments.problem();
    if (problem.empty() && names.size() != 2) problem = "needs two pictures: LEFT RIGHT";
    if (problem.empty() && !arguments.has("camera")) problem = "which cameras? give --camera FILE";
    if (problem.empty()) zoom_option(arguments, zoom, problem);
    if (!problem.empty()) return problem;
    outs = {named_after(names[0], "rectified"), named_after(names[1], "rectified")};
    if (arguments.has("out")) {
        outs = split(arguments.value("out"), ',');
        if (outs.size() != 2 || outs[0].empty() || outs[1].empty())
            return "--out takes two names with a comma between them: LEFT,RIGHT";
    }
    std::vector<std::string> files = outs;
    if (arguments.has("picture")) files.push_back(arguments.value("picture"));
    for (std::size_t i = 0; i < files.size(); ++i) {
        if (problem.empty()) problem = picture_name_problem(files[i]);
        if (problem.empty() && (files[i].empty() || files[i] == "-"))
            problem = "pictures are written to files; give names";
        for (std::size_t k = 0; k < i; ++k)
            if (problem.empty() && files[i] == files[k]) problem = files[i] + " would be written twice";
    }
    return problem;
}

}  // namespace detail

/// Runs the command with the words behind its name.
template <class Io>
ExitCode rectify_command(Io& io, const std::vector<std::string>& words) {
    const Arguments arguments(rectify_help(), words);
    if (arguments.has("help")) {
        io.print(help_of(rectify_help()));
        return exit_ok;
    }
    std::vector<std::string> outs;
    Zoom zoom = Zoom::same;
    std::string problem = detail::rectify_problem(arguments, outs, zoom);
    const auto failed = [&](const std::string& what) {
        io.complain(what);
        return exit_failed;
    };
    if (!problem.empty()) return failed("fovea rectify: " + problem);
    const std::string camera_name = arguments.value("camera");
    CameraFile file;
    if (!load_camera(io, camera_name, file)) return exit_failed;
    FilePicture pictures[2];
    for (std::size_t i = 0; i < 2; ++i)
        if (!load_file_picture(io.storage(), arguments.operands()[i], pictures[i], problem))
            return failed(problem);
    const Size size = pictures[0].size();
    for (std::size_t i = 0; i < 2; ++i) {
        const Size expected =
            i < file.cameras.size() && !file.cameras[i].size.empty() ? file.cameras[i].size : size;
        if (pictures[i].size() != expected)
            return failed(arguments.operands()[i] + " is " + size_text(pictures[i].size()) + ", expected " +
                          size_text(expected) + "; give pictures of the size that " + camera_name +
                          " was made with");
    }
    const RectifyOptions::Zoom zooms[] = {RectifyOptions::Zoom::focal_length, RectifyOptions::Zoom::valid,
                                          RectifyOptions::Zoom::all};
    const Result<Rectification<>> pair =
        rectified_pair(file, camera_name, size, zooms[static_cast<int>(zoom)], problem);
    if (!pair) return failed(problem);

    std::int64_t empty[2] = {};
    FilePicture made[2];
    for (std::size_t i = 0; i < 2; ++i) {
        PictureMap map;
        const Status status =
            make_map(LensInverse<>(file.cameras[i].camera), i == 0 ? pair->left : pair->right, pair->camera,
                     size, pair->size, map);
        if (status != Status::ok)
            return failed(camera_name + ": no picture can be made with camera " + std::to_string(i + 1) +
                          ": " + describe(status));
        made[i] = mapped(pictures[i], map);
        empty[i] = map.empty_pixels;
        if (!save_file_picture(io.storage(), outs[i], made[i], problem)) return failed(problem);
    }
    const std::string picture = arguments.value("picture");
    if (!picture.empty() &&
        !save_picture(io.storage(), picture, detail::side_by_side(made[0], made[1], pair->axis), problem))
        return failed(problem);

    const bool rows = pair->axis == StereoAxis::x;
    if (arguments.has("json")) {
        io.print("{\"schema\":1,\"left\":" + json_string(outs[0]) + ",\"right\":" + json_string(outs[1]) +
                 ",\"width_px\":" + std::to_string(pair->size.width) +
                 ",\"height_px\":" + std::to_string(pair->size.height) + "," + view_json(pair->camera) +
                 ",\"baseline\":" + real_text(pair->baseline, 9) + ",\"axis\":\"" + (rows ? "x" : "y") +
                 "\",\"empty_pixels\":[" + std::to_string(empty[0]) + "," + std::to_string(empty[1]) +
                 "]}\n");
        return exit_ok;
    }
    for (std::size_t i = 0; i < 2; ++i)
        io.print("wrote " + outs[i] + ": " + std::to_string(empty[i]) + " pixels were not seen\n");
    io.print("both: " + view_text(pair->camera) + "; baseline " + real_text(pair->baseline, 6) +
             ", a thing is in one " + (rows ? "row" : "column") + " of both\n");
    return exit_ok;
}

}  // namespace fovea::apps
