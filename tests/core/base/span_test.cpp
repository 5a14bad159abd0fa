// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <type_traits>

#include <fovea/base/span.hpp>

namespace fovea::test {
namespace {

TEST(Span, IsEmptyAtFirst) {
    const Span<int> none;
    EXPECT_TRUE(none.empty());
    EXPECT_EQ(none.size(), 0);
    EXPECT_EQ(none.data(), nullptr);
    EXPECT_EQ(none.begin(), none.end());
    EXPECT_TRUE(none.first(0).empty());
    EXPECT_TRUE(none.from(0).empty());
}

TEST(Span, SeesAllOfAnArrayAndWritesThroughIt) {
    int numbers[] = {1, 2, 3};
    const Span<int> span = numbers;
    EXPECT_EQ(span.size(), 3);
    for (int& number : span) number *= 2;
    span[0] = 7;
    EXPECT_EQ(numbers[0], 7);
    EXPECT_EQ(numbers[2], 6);
}

TEST(Span, IsCutAtBothEnds) {
    int numbers[] = {1, 2, 3, 4, 5};
    const Span<int> span(numbers);
    EXPECT_EQ(span.first(2).size(), 2);
    EXPECT_EQ(span.first(2)[1], 2);
    EXPECT_EQ(span.from(3).size(), 2);
    EXPECT_EQ(span.from(3)[0], 4);
    EXPECT_EQ(span.from(1).first(3)[2], 4);
    EXPECT_EQ(span.first(5).size(), 5);
    EXPECT_TRUE(span.from(5).empty());
    EXPECT_EQ(span.from(5).data(), numbers + 5);
    EXPECT_TRUE(span.first(0).empty());
}

TEST(Span, BecomesReadOnlyButNeverWritable) {
    int numbers[] = {1, 2};
    const Span<const int> view = Span<int>(numbers);
    EXPECT_EQ(view.data(), numbers);
    EXPECT_EQ(view.size(), 2);
    static_assert(std::is_convertible_v<Span<int>, Span<const int>>);
    static_assert(!std::is_convertible_v<Span<const int>, Span<int>>);
    static_assert(!std::is_convertible_v<Span<int>, Span<const long>>);
    static_assert(std::is_same_v<Span<const int>::value_type, int>);
}

template <class T>
T sum_into(NonDeduced<Span<const T>> from, T& to) {
    for (const T& element : from) to = static_cast<T>(to + element);
    return to;
}

TEST(NonDeduced, LetsAnOutputAloneDecideTheType) {
    int numbers[] = {1, 2, 3};
    int sum = 0;
    EXPECT_EQ(sum_into(Span<int>(numbers), sum), 6);
}

TEST(Span, WorksInConstants) {
    static constexpr int numbers[] = {4, 5, 6};
    static_assert(Span<const int>(numbers).from(1)[1] == 6);
}

#if !defined(NDEBUG)
TEST(SpanDeathTest, StopsAtWhatLiesOutsideWhileDebugging) {
    int numbers[] = {1, 2};
    const Span<int> span(numbers);
    EXPECT_DEATH(static_cast<void>(span[2]), "");
    EXPECT_DEATH(static_cast<void>(span[-1]), "");
    EXPECT_DEATH(static_cast<void>(span.first(3)), "");
    EXPECT_DEATH(static_cast<void>(span.from(3)), "");
    EXPECT_DEATH(static_cast<void>(Span<int>(numbers, -1)), "");
}
#endif

}  // namespace
}  // namespace fovea::test
