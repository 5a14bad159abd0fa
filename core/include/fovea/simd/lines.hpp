// SPDX-License-Identifier: MIT
//
// Lines: scratch rows with a border on both sides, where a filter keeps what down() made for across().
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/base/assert.hpp>
#include <fovea/base/span.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>

namespace fovea {

/// The farthest a filter may look to either side in its lines.
inline constexpr int max_reach = 32;

inline namespace FOVEA_ISA {

/// Bytes of scratch that one line of byte pixels needs: the row, the reach on both sides, and a vector's
/// overhang.
constexpr int byte_line_scratch(int width) { return width + 2 * max_reach + simd::lanes; }

namespace simd {

/// One row of pixels in the caller's scratch. at(x) may be asked for columns -max_reach to width - 1 +
/// max_reach.
class ByteLine {
public:
    /// scratch holds byte_line_scratch(width) bytes.
    ByteLine(Span<std::uint8_t> scratch, int width) : first_(scratch.data() + max_reach) {
        FOVEA_ASSERT(scratch.size() >= byte_line_scratch(width));
        static_cast<void>(width);
    }
    [[gnu::always_inline]] void put(int x, Bytes pixels) { pixels.store(first_ + x); }
    [[gnu::always_inline]] Bytes at(int x) const { return Bytes::load(first_ + x); }

    /// Repeats the outermost of width pixels reach times on either side.
    void replicate(int width, int reach) {
        std::memset(first_ - reach, first_[0], static_cast<std::size_t>(reach));
        std::memset(first_ + width, first_[width - 1], static_cast<std::size_t>(reach));
    }
    /// The pixel of column 0; as far as at() reaches, its neighbours may be read and written too.
    std::uint8_t* pixels() const { return first_; }

private:
    std::uint8_t* first_;
};

/// Calls visit(x, count) for every vector of a row: count is lanes but for the last, partial one.
template <class Visit>
[[gnu::always_inline]] inline void for_each_vector(int width, Visit visit) {
    int x = 0;
    for (; x + lanes <= width; x += lanes) visit(x, lanes);
    if (x < width) visit(x, width - x);
}

}  // namespace simd
}  // namespace FOVEA_ISA
}  // namespace fovea
