// SPDX-License-Identifier: MIT
#include <vector>

#include <fovea/pixelwise/colour_model.hpp>
#include <fovea/pixelwise/planes.hpp>
#include <fovea/pixelwise/yuv.hpp>

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
    add_operator(1013, "to_lab", Sizes::vga, {}, FOVEA_OPENCV(cv::cvtColor(in[0], out, cv::COLOR_RGB2Lab)));
    add_operator(1014, "rgb_from_lab", Sizes::vga, {},
                 FOVEA_OPENCV(cv::cvtColor(in[0], out, cv::COLOR_Lab2RGB)), "to_rgb of Lab");
    add_operator(1020, "rgb_from_yuyv", Sizes::vga_and_full_hd, {},
                 FOVEA_OPENCV(cv::cvtColor(in[0], out, cv::COLOR_YUV2RGB_YUY2)), "to_rgb of YUYV");
    add_operator(1021, "rgb_from_uyvy", Sizes::vga, {},
                 FOVEA_OPENCV(cv::cvtColor(in[0], out, cv::COLOR_YUV2RGB_UYVY)), "to_rgb of UYVY");
    add_operator(1023, "stretched_gray_from_yuyv", Sizes::vga, {}, {}, "to_gray of YUYV, narrow range");
    add_operator(1024, "stretched_gray_from_luma", Sizes::vga, {}, {}, "to_gray of luma, narrow range");
    add_operator(1030, "rgb565_to_rgb", Sizes::vga, {},
                 FOVEA_OPENCV(cv::cvtColor(in[0], out, cv::COLOR_BGR5652RGB)));
    add_operator(1031, "rgb565_to_gray", Sizes::vga, {},
                 FOVEA_OPENCV(cv::cvtColor(in[0], out, cv::COLOR_BGR5652GRAY)));
    add_operator(1040, "demosaic", Sizes::vga_and_full_hd, {},
                 FOVEA_OPENCV(cv::cvtColor(in[0], out, cv::COLOR_BayerRG2RGB)));
    add_operator(1041, "demosaic_half", Sizes::vga, {}, {});
    add_operator(1050, "hsv_range", Sizes::vga, {},
                 FOVEA_OPENCV(cv::inRange(in[0], cv::Scalar(0, 64, 32), cv::Scalar(30, 255, 255), out)));
    add_operator(1051, "hsv_range_of_rgb", Sizes::vga, {},
                 FOVEA_OPENCV(cv::Mat hsv; cv::cvtColor(in[0], hsv, cv::COLOR_RGB2HSV);
                              cv::inRange(hsv, cv::Scalar(0, 64, 32), cv::Scalar(30, 255, 255), out)),
                 "hsv_range of RGB");
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

struct Nv12 {
    explicit Nv12(Size size) : bytes(static_cast<std::size_t>(size.area() * 3 / 2)), dst(size) {
        Picture<Gray8> gray = part(size);
        for (std::size_t i = 0; i < bytes.size(); ++i)
            bytes[i] = i < static_cast<std::size_t>(size.area()) ? gray.data()[i]
                                                                 : static_cast<std::uint8_t>(90 + i % 77);
        luma = {bytes.data(), size, size.width};
        chroma = {reinterpret_cast<ChromaPair*>(bytes.data() + size.area()), chroma_size(size), size.width};
    }

    Bytes bytes;
    Picture<Rgb888> dst;
    ImageView<Gray8> luma;
    ImageView<ChromaPair> chroma;
};

const bool nv12_added = add(1022, "to_rgb of NV12", Sizes::vga, [](Row& row) {
    auto& image = row.keep(Nv12(row.size()));
    row.ours([&] { consume(to_rgb(image.luma, image.chroma, YuvRange::narrow, image.dst.view())); });
#if defined(FOVEA_HAVE_OPENCV)
    const cv::Mat both(row.size().height * 3 / 2, row.size().width, CV_8UC1, image.bytes.data());
    row.peer("OpenCV",
             [both, out = mat(image.dst)]() mutable { cv::cvtColor(both, out, cv::COLOR_YUV2RGB_NV12); });
#endif
});

const bool model_added = add(1052, "colour_model_range", Sizes::vga, [](Row& row) {
    auto& src = row.keep(coloured_part(row.size()));
    auto& dst = row.keep(Picture<Gray8>(row.size()));
    auto& model = row.keep(*learn_colour(src.view()));
    row.ours([&] { consume(colour_model_range(src.view(), model, 4 << 16, dst.view())); });
});

const bool learn_added = add(1053, "learn_colour", Sizes::vga, [](Row& row) {
    auto& src = row.keep(coloured_part(row.size()));
    row.ours([&] { consume(learn_colour(src.view())); });
});

}  // namespace
}  // namespace fovea::bench
