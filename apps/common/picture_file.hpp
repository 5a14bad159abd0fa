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
#include <fovea/statistics/moments.hpp>

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

/// Reads a picture as brightness or as colour, with sides of at most most_side pixels. If there is none,
/// problem says why and the picture is empty.
template <class Pixel, class Storage>
bool load_picture(Storage& storage, const std::string& name, int most_side, Picture<Pixel>& picture,
                  std::string& problem) {
    picture = Picture<Pixel>();
    const Result<Span<const std::uint8_t>> bytes = storage.load(name.c_str());
    if (!bytes) {
        problem = file_problem(name, bytes.status(), storage);
        return false;
    }
    const PictureFormat format = picture_format(*bytes);
    if (format == PictureFormat::unknown) {
        problem =
            name + (bytes->empty() ? ": the file is empty"
                                   : ": not a picture that fovea reads: PGM, PPM, BMP, PNG or baseline JPEG");
        return false;
    }
    const Result<PictureInfo> info = inspect_picture(*bytes);
    Status status = info.status();
    if (info && (info->size.width > most_side || info->size.height > most_side))
        status = Status::image_too_large;
    if (status == Status::ok) {
        picture = Picture<Pixel>(info->size);
        std::vector<std::uint8_t> scratch(static_cast<std::size_t>(info->scratch_bytes));
        status = decode_picture(*bytes, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())},
                                picture.view());
    }
    if (status == Status::ok) return true;
    picture = Picture<Pixel>();
    problem = name + ": " + describe(status) + " (" + describe(format) + ")";
    if (status == Status::unsupported)
        problem +=
            format == PictureFormat::jpeg ? "; save it as PNG or as baseline JPEG" : "; save it as PNG";
    if (status == Status::image_too_large)
        problem += "; sides are at most " + std::to_string(most_side) + " pixels";
    return false;
}

/// Reads a picture to measure in, as brightness.
template <class Storage>
bool load_gray(Storage& storage, const std::string& name, Picture<Gray8>& picture, std::string& problem) {
    return load_picture(storage, name, max_moment_side, picture, problem);
}

/// True if a name ends with one of the endings in "a|b|c", capitals or not.
inline bool ends_with_one_of(const std::string& name, const char* endings) {
    for (const std::string& ending : split(endings, '|'))
        if (name.size() >= ending.size() && small_letters(name.substr(name.size() - ending.size())) == ending)
            return true;
    return false;
}

/// Why save_picture() would refuse a name: it promises a format that is not written. "" if it would not.
inline std::string picture_name_problem(const std::string& name) {
    if (!ends_with_one_of(name, ".jpg|.jpeg|.bmp|.tif|.tiff|.gif|.webp")) return "";
    return name + ": fovea writes PNG, PGM and PPM; name it .png";
}

/// Writes a picture: PGM or PPM if the name says so, else PNG. Refuses a name that promises another format.
template <class Storage, class Pixel>
bool save_picture(Storage& storage, const std::string& name, const Picture<Pixel>& picture,
                  std::string& problem) {
    if (const std::string refusal = picture_name_problem(name); !refusal.empty()) {
        problem = refusal;
        return false;
    }
    const bool pnm = ends_with_one_of(name, ".pgm|.ppm|.pnm");
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

/// "a/b.png" and 2 make "a/b-2.png".
inline std::string numbered(const std::string& name, std::size_t number) {
    const std::size_t dot = name.rfind('.');
    const std::size_t slash = name.rfind('/');
    const std::size_t start = slash == std::string::npos ? 0 : slash + 1;
    const bool has_ending = dot != std::string::npos && dot > start;
    const std::string ending = has_ending ? name.substr(dot) : "";
    return name.substr(0, name.size() - ending.size()) + "-" + std::to_string(number) + ending;
}

}  // namespace fovea::apps
