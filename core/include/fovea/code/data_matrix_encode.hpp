// SPDX-License-Identifier: MIT
//
// Data Matrix symbols made of text: the smallest one that holds it, or one of a size asked for.
#pragma once

#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/code/code.hpp>
#include <fovea/code/data_matrix_encodation.hpp>
#include <fovea/code/data_matrix_placement.hpp>
#include <fovea/code/data_matrix_sizes.hpp>
#include <fovea/code/reed_solomon.hpp>
#include <fovea/image/bit_view.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

enum class DataMatrixShape : std::uint8_t { square, rectangle, any };

struct DataMatrixOptions {
    /// Of the symbols that hold the text that with the fewest codewords is taken.
    DataMatrixShape shape = DataMatrixShape::square;
    /// A size of data_matrix_sizes, whatever shape says; 0x0 for the smallest.
    Size size;
    /// Also the rectangles of ISO/IEC 21471, which older readers do not know.
    bool extended = false;
    /// Begins with FNC1: the text is GS1 element strings, GS (29) behind those of open length.
    bool gs1 = false;
    /// What the bytes mean, told in the symbol: 0 to 999999, or not_stated.
    int eci = TextSegment::not_stated;
};

/// Scratch bytes that data_matrix_encode() needs for a text of that many bytes.
constexpr std::int64_t data_matrix_encode_scratch(std::int64_t text_bytes) {
    return data_matrix_encodation_scratch(text_bytes) + max_data_matrix_codewords +
           arena_bytes<BitWord>(data_matrix_placement_scratch);
}

/// Writes the modules of a symbol, dark being 1, into the upper left of a binary image and answers their
/// size. The quiet zone, a module on each side, is the caller's.
///
/// Shapes   text 1 to max_data_matrix_text bytes; modules as large as the symbol or larger
/// Scratch  data_matrix_encode_scratch(text.size()) bytes, undefined afterwards
/// Time     bounded by 16 times the bytes and 48 sizes
/// Errors   empty_image; bad_argument for no text, no such size or no such ECI; scratch_too_small;
///          capacity_exceeded where no symbol allowed holds the text; buffer_too_small for modules
/// Source   ISO/IEC 16022, 5.2, 5.7 and annexes B, E and F
inline Result<Size> data_matrix_encode(Span<const std::uint8_t> text, const DataMatrixOptions& options,
                                       Span<std::uint8_t> scratch, BitView<BitWord> modules);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

constexpr bool data_matrix_allowed(const DataMatrixOptions& options, int index) {
    const DataMatrixSize& size = data_matrix_sizes[index];
    if (!options.size.empty()) return Size{size.columns, size.rows} == options.size;
    if (index >= data_matrix_plain_sizes && !options.extended) return false;
    return options.shape == DataMatrixShape::any ||
           size.square() == (options.shape == DataMatrixShape::square);
}

/// FNC1 and ECI; how many codewords.
constexpr int data_matrix_head(const DataMatrixOptions& options, std::uint8_t (&head)[5]) {
    int count = 0;
    const auto put = [&](int codeword) { head[count++] = static_cast<std::uint8_t>(codeword); };
    if (options.gs1) put(data_matrix::fnc1);
    const int eci = options.eci;
    if (eci == TextSegment::not_stated) return count;
    put(data_matrix::eci);
    // ISO/IEC 16022, 5.4.1, table 6.
    if (eci < 127) {
        put(eci + 1);
    } else if (eci < 16383) {
        put((eci - 127) / 254 + 128);
        put((eci - 127) % 254 + 1);
    } else {
        put((eci - 16383) / 64516 + 192);
        put((eci - 16383) / 254 % 254 + 1);
        put((eci - 16383) % 254 + 1);
    }
    return count;
}

inline void add_data_matrix_parity(const DataMatrixSize& size, Span<std::uint8_t> codewords) {
    for (int b = 0; b < size.blocks; ++b) {
        std::uint8_t data[max_reed_solomon_block] = {};
        std::uint8_t parity[max_reed_solomon_parity] = {};
        int length = 0;
        int i = b;
        for (; i < size.data; i += size.blocks) data[length++] = codewords[i];
        const Status s = DataMatrixReedSolomon::encode({data, length}, {parity, size.block_parity()});
        FOVEA_ASSERT(s == Status::ok);
        static_cast<void>(s);
        for (int k = 0; i < size.codewords(); i += size.blocks) codewords[i] = parity[k++];
    }
}

}  // namespace detail

inline Result<Size> data_matrix_encode(Span<const std::uint8_t> text, const DataMatrixOptions& options,
                                       Span<std::uint8_t> scratch, BitView<BitWord> modules) {
    if (modules.empty()) return Status::empty_image;
    const bool size_known =
        options.size == Size{} || data_matrix_size(options.size.height, options.size.width) != nullptr;
    if (text.empty() || !size_known || options.eci < TextSegment::not_stated || options.eci > 999999)
        return Status::bad_argument;
    if (text.size() > max_data_matrix_text) return Status::capacity_exceeded;
    if (scratch.size() < data_matrix_encode_scratch(text.size())) return Status::scratch_too_small;
    Arena arena(scratch);
    const Span<std::uint8_t> ways =
        arena.take_unset<std::uint8_t>(data_matrix_encodation_scratch(text.size()));
    const Span<std::uint8_t> codewords = arena.take_unset<std::uint8_t>(max_data_matrix_codewords);
    const Span<BitWord> words = arena.take_unset<BitWord>(data_matrix_placement_scratch);
    std::uint8_t head[5] = {};
    const int head_size = detail::data_matrix_head(options, head);
    const DataMatrixEncodation encodation(text, options.gs1, ways);
    // By codewords; of equal ones the square, which stands first.
    int tried = -1;
    while (true) {
        int next = -1;
        for (int i = 0; i < data_matrix_size_count; ++i) {
            if (!detail::data_matrix_allowed(options, i)) continue;
            const auto rank = [](int index) { return data_matrix_sizes[index].data * 64 + index; };
            if (tried >= 0 && rank(i) <= rank(tried)) continue;
            if (next < 0 || rank(i) < rank(next)) next = i;
        }
        if (next < 0) return Status::capacity_exceeded;
        tried = next;
        const DataMatrixSize& size = data_matrix_sizes[next];
        if (head_size >= size.data) continue;
        for (int i = 0; i < head_size; ++i) codewords[i] = head[i];
        if (encodation.write(head_size, codewords.first(size.data)) != Status::ok) continue;
        if (modules.width() < size.columns || modules.height() < size.rows) return Status::buffer_too_small;
        detail::add_data_matrix_parity(size, codewords);
        const Size answer{size.columns, size.rows};
        const Status s =
            data_matrix_modules(codewords, size, words, {modules.first(), answer, modules.stride_words()});
        if (s != Status::ok) return s;
        return answer;
    }
}

}  // namespace fovea
