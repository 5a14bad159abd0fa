// SPDX-License-Identifier: MIT
//
// Golden vectors of stream/: a frame, its strips, and rows that come one at a time.
#pragma once

#include <cstdint>

#include <fovea/base/list.hpp>
#include <fovea/filter/gaussian.hpp>
#include <fovea/filter/sobel.hpp>
#include <fovea/image/border.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/pixelwise/point_stages.hpp>
#include <fovea/stream/stage.hpp>
#include <fovea/stream/stream.hpp>
#include <golden/digest.hpp>
#include <golden/workspace.hpp>

namespace fovea::golden {

/// The sum of every row.
struct RowSums {
    using Input = Gray8;
    List<std::int32_t, 100> sums;

    Status begin(Size size) {
        sums.clear();
        return size.height <= 100 ? Status::ok : Status::image_too_large;
    }
    void add_row(const Gray8* row, int width, int y) {
        std::int32_t sum = y;
        for (int x = 0; x < width; ++x) sum += row[x];
        static_cast<void>(sums.push(sum));
    }
};

inline void stream_filters(Workspace& work, Digest& digest) {
    RowSums seen;
    for (const Size size : sizes)
        for (const Border border : {Border::replicate, Border::reflect_101, Border::zero}) {
            Random random(31);
            const ImageView<Gray8> src = work.view<Gray8>(0, size);
            fill(src, Filling::random, random);
            const ImageView<Gray8> dst = work.view<Gray8>(1, size);
            auto program = stream(stages::gaussian_5x5, tap(seen), stages::sobel_magnitude,
                                  stages::threshold{60}, into(dst));
            // One statement a call: the order of arguments is the compiler's.
            digest.add(program.run(src, border, work.scratch_span()));
            digest.add(dst, seen.sums.span(), program.complete());
            digest.add(program.run_strip(src, border, size.height / 2, size.height - 1, work.scratch_span()));
            digest.add(dst, seen.sums.span());
            auto sums = stream(stages::sobel_magnitude, RowSums());
            digest.add(sums.start(size, border, work.scratch_span()));
            for (int y = 0; y < size.height; ++y) digest.add(sums.push(src.row(y)));
            digest.add(sums.push(src.row(0)));
            digest.add(sums.accumulator().sums.span());
        }
}

}  // namespace fovea::golden
