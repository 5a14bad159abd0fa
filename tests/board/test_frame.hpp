// SPDX-License-Identifier: MIT
//
// Frames of a test camera: every byte follows from the frame's number, so that who receives one knows what it
// must hold.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace fovea::test {

using Bytes = std::vector<std::uint8_t>;

/// A picture format of the camera, by its word on command lines.
struct CameraMode {
    const char* name;
    char four_letters[5];  // as USB spells the format; none for MJPEG
    int width;
    int height;
    int bytes_per_pixel;  // 0: compressed
};

inline constexpr CameraMode camera_modes[] = {
    {"yuyv", "YUY2", 640, 360, 2}, {"grey", "Y8  ", 640, 480, 1}, {"mjpeg", "", 640, 480, 0}};
inline constexpr int camera_mode_count = 3;

/// The mode of a name, or nullptr.
inline const CameraMode* camera_mode(const char* name) {
    for (const CameraMode& mode : camera_modes)
        if (std::strcmp(mode.name, name) == 0) return &mode;
    return nullptr;
}

/// Bytes of a frame. Compressed ones change in length; they are no JPEG, and no driver looks into them.
inline std::size_t test_frame_bytes(const CameraMode& mode, std::uint32_t number) {
    if (mode.bytes_per_pixel == 0) return 20000 + number % 1000 * 7919 % 30000;
    return static_cast<std::size_t>(mode.width * mode.height * mode.bytes_per_pixel);
}

/// The frame's number in 4 bytes, the lowest first, and then bytes that only this frame has (xorshift32).
inline Bytes test_frame(const CameraMode& mode, std::uint32_t number) {
    Bytes frame(test_frame_bytes(mode, number));
    std::uint32_t x = number * 2654435761u | 1u;
    for (std::uint8_t& byte : frame) {
        x ^= x << 13;
        x ^= x >> 17;
        x ^= x << 5;
        byte = static_cast<std::uint8_t>(x);
    }
    for (std::size_t i = 0; i < 4; ++i) frame[i] = static_cast<std::uint8_t>(number >> 8 * i);
    return frame;
}

/// The number in a frame of at least 4 bytes.
inline std::uint32_t test_frame_number(const std::uint8_t* frame) {
    std::uint32_t number = 0;
    for (int i = 3; i >= 0; --i) number = number << 8 | frame[i];
    return number;
}

}  // namespace fovea::test
