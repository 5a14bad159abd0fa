// SPDX-License-Identifier: MIT
//
// Calibrations as bytes: what a chip keeps in its flash or gets over a line, with a version and a checksum.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/crc32.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/camera/camera.hpp>
#include <fovea/camera/pose.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/number/real.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// One camera, or a pair.
struct CameraSet {
    int count = 1;
    Size sizes[2];  ///< of their pictures; 0x0 if that is not known
    Camera<> cameras[2];
    Pose<> right_from_left;  ///< of a pair: from the first camera's coordinates to the second's
};

/// What the bytes begin with: four letters and the version of all that follows.
inline constexpr std::uint8_t packed_camera_magic[4] = {'F', 'V', 'C', 'M'};
inline constexpr int packed_camera_version = 1;

/// The bytes of so many cameras: 106 of one, 320 of two.
constexpr std::ptrdiff_t packed_camera_bytes(int cameras);

/// Writes cameras as bytes, and answers how many.
///
/// Format  magic, version (1 byte), cameras (1), length of all (2), for each camera width and height (2 each)
///         and fx fy cx cy k1 k2 k3 p1 p2, for two the rotation row by row and the translation, CRC-32 of all
///         before it (4). A number has 10 bytes: 64 bits of mantissa m and 16 bits e; it is m 2^((e >> 1) -
///         16384 - 63), negative if e is odd; 0 is ten bytes 0. Of all, the low byte comes first
/// Errors  bad_argument for cameras that unpack_cameras() would not take; buffer_too_small
/// Source  numbers as they are, so that a chip calculates with the digits of the desk
constexpr Result<std::ptrdiff_t> pack_cameras(const CameraSet& set, Span<std::uint8_t> out);

/// Reads what pack_cameras() wrote. What is read can be worked with: focal lengths are above 0, numbers are 0
/// or from 2^-200 to 2^200, the rotation is one.
///
/// Errors  truncated for less than the bytes say; unsupported for another version; malformed for other bytes,
///         bytes behind the end, a wrong checksum, or numbers that no camera has. The set stays as it was
/// Source  pack_cameras()
constexpr Status unpack_cameras(Span<const std::uint8_t> bytes, CameraSet& set);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

inline constexpr std::ptrdiff_t packed_camera_head = 8;
inline constexpr std::ptrdiff_t packed_camera_tail = 4;
inline constexpr int packed_real_bytes = 10;
inline constexpr int packed_exponent_bias = 16384;

class CameraByteWriter {
public:
    constexpr explicit CameraByteWriter(Span<std::uint8_t> out) : out_(out) {}
    constexpr void whole(std::uint64_t value, int bytes) {
        for (int i = 0; i < bytes; ++i) out_[at_++] = static_cast<std::uint8_t>(value >> 8 * i);
    }
    constexpr void side(const int& value) { whole(static_cast<std::uint64_t>(value), 2); }
    constexpr void number(const Real& value) {
        whole(value.mantissa(), 8);
        const int scale =
            value.zero() ? 0 : 2 * (value.exponent() + packed_exponent_bias) + (value.negative() ? 1 : 0);
        whole(static_cast<std::uint64_t>(scale), 2);
    }
    constexpr std::ptrdiff_t size() const { return at_; }

private:
    Span<std::uint8_t> out_;
    std::ptrdiff_t at_ = 0;
};

class CameraByteReader {
public:
    constexpr explicit CameraByteReader(Span<const std::uint8_t> in) : in_(in) {}
    constexpr std::uint64_t whole(int bytes) {
        std::uint64_t value = 0;
        for (int i = 0; i < bytes; ++i) value |= std::uint64_t{in_[at_++]} << 8 * i;
        return value;
    }
    constexpr void side(int& value) { value = static_cast<int>(whole(2)); }
    constexpr void number(Real& value) {
        const std::uint64_t mantissa = whole(8);
        const auto scale = static_cast<int>(whole(2));
        const int exponent = (scale >> 1) - packed_exponent_bias;
        value = Real();
        if (mantissa == 0 && scale == 0) return;
        // Exponents of cameras are small; others would not be numbers to calculate with.
        if (mantissa >> 63 == 0 || exponent < -200 || exponent >= 200) {
            good_ = false;
            return;
        }
        // In two parts: integers of 64 bits with a sign have 63.
        const Real size = Real::from_int(static_cast<std::int64_t>(mantissa >> 1), exponent - 62) +
                          Real::from_int(static_cast<std::int64_t>(mantissa & 1), exponent - 63);
        value = (scale & 1) != 0 ? -size : size;
    }
    /// All numbers were some.
    constexpr bool good() const { return good_; }

private:
    Span<const std::uint8_t> in_;
    std::ptrdiff_t at_ = 0;
    bool good_ = true;
};

/// The fields in their order, for a writer and for a reader.
template <class Fields, class Set>
constexpr void camera_fields(Fields& fields, Set& set) {
    for (int i = 0; i < set.count; ++i) {
        fields.side(set.sizes[i].width);
        fields.side(set.sizes[i].height);
        auto& camera = set.cameras[i];
        fields.number(camera.fx);
        fields.number(camera.fy);
        fields.number(camera.cx);
        fields.number(camera.cy);
        fields.number(camera.k1);
        fields.number(camera.k2);
        fields.number(camera.k3);
        fields.number(camera.p1);
        fields.number(camera.p2);
    }
    if (set.count == 1) return;
    for (int i = 0; i < 9; ++i) fields.number(set.right_from_left.rotation(i / 3, i % 3));
    for (int i = 0; i < 3; ++i) fields.number(set.right_from_left.translation[i]);
}

/// Looks at fields in place of writing them.
struct CameraFieldCheck {
    bool good = true;
    constexpr void side(const int& value) { good = good && value >= 0 && value <= max_image_side; }
    constexpr void number(const Real& value) {
        good = good && (value.zero() || (value.exponent() >= -200 && value.exponent() < 200));
    }
};

constexpr bool are_cameras(const CameraSet& set) {
    if (set.count != 1 && set.count != 2) return false;
    CameraFieldCheck check;
    camera_fields(check, set);
    if (!check.good) return false;
    for (int i = 0; i < set.count; ++i) {
        if (!set.cameras[i].fx.positive() || !set.cameras[i].fy.positive()) return false;
        if ((set.sizes[i].width == 0) != (set.sizes[i].height == 0)) return false;
    }
    return set.count == 1 || is_rotation(set.right_from_left.rotation);
}

}  // namespace detail

constexpr std::ptrdiff_t packed_camera_bytes(int cameras) {
    constexpr int of_a_camera = 4 + 9 * detail::packed_real_bytes;
    constexpr int of_a_pose = 12 * detail::packed_real_bytes;
    return detail::packed_camera_head + detail::packed_camera_tail +
           (cameras == 2 ? 2 * of_a_camera + of_a_pose : of_a_camera);
}

constexpr Result<std::ptrdiff_t> pack_cameras(const CameraSet& set, Span<std::uint8_t> out) {
    if (!detail::are_cameras(set)) return Status::bad_argument;
    const std::ptrdiff_t size = packed_camera_bytes(set.count);
    if (out.size() < size) return Status::buffer_too_small;
    detail::CameraByteWriter writer(out);
    for (const std::uint8_t letter : packed_camera_magic) writer.whole(letter, 1);
    writer.whole(packed_camera_version, 1);
    writer.whole(static_cast<std::uint64_t>(set.count), 1);
    writer.whole(static_cast<std::uint64_t>(size), 2);
    detail::camera_fields(writer, set);
    writer.whole(crc32(Span<const std::uint8_t>(out.first(writer.size()))), 4);
    return size;
}

constexpr Status unpack_cameras(Span<const std::uint8_t> bytes, CameraSet& set) {
    for (std::ptrdiff_t i = 0; i < 4; ++i) {
        if (i >= bytes.size()) return Status::truncated;
        if (bytes[i] != packed_camera_magic[i]) return Status::malformed;
    }
    if (bytes.size() < detail::packed_camera_head) return Status::truncated;
    if (bytes[4] != packed_camera_version) return Status::unsupported;
    const int count = bytes[5];
    const std::ptrdiff_t size = bytes[6] | bytes[7] << 8;
    if ((count != 1 && count != 2) || size != packed_camera_bytes(count)) return Status::malformed;
    if (bytes.size() < size) return Status::truncated;
    if (bytes.size() > size) return Status::malformed;
    const std::ptrdiff_t end = size - detail::packed_camera_tail;
    if (detail::CameraByteReader(bytes.from(end)).whole(4) != crc32(bytes.first(end)))
        return Status::malformed;
    CameraSet found;
    found.count = count;
    detail::CameraByteReader reader(bytes.from(detail::packed_camera_head));
    detail::camera_fields(reader, found);
    if (!reader.good() || !detail::are_cameras(found)) return Status::malformed;
    set = found;
    return Status::ok;
}

}  // namespace fovea
