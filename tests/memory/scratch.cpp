// SPDX-License-Identifier: MIT
//
// Prints the table of scratch in docs/memory.md: bytes that the operators ask of their caller.
#include <cstdint>
#include <cstdio>
#include <functional>

#include <fovea/codec/jpeg.hpp>
#include <fovea/codec/png_reader.hpp>
#include <fovea/codec/png_writer.hpp>
#include <fovea/decision/gauge.hpp>
#include <fovea/measure/edge_probe.hpp>
#include <fovea/morphology/morphology.hpp>
#include <fovea/segment/connected_components.hpp>

using namespace fovea;

int main() {
    constexpr Size sizes[] = {{160, 120}, {320, 240}, {640, 480}, {1920, 1080}};
    LocateRule opened;
    opened.opening = 3;
    const struct {
        const char* name;
        std::function<std::int64_t(Size)> bytes;
    } operators[] = {
        {"threshold, to_gray, histogram, moments, contours, lines, labels", [](Size) { return 0; }},
        {"erode, dilate", [](Size size) { return erode_scratch(size); }},
        {"opening, closing", [](Size size) { return opening_scratch(size); }},
        {"connected_components", [](Size size) { return connected_components_scratch(size.width); }},
        {"connected_components, 64 labels",
         [](Size size) { return connected_components_scratch(size.width, 64); }},
        {"edge_probe", [](Size size) { return std::int64_t{2} * edge_probe_scratch(size); }},
        {"find_parts", [](Size size) { return find_parts_scratch(size, {}); }},
        {"find_parts after an opening", [&](Size size) { return find_parts_scratch(size, opened); }},
        {"measure_feature", [](Size size) { return measure_feature_scratch(size); }},
        {"gauge, 1 part", [](Size size) { return gauge_scratch(size, {}, 1); }},
        {"gauge, 16 parts", [](Size size) { return gauge_scratch(size, {}, 16); }},
        {"decode_jpeg to Gray8", [](Size) { return jpeg_gray_scratch; }},
        {"decode_jpeg to Rgb888, at most", [](Size size) { return jpeg_scratch(size); }},
        {"decode_png, 8 bits gray", [](Size size) { return png_reader_scratch(size, 8); }},
        {"decode_png, at most", [](Size size) { return png_reader_scratch(size); }},
        {"encode_png", [](Size size) { return png_writer_scratch(size); }},
        {"decode_pnm, decode_bmp, encode_pnm, encode_bmp", [](Size) { return 0; }},
    };
    std::printf("| operator |");
    for (const Size size : sizes) std::printf(" %dx%d |", size.width, size.height);
    std::printf("\n|---|---|---|---|---|\n");
    for (const auto& one : operators) {
        std::printf("| %s |", one.name);
        for (const Size size : sizes) std::printf(" %lld |", static_cast<long long>(one.bytes(size)));
        std::printf("\n");
    }
}
