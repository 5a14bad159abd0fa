// SPDX-License-Identifier: MIT
//
// tests/target/calibration.txt: the digest of the calibration that chips do, as this processor has it.
#include <cstdio>

#include <target/calibration.hpp>

int main() {
    static fovea::target::BoardCalibration board;
    if (!board.calibrate()) return 1;
    std::printf("calibrate_planar %08x\n", static_cast<unsigned>(board.digest()));
    return 0;
}
