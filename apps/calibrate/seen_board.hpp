// SPDX-License-Identifier: MIT
//
// What a picture shows of a board, or why it shows none.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <fovea/base/crc32.hpp>
#include <fovea/camera/checkerboard.hpp>
#include <fovea/camera/circle_grid.hpp>
#include <fovea/image/geometry.hpp>

#include <calibrate/board.hpp>
#include <common/picture_file.hpp>

namespace fovea::apps {

/// A picture, and the board in it.
struct SeenBoard {
    std::string name;
    Size picture;  ///< 0x0 if it could not be read
    bool found = false;
    bool used = false;
    std::string reason;  ///< why it is not used; "" if it is
    std::vector<SubPixelPoint> corners;
    std::uint32_t crc = 0;  ///< of the picture's pixels

    Span<const SubPixelPoint> span() const {
        return {corners.data(), static_cast<std::ptrdiff_t>(corners.size())};
    }
};

/// Looks for a board in a picture. corners is empty unless the answer is ok.
inline Status find_board(const Picture<Gray8>& image, const Board& board,
                         std::vector<SubPixelPoint>& corners) {
    corners.assign(static_cast<std::size_t>(board.size.area()), SubPixelPoint());
    const Span<SubPixelPoint> found(corners.data(), static_cast<std::ptrdiff_t>(corners.size()));
    Status status = Status::bad_argument;
    const auto with_scratch = [&](std::int64_t bytes, auto find) {
        // Not set to 0, which takes as long as a small picture.
        const std::unique_ptr<std::uint8_t[]> scratch(new std::uint8_t[static_cast<std::size_t>(bytes)]);
        status = find(Span<std::uint8_t>(scratch.get(), static_cast<std::ptrdiff_t>(bytes)));
    };
    if (board.pattern == BoardPattern::checkerboard) {
        const CheckerboardOptions options;
        with_scratch(find_checkerboard_scratch(image.size, board.size, options),
                     [&](Span<std::uint8_t> scratch) {
                         return find_checkerboard(image.view(), board.size, options, scratch, found);
                     });
    } else {
        CircleGridOptions options;
        options.tone = CircleTone::any;
        if (board.pattern == BoardPattern::asymmetric_circles)
            options.pattern = CircleGridPattern::asymmetric;
        with_scratch(find_circle_grid_scratch(image.size, board.size, options),
                     [&](Span<std::uint8_t> scratch) {
                         return find_circle_grid(image.view(), board.size, options, scratch, found);
                     });
    }
    if (status != Status::ok) corners.clear();
    return status;
}

inline std::string no_board_reason(Status status, const Board& board) {
    if (status == Status::not_found || status == Status::undecided)
        return "no board of " + board_text(board.size) + " " + what_is_seen(board.pattern);
    return describe(status);
}

/// Reads a picture and looks for the board in it; image is what was read.
template <class Io>
SeenBoard see_board(Io& io, const std::string& name, const Board& board, Picture<Gray8>& image) {
    SeenBoard seen;
    seen.name = name;
    std::string problem;
    if (!load_picture(io.storage(), name, max_image_side, image, problem)) {
        seen.reason =
            problem.compare(0, name.size() + 2, name + ": ") == 0 ? problem.substr(name.size() + 2) : problem;
        return seen;
    }
    seen.picture = image.size;
    seen.crc = crc32({image.pixels.data(), static_cast<std::ptrdiff_t>(image.pixels.size())});
    const Status status = find_board(image, board, seen.corners);
    seen.found = status == Status::ok;
    seen.used = seen.found;
    if (!seen.found) seen.reason = no_board_reason(status, board);
    return seen;
}

/// The board that was perhaps meant: squares were counted in place of the corners between them, or sides are
/// one off. 0x0 if the picture shows none of these.
inline Size likely_board(const Picture<Gray8>& image, const Board& board) {
    const Size meant = board.size;
    const Size others[] = {{meant.width - 1, meant.height - 1},
                           {meant.width + 1, meant.height + 1},
                           {meant.width - 1, meant.height},
                           {meant.width, meant.height - 1}};
    for (const Size size : others) {
        if (std::min(size.width, size.height) < 3 || std::max(size.width, size.height) > most_board_corners)
            continue;
        Board other = board;
        other.size = size;
        std::vector<SubPixelPoint> corners;
        if (find_board(image, other, corners) == Status::ok) return size;
    }
    return {};
}

}  // namespace fovea::apps
