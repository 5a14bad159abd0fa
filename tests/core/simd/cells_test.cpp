// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/simd/cells.hpp>

namespace fovea::test {
namespace {

constexpr std::int32_t least = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t most = std::numeric_limits<std::int32_t>::max();

/// An image without a byte to spare on either side, so that the address sanitizer sees every fetch beside it.
struct Image {
    Image(int columns, int rows, int stride_bytes)
        : width(columns),
          height(rows),
          stride(stride_bytes),
          bytes(static_cast<std::size_t>(stride * (rows - 1) + columns)) {
        Random random(911);
        for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.next() >> 9);
    }
    simd::CellSource source(bool replicate) const {
        return {bytes.data(), width, height, stride, replicate, 33};
    }
    int width;
    int height;
    int stride;
    std::vector<std::uint8_t> bytes;
};

TEST(Cells, AreTheSameOneByOneAtEveryCount) {
    Random random(912);
    for (const Image& image : {Image(2, 2, 2), Image(3, 2, 5), Image(1, 7, 1), Image(9, 1, 9),
                               Image(70, 40, 77), Image(5, 5, 40000)})
        for (const bool replicate : {true, false})
            for (const int spread : {0, 300, 100000})
                for (int count = 1; count <= simd::run_length; ++count) {
                    const simd::CellSource source = image.source(replicate);
                    simd::PlaceRun run;
                    for (int i = 0; i < count; ++i) {
                        run.x[i] = random.between(-spread, 256 * (image.width - 1) + spread);
                        run.y[i] = random.between(-spread, 256 * (image.height - 1) + spread);
                        if (spread > 300 && random.below(4) == 0)
                            run.x[i] = random.below(2) == 0 ? least : most;
                        if (spread > 300 && random.below(4) == 0)
                            run.y[i] = random.below(2) == 0 ? least + 1 : most;
                    }
                    simd::PlaceRun again = run;
                    std::vector<std::uint8_t> blended(static_cast<std::size_t>(count));
                    std::vector<std::uint8_t> picked(static_cast<std::size_t>(count));
                    const simd::PlaceRun places = run;
                    simd::blend_cells(source, run, count, simd::PlaceOrder::anywhere, blended.data());
                    simd::nearest_cells(source, again, count, picked.data());
                    for (int i = 0; i < count; ++i) {
                        const auto at = static_cast<std::size_t>(i);
                        ASSERT_EQ(blended[at], simd::blend_cell(source, places.x[i], places.y[i])) << count;
                        ASSERT_EQ(picked[at], simd::nearest_cell(source, places.x[i], places.y[i]));
                    }
                }
}

TEST(Cells, BelongToTheImageUpToHalfAPixelOutside) {
    const Image image(8, 8, 8);
    const simd::CellSource source = image.source(false);
    EXPECT_EQ(simd::blend_cell(source, -128, 0), image.bytes[0]);
    EXPECT_EQ(simd::blend_cell(source, -129, 0), 33);
    EXPECT_EQ(simd::nearest_cell(source, 256 * 8 - 129, 0), image.bytes[7]);
    EXPECT_EQ(simd::nearest_cell(source, 256 * 8 - 128, 0), 33);
    EXPECT_EQ(simd::blend_cell(image.source(true), most, 0), image.bytes[7]);
    EXPECT_EQ(simd::blend_cell(image.source(true), simd::no_place, 0), 33);
}

TEST(Cells, AlongALineAreTheSameAsAnywhere) {
    const Image image(90, 80, 96);
    Random random(913);
    for (int round = 0; round < 500; ++round) {
        const simd::CellSource source = image.source(round % 2 == 0);
        const std::int64_t x = std::int64_t{random.between(-2000, 25000)} * (std::int64_t{1} << 32);
        const std::int64_t y = std::int64_t{random.between(-2000, 22000)} * (std::int64_t{1} << 32);
        const std::int64_t step_x = std::int64_t{random.between(-300, 300)} * (std::int64_t{1} << 32);
        const std::int64_t step_y = std::int64_t{random.between(-300, 300)} * (std::int64_t{1} << 32);
        const int count = random.between(1, simd::run_length);
        simd::PlaceRun run;
        simd::straight_places(x, step_x, count, run.x);
        simd::straight_places(y, step_y, count, run.y);
        simd::PlaceRun again = run;
        std::uint8_t line[simd::run_length];
        std::uint8_t anywhere[simd::run_length];
        simd::blend_cells(source, run, count, simd::PlaceOrder::along_a_line, line);
        simd::blend_cells(source, again, count, simd::PlaceOrder::anywhere, anywhere);
        for (int i = 0; i < count; ++i) ASSERT_EQ(line[i], anywhere[i]);
    }
}

TEST(Cells, AlongALineThatEndsBeyondTheHorizonAreReadUpToIt) {
    const Image image(90, 80, 96);
    const simd::CellSource source = image.source(false);
    simd::PlaceRun run{};
    for (int i = 0; i < simd::run_length; ++i) {
        run.x[i] = i < 40 ? 1000 * (i - 2) : simd::no_place;
        run.y[i] = 2000;
    }
    const simd::PlaceRun places = run;
    std::uint8_t line[simd::run_length];
    simd::blend_cells(source, run, simd::run_length, simd::PlaceOrder::along_a_line, line);
    for (int i = 0; i < simd::run_length; ++i)
        ASSERT_EQ(line[i], simd::blend_cell(source, places.x[i], places.y[i])) << i;
}

TEST(Places, AreRoundedHighWords) {
    Random random(914);
    for (int round = 0; round < 200; ++round) {
        const auto start = static_cast<std::int64_t>(random.next()) * random.between(-1000000, 1000000);
        const auto step = static_cast<std::int64_t>(random.next()) * random.between(-100000, 100000);
        simd::PlaceRun run;
        const int count = random.between(1, simd::run_length);
        simd::straight_places(start, step, count, run.x);
        for (int i = 0; i < count; ++i)
            ASSERT_EQ(run.x[i], (start + i * step + (std::int64_t{1} << 31)) >> 32) << i;
    }
}

TEST(Places, FollowACurve) {
    Random random(915);
    for (int round = 0; round < 200; ++round) {
        const std::int32_t base = random.between(-1000000, 1000000);
        const std::int32_t start = random.between(0, 5000);
        const std::int32_t slope = random.between(-(1 << 26), 1 << 26);
        const std::int32_t bend = round % 3 == 0 ? 0 : random.between(-(1 << 19), 1 << 19);
        std::int32_t to[simd::curve_length];
        simd::curve_places(base, start, slope, bend, 12, to);
        for (int i = 0; i < simd::curve_length; ++i)
            ASSERT_EQ(to[i],
                      base + ((start + std::int64_t{slope} * i + std::int64_t{bend} * i * (16 - i)) >> 12));
    }
}

TEST(Places, ComeInPairs) {
    Random random(916);
    std::int32_t pairs[2 * simd::run_length];
    std::int16_t offsets[2 * simd::run_length];
    for (int i = 0; i < 2 * simd::run_length; ++i) {
        pairs[i] = static_cast<std::int32_t>(random.next());
        offsets[i] = static_cast<std::int16_t>(random.next() >> 7);
    }
    for (int count = 1; count <= simd::run_length; ++count) {
        simd::PlaceRun split;
        simd::PlaceRun moved;
        simd::split_places(pairs, count, split);
        simd::offset_places(512, -256, offsets, 3, count, moved);
        for (int i = 0; i < count; ++i) {
            ASSERT_EQ(split.x[i], pairs[2 * i]);
            ASSERT_EQ(split.y[i], pairs[2 * i + 1]);
            ASSERT_EQ(moved.x[i], 512 + 256 * i + 8 * offsets[2 * i]);
            ASSERT_EQ(moved.y[i], -256 + 8 * offsets[2 * i + 1]);
        }
    }
}

}  // namespace
}  // namespace fovea::test
