// SPDX-License-Identifier: MIT
//
// What the words of `fovea calibrate` ask for.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include <fovea/camera/calibration.hpp>
#include <fovea/stereo/calibrate_stereo.hpp>

#include <calibrate/board.hpp>
#include <camera/camera_file.hpp>
#include <common/arguments.hpp>
#include <common/picture_file.hpp>
#include <common/text.hpp>

namespace fovea::apps {

inline Command calibrate_help() {
    return {
        "calibrate",
        "--board 9x6 --square MM IMAGE...",
        "Calibrates a camera, or a pair, from pictures of a board.",
        {{"board", "WxH", "columns x rows of inner corners: a board of 10x7 squares has\n9x6; required"},
         {"square", "MM", "the side of a square in mm, measured on the board; required"},
         {"out", "FILE", "write the calibration, also -o; - for the standard output"},
         {"format", "NAME",
          "of that file: toml, ivt, opencv or chip; if not given, what its name ends in says: .yml\nor .yaml "
          "is opencv, .txt ivt, .bin "
          "chip, all else toml"},
         {"left", "IMAGE...",
          "pictures of the left camera, all words up to the next option, or a\nlist with commas"},
         {"right", "IMAGE...", "pictures of the right camera at the same moments, in the same order"},
         {"free", "",
          "of a pair: estimate both cameras again, together; if not given,\nthey stay as each was calibrated "
          "alone"},
         {"pattern", "NAME",
          "checkerboard, circles or asymmetric-circles; of circles --board\ncounts them, and --square is "
          "from one to the next, of asymmetric\nones from row to row"},
         {"lens", "TERMS",
          "none, k1k2, k1k2p1p2 or k1k2k3p1p2; k1k2p1p2 if not given. More\nterms fit wide lenses closer and "
          "want more views"},
         {"fixed-aspect", "", "square pixels: fx and fy are one number"},
         {"fixed-centre", "", "the principal point is the middle of the picture"},
         {"coverage", "PICTURE", "write a picture of where corners were, and how far off each is"},
         {"explain", "PICTURE",
          "write each picture with its corners; number n goes to PICTURE\nwith -n before its ending"},
         {"json", "", "one JSON object a view and one for the result"}},
        "Take 10 to 20 pictures with the board in all parts of the picture, the corners too, tilted by 20\n"
        "to 45 degrees to all sides, sharp and still. Ten good ones are better than fifty alike.\n\n"
        "  fovea calibrate --board 9x6 --square 25 -o camera.toml left*.jpg\n"
        "  fovea calibrate --board 9x6 --square 25 -o pair.toml --left left*.jpg --right right*.jpg\n\n"
        "Ends with 0 when there is a calibration, with 1 when a warning makes it doubtful, and with 2\n"
        "when there is none.\n"};
}

struct CalibrateOptions {
    std::vector<std::string> images;  ///< of one camera, or of the left one
    std::vector<std::string> right;   ///< of the right one, if there are two
    Board board;
    IntrinsicsOptions intrinsics;
    StereoOptions::Intrinsics of_pair = StereoOptions::Intrinsics::held;
    std::string out;  ///< "" for no file
    CameraFormat format = CameraFormat::toml;
    std::string coverage;
    std::string explain;
    bool json = false;

    bool stereo() const { return !right.empty(); }
    StereoOptions pair() const { return {of_pair, intrinsics}; }
    /// Where the picture with the corners of an image goes; "" for nowhere.
    std::string explain_name(bool of_right, std::size_t index) const {
        if (explain.empty() || (!stereo() && images.size() == 1)) return explain;
        if (!stereo()) return numbered(explain, index);
        const std::size_t slash = explain.rfind('/');
        const std::size_t dot = explain.rfind('.');
        const bool has_ending = dot != std::string::npos && (slash == std::string::npos || dot > slash + 1);
        const std::string ending = has_ending ? explain.substr(dot) : "";
        return numbered(
            explain.substr(0, explain.size() - ending.size()) + (of_right ? "-right" : "-left") + ending,
            index);
    }
};

namespace detail {

/// Takes the pictures behind --left and --right out of the words. What is left is for Arguments.
inline std::vector<std::string> take_lists(const std::vector<std::string>& words,
                                           std::vector<std::string>& left, std::vector<std::string>& right) {
    std::vector<std::string> rest;
    std::vector<std::string>* list = nullptr;
    const auto add = [&](const std::string& names) {
        for (const std::string& name : split(names, ','))
            if (!name.empty()) list->push_back(name);
    };
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::string& word = words[i];
        if (word == "--") {
            rest.insert(rest.end(), words.begin() + static_cast<std::ptrdiff_t>(i), words.end());
            break;
        }
        const bool option = word.size() > 1 && word[0] == '-';
        if (!option && list != nullptr) {
            add(word);
            continue;
        }
        list = nullptr;
        for (const char* const name : {"--left", "--right"}) {
            const std::string start = std::string(name) + "=";
            if (word != name && word.compare(0, start.size(), start) != 0) continue;
            list = name == std::string("--left") ? &left : &right;
            if (std::find(rest.begin(), rest.end(), start) == rest.end()) rest.push_back(start);
            if (word != name) add(word.substr(start.size()));
        }
        if (list == nullptr) rest.push_back(word);
    }
    return rest;
}

inline std::string read_lens(const std::string& text, LensTerms& lens) {
    const std::vector<std::string> names = {"none", "k1k2", "k1k2p1p2", "k1k2k3p1p2"};
    std::string plain;
    for (const char c : small_letters(text))
        if (c != ',' && c != '_') plain += c;
    const auto found = std::find(names.begin(), names.end(), plain);
    if (found == names.end()) return "--lens is " + listed(names, "or") + ", not '" + one_line(text) + "'";
    lens = static_cast<LensTerms>(found - names.begin());
    return "";
}

inline std::string read_format(const Arguments& arguments, const std::string& out, CameraFormat& format) {
    if (!arguments.has("format")) {
        if (ends_with_one_of(out, ".yml|.yaml")) format = CameraFormat::opencv;
        if (ends_with_one_of(out, ".txt")) format = CameraFormat::ivt;
        if (ends_with_one_of(out, ".bin")) format = CameraFormat::chip;
        return ends_with_one_of(out, ".xml") ? "OpenCV's XML is not written; name it .yml" : "";
    }
    const std::vector<std::string> names = {"toml", "ivt", "opencv", "chip"};
    const CameraFormat formats[] = {CameraFormat::toml, CameraFormat::ivt, CameraFormat::opencv,
                                    CameraFormat::chip};
    const std::string text = arguments.value("format");
    const auto found = std::find(names.begin(), names.end(), text);
    if (found == names.end()) return "--format is " + listed(names, "or") + ", not '" + one_line(text) + "'";
    if (out.empty()) return "--format is of a file to write; give -o FILE too";
    format = formats[found - names.begin()];
    return "";
}

/// What is wrong with the lists of pictures; "" if nothing is.
inline std::string lists_problem(const Arguments& arguments, const std::vector<std::string>& left,
                                 const std::vector<std::string>& right) {
    if (!arguments.has("left") && !arguments.has("right"))
        return arguments.operands().empty()
                   ? "which pictures? give IMAGE..., or --left IMAGE... --right IMAGE..."
                   : "";
    if (!arguments.operands().empty())
        return "IMAGE... are of one camera, --left and --right of two; give the one or the other";
    if (left.empty() || right.empty())
        return std::string(left.empty() ? "--left" : "--right") +
               " is missing or has no picture; a pair has --left IMAGE... and --right IMAGE...";
    if (left.size() != right.size())
        return "--left has " + std::to_string(left.size()) + " pictures and --right " +
               std::to_string(right.size()) + "; each needs its partner at the same place of the other list";
    return "";
}

/// What is wrong with the names of the files to write; "" if nothing is.
inline std::string outputs_problem(const CalibrateOptions& options) {
    std::vector<std::string> written;
    const auto check = [&](const char* option, const std::string& name) -> std::string {
        if (name.empty()) return "";
        for (const auto* list : {&options.images, &options.right})
            if (std::find(list->begin(), list->end(), name) != list->end())
                return std::string(option) + " would overwrite the picture " + name + "; give another name";
        if (std::find(written.begin(), written.end(), name) != written.end())
            return std::string(option) + " would overwrite " + name + "; give another name";
        written.push_back(name);
        return "";
    };
    for (const auto& [option, name] :
         {std::pair{"--coverage", options.coverage}, std::pair{"--explain", options.explain}}) {
        if (name == "-") return std::string(option) + " writes a file; give it a name";
        if (const std::string refusal = picture_name_problem(name); !refusal.empty())
            return std::string(option) + " " + refusal;
    }
    std::string problem = check("--out", options.out);
    if (problem.empty()) problem = check("--coverage", options.coverage);
    for (std::size_t i = 0; problem.empty() && i < options.images.size(); ++i) {
        problem = check("--explain", options.explain_name(false, i));
        if (problem.empty() && options.stereo()) problem = check("--explain", options.explain_name(true, i));
    }
    return problem;
}

}  // namespace detail

/// Reads the words; "" or what is wrong with them first. help is set if they ask for it.
inline std::string read_calibrate_options(const std::vector<std::string>& words, CalibrateOptions& options,
                                          bool& help) {
    std::vector<std::string> left;
    const Arguments arguments(calibrate_help(), detail::take_lists(words, left, options.right));
    help = arguments.has("help");
    if (help) return "";
    std::string problem = arguments.problem();
    if (problem.empty()) problem = detail::lists_problem(arguments, left, options.right);
    options.images = left.empty() ? arguments.operands() : left;
    if (problem.empty() && !arguments.has("board"))
        problem = "which board? give --board 9x6: its columns x rows of inner corners";
    if (problem.empty()) problem = read_board_size(arguments.value("board"), options.board.size);
    if (problem.empty() && !arguments.has("square"))
        problem = "how large is a square? give --square MM, measured on the board";
    if (problem.empty()) problem = read_square(arguments.value("square"), options.board.square_um);
    if (problem.empty() && arguments.has("pattern"))
        problem = read_pattern(arguments.value("pattern"), options.board.pattern);
    if (problem.empty() && arguments.has("lens"))
        problem = detail::read_lens(arguments.value("lens"), options.intrinsics.lens);
    if (arguments.has("fixed-aspect")) options.intrinsics.pixels = PixelShape::square;
    if (arguments.has("fixed-centre")) options.intrinsics.principal_point = PrincipalPoint::held;
    if (arguments.has("free")) options.of_pair = StereoOptions::Intrinsics::estimated;
    options.json = arguments.has("json");
    options.out = arguments.value("out");
    options.coverage = arguments.value("coverage");
    options.explain = arguments.value("explain");
    if (problem.empty() && arguments.has("free") && !options.stereo())
        problem = "--free is of a pair; give --left IMAGE... and --right IMAGE...";
    if (problem.empty() && options.out == "-" && options.json)
        problem = "--json and -o - both write to the standard output; give -o a name";
    if (problem.empty()) problem = detail::read_format(arguments, options.out, options.format);
    return problem.empty() ? detail::outputs_problem(options) : problem;
}

}  // namespace fovea::apps
