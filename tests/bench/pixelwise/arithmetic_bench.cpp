// SPDX-License-Identifier: MIT
#include <fovea/pixelwise/copy.hpp>
#include <fovea/pixelwise/lookup_table.hpp>

#include <bench/operators.hpp>

namespace fovea::bench {
namespace {

#if defined(FOVEA_HAVE_OPENCV)
/// The table of OpenCV for a power of the brightness.
[[maybe_unused]] cv::Mat table_of(int gamma) {
    const LookupTable levels = gamma_table(gamma);
    cv::Mat table(1, 256, CV_8UC1);
    for (int x = 0; x < 256; ++x) table.at<std::uint8_t>(0, x) = levels[x];
    return table;
}
#else
[[maybe_unused]] int table_of(int) { return 0; }
#endif

const bool added = [] {
    [[maybe_unused]] const auto table = table_of(45);
    add_operator(1200, "absolute_difference", Sizes::vga_and_full_hd, {},
                 FOVEA_OPENCV(cv::absdiff(in[0], in[1], out)));
    add_operator(1201, "add", Sizes::vga, {}, Peer());
    add_operator(1202, "add_saturated", Sizes::vga, {}, FOVEA_OPENCV(cv::add(in[0], in[1], out)));
    add_operator(1203, "subtract", Sizes::vga, {}, Peer());
    add_operator(1204, "subtract_saturated", Sizes::vga, {}, FOVEA_OPENCV(cv::subtract(in[0], in[1], out)));
    add_operator(1205, "average", Sizes::vga, {},
                 FOVEA_OPENCV(cv::addWeighted(in[0], 0.5, in[1], 0.5, 0, out)));
    add_operator(1206, "pixel_minimum", Sizes::vga, {}, FOVEA_OPENCV(cv::min(in[0], in[1], out)));
    add_operator(1207, "pixel_maximum", Sizes::vga, {}, FOVEA_OPENCV(cv::max(in[0], in[1], out)));
    add_operator(1208, "blend", Sizes::vga, {77},
                 FOVEA_OPENCV(cv::addWeighted(in[0], 179.0 / 256, in[1], 77.0 / 256, 0, out)));
    add_operator(1209, "bitwise_and", Sizes::vga_and_full_hd, {},
                 FOVEA_OPENCV(cv::bitwise_and(in[0], in[1], out)));
    add_operator(1210, "bitwise_or", Sizes::vga, {}, FOVEA_OPENCV(cv::bitwise_or(in[0], in[1], out)));
    add_operator(1211, "bitwise_xor", Sizes::vga, {}, FOVEA_OPENCV(cv::bitwise_xor(in[0], in[1], out)));
    add_operator(1212, "invert", Sizes::vga, {}, FOVEA_OPENCV(cv::bitwise_not(in[0], out)));
    add_operator(1213, "threshold_filter", Sizes::vga, {100},
                 FOVEA_OPENCV(cv::threshold(in[0], out, 99, 0, cv::THRESH_TOZERO)));
    add_operator(1214, "threshold_filter_inverse", Sizes::vga, {100},
                 FOVEA_OPENCV(cv::threshold(in[0], out, 99, 0, cv::THRESH_TOZERO_INV)));
    add_operator(1220, "gamma", Sizes::vga_and_full_hd, {45},
                 FOVEA_OPENCV_KEEPING(table, cv::LUT(in[0], table, out)), "apply_lut of a gamma table");
    add_operator(1221, "affine", Sizes::vga, {150, -20}, FOVEA_OPENCV(in[0].convertTo(out, CV_8U, 1.5, -20)));
    add_operator(1222, "amplify", Sizes::vga, {150}, FOVEA_OPENCV(in[0].convertTo(out, CV_8U, 1.5)));
    add_operator(1223, "logarithm", Sizes::vga, {}, Peer());
    add_operator(1230, "copy", Sizes::vga_and_full_hd, {}, FOVEA_OPENCV(in[0].copyTo(out)));
    add_operator(1231, "replicate_frame", Sizes::vga, {1}, Peer());
    add_operator(1232, "widen_to_gray16", Sizes::vga, {}, FOVEA_OPENCV(in[0].convertTo(out, CV_16U)));
    add_operator(1233, "narrow_gray16", Sizes::vga, {4}, FOVEA_OPENCV(in[0].convertTo(out, CV_8U, 1.0 / 16)));
    add_operator(1234, "narrow_about_128", Sizes::vga, {4},
                 FOVEA_OPENCV(in[0].convertTo(out, CV_8U, 1.0 / 16, 128)));
    return true;
}();

const bool lut_added = add(1219, "apply_lut", Sizes::vga_and_full_hd, [](Row& row) {
    auto& src = row.keep(part(row.size()));
    auto& dst = row.keep(Picture<Gray8>(row.size()));
    auto& table = row.keep(gamma_table(45));
    row.ours([&] { consume(apply_lut(src.view(), table, dst.view())); });
#if defined(FOVEA_HAVE_OPENCV)
    row.peer("OpenCV", [a = mat(src), b = mat(dst), t = table_of(45)]() mutable { cv::LUT(a, t, b); });
#endif
});

const bool fill_added = add(1235, "fill", Sizes::vga, [](Row& row) {
    auto& dst = row.keep(Picture<Gray8>(row.size()));
    row.ours([&] { consume(fill(Gray8{7}, dst.view())); });
#if defined(FOVEA_HAVE_OPENCV)
    row.peer("OpenCV", [b = mat(dst)]() mutable { b.setTo(7); });
#endif
});

}  // namespace
}  // namespace fovea::bench
