// SPDX-License-Identifier: MIT
//
// Frames: a camera of memory, for tests of what takes frames.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include <fovea/hal/frame_source.hpp>
#include <fovea/hal/lent_frame.hpp>
#include <fovea/hal/pixel_format.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/simulated/pins.hpp>

namespace fovea::simulated {

/// Shows pictures in turn, one each interval, stamped with its end. Time is that of the clock; waiting for a
/// frame lets it pass. As many frames as there are places wait to be taken, and those that find none are
/// lost. The frames of the numbers in `damaged` are kept back.
class Frames {
public:
    using Frame = hal::LentFrame<Frames>;

    Frames(std::vector<ImageView<const Gray8>> pictures, Clock& clock, std::int32_t interval_us = 40000)
        : pictures_(std::move(pictures)), clock_(clock), interval_us_(interval_us), begun_us_(clock.now) {}

    Status next(std::int64_t patience_us, Frame& frame) {
        return first(patience_us, frame, [](std::int64_t) { return true; });
    }
    Status latest(std::int64_t max_age_us, std::int64_t patience_us, Frame& frame) {
        return first(patience_us, frame, [&](std::int64_t taken_us) {
            return taken_us + interval_us_ > clock_.now && clock_.now - taken_us <= max_age_us;
        });
    }
    Status after(std::int64_t moment_us, std::int64_t patience_us, Frame& frame) {
        return first(patience_us, frame,
                     [&](std::int64_t taken_us) { return taken_us - interval_us_ >= moment_us; });
    }

    std::int32_t interval_us() const { return interval_us_; }
    const hal::FrameCounters& counters() const { return counters_; }
    /// Frames that are in use.
    int lent() const { return lent_; }

    std::set<std::uint32_t> damaged;
    int places = 4;
    bool silent = false;
    bool broken = false;
    bool gone = false;

private:
    friend Frame;
    void take_back(int) { --lent_; }

    std::int64_t taken_us(std::uint32_t number) const {
        return begun_us_ + (std::int64_t{number} + 1) * interval_us_;
    }

    template <class Wanted>
    Status first(std::int64_t patience_us, Frame& frame, Wanted wanted) {
        frame.give_back();
        const std::int64_t until_us = clock_.now + patience_us;
        for (;;) {
            if (gone) return Status::device_lost;
            if (broken) return Status::io_error;
            if (silent || taken_us(number_) > clock_.now) {
                // Who waits sees the frame at the moment when it is there.
                clock_.now = std::max(clock_.now, silent ? until_us : std::min(until_us, taken_us(number_)));
                if (silent || taken_us(number_) > clock_.now) return Status::timeout;
            }
            // Those for which there was no place.
            while (lent_ + places <= 0 ||
                   taken_us(number_ + static_cast<std::uint32_t>(places - lent_)) <= clock_.now) {
                ++number_;
                ++counters_.missed;
            }
            const std::uint32_t number = number_++;
            if (damaged.count(number) != 0) {
                ++counters_.damaged;
            } else if (!wanted(taken_us(number))) {
                ++counters_.passed_over;
            } else {
                ++counters_.lent;
                return lend(number, frame);
            }
        }
    }
    Status lend(std::uint32_t number, Frame& frame) {
        const ImageView<const Gray8> picture = pictures_[number % pictures_.size()];
        const std::ptrdiff_t bytes = picture.stride_bytes() * (picture.height() - 1) + picture.width();
        hal::FrameInfo info;
        info.format = hal::PixelFormat::gray8;
        info.size = picture.size();
        info.planes[0] = {{picture.first(), bytes}, picture.stride_bytes()};
        info.sequence = number;
        info.time_us = taken_us(number);
        frame.lend(*this, 0, info);
        ++lent_;
        return Status::ok;
    }

    std::vector<ImageView<const Gray8>> pictures_;
    Clock& clock_;
    std::int32_t interval_us_;
    std::int64_t begun_us_;
    std::uint32_t number_ = 0;
    int lent_ = 0;
    hal::FrameCounters counters_;
};

static_assert(hal::is_frame_source_v<Frames>);

}  // namespace fovea::simulated
