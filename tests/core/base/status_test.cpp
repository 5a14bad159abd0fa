// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cctype>
#include <set>
#include <string>
#include <type_traits>

#include <fovea/base/status.hpp>

namespace fovea::test {
namespace {

constexpr int last_status = static_cast<int>(Status::device_lost);

TEST(Describe, HasAPhraseOfItsOwnForEveryStatus) {
    std::set<std::string> phrases;
    for (int i = 0; i <= last_status; ++i) {
        const std::string phrase = describe(static_cast<Status>(i));
        ASSERT_FALSE(phrase.empty()) << i;
        EXPECT_NE(phrase, "unknown status") << i;
        EXPECT_TRUE(std::islower(static_cast<unsigned char>(phrase.front())) != 0) << phrase;
        EXPECT_NE(phrase.back(), '.') << phrase;
        EXPECT_EQ(phrase.find('\n'), std::string::npos) << phrase;
        phrases.insert(phrase);
    }
    EXPECT_EQ(static_cast<int>(phrases.size()), last_status + 1);
}

TEST(Describe, SaysSoOfANumberThatIsNoStatus) {
    EXPECT_STREQ(describe(static_cast<Status>(last_status + 1)), "unknown status");
    EXPECT_STREQ(describe(static_cast<Status>(255)), "unknown status");
}

struct Pair {
    int first = 1;
    int second = 2;
};

TEST(Result, HoldsAnAnswer) {
    const Result<Pair> answer = Pair{3, 4};
    EXPECT_TRUE(answer.ok());
    EXPECT_TRUE(static_cast<bool>(answer));
    EXPECT_EQ(answer.status(), Status::ok);
    EXPECT_EQ(answer.value().first, 3);
    EXPECT_EQ((*answer).second, 4);
    EXPECT_EQ(answer->second, 4);
}

TEST(Result, HoldsTheReasonWhyThereIsNone) {
    for (int i = 1; i <= last_status; ++i) {
        const Result<int> none = static_cast<Status>(i);
        EXPECT_FALSE(none.ok());
        EXPECT_FALSE(static_cast<bool>(none));
        EXPECT_EQ(none.status(), static_cast<Status>(i));
    }
}

TEST(Result, IsTakenOverByAnotherOne) {
    Result<int> result = Status::not_found;
    result = 5;
    EXPECT_EQ(*result, 5);
    result = Status::degenerate;
    EXPECT_EQ(result.status(), Status::degenerate);
}

TEST(Result, DoesNotPassForANumberByAccident) {
    static_assert(!std::is_convertible_v<Result<int>, bool>);
    static_assert(!std::is_convertible_v<Result<int>, int>);
    static_assert(Result<int>(7).value() == 7);
}

#if !defined(NDEBUG)
TEST(ResultDeathTest, StopsWhoAsksForAnAnswerThatIsNotThereWhileDebugging) {
    const Result<int> none = Status::undecided;
    EXPECT_DEATH(static_cast<void>(*none), "");
    EXPECT_DEATH(static_cast<void>(Result<int>(Status::ok)), "");
}
#endif

}  // namespace
}  // namespace fovea::test
