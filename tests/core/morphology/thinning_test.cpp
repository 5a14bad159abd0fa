// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vector>

#include <core/segment/contour_pictures.hpp>
#include <fovea/morphology/thinning.hpp>
#include <fovea/segment/label_image.hpp>

namespace fovea::test {
namespace {

GuardedImage<Gray8> thinned(const GuardedImage<Gray8>& src, ThinningRule rule,
                            int passes = most_thinning_passes) {
    GuardedImage<Gray8> dst(src.view().size());
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(thin_scratch(src.view().size())), 0xee);
    EXPECT_EQ(thin(src.view(), rule, passes, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())},
                   dst.view()),
              Status::ok);
    return dst;
}

int count(const GuardedImage<Gray8>& image) {
    int pixels = 0;
    for (int y = 0; y < image.view().height(); ++y)
        for (int x = 0; x < image.view().width(); ++x) pixels += image(x, y) != 0 ? 1 : 0;
    return pixels;
}

/// A half pass as the papers put it: all marks first, then all of them taken.
bool naive_half(GuardedImage<Gray8>& image, ThinningRule rule, int half) {
    std::vector<Point> gone;
    const auto at = [&](int x, int y) { return image.view().contains({x, y}) && image(x, y) != 0; };
    for (int y = 0; y < image.view().height(); ++y)
        for (int x = 0; x < image.view().width(); ++x) {
            if (image(x, y) == 0) continue;
            const bool p2 = at(x, y - 1), p3 = at(x + 1, y - 1), p4 = at(x + 1, y), p5 = at(x + 1, y + 1),
                       p6 = at(x, y + 1), p7 = at(x - 1, y + 1), p8 = at(x - 1, y), p9 = at(x - 1, y - 1);
            bool takes = false;
            if (rule == ThinningRule::zhang_suen) {
                const int a = (!p2 && p3) + (!p3 && p4) + (!p4 && p5) + (!p5 && p6) + (!p6 && p7) +
                              (!p7 && p8) + (!p8 && p9) + (!p9 && p2);
                const int b = p2 + p3 + p4 + p5 + p6 + p7 + p8 + p9;
                const bool one = half == 0 ? !(p2 && p4 && p6) : !(p2 && p4 && p8);
                const bool two = half == 0 ? !(p4 && p6 && p8) : !(p2 && p6 && p8);
                takes = a == 1 && b >= 2 && b <= 6 && one && two;
            } else {
                const int c =
                    (!p2 && (p3 || p4)) + (!p4 && (p5 || p6)) + (!p6 && (p7 || p8)) + (!p8 && (p9 || p2));
                const int n1 = (p9 || p2) + (p3 || p4) + (p5 || p6) + (p7 || p8);
                const int n2 = (p2 || p3) + (p4 || p5) + (p6 || p7) + (p8 || p9);
                const int n = std::min(n1, n2);
                const bool m = half == 0 ? ((p2 || p3 || !p5) && p4) : ((p6 || p7 || !p9) && p8);
                takes = c == 1 && n >= 2 && n <= 3 && !m;
            }
            if (takes) gone.push_back({x, y});
        }
    for (const Point p : gone) image(p.x, p.y) = 0;
    return !gone.empty();
}

TEST(Thin, ABarBecomesALineInItsMiddle) {
    GuardedImage<Gray8> src({13, 7});
    src.fill(Gray8{0});
    for (int y = 2; y <= 4; ++y)
        for (int x = 2; x <= 10; ++x) src(x, y) = 1;
    for (const auto rule : {ThinningRule::zhang_suen, ThinningRule::guo_hall}) {
        const auto dst = thinned(src, rule);
        for (int y = 0; y < 7; ++y)
            for (int x = 0; x < 13; ++x)
                if (dst(x, y) != 0) {
                    EXPECT_EQ(y, 3);
                    EXPECT_EQ(dst(x, y), 255);
                }
        EXPECT_GE(count(dst), 6);
    }
}

TEST(Thin, EqualsTheRulesAsThePapersPutThem) {
    Random random(25);
    for (int round = 0; round < 60; ++round) {
        const auto src = random_blocks({random.between(1, 40), random.between(1, 30)}, random);
        for (const auto rule : {ThinningRule::zhang_suen, ThinningRule::guo_hall})
            for (const int passes : {1, 2, 1000}) {
                GuardedImage<Gray8> expected = src;
                for (int i = 0; i < passes; ++i) {
                    const bool first = naive_half(expected, rule, 0);
                    const bool second = naive_half(expected, rule, 1);
                    if (!first && !second) break;
                }
                ASSERT_TRUE(equal(thinned(src, rule, passes).view(), expected.view())) << "round " << round;
            }
    }
}

TEST(Thin, TwiceIsTheSameAsOnceAndNoRegionFallsApart) {
    Random random(26);
    for (int round = 0; round < 40; ++round) {
        const auto src = random_blocks({40, 30}, random);
        const auto dst = thinned(src, ThinningRule::guo_hall);
        EXPECT_TRUE(equal(thinned(dst, ThinningRule::guo_hall).view(), dst.view()));
        GuardedImage<Label16> labels({40, 30});
        std::vector<std::uint8_t> scratch(static_cast<std::size_t>(label_image_scratch({40, 30})));
        const Span<std::uint8_t> bytes{scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())};
        const int before = label_image(src.view(), Connectivity::eight, bytes, labels.view()).value();
        EXPECT_EQ(label_image(dst.view(), Connectivity::eight, bytes, labels.view()).value(), before);
    }
}

TEST(Thin, LeavesPixelsLinesAndSpirals) {
    EXPECT_EQ(count(thinned(drawn({"#"}), ThinningRule::zhang_suen)), 1);
    const auto line = drawn({"......", ".####.", "......"});
    EXPECT_TRUE(equal(thinned(line, ThinningRule::zhang_suen).view(), line.view()));
    GuardedImage<Gray8> full({31, 21});
    full.fill(Gray8{255});
    EXPECT_LT(count(thinned(full, ThinningRule::guo_hall)), 60);
    EXPECT_GT(count(thinned(spiral(61), ThinningRule::guo_hall)), 500);
}

TEST(Thin, RefusesPassesOutOfRange) {
    GuardedImage<Gray8> src({4, 4}), dst({4, 4});
    src.fill(Gray8{1});
    std::uint8_t scratch[16];
    for (const int passes : {0, -5, most_thinning_passes + 1})
        EXPECT_EQ(thin(src.view(), ThinningRule::guo_hall, passes, scratch, dst.view()),
                  Status::bad_argument);
}

}  // namespace
}  // namespace fovea::test
