// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/filter/box.hpp>
#include <fovea/pixelwise/point_stages.hpp>
#include <fovea/statistics/binary_moments.hpp>
#include <fovea/statistics/histogram.hpp>
#include <fovea/stream/stream.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

std::vector<std::int64_t> sums_of(const Moments& m) {
    return {m.m00, m.m10, m.m01, m.m20, m.m11, m.m02, m.m30, m.m21, m.m12, m.m03};
}

/// Pixel by pixel, as runs of one.
Moments naive(ImageView<const Gray8> image) {
    Moments moments;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            if (image(x, y) != 0) moments.add_run(x, x + 1, y);
    return moments;
}

/// Pixels of which one in share is 0, the others any number.
void fill_some(GuardedImage<Gray8>& image, std::uint32_t share, Random& random) {
    const Size size = image.view().size();
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            image(x, y) = random.below(share) == 0 ? Gray8{0} : static_cast<Gray8>(1 + random.below(255));
}

TEST(BinaryMoments, OfThreePixelsByHand) {
    GuardedImage<Gray8> src({5, 4});
    src.fill(0);
    src(2, 3) = 255;
    src(3, 3) = 1;  // any number but 0 counts once
    src(0, 1) = 128;
    const std::vector<std::int64_t> expected = {3, 5, 7, 13, 15, 19, 35, 39, 45, 55};
    EXPECT_EQ(sums_of(*moments_of(src.view())), expected);
}

TEST(BinaryMoments, EqualTheReferenceExactly) {
    Random random(611);
    std::vector<Size> sizes = test_sizes();
    for (const int width : {703, 704, 705, 1407, 1409, 2500, max_moment_side}) sizes.push_back({width, 3});
    sizes.push_back({3, 2000});
    for (const Size size : sizes)
        for (const std::uint32_t share : {1u, 2u, 50u}) {
            GuardedImage<Gray8> src(size);
            fill_some(src, share, random);
            ASSERT_EQ(sums_of(*moments_of(src.view())), sums_of(naive(src.view()))) << size.width;
            src.fill(255);
            ASSERT_EQ(sums_of(*moments_of(src.view())), sums_of(naive(src.view()))) << size.width;
        }
}

TEST(BinaryMoments, OfTheLargestImageFit63Bits) {
    const std::vector<Gray8> row(max_moment_side, 255);
    const ImageView<const Gray8> src(row.data(), {max_moment_side, max_moment_side}, 0);
    Moments expected;
    for (int y = 0; y < max_moment_side; ++y) expected.add_run(0, max_moment_side, y);
    EXPECT_EQ(sums_of(*moments_of(src)), sums_of(expected));
}

TEST(BinaryMoments, MoveWithThePixelsAndTurnWithTheAxes) {
    Random random(612);
    GuardedImage<Gray8> src({150, 40});
    GuardedImage<Gray8> turned({40, 150});
    fill_some(src, 3, random);
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 150; ++x) turned(y, x) = src(x, y);
    const Moments a = *moments_of(src.view());
    const Moments b = *moments_of(turned.view());
    const std::vector<std::int64_t> swapped = {b.m00, b.m01, b.m10, b.m02, b.m11,
                                               b.m20, b.m03, b.m12, b.m21, b.m30};
    EXPECT_EQ(sums_of(a), swapped);
}

TEST(BinaryMoments, SayWhatTheyCannotTake) {
    EXPECT_EQ(moments_of(ImageView<const Gray8>()).status(), Status::empty_image);
    const std::vector<Gray8> row(65535, 255);
    EXPECT_EQ(moments_of(ImageView<const Gray8>(row.data(), {65535, 1}, 65535)).status(),
              Status::image_too_large);
    EXPECT_EQ(moments_of(ImageView<const Gray8>(row.data(), {1, 8192}, 1)).status(), Status::image_too_large);
    BinaryMoments sums;
    ASSERT_EQ(sums.begin({3, 1}), Status::ok);
    sums.add_row(row.data(), 3, 0);
    EXPECT_EQ(sums.begin({8192, 1}), Status::image_too_large);
    EXPECT_EQ(sums.begin({0, 1}), Status::empty_image);
    EXPECT_EQ(sums.moments().m00, 3);
    ASSERT_EQ(sums.begin({3, 1}), Status::ok);
    EXPECT_EQ(sums.moments().m00, 0);
}

/// What accumulators hold after a stream, and after the strips of it, each with an accumulator of its own.
TEST(BinaryMoments, OfAStreamAndOfItsStripsAreThoseOfTheFrame) {
    Random random(613);
    for (const Size size : test_sizes()) {
        GuardedImage<Gray8> src(size);
        GuardedImage<Gray8> smooth(size);
        GuardedImage<Gray8> binary(size);
        src.fill(random);
        std::vector<std::uint8_t> bytes(1 << 16);
        const Span<std::uint8_t> scratch(bytes.data(), static_cast<std::ptrdiff_t>(bytes.size()));
        ASSERT_EQ(box(src.view(), {3, 3}, Border::replicate, scratch, smooth.view()), Status::ok);
        ASSERT_EQ(threshold(smooth.view(), 128, binary.view()), Status::ok);
        const std::vector<std::int64_t> expected = sums_of(*moments_of(binary.view()));
        Histogram levels;
        ASSERT_EQ(histogram_of(smooth.view(), levels), Status::ok);

        BinaryMoments sums;
        Histogram seen;
        auto whole = stream(stages::box{{3, 3}}, tap(seen), stages::threshold{128}, into(sums));
        ASSERT_EQ(whole.run(src.view(), Border::replicate, scratch), Status::ok);
        ASSERT_EQ(sums_of(sums.moments()), expected);
        for (int i = 0; i < levels.size(); ++i) ASSERT_EQ(seen[i], levels[i]);

        BinaryMoments joined;
        Histogram all;
        for (int y = 0; y < size.height; y += 3) {
            const int last = std::min(y + 2, size.height - 1);
            ASSERT_EQ(whole.run_strip(src.view(), Border::replicate, y, last, scratch), Status::ok);
            joined.merge(sums);
            all.merge(seen);
        }
        ASSERT_EQ(sums_of(joined.moments()), expected);
        for (int i = 0; i < levels.size(); ++i) ASSERT_EQ(all[i], levels[i]);
    }
}

}  // namespace
}  // namespace fovea::test
