// SPDX-License-Identifier: MIT
//
// What the data bits of a QR code say. ISO/IEC 18004, clause 7.4.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/code/code.hpp>
#include <fovea/code/qr_tables.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// A symbol that is one of several which together hold a message. Clause 8.
struct QrStructuredAppend {
    int position = 0;         ///< of this symbol, from 0
    int total = 0;            ///< symbols of the message, 0 for a symbol that stands alone
    std::uint8_t parity = 0;  ///< all bytes of the message added without carry: the same in all its symbols
};

namespace detail {

struct QrContents {
    char aim_digit = '1';
    QrStructuredAppend append;
};

/// Appends what the data codewords say.
///
/// Errors  malformed, unsupported for reserved modes, buffer_too_small,
///         capacity_exceeded for too many changes of interpretation; text is then what it was
/// Source  clauses 7.4 and 8; the digit is that of annex F. The mode of Chinese characters is GB/T 18284's
inline Result<QrContents> read_qr_segments(Span<const std::uint8_t> data, int version, CodeText& text);

}  // namespace detail

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Bits one by one from the highest of every byte.
class QrBits {
public:
    explicit constexpr QrBits(Span<const std::uint8_t> bytes) : bytes_(bytes) {}

    constexpr int left() const { return static_cast<int>(bytes_.size()) * 8 - next_; }
    /// The next count bits, at most 24; there must be as many.
    constexpr unsigned take(int count) {
        FOVEA_ASSERT(count <= left());
        unsigned value = 0;
        for (int i = 0; i < count; ++i, ++next_) {
            value = value << 1 | (static_cast<unsigned>(bytes_[next_ / 8]) >> (7 - next_ % 8) & 1);
        }
        return value;
    }

private:
    Span<const std::uint8_t> bytes_;
    int next_ = 0;
};

class QrSegmentReader {
public:
    QrSegmentReader(Span<const std::uint8_t> data, int version, const CodeText& text)
        : bits_(data), version_(version), text_(text) {}

    const CodeText& text() const { return text_; }

    Result<QrContents> read() {
        if (const Status s = text_.begin_segment(TextSegment::not_stated); s != Status::ok) return s;
        while (bits_.left() >= 4) {
            const unsigned mode = bits_.take(4);
            if (mode == 0) break;
            if (const Status s = segment(mode); s != Status::ok) return s;
        }
        contents_.aim_digit = static_cast<char>('1' + 2 * function_one_ + (told_eci_ ? 1 : 0));
        return contents_;
    }

private:
    Status segment(unsigned mode) {
        switch (mode) {
            case 1: return counted(QrMode::numeric);
            case 2: return counted(QrMode::alphanumeric);
            case 3: return structured_append();
            case 4: return counted(QrMode::bytes);
            case 5: return function_one(1);
            case 7: return interpretation();
            case 8: return counted(QrMode::kanji);
            case 9: return function_one(2);
            case 13: return hanzi();
            default: return Status::unsupported;
        }
    }
    Status counted(QrMode mode) {
        const int count_bits = qr_count_bits_of(mode, version_);
        if (bits_.left() < count_bits) return Status::malformed;
        const int count = static_cast<int>(bits_.take(count_bits));
        switch (mode) {
            case QrMode::numeric: return numeric(count);
            case QrMode::alphanumeric: return alphanumeric(count);
            case QrMode::bytes: return bytes(count);
            case QrMode::kanji: break;
        }
        return kanji(count);
    }
    Status push(unsigned byte) { return text_.push(static_cast<std::uint8_t>(byte)); }

    /// Three digits in ten bits, the last two in seven or the last in four.
    Status numeric(int count) {
        while (count > 0) {
            const int digits = minimum(count, 3);
            const int size = digits == 3 ? 10 : digits == 2 ? 7 : 4;
            if (bits_.left() < size) return Status::malformed;
            const unsigned value = bits_.take(size);
            unsigned unit = digits == 3 ? 100 : digits == 2 ? 10 : 1;
            if (value >= unit * 10) return Status::malformed;
            for (; unit > 0; unit /= 10) {
                if (const Status s = push('0' + value / unit % 10); s != Status::ok) return s;
            }
            count -= digits;
        }
        return Status::ok;
    }
    /// Two characters in eleven bits, the last alone in six. After a function character one percent sign is
    /// the separator GS and two are one. Clause 7.4.8.
    Status alphanumeric(int count) {
        bool percent = false;
        while (count > 0) {
            const int size = count >= 2 ? 11 : 6;
            if (bits_.left() < size) return Status::malformed;
            const unsigned value = bits_.take(size);
            if (value >= (count >= 2 ? 45U * 45U : 45U)) return Status::malformed;
            const char pair[2] = {qr_alphanumeric[count >= 2 ? value / 45 : value],
                                  qr_alphanumeric[value % 45]};
            for (int i = 0; i < minimum(count, 2); ++i) {
                if (const Status s = character(pair[i], percent); s != Status::ok) return s;
            }
            count -= 2;
        }
        return percent ? push(group_separator) : Status::ok;
    }
    Status character(char c, bool& percent) {
        const bool escaped = function_one_ != 0 && c == '%';
        if (escaped && !percent) {
            percent = true;
            return Status::ok;
        }
        if (percent && !escaped) {
            if (const Status s = push(group_separator); s != Status::ok) return s;
        }
        percent = false;
        return push(static_cast<unsigned char>(c));
    }
    Status bytes(int count) {
        if (bits_.left() < 8 * std::int64_t{count}) return Status::malformed;
        if (count == 0) return Status::ok;
        if (!(in_kanji_ && eci_ == TextSegment::not_stated && plain_ascii(count))) {
            if (const Status s = text_.begin_segment(eci_); s != Status::ok) return s;
            in_kanji_ = false;
        }
        for (int i = 0; i < count; ++i) {
            if (const Status s = push(bits_.take(8)); s != Status::ok) return s;
        }
        return Status::ok;
    }
    /// Whether the next bytes mean the same as Shift JIS, which has other characters at two places of ASCII.
    bool plain_ascii(int count) const {
        QrBits ahead = bits_;
        for (int i = 0; i < count; ++i) {
            const unsigned byte = ahead.take(8);
            if (byte >= 0x80 || byte == 0x5C || byte == 0x7E) return false;
        }
        return true;
    }
    /// Thirteen bits a character: 0x8140..0x9FFC and 0xE040..0xEBBF as the lead and trail of base 0xC0.
    /// Clause 7.4.6.
    Status kanji(int count) {
        if (bits_.left() < 13 * std::int64_t{count}) return Status::malformed;
        if (count == 0) return Status::ok;
        if (const Status s = text_.begin_segment(shift_jis); s != Status::ok) return s;
        in_kanji_ = true;
        for (int i = 0; i < count; ++i) {
            const unsigned value = bits_.take(13);
            const unsigned packed = value / 0xC0 << 8 | value % 0xC0;
            const unsigned code = packed + (packed < 0x1F00 ? 0x8140U : 0xC140U);
            const unsigned trail = code & 0xFF;
            if (trail == 0x7F || trail < 0x40 || trail > 0xFC) return Status::malformed;
            if (const Status s = push(code >> 8); s != Status::ok) return s;
            if (const Status s = push(trail); s != Status::ok) return s;
        }
        return Status::ok;
    }
    /// Chinese characters in thirteen bits each, in rows of base 0x60 that begin at 0xA1A1 and 0xB0A1, after
    /// a number of the set, of which there is one. GB/T 18284, 6.4.6.
    Status hanzi() {
        const int count_bits = qr_count_bits_of(QrMode::kanji, version_);
        if (bits_.left() < 4 + count_bits) return Status::malformed;
        if (bits_.take(4) != 1) return Status::unsupported;
        const int count = static_cast<int>(bits_.take(count_bits));
        if (bits_.left() < 13 * std::int64_t{count}) return Status::malformed;
        if (count == 0) return Status::ok;
        if (const Status s = text_.begin_segment(gb_2312_eci); s != Status::ok) return s;
        in_kanji_ = true;
        for (int i = 0; i < count; ++i) {
            const unsigned value = bits_.take(13);
            const unsigned packed = value / 0x60 << 8 | value % 0x60;
            const unsigned code = packed + (packed < 0xA00 ? 0xA1A1U : 0xA6A1U);
            if ((code & 0xFF) > 0xFE || code > 0xFFFF) return Status::malformed;
            if (const Status s = push(code >> 8); s != Status::ok) return s;
            if (const Status s = push(code & 0xFF); s != Status::ok) return s;
        }
        return Status::ok;
    }
    /// One to three bytes, as the first of them says. Clause 7.4.2.
    Status interpretation() {
        if (bits_.left() < 8) return Status::malformed;
        unsigned value = bits_.take(8);
        const int more = (value & 0x80) == 0 ? 0 : (value & 0x40) == 0 ? 1 : 2;
        if (more == 2 && (value & 0x20) != 0) return Status::malformed;
        if (bits_.left() < 8 * more) return Status::malformed;
        value &= 0x7FU >> more;
        for (int i = 0; i < more; ++i) value = value << 8 | bits_.take(8);
        if (value > 999999) return Status::malformed;
        eci_ = static_cast<int>(value);
        told_eci_ = true;
        return Status::ok;
    }
    /// First position: data of GS1. Second: data of an industry whose indicator follows, a letter as its code
    /// and 100, or two digits; it is the start of the text. Clause 7.4.8.
    Status function_one(int position) {
        if (function_one_ != 0) return Status::malformed;
        function_one_ = position;
        if (position == 1) return Status::ok;
        if (bits_.left() < 8) return Status::malformed;
        const unsigned indicator = bits_.take(8);
        if (indicator < 100) {
            if (const Status s = push('0' + indicator / 10); s != Status::ok) return s;
            return push('0' + indicator % 10);
        }
        const unsigned letter = indicator - 100;
        const bool capital = letter >= 'A' && letter <= 'Z';
        const bool small = letter >= 'a' && letter <= 'z';
        return capital || small ? push(letter) : Status::malformed;
    }
    Status structured_append() {
        if (bits_.left() < 16 || contents_.append.total != 0) return Status::malformed;
        contents_.append.position = static_cast<int>(bits_.take(4));
        contents_.append.total = static_cast<int>(bits_.take(4)) + 1;
        contents_.append.parity = static_cast<std::uint8_t>(bits_.take(8));
        return contents_.append.position < contents_.append.total ? Status::ok : Status::malformed;
    }

    static constexpr unsigned group_separator = 0x1D;
    static constexpr int shift_jis = 20;
    static constexpr int gb_2312_eci = 29;

    QrBits bits_;
    int version_;
    CodeText text_;
    QrContents contents_;
    int eci_ = TextSegment::not_stated;
    bool told_eci_ = false;
    bool in_kanji_ = false;  ///< the text's last segment is Shift JIS or GB 2312
    int function_one_ = 0;
};

inline Result<QrContents> read_qr_segments(Span<const std::uint8_t> data, int version, CodeText& text) {
    QrSegmentReader reader(data, version, text);
    const Result<QrContents> contents = reader.read();
    if (contents) text = reader.text();
    return contents;
}

}  // namespace detail

}  // namespace fovea
