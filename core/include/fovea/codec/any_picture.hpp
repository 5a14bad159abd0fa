// SPDX-License-Identifier: MIT
//
// Pictures of any format that fovea reads, told apart by their first bytes.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/codec/bmp.hpp>
#include <fovea/codec/jpeg.hpp>
#include <fovea/codec/picture.hpp>
#include <fovea/codec/png_reader.hpp>
#include <fovea/codec/pnm.hpp>
#include <fovea/image/image_view.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

enum class PictureFormat : std::uint8_t { unknown, pnm, bmp, png, jpeg };

/// The format that the first bytes of a file name; the name of the file does not count.
///
/// Source  Netpbm formats; the BMP signature "BM"; PNG sec. 5.2; ITU-T T.81 B.1.1.3, SOI
constexpr PictureFormat picture_format(Span<const std::uint8_t> bytes);

/// The format's usual name.
constexpr const char* describe(PictureFormat format);

/// What a picture file holds.
///
/// Errors  unsupported for a format that is none of these; else as the format's inspect function
inline Result<PictureInfo> inspect_picture(Span<const std::uint8_t> bytes);

/// Decodes a picture of any format. All else as the format's decode function.
///
/// Shapes   dst of the size that inspect_picture() tells; Gray8 or Rgb888
/// Scratch  as inspect_picture() tells
/// Errors   as inspect_picture() and the format's decode function
template <class Pixel>
Status decode_picture(Span<const std::uint8_t> bytes, Span<std::uint8_t> scratch, ImageView<Pixel> dst);

// ---- Implementation ---------------------------------------------------------------

constexpr PictureFormat picture_format(Span<const std::uint8_t> bytes) {
    if (bytes.size() < 2) return PictureFormat::unknown;
    if (bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '7') return PictureFormat::pnm;
    if (bytes[0] == 'B' && bytes[1] == 'M') return PictureFormat::bmp;
    if (bytes[0] == 0x89 && bytes[1] == 'P') return PictureFormat::png;
    if (bytes[0] == 0xff && bytes[1] == 0xd8) return PictureFormat::jpeg;
    return PictureFormat::unknown;
}

constexpr const char* describe(PictureFormat format) {
    switch (format) {
        case PictureFormat::unknown: break;
        case PictureFormat::pnm: return "PGM/PPM";
        case PictureFormat::bmp: return "BMP";
        case PictureFormat::png: return "PNG";
        case PictureFormat::jpeg: return "JPEG";
    }
    return "unknown";
}

inline Result<PictureInfo> inspect_picture(Span<const std::uint8_t> bytes) {
    switch (picture_format(bytes)) {
        case PictureFormat::unknown: break;
        case PictureFormat::pnm: return inspect_pnm(bytes);
        case PictureFormat::bmp: return inspect_bmp(bytes);
        case PictureFormat::png: return inspect_png(bytes);
        case PictureFormat::jpeg: return inspect_jpeg(bytes);
    }
    return Status::unsupported;
}

template <class Pixel>
Status decode_picture(Span<const std::uint8_t> bytes, Span<std::uint8_t> scratch, ImageView<Pixel> dst) {
    switch (picture_format(bytes)) {
        case PictureFormat::unknown: break;
        case PictureFormat::pnm: return decode_pnm(bytes, dst);
        case PictureFormat::bmp: return decode_bmp(bytes, dst);
        case PictureFormat::png: return decode_png(bytes, scratch, dst);
        case PictureFormat::jpeg: return decode_jpeg(bytes, scratch, dst);
    }
    return Status::unsupported;
}

}  // namespace fovea
