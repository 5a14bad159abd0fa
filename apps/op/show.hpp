// SPDX-License-Identifier: MIT
//
// Pixels of any kind as a picture that can be looked at.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>

#include <common/picture_file.hpp>
#include <op/pipeline.hpp>

namespace fovea::apps {

namespace detail {

/// Numbers as grey levels: lowest to highest as 0 to 255, or, where some are negative, zero as 128.
template <class Number>
Picture<Gray8> numbers_shown(const AnyPicture& from, std::string& note) {
    Picture<Gray8> shown(from.size);
    std::int64_t low = 0;
    std::int64_t high = 0;
    const auto at = [&](std::size_t i) {
        Number number;
        std::memcpy(&number, from.bytes.data() + i * sizeof number, sizeof number);
        return static_cast<std::int64_t>(number);
    };
    for (std::size_t i = 0; i < shown.pixels.size(); ++i) {
        low = std::min(low, at(i));
        high = std::max(high, at(i));
    }
    const std::int64_t most = std::max<std::int64_t>({high, -low, 1});
    for (std::size_t i = 0; i < shown.pixels.size(); ++i) {
        const std::int64_t level = low < 0 ? 128 + (at(i) * 127 + (at(i) < 0 ? -most : most) / 2) / most
                                           : (at(i) * 255 + most / 2) / most;
        shown.pixels[i] = static_cast<Gray8>(level);
    }
    note = ", which shows numbers from " + std::to_string(low) + " to " + std::to_string(high);
    return shown;
}

template <class Pixel>
Picture<Pixel> as_picture(const AnyPicture& from) {
    Picture<Pixel> picture(from.size);
    std::memcpy(picture.pixels.data(), from.bytes.data(), from.bytes.size());
    return picture;
}

/// Pixels of one number in grey levels; false for others.
inline bool shown_in_gray(const AnyPicture& picture, Picture<Gray8>& shown, std::string& note) {
    switch (picture.kind) {
        case PixelKind::gray8: shown = as_picture<Gray8>(picture); return true;
        case PixelKind::gray16: shown = numbers_shown<Gray16>(picture, note); return true;
        case PixelKind::gradient16: shown = numbers_shown<Gradient16>(picture, note); return true;
        case PixelKind::response32: shown = numbers_shown<Response32>(picture, note); return true;
        case PixelKind::sum32: shown = numbers_shown<Sum32>(picture, note); return true;
        default: return false;
    }
}
/// Pixels of three numbers as red, green and blue; false for others.
inline bool has_three_numbers(PixelKind kind, std::string& note) {
    if (kind == PixelKind::hsv888) note = ", whose red, green and blue are hue, saturation and value";
    if (kind == PixelKind::lab888) note = ", whose red, green and blue are lightness, a and b";
    return kind == PixelKind::rgb888 || kind == PixelKind::hsv888 || kind == PixelKind::lab888;
}

}  // namespace detail

/// Writes pixels of any kind; note says what a person could not guess.
template <class Storage>
bool save_shown(Storage& storage, const std::string& name, const AnyPicture& picture, std::string& note,
                std::string& problem) {
    Picture<Gray8> gray;
    if (detail::has_three_numbers(picture.kind, note))
        return save_picture(storage, name, detail::as_picture<Rgb888>(picture), problem);
    if (detail::shown_in_gray(picture, gray, note)) return save_picture(storage, name, gray, problem);
    problem = std::string("there is no picture of ") + describe(picture.kind);
    return false;
}

/// Pixels of any kind in the colours that save_shown() writes.
inline bool shown_in_colour(const AnyPicture& picture, Picture<Rgb888>& shown, std::string& problem) {
    std::string note;
    Picture<Gray8> gray;
    if (detail::has_three_numbers(picture.kind, note)) {
        shown = detail::as_picture<Rgb888>(picture);
        return true;
    }
    if (detail::shown_in_gray(picture, gray, note)) {
        shown = Picture<Rgb888>(gray.size);
        std::transform(gray.pixels.begin(), gray.pixels.end(), shown.pixels.begin(), [](Gray8 level) {
            return Rgb888{level, level, level};
        });
        return true;
    }
    problem = std::string("there is no picture of ") + describe(picture.kind);
    return false;
}

}  // namespace fovea::apps
