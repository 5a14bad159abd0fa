// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include <fovea/base/random.hpp>
#include <fovea/pixelwise/arithmetic.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

using Operator = Status (*)(ImageView<const Gray8>, ImageView<const Gray8>, ImageView<Gray8>);
using Reference = int (*)(int, int);

struct Pair {
    const char* name;
    Operator run;
    Reference expected;
};
const Pair pairs[] = {
    {"add", add, [](int a, int b) { return (a + b) % 256; }},
    {"add_saturated", add_saturated, [](int a, int b) { return std::min(a + b, 255); }},
    {"subtract", subtract, [](int a, int b) { return (a - b + 256) % 256; }},
    {"subtract_saturated", subtract_saturated, [](int a, int b) { return std::max(a - b, 0); }},
    {"absolute_difference", absolute_difference, [](int a, int b) { return std::abs(a - b); }},
    {"average", average, [](int a, int b) { return (a + b + 1) / 2; }},
    {"pixel_minimum", pixel_minimum, [](int a, int b) { return std::min(a, b); }},
    {"pixel_maximum", pixel_maximum, [](int a, int b) { return std::max(a, b); }},
    {"bitwise_and", bitwise_and, [](int a, int b) { return a & b; }},
    {"bitwise_or", bitwise_or, [](int a, int b) { return a | b; }},
    {"bitwise_xor", bitwise_xor, [](int a, int b) { return a ^ b; }},
};

TEST(Arithmetic, IsRightForEveryPairOfLevels) {
    GuardedImage<Gray8> a({256, 256}), b({256, 256}), dst({256, 256});
    for (int y = 0; y < 256; ++y)
        for (int x = 0; x < 256; ++x) {
            a(x, y) = static_cast<Gray8>(x);
            b(x, y) = static_cast<Gray8>(y);
        }
    for (const Pair& pair : pairs) {
        ASSERT_EQ(pair.run(a.view(), b.view(), dst.view()), Status::ok);
        for (int y = 0; y < 256; ++y)
            for (int x = 0; x < 256; ++x)
                ASSERT_EQ(dst(x, y), pair.expected(x, y)) << pair.name << x << " " << y;
    }
}

TEST(Arithmetic, IsRightOnEverySize) {
    Random random(71);
    for (const Size size : test_sizes())
        for (const Pair& pair : pairs) {
            GuardedImage<Gray8> a(size), b(size, 0), dst(size, 1);
            a.fill(random);
            b.fill(random);
            ASSERT_EQ(pair.run(a.view(), b.view(), dst.view()), Status::ok);
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x)
                    ASSERT_EQ(dst(x, y), pair.expected(a(x, y), b(x, y))) << pair.name;
        }
}

TEST(Arithmetic, MayWriteOverItsSecondImage) {
    Random random(72);
    const Size size{70, 5};
    for (const Pair& pair : pairs) {
        GuardedImage<Gray8> a(size), b(size), dst(size);
        a.fill(random);
        b.fill(random);
        ASSERT_EQ(pair.run(a.view(), b.view(), dst.view()), Status::ok);
        ASSERT_EQ(pair.run(a.view(), b.view(), b.view()), Status::ok);
        EXPECT_TRUE(equal(b.view(), dst.view())) << pair.name;
    }
}

TEST(Arithmetic, SaysWhenTheSecondImageIsMissing) {
    GuardedImage<Gray8> a({4, 4}), dst({4, 4});
    a.fill(Gray8{1});
    for (const Pair& pair : pairs)
        EXPECT_EQ(pair.run(a.view(), ImageView<const Gray8>(), dst.view()), Status::empty_image) << pair.name;
    EXPECT_EQ(blend(a.view(), ImageView<const Gray8>(), 1, dst.view()), Status::empty_image);
}

TEST(Arithmetic, SubtractsWhatItAdded) {
    Random random(73);
    const Size size{99, 7};
    GuardedImage<Gray8> a(size), b(size), dst(size);
    a.fill(random);
    b.fill(random);
    ASSERT_EQ(add(a.view(), b.view(), dst.view()), Status::ok);
    ASSERT_EQ(subtract(dst.view(), b.view(), dst.view()), Status::ok);
    EXPECT_TRUE(equal(a.view(), dst.view()));
}

TEST(Blend, IsRightForEveryWeightAndMany) {
    Random random(74);
    const Size size{65, 6};
    GuardedImage<Gray8> a(size), b(size), dst(size);
    for (int weight = 0; weight <= whole_weight; ++weight) {
        a.fill(random);
        b.fill(random);
        a(0, 0) = b(0, 0) = 255;
        ASSERT_EQ(blend(a.view(), b.view(), weight, dst.view()), Status::ok);
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x)
                ASSERT_EQ(dst(x, y), (a(x, y) * (256 - weight) + b(x, y) * weight + 128) / 256);
    }
    ASSERT_EQ(blend(a.view(), b.view(), 0, dst.view()), Status::ok);
    EXPECT_TRUE(equal(a.view(), dst.view()));
    ASSERT_EQ(blend(a.view(), b.view(), whole_weight, dst.view()), Status::ok);
    EXPECT_TRUE(equal(b.view(), dst.view()));
}

TEST(Blend, OfHalfIsTheAverage) {
    Random random(75);
    const Size size{64, 9};
    GuardedImage<Gray8> a(size), b(size), mixed(size), mean(size);
    a.fill(random);
    b.fill(random);
    ASSERT_EQ(blend(a.view(), b.view(), 128, mixed.view()), Status::ok);
    ASSERT_EQ(average(a.view(), b.view(), mean.view()), Status::ok);
    EXPECT_TRUE(equal(mixed.view(), mean.view()));
}

TEST(Invert, IsTheDistanceToWhiteAndTwiceNothing) {
    Random random(76);
    for (const Size size : test_sizes()) {
        GuardedImage<Gray8> src(size), once(size), twice(size);
        src.fill(random);
        ASSERT_EQ(invert(src.view(), once.view()), Status::ok);
        ASSERT_EQ(invert(once.view(), twice.view()), Status::ok);
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) ASSERT_EQ(once(x, y), 255 - src(x, y));
        EXPECT_TRUE(equal(src.view(), twice.view()));
    }
}

}  // namespace
}  // namespace fovea::test
