// SPDX-License-Identifier: MIT
#include <fovea/pixelwise/planes.hpp>

#include <bench/operators.hpp>

namespace fovea::bench {
namespace {

const bool colour_added = [] {
    add_operator(1000, "to_gray_fast", Sizes::vga, {}, {});
    add_operator(1001, "gray_from_uyvy", Sizes::vga, {},
                 FOVEA_OPENCV(cv::cvtColor(in[0], out, cv::COLOR_YUV2GRAY_UYVY)), "to_gray of UYVY");
    add_operator(1002, "rgb_from_gray", Sizes::vga, {},
                 FOVEA_OPENCV(cv::cvtColor(in[0], out, cv::COLOR_GRAY2RGB)), "to_rgb of gray");
    add_operator(1003, "extract_plane", Sizes::vga, {1}, FOVEA_OPENCV(cv::extractChannel(in[0], out, 1)));
    add_operator(1010, "to_hsv", Sizes::vga_and_full_hd, {},
                 FOVEA_OPENCV(cv::cvtColor(in[0], out, cv::COLOR_RGB2HSV)));
    add_operator(1011, "rgb_from_hsv", Sizes::vga, {},
                 FOVEA_OPENCV(cv::cvtColor(in[0], out, cv::COLOR_HSV2RGB)), "to_rgb of HSV");
    add_operator(1012, "to_saturation", Sizes::vga, {}, {});
    return true;
}();

struct Planes {
    Picture<Rgb888> colour;
    Picture<Gray8> red;
    Picture<Gray8> green;
    Picture<Gray8> blue;
};
Planes planes(Size size) {
    return {coloured_part(size), Picture<Gray8>(size), Picture<Gray8>(size), Picture<Gray8>(size)};
}

const bool split_added = add(1004, "split_planes", Sizes::vga_and_full_hd, [](Row& row) {
    auto& p = row.keep(planes(row.size()));
    row.ours([&] { consume(split_planes(p.colour.view(), p.red.view(), p.green.view(), p.blue.view())); });
#if defined(FOVEA_HAVE_OPENCV)
    row.peer("OpenCV", [colour = mat(p.colour),
                        planes = std::vector<cv::Mat>{mat(p.red), mat(p.green), mat(p.blue)}]() mutable {
        cv::split(colour, planes.data());
    });
#endif
});

const bool merge_added = add(1005, "merge_planes", Sizes::vga_and_full_hd, [](Row& row) {
    auto& p = row.keep(planes(row.size()));
    row.ours([&] { consume(merge_planes(p.red.view(), p.green.view(), p.blue.view(), p.colour.view())); });
#if defined(FOVEA_HAVE_OPENCV)
    row.peer("OpenCV", [colour = mat(p.colour),
                        planes = std::vector<cv::Mat>{mat(p.red), mat(p.green), mat(p.blue)}]() mutable {
        cv::merge(planes.data(), 3, colour);
    });
#endif
});

}  // namespace
}  // namespace fovea::bench
