// SPDX-License-Identifier: MIT
//
// Prefix (Huffman) codes of deflate: read through a table, and made from frequencies.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/assert.hpp>
#include <fovea/base/span.hpp>
#include <fovea/codec/zlib.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// How much of the code space the lengths of a code fill.
enum class PrefixCodeShape : std::uint8_t {
    complete,
    single,  ///< one code of one bit, half of the space
    empty,   ///< no code at all
    wrong,   ///< anything else: too many codes, or gaps
};

/// A symbol and the length of its code; symbol -1 where no code begins with the bits asked for.
struct PrefixSymbol {
    int symbol = -1;
    int length = 0;
};

/// Reads the symbols of a code with at most Symbols of them. A code of up to QuickBits bits costs one
/// look-up, a longer one a search.
///
/// Memory  scratch_bytes, given by the caller at any alignment, and 32 bytes of its own
/// Source  RFC 1951 sec. 3.2.2
template <int Symbols, int QuickBits>
class PrefixDecoder {
public:
    static constexpr int scratch_bytes = 2 * (Symbols + (1 << QuickBits));

    explicit PrefixDecoder(std::uint8_t* scratch) : quick_(scratch), ordered_(scratch + (2 << QuickBits)) {}

    /// Makes the code with these lengths 0..15, 0 for symbols without a code. A wrong code must not be read.
    PrefixCodeShape build(Span<const std::uint8_t> lengths);

    /// The symbol whose code the lowest bits begin with, first bit lowest. 15 bits decide.
    PrefixSymbol read(std::uint32_t bits) const {
        const std::uint32_t entry = quick_[bits & ((1 << QuickBits) - 1)];
        if (entry != 0) return {static_cast<int>(entry >> 4), static_cast<int>(entry & 15)};
        return search(bits);
    }

private:
    PrefixSymbol search(std::uint32_t bits) const;
    void fill_quick();

    PackedNumbers quick_;    ///< symbol * 16 + length, 0 for none
    PackedNumbers ordered_;  ///< symbols in the order of their codes
    std::uint16_t counts_[Deflate::longest_code + 1] = {};
};

/// Lengths of the shortest code for symbols of these frequencies, limited to `longest` bits. Symbols that do
/// not occur get 0. The code is complete: where fewer than two symbols occur, others get one bit too.
///
/// Units    frequencies below 65536 in sum, 2 to 286 of them
/// Memory   1144 bytes on the stack
/// Source   Moffat and Katajainen, "In-place calculation of minimum-redundancy codes", WADS 1995. A code that
///          grows longer than `longest` is made again with all frequencies halved
inline void prefix_code_lengths(PackedNumbers frequencies, int symbols, int longest, std::uint8_t* lengths);

/// The codes that belong to these lengths, first bit lowest, as deflate sends them.
///
/// Source  RFC 1951 sec. 3.2.2
inline void prefix_codes(const std::uint8_t* lengths, int symbols, PackedNumbers codes);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// The lowest `length` bits in the opposite order.
constexpr std::uint32_t reversed_bits(std::uint32_t bits, int length) {
    std::uint32_t reversed = 0;
    for (int i = 0; i < length; ++i) reversed = reversed << 1 | (bits >> i & 1);
    return reversed;
}

/// Turns rising weights into the depths of their leaves in a Huffman tree, in place. Two or more weights.
inline void weights_to_depths(std::uint16_t* weights, int count) {
    // First the tree: weights[node] is an inner node's weight until it gets a parent, then the parent's
    // index. An inner node never overtakes the leaves, so both share the array.
    int leaf = 0;
    int inner = 0;
    const auto lightest = [&](int next) {
        const bool inner_first = inner < next && (leaf >= count || weights[inner] < weights[leaf]);
        if (!inner_first) return weights[leaf++];
        const std::uint16_t weight = weights[inner];
        weights[inner++] = static_cast<std::uint16_t>(next);
        return weight;
    };
    for (int next = 0; next < count - 1; ++next) {
        const std::uint32_t first = lightest(next);
        weights[next] = static_cast<std::uint16_t>(first + lightest(next));
    }
    // Then the depth of every inner node, from the root down.
    weights[count - 2] = 0;
    for (int node = count - 3; node >= 0; --node)
        weights[node] = static_cast<std::uint16_t>(weights[weights[node]] + 1);
    // Then the leaves: what a level has room for and its inner nodes do not take.
    int depth = 0;
    int room = 1;
    int node = count - 2;
    int next_leaf = count - 1;
    while (room > 0) {
        int taken = 0;
        for (; node >= 0 && weights[node] == depth; --node) ++taken;
        for (; room > taken; --room) weights[next_leaf--] = static_cast<std::uint16_t>(depth);
        room = 2 * taken;
        ++depth;
    }
}

/// Sorts symbols by rising weight: Shell's method with Ciura's gaps.
inline void sort_by_weight(std::uint16_t* weights, std::uint16_t* symbols, int count) {
    constexpr int gaps[] = {57, 23, 10, 4, 1};
    for (const int gap : gaps)
        for (int i = gap; i < count; ++i) {
            const std::uint16_t weight = weights[i];
            const std::uint16_t symbol = symbols[i];
            int at = i;
            for (; at >= gap && weights[at - gap] > weight; at -= gap) {
                weights[at] = weights[at - gap];
                symbols[at] = symbols[at - gap];
            }
            weights[at] = weight;
            symbols[at] = symbol;
        }
}

}  // namespace detail

template <int Symbols, int QuickBits>
PrefixCodeShape PrefixDecoder<Symbols, QuickBits>::build(Span<const std::uint8_t> lengths) {
    FOVEA_ASSERT(lengths.size() <= Symbols);
    for (std::uint16_t& count : counts_) count = 0;
    for (const std::uint8_t length : lengths) ++counts_[length];
    counts_[0] = 0;
    // In units of the longest code: what the codes take of 2^15.
    int taken = 0;
    std::uint16_t next[Deflate::longest_code + 1] = {};
    for (int length = 1; length <= Deflate::longest_code; ++length) {
        taken += counts_[length] << (Deflate::longest_code - length);
        next[length] = static_cast<std::uint16_t>(next[length - 1] + counts_[length - 1]);
    }
    for (std::ptrdiff_t symbol = 0; symbol < lengths.size(); ++symbol)
        if (lengths[symbol] != 0) ordered_.put(next[lengths[symbol]]++, static_cast<std::uint32_t>(symbol));
    fill_quick();
    if (taken == 1 << Deflate::longest_code) return PrefixCodeShape::complete;
    if (taken == 0) return PrefixCodeShape::empty;
    return counts_[1] == 1 && taken == 1 << (Deflate::longest_code - 1) ? PrefixCodeShape::single
                                                                        : PrefixCodeShape::wrong;
}

template <int Symbols, int QuickBits>
void PrefixDecoder<Symbols, QuickBits>::fill_quick() {
    for (int i = 0; i < 1 << QuickBits; ++i) quick_.put(i, 0);
    std::uint32_t code = 0;
    int index = 0;
    for (int length = 1; length <= QuickBits; ++length, code <<= 1) {
        for (int i = 0; i < counts_[length]; ++i, ++code, ++index) {
            // Too many codes: the shape will say so.
            if (code >> length != 0) return;
            const std::uint32_t entry = ordered_[index] << 4 | static_cast<std::uint32_t>(length);
            for (std::uint32_t at = detail::reversed_bits(code, length); at < 1u << QuickBits;
                 at += 1u << length)
                quick_.put(static_cast<std::ptrdiff_t>(at), entry);
        }
    }
}

template <int Symbols, int QuickBits>
PrefixSymbol PrefixDecoder<Symbols, QuickBits>::search(std::uint32_t bits) const {
    std::uint32_t code = 0;
    std::uint32_t first = 0;
    std::ptrdiff_t index = 0;
    for (int length = 1; length <= Deflate::longest_code; ++length, bits >>= 1) {
        code = code << 1 | (bits & 1);
        first <<= 1;
        const std::uint32_t count = counts_[length];
        // The codes of one length are consecutive numbers; first is the lowest of them.
        if (code - first < count)
            return {static_cast<int>(ordered_[index + static_cast<std::ptrdiff_t>(code - first)]), length};
        first += count;
        index += counts_[length];
    }
    return {};
}

inline void prefix_code_lengths(PackedNumbers frequencies, int symbols, int longest, std::uint8_t* lengths) {
    std::uint16_t weights[Deflate::literals];
    std::uint16_t order[Deflate::literals];
    FOVEA_ASSERT(symbols >= 2 && symbols <= Deflate::literals);
    for (int halvings = 0;; ++halvings) {
        int count = 0;
        for (int symbol = 0; symbol < symbols; ++symbol) {
            lengths[symbol] = 0;
            const std::uint32_t frequency = frequencies[symbol];
            if (frequency == 0) continue;
            weights[count] = static_cast<std::uint16_t>(maximum<std::uint32_t>(frequency >> halvings, 1));
            order[count++] = static_cast<std::uint16_t>(symbol);
        }
        if (count < 2) {
            lengths[0] = 1;
            lengths[count == 1 && order[0] != 0 ? order[0] : 1] = 1;
            return;
        }
        detail::sort_by_weight(weights, order, count);
        detail::weights_to_depths(weights, count);
        if (weights[0] > longest) continue;
        for (int i = 0; i < count; ++i) lengths[order[i]] = static_cast<std::uint8_t>(weights[i]);
        return;
    }
}

inline void prefix_codes(const std::uint8_t* lengths, int symbols, PackedNumbers codes) {
    std::uint32_t counts[Deflate::longest_code + 1] = {};
    for (int symbol = 0; symbol < symbols; ++symbol) ++counts[lengths[symbol]];
    std::uint32_t next[Deflate::longest_code + 1] = {};
    counts[0] = 0;
    for (int length = 1; length <= Deflate::longest_code; ++length)
        next[length] = (next[length - 1] + counts[length - 1]) << 1;
    for (int symbol = 0; symbol < symbols; ++symbol)
        if (lengths[symbol] != 0)
            codes.put(symbol, detail::reversed_bits(next[lengths[symbol]]++, lengths[symbol]));
}

}  // namespace fovea
