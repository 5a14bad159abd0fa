// SPDX-License-Identifier: MIT
//
// PNG: writes gray and colour pictures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include <fovea/base/crc32.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/codec/deflate.hpp>
#include <fovea/codec/png.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Scratch bytes that encode_png() needs, the same for every size.
constexpr std::int64_t png_writer_scratch(Size size);

/// The most bytes that encode_png() writes: those of a picture that cannot be compressed.
template <class Pixel>
constexpr std::int64_t encoded_png_bytes(Size size);

/// Writes a PNG file, 8 bits gray (Gray8) or 24 bits colour (Rgb888), and answers its length.
///
/// Shapes   sides 1..max_image_side
/// Scratch  png_writer_scratch(src.size()) bytes, undefined afterwards
/// Errors   empty_image; image_too_large, also above 2^31 - 1 bytes in the worst case; scratch_too_small;
///          buffer_too_small, never from encoded_png_bytes() bytes on, after which out is undefined
/// Source   W3C, PNG Specification, second edition; the filter of a row is the one with the smallest sum of
///          absolute differences (sec. 12.8)
inline Result<std::ptrdiff_t> encode_png(ImageView<const Gray8> src, Span<std::uint8_t> scratch,
                                         Span<std::uint8_t> out);
inline Result<std::ptrdiff_t> encode_png(ImageView<const Rgb888> src, Span<std::uint8_t> scratch,
                                         Span<std::uint8_t> out);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

inline constexpr std::ptrdiff_t png_before_data =
    static_cast<std::ptrdiff_t>(sizeof(Png::signature)) + Png::frame_bytes + Png::header_bytes + 8;
inline constexpr std::ptrdiff_t png_behind_data = 4 + Png::frame_bytes;

inline std::uint8_t* put_png_32(std::uint8_t* at, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) *at++ = static_cast<std::uint8_t>(value >> shift & 0xff);
    return at;
}

/// Writes the checksum behind a chunk whose content stands already, and its length and name before.
inline std::uint8_t* close_png_chunk(std::uint8_t* start, std::uint32_t name, std::ptrdiff_t bytes) {
    put_png_32(put_png_32(start, static_cast<std::uint32_t>(bytes)), name);
    return put_png_32(start + 8 + bytes, crc32({start + 4, bytes + 4}));
}

/// Gives use() the filter as a function of a byte and its neighbours left, above and above left.
template <class Use>
void with_png_filter(int filter, Use use) {
    switch (filter) {
        case Png::sub: return use([](int here, int left, int, int) { return here - left; });
        case Png::up: return use([](int here, int, int above, int) { return here - above; });
        case Png::mean:
            return use([](int here, int left, int above, int) { return here - (left + above) / 2; });
        case Png::paeth:
            return use([](int here, int left, int above, int above_left) {
                return here - paeth_predictor(left, above, above_left);
            });
        default: return use([](int here, int, int, int) { return here; });
    }
}

/// A row of samples as bytes, and the row above it. Step is the distance to the pixel on the left. The first
/// row has none above: there `above` is the row itself, and only the filters that do not look up are used.
template <int Step>
struct PngRow {
    const std::uint8_t* row = nullptr;
    const std::uint8_t* above = nullptr;
    int bytes = 0;

    /// Gives use() the index and the filtered value of the bytes from..to-1. Outside the picture stand zeros.
    template <class Filter, class Use>
    void filter_bytes(int from, int to, Filter filter, Use use) const {
        int i = from;
        for (; i < minimum(Step, to); ++i)
            use(i, static_cast<std::uint8_t>(filter(row[i], 0, above[i], 0) & 0xff));
        for (; i < to; ++i)
            use(i,
                static_cast<std::uint8_t>(filter(row[i], row[i - Step], above[i], above[i - Step]) & 0xff));
    }

    /// The sum of the filtered values' distances from 0: at most 98301 bytes of 128.
    std::int32_t cost(int filter) const {
        std::int32_t sum = 0;
        with_png_filter(filter, [&](auto function) {
            filter_bytes(0, bytes, function,
                         [&](int, std::uint8_t value) { sum += value < 128 ? value : 256 - value; });
        });
        return sum;
    }
    int best_filter() const {
        const int end = above == row ? int{Png::up} : Png::filters;
        int best = Png::none;
        std::int32_t lowest = cost(best);
        for (int filter = Png::sub; filter < end; ++filter) {
            const std::int32_t sum = cost(filter);
            if (sum >= lowest) continue;
            lowest = sum;
            best = filter;
        }
        return best;
    }
};

/// Filters a row into the writer.
template <int Step>
void put_png_row(const PngRow<Step>& row, ZlibWriter& writer) {
    const int filter = row.best_filter();
    writer.room()[0] = static_cast<std::uint8_t>(filter);
    writer.add(1);
    for (int from = 0; from < row.bytes;) {
        const Span<std::uint8_t> room = writer.room();
        const int to = static_cast<int>(minimum<std::ptrdiff_t>(from + room.size(), row.bytes));
        std::uint8_t* dst = room.data();
        with_png_filter(filter, [&](auto function) {
            row.filter_bytes(from, to, function, [&](int i, std::uint8_t value) { dst[i - from] = value; });
        });
        writer.add(to - from);
        from = to;
    }
}

template <class Pixel>
Result<std::ptrdiff_t> put_png_rows(ImageView<const Pixel> src, Span<std::uint8_t> scratch,
                                    Span<std::uint8_t> dst) {
    constexpr int step = static_cast<int>(sizeof(Pixel));
    ZlibWriter writer(scratch, dst);
    for (int y = 0; y < src.height(); ++y) {
        const auto* row = reinterpret_cast<const std::uint8_t*>(src.row(y));
        const auto* above = y == 0 ? row : reinterpret_cast<const std::uint8_t*>(src.row(y - 1));
        put_png_row(PngRow<step>{row, above, src.width() * step}, writer);
    }
    return writer.finish();
}

template <class Pixel>
Result<std::ptrdiff_t> encode_png_frame(ImageView<const Pixel> src, Span<std::uint8_t> scratch,
                                        Span<std::uint8_t> out) {
    if (src.empty()) return Status::empty_image;
    if (src.width() > max_image_side || src.height() > max_image_side) return Status::image_too_large;
    if (encoded_png_bytes<Pixel>(src.size()) > 0x7fffffff) return Status::image_too_large;
    if (scratch.size() < png_writer_scratch(src.size())) return Status::scratch_too_small;
    const std::ptrdiff_t room = out.size() - png_before_data - png_behind_data;
    if (room < 0) return Status::buffer_too_small;
    const Result<std::ptrdiff_t> data = put_png_rows(src, scratch, out.from(png_before_data).first(room));
    if (!data) return data.status();

    std::uint8_t* to = out.data();
    std::memcpy(to, Png::signature, sizeof(Png::signature));
    to += sizeof(Png::signature);
    std::uint8_t* fields = put_png_32(put_png_32(to + 8, static_cast<std::uint32_t>(src.width())),
                                      static_cast<std::uint32_t>(src.height()));
    *fields++ = 8;
    *fields++ = std::is_same_v<Pixel, Gray8> ? Png::gray : Png::rgb;
    for (int i = 0; i < 3; ++i) *fields++ = 0;
    to = close_png_chunk(to, Png::header, Png::header_bytes);
    to = close_png_chunk(to, Png::data, *data);
    to = close_png_chunk(to, Png::end, 0);
    return to - out.data();
}

}  // namespace detail

constexpr std::int64_t png_writer_scratch(Size) { return deflate_scratch(); }

template <class Pixel>
constexpr std::int64_t encoded_png_bytes(Size size) {
    static_assert(std::is_same_v<Pixel, Gray8> || std::is_same_v<Pixel, Rgb888>,
                  "a PNG file is made of Gray8 or Rgb888");
    const std::int64_t row_bytes = 1 + std::int64_t{size.width} * static_cast<std::int64_t>(sizeof(Pixel));
    return detail::png_before_data + deflated_bytes(row_bytes * size.height) + detail::png_behind_data;
}

inline Result<std::ptrdiff_t> encode_png(ImageView<const Gray8> src, Span<std::uint8_t> scratch,
                                         Span<std::uint8_t> out) {
    return detail::encode_png_frame(src, scratch, out);
}
inline Result<std::ptrdiff_t> encode_png(ImageView<const Rgb888> src, Span<std::uint8_t> scratch,
                                         Span<std::uint8_t> out) {
    return detail::encode_png_frame(src, scratch, out);
}

}  // namespace fovea
