// SPDX-License-Identifier: MIT
//
// What a camera sends as an image to measure in: brightness, or colour.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/codec/jpeg.hpp>
#include <fovea/hal/frame_source.hpp>
#include <fovea/hal/pixel_format.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/image/workers.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/pixelwise/bayer.hpp>
#include <fovea/pixelwise/planes.hpp>
#include <fovea/pixelwise/rgb565.hpp>
#include <fovea/pixelwise/to_gray.hpp>
#include <fovea/pixelwise/yuv.hpp>

namespace fovea::apps {

// ---- Interface --------------------------------------------------------------------

/// Scratch bytes that gray_frame() needs at most for frames of a format and a size, with so many workers.
constexpr std::int64_t gray_frame_scratch(hal::PixelFormat format, Size size, int workers = 1);
/// The same of colour_frame().
constexpr std::int64_t colour_frame_scratch(hal::PixelFormat format, Size size);

/// The brightness of a frame, black 0 and white 255.
///
/// Shapes    the view has the frame's size; it lies in the frame for gray8 and nv12 of the full range, and
///           else in scratch. Rows of the frame may be any number of bytes apart, at any address
/// Units     gray10, gray12 and gray16 are divided by 4, 16 and 256, as narrow() does, and held at 255. Luma
///           of the narrow range is widened. MJPEG is its luma as coded
/// Rounding  nearest, ties up; colours as gray_of()
/// Scratch   gray_frame_scratch(frame.format, frame.size), any alignment; overwritten after an error as well
/// Errors    unsupported for none; empty_image, image_too_large, bad_argument and truncated as view_over()
///           says, bad_argument also for a mosaic of one row or one column; scratch_too_small; of MJPEG all
///           of decode_jpeg(), with size_mismatch for a picture of another size than the frame's. There is no
///           image then: such a frame cannot be judged
/// Source    as demosaic() and to_gray(). A mosaic is turned to colour band by band, and that to gray: its
///           pixels alone, taken as brightness, would show a pattern on every coloured surface
inline Result<ImageView<const Gray8>> gray_frame(const hal::FrameInfo& frame, Span<std::uint8_t> scratch);
/// The same by several workers, see OneWorker, each of whom takes rows; MJPEG is decoded by one.
template <class Workers>
Result<ImageView<const Gray8>> gray_frame(const hal::FrameInfo& frame, Span<std::uint8_t> scratch,
                                          const Workers& workers);

/// The colour of a frame; of the gray formats gray_frame(), without hue. rgb24 stays where it is.
///
/// Scratch  colour_frame_scratch(frame.format, frame.size), as above
/// Others   as gray_frame()
inline Result<ImageView<const Rgb888>> colour_frame(const hal::FrameInfo& frame, Span<std::uint8_t> scratch);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Rows of a mosaic that are turned to colour at a time, with two above them and one below.
inline constexpr int bayer_band = 16;
constexpr std::int64_t bayer_band_bytes(Size size) { return std::int64_t{3} * size.width * (bayer_band + 3); }

constexpr bool is_bayer(hal::PixelFormat format) {
    return format >= hal::PixelFormat::bayer_rggb && format <= hal::PixelFormat::bayer_bggr;
}
constexpr BayerPattern bayer_pattern(hal::PixelFormat format) {
    switch (format) {
        case hal::PixelFormat::bayer_grbg: return BayerPattern::grbg;
        case hal::PixelFormat::bayer_gbrg: return BayerPattern::gbrg;
        case hal::PixelFormat::bayer_bggr: return BayerPattern::bggr;
        default: return BayerPattern::rggb;
    }
}

/// Pixels as cameras send them, at any address.
struct LowByteFirst {
    std::uint8_t low;
    std::uint8_t high;
    constexpr std::uint32_t value() const { return static_cast<std::uint32_t>(high << 8 | low); }
};
struct Bgr888 {
    std::uint8_t blue;
    std::uint8_t green;
    std::uint8_t red;
};

template <class Pixel>
Result<ImageView<const Pixel>> plane_of(const hal::FrameInfo& frame, int plane, Size size) {
    return view_over<const Pixel>(frame.planes[plane].bytes, size, frame.planes[plane].stride_bytes);
}

/// An image at the start of scratch, which keeps the rest.
template <class Pixel>
Result<ImageView<Pixel>> image_in(Span<std::uint8_t>& scratch, Size size) {
    const std::int64_t bytes = size.area() * static_cast<std::int64_t>(sizeof(Pixel));
    if (size.empty()) return Status::empty_image;
    if (size.width > max_image_side || size.height > max_image_side) return Status::image_too_large;
    if (scratch.size() < bytes) return Status::scratch_too_small;
    const auto view =
        view_over<Pixel>(scratch.first(bytes), size, size.width * static_cast<std::ptrdiff_t>(sizeof(Pixel)));
    scratch = scratch.from(bytes);
    return view;
}

/// Those rows of an image.
template <class Pixel>
ImageView<Pixel> rows_of(ImageView<Pixel> image, RowRange rows) {
    return {image.row(rows.first), {image.width(), rows.count()}, image.stride_bytes()};
}

/// Pixels of the first plane, as convert(Packed) makes them. There are as many rows as dst has, from that one
/// on.
template <class Packed, class Pixel, class Convert>
Status unpack(const hal::FrameInfo& frame, int first, ImageView<Pixel> dst, Convert convert) {
    static_assert(alignof(Packed) == 1, "memory of a driver may begin anywhere");
    const auto src = plane_of<Packed>(frame, 0, frame.size);
    if (!src) return src.status();
    for (int y = 0; y < dst.height(); ++y) {
        const Packed* const from = src->row(first + y);
        Pixel* const to = dst.row(y);
        for (int x = 0; x < dst.width(); ++x) to[x] = convert(from[x]);
    }
    return Status::ok;
}

/// An operator on rows of the first plane.
template <class Packed, class Convert>
Status convert_rows(const hal::FrameInfo& frame, RowRange rows, Convert convert) {
    const auto src = plane_of<Packed>(frame, 0, frame.size);
    return src ? convert(rows_of(*src, rows)) : src.status();
}
/// On all of them.
template <class Packed, class Convert>
Status convert_plane(const hal::FrameInfo& frame, Convert convert) {
    return convert_rows<Packed>(frame, {0, frame.size.height}, convert);
}

/// As narrow() does, whatever stands in the bits above.
inline Status shift_to_gray(const hal::FrameInfo& frame, int first, int shift, ImageView<Gray8> dst) {
    return unpack<LowByteFirst>(frame, first, dst, [=](LowByteFirst sample) {
        const std::uint32_t level = (sample.value() + (1u << shift >> 1)) >> shift;
        return static_cast<Gray8>(minimum<std::uint32_t>(level, 255));
    });
}

/// Rows of a mosaic to gray, a band at a time. Bands begin at even rows, so that all have the same pattern;
/// the colours of their outermost rows, which lack a neighbour inside the image, are not used. The first row
/// is an even one.
inline Status mosaic_to_gray(ImageView<const Gray8> src, BayerPattern pattern, RowRange rows,
                             Span<std::uint8_t> scratch, ImageView<Gray8> dst) {
    if (scratch.size() < bayer_band_bytes(src.size())) return Status::scratch_too_small;
    for (int top = rows.first; top < rows.end; top += bayer_band) {
        const int bottom = minimum(top + bayer_band, rows.end);
        const int first = maximum(top - 2, 0);
        const int end = minimum(bottom + 1, src.height());
        const Size band_size{src.width(), end - first};
        const auto band = src.crop({0, first, band_size.width, band_size.height});
        Span<std::uint8_t> room = scratch;
        const auto colours = image_in<Rgb888>(room, band_size);
        if (!band || !colours) return Status::bad_argument;
        if (const Status s = demosaic(*band, pattern, *colours); s != Status::ok) return s;
        const ImageView<const Rgb888> wanted(colours->row(top - first), {src.width(), bottom - top},
                                             colours->stride_bytes());
        const ImageView<Gray8> out(dst.row(top), wanted.size(), dst.stride_bytes());
        if (const Status s = to_gray(wanted, out); s != Status::ok) return s;
    }
    return Status::ok;
}

inline YuvRange range_of(const hal::FrameInfo& frame) {
    return frame.narrow_range ? YuvRange::narrow : YuvRange::full;
}

/// Rows of a frame that is not compressed. dst holds those rows alone.
inline Status gray_rows(const hal::FrameInfo& frame, RowRange rows, ImageView<Gray8> dst) {
    using hal::PixelFormat;
    const YuvRange range = range_of(frame);
    switch (frame.format) {
        case PixelFormat::gray8:
        case PixelFormat::nv12:
            return convert_rows<Gray8>(frame, rows, [=](auto src) { return to_gray(src, range, dst); });
        case PixelFormat::gray10: return shift_to_gray(frame, rows.first, 2, dst);
        case PixelFormat::gray12: return shift_to_gray(frame, rows.first, 4, dst);
        case PixelFormat::gray16: return shift_to_gray(frame, rows.first, 8, dst);
        case PixelFormat::yuyv:
            return convert_rows<Yuyv>(frame, rows, [=](auto src) { return to_gray(src, range, dst); });
        case PixelFormat::uyvy:
            return convert_rows<Uyvy>(frame, rows, [=](auto src) { return to_gray(src, range, dst); });
        case PixelFormat::rgb24:
            return convert_rows<Rgb888>(frame, rows, [=](auto src) { return to_gray(src, dst); });
        case PixelFormat::bgr24:
            return unpack<Bgr888>(frame, rows.first, dst, [](Bgr888 p) {
                return gray_of({p.red, p.green, p.blue});
            });
        case PixelFormat::rgb565:
            return unpack<LowByteFirst>(frame, rows.first, dst, [](LowByteFirst p) {
                return gray_of(rgb_of_rgb565(static_cast<Rgb565>(p.value())));
            });
        default: return Status::unsupported;
    }
}

template <class Workers>
Status fill_gray(const hal::FrameInfo& frame, Span<std::uint8_t> scratch, ImageView<Gray8> dst,
                 const Workers& workers) {
    if (compressed(frame.format)) return decode_jpeg(frame.planes[0].bytes, scratch, dst);
    if (!is_bayer(frame.format))
        return run_rows(workers, frame.size.height,
                        [&](RowRange rows, int) { return gray_rows(frame, rows, rows_of(dst, rows)); });
    const Result<ImageView<const Gray8>> src = plane_of<Gray8>(frame, 0, frame.size);
    if (!src) return src.status();
    const std::int64_t each = bayer_band_bytes(frame.size);
    if (scratch.size() < workers.count() * each) return Status::scratch_too_small;
    return run_rows(workers, frame.size.height, [&](RowRange rows, int worker) {
        return mosaic_to_gray(*src, bayer_pattern(frame.format), rows, scratch.from(worker * each), dst);
    });
}

inline Status fill_colour(const hal::FrameInfo& frame, Span<std::uint8_t> scratch, ImageView<Rgb888> dst) {
    using hal::PixelFormat;
    const YuvRange range = range_of(frame);
    switch (frame.format) {
        case PixelFormat::yuyv:
            return convert_plane<Yuyv>(frame, [=](auto src) { return to_rgb(src, range, dst); });
        case PixelFormat::uyvy:
            return convert_plane<Uyvy>(frame, [=](auto src) { return to_rgb(src, range, dst); });
        case PixelFormat::bgr24:
            return unpack<Bgr888>(frame, 0, dst, [](Bgr888 p) { return Rgb888{p.red, p.green, p.blue}; });
        case PixelFormat::nv12: {
            const auto chroma = plane_of<ChromaPair>(frame, 1, chroma_size(frame.size));
            if (!chroma) return chroma.status();
            return convert_plane<Gray8>(frame, [=](auto src) { return to_rgb(src, *chroma, range, dst); });
        }
        case PixelFormat::rgb565:
            return unpack<LowByteFirst>(
                frame, 0, dst, [](LowByteFirst p) { return rgb_of_rgb565(static_cast<Rgb565>(p.value())); });
        case PixelFormat::bayer_rggb:
        case PixelFormat::bayer_grbg:
        case PixelFormat::bayer_gbrg:
        case PixelFormat::bayer_bggr:
            return convert_plane<Gray8>(
                frame, [=](auto src) { return demosaic(src, bayer_pattern(frame.format), dst); });
        case PixelFormat::mjpeg: return decode_jpeg(frame.planes[0].bytes, scratch, dst);
        default: break;
    }
    const Result<ImageView<const Gray8>> gray = gray_frame(frame, scratch);
    return gray ? to_rgb(*gray, dst) : gray.status();
}

}  // namespace detail

constexpr std::int64_t gray_frame_scratch(hal::PixelFormat format, Size size, int workers) {
    if (format == hal::PixelFormat::none || size.empty()) return 0;
    const std::int64_t behind = detail::is_bayer(format) ? workers * detail::bayer_band_bytes(size)
                                : compressed(format)     ? jpeg_scratch(size)
                                                         : 0;
    return size.area() + behind;
}

constexpr std::int64_t colour_frame_scratch(hal::PixelFormat format, Size size) {
    if (format == hal::PixelFormat::none || format == hal::PixelFormat::rgb24 || size.empty()) return 0;
    const std::int64_t behind = !coloured(format)    ? gray_frame_scratch(format, size)
                                : compressed(format) ? jpeg_scratch(size)
                                                     : 0;
    return 3 * size.area() + behind;
}

template <class Workers>
Result<ImageView<const Gray8>> gray_frame(const hal::FrameInfo& frame, Span<std::uint8_t> scratch,
                                          const Workers& workers) {
    const bool luma_plane = frame.format == hal::PixelFormat::gray8 || frame.format == hal::PixelFormat::nv12;
    if (luma_plane && !frame.narrow_range) return detail::plane_of<Gray8>(frame, 0, frame.size);
    const Result<ImageView<Gray8>> dst = detail::image_in<Gray8>(scratch, frame.size);
    if (!dst) return dst.status();
    if (const Status s = detail::fill_gray(frame, scratch, *dst, workers); s != Status::ok) return s;
    return ImageView<const Gray8>(*dst);
}

inline Result<ImageView<const Gray8>> gray_frame(const hal::FrameInfo& frame, Span<std::uint8_t> scratch) {
    return gray_frame(frame, scratch, OneWorker());
}

inline Result<ImageView<const Rgb888>> colour_frame(const hal::FrameInfo& frame, Span<std::uint8_t> scratch) {
    if (frame.format == hal::PixelFormat::rgb24) return detail::plane_of<Rgb888>(frame, 0, frame.size);
    const Result<ImageView<Rgb888>> dst = detail::image_in<Rgb888>(scratch, frame.size);
    if (!dst) return dst.status();
    if (const Status s = detail::fill_colour(frame, scratch, *dst); s != Status::ok) return s;
    return ImageView<const Rgb888>(*dst);
}

}  // namespace fovea::apps
