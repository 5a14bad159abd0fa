// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>

#include <fovea/base/random.hpp>

#include <daemon/result_presets.hpp>
#include <daemon/result_template.hpp>

namespace fovea::apps {
namespace {

Inspection inspection() {
    Inspection made;
    made.number = 42;
    made.answer = Answer::not_ok;
    made.reason = "high";
    made.feature = letters_of("d1");
    made.job = letters_of("cap-32");
    made.job_number = 3;
    made.job_crc = 0x9f3c01ab;
    made.has_frame = true;
    made.frame = 1842;
    made.age_us = 5123;
    made.missed_frames = 2;
    made.took_us = 21000;
    made.judged_us = 9000;
    made.time_us = 123456789;
    made.parts = 1;
    made.values = 3;
    made.value[0] = {letters_of("d1"), Status::ok, Verdict::high, {32114499}, 3};
    made.value[1] = {letters_of("holes"), Status::ok, Verdict::ok, {4000000}, 0};
    made.value[2] = {letters_of("edge"), Status::not_found, Verdict::unmeasured, {}, 3};
    return made;
}

std::string filled(const char* text, const Inspection& from = inspection()) {
    ResultTemplate made;
    const Status read = made.read(letters_of(text));
    if (read != Status::ok) return std::string("!") + made.problem() + " at " + std::to_string(made.place());
    Tally tally;
    for (const Answer answer : {Answer::ok, Answer::ok, Answer::not_ok, Answer::missed}) tally.count(answer);
    char room[512];
    TextBuffer line(room);
    made.write(from, tally, line);
    EXPECT_FALSE(line.full());
    return std::string(line.letters().begin(), line.letters().end());
}

TEST(ResultTemplate, FillsInItsFields) {
    EXPECT_EQ(filled("{seq};{verdict};{pass};{why};{job};{job.number};{parts}"), "42;NG;F;high;cap-32;3;1");
    EXPECT_EQ(filled("{frame} {age_us} {took_us}"), "1842 5123 21000");
    EXPECT_EQ(filled("{triggers}={ok}+{ng}+{error}+{missed}"), "4=2+1+0+1");
    EXPECT_EQ(filled("{f.d1} {f.d1.milli} {f.d1.verdict} {f.holes} {f.edge} {f.edge.verdict} {f.none}"),
              "32.114 32114 high 4 ? unmeasured ?");
    EXPECT_EQ(filled("no field"), "no field");
    EXPECT_EQ(filled(""), "");
}

TEST(ResultTemplate, KeepsFieldsInTheirPlaces) {
    EXPECT_EQ(filled("{seq:6}|{f.d1.milli:+7}|{job:8}|{verdict:5}|"), "000042|+032114|cap-32  |NG   |");
    EXPECT_EQ(filled("{f.d1.milli:4}"), "****");
    EXPECT_EQ(filled("{f.d1.milli:+5}"), "*****");
    EXPECT_EQ(filled("{f.d1:+9}|"), "+32.114  |");
    EXPECT_EQ(filled("{f.edge:5}|{f.edge:6|NONE}|"), "?????|NONE  |");
    Inspection negative = inspection();
    negative.value[0].value = {-1500000};
    EXPECT_EQ(filled("{f.d1.milli:6}|{f.d1.milli}|{f.d1}", negative), "-01500|-1500|-1.500");
}

TEST(ResultTemplate, HasATextForWhatIsNotThere) {
    Inspection blind = inspection();
    blind.has_frame = false;
    blind.reason = "";
    EXPECT_EQ(filled("{frame|-1};{age_us};{why|fine};{why}", blind), "-1;?;fine;");
}

TEST(ResultTemplate, WritesBytesAndChecks) {
    EXPECT_EQ(filled("\\x02{verdict}\\x03\\r\\n"), "\x02NG\x03\r\n");
    EXPECT_EQ(filled("\\{\\}\\\\\\t"), "{}\\\t");
    EXPECT_EQ(filled("\\x02NG{xor}"), "\x02NG09");  // 0x4e ^ 0x47
    // The check value of the catalogue of CRCs.
    EXPECT_EQ(filled("123456789{crc16}"), "12345678929b1");
    EXPECT_EQ(filled("\\x02123456789{crc16}"),
              "\x02"
              "12345678929b1");
}

TEST(ResultTemplate, SaysWhatIsWrongAndWhere) {
    EXPECT_EQ(filled("{verdikt}"), "!no such field at 2");
    EXPECT_EQ(filled("ab{seq"), "!a field without its } at 3");
    EXPECT_EQ(filled("ab}"), "!a } without its field at 3");
    EXPECT_EQ(filled("a\\q"), "!after \\ comes one of r n t x \\ { } at 2");
    EXPECT_EQ(filled("\\x0"), "!\\x wants two hexadecimal digits at 1");
    EXPECT_EQ(filled("{seq:}"), "!a width is 1 to 64 at 6");
    EXPECT_EQ(filled("{seq:65}"), "!a width is 1 to 64 at 6");
    EXPECT_EQ(filled("{seq|a{b}"), "!this letter cannot stand there at 7");
    EXPECT_EQ(filled("{f.}"), "!no such field at 2");
    EXPECT_EQ(filled("\xc3\xa9"), "!bytes that are no ASCII are written \\xNN at 1");
    EXPECT_EQ(filled(std::string(257, 'a').c_str()), "!the template is too long at 257");
    std::string fields;
    for (int k = 0; k < 49; ++k) fields += "{ok}";
    EXPECT_EQ(filled(fields.c_str()), "!too many fields at 193");
}

TEST(ResultTemplate, StaysAsItWasAfterAnError) {
    ResultTemplate made;
    ASSERT_EQ(made.read(letters_of("{pass}")), Status::ok);
    EXPECT_EQ(made.read(letters_of("{nothing}")), Status::not_found);
    char room[16];
    TextBuffer line(room);
    made.write(inspection(), {}, line);
    EXPECT_EQ(std::string(line.letters().begin(), line.letters().end()), "F");
}

TEST(ResultTemplate, HasPresetsThatAreTemplates) {
    for (const char* name : {"plain", "pass-fail", "stx-etx", "csv", "code"}) {
        const char* const text = result_preset(letters_of(name));
        ASSERT_NE(text, nullptr);
        EXPECT_NE(filled(text)[0], '!') << name;
    }
    EXPECT_EQ(result_preset(letters_of("other")), nullptr);
}

TEST(ResultTemplate, NeverLetsANameEndAFrame) {
    Inspection forged = inspection();
    forged.job = {"a\x03\r\nb", 5};
    EXPECT_EQ(filled("{job}", forged), "a???b");
}

TEST(ResultTemplate, ReadsAnyBytes) {
    Random random(11);
    const char letters[] = "{}\\|:+0179xfseqjobokr.\x02";
    int read = 0;
    for (int run = 0; run < 50000; ++run) {
        char text[60];
        const auto length = static_cast<std::ptrdiff_t>(random.below(60));
        for (std::ptrdiff_t k = 0; k < length; ++k) text[k] = letters[random.below(sizeof letters)];
        ResultTemplate made;
        if (made.read({text, length}) != Status::ok) {
            EXPECT_NE(made.problem()[0], '\0');
            continue;
        }
        ++read;
        char room[256];
        TextBuffer line(room);
        made.write(inspection(), {}, line);
    }
    EXPECT_GT(read, 500);
}

TEST(WriteJson, IsALineOfJsonWithItsKeysInOrder) {
    char room[2048];
    TextBuffer line(room);
    write_json(inspection(), line);
    const std::string text(line.letters().begin(), line.letters().end());
    EXPECT_EQ(text,
              "{\"v\":1,\"ev\":\"result\",\"seq\":42,\"t_mono_us\":123456789,\"job\":\"cap-32\",\"job_crc\":"
              "\"9f3c01ab\","
              "\"frame\":{\"seq\":1842,\"age_us\":5123,\"missed\":2},\"verdict\":\"NG\",\"why\":\"high\","
              "\"feature\":\"d1\","
              "\"parts\":1,\"values\":[{\"name\":\"d1\",\"value\":32.114499,\"verdict\":\"high\"},"
              "{\"name\":\"holes\",\"value\":4,\"verdict\":\"ok\"},"
              "{\"name\":\"edge\",\"value\":null,\"reason\":\"nothing found\",\"verdict\":\"unmeasured\"}],"
              "\"us\":{\"answer\":21000,\"judge\":9000}}");
}

}  // namespace
}  // namespace fovea::apps
