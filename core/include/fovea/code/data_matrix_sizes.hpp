// SPDX-License-Identifier: MIT
//
// The sizes of Data Matrix symbols: squares, rectangles, and the long rectangles of the extension.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/image/geometry.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// One size of symbol. Its regions are alike; each has a border of one module on its four sides.
struct DataMatrixSize {
    std::uint8_t rows = 0;  ///< modules, finder patterns and alignment bars among them
    std::uint8_t columns = 0;
    std::uint8_t regions_down = 0;
    std::uint8_t regions_across = 0;
    std::int16_t data = 0;    ///< codewords
    std::int16_t parity = 0;  ///< codewords of error correction, of all blocks together
    std::uint8_t blocks = 0;  ///< codeword i, be it data or parity, belongs to block i % blocks

    constexpr bool square() const { return rows == columns; }
    constexpr int codewords() const { return data + parity; }
    constexpr int block_parity() const { return parity / blocks; }
    constexpr int region_rows() const { return rows / regions_down - 2; }
    constexpr int region_columns() const { return columns / regions_across - 2; }
    /// The modules that hold codewords, the regions put together without their borders.
    constexpr Size mapping() const {
        return {region_columns() * regions_across, region_rows() * regions_down};
    }
};

/// All sizes: the 24 squares, the 6 rectangles, the 18 rectangles of the extension, each by data codewords.
///
/// Source  ISO/IEC 16022, 5.5, table 7; ISO/IEC 21471, table 1. Blocks of 144x144 are not alike: 8 of 156
///         data codewords and 2 of 155, which is what codeword i in block i % 10 gives, parity included
inline constexpr DataMatrixSize data_matrix_sizes[] = {
    {10, 10, 1, 1, 3, 5, 1},        {12, 12, 1, 1, 5, 7, 1},        {14, 14, 1, 1, 8, 10, 1},
    {16, 16, 1, 1, 12, 12, 1},      {18, 18, 1, 1, 18, 14, 1},      {20, 20, 1, 1, 22, 18, 1},
    {22, 22, 1, 1, 30, 20, 1},      {24, 24, 1, 1, 36, 24, 1},      {26, 26, 1, 1, 44, 28, 1},
    {32, 32, 2, 2, 62, 36, 1},      {36, 36, 2, 2, 86, 42, 1},      {40, 40, 2, 2, 114, 48, 1},
    {44, 44, 2, 2, 144, 56, 1},     {48, 48, 2, 2, 174, 68, 1},     {52, 52, 2, 2, 204, 84, 2},
    {64, 64, 4, 4, 280, 112, 2},    {72, 72, 4, 4, 368, 144, 4},    {80, 80, 4, 4, 456, 192, 4},
    {88, 88, 4, 4, 576, 224, 4},    {96, 96, 4, 4, 696, 272, 4},    {104, 104, 4, 4, 816, 336, 6},
    {120, 120, 6, 6, 1050, 408, 6}, {132, 132, 6, 6, 1304, 496, 8}, {144, 144, 6, 6, 1558, 620, 10},
    {8, 18, 1, 1, 5, 7, 1},         {8, 32, 1, 2, 10, 11, 1},       {12, 26, 1, 1, 16, 14, 1},
    {12, 36, 1, 2, 22, 18, 1},      {16, 36, 1, 2, 32, 24, 1},      {16, 48, 1, 2, 49, 28, 1},
    {8, 48, 1, 2, 18, 15, 1},       {8, 64, 1, 4, 24, 18, 1},       {8, 80, 1, 4, 32, 22, 1},
    {8, 96, 1, 4, 38, 28, 1},       {12, 64, 1, 4, 43, 27, 1},      {20, 36, 1, 2, 44, 28, 1},
    {8, 120, 1, 6, 49, 32, 1},      {20, 44, 1, 2, 56, 34, 1},      {16, 64, 1, 4, 62, 36, 1},
    {8, 144, 1, 6, 63, 36, 1},      {12, 88, 1, 4, 64, 36, 1},      {26, 40, 1, 2, 70, 38, 1},
    {22, 48, 1, 2, 72, 38, 1},      {24, 48, 1, 2, 80, 41, 1},      {20, 64, 1, 4, 84, 42, 1},
    {26, 48, 1, 2, 90, 42, 1},      {24, 64, 1, 4, 108, 46, 1},     {26, 64, 1, 4, 118, 50, 1},
};
inline constexpr int data_matrix_size_count = 48;
inline constexpr int data_matrix_squares = 24;      ///< of them, at the beginning
inline constexpr int data_matrix_plain_sizes = 30;  ///< squares and rectangles without the extension

inline constexpr int max_data_matrix_side = 144;
inline constexpr int min_data_matrix_side = 8;
inline constexpr int max_data_matrix_codewords = 1558 + 620;
inline constexpr int max_data_matrix_data = 1558;
/// The longest text: two digits a codeword.
inline constexpr int max_data_matrix_text = 2 * max_data_matrix_data;

/// The size with that many rows and columns, or nullptr.
constexpr const DataMatrixSize* data_matrix_size(int rows, int columns);

// ---- Implementation ---------------------------------------------------------------

static_assert(sizeof(data_matrix_sizes) / sizeof(data_matrix_sizes[0]) == data_matrix_size_count,
              "the count is that of the table");

constexpr const DataMatrixSize* data_matrix_size(int rows, int columns) {
    for (const DataMatrixSize& size : data_matrix_sizes)
        if (size.rows == rows && size.columns == columns) return &size;
    return nullptr;
}

}  // namespace fovea
