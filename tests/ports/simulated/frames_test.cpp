// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>

#include <fovea/simulated/frames.hpp>
#include <support/frame_source_contract.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

struct Rig {
    Rig() {
        first(0, 0) = 1;
        second(0, 0) = 2;
    }
    simulated::Frames& source() { return frames; }
    std::int64_t now_us() const { return clock.now; }
    std::int32_t interval_us() const { return frames.interval_us(); }
    void pass(std::int64_t us) { clock.now += us; }

    GuardedImage<Gray8> first{{3, 2}};
    GuardedImage<Gray8> second{{3, 2}};
    simulated::Clock clock;
    simulated::Frames frames{{first.view(), second.view()}, clock};
};

TEST(SimulatedFrames, KeepTheContract) {
    Rig order;
    expect_frames_in_their_order(order);
    Rig newest;
    expect_the_newest_of_those_that_wait(newest);
    Rig behind;
    expect_a_frame_from_behind_a_moment(behind);
}

TEST(SimulatedFrames, ShowPicturesInTurnAndKeepBackWhatIsDamaged) {
    Rig rig;
    rig.frames.damaged = {1, 3};
    simulated::Frames::Frame frame;
    for (const std::uint32_t number : {0u, 2u, 4u, 5u}) {
        ASSERT_EQ(rig.frames.next(1000000, frame), Status::ok);
        EXPECT_EQ(frame.info().sequence, number);
        EXPECT_EQ(frame.info().planes[0].bytes[0], number % 2 == 0 ? 1 : 2);
        EXPECT_EQ(frame.info().time_us, 40000 * (std::int64_t{number} + 1));
        EXPECT_EQ(rig.frames.lent(), 1);
    }
    frame.give_back();
    EXPECT_EQ(rig.frames.lent(), 0);
    EXPECT_EQ(rig.frames.counters().damaged, 2u);
}

TEST(SimulatedFrames, LoseWhatFindsNoPlace) {
    Rig rig;
    rig.pass(1000000);  // 25 frames
    simulated::Frames::Frame frame;
    ASSERT_EQ(rig.frames.next(0, frame), Status::ok);
    EXPECT_EQ(frame.info().sequence, 21u);
    EXPECT_EQ(rig.frames.counters().missed, 21u);
}

TEST(SimulatedFrames, SayWhatIsWrong) {
    Rig rig;
    simulated::Frames::Frame frame;
    rig.frames.silent = true;
    EXPECT_EQ(rig.frames.next(500, frame), Status::timeout);
    EXPECT_EQ(rig.clock.now, 500);
    rig.frames.broken = true;
    EXPECT_EQ(rig.frames.next(500, frame), Status::io_error);
    rig.frames.gone = true;
    EXPECT_EQ(rig.frames.latest(1, 500, frame), Status::device_lost);
}

}  // namespace
}  // namespace fovea::test
