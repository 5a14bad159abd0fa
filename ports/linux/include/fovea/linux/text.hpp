// SPDX-License-Identifier: MIT
//
// Text: a line of text in a fixed place, put together piece by piece.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/base/span.hpp>

namespace fovea::linux_port {

/// At most Capacity bytes and a closing zero. What does not fit is left away, and fits() says so.
template <int Capacity>
class Text {
public:
    Text() = default;
    explicit Text(const char* text) { add(text); }

    Text& add(Span<const char> text) {
        for (const char byte : text) {
            if (size_ == Capacity) {
                fits_ = false;
                break;
            }
            bytes_[size_++] = byte;
        }
        bytes_[size_] = '\0';
        return *this;
    }
    Text& add(const char* text) { return add({text, static_cast<std::ptrdiff_t>(std::strlen(text))}); }
    Text& add_number(std::uint64_t number) {
        char digits[20];
        int first = 20;
        do digits[--first] = static_cast<char>('0' + number % 10);
        while ((number /= 10) != 0);
        return add({digits + first, 20 - first});
    }
    void clear() { *this = {}; }

    const char* c_str() const { return bytes_; }
    int size() const { return size_; }
    bool fits() const { return fits_; }
    bool empty() const { return size_ == 0; }
    Span<const std::uint8_t> bytes() const { return {reinterpret_cast<const std::uint8_t*>(bytes_), size_}; }
    friend bool operator==(const Text& a, const Text& b) {
        return a.size_ == b.size_ && std::memcmp(a.bytes_, b.bytes_, static_cast<std::size_t>(a.size_)) == 0;
    }

private:
    // Not = "": Clang 14 takes one literal for the arrays of all capacities, and clears as many bytes as the
    // largest has.
    char bytes_[static_cast<std::size_t>(Capacity) + 1] = {};
    int size_ = 0;
    bool fits_ = true;
};

inline bool begins_with(const char* text, const char* start) {
    return std::strncmp(text, start, std::strlen(start)) == 0;
}

/// A whole number in decimal digits and nothing else; false if it is none or above most.
inline bool parse_number(const char* text, std::uint64_t most, std::uint64_t& number) {
    std::uint64_t value = 0;
    if (*text == '\0') return false;
    for (; *text != '\0'; ++text) {
        if (*text < '0' || *text > '9') return false;
        const std::uint64_t digit = static_cast<std::uint64_t>(*text - '0');
        if (value > (most - digit) / 10 || digit > most) return false;
        value = value * 10 + digit;
    }
    number = value;
    return true;
}

}  // namespace fovea::linux_port
