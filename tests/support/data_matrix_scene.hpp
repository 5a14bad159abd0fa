// SPDX-License-Identifier: MIT
//
// Drawn Data Matrix symbols for tests: turned, tilted, blurred.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/code/data_matrix_encode.hpp>
#include <fovea/code/read_data_matrix.hpp>

namespace fovea::test {

struct DataMatrixScene {
    Size size{16, 16};
    std::string text = "fovea 16022";
    double module = 4;  ///< px
    double turn = 0;    ///< radians
    double tilt = 0;    ///< difference of scale from end to end
    int dark = 30;
    int light = 220;
    int noise = 0;
    bool mirrored = false;
    int quiet = 2;  ///< modules
};

struct DrawnImage {
    Size size;
    std::vector<std::uint8_t> pixels;

    ImageView<Gray8> view() { return {pixels.data(), size, size.width}; }
};

/// Each pixel is the mean of 5x5 places.
inline DrawnImage draw(const DataMatrixScene& scene, std::uint64_t seed = 1) {
    static BitStorage<max_data_matrix_side, max_data_matrix_side> modules;
    std::vector<std::uint8_t> scratch(
        static_cast<std::size_t>(data_matrix_encode_scratch(static_cast<std::int64_t>(scene.text.size()))));
    DataMatrixOptions options;
    options.size = scene.size;
    const Result<Size> made = data_matrix_encode(
        {reinterpret_cast<const std::uint8_t*>(scene.text.data()),
         static_cast<std::ptrdiff_t>(scene.text.size())},
        options, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}, modules.view());
    DrawnImage image;
    if (!made) return image;
    const double width = made->width * scene.module;
    const double height = made->height * scene.module;
    const double diagonal = std::sqrt(width * width + height * height);
    const double c = std::cos(scene.turn);
    const double s = std::sin(scene.turn);
    const double margin = 2 * scene.quiet * scene.module + 2;
    image.size = {static_cast<int>((std::abs(c) * width + std::abs(s) * height) * (1 + scene.tilt) + margin),
                  static_cast<int>((std::abs(s) * width + std::abs(c) * height) * (1 + scene.tilt) + margin)};
    image.pixels.resize(static_cast<std::size_t>(image.size.area()));
    Random random(static_cast<std::uint32_t>(seed));
    constexpr int parts = 5;
    for (int y = 0; y < image.size.height; ++y) {
        for (int x = 0; x < image.size.width; ++x) {
            int dark = 0;
            for (int k = 0; k < parts * parts; ++k) {
                const double px = x + (k % parts + 0.5) / parts - image.size.width / 2.0;
                const double py = y + (k / parts + 0.5) / parts - image.size.height / 2.0;
                const double w = 1 + scene.tilt * py / diagonal;
                const double u = (c * px + s * py) / w / scene.module + made->width / 2.0;
                const double v = (c * py - s * px) / w / scene.module + made->height / 2.0;
                const int column = static_cast<int>(std::floor(scene.mirrored ? made->width - u : u));
                const int row = static_cast<int>(std::floor(v));
                const bool inside = column >= 0 && row >= 0 && column < made->width && row < made->height;
                dark += inside && modules.view()(column, row) ? 1 : 0;
            }
            const int level = scene.light + (scene.dark - scene.light) * dark / (parts * parts) +
                              (scene.noise > 0 ? random.between(-scene.noise, scene.noise) : 0);
            image.view()(x, y) = static_cast<std::uint8_t>(clamp(level, 0, 255));
        }
    }
    return image;
}

/// All that was read of an image.
struct DataMatrixFinds {
    Status status = Status::ok;
    std::vector<Code> codes;
    std::vector<std::string> texts;
};
inline DataMatrixFinds find_data_matrix(ImageView<const Gray8> image,
                                        const ReadDataMatrixOptions& options = {}) {
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(read_data_matrix_scratch(image.size())));
    std::vector<std::uint8_t> room(8000);
    CodeText text({room.data(), static_cast<std::ptrdiff_t>(room.size())});
    List<Code, 16> codes;
    ListView<Code> list = codes;
    DataMatrixFinds finds;
    finds.status = read_data_matrix(
        image, options, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}, text, list);
    for (const Code& code : codes) {
        finds.codes.push_back(code);
        finds.texts.emplace_back(reinterpret_cast<const char*>(room.data()) + code.text_first,
                                 static_cast<std::size_t>(code.text_size));
    }
    return finds;
}

/// The first frame that a corner of the image gives.
inline Result<detail::DataMatrixFrame> frame_of(ImageView<const Gray8> image) {
    std::vector<BitWord> words(static_cast<std::size_t>(detail::PassedSides::words(image.size())));
    const detail::PassedSides passed({words.data(), static_cast<std::ptrdiff_t>(words.size())}, image.size());
    std::vector<detail::BorderCorner> corners(64);
    int count = 0;
    const detail::CodeField field(image, false);
    static_cast<void>(scan_row_for_corners(field, image.height() / 2, 0, image.width() - 1, 24, 1 << 20,
                                           passed,
                                           ListView<detail::BorderCorner>(corners.data(), 64, &count)));
    std::vector<std::int16_t> samples(detail::dash_samples);
    std::vector<detail::DashedLine> lines(3);
    detail::WorkBudget budget(image.size(), 4, 1 << 20);
    const detail::FrameScratch scratch{
        {{samples.data(), detail::dash_samples}, lines[0], budget}, lines[1], lines[2]};
    for (int i = 0; i < count; ++i) {
        detail::FrameFinder finder(field, corners[static_cast<std::size_t>(i)], scratch);
        if (finder.find_arms(corners[static_cast<std::size_t>(i)]) != Status::ok) continue;
        const auto frame = finder.find(256);
        if (frame) return frame;
    }
    return Status::not_found;
}

}  // namespace fovea::test
