// SPDX-License-Identifier: MIT
//
// QR codes drawn into gray images, as a camera sees them: turned, tilted, blurred, in uneven light.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/code/qr_encode.hpp>
#include <fovea/code/read_qr.hpp>
#include <support/render.hpp>

namespace fovea::test {

/// A symbol of its own memory.
class DrawnQr {
public:
    explicit DrawnQr(const std::string& text, const QrEncodeOptions& options = {}) {
        const std::vector<std::uint8_t> bytes(text.begin(), text.end());
        std::vector<std::uint8_t> scratch(
            static_cast<std::size_t>(qr_encode_scratch(static_cast<std::int64_t>(bytes.size()))));
        const auto symbol =
            qr_encode({bytes.data(), static_cast<std::ptrdiff_t>(bytes.size())}, options,
                      {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}, words_.view());
        size_ = symbol ? symbol->width() : 0;
    }
    int size() const { return size_; }
    bool dark(double x, double y) const {
        const int column = static_cast<int>(std::floor(x));
        const int row = static_cast<int>(std::floor(y));
        return column >= 0 && row >= 0 && column < size_ && row < size_ && words_.view()(column, row);
    }

private:
    BitStorage<max_qr_size, max_qr_size> words_;
    int size_ = 0;
};

/// How a camera sees a symbol.
struct QrPose {
    double x = 0;  ///< of its middle, px
    double y = 0;
    double module = 4;  ///< px, at its middle
    double angle = 0;   ///< radians
    double tilt_x = 0;  ///< how much farther away its sides are than its middle, as a share
    double tilt_y = 0;
    bool mirrored = false;

    /// Where a place of the symbol is in the image.
    void project(int size, double& u, double& v) const {
        const double a = (mirrored ? -1 : 1) * (u - size / 2.0);
        const double b = v - size / 2.0;
        const double depth = 1 + (tilt_x * a + tilt_y * b) * 2 / size;
        u = x + module * (std::cos(angle) * a - std::sin(angle) * b) / depth;
        v = y + module * (std::sin(angle) * a + std::cos(angle) * b) / depth;
    }
    /// And back.
    void modules_of(int size, double& px, double& py) const {
        const double a = (std::cos(angle) * (px - x) + std::sin(angle) * (py - y)) / module;
        const double b = (-std::sin(angle) * (px - x) + std::cos(angle) * (py - y)) / module;
        const double depth = 1 / std::max(0.02, 1 - (tilt_x * a + tilt_y * b) * 2 / size);
        px = (mirrored ? -1 : 1) * a * depth + size / 2.0;
        py = b * depth + size / 2.0;
    }
};

/// A picture that is drawn into and read.
class QrScene {
public:
    explicit QrScene(int width, int height, double ground = 220)
        : size_{width, height},
          levels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), ground) {}

    double& level(int x, int y) {
        return levels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.width) +
                       static_cast<std::size_t>(x)];
    }
    /// Each pixel the mean of 4x4 places in it.
    void draw(const DrawnQr& symbol, const QrPose& pose, double ink = 30) {
        for_each([&](int x, int y, double& value) {
            double mean = 0;
            for (int i = 0; i < 16; ++i) {
                double u = x - 0.375 + i % 4 * 0.25;
                double v = y - 0.375 + i / 4 * 0.25;
                pose.modules_of(symbol.size(), u, v);
                mean += (symbol.dark(u, v) ? ink : value) / 16;
            }
            value = mean;
        });
    }
    void for_each(const std::function<void(int, int, double&)>& change) {
        for (int y = 0; y < size_.height; ++y)
            for (int x = 0; x < size_.width; ++x) change(x, y, level(x, y));
    }
    void blur(double sigma) {
        const int reach = static_cast<int>(std::ceil(3 * sigma));
        for (const bool across : {true, false}) {
            QrScene before = *this;
            for_each([&](int x, int y, double& value) {
                double sum = 0;
                double weights = 0;
                for (int i = -reach; i <= reach; ++i) {
                    const double weight = std::exp(-i * i / (2 * sigma * sigma));
                    sum += weight * before.level(std::clamp(x + (across ? i : 0), 0, size_.width - 1),
                                                 std::clamp(y + (across ? 0 : i), 0, size_.height - 1));
                    weights += weight;
                }
                value = sum / weights;
            });
        }
    }
    void add_noise(Random& random, double sigma) {
        for_each([&](int, int, double& value) { value += sigma * normal(random); });
    }

    std::vector<Gray8> pixels() const {
        std::vector<Gray8> result(levels_.size());
        for (std::size_t i = 0; i < levels_.size(); ++i)
            result[i] = static_cast<Gray8>(std::lround(std::clamp(levels_[i], 0.0, 255.0)));
        return result;
    }
    Size size() const { return size_; }

private:
    Size size_;
    std::vector<double> levels_;
};

/// What read_qr() answers for a picture.
struct QrAnswer {
    Status status = Status::ok;
    std::vector<Code> codes;
    std::vector<std::string> texts;
};
inline QrAnswer read_scene(const QrScene& scene, const ReadQrOptions& options = {}) {
    const std::vector<Gray8> pixels = scene.pixels();
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(read_qr_scratch(scene.size(), options)));
    std::vector<std::uint8_t> room(8000);
    CodeText text({room.data(), static_cast<std::ptrdiff_t>(room.size())});
    List<Code, 8> codes;
    QrAnswer answer;
    answer.status = read_qr(ImageView<const Gray8>(pixels.data(), scene.size(), scene.size().width), options,
                            {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}, text, codes);
    for (const Code& code : codes) {
        answer.codes.push_back(code);
        const Span<const std::uint8_t> bytes = text.bytes().from(code.text_first).first(code.text_size);
        answer.texts.emplace_back(bytes.begin(), bytes.end());
    }
    return answer;
}

}  // namespace fovea::test
