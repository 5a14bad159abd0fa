// SPDX-License-Identifier: MIT
//
// How hard a masked QR code is to read: what chooses among its eight masks. ISO/IEC 18004, clause 7.8.3.
#pragma once

#include <fovea/code/qr_tables.hpp>
#include <fovea/image/bit_view.hpp>
#include <fovea/number/integer.hpp>

namespace fovea::detail {

/// Runs of one colour and what looks like a finder, along one line. Features 1 and 3 of table 11.
class QrLinePenalty {
public:
    /// The next module of the line.
    constexpr void add(bool dark) {
        if (dark == last_ && run_ > 0) {
            ++run_;
            if (run_ == 5) points_ += 3;
            if (run_ > 5) ++points_;
        } else {
            run_ = 1;
            last_ = dark;
        }
        // 1:1:3:1:1 with four light modules before or behind: 00001011101 and 10111010000.
        history_ = (history_ << 1 | (dark ? 1U : 0U)) & 0x7FF;
        if (++count_ >= 11 && (history_ == 0x05D || history_ == 0x5D0)) points_ += 40;
    }
    constexpr int points() const { return points_; }

private:
    bool last_ = false;
    int run_ = 0;
    int count_ = 0;
    unsigned history_ = 0;
    int points_ = 0;
};

/// The points of all four features: the fewer, the better. At most about 2^19.
inline int qr_mask_penalty(BitView<const BitWord> modules) {
    const int size = modules.width();
    int points = 0;
    int dark = 0;
    for (int i = 0; i < size; ++i) {
        QrLinePenalty row;
        QrLinePenalty column;
        for (int j = 0; j < size; ++j) {
            row.add(modules(j, i));
            column.add(modules(i, j));
            dark += modules(j, i) ? 1 : 0;
        }
        points += row.points() + column.points();
    }
    for (int y = 0; y + 1 < size; ++y) {
        for (int x = 0; x + 1 < size; ++x) {
            const bool colour = modules(x, y);
            if (modules(x + 1, y) == colour && modules(x, y + 1) == colour && modules(x + 1, y + 1) == colour)
                points += 3;
        }
    }
    // Ten points for every full twentieth that the share of dark modules is off a half.
    const int total = size * size;
    const int off = maximum(dark * 20 - total * 10, total * 10 - dark * 20);
    return points + off / total * 10;
}

}  // namespace fovea::detail
