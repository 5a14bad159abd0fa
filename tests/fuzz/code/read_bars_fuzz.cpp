// SPDX-License-Identifier: MIT
//
// Any picture, whole and row by row: the search ends, and what is told lies in the picture and in the text.
#include <cstddef>
#include <cstdint>
#include <vector>

#include <fovea/code/bar_stream.hpp>
#include <fovea/code/read_bars.hpp>

namespace {

using namespace fovea;

void require(bool claim) {
    if (!claim) __builtin_trap();
}

Span<std::uint8_t> span_of(std::vector<std::uint8_t>& bytes) {
    return {bytes.data(), static_cast<std::ptrdiff_t>(bytes.size())};
}

void check(Status status, Size size, const CodeText& text, Span<const Code> codes) {
    require(status == Status::ok || status == Status::not_found || status == Status::undecided ||
            status == Status::capacity_exceeded || status == Status::buffer_too_small);
    require(status != Status::ok || !codes.empty());
    for (const Code& code : codes) {
        require(code.text_first >= 0 && code.text_size > 0 &&
                code.text_first + code.text_size <= text.size());
        require(code.agreeing_lines >= 2);
        for (const SubPixelPoint corner : code.corners) {
            require(corner.x.raw() >= -256 && corner.x.raw() <= 256 * size.width);
            require(corner.y.raw() >= -256 && corner.y.raw() <= 256 * size.height);
        }
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 8) return 0;
    const Size picture_size{1 + data[0] % 128, 1 + data[1] % 64};
    std::vector<Gray8> pixels(static_cast<std::size_t>(picture_size.area()));
    // Columns of the same level and some that differ, so that lines agree.
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const std::size_t x = i % static_cast<std::size_t>(picture_size.width);
        pixels[i] =
            static_cast<Gray8>(data[4 + x % (size - 4)] ^ (data[2] % 4 == 0 ? data[i % size] & 7 : 0));
    }
    const ImageView<const Gray8> image(pixels.data(), picture_size, picture_size.width);
    ReadBarsOptions options;
    options.most_codes = 1 + data[2] % 3;
    options.effort = data[3] % 3;
    options.rules.add_on = data[3] % 2 == 0 ? AddOn::ignored : AddOn::appended;
    options.rules.interleaved_shortest = 2;
    std::uint8_t room[64];
    {
        std::vector<std::uint8_t> scratch(static_cast<std::size_t>(read_bars_scratch(picture_size)));
        CodeText text{Span<std::uint8_t>(room)};
        List<Code, 2> codes;
        const Status status = read_bars(image, options, span_of(scratch), text, codes);
        check(status, picture_size, text, codes.span());
    }
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(bar_stream_scratch(picture_size.width)));
    BarStreamOptions rows;
    rows.rules = options.rules;
    rows.row_step = 1 + data[2] % 2;
    BarStream stream(picture_size.width, rows, span_of(scratch));
    for (int y = 0; y < picture_size.height; ++y) {
        require(stream.take({image.row(y), picture_size.width}) == Status::ok);
    }
    CodeText text{Span<std::uint8_t>(room)};
    List<Code, 2> codes;
    const Status status = stream.finish(text, codes);
    check(status, picture_size, text, codes.span());
    return 0;
}
