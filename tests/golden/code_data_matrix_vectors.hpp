// SPDX-License-Identifier: MIT
//
// Golden vectors of code/ for Data Matrix: symbols written and read, and found in images.
#pragma once

#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/code/code.hpp>
#include <fovea/code/data_matrix_decode.hpp>
#include <fovea/code/data_matrix_encodation.hpp>
#include <fovea/code/data_matrix_encode.hpp>
#include <fovea/code/data_matrix_placement.hpp>
#include <fovea/code/data_matrix_sizes.hpp>
#include <fovea/code/data_matrix_text.hpp>
#include <fovea/code/read_data_matrix.hpp>
#include <golden/digest.hpp>
#include <golden/workspace.hpp>

namespace fovea::golden {

inline void put_data_matrix_text(Digest& digest, const CodeText& text) {
    digest.add(text.size());
    for (const std::uint8_t byte : text.bytes()) digest.add_byte(byte);
    for (const TextSegment& segment : text.segments()) digest.add(segment.first, segment.eci);
}

/// Digits, capitals, small letters and bytes in turn.
inline Span<const std::uint8_t> data_matrix_sample(Random& random, int size, Span<std::uint8_t> room) {
    for (int i = 0; i < size; ++i) {
        const int kind = i / 7 % 4;
        room[i] = static_cast<std::uint8_t>(kind == 0   ? random.between('0', '9')
                                            : kind == 1 ? random.between('A', 'Z')
                                            : kind == 2 ? random.between('a', 'z')
                                                        : random.between(0, 255));
    }
    return room.first(size);
}

inline void code_data_matrix_symbols(Workspace& work, Digest& digest) {
    Random random(81);
    for (int index = 0; index < data_matrix_size_count; ++index) {
        const DataMatrixSize& size = data_matrix_sizes[index];
        digest.add(data_matrix_size(size.rows, size.columns) == &size,
                   data_matrix_border(size, index % size.columns, index % size.rows));
        digest.add(size.square(), size.codewords(), size.block_parity(), size.region_rows(),
                   size.region_columns(), size.mapping());
        Arena arena(work.scratch_span());
        const Span<std::uint8_t> room = arena.take<std::uint8_t>(64);
        const auto text = data_matrix_sample(random, random.between(1, minimum(int{size.data}, 40)), room);
        const BitView<BitWord> modules(
            arena.take<BitWord>(std::int64_t{bit_words(size.columns)} * size.rows).data(),
            {size.columns, size.rows}, bit_words(size.columns));
        DataMatrixOptions options;
        options.size = {size.columns, size.rows};
        options.gs1 = index % 3 == 0;
        if (index % 4 == 0) options.eci = 26;
        const Span<std::uint8_t> scratch = arena.take<std::uint8_t>(
            maximum(data_matrix_encode_scratch(text.size()), data_matrix_decode_scratch));
        const Result<Size> made = data_matrix_encode(text, options, scratch, modules);
        digest.add(made.status());
        if (!made) continue;
        for (int y = 0; y < size.rows; ++y)
            for (int i = 0; i < bit_words(size.columns); ++i) digest.add_number(modules.row(y)[i]);
        modules.set(1, 1, !modules(1, 1));
        std::uint8_t bytes[64] = {};
        CodeText told{Span<std::uint8_t>(bytes)};
        const Result<DataMatrixReading> reading = data_matrix_decode(modules, scratch, told);
        digest.add(reading.status());
        put_data_matrix_text(digest, told);
        if (reading)
            digest.add(reading->message.aim_digit, reading->corrected_errors, reading->unused_correction);
        const DataMatrixEncodation encodation(text, false,
                                              scratch.first(data_matrix_encodation_scratch(text.size())));
        std::uint8_t few[24] = {};
        digest.add(encodation.write(0, few));
        for (const std::uint8_t codeword : few) digest.add_byte(codeword);
        const Span<BitWord> words = arena.take<BitWord>(data_matrix_placement_scratch);
        const Span<std::uint8_t> codewords = arena.take<std::uint8_t>(size.codewords());
        digest.add(data_matrix_codewords(modules, size, words, codewords));
        digest.add(data_matrix_modules(codewords, size, words, modules));
        told.clear();
        digest.add(data_matrix_text(codewords.first(size.data), told).status());
        put_data_matrix_text(digest, told);
    }
}

/// A symbol turned and sheared, about three pixels a module, in noise.
inline void code_read_data_matrix(Workspace& work, Digest& digest) {
    Random random(82);
    BitStorage<16, 16> modules;
    for (int turn = 0; turn < 6; ++turn) {
        const std::uint8_t text[] = {'f', 'o', 'v', 'e', 'a', static_cast<std::uint8_t>('0' + turn)};
        DataMatrixOptions made;
        made.size = {16, 16};
        digest.add(
            data_matrix_encode(Span<const std::uint8_t>(text), made, work.scratch_span(), modules.view())
                .status());
        const ImageView<Gray8> image = work.view<Gray8>(0, Workspace::picture_size);
        for (int y = 0; y < image.height(); ++y) {
            for (int x = 0; x < image.width(); ++x) {
                const int u = 80 * (x - 56) + 8 * turn * (y - 38);
                const int v = 80 * (y - 38) - 7 * turn * (x - 56);
                const int column = floor_divide(u, 256) + 8;
                const int row = floor_divide(v, 256) + 8;
                const bool inside = column >= 0 && row >= 0 && column < 16 && row < 16;
                const bool dark = inside && modules.view()(column, row);
                const int level = (dark != (turn % 2 != 0) ? 50 : 190) + random.between(-12, 12);
                image(x, y) = static_cast<Gray8>(level);
            }
        }
        std::uint8_t bytes[32] = {};
        CodeText told{Span<std::uint8_t>(bytes)};
        List<Code, 2> codes;
        ListView<Code> list = codes;
        static_assert(read_data_matrix_scratch(Workspace::picture_size) <=
                          static_cast<std::int64_t>(sizeof(Workspace::scratch)),
                      "the vector needs its scratch");
        digest.add(read_data_matrix(image, {}, work.scratch_span(), told, list));
        put_data_matrix_text(digest, told);
        for (const Code& code : codes) {
            digest.add(code.corrected_errors, code.inverted, code.mirrored, code.grade.overall,
                       code.grade.modulation, code.grade.symbol_contrast);
            for (const SubPixelPoint corner : code.corners) digest.add(corner);
        }
    }
}

}  // namespace fovea::golden
