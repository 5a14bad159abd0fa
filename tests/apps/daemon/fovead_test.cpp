// SPDX-License-Identifier: MIT
//
// The whole program on a replay: its settings and jobs in files, signals, and what it prints.
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include <daemon/fovead.hpp>

#include "support/code_scene.hpp"
#include "support/daemon_world.hpp"
#include "support/json.hpp"
#include "support/temporary_folder.hpp"
#include "support/timed_kernel.hpp"

namespace fovea::apps {
namespace {

using test::Json;

/// The kernel, but for time and the standard output.
class PrintingKernel : public test::TimedKernel {
public:
    PrintingKernel(test::TestTime& time, std::string& printed) : TimedKernel(time), printed_(&printed) {}

    std::ptrdiff_t write(int file, Span<const std::uint8_t> bytes) {
        if (file != 1) return TimedKernel::write(file, bytes);
        printed_->append(reinterpret_cast<const char*>(bytes.data()), static_cast<std::size_t>(bytes.size()));
        return bytes.size();
    }
    int poll(Span<pollfd> files, std::int64_t patience_us) {
        if (files.size() != 1 || files[0].fd != 1) return TimedKernel::poll(files, patience_us);
        files[0].revents = POLLOUT;
        return 1;
    }

private:
    std::string* printed_;
};

/// A folder with settings, two jobs and pictures of discs, and one run of the program in it.
class Program {
public:
    Program() {
        std::filesystem::create_directory(folder.file("jobs"));
        std::filesystem::create_directory(folder.file("pictures"));
        folder.write("jobs/disc.toml", test::disc_recipe());
        folder.write("jobs/second.toml", test::disc_recipe("other"));
        for (int k = 0; k < 7; ++k) {
            const auto pixels = test::disc_scene(160, 120, 17 + k, k != 4);
            folder.write("pictures/" + std::to_string(k) + ".pgm",
                         "P5\n160 120\n255\n" + std::string(pixels.begin(), pixels.end()));
        }
        write_settings();
    }

    void write_settings(const std::string& more = "", const std::string& rate = "40") {
        folder.write("fovead.toml", "format = 1\n[camera]\nreplay = \"" + folder.file("pictures") +
                                        "\"\nwidth = 160\nheight = 120\nevery_frame = true\nrate_per_s = " +
                                        rate + "\n" + more);
    }
    void at(std::int64_t ms, const std::function<void()>& what) {
        time.plan.insert({time.now_us + ms * 1000, what});
    }
    void reload_at(std::int64_t ms) {
        at(ms, [this] { signals.reload = true; });
    }
    void end_at(std::int64_t ms) {
        at(ms, [this] { signals.end = true; });
    }

    int run() {
        const PrintingKernel kernel(time, printed);
        const auto take_signals = [this] {
            const DaemonSignals taken = signals;
            signals.reload = false;
            return taken;
        };
        return fovead({"--config", folder.file("fovead.toml")}, *this, kernel, {}, -1, take_signals, "1");
    }

    /// The lines that tell of this.
    std::vector<Json> events(const std::string& kind) const {
        std::vector<Json> found;
        for (const std::string& line : split(printed, '\n')) {
            if (line.empty()) continue;
            const auto json = test::parse_json(line);
            EXPECT_TRUE(json.has_value()) << line;
            if (json && (*json)["ev"].text == kind) found.push_back(*json);
        }
        return found;
    }

    void print(const std::string& text) { printed += text; }
    void complain(const std::string& text) { complaints += text + "\n"; }

    test::TemporaryFolder folder;
    test::TestTime time;
    DaemonSignals signals;
    std::string printed;
    std::string complaints;
};

void expect_numbers_from_one(const std::vector<Json>& results) {
    for (std::size_t k = 0; k < results.size(); ++k)
        ASSERT_EQ(results[k]["seq"].number(), static_cast<double>(k + 1));
}

TEST(Fovead, JudgesAThousandFramesOfAReplay) {
    Program program;
    program.end_at(25200);
    EXPECT_EQ(program.run(), daemon_ok);
    EXPECT_EQ(program.complaints, "");
    const std::vector<Json> results = program.events("result");
    ASSERT_GE(results.size(), 1000u);
    expect_numbers_from_one(results);
    for (std::size_t k = 0; k < results.size(); ++k) {
        // Radii of 17 to 23, of which 20 is right; 21 has no hole.
        const std::size_t picture = k % 7;
        EXPECT_EQ(results[k]["verdict"].text, picture == 3 ? "OK" : "NG") << picture;
    }
}

TEST(Fovead, SaysWhyThereIsNoPictureAndGoesOnWhenThereIs) {
    Program program;
    std::filesystem::rename(program.folder.file("pictures"), program.folder.file("away"));
    std::filesystem::create_directory(program.folder.file("pictures"));
    program.at(500, [&] {
        std::filesystem::remove(program.folder.file("pictures"));
        std::filesystem::rename(program.folder.file("away"), program.folder.file("pictures"));
    });
    program.end_at(3000);
    EXPECT_EQ(program.run(), daemon_ok);
    const std::vector<Json> troubles = program.events("camera_no_signal");
    ASSERT_EQ(troubles.size(), 1u);
    EXPECT_EQ(troubles[0]["reason"].text, describe(Status::no_signal));
    EXPECT_EQ(program.events("camera_back").size(), 1u);
    expect_numbers_from_one(program.events("result"));
    EXPECT_FALSE(program.events("result").empty());
}

TEST(Fovead, SaysTheSameWithAnyNumberOfThreads) {
    const auto results = [](int threads) {
        Program program;
        program.write_settings("[processor]\nthreads = " + std::to_string(threads) + "\n");
        program.end_at(1000);
        EXPECT_EQ(program.run(), daemon_ok);
        EXPECT_EQ(program.events("start").at(0)["threads"].number(), threads);
        // Time is that of the test, so it is the same as well.
        return program.printed.substr(program.printed.find("\"result\""));
    };
    const std::string one = results(1);
    EXPECT_GT(one.size(), 5000u);
    for (const int threads : {4, 16}) EXPECT_EQ(results(threads), one);
}

TEST(Fovead, ReadsJobsAnewBetweenTwoFramesWithoutOpeningAnything) {
    Program program;
    program.write_settings("[jobs]\nstart = \"second\"\n");
    program.at(500, [&] {
        // One more in front, and another recipe: nothing can be right by it.
        program.folder.write("jobs/a.toml", test::disc_recipe());
        std::string other = test::disc_recipe("other");
        other.replace(other.find("nominal = 40"), 12, "nominal = 90");
        program.folder.write("jobs/second.toml", other);
        program.signals.reload = true;
    });
    program.end_at(1000);
    EXPECT_EQ(program.run(), daemon_ok);
    EXPECT_EQ(program.events("start").size(), 1u);
    EXPECT_EQ(program.events("reload").size(), 1u);
    const std::vector<Json> results = program.events("result");
    ASSERT_GE(results.size(), 35u);
    expect_numbers_from_one(results);
    std::set<std::string> recipes;
    for (const Json& result : results) {
        EXPECT_EQ(result["job"].text, "second") << "it stays, though its number is another";
        recipes.insert(result["job_crc"].text);
    }
    EXPECT_EQ(recipes.size(), 2u);
}

TEST(Fovead, OpensDevicesAnewWhereTheirSettingsAreOthersAndGoesOnCounting) {
    Program program;
    program.at(500, [&] {
        program.write_settings("", "20");
        program.signals.reload = true;
    });
    program.end_at(1000);
    EXPECT_EQ(program.run(), daemon_ok);
    const std::vector<Json> starts = program.events("start");
    ASSERT_EQ(starts.size(), 2u);
    EXPECT_EQ(starts[1]["interval_us"].number(), 50000);
    const std::vector<Json> results = program.events("result");
    ASSERT_GE(results.size(), 25u);
    expect_numbers_from_one(results);
}

TEST(Fovead, StaysAsItWasByWrongFiles) {
    Program program;
    program.at(300, [&] {
        program.write_settings("[nothing]\n");
        program.signals.reload = true;
    });
    program.at(600, [&] {
        program.write_settings();
        program.folder.write("jobs/disc.toml", "format = 1\nname = 3\n");
        program.signals.reload = true;
    });
    program.end_at(1000);
    EXPECT_EQ(program.run(), daemon_ok);
    EXPECT_EQ(program.events("start").size(), 1u);
    const std::vector<Json> failed = program.events("reload_failed");
    ASSERT_EQ(failed.size(), 2u);
    EXPECT_NE(failed[0]["reason"].text.find("unknown table nothing"), std::string::npos);
    EXPECT_NE(failed[1]["reason"].text.find("disc.toml:2:8"), std::string::npos) << failed[1]["reason"].text;
    expect_numbers_from_one(program.events("result"));
    EXPECT_GE(program.events("result").size(), 25u);
}

TEST(Fovead, TakesOtherOptionsBetweenTwoFrames) {
    Program program;
    program.at(500, [&] {
        program.write_settings("[results]\njson = false\n");
        program.signals.reload = true;
    });
    program.end_at(1000);
    EXPECT_EQ(program.run(), daemon_ok);
    EXPECT_EQ(program.events("start").size(), 1u);
    const std::vector<Json> results = program.events("result");
    EXPECT_GE(results.size(), 18u);
    EXPECT_LE(results.size(), 22u) << "none is printed from then on";
}

TEST(Fovead, ReadsCodesWithAnyNumberOfThreads) {
    const auto results = [](int threads) {
        Program program;
        std::filesystem::remove(program.folder.file("jobs/disc.toml"));
        program.folder.write(
            "jobs/second.toml",
            "format = 1\nname = \"label\"\n[codes]\nsymbologies = [\"qr\"]\npatterns = [\"N#\"]\n");
        const char* const texts[7] = {"N0", "N1", "X", "N3", "N4", "N", "N6"};
        for (int k = 0; k < 7; ++k)
            program.folder.write("pictures/" + std::to_string(k) + ".pgm",
                                 test::CodeScene({160, 120}).draw(texts[k], Symbology::qr, 20, 2, 3).pgm());
        program.write_settings("[processor]\nthreads = " + std::to_string(threads) + "\n");
        program.end_at(1000);
        EXPECT_EQ(program.run(), daemon_ok);
        EXPECT_EQ(program.complaints, "");
        const std::vector<Json> said = program.events("result");
        EXPECT_GE(said.size(), 35u);
        for (std::size_t k = 0; k < said.size(); ++k) {
            const bool good = k % 7 != 2 && k % 7 != 5;
            EXPECT_EQ(said[k]["verdict"].text, good ? "OK" : "NG");
            EXPECT_EQ(said[k]["why"].text, good ? "" : "wrong_code");
            if (said[k]["codes"].items.empty()) {
                ADD_FAILURE() << "no code in picture " << k % 7;
                break;
            }
            EXPECT_EQ(said[k]["codes"].items[0]["text"].text, texts[k % 7]);
        }
        return program.printed.substr(program.printed.find("\"result\""));
    };
    EXPECT_EQ(results(4), results(1));
}

TEST(Fovead, ChecksWhatAJobLooksAtBeforeItBegins) {
    Program program;
    const std::string job = program.folder.file("jobs/second.toml");
    program.folder.write(
        "jobs/second.toml",
        "format = 1\nname = \"label\"\n[codes]\nsymbologies = [\"qr\"]\nregion = [1, 0, 160, 120]\n");
    const auto check = [&] {
        program.complaints = program.printed = "";
        return fovead(
            {"--config", program.folder.file("fovead.toml"), "--check-config"}, program,
            PrintingKernel(program.time, program.printed), {}, -1, [] { return DaemonSignals(); }, "1");
    };
    EXPECT_EQ(check(), daemon_config);
    EXPECT_EQ(program.complaints, "fovead: " + job + ":5:10: region: the picture has 160 x 120 px\n");
    program.folder.write("jobs/second.toml",
                         "format = 1\nname = \"label\"\n[codes]\nsymbologies = [\"rq\"]\n");
    EXPECT_EQ(check(), daemon_config);
    EXPECT_EQ(program.complaints.find("fovead: " + job + ":4:16: symbologies: there is no symbology 'rq'"),
              0u)
        << program.complaints;
    program.folder.write("jobs/second.toml",
                         "format = 1\nname = \"label\"\n[codes]\nsymbologies = [\"qr\"]\n");
    EXPECT_EQ(check(), daemon_ok);
    EXPECT_NE(program.printed.find("good, 2 jobs"), std::string::npos);
}

}  // namespace
}  // namespace fovea::apps
