// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>

#include <fovea/base/random.hpp>

#include <daemon/command.hpp>

namespace fovea::apps {
namespace {

SerialCommand read(const char* line) { return read_command(letters_of(line)); }
std::string text(Span<const char> letters) { return std::string(letters.begin(), letters.end()); }

TEST(Command, KnowsItsWordsInAnyCase) {
    const struct {
        const char* line;
        CommandVerb verb;
    } rows[] = {
        {"TRG", CommandVerb::trigger},
        {"trg", CommandVerb::trigger},
        {"  Trg  ", CommandVerb::trigger},
        {"jobs?", CommandVerb::list_jobs},
        {"JOB?", CommandVerb::ask_job},
        {"STAT?", CommandVerb::ask_tally},
        {"stat reset", CommandVerb::reset_tally},
        {"LAST?", CommandVerb::ask_last},
        {"RDY?", CommandVerb::ask_ready},
        {"VER?", CommandVerb::ask_version},
        {"", CommandVerb::none},
        {"   ", CommandVerb::none},
    };
    for (const auto& row : rows) {
        EXPECT_EQ(read(row.line).verb, row.verb) << row.line;
        EXPECT_EQ(read(row.line).error, CommandError::none) << row.line;
    }
}

TEST(Command, TakesJobsByNumberAndName) {
    EXPECT_EQ(read("JOB 12").number, 12);
    EXPECT_EQ(text(read("JOB 12").name), "12");
    EXPECT_EQ(read("JOB cap-32").number, 0);
    EXPECT_EQ(text(read("job cap-32.b").name), "cap-32.b");
    EXPECT_EQ(read("JOB 0").number, 0);
    EXPECT_EQ(text(read("TEACH good_1").name), "good_1");
}

TEST(Command, EchoesAnId) {
    const SerialCommand command = read("#a17 STAT?");
    EXPECT_EQ(command.verb, CommandVerb::ask_tally);
    EXPECT_EQ(text(command.id), "a17");
    char room[64];
    TextBuffer reply(room);
    reply_ok(command, reply).text(" 1");
    EXPECT_EQ(text(reply.letters()), "#a17 OK 1");
    reply.clear();
    reply_error(read("#7 FOO"), CommandError::unknown, reply);
    EXPECT_EQ(text(reply.letters()), "#7 ERR 11 no such command");
}

TEST(Command, RefusesWhatIsNoCommand) {
    const struct {
        const char* line;
        CommandError error;
    } rows[] = {
        {"TRGX", CommandError::unknown},
        {"TR", CommandError::unknown},
        {"#1", CommandError::unknown},
        {"TRG 1", CommandError::argument},
        {"JOB", CommandError::argument},
        {"JOB a b", CommandError::argument},
        {"JOB ../passwd", CommandError::argument},
        {"JOB .hidden", CommandError::argument},
        {"JOB a/b", CommandError::argument},
        {"STAT", CommandError::argument},
        {"STAT NOW", CommandError::argument},
        {"TEACH", CommandError::argument},
        {"# TRG", CommandError::malformed},
        {"#a-b TRG", CommandError::malformed},
        {"#12345678901234567 TRG", CommandError::malformed},
        {"TRG\x07", CommandError::malformed},
        {"TR\x80G", CommandError::malformed},
    };
    for (const auto& row : rows) EXPECT_EQ(read(row.line).error, row.error) << row.line;
    EXPECT_EQ(read(std::string(255, 'a').c_str()).error, CommandError::unknown);
    EXPECT_EQ(read(std::string(256, 'a').c_str()).error, CommandError::malformed);
    EXPECT_EQ(read(("JOB " + std::string(64, 'a')).c_str()).error, CommandError::argument);
    EXPECT_EQ(read(("JOB " + std::string(63, 'a')).c_str()).error, CommandError::none);
}

TEST(Command, ReadsAnyBytes) {
    Random random(3);
    const char letters[] = "TRGJOBS?STATRESET #1a.-\r\0";
    for (int run = 0; run < 100000; ++run) {
        char line[40];
        const auto length = static_cast<std::ptrdiff_t>(random.below(40));
        for (std::ptrdiff_t k = 0; k < length; ++k)
            line[k] = random.below(20) == 0 ? static_cast<char>(random.below(256))
                                            : letters[random.below(sizeof letters)];
        const SerialCommand command = read_command({line, length});
        for (const char c : command.name) EXPECT_TRUE(detail::is_name_letter(c));
        if (command.error == CommandError::none && command.verb == CommandVerb::take_job) {
            EXPECT_FALSE(command.name.empty());
        }
    }
}

TEST(TextBuffer, WritesNumbersAsTheyAre) {
    char room[64];
    TextBuffer buffer(room);
    buffer.number(0).put(' ').number(-7).put(' ').number(INT64_MIN).put(' ').number(INT64_MAX);
    EXPECT_EQ(text(buffer.letters()), "0 -7 -9223372036854775808 9223372036854775807");
    buffer.clear();
    buffer.hex(0x1a2b, 4).put(' ').decimal({12500000}, 3);
    EXPECT_EQ(text(buffer.letters()), "1a2b 12.500");
}

TEST(TextBuffer, SaysThatItIsFull) {
    char room[4];
    TextBuffer buffer(room);
    buffer.text("abcd");
    EXPECT_FALSE(buffer.full());
    buffer.put('e');
    EXPECT_TRUE(buffer.full());
    EXPECT_EQ(text(buffer.letters()), "abcd");
    buffer.clear();
    EXPECT_FALSE(buffer.full());
}

TEST(TextBuffer, EscapesForJson) {
    char room[64];
    TextBuffer buffer(room);
    buffer.json(letters_of("a\"b\\c\n\x7f\xc3\xa9"));
    EXPECT_EQ(text(buffer.letters()), "\"a\\\"b\\\\c\\u000a\\u007f\xc3\xa9\"");
}

}  // namespace
}  // namespace fovea::apps
