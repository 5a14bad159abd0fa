// SPDX-License-Identifier: MIT
//
// Runs: a row of a binary image as stretches of equal pixels.
#pragma once

#include <cstdint>
#include <cstring>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

using RunLabel = std::uint16_t;
inline constexpr RunLabel no_label = 0xffff;

/// Pixels from first up to the next run's first, and the number of the component they belong to.
struct Run {
    std::uint16_t first = 0;
    RunLabel label = no_label;
};

/// The runs of one row, region and ground in turn. Holds no memory of its own.
class RunRow {
public:
    RunRow() = default;
    explicit RunRow(Span<Run> room) : runs_(room) {}

    /// Cuts a row of width pixels (1..65535) into runs: zero is ground, all else region.
    ///
    /// Errors  capacity_exceeded if there are more runs than room; width + 1 is always enough
    Status split(const std::uint8_t* row, int width);

    int count() const { return count_; }
    Run& operator[](int index) const { return runs_[index]; }
    bool is_region(int index) const { return (index % 2 == 0) == starts_with_region_; }
    int end(int index) const { return index + 1 < count_ ? runs_[index + 1].first : width_; }

private:
    Span<Run> runs_;
    int count_ = 0;
    int width_ = 0;
    bool starts_with_region_ = false;
};

// ---- Implementation ---------------------------------------------------------------

inline Status RunRow::split(const std::uint8_t* row, int width) {
    count_ = 0;
    width_ = width;
    starts_with_region_ = row[0] != 0;
    bool region = starts_with_region_;
    for (int x = 0; x < width;) {
        if (count_ >= runs_.size()) return Status::capacity_exceeded;
        runs_[count_++] = {static_cast<std::uint16_t>(x), no_label};
        // Eight pixels a step where they are all 0, or all 255.
        const std::uint64_t plain = region ? ~std::uint64_t{0} : 0;
        while (x < width && (row[x] != 0) == region) {
            std::uint64_t eight = ~plain;
            if (x + 8 <= width) std::memcpy(&eight, row + x, sizeof eight);
            x += eight == plain ? 8 : 1;
        }
        region = !region;
    }
    return Status::ok;
}

}  // namespace fovea
