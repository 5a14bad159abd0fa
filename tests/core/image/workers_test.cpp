// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vector>

#include <fovea/image/workers.hpp>
#include <support/scattered_workers.hpp>

namespace fovea {
namespace {

TEST(Workers, CutRowsIntoPiecesAsWorkedByHand) {
    // 100 rows are 7 blocks of 16: 7 pieces for 2 workers, who would take up to 8.
    static_assert(piece_count(100, 2) == 7);
    static_assert(piece_rows(100, 7, 0).first == 0 && piece_rows(100, 7, 0).end == 16);
    static_assert(piece_rows(100, 7, 6).first == 96 && piece_rows(100, 7, 6).end == 100);
    // 480 rows are 30 blocks: in 16 pieces, two blocks each, so that 15 are enough.
    static_assert(piece_count(480, 4) == 15 && piece_rows(480, 15, 14).first == 448);
    static_assert(piece_count(480, 1) == 1 && piece_rows(480, 1, 0).end == 480);
    static_assert(piece_count(5, 8) == 1 && piece_count(0, 8) == 1);
}

TEST(Workers, PiecesHoldEveryRowOnce) {
    for (int rows = 1; rows < 700; ++rows)
        for (int workers = 1; workers <= most_workers; ++workers) {
            const int pieces = piece_count(rows, workers);
            ASSERT_LE(pieces, 4 * workers);
            int next = 0;
            for (int k = 0; k < pieces; ++k) {
                const RowRange piece = piece_rows(rows, pieces, k);
                ASSERT_EQ(piece.first, next);
                ASSERT_GT(piece.count(), 0) << rows << " rows, " << workers << " workers";
                ASSERT_EQ(piece.first % least_piece_rows, 0) << "a mosaic's pieces begin at even rows";
                next = piece.end;
            }
            ASSERT_EQ(next, rows);
        }
}

TEST(Workers, OneDoesAllPiecesInTheirOrder) {
    std::vector<int> seen;
    OneWorker().run(5, [&](int index, int worker) {
        EXPECT_EQ(worker, 0);
        seen.push_back(index);
    });
    EXPECT_EQ(seen, (std::vector<int>{0, 1, 2, 3, 4}));
}

TEST(Workers, AnswerOkIfAllDid) {
    const test::ScatteredWorkers workers(3, 1);
    const auto run = [&](int bad_row) {
        return run_rows(workers, 200, [&](RowRange rows, int) {
            return rows.first <= bad_row && bad_row < rows.end ? Status::truncated : Status::ok;
        });
    };
    EXPECT_EQ(run(-1), Status::ok);
    for (int row = 0; row < 200; row += 7) EXPECT_EQ(run(row), Status::truncated);
}

}  // namespace
}  // namespace fovea
