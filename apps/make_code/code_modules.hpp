// SPDX-License-Identifier: MIT
//
// A text as the modules of a symbol, with its quiet zone.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <fovea/code/code_128_encoder.hpp>
#include <fovea/code/data_matrix_encode.hpp>
#include <fovea/code/ean_encoder.hpp>
#include <fovea/code/qr_encode.hpp>
#include <fovea/code/symbology.hpp>
#include <fovea/code/two_width_encoder.hpp>

#include <common/text.hpp>
#include <read/symbology_names.hpp>

namespace fovea::apps {

/// What a symbol is to be like.
struct CodeDesign {
    Symbology symbology = Symbology::qr;
    QrEncodeOptions qr;
    DataMatrixOptions data_matrix;
    Code128Kind code_128 = Code128Kind::plain;
    Code39Text code_39 = Code39Text::plain;
    bool check = false;   ///< adds the check character that Code 39, Interleaved 2 of 5 and Codabar may have
    int bar_height = 50;  ///< modules
    int quiet = -1;       ///< modules on each side; -1 for what the standard asks
};

/// Modules row by row, 1 is dark; the quiet zone is not among them. Bars have one row.
struct CodeModules {
    Size size;
    std::vector<std::uint8_t> dark;
    int quiet = 0;
    bool bars = false;

    bool is_dark(int x, int y) const {
        const auto width = static_cast<std::size_t>(size.width);
        return dark[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)] != 0;
    }
};

/// The quiet zone that the standard of a symbology asks for on both sides, the larger where they differ.
constexpr int quiet_modules(Symbology symbology) {
    switch (symbology) {
        case Symbology::ean_13: return 11;  // ISO/IEC 15420, 4.3.4
        case Symbology::ean_8: return 7;
        case Symbology::upc_a:
        case Symbology::upc_e: return 9;
        case Symbology::qr: return 4;           // ISO/IEC 18004, 6.3.8
        case Symbology::data_matrix: return 1;  // ISO/IEC 16022, 4.4
        default: return 10;                     // ISO/IEC 15417, 16388 and 16390
    }
}

namespace detail {

inline Status encode_bars(const std::string& text, const CodeDesign& design, BarWidths widths) {
    const Span<const std::uint8_t> bytes = bytes_of(text);
    TwoWidthOptions two_widths;
    two_widths.with_check = design.check;
    switch (design.symbology) {
        case Symbology::ean_13: return encode_ean_13(bytes, widths);
        case Symbology::ean_8: return encode_ean_8(bytes, widths);
        case Symbology::upc_a: return encode_upc_a(bytes, widths);
        case Symbology::upc_e: return encode_upc_e(bytes, widths);
        case Symbology::code_128: return encode_code_128(bytes, design.code_128, widths);
        case Symbology::code_39: return encode_code_39(bytes, design.code_39, two_widths, widths);
        case Symbology::interleaved_2_of_5: return encode_interleaved(bytes, two_widths, widths);
        case Symbology::codabar: return encode_codabar(bytes, two_widths, widths);
        default: return Status::bad_argument;
    }
}

/// What a symbology takes, for who gave it something else.
inline const char* takes(Symbology symbology) {
    switch (symbology) {
        case Symbology::ean_13: return "12 digits, or 13 with a right check digit";
        case Symbology::ean_8: return "7 digits, or 8 with a right check digit";
        case Symbology::upc_a: return "11 digits, or 12 with a right check digit";
        case Symbology::upc_e: return "7 digits that begin with 0 or 1, or 8 with a right check digit";
        case Symbology::code_128: return "ASCII";
        case Symbology::code_39: return "capitals, digits, blanks and - . $ / + %; with --ascii all of ASCII";
        case Symbology::interleaved_2_of_5: return "digits";
        case Symbology::codabar: return "digits and - $ : / . +, which may stand between two of A B C D";
        case Symbology::qr: return "a text that fits version 40 at its level";
        case Symbology::data_matrix: return "a text that fits 144x144 modules, or the size asked for";
    }
    return "";
}

inline void take_modules(BitView<const BitWord> bits, CodeModules& modules) {
    modules.size = bits.size();
    modules.dark.clear();
    for (int y = 0; y < bits.height(); ++y)
        for (int x = 0; x < bits.width(); ++x) modules.dark.push_back(bits(x, y) ? 1 : 0);
}

}  // namespace detail

/// The modules of a text; the problem if there are none.
inline std::string modules_of(const std::string& text, const CodeDesign& design, CodeModules& modules) {
    modules = CodeModules();
    modules.quiet = design.quiet >= 0 ? design.quiet : quiet_modules(design.symbology);
    modules.bars = bar_symbologies().contains(design.symbology);
    Status status = Status::ok;
    if (modules.bars) {
        std::vector<std::uint8_t> widths(4096);
        int count = 0;
        status = detail::encode_bars(text, design, BarWidths(widths.data(), 4096, &count));
        for (int i = 0; i < count; ++i)
            modules.dark.insert(modules.dark.end(), widths[static_cast<std::size_t>(i)],
                                static_cast<std::uint8_t>(i % 2 == 0 ? 1 : 0));
        modules.size = {static_cast<int>(modules.dark.size()), 1};
    } else {
        const int side = max_qr_size;
        std::vector<BitWord> words(static_cast<std::size_t>(side) *
                                   static_cast<std::size_t>(bit_words(side)));
        const BitView<BitWord> room(words.data(), {side, side}, bit_words(side));
        const auto bytes = static_cast<std::int64_t>(text.size());
        std::vector<std::uint8_t> scratch(
            static_cast<std::size_t>(maximum(qr_encode_scratch(bytes), data_matrix_encode_scratch(bytes))));
        const Span<std::uint8_t> memory(scratch.data(), static_cast<std::ptrdiff_t>(scratch.size()));
        Size size;
        if (design.symbology == Symbology::qr) {
            const Result<BitView<BitWord>> symbol = qr_encode(bytes_of(text), design.qr, memory, room);
            status = symbol.status();
            if (symbol) size = symbol->size();
        } else {
            const Result<Size> symbol = data_matrix_encode(bytes_of(text), design.data_matrix, memory, room);
            status = symbol.status();
            if (symbol) size = *symbol;
        }
        if (status == Status::ok)
            detail::take_modules(BitView<const BitWord>(words.data(), size, bit_words(side)), modules);
    }
    if (status == Status::ok) return "";
    return "'" + one_line(shortened(text, 40)) + "' is no text for " + word_of(design.symbology) +
           ", which takes " + detail::takes(design.symbology);
}

}  // namespace fovea::apps
