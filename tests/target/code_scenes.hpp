// SPDX-License-Identifier: MIT
//
// Frames with codes as a camera over a conveyor sees them: 640x480 with bars, line by line, and 320x240 with
// QR codes.
#pragma once

#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/base/list.hpp>
#include <fovea/base/random.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/code/ean_encoder.hpp>
#include <fovea/code/qr_encode.hpp>
#include <fovea/image/bit_view.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/pixel.hpp>

namespace fovea::target {

/// What a frame shows.
enum class CodeScene : std::uint8_t { code, upside_down, turned, light, noise };

inline Gray8 level_of(bool dark, Random& random) {
    return static_cast<Gray8>((dark ? 40 : 200) + static_cast<int>(random.next() >> 28));
}
inline Gray8 noise_level(Random& random) { return static_cast<Gray8>(random.next() >> 24); }

/// EAN-13 with modules of four pixels over half of the lines, a little slanted, with noise of four bits.
class BarScene {
public:
    static constexpr Size size{640, 480};

    explicit BarScene(CodeScene scene) : scene_(scene), random_(80) {
        const std::uint8_t digits[12] = {'9', '7', '8', '0', '9', '0', '5', '7', '0', '5', '7', '1'};
        static_cast<void>(encode_ean_13(digits, widths_));
    }

    /// The next line, from the top.
    void take(Gray8* line) {
        const bool bars = y_ >= 120 && y_ < 360 && scene_ != CodeScene::light;
        int x = 0;
        const auto draw = [&](int end, bool dark) {
            for (; x < end && x < size.width; ++x)
                line[scene_ == CodeScene::upside_down ? size.width - 1 - x : x] =
                    scene_ == CodeScene::noise ? noise_level(random_) : level_of(dark, random_);
        };
        if (bars) {
            draw(120 + y_ / 16, false);
            for (int i = 0; i < widths_.size(); ++i) draw(x + 4 * widths_[i], i % 2 == 0);
        }
        draw(size.width, false);
        ++y_;
    }

private:
    CodeScene scene_;
    Random random_;
    List<std::uint8_t, 64> widths_;
    int y_ = 0;
};

/// A symbol in the middle, with noise of four bits.
class QrScene {
public:
    static constexpr Size size{320, 240};

    QrScene(CodeScene scene, int version, int module)
        : scene_(scene), module_(module), random_(static_cast<unsigned>(90 + version)) {
        const std::uint8_t text[10] = {'P', '/', 'N', ' ', '4', '7', '1', '1', ' ', 'a'};
        std::uint8_t scratch[qr_encode_scratch(sizeof text)];
        QrEncodeOptions options;
        options.min_version = version;
        options.mask = 3;
        const Result<BitView<BitWord>> symbol = qr_encode(text, options, scratch, modules_.view());
        modules_across_ = symbol ? symbol->width() : 0;
    }

    /// The next line, from the top.
    void take(Gray8* line) {
        // In 1/256 module, around the middle of both; a direction of 3, 4 and 5 is turned by 37 degrees.
        const int along = scene_ == CodeScene::turned ? 205 : scene_ == CodeScene::upside_down ? -256 : 256;
        const int across = scene_ == CodeScene::turned ? 154 : 0;
        const int middle = modules_across_ * 128;
        for (int x = 0; x < size.width; ++x) {
            const int dx = 2 * x + 1 - size.width;
            const int dy = 2 * y_ + 1 - size.height;
            const int u = (dx * along + dy * across) / (2 * module_) + middle;
            const int v = (dy * along - dx * across) / (2 * module_) + middle;
            const bool inside =
                scene_ != CodeScene::light && u >= 0 && v >= 0 && u < 2 * middle && v < 2 * middle;
            line[x] = scene_ == CodeScene::noise
                          ? noise_level(random_)
                          : level_of(inside && modules_.view()(u / 256, v / 256), random_);
        }
        ++y_;
    }

private:
    CodeScene scene_;
    int module_;
    Random random_;
    BitStorage<qr_size(6), qr_size(6)> modules_;
    int modules_across_ = 0;
    int y_ = 0;
};

}  // namespace fovea::target
