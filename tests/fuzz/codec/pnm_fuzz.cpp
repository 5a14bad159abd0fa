// SPDX-License-Identifier: MIT
//
// Any bytes as a PNM file, and any bytes as samples that are written and read back.
#include <cstddef>
#include <cstdint>
#include <vector>

#include <fovea/codec/pnm.hpp>

#include "picture_fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t count) {
    using namespace fovea;
    const Span<const std::uint8_t> bytes(data, static_cast<std::ptrdiff_t>(count));
    const auto decode = [](Span<const std::uint8_t> file, auto dst) { return decode_pnm(file, dst); };
    fuzz::decode_into_every_pixel(bytes, inspect_pnm(bytes), decode);
    const auto encode = [](auto src, Span<std::uint8_t> out) { return encode_pnm(src, out); };
    fuzz::read_back<Gray8>(bytes, encoded_pnm_bytes<Gray8>, encode, decode);
    fuzz::read_back<Gray16>(bytes, encoded_pnm_bytes<Gray16>, encode, decode);
    fuzz::read_back<Rgb888>(bytes, encoded_pnm_bytes<Rgb888>, encode, decode);
    return 0;
}
