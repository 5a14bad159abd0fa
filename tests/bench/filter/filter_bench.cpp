// SPDX-License-Identifier: MIT
#include <bench/operators.hpp>

namespace fovea::bench {
namespace {

constexpr Sizes both = Sizes::vga_and_full_hd;

#if defined(FOVEA_HAVE_OPENCV)
const float sharp_weights[] = {-1, -2, 0, -2, 6, 2, 0, 2, 1};
const float wide_weights[] = {1, 200, 1, 200, -300, 200, 1, 200, 1};
void opencv_convolve(const cv::Mat& in, cv::Mat& out, const float* weights, float divisor) {
    const cv::Mat kernel = cv::Mat(3, 3, CV_32F, const_cast<float*>(weights)) / divisor;
    cv::filter2D(in, out, out.depth(), kernel, {-1, -1}, 0, cv::BORDER_REPLICATE);
}
#endif

// OpenCV with the same border, into the same pixels; its strength of a gradient takes five calls.
const bool lines[] = {
    add_operator(200, "gaussian_3x3", both, {},
                 FOVEA_OPENCV(cv::GaussianBlur(in[0], out, {3, 3}, 0, 0, cv::BORDER_REPLICATE))),
    add_operator(201, "gaussian_5x5", both, {},
                 FOVEA_OPENCV(cv::GaussianBlur(in[0], out, {5, 5}, 0, 0, cv::BORDER_REPLICATE))),
    add_operator(206, "gaussian", both, {200},
                 FOVEA_OPENCV(cv::GaussianBlur(in[0], out, {13, 13}, 2, 2, cv::BORDER_REPLICATE)),
                 "gaussian of sigma 2"),
    add_operator(207, "difference_of_gaussians", both, {0, 200}, FOVEA_OPENCV({
                     static cv::Mat mean;
                     cv::GaussianBlur(in[0], mean, {13, 13}, 2, 2, cv::BORDER_REPLICATE);
                     cv::absdiff(in[0], mean, out);
                 }),
                 "difference from the gaussian of sigma 2"),
    add_operator(202, "box_3x3", both, {},
                 FOVEA_OPENCV(cv::blur(in[0], out, {3, 3}, {-1, -1}, cv::BORDER_REPLICATE))),
    add_operator(203, "box_5x5", both, {},
                 FOVEA_OPENCV(cv::blur(in[0], out, {5, 5}, {-1, -1}, cv::BORDER_REPLICATE))),
    add_operator(204, "box", both, {15, 15},
                 FOVEA_OPENCV(cv::blur(in[0], out, {15, 15}, {-1, -1}, cv::BORDER_REPLICATE)), "box 15x15"),
    add_operator(205, "box", both, {31, 31},
                 FOVEA_OPENCV(cv::blur(in[0], out, {31, 31}, {-1, -1}, cv::BORDER_REPLICATE)), "box 31x31"),
    add_operator(210, "median_3x3", both, {}, FOVEA_OPENCV(cv::medianBlur(in[0], out, 3))),
    add_operator(211, "median_5x5", both, {}, FOVEA_OPENCV(cv::medianBlur(in[0], out, 5))),
    add_operator(212, "median", both, {7, 7}, FOVEA_OPENCV(cv::medianBlur(in[0], out, 7)), "median 7x7"),
    add_operator(213, "median", both, {15, 15}, FOVEA_OPENCV(cv::medianBlur(in[0], out, 15)), "median 15x15"),
    add_operator(214, "median", both, {31, 31}, FOVEA_OPENCV(cv::medianBlur(in[0], out, 31)), "median 31x31"),
    add_operator(215, "convolve_3x3", both, {-1, -2, 0, -2, 6, 2, 0, 2, 1, 5},
                 FOVEA_OPENCV(opencv_convolve(in[0], out, sharp_weights, 5)), "convolve 3x3"),
    add_operator(216, "convolve_3x3", Sizes::vga, {1, 200, 1, 200, -300, 200, 1, 200, 1, 504},
                 FOVEA_OPENCV(opencv_convolve(in[0], out, wide_weights, 504)), "convolve 3x3, large weights"),
    add_operator(217, "convolve_3x3_signed", both, {-1, -2, 0, -2, 6, 2, 0, 2, 1, 5},
                 FOVEA_OPENCV(opencv_convolve(in[0], out, sharp_weights, 5)), "convolve 3x3, signed"),
    add_operator(218, "bilateral", both, {2, 200, 25},
                 FOVEA_OPENCV(cv::bilateralFilter(in[0], out, 5, 25, 2, cv::BORDER_REPLICATE)),
                 "bilateral of radius 2"),
    add_operator(219, "bilateral", Sizes::vga, {4, 300, 25},
                 FOVEA_OPENCV(cv::bilateralFilter(in[0], out, 9, 25, 3, cv::BORDER_REPLICATE)),
                 "bilateral of radius 4"),
    add_operator(220, "sobel_x", both, {},
                 FOVEA_OPENCV(cv::Sobel(in[0], out, CV_16S, 1, 0, 3, 1, 0, cv::BORDER_REPLICATE))),
    add_operator(221, "sobel_y", both, {},
                 FOVEA_OPENCV(cv::Sobel(in[0], out, CV_16S, 0, 1, 3, 1, 0, cv::BORDER_REPLICATE))),
    add_operator(222, "scharr_x", both, {},
                 FOVEA_OPENCV(cv::Scharr(in[0], out, CV_16S, 1, 0, 1, 0, cv::BORDER_REPLICATE))),
    add_operator(223, "scharr_y", Sizes::vga, {},
                 FOVEA_OPENCV(cv::Scharr(in[0], out, CV_16S, 0, 1, 1, 0, cv::BORDER_REPLICATE))),
    add_operator(224, "prewitt_x", Sizes::vga, {}, {}),
    add_operator(225, "prewitt_y", Sizes::vga, {}, {}),
    add_operator(226, "difference_x", Sizes::vga, {}, {}),
    add_operator(227, "difference_y", Sizes::vga, {}, {}),
    add_operator(230, "sobel_magnitude", both, {}, FOVEA_OPENCV({
                     static cv::Mat x, y, a, b;
                     cv::Sobel(in[0], x, CV_16S, 1, 0, 3, 1, 0, cv::BORDER_REPLICATE);
                     cv::Sobel(in[0], y, CV_16S, 0, 1, 3, 1, 0, cv::BORDER_REPLICATE);
                     cv::convertScaleAbs(x, a);
                     cv::convertScaleAbs(y, b);
                     cv::add(a, b, out);
                 })),
    add_operator(231, "sobel_maximum", Sizes::vga, {}, {}),
    add_operator(232, "prewitt_maximum", Sizes::vga, {}, {}),
    add_operator(233, "difference_maximum", Sizes::vga, {}, {}),
    add_operator(234, "gradient_direction", both, {}, FOVEA_OPENCV({
                     static cv::Mat x, y, angle;
                     cv::Sobel(in[0], x, CV_32F, 1, 0, 3, 1, 0, cv::BORDER_REPLICATE);
                     cv::Sobel(in[0], y, CV_32F, 0, 1, 3, 1, 0, cv::BORDER_REPLICATE);
                     cv::phase(x, y, angle);
                 })),
    add_operator(240, "laplacian_4", both, {},
                 FOVEA_OPENCV(cv::Laplacian(in[0], out, CV_16S, 1, 1, 0, cv::BORDER_REPLICATE))),
    add_operator(241, "laplacian_8", both, {}, {}),
};

}  // namespace
}  // namespace fovea::bench
