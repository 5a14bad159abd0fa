// SPDX-License-Identifier: MIT
//
// What conversions from one kind of pixel to another share: their checks and the loop over the rows.
#pragma once

#include <cstdint>

#include <fovea/base/status.hpp>
#include <fovea/image/image_view.hpp>

namespace fovea::detail {

/// Rows without gaps are handled as one up to this many pixels, so that offsets fit an int.
inline constexpr std::int64_t most_joined_pixels = 1 << 24;

template <class Pixel>
bool has_gaps(ImageView<Pixel> image) {
    return image.stride_bytes() != static_cast<std::ptrdiff_t>(sizeof(Pixel)) * image.width();
}

/// row(src, width, dst) for every row of both images; width is the whole frame where no row has a gap. Rows
/// are joined only if they hold whole groups of pixels, which is how colour differences are shared.
template <class In, class Out, class Row>
Status convert_frame(ImageView<const In> src, ImageView<Out> dst, int group, Row row) {
    if (src.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    if (!has_gaps(src) && !has_gaps(dst) && src.width() % group == 0 &&
        src.size().area() <= most_joined_pixels) {
        row(src.first(), static_cast<int>(src.size().area()), dst.first());
        return Status::ok;
    }
    for (int y = 0; y < src.height(); ++y) row(src.row(y), src.width(), dst.row(y));
    return Status::ok;
}

template <class In, class Out, class Row>
Status convert_frame(ImageView<const In> src, ImageView<Out> dst, Row row) {
    return convert_frame(src, dst, 1, row);
}

}  // namespace fovea::detail
