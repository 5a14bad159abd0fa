// SPDX-License-Identifier: MIT
//
// Any image, and a symbol with anything drawn over it: nothing is read but what was written.
#include <cstddef>
#include <cstdint>
#include <vector>

#include <fovea/code/data_matrix_encode.hpp>
#include <fovea/code/read_data_matrix.hpp>

namespace {

using namespace fovea;

void require(bool claim) {
    if (!claim) __builtin_trap();
}
template <class T>
Span<T> span_of(std::vector<T>& values) {
    return {values.data(), static_cast<std::ptrdiff_t>(values.size())};
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 4) return 0;
    const Size image_size{data[0] % 96 + 1, data[1] % 96 + 1};
    std::vector<std::uint8_t> pixels(static_cast<std::size_t>(image_size.area()), 220);
    const ImageView<Gray8> image(pixels.data(), image_size, image_size.width);
    const int module = data[2] % 5;
    if (module > 0) {
        BitStorage<max_data_matrix_side, max_data_matrix_side> storage;
        const DataMatrixSize& symbol = data_matrix_sizes[data[3] % data_matrix_size_count];
        DataMatrixOptions options;
        options.size = {symbol.columns, symbol.rows};
        const std::uint8_t text[] = {'f', '1'};
        std::vector<std::uint8_t> scratch(static_cast<std::size_t>(data_matrix_encode_scratch(2)));
        require(data_matrix_encode(Span<const std::uint8_t>(text), options, span_of(scratch), storage.view())
                    .ok());
        for (int y = module; y < image_size.height && y / module - 1 < symbol.rows; ++y)
            for (int x = module; x < image_size.width && x / module - 1 < symbol.columns; ++x)
                if (storage.view()(x / module - 1, y / module - 1)) image(x, y) = 30;
    }
    // Where and what: three bytes a pixel, or the pixels themselves.
    for (std::size_t i = 4; i + 2 < size; i += 3) {
        const auto place = module > 0 ? static_cast<std::size_t>(data[i] | data[i + 1] << 8) : i - 4;
        pixels[place % pixels.size()] = data[i + 2];
        if (module == 0) pixels[(place + 1) % pixels.size()] = data[i + 1];
    }
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(read_data_matrix_scratch(image_size)));
    std::vector<std::uint8_t> room(64);
    CodeText text(span_of(room));
    List<Code, 4> codes;
    ListView<Code> list = codes;
    ReadDataMatrixOptions options;
    options.least_contrast = data[3] % 60 + 4;
    const Status s = read_data_matrix(image, options, span_of(scratch), text, list);
    require(s == Status::ok || codes.empty() || s == Status::capacity_exceeded ||
            s == Status::buffer_too_small);
    for (const Code& code : codes)
        require(code.text_first >= 0 && code.text_size >= 0 &&
                code.text_first + code.text_size <= text.size());
    return 0;
}
