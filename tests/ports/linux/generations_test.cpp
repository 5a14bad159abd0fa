// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/linux/generations.hpp>
#include <support/failing_system.hpp>
#include <support/memory_disk.hpp>
#include <support/storage_contract.hpp>

namespace fovea::test {
namespace {

namespace files = std::filesystem;
using linux_port::GenerationStorage;

/// Memory for what is loaded, and a storage upon it.
template <class System>
struct Keeper {
    explicit Keeper(System system, std::size_t bytes = 400000)
        : memory(bytes), storage(system, {memory.data(), static_cast<std::ptrdiff_t>(bytes)}) {}
    std::vector<std::uint8_t> memory;
    GenerationStorage<System> storage;
};

class InAFolderOfGenerations : public testing::Test {
protected:
    InAFolderOfGenerations() {
        std::string pattern = (files::temp_directory_path() / "fovea_generations_XXXXXX").string();
        folder_ = ::mkdtemp(pattern.data());
    }
    ~InAFolderOfGenerations() override { files::remove_all(folder_); }

    GenerationStorage<>& storage() { return keeper_.storage; }
    std::string name(const std::string& text) const { return (folder_ / text).string(); }
    std::ptrdiff_t entries() const {
        return std::distance(files::directory_iterator(folder_), files::directory_iterator());
    }
    StoredBytes file(const std::string& text) const {
        std::ifstream in(name(text), std::ios::binary);
        return StoredBytes(std::istreambuf_iterator<char>(in), {});
    }
    void put(const std::string& text, const StoredBytes& bytes) const {
        std::ofstream(name(text), std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    }

private:
    files::path folder_;
    Keeper<linux_port::Kernel> keeper_{linux_port::Kernel{}};
};

INSTANTIATE_TYPED_TEST_SUITE_P(GenerationStorage, StorageContract, InAFolderOfGenerations, ByContract);

using Generations = InAFolderOfGenerations;

/// A slot, whole.
StoredBytes slot(std::uint32_t generation, const StoredBytes& bytes) {
    StoredBytes all = {'F', 'V', 'G', 'N', 1, 0, 0, 0};
    const auto word = [&](std::uint32_t value) {
        for (int i = 0; i < 4; ++i) all.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
    };
    word(generation);
    word(static_cast<std::uint32_t>(bytes.size()));
    Crc32 crc;
    crc.add(Span<const std::uint8_t>(all.data(), 16));
    crc.add(Span<const std::uint8_t>(bytes.data(), static_cast<std::ptrdiff_t>(bytes.size())));
    word(crc.value());
    all.insert(all.end(), bytes.begin(), bytes.end());
    return all;
}

TEST_F(Generations, TakeTurns) {
    ASSERT_EQ(save(storage(), name("job"), {1, 2}), Status::ok);
    EXPECT_EQ(storage().generation(), 1u);
    EXPECT_EQ(file("job.a"), slot(1, {1, 2})) << "the format, by hand";
    EXPECT_EQ(entries(), 1);
    ASSERT_EQ(save(storage(), name("job"), {3}), Status::ok);
    EXPECT_EQ(file("job.b"), slot(2, {3}));
    ASSERT_EQ(save(storage(), name("job"), {}), Status::ok);
    EXPECT_EQ(file("job.a"), slot(3, {}));
    EXPECT_EQ(file("job.b"), slot(2, {3}));
    EXPECT_EQ(entries(), 2) << "nothing beside them";
    EXPECT_EQ(loaded(storage(), name("job")), StoredBytes());
    EXPECT_FALSE(storage().fell_back());
    EXPECT_EQ(storage().generation(), 3u);
}

TEST_F(Generations, FallBackToTheOneBefore) {
    ASSERT_EQ(save(storage(), name("job"), {1}), Status::ok);
    ASSERT_EQ(save(storage(), name("job"), {2}), Status::ok);
    const StoredBytes good = file("job.b");
    for (std::size_t i = 0; i < good.size(); ++i)
        for (int bit = 0; bit < 8; ++bit) {
            StoredBytes bad = good;
            bad[i] = static_cast<std::uint8_t>(bad[i] ^ (1 << bit));
            put("job.b", bad);
            ASSERT_EQ(loaded(storage(), name("job")), StoredBytes{1}) << i;
            ASSERT_TRUE(storage().fell_back());
            ASSERT_STRNE(storage().problem(), "");
        }
    for (std::size_t size = 0; size < good.size(); ++size) {
        put("job.b", StoredBytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size)));
        ASSERT_EQ(loaded(storage(), name("job")), StoredBytes{1}) << size;
        ASSERT_TRUE(storage().fell_back());
    }
    StoredBytes longer = good;
    longer.push_back(0);
    put("job.b", longer);
    EXPECT_EQ(loaded(storage(), name("job")), StoredBytes{1});
    EXPECT_TRUE(storage().fell_back());
    // What is saved next replaces what is damaged.
    ASSERT_EQ(save(storage(), name("job"), {3}), Status::ok);
    EXPECT_EQ(file("job.a"), slot(1, {1}));
    EXPECT_EQ(loaded(storage(), name("job")), StoredBytes{3});
    EXPECT_FALSE(storage().fell_back());
}

TEST_F(Generations, AreNoneWhereBothAreDamaged) {
    put("job.a", {1, 2, 3});
    EXPECT_EQ(storage().load(name("job").c_str()).status(), Status::malformed);
    put("job.b", {});
    EXPECT_EQ(storage().load(name("job").c_str()).status(), Status::malformed);
    EXPECT_FALSE(storage().fell_back());
    ASSERT_EQ(save(storage(), name("job"), {9}), Status::ok);
    EXPECT_EQ(loaded(storage(), name("job")), StoredBytes{9});
    EXPECT_TRUE(storage().fell_back()) << "the other may have been newer";
}

TEST_F(Generations, BeginAgainBehindTheLargestNumber) {
    put("job.a", slot(0xffffffff, {1}));
    put("job.b", slot(0xfffffffe, {2}));
    EXPECT_EQ(loaded(storage(), name("job")), StoredBytes{1});
    for (std::uint8_t i = 0; i < 3; ++i) {
        ASSERT_EQ(save(storage(), name("job"), {i}), Status::ok);
        EXPECT_EQ(storage().generation(), i);
        EXPECT_EQ(loaded(storage(), name("job")), StoredBytes{i});
    }
    // Numbers that no storage writes: the same twice, and as far apart as can be.
    put("job.a", slot(7, {1}));
    put("job.b", slot(7, {2}));
    EXPECT_EQ(loaded(storage(), name("job")), StoredBytes{1});
    ASSERT_EQ(save(storage(), name("job"), {3}), Status::ok);
    EXPECT_EQ(loaded(storage(), name("job")), StoredBytes{3});
    put("job.a", slot(0, {1}));
    put("job.b", slot(0x80000000, {2}));
    EXPECT_EQ(loaded(storage(), name("job")), StoredBytes{1});
    ASSERT_EQ(save(storage(), name("job"), {3}), Status::ok);
    EXPECT_EQ(loaded(storage(), name("job")), StoredBytes{3});
}

TEST_F(Generations, DoNotOutgrowTheMemory) {
    Keeper<linux_port::Kernel> small(linux_port::Kernel{}, 3);
    ASSERT_EQ(save(small.storage, name("job"), {1, 2, 3}), Status::ok);
    EXPECT_EQ(save(small.storage, name("job"), {1, 2, 3, 4}), Status::buffer_too_small);
    EXPECT_EQ(loaded(small.storage, name("job")), (StoredBytes{1, 2, 3}));
    ASSERT_EQ(save(storage(), name("job"), {1, 2, 3, 4}), Status::ok);
    EXPECT_EQ(small.storage.load(name("job").c_str()).status(), Status::buffer_too_small)
        << "never the older instead";
    Keeper<linux_port::Kernel> none(linux_port::Kernel{}, 0);
    ASSERT_EQ(save(none.storage, name("nothing"), {}), Status::ok);
    EXPECT_EQ(loaded(none.storage, name("nothing")), StoredBytes());
}

TEST_F(Generations, HaveAName) {
    EXPECT_EQ(storage().load("").status(), Status::bad_argument);
    EXPECT_EQ(save(storage(), "", {1}), Status::bad_argument);
    EXPECT_EQ(save(storage(), std::string(508, 'x'), {1}), Status::bad_argument);
    EXPECT_EQ(save(storage(), name("no/job"), {1}), Status::not_found);
    EXPECT_EQ(entries(), 0);
}

TEST_F(Generations, AreNotKeptByWhatIsNoFile) {
    ASSERT_EQ(::mkfifo(name("job.a").c_str(), 0600), 0);
    EXPECT_EQ(storage().load(name("job").c_str()).status(), Status::malformed);
    ASSERT_EQ(save(storage(), name("job"), {1}), Status::ok);
    EXPECT_EQ(loaded(storage(), name("job")), StoredBytes{1});
    files::create_directory(name("other.a"));
    EXPECT_EQ(storage().load(name("other").c_str()).status(), Status::io_error);
    EXPECT_EQ(save(storage(), name("other"), {1}), Status::io_error);
    EXPECT_EQ(entries(), 2);
}

/// A medium that does not give one of the files.
struct BadSector : linux_port::Kernel {
    const char* file = "";
    int open(const char* path, int flags, unsigned mode = 0) {
        return std::string(path) == file ? -EIO : Kernel::open(path, flags, mode);
    }
};

TEST_F(Generations, ReplaceWhatCannotBeReadBeforeWhatIsDamaged) {
    put("job.a", {1, 2, 3});
    put("job.b", slot(8, {8}));
    const std::string b = name("job.b");
    Keeper blind(BadSector{{}, b.c_str()}, 10);
    EXPECT_EQ(blind.storage.load(name("job").c_str()).status(), Status::io_error);
    ASSERT_EQ(save(blind.storage, name("job"), {9}), Status::ok);
    // The medium has come to itself, and an old generation must not come with it.
    EXPECT_EQ(loaded(storage(), name("job")), StoredBytes{9});
}

TEST_F(Generations, FallBackFromWhatCannotBeRead) {
    put("job.a", slot(7, {7}));
    put("job.b", slot(8, {8}));
    const std::string b = name("job.b");
    Keeper blind(BadSector{{}, b.c_str()}, 10);
    EXPECT_EQ(loaded(blind.storage, name("job")), StoredBytes{7});
    EXPECT_TRUE(blind.storage.fell_back());
    EXPECT_STREQ(blind.storage.problem(), "Input/output error");
    ASSERT_EQ(save(blind.storage, name("job"), {9}), Status::ok);
    EXPECT_EQ(loaded(storage(), name("job")), StoredBytes{9});
}

/// Quick: what a sync does is seen where power is cut.
struct WithoutSync : linux_port::Kernel {
    int sync(int) { return 0; }
};

/// F18 and more: every call of a save fails once, and from every call on all of them. Then the old bytes are
/// loaded or the new ones, and where the save was ok, these.
TEST_F(Generations, KeepTheOldOrTheNewInEverySweep) {
    const std::string job = name("job");
    Keeper keeper(WithoutSync{}, 1000);
    std::string claim;
    int ok = 0;
    const int runs = sweep(
        WithoutSync{}, {EINTR, EIO, ENOSPC, EROFS, EDQUOT, EACCES, EMFILE, ENODEV, EINVAL},
        [&](auto failing) {
            files::remove(job + ".a");
            files::remove(job + ".b");
            const StoredBytes older(700, 1), old(300, 2), fresh(600, 3);
            GenerationStorage<WithoutSync>& sound = keeper.storage;
            if (save(sound, job, older) != Status::ok || save(sound, job, old) != Status::ok)
                claim = "set up";
            Keeper swept(failing, 1000);
            const Status saved = save(swept.storage, job, fresh);
            if (saved != Status::ok && swept.storage.fault().status != saved) claim = "no fault";
            ok += saved == Status::ok;
            const StoredBytes now = loaded(sound, job);
            if (now != fresh && (saved == Status::ok || now != old)) claim = "other bytes";
            if (sound.fell_back()) claim = "fell back";
            const Result<Span<const std::uint8_t>> again = swept.storage.load(job.c_str());
            if (again) {
                const StoredBytes got(again->begin(), again->end());
                const bool told = swept.storage.fell_back() && (got == older || got == old);
                if (got != now && !told) claim = "loaded other bytes";
            } else if (swept.storage.fault().status != again.status()) {
                claim = "no fault of load";
            }
        },
        [&](const SystemScript& script) {
            ASSERT_TRUE(script.all_given_back()) << script.fail_at;
            ASSERT_EQ(claim, "") << script.names[static_cast<std::size_t>(script.fail_at) - 1] << " "
                                 << script.fail_at << " " << script.error << " " << script.for_ever;
            ASSERT_FALSE(!script.for_ever && files::exists(job + ".new")) << script.fail_at;
        });
    RecordProperty("runs", runs);
    EXPECT_GE(runs, 400);
    EXPECT_GT(ok, 100);
}

// ---- Power cuts ---------------------------------------------------------------------------

StoredBytes content_of(int number) {
    Random random(static_cast<std::uint64_t>(number));
    StoredBytes bytes(random.below(1500));
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.next() >> 24);
    return bytes;
}

struct Cuts {
    int cuts = 0, bad = 0, in_flight = 0, fell_back = 0;
};

/// Saves one after the other, with a cut at a random call, five times on each disk.
Cuts cut_power(int disks, Journal journal, bool ignores_syncs) {
    Cuts all;
    for (int seed = 0; seed < disks; ++seed) {
        Random random(static_cast<std::uint64_t>(seed), 7);
        MemoryDisk disk;
        disk.journal = journal;
        disk.ignores_syncs = ignores_syncs;
        int acknowledged = 0, begun = 0;
        for (int round = 0; round < 5; ++round) {
            Keeper keeper(DiskSystem{&disk}, 2000);
            disk.cut_at = 1 + static_cast<int>(random.below(round == 0 ? 60 : 120));
            while (disk.calls < disk.cut_at) {
                ++begun;
                if (save(keeper.storage, "job", content_of(begun)) != Status::ok) break;
                acknowledged = begun;
            }
            disk.power_on(random);
            ++all.cuts;
            const Result<Span<const std::uint8_t>> found = keeper.storage.load("job");
            const StoredBytes bytes = found ? StoredBytes(found->begin(), found->end()) : StoredBytes();
            const bool nothing = !found && acknowledged == 0;
            const bool newest = found.ok() && bytes == content_of(acknowledged) && acknowledged > 0;
            const bool next = found.ok() && bytes == content_of(begun);
            all.bad += !nothing && !newest && !next;
            all.in_flight += next && begun != acknowledged;
            all.fell_back += found.ok() && keeper.storage.fell_back();
            if (disk.open_files() != 0) ++all.bad;
            if (next) acknowledged = begun;
        }
    }
    return all;
}

/// F20.
TEST(GenerationsAndPowerCuts, NeverLoseWhatWasAcknowledged) {
    for (const Journal journal : {Journal::kept, Journal::none}) {
        const Cuts cuts = cut_power(400, journal, false);
        EXPECT_EQ(cuts.cuts, 2000);
        EXPECT_EQ(cuts.bad, 0);
        // The cuts were where it matters: some saves had happened that nobody was told of.
        EXPECT_GT(cuts.in_flight, 50);
        RecordProperty(journal == Journal::kept ? "journalcuts" : "cuts", cuts.cuts);
    }
}

TEST(GenerationsAndPowerCuts, AreSeenByThisTestOnADiskThatLies) {
    for (const Journal journal : {Journal::kept, Journal::none}) {
        const Cuts cuts = cut_power(400, journal, true);
        EXPECT_GT(cuts.bad, 100);
        EXPECT_GT(cuts.fell_back, 10);
    }
}

/// Any bytes in the slots: an answer, and a save that works.
TEST(GenerationsOfForeignBytes, AreAnsweredAndReplaced) {
    int whole = 0;
    for (std::uint64_t seed = 0; seed < 3000; ++seed) {
        Random random(seed);
        MemoryDisk disk;
        for (const char* file : {"job.a", "job.b"}) {
            StoredBytes bytes = slot(random.next(), StoredBytes(random.below(40), 5));
            for (std::uint32_t i = random.below(3); i > 0; --i)
                bytes[random.below(static_cast<std::uint32_t>(bytes.size()))] =
                    static_cast<std::uint8_t>(random.next());
            bytes.resize(bytes.size() + random.below(3) - random.below(2), 0);
            disk.put(file, bytes);
        }
        Keeper keeper(DiskSystem{&disk}, 32);
        const Result<Span<const std::uint8_t>> found = keeper.storage.load("job");
        whole += found.ok();
        ASSERT_TRUE(found.ok() || found.status() == Status::malformed ||
                    found.status() == Status::buffer_too_small);
        const std::size_t size = found ? static_cast<std::size_t>(found->size()) : 0;
        ASSERT_TRUE(!found || StoredBytes(found->begin(), found->end()) == StoredBytes(size, 5));
        ASSERT_EQ(save(keeper.storage, "job", {1, 2, 3}), Status::ok);
        ASSERT_EQ(loaded(keeper.storage, "job"), (StoredBytes{1, 2, 3}));
    }
    EXPECT_GT(whole, 300);
}

}  // namespace
}  // namespace fovea::test
