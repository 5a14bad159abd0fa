// SPDX-License-Identifier: MIT
//
// Golden vectors of code/ for QR codes: error correction, symbols written and read, texts.
#pragma once

#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/code/code.hpp>
#include <fovea/code/local_threshold.hpp>
#include <fovea/code/qr_decode.hpp>
#include <fovea/code/qr_encode.hpp>
#include <fovea/code/read_qr.hpp>
#include <fovea/code/reed_solomon.hpp>
#include <fovea/code/symbology.hpp>
#include <fovea/code/text_utf8.hpp>
#include <golden/digest.hpp>
#include <golden/workspace.hpp>

namespace fovea::golden {

inline void put(Digest& digest, Span<const std::uint8_t> bytes) {
    digest.add(static_cast<std::int64_t>(bytes.size()));
    for (const std::uint8_t byte : bytes) digest.add_byte(byte);
}
inline void put(Digest& digest, const CodeText& text) {
    put(digest, text.bytes());
    for (const TextSegment& segment : text.segments()) digest.add(segment.first, segment.eci);
}
inline void put(Digest& digest, const CodeGrade& g) {
    digest.add(g.overall, g.symbol_contrast, g.modulation, g.decodability, g.quiet_zone,
               g.unused_error_correction);
}
inline void put(Digest& digest, const Code& c) {
    digest.add(c.symbology, c.aim_digit, c.text_first, c.text_size, c.agreeing_lines, c.corrected_errors,
               c.inverted, c.mirrored, c.grade);
    for (const SubPixelPoint corner : c.corners) digest.add(corner);
}
inline void put(Digest& digest, const QrSymbol& s) {
    digest.add(s.version, s.level, s.mask, s.aim_digit, s.mirrored, s.corrected_errors, s.unused_correction,
               s.append.position, s.append.total, s.append.parity);
}
inline void put_bits(Digest& digest, BitView<const BitWord> bits) {
    for (int y = 0; y < bits.height(); ++y)
        for (int i = 0; i < bit_words(bits.width()); ++i) digest.add_number(bits.row(y)[i]);
}

inline void code_names(Workspace&, Digest& digest) {
    for (int i = 0; i < symbology_count; ++i) {
        const auto symbology = static_cast<Symbology>(i);
        digest.add(aim_letter(symbology));
        for (const char* c = name(symbology); *c != 0; ++c) digest.add(*c);
        digest.add(SymbologySet(symbology).contains(Symbology::qr), SymbologySet::all().contains(symbology));
    }
    std::uint8_t room[4] = {};
    CodeText text{Span<std::uint8_t>(room)};
    for (int i = 0; i < 5; ++i) {
        digest.add(text.begin_segment(i / 2));
        digest.add(text.push(static_cast<std::uint8_t>(i)));
    }
    digest.add(text);
}

template <class Code>
void put_reed_solomon(Random& random, Digest& digest) {
    std::uint8_t block[max_reed_solomon_block] = {};
    for (int round = 0; round < 12; ++round) {
        const int parity = random.between(2, max_reed_solomon_parity);
        const int data = random.between(1, max_reed_solomon_block - parity);
        for (int i = 0; i < data; ++i) block[i] = static_cast<std::uint8_t>(random.below(256));
        digest.add(Code::encode({block, data}, {block + data, parity}));
        const int errors = random.between(0, parity / 2 + 1);
        for (int i = 0; i < errors; ++i)
            block[random.below(static_cast<std::uint32_t>(data + parity))] ^=
                static_cast<std::uint8_t>(i + 1);
        const Result<int> mended = Code::decode({block, data + parity}, parity);
        digest.add(mended.status(), Span<const std::uint8_t>(block, data + parity));
    }
}
inline void code_reed_solomon(Workspace&, Digest& digest) {
    Random random(71);
    put_reed_solomon<QrReedSolomon>(random, digest);
    put_reed_solomon<DataMatrixReedSolomon>(random, digest);
}

/// Digits, capitals and bytes in turn.
inline Span<const std::uint8_t> code_text(Random& random, int size, Span<std::uint8_t> room) {
    for (int i = 0; i < size; ++i) {
        const int kind = i / 9 % 3;
        room[i] = static_cast<std::uint8_t>(kind == 0   ? random.between('0', '9')
                                            : kind == 1 ? random.between('A', 'Z')
                                                        : random.between(0, 255));
    }
    return room.first(size);
}

inline void code_qr_symbols(Workspace& work, Digest& digest) {
    Random random(72);
    for (int version = 1; version <= max_qr_version; version += version < 8 ? 1 : 8) {
        Arena arena(work.scratch_span());
        const Span<std::uint8_t> room = arena.take<std::uint8_t>(64);
        const Span<const std::uint8_t> text = code_text(random, random.between(1, 10), room);
        const int size = qr_size(version);
        const BitView<BitWord> modules(arena.take<BitWord>(std::int64_t{bit_words(size)} * size).data(),
                                       {size, size}, bit_words(size));
        QrEncodeOptions options;
        options.level = static_cast<QrLevel>(version % 4);
        options.min_version = version;
        if (version > 8) options.mask = version % 8;
        const Result<BitView<BitWord>> symbol =
            qr_encode(text, options, arena.take<std::uint8_t>(qr_encode_scratch(text.size())), modules);
        digest.add(symbol.status());
        if (!symbol) continue;
        put_bits(digest, *symbol);
        symbol->set(size - 1, size - 1, !(*symbol)(size - 1, size - 1));
        std::uint8_t read[64] = {};
        CodeText told{Span<std::uint8_t>(read)};
        const Result<QrSymbol> result =
            qr_decode(*symbol, arena.take<std::uint8_t>(qr_decode_scratch(version)), told);
        digest.add(result.status(), told);
        if (result) digest.add(*result);
    }
}

/// A symbol of version 1 turned and sheared, about two and a half pixels a module, in noise.
inline ImageView<const Gray8> qr_picture(Workspace& work, int turn) {
    Random random(73);
    std::uint8_t room[16] = {};
    BitStorage<21, 21> modules;
    Arena arena(work.scratch_span());
    const Result<BitView<BitWord>> symbol = qr_encode(
        code_text(random, 9, room), {}, arena.take<std::uint8_t>(qr_encode_scratch(9)), modules.view());
    const ImageView<Gray8> image = work.view<Gray8>(0, {104, 74});
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            // In 1/256 module, around the middle of both.
            const int u = (x - 52) * 100 + (y - 37) * turn * 8 + 21 * 128;
            const int v = (y - 37) * 102 - (x - 52) * turn * 8 + 21 * 128;
            const bool inside = u >= 0 && v >= 0 && u < 21 * 256 && v < 21 * 256;
            const bool dark = inside && symbol && (*symbol)(u / 256, v / 256);
            image(x, y) = static_cast<Gray8>((dark ? 40 : 200) + random.between(-12, 12));
        }
    }
    return image;
}
inline void code_read_qr(Workspace& work, Digest& digest) {
    for (const int turn : {0, 2, 5}) {
        const ImageView<const Gray8> image = qr_picture(work, turn);
        Arena arena(work.scratch_span());
        std::uint8_t room[64] = {};
        CodeText text{Span<std::uint8_t>(room)};
        List<Code, 2> codes;
        digest.add(
            read_qr(image, {}, arena.take_unset<std::uint8_t>(read_qr_scratch(image.size())), text, codes));
        digest.add(text);
        for (const Code& code : codes) digest.add(code);
    }
}

inline void code_local_threshold(Workspace& work, Digest& digest) {
    const ImageView<const Gray8> image = qr_picture(work, 3);
    for (const int block : {4, 9, 32}) {
        Arena arena(work.scratch_span());
        const BitView<BitWord> bits(
            arena.take<BitWord>(std::int64_t{bit_words(image.width())} * image.height()).data(), image.size(),
            bit_words(image.width()));
        LocalThresholdOptions options;
        options.block = block;
        const Span<std::uint8_t> scratch =
            arena.take_unset<std::uint8_t>(local_threshold_scratch(image.size(), block));
        digest.add(local_threshold(image, options, scratch, bits));
        put_bits(digest, bits);
    }
}

inline void code_text_utf8(Workspace&, Digest& digest) {
    Random random(74);
    for (int eci = TextSegment::not_stated; eci <= 30; ++eci) {
        std::uint8_t room[40] = {};
        CodeText text{Span<std::uint8_t>(room)};
        digest.add(text.begin_segment(eci));
        for (int i = 0; i < 40; ++i) digest.add(text.push(static_cast<std::uint8_t>(random.below(256))));
        std::uint8_t utf8[text_utf8_room(40)] = {};
        const Result<int> size = text_utf8(text, 0, text.size(), utf8);
        digest.add(size.status());
        if (size) digest.add(Span<const std::uint8_t>(utf8, *size));
    }
}

}  // namespace fovea::golden
