// SPDX-License-Identifier: MIT
//
// What a USB video class camera says of itself (USB Device Class Definition for Video Devices 1.1): one video
// control interface with a sensor and a processing unit, one streaming interface with a bulk endpoint, modes.
#pragma once

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <string>

#include <board/test_frame.hpp>

namespace fovea::test {

inline constexpr std::uint32_t clock_hz = 48000000;
inline constexpr std::uint32_t frame_rates[] = {30, 15};
inline constexpr std::uint32_t frame_interval_100ns(std::uint32_t rate) { return 10000000 / rate; }
/// The units of the camera that have controls.
inline constexpr int camera_terminal = 1;
inline constexpr int processing_unit = 2;
inline constexpr int output_terminal = 3;
inline constexpr std::uint8_t stream_endpoint = 0x81;

/// A number of a descriptor and how many bytes it has there, the lowest first.
struct Field {
    std::uint32_t value;
    int bytes;
};
inline constexpr Field u8(std::uint32_t value) { return {value, 1}; }
inline constexpr Field u16(std::uint32_t value) { return {value, 2}; }
inline constexpr Field u32(std::uint32_t value) { return {value, 4}; }

inline void append(Bytes& list, Field field) {
    for (int i = 0; i < field.bytes; ++i) list.push_back(static_cast<std::uint8_t>(field.value >> 8 * i));
}

/// Adds a descriptor; its length goes before it.
inline void append(Bytes& list, std::uint8_t type, std::initializer_list<Field> fields) {
    const std::size_t start = list.size();
    list.push_back(0);
    list.push_back(type);
    for (const Field& field : fields) append(list, field);
    list[start] = static_cast<std::uint8_t>(list.size() - start);
}

inline void append(Bytes& list, const Bytes& more) { list.insert(list.end(), more.begin(), more.end()); }

inline std::uint32_t size_of(const Bytes& list) { return static_cast<std::uint32_t>(list.size()); }

enum DescriptorType : std::uint8_t {
    device_type = 1,
    configuration_type = 2,
    string_type = 3,
    interface_type = 4,
    endpoint_type = 5,
    association_type = 0x0b,
    video_type = 0x24  // its first field tells which
};

inline Bytes device_descriptor() {
    Bytes list;
    append(list, device_type,
           {u16(0x0200), u8(0xef), u8(2), u8(1), u8(64),  // USB 2.0, made of interfaces that belong together
            u16(0x1209), u16(0x0001), u16(0x0100),        // the number that open projects may use for tests
            u8(1), u8(2), u8(3), u8(1)});  // strings: maker, name, serial number; configurations
    return list;
}

inline Bytes string_descriptor(const std::string& text) {
    Bytes list;
    append(list, string_type, {});
    for (const char letter : text) append(list, u16(static_cast<unsigned char>(letter)));
    list[0] = static_cast<std::uint8_t>(list.size());
    return list;
}
inline Bytes language_descriptor() {
    Bytes list;
    append(list, string_type, {u16(0x0409)});
    return list;
}

/// The sensor with its exposure, the processing unit with brightness and gain, and where frames leave.
inline Bytes video_control() {
    Bytes units;
    append(units, video_type,
           {u8(2), u8(camera_terminal), u16(0x0201), u8(0), u8(0), u16(0), u16(0), u16(0), u8(3), u8(0x0a),
            u8(0), u8(0)});
    append(units, video_type,
           {u8(5), u8(processing_unit), u8(camera_terminal), u16(0), u8(3), u8(0x01), u8(0x02), u8(0), u8(0),
            u8(0)});
    append(units, video_type, {u8(3), u8(output_terminal), u16(0x0101), u8(0), u8(processing_unit), u8(0)});
    const std::uint32_t header_bytes = 13;
    Bytes list;
    append(list, interface_type, {u8(0), u8(0), u8(0), u8(0x0e), u8(1), u8(0), u8(0)});
    append(list, video_type,
           {u8(1), u16(0x0110), u16(header_bytes + size_of(units)), u32(clock_hz), u8(1), u8(1)});
    append(list, units);
    return list;
}

/// A mode's format and its one size. frame_bytes: the most that a frame has.
inline void append_mode(Bytes& list, const CameraMode& mode, int number, std::uint32_t frame_bytes) {
    const bool compressed = mode.bytes_per_pixel == 0;
    const std::uint32_t format = static_cast<std::uint32_t>(number);
    if (compressed) {
        append(list, video_type, {u8(6), u8(format), u8(1), u8(0), u8(1), u8(0), u8(0), u8(0), u8(0)});
    } else {
        std::uint32_t letters = 0;
        for (int i = 3; i >= 0; --i)
            letters = letters << 8 | static_cast<unsigned char>(mode.four_letters[i]);
        append(list, video_type,
               {u8(4), u8(format), u8(1), u32(letters), u16(0), u16(0x0010), u32(0xaa000080), u32(0x719b3800),
                u8(8 * static_cast<std::uint32_t>(mode.bytes_per_pixel)), u8(1), u8(0), u8(0), u8(0), u8(0)});
    }
    const std::uint32_t frame_bits = frame_bytes * 8;
    append(list, video_type,
           {u8(compressed ? 7 : 5), u8(1), u8(0), u16(static_cast<std::uint32_t>(mode.width)),
            u16(static_cast<std::uint32_t>(mode.height)), u32(frame_bits * frame_rates[1]),
            u32(frame_bits * frame_rates[0]), u32(frame_bytes), u32(frame_interval_100ns(frame_rates[0])),
            u8(2), u32(frame_interval_100ns(frame_rates[0])), u32(frame_interval_100ns(frame_rates[1]))});
}

/// frame_bytes: of each mode.
inline Bytes video_streaming(const std::uint32_t (&frame_bytes)[camera_mode_count]) {
    Bytes modes;
    for (int i = 0; i < camera_mode_count; ++i) append_mode(modes, camera_modes[i], i + 1, frame_bytes[i]);
    const std::uint32_t header_bytes = 13 + camera_mode_count;
    Bytes list;
    append(list, interface_type, {u8(1), u8(0), u8(1), u8(0x0e), u8(2), u8(0), u8(0)});
    append(list, video_type,
           {u8(1), u8(camera_mode_count), u16(header_bytes + size_of(modes)), u8(stream_endpoint), u8(0),
            u8(output_terminal), u8(0), u8(0), u8(0), u8(1), u8(0), u8(0), u8(0)});
    append(list, modes);
    append(list, endpoint_type, {u8(stream_endpoint), u8(2), u16(512), u8(0)});
    return list;
}

inline Bytes configuration_descriptor(const std::uint32_t (&frame_bytes)[camera_mode_count]) {
    Bytes inside;
    append(inside, association_type, {u8(0), u8(2), u8(0x0e), u8(3), u8(0), u8(0)});
    append(inside, video_control());
    append(inside, video_streaming(frame_bytes));
    const std::uint32_t header_bytes = 9;
    Bytes list;
    append(list, configuration_type,
           {u16(header_bytes + size_of(inside)), u8(2), u8(1), u8(0), u8(0x80), u8(250)});
    append(list, inside);
    return list;
}

}  // namespace fovea::test
