// SPDX-License-Identifier: MIT
//
// Sums over the short stretches of a row, a word of bytes at a time.
#pragma once

#include <cstdint>
#include <cstring>

#include <fovea/simd/isa.hpp>

namespace fovea {
inline namespace FOVEA_ISA {
namespace simd {

// ---- Interface --------------------------------------------------------------------

/// The most bytes of a stretch: 256 times 255 are below 2^16.
inline constexpr int most_stretch = 256;

/// Adds to each sum the bytes of its stretch of a row; the last stretch may be shorter than the others.
inline void add_stretches(const std::uint8_t* row, int width, int stretch, std::uint32_t* sums);

// ---- Implementation ---------------------------------------------------------------

inline void add_stretches(const std::uint8_t* row, int width, int stretch, std::uint32_t* sums) {
    // As many bytes as an address has.
    using Word = std::uintptr_t;
    constexpr int bytes = sizeof(Word);
    constexpr Word every_second = static_cast<Word>(0x00ff00ff00ff00ff);
    const std::uint8_t* end = row + width;
    // Words begin where the processor reads them with one instruction.
    if (reinterpret_cast<std::uintptr_t>(row) % sizeof(Word) == 0 && stretch % bytes == 0)
        while (end - row >= stretch) {
            Word pairs = 0;
            for (const std::uint8_t* next = row + stretch; row != next; row += bytes) {
                Word word;
                std::memcpy(&word, __builtin_assume_aligned(row, sizeof word), sizeof word);
                pairs += (word & every_second) + (word >> 8 & every_second);
            }
            // The highest 16 bits of the product are the sum of all pairs.
            *sums++ +=
                static_cast<std::uint32_t>(pairs * static_cast<Word>(0x0001000100010001) >> (8 * bytes - 16));
        }
    while (row < end) {
        std::uint32_t sum = 0;
        for (const std::uint8_t* next = row + (end - row < stretch ? end - row : stretch); row != next; ++row)
            sum += *row;
        *sums++ += sum;
    }
}

}  // namespace simd
}  // namespace FOVEA_ISA
}  // namespace fovea
