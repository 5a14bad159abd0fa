// SPDX-License-Identifier: MIT
//
// Photos of codes with their texts, and pictures turned by a quarter. Host tests only.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <fovea/codec/any_picture.hpp>

#include <common/picture_file.hpp>
#include <support/picture.hpp>

namespace fovea::test {

using apps::Picture;

inline Picture<Gray8> load_photo(const std::filesystem::path& path) {
    const std::vector<std::uint8_t> bytes = read_file(path);
    const Span<const std::uint8_t> file(bytes.data(), static_cast<std::ptrdiff_t>(bytes.size()));
    const Result<PictureInfo> info = inspect_picture(file);
    Picture<Gray8> picture;
    if (!info.ok()) return picture;
    picture = Picture<Gray8>(info->size);
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(info->scratch_bytes));
    if (decode_picture(file, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}, picture.view()) !=
        Status::ok) {
        picture = Picture<Gray8>();
    }
    return picture;
}
inline Picture<Gray8> turned(const Picture<Gray8>& picture) {
    Picture<Gray8> result({picture.size.height, picture.size.width});
    for (int y = 0; y < picture.size.height; ++y) {
        for (int x = 0; x < picture.size.width; ++x) {
            result.view()(picture.size.height - 1 - y, x) = picture.view()(x, y);
        }
    }
    return result;
}
/// A text as its file has it: lines end with a line feed, and no blank stands at an end.
inline std::string plain(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c != '\r') result += c;
    }
    const auto is_blank = [](char c) { return c == ' ' || c == '\n' || c == '\t'; };
    while (!result.empty() && is_blank(result.back())) result.pop_back();
    result.erase(result.begin(), std::find_if_not(result.begin(), result.end(), is_blank));
    return result;
}

struct Photo {
    std::string name;
    Picture<Gray8> picture;
    std::string text;
};
/// The photos of a set, by their names; none if it is not here.
inline std::vector<Photo> photos(const std::string& set) {
    std::vector<Photo> result;
    if (!std::filesystem::exists(data_folder() / "codes" / set)) return result;
    for (const auto& entry : std::filesystem::directory_iterator(data_folder() / "codes" / set)) {
        if (entry.path().extension() == ".txt") continue;
        const std::filesystem::path text = std::filesystem::path(entry.path()).replace_extension(".txt");
        const std::vector<std::uint8_t> bytes = read_file(text);
        result.push_back({entry.path().filename().string(), load_photo(entry.path()),
                          plain(std::string(bytes.begin(), bytes.end()))});
    }
    std::sort(result.begin(), result.end(), [](const Photo& a, const Photo& b) { return a.name < b.name; });
    return result;
}

}  // namespace fovea::test
