// SPDX-License-Identifier: MIT
//
// Seeded random numbers, the same on every machine.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/assert.hpp>

namespace fovea {

/// PCG32 (XSH-RR 64/32): 64 bits of state, 32 bits a draw.
///
/// Source  O'Neill, "PCG: A Family of Simple Fast Space-Efficient Statistically Good Algorithms for Random
///         Number Generation", HMC-CS-2014-0905, section 6.3
class Random {
public:
    explicit constexpr Random(std::uint64_t seed, std::uint64_t stream = 1) : increment_(stream << 1 | 1) {
        next();
        state_ += seed;
        next();
    }

    constexpr std::uint32_t next() {
        const std::uint64_t old = state_;
        state_ = old * 6364136223846793005u + increment_;
        const std::uint32_t mixed = static_cast<std::uint32_t>((old >> 18 ^ old) >> 27);
        const std::uint32_t turn = static_cast<std::uint32_t>(old >> 59);
        return mixed >> turn | mixed << (-turn & 31);
    }

    /// A number 0..bound-1, without the bias of a remainder.
    constexpr std::uint32_t below(std::uint32_t bound) {
        FOVEA_ASSERT(bound > 0);
        const std::uint32_t reject = (0u - bound) % bound;
        std::uint32_t draw = next();
        while (draw < reject) draw = next();
        return draw % bound;
    }

    /// A number low..high, both included; not all of the 2^32 numbers there are.
    constexpr int between(int low, int high) {
        // Unsigned, because high - low may exceed an int.
        const std::uint32_t first = static_cast<std::uint32_t>(low);
        return static_cast<int>(first + below(static_cast<std::uint32_t>(high) - first + 1));
    }

private:
    std::uint64_t state_ = 0;
    std::uint64_t increment_;
};

/// Different numbers 0..bound-1, ascending. bound is at least N.
template <std::size_t N>
constexpr void draw_different(Random& random, std::ptrdiff_t bound, std::ptrdiff_t (&chosen)[N]) {
    const int count = static_cast<int>(N);
    for (int k = 0; k < count; ++k) {
        auto next = static_cast<std::ptrdiff_t>(random.below(static_cast<std::uint32_t>(bound - k)));
        int place = 0;
        while (place < k && next >= chosen[place]) {
            ++next;
            ++place;
        }
        for (int i = k; i > place; --i) chosen[i] = chosen[i - 1];
        chosen[place] = next;
    }
}

}  // namespace fovea
