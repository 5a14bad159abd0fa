// SPDX-License-Identifier: MIT
//
// What reading the codes of a frame costs a chip: the jobs of firmware_read, with all lines of the frame, but
// without what the serial line takes.
//   =N NAME    a cost of N counts, in the order in which count_instructions.cpp has counted
#include <cstdint>

#include <board.hpp>
#include <fovea/base/span.hpp>
#include <fovea/code/bar_reading.hpp>
#include <fovea/decision/tolerance.hpp>

#include <firmware_read/bar_job.hpp>
#include <firmware_read/qr_job.hpp>
#include <target/code_scenes.hpp>
#include <target/print.hpp>

extern "C" {
[[gnu::noinline]] void fovea_region_begin() { __asm volatile(""); }
[[gnu::noinline]] void fovea_region_end() { __asm volatile(""); }
}

namespace {
using namespace fovea;

apps::BarMemory<target::BarScene::size.width> bar_memory;
apps::QrMemory<target::QrScene::size.width, target::QrScene::size.height, 6, 400> qr_memory;
Gray8 line[640];

/// True if the verdict is as it must be: OK where a code is shown.
template <class Job, class Scene>
bool count(Job& job, Scene scene, bool shows_code) {
    bool right = job.begin(Scene::size) == nullptr;
    for (int y = 0; y < Scene::size.height; ++y) {
        scene.take(line);
        fovea_region_begin();
        job.take_line(y, {line, Scene::size.width});
        fovea_region_end();
    }
    Verdict verdict = Verdict::unmeasured;
    fovea_region_begin();
    right = job.judge(verdict) == nullptr && right;
    fovea_region_end();
    return right && verdict == (shows_code ? Verdict::ok : Verdict::not_ok);
}
}  // namespace

int main() {
    using target::CodeScene;
    auto serial = board::start_serial();
    bool all_right = true;
    const auto tell = [&](const char* name, int lines, bool right) {
        target::print(serial, right ? "=" : "# wrong: ");
        target::print_long(serial, lines + 1);
        target::print(serial, " ");
        target::print(serial, name);
        target::print(serial, "\n");
        all_right = all_right && right;
    };
    apps::BarJob bars(bar_memory, retail_symbologies());
    const auto read_bars = [&](const char* name, CodeScene scene, bool shows_code) {
        tell(name, target::BarScene::size.height, count(bars, target::BarScene(scene), shows_code));
    };
    read_bars("EAN-13 in 640x480", CodeScene::code, true);
    read_bars("EAN-13 in 640x480, upside down", CodeScene::upside_down, true);
    read_bars("no bars in 640x480", CodeScene::light, false);
    read_bars("noise in 640x480, for bars", CodeScene::noise, false);
    apps::QrJob qr(qr_memory);
    const auto read_qr = [&](const char* name, CodeScene scene, int version, int module, bool shows_code) {
        tell(name, target::QrScene::size.height,
             count(qr, target::QrScene(scene, version, module), shows_code));
    };
    read_qr("QR version 1 in 320x240", CodeScene::code, 1, 7, true);
    read_qr("QR version 3 in 320x240, upside down", CodeScene::upside_down, 3, 5, true);
    read_qr("QR version 6 in 320x240, turned by 37 degrees", CodeScene::turned, 6, 3, true);
    read_qr("no symbol in 320x240", CodeScene::light, 1, 7, false);
    read_qr("noise in 320x240, for QR", CodeScene::noise, 1, 7, false);
    return all_right ? 0 : 1;
}
