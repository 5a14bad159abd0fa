// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include <core/filter/filter_check.hpp>
#include <fovea/feature/harris.hpp>
#include <fovea/stream/stream.hpp>

namespace fovea::test {
namespace {

std::int64_t naive_response(ImageView<const Gray8> src, Border border, int x, int y) {
    const auto at = [&](int i, int k) -> int {
        const int column = border_index(border, i, src.width());
        const int row = border_index(border, k, src.height());
        return column == no_index || row == no_index ? 0 : src(column, row);
    };
    std::int64_t pp = 0, qq = 0, pq = 0;
    for (int k = y - 1; k <= y + 1; ++k)
        for (int i = x - 1; i <= x + 1; ++i) {
            const std::int64_t p = at(i + 1, k) - at(i - 1, k);
            const std::int64_t q = at(i, k + 1) - at(i, k - 1);
            pp += p * p;
            qq += q * q;
            pq += p * q;
        }
    pp >>= 4;
    qq >>= 4;
    pq >>= 4;
    const std::int64_t trace = (pp + qq) >> 2;
    return pp * qq - pq * pq - trace * trace;
}

TEST(HarrisResponse, OfACornerWorkedByHand) {
    // A bright quarter, from (4, 4) on.
    const Size size{8, 8};
    GuardedImage<Gray8> src(size);
    GuardedImage<Response32> dst(size);
    src.fill(Gray8{0});
    for (int y = 4; y < 8; ++y)
        for (int x = 4; x < 8; ++x) src(x, y) = 40;
    run_filter(harris_response, harris_scratch(size), src, Border::replicate, dst);
    // At (4, 4): p is 40 in columns 3 and 4 of rows 4 and 5, q likewise. Four squares of 1600 each by 16 are
    // 400; both differences meet at (3, 4), (4, 3) and (4, 4) less those where one is 0: at (4, 4) alone.
    EXPECT_EQ(dst(4, 4), 400 * 400 - 100 * 100 - 200 * 200);
    // On the edge to the right there is one direction alone.
    EXPECT_EQ(dst(7, 4), -((0 + 600) / 4) * ((0 + 600) / 4));
    EXPECT_EQ(dst(1, 1), 0);
}

TEST(HarrisResponse, EqualsTheReferenceOnEverySizeAndBorder) {
    Random random(97);
    for (const Size size : test_sizes())
        for (const Border border : all_borders)
            for (const int filling : {0, 1, 2, 3}) {
                GuardedImage<Gray8> src(size);
                GuardedImage<Response32> dst(size);
                src.fill(random);
                for (int y = 0; y < size.height; ++y)
                    for (int x = 0; x < size.width; ++x) {
                        // Random, or blocks of 2x2 that make the largest sums.
                        if (filling == 1) src(x, y) = (x / 2 + y / 2) % 2 != 0 ? 255 : 0;
                        if (filling == 2) src(x, y) = x / 2 % 2 != 0 ? 255 : 0;
                        if (filling == 3) src(x, y) = (x + y) / 2 % 2 != 0 ? 255 : 0;
                    }
                run_filter(harris_response, harris_scratch(size), src, border, dst);
                for (int y = 0; y < size.height; ++y)
                    for (int x = 0; x < size.width; ++x)
                        ASSERT_EQ(std::int64_t{dst(x, y)}, naive_response(src.view(), border, x, y))
                            << size.width << "x" << size.height << " border " << static_cast<int>(border)
                            << " at " << x << "," << y;
            }
}

TEST(HarrisResponse, IsTransposedWithTheImage) {
    Random random(98);
    GuardedImage<Gray8> src({45, 31}), other({31, 45});
    GuardedImage<Response32> dst({45, 31}), turned({31, 45});
    src.fill(random);
    for (int y = 0; y < 31; ++y)
        for (int x = 0; x < 45; ++x) other(y, x) = src(x, y);
    run_filter(harris_response, harris_scratch({45, 31}), src, Border::reflect_101, dst);
    run_filter(harris_response, harris_scratch({31, 45}), other, Border::reflect_101, turned);
    for (int y = 0; y < 31; ++y)
        for (int x = 0; x < 45; ++x) ASSERT_EQ(dst(x, y), turned(y, x));
}

TEST(HarrisResponse, IsAStage) {
    Random random(99);
    const Size size{61, 17};
    GuardedImage<Gray8> src(size);
    GuardedImage<Response32> dst(size), streamed(size);
    src.fill(random);
    run_filter(harris_response, harris_scratch(size), src, Border::zero, dst);
    auto program = stream(stages::harris_response, into(streamed.view()));
    std::vector<std::uint8_t> scratch(20000);
    ASSERT_EQ(program.run(src.view(), Border::zero, {scratch.data(), 20000}), Status::ok);
    EXPECT_TRUE(equal(dst.view(), streamed.view()));
}

TEST(HarrisResponse, SaysWhatIsWrong) {
    std::vector<std::uint8_t> bytes(20000);
    const Size size{40, 8};
    const auto needed = static_cast<std::ptrdiff_t>(harris_scratch(size));
    GuardedImage<Gray8> src(size);
    GuardedImage<Response32> dst(size), small({39, 8});
    dst.fill(Response32{3});
    EXPECT_EQ(harris_response({}, Border::zero, {bytes.data(), needed}, dst.view()), Status::empty_image);
    EXPECT_EQ(harris_response(src.view(), Border::zero, {bytes.data(), needed}, small.view()),
              Status::size_mismatch);
    EXPECT_EQ(harris_response(src.view(), Border::zero, {bytes.data(), needed - 1}, dst.view()),
              Status::scratch_too_small);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 40; ++x) EXPECT_EQ(dst(x, y), 3);
}

}  // namespace
}  // namespace fovea::test
