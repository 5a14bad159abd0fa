// SPDX-License-Identifier: MIT
//
// Pictures of the test data: where they are, and how to skip a test that lacks its picture. Host tests only.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace fovea::test {

/// All bytes of a file; empty when it cannot be read.
inline std::vector<std::uint8_t> read_file(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// The folder of real pictures that are not ours to commit: $FOVEA_TEST_DATA, or shared/data beside the
/// checkout.
inline std::filesystem::path data_folder() {
    if (const char* named = std::getenv("FOVEA_TEST_DATA")) return named;
    return std::filesystem::path(FOVEA_SOURCE_DIR) / ".." / "shared" / "data";
}

/// The pictures of Debian's package opencv-doc: $FOVEA_OPENCV_DOC, or where the package puts them.
inline std::filesystem::path opencv_doc_folder() {
    if (const char* named = std::getenv("FOVEA_OPENCV_DOC")) return named;
    return "/usr/share/doc/opencv-doc/examples/data";
}

}  // namespace fovea::test

/// Skips the running test, by name, when a picture is absent.
#define FOVEA_NEED_PICTURE(path)                        \
    if (!std::filesystem::exists(path)) {               \
        GTEST_SKIP() << "picture not here: " << (path); \
    }
