// SPDX-License-Identifier: MIT
//
// ScatteredWorkers: several workers in one thread, whose pieces come in any order to any of them. What comes
// out the same under them does not hang on who did what, and when.
#pragma once

#include <utility>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/image/workers.hpp>

namespace fovea::test {

class ScatteredWorkers {
public:
    ScatteredWorkers(int count, std::uint32_t seed) : count_(count), random_(seed) {}

    int count() const { return count_; }
    template <class Piece>
    void run(int pieces, const Piece& piece) const {
        std::vector<int> order;
        for (int k = 0; k < pieces; ++k) order.push_back(k);
        for (int k = pieces - 1; k > 0; --k)
            std::swap(order[static_cast<std::size_t>(k)],
                      order[static_cast<std::size_t>(random_.between(0, k))]);
        for (const int index : order) piece(index, random_.between(0, count_ - 1));
    }

private:
    int count_;
    mutable Random random_;
};

}  // namespace fovea::test
