// SPDX-License-Identifier: MIT
//
// Arena: cuts the caller's scratch bytes into typed spans. Gives out once, takes nothing back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <fovea/base/assert.hpp>
#include <fovea/base/span.hpp>

namespace fovea {

/// Bytes of an arena that count elements of T take at most, whatever stands before them.
template <class T>
constexpr std::int64_t arena_bytes(std::int64_t count) {
    return count * static_cast<std::int64_t>(sizeof(T)) + static_cast<std::int64_t>(alignof(T)) - 1;
}

/// Hands out the bytes of a span from its start. Whoever needs several things adds up their arena_bytes(),
/// checks the sum once, and then takes them.
class Arena {
public:
    explicit Arena(Span<std::uint8_t> bytes) : rest_(bytes) {}

    /// count elements, every one equal to T{}. The room must be there: it was checked.
    template <class T>
    Span<T> take(std::int64_t count) {
        const Span<T> elements = take_unset<T>(count);
        for (T& element : elements) element = T{};
        return elements;
    }
    /// The same with whatever the bytes hold, for elements that are written before they are read.
    template <class T>
    Span<T> take_unset(std::int64_t count) {
        static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>,
                      "an arena holds plain data");
        const auto address = reinterpret_cast<std::uintptr_t>(rest_.data());
        const auto skip = static_cast<int>((alignof(T) - address % alignof(T)) % alignof(T));
        const std::int64_t bytes = count * static_cast<int>(sizeof(T));
        FOVEA_ASSERT(count >= 0 && skip + bytes <= rest_.size());
        T* first = reinterpret_cast<T*>(rest_.data() + skip);
        rest_ = rest_.from(skip + bytes);
        return {first, static_cast<std::ptrdiff_t>(count)};
    }
    /// What is left.
    Span<std::uint8_t> rest() const { return rest_; }

private:
    Span<std::uint8_t> rest_;
};

}  // namespace fovea
