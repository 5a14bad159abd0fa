// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/motion/block_motion.hpp>
#include <fovea/stream/stream.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

/// With memory of its own.
struct Watch {
    Watch(Size size, const BlockMotionOptions& options)
        : background(static_cast<std::size_t>(blocks_of(size, options.block).area())),
          scratch(static_cast<std::size_t>(block_motion_scratch(size, options.block))),
          accumulator(options, {background.data(), static_cast<std::ptrdiff_t>(background.size())},
                      {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}) {}
    Watch(const Watch&) = delete;

    Result<BlockMotion> see(const GuardedImage<Gray8>& image) {
        return block_motion(image.view(), accumulator);
    }

    std::vector<std::uint16_t> background;
    std::vector<std::uint8_t> scratch;
    BlockMotionAccumulator accumulator;
};

/// Pixel by pixel, with a sorted list for the median.
struct NaiveWatch {
    BlockMotionOptions options;
    std::vector<int> background;

    Result<BlockMotion> see(const GuardedImage<Gray8>& image, Size size) {
        const int across = (size.width + options.block - 1) / options.block;
        const int down = (size.height + options.block - 1) / options.block;
        std::vector<int> sums(static_cast<std::size_t>(across * down)), counts = sums, means = sums;
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
                const auto i = static_cast<std::size_t>(y / options.block * across + x / options.block);
                sums[i] += image(x, y);
                counts[i] += 1;
            }
        for (std::size_t i = 0; i < sums.size(); ++i)
            means[i] = (512 * sums[i] + counts[i]) / (2 * counts[i]);
        if (background.empty()) {
            background = means;
            return Status::undecided;
        }
        std::vector<int> sorted;
        for (std::size_t i = 0; i < means.size(); ++i) sorted.push_back(means[i] - background[i]);
        std::sort(sorted.begin(), sorted.end());
        const int light = sorted[(sorted.size() - 1) / 2];
        BlockMotion motion;
        motion.light = GrayLevel::from_raw(light * 256);
        int left = across, right = -1, top = down, bottom = -1;
        for (int y = 0; y < down; ++y)
            for (int x = 0; x < across; ++x) {
                const auto i = static_cast<std::size_t>(y * across + x);
                if (std::abs(means[i] - background[i] - light) < options.difference_min * 256) continue;
                ++motion.changed;
                left = std::min(left, x), right = std::max(right, x);
                top = std::min(top, y), bottom = std::max(bottom, y);
            }
        if (motion.changed > 0) motion.box = {left, top, right - left + 1, bottom - top + 1};
        const int divisor = 1 << options.follow;
        for (std::size_t i = 0; i < means.size(); ++i) {
            // Nearest, ties up; the offset keeps the dividend above zero.
            const int difference = means[i] - background[i] + 65536 * 256;
            background[i] += (2 * difference + divisor) / (2 * divisor) - 65536 * 256 / divisor;
        }
        return motion;
    }
};

void expect_equal(const Result<BlockMotion>& a, const Result<BlockMotion>& b) {
    ASSERT_EQ(a.status(), b.status());
    if (!a) return;
    EXPECT_EQ(a->changed, b->changed);
    EXPECT_EQ(a->box, b->box);
    EXPECT_EQ(a->light, b->light);
}

TEST(BlockMotion, FindsTheBlocksThatChanged) {
    // Five by three blocks of 4x4 pixels, those at the right and at the bottom smaller.
    const Size size{18, 10};
    BlockMotionOptions options;
    options.block = 4;
    options.difference_min = 10;
    options.follow = 1;
    Watch watch(size, options);
    ASSERT_EQ(blocks_of(size, 4), (Size{5, 3}));
    GuardedImage<Gray8> image(size);
    image.fill(Gray8{50});
    EXPECT_EQ(watch.see(image).status(), Status::undecided) << "there was nothing to compare with";
    expect_equal(watch.see(image), BlockMotion());
    // One of 16 pixels by 160 levels: 10 levels of the mean. Two of the four in the corner by 20 each: 10.
    image(5, 6) = 210;
    image(16, 8) = 70;
    image(17, 9) = 70;
    BlockMotion expected;
    expected.changed = 2;
    expected.box = {1, 1, 4, 2};
    expect_equal(watch.see(image), expected);
    EXPECT_EQ(watch.background[6], 50 * 256 + 10 * 128) << "half of the way to the mean";
    expect_equal(watch.see(image), BlockMotion());
    image(0, 0) = 209;
    expect_equal(watch.see(image), BlockMotion());
}

TEST(BlockMotion, IsThatOfTheObviousWay) {
    Random random(61);
    for (const Size size : test_sizes())
        for (const int block : {4, 8, 32, 128}) {
            BlockMotionOptions options;
            options.block = block;
            options.difference_min = random.between(1, 20);
            options.follow = random.between(0, 8);
            Watch watch(size, options);
            NaiveWatch naive{options, {}};
            GuardedImage<Gray8> image(size);
            for (int frame = 0; frame < 5; ++frame) {
                if (frame % 2 == 0)
                    image.fill(random);
                else
                    image.fill(static_cast<Gray8>(random.below(256)));
                expect_equal(watch.see(image), naive.see(image, size));
                for (std::size_t i = 0; i < watch.background.size(); ++i)
                    ASSERT_EQ(watch.background[i], naive.background[i]);
            }
        }
}

TEST(BlockMotion, IsNotALampThatIsSwitchedOn) {
    const Size size{97, 65};
    Random random(62);
    Watch watch(size, {});
    GuardedImage<Gray8> image(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) image(x, y) = static_cast<Gray8>(40 + random.below(80));
    EXPECT_EQ(watch.see(image).status(), Status::undecided);
    for (const int brighter : {100, -90, 3, -10}) {
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) image(x, y) = static_cast<Gray8>(image(x, y) + brighter);
        const Result<BlockMotion> motion = watch.see(image);
        ASSERT_TRUE(motion.ok());
        EXPECT_EQ(motion->changed, 0);
    }
    // The lamp and a thing at once.
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            image(x, y) = static_cast<Gray8>(x >= 16 && x < 48 && y >= 32 && y < 48 ? 250 : image(x, y) + 50);
    EXPECT_EQ(watch.see(image)->box, (Rectangle{1, 2, 2, 1}));
}

TEST(BlockMotion, EndsWhereAThingStays) {
    for (const int follow : {0, 2, 4}) {
        BlockMotionOptions options;
        options.follow = follow;
        Watch watch({48, 48}, options);
        GuardedImage<Gray8> image({48, 48});
        image.fill(Gray8{10});
        EXPECT_EQ(watch.see(image).status(), Status::undecided);
        for (int y = 0; y < 16; ++y)
            for (int x = 16; x < 32; ++x) image(x, y) = 250;
        int frames = 0;
        while (watch.see(image)->changed > 0) ++frames;
        // 240 levels become less than 8: (1 - 1 / 2^follow)^frames is below 1 / 30.
        EXPECT_EQ(frames, follow == 0 ? 1 : follow == 2 ? 12 : 53);
        for (int i = 0; i < 300; ++i) static_cast<void>(watch.see(image));
        EXPECT_NEAR(watch.background[1], 250 * 256, 1 << follow >> 1);
    }
}

TEST(BlockMotion, ForgetsAndLearnsAnotherSize) {
    BlockMotionOptions options;
    options.block = 8;
    Watch watch({16, 8}, options);
    GuardedImage<Gray8> image({16, 8}), other({9, 3});
    image.fill(Gray8{10});
    other.fill(Gray8{20});
    EXPECT_EQ(watch.see(image).status(), Status::undecided);
    EXPECT_TRUE(watch.see(image).ok());
    // As many blocks, but not the same.
    EXPECT_EQ(watch.see(other).status(), Status::undecided);
    EXPECT_EQ(watch.background[0], 20 * 256);
    EXPECT_TRUE(watch.see(other).ok());
    watch.accumulator.forget();
    EXPECT_EQ(watch.see(other).status(), Status::undecided);
}

TEST(BlockMotion, SaysWhatIsWrongAndLeavesTheBackground) {
    const Size size{20, 20};
    Watch watch(size, {});
    GuardedImage<Gray8> image(size);
    image.fill(Gray8{10});
    EXPECT_EQ(watch.see(image).status(), Status::undecided);
    const std::vector<std::uint16_t> before = watch.background;
    EXPECT_EQ(block_motion({}, watch.accumulator).status(), Status::empty_image);
    EXPECT_EQ(watch.accumulator.begin({33, 20}), Status::size_mismatch);
    EXPECT_EQ(watch.accumulator.begin({max_image_side + 1, 1}), Status::image_too_large);
    EXPECT_EQ(watch.accumulator.finish().status(), Status::out_of_range) << "it never began";
    const Span<std::uint16_t> background{watch.background.data(), 4};
    const Span<std::uint8_t> scratch{watch.scratch.data(), static_cast<std::ptrdiff_t>(watch.scratch.size())};
    EXPECT_EQ(BlockMotionAccumulator({}, background, scratch.first(scratch.size() - 1)).begin(size),
              Status::scratch_too_small);
    const auto refused = [&](int block, int difference_min, int follow) {
        BlockMotionOptions options;
        options.block = block;
        options.difference_min = difference_min;
        options.follow = follow;
        EXPECT_EQ(BlockMotionAccumulator(options, background, scratch).begin(size), Status::bad_argument);
    };
    for (const int block : {0, 2, 12, 256, -16}) refused(block, 8, 4);
    for (const int difference_min : {0, 256}) refused(16, difference_min, 4);
    for (const int follow : {-1, 9}) refused(16, 8, follow);
    // A row is missing at the end, or in between, or there are too many.
    std::vector<Gray8> row(20, 200);
    for (const int missing : {19, 7, -1}) {
        ASSERT_EQ(watch.accumulator.begin(size), Status::ok);
        for (int y = 0; y < (missing < 0 ? 64 : 20); ++y)
            if (y != missing) watch.accumulator.add_row(row.data(), 20, y);
        EXPECT_EQ(watch.accumulator.finish().status(), Status::out_of_range);
    }
    EXPECT_EQ(watch.background, before);
    EXPECT_EQ(watch.see(image)->changed, 0);
}

TEST(BlockMotionAccumulator, GivesTheSameOfRowsThatComeOneByOne) {
    Random random(63);
    std::vector<std::uint8_t> memory(1 << 13);
    const Span<std::uint8_t> work{memory.data(), 1 << 13};
    for (const Size size : test_sizes()) {
        Watch whole(size, {}), lines(size, {}), spoilt(size, {});
        GuardedImage<Gray8> image(size);
        auto frame = stream(into(whole.accumulator));
        auto rows = stream(into(lines.accumulator));
        for (int i = 0; i < 3; ++i) {
            image.fill(random);
            ASSERT_EQ(frame.run(image.view(), Border::zero, work), Status::ok);
            // A frame that ends early before each.
            ASSERT_EQ(rows.start(size, Border::zero, work), Status::ok);
            for (int y = 0; y < size.height / 2; ++y) ASSERT_EQ(rows.push(image.view().row(0)), Status::ok);
            ASSERT_EQ(rows.start(size, Border::zero, work), Status::ok);
            for (int y = 0; y < size.height; ++y) ASSERT_EQ(rows.push(image.view().row(y)), Status::ok);
            expect_equal(lines.accumulator.finish(), whole.accumulator.finish());
            EXPECT_EQ(lines.background, whole.background);
        }
        auto strip = stream(into(spoilt.accumulator));
        if (size.height < 2) continue;
        ASSERT_EQ(strip.run_strip(image.view(), Border::zero, 1, size.height - 1, work), Status::ok);
        EXPECT_EQ(spoilt.accumulator.finish().status(), Status::out_of_range);
    }
}

}  // namespace
}  // namespace fovea::test
