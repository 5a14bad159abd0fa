// SPDX-License-Identifier: MIT
//
// EAN and UPC codes along one scan line. ISO/IEC 15420; book ch. 5.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/code/bar_reading.hpp>
#include <fovea/code/ean_tables.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Reads the EAN-13, UPC-A, EAN-8 or UPC-E that begins with the bar behind edge `first`.
///
/// A digit is told by the distances of edges of the same kind, which printing gain does not move, and by the
/// width of its bars, less the gain that the guards show. The module may change slowly along the line.
///
/// Shapes    `first` odd. The quiet zones are what the runs beside the code show: at least a fifth of what
///           the standard asks, a third of it for EAN-8 and half of it for UPC-E, where fewer digits speak
///           for them
/// Rounding  each digit is the nearest one, and must be nearer than the next by a clear margin
/// Errors    out_of_range; not_found, with the reading untouched
/// Source    ISO/IEC 15420, 4.2 to 4.5 and annex B, the reference decoding algorithm
inline Status decode_ean(BarEdges edges, int first, const BarRules& rules, BarReading& reading);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// How far a digit may lie from the ideal one, and how much farther the next one must be: squares of 1/64
/// module. Two digits that differ in one edge lie 64^2 * 3/2 apart.
inline constexpr int ean_farthest = 1700;
inline constexpr int ean_margin = 1000;
/// The worst mean error of codes of few digits, in 1/256 module: lines through text and matrix codes read as
/// UPC-E with 102 and more, blurred photos of true ones reach 80.
inline constexpr int ean_8_worst = 100;
inline constexpr int upc_e_worst = 88;
inline constexpr int upc_e_farthest = 1100;
/// 1 and 7, and 2 and 8, are twins: their edges of the same kind are equally far apart, and only bars of
/// three or five modules tell them apart. In blur they are wrong by a module and more. A twin is doubtful
/// where its bars lie farther from their own width than half of the way to the middle between both, in 1/64
/// module.
inline constexpr int ean_twin_farthest = 32;
/// Least quiet zones, in 1/256 of what is asked.
inline constexpr int ean_13_quiet = 256 / 5;
inline constexpr int ean_8_quiet = 256 / 3;
inline constexpr int upc_e_quiet = 256 / 2;

struct EanDigit {
    int value = 0;
    int set_b = 0;
    int error = 0;
    bool doubtful = false;  ///< it could be its twin
};

/// The other one of 1 and 7, and of 2 and 8; any other digit itself.
constexpr int ean_twin(int digit) {
    if (digit == 1 || digit == 2) return digit + 6;
    return digit == 7 || digit == 8 ? digit - 6 : digit;
}

/// A symbol that is being read: edges, and what its guards tell of it.
struct EanSymbol {
    BarEdges edges;
    int first = 0;
    std::int64_t width = 0;  ///< of the whole symbol
    int modules = 0;
    std::int64_t gain = 0;  ///< by how much a bar is too wide
    std::int64_t error = 0;
    int worst = 0;          ///< of the digits: squares of 1/64 module
    unsigned doubtful = 0;  ///< a bit for each digit, the last one in the lowest

    constexpr std::int32_t edge(int index) const { return edges[first + index]; }
    constexpr std::int64_t between(int from, int to) const { return std::int64_t{edge(to)} - edge(from); }
};

/// The digit whose first edge is `at`, of sets A and B, or of set C where it begins with a bar. sevenfold is
/// the width of seven modules near it.
constexpr bool read_ean_digit(const EanSymbol& symbol, int at, std::int64_t sevenfold, bool begins_with_bar,
                              EanDigit& digit) {
    const auto scaled = [&](std::int64_t width) {
        return static_cast<int>(round_divide(width * (7 * 64), sevenfold));
    };
    const int near = scaled(symbol.between(at, at + 2));
    const int far = scaled(symbol.between(at + 1, at + 3));
    const int bar = begins_with_bar ? 0 : 1;
    const int bars = scaled(symbol.between(at + bar, at + bar + 1) +
                            symbol.between(at + bar + 2, at + bar + 3) - 2 * symbol.gain);
    int best = ean_farthest * 4;
    int next = best;
    for (int set_b = 0; set_b < (begins_with_bar ? 1 : 2); ++set_b) {
        for (int value = 0; value < 10; ++value) {
            const std::uint8_t* widths = ean_widths[value];
            const int w0 = widths[set_b ? 3 : 0];
            const int w1 = widths[set_b ? 2 : 1];
            const int w2 = widths[set_b ? 1 : 2];
            const int w3 = widths[set_b ? 0 : 3];
            const int wide = begins_with_bar ? w0 + w2 : w1 + w3;
            const int a = near - 64 * (w0 + w1);
            const int b = far - 64 * (w1 + w2);
            const int c = bars - 64 * wide;
            if (maximum(maximum(a, -a), maximum(maximum(b, -b), maximum(c, -c))) > 256) continue;
            const int distance = a * a + b * b + c * c / 2;
            if (distance < best) {
                next = best;
                best = distance;
                digit.value = value;
                digit.set_b = set_b;
                digit.doubtful = ean_twin(value) != value && maximum(c, -c) > ean_twin_farthest;
            } else if (distance < next) {
                next = distance;
            }
        }
    }
    digit.error = best;
    return best <= ean_farthest && next - best >= ean_margin;
}

/// False if the widths of some digits in a row from edge `at` on jump, or are far from the mean.
constexpr bool are_ean_digits_even(const EanSymbol& symbol, int at, int count) {
    const std::int64_t mean = symbol.width * 7;  // times modules
    std::int64_t before = symbol.between(at, at + 4);
    for (int i = 0; i < count; ++i) {
        const std::int64_t own = symbol.between(at + 4 * i, at + 4 * i + 4);
        if (!is_about(own * symbol.modules, mean, 128, 512) || !is_about(before, own, 180, 364)) return false;
        before = own;
    }
    return true;
}

/// Reads count digits from edge `at` on. False if one of them is none.
constexpr bool read_ean_digits(EanSymbol& symbol, int at, int count, bool begins_with_bar,
                               std::uint8_t* values, unsigned& parity) {
    parity = 0;
    for (int i = 0; i < count; ++i) {
        const std::int64_t own = symbol.between(at + 4 * i, at + 4 * i + 4);
        const std::int64_t before = i > 0 ? symbol.between(at + 4 * i - 4, at + 4 * i) : own;
        const std::int64_t behind = i + 1 < count ? symbol.between(at + 4 * i + 4, at + 4 * i + 8) : own;
        // The neighbours' share steadies the module; where the surface bends it is wrong, and the digit's own
        // width is right.
        const std::int64_t shared = (2 * own + before + behind) / 4;
        EanDigit digit;
        if (!read_ean_digit(symbol, at + 4 * i, shared, begins_with_bar, digit) &&
            (own == shared || !read_ean_digit(symbol, at + 4 * i, own, begins_with_bar, digit))) {
            return false;
        }
        values[i] = static_cast<std::uint8_t>(digit.value);
        parity = parity << 1 | static_cast<unsigned>(digit.set_b);
        symbol.worst = maximum(symbol.worst, digit.error);
        symbol.doubtful = symbol.doubtful << 1 | (digit.doubtful ? 1U : 0U);
        symbol.error += isqrt(static_cast<std::uint32_t>(digit.error));
    }
    return true;
}

/// True if twins could stand for some of the doubtful digits with the same check digit, the last one.
constexpr bool are_twins_open(Span<const std::uint8_t> digits, unsigned doubtful) {
    const auto count = static_cast<int>(digits.size());
    // A bit for each change of the weighted sum, modulo ten, to which exchanged digits add up.
    unsigned reached = 0;
    for (int i = 0; i < count; ++i) {
        if ((doubtful >> i & 1U) == 0) continue;
        const int digit = digits[count - 1 - i];
        const int change = ((ean_twin(digit) - digit) * (i % 2 == 0 ? 1 : 3) + 20) % 10;
        reached |= ((reached << change | reached >> (10 - change)) & 0x3ffU) | 1U << change;
    }
    return (reached & 1U) != 0;
}

/// The place of parity in a table of ten, or -1.
constexpr int place_of(unsigned parity, const std::uint8_t (&table)[10]) {
    for (int i = 0; i < 10; ++i)
        if (table[i] == parity) return i;
    return -1;
}

/// True if the symbol can be of so many runs and modules, going by its guards; sets its gain then. The guards
/// begin at the edges in `guards`, of so many modules each, and every second run of them is a bar.
struct EanGuard {
    int at;
    int runs;
    bool begins_with_bar;
};
inline constexpr int ean_13_runs = 59;
inline constexpr EanGuard ean_13_guards[] = {{0, 3, true}, {27, 5, false}, {56, 3, true}};
inline constexpr int upc_e_runs = 33;
inline constexpr EanGuard upc_e_guards[] = {{0, 3, true}, {27, 6, false}};
template <std::size_t Count>
constexpr bool match_guards(EanSymbol& symbol, int runs, int modules, const EanGuard (&guards)[Count]) {
    if (symbol.first + runs + 1 >= symbol.edges.size()) return false;
    symbol.modules = modules;
    symbol.width = symbol.between(0, runs);
    if (symbol.width < modules * 128) return false;  // half a pixel a module
    std::int64_t bars = 0;
    std::int64_t spaces = 0;
    int bar_count = 0;
    int space_count = 0;
    for (const EanGuard& guard : guards) {
        const std::int64_t own = symbol.between(guard.at, guard.at + guard.runs) * modules;
        if (!is_about(own, symbol.width * guard.runs, 128, 512)) return false;
        for (int i = 0; i < guard.runs; ++i) {
            const std::int64_t run = symbol.between(guard.at + i, guard.at + i + 1);
            if (run * guard.runs * 256 > symbol.between(guard.at, guard.at + guard.runs) * 600) return false;
            const bool bar = (i % 2 == 0) == guard.begins_with_bar;
            (bar ? bars : spaces) += run;
            (bar ? bar_count : space_count) += 1;
        }
    }
    // A bar is wider by the gain than its module, a space is narrower by as much.
    symbol.gain = (bars * space_count - spaces * bar_count) / (2 * bar_count * space_count);
    return true;
}

/// A guard, and the quiet zone that is asked beside it, in modules.
struct EanEnd {
    int runs;
    int modules;
};

/// The narrower of both quiet zones, in 1/256 of what is asked: in the modules of the guard beside it, as
/// those of the other end may be of another size.
constexpr int ean_quiet(const EanSymbol& symbol, int runs, EanEnd left, EanEnd right) {
    const int before =
        quiet_share(symbol.between(-1, 0), symbol.between(0, left.runs), left.runs, left.modules);
    const int behind = quiet_share(symbol.between(runs, runs + 1), symbol.between(runs - right.runs, runs),
                                   right.runs, right.modules);
    return minimum(before, behind);
}

constexpr void finish_ean(const EanSymbol& symbol, int runs, int digits, Symbology symbology, EanEnd left,
                          EanEnd right, BarReading& reading) {
    reading.symbology = symbology;
    reading.aim_digit = symbology == Symbology::ean_8 ? '4' : '0';
    reading.first = symbol.first;
    reading.last = symbol.first + runs;
    reading.error = static_cast<int>(symbol.error * 4 / digits);
    reading.quiet = ean_quiet(symbol, runs, left, right);
}

constexpr void set_digits(BarReading& reading, const std::uint8_t* digits, int count) {
    reading.size = count;
    reading.base = count;
    for (int i = 0; i < count; ++i) reading.text[i] = static_cast<std::uint8_t>('0' + digits[i]);
}

inline bool decode_ean_13(EanSymbol symbol, const BarRules& rules, BarReading& reading) {
    constexpr int runs = ean_13_runs;
    if (!match_guards(symbol, runs, ean_13_modules, ean_13_guards)) return false;
    // Before the digits, which take long: UPC-A asks for less to the left, and EAN-13 to the right.
    if (ean_quiet(symbol, runs, {3, 9}, {3, 7}) < ean_13_quiet) return false;
    if (!are_ean_digits_even(symbol, 3, 6) || !are_ean_digits_even(symbol, 32, 6)) return false;
    std::uint8_t digits[13] = {};
    unsigned left = 0;
    unsigned right = 0;
    if (!read_ean_digits(symbol, 3, 6, false, digits + 1, left)) return false;
    const int leading = place_of(left, ean_13_parity);
    if (leading < 0) return false;
    digits[0] = static_cast<std::uint8_t>(leading);
    if (!read_ean_digits(symbol, 32, 6, true, digits + 7, right)) return false;
    if (ean_check_digit({digits, 12}) != digits[12]) return false;
    if (are_twins_open({digits, 13}, symbol.doubtful)) return false;
    const bool as_upc = leading == 0 && rules.symbologies.contains(Symbology::upc_a);
    if (!as_upc && !rules.symbologies.contains(Symbology::ean_13)) return false;
    BarReading found;
    finish_ean(symbol, runs, 12, as_upc ? Symbology::upc_a : Symbology::ean_13, {3, as_upc ? 9 : 11},
               {3, as_upc ? 9 : 7}, found);
    if (found.quiet < ean_13_quiet) return false;
    set_digits(found, digits + (as_upc ? 1 : 0), as_upc ? 12 : 13);
    reading = found;
    return true;
}

inline bool decode_ean_8(EanSymbol symbol, BarReading& reading) {
    constexpr int runs = 43;
    constexpr EanGuard guards[] = {{0, 3, true}, {19, 5, false}, {40, 3, true}};
    if (!match_guards(symbol, runs, ean_8_modules, guards)) return false;
    if (ean_quiet(symbol, runs, {3, 7}, {3, 7}) < ean_8_quiet) return false;
    if (!are_ean_digits_even(symbol, 3, 4) || !are_ean_digits_even(symbol, 24, 4)) return false;
    std::uint8_t digits[8] = {};
    unsigned left = 0;
    unsigned right = 0;
    if (!read_ean_digits(symbol, 3, 4, false, digits, left) || left != 0) return false;
    if (!read_ean_digits(symbol, 24, 4, true, digits + 4, right)) return false;
    if (ean_check_digit({digits, 7}) != digits[7] || are_twins_open({digits, 8}, symbol.doubtful))
        return false;
    BarReading found;
    finish_ean(symbol, runs, 8, Symbology::ean_8, {3, 7}, {3, 7}, found);
    if (found.quiet < ean_8_quiet || found.error > ean_8_worst) return false;
    set_digits(found, digits, 8);
    reading = found;
    return true;
}

inline bool decode_upc_e(EanSymbol symbol, BarReading& reading) {
    constexpr int runs = upc_e_runs;
    if (!match_guards(symbol, runs, upc_e_modules, upc_e_guards)) return false;
    // The left half of an EAN-13 looks like a UPC-E that is followed by a space of up to four modules.
    if (symbol.between(runs, runs + 1) * 6 < symbol.between(27, 33) * 5) return false;
    if (ean_quiet(symbol, runs, {3, 9}, {6, 7}) < upc_e_quiet) return false;
    if (!are_ean_digits_even(symbol, 3, 6)) return false;
    std::uint8_t digits[8] = {};
    unsigned parity = 0;
    if (!read_ean_digits(symbol, 3, 6, false, digits + 1, parity)) return false;
    int check = place_of(parity, upc_e_parity);
    if (check < 0) {
        check = place_of(parity ^ 0b111111U, upc_e_parity);
        if (check < 0) return false;
        digits[0] = 1;
    }
    digits[7] = static_cast<std::uint8_t>(check);
    std::uint8_t upc_a[12] = {};
    upc_a_of_upc_e(digits, upc_a);
    if (ean_check_digit({upc_a, 11}) != check || symbol.doubtful != 0) return false;
    BarReading found;
    finish_ean(symbol, runs, 6, Symbology::upc_e, {3, 9}, {6, 7}, found);
    // The left half of an EAN-13 has the parities of number system 1: where its right half is covered from
    // its first bar on, what is left of that bar is not as wide as the bars of the guards.
    const std::int64_t bars =
        symbol.between(0, 1) + symbol.between(2, 3) + symbol.between(28, 29) + symbol.between(30, 31);
    if (digits[0] == 1 && !is_about(symbol.between(32, 33) * 4, bars, 170, 342)) return false;
    if (found.quiet < upc_e_quiet || found.error > upc_e_worst || symbol.worst > upc_e_farthest) return false;
    set_digits(found, digits, 8);
    reading = found;
    return true;
}

/// Reads the add-on of so many digits behind the code of the reading. It is printed with the gain that the
/// guards of the code have shown.
inline bool decode_add_on(const EanSymbol& code, int count, BarReading& reading) {
    const int runs = 6 * count + 1;
    EanSymbol symbol{code.edges, reading.last + 1, 0, 0, code.gain, 0, 0, 0};
    if (symbol.first + runs + 1 >= code.edges.size()) return false;
    symbol.modules = 9 * count + 2;
    symbol.width = symbol.between(0, runs);
    // Of the size of the code, 5 to 16 modules away from it, and followed by a quiet zone of 5.
    if (!is_about(symbol.width * code.modules, code.width * symbol.modules, 200, 328)) return false;
    const std::int64_t gap = symbol.between(-1, 0) * code.modules;
    if (gap < 5 * code.width || gap > 16 * code.width) return false;
    if (symbol.between(runs, runs + 1) * code.modules < 4 * code.width) return false;
    if (!is_about(symbol.between(0, 3) * symbol.modules, symbol.width * 4, 160, 352)) return false;
    std::uint8_t digits[5] = {};
    unsigned parity = 0;
    for (int i = 0; i < count; ++i) {
        const int at = 3 + 6 * i;
        unsigned set_b = 0;
        if (!are_ean_digits_even(symbol, at, 1)) return false;
        if (!read_ean_digits(symbol, at, 1, false, digits + i, set_b)) return false;
        parity = parity << 1 | set_b;
        if (i + 1 < count &&
            !is_about(symbol.between(at + 4, at + 6) * symbol.modules, symbol.width * 2, 128, 400)) {
            return false;
        }
    }
    // Its parities say too little to find what was exchanged.
    if (symbol.doubtful != 0) return false;
    if (count == 2 && parity != static_cast<unsigned>((digits[0] * 10 + digits[1]) % 4)) return false;
    if (count == 5 && parity != add_on_5_parity[add_on_5_check({digits, 5})]) return false;
    for (int i = 0; i < count; ++i) reading.text[reading.size++] = static_cast<std::uint8_t>('0' + digits[i]);
    reading.aim_digit = '3';
    return true;
}

}  // namespace detail

inline Status decode_ean(BarEdges edges, int first, const BarRules& rules, BarReading& reading) {
    if (first < 1 || first % 2 == 0 || first >= edges.size()) return Status::out_of_range;
    detail::EanSymbol symbol{edges, first, 0, 0, 0, 0, 0, 0};
    const SymbologySet wanted = rules.symbologies;
    // Three runs of about the same width begin all of them.
    if (first + 3 >= edges.size()) return Status::not_found;
    const std::int64_t guard = symbol.between(0, 3);
    if (symbol.between(0, 1) * 8 > guard * 5 || symbol.between(1, 2) * 8 > guard * 5)
        return Status::not_found;
    if (!detail::is_about(symbol.between(0, 1), symbol.between(2, 3), 64, 1024)) return Status::not_found;
    if (symbol.between(-1, 0) * 3 < guard * 2) return Status::not_found;
    bool found = (wanted.contains(Symbology::ean_13) || wanted.contains(Symbology::upc_a)) &&
                 detail::decode_ean_13(symbol, rules, reading);
    found = found || (wanted.contains(Symbology::ean_8) && detail::decode_ean_8(symbol, reading));
    found = found || (wanted.contains(Symbology::upc_e) && detail::decode_upc_e(symbol, reading));
    if (!found) return Status::not_found;
    if (rules.add_on == AddOn::appended && reading.symbology != Symbology::ean_8) {
        // The guards match, as the code was read.
        static_cast<void>(
            reading.symbology == Symbology::upc_e
                ? detail::match_guards(symbol, detail::upc_e_runs, upc_e_modules, detail::upc_e_guards)
                : detail::match_guards(symbol, detail::ean_13_runs, ean_13_modules, detail::ean_13_guards));
        if (!detail::decode_add_on(symbol, 5, reading)) {
            static_cast<void>(detail::decode_add_on(symbol, 2, reading));
        }
    }
    return Status::ok;
}

}  // namespace fovea
