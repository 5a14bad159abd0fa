// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fovea/code/data_matrix_sizes.hpp>
#include <fovea/code/reed_solomon.hpp>

namespace fovea::test {
namespace {

TEST(DataMatrixSizes, CodewordsFillTheRegions) {
    for (const DataMatrixSize& size : data_matrix_sizes) {
        EXPECT_EQ(size.rows % size.regions_down, 0);
        EXPECT_EQ(size.columns % size.regions_across, 0);
        // What is left over is less than a codeword.
        EXPECT_EQ(size.mapping().area() / 8, size.codewords()) << int{size.rows} << "x" << int{size.columns};
    }
}

TEST(DataMatrixSizes, BlocksFitTheErrorCorrection) {
    for (const DataMatrixSize& size : data_matrix_sizes) {
        EXPECT_EQ(size.parity % size.blocks, 0);
        EXPECT_LE(size.block_parity(), max_reed_solomon_parity);
        EXPECT_LE((size.codewords() + size.blocks - 1) / size.blocks, max_reed_solomon_block);
        // The data of block b are the codewords b, b + blocks and so on, and all but those of 144x144 are
        // alike.
        EXPECT_EQ(size.data % size.blocks == 0, size.rows != 144);
    }
}

TEST(DataMatrixSizes, AreFoundByRowsAndColumns) {
    EXPECT_EQ(data_matrix_size(8, 18)->data, 5);
    EXPECT_EQ(data_matrix_size(144, 144)->data, max_data_matrix_data);
    EXPECT_EQ(data_matrix_size(144, 144)->codewords(), max_data_matrix_codewords);
    EXPECT_EQ(data_matrix_size(18, 8), nullptr);
    EXPECT_EQ(data_matrix_size(0, 0), nullptr);
    EXPECT_EQ(data_matrix_size(28, 28), nullptr);
}

TEST(DataMatrixSizes, TheSquaresStandFirstAndThenTheRectangles) {
    for (int i = 0; i < data_matrix_size_count; ++i)
        EXPECT_EQ(data_matrix_sizes[i].square(), i < data_matrix_squares) << i;
    EXPECT_EQ(data_matrix_sizes[data_matrix_plain_sizes - 1].columns, 48);
    EXPECT_EQ(data_matrix_sizes[data_matrix_plain_sizes].columns, 48);
    EXPECT_EQ(data_matrix_sizes[data_matrix_plain_sizes].rows, 8);
}

}  // namespace
}  // namespace fovea::test
