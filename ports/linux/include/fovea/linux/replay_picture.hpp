// SPDX-License-Identifier: MIT
//
// ReplayPicture: a picture from a file or a pipe in the place of a camera's frame.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/codec/any_picture.hpp>
#include <fovea/hal/frame_source.hpp>
#include <fovea/hal/pixel_format.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>

namespace fovea::linux_port {

/// What came of asking for the next frame.
enum class Taken : std::uint8_t {
    frame,
    nothing,  ///< none is there yet
    silent,   ///< none is there, and nobody who could bring one
    damaged,  ///< one was there and cannot be used
    gone,     ///< one was there and is no more
    failed,   ///< the fault tells
};

/// The memory of a picture, and what every picture has to be.
struct ReplayPicture {
    /// gray8 or rgb24. Brightness is what decode_picture() makes of the file, so that a picture is judged
    /// here as it is by the tool.
    hal::PixelFormat lent = hal::PixelFormat::gray8;
    /// Of every picture; when empty, that of the first one is.
    Size size;
    /// Pixels, and behind them what the decoder of the file needs.
    Span<std::uint8_t> memory;

    /// Decodes a file.
    ///
    /// Errors  all of inspect_picture() and decode_picture(); size_mismatch; buffer_too_small
    Status decode(Span<const std::uint8_t> file, hal::FrameInfo& info) {
        const Result<PictureInfo> found = inspect_picture(file);
        if (!found) return found.status();
        if (!size.empty() && found->size != size) return Status::size_mismatch;
        const bool gray = lent == hal::PixelFormat::gray8;
        const std::int64_t pixels = found->size.area() * (gray ? 1 : 3);
        if (memory.size() < pixels + found->scratch_bytes) return Status::buffer_too_small;
        const Status status =
            gray ? decode_as<Gray8>(file, found->size) : decode_as<Rgb888>(file, found->size);
        if (status != Status::ok) return status;
        size = found->size;
        info.format = lent;
        info.size = size;
        info.planes[0] = {memory.first(pixels), hal::row_bytes(lent, 0, size.width)};
        return Status::ok;
    }

private:
    template <class Pixel>
    Status decode_as(Span<const std::uint8_t> file, Size found) {
        static_assert(alignof(Pixel) == 1, "the memory may begin anywhere");
        const std::int64_t pixels = found.area() * static_cast<std::int64_t>(sizeof(Pixel));
        const ImageView<Pixel> dst(reinterpret_cast<Pixel*>(memory.data()), found,
                                   found.width * static_cast<std::ptrdiff_t>(sizeof(Pixel)));
        return decode_picture(file, memory.from(pixels), dst);
    }
};

}  // namespace fovea::linux_port
