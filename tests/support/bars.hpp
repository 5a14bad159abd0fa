// SPDX-License-Identifier: MIT
//
// Bar codes to read: their edges along a line, and pictures of them.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/code/bar_reading.hpp>
#include <fovea/code/code_128_encoder.hpp>
#include <fovea/code/ean_encoder.hpp>
#include <fovea/code/two_width_encoder.hpp>
#include <fovea/image/image_view.hpp>

namespace fovea::test {

inline Span<const std::uint8_t> bytes_of(const std::string& text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), static_cast<std::ptrdiff_t>(text.size())};
}
inline std::string text_of(const BarReading& reading) { return {reading.text, reading.text + reading.size}; }

/// Widths in modules, with room for the longest code.
struct Bars {
    std::uint8_t widths[2048] = {};
    int count = 0;

    BarWidths view() { return {widths, 2048, &count}; }
    std::string modules() const {
        std::string text;
        for (int i = 0; i < count; ++i) text += std::string(widths[i], i % 2 == 0 ? '1' : '0');
        return text;
    }
};

/// The bars of a text in its symbology; none where it does not fit.
inline Bars bars_of(Symbology symbology, const std::string& text, const TwoWidthOptions& two = {}) {
    Bars bars;
    Status status = Status::unsupported;
    switch (symbology) {
        case Symbology::ean_13: status = encode_ean_13(bytes_of(text), bars.view()); break;
        case Symbology::ean_8: status = encode_ean_8(bytes_of(text), bars.view()); break;
        case Symbology::upc_a: status = encode_upc_a(bytes_of(text), bars.view()); break;
        case Symbology::upc_e: status = encode_upc_e(bytes_of(text), bars.view()); break;
        case Symbology::code_128:
            status = encode_code_128(bytes_of(text), Code128Kind::plain, bars.view());
            break;
        case Symbology::code_39:
            status = encode_code_39(bytes_of(text), Code39Text::plain, two, bars.view());
            break;
        case Symbology::interleaved_2_of_5:
            status = encode_interleaved(bytes_of(text), two, bars.view());
            break;
        case Symbology::codabar: status = encode_codabar(bytes_of(text), two, bars.view()); break;
        default: break;
    }
    if (status != Status::ok) bars.count = 0;
    return bars;
}

/// The symbologies of bars, and a text in each.
struct BarSample {
    Symbology symbology;
    const char* text;
};
inline constexpr BarSample bar_samples[] = {{Symbology::ean_13, "9780905705712"},
                                            {Symbology::ean_8, "55123457"},
                                            {Symbology::upc_a, "023942431015"},
                                            {Symbology::upc_e, "01234565"},
                                            {Symbology::code_128, "Fovea 2026/0042"},
                                            {Symbology::code_39, "LOT-42 A/7"},
                                            {Symbology::interleaved_2_of_5, "30712345000010"},
                                            {Symbology::codabar, "31117013206375"}};

/// The edges of bars along a line, in 1/256 px: a quiet zone, the bars, a quiet zone. Bars are wider by gain.
inline std::vector<std::int32_t> edges_of(const Bars& bars, int module, int quiet = 12, int gain = 0) {
    std::vector<std::int32_t> edges = {0};
    std::int32_t at = quiet * module;
    edges.push_back(at - gain / 2);
    for (int i = 0; i < bars.count; ++i) {
        at += bars.widths[i] * module;
        edges.push_back(at + (i % 2 == 0 ? gain / 2 : -(gain / 2)));
    }
    edges.push_back(at + quiet * module);
    return edges;
}
inline BarEdges span_of(const std::vector<std::int32_t>& edges) {
    return {edges.data(), static_cast<std::ptrdiff_t>(edges.size())};
}

/// How a code is drawn.
struct BarScene {
    double module = 2.5;  ///< px
    double degrees = 0;   ///< turned by
    double height = 60;   ///< px
    double blur = 0.6;    ///< deviation in px
    double noise = 2;     ///< deviation in grey levels
    double dark = 50;     ///< level of the bars
    double light = 200;   ///< level of the ground
    double x = 0, y = 0;  ///< of its middle from that of the image
};

struct BarPicture {
    Size size;
    std::vector<Gray8> pixels;

    explicit BarPicture(Size s) : size(s), pixels(static_cast<std::size_t>(s.area()), Gray8{200}) {}
    ImageView<Gray8> view() { return {pixels.data(), size, size.width}; }
    ImageView<const Gray8> view() const { return {pixels.data(), size, size.width}; }
};

/// Draws bars over what a picture holds, as far as they and their quiet zones reach.
inline void draw_bars(BarPicture& picture, const Bars& bars, const BarScene& scene, Random& random) {
    const double turn = scene.degrees * 3.14159265358979 / 180;
    std::vector<double> edges = {0};
    for (int i = 0; i < bars.count; ++i) edges.push_back(edges.back() + bars.widths[i] * scene.module);
    const double length = edges.back();
    const auto cdf = [&](double distance) { return std::erf(distance / (scene.blur * std::sqrt(2.0))) / 2; };
    for (int y = 0; y < picture.size.height; ++y)
        for (int x = 0; x < picture.size.width; ++x) {
            const double dx = x - (picture.size.width - 1) / 2.0 - scene.x;
            const double dy = y - (picture.size.height - 1) / 2.0 - scene.y;
            const double u = dx * std::cos(turn) + dy * std::sin(turn) + length / 2;
            const double v = dy * std::cos(turn) - dx * std::sin(turn);
            if (u < -12 * scene.module || u > length + 12 * scene.module) continue;
            if (std::abs(v) > scene.height / 2) continue;
            double dark = 0;
            for (std::size_t i = 0; i + 1 < edges.size(); i += 2)
                dark += cdf(edges[i + 1] - u) - cdf(edges[i] - u);
            double noise = 0;
            for (int i = 0; i < 12; ++i) noise += random.below(1000) / 1000.0 - 0.4995;
            const double level = scene.light + (scene.dark - scene.light) * dark + noise * scene.noise;
            picture.view()(x, y) = static_cast<Gray8>(std::lround(std::fmin(255, std::fmax(0, level))));
        }
}

}  // namespace fovea::test
