// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include <fovea/simulated/byte_pipe.hpp>

namespace fovea::test {
namespace {

TEST(BytePipe, GivesWhatHasArrivedInPieces) {
    simulated::BytePipe pipe;
    std::uint8_t room[2] = {};
    EXPECT_EQ(*pipe.read(room), 0);
    pipe.arriving = {1, 2, 3};
    EXPECT_EQ(*pipe.read(room), 2);
    EXPECT_EQ(room[1], 2);
    EXPECT_EQ(*pipe.read(room), 1);
    EXPECT_EQ(room[0], 3);
    EXPECT_EQ(*pipe.read(room), 0);
}

TEST(BytePipe, TakesAsMuchAsThereIsRoomFor) {
    simulated::BytePipe pipe;
    pipe.room = 3;
    const std::uint8_t bytes[] = {7, 8};
    EXPECT_EQ(*pipe.write(bytes), 2);
    EXPECT_EQ(*pipe.write(bytes), 1);
    EXPECT_EQ(*pipe.write(bytes), 0);
    EXPECT_EQ(pipe.sent, (std::vector<std::uint8_t>{7, 8, 7}));
}

TEST(BytePipe, RefusesWhileBroken) {
    simulated::BytePipe pipe;
    pipe.broken = true;
    std::uint8_t byte = 5;
    EXPECT_EQ(pipe.read({&byte, 1}).status(), Status::io_error);
    EXPECT_EQ(pipe.write({&byte, 1}).status(), Status::io_error);
    EXPECT_TRUE(pipe.sent.empty());
}

}  // namespace
}  // namespace fovea::test
