// SPDX-License-Identifier: MIT
//
// The fewest data codewords of a Data Matrix for a text, among ASCII, C40, Text, X12, EDIFACT and Base 256.
#pragma once

#include <cstdint>
#include <initializer_list>

#include <fovea/base/arena.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/code/data_matrix_sizes.hpp>
#include <fovea/code/data_matrix_text.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Scratch bytes that DataMatrixEncodation needs for a text of that many bytes.
constexpr std::int64_t data_matrix_encodation_scratch(std::int64_t text_bytes) {
    return 16 * (text_bytes + 1);
}

/// Text as codewords. All ways to switch between the six schemes are weighed against each other at once, by
/// the codewords up to each byte for each scheme and each count of values that wait there for a full group.
///
/// Source  ISO/IEC 16022, 5.2; dynamic programming in place of the look-ahead of annex P, which it never
///         exceeds but for the second length byte of Base 256 beyond 249 bytes, which it does not foresee
class DataMatrixEncodation {
public:
    /// Weighs. gs1: byte 29 becomes FNC1. The scratch must be there: it was checked.
    DataMatrixEncodation(Span<const std::uint8_t> bytes, bool gs1, Span<std::uint8_t> scratch);

    /// The codewords for a symbol that has room for as many as codewords, padded to its end, behind the first
    /// `head` ones, which are there already; buffer_too_small if they are too few.
    Status write(int head, Span<std::uint8_t> codewords) const;

private:
    // What the encoder is in, and how many values or characters wait there.
    enum State : int {
        ascii,
        c40,
        text = c40 + 3,
        x12 = text + 3,
        edifact = x12 + 3,
        base_256 = edifact + 4,
        states
    };
    static_assert(states <= 16, "a way back is a state, and two bits for how many bytes it took");
    /// Those whose values go into codewords by three. A table and no list in the loops: GCC 12 for AArch64
    /// leaves out what fills such a list.
    static constexpr State triple_sets[3] = {c40, text, x12};
    static constexpr int never = 1 << 28;

    struct Costs {
        int of[states];
    };
    /// Values in C40 or Text.
    static int values(std::uint8_t byte, State set);
    static bool in_x12(std::uint8_t byte) {
        return byte == 13 || byte == '*' || byte == '>' || byte == ' ' || (byte >= '0' && byte <= '9') ||
               (byte >= 'A' && byte <= 'Z');
    }
    static bool in_edifact(std::uint8_t byte) { return byte >= 32 && byte <= 94; }
    static bool digit(std::uint8_t byte) { return byte >= '0' && byte <= '9'; }

    void relax(Costs& to, int at, int state, int cost, int from, int bytes);
    void switch_at(Costs& costs, int at);
    Status write_to(int last, int head, Span<std::uint8_t> codewords) const;

    Span<const std::uint8_t> text_;
    bool gs1_;
    Span<std::uint8_t> ways_;  ///< 16 for every place
    Costs end_{};
};

// ---- Implementation ---------------------------------------------------------------

inline int DataMatrixEncodation::values(std::uint8_t byte, State set) {
    const int upper = byte > 127 ? 2 : 0;
    const int low = byte & 127;
    const bool basic = low == ' ' || (low >= '0' && low <= '9') ||
                       (set == c40 ? low >= 'A' && low <= 'Z' : low >= 'a' && low <= 'z');
    return upper + (basic ? 1 : 2);
}

inline void DataMatrixEncodation::relax(Costs& to, int at, int state, int cost, int from, int bytes) {
    if (cost >= to.of[state]) return;
    to.of[state] = cost;
    ways_[std::ptrdiff_t{16} * at + state] = static_cast<std::uint8_t>(bytes << 4 | from);
}

/// Unlatches and latches without taking a byte.
inline void DataMatrixEncodation::switch_at(Costs& costs, int at) {
    for (const int from : {int{c40}, int{text}, int{x12}})
        relax(costs, at, ascii, costs.of[from] + 1, from, 0);
    // EDIFACT is only left in the third or fourth place of a group, so that a reader never takes the group
    // for the end of the symbol.
    for (const int from : {edifact + 2, edifact + 3}) relax(costs, at, ascii, costs.of[from] + 3, from, 0);
    relax(costs, at, ascii, costs.of[base_256], base_256, 0);
    for (const int into : {int{c40}, int{text}, int{x12}, int{edifact}})
        relax(costs, at, into, costs.of[ascii] + 1, ascii, 0);
    relax(costs, at, base_256, costs.of[ascii] + 2, ascii, 0);
}

inline DataMatrixEncodation::DataMatrixEncodation(Span<const std::uint8_t> bytes, bool gs1,
                                                  Span<std::uint8_t> scratch)
    : text_(bytes), gs1_(gs1), ways_(scratch) {
    const int count = static_cast<int>(text_.size());
    Costs nothing{};
    for (int& cost : nothing.of) cost = never;
    Costs at = nothing;
    Costs next = nothing;
    at.of[ascii] = 0;
    for (int i = 0; i < count; ++i) {
        switch_at(at, i);
        Costs over = nothing;
        const std::uint8_t byte = text_[i];
        relax(next, i + 1, ascii, at.of[ascii] + (byte > 127 ? 2 : 1), ascii, 1);
        if (digit(byte) && i + 1 < count && digit(text_[i + 1]))
            relax(over, i + 2, ascii, at.of[ascii] + 1, ascii, 2);
        for (const State set : {c40, text}) {
            const int more = values(byte, set);
            for (int waiting = 0; waiting < 3; ++waiting) {
                const int sum = waiting + more;
                relax(next, i + 1, set + sum % 3, at.of[set + waiting] + sum / 3 * 2, set + waiting, 1);
            }
        }
        if (in_x12(byte))
            for (int waiting = 0; waiting < 3; ++waiting)
                relax(next, i + 1, x12 + (waiting + 1) % 3, at.of[x12 + waiting] + (waiting == 2 ? 2 : 0),
                      x12 + waiting, 1);
        if (in_edifact(byte))
            for (int waiting = 0; waiting < 4; ++waiting)
                relax(next, i + 1, edifact + (waiting + 1) % 4,
                      at.of[edifact + waiting] + (waiting == 3 ? 3 : 0), edifact + waiting, 1);
        relax(next, i + 1, base_256, at.of[base_256] + 1, base_256, 1);
        at = next;
        next = over;
    }
    end_ = at;
}

inline Status DataMatrixEncodation::write(int head, Span<std::uint8_t> codewords) const {
    const int room = static_cast<int>(codewords.size()) - head;
    // Endings by how they fill the room. ISO/IEC 16022, 5.2.5.2, 5.2.7.2, 5.2.8.2.
    int best = -1;
    int cost = room + 1;
    const auto offer = [&](int state, int total, bool allowed) {
        if (!allowed || total >= cost) return;
        best = state;
        cost = total;
    };
    const auto& of = end_.of;
    offer(ascii, of[ascii], true);
    offer(base_256, of[base_256], true);
    const bool any = !text_.empty();
    for (const State set : triple_sets) {
        offer(set, of[set], true);
        // The last character as ASCII without unlatch; two values and a shift that shifts nothing.
        const bool single = any && (set == x12 || values(text_[text_.size() - 1], set) == 1);
        offer(set + 1, of[set + 1] + 1, single && of[set + 1] + 1 == room);
        if (set != x12) offer(set + 2, of[set + 2] + 2, of[set + 2] + 2 == room);
    }
    offer(edifact, of[edifact], true);
    offer(edifact + 1, of[edifact + 1] + 2, of[edifact + 1] + 3 <= room);
    offer(edifact + 2, of[edifact + 2] + 3, true);
    offer(edifact + 3, of[edifact + 3] + 3, true);
    if (best < 0) return Status::buffer_too_small;
    return write_to(best, head, codewords);
}

namespace detail {

/// Puts groups of values into codewords.
class DataMatrixWriter {
public:
    DataMatrixWriter(int head, Span<std::uint8_t> codewords) : to_(codewords), size_(head) {}

    int size() const { return size_; }
    int left() const { return static_cast<int>(to_.size()) - size_; }
    bool full() const { return full_; }
    void put(int codeword) {
        if (left() == 0) {
            full_ = true;
            return;
        }
        to_[size_++] = static_cast<std::uint8_t>(codeword);
    }
    void ascii(std::uint8_t byte, bool gs1) {
        if (gs1 && byte == data_matrix::group_separator) {
            put(data_matrix::fnc1);
            return;
        }
        if (byte > 127) put(data_matrix::upper_shift);
        put((byte & 127) + 1);
    }
    void triple_value(int value) {
        waiting_[count_++] = value;
        if (count_ < 3) return;
        const int sum = 1600 * waiting_[0] + 40 * waiting_[1] + waiting_[2] + 1;
        put(sum >> 8);
        put(sum & 255);
        count_ = 0;
    }
    void c40(std::uint8_t byte, bool text) {
        if (byte > 127) {
            triple_value(1);
            triple_value(30);
        }
        const int low = byte & 127;
        const int first = text ? int{'a'} : int{'A'};
        if (low == ' ') return triple_value(3);
        if (low >= '0' && low <= '9') return triple_value(low - '0' + 4);
        if (low >= first && low < first + 26) return triple_value(low - first + 14);
        const int set = low < 32 ? 0 : low < 96 && !(text && low >= 'A' && low <= 'Z') ? 1 : 2;
        triple_value(set);
        if (set == 0) return triple_value(low);
        if (set == 1)
            return triple_value(low < ':' ? low - '!' : low < '[' ? low - ':' + 15 : low - '[' + 22);
        triple_value(text && low >= 'A' && low <= 'Z' ? low - 'A' + 1 : low - '`');
    }
    void x12(std::uint8_t byte) {
        const int value = byte == 13 ? 0 : byte == '*' ? 1 : byte == '>' ? 2 : byte == ' ' ? 3 : -1;
        triple_value(value >= 0 ? value : byte <= '9' ? byte - '0' + 4 : byte - 'A' + 14);
    }
    void edifact(int value) {
        group_ = group_ << 6 | (value & 63);
        if (++count_ < 4) return;
        for (int shift = 16; shift >= 0; shift -= 8) put(group_ >> shift & 255);
        count_ = 0;
        group_ = 0;
    }
    /// Ends EDIFACT; the rest of the codeword that the unlatch ends in is zero.
    void leave_edifact() {
        const int codewords = count_ < 3 ? count_ + 1 : 3;
        group_ = (group_ << 6 | data_matrix::edifact_unlatch) << 6 * (3 - count_);
        for (int i = 0; i < codewords; ++i) put(group_ >> (16 - 8 * i) & 255);
        count_ = 0;
        group_ = 0;
    }
    void base_256(int byte) { put((byte + data_matrix::byte_noise(size_ + 1)) & 255); }
    int waiting() const { return count_; }
    void forget() { count_ = 0; }
    void pad() {
        if (left() > 0) put(data_matrix::pad);
        while (left() > 0) {
            const int value = data_matrix::pad + data_matrix::pad_noise(size_ + 1);
            put(value > 254 ? value - 254 : value);
        }
    }

private:
    Span<std::uint8_t> to_;
    int size_;
    int waiting_[3] = {};
    int group_ = 0;
    int count_ = 0;
    bool full_ = false;
};

}  // namespace detail

inline Status DataMatrixEncodation::write_to(int last, int head, Span<std::uint8_t> codewords) const {
    // The ways lead from the end to the beginning. The scheme of every byte is noted on the way back.
    const int count = static_cast<int>(text_.size());
    const auto scheme = [](int state) {
        return state == ascii     ? ascii
               : state < text     ? c40
               : state < x12      ? text
               : state < edifact  ? x12
               : state < base_256 ? edifact
                                  : base_256;
    };
    // In the 16th byte of a place, which no state has; 15 for the second of two digits.
    const auto mark = [&](int i) -> std::uint8_t& { return ways_.data()[std::ptrdiff_t{16} * i + 15]; };
    int state = last;
    int bytes_state = last;
    for (int i = count; i > 0 || state != ascii;) {
        const std::uint8_t way = ways_[std::ptrdiff_t{16} * i + state];
        const int took = way >> 4;
        bytes_state = state;
        state = way & 15;
        i -= took;
        if (took > 0) mark(i) = static_cast<std::uint8_t>(scheme(bytes_state));
        if (took == 2) mark(i + 1) = 15;
        if (took == 0 && i == 0 && state == ascii) break;
    }
    detail::DataMatrixWriter out(head, codewords);
    State in = ascii;
    const auto leave = [&](bool at_end) {
        if (in == c40 || in == text || in == x12) {
            if (out.waiting() == 0) {
                if (!at_end || out.left() > 0) out.put(detail::data_matrix::unlatch);
            } else if (out.waiting() == 1) {
                out.forget();
                out.ascii(text_[count - 1], gs1_);
            } else {
                out.triple_value(0);
            }
        }
        if (in == edifact && !(at_end && out.waiting() == 0 && out.left() < 3)) out.leave_edifact();
        in = ascii;
    };
    for (int i = 0; i < count; ++i) {
        const auto to = static_cast<State>(mark(i));
        if (to != in) {
            leave(false);
            in = to;
            if (to == c40) out.put(detail::data_matrix::latch_c40);
            if (to == text) out.put(detail::data_matrix::latch_text);
            if (to == x12) out.put(detail::data_matrix::latch_x12);
            if (to == edifact) out.put(detail::data_matrix::latch_edifact);
            if (to == base_256) {
                out.put(detail::data_matrix::latch_base_256);
                int length = 0;
                while (i + length < count && mark(i + length) == base_256) ++length;
                if (length > 249) out.base_256(249 + length / 250);
                out.base_256(length > 249 ? length % 250 : length);
            }
        }
        switch (to) {
            case c40: out.c40(text_[i], false); break;
            case text: out.c40(text_[i], true); break;
            case x12: out.x12(text_[i]); break;
            case edifact: out.edifact(text_[i]); break;
            case base_256: out.base_256(text_[i]); break;
            default:
                if (i + 1 < count && mark(i + 1) == 15) {
                    out.put(detail::data_matrix::digits + 10 * (text_[i] - '0') + text_[i + 1] - '0');
                    ++i;
                } else {
                    out.ascii(text_[i], gs1_);
                }
        }
    }
    leave(true);
    if (out.full()) return Status::buffer_too_small;
    out.pad();
    return Status::ok;
}

}  // namespace fovea
