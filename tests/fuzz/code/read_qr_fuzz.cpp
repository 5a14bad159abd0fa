// SPDX-License-Identifier: MIT
//
// Any picture, and pictures of symbols that any bytes are laid over: what is read fits its memory, and its
// corners are numbers.
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include <fovea/code/qr_encode.hpp>
#include <fovea/code/read_qr.hpp>

namespace {

using namespace fovea;

void require(bool claim) {
    if (!claim) __builtin_trap();
}

struct Input {
    std::uint8_t width, height, version, scale, turn, shear, effort, room;
};

void draw(const Input& input, std::vector<Gray8>& pixels, Size size) {
    BitStorage<max_qr_size, max_qr_size> storage;
    const std::uint8_t text[3] = {'f', input.scale, input.turn};
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(qr_encode_scratch(3)));
    QrEncodeOptions options;
    options.min_version = input.version % 10 + 1;
    options.mask = input.turn % 8;
    const auto symbol =
        qr_encode(Span<const std::uint8_t>(text), options,
                  {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}, storage.view());
    if (!symbol) return;
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            const int u =
                (x - size.width / 2) * (40 + input.scale) + (y - size.height / 2) * (input.turn - 128);
            const int v =
                (y - size.height / 2) * (40 + input.scale) - (x - size.width / 2) * (input.shear - 128);
            const int column = floor_divide(u + symbol->width() * 128, 256);
            const int row = floor_divide(v + symbol->height() * 128, 256);
            const bool inside = column >= 0 && row >= 0 && column < symbol->width() && row < symbol->height();
            Gray8& pixel = pixels[static_cast<std::size_t>(y * size.width + x)];
            pixel = static_cast<Gray8>((inside && (*symbol)(column, row) ? 20 : 220) + pixel % 16);
        }
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t count) {
    Input input{};
    if (count < sizeof input) return 0;
    std::memcpy(&input, data, sizeof input);
    const Size size{1 + input.width % 160, 1 + input.height % 160};
    std::vector<Gray8> pixels(static_cast<std::size_t>(size.area()));
    const std::uint8_t* rest = data + sizeof input;
    const std::size_t left = count - sizeof input;
    for (std::size_t i = 0; i < pixels.size() && left > 0; ++i) pixels[i] = rest[i % left];
    if (input.version >= 128) draw(input, pixels, size);
    std::vector<std::uint8_t> room(input.room);
    CodeText text({room.data(), static_cast<std::ptrdiff_t>(room.size())});
    List<Code, 2> codes;
    ReadQrOptions options;
    if (input.effort % 4 == 0) options.effort = ReadQrOptions::Effort::quick;
    if (input.effort % 4 == 1) {
        options.effort = ReadQrOptions::Effort::several;
        options.largest_version = 1 + input.effort / 4 % max_qr_version;
    }
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(read_qr_scratch(size, options)));
    const Status status = read_qr(ImageView<const Gray8>(pixels.data(), size, size.width), options,
                                  {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}, text, codes);
    require(status != Status::ok || !codes.empty());
    for (const Code& code : codes) {
        require(code.text_first >= 0 && code.text_size > 0 &&
                code.text_first + code.text_size <= text.size());
        require(code.grade.overall >= 0 && code.grade.overall <= 4);
    }
    return 0;
}
