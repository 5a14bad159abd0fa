// SPDX-License-Identifier: MIT
//
// Any modules as a Data Matrix, any data codewords in a symbol that is else right, and any text written and
// read back.
#include <cstddef>
#include <cstdint>
#include <vector>

#include <fovea/code/data_matrix_decode.hpp>
#include <fovea/code/data_matrix_encode.hpp>

namespace {

using namespace fovea;

void require(bool claim) {
    if (!claim) __builtin_trap();
}
template <class T>
Span<T> span_of(std::vector<T>& values) {
    return {values.data(), static_cast<std::ptrdiff_t>(values.size())};
}

/// Reads a symbol into a room of any size; the text is untouched by an error.
Status read(BitView<const BitWord> modules, int room, std::vector<std::uint8_t>& bytes) {
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(data_matrix_decode_scratch));
    bytes.assign(static_cast<std::size_t>(room), 0);
    CodeText text(span_of(bytes));
    const auto reading = data_matrix_decode(modules, span_of(scratch), text);
    require(reading.ok() || (text.size() == 0 && text.segments().empty()));
    bytes.resize(static_cast<std::size_t>(text.size()));
    return reading.status();
}

void any_modules(Span<const std::uint8_t> data, const DataMatrixSize& size, BitView<BitWord> modules) {
    int next = 0;
    for (int y = 0; y < size.rows; ++y) {
        for (int x = 0; x < size.columns; ++x) {
            const DataMatrixModule module = data_matrix_border(size, x, y);
            const bool bit = next / 8 < data.size() && (data[next / 8] >> next % 8 & 1) != 0;
            modules.set(x, y, module == DataMatrixModule::data ? bit : module == DataMatrixModule::dark);
            ++next;
        }
    }
    std::vector<std::uint8_t> bytes;
    static_cast<void>(read(modules, 200, bytes));
}
void any_data(Span<const std::uint8_t> data, const DataMatrixSize& size, BitView<BitWord> modules) {
    std::vector<std::uint8_t> codewords(static_cast<std::size_t>(size.codewords()), 129);
    for (int i = 0; i < size.data && i < data.size(); ++i) codewords[static_cast<std::size_t>(i)] = data[i];
    detail::add_data_matrix_parity(size, span_of(codewords));
    std::vector<BitWord> words(data_matrix_placement_scratch);
    require(data_matrix_modules(span_of(codewords), size, span_of(words), modules) == Status::ok);
    std::vector<std::uint8_t> bytes;
    const Status s = read(modules, static_cast<int>(data.size() % 4000), bytes);
    require(s != Status::undecided && s != Status::not_found);
}
void any_text(Span<const std::uint8_t> text, int index, BitView<BitWord> room) {
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(data_matrix_encode_scratch(text.size())));
    DataMatrixOptions options;
    options.shape = static_cast<DataMatrixShape>(index % 3);
    options.extended = index / 3 % 2 != 0;
    options.gs1 = index / 6 % 2 != 0;
    const Result<Size> size = data_matrix_encode(text, options, span_of(scratch), room);
    if (!size) return;
    std::vector<std::uint8_t> bytes;
    require(read({room.first(), *size, room.stride_words()}, 4000, bytes) == Status::ok);
    require(bytes == std::vector<std::uint8_t>(text.begin(), text.end()));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 2) return 0;
    const int index = data[0] % data_matrix_size_count;
    const DataMatrixSize& symbol = data_matrix_sizes[index];
    BitStorage<max_data_matrix_side, max_data_matrix_side> storage;
    const BitView<BitWord> modules(storage.view().first(), {symbol.columns, symbol.rows},
                                   storage.view().stride_words());
    const Span<const std::uint8_t> rest(data + 2, static_cast<std::ptrdiff_t>(size - 2));
    if (data[1] % 3 == 0)
        any_modules(rest, symbol, modules);
    else if (data[1] % 3 == 1)
        any_data(rest, symbol, modules);
    else
        any_text(rest, data[0], storage.view());
    return 0;
}
