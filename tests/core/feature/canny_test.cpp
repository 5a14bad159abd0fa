// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/feature/canny.hpp>
#include <fovea/filter/sobel.hpp>
#include <support/guarded_image.hpp>
#include <support/naive_reference.hpp>

namespace fovea::test {
namespace {

Span<std::uint8_t> span_of(std::vector<std::uint8_t>& bytes) {
    return {bytes.data(), static_cast<std::ptrdiff_t>(bytes.size())};
}

GuardedImage<Gray8> canny_of(GuardedImage<Gray8>& src, int low, int high, Border border) {
    GuardedImage<Gray8> dst(src.view().size());
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(canny_scratch(src.view().size())), 0xee);
    EXPECT_EQ(canny(src.view(), low, high, border, span_of(scratch), dst.view()), Status::ok);
    return dst;
}

/// What canny() is, pixel by pixel.
class SlowCanny {
public:
    /// Neighbours are those of the row below a slope of tangent / 32768, of the column above tangent / 32768
    /// + more.
    SlowCanny(ImageView<const Gray8> src, Border border, int tangent = 13573, int more = 65536)
        : src_(src), border_(border), tangent_(tangent), more_(more) {}

    GuardedImage<Gray8> edges(int low, int high) const {
        GuardedImage<Gray8> dst(src_.size());
        dst.fill(Gray8{0});
        for (int y = 0; y < src_.height(); ++y)
            for (int x = 0; x < src_.width(); ++x)
                if (strength(x, y) > high && is_ridge(x, y)) dst(x, y) = 255;
        for (bool grows = true; grows;) {
            grows = false;
            for (int y = 0; y < src_.height(); ++y)
                for (int x = 0; x < src_.width(); ++x) {
                    if (dst(x, y) != 0 || strength(x, y) <= low || !is_ridge(x, y)) continue;
                    for (int j = y - 1; j <= y + 1; ++j)
                        for (int i = x - 1; i <= x + 1; ++i)
                            if (src_.contains({i, j}) && dst(i, j) != 0) dst(x, y) = 255;
                    grows = grows || dst(x, y) != 0;
                }
        }
        return dst;
    }

private:
    int to_x(int x, int y) const {
        return naive_correlation(src_, border_, {3, 3}, {-1, 0, 1, -2, 0, 2, -1, 0, 1}, x, y);
    }
    int to_y(int x, int y) const {
        return naive_correlation(src_, border_, {3, 3}, {-1, -2, -1, 0, 0, 0, 1, 2, 1}, x, y);
    }
    int strength(int x, int y) const {
        return src_.contains({x, y}) ? std::abs(to_x(x, y)) + std::abs(to_y(x, y)) : 0;
    }
    bool is_ridge(int x, int y) const {
        const int gx = to_x(x, y), gy = to_y(x, y), here = strength(x, y);
        const std::int64_t tangent = std::int64_t{std::abs(gx)} * tangent_;
        const std::int64_t rise = std::int64_t{std::abs(gy)} * 32768;
        if (rise < tangent) return here > strength(x - 1, y) && here >= strength(x + 1, y);
        if (rise > tangent + std::int64_t{std::abs(gx)} * more_)
            return here > strength(x, y - 1) && here >= strength(x, y + 1);
        const int step = (gx < 0) == (gy < 0) ? 1 : -1;
        return here > strength(x - step, y - 1) && here > strength(x + step, y + 1);
    }

    ImageView<const Gray8> src_;
    Border border_;
    int tangent_;
    int more_;
};

/// Flat tiles with a little noise: edges of every direction and strength.
void fill_tiles(GuardedImage<Gray8>& image, Random& random, int side) {
    const int a = random.between(1, 9), b = random.between(1, 9), tilt = random.between(0, 5);
    for (int y = 0; y < image.view().height(); ++y)
        for (int x = 0; x < image.view().width(); ++x) {
            const int tile = (x + y * tilt / 4) / side * a + (y + x * tilt / 3) / side * b;
            image(x, y) = static_cast<Gray8>(tile * 37 % 200 + random.between(0, 20));
        }
}

TEST(Canny, DrawsAStepAsOneColumn) {
    GuardedImage<Gray8> src({9, 5});
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 9; ++x) src(x, y) = x < 5 ? 10 : 110;
    // Columns 4 and 5 have 4 * 100; of equal neighbours the left one keeps the edge.
    const GuardedImage<Gray8> edges = canny_of(src, 100, 399, Border::replicate);
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 9; ++x) EXPECT_EQ(edges(x, y), x == 4 ? 255 : 0) << x << "," << y;
    const GuardedImage<Gray8> none = canny_of(src, 100, 400, Border::replicate);
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 9; ++x) EXPECT_EQ(none(x, y), 0);
}

TEST(Canny, FollowsAWeakEdgeFromAStrongOne) {
    // The step falls from 100 to 20 down the rows, and from 100 to 20 on the right with a gap between.
    GuardedImage<Gray8> src({40, 20});
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 40; ++x) {
            const int left = 100 - 4 * y;
            src(x, y) = static_cast<Gray8>(x < 10 ? 0 : x < 28 ? left : left + 20);
        }
    const GuardedImage<Gray8> edges = canny_of(src, 60, 350, Border::replicate);
    for (int y = 0; y < 18; ++y) {
        EXPECT_EQ(edges(9, y) + edges(10, y), 255) << y;
        EXPECT_EQ(edges(27, y) + edges(28, y), 0) << "joined to no strong edge, row " << y;
    }
}

TEST(Canny, EqualsTheReferenceOnEverySizeBorderAndLimit) {
    Random random(11);
    for (const Size size : test_sizes())
        for (const Border border : {Border::replicate, Border::reflect_101, Border::zero})
            for (int round = 0; round < 6; ++round) {
                GuardedImage<Gray8> src(size);
                if (round == 0)
                    src.fill(random);
                else
                    fill_tiles(src, random, 2 + round);
                const int low = random.between(0, 400);
                const int high = random.between(low, 900);
                const GuardedImage<Gray8> got = canny_of(src, low, high, border);
                ASSERT_TRUE(equal(got.view(), SlowCanny(src.view(), border).edges(low, high).view()))
                    << size.width << "x" << size.height << " " << low << " " << high << " round " << round;
            }
}

TEST(Canny, FindsNothingInFlatImagesAndAllRidgesAtZero) {
    const Size size{70, 9};
    for (const int level : {0, 255}) {
        GuardedImage<Gray8> src(size);
        src.fill(static_cast<Gray8>(level));
        GuardedImage<Gray8> black(size);
        black.fill(Gray8{0});
        EXPECT_TRUE(equal(canny_of(src, 0, 0, Border::replicate).view(), black.view()));
    }
    GuardedImage<Gray8> board(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) board(x, y) = (x / 3 + y / 3) % 2 == 0 ? 255 : 0;
    EXPECT_TRUE(equal(canny_of(board, 0, 0, Border::zero).view(),
                      SlowCanny(board.view(), Border::zero).edges(0, 0).view()));
    EXPECT_TRUE(equal(canny_of(board, max_gradient_strength, max_gradient_strength, Border::zero).view(),
                      SlowCanny(board.view(), Border::zero).edges(2040, 2040).view()));
}

TEST(Canny, LosesEdgesAsTheLimitsRise) {
    Random random(12);
    GuardedImage<Gray8> src({131, 40});
    fill_tiles(src, random, 7);
    GuardedImage<Gray8> before = canny_of(src, 0, 0, Border::replicate);
    for (int limit = 40; limit <= 800; limit += 40) {
        GuardedImage<Gray8> edges = canny_of(src, limit / 2, limit, Border::replicate);
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < 131; ++x) ASSERT_LE(edges(x, y), before(x, y));
        before = edges;
    }
}

TEST(Canny, HasSectorsOf22And67DegreesNotTheToolkitsOf26And63) {
    Random random(14);
    GuardedImage<Gray8> src({120, 60});
    fill_tiles(src, random, 9);
    const GuardedImage<Gray8> edges = canny_of(src, 50, 120, Border::replicate);
    EXPECT_TRUE(equal(edges.view(), SlowCanny(src.view(), Border::replicate).edges(50, 120).view()));
    const SlowCanny toolkit(src.view(), Border::replicate, 16384, 49152);
    EXPECT_FALSE(equal(edges.view(), toolkit.edges(50, 120).view()));
}

TEST(EdgeGrowth, NeedsMoreTimeButFindsTheSameWithAStackOfOnePlace) {
    Random random(13);
    for (const Size size : {Size{1, 1}, Size{9, 1}, Size{1, 9}, Size{10, 3}, Size{67, 23}})
        for (int round = 0; round < 40; ++round) {
            GuardedImage<Gray8> marks(size);
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x) {
                    const int draw = random.between(0, 99);
                    marks(x, y) = draw < 2    ? detail::edge_mark
                                  : draw < 42 ? detail::candidate_mark
                                              : Gray8{0};
                }
            GuardedImage<Gray8> other = marks;
            std::vector<detail::PixelPlace> places(1000);
            for (const int room : {1, 1000}) {
                const ImageView<Gray8> view = room == 1 ? marks.view() : other.view();
                detail::EdgeGrowth growth(view, {places.data(), room});
                for (int y = 0; y < size.height; ++y) growth.take_row(y);
                growth.finish();
            }
            ASSERT_TRUE(equal(marks.view(), other.view()));
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x)
                    for (int j = std::max(y - 1, 0); j <= std::min(y + 1, size.height - 1); ++j)
                        for (int i = std::max(x - 1, 0); i <= std::min(x + 1, size.width - 1); ++i)
                            ASSERT_NE(marks(x, y) | marks(i, j), detail::either_mark) << "left unjoined";
        }
}

TEST(Canny, RefusesLimitsThatAreNoneOrCross) {
    GuardedImage<Gray8> src({8, 8}), dst({8, 8});
    src.fill(Gray8{1});
    dst.fill(Gray8{77});
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(canny_scratch({8, 8})));
    for (const auto& [low, high] : {std::pair{-1, 5}, {6, 5}, {5, 2041}})
        EXPECT_EQ(canny(src.view(), low, high, Border::replicate, span_of(scratch), dst.view()),
                  Status::bad_argument);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) EXPECT_EQ(dst(x, y), 77);
}

}  // namespace
}  // namespace fovea::test
