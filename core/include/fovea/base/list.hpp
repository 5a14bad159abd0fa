// SPDX-License-Identifier: MIT
//
// List: a bounded sequence. Its storage is static, its view travels.
#pragma once

#include <cstddef>

#include <fovea/base/assert.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>

namespace fovea {

/// A list whose elements and count somebody else owns. Never grows beyond capacity().
template <class T>
class ListView {
public:
    constexpr ListView(T* data, int capacity, int* size) : data_(data), capacity_(capacity), size_(size) {}

    constexpr int size() const { return *size_; }
    constexpr int capacity() const { return capacity_; }
    constexpr bool empty() const { return *size_ == 0; }
    constexpr bool full() const { return *size_ == capacity_; }
    constexpr T* begin() const { return data_; }
    constexpr T* end() const { return data_ + *size_; }
    constexpr T& operator[](int index) const {
        FOVEA_ASSERT(index >= 0 && index < *size_);
        return data_[index];
    }
    constexpr void clear() const { *size_ = 0; }
    /// Keeps the first count elements.
    constexpr void shrink(int count) const {
        FOVEA_ASSERT(count >= 0 && count <= *size_);
        *size_ = count;
    }

    /// Appends, or answers capacity_exceeded and leaves the list as it was.
    constexpr Status push(const T& value) const {
        if (full()) return Status::capacity_exceeded;
        data_[(*size_)++] = value;
        return Status::ok;
    }
    /// Makes room for one more element, whose value is what stood there before; nullptr when the list is
    /// full. For elements that are too large to pass through push().
    constexpr T* append() const { return full() ? nullptr : data_ + (*size_)++; }
    constexpr Span<T> span() const { return {data_, *size_}; }

private:
    T* data_;
    int capacity_;
    int* size_;
};

/// Owns room for Capacity elements.
template <class T, int Capacity>
class List {
public:
    static_assert(Capacity > 0, "a list needs room for at least one element");

    constexpr ListView<T> view() { return {data_, Capacity, &size_}; }
    constexpr operator ListView<T>() { return view(); }
    constexpr int size() const { return size_; }
    constexpr bool empty() const { return size_ == 0; }
    constexpr void clear() { size_ = 0; }
    constexpr Status push(const T& value) { return view().push(value); }
    constexpr T* begin() { return data_; }
    constexpr T* end() { return data_ + size_; }
    constexpr const T* begin() const { return data_; }
    constexpr const T* end() const { return data_ + size_; }
    constexpr T& operator[](int index) {
        FOVEA_ASSERT(index >= 0 && index < size_);
        return data_[index];
    }
    constexpr const T& operator[](int index) const {
        FOVEA_ASSERT(index >= 0 && index < size_);
        return data_[index];
    }
    constexpr Span<const T> span() const { return {data_, size_}; }

private:
    T data_[static_cast<std::size_t>(Capacity)]{};
    int size_ = 0;
};

}  // namespace fovea
