// SPDX-License-Identifier: MIT
//
// Any bytes as a PNG file, any bytes as compressed picture data with right checksums around them, and any
// bytes as samples that are written and read back.
#include <cstddef>
#include <cstdint>
#include <vector>

#include <fovea/base/crc32.hpp>
#include <fovea/codec/inflate.hpp>
#include <fovea/codec/png_reader.hpp>
#include <fovea/codec/png_writer.hpp>

#include "picture_fuzz.hpp"

namespace {

using namespace fovea;
using Bytes = std::vector<std::uint8_t>;

/// Decodes with exactly the scratch that is needed; and one byte less is too little.
template <class Pixel>
Status decode(Span<const std::uint8_t> file, ImageView<Pixel> dst) {
    const Result<PictureInfo> info = inspect_png(file);
    Bytes scratch(static_cast<std::size_t>(info ? info->scratch_bytes : 0));
    if (info.ok() && info->size == dst.size())
        fuzz::require(decode_png(file, fuzz::room_in(scratch).first(fuzz::room_in(scratch).size() - 1),
                                 dst) == Status::scratch_too_small);
    return decode_png(file, fuzz::room_in(scratch), dst);
}

void put_32(Bytes& to, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) to.push_back(static_cast<std::uint8_t>(value >> shift));
}
void put_chunk(Bytes& to, const char* name, const Bytes& content) {
    put_32(to, static_cast<std::uint32_t>(content.size()));
    const auto start = static_cast<std::ptrdiff_t>(to.size());
    for (int i = 0; i < 4; ++i) to.push_back(static_cast<std::uint8_t>(name[i]));
    to.insert(to.end(), content.begin(), content.end());
    put_32(to, crc32(Span<const std::uint8_t>(fuzz::room_in(to)).from(start)));
}

/// The first bytes choose size, depth and colours; the others are the data, cut into two chunks. The fuzzer
/// would not guess the checksums.
Bytes file_around(Span<const std::uint8_t> bytes) {
    constexpr std::uint8_t kinds[][2] = {{1, 0}, {2, 0}, {4, 0}, {8, 0}, {16, 0}, {8, 2}, {16, 2}, {1, 3},
                                         {2, 3}, {4, 3}, {8, 3}, {8, 4}, {16, 4}, {8, 6}, {16, 6}};
    const std::uint8_t* kind = kinds[bytes[2] % 15];
    Bytes file(Png::signature, Png::signature + 8);
    Bytes header;
    put_32(header, 1u + bytes[0] % 64);
    put_32(header, 1u + bytes[1] % 64);
    header.insert(header.end(), {kind[0], kind[1], 0, 0, 0});
    put_chunk(file, "IHDR", header);
    if (kind[1] == 3) put_chunk(file, "PLTE", {1, 2, 3, 255, 128, 0});
    const std::ptrdiff_t half = 4 + (bytes.size() - 4) * bytes[3] / 256;
    put_chunk(file, "IDAT", Bytes(bytes.begin() + 4, bytes.begin() + half));
    put_chunk(file, "IDAT", Bytes(bytes.begin() + half, bytes.end()));
    put_chunk(file, "IEND", {});
    return file;
}

/// The same compressed data give the same bytes, whether read at once or one by one.
void inflate_in_two_ways(Span<const std::uint8_t> bytes) {
    Bytes scratch(static_cast<std::size_t>(inflate_scratch()));
    Bytes whole(2000);
    OnePiece source(bytes);
    Inflater<OnePiece> inflater(source, fuzz::room_in(scratch));
    const Result<std::ptrdiff_t> read = inflater.read(fuzz::room_in(whole));
    OnePiece again(bytes);
    Inflater<OnePiece> slowly(again, fuzz::room_in(scratch));
    std::ptrdiff_t at = 0;
    Status status = Status::ok;
    for (; at < static_cast<std::ptrdiff_t>(whole.size()); ++at) {
        std::uint8_t byte[1] = {};
        const Result<std::ptrdiff_t> one = slowly.read(byte);
        status = one.status();
        if (!one || *one == 0) break;
        fuzz::require(!read || byte[0] == whole[static_cast<std::size_t>(at)]);
    }
    fuzz::require(status == read.status());
    fuzz::require(!read || at == *read);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t count) {
    const Span<const std::uint8_t> bytes(data, static_cast<std::ptrdiff_t>(count));
    const auto read = [](Span<const std::uint8_t> file, auto dst) { return decode(file, dst); };
    fuzz::decode_into_every_pixel(bytes, inspect_png(bytes), read);
    inflate_in_two_ways(bytes);
    if (bytes.size() >= 4) {
        Bytes file = file_around(bytes);
        const Span<const std::uint8_t> view = fuzz::room_in(file);
        fuzz::decode_into_every_pixel(view, inspect_png(view), read);
    }
    Bytes scratch(static_cast<std::size_t>(png_writer_scratch({})));
    const auto write = [&](auto src, Span<std::uint8_t> out) {
        return encode_png(src, fuzz::room_in(scratch), out);
    };
    fuzz::read_back<Gray8>(bytes, encoded_png_bytes<Gray8>, write, read);
    fuzz::read_back<Rgb888>(bytes, encoded_png_bytes<Rgb888>, write, read);
    return 0;
}
