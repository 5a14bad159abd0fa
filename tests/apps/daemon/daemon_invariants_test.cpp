// SPDX-License-Identifier: MIT
//
// What must hold of the daemon whatever is wrong around it: that its invariants are seen to break, that it
// waits without spinning (I5), and that no output moves a verdict (I7).
#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include <fovea/base/random.hpp>

#include <daemon/fovead.hpp>

#include "support/daemon_invariants.hpp"
#include "support/daemon_world.hpp"
#include "support/temporary_folder.hpp"
#include "support/timed_kernel.hpp"

namespace fovea::apps {
namespace {

using test::DaemonInvariants;
using test::DaemonWorld;
using test::run;

DaemonOptions options(TriggerSource source) {
    DaemonOptions made;
    made.source = source;
    made.serial_results = true;
    EXPECT_EQ(made.serial_template.read(letters_of("{seq}{pass}\\n")), Status::ok);
    return made;
}

void expect_no_complaint(DaemonWorld& world, const Daemon<DaemonWorld>& daemon) {
    world.invariants.end(world.device.now_us, true, daemon.busy(), world.device.open_handles,
                         world.camera().streaming() ? 1 : 0);
    EXPECT_EQ(world.invariants.complaints, std::vector<std::string>());
}

// ---- The alarm rings ----------------------------------------------------------------------

std::string result(int number, const std::string& verdict, int frame, std::int64_t now_us) {
    return "{\"v\":1,\"ev\":\"result\",\"seq\":" + std::to_string(number) +
           ",\"t_mono_us\":" + std::to_string(now_us) + ",\"frame\":{\"seq\":" + std::to_string(frame) +
           ",\"age_us\":3,\"missed\":0},\"verdict\":\"" + verdict +
           "\",\"us\":{\"answer\":100000,\"judge\":5}}";
}

/// The complaint about what is done after a good answer.
std::string seen(const std::function<void(DaemonInvariants&)>& fault, bool to_the_end = false) {
    DaemonInvariants invariants;
    invariants.take_edges(1);
    invariants.take_frame(7, 990000, 40000, true);
    invariants.take_said(result(1, "OK", 7, 1000000));
    for (const auto line : {DaemonInvariants::ok, DaemonInvariants::valid}) invariants.take_level(line, true);
    EXPECT_EQ(invariants.complaints, std::vector<std::string>());
    fault(invariants);
    if (to_the_end) invariants.end(20000000, true, false, 1, 1);
    return invariants.complaints.empty() ? "nothing" : invariants.complaints[0];
}

TEST(DaemonInvariants, SeeWhatMustNeverBe) {
    EXPECT_EQ(seen([](auto&) {}, true), "nothing");
    EXPECT_EQ(seen([](auto& told) { told.take_said("{\"ev\":\"trigger_missed\",\"seq\":1}"); }),
              "I1: trigger 1 has two answers");
    EXPECT_EQ(seen([](auto& told) { told.take_said("{\"ev\":\"trigger_missed\",\"seq\":3}"); }, true),
              "I1: a trigger has no answer");
    EXPECT_EQ(seen([](auto& told) { told.take_edges(1); }, true), "I1: 2 edges, 1 answers");
    const auto judge = [](std::uint32_t frame, std::int64_t time_us, bool whole, int told_frame, auto& told) {
        told.take_frame(frame, time_us, 40000, whole);
        told.take_said(result(2, "NG", told_frame, 1200000));
    };
    EXPECT_EQ(seen([&](auto& told) { judge(9, 1190000, false, 9, told); }),
              "I2: a verdict of a frame that is not whole");
    EXPECT_EQ(seen([&](auto& told) { judge(9, 1190000, true, 8, told); }), "I2: a verdict of another frame");
    EXPECT_EQ(seen([&](auto& told) { judge(9, 1130000, true, 9, told); }),
              "I2: a verdict of a frame that began before its trigger");
    EXPECT_EQ(seen([&](auto& told) { judge(7, 990000, true, 7, told); }), "I2: a second verdict of a frame");
    const std::string lost = "{\"ev\":\"camera_lost\",\"reason\":\"No such device\"}";
    EXPECT_EQ(seen([&](auto& told) {
                  told.take_said(lost);
                  judge(9, 1190000, true, 9, told);
              }),
              "I2: a verdict while camera_lost");
    EXPECT_EQ(seen([](auto& told) { told.take_level(DaemonInvariants::not_ok, true); }),
              "I3: OK or NG changed while VALID was active");
    EXPECT_EQ(seen([](auto& told) {
                  told.take_level(DaemonInvariants::valid, false);
                  told.take_level(DaemonInvariants::not_ok, true);
              }),
              "I3: OK and NG together");
    EXPECT_EQ(seen([](auto& told) { told.end(2000000, true, false, 2, 1); }),
              "I4: 2 handles of the camera are open");
    EXPECT_EQ(seen(
                  [](auto& told) {
                      for (int k = 0; k < 200; ++k) told.take_idle_turn(1000000 + k * 49000, 1, 1);
                  },
                  true),
              "nothing");
    EXPECT_EQ(seen([](auto& told) {
                  for (int k = 0; k < 200; ++k) told.take_idle_turn(1000000 + k * 49000, 2, 1);
                  told.end_wait(1000000 + 200 * 49000);
              }),
              "I5: 400 system calls in 9800 ms of waiting");
    EXPECT_EQ(seen([&](auto& told) { told.take_said(lost), told.take_said(lost); }),
              "I6: camera_lost again before its end");
    EXPECT_EQ(seen([](auto& told) { told.take_said("{\"ev\":\"serial_back\"}"); }),
              "I6: serial_back of no trouble");
    EXPECT_EQ(seen([](auto& told) { told.take_said("{\"ev\":\"serial_lost\",\"reason\":\"ok\"}"); }),
              "I6: serial_lost without a reason");
}

// ---- I5 -----------------------------------------------------------------------------------

TEST(DaemonWaits, WithoutSpinningForWhateverIsAway) {
    const std::function<void(DaemonWorld&, bool)> faults[] = {
        [](DaemonWorld& world, bool on) { world.device.unplugged = on; },
        [](DaemonWorld& world, bool on) { world.device.silent = on; },
        [](DaemonWorld& world, bool on) { world.port.pulled = on; },
        [](DaemonWorld& world, bool on) { world.port.room = on ? 0 : 1 << 20; },
        [](DaemonWorld& world, bool on) { world.wires[3].broken = on; },
    };
    for (const auto& fault : faults) {
        DaemonWorld world;
        world.device.call_us = 10;
        Daemon<DaemonWorld> daemon(world, options(TriggerSource::line));
        ASSERT_TRUE(daemon.take_job(1));
        const auto trigger = [&] {
            world.edges.push_back({world.device.now_us, 0});
            run(world, daemon, 300000);
        };
        run(world, daemon, 300000);
        trigger();
        fault(world, true);
        trigger();
        run(world, daemon, 20000000);
        fault(world, false);
        run(world, daemon, 6000000);
        trigger();
        EXPECT_GE(daemon.tally().ok, 2u);
        expect_no_complaint(world, daemon);
    }
}

// ---- I7 -----------------------------------------------------------------------------------

/// From the edge to the answer, 99 of 100 of so many triggers, at the same moments whatever is wrong. Every
/// system call takes time.
std::int64_t latency_us(const std::function<void(DaemonWorld&, int)>& fault) {
    constexpr int triggers = 200;
    DaemonWorld world;
    world.device.call_us = 50;
    // Judging takes no time of this clock, so none is judged: the answer is ERROR, on the same way.
    world.quality_verdict = ImageVerdict::dark;
    Daemon<DaemonWorld> daemon(world, options(TriggerSource::line));
    EXPECT_TRUE(daemon.take_job(1));
    run(world, daemon, 300000);
    Random random(7);
    std::int64_t at_us = 2000000;
    for (int k = 0; k < triggers; ++k) {
        at_us += 100000 + random.below(40000);
        fault(world, k);
        run(world, daemon, at_us - world.device.now_us);
        world.edges.push_back({at_us, 0});
    }
    run(world, daemon, 300000);
    EXPECT_EQ(daemon.tally().error, static_cast<std::uint64_t>(triggers));
    expect_no_complaint(world, daemon);
    std::vector<std::int64_t> times;
    for (const std::string& line : world.printed)
        if (const std::size_t place = line.find("\"us\":{\"answer\":"); place != std::string::npos)
            times.push_back(std::stoll(line.substr(place + 15)));
    EXPECT_EQ(times.size(), static_cast<std::size_t>(triggers));
    std::sort(times.begin(), times.end());
    return times[times.size() * 99 / 100];
}

/// A disk on which writing hangs until a test lets it go on.
class HangingKernel : public linux_port::Kernel {
public:
    explicit HangingKernel(std::atomic<bool>& hangs) : hangs_(&hangs) {}
    int sync(int file) {
        while (*hangs_) static_cast<void>(Kernel::poll({nullptr, 0}, 1000));
        return Kernel::sync(file);
    }

private:
    std::atomic<bool>* hangs_;
};

TEST(DaemonLatency, IsMovedByNoOutput) {
    const std::int64_t well_us = latency_us([](DaemonWorld&, int) {});
    // One interval of 40 ms passes at least, and two at most; calls and a part of a frame come on top.
    EXPECT_GT(well_us, 40000);
    EXPECT_LT(well_us, 100000);
    const auto moved_by = [&](const std::function<void(DaemonWorld&, int)>& fault) {
        const std::int64_t us = latency_us(fault);
        return (us - well_us) * 100 / well_us;
    };
    // What waits is seen: calls of 3 ms, of which a turn makes some ten.
    EXPECT_GT(moved_by([](DaemonWorld& world, int) { world.device.call_us = 3000; }), 5);
    EXPECT_LE(moved_by([](DaemonWorld& world, int) { world.port.pulled = true; }), 5)
        << "F13: the port is gone";
    EXPECT_LE(moved_by([](DaemonWorld& world, int k) { world.port.pulled = k % 20 < 10; }), 5)
        << "F13: and back";
    EXPECT_LE(moved_by([](DaemonWorld& world, int) { world.port.room = 0; }), 5) << "F14: nobody reads it";
    EXPECT_LE(moved_by([](DaemonWorld& world, int) { world.port.room = 3; }), 5) << "F14: or slowly";
    Random random(15);
    EXPECT_LE(moved_by([&](DaemonWorld& world, int) {
                  std::string noise;
                  for (int n = 0; n < 300; ++n) noise += static_cast<char>(random.below(256));
                  world.say(noise);
              }),
              5)
        << "F15: hostile bytes";
    EXPECT_LE(moved_by([](DaemonWorld& world, int k) {
                  world.failure_events.push_back(
                      {k % 2 == 0 ? Status::io_error : Status::ok, {"write", ENOSPC, Status::io_error, ""}});
              }),
              5)
        << "F18: the disk is full";

    // A ring as it is, with its thread and a disk that hangs: who waited for it would wait for ever.
    const test::TemporaryFolder folder;
    std::atomic<bool> hangs{true};
    FailureRing<HangingKernel> ring{HangingKernel(hangs)};
    std::vector<std::uint8_t> memory(static_cast<std::size_t>(ring.memory_bytes(4, {160, 120})));
    ASSERT_EQ(ring.start(folder.path(), {}, 4, {160, 120},
                         {memory.data(), static_cast<std::ptrdiff_t>(memory.size())}),
              Status::ok);
    const std::string text = "{}";
    EXPECT_LE(moved_by([&](DaemonWorld& world, int) {
                  world.on_failure = [&](ImageView<const Gray8> picture) {
                      static_cast<void>(ring.offer(picture, {text.data(), 2}));
                  };
              }),
              5)
        << "F19: the disk hangs";
    EXPECT_GT(ring.dropped(), 150u);
    hangs = false;
    EXPECT_EQ(ring.stop(10000000), Status::ok);
}

// ---- Many frames --------------------------------------------------------------------------

struct Quiet {
    void print(const std::string&) {}
    void complain(const std::string& text) { complaints += text; }
    std::string complaints;
};

TEST(DaemonProgram, JudgesAThousandFramesOfAReplay) {
    const test::TemporaryFolder folder;
    const auto write = [&](const std::string& name, const std::vector<std::uint8_t>& bytes) {
        const int file =
            ::open((folder.path() + std::string("/") + name).c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644);
        ASSERT_EQ(::write(file, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
        ::close(file);
    };
    const auto picture = [](bool hole) {
        const std::vector<std::uint8_t> scene = test::disc_scene(80, 60, 20, hole);
        std::vector<std::uint8_t> bytes = DaemonWorld::bytes("P5\n80 60\n255\n");
        bytes.insert(bytes.end(), scene.begin(), scene.end());
        return bytes;
    };
    ASSERT_EQ(::mkdir((folder.path() + std::string("/pictures")).c_str(), 0755), 0);
    ASSERT_EQ(::mkdir((folder.path() + std::string("/jobs")).c_str(), 0755), 0);
    write("pictures/1.pgm", picture(true));
    write("pictures/2.pgm", picture(false));
    write("jobs/disc.toml", DaemonWorld::bytes(test::disc_recipe()));
    write("fovead.toml", DaemonWorld::bytes("format = 1\n[camera]\nreplay = \"" + std::string(folder.path()) +
                                            "/pictures\"\nwidth = 80\nheight = 60\nrate_per_s = 10000\n"
                                            "every_frame = true\n[failures]\nfolder = \"" +
                                            std::string(folder.path()) + "/failures\"\npictures = 3\n"));

    // Its standard output is a file here.
    const std::string said = folder.path() + std::string("/said");
    const int kept = ::dup(1);
    const int file = ::open(said.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    ASSERT_EQ(::dup2(file, 1), 1);
    test::TestTime time;
    int turns = 0;
    Quiet io;
    const int status = fovead(
        {"--config", folder.path() + std::string("/fovead.toml")}, io, test::TimedKernel(time), {}, -1,
        [&] {
            DaemonSignals signals;
            signals.end = ++turns == 1100;
            return signals;
        },
        "test");
    ::dup2(kept, 1);
    ::close(kept);
    ::close(file);
    EXPECT_EQ(status, daemon_ok) << io.complaints;
    std::istringstream lines(folder.read("said"));
    int judged[2] = {};
    for (std::string line; std::getline(lines, line);)
        for (const int good : {0, 1})
            judged[good] +=
                line.find(good == 1 ? "\"verdict\":\"OK\"" : "\"verdict\":\"NG\"") != std::string::npos;
    EXPECT_GE(judged[0] + judged[1], 1000);
    EXPECT_GE(judged[0], 500);
}

}  // namespace
}  // namespace fovea::apps
