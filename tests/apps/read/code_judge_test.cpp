// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <common/text.hpp>
#include <read/code_job_reader.hpp>
#include <read/code_judge.hpp>

#include "support/code_scene.hpp"

namespace fovea::apps {
namespace {

using test::CodeScene;

/// A judge with a job of which these are the lines of [codes].
struct Judging {
    explicit Judging(const std::string& lines) {
        const CodeJobFile file = read_code_job("format = 1\nname = \"a\"\n[codes]\n" + lines);
        EXPECT_EQ(file.problem, "");
        job = file.job;
    }
    Span<std::uint8_t> scratch_for(const CodeScene& scene) {
        scratch.resize(static_cast<std::size_t>(read_job_scratch(job.looked_at(scene.view().size()))));
        return {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())};
    }
    static std::string told(CodesVerdict found, Span<const CodeReading> codes) {
        std::string text = found.verdict == Verdict::ok ? "ok" : found.reason;
        if (found.verdict == Verdict::unmeasured) text = "?" + text;
        for (const CodeReading& reading : codes)
            text += " " + string_of(reading.text) +
                    (reading.fault[0] == '\0' ? "" : std::string("!") + reading.fault);
        return text;
    }
    /// "wrong_code 123!wrong_code 456".
    std::string judge(const CodeScene& scene) {
        const CodesVerdict found = judging.judge(scene.view(), job, scratch_for(scene));
        if (found.verdict == Verdict::ok) judging.remember();
        return told(found, judging.codes());
    }
    std::string teach(const CodeScene& scene) {
        const CodesVerdict found = judging.teach(scene.view(), job, scratch_for(scene));
        return told(found, judging.taught());
    }
    CodeJob job;
    CodeJudge judging;
    std::vector<std::uint8_t> scratch;
};

CodeScene one(const std::string& text) { return CodeScene({180, 180}).draw(text, Symbology::qr, 10, 10, 4); }
CodeScene two(const std::string& left, const std::string& right) {
    return CodeScene({300, 140}).draw(right, Symbology::qr, 150, 5, 4).draw(left, Symbology::qr, 10, 15, 4);
}

TEST(CodeJudge, SaysWhatIsWrongWithTheCodesOfAPicture) {
    Judging any("symbologies = [\"qr\"]\n");
    EXPECT_EQ(any.judge(one("A1")), "ok A1");
    EXPECT_EQ(any.judge(CodeScene({180, 180})), "no_code");
    EXPECT_EQ(any.judge(two("A1", "A2")), "too_many_codes A1 A2");
    Judging list("symbologies = [\"qr\"]\nallowed = [\"A1\", \"A2\"]\npatterns = [\"B#\"]\n");
    EXPECT_EQ(list.judge(one("A1")), "ok A1");
    EXPECT_EQ(list.judge(one("B7")), "ok B7");
    EXPECT_EQ(list.judge(one("A3")), "wrong_code A3!wrong_code");
    EXPECT_EQ(list.judge(two("A1", "A3")), "wrong_code A1 A3!wrong_code");
    Judging pair("symbologies = [\"qr\"]\ncount = 2\n");
    EXPECT_EQ(pair.judge(one("A1")), "too_few_codes A1");
    EXPECT_EQ(pair.judge(two("A1", "A2")), "ok A1 A2");
    Judging bars("symbologies = [\"bars\"]\n");
    EXPECT_EQ(bars.judge(one("A1")), "no_code") << "what is not looked for is not there";
}

TEST(CodeJudge, TellsCodesFromLeftToRightOrFromTopToBottom) {
    Judging pair("symbologies = [\"qr\"]\ncount = 2\n");
    EXPECT_EQ(pair.judge(two("z", "a")), "ok z a");
    EXPECT_EQ(pair.judge(two("a", "z")), "ok a z");
    const CodeScene high =
        CodeScene({140, 300}).draw("low", Symbology::qr, 5, 150, 4).draw("up", Symbology::qr, 10, 10, 4);
    EXPECT_EQ(pair.judge(high), "ok up low");
}

TEST(CodeJudge, IgnoresWhatIsNotAllowedWhereItIsToldTo) {
    Judging picks("symbologies = [\"qr\"]\nothers = \"ignored\"\npatterns = [\"SN#*\"]\n");
    EXPECT_EQ(picks.judge(two("other", "SN42")), "ok SN42");
    EXPECT_EQ(picks.judge(two("other", "more")), "no_code");
    EXPECT_EQ(picks.judge(two("SN1", "SN2")), "too_many_codes SN1 SN2");
}

TEST(CodeJudge, WantsACodeUnlikeThatOfTheLastGoodPicture) {
    Judging serial("symbologies = [\"qr\"]\npatterns = [\"SN#\"]\nunlike_last = true\n");
    EXPECT_EQ(serial.judge(one("SN1")), "ok SN1");
    EXPECT_EQ(serial.judge(one("SN1")), "repeated_code SN1!repeated_code");
    EXPECT_EQ(serial.judge(one("XX")), "wrong_code XX!wrong_code");
    EXPECT_EQ(serial.judge(one("SN1")), "repeated_code SN1!repeated_code") << "of the last that was good";
    EXPECT_EQ(serial.judge(one("SN2")), "ok SN2");
    EXPECT_EQ(serial.judge(one("SN1")), "ok SN1");
    serial.judging.forget();
    EXPECT_EQ(serial.judge(one("SN1")), "ok SN1");
}

TEST(CodeJudge, WantsCodesOfDifferentTextsWhereItIsToldTo) {
    const std::string pair = "symbologies = [\"matrices\"]\ncount = 2\nallowed = [\"A1\", \"A2\"]\n";
    EXPECT_EQ(Judging(pair).judge(two("A1", "A1")), "ok A1 A1");
    Judging each(pair + "distinct = true\n");
    EXPECT_EQ(each.judge(two("A1", "A2")), "ok A1 A2");
    EXPECT_EQ(each.judge(two("A2", "A1")), "ok A2 A1");
    EXPECT_EQ(each.judge(two("A1", "A1")), "duplicate_code A1!duplicate_code A1!duplicate_code");
    EXPECT_EQ(each.judge(two("A3", "A3")), "wrong_code A3!wrong_code A3!wrong_code");
    // Of another kind it is the same text.
    EXPECT_EQ(each.judge(CodeScene({300, 140})
                             .draw("A1", Symbology::qr, 10, 10, 4)
                             .draw("A1", Symbology::data_matrix, 180, 30, 4)),
              "duplicate_code A1!duplicate_code A1!duplicate_code");
    Judging three("symbologies = [\"qr\"]\ncount = 3\ndistinct = true\n");
    const auto row = [](const char* left, const char* middle, const char* right) {
        return CodeScene({440, 140})
            .draw(left, Symbology::qr, 10, 10, 4)
            .draw(middle, Symbology::qr, 150, 10, 4)
            .draw(right, Symbology::qr, 290, 10, 4);
    };
    EXPECT_EQ(three.judge(row("A1", "A2", "A1")), "duplicate_code A1!duplicate_code A2 A1!duplicate_code");
    EXPECT_EQ(three.judge(row("A1", "A2", "A3")), "ok A1 A2 A3");
    Judging taught("symbologies = [\"qr\"]\ncount = 2\ntaught = true\ndistinct = true\n");
    EXPECT_EQ(taught.teach(two("A1", "A1")), "duplicate_code");
    EXPECT_EQ(taught.judge(two("A1", "A1")), "?not_taught A1 A1");
    EXPECT_EQ(taught.teach(two("A1", "A2")), "ok A1 A2");
    EXPECT_EQ(taught.judge(two("A2", "A1")), "ok A2 A1");
    EXPECT_EQ(taught.judge(two("A2", "A2")), "duplicate_code A2!duplicate_code A2!duplicate_code");
}

TEST(CodeJudge, AllowsWhatItWasTaughtAndNothingBefore) {
    Judging taught("symbologies = [\"qr\"]\ntaught = true\npatterns = [\"A*\"]\n");
    EXPECT_EQ(taught.judge(one("A1")), "?not_taught A1");
    EXPECT_EQ(taught.teach(one("A1")), "ok A1");
    EXPECT_EQ(taught.judge(one("A1")), "ok A1");
    EXPECT_EQ(taught.judge(one("A2")), "wrong_code A2!wrong_code");
    EXPECT_EQ(taught.judge(CodeScene({180, 180})), "no_code");
    EXPECT_EQ(taught.teach(one("A2")), "ok A2");
    EXPECT_EQ(taught.judge(one("A1")), "wrong_code A1!wrong_code");
    EXPECT_EQ(taught.judge(one("A2")), "ok A2");
    // What cannot be taught leaves nothing that is allowed.
    for (const CodeScene& scene : {CodeScene({180, 180}), two("A1", "A2"), one("B1")}) {
        EXPECT_EQ(taught.teach(one("A2")), "ok A2");
        EXPECT_NE(taught.teach(scene).substr(0, 2), "ok");
        EXPECT_EQ(taught.judge(one("A2")), "?not_taught A2");
    }
    EXPECT_EQ(taught.teach(one("B1")), "wrong_code");
    EXPECT_EQ(taught.teach(CodeScene({180, 180})), "no_code");
}

// In UTF-8 neither 80 nor 81 is a character by itself: as texts both are A and U+FFFD.
TEST(CodeJudge, KnowsCodesApartByTheirBytesWhereTheirTextsAreAlike) {
    const auto scene = [](const std::string& text) {
        CodeDesign design;
        design.qr.eci = 26;
        return CodeScene({180, 180}).draw(text, design, 10, 10, 4);
    };
    const CodeScene first = scene("A\x80"), second = scene("A\x81");
    const std::string told = "A\xef\xbf\xbd";
    Judging taught("symbologies = [\"qr\"]\ntaught = true\n");
    EXPECT_EQ(taught.teach(first), "ok " + told);
    EXPECT_EQ(taught.judge(first), "ok " + told);
    EXPECT_EQ(taught.judge(second), "wrong_code " + told + "!wrong_code");
    EXPECT_EQ(taught.teach(second), "ok " + told);
    EXPECT_EQ(taught.judge(second), "ok " + told);
    EXPECT_EQ(taught.judge(first), "wrong_code " + told + "!wrong_code");
    Judging serial("symbologies = [\"qr\"]\nunlike_last = true\n");
    EXPECT_EQ(serial.judge(first), "ok " + told);
    EXPECT_EQ(serial.judge(second), "ok " + told);
    EXPECT_EQ(serial.judge(second), "repeated_code " + told + "!repeated_code");
}

TEST(CodeJudge, LooksAtItsRegionAlone) {
    Judging right("symbologies = [\"qr\"]\nregion = [150, 0, 150, 140]\n");
    EXPECT_EQ(right.judge(two("A1", "A2")), "ok A2");
    const CodeReading& reading = right.judging.codes()[0];
    for (const SubPixelPoint& corner : reading.code.corners) EXPECT_GE(corner.x.round(), 150 + 4 * 4 - 2);
    EXPECT_EQ(right.judge(CodeScene({299, 140})), "?region_outside");
    EXPECT_EQ(right.judge(CodeScene({300, 139})), "?region_outside");
    EXPECT_LT(read_job_scratch(right.job.looked_at({300, 140})), read_job_scratch({300, 140}));
}

TEST(CodeJudge, AsksForAGrade) {
    CodeScene pale = one("A1");
    // A contrast of 35 of 255 levels is worth a D by ISO/IEC 15415.
    for (int y = 0; y < 180; ++y)
        for (int x = 0; x < 180; ++x) pale.pixel(x, y) = pale.pixel(x, y) > 128 ? 160 : 100;
    for (const char* grade : {"F", "D"})
        EXPECT_EQ(
            Judging(std::string("symbologies = [\"qr\"]\nleast_grade = \"") + grade + "\"\n").judge(pale),
            "ok A1");
    for (const char* grade : {"C", "B", "A"})
        EXPECT_EQ(
            Judging(std::string("symbologies = [\"qr\"]\nleast_grade = \"") + grade + "\"\n").judge(pale),
            "low_grade A1!low_grade");
    EXPECT_EQ(Judging("symbologies = [\"qr\"]\nleast_grade = \"A\"\n").judge(one("A1")), "ok A1");
}

TEST(CodeJudge, CannotJudgeMoreTextThanItTells) {
    const std::string long_text(700, 'x');
    const CodeScene alone = CodeScene({520, 520}).draw(long_text, Symbology::qr, 0, 0, 4);
    Judging any("symbologies = [\"qr\"]\n");
    EXPECT_EQ(any.judge(alone), "ok " + long_text);
    const CodeScene both = CodeScene({660, 520})
                               .draw(long_text, Symbology::qr, 0, 0, 4)
                               .draw(std::string(100, 'y'), Symbology::data_matrix, 520, 0, 3);
    Judging pair("symbologies = [\"matrices\"]\ncount = 2\n");
    EXPECT_EQ(pair.judge(both), "?codes_too_long");
    Judging picks("symbologies = [\"matrices\"]\nothers = \"ignored\"\npatterns = [\"y*\"]\n");
    EXPECT_EQ(picks.judge(both), "ok " + std::string(100, 'y'));
}

TEST(CodeJudge, IgnoresACodeThatIsTooLongWhereverItStands) {
    const std::string kept(100, 'y');
    Judging picks("symbologies = [\"matrices\"]\nothers = \"ignored\"\npatterns = [\"y*\"]\n");
    // 700 bytes have room alone, but not beside the other's; 769 have none.
    for (const int size : {700, 769}) {
        const std::string foreign(static_cast<std::size_t>(size), 'x');
        for (const int x : {0, 120}) {
            const CodeScene scene = CodeScene({660, 520})
                                        .draw(foreign, Symbology::qr, x, 0, 4)
                                        .draw(kept, Symbology::data_matrix, x == 0 ? 540 : 0, 0, 3);
            EXPECT_EQ(picks.judge(scene), "ok " + kept) << size << " bytes at " << x;
        }
    }
    // What is allowed and has no room is not passed over.
    EXPECT_EQ(picks.judge(CodeScene({660, 520})
                              .draw(std::string(769, 'y'), Symbology::qr, 0, 0, 4)
                              .draw(kept, Symbology::data_matrix, 540, 0, 3)),
              "?codes_too_long");
    Judging both("symbologies = [\"matrices\"]\nothers = \"ignored\"\npatterns = [\"y*\"]\ncount = 2\n");
    for (const int x : {0, 120})
        EXPECT_EQ(both.judge(CodeScene({660, 520})
                                 .draw(std::string(700, 'y'), Symbology::qr, x, 0, 4)
                                 .draw(kept, Symbology::data_matrix, x == 0 ? 540 : 0, 0, 3)),
                  "?codes_too_long");
}

TEST(CodeJudge, TellsBytesOfAnyKindAsUtf8) {
    Judging any("symbologies = [\"qr\"]\n");
    EXPECT_EQ(any.judge(one("a\xe9z")), "ok a\xc3\xa9z");
    EXPECT_EQ(string_of({reinterpret_cast<const char*>(any.judging.codes()[0].bytes.data()), 3}), "a\xe9z");
    Judging gs1("symbologies = [\"code-128\"]\nallowed = [\"10AB\\\\x1d2142\"]\n");
    const CodeScene label = CodeScene({400, 90}).draw(
        "10AB\x1d"
        "2142",
        Symbology::code_128, 5, 5, 2, 40, Code128Kind::gs1);
    EXPECT_EQ(gs1.judge(label),
              "ok 10AB\x1d"
              "2142");
}

}  // namespace
}  // namespace fovea::apps
