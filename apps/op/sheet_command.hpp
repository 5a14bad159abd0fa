// SPDX-License-Identifier: MIT
//
// fovea sheet: what several pipelines make of a picture, side by side.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <fovea/draw/text.hpp>
#include <fovea/pixelwise/planes.hpp>
#include <fovea/warp/area.hpp>

#include <common/arguments.hpp>
#include <common/io.hpp>
#include <common/picture_file.hpp>
#include <op/op_command.hpp>
#include <op/pipeline.hpp>
#include <op/show.hpp>

namespace fovea::apps {

inline Command sheet_help() {
    return {"sheet",
            "PICTURE OUT PIPELINE...",
            "Shows what pipelines make of a picture, side by side.",
            {{"columns", "N", "tiles in a row (4)"},
             {"tile", "PX", "the longer side of a tile; larger pictures are shrunk (240)"},
             {"second", "PICTURE", "for operators of two pictures"}},
            "PIPELINE is written as for `fovea op`. The first tile is the picture itself:\n"
            "  fovea sheet part.jpg sheet.png threshold:80 threshold:120 'gaussian_5x5 | threshold:120'\n"};
}

namespace detail {

/// A tile: a picture, and the text below it.
struct Tile {
    Picture<Rgb888> picture;
    std::string text;
};

inline constexpr int tile_gap = 8;
inline constexpr int tile_side_least = 32;
inline constexpr int tile_side_most = 1024;
inline constexpr int tile_columns_most = 16;
inline constexpr Rgb888 tile_paper{250, 250, 248};
inline constexpr Rgb888 tile_ink{40, 44, 52};

/// A picture whose longer side is at most side.
inline Picture<Rgb888> shrunk(const Picture<Rgb888>& from, int side) {
    const int longer = std::max(from.size.width, from.size.height);
    if (longer <= side) return from;
    const auto scaled = [&](int length) {
        return std::max(1, static_cast<int>((std::int64_t{length} * side + longer / 2) / longer));
    };
    const Size size{scaled(from.size.width), scaled(from.size.height)};
    Picture<Gray8> planes[3] = {Picture<Gray8>(from.size), Picture<Gray8>(from.size),
                                Picture<Gray8>(from.size)};
    Picture<Gray8> small[3] = {Picture<Gray8>(size), Picture<Gray8>(size), Picture<Gray8>(size)};
    Picture<Rgb888> picture(size);
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(resize_area_scratch(from.size, size)));
    Status status = split_planes(from.view(), planes[0].view(), planes[1].view(), planes[2].view());
    for (int i = 0; i < 3 && status == Status::ok; ++i)
        status = resize_area(std::as_const(planes[i]).view(),
                             {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}, small[i].view());
    if (status == Status::ok)
        status = merge_planes(std::as_const(small[0]).view(), std::as_const(small[1]).view(),
                              std::as_const(small[2]).view(), picture.view());
    return status == Status::ok ? picture : Picture<Rgb888>();
}

/// The text in lines of at most width pixels, broken behind a space or a comma where there is one.
inline std::vector<std::string> lines_of(const std::string& text, int width) {
    const int character = text_size("xx").width - text_size("x").width;
    const auto most = static_cast<std::size_t>(std::max(1, width / character));
    std::vector<std::string> lines;
    std::string rest = text;
    while (rest.size() > most) {
        const std::size_t last = rest.find_last_of(" ,", most - 1);
        const std::size_t end = last == std::string::npos ? most : last + 1;
        lines.push_back(rest.substr(0, end));
        rest = trimmed(rest.substr(end));
    }
    lines.push_back(rest);
    return lines;
}

/// All tiles on one sheet; a row is as high as its highest tile and text.
inline Picture<Rgb888> sheet_of(const std::vector<Tile>& tiles, std::size_t columns, int side) {
    constexpr int line_height = 10;
    const std::size_t rows = (tiles.size() + columns - 1) / columns;
    int width = 0;
    for (const Tile& tile : tiles) width = std::max(width, tile.picture.size.width);
    width = std::max(width, side / 2);
    std::vector<int> tops;
    int height = tile_gap;
    for (std::size_t row = 0; row < rows; ++row) {
        int highest = 0;
        std::size_t lines = 1;
        for (std::size_t i = row * columns; i < std::min((row + 1) * columns, tiles.size()); ++i) {
            highest = std::max(highest, tiles[i].picture.size.height);
            lines = std::max(lines, lines_of(tiles[i].text, width).size());
        }
        tops.push_back(height);
        height += highest + 4 + static_cast<int>(lines) * line_height + tile_gap;
    }
    const int shown = static_cast<int>(std::min(columns, tiles.size()));
    Picture<Rgb888> sheet(Size{tile_gap + shown * (width + tile_gap), height});
    std::fill(sheet.pixels.begin(), sheet.pixels.end(), tile_paper);
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        const Picture<Rgb888>& picture = tiles[i].picture;
        const int left = tile_gap + static_cast<int>(i % columns) * (width + tile_gap);
        const int top = tops[i / columns];
        for (int y = 0; y < picture.size.height; ++y)
            std::copy_n(picture.view().row(y), picture.size.width, sheet.view().row(top + y) + left);
        int line_top = top + picture.size.height + 4;
        for (const std::string& line : lines_of(tiles[i].text, width)) {
            // Fails for no text at all, of which nothing is to be seen.
            static_cast<void>(draw_text(sheet.view(), {left, line_top}, span_of(line), tile_ink));
            line_top += line_height;
        }
    }
    return sheet;
}

/// A grey picture if every pixel is grey, which makes the file a third as large.
template <class Storage>
bool save_sheet(Storage& storage, const std::string& name, const Picture<Rgb888>& sheet,
                std::string& problem) {
    const bool gray = std::all_of(sheet.pixels.begin(), sheet.pixels.end(), [](Rgb888 pixel) {
        return pixel.red == pixel.green && pixel.green == pixel.blue;
    });
    if (!gray) return save_picture(storage, name, sheet, problem);
    Picture<Gray8> plane(sheet.size);
    std::transform(sheet.pixels.begin(), sheet.pixels.end(), plane.pixels.begin(),
                   [](Rgb888 pixel) { return pixel.green; });
    return save_picture(storage, name, plane, problem);
}

}  // namespace detail

/// Runs the command with the words behind its name.
template <class Io>
ExitCode sheet_command(Io& io, const std::vector<std::string>& words) {
    const Arguments arguments(sheet_help(), words);
    if (arguments.has("help")) {
        io.print(help_of(sheet_help()));
        return exit_ok;
    }
    const std::vector<std::string>& operands = arguments.operands();
    std::string problem = arguments.problem();
    int columns = 4;
    int side = 240;
    if (problem.empty() && operands.size() < 3)
        problem =
            "needs a picture, the picture to write and a pipeline, such as: fovea sheet in.jpg sheet.png "
            "box:5";
    if (problem.empty()) problem = picture_name_problem(operands[1]);
    if (problem.empty()) whole_option(arguments, "columns", 1, detail::tile_columns_most, columns, problem);
    if (problem.empty())
        whole_option(arguments, "tile", detail::tile_side_least, detail::tile_side_most, side, problem);
    std::vector<std::vector<PipelineStep>> pipelines;
    for (std::size_t i = 2; i < operands.size() && problem.empty(); ++i) {
        pipelines.emplace_back();
        if (parse_pipeline(operands[i], pipelines.back(), problem) && detail::takes_two(pipelines.back()) &&
            !arguments.has("second"))
            problem = operands[i] + " takes two pictures: name the other one with --second";
    }
    if (!problem.empty()) {
        io.complain("fovea sheet: " + problem);
        return exit_failed;
    }

    std::vector<detail::Tile> tiles(1);
    Picture<Rgb888> first;
    if (!load_picture(io.storage(), operands[0], max_image_side, first, problem)) {
        io.complain(problem);
        return exit_failed;
    }
    tiles[0] = {detail::shrunk(first, side), "the picture"};
    for (std::size_t i = 0; i < pipelines.size(); ++i) {
        AnyPicture made;
        Picture<Rgb888> shown;
        if (!detail::run_pipeline(
                io.storage(), "sheet", pipelines[i], operands[0], arguments.value("second"),
                [](const auto&...) {}, made, problem) ||
            !shown_in_colour(made, shown, problem)) {
            io.complain(problem);
            return exit_failed;
        }
        tiles.push_back({detail::shrunk(shown, side), operands[i + 2]});
    }
    const Picture<Rgb888> sheet = detail::sheet_of(tiles, static_cast<std::size_t>(columns), side);
    if (sheet.size.width > max_image_side || sheet.size.height > max_image_side)
        problem = "fovea sheet: the sheet would be too large; ask for smaller tiles with --tile";
    else
        detail::save_sheet(io.storage(), operands[1], sheet, problem);
    if (!problem.empty()) {
        io.complain(problem);
        return exit_failed;
    }
    if (operands[1] != "-")
        io.print("wrote " + operands[1] + ", " + std::to_string(tiles.size()) + " pictures\n");
    return exit_ok;
}

}  // namespace fovea::apps
