// SPDX-License-Identifier: MIT
#include <utility>
#include <vector>

#include <fovea/code/ean_encoder.hpp>
#include <fovea/code/read_codes.hpp>
#include <fovea/filter/box.hpp>

#include <bench/harness.hpp>
#include <bench/pictures.hpp>

namespace fovea::bench {
namespace {

/// What becomes of texts that are read over and over.
struct CodesRoom {
    Bytes text = bytes(4096);
    List<Code, 4> codes;
};

/// An EAN-13 with modules of two pixels in the middle of a gray picture, blurred to both sides over so many
/// pixels.
Picture<Gray8> ean_picture(Size size, int blur) {
    const std::uint8_t digits[12] = {'9', '7', '8', '0', '9', '0', '5', '7', '0', '5', '7', '1'};
    List<std::uint8_t, 64> widths;
    consume(encode_ean_13(digits, widths));
    std::vector<int> row(static_cast<std::size_t>(size.width), 200);
    int x = size.width / 2 - 95;
    for (int i = 0; i < widths.size(); ++i) {
        for (int k = 0; k < 2 * widths[i]; ++k, ++x) row[static_cast<std::size_t>(x)] = i % 2 == 0 ? 40 : 200;
    }
    Picture<Gray8> picture(size);
    for (x = 0; x < size.width; ++x) {
        int sum = 0;
        for (int k = -blur; k <= blur; ++k)
            sum += row[static_cast<std::size_t>(clamp(x + k, 0, size.width - 1))];
        for (int y = 0; y < size.height; ++y) {
            const bool bars = y > size.height / 3 && y < size.height * 2 / 3;
            picture.view()(x, y) = static_cast<Gray8>(bars ? sum / (2 * blur + 1) : 200);
        }
    }
    return picture;
}
void time_codes(Row& row, Picture<Gray8> picture, int most_codes) {
    auto& src = row.keep(std::move(picture));
    auto& scratch = row.keep(bytes(read_codes_scratch(row.size())));
    auto& room = row.keep(CodesRoom());
    row.ours([&, most_codes] {
        CodeText text(span_of(room.text));
        room.codes.clear();
        ReadCodesOptions options;
        options.most_codes = most_codes;
        consume(read_codes(src.view(), options, span_of(scratch), text, room.codes));
    });
}

const bool one_added = add(1930, "read_codes, an EAN-13 alone", Sizes::vga,
                           [](Row& row) { time_codes(row, ean_picture(row.size(), 0), 1); });
const bool all_added = add(1931, "read_codes, an EAN-13 and what else there may be", Sizes::vga,
                           [](Row& row) { time_codes(row, ean_picture(row.size(), 0), 4); });
const bool blurred_added = add(1932, "read_blurred_bars, two modules to each side", Sizes::vga, [](Row& row) {
    auto& src = row.keep(ean_picture(row.size(), 4));
    auto& scratch = row.keep(bytes(read_blurred_bars_scratch(row.size())));
    auto& room = row.keep(CodesRoom());
    row.ours([&] {
        CodeText text(span_of(room.text));
        room.codes.clear();
        consume(read_blurred_bars(src.view(), bar_symbologies(), 1, span_of(scratch), text, room.codes));
    });
});

}  // namespace
}  // namespace fovea::bench
