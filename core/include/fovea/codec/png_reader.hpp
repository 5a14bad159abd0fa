// SPDX-License-Identifier: MIT
//
// PNG: reads pictures of every colour type and depth, row by row.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include <fovea/base/crc32.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/codec/inflate.hpp>
#include <fovea/codec/picture.hpp>
#include <fovea/codec/png.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Scratch bytes that decode_png() needs: those of inflate and two rows. bits_per_pixel is that of the file,
/// 64 suffices for any.
constexpr std::int64_t png_reader_scratch(Size size, int bits_per_pixel = 64);

/// What a PNG file holds. Only its header is looked at.
///
/// Shapes  sides 1..max_image_side, 1 to 16 bits a sample
/// Units   gray8, or gray16 for 16 bits; rgb888, or rgb48 for 16 bits; rgb888 for palettes
/// Errors  truncated when the header ends early; malformed; image_too_large; unsupported for interlaced
///         files, whose rows cannot be had in order
/// Source  W3C, PNG Specification, second edition, sec. 11.2.2
inline Result<PictureInfo> inspect_png(Span<const std::uint8_t> bytes);

/// The picture of a PNG file.
///
/// Shapes    dst as large as the picture
/// Units     gray 1 to 16 bits becomes 0..255 (Gray8, Rgb888) or 0..65535 (Gray16). Samples are taken as they
///           stand, gamma and background are ignored; what an alpha channel makes transparent is seen on
///           white, as on paper
/// Rounding  nearest, ties up; brightness of colours as gray_of(), from 8 bits a channel
/// Scratch   as inspect_png() answers, or png_reader_scratch() bytes; undefined afterwards
/// Errors    empty_image, all of inspect_png(), size_mismatch, scratch_too_small; then, before the first
///           pixel is written, truncated or malformed by the length, order or checksum of any chunk, and
///           unsupported for an unknown chunk that must not be skipped. What is wrong inside chunks with
///           right checksums (compressed data truncated or malformed, an index without a colour) is found on
///           the way: dst then holds the pixels before the fault
/// Source    W3C, PNG Specification, second edition. What follows the chunk IEND is not looked at
template <class Pixel>
Status decode_png(Span<const std::uint8_t> bytes, Span<std::uint8_t> scratch, ImageView<Pixel> dst);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

constexpr std::uint32_t png_16(const std::uint8_t* at) {
    return static_cast<std::uint32_t>(at[0] << 8 | at[1]);
}
constexpr std::uint32_t png_32(const std::uint8_t* at) { return png_16(at) << 16 | png_16(at + 2); }

struct PngHeader {
    Size size;
    int depth = 0;  ///< bits of a sample, or of an index
    Png::Colour colour = Png::gray;

    constexpr int samples() const {
        switch (colour) {
            case Png::rgb: return 3;
            case Png::gray_alpha: return 2;
            case Png::rgb_alpha: return 4;
            default: return 1;
        }
    }
    constexpr int bits_per_pixel() const { return depth * samples(); }
};

/// At most 32767 * 8 bytes.
constexpr std::ptrdiff_t png_row_bytes(int width, int bits_per_pixel) {
    return (std::ptrdiff_t{width} * bits_per_pixel + 7) / 8;
}
/// Zeros in front of a row buffer: what stands left of the first pixel, which is 8 bytes at most.
inline constexpr int png_row_margin = 8;

struct PngChunk {
    std::uint32_t name = 0;
    Span<const std::uint8_t> content;
};

/// Walks over the chunks of a file.
class PngChunks {
public:
    PngChunks() = default;
    explicit PngChunks(Span<const std::uint8_t> rest) : rest_(rest) {}

    Result<PngChunk> next() {
        if (rest_.size() < 8) return Status::truncated;
        const std::uint32_t length = png_32(rest_.data());
        if (length > 0x7fffffff) return Status::malformed;
        const auto bytes = static_cast<std::ptrdiff_t>(length);
        if (rest_.size() - Png::frame_bytes < bytes) return Status::truncated;
        PngChunk chunk;
        chunk.name = png_32(rest_.data() + 4);
        chunk.content = rest_.from(8).first(bytes);
        rest_ = rest_.from(bytes + Png::frame_bytes);
        return chunk;
    }
    Result<PngChunk> next_checked() {
        const PngChunks start = *this;
        const Result<PngChunk> chunk = next();
        if (!chunk) return chunk;
        const std::ptrdiff_t covered = chunk->content.size() + 4;
        if (crc32(start.rest_.from(4).first(covered)) != png_32(chunk->content.end()))
            return Status::malformed;
        return chunk;
    }

private:
    Span<const std::uint8_t> rest_;
};

/// What stands in a file whose chunks are in order.
struct PngParts {
    Span<const std::uint8_t> palette;
    PngChunks data;  ///< from the first IDAT on
};

/// The contents of all IDAT chunks, for inflate.
class PngData {
public:
    explicit PngData(PngChunks chunks) : chunks_(chunks) {}

    Span<const std::uint8_t> next() {
        while (!ended_) {
            const Result<PngChunk> chunk = chunks_.next();
            ended_ = !chunk || chunk->name != Png::data;
            if (!ended_ && !chunk->content.empty()) return chunk->content;
        }
        return {};
    }

private:
    PngChunks chunks_;
    bool ended_ = false;
};

constexpr bool png_depth_allowed(std::uint8_t colour, int depth) {
    switch (colour) {
        case Png::gray: return depth == 1 || depth == 2 || depth == 4 || depth == 8 || depth == 16;
        case Png::indexed: return depth == 1 || depth == 2 || depth == 4 || depth == 8;
        case Png::rgb:
        case Png::gray_alpha:
        case Png::rgb_alpha: return depth == 8 || depth == 16;
        default: return false;
    }
}

inline Result<PngHeader> png_header(Span<const std::uint8_t> bytes) {
    constexpr auto signature_bytes = static_cast<std::ptrdiff_t>(sizeof(Png::signature));
    for (std::ptrdiff_t i = 0; i < signature_bytes; ++i) {
        if (i == bytes.size()) return Status::truncated;
        if (bytes[i] != Png::signature[i]) return Status::malformed;
    }
    const Result<PngChunk> chunk = PngChunks(bytes.from(signature_bytes)).next_checked();
    if (!chunk) return chunk.status();
    if (chunk->name != Png::header || chunk->content.size() != Png::header_bytes) return Status::malformed;

    const std::uint8_t* fields = chunk->content.data();
    const std::uint32_t width = png_32(fields);
    const std::uint32_t height = png_32(fields + 4);
    if (width == 0 || width > 0x7fffffff || height == 0 || height > 0x7fffffff) return Status::malformed;
    if (!png_depth_allowed(fields[9], fields[8])) return Status::malformed;
    // Only one way to compress and one to filter are defined, and two to interlace.
    if (fields[10] != 0 || fields[11] != 0 || fields[12] > 1) return Status::malformed;
    if (width > max_image_side || height > max_image_side) return Status::image_too_large;
    if (fields[12] == 1) return Status::unsupported;
    PngHeader header;
    header.size = {static_cast<int>(width), static_cast<int>(height)};
    header.depth = fields[8];
    header.colour = static_cast<Png::Colour>(fields[9]);
    return header;
}

/// Triples of red, green and blue: needed by indexed pictures, a mere hint for colours, senseless for grays.
inline Status check_png_palette(const PngHeader& header, Span<const std::uint8_t> palette) {
    const std::ptrdiff_t most = header.colour == Png::indexed ? std::ptrdiff_t{1} << header.depth : 256;
    const bool gray = header.colour == Png::gray || header.colour == Png::gray_alpha;
    const bool whole = palette.size() % 3 == 0 && !palette.empty() && palette.size() / 3 <= most;
    return whole && !gray ? Status::ok : Status::malformed;
}

/// A chunk that may be skipped has a lower-case first letter.
inline Status check_unknown_png_chunk(std::uint32_t name) {
    for (int shift = 0; shift < 32; shift += 8) {
        const std::uint32_t upper = name >> shift & 0xdf;
        if (upper < 'A' || upper > 'Z') return Status::malformed;
    }
    return (name & 0x20000000) != 0 ? Status::ok : Status::unsupported;
}

/// Looks at all chunks up to IEND: whole, in order, and with the right checksums.
inline Result<PngParts> check_png_chunks(const PngHeader& header, Span<const std::uint8_t> bytes) {
    enum class Place : std::uint8_t { before_data, in_data, behind_data } place = Place::before_data;
    PngChunks chunks(bytes.from(sizeof(Png::signature) + Png::frame_bytes + Png::header_bytes));
    PngParts parts;
    for (;;) {
        const PngChunks here = chunks;
        const Result<PngChunk> chunk = chunks.next_checked();
        if (!chunk) return chunk.status();
        if (chunk->name != Png::data && place == Place::in_data) place = Place::behind_data;
        Status status = Status::ok;
        switch (chunk->name) {
            case Png::header: return Status::malformed;
            case Png::palette:
                if (place != Place::before_data || !parts.palette.empty()) return Status::malformed;
                status = check_png_palette(header, chunk->content);
                parts.palette = chunk->content;
                break;
            case Png::data:
                if (place == Place::behind_data) return Status::malformed;
                if (header.colour == Png::indexed && parts.palette.empty()) return Status::malformed;
                if (place == Place::before_data) parts.data = here;
                place = Place::in_data;
                break;
            case Png::end:
                if (place == Place::before_data || !chunk->content.empty()) return Status::malformed;
                return parts;
            default: status = check_unknown_png_chunk(chunk->name); break;
        }
        if (status != Status::ok) return status;
    }
}

/// Adds its prediction to every byte of a row, channel by channel: so the neighbour on the left is at hand.
template <class Predictor>
void add_png_prediction(std::ptrdiff_t step, const std::uint8_t* above, std::uint8_t* row,
                        std::ptrdiff_t bytes, Predictor predictor) {
    for (std::ptrdiff_t channel = 0; channel < step; ++channel) {
        int left = 0;
        int above_left = 0;
        for (std::ptrdiff_t i = channel; i < bytes; i += step) {
            left = (row[i] + predictor(left, above[i], above_left)) & 0xff;
            above_left = above[i];
            row[i] = static_cast<std::uint8_t>(left);
        }
    }
}

/// Turns filtered bytes into samples. step is the distance to the pixel on the left in bytes.
inline Status unfilter_png_row(std::uint8_t filter, std::ptrdiff_t step, const std::uint8_t* above,
                               std::uint8_t* row, std::ptrdiff_t bytes) {
    const auto run = [&](auto predictor) { add_png_prediction(step, above, row, bytes, predictor); };
    switch (filter) {
        case Png::none: return Status::ok;
        case Png::sub: run([](int left, int, int) { return left; }); return Status::ok;
        case Png::up:
            for (std::ptrdiff_t i = 0; i < bytes; ++i)
                row[i] = static_cast<std::uint8_t>((row[i] + above[i]) & 0xff);
            return Status::ok;
        case Png::mean: run([](int left, int up, int) { return (left + up) / 2; }); return Status::ok;
        case Png::paeth: run(paeth_predictor); return Status::ok;
        default: return Status::malformed;
    }
}

/// Samples of 1, 2 or 4 bits stand in a byte from the highest bit down.
constexpr std::uint32_t packed_sample(const std::uint8_t* row, int index, int depth) {
    const int bit = index * depth;
    const int shift = 8 - depth - bit % 8;
    return static_cast<std::uint32_t>(row[bit / 8] >> shift & ((1 << depth) - 1));
}

/// A sample as it is seen on white through its alpha, both 0..most <= 65535.
constexpr std::uint32_t png_on_white(std::uint32_t sample, std::uint32_t alpha, std::uint32_t most) {
    return most - ((most - sample) * alpha + most / 2) / most;
}

/// Gray or colour pixels; sample(i) is the i-th sample of the row. A second or fourth one is alpha.
template <class Pixel, class Sample>
void png_sample_row(const PngHeader& header, Sample sample, Pixel* dst) {
    const std::uint32_t most = (1u << header.depth) - 1;
    const int samples = header.samples();
    const int width = header.size.width;
    if (samples < 3) {
        for (int x = 0; x < width; ++x) {
            const std::uint32_t level = sample(x * samples);
            const std::uint32_t seen = samples == 2 ? png_on_white(level, sample(x * 2 + 1), most) : level;
            dst[x] = pixel_of_gray<Pixel>(seen, most);
        }
        return;
    }
    for (int x = 0; x < width; ++x) {
        const int i = x * samples;
        const std::uint32_t alpha = samples == 4 ? sample(i + 3) : most;
        const auto channel = [&](int k) {
            return pixel_of_gray<Gray8>(png_on_white(sample(k), alpha, most), most);
        };
        dst[x] = pixel_of_colour<Pixel>({channel(i), channel(i + 1), channel(i + 2)});
    }
}

template <class Pixel>
Status png_indexed_row(const PngHeader& header, Span<const std::uint8_t> palette, const std::uint8_t* row,
                       Pixel* dst) {
    const std::ptrdiff_t colours = palette.size() / 3;
    for (int x = 0; x < header.size.width; ++x) {
        const auto index = static_cast<std::ptrdiff_t>(packed_sample(row, x, header.depth));
        if (index >= colours) return Status::malformed;
        const std::uint8_t* colour = palette.data() + 3 * index;
        dst[x] = pixel_of_colour<Pixel>({colour[0], colour[1], colour[2]});
    }
    return Status::ok;
}

template <class Pixel>
Status png_row(const PngHeader& header, Span<const std::uint8_t> palette, const std::uint8_t* row,
               Pixel* dst) {
    if (header.colour == Png::indexed) return png_indexed_row(header, palette, row, dst);
    if (header.depth == 8)
        png_sample_row(
            header, [row](int i) { return std::uint32_t{row[i]}; }, dst);
    else if (header.depth == 16)
        png_sample_row(
            header, [row](int i) { return png_16(row + std::ptrdiff_t{i} * 2); }, dst);
    else
        png_sample_row(
            header, [&](int i) { return packed_sample(row, i, header.depth); }, dst);
    return Status::ok;
}

template <class Pixel>
Status decode_png_rows(const PngHeader& header, const PngParts& parts, Span<std::uint8_t> scratch,
                       ImageView<Pixel> dst) {
    const std::ptrdiff_t bytes = png_row_bytes(header.size.width, header.bits_per_pixel());
    const std::ptrdiff_t step = maximum(header.bits_per_pixel() / 8, 1);
    const auto inflate_bytes = static_cast<std::ptrdiff_t>(inflate_scratch());
    std::uint8_t* above = scratch.data() + inflate_bytes + png_row_margin;
    std::uint8_t* row = above + bytes + png_row_margin;
    std::memset(above - png_row_margin, 0, static_cast<std::size_t>(2 * (bytes + png_row_margin)));
    PngData data(parts.data);
    ZlibReader<PngData> reader(data, scratch.first(inflate_bytes));
    for (int y = 0; y < dst.height(); ++y) {
        // The number of the filter comes first and lands on the last zero of the margin.
        const Result<std::ptrdiff_t> read = reader.read({row - 1, bytes + 1});
        if (!read) return read.status();
        if (*read <= bytes) return Status::truncated;
        const std::uint8_t filter = row[-1];
        row[-1] = 0;
        if (Status s = unfilter_png_row(filter, step, above, row, bytes); s != Status::ok) return s;
        if (Status s = png_row(header, parts.palette, row, dst.row(y)); s != Status::ok) return s;
        std::uint8_t* const done = row;
        row = above;
        above = done;
    }
    std::uint8_t more[1] = {};
    const Result<std::ptrdiff_t> beyond = reader.read(more);
    if (!beyond) return beyond.status();
    return *beyond == 0 ? Status::ok : Status::malformed;
}

}  // namespace detail

constexpr std::int64_t png_reader_scratch(Size size, int bits_per_pixel) {
    return inflate_scratch() +
           2 * (detail::png_row_margin + detail::png_row_bytes(size.width, bits_per_pixel));
}

inline Result<PictureInfo> inspect_png(Span<const std::uint8_t> bytes) {
    const Result<detail::PngHeader> header = detail::png_header(bytes);
    if (!header) return header.status();
    const bool gray = header->colour == Png::gray || header->colour == Png::gray_alpha;
    PictureInfo info;
    info.size = header->size;
    if (gray)
        info.content = header->depth == 16 ? PictureContent::gray16 : PictureContent::gray8;
    else
        info.content = header->depth == 16 ? PictureContent::rgb48 : PictureContent::rgb888;
    info.scratch_bytes = png_reader_scratch(info.size, header->bits_per_pixel());
    return info;
}

template <class Pixel>
Status decode_png(Span<const std::uint8_t> bytes, Span<std::uint8_t> scratch, ImageView<Pixel> dst) {
    static_assert(
        std::is_same_v<Pixel, Gray8> || std::is_same_v<Pixel, Gray16> || std::is_same_v<Pixel, Rgb888>,
        "a picture is decoded into Gray8, Gray16 or Rgb888");
    if (dst.empty()) return Status::empty_image;
    const Result<detail::PngHeader> header = detail::png_header(bytes);
    if (!header) return header.status();
    if (dst.size() != header->size) return Status::size_mismatch;
    if (scratch.size() < png_reader_scratch(header->size, header->bits_per_pixel()))
        return Status::scratch_too_small;
    const Result<detail::PngParts> parts = detail::check_png_chunks(*header, bytes);
    if (!parts) return parts.status();
    return detail::decode_png_rows(*header, *parts, scratch, dst);
}

}  // namespace fovea
