// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>

#include <fovea/code/code.hpp>

namespace fovea::test {
namespace {

TEST(CodeText, KeepsBytesAndWhereTheyBeginToMeanSomethingElse) {
    std::uint8_t room[4] = {};
    CodeText text({room, 4});
    EXPECT_EQ(text.push('a'), Status::ok);
    EXPECT_EQ(text.begin_segment(26), Status::ok);
    EXPECT_EQ(text.push('b'), Status::ok);
    EXPECT_EQ(text.begin_segment(26), Status::ok);  // nothing new
    EXPECT_EQ(text.push('c'), Status::ok);
    ASSERT_EQ(text.segments().size(), 1);
    EXPECT_EQ(text.segments()[0].first, 1);
    EXPECT_EQ(text.segments()[0].eci, 26);
    EXPECT_EQ(text.push('d'), Status::ok);
    EXPECT_EQ(text.push('e'), Status::buffer_too_small);
    EXPECT_EQ(text.size(), 4);
    EXPECT_EQ(text.bytes()[3], 'd');
}

TEST(CodeText, ASegmentWithoutBytesGivesWayToTheNext) {
    std::uint8_t room[4] = {};
    CodeText text({room, 4});
    EXPECT_EQ(text.begin_segment(TextSegment::not_stated), Status::ok);
    EXPECT_EQ(text.segments().size(), 0);  // that is how a text begins
    EXPECT_EQ(text.begin_segment(3), Status::ok);
    EXPECT_EQ(text.begin_segment(20), Status::ok);
    ASSERT_EQ(text.segments().size(), 1);
    EXPECT_EQ(text.segments()[0].eci, 20);
}

TEST(CodeText, ForgetsWhatLiesBehindItsNewEnd) {
    std::uint8_t room[8] = {};
    CodeText text({room, 8});
    for (int i = 0; i < 4; ++i) {
        EXPECT_EQ(text.begin_segment(i + 1), Status::ok);
        EXPECT_EQ(text.push(static_cast<std::uint8_t>('a' + i)), Status::ok);
    }
    text.shrink(2);
    EXPECT_EQ(text.size(), 2);
    EXPECT_EQ(text.segments().size(), 2);
    text.clear();
    EXPECT_EQ(text.size(), 0);
    EXPECT_EQ(text.segments().size(), 0);
}

TEST(CodeText, HasRoomForSoManySegments) {
    std::uint8_t room[64] = {};
    CodeText text({room, 64});
    for (int i = 0; i < most_text_segments; ++i) {
        EXPECT_EQ(text.begin_segment(i % 2 == 0 ? 3 : 26), Status::ok);
        EXPECT_EQ(text.push('x'), Status::ok);
    }
    EXPECT_EQ(text.begin_segment(899), Status::capacity_exceeded);
    EXPECT_EQ(text.segments().size(), most_text_segments);
}

TEST(CodeGrade, SaysNothingAtFirst) {
    const Code code;
    EXPECT_EQ(code.grade.overall, CodeGrade::not_graded);
    EXPECT_EQ(code.corrected_errors, 0);
}

}  // namespace
}  // namespace fovea::test
