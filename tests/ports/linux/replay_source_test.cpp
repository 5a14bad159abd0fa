// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include <fovea/linux/replay_source.hpp>

#include <daemon/camera_keeper.hpp>

#include "support/failing_system.hpp"
#include "support/temporary_folder.hpp"
#include "support/timed_kernel.hpp"

namespace fovea::linux_port {
namespace {

using hal::PixelFormat;
using test::TemporaryFolder;
using System = test::FailingSystem<test::TimedKernel>;
using Source = ReplaySource<System>;

/// A picture of 2 x 2 pixels, all of one letter.
std::string picture(char letter) { return "P5 2 2 255\n" + std::string(4, letter); }

struct Bench {
    test::TestTime time;
    test::SystemScript script;
    TemporaryFolder folder;
    std::vector<std::uint8_t> file = std::vector<std::uint8_t>(600);
    std::vector<std::uint8_t> pixels = std::vector<std::uint8_t>(64);
    Source source{System(script, test::TimedKernel(time))};
    Source::Frame frame;

    ~Bench() { frame.give_back(); }

    ReplayMemory memory() {
        return {{file.data(), static_cast<std::ptrdiff_t>(file.size())},
                {pixels.data(), static_cast<std::ptrdiff_t>(pixels.size())}};
    }
    Status open(const std::string& path, const ReplayOptions& options = {}) {
        frame.give_back();
        if (const Status s = source.open(path.c_str(), options, memory()); s != Status::ok) return s;
        return source.start();
    }
    /// The letter of a frame, or what there is instead of one.
    std::string said(Status status) {
        if (status != Status::ok) return describe(status);
        return std::string(1, static_cast<char>(frame.info().planes[0].bytes[0]));
    }
    std::string next(std::int64_t patience_us = 0) { return said(source.next(patience_us, frame)); }
    std::string latest(std::int64_t patience_us = 0) {
        return said(source.latest(std::int64_t{1} << 40, patience_us, frame));
    }
    std::string after(std::int64_t moment_us, std::int64_t patience_us) {
        return said(source.after(moment_us, patience_us, frame));
    }
};

const std::string nobody = describe(Status::no_signal);
const std::string nothing = describe(Status::timeout);

TEST(ReplaySource, LendsAPictureOnceOrAgainAndAgain) {
    Bench bench;
    bench.folder.write("a.pgm", picture('a'));
    ASSERT_EQ(bench.open(bench.folder.file("a.pgm")), Status::ok);
    EXPECT_EQ(bench.next(), "a");
    EXPECT_EQ(bench.frame.info().format, PixelFormat::gray8);
    EXPECT_EQ(bench.frame.info().size, (Size{2, 2}));
    EXPECT_EQ(bench.frame.info().planes[0].stride_bytes, 2);
    EXPECT_EQ(bench.frame.info().sequence, 0u);
    EXPECT_EQ(bench.frame.info().time_us, bench.time.now_us);
    for (int k = 0; k < 3; ++k) EXPECT_EQ(bench.next(), nobody);
    EXPECT_EQ(bench.next(1000000), nobody);
    ReplayOptions again;
    again.end = ReplayEnd::repeat;
    ASSERT_EQ(bench.open(bench.folder.file("a.pgm"), again), Status::ok);
    for (std::uint32_t k = 0; k < 5; ++k) {
        EXPECT_EQ(bench.next(), "a");
        EXPECT_EQ(bench.frame.info().sequence, k);
    }
}

TEST(ReplaySource, TakesAFolderInTheOrderOfItsNames) {
    Bench bench;
    for (const char* name : {"9.pgm", "10.PGM", "B.ppm", "a.pgm", "c.json", ".d.pgm", "e.pgm.new", "pgm"})
        bench.folder.write(name, picture(name[0]));
    ASSERT_EQ(bench.open(bench.folder.path()), Status::ok);
    for (const char* const expected : {"1", "9", "B", "a"}) EXPECT_EQ(bench.next(), expected);
    EXPECT_EQ(bench.next(), nobody);
    EXPECT_EQ(bench.source.counters().lent, 4u);
    // What comes later is not waited for.
    bench.folder.write("z.pgm", picture('z'));
    ReplayOptions again;
    again.end = ReplayEnd::repeat;
    ASSERT_EQ(bench.open(bench.folder.path(), again), Status::ok);
    for (const char* const expected : {"1", "9", "B", "a", "z", "1", "9"}) EXPECT_EQ(bench.next(), expected);
}

TEST(ReplaySource, CountsADamagedPictureAndTellsWhatIsWrong) {
    Bench bench;
    bench.folder.write("1.pgm", picture('1'));
    bench.folder.write("2.pgm", picture('2').substr(0, 13));
    bench.folder.write("3.pgm", "P5 3 2 255\n333333");
    bench.folder.write("4.pgm", std::string(601, 'P'));
    bench.folder.write("5.png", "");
    std::filesystem::create_directory(bench.folder.file("6.pgm"));
    ASSERT_EQ(::mkfifo(bench.folder.file("7.pgm").c_str(), 0600), 0);
    bench.folder.write("8.pgm", picture('8'));
    ASSERT_EQ(bench.open(bench.folder.path()), Status::ok);
    EXPECT_EQ(bench.next(), "1");
    const Status reasons[] = {Status::truncated,   Status::size_mismatch, Status::buffer_too_small,
                              Status::unsupported, Status::unsupported,   Status::unsupported};
    for (const Status reason : reasons) {
        EXPECT_EQ(bench.next(), nothing);
        EXPECT_EQ(bench.source.fault().status, reason);
    }
    EXPECT_EQ(bench.source.counters().damaged, 6u);
    EXPECT_EQ(bench.next(), "8");
    EXPECT_EQ(bench.frame.info().sequence, 7u);
    // With patience, all in one call.
    ASSERT_EQ(bench.open(bench.folder.path()), Status::ok);
    EXPECT_EQ(bench.next(1), "1");
    EXPECT_EQ(bench.next(1), "8");
    // A round without a whole picture is the last.
    for (const char* name : {"1.pgm", "8.pgm"}) bench.folder.remove(name);
    ReplayOptions again;
    again.end = ReplayEnd::repeat;
    again.size = {2, 2};
    ASSERT_EQ(bench.open(bench.folder.path(), again), Status::ok);
    EXPECT_EQ(bench.next(1000000), nobody);
}

TEST(ReplaySource, LendsColourIfAskedTo) {
    Bench bench;
    bench.folder.write("a.ppm", "P6 1 1 255\nRGB");
    ReplayOptions options;
    options.pictures = PixelFormat::rgb24;
    ASSERT_EQ(bench.open(bench.folder.path(), options), Status::ok);
    EXPECT_EQ(bench.next(), "R");
    EXPECT_EQ(bench.frame.info().format, PixelFormat::rgb24);
    EXPECT_EQ(bench.frame.info().planes[0].bytes.size(), 3);
}

TEST(ReplaySource, WaitsInAWatchedFolderForWholeFiles) {
    Bench bench;
    ReplayOptions watch;
    watch.end = ReplayEnd::watch;
    ASSERT_EQ(bench.open(bench.folder.path(), watch), Status::ok);
    EXPECT_EQ(bench.source.interval_us(), std::numeric_limits<std::int32_t>::max());
    EXPECT_EQ(bench.next(), nothing);
    // A file that grows for 2 s is taken when it has not grown for a while.
    const std::int64_t start_us = bench.time.now_us;
    for (int k = 0; k < 20; ++k)
        bench.time.plan.emplace(start_us + 100000 * k, [&bench, k] {
            bench.folder.write("1.pgm", "P5 2 2 255\n" + std::string(k < 19 ? 3 : 4, '1') +
                                            std::string(static_cast<std::size_t>(k), '1'));
        });
    EXPECT_EQ(bench.next(10000000), "1");
    EXPECT_GE(bench.time.now_us, start_us + 1900000 + 250000);
    EXPECT_LE(bench.time.now_us, start_us + 1900000 + 800000);
    EXPECT_EQ(bench.source.counters().damaged, 0u);
    // Of those that are there with one behind them, each is taken at once; the last is looked at twice.
    bench.time.now_us += 1000000;
    for (const char* name : {"2.pgm", "3.pgm", "4.pgm"}) bench.folder.write(name, picture(name[0]));
    EXPECT_EQ(bench.next(), "2");
    EXPECT_EQ(bench.next(), "3");
    EXPECT_EQ(bench.next(), nothing);
    EXPECT_EQ(bench.next(1000000), "4");
    // One that is not whole is waited for even so, and given up when it does not change.
    bench.time.now_us += 1000000;
    bench.folder.write("5.pgm", picture('5').substr(0, 12));
    bench.folder.write("6.pgm", picture('6'));
    EXPECT_EQ(bench.next(), nothing);
    EXPECT_EQ(bench.source.counters().damaged, 0u);
    EXPECT_EQ(bench.next(2000000), "6");
    EXPECT_EQ(bench.source.counters().damaged, 1u);
    // Names in front are late.
    bench.folder.write("0.pgm", picture('0'));
    EXPECT_EQ(bench.next(2000000), nothing);
}

TEST(ReplaySource, LooksSeldomWhileNothingComes) {
    Bench bench;
    ReplayOptions watch;
    watch.end = ReplayEnd::watch;
    ASSERT_EQ(bench.open(bench.folder.path(), watch), Status::ok);
    const int before = bench.script.calls;
    EXPECT_EQ(bench.next(10000000), nothing);
    EXPECT_LE(bench.script.calls - before, 200) << "in ten seconds";
}

TEST(ReplaySource, GoesOnInAFolderThatWasGone) {
    Bench bench;
    ReplayOptions watch;
    watch.end = ReplayEnd::watch;
    const std::string folder = bench.folder.file("drop");
    std::filesystem::create_directory(folder);
    bench.folder.write("drop/1.pgm", picture('1'));
    ASSERT_EQ(bench.open(folder, watch), Status::ok);
    EXPECT_EQ(bench.next(1000000), "1");
    std::filesystem::rename(folder, folder + "2");
    bench.time.now_us += 1000000;
    EXPECT_EQ(bench.next(), describe(Status::device_lost));
    EXPECT_EQ(bench.source.open(folder.c_str(), watch, bench.memory()), Status::not_found);
    std::filesystem::rename(folder + "2", folder);
    bench.folder.write("drop/2.pgm", picture('2'));
    ASSERT_EQ(bench.open(folder, watch), Status::ok);
    EXPECT_EQ(bench.next(1000000), "2");
}

/// Ten pictures, a to j.
void write_ten(const TemporaryFolder& folder) {
    for (char letter = 'a'; letter <= 'j'; ++letter)
        folder.write(std::string(1, letter) + ".pgm", picture(letter));
}

TEST(ReplaySource, LendsEveryPictureOfItsRateAndPassesOverNone) {
    Bench bench;
    write_ten(bench.folder);
    ReplayOptions options;
    options.interval_us = 100000;
    ASSERT_EQ(bench.open(bench.folder.path(), options), Status::ok);
    const std::int64_t start_us = bench.time.now_us;
    EXPECT_EQ(bench.next(), "a");
    EXPECT_EQ(bench.next(), nothing);
    EXPECT_EQ(bench.next(99999), nothing);
    EXPECT_EQ(bench.next(1), "b");
    EXPECT_EQ(bench.time.now_us, start_us + 100000);
    bench.time.now_us += 350000;
    for (const char* const expected : {"c", "d", "e"}) EXPECT_EQ(bench.next(), expected);
    EXPECT_EQ(bench.frame.info().time_us, start_us + 400000);
    EXPECT_EQ(bench.next(), nothing);
    EXPECT_EQ(bench.next(50000), "f");
    EXPECT_EQ(bench.source.counters().passed_over, 0u);
}

TEST(ReplaySource, PassesOverWhatIsDueForTheLatest) {
    Bench bench;
    write_ten(bench.folder);
    ReplayOptions options;
    options.interval_us = 100000;
    ASSERT_EQ(bench.open(bench.folder.path(), options), Status::ok);
    EXPECT_EQ(bench.latest(), "a");
    EXPECT_EQ(bench.latest(), nothing);
    bench.time.now_us += 350000;
    EXPECT_EQ(bench.latest(), "d");
    EXPECT_EQ(bench.frame.info().sequence, 3u);
    EXPECT_EQ(bench.source.counters().passed_over, 2u);
    // It is 50 ms old; one that may not be so old is the next.
    bench.time.now_us += 100000;
    EXPECT_EQ(bench.said(bench.source.latest(10000, 100000, bench.frame)), "f");
    EXPECT_EQ(bench.source.counters().passed_over, 3u);
    EXPECT_EQ(bench.after(bench.time.now_us + 150000, 1000000), "h");
    bench.time.now_us += 1000000;
    EXPECT_EQ(bench.after(bench.time.now_us - 950000, 0), "i");
    // While there is no more, nothing becomes due.
    EXPECT_EQ(bench.next(), "j");
    EXPECT_EQ(bench.next(500000), nobody);
}

TEST(ReplaySource, KeepsItsRateAfterAPause) {
    Bench bench;
    ReplayOptions options;
    options.interval_us = 100000;
    options.end = ReplayEnd::watch;
    ASSERT_EQ(bench.open(bench.folder.path(), options), Status::ok);
    EXPECT_EQ(bench.next(1000000), nothing);
    bench.time.now_us += 1000000;
    EXPECT_EQ(bench.next(), nothing);
    write_ten(bench.folder);
    EXPECT_EQ(bench.next(400000), "a");
    EXPECT_EQ(bench.next(), nothing);
    EXPECT_EQ(bench.next(100000), "b");
    bench.time.now_us += 100000;
    EXPECT_EQ(bench.next(), "c");
    EXPECT_EQ(bench.next(), nothing);
}

TEST(ReplaySource, TakesAtItsOwnTimeWhatHasNoRate) {
    Bench bench;
    write_ten(bench.folder);
    ASSERT_EQ(bench.open(bench.folder.path()), Status::ok);
    EXPECT_EQ(bench.latest(), "a");
    bench.time.now_us += 1000000;
    EXPECT_EQ(bench.latest(), "b");
    EXPECT_EQ(bench.after(bench.time.now_us - 500000, 0), "c");
    const std::int64_t moment_us = bench.time.now_us + 70000;
    EXPECT_EQ(bench.after(moment_us, 1000), nothing);
    EXPECT_EQ(bench.after(moment_us, 1000000), "d");
    EXPECT_EQ(bench.time.now_us, moment_us);
}

/// A FIFO and its writer.
struct PipeBench : Bench {
    int writer = -1;

    PipeBench() { EXPECT_EQ(::mkfifo(folder.file("fifo").c_str(), 0600), 0); }
    ~PipeBench() { stop_writing(); }
    std::string path() { return folder.file("fifo"); }
    void begin_writing() { writer = ::open(path().c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC); }
    void write(const std::string& bytes) {
        ASSERT_EQ(::write(writer, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
    }
    void stop_writing() {
        if (writer >= 0) ::close(writer);
        writer = -1;
    }
};

TEST(ReplaySource, ReadsPicturesFromAFifo) {
    PipeBench bench;
    ASSERT_EQ(bench.open(bench.path()), Status::ok);
    EXPECT_EQ(bench.next(), nobody);
    EXPECT_EQ(bench.next(1000000), nobody) << "nobody writes";
    bench.begin_writing();
    EXPECT_EQ(bench.next(), nothing) << "somebody is there";
    bench.write(picture('a') + picture('b') + picture('c').substr(0, 8));
    EXPECT_EQ(bench.next(), "a");
    EXPECT_EQ(bench.next(), "b");
    EXPECT_EQ(bench.next(), nothing);
    bench.time.plan.emplace(bench.time.now_us + 5000, [&] { bench.write(picture('c').substr(8)); });
    EXPECT_EQ(bench.next(1000000), "c");
    EXPECT_EQ(bench.frame.info().sequence, 2u);
}

TEST(ReplaySource, OutlivesTheWritersOfAFifo) {
    PipeBench bench;
    ASSERT_EQ(bench.open(bench.path()), Status::ok);
    for (int round = 0; round < 3; ++round) {
        bench.begin_writing();
        bench.write(picture('a') + picture('b').substr(0, 12));
        bench.stop_writing();
        EXPECT_EQ(bench.next(), "a");
        EXPECT_EQ(bench.next(), nothing);
        EXPECT_EQ(bench.source.fault().status, Status::truncated);
        EXPECT_EQ(bench.source.counters().damaged, static_cast<std::uint64_t>(round + 1));
        const int polls = bench.time.polls;
        EXPECT_EQ(bench.next(1000000), nobody);
        EXPECT_LE(bench.time.polls - polls, 3) << "waits, instead of asking again and again";
        // One that comes and goes without a word.
        bench.begin_writing();
        bench.stop_writing();
        EXPECT_EQ(bench.next(1000000), nobody);
        EXPECT_LE(bench.time.polls - polls, 6);
    }
    EXPECT_EQ(bench.script.open_files.size(), 1u);
    bench.time.plan.emplace(bench.time.now_us + 5000, [&] {
        bench.begin_writing();
        bench.write(picture('z'));
    });
    EXPECT_EQ(bench.next(1000000), "z");
}

TEST(ReplaySource, PassesOverWhatIsInThePipeForTheLatest) {
    PipeBench bench;
    ASSERT_EQ(bench.open(bench.path()), Status::ok);
    bench.begin_writing();
    EXPECT_EQ(bench.latest(), nothing);
    bench.time.now_us += 10000;
    bench.write(picture('a') + picture('b') + picture('c') + picture('d').substr(0, 12));
    EXPECT_EQ(bench.latest(), "c");
    EXPECT_EQ(bench.frame.info().time_us, bench.time.now_us - 10000) << "when the pipe was empty last";
    EXPECT_EQ(bench.source.counters().passed_over, 2u);
    bench.write(picture('d').substr(12));
    EXPECT_EQ(bench.latest(), "d");
    // What began before the moment is not taken after it, even if it ends later.
    bench.time.now_us += 10000;
    bench.write(picture('e') + picture('f').substr(0, 12));
    const std::int64_t moment_us = bench.time.now_us;
    bench.time.plan.emplace(moment_us + 5000, [&] { bench.write(picture('f').substr(12)); });
    bench.time.plan.emplace(moment_us + 8000, [&] { bench.write(picture('g')); });
    EXPECT_EQ(bench.after(moment_us, 1000000), "g");
    EXPECT_GE(bench.frame.info().time_us, moment_us);
}

TEST(ReplaySource, ReadsRawFramesOfAFifo) {
    PipeBench bench;
    ReplayOptions options;
    options.stream = luma_of_yuv420({2, 2});
    ASSERT_EQ(bench.open(bench.path(), options), Status::ok);
    bench.begin_writing();
    bench.write("aaaauvbbbbuvcccc");
    EXPECT_EQ(bench.next(), "a");
    EXPECT_EQ(bench.frame.info().format, PixelFormat::gray8);
    EXPECT_EQ(bench.next(), "b");
    EXPECT_EQ(bench.next(), "c") << "what is passed over is not waited for";
    options.stream = {PixelFormat::nv12, {2, 2}, 0};
    bench.stop_writing();
    ASSERT_EQ(bench.open(bench.path(), options), Status::ok);
    bench.begin_writing();
    bench.write("aaaauvbbbbwx");
    EXPECT_EQ(bench.next(), "a");
    EXPECT_EQ(bench.next(), "b");
    EXPECT_EQ(bench.frame.info().planes[1].bytes[0], 'w');
}

TEST(ReplaySource, ReadsAFileOfRawFramesAtItsRate) {
    Bench bench;
    bench.folder.write("frames", "aaaabbbbccccdddd!");
    ReplayOptions options;
    options.stream = {PixelFormat::gray8, {2, 2}, 0};
    options.interval_us = 1000;
    ASSERT_EQ(bench.open(bench.folder.file("frames"), options), Status::ok);
    EXPECT_EQ(bench.next(), "a");
    bench.time.now_us += 2000;
    EXPECT_EQ(bench.latest(), "c");
    EXPECT_EQ(bench.next(1000), "d");
    EXPECT_EQ(bench.next(100000), nobody);
    EXPECT_EQ(bench.source.counters().damaged, 1u) << "the rest of a frame";
    options.end = ReplayEnd::repeat;
    ASSERT_EQ(bench.open(bench.folder.file("frames"), options), Status::ok);
    std::string all;
    for (int k = 0; k < 10; ++k) all += bench.next(10000);
    EXPECT_EQ(all, "abcdabcdab");
}

TEST(ReplaySource, ReadsTheStandardInput) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    const int before = ::dup(0);
    ASSERT_EQ(::dup2(ends[0], 0), 0);
    ::close(ends[0]);
    {
        Bench bench;
        ASSERT_EQ(bench.open("-"), Status::ok);
        EXPECT_EQ(bench.next(), nothing) << "it does not block";
        const std::string all = picture('a') + picture('b');
        EXPECT_EQ(::write(ends[1], all.data(), all.size()), static_cast<ssize_t>(all.size()));
        EXPECT_EQ(bench.next(), "a");
        ::close(ends[1]);
        EXPECT_EQ(bench.next(), "b");
        EXPECT_EQ(bench.next(), nobody);
        const int polls = bench.time.polls;
        EXPECT_EQ(bench.next(1000000), nobody);
        EXPECT_LE(bench.time.polls - polls, 2);
    }
    EXPECT_GE(::fcntl(0, F_GETFD), 0) << "it is left open";
    ::dup2(before, 0);
    ::close(before);
}

TEST(ReplaySource, LendsOneFrameAtATime) {
    Bench bench;
    write_ten(bench.folder);
    ASSERT_EQ(bench.open(bench.folder.path()), Status::ok);
    Source::Frame other;
    EXPECT_EQ(bench.next(), "a");
    EXPECT_EQ(bench.source.next(0, other), Status::bad_argument);
    Source::Frame moved = std::move(bench.frame);
    EXPECT_EQ(bench.source.next(0, other), Status::bad_argument);
    moved.give_back();
    EXPECT_EQ(bench.source.next(0, other), Status::ok);
}

TEST(ReplaySource, RefusesWhatDoesNotFit) {
    Bench bench;
    bench.folder.write("a.pgm", picture('a'));
    ReplayOptions options;
    EXPECT_EQ(bench.open(bench.folder.file("b.pgm")), Status::not_found);
    EXPECT_STREQ(bench.source.fault().call, "stat");
    EXPECT_EQ(bench.source.next(0, bench.frame), Status::device_lost);
    options.interval_us = -1;
    EXPECT_EQ(bench.open(bench.folder.path(), options), Status::bad_argument);
    options = {};
    options.end = ReplayEnd::watch;
    EXPECT_EQ(bench.open(bench.folder.file("a.pgm"), options), Status::bad_argument);
    options = {};
    options.pictures = PixelFormat::yuyv;
    EXPECT_EQ(bench.open(bench.folder.path(), options), Status::bad_argument);
    options = {};
    options.stream = {PixelFormat::gray8, {2, 2}, 0};
    EXPECT_EQ(bench.open(bench.folder.path(), options), Status::bad_argument);
    options.stream.size = {100, 100};
    EXPECT_EQ(bench.open(bench.folder.file("a.pgm"), options), Status::buffer_too_small);
    EXPECT_EQ(bench.open(std::string(2000, 'x')), Status::io_error);
    ASSERT_EQ(bench.source.open(bench.folder.path(), {}, bench.memory()), Status::ok);
    EXPECT_EQ(bench.source.next(0, bench.frame), Status::bad_argument) << "not started";
    ASSERT_EQ(bench.source.start(), Status::ok);
    EXPECT_EQ(bench.source.start(), Status::bad_argument);
    EXPECT_TRUE(bench.script.open_files.empty());
}

TEST(ReplaySource, IsKeptAsACameraIs) {
    struct Clock {
        test::TestTime& time;
        std::int64_t microseconds() { return time.now_us; }
    };
    PipeBench bench;
    Clock clock{bench.time};
    const auto opening = [&](Source& source) {
        if (const Status s = source.open(bench.path().c_str(), {}, bench.memory()); s != Status::ok) return s;
        return source.start();
    };
    apps::CameraKeeper<Source, Clock, decltype(opening)> keeper(bench.source, clock, opening);
    const auto fetch = [&] { return keeper.fetch(apps::FramePolicy::every, 0, bench.frame); };
    apps::CameraEvent event;
    EXPECT_EQ(fetch(), Status::no_signal);
    ASSERT_TRUE(keeper.take_event(event));
    EXPECT_EQ(event.trouble, apps::CameraTrouble::no_signal);
    bench.begin_writing();
    bench.write(picture('a'));
    EXPECT_EQ(fetch(), Status::ok);
    ASSERT_TRUE(keeper.take_event(event));
    EXPECT_EQ(event.trouble, apps::CameraTrouble::none);
    bench.stop_writing();
    for (int k = 0; k < 100; ++k) {
        bench.time.now_us += 100000;
        EXPECT_EQ(fetch(), Status::no_signal);
    }
    ASSERT_TRUE(keeper.take_event(event));
    EXPECT_FALSE(keeper.take_event(event)) << "one event";
    std::filesystem::remove(bench.path());
    EXPECT_EQ(keeper.recoveries(), 0u);
    bench.frame.give_back();
}

/// Each call fails once and for ever: the source says so and goes on, and all is given back.
TEST(ReplaySource, SurvivesTheFailureOfEveryCall) {
    int pictures = 0;
    const auto sweep = [&](const char* path, const ReplayOptions& options) {
        test::TestTime time;
        return test::sweep(
            test::TimedKernel(time), {EIO, ENODEV, EINTR, ENOENT, EMFILE},
            [&](System system) {
                std::vector<std::uint8_t> file(600);
                std::vector<std::uint8_t> pixels(64);
                Source source(system);
                Source::Frame frame;
                for (int round = 0; round < 2; ++round) {
                    if (source.open(path, options, {{file.data(), 600}, {pixels.data(), 64}}) != Status::ok)
                        continue;
                    if (source.start() != Status::ok) continue;
                    for (int k = 0; k < 4; ++k) pictures += source.next(300000, frame) == Status::ok ? 1 : 0;
                    frame.give_back();
                }
            },
            [&](const test::SystemScript& script) {
                EXPECT_TRUE(script.all_given_back()) << script.failed << " at " << script.fail_at;
            });
    };
    TemporaryFolder folder;
    for (const char* name : {"a.pgm", "b.pgm", "c.pgm"}) folder.write(name, picture(name[0]));
    ReplayOptions watch;
    watch.end = ReplayEnd::watch;
    int runs = sweep(folder.path(), {});
    runs += sweep(folder.path(), watch);
    const std::string file = folder.file("a.pgm");
    ReplayOptions raw;
    raw.stream = {PixelFormat::gray8, {2, 2}, 0};
    raw.end = ReplayEnd::repeat;
    runs += sweep(file.c_str(), raw);
    const std::string fifo = folder.file("fifo");
    ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
    runs += sweep(fifo.c_str(), {});
    RecordProperty("runs", runs);
    EXPECT_GT(runs, 500);
    EXPECT_GT(pictures, runs / 2);
}

static_assert(replay_picture_bytes(PixelFormat::gray8, {640, 480}) > 640 * 480);

}  // namespace
}  // namespace fovea::linux_port
