// SPDX-License-Identifier: MIT
//
// PNM: gray (P5, .pgm) and colour (P6, .ppm) pictures, plain samples behind a short header of text.
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

/// What a PGM or PPM file holds. Only its header is looked at.
///
/// Shapes  sides 1..max_image_side, maxval 1..65535
/// Units   gray8 or rgb888 up to maxval 255, gray16 or rgb48 above
/// Errors  truncated when the header ends early; malformed; image_too_large; unsupported for P1, P2 and P3
///         (numbers as text), P4 (one bit a pixel) and P7 (PAM): pictures to measure in come as P5 or P6
/// Source  Netpbm, pgm(5) and ppm(5). The manual and Netpbm's programs disagree about a comment that touches
///         a number; here such a file is malformed
inline Result<PictureInfo> inspect_pnm(Span<const std::uint8_t> bytes);

/// The picture of a PGM or PPM file, the first one if several follow each other.
///
/// Shapes    dst as large as the picture
/// Units     maxval becomes 255 (Gray8, Rgb888) or 65535 (Gray16)
/// Rounding  nearest, ties up; brightness of colours as gray_of()
/// Errors    empty_image, all of inspect_pnm(), size_mismatch, truncated when samples are missing, malformed
///           for a sample above maxval; all found before the first pixel is written
/// Source    as inspect_pnm()
template <class Pixel>
Status decode_pnm(Span<const std::uint8_t> bytes, ImageView<Pixel> dst);

/// The exact length of the file that encode_pnm() writes.
template <class Pixel>
constexpr std::int64_t encoded_pnm_bytes(Size size);

/// Writes a PGM (Gray8, Gray16) or PPM (Rgb888) file and answers its length.
///
/// Shapes  sides 1..max_image_side
/// Units   maxval 255, 65535 for Gray16
/// Errors  empty_image, image_too_large, buffer_too_small below encoded_pnm_bytes(); out is untouched then
/// Source  as inspect_pnm()
inline Result<std::ptrdiff_t> encode_pnm(ImageView<const Gray8> src, Span<std::uint8_t> out);
inline Result<std::ptrdiff_t> encode_pnm(ImageView<const Gray16> src, Span<std::uint8_t> out);
inline Result<std::ptrdiff_t> encode_pnm(ImageView<const Rgb888> src, Span<std::uint8_t> out);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

struct PnmHeader {
    Size size;
    std::uint32_t most = 0;  ///< maxval
    int samples = 1;         ///< of a pixel
    std::ptrdiff_t raster = 0;

    constexpr int sample_bytes() const { return most > 255 ? 2 : 1; }
    constexpr std::ptrdiff_t row_bytes() const {
        return std::ptrdiff_t{size.width} * samples * sample_bytes();
    }
};

constexpr bool is_pnm_space(std::uint8_t c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

/// Steps over what stands between two numbers: white space, with comments after its first byte.
inline Status skip_pnm_space(Span<const std::uint8_t> bytes, std::ptrdiff_t& at) {
    const std::ptrdiff_t start = at;
    for (; at < bytes.size(); ++at) {
        if (bytes[at] == '#' && at > start)
            while (at + 1 < bytes.size() && bytes[at + 1] != '\n' && bytes[at + 1] != '\r') ++at;
        else if (!is_pnm_space(bytes[at]))
            return at > start ? Status::ok : Status::malformed;
    }
    return Status::truncated;
}

/// A decimal number and the white space before it. Numbers beyond a million come out as one million.
inline Result<std::uint32_t> pnm_number(Span<const std::uint8_t> bytes, std::ptrdiff_t& at) {
    if (Status s = skip_pnm_space(bytes, at); s != Status::ok) return s;
    const std::ptrdiff_t start = at;
    std::uint32_t number = 0;
    for (; at < bytes.size() && bytes[at] >= '0' && bytes[at] <= '9'; ++at)
        number = minimum<std::uint32_t>(number * 10 + bytes[at] - '0', 1000000);
    if (at == bytes.size()) return Status::truncated;
    if (at == start) return Status::malformed;
    return number;
}

inline Result<PnmHeader> pnm_header(Span<const std::uint8_t> bytes) {
    if (bytes.empty()) return Status::truncated;
    if (bytes[0] != 'P') return Status::malformed;
    if (bytes.size() < 2) return Status::truncated;
    const std::uint8_t kind = bytes[1];
    if ((kind >= '1' && kind <= '4') || kind == '7') return Status::unsupported;
    if (kind != '5' && kind != '6') return Status::malformed;

    std::ptrdiff_t at = 2;
    std::uint32_t numbers[3] = {};
    for (std::uint32_t& number : numbers) {
        const Result<std::uint32_t> read = pnm_number(bytes, at);
        if (!read) return read.status();
        if (*read == 0) return Status::malformed;
        number = *read;
    }
    // Exactly one byte of white space: the next one may be a sample that looks like white space.
    if (!is_pnm_space(bytes[at]) || numbers[2] > 65535) return Status::malformed;
    if (numbers[0] > max_image_side || numbers[1] > max_image_side) return Status::image_too_large;
    PnmHeader header;
    header.size = {static_cast<int>(numbers[0]), static_cast<int>(numbers[1])};
    header.most = numbers[2];
    header.samples = kind == '6' ? 3 : 1;
    header.raster = at + 1;
    return header;
}

/// True if no sample is above maxval.
inline bool pnm_samples_fit(const PnmHeader& header, const std::uint8_t* from) {
    if (header.most == 255 || header.most == 65535) return true;
    const std::int64_t bytes = std::int64_t{header.row_bytes()} * header.size.height;
    for (std::int64_t i = 0; i < bytes; i += header.sample_bytes()) {
        const std::uint32_t sample =
            header.sample_bytes() == 1 ? from[i] : static_cast<std::uint32_t>(from[i] << 8 | from[i + 1]);
        if (sample > header.most) return false;
    }
    return true;
}

/// One row. SampleBytes is 1 or 2, the higher byte first.
template <int SampleBytes, class Pixel>
void pnm_row(const PnmHeader& header, const std::uint8_t* from, Pixel* to) {
    const auto sample = [&](int i) -> std::uint32_t {
        const std::uint8_t* at = from + std::ptrdiff_t{i} * SampleBytes;
        return SampleBytes == 1 ? at[0] : static_cast<std::uint32_t>(at[0] << 8 | at[1]);
    };
    const std::uint32_t most = header.most;
    if (header.samples == 1) {
        for (int x = 0; x < header.size.width; ++x) to[x] = pixel_of_gray<Pixel>(sample(x), most);
        return;
    }
    for (int x = 0; x < header.size.width; ++x)
        to[x] = pixel_of_colour<Pixel>({pixel_of_gray<Gray8>(sample(3 * x), most),
                                        pixel_of_gray<Gray8>(sample(3 * x + 1), most),
                                        pixel_of_gray<Gray8>(sample(3 * x + 2), most)});
}

/// Writes digits at `at` and answers where they end.
inline std::uint8_t* put_pnm_number(std::uint8_t* at, int number, char behind) {
    int power = 1;
    while (number / power >= 10) power *= 10;
    for (; power > 0; power /= 10) *at++ = static_cast<std::uint8_t>('0' + number / power % 10);
    *at++ = static_cast<std::uint8_t>(behind);
    return at;
}

template <class Pixel>
Result<std::ptrdiff_t> encode_pnm_frame(ImageView<const Pixel> src, Span<std::uint8_t> out) {
    if (src.empty()) return Status::empty_image;
    if (src.width() > max_image_side || src.height() > max_image_side) return Status::image_too_large;
    if (out.size() < encoded_pnm_bytes<Pixel>(src.size())) return Status::buffer_too_small;
    std::uint8_t* to = out.data();
    *to++ = 'P';
    *to++ = std::is_same_v<Pixel, Rgb888> ? '6' : '5';
    *to++ = '\n';
    to = put_pnm_number(to, src.width(), ' ');
    to = put_pnm_number(to, src.height(), '\n');
    to = put_pnm_number(to, std::is_same_v<Pixel, Gray16> ? 65535 : 255, '\n');
    for (int y = 0; y < src.height(); ++y) {
        const Pixel* row = src.row(y);
        for (int x = 0; x < src.width(); ++x) {
            if constexpr (std::is_same_v<Pixel, Rgb888>) {
                *to++ = row[x].red;
                *to++ = row[x].green;
                *to++ = row[x].blue;
            } else {
                if constexpr (sizeof(Pixel) == 2) *to++ = static_cast<std::uint8_t>(row[x] >> 8);
                *to++ = static_cast<std::uint8_t>(row[x] & 0xff);
            }
        }
    }
    return to - out.data();
}

}  // namespace detail

inline Result<PictureInfo> inspect_pnm(Span<const std::uint8_t> bytes) {
    const Result<detail::PnmHeader> header = detail::pnm_header(bytes);
    if (!header) return header.status();
    PictureInfo info;
    info.size = header->size;
    if (header->samples == 1)
        info.content = header->most > 255 ? PictureContent::gray16 : PictureContent::gray8;
    else
        info.content = header->most > 255 ? PictureContent::rgb48 : PictureContent::rgb888;
    return info;
}

template <class Pixel>
Status decode_pnm(Span<const std::uint8_t> bytes, ImageView<Pixel> dst) {
    static_assert(
        std::is_same_v<Pixel, Gray8> || std::is_same_v<Pixel, Gray16> || std::is_same_v<Pixel, Rgb888>,
        "a picture is decoded into Gray8, Gray16 or Rgb888");
    if (dst.empty()) return Status::empty_image;
    const Result<detail::PnmHeader> header = detail::pnm_header(bytes);
    if (!header) return header.status();
    if (dst.size() != header->size) return Status::size_mismatch;
    // At most 32767 * 32767 * 6 bytes.
    if (bytes.size() - header->raster < std::int64_t{header->row_bytes()} * dst.height())
        return Status::truncated;
    const std::uint8_t* from = bytes.data() + header->raster;
    if (!detail::pnm_samples_fit(*header, from)) return Status::malformed;
    for (int y = 0; y < dst.height(); ++y, from += header->row_bytes()) {
        if (header->sample_bytes() == 1)
            detail::pnm_row<1>(*header, from, dst.row(y));
        else
            detail::pnm_row<2>(*header, from, dst.row(y));
    }
    return Status::ok;
}

template <class Pixel>
constexpr std::int64_t encoded_pnm_bytes(Size size) {
    constexpr auto digits = [](int number) {
        int count = 1;
        for (; number >= 10; number /= 10) ++count;
        return count;
    };
    // "P5", maxval and four bytes of white space, and the two sides.
    const int header =
        2 + (std::is_same_v<Pixel, Gray16> ? 5 : 3) + 4 + digits(size.width) + digits(size.height);
    return header + size.area() * static_cast<std::int64_t>(sizeof(Pixel));
}

inline Result<std::ptrdiff_t> encode_pnm(ImageView<const Gray8> src, Span<std::uint8_t> out) {
    return detail::encode_pnm_frame(src, out);
}
inline Result<std::ptrdiff_t> encode_pnm(ImageView<const Gray16> src, Span<std::uint8_t> out) {
    return detail::encode_pnm_frame(src, out);
}
inline Result<std::ptrdiff_t> encode_pnm(ImageView<const Rgb888> src, Span<std::uint8_t> out) {
    return detail::encode_pnm_frame(src, out);
}

}  // namespace fovea
