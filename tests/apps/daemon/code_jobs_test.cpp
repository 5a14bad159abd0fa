// SPDX-License-Identifier: MIT
//
// Jobs that read codes: their files, and the daemon by them.
#include <gtest/gtest.h>

#include <cstdint>
#include <deque>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <daemon/daemon.hpp>
#include <daemon/jobs.hpp>
#include <daemon/judge.hpp>

#include "support/code_scene.hpp"
#include "support/daemon_world.hpp"
#include "support/json.hpp"

namespace fovea::apps {
namespace {

using test::CodeScene;
using test::DaemonWorld;
using test::run;
using Words = std::vector<std::string>;

std::string label_job(const std::string& more = "") {
    return "format = 1\nname = \"label\"\n[codes]\nsymbologies = [\"qr\"]\n" + more;
}
/// A disc with a hole, and a code beside it, of which no group of modules is as large as the disc.
std::string both_job() {
    std::string recipe = test::disc_recipe();
    recipe.replace(recipe.find("\narea_min = 100"), 15, "\narea_min = 600");
    return recipe + "[codes]\nsymbologies = [\"qr\"]\nregion = [90, 0, 70, 120]\n";
}

// ---- Files --------------------------------------------------------------------------------

std::string read_jobs(const std::string& text, JobList& jobs) {
    simulated::MemoryStorage storage;
    storage.files["jobs/a.toml"] = DaemonWorld::bytes(text);
    return jobs.read(storage, "jobs", {"a"});
}

TEST(JobList, KnowsWhatAJobIs) {
    JobList jobs;
    ASSERT_EQ(read_jobs(label_job(), jobs), "");
    EXPECT_TRUE(jobs[1].reads && !jobs[1].gauges);
    EXPECT_EQ(judge_scratch({160, 120}, jobs[1]), read_codes_scratch({160, 120}));
    ASSERT_EQ(read_jobs(test::disc_recipe(), jobs), "");
    EXPECT_TRUE(!jobs[1].reads && jobs[1].gauges);
    const std::int64_t gauging = judge_scratch({160, 120}, jobs[1]);
    ASSERT_EQ(read_jobs(both_job(), jobs), "");
    EXPECT_TRUE(jobs[1].reads && jobs[1].gauges);
    EXPECT_EQ(jobs[1].recipe.features.size(), 2);
    EXPECT_EQ(judge_scratch({160, 120}, jobs[1]), maximum(gauging, read_codes_scratch({70, 120})));
}

TEST(JobList, SaysWhatIsWrongWithAJobAndWhere) {
    JobList jobs;
    EXPECT_EQ(read_jobs(label_job("cuont = 2\n"), jobs),
              "jobs/a.toml:5:1: unknown key cuont in [codes]; did you mean count?");
    std::string wrong = both_job();
    wrong.replace(wrong.find("nominal = 40"), 12, "nominol = 40");
    EXPECT_EQ(read_jobs("[codes]\nsymbologies = [\"qr\"]\n", jobs),
              "jobs/a.toml:1:1: the file lacks format = 1");
    // Behind [codes] a recipe has its mistakes where they stand.
    const std::string front =
        "format = 1\nname = \"x\"\n[codes]\nsymbologies = [\"qr\"]\n[locate]\nport = \"dark\"\n";
    EXPECT_EQ(read_jobs(front, jobs).substr(0, 22), "jobs/a.toml:6:1: unkno");
    EXPECT_NE(read_jobs(wrong, jobs).find("unknown key nominol"), std::string::npos);
}

TEST(JobList, SaysWhichRegionLeavesThePicture) {
    JobList jobs;
    ASSERT_EQ(read_jobs(label_job("region = [10, 0, 151, 120]\n"), jobs), "");
    EXPECT_EQ(jobs.fit("jobs", {161, 120}), "");
    EXPECT_EQ(jobs.fit("jobs", {160, 120}), "jobs/a.toml:5:10: region: the picture has 160 x 120 px");
}

TEST(RecipeFile, SaysWhoTakesATableOfCodes) {
    const RecipeFile file = read_recipe(both_job());
    EXPECT_NE(file.problem.find("[codes] is no part of a recipe; `fovead` and `fovea read --job` take it"),
              std::string::npos);
}

// ---- The page -----------------------------------------------------------------------------

std::string page() {
    std::ifstream file(std::string(FOVEA_SOURCE_DIR) + "/docs/daemon.md");
    return {std::istreambuf_iterator<char>(file), {}};
}

TEST(DocumentedCodeJob, IsAJobThatDoesWhatThePageSays) {
    const std::string text = page();
    const std::size_t first = text.find("format = 1\nname = \"label\"");
    ASSERT_NE(first, std::string::npos);
    Job job;
    ASSERT_EQ(read_job(text.substr(first, text.find("```", first) - first), job), "");
    const auto judge = [&](const std::string& ean, const std::string& serial) {
        CodeScene scene({640, 480});
        scene.draw(ean, Symbology::ean_13, 60, 20, 3, 80).draw(serial, Symbology::data_matrix, 80, 220, 5);
        std::vector<std::uint8_t> scratch(static_cast<std::size_t>(judge_scratch({640, 480}, job)));
        Judge judging;
        Inspection inspection;
        judging.judge(scene.view(), job, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())},
                      OneWorker(), inspection);
        return std::string(word_of(inspection.answer)) + inspection.reason;
    };
    EXPECT_EQ(judge("400638133393", "SN-DE0042x"), "OK");
    EXPECT_EQ(judge("500638133393", "SN-DE0042x"), "NGwrong_code");
    EXPECT_EQ(judge("400638133393", "SN-D10042x"), "NGwrong_code");
}

TEST(DocumentedCodeJob, HasEveryReasonOnThePage) {
    const std::string text = page();
    for (const char* reason :
         {"no_code", "undecided_code", "wrong_code", "too_few_codes", "too_many_codes", "duplicate_code",
          "repeated_code", "low_grade", "not_taught", "region_outside", "codes_too_long"})
        EXPECT_NE(text.find(std::string("`") + reason + "`"), std::string::npos) << reason;
}

// ---- The daemon ---------------------------------------------------------------------------

/// A daemon before a camera that looks at codes. What must hold of every run holds of this one.
struct Bench {
    explicit Bench(const std::string& job, TriggerSource source = TriggerSource::command,
                   bool samples = false) {
        DaemonOptions options;
        options.source = source;
        options.serial_results = true;
        options.timeout_us = 600000;
        options.samples = samples;
        EXPECT_EQ(options.serial_template.read(letters_of("{seq};{verdict};{why|fine};{code|none}\\r\\n")),
                  Status::ok);
        daemon.take_options(options);
        world.storage.files["jobs/label.toml"] = DaemonWorld::bytes(job);
        EXPECT_EQ(world.job_list.read(world.storage, "jobs", {"disc", "label"}), "");
        for (int number = 1; number <= 2; ++number)
            scratch = maximum(scratch, judge_scratch({160, 120}, world.job_list[number]));
        world.scratch_room.resize(static_cast<std::size_t>(scratch));
        EXPECT_TRUE(daemon.take_job(2));
        see(CodeScene({160, 120}));
        run(world, daemon, 100000);
    }
    ~Bench() {
        world.invariants.end(world.device.now_us, false, daemon.busy(), world.device.open_handles, 1);
        EXPECT_EQ(world.invariants.complaints, Words());
        EXPECT_TRUE(daemon.tally().adds_up());
    }
    Bench(const Bench&) = delete;
    Bench& operator=(const Bench&) = delete;
    void see(const CodeScene& scene) {
        scenes.push_back(scene.pixels());
        world.device.scene = &scenes.back();
    }
    void see_text(const std::string& text) { see(CodeScene({160, 120}).draw(text, Symbology::qr, 20, 2, 3)); }
    /// What is sent after a command, in a time that is enough for a frame.
    std::string after(const std::string& command) {
        world.heard();
        world.say(command + "\n");
        run(world, daemon, 150000);
        return world.heard();
    }
    /// The result of a trigger.
    std::string triggered() {
        const std::string said = after("TRG");
        EXPECT_EQ(said.substr(0, 4), "OK\r\n");
        return said.substr(4);
    }
    /// The last line that it printed of that event.
    std::string last_event(const std::string& event) {
        for (std::size_t k = world.printed.size(); k > 0; --k)
            if (world.printed[k - 1].find("\"ev\":\"" + event + "\"") != std::string::npos)
                return world.printed[k - 1];
        return "";
    }
    DaemonWorld world;
    Daemon<DaemonWorld> daemon{world, DaemonOptions()};
    std::deque<std::vector<std::uint8_t>> scenes;
    std::int64_t scratch = 0;
};

TEST(CodeJobs, AreJudgedOnATrigger) {
    Bench bench(label_job("patterns = [\"A#\"]\n"));
    EXPECT_EQ(bench.triggered(), "1;NG;no_code;none\r\n");
    EXPECT_TRUE(bench.world.not_ok() && bench.world.valid());
    bench.see_text("A7");
    EXPECT_EQ(bench.triggered(), "2;OK;fine;A7\r\n");
    EXPECT_TRUE(bench.world.ok() && bench.world.valid());
    const std::string line = bench.last_event("result");
    EXPECT_NE(line.find("\"verdict\":\"OK\",\"why\":null,\"parts\":0,\"values\":[],\"codes\":[{\"symbology\":"
                        "\"QR\",\"text\":\"A7\","
                        "\"bytes_hex\":\"4137\",\"aim\":\"]Q1\",\"corners_px\":[["),
              std::string::npos)
        << line;
    EXPECT_TRUE(test::parse_json(line).has_value());
    EXPECT_EQ(bench.after("LAST?").substr(0, 4), "OK {");
    bench.see_text("B7");
    EXPECT_EQ(bench.triggered(), "3;NG;wrong_code;B7\r\n");
    EXPECT_EQ(bench.world.failures, (std::vector<std::uint64_t>{1, 3}));
    bench.world.quality_verdict = ImageVerdict::dark;
    EXPECT_EQ(bench.triggered(), "4;ERROR;image_dark;none\r\n");
    EXPECT_NE(bench.last_event("result").find("\"codes\":[]"), std::string::npos);
    bench.world.quality_verdict = ImageVerdict::fine;
    // By the other job of the folder it gauges, as ever.
    EXPECT_EQ(bench.after("JOB disc"), "OK 1 disc\r\n");
    bench.world.device.scene = &bench.world.good;
    EXPECT_EQ(bench.triggered(), "5;OK;fine;none\r\n");
    EXPECT_EQ(bench.last_event("result").find("\"codes\""), std::string::npos);
}

TEST(CodeJobs, AreJudgedOfEveryFrameInFreeRun) {
    Bench bench(label_job(), TriggerSource::free);
    bench.see_text("A7");
    run(bench.world, bench.daemon, 1000000);
    EXPECT_GE(bench.daemon.tally().ok, 20u);
    bench.see(CodeScene({160, 120}));
    run(bench.world, bench.daemon, 400000);
    EXPECT_GE(bench.daemon.tally().not_ok, 5u);
}

TEST(CodeJobs, LetNoCodeForgeARecord) {
    Bench bench(label_job());
    const std::string forged = "x;\r\n9;OK;fine;A7\r\n\x03\x1d\\";
    bench.see_text(forged);
    EXPECT_EQ(bench.triggered(), "1;OK;fine;x\\x3b\\r\\n9\\x3bOK\\x3bfine\\x3bA7\\r\\n\\x03\\x1d\\\\\r\n");
    const auto json = test::parse_json(bench.last_event("result"));
    ASSERT_TRUE(json.has_value());
    ASSERT_EQ((*json)["codes"].items.size(), 1u);
    EXPECT_EQ((*json)["codes"].items[0]["text"].text, forged);
}

TEST(CodeJobs, StandBesideARecipe) {
    Bench bench(both_job());
    const auto scene = [](int radius, const std::string& text) {
        CodeScene made({160, 120});
        for (int y = 0; y < 120; ++y)
            for (int x = 0; x < 90; ++x) {
                const int square = (x - 40) * (x - 40) + (y - 60) * (y - 60);
                if (square <= radius * radius && square > 16) made.pixel(x, y) = 30;
            }
        if (!text.empty()) made.draw(text, Symbology::qr, 96, 30, 2);
        return made;
    };
    bench.see(scene(20, "A7"));
    EXPECT_EQ(bench.triggered(), "1;OK;fine;A7\r\n");
    const std::string line = bench.last_event("result");
    EXPECT_NE(line.find("\"parts\":1,\"values\":[{\"name\":\"holes\""), std::string::npos) << line;
    EXPECT_NE(line.find("],\"codes\":[{\"symbology\":\"QR\""), std::string::npos) << line;
    bench.see(scene(20, ""));
    EXPECT_EQ(bench.triggered(), "2;NG;no_code;none\r\n");
    bench.see(scene(25, "A7"));
    EXPECT_EQ(bench.triggered(), "3;NG;high;A7\r\n");
    bench.see(scene(25, ""));
    EXPECT_EQ(bench.triggered(), "4;NG;high;none\r\n") << "the parts were first";
    EXPECT_NE(bench.last_event("result").find("\"feature\":\"d1\",\"parts\":1"), std::string::npos);
    bench.see(CodeScene({160, 120}).draw("A7", Symbology::qr, 96, 30, 2));
    EXPECT_EQ(bench.triggered(), "5;ERROR;no_part;A7\r\n");
    bench.see(CodeScene({160, 120}));
    EXPECT_EQ(bench.triggered(), "6;NG;no_code;none\r\n")
        << "what is not OK says more than what has no verdict";
}

TEST(CodeJobs, AreTaughtTheirCode) {
    Bench bench(label_job("taught = true\n"));
    bench.see_text("A7");
    EXPECT_EQ(bench.triggered(), "1;ERROR;not_taught;A7\r\n");
    EXPECT_EQ(bench.after("TEACH label"), "OK\r\n");
    EXPECT_NE(bench.last_event("taught").find(
                  "\"name\":\"label\",\"codes\":[{\"symbology\":\"QR\",\"text\":\"A7\""),
              std::string::npos);
    EXPECT_EQ(bench.world.samples, Words()) << "no folder is wanted for it";
    EXPECT_EQ(bench.triggered(), "2;OK;fine;A7\r\n");
    bench.see_text("A8");
    EXPECT_EQ(bench.triggered(), "3;NG;wrong_code;A8\r\n");
    // What was told last stays what it was.
    EXPECT_EQ(bench.after("TEACH label"), "OK\r\n");
    EXPECT_NE(bench.after("LAST?").find("\"seq\":3"), std::string::npos);
    EXPECT_EQ(bench.triggered(), "4;OK;fine;A8\r\n");
    bench.see(CodeScene({160, 120}));
    EXPECT_EQ(bench.after("TEACH label"), "OK\r\n");
    EXPECT_NE(bench.last_event("not_taught").find("\"reason\":\"no_code\",\"codes\":[]"), std::string::npos);
    bench.see_text("A8");
    EXPECT_EQ(bench.triggered(), "5;ERROR;not_taught;A8\r\n") << "nothing is left that is allowed";
    EXPECT_EQ(bench.after("TEACH label"), "OK\r\n");
    EXPECT_EQ(bench.triggered(), "6;OK;fine;A8\r\n");
    EXPECT_EQ(bench.after("JOB label"), "OK 2 label\r\n");
    EXPECT_EQ(bench.triggered(), "7;ERROR;not_taught;A8\r\n") << "with the job it is forgotten";
}

TEST(CodeJobs, ForgetTheCodeBeforeAsSoonAsAnotherIsToBeTaught) {
    Bench bench(label_job("taught = true\n"));
    bench.see_text("A7");
    EXPECT_EQ(bench.after("TEACH label"), "OK\r\n");
    EXPECT_EQ(bench.triggered(), "1;OK;fine;A7\r\n");
    bench.world.undecodable = 1000;  // no frame can be taken
    EXPECT_EQ(bench.after("TEACH label"), "OK\r\n");
    bench.world.undecodable = 0;
    bench.see(CodeScene({160, 120}));
    run(bench.world, bench.daemon, 150000);
    bench.see_text("A7");
    EXPECT_EQ(bench.triggered(), "2;ERROR;not_taught;A7\r\n");
}

TEST(CodeJobs, AreTaughtWhatLiesThereWhenItIsAskedFor) {
    Bench bench(label_job("taught = true\n"));
    bench.see_text("A7");
    run(bench.world, bench.daemon, 100000);
    // A frame that is on its way already shows the part before.
    bench.world.say("TEACH label\n");
    bench.daemon.turn();
    EXPECT_EQ(bench.last_event("taught"), "");
    bench.see_text("A8");
    run(bench.world, bench.daemon, 200000);
    EXPECT_NE(bench.last_event("taught").find("\"text\":\"A8\""), std::string::npos);
}

TEST(CodeJobs, GiveUpToBeTaughtWhereNoFrameComes) {
    Bench bench(label_job("taught = true\n"));
    bench.see_text("A7");
    run(bench.world, bench.daemon, 100000);
    // Another job in the same breath: the next frame teaches it nothing.
    EXPECT_EQ(bench.after("TEACH label\nJOB label"), "OK\r\nOK 2 label\r\n");
    EXPECT_NE(bench.last_event("not_taught").find("\"reason\":\"another_job\""), std::string::npos);
    EXPECT_EQ(bench.last_event("taught"), "");
    EXPECT_EQ(bench.triggered(), "1;ERROR;not_taught;A7\r\n");
    bench.world.undecodable = 1000;
    bench.world.say("TEACH label\n");
    run(bench.world, bench.daemon, 5000000);
    EXPECT_NE(bench.last_event("not_taught").find("\"reason\":\"no_frame\""), std::string::npos);
    bench.world.undecodable = 0;
    run(bench.world, bench.daemon, 200000);
    EXPECT_EQ(bench.last_event("taught"), "");
    bench.world.heard();
    bench.world.say("TEACH label\n");
    bench.daemon.turn();
    bench.world.device.unplugged = true;
    run(bench.world, bench.daemon, 100000);
    EXPECT_NE(bench.last_event("not_taught").find("\"reason\":\"no_camera\""), std::string::npos);
    bench.world.device.unplugged = false;
    run(bench.world, bench.daemon, 3000000);
}

TEST(CodeJobs, KeepASampleWhereThereIsAFolder) {
    Bench bench(label_job(), TriggerSource::command, true);
    EXPECT_EQ(bench.after("TEACH label"), "OK\r\n");
    EXPECT_EQ(bench.world.samples, Words({"label"}));
    EXPECT_EQ(bench.last_event("taught") + bench.last_event("not_taught"), "");
    Bench none(label_job());
    EXPECT_EQ(none.after("TEACH label"), "ERR 41 [teach] has no folder, and the job no taught = true\r\n");
    Bench taught(label_job("taught = true\n"), TriggerSource::command, true);
    taught.see_text("A7");
    EXPECT_EQ(taught.after("TEACH label"), "OK\r\n");
    EXPECT_EQ(taught.world.samples, Words({"label"}));
    EXPECT_EQ(taught.triggered(), "1;OK;fine;A7\r\n");
}

TEST(CodeJobs, GiveTheLastCodeOnceWhereEachHasItsOwn) {
    Bench bench(label_job("unlike_last = true\n"));
    bench.see_text("SN1");
    EXPECT_EQ(bench.triggered(), "1;OK;fine;SN1\r\n");
    EXPECT_EQ(bench.triggered(), "2;NG;repeated_code;SN1\r\n");
    bench.see_text("SN2");
    EXPECT_EQ(bench.triggered(), "3;OK;fine;SN2\r\n");
}

}  // namespace
}  // namespace fovea::apps
