// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>

#include <fovea/linux/file_storage.hpp>
#include <support/failing_system.hpp>
#include <support/storage_contract.hpp>

namespace fovea::test {
namespace {

namespace files = std::filesystem;

/// A folder of its own for every test.
class InAFolder : public testing::Test {
protected:
    InAFolder() {
        std::string pattern = (files::temp_directory_path() / "fovea_storage_XXXXXX").string();
        folder_ = ::mkdtemp(pattern.data());
    }
    ~InAFolder() override { files::remove_all(folder_); }

    linux_port::FileStorage<>& storage() { return storage_; }
    std::string name(const std::string& text) const { return (folder_ / text).string(); }
    /// How many entries the folder has: a file that was replaced leaves nothing beside it.
    std::ptrdiff_t entries() const {
        return std::distance(files::directory_iterator(folder_), files::directory_iterator());
    }

private:
    files::path folder_;
    linux_port::FileStorage<> storage_;
};

INSTANTIATE_TYPED_TEST_SUITE_P(FileStorage, StorageContract, InAFolder, ByContract);

using FileStorage = InAFolder;

TEST_F(FileStorage, SaysWhatTheSystemSaid) {
    EXPECT_EQ(storage().load(name("nothing").c_str()).status(), Status::not_found);
    EXPECT_STREQ(storage().problem(), "No such file or directory");
    EXPECT_EQ(storage().load("").status(), Status::not_found);
}

TEST_F(FileStorage, DoesNotReadAFolder) {
    EXPECT_EQ(storage().load(name("").c_str()).status(), Status::io_error);
    EXPECT_STREQ(storage().problem(), "Is a directory");
}

TEST_F(FileStorage, DoesNotWriteOverAFolder) {
    files::create_directory(name("folder"));
    EXPECT_EQ(save(storage(), name("folder"), {1}), Status::io_error);
    EXPECT_TRUE(files::is_directory(name("folder")));
    EXPECT_EQ(entries(), 1);
}

TEST_F(FileStorage, DoesNotWriteIntoAFolderThatIsNotThere) {
    EXPECT_EQ(save(storage(), name("no/a"), {1}), Status::not_found);
    EXPECT_EQ(save(storage(), name("no/a/b"), {1}), Status::not_found);
    ASSERT_EQ(save(storage(), name("file"), {1}), Status::ok);
    EXPECT_EQ(save(storage(), name("file/a"), {1}), Status::io_error);
    EXPECT_EQ(entries(), 1);
}

TEST_F(FileStorage, LeavesNothingBesideAFileThatItReplaced) {
    ASSERT_EQ(save(storage(), name("a"), {1}), Status::ok);
    ASSERT_EQ(save(storage(), name("a"), {2, 3}), Status::ok);
    EXPECT_EQ(entries(), 1);
}

TEST_F(FileStorage, DoesNotReadWhatItMayNot) {
    ASSERT_EQ(save(storage(), name("secret"), {1}), Status::ok);
    ASSERT_EQ(::chmod(name("secret").c_str(), 0), 0);
    ASSERT_EQ(::chmod(name("").c_str(), 0755), 0);
    // The superuser may read every file, so he becomes nobody for a moment.
    const uid_t user = ::geteuid();
    constexpr uid_t nobody = 65534;
    ASSERT_EQ(user == 0 ? ::seteuid(nobody) : 0, 0);
    const Status status = storage().load(name("secret").c_str()).status();
    ASSERT_EQ(::seteuid(user), 0);
    EXPECT_EQ(status, Status::io_error);
    EXPECT_STREQ(storage().problem(), "Permission denied");
}

TEST_F(FileStorage, SaysThatTheMediumCannotBeRead) {
    const char* const unmapped = "/proc/self/mem";
    if (!files::exists(unmapped)) GTEST_SKIP() << "no /proc here";
    EXPECT_EQ(storage().load(unmapped).status(), Status::io_error);
    EXPECT_STREQ(storage().problem(), "Input/output error");
}

TEST_F(FileStorage, TakesTheLargestFileAndNoLargerOne) {
    for (const std::size_t most : {std::size_t{0}, std::size_t{1}, std::size_t{1000}, std::size_t{65535},
                                   std::size_t{65536}, std::size_t{100000}, std::size_t{131072}}) {
        linux_port::FileStorage<> limited({}, most);
        ASSERT_EQ(save(limited, name("a"), StoredBytes(most, 3)), Status::ok);
        EXPECT_EQ(loaded(limited, name("a")).size(), most);
        ASSERT_EQ(save(limited, name("a"), StoredBytes(most + 1, 3)), Status::ok);
        EXPECT_EQ(limited.load(name("a").c_str()).status(), Status::io_error) << most;
        EXPECT_STREQ(limited.problem(), "File too large");
    }
}

TEST_F(FileStorage, SaysThatADeviceIsFull) {
    if (!files::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
    EXPECT_EQ(save(storage(), "/dev/full", {1, 2, 3}), Status::io_error);
    EXPECT_STREQ(storage().problem(), "No space left on device");
}

TEST_F(FileStorage, LeavesTheOldBytesWhenTheNewOnesDoNotFit) {
    ASSERT_EQ(save(storage(), name("a"), {1, 2}), Status::ok);
    // Beyond this size write() stops short and then fails, as on a full disk.
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    rlimit small = before;
    small.rlim_cur = 1000;
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    const Status status = save(storage(), name("a"), StoredBytes(5000, 9));
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
    std::signal(SIGXFSZ, handler);
    EXPECT_EQ(status, Status::io_error);
    EXPECT_STREQ(storage().problem(), "File too large");
    EXPECT_EQ(loaded(storage(), name("a")), (StoredBytes{1, 2}));
    EXPECT_EQ(entries(), 1);
}

TEST_F(FileStorage, ReadsAPipeToItsEnd) {
    const std::string pipe = name("pipe");
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    const StoredBytes bytes(200000, 5);
    // A pipe holds less than that, so both ends wait for each other again and again.
    std::thread writer([&] {
        linux_port::FileStorage<> other;
        EXPECT_EQ(save(other, pipe, bytes), Status::ok);
    });
    EXPECT_TRUE(loaded(storage(), pipe) == bytes);
    writer.join();
    EXPECT_FALSE(files::is_regular_file(pipe)) << "a pipe is written to, not replaced";
}

/// A folder, or a file system, that cannot be synced, as an errno says.
struct UnsyncedFolder : linux_port::Kernel {
    int error = 0;
    int sync(int file) {
        struct stat what {};
        return ::fstat(file, &what) == 0 && S_ISDIR(what.st_mode) ? -error : 0;
    }
};

TEST_F(FileStorage, SaysThatItsFolderIsNotSafe) {
    for (const int error : {EIO, ENOSPC, EROFS}) {
        linux_port::FileStorage unsafe(UnsyncedFolder{{}, error});
        EXPECT_EQ(save(unsafe, name("a"), {static_cast<std::uint8_t>(error)}), Status::io_error);
        EXPECT_STREQ(unsafe.fault().call, "fsync of the folder");
        EXPECT_EQ(unsafe.fault().error, error);
        EXPECT_EQ(loaded(storage(), name("a")), StoredBytes{static_cast<std::uint8_t>(error)});
    }
    for (const int error : {EINVAL, ENOSYS}) {
        linux_port::FileStorage odd(UnsyncedFolder{{}, error});
        EXPECT_EQ(save(odd, name("a"), {1}), Status::ok) << error;
    }
}

TEST_F(FileStorage, KeepsTheOldOrTheNewInEverySweep) {
    const std::string file = name("a");
    const StoredBytes old(100, 1), fresh(70000, 2);
    std::string claim;
    int ok = 0;
    const int runs = sweep(
        UnsyncedFolder{}, {EINTR, EIO, ENOSPC, EROFS, EDQUOT, EACCES, EMFILE, ENODEV, EINVAL},
        [&](auto failing) {
            linux_port::FileStorage sound(UnsyncedFolder{});
            linux_port::FileStorage swept(failing);
            if (save(sound, file, old) != Status::ok) claim = "set up";
            const Status saved = save(swept, file, fresh);
            if (saved != Status::ok && swept.fault().status != saved) claim = "no fault";
            ok += saved == Status::ok;
            const StoredBytes now = loaded(sound, file);
            if (now != fresh && (saved == Status::ok || now != old)) claim = "other bytes";
            const Result<Span<const std::uint8_t>> again = swept.load(file.c_str());
            if (again ? StoredBytes(again->begin(), again->end()) != now
                      : swept.fault().status != again.status())
                claim = "loaded other bytes";
        },
        [&](const SystemScript& script) {
            ASSERT_TRUE(script.all_given_back()) << script.fail_at;
            ASSERT_EQ(claim, "") << script.fail_at << " " << script.error << " " << script.for_ever;
            ASSERT_FALSE(!script.for_ever && entries() != 1) << script.fail_at;
        });
    RecordProperty("runs", runs);
    EXPECT_GE(runs, 200);
    EXPECT_GT(ok, 100);
}

}  // namespace
}  // namespace fovea::test
