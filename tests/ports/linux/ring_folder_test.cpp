// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <set>
#include <string>

#include <fovea/linux/ring_folder.hpp>

#include "support/failing_system.hpp"
#include "support/temporary_folder.hpp"

namespace fovea::linux_port {
namespace {

using test::TemporaryFolder;
using Names = std::set<std::string>;

Span<const std::uint8_t> span(const std::string& bytes) {
    return {reinterpret_cast<const std::uint8_t*>(bytes.data()), static_cast<std::ptrdiff_t>(bytes.size())};
}

/// A pair of 10 and 5 bytes.
template <class Ring>
Status store(Ring& ring, char letter) {
    return ring.store(span(std::string(10, letter)), span(std::string(5, letter)));
}

RingLimits limits(std::int64_t bytes, int pairs) {
    RingLimits made;
    made.bytes = bytes;
    made.pairs = pairs;
    return made;
}

TEST(RingFolder, StoresPairsAndDropsTheOldest) {
    const TemporaryFolder folder;
    RingFolder<> ring;
    ASSERT_EQ(ring.open(folder.path(), limits(1000, 2)), Status::ok);
    ASSERT_EQ(store(ring, 'a'), Status::ok);
    EXPECT_EQ(folder.names(), (Names{"00000000.json", "00000000.pgm"}));
    EXPECT_EQ(folder.read("00000000.pgm"), std::string(10, 'a'));
    EXPECT_EQ(folder.read("00000000.json"), std::string(5, 'a'));
    ASSERT_EQ(store(ring, 'b'), Status::ok);
    ASSERT_EQ(store(ring, 'c'), Status::ok);
    EXPECT_EQ(folder.names(), (Names{"00000001.json", "00000001.pgm", "00000002.json", "00000002.pgm"}));
    EXPECT_EQ(folder.read("00000002.pgm"), std::string(10, 'c'));
    EXPECT_EQ(ring.last_number(), 2);
}

TEST(RingFolder, KeepsItsBudgetOfBytes) {
    const TemporaryFolder folder;
    RingFolder<> ring;
    ASSERT_EQ(ring.open(folder.path(), limits(45, 100)), Status::ok);
    for (const char letter : {'a', 'b', 'c', 'd'}) ASSERT_EQ(store(ring, letter), Status::ok);
    EXPECT_EQ(folder.names().size(), 6u);
    EXPECT_EQ(folder.names().count("00000001.pgm"), 1u);
    // A large one takes the place of three.
    ASSERT_EQ(ring.store(span(std::string(40, 'e')), span("{}")), Status::ok);
    EXPECT_EQ(folder.names(), (Names{"00000004.json", "00000004.pgm"}));
    // One above the budget takes none.
    EXPECT_EQ(ring.store(span(std::string(44, 'f')), span("{}")), Status::buffer_too_small);
    EXPECT_EQ(folder.names(), (Names{"00000004.json", "00000004.pgm"}));
    ASSERT_EQ(ring.store(span(std::string(43, 'f')), span("{}")), Status::ok);
    EXPECT_EQ(folder.names(), (Names{"00000005.json", "00000005.pgm"}));
    // A smaller budget of a later start holds at once.
    for (int k = 0; k < 3; ++k) ASSERT_EQ(store(ring, 'g'), Status::ok);
    RingFolder<> later;
    ASSERT_EQ(later.open(folder.path(), limits(15, 100)), Status::ok);
    ASSERT_EQ(store(later, 'h'), Status::ok);
    EXPECT_EQ(folder.names(), (Names{"00000009.json", "00000009.pgm"}));
}

TEST(RingFolder, GoesOnBehindTheLargestNumber) {
    const TemporaryFolder folder;
    folder.write("00000041.pgm", "x");
    folder.write("00000041.json", "x");
    RingFolder<> ring;
    ASSERT_EQ(ring.open(folder.path(), {}), Status::ok);
    ASSERT_EQ(store(ring, 'a'), Status::ok);
    EXPECT_EQ(folder.names().count("00000042.pgm"), 1u);
    // Beyond eight digits.
    folder.write("99999999.pgm", "x");
    ASSERT_EQ(store(ring, 'b'), Status::ok);
    ASSERT_EQ(store(ring, 'c'), Status::ok);
    EXPECT_EQ(folder.names().count("100000000.pgm"), 1u);
    EXPECT_EQ(folder.names().count("100000001.json"), 1u);
    EXPECT_EQ(ring.last_number(), 100000001);
}

TEST(RingFolder, TouchesNothingThatIsNotItsOwn) {
    const TemporaryFolder folder;
    const TemporaryFolder outside;
    outside.write("00000001.pgm", "outside");
    const Names others = {"1.pgm",        "000000001.pgm", "00000001.PGM",   "00000001.pgm.bak",
                          "0000001x.pgm", "readme.json",   ".pgm",           "-0000001.pgm",
                          "00000001",     "00000001.new",  "00000001pgm.new"};
    for (const std::string& name : others) folder.write(name, "other");
    std::filesystem::create_directory(folder.file("00000009.pgm"));
    std::filesystem::create_directory(folder.file("sub"));
    folder.write("sub/00000001.pgm", "other");
    std::filesystem::create_symlink(outside.file("00000001.pgm"), folder.file("00000003.pgm"));
    std::filesystem::create_symlink(outside.file("gone"), folder.file("00000010.pgm.new"));
    RingFolder<> ring;
    ASSERT_EQ(ring.open(folder.path(), limits(1000, 1)), Status::ok);
    for (const char letter : {'a', 'b', 'c'}) ASSERT_EQ(store(ring, letter), Status::ok);
    Names expected = others;
    for (const char* name : {"00000009.pgm", "sub", "00000010.pgm.new", "00000013.pgm", "00000013.json"})
        expected.insert(name);
    EXPECT_EQ(folder.names(), expected);
    for (const std::string& name : others) EXPECT_EQ(folder.read(name), "other") << name;
    EXPECT_EQ(folder.read("sub/00000001.pgm"), "other");
    EXPECT_EQ(outside.names(), (Names{"00000001.pgm"}));
    EXPECT_EQ(outside.read("00000001.pgm"), "outside");
}

TEST(RingFolder, RemovesWhatAPowerCutHasLeft) {
    const TemporaryFolder folder;
    for (const char* name : {"00000001.pgm.new", "00000001.json.new", "00000002.json", "00000003.pgm.new",
                             "00000003.json", "00000004.pgm", "00000004.json", "00000005.pgm"})
        folder.write(name, "x");
    RingFolder<> ring;
    ASSERT_EQ(ring.open(folder.path(), {}), Status::ok);
    ASSERT_EQ(store(ring, 'a'), Status::ok);
    EXPECT_EQ(folder.names(),
              (Names{"00000004.pgm", "00000004.json", "00000005.pgm", "00000006.pgm", "00000006.json"}));
}

TEST(RingFolder, IsMadeWithTheFirstPairAndAgainIfItIsTakenAway) {
    const TemporaryFolder folder;
    RingFolder<> ring;
    ASSERT_EQ(ring.open(folder.file("ring").c_str(), {}), Status::ok);
    EXPECT_TRUE(folder.names().empty());
    ASSERT_EQ(store(ring, 'a'), Status::ok);
    folder.remove("ring");
    ASSERT_EQ(store(ring, 'b'), Status::ok);
    EXPECT_EQ(folder.read("ring/00000001.pgm"), std::string(10, 'b')) << "numbers are not used twice";
    RingFolder<> orphan;
    ASSERT_EQ(orphan.open(folder.file("no/ring").c_str(), {}), Status::ok);
    EXPECT_EQ(store(orphan, 'a'), Status::not_found);
}

TEST(RingFolder, RefusesLimitsWithoutSense) {
    RingFolder<> ring;
    EXPECT_EQ(ring.open("/tmp", limits(0, 1)), Status::bad_argument);
    EXPECT_EQ(ring.open("/tmp", limits(1, 0)), Status::bad_argument);
    EXPECT_EQ(ring.open("/tmp", limits(1, 1001)), Status::bad_argument);
    EXPECT_EQ(ring.open("", limits(1, 1)), Status::bad_argument);
    EXPECT_EQ(ring.open(std::string(1025, 'x').c_str(), limits(1, 1)), Status::bad_argument);
}

/// All names are of whole pairs, with the bytes that belong to them, and the ring is within its budget.
void expect_whole_pairs(const TemporaryFolder& folder, std::size_t most_pairs, const std::string& when) {
    std::size_t pictures = 0;
    for (const std::string& name : folder.names()) {
        const std::string number = name.substr(0, 8);
        EXPECT_TRUE(name == number + ".pgm" || name == number + ".json") << name << " " << when;
        const std::string picture = folder.read(number + ".pgm");
        ASSERT_EQ(picture.size(), 10u) << name << " " << when;
        EXPECT_EQ(picture, std::string(10, picture[0])) << when;
        EXPECT_EQ(folder.read(number + ".json"), std::string(5, picture[0])) << when;
        if (name == number + ".pgm") ++pictures;
    }
    EXPECT_LE(pictures, most_pairs) << when;
}

/// Each call fails once and for ever, in a ring that is full and has the remains of a power cut in it.
TEST(RingFolder, HoldsWholePairsAfterTheFailureOfEveryCall) {
    std::unique_ptr<TemporaryFolder> folder;
    int stored = 0;
    const int runs = test::sweep(
        linux_port::Kernel(), {EIO, ENOSPC, EROFS, EDQUOT, EINTR, EFBIG},
        [&](test::FailingSystem<> system) {
            folder = std::make_unique<TemporaryFolder>();
            for (const char* name : {"00000000", "00000001"}) {
                folder->write(std::string(name) + ".pgm", std::string(10, 'x'));
                folder->write(std::string(name) + ".json", std::string(5, 'x'));
            }
            folder->write("00000002.pgm.new", "torn");
            RingFolder<test::FailingSystem<>> ring(system);
            EXPECT_EQ(ring.open(folder->path(), limits(30, 2)), Status::ok);
            for (const char letter : {'a', 'b'}) {
                const Status status = store(ring, letter);
                stored += status == Status::ok ? 1 : 0;
                EXPECT_TRUE(status == Status::ok || ring.fault().error != 0);
            }
        },
        [&](const test::SystemScript& script) {
            const std::string when = script.failed + " at " + std::to_string(script.fail_at);
            EXPECT_TRUE(script.all_given_back()) << when;
            // What failed once was tried again with the second pair.
            if (!script.for_ever) expect_whole_pairs(*folder, 2, when);
            RingFolder<> healthy;
            ASSERT_EQ(healthy.open(folder->path(), limits(30, 2)), Status::ok);
            ASSERT_EQ(store(healthy, 'z'), Status::ok);
            expect_whole_pairs(*folder, 2, when + ", later");
        });
    RecordProperty("runs", runs);
    EXPECT_GT(runs, 300);
    EXPECT_GT(stored, runs / 2);
}

/// The same for one pair alone: after its failure nothing of it is there.
TEST(RingFolder, LeavesNothingOfAPairThatFailed) {
    std::unique_ptr<TemporaryFolder> folder;
    bool whole = false;
    const int runs = test::sweep(
        linux_port::Kernel(), {EIO, ENOSPC},
        [&](test::FailingSystem<> system) {
            folder = std::make_unique<TemporaryFolder>();
            for (const char* name : {"00000000", "00000001"}) {
                folder->write(std::string(name) + ".pgm", std::string(10, 'x'));
                folder->write(std::string(name) + ".json", std::string(5, 'x'));
            }
            RingFolder<test::FailingSystem<>> ring(system);
            EXPECT_EQ(ring.open(folder->path(), limits(30, 2)), Status::ok);
            whole = store(ring, 'a') == Status::ok;
        },
        [&](const test::SystemScript& script) {
            if (script.for_ever) return;
            expect_whole_pairs(*folder, 2, script.failed + " at " + std::to_string(script.fail_at));
            EXPECT_EQ(folder->names().count("00000002.pgm"), whole ? 1u : 0u);
        });
    EXPECT_GT(runs, 50);
}

}  // namespace
}  // namespace fovea::linux_port
