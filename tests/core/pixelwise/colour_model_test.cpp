// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/pixelwise/colour_model.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

/// Colours about a line through colour space, with noise across it.
std::vector<Rgb888> cloud(Random& random, int count, int along, int across) {
    std::vector<Rgb888> samples;
    const auto level = [](int value) { return static_cast<std::uint8_t>(std::clamp(value, 0, 255)); };
    for (int i = 0; i < count; ++i) {
        const int t = random.between(-along, along);
        samples.push_back({level(150 + t + random.between(-across, across)),
                           level(100 + t / 2 + random.between(-across, across)),
                           level(60 - t / 3 + random.between(-across, across))});
    }
    return samples;
}

ColourModel learned(const std::vector<Rgb888>& samples) {
    ColourModelSums sums;
    for (const Rgb888 sample : samples) sums.add(sample);
    return *sums.model();
}

/// The same in real numbers.
struct RealModel {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    Eigen::Matrix3d inverse = Eigen::Matrix3d::Zero();

    explicit RealModel(const std::vector<Rgb888>& samples) {
        const auto vector = [](Rgb888 c) { return Eigen::Vector3d(c.red, c.green, c.blue); };
        const auto count = static_cast<double>(samples.size());
        for (const Rgb888 sample : samples) mean += vector(sample) / count;
        Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
        for (const Rgb888 sample : samples)
            covariance += (vector(sample) - mean) * (vector(sample) - mean).transpose() / (count - 1);
        inverse = covariance.inverse();
    }
    double distance_squared(Rgb888 c) const {
        const Eigen::Vector3d d = Eigen::Vector3d(c.red, c.green, c.blue) - mean;
        return d.dot(inverse * d);
    }
};

/// A covariance is off by at most 1/128 of a level^2, in all directions together by 3/128, and the smallest
/// spread is 1: 2.4 %. A mean is off by 1/32 of a level in each of three directions, and each of nine entries
/// of the inverse by 2^-25 over at most 255^2.
double tolerance(double expected) {
    return 0.024 * expected + 2 * std::sqrt(expected) * 0.055 + 0.003 + 9 * 65025.0 / (1 << 25);
}

TEST(ColourModel, IsLearnedByHand) {
    // Means 100, 50, 20. Only red spreads: (10^2 + 10^2) / 1 = 200, and 1.
    const ColourModel model = learned({{90, 50, 20}, {110, 50, 20}});
    EXPECT_EQ(model.mean[0], 1600);
    EXPECT_EQ(model.mean[1], 800);
    EXPECT_EQ(model.mean[2], 320);
    EXPECT_EQ(model.inverse[0], ((1 << 24) + 100) / 201);
    EXPECT_EQ(model.inverse[1], 1 << 24);
    EXPECT_EQ(model.inverse[2], 1 << 24);
    EXPECT_EQ(model.inverse[3], 0);
    EXPECT_EQ(model.distance_squared({100, 50, 20}), 0u);
    EXPECT_EQ(model.distance_squared({100, 53, 20}), 9u << 16);
    EXPECT_EQ(model.distance_squared({110, 50, 20}), (65536u * 100 + 100) / 201);
}

TEST(ColourModel, IsNearTheRealOne) {
    Random random(361);
    for (int round = 0; round < 60; ++round) {
        const auto samples =
            cloud(random, random.between(3, 400), random.between(0, 100), random.between(0, 20));
        const ColourModel model = learned(samples);
        const RealModel real(samples);
        for (int i = 0; i < 300; ++i) {
            const Rgb888 colour{static_cast<std::uint8_t>(random.below(256)),
                                static_cast<std::uint8_t>(random.below(256)),
                                static_cast<std::uint8_t>(random.below(256))};
            const double expected = real.distance_squared(colour);
            ASSERT_NEAR(model.distance_squared(colour) / 65536.0, std::min(expected, 65535.99),
                        tolerance(expected));
        }
    }
}

TEST(ColourModel, OfExtremeSamplesNeitherOverflowsNorIsNegative) {
    const std::vector<Rgb888> sets[] = {
        {{0, 0, 0}, {255, 255, 255}},
        {{255, 0, 0}, {0, 255, 255}},
        {{0, 0, 0}, {0, 0, 0}},
        {{255, 255, 255}, {255, 255, 255}, {255, 255, 255}},
        {{255, 0, 0}, {0, 255, 0}, {0, 0, 255}, {255, 255, 0}, {0, 255, 255}, {255, 0, 255}, {0, 0, 0}},
    };
    for (const auto& samples : sets) {
        const ColourModel model = learned(samples);
        const RealModel real(samples);
        for (int i = 0; i < 512; ++i) {
            const Rgb888 colour{static_cast<std::uint8_t>(i % 8 * 255 / 7),
                                static_cast<std::uint8_t>(i / 8 % 8 * 255 / 7),
                                static_cast<std::uint8_t>(i / 64 * 255 / 7)};
            const double expected = std::min(real.distance_squared(colour), 65535.99);
            ASSERT_NEAR(model.distance_squared(colour) / 65536.0, expected, tolerance(expected));
        }
    }
}

TEST(ColourModelRange, TakesThePixelsWithinTheLimitOfEverySize) {
    Random random(362);
    const auto samples = cloud(random, 200, 40, 6);
    const ColourModel model = learned(samples);
    for (const Size size : test_sizes()) {
        GuardedImage<Rgb888> src(size);
        GuardedImage<Gray8> dst(size);
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x)
                src(x, y) = samples[random.below(static_cast<std::uint32_t>(samples.size()))];
        ASSERT_EQ(colour_model_range(src.view(), model, 3 << 16, dst.view()), Status::ok);
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x)
                ASSERT_EQ(dst(x, y), model.distance_squared(src(x, y)) <= 3 << 16 ? 255 : 0);
    }
}

TEST(LearnColour, TakesEveryPixelOfAPart) {
    Random random(363);
    GuardedImage<Rgb888> image({30, 20});
    image.fill(random);
    ColourModelSums sums;
    for (int y = 5; y < 15; ++y)
        for (int x = 3; x < 20; ++x) sums.add(image(x, y));
    const ColourModel expected = *sums.model();
    const ColourModel model = *learn_colour(*image.view().crop({3, 5, 17, 10}));
    for (int i = 0; i < 3; ++i) EXPECT_EQ(model.mean[i], expected.mean[i]);
    for (int i = 0; i < 6; ++i) EXPECT_EQ(model.inverse[i], expected.inverse[i]);
    EXPECT_EQ(sums.count(), 170);
}

TEST(LearnColour, SaysWhatIsWrong) {
    EXPECT_EQ(learn_colour(ImageView<const Rgb888>()).status(), Status::empty_image);
    GuardedImage<Rgb888> one({1, 1});
    one.fill(Rgb888{1, 2, 3});
    EXPECT_EQ(learn_colour(one.view()).status(), Status::not_found);
    const std::vector<Rgb888> many(1025 * 1024);
    EXPECT_EQ(learn_colour(ImageView<const Rgb888>(many.data(), {1025, 1024}, 3 * 1025)).status(),
              Status::image_too_large);
    EXPECT_TRUE(learn_colour(ImageView<const Rgb888>(many.data(), {1024, 1024}, 3 * 1024)).ok());
    const ColourModel model = learned({{1, 2, 3}, {4, 5, 6}});
    GuardedImage<Gray8> dst({1, 2});
    dst.fill(Gray8{77});
    EXPECT_EQ(colour_model_range(ImageView<const Rgb888>(), model, 1, dst.view()), Status::empty_image);
    EXPECT_EQ(colour_model_range(one.view(), model, 1, dst.view()), Status::size_mismatch);
    EXPECT_EQ(dst(0, 0), 77);
}

}  // namespace
}  // namespace fovea::test
