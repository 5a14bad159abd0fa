// SPDX-License-Identifier: MIT
//
// BMP: uncompressed pictures of Windows and OS/2.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/codec/picture.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// What a BMP file holds. Its headers and its palette are looked at.
///
/// Shapes  sides 1..max_image_side; rows from the bottom up or from the top down
/// Units   gray8 for a palette of grays, rgb888 for any other palette and for 24 and 32 bits
/// Errors  truncated when headers or palette end early; malformed, also for a palette of more than 256
///         colours or one that reaches into the pixels; image_too_large; unsupported for 1, 2, 4 and 16 bits,
///         for all compressions, and for colour masks that are not 8 bits wide
/// Source  Microsoft, "Bitmap Storage": BITMAPCOREHEADER, BITMAPINFOHEADER, BITMAPV4HEADER, BITMAPV5HEADER;
///         the headers of 16 and 64 bytes are OS/2 2.x
inline Result<PictureInfo> inspect_bmp(Span<const std::uint8_t> bytes);

/// The picture of a BMP file.
///
/// Shapes    dst as large as the picture
/// Units     colours as they stand, the fourth byte of 32 bits (alpha) is ignored
/// Rounding  brightness of colours as gray_of()
/// Errors    empty_image, all of inspect_bmp(), size_mismatch, truncated when pixels are missing, malformed
///           for a pixel without a colour in the palette; all found before the first pixel is written
/// Source    as inspect_bmp(). The stated lengths of file and pixels are not read: writers disagree on them
template <class Pixel>
Status decode_bmp(Span<const std::uint8_t> bytes, ImageView<Pixel> dst);

/// The exact length of the file that encode_bmp() writes.
template <class Pixel>
constexpr std::int64_t encoded_bmp_bytes(Size size);

/// Writes a BMP file and answers its length: rows from the bottom up, 8 bits with a palette of 256 grays for
/// Gray8, 24 bits for Rgb888.
///
/// Shapes  sides 1..max_image_side
/// Errors  empty_image, image_too_large, buffer_too_small below encoded_bmp_bytes(); out is untouched then
/// Source  as inspect_bmp(); BITMAPINFOHEADER
inline Result<std::ptrdiff_t> encode_bmp(ImageView<const Gray8> src, Span<std::uint8_t> out);
inline Result<std::ptrdiff_t> encode_bmp(ImageView<const Rgb888> src, Span<std::uint8_t> out);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

inline constexpr int bmp_file_header_bytes = 14;
inline constexpr int bmp_core_header_bytes = 12;
inline constexpr int bmp_info_header_bytes = 40;

struct BmpHeader {
    Size size;
    bool top_down = false;
    int bits = 0;          ///< of a pixel: 8, 24 or 32
    int colours = 0;       ///< in the palette
    int colour_bytes = 4;  ///< of an entry of the palette
    std::ptrdiff_t palette = 0;
    std::int64_t raster = 0;
    int shifts[3] = {16, 8, 0};  ///< of red, green and blue in 32 bits

    /// Rows are padded to four bytes. At most 131068.
    constexpr std::ptrdiff_t stride_bytes() const {
        return (std::ptrdiff_t{size.width} * bits + 31) / 32 * 4;
    }
};

constexpr std::uint32_t bmp_16(const std::uint8_t* at) {
    return static_cast<std::uint32_t>(at[0] | at[1] << 8);
}
constexpr std::uint32_t bmp_32(const std::uint8_t* at) { return bmp_16(at) | bmp_16(at + 2) << 16; }

/// An entry of the palette, or a pixel of 24 bits: blue comes first.
constexpr Rgb888 bmp_colour(const std::uint8_t* at) { return {at[2], at[1], at[0]}; }

/// Width and height; a negative height says that the first row is the uppermost.
inline Status read_bmp_size(const std::uint8_t* info, bool core, BmpHeader& header) {
    std::uint32_t width = core ? bmp_16(info + 4) : bmp_32(info + 4);
    std::uint32_t height = core ? bmp_16(info + 6) : bmp_32(info + 8);
    if (!core) {
        if (static_cast<std::int32_t>(width) < 0) return Status::malformed;
        header.top_down = static_cast<std::int32_t>(height) < 0;
        height = magnitude(static_cast<std::int32_t>(height));
    }
    if (width == 0 || height == 0) return Status::malformed;
    if (width > max_image_side || height > max_image_side) return Status::image_too_large;
    header.size = {static_cast<int>(width), static_cast<int>(height)};
    return Status::ok;
}

/// The places of the three colours in 32 bits; each must be 8 bits in a row.
inline Status read_bmp_masks(const std::uint8_t* masks, BmpHeader& header) {
    for (int i = 0; i < 3; ++i) {
        const std::uint32_t mask = bmp_32(masks + 4 * i);
        int shift = 0;
        while (shift < 24 && (mask >> shift & 1) == 0) ++shift;
        if (mask != std::uint32_t{0xff} << shift) return Status::unsupported;
        header.shifts[i] = shift;
    }
    return Status::ok;
}

inline Status read_bmp_palette(Span<const std::uint8_t> bytes, std::uint32_t colours, BmpHeader& header) {
    if (colours > 256) return Status::malformed;
    header.colours = colours == 0 ? 256 : static_cast<int>(colours);
    const std::ptrdiff_t end = header.palette + header.colours * header.colour_bytes;
    if (end > header.raster) return Status::malformed;
    return end > bytes.size() ? Status::truncated : Status::ok;
}

/// The lengths of OS/2 1.x and 2.x, Windows 3, and its versions 2 to 5.
constexpr bool is_bmp_info_length(std::uint32_t length) {
    switch (length) {
        case 12:
        case 16:
        case 40:
        case 52:
        case 56:
        case 64:
        case 108:
        case 124: return true;
        default: return false;
    }
}

/// The length of the header behind the file header, whole in bytes.
inline Result<std::uint32_t> bmp_info_length(Span<const std::uint8_t> bytes) {
    constexpr std::uint8_t signature[] = {'B', 'M'};
    for (int i = 0; i < 2; ++i) {
        if (bytes.size() <= i) return Status::truncated;
        if (bytes[i] != signature[i]) return Status::malformed;
    }
    if (bytes.size() < bmp_file_header_bytes + 4) return Status::truncated;
    const std::uint32_t length = bmp_32(bytes.data() + bmp_file_header_bytes);
    if (length < bmp_core_header_bytes) return Status::malformed;
    if (!is_bmp_info_length(length)) return Status::unsupported;
    if (bytes.size() - bmp_file_header_bytes < static_cast<std::ptrdiff_t>(length)) return Status::truncated;
    return length;
}

inline Result<BmpHeader> bmp_header(Span<const std::uint8_t> bytes) {
    const Result<std::uint32_t> length = bmp_info_length(bytes);
    if (!length) return length.status();
    const std::uint8_t* info = bytes.data() + bmp_file_header_bytes;
    std::ptrdiff_t end = bmp_file_header_bytes + static_cast<std::ptrdiff_t>(*length);
    const bool core = *length == bmp_core_header_bytes;
    const bool full = *length >= bmp_info_header_bytes;

    BmpHeader header;
    if (Status s = read_bmp_size(info, core, header); s != Status::ok) return s;
    if (bmp_16(info + (core ? 8 : 12)) != 1) return Status::malformed;
    header.bits = static_cast<int>(bmp_16(info + (core ? 10 : 14)));
    if (header.bits != 8 && header.bits != 24 && header.bits != 32) return Status::unsupported;
    const std::uint32_t compression = full ? bmp_32(info + 16) : 0;
    if (compression == 3 && header.bits == 32 && *length != 64) {
        // The masks stand at the same place, be it behind the header or in its later versions.
        end = maximum<std::ptrdiff_t>(end, bmp_file_header_bytes + 52);
        if (bytes.size() < end) return Status::truncated;
        if (Status s = read_bmp_masks(info + 40, header); s != Status::ok) return s;
    } else if (compression != 0) {
        return Status::unsupported;
    }

    header.raster = bmp_32(bytes.data() + 10);
    if (header.raster < end) return Status::malformed;
    header.palette = end;
    header.colour_bytes = core ? 3 : 4;
    if (header.bits == 8)
        if (Status s = read_bmp_palette(bytes, full ? bmp_32(info + 32) : 0, header); s != Status::ok)
            return s;
    return header;
}

/// Whether every pixel has its colour in the palette.
inline bool bmp_pixels_fit(const BmpHeader& header, const std::uint8_t* raster) {
    if (header.colours == 256) return true;
    int highest = 0;
    for (int y = 0; y < header.size.height; ++y, raster += header.stride_bytes())
        for (int x = 0; x < header.size.width; ++x) highest = maximum<int>(highest, raster[x]);
    return highest < header.colours;
}

template <class Pixel>
void bmp_palette_rows(const BmpHeader& header, const std::uint8_t* colours, const std::uint8_t* raster,
                      ImageView<Pixel> dst) {
    Pixel palette[256] = {};
    for (int i = 0; i < header.colours; ++i)
        palette[i] = pixel_of_colour<Pixel>(bmp_colour(colours + i * header.colour_bytes));
    for (int i = 0; i < dst.height(); ++i, raster += header.stride_bytes()) {
        Pixel* to = dst.row(header.top_down ? i : dst.height() - 1 - i);
        for (int x = 0; x < dst.width(); ++x) to[x] = palette[raster[x]];
    }
}

template <class Pixel>
void bmp_colour_rows(const BmpHeader& header, const std::uint8_t* raster, ImageView<Pixel> dst) {
    for (int i = 0; i < dst.height(); ++i, raster += header.stride_bytes()) {
        Pixel* to = dst.row(header.top_down ? i : dst.height() - 1 - i);
        if (header.bits == 24) {
            for (int x = 0; x < dst.width(); ++x) to[x] = pixel_of_colour<Pixel>(bmp_colour(raster + 3 * x));
            continue;
        }
        for (int x = 0; x < dst.width(); ++x) {
            const std::uint32_t whole = bmp_32(raster + 4 * x);
            to[x] = pixel_of_colour<Pixel>({static_cast<std::uint8_t>(whole >> header.shifts[0] & 0xff),
                                            static_cast<std::uint8_t>(whole >> header.shifts[1] & 0xff),
                                            static_cast<std::uint8_t>(whole >> header.shifts[2] & 0xff)});
        }
    }
}

inline std::uint8_t* put_bmp(std::uint8_t* at, std::uint32_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) *at++ = static_cast<std::uint8_t>(value >> 8 * i & 0xff);
    return at;
}

template <class Pixel>
constexpr std::ptrdiff_t encoded_bmp_stride(int width) {
    return (width * static_cast<std::ptrdiff_t>(sizeof(Pixel)) + 3) / 4 * 4;
}
template <class Pixel>
constexpr std::int64_t encoded_bmp_raster() {
    return bmp_file_header_bytes + bmp_info_header_bytes + (sizeof(Pixel) == 1 ? 256 * 4 : 0);
}

template <class Pixel>
std::uint8_t* put_bmp_headers(std::uint8_t* to, Size size) {
    *to++ = 'B';
    *to++ = 'M';
    // At most 32767 rows of 98304 bytes, which 32 bits hold.
    to = put_bmp(to, static_cast<std::uint32_t>(encoded_bmp_bytes<Pixel>(size)), 4);
    to = put_bmp(to, 0, 4);
    to = put_bmp(to, static_cast<std::uint32_t>(encoded_bmp_raster<Pixel>()), 4);
    to = put_bmp(to, bmp_info_header_bytes, 4);
    to = put_bmp(to, static_cast<std::uint32_t>(size.width), 4);
    to = put_bmp(to, static_cast<std::uint32_t>(size.height), 4);
    to = put_bmp(to, 1, 2);
    to = put_bmp(to, sizeof(Pixel) * 8, 2);
    // No compression; lengths, resolution and numbers of colours may be left to the reader.
    for (int i = 0; i < 6; ++i) to = put_bmp(to, 0, 4);
    if constexpr (sizeof(Pixel) == 1)
        for (std::uint32_t level = 0; level < 256; ++level) to = put_bmp(to, level * 0x010101, 4);
    return to;
}

template <class Pixel>
Result<std::ptrdiff_t> encode_bmp_frame(ImageView<const Pixel> src, Span<std::uint8_t> out) {
    if (src.empty()) return Status::empty_image;
    if (src.width() > max_image_side || src.height() > max_image_side) return Status::image_too_large;
    if (out.size() < encoded_bmp_bytes<Pixel>(src.size())) return Status::buffer_too_small;
    std::uint8_t* to = put_bmp_headers<Pixel>(out.data(), src.size());
    for (int y = src.height() - 1; y >= 0; --y) {
        const Pixel* row = src.row(y);
        std::uint8_t* end = to + encoded_bmp_stride<Pixel>(src.width());
        for (int x = 0; x < src.width(); ++x) {
            if constexpr (std::is_same_v<Pixel, Rgb888>) {
                *to++ = row[x].blue;
                *to++ = row[x].green;
                *to++ = row[x].red;
            } else {
                *to++ = row[x];
            }
        }
        while (to < end) *to++ = 0;
    }
    return to - out.data();
}

}  // namespace detail

inline Result<PictureInfo> inspect_bmp(Span<const std::uint8_t> bytes) {
    const Result<detail::BmpHeader> header = detail::bmp_header(bytes);
    if (!header) return header.status();
    PictureInfo info;
    info.size = header->size;
    info.content = header->bits == 8 ? PictureContent::gray8 : PictureContent::rgb888;
    for (int i = 0; i < header->colours; ++i) {
        const Rgb888 colour = detail::bmp_colour(bytes.data() + header->palette + i * header->colour_bytes);
        if (colour.red != colour.green || colour.green != colour.blue) info.content = PictureContent::rgb888;
    }
    return info;
}

template <class Pixel>
Status decode_bmp(Span<const std::uint8_t> bytes, ImageView<Pixel> dst) {
    static_assert(
        std::is_same_v<Pixel, Gray8> || std::is_same_v<Pixel, Gray16> || std::is_same_v<Pixel, Rgb888>,
        "a picture is decoded into Gray8, Gray16 or Rgb888");
    if (dst.empty()) return Status::empty_image;
    const Result<detail::BmpHeader> header = detail::bmp_header(bytes);
    if (!header) return header.status();
    if (dst.size() != header->size) return Status::size_mismatch;
    if (bytes.size() - header->raster < std::int64_t{header->stride_bytes()} * dst.height())
        return Status::truncated;
    const std::uint8_t* raster = bytes.data() + header->raster;
    if (header->bits != 8) {
        detail::bmp_colour_rows(*header, raster, dst);
        return Status::ok;
    }
    if (!detail::bmp_pixels_fit(*header, raster)) return Status::malformed;
    detail::bmp_palette_rows(*header, bytes.data() + header->palette, raster, dst);
    return Status::ok;
}

template <class Pixel>
constexpr std::int64_t encoded_bmp_bytes(Size size) {
    static_assert(std::is_same_v<Pixel, Gray8> || std::is_same_v<Pixel, Rgb888>,
                  "a BMP file holds Gray8 or Rgb888");
    return detail::encoded_bmp_raster<Pixel>() +
           std::int64_t{detail::encoded_bmp_stride<Pixel>(size.width)} * size.height;
}

inline Result<std::ptrdiff_t> encode_bmp(ImageView<const Gray8> src, Span<std::uint8_t> out) {
    return detail::encode_bmp_frame(src, out);
}
inline Result<std::ptrdiff_t> encode_bmp(ImageView<const Rgb888> src, Span<std::uint8_t> out) {
    return detail::encode_bmp_frame(src, out);
}

}  // namespace fovea
