// SPDX-License-Identifier: MIT
//
// Workers: who does the pieces of a picture's work. One after another here; a system with several processors
// brings threads that do them at once.
#pragma once

#include <type_traits>

#include <fovea/base/assert.hpp>
#include <fovea/base/status.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

/// One worker, who does all pieces in their order on the processor that calls. All workers answer as this
/// one:
///   int count() const                    of the workers, from 1
///   void run(int pieces, const Piece&)   calls piece(index, worker) once for each index from 0 up to pieces,
///                                        in any order, several at once, but never two of one worker (from 0
///                                        up to count()); comes back when all are done
/// Pieces write nothing that another reads, so the result is the same whoever does them.
struct OneWorker {
    static constexpr int count() { return 1; }
    template <class Piece>
    constexpr void run(int pieces, const Piece& piece) const {
        for (int index = 0; index < pieces; ++index) piece(index, 0);
    }
};

/// Rows from first up to end.
struct RowRange {
    int first = 0;
    int end = 0;

    constexpr int count() const { return end - first; }
};

/// Rows that a piece has at least, and a multiple of: what it costs to hand out a piece is little then.
inline constexpr int least_piece_rows = 16;

/// In how many pieces so many rows are cut: one for a single worker, else up to four for each, so that no one
/// waits long for a slow one. Each has rows.
constexpr int piece_count(int rows, int workers) {
    if (workers <= 1) return 1;
    const int blocks = (rows + least_piece_rows - 1) / least_piece_rows;
    const int wanted = minimum(4 * workers, maximum(blocks, 1));
    const int blocks_each = (blocks + wanted - 1) / wanted;
    return blocks_each == 0 ? 1 : (blocks + blocks_each - 1) / blocks_each;
}

/// The rows of a piece.
constexpr RowRange piece_rows(int rows, int pieces, int index) {
    FOVEA_ASSERT(pieces >= 1 && index >= 0 && index < pieces);
    const int blocks = (rows + least_piece_rows - 1) / least_piece_rows;
    const int each = (blocks + pieces - 1) / pieces * least_piece_rows;
    return {minimum(index * each, rows), index == pieces - 1 ? rows : minimum((index + 1) * each, rows)};
}

/// Workers there are at most.
inline constexpr int most_workers = 16;

/// Does work on rows in pieces: work(RowRange, worker). Where that answers a Status, this answers ok if all
/// did, or one that was not.
template <class Workers, class Work>
constexpr auto run_rows(const Workers& workers, int rows, const Work& work) {
    FOVEA_ASSERT(workers.count() <= most_workers);
    const int pieces = piece_count(rows, workers.count());
    if constexpr (std::is_void_v<decltype(work(RowRange(), 0))>) {
        workers.run(pieces, [&](int index, int worker) { work(piece_rows(rows, pieces, index), worker); });
    } else {
        Status of_worker[most_workers] = {};
        workers.run(pieces, [&](int index, int worker) {
            const Status status = work(piece_rows(rows, pieces, index), worker);
            if (status != Status::ok) of_worker[worker] = status;
        });
        for (const Status status : of_worker)
            if (status != Status::ok) return status;
        return Status::ok;
    }
}

}  // namespace fovea
