// SPDX-License-Identifier: MIT
//
// Codes as a camera sees them: at any place and angle, in perspective, on a cylinder, out of focus, in noise
// and under uneven light. Host programs only.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <fovea/base/random.hpp>

#include <common/picture_file.hpp>
#include <make_code/code_modules.hpp>

namespace fovea::test {

/// How a code is seen.
struct CodeView {
    double module = 2;   ///< px, where the code faces the camera
    double blur = 0.2;   ///< deviation of the Gaussian, in modules
    double degrees = 0;  ///< turned in the picture
    double tilt = 0;   ///< degrees about its middle, out of the plane of the picture; near things are larger
    double bend = 0;   ///< degrees of a cylinder that its half width takes, bars along the axis
    double noise = 2;  ///< deviation in grey levels
    double contrast = 150;   ///< grey levels between light and dark modules, about 125
    double light_ratio = 1;  ///< light at the left border of the picture over that at the right
    double x = 0, y = 0;     ///< of its middle from that of the picture, px
    double cut = 0;          ///< share of its width that lies outside of the picture
    double torn = 0;         ///< share of its area that a slanted light sheet covers
    int bar_height = 50;     ///< modules
};

namespace detail {

/// Where a code is dark, in modules from its middle.
class CodePlane {
public:
    CodePlane(const apps::CodeModules& modules, const CodeView& view)
        : modules_(modules),
          view_(view),
          width_(modules.size.width),
          height_(modules.bars ? view.bar_height : modules.size.height) {}
    double width() const { return width_ + 2.0 * modules_.quiet; }
    double height() const { return height_ + (modules_.bars ? 0 : 2.0 * modules_.quiet); }

    bool is_dark(double u, double v) const {
        const double x = u + width_ / 2.0;
        const double y = v + height_ / 2.0;
        if (x < 0 || y < 0 || x >= width_ || y >= height_) return false;
        // A sheet whose edge runs through the code at 30 degrees to its rows.
        if (view_.torn > 0 && y / height_ + 0.58 * (x - width_ / 2.0) / height_ > 1 - view_.torn)
            return false;
        return modules_.is_dark(static_cast<int>(x), modules_.bars ? 0 : static_cast<int>(y));
    }

private:
    const apps::CodeModules& modules_;
    const CodeView& view_;
    int width_;
    int height_;
};

constexpr double degree = 3.14159265358979323846 / 180;

/// The point of the code's plane that a point of the picture shows, both in modules from the middle; false
/// where it shows none.
inline bool plane_point(const CodeView& view, double width, double a, double b, double& u, double& v) {
    u = a;
    v = b;
    if (view.tilt != 0) {
        // The camera is three widths away: a = u cos * d / (d + u sin), b = v * d / (d + u sin).
        const double away = 3 * width;
        const double below = away * std::cos(view.tilt * degree) - a * std::sin(view.tilt * degree);
        if (below <= 0) return false;
        u = a * away / below;
        v = b * (away + u * std::sin(view.tilt * degree)) / away;
    }
    if (view.bend != 0) {
        const double radius = width / 2 / (view.bend * degree);
        if (std::abs(u) >= radius) return false;
        u = radius * std::asin(u / radius);
    }
    return true;
}

/// A Gaussian of a deviation in pixels, over rows and then over columns; the outermost pixels repeat.
inline void blur(std::vector<double>& levels, Size size, double deviation) {
    const int reach = static_cast<int>(std::ceil(4 * deviation));
    if (reach == 0) return;
    std::vector<double> weights;
    double sum = 0;
    for (int i = -reach; i <= reach; ++i) {
        weights.push_back(std::exp(-0.5 * i * i / (deviation * deviation)));
        sum += weights.back();
    }
    std::vector<double> line;
    const auto along = [&](int count, std::size_t first, std::size_t step) {
        line.resize(static_cast<std::size_t>(count));
        for (int i = 0; i < count; ++i) {
            double level = 0;
            for (int k = -reach; k <= reach; ++k)
                level += weights[static_cast<std::size_t>(k + reach)] *
                         levels[first + step * static_cast<std::size_t>(std::clamp(i + k, 0, count - 1))];
            line[static_cast<std::size_t>(i)] = level / sum;
        }
        for (int i = 0; i < count; ++i)
            levels[first + step * static_cast<std::size_t>(i)] = line[static_cast<std::size_t>(i)];
    };
    const auto width = static_cast<std::size_t>(size.width);
    for (int y = 0; y < size.height; ++y) along(size.width, static_cast<std::size_t>(y) * width, 1);
    for (int x = 0; x < size.width; ++x) along(size.height, static_cast<std::size_t>(x), width);
}

}  // namespace detail

/// A picture of a code with its quiet zone and some light ground around it. Each pixel is the mean over its
/// square; blur and noise follow. The sum of twelve uniform numbers is the noise.
inline apps::Picture<Gray8> draw_code(const apps::CodeModules& modules, const CodeView& view,
                                      Random& random) {
    const detail::CodePlane plane(modules, view);
    const double turn = view.degrees * detail::degree;
    const double c = std::cos(turn);
    const double s = std::sin(turn);
    const double wide = (std::abs(c) * plane.width() + std::abs(s) * plane.height() + 4) * view.module;
    const double high = (std::abs(s) * plane.width() + std::abs(c) * plane.height() + 8) * view.module;
    apps::Picture<Gray8> picture({static_cast<int>(std::ceil(wide)), static_cast<int>(std::ceil(high))});
    const Size size = picture.size;
    // Points of a pixel to either side, so that a module is of eight or more.
    const int points = std::max(3, static_cast<int>(std::ceil(8 / view.module)));
    std::vector<double> levels;
    levels.reserve(picture.pixels.size());
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            int dark = 0;
            for (int i = 0; i < points * points; ++i) {
                const double dx = x - (size.width - 1) / 2.0 - view.x + (i % points + 0.5) / points - 0.5;
                const double dy = y - (size.height - 1) / 2.0 - view.y + (i / points + 0.5) / points - 0.5;
                double u = 0;
                double v = 0;
                const bool seen = detail::plane_point(view, plane.width(), (dx * c + dy * s) / view.module,
                                                      (dy * c - dx * s) / view.module, u, v);
                dark += seen && plane.is_dark(u, v) ? 1 : 0;
            }
            levels.push_back(125 + view.contrast * (0.5 - static_cast<double>(dark) / (points * points)));
        }
    }
    detail::blur(levels, size, view.blur * view.module);
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const double right = static_cast<double>(i % static_cast<std::size_t>(size.width)) / size.width;
        double noise = -6;
        for (int k = 0; k < 12; ++k) noise += random.below(65536) / 65536.0;
        const double level = levels[i] * (1 + right * (1 / view.light_ratio - 1)) + noise * view.noise;
        picture.pixels[i] = static_cast<Gray8>(std::lround(std::clamp(level, 0.0, 255.0)));
    }
    if (view.cut <= 0) return picture;
    const auto inside = static_cast<int>(modules.size.width * view.cut * view.module) +
                        static_cast<int>((modules.quiet + 2) * view.module);
    const int kept = std::max(1, size.width - inside);
    const int first = random.below(2) == 0 ? 0 : size.width - kept;
    apps::Picture<Gray8> part({kept, size.height});
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < kept; ++x) part.view()(x, y) = picture.view()(first + x, y);
    return part;
}

}  // namespace fovea::test
