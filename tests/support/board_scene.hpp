// SPDX-License-Identifier: MIT
//
// Rendered boards, seen by a camera of known place: corners and circles whose truth is known. Host tests
// only.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>

namespace fovea::test {

enum class BoardPattern { checkerboard, circles, asymmetric_circles };

/// A board before a camera. Lengths are squares of the board, or pixels.
struct BoardScene {
    Size picture{320, 240};
    Size board{9, 6};  ///< columns and rows of inner corners or circles
    BoardPattern pattern = BoardPattern::checkerboard;
    double step = 22;       ///< pixels a square has in the middle of the board
    double x = 0, y = 0;    ///< the middle of the board, from the middle of the picture; pixels
    double tilt = 0;        ///< degrees
    double direction = 30;  ///< of the axis that it is tilted about; degrees
    double roll = 0;        ///< of the board in its plane; degrees
    double focal = 1.2;     ///< in widths of the picture
    double k1 = 0, k2 = 0;
    double dark = 40, bright = 210, around = 120;  ///< grey levels
    double margin = 0.7;                           ///< bright rim around the outer squares, squares
    double radius = 0.3;                           ///< of a circle, squares
    double blur = 0.7;                             ///< standard deviation of the lens, px
    double noise = 0;                              ///< standard deviation of the sensor, grey levels
    double light = 1;                              ///< brightness at the left as a share of that at the right
    bool inverted = false;                         ///< dark and bright of the board exchanged
};

/// A place of a board in the picture.
struct Seen {
    double x = 0, y = 0;
};

struct BoardPicture {
    Size size;
    std::vector<Gray8> pixels;

    explicit BoardPicture(Size of) : size(of), pixels(static_cast<std::size_t>(of.area())) {}
    ImageView<Gray8> view() { return {pixels.data(), size, size.width}; }
    ImageView<const Gray8> view() const { return {pixels.data(), size, size.width}; }
};

/// Projects and renders a scene.
class BoardView {
public:
    explicit BoardView(const BoardScene& scene) : scene_(scene) {
        const double to = 3.14159265358979323846 / 180;
        const double a = scene.direction * to;
        const double t = scene.tilt * to;
        const double r = scene.roll * to - a;
        focal_ = scene.focal * scene.picture.width;
        // The columns of Rz(a) Rx(t) Rz(r).
        const double ca = std::cos(a), sa = std::sin(a), ct = std::cos(t), st = std::sin(t), cr = std::cos(r),
                     sr = std::sin(r);
        const double far = focal_ / scene.step;
        map_ = {ca * cr - sa * ct * sr,
                -ca * sr - sa * ct * cr,
                scene.x / scene.step,
                sa * cr + ca * ct * sr,
                -sa * sr + ca * ct * cr,
                scene.y / scene.step,
                st * sr,
                st * cr,
                far};
    }

    /// Where a corner or the centre of a circle is seen.
    Seen operator()(int column, int row) const {
        const Seen at = place(column, row);
        return project(at.x - middle().x, at.y - middle().y);
    }
    /// The place of a corner or circle on the board.
    Seen place(int column, int row) const {
        if (scene_.pattern != BoardPattern::asymmetric_circles)
            return {static_cast<double>(column), static_cast<double>(row)};
        return {2.0 * column + row % 2, static_cast<double>(row)};
    }

    /// Pixels are means over their squares of what the lens has blurred: fields of a third of a pixel are
    /// blurred, since after sampling it would be too late.
    BoardPicture render(Random& random) const {
        const int margin = static_cast<int>(std::ceil(4 * scene_.blur)) + 1;
        const int w = fine * (scene_.picture.width + 2 * margin);
        const int h = fine * (scene_.picture.height + 2 * margin);
        // Places of the board that the corners of fields see; inside of a field they are bilinear.
        std::vector<Seen> above(static_cast<std::size_t>(w) + 1);
        std::vector<Seen> below(static_cast<std::size_t>(w) + 1);
        const auto look = [&](int y, std::vector<Seen>& to) {
            for (int x = 0; x <= w; ++x)
                to[static_cast<std::size_t>(x)] = board_of(static_cast<double>(x) / fine - margin - 0.5,
                                                           static_cast<double>(y) / fine - margin - 0.5);
        };
        const auto index = [w](int x, int y) {
            return static_cast<std::size_t>(y) * static_cast<std::size_t>(w) + static_cast<std::size_t>(x);
        };
        std::vector<float> light(static_cast<std::size_t>(w) * static_cast<std::size_t>(h));
        look(0, above);
        for (int y = 0; y < h; ++y) {
            look(y + 1, below);
            for (int x = 0; x < w; ++x) {
                const std::size_t i = static_cast<std::size_t>(x);
                light[index(x, y)] = static_cast<float>(mean(above[i], above[i + 1], below[i], below[i + 1]));
            }
            std::swap(above, below);
        }
        blur(light, w, h);
        BoardPicture picture(scene_.picture);
        for (int y = 0; y < scene_.picture.height; ++y)
            for (int x = 0; x < scene_.picture.width; ++x) {
                double sum = 0;
                for (int i = 0; i < fine * fine; ++i)
                    sum += static_cast<double>(
                        light[index(fine * (x + margin) + i % fine, fine * (y + margin) + i / fine)]);
                const double share =
                    scene_.light + (1 - scene_.light) * x / std::max(scene_.picture.width - 1, 1);
                const double sensor = scene_.noise > 0 ? scene_.noise * deviate(random) : 0;
                const double level = sum / (fine * fine) * share + sensor;
                picture.view()(x, y) = static_cast<Gray8>(std::clamp(std::lround(level), 0L, 255L));
            }
        return picture;
    }

private:
    static constexpr int fine = 3;
    /// A normal random number: the sum of twelve uniform ones, variance 1.
    static double deviate(Random& random) {
        double sum = -6;
        for (int i = 0; i < 12; ++i) sum += random.next() / 4294967296.0;
        return sum;
    }
    Seen middle() const {
        const Seen last = place(scene_.board.width - 1, scene_.board.height - 1);
        const double more =
            scene_.pattern == BoardPattern::asymmetric_circles && scene_.board.height % 2 != 0;
        return {(last.x + more) / 2, last.y / 2};
    }
    Seen project(double u, double v) const {
        const double z = map_[6] * u + map_[7] * v + map_[8];
        const double x = (map_[0] * u + map_[1] * v + map_[2]) / z;
        const double y = (map_[3] * u + map_[4] * v + map_[5]) / z;
        const double r2 = x * x + y * y;
        const double bend = 1 + r2 * (scene_.k1 + r2 * scene_.k2);
        return {x * bend * focal_ + (scene_.picture.width - 1) / 2.0,
                y * bend * focal_ + (scene_.picture.height - 1) / 2.0};
    }
    /// The place of the board that a pixel sees.
    Seen board_of(double px, double py) const {
        const double xd = (px - (scene_.picture.width - 1) / 2.0) / focal_;
        const double yd = (py - (scene_.picture.height - 1) / 2.0) / focal_;
        double x = xd;
        double y = yd;
        if (scene_.k1 != 0 || scene_.k2 != 0)
            for (int i = 0; i < 12; ++i) {
                const double r2 = x * x + y * y;
                const double bend = 1 + r2 * (scene_.k1 + r2 * scene_.k2);
                x = xd / bend;
                y = yd / bend;
            }
        // x (m6 u + m7 v + m8) = m0 u + m1 v + m2, and so for y.
        const double a = map_[0] - x * map_[6], b = map_[1] - x * map_[7], c = x * map_[8] - map_[2];
        const double d = map_[3] - y * map_[6], e = map_[4] - y * map_[7], f = y * map_[8] - map_[5];
        const double size = a * e - b * d;
        return {(c * e - b * f) / size + middle().x, (a * f - c * d) / size + middle().y};
    }
    double level(double u, double v) const {
        const double lit = scene_.inverted ? scene_.dark : scene_.bright;
        const double print = scene_.inverted ? scene_.bright : scene_.dark;
        const Seen last = place(scene_.board.width - 1, scene_.board.height - 1);
        const double more = scene_.pattern == BoardPattern::asymmetric_circles ? 1 : 0;
        const double rim = 1 + scene_.margin;
        if (u < -rim || v < -rim || u > last.x + more + rim || v > last.y + rim) return scene_.around;
        if (scene_.pattern == BoardPattern::checkerboard) {
            const int i = static_cast<int>(std::floor(u));
            const int j = static_cast<int>(std::floor(v));
            const bool square = i >= -1 && j >= -1 && i < scene_.board.width && j < scene_.board.height;
            return square && (i + j) % 2 == 0 ? print : lit;
        }
        const int row = static_cast<int>(std::lround(v));
        const int shift = scene_.pattern == BoardPattern::circles ? 0 : ((row % 2) + 2) % 2;
        const double pitch = scene_.pattern == BoardPattern::circles ? 1 : 2;
        const int column = static_cast<int>(std::lround((u - shift) / pitch));
        if (row < 0 || column < 0 || row >= scene_.board.height || column >= scene_.board.width) return lit;
        const double dx = u - shift - pitch * column;
        const double dy = v - row;
        return dx * dx + dy * dy < scene_.radius * scene_.radius ? print : lit;
    }
    /// The mean over a field between four places.
    double mean(const Seen& a, const Seen& b, const Seen& c, const Seen& d) const {
        const auto at = [&](double s, double t) {
            const double u = (a.x * (1 - s) + b.x * s) * (1 - t) + (c.x * (1 - s) + d.x * s) * t;
            const double v = (a.y * (1 - s) + b.y * s) * (1 - t) + (c.y * (1 - s) + d.y * s) * t;
            return level(u, v);
        };
        const double first = at(0, 0);
        bool equal = true;
        for (int i = 1; i < 9 && equal; ++i) equal = at(i % 3 * 0.5, i / 3 * 0.5) == first;
        if (equal) return first;
        constexpr int over = 10;
        double sum = 0;
        for (int i = 0; i < over * over; ++i) sum += at((i % over + 0.5) / over, (i / over + 0.5) / over);
        return sum / (over * over);
    }
    void blur(std::vector<float>& light, int w, int h) const {
        if (scene_.blur <= 0) return;
        const double sigma = scene_.blur * fine;
        const int reach = static_cast<int>(std::ceil(4 * sigma));
        std::vector<float> taps;
        double sum = 0;
        for (int i = 0; i <= reach; ++i) sum += std::exp(-i * i / (2 * sigma * sigma)) * (i == 0 ? 1 : 2);
        for (int i = -reach; i <= reach; ++i)
            taps.push_back(static_cast<float>(std::exp(-i * i / (2 * sigma * sigma)) / sum));
        const auto pass = [&](int count, int lines, std::size_t next, std::size_t next_line) {
            const std::size_t pad = static_cast<std::size_t>(reach);
            std::vector<float> line(static_cast<std::size_t>(count) + 2 * pad);
            for (int l = 0; l < lines; ++l) {
                float* first = light.data() + static_cast<std::size_t>(l) * next_line;
                for (std::size_t i = 0; i < line.size(); ++i) {
                    const int from = std::clamp(static_cast<int>(i) - reach, 0, count - 1);
                    line[i] = first[static_cast<std::size_t>(from) * next];
                }
                for (int i = 0; i < count; ++i) {
                    float total = 0;
                    for (std::size_t k = 0; k < taps.size(); ++k)
                        total += taps[k] * line[static_cast<std::size_t>(i) + k];
                    first[static_cast<std::size_t>(i) * next] = total;
                }
            }
        };
        pass(w, h, 1, static_cast<std::size_t>(w));
        pass(h, w, static_cast<std::size_t>(w), 1);
    }

    BoardScene scene_;
    double focal_ = 1;
    std::vector<double> map_;
};

}  // namespace fovea::test
