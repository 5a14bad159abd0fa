// SPDX-License-Identifier: MIT
//
// gauge() by several workers, in any order, is gauge() by one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include <fovea/decision/gauge.hpp>
#include <support/guarded_image.hpp>
#include <support/scattered_workers.hpp>

namespace fovea::test {
namespace {

Feature named(const char* name, FeatureKind kind, Tolerance tolerance) {
    Feature feature;
    std::copy_n(name, std::strlen(name), feature.name);
    feature.kind = kind;
    feature.tolerance = tolerance;
    return feature;
}

/// Finds dark parts, counts their holes and measures them across and around.
Recipe recipe(int opening, ThresholdRule threshold) {
    constexpr std::int64_t px = 1000000;
    Recipe made;
    made.locate.threshold = threshold;
    made.locate.level = 120;
    made.locate.dark_part = true;
    made.locate.opening = opening;
    made.locate.area_min = 60;
    made.locate.orientation = OrientationRule::none;
    const Tolerance wide = {{20 * px}, {15 * px}, {15 * px}};
    EXPECT_EQ(made.features.push(named("holes", FeatureKind::hole_count, {{1 * px}, {0}, {0}})), Status::ok);
    Feature width = named("w", FeatureKind::width, wide);
    width.from = {-30 * px, 0};
    width.to = {30 * px, 0};
    EXPECT_EQ(made.features.push(width), Status::ok);
    Feature across = named("d", FeatureKind::diameter, wide);
    across.radius = 10 * px;
    across.search = 7 * px;
    EXPECT_EQ(made.features.push(across), Status::ok);
    return made;
}

/// Dark discs and rings on bright ground, with noise that lets small parts come and go.
GuardedImage<Gray8> picture(Size size, Random& random, int discs) {
    GuardedImage<Gray8> image(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            image.view()(x, y) = static_cast<Gray8>(200 + random.between(-30, 30));
    for (int k = 0; k < discs; ++k) {
        const int radius = random.between(2, 16);
        const int inner = random.between(-8, radius - 3);
        const int x0 = random.between(0, size.width - 1);
        const int y0 = random.between(0, size.height - 1);
        for (int y = std::max(y0 - radius, 0); y <= std::min(y0 + radius, size.height - 1); ++y)
            for (int x = std::max(x0 - radius, 0); x <= std::min(x0 + radius, size.width - 1); ++x) {
                const int square = (x - x0) * (x - x0) + (y - y0) * (y - y0);
                if (square <= radius * radius && !(inner > 0 && square < inner * inner))
                    image.view()(x, y) = static_cast<Gray8>(60 + random.between(-20, 20));
            }
    }
    return image;
}

struct Answer {
    Status status = Status::ok;
    std::vector<PartResult> parts;
};

/// The scratch is of exactly the bytes that are asked for, so that a sanitizer sees who takes more.
template <class Workers>
Answer answer_of(ImageView<const Gray8> image, const Recipe& by, int capacity, const Workers& workers) {
    const std::int64_t bytes = gauge_scratch(image.size(), by.locate, capacity, workers.count());
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(bytes), std::uint8_t{0xa5});
    Answer answer;
    answer.parts.resize(static_cast<std::size_t>(capacity));
    int count = 0;
    answer.status = gauge(image, by, {scratch.data(), static_cast<std::ptrdiff_t>(bytes)},
                          ListView<PartResult>(answer.parts.data(), capacity, &count), workers);
    answer.parts.resize(static_cast<std::size_t>(count));
    return answer;
}

void expect_same(const Answer& seen, const Answer& wanted) {
    ASSERT_EQ(seen.status, wanted.status);
    ASSERT_EQ(seen.parts.size(), wanted.parts.size());
    for (std::size_t k = 0; k < seen.parts.size(); ++k) {
        const PartResult& a = seen.parts[k];
        const PartResult& b = wanted.parts[k];
        ASSERT_EQ(a.verdict, b.verdict);
        ASSERT_EQ(a.area, b.area);
        ASSERT_EQ(a.box.x, b.box.x);
        ASSERT_EQ(a.box.y, b.box.y);
        ASSERT_EQ(a.holes, b.holes);
        ASSERT_EQ(a.pose.orientation, b.pose.orientation);
        ASSERT_EQ(a.pose.frame.origin().x.raw(), b.pose.frame.origin().x.raw());
        ASSERT_EQ(a.feature_count, b.feature_count);
        for (int f = 0; f < a.feature_count; ++f) {
            ASSERT_EQ(a.features[f].status, b.features[f].status);
            ASSERT_EQ(a.features[f].verdict, b.features[f].verdict);
            if (a.features[f].status != Status::ok) continue;
            ASSERT_EQ(a.features[f].measurement.value.millionths, b.features[f].measurement.value.millionths);
        }
    }
}

TEST(GaugeByWorkers, IsTheSameInAnyOrder) {
    Random random(5);
    int parts = 0;
    int measured = 0;
    for (const Size size : {Size{1, 1}, Size{40, 15}, Size{63, 64}, Size{130, 97}, Size{200, 250}})
        for (const int opening : {1, 3, 5})
            for (const ThresholdRule rule :
                 {ThresholdRule::fixed, ThresholdRule::otsu, ThresholdRule::quantile})
                for (int round = 0; round < 3; ++round) {
                    const auto image = picture(size, random, static_cast<int>(size.area() / 1200));
                    const Recipe by = recipe(opening, rule);
                    const Answer wanted = answer_of(image.view(), by, 12, OneWorker());
                    parts += static_cast<int>(wanted.parts.size());
                    for (const PartResult& part : wanted.parts)
                        measured += part.features[1].status == Status::ok ? 1 : 0;
                    for (const int workers : {1, 2, 3, 8, 16}) {
                        SCOPED_TRACE(workers);
                        expect_same(
                            answer_of(image.view(), by, 12,
                                      ScatteredWorkers(workers, static_cast<std::uint32_t>(round + 9))),
                            wanted);
                    }
                }
    EXPECT_GT(parts, 400);
    EXPECT_GT(measured, 100);
}

TEST(GaugeByWorkers, AsksForTheScratchOfAll) {
    Random random(6);
    const auto image = picture({90, 120}, random, 6);
    const Recipe by = recipe(3, ThresholdRule::fixed);
    const ScatteredWorkers four(4, 1);
    const auto labels = connected_components_scratch(90);
    const std::int64_t enough = gauge_scratch({90, 120}, by.locate, 12, 4);
    EXPECT_GT(enough, gauge_scratch({90, 120}, by.locate, 12));
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(enough));
    List<PartResult, 12> parts;
    for (const std::int64_t bytes : {std::int64_t{0}, std::int64_t{100}, enough - labels - 1000})
        EXPECT_EQ(gauge(image.view(), by, {scratch.data(), static_cast<std::ptrdiff_t>(bytes)}, parts, four),
                  Status::scratch_too_small)
            << bytes;
    EXPECT_TRUE(parts.empty());
}

}  // namespace
}  // namespace fovea::test
