// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <common/io.hpp>
#include <support/test_io.hpp>

namespace fovea::test {
namespace {

TEST(ExitCode, TheWorstCounts) {
    using namespace apps;
    EXPECT_EQ(worse(exit_ok, exit_ok), exit_ok);
    EXPECT_EQ(worse(exit_ok, exit_not_ok), exit_not_ok);
    EXPECT_EQ(worse(exit_failed, exit_not_ok), exit_failed);
    EXPECT_EQ(exit_ok, 0);
    EXPECT_EQ(exit_not_ok, 1);
    EXPECT_EQ(exit_failed, 2);
}

TEST(FileProblem, TellsWhatTheSystemSaidOrWhatIsWrongWithTheBytes) {
    TestIo io;
    EXPECT_EQ(apps::file_problem("a.png", Status::not_found, io.storage()), "a.png: simulated fault");
    EXPECT_EQ(apps::file_problem("a.png", Status::io_error, io.storage()), "a.png: simulated fault");
    EXPECT_EQ(apps::file_problem("a.png", Status::truncated, io.storage()), "a.png: the data end too early");
}

}  // namespace
}  // namespace fovea::test
