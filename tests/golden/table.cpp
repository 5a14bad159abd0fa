// SPDX-License-Identifier: MIT
//
// Prints the checksum of every golden vector: the lines of golden.txt.
#include <cstdio>

#include <golden/vectors.hpp>

namespace {
fovea::golden::Workspace workspace;
}  // namespace

int main() {
    fovea::golden::for_each_vector([](const fovea::golden::Vector& vector) {
        std::printf("%s %08x\n", vector.name, static_cast<unsigned>(checksum(vector, workspace)));
    });
    return std::fflush(stdout) == 0 ? 0 : 1;
}
