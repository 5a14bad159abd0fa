// SPDX-License-Identifier: MIT
//
// Span: a run of elements somebody else owns.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <fovea/base/assert.hpp>

namespace fovea {

/// Keeps a function parameter out of template argument deduction.
template <class T>
struct NonDeducedHelper {
    using type = T;
};
template <class T>
using NonDeduced = typename NonDeducedHelper<T>::type;

/// Pointer and count. Copying is free; the memory must outlive the span.
template <class T>
class Span {
public:
    using value_type = std::remove_const_t<T>;

    constexpr Span() = default;
    constexpr Span(T* data, std::ptrdiff_t size) : data_(data), size_(size) { FOVEA_ASSERT(size >= 0); }
    template <std::size_t N>
    constexpr Span(T (&array)[N]) : data_(array), size_(static_cast<std::ptrdiff_t>(N)) {}
    template <class Other, class = std::enable_if_t<std::is_same_v<const Other, T>>>
    constexpr Span(Span<Other> other) : data_(other.data()), size_(other.size()) {}

    constexpr T* data() const { return data_; }
    constexpr std::ptrdiff_t size() const { return size_; }
    constexpr bool empty() const { return size_ == 0; }
    constexpr T* begin() const { return data_; }
    constexpr T* end() const { return data_ + size_; }
    constexpr T& operator[](std::ptrdiff_t index) const {
        FOVEA_ASSERT(index >= 0 && index < size_);
        return data_[index];
    }
    /// Counts of 64 bits, as operators tell their scratch, also where addresses have 32.
    constexpr Span first(std::int64_t count) const {
        FOVEA_ASSERT(count >= 0 && count <= size_);
        return {data_, static_cast<std::ptrdiff_t>(count)};
    }
    constexpr Span from(std::int64_t start) const {
        FOVEA_ASSERT(start >= 0 && start <= size_);
        return {data_ + static_cast<std::ptrdiff_t>(start), size_ - static_cast<std::ptrdiff_t>(start)};
    }

private:
    T* data_ = nullptr;
    std::ptrdiff_t size_ = 0;
};

}  // namespace fovea
