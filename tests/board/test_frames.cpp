// SPDX-License-Identifier: MIT
//
// Writes the frames of test_frame.hpp into a file and looks at frames that were received:
//   test_frames write MODE COUNT FILE     frames 0.. behind each other
//   test_frames check MODE FILE           prints their numbers; fails unless each is whole and right
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>

#include <board/test_frame.hpp>

using namespace fovea::test;

namespace {

int write(const CameraMode& mode, std::uint32_t count, const char* path) {
    std::ofstream file(path, std::ios::binary);
    for (std::uint32_t number = 0; number < count; ++number) {
        const Bytes frame = test_frame(mode, number);
        file.write(reinterpret_cast<const char*>(frame.data()), static_cast<std::streamsize>(frame.size()));
    }
    return file.flush() ? 0 : 1;
}

int check(const CameraMode& mode, const char* path) {
    std::ifstream file(path, std::ios::binary);
    const Bytes all{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    for (std::size_t place = 0; place < all.size();) {
        const std::size_t left = all.size() - place;
        const std::uint32_t number = left < 4 ? 0 : test_frame_number(&all[place]);
        const Bytes wanted = test_frame(mode, number);
        if (left < wanted.size() || std::memcmp(wanted.data(), &all[place], wanted.size()) != 0) {
            std::printf("what comes next, as frame %u, is wrong\n", number);
            return 1;
        }
        std::printf("%u ", number);
        place += wanted.size();
    }
    std::printf("\n");
    return all.empty() ? 1 : 0;
}

}  // namespace

int main(int count, char** words) {
    const CameraMode* mode = count > 3 ? camera_mode(words[2]) : nullptr;
    if (mode != nullptr && count == 5 && std::string(words[1]) == "write")
        return write(*mode, static_cast<std::uint32_t>(std::atoi(words[3])), words[4]);
    if (mode != nullptr && count == 4 && std::string(words[1]) == "check") return check(*mode, words[3]);
    std::fprintf(stderr, "test_frames write MODE COUNT FILE | check MODE FILE; MODE: yuyv, grey or mjpeg\n");
    return 2;
}
