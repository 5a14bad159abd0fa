// SPDX-License-Identifier: MIT
#include <cstdio>
#include <cstdlib>
#include <string>

#include <fovea/codec/bmp.hpp>
#include <fovea/codec/jpeg.hpp>
#include <fovea/codec/png_reader.hpp>
#include <fovea/codec/png_writer.hpp>
#include <fovea/codec/pnm.hpp>

#include <bench/harness.hpp>
#include <bench/pictures.hpp>

#if defined(FOVEA_HAVE_LIBJPEG)
#include <jpeglib.h>
#endif
#if defined(FOVEA_HAVE_LIBPNG)
#include <png.h>
#endif

namespace fovea::bench {
namespace {

[[maybe_unused]] std::string percent(std::size_t part, std::size_t whole) {
    return std::to_string((part * 100 + whole / 2) / whole) + " %";
}

// ---- JPEG ---------------------------------------------------------------------------------

#if defined(FOVEA_HAVE_LIBJPEG)

/// As cameras send it: quality 85, colours sampled half as finely both ways.
Bytes jpeg_file(const std::uint8_t* pixels, Size size, int components) {
    jpeg_compress_struct encoder;
    jpeg_error_mgr errors;
    encoder.err = jpeg_std_error(&errors);
    jpeg_create_compress(&encoder);
    unsigned char* out = nullptr;
    unsigned long length = 0;
    jpeg_mem_dest(&encoder, &out, &length);
    encoder.image_width = static_cast<JDIMENSION>(size.width);
    encoder.image_height = static_cast<JDIMENSION>(size.height);
    encoder.input_components = components;
    encoder.in_color_space = components == 1 ? JCS_GRAYSCALE : JCS_RGB;
    jpeg_set_defaults(&encoder);
    jpeg_set_quality(&encoder, 85, TRUE);
    jpeg_start_compress(&encoder, TRUE);
    for (int y = 0; y < size.height; ++y) {
        auto* row =
            const_cast<std::uint8_t*>(pixels) + static_cast<std::ptrdiff_t>(y) * size.width * components;
        jpeg_write_scanlines(&encoder, &row, 1);
    }
    jpeg_finish_compress(&encoder);
    jpeg_destroy_compress(&encoder);
    Bytes file(out, out + length);
    std::free(out);
    return file;
}

void libjpeg_decode(const Bytes& file, J_COLOR_SPACE colours, std::uint8_t* pixels, std::ptrdiff_t stride) {
    jpeg_decompress_struct decoder;
    jpeg_error_mgr errors;
    decoder.err = jpeg_std_error(&errors);
    jpeg_create_decompress(&decoder);
    jpeg_mem_src(&decoder, file.data(), static_cast<unsigned long>(file.size()));
    jpeg_read_header(&decoder, TRUE);
    decoder.out_color_space = colours;
    jpeg_start_decompress(&decoder);
    while (decoder.output_scanline < decoder.output_height) {
        auto* row = pixels + static_cast<std::ptrdiff_t>(decoder.output_scanline) * stride;
        jpeg_read_scanlines(&decoder, &row, 1);
    }
    jpeg_finish_decompress(&decoder);
    jpeg_destroy_decompress(&decoder);
}

template <class Pixel>
void time_jpeg(Row& row, Bytes made, J_COLOR_SPACE colours) {
    auto& file = row.keep(std::move(made));
    auto& dst = row.keep(Picture<Pixel>(row.size()));
    auto& scratch = row.keep(bytes(jpeg_scratch(row.size())));
    row.ours([&] {
        if (decode_jpeg(span_of(file), span_of(scratch), dst.view()) != Status::ok) std::abort();
    });
    row.peer("libjpeg-turbo", [&, colours] {
        libjpeg_decode(file, colours, reinterpret_cast<std::uint8_t*>(dst.data()), dst.view().stride_bytes());
    });
}

const bool jpeg_gray_added = add(70, "decode JPEG, gray", Sizes::vga, [](Row& row) {
    Picture<Gray8> src = part(row.size());
    time_jpeg<Gray8>(row, jpeg_file(src.data(), row.size(), 1), JCS_GRAYSCALE);
});
const bool jpeg_luma_added = add(71, "decode JPEG, gray of a colour file", Sizes::vga, [](Row& row) {
    Picture<Rgb888> src = coloured_part(row.size());
    time_jpeg<Gray8>(row, jpeg_file(&src.data()->red, row.size(), 3), JCS_GRAYSCALE);
});
const bool jpeg_rgb_added = add(72, "decode JPEG, RGB", Sizes::vga, [](Row& row) {
    Picture<Rgb888> src = coloured_part(row.size());
    time_jpeg<Rgb888>(row, jpeg_file(&src.data()->red, row.size(), 3), JCS_RGB);
});

#endif

// ---- PNG ----------------------------------------------------------------------------------

#if defined(FOVEA_HAVE_LIBPNG)

/// The simplified interface of libpng 1.6.
png_image libpng_image(Size size) {
    png_image image = {};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(size.width);
    image.height = static_cast<png_uint_32>(size.height);
    image.format = PNG_FORMAT_GRAY;
    return image;
}
std::size_t libpng_encode(Size size, const std::uint8_t* pixels, Bytes& out) {
    png_image image = libpng_image(size);
    png_alloc_size_t length = out.size();
    if (png_image_write_to_memory(&image, out.data(), &length, 0, pixels, 0, nullptr) == 0) std::abort();
    return length;
}
void libpng_decode(const Bytes& file, std::uint8_t* pixels) {
    png_image image = libpng_image({});
    if (png_image_begin_read_from_memory(&image, file.data(), file.size()) == 0) std::abort();
    image.format = PNG_FORMAT_GRAY;
    if (png_image_finish_read(&image, nullptr, pixels, 0, nullptr) == 0) std::abort();
}

#endif

Bytes png_file(Picture<Gray8>& src) {
    const Size size = src.view().size();
    Bytes file(static_cast<std::size_t>(encoded_png_bytes<Gray8>(size)));
    Bytes scratch = bytes(png_writer_scratch(size));
    const auto length = encode_png(ImageView<const Gray8>(src.view()), span_of(scratch), span_of(file));
    if (!length) std::abort();
    file.resize(static_cast<std::size_t>(*length));
    return file;
}

const bool png_read_added = add(73, "decode PNG, gray", Sizes::vga, [](Row& row) {
    auto& src = row.keep(part(row.size()));
    auto& file = row.keep(png_file(src));
    auto& dst = row.keep(Picture<Gray8>(row.size()));
    auto& scratch = row.keep(bytes(png_reader_scratch(row.size())));
    row.ours([&] {
        if (decode_png(span_of(file), span_of(scratch), dst.view()) != Status::ok) std::abort();
    });
#if defined(FOVEA_HAVE_LIBPNG)
    row.peer("libpng, zlib", [&] { libpng_decode(file, dst.data()); });
#endif
});

const bool png_write_added = add(74, "encode PNG, gray", Sizes::vga, [](Row& row) {
    auto& src = row.keep(part(row.size()));
    auto& out = row.keep(bytes(encoded_png_bytes<Gray8>(row.size())));
    auto& scratch = row.keep(bytes(png_writer_scratch(row.size())));
    row.ours([&] {
        if (!encode_png(ImageView<const Gray8>(src.view()), span_of(scratch), span_of(out))) std::abort();
    });
#if defined(FOVEA_HAVE_LIBPNG)
    row.peer("libpng, zlib", [&] { libpng_encode(row.size(), src.data(), out); });
    row.remark("the file has " + percent(png_file(src).size(), libpng_encode(row.size(), src.data(), out)) +
               " of libpng's bytes");
#endif
});

// ---- BMP, PNM -----------------------------------------------------------------------------

template <class Decode, class Encode>
void time_both_ways(Row& row, std::int64_t file_bytes, Decode decode, Encode encode) {
    auto& src = row.keep(coloured_part(row.size()));
    auto& dst = row.keep(Picture<Rgb888>(row.size()));
    auto& file = row.keep(bytes(file_bytes));
    row.ours([&, decode, encode] {
        if (!encode(ImageView<const Rgb888>(src.view()), span_of(file)) ||
            decode(span_of(file), dst.view()) != Status::ok)
            std::abort();
    });
}

const bool bmp_added = add(75, "encode and decode BMP, RGB", Sizes::vga, [](Row& row) {
    time_both_ways(
        row, encoded_bmp_bytes<Rgb888>(row.size()), [](auto file, auto dst) { return decode_bmp(file, dst); },
        [](auto src, auto out) { return encode_bmp(src, out); });
});
const bool pnm_added = add(76, "encode and decode PPM", Sizes::vga, [](Row& row) {
    time_both_ways(
        row, encoded_pnm_bytes<Rgb888>(row.size()), [](auto file, auto dst) { return decode_pnm(file, dst); },
        [](auto src, auto out) { return encode_pnm(src, out); });
});

}  // namespace
}  // namespace fovea::bench
