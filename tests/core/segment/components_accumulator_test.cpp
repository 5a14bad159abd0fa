// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include <fovea/base/list.hpp>
#include <fovea/base/random.hpp>
#include <fovea/pixelwise/point_stages.hpp>
#include <fovea/segment/components_accumulator.hpp>
#include <fovea/segment/connected_components.hpp>
#include <fovea/stream/stream.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

Span<std::uint8_t> span_of(std::vector<std::uint8_t>& bytes) {
    return {bytes.data(), static_cast<std::ptrdiff_t>(bytes.size())};
}
std::vector<std::uint8_t> room(int width) {
    return std::vector<std::uint8_t>(static_cast<std::size_t>(connected_components_scratch(width)));
}

TEST(ComponentsAccumulator, FindsAtTheEndOfAStreamWhatTheFunctionFindsInTheFrame) {
    Random random(12);
    std::vector<std::uint8_t> work(1 << 12);
    for (const Size size : test_sizes()) {
        GuardedImage<Gray8> src(size), binary(size);
        src.fill(random);
        ASSERT_EQ(threshold(src.view(), 150, binary.view()), Status::ok);
        std::vector<std::uint8_t> first_room = room(size.width), second_room = room(size.width);
        List<Region, 2000> expected_regions, regions;
        List<Hole, 2000> expected_holes, holes;
        ASSERT_EQ(connected_components(binary.view(), {}, span_of(first_room), expected_regions.view(),
                                       expected_holes.view()),
                  Status::ok);
        ComponentsAccumulator components({}, span_of(second_room), regions.view(), holes.view());
        auto program = stream(stages::threshold{150}, into(components));
        // Once more with the same one: every image begins anew.
        for (int time = 0; time < 2; ++time) {
            ASSERT_EQ(program.run(src.view(), Border::replicate, span_of(work)), Status::ok);
            ASSERT_EQ(components.finish(), Status::ok);
            ASSERT_EQ(regions.size(), expected_regions.size());
            ASSERT_EQ(holes.size(), expected_holes.size());
            for (int i = 0; i < regions.size(); ++i) {
                EXPECT_EQ(regions[i].first, expected_regions[i].first);
                EXPECT_EQ(regions[i].moments.m11, expected_regions[i].moments.m11);
                EXPECT_EQ(regions[i].holes, expected_regions[i].holes);
            }
        }
    }
}

TEST(ComponentsAccumulator, RefusesWhatTheFunctionRefuses) {
    std::vector<std::uint8_t> memory = room(20), work(1 << 12);
    List<Region, 4> regions;
    List<Hole, 4> holes;
    ASSERT_EQ(regions.push(Region()), Status::ok);
    ComponentOptions crossed;
    crossed.area_min = 5;
    crossed.area_max = 4;
    ComponentsAccumulator wrong(crossed, span_of(memory), regions.view(), holes.view());
    EXPECT_EQ(wrong.begin({20, 4}), Status::bad_argument);
    ComponentsAccumulator right({}, span_of(memory), regions.view(), holes.view());
    EXPECT_EQ(right.begin({20, max_moment_side + 1}), Status::image_too_large);
    EXPECT_EQ(right.begin({max_moment_side + 1, 4}), Status::image_too_large);
    ComponentsAccumulator small({}, span_of(memory).first(40), regions.view(), holes.view());
    EXPECT_EQ(small.begin({20, 4}), Status::scratch_too_small);
    EXPECT_EQ(regions.size(), 1);
}

TEST(ComponentsAccumulator, SaysThatItSawAStripAlone) {
    GuardedImage<Gray8> src({20, 6});
    src.fill(Gray8{255});
    std::vector<std::uint8_t> memory = room(20), work(1 << 12);
    List<Region, 4> regions;
    List<Hole, 4> holes;
    ComponentsAccumulator components({}, span_of(memory), regions.view(), holes.view());
    auto program = stream(into(components));
    for (const Point rows : {Point{0, 4}, Point{1, 5}, Point{2, 3}}) {
        ASSERT_EQ(program.run_strip(src.view(), Border::zero, rows.x, rows.y, span_of(work)), Status::ok);
        EXPECT_EQ(components.finish(), Status::out_of_range);
        EXPECT_EQ(regions.size(), 0);
    }
    ASSERT_EQ(program.run(src.view(), Border::zero, span_of(work)), Status::ok);
    EXPECT_EQ(components.finish(), Status::ok);
    EXPECT_EQ(regions.size(), 1);
}

}  // namespace
}  // namespace fovea::test
