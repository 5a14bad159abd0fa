// SPDX-License-Identifier: MIT
//
// DeflateMatches: where the next bytes stood before, for deflate.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/codec/zlib.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

/// So many bytes as stood at such a distance before.
struct DeflateMatch {
    int length = 0;
    int distance = 0;
};

/// Chains of places that begin alike, over a buffer of WindowBytes past bytes and as many new ones.
///
/// Every place is entered at most once, in rising order. An entry is 16 bits of a running count; a stale or
/// empty one names some place inside the window whose bytes are compared like all others, so it costs time
/// and nothing else.
///
/// Memory  scratch_bytes, given by the caller at any alignment
template <int WindowBytes, int HashBits>
class DeflateMatches {
public:
    static_assert(WindowBytes <= Deflate::window_bytes && (WindowBytes & (WindowBytes - 1)) == 0,
                  "the window is a power of two that deflate can reach over");
    static constexpr int scratch_bytes = 2 * ((1 << HashBits) + WindowBytes);
    /// Shorter matches are not found: with codes of their own, three literals are seldom longer.
    static constexpr int shortest_match = 4;

    explicit DeflateMatches(std::uint8_t* scratch) : heads_(scratch), chain_(scratch + (2 << HashBits)) {
        std::memset(scratch, 0, scratch_bytes);
    }

    /// Enters the place `at` and answers the longest match that begins there, or length 0. At most `most`
    /// bytes long, from at most `reach` before, after `depth` tries; one of `enough` bytes ends the search.
    DeflateMatch find(const std::uint8_t* buffer, int at, int most, int reach, int depth, int enough);

    /// Enters a place that a match covers. Four bytes must stand there.
    void enter(const std::uint8_t* buffer, int at) { static_cast<void>(entered(buffer, at)); }

    /// The new bytes have become the past ones.
    void advance() { base_ += WindowBytes; }

private:
    /// The place that began alike before.
    std::uint32_t entered(const std::uint8_t* buffer, int at) {
        const std::uint8_t* bytes = buffer + at;
        const std::uint32_t four = std::uint32_t{bytes[0]} | std::uint32_t{bytes[1]} << 8 |
                                   std::uint32_t{bytes[2]} << 16 | std::uint32_t{bytes[3]} << 24;
        // Fibonacci hashing: 2^32 divided by the golden ratio, odd.
        const auto hash = static_cast<std::ptrdiff_t>(four * 2654435769u >> (32 - HashBits));
        const std::uint32_t place = base_ + static_cast<std::uint32_t>(at);
        const std::uint32_t before = heads_[hash];
        chain_.put(static_cast<std::ptrdiff_t>(place % WindowBytes), before);
        heads_.put(hash, place & 0xffff);
        return before;
    }

    PackedNumbers heads_;
    PackedNumbers chain_;
    std::uint32_t base_ = 0;  ///< the running count of the buffer's first byte
};

// ---- Implementation ---------------------------------------------------------------

template <int WindowBytes, int HashBits>
DeflateMatch DeflateMatches<WindowBytes, HashBits>::find(const std::uint8_t* buffer, int at, int most,
                                                         int reach, int depth, int enough) {
    if (most < shortest_match) return {};
    DeflateMatch best{shortest_match - 1, 0};
    const std::uint32_t here = base_ + static_cast<std::uint32_t>(at);
    std::uint32_t place = entered(buffer, at);
    const std::uint8_t* bytes = buffer + at;
    for (int distance = 0; depth > 0; --depth) {
        const int next = static_cast<int>((here - place) & 0xffff);
        // A chain leads backwards; where it does not, it has ended.
        if (next <= distance || next > reach) break;
        distance = next;
        const std::uint8_t* other = bytes - distance;
        if (other[best.length] == bytes[best.length]) {
            int length = 0;
            while (length < most && other[length] == bytes[length]) ++length;
            if (length > best.length) best = {length, distance};
            if (length >= minimum(most, enough)) break;
        }
        place = chain_[static_cast<std::ptrdiff_t>(place % WindowBytes)];
    }
    return best.distance == 0 ? DeflateMatch{} : best;
}

}  // namespace fovea
