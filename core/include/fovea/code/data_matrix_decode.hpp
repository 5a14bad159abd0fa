// SPDX-License-Identifier: MIT
//
// Data Matrix from its modules: borders tried, errors corrected, text read.
#pragma once

#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/code/code.hpp>
#include <fovea/code/data_matrix_placement.hpp>
#include <fovea/code/data_matrix_sizes.hpp>
#include <fovea/code/data_matrix_text.hpp>
#include <fovea/code/reed_solomon.hpp>
#include <fovea/image/bit_view.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Scratch bytes that data_matrix_decode() needs for symbols of all sizes.
inline constexpr std::int64_t data_matrix_decode_scratch =
    arena_bytes<BitWord>(data_matrix_placement_scratch) + max_data_matrix_codewords;

/// What was read of a symbol besides its text.
struct DataMatrixReading {
    const DataMatrixSize* size = nullptr;
    DataMatrixMessage message;
    int corrected_errors = 0;     ///< codewords
    int unused_correction = 100;  ///< of the block with the most errors: 100 % if it had none
};

/// Reads a symbol, dark modules being 1, and appends its text.
///
/// Shapes   modules of one of data_matrix_sizes, upright, without quiet zone
/// Scratch  data_matrix_decode_scratch bytes, undefined afterwards
/// Errors   empty_image; size_mismatch for no size of a symbol; scratch_too_small; not_found where more than
///          a fifth of the borders is wrong; undecided where errors cannot be corrected; those of
///          data_matrix_text()
/// Source   ISO/IEC 16022, 5.7 and annex E; unused correction as ISO/IEC 15415, 7.8.8
inline Result<DataMatrixReading> data_matrix_decode(BitView<const BitWord> modules,
                                                    Span<std::uint8_t> scratch, CodeText& text);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Modules of borders that are not as they should be, and how many there are.
struct BorderErrors {
    int wrong = 0;
    int all = 0;
};
inline BorderErrors border_errors(BitView<const BitWord> modules, const DataMatrixSize& size) {
    BorderErrors errors;
    visit_borders(size, [&](int x, int y, bool dark) {
        ++errors.all;
        errors.wrong += modules(x, y) != dark ? 1 : 0;
    });
    return errors;
}

/// Corrects the blocks of a symbol, which lie in one another, and puts the data in order again.
inline Status correct_data_matrix(const DataMatrixSize& size, Span<std::uint8_t> codewords,
                                  DataMatrixReading& reading) {
    const int parity = size.block_parity();
    for (int b = 0; b < size.blocks; ++b) {
        std::uint8_t block[max_reed_solomon_block] = {};
        int length = 0;
        for (int i = b; i < size.codewords(); i += size.blocks) block[length++] = codewords[i];
        const Result<int> mended = DataMatrixReedSolomon::decode({block, length}, parity);
        if (!mended) return mended.status();
        reading.corrected_errors += *mended;
        reading.unused_correction =
            minimum(reading.unused_correction, 100 - 100 * *mended / maximum(parity / 2, 1));
        length = 0;
        for (int i = b; i < size.codewords(); i += size.blocks) codewords[i] = block[length++];
    }
    return Status::ok;
}

}  // namespace detail

inline Result<DataMatrixReading> data_matrix_decode(BitView<const BitWord> modules,
                                                    Span<std::uint8_t> scratch, CodeText& text) {
    if (modules.empty()) return Status::empty_image;
    DataMatrixReading reading;
    reading.size = data_matrix_size(modules.height(), modules.width());
    if (reading.size == nullptr) return Status::size_mismatch;
    if (scratch.size() < data_matrix_decode_scratch) return Status::scratch_too_small;
    const detail::BorderErrors borders = detail::border_errors(modules, *reading.size);
    if (borders.wrong * 5 > borders.all) return Status::not_found;
    Arena arena(scratch);
    const Span<BitWord> words = arena.take_unset<BitWord>(data_matrix_placement_scratch);
    const Span<std::uint8_t> codewords = arena.take_unset<std::uint8_t>(reading.size->codewords());
    Status s = data_matrix_codewords(modules, *reading.size, words, codewords);
    if (s == Status::ok) s = detail::correct_data_matrix(*reading.size, codewords, reading);
    if (s != Status::ok) return s;
    const Result<DataMatrixMessage> message = data_matrix_text(codewords.first(reading.size->data), text);
    if (!message) return message.status();
    reading.message = *message;
    return reading;
}

}  // namespace fovea
