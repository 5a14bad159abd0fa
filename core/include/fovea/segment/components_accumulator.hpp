// SPDX-License-Identifier: MIT
//
// Connected components as the end of a stream.
#pragma once

#include <cstdint>

#include <fovea/base/list.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/segment/connected_components.hpp>
#include <fovea/segment/region.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/statistics/moments.hpp>

namespace fovea {
inline namespace FOVEA_ISA {

/// The components of the rows of a stream: an accumulator. Components reach across strips of a frame, so that
/// it takes whole frames alone.
///
/// Shapes   images up to max_moment_side squared; zero is ground, all else belongs
/// Scratch  connected_components_scratch<Accumulated>(width) bytes, in use until finish()
/// Errors   of begin(): what ConnectedComponentsOf says to its parameters, and image_too_large; the lists are
///          as they were. Of finish(): as there, and out_of_range if it was a strip, with both lists empty
/// Source   as connected_components()
template <class Accumulated>
class ComponentsAccumulatorOf {
public:
    using Input = std::uint8_t;
    using Region = RegionOf<Accumulated>;
    using Hole = HoleOf<Accumulated>;

    ComponentsAccumulatorOf(const ComponentOptions& options, Span<std::uint8_t> scratch,
                            ListView<Region> regions, ListView<Hole> holes)
        : options_(options),
          scratch_(scratch),
          regions_(regions),
          holes_(holes),
          components_(0, options, scratch, regions, holes) {}

    Status begin(Size size) {
        if (size.height > max_moment_side) return Status::image_too_large;
        components_ = Components(size.width, options_, scratch_, regions_, holes_);
        height_ = size.height;
        next_ = 0;
        in_order_ = true;
        return components_.status();
    }
    void add_row(const std::uint8_t* row, int, int y) {
        in_order_ = in_order_ && y == next_;
        ++next_;
        // What stopped the work is what finish() says.
        if (in_order_) static_cast<void>(components_.add_row(row));
    }
    /// Closes what is open and orders the lists, once the last row has come.
    Status finish() {
        if (components_.status() == Status::ok && (!in_order_ || next_ != height_)) {
            regions_.clear();
            holes_.clear();
            return Status::out_of_range;
        }
        return components_.finish();
    }

private:
    using Components = ConnectedComponentsOf<Accumulated>;

    ComponentOptions options_;
    Span<std::uint8_t> scratch_;
    ListView<Region> regions_;
    ListView<Hole> holes_;
    Components components_;
    int height_ = 0;
    int next_ = 0;
    bool in_order_ = true;
};

using ComponentsAccumulator = ComponentsAccumulatorOf<Moments>;

}  // namespace FOVEA_ISA
}  // namespace fovea
