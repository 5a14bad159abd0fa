// SPDX-License-Identifier: MIT
//
// Systick: the clock of a Cortex-M (ARMv7-M Architecture Reference Manual, B3.3), by an interrupt every
// millisecond.
#pragma once

#include <cstdint>

#include <fovea/bare_metal/register.hpp>
#include <fovea/hal/clock.hpp>

extern "C" {
/// Milliseconds since the clock began; the interrupt counts them. One clock a program.
inline volatile std::uint32_t fovea_milliseconds = 0;
inline volatile std::uint32_t fovea_milliseconds_high = 0;
}

namespace fovea::bare_metal {

class Systick {
public:
    explicit Systick(std::uint32_t clock_hz) : ticks_(clock_hz / 1000) {
        word_at(reload) = ticks_ - 1;
        word_at(value) = 0;
        word_at(control) = 7;  // on, interrupt, clock of the processor
    }
    std::int64_t microseconds() {
        // An interrupt between the reads shows in the milliseconds: then once more.
        for (;;) {
            const std::uint32_t high = fovea_milliseconds_high;
            const std::uint32_t low = fovea_milliseconds;
            const std::uint32_t left = word_at(value);
            if (low != fovea_milliseconds || high != fovea_milliseconds_high) continue;
            const std::int64_t whole = static_cast<std::int64_t>(std::uint64_t{high} << 32 | low);
            const std::int64_t now = whole * 1000 + (ticks_ - 1 - left) * 1000 / ticks_;
            // The counter may have begun anew before its interrupt came.
            if (now >= last_) last_ = now;
            return last_;
        }
    }

private:
    static constexpr std::uintptr_t control = 0xE000E010, reload = 0xE000E014, value = 0xE000E018;
    std::uint32_t ticks_;
    std::int64_t last_ = 0;
};

static_assert(hal::is_clock_v<Systick>);

/// What the interrupt does.
inline void count_millisecond() {
    const std::uint32_t next = fovea_milliseconds + 1;
    if (next == 0) fovea_milliseconds_high = fovea_milliseconds_high + 1;
    fovea_milliseconds = next;
}

}  // namespace fovea::bare_metal
