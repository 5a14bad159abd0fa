// SPDX-License-Identifier: MIT
//
// Deflate: writes data in the zlib format, block by block.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/base/assert.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/codec/deflate_bits.hpp>
#include <fovea/codec/deflate_codes.hpp>
#include <fovea/codec/deflate_matches.hpp>
#include <fovea/codec/zlib.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Scratch bytes of a ZlibWriter.
constexpr std::int64_t deflate_scratch();

/// The most bytes that a ZlibWriter makes of so many: all of them in stored blocks.
constexpr std::int64_t deflated_bytes(std::int64_t bytes);

/// Writes data in the zlib format.
///
/// The data go into room(), a piece at a time, each followed by add(); finish() ends them. Every block of
/// block_bytes is sent with codes made for it, with the fixed codes or stored, whichever is shortest.
///
/// Time     proportional to the bytes, with at most search_depth comparisons at each
/// Scratch  deflate_scratch() bytes at any alignment, untouched between calls; less is our own mistake
/// Source   RFC 1950, RFC 1951. Of two matches that begin at neighbouring bytes the longer one is taken
class ZlibWriter {
public:
    /// Of a block, and of the past that its matches reach. On 31 photographs, drawings and screens 8192 costs
    /// 1 % against 32768, and scratch is 53 KB instead of 182.
    static constexpr int block_bytes = 8192;
    /// Places tried for a match. 16 saves 0.3 %, 4 loses 0.4 %.
    static constexpr int search_depth = 8;
    /// A match this long ends the search.
    static constexpr int long_match = 64;
    /// A match this long is taken without a look at the next byte. 4 loses 0.9 %, 32 saves nothing.
    static constexpr int good_match = 16;

    ZlibWriter(Span<std::uint8_t> scratch, Span<std::uint8_t> dst);

    /// Where the next data go, never empty.
    Span<std::uint8_t> room();
    /// Says that the first `count` bytes of room() hold data now.
    void add(std::ptrdiff_t count) {
        FOVEA_ASSERT(count <= block_bytes - filled_);
        filled_ += static_cast<int>(count);
    }
    /// Ends the data and answers how many bytes of dst they take. Nothing may follow.
    ///
    /// Errors  buffer_too_small; dst is undefined then
    Result<std::ptrdiff_t> finish();

private:
    using Finder = DeflateMatches<block_bytes, 12>;
    static constexpr int most_matches = block_bytes / Finder::shortest_match;
    static constexpr int list_bytes = 5 * most_matches;
    friend constexpr std::int64_t deflate_scratch();

    std::uint8_t* block() const { return window_ + block_bytes; }
    int end() const { return block_bytes + filled_; }
    DeflateMatch match_at(int at);
    void find_matches();
    void take_match(int at, DeflateMatch match);
    void put_content();
    void put_stored(std::uint32_t last);
    void write_block(std::uint32_t last);

    std::uint8_t* window_;  ///< the block before, then the block
    Finder finder_;
    DeflateCodes codes_;
    PackedNumbers starts_;  ///< of the matches, within the block
    PackedNumbers distances_;
    std::uint8_t* stretches_;  ///< their lengths less the shortest
    DeflateBitWriter out_;
    Adler32 adler_;
    bool overflow_ = false;
    int filled_ = 0;   ///< bytes of the block
    int history_ = 0;  ///< bytes of the block before
    int matches_ = 0;
};

// ---- Implementation ---------------------------------------------------------------

constexpr std::int64_t deflate_scratch() {
    return 2 * ZlibWriter::block_bytes + ZlibWriter::Finder::scratch_bytes + DeflateCodes::scratch_bytes +
           ZlibWriter::list_bytes;
}

constexpr std::int64_t deflated_bytes(std::int64_t bytes) {
    // Header and checksum are 6 bytes, every block has 5 more than it stores, and there is at least one.
    const std::int64_t blocks = (bytes + ZlibWriter::block_bytes - 1) / ZlibWriter::block_bytes;
    return 6 + bytes + 5 * maximum<std::int64_t>(blocks, 1);
}

inline ZlibWriter::ZlibWriter(Span<std::uint8_t> scratch, Span<std::uint8_t> dst)
    : window_(scratch.data()),
      finder_(window_ + 2 * block_bytes),
      codes_(window_ + 2 * block_bytes + Finder::scratch_bytes),
      starts_(window_ + 2 * block_bytes + Finder::scratch_bytes + DeflateCodes::scratch_bytes),
      distances_(starts_.bytes() + 2 * most_matches),
      stretches_(distances_.bytes() + 2 * most_matches),
      out_(dst) {
    FOVEA_ASSERT(scratch.size() >= deflate_scratch());
    overflow_ = !out_.has_room(16);
    if (overflow_) return;
    // Deflate, a window of 2^(8 + 5) bytes; 31 divides 0x5809.
    static_assert(block_bytes == 1 << (8 + 5), "the header states the window");
    out_.put(0x58, 8);
    out_.put(0x09, 8);
}

inline Span<std::uint8_t> ZlibWriter::room() {
    if (filled_ == block_bytes) {
        write_block(0);
        std::memcpy(window_, block(), block_bytes);
        finder_.advance();
        history_ = block_bytes;
        filled_ = 0;
    }
    return {block() + filled_, block_bytes - filled_};
}

inline void ZlibWriter::take_match(int at, DeflateMatch match) {
    starts_.put(matches_, static_cast<std::uint32_t>(at - block_bytes));
    distances_.put(matches_, static_cast<std::uint32_t>(match.distance));
    stretches_[matches_] = static_cast<std::uint8_t>(match.length - Deflate::shortest_match);
    ++matches_;
    codes_.count(match);
}

inline DeflateMatch ZlibWriter::match_at(int at) {
    const int most = minimum(end() - at, Deflate::longest_match);
    const int reach = minimum(history_ + at - block_bytes, block_bytes);
    return finder_.find(window_, at, most, reach, search_depth, long_match);
}

inline void ZlibWriter::find_matches() {
    codes_.clear();
    matches_ = 0;
    for (int at = block_bytes; at < end();) {
        DeflateMatch match = match_at(at);
        int entered = at;
        while (match.length > 0 && match.length < good_match) {
            entered = at + 1;
            const DeflateMatch later = match_at(at + 1);
            if (later.length <= match.length) break;
            codes_.count(window_[at++]);
            match = later;
        }
        if (match.length == 0) {
            codes_.count(window_[at++]);
            continue;
        }
        take_match(at, match);
        at += match.length;
        while (++entered < minimum(at, end() - Finder::shortest_match + 1)) finder_.enter(window_, entered);
    }
}

inline void ZlibWriter::put_content() {
    int at = 0;
    for (int i = 0; i < matches_; ++i) {
        const int start = static_cast<int>(starts_[i]);
        for (; at < start; ++at) codes_.put(block()[at], out_);
        const DeflateMatch match = {stretches_[i] + Deflate::shortest_match, static_cast<int>(distances_[i])};
        codes_.put(match, out_);
        at += match.length;
    }
    for (; at < filled_; ++at) codes_.put(block()[at], out_);
    codes_.put_end(out_);
}

inline void ZlibWriter::put_stored(std::uint32_t last) {
    out_.put(last, 3);
    static_cast<void>(out_.align());
    out_.put(static_cast<std::uint32_t>(filled_), 16);
    out_.put(static_cast<std::uint32_t>(filled_) ^ 0xffff, 16);
    out_.copy(block(), filled_);
}

inline void ZlibWriter::write_block(std::uint32_t last) {
    adler_.add({block(), filled_});
    find_matches();
    const std::int64_t coded_bits = codes_.make();
    const int padding = (8 - (out_.begun_bits() + 3) % 8) % 8;
    const std::int64_t stored_bits = 3 + padding + 32 + std::int64_t{8} * filled_;
    overflow_ = overflow_ || !out_.has_room(minimum(coded_bits, stored_bits));
    if (overflow_) return;
    if (stored_bits <= coded_bits) {
        put_stored(last);
    } else {
        codes_.put_header(last, out_);
        put_content();
    }
}

inline Result<std::ptrdiff_t> ZlibWriter::finish() {
    write_block(1);
    if (overflow_) return Status::buffer_too_small;
    static_cast<void>(out_.align());
    if (!out_.has_room(32)) return Status::buffer_too_small;
    const std::uint32_t sum = adler_.value();
    for (int shift = 24; shift >= 0; shift -= 8) out_.put(sum >> shift & 0xff, 8);
    return out_.align();
}

}  // namespace fovea
