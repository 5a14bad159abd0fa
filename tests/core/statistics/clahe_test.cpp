// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/statistics/clahe.hpp>
#include <fovea/statistics/equalize.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

Status run(ImageView<const Gray8> src, Size tiles, int clip, ImageView<Gray8> dst) {
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(clahe_scratch(src.size(), tiles)), 0xee);
    return clahe(src, tiles, clip, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}, dst);
}

/// The slow obvious version: the table of every tile anew, tiles and weights from their definition.
class NaiveClahe {
public:
    NaiveClahe(ImageView<const Gray8> src, Size tiles, int clip)
        : src_(src),
          across_(std::min(tiles.width, src.width())),
          down_(std::min(tiles.height, src.height())),
          clip_(clip) {
        for (int j = 0; j < down_; ++j)
            for (int i = 0; i < across_; ++i) tables_.push_back(table(i, j));
    }
    int at(int x, int y) const {
        int i = 0, j = 0;
        const int fx = weight(x, across_, src_.width(), i);
        const int fy = weight(y, down_, src_.height(), j);
        const int right = std::min(i + 1, across_ - 1);
        const int below = std::min(j + 1, down_ - 1);
        const int v = src_(x, y);
        const int sum = (of(i, j, v) * (256 - fx) + of(right, j, v) * fx) * (256 - fy) +
                        (of(i, below, v) * (256 - fx) + of(right, below, v) * fx) * fy;
        return (sum + 32768) / 65536;
    }

private:
    int of(int i, int j, int level) const {
        return tables_[static_cast<std::size_t>(j * across_ + i)][static_cast<std::size_t>(level)];
    }
    static int first(int tile, int tiles, int count) { return tile * count / tiles; }
    static int weight(int place, int tiles, int count, int& tile) {
        const auto centre2 = [&](int t) { return first(t, tiles, count) + first(t + 1, tiles, count) - 1; };
        tile = 0;
        for (int t = 0; t < tiles; ++t)
            if (centre2(t) <= 2 * place) tile = t;
        if (tile == tiles - 1 || 2 * place < centre2(tile)) return 0;
        const int gap = centre2(tile + 1) - centre2(tile);
        return (2 * 256 * (2 * place - centre2(tile)) + gap) / (2 * gap);
    }
    std::vector<int> table(int i, int j) const {
        std::vector<int> counts(256);
        int area = 0;
        for (int y = first(j, down_, src_.height()); y < first(j + 1, down_, src_.height()); ++y)
            for (int x = first(i, across_, src_.width()); x < first(i + 1, across_, src_.width()); ++x) {
                ++counts[src_(x, y)];
                ++area;
            }
        const int limit = std::max(static_cast<int>(static_cast<std::int64_t>(area) * clip_ / 25600), 1);
        int excess = 0;
        for (int& count : counts) {
            excess += std::max(count - limit, 0);
            count = std::min(count, limit);
        }
        for (int& count : counts) count += excess / 256;
        const int rest = excess % 256;
        for (int k = 0; k < rest; ++k) ++counts[static_cast<std::size_t>(k * (256 / rest))];
        int sum = 0;
        for (int& count : counts) {
            sum += count;
            count = (510 * sum + area) / (2 * area);
        }
        return counts;
    }

    ImageView<const Gray8> src_;
    int across_;
    int down_;
    int clip_;
    std::vector<std::vector<int>> tables_;
};

TEST(Clahe, MakesTheSameTableWithNumbersOf64Bits) {
    Random random(142);
    for (const int clip : {min_clahe_clip, 300, max_clahe_clip}) {
        std::vector<std::uint32_t> narrow(256);
        std::uint32_t area = 0;
        for (std::uint32_t& count : narrow) area += count = random.below(random.below(20) == 0 ? 30000 : 300);
        std::vector<std::uint32_t> wide = narrow;
        std::vector<Gray8> table(256);
        std::vector<Gray8> same(256);
        detail::clahe_table<std::uint32_t>(narrow.data(), area, clip, table.data());
        detail::clahe_table<std::uint64_t>(wide.data(), area, clip, same.data());
        EXPECT_EQ(table, same);
        EXPECT_EQ(table[255], 255);
        EXPECT_EQ(narrow, std::vector<std::uint32_t>(256));
    }
    // More pixels than 32 bits hold 510 times.
    std::vector<std::uint32_t> counts(256, 1u << 20);
    std::vector<Gray8> table(256);
    detail::clahe_table(counts.data(), 256u << 20, max_clahe_clip, table.data());
    for (int level = 0; level < 256; ++level)
        EXPECT_EQ(table[static_cast<std::size_t>(level)], (510 * (level + 1) + 256) / 512);
}

TEST(Clahe, EqualsTheReferenceOnEverySize) {
    Random random(141);
    for (const Size size : test_sizes())
        for (const Size tiles : {Size{1, 1}, Size{2, 3}, Size{8, 8}, Size{32, 1}})
            for (const int clip : {100, 200, 25600}) {
                GuardedImage<Gray8> src(size), dst(size);
                for (int y = 0; y < size.height; ++y)
                    for (int x = 0; x < size.width; ++x)
                        src(x, y) = static_cast<Gray8>(std::min(255, x + random.between(0, 20)));
                ASSERT_EQ(run(src.view(), tiles, clip, dst.view()), Status::ok);
                const NaiveClahe naive(src.view(), tiles, clip);
                for (int y = 0; y < size.height; ++y)
                    for (int x = 0; x < size.width; ++x)
                        ASSERT_EQ(dst(x, y), naive.at(x, y)) << size.width << "x" << size.height << " tiles "
                                                             << tiles.width << " at " << x << "," << y;
            }
}

TEST(Clahe, OfOneTileWithoutClippingIsEqualizationByShare) {
    Random random(142);
    const Size size{60, 21};
    GuardedImage<Gray8> src(size), dst(size), equalized(size);
    src.fill(random);
    ASSERT_EQ(run(src.view(), {1, 1}, max_clahe_clip, dst.view()), Status::ok);
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(equalize_scratch()));
    ASSERT_EQ(equalize_by_share(src.view(), {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())},
                                equalized.view()),
              Status::ok);
    EXPECT_TRUE(equal(dst.view(), equalized.view()));
}

TEST(Clahe, KeepsAFlatImageFlat) {
    GuardedImage<Gray8> src({64, 64}), dst({64, 64});
    src.fill(Gray8{120});
    ASSERT_EQ(run(src.view(), {8, 8}, 100, dst.view()), Status::ok);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) ASSERT_EQ(dst(x, y), dst(0, 0));
    EXPECT_NEAR(dst(0, 0), 120, 8) << "the clipped pixels are dealt out to all levels alike";
}

}  // namespace
}  // namespace fovea::test
