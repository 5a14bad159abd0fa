// SPDX-License-Identifier: MIT
//
// TextBuffer: a line put together in memory of a fixed size.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/number/decimal.hpp>

namespace fovea::apps {

/// Text that somebody gives room for. What does not fit is left out, and full() says so: a line that was cut
/// is never sent.
class TextBuffer {
public:
    explicit TextBuffer(Span<char> room) : room_(room) {}

    TextBuffer& put(char letter) {
        if (size_ < room_.size())
            room_[size_++] = letter;
        else
            full_ = true;
        return *this;
    }
    TextBuffer& text(Span<const char> letters) {
        for (const char letter : letters) put(letter);
        return *this;
    }
    TextBuffer& text(const char* letters) {
        for (; *letters != '\0'; ++letters) put(*letters);
        return *this;
    }
    TextBuffer& number(std::int64_t value) {
        // The magnitude of the smallest is larger than the largest.
        std::uint64_t rest =
            value < 0 ? 0 - static_cast<std::uint64_t>(value) : static_cast<std::uint64_t>(value);
        if (value < 0) put('-');
        char digits[20];
        int count = 0;
        do digits[count++] = static_cast<char>('0' + rest % 10);
        while ((rest /= 10) != 0);
        while (count > 0) put(digits[--count]);
        return *this;
    }
    TextBuffer& decimal(Decimal value, int places) {
        char digits[32];
        const Result<int> length = print_decimal(value, places, digits);
        return length ? text(Span<const char>(digits, *length)) : text("?");
    }
    TextBuffer& hex(std::uint32_t value, int digits) {
        for (int shift = 4 * (digits - 1); shift >= 0; shift -= 4)
            put("0123456789abcdef"[value >> shift & 15]);
        return *this;
    }
    /// A JSON string with its quotes. Names are printable UTF-8; of anything else, control characters are
    /// escaped.
    TextBuffer& json(Span<const char> letters) {
        put('"');
        for (const char letter : letters) {
            const auto byte = static_cast<std::uint8_t>(letter);
            if (byte < 0x20 || byte == 0x7f) {
                text("\\u00").hex(byte, 2);
                continue;
            }
            if (letter == '"' || letter == '\\') put('\\');
            put(letter);
        }
        return put('"');
    }

    void clear() {
        size_ = 0;
        full_ = false;
    }
    bool full() const { return full_; }
    std::ptrdiff_t size() const { return size_; }
    Span<const char> letters() const { return {room_.data(), size_}; }
    Span<const std::uint8_t> bytes() const {
        return {reinterpret_cast<const std::uint8_t*>(room_.data()), size_};
    }

private:
    Span<char> room_;
    std::ptrdiff_t size_ = 0;
    bool full_ = false;
};

inline Span<const char> letters_of(const char* text) {
    std::ptrdiff_t length = 0;
    while (text[length] != '\0') ++length;
    return {text, length};
}

}  // namespace fovea::apps
