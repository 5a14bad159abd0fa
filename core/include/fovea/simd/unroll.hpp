// SPDX-License-Identifier: MIT
//
// A loop of a constant number of rounds, written out: compilers do it at -O3 alone, and an array that such a
// loop walks over would lie in memory instead of registers.
#pragma once

#include <type_traits>
#include <utility>

#include <fovea/simd/isa.hpp>

namespace fovea {
inline namespace FOVEA_ISA {
namespace simd {

template <class Use, int... I>
[[gnu::always_inline]] constexpr void unroll_over([[maybe_unused]] Use use,
                                                  std::integer_sequence<int, I...>) {
    (use(std::integral_constant<int, I>()), ...);
}

/// use(0), use(1) ... use(Count - 1), each number a constant.
template <int Count, class Use>
[[gnu::always_inline]] constexpr void unroll(Use use) {
    unroll_over(use, std::make_integer_sequence<int, Count>());
}

}  // namespace simd
}  // namespace FOVEA_ISA
}  // namespace fovea
