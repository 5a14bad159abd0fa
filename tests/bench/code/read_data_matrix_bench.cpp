// SPDX-License-Identifier: MIT
#include <utility>

#include <fovea/code/data_matrix_encode.hpp>
#include <fovea/code/read_data_matrix.hpp>

#include <bench/harness.hpp>
#include <bench/pictures.hpp>

namespace fovea::bench {
namespace {

/// What becomes of a text that is read over and over.
struct DataMatrixRoom {
    Bytes text = bytes(4096);
    List<Code, 4> codes;
};

/// A symbol of that many modules on each side, four pixels each, in the middle of a gray picture.
Picture<Gray8> data_matrix_picture(Size size, int side) {
    Picture<Gray8> picture(size);
    const ImageView<Gray8> image = picture.view();
    BitStorage<max_data_matrix_side, max_data_matrix_side> storage;
    const std::uint8_t text[] = {'f', 'o', 'v', 'e', 'a'};
    Bytes scratch = bytes(data_matrix_encode_scratch(5));
    DataMatrixOptions options;
    options.size = {side, side};
    const auto symbol =
        data_matrix_encode(Span<const std::uint8_t>(text), options, span_of(scratch), storage.view());
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            const int u = floor_divide(x - size.width / 2, 4) + side / 2;
            const int v = floor_divide(y - size.height / 2, 4) + side / 2;
            const bool inside = symbol.ok() && u >= 0 && v >= 0 && u < side && v < side;
            image(x, y) = inside && storage.view()(u, v) ? 40 : 200;
        }
    }
    return picture;
}
void time_reading(Row& row, Picture<Gray8> picture) {
    auto& src = row.keep(std::move(picture));
    auto& scratch = row.keep(bytes(read_data_matrix_scratch(row.size())));
    auto& room = row.keep(DataMatrixRoom());
    row.ours([&] {
        CodeText text(span_of(room.text));
        room.codes.clear();
        ListView<Code> list = room.codes;
        consume(read_data_matrix(src.view(), {}, span_of(scratch), text, list));
    });
}

const bool small_added = add(1910, "read_data_matrix, 20x20", Sizes::vga_and_full_hd,
                             [](Row& row) { time_reading(row, data_matrix_picture(row.size(), 20)); });
const bool large_added = add(1911, "read_data_matrix, 96x96", Sizes::vga,
                             [](Row& row) { time_reading(row, data_matrix_picture(row.size(), 96)); });
const bool none_added =
    add(1912, "read_data_matrix, no code", Sizes::vga, [](Row& row) { time_reading(row, part(row.size())); });

}  // namespace
}  // namespace fovea::bench
