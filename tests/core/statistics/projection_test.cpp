// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/statistics/projection.hpp>
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

}  // namespace
}  // namespace fovea::test
