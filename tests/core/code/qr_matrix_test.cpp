// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <utility>

#include <fovea/code/qr_mask_penalty.hpp>
#include <fovea/code/qr_matrix.hpp>

namespace fovea::test {
namespace {

using namespace fovea::detail;

TEST(QrMatrix, TheWayOfTheCodewordsTakesAllThatIsNotReserved) {
    for (int version = 1; version <= max_qr_version; ++version) {
        const QrPatterns patterns(version);
        std::set<std::pair<int, int>> seen;
        int next = 0;
        along_qr_codewords(patterns, [&](int x, int y, int index) {
            EXPECT_EQ(index, next++);
            EXPECT_FALSE(patterns.reserved(x, y));
            seen.insert({x, y});
        });
        EXPECT_EQ(static_cast<int>(seen.size()), next);
        // Up to seven modules are left over.
        EXPECT_EQ(next / 8, qr_codewords(version)) << version;
    }
}

TEST(QrMatrix, TheWayBeginsAtTheLowerRight) {
    const int expected[6][2] = {{20, 20}, {19, 20}, {20, 19}, {19, 19}, {20, 18}, {19, 18}};
    along_qr_codewords(QrPatterns(1), [&](int x, int y, int index) {
        if (index >= 6) return;
        EXPECT_EQ(x, expected[index][0]);
        EXPECT_EQ(y, expected[index][1]);
    });
}

TEST(QrMatrix, WordsStandOnReservedModulesOfTheirOwn) {
    for (const int version : {1, 7, 40}) {
        const QrPatterns patterns(version);
        std::set<std::pair<int, int>> seen;
        for (int copy = 0; copy < 2; ++copy) {
            for (int bit = 0; bit < 15; ++bit) {
                const Point place = qr_format_place(patterns.size(), copy, bit);
                EXPECT_TRUE(patterns.reserved(place.x, place.y));
                EXPECT_FALSE(patterns.dark(place.x, place.y));
                EXPECT_TRUE(seen.insert({place.x, place.y}).second);
            }
            for (int bit = 0; bit < 18 && version >= min_told_qr_version; ++bit) {
                const Point place = qr_version_place(patterns.size(), copy, bit);
                EXPECT_TRUE(patterns.reserved(place.x, place.y));
                EXPECT_TRUE(seen.insert({place.x, place.y}).second);
            }
        }
    }
}

TEST(QrMatrix, PatternsAreDarkWhereTheStandardDrawsThem) {
    const QrPatterns patterns(2);
    EXPECT_TRUE(patterns.dark(0, 0));
    EXPECT_FALSE(patterns.dark(1, 1));
    EXPECT_TRUE(patterns.dark(2, 2));
    EXPECT_FALSE(patterns.dark(7, 7));
    EXPECT_TRUE(patterns.dark(8, 6));
    EXPECT_FALSE(patterns.dark(9, 6));
    EXPECT_TRUE(patterns.dark(18, 18));
    EXPECT_FALSE(patterns.dark(17, 18));
    EXPECT_TRUE(patterns.dark(16, 18));
    EXPECT_TRUE(patterns.dark(8, 17));
    EXPECT_FALSE(patterns.reserved(15, 18));
}

TEST(QrMatrix, MasksRepeatAsTheStandardDrawsThem) {
    // The upper left 6x2 of figure 23.
    const char* rows[8][2] = {{"#.#.#.", ".#.#.#"}, {"######", "......"}, {"#..#..", "#..#.."},
                              {"#..#..", "..#..#"}, {"###...", "###..."}, {"######", "#....."},
                              {"######", "###..."}, {"#.#.#.", "...###"}};
    for (int mask = 0; mask < 8; ++mask)
        for (int y = 0; y < 2; ++y)
            for (int x = 0; x < 6; ++x)
                EXPECT_EQ(qr_mask(mask, x, y), rows[mask][y][x] == '#') << mask << x << y;
}

TEST(QrMaskPenalty, CountsEachFeature) {
    BitStorage<21, 21> modules;
    // All light: 42 lines of 3 + 16 points, 400 squares of 3, and ten steps of a twentieth.
    EXPECT_EQ(qr_mask_penalty(modules.view()), 42 * 19 + 400 * 3 + 100);
    // A chessboard has runs of one and no squares.
    for (int y = 0; y < 21; ++y)
        for (int x = 0; x < 21; ++x) modules.view().set(x, y, (x + y) % 2 == 0);
    EXPECT_EQ(qr_mask_penalty(modules.view()), 0);
    QrLinePenalty line;
    for (const char c : std::string("00001011101")) line.add(c == '1');
    EXPECT_EQ(line.points(), 40);
    QrLinePenalty run;
    for (int i = 0; i < 7; ++i) run.add(true);
    EXPECT_EQ(run.points(), 5);
}

}  // namespace
}  // namespace fovea::test
