// SPDX-License-Identifier: MIT
//
// Angles as fractions of a turn: they wrap for free and never leave their range.
#pragma once

#include <cstdint>

#include <fovea/number/integer.hpp>

namespace fovea {

/// A direction in the image in 1/65536 turn (0.0055 degrees). Positive turns +x towards +y: clockwise on
/// screen.
class Angle {
public:
    constexpr Angle() = default;
    static constexpr Angle from_raw(std::uint16_t raw) {
        Angle angle;
        angle.raw_ = raw;
        return angle;
    }
    static constexpr Angle from_degrees(int degrees) {
        return from_raw(
            static_cast<std::uint16_t>(round_divide(std::int64_t{degrees} * 65536, std::int64_t{360})));
    }
    constexpr std::uint16_t raw() const { return raw_; }
    /// -32768..32767: the angle in -180 up to just below 180 degrees.
    constexpr std::int16_t signed_raw() const { return static_cast<std::int16_t>(raw_); }

    friend constexpr Angle operator+(Angle a, Angle b) {
        return from_raw(static_cast<std::uint16_t>(a.raw_ + b.raw_));
    }
    friend constexpr Angle operator-(Angle a, Angle b) {
        return from_raw(static_cast<std::uint16_t>(a.raw_ - b.raw_));
    }
    friend constexpr bool operator==(Angle a, Angle b) { return a.raw_ == b.raw_; }
    friend constexpr bool operator!=(Angle a, Angle b) { return a.raw_ != b.raw_; }

private:
    std::uint16_t raw_ = 0;
};

/// The same in 1/2^32 turn (8.4e-8 degrees), for what is measured and carried over many pixels.
class FineAngle {
public:
    constexpr FineAngle() = default;
    constexpr FineAngle(Angle angle) : raw_(static_cast<std::uint32_t>(angle.raw()) << 16) {}
    static constexpr FineAngle from_raw(std::uint32_t raw) {
        FineAngle angle;
        angle.raw_ = raw;
        return angle;
    }
    static constexpr FineAngle half_turn() { return from_raw(0x80000000u); }
    static constexpr FineAngle quarter_turn() { return from_raw(0x40000000u); }
    /// Millionths of a degree, rounded; any number of turns.
    static constexpr FineAngle from_microdegrees(std::int64_t microdegrees) {
        const std::int64_t turn = 360000000;
        const std::int64_t part = floor_modulo(microdegrees, turn);
        return from_raw(static_cast<std::uint32_t>(round_divide(part << 32, turn)));
    }
    constexpr std::uint32_t raw() const { return raw_; }
    constexpr std::int32_t signed_raw() const { return static_cast<std::int32_t>(raw_); }
    /// The nearest Angle.
    constexpr Angle coarse() const {
        return Angle::from_raw(static_cast<std::uint16_t>((raw_ + 0x8000u) >> 16));
    }
    /// -180000000 to 180000000: millionths of a degree, rounded; just below half a turn gives 180000000.
    constexpr std::int32_t microdegrees() const {
        return static_cast<std::int32_t>(round_shift(std::int64_t{signed_raw()} * 360000000, 32));
    }

    friend constexpr FineAngle operator+(FineAngle a, FineAngle b) { return from_raw(a.raw_ + b.raw_); }
    friend constexpr FineAngle operator-(FineAngle a, FineAngle b) { return from_raw(a.raw_ - b.raw_); }
    friend constexpr FineAngle operator-(FineAngle a) { return from_raw(0u - a.raw_); }
    friend constexpr bool operator==(FineAngle a, FineAngle b) { return a.raw_ == b.raw_; }
    friend constexpr bool operator!=(FineAngle a, FineAngle b) { return a.raw_ != b.raw_; }

private:
    std::uint32_t raw_ = 0;
};

}  // namespace fovea
