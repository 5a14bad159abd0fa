// SPDX-License-Identifier: MIT
//
// Pictures through the kernel: what an output of the driver vivid shows is what the camera port lends, in
// every format. usage: pictures_on_board        with vivid's input looped to its output, /dev/video0 and
// /dev/video1
#include <linux/videodev2.h>

#include <cstdint>
#include <string>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/linux/v4l2_camera.hpp>
#include <fovea/linux/video_controls.hpp>

#include "board/proof.hpp"
#include "board/video_output.hpp"

namespace fovea::board {
namespace {

using linux_port::V4l2Camera;
using linux_port::VideoFormat;

bool set_control(int file, const char* name, std::int64_t value) {
    linux_port::Kernel kernel;
    linux_port::ControlSetting setting;
    setting.name = name;
    setting.value = value;
    linux_port::Fault fault;
    return set_controls(kernel, file, {&setting, 1}, fault) == Status::ok;
}

/// The bytes of a plane of memory, as they were painted.
using Picture = std::vector<std::vector<std::uint8_t>>;

/// How many bytes of a frame's rows are not those of the picture.
int wrong_bytes(const hal::FrameInfo& info, const Picture& picture) {
    int wrong = 0;
    std::size_t begin = 0;
    for (int p = 0; p < hal::plane_count(info.format); ++p) {
        const auto& bytes = picture[picture.size() > 1 ? static_cast<std::size_t>(p) : 0];
        const auto stride = static_cast<std::size_t>(info.planes[p].stride_bytes);
        const auto rows = static_cast<std::size_t>(hal::plane_rows(info.format, p, info.size.height));
        const auto row = static_cast<std::size_t>(hal::row_bytes(info.format, p, info.size.width));
        for (std::size_t y = 0; y < rows; ++y)
            for (std::size_t x = 0; x < row; ++x)
                wrong += info.planes[p].bytes.data()[y * stride + x] != bytes[begin + y * stride + x] ? 1 : 0;
        begin = picture.size() > 1 ? 0 : begin + stride * rows;
    }
    return wrong;
}

/// Shows pictures of random bytes, and reads each of them. How many were read as they were painted.
int exact_pictures(V4l2Camera<>& camera, VideoOutput& output, int count, Random& random) {
    int exact = 0;
    for (int k = 0; k < count; ++k) {
        Picture picture;
        const int shown = output.show([&](int, Span<std::uint8_t> bytes) {
            for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.below(256));
            picture.emplace_back(bytes.begin(), bytes.end());
        });
        if (shown < 0) break;
        if (k == 0) continue;
        // The one before is on show now, or this one: both have been painted, and the newest wins in the end.
        V4l2Camera<>::Frame frame;
        for (int tries = 0; tries < 10; ++tries) {
            if (camera.latest(1000000, 1000000, frame) != Status::ok) break;
            if (wrong_bytes(frame.info(), picture) != 0) continue;
            ++exact;
            break;
        }
    }
    return exact;
}

void every_format(Proof& proof) {
    Random random(20251);
    int formats = 0;
    for (const VideoFormat& known : linux_port::video_formats) {
        if (known.format == hal::PixelFormat::mjpeg) continue;
        V4l2Camera<> camera;
        if (!proof.status(camera.open("/dev/video0"), Status::ok, "open")) return;
        const bool multi = (camera.capability().device_caps & V4L2_CAP_VIDEO_CAPTURE_MPLANE) != 0;
        if (known.memory_planes > 1 && !multi) continue;
        proof.check(
            set_control(camera.file(), "Loop Video", 1) && set_control(camera.file(), "OSD Text Mode", 2),
            "the loop is set");
        const std::string name = std::string(describe(known.format)) +
                                 (known.memory_planes > 1 ? ", planes apart" : "") +
                                 (multi ? ", multi-planar driver" : "");
        for (const Size size : {Size{640, 360}, Size{322, 182}}) {
            VideoOutput output;
            const int opened = output.open("/dev/video1", known.code, size, multi);
            if (!proof.equal(opened, 0, name + ": the output")) continue;
            Status got = camera.configure(known.code, size, 0);
            // A picture must be on show before the input has a signal.
            const int shown = output.show([](int, Span<std::uint8_t> bytes) {
                for (std::uint8_t& byte : bytes) byte = 0;
            });
            if (got == Status::ok) got = camera.start();
            if (!proof.check(got == Status::ok && shown == 0, name + ": start",
                             std::string(camera.fault().call) + ": " + reason(camera.fault())))
                continue;
            const int exact = exact_pictures(camera, output, 6, random);
            proof.equal(exact, 5,
                        name + ": pictures as they were painted at width " + std::to_string(size.width));
            camera.stop();
        }
        ++formats;
    }
    proof.figure("formats in which pictures pass the kernel bit by bit", formats, "");
    proof.check(formats >= 14, "all formats were there");
}

}  // namespace
}  // namespace fovea::board

int main() {
    fovea::board::Proof proof;
    fovea::board::every_format(proof);
    return proof.end();
}
