// SPDX-License-Identifier: MIT
//
// Lines of JSON on a serial line, without memory for them.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/number/decimal.hpp>

namespace fovea::apps {

/// Writes text as the line takes it. Waits for room as long as its patience allows, then drops what is left
/// of the line: a line that is stuck must not stop the verdicts. The next one then begins with an end, so
/// that it stands for itself.
template <class Serial, class Clock, class Watchdog>
class JsonLine {
public:
    static constexpr std::int64_t patience = 200000;  ///< microseconds

    JsonLine(Serial& serial, Clock& clock, Watchdog& watchdog)
        : serial_(serial), clock_(clock), watchdog_(watchdog) {}

    JsonLine& text(const char* text) {
        // The line may be a long one.
        watchdog_.feed();
        for (; *text != '\0'; ++text) put(*text);
        return *this;
    }
    /// A string of UTF-8 in quotes.
    JsonLine& string(Span<const char> letters) {
        put('"');
        for (const char letter : letters) {
            const auto byte = static_cast<unsigned char>(letter);
            if (byte < 0x20 || byte == 0x7f) {
                text("\\u00").put(hexadecimal(byte >> 4));
                put(hexadecimal(byte & 15));
                continue;
            }
            if (letter == '"' || letter == '\\') put('\\');
            put(letter);
        }
        put('"');
        return *this;
    }
    JsonLine& number(std::int64_t value) { return decimal(Decimal::from_int(value), 0); }
    JsonLine& decimal(Decimal value, int places) {
        char digits[32];
        const Result<int> length = print_decimal(value, places, digits);
        for (int i = 0; length.ok() && i < *length; ++i) put(digits[i]);
        return *this;
    }
    void end() {
        put('\n');
        torn_ = dropped_;
        dropped_ = false;
    }

private:
    static char hexadecimal(int digit) {
        return static_cast<char>(digit < 10 ? '0' + digit : 'a' + digit - 10);
    }
    void put(char letter) {
        if (torn_) send('\n');
        torn_ = false;
        send(letter);
    }
    void send(char letter) {
        if (dropped_) return;
        const auto byte = static_cast<std::uint8_t>(letter);
        const std::int64_t begin = clock_.microseconds();
        for (;;) {
            const Result<int> taken = serial_.write({&byte, 1});
            if (taken && *taken == 1) return;
            watchdog_.feed();
            dropped_ = !taken || clock_.microseconds() - begin > patience;
            if (dropped_) return;
        }
    }

    Serial& serial_;
    Clock& clock_;
    Watchdog& watchdog_;
    bool dropped_ = false;  ///< the rest of this line
    bool torn_ = false;     ///< the line before has no end
};

}  // namespace fovea::apps
