// SPDX-License-Identifier: MIT
//
// Frames of 640x480 that are never in memory: a scene gives one line after the other, a stream smooths, cuts
// and labels them, and what it finds is told in numbers. A frame at hand must give the same.
#pragma once

#include <cstdint>

#include <fovea/base/list.hpp>
#include <fovea/base/random.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/filter/gaussian.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/pixelwise/point_stages.hpp>
#include <fovea/segment/components_accumulator.hpp>
#include <fovea/statistics/reductions.hpp>
#include <fovea/stream/stream.hpp>

namespace fovea::target {

/// A dark plate with a round hole on a bright ground, with noise; turned by the number of its frame.
class LineScene {
public:
    static constexpr Size size{640, 480};
    static constexpr int frames = 3;

    explicit LineScene(int frame)
        : run_(12 - 2 * frame), rise_(5 + 3 * frame), random_(static_cast<unsigned>(40 + frame)) {}

    /// The next line, from the top.
    void take(Gray8* line) {
        const int dy = y_ - 230;
        for (int x = 0; x < size.width; ++x) {
            const int dx = x - 310;
            const int along = run_ * dx + rise_ * dy;
            const int across = run_ * dy - rise_ * dx;
            const bool plate = along > -2200 && along < 2200 && across > -1100 && across < 1100;
            const bool hole = dx * dx + dy * dy < 35 * 35;
            const int noise = static_cast<int>(random_.next() >> 27);
            line[x] = static_cast<Gray8>((plate && !hole ? 40 : 190) + noise);
        }
        ++y_;
    }

private:
    int run_;
    int rise_;
    Random random_;
    int y_ = 0;
};

/// What the frame is measured with: about 13 kB where addresses have 32 bits.
struct LineGauge {
    static constexpr int labels = 12;

    alignas(8) std::uint8_t of_stream[5632];
    alignas(8) std::uint8_t of_components[7040];
    List<Region, 3> regions;
    List<Hole, 3> holes;

    /// feed(stream) sends the frame through; print(text) and print(number) tell the answers.
    template <class Feed, class Print>
    void measure(Feed feed, Print print) {
        ComponentOptions large;
        large.area_min = 200;
        large.hole_area_min = 200;
        ComponentsAccumulator components(large, Span<std::uint8_t>(of_components), regions, holes);
        MeanAndVarianceAccumulator mean;
        auto program =
            stream(stages::gaussian_3x3, tap(mean), stages::threshold_inverse{128}, into(components));
        Status status = feed(program, Span<std::uint8_t>(of_stream));
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
};

}  // namespace fovea::target
