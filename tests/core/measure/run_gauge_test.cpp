// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/measure/run_gauge.hpp>
#include <fovea/stream/stream.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

void expect_equal(const Result<RunWidths>& a, const Result<RunWidths>& b) {
    ASSERT_EQ(a.status(), b.status());
    if (!a) return;
    EXPECT_EQ(a->rows, b->rows);
    EXPECT_EQ(a->first_row, b->first_row);
    EXPECT_EQ(a->last_row, b->last_row);
    EXPECT_EQ(a->narrowest, b->narrowest);
    EXPECT_EQ(a->widest, b->widest);
    EXPECT_EQ(a->mean, b->mean);
}

Result<RunWidths> naive_run_widths(ImageView<const Gray8> src, int width_min) {
    RunWidths found;
    std::int64_t sum = 0;
    for (int y = 0; y < src.height(); ++y) {
        int longest = 0;
        for (int x = 0, run = 0; x < src.width(); ++x) {
            run = src(x, y) != 0 ? run + 1 : 0;
            longest = std::max(longest, run);
        }
        if (longest < width_min) continue;
        if (found.rows++ == 0) found.first_row = y, found.narrowest = longest;
        found.last_row = y;
        found.narrowest = std::min(found.narrowest, longest);
        found.widest = std::max(found.widest, longest);
        sum += longest;
    }
    if (found.rows == 0) return Status::not_found;
    // To the nearest, ties up.
    found.mean =
        FinePixel::from_raw(static_cast<std::int32_t>((sum * 131072 + found.rows) / (2 * found.rows)));
    return found;
}

/// Clumps of a random density.
void fill_runs(GuardedImage<Gray8>& image, Size size, Random& random) {
    const std::uint32_t change = 1 + random.below(30);
    for (int y = 0; y < size.height; ++y) {
        bool inside = random.below(2) != 0;
        for (int x = 0; x < size.width; ++x) {
            if (random.below(change) == 0) inside = !inside;
            image(x, y) = static_cast<Gray8>(inside ? random.between(1, 255) : 0);
        }
    }
}

TEST(RunWidths, OfAPartWithASpeck) {
    const std::string rows[] = {
        "..........",  //
        ".#........",  // a speck
        "..####....",  //
        ".#.#####.#",  // the longest run counts alone
        "...#######",  //
        "..........",
    };
    GuardedImage<Gray8> image({10, 6});
    for (int y = 0; y < 6; ++y)
        for (int x = 0; x < 10; ++x)
            image(x, y) = rows[y][static_cast<std::size_t>(x)] == '#' ? Gray8{255} : Gray8{0};
    const Result<RunWidths> widths = run_widths(image.view(), 2);
    ASSERT_TRUE(widths.ok());
    EXPECT_EQ(widths->rows, 3);
    EXPECT_EQ(widths->first_row, 2);
    EXPECT_EQ(widths->last_row, 4);
    EXPECT_EQ(widths->narrowest, 4);
    EXPECT_EQ(widths->widest, 7);
    EXPECT_EQ(widths->mean.raw(), 349525);  // 16 / 3 = 5.33333
    EXPECT_EQ(run_widths(image.view(), 1)->first_row, 1);
    EXPECT_EQ(run_widths(image.view(), 8).status(), Status::not_found);
}

TEST(RunWidths, AreThoseOfTheObviousWay) {
    Random random(51);
    for (const Size size : test_sizes())
        for (int turn = 0; turn < 8; ++turn) {
            GuardedImage<Gray8> image(size);
            fill_runs(image, size, random);
            const int width_min = random.between(1, 6);
            expect_equal(run_widths(image.view(), width_min), naive_run_widths(image.view(), width_min));
            EXPECT_EQ(longest_run(image.view().row(0), size.width) >= 1,
                      run_widths(*image.view().crop({0, 0, size.width, 1}), 1).ok());
        }
}

TEST(RunWidths, OfExtremeImages) {
    GuardedImage<Gray8> image({33, 5});
    image.fill(Gray8{0});
    EXPECT_EQ(run_widths(image.view(), 1).status(), Status::not_found);
    image.fill(Gray8{255});
    expect_equal(run_widths(image.view(), 33), RunWidths{5, 0, 4, 33, 33, FinePixel::from_int(33)});
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 33; ++x) image(x, y) = (x + y) % 2 == 0 ? Gray8{1} : Gray8{0};
    expect_equal(run_widths(image.view(), 1), RunWidths{5, 0, 4, 1, 1, FinePixel::from_int(1)});
}

TEST(RunWidths, StayWhereThePartIsShifted) {
    Random random(52);
    GuardedImage<Gray8> image({40, 9}), shifted({60, 20});
    fill_runs(image, {40, 9}, random);
    shifted.fill(Gray8{0});
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 40; ++x) shifted(x + 13, y + 6) = image(x, y);
    RunWidths expected = *run_widths(image.view(), 1);
    expected.first_row += 6;
    expected.last_row += 6;
    expect_equal(run_widths(shifted.view(), 1), expected);
}

TEST(RunWidths, SayWhatIsWrong) {
    GuardedImage<Gray8> image({4, 3});
    image.fill(Gray8{255});
    EXPECT_EQ(run_widths({}, 1).status(), Status::empty_image);
    EXPECT_EQ(run_widths(image.view(), 0).status(), Status::bad_argument);
    EXPECT_EQ(RunWidthAccumulator(1).begin({max_image_side + 1, 1}), Status::image_too_large);
    EXPECT_EQ(RunWidthAccumulator(1).begin({1, max_image_side + 1}), Status::image_too_large);
    EXPECT_EQ(RunWidthAccumulator(1).result().status(), Status::not_found);
}

TEST(RunWidthAccumulator, GivesTheSameOfRowsAndOfStrips) {
    Random random(53);
    std::vector<std::uint8_t> memory(1 << 13);
    const Span<std::uint8_t> work{memory.data(), 1 << 13};
    for (const Size size : test_sizes()) {
        GuardedImage<Gray8> image(size);
        fill_runs(image, size, random);
        const Result<RunWidths> expected = run_widths(image.view(), 3);
        RunWidthAccumulator accumulator(3);
        auto rows = stream(into(accumulator));
        // Once more with the same one: every image begins anew.
        for (int time = 0; time < 2; ++time) {
            ASSERT_EQ(rows.start(size, Border::zero, work), Status::ok);
            for (int y = 0; y < size.height; ++y) ASSERT_EQ(rows.push(image.view().row(y)), Status::ok);
            expect_equal(accumulator.result(), expected);
        }
        if (size.height < 2) continue;
        auto lower = stream(RunWidthAccumulator(3));
        auto upper = stream(RunWidthAccumulator(3));
        const int middle = size.height / 2;
        ASSERT_EQ(lower.run_strip(image.view(), Border::zero, middle, size.height - 1, work), Status::ok);
        ASSERT_EQ(upper.run_strip(image.view(), Border::zero, 0, middle - 1, work), Status::ok);
        lower.accumulator().merge(upper.accumulator());
        expect_equal(lower.accumulator().result(), expected);
    }
}

}  // namespace
}  // namespace fovea::test
