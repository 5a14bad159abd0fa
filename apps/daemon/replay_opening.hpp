// SPDX-License-Identifier: MIT
//
// ReplayOpening: pictures of a file, a folder or a pipe in the place of a camera, as the settings name them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <fovea/base/status.hpp>
#include <fovea/hal/pixel_format.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/linux/device_identity.hpp>
#include <fovea/linux/fault.hpp>
#include <fovea/linux/kernel.hpp>
#include <fovea/linux/replay_source.hpp>

#include <daemon/settings.hpp>

namespace fovea::apps {

template <class System = linux_port::Kernel>
class ReplayOpening {
public:
    using Camera = linux_port::ReplaySource<System>;
    using Calls = System;
    /// Files wake nobody: they are looked at so often.
    static constexpr std::int64_t look_us = 10000;

    explicit ReplayOpening(const Settings& settings, System = {}) : settings_(settings) {
        const auto side = [](std::int64_t told) { return told > 0 ? static_cast<int>(told) : 2048; };
        size_ = {side(settings.camera.width), side(settings.camera.height)};
        // A file may be larger than the pixels of its picture, which may have colour.
        file_.resize(static_cast<std::size_t>(std::max(4 * size_.area(), std::int64_t{1} << 20)));
        const std::int64_t bytes = linux_port::replay_picture_bytes(hal::PixelFormat::gray8, size_);
        picture_.resize(static_cast<std::size_t>(std::max(bytes, 3 * size_.area())));
    }

    /// Errors  as ReplaySource::open() and start()
    Status operator()(Camera& source) {
        linux_port::ReplayOptions options;
        const bool raw = settings_.camera.format != hal::PixelFormat::none;
        if (raw) options.stream = {settings_.camera.format, size_, 0};
        if (settings_.camera.width > 0 && settings_.camera.height > 0) options.size = size_;
        options.interval_us = static_cast<std::int32_t>(1000000 / settings_.camera.rate_per_s);
        options.end = settings_.camera.replay_end;
        const auto span = [](std::vector<std::uint8_t>& memory) {
            return Span<std::uint8_t>(memory.data(), static_cast<std::ptrdiff_t>(memory.size()));
        };
        Status status = source.open(settings_.camera.replay.c_str(), options, {span(file_), span(picture_)});
        if (status == Status::ok) status = source.start();
        problem_.clear();
        if (status == Status::ok) return status;
        const linux_port::Fault& fault = source.fault();
        problem_.add(settings_.camera.replay.c_str()).add(": ").add(fault.call).add(": ");
        problem_.add(linux_port::reason(fault));
        advice_ = linux_port::advice(fault);
        return status;
    }

    static int file(const Camera&) { return -1; }
    const char* problem() const { return problem_.c_str(); }
    const char* advice() const { return advice_; }
    linux_port::DevicePath path() const { return linux_port::DevicePath(settings_.camera.replay.c_str()); }
    /// The largest that there is room for.
    Size size() const { return size_; }
    hal::PixelFormat format() const {
        const hal::PixelFormat raw = settings_.camera.format;
        return raw == hal::PixelFormat::none ? hal::PixelFormat::gray8 : raw;
    }
    const char* control_note() const { return ""; }

private:
    Settings settings_;
    Size size_;
    std::vector<std::uint8_t> file_;
    std::vector<std::uint8_t> picture_;
    Text<400> problem_;
    const char* advice_ = "";
};

}  // namespace fovea::apps
