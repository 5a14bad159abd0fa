// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/segment/runs.hpp>

namespace fovea::test {
namespace {

struct Stretch {
    int first, end;
    bool region;

    friend bool operator==(const Stretch& a, const Stretch& b) {
        return a.first == b.first && a.end == b.end && a.region == b.region;
    }
};

std::vector<Stretch> split(const std::vector<std::uint8_t>& row) {
    std::vector<Run> room(row.size() + 1);
    RunRow runs({room.data(), static_cast<std::ptrdiff_t>(room.size())});
    EXPECT_EQ(runs.split(row.data(), static_cast<int>(row.size())), Status::ok);
    std::vector<Stretch> stretches;
    for (int i = 0; i < runs.count(); ++i) {
        EXPECT_EQ(runs[i].label, no_label);
        stretches.push_back({runs[i].first, runs.end(i), runs.is_region(i)});
    }
    return stretches;
}

std::vector<Stretch> split_slowly(const std::vector<std::uint8_t>& row) {
    std::vector<Stretch> stretches;
    for (int x = 0; x < static_cast<int>(row.size()); ++x) {
        const bool region = row[static_cast<std::size_t>(x)] != 0;
        if (stretches.empty() || stretches.back().region != region) stretches.push_back({x, x, region});
        stretches.back().end = x + 1;
    }
    return stretches;
}

TEST(RunRow, CutsARowByHand) {
    EXPECT_EQ(split({0, 0, 255, 1, 7, 0}),
              (std::vector<Stretch>{{0, 2, false}, {2, 5, true}, {5, 6, false}}));
    EXPECT_EQ(split({128}), (std::vector<Stretch>{{0, 1, true}}));
    EXPECT_EQ(split({0}), (std::vector<Stretch>{{0, 1, false}}));
}

TEST(RunRow, EqualsCuttingPixelByPixel) {
    Random random(631);
    for (std::size_t width = 1; width <= 200; width += width < 80 ? 1 : 7)
        for (const std::uint32_t longest : {1u, 3u, 12u, 40u}) {
            std::vector<std::uint8_t> row;
            while (row.size() < width) {
                const bool region = random.below(2) == 0;
                for (std::uint32_t n = 1 + random.below(longest); n > 0 && row.size() < width; --n)
                    row.push_back(region ? static_cast<std::uint8_t>(random.between(1, 255))
                                         : std::uint8_t{0});
            }
            EXPECT_EQ(split(row), split_slowly(row)) << width;
        }
}

TEST(RunRow, SaysWhenThereAreMoreRunsThanRoom) {
    const std::uint8_t restless[] = {0, 1, 0, 1};
    fovea::Run room[5];
    RunRow three({room, 4});
    EXPECT_EQ(three.split(restless, 4), Status::capacity_exceeded);
    EXPECT_EQ(three.split(restless, 3), Status::ok);
    EXPECT_EQ(three.count(), 3);
    RunRow four({room, 5});
    EXPECT_EQ(four.split(restless, 4), Status::ok);
    EXPECT_EQ(four.count(), 4);
    EXPECT_EQ(RunRow().split(restless, 4), Status::capacity_exceeded);
    // Rows that are wider than what is looked at in one go, with every room up to what they need.
    const std::vector<std::uint8_t> alternating = [] {
        std::vector<std::uint8_t> row(150);
        for (std::size_t x = 1; x < row.size(); x += 2) row[x] = 255;
        return row;
    }();
    std::vector<fovea::Run> wide(152);
    for (std::ptrdiff_t size = 1; size <= 151; ++size) {
        wide[static_cast<std::size_t>(size)] = {7, 7};
        RunRow runs({wide.data(), size});
        EXPECT_EQ(runs.split(alternating.data(), 150), size < 151 ? Status::capacity_exceeded : Status::ok)
            << size;
        EXPECT_EQ(wide[static_cast<std::size_t>(size)].label, 7) << size;
    }
}

}  // namespace
}  // namespace fovea::test
