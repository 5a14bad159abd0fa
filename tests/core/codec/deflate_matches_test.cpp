// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/codec/deflate_matches.hpp>

#include "lossless_files.hpp"

namespace fovea::test {
namespace {

using Finder = DeflateMatches<64, 6>;

TEST(DeflateMatches, FindsTheLongestOfSeveralAndTheNearestOfEqualOnes) {
    //                           0         1         2
    //                           012345678901234567890123456
    const Bytes text = bytes_of("abcdexx.abcdefg.abcdey.abcdef!");
    Bytes scratch(Finder::scratch_bytes);
    Finder finder(scratch.data());
    const auto find = [&](int at, int depth) {
        return finder.find(text.data(), at, static_cast<int>(text.size()) - at, at, depth, 258);
    };
    DeflateMatch match;
    for (int at = 0; at < 16; ++at) match = find(at, 8);
    // ".abcde" stood eight bytes before.
    EXPECT_EQ(match.length, 6);
    EXPECT_EQ(match.distance, 8);
    match = find(16, 8);
    EXPECT_EQ(match.length, 5);
    EXPECT_EQ(match.distance, 8);
    for (int at = 17; at < 23; ++at) finder.enter(text.data(), at);
    match = find(23, 8);
    EXPECT_EQ(match.length, 6);
    EXPECT_EQ(match.distance, 15);
    Bytes other_scratch(Finder::scratch_bytes);
    Finder hasty(other_scratch.data());
    for (int at = 0; at < 23; ++at) hasty.enter(text.data(), at);
    match = hasty.find(text.data(), 23, 7, 23, 1, 258);
    EXPECT_EQ(match.length, 5);
    EXPECT_EQ(match.distance, 7);
}

TEST(DeflateMatches, NeverAnswerAnythingButTrueMatchesWithinReach) {
    Random random(1);
    Bytes scratch(Finder::scratch_bytes);
    Finder finder(scratch.data());
    Bytes buffer(128);
    int history = 0;
    // More than 65536 places, so that the running count goes round.
    for (int block = 0; block < 1200; ++block) {
        for (std::size_t i = 64; i < 128; ++i) buffer[i] = static_cast<std::uint8_t>(random.below(2));
        for (int at = 64; at < 128; ++at) {
            const int reach = std::min(64, history + at - 64);
            const DeflateMatch match = finder.find(buffer.data(), at, 128 - at, reach, 4, 20);
            if (match.length == 0) continue;
            ASSERT_GE(match.length, 4);
            ASSERT_LE(match.length, 128 - at);
            ASSERT_GE(match.distance, 1);
            ASSERT_LE(match.distance, reach);
            for (int i = at; i < at + match.length; ++i)
                ASSERT_EQ(buffer[static_cast<std::size_t>(i)],
                          buffer[static_cast<std::size_t>(i - match.distance)]);
        }
        std::memcpy(buffer.data(), buffer.data() + 64, 64);
        finder.advance();
        history = 64;
    }
}

TEST(DeflateMatches, FindsARunAtDistanceOne) {
    const Bytes buffer(128, 9);
    Bytes scratch(Finder::scratch_bytes);
    Finder finder(scratch.data());
    EXPECT_EQ(finder.find(buffer.data(), 64, 64, 0, 4, 258).length, 0);
    const DeflateMatch match = finder.find(buffer.data(), 65, 63, 1, 4, 258);
    EXPECT_EQ(match.length, 63);
    EXPECT_EQ(match.distance, 1);
}

}  // namespace
}  // namespace fovea::test
