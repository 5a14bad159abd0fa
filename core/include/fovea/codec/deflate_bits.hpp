// SPDX-License-Identifier: MIT
//
// Deflate's bits, first bit lowest: read from data that come in pieces, written into one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include <fovea/base/span.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

/// Compressed data that lie in one piece. Data in several pieces come from any class with such a next().
class OnePiece {
public:
    explicit constexpr OnePiece(Span<const std::uint8_t> bytes) : bytes_(bytes) {}
    /// The next piece; an empty one after the last, for ever.
    constexpr Span<const std::uint8_t> next() {
        const Span<const std::uint8_t> piece = bytes_;
        bytes_ = {};
        return piece;
    }

private:
    Span<const std::uint8_t> bytes_;
};

/// Reads the bits of a source.
///
/// count_ bits stand in word_, then come the bytes at_..end_. Above its count, word_ holds nothing but bits
/// of those bytes, so that filling it up again changes nothing.
template <class Source>
class DeflateBitReader {
public:
    using Word = std::conditional_t<sizeof(std::size_t) >= 8, std::uint64_t, std::uint32_t>;
    static constexpr int word_bits = 8 * static_cast<int>(sizeof(Word));
    /// What fill() makes sure of where the data suffice: 56 or 24 bits.
    static constexpr int filled_bits = word_bits - 8;

    explicit DeflateBitReader(Source& source) : source_(&source) {}

    int count() const { return count_; }
    std::uint32_t peek() const { return static_cast<std::uint32_t>(word_); }
    void drop(int bits) {
        word_ >>= bits;
        count_ -= bits;
    }
    /// The next 0..16 bits, which must be at hand.
    std::uint32_t take(int bits) {
        const std::uint32_t taken = peek() & ((1u << bits) - 1);
        drop(bits);
        return taken;
    }

    void fill() {
        if (end_ - at_ >= static_cast<std::ptrdiff_t>(sizeof(Word))) {
            word_ |= load(at_) << count_;
            at_ += (word_bits - 1 - count_) / 8;
            count_ |= word_bits - 8;
        } else {
            // By value, so that a copy on the stack never has its address taken and stays in registers.
            *this = filled_bytewise(*this);
        }
    }

    /// The next whole byte, -1 at the end of the data.
    int next_byte() {
        drop(count_ % 8);
        if (count_ == 0) fill();
        return count_ == 0 ? -1 : static_cast<int>(take(8));
    }

    /// Up to `wanted` whole bytes; fewer at the end of the data. count() must be a multiple of 8.
    int copy_bytes(std::uint8_t* to, int wanted) {
        int done = 0;
        for (; done < wanted && count_ > 0; ++done) to[done] = static_cast<std::uint8_t>(take(8));
        if (count_ > 0) return done;
        word_ = 0;
        while (done < wanted && (at_ != end_ || next_piece())) {
            const int run = static_cast<int>(minimum<std::ptrdiff_t>(wanted - done, end_ - at_));
            std::memcpy(to + done, at_, static_cast<std::size_t>(run));
            at_ += run;
            done += run;
        }
        return done;
    }

private:
    /// Spelt out, because compilers make one load of it only then.
    static Word load(const std::uint8_t* at) {
        const std::uint32_t low = std::uint32_t{at[0]} | std::uint32_t{at[1]} << 8 |
                                  std::uint32_t{at[2]} << 16 | std::uint32_t{at[3]} << 24;
        if constexpr (word_bits == 32) return low;
        const std::uint32_t high = std::uint32_t{at[4]} | std::uint32_t{at[5]} << 8 |
                                   std::uint32_t{at[6]} << 16 | std::uint32_t{at[7]} << 24;
        return static_cast<Word>(std::uint64_t{high} << 32 | low);
    }
    bool next_piece() {
        const Span<const std::uint8_t> piece = source_->next();
        at_ = piece.begin();
        end_ = piece.end();
        return !piece.empty();
    }
    static DeflateBitReader filled_bytewise(DeflateBitReader bits) {
        for (; bits.count_ < filled_bits; bits.count_ += 8) {
            if (bits.at_ == bits.end_ && !bits.next_piece()) break;
            bits.word_ |= Word{*bits.at_++} << bits.count_;
        }
        return bits;
    }

    Source* source_;
    Word word_ = 0;
    int count_ = 0;
    const std::uint8_t* at_ = nullptr;
    const std::uint8_t* end_ = nullptr;
};

/// Writes bits. Whoever writes asks has_room() before.
class DeflateBitWriter {
public:
    explicit DeflateBitWriter(Span<std::uint8_t> dst) : dst_(dst) {}

    /// Whether so many more bits fit.
    bool has_room(std::int64_t bits) const { return (count_ + bits + 7) / 8 <= dst_.size() - at_; }
    /// Bits since the last whole byte, 0..7.
    int begun_bits() const { return count_ % 8; }
    /// The lowest 0..16 of `bits`; the others must be zero.
    void put(std::uint32_t bits, int count) {
        word_ |= bits << count_;
        count_ += count;
        if (count_ < 16) return;
        put_byte();
        put_byte();
    }
    /// Fills the byte begun with zeros, and answers how many bytes are written.
    std::ptrdiff_t align() {
        while (count_ > 0) put_byte();
        count_ = 0;
        return at_;
    }
    /// Whole bytes; only after align().
    void copy(const std::uint8_t* from, int count) {
        std::memcpy(dst_.data() + at_, from, static_cast<std::size_t>(count));
        at_ += count;
    }

private:
    void put_byte() {
        dst_[at_++] = static_cast<std::uint8_t>(word_ & 0xff);
        word_ >>= 8;
        count_ -= 8;
    }

    Span<std::uint8_t> dst_;
    std::ptrdiff_t at_ = 0;
    std::uint32_t word_ = 0;
    int count_ = 0;
};

}  // namespace fovea
