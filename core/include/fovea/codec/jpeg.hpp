// SPDX-License-Identifier: MIT
//
// JPEG pictures: the baseline of ITU-T T.81 and the file format of T.871, decoded by rows of blocks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include <fovea/base/arena.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/codec/jpeg_colour.hpp>
#include <fovea/codec/jpeg_markers.hpp>
#include <fovea/codec/jpeg_scan.hpp>
#include <fovea/codec/picture.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/pixelwise/to_gray.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// What a JPEG file holds: gray8 for one component, rgb888 for three. scratch_bytes is what Rgb888 needs.
///
/// Errors  as decode_jpeg() for everything in front of the entropy-coded data
/// Source  T.81 Annex B
inline Result<PictureInfo> inspect_jpeg(Span<const std::uint8_t> bytes);

/// Scratch bytes that decode_jpeg() needs at most for a picture of that size, whatever its sampling.
constexpr std::int64_t jpeg_scratch(Size size);

/// Scratch bytes that decode_jpeg() needs for Gray8 pixels at any size, unless the file holds red, green and
/// blue instead of luma and chroma: then it is those of inspect_jpeg().
inline constexpr std::int64_t jpeg_gray_scratch = jpeg::ScanDecoder::scratch_bytes();

/// Decodes a picture: baseline or extended sequential DCT with Huffman codes, 8 bits, one component or three
/// in one scan, chroma sampled as finely as luma or half as finely across, down or both.
///
/// Shapes    dst of the size that inspect_jpeg() tells
/// Units     full range 0..255. Gray8 is the luma as coded, or gray_of() where the file holds red, green and
///           blue; Rgb888 of a file of one component is gray
/// Rounding  that of inverse_dct(), upsample_across(), upsample_down(), upsample_both() and colour_row()
/// Border    samples of blocks beyond the picture are not used; the outermost chroma samples repeat
/// Scratch   inspect_jpeg()'s scratch_bytes, or for Gray8 jpeg_gray_scratch if the file holds luma; at any
///           alignment, undefined afterwards
/// Errors    empty_image; malformed, truncated, unsupported, image_too_large as jpeg::read_header() says;
///           size_mismatch; scratch_too_small; then truncated if the bytes end before the end of the image,
///           and malformed for entropy-coded data that cannot be right. After these two, dst holds what was
///           decoded before the fault beside its old pixels, and must not be judged
/// Source    T.81; T.871 for colours; Adobe's marker APP14 tells files of red, green and blue. A picture that
///           is decoded has used up all entropy-coded bytes in front of each marker
template <class Pixel>
Status decode_jpeg(Span<const std::uint8_t> bytes, Span<std::uint8_t> scratch, ImageView<Pixel> dst);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Rows and columns of samples that one row of MCUs has of a component: whole blocks, and above them one row
/// of the MCUs before, which the filter for chroma needs.
constexpr int jpeg_plane_width(const jpeg::Header& header, int component) {
    return 8 * header.component[component].across * header.mcus_across();
}
constexpr int jpeg_plane_height(const jpeg::Header& header, int component) {
    return 1 + 8 * header.component[component].down;
}

constexpr std::int64_t jpeg_scratch_bytes(const jpeg::Header& header) {
    std::int64_t bytes = jpeg::ScanDecoder::scratch_bytes();
    for (int c = 0; c < header.components; ++c)
        bytes += std::int64_t{jpeg_plane_width(header, c)} * jpeg_plane_height(header, c);
    return bytes + 2 * std::int64_t{jpeg_plane_width(header, 0)};
}

/// Makes rows of pixels from rows of MCUs. The filter of chroma for twice as many rows looks one row ahead,
/// so the last row of pixels waits for the next row of MCUs.
template <class Pixel>
class JpegRows {
public:
    JpegRows(const jpeg::Header& header, Arena& arena, ImageView<Pixel> dst) : header_(header), dst_(dst) {
        for (int c = 0; c < header.components; ++c) {
            const int width = jpeg_plane_width(header, c);
            const int height = jpeg_plane_height(header, c);
            above_[c] = arena.take<std::uint8_t>(std::ptrdiff_t{width} * height).data();
            planes_[c] = {above_[c] + width, width, width, height - 1};
        }
        for (std::uint8_t*& line : lines_)
            line = arena.take<std::uint8_t>(jpeg_plane_width(header, 0)).data();
    }

    Status decode(jpeg::ScanDecoder& scan) {
        for (int row = 0; row < header_.mcus_down(); ++row) {
            if (Status s = scan.mcu_row(planes_); s != Status::ok) return s;
            const int top = 8 * header_.down() * row;
            const int late = twice_as_many_rows() ? 1 : 0;
            const bool last = row == header_.mcus_down() - 1;
            const int bottom = last ? header_.size.height : top + 8 * header_.down() - late;
            for (int y = maximum(top - late, 0); y < bottom; ++y) put(y, row);
            for (int c = 0; c < header_.components; ++c)
                std::memcpy(above_[c], sample_row(c, 8 * header_.component[c].down - 1),
                            static_cast<std::size_t>(planes_[c].width));
        }
        return Status::ok;
    }

private:
    bool twice_as_many_rows() const {
        return header_.components == 3 && header_.component[1].down < header_.down();
    }
    bool twice_as_many_columns() const { return header_.component[1].across < header_.across(); }

    /// Row y of the samples of a component in the present row of MCUs; -1 is the one above.
    const std::uint8_t* sample_row(int component, int y) const {
        return planes_[component].first + y * planes_[component].stride_bytes;
    }

    /// Row y of a chroma component at full size.
    const std::uint8_t* chroma_row(int component, int y, int mcu_row) {
        const jpeg::Component& chroma = header_.component[component];
        const Size samples = header_.samples(chroma);
        const int first = 8 * chroma.down * mcu_row;
        std::uint8_t* line = lines_[component - 1];
        if (!twice_as_many_rows()) {
            const std::uint8_t* row = sample_row(component, y - first);
            if (!twice_as_many_columns()) return row;
            jpeg::upsample_across(row, samples.width, line);
            return line;
        }
        const jpeg::Farther side = y % 2 == 0 ? jpeg::Farther::above : jpeg::Farther::below;
        const int other = side == jpeg::Farther::above ? y / 2 - 1 : y / 2 + 1;
        const std::uint8_t* nearer = sample_row(component, y / 2 - first);
        const std::uint8_t* farther = sample_row(component, clamp(other, 0, samples.height - 1) - first);
        if (twice_as_many_columns())
            jpeg::upsample_both(nearer, farther, samples.width, line);
        else
            jpeg::upsample_down(nearer, farther, side, samples.width, line);
        return line;
    }

    void put(int y, int mcu_row) {
        const std::uint8_t* first = sample_row(0, y - 8 * header_.down() * mcu_row);
        if (header_.components == 1) return put_gray(first, y);
        const std::uint8_t* second = chroma_row(1, y, mcu_row);
        const std::uint8_t* third = chroma_row(2, y, mcu_row);
        Pixel* to = dst_.row(y);
        if (header_.rgb) {
            for (int x = 0; x < dst_.width(); ++x)
                to[x] = pixel_of_colour<Pixel>(Rgb888{first[x], second[x], third[x]});
        } else if constexpr (std::is_same_v<Pixel, Rgb888>) {
            jpeg::colour_row(first, second, third, dst_.width(), to);
        }
    }
    void put_gray(const std::uint8_t* samples, int y) {
        Pixel* to = dst_.row(y);
        for (int x = 0; x < dst_.width(); ++x) to[x] = pixel_of_gray<Pixel>(samples[x], 255);
    }

    const jpeg::Header& header_;
    ImageView<Pixel> dst_;
    jpeg::Plane planes_[jpeg::max_components];
    std::uint8_t* above_[jpeg::max_components] = {};
    std::uint8_t* lines_[2] = {};
};

/// The luma alone, straight to its place.
inline Status decode_jpeg_luma(const jpeg::Header& header, jpeg::ScanDecoder& scan, ImageView<Gray8> dst) {
    for (int row = 0; row < header.mcus_down(); ++row) {
        const int top = 8 * header.down() * row;
        jpeg::Plane planes[jpeg::max_components];
        planes[0] = {dst.row(top), dst.stride_bytes(), dst.width(), dst.height() - top};
        if (Status s = scan.mcu_row(planes); s != Status::ok) return s;
    }
    return Status::ok;
}

}  // namespace detail

inline Result<PictureInfo> inspect_jpeg(Span<const std::uint8_t> bytes) {
    const Result<jpeg::Header> header = jpeg::read_header(bytes);
    if (!header) return header.status();
    PictureInfo info;
    info.size = header->size;
    info.content = header->components == 1 ? PictureContent::gray8 : PictureContent::rgb888;
    info.scratch_bytes = detail::jpeg_scratch_bytes(*header);
    return info;
}

constexpr std::int64_t jpeg_scratch(Size size) {
    // No sampling takes more rows than three components of two blocks below each other, with the row above,
    // and two lines; none takes wider ones than MCUs of two blocks.
    constexpr int rows = 3 * (1 + 2 * 8) + 2;
    return jpeg::ScanDecoder::scratch_bytes() + rows * ((std::int64_t{size.width} + 15) / 16 * 16);
}

template <class Pixel>
Status decode_jpeg(Span<const std::uint8_t> bytes, Span<std::uint8_t> scratch, ImageView<Pixel> dst) {
    static_assert(std::is_same_v<Pixel, Gray8> || std::is_same_v<Pixel, Rgb888>,
                  "a JPEG picture is decoded to Gray8 or Rgb888");
    if (dst.empty()) return Status::empty_image;
    const Result<jpeg::Header> header = jpeg::read_header(bytes);
    if (!header) return header.status();
    if (dst.size() != header->size) return Status::size_mismatch;
    const bool luma_is_enough = std::is_same_v<Pixel, Gray8> && !header->rgb;
    if (scratch.size() < (luma_is_enough ? jpeg_gray_scratch : detail::jpeg_scratch_bytes(*header)))
        return Status::scratch_too_small;

    Arena arena(scratch);
    jpeg::ScanDecoder scan(*header, arena);
    Status status = Status::ok;
    if constexpr (std::is_same_v<Pixel, Gray8>) {
        if (luma_is_enough) status = detail::decode_jpeg_luma(*header, scan, dst);
    }
    if (!luma_is_enough) status = detail::JpegRows<Pixel>(*header, arena, dst).decode(scan);
    return status == Status::ok ? scan.finish() : status;
}

}  // namespace fovea
