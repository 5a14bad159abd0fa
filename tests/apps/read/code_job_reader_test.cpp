// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>

#include <read/code_job_reader.hpp>

namespace fovea::apps {
namespace {

const std::string top = "format = 1\nname = \"label\"\n";

std::string problem_of(const std::string& text) {
    const CodeJobFile file = read_code_job(text);
    if (file.problem.empty()) return "";
    return std::to_string(file.place.line) + ":" + std::to_string(file.place.column) + ": " + file.problem;
}
/// Of lines below [codes], which are the third and fourth.
std::string problem_in_codes(const std::string& lines) {
    return problem_of(top + "[codes]\nsymbologies = [\"qr\"]\n" + lines);
}

TEST(CodeJob, IsItsDefaultsWhereNothingIsSaid) {
    const CodeJobFile file = read_code_job(top + "[codes]\nsymbologies = [\"ean-13\"]\n");
    ASSERT_EQ(file.problem, "");
    EXPECT_TRUE(file.found && file.alone);
    const CodeJob& job = file.job;
    EXPECT_EQ(job.options.symbologies, SymbologySet(Symbology::ean_13));
    EXPECT_EQ(job.options.most_codes, 2);
    EXPECT_FALSE(job.options.thorough || job.ignores_others || job.taught || job.distinct || job.unlike_last);
    EXPECT_EQ(job.count, 1);
    EXPECT_EQ(job.least_grade, 0);
    EXPECT_TRUE(job.allowed.empty() && job.region.empty());
    EXPECT_EQ(job.looked_at({640, 480}), (Size{640, 480}));
}

TEST(CodeJob, TakesWhatIsSaid) {
    const CodeJobFile file = read_code_job(
        top +
        "[codes]\nsymbologies = [\"matrices\", \"code-128\", \"interleaved-2-of-5\"]\ncount = 2\n"
        "others = \"ignored\"\nallowed = [\"a\\\\x1db\", \"c\"]\npatterns = [\"40#*\"]\nunlike_last = true\n"
        "distinct = true\n"
        "least_grade = \"C\"\nregion = [10, 20, 300, 200]\nthorough = true\nadd_on = true\nascii = true\n"
        "check = true\ndigits = [14, 8]\n");
    ASSERT_EQ(file.problem, "");
    const CodeJob& job = file.job;
    EXPECT_TRUE(job.options.symbologies.contains(Symbology::qr) &&
                job.options.symbologies.contains(Symbology::data_matrix) &&
                job.options.symbologies.contains(Symbology::code_128) &&
                !job.options.symbologies.contains(Symbology::ean_13));
    EXPECT_EQ(job.count, 2);
    EXPECT_EQ(job.options.most_codes, CodeJob::most_seen);
    EXPECT_TRUE(job.ignores_others && job.distinct && job.unlike_last && job.options.thorough);
    EXPECT_TRUE(job.allowed.allows(span_of("a\x1d"
                                           "b")) &&
                job.allowed.allows(span_of("401")));
    EXPECT_FALSE(job.allowed.allows(span_of("40")));
    EXPECT_EQ(job.least_grade, 2);
    EXPECT_EQ(job.region, (Rectangle{10, 20, 300, 200}));
    EXPECT_TRUE(job.inside({310, 220}));
    EXPECT_FALSE(job.inside({309, 220}) || job.inside({310, 219}));
    const BarRules& rules = job.options.rules;
    EXPECT_EQ(rules.add_on, AddOn::appended);
    EXPECT_EQ(rules.code_39_text, Code39Text::full_ascii);
    EXPECT_EQ(rules.codabar_check, CheckCharacter::required);
    EXPECT_EQ(rules.interleaved_shortest, 8);
    EXPECT_EQ(rules.interleaved_longest, 14);
    EXPECT_TRUE(read_code_job(top + "[codes]\nsymbologies = [\"qr\"]\ntaught = true\n").job.taught);
}

TEST(CodeJob, SaysWhatIsWrongAndWhere) {
    EXPECT_EQ(problem_of("[codes]\nsymbologies = [\"qr\"]\n"), "1:1: the file lacks format = 1");
    EXPECT_EQ(problem_of("format = 1\n[codes]\nsymbologies = [\"qr\"]\n"),
              "1:1: the file lacks name: what the job is called");
    EXPECT_EQ(problem_of("format = 2\nname = \"a\"\n[codes]\n"), "1:10: format: expected 1");
    EXPECT_EQ(problem_of("format = 1\nname = 3\n[codes]\n"),
              "2:8: name: expected a text of 1 to 31 bytes without control characters");
    EXPECT_EQ(problem_of("format = 1\nnome = \"a\"\n[codes]\n"), "2:1: unknown key nome; did you mean name?");
    EXPECT_EQ(problem_of("format = 1\nformat = 1\n[codes]\n"), "2:1: format stands twice");
    EXPECT_EQ(problem_of(top + "[codes]\n"),
              "3:2: [codes] lacks symbologies: what is looked for, as [\"ean-13\"]");
    EXPECT_EQ(problem_of(top + "[[codes]]\n"), "3:3: there is one [codes], in single brackets");
    EXPECT_EQ(problem_of(top + "[codes]\ncount = 1\n[codes]\n"), "5:2: [codes] stands twice");
    EXPECT_EQ(problem_of(top + "[codes]\ncount = \n").substr(0, 4), "4:9:");
    EXPECT_EQ(problem_of(top + "[codes]\nsymbologies = [\"qr\", \"eam-13\"]\n").substr(0, 79),
              "4:22: symbologies: there is no symbology 'eam-13'; did you mean ean-13?; there ");
    EXPECT_EQ(problem_of(top + "[codes]\nsymbologies = \"qr\"\n"),
              "4:15: symbologies is an array in brackets");
    EXPECT_EQ(problem_of(top + "[codes]\nsymbologies = []\n"),
              "4:15: symbologies: expected 1 to 16 elements, not 0");
    EXPECT_EQ(problem_in_codes("cuont = 1\n"), "5:1: unknown key cuont in [codes]; did you mean count?");
    EXPECT_EQ(problem_in_codes("count = 1\ncount = 1\n"), "6:1: count stands twice");
    EXPECT_EQ(problem_in_codes("count = 9\n"), "5:9: count: expected whole numbers from 1 to 8");
    EXPECT_EQ(problem_in_codes("count = \"1\"\n"), "5:9: count: expected whole numbers from 1 to 8");
    EXPECT_EQ(problem_in_codes("taught = 1\n"), "5:10: taught is true or false");
    EXPECT_EQ(problem_in_codes("others = \"ignore\"\n"),
              "5:10: others: expected \"wrong\" or \"ignored\"; did you mean ignored?");
    EXPECT_EQ(problem_in_codes("least_grade = 3\n"),
              "5:15: least_grade: expected \"F\", \"D\", \"C\", \"B\" or \"A\"");
    EXPECT_EQ(problem_in_codes("allowed = [\"a\", 3]\n"), "5:17: allowed: expected texts in quotes");
    EXPECT_EQ(problem_in_codes("allowed = [\"\"]\n"), "5:12: allowed: a text has 1 to 256 bytes");
    EXPECT_EQ(problem_in_codes("allowed = [\"\\\\q\"]\n"),
              "5:12: allowed: after \\ comes one of n r t xNN \\");
    EXPECT_EQ(problem_in_codes("patterns = [\"a\\\\!\"]\n"),
              "5:13: patterns: after \\ comes one of n r t xNN \\ # @ ? *");
    EXPECT_EQ(problem_in_codes("region = [1, 2, 3]\n"), "5:10: region: expected 4 elements, not 3");
    EXPECT_EQ(problem_in_codes("region = [1, 2, 3, 0]\n"),
              "5:20: region: expected whole numbers from 1 to 32767");
    EXPECT_EQ(problem_in_codes("digits = [7]\n"), "5:10: digits: expected even numbers");
    EXPECT_EQ(problem_in_codes("taught = true\nallowed = [\"a\"]\n"),
              "6:11: allowed has no meaning beside taught = true; patterns have");
    for (const char* lines : {"distinct = true\n", "distinct = true\ncount = 1\n"})
        EXPECT_EQ(problem_in_codes(lines), "5:12: distinct = true wants a count of 2 or more");
    EXPECT_EQ(problem_in_codes("distinct = true\ncount = 2\n"), "");
    EXPECT_EQ(problem_in_codes("distinct = false\n"), "");
    EXPECT_EQ(problem_in_codes("others = \"ignored\"\n"),
              "5:10: others = \"ignored\" wants allowed, patterns or taught beside it");
}

TEST(CodeJob, LeavesARecipeAroundItWhereItStood) {
    const std::string front = "format = 1\nname = \"a\"\n[locate]\npart = \"dark\"\n";
    const std::string behind = "[[feature]]\nname = \"d\"\n";
    const std::string codes = "[codes] # here\n# \xc3\xa9\r\nsymbologies = [\"qr\"]\n";
    const CodeJobFile file = read_code_job(front + codes + behind);
    ASSERT_EQ(file.problem, "");
    EXPECT_TRUE(file.found && !file.alone);
    EXPECT_EQ(file.recipe.size(), (front + codes + behind).size());
    EXPECT_EQ(file.recipe.substr(0, front.size()), front);
    EXPECT_EQ(file.recipe.substr(front.size(), codes.size()).find_first_not_of(" \n"), std::string::npos);
    EXPECT_EQ(file.recipe.substr(front.size() + codes.size()), behind);
    EXPECT_EQ(read_code_job(front + behind + codes).recipe.substr(0, front.size() + behind.size()),
              front + behind);
    const CodeJobFile none = read_code_job(front + behind);
    EXPECT_FALSE(none.found);
    EXPECT_EQ(none.problem, "") << "a recipe is another's business";
}

TEST(CodeJob, HasAPageOfItsKeys) {
    const std::string page = code_keys_manual();
    for (const CodeKey& key : code_keys())
        EXPECT_NE(page.find(std::string(".B ") + key.name + "\n"), std::string::npos);
    EXPECT_NE(page.find("how many codes are expected; 1 to 8; 1 if left out.\n"), std::string::npos);
    EXPECT_NE(page.find("; required.\n"), std::string::npos);
}

}  // namespace
}  // namespace fovea::apps
