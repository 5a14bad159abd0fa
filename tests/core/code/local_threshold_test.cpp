// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/code/local_threshold.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

/// The same by the words of the header, pixel by pixel.
std::vector<bool> naive(ImageView<const Gray8> src, const LocalThresholdOptions& options) {
    const int block = options.block;
    const int columns = (src.width() + block - 1) / block;
    const int rows = (src.height() + block - 1) / block;
    std::vector<int> middles;
    const auto at = [&](int x, int y) -> int& { return middles[static_cast<std::size_t>(y * columns + x)]; };
    for (int by = 0; by < rows; ++by) {
        for (int bx = 0; bx < columns; ++bx) {
            int low = 255;
            int high = 0;
            for (int y = by * block; y < std::min((by + 1) * block, src.height()); ++y) {
                for (int x = bx * block; x < std::min((bx + 1) * block, src.width()); ++x) {
                    low = std::min<int>(low, src(x, y));
                    high = std::max<int>(high, src(x, y));
                }
            }
            middles.push_back(high - low >= options.min_contrast ? std::max((low + high) / 2, 1) : 0);
        }
    }
    for (const int side : {-1, 1}) {
        for (int i = 0; i < columns * rows; ++i) {
            const int n = side < 0 ? i : columns * rows - 1 - i;
            const int x = n % columns;
            const int y = n / columns;
            if (at(x, y) != 0) continue;
            const int beside = x + side >= 0 && x + side < columns ? at(x + side, y) : 0;
            const int along = y + side >= 0 && y + side < rows ? at(x, y + side) : 0;
            at(x, y) = beside != 0 && along != 0 ? (beside + along) / 2 : beside + along;
        }
    }
    std::vector<bool> bits;
    if (middles[0] == 0) return bits;
    for (int y = 0; y < src.height(); ++y) {
        for (int x = 0; x < src.width(); ++x) {
            int sum = 0;
            int count = 0;
            for (int j = std::max(y / block - 2, 0); j <= std::min(y / block + 2, rows - 1); ++j) {
                for (int i = std::max(x / block - 2, 0); i <= std::min(x / block + 2, columns - 1); ++i) {
                    sum += at(i, j);
                    ++count;
                }
            }
            bits.push_back(src(x, y) < (sum + count - 1) / count);
        }
    }
    return bits;
}

Status run(ImageView<const Gray8> src, const LocalThresholdOptions& options, BitView<BitWord> dst) {
    std::vector<std::uint8_t> scratch(
        static_cast<std::size_t>(local_threshold_scratch(src.size(), options.block)));
    return local_threshold(src, options, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}, dst);
}

TEST(LocalThreshold, FollowsALightThatFallsOff) {
    // Print of half the brightness of its ground, under a light that falls from 250 to 60.
    GuardedImage<Gray8> src({96, 40});
    BitStorage<96, 40> dst;
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 96; ++x)
            src.view()(x, y) = static_cast<Gray8>((250 - 2 * x) / (x / 4 % 2 == 0 ? 1 : 2));
    ASSERT_EQ(run(src.view(), {}, dst.view()), Status::ok);
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 96; ++x) EXPECT_EQ(dst.view()(x, y), x / 4 % 2 == 1) << x << ' ' << y;
}

TEST(LocalThreshold, EqualsItsWordsOnRandomImages) {
    Random random(151);
    for (int round = 0; round < 300; ++round) {
        const Size size{random.between(1, 150), random.between(1, 60)};
        GuardedImage<Gray8> src(size);
        const int low = random.between(0, 200);
        const int range = random.between(1, 55);
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x)
                src.view()(x, y) = static_cast<Gray8>(low + random.between(0, range));
        LocalThresholdOptions options;
        options.block = random.between(4, 64);
        options.min_contrast = random.between(1, 60);
        std::vector<BitWord> words(static_cast<std::size_t>(bit_words(size.width) * size.height),
                                   0xA5A5A5A5u);
        const BitView<BitWord> dst(words.data(), size, bit_words(size.width));
        const std::vector<bool> expected = naive(src.view(), options);
        const Status status = run(src.view(), options, dst);
        if (expected.empty()) {
            EXPECT_EQ(status, Status::not_found);
            EXPECT_EQ(words, std::vector<BitWord>(words.size(), 0xA5A5A5A5u));
            continue;
        }
        ASSERT_EQ(status, Status::ok);
        for (int y = 0; y < size.height; ++y) {
            for (int x = 0; x < size.width; ++x) {
                ASSERT_EQ(dst(x, y), expected[static_cast<std::size_t>(y * size.width + x)]) << x << ' ' << y;
            }
            EXPECT_EQ(dst.row(y)[bit_words(size.width) - 1] & ~last_bits(size.width), 0U);
        }
    }
}

TEST(LocalThreshold, ExtremesKeepTheirPlaces) {
    GuardedImage<Gray8> src({33, 17});
    BitStorage<33, 17> dst;
    for (int y = 0; y < 17; ++y)
        for (int x = 0; x < 33; ++x) src.view()(x, y) = (x + y) % 2 == 0 ? 0 : 255;
    ASSERT_EQ(run(src.view(), {}, dst.view()), Status::ok);
    for (int y = 0; y < 17; ++y)
        for (int x = 0; x < 33; ++x) EXPECT_EQ(dst.view()(x, y), (x + y) % 2 == 0);
}

TEST(LocalThreshold, SaysWhatIsWrong) {
    GuardedImage<Gray8> src({40, 30});
    BitStorage<40, 30> dst;
    BitStorage<39, 30> narrow;
    const auto with = [&](int block, int contrast) {
        LocalThresholdOptions options;
        options.block = block;
        options.min_contrast = contrast;
        std::vector<std::uint8_t> scratch(100000);
        return local_threshold(src.view(), options, {scratch.data(), 100000}, dst.view());
    };
    EXPECT_EQ(local_threshold({}, {}, {}, dst.view()), Status::empty_image);
    EXPECT_EQ(local_threshold(src.view(), {}, {}, narrow.view()), Status::size_mismatch);
    EXPECT_EQ(with(3, 20), Status::bad_argument);
    EXPECT_EQ(with(65, 20), Status::bad_argument);
    EXPECT_EQ(with(8, 0), Status::bad_argument);
    EXPECT_EQ(with(8, 256), Status::bad_argument);
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(local_threshold_scratch({40, 30}, 8)));
    EXPECT_EQ(local_threshold(src.view(), {},
                              {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size()) - 1}, dst.view()),
              Status::scratch_too_small);
}

}  // namespace
}  // namespace fovea::test
