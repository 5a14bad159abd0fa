// SPDX-License-Identifier: MIT
//
// Shows pictures to the camera of the board: usage: show_pictures INPUT OUTPUT WIDTHxHEIGHT
// Each line of the standard input names a PGM file of that size, which OUTPUT shows from then on; "shown
// NAME" answers it when the camera sees it. The picture is gray. An empty line shows black.
#include <linux/videodev2.h>

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

#include <fovea/codec/pnm.hpp>
#include <fovea/linux/v4l2_camera.hpp>
#include <fovea/linux/video_controls.hpp>

#include "board/video_output.hpp"

namespace {

using namespace fovea;

/// The pixels of a PGM file; empty if it is not of that size.
std::vector<std::uint8_t> read_pgm(const std::string& name, Size size) {
    std::ifstream file(name, std::ios::binary);
    const std::vector<std::uint8_t> bytes((std::istreambuf_iterator<char>(file)),
                                          std::istreambuf_iterator<char>());
    std::vector<std::uint8_t> pixels(static_cast<std::size_t>(size.area()));
    const ImageView<Gray8> view(pixels.data(), size, size.width);
    const Span<const std::uint8_t> span(bytes.data(), static_cast<std::ptrdiff_t>(bytes.size()));
    if (decode_pnm(span, view) != Status::ok) pixels.clear();
    return pixels;
}

/// The input shows what its own output has, without words over it.
bool loop(const char* input) {
    linux_port::V4l2Camera<> camera;
    if (camera.open(input) != Status::ok) return false;
    linux_port::ControlSetting settings[2];
    settings[0].name = "Loop Video";
    settings[0].value = 1;
    settings[1].name = "OSD Text Mode";
    settings[1].value = 2;
    linux_port::Kernel kernel;
    linux_port::Fault fault;
    return set_controls(kernel, camera.file(), {settings, 2}, fault) == Status::ok;
}

}  // namespace

int main(int count, char** words) {
    Size size;
    if (count != 4 || std::sscanf(words[3], "%dx%d", &size.width, &size.height) != 2) {
        std::puts("usage: show_pictures INPUT OUTPUT WIDTHxHEIGHT");
        return 2;
    }
    board::VideoOutput output;
    if (!loop(words[1]) || output.open(words[2], V4L2_PIX_FMT_GREY, size, false) != 0) {
        std::puts("FAILED no loop");
        return 1;
    }
    const auto show = [&](const std::vector<std::uint8_t>& pixels) {
        return output.show([&](int, Span<std::uint8_t> bytes) {
            for (std::ptrdiff_t k = 0; k < bytes.size(); ++k)
                bytes[k] = static_cast<std::size_t>(k) < pixels.size() ? pixels[static_cast<std::size_t>(k)]
                                                                       : std::uint8_t{0};
        });
    };
    const std::vector<std::uint8_t> black(static_cast<std::size_t>(size.area()));
    if (show(black) != 0) return 1;
    std::puts("shown");
    std::fflush(stdout);
    for (std::string name; std::getline(std::cin, name);) {
        const std::vector<std::uint8_t> pixels = name.empty() ? black : read_pgm(name, size);
        // Twice: when the second has been queued, the first is on show.
        if (pixels.empty() || show(pixels) != 0 || show(pixels) != 0) {
            std::printf("FAILED %s\n", name.c_str());
            return 1;
        }
        std::printf("shown %s\n", name.c_str());
        std::fflush(stdout);
    }
    return 0;
}
