// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <type_traits>
#include <vector>

#include <fovea/base/list.hpp>

namespace fovea::test {
namespace {

template <class Sequence>
std::vector<int> contents(const Sequence& list) {
    return {list.begin(), list.end()};
}

TEST(List, BeginsEmptyAndTakesElementsUpToItsCapacity) {
    List<int, 3> list;
    EXPECT_TRUE(list.empty());
    EXPECT_EQ(list.push(7), Status::ok);
    EXPECT_EQ(list.push(8), Status::ok);
    EXPECT_FALSE(list.view().full());
    EXPECT_EQ(list.push(9), Status::ok);
    EXPECT_TRUE(list.view().full());
    EXPECT_EQ(list.push(10), Status::capacity_exceeded);
    EXPECT_EQ(contents(list), (std::vector<int>{7, 8, 9}));
    list.clear();
    EXPECT_TRUE(list.empty());
    EXPECT_EQ(list.size(), 0);
    EXPECT_EQ(list.push(11), Status::ok);
    EXPECT_EQ(list[0], 11);
}

TEST(List, IsSeenAndChangedThroughItsView) {
    List<int, 4> list;
    const ListView<int> view = list;
    EXPECT_EQ(view.capacity(), 4);
    EXPECT_EQ(view.push(1), Status::ok);
    EXPECT_EQ(list.push(2), Status::ok);
    EXPECT_EQ(view.size(), 2);
    view[1] = 5;
    EXPECT_EQ(list[1], 5);
    for (int& element : view) element *= 10;
    EXPECT_EQ(contents(list), (std::vector<int>{10, 50}));
    EXPECT_EQ(view.span().data(), list.begin());
    EXPECT_EQ(view.span().size(), 2);
    view.clear();
    EXPECT_TRUE(list.empty());
    EXPECT_TRUE(view.empty());
}

TEST(List, ReadsAloneWhenItIsConstant) {
    List<int, 2> list;
    EXPECT_EQ(list.push(3), Status::ok);
    const List<int, 2>& constant = list;
    EXPECT_EQ(constant[0], 3);
    EXPECT_EQ(contents(constant), std::vector<int>{3});
    static_assert(std::is_same_v<decltype(constant.span()), Span<const int>>);
    static_assert(std::is_same_v<decltype(constant[0]), const int&>);
}

TEST(ListView, AppendsTheElementThatStoodThereBefore) {
    List<int, 2> list;
    EXPECT_EQ(list.push(1), Status::ok);
    EXPECT_EQ(list.push(2), Status::ok);
    list.clear();
    int* first = list.view().append();
    ASSERT_NE(first, nullptr);
    EXPECT_EQ(*first, 1);
    *first = 9;
    ASSERT_NE(list.view().append(), nullptr);
    EXPECT_EQ(list.view().append(), nullptr);
    EXPECT_EQ(contents(list), (std::vector<int>{9, 2}));
}

TEST(ListView, ShrinksToItsFirstElements) {
    List<int, 4> list;
    for (int i = 0; i < 4; ++i) EXPECT_EQ(list.push(i), Status::ok);
    list.view().shrink(4);
    EXPECT_EQ(list.size(), 4);
    list.view().shrink(2);
    EXPECT_EQ(contents(list), (std::vector<int>{0, 1}));
    list.view().shrink(0);
    EXPECT_TRUE(list.empty());
}

TEST(ListView, OfNoCapacityIsEmptyAndFullAtOnce) {
    int size = 0;
    const ListView<int> none(nullptr, 0, &size);
    EXPECT_TRUE(none.empty());
    EXPECT_TRUE(none.full());
    EXPECT_EQ(none.push(1), Status::capacity_exceeded);
    EXPECT_EQ(none.append(), nullptr);
    EXPECT_EQ(size, 0);
}

TEST(List, WorksInConstants) {
    constexpr auto sum = [] {
        List<int, 3> list;
        for (int i = 1; i <= 3; ++i)
            if (list.push(i) != Status::ok) return -1;
        int total = 0;
        for (const int element : list) total += element;
        return total;
    }();
    static_assert(sum == 6);
}

#if !defined(NDEBUG)
TEST(ListDeathTest, StopsAtAnIndexBeyondItsElementsWhileDebugging) {
    List<int, 4> list;
    EXPECT_EQ(list.push(1), Status::ok);
    EXPECT_DEATH(static_cast<void>(list[1]), "");
    EXPECT_DEATH(static_cast<void>(list.view()[-1]), "");
    EXPECT_DEATH(list.view().shrink(2), "");
}
#endif

}  // namespace
}  // namespace fovea::test
