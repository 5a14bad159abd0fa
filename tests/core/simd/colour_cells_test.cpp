// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/simd/colour_cells.hpp>

namespace fovea::test {
namespace {

/// A colour image without a byte to spare on either side, and its channels as images of their own.
struct ColourImage {
    ColourImage(int columns, int rows, int padding)
        : width(columns),
          height(rows),
          stride(3 * columns + padding),
          bytes(static_cast<std::size_t>(stride * (rows - 1) + 3 * columns)) {
        Random random(921);
        for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.next() >> 9);
        for (std::size_t k = 0; k < 3; ++k)
            for (int y = 0; y < rows; ++y)
                for (int x = 0; x < columns; ++x)
                    channels[k].push_back(bytes[static_cast<std::size_t>(stride * y + 3 * x) + k]);
    }
    simd::CellSource source(bool replicate) const {
        return {bytes.data(), width, height, stride, replicate, 0};
    }
    simd::CellSource channel(std::size_t k, bool replicate, std::uint8_t level) const {
        return {channels[k].data(), width, height, width, replicate, level};
    }
    int width;
    int height;
    int stride;
    std::vector<std::uint8_t> bytes;
    std::vector<std::uint8_t> channels[3];
};

std::int32_t anywhere(Random& random, int side) {
    if (random.below(20) == 0) return std::numeric_limits<std::int32_t>::min();
    if (random.below(20) == 0) return std::numeric_limits<std::int32_t>::max();
    if (random.below(5) == 0) return 256 * (side - 1);
    return random.between(-300, 256 * (side - 1) + 300);
}

TEST(ColourCells, AreTheCellsOfTheThreeChannels) {
    Random random(922);
    for (const ColourImage& image : {ColourImage(2, 2, 0), ColourImage(3, 2, 5), ColourImage(40, 30, 1),
                                     ColourImage(1, 7, 0), ColourImage(9, 1, 0)})
        for (const bool replicate : {true, false})
            for (int count = 1; count <= simd::run_length; ++count) {
                simd::PlaceRun run;
                for (int i = 0; i < count; ++i) {
                    run.x[i] = anywhere(random, image.width);
                    run.y[i] = anywhere(random, image.height);
                }
                const simd::PlaceRun places = run;
                std::vector<std::uint8_t> colours(static_cast<std::size_t>(3 * count));
                const bool done =
                    simd::blend_colour_cells(image.source(replicate), run, count, 0x2c1621, colours.data());
                ASSERT_EQ(done, FOVEA_BYTES >= 16 && image.width > 1 && image.height > 1);
                for (int i = 0; done && i < 3 * count; ++i) {
                    const auto k = static_cast<std::size_t>(i % 3);
                    const std::uint8_t levels[] = {0x21, 0x16, 0x2c};
                    ASSERT_EQ(colours[static_cast<std::size_t>(i)],
                              simd::blend_cell(image.channel(k, replicate, levels[k]), places.x[i / 3],
                                               places.y[i / 3]));
                }
            }
}

}  // namespace
}  // namespace fovea::test
