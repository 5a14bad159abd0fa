// SPDX-License-Identifier: MIT
//
// Bytes and Words: many pixels at once, with one meaning on every processor.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/simd/backend.hpp>
#include <fovea/simd/isa.hpp>

namespace fovea {
inline namespace FOVEA_ISA {
namespace simd {

/// As many 8-bit pixels as fit a vector.
struct Bytes {
    RawBytes raw;

    [[gnu::always_inline]] static Bytes all(std::uint8_t value) { return {all_bytes(value)}; }
    [[gnu::always_inline]] static Bytes load(const std::uint8_t* from) { return {load_raw<RawBytes>(from)}; }
    /// The first count pixels, zeros behind them.
    [[gnu::always_inline]] static Bytes load(const std::uint8_t* from, int count) {
        Bytes bytes{};
        std::memcpy(&bytes.raw, from, static_cast<std::size_t>(count));
        return bytes;
    }
    [[gnu::always_inline]] void store(std::uint8_t* to) const {
        std::memcpy(to, &raw, static_cast<std::size_t>(lanes));
    }
    [[gnu::always_inline]] void store(std::uint8_t* to, int count) const {
        std::memcpy(to, &raw, static_cast<std::size_t>(count));
    }

    [[gnu::always_inline]] friend Bytes lower(Bytes a, Bytes b) { return {lower(a.raw, b.raw)}; }
    [[gnu::always_inline]] friend Bytes higher(Bytes a, Bytes b) { return {higher(a.raw, b.raw)}; }
    /// 255 where a >= b, else 0.
    [[gnu::always_inline]] friend Bytes at_least(Bytes a, Bytes b) { return {at_least(a.raw, b.raw)}; }
    [[gnu::always_inline]] friend Bytes operator&(Bytes a, Bytes b) { return {a.raw & b.raw}; }
    [[gnu::always_inline]] friend Bytes operator|(Bytes a, Bytes b) { return {a.raw | b.raw}; }
    [[gnu::always_inline]] friend Bytes operator^(Bytes a, Bytes b) { return {a.raw ^ b.raw}; }
    [[gnu::always_inline]] friend Bytes operator~(Bytes a) { return {~a.raw}; }
    /// Sum and difference modulo 256.
    [[gnu::always_inline]] friend Bytes operator+(Bytes a, Bytes b) { return {plus_bytes(a.raw, b.raw)}; }
    [[gnu::always_inline]] friend Bytes operator-(Bytes a, Bytes b) { return {minus_bytes(a.raw, b.raw)}; }
    /// By n bits, 0 to 7; zeros come in.
    [[gnu::always_inline]] friend Bytes operator<<(Bytes a, int n) {
        return Bytes{bits_as<RawBytes>(shift_left(bits_as<RawWords>(a.raw), n))} &
               all(static_cast<std::uint8_t>(255 << n));
    }
    [[gnu::always_inline]] friend Bytes operator>>(Bytes a, int n) {
        return Bytes{bits_as<RawBytes>(shift_right(bits_as<RawWords>(a.raw), n))} &
               all(static_cast<std::uint8_t>(255 >> n));
    }
    // The three below add and subtract whole vectors: no byte overflows, so none carries into its neighbour.
    /// Sum, at most 255.
    [[gnu::always_inline]] friend Bytes add_saturated(Bytes a, Bytes b) {
        return {a.raw + lower(b.raw, ~a.raw)};
    }
    /// Difference, at least 0.
    [[gnu::always_inline]] friend Bytes subtract_saturated(Bytes a, Bytes b) {
        return {a.raw - lower(a.raw, b.raw)};
    }
    /// (a + b + 1) / 2.
    [[gnu::always_inline]] friend Bytes average(Bytes a, Bytes b) {
        const RawWords half = shift_right(bits_as<RawWords>(a.raw ^ b.raw), 1);
        return {(a.raw | b.raw) - (bits_as<RawBytes>(half) & all_bytes(127))};
    }
};

/// The same pixels at 16 bits, even and odd columns apart, so that nothing is shuffled.
///
/// Contract  every sum, product and left shift stays a non-negative value below 2^16, or comes from a
///           difference and goes only into absolute(), held() or another difference: a negative half must not
///           be the left side of a sum, because the word back end would carry into its neighbour. Write c +
///           1024 - a, not c - a + 1024.
struct Words {
    RawWords even;
    RawWords odd;

    Words() = default;
    [[gnu::always_inline]] Words(RawWords even_columns, RawWords odd_columns)
        : even(even_columns), odd(odd_columns) {}
    [[gnu::always_inline]] explicit Words(Bytes bytes) {
        const RawWords pairs = bits_as<RawWords>(bytes.raw);
        const RawWords low = pairs & all_words(255);
        const RawWords high = shift_right(pairs, 8);
        even = big_endian ? high : low;
        odd = big_endian ? low : high;
    }
    [[gnu::always_inline]] static Words all(std::uint16_t value) {
        return {all_words(value), all_words(value)};
    }
    /// lanes numbers of 16 bits, or the first count of them and zeros behind.
    [[gnu::always_inline]] static Words load(const std::uint16_t* from) {
#if FOVEA_BYTES == 16 && defined(__ARM_FEATURE_MVE)
        // By places, each aligned as its type: Helium's loads of pairs may want more.
        const uint16x8_t each_second = vidupq_n_u16(0, 2);
        return {bits_as<RawWords>(vldrhq_gather_shifted_offset_u16(from, each_second)),
                bits_as<RawWords>(vldrhq_gather_shifted_offset_u16(from + 1, each_second))};
#else
        const auto first = load_raw<RawWords>(from);
        const auto second = load_raw<RawWords>(from + lanes / 2);
        return {even_words(first, second), odd_words(first, second)};
#endif
    }
    [[gnu::always_inline]] static Words load(const std::uint16_t* from, int count) {
        std::uint16_t row[lanes] = {};
        std::memcpy(row, from, sizeof(std::uint16_t) * static_cast<std::size_t>(count));
        return load(row);
    }
    [[gnu::always_inline]] void store(std::uint16_t* to) const {
#if FOVEA_BYTES == 16 && defined(__ARM_FEATURE_MVE)
        const uint16x8_t each_second = vidupq_n_u16(0, 2);
        vstrhq_scatter_shifted_offset_u16(to, each_second, bits_as<uint16x8_t>(even));
        vstrhq_scatter_shifted_offset_u16(to + 1, each_second, bits_as<uint16x8_t>(odd));
#else
        const RawWords first = interleave_first(even, odd);
        const RawWords second = interleave_second(even, odd);
        std::memcpy(to, &first, sizeof first);
        std::memcpy(to + lanes / 2, &second, sizeof second);
#endif
    }
    [[gnu::always_inline]] void store(std::uint16_t* to, int count) const {
        std::uint16_t row[lanes];
        store(row);
        std::memcpy(to, row, sizeof(std::uint16_t) * static_cast<std::size_t>(count));
    }
    /// Differences as they are.
    [[gnu::always_inline]] void store(std::int16_t* to) const { store(reinterpret_cast<std::uint16_t*>(to)); }
    [[gnu::always_inline]] void store(std::int16_t* to, int count) const {
        store(reinterpret_cast<std::uint16_t*>(to), count);
    }

    /// Back to pixels; all values must be below 256.
    [[gnu::always_inline]] Bytes narrow() const {
        const RawWords pairs = big_endian ? (odd | shift_left(even, 8)) : (even | shift_left(odd, 8));
        return {bits_as<RawBytes>(pairs)};
    }
    /// Back to pixels, values above 255 become 255.
    [[gnu::always_inline]] Bytes saturate() const {
        return Words{at_most_255(even), at_most_255(odd)}.narrow();
    }

    [[gnu::always_inline]] friend Words operator+(Words a, Words b) {
        return {plus(a.even, b.even), plus(a.odd, b.odd)};
    }
    [[gnu::always_inline]] friend Words operator-(Words a, Words b) {
        return {minus(a.even, b.even), minus(a.odd, b.odd)};
    }
    [[gnu::always_inline]] friend Words operator*(Words a, std::uint16_t k) {
        return {times(a.even, k), times(a.odd, k)};
    }
    /// Times a number of either sign. Sums of such products may go anywhere on their way; nothing but such
    /// sums may be done with them before they are 0..65535 again.
    [[gnu::always_inline]] friend Words times_signed(Words a, std::int16_t k) {
        return {times_signed(a.even, k), times_signed(a.odd, k)};
    }
    [[gnu::always_inline]] friend Words operator<<(Words a, int n) {
        return {shift_left(a.even, n), shift_left(a.odd, n)};
    }
    [[gnu::always_inline]] friend Words operator>>(Words a, int n) {
        return {shift_right(a.even, n), shift_right(a.odd, n)};
    }
    /// The high 16 bits of each product: a quotient by a constant, where the caller has shown that it is
    /// exact.
    [[gnu::always_inline]] friend Words times_high(Words a, std::uint16_t k) {
        return {times_high(a.even, k), times_high(a.odd, k)};
    }
    [[gnu::always_inline]] friend Words times_high(Words a, Words b) {
        return {both_times_high(a.even, b.even), both_times_high(a.odd, b.odd)};
    }
    /// The lower, the higher of two unsigned numbers.
    [[gnu::always_inline]] friend Words lower(Words a, Words b) {
        return {lower_words(a.even, b.even), lower_words(a.odd, b.odd)};
    }
    [[gnu::always_inline]] friend Words higher(Words a, Words b) {
        return {higher_words(a.even, b.even), higher_words(a.odd, b.odd)};
    }
    /// 65535 where a >= b as unsigned numbers, else 0.
    [[gnu::always_inline]] friend Words at_least(Words a, Words b) {
        return {at_least_words(a.even, b.even), at_least_words(a.odd, b.odd)};
    }
    [[gnu::always_inline]] friend Words operator&(Words a, Words b) {
        return {a.even & b.even, a.odd & b.odd};
    }
    [[gnu::always_inline]] friend Words operator|(Words a, Words b) {
        return {a.even | b.even, a.odd | b.odd};
    }
    [[gnu::always_inline]] friend Words operator~(Words a) { return {~a.even, ~a.odd}; }
    [[gnu::always_inline]] friend Words absolute(Words a) { return {absolute(a.even), absolute(a.odd)}; }
    /// Column by column; every product stays below 2^16.
    [[gnu::always_inline]] friend Words operator*(Words a, Words b) {
        return {product(a.even, b.even), product(a.odd, b.odd)};
    }
    /// Back to pixels, held at 0 and 255; for values of -32768 to 32767.
    [[gnu::always_inline]] Bytes held() const {
        return Words{hold_to_byte(even), hold_to_byte(odd)}.narrow();
    }

private:
    static constexpr bool big_endian = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__;
};

}  // namespace simd
}  // namespace FOVEA_ISA
}  // namespace fovea
