// SPDX-License-Identifier: MIT
#include <utility>
#include <vector>

#include <fovea/code/bar_stream.hpp>
#include <fovea/code/ean_encoder.hpp>
#include <fovea/code/read_bars.hpp>

#include <bench/harness.hpp>
#include <bench/pictures.hpp>

namespace fovea::bench {
namespace {

/// An EAN-13 of two pixels a module in the middle, its rows moved to the right by slant / 256 px each.
Picture<Gray8> code_picture(Size size, int slant) {
    Picture<Gray8> picture(size);
    const std::uint8_t digits[] = {'9', '7', '8', '0', '9', '0', '5', '7', '0', '5', '7', '1'};
    List<std::uint8_t, 59> widths;
    consume(encode_ean_13(digits, widths));
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) picture.view()(x, y) = 200;
    for (int y = size.height / 3; y < size.height * 2 / 3; ++y) {
        int at = (size.width / 2 - 95) + (y - size.height / 2) * slant / 256;
        for (int i = 0; i < widths.size(); ++i) {
            for (int k = 0; k < 2 * widths[i]; ++k, ++at)
                if (i % 2 == 0 && at >= 0 && at < size.width) picture.view()(at, y) = 60;
        }
    }
    return picture;
}

struct Reading {
    std::vector<std::uint8_t> scratch;
    std::uint8_t room[64] = {};
    List<Code, 4> codes;

    explicit Reading(Size size) : scratch(static_cast<std::size_t>(read_bars_scratch(size))) {}
    Span<std::uint8_t> span() { return {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}; }
};

void time_read(Row& row, Picture<Gray8> picture) {
    row.not_per_pixel();
    auto& src = row.keep(std::move(picture));
    auto& room = row.keep(Reading(row.size()));
    row.ours([&] {
        CodeText text{Span<std::uint8_t>(room.room)};
        room.codes.clear();
        consume(read_bars(src.view(), ReadBarsOptions(), room.span(), text, room.codes));
    });
}

const bool upright_added =
    add(60, "read bars, EAN-13", Sizes::vga, [](Row& row) { time_read(row, code_picture(row.size(), 0)); });
const bool slanted_added = add(60, "read bars, EAN-13 at 45 degrees", Sizes::vga,
                               [](Row& row) { time_read(row, code_picture(row.size(), 256)); });
const bool none_added =
    add(60, "read bars, none there", Sizes::vga, [](Row& row) { time_read(row, part(row.size())); });

const bool fields_added = add(61, "bar fields", Sizes::vga, [](Row& row) {
    auto& src = row.keep(code_picture(row.size(), 100));
    auto& room = row.keep(Reading(row.size()));
    row.ours([&] {
        List<BarField, 8> fields;
        consume(find_bar_fields(src.view(), room.span(), fields));
    });
});

const bool line_added = add(62, "bar line, slanted, 600 samples", Sizes::vga, [](Row& row) {
    row.not_per_pixel();
    auto& src = row.keep(code_picture(row.size(), 0));
    auto& profile = row.keep(std::vector<std::int16_t>(2000));
    const BarLine line = bar_line_through(row.size(), {SubPixel::from_int(10), SubPixel::from_int(100)},
                                          {SubPixel::from_int(600), SubPixel::from_int(209)}, 0);
    row.ours([&, line] { sample_bar_line(src.view(), line, 1, {profile.data(), 2000}); });
});

const bool stream_added = add(63, "bar stream, a frame of rows", Sizes::vga, [](Row& row) {
    auto& src = row.keep(code_picture(row.size(), 20));
    auto& room = row.keep(Reading(row.size()));
    row.ours([&] {
        BarStream stream(row.size().width, {}, room.span());
        for (int y = 0; y < row.size().height; ++y)
            consume(stream.take({src.view().row(y), row.size().width}));
        CodeText text{Span<std::uint8_t>(room.room)};
        room.codes.clear();
        consume(stream.finish(text, room.codes));
    });
});

}  // namespace
}  // namespace fovea::bench
