// SPDX-License-Identifier: MIT
//
// Any bytes as a BMP file, and any bytes as samples that are written and read back.
#include <cstddef>
#include <cstdint>
#include <vector>

#include <fovea/codec/bmp.hpp>

#include "picture_fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t count) {
    using namespace fovea;
    const Span<const std::uint8_t> bytes(data, static_cast<std::ptrdiff_t>(count));
    const auto decode = [](Span<const std::uint8_t> file, auto dst) { return decode_bmp(file, dst); };
    fuzz::decode_into_every_pixel(bytes, inspect_bmp(bytes), decode);
    const auto encode = [](auto src, Span<std::uint8_t> out) { return encode_bmp(src, out); };
    fuzz::read_back<Gray8>(bytes, encoded_bmp_bytes<Gray8>, encode, decode);
    fuzz::read_back<Rgb888>(bytes, encoded_bmp_bytes<Rgb888>, encode, decode);
    return 0;
}
