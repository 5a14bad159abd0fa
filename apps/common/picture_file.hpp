// SPDX-License-Identifier: MIT
//
// Pictures in files: grey ones to measure in, coloured ones to look at.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <fovea/base/status.hpp>
#include <fovea/codec/any_picture.hpp>
#include <fovea/codec/png_writer.hpp>
#include <fovea/codec/pnm.hpp>
#include <fovea/image/image_view.hpp>

#include <common/io.hpp>
#include <common/text.hpp>

namespace fovea::apps {

/// An image on the heap.
template <class Pixel>
struct Picture {
    Size size;
    std::vector<Pixel> pixels;

    Picture() = default;
    explicit Picture(Size s) : size(s), pixels(static_cast<std::size_t>(s.area())) {}
    ImageView<Pixel> view() { return {pixels.data(), size, stride()}; }
    ImageView<const Pixel> view() const { return {pixels.data(), size, stride()}; }

private:
    std::ptrdiff_t stride() const { return static_cast<std::ptrdiff_t>(sizeof(Pixel)) * size.width; }
};

/// Reads a picture as brightness. problem says why there is none.
template <class Storage>
bool load_gray(Storage& storage, const std::string& name, Picture<Gray8>& picture, std::string& problem) {
    const Result<Span<const std::uint8_t>> bytes = storage.load(name.c_str());
    if (!bytes) {
        problem = file_problem(name, bytes.status(), storage);
        return false;
    }
    const PictureFormat format = picture_format(*bytes);
    if (format == PictureFormat::unknown) {
        problem = name + ": not a picture that fovea reads: PGM, PPM, BMP, PNG or baseline JPEG";
        return false;
    }
    const Result<PictureInfo> info = inspect_picture(*bytes);
    Status status = info.status();
    if (info) {
        picture = Picture<Gray8>(info->size);
        std::vector<std::uint8_t> scratch(static_cast<std::size_t>(info->scratch_bytes));
        status = decode_picture(*bytes, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())},
                                picture.view());
    }
    if (status == Status::ok) return true;
    problem = name + ": " + describe(status) + " (" + describe(format) + ")";
    return false;
}

/// Writes a picture: PGM or PPM if the name says so, else PNG.
template <class Storage, class Pixel>
bool save_picture(Storage& storage, const std::string& name, const Picture<Pixel>& picture,
                  std::string& problem) {
    const auto ends_with = [&](const char* ending) {
        const std::string e = ending;
        return name.size() >= e.size() && name.compare(name.size() - e.size(), e.size(), e) == 0;
    };
    const bool pnm = ends_with(".pgm") || ends_with(".ppm");
    const std::int64_t room =
        pnm ? encoded_pnm_bytes<Pixel>(picture.size) : encoded_png_bytes<Pixel>(picture.size);
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(room));
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(png_writer_scratch(picture.size)));
    const Span<std::uint8_t> out(bytes.data(), static_cast<std::ptrdiff_t>(bytes.size()));
    const Result<std::ptrdiff_t> length =
        pnm ? encode_pnm(picture.view(), out)
            : encode_png(picture.view(), {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}, out);
    Status status = length.status();
    if (length) status = storage.save(name.c_str(), Span<const std::uint8_t>(out.first(*length)));
    if (status == Status::ok) return true;
    problem = file_problem(name, status, storage);
    return false;
}

}  // namespace fovea::apps
