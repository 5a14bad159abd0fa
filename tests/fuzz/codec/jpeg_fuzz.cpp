// SPDX-License-Identifier: MIT
//
// Feeds arbitrary bytes to the JPEG decoder, with memory of exactly the size it asks for.
#include <cstdint>
#include <cstdlib>
#include <vector>

#include <fovea/codec/jpeg.hpp>

namespace {

using fovea::ImageView;
using fovea::Span;
using fovea::Status;

/// Pixels on the heap, without a byte behind them.
template <class Pixel>
Status decode(Span<const std::uint8_t> file, const fovea::PictureInfo& info) {
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(info.scratch_bytes));
    std::vector<Pixel> pixels(static_cast<std::size_t>(info.size.area()));
    const Span<std::uint8_t> room(scratch.data(), static_cast<std::ptrdiff_t>(scratch.size()));
    const std::ptrdiff_t stride = static_cast<std::ptrdiff_t>(sizeof(Pixel)) * info.size.width;
    return fovea::decode_jpeg(file, room, ImageView<Pixel>(pixels.data(), info.size, stride));
}

void expect(bool condition) {
    if (!condition) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr int max_side = 512;
    const std::vector<std::uint8_t> exact(data, data + size);
    const Span<const std::uint8_t> file(exact.data(), static_cast<std::ptrdiff_t>(exact.size()));
    const fovea::Result<fovea::PictureInfo> info = fovea::inspect_jpeg(file);
    if (!info || info->size.width > max_side || info->size.height > max_side) return 0;
    expect(info->scratch_bytes <= fovea::jpeg_scratch(info->size));
    // Either pixel must be judged alike.
    expect(decode<fovea::Gray8>(file, *info) == decode<fovea::Rgb888>(file, *info));
    return 0;
}
