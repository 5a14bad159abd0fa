// SPDX-License-Identifier: MIT
//
// The modules of a QR code: which are patterns, which are words of their own, and the way of the codewords.
// ISO/IEC 18004, clauses 6.3 and 7.7.
#pragma once

#include <cstdint>

#include <fovea/code/qr_tables.hpp>
#include <fovea/image/bit_view.hpp>
#include <fovea/image/geometry.hpp>

namespace fovea::detail {

/// The shape of a version's patterns.
class QrPatterns {
public:
    explicit constexpr QrPatterns(int version) : version_(version), size_(qr_size(version)) {
        for (int i = 0; i < qr_alignment_lines(version); ++i) {
            const int line = qr_alignment_line(version, i);
            for (int away = -2; away <= 2; ++away) {
                distance_[line + away] = static_cast<std::int8_t>(away < 0 ? -away : away);
            }
        }
    }

    constexpr int size() const { return size_; }
    /// Whether the module belongs to no codeword.
    constexpr bool reserved(int x, int y) const {
        if (x == timing || y == timing) return true;
        const bool left = x <= 8;
        const bool top = y <= 8;
        const bool right = x >= size_ - 8;
        const bool bottom = y >= size_ - 8;
        if ((left && (top || bottom)) || (right && top)) return true;
        if (in_alignment_pattern(x, y)) return true;
        return version_ >= min_told_qr_version && ((x >= size_ - 11 && y < 6) || (y >= size_ - 11 && x < 6));
    }
    /// Whether a reserved module is dark in every symbol of the version. The words are light.
    constexpr bool dark(int x, int y) const {
        if (in_finder(x, y)) return finder_dark(x < 7 ? x : x - (size_ - 7), y < 7 ? y : y - (size_ - 7));
        if (in_alignment_pattern(x, y)) return maximum(distance_[x], distance_[y]) != 1;
        const bool row = y == timing && x > 7 && x < size_ - 8;
        const bool column = x == timing && y > 7 && y < size_ - 8;
        if (row || column) return (row ? x : y) % 2 == 0;
        return x == 8 && y == size_ - 8;  // the dark module beside the format
    }
    static constexpr int timing = 6;

private:
    constexpr bool in_finder(int x, int y) const {
        return (x < 7 && (y < 7 || y >= size_ - 7)) || (x >= size_ - 7 && y < 7);
    }
    static constexpr bool finder_dark(int x, int y) {
        const int away = maximum(x < 3 ? 3 - x : x - 3, y < 3 ? 3 - y : y - 3);
        return away != 2;
    }
    /// Those at the three finders are left out.
    constexpr bool in_alignment_pattern(int x, int y) const {
        if (distance_[x] < 0 || distance_[y] < 0) return false;
        const bool low_x = x <= 8;
        const bool low_y = y <= 8;
        return !(low_x && (low_y || y >= size_ - 9)) && !(low_y && x >= size_ - 9);
    }
    static constexpr std::int8_t far = -1;

    struct Distances {
        std::int8_t values[max_qr_size] = {};
        constexpr Distances() {
            for (std::int8_t& value : values) value = far;
        }
        constexpr std::int8_t& operator[](int i) { return values[i]; }
        constexpr std::int8_t operator[](int i) const { return values[i]; }
    };

    int version_;
    int size_;
    Distances distance_;  ///< from the nearest alignment line, far beyond 2
};

/// Goes the way of the codewords: two columns at a time from the right, up and down in turn, past the timing
/// column and what is reserved. visit(x, y, index) for every bit in its order. Clause 7.7.3.
template <class Visit>
constexpr void along_qr_codewords(const QrPatterns& patterns, Visit visit) {
    const int size = patterns.size();
    int index = 0;
    bool up = true;
    for (int right = size - 1; right > 0; right -= 2) {
        if (right == QrPatterns::timing) --right;
        for (int i = 0; i < size; ++i) {
            const int y = up ? size - 1 - i : i;
            for (int x = right; x > right - 2; --x) {
                if (!patterns.reserved(x, y)) visit(x, y, index++);
            }
        }
        up = !up;
    }
}

/// Whether a mask turns the module over. Clause 7.8.2, table 10, whose i is the row y and j the column x.
constexpr bool qr_mask(int mask, int x, int y) {
    switch (mask) {
        case 0: return (x + y) % 2 == 0;
        case 1: return y % 2 == 0;
        case 2: return x % 3 == 0;
        case 3: return (x + y) % 3 == 0;
        case 4: return (y / 2 + x / 3) % 2 == 0;
        case 5: return x * y % 2 + x * y % 3 == 0;
        case 6: return (x * y % 2 + x * y % 3) % 2 == 0;
        default: return ((x + y) % 2 + x * y % 3) % 2 == 0;
    }
}

/// Where bit i of the format stands, 14 the first: copy 0 around the upper left finder, copy 1 at the two
/// others. Clause 7.9.1, figure 25.
constexpr Point qr_format_place(int size, int copy, int bit) {
    if (copy == 0) {
        if (bit < 6) return {8, bit};
        if (bit < 8) return {8, bit + 1};
        if (bit == 8) return {7, 8};
        return {14 - bit, 8};
    }
    if (bit < 8) return {size - 1 - bit, 8};
    return {8, size - 15 + bit};
}
/// Where bit i of the version stands: copy 0 at the upper right finder, copy 1 at the lower left. Clause
/// 7.10, figure 28.
constexpr Point qr_version_place(int size, int copy, int bit) {
    const int across = size - 11 + bit % 3;
    const int along = bit / 3;
    return copy == 0 ? Point{across, along} : Point{along, across};
}

/// Modules as one reads them, or as they are seen in a mirror.
struct QrModules {
    BitView<const BitWord> bits;
    bool mirrored = false;

    bool operator()(int x, int y) const { return mirrored ? bits(y, x) : bits(x, y); }
    unsigned format_word(int copy) const {
        unsigned word = 0;
        for (int bit = 0; bit < 15; ++bit) {
            const Point place = qr_format_place(bits.width(), copy, bit);
            if ((*this)(place.x, place.y)) word |= 1U << bit;
        }
        return word;
    }
    unsigned version_word(int copy) const {
        unsigned word = 0;
        for (int bit = 0; bit < 18; ++bit) {
            const Point place = qr_version_place(bits.width(), copy, bit);
            if ((*this)(place.x, place.y)) word |= 1U << bit;
        }
        return word;
    }
};

}  // namespace fovea::detail
