// SPDX-License-Identifier: MIT
//
// The text in the data codewords of a Data Matrix: ASCII, C40, Text, X12, EDIFACT and Base 256.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/code/code.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// What the codewords tell besides their text.
struct DataMatrixMessage {
    /// 1 plain, 2 and 3 with FNC1 in the first (GS1) or second place, 4 to 6 the same with ECI.
    char aim_digit = '1';
    bool reader_programming = false;  ///< the text is an order to the reader and not data
    /// Of symbols that hold a text together: which one this is, from 1, of how many, and whose. 0: of none.
    int append_position = 0;
    int append_count = 0;
    int append_file = 0;
};

/// Reads codewords, error correction and its parity removed, and appends their text.
///
/// Shapes  1 to max_data_matrix_data codewords
/// Units   bytes; upper shift gives 128 to 255. FNC1 is GS (29) but in the first or second place, where
///         aim_digit tells of it. Macros 05 and 06 become the header and trailer they stand for
/// Errors  malformed for codewords that mean nothing where they stand; buffer_too_small; capacity_exceeded
///         for more than most_text_segments interpretations
/// Source  ISO/IEC 16022, 5.2.4 to 5.2.9 and 5.4 to 5.6. A last codeword 254 in ASCII is passed over: some
///         encoders unlatch there
inline Result<DataMatrixMessage> data_matrix_text(Span<const std::uint8_t> codewords, CodeText& text);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// The codewords of ASCII that are no characters. ISO/IEC 16022, table 2.
namespace data_matrix {
inline constexpr int pad = 129;
inline constexpr int digits = 130;  ///< 00; 229 is 99
inline constexpr int latch_c40 = 230;
inline constexpr int latch_base_256 = 231;
inline constexpr int fnc1 = 232;
inline constexpr int structured_append = 233;
inline constexpr int reader_programming = 234;
inline constexpr int upper_shift = 235;
inline constexpr int macro_05 = 236;
inline constexpr int macro_06 = 237;
inline constexpr int latch_x12 = 238;
inline constexpr int latch_text = 239;
inline constexpr int latch_edifact = 240;
inline constexpr int eci = 241;
inline constexpr int unlatch = 254;
inline constexpr int edifact_unlatch = 31;
inline constexpr std::uint8_t group_separator = 29;
inline constexpr std::uint8_t record_separator = 30;
inline constexpr std::uint8_t end_of_transmission = 4;

/// What randomizes a pad or a byte at a place, counted from 1. ISO/IEC 16022, annex B.
constexpr int pad_noise(int place) { return 149 * place % 253 + 1; }
constexpr int byte_noise(int place) { return 149 * place % 255 + 1; }
}  // namespace data_matrix

class DataMatrixTextReader {
public:
    DataMatrixTextReader(Span<const std::uint8_t> codewords, CodeText& text)
        : codewords_(codewords), count_(static_cast<int>(codewords.size())), text_(text) {}

    Status read(DataMatrixMessage& message) {
        Status s = read_head();
        // Every turn takes a codeword at least.
        while (s == Status::ok && at_ < count_) s = step();
        if (s == Status::ok && upper_) s = Status::malformed;
        if (s == Status::ok && macro_) {
            s = push(data_matrix::record_separator);
            if (s == Status::ok) s = push(data_matrix::end_of_transmission);
        }
        if (s != Status::ok) return s;
        message_.aim_digit = static_cast<char>('1' + (fnc1_place_ + (with_eci_ ? 3 : 0)));
        message = message_;
        return Status::ok;
    }

private:
    int left() const { return count_ - at_; }
    int next() { return codewords_[at_++]; }
    Status push(int value) { return text_.push(static_cast<std::uint8_t>(value)); }
    Status character(int value) {
        const int byte = upper_ ? value + 128 : value;
        upper_ = false;
        return byte > 255 ? Status::malformed : push(byte);
    }

    /// What may only stand at the beginning.
    Status read_head() {
        if (count_ > 0 && codewords_[0] == data_matrix::structured_append) {
            if (count_ < 4) return Status::malformed;
            // ISO/IEC 16022, 5.6: position - 1 above 17 - count.
            message_.append_position = (codewords_[1] >> 4) + 1;
            message_.append_count = 17 - (codewords_[1] & 15);
            message_.append_file = codewords_[2] << 8 | codewords_[3];
            if (message_.append_count > 16 || message_.append_position > message_.append_count ||
                codewords_[2] < 1 || codewords_[2] > 254 || codewords_[3] < 1 || codewords_[3] > 254)
                return Status::malformed;
            at_ = 4;
        } else if (count_ > 0 && codewords_[0] == data_matrix::reader_programming) {
            message_.reader_programming = true;
            at_ = 1;
        } else if (count_ > 0 &&
                   (codewords_[0] == data_matrix::macro_05 || codewords_[0] == data_matrix::macro_06)) {
            macro_ = true;
            at_ = 1;
            const std::uint8_t head[] = {
                '[',
                ')',
                '>',
                data_matrix::record_separator,
                '0',
                codewords_[0] == data_matrix::macro_05 ? std::uint8_t{'5'} : std::uint8_t{'6'},
                data_matrix::group_separator};
            for (const std::uint8_t byte : head)
                if (const Status s = push(byte); s != Status::ok) return s;
        }
        first_ = at_;
        return Status::ok;
    }

    Status step() {
        const int code = next();
        if (code == 0) return Status::malformed;
        if (code <= 128) return character(code - 1);
        if (code == data_matrix::unlatch && at_ == count_) return Status::ok;
        if (upper_) return Status::malformed;
        if (code == data_matrix::pad) {
            at_ = count_;
            return Status::ok;
        }
        if (code < data_matrix::latch_c40) {
            const int number = code - data_matrix::digits;
            const Status s = push('0' + number / 10);
            return s == Status::ok ? push('0' + number % 10) : s;
        }
        switch (code) {
            case data_matrix::latch_c40: return triples(Set::c40);
            case data_matrix::latch_text: return triples(Set::text);
            case data_matrix::latch_x12: return triples(Set::x12);
            case data_matrix::latch_base_256: return bytes();
            case data_matrix::latch_edifact: return edifact();
            case data_matrix::eci: return interpretation();
            case data_matrix::fnc1: return function_1(at_ - 1);
            case data_matrix::upper_shift: upper_ = true; return Status::ok;
            default: return Status::malformed;
        }
    }

    /// FNC1 at a place among the codewords.
    Status function_1(int place) {
        // In the first place, or the second behind one letter or two digits: ISO/IEC 16022, 5.2.4.6.
        if (place == first_ && !macro_) {
            fnc1_place_ = 1;
            return Status::ok;
        }
        const int before = codewords_[first_] - 1;
        const bool letter = (before >= 'A' && before <= 'Z') || (before >= 'a' && before <= 'z');
        const bool number =
            codewords_[first_] >= data_matrix::digits && codewords_[first_] < data_matrix::latch_c40;
        if (place == first_ + 1 && (letter || number) && !macro_) {
            fnc1_place_ = 2;
            return Status::ok;
        }
        return push(data_matrix::group_separator);
    }

    enum class Set { c40, text, x12 };

    Status triples(Set set) {
        int shift = 0;
        // A single codeword at the end is ASCII without an unlatch: ISO/IEC 16022, 5.2.5.2.
        while (left() >= 2) {
            const int first = next();
            if (first == data_matrix::unlatch) return Status::ok;
            const int value = (first << 8) + next() - 1;
            if (value < 0 || value >= 64000) return Status::malformed;
            const int triple[3] = {value / 1600, value / 40 % 40, value % 40};
            for (const int element : triple) {
                const Status s = set == Set::x12 ? x12(element) : shifted(set, element, shift);
                if (s != Status::ok) return s;
            }
        }
        return Status::ok;
    }
    Status x12(int value) {
        constexpr char four[] = {13, '*', '>', ' '};
        if (value < 4) return push(four[value]);
        return push(value < 14 ? '0' + value - 4 : 'A' + value - 14);
    }
    /// ISO/IEC 16022, annex C, tables C.1 and C.2.
    Status shifted(Set set, int value, int& shift) {
        const int in = shift;
        shift = 0;
        const char letter = set == Set::text ? 'a' : 'A';
        switch (in) {
            case 0:
                if (value < 3) {
                    shift = value + 1;
                    return Status::ok;
                }
                if (value == 3) return character(' ');
                return character(value < 14 ? '0' + value - 4 : letter + value - 14);
            case 1: return value < 32 ? character(value) : Status::malformed;
            case 2:
                if (value < 15) return character('!' + value);
                if (value < 22) return character(':' + value - 15);
                if (value < 27) return character('[' + value - 22);
                if (value == 27) return upper_ ? Status::malformed : push(data_matrix::group_separator);
                if (value != 30 || upper_) return Status::malformed;
                upper_ = true;
                return Status::ok;
            default:
                if (value > 31) return Status::malformed;
                return character(set == Set::text && value > 0 && value < 27 ? 'A' + value - 1 : '`' + value);
        }
    }

    Status edifact() {
        // Three codewords are four characters; the last one or two of a symbol are ASCII: ISO/IEC 16022,
        // 5.2.8.2. Behind the unlatch the rest of its codeword is passed over.
        while (left() >= 3) {
            const int group = codewords_[at_] << 16 | codewords_[at_ + 1] << 8 | codewords_[at_ + 2];
            for (int i = 0; i < 4; ++i) {
                const int value = group >> (18 - 6 * i) & 63;
                if (value == data_matrix::edifact_unlatch) {
                    at_ += minimum_codewords(i);
                    return Status::ok;
                }
                const Status s = push(value < 32 ? value + 64 : value);
                if (s != Status::ok) return s;
            }
            at_ += 3;
        }
        return Status::ok;
    }
    /// Codewords that the characters of a group up to that one lie in.
    static constexpr int minimum_codewords(int last) { return last < 3 ? last + 1 : 3; }

    Status bytes() {
        if (left() == 0) return Status::malformed;
        int length = byte();
        if (length == 0) {
            length = left();
        } else if (length >= 250) {
            if (left() == 0) return Status::malformed;
            length = 250 * (length - 249) + byte();
        }
        if (length > left()) return Status::malformed;
        for (int i = 0; i < length; ++i)
            if (const Status s = push(byte()); s != Status::ok) return s;
        return Status::ok;
    }
    int byte() {
        const int noise = data_matrix::byte_noise(at_ + 1);
        return (next() - noise) & 255;
    }

    Status interpretation() {
        // ISO/IEC 16022, 5.4.1, table 6.
        if (left() == 0) return Status::malformed;
        const int first = next();
        if (first == 0 || first > 207) return Status::malformed;
        const int more = first < 128 ? 0 : first < 192 ? 1 : 2;
        if (left() < more) return Status::malformed;
        int rest[2] = {1, 1};
        for (int i = 0; i < more; ++i) {
            rest[i] = next();
            if (rest[i] == 0 || rest[i] == 255) return Status::malformed;
        }
        int number = first - 1;
        if (more == 1) number = (first - 128) * 254 + rest[0] - 1 + 127;
        if (more == 2) number = (first - 192) * 64516 + (rest[0] - 1) * 254 + rest[1] - 1 + 16383;
        with_eci_ = true;
        return text_.begin_segment(number);
    }

    Span<const std::uint8_t> codewords_;
    int count_;
    CodeText& text_;
    DataMatrixMessage message_;
    int at_ = 0;
    int first_ = 0;
    int fnc1_place_ = 0;
    bool with_eci_ = false;
    bool upper_ = false;
    bool macro_ = false;
};

}  // namespace detail

inline Result<DataMatrixMessage> data_matrix_text(Span<const std::uint8_t> codewords, CodeText& text) {
    const CodeText before = text;
    DataMatrixMessage message;
    const Status s = detail::DataMatrixTextReader(codewords, text).read(message);
    if (s == Status::ok) return message;
    text = before;
    return s;
}

}  // namespace fovea
