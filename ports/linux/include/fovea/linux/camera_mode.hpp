// SPDX-License-Identifier: MIT
//
// CameraMode: what a camera can send, and which of it is chosen.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/hal/pixel_format.hpp>
#include <fovea/image/geometry.hpp>

namespace fovea::linux_port {

/// A format with a size, or with a range of sizes, and how fast it comes.
struct CameraMode {
    std::uint32_t code = 0;
    hal::PixelFormat format = hal::PixelFormat::none;
    Size smallest;
    Size largest;
    Size step = {1, 1};
    /// From frame to frame, at the highest rate; 0 where the driver does not say.
    std::int32_t interval_us = 0;
};

/// What a job wants of a camera.
struct CameraWish {
    /// {0, 0}: the largest that is fast enough. Any other is that size or none.
    Size size;
    /// none: any that serves.
    hal::PixelFormat format = hal::PixelFormat::none;
    /// From frame to frame, at most.
    std::int32_t interval_us = 100000;
    bool colour = false;
};

enum class CameraReason : std::uint8_t {
    best,         ///< the best of those that are fast enough
    slow,         ///< none is fast enough: the fastest
    no_modes,     ///< the camera offers nothing that can be read
    no_format,    ///< not in the format wished for, or not in colour
    no_such_size  ///< not in the size wished for
};

constexpr const char* describe(CameraReason reason) {
    switch (reason) {
        case CameraReason::best: return "the best of those that are fast enough";
        case CameraReason::slow: return "none is as fast as wished: the fastest";
        case CameraReason::no_modes: return "the camera offers no format that can be read";
        case CameraReason::no_format: return "the camera does not offer this format";
        case CameraReason::no_such_size: return "the camera does not offer this size in such a format";
    }
    return "";
}

/// The mode chosen: its place in the list, or -1 and why there is none.
struct CameraChoice {
    int index = -1;
    Size size;
    CameraReason reason = CameraReason::no_modes;
};

/// How much work a format is before gray pixels are at hand: less is better.
constexpr int camera_work(hal::PixelFormat format, bool colour) {
    using hal::PixelFormat;
    switch (format) {
        case PixelFormat::gray8: return 0;
        case PixelFormat::nv12: return colour ? 4 : 1;  // its luma lies by itself
        case PixelFormat::yuyv:
        case PixelFormat::uyvy: return 3;
        case PixelFormat::gray16:
        case PixelFormat::gray12:
        case PixelFormat::gray10: return 4;
        case PixelFormat::rgb24: return colour ? 0 : 5;
        case PixelFormat::bgr24: return colour ? 2 : 5;
        case PixelFormat::rgb565: return 6;
        case PixelFormat::bayer_rggb:
        case PixelFormat::bayer_grbg:
        case PixelFormat::bayer_gbrg:
        case PixelFormat::bayer_bggr: return 7;
        case PixelFormat::mjpeg: return 8;  // a decoder's work, and not what the sensor saw
        case PixelFormat::none: break;
    }
    return 9;
}

/// True if the mode has frames of that size.
constexpr bool offers(const CameraMode& mode, Size size) {
    const auto along = [](int smallest, int largest, int step, int value) {
        return value >= smallest && value <= largest && (step <= 1 || (value - smallest) % step == 0);
    };
    return along(mode.smallest.width, mode.largest.width, mode.step.width, size.width) &&
           along(mode.smallest.height, mode.largest.height, mode.step.height, size.height);
}

/// Chooses among the modes of a camera.
///
/// Of the modes in the format and size wished for, in this order: those that are fast enough, where the
/// driver says so; the largest, if no size is wished for; the least work before gray (or coloured) pixels are
/// at hand, which puts MJPEG last; the fastest; the first. If none is fast enough, the fastest comes first.
constexpr CameraChoice choose_mode(Span<const CameraMode> modes, const CameraWish& wish) {
    struct Rank {
        bool fast;
        std::int64_t area;
        int work;
        std::int32_t interval_us;

        constexpr bool before(const Rank& other) const {
            if (fast != other.fast) return fast;
            if (!fast && interval_us != other.interval_us) return interval_us < other.interval_us;
            if (area != other.area) return area > other.area;
            if (work != other.work) return work < other.work;
            return interval_us < other.interval_us;
        }
    };
    CameraChoice choice;
    Rank best{};
    if (modes.size() > 0) choice.reason = CameraReason::no_format;
    for (int k = 0; k < modes.size(); ++k) {
        const CameraMode& mode = modes[k];
        if (wish.format != hal::PixelFormat::none && mode.format != wish.format) continue;
        if (wish.colour && !hal::coloured(mode.format)) continue;
        const bool any_size = wish.size.width == 0 && wish.size.height == 0;
        if (!any_size && !offers(mode, wish.size)) {
            if (choice.index < 0) choice.reason = CameraReason::no_such_size;
            continue;
        }
        const Size size = any_size ? mode.largest : wish.size;
        const Rank rank{mode.interval_us <= wish.interval_us, std::int64_t{size.width} * size.height,
                        camera_work(mode.format, wish.colour), mode.interval_us};
        if (choice.index >= 0 && !rank.before(best)) continue;
        choice = {k, size, rank.fast ? CameraReason::best : CameraReason::slow};
        best = rank;
    }
    return choice;
}

}  // namespace fovea::linux_port
