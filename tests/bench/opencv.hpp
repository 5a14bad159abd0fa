// SPDX-License-Identifier: MIT
//
// OpenCV over our pictures, where it is installed.
#pragma once

#if defined(FOVEA_HAVE_OPENCV)

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <bench/pictures.hpp>

namespace fovea::bench {

inline cv::Mat mat(Picture<Gray8>& picture) {
    const ImageView<Gray8> view = picture.view();
    return {view.height(), view.width(), CV_8UC1, view.first()};
}
inline cv::Mat mat(Picture<Rgb888>& picture) {
    const ImageView<Rgb888> view = picture.view();
    return {view.height(), view.width(), CV_8UC3, view.first()};
}

}  // namespace fovea::bench

#endif
