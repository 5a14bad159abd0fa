// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/code/bar_edges.hpp>
#include <support/bars.hpp>

namespace fovea::test {
namespace {

using Profile = std::vector<std::int16_t>;

BarProfile span_of(const Profile& profile) {
    return {profile.data(), static_cast<std::ptrdiff_t>(profile.size())};
}
std::vector<BarTurn> turns_of(const Profile& profile, int share = 4) {
    std::vector<BarTurn> turns(profile.size());
    std::vector<std::int16_t> ranges(static_cast<std::size_t>(bar_ranges(static_cast<int>(profile.size()))));
    turns.resize(static_cast<std::size_t>(
        find_bar_turns(span_of(profile), share, {ranges.data(), static_cast<std::ptrdiff_t>(ranges.size())},
                       {turns.data(), static_cast<std::ptrdiff_t>(turns.size())})));
    return turns;
}
std::vector<std::int32_t> edges_of(const Profile& profile, BarEdgeRule rule) {
    const std::vector<BarTurn> turns = turns_of(profile);
    std::vector<std::int32_t> edges(turns.size() + 3);
    edges.resize(static_cast<std::size_t>(
        find_bar_edges(span_of(profile), {turns.data(), static_cast<std::ptrdiff_t>(turns.size())}, rule,
                       {edges.data(), static_cast<std::ptrdiff_t>(edges.size())})));
    return edges;
}
constexpr BarEdgeRule rules[] = {BarEdgeRule::steepest, BarEdgeRule::halfway, BarEdgeRule::level};

TEST(BarEdges, TurnsAreTheEndsOfBarsAndSpaces) {
    const Profile profile = {3200, 3200, 800, 800, 800, 3200, 3200};
    const std::vector<BarTurn> turns = turns_of(profile);
    ASSERT_EQ(turns.size(), 3U);
    EXPECT_EQ(turns[0].level, 3200);
    EXPECT_EQ(turns[1].level, 800);
    EXPECT_EQ(turns[1].place, 2);
    EXPECT_EQ(turns[2].level, 3200);
}

TEST(BarEdges, RipplesAreNoTurnsUnlessAFineShareIsAsked) {
    const Profile profile = {3200, 800, 3200, 2900, 3200, 800, 3200};
    EXPECT_EQ(turns_of(profile, 4).size(), 5U);
    EXPECT_EQ(turns_of(profile, 10).size(), 7U);
}

TEST(BarEdges, EachRuleFindsTheMiddleOfASharpEdge) {
    const Profile profile = {3200, 3200, 3200, 800, 800, 800, 3200, 3200, 3200};
    const std::vector<std::int32_t> expected = {0, 640, 1408, 2048};
    for (const BarEdgeRule rule : rules) EXPECT_EQ(edges_of(profile, rule), expected);
}

TEST(BarEdges, EachRuleFindsTheFractionOfAnEdge) {
    // Pixels 3 and 7 are dark to a quarter and to three quarters.
    const Profile profile = {3200, 3200, 3200, 2600, 800, 800, 800, 1400, 3200, 3200, 3200};
    for (const BarEdgeRule rule : rules) {
        const std::vector<std::int32_t> edges = edges_of(profile, rule);
        ASSERT_EQ(edges.size(), 4U);
        EXPECT_LT(std::abs(edges[1] - 832), 80) << static_cast<int>(rule);   // 3 + 1/4
        EXPECT_LT(std::abs(edges[2] - 1856), 80) << static_cast<int>(rule);  // 7 + 1/4
    }
}

TEST(BarEdges, ALineThatBeginsWithABarHasASpaceOfNoWidthBeforeIt) {
    const Profile profile = {800, 800, 3200, 3200};
    const std::vector<std::int32_t> expected = {0, 0, 384, 768};
    EXPECT_EQ(edges_of(profile, BarEdgeRule::halfway), expected);
}

TEST(BarEdges, ReversedTwiceIsTheSameLine) {
    const std::vector<std::int32_t> line = {0, 100, 250, 700, 720, 1000};
    std::vector<std::int32_t> once(line.size() + 1);
    const int count = reverse_bar_edges(test::span_of(line), {once.data(), 7});
    EXPECT_EQ(count, 6);
    EXPECT_EQ(once[1], 280);
    std::vector<std::int32_t> twice(line.size() + 1);
    ASSERT_EQ(reverse_bar_edges({once.data(), count}, {twice.data(), 7}), 6);
    twice.resize(6);
    EXPECT_EQ(twice, line);
    // The last run of this one is a bar.
    EXPECT_EQ(reverse_bar_edges(test::span_of(line).first(5), {once.data(), 7}), 6);
    EXPECT_EQ(once[1], 0);
}

TEST(BarEdges, InvertedRunsMoveByOne) {
    std::vector<std::int32_t> edges = {0, 100, 250, 0};
    EXPECT_EQ(invert_bar_edges({edges.data(), 4}, 3), 4);
    EXPECT_EQ(edges, (std::vector<std::int32_t>{0, 0, 100, 250}));
    EXPECT_EQ(invert_bar_edges({edges.data(), 4}, 0), 0);
}

TEST(BarEdges, SharpeningRaisesASpikeAndKeepsARamp) {
    const Profile profile = {0, 100, 200, 300, 1400, 500, 600};
    Profile sharp(profile.size());
    sharpen_bar_profile(span_of(profile), 1, {sharp.data(), 7});
    EXPECT_EQ(sharp[2], 200);
    EXPECT_EQ(sharp[4], 2800 - 400);
    EXPECT_EQ(sharp[0], -50);
}

TEST(BarEdges, NoProfileHasNoTurns) {
    EXPECT_TRUE(turns_of({}).empty());
    EXPECT_TRUE(turns_of({5}).empty());
    EXPECT_TRUE(turns_of(Profile(100, 2000)).empty());
    EXPECT_EQ(find_bar_edges({}, {}, BarEdgeRule::level, {}), 0);
}

TEST(BarEdges, AnyProfileGivesRisingEdges) {
    Random random(3151);
    for (int round = 0; round < 500; ++round) {
        Profile profile(1 + random.below(300));
        const auto step = 1 + random.below(4080);
        int level = static_cast<int>(random.below(4081));
        for (std::int16_t& sample : profile) {
            level += random.between(-static_cast<int>(step), static_cast<int>(step));
            level = level < 0 ? 0 : level > 4080 ? 4080 : level;
            sample = static_cast<std::int16_t>(level);
        }
        for (const BarEdgeRule rule : rules) {
            const std::vector<std::int32_t> edges = edges_of(profile, rule);
            for (std::size_t i = 2; i < edges.size(); ++i) EXPECT_GT(edges[i], edges[i - 1]);
        }
    }
}

TEST(BarEdges, TheMiddleLevelIsThatOfTheHighestAndTheLowestTurnNear) {
    Random random(19);
    for (int trial = 0; trial < 300; ++trial) {
        std::vector<BarTurn> turns(static_cast<std::size_t>(random.between(2, 14)));
        std::int32_t level = 2000;
        for (std::size_t i = 0; i < turns.size(); ++i) {
            level += (i % 2 == static_cast<std::size_t>(trial % 2) ? 1 : -1) * random.between(64, 1900);
            turns[i] = {static_cast<std::int32_t>(3 * i), level};
        }
        const auto count = static_cast<int>(turns.size());
        for (int i = 0; i + 1 < count; ++i) {
            std::int32_t least = turns[static_cast<std::size_t>(i)].level;
            std::int32_t most = least;
            for (int near = std::max(i - 4, 0); near <= std::min(i + 5, count - 1); ++near) {
                least = std::min(least, turns[static_cast<std::size_t>(near)].level);
                most = std::max(most, turns[static_cast<std::size_t>(near)].level);
            }
            EXPECT_EQ(detail::middle_level({turns.data(), static_cast<std::ptrdiff_t>(turns.size())}, i),
                      (least + most) / 2)
                << trial << ' ' << i;
        }
    }
}

}  // namespace
}  // namespace fovea::test
