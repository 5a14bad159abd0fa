// SPDX-License-Identifier: MIT
//
// A QR code read from its modules. ISO/IEC 18004, clause 12.
#pragma once

#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/code/code.hpp>
#include <fovea/code/qr_matrix.hpp>
#include <fovea/code/qr_segments.hpp>
#include <fovea/code/qr_tables.hpp>
#include <fovea/code/reed_solomon.hpp>
#include <fovea/image/bit_view.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// What a symbol tells beside its text.
struct QrSymbol {
    int version = 0;
    QrLevel level = QrLevel::low;
    int mask = 0;
    char aim_digit = '1';
    bool mirrored = false;        ///< its modules are those of a symbol seen from behind
    int corrected_errors = 0;     ///< codewords
    int unused_correction = 100;  ///< percent of what the worst block could have mended and did not need
    QrStructuredAppend append;
};

/// Scratch bytes that qr_decode() needs for symbols of up to that version: the codewords as they are read,
/// and the data.
constexpr std::int64_t qr_decode_scratch(int version = max_qr_version) {
    return 2 * arena_bytes<std::uint8_t>(detail::qr_codewords(version));
}

/// Reads the symbol whose modules are the pixels of a binary image, dark ones set, without a quiet zone, and
/// appends what it says to text.
///
/// Shapes   modules 21x21, 25x25 and so on to 177x177
/// Time     bounded: four readings at most, two of the format and two of the mirror
/// Scratch  qr_decode_scratch() of the version, undefined afterwards
/// Errors   empty_image; size_mismatch for no size of a symbol; scratch_too_small; not_found without a format
///          that is one; undecided where error correction fails; malformed or unsupported for contents that
///          are not read; buffer_too_small and capacity_exceeded for a text that does not fit. text is then
///          what it was
/// Source   ISO/IEC 18004, clause 12, with the codewords held back that it asks for. Model 1 and Micro QR are
///          not read
inline Result<QrSymbol> qr_decode(BitView<const BitWord> modules, Span<std::uint8_t> scratch, CodeText& text);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

class QrDecoder {
public:
    QrDecoder(int version, Span<std::uint8_t> scratch) : version_(version), patterns_(version) {
        Arena arena(scratch);
        codewords_ = arena.take<std::uint8_t>(qr_codewords(version));
        data_ = arena.take<std::uint8_t>(qr_codewords(version));
    }

    Result<QrSymbol> read(QrModules modules, CodeText& text) {
        if (contradicts_version(modules)) return Status::malformed;
        Status worst = Status::not_found;
        int tried = -1;
        for (int copy = 0; copy < 2; ++copy) {
            const int format = nearest_qr_format(modules.format_word(copy));
            if (format < 0 || format == tried) continue;
            tried = format;
            const Result<QrSymbol> symbol =
                read(modules, {static_cast<QrLevel>(format / 8), format % 8}, text);
            if (symbol) return symbol;
            worst = symbol.status();
        }
        return worst;
    }

private:
    /// A version is told twice: one copy may be lost.
    bool contradicts_version(const QrModules& modules) const {
        if (version_ < min_told_qr_version) return false;
        const int first = nearest_qr_version(modules.version_word(0));
        const int second = nearest_qr_version(modules.version_word(1));
        return first != version_ && second != version_ && first + second != 0;
    }
    Result<QrSymbol> read(const QrModules& modules, QrFormat format, CodeText& text) {
        for (std::uint8_t& codeword : codewords_) codeword = 0;
        along_qr_codewords(patterns_, [&](int x, int y, int index) {
            // The last up to seven modules belong to no codeword.
            if (index / 8 >= codewords_.size() || modules(x, y) == qr_mask(format.mask, x, y)) return;
            codewords_[index / 8] = static_cast<std::uint8_t>(codewords_[index / 8] | 0x80 >> index % 8);
        });
        QrSymbol symbol;
        symbol.version = version_;
        symbol.level = format.level;
        symbol.mask = format.mask;
        symbol.mirrored = modules.mirrored;
        const QrBlocks blocks = qr_blocks(version_, format.level);
        if (const Status s = mend(blocks, symbol); s != Status::ok) return s;
        const Result<QrContents> contents =
            read_qr_segments(data_.first(blocks.data_codewords()), version_, text);
        if (!contents) return contents.status();
        symbol.aim_digit = contents->aim_digit;
        symbol.append = contents->append;
        return symbol;
    }
    Status mend(const QrBlocks& blocks, QrSymbol& symbol) {
        const int reserve = qr_misdecode_reserve(version_, symbol.level);
        std::uint8_t block[max_reed_solomon_block] = {};
        int next = 0;
        for (int b = 0; b < blocks.blocks; ++b) {
            const int size = blocks.data(b) + blocks.parity;
            for (int i = 0; i < size; ++i) block[i] = codewords_[blocks.place(b, i)];
            const Result<int> mended = QrReedSolomon::decode({block, size}, blocks.parity, {}, reserve);
            if (!mended) return mended.status();
            symbol.corrected_errors += *mended;
            const int unused = 100 - 200 * *mended / (blocks.parity - reserve);
            symbol.unused_correction = minimum(symbol.unused_correction, maximum(unused, 0));
            for (int i = 0; i < blocks.data(b); ++i) data_[next++] = block[i];
        }
        return Status::ok;
    }

    int version_;
    QrPatterns patterns_;
    Span<std::uint8_t> codewords_;
    Span<std::uint8_t> data_;
};

}  // namespace detail

inline Result<QrSymbol> qr_decode(BitView<const BitWord> modules, Span<std::uint8_t> scratch,
                                  CodeText& text) {
    if (modules.empty()) return Status::empty_image;
    const int size = modules.width();
    if (modules.height() != size || size < qr_size(min_qr_version) || size > max_qr_size || size % 4 != 1)
        return Status::size_mismatch;
    const int version = (size - 17) / 4;
    if (scratch.size() < qr_decode_scratch(version)) return Status::scratch_too_small;
    detail::QrDecoder decoder(version, scratch);
    const Result<QrSymbol> symbol = decoder.read({modules, false}, text);
    if (symbol) return symbol;
    const Result<QrSymbol> mirrored = decoder.read({modules, true}, text);
    // What came nearer to being read says what is wrong.
    return mirrored || symbol.status() == Status::not_found ? mirrored : symbol;
}

}  // namespace fovea
