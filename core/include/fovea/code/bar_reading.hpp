// SPDX-License-Identifier: MIT
//
// What the decoders of bar codes take and give: the edges along a scan line, and what they say.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/code/symbology.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Those of shops: EAN and UPC.
constexpr SymbologySet retail_symbologies() {
    return Symbology::ean_13 | SymbologySet(Symbology::ean_8) | Symbology::upc_a | Symbology::upc_e;
}

/// The symbologies that are made of bars.
constexpr SymbologySet bar_symbologies() {
    return retail_symbologies() | Symbology::code_128 | Symbology::code_39 | Symbology::interleaved_2_of_5 |
           Symbology::codabar;
}

/// Whether a check character that the standard leaves to the user is there.
enum class CheckCharacter : std::uint8_t {
    unknown,   ///< it is not looked for: where it stands it is part of the text
    required,  ///< a code in which it is wrong is no code; it stays in the text
    removed,   ///< the same, and it is taken out of the text
};

/// Two or five digits to the right of an EAN or UPC code.
enum class AddOn : std::uint8_t {
    ignored,
    appended,  ///< where there is one, its digits follow those of the code
};

enum class Code39Text : std::uint8_t {
    plain,       ///< the 43 characters as they are
    full_ascii,  ///< pairs that begin with $ % / + are read as one character of ASCII
};

/// What the decoders of single lines look for.
struct BarRules {
    SymbologySet symbologies = bar_symbologies();  ///< fewer are faster, and leave less to mistake
    AddOn add_on = AddOn::ignored;
    Code39Text code_39_text = Code39Text::plain;
    CheckCharacter code_39_check = CheckCharacter::unknown;
    CheckCharacter interleaved_check = CheckCharacter::unknown;
    CheckCharacter codabar_check = CheckCharacter::unknown;
    /// Digits of Interleaved 2 of 5: a line that leaves its side early reads a shorter code, so that only the
    /// lengths in use should be let through. Even numbers, 2..most_bar_text.
    int interleaved_shortest = 6;
    int interleaved_longest = 80;
};

/// False where the lengths of Interleaved 2 of 5 are odd, in the wrong order or out of their range.
constexpr bool is_valid(const BarRules& rules);

/// Bytes of the longest text that is read.
inline constexpr int most_bar_text = 96;

/// Where the brightness changes along a line, in 1/256 px from any origin, ascending. Run k lies between the
/// edges k and k + 1; the even ones are spaces, the odd ones are bars. The first and the last edge are the
/// ends of the line.
using BarEdges = Span<const std::int32_t>;

/// What one line says.
struct BarReading {
    Symbology symbology = Symbology::ean_13;
    char aim_digit = '0';
    int first = 0;  ///< the edge where the first bar begins
    int last = 0;   ///< the edge where the last bar ends
    int error = 0;  ///< mean distance of the edges from where they should be, in 1/256 module
    int quiet = 0;  ///< the worse of its quiet zones, in 1/256 of what the standard asks; at most 256
    int size = 0;   ///< bytes of the text
    int base = 0;   ///< those of them that are not of an add-on
    std::uint8_t text[most_bar_text] = {};
};

// ---- Implementation ---------------------------------------------------------------

constexpr bool is_valid(const BarRules& rules) {
    const int shortest = rules.interleaved_shortest;
    const int longest = rules.interleaved_longest;
    return shortest >= 2 && shortest % 2 == 0 && longest % 2 == 0 && longest >= shortest &&
           longest <= most_bar_text;
}

namespace detail {

/// How wide a quiet zone is, in 1/256 of the modules that the standard asks.
constexpr int quiet_share(std::int64_t width, std::int64_t module_total, int modules, int asked) {
    // width / (module_total / modules) / asked
    return static_cast<int>(minimum<std::int64_t>(256, width * modules * 256 / (module_total * asked)));
}

constexpr std::int64_t square(std::int64_t value) { return value * value; }

/// True if value lies between low / 256 and high / 256 of expected.
constexpr bool is_about(std::int64_t value, std::int64_t expected, int low, int high) {
    return value * 256 >= expected * low && value * 256 <= expected * high;
}

}  // namespace detail

}  // namespace fovea
