// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/statistics/projection.hpp>
#include <fovea/stream/stream.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

Span<std::uint32_t> span_of(std::vector<std::uint32_t>& sums) {
    return {sums.data(), static_cast<std::ptrdiff_t>(sums.size())};
}

TEST(Projection, SumsEveryColumnAndEveryRow) {
    Random random(161);
    for (const Size size : test_sizes()) {
        GuardedImage<Gray8> src(size);
        src.fill(random);
        std::vector<std::uint32_t> columns(static_cast<std::size_t>(size.width), 7);
        std::vector<std::uint32_t> rows(static_cast<std::size_t>(size.height), 7);
        std::vector<std::uint32_t> expected_columns(columns.size());
        std::vector<std::uint32_t> expected_rows(rows.size());
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
                expected_columns[static_cast<std::size_t>(x)] += src(x, y);
                expected_rows[static_cast<std::size_t>(y)] += src(x, y);
            }
        ASSERT_EQ(project_columns(src.view(), span_of(columns)), Status::ok);
        ASSERT_EQ(project_rows(src.view(), span_of(rows)), Status::ok);
        EXPECT_EQ(columns, expected_columns);
        EXPECT_EQ(rows, expected_rows);
    }
}

TEST(Projection, OfAWhiteImageIsTheLengthTimes255) {
    GuardedImage<Gray8> src({33, 21});
    src.fill(Gray8{255});
    std::vector<std::uint32_t> columns(33);
    std::vector<std::uint32_t> rows(21);
    ASSERT_EQ(project_columns(src.view(), span_of(columns)), Status::ok);
    ASSERT_EQ(project_rows(src.view(), span_of(rows)), Status::ok);
    for (const std::uint32_t sum : columns) EXPECT_EQ(sum, 21u * 255);
    for (const std::uint32_t sum : rows) EXPECT_EQ(sum, 33u * 255);
}

TEST(Projection, SaysWhatIsWrongAndLeavesTheSums) {
    GuardedImage<Gray8> src({4, 3});
    src.fill(Gray8{1});
    std::vector<std::uint32_t> sums(5, 7);
    EXPECT_EQ(project_columns(ImageView<const Gray8>(), span_of(sums)), Status::empty_image);
    EXPECT_EQ(project_rows(ImageView<const Gray8>(), span_of(sums)), Status::empty_image);
    EXPECT_EQ(project_columns(src.view(), span_of(sums)), Status::size_mismatch);
    EXPECT_EQ(project_rows(src.view(), span_of(sums).first(2)), Status::size_mismatch);
    EXPECT_EQ(sums, std::vector<std::uint32_t>(5, 7));
}

TEST(ProjectionAccumulators, GiveTheSameOfRowsAndOfStrips) {
    Random random(162);
    for (const Size size : test_sizes()) {
        GuardedImage<Gray8> image(size);
        image.fill(random);
        const ImageView<const Gray8> src = image.view();
        std::vector<std::uint32_t> columns(static_cast<std::size_t>(size.width)), made = columns,
                                                                                  part = columns;
        std::vector<std::uint32_t> rows(static_cast<std::size_t>(size.height)), made_rows = rows;
        ASSERT_EQ(project_columns(src, span_of(columns)), Status::ok);
        ASSERT_EQ(project_rows(src, span_of(rows)), Status::ok);
        std::vector<std::uint8_t> scratch(1 << 12);
        const Span<std::uint8_t> work{scratch.data(), 1 << 12};
        RowProjection of_rows(span_of(made_rows));
        auto upper = stream(tap(of_rows), ColumnProjection(span_of(made)));
        ASSERT_EQ(upper.run_strip(src, Border::zero, 0, size.height / 2, work), Status::ok);
        if (size.height > 1) {
            auto lower = stream(tap(of_rows), ColumnProjection(span_of(part)));
            ASSERT_EQ(lower.run_strip(src, Border::zero, size.height / 2 + 1, size.height - 1, work),
                      size.height / 2 + 1 < size.height ? Status::ok : Status::out_of_range);
            ASSERT_EQ(upper.accumulator().merge(lower.accumulator()), Status::ok);
        }
        EXPECT_EQ(made, columns);
        EXPECT_EQ(made_rows, rows);
    }
}

TEST(ProjectionAccumulators, RefuseAnotherCountOfSums) {
    std::vector<std::uint32_t> sums(5, 7), others(4, 1);
    ColumnProjection columns(span_of(sums));
    EXPECT_EQ(columns.begin({4, 5}), Status::size_mismatch);
    EXPECT_EQ(RowProjection(span_of(sums)).begin({5, 4}), Status::size_mismatch);
    EXPECT_EQ(columns.merge(ColumnProjection(span_of(others))), Status::size_mismatch);
    EXPECT_EQ(sums, std::vector<std::uint32_t>(5, 7));
}

}  // namespace
}  // namespace fovea::test
