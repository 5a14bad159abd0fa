// SPDX-License-Identifier: MIT
//
// Reed-Solomon: the error correction of matrix codes, over bytes as the field GF(256).
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/assert.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Codewords of a block at most, parity among them.
inline constexpr int max_reed_solomon_block = 255;
/// Parity codewords of a block at most: those of the largest Data Matrix.
inline constexpr int max_reed_solomon_parity = 68;

/// The code whose field has that primitive polynomial and whose generator has the roots a^FirstRoot,
/// a^(FirstRoot+1) and so on. A block is its data and then its parity, the highest power first.
template <int Polynomial, int FirstRoot>
class ReedSolomon {
public:
    static_assert(Polynomial > 0x100 && Polynomial < 0x200, "the field has 256 elements");
    static_assert(FirstRoot == 0 || FirstRoot == 1, "the first root of the matrix codes is 0 or 1");

    /// The parity of data: as many codewords as parity has room for.
    ///
    /// Shapes   parity 1 to max_reed_solomon_parity, with data at most max_reed_solomon_block
    /// Overlap  none
    /// Errors   bad_argument for a parity or a block of another length
    /// Source   ISO/IEC 18004, 7.5.2; ISO/IEC 16022, annex E
    static constexpr Status encode(Span<const std::uint8_t> data, Span<std::uint8_t> parity);

    /// Mends a block in place and answers how many of its codewords were changed. Twice the errors and once
    /// the erasures are at most parity less reserve.
    ///
    /// Shapes  block longer than parity, at most max_reed_solomon_block; parity 1 to max_reed_solomon_parity
    /// Units   erasures: places in the block that are known to be unread, each once; reserve 0 to parity: as
    ///         many parity codewords do not correct but tell that a block is none (p of ISO/IEC 18004)
    /// Time    bounded by parity * block
    /// Errors  bad_argument; undecided, with the block untouched, for one that cannot be mended
    /// Source  Berlekamp and Massey's locator begun at the erasures; Forney's values; Blahut, "Theory and
    ///         practice of error control codes", 1983, ch. 7 to 9. The mended block's syndromes are tried
    static constexpr Result<int> decode(Span<std::uint8_t> block, int parity,
                                        Span<const std::uint8_t> erasures = {}, int reserve = 0);
};

/// Of QR codes. ISO/IEC 18004, 7.5.2.
using QrReedSolomon = ReedSolomon<0x11D, 0>;
/// Of Data Matrix. ISO/IEC 16022, 5.7.
using DataMatrixReedSolomon = ReedSolomon<0x12D, 1>;

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Powers of the primitive element and their exponents.
template <int Polynomial>
struct GaloisTables {
    std::uint8_t power[510] = {};  ///< twice over, so that the sum of two exponents needs no reduction
    std::uint8_t exponent[256] = {};

    constexpr GaloisTables() {
        int value = 1;
        for (int i = 0; i < 255; ++i) {
            power[i] = static_cast<std::uint8_t>(value);
            power[i + 255] = static_cast<std::uint8_t>(value);
            exponent[value] = static_cast<std::uint8_t>(i);
            value <<= 1;
            if (value > 255) value ^= Polynomial;
        }
    }
};

template <int Polynomial>
inline constexpr GaloisTables<Polynomial> galois_tables;

template <int Polynomial>
struct Galois {
    static constexpr std::uint8_t power(int exponent) {
        return galois_tables<Polynomial>.power[exponent % 255];
    }
    static constexpr std::uint8_t multiply(std::uint8_t a, std::uint8_t b) {
        const auto& tables = galois_tables<Polynomial>;
        return a == 0 || b == 0 ? std::uint8_t{0} : tables.power[tables.exponent[a] + tables.exponent[b]];
    }
    /// b is not 0.
    static constexpr std::uint8_t divide(std::uint8_t a, std::uint8_t b) {
        const auto& tables = galois_tables<Polynomial>;
        return a == 0 ? std::uint8_t{0} : tables.power[tables.exponent[a] + 255 - tables.exponent[b]];
    }
};

/// A polynomial, the constant term first, of no higher degree than a block has parity codewords.
struct GaloisPolynomial {
    static constexpr int room = max_reed_solomon_parity + 1;

    std::uint8_t terms[room] = {};

    constexpr int degree() const {
        int degree = room - 1;
        while (degree > 0 && terms[degree] == 0) --degree;
        return degree;
    }
    /// Times x; the term beyond the room is lost, as no locator of a mendable block has one.
    constexpr void raise() {
        for (int i = room - 1; i > 0; --i) terms[i] = terms[i - 1];
        terms[0] = 0;
    }
    template <int Polynomial>
    constexpr std::uint8_t at(std::uint8_t x, int degree) const {
        std::uint8_t value = terms[degree];
        for (int i = degree - 1; i >= 0; --i) {
            value = static_cast<std::uint8_t>(Galois<Polynomial>::multiply(value, x) ^ terms[i]);
        }
        return value;
    }
};

/// One block at work: its syndromes, and from them where it is wrong and by how much.
template <int Polynomial, int FirstRoot>
class BlockRepair {
    using Field = Galois<Polynomial>;

public:
    constexpr BlockRepair(Span<const std::uint8_t> block, int parity)
        : length_(static_cast<int>(block.size())), parity_(parity) {
        int j = 0;
        for (; j + together <= parity; j += together) find_syndromes<together>(block, j);
        for (; j < parity; ++j) find_syndromes<1>(block, j);
    }

    constexpr bool clean() const { return clean_; }
    constexpr int wrong() const { return wrong_; }
    constexpr int place(int index) const { return places_[index]; }
    constexpr std::uint8_t value(int index) const { return values_[index]; }

    /// False when no more than so many errors and erasures explain the syndromes.
    constexpr bool solve(Span<const std::uint8_t> erasures, int reserve) {
        find_locator(erasures);
        const int erased = static_cast<int>(erasures.size());
        const int degree = locator_.degree();
        if (degree < erased || 2 * degree - erased > parity_ - reserve) return false;
        return find_places(degree) && find_values(degree) && explains();
    }

private:
    /// Each step of a syndrome waits for two looks into tables; those of other syndromes fill the time.
    static constexpr int together = 4;

    template <int Count>
    constexpr void find_syndromes(Span<const std::uint8_t> block, int first) {
        std::uint8_t roots[static_cast<std::size_t>(Count)] = {};
        std::uint8_t sums[static_cast<std::size_t>(Count)] = {};
        for (int k = 0; k < Count; ++k) roots[k] = Field::power(first + k + FirstRoot);
        for (const std::uint8_t codeword : block) {
            for (int k = 0; k < Count; ++k)
                sums[k] = static_cast<std::uint8_t>(Field::multiply(sums[k], roots[k]) ^ codeword);
        }
        for (int k = 0; k < Count; ++k) {
            syndromes_[first + k] = sums[k];
            clean_ = clean_ && sums[k] == 0;
        }
    }
    constexpr void find_locator(Span<const std::uint8_t> erasures) {
        const int erased = static_cast<int>(erasures.size());
        locator_.terms[0] = 1;
        for (const std::uint8_t place : erasures) {
            const std::uint8_t root = Field::power(length_ - 1 - place);
            for (int i = erased; i > 0; --i)
                locator_.terms[i] ^= Field::multiply(root, locator_.terms[i - 1]);
        }
        GaloisPolynomial last = locator_;
        int length = erased;
        for (int r = erased + 1; r <= parity_; ++r) {
            std::uint8_t discrepancy = 0;
            for (int i = 0; i < r; ++i) {
                discrepancy ^= Field::multiply(locator_.terms[i], syndromes_[r - 1 - i]);
            }
            last.raise();
            if (discrepancy == 0) continue;
            const GaloisPolynomial before = locator_;
            for (int i = 0; i < GaloisPolynomial::room; ++i) {
                locator_.terms[i] ^= Field::multiply(discrepancy, last.terms[i]);
            }
            if (2 * length > r + erased - 1) continue;
            length = r + erased - length;
            for (int i = 0; i < GaloisPolynomial::room; ++i) {
                last.terms[i] = Field::divide(before.terms[i], discrepancy);
            }
        }
    }
    /// The roots of the locator that are places of the block. As many as its degree, or it is none.
    constexpr bool find_places(int degree) {
        for (int place = 0; place < length_ && wrong_ < degree; ++place) {
            const std::uint8_t inverse = Field::power(255 - (length_ - 1 - place));
            if (locator_.at<Polynomial>(inverse, degree) == 0) places_[wrong_++] = place;
        }
        return wrong_ == degree;
    }
    constexpr bool find_values(int degree) {
        GaloisPolynomial evaluator;  // syndromes times locator, modulo x^parity
        for (int i = 0; i < parity_; ++i) {
            for (int j = 0; j <= i && j <= degree; ++j) {
                evaluator.terms[i] ^= Field::multiply(locator_.terms[j], syndromes_[i - j]);
            }
        }
        GaloisPolynomial slope;  // the derivative: even powers vanish where 1 + 1 is 0
        for (int i = 1; i <= degree; i += 2) slope.terms[i - 1] = locator_.terms[i];
        for (int k = 0; k < wrong_; ++k) {
            const int exponent = length_ - 1 - places_[k];
            const std::uint8_t inverse = Field::power(255 - exponent);
            const std::uint8_t divisor = slope.at<Polynomial>(inverse, GaloisPolynomial::room - 1);
            if (divisor == 0) return false;
            const std::uint8_t quotient =
                Field::divide(evaluator.at<Polynomial>(inverse, GaloisPolynomial::room - 1), divisor);
            values_[k] = FirstRoot == 0 ? Field::multiply(quotient, Field::power(exponent)) : quotient;
        }
        return true;
    }
    /// Whether the errors found have the syndromes of the block, so that without them it has none.
    constexpr bool explains() const {
        for (int j = 0; j < parity_; ++j) {
            std::uint8_t sum = 0;
            for (int k = 0; k < wrong_; ++k) {
                sum ^=
                    Field::multiply(values_[k], Field::power((length_ - 1 - places_[k]) * (j + FirstRoot)));
            }
            if (sum != syndromes_[j]) return false;
        }
        return true;
    }

    int length_;
    int parity_;
    bool clean_ = true;
    std::uint8_t syndromes_[max_reed_solomon_parity] = {};
    GaloisPolynomial locator_;
    int wrong_ = 0;
    int places_[max_reed_solomon_parity] = {};
    std::uint8_t values_[max_reed_solomon_parity] = {};
};

}  // namespace detail

template <int Polynomial, int FirstRoot>
constexpr Status ReedSolomon<Polynomial, FirstRoot>::encode(Span<const std::uint8_t> data,
                                                            Span<std::uint8_t> parity) {
    using Field = detail::Galois<Polynomial>;
    const int count = static_cast<int>(parity.size() <= max_reed_solomon_parity ? parity.size() : 0);
    if (count < 1 || data.size() > max_reed_solomon_block - count) return Status::bad_argument;
    detail::GaloisPolynomial generator;
    generator.terms[0] = 1;
    for (int j = 0; j < count; ++j) {
        const std::uint8_t root = Field::power(j + FirstRoot);
        for (int i = j + 1; i >= 0; --i) {
            generator.terms[i] = static_cast<std::uint8_t>((i > 0 ? generator.terms[i - 1] : 0) ^
                                                           Field::multiply(root, generator.terms[i]));
        }
    }
    for (int i = 0; i < count; ++i) parity[i] = 0;
    for (const std::uint8_t codeword : data) {
        const auto lead = static_cast<std::uint8_t>(codeword ^ parity[0]);
        for (int i = 0; i < count; ++i) {
            const int next = i + 1 < count ? parity[i + 1] : 0;
            parity[i] =
                static_cast<std::uint8_t>(next ^ Field::multiply(lead, generator.terms[count - 1 - i]));
        }
    }
    return Status::ok;
}

template <int Polynomial, int FirstRoot>
constexpr Result<int> ReedSolomon<Polynomial, FirstRoot>::decode(Span<std::uint8_t> block, int parity,
                                                                 Span<const std::uint8_t> erasures,
                                                                 int reserve) {
    if (parity < 1 || parity > max_reed_solomon_parity || block.size() <= parity ||
        block.size() > max_reed_solomon_block || reserve < 0 || reserve > parity)
        return Status::bad_argument;
    bool erased[max_reed_solomon_block] = {};
    for (const std::uint8_t place : erasures) {
        if (place >= block.size() || erased[place]) return Status::bad_argument;
        erased[place] = true;
    }
    detail::BlockRepair<Polynomial, FirstRoot> repair(block, parity);
    if (repair.clean()) return 0;
    if (erasures.size() > parity - reserve || !repair.solve(erasures, reserve)) return Status::undecided;
    int changed = 0;
    for (int k = 0; k < repair.wrong(); ++k) {
        if (repair.value(k) == 0) continue;
        std::uint8_t& codeword = block[repair.place(k)];
        codeword = static_cast<std::uint8_t>(codeword ^ repair.value(k));
        ++changed;
    }
    return changed;
}

}  // namespace fovea
