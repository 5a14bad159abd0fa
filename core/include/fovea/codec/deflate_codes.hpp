// SPDX-License-Identifier: MIT
//
// DeflateCodes: the two prefix codes of a block, made for what stands in it, and the block's header.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/codec/deflate_bits.hpp>
#include <fovea/codec/deflate_matches.hpp>
#include <fovea/codec/prefix_code.hpp>
#include <fovea/codec/zlib.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

/// Counts the symbols of a block, makes the codes that send it shortest, and sends them.
///
/// clear(), count() for all that stands in the block, make(); then put_header() and put().
///
/// Memory  scratch_bytes, given by the caller at any alignment
/// Source  RFC 1951 sec. 3.2.6 and 3.2.7
class DeflateCodes {
    static constexpr int counts = Deflate::fixed_literals + Deflate::distances;

public:
    static constexpr int scratch_bytes = (2 + 2 + 1) * counts;

    explicit DeflateCodes(std::uint8_t* scratch)
        : literal_counts_(scratch),
          distance_counts_(scratch + 2 * Deflate::fixed_literals),
          literal_codes_(scratch + 2 * counts),
          distance_codes_(scratch + 2 * counts + 2 * Deflate::fixed_literals),
          lengths_(scratch + 4 * counts) {}

    void clear() {
        std::memset(literal_counts_.bytes(), 0, 2 * counts);
        extra_bits_ = 0;
        literal_counts_.put(Deflate::end_of_block, 1);
    }
    void count(std::uint8_t literal) { literal_counts_.put(literal, literal_counts_[literal] + 1); }
    void count(DeflateMatch match);

    /// Takes the shorter of the codes made for the block and the fixed ones, and answers what the block takes
    /// in bits, its kind and its header included.
    std::int64_t make();

    void put_header(std::uint32_t last, DeflateBitWriter& out) const;
    void put(std::uint8_t literal, DeflateBitWriter& out) const { put_symbol(literal, out); }
    void put(DeflateMatch match, DeflateBitWriter& out) const;
    void put_end(DeflateBitWriter& out) const { put_symbol(Deflate::end_of_block, out); }

private:
    /// A run in the list of both codes' lengths: a symbol of the code that sends it, and what tells the run.
    struct Run {
        int symbol = 0;
        int extra = 0;
    };
    static constexpr int extra_bits(int symbol) {
        return symbol < 16 ? 0 : symbol == 16 ? 2 : symbol == 17 ? 3 : 7;
    }

    static int used(const std::uint8_t* lengths, int count, int least);
    template <class Use>
    void for_each_run(Use use) const;
    int make_order_code();
    std::int64_t content_bits() const;
    void make_own_lengths();
    void make_fixed_lengths();
    void put_symbol(int symbol, DeflateBitWriter& out) const {
        out.put(literal_codes_[symbol], lengths_[symbol]);
    }

    PackedNumbers literal_counts_;
    PackedNumbers distance_counts_;
    PackedNumbers literal_codes_;
    PackedNumbers distance_codes_;
    std::uint8_t* lengths_;  ///< of literals, then from fixed_literals on of distances
    int extra_bits_ = 0;
    bool fixed_ = false;
    int literals_ = 0;  ///< symbols whose lengths are sent
    int distances_ = 0;
    int order_ = 0;
    std::uint8_t order_lengths_[Deflate::order_symbols] = {};
};

// ---- Implementation ---------------------------------------------------------------

inline void DeflateCodes::count(DeflateMatch match) {
    const int length = Deflate::length_symbol(match.length - Deflate::shortest_match);
    const int distance = Deflate::distance_symbol(match.distance - 1);
    const int symbol = Deflate::end_of_block + 1 + length;
    literal_counts_.put(symbol, literal_counts_[symbol] + 1);
    distance_counts_.put(distance, distance_counts_[distance] + 1);
    extra_bits_ += Deflate::length_bits[length] + Deflate::distance_bits(distance);
}

inline void DeflateCodes::put(DeflateMatch match, DeflateBitWriter& out) const {
    const int stretch = match.length - Deflate::shortest_match;
    const int length = Deflate::length_symbol(stretch);
    put_symbol(Deflate::end_of_block + 1 + length, out);
    out.put(static_cast<std::uint32_t>(stretch - Deflate::length_base[length]), Deflate::length_bits[length]);
    const int distance = Deflate::distance_symbol(match.distance - 1);
    out.put(distance_codes_[distance], lengths_[Deflate::fixed_literals + distance]);
    out.put(static_cast<std::uint32_t>(match.distance - 1 - Deflate::distance_base[distance]),
            Deflate::distance_bits(distance));
}

inline std::int64_t DeflateCodes::content_bits() const {
    std::int64_t bits = extra_bits_;
    for (int i = 0; i < Deflate::literals; ++i) bits += std::int64_t{literal_counts_[i]} * lengths_[i];
    for (int i = 0; i < Deflate::distances; ++i)
        bits += std::int64_t{distance_counts_[i]} * lengths_[Deflate::fixed_literals + i];
    return bits;
}

/// The count of symbols up to the last one with a code.
inline int DeflateCodes::used(const std::uint8_t* lengths, int count, int least) {
    while (count > least && lengths[count - 1] == 0) --count;
    return count;
}

inline void DeflateCodes::make_own_lengths() {
    std::uint8_t* distance_lengths = lengths_ + Deflate::fixed_literals;
    prefix_code_lengths(literal_counts_, Deflate::literals, Deflate::longest_code, lengths_);
    prefix_code_lengths(distance_counts_, Deflate::distances, Deflate::longest_code, distance_lengths);
    literals_ = used(lengths_, Deflate::literals, Deflate::end_of_block + 1);
    distances_ = used(distance_lengths, Deflate::distances, 1);
}

inline void DeflateCodes::make_fixed_lengths() {
    for (int i = 0; i < Deflate::fixed_literals; ++i)
        lengths_[i] = static_cast<std::uint8_t>(Deflate::fixed_literal_length(i));
    std::memset(lengths_ + Deflate::fixed_literals, Deflate::fixed_distance_length, Deflate::distances);
}

/// The lengths that are sent, in runs.
template <class Use>
void DeflateCodes::for_each_run(Use use) const {
    const int count = literals_ + distances_;
    const auto length = [this](int i) {
        return lengths_[i < literals_ ? i : Deflate::fixed_literals + i - literals_];
    };
    for (int i = 0; i < count;) {
        const int value = length(i);
        const int longest = minimum(count - i, value == 0 ? 138 : 7);
        int run = 1;
        while (run < longest && length(i + run) == value) ++run;
        if (value == 0 && run >= 3) {
            use(run < 11 ? Run{17, run - 3} : Run{18, run - 11});
        } else {
            // The value itself, then three to six times the same.
            use(Run{value, 0});
            if (run < 4) run = 1;
            if (run > 1) use(Run{16, run - 4});
        }
        i += run;
    }
}

/// Makes the code for the code lengths and answers the bits of the header.
inline int DeflateCodes::make_order_code() {
    std::uint8_t counts_of_lengths[2 * Deflate::order_symbols] = {};
    const PackedNumbers frequencies(counts_of_lengths);
    for_each_run([&](Run run) { frequencies.put(run.symbol, frequencies[run.symbol] + 1); });
    prefix_code_lengths(frequencies, Deflate::order_symbols, 7, order_lengths_);
    order_ = Deflate::order_symbols;
    while (order_ > 4 && order_lengths_[Deflate::order[order_ - 1]] == 0) --order_;
    int bits = 5 + 5 + 4 + 3 * order_;
    for (int i = 0; i < Deflate::order_symbols; ++i)
        bits += static_cast<int>(frequencies[i]) * (order_lengths_[i] + extra_bits(i));
    return bits;
}

inline std::int64_t DeflateCodes::make() {
    make_fixed_lengths();
    const std::int64_t fixed_bits = content_bits();
    make_own_lengths();
    const std::int64_t own_bits = make_order_code() + content_bits();
    fixed_ = fixed_bits <= own_bits;
    if (fixed_) make_fixed_lengths();
    prefix_codes(lengths_, fixed_ ? Deflate::fixed_literals : Deflate::literals, literal_codes_);
    prefix_codes(lengths_ + Deflate::fixed_literals, Deflate::distances, distance_codes_);
    return 3 + minimum(fixed_bits, own_bits);
}

inline void DeflateCodes::put_header(std::uint32_t last, DeflateBitWriter& out) const {
    out.put(last, 1);
    out.put(fixed_ ? 1 : 2, 2);
    if (fixed_) return;
    out.put(static_cast<std::uint32_t>(literals_ - 257), 5);
    out.put(static_cast<std::uint32_t>(distances_ - 1), 5);
    out.put(static_cast<std::uint32_t>(order_ - 4), 4);
    for (int i = 0; i < order_; ++i) out.put(order_lengths_[Deflate::order[i]], 3);
    std::uint8_t code_bytes[2 * Deflate::order_symbols] = {};
    const PackedNumbers codes(code_bytes);
    prefix_codes(order_lengths_, Deflate::order_symbols, codes);
    for_each_run([&](Run run) {
        out.put(codes[run.symbol], order_lengths_[run.symbol]);
        out.put(static_cast<std::uint32_t>(run.extra), extra_bits(run.symbol));
    });
}

}  // namespace fovea
