// SPDX-License-Identifier: MIT
//
// Lines: a sensor that sends an image of memory line by line, for tests.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/hal/line_source.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>

namespace fovea::simulated {

/// The lines of a picture, the same in each frame. Every line is asked for `pause` times before it arrives;
/// the line `lost` never does, and `broken` answers io_error. A line is written over when the next is asked
/// for, as a chip's buffer is.
class Lines {
public:
    explicit Lines(ImageView<const Gray8> picture)
        : picture_(picture), line_(static_cast<std::size_t>(picture.width())) {}

    Size size() const { return picture_.size(); }
    Status start() {
        if (broken) return Status::io_error;
        y_ = 0;
        asked_ = 0;
        return Status::ok;
    }
    Result<Span<const std::uint8_t>> next() {
        std::fill(line_.begin(), line_.end(), std::uint8_t{0xa5});
        if (broken) return Status::io_error;
        if (y_ >= picture_.height()) return Span<const std::uint8_t>();
        if (y_ == lost) return Status::truncated;
        if (asked_++ < pause) return Span<const std::uint8_t>();
        asked_ = 0;
        std::copy_n(picture_.row(y_), picture_.width(), line_.begin());
        ++y_;
        return Span<const std::uint8_t>(line_.data(), static_cast<std::ptrdiff_t>(line_.size()));
    }

    int pause = 0;
    int lost = -1;
    bool broken = false;

private:
    ImageView<const Gray8> picture_;
    std::vector<std::uint8_t> line_;
    /// At the end of a frame until start().
    int y_ = max_image_side;
    int asked_ = 0;
};

static_assert(hal::is_line_source_v<Lines>);

}  // namespace fovea::simulated
