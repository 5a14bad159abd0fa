// SPDX-License-Identifier: MIT
//
// Prints the table of scratch in docs/memory.md: bytes that the operators ask of their caller.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <fovea/camera/calibrate_planar.hpp>
#include <fovea/camera/checkerboard.hpp>
#include <fovea/camera/circle_grid.hpp>
#include <fovea/catalogue/catalogue.hpp>
#include <fovea/code/bar_stream.hpp>
#include <fovea/code/read_bars.hpp>
#include <fovea/code/read_data_matrix.hpp>
#include <fovea/code/read_qr.hpp>
#include <fovea/codec/jpeg.hpp>
#include <fovea/codec/png_reader.hpp>
#include <fovea/codec/png_writer.hpp>
#include <fovea/decision/gauge.hpp>
#include <fovea/feature/find_circles.hpp>
#include <fovea/measure/edge_probe.hpp>
#include <fovea/motion/block_motion.hpp>
#include <fovea/segment/connected_components.hpp>
#include <fovea/stereo/calibrate_stereo.hpp>
#include <fovea/warp/remap.hpp>

using namespace fovea;

namespace {

constexpr Size sizes[] = {{160, 120}, {320, 240}, {640, 480}, {1920, 1080}};

std::string cells(const std::function<std::int64_t(Size)>& bytes) {
    std::string text;
    for (const Size size : sizes) text += " " + std::to_string(bytes(size)) + " |";
    return text;
}

/// A line for all operators of the catalogue that ask for the same with their presets.
void print_catalogue() {
    std::vector<std::pair<std::string, std::string>> lines;
    for (const OperatorFamily& family : operator_families)
        for (const Operator& op : family.operators) {
            int presets[max_operator_parameters] = {};
            for (int i = 0; i < op.parameter_count(); ++i) presets[i] = op.parameters[i].preset;
            const std::string bytes = cells([&](Size size) { return op.scratch_for(size, presets); });
            const auto same = std::find_if(lines.begin(), lines.end(),
                                           [&](const auto& line) { return line.second == bytes; });
            if (same == lines.end())
                lines.emplace_back(op.name, bytes);
            else
                same->first += std::string(", ") + op.name;
        }
    std::printf(
        "| operator of the catalogue, with its presets | 160x120 | 320x240 | 640x480 | 1920x1080 "
        "|\n|---|---|---|---|---|\n");
    for (const auto& [names, bytes] : lines) std::printf("| %s |%s\n", names.c_str(), bytes.c_str());
}

}  // namespace

int main() {
    LocateRule opened;
    opened.opening = 3;
    ReadQrOptions few;
    few.effort = ReadQrOptions::Effort::several;
    few.largest_version = 6;
    const struct {
        const char* name;
        std::function<std::int64_t(Size)> bytes;
    } operators[] = {
        {"histogram, moments, level contours, lines, labels", [](Size) { return 0; }},
        {"connected_components", [](Size size) { return connected_components_scratch(size.width); }},
        {"connected_components, 64 labels",
         [](Size size) { return connected_components_scratch(size.width, 64); }},
        {"find_circles of 10 to 100 px", [](Size size) { return find_circles_scratch(size, {}); }},
        {"block_motion, blocks of 16", [](Size size) { return block_motion_scratch(size, 16); }},
        {"find_checkerboard, 9x6",
         [](Size size) {
             return find_checkerboard_scratch(size, {9, 6}, {});
         }},
        {"find_circle_grid, 4x11",
         [](Size size) {
             return find_circle_grid_scratch(size, {4, 11}, {});
         }},
        {"read_bars", read_bars_scratch},
        {"BarStream", [](Size size) { return bar_stream_scratch(size.width); }},
        {"the grid of an undistortion map",
         [](Size size) { return map_grid_size(size).area() * static_cast<std::int64_t>(sizeof(MapPoint)); }},
        {"edge_probe", [](Size size) { return std::int64_t{2} * edge_probe_scratch(size); }},
        {"find_parts", [](Size size) { return find_parts_scratch(size, {}); }},
        {"find_parts after an opening", [&](Size size) { return find_parts_scratch(size, opened); }},
        {"read_qr", [](Size size) { return read_qr_scratch(size); }},
        {"read_qr, versions 1 to 6, several thresholds",
         [&](Size size) { return read_qr_scratch(size, few); }},
        {"read_data_matrix", [](Size size) { return read_data_matrix_scratch(size); }},
        {"measure_feature", [](Size size) { return measure_feature_scratch(size); }},
        {"gauge, 1 part", [](Size size) { return gauge_scratch(size, {}, 1); }},
        {"gauge, 16 parts", [](Size size) { return gauge_scratch(size, {}, 16); }},
        {"calibrate_planar, 13 views", [](Size) { return calibrate_planar_scratch(13); }},
        {"calibrate_stereo, 13 pairs", [](Size) { return calibrate_stereo_scratch(13); }},
        {"decode_jpeg to Gray8", [](Size) { return jpeg_gray_scratch; }},
        {"decode_jpeg to Rgb888, at most", [](Size size) { return jpeg_scratch(size); }},
        {"decode_png, 8 bits gray", [](Size size) { return png_reader_scratch(size, 8); }},
        {"decode_png, at most", [](Size size) { return png_reader_scratch(size); }},
        {"encode_png", [](Size size) { return png_writer_scratch(size); }},
        {"decode_pnm, decode_bmp, encode_pnm, encode_bmp", [](Size) { return 0; }},
    };
    print_catalogue();
    std::printf("\n| other operator |");
    for (const Size size : sizes) std::printf(" %dx%d |", size.width, size.height);
    std::printf("\n|---|---|---|---|---|\n");
    for (const auto& one : operators) {
        std::printf("| %s |", one.name);
        for (const Size size : sizes) std::printf(" %lld |", static_cast<long long>(one.bytes(size)));
        std::printf("\n");
    }
}
