// SPDX-License-Identifier: MIT
//
// QR codes written. ISO/IEC 18004, clause 7.
#pragma once

#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/code/code.hpp>
#include <fovea/code/qr_mask_penalty.hpp>
#include <fovea/code/qr_matrix.hpp>
#include <fovea/code/qr_segmentation.hpp>
#include <fovea/code/qr_tables.hpp>
#include <fovea/code/reed_solomon.hpp>
#include <fovea/image/bit_view.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

struct QrEncodeOptions {
    static constexpr int best_mask = -1;

    QrLevel level = QrLevel::medium;  ///< more is repaired, and the symbol is larger
    int min_version = 1;   ///< 1 to 40: the smallest that is taken, so that all symbols of a job are one size
    int mask = best_mask;  ///< 0 to 7, or the one of the fewest penalty points: eight times the work
    int eci =
        TextSegment::not_stated;  ///< what the bytes mean: 26 for UTF-8, which most readers guess anyway
};

/// Bytes of a text at most: the digits that version 40 holds.
inline constexpr int max_qr_text = 7089;

/// Scratch bytes that qr_encode() needs.
constexpr std::int64_t qr_encode_scratch(std::int64_t text_size) {
    return 2 * arena_bytes<std::uint8_t>(detail::max_qr_codewords) + arena_bytes<std::uint8_t>(text_size);
}

/// Writes a text as the smallest symbol that holds it, dark modules set, without a quiet zone, which is to be
/// four modules wide. Answers the symbol: the upper left corner of room.
///
/// Shapes   room of at least the symbol's size; max_qr_size always is enough. What is outside of the symbol
///          is left as it is
/// Scratch  qr_encode_scratch(text.size()) bytes, undefined afterwards
/// Errors   bad_argument for an option out of range or a text longer than max_qr_text; scratch_too_small;
///          capacity_exceeded for a text that no version holds at this level; buffer_too_small for a room
///          smaller than the symbol. room is then untouched
/// Source   ISO/IEC 18004, clause 7: digits, the 45 characters and bytes in turn as that is shortest for the
///          version; Chinese and Japanese characters go as bytes
inline Result<BitView<BitWord>> qr_encode(Span<const std::uint8_t> text, const QrEncodeOptions& options,
                                          Span<std::uint8_t> scratch, BitView<BitWord> room);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Bits into bytes from the highest; the bytes are zero before.
class QrBitWriter {
public:
    explicit constexpr QrBitWriter(Span<std::uint8_t> bytes) : bytes_(bytes) {}

    constexpr void put(unsigned value, int count) {
        for (int bit = count - 1; bit >= 0; --bit, ++next_) {
            const unsigned mask = (value >> bit & 1) << (7 - next_ % 8);
            bytes_[next_ / 8] = static_cast<std::uint8_t>(bytes_[next_ / 8] | mask);
        }
    }
    /// Terminator, the rest of a byte, and the two pad codewords in turn. Clause 7.4.10.
    constexpr void finish() {
        const auto room = static_cast<int>(bytes_.size()) * 8 - next_;
        next_ += minimum(4, room);
        next_ = (next_ + 7) / 8 * 8;
        for (unsigned pad = 0xEC; next_ < bytes_.size() * 8; pad ^= 0xEC ^ 0x11) put(pad, 8);
    }

private:
    Span<std::uint8_t> bytes_;
    int next_ = 0;
};

inline void write_qr_run(QrMode mode, Span<const std::uint8_t> text, int version, QrBitWriter& bits) {
    constexpr unsigned indicator[3] = {1, 2, 4};
    bits.put(indicator[static_cast<int>(mode)], 4);
    bits.put(static_cast<unsigned>(text.size()), qr_count_bits_of(mode, version));
    const int group = mode == QrMode::numeric ? 3 : mode == QrMode::alphanumeric ? 2 : 1;
    const unsigned base = mode == QrMode::numeric ? 10 : 45;
    for (std::ptrdiff_t i = 0; i < text.size(); i += group) {
        const auto count = static_cast<int>(minimum<std::ptrdiff_t>(group, text.size() - i));
        unsigned value = 0;
        for (int k = 0; k < count; ++k) {
            const std::uint8_t byte = text[i + k];
            const unsigned digit = mode == QrMode::numeric ? byte - unsigned{'0'}
                                   : mode == QrMode::alphanumeric
                                       ? static_cast<unsigned>(qr_alphanumeric_value(byte))
                                       : byte;
            value = value * base + digit;
        }
        bits.put(value, static_cast<int>(qr_data_bits(mode, count)));
    }
}

inline void write_qr_eci(int eci, QrBitWriter& bits) {
    if (eci == TextSegment::not_stated) return;
    const auto value = static_cast<unsigned>(eci);
    bits.put(7, 4);
    if (eci < 128)
        bits.put(value, 8);
    else if (eci < 16384)
        bits.put(value | 0x8000, 16);
    else
        bits.put(value | 0xC00000, 24);
}

/// Parity behind every block, all blocks interleaved. Clauses 7.5 and 7.6.
inline Status protect_qr_data(const QrBlocks& blocks, Span<const std::uint8_t> data,
                              Span<std::uint8_t> codewords) {
    std::uint8_t parity[max_reed_solomon_parity] = {};
    std::ptrdiff_t first = 0;
    for (int b = 0; b < blocks.blocks; ++b) {
        const Span<const std::uint8_t> block = data.from(first).first(blocks.data(b));
        if (const Status s = QrReedSolomon::encode(block, {parity, blocks.parity}); s != Status::ok) return s;
        for (int i = 0; i < blocks.data(b); ++i) codewords[blocks.place(b, i)] = block[i];
        for (int i = 0; i < blocks.parity; ++i) codewords[blocks.place(b, blocks.data(b) + i)] = parity[i];
        first += blocks.data(b);
    }
    return Status::ok;
}

inline void draw_qr_words(int version, QrFormat format, BitView<BitWord> modules) {
    const int size = modules.width();
    for (int copy = 0; copy < 2; ++copy) {
        for (int bit = 0; bit < 15; ++bit) {
            const Point place = qr_format_place(size, copy, bit);
            modules.set(place.x, place.y, (qr_format_word(format) >> bit & 1) != 0);
        }
        for (int bit = 0; bit < 18 && version >= min_told_qr_version; ++bit) {
            const Point place = qr_version_place(size, copy, bit);
            modules.set(place.x, place.y, (qr_version_word(version) >> bit & 1) != 0);
        }
    }
}

/// The symbol of these codewords.
inline void draw_qr(int version, QrFormat format, Span<const std::uint8_t> codewords,
                    BitView<BitWord> modules) {
    const QrPatterns patterns(version);
    for (int y = 0; y < patterns.size(); ++y) {
        for (int x = 0; x < patterns.size(); ++x) {
            modules.set(x, y, patterns.reserved(x, y) && patterns.dark(x, y));
        }
    }
    draw_qr_words(version, format, modules);
    along_qr_codewords(patterns, [&](int x, int y, int index) {
        const bool bit = index / 8 < codewords.size() && (codewords[index / 8] >> (7 - index % 8) & 1) != 0;
        modules.set(x, y, bit != qr_mask(format.mask, x, y));
    });
}

/// The smallest version that holds a text, 0 if none does; ways are then those of its segmentation.
inline int smallest_qr_version(Span<const std::uint8_t> text, const QrEncodeOptions& options,
                               Span<std::uint8_t> ways) {
    for (int version = options.min_version; version <= max_qr_version;) {
        const int kind = qr_version_class(version);
        const std::int64_t bits = qr_eci_bits(options.eci) + QrSegmentation(text, ways, version).bits();
        for (; version <= max_qr_version && qr_version_class(version) == kind; ++version) {
            if (bits <= 8 * qr_blocks(version, options.level).data_codewords()) return version;
        }
    }
    return 0;
}

}  // namespace detail

inline Result<BitView<BitWord>> qr_encode(Span<const std::uint8_t> text, const QrEncodeOptions& options,
                                          Span<std::uint8_t> scratch, BitView<BitWord> room) {
    if (static_cast<int>(options.level) > 3 || options.min_version < min_qr_version ||
        options.min_version > max_qr_version || options.mask < QrEncodeOptions::best_mask ||
        options.mask > 7 || options.eci < TextSegment::not_stated || options.eci > 999999 ||
        text.size() > max_qr_text)
        return Status::bad_argument;
    if (scratch.size() < qr_encode_scratch(text.size())) return Status::scratch_too_small;
    Arena arena(scratch);
    const Span<std::uint8_t> data_room = arena.take<std::uint8_t>(detail::max_qr_codewords);
    const Span<std::uint8_t> codeword_room = arena.take<std::uint8_t>(detail::max_qr_codewords);
    const Span<std::uint8_t> ways = arena.take<std::uint8_t>(text.size());
    const int version = detail::smallest_qr_version(text, options, ways);
    if (version == 0) return Status::capacity_exceeded;
    const int size = qr_size(version);
    if (room.width() < size || room.height() < size) return Status::buffer_too_small;

    const detail::QrBlocks blocks = detail::qr_blocks(version, options.level);
    const Span<std::uint8_t> data = data_room.first(blocks.data_codewords());
    const Span<std::uint8_t> codewords = codeword_room.first(detail::qr_codewords(version));
    detail::QrBitWriter bits(data);
    detail::write_qr_eci(options.eci, bits);
    const detail::QrSegmentation segments(text, ways, version);
    for (std::ptrdiff_t first = 0; first < text.size();) {
        const std::ptrdiff_t end = segments.run_end(first);
        detail::write_qr_run(segments.mode(first), text.from(first).first(end - first), version, bits);
        first = end;
    }
    bits.finish();
    if (const Status s = detail::protect_qr_data(blocks, data, codewords); s != Status::ok) return s;

    const BitView<BitWord> modules(room.first(), {size, size}, room.stride_words());
    int best = maximum(options.mask, 0);
    if (options.mask == QrEncodeOptions::best_mask) {
        int fewest = -1;
        for (int mask = 0; mask < 8; ++mask) {
            detail::draw_qr(version, {options.level, mask}, codewords, modules);
            const int points = detail::qr_mask_penalty(modules);
            if (fewest >= 0 && points >= fewest) continue;
            fewest = points;
            best = mask;
        }
    }
    detail::draw_qr(version, {options.level, best}, codewords, modules);
    return modules;
}

}  // namespace fovea
