// SPDX-License-Identifier: MIT
//
// tests/target/lines.txt: the frames of the scenes as whole pictures, sent through the same streams at once.
#include <cinttypes>
#include <cstdio>
#include <vector>

#include <target/lines.hpp>

namespace {
struct Printer {
    void operator()(const char* text) const { std::fputs(text, stdout); }
    void operator()(std::int64_t number) const { std::printf(" %" PRId64, number); }
};
}  // namespace

int main() {
    using namespace fovea;
    static target::LineGauge gauge;
    gauge.measure_all(
        [](auto& scene, auto& program, Span<std::uint8_t> scratch) {
            std::vector<Gray8> pixels(static_cast<std::size_t>(scene.size.area()));
            const ImageView<Gray8> picture(pixels.data(), scene.size, scene.size.width);
            for (int y = 0; y < scene.size.height; ++y) scene.take(picture.row(y));
            return program.run(picture, Border::replicate, scratch);
        },
        Printer{});
    return 0;
}
