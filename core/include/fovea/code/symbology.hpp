// SPDX-License-Identifier: MIT
//
// Symbologies: the kinds of bar and matrix codes that are read and written. Book ch. 5.
#pragma once

#include <cstdint>

#include <fovea/base/assert.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// A kind of code. Its number is the bit that SymbologySet keeps for it.
enum class Symbology : std::uint8_t {
    ean_13,              ///< ISO/IEC 15420
    ean_8,               ///< ISO/IEC 15420
    upc_a,               ///< ISO/IEC 15420: an EAN-13 that begins with 0
    upc_e,               ///< ISO/IEC 15420: a UPC-A without most of its zeros
    code_128,            ///< ISO/IEC 15417; GS1-128 is one that begins with FNC1
    code_39,             ///< ISO/IEC 16388
    interleaved_2_of_5,  ///< ISO/IEC 16390
    codabar,             ///< EN 798
    qr,                  ///< ISO/IEC 18004
    data_matrix,         ///< ISO/IEC 16022, ECC 200; with the rectangles of ISO/IEC 21471
};
inline constexpr int symbology_count = 10;

/// The name that people know it by.
constexpr const char* name(Symbology symbology) {
    switch (symbology) {
        case Symbology::ean_13: return "EAN-13";
        case Symbology::ean_8: return "EAN-8";
        case Symbology::upc_a: return "UPC-A";
        case Symbology::upc_e: return "UPC-E";
        case Symbology::code_128: return "Code 128";
        case Symbology::code_39: return "Code 39";
        case Symbology::interleaved_2_of_5: return "Interleaved 2 of 5";
        case Symbology::codabar: return "Codabar";
        case Symbology::qr: return "QR";
        case Symbology::data_matrix: return "Data Matrix";
    }
    return "unknown";
}

/// The letter of its symbology identifier, which stands behind "]" and before a digit that the code itself
/// tells. ISO/IEC 15424.
constexpr char aim_letter(Symbology symbology) {
    switch (symbology) {
        case Symbology::ean_13:
        case Symbology::ean_8:
        case Symbology::upc_a:
        case Symbology::upc_e: return 'E';
        case Symbology::code_128: return 'C';
        case Symbology::code_39: return 'A';
        case Symbology::interleaved_2_of_5: return 'I';
        case Symbology::codabar: return 'F';
        case Symbology::qr: return 'Q';
        case Symbology::data_matrix: return 'd';
    }
    return 'X';
}

/// Which symbologies are looked for.
class SymbologySet {
public:
    /// None.
    constexpr SymbologySet() = default;
    constexpr SymbologySet(Symbology symbology) : bits_(bit(symbology)) {}
    static constexpr SymbologySet all() { return SymbologySet((1U << symbology_count) - 1); }

    constexpr bool empty() const { return bits_ == 0; }
    constexpr bool contains(Symbology symbology) const { return (bits_ & bit(symbology)) != 0; }
    friend constexpr SymbologySet operator|(SymbologySet a, SymbologySet b) {
        return SymbologySet(a.bits_ | b.bits_);
    }
    friend constexpr SymbologySet operator&(SymbologySet a, SymbologySet b) {
        return SymbologySet(a.bits_ & b.bits_);
    }
    friend constexpr bool operator==(SymbologySet a, SymbologySet b) { return a.bits_ == b.bits_; }
    friend constexpr bool operator!=(SymbologySet a, SymbologySet b) { return !(a == b); }

private:
    constexpr explicit SymbologySet(unsigned bits) : bits_(bits) {}
    static constexpr unsigned bit(Symbology symbology) {
        FOVEA_ASSERT(static_cast<int>(symbology) < symbology_count);
        return 1U << static_cast<int>(symbology);
    }

    unsigned bits_ = 0;
};

}  // namespace fovea
