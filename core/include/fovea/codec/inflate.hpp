// SPDX-License-Identifier: MIT
//
// Inflate: reads deflate data and the zlib format around it, piece by piece, through a window of 32 KiB.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/base/assert.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/codec/deflate_bits.hpp>
#include <fovea/codec/prefix_code.hpp>
#include <fovea/codec/zlib.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Scratch bytes of an Inflater or a ZlibReader: the window and the tables of its codes.
constexpr std::int64_t inflate_scratch();

/// Reads deflate data. Source is OnePiece or a class like it, and must outlive the reader.
///
/// Time     proportional to the bytes read and written; a block costs its tables, of 1280 entries, besides
/// Scratch  inflate_scratch() bytes at any alignment, untouched between calls; less is our own mistake
/// Source   RFC 1951. A code must be complete; as in zlib, a single code of one bit and an empty distance
///          code are let through until data use what is missing
template <class Source>
class Inflater {
public:
    Inflater(Source& source, Span<std::uint8_t> scratch);

    /// Writes the next bytes and answers how many: fewer than dst.size() only at the end of the data.
    ///
    /// Errors  truncated, malformed; dst is undefined then, and every further call answers the same
    Result<std::ptrdiff_t> read(Span<std::uint8_t> dst);

    /// The next byte of what stands before the data or behind them, -1 at its end. Only before the first
    /// read() or after the one that came to the end.
    int outer_byte() { return bits_.next_byte(); }

private:
    using Bits = DeflateBitReader<Source>;
    enum class Phase : std::uint8_t { between_blocks, stored, coded, finished };

    Status begin_block();
    Status begin_stored();
    void begin_fixed();
    Status begin_dynamic();
    Status read_code_lengths(int count);
    Status read_stored(int room);
    Status read_coded(int room);
    Status read_match(Bits& bits, int symbol, int& length, int& distance) const;

    static constexpr int window_bytes = Deflate::window_bytes;
    static constexpr int lengths_bytes = Deflate::fixed_literals + Deflate::fixed_distances;
    using Literals = PrefixDecoder<Deflate::fixed_literals, 10>;
    using Distances = PrefixDecoder<Deflate::fixed_distances, 8>;
    friend constexpr std::int64_t inflate_scratch();

    Bits bits_;
    std::uint8_t* window_;
    std::uint8_t* lengths_;
    Literals literals_;
    Distances distances_;
    Phase phase_ = Phase::between_blocks;
    Status status_ = Status::ok;
    bool last_block_ = false;
    bool fixed_ = false;   ///< the decoders hold the fixed codes
    int at_ = 0;           ///< where the window is written next, below window_bytes between calls
    int history_ = 0;      ///< bytes of the window that hold data
    int stored_left_ = 0;  ///< of a stored block
    int copy_left_ = 0;    ///< of a match
    int copy_distance_ = 0;
};

/// Reads data in the zlib format.
///
/// Scratch  as Inflater
/// Source   RFC 1950. The window size that the header states is not held against the data, as in zlib
template <class Source>
class ZlibReader {
public:
    ZlibReader(Source& source, Span<std::uint8_t> scratch) : inflater_(source, scratch) {}

    /// As Inflater::read(). At the end of the data the checksum is compared, and nothing may follow it.
    ///
    /// Errors  truncated, malformed, unsupported for data that need a preset dictionary
    Result<std::ptrdiff_t> read(Span<std::uint8_t> dst);

private:
    Status read_header();
    Status read_checksum();

    Inflater<Source> inflater_;
    Adler32 adler_;
    Status status_ = Status::ok;
    bool begun_ = false;
    bool ended_ = false;
};

/// Reads data in the zlib format that lie in one piece, and answers how many bytes they make.
///
/// Scratch  inflate_scratch() bytes at any alignment, undefined afterwards
/// Errors   scratch_too_small; buffer_too_small, truncated, malformed, unsupported, after which dst is
///          undefined
/// Source   as ZlibReader
inline Result<std::ptrdiff_t> inflate_zlib(Span<const std::uint8_t> bytes, Span<std::uint8_t> scratch,
                                           Span<std::uint8_t> dst);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Copies within the window. Where the two overlap, what was written is read again: a short match repeats.
inline void copy_match(std::uint8_t* to, const std::uint8_t* from, int count) {
    if (from > to || to - from >= count)
        std::memmove(to, from, static_cast<std::size_t>(count));
    else
        for (int i = 0; i < count; ++i) to[i] = from[i];
}

/// What it means that `read` is no code within the bits at hand.
constexpr Status bad_code(int count) {
    return count < Deflate::longest_code ? Status::truncated : Status::malformed;
}
constexpr bool is_code(PrefixSymbol read, int count) { return read.length > 0 && read.length <= count; }

}  // namespace detail

constexpr std::int64_t inflate_scratch() {
    using Any = Inflater<OnePiece>;
    return Any::window_bytes + Any::lengths_bytes + Any::Literals::scratch_bytes +
           Any::Distances::scratch_bytes;
}

template <class Source>
Inflater<Source>::Inflater(Source& source, Span<std::uint8_t> scratch)
    : bits_(source),
      window_(scratch.data()),
      lengths_(window_ + window_bytes),
      literals_(lengths_ + lengths_bytes),
      distances_(lengths_ + lengths_bytes + Literals::scratch_bytes) {
    FOVEA_ASSERT(scratch.size() >= inflate_scratch());
}

template <class Source>
Result<std::ptrdiff_t> Inflater<Source>::read(Span<std::uint8_t> dst) {
    std::ptrdiff_t done = 0;
    while (status_ == Status::ok && done < dst.size() && phase_ != Phase::finished) {
        const int start = at_;
        const int room = static_cast<int>(minimum<std::ptrdiff_t>(dst.size() - done, window_bytes - at_));
        switch (phase_) {
            case Phase::stored: status_ = read_stored(room); break;
            case Phase::coded: status_ = read_coded(room); break;
            default: status_ = begin_block(); break;
        }
        const int made = at_ - start;
        std::memcpy(dst.data() + done, window_ + start, static_cast<std::size_t>(made));
        done += made;
        history_ = minimum(history_ + made, window_bytes);
        if (at_ == window_bytes) at_ = 0;
    }
    if (status_ != Status::ok) return status_;
    return done;
}

template <class Source>
Status Inflater<Source>::begin_block() {
    if (last_block_) {
        phase_ = Phase::finished;
        return Status::ok;
    }
    bits_.fill();
    if (bits_.count() < 3) return Status::truncated;
    last_block_ = bits_.take(1) == 1;
    switch (bits_.take(2)) {
        case 0: return begin_stored();
        case 1: begin_fixed(); return Status::ok;
        case 2: return begin_dynamic();
        default: return Status::malformed;
    }
}

template <class Source>
Status Inflater<Source>::begin_stored() {
    int bytes[4] = {};
    for (int& byte : bytes) {
        byte = bits_.next_byte();
        if (byte < 0) return Status::truncated;
    }
    if (bytes[2] != 255 - bytes[0] || bytes[3] != 255 - bytes[1]) return Status::malformed;
    stored_left_ = bytes[1] << 8 | bytes[0];
    phase_ = Phase::stored;
    return Status::ok;
}

template <class Source>
Status Inflater<Source>::read_stored(int room) {
    const int wanted = minimum(room, stored_left_);
    if (bits_.copy_bytes(window_ + at_, wanted) != wanted) return Status::truncated;
    at_ += wanted;
    stored_left_ -= wanted;
    if (stored_left_ == 0) phase_ = Phase::between_blocks;
    return Status::ok;
}

template <class Source>
void Inflater<Source>::begin_fixed() {
    phase_ = Phase::coded;
    if (fixed_) return;
    fixed_ = true;
    for (int i = 0; i < Deflate::fixed_literals; ++i)
        lengths_[i] = static_cast<std::uint8_t>(Deflate::fixed_literal_length(i));
    static_cast<void>(literals_.build({lengths_, Deflate::fixed_literals}));
    for (int i = 0; i < Deflate::fixed_distances; ++i) lengths_[i] = Deflate::fixed_distance_length;
    static_cast<void>(distances_.build({lengths_, Deflate::fixed_distances}));
}

template <class Source>
Status Inflater<Source>::begin_dynamic() {
    fixed_ = false;
    phase_ = Phase::coded;
    bits_.fill();
    if (bits_.count() < 14) return Status::truncated;
    const int literals = static_cast<int>(bits_.take(5)) + 257;
    const int distances = static_cast<int>(bits_.take(5)) + 1;
    const int order = static_cast<int>(bits_.take(4)) + 4;
    if (literals > Deflate::literals || distances > Deflate::distances) return Status::malformed;

    std::uint8_t of_lengths[Deflate::order_symbols] = {};
    for (int i = 0; i < order; ++i) {
        bits_.fill();
        if (bits_.count() < 3) return Status::truncated;
        of_lengths[Deflate::order[i]] = static_cast<std::uint8_t>(bits_.take(3));
    }
    // The distance decoder's turn comes later; until then it reads the code lengths.
    if (distances_.build(of_lengths) != PrefixCodeShape::complete) return Status::malformed;
    if (Status s = read_code_lengths(literals + distances); s != Status::ok) return s;
    if (lengths_[Deflate::end_of_block] == 0) return Status::malformed;
    if (literals_.build({lengths_, literals}) == PrefixCodeShape::wrong) return Status::malformed;
    if (distances_.build({lengths_ + literals, distances}) == PrefixCodeShape::wrong)
        return Status::malformed;
    return Status::ok;
}

/// Code lengths of both codes in a row; runs may cross from the first to the second.
template <class Source>
Status Inflater<Source>::read_code_lengths(int count) {
    for (int i = 0; i < count;) {
        bits_.fill();
        const PrefixSymbol read = distances_.read(bits_.peek());
        if (!detail::is_code(read, bits_.count())) return detail::bad_code(bits_.count());
        bits_.drop(read.length);
        if (read.symbol < 16) {
            lengths_[i++] = static_cast<std::uint8_t>(read.symbol);
            continue;
        }
        const int bits = read.symbol == 16 ? 2 : read.symbol == 17 ? 3 : 7;
        if (bits_.count() < bits) return Status::truncated;
        const int run = static_cast<int>(bits_.take(bits)) + (read.symbol == 18 ? 11 : 3);
        if (run > count - i || (read.symbol == 16 && i == 0)) return Status::malformed;
        std::memset(lengths_ + i, read.symbol == 16 ? lengths_[i - 1] : 0, static_cast<std::size_t>(run));
        i += run;
    }
    return Status::ok;
}

/// Decodes into the window until `room` bytes are made or the block ends.
template <class Source>
Status Inflater<Source>::read_coded(int room) {
    Bits bits = bits_;
    int at = at_;
    const int end = at_ + room;
    int length = copy_left_;
    int distance = copy_distance_;
    Status status = Status::ok;
    for (;;) {
        while (length > 0 && at < end) {
            const int from = (at - distance) & (window_bytes - 1);
            const int run = minimum(minimum(length, end - at), window_bytes - from);
            detail::copy_match(window_ + at, window_ + from, run);
            at += run;
            length -= run;
        }
        if (at == end) break;
        bits.fill();
        const PrefixSymbol read = literals_.read(bits.peek());
        if (!detail::is_code(read, bits.count())) {
            status = detail::bad_code(bits.count());
            break;
        }
        bits.drop(read.length);
        if (read.symbol < Deflate::end_of_block) {
            window_[at++] = static_cast<std::uint8_t>(read.symbol);
            continue;
        }
        if (read.symbol == Deflate::end_of_block) {
            phase_ = Phase::between_blocks;
            break;
        }
        status = read_match(bits, read.symbol, length, distance);
        if (status == Status::ok && distance > history_ + (at - at_)) status = Status::malformed;
        if (status != Status::ok) break;
    }
    bits_ = bits;
    at_ = at;
    copy_left_ = length;
    copy_distance_ = distance;
    return status;
}

/// Length and distance of a match whose length symbol was read.
template <class Source>
Status Inflater<Source>::read_match(Bits& bits, int symbol, int& length, int& distance) const {
    const int index = symbol - Deflate::end_of_block - 1;
    if (index >= Deflate::length_codes) return Status::malformed;
    const int length_bits = Deflate::length_bits[index];
    if (bits.count() < length_bits) return Status::truncated;
    const int extra = static_cast<int>(bits.take(length_bits));
    // A literal, a distance and their extra bits are 48 bits together; a word of 32 fills up in between.
    if constexpr (Bits::filled_bits < 48) bits.fill();
    const PrefixSymbol read = distances_.read(bits.peek());
    if (!detail::is_code(read, bits.count())) return detail::bad_code(bits.count());
    bits.drop(read.length);
    if (read.symbol >= Deflate::distances) return Status::malformed;
    const int distance_bits = Deflate::distance_bits(read.symbol);
    if constexpr (Bits::filled_bits < 48) bits.fill();
    if (bits.count() < distance_bits) return Status::truncated;
    length = Deflate::length_base[index] + Deflate::shortest_match + extra;
    distance = Deflate::distance_base[read.symbol] + 1 + static_cast<int>(bits.take(distance_bits));
    return Status::ok;
}

template <class Source>
Result<std::ptrdiff_t> ZlibReader<Source>::read(Span<std::uint8_t> dst) {
    if (!begun_) status_ = read_header();
    begun_ = true;
    if (status_ != Status::ok) return status_;
    const Result<std::ptrdiff_t> done = inflater_.read(dst);
    if (!done) {
        status_ = done.status();
        return status_;
    }
    adler_.add(dst.first(*done));
    if (*done < dst.size() && !ended_) {
        ended_ = true;
        status_ = read_checksum();
        if (status_ != Status::ok) return status_;
    }
    return *done;
}

template <class Source>
Status ZlibReader<Source>::read_header() {
    const int method = inflater_.outer_byte();
    const int flags = inflater_.outer_byte();
    if (method < 0 || flags < 0) return Status::truncated;
    // Deflate with a window of at most 32 KiB, and a number that 31 divides.
    if (method % 16 != 8 || method / 16 > 7 || (method * 256 + flags) % 31 != 0) return Status::malformed;
    return (flags & 0x20) != 0 ? Status::unsupported : Status::ok;
}

template <class Source>
Status ZlibReader<Source>::read_checksum() {
    std::uint32_t stated = 0;
    for (int i = 0; i < 4; ++i) {
        const int byte = inflater_.outer_byte();
        if (byte < 0) return Status::truncated;
        stated = stated << 8 | static_cast<std::uint32_t>(byte);
    }
    return stated == adler_.value() && inflater_.outer_byte() < 0 ? Status::ok : Status::malformed;
}

inline Result<std::ptrdiff_t> inflate_zlib(Span<const std::uint8_t> bytes, Span<std::uint8_t> scratch,
                                           Span<std::uint8_t> dst) {
    if (scratch.size() < inflate_scratch()) return Status::scratch_too_small;
    OnePiece source(bytes);
    ZlibReader<OnePiece> reader(source, scratch);
    const Result<std::ptrdiff_t> done = reader.read(dst);
    if (!done || *done < dst.size()) return done;
    // dst is full: the data must end here, and only now is the checksum read.
    std::uint8_t more[1] = {};
    const Result<std::ptrdiff_t> beyond = reader.read(more);
    if (!beyond) return beyond.status();
    if (*beyond > 0) return Status::buffer_too_small;
    return done;
}

}  // namespace fovea
