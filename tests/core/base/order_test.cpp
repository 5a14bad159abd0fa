// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include <fovea/base/order.hpp>
#include <fovea/base/random.hpp>

namespace fovea::test {
namespace {

Span<int> span_of(std::vector<int>& values) {
    return {values.data(), static_cast<std::ptrdiff_t>(values.size())};
}

TEST(Median, TakesTheLowerOfTwoMiddleElements) {
    std::vector<int> odd = {9, 1, 5};
    std::vector<int> even = {4, 8, 2, 6};
    EXPECT_EQ(median(span_of(odd)), 5);
    EXPECT_EQ(median(span_of(even)), 4);
}

TEST(Order, EqualsTheStandardLibraryOnEveryShapeOfInput) {
    Random random(31);
    for (int count : {1, 2, 3, 7, 64, 1000})
        for (int kind = 0; kind < 6; ++kind) {
            std::vector<int> values(static_cast<std::size_t>(count));
            for (int i = 0; i < count; ++i) {
                const int level = kind == 0   ? random.between(-1000, 1000)
                                  : kind == 1 ? i
                                  : kind == 2 ? -i
                                  : kind == 3 ? 7
                                  : kind == 4 ? random.between(0, 2)
                                              : std::min(i, count - i);
                values[static_cast<std::size_t>(i)] = level;
            }
            std::vector<int> sorted = values;
            std::sort(sorted.begin(), sorted.end());
            for (int k : {0, count / 3, count / 2, count - 1}) {
                std::vector<int> parted = values;
                EXPECT_EQ(nth_smallest(span_of(parted), k), sorted[static_cast<std::size_t>(k)]);
                for (int i = 0; i < count; ++i) {
                    const int here = parted[static_cast<std::size_t>(i)];
                    EXPECT_TRUE(i < k ? here <= sorted[static_cast<std::size_t>(k)]
                                      : here >= sorted[static_cast<std::size_t>(k)]);
                }
            }
            std::vector<int> shelled = values;
            sort_nearly_ordered(span_of(shelled), [](int a, int b) { return a < b; });
            EXPECT_EQ(shelled, sorted);
            sort(span_of(values));
            EXPECT_EQ(values, sorted);
        }
}

}  // namespace
}  // namespace fovea::test
