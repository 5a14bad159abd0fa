// SPDX-License-Identifier: MIT
//
// Where the bits of Data Matrix codewords stand: the diagonals of eight modules, and the four corners.
#pragma once

#include <cstdint>

#include <fovea/base/assert.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/code/data_matrix_sizes.hpp>
#include <fovea/image/bit_view.hpp>
#include <fovea/image/geometry.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Scratch words that the codewords of a symbol of any size need: a bit for every module.
inline constexpr int data_matrix_placement_scratch = bit_words(132) * 132;

/// The codewords of a symbol, from the modules of its regions.
///
/// Shapes   modules of size.rows and size.columns; codewords size.codewords() of them
/// Scratch  data_matrix_placement_scratch words, undefined afterwards
/// Errors   size_mismatch; scratch_too_small; buffer_too_small
/// Source   ISO/IEC 16022, annex F
inline Status data_matrix_codewords(BitView<const BitWord> modules, const DataMatrixSize& size,
                                    Span<BitWord> scratch, Span<std::uint8_t> codewords);

/// The modules of a symbol, finder patterns and alignment bars included, from its codewords.
///
/// Errors  as data_matrix_codewords()
inline Status data_matrix_modules(Span<const std::uint8_t> codewords, const DataMatrixSize& size,
                                  Span<BitWord> scratch, BitView<BitWord> modules);

/// Whether the module at column x and row y belongs to a border of a region, and what it is there.
enum class DataMatrixModule : std::uint8_t { data, dark, light };
constexpr DataMatrixModule data_matrix_border(const DataMatrixSize& size, int x, int y);

// ---- Implementation ---------------------------------------------------------------

constexpr DataMatrixModule data_matrix_border(const DataMatrixSize& size, int x, int y) {
    // ISO/IEC 16022, 5.2: solid on the left and below, from there alternating on the right and above.
    const int width = size.region_columns() + 2;
    const int height = size.region_rows() + 2;
    const int column = x % width;
    const int row = y % height;
    if (column == 0 || row == height - 1) return DataMatrixModule::dark;
    if (row == 0) return column % 2 == 0 ? DataMatrixModule::dark : DataMatrixModule::light;
    if (column == width - 1) return row % 2 != 0 ? DataMatrixModule::dark : DataMatrixModule::light;
    return DataMatrixModule::data;
}

namespace detail {

/// The modules of the whole symbol at places of the mapping matrix.
class DataMatrixPlaces {
public:
    constexpr explicit DataMatrixPlaces(const DataMatrixSize& size)
        : columns_(reciprocal(size.region_columns())), rows_(reciprocal(size.region_rows())) {}

    constexpr Point operator()(int column, int row) const {
        return {column + 1 + 2 * (column * columns_ >> 16), row + 1 + 2 * (row * rows_ >> 16)};
    }

private:
    /// n times it, shifted by 16, is n / divisor while n * divisor is below 2^16, and sides are below 2^8.
    static constexpr int reciprocal(int divisor) { return (1 << 16) / divisor + 1; }

    int columns_;
    int rows_;
};

/// visit(x, y, dark) for the modules of the borders of all regions.
template <class Visit>
constexpr void visit_borders(const DataMatrixSize& size, Visit visit) {
    const int width = size.region_columns() + 2;
    const int height = size.region_rows() + 2;
    for (int top = 0; top < size.rows; top += height) {
        for (int row = 0; row < height; ++row) {
            const bool whole = row == 0 || row == height - 1;
            for (int left = 0; left < size.columns; left += width) {
                for (int i = 0; i < width; i += whole ? 1 : width - 1) {
                    const bool dark = i == 0 || row == height - 1 || (row == 0 ? i % 2 == 0 : row % 2 != 0);
                    visit(left + i, top + row, dark);
                }
            }
        }
    }
}

/// Walks the mapping matrix of a size and tells for every codeword where its bits are.
class DataMatrixWalk {
public:
    DataMatrixWalk(const DataMatrixSize& size, BitView<BitWord> taken)
        : width_(size.mapping().width), height_(size.mapping().height), taken_(taken) {
        for (int y = 0; y < height_; ++y)
            for (int i = 0; i < bit_words(width_); ++i) taken_.row(y)[i] = 0;
    }

    /// visit(codeword, bit, column, row) for every bit, the most significant being 7.
    template <class Visit>
    void operator()(Visit visit) {
        int next = 0;
        int row = 4;
        int column = 0;
        do {
            if (row == height_ && column == 0) corner(corner_1, next++, visit);
            if (row == height_ - 2 && column == 0 && width_ % 4 != 0) corner(corner_2, next++, visit);
            if (row == height_ - 2 && column == 0 && width_ % 8 == 4) corner(corner_3, next++, visit);
            if (row == height_ + 4 && column == 2 && width_ % 8 == 0) corner(corner_4, next++, visit);
            // Upwards to the right, then downwards to the left.
            do {
                if (row < height_ && column >= 0 && !taken_(column, row))
                    diagonal(next++, column, row, visit);
                row -= 2;
                column += 2;
            } while (row >= 0 && column < width_);
            row += 1;
            column += 3;
            do {
                if (row >= 0 && column < width_ && !taken_(column, row)) diagonal(next++, column, row, visit);
                row += 2;
                column -= 2;
            } while (row < height_ && column >= 0);
            row += 3;
            column += 1;
        } while (row < height_ || column < width_);
    }
    bool taken(int column, int row) const { return taken_(column, row); }

private:
    /// Row and column of a bit; below 0 counted from the end.
    struct Place {
        std::int8_t row;
        std::int8_t column;
    };
    // ISO/IEC 16022, annex F.3, figures F.3 to F.6: bit 8 first.
    static constexpr Place corner_1[8] = {{-1, 0}, {-1, 1}, {-1, 2}, {0, -2},
                                          {0, -1}, {1, -1}, {2, -1}, {3, -1}};
    static constexpr Place corner_2[8] = {{-3, 0}, {-2, 0}, {-1, 0}, {0, -4},
                                          {0, -3}, {0, -2}, {0, -1}, {1, -1}};
    static constexpr Place corner_3[8] = {{-3, 0}, {-2, 0}, {-1, 0}, {0, -2},
                                          {0, -1}, {1, -1}, {2, -1}, {3, -1}};
    static constexpr Place corner_4[8] = {{-1, 0}, {-1, -1}, {0, -3}, {0, -2},
                                          {0, -1}, {1, -3},  {1, -2}, {1, -1}};
    /// Figure F.1, from the last module, whose place the codeword has.
    static constexpr Place shape[8] = {{-2, -2}, {-2, -1}, {-1, -2}, {-1, -1},
                                       {-1, 0},  {0, -2},  {0, -1},  {0, 0}};

    template <class Visit>
    void at(int codeword, int bit, int column, int row, Visit& visit) {
        // What leaves the matrix above or on the left comes in again on the other side, shifted so that the
        // halves meet: annex F.2.
        if (row < 0) {
            row += height_;
            column += 4 - (height_ + 4) % 8;
        }
        if (column < 0) {
            column += width_;
            row += 4 - (width_ + 4) % 8;
        }
        // 8x32, 8x64 and others of the extension leave below too.
        if (row >= height_) row -= height_;
        FOVEA_ASSERT(row >= 0 && row < height_ && column >= 0 && column < width_);
        taken_.set(column, row, true);
        visit(codeword, bit, column, row);
    }
    template <class Visit>
    void diagonal(int codeword, int column, int row, Visit& visit) {
        for (int i = 0; i < 8; ++i) at(codeword, 7 - i, column + shape[i].column, row + shape[i].row, visit);
    }
    template <class Visit>
    void corner(const Place (&places)[8], int codeword, Visit& visit) {
        for (int i = 0; i < 8; ++i) {
            const Place p = places[i];
            at(codeword, 7 - i, p.column < 0 ? width_ + p.column : p.column,
               p.row < 0 ? height_ + p.row : p.row, visit);
        }
    }

    int width_;
    int height_;
    BitView<BitWord> taken_;
};

inline Status check_data_matrix(Size modules, const DataMatrixSize& size, std::ptrdiff_t codewords,
                                std::ptrdiff_t scratch) {
    if (modules != Size{size.columns, size.rows}) return Status::size_mismatch;
    if (codewords < size.codewords()) return Status::buffer_too_small;
    if (scratch < data_matrix_placement_scratch) return Status::scratch_too_small;
    return Status::ok;
}

}  // namespace detail

inline Status data_matrix_codewords(BitView<const BitWord> modules, const DataMatrixSize& size,
                                    Span<BitWord> scratch, Span<std::uint8_t> codewords) {
    const Status s = detail::check_data_matrix(modules.size(), size, codewords.size(), scratch.size());
    if (s != Status::ok) return s;
    for (int i = 0; i < size.codewords(); ++i) codewords[i] = 0;
    const Size mapping = size.mapping();
    const detail::DataMatrixPlaces places(size);
    detail::DataMatrixWalk walk(size, {scratch.data(), mapping, bit_words(mapping.width)});
    walk([&](int codeword, int bit, int column, int row) {
        const Point p = places(column, row);
        if (modules(p.x, p.y))
            codewords[codeword] = static_cast<std::uint8_t>(codewords[codeword] | 1 << bit);
    });
    return Status::ok;
}

inline Status data_matrix_modules(Span<const std::uint8_t> codewords, const DataMatrixSize& size,
                                  Span<BitWord> scratch, BitView<BitWord> modules) {
    const Status s = detail::check_data_matrix(modules.size(), size, codewords.size(), scratch.size());
    if (s != Status::ok) return s;
    for (int y = 0; y < size.rows; ++y) {
        for (int i = 0; i < bit_words(size.columns); ++i) modules.row(y)[i] = 0;
        for (int x = 0; x < size.columns; ++x)
            if (data_matrix_border(size, x, y) == DataMatrixModule::dark) modules.set(x, y, true);
    }
    const Size mapping = size.mapping();
    const detail::DataMatrixPlaces places(size);
    detail::DataMatrixWalk walk(size, {scratch.data(), mapping, bit_words(mapping.width)});
    walk([&](int codeword, int bit, int column, int row) {
        const Point p = places(column, row);
        modules.set(p.x, p.y, (codewords[codeword] >> bit & 1) != 0);
    });
    // The lower right corner that no codeword fills: annex F.4.
    if (!walk.taken(mapping.width - 1, mapping.height - 1)) {
        const Point p = places(mapping.width - 1, mapping.height - 1);
        modules.set(p.x, p.y, true);
        modules.set(p.x - 1, p.y - 1, true);
    }
    return Status::ok;
}

}  // namespace fovea
