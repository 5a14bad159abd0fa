// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/code/data_matrix_placement.hpp>

namespace fovea::test {
namespace {

using Modules = BitStorage<max_data_matrix_side, max_data_matrix_side>;

template <class T>
Span<T> all_of(std::vector<T>& values) {
    return {values.data(), static_cast<std::ptrdiff_t>(values.size())};
}
BitView<BitWord> upper_left(Modules& modules, const DataMatrixSize& size) {
    return {modules.view().first(), {size.columns, size.rows}, modules.view().stride_words()};
}

TEST(DataMatrixPlacement, PutsTheFirstCodewordsWhereTheStandardShowsThem) {
    // ISO/IEC 16022, annex F, the matrix of 8x8: codeword 1 ends at row 4 and column 0, codeword 2 begins at
    // row 0 and column 0.
    const DataMatrixSize& size = data_matrix_sizes[0];
    std::vector<BitWord> scratch(data_matrix_placement_scratch);
    const auto modules_of = [&](int codeword, int bit) {
        std::vector<std::uint8_t> codewords(8, 0);
        codewords[static_cast<std::size_t>(codeword)] = static_cast<std::uint8_t>(1 << bit);
        static Modules modules;
        EXPECT_EQ(data_matrix_modules(all_of(codewords), size, all_of(scratch), upper_left(modules, size)),
                  Status::ok);
        for (int y = 1; y < 9; ++y)
            for (int x = 1; x < 9; ++x)
                if (modules.view()(x, y)) return Point{x - 1, y - 1};
        return Point{-1, -1};
    };
    EXPECT_EQ(modules_of(0, 0), (Point{0, 4}));
    EXPECT_EQ(modules_of(1, 7), (Point{0, 0}));
    EXPECT_EQ(modules_of(1, 6), (Point{1, 0}));
    EXPECT_EQ(modules_of(1, 0), (Point{2, 2}));
}

TEST(DataMatrixPlacement, ReadsBackTheCodewordsOfEverySize) {
    Random random(5);
    std::vector<BitWord> scratch(data_matrix_placement_scratch);
    for (const DataMatrixSize& size : data_matrix_sizes) {
        std::vector<std::uint8_t> codewords(static_cast<std::size_t>(size.codewords()));
        std::vector<std::uint8_t> read(codewords.size());
        for (std::uint8_t& codeword : codewords) codeword = static_cast<std::uint8_t>(random.between(0, 255));
        Modules modules;
        const BitView<BitWord> view = upper_left(modules, size);
        ASSERT_EQ(data_matrix_modules(all_of(codewords), size, all_of(scratch), view), Status::ok);
        ASSERT_EQ(data_matrix_codewords(view, size, all_of(scratch), all_of(read)), Status::ok);
        EXPECT_EQ(read, codewords) << int{size.rows} << "x" << int{size.columns};
    }
}

TEST(DataMatrixPlacement, BordersAreSolidOnTheLeftAndBelowAndAlternateElsewhere) {
    std::vector<BitWord> scratch(data_matrix_placement_scratch);
    for (const DataMatrixSize& size : data_matrix_sizes) {
        std::vector<std::uint8_t> codewords(static_cast<std::size_t>(size.codewords()));
        Modules modules;
        const BitView<BitWord> view = upper_left(modules, size);
        ASSERT_EQ(data_matrix_modules(all_of(codewords), size, all_of(scratch), view), Status::ok);
        for (int y = 0; y < size.rows; ++y) {
            EXPECT_TRUE(view(0, y));
            EXPECT_EQ(view(size.columns - 1, y), y % 2 != 0);
        }
        for (int x = 0; x < size.columns; ++x) {
            EXPECT_TRUE(view(x, size.rows - 1));
            EXPECT_EQ(view(x, 0), x % 2 == 0);
        }
    }
}

TEST(DataMatrixPlacement, SaysWhatIsWrong) {
    const DataMatrixSize& size = data_matrix_sizes[0];
    std::vector<BitWord> scratch(data_matrix_placement_scratch);
    std::vector<std::uint8_t> codewords(8, 7);
    Modules modules;
    const BitView<BitWord> view = upper_left(modules, size);
    EXPECT_EQ(data_matrix_codewords(modules.view(), size, all_of(scratch), all_of(codewords)),
              Status::size_mismatch);
    EXPECT_EQ(data_matrix_codewords(view, size, all_of(scratch).first(10), all_of(codewords)),
              Status::scratch_too_small);
    EXPECT_EQ(data_matrix_codewords(view, size, all_of(scratch), all_of(codewords).first(7)),
              Status::buffer_too_small);
    EXPECT_EQ(data_matrix_modules(all_of(codewords).first(7), size, all_of(scratch), view),
              Status::buffer_too_small);
    for (const std::uint8_t codeword : codewords) EXPECT_EQ(codeword, 7);
}

TEST(DataMatrixPlacement, PlacesAndBordersAreThoseOfTheRegions) {
    for (const DataMatrixSize& size : data_matrix_sizes) {
        const detail::DataMatrixPlaces places(size);
        for (int row = 0; row < size.mapping().height; ++row)
            for (int column = 0; column < size.mapping().width; ++column) {
                const Point place = places(column, row);
                ASSERT_EQ(place.x, column + 1 + 2 * (column / size.region_columns()));
                ASSERT_EQ(place.y, row + 1 + 2 * (row / size.region_rows()));
                ASSERT_EQ(data_matrix_border(size, place.x, place.y), DataMatrixModule::data);
            }
        int borders = 0;
        detail::visit_borders(size, [&](int x, int y, bool dark) {
            ++borders;
            ASSERT_EQ(data_matrix_border(size, x, y),
                      dark ? DataMatrixModule::dark : DataMatrixModule::light);
        });
        EXPECT_EQ(borders, size.rows * size.columns - size.mapping().area());
    }
}

}  // namespace
}  // namespace fovea::test
