// SPDX-License-Identifier: MIT
//
// Code 128 as bars and spaces. ISO/IEC 15417.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/code/bar_reading.hpp>
#include <fovea/code/code_128_tables.hpp>
#include <fovea/code/ean_encoder.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

enum class Code128Kind : std::uint8_t {
    plain,
    gs1,  ///< GS1-128: begins with FNC1, and the byte GS (29) is FNC1 too
};

/// The bars of a Code 128 of any bytes, in the code sets that make it short.
///
/// Shapes  1..most_bar_text bytes; those above 127 take two characters
/// Errors  bad_argument; buffer_too_small, with the list untouched. The list is appended to
/// Source  ISO/IEC 15417, 4.3 and annex E, the choice of code sets
constexpr Status encode_code_128(Span<const std::uint8_t> text, Code128Kind kind, BarWidths widths);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// The values of the characters of a text.
class Code128Writer {
public:
    // Every byte takes two characters and a change of set at most.
    static constexpr int most = 3 * most_bar_text + 4;

    constexpr Code128Writer(Span<const std::uint8_t> text, Code128Kind kind) : text_(text), kind_(kind) {
        const int digits = digits_at(0);
        const int set = digits >= 4 || (digits == 2 && text_.size() == 2) ? set_c : single_set(0);
        add(code_128::start_a + set);
        set_ = set;
        if (kind_ == Code128Kind::gs1) add(code_128::fnc_1);
        for (int at = 0; at < text_.size();) at = take(at);
        int sum = values_[0];
        for (int i = 1; i < count_; ++i) sum = (sum + i * values_[i]) % 103;
        add(sum % 103);
    }
    constexpr int count() const { return count_; }
    constexpr int value(int i) const { return values_[i]; }

private:
    static constexpr int set_a = 0;
    static constexpr int set_b = 1;
    static constexpr int set_c = 2;

    constexpr void add(int value) { values_[count_++] = static_cast<std::uint8_t>(value); }
    constexpr bool is_function_1(int at) const { return kind_ == Code128Kind::gs1 && text_[at] == 29; }
    constexpr int digits_at(int at) const {
        int count = 0;
        while (at + count < text_.size() && text_[at + count] >= '0' && text_[at + count] <= '9') ++count;
        return count;
    }
    /// Set A where a control character comes before the next small letter.
    constexpr int single_set(int from) const {
        for (int at = from; at < text_.size(); ++at) {
            if (is_function_1(at)) continue;
            const int low = text_[at] & 127;
            if (low < 32) return set_a;
            if (low >= 96) return set_b;
        }
        return set_b;
    }
    constexpr void change(int set) {
        if (set == set_) return;
        add(set == set_c ? code_128::code_c : set == set_b ? code_128::code_b : code_128::code_a);
        set_ = set;
    }
    constexpr int take(int at) {
        if (is_function_1(at)) {
            add(code_128::fnc_1);
            return at + 1;
        }
        const int digits = digits_at(at);
        if (set_ == set_c && digits >= 2) {
            add((text_[at] - '0') * 10 + text_[at + 1] - '0');
            return at + 2;
        }
        const bool at_end = at + digits == text_.size();
        if (set_ != set_c && digits % 2 == 0 && (digits >= 6 || (digits >= 4 && at_end))) {
            change(set_c);
            return at;
        }
        const int low = text_[at] & 127;
        if (set_ == set_c || (set_ == set_a && low >= 96) || (set_ == set_b && low < 32)) {
            change(low < 32 ? set_a : low >= 96 ? set_b : single_set(at));
        }
        if (text_[at] >= 128) add(set_ == set_b ? code_128::code_b : code_128::code_a);
        add(low < 32 ? low + 64 : low - 32);
        return at + 1;
    }

    Span<const std::uint8_t> text_;
    Code128Kind kind_;
    int set_ = 0;
    std::uint8_t values_[most] = {};
    int count_ = 0;
};

}  // namespace detail

constexpr Status encode_code_128(Span<const std::uint8_t> text, Code128Kind kind, BarWidths widths) {
    if (text.empty() || text.size() > most_bar_text) return Status::bad_argument;
    const detail::Code128Writer writer(text, kind);
    if (!detail::has_room(widths, writer.count() * 6 + 7)) return Status::buffer_too_small;
    detail::BarWriter bars(widths);
    for (int i = 0; i < writer.count(); ++i) {
        for (int run = 0; run < 6; ++run) {
            bars.add(static_cast<int>(code_128_widths[writer.value(i)] >> (20 - 4 * run) & 7U));
        }
    }
    for (int run = 0; run < 7; ++run) bars.add(static_cast<int>(code_128_stop_widths >> (24 - 4 * run) & 7U));
    return Status::ok;
}

}  // namespace fovea
