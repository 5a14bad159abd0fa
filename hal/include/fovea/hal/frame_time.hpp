// SPDX-License-Identifier: MIT
//
// Numbers and time stamps as drivers give them, and what may be believed of them.
#pragma once

#include <cstdint>

namespace fovea::hal {

/// Holes in the numbering of frames. Numbers run over from 2^32 - 1 to 0.
class SequenceGaps {
public:
    /// Forgets the numbers before: the next frame is a first one.
    void restart() { started_ = false; }

    /// How many numbers are missing between the frame before and this one. A number that does not advance
    /// tells nothing: some drivers number every frame 0, and what steps back has been started anew.
    std::uint32_t before(std::uint32_t sequence) {
        const std::uint32_t step = sequence - last_;
        const bool counts = started_ && step != 0 && step < 0x80000000u;
        started_ = true;
        last_ = sequence;
        return counts ? step - 1 : 0;
    }

private:
    std::uint32_t last_ = 0;
    bool started_ = false;
};

/// The time of frames by the clock of their driver, corrected so far that none is of the future.
///
/// A stamp later than its arrival tells that the driver counts from another moment, by that much at least;
/// later stamps are set back by the most that was seen. One that lies in front of the start of the stream is
/// not believed, and the arrival stands for it.
class FrameStamps {
public:
    void restart(std::int64_t now_us) {
        start_us_ = now_us;
        ahead_us_ = 0;
    }

    /// When the frame of that stamp was taken; arrived_us is when it was seen.
    std::int64_t taken(std::int64_t stamp_us, std::int64_t arrived_us) {
        // Stamps are of 2^63 nanoseconds at most, so the difference has room.
        if (stamp_us - arrived_us > ahead_us_) ahead_us_ = stamp_us - arrived_us;
        const std::int64_t taken_us = stamp_us - ahead_us_;
        return taken_us < start_us_ ? arrived_us : taken_us;
    }

private:
    std::int64_t start_us_ = 0;
    std::int64_t ahead_us_ = 0;
};

}  // namespace fovea::hal
