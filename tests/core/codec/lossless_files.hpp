// SPDX-License-Identifier: MIT
//
// What the tests of PNM, BMP and PNG share: files put together byte by byte, right or deliberately wrong.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <fovea/base/crc32.hpp>
#include <fovea/base/span.hpp>
#include <fovea/codec/zlib.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {

using Bytes = std::vector<std::uint8_t>;

inline Span<const std::uint8_t> view_of(const Bytes& bytes) {
    return {bytes.data(), static_cast<std::ptrdiff_t>(bytes.size())};
}
inline Span<std::uint8_t> room_in(Bytes& bytes) {
    return {bytes.data(), static_cast<std::ptrdiff_t>(bytes.size())};
}
inline Bytes bytes_of(const std::string& text) { return {text.begin(), text.end()}; }
inline Bytes zeros(std::int64_t count) { return Bytes(static_cast<std::size_t>(count)); }

/// The first bytes of a file in memory of exactly their number, so that a sanitizer sees whoever reads on.
inline Bytes first_bytes(const Bytes& file, std::size_t count) {
    return {file.begin(), file.begin() + static_cast<std::ptrdiff_t>(count)};
}

inline void append(Bytes& to, const Bytes& more) {
    for (const std::uint8_t byte : more) to.push_back(byte);
}
inline void append_little(Bytes& to, std::uint32_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) to.push_back(static_cast<std::uint8_t>(value >> 8 * i));
}
inline void append_big(Bytes& to, std::uint32_t value, int bytes) {
    for (int i = bytes - 1; i >= 0; --i) to.push_back(static_cast<std::uint8_t>(value >> 8 * i));
}

/// True when every byte of the image is `value`.
template <class Pixel>
bool all_bytes_are(ImageView<Pixel> image, std::uint8_t value) {
    for (int y = 0; y < image.height(); ++y) {
        const auto* row = reinterpret_cast<const std::uint8_t*>(image.row(y));
        for (std::size_t i = 0; i < sizeof(Pixel) * static_cast<std::size_t>(image.width()); ++i)
            if (row[i] != value) return false;
    }
    return true;
}
template <class Pixel>
void fill_bytes(ImageView<Pixel> image, std::uint8_t value) {
    for (int y = 0; y < image.height(); ++y)
        std::memset(static_cast<void*>(image.row(y)), value,
                    sizeof(Pixel) * static_cast<std::size_t>(image.width()));
}

/// Data in the zlib format, in stored blocks.
inline Bytes zlib_stored(const Bytes& data) {
    Bytes bytes = {0x78, 0x01};
    std::size_t at = 0;
    do {
        const std::size_t run = std::min<std::size_t>(data.size() - at, 65535);
        bytes.push_back(at + run == data.size() ? 1 : 0);
        append_little(bytes, static_cast<std::uint32_t>(run), 2);
        append_little(bytes, ~static_cast<std::uint32_t>(run), 2);
        bytes.insert(bytes.end(), data.begin() + static_cast<std::ptrdiff_t>(at),
                     data.begin() + static_cast<std::ptrdiff_t>(at + run));
        at += run;
    } while (at < data.size());
    Adler32 sum;
    sum.add(view_of(data));
    append_big(bytes, sum.value(), 4);
    return bytes;
}

/// A PNG file, chunk by chunk, with right lengths and checksums.
class PngFile {
public:
    Bytes bytes = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};

    PngFile& chunk(const std::string& name, const Bytes& content) {
        append_big(bytes, static_cast<std::uint32_t>(content.size()), 4);
        const std::size_t start = bytes.size();
        append(bytes, bytes_of(name));
        append(bytes, content);
        append_big(bytes, crc32(view_of(bytes).from(static_cast<std::ptrdiff_t>(start))), 4);
        return *this;
    }
    PngFile& header(std::uint32_t width, std::uint32_t height, int depth, int colour, int compression = 0,
                    int filter = 0, int interlace = 0) {
        Bytes fields;
        append_big(fields, width, 4);
        append_big(fields, height, 4);
        for (const int field : {depth, colour, compression, filter, interlace})
            fields.push_back(static_cast<std::uint8_t>(field));
        return chunk("IHDR", fields);
    }
    /// Rows with the number of their filter in front, stored.
    PngFile& rows(const Bytes& filtered) { return chunk("IDAT", zlib_stored(filtered)); }
    PngFile& end() { return chunk("IEND", {}); }
};

}  // namespace fovea::test
