// SPDX-License-Identifier: MIT
//
// VideoSelection: which part of the sensor a V4L2 driver reads, and which part of the frame it fills.
#pragma once

#include <linux/videodev2.h>

#include <cstdint>

#include <fovea/image/geometry.hpp>
#include <fovea/linux/kernel.hpp>

namespace fovea::linux_port {

/// A driver may cut out a part of its sensor, or fill a part of the frame, as another program left it: vivid
/// still fills a small part after a larger size was set.
///
/// Source  the kernel's documentation of V4L2, "Selection API"
template <class System>
class VideoSelection {
public:
    VideoSelection(System& system, int file) : system_(&system), file_(file) {}

    /// Sets a rectangle to what another of the driver's has. Some know none, and have nothing to set.
    void adopt(std::uint32_t from, std::uint32_t target) const {
        v4l2_selection selection = named(from);
        if (call(VIDIOC_G_SELECTION, selection) < 0) return;
        selection.target = target;
        selection.flags = 0;
        static_cast<void>(call(VIDIOC_S_SELECTION, selection));
    }

    /// True if a rectangle is all of a frame of that size, or the driver has none.
    bool fills(std::uint32_t target, Size size) const {
        v4l2_selection selection = named(target);
        if (call(VIDIOC_G_SELECTION, selection) < 0) return true;
        return selection.r.left == 0 && selection.r.top == 0 &&
               selection.r.width == static_cast<std::uint32_t>(size.width) &&
               selection.r.height == static_cast<std::uint32_t>(size.height);
    }

private:
    static v4l2_selection named(std::uint32_t target) {
        v4l2_selection selection{};
        // Of the multi-planar kind too, by this name.
        selection.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
        selection.target = target;
        return selection;
    }
    int call(unsigned long request, v4l2_selection& selection) const {
        return uninterrupted([&] { return system_->ioctl(file_, request, &selection); });
    }

    System* system_;
    int file_;
};

}  // namespace fovea::linux_port
