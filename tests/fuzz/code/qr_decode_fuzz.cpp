// SPDX-License-Identifier: MIT
//
// Any modules as a QR code, any data bits in a symbol that is else right, and any text written and read back.
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include <fovea/code/qr_decode.hpp>
#include <fovea/code/qr_encode.hpp>
#include <fovea/code/text_utf8.hpp>

namespace {

using namespace fovea;

void require(bool claim) {
    if (!claim) __builtin_trap();
}

/// Reads a symbol into a room of any size and tells its text; the text is untouched by an error.
Result<QrSymbol> read(BitView<const BitWord> modules, int room, std::vector<std::uint8_t>& bytes) {
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(qr_decode_scratch()));
    bytes.assign(static_cast<std::size_t>(room), 0);
    CodeText text({bytes.data(), room});
    const Result<QrSymbol> symbol =
        qr_decode(modules, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}, text);
    require(symbol.ok() || (text.size() == 0 && text.segments().empty()));
    std::vector<std::uint8_t> utf8(static_cast<std::size_t>(text_utf8_room(text.size())));
    const Result<int> size =
        text_utf8(text, 0, text.size(), {utf8.data(), static_cast<std::ptrdiff_t>(utf8.size())});
    require(size.status() == Status::ok || size.status() == Status::unsupported);
    bytes.resize(static_cast<std::size_t>(text.size()));
    return symbol;
}

void any_modules(const std::uint8_t* data, std::size_t size, BitView<BitWord> modules) {
    for (int y = 0; y < modules.height(); ++y) {
        for (int x = 0; x < modules.width(); ++x) {
            const auto bit = static_cast<std::size_t>(y * modules.width() + x);
            modules.set(x, y, bit / 8 < size && (data[bit / 8] >> bit % 8 & 1) != 0);
        }
    }
    std::vector<std::uint8_t> bytes;
    static_cast<void>(read(modules, 200, bytes));
}
void any_data(const std::uint8_t* data, std::size_t size, int version, BitView<BitWord> modules) {
    const auto level = static_cast<QrLevel>(size % 4);
    const detail::QrBlocks blocks = detail::qr_blocks(version, level);
    std::vector<std::uint8_t> contents(static_cast<std::size_t>(blocks.data_codewords()));
    std::memcpy(contents.data(), data, minimum(size, contents.size()));
    std::vector<std::uint8_t> codewords(static_cast<std::size_t>(detail::qr_codewords(version)));
    require(detail::protect_qr_data(blocks, {contents.data(), static_cast<std::ptrdiff_t>(contents.size())},
                                    {codewords.data(), static_cast<std::ptrdiff_t>(codewords.size())}) ==
            Status::ok);
    detail::draw_qr(version, {level, static_cast<int>(size / 4 % 8)},
                    {codewords.data(), static_cast<std::ptrdiff_t>(codewords.size())}, modules);
    std::vector<std::uint8_t> bytes;
    const Result<QrSymbol> symbol = read(modules, static_cast<int>(size % 8000), bytes);
    require(symbol.ok() || symbol.status() != Status::undecided);
}
void any_text(const std::uint8_t* data, std::size_t size, int version, BitView<BitWord> room) {
    const Span<const std::uint8_t> text(data, static_cast<std::ptrdiff_t>(size));
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(qr_encode_scratch(text.size())));
    QrEncodeOptions options;
    options.min_version = version;
    options.mask = static_cast<int>(size % 8);
    options.level = static_cast<QrLevel>(size / 8 % 4);
    const Result<BitView<BitWord>> symbol =
        qr_encode(text, options, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}, room);
    if (!symbol) return;
    std::vector<std::uint8_t> bytes;
    require(read(*symbol, 8000, bytes).ok() && bytes == std::vector<std::uint8_t>(data, data + size));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 2) return 0;
    // Small symbols more often: large ones take as long as many of them.
    const int version = data[0] < 240 ? data[0] % 6 + 1 : data[0] % max_qr_version + 1;
    BitStorage<max_qr_size, max_qr_size> storage;
    const BitView<BitWord> modules(storage.view().first(), {qr_size(version), qr_size(version)},
                                   storage.view().stride_words());
    if (data[1] % 3 == 0)
        any_modules(data + 2, size - 2, modules);
    else if (data[1] % 3 == 1)
        any_data(data + 2, size - 2, version, modules);
    else
        any_text(data + 2, size - 2, version, storage.view());
    return 0;
}
