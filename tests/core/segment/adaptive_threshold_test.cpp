// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/segment/adaptive_threshold.hpp>
#include <support/guarded_image.hpp>
#include <support/naive_reference.hpp>

namespace fovea::test {
namespace {

std::vector<std::uint8_t> dirty(std::int64_t bytes) {
    return std::vector<std::uint8_t>(static_cast<std::size_t>(bytes), 0xee);
}
Span<std::uint8_t> span_of(std::vector<std::uint8_t>& bytes) {
    return {bytes.data(), static_cast<std::ptrdiff_t>(bytes.size())};
}

struct Window {
    std::int64_t sum = 0;
    std::int64_t squares = 0;
};
Window window_at(ImageView<const Gray8> src, int side, int x, int y) {
    Window window;
    for (int dy = -(side / 2); dy <= side / 2; ++dy)
        for (int dx = -(side / 2); dx <= side / 2; ++dx) {
            const std::int64_t value = replicated(src, x + dx, y + dy);
            window.sum += value;
            window.squares += value * value;
        }
    return window;
}

void fill_with_shade(GuardedImage<Gray8>& image, Size size, Random& random) {
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            image(x, y) = static_cast<Gray8>(60 + x % 97 + random.between(0, 60));
}

TEST(AdaptiveThreshold, ComparesWithTheExactMeanOnEverySize) {
    Random random(191);
    for (const Size size : test_sizes())
        for (const int side : {1, 3, 5, 15, 31})
            for (const int offset : {-255, -3, 0, 5, 255}) {
                GuardedImage<Gray8> src(size), dst(size), inverse(size);
                fill_with_shade(src, size, random);
                std::vector<std::uint8_t> scratch = dirty(adaptive_threshold_scratch(size, side));
                ASSERT_EQ(adaptive_threshold(src.view(), side, offset, span_of(scratch), dst.view()),
                          Status::ok);
                ASSERT_EQ(
                    adaptive_threshold_inverse(src.view(), side, offset, span_of(scratch), inverse.view()),
                    Status::ok);
                for (int y = 0; y < size.height; ++y)
                    for (int x = 0; x < size.width; ++x) {
                        const std::int64_t sum = window_at(src.view(), side, x, y).sum;
                        const bool bright = (src(x, y) + offset) * side * side >= sum;
                        ASSERT_EQ(dst(x, y), bright ? 255 : 0) << side << " " << offset;
                        ASSERT_EQ(inverse(x, y), bright ? 0 : 255);
                    }
            }
}

TEST(AdaptiveThreshold, TakesTheLargestWindowOfWhite) {
    const Size size{300, 260};
    GuardedImage<Gray8> src(size), dst(size);
    src.fill(Gray8{255});
    src(150, 130) = 254;
    std::vector<std::uint8_t> scratch = dirty(adaptive_threshold_scratch(size, max_adaptive_side));
    ASSERT_EQ(adaptive_threshold(src.view(), max_adaptive_side, 0, span_of(scratch), dst.view()), Status::ok);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) ASSERT_EQ(dst(x, y), x == 150 && y == 130 ? 0 : 255);
}

TEST(AdaptiveThreshold, FindsPrintUnderUnevenLight) {
    // Ground from 60 to 250, strokes 30 darker than it: no fixed level splits them.
    const Size size{96, 20};
    GuardedImage<Gray8> src(size), dst(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            src(x, y) = static_cast<Gray8>(60 + 2 * x - (x % 12 < 2 ? 30 : 0));
    std::vector<std::uint8_t> scratch = dirty(adaptive_threshold_scratch(size, 13));
    ASSERT_EQ(adaptive_threshold(src.view(), 13, 10, span_of(scratch), dst.view()), Status::ok);
    for (int y = 0; y < size.height; ++y)
        for (int x = 12; x < size.width - 12; ++x) EXPECT_EQ(dst(x, y), x % 12 < 2 ? 0 : 255) << x;
}

TEST(SauvolaThreshold, ComparesWithTheRealThresholdOnEverySize) {
    Random random(192);
    for (const Size size : test_sizes())
        for (const int side : {1, 3, 7, 25})
            for (const int weight : {0, 51, 128, 256}) {
                GuardedImage<Gray8> src(size), dst(size);
                fill_with_shade(src, size, random);
                std::vector<std::uint8_t> scratch = dirty(sauvola_threshold_scratch(size, side));
                ASSERT_EQ(sauvola_threshold(src.view(), side, weight, span_of(scratch), dst.view()),
                          Status::ok);
                const double area = side * side;
                for (int y = 0; y < size.height; ++y)
                    for (int x = 0; x < size.width; ++x) {
                        const Window window = window_at(src.view(), side, x, y);
                        const auto sum = static_cast<double>(window.sum);
                        // Exact below 2^53, then the root is rounded down as stated.
                        const double deviation =
                            std::floor(std::sqrt(area * static_cast<double>(window.squares) - sum * sum));
                        const double level = sum / area * (1 + weight / 256.0 * (deviation / area / 128 - 1));
                        // Within the error of a real number either answer will do.
                        if (std::fabs(src(x, y) - level) > 1e-9) {
                            ASSERT_EQ(dst(x, y), src(x, y) > level ? 255 : 0) << side << " " << weight;
                        } else {
                            ASSERT_TRUE(dst(x, y) == 0 || dst(x, y) == 255);
                        }
                    }
            }
}

TEST(SauvolaThreshold, LeavesAFlatGroundWhite) {
    for (const int level : {0, 1, 128, 255}) {
        GuardedImage<Gray8> src({40, 40}), dst({40, 40});
        src.fill(static_cast<Gray8>(level));
        std::vector<std::uint8_t> scratch = dirty(sauvola_threshold_scratch({40, 40}, 255));
        ASSERT_EQ(sauvola_threshold(src.view(), 255, 51, span_of(scratch), dst.view()), Status::ok);
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < 40; ++x) ASSERT_EQ(dst(x, y), 255);
    }
}

TEST(SauvolaThreshold, HoldsTheLargestProducts) {
    Random random(193);
    const Size size{64, 64};
    GuardedImage<Gray8> src(size), dst(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) src(x, y) = random.below(2) != 0 ? 255 : 0;
    std::vector<std::uint8_t> scratch = dirty(sauvola_threshold_scratch(size, max_adaptive_side));
    ASSERT_EQ(
        sauvola_threshold(src.view(), max_adaptive_side, max_sauvola_weight, span_of(scratch), dst.view()),
        Status::ok);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) ASSERT_EQ(dst(x, y), src(x, y));
}

}  // namespace
}  // namespace fovea::test
