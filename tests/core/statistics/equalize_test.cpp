// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/statistics/equalize.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

std::vector<std::uint8_t> bytes(std::int64_t count) {
    return std::vector<std::uint8_t>(static_cast<std::size_t>(count));
}
Span<std::uint8_t> span_of(std::vector<std::uint8_t>& bytes) {
    return {bytes.data(), static_cast<std::ptrdiff_t>(bytes.size())};
}

TEST(Equalize, MapsFourLevelsByHand) {
    // Cumulated 1, 2, 3, 4 of 4: with the first taken off 0, 1, 2, 3 of 3.
    GuardedImage<Gray8> src({4, 1}), dst({4, 1});
    const Gray8 levels[] = {50, 10, 200, 60};
    for (int x = 0; x < 4; ++x) src(x, 0) = levels[x];
    std::vector<std::uint8_t> scratch = bytes(equalize_scratch());
    ASSERT_EQ(equalize(src.view(), span_of(scratch), dst.view()), Status::ok);
    const int expected[] = {85, 0, 255, 170};
    for (int x = 0; x < 4; ++x) EXPECT_EQ(dst(x, 0), expected[x]);
    ASSERT_EQ(equalize_by_share(src.view(), span_of(scratch), dst.view()), Status::ok);
    const int by_share[] = {128, 64, 255, 191};
    for (int x = 0; x < 4; ++x) EXPECT_EQ(dst(x, 0), by_share[x]);
}

TEST(Equalize, IsTheShareOfDarkerPixelsOnEverySize) {
    Random random(131);
    for (const Size size : test_sizes()) {
        GuardedImage<Gray8> src(size), dst(size), by_share(size);
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x)
                src(x, y) = static_cast<Gray8>(100 + random.between(0, 9) * random.between(0, 9));
        std::vector<std::uint8_t> scratch = bytes(equalize_scratch());
        ASSERT_EQ(equalize(src.view(), span_of(scratch), dst.view()), Status::ok);
        ASSERT_EQ(equalize_by_share(src.view(), span_of(scratch), by_share.view()), Status::ok);
        std::vector<std::int64_t> up_to(256);
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x)
                for (std::size_t level = src(x, y); level < 256; ++level) ++up_to[level];
        const std::int64_t count = size.area();
        std::int64_t first = 0;
        for (std::size_t level = 0; first == 0; ++level) first = up_to[level];
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
                const std::int64_t below = up_to[src(x, y)];
                ASSERT_EQ(by_share(x, y), (510 * below + count) / (2 * count));
                ASSERT_EQ(dst(x, y), first == count
                                         ? src(x, y)
                                         : (510 * (below - first) + count - first) / (2 * (count - first)));
            }
    }
}

TEST(Equalize, LeavesAnImageOfOneLevel) {
    GuardedImage<Gray8> src({7, 3}), dst({7, 3});
    src.fill(Gray8{93});
    std::vector<std::uint8_t> scratch = bytes(equalize_scratch());
    ASSERT_EQ(equalize(src.view(), span_of(scratch), dst.view()), Status::ok);
    EXPECT_TRUE(equal(src.view(), dst.view()));
    ASSERT_EQ(equalize_by_share(src.view(), span_of(scratch), dst.view()), Status::ok);
    EXPECT_EQ(dst(3, 1), 255);
}

TEST(EqualizeTable, NeedsAPixel) {
    const Histogram histogram;
    EXPECT_EQ(equalize_table(histogram).status(), Status::empty_image);
    EXPECT_EQ(equalize_by_share_table(histogram).status(), Status::empty_image);
}

// The toolkit swapped the layouts: of 16 pixels (100, 50, 0) and others it made (201, 102, 2).
TEST(NormalizeColour, EqualizesEachChannelOnItsOwn) {
    Random random(132);
    for (const Size size : test_sizes()) {
        GuardedImage<Rgb888> src(size), dst(size);
        src.fill(random);
        std::vector<std::uint8_t> scratch = bytes(normalize_colour_scratch());
        ASSERT_EQ(normalize_colour(src.view(), span_of(scratch), dst.view()), Status::ok);
        const auto channel = [&](auto take) {
            GuardedImage<Gray8> from(size), to(size);
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x) from(x, y) = take(src(x, y));
            std::vector<std::uint8_t> room = bytes(equalize_scratch());
            EXPECT_EQ(equalize_by_share(from.view(), span_of(room), to.view()), Status::ok);
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x) EXPECT_EQ(take(dst(x, y)), to(x, y));
        };
        channel([](Rgb888 colour) { return colour.red; });
        channel([](Rgb888 colour) { return colour.green; });
        channel([](Rgb888 colour) { return colour.blue; });
    }
}

}  // namespace
}  // namespace fovea::test
