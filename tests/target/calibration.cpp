// SPDX-License-Identifier: MIT
//
// A whole calibration on a chip: 13 views of 54 corners. Prints the digest of all digits of the answer, which
// must be that of tests/target/calibration.txt, and
//   =1 NAME    a cost of one count
#include <board.hpp>

#include <target/calibration.hpp>
#include <target/print.hpp>

extern "C" {
[[gnu::noinline]] void fovea_region_begin() { __asm volatile(""); }
[[gnu::noinline]] void fovea_region_end() { __asm volatile(""); }
}

using namespace fovea;

int main() {
    auto serial = board::start_serial();
    static target::BoardCalibration calibration;
    const bool equations = calibration.set_up(fovea_region_begin, fovea_region_end);
    target::print(serial, "=1 calibrate_planar, one set of equations of 702 corners\n");
    fovea_region_begin();
    const bool calibrated = calibration.calibrate();
    fovea_region_end();
    target::print(serial, "=1 calibrate_planar, 13 views of 54 corners\n");
    target::print(serial, "calibrate_planar ");
    target::print_hexadecimal(serial, calibration.digest());
    target::print(serial, "\n");
    return equations && calibrated ? 0 : 1;
}
