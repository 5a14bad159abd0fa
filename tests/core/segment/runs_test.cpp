// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include <fovea/base/arena.hpp>
#include <fovea/base/random.hpp>
#include <fovea/number/integer.hpp>
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

/// Labels from 1 on; the smaller one stands for both of two that are merged. As many as there is room for.
struct Forest {
    std::vector<RunLabel> parents;
    std::size_t room = 1000;

    RunLabel find(RunLabel label) const {
        while (parents[label] != label) label = parents[label];
        return label;
    }
    RunLabel merge(RunLabel a, RunLabel b) {
        EXPECT_EQ(find(a), a);
        EXPECT_EQ(find(b), b);
        return parents[maximum(a, b)] = minimum(a, b);
    }
    RunLabel add(int) {
        if (parents.size() == room) return no_label;
        parents.push_back(static_cast<RunLabel>(parents.size()));
        return parents.back();
    }
};

struct OwnedRow {
    std::vector<std::uint8_t> scratch;
    RunRow runs;

    explicit OwnedRow(const std::vector<std::uint8_t>& row)
        : scratch(static_cast<std::size_t>(run_row_bytes(static_cast<int>(row.size())))) {
        Arena arena({scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())});
        runs = RunRow(arena, static_cast<int>(row.size()));
        EXPECT_EQ(runs.split(row.data(), static_cast<int>(row.size())), Status::ok);
    }
};

TEST(RunRow, KeepsTheBitsOfARestlessRow) {
    std::vector<std::uint8_t> row(70);
    row[1] = row[66] = row[69] = 3;
    EXPECT_FALSE(OwnedRow(row).runs.has_bits());
    for (std::size_t x = 20; x < 40; x += 2) row[x] = 1;
    const OwnedRow owned(row);
    ASSERT_TRUE(owned.runs.has_bits());
    for (int x = 0; x < 70; ++x)
        EXPECT_EQ(owned.runs.bits()[x / detail::bits_pixels] >> x % detail::bits_pixels & 1,
                  row[static_cast<std::size_t>(x)] != 0);
}

TEST(LabelRuns, JoinsWhatTouchesByHand) {
    const OwnedRow above({1, 0, 1, 1, 0, 0, 0, 0, 0, 0}), here({0, 1, 0, 0, 1, 0, 1, 0, 0, 0});
    Forest forest{{0, 1, 2}};
    above.runs[0].label = 1;
    above.runs[2].label = 2;
    ASSERT_TRUE(label_runs(above.runs, here.runs, true, 1, forest));
    EXPECT_EQ(here.runs[1].label, 1);  // Corners of both.
    EXPECT_EQ(forest.find(2), 1);
    EXPECT_EQ(here.runs[3].label, 1);
    EXPECT_EQ(here.runs[5].label, 3);
    forest = {{0, 1, 2}};
    ASSERT_TRUE(label_runs(above.runs, OwnedRow({0, 1, 0, 0, 1, 0, 1, 0, 0, 0}).runs, true, 0, forest));
    EXPECT_EQ(forest.parents.size(), 6u);  // Without corners none touches.
}

TEST(LabelRuns, EqualsAskingEveryPairOfRuns) {
    Random random(632);
    for (int round = 0; round < 3000; ++round) {
        const auto width = static_cast<std::size_t>(random.between(1, round % 3 == 0 ? 12 : 200));
        const std::uint32_t longest = round % 2 == 0 ? 3 : 20;
        const auto random_row = [&] {
            std::vector<std::uint8_t> row;
            for (bool region = random.below(2) == 0; row.size() < width; region = !region)
                for (std::uint32_t n = 1 + random.below(longest); n > 0 && row.size() < width; --n)
                    row.push_back(region ? 255 : 0);
            return row;
        };
        const OwnedRow above(random_row()), here(random_row());
        const bool regions = random.below(2) == 0;
        const int reach = random.between(0, 1);
        Forest forest{{0}}, expected;
        for (int i = above.runs.first_of(regions); i < above.runs.count(); i += 2)
            above.runs[i].label = random.below(3) == 0 && forest.parents.size() > 1
                                      ? static_cast<RunLabel>(random.between(1, forest.add(0) - 1))
                                      : forest.add(0);
        expected = forest;
        std::vector<RunLabel> labels;
        for (int i = here.runs.first_of(regions); i < here.runs.count(); i += 2) {
            RunLabel label = no_label;
            for (int j = above.runs.first_of(regions); j < above.runs.count(); j += 2) {
                if (above.runs[j].first >= here.runs.end(i) + reach) continue;
                if (here.runs[i].first >= above.runs.end(j) + reach) continue;
                const RunLabel root = expected.find(above.runs[j].label);
                label = label == no_label || label == root ? root : expected.merge(label, root);
            }
            labels.push_back(label == no_label ? expected.add(0) : label);
        }
        const std::size_t size = expected.parents.size();
        ASSERT_TRUE(label_runs(above.runs, here.runs, regions, reach, forest));
        ASSERT_EQ(forest.parents.size(), size) << round;
        for (std::size_t i = 1; i < size; ++i)
            ASSERT_EQ(forest.find(static_cast<RunLabel>(i)), expected.find(static_cast<RunLabel>(i)));
        for (std::size_t k = 0; k < labels.size(); ++k) {
            const RunLabel label = here.runs[here.runs.first_of(regions) + 2 * static_cast<int>(k)].label;
            ASSERT_EQ(forest.find(label), expected.find(labels[k])) << round;
        }
    }
}

TEST(LabelRuns, SaysWhenThereIsNoLabelLeft) {
    for (const std::size_t width : {std::size_t{8}, std::size_t{100}}) {
        std::vector<std::uint8_t> row(width);
        row[0] = row[2] = row[4] = 1;
        const OwnedRow none(std::vector<std::uint8_t>(width, 0)), here(row);
        Forest forest{{0}, 3};
        EXPECT_FALSE(label_runs(none.runs, here.runs, true, 1, forest));
        forest = {{0}, 4};
        EXPECT_TRUE(label_runs(none.runs, OwnedRow(row).runs, true, 1, forest));
    }
}

}  // namespace
}  // namespace fovea::test
