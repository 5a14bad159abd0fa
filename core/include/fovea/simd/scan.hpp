// SPDX-License-Identifier: MIT
//
// The next bright or dark byte of a row, where the processor looks at a word of them at once.
#pragma once

#include <cstdint>
#include <cstring>

#include <fovea/simd/isa.hpp>

namespace fovea {
inline namespace FOVEA_ISA {
namespace simd {

// ---- Interface --------------------------------------------------------------------

/// The first place from x on, below end, whose byte is at least level, 1..255; end if there is none.
inline int find_at_least(const std::uint8_t* row, int x, int end, int level);

/// The first place from x on, below end, whose byte is below level, 1..255; end if there is none.
inline int find_below(const std::uint8_t* row, int x, int end, int level);

// ---- Implementation ---------------------------------------------------------------

/// As many bytes as an address has.
using ScanWord = std::uintptr_t;
inline constexpr ScanWord each_byte = static_cast<ScanWord>(0x0101010101010101);

/// Of every byte the highest bit: whether the byte is at least level. With seven bits of each byte no sum
/// reaches the next one.
inline ScanWord bytes_at_least(ScanWord word, int level) {
    const ScanWord low = word & 0x7f * each_byte;
    const ScanWord high = word & 0x80 * each_byte;
    const ScanWord reaches = low + static_cast<ScanWord>((256 - level) & 0x7f) * each_byte;
    return (level <= 128 ? reaches | high : reaches & high) & 0x80 * each_byte;
}

template <bool Bright>
int find_byte(const std::uint8_t* row, int x, int end, int level) {
    constexpr int bytes = sizeof(ScanWord);
    const auto found = [=](int place) { return (row[place] >= level) == Bright; };
    // Words begin where the processor reads them with one instruction.
    for (; x < end && reinterpret_cast<std::uintptr_t>(row + x) % sizeof(ScanWord) != 0; ++x)
        if (found(x)) return x;
    for (; x + bytes <= end; x += bytes) {
        ScanWord word;
        std::memcpy(&word, __builtin_assume_aligned(row + x, sizeof word), sizeof word);
        if (bytes_at_least(word, level) != (Bright ? 0 : 0x80 * each_byte)) break;
    }
    while (x < end && !found(x)) ++x;
    return x;
}

inline int find_at_least(const std::uint8_t* row, int x, int end, int level) {
    return find_byte<true>(row, x, end, level);
}

inline int find_below(const std::uint8_t* row, int x, int end, int level) {
    return find_byte<false>(row, x, end, level);
}

}  // namespace simd
}  // namespace FOVEA_ISA
}  // namespace fovea
