// SPDX-License-Identifier: MIT
//
// The catalogue's entries of filter/.
#pragma once

#include <cstdint>

#include <fovea/catalogue/operator.hpp>
#include <fovea/filter/bilateral.hpp>
#include <fovea/filter/box.hpp>
#include <fovea/filter/convolve.hpp>
#include <fovea/filter/difference_of_gaussians.hpp>
#include <fovea/filter/gaussian.hpp>
#include <fovea/filter/gaussian_sigma.hpp>
#include <fovea/filter/gradient_direction.hpp>
#include <fovea/filter/laplacian.hpp>
#include <fovea/filter/median.hpp>
#include <fovea/filter/median_window.hpp>
#include <fovea/filter/sobel.hpp>
#include <fovea/image/border.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {
inline namespace FOVEA_ISA {
namespace catalogue {

inline constexpr OperatorParameter border_choice{
    "border", 0, 2, 0, 1, "what stands outside the image", "replicate|reflect_101|zero"};

inline constexpr OperatorParameter window_width{"width", 1, max_window_rows,
                                                7,       2, "columns of the rectangle, odd"};
inline constexpr OperatorParameter window_height{
    "height", 1, max_window_rows, 7, 2, "rows of the rectangle, odd", nullptr, true};

constexpr Border border_of(int value) {
    return value == 1 ? Border::reflect_101 : value == 2 ? Border::zero : Border::replicate;
}

/// The entry of a filter whose one parameter is the border.
template <class Pixel, Status (*Filter)(ImageView<const Gray8>, Border, Span<std::uint8_t>, ImageView<Pixel>),
          std::int64_t (*Needs)(Size)>
constexpr Operator filter_entry(const char* name, const char* summary, const char* book, PixelKind output) {
    return {name,
            summary,
            book,
            {PixelKind::gray8},
            output,
            {border_choice},
            nullptr,
            [](Size size, const int*) { return Needs(size); },
            [](const OperatorCall& c) {
                return Filter(c.input<Gray8>(), border_of(c.values[0]), c.scratch, c.out<Pixel>());
            }};
}

inline BilateralOptions bilateral_options(const int* values) {
    BilateralOptions options;
    options.radius = values[0];
    options.sigma_space = SubPixel::from_ratio(values[1], 100);
    options.sigma_range = values[2];
    return options;
}

inline constexpr OperatorParameter weight_parameter(const char* name, int preset, const char* text) {
    return {name, -32768, 32767, preset, 1, text};
}

/// The entry of convolve() with nine weights.
template <class Pixel, Status (*Convolve)(ImageView<const Gray8>, const ConvolutionKernel&, Border,
                                          Span<std::uint8_t>, ImageView<Pixel>)>
constexpr Operator convolve_entry(const char* name, const char* summary, int left, int middle, int right,
                                  int divisor, int offset, PixelKind output) {
    return {name,
            summary,
            "2.6.1",
            {PixelKind::gray8},
            output,
            {weight_parameter("upper_left", left, "weight of the pixel above on the left"),
             weight_parameter("upper", middle, "weight of the pixel above"),
             weight_parameter("upper_right", right, "weight of the pixel above on the right"),
             weight_parameter("left", 2 * left, "weight of the pixel on the left"),
             weight_parameter("centre", 2 * middle, "weight of the pixel itself"),
             weight_parameter("right", 2 * right, "weight of the pixel on the right"),
             weight_parameter("lower_left", left, "weight of the pixel below on the left"),
             weight_parameter("lower", middle, "weight of the pixel below"),
             weight_parameter("lower_right", right, "weight of the pixel below on the right"),
             {"divisor", 1, max_convolution_divisor, divisor, 1, "what the sum is divided by"},
             {"offset", -max_convolution_offset, max_convolution_offset, offset, 1, "added to the quotient"},
             border_choice},
            nullptr,
            [](Size size, const int*) {
                return convolve_scratch(size, {3, 3});
            },
            [](const OperatorCall& c) {
                std::int16_t weights[9];
                bool fit = true;
                for (int i = 0; i < 9; ++i) {
                    weights[i] = saturate_cast<std::int16_t>(c.values[i]);
                    fit = fit && weights[i] == c.values[i];
                }
                // Without weights it is refused.
                const ConvolutionKernel kernel{{weights, fit ? 9 : 0}, {3, 3}, c.values[9], c.values[10]};
                return Convolve(c.input<Gray8>(), kernel, border_of(c.values[11]), c.scratch, c.out<Pixel>());
            }};
}

inline constexpr Operator filter[] = {
    convolve_entry<Gray8, convolve>("convolve_3x3", "sum of 3x3 pixels with weights of choice", 1, 2, 1, 16,
                                    0, PixelKind::gray8),
    convolve_entry<Gradient16, convolve>("convolve_3x3_signed", "the same with a sign", -1, 0, 1, 1, 0,
                                         PixelKind::gradient16),
    filter_entry<Gray8, gaussian_3x3, gaussian_3x3_scratch>(
        "gaussian_3x3", "mean weighed by 1 2 1 in both directions", "2.6.2", PixelKind::gray8),
    filter_entry<Gray8, gaussian_5x5, gaussian_5x5_scratch>(
        "gaussian_5x5", "mean weighed by 1 4 6 4 1 in both directions", "2.6.2", PixelKind::gray8),
    {"gaussian",
     "mean weighed by a Gaussian of any sigma",
     "2.6.2",
     {PixelKind::gray8},
     PixelKind::gray8,
     {{"sigma", 30, 1000, 100, 1, "standard deviation, 1/100 px"}, border_choice},
     nullptr,
     [](Size size, const int*) { return gaussian_scratch(size); },
     [](const OperatorCall& c) {
         return gaussian(c.input<Gray8>(), SubPixel::from_ratio(c.values[0], 100), border_of(c.values[1]),
                         c.scratch, c.out<Gray8>());
     }},
    {"difference_of_gaussians",
     "what is finer than one sigma and coarser than another",
     "",
     {PixelKind::gray8},
     PixelKind::gray8,
     {{"fine", 0, 1000, 0, 1, "lower standard deviation, 1/100 px; 0 for the picture itself"},
      {"coarse", 30, 1000, 212, 1, "higher standard deviation, 1/100 px"},
      border_choice},
     nullptr,
     [](Size size, const int*) { return difference_of_gaussians_scratch(size); },
     [](const OperatorCall& c) {
         return difference_of_gaussians(c.input<Gray8>(), SubPixel::from_ratio(c.values[0], 100),
                                        SubPixel::from_ratio(c.values[1], 100), border_of(c.values[2]),
                                        c.scratch, c.out<Gray8>());
     }},
    filter_entry<Gray8, box_3x3, box_3x3_scratch>("box_3x3", "mean of 3x3 pixels", "2.6.2", PixelKind::gray8),
    filter_entry<Gray8, box_5x5, box_5x5_scratch>("box_5x5", "mean of 5x5 pixels", "2.6.2", PixelKind::gray8),
    {"box",
     "mean over a rectangle",
     "2.6.2",
     {PixelKind::gray8},
     PixelKind::gray8,
     {window_width, window_height, border_choice},
     nullptr,
     [](Size size, const int*) { return box_scratch(size); },
     [](const OperatorCall& c) {
         return box(c.input<Gray8>(), {c.values[0], c.values[1]}, border_of(c.values[2]), c.scratch,
                    c.out<Gray8>());
     }},
    filter_entry<Gray8, median_3x3, median_3x3_scratch>("median_3x3", "median of 3x3 pixels", "",
                                                        PixelKind::gray8),
    filter_entry<Gray8, median_5x5, median_5x5_scratch>("median_5x5", "median of 5x5 pixels", "",
                                                        PixelKind::gray8),
    {"median",
     "median over a rectangle",
     "",
     {PixelKind::gray8},
     PixelKind::gray8,
     {window_width, window_height, border_choice},
     nullptr,
     [](Size size, const int* values) {
         return median_scratch(size, {values[0], values[1]});
     },
     [](const OperatorCall& c) {
         return median(c.input<Gray8>(), {c.values[0], c.values[1]}, border_of(c.values[2]), c.scratch,
                       c.out<Gray8>());
     }},
    {"bilateral",
     "mean weighed by distance and by difference, which keeps edges",
     "",
     {PixelKind::gray8},
     PixelKind::gray8,
     {{"radius", 1, max_bilateral_radius, 2, 1, "of the disc of neighbours, px"},
      {"sigma_space", 30, 1000, 200, 1, "standard deviation of distances, 1/100 px"},
      {"sigma_range", 1, 255, 25, 1, "standard deviation of differences, grey levels"},
      border_choice},
     nullptr,
     [](Size size, const int* values) { return bilateral_scratch(size, bilateral_options(values)); },
     [](const OperatorCall& c) {
         return bilateral(c.input<Gray8>(), bilateral_options(c.values), border_of(c.values[3]), c.scratch,
                          c.out<Gray8>());
     }},
    filter_entry<Gradient16, sobel_x, derivative_scratch>(
        "sobel_x", "derivative to the right, smoothed by 1 2 1", "2.6.3", PixelKind::gradient16),
    filter_entry<Gradient16, sobel_y, derivative_scratch>(
        "sobel_y", "derivative downwards, smoothed by 1 2 1", "2.6.3", PixelKind::gradient16),
    filter_entry<Gradient16, prewitt_x, derivative_scratch>(
        "prewitt_x", "derivative to the right, smoothed by 1 1 1", "2.6.3", PixelKind::gradient16),
    filter_entry<Gradient16, prewitt_y, derivative_scratch>(
        "prewitt_y", "derivative downwards, smoothed by 1 1 1", "2.6.3", PixelKind::gradient16),
    filter_entry<Gradient16, scharr_x, derivative_scratch>(
        "scharr_x", "derivative to the right, smoothed by 3 10 3", "", PixelKind::gradient16),
    filter_entry<Gradient16, scharr_y, derivative_scratch>(
        "scharr_y", "derivative downwards, smoothed by 3 10 3", "", PixelKind::gradient16),
    filter_entry<Gradient16, difference_x, derivative_scratch>(
        "difference_x", "the right neighbour less the left", "2.6.3", PixelKind::gradient16),
    filter_entry<Gradient16, difference_y, derivative_scratch>(
        "difference_y", "the lower neighbour less the upper", "2.6.3", PixelKind::gradient16),
    filter_entry<Gray8, sobel_magnitude, gradient_scratch>(
        "sobel_magnitude", "|x| + |y| of Sobel's derivatives", "2.6.3", PixelKind::gray8),
    filter_entry<Gray8, sobel_maximum, gradient_scratch>(
        "sobel_maximum", "larger of |x| and |y| of Sobel's derivatives", "2.6.3", PixelKind::gray8),
    filter_entry<Gray8, prewitt_maximum, gradient_scratch>(
        "prewitt_maximum", "larger of |x| and |y| of Prewitt's derivatives", "2.6.3", PixelKind::gray8),
    filter_entry<Gray8, difference_maximum, gradient_scratch>(
        "difference_maximum", "larger of |x| and |y| of the differences of neighbours", "2.6.3",
        PixelKind::gray8),
    filter_entry<Direction16, gradient_direction, gradient_direction_scratch>(
        "gradient_direction", "angle of Sobel's derivatives, 65536 to the turn", "2.6.3", PixelKind::gray16),
    filter_entry<Gradient16, laplacian_4, laplacian_4_scratch>(
        "laplacian_4", "four neighbours less four times the pixel", "2.6.3", PixelKind::gradient16),
    filter_entry<Gradient16, laplacian_8, laplacian_8_scratch>(
        "laplacian_8", "eight neighbours less eight times the pixel", "2.6.3", PixelKind::gradient16),
};

}  // namespace catalogue
}  // namespace FOVEA_ISA
}  // namespace fovea
