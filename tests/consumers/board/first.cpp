// SPDX-License-Identifier: MIT
//
// The first program on a new board: three lines, each of which says that a part works.
#include <cstdint>

#include <board.hpp>
#include <fovea/draw/rectangle.hpp>
#include <fovea/image/image_storage.hpp>
#include <fovea/statistics/histogram.hpp>

static fovea::ImageStorage<fovea::Gray8, 16, 16> picture;

// Waits until all is sent. A program that measures drops what does not go at once.
static void say(fovea::board::Serial& serial, const char* line) {
    for (; *line != '\0'; ++line) {
        const auto byte = static_cast<std::uint8_t>(*line);
        while (*serial.write({&byte, 1}) == 0) {
        }
    }
}

int main() {
    auto serial = fovea::board::start_serial();
    say(serial, "the serial line works\n");

    auto clock = fovea::board::start_clock();
    const std::int64_t begin = clock.microseconds();
    for (int turns = 0; clock.microseconds() < begin + 1000; ++turns)
        if (turns == 10'000'000) return 1;
    say(serial, "the clock goes\n");

    if (fovea::fill_rectangle(picture.view(), {4, 4, 8, 8}, fovea::Gray8{200}) != fovea::Status::ok) return 2;
    fovea::Histogram histogram;
    if (fovea::histogram_of(picture.view(), histogram) != fovea::Status::ok || histogram[200] != 64) return 2;
    say(serial, "the core measures\n");
    return 0;
}
