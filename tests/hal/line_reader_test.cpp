// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/hal/line_reader.hpp>
#include <fovea/simulated/byte_pipe.hpp>

namespace fovea::test {
namespace {

using simulated::BytePipe;

/// What a reader says of what has arrived, a line each; errors as "!" and their words.
template <class Reader>
std::vector<std::string> said(Reader& reader) {
    std::vector<std::string> all;
    for (;;) {
        const Result<Span<const char>> line = reader.next();
        if (line && line->empty()) return all;
        all.push_back(line ? std::string(line->begin(), line->end())
                           : std::string("!") + describe(line.status()));
    }
}

const std::string malformed = std::string("!") + describe(Status::malformed);
const std::string too_long = std::string("!") + describe(Status::capacity_exceeded);
using Lines = std::vector<std::string>;

struct LineReader : testing::Test {
    void arrive(const std::string& text) {
        pipe.arriving.insert(pipe.arriving.end(), text.begin(), text.end());
    }
    /// All that is said of a text, turn after turn.
    Lines lines(const std::string& text) {
        arrive(text);
        Lines all;
        while (!pipe.arriving.empty()) {
            EXPECT_EQ(reader.fill(pipe), Status::ok);
            for (const std::string& line : said(reader)) all.push_back(line);
        }
        return all;
    }

    BytePipe pipe;
    hal::LineReader<> reader;
};

TEST_F(LineReader, TakesEveryEndOfALine) {
    EXPECT_EQ(lines("a\nbc\rdef\r\n\n\r\r\ng"), (Lines{"a", "bc", "def"}));
    EXPECT_EQ(lines("h\r"), Lines{"gh"});
    EXPECT_EQ(lines("\ni\n"), Lines{"i"}) << "the other half of an end is no line";
    EXPECT_EQ(reader.refused(), 0u);
}

TEST_F(LineReader, GivesLinesOfUpToTheLimit) {
    const std::string longest(256, 'x');
    EXPECT_EQ(lines(longest + "\n"), Lines{longest});
    EXPECT_EQ(lines(longest + "y\nnext\n"), (Lines{too_long, "next"}));
    EXPECT_EQ(reader.refused(), 1u);
}

TEST_F(LineReader, SaysOnceThatALineHasNoEnd) {
    EXPECT_EQ(lines(std::string(100000, 'x')), Lines{too_long});
    EXPECT_EQ(lines("still\nnext\n"), Lines{"next"});
}

TEST_F(LineReader, TakesNoControlBytes) {
    for (int byte = 0; byte < 256; ++byte) {
        if (byte == '\n' || byte == '\r') continue;
        const std::string line = std::string("a") + static_cast<char>(byte) + "b";
        const bool control = byte < 32 || byte == 127;
        EXPECT_EQ(lines(line + "\nnext\n"), (Lines{control ? malformed : line, "next"})) << byte;
    }
    EXPECT_EQ(reader.refused(), 31u);
}

TEST_F(LineReader, SaysOneErrorALine) {
    EXPECT_EQ(lines(std::string("\0\0\0", 3) + std::string(1000, 'x') + "\n"), Lines{malformed});
    EXPECT_EQ(lines(std::string(300, 'x') + std::string("\0\0\n", 3)), Lines{too_long});
}

TEST_F(LineReader, TakesNoMoreThanItsShareATurn) {
    hal::LineReader<8, 16> small;
    arrive(std::string(100, '\n') + "a\n");
    for (std::size_t left = 102 - 16;; left -= 16) {
        ASSERT_EQ(small.fill(pipe), Status::ok);
        EXPECT_EQ(pipe.arriving.size(), left);
        ASSERT_EQ(small.fill(pipe), Status::ok);
        EXPECT_EQ(pipe.arriving.size(), left) << "nobody has looked at what is there";
        EXPECT_EQ(said(small), Lines());
        if (left < 16) break;
    }
    ASSERT_EQ(small.fill(pipe), Status::ok);
    EXPECT_EQ(said(small), Lines{"a"});
}

TEST_F(LineReader, KeepsWhatWasNotLookedAt) {
    hal::LineReader<8, 16> small;
    arrive("one\ntwo\nthree\nfour\nfive\n");
    ASSERT_EQ(small.fill(pipe), Status::ok);
    Result<Span<const char>> line = small.next();
    ASSERT_TRUE(line.ok());
    ASSERT_EQ(small.fill(pipe), Status::ok);
    EXPECT_EQ(std::string(line->begin(), line->end()), "one") << "good until the next line is asked for";
    EXPECT_EQ(said(small), (Lines{"two", "three", "four"}));
    ASSERT_EQ(small.fill(pipe), Status::ok);
    EXPECT_EQ(said(small), Lines{"five"});
}

TEST_F(LineReader, HandsOnWhatTheStreamRefused) {
    arrive("half");
    ASSERT_EQ(reader.fill(pipe), Status::ok);
    pipe.broken = true;
    EXPECT_EQ(reader.fill(pipe), Status::io_error);
    pipe.broken = false;
    EXPECT_EQ(lines(" and half\n"), Lines{"half and half"});
}

TEST_F(LineReader, ForgetsHalfALineOfTheStreamBefore) {
    EXPECT_EQ(lines("half"), Lines());
    reader.drop();
    EXPECT_EQ(lines("new\n"), Lines{"new"});
    EXPECT_EQ(lines(std::string(300, 'x')), Lines{too_long});
    reader.drop();
    EXPECT_EQ(lines("new\n"), Lines{"new"});
}

/// What is said does not depend on the pieces in which bytes arrive.
TEST(LinesAtRandom, AreTheSameInPiecesOfAnySize) {
    int faults = 0, good = 0;
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        Random random(seed);
        std::string text;
        for (std::uint32_t i = random.below(400); i > 0; --i)
            text += "\r\nabcdefgh\xc3\xa4\t"[random.below(13)];
        text += "\n";
        hal::LineReader<8, 32> pieces;
        Lines expected, got;
        BytePipe pipe;
        for (std::size_t at = 0; at < text.size();) {
            const std::size_t count = std::min<std::size_t>(1 + random.below(40), text.size() - at);
            pipe.arriving.insert(pipe.arriving.end(), text.begin() + static_cast<long>(at),
                                 text.begin() + static_cast<long>(at + count));
            at += count;
            while (!pipe.arriving.empty()) {
                ASSERT_EQ(pieces.fill(pipe), Status::ok);
                for (const std::string& line : said(pieces)) got.push_back(line);
            }
        }
        // The obvious version, over the whole text.
        std::string line;
        bool bad = false;
        for (const char byte : text) {
            if (byte == '\r' || byte == '\n') {
                if (!line.empty() && !bad) expected.push_back(line);
                line.clear();
                bad = false;
            } else if (!bad) {
                line += byte;
                bad = byte == '\t' || line.size() > 8;
                if (bad) expected.push_back(byte == '\t' ? malformed : too_long);
            }
        }
        ASSERT_EQ(got, expected) << seed;
        for (const std::string& one : got) ++(one[0] == '!' ? faults : good);
    }
    EXPECT_GT(faults, 1000);
    EXPECT_GT(good, 1000);
}

/// F15: a million bytes of anything.
TEST(LinesAtRandom, NeverHoldAControlByte) {
    Random random(15);
    hal::LineReader<> reader;
    BytePipe pipe;
    int good = 0;
    for (int turn = 0; turn < 2000; ++turn) {
        for (int i = 0; i < 512; ++i) pipe.arriving.push_back(static_cast<std::uint8_t>(random.next() >> 24));
        ASSERT_EQ(reader.fill(pipe), Status::ok);
        for (const std::string& line : said(reader)) {
            ASSERT_LE(line.size(), 256u);
            for (const char byte : line) ASSERT_TRUE(static_cast<unsigned char>(byte) >= 32 && byte != 127);
            good += line[0] != '!';
        }
    }
    EXPECT_GT(good, 100);
    EXPECT_GT(reader.refused(), 100u);
}

}  // namespace
}  // namespace fovea::test
