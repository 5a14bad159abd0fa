// SPDX-License-Identifier: MIT
//
// The board that a camera is calibrated with, as the command line tells it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/match/point_pair.hpp>
#include <fovea/number/decimal.hpp>

#include <common/text.hpp>

namespace fovea::apps {

enum class BoardPattern : std::uint8_t { checkerboard, circles, asymmetric_circles };

/// A board: corners of squares, or centres of circles, row by row.
struct Board {
    BoardPattern pattern = BoardPattern::checkerboard;
    /// Corners or circles: columns and rows.
    Size size;
    /// Side of a square, or from circle to circle; of asymmetric circles from row to row. In micrometres.
    std::int32_t square_um = 0;

    /// The places on the board, in micrometres.
    std::vector<PlanePoint> points() const {
        std::vector<PlanePoint> all;
        for (int row = 0; row < size.height; ++row)
            for (int column = 0; column < size.width; ++column) {
                const int across =
                    pattern == BoardPattern::asymmetric_circles ? 2 * column + row % 2 : column;
                all.push_back({across * square_um, row * square_um});
            }
        return all;
    }
    /// Whether the board looks the same when it is turned by half.
    bool symmetric() const {
        if (pattern == BoardPattern::asymmetric_circles) return size.height % 2 == 0;
        return pattern == BoardPattern::circles || size.width % 2 == size.height % 2;
    }
};

inline const char* what_is_seen(BoardPattern pattern) {
    return pattern == BoardPattern::checkerboard ? "corners" : "circles";
}

/// "9x6".
inline std::string board_text(Size size) {
    return std::to_string(size.width) + "x" + std::to_string(size.height);
}

/// The most corners along a side.
inline constexpr int most_board_corners = 64;

/// Reads --board; "" or what is wrong.
inline std::string read_board_size(const std::string& text, Size& size) {
    const std::vector<std::string> words = split(small_letters(text), 'x');
    int sides[2] = {0, 0};
    bool good = words.size() == 2;
    for (std::size_t i = 0; good && i < 2; ++i) {
        const Result<Decimal> number = parse_decimal(span_of(words[i]));
        good = number && number->millionths % 1000000 == 0 && number->millionths >= 3000000 &&
               number->millionths <= Decimal::from_int(most_board_corners).millionths;
        if (good) sides[i] = static_cast<int>(number->millionths / 1000000);
    }
    if (!good)
        return "--board takes columns x rows of inner corners, 3 to " + std::to_string(most_board_corners) +
               " each, such as 9x6, not '" + one_line(text) + "'";
    size = {sides[0], sides[1]};
    return "";
}

/// Reads --square; "" or what is wrong.
inline std::string read_square(const std::string& text, std::int32_t& square_um) {
    const Result<Decimal> number = parse_decimal(span_of(text));
    const std::int64_t millionths = number ? number->millionths : 0;
    if (millionths < 10000 || millionths > Decimal::from_int(10000).millionths)
        return "--square takes the side of a square in mm, 0.01 to 10000, such as 25 or 30.5, not '" +
               one_line(text) + "'";
    if (millionths % 1000 != 0) return "--square has whole micrometres: at most three places, such as 24.985";
    square_um = static_cast<std::int32_t>(millionths / 1000);
    return "";
}

/// Reads --pattern; "" or what is wrong.
inline std::string read_pattern(const std::string& text, BoardPattern& pattern) {
    const std::vector<std::string> names = {"checkerboard", "circles", "asymmetric-circles"};
    for (std::size_t i = 0; i < names.size(); ++i)
        if (text == names[i]) {
            pattern = static_cast<BoardPattern>(i);
            return "";
        }
    return "--pattern is " + listed(names, "or") + ", not '" + one_line(text) + "'" +
           hint(nearest_name(text, names));
}

}  // namespace fovea::apps
