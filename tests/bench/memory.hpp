// SPDX-License-Identifier: MIT
//
// Memory of the bench: begins where a cache line does, as the memory of other libraries and of cameras does.
// Else every second vector that is stored would lie in two lines, for ours alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

namespace fovea::bench {

template <class T>
struct AtCacheLines {
    using value_type = T;

    static constexpr std::align_val_t line{64};

    AtCacheLines() = default;
    template <class Other>
    explicit AtCacheLines(const AtCacheLines<Other>& /*other*/) {}

    T* allocate(std::size_t count) { return static_cast<T*>(::operator new(count * sizeof(T), line)); }
    void deallocate(T* first, std::size_t /*count*/) { ::operator delete(first, line); }

    friend bool operator==(const AtCacheLines& /*a*/, const AtCacheLines& /*b*/) { return true; }
    friend bool operator!=(const AtCacheLines& /*a*/, const AtCacheLines& /*b*/) { return false; }
};

template <class T>
using Memory = std::vector<T, AtCacheLines<T>>;
using Bytes = Memory<std::uint8_t>;

}  // namespace fovea::bench
