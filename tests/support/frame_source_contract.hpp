// SPDX-License-Identifier: MIT
//
// What every source of frames answers, as hal/frame_source.hpp says: run with the sources of all ports.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>

#include <fovea/base/status.hpp>
#include <fovea/hal/frame_source.hpp>

namespace fovea::test {

/// rig.source() has begun to stream, and if its first frame is there at once, that was taken;
/// rig.interval_us() is from frame to frame; rig.pass(us) lets time pass.
template <class Rig>
void expect_frames_in_their_order(Rig& rig) {
    auto& source = rig.source();
    typename std::remove_reference_t<decltype(source)>::Frame frame;
    EXPECT_EQ(source.next(0, frame), Status::timeout) << "nothing was taken yet";
    const std::uint64_t lent = source.counters().lent;
    std::int64_t last_us = 0;
    for (int k = 0; k < 50; ++k) {
        // The frame before is given back by the next call: there are fewer places than frames here.
        ASSERT_EQ(source.next(10 * rig.interval_us(), frame), Status::ok);
        const hal::FrameInfo& info = frame.info();
        EXPECT_EQ(info.sequence, lent + static_cast<std::uint64_t>(k));
        EXPECT_LE(info.time_us, rig.now_us());
        EXPECT_GT(info.time_us, last_us);
        last_us = info.time_us;
        for (int p = 0; p < hal::plane_count(info.format); ++p) {
            const int rows = hal::plane_rows(info.format, p, info.size.height);
            EXPECT_GE(info.planes[p].bytes.size(), info.planes[p].stride_bytes * (rows - 1) +
                                                       hal::row_bytes(info.format, p, info.size.width));
        }
        EXPECT_EQ(source.next(0, frame), Status::timeout) << "each comes once";
    }
    EXPECT_EQ(source.counters().lent, lent + 50);
}

template <class Rig>
void expect_the_newest_of_those_that_wait(Rig& rig) {
    auto& source = rig.source();
    typename std::remove_reference_t<decltype(source)>::Frame frame;
    const std::uint64_t lent = source.counters().lent;
    for (int k = 0; k < 20; ++k) {
        // A load that takes longer than frames do.
        rig.pass(3 * rig.interval_us() + 777);
        ASSERT_EQ(source.latest(3 * rig.interval_us() / 2, rig.interval_us(), frame), Status::ok);
        EXPECT_LE(rig.now_us() - frame.info().time_us, 3 * rig.interval_us() / 2);
    }
    const hal::FrameCounters& counters = source.counters();
    EXPECT_EQ(counters.lent, lent + 20);
    EXPECT_GT(counters.passed_over + counters.missed, 35u);
    EXPECT_EQ(counters.lent + counters.passed_over + counters.missed + counters.damaged,
              std::uint64_t{frame.info().sequence} + 1);
}

template <class Rig>
void expect_a_frame_from_behind_a_moment(Rig& rig) {
    auto& source = rig.source();
    typename std::remove_reference_t<decltype(source)>::Frame frame;
    for (int k = 0; k < 20; ++k) {
        rig.pass(rig.interval_us() * k / 7 + 1);
        const std::int64_t moment_us = rig.now_us();
        ASSERT_EQ(source.after(moment_us, 3 * rig.interval_us(), frame), Status::ok);
        EXPECT_GE(frame.info().time_us, moment_us);
    }
}

}  // namespace fovea::test
