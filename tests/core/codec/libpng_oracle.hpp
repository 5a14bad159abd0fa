// SPDX-License-Identifier: MIT
//
// What libpng reads and writes, to compare with. What is transparent is put on white, 16 bits are rounded to
// 8, gamma stays.
#pragma once

#include <png.h>

#include <cmath>
#include <csetjmp>
#include <cstdint>
#include <cstring>
#include <vector>

#include <fovea/image/geometry.hpp>

#include "lossless_files.hpp"

namespace fovea::test {

struct LibpngPicture {
    bool read = false;
    Size size;
    bool gray = false;
    int file_depth = 0;
    Bytes samples;  ///< 8 bits, one or three a pixel
};

namespace libpng_detail {

struct Reading {
    const Bytes* file;
    std::size_t at;
};
inline void read_some(png_structp png, png_bytep to, std::size_t count) {
    auto* reading = static_cast<Reading*>(png_get_io_ptr(png));
    if (count > reading->file->size() - reading->at) png_error(png, "the end of the file");
    std::memcpy(to, reading->file->data() + reading->at, count);
    reading->at += count;
}
inline void write_some(png_structp png, png_bytep from, std::size_t count) {
    auto* file = static_cast<Bytes*>(png_get_io_ptr(png));
    file->insert(file->end(), from, from + count);
}
inline void flush_nothing(png_structp) {}
inline void fail(png_structp png, png_const_charp) { png_longjmp(png, 1); }
inline void warn(png_structp, png_const_charp) {}

/// Samples with alpha behind them, of one byte or of two, as bytes without it.
inline void put_on_white(LibpngPicture& picture) {
    const std::size_t bytes = picture.file_depth == 16 ? 2 : 1;
    const std::size_t channels = picture.gray ? 1 : 3;
    const double most = bytes == 2 ? 65535 : 255;
    const auto sample = [&](std::size_t i) {
        const std::uint8_t* at = picture.samples.data() + i * bytes;
        return bytes == 2 ? at[0] * 256.0 + at[1] : at[0];
    };
    const std::size_t pixels = picture.samples.size() / bytes / (channels + 1);
    for (std::size_t pixel = 0; pixel < pixels; ++pixel)
        for (std::size_t k = 0; k < channels; ++k) {
            const double share = sample(pixel * (channels + 1) + channels) / most;
            const double seen = std::round(most - (most - sample(pixel * (channels + 1) + k)) * share);
            picture.samples[pixel * channels + k] = static_cast<std::uint8_t>(std::round(seen * 255 / most));
        }
    picture.samples.resize(pixels * channels);
}

/// Between setjmp and longjmp no object with a destructor is made: all of them live in the caller.
inline bool read_into(png_structp png, png_infop info, LibpngPicture& picture, std::vector<png_bytep>& rows) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_read_info(png, info);
    picture.size = {static_cast<int>(png_get_image_width(png, info)),
                    static_cast<int>(png_get_image_height(png, info))};
    const int colour = png_get_color_type(png, info);
    picture.gray = (colour & PNG_COLOR_MASK_COLOR) == 0;
    picture.file_depth = png_get_bit_depth(png, info);
    const bool alpha = (colour & PNG_COLOR_MASK_ALPHA) != 0;
    if (!alpha) png_set_scale_16(png);
    if (colour == PNG_COLOR_TYPE_PALETTE || !alpha) png_set_strip_alpha(png);
    if (colour == PNG_COLOR_TYPE_PALETTE) png_set_palette_to_rgb(png);
    if (colour == PNG_COLOR_TYPE_GRAY) png_set_expand_gray_1_2_4_to_8(png);
    png_set_interlace_handling(png);
    png_read_update_info(png, info);
    const std::size_t row_bytes = png_get_rowbytes(png, info);
    picture.samples.resize(row_bytes * static_cast<std::size_t>(picture.size.height));
    for (std::size_t y = 0; y < static_cast<std::size_t>(picture.size.height); ++y)
        rows.push_back(picture.samples.data() + y * row_bytes);
    png_read_image(png, rows.data());
    png_read_end(png, info);
    if (alpha) put_on_white(picture);
    return true;
}

}  // namespace libpng_detail

inline LibpngPicture libpng_read(const Bytes& file) {
    LibpngPicture picture;
    std::vector<png_bytep> rows;
    libpng_detail::Reading reading{&file, 0};
    png_structp png =
        png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, libpng_detail::fail, libpng_detail::warn);
    png_infop info = png_create_info_struct(png);
    png_set_read_fn(png, &reading, libpng_detail::read_some);
    picture.read = libpng_detail::read_into(png, info, picture, rows);
    png_destroy_read_struct(&png, &info, nullptr);
    return picture;
}

/// A file of 8 bits gray or colour, with the filters and the compression that libpng takes by default.
inline Bytes libpng_write(const Bytes& samples, Size size, bool gray, int filters = PNG_ALL_FILTERS) {
    Bytes file;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(png, &file, libpng_detail::write_some, libpng_detail::flush_nothing);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, filters);
    png_set_IHDR(png, info, static_cast<png_uint_32>(size.width), static_cast<png_uint_32>(size.height), 8,
                 gray ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_BASE, PNG_FILTER_TYPE_BASE);
    png_write_info(png, info);
    const std::size_t row_bytes = static_cast<std::size_t>(size.width) * (gray ? 1 : 3);
    for (std::size_t y = 0; y < static_cast<std::size_t>(size.height); ++y)
        png_write_row(png, samples.data() + y * row_bytes);
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return file;
}

}  // namespace fovea::test
