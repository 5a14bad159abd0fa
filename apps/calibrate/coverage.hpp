// SPDX-License-Identifier: MIT
//
// Where in the pictures the board was: which cells of a grid hold none of its corners.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <fovea/base/span.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/number/integer.hpp>

#include <common/text.hpp>

namespace fovea::apps {

class Coverage {
public:
    /// Cells along a side.
    static constexpr int side = 4;

    explicit Coverage(Size picture) : picture_(picture) {}

    void add(Span<const SubPixelPoint> corners) {
        for (const SubPixelPoint corner : corners)
            ++counts_[cell(corner.y, picture_.height)][cell(corner.x, picture_.width)];
    }
    int count(int column, int row) const { return counts_[row][column]; }
    int empty_cells() const {
        int empty = 0;
        for (const auto& row : counts_)
            for (const int count : row) empty += count == 0 ? 1 : 0;
        return empty;
    }
    /// Where there are empty cells: "upper left corner", "left edge", "middle".
    std::vector<std::string> empty_places() const {
        static const char* const rows[] = {"upper", "", "", "lower"};
        static const char* const columns[] = {"left", "", "", "right"};
        std::vector<std::string> places;
        for (int row = 0; row < side; ++row)
            for (int column = 0; column < side; ++column) {
                if (counts_[row][column] != 0) continue;
                const std::string across = columns[column];
                const std::string down = rows[row];
                const std::string name = !across.empty() && !down.empty() ? down + " " + across + " corner"
                                         : across.empty() && down.empty() ? "middle"
                                                                          : down + across + " edge";
                if (std::find(places.begin(), places.end(), name) == places.end()) places.push_back(name);
            }
        return places;
    }

private:
    static int cell(SubPixel at, int length) {
        // Pixel 0 begins at -1/2.
        return clamp(static_cast<int>((std::int64_t{at.raw()} + SubPixel::one / 2) * side /
                                      (std::int64_t{length} * SubPixel::one)),
                     0, side - 1);
    }

    Size picture_;
    int counts_[side][side] = {};
};

}  // namespace fovea::apps
