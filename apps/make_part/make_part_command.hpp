// SPDX-License-Identifier: MIT
//
// fovea make-part: renders a back-lit part of known size, to try things on.
#pragma once

#include <string>
#include <vector>

#include <common/arguments.hpp>
#include <common/io.hpp>
#include <common/picture_file.hpp>
#include <make_part/part_scene.hpp>

namespace fovea::apps {

inline Command make_part_help() {
    return {"make-part",
            "--out PICTURE",
            "Renders a back-lit plate of known size.",
            {{"out", "PICTURE", "PNG or PGM to write; required"},
             {"size", "WxH", "of the picture; 640x480 if not given"},
             {"plate", "LxH", "length and height of the plate in px; 360x140"},
             {"cut", "LxH", "legs of the corner that is cut off; 60x40"},
             {"holes", "X,Y,R;...",
              "round holes from the middle of the plate, or none;\n'100,-4,30;-96,8,18', in quotes because "
              "of the ;"},
             {"at", "X,Y", "the middle of the plate in the picture; 320,240"},
             {"angle", "DEG", "turns the plate clockwise; 17"},
             {"blur", "PX", "standard deviation of the lens; 1"},
             {"noise", "LEVELS", "standard deviation of the sensor; 4"},
             {"bright", "", "a bright plate on dark ground"},
             {"seed", "N", "of the noise; 1"}},
            "The plate is the same on every machine, to the last pixel.\n"};
}

namespace detail {

/// Numbers of an option's value, as "12.5x3" with x between them; false if there are not so many.
inline bool option_numbers(const std::string& text, char between, std::size_t count,
                           std::vector<std::int64_t>& numbers) {
    const std::vector<std::string> words = split(text, between);
    if (words.size() != count) return false;
    numbers.clear();
    for (const std::string& word : words) {
        const Result<Decimal> number = parse_decimal(span_of(word));
        if (!number || magnitude(number->millionths) > 20000000000u) return false;
        numbers.push_back(number->millionths);
    }
    return true;
}
inline bool whole(std::int64_t millionths) { return millionths % 1000000 == 0; }
inline FinePixel fine_of(std::int64_t millionths) { return FinePixel::from_ratio(millionths, 1000000); }

/// Reads the options into a scene; the problem if one of them is wrong.
inline std::string read_scene(const Arguments& arguments, PartScene& scene) {
    std::vector<std::int64_t> n;
    const auto wrong = [&](const char* name, const char* example) {
        return std::string("--") + name + " takes " + example + ", not '" + arguments.value(name) + "'";
    };
    const auto given = [&](const char* name) { return arguments.has(name); };
    if (given("size")) {
        const auto is_side = [](std::int64_t value) {
            return whole(value) && value >= 8000000 && value <= 8191000000;
        };
        if (!option_numbers(arguments.value("size"), 'x', 2, n) || !is_side(n[0]) || !is_side(n[1]))
            return wrong("size", "two sides of 8 to 8191 such as 640x480");
        scene.size = {static_cast<int>(n[0] / 1000000), static_cast<int>(n[1] / 1000000)};
        scene.middle = {FinePixel::from_int(scene.size.width / 2),
                        FinePixel::from_int(scene.size.height / 2)};
    }
    if (given("plate")) {
        if (!option_numbers(arguments.value("plate"), 'x', 2, n) || n[0] <= 0 || n[1] <= 0)
            return wrong("plate", "two lengths such as 360x140");
        scene.length = fine_of(n[0]);
        scene.height = fine_of(n[1]);
    }
    if (given("cut")) {
        if (!option_numbers(arguments.value("cut"), 'x', 2, n) || n[0] < 0 || n[1] < 0)
            return wrong("cut", "two lengths such as 60x40");
        scene.cut_x = fine_of(n[0]);
        scene.cut_y = fine_of(n[1]);
    }
    if (given("holes")) {
        scene.holes.clear();
        const std::string holes = arguments.value("holes");
        if (!holes.empty() && holes != "none")
            for (const std::string& hole : split(holes, ';')) {
                if (!option_numbers(hole, ',', 3, n) || n[2] <= 0)
                    return wrong("holes", "X,Y,R;X,Y,R... or none");
                scene.holes.push_back({fine_of(n[0]), fine_of(n[1]), fine_of(n[2])});
            }
    }
    if (given("at")) {
        if (!option_numbers(arguments.value("at"), ',', 2, n)) return wrong("at", "a place such as 320,240");
        scene.middle = {fine_of(n[0]), fine_of(n[1])};
    }
    if (given("angle")) {
        if (!option_numbers(arguments.value("angle"), '\0', 1, n))
            return wrong("angle", "degrees such as 17");
        scene.angle = FineAngle::from_microdegrees(n[0]);
    }
    if (given("blur")) {
        if (!option_numbers(arguments.value("blur"), '\0', 1, n) || n[0] < 0 || n[0] > 20000000)
            return wrong("blur", "a number from 0 to 20");
        scene.blur = n[0];
    }
    if (given("noise")) {
        if (!option_numbers(arguments.value("noise"), '\0', 1, n) || n[0] < 0 || n[0] > 100000000)
            return wrong("noise", "a number from 0 to 100");
        scene.noise = n[0];
    }
    if (given("seed")) {
        if (!option_numbers(arguments.value("seed"), '\0', 1, n) || n[0] < 0 || !whole(n[0]))
            return wrong("seed", "a whole number from 0 to 20000");
        scene.seed = static_cast<std::uint64_t>(n[0] / 1000000);
    }
    if (given("bright")) std::swap(scene.part_level, scene.ground_level);
    return "";
}

}  // namespace detail

/// Runs the command with the words behind its name.
template <class Io>
ExitCode make_part_command(Io& io, const std::vector<std::string>& words) {
    const Arguments arguments(make_part_help(), words);
    if (arguments.has("help")) {
        io.print(help_of(make_part_help()));
        return exit_ok;
    }
    std::string problem = arguments.problem();
    const std::string out = arguments.value("out");
    PartScene scene;
    if (problem.empty() && !arguments.operands().empty())
        problem = "what is " + arguments.operands()[0] + "? the picture is named by --out";
    if (problem.empty() && out.empty()) problem = "where to? give --out PICTURE";
    if (problem.empty()) problem = detail::read_scene(arguments, scene);
    if (!problem.empty()) {
        io.complain("fovea make-part: " + problem);
        return exit_failed;
    }
    if (!save_picture(io.storage(), out, render(scene), problem)) {
        io.complain(problem);
        return exit_failed;
    }
    if (out != "-") io.print("wrote " + out + "\n");
    return exit_ok;
}

}  // namespace fovea::apps
