// SPDX-License-Identifier: MIT
//
// Streams: row kernels and accumulators in one pass. Only the rows that the windows need are kept, so that a
// chip which cannot hold a frame still filters and measures in it, and a frame stays in the cache.
#pragma once

#include <cstdint>
#include <cstring>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/border.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/stream/nodes.hpp>
#include <fovea/stream/stage.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

inline namespace FOVEA_ISA {

/// Stages one after the other, up to an accumulator. The same bits as the whole-frame functions of its
/// stages, one after the other, give; made by stream().
///
/// A frame at hand goes through by run(), and a strip of it by run_strip(), for one of several processors
/// that have a stream each. A camera that sends rows gets start() and a push() for each row.
template <class... Stages>
class Stream {
public:
    using Input = typename detail::Nodes<Stages...>::Input;

    Stream() = default;
    explicit constexpr Stream(const Stages&... stages) : nodes_(stages...) {}

    /// Bytes of scratch for images of a width; grows with the width alone.
    constexpr std::int64_t scratch(int width) const {
        return nodes_.scratch(width) + 2 * detail::room_alignment + row_room(width);
    }

    /// Sends a whole frame through.
    ///
    /// Shapes   src 1x1 or larger
    /// Border   of every window stage as border says
    /// Overlap  none between src and what is written
    /// Scratch  scratch(src.width()) bytes, undefined afterwards
    /// Errors   empty_image, image_too_large above max_image_side, bad_argument for a stage with parameters
    ///          that its function refuses, scratch_too_small, and what stages and accumulators say to the
    ///          size: an image at hand or at the end size_mismatch
    Status run(ImageView<const Input> src, Border border, Span<std::uint8_t> scratch_bytes) {
        return run_strip(src, border, 0, src.height() - 1, scratch_bytes);
    }
    /// Makes rows first to last of what run() makes; accumulators see these rows alone.
    ///
    /// Errors  also out_of_range for rows that are not in src
    Status run_strip(ImageView<const Input> src, Border border, int first, int last,
                     Span<std::uint8_t> scratch_bytes) {
        if (src.empty()) return Status::empty_image;
        if (first < 0 || last < first || last >= src.height()) return Status::out_of_range;
        if (const Status s = begin(src.size(), border, first, last, scratch_bytes); s != Status::ok) return s;
        for (int y = wanted_.first; y <= wanted_.last; ++y) nodes_.take(src.row(y));
        next_ = wanted_.last + 1;
        return Status::ok;
    }

    /// Begins an image whose rows come one at a time.
    ///
    /// Errors  as run(); the scratch must live until the last row
    Status start(Size size, Border border, Span<std::uint8_t> scratch_bytes) {
        if (size.empty()) return Status::empty_image;
        return begin(size, border, 0, size.height - 1, scratch_bytes);
    }
    /// Takes the next row; it is copied, and may be written over afterwards.
    ///
    /// Errors  out_of_range before start() and behind the last row
    Status push(const Input* row) {
        if (complete()) return Status::out_of_range;
        std::memcpy(reinterpret_cast<std::uint8_t*>(nodes_.slot()),
                    reinterpret_cast<const std::uint8_t*>(row),
                    sizeof(Input) * static_cast<std::size_t>(width_));
        nodes_.pushed();
        ++next_;
        return Status::ok;
    }
    /// True when every row of the image has come.
    bool complete() const { return next_ > wanted_.last; }

    /// The accumulator at the end, with what it has gathered.
    auto& accumulator() { return nodes_.accumulator(); }
    const auto& accumulator() const { return nodes_.accumulator(); }

private:
    static constexpr std::int64_t row_room(int width) {
        return detail::room(static_cast<std::int64_t>(sizeof(Input)) * width);
    }
    Status begin(Size size, Border border, int first, int last, Span<std::uint8_t> scratch_bytes) {
        wanted_ = {};
        next_ = 0;
        if (size.width > max_image_side || size.height > max_image_side) return Status::image_too_large;
        if (!nodes_.valid()) return Status::bad_argument;
        if (scratch_bytes.size() < scratch(size.width)) return Status::scratch_too_small;
        const auto address = reinterpret_cast<std::uintptr_t>(scratch_bytes.data());
        const auto skip =
            (detail::room_alignment - address % detail::room_alignment) % detail::room_alignment;
        detail::RowRange wanted;
        if (const Status s = nodes_.begin(size, border, scratch_bytes.data() + skip, {first, last}, wanted);
            s != Status::ok)
            return s;
        width_ = size.width;
        wanted_ = wanted;
        next_ = wanted.first;
        return Status::ok;
    }

    detail::Nodes<Stages...> nodes_;
    detail::RowRange wanted_;
    int next_ = 0;
    int width_ = 0;
};

/// Composes stages: stream(stages::gaussian_5x5, stages::threshold{40}, into(image)).
/// docs/operators/stream.md lists them.
template <class... Stages>
constexpr Stream<Stages...> stream(const Stages&... stages) {
    return Stream<Stages...>(stages...);
}

}  // namespace FOVEA_ISA
}  // namespace fovea
