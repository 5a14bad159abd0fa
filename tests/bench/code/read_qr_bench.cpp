// SPDX-License-Identifier: MIT
#include <utility>
#include <vector>

#include <fovea/code/local_threshold.hpp>
#include <fovea/code/qr_encode.hpp>
#include <fovea/code/read_qr.hpp>

#include <bench/harness.hpp>
#include <bench/pictures.hpp>

namespace fovea::bench {
namespace {

/// What becomes of a text that is read over and over.
struct CodeRoom {
    Bytes text = bytes(4096);
    List<Code, 4> codes;
};

/// A symbol of a version, four pixels a module, in the middle of a gray picture.
Picture<Gray8> qr_picture(Size size, int version) {
    Picture<Gray8> picture(size);
    const ImageView<Gray8> image = picture.view();
    BitStorage<max_qr_size, max_qr_size> storage;
    const std::uint8_t text[] = {'f', 'o', 'v', 'e', 'a'};
    Bytes scratch = bytes(qr_encode_scratch(5));
    QrEncodeOptions options;
    options.min_version = version;
    const auto symbol = qr_encode(Span<const std::uint8_t>(text), options, span_of(scratch), storage.view());
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            const int u = floor_divide(x - size.width / 2, 4) + symbol->width() / 2;
            const int v = floor_divide(y - size.height / 2, 4) + symbol->height() / 2;
            const bool inside = u >= 0 && v >= 0 && u < symbol->width() && v < symbol->height();
            image(x, y) = inside && (*symbol)(u, v) ? 40 : 200;
        }
    }
    return picture;
}
void time_reading(Row& row, Picture<Gray8> picture) {
    auto& src = row.keep(std::move(picture));
    auto& scratch = row.keep(bytes(read_qr_scratch(row.size())));
    auto& room = row.keep(CodeRoom());
    row.ours([&] {
        CodeText text(span_of(room.text));
        room.codes.clear();
        consume(read_qr(src.view(), {}, span_of(scratch), text, room.codes));
    });
}

const bool small_added = add(1900, "read_qr, version 2", Sizes::vga_and_full_hd,
                             [](Row& row) { time_reading(row, qr_picture(row.size(), 2)); });
const bool large_added = add(1901, "read_qr, version 20", Sizes::vga,
                             [](Row& row) { time_reading(row, qr_picture(row.size(), 20)); });
const bool none_added =
    add(1902, "read_qr, no code", Sizes::vga, [](Row& row) { time_reading(row, part(row.size())); });
const bool threshold_added = add(1903, "local_threshold, blocks of 8", Sizes::vga_and_full_hd, [](Row& row) {
    auto& src = row.keep(qr_picture(row.size(), 2));
    auto& words = row.keep(std::vector<BitWord>(static_cast<std::size_t>(bit_words(row.size().width)) *
                                                static_cast<std::size_t>(row.size().height)));
    auto& scratch = row.keep(bytes(local_threshold_scratch(row.size(), 8)));
    const BitView<BitWord> dst(words.data(), row.size(), bit_words(row.size().width));
    row.moves(row.size().area() + row.size().area() / 8);
    row.ours([&, dst] { consume(local_threshold(src.view(), {}, span_of(scratch), dst)); });
});

}  // namespace
}  // namespace fovea::bench
