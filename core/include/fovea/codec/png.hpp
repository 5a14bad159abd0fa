// SPDX-License-Identifier: MIT
//
// What both directions of the PNG format share.
#pragma once

#include <cstdint>

#include <fovea/number/integer.hpp>

namespace fovea {

/// Names and numbers of the format.
///
/// Source  W3C, "Portable Network Graphics (PNG) Specification", second edition (ISO/IEC 15948), sec. 5 and 9
struct Png {
    static constexpr std::uint8_t signature[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};

    /// Names of chunks: four letters, the first one highest.
    static constexpr std::uint32_t header = 0x49484452;   ///< IHDR
    static constexpr std::uint32_t palette = 0x504c5445;  ///< PLTE
    static constexpr std::uint32_t data = 0x49444154;     ///< IDAT
    static constexpr std::uint32_t end = 0x49454e44;      ///< IEND
    static constexpr int header_bytes = 13;
    static constexpr int frame_bytes = 12;  ///< of a chunk: its length, name and checksum

    enum Colour : std::uint8_t { gray = 0, rgb = 2, indexed = 3, gray_alpha = 4, rgb_alpha = 6 };
    enum Filter : std::uint8_t { none, sub, up, mean, paeth };  ///< the standard says average
    static constexpr int filters = 5;
};

/// The neighbour that is nearest to left + above - above_left; on ties the left one before the upper one.
///
/// Source  PNG specification sec. 9.4
constexpr int paeth_predictor(int left, int above, int above_left) {
    const auto distance = [](int difference) { return difference < 0 ? -difference : difference; };
    const int to_left = distance(above - above_left);
    const int to_above = distance(left - above_left);
    const int to_above_left = distance(left + above - 2 * above_left);
    // Written for conditional moves: which neighbour it is cannot be foreseen.
    const int nearer = to_above < to_left ? above : left;
    return to_above_left < minimum(to_above, to_left) ? above_left : nearer;
}

}  // namespace fovea
