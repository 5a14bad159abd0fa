// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <string>
#include <vector>

#include <fovea/base/random.hpp>

#include <daemon/daemon.hpp>

#include "support/daemon_world.hpp"

namespace fovea::apps {
namespace {

using test::DaemonWorld;
using test::run;
using Words = std::vector<std::string>;

DaemonOptions options(TriggerSource source) {
    DaemonOptions made;
    made.source = source;
    made.serial_results = true;
    made.timeout_us = 600000;
    made.samples = true;
    made.version = "0.1.0";
    EXPECT_EQ(made.serial_template.read(letters_of("{seq}{pass}\\n")), Status::ok);
    return made;
}

struct Bench {
    explicit Bench(TriggerSource source, const LineTiming& timing = {})
        : world(timing), daemon(world, options(source)), by_edges(source == TriggerSource::line) {
        EXPECT_EQ(world.problem, "");
        EXPECT_TRUE(daemon.take_job(1));
    }
    /// Whatever a test did, this must hold of it.
    ~Bench() {
        world.invariants.end(world.device.now_us, by_edges, daemon.busy(), world.device.open_handles,
                             world.camera().streaming() ? 1 : 0);
        EXPECT_EQ(world.invariants.complaints, Words());
        EXPECT_TRUE(daemon.tally().adds_up());
    }
    Bench(const Bench&) = delete;
    Bench& operator=(const Bench&) = delete;
    void edge() { world.edges.push_back({world.device.now_us, 0}); }
    DaemonWorld world;
    Daemon<DaemonWorld> daemon;
    bool by_edges;
};

TEST(Daemon, JudgesEveryFrameInFreeRun) {
    Bench bench(TriggerSource::free);
    run(bench.world, bench.daemon, 1000000);
    EXPECT_GE(bench.daemon.tally().ok, 20u);
    EXPECT_EQ(bench.daemon.tally().triggers, bench.daemon.tally().ok);
    EXPECT_TRUE(bench.world.ok() && bench.world.valid() && !bench.world.not_ok() && !bench.world.alarm());
    EXPECT_EQ(bench.world.heard().substr(0, 9), "1P\n2P\n3P\n");
    bench.world.device.scene = &bench.world.bad;
    run(bench.world, bench.daemon, 200000);
    EXPECT_TRUE(bench.world.not_ok() && bench.world.valid() && !bench.world.ok());
    EXPECT_EQ(bench.world.failures.size(), bench.daemon.tally().not_ok);
    const std::string& last = bench.world.printed.back();
    EXPECT_NE(last.find("\"verdict\":\"NG\",\"why\":\"low\",\"feature\":\"holes\",\"parts\":1"),
              std::string::npos)
        << last;
}

TEST(Daemon, AnswersAnEdgeWithAFrameThatBeganAfterIt) {
    Bench bench(TriggerSource::line);
    run(bench.world, bench.daemon, 300000);
    EXPECT_TRUE(bench.world.ready());
    EXPECT_EQ(bench.daemon.tally().triggers, 0u);
    bench.world.device.scene = &bench.world.bad;
    const std::int64_t trigger_us = bench.world.device.now_us;
    bench.edge();
    bench.daemon.turn();
    EXPECT_TRUE(bench.world.busy() && !bench.world.ready() && !bench.world.valid());
    run(bench.world, bench.daemon, 120000);
    EXPECT_FALSE(bench.world.busy());
    EXPECT_TRUE(bench.world.not_ok() && bench.world.valid() && bench.world.ready());
    EXPECT_EQ(bench.daemon.tally().not_ok, 1u);
    EXPECT_LE(bench.daemon.tally().longest_us, 90000);  // at most two intervals, and a turn
    EXPECT_GE(bench.daemon.tally().longest_us, 40000);
    EXPECT_GT(bench.world.device.now_us, trigger_us);
    EXPECT_EQ(bench.world.heard(), "1F\n");
}

TEST(Daemon, CountsTriggersThatCameWhileBusy) {
    Bench bench(TriggerSource::line);
    bench.world.judging_us = 200000;
    run(bench.world, bench.daemon, 300000);
    bench.edge();
    bench.daemon.turn();
    bench.edge();  // waits for its frame
    run(bench.world, bench.daemon, 100000);
    const std::int64_t answered_us = bench.world.device.now_us;
    bench.world.edges.push_back(
        {answered_us - 150000, 2});  // came while the frame was judged, with two before it lost
    bench.world.device.now_us += 50000;
    run(bench.world, bench.daemon, 400000);
    const Tally& tally = bench.daemon.tally();
    EXPECT_EQ(tally.triggers, 5u);
    EXPECT_EQ(tally.ok, 1u);
    EXPECT_EQ(tally.missed, 4u);
    EXPECT_TRUE(tally.adds_up());
    const Words events = bench.world.events();
    EXPECT_EQ(std::count(events.begin(), events.end(), "trigger_missed"), 4);
}

TEST(Daemon, AnswersErrorWhereNoFrameComes) {
    Bench bench(TriggerSource::line);
    run(bench.world, bench.daemon, 300000);
    for (std::uint32_t k = 0; k < 1000; ++k) bench.world.device.damaged.insert(k);
    bench.edge();
    run(bench.world, bench.daemon, 500000);
    EXPECT_TRUE(bench.world.busy());
    run(bench.world, bench.daemon, 200000);
    EXPECT_EQ(bench.daemon.tally().error, 1u);
    EXPECT_FALSE(bench.world.busy() || bench.world.valid() || bench.world.ok() || bench.world.not_ok());
    EXPECT_EQ(bench.world.heard(), "1E\n");
    EXPECT_NE(bench.world.printed[0].find("\"why\":\"no_frame\""), std::string::npos);
}

TEST(Daemon, TakesTheNextFrameForOneThatIsDamaged) {
    Bench bench(TriggerSource::line);
    run(bench.world, bench.daemon, 300000);
    bench.world.undecodable = 2;
    bench.edge();
    run(bench.world, bench.daemon, 300000);
    EXPECT_EQ(bench.daemon.tally().ok, 1u);
    EXPECT_EQ(bench.daemon.damaged_pictures(), 2u);
}

TEST(Daemon, AnswersErrorAtOnceWithoutACamera) {
    Bench bench(TriggerSource::line);
    run(bench.world, bench.daemon, 300000);
    bench.edge();
    bench.daemon.turn();
    bench.world.device.unplugged = true;
    run(bench.world, bench.daemon, 15000);
    EXPECT_EQ(bench.daemon.tally().error, 1u);
    EXPECT_FALSE(bench.world.ready());
    EXPECT_TRUE(bench.world.alarm());
    bench.edge();
    run(bench.world, bench.daemon, 15000);
    EXPECT_EQ(bench.daemon.tally().error, 2u);
    EXPECT_EQ(bench.world.events(), Words({"camera_lost", "ERROR", "ERROR"}));
    bench.world.device.unplugged = false;
    run(bench.world, bench.daemon, 400000);
    EXPECT_TRUE(bench.world.ready() && !bench.world.alarm());
    EXPECT_EQ(bench.world.events(), Words({"camera_back"}));
    bench.edge();
    run(bench.world, bench.daemon, 200000);
    EXPECT_EQ(bench.daemon.tally().ok, 1u);
}

TEST(Daemon, ObeysItsCommands) {
    Bench bench(TriggerSource::command);
    DaemonWorld& world = bench.world;
    run(world, bench.daemon, 300000);
    const auto ask = [&](const std::string& text) {
        world.say(text + "\r\n");
        run(world, bench.daemon, 10000);
        return world.heard();
    };
    EXPECT_EQ(ask("LAST?"), "ERR 40 no result yet\r\n");
    EXPECT_EQ(ask("JOBS?"), "OK 1 disc, 2 other\r\n");
    EXPECT_EQ(ask("#7 job?"), "#7 OK 1 disc\r\n");
    EXPECT_EQ(ask("JOB 3"), "ERR 20 no such job\r\n");
    EXPECT_EQ(ask("JOB other"), "OK 2 other\r\n");
    EXPECT_EQ(ask("JOB 1"), "OK 1 disc\r\n");
    EXPECT_EQ(ask("RDY?"), "OK 1\r\n");
    EXPECT_EQ(ask("VER?"), "OK fovead 0.1.0\r\n");
    EXPECT_EQ(ask("NONSENSE"), "ERR 11 no such command\r\n");
    EXPECT_EQ(ask(std::string(300, 'x')), "ERR 10 not a line of printable ASCII of at most 255 letters\r\n");
    EXPECT_EQ(ask("TRG"), "OK\r\n");
    EXPECT_EQ(ask("TRG"), "ERR 31 busy\r\n");
    EXPECT_EQ(ask("RDY?"), "OK 0\r\n");
    run(world, bench.daemon, 200000);
    EXPECT_EQ(world.heard(), "1P\n");
    EXPECT_EQ(ask("STAT?").substr(0, 42), "OK triggers 2 ok 1 ng 0 error 0 missed 1 u");
    EXPECT_EQ(ask("LAST?").substr(0, 43), "OK {\"v\":1,\"ev\":\"result\",\"seq\":1,\"t_mono_us\"");
    EXPECT_EQ(ask("STAT RESET"), "OK\r\n");
    EXPECT_EQ(ask("STAT?"), "OK triggers 0 ok 0 ng 0 error 0 missed 0 us 0 0 0\r\n");
    EXPECT_EQ(bench.daemon.last_number(), 2u) << "numbers go on";
    EXPECT_EQ(ask("TEACH cap"), "OK\r\n");
    run(world, bench.daemon, 100000);
    EXPECT_EQ(world.samples, Words({"cap"}));
    world.sample_fault = {"open", EACCES, Status::io_error};
    EXPECT_EQ(ask("TEACH cap"), "OK\r\n");
    run(world, bench.daemon, 100000);
    EXPECT_NE(
        world.printed.back().find("\"name\":\"cap\",\"reason\":\"Permission denied\",\"try\":\"this user"),
        std::string::npos)
        << world.printed.back();
    world.sample_fault = {"mkdir", ENOENT, Status::io_error};
    EXPECT_EQ(ask("TEACH cap"), "OK\r\n");
    run(world, bench.daemon, 100000);
    EXPECT_NE(world.printed.back().find("\"try\":\"the folder above that of [teach] is not there"),
              std::string::npos)
        << world.printed.back();
    world.device.unplugged = true;
    run(world, bench.daemon, 20000);
    EXPECT_EQ(ask("TEACH cap"), "ERR 30 not ready\r\n");
}

TEST(Daemon, KeepsNoSampleWithoutAFolder) {
    DaemonWorld world;
    DaemonOptions none = options(TriggerSource::command);
    none.samples = false;
    Daemon<DaemonWorld> daemon(world, none);
    ASSERT_TRUE(daemon.take_job(1));
    run(world, daemon, 100000);
    world.say("TEACH cap\n");
    run(world, daemon, 100000);
    EXPECT_EQ(world.heard(), "ERR 41 [teach] has no folder, and the job no taught = true\r\n");
    EXPECT_EQ(world.samples, Words());
}

TEST(Daemon, IsSilentWhereItIsToldTo) {
    DaemonWorld world;
    DaemonOptions silent = options(TriggerSource::command);
    silent.silent = true;
    Daemon<DaemonWorld> daemon(world, silent);
    ASSERT_TRUE(daemon.take_job(1));
    run(world, daemon, 300000);
    world.say("TRG\rJOB 2\rSTAT RESET\rJOB?\rNO\r");
    run(world, daemon, 200000);
    EXPECT_EQ(world.heard(), "OK 2 other\r\nERR 11 no such command\r\n1P\n");
    DaemonOptions deaf = options(TriggerSource::command);
    deaf.commands = false;
    Daemon<DaemonWorld> other(world, deaf);
    world.say("VER?\rTRG\r");
    run(world, other, 200000);
    EXPECT_EQ(world.heard(), "");
}

TEST(Daemon, AFloodOfCommandsDoesNotKeepItFromItsTriggers) {
    Bench bench(TriggerSource::line);
    run(bench.world, bench.daemon, 300000);
    Random random(5);
    for (int k = 0; k < 40; ++k) {
        std::string flood;
        for (int n = 0; n < 2000; ++n) flood += static_cast<char>(random.below(256));
        bench.world.say(flood);
        bench.edge();
        run(bench.world, bench.daemon, 200000);
    }
    EXPECT_EQ(bench.daemon.tally().ok, 40u);
    EXPECT_EQ(bench.daemon.job(), 1);
}

TEST(Daemon, ASerialLineThatIsStuckOrGoneMovesNoVerdict) {
    Bench bench(TriggerSource::line);
    run(bench.world, bench.daemon, 300000);
    bench.edge();
    run(bench.world, bench.daemon, 200000);
    const std::int64_t before_us = bench.daemon.tally().longest_us;
    bench.world.port.room = 0;
    for (int k = 0; k < 5; ++k) {
        bench.edge();
        run(bench.world, bench.daemon, 200000);
    }
    bench.world.port.pulled = true;
    for (int k = 0; k < 5; ++k) {
        bench.edge();
        run(bench.world, bench.daemon, 200000);
    }
    EXPECT_EQ(bench.daemon.tally().ok, 11u);
    EXPECT_LE(bench.daemon.tally().longest_us, before_us + 40000);
    bench.world.port.pulled = false;
    bench.world.port.room = 1 << 20;
    run(bench.world, bench.daemon, 1100000);
    // All whole, none twice.
    EXPECT_EQ(bench.world.heard(), "1P\n2P\n3P\n4P\n5P\n6P\n7P\n8P\n9P\n10P\n11P\n");
    Words events;
    for (const std::string& word : bench.world.events())
        if (word.rfind("serial", 0) == 0) events.push_back(word);
    EXPECT_EQ(events, Words({"serial_lost", "serial_back"}));
}

TEST(Daemon, TellsABadPictureApartFromABadPart) {
    Bench bench(TriggerSource::line);
    run(bench.world, bench.daemon, 300000);
    bench.world.quality_verdict = ImageVerdict::dark;
    for (int k = 0; k < 2; ++k) {
        bench.edge();
        run(bench.world, bench.daemon, 200000);
    }
    EXPECT_EQ(bench.daemon.tally().error, 2u);
    EXPECT_EQ(bench.daemon.tally().not_ok, 0u);
    EXPECT_TRUE(bench.world.alarm() && !bench.world.valid());
    bench.world.quality_verdict = ImageVerdict::fine;
    for (int k = 0; k < 5; ++k) {
        EXPECT_TRUE(bench.world.alarm());
        bench.edge();
        run(bench.world, bench.daemon, 200000);
    }
    EXPECT_EQ(bench.world.events(),
              Words({"ERROR", "image_quality", "ERROR", "OK", "OK", "OK", "OK", "OK", "image_quality_back"}));
    EXPECT_FALSE(bench.world.alarm());
}

TEST(Daemon, IsNotReadyWithoutTheLineOfItsTrigger) {
    Bench bench(TriggerSource::line);
    run(bench.world, bench.daemon, 300000);
    EXPECT_TRUE(bench.world.ready() && !bench.world.alarm());
    bench.world.trigger = Status::device_lost;
    run(bench.world, bench.daemon, 300000);
    EXPECT_TRUE(!bench.world.ready() && bench.world.alarm());
    EXPECT_EQ(bench.world.events(), Words({"trigger_lost"}));
}

TEST(Daemon, TellsThatPicturesOfFailuresCannotBeKept) {
    Bench bench(TriggerSource::line);
    run(bench.world, bench.daemon, 300000);
    bench.world.failure_events.push_back({Status::io_error, {"write", ENOSPC, Status::io_error, ""}});
    bench.world.failure_events.push_back({});
    run(bench.world, bench.daemon, 20000);
    ASSERT_EQ(bench.world.printed.size(), 2u);
    EXPECT_NE(bench.world.printed[0].find("the disk is full"), std::string::npos);
    EXPECT_EQ(bench.world.events(), Words({"failures_lost", "failures_kept"}));
}

TEST(Daemon, TellsOnceThatALineCannotBeSet) {
    Bench bench(TriggerSource::line);
    run(bench.world, bench.daemon, 300000);
    bench.world.wires[3].broken = true;
    for (int k = 0; k < 3; ++k) {
        bench.edge();
        run(bench.world, bench.daemon, 200000);
        EXPECT_FALSE(bench.world.valid());
    }
    EXPECT_EQ(bench.daemon.tally().ok, 3u);
    EXPECT_EQ(bench.world.events(), Words({"OK", "lines_lost", "OK", "OK"}));
    bench.world.wires[3].broken = false;
    bench.edge();
    run(bench.world, bench.daemon, 200000);
    EXPECT_EQ(bench.world.events(), Words({"lines_back", "OK"}));
}

TEST(Daemon, StopsInTheSafeState) {
    Bench bench(TriggerSource::line);
    run(bench.world, bench.daemon, 300000);
    bench.edge();
    bench.daemon.turn();
    bench.daemon.stop();
    EXPECT_EQ(bench.daemon.tally().error, 1u);
    for (const auto& wire : bench.world.wires) EXPECT_FALSE(wire.level);
    EXPECT_EQ(bench.world.heard(), "1E\n");
}

TEST(Daemon, EveryTriggerHasOneAnswerWhateverComes) {
    for (const std::uint64_t seed : {1u, 2u, 3u, 4u, 5u, 6u}) {
        Random random(seed);
        Bench bench(seed % 2 == 0 ? TriggerSource::line : TriggerSource::command,
                    {LineMode::pulse, 30000, seed == 3});
        DaemonWorld& world = bench.world;
        std::uint64_t edges = 0;
        for (int k = 0; k < 600; ++k) {
            switch (random.below(18)) {
                case 0: world.device.unplugged = !world.device.unplugged; break;
                case 1: world.device.fatal = true; break;
                case 2: world.device.silent = !world.device.silent; break;
                case 3: world.undecodable = 2; break;
                case 4: world.judging_us = random.below(100000); break;
                case 5: world.port.pulled = !world.port.pulled; break;
                case 6: world.port.room = static_cast<int>(random.below(50)); break;
                case 7:
                    world.quality_verdict = random.below(2) == 0 ? ImageVerdict::fine : ImageVerdict::dark;
                    break;
                case 8: world.device.scene = random.below(2) == 0 ? &world.good : &world.bad; break;
                case 10:
                case 11:
                case 12:
                    world.device.unplugged = world.device.silent = world.port.pulled = false;
                    world.quality_verdict = ImageVerdict::fine;
                    world.judging_us = world.undecodable = 0;
                    break;
                case 9: world.say("JOB 2\rJOB 1\rJOB 9\rSTAT?\r"); break;
                default:
                    if (seed % 2 == 0) {
                        const std::uint32_t lost = random.below(8) == 0 ? 3 : 0;
                        world.edges.push_back({world.device.now_us, lost});
                        edges += 1 + lost;
                    } else {
                        world.say("TRG\r");
                    }
            }
            run(world, bench.daemon, random.below(600000));
            EXPECT_FALSE(world.ok() && world.not_ok());
            EXPECT_TRUE(!world.valid() || world.ok() != world.not_ok());
            EXPECT_FALSE(world.ready() && world.busy());
            EXPECT_TRUE(bench.daemon.tally().adds_up());
        }
        world.device.unplugged = world.device.silent = false;
        run(world, bench.daemon, 10000000);
        EXPECT_FALSE(bench.daemon.busy());
        if (seed % 2 == 0) {
            EXPECT_EQ(bench.daemon.tally().triggers, edges);
        }
        EXPECT_GT(bench.daemon.tally().ok + bench.daemon.tally().not_ok, 20u);
        EXPECT_GT(bench.daemon.tally().error, 20u);
    }
}

}  // namespace
}  // namespace fovea::apps
