// SPDX-License-Identifier: MIT
//
// fovea info and fovea compare: what is in a picture file, and where two differ.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <fovea/codec/any_picture.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/statistics/histogram.hpp>

#include <common/arguments.hpp>
#include <common/io.hpp>
#include <common/picture_file.hpp>

namespace fovea::apps {

inline Command info_help() {
    return {"info",
            "PICTURE...",
            "Tells what is in picture files.",
            {{"json", "", "one line of JSON for each picture"}},
            "Levels are those of the brightness. `otsu` is the level that splits dark from bright.\n"};
}

inline Command compare_help() {
    return {
        "compare",
        "PICTURE PICTURE",
        "Tells whether two pictures have the same pixels.",
        {{"tolerance", "N", "grey levels that a channel may differ by; 0"}, {"json", "", "one line of JSON"}},
        "Ends with 0 if no channel differs by more, with 1 if one does, with 2 if they cannot be\n"
        "compared.\n"};
}

namespace detail {

inline std::string thousandths(std::int64_t sum, std::int64_t count) {
    return number({round_divide(sum * 1000, count) * 1000}, 3);
}

template <class Io>
ExitCode tell_picture(Io& io, const std::string& name, bool json) {
    Picture<Gray8> picture;
    std::string problem;
    if (!load_picture(io.storage(), name, max_image_side, picture, problem)) {
        io.complain(problem);
        return exit_failed;
    }
    // It was just read, so it is there and holds a picture.
    const Result<Span<const std::uint8_t>> bytes = io.storage().load(name.c_str());
    const PictureFormat format = bytes ? picture_format(*bytes) : PictureFormat::unknown;
    const std::ptrdiff_t length = bytes ? bytes->size() : 0;
    Histogram histogram;
    static_cast<void>(histogram_of(picture.view(), histogram));
    int low = 255;
    int high = 0;
    std::int64_t sum = 0;
    for (int level = 0; level < Histogram::levels; ++level) {
        if (histogram[level] == 0) continue;
        low = level < low ? level : low;
        high = level;
        sum += static_cast<std::int64_t>(histogram[level]) * level;
    }
    const std::string mean = thousandths(sum, picture.size.area());
    const Result<Gray8> split_level = otsu(histogram);
    const std::string otsu_text = split_level ? std::to_string(*split_level) : json ? "null" : "none";
    const std::string width = std::to_string(picture.size.width);
    const std::string height = std::to_string(picture.size.height);
    if (json)
        io.print("{\"schema\":1,\"picture\":" + json_string(name) +
                 ",\"format\":" + json_string(describe(format)) + ",\"width_px\":" + width +
                 ",\"height_px\":" + height + ",\"file_bytes\":" + std::to_string(length) +
                 ",\"least_level\":" + std::to_string(low) + ",\"greatest_level\":" + std::to_string(high) +
                 ",\"mean_level\":" + mean + ",\"otsu_level\":" + otsu_text + "}\n");
    else
        io.print(name + ": " + describe(format) + ", " + width + "x" + height + ", " +
                 std::to_string(length) + " bytes; levels " + std::to_string(low) + " to " +
                 std::to_string(high) + ", mean " + mean + ", otsu " + otsu_text + "\n");
    return exit_ok;
}

}  // namespace detail

/// Runs `fovea info` with the words behind its name.
template <class Io>
ExitCode info_command(Io& io, const std::vector<std::string>& words) {
    const Arguments arguments(info_help(), words);
    if (arguments.has("help")) {
        io.print(help_of(info_help()));
        return exit_ok;
    }
    std::string problem = arguments.problem();
    if (problem.empty() && arguments.operands().empty()) problem = "which picture?";
    if (!problem.empty()) {
        io.complain("fovea info: " + problem);
        return exit_failed;
    }
    ExitCode worst = exit_ok;
    for (const std::string& name : arguments.operands())
        worst = worse(worst, detail::tell_picture(io, name, arguments.has("json")));
    return worst;
}

/// Runs `fovea compare` with the words behind its name.
template <class Io>
ExitCode compare_command(Io& io, const std::vector<std::string>& words) {
    const Arguments arguments(compare_help(), words);
    if (arguments.has("help")) {
        io.print(help_of(compare_help()));
        return exit_ok;
    }
    std::string problem = arguments.problem();
    const std::vector<std::string>& names = arguments.operands();
    if (problem.empty() && names.size() != 2) problem = "needs two pictures";
    int tolerance = 0;
    if (problem.empty()) whole_option(arguments, "tolerance", 0, 255, tolerance, problem);
    if (!problem.empty()) {
        io.complain("fovea compare: " + problem);
        return exit_failed;
    }
    Picture<Rgb888> pictures[2];
    for (int i = 0; i < 2; ++i)
        if (!load_picture(io.storage(), names[static_cast<std::size_t>(i)], max_image_side, pictures[i],
                          problem)) {
            io.complain(problem);
            return exit_failed;
        }
    const Size size = pictures[0].size;
    if (size != pictures[1].size) {
        io.complain("fovea compare: " + names[0] + " is " + std::to_string(size.width) + "x" +
                    std::to_string(size.height) + ", " + names[1] + " is " +
                    std::to_string(pictures[1].size.width) + "x" + std::to_string(pictures[1].size.height));
        return exit_failed;
    }
    std::int64_t differing = 0;
    std::int64_t sum = 0;
    int greatest = 0;
    Point first{-1, -1};
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const Rgb888 a = pictures[0].view()(x, y);
            const Rgb888 b = pictures[1].view()(x, y);
            int most = 0;
            for (const int d : {a.red - b.red, a.green - b.green, a.blue - b.blue}) {
                sum += d < 0 ? -d : d;
                most = maximum(most, d < 0 ? -d : d);
            }
            greatest = maximum(greatest, most);
            if (most > tolerance && differing++ == 0) first = {x, y};
        }
    const std::string mean = detail::thousandths(sum, 3 * size.area());
    if (arguments.has("json"))
        io.print("{\"schema\":1,\"differing_pixels\":" + std::to_string(differing) +
                 ",\"greatest_difference\":" + std::to_string(greatest) + ",\"mean_difference\":" + mean +
                 ",\"first_x_px\":" + (differing > 0 ? std::to_string(first.x) : "null") +
                 ",\"first_y_px\":" + (differing > 0 ? std::to_string(first.y) : "null") + "}\n");
    else if (differing > 0)
        io.print(std::to_string(differing) + " of " + std::to_string(size.area()) +
                 " pixels differ by more than " + std::to_string(tolerance) + ", the first at " +
                 std::to_string(first.x) + "," + std::to_string(first.y) + "; greatest difference " +
                 std::to_string(greatest) + ", mean " + mean + "\n");
    else
        io.print(greatest == 0
                     ? "the pixels are the same\n"
                     : "no pixel differs by more than " + std::to_string(tolerance) +
                           "; greatest difference " + std::to_string(greatest) + ", mean " + mean + "\n");
    return differing > 0 ? exit_not_ok : exit_ok;
}

}  // namespace fovea::apps
