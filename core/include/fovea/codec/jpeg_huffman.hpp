// SPDX-License-Identifier: MIT
//
// The Huffman codes of a JPEG file and the reader of its entropy-coded bits. ITU-T T.81 Annex C and F.2.2.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>

namespace fovea::jpeg {

// ---- Interface --------------------------------------------------------------------

/// A code as a DHT segment holds it: how many code words have 1 to 16 bits, then their symbols. T.81 B.2.4.2.
///
/// Answers the bytes that belong to the code at the start of bytes.
/// Errors   malformed if they are too few, more than 256 symbols, or more code words than their lengths allow
/// Source   T.81 B.2.4.2, C.2
constexpr Result<Span<const std::uint8_t>> read_code(Span<const std::uint8_t> bytes);

/// The longest code word. T.81 C.2.
inline constexpr int max_code_bits = 16;

/// Unpacks entropy-coded bytes to bits, the first bit of a byte first, and takes out the stuffed zero behind
/// every 0xff. It never passes a marker: from there on, and from the end of the bytes, it gives zeros, and
/// overrun() tells when one of them was taken. T.81 F.2.2.5.
class BitReader {
public:
    explicit BitReader(Span<const std::uint8_t> bytes)
        : at_(bytes.data()), end_(bytes.data() + bytes.size()) {}

    /// Makes at least bits available for peek(), bits up to max_code_bits.
    [[gnu::always_inline]] void fill(int bits) {
        if (count_ < bits) refill();
    }
    /// The next 1 to 16 bits, which must be available.
    [[gnu::always_inline]] std::uint32_t peek(int bits) const {
        return static_cast<std::uint32_t>(window_ >> (window_bits - bits));
    }
    [[gnu::always_inline]] void skip(int bits) {
        window_ <<= bits;
        count_ -= bits;
    }
    bool overrun() const { return count_ < borrowed_; }
    /// What an overrun means: truncated at the end of the bytes, malformed at a marker that comes too early.
    Status overrun_status() const { return at_marker() ? Status::malformed : Status::truncated; }

    /// Drops the padding bits behind the last code word and answers the bytes from the next marker on.
    ///
    /// Errors  malformed for a whole byte that was not used, truncated if the bytes end without a marker
    Result<Span<const std::uint8_t>> marker_behind() const;

private:
    using Window = std::conditional_t<(sizeof(void*) >= 8), std::uint64_t, std::uint32_t>;
    static constexpr int window_bits = 8 * sizeof(Window);
    static_assert(window_bits - 7 >= max_code_bits, "a refill leaves less than a byte of room");

    bool at_marker() const { return end_ - at_ >= 2 && at_[0] == 0xff && at_[1] != 0; }
    void refill();

    const std::uint8_t* at_;
    const std::uint8_t* end_;
    Window window_ = 0;  // the next bit on top, zeros below the count_ bits that are filled
    int count_ = 0;
    int borrowed_ = 0;  // how many of them, the last ones, are zeros from beyond the end
};

/// A code ready to decode with: one step for words of up to lookup_bits bits, a search by length for others.
class HuffmanTable {
public:
    /// code comes from read_code() and must outlive the table.
    void build(Span<const std::uint8_t> code);

    /// The symbol of the next code word, which is skipped; -1 if no word begins so. Fill max_code_bits first.
    ///
    /// Source  T.81 F.2.2.3, figure F.16
    [[gnu::always_inline]] int decode(BitReader& bits) const {
        const std::uint16_t entry = lookup_[bits.peek(lookup_bits)];
        if (entry == 0) return decode_long(bits);
        bits.skip(entry >> 8);
        return entry & 255;
    }

private:
    static constexpr int lookup_bits = 9;

    int decode_long(BitReader& bits) const;

    // By the next bits: length << 8 | symbol of the word they begin with, 0 if it is longer.
    std::uint16_t lookup_[1 << lookup_bits];
    // By length: the first 16 bits that no word of that length or shorter begins with.
    std::uint32_t beyond_[max_code_bits + 1];
    // By length: what to add to a word for the place of its symbol.
    std::int32_t offset_[max_code_bits + 1];
    const std::uint8_t* symbols_;
};

// ---- Implementation ---------------------------------------------------------------

constexpr Result<Span<const std::uint8_t>> read_code(Span<const std::uint8_t> bytes) {
    constexpr int lengths = 16;
    if (bytes.size() < lengths) return Status::malformed;
    int words = 0;
    int room = 1;  // words of the present length that are left; the last, all ones, is never used
    for (int i = 0; i < lengths; ++i) {
        words += bytes[i];
        room = 2 * room - bytes[i];
        if (room < 1) return Status::malformed;
    }
    if (words > 256 || bytes.size() < lengths + words) return Status::malformed;
    return bytes.first(lengths + words);
}

inline void BitReader::refill() {
    constexpr int window_bytes = sizeof(Window);
    constexpr Window ones = static_cast<Window>(~Window{0} / 255);  // 1 in every byte
    if (end_ - at_ >= window_bytes) {
        Window next = 0;
        for (int i = 0; i < window_bytes; ++i) next = static_cast<Window>(next << 8 | at_[i]);
        // The top bit of a byte is set in both factors if the byte is 0xff: then its low seven bits carry.
        const bool stuffed = (((next & ones * 0x7f) + ones) & next & (ones * 0x80)) != 0;
        if (!stuffed) {
            const int take = (window_bits - count_) / 8;
            window_ |= (next & ~Window{0} << (window_bits - 8 * take)) >> count_;
            count_ += 8 * take;
            at_ += take;
            return;
        }
    }
    while (count_ <= window_bits - 8) {
        Window byte = 0;
        if (at_ == end_ || (at_[0] == 0xff && (end_ - at_ < 2 || at_[1] != 0))) {
            borrowed_ += 8;
        } else {
            byte = *at_;
            at_ += byte == 0xff ? 2 : 1;
        }
        window_ |= byte << (window_bits - 8 - count_);
        count_ += 8;
    }
}

inline Result<Span<const std::uint8_t>> BitReader::marker_behind() const {
    if (count_ - borrowed_ >= 8) return Status::malformed;
    if (at_marker()) return Span<const std::uint8_t>(at_, end_ - at_);
    const bool ends = at_ == end_ || (end_ - at_ == 1 && at_[0] == 0xff);
    return ends ? Status::truncated : Status::malformed;
}

/// T.81 Annex C: words of one length are consecutive numbers, and the next length goes on where they end.
inline void HuffmanTable::build(Span<const std::uint8_t> code) {
    for (std::uint16_t& entry : lookup_) entry = 0;
    symbols_ = code.data() + max_code_bits;
    int number = 0;
    int word = 0;
    for (int length = 1; length <= max_code_bits; ++length) {
        offset_[length] = number - word;
        for (int i = 0; i < code[length - 1]; ++i, ++number, ++word) {
            if (length > lookup_bits) continue;
            const int spare = lookup_bits - length;
            for (int below = 0; below < 1 << spare; ++below)
                lookup_[(word << spare) + below] = static_cast<std::uint16_t>(length << 8 | symbols_[number]);
        }
        beyond_[length] = static_cast<std::uint32_t>(word) << (max_code_bits - length);
        word *= 2;
    }
}

inline int HuffmanTable::decode_long(BitReader& bits) const {
    const std::uint32_t next = bits.peek(max_code_bits);
    for (int length = lookup_bits + 1; length <= max_code_bits; ++length)
        if (next < beyond_[length]) {
            bits.skip(length);
            const auto word = static_cast<std::int32_t>(next >> (max_code_bits - length));
            return symbols_[offset_[length] + word];
        }
    return -1;
}

}  // namespace fovea::jpeg
