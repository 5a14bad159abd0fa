// SPDX-License-Identifier: MIT
//
// Frames of 640x480 that are never in memory: a scene gives one line after the other, streams measure in them
// in four ways, and what they find is told in numbers. A frame at hand must give the same.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/list.hpp>
#include <fovea/base/random.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/filter/gaussian.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/light_section/line_peak.hpp>
#include <fovea/measure/run_gauge.hpp>
#include <fovea/motion/block_motion.hpp>
#include <fovea/pixelwise/point_stages.hpp>
#include <fovea/segment/components_accumulator.hpp>
#include <fovea/statistics/reductions.hpp>
#include <fovea/stream/stream.hpp>
#include <target/line_scenes.hpp>

namespace fovea::target {

/// What frames are measured with: about 13 kB where addresses have 32 bits, for one kind after the other.
/// feed(scene, stream, scratch) sends a frame through; print(text) and print(number) tell the answers. No
/// function is inlined, so that the stack holds one stream at a time.
struct LineGauge {
    static constexpr int labels = 12;
    static constexpr Size size{640, 480};

    alignas(8) std::uint8_t of_stream[5632];
    alignas(8) std::uint8_t of_accumulator[7040];
    List<Region, 3> regions;
    List<Hole, 3> holes;

    template <class Feed, class Print>
    void measure_all(Feed feed, Print print) {
        for (int frame = 0; frame < PlateScene::frames; ++frame) measure_parts(frame, feed, print);
        for (int frame = 0; frame < CordScene::frames; ++frame) measure_widths(frame, feed, print);
        for (int frame = 0; frame < LaserScene::frames; ++frame) measure_line(frame, feed, print);
        watch(feed, print);
    }

    /// Smoothed, cut, and labelled.
    template <class Feed, class Print>
    [[gnu::noinline]] void measure_parts(int frame, Feed feed, Print print) {
        PlateScene scene(frame);
        ComponentOptions large;
        large.area_min = 200;
        large.hole_area_min = 200;
        ComponentsAccumulator components(large, Span<std::uint8_t>(of_accumulator), regions, holes);
        MeanAndVarianceAccumulator mean;
        auto program =
            stream(stages::gaussian_3x3, tap(mean), stages::threshold_inverse{128}, into(components));
        Status status = feed(scene, program, Span<std::uint8_t>(of_stream));
        if (status == Status::ok) status = components.finish();
        print(describe(status));
        for (const Region& part : regions.view()) {
            print(" part");
            for (const std::int64_t number :
                 {part.moments.m00, part.moments.m10, part.moments.m01, part.moments.m20, part.moments.m11,
                  part.moments.m02, std::int64_t{part.box.x}, std::int64_t{part.box.y},
                  std::int64_t{part.box.width}, std::int64_t{part.box.height}})
                print(number);
        }
        for (const Hole& hole : holes.view()) {
            print(" hole");
            print(std::int64_t{hole.moments.m00});
        }
        const Result<MeanAndVariance> levels = mean.result();
        print(" mean and variance");
        print(levels.ok() ? std::int64_t{levels->mean.raw()} : -1);
        print(levels.ok() ? std::int64_t{levels->variance.raw()} : -1);
        print("\n");
    }

    /// The longest run of each row.
    template <class Feed, class Print>
    [[gnu::noinline]] void measure_widths(int frame, Feed feed, Print print) {
        CordScene scene(frame);
        RunWidthAccumulator accumulator(20);
        auto program = stream(stages::gaussian_3x3, stages::threshold_inverse{128}, into(accumulator));
        const Status status = feed(scene, program, Span<std::uint8_t>(of_stream));
        print(describe(status));
        const Result<RunWidths> widths = accumulator.result();
        if (widths) {
            print(" rows");
            for (const int number : {widths->rows, widths->first_row, widths->last_row})
                print(std::int64_t{number});
            print(" widths");
            for (const int number : {widths->narrowest, widths->widest}) print(std::int64_t{number});
            print(std::int64_t{widths->mean.raw()});
        }
        print("\n");
    }

    /// Where a laser line crosses each row.
    template <class Feed, class Print>
    [[gnu::noinline]] void measure_line(int frame, Feed feed, Print print) {
        LaserScene scene(frame);
        static_assert(sizeof(LinePeak) * size.height <= sizeof of_accumulator);
        const Span<LinePeak> peaks(reinterpret_cast<LinePeak*>(of_accumulator), size.height);
        LinePeakOptions options;
        options.level = 60;
        options.width_min = 2;
        options.width_max = 20;
        LinePeakAccumulator accumulator(options, peaks);
        auto program = stream(stages::gaussian_3x3, into(accumulator));
        const Status status = feed(scene, program, Span<std::uint8_t>(of_stream));
        print(describe(status));
        std::int64_t found = 0;
        std::int64_t doubtful = 0;
        std::int64_t places = 0;
        std::int64_t strengths = 0;
        for (const LinePeak& peak : peaks) {
            found += peak.empty() ? 0 : 1;
            doubtful += peak.runs > 1 ? 1 : 0;
            places += peak.x.raw();
            strengths += peak.strength;
        }
        print(" line");
        for (const std::int64_t number : {found, doubtful, places, strengths}) print(number);
        print(" at");
        for (const int y : {40, 239, 400}) print(std::int64_t{peaks[y].x.raw()});
        print("\n");
    }

    /// What moves from frame to frame.
    template <class Feed, class Print>
    [[gnu::noinline]] void watch(Feed feed, Print print) {
        constexpr BlockMotionOptions options;
        constexpr std::int64_t blocks = blocks_of(size, options.block).area();
        static_assert(2 * blocks + block_motion_scratch(size, options.block) <= sizeof of_accumulator);
        const Span<std::uint16_t> background(reinterpret_cast<std::uint16_t*>(of_accumulator), blocks);
        BlockMotionAccumulator accumulator(options, background,
                                           Span<std::uint8_t>(of_accumulator).from(2 * blocks));
        auto program = stream(into(accumulator));
        for (int frame = 0; frame < YardScene::frames; ++frame) {
            YardScene scene(frame);
            const Status status = feed(scene, program, Span<std::uint8_t>(of_stream));
            if (status != Status::ok) print(describe(status));
            const Result<BlockMotion> motion = accumulator.finish();
            print(describe(motion.status()));
            if (motion) {
                print(" light");
                print(std::int64_t{motion->light.raw()});
                print(" blocks");
                for (const int number :
                     {motion->changed, motion->box.x, motion->box.y, motion->box.width, motion->box.height})
                    print(std::int64_t{number});
            }
            print("\n");
        }
    }
};

}  // namespace fovea::target
