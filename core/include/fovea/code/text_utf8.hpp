// SPDX-License-Identifier: MIT
//
// The text of a code as UTF-8, whatever its bytes are written in.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/code/character_tables.hpp>
#include <fovea/code/code.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Bytes of UTF-8 that so many bytes become at most.
constexpr std::int64_t text_utf8_room(std::int64_t size) { return 3 * size; }

/// Writes size bytes of a text, from first on, as UTF-8, and answers how many bytes that are. Control
/// characters stay what they are.
///
/// Units   interpretations 0 to 13 and 15 to 18 (code page 437, parts of ISO/IEC 8859), 20 (Shift JIS), 21 to
///         24 (Windows), 25 (UTF-16BE), 26 (UTF-8), 27 and 170 (ASCII), 29 (GB 2312), 899 (bytes, as ISO/IEC
///         8859-1). Bytes that are no character become U+FFFD. Where nothing is stated: UTF-8 if it is, or
///         else Shift JIS if that is plausible, or else ISO/IEC 8859-1
/// Errors  out_of_range for a part that is not within the text; unsupported for another interpretation;
///         buffer_too_small. What was written then has no meaning
/// Source  AIM ITS/04-023. The guess: many encoders write UTF-8 or Shift JIS without a word. Japanese text
///         has characters that begin with 0x81 to 0x9F, which are no letters of Europe, or rows of kana
inline Result<int> text_utf8(const CodeText& text, int first, int size, Span<std::uint8_t> utf8);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// A character and the bytes that it took.
struct ReadCharacter {
    std::uint32_t value = no_character;
    int bytes = 1;
};

/// One character of UTF-8; overlong forms, surrogates and stray bytes are none.
constexpr ReadCharacter read_utf8(Span<const std::uint8_t> bytes) {
    const std::uint32_t lead = bytes[0];
    if (lead < 0x80) return {lead, 1};
    const int size = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
    if (lead < 0xC2 || lead > 0xF4 || bytes.size() < size) return {};
    std::uint32_t value = lead & (0x7FU >> size);
    for (int i = 1; i < size; ++i) {
        if ((bytes[i] & 0xC0) != 0x80) return {};
        value = value << 6 | (bytes[i] & 0x3FU);
    }
    const std::uint32_t least = size == 2 ? 0x80 : size == 3 ? 0x800 : 0x10000;
    if (value < least || value > 0x10FFFF || (value >= 0xD800 && value < 0xE000)) return {};
    return {value, size};
}

constexpr bool is_shift_jis_lead(std::uint8_t byte) {
    return (byte >= 0x81 && byte <= 0x9F) || (byte >= 0xE0 && byte <= 0xFC);
}
/// ASCII, kana of half width, or a character of JIS X 0208.
constexpr ReadCharacter read_shift_jis(Span<const std::uint8_t> bytes) {
    const std::uint32_t lead = bytes[0];
    if (lead < 0x80) return {lead, 1};
    if (lead >= 0xA1 && lead <= 0xDF) return {lead - 0xA1 + 0xFF61, 1};
    if (!is_shift_jis_lead(bytes[0]) || bytes.size() < 2) return {};
    const int trail = bytes[1];
    if (trail < 0x40 || trail == 0x7F || trail > 0xFC) return {};
    const int pair = bytes[0] - (lead < 0xA0 ? 0x81 : 0xC1);
    const int row = 2 * pair + (trail < 0x9F ? 1 : 2);
    const int cell = trail >= 0x9F ? trail - 0x9F : trail - 0x40 - (trail > 0x7F ? 1 : 0);
    const int line = row <= 8 ? row - 1 : row == 13 ? 8 : row >= 16 && row <= 84 ? row - 7 : -1;
    return {line < 0 ? no_character : jis_x_0208[line * 94 + cell], 2};
}
/// ASCII, or a character of GB 2312 as EUC writes it.
constexpr ReadCharacter read_gb_2312(Span<const std::uint8_t> bytes) {
    if (bytes[0] < 0x80) return {bytes[0], 1};
    if (bytes[0] < 0xA1 || bytes.size() < 2 || bytes[1] < 0xA1 || bytes[1] == 0xFF) return {};
    const int row = bytes[0] - 0xA0;
    const int line = row <= 9 ? row - 1 : row >= 16 && row <= 87 ? row - 7 : -1;
    return {line < 0 ? no_character : gb_2312[line * 94 + bytes[1] - 0xA1], 2};
}
constexpr ReadCharacter read_utf16(Span<const std::uint8_t> bytes) {
    if (bytes.size() < 2) return {};
    const std::uint32_t unit = static_cast<std::uint32_t>(bytes[0]) << 8 | bytes[1];
    if (unit < 0xD800 || unit > 0xDFFF) return {unit, 2};
    if (unit > 0xDBFF || bytes.size() < 4) return {no_character, 2};
    const std::uint32_t low = static_cast<std::uint32_t>(bytes[2]) << 8 | bytes[3];
    if (low < 0xDC00 || low > 0xDFFF) return {no_character, 2};
    return {0x10000 + ((unit - 0xD800) << 10) + (low - 0xDC00), 4};
}
template <class Read>
constexpr bool all_characters(Span<const std::uint8_t> bytes, Read read) {
    for (std::ptrdiff_t i = 0; i < bytes.size();) {
        const ReadCharacter character = read(bytes.from(i));
        if (character.value == no_character) return false;
        i += character.bytes;
    }
    return true;
}
constexpr bool plausible_shift_jis(Span<const std::uint8_t> bytes) {
    if (!all_characters(bytes, read_shift_jis)) return false;
    int kana = 0;
    for (std::ptrdiff_t i = 0; i < bytes.size();) {
        const int taken = read_shift_jis(bytes.from(i)).bytes;
        if (taken == 2 && bytes[i] <= 0x9F) return true;
        kana = taken == 1 && bytes[i] >= 0xA1 ? kana + 1 : 0;
        if (kana == 3) return true;
        i += taken;
    }
    return false;
}

/// The upper part of a set of single bytes; first 256 for ASCII and Latin 1, which have none.
struct UpperHalf {
    const char16_t* characters = nullptr;
    int first = 0x100;
};
/// False for an interpretation that is no such set.
constexpr bool upper_half(int eci, UpperHalf& half) {
    constexpr const char16_t* parts[] = {iso_8859_2, iso_8859_3,  iso_8859_4,  iso_8859_5,  iso_8859_6,
                                         iso_8859_7, iso_8859_8,  iso_8859_9,  iso_8859_10, iso_8859_11,
                                         nullptr,    iso_8859_13, iso_8859_14, iso_8859_15, iso_8859_16};
    constexpr const char16_t* pages[] = {windows_1250, windows_1251, windows_1252, windows_1256};
    half = {};
    if (eci == 1 || eci == 3 || eci == 27 || eci == 170 || eci == 899) return true;
    if (eci == 0 || eci == 2)
        half = {code_page_437, 0x80};
    else if (eci >= 4 && eci <= 18)
        half = {parts[eci - 4], 0xA0};
    else if (eci >= 21 && eci <= 24)
        half = {pages[eci - 21], 0x80};
    return half.characters != nullptr;
}

class Utf8Writer {
public:
    explicit constexpr Utf8Writer(Span<std::uint8_t> room) : room_(room) {}

    constexpr int size() const { return size_; }
    constexpr Status put(std::uint32_t value) {
        if (value < 0x80) return byte(value);
        const int more = value < 0x800 ? 1 : value < 0x10000 ? 2 : 3;
        if (room_.size() - size_ <= more) return Status::buffer_too_small;
        const std::uint32_t lead = more == 1 ? 0xC0 : more == 2 ? 0xE0 : 0xF0;
        room_[size_++] = static_cast<std::uint8_t>(lead | value >> (6 * more));
        for (int i = more - 1; i >= 0; --i)
            room_[size_++] = static_cast<std::uint8_t>(0x80 | (value >> (6 * i) & 0x3F));
        return Status::ok;
    }
    template <class Read>
    constexpr Status put_all(Span<const std::uint8_t> bytes, Read read) {
        for (std::ptrdiff_t i = 0; i < bytes.size();) {
            const ReadCharacter character = read(bytes.from(i));
            if (const Status s = put(character.value); s != Status::ok) return s;
            i += character.bytes;
        }
        return Status::ok;
    }

private:
    constexpr Status byte(std::uint32_t value) {
        if (size_ >= room_.size()) return Status::buffer_too_small;
        room_[size_++] = static_cast<std::uint8_t>(value);
        return Status::ok;
    }

    Span<std::uint8_t> room_;
    int size_ = 0;
};

/// Bytes of one interpretation.
inline Status put_segment(Span<const std::uint8_t> bytes, int eci, Utf8Writer& writer) {
    constexpr int shift_jis = 20;
    constexpr int utf_16 = 25;
    constexpr int utf_8 = 26;
    constexpr int gb_2312_set = 29;
    if (eci == TextSegment::not_stated)
        eci = all_characters(bytes, read_utf8) ? utf_8 : plausible_shift_jis(bytes) ? shift_jis : 3;
    if (eci == gb_2312_set) return writer.put_all(bytes, read_gb_2312);
    if (eci == shift_jis) return writer.put_all(bytes, read_shift_jis);
    if (eci == utf_16) return writer.put_all(bytes, read_utf16);
    if (eci == utf_8) return writer.put_all(bytes, read_utf8);
    UpperHalf half;
    if (!upper_half(eci, half)) return Status::unsupported;
    return writer.put_all(bytes, [&](Span<const std::uint8_t> rest) {
        const int byte = rest[0];
        return ReadCharacter{
            byte < half.first ? static_cast<std::uint32_t>(byte) : half.characters[byte - half.first], 1};
    });
}

}  // namespace detail

inline Result<int> text_utf8(const CodeText& text, int first, int size, Span<std::uint8_t> utf8) {
    if (first < 0 || size < 0 || first > text.size() - size) return Status::out_of_range;
    detail::Utf8Writer writer(utf8);
    const Span<const TextSegment> segments = text.segments();
    const int last = first + size;
    for (std::ptrdiff_t i = -1; i < segments.size(); ++i) {
        const int begin = maximum(i < 0 ? 0 : segments[i].first, first);
        const int end = minimum(i + 1 < segments.size() ? segments[i + 1].first : text.size(), last);
        if (begin >= end) continue;
        const int eci = i < 0 ? TextSegment::not_stated : segments[i].eci;
        const Status status = detail::put_segment(text.bytes().from(begin).first(end - begin), eci, writer);
        if (status != Status::ok) return status;
    }
    return writer.size();
}

}  // namespace fovea
