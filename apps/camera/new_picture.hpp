// SPDX-License-Identifier: MIT
//
// Pictures as a pinhole would have taken them, grey or in colour as they are.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <fovea/base/status.hpp>
#include <fovea/camera/undistortion_map.hpp>
#include <fovea/codec/any_picture.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/warp/remap.hpp>

#include <camera/camera_file.hpp>
#include <common/io.hpp>
#include <common/picture_file.hpp>

namespace fovea::apps {

/// A map for all pixels, and how many of them see nothing of the camera's picture.
struct PictureMap {
    std::vector<MapPoint> points;
    Size size;
    std::int64_t empty_pixels = 0;

    ImageView<const MapPoint> view() const {
        return {points.data(), size, static_cast<std::ptrdiff_t>(sizeof(MapPoint)) * size.width};
    }
};

/// Makes the map of a view of a camera whose pictures have a size.
inline Status make_map(const LensInverse<>& lens, const Matrix<3, 3>& rotation, const Camera<>& view,
                       Size picture, Size output, PictureMap& result) {
    const Result<UndistortionMap> map = undistortion_map(lens, rotation, view, output);
    if (!map) return map.status();
    result.size = output;
    result.points.resize(static_cast<std::size_t>(output.area()));
    if (Status s = undistortion_points(*map, {result.points.data(), output,
                                              static_cast<std::ptrdiff_t>(sizeof(MapPoint)) * output.width});
        s != Status::ok)
        return s;
    result.empty_pixels = 0;
    // Half a pixel beyond the last centres belongs to a picture.
    const auto inside = [](SubPixel place, int side) {
        return place.raw() >= -128 && place.raw() < 256 * side - 128;
    };
    for (const MapPoint& point : result.points)
        if (!inside(point.x, picture.width) || !inside(point.y, picture.height)) ++result.empty_pixels;
    return Status::ok;
}

/// A picture in colour, or in grey if the file has no colour.
struct FilePicture {
    bool colour = false;
    Picture<Gray8> gray;
    Picture<Rgb888> rgb;

    Size size() const { return colour ? rgb.size : gray.size; }
};

/// Reads a picture as what it is. If there is none, problem says why.
template <class Storage>
bool load_file_picture(Storage& storage, const std::string& name, FilePicture& picture,
                       std::string& problem) {
    picture = FilePicture();
    const Result<Span<const std::uint8_t>> bytes = storage.load(name.c_str());
    if (bytes) {
        const Result<PictureInfo> info = inspect_picture(*bytes);
        picture.colour =
            info && (info->content == PictureContent::rgb888 || info->content == PictureContent::rgb48);
    }
    return picture.colour ? load_picture(storage, name, max_image_side, picture.rgb, problem)
                          : load_picture(storage, name, max_image_side, picture.gray, problem);
}

/// The picture by the map; what the camera did not see is black.
inline FilePicture mapped(const FilePicture& picture, const PictureMap& map) {
    FilePicture result;
    result.colour = picture.colour;
    const auto warp = [&](const auto& from, auto& to) {
        to = std::decay_t<decltype(to)>(map.size);
        using Pixel = typename decltype(to.pixels)::value_type;
        // Sizes were checked when the picture and the map were made.
        static_cast<void>(remap<Pixel>(from.view(), map.view(), {}, to.view()));
    };
    if (picture.colour)
        warp(picture.rgb, result.rgb);
    else
        warp(picture.gray, result.gray);
    return result;
}

template <class Storage>
bool save_file_picture(Storage& storage, const std::string& name, const FilePicture& picture,
                       std::string& problem) {
    return picture.colour ? save_picture(storage, name, picture.rgb, problem)
                          : save_picture(storage, name, picture.gray, problem);
}

/// "a/b.jpg" and "undistorted" make "a/b-undistorted.png".
inline std::string named_after(const std::string& name, const std::string& what) {
    const std::size_t slash = name.rfind('/');
    const std::size_t start = slash == std::string::npos ? 0 : slash + 1;
    const std::size_t dot = name.rfind('.');
    return name.substr(0, dot != std::string::npos && dot > start ? dot : name.size()) + "-" + what + ".png";
}

inline std::string size_text(Size size) {
    return std::to_string(size.width) + "x" + std::to_string(size.height);
}

/// Focal lengths and principal point as members of a JSON object.
inline std::string view_json(const Camera<>& view) {
    return "\"fx_px\":" + real_text(view.fx, 9) + ",\"fy_px\":" + real_text(view.fy, 9) +
           ",\"cx_px\":" + real_text(view.cx, 9) + ",\"cy_px\":" + real_text(view.cy, 9);
}
inline std::string view_text(const Camera<>& view) {
    return "fx " + real_text(view.fx, 7) + ", fy " + real_text(view.fy, 7) + ", cx " + real_text(view.cx, 7) +
           ", cy " + real_text(view.cy, 7) + " px";
}

}  // namespace fovea::apps
