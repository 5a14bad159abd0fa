// SPDX-License-Identifier: MIT
//
// Codes in templates and in JSON: whatever stands in them, a record stays a record.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include <fovea/base/random.hpp>

#include <daemon/daemon.hpp>
#include <daemon/result_template.hpp>

#include "support/json.hpp"

namespace fovea::apps {
namespace {

/// Codes with these texts, whose bytes are those of the texts.
class Codes {
public:
    CodeReading& add(const std::string& text, Symbology symbology = Symbology::qr) {
        texts_.push_back(text);
        const std::string& kept = texts_.back();
        CodeReading reading;
        reading.code.symbology = symbology;
        reading.code.aim_digit = '1';
        reading.code.grade.overall = 3;
        reading.text = span_of(kept);
        reading.bytes = bytes_of(kept);
        readings_.push_back(reading);
        inspection.reads_codes = true;
        inspection.codes = {readings_.data(), static_cast<std::ptrdiff_t>(readings_.size())};
        return readings_.back();
    }
    std::string filled(const std::string& text) const {
        ResultTemplate made;
        if (made.read(span_of(text)) != Status::ok)
            return std::string("!") + made.problem() + " at " + std::to_string(made.place());
        std::vector<char> room(ResultTemplate::longest_line);
        TextBuffer line({room.data(), static_cast<std::ptrdiff_t>(room.size())});
        made.write(inspection, Tally(), line);
        EXPECT_FALSE(line.full());
        return string_of(line.letters());
    }
    Inspection inspection;

private:
    std::deque<std::string> texts_;
    std::vector<CodeReading> readings_;
};

TEST(TemplateCodes, FillInWhatIsToldOfACode) {
    Codes codes;
    codes.inspection.answer = Answer::ok;
    codes.add("9780905705712", Symbology::ean_13);
    codes.add("LOT42").code.grade.overall = -1;
    EXPECT_EQ(codes.filled("{codes} {code}"), "2 9780905705712");
    EXPECT_EQ(codes.filled("{code.1}/{code.2}"), "9780905705712/LOT42");
    EXPECT_EQ(codes.filled("{code.symbology}|{code.aim}|{code.grade}"), "EAN-13|]E1|B");
    EXPECT_EQ(codes.filled("{code.2.symbology}|{code.2.aim}|{code.2.grade}"), "QR|]Q1|-");
    EXPECT_EQ(codes.filled("{code.2.hex}"), "4c4f543432");
    EXPECT_EQ(codes.filled("{code.3};{code.3|NONE};{code.3:4}"), "?;NONE;????");
    EXPECT_EQ(codes.filled("{code.2:8}|{code.2:4}|{code.2.hex:9}|"), "LOT42   |****|*********|");
    EXPECT_EQ(codes.filled("{verdict},{code}\\r\\n"), "OK,9780905705712\r\n");
    EXPECT_EQ(Codes().filled("{codes},{code|NOREAD}"), "0,NOREAD");
}

TEST(TemplateCodes, SayWhatIsWrongAndWhere) {
    const Codes codes;
    for (const char* wrong :
         {"{code.}", "{code.0}", "{code.10}", "{code.text}", "{codex}", "{code.2.}", "{code.hex.2}"})
        EXPECT_EQ(codes.filled(wrong), "!no such field at 2") << wrong;
    EXPECT_EQ(codes.filled("{code}{code.hex}{code.1}"), "???");
    EXPECT_EQ(codes.filled("{code}{code.hex}{code.1}{code.2}{code.aim}{code}"),
              "!the same code more than three times at 44");
}

TEST(TemplateCodes, EscapeWhatWouldEndALineARecordOrAField) {
    Codes codes;
    codes.add(
        "01\x1d"
        "10;A\r\n\t\x02\x03,\\x");
    EXPECT_EQ(codes.filled("{code}"), "01\\x1d10;A\\r\\n\\t\\x02\\x03,\\\\x");
    EXPECT_EQ(codes.filled("{seq};{code};"), "0;01\\x1d10\\x3bA\\r\\n\\t\\x02\\x03,\\\\x;");
    EXPECT_EQ(codes.filled("\\x02{code},{seq}\\x03"),
              "\x02"
              "01\\x1d10;A\\r\\n\\t\\x02\\x03\\x2c\\\\x,0\x03");
    EXPECT_EQ(codes.filled("A{code}"), "A01\\x1d10;A\\r\\n\\t\\x02\\x03,\\\\x") << "letters part nothing";
    Codes foreign;
    foreign.add("\xc3\xa9\xc2\x85\xe2\x80\xa8");
    EXPECT_EQ(foreign.filled("{code}"), "\xc3\xa9\\xc2\\x85\\xe2\\x80\\xa8");
    EXPECT_EQ(foreign.filled("\\xa9{code}"), "\xa9\\xc3\\xa9\\xc2\\x85\\xe2\\x80\\xa8")
        << "a mark may be any byte";
}

TEST(TemplateCodes, StayARecordWhateverStandsInACode) {
    Random random(17);
    for (int run = 0; run < 5000; ++run) {
        std::string text;
        for (std::uint32_t k = random.below(40); k > 0; --k)
            text += random.below(2) == 0 ? "\r\n\x02\x03\x1d;,{}\\|\x7f"[random.below(12)]
                                         : static_cast<char>(random.below(256));
        Codes codes;
        codes.add(text);
        const std::string line = codes.filled("\\x02{seq};{code};{xor}\\x03\\r\\n");
        const std::string inside = line.substr(1, line.size() - 4);
        EXPECT_EQ(line.substr(0, 3),
                  "\x02"
                  "0;");
        EXPECT_EQ(line.substr(line.size() - 3), "\x03\r\n");
        for (const char letter : inside) ASSERT_TRUE(letter < 0 || (letter >= ' ' && letter != '\x7f'));
        ASSERT_EQ(std::count(inside.begin(), inside.end(), ';'), 2);
        // The machine gets all of it back.
        const std::size_t from = 3;
        std::string back;
        ASSERT_EQ(read_code_text(line.substr(from, line.rfind(';') - from), back), "");
        ASSERT_EQ(back, text);
    }
}

TEST(TemplateCodes, FindRoomInALineWhateverTheyAre) {
    Codes codes;
    codes.add(std::string(CodeReadings::most_text, '\x1d'));
    codes.inspection.job = letters_of("a-job-with-the-longest-name-that-a-job-can-have-of-63-letters..");
    const std::string three = "{code}{code.1}{code}";
    const auto with = [&](const std::string& field) {
        std::string text = three;
        for (int k = 3; k < ResultTemplate::most_pieces; ++k) text += field;
        return codes.filled(text).size();
    };
    constexpr std::size_t long_fields = 3 * 4 * CodeReadings::most_text;
    EXPECT_EQ(with("{seq:64}"), long_fields + 45 * 64);
    EXPECT_EQ(with("{job}"), long_fields + 45 * 63);
    static_assert(ResultTemplate::longest_line <= 16384, "the daemon's lines have room for it");
}

TEST(TemplateCodes, AreALineOfJson) {
    Codes codes;
    CodeReading& first = codes.add("a\"\\\x1d\n\xc3\xa9\xc2\x85\xe2\x80\xa9");
    first.fault = "wrong_code";
    first.code.corners[0] = {SubPixel::from_raw(-384), SubPixel::from_int(20)};
    codes.add("4006381333931", Symbology::ean_13).code.grade.overall = -1;
    std::vector<char> room(16384);
    TextBuffer line({room.data(), static_cast<std::ptrdiff_t>(room.size())});
    write_json(codes.inspection, line);
    const std::string text = string_of(line.letters());
    for (const char letter : text) ASSERT_TRUE(letter < 0 || letter >= ' ');
    EXPECT_EQ(text.find("\xc2\x85"), std::string::npos);
    EXPECT_EQ(text.find("\xe2\x80\xa9"), std::string::npos);
    EXPECT_NE(text.find("\"values\":[],\"codes\":[{\"symbology\":\"QR\",\"text\":"
                        "\"a\\\"\\\\\\u001d\\u000a\xc3\xa9\\u0085\\u2029\","
                        "\"bytes_hex\":\"61225c1d0ac3a9c285e280a9\",\"aim\":\"]Q1\","
                        "\"corners_px\":[[-1.50,20.00],[0.00,0.00],[0.00,0.00],[0.00,0.00]],\"grade\":\"B\","
                        "\"why\":\"wrong_code\"},{\"symbology\":\"EAN-13\""),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("\"grade\":null,\"why\":null}],\"us\":{"), std::string::npos) << text;
    EXPECT_TRUE(test::parse_json(text).has_value());
    Inspection none;
    none.reads_codes = true;
    line.clear();
    write_json(none, line);
    EXPECT_NE(string_of(line.letters()).find(",\"codes\":[],"), std::string::npos);
}

/// The longest line of JSON there can be is sent and kept.
TEST(TemplateCodes, HaveRoomInTheLongestLineOfJson) {
    Codes codes;
    Inspection& most = codes.inspection;
    most.reason = "undecided_code";
    const std::string quotes(Feature::max_name, '"');
    most.feature = span_of(quotes);
    const std::string job(longest_job_name, 'j');
    most.job = span_of(job);
    most.number = most.missed_frames = ~std::uint64_t{0} >> 1;
    most.has_frame = true;
    most.frame = ~std::uint32_t{0};
    most.age_us = most.took_us = most.judged_us = most.time_us = INT64_MAX;
    most.parts = INT32_MAX;
    most.values = Inspection::most_values;
    for (InspectedValue& value : most.value)
        value = {span_of(quotes), Status::ok, Verdict::unmeasured, {INT64_MIN}, 3};
    for (int k = 0; k < CodeReadings::most; ++k) {
        CodeReading& reading = codes.add(std::string(static_cast<std::size_t>(k < 3 ? 86 : 85), '\x1d'),
                                         Symbology::interleaved_2_of_5);
        reading.fault = "repeated_code";
        for (SubPixelPoint& corner : reading.code.corners)
            corner = {SubPixel::from_raw(INT32_MIN), SubPixel::from_raw(INT32_MIN)};
    }
    std::vector<char> room(16384);
    TextBuffer line({room.data(), static_cast<std::ptrdiff_t>(room.size())});
    write_json(most, line);
    EXPECT_FALSE(line.full());
    EXPECT_GT(line.size(), 12000);
    EXPECT_LE(line.size(), FailureRing<>::most_text);
    line.clear();
    write_json_codes(most.codes, line);
    EXPECT_LE(line.size() + 1024, 12288) << "room of the event of what was taught";
}

}  // namespace
}  // namespace fovea::apps
